//! Shares of parts out of true that contacts hold.

use crate::grip::clamped_part::ClampedPart;
use crate::grip::force_closure::is_closed;
use crate::statics::reactions::Unsolved;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::SeedableRng;

/// How many samples have closure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClosureShares {
    /// How many there were.
    pub samples: usize,
    /// By how much points and rims are out at most `[m]`.
    pub tolerance: f64,
    /// With force closure.
    pub force_closed: usize,
    /// With form closure.
    pub form_closed: usize,
    /// Of which force closure is within the accuracy of the programmes.
    pub force_undecided: usize,
    /// Of which form closure is.
    pub form_undecided: usize,
}

/// Closure of a part with its contacts out by up to `tolerance` `[m]`, `samples` times; the same seed gives the same answer.
///
/// # Errors
/// Where the solver refuses a programme; one that it stalls at leaves a sample undecided.
pub fn shares(
    part: &ClampedPart,
    tolerance: f64,
    samples: usize,
    seed: u64,
) -> Result<ClosureShares, Unsolved> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut out = ClosureShares {
        samples,
        tolerance,
        force_closed: 0,
        form_closed: 0,
        force_undecided: 0,
        form_undecided: 0,
    };
    for _ in 0..samples {
        let sample = part.out_of_true(tolerance / part.geometry.size, &mut random);
        let force = is_closed(&sample, &sample.faces)?;
        let form = is_closed(&sample, &sample.smooth())?;
        out.force_closed += usize::from(force == Some(true));
        out.form_closed += usize::from(form == Some(true));
        out.force_undecided += usize::from(force.is_none());
        out.form_undecided += usize::from(form.is_none());
    }
    Ok(out)
}
