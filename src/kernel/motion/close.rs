//! Closing the contours of a pose: damped Newton steps of least norm.

use crate::motion::pose::Pose;
use ozols_dense::{Matrix, add_scaled, difference, largest_entry, least_squares, norm};

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

/// The value of an equation and its row.
pub(crate) type Equation = (f64, Vec<f64>);

/// How closed coordinates are sought.
pub(crate) struct Newton<'a> {
    /// Columns that keep their coordinates.
    pub(crate) hold: &'a [usize],
    /// Further equations: their values and rows at some coordinates.
    pub(crate) beside: &'a dyn Fn(&[f64]) -> Vec<Equation>,
    /// Maximum number of steps, and the longest.
    pub(crate) steps: usize,
    pub(crate) longest: f64,
    /// Distance from the start beyond which coordinates are useless.
    pub(crate) most: f64,
    /// Whether to stop after these gaps.
    pub(crate) stops: &'a dyn Fn(&[f64]) -> bool,
}

impl Pose {
    /// Returns closed coordinates next to those of `from`, along a motion. The largest coordinate of the step is `far`, which is
    /// halved up to `halvings` times until the pose closes elsewhere.
    ///
    /// # Complexity
    /// As [`Pose::close_loops`] for each step tried.
    #[must_use]
    pub fn closed_beside(
        &self,
        from: &[f64],
        along: &[f64],
        far: f64,
        halvings: u32,
    ) -> Option<Vec<f64>> {
        let whole = far / largest_entry(along).max(f64::MIN_POSITIVE);
        let steps =
            (0..=halvings).map(|h| (far / f64::from(1u32 << h), whole / f64::from(1u32 << h)));
        steps.into_iter().find_map(|(far, step)| {
            let q = self.close_loops(add_scaled(from, step, along), &[]).ok()?;
            (largest_entry(&difference(&q, from)) > BACK * far.abs()).then_some(q)
        })
    }

    /// Returns (nearly) the nearest closed coordinates to `q`, by damped least-norm Newton steps; `hold` keeps some
    /// coordinates fixed.
    ///
    /// # Errors
    /// Returns [`PoseError::Open`] if the gaps do not fall below [`Pose::closed_tolerance`].
    ///
    /// # Complexity
    /// O((6k)²·f) per step.
    ///
    /// # Examples
    /// ```
    /// use ozols::{model::mechanism::StateId, motion::pose::Pose};
    /// let pose = Pose::of_file(&ozols::built_in("four-bar")?, StateId::FREE)?;
    /// // The crank is turned by 0.1 rad and held; the other joints follow.
    /// let q = pose.close_loops(vec![0.1, 0.0, 0.0, 0.0], &[0]).expect("it closes");
    /// assert!(pose.closure_gaps(&q).iter().all(|gap| gap.abs() < 1e-9));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn close_loops(&self, q: Vec<f64>, hold: &[usize]) -> Result<Vec<f64>, PoseError> {
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
        q: Vec<f64>,
        hold: &[usize],
        most: f64,
    ) -> Result<Vec<f64>, PoseError> {
        let closed = self.closed_tolerance();
        // Measured contours never close exactly. Further steps would creep along the motion to where they close better.
        let stops = |gaps: &[f64]| match *gaps {
            [.., before, gap] => self.accuracy() > 0.0 && gap < closed && gap > before / 2.0,
            _ => false,
        };
        let (q, residual, far) = self.close_by_newton(
            q,
            &Newton {
                hold,
                beside: &|_| Vec::new(),
                steps: STEPS,
                longest: 0.5,
                most: 2.0 * most,
                stops: &stops,
            },
        );
        if residual < closed && !far {
            Ok(q)
        } else {
            Err(PoseError::Open {
                steps: STEPS,
                residual,
            })
        }
    }

    /// Returns the coordinates near `q` that satisfy all equations best, the remaining gap, and whether they led too
    /// far.
    pub(crate) fn close_by_newton(
        &self,
        mut q: Vec<f64>,
        how: &Newton<'_>,
    ) -> (Vec<f64>, f64, bool) {
        let start = q.clone();
        // Coordinate errors must not be corrected by moving along the motion.
        let floor = (1e3 * self.accuracy()).clamp(1e-11, 1e-2);
        let mut best = (q.clone(), f64::INFINITY);
        let mut history: Vec<f64> = Vec::new();
        for _ in 0..how.steps {
            let more = (how.beside)(&q);
            let mut gaps = self.closure_gaps(&q);
            gaps.extend(more.iter().map(|(x, _)| x));
            let gap = norm(&gaps);
            if gap < best.1 {
                best = (q.clone(), gap);
            }
            history.push(gap);
            // The last steps are free: Newton's method is quadratic, unless the pose is singular.
            if gap < 1e-14 || !gap.is_finite() || (how.stops)(&history) {
                break;
            }
            let mut jacobian = self.jacobian_at(&q);
            for &c in how.hold {
                jacobian.col_mut(c).fill(0.0);
            }
            let step = least_norm(&jacobian, &more, gaps, gap.clamp(floor, 1e-2));
            let length = norm(&step);
            if !length.is_finite() || length < 1e-16 {
                break;
            }
            q = add_scaled(&q, -(how.longest / length).min(1.0), &step);
            if norm(&difference(&q, &start)) > how.most {
                return (best.0, best.1, true);
            }
        }
        (best.0, best.1, false)
    }
}

/// Returns the damped solution of J·x = gaps, min |J·x - gaps|² + λ|x|², by orthogonal factors, with λ in proportion to
/// the gap. If J is singular at the solution, this still converges. If J is regular, the damping vanishes faster than
/// the error [Yamashita & Fukushima 2001].
fn least_norm(
    jacobian: &Matrix,
    more: &[(f64, Vec<f64>)],
    mut gaps: Vec<f64>,
    damping: f64,
) -> Vec<f64> {
    let (rows, all, columns) = (jacobian.nrows(), gaps.len(), jacobian.ncols());
    let stacked = Matrix::from_fn(all + columns, columns, |r, c| match r.checked_sub(all) {
        None if r < rows => jacobian[(r, c)],
        None => more[r - rows].1[c],
        Some(i) if i == c => damping,
        Some(_) => 0.0,
    });
    gaps.resize(all + columns, 0.0);
    least_squares(&stacked, &gaps)
}
