//! The cam of a drive: what it gives, its spring, its electromagnets and its profile.

use crate::drive::cam;
use crate::drive::driving::CamDesign;
use crate::drive::programme::Module;
use crate::drive::torsion::CamSpring;
use serde::Serialize;

/// A piece of the cam's push.
#[derive(Debug, Serialize)]
pub struct FeedMoment {
    /// Where it begins, from the middle of the swing `[rad]`.
    pub from: f64,
    /// `[N·m]`
    pub moment: f64,
}

/// The pieces of the push of a drive, each up to the next and the last up to the latch; none where nothing is fed.
#[must_use]
pub(crate) fn feed_moments(module: &Module) -> Vec<FeedMoment> {
    let pieces = module.feed.moments(module.latch.at).into_iter();
    let piece = |([from, _], moment): ([f64; 2], f64)| FeedMoment { from, moment };
    pieces.map(piece).collect()
}

/// The cam: its spring by equation (14), and by the simulation where any is enough; its electromagnets and its profile.
#[derive(Debug, Serialize)]
pub struct CamData {
    /// By the equation.
    pub spring: Spring,
    /// By the simulation.
    pub needed: Option<Spring>,
    /// For what is fed in this run.
    pub fitted: Spring,
    /// What the electromagnets do against that one.
    pub electromagnet: Electromagnet,
    /// The profile, where the cam's and the roller's radius are stated.
    pub profile: Option<Profile>,
}

/// What the electromagnets do.
#[derive(Debug, Serialize)]
pub struct Electromagnet {
    /// When each is on.
    pub pulses: Vec<Pulse>,
    /// Against the spring as the roller leaves its groove `[N]`.
    pub first_force: f64,
    /// When lifted `[N]`.
    pub last_force: f64,
    /// A swing `[J]`.
    pub energy_per_swing: f64,
    /// A whole oscillation, two swings `[J]`.
    pub energy_per_cycle: f64,
    /// Over the programme `[W]`.
    pub mean_power: f64,
}

/// A time in which an electromagnet is on.
#[derive(Debug, Serialize)]
pub struct Pulse {
    /// 1 or 2.
    pub disc: usize,
    /// `[s]`
    pub on: f64,
    /// `[s]`
    pub off: f64,
}

/// The profile of the cam.
#[derive(Debug, Serialize)]
pub struct Profile {
    /// Angles of the grooves on the disc `[rad]`.
    pub grooves: Vec<f64>,
    /// Whether a whole number of swings makes a turn.
    pub closes: bool,
    /// Whether swings either way are fed.
    pub both_ways: bool,
    /// Greatest pressure angle `[rad]`.
    pub pressure_angle: f64,
    /// Least radius of curvature where it bulges `[m]`.
    pub least_curvature: f64,
    /// The roller's centre from groove to groove, round the disc `[m]`.
    pub pitch: Vec<[f64; 2]>,
    /// What the roller rolls on, by the angle round the axis `[m]`.
    pub profile: Vec<[f64; 2]>,
}

impl CamData {
    /// The cam of a drive.
    #[must_use]
    pub fn new(c: &CamDesign) -> Self {
        CamData {
            spring: Spring::new(&c.spring),
            needed: c.needed.as_ref().map(Spring::new),
            fitted: Spring::new(&c.fitted),
            electromagnet: Electromagnet::new(&c.magnet),
            profile: c.profile.as_ref().map(Profile::new),
        }
    }
}

impl Electromagnet {
    fn new(m: &cam::Magnet) -> Self {
        let pulse = |p: &cam::Pulse| Pulse {
            disc: p.disc + 1,
            on: p.on,
            off: p.off,
        };
        Electromagnet {
            pulses: m.pulses.iter().map(pulse).collect(),
            first_force: m.first_force,
            last_force: m.last_force,
            energy_per_swing: m.energy_per_swing,
            energy_per_cycle: 2.0 * m.energy_per_swing,
            mean_power: m.mean_power,
        }
    }
}

impl Profile {
    fn new(p: &cam::Profile) -> Self {
        Profile {
            grooves: p.grooves.clone(),
            closes: p.closes,
            both_ways: p.both_ways,
            pressure_angle: p.pressure_angle,
            least_curvature: p.least_curvature,
            pitch: p.points.iter().map(|x| x.pitch).collect(),
            profile: p.outline.clone(),
        }
    }
}

/// A spring behind the cam.
#[derive(Debug, Serialize)]
pub struct Spring {
    /// c `[N/m]`.
    pub rate: f64,
    /// S `[m]`.
    pub stroke: f64,
    /// ψ0.
    pub mounting_coefficient: f64,
    /// What it gives over its stroke `[J]`.
    pub energy: f64,
}

impl Spring {
    fn new(s: &CamSpring) -> Self {
        Spring {
            rate: s.rate,
            stroke: s.stroke,
            mounting_coefficient: s.mounting,
            energy: s.energy(),
        }
    }
}
