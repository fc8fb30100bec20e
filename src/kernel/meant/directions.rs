//! The written directions of a scene, with parallel ones merged.
//!
//! Directions are less accurate than points. An axis of six decimals leaves 5e-7 rad, over 150 mm
//! a hundred times what the points leave. So a direction is turned, within its own digits, to where most pairs of
//! points lie along it or perpendicular to it.

use super::written::{PointPair, Written, distinct_pairs};
use crate::geom::vector::{Vector, X, Y, Z, add_scaled, cross, dot, length, scale, unit};
use itertools::Itertools;

/// Maximum move of a direction's components, in halves of their last digit. Such a direction is fitted, not solved for.
pub(crate) const WITHIN: f64 = 1.1;

/// A direction of a scene.
#[derive(Debug, Clone)]
pub(super) struct Direction {
    pub(super) unit: Vector,
    /// Its possible error `[rad]`.
    pub(super) error: f64,
    /// Number of rays with this direction; 0 if only points define it.
    pub(super) rays: usize,
    /// The ray that gives it exactly, if it is written exactly.
    pub(super) exact: Option<usize>,
    /// Two axes of possible turns, with the error of each `[rad]`.
    pub(super) tilts: [(Vector, f64); 2],
}

/// Directions, and the direction and sign of each ray.
pub(super) struct Directions {
    pub(super) all: Vec<Direction>,
    pub(super) of_ray: Vec<(usize, f64)>,
}

/// Merges rays that are parallel within their errors into one direction, refined by the points.
pub(super) fn of_rays(rays: &[Written], points: &[Vector], errors: &[f64]) -> Directions {
    let pairs = distinct_pairs(points, errors);
    let mut order: Vec<usize> = (0..rays.len()).collect();
    // The most accurate come first, so that others are compared with them.
    order.sort_by(|&a, &b| rays[a].angular_error().total_cmp(&rays[b].angular_error()));
    let (mut all, mut of_ray) = (Vec::<Direction>::new(), vec![(0, 1.0); rays.len()]);
    let mut sums: Vec<Vector> = Vec::new();
    for i in order {
        let (v, error) = (rays[i].unit_vector(), rays[i].angular_error());
        let weight = if error > 0.0 { error.powi(-2) } else { 0.0 };
        let near = |d: &Direction| length(cross(d.unit, v)) <= 1.05 * (d.error + error);
        let nearest = |a: &usize, b: &usize| {
            let off = |k: &usize| length(cross(all[*k].unit, v));
            off(a).total_cmp(&off(b))
        };
        let known = (0..all.len()).filter(|&k| near(&all[k])).min_by(nearest);
        if let Some(k) = known {
            let sign = dot(all[k].unit, v).signum();
            of_ray[i] = (k, sign);
            all[k].rays += 1;
            sums[k] = add_scaled(sums[k], sign * weight, v);
        } else {
            of_ray[i] = (all.len(), 1.0);
            all.push(Direction {
                unit: v,
                error,
                rays: 1,
                exact: rays[i].is_exact().then_some(i),
                tilts: square_to(v).map(|e| (e, error)),
            });
            sums.push(scale(v, weight));
        }
    }
    let allowed = digits_allow(rays, &of_ray);
    for (k, (d, sum)) in all.iter_mut().zip(sums).enumerate() {
        if d.exact.is_none() {
            d.unit = unit(sum);
            refine_direction(d, &pairs, |v| allowed(k, v));
        }
    }
    Directions { all, of_ray }
}

/// Returns a test whether the digits of the rays of a direction allow another direction. `of_ray` has the direction of
/// each ray.
pub(super) fn digits_allow<'a>(
    rays: &'a [Written],
    of_ray: &[(usize, f64)],
) -> impl Fn(usize, Vector) -> bool + use<'a> {
    let of_direction = of_ray.iter().map(|(k, _)| *k).zip(rays);
    let of_direction = of_direction.into_group_map();
    move |k, v| {
        let mut own = of_direction.get(&k).into_iter().flatten();
        own.all(|ray| ray.move_to(v, 0.0) <= WITHIN)
    }
}

impl Direction {
    /// Creates a direction defined by points.
    pub(super) fn of_points(unit: Vector, error: f64) -> Direction {
        Direction {
            unit,
            error,
            rays: 0,
            exact: None,
            tilts: square_to(unit).map(|e| (e, error)),
        }
    }
}

