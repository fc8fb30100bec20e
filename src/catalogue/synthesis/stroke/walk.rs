//! From the drawn pose step by step to wider and narrower parts, by Newton's method.
//!
//! A step begins along the cubic that the last two poses and their rates tell. It is halved where the first correction is large beside it, where
//! the determinant changes its sign, or where the drive would turn back: so no step passes a singular pose or a dead point unseen.

use crate::synthesis::elimination::SmallSystem;

/// Corrections of a step at most.
const CORRECTIONS: usize = 6;
/// The first correction over its step at most.
const CORRECTION: f64 = 0.25;
/// The last correction of a pose whose figures are told is smaller than this, in rad.
pub(in crate::synthesis) const SETTLED: f64 = 1e-8;
/// So many millimetres count as a radian of a link.
pub(in crate::synthesis) const RADIAN: f64 = 50.0;
/// A drive that is so many times faster by the width than in the drawn pose is near to where the jaws turn back; one that is
/// so many times slower, to a dead point.
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
    /// Word for data.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            StrokeEnd::JawsTurnBack => "jaws-turn-back",
            StrokeEnd::DeadPoint => "dead-point",
            StrokeEnd::Singular => "singular",
        }
    }

    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            StrokeEnd::JawsTurnBack => "there the jaws turn back while the drive goes on",
            StrokeEnd::DeadPoint => "there the drive turns back",
            StrokeEnd::Singular => "there the links lock",
        }
    }
}

/// The equations that hold where the links fit together and the tips are so far apart; the drive is the last unknown.
pub trait FitEquations {
    /// How many there are, and how many unknown.
    fn size(&self) -> usize;

    /// How many of an unknown count as a radian of a link, when steps and corrections are compared.
    fn radian(&self, unknown: usize) -> f64;

    /// By how much they miss when the unknown are `x` and the tips are to be so many millimetres farther apart than drawn, in the
    /// first right side, with the rates of that; in the second what makes the rates by the width.
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
    /// None, of so many unknown.
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

/// A pose on the way.
#[derive(Debug, Clone)]
pub struct Walk<E> {
    pub(in crate::synthesis) equations: E,
    rows: SmallSystem,
    /// How much farther apart the tips are than drawn, in millimetres.
    pub(in crate::synthesis) wider: f64,
    /// The unknown: turns in rad, then the drive in mm or rad.
    pub(in crate::synthesis) x: Vec<f64>,
    /// Their rates by the width.
    pub(in crate::synthesis) rates: Vec<f64>,
    /// The pose on the other side from where it goes on, and the first that was come to from the drawn one; where there are any.
    before: PassedPose,
    first: PassedPose,
    /// The last correction of the next poses is smaller than this, in rad: after it contours are open by about its square, and rates
    /// are as far from true as it says.
    pub(super) settled: f64,
    /// Sign of the determinant.
    sign: f64,
    trial: Vec<f64>,
    drawn_rates: Vec<f64>,
}

impl<E: FitEquations> Walk<E> {
    /// Room for walks.
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

    /// Stands at the drawn pose; `false` where that is singular.
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

    /// How fast the drive goes by the width: mm or rad a millimetre.
    #[must_use]
    pub fn drive_rate(&self) -> f64 {
        self.rates.last().copied().unwrap_or(0.0)
    }

    fn size(&self, of: impl Fn(usize) -> f64) -> f64 {
        let sizes = (0..self.x.len()).map(|i| of(i).abs() / self.equations.radian(i));
        sizes.fold(0.0, f64::max)
    }

    /// Closes the contours at a width from the trial, and takes it where the first correction is at most `most`.
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

    /// Takes the trial for the pose at a width, with the rates and the sign of the determinant found there; not where one of these has
    /// changed its sign.
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

    /// Goes on until the tips are so much farther apart than drawn.
    ///
    /// # Errors
    /// Why it ends before, nearer to that end than `finest` millimetres; the pose is the last.
    ///
    /// # Complexity
    /// O(n³) for n links, for each of some corrections a step.
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

    /// Puts into the trial where the unknown are likely to be so much farther on.
    fn predict_pose(&mut self, by: f64) {
        let before = &self.before;
        for i in 0..self.trial.len() {
            let (x, rate) = (self.x[i], self.rates[i]);
            self.trial[i] = x + if before.passed {
                // Hermite's cubic through both, by how many of the last step it goes on.
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
