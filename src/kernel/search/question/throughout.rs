//! The columns of every choice along the motion of the mechanism as built, for counts that hold beyond the drawn pose.
//!
//! The motion of the original joints is a power series in one variable t over the prime field. A redesign that keeps the
//! motion in the drawn pose only by a special position loses it at some order of t. Along the motion, the column of each
//! freedom is a series up to t². Its multiples by 1, t and t² are vectors over the field. If σ = 0 in the drawn pose, the
//! span of all vectors of a variant has a pivot at every coordinate of the contours. The rest, in the coordinates of outputs
//! and drives, is exact to second order. First order is not enough: a symmetric pose shows nothing to first order.
//!
//! A variant that is excluded is proven to lose the motion, for the motion as followed. One that is kept keeps it to second order.

use crate::closure::Closure;
use crate::closure::contour::Contour;
use crate::closure::drive::{rate_of_twist, rate_row};
use crate::closure::tree::spanning_tree;
use crate::closure::twist::{FrameValues, MotionSpace, Twist};
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::{Combinations, Echelon};
use crate::linalg::modp::{Field, Residue};
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{JointId, JointOption, Mechanism, StateId};
use crate::motion::displacement_series::{DisplacementSeries, Series, shifted_multiples};
use crate::rank::exact::modular;
use crate::rank::finite::higher_order::HigherOrder;
use crate::search::question::conditions::Conditions;
use crate::search::question::kept::Kept;
use crate::search::question::space::{Choice, Space, choice_name, coupled_twist};
use crate::search::reduce::lifetimes::number_in;
use crate::search::reduce::self_stress_space::ClosingRows;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use std::borrow::Cow;
use std::collections::BTreeMap;
use thiserror::Error;

/// Powers of t that diagrams keep: 1, t and t².
pub(in crate::search) const ORDER: usize = 3;
/// Powers of t in each column. One more than diagrams keep, because two factors of t can add up in a variant that is singular in the drawn
/// pose.
pub(in crate::search) const POWERS: usize = 4;
/// The order to which the motion itself is followed, to see that the pose is neither singular nor shaky.
const FOLLOWED: usize = 8;

/// The reason why counts are those of the drawn pose only.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum PoseOnly {
    /// Nobody asked for more.
    #[error("only the drawn pose was asked about")]
    Asked,
    /// The outputs may move in other ways.
    #[error("the outputs may move in other ways")]
    OutputChange,
    /// More than the count without redundant constraints is wanted.
    #[error("redundant constraints are allowed")]
    Redundant,
    /// A state takes part in the search.
    #[error("a searched state holds the mechanism in its pose")]
    State,
    /// Geometry that exact arithmetic does not have as it is meant.
    #[error("the geometry is judged by singular values")]
    Numeric,
    /// Variants are not counted.
    #[error("the variants are not counted")]
    NotCounted,
    /// No motion to follow.
    #[error("the mechanism does not move")]
    Rests,
    /// The motion to first order does not go on.
    #[error("the drawn pose is singular or shaky: its motion stops at order {0}")]
    Stopped(usize),
    /// The rank of the closure equations changes at the drawn pose.
    #[error(
        "the drawn pose is singular: the constraints or the output motions differ from those of poses next to it"
    )]
    Singular,
    /// More equations than are expanded.
    #[error("the closure equations are too many to expand")]
    TooLarge,
    /// An option that has the motion of the joint as built only in the drawn pose.
    #[error("{option} at {joint} does not follow the original joint")]
    Option {
        /// The joint.
        joint: String,
        /// The option.
        option: String,
    },
    /// The diagram takes more than the budgets.
    #[error("the diagram along the motion exceeds the node budget")]
    Budget,
}

/// A freedom's column at each power of t: a twist with its rates behind it.
pub(in crate::search) type ColumnSeries = Vec<Vec<Residue>>;

/// The columns of every choice along the motion.
#[derive(Debug)]
pub(in crate::search) struct Throughout {
    variables: Vec<FreedomsAlong>,
}

/// The freedoms that the choices of a variable have along the motion.
#[derive(Debug)]
pub(in crate::search) struct FreedomsAlong {
    /// The joint and the series of each freedom. Most of them belong to several choices.
    pub(in crate::search) columns: Vec<(JointId, ColumnSeries)>,
    /// The numbers of the freedoms of each choice.
    pub(in crate::search) choices: Vec<Vec<usize>>,
}

