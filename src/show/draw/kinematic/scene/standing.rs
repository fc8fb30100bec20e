//! The symbols and shapes on the links of a scene, and the symbols of redesigns.

use crate::draw::kinematic::scene::{Scene, round_fine, scene_pixels};
use crate::draw::kinematic::{Kinematic, body};
use crate::draw::place::projection::{self, cross, norm};
use crate::draw::prelude::*;
use crate::draw::symbol::ground::Ground;
use crate::draw::symbol::pieces::Piece;
use crate::draw::symbol::placed::{self, Swap, Symbol, one_place};
use serde_json::{Value, json};

/// Half the length of the guide that a ground shows in turned views, in pixels.
const HALF_GUIDE: f64 = 34.0;

impl Kinematic<'_> {
    /// Returns a scene with everything that is fixed to links.
    pub(super) fn build_scene(&self) -> Scene {
        let mut out = self.bare_scene();
        for wire in &self.wires {
            let class = self.draw_wire(wire, |p| p).class;
            let form = wire.form.word();
            out.add_wire(self, wire.row, &class, form, &wire.points, None);
        }
        self.add_points(&mut out);
        let order = self.outer_first();
        self.add_joints(&mut out, &order);
        self.add_couplings(&mut out, &order);
        for ground in &self.grounds {
            self.add_ground(&mut out, ground);
        }
        out
    }

    /// Returns the view and the links, without symbols.
    fn bare_scene(&self) -> Scene {
        let view = &self.projection.view;
        let m = self.subject.mechanism;
        Scene {
            view: [view.right, view.up, view.toward].map(round_fine),
            upright: round_fine(upright_axis(view)),
            origin: [0.0; 2],
            room: [0.0; 4],
            scale: self.projection.scale,
            middle: self.projection.middle,
            names: self
                .links
                .iter()
                .map(|(l, _)| m.links[*l].id.clone())
                .collect(),
            frame: self.link_row(m.frame_link()),
            symbols: Vec::new(),
            joints: Vec::new(),
            couplings: Vec::new(),
            wires: Vec::new(),
            moves: Vec::new(),
            stresses: Vec::new(),
            swaps: Vec::new(),
        }
    }

    /// Adds the points of interest, before the joints.
    fn add_points(&self, out: &mut Scene) {
        for p in &self.points {
            let corners = body::mark_corners([0.0; 2]);
            let mark = Shape::path("ink", corners.to_vec(), true);
            let symbol = out.symbol_number(vec![Piece::on_paper(&mark)]);
            let row = self.link_row(p.link);
            let mut point = self.standing_json(p.place, [row; 2], symbol);
            point["id"] = json!(p.id);
            out.joints.push(point);
        }
    }

    fn add_joints(&self, out: &mut Scene, order: &[usize]) {
        let m = self.subject.mechanism;
        for &i in order {
            let spot = &self.spots[i];
            let mark = self.subject.joint_mark(spot.joint);
            let of = &m.joints[spot.joint].joint_type;
            let symbol = out.symbol_number(spot.symbol.all_pieces(mark));
            let (rides, guides) = self.carrier_links(i);
            let place = &self.places[i];
            let links = [rides, guides].map(|l| self.link_row(l));
            let mut joint = self.standing_json(place.point, links, symbol);
            joint["axes"] = json!([place.x, place.y, place.z].map(round_fine));
            joint["pair"] = self.pair_json(i, of);
            joint["id"] = json!(m.joints[spot.joint].id);
            out.joints.push(joint);
        }
    }

    fn add_couplings(&self, out: &mut Scene, order: &[usize]) {
        let row = |joint: JointId| {
            let at = order.iter().position(|&i| self.spots[i].joint == joint);
            at.map(|n| self.points.len() + n)
        };
        let couplings = self.subject.mechanism.couplings_in(self.subject.state);
        out.couplings = couplings.filter_map(|c| self.tie_json(c, row)).collect();
    }

    /// Adds the ground of a joint for turned views. It is straight below in every view, with the guide of a sliding part.
    fn add_ground(&self, out: &mut Scene, ground: &Ground) {
        let there = |i: &usize| one_place(self.spots[*i].at, ground.from);
        let Some(i) = (0..self.spots.len()).find(there) else {
            return;
        };
        let frame = self.link_row(self.subject.mechanism.frame_link());
        let place = self.places[i].point;
        let reach = self.spots[i].symbol.reach_of_room() + 6.0;
        let shapes = Ground::under_pivot([0.0; 2], [0.0, reach]).ground_shapes();
        let symbol = out.symbol_number(shapes.iter().map(Piece::on_paper).collect());
        let mut below = self.standing_json(place, [frame; 2], symbol);
        below["turned"] = json!(true);
        out.joints.push(below);
        if let Some(axis) = self.slide_axis(i) {
            let half = scale(axis, HALF_GUIDE / self.projection.scale);
            let ends = [sub(place, half), add(place, half)];
            out.add_wire(self, frame, "guide", "line", &ends, None);
            if let Some(guide) = out.wires.last_mut() {
                guide["turned"] = json!(true);
            }
        }
    }

    /// Returns a symbol with the axes of the file, in every view.
    fn standing_json(&self, at: Vector, links: [usize; 2], symbol: usize) -> Value {
        json!({
            "at": scene_pixels(self, at),
            "axes": [X, Y, Z],
            // The link that carries its place, and the one that carries its axes.
            "links": links,
            "symbol": symbol,
            // Whether it is there in turned views only.
            "turned": false,
            // What it leaves free; nothing for what is no joint.
            "pair": null,
            // Of the joint or of the point of interest; nothing for what is neither.
            "id": null,
        })
    }

    /// Makes room for what a swap puts at a joint, and returns that with the number of the joint's spot and its axes; `None` if
    /// the joint is not drawn.
    pub(crate) fn make_room(&mut self, swap: &Swap<'_>) -> Option<(usize, Symbol, JointInSpace)> {
        let i = self.spots.iter().position(|s| s.joint == swap.joint)?;
        let place = projection::frame_in_numbers(&swap.option.frame);
        let of = &swap.option.joint_type;
        let symbol = self.symbol_of(i, of, &place);
        let spot = &mut self.spots[i];
        spot.rect = spot.rect.with(&symbol.room.moved_by(spot.at));
        Some((i, symbol, place))
    }

    /// Returns the symbols of swaps in a scene whose joints start with the points of interest, and makes room for them.
    pub(crate) fn swap_in(&mut self, scene: &mut Scene, swaps: &[Swap<'_>]) -> Vec<Value> {
        let order = self.outer_first();
        let mut out = Vec::new();
        for swap in swaps {
            let Some((i, symbol, place)) = self.make_room(swap) else {
                continue;
            };
            let mut parts = symbol.all_pieces(Mark::Changed);
            if swap.unloading {
                parts.push(Piece::on_paper(&placed::unloading_ring(
                    symbol.reach_of_room(),
                )));
            }
            let n = order.iter().position(|&k| k == i).unwrap_or_default();
            let axes = [place.x, place.y, place.z].map(round_fine);
            out.push(json!({
                "joint": self.points.len() + n,
                "axes": axes,
                "symbol": scene.symbol_number(parts),
            }));
        }
        out
    }
}

