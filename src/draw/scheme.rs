//! The structural scheme: links as polygons, joints as circles with their class, contours tinted by what is redundant.

use super::labels::{Line, Place, Rect, Wish, place};
use super::layout::{
    Graph, Layout, Point, add, cross, dot, inside, layout, mean, norm, ring, scale, sub,
    to_segment, unit,
};
use super::sheet::{Anchor, Caption, SMALL, Sheet, Swatch, plan, polyline};
use super::{Drawing, Mark, Subject};
use crate::chart::look::{cut, width};
use crate::chart::xml::number;
use crate::closure::contour::{Contour, contour_basis};
use crate::geom::expr::Expr;
use crate::model::mechanism::{JointId, LinkId, Role};
use std::fmt::Write as _;

/// Pixels of a bar.
const UNIT: f64 = 96.0;
/// The radius of a joint.
const JOINT: f64 = 11.5;
/// The radius of the second circle of a driving pair.
const DRIVE: f64 = 15.5;
/// Half the width of a bar.
const HALF: f64 = 8.5;

/// What is drawn, by place in the drawing rather than in the mechanism.
struct Parts {
    joints: Vec<JointId>,
    links: Vec<LinkId>,
    contours: Vec<(Contour, Option<(usize, (usize, usize))>)>,
    graph: Graph,
}

/// Draws the structural scheme.
#[must_use]
pub fn scheme(subject: &Subject<'_>) -> Drawing {
    let parts = parts(subject);
    let mut at = layout(&parts.graph, &hints(subject, &parts));
    for p in at.joints.iter_mut().chain(at.hubs.iter_mut()) {
        *p = scale(*p, UNIT);
    }
    Scheme::new(subject, parts, at).draw()
}

fn parts(subject: &Subject<'_>) -> Parts {
    let m = subject.mechanism;
    let joints: Vec<JointId> = m.joints_in(subject.state).collect();
    let mut links: Vec<LinkId> = joints.iter().flat_map(|&j| m.joints[j].links).collect();
    links.sort_unstable();
    links.dedup();
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
            .map(|&l| {
                let of = joints.iter().enumerate();
                of.filter(|(_, j)| m.joints[**j].links.contains(&l))
                    .map(|(i, _)| i)
                    .collect()
            })
            .collect(),
        joints: joints.len(),
        contours: contours
            .iter()
            .map(|(c, _)| c.joints.iter().filter_map(|&(j, _)| local(j)).collect())
            .collect(),
    };
    Parts {
        joints,
        links,
        contours,
        graph,
    }
}

/// The joints as the coordinates have them, seen along each axis and aslant.
fn hints(subject: &Subject<'_>, parts: &Parts) -> Vec<Vec<Point>> {
    let at = |j: &JointId| {
        let p = &subject.mechanism.joints[*j].frame.point;
        [0, 1, 2].map(|i| Expr::to_f64(&p[i]))
    };
    let points: Vec<[f64; 3]> = parts.joints.iter().map(at).collect();
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

struct Scheme<'a> {
    subject: &'a Subject<'a>,
    parts: Parts,
    at: Layout,
    rings: Vec<Vec<usize>>,
}

