//! Points of interest on links: those of the file, and the faces of jaws.

use crate::draw::place::projection::{Vector, real};
use crate::draw::sheet::Sheet;
use crate::model::mechanism::{LinkId, Mechanism, StateId};
use crate::motion::jaws::faces;
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

/// The points of links that are there, and where an output link is to hold the object that is not there in this state.
pub(super) fn marked(m: &Mechanism, state: StateId, links: &[(LinkId, Vec<usize>)]) -> Vec<Marked> {
    let there = |l: LinkId| links.iter().any(|(k, _)| *k == l);
    let own = m.points.iter().map(|p| (&p.id, p.link, real(&p.point)));
    let held = faces(m, state).map(|(j, jaw)| {
        let joint = &m.joints[j];
        (&joint.id, jaw, real(&joint.frame.point))
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

/// The corners of the mark of a point.
pub(super) fn corners(at: Point) -> [Point; 4] {
    [[HALF, 0.0], [0.0, HALF], [-HALF, 0.0], [0.0, -HALF]].map(|c| add(at, c))
}

/// Draws the mark of a point.
pub(super) fn draw_mark(sheet: &mut Sheet, at: Point) {
    sheet.path("ink", &polyline(&corners(at), true));
}
