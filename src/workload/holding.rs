//! The four contact forces that hold a part, and the smallest drive moment that brings them about.
//!
//! The part and the two levers are in equilibrium in space; contacts are points at mid-width with Coulomb friction, whose
//! cone is kept exact (a second-order cone programme). Forces that *can* hold are asked for: where more than one set does, nature
//! may choose another, which is what the safety factor is for.

use crate::workload::contact::{Pose, cross};
use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT,
    SupportedConeT::{NonnegativeConeT, SecondOrderConeT, ZeroConeT},
};
use thiserror::Error;

/// A vector in the gripper's axes, see [`crate::workload::contact`].
pub type Spatial = [f64; 3];

/// How the drive reaches the two levers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Coupling {
    /// One drive turns both levers by the same angle through gears or a slider, which pass any difference on.
    Coupled,
    /// Both levers are given the same moment, as from one pressure in two cylinders.
    Equal,
    /// Each lever has a drive of its own that gives any moment from zero to the stated one.
    Independent,
}

/// A wrench on the part at its centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Load {
    /// `[N]`
    pub force: Spatial,
    /// About the part's centre. `[N·m]`
    pub moment: Spatial,
}

impl Load {
    /// Weight less inertia force of a mass: m (g - a), at its centre of mass.
    ///
    /// # Units
    /// `[kg]`, `[m/s²]`, offset from the part's centre `[m]`.
    #[must_use]
    pub fn of_mass(mass: f64, gravity: Spatial, acceleration: Spatial, offset: Spatial) -> Load {
        let force = [0, 1, 2].map(|i| mass * (gravity[i] - acceleration[i]));
        Load {
            force,
            moment: cross3(offset, force),
        }
    }

    /// The load times a factor, such as one for safety.
    #[must_use]
    pub fn times(&self, factor: f64) -> Load {
        Load {
            force: self.force.map(|x| x * factor),
            moment: self.moment.map(|x| x * factor),
        }
    }
}

/// The force of one face on the part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactForce {
    /// Along the contact's normal, towards the part; not negative. `[N]`
    pub normal: f64,
    /// Friction along the face, from its vertex. `[N]`
    pub along: f64,
    /// Friction along z, the part's axis. `[N]`
    pub axial: f64,
}

impl ContactForce {
    /// Size of the friction force. `[N]`
    #[must_use]
    pub fn friction(&self) -> f64 {
        self.along.hypot(self.axial)
    }
}

/// A small motion of the part against the faces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slip {
    /// Velocity of the part's centre.
    pub velocity: Spatial,
    /// Angular velocity of the part, times the lever length.
    pub rotation: Spatial,
}

/// Forces that hold the part with the least drive moment.
#[derive(Debug, Clone, PartialEq)]
pub struct Holding {
    /// Forces on the part, in the order of [`Pose::contacts`].
    pub forces: [ContactForce; 4],
    /// Drive moments on the upper and the lower lever, positive when they close. `[N·m]`
    pub moments: [f64; 2],
    /// The drive moment per lever that is enough: the mean of the two where they are coupled, the greater otherwise. `[N·m]`
    pub drive: f64,
    /// No smaller drive moment holds the part: value of the dual programme. `[N·m]`
    pub lower_bound: f64,
}

/// What statics say of a part between four faces.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// It can be held.
    Held(Holding),
    /// No forces balance the load, however hard the drive closes.
    Slips(Slip),
}

/// Why statics have no answer.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum HoldingError {
    /// Not a coefficient.
    #[error("the coefficient of friction is {0}; give a number from 0 to 10")]
    Friction(f64),
    /// Not a wrench.
    #[error("the load is not finite; check mass, acceleration and gravity")]
    Load,
    /// The solver gave up.
    #[error(
        "the force programme ended with {0}; the case is too near the limit of what can be held"
    )]
    Solver(String),
}

