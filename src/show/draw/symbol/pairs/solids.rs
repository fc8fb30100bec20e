//! Solids that the two links of a joint are made of: convex faces, seen from outside where their corners run counter-clockwise.

use crate::draw::place::projection::Vector;
use crate::geom::vector::{add, cross, unit};
use crate::svg::plane::Point;
use std::f64::consts::TAU;

/// The piece of a joint that a face belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PairPart {
    /// One link.
    A,
    /// The other link.
    B,
    /// What is of neither: a cross, a bolt.
    Between,
}

/// A convex flat piece of a surface.
#[derive(Debug, Clone)]
pub(super) struct SolidFace {
    pub(super) points: Vec<Vector>,
    pub(super) part: PairPart,
    /// Whether it is where a solid is cut open.
    pub(super) cut: bool,
}

impl SolidFace {
    /// The direction it faces, with a length of twice its area.
    pub(super) fn normal(&self) -> Vector {
        let next = self.points.iter().cycle().skip(1);
        let all = self.points.iter().zip(next);
        all.fold([0.0; 3], |s, (&a, &b)| add(s, cross(a, b)))
    }
}

/// Several faces.
pub(super) type Solid = Vec<SolidFace>;

/// The half that is left where the other, towards the reader, is cut off by a plane through the axis z, in degrees.
pub(super) const HALF: [f64; 2] = [135.0, 315.0];
/// All round.
pub(super) const WHOLE: [f64; 2] = [0.0, 360.0];

/// A solid of uncut faces.
fn solid(part: PairPart, faces: impl Iterator<Item = Vec<Vector>>) -> Solid {
    let cut = false;
    faces
        .map(|points| SolidFace { points, part, cut })
        .collect()
}

/// A prism along z over a convex base whose corners run counter-clockwise.
pub(super) fn prism(part: PairPart, base: &[Point], [low, high]: [f64; 2]) -> Solid {
    let at = |z: f64| base.iter().map(move |p| [p[0], p[1], z]);
    let next = base.iter().cycle().skip(1);
    let sides = base.iter().zip(next).map(|(a, b)| {
        let on = |p: &Point, z| [p[0], p[1], z];
        vec![on(a, low), on(b, low), on(b, high), on(a, high)]
    });
    let ends = [at(high).collect(), at(low).rev().collect()];
    solid(part, ends.into_iter().chain(sides))
}

/// A box between two bounds of each coordinate.
pub(super) fn cuboid(part: PairPart, [x, y, z]: [[f64; 2]; 3]) -> Solid {
    let base = [[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]];
    prism(part, &base, z)
}

/// The outline of a bar with a round end at the origin, which goes so far along -y.
pub(super) fn lug(radius: f64, length: f64) -> Vec<Point> {
    let round = (0..=12).map(|i| {
        let angle = TAU / 24.0 * f64::from(i);
        [radius * angle.cos(), radius * angle.sin()]
    });
    let ends = [[-radius, -length], [radius, -length]];
    round.chain(ends).collect()
}

/// A solid of revolution about z between two angles in degrees, in so many steps: the profile is a strip between points
/// (distance from the axis, z) near the axis and as many far from it, from below to above. The faces where it is not all round
/// are cuts. `rise` is how far it climbs along z in a turn, between its lowest and its highest points.
pub(super) struct Turned<'a> {
    pub(super) strip: &'a [[Point; 2]],
    pub(super) angles: [f64; 2],
    pub(super) steps: usize,
    pub(super) rise: f64,
}

