//! Scores of a variant that is built as a mechanism and solved by singular values.

use crate::geom::expr::Expr;
use crate::geom::vector::length;
use crate::model::joint_type::Freedom;
use crate::model::loads::{ExternalForce, Loads};
use crate::model::mechanism::{JointId, LinkId, StateId};
use crate::score::evaluation::evaluate::Evaluator;
use crate::score::evaluation::evaluate::PoseLoad;
use crate::score::evaluation::terms::{ErrorSum, Scores, axis_of};
use crate::score::joint_types::JointType;
use crate::search::answer::k_best::Assignment;
use crate::search::check::variant_mechanism;
use crate::statics::reactions::cycle::follow_to;
use crate::statics::reactions::misfit::misfit_force;
use crate::statics::reactions::{JointReaction, Reactions, Uniqueness, Unsolved};

/// Returns force and moment of a joint without the part that its drive bears.
fn load_without_drive(r: &JointReaction) -> ([f64; 3], [f64; 3]) {
    let (mut f, mut m) = (r.force, r.moment);
    let held = r
        .effort
        .and_then(|(freedom, _): (Freedom, f64)| axis_of(freedom));
    match held {
        Some((i, true)) => f[i] = 0.0,
        Some((i, false)) => m[i] = 0.0,
        None => {}
    }
    (f, m)
}

/// Raises the peaks to the reactions of a realized variant, and calls `each` with each load.
fn raise_peaks(
    scores: &mut Scores,
    reactions: &[JointReaction],
    types: &[(JointId, JointType)],
    each: &mut dyn FnMut(PoseLoad),
) {
    for r in reactions {
        let (at, t) = &types[r.joint];
        let (f, moment) = load_without_drive(r);
        each(PoseLoad {
            joint: *at,
            force: length(f),
            moment: length(moment),
            capacity: (t.capacity_force, t.capacity_moment),
        });
        scores.force.raise_peak(length(f), t.capacity_force, *at);
        if let Some(capacity) = t.capacity_moment {
            scores.moment.raise_peak(length(moment), capacity, *at);
        }
    }
}

/// Returns a unit force along an axis on a point of a link as the only load.
fn unit_force(link: LinkId, point: [f64; 3], axis: usize) -> Loads {
    let force = ExternalForce {
        link,
        point: point.map(|x| Expr::from_f64(x).unwrap_or_else(|_| 0.into())),
        force: [0, 1, 2].map(|i| i64::from(i == axis).into()),
        range: None,
        states: None,
    };
    Loads {
        forces: vec![force],
        ..Loads::default()
    }
}

impl Evaluator<'_> {
    /// Returns the scores of a variant by building it and solving its equilibrium with singular values. Reactions that
    /// redundant constraints leave open have minimum norm.
    ///
    /// # Errors
    /// [`Unsolved`].
    pub fn reference_scores(&self, variant: &Assignment) -> Result<Scores, Unsolved> {
        self.slowly_with(variant, &mut |_| {})
    }

    /// Does the same, and calls `each` with the load of every joint in every pose.
    pub(in crate::score) fn slowly_with(
        &self,
        variant: &Assignment,
        each: &mut dyn FnMut(PoseLoad),
    ) -> Result<Scores, Unsolved> {
        let m = variant_mechanism::realize_variant(self.search, &variant.choices);
        let types = self.realized_types(&variant.choices);
        let mut worst: Option<Scores> = None;
        let positions: Vec<f64> = self.cases.list.iter().map(|c| c.drive).collect();
        let followed = follow_to(&m, StateId::FREE, &self.drives, &positions)?;
        for case in &self.cases.list {
            let there = followed.poses.iter().find(|(at, _)| *at == case.drive);
            let Some((drive, pose)) = there else {
                return Err(Unsolved::NoConvergence);
            };
            let solve = |loads: &Loads| {
                Reactions::solve_at(&m, StateId::FREE, loads, pose, *drive, &self.drives)
            };
            let solution = solve(&case.loads)?;
            let mut now = self.unloaded_scores(variant);
            now.conditioning = 1.0 / solution.condition;
            now.minimum_norm = solution.choice == Uniqueness::MinimumNorm;
            raise_peaks(&mut now, &solution.reactions, &types, each);
            for &(link, point) in &self.outputs {
                let mut error = ErrorSum::new(self.clearance);
                for axis in 0..3 {
                    let loads = unit_force(link, point, axis);
                    for r in &solve(&loads)?.reactions {
                        let f = length(load_without_drive(r).0);
                        error.add_joint(types[r.joint].1.clearance, f * f);
                    }
                    error.end_axis();
                }
                now.output_error = now.output_error.max(error.output_error());
            }
            match &mut worst {
                Some(w) => w.take_worse(&now),
                None => worst = Some(now),
            }
        }
        let mut worst = worst.ok_or(Unsolved::NoConvergence)?;
        if variant.key.internal() > 0 {
            let accuracy = m.loads.accuracy.clone().unwrap_or_default();
            worst.misfit = misfit_force(&m, StateId::FREE, &accuracy)?;
        }
        Ok(worst)
    }

    /// Returns for each joint of the realized variant the original joint and the type that bears its load.
    fn realized_types(&self, choices: &[usize]) -> Vec<(JointId, JointType)> {
        let m = &self.search.mechanism;
        let chosen = variant_mechanism::chosen_options(self.search, choices);
        let (mut here, mut inserted) = (Vec::new(), Vec::new());
        for (j, (option, unloading, _)) in m.joint_ids().zip(chosen) {
            let joint = &m.joints[j];
            let bears = |o: Option<&crate::model::mechanism::JointOption>| {
                let nothing = JointType {
                    capacity_force: 1.0,
                    capacity_moment: None,
                    clearance: 0.0,
                };
                (j, o.map_or(nothing, |o| self.types.option_type(o)))
            };
            here.push(bears(joint.options.get(option)));
            if let Some(u) = unloading.and_then(|u: usize| joint.unloading.get(u)) {
                inserted.push(bears(Some(u)));
            }
        }
        here.extend(inserted);
        here
    }
}
