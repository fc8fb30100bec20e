//! Well-known schemes in the forms that they are laid out in.

use crate::chains::layout_symmetry::Symmetry;
use crate::chains::pairs::classics::{Classic, classics};
use crate::chains::pairs::structure::PairStructure;
use crate::synthesis::paired::rules::PairRules;
use crate::synthesis::paired::structure::{PairedForm, PairedStructure};
use itertools::Itertools;

/// The well-known schemes that are structures, each once.
#[must_use]
pub(crate) fn known_schemes() -> Vec<PairedStructure> {
    let all = classics().iter();
    let all = all.unique_by(|c| (c.structure.key(), c.made_as));
    let made = |c: &Classic| {
        let plain = most_symmetric(&c.structure)?;
        let others = plain.with_flat_faces().into_iter();
        let others = others.chain(plain.with_threads());
        let mut all = plain.clone().with_one_pins().chain(others);
        all.find(|p| p.made_as() == c.made_as)
    };
    all.filter_map(made).collect()
}

/// A structure in the most symmetric form in which it lies somewhere; `None` where it does so in none.
///
/// # Complexity
/// As [`PairedStructure::lays`], for each form.
#[must_use]
pub fn most_symmetric(structure: &PairStructure) -> Option<PairedStructure> {
    let symmetric = [Symmetry::Mirror, Symmetry::HalfTurn];
    let forms = [false, true].into_iter().cartesian_product(symmetric);
    let forms = forms.map(|(one_sided, symmetry)| PairedForm {
        one_sided,
        ..PairedForm::of(symmetry)
    });
    let structure = PairStructure::of_key(&structure.key());
    let mut all = forms.chain([PairedForm::of(Symmetry::Generic)]);
    let found = all.find_map(|form| {
        let structure = structure.clone();
        let paired = PairedStructure { structure, form };
        let mut lays = paired.lays().into_iter();
        lays.any(|lay| PairRules::new(&paired, &lay).is_ok())
            .then_some(paired)
    });
    found.map(PairedStructure::on_parallelograms_if_any)
}
