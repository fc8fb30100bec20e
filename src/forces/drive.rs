//! A torsional drive of two discs: its bar, a swing, a programme of swings, its design, and samples of it out of true.
//!
//! [`driving::drive`] does all of it.
//!
//! The shares of drives out of true whose swings end in their latches stand here. What decides that is drawn: the bar's stiffness,
//! inertia and losses of each disc, the cam's work and where it begins, the spacing of the grooves and how far short of them a latch
//! still catches.

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

/// What became of samples.
#[derive(Debug, Clone, PartialEq)]
pub struct RunShares {
    /// By how much each quantity is out at most, as a share of itself.
    pub tolerance: f64,
    /// The discs that the programme lets go, in order.
    pub discs: Vec<usize>,
    /// The long run of each sample.
    pub long_runs: Vec<Endurance>,
}

impl Module {
    /// The drive with every quantity out by up to a share `tolerance` of itself, each evenly and by itself; the same `seed` and
    /// `n` give the same drive.
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
                // One cam is cut in one setting: its pieces keep to each other.
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

/// The long run of `samples` drives out of true; the same seed gives the same answer, and more samples begin with the fewer.
///
/// # Errors
/// A sample that is damped so that it creeps.
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
    /// The swings latched before the first failure of each sample that fails.
    pub fn failures(&self) -> impl Iterator<Item = usize> {
        self.long_runs.iter().filter_map(|r| match r {
            Endurance::Fails { after } => Some(*after),
            _ => None,
        })
    }

    /// How many swings of the programme, run once by each sample, end in a latch; none does after a failure.
    #[must_use]
    pub fn latched(&self) -> usize {
        let (once, all) = (self.discs.len(), self.long_runs.len());
        once * all
            - self
                .failures()
                .map(|n| once.saturating_sub(n))
                .sum::<usize>()
    }

    /// How many samples end the programme run once.
    #[must_use]
    pub fn complete(&self) -> usize {
        let failed = self.failures().filter(|n| *n < self.discs.len()).count();
        self.long_runs.len() - failed
    }

    /// How many samples repeat the programme without end.
    #[must_use]
    pub fn lasting(&self) -> usize {
        let lasts = |r: &&Endurance| matches!(r, Endurance::Lasts { .. });
        self.long_runs.iter().filter(lasts).count()
    }
}
