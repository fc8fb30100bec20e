//! The structural scheme: links as polygons, joints as circles with their class, contours tinted by what is redundant.

use crate::closure::contour::{Contour, contour_basis};
use crate::draw::naming::{Name, draw_leaders};
use crate::draw::place::graph::Graph;
use crate::draw::place::layout::{Layout, find_layout};
use crate::draw::prelude::*;
use crate::draw::sheet::shapes::{HALF, hatch_path, rounded_path};
use crate::draw::sheet::{Caption, draw_sheet};
use crate::draw::subject::{joints_of_link, roominess};
use crate::geom::expr::Expr;
use crate::svg::labels::LabelPlace;
use crate::svg::plane::sides_of;

mod naming;

/// Pixels of a bar.
const UNIT: f64 = 96.0;
/// The radius of a joint.
const JOINT: f64 = 11.5;
/// The radius of the second circle of a driving pair.
const DRIVE: f64 = 15.5;

/// σ_i of a contour and its range over all orders, where known.
type Share = Option<(usize, (usize, usize))>;

/// Draws the structural scheme.
///
/// # Examples
/// ```
/// use ozols::{draw::{Subject, scheme}, model::mechanism::StateId};
/// let four_bar = ozols::built_in("four-bar")?;
/// let found = ozols::analyze(&four_bar)?;
/// let analysis = found.first();
/// let drawing = scheme(&Subject { mechanism: &four_bar, state: StateId::FREE, analysis, marks: None });
/// assert_eq!(drawing.symbols.len(), 4); // A circle for each joint.
/// # Ok::<(), ozols::Error>(())
/// ```
#[must_use]
pub fn scheme(subject: &Subject<'_>) -> Drawing {
    Scheme::new(subject).draw_sheet()
}

/// Returns the joints as the coordinates have them, seen along each axis and obliquely.
fn joint_hints(m: &Mechanism, joints: &[JointId]) -> Vec<Vec<Point>> {
    let at = |j: &JointId| {
        let p = &m.joints[*j].frame.point;
        [0, 1, 2].map(|i| Expr::to_f64(&p[i]))
    };
    let points: Vec<[f64; 3]> = joints.iter().map(at).collect();
    let views: [fn(&[f64; 3]) -> Point; 4] = [
        |p| [p[0], -p[1]],
        |p| [p[0], -p[2]],
        |p| [p[1], -p[2]],
        |p| [0.87 * (p[0] - p[1]), 0.5 * (p[0] + p[1]) - p[2]],
    ];
    views
        .iter()
        .map(|view| points.iter().map(view).collect())
        .collect()
}

/// A scheme under way. Its parts are indexed by their places in it.
struct Scheme<'a> {
    subject: &'a Subject<'a>,
    joints: Vec<JointId>,
    links: Vec<LinkId>,
    contours: Vec<(Contour, Share)>,
    graph: Graph,
    at: Layout,
    rings: Vec<Vec<usize>>,
}

