//! Loads of a moving planar mechanism and the reactions of its pairs, by the equilibrium of every body.
//!
//! D'Alembert: with the inertia forces added, each body is in equilibrium. Three equations a body, two unknowns a pair
//! (force of a turning pair; normal force and moment of a sliding one) and one more a drive.

use crate::geom::{Reals, Scalars};
use crate::model::loads::{Inertia, acts_at};
use crate::model::mechanism::{Mechanism, StateId};
pub use crate::statics::Reaction;
use crate::statics::assur::Decomposition;
use crate::statics::inertia::{BodyMass, link_inertias};
use crate::statics::planar::{BodyId, PairId, PairKind};
use crate::statics::planar_motion::Instant;
use crate::statics::pose::{Linkage, Pose, cross, dot, minus, plus, quarter};
use crate::statics::{DenseSystem, greatest, over_load, rounding};

/// Where a load comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LoadSource {
    /// Weight.
    Gravity,
    /// Inertia force and moment.
    Inertia,
    /// A force from outside.
    External,
}

/// A force at a point of a body, with a moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Load {
    /// The body.
    pub body: BodyId,
    /// Where it comes from.
    pub source: LoadSource,
    /// Where it acts now `[m]`.
    pub point: [f64; 2],
    /// The force `[N]`.
    pub force: [f64; 2],
    /// The moment besides `[N·m]`.
    pub moment: f64,
}

impl Load {
    /// Moment about a point `[N·m]`.
    #[must_use]
    pub(crate) fn moment_about(&self, point: [f64; 2]) -> f64 {
        self.moment + cross(minus(self.point, point), self.force)
    }
}

/// A force from outside in the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanarForce {
    /// The body.
    pub body: BodyId,
    /// Its point at the pose of the file `[m]`.
    pub point: [f64; 2],
    /// The force `[N]`.
    pub force: [f64; 2],
    /// The range of the first drive's position it acts in `[rad]` or `[m]`.
    pub range: Option<[f64; 2]>,
    /// The range comes again after this much: a whole turn where the drive turns.
    pub period: Option<f64>,
}

/// What a mechanism carries, in its plane.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PlanarLoads {
    /// Acceleration of gravity `[m/s²]`.
    pub gravity: [f64; 2],
    /// Mass data by body.
    pub masses: Vec<Option<BodyMass>>,
    /// Forces from outside.
    pub forces: Vec<PlanarForce>,
    /// Moments from outside, about the plane's normal `[N·m]`.
    pub moments: Vec<(BodyId, f64)>,
    /// How many misalignments the file states.
    pub misalignments: usize,
}

impl PlanarLoads {
    /// The loads a file states for a state, seen in the plane; parts out of it are left out.
    #[must_use]
    pub fn new(
        mechanism: &Mechanism,
        state: StateId,
        linkage: &Linkage,
        drive_slides: bool,
    ) -> PlanarLoads {
        let stated = mechanism.loads.in_state(state);
        let m = &linkage.mechanism;
        let real = |v: &[crate::geom::expr::Expr; 3]| [v[0].to_f64(), v[1].to_f64(), v[2].to_f64()];
        let normal = m.axes[2];
        let masses = m.bodies.iter().map(|b| {
            let mass = mechanism.links[b.link?].mass.as_ref()?;
            let inertia = match mass.inertia {
                None => 0.0,
                Some(Inertia::Plane(i)) => i,
                Some(Inertia::Principal(i)) => (0..3).map(|k| i[k] * normal[k] * normal[k]).sum(),
                Some(Inertia::Tensor([xx, yy, zz, xy, yz, zx])) => {
                    let rows = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
                    Reals.dot(normal, rows.map(|r| Reals.dot(r, normal)))
                }
            };
            Some(BodyMass {
                mass: mass.mass,
                centre: m.flat(real(&mass.centre)),
                inertia,
            })
        });
        let unit = if drive_slides { m.metres } else { 1.0 };
        let forces = stated.forces.iter().filter_map(|f| {
            Some(PlanarForce {
                body: m.body_of(f.link)?,
                point: m.flat(real(&f.point)),
                force: m.across(real(&f.force)),
                range: f.range.map(|r| r.map(|x| x * unit)),
                period: (!drive_slides).then_some(std::f64::consts::TAU),
            })
        });
        let moments = stated
            .moments
            .iter()
            .filter_map(|x| Some((m.body_of(x.link)?, Reals.dot(normal, real(&x.moment)))));
        PlanarLoads {
            gravity: mechanism
                .loads
                .gravity
                .as_ref()
                .map_or([0.0; 2], |g| m.across(real(g))),
            masses: masses.collect(),
            forces: forces.collect(),
            moments: moments.collect(),
            misalignments: mechanism.loads.misalignments.len(),
        }
    }

