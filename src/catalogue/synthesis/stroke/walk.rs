//! Walk from the drawn pose, step by step, to wider and narrower parts, by Newton's method.
//!
//! A step is predicted by the cubic through the last two poses with their rates. It is halved in three cases: the first correction is large
//! compared with the step, the determinant changes its sign, or the drive would turn back. So no step passes a singular pose or a dead
//! point unnoticed.

use crate::synthesis::equations::elimination::SmallSystem;

/// Maximum number of corrections of a step.
const CORRECTIONS: usize = 6;
/// Maximum of the first correction, as a fraction of the step.
const CORRECTION: f64 = 0.25;
/// Bound for the last correction of a pose whose figures are reported, in rad.
pub(in crate::synthesis) const SETTLED: f64 = 1e-8;
/// Millimetres that count as a radian of a link.
pub(in crate::synthesis) const RADIAN: f64 = 50.0;
/// Threshold for the kind of an end, on the rate of the drive over the width, relative to the drawn pose. A rate this many times as fast is
/// near a turning point of the jaws, and one this many times as slow is near a dead point.
const FAR: f64 = 4.0;

/// Why a stroke ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StrokeEnd {
    /// The jaws turn back while the drive goes on.
    JawsTurnBack,
    /// The drive turns back while the jaws could go on.
    DeadPoint,
    /// Links lock, or their motion branches.
    Singular,
}

impl StrokeEnd {
    /// Returns the word for data files.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            StrokeEnd::JawsTurnBack => "jaws-turn-back",
            StrokeEnd::DeadPoint => "dead-point",
            StrokeEnd::Singular => "singular",
        }
    }

    /// Returns the end in words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            StrokeEnd::JawsTurnBack => "there the jaws turn back while the drive goes on",
            StrokeEnd::DeadPoint => "there the drive turns back",
            StrokeEnd::Singular => "there the links lock",
        }
    }
}

/// Equations for links that fit together and tips at a given distance from each other; the drive is the last unknown.
pub trait FitEquations {
    /// Returns the number of equations and unknowns.
    fn size(&self) -> usize;

    /// Returns how many units of an unknown count as a radian of a link, when steps and corrections are compared.
    fn radian(&self, unknown: usize) -> f64;

    /// Fills the rows with the derivatives at `x` and two right sides. The first is the error of the equations, if the tips are `wider`
    /// millimetres farther apart than drawn. The second is that for the rates of the unknowns over the width.
    fn fill(&mut self, x: &[f64], wider: f64, rows: &mut SmallSystem);
}

/// A pose that was passed, if one was.
#[derive(Debug, Clone)]
struct PassedPose {
    passed: bool,
    wider: f64,
    x: Vec<f64>,
    rates: Vec<f64>,
}

impl PassedPose {
    /// Creates a record without a pose, for this number of unknowns.
    fn none(unknown: usize) -> PassedPose {
        PassedPose {
            passed: false,
            wider: 0.0,
            x: vec![0.0; unknown],
            rates: vec![0.0; unknown],
        }
    }

    fn put(&mut self, wider: f64, x: &[f64], rates: &[f64]) {
        self.passed = true;
        self.wider = wider;
        self.x.copy_from_slice(x);
        self.rates.copy_from_slice(rates);
    }
}

/// Current pose of a walk.
#[derive(Debug, Clone)]
pub struct Walk<E> {
    pub(in crate::synthesis) equations: E,
    rows: SmallSystem,
    /// How much farther apart the tips are than drawn, in millimetres.
    pub(in crate::synthesis) wider: f64,
    /// The unknowns: turns in rad, then the drive in mm or rad.
    pub(in crate::synthesis) x: Vec<f64>,
    /// Their rates over the width.
    pub(in crate::synthesis) rates: Vec<f64>,
    /// The pose before the current one, on the side away from the next step, and the first pose after the drawn one, if any.
    before: PassedPose,
    first: PassedPose,
    /// Bound for the last correction of the next poses, in rad. Contours are then open by about its square, and rates have about its error.
    pub(super) settled: f64,
    /// Sign of the determinant.
    sign: f64,
    trial: Vec<f64>,
    drawn_rates: Vec<f64>,
}

impl<E: FitEquations> Walk<E> {
    /// Creates a walk, not yet at any pose.
    #[must_use]
    pub fn new(equations: E) -> Walk<E> {
        let n = equations.size();
        Walk {
            equations,
            rows: SmallSystem::new(n, 2),
            wider: 0.0,
            x: vec![0.0; n],
            rates: vec![0.0; n],
            before: PassedPose::none(n),
            first: PassedPose::none(n),
            settled: SETTLED,
            sign: 0.0,
            trial: vec![0.0; n],
            drawn_rates: vec![0.0; n],
        }
    }

