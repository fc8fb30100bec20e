//! Loop closures from a separate file: YAML, JSON or TOML, in three shapes.
//!
//! - ozols' own: a list `loop` of tables with `a` and `b` (names of links, frames or joints), `type` (spherical by
//!   default), and `point_a`, `point_b`, `axis_a`, `axis_b` in those frames;
//! - `closed_loop: [[a, b], ...]`, `type: [6d, 3d, ...]`, `name_mot: [...]` of example-parallel-robots, with `joint_name: [...]`
//!   and `joint_type: [...]` of the joints whose types differ from the URDF;
//! - Drake's list of `ball_constraint_body_A`, `ball_constraint_p_AP`, `..._body_B`, `..._p_BQ`.

use crate::file::text::decode_utf8;
use crate::geom::rigid::RigidMotion;
use crate::geom::vector::{Vector, X, Y, Z, length};
use crate::model::joint_type::JointType;
use crate::robots::description::{End, Part, Robot};
use crate::robots::warning::{
    Found, Read, Reader, list_known, syntax_problem, too_large, unknown_name, unknown_word,
};
use serde_json::{Map, Value};

/// Largest file, in bytes.
const MAX_BYTES: usize = 1 << 20;
const TYPES: &str = "revolute, prismatic, cylindrical, spherical (3d), fixed (6d)";

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
        robot.report.leave_out_joint(&element, rows, what);
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

fn read_loops(value: &Value, robot: &mut Robot) -> Found<()> {
    match value {
        Value::Object(o) if o.contains_key("closed_loop") => read_pairs(o, robot),
        Value::Object(o) if o.contains_key("loop") => {
            let mut all = read_list(o, "loop")?.iter().enumerate();
            all.try_for_each(|(i, item)| read_loop(i, item, robot))
        }
        Value::Array(items) if !items.is_empty() => {
            let mut all = items.iter().enumerate();
            all.try_for_each(|(i, item)| read_ball(i, item, robot))
        }
        _ => Err(syntax_problem(
            "no loops found; write [[loop]] tables with a, b and type, or closed_loop: [[a, b]] and type: [6d]",
        )),
    }
}

fn read_list<'a>(o: &'a Map<String, Value>, key: &str) -> Found<&'a [Value]> {
    match o.get(key) {
        None => Ok(&[]),
        Some(Value::Array(items)) => Ok(items),
        Some(_) => Err(syntax_problem(format!(
            "{key} is not a list; write one in brackets"
        ))),
    }
}

fn read_word<'a>(v: Option<&'a Value>, what: &str) -> Found<&'a str> {
    v.and_then(Value::as_str).ok_or_else(|| {
        syntax_problem(format!(
            "{what} is missing or not a word; write it in quotes"
        ))
    })
}

/// Returns the link and place of a name: of a link or frame, or of the child's side of a joint.
fn find_place(element: &str, name: &str, robot: &Robot) -> Found<End> {
    if let Some(j) = robot.joints.iter().find(|j| j.id == name) {
        return Ok((j.links[1], j.sides[1]));
    }
    robot.frame(name).ok_or_else(|| {
        let known = list_known("links and frames", robot.frames.keys());
        unknown_name(element, "link, frame or joint", name, &known)
    })
}

fn joint_type(element: &str, word: &str) -> Found<JointType> {
    Ok(match word.to_lowercase().as_str() {
        "6d" | "fixed" | "weld" => JointType::Fixed,
        "3d" | "spherical" | "ball" => JointType::Spherical,
        "revolute" => JointType::Revolute,
        "prismatic" => JointType::Prismatic,
        "cylindrical" => JointType::Cylindrical,
        _ => return Err(unknown_word(element, "type", word, TYPES)),
    })
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
    part.comment = Some("closes a loop".to_owned());
    robot.report.count_mapped("loop closure");
    robot.joints.push(part);
    Ok(())
}

/// Gives the joints of `joint_name` the kinds of `joint_type`, which URDF cannot represent.
fn retype_joints(o: &Map<String, Value>, robot: &mut Robot) -> Found<()> {
    let (names, types) = (read_list(o, "joint_name")?, read_list(o, "joint_type")?);
    if names.len() != types.len() {
        return Err(syntax_problem(format!(
            "joint_name has {} entries and joint_type {}; write one type for each joint",
            names.len(),
            types.len()
        )));
    }
    for (name, kind) in names.iter().zip(types) {
        let name = read_word(Some(name), "joint_name")?;
        let kind = read_word(Some(kind), "joint_type")?;
        let Some(joint) = robot.joints.iter_mut().find(|j| j.id == name) else {
            let known = list_known("joints", robot.joints.iter().map(|j| &j.id));
            return Err(unknown_name("joint_name", "joint", name, &known));
        };
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
        joint.comment = Some(format!("{kind} by the file of loop closures"));
        robot.report.count_mapped("joint type");
    }
    Ok(())
}

