//! Names that the readers and the writer of a mechanism file use.

pub(crate) use crate::file::problem::{Finding, ProblemKind};
pub(crate) use crate::file::schema::*;
pub(crate) use crate::file::{Findings, Place};
pub(crate) use crate::geom::expr::Expr;
pub(crate) use crate::geom::vector::{length, sub, to_vector};
pub(crate) use crate::model::joint_type::{Coupling, Freedom, JointType};
pub(crate) use crate::model::mechanism::{
    Frame, Joint, JointId, JointOption, Link, LinkId, Mechanism, Parts, Role, StateId,
};
pub(crate) use itertools::Itertools;
pub(crate) use std::collections::{BTreeMap, BTreeSet};
