//! Names that nearly every test needs. `tests/fuzz` includes this file, too.

pub(crate) use itertools::Itertools;
pub(crate) use num_bigint::BigUint;
pub(crate) use ozols::accuracy::change::Noise;
pub(crate) use ozols::builtin;
pub(crate) use ozols::closure::Closure;
pub(crate) use ozols::file::text::mechanism_from_str;
pub(crate) use ozols::geom::exact::ExactField;
pub(crate) use ozols::geom::expr::Expr;
pub(crate) use ozols::geom::vector::{
    add_scaled, cross, cross_plane, dot, length, quarter_turn, scale, sub, to_vector, unit,
};
pub(crate) use ozols::model::joint_type::{Freedom, JointType};
pub(crate) use ozols::model::mechanism::{JointId, LinkId, Mechanism, Mode, Role, StateId};
pub(crate) use ozols::redundancy::analysis::{Method, analyse_states, exact_field};
pub(crate) use ozols::search::Search;
pub(crate) use ozols::search::question::conditions::Conditions;
pub(crate) use serde_json::{Value, json};
pub(crate) use std::collections::{BTreeMap, BTreeSet};
pub(crate) use std::f64::consts::{PI, TAU};
pub(crate) use std::fs;
pub(crate) use std::path::{Path, PathBuf};
pub(crate) use std::process::Output;
pub(crate) use std::sync::OnceLock;

/// Accessors for JSON values of a known type.
pub(crate) trait Json {
    fn list(&self) -> &Vec<Value>;
    fn word(&self) -> &str;
    fn real(&self) -> f64;
    fn whole(&self) -> u64;
}

impl Json for Value {
    fn list(&self) -> &Vec<Value> {
        self.as_array().unwrap()
    }
    fn word(&self) -> &str {
        self.as_str().unwrap()
    }
    fn real(&self) -> f64 {
        self.as_f64().unwrap()
    }
    fn whole(&self) -> u64 {
        self.as_u64().unwrap()
    }
}

pub(crate) fn utf8_text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// Returns a built-in mechanism.
pub(crate) fn built_in(name: &str) -> Mechanism {
    ozols::built_in(name).unwrap()
}
