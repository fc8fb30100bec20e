//! The spaces in which a question's diagram is built: *lanes*, side by side in a node.
//!
//! The free state has one lane. A searched state adds lanes with the contours of that state:
//! - One lane counts its redundant constraints.
//! - One lane for each face that may take moments. The faces of this lane carry only friction: directions that friction does
//!   not hold move freely. Constraints that are redundant there are redundant by friction.
//! - One lane counts the redundant constraints without the joints that the state adds. It exists if the free state has other joints.
//! - One lane for each body that is to be held and each link that may hold it. It keeps the motion of the body relative to the link.
//!
//! If the state joins only kept links, the choices of common joints make no difference to it, and its lanes have the original joints
//! ([`Question::state_joins_kept_links`]).

use crate::closure::contour::{Contour, contour_basis};
use crate::closure::tree::{path_in, spanning_tree};
use crate::linalg::modp::{Field, Residue};
use crate::model::mechanism::{JointId, LinkId, StateId};
use crate::search::diagram::minimize::minimize_diagram;
use crate::search::diagram::redundancy_so_far::{Limits, Role, Spent};
use crate::search::diagram::stage::{Columns, LaneStage, Stage};
use crate::search::diagram::within::Within;
use crate::search::diagram::{self, Control, Diagram, Omitted};
use crate::search::question::Question;
use crate::search::question::conditions::InState;
use crate::search::question::space::{Choice, Face, Variable};
use crate::search::reduce::lifetimes::{Lifetime, Offered};
use crate::search::reduce::self_stress_space::{ClosingRows, SelfStressSpace, is_contained};
use crate::search::solve::self_stress::{Wanted, empty_diagram, self_stress_space};

/// Returns the diagram of a question for the variables in an order: the smallest there is, or what fits the limits.
///
/// # Complexity
/// O(nodes · choices · s²) field operations for s present self-stresses.
pub(in crate::search) fn in_self_stress_space(
    question: &Question,
    order: &[usize],
    limits: &Limits,
    wanted: Wanted<'_>,
    control: Control<'_>,
) -> Diagram {
    let Lanes { stages, root } = Lanes::new(question, order, limits, wanted);
    if !root.is_within(limits) {
        return empty_diagram(question, order);
    }
    let space = &question.space;
    let omitted = wanted.known().map_or(Omitted::Nothing, |known| {
        Omitted::Outside(Within::new(&known.layers, known.terminals.len(), true))
    });
    let built = diagram::build_layers(space, &stages, limits, root, omitted, control);
    let stop = built.stop;
    let smallest = minimize_diagram(built.layers, built.terminals);
    Diagram { stop, ..smallest }
}

/// A lane: its space, what it counts, and which choices it does not apply to.
struct Lane {
    role: Role,
    space: SelfStressSpace,
    /// For each variable in order and each choice, whether the lane applies.
    applies: Vec<Vec<bool>>,
}

/// The stages of a diagram, and what a variant spends before any choice.
pub(in crate::search) struct Lanes<'a> {
    pub(in crate::search) stages: Vec<Stage<'a>>,
    pub(in crate::search) root: Spent,
}

impl<'a> Lanes<'a> {
    /// Returns the stages of the diagram of some variants for the variables in an order.
    ///
    /// # Complexity
    /// That of [`SelfStressSpace::new`] for each lane.
    pub(in crate::search) fn new(
        question: &Question,
        order: &[usize],
        limits: &'a Limits,
        wanted: Wanted<'_>,
    ) -> Lanes<'a> {
        let field = question.exact.field();
        let free = Lane {
            role: Role::Free,
            space: self_stress_space(question, order, wanted),
            applies: Vec::new(),
        };
        let state = question
            .conditions
            .state
            .filter(|_| !matches!(wanted, Wanted::Determinate));
        let more = state.map_or_else(Vec::new, |s| of_state(question, order, s));
        let roles: Vec<Role> = more.iter().map(|lane| lane.role).collect();
        let mut root = Spent::within_mechanism(free.space.lasting);
        let contours = u32::try_from(free.space.contours.len()).unwrap_or(u32::MAX);
        // All lanes of the state have the original common joints, with these redundant constraints.
        let of_free = if limits.beside_free {
            root.internal() + contours
        } else {
            0
        };
        for (i, lane) in more.iter().enumerate() {
            root.add_redundant(1 + i, lane.space.lasting - of_free);
            // A body that is loose with the original joints is loose in every variant.
            if matches!(lane.role, Role::Held(_)) && lane.space.moves_kept {
                root.rule_out(1 + i);
            }
        }
        let lanes: Vec<Lane> = std::iter::once(free).chain(more).collect();
        let stage = |(at, &variable): (usize, &usize)| Stage {
            field,
            variable,
            choices: question.space.variables[variable].choices.len(),
            lanes: lanes
                .iter()
                .map(|lane| lane.lane_stage(field, at))
                .collect(),
            ending: (at + 1 == order.len() && !roles.is_empty()).then(|| roles.clone()),
            limits,
        };
        Lanes {
            stages: order.iter().enumerate().map(stage).collect(),
            root,
        }
    }
}

