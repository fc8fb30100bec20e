//! How well numbers are known, where the file states it.

use crate::file::schema::{Coordinate, MechanismFile};
use crate::file::{Findings, Place};
use crate::geom::expr::{End, Expr, WrittenNumber};
use crate::geom::extent::diagonal;
use crate::geom::vector::{length, real};
use crate::model::mechanism::{Frame, Joint, Mechanism};

/// Directions that are off by more, in radians, say nothing.
const MOST_TURN: f64 = 0.1;
/// Maximum uncertainty of places, as a fraction of the size of the mechanism.
const MOST_SHIFT: f64 = 0.1;

/// Puts what is stated in place of what digits say.
pub(crate) fn tolerance(file: &MechanismFile, m: &mut Mechanism, out: &Findings) {
    let across = diagonal(m.joints.iter().map(|j| real(&j.frame.point)));
    // Joints that are all in one place have no size.
    let most = if across > 0.0 {
        MOST_SHIFT * across
    } else {
        f64::INFINITY
    };
    let allowed = "0, or at most a tenth of the distance across the joints";
    let shift = |at: Place<'_>, c: &Option<Coordinate>| at.stated(c, most, allowed);
    let (of_file, at) = (
        file.tolerance.clone().unwrap_or_default(),
        out.key("tolerance"),
    );
    let lengths = shift(at.key("length"), &of_file.length);
    let of_joints: Vec<Option<f64>> = out
        .key("joint")
        .entries(&file.joint)
        .map(|(at, j)| shift(at.key("tolerance"), &j.tolerance))
        .collect();
    let of_points: Vec<Option<f64>> = out
        .key("point")
        .entries(&file.point)
        .map(|(at, p)| shift(at.key("tolerance"), &p.tolerance))
        .collect();
    let at = at.key("direction");
    let directions = at.stated(&of_file.direction, MOST_TURN, "0, or at most 0.1 rad");
    for (joint, own) in m.joints.iter_mut().zip(of_joints) {
        joint_at(joint, lengths, directions, own);
    }
    for (point, own) in m.points.iter_mut().zip(of_points) {
        put(&mut point.point, lengths, own);
    }
}

impl Place<'_> {
    /// Returns a tolerance; `None` if it is missing or not valid.
    fn stated(&self, c: &Option<Coordinate>, most: f64, allowed: &'static str) -> Option<f64> {
        let before = self.out.count();
        let value = self.number(c.as_ref()?).to_f64();
        if self.out.count() > before {
            return None;
        }
        let fits = (0.0..=most).contains(&value);
        if !fits {
            self.bad("tolerance", value, allowed);
        }
        fits.then_some(value)
    }
}

fn joint_at(joint: &mut Joint, lengths: Option<f64>, directions: Option<f64>, own: Option<f64>) {
    let before = joint.frame.point.clone();
    let at_joint = |f: &Frame| f.point.iter().zip(&before).all(|(a, b)| a.is_same(b));
    let offered = joint.options.iter_mut().chain(&mut joint.unloading);
    let frames = offered.map(|o| &mut o.frame).chain([&mut joint.frame]);
    for frame in frames {
        let own = own.filter(|_| at_joint(frame));
        put(&mut frame.point, lengths, own);
        if let Some(half) = lengths {
            pitch(&mut frame.pitch, half);
        }
        if let Some(half) = directions {
            turn(&mut frame.axis, half);
            turn(&mut frame.reference, half);
        }
    }
}

/// Sets the uncertainty of a point: of all its numbers if it has its own tolerance, otherwise of those written as numbers, except
/// whole 0.
fn put(point: &mut [Expr; 3], of_file: Option<f64>, own: Option<f64>) {
    for e in point {
        let half =
            own.or_else(|| of_file.filter(|_| is_number(e) && !(is_whole(e) && e.to_f64() == 0.0)));
        state(e, half);
    }
}

/// Sets the uncertainty of a direction in radians: of its numbers, except whole 0 and 1.
fn turn(v: &mut [Expr; 3], half: f64) {
    let of_length = half * length(real(v));
    for e in v {
        let size = e.to_f64().abs();
        let chosen = is_whole(e) && (size == 0.0 || size == 1.0);
        state(e, Some(of_length).filter(|_| is_number(e) && !chosen));
    }
}

/// Sets the uncertainty of a pitch, or of the pitch that follows from a lead.
fn pitch(e: &mut Expr, half: f64) {
    let WrittenNumber::Decimal(digits) = e.written() else {
        return;
    };
    state(e, Some(half * digits.factor()));
}

fn state(e: &mut Expr, half: Option<f64>) {
    if let Some(half) = half {
        *e = std::mem::replace(e, Expr::from(0)).with_half_unit(half);
    }
}

fn is_number(e: &Expr) -> bool {
    matches!(
        e.written(),
        WrittenNumber::Decimal(_) | WrittenNumber::Whole
    )
}

fn is_whole(e: &Expr) -> bool {
    match e.written() {
        WrittenNumber::Whole => true,
        WrittenNumber::Decimal(digits) => digits.end == End::Float,
        WrittenNumber::No | WrittenNumber::Stated(_) => false,
    }
}