    /// Moves to the drawn pose. Returns false if it is singular.
    pub fn stand_drawn(&mut self) -> bool {
        self.wider = 0.0;
        self.trial.fill(0.0);
        self.sign = 0.0;
        let stands = self.correct_pose(0.0, f64::INFINITY);
        self.first.passed = false;
        self.drawn_rates.copy_from_slice(&self.rates);
        self.go_back();
        stands && self.drive_rate() != 0.0
    }

    /// Goes back to the drawn pose.
    pub fn go_back(&mut self) {
        self.wider = 0.0;
        self.x.fill(0.0);
        self.rates.copy_from_slice(&self.drawn_rates);
        let first = &self.first;
        self.before.put(first.wider, &first.x, &first.rates);
        self.before.passed = first.passed;
    }

    /// Returns the rate of the drive over the width, in mm or rad per millimetre.
    #[must_use]
    pub fn drive_rate(&self) -> f64 {
        self.rates.last().copied().unwrap_or(0.0)
    }

    fn size(&self, of: impl Fn(usize) -> f64) -> f64 {
        let sizes = (0..self.x.len()).map(|i| of(i).abs() / self.equations.radian(i));
        sizes.fold(0.0, f64::max)
    }

    /// Corrects the trial until the contours are closed at a width, and accepts it. Returns false if the first correction is more than
    /// `most`.
    fn correct_pose(&mut self, wider: f64, most: f64) -> bool {
        for n in 0..CORRECTIONS {
            (self.equations).fill(&self.trial, wider, &mut self.rows);
            let Some(sign) = self.rows.solve_all() else {
                return false;
            };
            let correction = self.size(|i| self.rows.get(i, 0));
            if n == 0 && correction > most {
                return false;
            }
            for i in 0..self.trial.len() {
                self.trial[i] -= self.rows.get(i, 0);
            }
            if correction < self.settled {
                return self.take_trial(wider, sign);
            }
        }
        false
    }

    /// Accepts the trial as the pose at a width, with its rates and the sign of the determinant. Returns false if this sign or the sign of
    /// the drive's rate has changed.
    fn take_trial(&mut self, wider: f64, sign: f64) -> bool {
        let rate = self.rows.get(self.x.len() - 1, 1);
        let same = self.sign == 0.0 || (sign == self.sign && rate * self.drive_rate() > 0.0);
        if !same || !rate.is_finite() {
            return false;
        }
        self.before.put(self.wider, &self.x, &self.rates);
        for (i, rate) in self.rates.iter_mut().enumerate() {
            *rate = self.rows.get(i, 1);
        }
        self.sign = sign;
        self.x.copy_from_slice(&self.trial);
        self.wider = wider;
        if !self.first.passed {
            self.first.put(wider, &self.x, &self.rates);
        }
        true
    }

    /// Advances until the tips are `wider` millimetres farther apart than drawn.
    ///
    /// # Errors
    /// Returns why the walk ends before, located to `finest` millimetres. The pose is the last before that end.
    ///
    /// # Complexity
    /// O(n³) for n links, for each of a few corrections per step.
    pub fn advance_to(&mut self, wider: f64, finest: f64) -> Result<(), StrokeEnd> {
        let mut step = wider - self.wider;
        while self.wider != wider {
            let left = wider - self.wider;
            let to = if step.abs() >= left.abs() {
                wider
            } else {
                self.wider + step
            };
            let by = to - self.wider;
            self.predict_pose(by);
            let most = CORRECTION * self.size(|i| by * self.rates[i]);
            if self.correct_pose(to, most) {
                step *= 2.0;
                continue;
            }
            step = by / 2.0;
            if step.abs() < finest {
                return Err(self.end());
            }
        }
        Ok(())
    }

    /// Predicts the unknowns a step farther on, and writes them to the trial.
    fn predict_pose(&mut self, by: f64) {
        let before = &self.before;
        for i in 0..self.trial.len() {
            let (x, rate) = (self.x[i], self.rates[i]);
            self.trial[i] = x + if before.passed {
                // Hermite's cubic through both poses, extrapolated by a multiple of the last step.
                let (step, gone) = (self.wider - before.wider, x - before.x[i]);
                let (then, now) = (step * before.rates[i], step * rate);
                let (u, cubic) = (by / step, then + now - 2.0 * gone);
                u * (now + u * (now - gone + (1.0 + u) * cubic))
            } else {
                by * rate
            };
        }
    }

    fn end(&self) -> StrokeEnd {
        let drawn = self.drawn_rates.last().copied().unwrap_or(0.0);
        match (self.drive_rate() / drawn).abs() {
            fast if fast > FAR => StrokeEnd::JawsTurnBack,
            slow if slow < 1.0 / FAR => StrokeEnd::DeadPoint,
            _ => StrokeEnd::Singular,
        }
    }
}
