//! Assembly forces of inaccurate joints. They close the loops of a redundant mechanism whose joints are made and mounted within tolerances.
//!
//! Each joint has a random shift and turn. Reactions of elastic joints are linear in them, r = R·e, so one solution for each component of e
//! gives the matrix R. For independent errors with variances Σ, the covariance of the reactions is R·Σ·Rᵀ. Without redundant constraints R
//! is zero: a determinate mechanism assembles without force, which is the argument of [Pogrebnyak 2018] for it.

use crate::model::loads::{Loads, Misalignment, Stiffness};
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::motion::pose::Pose;
use crate::statics::reactions::equations::{System, Transmitted, elastic_reactions};
use crate::statics::reactions::geometry::Geometry;
use crate::statics::reactions::unsolved::Unsolved;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use serde::Serialize;

/// Accuracy of every joint. Errors of each axis are normal and independent; a tolerance is three standard deviations.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Tolerances {
    /// Tolerance of the position `[m]`.
    pub position: f64,
    /// Tolerance of the direction `[rad]`.
    pub angle: f64,
}

/// The mean and the 95 % quantile of a magnitude.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spread {
    /// The mean.
    pub mean: f64,
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

/// Returns the assembly forces of a state in the pose of the file. `hand` is the force `[N]` that a person applies, and `seed` that of
/// the random assemblies.
///
/// # Errors
/// Returns an [`Unsolved`] if the geometry has no values or its singular values do not converge.
///
/// # Complexity
/// O(j·(j·σ²)) for j joints and σ redundant constraints, and O(j²) for each of 10,000 assemblies.
pub fn misfit(
    m: &Mechanism,
    state: StateId,
    tolerances: Tolerances,
    hand: f64,
    seed: u64,
) -> Result<Misfit, Unsolved> {
    let geometry = Geometry::new(m, state, &Pose::of_file(m, state)?)?;
    let stresses = System::new(&geometry, &[])?.self_stresses(m.joints.len());
    let mut loads = Loads {
        stiffness: m.loads.stiffness.clone(),
        ..Loads::default()
    };
    if !loads.stiffness.iter().any(|(name, _)| name == "default") {
        loads.stiffness.push(("default".to_owned(), USUAL));
    }
    // Each column has the reactions for one standard deviation of one component of a joint's error.
    let mut columns: Vec<Vec<f64>> = Vec::new();
    for &joint in &geometry.joints {
        for component in 0..6 {
            let mut off = Misalignment {
                joint,
                turn: [0.0; 3],
                shift: [0.0; 3],
            };
            match component {
                0..3 => off.turn[component] = tolerances.angle / 3.0,
                _ => off.shift[component - 3] = tolerances.position / 3.0,
            }
            loads.misalignments = vec![off];
            let still = Transmitted::of_joints(&geometry, vec![[0.0; 6]; m.joints.len()]);
            if let Some((of, _)) = elastic_reactions(m, &geometry, &loads, still, &stresses) {
                columns.push(of.flat_values(&geometry));
            }
        }
    }
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
    let joints = geometry.joints.iter().zip(&mut sizes);
    let joints = joints.map(|(&joint, [force, moment])| JointMisfit {
        joint,
        force: spread(force),
        moment: spread(moment),
    });
    let below = greatest.iter().filter(|f| **f <= hand).count();
    Ok(Misfit {
        joints: joints.collect(),
        by_hand: below as f64 / SAMPLES as f64,
        force: spread(&mut greatest),
        stiffness: loads
            .stiffness
            .iter()
            .find(|(name, _)| name == "default")
            .map_or(USUAL, |(_, s)| *s),
    })
}

/// Returns the mean and the 95 % quantile of a list, which is sorted.
fn spread(all: &mut [f64]) -> Spread {
    all.sort_by(f64::total_cmp);
    Spread {
        mean: all.iter().sum::<f64>() / all.len() as f64,
        most: all[all.len() * 95 / 100],
    }
}

/// Returns a number of the standard normal distribution, by Box and Muller.
fn normal(random: &mut ChaCha8Rng) -> f64 {
    let mut unit = || (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
    let radius = (-2.0 * (1.0 - unit()).ln()).sqrt();
    radius * (std::f64::consts::TAU * unit()).cos()
}
