//! Where links and joints stand in a picture: layouts of schemes, and projections of mechanisms in space.

pub(in crate::draw) mod graph;
pub(in crate::draw) mod initial_layout;
pub(in crate::draw) mod layout;
pub(in crate::draw) mod layout_penalty;
pub(in crate::draw) mod mirror;
pub(in crate::draw) mod projection;
pub(in crate::draw) mod random;
pub(in crate::draw) mod view_direction;
