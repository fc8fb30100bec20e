//! A closed mechanism followed along the coordinate of one joint, its drive, on the branch of the file's pose.
//!
//! The method is predictor and corrector [Allgower & Georg, "Numerical Continuation Methods", 1990, ch. 2 and 6], with
//! the drive's coordinate as parameter. A step follows the motion of drive speed 1 that is smallest among all such
//! motions, so that idle freedoms rest. Newton's method with the drive held corrects it.
//!
//! A step is halved if Newton's method fails, if it corrects by more than [`CORRECTION`] of the step, or if the motion
//! turns by more than [`TURN`]. Another branch through a nearby singular pose lies a fixed angle away, and the
//! correction shrinks with the square of the step. So the follower stays on its branch.
//!
//! A pose with more possible motions than before is passed in the incoming direction. Below [`SMALLEST`] the drive is
//! at the end of its range, and the last pose gives the reason.
//!
//! Coordinates are measured from one pose, so that closure errors do not accumulate. Only balls that have turned far
//! get a new reference pose.

use crate::motion::pose::{FLAT, Pose};
use ozols_dense::{add_scaled, difference, dot, largest_entry, norm, svd};
use thiserror::Error;

/// The longest step of the drive: radians, or fractions of the mechanism's size.
const LONGEST: f64 = 0.1;
/// The longest step of any coordinate.
const FARTHEST: f64 = 0.3;
/// Minimum step length.
pub const SMALLEST: f64 = 1e-10;
/// The largest correction, as a share of its step.
pub const CORRECTION: f64 = 0.2;
/// Cosine of the largest turn of the motion in a step, 20°.
pub const TURN: f64 = 0.94;
/// Share of the drive in the motion of unit length below which the drive is at rest.
const STILL: f64 = 1e-3;
/// Fraction of the largest singular value below which a kept one indicates a pose close to a singular one.
const NEARLY_FLAT: f64 = 1e-3;
/// Turn of a ball about its second axis beyond which it gets new axes.
const BALL: f64 = 0.7;

/// Reason why a stroke ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum Why {
    /// The mechanism moves, and the drive does not.
    #[error(
        "dead point: from here this drive can only move back, although the other joints can continue"
    )]
    DeadPoint,
    /// No motion with the other drives held.
    #[error("nothing can move while the other drives are locked")]
    Locked,
    /// Motions on several branches.
    #[error("singular pose: branches of the motion meet or end here, and none continues smoothly")]
    Singular,
    /// First-order motions that no pose follows, although the singular values show no irregularity.
    #[error(
        "the motion in this pose is instantaneous only: no pose next to it closes on this branch (a shaky pose or a cusp)"
    )]
    Instantaneous,
}

impl Why {
    /// Returns one word for data.
    #[must_use]
    pub fn as_word(self) -> &'static str {
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
    /// The reason.
    pub why: Why,
}

/// The smallest motion at drive speed 1.
#[derive(Debug, Clone)]
struct Tangent {
    /// Speed of each column; empty if the drive cannot move.
    speeds: Vec<f64>,
    /// Share of the drive in the motion of unit length.
    share: f64,
    /// Number of motions with the other drives held.
    motions: usize,
    /// The smallest kept singular value as a fraction of the largest.
    kept: f64,
}

/// A mechanism moving along the drive's coordinate.
#[derive(Debug, Clone)]
pub struct Follower {
    /// The reference pose of the coordinates.
    anchor: Pose,
    /// Coordinates relative to it.
    q: Vec<f64>,
    drive: usize,
    held: Vec<usize>,
    tangent: Tangent,
    /// The smallest number of motions so far, which is that of a regular pose.
    fewest: usize,
}

