//! The four contact forces that hold a part, and the smallest drive moment that produces them.
//!
//! The part and the two levers are in equilibrium in space. Contacts are points at mid-width with Coulomb friction,
//! whose cone is kept exact (a second-order cone program). The result is one set of forces that *can* hold the part. If
//! there are several sets, nature may choose another, which the safety factor covers.

use crate::geom::vector::cross;
use crate::grip::contact::TouchingPose;
use crate::model::grip::LeverDrive;
use crate::statics::cone_programme::ConeProgramme;
use clarabel::solver::SolverStatus;
use clarabel::solver::SupportedConeT::{NonnegativeConeT, SecondOrderConeT, ZeroConeT};
use serde::Serialize;
use thiserror::Error;

/// A vector in the gripper's axes, see [`crate::grip::contact`].
pub type Spatial = [f64; 3];

/// A wrench on the part at its centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PartWrench {
    /// `[N]`
    pub force: Spatial,
    /// About the part's centre. `[N·m]`
    pub moment: Spatial,
}

impl PartWrench {
    /// Returns the weight less the inertia force of a mass: m (g - a), at its centre of mass.
    ///
    /// # Units
    /// `[kg]`, `[m/s²]`, offset from the part's centre `[m]`.
    #[must_use]
    pub(crate) fn of_mass(
        mass: f64,
        gravity: Spatial,
        acceleration: Spatial,
        offset: Spatial,
    ) -> PartWrench {
        let force = [0, 1, 2].map(|i| mass * (gravity[i] - acceleration[i]));
        PartWrench {
            force,
            moment: cross(offset, force),
        }
    }

    /// Returns the load times a factor, such as one for safety.
    #[must_use]
    pub fn scaled_by(&self, factor: f64) -> PartWrench {
        PartWrench {
            force: self.force.map(|x| x * factor),
            moment: self.moment.map(|x| x * factor),
        }
    }
}

/// The force of one face on the part.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ContactForce {
    /// Component along the contact's normal, towards the part; not negative. `[N]`
    pub normal: f64,
    /// Friction along the face, from its vertex. `[N]`
    #[serde(rename = "along_face")]
    pub along: f64,
    /// Friction along z, the part's axis. `[N]`
    #[serde(rename = "along_part")]
    pub axial: f64,
}

impl ContactForce {
    /// A force of zero.
    const NONE: ContactForce = ContactForce {
        normal: 0.0,
        along: 0.0,
        axial: 0.0,
    };

    /// Returns the size of the friction force. `[N]`
    #[must_use]
    pub fn friction_force(&self) -> f64 {
        self.along.hypot(self.axial)
    }
}

impl ContactForce {
    /// Returns the force moved into the friction cone, from which a solver's result deviates within its tolerance.
    /// Returns zero if the normal force is below `least`, which is rounding.
    fn clamp_to_cone(self, friction: f64, least: f64) -> ContactForce {
        if self.normal <= least {
            return ContactForce::NONE;
        }
        let most = friction * self.normal;
        // A few digits of tolerance, so that rounding does not put the square root of the sum of squares above the
        // limit.
        let scale = if self.friction_force() > most {
            most / self.friction_force() * (1.0 - 4.0 * f64::EPSILON)
        } else {
            1.0
        };
        ContactForce {
            along: self.along * scale,
            axial: self.axial * scale,
            ..self
        }
    }
}

/// Fraction of the load below which forces are rounding errors of the solver.
const ROUNDING: f64 = 1e-7;

/// A small motion of the part relative to the faces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slip {
    /// Velocity of the part's centre.
    pub velocity: Spatial,
    /// Angular velocity of the part, times the lever length.
    pub rotation: Spatial,
}

