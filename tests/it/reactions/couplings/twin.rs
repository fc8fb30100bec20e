//! Equilibrium written out in full, as a twin: six unknowns a joint and one a coupling, six equations a link and one a freedom,
//! solved by complete elimination. It reads points, axes, links and ratios of the model and shares no other code with it.

use crate::common::*;

type V = [f64; 3];

/// A force at a point and a moment on a link, with a factor.
struct Push {
    link: LinkId,
    force: V,
    at: V,
    moment: V,
}

impl Push {
    fn new(link: LinkId, force: V, at: V, moment: V) -> Push {
        Push {
            link,
            force,
            at,
            moment,
        }
    }
}

/// The equations of the pose of the file; lengths in metres.
pub(super) struct Twin {
    rows: Vec<Vec<f64>>,
    right: Vec<f64>,
    joints: Vec<JointId>,
    couplings: usize,
    /// By coupling: the direction of its teeth's force on the first gear, where it has any.
    teeth: Vec<Option<V>>,
}

/// Directions of a joint's freedoms: (whether it is a slide, the direction).
fn freedoms(m: &Mechanism, j: JointId) -> Vec<(Freedom, bool, V)> {
    assert_ne!(m.joints[j].joint_type, JointType::Fixed);
    let own = m.joints[j].joint_type.freedoms().iter();
    own.map(|&f| (f, f.is_slide(), direction_of(&m.joints[j].frame, f)))
        .collect()
}

/// Where two pitch circles touch and the direction across their centre line, from their radii: centres apart by the sum of
/// the radii where the gears turn against each other, by the difference where they turn alike.
fn mesh(m: &Mechanism, q: usize) -> Option<(LinkId, LinkId, V, V)> {
    let c = &m.couplings[q];
    let [a, b] = c.ends.map(|e| e.joint);
    let (la, lb) = (m.joints[a].links, m.joints[b].links);
    let carrier = *la.iter().find(|l| lb.contains(l))?;
    let gear = |l: [LinkId; 2]| if l[0] == carrier { l[1] } else { l[0] };
    if !c.gear || gear(la) == gear(lb) {
        return None;
    }
    let metres = m.length_unit.metres;
    let place = |j: JointId| scale(to_vector(&m.joints[j].frame.point), metres);
    let axis = |j: JointId| unit(to_vector(&m.joints[j].frame.axis));
    let forward = |l: [LinkId; 2]| if l[0] == carrier { 1.0 } else { -1.0 };
    let (za, zb) = (scale(axis(a), forward(la)), scale(axis(b), forward(lb)));
    let (pa, pb) = (place(a), place(b));
    let ratio = c.ratio.to_f64();
    match c.ends.map(|e| e.freedom) {
        [Freedom::Rz, Freedom::Rz] => {
            if dot(cross(za, zb), cross(za, zb)) > 1e-16 || dot(sub(pb, pa), za).abs() > 1e-12 {
                return None;
            }
            let ratio = ratio * dot(za, zb).signum();
            // On one axis, or alike about two: no gears.
            if ratio == 1.0 || pa == pb {
                return None;
            }
            let (line, apart) = (unit(sub(pb, pa)), dot(sub(pb, pa), sub(pb, pa)).sqrt());
            // Both circles move alike where they touch: x ω_a = (x - apart) ω_b.
            let x = -apart * ratio / (1.0 - ratio);
            let at = [0, 1, 2].map(|i| pa[i] + x * line[i]);
            Some((gear(la), gear(lb), at, cross(za, line)))
        }
        [Freedom::Tz, Freedom::Rz] if dot(za, zb).abs() < 1e-12 => {
            let radius = metres / ratio;
            // The rack's velocity u is that of the pinion at p + n: ω z × n = u for ω = 1/radius.
            let n = scale(cross(za, zb), radius);
            let at = [0, 1, 2].map(|i| pb[i] + n[i]);
            Some((gear(la), gear(lb), at, za))
        }
        _ => None,
    }
}

