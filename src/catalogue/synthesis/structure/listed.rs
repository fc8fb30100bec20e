//! Every structure of a number of links.

use crate::chains::roles::Subject;
use crate::chains::sharing::Menu;
use crate::chains::structure::PairStructure;
use crate::chains::symmetric_census::symmetric_grippers;
use crate::chains::visit::visit_pair_chains;
use crate::chains::{Input, Symmetry};
use crate::synthesis::structure::{Form, Structure};
use itertools::Itertools;
use std::collections::BTreeSet;
use std::sync::{Mutex, PoisonError};

/// Returns the symmetric structures of N links that have pairs of these kinds.
///
/// # Complexity
/// As [`symmetric_grippers`].
///
/// # Examples
/// ```
/// use ozols::{chains::sharing::Menu, synthesis::structure::listed::symmetric_structures};
/// let all = symmetric_structures(6, Menu { kinds: &[], most: 0 });
/// // An id each.
/// let ids: std::collections::BTreeSet<String> = all.iter().map(|s| s.id()).collect();
/// assert_eq!(ids.len(), all.len());
/// ```
#[must_use]
pub fn symmetric_structures(links: usize, menu: Menu<'_>) -> Vec<Structure> {
    let all = symmetric_grippers(links, menu).into_iter();
    let symmetry = |half_turn| {
        if half_turn {
            Symmetry::HalfTurn
        } else {
            Symmetry::Mirror
        }
    };
    all.map(|g| Structure::new(g.structure, Form::of_symmetry(symmetry(g.kind.half_turn))))
        .collect()
}

/// Returns every essential structure of the given numbers of links and jaws that has pairs of these kinds, laid out without a symmetry.
///
/// # Complexity
/// As [`visit_pair_chains`], and a canonical numbering for each.
#[must_use]
pub fn generic_structures(links: usize, jaws: usize, menu: Menu<'_>) -> Vec<Structure> {
    let all = Mutex::new(BTreeSet::new());
    visit_pair_chains(links, menu, &|subject| {
        let drives = subject.list_drives().into_iter();
        let roles = drives.flat_map(|(frame, input)| subject.list_grippers(frame, &input, jaws));
        let essential = roles.filter(|r| subject.is_essential(r));
        let keys = essential.map(|roles| {
            let chain = subject.chain.clone();
            PairStructure { chain, roles }.canonical_key()
        });
        // Numbered before others have to wait.
        let keys: Vec<_> = keys.collect();
        all.lock()
            .unwrap_or_else(PoisonError::into_inner)
            .extend(keys);
    });
    let all = all.into_inner().unwrap_or_else(PoisonError::into_inner);
    let structure = |key| {
        Structure::new(
            PairStructure::of_key(&key),
            Form::of_symmetry(Symmetry::Generic),
        )
    };
    all.into_iter().map(structure).collect()
}

/// Returns the essential grippers that a chain of hinges makes with N jaws, in each of the forms that they can have. A gripper can have
/// a symmetric form if its graph is symmetric. It can have a parallel form if each jaw is on a ring of four links, with the frame or with
/// a sliding driver.
///
/// # Complexity
/// A step for each choice of roles and each form.
#[must_use]
pub fn hinged_structures(
    subject: &Subject<'_>,
    jaws: usize,
    forms: &[(Input, Form)],
) -> Vec<Structure> {
    let mut out = Vec::new();
    let forms = forms
        .iter()
        .filter(|(_, form)| form.suits_jaws(jaws))
        .collect_vec();
    let is_generic = |form: &Form| form.symmetry == Symmetry::Generic;
    let generic = forms.iter().any(|(_, form)| is_generic(form));
    // Nothing carries the jaws of a chain without symmetries to each other.
    if !generic && subject.automorphisms.len() == 1 {
        return out;
    }
    for roles in subject.grippers_apart(jaws) {
        let symmetric = subject.is_graph_symmetric(&roles);
        if !(generic || symmetric) || !subject.is_essential(&roles) {
            continue;
        }
        for &&(input, form) in forms.iter().filter(|(_, f)| symmetric || is_generic(f)) {
            let chain = subject
                .chain
                .clone()
                .with_pair(roles.input, input.driven_pair());
            let roles = roles.clone();
            let structure = Structure::new(PairStructure { chain, roles }, form);
            if !form.parallel || structure.parallelogram_rings().is_some() {
                out.push(structure);
            }
        }
    }
    out
}
