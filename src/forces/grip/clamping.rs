//! The loads that a gripper can hold over a range of diameters and motions, and the required drive moment.

use crate::format::decimals;
use crate::geom::vector::{length, unit};
use crate::grip::contact::{Gripper, TouchingPose, Unholdable};
use crate::grip::holding::{
    Holding, HoldingError, HoldingOutcome, PartWrench, Spatial, find_holding,
};
use crate::grip::lever_arm::{Arms, Lever, LeverError};
use crate::model::grip::{GripLoad, GripSpec, Pivots, Toward};
use itertools::Itertools;

/// Number of directions from which loads of any direction are followed uphill, before the worst is refined: to the
/// faces, edges and corners of a cube.
pub const DIRECTIONS: usize = 26;
/// Maximum number of steps uphill from each direction; a few are enough.
const CLIMB: usize = 20;

/// The worst case of a diameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Hardest {
    /// Description of the case, such as "acceleration (5, 0, 0) m/s²".
    pub case: String,
    /// Gravity less acceleration in the gripper's axes, without the safety factor. `[m/s²]`
    pub pull: Spatial,
    /// The load with its safety factor.
    pub load: PartWrench,
    /// The result of the statics.
    pub verdict: Result<HoldingOutcome, HoldingError>,
}

impl Hardest {
    /// Returns the forces that hold the part, if it is held.
    #[must_use]
    pub fn held_forces(&self) -> Option<&Holding> {
        self.verdict.as_ref().ok()?.held_forces()
    }

    /// Returns its difficulty; a part that cannot be held is the most difficult.
    fn hardness(&self) -> f64 {
        self.held_forces().map_or(f64::INFINITY, |h| h.drive)
    }
}

/// One diameter.
#[derive(Debug, Clone, PartialEq)]
pub struct DiameterRow {
    /// `[m]`
    pub diameter: f64,
    /// The gripper, with its pivots set for this diameter if they are adjustable.
    pub gripper: Gripper,
    /// The arms.
    pub arms: Arms,
    /// The pose, if the levers reach the part.
    pub pose: Option<TouchingPose>,
    /// Reasons why it cannot be held by any forces. Empty if it can.
    pub obstacles: Vec<Unholdable>,
    /// Mass of the part; 0 if no load is stated. `[kg]`
    pub mass: f64,
    /// The worst case, if a load is stated and there are no obstacles.
    pub hardest: Option<Hardest>,
}

impl DiameterRow {
    /// Returns the drive moment per lever, if the part is held against a load. `[N·m]`
    #[must_use]
    pub fn drive_moment(&self) -> Option<f64> {
        Some(self.hardest.as_ref()?.held_forces()?.drive)
    }

    /// Returns true if the part is held in every stated case.
    #[must_use]
    pub fn is_held(&self) -> bool {
        let forces = self.hardest.as_ref();
        self.obstacles.is_empty() && forces.is_none_or(|h| h.held_forces().is_some())
    }
}

/// The whole range.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    /// The lever.
    pub lever: Lever,
    /// One row per diameter, ascending.
    pub rows: Vec<DiameterRow>,
}

impl Study {
    /// Returns true if every diameter is held in every case.
    #[must_use]
    pub fn holds_all(&self) -> bool {
        self.rows.iter().all(DiameterRow::is_held)
    }

    /// Returns the diameter that requires the largest drive moment.
    #[must_use]
    pub fn hardest_row(&self) -> Option<&DiameterRow> {
        let held = self
            .rows
            .iter()
            .filter_map(|r| Some((r, r.drive_moment()?)));
        held.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(r, _)| r)
    }
}

/// Gravity less acceleration: a vector, and another of given size and any direction.
struct GravityCase {
    base: Spatial,
    any: f64,
    words: Box<dyn Fn(Spatial) -> String>,
}

fn vector_words([x, y, z]: Spatial) -> String {
    let round = |v| decimals(v, 3);
    format!("({}, {}, {})", round(x), round(y), round(z))
}

fn gravity_cases(load: &GripLoad) -> Vec<GravityCase> {
    let each = |a: &Toward| match (load.gravity, *a) {
        (Toward::Fixed(g), Toward::Fixed(a)) => GravityCase {
            base: [0, 1, 2].map(|i| g[i] - a[i]),
            any: 0.0,
            words: Box::new(move |_| {
                if a == [0.0; 3] {
                    "at rest".to_owned()
                } else {
                    format!("acceleration {} m/s²", vector_words(a))
                }
            }),
        },
        (Toward::Fixed(g), Toward::Any(size)) => GravityCase {
            base: g,
            any: size,
            words: Box::new(move |u| {
                format!(
                    "acceleration {size} m/s² along {}",
                    vector_words(u.map(|x| -x))
                )
            }),
        },
        (Toward::Any(size), Toward::Fixed(a)) => GravityCase {
            base: a.map(|x| -x),
            any: size,
            words: Box::new(move |u| {
                if a == [0.0; 3] {
                    format!("gravity along {}", vector_words(u))
                } else {
                    format!(
                        "acceleration {} m/s², gravity along {}",
                        vector_words(a),
                        vector_words(u)
                    )
                }
            }),
        },
        (Toward::Any(g), Toward::Any(a)) => GravityCase {
            base: [0.0; 3],
            any: g + a,
            words: Box::new(move |u| {
                format!(
                    "gravity and {a} m/s² of acceleration both pulling along {}",
                    vector_words(u)
                )
            }),
        },
    };
    load.accelerations.iter().map(each).collect()
}

