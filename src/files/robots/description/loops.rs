//! Loop closures from a separate file: YAML, JSON or TOML, in three shapes.
//!
//! - ozols' own: a list `loop` of tables with `a` and `b` (names of links, frames or joints), `type` (spherical by
//!   default), and `point_a`, `point_b`, `axis_a`, `axis_b` in those frames;
//! - `closed_loop: [[a, b], ...]`, `type: [6d, 3d, ...]`, `name_mot: [...]` of example-parallel-robots, with `joint_name: [...]`
//!   and `joint_type: [...]` of the joints whose types differ from the URDF;
//! - Drake's list of `ball_constraint_body_A`, `ball_constraint_p_AP`, `..._body_B`, `..._p_BQ`.

use crate::file::text::decode_utf8;
use crate::robots::prelude::*;
use serde::de::{DeserializeOwned, Error};
use serde::{Deserialize, Deserializer};
use serde_json::Value;

/// Largest file, in bytes.
const MAX_BYTES: usize = 1 << 20;
const TYPES: &str = "revolute, prismatic, cylindrical, spherical, ball, 3d, fixed, weld, 6d";

/// Adds the closures that the file names.
pub(crate) fn add_loops(name: &str, bytes: &[u8], robot: &mut Robot) -> Read<()> {
    let mut added = || {
        if bytes.len() > MAX_BYTES {
            return Err(too_large(bytes.len(), MAX_BYTES));
        }
        let found = parse_loops(name, decode_utf8(bytes)?);
        read_loops(&found.map_err(syntax_problem)?, robot)
    };
    added().map_err(|p| p.in_file(name, "", None))
}

/// Reports a file next to a URDF that defines loops but was not asked for, and counts their rows. Such a file has the name of the
/// description, or `robot`, as in example-parallel-robots.
pub(crate) fn report_beside(name: &str, read: Reader<'_>, robot: &mut Robot) {
    let stem = std::path::Path::new(name).file_stem();
    let stem = stem.map_or(String::new(), |s| s.to_string_lossy().into_owned());
    let endings = ["yaml", "yml", "json", "toml"];
    let own = endings.map(|e| format!("{stem}.{e}"));
    let others = ["robot.yaml", "robot.yml"].map(str::to_owned);
    let own = own.map(|f| (true, f)).into_iter();
    for (is_own, file) in own.chain(others.map(|f| (false, f))) {
        let Some(bytes) = read(&file).ok().filter(|b| has_loops(&file, b)) else {
            continue;
        };
        let mut closed = robot.clone();
        let rows = match add_loops(&file, &bytes, &mut closed) {
            Ok(()) => {
                let held = |p: &Part| 6 - p.joint_type.freedoms().len();
                let rows = |r: &Robot| r.joints.iter().map(held).sum::<usize>();
                rows(&closed).saturating_sub(rows(robot))
            }
            // It may be that of another robot.
            Err(_) if !is_own => continue,
            Err(_) => 6,
        };
        let what = format!(
            "it defines closed loops of this robot, which are omitted; give {file} as `loops` to read them"
        );
        let element = format!("{file} next to it");
        robot.report.leave_out(&element, rows, what);
        return;
    }
}

/// Returns true if a file has one of the forms that define loops.
fn has_loops(name: &str, bytes: &[u8]) -> bool {
    let text = std::str::from_utf8(bytes).ok();
    let text = text.filter(|t| t.len() <= MAX_BYTES);
    let Some(found) = text.and_then(|t| parse_loops(name, t).ok()) else {
        return false;
    };
    let full = |k: &str| found[k].as_array().is_some_and(|l| !l.is_empty());
    let mut entries = found.as_array().into_iter().flatten();
    ["closed_loop", "loop", "joint_name"].into_iter().any(full)
        || entries.any(|v| v.get("ball_constraint_body_A").is_some())
}

fn parse_loops(name: &str, text: &str) -> Result<Value, String> {
    let ending = std::path::Path::new(name)
        .extension()
        .map_or(String::new(), |e| e.to_string_lossy().to_lowercase());
    match ending.as_str() {
        "json" => serde_json::from_str(text).map_err(|e| e.to_string()),
        "toml" => toml::from_str(text).map_err(|e| e.to_string().trim().to_owned()),
        "yaml" | "yml" => serde_saphyr::from_str(text).map_err(|e| e.to_string().trim().to_owned()),
        _ => Err("the ending is unknown; name the file .yaml, .json or .toml".to_owned()),
    }
}

