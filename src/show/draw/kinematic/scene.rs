//! A kinematic scheme in space, for a program that turns it and moves it: what stands on which link, and the poses.
//!
//! All lengths are pixels of the drawing it belongs to, from the point whose place on paper is its origin.

pub(in crate::draw::kinematic) mod pair;
pub(in crate::draw::kinematic) mod part;
pub(in crate::draw::kinematic) mod swapped;

use super::Kinematic;
use super::arrow::Arrow;
use super::moving::{Moved, flag_row, poses};
use crate::draw::kinematic::moving::frame::MovingPicture;
use crate::draw::kinematic::posed::Carried;
use crate::draw::kinematic::scene::pair::{Pair, Tie};
use crate::draw::kinematic::scene::part::{SymbolPart, below, paper, tidy};
use crate::draw::place::projection::{Vector, View, add, cross, dot, norm, scale, sub};
use crate::draw::place::view_direction::Sight;
use crate::draw::sheet::{Caption, Drawing, Sheet, plan};
use crate::draw::subject::Subject;
use crate::draw::symbol::swap::Swap;
use crate::geom::vector::Z;
use crate::model::mechanism::LinkId;
use crate::motion::pose::Pose;
use crate::redundancy::stress::SelfStress;
use crate::svg::plane::Point;
use serde::Serialize;

/// A scheme in space.
#[derive(Debug, Clone, Serialize)]
pub struct Scene {
    /// Right, up and towards the reader in the view of the drawing.
    view: [Vector; 3],
    /// What a drag to the side turns about.
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
    symbols: Vec<Vec<SymbolPart>>,
    joints: Vec<SceneJoint>,
    couplings: Vec<Tie>,
    wires: Vec<Wire>,
    moves: Vec<Move>,
    stresses: Vec<Stress>,
    /// What redesigns put at its joints, in the order they were given.
    swaps: Vec<Swapped>,
}

/// What a scene shows besides the mechanism.
#[derive(Debug, Clone, Copy)]
pub struct Shown<'a> {
    /// The motions, each with a name; at least one, which may be of one pose.
    pub moves: &'a [(String, Moved<'a>)],
    /// The self-stresses, each with a name.
    pub stresses: &'a [(String, &'a SelfStress)],
    /// What redesigns may put at its joints.
    pub swaps: &'a [Swap<'a>],
}

/// What stands at a joint of a scene instead of what is there.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Swapped {
    /// The joint, by its number among those of the scene.
    pub(super) joint: usize,
    pub(super) axes: [Vector; 3],
    pub(super) symbol: usize,
    pub(super) pair: Pair,
}

/// A symbol at its place.
#[derive(Debug, Clone, Serialize)]
struct SceneJoint {
    at: Vector,
    axes: [Vector; 3],
    /// The link that carries its place, and the one that carries its axes.
    links: [usize; 2],
    symbol: usize,
    /// Whether it is there in turned views only.
    turned: bool,
    /// What it leaves free; nothing for what is no joint.
    pair: Option<Pair>,
    /// The id of the joint or of the point of interest; nothing for what is neither.
    id: Option<String>,
}

/// A shape fixed to a link.
#[derive(Debug, Clone, Serialize)]
struct Wire {
    link: usize,
    class: String,
    form: &'static str,
    points: Vec<Vector>,
    /// The motion it belongs to, where it is not there in all.
    of: Option<usize>,
    /// Whether it is there in turned views only.
    turned: bool,
}

#[derive(Debug, Clone, Serialize)]
struct Move {
    name: String,
    closed: bool,
    start: usize,
    /// By pose and link a rotation vector and where the origin goes; nothing where the link rests.
    poses: Vec<Vec<Vec<f64>>>,
}

#[derive(Debug, Clone, Serialize)]
struct Stress {
    name: String,
    arrows: Vec<LinkArrow>,
}

/// An arrow on a link.
#[derive(Debug, Clone, Serialize)]
struct LinkArrow {
    at: Vector,
    along: Vector,
    turns: bool,
    tip: String,
}