fn cube_directions() -> impl Iterator<Item = Spatial> {
    let steps = [-1.0, 0.0, 1.0];
    let all = steps
        .into_iter()
        .cartesian_product(steps)
        .cartesian_product(steps);
    all.map(|((x, y), z)| [x, y, z])
        .filter(|v| *v != [0.0; 3])
        .map(unit)
}

fn hardest_of(pose: &TouchingPose, load: &GripLoad, mass: f64, case: &GravityCase) -> Hardest {
    let at = |u: Spatial| {
        let pull = [0, 1, 2].map(|i| case.base[i] + case.any * u[i]);
        let load_there =
            PartWrench::of_mass(mass, pull, [0.0; 3], load.centre_of_mass).scaled_by(load.safety);
        let verdict = find_holding(pose, &load_there, load.friction, load.levers);
        (
            u,
            Hardest {
                case: (case.words)(u),
                pull,
                load: load_there,
                verdict,
            },
        )
    };
    if case.any == 0.0 {
        return at([0.0; 3]).1;
    }
    // The moment is a convex function of the load, so its maximum over a ball lies on the sphere. There may be several
    // local maxima, and the global one need not be near the best of a few directions.
    let mut worst = at([1.0, 0.0, 0.0]);
    for u in cube_directions() {
        let found = climb_from(at, at(u));
        // Mirror images are equally difficult. Rounding must not prefer one of them.
        if found.1.hardness() > worst.1.hardness() * (1.0 + 1e-6) {
            worst = found;
        }
    }
    let mut step = 0.4;
    while step > 2e-3 && worst.1.hardness().is_finite() {
        let from = worst.0;
        let aside = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
            .into_iter()
            .cartesian_product([step, -step]);
        let tries = aside.map(|(a, s)| at(unit([0, 1, 2].map(|i| from[i] + s * a[i]))));
        let best = tries.max_by(|a, b| a.1.hardness().total_cmp(&b.1.hardness()));
        match best.filter(|b| b.1.hardness() > worst.1.hardness() * (1.0 + 1e-9)) {
            Some(better) => worst = better,
            None => step /= 2.0,
        }
    }
    worst.1
}

/// Follows a direction to where the moment no longer increases. The direction of the slope there maximises the tangent
/// over the ball. A convex function is nowhere below its tangent, so every step increases the moment.
fn climb_from(
    at: impl Fn(Spatial) -> (Spatial, Hardest),
    mut here: (Spatial, Hardest),
) -> (Spatial, Hardest) {
    /// Step of a finite difference that approximates a slope.
    const STEP: f64 = 1e-3;
    for _ in 0..CLIMB {
        let (u, now) = (here.0, here.1.hardness());
        let slope = [0, 1, 2].map(|i| {
            let mut aside = u;
            aside[i] += STEP;
            at(aside).1.hardness() - now
        });
        let steep = length(slope);
        if !(steep.is_finite() && steep > 0.0) {
            break;
        }
        let next = at(slope.map(|x| x / steep));
        if next.1.hardness() <= now * (1.0 + 1e-9) {
            break;
        }
        here = next;
    }
    here
}

/// Returns the gripper for a diameter.
pub(super) fn gripper_for(spec: &GripSpec, lever: Lever, diameter: f64) -> Gripper {
    Gripper {
        lever,
        pivot: match spec.pivots {
            Pivots::Nominal => lever.nominal_pivot(diameter),
            Pivots::FixedForDiameter => lever.nominal_pivot(spec.diameter),
            Pivots::Fixed(a) => a,
        },
        face_length: spec.face_length,
        lever_width: spec.lever_width,
        may_cross: spec.may_cross,
    }
}

/// Analyses every diameter of a gripper in every case of its load.
///
/// # Guarantee
/// A load of any direction is followed uphill from [`DIRECTIONS`] directions and refined about the worst. The result is
/// a lower bound of the moment over all directions, and in practice its value.
///
/// # Errors
/// Returns an error if figures of the lever are out of range.
///
/// # Examples
/// ```
/// let text = ozols::builtin::text("lever-gripper").unwrap_or_default();
/// let file = ozols::file::read::workload::grip_from_bytes("lever-gripper.toml", text.as_bytes())?;
/// let study = ozols::grip::clamping::study_diameters(&file.spec)?;
/// assert!(study.holds_all());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn study_diameters(spec: &GripSpec) -> Result<Study, LeverError> {
    let lever = Lever::new(spec.lever_length, spec.prism_angle, spec.mounting_angle)?;
    let row = |&diameter: &f64| {
        let gripper = gripper_for(spec, lever, diameter);
        let obstacles = gripper.find_obstacles(diameter);
        let pose = gripper.touching_pose(diameter).ok();
        let mass = spec
            .load
            .as_ref()
            .map_or(0.0, |l| l.mass.for_diameter(diameter));
        let hardest = match (&spec.load, &pose) {
            (Some(load), Some(pose)) if obstacles.is_empty() => {
                let found = gravity_cases(load)
                    .iter()
                    .map(|c| hardest_of(pose, load, mass, c))
                    .collect_vec();
                found
                    .into_iter()
                    .reduce(|a, b| if b.hardness() > a.hardness() { b } else { a })
            }
            _ => None,
        };
        DiameterRow {
            diameter,
            gripper,
            arms: lever.force_arms(diameter),
            pose,
            obstacles,
            mass,
            hardest,
        }
    };
    Ok(Study {
        lever,
        rows: spec.diameters.iter().map(row).collect(),
    })
}
