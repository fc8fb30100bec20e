//! Joint reactions of any mechanism, planar or spatial, determinate or not.
//!
//! Every joint j passes a wrench w_j on to its second link, and every link but the frame is in equilibrium. Sending all
//! loads along a spanning tree to the frame gives one solution p; all others are p + Σ ± λ_c, a wrench λ_c round each
//! contour c. Joints do no work on their freedoms: t·w_j = 0 for each unit twist t of joint j, which is
//!
//!   Jᵀ λ = -(t·p)        one equation a freedom, six unknowns a contour,
//!
//! the transposed closure equations. A drive holds its freedom: that freedom's equation is left out, and t·w is the drive's
//! force or torque. With σ = 0 the solution is unique. Where redundant constraints are left, the solutions are a family:
//! that of minimum norm, Σ |f|² + |m|²/ℓ² over the joints about their own points (ℓ the mechanism's size), plus
//! self-stresses; and where joints are elastic and made askew, the one that fits. Where undriven motions are left under
//! which the loads do work, there is no equilibrium [Angeles 2014, ch. 6; Davies 1983].

pub mod applied;
pub mod cycle;
pub mod drives;
mod family;
pub mod follow;
pub mod geometry;
pub mod inertia;

use crate::geom::exact::ExactError;
use crate::model::joint_type::Freedom;
use crate::model::loads::Loads;
use crate::model::mechanism::{JointId, LinkId, Mechanism, StateId};
use crate::motion::pose::Pose;
use crate::statics::reactions::applied::link_loads;
use crate::statics::reactions::drives::{Driven, driven};
use crate::statics::reactions::geometry::{Geometry, Six, about, dot, power};
use crate::statics::reactions::inertia::inertia_loads;
use faer::Mat;
use faer::linalg::solvers::Svd;
use thiserror::Error;

/// Singular values below this fraction of the greatest count as zero.
pub const TOLERANCE: f64 = 1e-9;
/// A condition above this makes a mechanism nearly singular: figures good to few digits, reactions large.
pub const NEARLY_SINGULAR: f64 = 1e4;
/// Work on undriven motions below this fraction of the loads is none.
const NO_WORK: f64 = 1e-8;

/// Why there are no reactions.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Unsolved {
    /// The geometry has no numbers.
    #[error(transparent)]
    Exact(#[from] ExactError),
    /// The singular values did not converge.
    #[error("the singular values did not converge; check coordinates and loads for extreme values")]
    NoConvergence,
    /// Joints are coupled.
    #[error(
        "joints {coupling} are coupled, and what gears or belts pass from joint to joint is not part of the statics; take the \
         coupling out and drive both joints, or rank by cost alone"
    )]
    Coupled {
        /// The coupling.
        coupling: String,
    },
    /// The drives cannot go at their speeds.
    #[error(
        "the drives cannot go at the stated speeds in this pose, a dead point; state another workload.drive_speed, or look at \
         other poses with --stroke"
    )]
    Stuck,
    /// An inertia about a plane's normal where there is no plane.
    #[error(
        "link {link} states one number for its inertia, which is about the normal of a plane, and the mechanism moves in \
         space; give 3 about the axes or 6 of a tensor"
    )]
    PlaneInertia {
        /// The link.
        link: String,
    },
    /// Loads do work on a motion that no drive holds.
    #[error(
        "no equilibrium: link {link} would move under the loads, and no drive holds it ({mobility} undriven freedoms); \
         mark a drive, take the load off, or give the joint less freedom"
    )]
    Moves {
        /// The link that would move fastest.
        link: String,
        /// Freedoms left with the drives locked.
        mobility: usize,
    },
}

/// What a joint passes from its first link to its second.
#[derive(Debug, Clone, PartialEq)]
pub struct JointReaction {
    /// The joint.
    pub joint: JointId,
    /// Where it is now `[m]`, global axes.
    pub point: [f64; 3],
    /// Unit vectors x, y, z of its frame now.
    pub axes: [[f64; 3]; 3],
    /// The force in its own frame `[N]`.
    pub force: [f64; 3],
    /// The moment about its point in its own frame `[N·m]`.
    pub moment: [f64; 3],
    /// Force `[N]` or torque `[N·m]` of its drive, along the freedom it holds; part of force and moment.
    pub effort: Option<(Freedom, f64)>,
}

impl JointReaction {
    /// Magnitude of the force `[N]`.
    #[must_use]
    pub fn force_size(&self) -> f64 {
        dot(self.force, self.force).sqrt()
    }