    /// The loads at an instant: weights, inertia forces and the forces whose range it is in. Those on the frame are
    /// left out.
    #[must_use]
    pub fn at(&self, linkage: &Linkage, now: &Instant) -> Vec<Load> {
        let mut out = Vec::new();
        for x in link_inertias(&self.masses, linkage, now) {
            let load = |source, force, moment| Load {
                body: x.body,
                source,
                point: x.centre,
                force,
                moment,
            };
            let mass = self.masses[x.body].map_or(0.0, |m| m.mass);
            out.push(load(
                LoadSource::Gravity,
                self.gravity.map(|g| g * mass),
                0.0,
            ));
            out.push(load(LoadSource::Inertia, x.force, x.moment));
        }
        for &(body, moment) in &self.moments {
            if body != linkage.mechanism.frame {
                out.push(Load {
                    body,
                    source: LoadSource::External,
                    point: [now.pose[body][0], now.pose[body][1]],
                    force: [0.0; 2],
                    moment,
                });
            }
        }
        for f in &self.forces {
            if acts_at(f.range, now.drive, f.period) && f.body != linkage.mechanism.frame {
                out.push(Load {
                    body: f.body,
                    source: LoadSource::External,
                    point: linkage.point(&now.pose, f.body, f.point),
                    force: f.force,
                    moment: 0.0,
                });
            }
        }
        out
    }
}

/// Reactions of some pairs with what the solution is worth.
#[derive(Debug, Clone, PartialEq)]
pub struct Equilibrium {
    /// The reactions, in order of the pairs solved for.
    pub reactions: Vec<Reaction>,
    /// Ratio of the greatest and smallest singular values of the equations, moments divided by the mechanism's size.
    pub condition: f64,
    /// Greatest force `[N]`, or moment by the mechanism's size, left over in an equation, over the greatest load.
    pub residual: f64,
}

/// A unit of what a pair can pass on.
struct UnitReaction {
    pair: PairId,
    /// Where the pair is.
    point: [f64; 2],
    /// Force on the second body.
    force: [f64; 2],
    /// Moment on it about the point.
    moment: f64,
    /// Whether the pair's drive gives it.
    drives: bool,
}

/// The unit reactions of a pair, the drive's last.
fn unit_reactions(
    linkage: &Linkage,
    pose: &Pose,
    pair: PairId,
    drive: bool,
) -> impl Iterator<Item = UnitReaction> + use<> {
    let point = linkage.place(pose, pair);
    let along = linkage.along(pose, pair);
    let (x, y, couple) = (
        ([1.0, 0.0], 0.0),
        ([0.0, 1.0], 0.0),
        ([0.0; 2], linkage.size),
    );
    let wrenches = match (linkage.mechanism.pairs[pair].kind, drive) {
        (PairKind::Turning, false) => vec![x, y],
        (PairKind::Turning, true) | (PairKind::Rigid, _) => vec![x, y, couple],
        (PairKind::Sliding, false) => vec![couple, (quarter(along), 0.0)],
        (PairKind::Sliding, true) => vec![couple, (quarter(along), 0.0), (along, 0.0)],
    };
    let each = wrenches.into_iter().enumerate();
    each.map(move |(k, (force, moment))| UnitReaction {
        pair,
        point,
        force,
        moment,
        drives: drive && k == 2,
    })
}

/// Where a body's own origin is now.
fn origin(pose: &Pose, body: BodyId) -> [f64; 2] {
    [pose[body][0], pose[body][1]]
}

/// Solves the equilibrium of some bodies for the reactions of some pairs, three equations a body. The pairs' constraints
/// (drives included) must be three times as many as the bodies.
///
/// `None` where the equations are singular.
///
/// # Complexity
/// O(n³) for n bodies.
#[must_use]
pub(crate) fn equilibrium(
    linkage: &Linkage,
    now: &Instant,
    bodies: &[BodyId],
    pairs: &[PairId],
    drives: &[PairId],
    loads: &[Load],
) -> Option<Equilibrium> {
    let n = 3 * bodies.len();
    let unknowns: Vec<UnitReaction> = pairs
        .iter()
        .flat_map(|&p| unit_reactions(linkage, &now.pose, p, drives.contains(&p)))
        .collect();
    if unknowns.len() != n {
        return None;
    }
    let rows = left_sides(linkage, &now.pose, bodies, &unknowns);
    let right = right_sides(linkage, &now.pose, bodies, loads);
    let system = DenseSystem::new(&rows);
    let x = system.solve(&right)?;
    let load = greatest(&right);
    let left_over = system.residual(&x, &right);
    let rounding = rounding(left_over, load.max(greatest(&x)), n);
    let reactions = pairs.iter().map(|&pair| {
        let of_pair = unknowns.iter().zip(&x).filter(|(u, _)| u.pair == pair);
        summed(linkage, &now.pose, pair, of_pair).without(rounding, linkage)
    });
    Some(Equilibrium {
        reactions: reactions.collect(),
        condition: system.condition(),
        residual: over_load(left_over, load),
    })
}

