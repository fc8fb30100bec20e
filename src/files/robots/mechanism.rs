//! Conversion of a robot to a mechanism file: pose, frame, loops, bodies, outputs.

pub(in crate::robots) mod entries;
pub(in crate::robots) mod loop_closing;
pub(in crate::robots) mod loop_options;
pub(in crate::robots) mod series_of_single_joints;

use crate::file::read::value::LIMITS;
use crate::file::schema::MechanismFile;
use crate::format::count_noun;
use crate::robots::description::coupling;
use crate::robots::description::kinematics::{Tree, link_places, spanning_tree};
use crate::robots::mechanism::entries::{Content, merge_links, output_links};
use crate::robots::mechanism::loop_closing::{
    CLOSED, ROUNDED, close_numerically, joint_values, loop_gaps, robot_size, worst_gap,
};
use crate::robots::prelude::*;

/// Puts a robot into its pose and closes its loops. Returns its tree.
pub(crate) fn pose_robot(robot: &mut Robot, options: &Options) -> Found<Tree> {
    apply_pose(robot, options)?;
    let frame = root_link(robot, options)?;
    let tree = spanning_tree(robot, frame);
    check_held(robot, &tree)?;
    close_loops(robot, &tree, options)?;
    Ok(tree)
}

fn apply_pose(robot: &mut Robot, options: &Options) -> Found<()> {
    for (id, values) in &options.pose {
        let at = robot.joint_named("the pose", id)?;
        let joint = &mut robot.joints[at];
        if values.len() != joint.values.len() || !values.iter().all(|v| v.abs() <= 1e9) {
            let (element, found) = (format!("joint \"{id}\""), values.iter().join(","));
            let want = format!("give {} finite numbers", joint.values.len());
            return Err(bad_value(&element, "the pose", &found, &want));
        }
        joint.values = values.iter().map(|v| v - joint.zero).collect();
    }
    Ok(())
}

/// Returns the frame: the world if something is connected to it, otherwise the link that is no joint's child.
fn root_link(robot: &mut Robot, options: &Options) -> Found<usize> {
    if let Some(name) = &options.frame {
        return robot.link_named("the option `frame`", name);
    }
    let in_tree = || robot.joints.iter().filter(|j| !j.closes);
    let child: BTreeSet<usize> = in_tree().map(|j| j.links[1]).collect();
    let held = |w: &usize| in_tree().any(|j| j.links.contains(w));
    let free = |l: &usize| !child.contains(l) && robot.world != Some(*l);
    let first = || (0..robot.links.len()).find(free);
    let root = robot.world.filter(held).or_else(first).unwrap_or(0);
    // In engines, a model that is not connected to the world falls.
    let falls = robot.world.is_none_or(|w| !held(&w));
    let parts = loose_roots(robot, &spanning_tree(robot, root)).len();
    let apart = robot.floats && (falls || parts > 0);
    if !options.floating && !apart {
        return Ok(root);
    }
    let world = match robot.world {
        Some(w) => w,
        None => robot.add_link("world", RigidMotion::IDENTITY),
    };
    robot.world = Some(world);
    // Every tree of links without connection to the world floats separately.
    let tree = spanning_tree(robot, world);
    for &r in tree.roots.iter().skip(1) {
        let sides = [robot.places[r], RigidMotion::IDENTITY];
        let id = format!("floating-{}", robot.links[r]);
        let part = Part::new(&id, [world, r], sides, free_joint());
        robot.joints.push(part);
    }
    if apart && !options.floating {
        let what = if parts == 0 {
            "nothing fixes the model to the world, so it floats with 6 freedoms; name the fixed link as `frame`"
        } else {
            "parts without joints float freely in the world"
        };
        robot.report.moved.push(what.to_owned());
    }
    Ok(world)
}

/// Returns the roots other than the frame, except a world without connections.
fn loose_roots(robot: &Robot, tree: &Tree) -> Vec<usize> {
    let jointless =
        |l: usize| robot.world == Some(l) && !robot.joints.iter().any(|j| j.links.contains(&l));
    let others = tree.roots.iter().skip(1).copied();
    others.filter(|&l| !jointless(l)).collect()
}

/// Checks that every link is connected to the frame.
fn check_held(robot: &Robot, tree: &Tree) -> Found<()> {
    let loose = loose_roots(robot, tree);
    if loose.is_empty() {
        return Ok(());
    }
    let first = loose.iter().take(5);
    let loose = first.map(|&l| format!("link \"{}\"", robot.links[l]));
    let loose = loose.format(", ");
    let root = &robot.links[tree.roots[0]];
    Err(syntax_problem(format!(
        "no joint connects {loose} with {root}; add one, or set `floating` to let every such part float"
    )))
}

