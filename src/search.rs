//! Every redesign at once: the span diagram, exact counts on it, the best variants in order, and a brute-force twin.
//!
//! A *variant* chooses one option at each joint. A diagram node is what a partly chosen mechanism looks like to the
//! joints not chosen yet: the space of motions of the links that still have joints to come, plus the redundancy
//! spent so far. Different choices with the same node have the same futures, so a space of 10^10 variants folds into
//! some thousand nodes and is counted without visiting any variant. Where such nodes are too many, those that have the same
//! futures all the same are found by building from both ends.

pub mod answer;
pub mod build;
pub mod check;
pub mod diagram;
pub mod numeric;
pub mod order;
pub mod question;
mod reduce;
