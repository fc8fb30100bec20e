//! The diagrams that answer a question: of the determinate variants, and of the admissible ones.

use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, LinkId, StateId};
use crate::search::conditions::Search;
use crate::search::diagram::{self, Collapse, Diagram, Limits, Progress, Stage, Stop};
use crate::search::lookahead::lookahead;
use crate::search::order::variable_order;
use crate::search::plan::plan;

/// Diagrams of one search.
#[derive(Debug)]
pub struct Diagrams {
    /// Of the variants that meet the redundancy condition of the free state.
    pub determinate: Diagram,
    /// Of those that meet every condition that does not depend on counts of changes and mobility.
    pub admissible: Diagram,
    /// The variables in the order the admissible diagram takes them.
    pub order: Vec<usize>,
}

impl Diagrams {
    /// The less complete of the two reasons for stopping.
    #[must_use]
    pub fn stop(&self) -> Stop {
        self.determinate.stop.or(self.admissible.stop)
    }
}

impl Search {
    /// Builds both diagrams.
    pub fn build(
        &self,
        cancelled: &(dyn Fn() -> bool + Sync),
        progress: &mut (dyn FnMut(Progress) + Send),
    ) -> Diagrams {
        let limits = |external| Limits {
            internal: self.conditions.max_redundant,
            external,
            nodes: self.conditions.nodes,
        };
        let (free, added): (Vec<usize>, Vec<usize>) =
            (0..self.space.variables.len()).partition(|&v| !self.space.variables[v].external);
        let order = variable_order(&self.mechanism, &self.space, &free, &[]);
        let joints = |order: &[usize]| -> Vec<JointId> {
            order
                .iter()
                .flat_map(|&v| self.space.variables[v].joints.iter().copied())
                .collect()
        };
        let idle = added.iter().map(|&variable| Stage {
            variable,
            steps: Vec::new(),
            external: true,
            collapse: None,
            lookahead: None,
        });
        let mut stages = diagram::stages(
            &self.space,
            &order,
            &plan(&self.mechanism, &joints(&order), &[], &[]),
        );
        stages.extend(idle);
        let determinate = diagram::build(
            &self.exact,
            &self.space,
            &stages,
            &limits(u32::MAX),
            cancelled,
            progress,
        );
        if !self.conditions.keep_output && added.is_empty() {
            return Diagrams {
                admissible: determinate.clone(),
                determinate,
                order,
            };
        }
        let mut pinned = vec![self.mechanism.frame()];
        pinned.extend(&self.kept.0);
        let free_links: Vec<LinkId> = self
            .mechanism
            .joints_in(StateId::FREE)
            .flat_map(|j| self.mechanism.joints[j].links)
            .collect();
        let contacts = joints(&added)
            .into_iter()
            .flat_map(|j| self.mechanism.joints[j].links);
        pinned.extend(contacts.filter(|l| free_links.contains(l)));
        pinned.sort_unstable();
        pinned.dedup();
        let mut order = variable_order(
            &self.mechanism,
            &self.space,
            &free,
            &[self.mechanism.frame()],
        );
        let first = plan(&self.mechanism, &joints(&order), &pinned, &[]);
        let mut stages = diagram::stages(&self.space, &order, &first);
        let live = first
            .steps
            .last()
            .map(|s| s.live.clone())
            .unwrap_or_default();
        if self.conditions.keep_output {
            self.look_ahead(&mut stages);
        }
        let start: Vec<Vec<LinkId>> = match live.first() {
            Some((root, _)) => vec![
                std::iter::once(*root)
                    .chain(live.iter().map(|(_, l)| *l))
                    .collect(),
            ],
            None => Vec::new(),
        };
        let second = plan(&self.mechanism, &joints(&added), &[], &start);
        stages.extend(diagram::stages(&self.space, &added, &second));
        let external = self.conditions.state.map_or(u32::MAX, |(_, e)| e);
        let admissible = diagram::build(
            &self.exact,
            &self.space,
            &stages,
            &limits(external),
            cancelled,
            progress,
        );
        order.extend(added);
        Diagrams {
            determinate,
            admissible,
            order,
        }
    }

    /// Gives each stage of the free state the test that its nodes must pass.
    fn look_ahead(&self, stages: &mut [Stage]) {
        let present = |v: usize| {
            let variable = &self.space.variables[v];
            variable
                .joints
                .iter()
                .copied()
                .zip(variable.choices[0].spans.iter().cloned())
        };
        for i in 0..stages.len() {
            let left: Vec<_> = stages[i + 1..]
                .iter()
                .flat_map(|s| present(s.variable))
                .collect();
            let Some((_, last)) = stages[i].steps.last() else {
                continue;
            };
            let (kept, allowed) = (&self.kept.0, self.kept.1.len());
            let last = last.clone();
            let test = lookahead(
                &self.exact,
                &self.mechanism,
                self.space.dim,
                (&last.live, &last.pending),
                &left,
                kept,
                allowed,
            );
            stages[i].lookahead = Some(test);
            stages[i].collapse = self.collapse(&last.live, &left);
        }
    }

    /// The kept links in the frame's component that no joint to come touches.
    fn collapse(
        &self,
        live: &[(LinkId, LinkId)],
        left: &[(JointId, Vec<Vec<Residue>>)],
    ) -> Option<Collapse> {
        let (frame, dim) = (self.mechanism.frame(), self.space.dim);
        let contact = |l: LinkId| {
            let external = self
                .space
                .variables
                .iter()
                .filter(|v| v.external)
                .flat_map(|v| &v.joints);
            left.iter()
                .map(|(j, _)| j)
                .chain(external)
                .any(|&j| self.mechanism.joints[j].links.contains(&l))
        };
        let finished = |&(i, l): &(usize, &LinkId)| {
            let here = live.iter().position(|x| *x == (frame, *l));
            here.filter(|_| !contact(*l)).map(|block| (i, block))
        };
        let (places, blocks): (Vec<usize>, Vec<usize>) = self
            .kept
            .0
            .iter()
            .enumerate()
            .filter_map(|x| finished(&x))
            .unzip();
        let mut present = Echelon::new(self.exact.field());
        for row in &self.kept.1 {
            let part: Vec<Residue> = places
                .iter()
                .flat_map(|p| row[p * dim..(p + 1) * dim].iter().copied())
                .collect();
            present.insert(&part);
        }
        (!blocks.is_empty()).then(|| Collapse {
            blocks,
            present: present.reduced(),
        })
    }
}
