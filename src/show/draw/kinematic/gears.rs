//! Joints that gears couple, as their pitch circles, and a rack as its pitch line, which touches the circle of its pinion.

use crate::draw::kinematic::Kinematic;
use crate::draw::kinematic::body::{Wire, WireForm};
use crate::draw::place::projection::{self, cross, norm};
use crate::draw::prelude::*;
use crate::model::joint_type::CoupledFreedom;

/// The greatest radius of a gear that is drawn, in distances of the axes.
const LARGEST: f64 = 6.0;

/// A pitch circle or a pitch line: the end of the coupling that it belongs to, and its points in space.
type PitchCurve = (usize, Vec<Vector>);

impl Kinematic<'_> {
    /// Returns the pitch circles in space, or the circle of a pinion and the pitch line of its rack.
    fn pitch_curves(&self, coupling: &Coupling) -> Vec<PitchCurve> {
        if !coupling.gear {
            return Vec::new();
        }
        let gears = gear_circles(self, coupling);
        let curves = gears.or_else(|| rack_and_pinion(self, coupling));
        curves.unwrap_or_default()
    }

    /// Returns the pitch circles of gears and the pitch lines of racks, each on a link that moves.
    pub(super) fn pitch_wires(&self) -> Vec<Wire> {
        let m = self.subject.mechanism;
        let wires = m.couplings_in(self.subject.state).flat_map(|coupling| {
            let links = coupling.ends.map(|e| m.joints[e.joint].links);
            let curves = self.pitch_curves(coupling).into_iter();
            curves.filter_map(move |(end, points)| {
                let moving = links[end].into_iter().filter(|l| !self.is_frame(*l));
                // The carrier of both joints is the last choice.
                let link = moving.min_by_key(|l| links[1 - end].contains(l))?;
                Some(Wire {
                    row: self.link_row(link),
                    class: "fine pitch",
                    form: WireForm::Loop,
                    points,
                })
            })
        });
        wires.collect()
    }

    /// Returns the lines between joints for couplings without circles.
    pub(crate) fn coupling_lines(&self) -> Vec<(Point, Point)> {
        let m = self.subject.mechanism;
        let place = |j| self.spots.iter().find(|s| s.joint == j).map(|s| s.at);
        let all = m.couplings_in(self.subject.state);
        let plain = all.filter(|c| self.pitch_curves(c).is_empty());
        plain
            .filter_map(|c| Some((place(c.ends[0].joint)?, place(c.ends[1].joint)?)))
            .collect()
    }

    fn end_place(&self, coupling: &Coupling, end: usize) -> Option<&JointInSpace> {
        let joint = coupling.ends[end].joint;
        let spot = self.spots.iter().position(|s| s.joint == joint)?;
        Some(&self.places[spot])
    }
}

/// Returns the points of a circle about a middle, across its normal.
fn circle_points(middle: Vector, normal: Vector, radius: f64) -> Vec<Vector> {
    let x = projection::unit_across(normal);
    let y = cross(normal, x);
    let point = |i: i32| {
        let angle = TAU * f64::from(i) / 60.0;
        let off = add(scale(x, angle.cos()), scale(y, angle.sin()));
        add(middle, scale(off, radius))
    };
    (0..60).map(point).collect()
}

/// Returns 1 if the speed of a joint is that of its gear against the link of both joints, and -1 if it is the opposite; `None` if the joints have no
/// link in common.
fn gear_senses(drawn: &Kinematic<'_>, coupling: &Coupling) -> Option<[f64; 2]> {
    let joints = &drawn.subject.mechanism.joints;
    let links = coupling.ends.map(|e| joints[e.joint].links);
    let carrier = links[0].into_iter().find(|l| links[1].contains(l))?;
    Some(links.map(|l| if l[0] == carrier { 1.0 } else { -1.0 }))
}

/// Returns the circles of two gears on one carrier, whose pitch circles roll on each other.
fn gear_circles(drawn: &Kinematic<'_>, coupling: &Coupling) -> Option<Vec<PitchCurve>> {
    if coupling.ends.iter().any(|e| e.freedom != Freedom::Rz) {
        return None;
    }
    let [first, second] = gear_senses(drawn, coupling)?;
    let [a, b] = [drawn.end_place(coupling, 0)?, drawn.end_place(coupling, 1)?];
    if norm(cross(a.z, b.z)) > 1e-6 {
        return None;
    }
    // the turns of both as seen from one side
    let sense = first * second * dot(a.z, b.z).signum();
    let ratio = coupling.ratio.to_f64() * sense;
    let apart = sub(b.point, a.point);
    let distance = norm(sub(apart, scale(a.z, dot(apart, a.z))));
    // turning against each other they touch from outside, else one within the other
    let second = distance / (1.0 - ratio).abs();
    let radii = [second * ratio.abs(), second];
    let drawable = |r: &f64| r.is_finite() && *r > 0.0 && *r < LARGEST * distance;
    let circle = |(n, of): (usize, &JointInSpace)| (n, circle_points(of.point, a.z, radii[n]));
    let circles = [a, b].into_iter().enumerate();
    radii
        .iter()
        .all(drawable)
        .then(|| circles.map(circle).collect())
}

/// Returns the circle of a pinion, and the line on which its rack rolls, from the rack's slide to beyond the point of contact. The coupling
/// joins a turn to a slide across its axis.
fn rack_and_pinion(drawn: &Kinematic<'_>, coupling: &Coupling) -> Option<Vec<PitchCurve>> {
    let turns = |e: &CoupledFreedom| e.freedom == Freedom::Rz;
    let turn = coupling.ends.iter().position(turns)?;
    let slide = 1 - turn;
    if coupling.ends[slide].freedom != Freedom::Tz {
        return None;
    }
    let [pin, rack] = [
        drawn.end_place(coupling, turn)?,
        drawn.end_place(coupling, slide)?,
    ];
    let ratio = coupling.ratio.to_f64();
    let travel = if turn == 0 { ratio } else { 1.0 / ratio };
    let radius = travel.abs();
    let across = dot(pin.z, rack.z).abs() < 1e-6;
    if !(across && radius.is_finite() && radius > 0.0) {
        return None;
    }
    let mut curves = vec![(turn, circle_points(pin.point, pin.z, radius))];
    if let Some([first, second]) = gear_senses(drawn, coupling) {
        // At the point of contact the pinion is as fast as the rack.
        let arm = scale(cross(rack.z, pin.z), first * second * travel);
        let contact = add(pin.point, arm);
        let guide = dot(sub(rack.point, contact), rack.z);
        let ends = [guide.min(-radius), guide.max(radius)];
        curves.push((slide, ends.map(|x| add(contact, scale(rack.z, x))).to_vec()));
    }
    Some(curves)
}
