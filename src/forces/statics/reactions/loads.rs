//! Loads on the links of a mechanism in a pose: weights, inertia forces, and external forces and moments.

use crate::closure::drive::Driven;
use crate::geom::vector::{add, to_vector};
use crate::model::loads::{ExternalForce, Loads, acts_at, acts_in};
use crate::model::mechanism::{LinkId, Mechanism, StateId};
use crate::motion::pose::Pose;
use crate::statics::reactions::geometry::{Geometry, Six, force_wrench, wrench_power};
use crate::statics::reactions::inertia::{MovingMass, link_motions, moving_masses};
use crate::statics::reactions::unsolved::Unsolved;

/// Origin of a load.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LoadSource {
    /// Weight.
    Gravity,
    /// Inertia force and moment.
    Inertia,
    /// An external force.
    External,
}

/// A force at a point of a link, with a moment.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LinkLoad {
    /// The link.
    pub(crate) link: LinkId,
    /// Origin of the load.
    pub(crate) source: LoadSource,
    /// Its current point of action, from the geometry's middle, in its size.
    pub(crate) point: [f64; 3],
    /// The force `[N]`.
    pub(crate) force: [f64; 3],
    /// The additional moment `[N·m]`.
    pub(crate) moment: [f64; 3],
}

/// Returns weights, each followed by the inertia force of the link, then external moments and forces. Loads on the
/// frame, on links absent from the state and of other states are omitted.
///
/// `drive` is the first drive's position since the pose of the file, `[rad]` or in the file's unit, for forces that act
/// in a range of it. Ranges repeat after `period`.
fn loads_of_links(
    m: &Mechanism,
    loads: &Loads,
    geometry: &Geometry,
    pose: &Pose,
    (drive, period): (f64, Option<f64>),
    masses: &[MovingMass],
) -> Vec<LinkLoad> {
    let g = loads.gravity.as_ref().map_or([0.0; 3], to_vector);
    let mut out = Vec::new();
    for (link, of) in m.links_with_ids() {
        let Some(mass) = &of.mass else { continue };
        let load = |source, force, moment| LinkLoad {
            link,
            source,
            point: geometry.point_position(pose, link, to_vector(&mass.centre)),
            force,
            moment,
        };
        out.push(load(
            LoadSource::Gravity,
            g.map(|x| x * mass.mass),
            [0.0; 3],
        ));
        let own = masses.iter().filter(|x| x.link == link);
        out.extend(own.map(|x| load(LoadSource::Inertia, x.force, x.moment)));
    }
    let outside = |link, point, force, moment| LinkLoad {
        link,
        source: LoadSource::External,
        point,
        force,
        moment,
    };
    let here = |states: Option<&Vec<StateId>>| acts_in(states, geometry.state);
    let moments = loads.moments.iter().filter(|x| here(x.states.as_ref()));
    out.extend(moments.map(|x| outside(x.link, [0.0; 3], [0.0; 3], to_vector(&x.moment))));
    let now = |f: &&ExternalForce| here(f.states.as_ref()) && acts_at(f.range, drive, period);
    out.extend(loads.forces.iter().filter(now).map(|f| {
        let at = geometry.point_position(pose, f.link, to_vector(&f.point));
        outside(f.link, at, to_vector(&f.force), [0.0; 3])
    }));
    out.retain(|x| geometry.has_link(x.link));
    out
}

/// Returns the sum of the loads of each link about the geometry's middle, in planar mode without the parts out of the
/// plane.
fn sum_by_link(m: &Mechanism, geometry: &Geometry, loads: &[LinkLoad]) -> Vec<Six> {
    let mut out = vec![[0.0; 6]; m.links.len()];
    for x in loads {
        let moment = x.moment.map(|v| v / geometry.size);
        let wrench = geometry.carried_part(&force_wrench(x.point, x.force, moment));
        out[x.link] = add(out[x.link], wrench);
    }
    out
}

/// Returns weights, external forces and moments, by link, about the geometry's middle, if the first drive is `drive`
/// away from the pose of the file.
#[must_use]
pub fn link_loads(
    m: &Mechanism,
    loads: &Loads,
    geometry: &Geometry,
    pose: &Pose,
    drive: f64,
    period: Option<f64>,
) -> Vec<Six> {
    let all = loads_of_links(m, loads, geometry, pose, (drive, period), &[]);
    sum_by_link(m, geometry, &all)
}

/// Loads on a mechanism in a pose: those of the file, including inertia forces of the stated drive speeds.
#[derive(Debug)]
pub(crate) struct Borne {
    /// The pose in numbers.
    pub(crate) geometry: Geometry,
    /// The individual loads.
    pub(crate) loads: Vec<LinkLoad>,
    /// Motion of the links with mass.
    pub(crate) masses: Vec<MovingMass>,
    /// Power of the loads `[W]`.
    pub(crate) power: f64,
    /// Sums by link.
    pub(super) sums: Vec<Six>,
}

/// Returns the period of the first drive after which the ranges of forces repeat: one turn, if it turns.
#[must_use]
pub fn range_period(drives: &[Driven]) -> Option<f64> {
    let first = drives.first().filter(|(_, f)| !f.is_slide());
    first.map(|_| std::f64::consts::TAU)
}

impl Borne {
    /// Computes the loads at a pose, with the first drive `drive` away from the pose of the file.
    ///
    /// # Errors
    /// Returns an error if the drives cannot move at the given speeds, or if a link with a planar inertia rotates in space.
    pub(crate) fn new(
        m: &Mechanism,
        state: StateId,
        pose: &Pose,
        drive: f64,
        drives: &[Driven],
    ) -> Result<Borne, Unsolved> {
        let geometry = Geometry::new(m, state, pose)?;
        let moves = link_motions(m, &geometry, drives, &m.loads.drive_speeds)?;
        let masses = moving_masses(m, &geometry, pose, &moves)?;
        let at = (drive, range_period(drives));
        let loads = loads_of_links(m, &m.loads, &geometry, pose, at, &masses);
        let sums = sum_by_link(m, &geometry, &loads);
        let powers = moves
            .velocity
            .iter()
            .zip(&sums)
            .map(|(v, w)| wrench_power(v, w));
        Ok(Borne {
            power: powers.sum::<f64>() * geometry.size,
            loads,
            masses,
            sums,
            geometry,
        })
    }
}