/// Returns the motion at drive speed 1 nearest to `before` (or the smallest if there is none), with some columns held.
fn nearest_tangent(
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
    let whole = anchor.jacobian_at(q);
    let Some(svd) = svd(&whole.select_columns(&free)) else {
        return none(0, 0.0);
    };
    // Coordinate errors open poses slightly, and hide singular values up to their size.
    let rank = svd.rank(FLAT.max(10.0 * anchor.closed_tolerance()));
    let last = rank.checked_sub(1);
    let kept = last.map_or(1.0, |i| svd.values[i] / svd.values[0]);
    let null = svd.null_space(rank);
    let motions = null.ncols();
    let Some(row) = free.iter().position(|&c| c == drive) else {
        return none(motions, kept);
    };
    let share = null.row(row);
    let size = norm(&share);
    if size < 1e-12 {
        return none(motions, kept);
    }
    // If more motions are possible than before, the direction stays the incoming one.
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
    for (&c, speed) in free.iter().zip(null.combine_columns(&weights)) {
        speeds[c] = speed;
    }
    Tangent {
        share: 1.0 / norm(&speeds),
        speeds,
        motions,
        kept,
    }
}

impl Follower {
    /// Creates a follower of a mechanism at a pose, driven through a column; other drives are held.
    #[must_use]
    pub fn new(pose: Pose, drive: usize, held: &[usize]) -> Follower {
        let q = vec![0.0; pose.columns.len()];
        let tangent = nearest_tangent(&pose, &q, drive, held, None, usize::MAX);
        Follower {
            q,
            drive,
            held: held.to_vec(),
            fewest: tangent.motions,
            tangent,
            anchor: pose,
        }
    }

    /// Returns the position of the drive: radians, or fractions of [`Pose::length`], from the pose of the file.
    #[must_use]
    pub fn drive_position(&self) -> f64 {
        self.anchor.columns[self.drive].moved + self.q[self.drive]
    }

    /// Returns the pose.
    #[must_use]
    pub fn current_pose(&self) -> Pose {
        self.anchor.moved_to(&self.q)
    }

    /// Returns the gap of the contours: radians, and fractions of [`Pose::length`].
    #[must_use]
    pub fn closure_gap(&self) -> f64 {
        norm(&self.anchor.closure_gaps(&self.q))
    }

    /// Returns the share of the drive's speed in the motion of unit length: 1 if nothing else moves, 0 at a dead point.
    #[must_use]
    pub fn drive_share(&self) -> f64 {
        self.tangent.share
    }

    fn tangent_at(&self, q: &[f64], before: Option<&Tangent>) -> Tangent {
        let (drive, held) = (self.drive, &self.held);
        nearest_tangent(&self.anchor, q, drive, held, before, self.fewest)
    }

