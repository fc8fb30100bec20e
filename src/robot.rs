//! Robot descriptions (URDF, MJCF, SDF) as mechanism files.
//!
//! A description is read into links and joints with a place on either side; loops come from the file or from a file
//! beside it ([`Options::loops`]). The joints are composed into one pose, loops that are open there are closed by
//! changing joint values as little as possible, rigidly joined links become one, and the result is the text of a
//! mechanism file that [`crate::import::text`] reads, with a [`Report`] of what was mapped, approximated and dropped.

mod close;
mod emit;
mod kinematics;
mod loops;
mod mjcf;
mod parts;
mod pose;
mod problem;
mod urdf;
mod warning;
mod xml;

pub use parts::Format;
pub use warning::{Note, Report};

use crate::import::problem::ImportError;
use crate::import::text::mechanism_from_str;
use crate::model::joint_type::JointType;
use close::{CLOSED, close, gaps, size, worst};
use emit::{Bodies, Content};
use kinematics::{Tree, places, spanning_tree};
use parts::{Part, Robot, free};
use pose::Pose;
use problem::{RobotProblem, known};
use std::collections::BTreeSet;
use xml::Document;

/// What to do with a description.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// Name and bytes of a file of loop closures.
    pub loops: Option<(String, Vec<u8>)>,
    /// Values of joints, in radians and metres, one for each freedom.
    pub pose: Vec<(String, Vec<f64>)>,
    /// Hang a robot without a fixed link on the world by a joint of six freedoms.
    pub floating: bool,
    /// Take loops that do not close as they are.
    pub open: bool,
    /// The link to be the frame, in place of the root.
    pub frame: Option<String>,
    /// The links to be outputs, in place of the end links.
    pub outputs: Vec<String>,
}

/// A mechanism file and how it came about.
#[derive(Debug, Clone)]
pub struct Imported {
    /// The file, TOML.
    pub toml: String,
    /// The format read.
    pub format: Format,
    /// What was mapped, approximated and dropped.
    pub report: Report,
}

/// Reads the bytes of a file that an included file's name stands for.
pub type Reader<'a> = &'a dyn Fn(&str) -> std::io::Result<Vec<u8>>;

/// Whether a file of this name is a robot description, by its ending.
#[must_use]
pub fn is_description(name: &str) -> bool {
    std::path::Path::new(name).extension().is_some_and(|e| {
        ["urdf", "xml", "mjcf", "sdf", "world"]
            .iter()
            .any(|known| e.eq_ignore_ascii_case(known))
    })
}

/// Imports a description. `read` gives the files it includes.
///
/// # Errors
/// The first problem found, with its place.
pub fn import(
    name: &str,
    bytes: &[u8],
    read: Reader<'_>,
    options: &Options,
) -> Result<Imported, ImportError> {
    let mut document = Document::default();
    let root = document.read(name, xml::utf8(name, bytes)?)?;
    if document.element(root).name() == "mujoco" {
        mjcf::expand(&mut document, root, read)?;
    }
    let element = document.element(root);
    let mut robot = match element.name() {
        "robot" => urdf::read(element)?,
        "mujoco" => mjcf::read(element)?,
        other => {
            let found = other.to_owned();
            return Err(element.fail(None, RobotProblem::Format { found }));
        }
    };
    let fail = |p: RobotProblem| p.at(name, "", None);
    if robot.links.is_empty() {
        let what = "links".to_owned();
        return Err(element.fail(
            None,
            RobotProblem::Missing {
                element: element.label(),
                what,
            },
        ));
    }
    if let Some((side, bytes)) = &options.loops {
        loops::add(side, bytes, &mut robot)?;
    }
    apply_pose(&mut robot, options).map_err(fail)?;
    let frame = root_link(&mut robot, options).map_err(fail)?;
    let tree = spanning_tree(&robot, frame);
    held(&robot, &tree).map_err(fail)?;
    close_loops(&mut robot, &tree, options).map_err(fail)?;
    let toml = write(&mut robot, &tree, name, options).map_err(fail)?;
    // What is written must read back; limits on size are found here.
    mechanism_from_str("the imported mechanism", &toml)?;
    Ok(Imported {
        toml,
        format: robot.format,
        report: robot.report,
    })
}

fn link_of(robot: &Robot, name: &str) -> Result<usize, RobotProblem> {
    robot
        .links
        .iter()
        .position(|l| l == name)
        .ok_or_else(|| RobotProblem::UnknownName {
            element: "the command line".to_owned(),
            what: "link",
            name: name.to_owned(),
            known: known("links", robot.links.iter().map(String::as_str)),
        })
}

