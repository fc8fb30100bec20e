//! Two discs on a torsion bar, run through a programme of swings and dwells.

use crate::drive::swing::{Disc, End, Feed, Latch, Swing, SwingError};
use crate::model::drive::ProgrammeStep;

/// Two discs on one bar.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Module {
    /// The discs; both have the bar's stiffness.
    pub discs: [Disc; 2],
    /// The latch, equal on both sides.
    pub latch: Latch,
    /// The cam's push on a swinging disc.
    pub feed: Feed,
}

/// Outcome of a step.
#[derive(Debug, Clone, PartialEq)]
pub enum Event {
    /// A swing.
    Swing {
        /// The disc.
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
    /// Start time. `[s]`
    pub start: f64,
    /// `[s]`
    pub duration: f64,
    /// Angles of the discs at the start. `[rad]`
    pub angles: [f64; 2],
    /// The outcome.
    pub event: Event,
}

/// A programme that was run, to its end or to the first step that failed.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// The steps.
    pub steps: Vec<Ran>,
    /// Number of swings that ended in a latch.
    pub latched: usize,
    /// Number of swings in the programme.
    pub wanted: usize,
    /// Angles of the discs at the end. `[rad]`
    pub angles: [f64; 2],
}

/// Result of repeating a programme without end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Endurance {
    /// The repetitions continue, each swing caught within a bounded distance of its latch. `[rad]`
    Lasts {
        /// Largest distance from the latch in the long run.
        missing: f64,
    },
    /// A latch is missed.
    Fails {
        /// Number of latched swings before that.
        after: usize,
    },
    /// Still drifting when the limit was reached.
    Drifts {
        /// Distance from the latch at that time. `[rad]`
        missing: f64,
    },
}

/// Number of swings after which a drift is no longer followed.
pub const PATIENCE: usize = 10_000;
/// Share of φ0 below which positions count as equal.
const SAME: f64 = 1e-12;

/// The state of a run at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunMoment {
    /// `[s]`
    pub time: f64,
    /// Angles of the discs. `[rad]`
    pub angles: [f64; 2],
    /// Energy in the bar. `[J]`
    pub potential: f64,
    /// Energy of the swinging disc. `[J]`
    pub kinetic: f64,
    /// Speeds of the discs. `[rad/s]`
    pub speeds: [f64; 2],
    /// Accelerations of the discs. `[rad/s²]`
    pub accelerations: [f64; 2],
}

impl Run {
    /// Returns true if every swing ended in a latch.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.latched == self.wanted
    }

    /// Returns the swings.
    pub fn iter_swings(&self) -> impl Iterator<Item = (usize, &Swing)> {
        self.steps.iter().filter_map(|s| match &s.event {
            Event::Swing { disc, swing } => Some((*disc, swing)),
            Event::Dwell => None,
        })
    }
}

/// Returns the discs that a programme releases, in order.
#[must_use]
fn released_discs(programme: &[ProgrammeStep]) -> Vec<usize> {
    let disc = |s: &ProgrammeStep| match s {
        ProgrammeStep::Swing(disc) => Some(*disc),
        ProgrammeStep::Dwell(_) => None,
    };
    programme.iter().filter_map(disc).collect()
}

/// Positions of the discs. A disc's grooves are 2φ0 apart on it, and those of the two discs are offset by φ0. A disc at
/// rest is in the groove at φ0 times its index, or short of it within the capture of the latch.
#[derive(Debug, Clone, Copy, PartialEq)]
struct DiscAngles {
    /// Indices of the grooves, in steps of φ0; always one apart.
    places: [i32; 2],
    /// Offsets of the discs from the grooves. `[rad]`
    offsets: [f64; 2],
}

impl DiscAngles {
    /// Returns the offsets in a frame in which the second disc is ahead. A state and its mirror image continue in the
    /// same way.
    fn seen_ahead(&self) -> [f64; 2] {
        let way = f64::from(self.places[1] - self.places[0]);
        self.offsets.map(|x| way * x)
    }
}

impl Module {
    /// The discs in their grooves, with the first one step ahead.
    const START: DiscAngles = DiscAngles {
        places: [1, 0],
        offsets: [0.0; 2],
    };

    fn disc_angles(&self, now: &DiscAngles) -> [f64; 2] {
        [0, 1].map(|d| f64::from(now.places[d]) * self.latch.at + now.offsets[d])
    }

