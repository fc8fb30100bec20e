//! A closed mechanism followed along the coordinate of one joint, its drive, with the branch of the file's pose kept.
//!
//! Predictor and corrector [Allgower & Georg, "Numerical Continuation Methods", 1990, ch. 2 and 6], with the drive's
//! coordinate as parameter: a step along the motion of drive speed 1 that is least among all such motions, so that idle
//! freedoms rest, then Newton's method with the drive held. A step is halved where Newton's method fails, where it
//! corrects by more than [`CORRECTION`] of the step, or where the motion turns by more than [`TURN`]: another branch
//! through a singular pose nearby lies a fixed angle away, and the correction shrinks with the square of the step, so
//! what is met is the branch one was on. A pose where more motions are possible than before is passed in the direction
//! one came from. Below [`SMALLEST`] the drive is at the end of its way, and the last pose says why.
//!
//! Coordinates are counted from one pose, so that errors of closing do not add up; only balls that have turned far get a
//! new one.

use crate::motion::pose::{FLAT, Pose};
use ozols_dense::{Matrix, svd};
use thiserror::Error;

/// The longest step of the drive: radians, or fractions of the mechanism's size.
const LONGEST: f64 = 0.1;
/// The longest step of any coordinate.
const FARTHEST: f64 = 0.3;
/// A step below this is none.
pub const SMALLEST: f64 = 1e-10;
/// The largest correction, as a share of its step.
pub const CORRECTION: f64 = 0.2;
/// Cosine of the largest turn of the motion in a step, 20°.
pub const TURN: f64 = 0.94;
/// A drive with a smaller share in the motion of unit length stands still.
const STILL: f64 = 1e-3;
/// A kept singular value below this fraction of the largest is that of a pose next to a singular one.
const NEARLY_FLAT: f64 = 1e-3;
/// A ball turned farther than this about its second axis gets new axes.
const BALL: f64 = 0.7;

/// Why a stroke ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum Why {
    /// The mechanism moves, and the drive does not.
    #[error("dead point of this drive: the other joints can move on, the drive only back")]
    DeadPoint,
    /// No motion with the other drives held.
    #[error("nothing can move while the other drives are held")]
    Locked,
    /// Motions on several branches.
    #[error("singular pose: branches of the motion cross or end here, and none goes on smoothly")]
    Singular,
    /// Motions of first order that no pose follows, though nothing shows in the singular values alone.
    #[error(
        "the motion in this pose is instantaneous only: no pose next to it closes on this branch (a shaky pose, or a cusp)"
    )]
    Instantaneous,
}

impl Why {
    /// One word for data.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Why::DeadPoint => "dead-point",
            Why::Locked => "locked",
            Why::Singular => "singular",
            Why::Instantaneous => "instantaneous",
        }
    }
}

/// The end of a stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// Position of the drive in the last pose reached: radians, or fractions of [`Pose::length`].
    pub at: f64,
    /// Why it went no further.
    pub why: Why,
}

/// The motion of least size at drive speed 1.
#[derive(Debug, Clone)]
struct Tangent {
    /// Speed of each column; empty where the drive cannot move.
    speeds: Vec<f64>,
    /// Share of the drive in the motion of unit length.
    share: f64,
    /// Motions with the other drives held.
    motions: usize,
    /// The smallest kept singular value as a fraction of the largest.
    kept: f64,
}

