//! The spring of a cam's follower, and the action of the electromagnet that lifts it.
//!
//! While the disc swings from one groove to the next, the electromagnet first holds the follower lifted. It is released
//! at the start of the push. Then the spring presses the follower on the cam, and does the work of the push.

use crate::drive::programme::{Event, Run};
use crate::drive::torsion::CamSpring;
use serde::{Serialize, Serializer};

/// The cam's spring by the formulas and by the simulation, and its electromagnets.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CamDesign {
    /// The spring by equation (14).
    pub spring: CamSpring,
    /// The spring that brings the disc to its latch at rest, if there is one.
    pub needed: Option<CamSpring>,
    /// The spring that gives the work fed in this run.
    pub fitted: CamSpring,
    /// The action of the electromagnets against the fitted spring.
    #[serde(rename = "electromagnet")]
    pub magnet: Magnet,
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
pub(crate) fn size_magnet(run: &Run, spring: &CamSpring) -> Magnet {
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
    let work = spring.stroke_energy() * pulses.len() as f64;
    Magnet {
        first_force: force(spring.mounting),
        last_force: force(1.0 + spring.mounting),
        energy_per_swing: spring.stroke_energy(),
        energy_per_cycle: 2.0 * spring.stroke_energy(),
        mean_power: if time > 0.0 { work / time } else { 0.0 },
        pulses,
    }
}