    /// Magnitude of the moment `[N·m]`.
    #[must_use]
    pub fn moment_size(&self) -> f64 {
        dot(self.moment, self.moment).sqrt()
    }

    fn global(&self, own: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|i| (0..3).map(|k| own[k] * self.axes[k][i]).sum())
    }

    /// The force in global axes `[N]`.
    #[must_use]
    pub fn global_force(&self) -> [f64; 3] {
        self.global(self.force)
    }

    /// The moment about the joint's point in global axes `[N·m]`.
    #[must_use]
    pub fn global_moment(&self) -> [f64; 3] {
        self.global(self.moment)
    }
}

/// Whether reactions are the only ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Choice {
    /// They are: the mechanism is determinate.
    Unique,
    /// Those of minimum norm in a family.
    MinimumNorm,
}

/// Reactions of a mechanism.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// By joint of the state, in file order.
    pub reactions: Vec<JointReaction>,
    /// Whether they are the only ones.
    pub choice: Choice,
    /// Reactions that load nothing from outside, one set for each redundant constraint (with drives held), greatest
    /// force, or moment by size, 1 N.
    pub self_stresses: Vec<Vec<JointReaction>>,
    /// The reactions that fit the stated stiffness and misalignments, where stiffness is stated and it matters.
    pub elastic: Option<Vec<JointReaction>>,
    /// Freedoms left with the drives held; the loads do no work on them.
    pub undriven: usize,
    /// Ratio of the greatest and the smallest singular value kept.
    pub condition: f64,
    /// Greatest force, or moment by size, left over on a link, over the greatest load.
    pub residual: f64,
    /// The size that moments are divided by `[m]`.
    pub size: f64,
}

impl Solution {
    /// Whether small errors of the geometry change the reactions much.
    #[must_use]
    pub fn nearly_singular(&self) -> bool {
        self.condition > NEARLY_SINGULAR
    }
}

/// Solves for reactions.
#[derive(Debug)]
pub struct Reactions;

impl Reactions {
    /// Reactions at the pose of the file.
    ///
    /// # Errors
    /// [`Unsolved`].
    ///
    /// # Complexity
    /// O((6k)²·f) for k contours and f freedoms.
    pub fn solve(m: &Mechanism, state: StateId, loads: &Loads) -> Result<Solution, Unsolved> {
        let pose = Pose::of_file(m, state)?;
        let geometry = Geometry::new(m, state, &pose)?;
        let drives = driven(m, &geometry)?;
        Self::at(m, state, loads, &pose, 0.0, &drives)
    }

    /// The same with inertia forces of drives that go at the stated speeds, at any pose.
    ///
    /// # Errors
    /// [`Unsolved`].
    pub fn moving(
        m: &Mechanism,
        state: StateId,
        pose: &Pose,
        drive: f64,
        drives: &[Driven],
    ) -> Result<Solution, Unsolved> {
        no_couplings(m, state)?;
        let geometry = Geometry::new(m, state, pose)?;
        let mut of_links = link_loads(m, &m.loads, &geometry, pose, drive, period(drives));
        let inertia = inertia_loads(m, &m.loads, &geometry, pose, drives)?;
        for (all, own) in of_links.iter_mut().zip(&inertia) {
            all.iter_mut().zip(own).for_each(|(a, b)| *a += b);
        }
        Self::bearing(m, &m.loads, &geometry, &of_links, drives)
    }

    /// Reactions at any pose, the first drive `drive` `[rad]` or file units away from the pose of the file, with the
    /// freedoms the drives hold.
    ///
    /// # Errors
    /// [`Unsolved`].
    pub fn at(
        m: &Mechanism,
        state: StateId,
        loads: &Loads,
        pose: &Pose,
        drive: f64,
        drives: &[Driven],
    ) -> Result<Solution, Unsolved> {
        no_couplings(m, state)?;
        let geometry = Geometry::new(m, state, pose)?;
        let of_links = link_loads(m, loads, &geometry, pose, drive, period(drives));
        Self::bearing(m, loads, &geometry, &of_links, drives)
    }

