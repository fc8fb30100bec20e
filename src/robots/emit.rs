//! The mechanism file of a robot.

use crate::geom::rigid::{RigidMotion, towards};
use crate::geom::vector::{Vector, length};
use crate::model::joint_type::{Freedom, JointType};
use crate::robots::kinematics::world_axes;
use crate::robots::parts::{Part, Robot};
use std::collections::{BTreeMap, BTreeSet};
use toml_edit::{Array, ArrayOfTables, DocumentMut, Item, Table, Value};

/// Longest name in a mechanism file, in characters.
const LONGEST: usize = 64;

/// The links after merging those that are rigidly joined.
#[derive(Debug)]
pub(crate) struct Bodies {
    /// For each link of the robot the link that stands for it.
    pub(super) of: Vec<usize>,
}

impl Bodies {
    /// Merges along the fixed joints of the tree.
    pub(crate) fn new(links: usize, fixed: impl Iterator<Item = (usize, usize)>) -> Bodies {
        let mut of: Vec<usize> = (0..links).collect();
        // The steps of a tree lead away from its roots, so that `from` is already settled.
        for (from, to) in fixed {
            of[to] = of[from];
        }
        Bodies { of }
    }
}

/// Names that fit a mechanism file: unique, not empty, short, without control characters.
#[derive(Debug, Default)]
pub(crate) struct Names {
    used: BTreeSet<String>,
}

impl Names {
    pub(crate) fn fit(&mut self, wanted: &str) -> String {
        let plain: String = wanted
            .chars()
            .filter(|c| !c.is_control())
            .take(LONGEST)
            .collect();
        let plain = if plain.is_empty() {
            "unnamed".to_owned()
        } else {
            plain
        };
        let mut name = plain.clone();
        let mut n = 2;
        while !self.used.insert(name.clone()) {
            let end = format!("~{n}");
            name = plain.chars().take(LONGEST - end.len()).collect::<String>() + &end;
            n += 1;
        }
        name
    }
}

/// What goes into the file.
#[derive(Debug)]
pub(crate) struct Content<'a> {
    pub(super) robot: &'a Robot,
    pub(super) file: &'a str,
    pub(super) places: &'a [RigidMotion],
    pub(super) bodies: &'a Bodies,
    pub(super) frame: usize,
    /// Bodies that are outputs.
    pub(super) outputs: &'a [usize],
    /// Joints to write, in order.
    pub(super) joints: &'a [usize],
    /// Joints that lead and follow, with the ratio of their rates.
    pub(super) couplings: &'a [([usize; 2], f64)],
}

impl Content<'_> {
    /// Whether the rates of a joint matter: its axis is then of length 1, so that they are exact.
    fn coupled(&self, joint: usize) -> bool {
        self.couplings.iter().any(|(ends, _)| ends.contains(&joint))
    }
}

/// The file's text.
pub(crate) fn toml(c: &Content<'_>) -> String {
    let mut doc = DocumentMut::new();
    let one_line = |s: &str| s.chars().filter(|c| !c.is_control()).collect::<String>();
    doc["name"] = toml_edit::value(one_line(&c.robot.name));
    let description = format!(
        "Imported from {} ({}).{}",
        one_line(c.file),
        c.robot.format.name(),
        if c.robot.report.coupling_rows > 0 {
            " Some couplings of joints are left out."
        } else {
            ""
        }
    );
    doc["description"] = toml_edit::value(description);
    doc["length_unit"] = toml_edit::value("m");
    let mut names = Names::default();
    let mut ids: BTreeMap<usize, String> = BTreeMap::new();
    let mut links = ArrayOfTables::new();
    let mut merged: BTreeMap<usize, Vec<&str>> = BTreeMap::new();
    for (l, &b) in c.bodies.of.iter().enumerate() {
        if l != b {
            merged.entry(b).or_default().push(&c.robot.links[l]);
        }
    }
    let used: BTreeSet<usize> = c
        .joints
        .iter()
        .flat_map(|&j| c.robot.joints[j].links.map(|l| c.bodies.of[l]))
        .collect();
    let order = std::iter::once(c.frame).chain(used.iter().copied().filter(|&b| b != c.frame));
    for b in order {
        let id = names.fit(&c.robot.links[b]);
        let mut table = Table::new();
        table["id"] = toml_edit::value(&id);
        if b == c.frame {
            table["role"] = toml_edit::value("frame");
        } else if c.outputs.contains(&b) {
            table["role"] = toml_edit::value("output");
        }
        if let Some(with) = merged.get(&b) {
            comment(
                &mut table,
                &format!("with {}, fixed to it", with.join(", ")),
            );
        }
        ids.insert(b, id);
        links.push(table);
    }
    doc["link"] = Item::ArrayOfTables(links);
    let mut names = Names::default();
    let mut joints = ArrayOfTables::new();
    let mut joint_ids: BTreeMap<usize, String> = BTreeMap::new();
    for &j in c.joints {
        let id = names.fit(&c.robot.joints[j].id);
        joints.push(joint(j, &id, c, &ids));
        joint_ids.insert(j, id);
    }
    doc["joint"] = Item::ArrayOfTables(joints);
    let couplings: ArrayOfTables = c
        .couplings
        .iter()
        .map(|x| coupling(x, &joint_ids))
        .collect();
    if !couplings.is_empty() {
        doc["coupling"] = Item::ArrayOfTables(couplings);
    }
    let mut options = Array::new();
    for o in ["revolute", "cylindrical", "universal", "spherical"] {
        options.push(o);
    }
    let mut search = Table::new();
    search["options"] = toml_edit::value(options);
    comment(
        &mut search,
        "What a search may put in place of a joint; edit freely.",
    );
    doc["search"] = Item::Table(search);
    doc.to_string()
}