fn apply_pose(robot: &mut Robot, options: &Options) -> Result<(), RobotProblem> {
    for (id, values) in &options.pose {
        let Some(joint) = robot.joints.iter_mut().find(|j| j.id == *id) else {
            return Err(RobotProblem::UnknownName {
                element: "the pose".to_owned(),
                what: "joint",
                name: id.clone(),
                known: known("joints", robot.joints.iter().map(|j| j.id.as_str())),
            });
        };
        if values.len() != joint.values.len() || !values.iter().all(|v| v.abs() <= 1e9) {
            return Err(RobotProblem::BadValue {
                element: format!("joint \"{id}\""),
                what: "the pose".to_owned(),
                found: values
                    .iter()
                    .map(f64::to_string)
                    .collect::<Vec<_>>()
                    .join(","),
                want: format!("give {} finite numbers", joint.values.len()),
            });
        }
        joint.values = values.iter().map(|v| v - joint.zero).collect();
    }
    Ok(())
}

/// The frame: the world where something hangs on it, else the link that is no joint's child.
fn root_link(robot: &mut Robot, options: &Options) -> Result<usize, RobotProblem> {
    if let Some(name) = &options.frame {
        return link_of(robot, name);
    }
    let child: BTreeSet<usize> = robot
        .joints
        .iter()
        .filter(|j| !j.closes)
        .map(|j| j.links[1])
        .collect();
    let held = |w: &usize| {
        robot
            .joints
            .iter()
            .any(|j| !j.closes && j.links.contains(w))
    };
    let root = robot
        .world
        .filter(held)
        .or_else(|| (0..robot.links.len()).find(|l| !child.contains(l) && robot.world != Some(*l)))
        .unwrap_or(0);
    if !options.floating {
        return Ok(root);
    }
    let world = match robot.world {
        Some(w) => w,
        None => robot.link("world", Pose::IDENTITY),
    };
    robot.world = Some(world);
    // Every tree of links that the world does not hold floats by itself.
    let tree = spanning_tree(robot, world);
    for &r in tree.roots.iter().skip(1) {
        let sides = [robot.places[r], Pose::IDENTITY];
        let id = format!("floating-{}", robot.links[r]);
        robot.joints.push(Part::new(&id, [world, r], sides, free()));
        robot.report.map("floating base");
    }
    Ok(world)
}

/// Every link must hang on the frame.
fn held(robot: &Robot, tree: &Tree) -> Result<(), RobotProblem> {
    let jointless =
        |l: usize| robot.world == Some(l) && !robot.joints.iter().any(|j| j.links.contains(&l));
    let loose: Vec<&str> = tree
        .roots
        .iter()
        .skip(1)
        .filter(|&&l| !jointless(l))
        .map(|&l| robot.links[l].as_str())
        .collect();
    if loose.is_empty() {
        return Ok(());
    }
    Err(RobotProblem::Whole {
        message: format!(
            "no joint connects {} with {}; add one, or use --floating to let every such part float",
            loose
                .iter()
                .take(5)
                .map(|l| format!("link \"{l}\""))
                .collect::<Vec<_>>()
                .join(", "),
            robot.links[tree.roots[0]],
        ),
    })
}

fn close_loops(robot: &mut Robot, tree: &Tree, options: &Options) -> Result<(), RobotProblem> {
    if tree.loops.is_empty() {
        return Ok(());
    }
    let size = size(robot);
    let first = worst(&gaps(robot, tree), size);
    let n = tree.loops.len();
    let loops = if n == 1 {
        "1 loop".to_owned()
    } else {
        format!("{n} loops")
    };
    if first <= CLOSED * size {
        robot.report.pose.push(format!(
            "{loops} closed in the pose of the file, to {first:.1e} m"
        ));
        return Ok(());
    }
    let before: Vec<Vec<f64>> = robot.joints.iter().map(|j| j.values.clone()).collect();
    let left = if options.open {
        first
    } else {
        close(robot, tree)
    };
    if left <= CLOSED * size {
        let largest = robot
            .joints
            .iter()
            .zip(&before)
            .enumerate()
            .filter(|(j, _)| !tree.loops.contains(j))
            .flat_map(|(_, (j, b))| {
                j.values
                    .iter()
                    .zip(b)
                    .map(move |(v, b)| ((v - b).abs(), &j.id))
            })
            .max_by(|a, b| a.0.total_cmp(&b.0));
        let moved = largest.map_or(String::new(), |(v, id)| {
            format!("; {id} moved most, by {v:.3}")
        });
        robot.report.pose.push(format!(
            "{loops} open by {first:.1e} m in the pose of the file, closed to {left:.1e} m by moving joints{moved}"
        ));
        return Ok(());
    }
    let gaps = gaps(robot, tree);
    let most = gaps.iter().max_by(|a, b| {
        let by = |g: &close::Gap| g.shift.max(g.turn * size);
        by(a).total_cmp(&by(b))
    });
    let what = most.map_or(String::new(), |g| {
        let p = &robot.joints[g.joint];
        let [a, b] = p.links.map(|l| robot.links[l].as_str());
        format!(
            "\"{}\" between {a} and {b} by {:.2e} m and {:.2e} rad",
            p.id, g.shift, g.turn
        )
    });
    if options.open {
        let note = format!("loops open, the widest {what}; the figures are those of that pose");
        robot.report.pose.push(note);
        return Ok(());
    }
    Err(RobotProblem::Whole {
        message: format!(
            "the loops do not close, the widest is {what}; give a pose nearby with --pose joint=value, or take it as it is with --open"
        ),
    })
}