/// A loop that a table closes. Drake has other names for the same keys.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LoopEntry {
    id: Option<String>,
    #[serde(alias = "ball_constraint_body_A")]
    a: String,
    #[serde(alias = "ball_constraint_body_B")]
    b: String,
    #[serde(rename = "type", default = "spherical")]
    kind: String,
    #[serde(alias = "ball_constraint_p_AP", default, deserialize_with = "vector")]
    point_a: Vector,
    #[serde(alias = "ball_constraint_p_BQ", default, deserialize_with = "vector")]
    point_b: Vector,
    #[serde(default = "z_axis", deserialize_with = "direction")]
    axis_a: Vector,
    #[serde(default = "z_axis", deserialize_with = "direction")]
    axis_b: Vector,
}

fn spherical() -> String {
    "spherical".to_owned()
}

fn z_axis() -> Vector {
    Z
}

/// Reads numbers as a list, or as text with spaces as in Drake.
fn vector<'de, D: Deserializer<'de>>(of: D) -> Result<Vector, D::Error> {
    let value = Value::deserialize(of)?;
    let numbers: Option<Vec<f64>> = match &value {
        Value::String(s) => s.split_whitespace().map(|w| w.parse().ok()).collect(),
        Value::Array(items) => items.iter().map(Value::as_f64).collect(),
        _ => None,
    };
    match numbers.as_deref() {
        Some(&[x, y, z]) if [x, y, z].iter().all(|c| c.abs() <= 1e9) => Ok([x, y, z]),
        _ => Err(D::Error::custom(format!(
            "{value} is not three finite numbers"
        ))),
    }
}

fn direction<'de, D: Deserializer<'de>>(of: D) -> Result<Vector, D::Error> {
    let found = vector(of)?;
    match length(found) {
        size if size < 1e-9 => Err(D::Error::custom("an axis is zero")),
        _ => Ok(found),
    }
}

fn read_loops(value: &Value, robot: &mut Robot) -> Found<()> {
    let (list, word) = match value {
        Value::Object(o) if o.contains_key("closed_loop") => return read_pairs(value, robot),
        Value::Object(o) if o.contains_key("loop") => {
            if let Some(key) = o.keys().find(|key| *key != "loop") {
                return Err(unknown_word("the file of loops", "key", key, "loop"));
            }
            (read_list(value, "loop")?, "loop")
        }
        Value::Array(items) if !items.is_empty() => (items.clone(), "ball"),
        _ => {
            return Err(syntax_problem(
                "no loops found; write [[loop]] tables with a, b and type, or closed_loop: [[a, b]] and type: [6d]",
            ));
        }
    };
    for (i, item) in list.into_iter().enumerate() {
        let mut element = format!("{word}-{}", i + 1);
        let entry = LoopEntry::deserialize(item).map_err(|e| {
            syntax_problem(format!(
                "{element}: {e}; write a and b, and if needed type, point_a, point_b, axis_a and axis_b such as [0, 0, 1]"
            ))
        })?;
        element = entry.id.unwrap_or(element);
        let end = |name: &str, at: Vector, axis: Vector| -> Found<End> {
            let (link, frame) = find_place(&element, name, robot)?;
            let side = RigidMotion::from_translation(at).then(&RigidMotion::z_to(axis));
            Ok((link, frame.then(&side)))
        };
        let ends = [
            end(&entry.a, entry.point_a, entry.axis_a)?,
            end(&entry.b, entry.point_b, entry.axis_b)?,
        ];
        let kind = joint_type(&element, &entry.kind)?;
        add_closure(&element, ends, kind, robot)?;
    }
    Ok(())
}

/// Returns the list of a key; empty if there is none.
fn read_list<T: DeserializeOwned>(of: &Value, key: &str) -> Found<Vec<T>> {
    let list = of.get(key).map(Vec::deserialize).transpose();
    let list = list.map_err(|e| {
        syntax_problem(format!(
            "{key}: {e}; write a list in brackets, of pairs for closed_loop and of words for the others"
        ))
    })?;
    Ok(list.unwrap_or_default())
}

/// Returns the link and place of a name: of a link or frame, or of the child's side of a joint.
fn find_place(element: &str, name: &str, robot: &Robot) -> Found<End> {
    if let Some(j) = robot.joints.iter().find(|j| j.id == name) {
        return Ok((j.links[1], j.sides[1]));
    }
    robot.frame(name).ok_or_else(|| {
        let what = ["link, frame or joint", "links and frames"];
        unknown_name(element, what, name, robot.frames.keys())
    })
}