/// Draws the kinematic scheme at the pose of its first motion, in groups that a program may put another picture in place of
/// (`data-scene` for what moves, `data-home` for what is of this view only), with what it takes to make such pictures.
#[must_use]
pub fn kinematic_scene(subject: &Subject<'_>, sight: &Sight, shown: Shown<'_>) -> (Drawing, Scene) {
    let mut rest = Kinematic::new(subject, sight);
    let of: Vec<Vec<Carried<'_>>> = shown.moves.iter().map(|(_, m)| poses(m)).collect();
    let mut scene = rest.scene();
    scene.swaps = rest.swap_in(&mut scene, shown.swaps);
    let mut frames = Vec::new();
    for (n, ((name, moved), poses)) in shown.moves.iter().zip(&of).enumerate() {
        let lines = rest.moving_lines(poses);
        frames.extend(poses.iter().map(|c| rest.frame(c, &lines)));
        for line in &lines {
            let row = rest.row(line.link);
            scene.wire(&rest, row, line.class, "line", &line.ends, Some(n));
        }
        let frame = rest.row(subject.mechanism.frame());
        for (link, tip) in rest.tips() {
            let way: Vec<Vector> = poses.iter().map(|c| c.point(link, tip)).collect();
            let form = if moved.way.closed { "loop" } else { "line" };
            scene.wire(&rest, frame, "trace", form, &way, Some(n));
        }
        let carried = poses.iter().map(|c| rest.carried_in_pixels(c));
        scene.moves.push(Move {
            name: name.clone(),
            closed: moved.way.closed,
            start: moved.way.start,
            poses: carried.collect(),
        });
    }
    if let (Some((_, first)), Some(poses)) = (shown.moves.first(), of.first()) {
        rest.traces = (rest.ways(poses), first.way.closed);
    }
    let start = shown.moves.first().map_or(0, |(_, m)| m.way.start);
    let mut area = rest.room_of(&frames, start);
    let mut arrows = Vec::new();
    for (name, stress) in shown.stresses {
        let own = rest.arrows_of(stress);
        area = rest.arrow_room(&own).map_or(area, |r| area.with(&r));
        scene.stresses.push(Stress {
            name: name.clone(),
            arrows: own.iter().map(|a| rest.load(a)).collect(),
        });
        arrows.extend(own);
    }
    let title = subject.title();
    let subtitle = subject.subtitle(&rest.what());
    let mut legend = rest.legend();
    legend.extend(frames.iter().find_map(flag_row));
    legend.extend(rest.arrow_rows(&arrows));
    let caption = Caption {
        title: &title,
        subtitle: [&subtitle[0], &subtitle[1]],
        description: &rest.description(),
        legend,
    };
    let plan = plan(&caption, area, super::STRIP);
    let by = plan.shift;
    scene.origin = by.map(tidy);
    let area = area.moved(by);
    scene.room = [area.left, area.top, area.right, area.bottom].map(tidy);
    let mut first = frames.swap_remove(start);
    first.all().for_each(|p| *p = [p[0] + by[0], p[1] + by[1]]);
    rest.shift_ground(by);
    let mut sheet = Sheet::new(&caption, &plan);
    sheet.group("data-home", "ground", [0.0; 2], |s| rest.draw_ground(s));
    sheet.group("data-scene", "", [0.0; 2], |s| {
        rest.draw_traces(s);
        rest.draw_frame(s, &first);
    });
    sheet.group("data-home", "scale", [0.0; 2], |s| {
        rest.draw_below(s, &plan)
    });
    (sheet.finish(&caption, &plan), scene)
}

impl Scene {
    /// The part of the sheet that the scheme is in: left, top, right, bottom.
    #[must_use]
    pub fn room(&self) -> [f64; 4] {
        self.room
    }

    fn wire(
        &mut self,
        of: &Kinematic<'_>,
        link: usize,
        class: &str,
        form: &'static str,
        points: &[Vector],
        motion: Option<usize>,
    ) {
        let points = points.iter().map(|&p| pixels(of, p));
        self.wires.push(Wire {
            link,
            class: class.to_owned(),
            form,
            points: points.collect(),
            of: motion,
            turned: false,
        });
    }

    /// The number of a symbol of some pieces.
    pub(super) fn symbol(&mut self, parts: Vec<SymbolPart>) -> usize {
        let known = self.symbols.iter().position(|s| *s == parts);
        known.unwrap_or_else(|| {
            self.symbols.push(parts);
            self.symbols.len() - 1
        })
    }
}