fn cross3(a: Spatial, b: Spatial) -> Spatial {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// One linear programme over second-order cones, written row by row: `coefficients · x + s = right`, s in the row's cone.
#[derive(Default)]
struct Rows {
    rows: Vec<Vec<(usize, f64)>>,
    right: Vec<f64>,
    cones: Vec<SupportedConeT<f64>>,
}

impl Rows {
    fn add(&mut self, row: Vec<(usize, f64)>, right: f64) {
        self.rows.push(row);
        self.right.push(right);
    }

    fn matrix(&self, columns: usize) -> CscMatrix<f64> {
        let (mut i, mut j, mut v) = (Vec::new(), Vec::new(), Vec::new());
        for (r, row) in self.rows.iter().enumerate() {
            for &(c, x) in row {
                i.push(r);
                j.push(c);
                v.push(x);
            }
        }
        CscMatrix::new_from_triplets(self.rows.len(), columns, i, j, v)
    }
}

/// Components of a contact force among the variables: three a contact, then the drive moment.
const DRIVE: usize = 12;

/// The least drive moment per lever that holds the part in a pose under a load, or the motion in which it slips.
///
/// # Units
/// SI.
///
/// # Guarantee
/// Forces balance the load to 1e-7 of it, and the drive moment exceeds the least one by no more than `drive - lower_bound`.
///
/// # Errors
/// Friction or load out of range; a solver that gives up.
///
/// # Sources
/// Equilibrium of the part (six equations) and of each lever about its pivot, moments taken from coordinates, not from the
/// arms of `[Pavlenko & Godunko 2010]`.
pub fn hold(
    pose: &Pose,
    load: &Load,
    friction: f64,
    coupling: Coupling,
) -> Result<Outcome, HoldingError> {
    if !(0.0..=10.0).contains(&friction) {
        return Err(HoldingError::Friction(friction));
    }
    if !load.force.iter().chain(&load.moment).all(|x| x.is_finite()) {
        return Err(HoldingError::Load);
    }
    // Dimensionless: lengths over the lever's, forces over the load.
    let arm = |k: usize| {
        [
            pose.vertices[k][0] - pose.pivots[k][0],
            pose.vertices[k][1] - pose.pivots[k][1],
        ]
    };
    let length = arm(0)[0].hypot(arm(0)[1]);
    let size = load
        .force
        .iter()
        .map(|f| f * f)
        .chain(load.moment.iter().map(|m| m * m / (length * length)));
    let unit = size.sum::<f64>().sqrt();
    if unit == 0.0 {
        let idle = ContactForce {
            normal: 0.0,
            along: 0.0,
            axial: 0.0,
        };
        return Ok(Outcome::Held(Holding {
            forces: [idle; 4],
            moments: [0.0; 2],
            drive: 0.0,
            lower_bound: 0.0,
        }));
    }
    let directions: [[Spatial; 3]; 4] = pose.contacts.map(|c| {
        [
            [c.normal[0], c.normal[1], 0.0],
            [c.tangent[0], c.tangent[1], 0.0],
            [0.0, 0.0, 1.0],
        ]
    });
    let used = if friction > 0.0 { 3 } else { 1 };
    let components = || (0..4).flat_map(move |c| (0..used).map(move |d| (c, d)));
    let mut rows = Rows::default();
    for axis in 0..3 {
        let row = components()
            .map(|(c, d)| (3 * c + d, directions[c][d][axis]))
            .collect();
        rows.add(row, -load.force[axis] / unit);
    }
    for axis in 0..3 {
        let row = components().map(|(c, d)| {
            let p = pose.contacts[c].point;
            let from_centre = [
                (p[0] - pose.centre[0]) / length,
                (p[1] - pose.centre[1]) / length,
                0.0,
            ];
            (3 * c + d, cross3(from_centre, directions[c][d])[axis])
        });
        let row = row.collect();
        rows.add(row, -load.moment[axis] / unit / length);
    }
    // Closing moment that a lever needs: that of the part's forces on it, clockwise for the lower one.
    let lever = |k: usize| -> Vec<(usize, f64)> {
        let sign = if k == 0 { -1.0 } else { 1.0 };
        let own = components().filter(|(c, d)| pose.contacts[*c].lever == k && *d < 2);
        own.map(|(c, d)| {
            let (p, q) = (pose.pivots[k], pose.contacts[c].point);
            let from_pivot = [(q[0] - p[0]) / length, (q[1] - p[1]) / length];
            (
                3 * c + d,
                sign * cross(from_pivot, [directions[c][d][0], directions[c][d][1]]),
            )
        })
        .collect()
    };
    let scaled = |row: Vec<(usize, f64)>, s: f64| row.into_iter().map(move |(c, x)| (c, s * x));
    let mut equalities = 6;
    if coupling == Coupling::Equal {
        for k in 0..2 {
            rows.add(lever(k).into_iter().chain([(DRIVE, -1.0)]).collect(), 0.0);
        }
        equalities += 2;
    }
    // Variables that frictionless contacts do not have are held at zero.
    let unused: Vec<usize> = (0..4)
        .flat_map(|c| (used..3).map(move |d| 3 * c + d))
        .collect();
    for &v in &unused {
        rows.add(vec![(v, 1.0)], 0.0);
    }
    rows.cones.push(ZeroConeT(equalities + unused.len()));
    let mut inequalities = 1;
    rows.add(vec![(DRIVE, -1.0)], 0.0);
    match coupling {
        Coupling::Coupled => {
            let mean = scaled(lever(0), 0.5)
                .chain(scaled(lever(1), 0.5))
                .chain([(DRIVE, -1.0)]);
            rows.add(mean.collect(), 0.0);
            inequalities += 1;
        }
        Coupling::Independent => {
            for k in 0..2 {
                rows.add(lever(k).into_iter().chain([(DRIVE, -1.0)]).collect(), 0.0);
                rows.add(scaled(lever(k), -1.0).collect(), 0.0);
            }
            inequalities += 4;
        }
        Coupling::Equal => {}
    }
    if friction == 0.0 {
        (0..4).for_each(|c| rows.add(vec![(3 * c, -1.0)], 0.0));
        inequalities += 4;
    }
    rows.cones.push(NonnegativeConeT(inequalities));
    if friction > 0.0 {
        for c in 0..4 {
            rows.add(vec![(3 * c, -friction)], 0.0);
            rows.add(vec![(3 * c + 1, -1.0)], 0.0);
            rows.add(vec![(3 * c + 2, -1.0)], 0.0);
            rows.cones.push(SecondOrderConeT(3));
        }
    }
    let columns = DRIVE + 1;
    let mut objective = vec![0.0; columns];
    objective[DRIVE] = 1.0;
    let settings = DefaultSettings {
        verbose: false,
        ..DefaultSettings::default()
    };
    let quadratic = CscMatrix::zeros((columns, columns));
    let failed = |e: &dyn std::fmt::Display| HoldingError::Solver(e.to_string());
    let mut solver = DefaultSolver::new(
        &quadratic,
        &objective,
        &rows.matrix(columns),
        &rows.right,
        &rows.cones,
        settings,
    )
    .map_err(|e| failed(&e))?;
    solver.solve();
    let s = &solver.solution;
    match s.status {
        SolverStatus::Solved | SolverStatus::AlmostSolved => {
            let forces = [0, 1, 2, 3].map(|c| ContactForce {
                normal: (s.x[3 * c] * unit).max(0.0),
                along: s.x[3 * c + 1] * unit,
                axial: s.x[3 * c + 2] * unit,
            });
            let moment =
                |k: usize| lever(k).iter().map(|&(v, a)| a * s.x[v]).sum::<f64>() * unit * length;
            Ok(Outcome::Held(Holding {
                forces,
                moments: [moment(0), moment(1)],
                drive: s.x[DRIVE].max(0.0) * unit * length,
                lower_bound: s.obj_val_dual.max(0.0) * unit * length,
            }))
        }
        SolverStatus::PrimalInfeasible | SolverStatus::AlmostPrimalInfeasible => {
            // The certificate is a motion on which the load works and no contact force takes work away.
            let z = [0, 1, 2, 3, 4, 5].map(|i| s.z[i]);
            let power: f64 = z.iter().zip(&rows.right).map(|(z, b)| -z * b).sum();
            let size =
                z.iter().map(|z| z * z).sum::<f64>().sqrt() * if power < 0.0 { -1.0 } else { 1.0 };
            Ok(Outcome::Slips(Slip {
                velocity: [z[0] / size, z[1] / size, z[2] / size],
                rotation: [z[3] / size, z[4] / size, z[5] / size],
            }))
        }
        other => Err(HoldingError::Solver(format!("{other:?}"))),
    }
}
