//! The kinematic scheme: links and the symbols of joints where the coordinates have them.

mod arcs;
mod arrow;
mod axes;
mod body;
mod facets;
mod gears;
mod legend;
mod loads;
mod marked;
pub(super) mod moving;
mod naming;
mod points;
mod posed;
pub(super) mod scene;

use self::arrow::Arrow;
use self::body::Body;
use self::marked::{Marked, marked};
use super::subject::{Mark, Subject, roominess};
use crate::draw::place::projection::places::places;
use crate::draw::place::projection::{self, JointInSpace, Projection, ToBeSeen, Vector, bounds};
use crate::draw::place::view_direction::Sight;
use crate::draw::sheet::{Anchor, Caption, Drawing, Sheet, plan};
use crate::draw::symbol::couplings;
use crate::draw::symbol::drive;
use crate::draw::symbol::ground::{Foot, Ground, grounds};
use crate::draw::symbol::placed::Symbol;
use crate::draw::symbol::swap::{self, Swap};
use crate::draw::symbol::symbols;
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{Joint, JointId, LinkId, Mechanism, Role};
use crate::redundancy::stress::SelfStress;
use crate::svg::plane::{Point, Rect, add, mean, norm, polyline, scale, sub, unit};

/// The room for the joints.
const ROOM: Point = [560.0, 400.0];
/// The room below for the axes and the scale.
const STRIP: f64 = 84.0;

/// Draws the kinematic scheme.
#[must_use]
pub fn kinematic(subject: &Subject<'_>) -> Drawing {
    kinematic_seen(subject, &Sight::default())
}

/// Draws the kinematic scheme as seen from a side.
#[must_use]
pub fn kinematic_seen(subject: &Subject<'_>, sight: &Sight) -> Drawing {
    Kinematic::new(subject, sight).draw()
}

/// Draws the kinematic scheme with a self-stress as arrows on the links that it loads; its name goes under the title.
#[must_use]
pub fn kinematic_stressed(
    subject: &Subject<'_>,
    sight: &Sight,
    stress: &SelfStress,
    name: &str,
) -> Drawing {
    let mut drawn = Kinematic::new(subject, sight);
    drawn.arrows = drawn.arrows_of(stress);
    drawn.shows = Some(name.to_owned());
    drawn.draw()
}

/// The kinematic scheme with room for the symbols of other joints in place of some, and for each swap the SVG elements
/// that stand in the group of its joint (`data-joint`) instead of those there, marked as changed.
#[must_use]
pub fn kinematic_with(subject: &Subject<'_>, swaps: &[Swap<'_>]) -> (Drawing, Vec<String>) {
    let mut drawn = Kinematic::new(subject, &Sight::default());
    let mut out = Vec::new();
    for swap in swaps {
        let (joint, option) = (swap.joint, swap.option);
        let spot = drawn.spots.iter().find(|s| s.joint == joint);
        let size = spot.map_or(1.0, |s| s.symbol.size);
        let symbol = Symbol::new(
            subject,
            joint,
            &option.joint_type,
            &projection::turned(&option.frame),
            &drawn.projection.view,
            size,
            spot.and_then(|s| s.symbol.slide),
        );
        let symbol = symbol.marked(Mark::Changed);
        let mut piece = Sheet::piece();
        symbol.draw(&mut piece, subject, joint, Mark::Changed);
        if swap.unloading {
            piece.shapes(&[swap::ring(symbol.reach())], [0.0; 2]);
        }
        out.push(piece.into_text());
        if let Some(spot) = drawn.spots.iter_mut().find(|s| s.joint == joint) {
            spot.rect = spot.rect.with(&symbol.room.moved(spot.at));
        }
    }
    (drawn.draw(), out)
}

/// The axes that outputs turn about in the frame.
fn turning(m: &Mechanism, joints: &[JointId], places: &[JointInSpace]) -> Vec<Vector> {
    let with = |j: JointId, role: Role| m.joints[j].links.iter().any(|&l| m.links[l].role == role);
    let turns = |j: JointId| m.joints[j].joint_type.freedoms().contains(&Freedom::Rz);
    let all = joints.iter().zip(places);
    let outputs = all.filter(|(j, _)| with(**j, Role::Frame) && with(**j, Role::Output));
    outputs
        .filter(|(j, _)| turns(**j))
        .map(|(_, p)| p.z)
        .collect()
}