/// Reads the form of example-parallel-robots.
fn read_pairs(o: &Map<String, Value>, robot: &mut Robot) -> Found<()> {
    retype_joints(o, robot)?;
    let types = read_list(o, "type")?;
    for (i, pair) in read_list(o, "closed_loop")?.iter().enumerate() {
        let element = format!("loop-{}", i + 1);
        let Some([a, b]) = pair.as_array().map(Vec::as_slice) else {
            return Err(syntax_problem(format!(
                "closed_loop {} is not a pair of names; write [a, b]",
                i + 1
            )));
        };
        let kind = match types.get(i) {
            None => JointType::Fixed,
            Some(t) => joint_type(&element, read_word(Some(t), "type")?)?,
        };
        let end = |name| find_place(&element, read_word(Some(name), "the end of a loop")?, robot);
        let ends = [end(a)?, end(b)?];
        add_closure(&element, ends, kind, robot)?;
    }
    for name in read_list(o, "name_mot")? {
        let name = read_word(Some(name), "name_mot")?;
        match robot.joints.iter_mut().find(|j| j.id == name) {
            Some(j) => j.drive = true,
            None => robot.report.count_dropped("motor of no joint", Some(name)),
        }
    }
    Ok(())
}

/// Reads numbers as a list, or as text with spaces as in Drake.
fn read_vector(v: Option<&Value>, what: &str) -> Found<Option<Vector>> {
    let numbers: Option<Vec<f64>> = match v {
        None => return Ok(None),
        Some(Value::String(s)) => s.split_whitespace().map(|w| w.parse().ok()).collect(),
        Some(Value::Array(items)) => items.iter().map(Value::as_f64).collect(),
        Some(_) => None,
    };
    match numbers.as_deref() {
        Some(&[x, y, z]) if [x, y, z].iter().all(|c| c.abs() <= 1e9) => Ok(Some([x, y, z])),
        _ => Err(syntax_problem(format!(
            "{what} is not three finite numbers; write [0, 0, 1]"
        ))),
    }
}

/// Reads an end of a loop: the keys of its link, frame or joint, of a point there and of an axis.
fn read_end(element: &str, item: &Value, keys: [&str; 3], robot: &Robot) -> Found<End> {
    let [name, point, axis] = keys.map(|k| (item.get(k), format!("{k} of {element}")));
    let (link, frame) = find_place(element, read_word(name.0, &name.1)?, robot)?;
    let at = read_vector(point.0, &point.1)?.unwrap_or([0.0; 3]);
    let direction = read_vector(axis.0, &axis.1)?.unwrap_or(Z);
    if length(direction) < 1e-9 {
        return Err(syntax_problem(format!(
            "{} is zero; give a direction such as [0, 0, 1]",
            axis.1
        )));
    }
    let side = RigidMotion::from_translation(at).then(&RigidMotion::z_to(direction));
    Ok((link, frame.then(&side)))
}

/// Reads a ball constraint of Drake.
fn read_ball(i: usize, item: &Value, robot: &mut Robot) -> Found<()> {
    let element = format!("ball-{}", i + 1);
    let end = |keys| read_end(&element, item, keys, robot);
    let a = end(["ball_constraint_body_A", "ball_constraint_p_AP", ""])?;
    let b = end(["ball_constraint_body_B", "ball_constraint_p_BQ", ""])?;
    let ends = [a, b];
    add_closure(&element, ends, JointType::Spherical, robot)
}

/// The keys of a `[[loop]]`.
const KEYS: [&str; 8] = [
    "id", "a", "b", "type", "point_a", "point_b", "axis_a", "axis_b",
];

/// Reads a `[[loop]]`.
fn read_loop(i: usize, item: &Value, robot: &mut Robot) -> Found<()> {
    let id = item.get("id").and_then(Value::as_str);
    let element = id.map_or_else(|| format!("loop-{}", i + 1), str::to_owned);
    let mut keys = item.as_object().into_iter().flat_map(Map::keys);
    if let Some(key) = keys.find(|k| !KEYS.contains(&k.as_str())) {
        return Err(syntax_problem(format!(
            "{element} has the unknown key {key}; known: {}",
            KEYS.join(", ")
        )));
    }
    let kind = match item.get("type") {
        None => JointType::Spherical,
        some => joint_type(&element, read_word(some, "type")?)?,
    };
    let end = |keys| read_end(&element, item, keys, robot);
    let [a, b] = [["a", "point_a", "axis_a"], ["b", "point_b", "axis_b"]];
    let ends = [end(a)?, end(b)?];
    add_closure(&element, ends, kind, robot)
}