impl<'a> Scheme<'a> {
    fn new(subject: &'a Subject<'a>, parts: Parts, at: Layout) -> Scheme<'a> {
        let rings = parts
            .graph
            .links
            .iter()
            .map(|of| ring(of, &at.joints))
            .collect();
        Scheme {
            subject,
            parts,
            at,
            rings,
        }
    }

    /// The corners of a link: its joints, and its hub where it is loose or bowed.
    fn corners(&self, l: usize) -> Vec<Point> {
        let ring = &self.rings[l];
        let mut out: Vec<Point> = ring.iter().map(|&j| self.at.joints[j]).collect();
        match out.len() {
            0 => out.push(self.at.hubs[l]),
            1 => out.push(self.at.hubs[l]),
            2 => {
                let middle = mean(out.iter().copied());
                if norm(sub(middle, self.at.hubs[l])) > 1.0 {
                    out.insert(1, self.at.hubs[l]);
                }
            }
            _ => {}
        }
        out
    }

    fn radius(&self, i: usize) -> f64 {
        if self.subject.mechanism.joints[self.parts.joints[i]].drive {
            DRIVE
        } else {
            JOINT
        }
    }

    /// Where the ids of joints and links and the numbers of contours go, in this order.
    fn place_labels(&self) -> Vec<(Place, String)> {
        let m = self.subject.mechanism;
        let mut taken: Vec<Rect> = (0..self.parts.joints.len())
            .map(|i| {
                Rect::around(
                    self.at.joints[i],
                    2.0 * self.radius(i),
                    2.0 * self.radius(i),
                )
            })
            .collect();
        let mut lines = Vec::new();
        for l in 0..self.rings.len() {
            let corners = self.corners(l);
            let frame = m.links[self.parts.links[l]].role == Role::Frame;
            let weight = if frame || corners.len() < 3 { 2.5 } else { 0.6 };
            for &corner in &corners {
                lines.push(Line {
                    ends: (self.at.hubs[l], corner),
                    weight,
                });
            }
            for (a, b) in outline(&corners) {
                let along = unit(sub(b, a));
                let off = scale([-along[1], along[0]], HALF);
                for side in [off, scale(off, -1.0)] {
                    // the inner one is no line where the link is a polygon
                    let middle = add(scale(add(a, b), 0.5), side);
                    if corners.len() < 3 || !inside(middle, &corners) {
                        lines.push(Line {
                            ends: (add(a, side), add(b, side)),
                            weight: 2.0,
                        });
                    }
                }
            }
        }
        let mut wishes = Vec::new();
        let mut texts = Vec::new();
        for (l, &link) in self.parts.links.iter().enumerate() {
            let text = cut(&m.links[link].id, 12.0, 150.0);
            wishes.push(Wish {
                width: width(&text, 12.0),
                height: 13.0,
                anchor: self.at.hubs[l],
                clear: HALF,
                first: self.inside_link(l),
            });
            texts.push(text);
        }
        // ids stay off links, numbers of contours off nothing but labels
        let places = place(&wishes, &mut taken, &[]);
        let mut out: Vec<(Place, String)> = places.into_iter().zip(texts.drain(..)).collect();
        wishes.clear();
        for (c, _) in self.parts.contours.iter().enumerate() {
            let text = format!("{}", c + 1);
            let middles = self.inside_contour(c);
            wishes.push(Wish {
                width: width(&text, SMALL) + 8.0,
                height: 16.0,
                anchor: middles.first().map_or([0.0, 0.0], |f| f.0),
                clear: 0.0,
                first: middles,
            });
            texts.push(text);
        }
        let badges = place(&wishes, &mut taken, &lines);
        let badges: Vec<(Place, String)> = badges.into_iter().zip(texts.drain(..)).collect();
        wishes.clear();
        for (i, &joint) in self.parts.joints.iter().enumerate() {
            let text = cut(&m.joints[joint].id, SMALL, 150.0);
            wishes.push(Wish {
                width: width(&text, SMALL),
                height: 12.0,
                anchor: self.at.joints[i],
                clear: self.radius(i),
                first: Vec::new(),
            });
            texts.push(text);
        }
        let ids = place(&wishes, &mut taken, &lines);
        let mut all: Vec<(Place, String)> = ids.into_iter().zip(texts).collect();
        all.append(&mut out);
        all.extend(badges);
        all
    }

    /// Middles for the id within a link, the best first.
    fn inside_link(&self, l: usize) -> Vec<(Point, f64)> {
        let corners = self.corners(l);
        if corners.len() > 2 && self.rings[l].len() > 2 {
            let grid = grid(&corners, 9);
            let mut out: Vec<(Point, f64)> = grid
                .into_iter()
                .map(|p| (p, 0.3 + 0.004 * norm(sub(p, self.at.hubs[l]))))
                .collect();
            out.insert(
                0,
                (
                    self.at.hubs[l],
                    if inside(self.at.hubs[l], &corners) {
                        0.0
                    } else {
                        2.0
                    },
                ),
            );
            return out;
        }
        let mut out = Vec::new();
        for (a, b) in outline(&corners) {
            for (step, t) in [0.5, 0.44, 0.56, 0.38, 0.62, 0.32, 0.68].iter().enumerate() {
                let p = add(a, scale(sub(b, a), *t));
                out.push((p, 0.05 * step as f64));
            }
        }
        if corners.len() == 3 {
            out.insert(0, (corners[1], 0.0));
        }
        if self.rings[l].len() == 1 {
            out.insert(0, (self.at.hubs[l], 0.0));
        }
        out
    }

    /// Middles for the number within a contour, the best first.
    fn inside_contour(&self, c: usize) -> Vec<(Point, f64)> {
        let of = &self.parts.graph.contours[c];
        let polygon: Vec<Point> = of.iter().map(|&j| self.at.joints[j]).collect();
        let mut near: Vec<(Point, f64)> = grid(&polygon, 15)
            .into_iter()
            .map(|p| {
                let edges = (0..self.rings.len()).flat_map(|l| outline(&self.corners(l)));
                let d = edges
                    .map(|(a, b)| to_segment(p, a, b))
                    .fold(f64::INFINITY, f64::min);
                (p, d)
            })
            .collect();
        // nearest to what is the contour's own
        let before = &self.parts.graph.contours[..c];
        let own: Vec<Point> = of
            .iter()
            .filter(|j| !before.iter().any(|b| b.contains(j)))
            .map(|&j| self.at.joints[j])
            .collect();
        let own = mean(
            if own.is_empty() {
                polygon.iter()
            } else {
                own.iter()
            }
            .copied(),
        );
        near.sort_by(|a, b| b.1.total_cmp(&a.1));
        near.retain(|(_, d)| *d > 14.0);
        let mut out: Vec<(Point, f64)> = near
            .iter()
            .map(|&(p, d)| (p, 0.02 * (40.0 - d).max(0.0) + 0.012 * norm(sub(p, own))))
            .collect();
        out.sort_by(|a, b| a.1.total_cmp(&b.1));
        if out.is_empty() {
            out.push((mean(polygon.iter().copied()), 3.0));
        }
        out
    }

    fn draw(mut self) -> Drawing {
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
        let title = self.subject.title();
        let subtitle = self.subject.subtitle("Structural scheme");
        let caption = Caption {
            title: &title,
            subtitle: [&subtitle[0], &subtitle[1]],
            description: &self.description(),
            legend: self.legend(),
        };
        let plan = plan(&caption, area, 0.0);
        for p in self.at.joints.iter_mut().chain(self.at.hubs.iter_mut()) {
            *p = add(*p, plan.shift);
        }
        let mut sheet = Sheet::new(&caption, &plan);
        self.draw_contours(&mut sheet);
        for l in 0..self.rings.len() {
            self.draw_link(&mut sheet, l);
        }
        self.draw_labels(&mut sheet, &labels, plan.shift);
        sheet.finish(&caption, &plan)
    }

    fn draw_contours(&self, sheet: &mut Sheet) {
        let m = self.subject.mechanism;
        // the smallest on top, so that each stretch has the colour of the contour it is next to
        let mut order: Vec<(f64, usize, Vec<Point>)> = Vec::new();
        for (c, of) in self.parts.graph.contours.iter().enumerate() {
            let polygon: Vec<Point> = of.iter().map(|&j| self.at.joints[j]).collect();
            let n = polygon.len();
            let area: f64 = (0..n)
                .map(|i| cross(polygon[i], polygon[(i + 1) % n]))
                .sum();
            order.push((area.abs(), c, polygon));
        }
        order.sort_by(|a, b| b.0.total_cmp(&a.0));
        for (_, c, polygon) in order {
            let (contour, share) = &self.parts.contours[c];
            let redundant = share.map_or(0, |(r, _)| r).min(6);
            sheet.path_with_tip(
                &format!("s s{redundant}"),
                &polyline(&polygon, true),
                &words(c, &contour.name(m), *share),
            );
        }
    }

    fn draw_link(&self, sheet: &mut Sheet, l: usize) {
        let link = self.parts.links[l];
        let of = &self.subject.mechanism.links[link];
        let corners = self.corners(l);
        let dashed = self.rings[l]
            .iter()
            .all(|&i| self.subject.only_here(self.parts.joints[i]));
        let class = format!(
            "link{}{}",
            self.subject.link_mark(link).class(),
            if dashed { " dash" } else { "" }
        );
        sheet.path_with_tip(&class, &rounded(&corners, HALF), &format!("link {}", of.id));
        if of.role == Role::Frame {
            let d = hatch(&corners);
            if !d.is_empty() {
                sheet.path("fine", &d);
            }
        }
    }

    fn draw_labels(&self, sheet: &mut Sheet, labels: &[(Place, String)], shift: Point) {
        let (joints, links) = (self.parts.joints.len(), self.parts.links.len());
        for (place, _) in labels {
            if let Some((a, b)) = place.leader {
                sheet.line("lead", add(a, shift), add(b, shift));
            }
        }
        for i in 0..joints {
            self.draw_joint(sheet, i);
        }
        for (n, (place, text)) in labels.iter().enumerate() {
            let rect = place.rect.moved(shift);
            let (class, size, mark) = if n < joints {
                let mark = self.subject.joint_mark(self.parts.joints[n]);
                if self.on_frame(rect.middle()) {
                    sheet.rect("link-back", &rect, 3.0);
                }
                ("small soft", SMALL, mark)
            } else if n < joints + links {
                let link = self.parts.links[n - joints];
                if self.subject.mechanism.links[link].role == Role::Frame {
                    sheet.rect("link-back", &rect, 3.0);
                }
                ("name", 12.0, self.subject.link_mark(link))
            } else {
                sheet.rect("badge", &rect, 8.0);
                ("small", SMALL, Mark::None)
            };
            let class = format!("{class}{}", mark.class());
            sheet.text(&class, size, rect.middle(), Anchor::Middle, text);
        }
    }

    /// Whether a point is on the hatching.
    fn on_frame(&self, p: Point) -> bool {
        let frame = self.subject.mechanism.frame();
        let Some(l) = self.parts.links.iter().position(|&l| l == frame) else {
            return false;
        };
        let corners = self.corners(l);
        inside(p, &corners)
            || outline(&corners)
                .iter()
                .any(|&(a, b)| to_segment(p, a, b) < HALF + 6.0)
    }

    fn draw_joint(&self, sheet: &mut Sheet, i: usize) {
        let id = self.parts.joints[i];
        let joint = &self.subject.mechanism.joints[id];
        let mut class = format!("joint{}", self.subject.joint_mark(id).class());
        if self.subject.only_here(id) {
            class += " dash";
        }
        let at = self.at.joints[i];
        if joint.drive {
            sheet.circle(&class, at, DRIVE);
        }
        sheet.circle(&class, at, JOINT);
        let r = 2.0 * self.radius(i);
        sheet.symbol(Rect::around(at, r, r));
        sheet.text("class", 10.0, at, Anchor::Middle, joint.joint_type.class());
    }

    fn legend(&self) -> Vec<(Swatch, String)> {
        let m = self.subject.mechanism;
        let mut out = Vec::new();
        for (c, (contour, share)) in self.parts.contours.iter().enumerate() {
            let redundant = share.map_or(0, |(r, _)| r);
            let name = contour.name(m);
            let words = words(c, &name, *share);
            let words = words.split_once(": ").map_or(words.as_str(), |(_, w)| w);
            out.push((
                Swatch::Tint(redundant, format!("{}", c + 1)),
                words.to_owned(),
            ));
        }
        let any = |of: &dyn Fn(JointId) -> bool| self.parts.joints.iter().any(|&j| of(j));
        if any(&|j| m.joints[j].drive) {
            let draw = |s: &mut Sheet, p: Point| {
                s.circle("joint", p, 9.5);
                s.circle("joint", p, 6.5);
            };
            out.push((Swatch::Symbol(draw), "driving pair".to_owned()));
        }
        let frame = |s: &mut Sheet, p: Point| {
            let ends = [add(p, [-7.0, 0.0]), add(p, [7.0, 0.0])];
            s.path("link", &rounded(&ends, 7.0));
            s.path("fine", &hatch_with(&ends, 6.4, 4.0));
        };
        out.push((
            Swatch::Symbol(frame),
            format!("frame {}", m.links[m.frame()].id),
        ));
        if any(&|j| self.subject.only_here(j)) {
            let draw = |s: &mut Sheet, p: Point| s.circle("joint dash", p, 9.5);
            let state = &m.states[self.subject.state];
            out.push((Swatch::Symbol(draw), format!("in state {state} only")));
        }
        out.extend(self.subject.mark_rows());
        out
    }

    /// The drawing in words, for those who do not see it.
    fn description(&self) -> String {
        let m = self.subject.mechanism;
        let mut out = self.subject.summary("Structural scheme");
        for &j in &self.parts.joints {
            let joint = &m.joints[j];
            let [a, b] = joint.links.map(|l| &m.links[l].id);
            let _ = write!(
                out,
                " Joint {} of class {} ({}) between {a} and {b}{}.",
                joint.id,
                joint.joint_type.class(),
                joint.joint_type,
                if joint.drive { ", driven" } else { "" }
            );
        }
        for (c, (contour, share)) in self.parts.contours.iter().enumerate() {
            let _ = write!(out, " {}.", words(c, &contour.name(m), *share));
        }
        out
    }
}

