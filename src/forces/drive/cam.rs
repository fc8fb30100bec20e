//! The cam that feeds a swing: its profile, derived from the swing and the spring, and the action of its electromagnet.
//!
//! The follower's roller moves in and out on a line through the disc's axis. While the disc swings from one groove to
//! the next, the electromagnet first holds the follower lifted. It is released at the start of the push. Its spring
//! then presses it on the flank, and it falls by the stroke S until it reaches the groove.
//!
//! The flank is shaped so that the spring gives the disc the moments of the simulation. The share of the spring's
//! energy given up to the turn φ equals the share of the work of these moments up to φ.

use crate::drive::programme::{Event, Run};
use crate::drive::swing::Feed;
use crate::drive::torsion::CamSpring;
use serde::{Serialize, Serializer};
use std::f64::consts::{FRAC_PI_2, TAU};

/// A cam on a disc. SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Cam {
    /// φ0. `[rad]`
    pub half_swing: f64,
    /// Work of the spring along the flank, from the middle of the swing.
    pub feed: Feed,
    /// S. `[m]`
    pub stroke: f64,
    /// ψ0.
    pub mounting: f64,
    /// Distance of the roller's centre from the axis when the follower is lifted. `[m]`
    pub radius: f64,
    /// Radius of the roller. `[m]`
    pub roller: f64,
}

/// A point of the roller's path, at a turn from the middle between two grooves.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(transparent)]
pub struct ProfilePoint {
    /// The turn. `[rad]`
    #[serde(skip)]
    pub turn: f64,
    /// Distance that the follower has fallen. `[m]`
    #[serde(skip)]
    pub fall: f64,
    /// The roller's centre. `[m]`
    pub pitch: [f64; 2],
}

/// The profile around a disc.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Profile {
    /// Angles of the grooves on the disc. `[rad]`
    pub grooves: Vec<f64>,
    /// Whether a whole number of swings makes a full turn, so that stepwise rotation never runs out of grooves.
    pub closes: bool,
    /// Whether swings in both directions are fed.
    pub both_ways: bool,
    /// Largest angle between the flank's normal and the follower's direction; a right angle if the spring ends without
    /// force. `[rad]`
    pub pressure_angle: f64,
    /// Smallest radius of curvature of the convex parts of the roller's path, at most that of the lifted path. A larger
    /// roller would undercut the flank. `[m]`
    pub least_curvature: f64,
    /// Points in order of the turn: `grooves` times the points of one swing, the first of each in a groove.
    #[serde(rename = "pitch")]
    pub points: Vec<ProfilePoint>,
    /// The contour that the roller rolls on, by the angle around the axis. None of its points is nearer to any position
    /// of the roller than its radius. In the grooves it is the roller's own arc. `[m]`
    #[serde(rename = "profile")]
    pub outline: Vec<[f64; 2]>,
}

impl Cam {
    /// Returns the pieces of the flank: start and end of each, and its share of the spring's energy per turn.
    fn pieces(&self) -> Vec<([f64; 2], f64)> {
        let shape = Feed {
            energy: 1.0,
            pieces: self.feed.pieces.clone(),
        };
        shape.moments(self.half_swing)
    }

    /// Returns the share of the spring's energy given up to a turn from the middle of the swing.
    fn part(&self, turn: f64) -> f64 {
        let given = |([from, to], rate): ([f64; 2], f64)| rate * (turn.clamp(from, to) - from);
        let part: f64 = self.pieces().into_iter().map(given).sum();
        part.clamp(0.0, 1.0)
    }

    /// Returns the distance that the follower has fallen at a turn from the middle of a swing. `[m]`
    ///
    /// Energy: (1 + ψ0)² - (1 + ψ0 - x/S)² = q (1 + 2ψ0), if the share q of it is given.
    #[must_use]
    pub fn fall(&self, turn: f64) -> f64 {
        let (whole, psi) = (1.0 + 2.0 * self.mounting, 1.0 + self.mounting);
        self.stroke * (psi - (psi * psi - self.part(turn) * whole).max(0.0).sqrt())
    }

    /// Returns the rate of the fall, per turn `[m/rad]`. It is unbounded at the end of a spring that ends without
    /// force. At the junction of two pieces it is that of the later one.
    #[must_use]
    pub fn slope(&self, turn: f64) -> f64 {
        let begun = self
            .pieces()
            .into_iter()
            .rfind(|([from, _], _)| *from <= turn);
        begun.map_or(0.0, |(_, rate)| self.slope_at(turn, rate))
    }

