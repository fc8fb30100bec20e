//! From a robot as read to a mechanism file: pose, frame, loops, bodies, outputs.

use crate::file::read::limits::LIMITS;
use crate::file::schema::MechanismFile;
use crate::file::write::Comment;
use crate::geom::rigid::Motion;
use crate::model::joint_type::JointType;
use crate::robots::close::{self, CLOSED, ROUNDED, close, gaps, size, worst};
use crate::robots::coupling;
use crate::robots::emit::{self, Bodies, Content};
use crate::robots::kinematics::{Tree, places, spanning_tree};
use crate::robots::options::Options;
use crate::robots::outputs::{self, link_of};
use crate::robots::parts::{Part, Robot, free};
use crate::robots::problem::{RobotProblem, known};
use std::collections::BTreeSet;

pub(crate) fn apply_pose(robot: &mut Robot, options: &Options) -> Result<(), RobotProblem> {
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
pub(crate) fn root_link(robot: &mut Robot, options: &Options) -> Result<usize, RobotProblem> {
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
    // A model that nothing holds to the world falls, as far as engines are concerned.
    let falls = robot.world.is_none_or(|w| !held(&w));
    let parts = loose(robot, &spanning_tree(robot, root)).len();
    let apart = robot.floats && (falls || parts > 0);
    if !options.floating && !apart {
        return Ok(root);
    }
    let world = match robot.world {
        Some(w) => w,
        None => robot.link("world", Motion::IDENTITY),
    };
    robot.world = Some(world);
    // Every tree of links that the world does not hold floats by itself.
    let tree = spanning_tree(robot, world);
    for &r in tree.roots.iter().skip(1) {
        let sides = [robot.places[r], Motion::IDENTITY];
        let id = format!("floating-{}", robot.links[r]);
        robot.joints.push(Part::new(&id, [world, r], sides, free()));
        robot.report.map("floating base");
    }
    if apart && !options.floating {
        let what = match parts == 0 {
            true => {
                "nothing holds the model to the world: it floats with 6 freedoms (--frame LINK holds a link)"
            }
            false => "parts that no joint holds float in the world, each by itself",
        };
        robot.report.moved(what.to_owned());
    }
    Ok(world)
}

/// The roots beside the frame, but for a world that holds nothing.
fn loose(robot: &Robot, tree: &Tree) -> Vec<usize> {
    let jointless =
        |l: usize| robot.world == Some(l) && !robot.joints.iter().any(|j| j.links.contains(&l));
    let others = tree.roots.iter().skip(1).copied();
    others.filter(|&l| !jointless(l)).collect()
}

/// Every link must hang on the frame.
pub(crate) fn held(robot: &Robot, tree: &Tree) -> Result<(), RobotProblem> {
    let loose = loose(robot, tree);
    let loose: Vec<&str> = loose.iter().map(|&l| robot.links[l].as_str()).collect();
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

pub(crate) fn close_loops(
    robot: &mut Robot,
    tree: &Tree,
    options: &Options,
) -> Result<(), RobotProblem> {
    if tree.loops.is_empty() {
        return Ok(());
    }
    let size = size(robot);
    let unit = robot.unit.symbol();
    let first = worst(&gaps(robot, tree), size);
    let n = tree.loops.len();
    let loops = if n == 1 {
        "1 loop".to_owned()
    } else {
        format!("{n} loops")
    };
    if first <= CLOSED * size {
        robot.report.pose.push(format!(
            "{loops} closed in the pose of the file, to {first:.1e} {unit}"
        ));
        return Ok(());
    }
    let before: Vec<Vec<f64>> = robot.joints.iter().map(|j| j.values.clone()).collect();
    let (left, outside) = if options.open {
        (first, 0)
    } else {
        close(robot, tree)
    };
    if left <= CLOSED * size || (left <= ROUNDED * size && !options.open) {
        if left > CLOSED * size {
            let what = format!(
                "open by {left:.1e} {unit} wherever the joints are, as rounded coordinates leave it; taken as closed"
            );
            robot.report.approximate(&loops, what);
        }
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
        let limits = match outside {
            0 => String::new(),
            n => format!("; {n} outside their limits"),
        };
        robot.report.moved(format!(
            "{loops} open by {first:.1e} {unit} in the pose of the file, closed to {left:.1e} {unit} by moving joints{moved}{limits}"
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
            "\"{}\" between {a} and {b} by {:.2e} {unit} and {:.2e} rad",
            p.id, g.shift, g.turn
        )
    });
    if options.open {
        let note = format!("loops open, the widest {what}; the figures are those of that pose");
        robot.report.moved(note);
        return Ok(());
    }
    Err(RobotProblem::Whole {
        message: format!(
            "the loops do not close, the widest is {what}; give a pose nearby with --pose joint=value, or take it as it is with --open"
        ),
    })
}

/// The joints of the tree that loops go through, and those that close them.
fn in_loops(robot: &Robot, tree: &Tree) -> BTreeSet<usize> {
    let mut out: BTreeSet<usize> = tree.loops.iter().copied().collect();
    for &j in &tree.loops {
        let way = |link: usize| {
            std::iter::successors(tree.into[link], |&s| tree.into[tree.steps[s].from])
                .map(|s| tree.steps[s].joint)
                .collect::<BTreeSet<usize>>()
        };
        let [a, b] = robot.joints[j].links.map(way);
        out.extend(a.symmetric_difference(&b));
    }
    out
}

/// A mechanism file and what its parts are of the robot.
#[derive(Debug)]
pub(crate) struct Entries {
    pub(super) file: MechanismFile,
    /// What is to be said above its entries.
    pub(super) comments: Vec<Comment>,
    /// Places of the links in the pose found.
    pub(super) places: Vec<Motion>,
    /// The robot's joints that its joints are.
    pub(super) joints: Vec<usize>,
    /// The elements that its couplings are.
    pub(super) couplings: Vec<usize>,
}

/// The entries of the file called `file` of a `format`.
pub(crate) fn entries(
    robot: &mut Robot,
    tree: &Tree,
    file: &str,
    format: &'static str,
    options: &Options,
) -> Result<Entries, RobotProblem> {
    let places = places(robot, tree);
    let kept = if robot.assembly {
        in_loops(robot, tree)
    } else {
        BTreeSet::new()
    };
    let fixed = |j: usize| robot.joints[j].joint_type == JointType::Fixed && !kept.contains(&j);
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
        let links = robot.links.len();
        return Err(RobotProblem::Rigid { links });
    }
    let couplings = coupling::usable(robot, &joints);
    let frame = bodies.of[tree.roots[0]];
    let outputs = outputs::of(robot, &bodies, &joints, frame, options)?;
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
    for (what, count, limit) in [
        ("links", used.len(), LIMITS.0),
        ("joints", joints.len(), LIMITS.1),
    ] {
        if count > limit {
            return Err(RobotProblem::Whole {
                message: format!(
                    "after merging what is rigidly joined there are {count} {what}, more than the {limit} of a mechanism file; import a part of the robot"
                ),
            });
        }
    }
    let limited = robot.joints.iter().filter(|j| j.limits.is_some());
    limited.for_each(|j| report.drop("limit of a joint", Some(&j.id)));
    robot.report = report;
    let file = std::path::Path::new(file).file_name();
    let (file, comments) = emit::entries(&Content {
        robot,
        file: &file.unwrap_or_default().to_string_lossy(),
        format,
        places: &places,
        bodies: &bodies,
        frame,
        outputs: &outputs,
        joints: &joints,
        couplings: &couplings,
    });
    Ok(Entries {
        file,
        comments,
        places,
        joints,
        couplings: couplings.iter().map(|u| u.said_by).collect(),
    })
}
