//! Scores of a variant that is built as a mechanism and solved by singular values.

use crate::geom::expr::Expr;
use crate::geom::vector::length;
use crate::model::loads::{ExternalForce, Loads};
use crate::model::mechanism::{JointId, JointOption, LinkId, StateId};
use crate::score::evaluation::evaluate::Evaluator;
use crate::score::evaluation::evaluate::PoseLoad;
use crate::score::evaluation::terms::{ErrorSum, Scores};
use crate::score::joint_types::JointType;
use crate::search::answer::k_best::Assignment;
use crate::search::check::variant_mechanism;
use crate::statics::reactions::cycle::follow_to;
use crate::statics::reactions::misfit::misfit_force;
use crate::statics::reactions::{JointReaction, Reactions, Uniqueness, Unsolved};

/// Returns force and moment of a joint without the part that its drive bears.
fn load_without_drive(r: &JointReaction) -> ([f64; 3], [f64; 3]) {
    let (mut f, mut m) = (r.force, r.moment);
    match r.effort {
        Some((held, _)) if held.is_slide() => f[held.axis()] = 0.0,
        Some((held, _)) if held.is_turn() => m[held.axis()] = 0.0,
        _ => {}
    }
    (f, m)
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
            for r in &solution.reactions {
                let (joint, t) = &types[r.joint];
                let (force, moment) = load_without_drive(r);
                let load = PoseLoad {
                    joint: *joint,
                    force: length(force),
                    moment: length(moment),
                    capacity: (t.capacity_force, t.capacity_moment),
                };
                load.raise_peaks(&mut now, each);
            }
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
            let bears = |o: Option<&JointOption>| {
                let bears = o.map(|o| self.types.option_type(o));
                (j, bears.unwrap_or(JointType::UNLIMITED))
            };
            here.push(bears(joint.options.get(option)));
            if let Some(u) = unloading.and_then(|u| joint.unloading.get(u)) {
                inserted.push(bears(Some(u)));
            }
        }
        here.extend(inserted);
        here
    }
}
