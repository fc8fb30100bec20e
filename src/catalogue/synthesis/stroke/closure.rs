//! The closure of a structure's contours when its links have turned, and how far apart its tips are then.
//!
//! Unknown are how far each link but the frame has turned since it was drawn, and how far the drive has gone. A contour is a sum
//! of sides, vectors between two points of a link that turn with it; what the sides of a tip's way add up to is where it has gone.

use crate::chains::Input;
use crate::geom::vector::{dot, quarter_turn, sub};
use crate::synthesis::elimination::SmallSystem;
use crate::synthesis::place::Point;
use crate::synthesis::stroke::pose::LinkPose;
use crate::synthesis::stroke::walk::{FitEquations, RADIAN};
use crate::synthesis::velocities::{Contours, Side};

/// What a side follows.
#[derive(Debug, Clone, Copy, PartialEq)]
enum SumMover {
    /// The turn that is this unknown.
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

/// The sums of a structure, whatever its places.
#[derive(Debug, Clone)]
pub struct Closure {
    /// How many are unknown; the drive is the last.
    size: usize,
    contours: Vec<SumSide>,
    tips: Vec<SumSide>,
    /// Away from the part, over the number of pairs of jaws: by this the tips' ways add up to the opening.
    outward: Vec<Point>,
}

/// Places put into the sums: the sides as vectors.
#[derive(Debug, Clone)]
pub struct Arms<'a> {
    closure: &'a Closure,
    contours: Vec<Point>,
    tips: Vec<Point>,
    /// What each unknown turns by, as it was tried last.
    pub(super) turns: Vec<LinkPose>,
}

impl Closure {
    /// Of contours, and of the ways that tips open, over the number of pairs of jaws.
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
    /// Room for those of a closure.
    pub(super) fn new(closure: &'a Closure) -> Arms<'a> {
        Arms {
            closure,
            contours: Vec::new(),
            tips: Vec::new(),
            turns: vec![LinkPose::AT_REST; closure.size],
        }
    }

    /// Puts places in.
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
        // A side as it has turned, and by how much it differs from what was drawn.
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
