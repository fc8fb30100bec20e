//! A planar mechanism's statics over its cycle: structure, motion, loads, and reactions by every method.

use crate::closure::drive::{Driven, driven_freedoms};
use crate::geom::vector::dot;
use crate::model::loads::Stroke;
use crate::model::mechanism::{Mechanism, StateId};
use crate::motion::pose::Pose as PoseOfLinks;
use crate::statics::assur::{AssurError, Decomposition, decompose_alternatives, decompose_groups};
use crate::statics::contour_group::pose::GroupPose;
use crate::statics::contour_group::solutions::GroupSolutions;
use crate::statics::contour_group::{ContourGroup, recognise_letters};
use crate::statics::kinetostatics::{
    LinkInertia, Load, Reaction, Worth, link_inertias, planar_loads, planar_reactions,
    solution_worth,
};
use crate::statics::planar::{BodyId, PairId, PairKind, PlanarError, PlanarMechanism};
use crate::statics::pose::{Linkage, Pose};
use crate::statics::reactions::contact::Contacts;
use crate::statics::reactions::cycle::follow_to;
use crate::statics::reactions::geometry::Geometry;
use crate::statics::reactions::loads::Borne;
use crate::statics::reactions::unsolved::Unsolved;
use thiserror::Error;

/// Condition number above which a group is at a dead point.
const WORST: f64 = 1e12;