/// Returns the upright axis of all views: z, or the upward direction on paper if z is not upright in this view.
fn upright_axis(view: &View) -> Vector {
    let level = dot(view.right, Z).abs() < 1e-6 && norm(cross(view.toward, Z)) > 1e-3;
    let upside = dot(view.up, Z) < 0.0;
    match (level, upside) {
        (true, false) => Z,
        (true, true) => scale(Z, -1.0),
        _ => view.up,
    }
}

impl Kinematic<'_> {
    /// Returns what a type leaves free at a joint: its freedoms in order, where slides go along axes of the second link where turns come
    /// before them.
    pub(crate) fn pair_json(&self, i: usize, of: &JointType) -> Value {
        let joint = &self.subject.mechanism.joints[self.spots[i].joint];
        let free = of.freedoms();
        let screws = free.contains(&Freedom::Screw);
        let pitch = if screws {
            joint.frame.pitch.to_f64()
        } else {
            0.0
        };
        json!({
            "free": free.iter().map(|f| f.name()).collect::<Vec<_>>(),
            // Whether the first of the scene's two links is the joint's second.
            "swapped": self.carrier_links(i).0 != joint.links[0],
            // Pixels along z for each radian about it, of a screw.
            "pitch": pitch * self.projection.scale,
        })
    }

    /// Returns a coupling between joints of a scene, in radians and pixels: the changes of the two freedoms times their
    /// factors add up to 0. Returns `None` if a joint is not drawn.
    pub(crate) fn tie_json(
        &self,
        coupling: &Coupling,
        row: impl Fn(JointId) -> Option<usize>,
    ) -> Option<Value> {
        let [a, b] = coupling.ends;
        let unit = |f: Freedom| {
            if f.is_slide() {
                self.projection.scale
            } else {
                1.0
            }
        };
        // the rate of the second is the ratio times the rate of the first
        let factors = [coupling.ratio.to_f64(), -1.0];
        Some(json!({
            "joints": [row(a.joint)?, row(b.joint)?],
            "freedoms": [a.freedom.name(), b.freedom.name()],
            "factors": [factors[0] / unit(a.freedom), factors[1] / unit(b.freedom)],
        }))
    }
}
