//! Faces on paper: what covers what, from back to front, and which of their edges are drawn.

use super::solids::{PairPart, SolidFace};
use crate::draw::place::projection::{Vector, View, bounds};
use crate::draw::sheet::Sheet;
use crate::draw::sheet::shapes::hatch_with;
use crate::geom::vector::{add, cross, dot, length, scale, sub, unit};
use crate::svg::plane::{self, Point, Rect, area, mean, polyline};

/// Where light comes from, in directions of the paper: right, up, toward the reader.
const LIGHT: Vector = [-0.6, 0.5, 0.62];
/// How many tones a link has, from light to dark.
const TONES: f64 = 6.0;
/// Faces that share less than this, in square pixels, do not cover each other.
const TOUCH: f64 = 0.05;
/// Faces whose normals differ by less than this cosine have no edge between them.
const SMOOTH: f64 = 0.85;
/// An edge is looked at in pieces of about this length.
const PIECE: f64 = 6.0;

/// A face on paper.
pub(super) struct PaperFace {
    /// Its corners.
    pub(super) points: Vec<Point>,
    class: String,
    cut: bool,
    /// The pieces of its outline that are drawn.
    pub(super) edges: Vec<[Point; 2]>,
    room: Rect,
    /// Its plane: the unit normal in directions of the paper, and how far it is from the origin along that.
    normal: Vector,
    off: f64,
}

impl PaperFace {
    /// How near its plane is to the reader at a point of the paper.
    fn depth(&self, [x, y]: Point) -> f64 {
        (self.off - self.normal[0] * x + self.normal[1] * y) / self.normal[2]
    }

    /// Draws it round the origin of a sheet's group.
    pub(super) fn draw(&self, sheet: &mut Sheet) {
        sheet.path(&self.class, &polyline(&self.points, true));
        if self.cut {
            sheet.path("hatch", &hatch_with(&self.points, 0.0, 4.5));
        }
        if !self.edges.is_empty() {
            let lines = self.edges.iter().map(|e| polyline(e, false));
            sheet.path("edge", &lines.collect::<String>());
        }
    }
}

/// The faces that look at the reader, from back to front.
pub(super) fn seen(faces: &[SolidFace], view: &View) -> Vec<PaperFace> {
    let on_paper = |v: Vector| [view.right, view.up, view.toward].map(|a| dot(a, v));
    let front: Vec<(&SolidFace, Vector)> = faces
        .iter()
        .map(|f| (f, unit(f.normal())))
        .filter(|(_, n)| dot(*n, view.toward) > 1e-6)
        .collect();
    let all = front.iter().map(|&(f, n)| {
        let points: Vec<Point> = f.points.iter().map(|&p| view.flat(p)).collect();
        PaperFace {
            class: class(f, on_paper(n)),
            cut: f.cut,
            edges: edges(f, n, &front)
                .into_iter()
                .map(|e| e.map(|p| view.flat(p)))
                .collect(),
            room: bounds(&points),
            points,
            normal: on_paper(n),
            off: dot(n, f.points[0]),
        }
    });
    ordered(all.collect())
}

/// The classes of a face: its link, and how much light it has.
fn class(face: &SolidFace, normal: Vector) -> String {
    let part = match face.part {
        PairPart::A => "body-a",
        PairPart::B => "body-b",
        PairPart::Between => "body-c",
    };
    if face.cut {
        return "cut".to_owned();
    }
    let dark = (1.0 - dot(normal, LIGHT) / length(LIGHT)) / 1.6;
    match (dark * TONES).clamp(0.0, TONES - 1.0) as usize {
        0 => part.to_owned(),
        tone => format!("{part} t{tone}"),
    }
}

