//! The kinematic scheme: links and the symbols of joints where the coordinates have them.

mod axes;
mod naming;
mod symbol;
use self::symbol::Symbol;
use super::ground::{Ground, grounds, part};
use super::projection::{self, View, bounds};
use super::sheet::{Anchor, Caption, Drawing, Sheet, Swatch, plan};
use super::subject::{Mark, Subject, roominess};
use super::swap::{self, Swap};
use super::symbols::{self, Pose, hull};
use crate::format::number::decimals;
use crate::model::joint_type::JointType;
use crate::model::mechanism::{JointId, LinkId, Role};
use crate::svg::plane::{Point, Rect, add, mean, polyline, scale, sub, unit};
use std::fmt::Write as _;

/// The room for the joints.
const ROOM: Point = [560.0, 400.0];
/// The room below for the axes and the scale.
const STRIP: f64 = 84.0;

/// Draws the kinematic scheme.
#[must_use]
pub fn kinematic(subject: &Subject<'_>) -> Drawing {
    Kinematic::new(subject).draw()
}

/// The kinematic scheme with room for the symbols of other joints in place of some, and for each swap the SVG elements
/// that stand in the group of its joint (`data-joint`) instead of those there, marked as changed.
#[must_use]
pub fn kinematic_with(subject: &Subject<'_>, swaps: &[Swap<'_>]) -> (Drawing, Vec<String>) {
    let mut drawn = Kinematic::new(subject);
    let mut out = Vec::new();
    for swap in swaps {
        let (joint, option) = (swap.joint, swap.option);
        let symbol = Symbol::new(
            subject,
            joint,
            &option.joint_type,
            &option.frame,
            &drawn.view,
        );
        let symbol = symbol.marked(Mark::Changed);
        let mut piece = Sheet::piece();
        symbol.draw(&mut piece, subject, joint, Mark::Changed);
        if swap.unloading {
            swap::ring(&mut piece, symbol.reach());
        }
        out.push(piece.into_text());
        if let Some(spot) = drawn.spots.iter_mut().find(|s| s.joint == joint) {
            spot.rect = spot.rect.with(&symbol.room.moved(spot.at));
        }
    }
    (drawn.draw(), out)
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
    grounds: Vec<Ground>,
    view: View,
    /// Pixels in a unit of length.
    scale: f64,
    /// Whether some joints stand beside their points.
    moved: bool,
}

impl<'a> Kinematic<'a> {
    fn new(subject: &'a Subject<'a>) -> Kinematic<'a> {
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
        let places = projection::places(seen, &joints);
        // symbols do not grow, so that many of them need more paper
        let more = roominess(seen, &joints) * (joints.len() as f64 / 12.0).sqrt().clamp(1.0, 3.0);
        let room = ROOM.map(|r| r * more);
        let (view, mut at, scale) = projection::best(&places, &links, m.frame(), room);
        let apart = part(&mut at, &links, &places, &view);
        let spots: Vec<Spot> = joints
            .iter()
            .zip(&at)
            .map(|(&joint, &at)| {
                let of = &m.joints[joint];
                let symbol = Symbol::new(subject, joint, &of.joint_type, &of.frame, &view);
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
            links,
            grounds: Vec::new(),
            view,
            scale,
            moved: apart || places.iter().any(|p| p.moved),
        };
        let loose = out.links.iter().filter(|(l, _)| *l != m.frame());
        let loose: Vec<(usize, Point)> = loose
            .filter_map(|(_, of)| Some((of[0], out.loose(of)?)))
            .collect();
        let rooms: Vec<(Point, Rect)> = out.spots.iter().map(|s| (s.at, s.rect)).collect();
        out.grounds = grounds(&rooms, &out.links, m.frame(), &loose);
        out
    }

    /// The outline of a link: a bar, or the polygon round its joints.
    fn outline(&self, of: &[usize]) -> Vec<Point> {
        let points: Vec<Point> = of.iter().map(|&i| self.spots[i].at).collect();
        if points.len() > 2 {
            hull(points)
        } else {
            points
        }
    }

