//! Points of interest on links.

use crate::draw::projection::{Vector, real};
use crate::draw::sheet::Sheet;
use crate::model::mechanism::{LinkId, Mechanism};
use crate::svg::plane::{Point, add, polyline};

/// Half of a point's mark, which is no circle: those are joints.
const HALF: f64 = 4.0;

/// A point of interest.
#[derive(Debug, Clone)]
pub(super) struct Marked {
    /// Its name.
    pub(super) id: String,
    pub(super) link: LinkId,
    /// Where it is in space.
    pub(super) place: Vector,
    /// Where it is on paper.
    pub(super) at: Point,
}

/// The points of links that are there.
pub(super) fn marked(m: &Mechanism, links: &[(LinkId, Vec<usize>)]) -> Vec<Marked> {
    let there = |l: LinkId| links.iter().any(|(k, _)| *k == l);
    let points = m.points.iter().filter(|p| there(p.link));
    let marked = points.map(|p| Marked {
        id: p.id.clone(),
        link: p.link,
        place: real(&p.point),
        at: [0.0; 2],
    });
    marked.collect()
}

/// Draws the mark of a point.
pub(super) fn draw_mark(sheet: &mut Sheet, at: Point) {
    let corners = [[HALF, 0.0], [0.0, HALF], [-HALF, 0.0], [0.0, -HALF]];
    let corners = corners.map(|c| add(at, c));
    sheet.path("ink", &polyline(&corners, true));
}