/// A joint on paper.
struct Spot {
    joint: JointId,
    at: Point,
    symbol: Symbol,
    /// The room of the symbol, the ring of a drive included.
    rect: Rect,
}

/// A scheme under way.
struct Kinematic<'a> {
    subject: &'a Subject<'a>,
    spots: Vec<Spot>,
    links: Vec<(LinkId, Vec<usize>)>,
    /// How far the bar of each link bows out.
    bows: Vec<f64>,
    /// The corners of each link that is a plate of a fold.
    facets: Vec<Option<Vec<Vector>>>,
    grounds: Vec<Ground>,
    /// Where the joints are in space.
    places: Vec<JointInSpace>,
    /// The points of interest of links that are there.
    points: Vec<Marked>,
    /// The ways of points over a motion, and whether each ends where it began.
    traces: (Vec<Vec<Point>>, bool),
    /// The loads that are shown.
    arrows: Vec<Arrow>,
    /// What is shown instead of the figures, where it is something else.
    shows: Option<String>,
    projection: Projection,
}

impl<'a> Kinematic<'a> {
    fn new(subject: &'a Subject<'a>, sight: &Sight) -> Kinematic<'a> {
        let m = subject.mechanism;
        let joints: Vec<JointId> = m.joints_in(subject.state).collect();
        let mut links: Vec<(LinkId, Vec<usize>)> = Vec::new();
        for l in m.link_ids() {
            let of: Vec<usize> = (0..joints.len())
                .filter(|&i| m.joints[joints[i]].links.contains(&l))
                .collect();
            if !of.is_empty() {
                links.push((l, of));
            }
        }
        // A redesign is seen as the mechanism it came from, so that the two can be laid side by side.
        let before = subject.marks.as_ref().and_then(|m| m.before.as_ref());
        let seen = before.unwrap_or(m);
        let places = places(seen, &joints);
        // symbols do not grow, so that many of them need more paper
        let more = roominess(seen, &joints) * (joints.len() as f64 / 12.0).sqrt().clamp(1.0, 3.0);
        let room = ROOM.map(|r| r * more);
        let mut points = marked(m, subject.state, &links);
        let more: Vec<_> = points.iter().map(|p| p.place).collect();
        let seen = ToBeSeen {
            places: &places,
            more: &more,
            turning: &turning(seen, &joints, &places),
        };
        let projection = projection::best(seen, &links, m.frame(), room, sight);
        for p in &mut points {
            p.at = projection.flat(p.place);
        }
        let at: Vec<Point> = places.iter().map(|p| projection.flat(p.point)).collect();
        let of: Vec<&Joint> = joints.iter().map(|&j| &m.joints[j]).collect();
        let sizes = crate::draw::symbol::concentric::sizes(&at, &of);
        let driven = drive::driven_slides(m, subject.state);
        let spots: Vec<Spot> = joints
            .iter()
            .zip(&at)
            .zip(sizes)
            .map(|((&joint, &at), size)| {
                let of = &m.joints[joint];
                let place = projection::turned(&of.frame);
                let slide = driven.iter().find(|(j, _)| *j == joint).map(|d| d.1);
                let symbol = Symbol::new(
                    subject,
                    joint,
                    &of.joint_type,
                    &place,
                    &projection.view,
                    size,
                    slide,
                );
                Spot {
                    joint,
                    at,
                    rect: symbol.room.moved(at),
                    symbol: symbol.marked(subject.joint_mark(joint)),
                }
            })
            .collect();
        let mut out = Kinematic {
            subject,
            spots,
            bows: vec![0.0; links.len()],
            facets: Vec::new(),
            links,
            grounds: Vec::new(),
            places,
            points,
            traces: (Vec::new(), false),
            arrows: Vec::new(),
            shows: None,
            projection,
        };
        out.facets = out.facets_in_space();
        let moving = (0..out.links.len()).filter(|&l| !out.is_frame(out.links[l].0));
        let moving: Vec<usize> = moving.collect();
        let bodies: Vec<Body> = moving.iter().map(|&l| out.body(l)).collect();
        for (&l, bow) in moving.iter().zip(body::bows(&bodies)) {
            out.bows[l] = bow;
        }
        let loose = moving.iter().map(|&l| &out.links[l]);
        let loose: Vec<(usize, Point)> = loose
            .filter_map(|link| Some((link.1[0], out.loose(link)?)))
            .collect();
        let feet: Vec<Foot> = (0..out.spots.len()).map(|i| out.foot(i)).collect();
        out.grounds = grounds(&feet, &out.links, m.frame(), &loose);
        out
    }

    /// A joint as the ground has to know it: a block seen from the side has a rail.
    fn foot(&self, i: usize) -> Foot {
        let spot = &self.spots[i];
        let of = &self.subject.mechanism.joints[spot.joint].joint_type;
        let along = self.projection.view.flat(self.places[i].z);
        let side = symbols::side_of_slide(of).filter(|_| norm(along) > 0.5);
        Foot {
            at: spot.at,
            room: spot.rect,
            slide: side.map(|side| (unit(along), side * spot.symbol.size + 2.0)),
        }
    }

    /// The shape of a link.
    fn body(&self, link: usize) -> Body {
        let (l, of) = &self.links[link];
        let made = self.arc(link, |p| p);
        if let Some(mut made) = made.or_else(|| self.facet(link, |p| p)) {
            // The joints may have been moved to their place on the sheet.
            let by = sub(
                self.spots[of[0]].at,
                self.projection.flat(self.places[of[0]].point),
            );
            made.points.iter_mut().for_each(|p| *p = add(*p, by));
            return made;
        }
        let mut points: Vec<Point> = of.iter().map(|&i| self.spots[i].at).collect();
        points.extend(self.points_of(*l).map(|p| p.at));
        points.extend(self.loose(&self.links[link]));
        Body::new(&points).bowed(self.bows[link])
    }

    /// The end of a link with one joint, and no point of interest that it leads to.
    fn loose(&self, (link, of): &(LinkId, Vec<usize>)) -> Option<Point> {
        let &[only] = of.as_slice() else { return None };
        if self.points_of(*link).next().is_some() {
            return None;
        }
        let at = self.spots[only].at;
        let others = self
            .links
            .iter()
            .filter(|(l, o)| o.len() > 1 && o.contains(&only) && !self.is_frame(*l));
        let others = others.flat_map(|(_, o)| o).filter(|&&i| i != only);
        let dirs: Vec<Point> = others.map(|&i| unit(sub(at, self.spots[i].at))).collect();
        let away = if dirs.is_empty() {
            [0.8, -0.6]
        } else {
            mean(dirs.into_iter())
        };
        Some(add(at, scale(unit(away), 48.0)))
    }

    fn is_frame(&self, link: LinkId) -> bool {
        self.subject.mechanism.links[link].role == Role::Frame
    }

    fn is_output(&self, link: LinkId) -> bool {
        self.subject.mechanism.links[link].role == Role::Output
    }

    fn draw(mut self) -> Drawing {
        let (places, texts) = self.place_labels();
        let mut area = bounds(&self.spots.iter().map(|s| s.at).collect::<Vec<_>>());
        let all = self.spots.iter().map(|s| s.rect);
        let all = all.chain(self.grounds.iter().map(Ground::rect));
        let all = all.chain(places.iter().map(|p| p.rect));
        let moving = self.links.iter().filter(|(l, _)| !self.is_frame(*l));
        let ends = moving.filter_map(|link| self.loose(link));
        let ends: Vec<Rect> = ends.map(|p| Rect::around(p, 8.0, 8.0)).collect();
        for r in all.chain(ends) {
            area = area.with(&r);
        }
        for l in 0..self.links.len() {
            area = area.with(&bounds(&self.body(l).points).grown(3.0));
        }
        for p in self.points.iter().map(|p| p.at).chain(self.traced()) {
            area = area.with(&Rect::around(p, 10.0, 10.0));
        }
        area = self
            .arrow_room(&self.arrows)
            .map_or(area, |r| area.with(&r));
        let circles = self.circles();
        for c in circles.iter().flatten() {
            area = area.with(&bounds(c).grown(1.0));
        }
        let title = self.subject.title();
        let [what, figures] = self.subject.subtitle(&self.what());
        let shows = self.shows.take().unwrap_or(figures);
        let caption = Caption {
            title: &title,
            subtitle: [&what, &shows],
            description: &self.description(),
            legend: self.legend(),
        };
        let plan = plan(&caption, area, STRIP);
        let by = plan.shift;
        for s in &mut self.spots {
            s.at = add(s.at, by);
            s.rect = s.rect.moved(by);
        }
        self.shift_ground(by);
        let mut sheet = Sheet::new(&caption, &plan);
        self.draw_links(&mut sheet);
        self.draw_traces(&mut sheet);
        self.draw_couplings(&mut sheet, &circles, by);
        for g in &self.grounds {
            sheet.symbol(g.rect());
            g.draw(&mut sheet);
        }
        for p in &places {
            if let Some((a, b)) = p.leader {
                sheet.line("lead", add(a, by), add(b, by));
            }
        }
        self.draw_points(&mut sheet);
        for s in self.outer_first().into_iter().map(|i| &self.spots[i]) {
            sheet.symbol(s.rect);
            let mark = self.subject.joint_mark(s.joint);
            let id = &self.subject.mechanism.joints[s.joint].id;
            sheet.group("data-joint", id, s.at, |sheet| {
                s.symbol.draw(sheet, self.subject, s.joint, mark);
            });
        }
        self.draw_arrows(&mut sheet, by);
        for (n, (place, (class, size, text))) in places.iter().zip(&texts).enumerate() {
            let at = place.rect.moved(by).middle();
            let write = |s: &mut Sheet| s.text(class, *size, at, Anchor::Middle, text);
            match self.spots.get(n) {
                Some(s) => {
                    let id = &self.subject.mechanism.joints[s.joint].id;
                    sheet.group("data-joint-name", id, [0.0; 2], write);
                }
                None => write(&mut sheet),
            }
        }
        self.draw_below(&mut sheet, &plan);
        sheet.finish(&caption, &plan)
    }

    fn draw_links(&self, sheet: &mut Sheet) {
        for (n, (l, _)) in self.links.iter().enumerate() {
            if self.is_frame(*l) {
                continue;
            }
            let body = self.body(n);
            let id = &self.subject.mechanism.links[*l].id;
            sheet.group("data-link", id, [0.0; 2], |s| {
                if body.points.len() > 1 {
                    s.path_with_tip(
                        &self.look(n, &body),
                        &polyline(&body.points, body.plate),
                        &format!("link {id}"),
                    );
                }
            });
        }
    }

    /// The classes of a link.
    fn look(&self, link: usize, body: &Body) -> String {
        let (l, of) = &self.links[link];
        let here = of
            .iter()
            .all(|&i| self.subject.only_here(self.spots[i].joint));
        format!(
            "{}{}{}{}",
            if body.plate { "plate" } else { "bone" },
            if self.is_output(*l) { " out" } else { "" },
            self.subject.link_mark(*l).class(),
            if here { " dash" } else { "" }
        )
    }

    /// The pitch circles of each coupling, in the coordinates of the spots.
    fn circles(&self) -> Vec<Vec<Vec<Point>>> {
        let m = self.subject.mechanism;
        m.couplings_in(self.subject.state)
            .map(|c| self.pitch_circles(c, &self.places))
            .collect()
    }

    /// Gears as their pitch circles, other couplings as a line from joint to joint.
    fn draw_couplings(&self, sheet: &mut Sheet, circles: &[Vec<Vec<Point>>], by: Point) {
        let m = self.subject.mechanism;
        for (coupling, circles) in m.couplings_in(self.subject.state).zip(circles) {
            for c in circles {
                let c: Vec<Point> = c.iter().map(|&p| add(p, by)).collect();
                sheet.path("fine pitch", &polyline(&c, true));
            }
            if circles.is_empty() {
                let place = |j| self.spots.iter().find(|s| s.joint == j).map(|s| s.at);
                couplings::draw_line(sheet, coupling, place);
            }
        }
    }
}