/// What [`Throughout::new`] says: columns, or why there are none.
pub(in crate::search) type Followed = Result<Throughout, PoseOnly>;

impl Throughout {
    /// Returns the columns of the choices of a space along a random direction of the original motion. The prime is the seed.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value in the field.
    ///
    /// # Complexity
    /// One expansion of the contours, one elimination of J, and O(m³) field operations for each freedom of each choice.
    pub(in crate::search) fn new(
        exact: &ExactField,
        mechanism: &Mechanism,
        conditions: &Conditions,
        space: &Space,
        contours: &[Contour],
        kept: &Kept,
    ) -> Result<Followed, ExactError> {
        if let Some(why) = not_asked(conditions) {
            return Ok(Err(why));
        }
        let motion = match Motion::new(exact, mechanism)? {
            Ok(motion) => motion,
            Err(why) => return Ok(Err(why)),
        };
        let mut variables = Vec::with_capacity(space.variables.len());
        for variable in &space.variables {
            let mut columns = Vec::new();
            let mut choices = vec![Vec::new(); variable.choices.len()];
            for &joint in &variable.joints {
                let mut present = Vec::new();
                for (numbers, choice) in choices.iter_mut().zip(&variable.choices) {
                    let own = motion.choice_columns(exact, mechanism, joint, choice)?;
                    // The present joint comes first.
                    if present.is_empty() {
                        present = own.clone().unwrap_or_default();
                    }
                    let own = own.filter(|own| has_all(exact.field(), own, &present));
                    let Some(own) = own else {
                        return Ok(Err(PoseOnly::Option {
                            joint: mechanism.joints[joint].id.clone(),
                            option: choice_name(mechanism, joint, choice),
                        }));
                    };
                    let own = own.into_iter().map(|c| (joint, c));
                    numbers.extend(own.map(|column| number_in(&mut columns, column)));
                }
            }
            variables.push(FreedomsAlong { columns, choices });
        }
        let out = Throughout { variables };
        let rows = ClosingRows::for_free_state(mechanism, space.dim, contours, Some(kept));
        Ok(if out.is_regular(exact.field(), &rows) {
            Ok(out)
        } else {
            Err(PoseOnly::Singular)
        })
    }

    /// Returns the joints and series of a choice's freedoms.
    pub(in crate::search) fn of_choice(
        &self,
        variable: usize,
        choice: usize,
    ) -> impl Iterator<Item = &(JointId, ColumnSeries)> {
        let FreedomsAlong { columns, choices } = &self.variables[variable];
        choices[choice].iter().map(|&number| &columns[number])
    }

    /// Returns the freedoms of all choices of a variable.
    pub(in crate::search) fn of_variable(&self, variable: usize) -> &FreedomsAlong {
        &self.variables[variable]
    }

    /// Returns whether the joints as built have the same rank and the same kept motion in poses next to the drawn one.
    fn is_regular(&self, f: Field, rows: &ClosingRows<'_>) -> bool {
        let ranks = |order: usize| -> [usize; 2] {
            let present = (0..self.variables.len()).flat_map(|v| self.of_choice(v, 0));
            let all = present.flat_map(|(joint, series)| {
                rows.series_multiples(f, *joint, series.get(..order).unwrap_or(series))
            });
            let pivots = Echelon::from_vectors(f, all).pivots();
            let closing = pivots.iter().filter(|p| **p < order * rows.count_closing());
            [closing.count(), pivots.len()]
        };
        ranks(ORDER) == ranks(1).map(|rank| ORDER * rank)
    }
}

/// Returns the reason why only the drawn pose is asked about; `None` if the whole motion is.
fn not_asked(conditions: &Conditions) -> Option<PoseOnly> {
    let all = [
        (!conditions.throughout, PoseOnly::Asked),
        (!conditions.keep_output, PoseOnly::OutputChange),
        (conditions.max_redundant > 0, PoseOnly::Redundant),
        (conditions.state.is_some(), PoseOnly::State),
        (conditions.numeric.is_some(), PoseOnly::Numeric),
        (!conditions.counted, PoseOnly::NotCounted),
    ];
    let mut reasons = all.into_iter().filter(|(is, _)| *is);
    reasons.next().map(|(_, why)| why)
}

/// Returns whether the module of some columns has all of others.
fn has_all(f: Field, columns: &[ColumnSeries], others: &[ColumnSeries]) -> bool {
    if others.iter().all(|other| columns.contains(other)) {
        return true;
    }
    let span = Echelon::from_vectors(f, columns.iter().flat_map(|c| shifted_multiples(c)));
    let mut others = others.iter().flat_map(|c| shifted_multiples(c));
    others.all(|v| span.contains(&v))
}