fn comment(table: &mut Table, text: &str) {
    let mut lines = String::from("\n");
    let text: String = text
        .chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect();
    let mut line = String::new();
    for word in text.split_whitespace() {
        if !line.is_empty() && line.len() + word.len() > 110 {
            lines.push_str(&format!("# {line}\n"));
            line.clear();
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
    }
    lines.push_str(&format!("# {line}\n"));
    table.decor_mut().set_prefix(lines);
}

/// A number as it is written: rounding errors around multiples of 1e-9 are taken off.
fn clean(x: f64) -> f64 {
    let r = (x * 1e9).round() / 1e9;
    let y = if (r - x).abs() < 1e-12 { r } else { x };
    if y == 0.0 { 0.0 } else { y }
}

fn number(x: f64) -> Value {
    let x = clean(x);
    #[allow(clippy::cast_possible_truncation, reason = "whole and small")]
    if x == x.trunc() && x.abs() < 1e15 {
        Value::from(x as i64)
    } else {
        Value::from(x)
    }
}

fn vector(v: Vector) -> Item {
    toml_edit::value(v.into_iter().map(number).collect::<Array>())
}

/// A direction as written: of its own length unless that is extreme.
fn direction(v: Vector) -> Item {
    let l = length(v);
    vector(if (0.1..=10.0).contains(&l) {
        v
    } else {
        towards(v)
    })
}

fn coupling((ends, ratio): &([usize; 2], f64), ids: &BTreeMap<usize, String>) -> Table {
    let mut t = Table::new();
    t["joints"] = toml_edit::value(ends.iter().map(|j| ids[j].as_str()).collect::<Array>());
    t["ratio"] = toml_edit::value(number(*ratio));
    t
}

fn joint(j: usize, id: &str, c: &Content<'_>, ids: &BTreeMap<usize, String>) -> Table {
    let p: &Part = &c.robot.joints[j];
    let mut t = Table::new();
    t["id"] = toml_edit::value(id);
    let ends: Array = p
        .links
        .iter()
        .map(|&l| ids[&c.bodies.of[l]].as_str())
        .collect();
    t["links"] = toml_edit::value(ends);
    t["type"] = toml_edit::value(p.joint_type.name());
    if let JointType::Custom(list) = &p.joint_type {
        t["freedoms"] = toml_edit::value(list.iter().map(|f| f.name()).collect::<Array>());
    }
    let place = c.places[p.links[0]].then(&p.sides[0]);
    t["point"] = vector(place.translation);
    let axes = world_axes(p, c.places);
    let about = |f: &[Freedom]| {
        let found = axes.iter().find(|a| f.contains(&a.freedom));
        found.map(|a| a.direction)
    };
    if !matches!(p.joint_type, JointType::Spherical | JointType::Fixed) {
        let z = about(&[Freedom::Rz, Freedom::Tz, Freedom::Screw]);
        let z = z.unwrap_or_else(|| place.direction(p.axis));
        t["axis"] = if c.coupled(j) {
            vector(towards(z))
        } else {
            direction(z)
        };
    }
    if let (JointType::Universal, Some(x)) = (&p.joint_type, about(&[Freedom::Rx])) {
        t["reference"] = direction(x);
    }
    if p.joint_type.freedoms().contains(&Freedom::Screw) {
        t["pitch"] = toml_edit::value(number(p.pitch));
    }
    if p.drive {
        t["drive"] = toml_edit::value(true);
    }
    if let Some(what) = &p.comment {
        comment(&mut t, what);
    }
    t
}
