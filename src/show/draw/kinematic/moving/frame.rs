//! One picture of a moving scheme: where a pose has carried everything.

use crate::draw::kinematic::body::{Marked, Wire, WireForm, draw_mark};
use crate::draw::kinematic::{Kinematic, MovingPicture};
use crate::draw::place::projection::{cross, norm, scale as times};
use crate::draw::prelude::*;
use crate::draw::symbol::placed::one_place;
use crate::geom::rigid::RigidMotion;
use crate::geom::vector::unit;
use crate::motion::pose::Pose;

/// The length of a flag, in pixels.
const FLAG: f64 = 26.0;
/// A displacement below this, in pixels, is not visible.
const STILL: f64 = 2.0;
/// What turns by less than this, in radians, is not seen to.
const UPRIGHT: f64 = 0.05;

impl Kinematic<'_> {
    /// Returns the points of a link that its shape passes through.
    pub(crate) fn points_in_space(&self, link: usize) -> Vec<Vector> {
        let whole = &self.links[link];
        let own = whole.1.iter().map(|&i| self.places[i].point);
        let own = own.chain(self.points_of(whole.0).map(|p| p.place));
        own.chain(self.loose_in_space(link)).collect()
    }

    /// Returns the middle of those points.
    pub(crate) fn middle_in_space(&self, link: usize) -> Vector {
        let points = self.points_in_space(link);
        let sum = points.iter().fold([0.0; 3], |s, &p| add(s, p));
        times(sum, 1.0 / points.len() as f64)
    }

    /// Returns the lines on links that move over some poses. Rails are as long as the travel of their blocks.
    pub(crate) fn moving_lines(&mut self, poses: &[Carried<'_>]) -> Vec<Wire> {
        let slides = self.slide_ranges(poses);
        self.lengthen_rails(&slides);
        let mut lines = self.guide_lines(&slides);
        lines.extend(self.flag_lines(poses));
        lines
    }

    /// Returns the lines that blocks slide along, on moving links.
    fn guide_lines(&self, slides: &[Option<[f64; 2]>]) -> Vec<Wire> {
        let one = |(i, range): (usize, &Option<[f64; 2]>)| {
            let (range, axis) = ((*range)?, self.slide_axis(i)?);
            let (_, link) = self.carrier_links(i);
            let ends = range.map(|x| add(self.places[i].point, times(axis, x)));
            let there = !self.is_frame(link) && range[1] > range[0];
            there.then(|| self.line_wire("guide", link, ends))
        };
        slides.iter().enumerate().filter_map(one).collect()
    }

    /// Returns a flag on each link that turns while none of its drawn lines move: a rod about its own axis, a gear about its
    /// axle.
    fn flag_lines(&self, poses: &[Carried<'_>]) -> Vec<Wire> {
        let one = |row: usize| {
            let link = self.links[row].0;
            let points = self.points_in_space(row);
            let far = |c: &Carried<'_>, p: Vector| norm(sub(c.carried_point(link, p), p));
            let moves = |&p: &Vector| {
                let scale = self.projection.scale;
                poses.iter().any(|c| far(c, p) * scale > STILL)
            };
            if self.is_frame(link) || points.iter().any(moves) {
                return None;
            }
            let turns = poses.iter().map(|c| c.links[link].rotation_vector());
            let about = turns.max_by(|a, b| norm(*a).total_cmp(&norm(*b)))?;
            if norm(about) < UPRIGHT {
                return None;
            }
            let (about, view) = (unit(about), &self.projection.view);
            // aslant, so that a little turn either way is seen
            let side = cross(about, view.toward);
            let out = if norm(side) > 0.1 {
                let side = unit(side);
                unit(add(side, cross(about, side)))
            } else {
                unit(sub(view.up, times(about, dot(view.up, about))))
            };
            let from = self.middle_in_space(row);
            let to = add(from, times(out, FLAG / self.projection.scale));
            Some(self.line_wire("flag", link, [from, to]))
        };
        (0..self.links.len()).filter_map(one).collect()
    }

    fn line_wire(&self, class: &'static str, link: LinkId, ends: [Vector; 2]) -> Wire {
        Wire {
            row: self.link_row(link),
            class,
            form: WireForm::Line,
            points: ends.to_vec(),
        }
    }

    /// Returns the picture of a pose, or of the pose of the file.
    pub(crate) fn picture_in(&self, pose: Option<&Carried<'_>>, lines: &[Wire]) -> MovingPicture {
        let carried = |link, p| pose.map_or(p, |c| c.carried_point(link, p));
        let flat = |link, p| self.projection.flat_point(carried(link, p));
        let place = |(i, own): (usize, &JointInSpace)| {
            let (rides, guides) = self.carrier_links(i);
            pose.map_or_else(|| own.clone(), |c| c.carried_place(rides, guides, own))
        };
        let places: Vec<JointInSpace> = self.places.iter().enumerate().map(place).collect();
        let wires = self.wires.iter().chain(lines);
        let wires = wires.map(|w| self.draw_wire(w, |p| carried(self.links[w.row].0, p)));
        MovingPicture {
            points: self.points.iter().map(|p| flat(p.link, p.place)).collect(),
            at: places
                .iter()
                .map(|p| self.projection.flat_point(p.point))
                .collect(),
            wires: wires.collect(),
            places,
            arrows: Vec::new(),
        }
    }

    /// Draws everything but the symbols of joints; parts that are `named` stand in groups that say what each is.
    pub(crate) fn draw_picture(&self, sheet: &mut Sheet, picture: &MovingPicture, named: bool) {
        for wire in picture.wires.iter().filter(|w| w.points.len() > 1) {
            let d = path_data(&wire.points, wire.closed);
            let id = &self.subject.mechanism.links[self.links[wire.row].0].id;
            if named && wire.link {
                sheet.draw_group("data-link", id, [0.0; 2], |s| {
                    s.path_with_tip(&wire.class, &d, &format!("link {id}"));
                });
            } else {
                sheet.draw_path(&wire.class, &d);
            }
        }
        for (marked, &p) in self.points.iter().zip(&picture.points) {
            if named {
                sheet.draw_group("data-point", &marked.id, [0.0; 2], |s| draw_mark(s, p));
            } else {
                draw_mark(sheet, p);
            }
        }
    }
}

/// The displacement of the links in a pose.
pub(crate) struct Carried<'p> {
    pub(crate) pose: &'p Pose,
    pub(crate) links: &'p [RigidMotion],
}