    /// Lets a disc swing to its next groove on the far side of the other disc, and updates its position.
    ///
    /// The latch and the cam's push are fixed to the disc's own grooves, however far either disc is from its groove. So
    /// shortfalls add up.
    fn swing_disc(&self, now: &mut DiscAngles, disc: usize) -> Result<Swing, SwingError> {
        let other = 1 - disc;
        let onward = now.places[other] - now.places[disc];
        let way = f64::from(onward);
        let [own, neutral] = [disc, other].map(|d| way * now.offsets[d]);
        let latch = Latch {
            at: self.latch.at - neutral,
            ..self.latch
        };
        let feed = Feed {
            from: self.feed.from - neutral,
            ..self.feed
        };
        let start = self.latch.at - own + neutral;
        let swing = self.discs[disc].swing_from(start, latch, feed)?;
        now.places[disc] += 2 * onward;
        now.offsets[disc] = way * (swing.place - latch.at);
        Ok(swing)
    }

    /// Runs a programme from rest, with the first disc turned φ0 ahead of the second.
    ///
    /// # Guarantee
    /// Exact, see [`Disc::swing_from`]; latched discs do not move. A disc that the latch catches short of its groove stays
    /// there.
    ///
    /// # Errors
    /// Returns an error if the discs do not swing.
    pub fn run_programme(&self, programme: &[ProgrammeStep]) -> Result<Run, SwingError> {
        let wanted = released_discs(programme).len();
        let mut now = Self::START;
        let mut run = Run {
            steps: Vec::new(),
            latched: 0,
            wanted,
            angles: self.disc_angles(&now),
        };
        let mut time = 0.0;
        for step in programme {
            let angles = run.angles;
            let (duration, event) = match *step {
                ProgrammeStep::Dwell(length) => (length, Event::Dwell),
                ProgrammeStep::Swing(disc) => {
                    let swing = self.swing_disc(&mut now, disc)?;
                    run.angles = self.disc_angles(&now);
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

    /// Repeats a programme as written until a round leaves the discs in the state of an earlier round, or a latch is
    /// missed.
    ///
    /// Rounds are compared with a marked one, and the mark moves after 1, 2, 4, ... rounds [Brent 1980]. So swings that
    /// repeat only after several rounds are recognised, and a slow drift is not mistaken for rest.
    ///
    /// # Errors
    /// Returns an error in the same cases as [`Module::run_programme`].
    ///
    /// # Complexity
    /// At most [`PATIENCE`] swings, and those of one more round.
    pub fn run_endlessly(&self, programme: &[ProgrammeStep]) -> Result<Endurance, SwingError> {
        let discs = released_discs(programme);
        if discs.is_empty() {
            return Ok(Endurance::Lasts { missing: 0.0 });
        }
        let mut now = Self::START;
        let mut marked = (now.seen_ahead(), 0.0f64);
        let (mut latched, mut until, mut since) = (0, 1, 0);
        while latched < PATIENCE {
            for &disc in &discs {
                let swing = self.swing_disc(&mut now, disc)?;
                if matches!(swing.end, End::Missed { .. } | End::Stuck) {
                    return Ok(Endurance::Fails { after: latched });
                }
                latched += 1;
                marked.1 = marked.1.max(now.offsets[disc].abs());
            }
            let after = now.seen_ahead();
            let still = |d: usize| (after[d] - marked.0[d]).abs() <= SAME * self.latch.at;
            if still(0) && still(1) {
                return Ok(Endurance::Lasts { missing: marked.1 });
            }
            since += 1;
            if since == until {
                marked = (after, 0.0);
                (until, since) = (2 * until, 0);
            }
        }
        let missing = now.offsets[0].abs().max(now.offsets[1].abs());
        Ok(Endurance::Drifts { missing })
    }

    /// Returns the run at `per_swing` times per swing, for charts.
    #[must_use]
    pub fn sample_run(&self, run: &Run, per_swing: u32) -> Vec<RunMoment> {
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
                let (mut speeds, mut accelerations) = ([0.0; 2], [0.0; 2]);
                if let Event::Swing { disc, swing } = &step.event {
                    let ahead = (angles[*disc] - angles[1 - disc]).signum();
                    let (u, v) = swing.position_at(t);
                    angles[*disc] = angles[1 - disc] - ahead * u;
                    kinetic = self.discs[*disc].inertia * v * v / 2.0;
                    speeds[*disc] = -ahead * v;
                    accelerations[*disc] = -ahead * swing.acceleration_at(t);
                }
                let twist = angles[0] - angles[1];
                let potential = self.discs[0].stiffness * twist * twist / 2.0;
                out.push(RunMoment {
                    time: step.start + t,
                    angles,
                    potential,
                    kinetic,
                    speeds,
                    accelerations,
                });
            }
        }
        out
    }
}