    /// Reactions to one wrench a link.
    fn bearing(
        m: &Mechanism,
        loads: &Loads,
        geometry: &Geometry,
        loads_of_links: &[Six],
        drives: &[Driven],
    ) -> Result<Solution, Unsolved> {
        let system = System::new(geometry, drives)?;
        let particular = geometry.along_tree(m.joints.len(), loads_of_links);
        let mut wrenches = particular.clone();
        let left = system.solve(&mut wrenches);
        let scale = particular
            .iter()
            .flatten()
            .fold(0.0, |a: f64, x| a.max(x.abs()));
        let work = left.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
        if work > NO_WORK * scale {
            let mut speeds = vec![0.0; geometry.columns.len()];
            for (&c, x) in system.equations.iter().zip(&left) {
                speeds[c] = *x;
            }
            let twists = geometry.link_twists(m.links.len(), &speeds);
            // The loaded link that the motion carries along most, else the fastest.
            let gain = |l: LinkId| -power(&twists[l], &loads_of_links[l]).abs();
            let fastest = m.link_ids().min_by(|&a, &b| gain(a).total_cmp(&gain(b)));
            return Err(Unsolved::Moves {
                link: fastest.map_or_else(String::new, |l| m.links[l].id.clone()),
                mobility: system.undriven(),
            });
        }
        let stresses = system.self_stresses(m.joints.len());
        let rigid = wrenches.clone();
        family::least_norm(geometry, &mut wrenches, &stresses);
        let elastic = family::elastic(m, geometry, loads, rigid, &stresses);
        let residual = residual(m, geometry, &wrenches, loads_of_links);
        let present = |w: &[Six]| present(m, geometry, w, drives);
        Ok(Solution {
            choice: if stresses.is_empty() {
                Choice::Unique
            } else {
                Choice::MinimumNorm
            },
            reactions: present(&wrenches),
            self_stresses: stresses.iter().map(|s| present(s)).collect(),
            elastic: elastic.map(|w| present(&w)),
            undriven: system.undriven(),
            condition: system.condition(),
            residual,
            size: geometry.size,
        })
    }
}

/// Refuses a mechanism with coupled joints, whose reactions are not those of the joints alone.
///
/// # Errors
/// [`Unsolved::Coupled`] with the first coupling.
pub fn no_couplings(m: &Mechanism, state: StateId) -> Result<(), Unsolved> {
    match m.couplings_in(state).next() {
        None => Ok(()),
        Some(c) => Err(Unsolved::Coupled {
            coupling: c.name(m),
        }),
    }
}

/// After how much of the first drive the ranges of forces come again: a turn, where it turns.
#[must_use]
pub fn period(drives: &[Driven]) -> Option<f64> {
    let slides = |f: Freedom| matches!(f, Freedom::Tx | Freedom::Ty | Freedom::Tz);
    drives
        .first()
        .filter(|(_, f)| !slides(*f))
        .map(|_| std::f64::consts::TAU)
}

/// The equations of the freedoms that no drive holds.
struct System<'g> {
    geometry: &'g Geometry,
    equations: Vec<usize>,
    unknowns: usize,
    svd: Option<Svd<f64>>,
    values: Vec<f64>,
    rank: usize,
}

impl<'g> System<'g> {
    fn new(geometry: &'g Geometry, drives: &[Driven]) -> Result<Self, Unsolved> {
        let held = |c: &geometry::Column| drives.contains(&(c.joint, c.freedom));
        let equations: Vec<usize> = (0..geometry.columns.len())
            .filter(|&c| !held(&geometry.columns[c]))
            .collect();
        let unknowns = geometry.basis.len() * geometry.contours.len();
        let rows: Vec<Vec<f64>> = equations
            .iter()
            .map(|&c| geometry.row(&geometry.columns[c]))
            .collect();
        let mut svd = None;
        let mut values = Vec::new();
        if !rows.is_empty() && unknowns > 0 {
            let a = Mat::from_fn(rows.len(), unknowns, |r, c| rows[r][c]);
            let found = a.svd().map_err(|_| Unsolved::NoConvergence)?;
            let s = found.S().column_vector();
            values = (0..s.nrows()).map(|i| s[i]).collect();
            if values.iter().any(|v| !v.is_finite()) {
                return Err(Unsolved::NoConvergence);
            }
            svd = Some(found);
        }
        let greatest = values.first().copied().unwrap_or(0.0);
        let rank = values
            .iter()
            .filter(|&&v| v > 0.0 && v > TOLERANCE * greatest)
            .count();
        Ok(System {
            geometry,
            equations,
            unknowns,
            svd,
            values,
            rank,
        })
    }

    fn undriven(&self) -> usize {
        self.equations.len() - self.rank
    }

