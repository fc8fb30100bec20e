//! Names that most files of this room use.

pub(crate) use crate::format::{cost, figure, grouped, list, plural, plural_of, significant};
pub(crate) use crate::model::mechanism::{JointId, LinkId, Mechanism, Mode, Role, StateId};
pub(crate) use crate::score::outcome::Outcome;
pub(crate) use crate::view::terminal::layout::{Report, cells, fit, prefix, table};
pub(crate) use crate::view::terminal::next_commands::flag;
pub(crate) use crate::view::{as_read, joined, kind, span};
pub(crate) use itertools::Itertools;
pub(crate) use serde::Serialize;
pub(crate) use serde_json::{Value, json};