impl Carried<'_> {
    pub(crate) fn carried_point(&self, link: LinkId, p: Vector) -> Vector {
        self.pose.carry_point(self.links, link, p)
    }

    pub(crate) fn carried_place(
        &self,
        link: LinkId,
        frame: LinkId,
        place: &JointInSpace,
    ) -> JointInSpace {
        let turn = |v| self.links[frame].map_direction(v);
        place.carried_to(self.carried_point(link, place.point), turn)
    }
}

impl Kinematic<'_> {
    /// Returns how far along its axis each joint slides from its position at rest, over all poses. `None` for joints that do
    /// not slide.
    pub(crate) fn slide_ranges(&self, poses: &[Carried<'_>]) -> Vec<Option<[f64; 2]>> {
        let one = |i: usize| {
            let along = self.slide_axis(i)?;
            let (rides, guides) = self.carrier_links(i);
            let place = &self.places[i];
            let of = poses.iter().map(|c| {
                let apart = sub(
                    c.carried_point(rides, place.point),
                    c.carried_point(guides, place.point),
                );
                dot(apart, c.links[guides].map_direction(along))
            });
            Some(of.fold([0.0f64, 0.0], |[l, h], x| [l.min(x), h.max(x)]))
        };
        (0..self.spots.len()).map(one).collect()
    }

    /// Returns the direction that a joint slides in. `None` unless there is exactly one.
    pub(crate) fn slide_axis(&self, i: usize) -> Option<Vector> {
        let joint = &self.subject.mechanism.joints[self.spots[i].joint];
        let place = &self.places[i];
        let freedoms = joint.joint_type.freedoms();
        let axes = [
            (Freedom::Tx, place.x),
            (Freedom::Ty, place.y),
            (Freedom::Tz, place.z),
            (Freedom::Screw, place.z),
        ];
        let mut slides = axes.into_iter().filter(|(f, _)| freedoms.contains(f));
        let first = slides.next()?;
        slides.next().is_none().then_some(first.1)
    }

    /// Returns the link that the symbol of a joint moves with, and the link that it slides along. A block moves with a link
    /// that has no other shape, and preferably not with the frame. A slot belongs to the second link, and the pin in it to
    /// the first.
    pub(crate) fn carrier_links(&self, i: usize) -> (LinkId, LinkId) {
        let joint = &self.subject.mechanism.joints[self.spots[i].joint];
        let [a, b] = joint.links;
        if joint.joint_type.freedoms().contains(&Freedom::Tx) {
            return (a, b);
        }
        let small = |l: LinkId| {
            let of = self.links.iter().find(|(k, _)| *k == l);
            of.is_some_and(|(_, of)| {
                of.len() > 1
                    && of
                        .iter()
                        .all(|&k| one_place(self.spots[k].at, self.spots[i].at))
            })
        };
        if small(a) || self.is_frame(b) {
            (a, b)
        } else if small(b) || self.is_frame(a) {
            (b, a)
        } else {
            (a, b)
        }
    }

    /// Rails are as long as what slides along them needs.
    pub(crate) fn lengthen_rails(&mut self, slides: &[Option<[f64; 2]>]) {
        for (i, &range) in slides.iter().enumerate() {
            let (Some(range), Some(axis)) = (range, self.slide_axis(i)) else {
                continue;
            };
            if !self.is_frame(self.carrier_links(i).1) {
                continue;
            }
            let [low, high] = range.map(|x| {
                let flat = self.projection.view.flat_vector(times(axis, x));
                flat.map(|c| c * self.projection.scale)
            });
            let at = self.spots[i].at;
            let rail = self.grounds.iter_mut().find(|g| one_place(g.from, at));
            if let Some(g) = rail {
                g.lengthen_rail(low, high);
            }
        }
    }
}

