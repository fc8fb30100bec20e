//! The entries of the mechanism file of a robot.

use crate::closure::tree::spanning_forest;
use crate::file::schema::{
    Coordinate, CouplingEntry, DriveWord, JointEntry, LinkEntry, MechanismFile, OptionEntry,
    SearchEntry,
};
use crate::file::write::{freedom_names, plain_number};
use crate::robots::description::coupling::Usable;
use crate::robots::description::kinematics::world_axes;
use crate::robots::mechanism::series_of_single_joints::Names;
use crate::robots::prelude::*;
use crate::robots::warning::KINEMATICS;

/// Longest name in a mechanism file, in characters.
const LONGEST: usize = 64;

/// Merges links along the fixed joints of a tree. Returns for each link of the robot the link that represents it.
pub(crate) fn merge_links(links: usize, fixed: impl Iterator<Item = (usize, usize)>) -> Vec<usize> {
    let mut of: Vec<usize> = (0..links).collect();
    // The steps of a tree lead away from its roots, so that `from` is already settled.
    for (from, to) in fixed {
        of[to] = of[from];
    }
    of
}

/// Returns a name that fits a mechanism file: unique, not empty, short, without control characters.
fn fitting_name(names: &mut Names, wanted: &str) -> String {
    let plain = wanted.chars().filter(|c| !c.is_control()).take(LONGEST);
    let plain: String = plain.collect();
    let plain = if plain.is_empty() {
        "unnamed".to_owned()
    } else {
        plain
    };
    names.unique_name(plain.clone(), |n| {
        let end = format!("~{n}");
        plain.chars().take(LONGEST - end.len()).collect::<String>() + &end
    })
}

/// The names of bodies.
type Ids = BTreeMap<usize, String>;

/// The bodies, joints and couplings of a mechanism, as parts of the robot.
pub(crate) struct Content {
    /// Places of the links in the pose found.
    pub(in crate::robots) places: Vec<RigidMotion>,
    /// For each link of the robot the link that represents it.
    pub(in crate::robots) bodies: Vec<usize>,
    pub(in crate::robots) frame: usize,
    /// Bodies that are outputs.
    pub(in crate::robots) outputs: Vec<usize>,
    /// The robot's joints, by joints of the mechanism.
    pub(in crate::robots) joints: Vec<usize>,
    /// Joints that lead and follow.
    pub(in crate::robots) couplings: Vec<Usable>,
}

/// Returns the entries of the file.
pub(crate) fn make_file(robot: &Robot, source: &str, c: &Content) -> MechanismFile {
    let (links, ids) = make_links(robot, c);
    let (mut names, mut joint_ids, mut joints) = (Names::default(), BTreeMap::new(), Vec::new());
    for &j in &c.joints {
        let id = fitting_name(&mut names, &robot.joints[j].id);
        joint_ids.insert(j, id.clone());
        // The rates of a coupled joint matter; its axis has length 1, so that they are exact.
        let coupled = c.couplings.iter().any(|u| u.ends.contains(&j));
        joints.push(make_joint(&robot.joints[j], c, id, coupled, &ids));
    }
    let coupling = |u: &Usable| CouplingEntry {
        joints: u.ends.map(|j| joint_ids[&j].clone()),
        ratio: clean_number(u.ratio),
        gear: u.gear,
    };
    let options = robot.options.iter().map(|t| t.name().to_owned());
    MechanismFile {
        name: one_line(&robot.name),
        description: describe_source(robot, source),
        length_unit: Some(robot.unit.to_owned()),
        link: links,
        joint: joints,
        coupling: c.couplings.iter().map(coupling).collect(),
        search: SearchEntry {
            options: options.map(OptionEntry::Word).collect(),
            ..SearchEntry::default()
        },
        ..MechanismFile::default()
    }
}

fn one_line(s: &str) -> String {
    s.chars().filter(|c| !c.is_control()).collect()
}

