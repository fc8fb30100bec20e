//! Closure of a structure's contours after its links have turned, and the distance between its tips.
//!
//! Unknowns are the turns of all moving links since the drawn pose, and the travel of the drive. A contour is a sum of sides, vectors
//! between two points of a link that turn with it. The sum of the sides on the path to a tip is the displacement of the tip.

use crate::chains::Input;
use crate::geom::vector::{dot, quarter_turn, sub};
use crate::synthesis::equations::elimination::SmallSystem;
use crate::synthesis::equations::velocities::{Contours, Side};
use crate::synthesis::place::Point;
use crate::synthesis::stroke::pose::LinkPose;
use crate::synthesis::stroke::walk::{FitEquations, RADIAN};

/// Motion that a side follows.
#[derive(Debug, Clone, Copy, PartialEq)]
enum SumMover {
    /// The turn with this unknown.
    Turn(usize),
    /// The slide.
    Slide,
}

/// A side of a sum: from one point to another.
#[derive(Debug, Clone, Copy)]
struct SumSide {
    /// The contour, or the jaw.
    sum: usize,
    sign: f64,
    from: usize,
    to: usize,
    follows: SumMover,
}

/// The sums of a structure, which do not depend on its places.
#[derive(Debug, Clone)]
pub struct Closure {
    /// Number of unknowns; the drive is the last.
    size: usize,
    contours: Vec<SumSide>,
    tips: Vec<SumSide>,
    /// Vectors away from the part, divided by the number of pairs of jaws. The displacements of the tips along them add up to the opening.
    outward: Vec<Point>,
}

/// Sums with places: the sides as vectors.
#[derive(Debug, Clone)]
pub struct Arms<'a> {
    closure: &'a Closure,
    contours: Vec<Point>,
    tips: Vec<Point>,
    /// The last trial of each unknown as a turn.
    pub(super) turns: Vec<LinkPose>,
}

impl Closure {
    /// Creates the sums of contours, and of the opening of the tips. `outward` is divided by the number of pairs of jaws.
    #[must_use]
    pub fn new(contours: &Contours, outward: Vec<Point>) -> Closure {
        let drive = contours.unknown.iter().flatten().count();
        let side = |sum: usize, sign: f64, s: &Side| SumSide {
            sum,
            sign,
            from: s.comes,
            to: s.leaves,
            follows: match contours.unknown[s.link] {
                Some(unknown) => SumMover::Turn(unknown),
                None if contours.input == Input::Turn => SumMover::Turn(drive),
                None => SumMover::Slide,
            },
        };
        let both = contours.contours.iter().enumerate();
        let both = both.flat_map(|(k, [plus, minus])| {
            let plus = plus.iter().map(move |s| side(k, 1.0, s));
            plus.chain(minus.iter().map(move |s| side(k, -1.0, s)))
        });
        let tips = contours.tips.iter().enumerate();
        let tips = tips.flat_map(|(n, way)| way.iter().map(move |s| side(n, 1.0, s)));
        Closure {
            size: drive + 1,
            contours: both.collect(),
            tips: tips.collect(),
            outward,
        }
    }
}

impl<'a> Arms<'a> {
    /// Creates the sides of a closure, without places.
    pub(super) fn new(closure: &'a Closure) -> Arms<'a> {
        Arms {
            closure,
            contours: Vec::new(),
            tips: Vec::new(),
            turns: vec![LinkPose::AT_REST; closure.size],
        }
    }

    /// Inserts places.
    pub(super) fn place(&mut self, at: &[Point]) {
        let vector = |s: &SumSide| sub(at[s.to], at[s.from]);
        self.contours.clear();
        self.contours
            .extend(self.closure.contours.iter().map(vector));
        self.tips.clear();
        self.tips.extend(self.closure.tips.iter().map(vector));
    }
}

impl FitEquations for Arms<'_> {
    fn size(&self) -> usize {
        self.closure.size
    }

    fn radian(&self, unknown: usize) -> f64 {
        if unknown + 1 == self.closure.size {
            RADIAN
        } else {
            1.0
        }
    }

    fn fill(&mut self, x: &[f64], wider: f64, rows: &mut SmallSystem) {
        let size = self.closure.size;
        let (last, slid) = (size - 1, x[size - 1]);
        for (turn, angle) in self.turns.iter_mut().zip(x) {
            *turn = LinkPose::turn_by(*angle);
        }
        // A turned side, and its difference from the drawn side.
        let moved = |s: &SumSide, arm: Point| match s.follows {
            SumMover::Slide => ([slid, 0.0], None),
            SumMover::Turn(unknown) => {
                let now = self.turns[unknown].turned_direction(arm);
                (sub(now, arm), Some((unknown, quarter_turn(now))))
            }
        };
        rows.clear();
        let (right, width) = (size, size + 1);
        for (s, &arm) in self.closure.contours.iter().zip(&self.contours) {
            let (by, rate) = moved(s, arm);
            let (column, rate) = rate.unwrap_or((last, [1.0, 0.0]));
            for k in 0..2 {
                rows.add_entry(2 * s.sum + k, column, s.sign * rate[k]);
                rows.add_entry(2 * s.sum + k, right, s.sign * by[k]);
            }
        }
        let mut open = -wider;
        for (s, &arm) in self.closure.tips.iter().zip(&self.tips) {
            let (by, rate) = moved(s, arm);
            let (column, rate) = rate.unwrap_or((last, [1.0, 0.0]));
            let outward = self.closure.outward[s.sum];
            rows.add_entry(last, column, dot(rate, outward));
            open += dot(by, outward);
        }
        rows.add_entry(last, right, open);
        rows.add_entry(last, width, 1.0);
    }
}
