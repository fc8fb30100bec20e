//! The search: what it counts, lists and leaves out.

pub(crate) mod beyond_budget;
mod blocks;
mod both_ends;
mod certify;
mod costs;
mod drives;
#[allow(dead_code, reason = "the benchmark of growth has them all")]
#[path = "../../benches/growth/families.rs"]
mod families;
mod held;
pub(crate) mod ideas;
mod inside;
mod known_variants;
mod listed;
mod none_at_once;
mod order;
mod self_stresses;
mod suggest;
mod symmetric_best;
mod throughout;
pub(crate) mod twin;
mod usual_options;
mod variants;
pub(crate) mod varied;