/// The present joints along their motion.
struct Motion {
    field: Field,
    space: MotionSpace<Residue>,
    /// The joints of the free state.
    over: BTreeMap<JointId, Passed>,
}

/// An original joint along the motion.
struct Passed {
    /// Its freedoms in the order in which they are passed, each with its twist.
    freedoms: Vec<(Freedom, Twist<Residue>)>,
    /// The place before its first freedom, between it and the next one, and so on.
    places: Vec<Place>,
}

/// The displacements along the motion of what is between two freedoms in series: from the joint's first link, and from the frame.
type Place = [DisplacementSeries; 2];

/// A freedom of a joint in series: its name, none for one of an unloading joint, and its twist.
type InSeries = (Option<Freedom>, Twist<Residue>);

impl Motion {
    /// Returns the motion in a direction drawn from the prime, or why there is none.
    fn new(
        exact: &ExactField,
        mechanism: &Mechanism,
    ) -> Result<Result<Motion, PoseOnly>, ExactError> {
        let field = exact.field();
        let closure = Closure::new(exact, mechanism, StateId::FREE)?;
        let rank = modular::rank_modulo(exact, &closure);
        let Some(series) = HigherOrder::new(exact, mechanism, &closure, rank)? else {
            return Ok(Err(PoseOnly::TooLarge));
        };
        let (_, free) = series.free_coordinates();
        if free == 0 {
            return Ok(Err(PoseOnly::Rests));
        }
        let mut random = ChaCha8Rng::seed_from_u64(field.modulus());
        let mut any = || field.from_i64((random.next_u64() >> 2).cast_signed());
        let weights: Vec<Residue> = (0..free).map(|_| any()).collect();
        let (line, q) = series.motion_along(&weights, FOLLOWED);
        if let Some(order) = line.stopped {
            return Ok(Err(PoseOnly::Stopped(order)));
        }
        if line.order + 1 < POWERS {
            return Ok(Err(PoseOnly::TooLarge));
        }
        let columns = closure.columns.iter().zip(q);
        let series = columns.map(|(column, q)| {
            let q = std::iter::once(0).chain(q).take(POWERS);
            ((column.joint, column.freedom), q.collect::<Series>())
        });
        let series: BTreeMap<(JointId, Freedom), Series> = series.collect();
        let space = MotionSpace::new(exact, &mechanism.mode)?;
        let mut over = BTreeMap::new();
        for j in mechanism.joints_in(StateId::FREE) {
            let joint = &mechanism.joints[j];
            let freedoms = joint.joint_type.freedoms();
            let frame = FrameValues::new(exact, &joint.frame)?;
            let freedoms = frame.motions_in_series(exact, &space, freedoms);
            let mut moved = DisplacementSeries::identity(field, POWERS);
            let mut places = vec![[moved.clone(), moved.clone()]];
            for (freedom, twist) in &freedoms {
                let q = &series[&(j, *freedom)];
                moved = moved.then(&DisplacementSeries::exp(field, twist, q));
                places.push([moved.clone(), moved.clone()]);
            }
            over.insert(j, Passed { freedoms, places });
        }
        let mut links = vec![DisplacementSeries::identity(field, POWERS); mechanism.links.len()];
        for step in spanning_tree(mechanism, StateId::FREE) {
            let passed = over[&step.joint].displacement();
            let from = &links[step.from.index()];
            links[step.link.index()] = if step.forward {
                from.then(passed)
            } else {
                from.then(&passed.inverse())
            };
        }
        for (&j, passed) in &mut over {
            let link = &links[mechanism.joints[j].links[0].index()];
            for [moved, from_frame] in &mut passed.places {
                *from_frame = link.then(moved);
            }
        }
        Ok(Ok(Motion { field, space, over }))
    }