impl Kinematic<'_> {
    /// Returns the points of a link.
    pub(crate) fn points_of(&self, link: LinkId) -> impl Iterator<Item = &Marked> {
        self.points.iter().filter(move |p| p.link == link)
    }

    pub(crate) fn draw_traces(&self, sheet: &mut Sheet) {
        let (ways, closed) = &self.traces;
        for way in ways {
            sheet.draw_path("trace", &path_data(way, *closed));
        }
    }

    /// Returns the legend rows of points and their paths.
    pub(crate) fn point_rows(&self) -> Vec<(Swatch, String)> {
        let mut out = Vec::new();
        if !self.points.is_empty() {
            let mark = |s: &mut Sheet| draw_mark(s, [0.0; 2]);
            let text = "point of interest, or face of a jaw".to_owned();
            out.push((Swatch::Symbol(mark), text));
        }
        if !self.traces.0.is_empty() {
            let of = if self.points.is_empty() {
                "way of a point of the output"
            } else {
                "way of a point"
            };
            out.push((Swatch::line("trace"), of.to_owned()));
        }
        out
    }

    /// Returns the points of interest. For an output link without any, returns its free end, or its joints except those
    /// on the frame.
    pub(crate) fn traced_tips(&self) -> Vec<(LinkId, Vector)> {
        let moving = self.points.iter().filter(|p| !self.is_frame(p.link));
        let mut out: Vec<(LinkId, Vector)> = moving.map(|p| (p.link, p.place)).collect();
        let bare = |l: LinkId| self.is_output(l) && self.points_of(l).next().is_none();
        for (row, (l, of)) in self.links.iter().enumerate() {
            if !bare(*l) {
                continue;
            }
            let mut seen: Vec<Point> = Vec::new();
            for &i in of {
                let spot = &self.spots[i];
                let links = self.subject.mechanism.joints[spot.joint].links;
                let grounded = links.iter().any(|&l| self.is_frame(l));
                if !grounded && !seen.iter().any(|&p| one_place(p, spot.at)) {
                    seen.push(spot.at);
                    out.push((*l, self.places[i].point));
                }
            }
            out.extend(self.loose_in_space(row).map(|p| (*l, p)));
        }
        out
    }

    /// Returns the free end of a link with one joint.
    pub(crate) fn loose_in_space(&self, link: usize) -> Option<Vector> {
        let of = &self.links[link].1;
        let off = sub(self.loose_end(link)?, self.spots[of[0]].at);
        let (view, scale) = (&self.projection.view, self.projection.scale);
        let across = add(
            times(view.right, off[0] / scale),
            times(view.up, -off[1] / scale),
        );
        Some(add(self.places[of[0]].point, across))
    }
}
