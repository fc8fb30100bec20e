//! What a layout looks like, and how well it moves: the figures by which it is judged.

use crate::chains::layout_symmetry::{Input, Symmetry};
use crate::geom::vector::{add_scaled, cross_plane, dot, length, sub};
use crate::synthesis::rules::Rules;
use crate::synthesis::structure::Structure;
use crate::synthesis::velocities::{Velocity, velocities};

/// A point of the plane, in millimetres.
pub type Point = [f64; 2];

/// Where the tips of the jaws are: far in front, and apart by the part that is held.
pub const REACH: f64 = 120.0;
/// Half of the drawn opening.
pub const HALF_OPENING: f64 = 15.0;
/// Pins nearer to each other than this run into each other.
const NEAR: f64 = 14.0;
/// Links longer than this are long.
const LONG: f64 = 75.0;
/// A pin nearer than this to a link that it is no part of lies on it.
const ON: f64 = 6.0;

/// What a layout must be like to be taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// The longest link over the shortest, the frame left out.
    pub ratio: f64,
    /// The worst transmission angle of a rod, in degrees.
    pub transmission: f64,
    /// Crossings of links, and pins that lie on links that they are no part of.
    pub crossings: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Limits {
            ratio: 8.0,
            transmission: 15.0,
            crossings: 6,
        }
    }
}

/// Figures of a layout at the pose it is drawn in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Looks {
    /// Crossings of links, and pins on links that they are no part of.
    pub crossings: usize,
    /// The longest distance of two pins of a link over the shortest, the frame left out.
    pub ratio: f64,
    /// The least angle between a rod and the motion across it at its ends: 90° is best, 0 is a dead point. In degrees; 90
    /// where there are no rods.
    pub transmission: f64,
    /// How fast the tips approach each other for a unit of the drive: millimetres a millimetre or a radian.
    pub closing: f64,
    /// Share of the tips' motion that closes them.
    pub straightness: f64,
    /// How the two tips move as they close, for a unit of the drive.
    pub tips: [Point; 2],
    /// What the places cost besides, 0 at best.
    pub penalty: f64,
}

/// The tips of the two jaws.
#[must_use]
pub fn tips(structure: &Structure) -> [Point; 2] {
    match structure.form.symmetry {
        // The part lies over the centre, and the jaws beside it.
        Symmetry::HalfTurn => [[0.0, HALF_OPENING], [0.0, -HALF_OPENING]],
        Symmetry::Generic | Symmetry::Mirror => [[REACH, HALF_OPENING], [REACH, -HALF_OPENING]],
    }
}

/// Each link with the places of its pins, those of a jaw with its tip; each by its number, those of the tips last.
#[must_use]
pub fn outlines(structure: &Structure, rules: &Rules, at: &[Point]) -> Vec<Vec<(usize, Point)>> {
    let mut out = vec![Vec::new(); structure.chain.links()];
    for (i, &(u, v)) in rules.pins.iter().enumerate() {
        out[u].push((i, at[i]));
        out[v].push((i, at[i]));
    }
    for (n, (&jaw, tip)) in structure.roles.jaws.iter().zip(tips(structure)).enumerate() {
        out[jaw].push((rules.pins.len() + n, tip));
    }
    out
}

/// The edges of the convex hull of points, by their numbers.
#[must_use]
pub fn hull(points: &[(usize, Point)]) -> Vec<[(usize, Point); 2]> {
    if let [a, b] = points {
        return vec![[*a, *b]];
    }
    let mut edges = Vec::new();
    for &a in points {
        for &b in points.iter().filter(|b| b.0 != a.0) {
            let side = |c: &(usize, Point)| cross_plane(sub(b.1, a.1), sub(c.1, a.1));
            // All others on the left: an edge of the hull, once round.
            if points
                .iter()
                .all(|c| c.0 == a.0 || c.0 == b.0 || side(c) > 0.0)
            {
                edges.push([a, b]);
            }
        }
    }
    edges
}