fn joint_type(element: &str, word: &str) -> Found<JointType> {
    let found = joint_of_word(&word.to_lowercase(), TYPES);
    found.ok_or_else(|| unknown_word(element, "type", word, TYPES))
}

fn add_closure(id: &str, ends: [End; 2], kind: JointType, robot: &mut Robot) -> Found<()> {
    let links = ends.map(|e| e.0);
    if links[0] == links[1] {
        return Err(syntax_problem(format!(
            "{id} connects link \"{}\" to itself; name two different links",
            robot.links[links[0]]
        )));
    }
    let mut part = Part::new(id, links, ends.map(|e| e.1), kind);
    part.closes = true;
    robot.joints.push(part);
    Ok(())
}

/// Returns an error unless two lists have as many entries.
fn ensure_one_each(list: (&str, usize), types: (&str, usize)) -> Found<()> {
    if list.1 == types.1 {
        return Ok(());
    }
    Err(syntax_problem(format!(
        "{} has {} entries and {} {}; write one type for each",
        list.0, list.1, types.0, types.1
    )))
}

/// Gives the joints of `joint_name` the kinds of `joint_type`, which URDF cannot represent.
fn retype_joints(of: &Value, robot: &mut Robot) -> Found<()> {
    let names: Vec<String> = read_list(of, "joint_name")?;
    let types: Vec<String> = read_list(of, "joint_type")?;
    ensure_one_each(("joint_name", names.len()), ("joint_type", types.len()))?;
    for (name, kind) in names.iter().zip(&types) {
        let at = robot.joint_named("joint_name", name)?;
        let joint = &mut robot.joints[at];
        let axis = |letter: u8| {
            let known = [(b'X', X), (b'Y', Y), (b'Z', Z)];
            known.into_iter().find(|a| a.0 == letter).map(|a| a.1)
        };
        let upper = kind.to_uppercase();
        let new = match upper.as_bytes() {
            b"SPHERICAL" => Some((JointType::Spherical, Z, X)),
            b"FIXED" => Some((JointType::Fixed, Z, X)),
            b"CARDAN" => Some((JointType::Universal, X, Y)),
            [b'U', b'J', b'O', b'I', b'N', b'T', b'_', a, b] if a != b => axis(*a)
                .zip(axis(*b))
                .map(|(first, second)| (JointType::Universal, first, second)),
            _ => None,
        };
        let Some((new, first, second)) = new else {
            let joint = format!("joint \"{name}\"");
            let known = "SPHERICAL, FIXED, CARDAN, UJOINT_XY and the like";
            return Err(unknown_word(&joint, "joint_type", kind, known));
        };
        joint.values = vec![0.0; new.freedoms().len()];
        (joint.joint_type, joint.axis, joint.second) = (new, first, second);
        (joint.limits, joint.zero) = (None, 0.0);
    }
    Ok(())
}

/// Reads the form of example-parallel-robots.
fn read_pairs(of: &Value, robot: &mut Robot) -> Found<()> {
    retype_joints(of, robot)?;
    let types: Vec<String> = read_list(of, "type")?;
    let pairs: Vec<[String; 2]> = read_list(of, "closed_loop")?;
    if of.get("type").is_some() {
        ensure_one_each(("closed_loop", pairs.len()), ("type", types.len()))?;
    }
    let known = "closed_loop, type, name_mot, joint_name, joint_type";
    for key in of.as_object().into_iter().flat_map(|o| o.keys()) {
        if !known.split(", ").any(|k| k == key) {
            let what = format!("the file of loops has this key, which is not read; known: {known}");
            robot.report.leave_out(key, 0, what);
        }
    }
    for (i, [a, b]) in pairs.iter().enumerate() {
        let element = format!("loop-{}", i + 1);
        let kind = types.get(i).map_or("fixed", String::as_str);
        let kind = joint_type(&element, kind)?;
        let ends = [
            find_place(&element, a, robot)?,
            find_place(&element, b, robot)?,
        ];
        add_closure(&element, ends, kind, robot)?;
    }
    for name in read_list::<String>(of, "name_mot")? {
        match robot.joints.iter_mut().find(|j| j.id == name) {
            Some(j) => j.drive = true,
            None => robot.report.drop_element("motor of no joint", &name),
        }
    }
    Ok(())
}
