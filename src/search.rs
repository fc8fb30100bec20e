//! Every redesign at once: the span diagram, exact counts on it, the best variants in order, and a brute-force twin.
//!
//! A *variant* chooses one option at each joint. A diagram node is what a partly chosen mechanism looks like to the
//! joints not chosen yet: the space of motions of the links that still have joints to come, plus the redundancy
//! spent so far. Different choices with the same node have the same futures, so a space of 10^10 variants folds into
//! some thousand nodes and is counted without visiting any variant. Where such nodes are too many, those that have the same
//! futures all the same are found by building from both ends.

pub mod approximate;
pub mod at_tolerance;
pub mod best;
mod blocks;
pub mod brute;
mod budget;
pub mod building;
mod canonical;
pub mod certify;
pub mod conditions;
pub mod cost;
pub mod counts;
pub mod diagram;
pub mod doubt;
pub mod estimate;
mod growth;
pub mod held;
pub mod ideas;
mod in_order;
mod join;
mod laid;
pub mod lanes;
mod least_model;
pub mod listing;
pub mod lookahead;
mod merge;
mod minimal;
pub mod mirror;
mod missing;
pub mod order;
pub mod over_stroke;
pub mod plan;
pub mod primes;
mod product;
pub mod proven;
pub mod realize;
pub mod relax;
pub mod second_opinion;
pub mod space;
pub mod spent;
pub mod stage;
mod stop;
pub mod suggest;
pub mod tally;
mod transition;
mod trial;
mod two_sided;
mod ways;
pub mod written;
pub mod written_out;
