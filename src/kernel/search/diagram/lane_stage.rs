//! What happens at a variable of the diagram, lane by lane.
//!
//! In each lane a node has two subspaces of the space dual to the self-stresses of the present joints. `all` is what the choices so
//! far add in the contours that are still open. `harmless` is the part of it that moves no kept link which is closed already, in the
//! open coordinates of contours and kept links. A variable extends both by what a choice adds and drops the coordinates that close.
//! A motion goes wrong where it closes every contour and moves a kept link. There is one exactly where `all` gains fewer dimensions
//! than `harmless`: then two motions that differ only in what kept links do are both possible, and so is their difference.

use crate::linalg::modp::Field;
use crate::search::diagram::columns::Columns;
use crate::search::diagram::redundancy_so_far::{Limits, Role};

/// A variable of a lane.
#[derive(Debug)]
pub(in crate::search) struct LaneStage {
    pub(in crate::search) role: Role,
    /// The contours in use.
    pub(in crate::search) all: Columns,
    /// Contours and kept links in use, where motions are kept.
    pub(in crate::search) harmless: Option<Columns>,
    /// Whether the lane applies to each choice; to all where nothing is said.
    pub(in crate::search) applies: Vec<bool>,
}

/// A variable of the diagram.
#[derive(Debug)]
pub(in crate::search) struct Stage<'a> {
    pub(in crate::search) field: Field,
    /// Index of the variable in the space.
    pub(in crate::search) variable: usize,
    pub(in crate::search) choices: usize,
    /// The free state's first.
    pub(in crate::search) lanes: Vec<LaneStage>,
    /// What the lanes of a searched state count, after its last variable.
    pub(in crate::search) ending: Option<Vec<Role>>,
    pub(in crate::search) limits: &'a Limits,
}