    fn condition(&self) -> f64 {
        match self.rank.checked_sub(1) {
            Some(last) => self.values[0] / self.values[last],
            None => 1.0,
        }
    }

    /// What the joints' wrenches do on the freedoms of the equations.
    fn work(&self, wrenches: &[Six]) -> Vec<f64> {
        let columns = self.equations.iter().map(|&c| &self.geometry.columns[c]);
        columns
            .map(|c| power(&c.twist, &wrenches[c.joint]))
            .collect()
    }

    /// Adds contour wrenches so that no freedom is worked on, as far as that goes; what work is left.
    fn solve(&self, wrenches: &mut [Six]) -> Vec<f64> {
        let Some(svd) = &self.svd else {
            return self.work(wrenches);
        };
        // The second round takes away the first one's rounding errors.
        for _ in 0..2 {
            let work = self.work(wrenches);
            let mut coefficients = vec![0.0; self.unknowns];
            for i in 0..self.rank {
                let share: f64 = work
                    .iter()
                    .enumerate()
                    .map(|(r, x)| svd.U()[(r, i)] * x)
                    .sum();
                let share = -share / self.values[i];
                for (c, x) in coefficients.iter_mut().enumerate() {
                    *x += share * svd.V()[(c, i)];
                }
            }
            self.geometry.add_round(&coefficients, wrenches);
        }
        self.work(wrenches)
    }

    /// Independent sets of wrenches that are in equilibrium by themselves, by joint.
    fn self_stresses(&self, joints: usize) -> Vec<Vec<Six>> {
        let one = |i: usize| {
            let mut coefficients = vec![0.0; self.unknowns];
            for (c, x) in coefficients.iter_mut().enumerate() {
                *x = match &self.svd {
                    Some(svd) => svd.V()[(c, i)],
                    None => f64::from(u8::from(c == i)),
                };
            }
            let mut out = vec![[0.0; 6]; joints];
            self.geometry.add_round(&coefficients, &mut out);
            let sizes = self.geometry.joints.iter();
            let greatest = sizes
                .flat_map(|&j| about(&out[j], self.geometry.points[j]))
                .fold(0.0, |a: f64, x| a.max(x.abs()));
            out.iter_mut().flatten().for_each(|x| *x /= greatest);
            out
        };
        (self.rank..self.unknowns).map(one).collect()
    }
}

/// What is left over on the links, over the greatest load.
fn residual(m: &Mechanism, geometry: &Geometry, wrenches: &[Six], loads: &[Six]) -> f64 {
    let mut sums = loads.to_vec();
    for &j in &geometry.joints {
        let [a, b] = m.joints[j].links;
        for i in 0..6 {
            sums[a][i] -= wrenches[j][i];
            sums[b][i] += wrenches[j][i];
        }
    }
    sums[m.frame()] = [0.0; 6];
    let greatest = |of: &[Six]| {
        of.iter()
            .flatten()
            .fold(0.0, |a: f64, x: &f64| a.max(x.abs()))
    };
    match greatest(loads) {
        0.0 => greatest(&sums),
        load => greatest(&sums) / load,
    }
}

/// Wrenches by joint as reactions in the joints' own frames, in SI.
fn present(
    m: &Mechanism,
    geometry: &Geometry,
    wrenches: &[Six],
    drives: &[Driven],
) -> Vec<JointReaction> {
    let each = geometry.joints.iter().map(|&j| {
        let w = about(&wrenches[j], geometry.points[j]);
        let axes = geometry.axes[j];
        let own = |v: [f64; 3]| axes.map(|a| dot(a, v));
        let held = drives.iter().find(|(d, _)| *d == j && m.joints[j].drive);
        let effort = held.and_then(|&(_, freedom)| {
            let column = geometry
                .columns
                .iter()
                .find(|c| c.joint == j && c.freedom == freedom)?;
            let turns = column.twist[..3] != [0.0; 3];
            let unit = if turns { geometry.size } else { 1.0 };
            Some((freedom, power(&column.twist, &wrenches[j]) * unit))
        });
        JointReaction {
            joint: j,
            point: [0, 1, 2].map(|i| geometry.middle[i] + geometry.size * geometry.points[j][i]),
            axes,
            force: own([w[3], w[4], w[5]]),
            moment: own([w[0], w[1], w[2]]).map(|x| x * geometry.size),
            effort,
        }
    });
    each.collect()
}
