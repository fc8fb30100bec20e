//! The ground of a kinematic scheme: where the frame is, once for all joints of one place.

use crate::draw::prelude::*;

/// Half the hatched line under a pivot.
const PIVOT: f64 = 11.0;
/// Half the hatched line that a block slides along.
const RAIL: f64 = 24.0;

/// The ground at a joint: from the joint to the middle of the hatched line.
pub(crate) struct Ground {
    pub(crate) from: Point,
    pub(crate) to: Point,
    /// Half the hatched line; a block slides along it, so that no line joins the two, where it is a rail.
    half: f64,
}

impl Ground {
    /// Returns the ground under a pivot.
    pub(crate) fn under_pivot(from: Point, to: Point) -> Ground {
        Ground {
            from,
            to,
            half: PIVOT,
        }
    }

    /// Makes a rail long enough for a block that goes from `low` to `high` of where it is at rest.
    pub(crate) fn lengthen_rail(&mut self, low: Point, high: Point) {
        if self.is_rail() {
            let by = scale(add(low, high), 0.5);
            (self.from, self.to) = (add(self.from, by), add(self.to, by));
            self.half += plane_norm(sub(high, low)) / 2.0;
        }
    }

    /// Returns true if it is the rail of a block.
    fn is_rail(&self) -> bool {
        self.half > PIVOT
    }

    /// Returns the line from the joint to the ground, or `None` for a rail.
    pub(crate) fn stem_line(&self) -> Option<(Point, Point)> {
        (!self.is_rail()).then_some((self.from, self.to))
    }

    fn side_and_out(&self) -> (Point, Point) {
        let out = unit(sub(self.to, self.from));
        ([-out[1], out[0]], out)
    }

    pub(crate) fn ground_room(&self) -> Rect {
        let (side, out) = self.side_and_out();
        let far = add(self.to, scale(out, 6.0));
        let corners = [
            add(self.to, scale(side, self.half)),
            sub(self.to, scale(side, self.half)),
            add(far, scale(side, self.half + 3.0)),
            sub(far, scale(side, self.half + 3.0)),
        ];
        bounds_of(&corners)
    }

    /// Returns its lines and the strokes of its hatching.
    pub(crate) fn ground_shapes(&self) -> Vec<Shape> {
        let (side, out) = self.side_and_out();
        let stem = self.stem_line().map(|(a, b)| vec![a, b]);
        let across = scale(side, self.half);
        let line = vec![add(self.to, across), sub(self.to, across)];
        let solid = stem.into_iter().chain([line]);
        let strokes = ((self.half - 1.0) / 2.5).floor() as i32 + 1;
        let strokes = (0..strokes).map(|i| {
            let a = add(self.to, scale(side, self.half - 1.0 - 5.0 * f64::from(i)));
            vec![a, add(add(a, scale(out, 6.0)), scale(side, -4.0))]
        });
        let solid = solid.map(|points| Shape::line("bone", points));
        let strokes = strokes.map(|points| Shape::line("fine", points));
        solid.chain(strokes).collect()
    }
}

/// A place of the frame's joints.
pub(crate) struct GroundSpot {
    pub(crate) at: Point,
    /// The directions of the moving links.
    pub(crate) dirs: Vec<Point>,
    /// The room of the symbols.
    pub(crate) room: Rect,
    /// The direction of a block's slide on paper, and how far its side is from its middle.
    pub(crate) rail: Option<(Point, f64)>,
}

impl GroundSpot {
    /// Returns a ground in one of sixteen directions, and its position. A rail has two directions.
    fn ground_at(&self, step: i32) -> (Ground, Point) {
        if let Some((along, off)) = self.rail {
            let side = [-along[1], along[0]];
            let dir = scale(side, if step % 2 == 0 { 1.0 } else { -1.0 });
            let rail = Ground {
                from: self.at,
                to: add(self.at, scale(dir, off)),
                half: RAIL,
            };
            return (rail, dir);
        }
        let [left, top, right, bottom] = self.room.edges();
        let reach = (right - left).min(bottom - top) / 2.0 + 9.0;
        let angle = TAU * f64::from(step) / 16.0;
        let dir = [angle.cos(), angle.sin()];
        (
            Ground::under_pivot(self.at, add(self.at, scale(dir, reach))),
            dir,
        )
    }

    /// Returns the ground with the least cost: how far it is from upright, what it covers of symbols elsewhere and of other grounds, and the
    /// links in its direction.
    pub(crate) fn best_ground(&self, elsewhere: &[Rect], others: &[Ground]) -> Option<Ground> {
        let tried = (0..16).map(|step| {
            let (ground, dir) = self.ground_at(step);
            // straight down is best, then what is clear
            let aslant = if step % 4 == 0 { 0.0 } else { 0.9 };
            let near = ground.ground_room().grown_by(1.0);
            let symbols = elsewhere.iter().filter(|r| near.overlaps(r)).count();
            let grounds = others
                .iter()
                .filter(|g| g.ground_room().overlaps(&near))
                .count();
            let along = self.dirs.iter().map(|&link| dot(dir, unit(link)));
            let links: f64 = along.filter(|&share| share > 0.5).sum();
            let covered = 4.0 * symbols as f64 + 3.0 * grounds as f64;
            let cost = 0.25 * (1.0 - dir[1]) + aslant + covered + 2.5 * links;
            (cost, ground)
        });
        let best = tried.reduce(|a, b| if b.0 < a.0 - 1e-9 { b } else { a });
        best.map(|(_, ground)| ground)
    }
}
