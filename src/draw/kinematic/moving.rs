//! A kinematic scheme over the way of its drive: one picture a pose, shown one after the other.

use super::body::Body;
use super::carried::Carried;
use super::marked::draw_mark;
use super::symbol::Symbol;
use super::{Kinematic, STRIP};
use crate::draw::projection::{
    Place, Vector, add as add3, bounds, dot, scale as times, sub as sub3,
};
use crate::draw::sheet::{Caption, Drawing, Sheet, plan};
use crate::draw::sight::Sight;
use crate::draw::subject::Subject;
use crate::model::joint_type::Freedom;
use crate::model::mechanism::LinkId;
use crate::motion::pose::Pose;
use crate::motion::way::Way;
use crate::svg::plane::{Point, Rect, add, polyline, sub};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Pictures a second.
pub const RATE: usize = 30;

/// A motion to be drawn.
#[derive(Debug, Clone, Copy)]
pub struct Moved<'a> {
    /// The pose of the file, which has the links' sizes.
    pub pose: &'a Pose,
    /// The way of the drive.
    pub way: &'a Way,
    /// The drive and how far it goes, in words.
    pub words: &'a str,
}

/// Who shows the pictures of a motion one after the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Player {
    /// The drawing itself, by a style sheet; the pose of the file stands still for readers who want less motion, on paper
    /// and in programs that know no animation.
    Itself,
    /// A program: it takes the attribute `visibility` from one group `data-frame` and gives it to another. The number keeps
    /// the ids of several drawings of a page apart.
    Program(usize),
}

/// Draws the kinematic scheme over a motion.
#[must_use]
pub fn kinematic_moving(
    subject: &Subject<'_>,
    sight: &Sight,
    moved: &Moved<'_>,
    player: Player,
) -> Drawing {
    Moving::new(Kinematic::new(subject, sight), moved).draw(player)
}

/// Draws the kinematic scheme at the pose of the file, with the ways of its points over a motion.
#[must_use]
pub fn kinematic_along(subject: &Subject<'_>, sight: &Sight, moved: &Moved<'_>) -> Drawing {
    let mut rest = Kinematic::new(subject, sight);
    let poses = poses(moved);
    rest.traces = (rest.ways(&poses), moved.way.closed);
    rest.draw()
}

/// The poses of a motion, each once.
fn poses<'m>(moved: &Moved<'m>) -> Vec<Carried<'m>> {
    let links = moved.way.links.iter().map(Vec::as_slice);
    let of = links.map(|links| Carried {
        pose: moved.pose,
        links,
    });
    let mut poses: Vec<Carried<'_>> = of.collect();
    if moved.way.closed {
        poses.pop();
    }
    poses
}

/// One picture.
struct Frame {
    /// Where the points of interest are.
    points: Vec<Point>,
    /// Where each joint stands, with its frame.
    places: Vec<Place>,
    at: Vec<Point>,
    /// The shape of each link but the frame.
    bodies: Vec<(usize, Body)>,
    /// What blocks slide along, on links that move.
    guides: Vec<(Point, Point)>,
    circles: Vec<Vec<Point>>,
}

struct Moving<'a> {
    rest: Kinematic<'a>,
    words: &'a str,
    frames: Vec<Frame>,
    start: usize,
    closed: bool,
}