    /// Returns the columns of a choice at a joint, one for each freedom. `None` if it cannot follow the original joint.
    fn choice_columns(
        &self,
        exact: &ExactField,
        mechanism: &Mechanism,
        joint: JointId,
        choice: &Choice,
    ) -> Result<Option<Vec<ColumnSeries>>, ExactError> {
        let of = &mechanism.joints[joint];
        let option = &of.options[choice.option];
        let twists = |o: &JointOption| -> Result<Vec<(Freedom, Twist<Residue>)>, ExactError> {
            let frame = FrameValues::new(exact, &o.frame)?;
            Ok(frame.motions_in_series(exact, &self.space, o.joint_type.freedoms()))
        };
        let inserted = choice.unloading.map(|u| twists(&of.unloading[u]));
        let inserted = inserted.transpose()?.unwrap_or_default();
        let mut passed: Vec<InSeries> = inserted.into_iter().map(|(_, t)| (None, t)).collect();
        passed.extend(twists(option)?.into_iter().map(|(f, t)| (Some(f), t)));
        let Some(present) = self.over.get(&joint) else {
            return Ok(None);
        };
        let known = present.known_places(&passed);
        let Some(places) = known.or_else(|| self.follow_places(&passed, present)) else {
            return Ok(None);
        };
        let row = rate_row(exact, &self.space, mechanism, joint, &option.frame)?;
        let mut out = Vec::with_capacity(passed.len());
        for ((freedom, twist), place) in passed.iter().zip(&places) {
            let [within, from_frame] = place.as_ref();
            let rates = row.as_ref().map(|row| (row, within.carry_twist(twist)));
            let mut column = ColumnSeries::with_capacity(POWERS);
            for (k, there) in from_frame.carry_twist(twist).iter().enumerate() {
                let components = self.space.along_axes(exact, there);
                let coupled_by = freedom.filter(|_| k == 0);
                let mut entry =
                    coupled_twist(exact, mechanism, joint, option, coupled_by, components)?;
                if let Some((row, within)) = &rates {
                    let here = self.space.along_axes(exact, &within[k]);
                    entry.push(freedom.map_or(0, |_| rate_of_twist(exact, row, &here)));
                }
                column.push(entry);
            }
            out.push(column);
        }
        Ok(Some(out))
    }

    /// Returns the place before each of some freedoms in series that move as an original joint does. `None` if they cannot.
    fn follow_places<'p>(
        &self,
        passed: &[InSeries],
        present: &'p Passed,
    ) -> Option<Vec<Cow<'p, Place>>> {
        let q = self.follow_coordinates(passed, present.displacement())?;
        let mut place = present.places[0].clone();
        let before = passed.iter().zip(&q).map(|((_, twist), q)| {
            let here = place.clone();
            let moved = DisplacementSeries::exp(self.field, twist, q);
            place = place.each_ref().map(|d| d.then(&moved));
            Cow::Owned(here)
        });
        Some(before.collect())
    }

    /// Returns the coordinates of freedoms in series that move as the original joint does, by order of t. `None` if there
    /// are none. An unloading joint rests if the others suffice.
    fn follow_coordinates(
        &self,
        passed: &[InSeries],
        goal: &DisplacementSeries,
    ) -> Option<Vec<Series>> {
        let f = self.field;
        let mut q = vec![vec![0; POWERS]; passed.len()];
        // Freedoms of the joint itself come first where twists depend on each other.
        let mut order: Vec<usize> = (0..passed.len()).collect();
        order.sort_by_key(|&i| passed[i].0.is_none());
        let twists: Vec<&Twist<Residue>> = order.iter().map(|&i| &passed[i].1).collect();
        let combinations = Combinations::new(f, &twists);
        for k in 1..POWERS {
            let mut at = DisplacementSeries::identity(f, POWERS);
            for ((_, twist), q) in passed.iter().zip(&q) {
                at = at.then(&DisplacementSeries::exp(f, twist, q));
            }
            let gap = at.inverse().then(goal).twist_of_order(k);
            let more = combinations.factors_of(&gap)?;
            for (&i, x) in order.iter().zip(more) {
                q[i][k] = x;
            }
        }
        Some(q)
    }
}

impl Passed {
    fn displacement(&self) -> &DisplacementSeries {
        let [moved, _] = &self.places[self.freedoms.len()];
        moved
    }

    /// Returns the place before each of some freedoms in series, of which only the original ones move. `None` if the original freedoms are
    /// not among these, in the same order.
    fn known_places(&self, passed: &[InSeries]) -> Option<Vec<Cow<'_, Place>>> {
        let mut own = 0;
        let place = |(freedom, twist): &InSeries| {
            let here = Cow::Borrowed(&self.places[own]);
            let next = self.freedoms.get(own);
            own += usize::from(next.is_some_and(|(f, t)| Some(*f) == *freedom && t == twist));
            here
        };
        let places = passed.iter().map(place).collect();
        (own == self.freedoms.len()).then_some(places)
    }
}
