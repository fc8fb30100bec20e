//! Results read from finished diagrams: counts, the cheapest variants in order, samples, ideas, single changes, and reasons why nothing is
//! found.

pub mod by_tally;
pub(crate) mod count;
pub(crate) mod count_tables;
pub mod counts;
pub mod estimate;
pub mod everywhere;
pub mod ideas;
pub mod k_best;
pub mod keys;
pub(crate) mod proven_cheapest;
pub mod search_counts;
pub mod single_changes;
pub(crate) mod variants_in_order;
pub mod why_none;
