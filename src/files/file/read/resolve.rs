//! Joint frames and options from their entries.

use crate::closure::coupling::length_ratio;
use crate::closure::twist::{MotionSpace, joint_twists};
use crate::file::prelude::*;
use crate::geom::Scalars;
use crate::geom::exact::ExactField;
use crate::linalg::echelon::Echelon;

pub(crate) fn zero_vector3() -> [Expr; 3] {
    [0, 0, 0].map(Expr::from)
}

/// Returns the message of a direction that is zero.
pub(crate) fn zero_vector(what: &str, of: &str) -> String {
    format!("the {what} {of} is zero; give a direction such as [0, 0, 1]")
}

/// Returns the message of a joint that lacks what its type needs.
pub(crate) fn missing_message(joint: &str, kind: &str, what: &str) -> String {
    format!("joint \"{joint}\" of type {kind} needs {what}")
}

/// Returns the message of a key that a joint of some type does not have.
pub(crate) fn takes_no(joint: &str, kind: &str, what: &str) -> String {
    format!("joint \"{joint}\" of type {kind} takes no {what}; remove it")
}

fn is_zero(v: &[Expr; 3]) -> bool {
    to_vector(v).iter().all(|x| *x == 0.0)
}

/// Returns true if two directions are parallel: exactly for rationals, otherwise to 1e-12 of their lengths.
fn are_parallel(a: &[Expr; 3], b: &[Expr; 3]) -> bool {
    let (x, y) = (to_vector(a), to_vector(b));
    let largest = |v: [f64; 3]| v.iter().map(|x| x.abs()).fold(0.0, f64::max);
    let scale = largest(x) * largest(y);
    [(1, 2), (2, 0), (0, 1)].into_iter().all(|(i, j)| {
        // A value far from zero in floating point needs no exact check.
        if (x[i] * y[j] - x[j] * y[i]).abs() > 1e-9 * scale {
            return false;
        }
        let e = &a[i] * &b[j] - &a[j] * &b[i];
        match e.as_rational() {
            Some(_) => e.is_zero_rational(),
            None => e.to_f64().abs() <= 1e-12 * scale,
        }
    })
}

/// Returns the frame with these parts of a joint. Problems are reported for the keys of the table at the given place.
pub(crate) fn check_frame(
    joint: &str,
    point: [Expr; 3],
    axis: [Expr; 3],
    reference: Option<[Expr; 3]>,
    pitch: Expr,
    at: &Place<'_>,
) -> Frame {
    let mut axis = axis;
    let of_joint = format!("of joint \"{joint}\"");
    let zero = |what: &str| at.key(what).add_problem(zero_vector(what, &of_joint));
    if is_zero(&axis) {
        zero("axis");
        axis = [0, 0, 1].map(Expr::from);
    }
    let across = || {
        let mut globals = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].into_iter();
        let across =
            globals.find_map(|v| Some(v.map(Expr::from)).filter(|g| !are_parallel(g, &axis)));
        across.unwrap_or_else(zero_vector3)
    };
    let reference = match reference {
        Some(r) if is_zero(&r) => {
            zero("reference");
            across()
        }
        Some(r) if are_parallel(&r, &axis) => {
            at.key("reference").add_problem(format!(
                "the reference of joint \"{joint}\" is parallel to its axis; give another direction"
            ));
            across()
        }
        Some(r) => r,
        None => across(),
    };
    Frame {
        point,
        axis,
        reference,
        pitch,
    }
}

/// Returns the type that a word and a list of freedoms represent.
pub(crate) fn joint_type(
    joint: &str,
    kind: &str,
    freedoms: Option<&Vec<String>>,
    at: &Place<'_>,
) -> Option<JointType> {
    let known = JointType::from_name(kind);
    match (kind, freedoms) {
        (_, None) if known.is_some() => return known,
        ("custom", Some(words)) => {
            let list = custom_freedoms(joint, words, &at.key("freedoms"));
            return Some(JointType::Custom(list));
        }
        ("custom", None) => {
            let what = "freedoms, such as freedoms = [\"rz\", \"tx\"]";
            at.add_problem(missing_message(joint, kind, what));
        }
        (_, Some(_)) if known.is_some() => {
            let problem = takes_no(joint, kind, "freedoms");
            at.key("freedoms").add_problem(problem);
        }
        _ => {
            let known = JointType::NAMED.iter().map(JointType::name);
            let known = known.chain(["custom"]);
            at.key("type").add_unknown_word("joint type", kind, known);
        }
    }
    None
}

/// Returns the freedoms that words name, each once.
fn custom_freedoms(joint: &str, words: &[String], at: &Place<'_>) -> Vec<Freedom> {
    let mut list = Vec::new();
    for (at, w) in at.each_entry(words) {
        match Freedom::from_name(w) {
            Some(f) if list.contains(&f) => {
                at.add_problem(format!(
                    "joint \"{joint}\" names the freedom {w} twice; name it once"
                ));
            }
            Some(f) => list.push(f),
            None => at.add_unknown_word("freedom", w, Freedom::ALL.iter().map(|(_, n)| n)),
        }
    }
    list
}

impl Place<'_> {
    /// Returns a cost in thousandths; `None` if it is out of range, which is reported.
    pub(crate) fn read_cost(&self, value: f64) -> Option<i64> {
        if !(0.0..=1e6).contains(&value) {
            self.add_problem(format!(
                "cost {value} must be a finite number from 0 to 1e6"
            ));
            return None;
        }
        #[allow(clippy::cast_possible_truncation, reason = "at most 1e9")]
        Some((value * 1000.0).round() as i64)
    }
}