/// Describes the source of the mechanism, and what was omitted in the conversion.
fn describe_source(robot: &Robot, source: &str) -> String {
    let left_out = match robot.report.left_out {
        0 => "",
        _ => " Some couplings or joints are omitted.",
    };
    let source = one_line(source);
    format!("Imported from {source}.{left_out} {KINEMATICS}")
}

/// Returns the links, the frame first, with the names of their bodies.
fn make_links(robot: &Robot, c: &Content) -> (Vec<LinkEntry>, Ids) {
    let ends = |&j: &usize| robot.joints[j].links.map(|l| c.bodies[l]);
    let used: BTreeSet<usize> = c.joints.iter().flat_map(ends).collect();
    let order = std::iter::once(c.frame).chain(used.into_iter().filter(|&b| b != c.frame));
    let (mut names, mut ids, mut links) = (Names::default(), BTreeMap::new(), Vec::new());
    for b in order {
        let id = fitting_name(&mut names, &robot.links[b]);
        let frame = (b == c.frame).then_some("frame");
        let role = frame.or(c.outputs.contains(&b).then_some("output"));
        ids.insert(b, id.clone());
        links.push(LinkEntry {
            id,
            role: role.map(str::to_owned),
            ..LinkEntry::default()
        });
    }
    (links, ids)
}

/// Writes a number without rounding errors around multiples of 1e-9.
fn clean_number(x: f64) -> Coordinate {
    let r = (x * 1e9).round() / 1e9;
    plain_number(if (r - x).abs() < 1e-12 { r } else { x })
}

/// Returns a direction for the file: with its own length unless that is extreme.
fn file_direction(v: Vector) -> Vector {
    let usual = (0.1..=10.0).contains(&length(v));
    if usual { v } else { unit_or_z(v) }
}

fn make_joint(p: &Part, c: &Content, id: String, coupled: bool, ids: &Ids) -> JointEntry {
    let place = c.places[p.links[0]].then(&p.sides[0]);
    let axes = world_axes(p, &c.places);
    let about = |f: &[Freedom]| {
        let found = axes.iter().find(|a| f.contains(&a.freedom));
        found.map(|a| a.direction)
    };
    let axis = || {
        let z = about(&[Freedom::Rz, Freedom::Tz, Freedom::Screw]);
        let z = z.unwrap_or_else(|| place.map_direction(p.axis));
        let z = if coupled {
            unit_or_z(z)
        } else {
            file_direction(z)
        };
        z.map(clean_number)
    };

    let ball = matches!(p.joint_type, JointType::Spherical | JointType::Fixed);
    let universal = p.joint_type == JointType::Universal;
    let second = || place.map_direction(p.second);
    let second = p.joint_type.has_second_axis().then(second);
    let reference = about(&[Freedom::Rx]).filter(|_| universal).or(second);
    let screws = p.joint_type.freedoms().contains(&Freedom::Screw);
    JointEntry {
        id,
        links: p.links.map(|l| ids[&c.bodies[l]].clone()),
        kind: p.joint_type.name().to_owned(),
        freedoms: freedom_names(&p.joint_type),
        point: place.translation.map(clean_number),
        axis: (!ball).then(axis),
        reference: reference.map(|x| file_direction(x).map(clean_number)),
        pitch: screws.then(|| clean_number(p.pitch)),
        drive: DriveWord::Driven(p.drive),
        ..JointEntry::default()
    }
}

/// Last words of the names of end effectors.
const NAMES: &str = "foot feet toe hand palm tool tool0 tcp ee eef effector flange tip \
    fingertip pad platform gripper wheel";
/// Words that may follow them.
const IDLE: &str = "link body frame left right l r front rear";