/// A contour in words.
fn words(c: usize, name: &str, share: Option<(usize, (usize, usize))>) -> String {
    match share {
        Some((r, (low, high))) if low != high => {
            format!("contour {}: {name}, σ = {r} ({low} to {high})", c + 1)
        }
        Some((r, _)) => format!("contour {}: {name}, σ = {r}", c + 1),
        None => format!("contour {}: {name}", c + 1),
    }
}

/// The sides of a polygon, or the pieces of a bar.
fn outline(corners: &[Point]) -> Vec<(Point, Point)> {
    let open = corners.len() < 3;
    let count = corners.len() - usize::from(open && !corners.is_empty());
    (0..count)
        .map(|i| (corners[i], corners[(i + 1) % corners.len()]))
        .collect()
}

/// The outline of a polygon or bar, `r` away from it, with round corners.
fn rounded(corners: &[Point], r: f64) -> String {
    let n = corners.len();
    let mut d = String::new();
    let turn: f64 = (0..n)
        .map(|i| cross(corners[i], corners[(i + 1) % n]))
        .sum();
    let mut corners = corners.to_vec();
    if turn < 0.0 {
        corners.reverse();
    }
    let normal = |i: usize| {
        let along = unit(sub(corners[(i + 1) % n], corners[i % n]));
        [along[1], -along[0]]
    };
    for i in 0..n {
        let (before, after) = (normal(i + n - 1), normal(i));
        let hollow = cross(before, after) < -1e-9;
        let c = if i == 0 { 'M' } else { 'L' };
        if hollow {
            let miter = (1.0 + dot(before, after)).max(0.3);
            let p = add(corners[i], scale(add(before, after), r / miter));
            let _ = write!(d, "{c}{} {}", number(p[0]), number(p[1]));
        } else {
            let (p, q) = (
                add(corners[i], scale(before, r)),
                add(corners[i], scale(after, r)),
            );
            let _ = write!(
                d,
                "{c}{} {}A{r} {r} 0 0 1 {} {}",
                number(p[0]),
                number(p[1]),
                number(q[0]),
                number(q[1])
            );
        }
    }
    d.push('Z');
    d
}

