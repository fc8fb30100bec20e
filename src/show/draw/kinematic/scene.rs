//! A kinematic scheme in space, for a program that turns and moves it: shapes and symbols by link, and the poses.
//!
//! All lengths are pixels of the drawing it belongs to, from the point whose place on paper is its origin.

use crate::draw::kinematic::body::{Arrow, known_loads};
use crate::draw::kinematic::moving::frame::Carried;
use crate::draw::kinematic::moving::{Moving, flag_row};
use crate::draw::kinematic::{Kinematic, MovingPicture};
use crate::draw::prelude::*;
use crate::draw::symbol::pieces::{Piece, round_hundredth};
use crate::draw::symbol::placed::Swap;
use crate::motion::pose::Pose;
use serde::Serialize;
use serde_json::{Value, json};

mod standing;

/// A scheme in space.
#[derive(Debug, Clone, Serialize)]
pub struct Scene {
    /// Right, up and towards the reader in the view of the drawing.
    view: [Vector; 3],
    /// The axis of a drag to the side.
    upright: Vector,
    /// The place of the origin on the sheet.
    origin: Point,
    /// The part of the sheet that the scheme is in: left, top, right, bottom.
    room: [f64; 4],
    /// Pixels of a unit of the file's length, and the place in the file's coordinates that is the origin.
    scale: f64,
    middle: Vector,
    /// The ids of its links.
    names: Vec<String>,
    /// The link that rests.
    frame: usize,
    /// The pieces of each symbol.
    symbols: Vec<Vec<Piece>>,
    /// Symbols at their places.
    joints: Vec<Value>,
    couplings: Vec<Value>,
    /// Shapes fixed to links.
    wires: Vec<Value>,
    moves: Vec<Value>,
    stresses: Vec<Value>,
    /// What redesigns put at its joints, in the order they were given: the number of the joint among those of the scene, and its symbol.
    swaps: Vec<Value>,
}

/// Draws the kinematic scheme at the pose of the first of some motions, with the data for pictures of other poses. There is at least one
/// motion, which may be of one pose; self-stresses have names; swaps are what redesigns may put at the joints. Groups of the drawing can
/// be replaced by such pictures: `data-scene` marks moving parts, `data-home` parts of this view only.
#[must_use]
pub fn kinematic_scene(
    subject: &Subject<'_>,
    moves: &[Moving],
    stresses: &[(String, &SelfStress)],
    swaps: &[Swap<'_>],
) -> (Drawing, Scene) {
    let mut rest = Kinematic::new(subject, &Sight::default());
    let of: Vec<Vec<Carried<'_>>> = moves.iter().map(Moving::poses).collect();
    let mut scene = rest.build_scene();
    scene.swaps = rest.swap_in(&mut scene, swaps);
    let mut frames = Vec::new();
    for (n, (moving, poses)) in moves.iter().zip(&of).enumerate() {
        let lines = rest.moving_lines(poses);
        frames.extend(poses.iter().map(|c| rest.picture_in(Some(c), &lines)));
        for line in &lines {
            let (class, form) = (line.class, line.form.word());
            scene.add_wire(&rest, line.row, class, form, &line.points, Some(n));
        }
        scene.add_move(&rest, moving, poses);
    }
    if let (Some(first), Some(poses)) = (moves.first(), of.first()) {
        rest.trace_motion(first, poses);
    }
    let start = moves.first().map_or(0, |m| m.way.start);
    let mut area = rest.room_of(&frames, start);
    let mut arrows = Vec::new();
    for (name, stress) in stresses {
        let own = rest.arrows_of(&known_loads(stress), None);
        area = rest.arrow_room(&own).map_or(area, |r| area.with(&r));
        let arrows_of: Value = own.iter().map(|a| rest.load_json(a)).collect();
        scene
            .stresses
            .push(json!({ "name": name, "arrows": arrows_of }));
        arrows.extend(own);
    }
    let mut legend = rest.legend_rows();
    legend.extend(frames.iter().find_map(flag_row));
    legend.extend(rest.arrow_rows(&arrows));
    let first = frames.swap_remove(start);
    let drawing = rest.draw_scene(&mut scene, &first, area, legend);
    (drawing, scene)
}

impl Scene {
    /// Returns the part of the sheet that the scheme covers: left, top, right, bottom.
    #[must_use]
    pub fn room(&self) -> [f64; 4] {
        self.room
    }

    /// Adds a motion, with the paths of its points relative to the frame.
    fn add_move(&mut self, rest: &Kinematic<'_>, moving: &Moving, poses: &[Carried<'_>]) {
        let way = &moving.way;
        let frame = rest.link_row(rest.subject.mechanism.frame_link());
        for (link, tip) in rest.traced_tips() {
            let trace: Vec<Vector> = poses.iter().map(|c| c.carried_point(link, tip)).collect();
            let form = if way.closed { "loop" } else { "line" };
            let n = self.moves.len();
            self.add_wire(rest, frame, "trace", form, &trace, Some(n));
        }
        let carried = poses.iter().map(|c| rest.carried_in_pixels(c));
        self.moves.push(json!({
            "name": moving.words,
            "closed": way.closed,
            "start": way.start,
            // Positions of the drive, pose by pose.
            "at": way.at.iter().map(|x| x * moving.unit.0).collect::<Vec<_>>(),
            "unit": moving.unit.1,
            // By pose and link a rotation vector and where the origin goes; nothing where the link rests.
            "poses": carried.collect::<Vec<_>>(),
        }));
    }

    fn add_wire(
        &mut self,
        of: &Kinematic<'_>,
        link: usize,
        class: &str,
        form: &'static str,
        points: &[Vector],
        motion: Option<usize>,
    ) {
        self.wires.push(json!({
            "link": link,
            "class": class,
            "form": form,
            "points": points.iter().map(|&p| scene_pixels(of, p)).collect::<Vec<_>>(),
            // The motion it belongs to, where it is not there in all.
            "of": motion,
            // Whether it is there in turned views only.
            "turned": false,
        }));
    }

    /// Returns the number of a symbol made of some pieces.
    pub(super) fn symbol_number(&mut self, parts: Vec<Piece>) -> usize {
        let known = self.symbols.iter().position(|s| *s == parts);
        known.unwrap_or_else(|| {
            self.symbols.push(parts);
            self.symbols.len() - 1
        })
    }
}

