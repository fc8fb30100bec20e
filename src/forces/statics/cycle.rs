//! A planar mechanism's statics over its cycle: structure, motion, loads, and reactions by every method.

use crate::model::loads::Stroke;
use crate::model::mechanism::{Mechanism, StateId};
use crate::statics::assur::{AssurError, Decomposition, alternatives, decompose};
use crate::statics::contour_group::pose::GroupPose;
use crate::statics::contour_group::solutions::GroupSolutions;
use crate::statics::contour_group::{ContourGroup, recognise};
use crate::statics::kinetostatics::{
    Equilibrium, Load, LoadSource, PlanarLoads, by_groups, power, whole,
};
use crate::statics::planar::{PairId, PairKind, PlanarError, PlanarMechanism};
use crate::statics::planar_motion::{DeadPoint, Instant, Motion};
use crate::statics::pose::Linkage;
use thiserror::Error;

/// Why there is no statics of a mechanism in its plane.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum PlanarStaticsError {
    /// It is not planar.
    #[error(transparent)]
    Planar(#[from] PlanarError),
    /// Its drives do not make it determinate.
    #[error(transparent)]
    Assur(#[from] AssurError),
}

/// Loads and reactions at one position of the drive.
#[derive(Debug, Clone)]
pub struct Moment {
    /// Where the mechanism is and how it moves.
    pub instant: Instant,
    /// The loads.
    pub loads: Vec<Load>,
    /// Reactions of all pairs by the equilibrium of all bodies at once.
    pub whole: Option<Equilibrium>,
    /// The same group by group, drives last.
    pub by_groups: Option<Vec<Equilibrium>>,
    /// The four-link groups with a closed contour.
    pub groups: Vec<GroupSolutions>,
    /// Power of loads and inertia `[W]`.
    pub load_power: f64,
    /// Power of the drives `[W]`, from the reactions; less than nothing of the other.
    pub drive_power: f64,
}

/// The statics of a mechanism.
#[derive(Debug, Clone)]
pub struct Statics {
    /// The planar mechanism.
    pub linkage: Linkage,
    /// Its drives and groups.
    pub decomposition: Decomposition,
    /// Condition of each group's equations at the pose of the file.
    pub conditions: Vec<f64>,
    /// The groups that the δ-point method solves, with their indices.
    pub contour_groups: Vec<(usize, ContourGroup)>,
    /// The loads it was asked to bear.
    pub loads: PlanarLoads,
    /// Position by position.
    pub moments: Vec<Moment>,
    /// Where the motion ended early, if it did.
    pub dead: Option<DeadPoint>,
}

impl Statics {
    /// Whether the first drive slides; its position is in metres then.
    #[must_use]
    pub fn drive_slides(&self) -> bool {
        let first = self.decomposition.drives.first();
        first.is_some_and(|&p| self.linkage.mechanism.pairs[p].kind == PairKind::Sliding)
    }

    /// The first four-link group with a closed contour, in the pose in which forces from outside load it most.
    #[must_use]
    pub fn heaviest_contour_group(&self) -> Option<&GroupPose> {
        let outside = |l: &&Load| l.source == LoadSource::External;
        let weight = |g: &GroupPose| -> f64 {
            let forces = g.loads.iter().filter(outside).map(|l| l.force);
            forces.map(|f| f[0].hypot(f[1])).sum()
        };
        let first = self.moments.iter().filter_map(|x| x.groups.first());
        let poses = first.map(|g| &g.pose);
        poses.max_by(|a, b| weight(a).total_cmp(&weight(b)))
    }
}

/// Takes a state of a mechanism through a stroke of its first drive, or the pose of the file alone. Drive positions count
/// from the pose of the file; turns about the plane's normal.
///
/// # Errors
/// Where the mechanism is not planar, or its drives leave it indeterminate.
///
/// # Complexity
/// O(steps · n³) for n bodies.
pub fn statics(
    mechanism: &Mechanism,
    state: StateId,
    stroke: Option<Stroke>,
) -> Result<Statics, PlanarStaticsError> {
    let positions = stroke.map_or_else(|| vec![0.0], |s| s.positions());
    statics_at(mechanism, state, &positions)
}

/// The same at positions of the first drive in any order, `[rad]` or the file's unit.
///
/// # Errors
/// As [`statics`].
pub(crate) fn statics_at(
    mechanism: &Mechanism,
    state: StateId,
    positions: &[f64],
) -> Result<Statics, PlanarStaticsError> {
    let planar = PlanarMechanism::new(mechanism, state)?;
    let drives = planar.drives();
    let decomposition = decompose(&planar, &drives)?;
    let linkage = Linkage::new(planar);
    let metres = linkage.mechanism.metres;
    let unit = |i: usize| match drives.get(i).map(|&p| linkage.mechanism.pairs[p].kind) {
        Some(PairKind::Sliding) => metres,
        _ => 1.0,
    };
    let stated = mechanism.loads.drive_speeds.iter().enumerate();
    let speeds: Vec<f64> = stated.map(|(i, s)| s * unit(i)).collect();
    let slides = drives
        .first()
        .is_some_and(|&p| linkage.mechanism.pairs[p].kind == PairKind::Sliding);
    let loads = PlanarLoads::new(mechanism, state, &linkage, slides);
    let positions: Vec<f64> = positions.iter().map(|x| x * unit(0)).collect();
    let motion = Motion::new(&linkage, &decomposition, &speeds);
    let conditions = motion.conditions(&linkage.home());
    let (instants, dead) = motion.follow(&positions);
    let found = decomposition.groups.iter().enumerate();
    let contour_groups: Vec<(usize, ContourGroup)> = found
        .filter_map(|(i, g)| Some((i, recognise(&linkage.mechanism, g)?)))
        .collect();
    let moments = instants
        .into_iter()
        .map(|now| {
            moment(
                &linkage,
                &decomposition,
                &contour_groups,
                &loads,
                &speeds,
                now,
            )
        })
        .collect();
    Ok(Statics {
        conditions,
        contour_groups,
        loads,
        moments,
        dead,
        decomposition,
        linkage,
    })
}

fn moment(
    linkage: &Linkage,
    d: &Decomposition,
    contour_groups: &[(usize, ContourGroup)],
    planar_loads: &PlanarLoads,
    speeds: &[f64],
    instant: Instant,
) -> Moment {
    let loads = planar_loads.at(linkage, &instant);
    let whole = whole(linkage, d, &instant, &loads);
    let groups = contour_groups.iter().map(|(group, letters)| {
        let pose = GroupPose::new(linkage, letters, &instant.pose, &loads);
        GroupSolutions::new(*group, pose)
    });
    let effort = |i: usize| {
        let pair = d.drives[i];
        let found = whole.as_ref()?.reactions.iter().find(|r| r.pair == pair)?;
        found.effort
    };
    let speed = |i: usize| speeds.get(i).copied().unwrap_or(0.0);
    let drive_power = (0..d.drives.len())
        .map(|i| effort(i).unwrap_or(f64::NAN) * speed(i))
        .sum();
    Moment {
        by_groups: by_groups(linkage, d, &instant, &loads),
        groups: groups.collect(),
        load_power: power(&instant, &loads),
        drive_power,
        whole,
        loads,
        instant,
    }
}

/// The structure of a mechanism under one drive.
#[derive(Debug, Clone)]
pub struct DrivenStructure {
    /// The pair that takes the place of the first drive.
    pub drive: PairId,
    /// The decomposition, and the condition of each group's equations at the pose of the file; or why there is none.
    pub found: Result<(Decomposition, Vec<f64>), AssurError>,
}

/// The structure under every possible drive in place of the first, those at the frame first.
///
/// # Errors
/// Where the mechanism is not planar.
pub fn structures(
    mechanism: &Mechanism,
    state: StateId,
) -> Result<(PlanarMechanism, Vec<DrivenStructure>), PlanarError> {
    let planar = PlanarMechanism::new(mechanism, state)?;
    let linkage = Linkage::new(planar.clone());
    let all = alternatives(&planar, &planar.drives()).into_iter();
    let found = all.map(|(drive, d)| DrivenStructure {
        drive,
        found: d.map(|d| {
            let conditions = Motion::new(&linkage, &d, &[]).conditions(&linkage.home());
            (d, conditions)
        }),
    });
    Ok((planar, found.collect()))
}
