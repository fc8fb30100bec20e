//! The shape of a link: a bar where its joints are in a row, a plate where they are not; and the points of interest on links, those of
//! the file and the faces of jaws.

use crate::draw::place::projection::{finite_vector, norm};
use crate::draw::prelude::*;
use crate::draw::symbol::pieces::convex_hull;
use crate::draw::symbol::placed::one_place;
use crate::motion::jaws::jaw_faces;
use crate::redundancy::stress::JointWrench;
use crate::redundancy::stress_loads::Borne;
use std::f64::consts::PI;

/// A plate thinner than this, in pixels, is a bar.
const THIN: f64 = 2.0;
/// Bars that overlap by more than this, in pixels, are separated.
const SHARED: f64 = 8.0;
/// How far bars that would lie on another bow out, in the order tried.
const BOWS: [f64; 6] = [0.0, 13.0, -13.0, 24.0, -24.0, 35.0];

/// A link on paper.
#[derive(Debug, Clone)]
pub(super) struct Body {
    /// The corners of a plate, or the points along a bar; fewer than two where all joints of the link are in one place.
    pub(super) points: Vec<Point>,
    /// Whether it is a plate.
    pub(super) plate: bool,
}

impl Body {
    /// Creates the shape of a link with joints at these points.
    pub(super) fn new(joints: &[Point]) -> Body {
        let mut points: Vec<Point> = Vec::new();
        for &p in joints {
            if !points.iter().any(|&q| one_place(p, q)) {
                points.push(p);
            }
        }
        if points.len() < 3 {
            return Body {
                points,
                plate: false,
            };
        }
        let corners = convex_hull(points.clone());
        let ends = farthest_pair(&points);
        let along = unit(sub(ends[1], ends[0]));
        let off = corners.iter().map(|&p| cross(along, sub(p, ends[0])));
        let (low, high) = off.fold((0.0f64, 0.0f64), |(l, h), d| (l.min(d), h.max(d)));
        let plate = high - low > THIN && corners.len() > 2;
        Body {
            points: if plate { corners } else { ends.to_vec() },
            plate,
        }
    }
}

/// Returns how far each bar must bow out so that none lies on another. The longer bars stay straight.
pub(super) fn find_bows(bars: &[Option<[Point; 2]>]) -> Vec<f64> {
    let bar = |i: usize| bars[i];
    let mut order: Vec<usize> = (0..bars.len()).filter(|&i| bar(i).is_some()).collect();
    let length = |i: usize| bar(i).map_or(0.0, |[a, b]| plane_norm(sub(b, a)));
    order.sort_by(|&i, &j| length(j).total_cmp(&length(i)).then(i.cmp(&j)));
    let mut out = vec![0.0; bars.len()];
    let mut done: Vec<usize> = Vec::new();
    for i in order {
        let Some(own) = bar(i) else { continue };
        // as seen from the same side for all
        let taken = done.iter().filter_map(|&k| {
            let other = bar(k)?;
            let same = dot(sub(own[1], own[0]), sub(other[1], other[0])) > 0.0;
            on_each_other(own, other).then_some(if same { out[k] } else { -out[k] })
        });
        let taken: Vec<f64> = taken.collect();
        out[i] = BOWS
            .into_iter()
            .find(|b| !taken.contains(b))
            .unwrap_or_default();
        done.push(i);
    }
    out
}

/// Returns true if two segments share more than a point of the paper.
fn on_each_other([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let along = unit(sub(b, a));
    let off = |p: Point| cross(along, sub(p, a)).abs();
    if off(c).max(off(d)) > THIN {
        return false;
    }
    let at = |p: Point| dot(along, sub(p, a));
    let (low, high) = (at(c).min(at(d)).max(0.0), at(c).max(at(d)).min(at(b)));
    high - low > SHARED
}

/// Returns the two points that are farthest from each other.
fn farthest_pair(points: &[Point]) -> [Point; 2] {
    let mut best = ([points[0]; 2], -1.0);
    for (i, &a) in points.iter().enumerate() {
        for &b in &points[i + 1..] {
            let d = plane_norm(sub(a, b));
            if d > best.1 {
                best = ([a, b], d);
            }
        }
    }
    best.0
}

/// How the points of a shape are joined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum WireForm {
    /// A link: a plate between its points, or a bar where they look to be in a row.
    Hull,
    /// A link as an arc.
    Arc,
    /// A bar that bows out to pass another.
    Bow,
    /// A line.
    Line,
    /// A closed line.
    Loop,
}

impl WireForm {
    /// Returns the form for programs.
    pub(super) fn word(self) -> &'static str {
        match self {
            WireForm::Hull => "hull",
            WireForm::Arc | WireForm::Bow | WireForm::Line => "line",
            WireForm::Loop => "loop",
        }
    }
}

/// A shape fixed to a link.
#[derive(Debug, Clone)]
pub(super) struct Wire {
    /// The place of its link among those drawn.
    pub(super) row: usize,
    /// The class of the style sheet; that of a link follows from how it is seen.
    pub(super) class: &'static str,
    pub(super) form: WireForm,
    pub(super) points: Vec<Vector>,
}

/// A shape on paper.
#[derive(Debug, Clone)]
pub(super) struct DrawnWire {
    pub(super) row: usize,
    pub(super) class: String,
    /// Whether it is the link itself.
    pub(super) link: bool,
    /// Fewer than two where all joints of a link are in one place.
    pub(super) points: Vec<Point>,
    pub(super) closed: bool,
}