impl Turned<'_> {
    /// Its faces.
    pub(super) fn of(&self, part: PairPart) -> Solid {
        let (inner, outer) = self.sides();
        let round = (0..self.steps).flat_map(|n| {
            let quad = move |[p, q]: [Point; 2]| {
                [
                    self.at(p, n),
                    self.at(p, n + 1),
                    self.at(q, n + 1),
                    self.at(q, n),
                ]
                .to_vec()
            };
            let out = outer.windows(2).map(move |w| quad([w[0], w[1]]));
            let back = inner.windows(2).map(move |w| quad([w[1], w[0]]));
            let (first, last) = (self.strip.first(), self.strip.last());
            let below = first.map(|&[i, o]| quad([i, o]));
            let above = last.map(|&[i, o]| quad([o, i]));
            out.chain(back)
                .chain(below)
                .chain(above)
                .collect::<Vec<_>>()
        });
        let mut out = solid(part, round);
        if self.angles[1] - self.angles[0] < 359.0 {
            for (n, turn) in [(0, false), (self.steps, true)] {
                out.extend(self.strip.windows(2).map(|w| {
                    let ring = [w[0][0], w[0][1], w[1][1], w[1][0]];
                    let mut points: Vec<Vector> = ring.map(|p| self.at(p, n)).to_vec();
                    if turn {
                        points.reverse();
                    }
                    let cut = true;
                    SolidFace { points, part, cut }
                }));
            }
        }
        for face in &mut out {
            face.points.dedup_by(|a, b| same(a, b));
            while face.points.len() > 1
                && same(&face.points[0], &face.points[face.points.len() - 1])
            {
                face.points.pop();
            }
        }
        out.retain(|f| f.points.len() > 2);
        out
    }

    /// The near and the far side of the strip.
    fn sides(&self) -> (Vec<Point>, Vec<Point>) {
        self.strip.iter().map(|[i, o]| (*i, *o)).unzip()
    }

    /// A point of the profile after so many steps.
    fn at(&self, [r, z]: Point, step: usize) -> Vector {
        let [from, to] = self.angles;
        let turn = (from + (to - from) * step as f64 / self.steps as f64) / 360.0;
        let (sin, cos) = (TAU * turn).sin_cos();
        let ends = [self.strip.first(), self.strip.last()].map(|s| s.map_or(z, |s| s[0][1]));
        let climbed = if self.rise > 0.0 {
            (z + self.rise * turn).clamp(ends[0], ends[1])
        } else {
            z
        };
        [r * cos, r * sin, climbed]
    }
}

/// Whether two corners are one.
fn same(a: &Vector, b: &Vector) -> bool {
    a.iter().zip(b).all(|(x, y)| (x - y).abs() < 1e-9)
}

/// A tube round z, or a cylinder where the radius within is 0, between two angles.
pub(super) fn tube(
    part: PairPart,
    [inner, outer]: [f64; 2],
    z: [f64; 2],
    angles: [f64; 2],
) -> Solid {
    let strip = z.map(|z| [[inner, z], [outer, z]]);
    let steps = ((angles[1] - angles[0]) / 15.0).round() as usize;
    turned(part, &strip, angles, steps)
}

/// A solid of revolution in so many steps.
pub(super) fn turned(
    part: PairPart,
    strip: &[[Point; 2]],
    angles: [f64; 2],
    steps: usize,
) -> Solid {
    let rise = 0.0;
    Turned {
        strip,
        angles,
        steps,
        rise,
    }
    .of(part)
}

/// A cylinder round z.
pub(super) fn cylinder(part: PairPart, radius: f64, z: [f64; 2]) -> Solid {
    tube(part, [0.0, radius], z, WHOLE)
}

/// The profile of a ball round the origin, from the south pole up to a latitude in degrees.
pub(super) fn ball(radius: f64, up_to: f64) -> Vec<[Point; 2]> {
    arc(radius, up_to).map(|p| [[0.0, p[1]], p]).collect()
}

/// The profile of a shell round the origin, up to a latitude in degrees.
pub(super) fn shell([inner, outer]: [f64; 2], up_to: f64) -> Vec<[Point; 2]> {
    let sides = arc(inner, up_to).zip(arc(outer, up_to));
    sides.map(|(i, o)| [i, o]).collect()
}

/// Points (distance from the axis, z) of a circle.
fn arc(radius: f64, up_to: f64) -> impl Iterator<Item = Point> {
    const PIECES: i32 = 18;
    (0..=PIECES).map(move |i| {
        let angle = (-90.0 + (up_to + 90.0) * f64::from(i) / f64::from(PIECES)).to_radians();
        [radius * angle.cos(), radius * angle.sin()]
    })
}

/// A solid moved.
pub(super) fn moved(mut of: Solid, by: Vector) -> Solid {
    for p in of.iter_mut().flat_map(|f| &mut f.points) {
        *p = add(*p, by);
    }
    of
}

/// A solid whose x, y, z point along other directions, which have to be those of a right-handed frame.
pub(super) fn swung(mut of: Solid, axes: [Vector; 3]) -> Solid {
    let axes = axes.map(unit);
    for p in of.iter_mut().flat_map(|f| &mut f.points) {
        *p = [0, 1, 2].map(|i| axes[0][i] * p[0] + axes[1][i] * p[1] + axes[2][i] * p[2]);
    }
    of
}