impl Slip {
    /// Converts a certificate of infeasibility: a motion on which the load works and no contact force takes work away.
    fn of_certificate(z: &[f64]) -> Slip {
        let z = &z[..6];
        let size = z.iter().map(|z| z * z).sum::<f64>().sqrt();
        let part = |from: usize| [0, 1, 2].map(|i| z[from + i] / size);
        Slip {
            velocity: part(0),
            rotation: part(3),
        }
    }
}

/// Forces that hold the part with the smallest drive moment.
#[derive(Debug, Clone, PartialEq)]
pub struct Holding {
    /// Forces on the part, in the order of [`TouchingPose::contacts`].
    pub forces: [ContactForce; 4],
    /// Drive moments on the upper and the lower lever, positive when they close. `[N·m]`
    pub moments: [f64; 2],
    /// The required drive moment per lever: the mean of the two if they are coupled, the larger otherwise. `[N·m]`
    pub drive: f64,
    /// Lower bound of the drive moment that holds the part: value of the dual program, to its tolerance, and not above
    /// `drive`. `[N·m]`
    pub lower_bound: f64,
}

impl Holding {
    /// The result without a load.
    const IDLE: Holding = Holding {
        forces: [ContactForce::NONE; 4],
        moments: [0.0; 2],
        drive: 0.0,
        lower_bound: 0.0,
    };
}

/// Result of the statics of a part between four faces.
#[derive(Debug, Clone, PartialEq)]
pub enum HoldingOutcome {
    /// It can be held.
    Held(Holding),
    /// No forces balance the load, for any drive moment.
    Slips(Slip),
}

impl HoldingOutcome {
    /// Returns the forces that hold it, if it can be held.
    #[must_use]
    pub fn held_forces(&self) -> Option<&Holding> {
        match self {
            HoldingOutcome::Held(held) => Some(held),
            HoldingOutcome::Slips(_) => None,
        }
    }
}

/// Reason why the statics have no result.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum HoldingError {
    /// The value is not a coefficient of friction.
    #[error("the coefficient of friction is {0}; give a number from 0 to 10")]
    Friction(f64),
    /// The value is not a wrench.
    #[error("the load is not finite; check mass, acceleration and gravity")]
    Load,
    /// The solver stopped without a solution.
    #[error(
        "the cone program for the contact forces stopped with {0}; the case is too close to the limit of what can be held"
    )]
    Solver(String),
}

/// A linear program over cones: minimise the drive moment subject to `row · x + s = right`, with s in the cone of the
/// row. Dimensionless: lengths over the lever's, forces over the load.
struct Programme<'a> {
    pose: &'a TouchingPose,
    /// Length of a lever. `[m]`
    length: f64,
    /// Directions of the three components of each contact force.
    directions: [[Spatial; 3]; 4],
    /// Number of components in use: three with friction, one without.
    used: usize,
    cones: ConeProgramme,
}

/// Index of the drive moment among the variables, after three components for each of four contacts.
const DRIVE: usize = 12;

impl<'a> Programme<'a> {
    fn new(pose: &'a TouchingPose, friction: f64) -> Self {
        let (p, v) = (pose.pivots[0], pose.vertices[0]);
        Programme {
            pose,
            length: (v[0] - p[0]).hypot(v[1] - p[1]),
            directions: pose.contacts.map(|c| {
                let flat = |v: [f64; 2]| [v[0], v[1], 0.0];
                [flat(c.normal), flat(c.tangent), [0.0, 0.0, 1.0]]
            }),
            used: if friction > 0.0 { 3 } else { 1 },
            cones: ConeProgramme::default(),
        }
    }

    /// Returns contact, component and variable of every force component in use.
    fn iter_components(&self) -> impl Iterator<Item = (usize, usize, usize)> + use<> {
        let used = self.used;
        (0..4).flat_map(move |c| (0..used).map(move |d| (c, d, 3 * c + d)))
    }

    fn add_row(&mut self, row: impl IntoIterator<Item = (usize, f64)>, right: f64) {
        self.cones.add_row(row, right);
    }

