//! Design and run of a torsional drive: bar, missing angle, cam spring, programme, and the motion of its payload.
//!
//! While the disc swings from one groove to the next, the electromagnet of the cam first holds the follower lifted. It is released
//! at the start of the push. Then the spring presses the follower on the cam, and does the work of the push.

use crate::drive::programme::{Endurance, Event, Module, Run};
use crate::drive::swing::{Disc, Feed, Latch, SwingError};
use crate::drive::torsion::{Bar, CamSpring, Sizing, Wanted, friction_energy, natural_frequency};
use crate::model::drive::{Cam, Damping, DriveSpec};
use serde::{Serialize, Serializer};

/// Step of the chosen lengths of bars. `[m]`
pub(crate) const LENGTH_STEP: f64 = 1e-3;

/// Source of the damping of a simulation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum DampingFrom {
    /// The file.
    #[serde(rename = "file")]
    Stated,
    /// The viscous damping that gives the missing angle.
    MissingAngle,
    /// There is no damping.
    None,
}

/// The motion of a payload. SI units.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PayloadMotion {
    /// Largest angular acceleration, p² φ0, at the ends of a swing. `[rad/s²]`
    pub angular_acceleration: f64,
    /// Largest angular speed, p φ0, in its middle. `[rad/s]`
    pub angular_speed: f64,
    /// Largest acceleration of a payload at its radius, in any direction. `[m/s²]`
    pub acceleration: Option<f64>,
}

/// A drive with a bar.
#[derive(Debug, Clone, PartialEq)]
pub struct Design {
    /// The bar.
    pub bar: Bar,
    /// k. `[N·m/rad]`
    pub stiffness: f64,
    /// Damping of the simulation.
    pub damping: Damping,
    /// Source of the damping.
    pub damping_from: DampingFrom,
    /// Δφ: measured, or derived from the damping. `[rad]`
    pub missing: f64,
    /// E_fr by (12). `[J]`
    pub friction_energy: f64,
    /// The cam's work that brings the disc to its latch at rest, or `None` if it is stuck. `[J]`
    pub needed_feed: Option<f64>,
    /// The cam's work in the simulation. `[J]`
    pub feed: f64,
    /// The cam's spring.
    pub cam: Option<CamDesign>,
    /// Motion of each disc.
    pub motions: [PayloadMotion; 2],
    /// The discs.
    pub module: Module,
    /// The programme run.
    pub run: Run,
    /// Result of the programme in the long run.
    pub endurance: Endurance,
}

/// Result for a drive.
#[derive(Debug, Clone, PartialEq)]
pub struct Driving {
    /// The bar's sizing.
    pub sizing: Sizing,
    /// The design, if there is a bar.
    pub design: Option<Design>,
}

/// Returns the requirements on the bar from a specification.
#[must_use]
pub(crate) fn bar_requirements(spec: &DriveSpec) -> Wanted {
    Wanted {
        twist: spec.twist,
        period: spec.period,
        inertia: spec.inertias[0].max(spec.inertias[1]),
        shear_modulus: spec.shear_modulus,
        allowable_stress: spec.allowable_stress,
        length: spec.length,
        max_length: spec.max_length,
        length_step: LENGTH_STEP,
        diameters: spec.diameters.clone(),
    }
}

/// Returns the largest acceleration at radius r over a swing, from the tangential p² φ r and the radial p² (φ0² - φ²)
/// r. The sum of their squares is convex in φ², so its maximum is at an end of its range: r p² φ0 max(1, φ0).
fn payload_motion(stiffness: f64, inertia: f64, twist: f64, radius: Option<f64>) -> PayloadMotion {
    let p = natural_frequency(stiffness, inertia);
    PayloadMotion {
        angular_acceleration: p * p * twist,
        angular_speed: p * twist,
        acceleration: radius.map(|r| r * p * p * twist * twist.max(1.0)),
    }
}

