//! Reflections and turns of space: whether the joints grouped in a file are images of each other in one plane or about
//! one axis, and their deviations.

mod map;

use crate::closure::isometry::map::Map;
pub(crate) use crate::closure::isometry::map::PlacedType;
use crate::format::three_digits;
use crate::geom::Scalars;
use crate::geom::exact::{ExactError, ExactField};
use crate::geom::expr::Expr;
use crate::geom::vector::{Vector, add, cross, dot, length, sub, to_vector};
use crate::linalg::modp::Residue;
use crate::model::joint_type::JointType;
use crate::model::mechanism::{Frame, Joint, JointId, Mechanism, Mode, Parts};

/// Position of a joint, in numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spot {
    /// Its point.
    pub point: Vector,
    /// Its axis.
    pub axis: Vector,
}

impl Spot {
    /// Returns the position of a joint's frame.
    #[must_use]
    pub(crate) fn from_frame(frame: &Frame) -> Spot {
        Spot {
            point: to_vector(&frame.point),
            axis: to_vector(&frame.axis),
        }
    }

    /// Returns the positions of all joints.
    pub(crate) fn of_joints(mechanism: &Parts) -> Vec<Spot> {
        let joints = mechanism.joint_ids();
        joints
            .map(|j| Spot::from_frame(&mechanism.joints[j].frame))
            .collect()
    }
}

/// Deviation of the image of a joint from the joint it is paired with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Miss {
    /// Distance of their points, or of their axes if the joint is the same all along its axis. In the file's unit.
    pub distance: f64,
    /// Angle between their axes, in radians.
    pub angle: f64,
}

impl Miss {
    /// Computes the deviation of a joint from the new position of its point and axis.
    fn new(image: Spot, of: &JointType, to: Spot) -> Miss {
        let own = to.axis;
        let off = sub(image.point, to.point);
        let sine = length(cross(image.axis, own));
        let angle = match of {
            JointType::Spherical | JointType::Fixed => 0.0,
            _ => sine.atan2(dot(image.axis, own).abs()),
        };
        let distance = match of {
            JointType::Prismatic => 0.0,
            JointType::Revolute | JointType::Cylindrical | JointType::Helical => {
                length(cross(off, own)) / length(own)
            }
            _ => length(off),
        };
        Miss { distance, angle }
    }

    /// Returns distance and angle combined into one number for comparisons.
    fn total_miss(&self) -> f64 {
        self.distance + self.angle
    }

    /// Describes the deviation, such as "2.062 cm and 0.5°"; `unit` is that of the file.
    #[must_use]
    pub fn describe_miss(&self, unit: &str) -> String {
        let number = |x: f64| {
            if x < 1e-3 {
                format!("{x:.3e}")
            } else {
                three_digits(x)
            }
        };
        let distance = format!("{} {unit}", number(self.distance));
        match self.angle.to_degrees() {
            0.0 => distance,
            angle => format!("{distance} and {}°", number(angle)),
        }
    }
}

/// A reflection in a plane, or half or a third of a turn about an axis, that may map a mechanism to itself.
#[derive(Debug, Clone)]
pub struct Isometry {
    /// Two or three points that it maps to each other; their middle is on the axis, or in the plane.
    round: Vec<ExactVector>,
    /// The axis, or the normal of the plane.
    axis: ExactVector,
    /// Whether it is a reflection and not a turn.
    pub(crate) reflects: bool,
    /// The middle of the points and the axis, in numbers.
    centre: Vector,
    along: Vector,
}

/// Returns the directions of the frame of each joint, along which axes of turns may lie.
#[must_use]
pub(crate) fn frame_directions(mechanism: &Mechanism) -> Vec<[ExactVector; 3]> {
    let of = |j: &Joint| {
        let [z, x] = [&j.frame.axis, &j.frame.reference];
        [z.clone(), x.clone(), cross_exactly(z, x)]
    };
    mechanism.joints.iter().map(of).collect()
}

impl Isometry {
    fn new(round: Vec<ExactVector>, axis: ExactVector, reflects: bool) -> Isometry {
        let points: Vec<Vector> = round.iter().map(to_vector).collect();
        let count = points.len() as f64;
        Isometry {
            centre: [0, 1, 2].map(|i| points.iter().map(|p| p[i]).sum::<f64>() / count),
            along: to_vector(&axis),
            round,
            axis,
            reflects,
        }
    }

