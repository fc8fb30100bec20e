//! One swing of a released disc, exact piece by piece: a damped oscillation about an equilibrium that dry friction and the cam shift.
//!
//! The disc starts at rest at -A from the neutral position and moves towards the latch at +φ0; `u` is its increasing position.

use serde::Serialize;
use std::f64::consts::PI;
use thiserror::Error;

/// A disc on a torsion bar. SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disc {
    /// I. `[kg·m²]`
    pub inertia: f64,
    /// k. `[N·m/rad]`
    pub stiffness: f64,
    /// Moment per speed, for example of bearings in oil and of air. `[N·m·s/rad]`
    pub viscous: f64,
    /// Moment of constant size against the motion, for example of dry bearings. `[N·m]`
    pub coulomb: f64,
}

/// The cam's push: a constant moment from a position to the latch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Feed {
    /// Its work. `[J]`
    pub energy: f64,
    /// The position at its beginning. `[rad]`
    pub from: f64,
}

impl Feed {
    /// Creates a push without work, which moves nothing.
    pub const NONE: Feed = Feed {
        energy: 0.0,
        from: 0.0,
    };

    /// Returns the moment up to a latch, or `None` if no work is fed before it. `[N·m]`
    #[must_use]
    pub fn push_moment(&self, latch: f64) -> Option<f64> {
        (self.energy > 0.0 && self.from < latch).then(|| self.energy / (latch - self.from))
    }
}

/// The latch at the far end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Latch {
    /// φ0, distance from the neutral position. `[rad]`
    pub at: f64,
    /// Maximum distance from the latch at which a stopped disc is caught. `[rad]`
    pub capture: f64,
}

/// End of a swing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum End {
    /// At the latch, which stops the remaining speed. `[J]`
    Latched {
        /// Kinetic energy on arrival.
        impact: f64,
    },
    /// At rest, short of the latch and within its capture. `[rad]`
    Caught {
        /// Distance from the latch.
        missing: f64,
    },
    /// At rest and outside the latch's capture, so that it will swing back. `[rad]`
    Missed {
        /// Distance from the latch.
        missing: f64,
    },
    /// Friction is stronger than the bar at the start.
    Stuck,
}

impl Latch {
    /// Returns the end of a swing that comes to rest short of the latch.
    fn of_rest(self, place: f64) -> End {
        let missing = self.at - place;
        if missing <= self.capture {
            End::Caught { missing }
        } else {
            End::Missed { missing }
        }
    }
}

/// Reason why a disc does not swing.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum SwingError {
    /// Damped at or beyond the critical rate.
    #[error(
        "the damping ratio is {0:.3}; at 1 and above the disc creeps and does not swing; lower the viscous damping"
    )]
    Overdamped(f64),
    /// The values do not describe a disc.
    #[error("inertia and stiffness must be positive, and the damping must not be negative")]
    Disc,
}

/// An interval of motion under constant moments.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Piece {
    start: f64,
    length: f64,
    /// Equilibrium position.
    middle: f64,
    /// Position relative to it and speed, at the start.
    from: (f64, f64),
}

/// Energy balance of a swing. `[J]`
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Balance {
    /// Energy in the bar at the start.
    pub initial: f64,
    /// Energy from the cam.
    pub fed: f64,
    /// Energy lost to dry friction.
    pub coulomb: f64,
    /// Energy lost to viscous damping, integrated over the motion.
    pub viscous: f64,
    /// Energy lost in the latch.
    pub impact: f64,
    /// Energy in the bar at the end.
    pub stored: f64,
}

impl Balance {
    /// Returns the residual of the balance, which is only rounding.
    #[must_use]
    pub fn residual(&self) -> f64 {
        self.initial + self.fed - self.coulomb - self.viscous - self.impact - self.stored
    }
}

/// A swing from -A to its end.
#[derive(Debug, Clone, PartialEq)]
pub struct Swing {
    disc: Disc,
    pieces: Vec<Piece>,
    /// The end of the swing.
    pub end: End,
    /// `[s]`
    pub duration: f64,
    /// Time at which the cam's push begins, if it does. `[s]`
    pub push_begins: Option<f64>,
    /// End position. `[rad]`
    pub place: f64,
    /// Energy balance.
    pub balance: Balance,
}

impl Disc {
    fn decay_rates(&self) -> (f64, f64, f64) {
        let (decay, square) = (
            self.viscous / (2.0 * self.inertia),
            self.stiffness / self.inertia,
        );
        (decay, square, (square - decay * decay).sqrt())
    }

    /// Returns ζ, the damping relative to the critical one.
    #[must_use]
    pub fn damping_ratio(&self) -> f64 {
        self.viscous / (2.0 * (self.stiffness * self.inertia).sqrt())
    }