/// Hatching within a polygon or bar.
fn hatch(corners: &[Point]) -> String {
    hatch_with(corners, HALF - 1.0, 6.5)
}

fn hatch_with(corners: &[Point], half: f64, step: f64) -> String {
    // a polygon that stands for the outline: arcs as short lines
    let mut area: Vec<Vec<Point>> = Vec::new();
    for (a, b) in outline(corners) {
        let along = unit(sub(b, a));
        let start = (-along[0]).atan2(along[1]);
        let arc = |from: f64, at: Point| {
            (0..=12).map(move |i| {
                let angle = from + std::f64::consts::PI * f64::from(i) / 12.0;
                add(at, [half * angle.cos(), half * angle.sin()])
            })
        };
        area.push(
            arc(start, b)
                .chain(arc(start + std::f64::consts::PI, a))
                .collect(),
        );
    }
    if corners.len() > 2 {
        area.push(corners.to_vec());
    }
    let across = |p: Point| p[0] + p[1];
    let all = area.iter().flatten().map(|&p| across(p));
    let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| {
        (l.min(v), h.max(v))
    });
    let mut d = String::new();
    let mut level = low + step;
    let gap = step * std::f64::consts::SQRT_2;
    while level < high && d.len() < 40_000 {
        for (a, b) in spans(&area, level) {
            let (x1, x2) = ((level + a) / 2.0, (level + b) / 2.0);
            let _ = write!(
                d,
                "M{} {}L{} {}",
                number(x1),
                number(level - x1),
                number(x2),
                number(level - x2)
            );
        }
        level += gap;
    }
    d
}

