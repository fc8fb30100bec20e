//! A mechanism that is searched, with its coordinates as its file has them.

use crate::model::mechanism::Mechanism;
use crate::search::question::rounded_rank::Digits;
use std::sync::Arc;

/// A mechanism with its coordinates as a file writes them.
#[derive(Debug, Clone)]
pub struct Written {
    /// It, with the links, joints and options of the one that is searched.
    pub mechanism: Arc<Mechanism>,
    /// The mechanism in other scenes that the digits do not rule out.
    pub others: Vec<Arc<Mechanism>>,
    /// What its digits tell.
    pub digits: Digits,
    /// True if each option allows every motion of the original joint.
    pub only_adds: bool,
}