impl Directions {
    /// Adds the file's own axes as exact directions, if they are missing.
    pub(super) fn add_axes(&mut self) {
        for e in [X, Y, Z] {
            if self.all.iter().any(|d| length(cross(d.unit, e)) == 0.0) {
                continue;
            }
            self.all.push(Direction::of_points(e, 0.0));
        }
    }
}

/// Number of pairs that form hypotheses.
const TRIED: usize = 48;

/// Equation of a pair for a small turn (a, b) of the direction: approximately r0 a + r1 b = r2.
struct TurnEquation {
    row: [f64; 3],
    error: f64,
}

/// Equations of all pairs for a direction: one line if a pair is perpendicular to it, two if it is along it.
struct Evidence {
    lines: Vec<TurnEquation>,
    /// First line and number of lines of each pair.
    pairs: Vec<(usize, usize)>,
}

/// A turn suggested by the evidence, with its error ellipse: the angle of its short axis, and both axes.
struct TurnEstimate {
    turn: [f64; 2],
    angle: f64,
    errors: [f64; 2],
}

impl TurnEstimate {
    fn tilt_axes(&self, [a, b]: [Vector; 2]) -> [(Vector, f64); 2] {
        let (s, c) = self.angle.sin_cos();
        let turned = |x: f64, y: f64| add_scaled(a.map(|v| x * v), y, b);
        [
            (turned(c, s), self.errors[0]),
            (turned(-s, c), self.errors[1]),
        ]
    }
}

/// Returns two unit vectors perpendicular to a third and to each other.
fn square_to(v: Vector) -> [Vector; 2] {
    let least = [X, Y, Z]
        .into_iter()
        .min_by(|a, b| dot(*a, v).abs().total_cmp(&dot(*b, v).abs()))
        .unwrap_or(X);
    let first = unit(cross(v, least));
    [first, cross(v, first)]
}

fn gather_evidence(v: Vector, error: f64, [e1, e2]: [Vector; 2], pairs: &[PointPair]) -> Evidence {
    let mut out = Evidence {
        lines: Vec::new(),
        pairs: Vec::new(),
    };
    for p in pairs {
        let w = p.along;
        let wide = 1.1 * p.length * error + p.error;
        let first = out.lines.len();
        if dot(v, w).abs() < wide {
            out.lines.push(TurnEquation {
                row: [dot(e1, w), dot(e2, w), -dot(v, w)],
                error: p.error,
            });
        } else if length(cross(v, w)) < wide {
            let sign = dot(v, w).signum();
            for (k, e) in [e1, e2].into_iter().enumerate() {
                let mut row = [0.0, 0.0, sign * dot(e, w)];
                row[k] = p.length;
                out.lines.push(TurnEquation {
                    row,
                    error: p.error,
                });
            }
        }
        if out.lines.len() > first {
            out.pairs.push((first, out.lines.len() - first));
        }
    }
    out
}