impl Kinematic<'_> {
    /// Returns the place of a link among the drawn links, including the frame.
    pub(super) fn link_row(&self, link: LinkId) -> usize {
        self.links
            .iter()
            .position(|(l, _)| *l == link)
            .unwrap_or_default()
    }

    /// Returns each link's rotation vector and the position of its origin, in pixels.
    fn carried_in_pixels(&self, c: &Carried<'_>) -> Vec<Vec<f64>> {
        let Pose { middle, .. } = c.pose;
        let centre = self.projection.in_pixels(*middle);
        let one = |(link, _): &(LinkId, Vec<usize>)| {
            let turn = c.links[*link].rotation_vector();
            let there = self.projection.in_pixels(c.carried_point(*link, *middle));
            let shift = sub(there, c.links[*link].map_direction(centre)).map(round_hundredth);
            let six = [turn.map(|x| (x * 1e5).round() / 1e5), shift].concat();
            let rests = six.iter().all(|x| *x == 0.0);
            if rests { Vec::new() } else { six }
        };
        self.links.iter().map(one).collect()
    }

    fn load_json(&self, a: &Arrow) -> Value {
        json!({ "at": scene_pixels(self, a.at), "along": a.along.map(round_hundredth), "turns": a.turns, "tip": a.tip })
    }

    /// Draws a picture of a scene in groups, and records in the scene where on the sheet it is.
    fn draw_scene(
        &self,
        scene: &mut Scene,
        picture: &MovingPicture,
        area: Rect,
        legend: Vec<(Swatch, String)>,
    ) -> Drawing {
        self.on_sheet(area, legend, |sheet, by| {
            scene.origin = by.map(round_hundredth);
            let area = area.moved_by(by);
            scene.room = [area.left, area.top, area.right, area.bottom].map(round_hundredth);
            sheet.draw_group("data-home", "ground", by, |s| self.draw_ground(s));
            sheet.draw_group("data-scene", "", [0.0; 2], |s| {
                s.draw_group("data-drawing", "", by, |s| self.draw_at_rest(s, picture));
            });
        })
    }
}

pub(super) fn round_fine(v: Vector) -> Vector {
    v.map(|x| (x * 1e6).round() / 1e6)
}

fn scene_pixels(of: &Kinematic<'_>, p: Vector) -> Vector {
    of.projection.in_pixels(p).map(round_hundredth)
}