fn write(
    robot: &mut Robot,
    tree: &Tree,
    file: &str,
    options: &Options,
) -> Result<String, RobotProblem> {
    let places = places(robot, tree);
    let fixed = |j: usize| robot.joints[j].joint_type == JointType::Fixed;
    let rigid = tree
        .steps
        .iter()
        .filter(|s| fixed(s.joint))
        .map(|s| (s.from, s.link));
    let bodies = Bodies::new(robot.links.len(), rigid);
    let in_tree: BTreeSet<usize> = tree.steps.iter().map(|s| s.joint).collect();
    let mut joints = Vec::new();
    let mut within = Vec::new();
    for (j, p) in robot.joints.iter().enumerate() {
        let [a, b] = p.links.map(|l| bodies.of[l]);
        if a == b && !(in_tree.contains(&j) && fixed(j)) {
            within.push(p.id.clone());
        } else if a != b {
            joints.push(j);
        }
    }
    for id in within {
        let what = "both ends are on one rigid body; left out, with all its rows redundant";
        robot.report.approximate(&format!("joint \"{id}\""), what);
    }
    if joints.is_empty() {
        let n = robot.links.len();
        return Err(RobotProblem::Whole {
            message: format!(
                "nothing can move: all {n} links are rigidly joined; there is no mechanism to analyse"
            ),
        });
    }
    let frame = bodies.of[tree.roots[0]];
    let outputs = output_links(robot, tree, &bodies, &joints, frame, options)?;
    let mut report = std::mem::take(&mut robot.report);
    report.outputs = (
        outputs.iter().map(|&b| robot.links[b].clone()).collect(),
        !options.outputs.is_empty(),
    );
    let used: BTreeSet<usize> = joints
        .iter()
        .flat_map(|&j| robot.joints[j].links.map(|l| bodies.of[l]))
        .collect();
    report.size = (used.len(), joints.len());
    robot.report = report;
    let file = std::path::Path::new(file).file_name();
    Ok(emit::toml(&Content {
        robot,
        file: &file.unwrap_or_default().to_string_lossy(),
        places: &places,
        bodies: &bodies,
        frame,
        outputs: &outputs,
        joints: &joints,
    }))
}

/// The links asked for, or those at the ends of chains, or the one farthest from the frame.
fn output_links(
    robot: &Robot,
    tree: &Tree,
    bodies: &Bodies,
    joints: &[usize],
    frame: usize,
    options: &Options,
) -> Result<Vec<usize>, RobotProblem> {
    let mut out = Vec::new();
    for name in &options.outputs {
        let b = bodies.of[link_of(robot, name)?];
        if b == frame {
            return Err(RobotProblem::Whole {
                message: format!(
                    "link \"{name}\" is the frame or fixed to it; name a link that moves"
                ),
            });
        }
        out.push(b);
    }
    if out.is_empty() {
        let ends = |b: usize| {
            joints
                .iter()
                .filter(|&&j| robot.joints[j].links.iter().any(|&l| bodies.of[l] == b))
                .count()
        };
        let all: BTreeSet<usize> = bodies.of.iter().copied().collect();
        out.extend(all.iter().copied().filter(|&b| b != frame && ends(b) == 1));
        if out.is_empty() {
            let last = tree
                .steps
                .iter()
                .rev()
                .map(|s| bodies.of[s.link])
                .find(|&b| b != frame);
            out.extend(last);
        }
    }
    out.sort_unstable();
    out.dedup();
    Ok(out)
}
