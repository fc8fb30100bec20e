//! Closing the contours of a pose: damped Newton steps of least norm.

use crate::motion::pose::Pose;
use ozols_dense::{Matrix, least_squares};

/// Maximum number of Newton steps per pose.
const STEPS: usize = 60;

/// Reason why a pose could not be reached.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PoseError {
    /// Newton's method found no closed pose.
    #[error(
        "the loops do not close: after {steps} steps a gap of {residual:.1e} of the mechanism's size is left"
    )]
    Open {
        /// Number of steps taken.
        steps: usize,
        /// The remaining gap.
        residual: f64,
    },
}

/// Share of a step within which a pose counts as the one it came from.
const BACK: f64 = 0.1;

impl Pose {
    /// Returns closed coordinates next to those of `from`, along a motion. The largest coordinate of the step is `far`, which is
    /// halved up to `halvings` times until the pose closes elsewhere.
    ///
    /// # Complexity
    /// As [`Pose::close`] for each step tried.
    #[must_use]
    pub fn beside(&self, from: &[f64], along: &[f64], far: f64, halvings: u32) -> Option<Vec<f64>> {
        let largest = |q: &[f64]| q.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let whole = far / largest(along).max(f64::MIN_POSITIVE);
        let steps =
            (0..=halvings).map(|h| (far / f64::from(1u32 << h), whole / f64::from(1u32 << h)));
        steps.into_iter().find_map(|(far, step)| {
            let guess = from.iter().zip(along).map(|(q, x)| q + x * step);
            let q = self.close(guess.collect(), &[]).ok()?;
            let moved: Vec<f64> = q.iter().zip(from).map(|(a, b)| a - b).collect();
            (largest(&moved) > BACK * far.abs()).then_some(q)
        })
    }

    /// Returns (nearly) the nearest closed coordinates to `q`, by damped least-norm Newton steps; `hold` keeps some
    /// coordinates fixed.
    ///
    /// # Errors
    /// Returns [`PoseError::Open`] if the gaps do not fall below [`Pose::closed`].
    ///
    /// # Complexity
    /// O((6k)²·f) per step.
    pub fn close(&self, q: Vec<f64>, hold: &[usize]) -> Result<Vec<f64>, PoseError> {
        self.close_within(q, hold, f64::INFINITY)
    }

    /// Works as [`Pose::close`], if only coordinates no farther than `most` from `q` are useful.
    ///
    /// # Errors
    /// Returns an error in the same cases as [`Pose::close`], and once a step leads twice as far. A pose that nearly
    /// closes on that path need not close nearby.
    ///
    /// # Complexity
    /// As [`Pose::close`].
    pub(crate) fn close_within(
        &self,
        mut q: Vec<f64>,
        hold: &[usize],
        most: f64,
    ) -> Result<Vec<f64>, PoseError> {
        let closed = self.closed();
        let start = q.clone();
        // Coordinate errors must not be corrected by moving along the motion.
        let floor = (1e3 * self.accuracy()).clamp(1e-11, 1e-2);
        let (mut residual, mut before) = (f64::INFINITY, f64::INFINITY);
        let mut best = (f64::INFINITY, q.clone());
        for _ in 0..STEPS {
            let gaps = self.gaps(&q);
            residual = gaps.iter().map(|x| x * x).sum::<f64>().sqrt();
            if residual < best.0 {
                best = (residual, q.clone());
            }
            // The last steps are free: Newton's method is quadratic, unless the pose is singular.
            if residual < 1e-14 || !residual.is_finite() {
                break;
            }
            // Measured contours never close exactly. Further steps would creep along the motion to where they close
            // better.
            if self.accuracy() > 0.0 && residual < closed && residual > before / 2.0 {
                break;
            }
            before = residual;
            let mut jacobian = self.jacobian(&q);
            for &c in hold {
                jacobian.col_mut(c).fill(0.0);
            }
            let step = least_norm(&jacobian, &gaps, residual.clamp(floor, 1e-2));
            let length = step.iter().map(|x| x * x).sum::<f64>().sqrt();
            if !length.is_finite() || (length < 1e-16 && residual < closed) {
                break;
            }
            let shorten = (0.5 / length).min(1.0);
            for (x, s) in q.iter_mut().zip(&step) {
                *x -= shorten * s;
            }
            let far = q
                .iter()
                .zip(&start)
                .map(|(a, b)| (a - b) * (a - b))
                .sum::<f64>();
            if far.sqrt() > 2.0 * most {
                return Err(PoseError::Open {
                    steps: STEPS,
                    residual: best.0,
                });
            }
        }
        if best.0 < closed {
            Ok(best.1)
        } else {
            Err(PoseError::Open {
                steps: STEPS,
                residual: residual.min(best.0),
            })
        }
    }
}

/// Returns the damped solution of J·x = gaps, min |J·x - gaps|² + λ|x|², by orthogonal factors, with λ in proportion to
/// the gap. If J is singular at the solution, this still converges. If J is regular, the damping vanishes faster than
/// the error [Yamashita & Fukushima 2001].
fn least_norm(jacobian: &Matrix, gaps: &[f64], damping: f64) -> Vec<f64> {
    let (rows, columns) = (jacobian.nrows(), jacobian.ncols());
    let stacked = Matrix::from_fn(rows + columns, columns, |r, c| match r.checked_sub(rows) {
        None => jacobian[(r, c)],
        Some(i) if i == c => damping,
        Some(_) => 0.0,
    });
    let mut right = gaps.to_vec();
    right.resize(rows + columns, 0.0);
    least_squares(&stacked, &right)
}