impl Kinematic<'_> {
    /// The place of a link among those drawn, the frame included.
    pub(super) fn row(&self, link: LinkId) -> usize {
        self.links
            .iter()
            .position(|(l, _)| *l == link)
            .unwrap_or_default()
    }

    /// What stands on the links.
    fn scene(&self) -> Scene {
        let view = &self.projection.view;
        let m = self.subject.mechanism;
        let mut out = Scene {
            view: [view.right, view.up, view.toward].map(fine),
            upright: fine(upright(view)),
            origin: [0.0; 2],
            room: [0.0; 4],
            scale: self.projection.scale,
            middle: self.projection.middle,
            names: self
                .links
                .iter()
                .map(|(l, _)| m.links[*l].id.clone())
                .collect(),
            frame: self.row(m.frame()),
            symbols: Vec::new(),
            joints: Vec::new(),
            couplings: Vec::new(),
            wires: Vec::new(),
            moves: Vec::new(),
            stresses: Vec::new(),
            swaps: Vec::new(),
        };
        for row in 0..self.links.len() {
            if self.is_frame(self.links[row].0) {
                continue;
            }
            let body = self.body(row);
            let class = self.look(row, &body);
            match self.arc_in_space(row).or_else(|| self.bowed_in_space(row)) {
                Some(points) => out.wire(self, row, &class, "line", &points, None),
                None => {
                    let facet = self.facets[row].clone();
                    let points = facet.unwrap_or_else(|| self.points_in_space(row));
                    out.wire(self, row, &class, "hull", &points, None);
                }
            }
        }
        for coupling in m.couplings_in(self.subject.state) {
            for (end, circle) in self.pitch_circles_in_space(coupling, &self.places) {
                let [a, b] = m.joints[coupling.ends[end].joint]
                    .links
                    .map(|l| self.row(l));
                let link = if self.is_frame(self.links[a].0) { b } else { a };
                out.wire(self, link, "fine pitch", "loop", &circle, None);
            }
        }
        let frame = self.row(m.frame());
        for p in &self.points {
            let corners = super::marked::corners([0.0; 2]).to_vec();
            let symbol = out.symbol(vec![paper("ink", corners, true)]);
            let row = self.row(p.link);
            out.joints.push(SceneJoint {
                id: Some(p.id.clone()),
                ..self.standing(p.place, [row; 2], symbol, false)
            });
        }
        let order = self.outer_first();
        for &i in &order {
            let spot = &self.spots[i];
            let mark = self.subject.joint_mark(spot.joint);
            let of = &m.joints[spot.joint].joint_type;
            let symbol = out.symbol(self.parts(spot.joint, of, &spot.symbol, mark));
            let (rides, guides) = self.carriers(i);
            let place = &self.places[i];
            out.joints.push(SceneJoint {
                axes: [place.x, place.y, place.z].map(fine),
                pair: Some(self.pair(i, of)),
                id: Some(m.joints[spot.joint].id.clone()),
                ..self.standing(
                    place.point,
                    [rides, guides].map(|l| self.row(l)),
                    symbol,
                    false,
                )
            });
        }
        let row = |joint| {
            let at = order.iter().position(|&i| self.spots[i].joint == joint);
            at.map(|n| self.points.len() + n)
        };
        let couplings = m.couplings_in(self.subject.state);
        out.couplings = couplings.filter_map(|c| self.tie(c, row)).collect();
        // the ground, straight below whatever the view
        for ground in &self.grounds {
            let there = |i: &usize| {
                crate::draw::symbol::concentric::one_place(self.spots[*i].at, ground.from)
            };
            let Some(i) = (0..self.spots.len()).find(there) else {
                continue;
            };
            let reach = self.spots[i].symbol.reach() + 6.0;
            let symbol = out.symbol(below(reach));
            out.joints
                .push(self.standing(self.places[i].point, [frame; 2], symbol, true));
            if let Some(axis) = self.slide_axis(i) {
                let half = scale(axis, 34.0 / self.projection.scale);
                let p = self.places[i].point;
                out.wire(
                    self,
                    frame,
                    "guide",
                    "line",
                    &[sub(p, half), add(p, half)],
                    None,
                );
                out.wires
                    .iter_mut()
                    .last()
                    .into_iter()
                    .for_each(|w| w.turned = true);
            }
        }
        out
    }

    fn standing(&self, at: Vector, links: [usize; 2], symbol: usize, turned: bool) -> SceneJoint {
        SceneJoint {
            at: pixels(self, at),
            axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], Z],
            links,
            symbol,
            turned,
            pair: None,
            id: None,
        }
    }

    /// By link, its rotation vector and where the origin goes, in pixels.
    fn carried_in_pixels(&self, c: &Carried<'_>) -> Vec<Vec<f64>> {
        let Pose { middle, .. } = c.pose;
        let centre = self.projection.in_pixels(*middle);
        let one = |(link, _): &(LinkId, Vec<usize>)| {
            let turn = c.links[*link].rotation_vector();
            let there = self.projection.in_pixels(c.point(*link, *middle));
            let shift = sub(there, c.links[*link].direction(centre)).map(tidy);
            let six = [turn.map(|x| (x * 1e5).round() / 1e5), shift].concat();
            let rests = six.iter().all(|x| *x == 0.0);
            if rests { Vec::new() } else { six }
        };
        self.links.iter().map(one).collect()
    }

    fn load(&self, a: &Arrow) -> LinkArrow {
        LinkArrow {
            at: pixels(self, a.at),
            along: a.along.map(tidy),
            turns: a.turns,
            tip: a.tip.clone(),
        }
    }

    /// A picture by itself.
    fn draw_frame(&self, sheet: &mut Sheet, frame: &MovingPicture) {
        frame.draw(self, sheet);
        for i in self.outer_first() {
            let spot = &self.spots[i];
            sheet.symbol(spot.rect);
            let mark = self.subject.joint_mark(spot.joint);
            sheet.group(
                "data-joint",
                &self.subject.mechanism.joints[spot.joint].id,
                frame.at[i],
                |s| {
                    self.symbol_in(i, &frame.places[i])
                        .draw(s, self.subject, spot.joint, mark);
                },
            );
        }
    }
}

/// What goes up in all views: z, or what goes up on paper where z is not upright in this one.
fn upright(view: &View) -> Vector {
    let level = dot(view.right, Z).abs() < 1e-6 && norm(cross(view.toward, Z)) > 1e-3;
    let upside = dot(view.up, Z) < 0.0;
    match (level, upside) {
        (true, false) => Z,
        (true, true) => scale(Z, -1.0),
        _ => view.up,
    }
}

pub(super) fn fine(v: Vector) -> Vector {
    v.map(|x| (x * 1e6).round() / 1e6)
}

fn pixels(of: &Kinematic<'_>, p: Vector) -> Vector {
    of.projection.in_pixels(p).map(tidy)
}