impl DrawnWire {
    /// Returns its segments.
    pub(super) fn segments(&self) -> impl Iterator<Item = (Point, Point)> + '_ {
        let n = self.points.len();
        let count = if self.closed { n } else { n.saturating_sub(1) };
        (0..count).map(move |i| (self.points[i], self.points[(i + 1) % n]))
    }

    /// Returns its middle. That of a line is halfway along.
    pub(super) fn middle(&self) -> Point {
        if self.closed || self.points.len() < 3 {
            return mean(self.points.iter().copied());
        }
        self.points[self.points.len() / 2]
    }
}

/// Half the width of a point's mark. The mark is not a circle, because joints are circles.
const MARK: f64 = 4.0;

/// A point of interest.
#[derive(Debug, Clone)]
pub(super) struct Marked {
    /// Its name.
    pub(super) id: String,
    pub(super) link: LinkId,
    /// Its position in space.
    pub(super) place: Vector,
    /// Its position on paper.
    pub(super) at: Point,
}

/// Returns the points of the links drawn, and the gripping points of outputs on an object that is absent in this state.
pub(super) fn marked_points(
    m: &Mechanism,
    state: StateId,
    links: &[(LinkId, Vec<usize>)],
) -> Vec<Marked> {
    let there = |l: LinkId| links.iter().any(|(k, _)| *k == l);
    let own = m
        .points
        .iter()
        .map(|p| (&p.id, p.link, finite_vector(&p.point)));
    let held = jaw_faces(m, state).map(|(j, jaw)| {
        let joint = &m.joints[j];
        (&joint.id, jaw, finite_vector(&joint.frame.point))
    });
    let points = own.chain(held).filter(|(_, link, _)| there(*link));
    let marked = points.map(|(id, link, place)| Marked {
        id: id.clone(),
        link,
        place,
        at: [0.0; 2],
    });
    marked.collect()
}

/// Returns the corners of the mark of a point.
pub(super) fn mark_corners(at: Point) -> [Point; 4] {
    [[MARK, 0.0], [0.0, MARK], [-MARK, 0.0], [0.0, -MARK]].map(|c| add(at, c))
}

/// Draws the mark of a point.
pub(super) fn draw_mark(sheet: &mut Sheet, at: Point) {
    sheet.draw_path("ink", &path_data(&mark_corners(at), true));
}

/// An arrow with a greater part of it towards the reader is seen from its end.
const END_ON: f64 = 0.9;
/// A moment seen from its end is an arc whose radius is this part of the arrow's length.
const ARC: f64 = 0.3;
/// A head's length.
const HEAD: f64 = 8.0;

/// An arrow in space.
#[derive(Debug, Clone)]
pub(super) struct Arrow {
    /// The place of its link among those drawn.
    pub(super) link: usize,
    /// Its start.
    pub(super) at: Vector,
    /// From its beginning to its tip, in pixels; a moment turns about it to the right.
    pub(super) along: Vector,
    /// Whether it is a moment.
    pub(super) turns: bool,
    /// Its tooltip.
    pub(super) tip: String,
}

/// Returns the shapes of an arrow that begins at a point of the paper.
pub(super) fn arrow_outline(at: Point, arrow: &Arrow, view: &View) -> Vec<Shape> {
    let (class, head) = if arrow.turns {
        ("moment", "moment head")
    } else {
        ("force", "force head")
    };
    let to = view.flat_vector(arrow.along);
    let (length, toward) = (norm(arrow.along), dot(arrow.along, view.toward));
    if arrow.turns && toward.abs() > END_ON * length {
        let radius = ARC * length;
        // to the left as seen from its tip; y goes down on paper
        let on = |i: i32| {
            let angle = -toward.signum() * 1.5 * PI * f64::from(i) / 24.0;
            add(at, [radius * angle.cos(), radius * angle.sin()])
        };
        let arc: Vec<Point> = (0..=24).map(on).collect();
        let back = unit(sub(arc[22], arc[24]));
        let point = arrow_head(arc[24], back, (0.8 * radius).min(HEAD), head);
        return vec![Shape::line(class, arc), point];
    }
    if toward.abs() > END_ON * length {
        // the point of an arrow that comes, the feathers of one that goes
        let (d, r) = (0.07 * length, 0.1 * length);
        let rim = (0..=24).map(|i| {
            let angle = TAU * f64::from(i) / 24.0;
            add(at, [r * angle.cos(), r * angle.sin()])
        });
        let line = |points: Vec<Point>| Shape::line(class, points);
        let inside = if toward > 0.0 {
            vec![Shape::circle(head, at, 0.3 * r)]
        } else {
            [-1.0, 1.0]
                .map(|s| line(vec![add(at, [-d, -s * d]), add(at, [d, s * d])]))
                .to_vec()
        };
        return [vec![line(rim.collect())], inside].concat();
    }
    let tip = add(at, to);
    let back = scale(unit(to), -1.0);
    let size = (0.6 * plane_norm(to)).min(HEAD);
    let mut out = vec![Shape::line(class, vec![at, tip])];
    out.push(arrow_head(tip, back, size, head));
    if arrow.turns {
        let behind = add(tip, scale(back, 0.8 * size));
        out.push(arrow_head(behind, back, size, head));
    }
    out
}

/// Returns the head of an arrow; `back` is a direction of length 1.
pub(super) fn arrow_head(tip: Point, back: Point, size: f64, class: &str) -> Shape {
    let side = scale([-back[1], back[0]], 0.4 * size);
    let foot = add(tip, scale(back, size));
    Shape::path(class, vec![tip, add(foot, side), sub(foot, side)], true)
}

/// The load of a joint.
pub(super) type Load = (JointId, Borne);

/// Returns the loads of a self-stress at the pose of the file, as far as they are known.
pub(super) fn known_loads(stress: &SelfStress) -> Vec<Load> {
    let known = |w: &JointWrench| Some((w.joint, w.borne?));
    stress.joints.iter().filter_map(known).collect()
}