impl Evidence {
    /// Returns the lines of the pairs that agree with a turn.
    fn agreeing_lines(&self, [a, b]: [f64; 2]) -> impl Iterator<Item = &TurnEquation> + '_ {
        let fits =
            move |l: &&TurnEquation| (l.row[0] * a + l.row[1] * b - l.row[2]).abs() <= l.error;
        self.pairs.iter().flat_map(move |&(first, n)| {
            let lines = &self.lines[first..first + n];
            let all = lines.iter().all(|l| fits(&l));
            lines.iter().take(if all { n } else { 0 })
        })
    }

    fn count_support(&self, turn: [f64; 2]) -> usize {
        self.agreeing_lines(turn).count()
    }

    /// Returns the turn fitted to the lines that agree with a given one, and its error. `prior` is the error of the
    /// direction's digits.
    fn fit_turn(&self, turn: [f64; 2], prior: f64) -> Option<TurnEstimate> {
        let (mut m, mut g) = ([[prior.powi(-2), 0.0], [0.0, prior.powi(-2)]], [0.0; 2]);
        for l in self.agreeing_lines(turn) {
            let weight = l.error.powi(-2);
            for (i, (m, g)) in m.iter_mut().zip(&mut g).enumerate() {
                m[0] += weight * l.row[i] * l.row[0];
                m[1] += weight * l.row[i] * l.row[1];
                *g += weight * l.row[i] * l.row[2];
            }
        }
        let det = m[0][0] * m[1][1] - m[0][1] * m[1][0];
        let x = [
            (g[0] * m[1][1] - g[1] * m[0][1]) / det,
            (m[0][0] * g[1] - m[1][0] * g[0]) / det,
        ];
        // The axes of the error ellipse.
        let (half, diff) = (
            f64::midpoint(m[0][0], m[1][1]),
            f64::midpoint(m[0][0], -m[1][1]),
        );
        let radius = diff.hypot(m[0][1]);
        let angle = m[0][1].atan2(diff) / 2.0;
        let error = |info: f64| info.max(prior.powi(-2)).sqrt().recip();
        let errors = [error(half + radius), error(half - radius)];
        (x[0].is_finite() && x[1].is_finite()).then_some(TurnEstimate {
            turn: x,
            angle,
            errors,
        })
    }

    /// Returns candidate turns from single pairs along the direction, and from two pairs perpendicular to it.
    fn candidate_turns(&self) -> Vec<[f64; 2]> {
        let mut out = vec![[0.0; 2]];
        let mut square: Vec<&TurnEquation> = Vec::new();
        for &(first, n) in &self.pairs {
            if n == 2 {
                let l = &self.lines[first..first + 2];
                if out.len() < TRIED {
                    out.push([l[0].row[2] / l[0].row[0], l[1].row[2] / l[1].row[1]]);
                }
            } else if square.len() < TRIED {
                square.push(&self.lines[first]);
            }
        }
        for (i, a) in square.iter().enumerate() {
            let norm = a.row[0].hypot(a.row[1]);
            let foot = a.row[2] / norm.powi(2);
            out.push([foot * a.row[0], foot * a.row[1]]);
            for b in &square[..i] {
                let det = a.row[0] * b.row[1] - a.row[1] * b.row[0];
                if det.abs() > 0.05 * norm * b.row[0].hypot(b.row[1]) {
                    out.push([
                        (a.row[2] * b.row[1] - a.row[1] * b.row[2]) / det,
                        (a.row[0] * b.row[2] - a.row[2] * b.row[0]) / det,
                    ]);
                }
            }
        }
        out
    }
}

/// Turns a direction, within its error, to the allowed one that most pairs of points support. An axis of the file wins a tie.
///
/// # Complexity
/// O(p²) hypotheses of at most 48² pairs, each compared with O(p²) pairs of p points.
fn refine_direction(d: &mut Direction, pairs: &[PointPair], allowed: impl Fn(Vector) -> bool) {
    let (v, error) = (d.unit, d.error);
    let across = square_to(v);
    d.tilts = across.map(|e| (e, error));
    if error == 0.0 {
        return;
    }
    let found = gather_evidence(v, error, across, pairs);
    let turned = |t: &[f64; 2]| unit(add_scaled(add_scaled(v, t[0], across[0]), t[1], across[1]));
    let within = |t: &[f64; 2]| t[0].hypot(t[1]) <= 1.1 * error && allowed(turned(t));
    let axes = [X, Y, Z].map(|e| if dot(e, v) < 0.0 { e.map(|x| -x) } else { e });
    let axis = axes.into_iter().find(|e| length(cross(*e, v)) <= error);
    let own = axis.map(|e| across.map(|a| dot(a, e)));
    let mut best = ([0.0; 2], 0);
    for turn in own
        .into_iter()
        .chain(found.candidate_turns())
        .filter(within)
    {
        let support = found.count_support(turn);
        if support > best.1 {
            best = (turn, support);
        }
    }
    if let (Some(axis), Some(turn)) = (axis, own)
        && found.count_support(turn) == best.1
    {
        // An axis of the file stays unchanged, even if other directions are near.
        (d.unit, d.error) = (axis, 0.0);
        d.tilts = across.map(|e| (e, 0.0));
        return;
    }
    let (mut turn, mut left) = (best.0, None);
    for _ in 0..4 {
        if let Some(fit) = found.fit_turn(turn, error).filter(|f| within(&f.turn)) {
            if found.count_support(fit.turn) + 2 < best.1 {
                break;
            }
            turn = fit.turn;
            left = Some(fit);
        }
    }
    d.unit = turned(&turn);
    if let Some(fit) = left {
        (d.error, d.tilts) = (fit.errors[1], fit.tilt_axes(across));
    }
}
