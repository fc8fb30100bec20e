//! The space of variants: for each joint, or all that are each other's images, the choices and what they do.

use crate::closure::coupling::{coupling_coefficient, length_ratio};
use crate::closure::drive::{rate_of_twist, rate_row};
use crate::closure::twist::{MotionSpace, joint_twists};
use crate::geom::Scalars;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::joint_type::{Freedom, JointType};
use crate::model::mechanism::{JointId, JointOption, Mechanism, StateId};
use crate::search::question::cost::CostTable;
use num_bigint::BigUint;

/// A choice for the joints of a variable.
#[derive(Debug, Clone)]
pub struct Choice {
    /// Index into the joint's options; 0 is the original joint.
    pub option: usize,
    /// Index into the joint's unloading joints, where one is inserted.
    pub unloading: Option<usize>,
    /// For each joint of the variable, independent twists that span its motion, each with the joint's rates behind it: its entry in
    /// the row of every coupling it is in, then the rate of its kept drive.
    pub spans: Vec<Vec<Vec<Residue>>>,
    /// For each joint of the variable that is a face which the state adds, what it does under friction.
    pub faces: Vec<Option<Face>>,
    /// Freedoms the joints put here have in the free state, those of an unloading joint included.
    pub freedoms: u32,
    /// Number of changed joints and inserted unloading joints.
    pub changes: u32,
    /// Cost above that of the original joint, in thousandths.
    pub cost_milli: i64,
}

/// The motion of a face that carries friction only, its unloading joint and entries for couplings included.
#[derive(Debug, Clone)]
pub struct Face {
    /// It may part: forces along it and any moment are carried.
    pub parts: Vec<Vec<Residue>>,
    /// It may part and tilt: forces along it and a moment about its normal are carried.
    pub slides: Vec<Vec<Residue>>,
}

/// A joint to choose for, or joints that must be chosen alike.
#[derive(Debug, Clone)]
pub struct Variable {
    /// The joints.
    pub joints: Vec<JointId>,
    /// The choices; the first is the original joint.
    pub choices: Vec<Choice>,
    /// Whether the joints are present only in the searched state beyond the free one (contacts).
    pub external: bool,
    /// Whether the joints are absent from the searched state.
    pub alone: bool,
}

/// Everything a search chooses from.
#[derive(Debug, Clone)]
pub struct Space {
    /// Components of a twist: 6, or 3 in a plane.
    pub dim: usize,
    /// The state whose additional joints take part, where external redundancy is searched too.
    pub state: Option<StateId>,
    /// The variables, in file order of their first joints.
    pub variables: Vec<Variable>,
}

impl Space {
    /// Creates the space of a mechanism: all joints of the free state, and those that `state` adds if one is given. With
    /// `symmetric`, joints that are images of each other become one variable.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value in the field.
    pub fn new(
        exact: &ExactField,
        mechanism: &Mechanism,
        state: Option<StateId>,
        symmetric: bool,
        costs: &CostTable,
    ) -> Result<Space, ExactError> {
        let motion = MotionSpace::new(exact, &mechanism.mode)?;
        let free: Vec<JointId> = mechanism.joints_in(StateId::FREE).collect();
        let added = state.into_iter().flat_map(|s| mechanism.joints_added_in(s));
        let alone = |j: &JointId| state.is_some_and(|s| !mechanism.joints[*j].is_in(s));
        let mut groups: Vec<(Vec<JointId>, bool)> = Vec::new();
        for (j, external) in free
            .iter()
            .map(|&j| (j, false))
            .chain(added.map(|j| (j, true)).collect::<Vec<_>>())
        {
            let image =
                |&j: &JointId| Some(mechanism.search.image_of_joint(j)).filter(|_| symmetric);
            let mut others = std::iter::successors(image(&j), image).take_while(|&i| i != j);
            let found = others.find_map(|i| groups.iter().position(|(g, _)| g.contains(&i)));
            match found.map(|at| &mut groups[at]) {
                Some((group, _)) => group.push(j),
                None => groups.push((vec![j], external)),
            }
        }
        let mut variables = Vec::new();
        for (joints, external) in groups {
            let per_joint: Vec<Vec<Choice>> = joints
                .iter()
                .map(|&j| joint_choices(exact, &motion, mechanism, (j, external), state, costs))
                .collect::<Result<_, _>>()?;
            let mut merged = per_joint[0].clone();
            for other in &per_joint[1..] {
                for (a, b) in merged.iter_mut().zip(other) {
                    a.spans.extend(b.spans.iter().cloned());
                    a.faces.extend(b.faces.iter().cloned());
                    a.freedoms += b.freedoms;
                    a.changes += b.changes;
                    a.cost_milli += b.cost_milli;
                }
            }
            variables.push(Variable {
                alone: joints.iter().any(alone),
                joints,
                choices: merged,
                external,
            });
        }
        Ok(Space {
            dim: motion.dim(),
            state,
            variables,
        })
    }

    /// Returns the number of variants.
    #[must_use]
    pub fn size(&self) -> BigUint {
        self.variables
            .iter()
            .map(|v| BigUint::from(v.choices.len()))
            .product()
    }
}