/// A mechanism on its way along the drive's coordinate.
#[derive(Debug, Clone)]
pub struct Follower {
    /// The pose that coordinates are counted from.
    anchor: Pose,
    /// Coordinates since then.
    q: Vec<f64>,
    drive: usize,
    held: Vec<usize>,
    tangent: Tangent,
    /// The fewest motions met so far: what a regular pose has.
    fewest: usize,
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The motion at drive speed 1 nearest to `before` (least where there is none), with some columns held.
fn tangent(
    anchor: &Pose,
    q: &[f64],
    drive: usize,
    held: &[usize],
    before: Option<&Tangent>,
    fewest: usize,
) -> Tangent {
    let f = q.len();
    let free: Vec<usize> = (0..f).filter(|c| !held.contains(c)).collect();
    let none = |motions, kept| Tangent {
        speeds: Vec::new(),
        share: 0.0,
        motions,
        kept,
    };
    let whole = anchor.jacobian(q);
    let part = Matrix::from_fn(whole.nrows(), free.len(), |r, c| whole[(r, free[c])]);
    let Some(svd) = svd(&part) else {
        return none(0, 0.0);
    };
    // Errors of the coordinates open poses a little, and hide singular values up to their size.
    let rank = svd.rank(FLAT.max(10.0 * anchor.closed()));
    let last = rank.checked_sub(1);
    let kept = last.map_or(1.0, |i| svd.values[i] / svd.values[0]);
    let null = svd.null_space(rank);
    let motions = null.ncols();
    let Some(row) = free.iter().position(|&c| c == drive) else {
        return none(motions, kept);
    };
    let share: Vec<f64> = (0..motions).map(|m| null[(row, m)]).collect();
    let size = norm(&share);
    if size < 1e-12 {
        return none(motions, kept);
    }
    // Where more can move than before, on in the direction one came from.
    let mut weights = match before {
        Some(b) if motions > fewest && !b.speeds.is_empty() => (0..motions)
            .map(|m| {
                let along = free.iter().enumerate();
                along.map(|(r, &c)| null[(r, m)] * b.speeds[c]).sum()
            })
            .collect(),
        _ => vec![0.0; motions],
    };
    let missing = (1.0 - dot(&share, &weights)) / (size * size);
    for (w, s) in weights.iter_mut().zip(&share) {
        *w += missing * s;
    }
    let mut speeds = vec![0.0; f];
    for (r, &c) in free.iter().enumerate() {
        speeds[c] = (0..motions).map(|m| null[(r, m)] * weights[m]).sum();
    }
    Tangent {
        share: 1.0 / norm(&speeds),
        speeds,
        motions,
        kept,
    }
}

impl Follower {
    /// A mechanism at a pose, driven through a column; other drives are held.
    #[must_use]
    pub fn new(pose: Pose, drive: usize, held: &[usize]) -> Follower {
        let q = vec![0.0; pose.columns.len()];
        let tangent = tangent(&pose, &q, drive, held, None, usize::MAX);
        Follower {
            q,
            drive,
            held: held.to_vec(),
            fewest: tangent.motions,
            tangent,
            anchor: pose,
        }
    }

    /// Position of the drive: radians, or fractions of [`Pose::length`], from the pose of the file.
    #[must_use]
    pub fn at(&self) -> f64 {
        self.anchor.columns[self.drive].moved + self.q[self.drive]
    }

    /// The pose.
    #[must_use]
    pub fn pose(&self) -> Pose {
        self.anchor.moved(&self.q)
    }

    /// What the contours are open by: radians, and fractions of [`Pose::length`].
    #[must_use]
    pub fn gap(&self) -> f64 {
        norm(&self.anchor.gaps(&self.q))
    }

    /// Share of the drive's speed in the motion of unit length: 1 where nothing else moves, 0 at a dead point.
    #[must_use]
    pub fn share(&self) -> f64 {
        self.tangent.share
    }

    /// Motions with the other drives held: 1, idle ones, and those that no drive decides.
    #[must_use]
    pub fn motions(&self) -> usize {
        self.tangent.motions
    }

    fn tangent_at(&self, q: &[f64], before: Option<&Tangent>) -> Tangent {
        let (drive, held) = (self.drive, &self.held);
        tangent(&self.anchor, q, drive, held, before, self.fewest)
    }

    /// One step to a position of the drive, or nothing where it does not stay on the branch.
    fn step(&self, to: f64) -> Option<Follower> {
        let ahead = to - self.at();
        let mut guess: Vec<f64> = self
            .q
            .iter()
            .zip(&self.tangent.speeds)
            .map(|(q, t)| q + ahead * t)
            .collect();
        // Exactly there, whatever rounding did on the way.
        guess[self.drive] = to - self.anchor.columns[self.drive].moved;
        for &h in &self.held {
            guess[h] = self.q[h];
        }
        let mut hold = self.held.clone();
        hold.push(self.drive);
        let most = CORRECTION * ahead.abs() * norm(&self.tangent.speeds);
        let q = self.anchor.close_within(guess.clone(), &hold, most).ok()?;
        let correction: Vec<f64> = q.iter().zip(&guess).map(|(a, b)| a - b).collect();
        if norm(&correction) > most {
            return None;
        }
        let next = self.tangent_at(&q, Some(&self.tangent));
        if next.speeds.is_empty() {
            return None;
        }
        let cosine = dot(&next.speeds, &self.tangent.speeds) * next.share * self.tangent.share;
        if cosine < TURN {
            return None;
        }
        Some(Follower {
            anchor: self.anchor.clone(),
            q,
            drive: self.drive,
            held: self.held.clone(),
            fewest: self.fewest.min(next.motions),
            tangent: next,
        })
    }

