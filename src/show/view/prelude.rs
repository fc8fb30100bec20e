//! Names that most files of this room use.

pub(crate) use crate::format::{
    count_noun, five_digits, format_cost, four_digits, group_thousands, join_and, plural_of,
};
pub(crate) use crate::model::claim::Topic;
pub(crate) use crate::model::mechanism::{JointId, LinkId, Mechanism, Mode, Role, StateId};
pub(crate) use crate::score::outcome::Outcome;
pub(crate) use crate::view::terminal::next_commands::typed_option;
pub(crate) use crate::view::terminal::{
    Report, Table, fit_lines, row_cells, text_table, unit_prefix,
};
pub(crate) use crate::view::{
    as_read, certainty_kind, claims_about, claims_text, count_claims, format_span, join_objects,
};
pub(crate) use itertools::Itertools;
pub(crate) use serde::Serialize;
pub(crate) use serde_json::{Value, json};
