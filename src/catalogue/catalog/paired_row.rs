//! Rows of structures with slides, gears and slots.

use crate::catalog::row::{Laid, LaidFile, StructureRow, of_its_own, regular};
use crate::catalog::spec::Spec;
use crate::catalog::{RowError, mechanism};
use crate::file::schema::MechanismFile;
use crate::synthesis::figures::LayoutFigures;
use crate::synthesis::layout::NoLayout;
use crate::synthesis::paired::layout::{PairLayout, figures, layout, layout_of_three, of_three};
use crate::synthesis::paired::mechanism::mechanism_file;
use crate::synthesis::paired::mechanism_of_three::mechanism_file_of_three;
use crate::synthesis::paired::structure::PairedStructure;
use crate::synthesis::paired::threefold::{SIDES, ThreefoldStructure};

/// A row of a structure with slides, gears or slots.
pub(crate) type PairedRow = StructureRow<PairedStructure, PairLayout>;

/// The row of one with three jaws.
pub(crate) type ThreefoldRow = StructureRow<ThreefoldStructure, PairLayout>;

/// The row of a structure with slides, gears or slots.
///
/// # Errors
/// As [`crate::catalog::row::row`].
///
/// # Complexity
/// A search for places and one of the variants.
pub(crate) fn row_of_paired(paired: &PairedStructure, spec: &Spec) -> Result<PairedRow, RowError> {
    let menu = spec.menu()?;
    let laid = lay_pairs(
        spec,
        || paired.name(),
        |seed| layout(paired, &spec.limits(), seed),
        |layout| mechanism_file(paired, layout, &menu, &spec.workload),
        |layout| figures(paired, layout),
    )?;
    let (chain, roles) = (&paired.structure.chain, &paired.structure.roles);
    let at_frame = |&&jaw: &&usize| chain.between(roles.frame, jaw).is_some();
    Ok(StructureRow {
        jaws_at_frame: roles.jaws.iter().filter(at_frame).count(),
        truss: false,
        graph_symmetric: paired.is_graph_symmetric(),
        structure: paired.clone(),
        laid,
    })
}

/// The row of one with three jaws.
///
/// # Errors
/// As [`crate::catalog::row::row`].
///
/// # Complexity
/// As [`row_of_paired`].
pub(crate) fn row_of_three(
    structure: &ThreefoldStructure,
    spec: &Spec,
) -> Result<ThreefoldRow, RowError> {
    let menu = spec.menu()?;
    let laid = lay_pairs(
        spec,
        || structure.name(),
        |seed| layout_of_three(structure, &spec.limits(), seed),
        |layout| mechanism_file_of_three(structure, layout, &menu, &spec.workload),
        |layout| of_three(structure, layout),
    )?;
    let roles = &structure.two.structure.roles;
    let at_frame = structure
        .two
        .structure
        .chain
        .between(roles.frame, roles.jaws[0]);
    Ok(StructureRow {
        jaws_at_frame: if at_frame.is_some() { SIDES } else { 0 },
        truss: false,
        graph_symmetric: true,
        structure: structure.clone(),
        laid,
    })
}

/// What is laid out under a seed, as a file with its figures, searched.
fn lay_pairs(
    spec: &Spec,
    name: impl Fn() -> String,
    layout: impl Fn(u64) -> Result<PairLayout, NoLayout>,
    file: impl Fn(&PairLayout) -> MechanismFile,
    figures: impl Fn(&PairLayout) -> Option<LayoutFigures>,
) -> Result<Result<Laid<PairLayout>, NoLayout>, RowError> {
    regular(spec, |seed| {
        let layout = match layout(seed) {
            Ok(layout) => layout,
            Err(why) => return Ok(Err(why)),
        };
        let (name, file) = (name(), file(&layout));
        let as_file = LaidFile {
            built: mechanism(&name, &file)?,
            figures: figures(&layout),
            name,
            file,
        };
        as_file.searched(layout, |built| of_its_own(built, spec))
    })
}
