//! Rank of the closure matrix, with what each method knows about its answer.

pub mod along_stroke;
pub mod auto;
pub mod certificate;
pub mod counting;
mod elimination_order;
pub mod field;
pub mod finite;
pub mod generic;
pub mod higher_order;
mod kernel;
pub mod loops;
pub mod measured;
pub mod method;
pub mod modular;
mod monomials;
pub mod numeric;
pub mod parts;
pub mod rational;
pub mod reconstruct;
pub mod registry;
pub mod scaled;
pub mod snap;
pub mod subgroup;
mod tangent_cone;
pub mod trace;
