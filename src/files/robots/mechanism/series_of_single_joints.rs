//! Joints in metres and double precision, taken apart into single freedoms.

use crate::model::mechanism::Joint;
use crate::robots::prelude::*;

/// A joint's place: origin in metres, unit axes x, y, z.
pub(crate) struct JointAxes {
    pub(in crate::robots) point: Vector,
    pub(in crate::robots) axes: [Vector; 3],
    /// Metres per radian.
    pub(in crate::robots) pitch: f64,
}

impl JointAxes {
    /// Returns the axis that a freedom turns about or slides along.
    pub(crate) fn axis(&self, freedom: Freedom) -> Vector {
        self.axes[freedom.axis()]
    }
}

pub(crate) fn joint_axes(m: &Mechanism, j: &Joint) -> JointAxes {
    let metres = m.length_unit.metres;
    JointAxes {
        point: to_vector(&j.frame.point).map(|c| c * metres),
        axes: j.frame.unit_axes(),
        pitch: j.frame.pitch.to_f64() * metres,
    }
}

/// Removes the rounding errors of scaling from a number.
pub(crate) fn clean_number(x: f64) -> f64 {
    let r = (x * 1e12).round() / 1e12;
    let y = if (r - x).abs() < 1e-15 { r } else { x };
    if y == 0.0 { 0.0 } else { y }
}

/// Formats three numbers with spaces between them.
pub(crate) fn format_numbers(v: Vector) -> String {
    let mut out = String::new();
    for (i, x) in v.into_iter().enumerate() {
        let gap = if i == 0 { "" } else { " " };
        let _ = write!(out, "{gap}{}", clean_number(x));
    }
    out
}

/// The names in use.
#[derive(Default)]
pub(crate) struct Names(pub(in crate::robots) BTreeSet<String>);

impl Names {
    /// Returns a unique name that robot formats take.
    pub(crate) fn fit_name(&mut self, wanted: &str) -> String {
        let plain = wanted.replace("::", ":");
        self.unique_name(plain.clone(), |n| format!("{plain}~{n}"))
    }

    /// Returns a name that is not used yet, and marks it as used: the first, or the `nth` one with the smallest n from 2 on.
    pub(crate) fn unique_name(&mut self, first: String, nth: impl Fn(usize) -> String) -> String {
        let (mut name, mut n) = (first, 2);
        while !self.0.insert(name.clone()) {
            name = nth(n);
            n += 1;
        }
        name
    }
}

/// Escapes text for an attribute or element.
pub(crate) fn escape_xml(text: &str) -> String {
    quick_xml::escape::escape(text).into_owned()
}

/// Returns the attributes of an element, each with a blank before it; values are escaped.
pub(crate) fn write_attributes<'t>(all: impl IntoIterator<Item = (&'t str, &'t str)>) -> String {
    let one = |(name, value)| format!(" {name}=\"{}\"", escape_xml(value));
    all.into_iter().map(one).collect()
}

/// Escapes text for a comment.
pub(crate) fn escape_comment(text: &str) -> String {
    text.replace("--", "- -")
}