/// Returns the name of an option that has no name in the file.
pub(crate) fn motion_name(joint_type: &JointType) -> String {
    match joint_type {
        JointType::Custom(list) => list.iter().map(|f| f.name()).join("+"),
        other => other.name().to_owned(),
    }
}

/// Returns an option at a joint's place.
pub(crate) fn read_option(
    joint: &str,
    present: &Frame,
    entry: &OptionEntry,
    at: &Place<'_>,
) -> Option<JointOption> {
    let table = entry.as_table();
    let kind = table.kind.as_deref().unwrap_or("custom");
    let joint_type = joint_type(joint, kind, table.freedoms.as_ref(), at)?;
    let frame = option_frame(joint, present, &table, at);
    let state = table.state.as_ref().and_then(|name| {
        let known = at.out.states.iter().position(|s| s == name);
        if known.is_none() {
            at.key("state")
                .add_unknown_word("state", name, &at.out.states);
        }
        known.map(StateId::new)
    });
    let name = table.name.clone();
    Some(JointOption {
        name: name.unwrap_or_else(|| motion_name(&joint_type)),
        joint_type,
        frame,
        cost_milli: table.cost.and_then(|c| at.key("cost").read_cost(c)),
        state,
    })
}

/// Returns the frame of an option; values that its table omits are those of the joint.
fn option_frame(joint: &str, present: &Frame, table: &OptionTable, at: &Place<'_>) -> Frame {
    let axis = at.read_given("axis", table.axis.as_ref(), Place::read_direction);
    let axis = axis.unwrap_or_else(|| present.axis.clone());
    let reference = at.read_given("reference", table.reference.as_ref(), Place::read_direction);
    let own = || Some(present.reference.clone()).filter(|r| !are_parallel(r, &axis));
    let reference = reference.or_else(own);
    let pitch = at.read_pitch(&table.pitch, &table.lead);
    let pitch = pitch.unwrap_or_else(|| present.pitch.clone());
    let point = table.point.as_ref().map(|p| at.key("point").read_vector(p));
    let point = point.unwrap_or_else(|| present.point.clone());
    if table.axis.is_some() || table.reference.is_some() {
        return check_frame(joint, point, axis, reference, pitch, at);
    }
    // These directions are already checked.
    let mut frame = present.clone();
    (frame.point, frame.pitch) = (point, pitch);
    frame
}

/// Returns true if one joint allows every motion of another at the same place, computed exactly over a prime field. `None` if the
/// geometry has no image there.
///
/// # Examples
/// ```
/// use ozols::{file::read::resolve::contains_option, model::{joint_type::JointType, mechanism::JointOption}};
/// let four_bar = ozols::built_in("four-bar")?;
/// let at = |of: &JointType| JointOption::in_frame_of(&four_bar.joints[ozols::model::JointId::new(0)], of);
/// let [hinge, ball] = [JointType::Revolute, JointType::Spherical].map(|t| at(&t));
/// assert_eq!(contains_option(&ball, &hinge), Some(true));
/// assert_eq!(contains_option(&hinge, &ball), Some(false));
/// # Ok::<(), ozols::Error>(())
/// ```
pub fn contains_option(wide: &JointOption, narrow: &JointOption) -> Option<bool> {
    if wide.joint_type == narrow.joint_type && wide.joint_type == JointType::Spherical {
        return Some(true);
    }
    let freedoms = [wide, narrow].map(|o| o.joint_type.freedoms());
    if wide.frame.is_same(&narrow.frame) && freedoms[1].iter().all(|f| freedoms[0].contains(f)) {
        return Some(true);
    }
    contains_rates(wide, narrow, &[])
}

/// Returns whether the twists of the option span those of the current joint. The rates of the coupled freedoms are further components
/// of each twist.
pub(crate) fn contains_rates(
    option: &JointOption,
    present: &JointOption,
    coupled: &[Freedom],
) -> Option<bool> {
    let length = |frame: &Frame, f: Freedom| length_ratio((frame, f), (&present.frame, f));
    let coordinates = |f: &Frame| {
        let all = f.point.iter().chain(&f.axis).chain(&f.reference);
        all.chain([&f.pitch]).cloned().collect_vec()
    };
    let mut all: Vec<Expr> = coordinates(&option.frame);
    all.extend(coordinates(&present.frame));
    all.extend(coupled.iter().map(|&f| length(&option.frame, f)));
    let exact = ExactField::for_expressions(&all, 0).ok()?;
    let rows = |o: &JointOption| {
        let twists = joint_twists(&exact, &MotionSpace::Spatial, &o.frame, &o.joint_type).ok()?;
        let row = |(f, mut t): (Freedom, Vec<_>)| {
            for &c in coupled {
                let rate = if c == f {
                    length(&o.frame, f)
                } else {
                    Expr::from(0)
                };
                t.push(Scalars::eval(&exact, &rate).ok()?);
            }
            Some(t)
        };
        twists.into_iter().map(row).collect::<Option<Vec<_>>>()
    };
    let mut span = Echelon::new(exact.field());
    rows(option)?.iter().for_each(|t| {
        span.insert(t);
    });
    Some(rows(present)?.iter().all(|t| span.contains(t)))
}