    fn from(&self, origin: [f64; 2], contact: usize) -> Spatial {
        let q = self.pose.contacts[contact].point;
        [
            (q[0] - origin[0]) / self.length,
            (q[1] - origin[1]) / self.length,
            0.0,
        ]
    }

    /// Adds three equations of forces and three of moments about the part's centre.
    fn add_balance(&mut self, load: &PartWrench, unit: f64) {
        let wrenches: Vec<(usize, Spatial, Spatial)> = self
            .iter_components()
            .map(|(c, d, v)| {
                let f = self.directions[c][d];
                (v, f, cross(self.from(self.pose.centre, c), f))
            })
            .collect();
        for axis in 0..3 {
            self.add_row(
                wrenches.iter().map(|(v, f, _)| (*v, f[axis])),
                -load.force[axis] / unit,
            );
        }
        for axis in 0..3 {
            let right = -load.moment[axis] / unit / self.length;
            self.add_row(wrenches.iter().map(|(v, _, m)| (*v, m[axis])), right);
        }
    }

    /// Returns the closing moment that a lever requires, times `scale`: that of the part's forces on it about its
    /// pivot.
    fn lever_row(&self, k: usize, scale: f64) -> Vec<(usize, f64)> {
        let sign = if k == 0 { -scale } else { scale };
        let own = self
            .iter_components()
            .filter(|(c, _, _)| self.pose.contacts[*c].lever == k);
        own.map(|(c, d, v)| {
            (
                v,
                sign * cross(self.from(self.pose.pivots[k], c), self.directions[c][d])[2],
            )
        })
        .collect()
    }

    /// Adds the balance of each lever's moment with the drive's.
    fn equal_levers(&mut self) {
        for k in 0..2 {
            let row = self.lever_row(k, 1.0).into_iter().chain([(DRIVE, -1.0)]);
            self.add_row(row, 0.0);
        }
    }

    fn write_programme(
        mut self,
        load: &PartWrench,
        unit: f64,
        friction: f64,
        levers: LeverDrive,
    ) -> Self {
        self.add_balance(load, unit);
        if levers == LeverDrive::Equal {
            self.equal_levers();
        }
        // The missing components of frictionless contacts are held at zero.
        let used = self.used;
        for v in (0..DRIVE).filter(|v| v % 3 >= used) {
            self.add_row([(v, 1.0)], 0.0);
        }
        self.cones.close_cone(ZeroConeT);
        self.add_row([(DRIVE, -1.0)], 0.0);
        match levers {
            LeverDrive::Coupled => {
                let both = self
                    .lever_row(0, 0.5)
                    .into_iter()
                    .chain(self.lever_row(1, 0.5));
                self.add_row(both.chain([(DRIVE, -1.0)]), 0.0);
            }
            LeverDrive::Independent => {
                self.equal_levers();
                for k in 0..2 {
                    let row = self.lever_row(k, -1.0);
                    self.add_row(row, 0.0);
                }
            }
            LeverDrive::Equal => {}
        }
        if friction == 0.0 {
            (0..4).for_each(|c| self.add_row([(3 * c, -1.0)], 0.0));
        }
        self.cones.close_cone(NonnegativeConeT);
        if friction > 0.0 {
            for c in 0..4 {
                self.add_row([(3 * c, -friction)], 0.0);
                self.add_row([(3 * c + 1, -1.0)], 0.0);
                self.add_row([(3 * c + 2, -1.0)], 0.0);
                self.cones.close_cone(SecondOrderConeT);
            }
        }
        self
    }