    /// Returns the rate of the fall at a turn, given the rate at which the spring's energy is released.
    fn slope_at(&self, turn: f64, rate: f64) -> f64 {
        if rate == 0.0 {
            return 0.0;
        }
        let (whole, psi) = (1.0 + 2.0 * self.mounting, 1.0 + self.mounting);
        let left = (psi * psi - self.part(turn) * whole).max(0.0).sqrt();
        self.stroke * whole * rate / (2.0 * left)
    }

    /// Returns the profile, with `per_swing` points from groove to groove.
    ///
    /// # Sources
    /// `[Klyuchkovskyi 1999]`: a cam with grooves on each disc, a spring-loaded roller follower; the law of the flank
    /// is left open there, and is that of a constant moment here.
    #[must_use]
    pub fn profile(&self, per_swing: u32) -> Profile {
        let (count, closes) = self.swings_a_turn();
        let mut trace = Trace::new(self);
        for swing in 0..count {
            for i in 0..per_swing {
                let turn = self.half_swing * (2.0 * f64::from(i) / f64::from(per_swing) - 1.0);
                trace.add(swing, turn, i == 0);
            }
        }
        Profile {
            outline: trace.outline(),
            grooves: (0..count)
                .map(|n| 2.0 * self.half_swing * f64::from(n))
                .collect(),
            closes,
            both_ways: trace.both_ways,
            pressure_angle: if self.mounting > 0.0 {
                trace.pressure_angle.max(self.pressure_at_ends())
            } else {
                FRAC_PI_2
            },
            least_curvature: trace.least_curvature,
            points: trace.points,
        }
    }

    /// Returns the number of whole swings in a turn of the disc, and whether they fill the turn.
    fn swings_a_turn(&self) -> (u32, bool) {
        let swings = TAU / (2.0 * self.half_swing);
        let closes = (swings - swings.round()).abs() < 1e-9 * swings;
        let whole = if closes {
            swings.round()
        } else {
            swings.floor()
        };
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "at most a few thousand swings a turn, see the reader"
        )]
        let count = whole.max(1.0) as u32;
        (count, closes)
    }

    /// Returns the largest pressure angle at the ends of pieces, where the fall is fastest.
    fn pressure_at_ends(&self) -> f64 {
        let ends = self.pieces().into_iter().map(|([_, to], rate)| {
            let last = self.slope_at(to, rate);
            (last / (self.radius - self.fall(to))).atan()
        });
        ends.fold(0.0, f64::max)
    }

    /// Returns the half of the roller in a groove that faces the axis.
    fn round(&self, [x, y]: [f64; 2]) -> impl Iterator<Item = [f64; 2]> + use<> {
        let (inwards, roller) = ((-y).atan2(-x), self.roller);
        (0..=48).map(move |k| {
            let (s, c) = (inwards + FRAC_PI_2 * (f64::from(k) / 24.0 - 1.0)).sin_cos();
            [x + roller * c, y + roller * s]
        })
    }

    /// Returns the radius of curvature of the roller's path if it is convex there; unbounded otherwise.
    fn curvature(&self, flank: f64, r: f64, dr: f64) -> f64 {
        let step = 1e-5 * self.half_swing;
        let corner = |x: &f64| (flank - x).abs() <= step;
        let ends = self.pieces().into_iter().flat_map(|(ends, _)| ends);
        let bend = if flank <= self.feed.begins() + step || { ends }.any(|x| corner(&x)) {
            0.0
        } else {
            -(self.slope(flank + step) - self.slope(flank - step)) / (2.0 * step)
        };
        let above = r * r + 2.0 * dr * dr - r * bend;
        if above > 0.0 {
            (r * r + dr * dr).powf(1.5) / above
        } else {
            f64::INFINITY
        }
    }
}

/// The roller's path during tracing, point by point.
struct Trace<'c> {
    cam: &'c Cam,
    both_ways: bool,
    points: Vec<ProfilePoint>,
    /// Points where the roller touches the disc.
    touched: Vec<[f64; 2]>,
    pressure_angle: f64,
    least_curvature: f64,
}