    /// The end of a link with one joint.
    fn loose(&self, of: &[usize]) -> Option<Point> {
        let &[only] = of else { return None };
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

    fn draw(mut self) -> Drawing {
        let (places, texts) = self.place_labels();
        let mut area = bounds(&self.spots.iter().map(|s| s.at).collect::<Vec<_>>());
        let all = self.spots.iter().map(|s| s.rect);
        let all = all.chain(self.grounds.iter().map(Ground::rect));
        let all = all.chain(places.iter().map(|p| p.rect));
        let ends = self
            .links
            .iter()
            .filter_map(|(l, of)| self.loose(of).filter(|_| !self.is_frame(*l)));
        let ends: Vec<Rect> = ends.map(|p| Rect::around(p, 8.0, 8.0)).collect();
        for r in all.chain(ends) {
            area = area.with(&r);
        }
        let title = self.subject.title();
        let what = format!("Kinematic scheme {}", self.view.name);
        let subtitle = self.subject.subtitle(&what);
        let caption = Caption {
            title: &title,
            subtitle: [&subtitle[0], &subtitle[1]],
            description: &self.description(),
            legend: self.legend(),
        };
        let plan = plan(&caption, area, STRIP);
        let by = plan.shift;
        for s in &mut self.spots {
            s.at = add(s.at, by);
            s.rect = s.rect.moved(by);
        }
        for g in &mut self.grounds {
            g.from = add(g.from, by);
            g.to = add(g.to, by);
        }
        let mut sheet = Sheet::new(&caption, &plan);
        self.draw_links(&mut sheet);
        let spot = |j| self.spots.iter().find(|s| s.joint == j).map(|s| s.at);
        self.subject.draw_couplings(&mut sheet, spot);
        for g in &self.grounds {
            sheet.symbol(g.rect());
            g.draw(&mut sheet);
        }
        for p in &places {
            if let Some((a, b)) = p.leader {
                sheet.line("lead", add(a, by), add(b, by));
            }
        }
        for s in &self.spots {
            sheet.symbol(s.rect);
            let mark = self.subject.joint_mark(s.joint);
            let id = &self.subject.mechanism.joints[s.joint].id;
            sheet.group(("data-joint", id), s.at, |sheet| {
                s.symbol.draw(sheet, self.subject, s.joint, mark);
            });
        }
        for (n, (place, (class, size, text))) in places.iter().zip(&texts).enumerate() {
            let at = place.rect.moved(by).middle();
            let write = |s: &mut Sheet| s.text(class, *size, at, Anchor::Middle, text);
            match self.spots.get(n) {
                Some(s) => {
                    let id = &self.subject.mechanism.joints[s.joint].id;
                    sheet.group(("data-joint-name", id), [0.0; 2], write);
                }
                None => write(&mut sheet),
            }
        }
        self.draw_axes(&mut sheet, plan.legend_top - STRIP + 34.0);
        self.draw_scale(&mut sheet, plan.legend_top - STRIP + 40.0);
        sheet.finish(&caption, &plan)
    }

    fn draw_links(&self, sheet: &mut Sheet) {
        for (l, of) in self.links.iter().filter(|(l, _)| !self.is_frame(*l)) {
            let joints = of.iter().map(|&i| self.spots[i].joint);
            let dash = if joints.clone().all(|j| self.subject.only_here(j)) {
                " dash"
            } else {
                ""
            };
            let mark = self.subject.link_mark(*l).class();
            let outline = self.outline(of);
            let (class, closed) = if outline.len() > 2 {
                ("plate", true)
            } else {
                ("bone", false)
            };
            let mut points = outline;
            points.extend(self.loose(of));
            let id = &self.subject.mechanism.links[*l].id;
            sheet.group(("data-link", id), [0.0; 2], |s| {
                s.path_with_tip(
                    &format!("{class}{mark}{dash}"),
                    &polyline(&points, closed),
                    &format!("link {id}"),
                );
            });
        }
    }

    fn legend(&self) -> Vec<(Swatch, String)> {
        let m = self.subject.mechanism;
        let mut types: Vec<&JointType> = Vec::new();
        for s in &self.spots {
            let t = &m.joints[s.joint].joint_type;
            if !types.contains(&t) {
                types.push(t);
            }
        }
        let mut out: Vec<(Swatch, String)> = types
            .into_iter()
            .map(|t| {
                let shapes = symbols::symbol(t, &Pose::legend(), "");
                (Swatch::Shapes(shapes), format!("{t}, class {}", t.class()))
            })
            .collect();
        if self.spots.iter().any(|s| s.symbol.ring.is_some()) {
            let draw = |s: &mut Sheet, p: Point| s.circle("line", p, 9.5);
            out.push((Swatch::Symbol(draw), "driving pair".to_owned()));
        }
        if !self.grounds.is_empty() {
            let draw = |s: &mut Sheet, p: Point| {
                Ground {
                    from: add(p, [0.0, -7.0]),
                    to: add(p, [0.0, -1.0]),
                }
                .draw(s);
            };
            out.push((
                Swatch::Symbol(draw),
                format!("frame {}", m.links[m.frame()].id),
            ));
        }
        if self.spots.iter().any(|s| self.subject.only_here(s.joint)) {
            let draw = |s: &mut Sheet, p: Point| s.circle("fine dash", p, 9.5);
            let state = &m.states[self.subject.state];
            out.push((Swatch::Symbol(draw), format!("in state {state} only")));
        }
        out.extend(self.subject.coupling_row());
        out.extend(self.subject.mark_rows());
        if self.moved {
            let none = |_: &mut Sheet, _: Point| {};
            let text = "coincident joints are drawn apart".to_owned();
            out.push((Swatch::Symbol(none), text));
        }
        out
    }

    /// The drawing in words, for those who do not see it.
    fn description(&self) -> String {
        let m = self.subject.mechanism;
        let what = format!("Kinematic scheme {}", self.view.name);
        let mut out = self.subject.summary(&what);
        for s in &self.spots {
            let joint = &m.joints[s.joint];
            let [a, b] = joint.links.map(|l| &m.links[l].id);
            let p = [0, 1, 2].map(|i| joint.frame.point[i].to_f64());
            let _ = write!(
                out,
                " Joint {} ({}) between {a} and {b} at {}, {}, {} {}.",
                joint.id,
                joint.joint_type,
                decimals(p[0], 4),
                decimals(p[1], 4),
                decimals(p[2], 4),
                m.length_unit.symbol
            );
        }
        out + &self.subject.coupling_words()
    }
}
