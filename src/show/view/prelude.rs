//! Names that most files of this room use.

pub(crate) use crate::chart::{Axis, Chart, Scale, Series, Style};
pub(crate) use crate::format::csv::write_table;
pub(crate) use crate::format::{
    count_noun, first_of, five_digits, format_cost, four_digits, group_thousands, join_and,
    plural_of, three_digits,
};
pub(crate) use crate::model::claim::Topic;
pub(crate) use crate::model::mechanism::{JointId, LinkId, Mechanism, Mode, Role, StateId};
pub(crate) use crate::score::outcome::Outcome;
pub(crate) use crate::score::outcome::variant::{Variant, in_words, list_changes};
pub(crate) use crate::score::request::{List, Request};
pub(crate) use crate::search::Search;
pub(crate) use crate::search::diagram::Stop;
pub(crate) use crate::view::terminal::next_commands::{NextCommand, typed_option};
pub(crate) use crate::view::terminal::{
    Report, Table, fit_lines, row_cells, text_table, unit_prefix,
};
pub(crate) use crate::view::{
    as_read, certainty_kind, claims_about, claims_text, count_claims, format_span, group_by_key,
    join_objects,
};
pub(crate) use itertools::Itertools;
pub(crate) use num_bigint::BigUint;
pub(crate) use num_traits::Zero;
pub(crate) use serde::Serialize;
pub(crate) use serde_json::{Value, json};
pub(crate) use std::collections::{BTreeMap, BTreeSet};
pub(crate) use std::fmt::Display;