    /// Returns the reflection that maps two points to each other.
    fn mirror_between(one: ExactVector, other: ExactVector) -> Isometry {
        let normal = exact_difference(&other, &one);
        Isometry::new(vec![one, other], normal, true)
    }

    /// Returns the reflections in which a pair of joints may be images. The plane lies midway between their points. If
    /// the points coincide, it is perpendicular to a direction of the first joint or lies between the two axes. It may
    /// also pass through a third point that is its own image.
    fn mirrors_of(one: &Frame, other: &Frame, own: &[&ExactVector]) -> Vec<Isometry> {
        let [p, q] = [&one.point, &other.point];
        if to_vector(p) != to_vector(q) {
            return vec![Isometry::mirror_between(p.clone(), q.clone())];
        }
        let [z, x, w] = [&one.axis, &one.reference, &other.axis];
        let mut normals = vec![
            z.clone(),
            x.clone(),
            cross_exactly(z, x),
            exact_difference(z, w),
            sum(z, w),
        ];
        normals.extend(
            own.iter()
                .map(|o| cross_exactly(z, &exact_difference(o, p))),
        );
        normals.retain(|n| length(to_vector(n)) > 0.0);
        let mirror = |n: &ExactVector| Isometry::mirror_between(exact_difference(p, n), sum(p, n));
        normals.iter().map(mirror).collect()
    }

    /// Returns the reflections in which the pairs may be images, the most likely first, with the deviation of every
    /// pair. The pairs themselves suggest the planes, which are ranked by most of the pairs, and then by all joints if
    /// these agree.
    ///
    /// # Examples
    /// ```
    /// use ozols::closure::isometry::Isometry;
    /// let gripper = ozols::built_in("gripper-10")?;
    /// let found = Isometry::find_mirrors(&gripper, &gripper.search.mirror);
    /// assert!(found[0].1.iter().all(|miss| miss.distance == 0.0)); // Every pair fits the first plane.
    /// # Ok::<(), ozols::Error>(())
    /// ```
    #[must_use]
    pub fn find_mirrors(
        mechanism: &Parts,
        pairs: &[(JointId, JointId)],
    ) -> Vec<(Isometry, Vec<Miss>)> {
        Isometry::mirrors_among(mechanism, &Spot::of_joints(mechanism), pairs)
    }