    /// Returns the viscous damping with which a free swing from `twist` ends `missing` short, without dry friction. `[N·m·s/rad]`
    ///
    /// # Examples
    /// ```
    /// use ozols::drive::swing::Disc;
    /// let viscous = Disc::viscous_for(1.0, 100.0, 0.5, 0.02);
    /// let disc = Disc { inertia: 1.0, stiffness: 100.0, viscous, coulomb: 0.0 };
    /// assert!((disc.missing_angle(0.5) - 0.02).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn viscous_for(inertia: f64, stiffness: f64, twist: f64, missing: f64) -> f64 {
        let delta = (twist / (twist - missing)).ln();
        2.0 * (stiffness * inertia).sqrt() * delta / (PI * PI + delta * delta).sqrt()
    }

    /// Returns the distance by which a swing without the cam ends short of the start's mirror image, in closed form. `[rad]`
    ///
    /// # Examples
    /// ```
    /// use ozols::drive::swing::Disc;
    /// let disc = Disc { inertia: 1.0, stiffness: 100.0, viscous: 0.0, coulomb: 1.0 };
    /// // Dry friction shifts the middle by 0.01 rad: twice that is missing.
    /// assert!((disc.missing_angle(0.5) - 0.02).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn missing_angle(&self, twist: f64) -> f64 {
        let (decay, _, turning) = self.decay_rates();
        let shift = self.coulomb / self.stiffness;
        let left = (twist - shift) * (-decay * PI / turning).exp();
        (twist - (left - shift)).clamp(0.0, 2.0 * twist)
    }

    /// Returns an error if the disc does not swing.
    fn check_disc(&self) -> Result<(), SwingError> {
        let positive = self.inertia > 0.0
            && self.stiffness > 0.0
            && self.inertia.is_finite()
            && self.stiffness.is_finite();
        if !(positive && self.viscous >= 0.0 && self.coulomb >= 0.0) {
            return Err(SwingError::Disc);
        }
        if self.damping_ratio() >= 1.0 {
            return Err(SwingError::Overdamped(self.damping_ratio()));
        }
        Ok(())
    }

    /// Swings from rest at `-start`.
    ///
    /// # Units
    /// SI, `[rad]`.
    ///
    /// # Guarantee
    /// Positions, speeds and the times of stopping are closed forms. The times of passing a position are found to the last bit, so that
    /// [`Balance::residual`] is only rounding.
    ///
    /// # Errors
    /// Returns an error if the disc does not swing.
    ///
    /// # Examples
    /// ```
    /// use ozols::drive::swing::{Disc, End, Feed, Latch};
    /// let disc = Disc { inertia: 1.0, stiffness: 100.0, viscous: 0.0, coulomb: 0.0 };
    /// let latch = Latch { at: 0.5, capture: 0.01 };
    /// // Without losses it swings to the latch in half a period, π / 10 s.
    /// let swing = disc.swing_from(0.5, latch, Feed::NONE)?;
    /// assert!(matches!(swing.end, End::Latched { .. }));
    /// assert!((swing.duration - std::f64::consts::PI / 10.0).abs() < 1e-6);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn swing_from(&self, start: f64, latch: Latch, feed: Feed) -> Result<Swing, SwingError> {
        self.check_disc()?;
        let (mut u, mut v, mut t) = (-start, 0.0, 0.0);
        let mut pieces = Vec::new();
        let mut balance = Balance {
            initial: self.stiffness * start * start / 2.0,
            ..Balance::default()
        };
        let (mut arrived, mut push_begins) = (false, None);
        let pushed = feed.push_moment(latch.at);
        let before = pushed.map_or(latch.at, |_| feed.from);
        for (bound, moment) in [(before, 0.0), (latch.at, pushed.unwrap_or(0.0))] {
            if u >= bound {
                continue;
            }
            let middle = (moment - self.coulomb) / self.stiffness;
            // At rest, the bar must be stronger than friction; a stopped disc stays at rest.
            if v <= 0.0 && u >= middle {
                break;
            }
            if moment > 0.0 {
                push_begins.get_or_insert(t);
            }
            let piece = self.trace_piece(t, u, v, middle, bound);
            let (end, speed) = self.state_at(&piece, piece.length);
            arrived = end >= bound;
            let end = end.min(bound);
            balance.coulomb += self.coulomb * (end - u);
            balance.fed += moment * (end - u);
            balance.viscous += self.viscous * self.speed_squared(&piece);
            t += piece.length;
            pieces.push(piece);
            (u, v) = (end, if arrived { speed.max(0.0) } else { 0.0 });
            if !arrived {
                break;
            }
        }
        let end = match (pieces.is_empty(), arrived && u >= latch.at) {
            (true, _) => End::Stuck,
            (false, true) => {
                balance.impact = self.inertia * v * v / 2.0;
                End::Latched {
                    impact: balance.impact,
                }
            }
            (false, false) => latch.of_rest(u),
        };
        balance.stored = self.stiffness * u * u / 2.0;
        Ok(Swing {
            disc: *self,
            pieces,
            end,
            duration: t,
            push_begins,
            place: u,
            balance,
        })
    }

    /// Returns the motion from a position and speed until it stops or passes `bound`.
    fn trace_piece(&self, start: f64, u: f64, v: f64, middle: f64, bound: f64) -> Piece {
        let (decay, square, turning) = self.decay_rates();
        let y = u - middle;
        let stop = if v > 0.0 {
            (v * turning).atan2(square * y + decay * v)
        } else {
            PI
        } / turning;
        let mut piece = Piece {
            start,
            length: stop,
            middle,
            from: (y, v),
        };
        if self.state_at(&piece, stop).0 > bound {
            // The position increases until the stop, so there is one crossing. The interval is halved to the precision of floats.
            let (mut before, mut after) = (0.0, stop);
            loop {
                let half = 0.5 * (before + after);
                if half <= before || half >= after {
                    break;
                }
                if self.state_at(&piece, half).0 >= bound {
                    after = half
                } else {
                    before = half
                }
            }
            piece.length = after;
        }
        piece
    }

    /// Returns position and speed at a time into a piece.
    fn state_at(&self, p: &Piece, t: f64) -> (f64, f64) {
        let (decay, square, turning) = self.decay_rates();
        let (y, v) = p.from;
        let (s, c) = (turning * t).sin_cos();
        let fade = (-decay * t).exp();
        let place = fade * (y * c + (v + decay * y) / turning * s);
        let speed = fade * (v * c - (square * y + decay * v) / turning * s);
        (p.middle + place, speed)
    }

    /// Returns the integral of the square of the speed over a piece.
    fn speed_squared(&self, p: &Piece) -> f64 {
        let (decay, square, turning) = self.decay_rates();
        let (y, v) = p.from;
        let (cosine, sine) = (v, -(square * y + decay * v) / turning);
        // Integrals of e^(-at), e^(-at) cos bt and e^(-at) sin bt.
        let (a, b, t) = (2.0 * decay, 2.0 * turning, p.length);
        let fade = (-a * t).exp();
        let (s, c) = (b * t).sin_cos();
        let plain = if a * t > 1e-12 {
            -(-a * t).exp_m1() / a
        } else {
            t
        };
        let norm = a * a + b * b;
        let with_cosine = (a + fade * (b * s - a * c)) / norm;
        let with_sine = (b - fade * (a * s + b * c)) / norm;
        (cosine * cosine + sine * sine) / 2.0 * plain
            + (cosine * cosine - sine * sine) / 2.0 * with_cosine
            + cosine * sine * with_sine
    }

    /// Returns the smallest work of a push `from` a position with which a swing from `-latch.at` reaches the latch, at
    /// rest. Returns `None` if no work is enough, because the disc is stuck or stops before the push begins. `[J]`
    ///
    /// # Errors
    /// Returns an error in the same cases as [`Disc::swing_from`].
    ///
    /// # Examples
    /// ```
    /// use ozols::drive::swing::{Disc, Latch};
    /// let disc = Disc { inertia: 1.0, stiffness: 100.0, viscous: 0.0, coulomb: 1.0 };
    /// let needed = disc.needed_feed(Latch { at: 0.5, capture: 0.0 }, 0.0)?;
    /// // The friction of 1 N·m over the whole swing of 1 rad.
    /// assert!(needed.is_some_and(|energy| (energy - 1.0).abs() < 1e-3));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn needed_feed(&self, latch: Latch, from: f64) -> Result<Option<f64>, SwingError> {
        let arrives = |energy: f64| -> Result<bool, SwingError> {
            let swing = self.swing_from(latch.at, latch, Feed { energy, from })?;
            Ok(matches!(swing.end, End::Latched { .. }))
        };
        if arrives(0.0)? {
            return Ok(Some(0.0));
        }
        let (mut less, mut enough) = (0.0, self.stiffness * latch.at * latch.at);
        for _ in 0..60 {
            if arrives(enough)? {
                break;
            }
            enough *= 2.0;
        }
        if !arrives(enough)? {
            return Ok(None);
        }
        loop {
            let half = 0.5 * (less + enough);
            if half <= less || half >= enough {
                return Ok(Some(enough));
            }
            if arrives(half)? {
                enough = half
            } else {
                less = half
            }
        }
    }
}

impl Swing {
    /// Returns the acceleration at a time from the release, which is 0 at its end. `[rad/s²]`
    #[must_use]
    pub fn acceleration_at(&self, time: f64) -> f64 {
        let now = self.pieces.iter().find(|p| time <= p.start + p.length);
        now.map_or(0.0, |p| {
            let (place, speed) = self.disc.state_at(p, (time - p.start).max(0.0));
            let moment = -self.disc.stiffness * (place - p.middle) - self.disc.viscous * speed;
            moment / self.disc.inertia
        })
    }

    /// Returns position and speed at a time from the release. Afterwards the disc is at rest at its end.
    #[must_use]
    pub fn position_at(&self, time: f64) -> (f64, f64) {
        let now = self.pieces.iter().find(|p| time <= p.start + p.length);
        match now {
            Some(p) => self.disc.state_at(p, (time - p.start).max(0.0)),
            None => (self.place, 0.0),
        }
    }
}
