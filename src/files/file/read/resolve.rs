//! Joint frames and options from their entries.

use crate::file::Findings;
use crate::file::locate::{DocumentStep, index, key};
use crate::file::problem::ProblemKind;
use crate::file::read::value::number::{direction, pitch, vector};
use crate::file::schema::{OptionEntry, OptionTable};
use crate::geom::expr::Expr;
use crate::model::joint_type::{Freedom, JointType};
use crate::model::mechanism::{Frame, JointOption, StateId};
use itertools::Itertools;

pub(crate) fn zero3() -> [Expr; 3] {
    [0, 0, 0].map(Expr::from)
}

fn real(v: &[Expr; 3]) -> [f64; 3] {
    [v[0].to_f64(), v[1].to_f64(), v[2].to_f64()]
}

fn is_zero(v: &[Expr; 3]) -> bool {
    real(v).iter().all(|x| *x == 0.0)
}

/// Whether two directions are parallel: exactly for rationals, to 1e-12 of their lengths otherwise.
fn parallel(a: &[Expr; 3], b: &[Expr; 3]) -> bool {
    let (x, y) = (real(a), real(b));
    let largest = |v: [f64; 3]| v.iter().map(|x| x.abs()).fold(0.0, f64::max);
    let scale = largest(x) * largest(y);
    [(1, 2), (2, 0), (0, 1)].into_iter().all(|(i, j)| {
        // What is far from zero in floating point needs no exact look.
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

/// The frame with these parts; problems are reported at `path`.
pub(crate) fn frame(
    joint: &str,
    point: [Expr; 3],
    axis: [Expr; 3],
    reference: Option<[Expr; 3]>,
    pitch: Expr,
    path: &[DocumentStep],
    out: &mut Findings,
) -> Frame {
    let mut axis = axis;
    if is_zero(&axis) {
        out.add(
            &key(path, "axis"),
            ProblemKind::ZeroVector {
                joint: joint.to_owned(),
                what: "axis",
            },
        );
        axis = [0, 0, 1].map(Expr::from);
    }
    let across = || {
        let mut globals = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].into_iter();
        let across = globals.find_map(|v| Some(v.map(Expr::from)).filter(|g| !parallel(g, &axis)));
        across.unwrap_or_else(zero3)
    };
    let reference = match reference {
        Some(r) if is_zero(&r) => {
            out.add(
                &key(path, "reference"),
                ProblemKind::ZeroVector {
                    joint: joint.to_owned(),
                    what: "reference",
                },
            );
            across()
        }
        Some(r) if parallel(&r, &axis) => {
            out.add(
                &key(path, "reference"),
                ProblemKind::ParallelReference {
                    joint: joint.to_owned(),
                },
            );
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

/// The type a word and a list of freedoms stand for.
pub(crate) fn joint_type(
    joint: &str,
    kind: &str,
    freedoms: Option<&Vec<String>>,
    path: &[DocumentStep],
    out: &mut Findings,
) -> Option<JointType> {
    if let (Some(t), None) = (JointType::from_name(kind), freedoms) {
        return Some(t);
    }
    match (kind, freedoms) {
        ("custom", Some(words)) => Some(JointType::Custom(custom_freedoms(
            joint,
            words,
            &key(path, "freedoms"),
            out,
        ))),
        ("custom", None) => {
            let what = "freedoms, such as freedoms = [\"rz\", \"tx\"]";
            out.add(
                path,
                ProblemKind::Missing {
                    joint: joint.to_owned(),
                    kind: kind.to_owned(),
                    what,
                },
            );
            None
        }
        (known, Some(_)) if JointType::from_name(known).is_some() => {
            let (joint, kind) = (joint.to_owned(), kind.to_owned());
            out.add(
                &key(path, "freedoms"),
                ProblemKind::Superfluous {
                    joint,
                    kind,
                    what: "freedoms",
                },
            );
            None
        }
        _ => {
            let known = JointType::NAMED
                .iter()
                .map(JointType::name)
                .chain(["custom"])
                .join(", ");
            out.add(
                &key(path, "type"),
                ProblemKind::UnknownWord {
                    what: "joint type",
                    word: kind.to_owned(),
                    known,
                },
            );
            None
        }
    }
}

/// The freedoms that words name, each once.
fn custom_freedoms(
    joint: &str,
    words: &[String],
    at: &[DocumentStep],
    out: &mut Findings,
) -> Vec<Freedom> {
    let mut list = Vec::new();
    for (i, w) in words.iter().enumerate() {
        match Freedom::from_name(w) {
            Some(f) if list.contains(&f) => {
                out.add(
                    &index(at, i),
                    ProblemKind::RepeatedFreedom {
                        joint: joint.to_owned(),
                        freedom: w.clone(),
                    },
                );
            }
            Some(f) => list.push(f),
            None => {
                let known = Freedom::ALL.iter().map(|(_, n)| *n).join(", ");
                out.add(
                    &index(at, i),
                    ProblemKind::UnknownWord {
                        what: "freedom",
                        word: w.clone(),
                        known,
                    },
                );
            }
        }
    }
    list
}

/// A cost in thousandths.
pub(crate) fn cost(value: f64, path: &[DocumentStep], out: &mut Findings) -> Option<i64> {
    if !(0.0..=1e6).contains(&value) {
        out.add(
            path,
            ProblemKind::BadCost {
                value: value.to_string(),
            },
        );
        return None;
    }
    #[allow(clippy::cast_possible_truncation, reason = "at most 1e9")]
    Some((value * 1000.0).round() as i64)
}

/// What an option without a name of its own is called.
pub(crate) fn motion_name(joint_type: &JointType) -> String {
    match joint_type {
        JointType::Custom(list) => list.iter().map(|f| f.name()).join("+"),
        other => other.name().to_owned(),
    }
}

/// An option at a joint's place.
pub(crate) fn option(
    joint: &str,
    present: &Frame,
    entry: &OptionEntry,
    states: &[String],
    path: &[DocumentStep],
    out: &mut Findings,
) -> Option<JointOption> {
    let table = entry.table();
    let kind = table.kind.as_deref().unwrap_or("custom");
    let joint_type = joint_type(joint, kind, table.freedoms.as_ref(), path, out)?;
    let frame = option_frame(joint, present, &table, path, out);
    let name = table
        .name
        .clone()
        .unwrap_or_else(|| motion_name(&joint_type));
    let state = table.state.as_ref().and_then(|name| {
        let known = states.iter().position(|s| s == name);
        if known.is_none() {
            out.add(
                &key(path, "state"),
                ProblemKind::UnknownWord {
                    what: "state",
                    word: name.clone(),
                    known: states.join(", "),
                },
            );
        }
        known.map(StateId::new)
    });
    let cost_milli = table.cost.and_then(|c| cost(c, &key(path, "cost"), out));
    Some(JointOption {
        name,
        joint_type,
        frame,
        cost_milli,
        state,
    })
}

/// The frame of an option: what its table leaves out is as the joint has it.
fn option_frame(
    joint: &str,
    present: &Frame,
    table: &OptionTable,
    path: &[DocumentStep],
    out: &mut Findings,
) -> Frame {
    let axis = table.axis.as_ref().map_or_else(
        || present.axis.clone(),
        |v| direction(v, &key(path, "axis"), out),
    );
    let stated = table.reference.as_ref();
    let reference = stated.map_or_else(
        || Some(present.reference.clone()).filter(|r| !parallel(r, &axis)),
        |v| Some(direction(v, &key(path, "reference"), out)),
    );
    let screw = [table.pitch.as_ref(), table.lead.as_ref()];
    let pitch = pitch(screw, path, out).unwrap_or_else(|| present.pitch.clone());
    let point = table.point.as_ref().map_or_else(
        || present.point.clone(),
        |p| vector(p, &key(path, "point"), out),
    );
    if table.axis.is_some() || table.reference.is_some() {
        return frame(joint, point, axis, reference, pitch, path, out);
    }
    // Those directions are looked at already.
    Frame {
        point,
        axis,
        reference: present.reference.clone(),
        pitch,
    }
}

/// Whether one joint allows every motion of another at the same place: exactly, over a prime field; `None` where the
/// geometry has no image there.
pub fn contains(wide: &JointOption, narrow: &JointOption) -> Option<bool> {
    use crate::closure::twist::{MotionSpace, joint_twists};
    use crate::geom::exact::ExactField;
    use crate::linalg::echelon::Echelon;
    if wide.joint_type == narrow.joint_type && wide.joint_type == JointType::Spherical {
        return Some(true);
    }
    let freedoms = [wide, narrow].map(|o| o.joint_type.freedoms());
    if wide.frame.is_same(&narrow.frame) && freedoms[1].iter().all(|f| freedoms[0].contains(f)) {
        return Some(true);
    }
    let parts = |o: &JointOption| {
        let f = &o.frame;
        f.point
            .iter()
            .chain(&f.axis)
            .chain(&f.reference)
            .chain([&f.pitch])
            .cloned()
            .collect_vec()
    };
    let all = parts(wide).into_iter().chain(parts(narrow)).collect_vec();
    let exact = ExactField::for_expressions(&all, 0).ok()?;
    let twists =
        |o: &JointOption| joint_twists(&exact, &MotionSpace::Spatial, &o.frame, &o.joint_type).ok();
    let mut span = Echelon::new(exact.field());
    twists(wide)?.iter().for_each(|(_, t)| {
        span.insert(t);
    });
    Some(twists(narrow)?.iter().all(|(_, t)| span.contains(t)))
}
