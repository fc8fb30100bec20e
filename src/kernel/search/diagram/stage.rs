//! What happens in each layer of a diagram: a variable with the moves of its joints, and what is tested after them.

use crate::linalg::modp::Residue;
use crate::search::diagram::frontier::{Plan, Step};
use crate::search::diagram::output_motion::Lookahead;
use crate::search::diagram::state_copies::{Held, Move};
use crate::search::question::space::Space;
use std::ops::Range;

/// Folds away how exactly a finished kept link goes wrong.
///
/// Once all joints of a kept link are chosen, its twist matters only to the question whether the kept motions at the
/// end are the present ones. That question does not change under a linear map of the twist that leaves the present
/// motions fixed, so a motion either gives the link a present twist, which is kept, or it does not, and then all that
/// counts is which motions of the live links do so. Nodes that differ in nothing else become equal.
#[derive(Debug, Clone)]
pub(crate) struct Collapse {
    /// Coordinates of the finished links' twists relative to the frame.
    pub(in crate::search) places: Vec<usize>,
    /// Reduced basis of their present motions, in those coordinates in that order.
    pub(in crate::search) present: Vec<Vec<Residue>>,
    /// The pivots of the basis, and the other coordinates.
    pub(in crate::search) fixed: Vec<usize>,
    pub(in crate::search) open: Vec<usize>,
    /// Coordinates that do not matter of a motion that goes wrong.
    pub(in crate::search) silent: Vec<usize>,
}

impl Collapse {
    /// Of the links in these blocks of `dim` coordinates, with a reduced basis of their present motions.
    #[must_use]
    pub(crate) fn new(blocks: &[usize], dim: usize, present: Vec<Vec<Residue>>) -> Collapse {
        let places: Vec<usize> = blocks.iter().flat_map(|b| b * dim..(b + 1) * dim).collect();
        let pivot = |row: &Vec<Residue>| row.iter().position(|&x| x != 0);
        let fixed: Vec<usize> = present.iter().filter_map(pivot).collect();
        let open = (0..places.len()).filter(|i| !fixed.contains(i)).collect();
        Collapse {
            silent: places.clone(),
            places,
            present,
            fixed,
            open,
        }
    }

    /// Of coordinates in which nothing moves at present, among those of all kept links.
    #[must_use]
    pub(in crate::search) fn at_rest(finished: Range<usize>, all: Range<usize>) -> Collapse {
        Collapse {
            open: (0..finished.len()).collect(),
            places: finished.collect(),
            present: Vec::new(),
            fixed: Vec::new(),
            silent: all.collect(),
        }
    }
}

/// A variable of the diagram with the steps its joints take.
#[derive(Debug, Clone)]
pub(crate) struct Stage {
    /// Index of the variable in the space.
    pub variable: usize,
    /// How often a node is written out before the first joint is added, side by side.
    pub copies: usize,
    /// The joints added; empty where the variable does not matter to the diagram.
    pub moves: Vec<Move>,
    /// Simplification of finished kept links after this stage.
    pub collapse: Option<Collapse>,
    /// Test that nodes must pass after this stage.
    pub lookahead: Option<Lookahead>,
    /// What must be held after this stage, where it is the last of a searched state.
    pub ending: Option<Held>,
}

impl Stage {
    /// A stage that adds joints and asks for nothing more.
    #[must_use]
    pub(crate) fn plain(variable: usize, moves: Vec<Move>) -> Stage {
        Stage {
            variable,
            copies: 1,
            moves,
            collapse: None,
            lookahead: None,
            ending: None,
        }
    }
}

/// Makes one stage per variable from a plan over the joints.
///
/// `order` lists the variables as they take part; `plan` has one step per joint in the same sequence.
#[must_use]
pub(crate) fn stages(space: &Space, order: &[usize], plan: &Plan) -> Vec<Stage> {
    let mut steps = plan.steps.iter();
    order
        .iter()
        .map(|&variable| {
            let members = 0..space.variables[variable].joints.len();
            let moves = members.zip(steps.by_ref());
            let common = |(i, s): (usize, &Step)| Move::common(i, s.clone());
            Stage::plain(variable, moves.map(common).collect())
        })
        .collect()
}