impl<'a> Moving<'a> {
    fn new(mut rest: Kinematic<'a>, moved: &Moved<'a>) -> Moving<'a> {
        let poses = poses(moved);
        let slides = rest.slides(&poses);
        rest.lengthen_rails(&slides);
        let frames: Vec<Frame> = poses.iter().map(|c| rest.frame(c, &slides)).collect();
        rest.traces = (rest.ways(&poses), moved.way.closed);
        Moving {
            frames,
            words: moved.words,
            start: moved.way.start,
            closed: moved.way.closed,
            rest,
        }
    }

    fn draw(mut self, player: Player) -> Drawing {
        let rest = &self.rest;
        let subject = rest.subject;
        let mut area = bounds(&self.frames[self.start].at);
        for (n, frame) in self.frames.iter().enumerate() {
            for (spot, at) in rest.spots.iter().zip(&frame.at) {
                // a symbol may turn
                let reach = 2.0 * spot.symbol.reach();
                let own = if n == self.start {
                    spot.rect
                } else {
                    Rect::around(*at, reach, reach)
                };
                area = area.with(&own);
            }
            for (_, body) in &frame.bodies {
                area = area.with(&bounds(&body.points).grown(4.0));
            }
            let ends = frame.guides.iter().flat_map(|g| [g.0, g.1]);
            for p in ends.chain(frame.circles.iter().flatten().copied()) {
                area = area.with(&Rect::around(p, 6.0, 6.0));
            }
        }
        for g in &rest.grounds {
            area = area.with(&g.rect());
        }
        for p in rest.traced().chain(rest.points.iter().map(|p| p.at)) {
            area = area.with(&Rect::around(p, 6.0, 6.0));
        }
        let title = subject.title();
        let what = format!("Kinematic scheme {}", rest.projection.view.name);
        let [what, _] = subject.subtitle(&what);
        let caption = Caption {
            title: &title,
            subtitle: [&what, self.words],
            description: &format!("{} Moving: {}.", rest.description(), self.words),
            legend: rest.legend(),
        };
        let plan = plan(&caption, area, STRIP);
        self.shift(plan.shift);
        let mut sheet = Sheet::new(&caption, &plan);
        let prefix = match player {
            Player::Itself => {
                sheet.style(&self.style());
                "m".to_owned()
            }
            Player::Program(n) => format!("m{n}-"),
        };
        self.rest.draw_traces(&mut sheet);
        for g in &self.rest.grounds {
            sheet.symbol(g.rect());
            g.draw(&mut sheet);
        }
        self.draw_frames(&mut sheet, &prefix);
        self.rest
            .draw_axes(&mut sheet, plan.legend_top - STRIP + 34.0);
        self.rest
            .draw_scale(&mut sheet, plan.legend_top - STRIP + 40.0);
        sheet.finish(&caption, &plan)
    }

    fn shift(&mut self, by: Point) {
        for g in &mut self.rest.grounds {
            (g.from, g.to) = (add(g.from, by), add(g.to, by));
        }
        self.rest.shift_points(by);
        for f in &mut self.frames {
            let bodies = f.bodies.iter_mut().flat_map(|(_, b)| &mut b.points);
            let circles = f.circles.iter_mut().flatten();
            let points = f.points.iter_mut();
            for p in f.at.iter_mut().chain(bodies).chain(circles).chain(points) {
                *p = add(*p, by);
            }
            for (a, b) in &mut f.guides {
                (*a, *b) = (add(*a, by), add(*b, by));
            }
        }
    }

    /// The symbols once each, and the pictures made of them.
    fn draw_frames(&self, sheet: &mut Sheet, prefix: &str) {
        let rest = &self.rest;
        let m = rest.subject.mechanism;
        let mut order: Vec<usize> = (0..rest.spots.len()).collect();
        order.sort_by(|&a, &b| {
            rest.spots[b]
                .symbol
                .size
                .total_cmp(&rest.spots[a].symbol.size)
        });
        let mut store: BTreeMap<String, usize> = BTreeMap::new();
        let mut used: Vec<Vec<usize>> = Vec::new();
        for f in &self.frames {
            let of = rest.spots.iter().zip(&f.places).map(|(spot, place)| {
                let of = (&m.joints[spot.joint].joint_type, place);
                let view = &rest.projection.view;
                let symbol = Symbol::new(rest.subject, spot.joint, of, view, spot.symbol.size);
                let mark = rest.subject.joint_mark(spot.joint);
                let mut piece = Sheet::piece();
                symbol
                    .marked(mark)
                    .draw(&mut piece, rest.subject, spot.joint, mark);
                let next = store.len();
                *store.entry(piece.into_text()).or_insert(next)
            });
            used.push(of.collect());
        }
        let mut symbols: Vec<(usize, String)> = store.into_iter().map(|(s, n)| (n, s)).collect();
        symbols.sort_unstable();
        sheet.defs(
            symbols
                .iter()
                .map(|(n, s)| (format!("{prefix}{n}"), s.as_str())),
        );
        for spot in &rest.spots {
            sheet.symbol(spot.rect);
        }
        for (n, (f, used)) in self.frames.iter().zip(&used).enumerate() {
            sheet.frame(n, n == self.start, |s| {
                for (l, body) in &f.bodies {
                    if body.points.len() > 1 {
                        s.path(&rest.look(*l, body), &polyline(&body.points, body.plate));
                    }
                }
                for &(a, b) in &f.guides {
                    s.line("guide", a, b);
                }
                for c in &f.circles {
                    s.path("fine pitch", &polyline(c, true));
                }
                for &p in &f.points {
                    draw_mark(s, p);
                }
                for &i in &order {
                    let id = &m.joints[rest.spots[i].joint].id;
                    s.joint_use(id, &format!("{prefix}{}", used[i]), f.at[i]);
                }
            });
        }
    }

    /// Each picture in its turn, there and back where the drive does not go round.
    fn style(&self) -> String {
        let n = self.frames.len();
        let seconds = n as f64 / RATE as f64;
        let back = if self.closed { "" } else { " alternate" };
        let part = |k: usize| format!("{:.3}%", 100.0 * k as f64 / n as f64);
        let mut out = String::from("\n");
        let mut rules = String::new();
        for k in 0..n {
            let before = if k == 0 { "" } else { "0%{visibility:hidden}" };
            let (from, to) = (part(k), part(k + 1));
            // writing to a string does not fail
            let _ = writeln!(
                out,
                "@keyframes ozf{k}{{{before}{from}{{visibility:visible}}{to}{{visibility:{}}}}}",
                if k + 1 == n { "visible" } else { "hidden" }
            );
            let _ = writeln!(
                rules,
                ".ozd .f{k}{{animation:ozf{k} {seconds:.2}s step-end infinite{back}}}"
            );
        }
        out + "@media screen and (prefers-reduced-motion:no-preference){\n" + &rules + "}\n"
    }
}