/// Where the line x + y = level runs within a union of polygons, as ranges of x - y.
fn spans(area: &[Vec<Point>], level: f64) -> Vec<(f64, f64)> {
    let mut ranges: Vec<(f64, f64)> = Vec::new();
    for polygon in area {
        let mut cuts: Vec<f64> = Vec::new();
        for (i, &a) in polygon.iter().enumerate() {
            let b = polygon[(i + 1) % polygon.len()];
            let (s, t) = (a[0] + a[1] - level, b[0] + b[1] - level);
            if (s > 0.0) != (t > 0.0) {
                let f = s / (s - t);
                cuts.push((a[0] - a[1]) * (1.0 - f) + (b[0] - b[1]) * f);
            }
        }
        cuts.sort_by(f64::total_cmp);
        ranges.extend(cuts.chunks_exact(2).map(|c| (c[0], c[1])));
    }
    ranges.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut out: Vec<(f64, f64)> = Vec::new();
    for r in ranges {
        match out.last_mut() {
            Some(last) if r.0 <= last.1 => last.1 = last.1.max(r.1),
            _ => out.push(r),
        }
    }
    out
}

/// Points of a grid within a polygon.
fn grid(polygon: &[Point], steps: usize) -> Vec<Point> {
    let Some(&first) = polygon.first() else {
        return Vec::new();
    };
    let area = polygon.iter().fold(Rect::around(first, 0.0, 0.0), |r, &p| {
        r.with(&Rect::around(p, 0.0, 0.0))
    });
    let mut out = Vec::new();
    for i in 0..steps {
        for j in 0..steps {
            let t = |k: usize| (k as f64 + 0.5) / steps as f64;
            let p = [
                area.left + (area.right - area.left) * t(i),
                area.top + (area.bottom - area.top) * t(j),
            ];
            if inside(p, polygon) {
                out.push(p);
            }
        }
    }
    out
}
