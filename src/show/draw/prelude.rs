//! Names that most files of this room use.

pub(crate) use crate::draw::place::projection::{JointInSpace, Sight, View};
pub(crate) use crate::draw::sheet::{Anchor, Drawing, SMALL, Shape, Sheet, Swatch};
pub(crate) use crate::draw::subject::{Mark, Subject};
pub(crate) use crate::geom::vector::{Vector, X, Y, Z};
pub(crate) use crate::model::joint_type::{Coupling, Freedom, JointType};
pub(crate) use crate::model::mechanism::{Joint, JointId, LinkId, Mechanism, Role, StateId};
pub(crate) use crate::redundancy::stress::SelfStress;
pub(crate) use crate::svg::plane::{
    Point, Rect, add, bounds_of, cross, dot, is_inside, mean, path_data, plane_norm, scale, sub,
    to_segment, unit,
};
pub(crate) use crate::svg::text::{shorten_names, text_width};
pub(crate) use std::f64::consts::TAU;
pub(crate) use std::fmt::Write as _;
