//! No more of a twist than the choices act on.
//!
//! Where every motion that a choice allows is one in a plane (a turn about its normal, slides along it) together with one out
//! of it (tilts about lines of the plane, a slide along the normal), the closure equations fall apart into those in the plane
//! and those out of it: ranks add up, and so do redundant constraints and the motions of links. If all choices of every joint
//! do the same in the plane, as a hinge, a universal joint about it and a ball do, then what is in the plane is settled once,
//! and the diagram is built of what is out of it, three rows a contour instead of six; or the other way round. Where choices
//! differ in both, the diagram is built of all six. Rows in which nothing ever moves are redundant in every contour, whatever is
//! chosen.
//!
//! What a variant is, its freedoms, W and certificate are those of the whole mechanism.

use crate::closure::contour::Contour;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::{Field, Residue};
use crate::model::mechanism::{JointId, Mechanism};
use crate::rank::reduce::plane::{Rows, planes, seen};
use crate::search::question::space::{Choice, Space, Variable};
use crate::search::reduce::self_stress_space::ClosingRows;

/// The rows of the closure equations that diagrams are built of.
#[derive(Debug)]
pub(in crate::search) struct Model {
    /// The variables and their choices in these rows.
    pub(in crate::search) space: Space,
    /// Redundant constraints that every variant has in rows that the diagrams leave out.
    pub(in crate::search) already: u32,
}

impl Model {
    /// Returns all rows of a space.
    pub(in crate::search) fn whole(space: &Space) -> Model {
        Model {
            space: space.clone(),
            already: 0,
        }
    }

    /// Returns the least model of a space, with the contours of the free state. With `whole_twists` nothing is left out.
    ///
    /// # Errors
    /// Where a coordinate has no value in the field.
    ///
    /// # Complexity
    /// O(joints · options) eliminations of six by six numbers for each plane looked at.
    pub(in crate::search) fn least(
        exact: &ExactField,
        mechanism: &Mechanism,
        contours: &[Contour],
        space: &Space,
        whole_twists: bool,
    ) -> Result<Model, ExactError> {
        let f = exact.field();
        // Lanes of a searched state, rows of couplings and of locked drives have not been taken apart.
        if whole_twists
            || space.dim != 6
            || space.state.is_some()
            || !mechanism.couplings.is_empty()
            || mechanism.locked_drives() > 0
        {
            return Ok(Model::whole(space));
        }
        let present = space
            .variables
            .iter()
            .flat_map(|v| v.joints.iter().copied());
        for plane in planes(exact, mechanism, present)? {
            let Some(parts) = plane.rows(exact) else {
                continue;
            };
            let [one, other] = &parts;
            let [inside, outside] = [(one, other), (other, one)]
                .map(|(rows, beside)| Seen::new(f, space, rows, beside));
            if !falls_apart(space, [&inside, &outside]) {
                continue;
            }
            let (differing, settled) = match [&inside, &outside].map(Seen::is_settled) {
                [true, _] => (outside, inside),
                [false, true] => (inside, outside),
                [false, false] => break,
            };
            let mut model = differing.model(f, contours.len(), space);
            model.already += redundant(f, mechanism, contours, &settled.present(space));
            return Ok(model);
        }
        Ok(Model::whole(space))
    }
}

/// Redundant constraints among the present joints in some rows of the closure equations.
fn redundant(f: Field, mechanism: &Mechanism, contours: &[Contour], present: &Space) -> u32 {
    let rows = ClosingRows::free(mechanism, present.dim, contours, None);
    let variables = present.variables.iter();
    let span = Echelon::of(f, variables.flat_map(|v| rows.columns(f, v, 0)));
    u32::try_from(rows.closing() - span.rank()).unwrap_or(u32::MAX)
}

/// Independent twists.
type Span = Vec<Vec<Residue>>;

/// What choices allow in three rows alone.
struct Seen {
    /// For each choice of each variable, the motions of its joints that are in these rows only, each with its rates behind the three
    /// numbers: independent, in reduced form.
    spans: Vec<Vec<Vec<Span>>>,
}