impl<'a> Scheme<'a> {
    fn new(subject: &'a Subject<'a>) -> Scheme<'a> {
        let m = subject.mechanism;
        let joints: Vec<JointId> = m.joints_in(subject.state).collect();
        let links: Vec<LinkId> = m.links_in(subject.state).collect();
        let local = |j: JointId| joints.iter().position(|&k| k == j);
        let contours: Vec<(Contour, Option<_>)> = match subject.analysis {
            Some(a) => {
                let shares = a.per_contour.iter();
                shares
                    .map(|s| (s.contour.clone(), Some((s.redundant, s.range))))
                    .collect()
            }
            None => {
                let basis = contour_basis(m, subject.state);
                basis.into_iter().map(|c| (c, None)).collect()
            }
        };
        let graph = Graph {
            links: links
                .iter()
                .map(|&l| joints_of_link(m, &joints, l))
                .collect(),
            joints: joints.len(),
            frame: links.iter().position(|&l| l == m.frame_link()),
            contours: contours
                .iter()
                .map(|(c, _)| c.joints.iter().filter_map(|&(j, _)| local(j)).collect())
                .collect(),
        };
        let mut at = find_layout(&graph, &joint_hints(m, &joints));
        let unit = UNIT * roominess(m, &joints);
        for p in at.joints.iter_mut().chain(at.hubs.iter_mut()) {
            *p = scale(*p, unit);
        }
        Scheme {
            rings: graph.link_rings(&at.joints),
            subject,
            joints,
            links,
            contours,
            graph,
            at,
        }
    }

    /// Returns the corners of a link: its joints, and its hub if the link is free at one end or bowed.
    fn link_corners(&self, l: usize) -> Vec<Point> {
        let ring = &self.rings[l];
        let mut out: Vec<Point> = ring.iter().map(|&j| self.at.joints[j]).collect();
        match out.len() {
            0 => out.push(self.at.hubs[l]),
            1 => out.push(self.at.hubs[l]),
            2 => {
                let middle = mean(out.iter().copied());
                // there and back: a bar with a bend, which leaves its contour open to sight
                if plane_norm(sub(middle, self.at.hubs[l])) > 1.0 {
                    out.insert(1, self.at.hubs[l]);
                    out.push(self.at.hubs[l]);
                }
            }
            _ => {}
        }
        out
    }

    fn joint_radius(&self, i: usize) -> f64 {
        if self.subject.mechanism.joints[self.joints[i]].drive {
            DRIVE
        } else {
            JOINT
        }
    }

    fn draw_sheet(self) -> Drawing {
        let labels = self.place_labels();
        let mut area = Rect::around(
            self.at.joints.first().copied().unwrap_or([0.0; 2]),
            40.0,
            40.0,
        );
        for p in self.at.joints.iter().chain(&self.at.hubs) {
            area = area.with(&Rect::around(*p, 2.0 * DRIVE + 4.0, 2.0 * DRIVE + 4.0));
        }
        for (place, _) in &labels {
            area = area.with(&place.rect);
        }
        let title = self.subject.drawing_title();
        let subtitle = self.subject.subtitle_lines("Structural scheme");
        let caption = Caption {
            title: &title,
            subtitle: [&subtitle[0], &subtitle[1]],
            description: &self.describe_drawing(),
            legend: self.legend_rows(),
        };
        let draw = |sheet: &mut Sheet| {
            let order = self.contours_by_size().into_iter();
            let (seen, hidden): (Vec<usize>, Vec<usize>) = order.partition(|&c| self.is_seen(c));
            for c in seen {
                self.draw_contour(sheet, c, &path_data(&self.contour_outline(c), true));
            }
            for l in 0..self.rings.len() {
                self.draw_link(sheet, l);
            }
            for c in hidden {
                self.draw_contour(sheet, c, &self.contour_band(c));
            }
            self.subject.draw_couplings(sheet, |j| {
                let i = self.joints.iter().position(|&x| x == j)?;
                Some(self.at.joints[i])
            });
            self.draw_labels(sheet, &labels);
        };
        draw_sheet(&caption, area, 0.0, |sheet, shift, _| {
            sheet.draw_group("data-drawing", "", shift, draw);
        })
    }

    fn draw_link(&self, sheet: &mut Sheet, l: usize) {
        let link = self.links[l];
        let of = &self.subject.mechanism.links[link];
        let corners = self.link_corners(l);
        let dashed = self.rings[l]
            .iter()
            .all(|&i| self.subject.only_here(self.joints[i]));
        let class = format!(
            "link{}{}",
            self.subject.link_mark(link).mark_class(),
            if dashed { " dash" } else { "" }
        );
        sheet.draw_group("data-link", &of.id, [0.0; 2], |s| {
            s.path_with_tip(
                &class,
                &rounded_path(&corners, HALF),
                &format!("link {}", of.id),
            );
            if of.role == Role::Frame {
                let d = hatch_path(&corners, HALF - 1.0, 6.5);
                if !d.is_empty() {
                    s.draw_path("fine", &d);
                }
            }
        });
    }

    fn draw_labels(&self, sheet: &mut Sheet, labels: &[(LabelPlace, Name)]) {
        let (joints, links) = (self.joints.len(), self.links.len());
        draw_leaders(sheet, labels);
        for i in 0..joints {
            self.draw_joint(sheet, i);
        }
        for (n, (place, name)) in labels.iter().enumerate() {
            let (rect, middle) = (&place.rect, place.rect.middle());
            let frame = self.subject.mechanism.frame_link();
            let link = n.checked_sub(joints).and_then(|l| self.links.get(l));
            if n >= joints + links {
                sheet.draw_rect("badge", rect, 8.0);
            } else if link.map_or_else(|| self.on_frame(middle), |l| *l == frame) {
                sheet.draw_rect("link-back", rect, 3.0);
            }
            name.draw_name(sheet, middle);
        }
    }

    /// Returns true if a point is on the hatching.
    fn on_frame(&self, p: Point) -> bool {
        let frame = self.subject.mechanism.frame_link();
        let Some(l) = self.links.iter().position(|&l| l == frame) else {
            return false;
        };
        let corners = self.link_corners(l);
        sides_of(&corners).any(|(a, b)| to_segment(p, a, b) < HALF + 6.0)
    }

    fn draw_joint(&self, sheet: &mut Sheet, i: usize) {
        let id = self.joints[i];
        let joint = &self.subject.mechanism.joints[id];
        let at = self.at.joints[i];
        sheet.draw_group("data-joint", &joint.id, at, |s| {
            let r = 2.0 * self.joint_radius(i);
            s.note_symbol(Rect::around([0.0; 2], r, r));
            let mark = self.subject.joint_mark(id).mark_class();
            let only_here = self.subject.only_here(id);
            let look = format!("joint{mark}{}", if only_here { " dash" } else { "" });
            if joint.drive {
                s.draw_circle(&look, [0.0; 2], DRIVE);
            }
            s.draw_circle(&look, [0.0; 2], JOINT);
            let class = joint.joint_type.class_numeral();
            s.write_text("class", 10.0, [0.0; 2], Anchor::Middle, class);
        });
    }

    fn legend_rows(&self) -> Vec<(Swatch, String)> {
        let m = self.subject.mechanism;
        let mut out = Vec::new();
        for (c, (contour, share)) in self.contours.iter().enumerate() {
            let redundant = share.map_or(0, |(r, _)| r);
            let name = contour.name(m);
            let words = Self::contour_words(c, &name, *share);
            let words = words.split_once(": ").map_or(words.as_str(), |(_, w)| w);
            out.push((
                Swatch::Tint(redundant, format!("{}", c + 1)),
                words.to_owned(),
            ));
        }
        let any = |of: &dyn Fn(JointId) -> bool| self.joints.iter().any(|&j| of(j));
        if any(&|j| m.joints[j].drive) {
            let circles = [9.5, 6.5].map(|r| Shape::circle("joint", [0.0; 2], r));
            let text = "driving pair".to_owned();
            out.push((Swatch::Shapes(circles.to_vec()), text));
        }
        let class = "joint with its class";
        out.push((Swatch::Joint("joint", "V".to_owned()), class.to_owned()));
        let frame = |s: &mut Sheet| {
            let ends = [[-7.0, 0.0], [7.0, 0.0]];
            s.draw_path("link", &rounded_path(&ends, 7.0));
            s.draw_path("fine", &hatch_path(&ends, 4.5, 4.0));
        };
        out.push((Swatch::Symbol(frame), m.frame_words()));
        if any(&|j| self.subject.only_here(j)) {
            let circle = Shape::circle("joint dash", [0.0; 2], 9.5);
            let state = &m.states[self.subject.state];
            let text = format!("in state {state} only");
            out.push((Swatch::Shapes(vec![circle]), text));
        }
        out.extend(self.subject.coupling_row());
        out.extend(self.subject.mark_rows());
        out
    }

    /// Describes the drawing in words, for readers who cannot see it.
    fn describe_drawing(&self) -> String {
        let m = self.subject.mechanism;
        let joints = self.joints.iter().copied();
        let mut out = self.subject.describe_joints("Structural scheme", joints);
        for (c, (contour, share)) in self.contours.iter().enumerate() {
            let _ = write!(
                out,
                " {}.",
                Self::contour_words(c, &contour.name(m), *share)
            );
        }
        out + &self.subject.coupling_words()
    }
}