impl Lane {
    /// Returns what happens in the lane at a variable, by its number in the order.
    fn lane_stage(&self, field: Field, at: usize) -> LaneStage {
        let SelfStressSpace {
            added,
            contours,
            kept,
            ..
        } = &self.space;
        let lifetimes: Vec<Lifetime> = contours.iter().chain(kept).copied().collect();
        let part = |closing: bool, of_contours: bool| -> Vec<usize> {
            let all = 0..lifetimes.len();
            let all = all.filter(|&c| (c < contours.len()) == of_contours);
            let live = all.filter(|&c| lifetimes[c].is_live_at(at));
            live.filter(|&c| (lifetimes[c].to == at) == closing)
                .collect()
        };
        let [gap, open] = [true, false].map(|closing| part(closing, true));
        let columns = |coordinates: &[usize], closing: usize| {
            Columns::new(field, &lifetimes, at, coordinates, closing, &added[at])
        };
        LaneStage {
            role: self.role,
            all: columns(&[&gap[..], &open].concat(), gap.len()),
            harmless: (!kept.is_empty()).then(|| {
                let [done, left] = [true, false].map(|closing| part(closing, false));
                let coordinates = [&gap[..], &done, &open, &left].concat();
                columns(&coordinates, gap.len() + done.len())
            }),
            applies: self.applies.get(at).cloned().unwrap_or_default(),
        }
    }
}

/// Returns the lanes of a searched state.
fn of_state(question: &Question, order: &[usize], searched: InState) -> Vec<Lane> {
    let (mechanism, state) = (&question.mechanism, searched.state);
    let contours = contour_basis(mechanism, state);
    let tree = spanning_tree(mechanism, state);
    let against = &|body: LinkId, jaw: LinkId| {
        let mut path = path_in(&tree, body);
        for (joint, forward) in path_in(&tree, jaw) {
            match path.iter().position(|(j, _)| *j == joint) {
                Some(both) => drop(path.remove(both)),
                None => path.push((joint, !forward)),
            }
        }
        path
    };
    let faces = face_joints(question).into_iter().map(Role::Friction);
    let variables = &question.space.variables;
    let others = variables.iter().any(|v| v.alone).then_some(Role::Common);
    let plain = [Role::State].into_iter().chain(faces).chain(others);
    let plain = plain.map(|role| (role, Vec::new()));
    let grasps = question.grasps.iter().enumerate();
    let held = grasps.flat_map(|(g, grasp)| {
        let jaws = grasp.jaws.iter();
        jaws.map(move |&jaw| (Role::Held(g), vec![against(grasp.body, jaw)]))
    });
    let of_role = |(role, paths)| {
        let in_state = StateRows {
            question,
            state,
            contours: &contours,
            role,
            has_present_joints: question.state_joins_kept_links(),
        };
        in_state.build_lane(order, paths)
    };
    plain.chain(held).map(of_role).collect()
}

/// Returns the joints that a state adds and that are faces in some choice.
fn face_joints(question: &Question) -> Vec<JointId> {
    let is_face = |variable: &Variable, member: usize| {
        let mut choices = variable.choices.iter();
        choices.any(|c| face_at(c, member).is_some())
    };
    let added = question.space.variables.iter().filter(|v| v.external);
    let faces = added.flat_map(|v| {
        let joints = v.joints.iter().copied().enumerate();
        joints.filter(move |(member, _)| is_face(v, *member))
    });
    faces.map(|(_, joint)| joint).collect()
}

/// Returns the motions of a choice under friction at one of its variable's joints; `None` if the joint is not a face.
fn face_at(choice: &Choice, member: usize) -> Option<&Face> {
    choice.faces.get(member).and_then(Option::as_ref)
}

/// The closure equations of a searched state in a lane.
struct StateRows<'a> {
    question: &'a Question,
    state: StateId,
    contours: &'a [Contour],
    role: Role,
    /// Whether the common joints are the original ones in every variant.
    has_present_joints: bool,
}