/// Closes the loops of a robot: as drawn, by moving joints, or not at all if the options ask for that.
fn close_loops(robot: &mut Robot, tree: &Tree, options: &Options) -> Found<()> {
    if tree.loops.is_empty() {
        return Ok(());
    }
    let size = robot_size(robot);
    let unit = robot.unit;
    let first = worst_gap(&loop_gaps(robot, tree), size);
    let loops = count_noun(tree.loops.len(), "loop");
    if first <= CLOSED * size {
        return Ok(());
    }
    if options.open {
        let widest = widest_gap(robot, tree, size);
        let note =
            format!("loops are open, the widest by {widest}; the figures are those of that pose");
        robot.report.moved.push(note);
        return Ok(());
    }
    let before = joint_values(robot);
    let (left, outside) = close_numerically(robot, tree);
    if left > ROUNDED * size {
        let widest = widest_gap(robot, tree, size);
        return Err(syntax_problem(format!(
            "the loops do not close, the widest is {widest}; give a nearby `pose`, or set `open` to leave them open"
        )));
    }
    if left > CLOSED * size {
        let what = format!(
            "open by {left:.1e} {unit} in every pose, within the rounding of the coordinates; treated as closed"
        );
        robot.report.add_approximation(&loops, what);
    }
    let moved = moved_most(robot, tree, &before);
    let limits = match outside {
        0 => String::new(),
        n => format!("; {n} outside their limits"),
    };
    robot.report.moved.push(format!(
        "{loops} open by {first:.1e} {unit} in the pose of the file, closed to {left:.1e} {unit} by moving joints{moved}{limits}"
    ));
    Ok(())
}

/// Describes the joint of the tree that moved most from the values before; empty if none has a value.
fn moved_most(robot: &Robot, tree: &Tree, before: &[Vec<f64>]) -> String {
    let joints = robot.joints.iter().zip(before).enumerate();
    let in_tree = joints.filter(|(j, _)| !tree.loops.contains(j));
    let by = in_tree.flat_map(|(_, (j, before))| {
        let values = j.values.iter().zip(before);
        values.map(move |(v, b)| ((v - b).abs(), &j.id))
    });
    let largest = by.max_by(|a, b| a.0.total_cmp(&b.0));
    largest.map_or(String::new(), |(v, id)| {
        format!("; {id} moved most, by {v:.3}")
    })
}

/// Describes the loop with the widest gap.
fn widest_gap(robot: &Robot, tree: &Tree, size: f64) -> String {
    let unit = robot.unit;
    let by = |g: &loop_closing::Gap| g.shift.max(g.turn * size);
    let gaps = loop_gaps(robot, tree);
    let most = gaps.iter().max_by(|a, b| by(a).total_cmp(&by(b)));
    most.map_or(String::new(), |g| {
        let p = &robot.joints[g.joint];
        let [a, b] = p.links.map(|l| robot.links[l].as_str());
        format!(
            "\"{}\" between {a} and {b} by {:.2e} {unit} and {:.2e} rad",
            p.id, g.shift, g.turn
        )
    })
}

/// Returns the joints of the tree in loops, and those that close them.
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

/// Returns the entries of the mechanism file of a robot. `source` is the name of the file read, and of its format.
pub(crate) fn make_entries(
    robot: &mut Robot,
    tree: &Tree,
    source: &str,
    options: &Options,
) -> Found<(MechanismFile, Content)> {
    let (bodies, joints) = rigid_bodies(robot, tree)?;
    let frame = bodies[tree.roots[0]];
    let content = Content {
        places: link_places(robot, tree),
        couplings: coupling::usable_couplings(robot, &joints),
        outputs: output_links(robot, &bodies, &joints, frame, options)?,
        bodies,
        frame,
        joints,
    };
    let named = content.outputs.iter().map(|&b| robot.links[b].clone());
    let outputs = (named.collect(), !options.outputs.is_empty());
    let ends = |&j: &usize| robot.joints[j].links.map(|l| content.bodies[l]);
    let used: BTreeSet<usize> = content.joints.iter().flat_map(ends).collect();
    let size = (used.len(), content.joints.len());
    within_limits(size.0, size.1)?;
    (robot.report.outputs, robot.report.size) = (outputs, size);
    Ok((entries::make_file(robot, source, &content), content))
}

/// Merges rigidly joined links to bodies and returns them with the joints between them. Joints within a body are reported and
/// omitted.
fn rigid_bodies(robot: &mut Robot, tree: &Tree) -> Found<(Vec<usize>, Vec<usize>)> {
    let kept = robot.assembly.then(|| in_loops(robot, tree));
    let kept = kept.unwrap_or_default();
    let fixed = |j: usize| robot.joints[j].joint_type == JointType::Fixed && !kept.contains(&j);
    let rigid = tree.steps.iter().filter(|s| fixed(s.joint));
    let bodies = merge_links(robot.links.len(), rigid.map(|s| (s.from, s.link)));
    let in_tree: BTreeSet<usize> = tree.steps.iter().map(|s| s.joint).collect();
    let mut joints = Vec::new();
    let mut within = Vec::new();
    for (j, p) in robot.joints.iter().enumerate() {
        let [a, b] = p.links.map(|l| bodies[l]);
        if a == b && !(in_tree.contains(&j) && fixed(j)) {
            within.push(p.id.clone());
        } else if a != b {
            joints.push(j);
        }
    }
    for id in within {
        let what = "both ends are on one rigid body; omitted, with all its rows redundant";
        let element = format!("joint \"{id}\"");
        robot.report.add_approximation(&element, what);
    }
    if joints.is_empty() {
        let links = robot.links.len();
        Err(ProblemKind::Rigid { links })
    } else {
        Ok((bodies, joints))
    }
}

/// Checks that there are no more links and joints than a mechanism file may have.
fn within_limits(links: usize, joints: usize) -> Found<()> {
    let all = [("links", links, LIMITS.0), ("joints", joints, LIMITS.1)];
    match all.iter().find(|(_, count, limit)| count > limit) {
        None => Ok(()),
        Some((what, count, limit)) => Err(syntax_problem(format!(
            "after merging rigidly joined links there are {count} {what}, more than the {limit} of a mechanism file; import a part of the robot"
        ))),
    }
}