/// The pieces of a face's outline beyond which its surface does not go on, straight or round, as far as it is seen.
fn edges(face: &SolidFace, normal: Vector, front: &[(&SolidFace, Vector)]) -> Vec<[Vector; 2]> {
    let near: Vec<&(&SolidFace, Vector)> = front
        .iter()
        .filter(|(f, n)| {
            !std::ptr::eq(*f, face)
                && f.part == face.part
                && f.cut == face.cut
                && dot(*n, normal) > SMOOTH
        })
        .collect();
    let next = face.points.iter().cycle().skip(1);
    let mut out: Vec<[Vector; 2]> = Vec::new();
    for (&a, &b) in face.points.iter().zip(next) {
        let along = sub(b, a);
        let pieces = (length(along) / PIECE).ceil().max(1.0);
        let at = |t: f64| add(a, scale(along, t / pieces));
        let mut open = false;
        for i in 0..pieces as usize {
            let t = i as f64;
            if near.iter().any(|(f, n)| holds(f, *n, at(t + 0.5))) {
                open = false;
                continue;
            }
            match out.last_mut() {
                Some(last) if open => last[1] = at(t + 1.0),
                _ => out.push([at(t), at(t + 1.0)]),
            }
            open = true;
        }
    }
    out
}

/// Whether a point is on a face, its outline included.
fn holds(face: &SolidFace, normal: Vector, p: Vector) -> bool {
    let next = face.points.iter().cycle().skip(1);
    // faces of a thread are not quite flat
    dot(normal, sub(p, face.points[0])).abs() < 0.6
        && face.points.iter().zip(next).all(|(&a, &b)| {
            let inward = unit(cross(normal, sub(b, a)));
            dot(inward, sub(p, a)) > -0.3
        })
}

/// Faces in an order in which each comes after those that it covers.
fn ordered(mut all: Vec<PaperFace>) -> Vec<PaperFace> {
    let depth = |s: &PaperFace| s.depth(mean(s.points.iter().copied()));
    all.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
    let n = all.len();
    // by face, those it covers
    let mut behind: Vec<Vec<usize>> = vec![Vec::new(); n];
    for i in 0..n {
        for j in 0..i {
            match covers(&all[i], &all[j]) {
                Some(true) => behind[i].push(j),
                Some(false) => behind[j].push(i),
                None => {}
            }
        }
    }
    let mut order: Vec<usize> = Vec::new();
    let mut done = vec![false; n];
    while order.len() < n {
        let mut rest = (0..n).filter(|&i| !done[i]);
        let ready = rest.clone().find(|&i| behind[i].iter().all(|&j| done[j]));
        // faces that cover each other in a ring go by their middles
        let Some(i) = ready.or_else(|| rest.next()) else {
            break;
        };
        done[i] = true;
        order.push(i);
    }
    let mut all: Vec<Option<PaperFace>> = all.into_iter().map(Some).collect();
    order.into_iter().filter_map(|i| all[i].take()).collect()
}

/// Whether the first of two faces is in front of the second; nothing where they are side by side on paper.
fn covers(a: &PaperFace, b: &PaperFace) -> Option<bool> {
    if !a.room.overlaps(&b.room) {
        return None;
    }
    let shared = shared(&a.points, &b.points);
    if shared.len() < 3 || area(&shared) < TOUCH {
        return None;
    }
    let at = mean(shared.into_iter());
    let gap = a.depth(at) - b.depth(at);
    (gap.abs() > 1e-6).then_some(gap > 0.0)
}

/// What two convex polygons, which run the same way round, have in common.
fn shared(a: &[Point], b: &[Point]) -> Vec<Point> {
    let mut out = a.to_vec();
    let next = b.iter().cycle().skip(1);
    for (&p, &q) in b.iter().zip(next) {
        let side = |r: Point| -plane::cross(plane::sub(q, p), plane::sub(r, p));
        let before = std::mem::take(&mut out);
        let after = before.iter().cycle().skip(1);
        for (&r, &s) in before.iter().zip(after) {
            let (u, v) = (side(r), side(s));
            if u >= 0.0 {
                out.push(r);
            }
            if (u > 0.0 && v < 0.0) || (u < 0.0 && v > 0.0) {
                out.push(plane::add(r, plane::scale(plane::sub(s, r), u / (u - v))));
            }
        }
    }
    out
}