/// Numbers of a twist in a part.
const PART: usize = 3;

impl Seen {
    fn new(f: Field, space: &Space, rows: &Rows, beside: &Rows) -> Seen {
        let of_joint = |span: &Span| -> Span {
            let both = span.iter().map(|motion| {
                let (twist, rates) = motion.split_at(6);
                let parts = [beside, rows].map(|rows| seen(f, rows, twist));
                [&parts.concat(), rates].concat()
            });
            let both = Echelon::of(f, both).reduced().into_iter();
            let within = both.filter(|motion| motion[..PART].iter().all(|&x| x == 0));
            within.map(|motion| motion[PART..].to_vec()).collect()
        };
        let of_choice = |c: &Choice| c.spans.iter().map(of_joint).collect();
        let variables = space.variables.iter();
        Seen {
            spans: variables
                .map(|v| v.choices.iter().map(of_choice).collect())
                .collect(),
        }
    }

    /// Whether every choice does what the present joint does.
    fn is_settled(&self) -> bool {
        let alike = |choices: &Vec<Vec<Span>>| choices.iter().all(|c| *c == choices[0]);
        self.spans.iter().all(alike)
    }

    /// Rows that tell all motions apart: the pivots of their span, or any one row where nothing moves.
    fn used(&self, f: Field) -> Vec<usize> {
        let motions = self.spans.iter().flatten().flatten().flatten();
        let used = Echelon::of(f, motions.map(|motion| &motion[..PART])).pivots();
        if used.is_empty() { vec![0] } else { used }
    }

    /// Whether a joint has a rate in these rows.
    fn has_rate(&self, space: &Space, joint: JointId) -> bool {
        let of_variable = |(variable, choices): (&Variable, &Vec<Vec<Span>>)| {
            let member = variable.joints.iter().position(|&j| j == joint);
            let motions = |m: usize| choices.iter().flat_map(move |spans| &spans[m]);
            member.is_some_and(|m| motions(m).any(|motion| motion[PART..].iter().any(|&x| x != 0)))
        };
        space.variables.iter().zip(&self.spans).any(of_variable)
    }

    /// The model of the rows that are used.
    fn model(self, f: Field, contours: usize, whole: &Space) -> Model {
        let used = self.used(f);
        // In further rows of each contour nothing moves.
        let idle = (PART - used.len()) * contours;
        Model {
            already: u32::try_from(idle).unwrap_or(u32::MAX),
            space: self.space(whole, &used),
        }
    }

    /// The space of all choices, in rows that are used.
    fn space(self, whole: &Space, used: &[usize]) -> Space {
        let mut out = whole.clone();
        out.dim = used.len();
        for (variable, choices) in out.variables.iter_mut().zip(self.spans) {
            for (choice, spans) in variable.choices.iter_mut().zip(choices) {
                let within = |motion: Vec<Residue>| -> Vec<Residue> {
                    let twist = used.iter().map(|&r| motion[r]);
                    twist.chain(motion[PART..].iter().copied()).collect()
                };
                let of_joint = |span: Span| span.into_iter().map(within).collect();
                choice.spans = spans.into_iter().map(of_joint).collect();
            }
        }
        out
    }

    /// The space of the present joints.
    fn present(self, whole: &Space) -> Space {
        let mut out = self.space(whole, &[0, 1, 2]);
        out.variables.iter_mut().for_each(|v| v.choices.truncate(1));
        out
    }
}

/// Whether each choice's motions are those of the two parts together, and no joint has a rate in both.
fn falls_apart(space: &Space, parts: [&Seen; 2]) -> bool {
    let mut joints = space.variables.iter().flat_map(|v| &v.joints);
    if joints.any(|&j| parts.iter().all(|p| p.has_rate(space, j))) {
        return false;
    }
    space.variables.iter().enumerate().all(|(v, variable)| {
        variable.choices.iter().enumerate().all(|(c, choice)| {
            choice.spans.iter().enumerate().all(|(j, span)| {
                let freedoms = parts.map(|p| p.spans[v][c][j].len());
                span.len() == freedoms[0] + freedoms[1]
            })
        })
    })
}