    /// Returns the result of one step to a position of the drive, or `None` if it leaves the branch.
    fn step_to(&self, to: f64) -> Option<Follower> {
        let ahead = to - self.drive_position();
        let mut guess = add_scaled(&self.q, ahead, &self.tangent.speeds);
        // The position is exact, whatever the rounding along the path.
        guess[self.drive] = to - self.anchor.columns[self.drive].moved;
        for &h in &self.held {
            guess[h] = self.q[h];
        }
        let mut hold = self.held.clone();
        hold.push(self.drive);
        let most = CORRECTION * ahead.abs() * norm(&self.tangent.speeds);
        let q = self.anchor.close_within(guess.clone(), &hold, most).ok()?;
        if norm(&difference(&q, &guess)) > most {
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

    /// Resets the reference pose if a ball has turned so far that its axes nearly align.
    fn drop_anchor(&mut self) {
        let columns = &self.anchor.columns;
        let far = columns.windows(3).enumerate().any(|(i, w)| {
            w.iter()
                .all(|c| c.joint == w[0].joint && c.freedom.is_turn())
                && self.q[i + 1].abs() > BALL
        });
        // In a singular pose the incoming direction would be lost.
        if far && self.tangent.motions == self.fewest {
            self.anchor = self.anchor.moved_to(&self.q);
            self.q = vec![0.0; self.q.len()];
            self.tangent = self.tangent_at(&self.q, None);
        }
    }

    /// Moves on to a position of the drive and visits every pose along the path, including the last one.
    ///
    /// # Errors
    /// Returns an error if the drive stops earlier. The pose is then the last one reached.
    ///
    /// # Complexity
    /// One closure and singular values, O((6k + f)³), per step; steps of at most `LONGEST`.
    ///
    /// # Examples
    /// ```
    /// use ozols::{model::mechanism::StateId, motion::{follow::Follower, pose::Pose}};
    /// let pose = Pose::of_file(&ozols::built_in("four-bar")?, StateId::FREE)?;
    /// let mut follower = Follower::new(pose, 0, &[]);
    /// assert!(follower.advance_to(1.0, |_| {}).is_ok());
    /// assert!((follower.drive_position() - 1.0).abs() < 1e-12 && follower.closure_gap() < 1e-9);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn advance_to(&mut self, to: f64, mut visit: impl FnMut(&Follower)) -> Result<(), Stop> {
        let mut longest = LONGEST;
        loop {
            let ahead = to - self.drive_position();
            if ahead.abs() < 1e-15 {
                return Ok(());
            }
            if self.tangent.speeds.is_empty() {
                return Err(self.reason_to_stop());
            }
            let fastest = largest_entry(&self.tangent.speeds).max(1.0);
            let most = longest.min(FARTHEST / fastest);
            let target = if ahead.abs() <= most {
                to
            } else {
                self.drive_position() + most.copysign(ahead)
            };
            let tried = (target - self.drive_position()).abs();
            match self.step_to(target) {
                Some(next) => {
                    *self = next;
                    self.drop_anchor();
                    visit(self);
                    longest = (2.0 * tried).clamp(2.0 * SMALLEST, LONGEST);
                }
                None => {
                    longest = tried / 2.0;
                    if longest < SMALLEST {
                        return Err(self.reason_to_stop());
                    }
                }
            }
        }
    }

    /// Returns the reason why the drive stops.
    fn reason_to_stop(&self) -> Stop {
        let t = &self.tangent;
        let why = if t.motions == 0 {
            Why::Locked
        } else if t.motions > self.fewest {
            Why::Singular
        } else if t.share < STILL {
            Why::DeadPoint
        } else if t.kept < NEARLY_FLAT || self.has_branches() {
            Why::Singular
        } else {
            Why::Instantaneous
        };
        Stop {
            at: self.drive_position(),
            why,
        }
    }

    /// Returns true if nearby poses have fewer motions; the file's pose may be singular itself.
    fn has_branches(&self) -> bool {
        let ahead = 1e-3;
        [ahead, -ahead].iter().any(|h| {
            let near = add_scaled(&self.q, *h, &self.tangent.speeds);
            self.anchor
                .close_loops(near, &self.held)
                .is_ok_and(|q| self.tangent_at(&q, None).motions < self.tangent.motions)
        })
    }
}

/// Returns true if a column of a pose slides.
#[must_use]
pub fn column_slides(pose: &Pose, column: usize) -> bool {
    pose.columns[column].freedom.is_slide()
}

/// Returns the number of radians, or of the file's units of length, in one unit of a column.
#[must_use]
pub fn column_unit(pose: &Pose, column: usize) -> f64 {
    if column_slides(pose, column) {
        pose.length
    } else {
        1.0
    }
}

/// Returns the positions of a stroke in equal steps, including both ends.
///
/// # Examples
/// ```
/// let all: Vec<f64> = ozols::motion::follow::stroke_positions([0.0, 1.0], 2).collect();
/// assert_eq!(all, [0.0, 0.5, 1.0]);
/// ```
pub fn stroke_positions([from, to]: [f64; 2], steps: usize) -> impl Iterator<Item = f64> {
    (0..=steps).map(move |i| {
        let part = i as f64 / steps.max(1) as f64;
        from * (1.0 - part) + to * part
    })
}
