//! Names that most readers and writers use.

pub(crate) use crate::file::problem::{ImportError, ProblemKind};
pub(crate) use crate::geom::rigid::{RigidMotion, perpendicular, unit_or_z};
pub(crate) use crate::geom::vector::{
    Vector, X, Y, Z, add, add_scaled, cross, dot, length, scale, sub, to_vector,
};
pub(crate) use crate::model::joint_type::{Freedom, JointType};
pub(crate) use crate::model::mechanism::{JointId, Link, LinkId, Mechanism, Role, StateId};
pub(crate) use crate::robots::description::{
    End, Part, Ratio, Robot, free_joint, joint_of_word, same_link,
};
pub(crate) use crate::robots::warning::{
    ExportError, Found, Options, Read, Reader, bad_value, missing_problem, syntax_problem,
    too_large, too_many, unknown_name, unknown_word, unsupported_problem,
};
pub(crate) use crate::robots::xml::element::Element;
pub(crate) use crate::robots::xml::{Document, Input, decode_utf8};
pub(crate) use itertools::Itertools;
pub(crate) use std::collections::{BTreeMap, BTreeSet};
pub(crate) use std::fmt::Write;