impl Kinematic<'_> {
    /// How far along its axis each joint slides from where it is at rest, over all poses; nothing for those that do not.
    fn slides(&self, poses: &[Carried<'_>]) -> Vec<Option<[f64; 2]>> {
        let one = |i: usize| {
            let along = self.slide_axis(i)?;
            let (rides, guides) = self.carriers(i);
            let place = &self.places[i];
            let of = poses.iter().map(|c| {
                let apart = sub3(c.point(rides, place.point), c.point(guides, place.point));
                dot(apart, c.links[guides].direction(along))
            });
            Some(of.fold([0.0f64, 0.0], |[l, h], x| [l.min(x), h.max(x)]))
        };
        (0..self.spots.len()).map(one).collect()
    }

    /// The direction that a joint slides in, where it slides in just one.
    fn slide_axis(&self, i: usize) -> Option<Vector> {
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

    /// The link that the symbol of a joint rides on, and the one that it slides along: a block rides on the link that is
    /// nothing else, and on any rather than on the frame; a slot is the second link's, the pin in it the first's.
    fn carriers(&self, i: usize) -> (LinkId, LinkId) {
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
                        .all(|&k| super::nest::one_place(self.spots[k].at, self.spots[i].at))
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
    fn lengthen_rails(&mut self, slides: &[Option<[f64; 2]>]) {
        for (i, &range) in slides.iter().enumerate() {
            let (Some(range), Some(axis)) = (range, self.slide_axis(i)) else {
                continue;
            };
            if !self.is_frame(self.carriers(i).1) {
                continue;
            }
            let [low, high] = range.map(|x| {
                let flat = self.projection.view.flat(times(axis, x));
                flat.map(|c| c * self.projection.scale)
            });
            let at = self.spots[i].at;
            let rail = self
                .grounds
                .iter_mut()
                .find(|g| super::nest::one_place(g.from, at));
            if let Some(g) = rail {
                g.lengthen(low, high);
            }
        }
    }

    /// The way of each point that is shown.
    fn ways(&self, poses: &[Carried<'_>]) -> Vec<Vec<Point>> {
        let tips = self.tips().into_iter();
        let of = tips.map(|(link, tip)| {
            let at = |c: &Carried<'_>| self.projection.flat(c.point(link, tip));
            poses.iter().map(at).collect()
        });
        of.collect()
    }

    /// The points of interest; of output links that have none the free end of one with a single joint, else its joints but those of the frame.
    fn tips(&self) -> Vec<(LinkId, Vector)> {
        let moving = self.points.iter().filter(|p| !self.is_frame(p.link));
        let mut out: Vec<(LinkId, Vector)> = moving.map(|p| (p.link, p.place)).collect();
        let bare = |l: LinkId| self.is_output(l) && self.points_of(l).next().is_none();
        for link in self.links.iter().filter(|(l, _)| bare(*l)) {
            let (l, of) = link;
            let mut seen: Vec<Point> = Vec::new();
            for &i in of {
                let spot = &self.spots[i];
                let links = self.subject.mechanism.joints[spot.joint].links;
                let grounded = links.iter().any(|&l| self.is_frame(l));
                if !grounded && !seen.iter().any(|&p| super::nest::one_place(p, spot.at)) {
                    seen.push(spot.at);
                    out.push((*l, self.places[i].point));
                }
            }
            out.extend(self.loose_in_space(link).map(|p| (*l, p)));
        }
        out
    }

    /// The free end of a link with one joint.
    fn loose_in_space(&self, link: &(LinkId, Vec<usize>)) -> Option<Vector> {
        let of = &link.1;
        let off = sub(self.loose(link)?, self.spots[of[0]].at);
        let (view, scale) = (&self.projection.view, self.projection.scale);
        let across = add3(
            times(view.right, off[0] / scale),
            times(view.up, -off[1] / scale),
        );
        Some(add3(self.places[of[0]].point, across))
    }

    fn frame(&self, carried: &Carried<'_>, slides: &[Option<[f64; 2]>]) -> Frame {
        let flat = |p: Vector| self.projection.flat(p);
        let places: Vec<Place> = (0..self.spots.len())
            .map(|i| {
                let (rides, guides) = self.carriers(i);
                carried.place(rides, guides, &self.places[i])
            })
            .collect();
        let mut bodies = Vec::new();
        for (l, whole) in self.links.iter().enumerate() {
            let (link, of) = whole;
            if self.is_frame(*link) {
                continue;
            }
            let own = of.iter().map(|&i| self.places[i].point);
            let own = own.chain(self.points_of(*link).map(|p| p.place));
            let own = own.chain(self.loose_in_space(whole));
            let points: Vec<Point> = own.map(|p| flat(carried.point(*link, p))).collect();
            bodies.push((l, Body::new(&points).bowed(self.bows[l])));
        }
        let mut guides = Vec::new();
        for (i, &range) in slides.iter().enumerate() {
            let (Some(range), Some(axis)) = (range, self.slide_axis(i)) else {
                continue;
            };
            let (_, link) = self.carriers(i);
            if !self.is_frame(link) && range[1] - range[0] > 0.0 {
                let [a, b] = range.map(|x| {
                    let p = add3(self.places[i].point, times(axis, x));
                    flat(carried.point(link, p))
                });
                guides.push((a, b));
            }
        }
        let m = self.subject.mechanism;
        let circles = m
            .couplings_in(self.subject.state)
            .flat_map(|c| self.pitch_circles(c, &places))
            .collect();
        Frame {
            points: self
                .points
                .iter()
                .map(|p| flat(carried.point(p.link, p.place)))
                .collect(),
            at: places.iter().map(|p| flat(p.point)).collect(),
            places,
            bodies,
            guides,
            circles,
        }
    }
}
