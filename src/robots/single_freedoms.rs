//! Joints in metres and double precision, taken apart into single freedoms.

use crate::model::joint_type::{Freedom, JointType};
use crate::model::mechanism::{Joint, Mechanism};
use std::collections::BTreeSet;
use std::fmt::Write;

pub(crate) type V3 = [f64; 3];

/// A joint's place: origin in metres, unit axes x, y, z.
pub(crate) struct Place {
    pub(super) point: V3,
    pub(super) axes: [V3; 3],
    /// Metres per radian.
    pub(super) pitch: f64,
}

/// What a single freedom does, about or along its axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Single {
    Turn(V3),
    Shift(V3),
    Screw(V3, f64),
}

pub(crate) fn place(m: &Mechanism, j: &Joint) -> Place {
    let real = |v: &[crate::geom::expr::Expr; 3]| [v[0].to_f64(), v[1].to_f64(), v[2].to_f64()];
    let metres = m.length_unit.metres;
    let z = unit(real(&j.frame.axis));
    let r = real(&j.frame.reference);
    let along = dot(r, z);
    let x = unit([
        r[0] - along * z[0],
        r[1] - along * z[1],
        r[2] - along * z[2],
    ]);
    let y = [
        z[1] * x[2] - z[2] * x[1],
        z[2] * x[0] - z[0] * x[2],
        z[0] * x[1] - z[1] * x[0],
    ];
    Place {
        point: real(&j.frame.point).map(|c| c * metres),
        axes: [x, y, z],
        pitch: j.frame.pitch.to_f64() * metres,
    }
}

/// The freedoms one by one.
pub(crate) fn singles(j: &JointType, p: &Place) -> Vec<Single> {
    let [x, y, z] = p.axes;
    j.freedoms()
        .iter()
        .map(|f| match f {
            Freedom::Rx => Single::Turn(x),
            Freedom::Ry => Single::Turn(y),
            Freedom::Rz => Single::Turn(z),
            Freedom::Tx => Single::Shift(x),
            Freedom::Ty => Single::Shift(y),
            Freedom::Tz => Single::Shift(z),
            Freedom::Screw => Single::Screw(z, p.pitch),
        })
        .collect()
}

fn dot(a: V3, b: V3) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn unit(v: V3) -> V3 {
    let l = dot(v, v).sqrt();
    if l > 0.0 {
        v.map(|x| x / l)
    } else {
        [0.0, 0.0, 1.0]
    }
}

/// A number without the rounding errors of scaling.
pub(crate) fn number(x: f64) -> f64 {
    let r = (x * 1e12).round() / 1e12;
    let y = if (r - x).abs() < 1e-15 { r } else { x };
    if y == 0.0 { 0.0 } else { y }
}

/// Three numbers with spaces between.
pub(crate) fn numbers(v: V3) -> String {
    let mut out = String::new();
    for (i, x) in v.into_iter().enumerate() {
        let gap = if i == 0 { "" } else { " " };
        let _ = write!(out, "{gap}{}", number(x));
    }
    out
}

/// Unique names that robot formats take.
#[derive(Default)]
pub(crate) struct Names {
    used: BTreeSet<String>,
}

impl Names {
    pub(crate) fn fit(&mut self, wanted: &str) -> String {
        let plain = wanted.replace("::", ":");
        let mut name = plain.clone();
        let mut n = 2;
        while !self.used.insert(name.clone()) {
            name = format!("{plain}~{n}");
            n += 1;
        }
        name
    }
}

/// Text for an attribute or element.
pub(crate) fn escape(text: &str) -> String {
    quick_xml::escape::escape(text).into_owned()
}

/// Text for a comment.
pub(crate) fn comment(text: &str) -> String {
    text.replace("--", "- -")
}
