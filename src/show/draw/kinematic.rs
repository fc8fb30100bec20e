//! The kinematic scheme: links and the symbols of joints where the coordinates have them.

mod arcs;
mod arrow;
mod axes;
mod body;
mod facets;
mod gears;
mod legend;
mod loads;
pub(super) mod moving;
mod naming;
mod on_paper;
mod points;
pub(super) mod scene;

use self::arrow::Arrow;
use self::body::{Body, Marked};
use super::subject::Subject;
use crate::draw::place::projection::Sight;
use crate::draw::place::projection::{JointInSpace, Projection, Vector, bounds};
use crate::draw::sheet::labels::LabelPlace;
use crate::draw::sheet::{Anchor, Caption, Drawing, Sheet, plan};
use crate::draw::subject;
use crate::draw::symbol::ground::Ground;
use crate::draw::symbol::placed::{Swap, Symbol};
use crate::model::mechanism::{JointId, LinkId, Role};
use crate::redundancy::stress::SelfStress;
use crate::svg::plane::{Point, Rect, add, mean, polyline, scale, sub, unit};

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

/// Draws the kinematic scheme with room for the symbols of other joints in place of some.
#[must_use]
pub(crate) fn kinematic_with(subject: &Subject<'_>, swaps: &[Swap<'_>]) -> Drawing {
    let mut drawn = Kinematic::new(subject, &Sight::default());
    for swap in swaps {
        drawn.make_room(swap);
    }
    drawn.draw()
}

/// A joint on paper.
struct Spot {
    joint: JointId,
    at: Point,
    symbol: Symbol,
    /// The room of the symbol, the ring of a drive included.
    rect: Rect,
}

/// What a label says, and how it looks.
#[derive(Clone)]
struct LabelText {
    class: String,
    size: f64,
    text: String,
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

impl Kinematic<'_> {
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
        points.extend(self.loose(link));
        Body::new(&points).bowed(self.bows[link])
    }

    /// The end of a link with one joint, and no point of interest that it leads to.
    fn loose(&self, link: usize) -> Option<Point> {
        let (link, of) = &self.links[link];
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
        let circles = self.circles();
        let area = self.drawn_room(&places, &circles);
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
        self.draw_ground(&mut sheet);
        for (a, b) in places.iter().filter_map(|p| p.leader) {
            sheet.line("lead", add(a, by), add(b, by));
        }
        self.draw_points(&mut sheet);
        self.draw_joints(&mut sheet);
        self.draw_arrows(&mut sheet, by);
        for (n, (place, text)) in places.iter().zip(&texts).enumerate() {
            self.draw_name(&mut sheet, n, place.rect.moved(by).middle(), text);
        }
        self.draw_below(&mut sheet, &plan);
        sheet.finish(&caption, &plan)
    }

    /// The room of all that is drawn, before anything is moved to its place on the sheet.
    fn drawn_room(&self, labels: &[LabelPlace], circles: &[Vec<Vec<Point>>]) -> Rect {
        let mut area = bounds(&self.spots.iter().map(|s| s.at).collect::<Vec<_>>());
        let all = self.spots.iter().map(|s| s.rect);
        let all = all.chain(self.grounds.iter().map(Ground::rect));
        let all = all.chain(labels.iter().map(|p| p.rect));
        let moving = (0..self.links.len()).filter(|&l| !self.is_frame(self.links[l].0));
        let ends = moving.filter_map(|l| self.loose(l));
        for r in all.chain(ends.map(|p| Rect::around(p, 8.0, 8.0))) {
            area = area.with(&r);
        }
        for l in 0..self.links.len() {
            area = area.with(&bounds(&self.body(l).points).grown(3.0));
        }
        for p in self.points.iter().map(|p| p.at).chain(self.traced()) {
            area = area.with(&Rect::around(p, 10.0, 10.0));
        }
        let arrows = self.arrow_room(&self.arrows);
        area = arrows.map_or(area, |r| area.with(&r));
        for c in circles.iter().flatten() {
            area = area.with(&bounds(c).grown(1.0));
        }
        area
    }

    fn draw_joints(&self, sheet: &mut Sheet) {
        for s in self.outer_first().into_iter().map(|i| &self.spots[i]) {
            sheet.symbol(s.rect);
            let mark = self.subject.joint_mark(s.joint);
            let id = &self.subject.mechanism.joints[s.joint].id;
            sheet.group("data-joint", id, s.at, |sheet| {
                s.symbol.draw(sheet, self.subject, s.joint, mark);
            });
        }
    }

    /// A label; those of joints come first and stand in groups, so that a joint is found by its name.
    fn draw_name(&self, sheet: &mut Sheet, n: usize, at: Point, label: &LabelText) {
        let LabelText { class, size, text } = label;
        let write = |s: &mut Sheet| s.text(class, *size, at, Anchor::Middle, text);
        match self.spots.get(n) {
            Some(s) => {
                let id = &self.subject.mechanism.joints[s.joint].id;
                sheet.group("data-joint-name", id, [0.0; 2], write);
            }
            None => write(sheet),
        }
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
                subject::draw_line(sheet, coupling, place);
            }
        }
    }
}