impl Twin {
    pub(super) fn new(m: &Mechanism, drives: &[(JointId, Freedom)]) -> Twin {
        let metres = m.length_unit.metres;
        let joints: Vec<JointId> = m.joints_in(StateId::FREE).collect();
        let links: Vec<LinkId> = m.link_ids().filter(|&l| l != m.frame_link()).collect();
        let width = 6 * joints.len() + m.couplings.len();
        let mut out = Twin {
            rows: vec![vec![0.0; width]; 6 * links.len()],
            right: vec![0.0; 6 * links.len()],
            couplings: m.couplings.len(),
            teeth: Vec::new(),
            joints: joints.clone(),
        };
        let row_of = |l: LinkId| links.iter().position(|&x| x == l).map(|n| 6 * n);
        let put = |rows: &mut Vec<Vec<f64>>, column: usize, p: Push| {
            let Some(first) = row_of(p.link) else { return };
            let turn = cross(p.at, p.force);
            for i in 0..3 {
                rows[first + i][column] += p.force[i];
                rows[first + 3 + i][column] += turn[i] + p.moment[i];
            }
        };
        let e = |i: usize| [0, 1, 2].map(|k| f64::from(u8::from(i == k)));
        for (n, &j) in joints.iter().enumerate() {
            let at = scale(to_vector(&m.joints[j].frame.point), metres);
            for i in 0..3 {
                for (link, sign) in m.joints[j].links.into_iter().zip([-1.0, 1.0]) {
                    let force = scale(e(i), sign);
                    let push = Push::new(link, force, at, [0.0; 3]);
                    put(&mut out.rows, 6 * n + i, push);
                    let push = Push::new(link, [0.0; 3], at, force);
                    put(&mut out.rows, 6 * n + 3 + i, push);
                }
            }
            for (f, slides, way) in freedoms(m, j) {
                if drives.contains(&(j, f)) {
                    continue;
                }
                let mut row = vec![0.0; width];
                for i in 0..3 {
                    row[6 * n + if slides { i } else { 3 + i }] = way[i];
                }
                out.rows.push(row);
                out.right.push(0.0);
            }
        }
        for (q, c) in m.couplings.iter().enumerate() {
            let column = 6 * joints.len() + q;
            let mesh = mesh(m, q);
            out.teeth.push(mesh.map(|x| x.3));
            if let Some((first, second, at, way)) = mesh {
                for (link, sign) in [(first, 1.0), (second, -1.0)] {
                    let force = scale(way, sign);
                    let push = Push::new(link, force, at, [0.0; 3]);
                    put(&mut out.rows, column, push);
                }
                continue;
            }
            // The unknown is what the second joint gets; no power is lost: of rates 1 and ratio.
            let slides =
                |n: usize| matches!(c.ends[n].freedom, Freedom::Tx | Freedom::Ty | Freedom::Tz);
            let si = |n: usize| if slides(n) { metres } else { 1.0 };
            let first = -c.ratio.to_f64() * si(1) / si(0);
            for (n, size) in [(0, first), (1, 1.0)] {
                let j = c.ends[n].joint;
                let all = freedoms(m, j);
                let way = all.iter().find(|f| f.0 == c.ends[n].freedom).unwrap().2;
                let at = scale(to_vector(&m.joints[j].frame.point), metres);
                for (link, sign) in m.joints[j].links.into_iter().zip([-size, size]) {
                    let (along, none) = (scale(way, sign), [0.0; 3]);
                    let (force, moment) = if slides(n) {
                        (along, none)
                    } else {
                        (none, along)
                    };
                    put(&mut out.rows, column, Push::new(link, force, at, moment));
                }
            }
        }
        for f in &m.loads.forces {
            let first = row_of(f.link).unwrap();
            let (at, force) = (scale(to_vector(&f.point), metres), to_vector(&f.force));
            let turn = cross(at, force);
            for i in 0..3 {
                out.right[first + i] -= force[i];
                out.right[first + 3 + i] -= turn[i];
            }
        }
        for x in &m.loads.moments {
            let first = row_of(x.link).unwrap();
            (0..3).for_each(|i| out.right[first + 3 + i] -= to_vector(&x.moment)[i]);
        }
        out
    }

    /// What a solution says of the unknowns.
    pub(super) fn unknowns(&self, s: &Solution) -> Vec<f64> {
        let mut out = Vec::new();
        for j in &self.joints {
            let r = s.reactions.iter().find(|r| r.joint == *j).unwrap();
            out.extend(r.global_force());
            out.extend(r.global_moment());
        }
        for (q, way) in self.teeth.iter().enumerate() {
            let found = &s.couplings[q];
            out.push(match way {
                Some(way) => dot(found.teeth.expect("teeth").force, *way),
                None => found.efforts[1],
            });
            assert_eq!(way.is_some(), found.teeth.is_some(), "coupling {q}");
        }
        assert_eq!(s.couplings.len(), self.couplings);
        out
    }

    /// The most that unknowns leave over in an equation, over the greatest load.
    pub(super) fn left_over(&self, x: &[f64]) -> f64 {
        let greatest = self.right.iter().fold(0.0, |a: f64, r| a.max(r.abs()));
        let each = self.rows.iter().zip(&self.right).map(|(row, right)| {
            let sum: f64 = row.iter().zip(x).map(|(a, x)| a * x).sum();
            (sum - right).abs()
        });
        each.fold(0.0, f64::max) / greatest
    }

    /// The solution by elimination with complete pivoting, and how many unknowns are left open, which are 0 in it.
    pub(super) fn solved(&self) -> (Vec<f64>, usize) {
        let (mut a, mut b) = (self.rows.clone(), self.right.clone());
        let width = a[0].len();
        let mut columns: Vec<usize> = (0..width).collect();
        let mut rank = 0;
        while rank < a.len().min(width) {
            let mut best = (rank, rank, 0.0);
            for (r, row) in a.iter().enumerate().skip(rank) {
                for (c, &at) in columns.iter().enumerate().skip(rank) {
                    if row[at].abs() > best.2 {
                        best = (r, c, row[at].abs());
                    }
                }
            }
            if best.2 < 1e-10 {
                break;
            }
            a.swap(rank, best.0);
            b.swap(rank, best.0);
            columns.swap(rank, best.1);
            let (pivot, at) = (a[rank].clone(), columns[rank]);
            for r in rank + 1..a.len() {
                let factor = a[r][at] / pivot[at];
                for (x, p) in a[r].iter_mut().zip(&pivot) {
                    *x -= factor * p;
                }
                b[r] -= factor * b[rank];
            }
            rank += 1;
        }
        let mut x = vec![0.0; width];
        for r in (0..rank).rev() {
            let rest: f64 = (r + 1..rank)
                .map(|c| a[r][columns[c]] * x[columns[c]])
                .sum();
            x[columns[r]] = (b[r] - rest) / a[r][columns[r]];
        }
        (x, width - rank)
    }
}
