//! A torsional drive of two discs: its bar, a swing, a programme of swings, its design, and samples of inaccurate
//! drives.
//!
//! [`driving::drive`] does all of it.
//!
//! This module computes the shares of inaccurate drives whose swings end in their latches. The quantities that decide
//! this are drawn at random: the bar's stiffness, and inertia and losses of each disc. Others are the cam's work and
//! its start, the spacing of the grooves, and the distance from them at which a latch still catches.

pub mod cam;
pub mod driving;
pub mod programme;
pub mod swing;
pub mod torsion;

use crate::drive::programme::{Endurance, Module, swings};
use crate::drive::swing::{Disc, Feed, Latch, SwingError};
use crate::model::drive::ProgrammeStep;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use rayon::prelude::*;

/// Results of the samples.
#[derive(Debug, Clone, PartialEq)]
pub struct RunShares {
    /// Maximum deviation of each quantity, as a share of the quantity.
    pub tolerance: f64,
    /// The discs that the programme releases, in order.
    pub discs: Vec<usize>,
    /// The long run of each sample.
    pub long_runs: Vec<Endurance>,
}

impl Module {
    /// Returns the drive with every quantity off by up to a share `tolerance` of itself, each uniformly and
    /// independently. The same `seed` and `n` give the same drive.
    #[must_use]
    pub fn out_of_true(&self, tolerance: f64, seed: u64, n: u64) -> Module {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(n);
        let mut out = |nominal: f64| {
            #[allow(clippy::cast_precision_loss, reason = "53 bits of a double")]
            let even = (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
            nominal * (1.0 + tolerance * (2.0 * even - 1.0))
        };
        // One bar turns both discs.
        let stiffness = out(self.discs[0].stiffness);
        Module {
            discs: self.discs.map(|d| Disc {
                inertia: out(d.inertia),
                stiffness,
                viscous: out(d.viscous),
                coulomb: out(d.coulomb),
            }),
            latch: Latch {
                at: out(self.latch.at),
                capture: out(self.latch.capture),
            },
            feed: {
                let energy = out(self.feed.energy);
                // A cam is cut in one setting, so its pieces keep their relative positions.
                let angles = out(1.0);
                let pieces = self.feed.pieces.iter();
                Feed {
                    energy,
                    pieces: pieces.map(|&(from, m)| (from * angles, m)).collect(),
                }
            },
        }
    }
}

/// Returns the long run of `samples` inaccurate drives. The same seed gives the same result, and a larger number of
/// samples begins with the smaller one.
///
/// # Errors
/// Returns an error if a sample is damped so strongly that it creeps.
///
/// # Complexity
/// As [`Module::endurance`] for each sample.
pub fn shares(
    module: &Module,
    programme: &[ProgrammeStep],
    tolerance: f64,
    samples: usize,
    seed: u64,
) -> Result<RunShares, SwingError> {
    let long_run = |n: usize| {
        let sample = module.out_of_true(tolerance, seed, n as u64);
        sample.endurance(programme)
    };
    Ok(RunShares {
        tolerance,
        discs: swings(programme),
        long_runs: (0..samples)
            .into_par_iter()
            .map(long_run)
            .collect::<Result<_, _>>()?,
    })
}

impl RunShares {
    /// Returns the number of swings latched before the first failure, for each sample that fails.
    pub fn failures(&self) -> impl Iterator<Item = usize> {
        self.long_runs.iter().filter_map(|r| match r {
            Endurance::Fails { after } => Some(*after),
            _ => None,
        })
    }

    /// Returns the number of swings of the programme, run once by each sample, that end in a latch. No swing does after
    /// a failure.
    #[must_use]
    pub fn latched(&self) -> usize {
        let (once, all) = (self.discs.len(), self.long_runs.len());
        once * all
            - self
                .failures()
                .map(|n| once.saturating_sub(n))
                .sum::<usize>()
    }

    /// Returns the number of samples that complete the programme once.
    #[must_use]
    pub fn complete(&self) -> usize {
        let failed = self.failures().filter(|n| *n < self.discs.len()).count();
        self.long_runs.len() - failed
    }

    /// Returns the number of samples that repeat the programme without end.
    #[must_use]
    pub fn lasting(&self) -> usize {
        let lasts = |r: &&Endurance| matches!(r, Endurance::Lasts { .. });
        self.long_runs.iter().filter(lasts).count()
    }
}
