//! The symbols of joints, turned as the joints are.

use super::projection::{Place, Vector, View, dot};
use super::sheet::{ROW, Shape};
use crate::model::joint_type::JointType;
use crate::svg::plane::{Point, Rect, add, cross, norm, scale, sub, unit};
use std::f64::consts::{PI, TAU};

/// A joint's frame on paper.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pose {
    axes: [Point; 3],
    toward: Vector,
}

impl Pose {
    /// Of a joint seen from a side.
    pub(super) fn new(place: &Place, view: &View) -> Pose {
        Pose::of_axes([place.x, place.y, place.z], view)
    }

    /// Of a frame with these axes.
    pub(super) fn of_axes(axes: [Vector; 3], view: &View) -> Pose {
        Pose {
            axes: axes.map(|a| view.flat(a)),
            toward: axes.map(|a| dot(a, view.toward)),
        }
    }

    fn at(&self, x: f64, y: f64, z: f64) -> Point {
        add(
            add(scale(self.axes[0], x), scale(self.axes[1], y)),
            scale(self.axes[2], z),
        )
    }

    /// The same with the axes passed on: the new z is the old x.
    fn along_x(&self) -> Pose {
        let [x, y, z] = self.axes;
        let [a, b, c] = self.toward;
        Pose {
            axes: [y, z, x],
            toward: [b, c, a],
        }
    }

    fn circle(&self, radius: f64, z: f64) -> Vec<Point> {
        (0..28)
            .map(|i| {
                let angle = TAU * f64::from(i) / 28.0;
                self.at(radius * angle.cos(), radius * angle.sin(), z)
            })
            .collect()
    }
}

/// Half the thickness of a block.
const BLOCK: f64 = 5.0;
/// The radius of a bush.
const BUSH: f64 = 5.5;
/// The radius of a tube with a ball in it.
const TUBE: f64 = 8.5;
/// The radius of a cross.
const CROSS: f64 = 9.0;

/// How far the side of what slides along the axis of a joint is from the axis; nothing for joints without such a slide.
pub(super) fn side_of_slide(joint: &JointType) -> Option<f64> {
    match joint {
        JointType::Prismatic => Some(BLOCK),
        JointType::Cylindrical | JointType::Helical => Some(BUSH),
        JointType::CylindricalUniversal => Some(CROSS),
        JointType::SphereInCylinder => Some(TUBE),
        JointType::Revolute
        | JointType::Universal
        | JointType::Slotted
        | JointType::Spherical
        | JointType::Planar
        | JointType::CylinderOnPlane
        | JointType::SphereOnPlane
        | JointType::Fixed
        | JointType::Custom(_) => None,
    }
}

/// The symbol of a joint round the origin, so many times its usual size; `mark` is added to the classes.
pub(super) fn symbol(joint: &JointType, pose: &Pose, mark: &str, size: f64) -> Vec<Shape> {
    let mut s = Symbol {
        pose: *pose,
        mark: mark.to_owned(),
        shapes: Vec::new(),
    };
    match joint {
        JointType::Revolute => {
            if pose.toward[2].abs() < 0.9 {
                s.rod("fine", 14.0);
            }
            s.cylinder(5.5, 7.0, 0.0);
        }
        JointType::Prismatic => {
            s.rod("line", 17.0);
            s.cuboid([BLOCK, BLOCK, 9.5]);
            s.rod_end();
        }
        JointType::Helical => {
            s.rod("line", 16.0);
            s.cylinder(BUSH, 9.0, 0.0);
            s.wave();
        }
        JointType::Cylindrical => {
            s.rod("line", 17.0);
            s.cylinder(BUSH, 9.5, 0.0);
            s.rod_end();
        }
        JointType::Universal => s.cross(),
        JointType::CylindricalUniversal => {
            s.rod("line", 17.0);
            s.cross();
            s.rod_end();
        }
        JointType::Slotted => {
            let (a, b) = (pose.at(7.0, 0.0, 0.0), pose.at(-7.0, 0.0, 0.0));
            let ends = [a, b].into_iter().flat_map(|c| ball(c, 6.0));
            s.area("joint", hull(ends.collect()));
            s.ball(3.2, "ink");
        }
        JointType::Spherical => {
            s.round_ball(6.5);
            let arc = (0..=20).map(|i| {
                let angle = PI * (-0.2 + 1.4 * f64::from(i) / 20.0);
                [9.5 * angle.cos(), 9.5 * angle.sin()]
            });
            s.shapes.push(Shape::line(s.class("line"), arc.collect()));
        }
        JointType::Planar => {
            s.plate(9.0, -3.0);
            s.plate(9.0, 3.0);
        }
        JointType::SphereInCylinder => {
            s.rod("fine", 15.0);
            s.cylinder(TUBE, 9.5, 0.0);
            s.round_ball(5.0);
        }
        JointType::CylinderOnPlane => {
            s.plate(10.0, -4.5);
            s.pose = pose.along_x();
            s.cylinder(4.5, 8.0, 0.0);
        }
        JointType::SphereOnPlane => {
            s.plate(10.0, -5.0);
            s.round_ball(5.0);
        }
        JointType::Fixed => {
            s.area(
                "joint",
                vec![[-5.5, -5.5], [5.5, -5.5], [5.5, 5.5], [-5.5, 5.5]],
            );
            for d in [1.0, -1.0] {
                s.shapes.push(Shape::line(
                    s.class("line"),
                    vec![[-5.5, -5.5 * d], [5.5, 5.5 * d]],
                ));
            }
        }
        JointType::Custom(_) => {
            s.area(
                "joint",
                vec![[0.0, -9.0], [9.0, 0.0], [0.0, 9.0], [-9.0, 0.0]],
            );
            s.ball(2.0, "ink");
        }
    }
    for shape in &mut s.shapes {
        match shape {
            Shape::Path { points, .. } => points.iter_mut().for_each(|p| *p = scale(*p, size)),
            Shape::Circle { at, radius, .. } => {
                *at = scale(*at, size);
                *radius *= size;
            }
        }
    }
    s.shapes
}

