//! The force plans of the four-link group: one of the whole group, and one each of links 4, 7 and 6. Each is made by the δ-point method and
//! by the equilibrium of all links.

use crate::statics::contour_group::pose::GroupReactions;
use crate::statics::contour_group::solutions::GroupSolutions;
use crate::statics::kinetostatics::LoadSource;
use crate::statics::pose::{length, minus, quarter_turn};

/// A force of a plan.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanForce {
    /// Its name in the letters of the paper: "R46τ", "G4".
    pub name: String,
    /// `[N]`
    pub force: [f64; 2],
    /// Origin of the force.
    pub kind: PlanKind,
}

/// Origin of a force of a plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlanKind {
    /// A load.
    Load(LoadSource),
    /// A reaction perpendicular to its line to δ or to its rod, found from moments.
    Tangential,
    /// A reaction found by the plan, or a complete one.
    Reaction,
}

/// The forces on a link or group, which add up to zero.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// Subject of the plan: "group", "link 4".
    pub of: &'static str,
    /// The forces in drawing order.
    pub forces: Vec<PlanForce>,
}

/// Letters of the links, by their index in the loads.
const LINKS: [&str; 4] = ["4", "6", "7", "10"];

fn link_loads(g: &GroupSolutions, links: &[usize]) -> Vec<PlanForce> {
    let own = g.pose.loads.iter().filter(|l| links.contains(&l.body));
    let named = own.filter(|l| l.force != [0.0; 2]).map(|l| PlanForce {
        name: match l.source {
            LoadSource::Gravity => format!("G{}", LINKS[l.body]),
            LoadSource::Inertia => format!("Fи{}", LINKS[l.body]),
            LoadSource::External => format!("P{}", LINKS[l.body]),
        },
        force: l.force,
        kind: PlanKind::Load(l.source),
    });
    named.collect()
}

/// Returns the loads of the whole group, in the order of its links.
#[must_use]
pub fn group_loads(g: &GroupSolutions) -> Vec<PlanForce> {
    link_loads(g, &[0, 1, 2, 3])
}

fn plan_reaction(name: &str, force: [f64; 2]) -> PlanForce {
    PlanForce {
        name: name.to_owned(),
        force,
        kind: PlanKind::Reaction,
    }
}

/// Returns a reaction as its part perpendicular to a line, `tangential` along a quarter turn of the direction from
/// `from` to `to`, and the rest.
fn split_reaction(
    name: &str,
    whole: [f64; 2],
    tangential: f64,
    from: [f64; 2],
    to: [f64; 2],
) -> [PlanForce; 2] {
    let along = minus(to, from);
    let across = quarter_turn(along).map(|c| c / length(along) * tangential);
    let mut first = plan_reaction(&format!("{name}τ"), across);
    first.kind = PlanKind::Tangential;
    [
        first,
        plan_reaction(&format!("{name}n"), minus(whole, across)),
    ]
}

/// A group with the reactions of one method, for drawing its forces.
struct SolvedGroup<'g> {
    group: &'g GroupSolutions,
    reactions: &'g GroupReactions,
    /// Whether reactions are drawn in two parts, as found by the δ-point method.
    split: bool,
}

impl SolvedGroup<'_> {
    /// Returns a reaction, complete or in its parts; see [`split_reaction`].
    fn drawn_reaction(
        &self,
        name: &str,
        whole: [f64; 2],
        tangential: f64,
        from: [f64; 2],
        to: [f64; 2],
    ) -> Vec<PlanForce> {
        if self.split {
            split_reaction(name, whole, tangential, from, to).to_vec()
        } else {
            vec![plan_reaction(name, whole)]
        }
    }

    fn at_d(&self) -> Vec<PlanForce> {
        let (pose, steps) = (&self.group.pose, &self.group.steps);
        let (whole, tangential) = (self.reactions.d, steps.r34_tangential);
        self.drawn_reaction("R34", whole, tangential, steps.delta, pose.d)
    }

    /// Returns the reaction at F, or with the sign -1 its opposite on the other link.
    fn at_f(&self, sign: f64, name: &str) -> Vec<PlanForce> {
        let pose = &self.group.pose;
        let whole = self.reactions.f.map(|x| sign * x);
        let tangential = sign * self.group.steps.r46_tangential;
        self.drawn_reaction(name, whole, tangential, pose.m, pose.f)
    }

    /// Returns the reaction at K, or with the sign -1 its opposite on the other link.
    fn at_k(&self, sign: f64, name: &str) -> Vec<PlanForce> {
        let pose = &self.group.pose;
        let whole = self.reactions.k.map(|x| sign * x);
        let tangential = sign * self.group.steps.r47_tangential;
        self.drawn_reaction(name, whole, tangential, pose.l, pose.k)
    }

    /// Returns the plan of some links: their loads, followed by reactions.
    fn link_plan(&self, of: &'static str, links: &[usize], reactions: Vec<Vec<PlanForce>>) -> Plan {
        Plan {
            of,
            forces: link_loads(self.group, links)
                .into_iter()
                .chain(reactions.into_iter().flatten())
                .collect(),
        }
    }

    fn all_plans(&self) -> [Plan; 4] {
        let r = self.reactions;
        let guide = self.group.pose.guide_normal().map(|c| c * r.guide);
        let whole = |name: &str, force| vec![plan_reaction(name, force)];
        [
            self.link_plan(
                "group",
                &[0, 1, 2, 3],
                vec![self.at_d(), whole("R0/10", guide)],
            ),
            self.link_plan(
                "link 4",
                &[0],
                vec![
                    whole("R34", r.d),
                    self.at_f(-1.0, "R64"),
                    self.at_k(-1.0, "R74"),
                ],
            ),
            self.link_plan(
                "link 7",
                &[2],
                vec![self.at_k(1.0, "R47"), whole("R10/7", r.l)],
            ),
            self.link_plan(
                "link 6",
                &[1],
                vec![self.at_f(1.0, "R46"), whole("R10/6", r.m)],
            ),
        ]
    }
}

/// Returns the plans by the δ-point method, paired with those of the full solution. Returns `None` if the full system
/// has no solution.
///
/// # Sources
/// `[Bychkov, Dvornikov & Zhukov 2018]`: the plan of the group gives R34n and R0/10, those of the links the rest.
/// Forces are summed; the couples of inertia are not part of a force plan.
#[must_use]
pub fn force_plans(g: &GroupSolutions) -> Option<Vec<[Plan; 2]>> {
    let (full, _) = g.equilibrium?;
    let plans = |reactions, split| {
        let solved = SolvedGroup {
            group: g,
            reactions,
            split,
        };
        solved.all_plans()
    };
    let (delta, full) = (plans(&g.delta, true), plans(&full, false));
    Some(delta.into_iter().zip(full).map(|(a, b)| [a, b]).collect())
}
