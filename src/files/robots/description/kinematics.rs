//! The spanning tree of a robot and the places of its links.

use crate::closure::tree::{TreeStep, spanning_forest};
use crate::robots::prelude::*;

/// A spanning tree, or forest, of the links.
pub(crate) struct Tree {
    /// Roots, the frame first.
    pub(in crate::robots) roots: Vec<usize>,
    /// The joints of the tree, roots first: the joint, the link it leads to, and whether that is its child.
    pub(in crate::robots) steps: Vec<TreeStep<usize, usize>>,
    /// For each link the step that leads to it.
    pub(in crate::robots) into: Vec<Option<usize>>,
    /// The joints that close loops.
    pub(in crate::robots) loops: Vec<usize>,
}

/// Builds the spanning tree from `frame`, breadth first; unreached links start their own trees at links that are no joint's
/// child. Joints that close loops by their description join a tree only if nothing else holds a link.
pub(crate) fn spanning_tree(robot: &Robot, frame: usize) -> Tree {
    let n = robot.links.len();
    let mut is_child = vec![false; n];
    for p in robot.joints.iter().filter(|p| !p.closes) {
        is_child[p.links[1]] = true;
    }
    let starts = std::iter::once(frame)
        .chain((0..n).filter(|&l| !is_child[l]))
        .chain(0..n);
    let closes = |j: usize| robot.joints[j].closes;
    let (roots, steps) = spanning_forest(n, robot.joints.iter().map(|p| p.links), closes, starts);
    let mut into = vec![None; n];
    let mut used = vec![false; robot.joints.len()];
    for (i, s) in steps.iter().enumerate() {
        (into[s.link], used[s.joint]) = (Some(i), true);
    }
    Tree {
        roots,
        steps,
        into,
        loops: (0..robot.joints.len()).filter(|&j| !used[j]).collect(),
    }
}

/// Returns the displacement of one freedom.
fn freedom_motion(part: &Part, freedom: Freedom, value: f64) -> RigidMotion {
    let d = unit_or_z(part.direction(freedom));
    match freedom {
        Freedom::Screw => RigidMotion {
            translation: scale(d, value * part.pitch),
            ..RigidMotion::from_turn(d, value)
        },
        f if f.is_slide() => RigidMotion::from_translation(scale(d, value)),
        _ => RigidMotion::from_turn(d, value),
    }
}

/// Returns the displacement of a joint: its child's side in its parent's.
pub(crate) fn joint_motion(part: &Part) -> RigidMotion {
    let moves = part.joint_type.freedoms().iter().zip(&part.values);
    let moves = moves.map(|(&f, &v)| freedom_motion(part, f, v));
    moves.fold(RigidMotion::IDENTITY, |pose, by| pose.then(&by))
}

/// Returns the places of all links.
pub(crate) fn link_places(robot: &Robot, tree: &Tree) -> Vec<RigidMotion> {
    let mut out = robot.places.clone();
    for s in &tree.steps {
        let p = &robot.joints[s.joint];
        let moved = p.sides[0].then(&joint_motion(p));
        let across = moved.then(&p.sides[1].inverse());
        let across = if s.forward { across } else { across.inverse() };
        out[s.link] = out[s.from].then(&across);
    }
    out
}

/// A freedom of a joint in the world.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WorldAxis {
    pub(in crate::robots) freedom: Freedom,
    pub(in crate::robots) point: Vector,
    /// The direction, with its length in the file.
    pub(in crate::robots) direction: Vector,
}

/// Returns the freedoms of a joint in the world; each is moved by those before it.
pub(crate) fn world_axes(part: &Part, places: &[RigidMotion]) -> Vec<WorldAxis> {
    let mut pose = places[part.links[0]].then(&part.sides[0]);
    let mut out = Vec::new();
    for (&freedom, &value) in part.joint_type.freedoms().iter().zip(&part.values) {
        out.push(WorldAxis {
            freedom,
            point: pose.translation,
            direction: pose.map_direction(part.direction(freedom)),
        });
        pose = pose.then(&freedom_motion(part, freedom, value));
    }
    out
}
