//! Joints that gears couple, as their pitch circles, and a pinion as that of its rack.

use crate::draw::kinematic::Kinematic;
use crate::draw::place::projection::{self, JointInSpace, add, cross, dot, norm, scale, sub};
use crate::geom::vector::Vector;
use crate::model::joint_type::{Coupling, Freedom};
use crate::svg::plane::Point;
use std::f64::consts::TAU;

/// The greatest radius of a gear that is drawn, in distances of the axes.
const LARGEST: f64 = 6.0;

/// A circle in space: the end of the coupling it is about, its middle, its normal, its radius.
type Circle = (usize, Vector, Vector, f64);

impl Kinematic<'_> {
    /// Returns the pitch circles of a coupling on paper with the joints at the given places, each a closed line; empty
    /// if gears cannot make it.
    pub(in crate::draw) fn pitch_circles(
        &self,
        coupling: &Coupling,
        places: &[JointInSpace],
    ) -> Vec<Vec<Point>> {
        let flat = |circle: Vec<Vector>| {
            circle
                .iter()
                .map(|&p| self.projection.flat_point(p))
                .collect()
        };
        let circles = self.pitch_circles_in_space(coupling, places).into_iter();
        circles.map(|(_, circle)| flat(circle)).collect()
    }

    /// Returns the pitch circles in space, each with the end of the coupling that it is about.
    pub(in crate::draw) fn pitch_circles_in_space(
        &self,
        coupling: &Coupling,
        places: &[JointInSpace],
    ) -> Vec<(usize, Vec<Vector>)> {
        let circles = if coupling.gear {
            gear_circles(self, coupling, places)
                .or_else(|| pinion_circle(self, coupling, places).map(|c| vec![c]))
        } else {
            None
        };
        let line = |(end, middle, normal, radius): Circle| {
            let x = projection::unit_across(normal);
            let y = cross(normal, x);
            let point = |i: i32| {
                let angle = TAU * f64::from(i) / 60.0;
                let off = add(scale(x, angle.cos()), scale(y, angle.sin()));
                add(middle, scale(off, radius))
            };
            (end, (0..60).map(point).collect())
        };
        circles.unwrap_or_default().into_iter().map(line).collect()
    }

    /// Returns the lines between joints for couplings without circles.
    pub(in crate::draw) fn coupling_lines(&self) -> Vec<(Point, Point)> {
        let m = self.subject.mechanism;
        let place = |j| self.spots.iter().find(|s| s.joint == j).map(|s| s.at);
        let all = m.couplings_in(self.subject.state);
        let plain = all.filter(|c| self.pitch_circles(c, &self.places).is_empty());
        plain
            .filter_map(|c| Some((place(c.ends[0].joint)?, place(c.ends[1].joint)?)))
            .collect()
    }

    fn end_place<'p>(
        &self,
        coupling: &Coupling,
        end: usize,
        places: &'p [JointInSpace],
    ) -> Option<&'p JointInSpace> {
        let joint = coupling.ends[end].joint;
        let spot = self.spots.iter().position(|s| s.joint == joint)?;
        Some(&places[spot])
    }
}

/// Returns the circles of two gears on one carrier, whose pitch circles roll on each other.
fn gear_circles(
    drawn: &Kinematic<'_>,
    coupling: &Coupling,
    places: &[JointInSpace],
) -> Option<Vec<Circle>> {
    if coupling.ends.iter().any(|e| e.freedom != Freedom::Rz) {
        return None;
    }
    let m = drawn.subject.mechanism;
    let links = coupling.ends.map(|e| m.joints[e.joint].links);
    let carrier = links[0].into_iter().find(|l| links[1].contains(l))?;
    let [a, b] = [
        drawn.end_place(coupling, 0, places)?,
        drawn.end_place(coupling, 1, places)?,
    ];
    if norm(cross(a.z, b.z)) > 1e-6 {
        return None;
    }
    // the turns of both as seen from one side, against the carrier
    let against = |n: usize| if links[n][0] == carrier { 1.0 } else { -1.0 };
    let sense = against(0) * against(1) * dot(a.z, b.z).signum();
    let ratio = coupling.ratio.to_f64() * sense;
    let apart = sub(b.point, a.point);
    let distance = norm(sub(apart, scale(a.z, dot(apart, a.z))));
    // turning against each other they touch from outside, else one within the other
    let second = distance / (1.0 - ratio).abs();
    let radii = [second * ratio.abs(), second];
    let drawable = |r: &f64| r.is_finite() && *r > 0.0 && *r < LARGEST * distance;
    let circles = [(0, a.point, a.z, radii[0]), (1, b.point, a.z, radii[1])];
    radii.iter().all(drawable).then(|| circles.to_vec())
}

/// Returns the pinion of a rack. The coupling joins a turn to a slide across its axis.
fn pinion_circle(
    drawn: &Kinematic<'_>,
    coupling: &Coupling,
    places: &[JointInSpace],
) -> Option<Circle> {
    let turn = coupling
        .ends
        .iter()
        .position(|e| e.freedom == Freedom::Rz)?;
    let slide = 1 - turn;
    if coupling.ends[slide].freedom != Freedom::Tz {
        return None;
    }
    let [pin, rack] = [
        drawn.end_place(coupling, turn, places)?,
        drawn.end_place(coupling, slide, places)?,
    ];
    let ratio = coupling.ratio.to_f64().abs();
    let radius = if turn == 0 { ratio } else { 1.0 / ratio };
    let across = dot(pin.z, rack.z).abs() < 1e-6;
    (across && radius.is_finite() && radius > 0.0).then_some((turn, pin.point, pin.z, radius))
}