    /// Counts coordinates from here where a ball has turned so far that its axes are about to meet.
    fn drop_anchor(&mut self) {
        let columns = &self.anchor.columns;
        let far = columns.windows(3).enumerate().any(|(i, w)| {
            w.iter().all(|c| c.joint == w[0].joint && c.freedom.turns())
                && self.q[i + 1].abs() > BALL
        });
        // In a singular pose the direction one came from would be lost.
        if far && self.tangent.motions == self.fewest {
            self.anchor = self.anchor.moved(&self.q);
            self.q = vec![0.0; self.q.len()];
            self.tangent = self.tangent_at(&self.q, None);
        }
    }

    /// Goes on to a position of the drive and hands over every pose on the way, the last one included.
    ///
    /// # Errors
    /// Where it goes no further; the pose is then the last one reached.
    ///
    /// # Complexity
    /// A closing and singular values, O((6k + f)³), a step; steps of at most `LONGEST`.
    pub fn advance(&mut self, to: f64, mut visit: impl FnMut(&Follower)) -> Result<(), Stop> {
        let mut longest = LONGEST;
        loop {
            let ahead = to - self.at();
            if ahead.abs() < 1e-15 {
                return Ok(());
            }
            if self.tangent.speeds.is_empty() {
                return Err(self.stop());
            }
            let fastest = self
                .tangent
                .speeds
                .iter()
                .fold(1.0, |m: f64, x| m.max(x.abs()));
            let most = longest.min(FARTHEST / fastest);
            let target = if ahead.abs() <= most {
                to
            } else {
                self.at() + most.copysign(ahead)
            };
            let tried = (target - self.at()).abs();
            match self.step(target) {
                Some(next) => {
                    *self = next;
                    self.drop_anchor();
                    visit(self);
                    longest = (2.0 * tried).clamp(2.0 * SMALLEST, LONGEST);
                }
                None => {
                    longest = tried / 2.0;
                    if longest < SMALLEST {
                        return Err(self.stop());
                    }
                }
            }
        }
    }

    /// Why there is no going on.
    fn stop(&self) -> Stop {
        let t = &self.tangent;
        let why = if t.motions == 0 {
            Why::Locked
        } else if t.motions > self.fewest {
            Why::Singular
        } else if t.share < STILL {
            Why::DeadPoint
        } else if t.kept < NEARLY_FLAT || self.branches() {
            Why::Singular
        } else {
            Why::Instantaneous
        };
        Stop { at: self.at(), why }
    }

    /// Whether other poses close by have fewer motions: the file's pose may be singular itself.
    fn branches(&self) -> bool {
        let ahead = 1e-3;
        [ahead, -ahead].iter().any(|h| {
            let near: Vec<f64> = self
                .q
                .iter()
                .zip(&self.tangent.speeds)
                .map(|(q, t)| q + h * t)
                .collect();
            self.anchor
                .close(near, &self.held)
                .is_ok_and(|q| self.tangent_at(&q, None).motions < self.tangent.motions)
        })
    }
}

/// A stroke in equal steps.
#[derive(Debug, Clone)]
pub struct Followed {
    /// The poses at the positions asked for, in order, as far as they were reached.
    pub reached: Vec<Follower>,
    /// Where and why it ended before the last.
    pub stop: Option<Stop>,
}

/// Follows a mechanism from its pose to the position `from` of a column (no poses given there) and on to `to` in `steps`
/// equal steps; positions in radians, or fractions of [`Pose::length`].
///
/// # Complexity
/// As [`Follower::advance`], for some ten poses a radian.
#[must_use]
pub fn follow(
    pose: &Pose,
    drive: usize,
    held: &[usize],
    range: [f64; 2],
    steps: usize,
) -> Followed {
    let mut follower = Follower::new(pose.clone(), drive, held);
    let mut reached = Vec::new();
    for to in positions(range, steps) {
        if let Err(stop) = follower.advance(to, |_| {}) {
            return Followed {
                reached,
                stop: Some(stop),
            };
        }
        reached.push(follower.clone());
    }
    Followed {
        reached,
        stop: None,
    }
}

/// Whether a column of a pose slides.
#[must_use]
pub fn slides(pose: &Pose, column: usize) -> bool {
    pose.columns[column].freedom.slides()
}

/// The positions of a stroke in equal steps, both ends included.
///
/// # Examples
/// ```
/// let all: Vec<f64> = ozols::motion::follow::positions([0.0, 1.0], 2).collect();
/// assert_eq!(all, [0.0, 0.5, 1.0]);
/// ```
pub fn positions([from, to]: [f64; 2], steps: usize) -> impl Iterator<Item = f64> {
    (0..=steps).map(move |i| {
        #[allow(clippy::cast_precision_loss, reason = "at most 1e5 steps")]
        let part = i as f64 / steps.max(1) as f64;
        from * (1.0 - part) + to * part
    })
}
