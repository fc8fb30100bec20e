//! The default outputs: the links that a user of the robot usually means.

use crate::closure::tree::forest;
use crate::file::problem::ProblemKind;
use crate::robots::description::Robot;
use crate::robots::mechanism::entries::Bodies;
use crate::robots::warning::Options;
use crate::robots::warning::{known, syntax_problem, unknown_name};
use std::collections::BTreeSet;

/// Last words of the names of end effectors.
const NAMES: &str = "foot feet toe hand palm tool tool0 tcp ee eef effector flange tip \
    fingertip pad platform gripper wheel";
/// Words behind them that say nothing.
const IDLE: &str = "link body frame left right l r front rear";

pub(crate) fn link_of(robot: &Robot, name: &str) -> Result<usize, ProblemKind> {
    robot.links.iter().position(|l| l == name).ok_or_else(|| {
        let known = known("links", &robot.links);
        unknown_name("the command line", "link", name, &known)
    })
}

/// Returns the output links by their representatives: those asked for, or end effectors by name, or the ends of chains with a
/// shape or a site, or all ends, or the farthest link from the frame; and a floating base.
pub(crate) fn of(
    robot: &Robot,
    bodies: &Bodies,
    joints: &[usize],
    frame: usize,
    options: &Options,
) -> Result<Vec<usize>, ProblemKind> {
    let mut out = Vec::new();
    for name in &options.outputs {
        let b = bodies.of[link_of(robot, name)?];
        if b == frame {
            return Err(syntax_problem(format!(
                "link \"{name}\" is the frame or fixed to it; name a link that moves"
            )));
        }
        out.push(b);
    }
    if out.is_empty() {
        out = meant(robot, bodies, joints, frame);
    }
    out.sort_unstable();
    out.dedup();
    Ok(out)
}

fn meant(robot: &Robot, bodies: &Bodies, joints: &[usize], frame: usize) -> Vec<usize> {
    let ends = joints
        .iter()
        .map(|&j| robot.joints[j].links.map(|l| bodies.of[l]));
    let n = robot.links.len();
    let mut joints_at = vec![0; n];
    ends.clone().flatten().for_each(|b| joints_at[b] += 1);
    let moves = |b: usize| b != frame && joints_at[b] > 0;
    let named = (0..n).filter(|&l| moves(bodies.of[l]) && is_effector(&robot.links[l]));
    let named: Vec<usize> = named.map(|l| bodies.of[l]).collect();
    let floating = joints.iter().map(|&j| &robot.joints[j]);
    // What is driven in all ways is led, and leads nowhere.
    let floating = floating.filter(|p| p.joint_type.freedoms().len() == 6 && !p.drive);
    let floating = floating.flat_map(|p| p.links.map(|l| bodies.of[l]));
    let floating: Vec<usize> = floating.filter(|&b| b != frame).collect();
    if !named.is_empty() {
        return [named, floating].concat();
    }
    let shown: BTreeSet<usize> = robot.shown.iter().map(|&l| bodies.of[l]).collect();
    let leaves: Vec<usize> = (0..n).filter(|&b| moves(b) && joints_at[b] == 1).collect();
    let with: Vec<usize> = leaves
        .iter()
        .copied()
        .filter(|b| shown.contains(b))
        .collect();
    let leaves = if with.is_empty() { leaves } else { with };
    if !leaves.is_empty() || !floating.is_empty() {
        return [leaves, floating].concat();
    }
    let (_, steps) = forest(n, ends, |_| false, [frame]);
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