/// Shapes made small enough for a row of the legend.
pub(super) fn fitted(shapes: &[Shape]) -> Vec<Shape> {
    let own = extent(shapes);
    let by = (ROW - 2.0) / (own.bottom - own.top).max(1e-9);
    let scaled = |p: &Point| scale(*p, by.min(1.0));
    let one = |s: &Shape| match s {
        Shape::Path {
            class,
            points,
            closed,
        } => Shape::Path {
            class: class.clone(),
            points: points.iter().map(scaled).collect(),
            closed: *closed,
        },
        Shape::Circle { at, radius, class } => Shape::Circle {
            at: scaled(at),
            radius: radius * by.min(1.0),
            class: class.clone(),
        },
    };
    shapes.iter().map(one).collect()
}

/// The rectangle round some shapes.
pub(super) fn extent(shapes: &[Shape]) -> Rect {
    let mut all = Rect::around([0.0; 2], 2.0, 2.0);
    for s in shapes {
        match s {
            Shape::Path { points, .. } => {
                for p in points {
                    all = all.with(&Rect::around(*p, 1.4, 1.4));
                }
            }
            Shape::Circle { at, radius, .. } => {
                all = all.with(&Rect::around(*at, 2.0 * radius + 1.4, 2.0 * radius + 1.4));
            }
        }
    }
    all
}

struct Symbol {
    pose: Pose,
    mark: String,
    shapes: Vec<Shape>,
}

impl Symbol {
    fn class(&self, of: &str) -> String {
        format!("{of}{}", self.mark)
    }

    fn area(&mut self, class: &str, points: Vec<Point>) {
        self.shapes.push(Shape::Path {
            class: self.class(class),
            points,
            closed: true,
        });
    }

    fn ball(&mut self, radius: f64, class: &str) {
        self.shapes.push(Shape::Circle {
            at: [0.0; 2],
            radius,
            class: self.class(class),
        });
    }

    /// A ball that does not look like a pin: with its equator.
    fn round_ball(&mut self, radius: f64) {
        self.ball(radius, "joint");
        let arc = (0..=12).map(|i| {
            let angle = PI * f64::from(i) / 12.0;
            [radius * angle.cos(), 0.36 * radius * angle.sin()]
        });
        self.shapes
            .push(Shape::line(self.class("line"), arc.collect()));
    }

    /// The axis as a line.
    fn rod(&mut self, class: &str, half: f64) {
        let ends = vec![self.pose.at(0.0, 0.0, -half), self.pose.at(0.0, 0.0, half)];
        self.shapes.push(Shape::line(self.class(class), ends));
    }

    /// The end of the rod, where the axis points at the reader and the rod itself is not to be seen.
    fn rod_end(&mut self) {
        if self.pose.toward[2].abs() > 0.9 {
            self.ball(3.0, "ink");
        }
    }

