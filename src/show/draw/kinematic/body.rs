//! The shape of a link: a bar where its joints are in a row, a plate where they are not; and the points of interest on links, those of
//! the file and the faces of jaws.

use crate::draw::kinematic::Kinematic;
use crate::draw::kinematic::moving::frame::Carried;
use crate::draw::place::projection::{Vector, add as add3, finite_vector, scale as times};
use crate::draw::sheet::{Sheet, Swatch};
use crate::draw::symbol::pieces::convex_hull;
use crate::draw::symbol::placed::one_place;
use crate::model::mechanism::{LinkId, Mechanism, StateId};
use crate::motion::jaws::jaw_faces;
use crate::svg::plane::{Point, add, cross, dot, mean, path_data, plane_norm, scale, sub, unit};

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

    /// Returns a bar that bows out to one side in its middle.
    pub(super) fn bowed_by(self, by: f64) -> Body {
        let (&[a, b], false) = (&self.points[..], self.plate || by == 0.0) else {
            return self;
        };
        let side = left_normal(a, b);
        let points = (0..=12).map(|i| {
            let t = f64::from(i) / 12.0;
            let on = add(a, scale(sub(b, a), t));
            add(on, scale(side, by * 4.0 * t * (1.0 - t)))
        });
        Body {
            points: points.collect(),
            plate: false,
        }
    }

    /// Returns the segments that draw the body.
    pub(super) fn body_lines(&self) -> impl Iterator<Item = (Point, Point)> + '_ {
        let n = self.points.len();
        let count = if self.plate { n } else { n.saturating_sub(1) };
        (0..count).map(move |i| (self.points[i], self.points[(i + 1) % n]))
    }

    /// Returns the middle of the body. That of a bar is halfway along.
    pub(super) fn body_middle(&self) -> Point {
        if self.plate || self.points.len() < 3 {
            return mean(self.points.iter().copied());
        }
        self.points[self.points.len() / 2]
    }
}

/// Returns how far each bar must bow out so that none lies on another. The longer bars stay straight.
pub(super) fn find_bows(bodies: &[Body]) -> Vec<f64> {
    let bar = |i: usize| match bodies[i].points[..] {
        [a, b] if !bodies[i].plate => Some([a, b]),
        _ => None,
    };
    let mut order: Vec<usize> = (0..bodies.len()).filter(|&i| bar(i).is_some()).collect();
    let length = |i: usize| bar(i).map_or(0.0, |[a, b]| plane_norm(sub(b, a)));
    order.sort_by(|&i, &j| length(j).total_cmp(&length(i)).then(i.cmp(&j)));
    let mut out = vec![0.0; bodies.len()];
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

/// Returns the unit vector to the left of a segment.
fn left_normal(a: Point, b: Point) -> Point {
    let along = unit(sub(b, a));
    [-along[1], along[0]]
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

impl Kinematic<'_> {
    /// Returns the points of a link.
    pub(super) fn points_of(&self, link: LinkId) -> impl Iterator<Item = &Marked> {
        self.points.iter().filter(move |p| p.link == link)
    }

    /// Returns all points of the paths.
    pub(super) fn traced_points(&self) -> impl Iterator<Item = Point> + '_ {
        self.traces.0.iter().flatten().copied()
    }

    pub(super) fn draw_traces(&self, sheet: &mut Sheet) {
        let (ways, closed) = &self.traces;
        for way in ways {
            sheet.draw_path("trace", &path_data(way, *closed));
        }
    }

    /// Returns the legend rows of points and their paths.
    pub(super) fn point_rows(&self) -> Vec<(Swatch, String)> {
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

    /// Returns the path of each point that is shown.
    pub(super) fn traced_ways(&self, poses: &[Carried<'_>]) -> Vec<Vec<Point>> {
        let tips = self.traced_tips().into_iter();
        let of = tips.map(|(link, tip)| {
            let at = |c: &Carried<'_>| self.projection.flat_point(c.carried_point(link, tip));
            poses.iter().map(at).collect()
        });
        of.collect()
    }

    /// Returns the points of interest. For an output link without any, returns its free end, or its joints except those
    /// on the frame.
    pub(super) fn traced_tips(&self) -> Vec<(LinkId, Vector)> {
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
    pub(super) fn loose_in_space(&self, link: usize) -> Option<Vector> {
        let of = &self.links[link].1;
        let off = sub(self.loose_end(link)?, self.spots[of[0]].at);
        let (view, scale) = (&self.projection.view, self.projection.scale);
        let across = add3(
            times(view.right, off[0] / scale),
            times(view.up, -off[1] / scale),
        );
        Some(add3(self.places[of[0]].point, across))
    }
}
