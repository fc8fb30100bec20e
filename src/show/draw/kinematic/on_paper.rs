//! Placement of joints, links and grounds of a kinematic scheme on paper.

use crate::draw::kinematic::body::marked_points;
use crate::draw::kinematic::{Kinematic, Spot};
use crate::draw::place::projection::places::shown_places;
use crate::draw::place::projection::{self, Projection, ToBeSeen};
use crate::draw::prelude::*;
use crate::draw::subject::{joints_of_link, roominess};
use crate::draw::symbol::ground::{Ground, GroundSpot};
use crate::draw::symbol::placed::{Symbol, one_place, symbol_sizes};
use crate::draw::symbol::symbols::{driven_slides, side_of_slide};

/// The room for the joints.
const ROOM: Point = [560.0, 400.0];

impl<'a> Kinematic<'a> {
    pub(super) fn new(subject: &'a Subject<'a>, sight: &Sight) -> Kinematic<'a> {
        let m = subject.mechanism;
        let joints: Vec<JointId> = m.joints_in(subject.state).collect();
        let links = joined_links(m, &joints);
        // A redesign is seen as the mechanism it came from, so that the two can be laid side by side.
        let before = subject.marks.as_ref().and_then(|m| m.before.as_ref());
        let seen = before.unwrap_or(m);
        let places = shown_places(seen, &joints);
        let mut points = marked_points(m, subject.state, &links);
        let more: Vec<_> = points.iter().map(|p| p.place).collect();
        let to_be_seen = ToBeSeen {
            places: &places,
            more: &more,
            turning: &turning_axes(seen, &joints, &places),
        };
        let room = room_for(seen, &joints);
        let projection =
            projection::best_projection(to_be_seen, &links, m.frame_link(), room, sight);
        for p in &mut points {
            p.at = projection.flat_point(p.place);
        }
        let mut out = Kinematic {
            subject,
            spots: place_spots(subject, &joints, &places, &projection),
            wires: Vec::new(),
            links,
            grounds: Vec::new(),
            places,
            points,
            traces: (Vec::new(), false),
            arrows: Vec::new(),
            shows: None,
            projection,
        };
        out.wires = [out.link_wires(), out.pitch_wires()].concat();
        out.grounds = out.find_grounds();
        out
    }

    /// Returns the ground at each place of the frame's joints, in the direction with the most room.
    fn find_grounds(&self) -> Vec<Ground> {
        let mut out: Vec<Ground> = Vec::new();
        let frame = self.links.iter().find(|(l, _)| self.is_frame(*l));
        let of = frame.map_or(&[][..], |(_, of)| of);
        for (n, &i) in of.iter().enumerate() {
            let Spot { at, rect, .. } = self.spots[i];
            let is_here = |k: &usize| one_place(self.spots[*k].at, at);
            if of[..n].iter().any(is_here) {
                continue;
            }
            let (here, elsewhere): (Vec<usize>, Vec<usize>) =
                (0..self.spots.len()).partition(is_here);
            let spot = GroundSpot {
                at,
                dirs: self.directions_out(at, &here),
                room: here.iter().fold(rect, |r, &k| r.with(&self.spots[k].rect)),
                rail: here
                    .iter()
                    .filter(|k| of.contains(k))
                    .find_map(|&k| self.rail_of(k)),
            };
            let elsewhere = elsewhere.into_iter().map(|k| self.spots[k].rect);
            out.extend(spot.best_ground(&elsewhere.collect::<Vec<_>>(), &out));
        }
        out
    }

    /// Returns the directions in which moving links leave some joints: to their other joints, and to their free ends.
    fn directions_out(&self, at: Point, here: &[usize]) -> Vec<Point> {
        let leaves = |row: &usize| {
            let (link, of) = &self.links[*row];
            !self.is_frame(*link) && of.iter().any(|j| here.contains(j))
        };
        let ends = (0..self.links.len()).filter(leaves).flat_map(|row| {
            let others = self.links[row].1.iter().filter(|j| !here.contains(j));
            let others = others.map(|&j| self.spots[j].at);
            others.chain(self.loose_end(row))
        });
        ends.map(|end| sub(end, at)).collect()
    }

    /// Returns the direction on paper of a block that slides, and how far its side is from its middle. `None` if it is seen from its end.
    fn rail_of(&self, i: usize) -> Option<(Point, f64)> {
        let spot = &self.spots[i];
        let of = &self.subject.mechanism.joints[spot.joint].joint_type;
        let along = self.projection.view.flat_vector(self.places[i].z);
        let side = side_of_slide(of).filter(|_| plane_norm(along) > 0.5)?;
        Some((unit(along), side * spot.symbol.size + 2.0))
    }
}

/// Returns the links of some joints, each with the indices of its joints.
fn joined_links(m: &Mechanism, joints: &[JointId]) -> Vec<(LinkId, Vec<usize>)> {
    let links = m.link_ids().map(|l| (l, joints_of_link(m, joints, l)));
    links.filter(|(_, of)| !of.is_empty()).collect()
}

/// Returns the space for the joints. Symbols do not grow, so a large number of joints needs more space.
fn room_for(m: &Mechanism, joints: &[JointId]) -> Point {
    let more = roominess(m, joints) * (joints.len() as f64 / 12.0).sqrt().clamp(1.0, 3.0);
    ROOM.map(|r| r * more)
}

/// Returns the axes about which outputs turn in the frame.
fn turning_axes(m: &Mechanism, joints: &[JointId], places: &[JointInSpace]) -> Vec<Vector> {
    let with = |j: JointId, role: Role| m.joints[j].links.iter().any(|&l| m.links[l].role == role);
    let turns = |j: JointId| m.joints[j].joint_type.freedoms().contains(&Freedom::Rz);
    let all = joints.iter().zip(places);
    let outputs = all.filter(|(j, _)| with(**j, Role::Frame) && with(**j, Role::Output));
    outputs
        .filter(|(j, _)| turns(**j))
        .map(|(_, p)| p.z)
        .collect()
}

/// Returns the joints on paper with their symbols. Joints at one place share the room.
fn place_spots(
    subject: &Subject<'_>,
    joints: &[JointId],
    places: &[JointInSpace],
    projection: &Projection,
) -> Vec<Spot> {
    let m = subject.mechanism;
    let at: Vec<Point> = places
        .iter()
        .map(|p| projection.flat_point(p.point))
        .collect();
    let of: Vec<&Joint> = joints.iter().map(|&j| &m.joints[j]).collect();
    let sizes = symbol_sizes(&at, &of);
    let driven = driven_slides(m, subject.state);
    let spots = joints.iter().zip(&at).zip(sizes);
    let spots = spots.map(|((&joint, &at), size)| {
        let of = &m.joints[joint];
        let symbol = Symbol::new(
            subject,
            joint,
            &of.joint_type,
            &projection::frame_in_numbers(&of.frame),
            &projection.view,
            size,
            driven.iter().find(|(j, _)| *j == joint).map(|d| d.1),
        );
        Spot {
            joint,
            at,
            rect: symbol.room.moved_by(at),
            symbol,
        }
    });
    spots.collect()
}