/// Reason why a mechanism has no statics in its plane.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum PlanarStaticsError {
    /// It is not planar.
    #[error(transparent)]
    Planar(#[from] PlanarError),
    /// Its drives do not make it determinate.
    #[error(transparent)]
    Assur(#[from] AssurError),
    /// Its geometry or loads have no numerical value.
    #[error(transparent)]
    Unsolved(#[from] Unsolved),
}

/// Loads and reactions at one position of the drive.
#[derive(Debug, Clone)]
pub struct Moment {
    /// Position of the first drive `[rad]` or `[m]`.
    pub drive: f64,
    /// Position of every body.
    pub pose: Pose,
    /// The loads.
    pub loads: Vec<Load>,
    /// Motion of the links with mass.
    pub links: Vec<LinkInertia>,
    /// Reactions of all pairs.
    pub reactions: Vec<Reaction>,
    /// Their reliability in the equilibrium of all bodies at once.
    pub worth: Worth,
    /// Their reliability group by group, drives last.
    pub by_groups: Vec<Worth>,
    /// The four-link groups with a closed contour.
    pub groups: Vec<GroupSolutions>,
    /// Power of loads and inertia `[W]`.
    pub load_power: f64,
    /// Power of the drives `[W]`, from the reactions. In balance it is minus `load_power`.
    pub drive_power: f64,
}

/// A position at which a mechanism cannot move further.
#[derive(Debug, Clone)]
pub struct DeadPoint {
    /// Position of the first drive `[rad]` or `[m]`.
    pub drive: f64,
    /// The group that stops it, as an index into [`Decomposition::groups`]; `None` for the drives themselves.
    pub group: Option<usize>,
    /// Ratio of the largest to the smallest singular value of that group's equations at the last pose.
    pub condition: f64,
    /// The last pose reached.
    pub pose: Pose,
}

/// The statics of a mechanism.
#[derive(Debug, Clone)]
pub struct Statics {
    /// The planar mechanism.
    pub linkage: Linkage,
    /// Its drives and groups.
    pub decomposition: Decomposition,
    /// Condition number of each group's equations at the pose of the file.
    pub conditions: Vec<f64>,
    /// The groups that the δ-point method solves, with their indices.
    pub contour_groups: Vec<(usize, ContourGroup)>,
    /// Whether the file states a mass, a force or a moment that acts on a body.
    pub loaded: bool,
    /// Results position by position.
    pub moments: Vec<Moment>,
    /// Position at which the motion ended early, if it did.
    pub dead: Option<DeadPoint>,
}

impl Statics {
    /// Returns true if the first drive slides; its position is then in metres.
    #[must_use]
    pub fn drive_slides(&self) -> bool {
        let first = self.decomposition.drives.first();
        first.is_some_and(|&p| self.linkage.mechanism.pairs[p].kind == PairKind::Sliding)
    }

    /// Converts a position of the first drive, `[rad]` or the file's unit, to `[rad]` or `[m]`.
    fn in_metres(&self, at: f64) -> f64 {
        if self.drive_slides() {
            at * self.linkage.mechanism.metres
        } else {
            at
        }
    }

    /// Returns the loads and reactions in a pose, with the first drive `at` away from that of the file.
    ///
    /// # Errors
    /// Returns an [`Unsolved`]; [`Unsolved::Stuck`] if a group is singular to working precision.
    fn solve_moment(
        &self,
        m: &Mechanism,
        state: StateId,
        held: &[Driven],
        (at, of_links): (f64, &PoseOfLinks),
    ) -> Result<Moment, Unsolved> {
        let (linkage, d) = (&self.linkage, &self.decomposition);
        let borne = Borne::new(m, state, of_links, at, held)?;
        let pose = linkage.place_bodies(of_links, &link_turns(linkage, &borne.geometry, of_links));
        let singular = |c: f64| c > WORST;
        if group_conditions(linkage, &pose, d)
            .into_iter()
            .any(singular)
        {
            return Err(Unsolved::Stuck);
        }
        let solution = borne.solve_loads(m, held, Contacts::AsJoints)?;
        let loads = planar_loads(linkage, &borne);
        let reactions = planar_reactions(linkage, &pose, &solution.reactions);
        let worth = |bodies: &[BodyId], pairs: &[PairId]| {
            solution_worth(
                linkage,
                &pose,
                (bodies, pairs, &d.drives),
                &loads,
                &reactions,
            )
        };
        let frame = linkage.mechanism.frame;
        let bodies = (0..linkage.mechanism.bodies.len()).filter(|&b| b != frame);
        let pairs: Vec<PairId> = (0..linkage.mechanism.pairs.len()).collect();
        let groups = d.groups.iter().map(|g| worth(&g.bodies, &g.all_pairs()));
        let unit = |p: PairId| match linkage.mechanism.pairs[p].kind {
            PairKind::Sliding => linkage.mechanism.metres,
            PairKind::Turning | PairKind::Rigid => 1.0,
        };
        let power = |(&p, speed): (&PairId, &f64)| {
            reactions[p].effort.unwrap_or(f64::NAN) * speed * unit(p)
        };
        let powers = d.drives.iter().zip(&m.loads.drive_speeds).map(power);
        let solved = self.contour_groups.iter().map(|(group, letters)| {
            let pose = GroupPose::new(linkage, letters, &pose, &loads);
            GroupSolutions::new(*group, pose)
        });
        Ok(Moment {
            drive: self.in_metres(at),
            links: link_inertias(linkage, &borne),
            worth: worth(&bodies.collect::<Vec<_>>(), &pairs),
            by_groups: groups.chain([worth(&d.driven, &d.driven_pairs)]).collect(),
            groups: solved.collect(),
            load_power: borne.power,
            drive_power: powers.fold(0.0, |sum, x| sum + x),
            loads,
            reactions,
            pose,
        })
    }

    /// Returns the last pose reached, with the group whose equations have the worst condition there.
    fn dead_point(
        &self,
        m: &Mechanism,
        state: StateId,
        (at, of_links): (f64, &PoseOfLinks),
    ) -> Result<DeadPoint, Unsolved> {
        let geometry = Geometry::new(m, state, of_links)?;
        let turns = link_turns(&self.linkage, &geometry, of_links);
        let pose = self.linkage.place_bodies(of_links, &turns);
        let conditions = group_conditions(&self.linkage, &pose, &self.decomposition);
        let all = conditions.into_iter().enumerate();
        let worst = all.max_by(|a, b| a.1.total_cmp(&b.1));
        Ok(DeadPoint {
            drive: self.in_metres(at),
            group: worst.map(|w| w.0),
            condition: worst.map_or(f64::INFINITY, |w| w.1),
            pose,
        })
    }
}

/// Takes a state of a mechanism through a stroke of its first drive, or only the pose of the file. Drive positions are
/// relative to the pose of the file, with turns about the plane's normal.
///
/// # Errors
/// Returns an error if the mechanism is not planar, or if its drives leave it indeterminate.
///
/// # Complexity
/// O(steps · n³) for n bodies.
///
/// # Examples
/// ```
/// use ozols::{model::{loads::Stroke, mechanism::StateId}, statics::cycle::planar_statics};
/// let stroke = Stroke { from: 0.0, to: std::f64::consts::TAU, steps: 12 };
/// let found = planar_statics(&ozols::built_in("four-bar")?, StateId::FREE, Some(stroke))?;
/// assert_eq!(found.moments.len(), 13);
/// assert!(found.dead.is_none()); // The crank turns fully.
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn planar_statics(
    mechanism: &Mechanism,
    state: StateId,
    stroke: Option<Stroke>,
) -> Result<Statics, PlanarStaticsError> {
    let positions = stroke.map_or_else(|| vec![0.0], |s| s.positions());
    statics_at(mechanism, state, &positions)
}

/// Solves the statics at positions of the first drive in any order, `[rad]` or the file's unit.
///
/// # Errors
/// Returns an error in the same cases as [`planar_statics`].
pub(crate) fn statics_at(
    mechanism: &Mechanism,
    state: StateId,
    positions: &[f64],
) -> Result<Statics, PlanarStaticsError> {
    let planar = PlanarMechanism::new(mechanism, state)?;
    let drives = planar.driven_pairs();
    let decomposition = decompose_groups(&planar, &drives)?;
    let linkage = Linkage::new(planar);
    let m = linkage.mechanism.as_driven(mechanism);
    let held = driven_freedoms(&m, state);
    let followed = follow_to(&m, state, &held, positions)?;
    let mut poses = followed.poses;
    if positions.first() > positions.last() {
        poses.reverse();
    }
    let found = decomposition.groups.iter().enumerate();
    let contour_groups: Vec<(usize, ContourGroup)> = found
        .filter_map(|(i, g)| Some((i, recognise_letters(&linkage.mechanism, g)?)))
        .collect();
    let conditions = group_conditions(&linkage, &linkage.home_pose(), &decomposition);
    let is_body = |link| linkage.mechanism.body_of(link).is_some();
    let stated = m.loads.in_state(state);
    let loaded = stated.forces.iter().any(|f| is_body(f.link))
        || stated.moments.iter().any(|x| is_body(x.link))
        || m.links_with_ids()
            .any(|(l, link)| link.mass.is_some() && is_body(l));
    let mut out = Statics {
        linkage,
        decomposition,
        conditions,
        contour_groups,
        loaded,
        moments: Vec::new(),
        dead: None,
    };
    for (at, pose) in &poses {
        match out.solve_moment(&m, state, &held, (*at, pose)) {
            Err(Unsolved::Stuck | Unsolved::Moves { .. }) => {
                out.dead = Some(out.dead_point(&m, state, (*at, pose))?);
                return Ok(out);
            }
            found => out.moments.push(found?),
        }
    }
    if let Some((at, pose)) = &followed.last {
        out.dead = Some(out.dead_point(&m, state, (*at, pose))?);
    }
    Ok(out)
}

/// Returns the condition number of each group's equations in a pose, in order of the groups.
fn group_conditions(linkage: &Linkage, pose: &Pose, d: &Decomposition) -> Vec<f64> {
    let groups = d.groups.iter();
    groups
        .map(|g| linkage.equations_condition(pose, &g.bodies, &g.all_pairs(), &d.drives))
        .collect()
}

/// Returns the angles by which the links have turned since the pose of the file, about the plane's normal.
fn link_turns(linkage: &Linkage, geometry: &Geometry, pose: &PoseOfLinks) -> Vec<f64> {
    let moved: Vec<f64> = pose.columns.iter().map(|c| c.moved).collect();
    let twists = geometry.link_twists(pose.links.len(), &moved);
    let about = |[x, y, z, ..]: [f64; 6]| dot(linkage.mechanism.axes[2], [x, y, z]);
    twists.into_iter().map(about).collect()
}

/// The structure of a mechanism under one drive.
#[derive(Debug, Clone)]
pub struct DrivenStructure {
    /// The pair that replaces the first drive.
    pub drive: PairId,
    /// The decomposition, and the condition number of each group's equations at the pose of the file, or the reason why
    /// there is none.
    pub found: Result<(Decomposition, Vec<f64>), AssurError>,
}

/// Returns the structure under every possible drive in place of the first, those at the frame first.
///
/// # Errors
/// Returns an error if the mechanism is not planar.
///
/// # Examples
/// ```
/// use ozols::{model::mechanism::StateId, statics::cycle::drive_structures};
/// let (_, all) = drive_structures(&ozols::built_in("four-bar")?, StateId::FREE)?;
/// // Whichever hinge is driven, the rest is a group of class II.
/// assert!(all.iter().all(|s| s.found.as_ref().is_ok_and(|(d, _)| d.highest_class() == 2)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn drive_structures(
    mechanism: &Mechanism,
    state: StateId,
) -> Result<(PlanarMechanism, Vec<DrivenStructure>), PlanarError> {
    let planar = PlanarMechanism::new(mechanism, state)?;
    let linkage = Linkage::new(planar.clone());
    let all = decompose_alternatives(&planar, &planar.driven_pairs()).into_iter();
    let found = all.map(|(drive, d)| DrivenStructure {
        drive,
        found: d.map(|d| {
            let conditions = group_conditions(&linkage, &linkage.home_pose(), &d);
            (d, conditions)
        }),
    });
    Ok((planar, found.collect()))
}
