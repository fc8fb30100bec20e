//! CAD assemblies: what is read of FreeCAD's and OndselSolver's files, against an independent rank and by hand.

use crate::common::*;
pub(crate) mod make;
mod ondsel;
mod retyped;
mod told;
mod wrong;

/// What is read of bytes under a name, with no files beside.
pub(crate) fn read(name: &str, bytes: &[u8], options: &Options) -> Imported {
    import(name, bytes, &crate::robots::no_files, options).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// W and σ, as the commands have them.
pub(crate) fn figures(i: &Imported) -> (usize, usize) {
    let method = Method::Auto;
    let s = &analyse_states(&i.mechanism, &[StateId::FREE], method).unwrap()[0];
    assert_eq!(s.at_most(), None, "σ is one number");
    (s.mobility, s.redundant)
}
