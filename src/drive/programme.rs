//! Two discs on a torsion bar, run through a programme of swings and dwells.

use crate::drive::swing::{Disc, End, Feed, Latch, Swing, SwingError};
use crate::model::drive::Step;

/// Two discs on one bar.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Module {
    /// The discs; both have the bar's stiffness.
    pub discs: [Disc; 2],
    /// The latch, alike on both sides.
    pub latch: Latch,
    /// The cam's push on a swinging disc.
    pub feed: Feed,
}

/// What became of a step.
#[derive(Debug, Clone, PartialEq)]
pub enum Event {
    /// A swing.
    Swing {
        /// Which disc.
        disc: usize,
        /// The motion.
        swing: Swing,
    },
    /// A dwell.
    Dwell,
}

/// A step that was run.
#[derive(Debug, Clone, PartialEq)]
pub struct Ran {
    /// When it began. `[s]`
    pub start: f64,
    /// `[s]`
    pub duration: f64,
    /// Angles of the discs when it began. `[rad]`
    pub angles: [f64; 2],
    /// What happened.
    pub event: Event,
}

/// A programme that was run, to its end or to the first step that failed.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// The steps.
    pub steps: Vec<Ran>,
    /// How many swings ended in a latch.
    pub latched: usize,
    /// How many swings were asked for.
    pub wanted: usize,
    /// Angles of the discs at the end. `[rad]`
    pub angles: [f64; 2],
}

/// What comes of swings without end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Endurance {
    /// They go on, each caught this far short of its latch. `[rad]`
    Lasts {
        /// How far short, in the long run.
        missing: f64,
    },
    /// A latch is missed.
    Fails {
        /// After so many swings that were latched.
        after: usize,
    },
    /// Still drifting when counting stopped.
    Drifts {
        /// How far short by then. `[rad]`
        missing: f64,
    },
}

/// Swings after which a drift is no longer followed.
pub const PATIENCE: usize = 10_000;

/// A moment of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// `[s]`
    pub time: f64,
    /// Angles of the discs. `[rad]`
    pub angles: [f64; 2],
    /// In the bar. `[J]`
    pub potential: f64,
    /// Of the swinging disc. `[J]`
    pub kinetic: f64,
}

impl Run {
    /// Whether every swing ended in a latch.
    #[must_use]
    pub fn complete(&self) -> bool {
        self.latched == self.wanted
    }

    /// The swings.
    pub fn swings(&self) -> impl Iterator<Item = (usize, &Swing)> {
        self.steps.iter().filter_map(|s| match &s.event {
            Event::Swing { disc, swing } => Some((*disc, swing)),
            Event::Dwell => None,
        })
    }
}

impl Module {
    /// Runs a programme from rest, with the first disc turned φ0 ahead of the second.
    ///
    /// # Guarantee
    /// Exact, see [`Disc::swing`]; latched discs do not move.
    ///
    /// # Errors
    /// Discs that do not swing.
    pub fn run(&self, programme: &[Step]) -> Result<Run, SwingError> {
        let wanted = programme
            .iter()
            .filter(|s| matches!(s, Step::Swing(_)))
            .count();
        let mut run = Run {
            steps: Vec::new(),
            latched: 0,
            wanted,
            angles: [self.latch.at, 0.0],
        };
        let mut time = 0.0;
        for step in programme {
            let angles = run.angles;
            let (duration, event) = match *step {
                Step::Dwell(length) => (length, Event::Dwell),
                Step::Swing(disc) => {
                    let ahead = angles[disc] - angles[1 - disc];
                    let swing = self.discs[disc].swing(ahead.abs(), self.latch, self.feed)?;
                    run.angles[disc] = angles[1 - disc] - ahead.signum() * swing.place;
                    (swing.duration, Event::Swing { disc, swing })
                }
            };
            let failed = match &event {
                Event::Swing { swing, .. } => matches!(swing.end, End::Missed { .. } | End::Stuck),
                Event::Dwell => false,
            };
            run.latched += usize::from(matches!(event, Event::Swing { .. }) && !failed);
            run.steps.push(Ran {
                start: time,
                duration,
                angles,
                event,
            });
            time += duration;
            if failed {
                break;
            }
        }
        Ok(run)
    }

    /// Lets the discs named take turns until their swings repeat or a latch is missed.
    ///
    /// # Errors
    /// As [`Module::run`].
    pub fn endurance(&self, discs: &[usize]) -> Result<Endurance, SwingError> {
        let (mut place, mut missing) = (self.latch.at, vec![f64::NAN; discs.len().max(1)]);
        for (n, &disc) in discs.iter().cycle().take(PATIENCE).enumerate() {
            let swing = self.discs[disc].swing(place, self.latch, self.feed)?;
            if matches!(swing.end, End::Missed { .. } | End::Stuck) {
                return Ok(Endurance::Fails { after: n });
            }
            place = swing.place;
            let turn = n % missing.len();
            let before = std::mem::replace(&mut missing[turn], self.latch.at - place);
            if (missing[turn] - before).abs() <= 1e-12 * self.latch.at {
                return Ok(Endurance::Lasts {
                    missing: missing[turn],
                });
            }
        }
        Ok(Endurance::Drifts {
            missing: self.latch.at - place,
        })
    }

    /// The run at moments `per_swing` to a swing, for charts.
    #[must_use]
    pub fn samples(&self, run: &Run, per_swing: u32) -> Vec<Sample> {
        let mut out = Vec::new();
        for step in &run.steps {
            let count = if matches!(step.event, Event::Dwell) {
                1
            } else {
                per_swing
            };
            for i in 0..=count {
                let t = step.duration * f64::from(i) / f64::from(count);
                let mut angles = step.angles;
                let mut kinetic = 0.0;
                if let Event::Swing { disc, swing } = &step.event {
                    let ahead = (angles[*disc] - angles[1 - disc]).signum();
                    let (u, v) = swing.at(t);
                    angles[*disc] = angles[1 - disc] - ahead * u;
                    kinetic = self.discs[*disc].inertia * v * v / 2.0;
                }
                let twist = angles[0] - angles[1];
                let potential = self.discs[0].stiffness * twist * twist / 2.0;
                out.push(Sample {
                    time: step.start + t,
                    angles,
                    potential,
                    kinetic,
                });
            }
        }
        out
    }
}