/// Returns what may be chosen at a joint, which is `external` if the searched state adds it. The present joint comes first.
fn joint_choices(
    exact: &ExactField,
    motion: &MotionSpace<Residue>,
    mechanism: &Mechanism,
    (id, external): (JointId, bool),
    state: Option<StateId>,
    costs: &CostTable,
) -> Result<Vec<Choice>, ExactError> {
    let joint = &mechanism.joints[id];
    let mut out = Vec::new();
    // The present joint is offered always.
    let offered =
        |(i, o): &(usize, &JointOption)| *i == 0 || o.state.is_none_or(|s| state == Some(s));
    let rates = mechanism.rates_of(id);
    let unloading = joint.unloading.iter().enumerate();
    let unloading = unloading.filter(|(_, o)| o.state.is_none_or(|s| state == Some(s)));
    for unloading in std::iter::once(None).chain(unloading.map(|(u, _)| Some(u))) {
        for (i, option) in joint.options.iter().enumerate().filter(offered) {
            let inserted = unloading.map(|u| &joint.unloading[u]);
            let [mut columns, added] =
                option_columns(exact, motion, mechanism, id, option, inserted)?;
            // W is the free state's: a contact is absent there, its unloading joint is not.
            let absent = if external { columns.len() } else { 0 };
            columns.extend(added);
            let freedoms = u32::try_from(columns.len() - absent).unwrap_or(u32::MAX);
            let span = |more: &[Freedom]| -> Result<Vec<Vec<Residue>>, ExactError> {
                let freed = JointType::Custom(more.to_vec());
                let mut span = Echelon::new(exact.field());
                columns.iter().for_each(|c| {
                    span.insert(c);
                });
                for (_, mut t) in joint_twists(exact, motion, &option.frame, &freed)? {
                    t.resize(t.len() + rates, 0);
                    span.insert(&t);
                }
                Ok(span.reduced_rows())
            };
            let face = external && motion.dim() == 6 && option.joint_type == JointType::Fixed;
            let friction = || -> Result<Face, ExactError> {
                Ok(Face {
                    parts: span(&[Freedom::Tz])?,
                    slides: span(&[Freedom::Tz, Freedom::Rx, Freedom::Ry])?,
                })
            };
            out.push(Choice {
                option: i,
                unloading,
                spans: vec![span(&[])?],
                faces: vec![face.then(friction).transpose()?],
                freedoms,
                changes: u32::from(i != 0) + u32::from(unloading.is_some()),
                cost_milli: costs.change_cost(
                    &joint.options[0],
                    joint.drive,
                    (i != 0).then_some(option),
                    inserted,
                ),
            });
        }
    }
    Ok(out)
}

/// Returns the twists of an option, and those of an unloading joint in series with it, one per freedom. Behind each come the
/// joint's rates: its entry in the row of each of its couplings, then the rate of its kept drive.
///
/// # Errors
/// Returns an error if a coordinate has no value in the number system.
pub(in crate::search) fn option_columns<S: Scalars>(
    s: &S,
    motion: &MotionSpace<S::Number>,
    mechanism: &Mechanism,
    joint: JointId,
    option: &JointOption,
    inserted: Option<&JointOption>,
) -> Result<[Vec<Vec<S::Number>>; 2], ExactError> {
    let twists = |o: &JointOption| joint_twists(s, motion, &o.frame, &o.joint_type);
    let mut own = twists(option)?
        .into_iter()
        .map(|(f, t)| coupled_twist(s, mechanism, joint, option, Some(f), t))
        .collect::<Result<Vec<_>, _>>()?;
    if let Some(row) = rate_row(s, motion, mechanism, joint, &option.frame)? {
        let driven = |twist: &mut Vec<S::Number>| {
            let rate = rate_of_twist(s, &row, twist);
            twist.push(rate);
        };
        own.iter_mut().for_each(driven);
    }
    let rates = mechanism.rates_of(joint);
    let added = inserted.map_or_else(|| Ok(Vec::new()), twists)?;
    let added = added.into_iter().map(|(_, mut t)| {
        t.resize(t.len() + rates, S::Number::default());
        t
    });
    Ok([own, added.collect()])
}

/// Returns a twist of an option, followed by its entries in the rows of the joint's couplings. All of these are 0 if the
/// twist belongs to no freedom that may be coupled.
///
/// # Errors
/// Returns an error if a coordinate has no value in the number system.
pub(in crate::search) fn coupled_twist<S: Scalars>(
    s: &S,
    mechanism: &Mechanism,
    joint: JointId,
    option: &JointOption,
    freedom: Option<Freedom>,
    mut twist: Vec<S::Number>,
) -> Result<Vec<S::Number>, ExactError> {
    let present = &mechanism.joints[joint].frame;
    for (q, end) in mechanism.couplings_of(joint) {
        let coupling = &mechanism.couplings[q];
        let Some(freedom) = freedom.filter(|f| coupling.ends[end].freedom == *f) else {
            twist.push(S::Number::default());
            continue;
        };
        // An option may have its axis written in another length.
        let mut entry = s.eval(&length_ratio((&option.frame, freedom), (present, freedom)))?;
        if end == 0 {
            entry = s.mul(entry, s.eval(&coupling_coefficient(mechanism, coupling))?);
        }
        twist.push(entry);
    }
    Ok(twist)
}

/// Returns the name of a choice at a joint, for people and programs.
#[must_use]
pub fn choice_name(mechanism: &Mechanism, joint: JointId, choice: &Choice) -> String {
    let joint = &mechanism.joints[joint];
    let base = joint
        .options
        .get(choice.option)
        .map_or(JointType::Fixed.name(), |o| o.name.as_str());
    match choice.unloading.and_then(|u| joint.unloading.get(u)) {
        Some(u) => format!("{base} + unloading {}", u.name),
        None => base.to_owned(),
    }
}