/// The equations of bodies, three each, by what a unit of each unknown adds to them.
fn left_sides(
    linkage: &Linkage,
    pose: &Pose,
    bodies: &[BodyId],
    unknowns: &[UnitReaction],
) -> Vec<Vec<f64>> {
    let mut rows = vec![vec![0.0; unknowns.len()]; 3 * bodies.len()];
    for (column, u) in unknowns.iter().enumerate() {
        for (end, sign) in [(0, -1.0), (1, 1.0)] {
            let body = linkage.mechanism.pairs[u.pair].bodies[end];
            let Some(at) = bodies.iter().position(|&b| b == body) else {
                continue;
            };
            let turn = u.moment + cross(minus(u.point, origin(pose, body)), u.force);
            rows[3 * at][column] += sign * u.force[0];
            rows[3 * at + 1][column] += sign * u.force[1];
            rows[3 * at + 2][column] += sign * turn / linkage.size;
        }
    }
    rows
}

/// What the loads leave to the reactions in the same equations.
fn right_sides(linkage: &Linkage, pose: &Pose, bodies: &[BodyId], loads: &[Load]) -> Vec<f64> {
    let mut right = vec![0.0; 3 * bodies.len()];
    for load in loads {
        if let Some(at) = bodies.iter().position(|&b| b == load.body) {
            right[3 * at] -= load.force[0];
            right[3 * at + 1] -= load.force[1];
            right[3 * at + 2] -= load.moment_about(origin(pose, load.body)) / linkage.size;
        }
    }
    right
}

/// The reaction of a pair as the sum of its unit reactions, each so many times.
fn summed<'u>(
    linkage: &Linkage,
    pose: &Pose,
    pair: PairId,
    parts: impl Iterator<Item = (&'u UnitReaction, &'u f64)>,
) -> Reaction {
    let mut out = Reaction {
        pair,
        point: linkage.place(pose, pair),
        force: [0.0; 2],
        moment: 0.0,
        effort: None,
    };
    for (u, value) in parts {
        out.force = plus(out.force, *value, u.force);
        out.moment += value * u.moment;
        if u.drives {
            let turning = linkage.mechanism.pairs[pair].kind == PairKind::Turning;
            out.effort = Some(if turning { value * u.moment } else { *value });
        }
    }
    out
}

/// The whole mechanism at once: every body but the frame, every pair.
///
/// `None` where the equations are singular.
#[must_use]
pub(crate) fn whole(
    linkage: &Linkage,
    d: &Decomposition,
    now: &Instant,
    loads: &[Load],
) -> Option<Equilibrium> {
    let m = &linkage.mechanism;
    let bodies: Vec<BodyId> = (0..m.bodies.len()).filter(|&b| b != m.frame).collect();
    let pairs: Vec<PairId> = (0..m.pairs.len()).collect();
    equilibrium(linkage, now, &bodies, &pairs, &d.drives, loads)
}

/// Group by group, the last first, each handing its outer reactions on as loads; the drives come last. In order of
/// [`Decomposition::groups`], then the drives.
///
/// `None` where a group's equations are singular.
#[must_use]
pub(crate) fn by_groups(
    linkage: &Linkage,
    d: &Decomposition,
    now: &Instant,
    loads: &[Load],
) -> Option<Vec<Equilibrium>> {
    let mut loads = loads.to_vec();
    let mut out = Vec::new();
    let units = d.groups.iter().rev().map(|g| (&g.bodies, g.pairs()));
    for (bodies, pairs) in units.chain([(&d.driven, d.driven_pairs.clone())]) {
        let found = equilibrium(linkage, now, bodies, &pairs, &d.drives, &loads)?;
        for r in &found.reactions {
            for body in linkage.mechanism.pairs[r.pair].bodies {
                if !bodies.contains(&body) {
                    let [x, y, moment] = r.on(linkage, body, r.point);
                    loads.push(Load {
                        body,
                        source: LoadSource::External,
                        point: r.point,
                        force: [x, y],
                        moment,
                    });
                }
            }
        }
        out.push(found);
    }
    let drives = out.pop();
    out.reverse();
    out.extend(drives);
    Some(out)
}

/// Power of the loads `[W]`: with the drives' it comes to nothing.
#[must_use]
pub fn power(now: &Instant, loads: &[Load]) -> f64 {
    let of = |l: &Load| {
        let v = now.velocity[l.body];
        let arm = minus(l.point, [now.pose[l.body][0], now.pose[l.body][1]]);
        dot(l.force, plus([v[0], v[1]], v[2], quarter(arm))) + l.moment * v[2]
    };
    loads.iter().map(of).sum()
}