    /// Returns the holding with these forces, with a lower bound of any drive moment.
    fn held_by(&self, forces: [ContactForce; 4], levers: LeverDrive, least: f64) -> Holding {
        let of = |v: usize| {
            let f: &ContactForce = &forces[v / 3];
            [f.normal, f.along, f.axial][v % 3]
        };
        let moment = |k| {
            let own = self.lever_row(k, 1.0);
            own.iter().map(|&(v, a)| a * of(v)).sum::<f64>() * self.length
        };
        let moments = [moment(0), moment(1)];
        // The moment of these forces, so that the statics give the same, and not that of the solver, which has its
        // tolerance.
        let drive = match levers {
            LeverDrive::Coupled => f64::midpoint(moments[0], moments[1]),
            LeverDrive::Equal | LeverDrive::Independent => moments[0].max(moments[1]),
        };
        let drive = drive.max(0.0);
        Holding {
            forces,
            moments,
            drive,
            lower_bound: least.min(drive),
        }
    }
}

/// Returns the smallest drive moment per lever that holds the part in a pose under a load, or the motion in which it
/// slips.
///
/// # Units
/// SI.
///
/// # Guarantee
/// Forces balance the load to 1e-6 of it, and the drive moment exceeds the smallest one by no more than `drive -
/// lower_bound`.
///
/// # Errors
/// Returns an error if friction or load are out of range, or if the solver stops without a solution.
///
/// # Sources
/// Equilibrium of the part (six equations) and of each lever about its pivot, with moments from coordinates, not from
/// the arms of `[Pavlenko & Godunko 2010]`.
///
/// # Examples
/// ```
/// use ozols::grip::{contact::Gripper, holding, lever_arm::Lever};
/// use ozols::model::grip::LeverDrive;
/// let lever = Lever::new(0.1, 120f64.to_radians(), 30f64.to_radians())?;
/// let pose = Gripper::with_nominal(lever, 0.05).touching_pose(0.05).expect("it is held");
/// let load = holding::PartWrench { force: [0.0, -10.0, 0.0], moment: [0.0; 3] };
/// let found = holding::find_holding(&pose, &load, 0.3, LeverDrive::Independent)?;
/// assert!(matches!(found, holding::HoldingOutcome::Held(h) if h.drive > 0.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn find_holding(
    pose: &TouchingPose,
    load: &PartWrench,
    friction: f64,
    levers: LeverDrive,
) -> Result<HoldingOutcome, HoldingError> {
    if !(0.0..=10.0).contains(&friction) {
        return Err(HoldingError::Friction(friction));
    }
    if !load.force.iter().chain(&load.moment).all(|x| x.is_finite()) {
        return Err(HoldingError::Load);
    }
    let programme = Programme::new(pose, friction);
    let length = programme.length;
    let size = load
        .force
        .iter()
        .map(|f| f * f)
        .chain(load.moment.iter().map(|m| (m / length).powi(2)));
    let unit = size.sum::<f64>().sqrt();
    if unit == 0.0 {
        return Ok(HoldingOutcome::Held(Holding::IDLE));
    }
    let programme = programme.write_programme(load, unit, friction, levers);
    let mut objective = [0.0; DRIVE + 1];
    objective[DRIVE] = 1.0;
    let s = programme.cones.solve_programme(&[], &objective);
    let s = s.map_err(HoldingError::Solver)?;
    match s.status {
        SolverStatus::Solved | SolverStatus::AlmostSolved => {
            let forces = [0, 1, 2, 3].map(|c| {
                let [normal, along, axial] = [0, 1, 2].map(|d| s.x[3 * c + d] * unit);
                let found = ContactForce {
                    normal,
                    along,
                    axial,
                };
                found.clamp_to_cone(friction, ROUNDING * unit)
            });
            let least = s.obj_val_dual.max(0.0) * unit * length;
            Ok(HoldingOutcome::Held(
                programme.held_by(forces, levers, least),
            ))
        }
        SolverStatus::PrimalInfeasible | SolverStatus::AlmostPrimalInfeasible => {
            Ok(HoldingOutcome::Slips(Slip::of_certificate(&s.z)))
        }
        other => Err(HoldingError::Solver(format!("{other:?}"))),
    }
}
