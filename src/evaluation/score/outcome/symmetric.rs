//! The cheapest redesigns of a symmetric mechanism that are symmetric themselves, for each number of redundant constraints left.

use crate::model::mechanism::StateId;
use crate::redundancy::state_figures;
use crate::score::outcome::Outcome;
use crate::score::request::List;
use crate::search::Search;
use crate::search::answer::k_best::Assignment;
use crate::search::diagram::{Control, ShouldCancel, Stop};
use crate::search::question::conditions::{Conditions, SearchError, Symmetry};
use std::collections::BTreeSet;

/// Largest number of remaining redundant constraints.
const LEFT: u32 = 2;
/// Largest number of nodes of a diagram. Equal choices for images make small diagrams.
const NODES: usize = 20_000;
/// Variants searched for one that leaves exactly the wanted number of redundant constraints.
const LOOKED_AT: usize = 10_000;

/// The cheapest symmetric redesign that leaves so many redundant constraints.
#[derive(Debug)]
pub struct SymmetricRedesign {
    /// How many.
    pub left: u32,
    /// The search for such variants, with joints that are images of each other as one variable.
    pub search: Search,
    /// The variant.
    pub variant: Assignment,
}

/// The cheapest symmetric redesigns.
#[derive(Debug)]
pub struct SymmetricBest {
    /// The cheapest with 0, 1 and 2 remaining redundant constraints, if one was found.
    pub best: Vec<SymmetricRedesign>,
    /// Why no symmetric redesign leaves no redundant constraint and adds no idle motion; `None` where one does, or the reason is another.
    pub odd: Option<OddFreedoms>,
}

/// Freedoms that joints chosen alike cannot add.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OddFreedoms {
    /// How many would have to be added.
    pub needed: i64,
    /// How many joints at a time they are added at.
    pub at_a_time: i64,
}

impl Outcome {
    /// Returns the cheapest symmetric redesigns if the mechanism is symmetric and all variants were requested in the free
    /// state. Each is symmetric by a third of a turn. If there is none, by a mirror or half turn.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value in the field.
    ///
    /// # Complexity
    /// Three searches of each symmetry. Joints that are images of each other are one variable.
    ///
    /// # Examples
    /// ```
    /// let outcome = ozols::search(&ozols::built_in("gripper-10")?, &ozols::Request::default())?;
    /// let found = outcome.symmetric_best(&|| false)?.expect("it has a mirror");
    /// assert!(found.best.iter().all(|b| b.left <= 2));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn symmetric_best(
        &self,
        should_cancel: ShouldCancel<'_>,
    ) -> Result<Option<SymmetricBest>, SearchError> {
        let asked = &self.search.conditions;
        let plain = asked.symmetry == Symmetry::All
            && asked.max_redundant == 0
            && asked.state.is_none()
            && asked.keep_output
            && self.is_exact()
            && !matches!(self.request.list, List::Nothing | List::Top(0))
            && !self.search.mechanism.search.locks_drives;
        if !plain {
            return Ok(None);
        }
        let symmetric = self.search.symmetric_mechanisms();
        let mut best = Vec::new();
        let mut odd = None;
        for left in 0..=LEFT {
            let conditions = Conditions {
                symmetry: Symmetry::SymmetricOnly,
                max_redundant: left,
                throughout: asked.throughout && left == 0,
                nodes: NODES,
                cheapest: 0,
                estimate: None,
                // Its options may have other second axes.
                written: None,
                ..asked.clone()
            };
            for mechanism in &symmetric {
                let exact = self.search.exact.clone();
                let search = match Search::new(exact, mechanism.clone(), conditions.clone()) {
                    Err(SearchError::Mirror(_)) => return Ok(None),
                    other => other?,
                };
                if left == 0 && symmetric.len() == 1 {
                    odd = odd_freedoms(&search)?;
                }
                let diagrams = search.build_diagrams(Control::cancelled_by(should_cancel));
                let just = |v: &Assignment| v.key.internal() == left;
                let found = (diagrams.admissible.stop == Stop::Exhausted)
                    .then(|| search.cheapest_variants(&diagrams, LOOKED_AT).find(just));
                if let Some(variant) = found.flatten() {
                    best.push(SymmetricRedesign {
                        left,
                        search,
                        variant,
                    });
                    break;
                }
            }
        }
        Ok((!symmetric.is_empty()).then_some(SymmetricBest { best, odd }))
    }
}

/// Returns how many freedoms a redesign adds that leaves no redundant constraint and no further motion, where joints that are chosen
/// alike cannot add so many because each change is made at several of them.
fn odd_freedoms(search: &Search) -> Result<Option<OddFreedoms>, SearchError> {
    let present = state_figures(&search.mechanism, StateId::FREE)?;
    let needed = i64::try_from(present.redundant).unwrap_or(i64::MAX);
    let choices = search
        .space
        .variables
        .iter()
        .filter(|v| v.choices.len() > 1);
    let sizes: BTreeSet<usize> = choices.map(|v| v.joints.len()).collect();
    let at_a_time = match sizes.into_iter().collect::<Vec<_>>()[..] {
        [size] if size > 1 => i64::try_from(size).unwrap_or(i64::MAX),
        _ => return Ok(None),
    };
    Ok((needed % at_a_time != 0).then_some(OddFreedoms { needed, at_a_time }))
}