impl<'c> Trace<'c> {
    fn new(cam: &'c Cam) -> Trace<'c> {
        Trace {
            cam,
            // A flank that begins before the middle leaves no space for one in the other direction.
            both_ways: cam.feed.begins() >= 0.0,
            points: Vec::new(),
            touched: Vec::new(),
            pressure_angle: 0.0,
            least_curvature: cam.radius,
        }
    }

    /// Adds the point at a turn from the middle of a swing.
    fn add(&mut self, swing: u32, turn: f64, in_groove: bool) {
        let (cam, both_ways) = (self.cam, self.both_ways);
        let flank = if both_ways || in_groove {
            turn.abs()
        } else {
            turn
        };
        let (fall, slope) = (cam.fall(flank), cam.slope(flank));
        let way = if both_ways { turn.signum() } else { 1.0 };
        let (r, dr) = (cam.radius - fall, -slope * way);
        let angle = cam.half_swing * (1.0 + 2.0 * f64::from(swing)) + turn;
        let (s, c) = angle.sin_cos();
        let pitch = [r * c, r * s];
        self.points.push(ProfilePoint { turn, fall, pitch });
        if in_groove {
            self.touched.extend(cam.round(pitch));
            return;
        }
        // In one direction only, the lifted part begins next to the roller in the groove: a wall, which the roller is
        // lifted over.
        let beside = (cam.roller / (cam.radius - cam.stroke)).min(1.0).asin();
        if !both_ways && turn < cam.feed.begins() && cam.half_swing + turn <= 1.05 * beside {
            return;
        }
        let long = r.hypot(dr);
        let normal = [(r * c + dr * s) / long, (r * s - dr * c) / long];
        let touched = [0, 1].map(|k| pitch[k] - cam.roller * normal[k]);
        self.touched.push(touched);
        self.pressure_angle = self.pressure_angle.max((slope / r).atan());
        self.least_curvature = self.least_curvature.min(cam.curvature(flank, r, dr));
    }

    /// Returns the contour that the roller rolls on, by the angle around the axis.
    fn outline(&self) -> Vec<[f64; 2]> {
        // At an outward corner of the roller's path, the flanks beyond their crossing would be cut away.
        let least = (self.cam.roller * (1.0 - 1e-6)).powi(2);
        let clear = |q: &[f64; 2]| {
            let far = |p: &ProfilePoint| (p.pitch[0] - q[0]).powi(2) + (p.pitch[1] - q[1]).powi(2);
            self.points.iter().all(|p| far(p) >= least)
        };
        let mut outline: Vec<[f64; 2]> = self.touched.iter().copied().filter(clear).collect();
        let angle = |q: &[f64; 2]| q[1].atan2(q[0]);
        outline.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
        outline
    }
}

/// An interval during which the electromagnet of a disc is on. `[s]`
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Pulse {
    /// 0 or 1; displayed as 1 or 2.
    #[serde(serialize_with = "from_one")]
    pub disc: usize,
    /// Time of the release.
    pub on: f64,
    /// Start of the push, or the end of the swing if that is earlier.
    pub off: f64,
}

fn from_one<S: Serializer>(disc: &usize, serializer: S) -> Result<S::Ok, S::Error> {
    (disc + 1).serialize(serializer)
}

/// Action of the electromagnets in a programme.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Magnet {
    /// The pulses in order.
    pub pulses: Vec<Pulse>,
    /// Force against the spring when the roller leaves its groove, ψ0 c S. `[N]`
    pub first_force: f64,
    /// Force against the spring when lifted, (1 + ψ0) c S; held until the pulse ends. `[N]`
    pub last_force: f64,
    /// Work against the spring per swing, by (13). `[J]`
    pub energy_per_swing: f64,
    /// Work in a whole oscillation, two swings. `[J]`
    pub energy_per_cycle: f64,
    /// Work of all pulses over the duration of the programme. `[W]`
    pub mean_power: f64,
}

/// Returns the action of the electromagnets in a run with this spring.
#[must_use]
pub(crate) fn magnet(run: &Run, spring: &CamSpring) -> Magnet {
    let swings = run.steps.iter().filter_map(|s| match &s.event {
        Event::Swing { disc, swing } => Some((s, *disc, swing)),
        Event::Dwell => None,
    });
    let pulses: Vec<Pulse> = swings
        .map(|(s, disc, swing)| Pulse {
            disc,
            on: s.start,
            off: s.start + swing.push_begins.unwrap_or(swing.duration),
        })
        .collect();
    let time: f64 = run.steps.iter().map(|s| s.duration).sum();
    let force = |deformation: f64| spring.rate * spring.stroke * deformation;
    #[allow(clippy::cast_precision_loss, reason = "at most 10,000 steps")]
    let work = spring.energy() * pulses.len() as f64;
    Magnet {
        first_force: force(spring.mounting),
        last_force: force(1.0 + spring.mounting),
        energy_per_swing: spring.energy(),
        energy_per_cycle: 2.0 * spring.energy(),
        mean_power: if time > 0.0 { work / time } else { 0.0 },
        pulses,
    }
}