/// Designs the bar and the cam's spring and runs the programme.
///
/// # Units
/// SI.
///
/// # Errors
/// Returns an error if the discs do not swing.
///
/// # Sources
/// `[Klyuchkovskyi 1999]`: φ0, hardest motion, largest inertia, then bar, missing angle, spring.
///
/// # Examples
/// ```
/// let text = ozols::builtin::text("torsion-module").expect("it is built in");
/// let file = ozols::file::read::workload::drive_from_bytes("torsion-module.toml", text.as_bytes())?;
/// let found = ozols::drive::driving::design_drive(&file.spec)?;
/// let design = found.design.expect("a bar is found");
/// assert!(design.run.is_complete());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn design_drive(spec: &DriveSpec) -> Result<Driving, SwingError> {
    let sizing = bar_requirements(spec).size_bar();
    let design = sizing
        .bar
        .map(|bar| design_with_bar(spec, bar))
        .transpose()?;
    Ok(Driving { sizing, design })
}

/// Returns the damping of the simulation, and its source.
fn choose_damping(spec: &DriveSpec, stiffness: f64) -> (Damping, DampingFrom) {
    let largest = usize::from(spec.inertias[1] > spec.inertias[0]);
    let viscous = |viscous| Damping {
        viscous,
        coulomb: 0.0,
    };
    match (spec.damping, spec.missing) {
        (Some(d), _) => (d, DampingFrom::Stated),
        (None, Some(missing)) => {
            let inertia = spec.inertias[largest];
            let needed = Disc::viscous_for(inertia, stiffness, spec.twist, missing);
            (viscous(needed), DampingFrom::MissingAngle)
        }
        (None, None) => (viscous(0.0), DampingFrom::None),
    }
}

/// Returns the work of the cam that brings both discs to their latch at rest, if there is such work.
fn needed_feed(discs: &[Disc; 2], latch: Latch, from: f64) -> Result<Option<f64>, SwingError> {
    let needs = discs
        .iter()
        .map(|d| d.needed_feed(latch, from))
        .collect::<Result<Vec<_>, _>>()?;
    Ok(needs
        .into_iter()
        .try_fold(0.0f64, |most, n| n.map(|n| most.max(n))))
}

/// Returns the drive with a bar, and the programme it runs.
fn design_with_bar(spec: &DriveSpec, bar: Bar) -> Result<Design, SwingError> {
    let stiffness = bar.stiffness();
    let (damping, damping_from) = choose_damping(spec, stiffness);
    let disc = |inertia| Disc {
        inertia,
        stiffness,
        viscous: damping.viscous,
        coulomb: damping.coulomb,
    };
    let discs = spec.inertias.map(disc);
    let latch = Latch {
        at: spec.twist,
        capture: spec.capture,
    };
    if let Some(creeping) = discs.iter().find(|d| d.damping_ratio() >= 1.0) {
        return Err(SwingError::Overdamped(creeping.damping_ratio()));
    }
    let missing = spec.missing.unwrap_or_else(|| {
        discs
            .iter()
            .map(|d| d.missing_angle(spec.twist))
            .fold(0.0, f64::max)
    });
    let friction_energy = friction_energy(stiffness, spec.twist, missing);
    let feed = Feed {
        energy: spec.push.energy.unwrap_or(friction_energy),
        from: spec.push.from,
    };
    let needed_feed = needed_feed(&discs, latch, feed.from)?;
    let module = Module { discs, latch, feed };
    let run = module.run_programme(&spec.programme)?;
    let endurance = module.run_endlessly(&spec.programme)?;
    let radius = spec.payload.map(|p| p.radius);
    let mut design = Design {
        bar,
        stiffness,
        damping,
        damping_from,
        missing,
        friction_energy,
        needed_feed,
        feed: feed.energy,
        cam: None,
        motions: spec
            .inertias
            .map(|i| payload_motion(stiffness, i, spec.twist, radius)),
        module,
        run,
        endurance,
    };
    design.cam = spec.cam.map(|c| design_cam(&c, &design));
    Ok(design)
}

/// Returns the cam of a design.
fn design_cam(cam: &Cam, design: &Design) -> CamDesign {
    let spring = |energy| CamSpring::for_friction(energy, cam.efficiency, cam.mounting, cam.stroke);
    let fitted = spring(design.feed);
    CamDesign {
        spring: spring(design.friction_energy),
        needed: design.needed_feed.map(spring),
        fitted,
        magnet: size_magnet(&design.run, &fitted),
    }
}

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