    fn cylinder(&mut self, radius: f64, half: f64, middle: f64) {
        let (low, high) = (
            self.pose.circle(radius, middle - half),
            self.pose.circle(radius, middle + half),
        );
        let front = if self.pose.toward[2] < 0.0 {
            low.clone()
        } else {
            high.clone()
        };
        self.area("joint", hull(low.into_iter().chain(high).collect()));
        if self.pose.toward[2].abs() < 0.97 {
            self.area("joint", front);
        }
    }

    fn cuboid(&mut self, half: [f64; 3]) {
        let corner = |p: &Pose, v: [f64; 3]| p.at(v[0], v[1], v[2]);
        for axis in 0..3 {
            let side = if self.pose.toward[axis] < 0.0 {
                -1.0
            } else {
                1.0
            };
            if self.pose.toward[axis].abs() < 1e-6 {
                continue;
            }
            let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
            let face = [(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0)].map(|(s, t)| {
                let mut v = [0.0; 3];
                v[axis] = side * half[axis];
                v[a] = s * half[a];
                v[b] = t * half[b];
                corner(&self.pose, v)
            });
            self.area("joint", face.to_vec());
        }
    }

    fn plate(&mut self, half: f64, z: f64) {
        let corners = [(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0)];
        let points = corners.map(|(x, y)| self.pose.at(half * x, half * y, z));
        self.area("joint", points.to_vec());
    }

    /// The cross of a universal joint: its two axes, z and x.
    fn cross(&mut self) {
        self.ball(CROSS, "joint");
        for axis in [2, 0] {
            let tip = scale(self.pose.axes[axis], CROSS);
            let ends = vec![scale(tip, -1.0), tip];
            self.shapes.push(Shape::line(self.class("line"), ends));
            for end in [tip, scale(tip, -1.0)] {
                self.shapes.push(Shape::Circle {
                    at: end,
                    radius: 1.9,
                    class: self.class("ink"),
                });
            }
        }
    }

    /// A thread: a wave along the axis, or a spiral where the axis points at the reader.
    fn wave(&mut self) {
        let across = if self.pose.toward[2].abs() > 0.8 {
            let spiral = (0..=36).map(|i| {
                let t = f64::from(i) / 36.0;
                let angle = 2.0 * TAU * t;
                [4.4 * t * angle.cos(), 4.4 * t * angle.sin()]
            });
            spiral.collect()
        } else {
            let along = self.pose.axes[2];
            let side = unit([-along[1], along[0]]);
            let wave = (0..=32).map(|i| {
                let t = f64::from(i) / 16.0 - 1.0;
                add(
                    scale(along, 8.0 * t),
                    scale(side, 3.4 * (2.5 * PI * t).sin()),
                )
            });
            wave.collect()
        };
        self.shapes.push(Shape::line(self.class("line"), across));
    }
}

fn ball(at: Point, radius: f64) -> Vec<Point> {
    (0..24)
        .map(|i| {
            let angle = TAU * f64::from(i) / 24.0;
            add(at, [radius * angle.cos(), radius * angle.sin()])
        })
        .collect()
}

/// The convex hull, by monotone chains.
pub(super) fn hull(mut points: Vec<Point>) -> Vec<Point> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let mut out: Vec<Point> = Vec::new();
    for pass in 0..2 {
        let from = out.len();
        for &p in &points {
            while let [.., before, last] = out[from..] {
                let (a, b) = (sub(last, before), sub(p, last));
                // points in a row that rounding has moved are still in a row
                if cross(a, b) > 1e-9 * norm(a) * norm(b) {
                    break;
                }
                out.pop();
            }
            out.push(p);
        }
        out.pop();
        if pass == 0 {
            points.reverse();
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::projection;
    use crate::geom::vector::{X, Y, Z};

    #[test]
    fn each_type_of_joint_has_a_symbol_of_its_own_from_every_side() {
        let types = JointType::NAMED;
        let end_on = Pose {
            axes: [[1.0, 0.0], [0.0, -1.0], [0.0, 0.0]],
            toward: [0.0, 0.0, 1.0],
        };
        let from_the_side = end_on.along_x();
        for pose in [
            end_on,
            from_the_side,
            from_the_side.along_x(),
            Pose::of_axes([X, Y, Z], &projection::aslant()),
        ] {
            let drawn = types.each_ref().map(|t| {
                let mut shapes = symbol(t, &pose, "", 1.0);
                // what is a point on paper is not seen
                shapes.retain(|s| {
                    let r = extent(std::slice::from_ref(s));
                    (r.right - r.left).max(r.bottom - r.top) > 2.5
                });
                format!("{shapes:?}")
            });
            for (i, one) in drawn.iter().enumerate() {
                assert!(!drawn[..i].contains(one), "{} as another", types[i]);
            }
        }
    }
}