impl StateRows<'_> {
    /// Returns the lane for the variables in an order; motions over the paths are kept.
    fn build_lane(&self, order: &[usize], paths: Vec<Vec<(JointId, bool)>>) -> Lane {
        let Question {
            mechanism,
            space,
            exact,
            ..
        } = self.question;
        let field = exact.field();
        let rows = ClosingRows::in_state(mechanism, space.dim, self.state, self.contours, paths);
        let of_variable = |variable: &Variable| -> Vec<Option<Vec<Vec<Residue>>>> {
            let choices = variable.choices.iter();
            choices
                .map(|choice| self.choice_columns(&rows, field, variable, choice))
                .collect()
        };
        let columns: Vec<_> = space.variables.iter().map(of_variable).collect();
        let present = order.iter().filter_map(|&v| {
            let all: Vec<&Vec<Vec<Residue>>> = columns[v].iter().flatten().collect();
            // Only what every choice has can be divided out.
            columns[v][0].clone().filter(|_| is_contained(field, &all))
        });
        let offered = order.iter().map(|&v| {
            let choices = columns[v].iter();
            Offered::from_choices(choices.map(|c| c.clone().unwrap_or_default()))
        });
        let applies = |&v: &usize| columns[v].iter().map(Option::is_some).collect();
        Lane {
            role: self.role,
            applies: order.iter().map(applies).collect(),
            space: SelfStressSpace::new(field, &rows, 1, present.flatten(), offered),
        }
    }

    /// Returns the columns of a choice in this lane; `None` if the lane does not apply, since its joint is not a face.
    fn choice_columns(
        &self,
        rows: &ClosingRows<'_>,
        field: Field,
        variable: &Variable,
        choice: &Choice,
    ) -> Option<Vec<Vec<Residue>>> {
        let mechanism = &self.question.mechanism;
        // The choice of a common joint may make no difference.
        let choice = if self.has_present_joints && !variable.external {
            &variable.choices[0]
        } else {
            choice
        };
        let mut out = Vec::new();
        for (member, &joint) in variable.joints.iter().enumerate() {
            if !mechanism.joints[joint].is_in(self.state) {
                continue;
            }
            let plain = &choice.spans[member];
            let every;
            let span = match (self.role, face_at(choice, member)) {
                (Role::Common, _) if variable.external => {
                    let width = rows.twist_width(joint);
                    let unit = |i| {
                        let mut unit = vec![0; width];
                        unit[i] = field.one();
                        unit
                    };
                    every = (0..width).map(unit).collect();
                    &every
                }
                (Role::Friction(own), Some(face)) if own == joint => &face.slides,
                (Role::Friction(_), Some(face)) => &face.parts,
                (Role::Friction(own), None) if own == joint => return None,
                _ => plain,
            };
            out.extend(rows.joint_columns(field, joint, span));
        }
        Some(out)
    }
}

#[cfg(test)]
mod tests {
    use crate::model::drawn::{Z, draw_mechanism, hinges};
    use crate::model::joint_type::{CoupledFreedom, Coupling, Freedom, JointType};
    use crate::model::mechanism::{JointId, Mechanism};
    use crate::rank::exact::field::exact_field;
    use crate::search::diagram::Control;
    use crate::search::question::Question;
    use crate::search::question::conditions::{Conditions, SearchError};
    use crate::search::solve::build_diagrams;
    use itertools::Itertools;

    fn question(m: &Mechanism, max_redundant: u32) -> Result<Question, SearchError> {
        let conditions = Conditions {
            max_redundant,
            ..Conditions::default()
        };
        Question::new(exact_field(m, 0).unwrap(), m, conditions)
    }

    /// How many ends the diagrams of determinate and of admissible variants have.
    fn ends(m: &Mechanism, max_redundant: u32) -> [usize; 2] {
        let built = build_diagrams(&question(m, max_redundant).unwrap(), Control::NONE);
        [&built.determinate, &built.admissible].map(|d| d.terminals.len())
    }

    /// Cranks of a parallelogram turn alike: gears that make them do so are redundant, and others stop them. Either way it keeps the
    /// motion that it has, whichever crank a coupling names first and whichever link a hinge does.
    #[test]
    fn coupled_cranks_keep_the_motion_that_they_have() {
        let at = |x: f64, y: f64| [x, y, 0.0];
        let joints = [
            ([0, 1], at(0.0, 0.0)),
            ([1, 2], at(1.0, 4.0)),
            ([2, 3], at(7.0, 4.0)),
            ([0, 3], at(6.0, 0.0)),
        ];
        for ((ratio, redundant), order) in [(1, 4), (-1, 3)]
            .into_iter()
            .cartesian_product([0, 1, 2, 3].into_iter().permutations(4))
        {
            let taken = order.iter().map(|&i: &usize| joints[i]).collect_vec();
            let mut m = draw_mechanism(&hinges(&taken), &[2]);
            let place = |j: usize| order.iter().position(|&i| i == j).unwrap();
            for first in [[0, 3], [3, 0]] {
                let end = |j: usize| CoupledFreedom {
                    joint: JointId::new(place(j)),
                    freedom: Freedom::Rz,
                };
                m.parts_mut().couplings = vec![Coupling {
                    ends: first.map(end),
                    ratio: ratio.into(),
                    gear: true,
                }];
                let found = [redundant, redundant - 1].map(|most| ends(&m, most));
                assert_eq!(found, [[1, 1], [0, 0]], "{ratio} {order:?} {first:?}");
            }
        }
    }

    /// What slides along a hinge's axis has as many freedoms, and not the hinge's; what turns and slides has it.
    #[test]
    fn an_option_must_have_the_motion_of_the_present_joint() {
        for (option, contained) in [
            (JointType::Prismatic, false),
            (JointType::Planar, true),
            (JointType::Cylindrical, true),
            (JointType::Custom(vec![Freedom::Rx, Freedom::Tz]), false),
        ] {
            let mut m = draw_mechanism(&[(JointType::Revolute, [0, 1], [1.0, 2.0, 0.0], Z)], &[]);
            let mut other = m.joints[0].options[0].clone();
            other.joint_type = option.clone();
            m.parts_mut().joints[0].options.push(other);
            assert_eq!(question(&m, 0).is_ok(), contained, "{option:?}");
        }
    }
}