fn crosses([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let side = |p: Point, q: Point, r: Point| cross_plane(sub(q, p), sub(r, p)) > 0.0;
    side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b)
}

fn distance(p: Point, [a, b]: [Point; 2]) -> f64 {
    let (along, to) = (sub(b, a), sub(p, a));
    let t = (dot(to, along) / dot(along, along).max(1e-9)).clamp(0.0, 1.0);
    length(sub(to, [along[0] * t, along[1] * t]))
}

/// Pins whose coordinates differ by less than this are nearly in line.
const ALIGNED: f64 = 2.5;

/// How far a number is beyond a limit, squared, in units of a width.
fn beyond(over: f64, width: f64) -> f64 {
    (over.max(0.0) / width).powi(2)
}

/// The figures of places, with `moving` those of its velocities; `None` where the pose is singular.
///
/// # Complexity
/// O(p²) for p pins, and O(n³) for n links where velocities are asked for.
#[must_use]
pub fn looks(structure: &Structure, rules: &Rules, at: &[Point], moving: bool) -> Option<Looks> {
    let outlines = outlines(structure, rules, at);
    let frame = structure.roles.frame;
    let mut penalty = 0.0;
    let mut all: Vec<(usize, Point)> = at.iter().copied().enumerate().collect();
    all.extend(
        tips(structure)
            .into_iter()
            .enumerate()
            .map(|(n, p)| (at.len() + n, p)),
    );
    for (i, a) in all.iter().enumerate() {
        for b in &all[..i] {
            penalty += 4.0 * beyond(NEAR - length(sub(a.1, b.1)), NEAR);
        }
    }
    // Pins level with each other, or square above each other, have an axis in common: a special place that costs redesigns.
    for (i, a) in at.iter().enumerate() {
        for (j, b) in at[..i].iter().enumerate() {
            let forced = rules.follows(i) || rules.follows(j);
            for k in (0..2).filter(|_| !forced) {
                penalty += 0.5 * beyond(ALIGNED - (a[k] - b[k]).abs(), ALIGNED);
            }
        }
    }
    let (mut longest, mut shortest) = (0.0_f64, f64::INFINITY);
    let mut edges = Vec::new();
    for (l, points) in outlines.iter().enumerate().filter(|(l, _)| *l != frame) {
        for (i, a) in points.iter().enumerate() {
            for b in &points[..i] {
                let d = length(sub(a.1, b.1));
                (longest, shortest) = (longest.max(d), shortest.min(d));
                penalty += beyond(d - LONG, 25.0) + beyond(18.0 - d, 10.0);
            }
        }
        edges.extend(hull(points).into_iter().map(|[a, b]| (l, [a, b])));
    }
    let mut crossings = 0;
    for (i, (l, [a, b])) in edges.iter().enumerate() {
        for (m, [c, d]) in &edges[..i] {
            let apart = l != m && [a.0, b.0].iter().all(|p| *p != c.0 && *p != d.0);
            crossings += usize::from(apart && crosses([a.1, b.1], [c.1, d.1]));
        }
        for (p, place) in &all {
            let own = outlines[*l].iter().any(|(q, _)| q == p);
            let near = distance(*place, [a.1, b.1]);
            if !own && near < ON {
                crossings += 1;
                penalty += beyond(ON - near, ON);
            }
        }
    }
    #[allow(clippy::cast_precision_loss, reason = "a few")]
    let count = crossings as f64;
    penalty += 1.5 * count;
    penalty += places(structure, &outlines, at);
    let mut out = Looks {
        crossings,
        ratio: longest / shortest,
        transmission: 90.0,
        closing: 0.0,
        straightness: 1.0,
        tips: [[0.0; 2]; 2],
        penalty,
    };
    if moving {
        let velocities = velocities(structure, rules, at)?;
        motion(structure, &outlines, &velocities, &mut out);
    }
    Some(out)
}