/// Returns the output links by their representatives, and a floating base. Output links are the first that exist of: requested links, end
/// effectors by name, ends of chains with a shape or a site, all ends, the farthest link from the frame.
pub(crate) fn output_links(
    robot: &Robot,
    bodies: &[usize],
    joints: &[usize],
    frame: usize,
    options: &Options,
) -> Found<Vec<usize>> {
    let mut out = Vec::new();
    for name in &options.outputs {
        let b = bodies[robot.link_named("the option `working_link`", name)?];
        if b == frame {
            return Err(syntax_problem(format!(
                "link \"{name}\" is the frame or fixed to it; name a link that moves"
            )));
        }
        out.push(b);
    }
    if out.is_empty() {
        out = guess_outputs(robot, bodies, joints, frame);
    }
    out.sort_unstable();
    out.dedup();
    Ok(out)
}

fn guess_outputs(robot: &Robot, bodies: &[usize], joints: &[usize], frame: usize) -> Vec<usize> {
    let ends = joints
        .iter()
        .map(|&j| robot.joints[j].links.map(|l| bodies[l]));
    let n = robot.links.len();
    let mut joints_at = vec![0; n];
    ends.clone().flatten().for_each(|b| joints_at[b] += 1);
    let moves = |b: usize| b != frame && joints_at[b] > 0;
    let named = (0..n).filter(|&l| moves(bodies[l]) && is_effector(&robot.links[l]));
    let named: Vec<usize> = named.map(|l| bodies[l]).collect();
    let floating = joints.iter().map(|&j| &robot.joints[j]);
    // A body that is driven in all six freedoms is an input, not an output.
    let floating = floating.filter(|p| p.joint_type.freedoms().len() == 6 && !p.drive);
    let floating = floating.flat_map(|p| p.links.map(|l| bodies[l]));
    let floating: Vec<usize> = floating.filter(|&b| b != frame).collect();
    if !named.is_empty() {
        return [named, floating].concat();
    }
    let shown: BTreeSet<usize> = robot.shown.iter().map(|&l| bodies[l]).collect();
    let leaves: Vec<usize> = (0..n).filter(|&b| moves(b) && joints_at[b] == 1).collect();
    let with = leaves.iter().copied().filter(|b| shown.contains(b));
    let with: Vec<usize> = with.collect();
    let leaves = if with.is_empty() { leaves } else { with };
    if !leaves.is_empty() || !floating.is_empty() {
        return [leaves, floating].concat();
    }
    let (_, steps) = spanning_forest(n, ends, |_| false, [frame]);
    let mut depth = vec![0; n];
    for s in &steps {
        depth[s.link] = depth[s.from] + 1;
    }
    let deepest = steps.last().map_or(0, |s| depth[s.link]);
    let last = steps.iter().map(|s| s.link);
    last.filter(|&b| depth[b] == deepest).collect()
}

/// Returns whether a word is in a list of words, which are separated by spaces.
fn is_among(words: &str, word: &str) -> bool {
    words.split(' ').any(|w| w == word)
}

/// Returns true if a name ends like that of an end effector: "left-foot", "arm_tool0", "r_hand_link".
fn is_effector(name: &str) -> bool {
    let lower = name.to_lowercase();
    let words = lower.split(|c: char| !c.is_alphanumeric());
    let words = words.filter(|w| !w.is_empty() && !w.bytes().all(|b| b.is_ascii_digit()));
    let last = words.rev().find(|w| !is_among(IDLE, w));
    last.is_some_and(|w| is_among(NAMES, w))
}

#[cfg(test)]
mod tests {
    use super::is_effector;

    #[test]
    fn names_of_end_effectors() {
        for yes in [
            "left-foot",
            "arm_tool0",
            "r_hand_link",
            "Foot_L",
            "gripper::palm",
            "tip_2",
        ] {
            assert!(is_effector(yes), "{yes}");
        }
        for no in [
            "left-foot-crank",
            "plantar-rod",
            "handle",
            "link",
            "foot_pitch",
            "",
        ] {
            assert!(!is_effector(no), "{no}");
        }
    }
}
