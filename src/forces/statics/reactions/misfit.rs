//! Assembly forces of inaccurate joints. They close the loops of a redundant mechanism whose joints are made and mounted within tolerances.
//!
//! Each joint has a random shift and turn. Reactions of elastic joints are linear in them, r = R·e, so one solution for each component of e
//! gives the matrix R. For independent errors with variances Σ, the covariance of the reactions is R·Σ·Rᵀ. Without redundant constraints R
//! is zero: a determinate mechanism assembles without force, which is the argument of [Pogrebnyak 2018] for it.

use crate::model::loads::{Accuracy, Loads, Misalignment, Stiffness, Tolerances};
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::motion::pose::Pose;
use crate::statics::reactions::equations::{System, Transmitted, elastic_reactions};
use crate::statics::reactions::geometry::Geometry;
use crate::statics::reactions::unsolved::Unsolved;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use serde::Serialize;

/// The mean, root mean square and 95 % quantile of a magnitude.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spread {
    /// The mean.
    pub mean: f64,
    /// The root mean square.
    pub rms: f64,
    /// The value that 95 % of assemblies stay below.
    pub most: f64,
}

/// The assembly force of one joint.
#[derive(Debug, Clone, PartialEq)]
pub struct JointMisfit {
    /// The joint.
    pub joint: JointId,
    /// The force `[N]`.
    pub force: Spread,
    /// The moment about its point `[N·m]`.
    pub moment: Spread,
}

/// The assembly forces of a mechanism.
#[derive(Debug, Clone, PartialEq)]
pub struct Misfit {
    /// Each joint of the state, in file order.
    pub joints: Vec<JointMisfit>,
    /// The greatest force of any joint `[N]`.
    pub force: Spread,
    /// Share of assemblies in which no joint needs more than the stated force.
    pub by_hand: f64,
    /// The stiffness of joints without their own.
    pub stiffness: Stiffness,
}

/// Stiffness of joints if the file states none: 10 N/µm, and a bearing of some 30 mm against turns.
const USUAL: Stiffness = Stiffness {
    linear: 1e7,
    angular: 1e4,
};
/// Number of assemblies drawn.
const SAMPLES: usize = 10_000;

/// The reactions of a state to each component of the error of each joint.
struct Response {
    geometry: Geometry,
    /// For each component, force and moment at each joint for one standard deviation.
    columns: Vec<Vec<f64>>,
    /// The stiffness of joints without their own.
    stiffness: Stiffness,
}

impl Response {
    /// Returns the response of a state in the pose of the file.
    fn new(m: &Mechanism, state: StateId, accuracy: &Accuracy) -> Result<Response, Unsolved> {
        let geometry = Geometry::new(m, state, &Pose::of_file(m, state)?)?;
        let stresses = System::new(&geometry, &[])?.self_stresses(m.joints.len());
        let mut loads = Loads {
            stiffness: m.loads.stiffness.clone(),
            ..Loads::default()
        };
        let find_default = |(name, s): &(String, Stiffness)| (name == "default").then_some(*s);
        let stated = loads.stiffness.iter().find_map(find_default);
        let stiffness = stated.unwrap_or(USUAL);
        loads.stiffness.push(("default".to_owned(), stiffness));
        let mut columns = Vec::new();
        for &joint in &geometry.joints {
            let Tolerances { position, angle } = accuracy.of_joint(joint);
            for component in 0..6 {
                let mut off = Misalignment {
                    joint,
                    turn: [0.0; 3],
                    shift: [0.0; 3],
                };
                match component {
                    0..3 => off.turn[component] = angle / 3.0,
                    _ => off.shift[component - 3] = position / 3.0,
                }
                loads.misalignments = vec![off];
                let still = Transmitted::of_joints(&geometry, vec![[0.0; 6]; m.joints.len()]);
                if let Some((of, _)) = elastic_reactions(m, &geometry, &loads, still, &stresses) {
                    columns.push(of.flat_values(&geometry));
                }
            }
        }
        Ok(Response {
            geometry,
            columns,
            stiffness,
        })
    }

