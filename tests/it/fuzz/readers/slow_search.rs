//! Every variant of a small mechanism looked at by itself, from the definitions and in rational arithmetic: what a search must agree
//! with. It shares no code with the searches of the program.

use crate::common::*;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};
use ozols::model::joint_type::CoupledFreedom;
use ozols::model::mechanism::Frame;
use ozols::search::question::conditions::InState;

pub(crate) type Q = BigRational;

fn cross(a: &[Q], b: &[Q]) -> Vec<Q> {
    let m = |i: usize, j: usize| &a[i] * &b[j] - &a[j] * &b[i];
    vec![m(1, 2), m(2, 0), m(0, 1)]
}

pub(crate) fn dot(a: &[Q], b: &[Q]) -> Q {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn value(v: &[Expr; 3]) -> Vec<Q> {
    v.iter().map(|e| e.as_rational().unwrap()).collect()
}

/// Axes z, x, y of a frame, from the conventions of the design: z the axis, x the reference made perpendicular, y = z × x.
pub(crate) fn axes(frame: &Frame) -> [Vec<Q>; 3] {
    let (z, r) = (value(&frame.axis), value(&frame.reference));
    let (zz, zr) = (dot(&z, &z), dot(&z, &r));
    let x: Vec<Q> = (0..3).map(|i| &r[i] * &zz - &z[i] * &zr).collect();
    let y = cross(&z, &x);
    [z, x, y]
}

/// The length of the axis of a freedom, which must be rational.
pub(crate) fn length(frame: &Frame, freedom: Freedom) -> Q {
    let [z, x, y] = axes(frame);
    let along = match freedom {
        Freedom::Rz | Freedom::Tz | Freedom::Screw => z,
        Freedom::Rx | Freedom::Tx => x,
        Freedom::Ry | Freedom::Ty => y,
    };
    let square = dot(&along, &along);
    let root = Q::new(square.numer().sqrt(), square.denom().sqrt());
    assert_eq!(&root * &root, square, "an axis of irrational length");
    root
}

/// Twists of a joint.
pub(crate) fn twists(frame: &Frame, kind: &JointType) -> Vec<Vec<Q>> {
    let p = value(&frame.point);
    let [z, x, y] = axes(frame);
    let turn = |u: &Vec<Q>| [u.clone(), cross(&p, u)].concat();
    let slide = |u: &Vec<Q>| [vec![Q::zero(); 3], u.clone()].concat();
    let one = |f: &Freedom| match f {
        Freedom::Rx => turn(&x),
        Freedom::Ry => turn(&y),
        Freedom::Rz => turn(&z),
        Freedom::Tx => slide(&x),
        Freedom::Ty => slide(&y),
        Freedom::Tz => slide(&z),
        Freedom::Screw => {
            let pitch = frame.pitch.as_rational().unwrap();
            let turned = turn(&z);
            let slid = slide(&z.iter().map(|c| c * &pitch).collect());
            turned.iter().zip(&slid).map(|(a, b)| a + b).collect()
        }
    };
    kind.freedoms().iter().map(one).collect()
}

/// What a joint's twists span of the motions in the plane of a planar mechanism; all of them in space.
pub(crate) fn allowed_twists(mode: &Mode, frame: &Frame, kind: &JointType) -> Vec<Vec<Q>> {
    let all = twists(frame, kind);
    let Mode::Planar { normal } = mode else {
        return all;
    };
    let n = value(normal);
    // What leads out of the plane stands first, so that rows with zeros there stay in it.
    let row = |t: Vec<Q>| {
        let out = [cross(&t[..3], &n), vec![dot(&t[3..], &n)]].concat();
        [out, t].concat()
    };
    reduce(all.into_iter().map(row).collect())
        .into_iter()
        .filter(|row| row[..4].iter().all(Zero::is_zero))
        .map(|row| row[4..].to_vec())
        .collect()
}

/// Rows that say the same, each with its first entry further to the right than those before.
pub(crate) fn reduce(mut rows: Vec<Vec<Q>>) -> Vec<Vec<Q>> {
    let (width, mut done) = (rows.first().map_or(0, Vec::len), 0);
    for c in 0..width {
        let Some(i) = (done..rows.len()).find(|&i| !rows[i][c].is_zero()) else {
            continue;
        };
        rows.swap(done, i);
        let (above, below) = rows.split_at_mut(done + 1);
        let own = &above[done];
        for row in below.iter_mut().filter(|row| !row[c].is_zero()) {
            let a = &row[c] / &own[c];
            let both = row.iter_mut().zip(own);
            both.filter(|(_, y)| !y.is_zero())
                .for_each(|(x, y)| *x -= &a * y);
        }
        done += 1;
    }
    rows.truncate(done);
    rows
}

#[test]
fn the_rational_elimination_is_right_on_a_known_matrix() {
    let q = |n: i64| Q::from_integer(BigInt::from(n));
    let reduced = reduce(vec![
        vec![q(1), q(2), q(3)],
        vec![q(2), q(4), q(7)],
        vec![q(3), q(6), q(10)],
    ]);
    assert_eq!(reduced, [[q(1), q(2), q(3)], [q(0), q(0), q(1)]]);
}

/// Joint motion written out with a twist for every link: unknowns are link twists and joint speeds; each joint demands
/// t_b - t_a = Σ speeds · twists, and the frame rests; `coupled` are sums of two speeds with factors that must vanish. No
/// contours, no spanning tree. `driven` are speeds whose motion counts beside that of the outputs.
pub(crate) struct Figures {
    pub(crate) mobility: usize,
    pub(crate) freedoms: usize,
    pub(crate) motion: usize,
    /// Whether each of some pairs of links moves as one.
    pub(crate) together: Vec<bool>,
}

pub(crate) fn figures(
    links: usize,
    frame: LinkId,
    joints: &[([LinkId; 2], Vec<Vec<Q>>)],
    coupled: &[[(usize, Q); 2]],
    outputs: &[LinkId],
    driven: &[usize],
    pairs: &[(LinkId, LinkId)],
) -> Figures {
    let freedoms: usize = joints.iter().map(|(_, t)| t.len()).sum();
    let width = links * 6 + freedoms;
    let mut rows = Vec::new();
    let mut at = links * 6;
    for ([a, b], columns) in joints {
        for c in 0..6 {
            let mut row = vec![Q::zero(); width];
            row[b.index() * 6 + c] += Q::one();
            row[a.index() * 6 + c] -= Q::one();
            for (i, t) in columns.iter().enumerate() {
                row[at + i] -= &t[c];
            }
            rows.push(row);
        }
        at += columns.len();
    }
    for entries in coupled {
        let mut row = vec![Q::zero(); width];
        for (column, factor) in entries {
            row[links * 6 + column] += factor;
        }
        rows.push(row);
    }
    let rest = |l: LinkId, c: usize| {
        let mut row = vec![Q::zero(); width];
        row[l.index() * 6 + c] = Q::one();
        row
    };
    rows.extend((0..6).map(|c| rest(frame, c)));
    // Links that no joint holds in this state rest too.
    let held = |l: LinkId| joints.iter().any(|(ends, _)| ends.contains(&l));
    rows.extend(
        LinkId::first(links)
            .filter(|&l| l != frame && !held(l))
            .flat_map(|l| (0..6).map(move |c| (l, c)))
            .map(|(l, c)| rest(l, c)),
    );
    // What comes to these rows is reduced beside what is left of them.
    let mut rows = reduce(rows);
    let all = rows.len();
    let together = |&(a, b): &(LinkId, LinkId)| {
        let mut more = rows.clone();
        more.extend((0..6).map(|c| {
            let mut row = rest(a, c);
            row[b.index() * 6 + c] -= Q::one();
            row
        }));
        reduce(more).len() == all
    };
    let together = pairs.iter().map(together).collect();
    rows.extend(
        outputs
            .iter()
            .flat_map(|&l| (0..6).map(move |c| (l, c)))
            .map(|(l, c)| rest(l, c)),
    );
    rows.extend(driven.iter().map(|column| {
        let mut row = vec![Q::zero(); width];
        row[links * 6 + column] = Q::one();
        row
    }));
    let resting = reduce(rows).len();
    Figures {
        mobility: width - all,
        freedoms,
        motion: resting - all,
        together,
    }
}

/// A choice at a joint: an option, and what is put in series.
pub(crate) type Choice = (usize, Option<usize>);

/// What the contacts of the clamped state transmit.
#[derive(Clone, Copy, PartialEq)]
enum Contacts {
    /// All they do.
    Whole,
    /// Faces: forces along them and moments; this one only a moment about its normal.
    Friction(JointId),
    /// Nothing.
    Nothing,
}

pub(crate) struct Twin {
    pub(crate) internal: u32,
    pub(crate) external: i32,
    /// Harmful redundant constraints among those that load contacts.
    pub(crate) harmful: u32,
    /// Whether the object moves with one of its jaws.
    pub(crate) held: bool,
    pub(crate) mobility: i64,
    pub(crate) motion: usize,
    pub(crate) changes: u32,
    pub(crate) freedoms: u32,
}

/// Looks at one variant: `choice[j]` is (option, unloading) of joint j.
pub(crate) fn look_at_variant(m: &Mechanism, clamped: bool, choice: &[Choice]) -> Twin {
    let outputs: Vec<LinkId> = m
        .link_ids()
        .filter(|&l| m.links[l].role == Role::Output || m.search.hold.contains(&l))
        .collect();
    let rows = match m.mode {
        Mode::Spatial => 6,
        Mode::Planar { .. } => 3,
    };
    let contacts: Vec<JointId> = m
        .joints_with_ids()
        .filter(|(_, j)| {
            j.states
                .as_ref()
                .is_some_and(|s| !s.contains(&StateId::FREE))
        })
        .map(|(j, _)| j)
        .collect();
    // In these files every contact is between a jaw and the object.
    let pairs: Vec<(LinkId, LinkId)> = contacts
        .iter()
        .map(|&j| (m.joints[j].links[0], m.joints[j].links[1]))
        .collect();
    let of = |state: StateId, carried: Contacts| {
        // An unloading joint is a joint in series with an extra link at the end of the list.
        let mut links = m.links.len();
        let mut joints: Vec<([LinkId; 2], Vec<Vec<Q>>)> = Vec::new();
        // Where the columns of each joint's own option begin.
        let mut own = vec![None; m.joints.len()];
        for (j, joint) in m.joints_with_ids() {
            let present = m.joints_in(state).any(|x| x == j);
            let (option, unloading) = choice[j];
            let frame = &joint.options[option].frame;
            let kind = &joint.options[option].joint_type;
            let mut span = allowed_twists(&m.mode, frame, kind);
            let contact = contacts.contains(&j);
            let part = [Freedom::Tz, Freedom::Rx, Freedom::Ry];
            let whole = [part, [Freedom::Rz, Freedom::Tx, Freedom::Ty]].concat();
            match carried {
                Contacts::Friction(face) if contact && *kind == JointType::Fixed => {
                    let more = &part[..if face == j { 3 } else { 1 }];
                    span = twists(frame, &JointType::Custom(more.to_vec()));
                }
                Contacts::Nothing if contact => span = twists(frame, &JointType::Custom(whole)),
                _ => {}
            }
            match unloading {
                Some(u) => {
                    let pad = LinkId::new(links);
                    links += 1;
                    let pad_joint = &joint.unloading[u];
                    let extra = allowed_twists(&m.mode, &pad_joint.frame, &pad_joint.joint_type);
                    // The pad of a contact is there while nothing is held, that of another joint goes with it.
                    if present || contact {
                        joints.push(([joint.links[0], pad], extra));
                    }
                    if present {
                        own[j] = Some(joints.iter().map(|(_, t)| t.len()).sum::<usize>());
                        joints.push(([pad, joint.links[1]], span));
                    }
                }
                None if present => {
                    own[j] = Some(joints.iter().map(|(_, t)| t.len()).sum());
                    joints.push((joint.links, span));
                }
                None => {}
            }
        }
        // Rates are in units of length 1, whatever the axis.
        let entry = |e: CoupledFreedom| {
            let option = &m.joints[e.joint].options[choice[e.joint].0];
            let at = option
                .joint_type
                .freedoms()
                .iter()
                .position(|f| *f == e.freedom);
            Some((own[e.joint]? + at?, length(&option.frame, e.freedom)))
        };
        let coupled: Vec<[(usize, Q); 2]> = m
            .couplings
            .iter()
            .filter_map(|c| {
                let ((a, x), (b, y)) = (entry(c.ends[0])?, entry(c.ends[1])?);
                Some([(a, -c.ratio.as_rational()? * x), (b, y)])
            })
            .collect();
        let used: BTreeSet<LinkId> = joints.iter().flat_map(|(l, _)| *l).collect();
        let contours = joints.len() + 1 - used.len();
        let searched = if state == StateId::FREE {
            &[][..]
        } else {
            &pairs
        };
        // Options stand in the frame of the present joint, so that the driven freedom has the same name in each.
        let driven = m.joints_with_ids().filter_map(|(j, joint)| {
            let freedom = joint.driven_freedom()?;
            let kind = &joint.options[choice[j].0].joint_type;
            let at = kind.freedoms().iter().position(|f| *f == freedom)?;
            Some(own[j]? + at)
        });
        let driven: Vec<usize> = driven.filter(|_| state == StateId::FREE).collect();
        let f = figures(
            links,
            m.frame_link(),
            &joints,
            &coupled,
            &outputs,
            &driven,
            searched,
        );
        let sigma = f.mobility + rows * contours + coupled.len() - f.freedoms;
        (f, sigma as i32)
    };
    let whole = |state| of(state, Contacts::Whole);
    let (free, internal) = whole(StateId::FREE);
    let (mut external, mut harmful, mut held) = (0, 0, true);
    if clamped {
        let state = StateId::new(1);
        let (f, sigma) = whole(state);
        external = sigma - internal;
        held = f.together.iter().any(|t| *t);
        // Self-stresses that load contacts, and those of them that friction explains.
        let idle = of(state, Contacts::Nothing).1;
        let face = |j: &&JointId| {
            m.joints[**j].options[choice[j.index()].0].joint_type == JointType::Fixed
        };
        let faces = contacts.iter().filter(face);
        let harmless = faces
            .map(|&j| of(state, Contacts::Friction(j)).1 - idle)
            .max();
        harmful = (sigma - idle - harmless.unwrap_or(0)) as u32;
    }
    let changes = choice
        .iter()
        .map(|(o, u)| u32::from(*o != 0) + u32::from(u.is_some()))
        .sum();
    Twin {
        internal: internal as u32,
        external,
        harmful,
        held,
        mobility: free.mobility as i64,
        motion: free.motion,
        changes,
        freedoms: free.freedoms as u32,
    }
}

pub(crate) fn all_variants(m: &Mechanism, clamped: bool) -> Vec<Vec<Choice>> {
    let mut out = vec![Vec::new()];
    for (j, joint) in m.joints_with_ids() {
        let free = m.joints_in(StateId::FREE).any(|x: JointId| x == j);
        let choices: Vec<Choice> = if free || clamped {
            std::iter::once(None)
                .chain((0..joint.unloading.len()).map(Some))
                .flat_map(|u| (0..joint.options.len()).map(move |o| (o, u)))
                .collect()
        } else {
            vec![(0, None)]
        };
        out = out
            .into_iter()
            .flat_map(|v| choices.iter().map(move |&c| [v.clone(), vec![c]].concat()))
            .collect();
    }
    out
}

/// Whether a variant is what it must be in the searched state.
pub(crate) fn suits_state(state: Option<InState>, t: &Twin) -> bool {
    state.is_none_or(|s| {
        s.max_external.is_none_or(|most| t.external <= most as i32)
            && s.max_harmful.is_none_or(|most| t.harmful <= most)
            && (t.held || !s.hold_objects)
    })
}