/// The frame behind, the jaws in front, pins beside the middle.
fn places(structure: &Structure, outlines: &[Vec<(usize, Point)>], at: &[Point]) -> f64 {
    let mut penalty = 0.0;
    if structure.form.symmetry == Symmetry::HalfTurn {
        return at.iter().map(|p| beyond(length(*p) - 80.0, 25.0)).sum();
    }
    for (_, [x, _]) in &outlines[structure.roles.frame] {
        penalty += beyond(x - 50.0, 25.0) + beyond(-x, 25.0);
    }
    for [x, y] in at {
        // Nothing but the tips is where the part is.
        penalty += beyond(x - 95.0, 10.0);
        penalty += beyond(y.abs() - 60.0, 25.0) + beyond(-x, 25.0);
    }
    for (n, &jaw) in structure.roles.jaws.iter().enumerate() {
        let sign = if n == 0 { 1.0 } else { -1.0 };
        for (_, [x, y]) in &outlines[jaw] {
            penalty += beyond(30.0 - x, 25.0) + 0.3 * beyond(-sign * y, 25.0);
        }
    }
    penalty
}

/// The figures of a motion, and what they cost.
fn motion(
    structure: &Structure,
    outlines: &[Vec<(usize, Point)>],
    velocities: &[Velocity],
    out: &mut Looks,
) {
    let [a, b] = [structure.roles.jaws[0], structure.roles.jaws[1]].map(|j| velocities[j]);
    let [p, q] = tips(structure);
    let (va, vb) = (a.at(p), b.at(q));
    out.closing = (vb[1] - va[1]).abs();
    let closes = (vb[1] - va[1]).signum();
    out.tips = [va, vb].map(|v| v.map(|x| closes * x));
    let all = length(va) + length(vb);
    out.straightness = out.closing / all.max(1e-12);
    if va[1] * vb[1] >= 0.0 {
        // Both go the same way: one of them runs after the other.
        out.straightness = 0.0;
    }
    let even = (va[1] / vb[1]).abs().max(1e-9).ln().abs();
    out.penalty += 8.0 * beyond(0.8 - out.straightness, 0.8) + 0.5 * beyond(even - 0.5, 1.0);
    // The drive: a millimetre for half to four millimetres of closing, a radian for 15 to 120.
    let drive = match structure.form.input {
        Input::Slide => out.closing,
        Input::Turn => out.closing / 30.0,
    };
    out.penalty += beyond((drive.max(1e-9) / 1.5).ln().abs() - 0.9, 0.5).min(20.0);
    let fastest = velocities
        .iter()
        .map(|v| v.turning.abs())
        .fold(0.0, f64::max);
    out.penalty += beyond(fastest * 40.0 / out.closing.max(1e-9) - 2.0, 1.5).min(20.0);
    for (l, points) in outlines.iter().enumerate() {
        let rod = l != structure.roles.driver && l != structure.roles.frame;
        if let ([(_, a), (_, b)], true) = (&points[..], rod) {
            let along = sub(*b, *a);
            let (va, vb) = (velocities[l].at(*a), velocities[l].at(*b));
            let speed = length(va).max(length(vb));
            // Along the rod both ends are equally fast. A rod from the frame pulls nothing: its end goes across it.
            let least = length(va).min(length(vb));
            if least < 1e-6 * speed.max(1e-9) {
                continue;
            }
            let sine = (dot(va, along) / length(along).max(1e-9) / speed.max(1e-12)).abs();
            out.transmission = out.transmission.min(sine.min(1.0).asin().to_degrees());
        }
    }
    out.penalty += beyond(40.0 - out.transmission, 20.0);
}

/// The middle of points.
#[must_use]
pub fn middle(points: &[Point]) -> Point {
    #[allow(clippy::cast_precision_loss, reason = "a few")]
    let n = points.len().max(1) as f64;
    points
        .iter()
        .fold([0.0, 0.0], |m, p| add_scaled(m, 1.0 / n, *p))
}