    /// Returns the root mean squares of the moment and the force at a joint, by its place in the geometry.
    fn root_mean_squares(&self, place: usize) -> [f64; 2] {
        let mut squares = [0.0; 2];
        for column in &self.columns {
            for (k, x) in column[6 * place..6 * place + 6].iter().enumerate() {
                squares[k / 3] += x * x;
            }
        }
        [squares[0].sqrt() * self.geometry.size, squares[1].sqrt()]
    }
}

/// Returns the root mean square of the assembly force `[N]` at the joint where it is greatest, in the pose of the file. A moment counts as a
/// force at the size of the mechanism, if that is more.
///
/// # Errors
/// Returns an [`Unsolved`] if the geometry has no values or its singular values do not converge.
///
/// # Complexity
/// O(j·(j·σ²)) for j joints and σ redundant constraints.
pub fn misfit_force(m: &Mechanism, state: StateId, accuracy: &Accuracy) -> Result<f64, Unsolved> {
    let response = Response::new(m, state, accuracy)?;
    let places = 0..response.geometry.joints.len();
    let forces = places.map(|place| {
        let [moment, force] = response.root_mean_squares(place);
        force.max(moment / response.geometry.size)
    });
    Ok(forces.fold(0.0, f64::max))
}

/// Returns the assembly forces of a state in the pose of the file. `seed` is that of the random assemblies.
///
/// # Errors
/// Returns an [`Unsolved`] if the geometry has no values or its singular values do not converge.
///
/// # Complexity
/// O(j·(j·σ²)) for j joints and σ redundant constraints, and O(j²) for each of 10,000 assemblies.
pub fn misfit(
    m: &Mechanism,
    state: StateId,
    accuracy: &Accuracy,
    seed: u64,
) -> Result<Misfit, Unsolved> {
    let response = Response::new(m, state, accuracy)?;
    let (geometry, columns) = (&response.geometry, &response.columns);
    let count = geometry.joints.len();
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut sizes = vec![[Vec::new(), Vec::new()]; count];
    let mut greatest = Vec::with_capacity(SAMPLES);
    for _ in 0..SAMPLES {
        let errors: Vec<f64> = columns.iter().map(|_| normal(&mut random)).collect();
        let mut most = 0.0_f64;
        for (n, sizes) in sizes.iter_mut().enumerate() {
            let sum = |k: usize| -> f64 {
                let terms = columns.iter().zip(&errors);
                terms.map(|(column, e)| column[6 * n + k] * e).sum()
            };
            let size = |from: usize| sum(from).hypot(sum(from + 1)).hypot(sum(from + 2));
            let (moment, force) = (size(0) * geometry.size, size(3));
            most = most.max(force);
            sizes[0].push(force);
            sizes[1].push(moment);
        }
        greatest.push(most);
    }
    let joints = geometry.joints.iter().zip(&mut sizes).enumerate();
    let joints = joints.map(|(place, (&joint, [force, moment]))| {
        let [of_moment, of_force] = response.root_mean_squares(place);
        JointMisfit {
            joint,
            force: spread(force, of_force),
            moment: spread(moment, of_moment),
        }
    });
    let below = greatest.iter().filter(|f| **f <= accuracy.hand_force);
    let square = greatest.iter().map(|f| f * f).sum::<f64>() / SAMPLES as f64;
    Ok(Misfit {
        joints: joints.collect(),
        by_hand: below.count() as f64 / SAMPLES as f64,
        force: spread(&mut greatest, square.sqrt()),
        stiffness: response.stiffness,
    })
}

/// Returns the mean and the 95 % quantile of a list, which is sorted, with its root mean square.
fn spread(all: &mut [f64], rms: f64) -> Spread {
    all.sort_by(f64::total_cmp);
    Spread {
        mean: all.iter().sum::<f64>() / all.len() as f64,
        rms,
        most: all[all.len() * 95 / 100],
    }
}

/// Returns a number of the standard normal distribution, by Box and Muller.
fn normal(random: &mut ChaCha8Rng) -> f64 {
    let mut unit = || (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
    let radius = (-2.0 * (1.0 - unit()).ln()).sqrt();
    radius * (std::f64::consts::TAU * unit()).cos()
}