    /// Returns the reflections for joints with known positions, as `mirrors` does for a mechanism.
    pub(crate) fn mirrors_among(
        mechanism: &Parts,
        spots: &[Spot],
        pairs: &[(JointId, JointId)],
    ) -> Vec<(Isometry, Vec<Miss>)> {
        let frame = |j: JointId| &mechanism.joints[j].frame;
        let point = |j: JointId| &frame(j).point;
        let at_one_point = |&&(a, b): &&_| to_vector(point(a)) == to_vector(point(b));
        let own = pairs.iter().filter(at_one_point);
        let own: Vec<_> = own.map(|p| point(p.0)).collect();
        let mirrors = pairs
            .iter()
            .flat_map(|&(a, b)| Isometry::mirrors_of(frame(a), frame(b), &own));
        let paired = |j: JointId| pairs.iter().any(|&(a, b)| j == a || j == b);
        let alone: Vec<JointId> = mechanism.joint_ids().filter(|&j| !paired(j)).collect();
        let spot = |j: JointId| spots[j.index()];
        let judged = mirrors.map(|mirror| {
            let miss = |a: JointId, b| {
                mirror.miss_of_image(spot(a), &mechanism.joints[a].joint_type, spot(b))
            };
            let misses: Vec<Miss> = pairs.iter().map(|&(a, b)| miss(a, b)).collect();
            let mut off: Vec<f64> = misses.iter().map(Miss::total_miss).collect();
            off.sort_by(f64::total_cmp);
            // The median comes first, because one wrong pair must not choose the plane.
            let all = off.iter().sum::<f64>()
                + alone.iter().map(|&j| miss(j, j).total_miss()).sum::<f64>();
            let key = (off[off.len() / 2], all);
            (key, (mirror, misses))
        });
        let mut judged: Vec<_> = judged.collect();
        judged.sort_by(|(a, _), (b, _)| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        judged.into_iter().map(|(_, mirror)| mirror).collect()
    }

    /// Returns the turns that groups of joints suggest. Three points determine the turn. Two points determine only the
    /// middle. The axis is then along a direction of their joints, between or across these, or along a direction of a
    /// joint that is its own image.
    #[must_use]
    pub(crate) fn find_turns(
        mechanism: &Mechanism,
        directions: &[[ExactVector; 3]],
        groups: &[Vec<JointId>],
    ) -> Vec<Isometry> {
        let frame = |j: &JointId| &mechanism.joints[*j].frame;
        let directions = |j: JointId| directions[j.index()].iter().cloned();
        let alone = mechanism.joint_ids();
        let alone = alone.filter(|j| !groups.iter().any(|g| g.contains(j)));
        let mut out = Vec::new();
        for group in groups {
            let round: Vec<ExactVector> = group.iter().map(|j| frame(j).point.clone()).collect();
            if group.len() == 3 && round.iter().all(|p| to_vector(p) == to_vector(&round[0])) {
                out.extend(turns_about_point(group.iter().map(frame)));
                continue;
            }
            let axes: Vec<ExactVector> = match &round[..] {
                [a, b, c] => vec![cross_exactly(
                    &exact_difference(b, a),
                    &exact_difference(c, a),
                )],
                _ => {
                    let [z, w] = [0, 1].map(|i| &frame(&group[i]).axis);
                    let own = directions(group[0]).chain([sum(z, w), exact_difference(z, w)]);
                    own.chain(alone.clone().flat_map(directions)).collect()
                }
            };
            // Joints of a plane share their directions.
            let mut known: Vec<Vector> = Vec::new();
            for axis in axes {
                let along = to_vector(&axis);
                if length(along) == 0.0 || known.contains(&along) {
                    continue;
                }
                known.push(along);
                out.push(Isometry::new(round.clone(), axis, false));
            }
        }
        out
    }

    /// Returns the image of a joint, in numbers.
    pub(crate) fn image_of_spot(&self, spot: Spot) -> Spot {
        let (centre, n) = (self.centre, self.along);
        let nn = dot(n, n);
        let (sine, cosine) = match self.round.len() {
            3 => (std::f64::consts::TAU / 3.0).sin_cos(),
            _ => (0.0, -1.0),
        };
        // A reflection is the opposite of half a turn.
        let sign = if self.reflects { -1.0 } else { 1.0 };
        let linear = |v: Vector| {
            let (across, along) = (cross(n, v), (1.0 - cosine) * dot(v, n) / nn);
            let turned = |i: usize| cosine * v[i] + sine / nn.sqrt() * across[i] + along * n[i];
            [0, 1, 2].map(|i| sign * turned(i))
        };
        Spot {
            point: add(centre, linear(sub(spot.point, centre))),
            axis: linear(spot.axis),
        }
    }

    /// Returns the image of a direction, exactly and of another length.
    pub(crate) fn image_of_direction(&self, v: &ExactVector) -> ExactVector {
        let n = &self.axis;
        let times = |a: &Expr, v: &ExactVector| [0, 1, 2].map(|i| a * &v[i]);
        let square = dot_exactly(n, n);
        let along = times(&dot_exactly(n, v), n);
        let [sum, both] = match &self.round[..] {
            // v cos + n × v sin / |n| + n (n·v) (1 - cos) / |n|² with sin / |n| = 1 / side², times 2 side² |n|².
            [a, b, _] => {
                let side = exact_difference(b, a);
                let side = dot_exactly(&side, &side);
                let across = times(&(&square * &Expr::from(2)), &cross_exactly(n, v));
                let back = times(&(&side * &square), v);
                let along = times(&(&side * &Expr::from(3)), &along);
                [exact_difference(&across, &back), along]
            }
            _ => {
                let back = times(&-&square, v);
                [back, times(&Expr::from(2), &along)]
            }
        };
        let turned = [0, 1, 2].map(|i| &sum[i] + &both[i]);
        if self.reflects {
            turned.map(|x| -x)
        } else {
            turned
        }
    }

    /// Returns the map of space in exact numbers, or `None` if lengths change.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value in the field.
    pub(crate) fn exact_map(&self, exact: &ExactField) -> Result<Option<Map>, ExactError> {
        let f = exact.field();
        let n = exact.eval3(&self.axis)?;
        let square = exact.dot(n, n);
        let points = self.round.iter().map(|p| exact.eval3(p));
        let points: Vec<[Residue; 3]> = points.collect::<Result<_, _>>()?;
        let number = |x: i64| f.from_i64(x);
        let third = points.len() == 3;
        let part = f.inv(number(if third { 3 } else { 2 }));
        let centre = [0, 1, 2].map(|i| f.sum_of_products(points.iter().map(|p| (part, p[i]))));
        let half = f.inv(number(2));
        // v cos + n × v sin / |n| + n (n·v) (1 - cos) / |n|²; for an equilateral triangle, sin / |n| is 1 / side².
        let (cosine, sine, rest) = if third {
            let side = [0, 1, 2].map(|i| f.sub(points[1][i], points[0][i]));
            let side = exact.dot(side, side);
            let quarters = f.mul(number(3), f.mul(side, side));
            if f.mul(number(4), square) != quarters {
                return Ok(None);
            }
            (f.neg(half), f.inv(side), f.mul(number(3), half))
        } else {
            (number(-1), f.zero(), number(2))
        };
        let rest = f.mul(rest, f.inv(square));
        let linear = |v: [Residue; 3]| {
            let (across, along) = (exact.cross(n, v), f.mul(rest, exact.dot(n, v)));
            [0, 1, 2].map(|i| {
                let products = [(cosine, v[i]), (sine, across[i]), (along, n[i])];
                let turned = f.sum_of_products(products);
                if self.reflects { f.neg(turned) } else { turned }
            })
        };
        let unit = |i: usize| [0, 1, 2].map(|j| if i == j { f.one() } else { f.zero() });
        let moved = linear(centre);
        Ok(Some(Map {
            linear: [0, 1, 2].map(|i| linear(unit(i))),
            shift: [0, 1, 2].map(|i| f.sub(centre[i], moved[i])),
            reflects: self.reflects,
        }))
    }

    /// Returns the deviation of the image of a joint of a type from a position.
    #[must_use]
    pub(crate) fn miss_of_image(&self, from: Spot, of: &JointType, to: Spot) -> Miss {
        Miss::new(self.image_of_spot(from), of, to)
    }

    /// Returns true if the image of a joint allows exactly the motions of another.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value in the field.
    pub(crate) fn maps_motions(
        &self,
        exact: &ExactField,
        mode: &Mode,
        from: PlacedType<'_>,
        to: PlacedType<'_>,
    ) -> Result<bool, ExactError> {
        match self.exact_map(exact)? {
            Some(map) => map.maps_motions(exact, mode, from, to),
            None => Ok(false),
        }
    }
}

/// Returns the thirds of a turn about a point that carry the axes of three joints there to each other, either way along each.
fn turns_about_point<'a>(frames: impl Iterator<Item = &'a Frame>) -> Vec<Isometry> {
    let frames: Vec<&Frame> = frames.collect();
    let signs = [[1, 1], [1, -1], [-1, 1], [-1, -1]];
    let turn = |[b, c]: [i64; 2]| {
        let ends = frames.iter().zip([1, b, c]).map(|(frame, sign)| {
            let along = [0, 1, 2].map(|i| &frame.axis[i] * &Expr::from(sign));
            sum(&frame.point, &along)
        });
        let round: Vec<ExactVector> = ends.collect();
        let [p, q] = [1, 2].map(|i| exact_difference(&round[i], &round[0]));
        let axis = cross_exactly(&p, &q);
        (length(to_vector(&axis)) > 0.0).then(|| Isometry::new(round, axis, false))
    };
    signs.into_iter().filter_map(turn).collect()
}

/// An exact vector in space.
type ExactVector = [Expr; 3];

fn exact_difference(a: &ExactVector, b: &ExactVector) -> ExactVector {
    [0, 1, 2].map(|i| &a[i] - &b[i])
}

fn sum(a: &ExactVector, b: &ExactVector) -> ExactVector {
    [0, 1, 2].map(|i| &a[i] + &b[i])
}

fn dot_exactly(a: &ExactVector, b: &ExactVector) -> Expr {
    let [x, y, z] = [0, 1, 2].map(|i| &a[i] * &b[i]);
    &(&x + &y) + &z
}

fn cross_exactly(a: &ExactVector, b: &ExactVector) -> ExactVector {
    let minor = |i: usize, j: usize| &(&a[i] * &b[j]) - &(&a[j] * &b[i]);
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}
