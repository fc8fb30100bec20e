//! The spanning tree of a robot and the places of its links.

use crate::model::joint_type::Freedom;
use crate::robots::parts::{Part, Robot};
use crate::robots::pose::{Pose, V3, scale, unit};

/// A spanning tree, or forest, of the links.
#[derive(Debug)]
pub(crate) struct Tree {
    /// Roots, the frame first.
    pub(super) roots: Vec<usize>,
    /// The joints of the tree, roots first: the joint, the link it leads to, and whether that is its child.
    pub(super) steps: Vec<Step>,
    /// For each link the step that leads to it.
    pub(super) into: Vec<Option<usize>>,
    /// The joints that close loops.
    pub(super) loops: Vec<usize>,
}

/// A joint on the way from a root.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Step {
    pub(super) joint: usize,
    pub(super) link: usize,
    pub(super) from: usize,
    pub(super) forward: bool,
}

/// The spanning tree from `frame`, breadth first; links that it does not reach start trees of their own at links that
/// are no joint's child.
pub(crate) fn spanning_tree(robot: &Robot, frame: usize) -> Tree {
    let n = robot.links.len();
    let mut at: Vec<Vec<usize>> = vec![Vec::new(); n];
    let mut is_child = vec![false; n];
    for (j, p) in robot.joints.iter().enumerate() {
        p.links.iter().for_each(|&l| at[l].push(j));
        if !p.closes {
            is_child[p.links[1]] = true;
        }
    }
    let mut tree = Tree {
        roots: Vec::new(),
        steps: Vec::new(),
        into: vec![None; n],
        loops: Vec::new(),
    };
    let (mut reached, mut used) = (vec![false; n], vec![false; robot.joints.len()]);
    let starts = std::iter::once(frame)
        .chain((0..n).filter(|&l| !is_child[l]))
        .chain(0..n)
        .collect::<Vec<_>>();
    // Joints that say they close loops join the tree only where nothing else holds a link.
    for also_closing in [false, true] {
        for &start in &starts {
            if reached[start] && !(also_closing && tree.roots.contains(&start)) {
                continue;
            }
            if !reached[start] {
                // With closing joints still to come, only the frame's tree is grown.
                if !also_closing && start != frame {
                    continue;
                }
                reached[start] = true;
                tree.roots.push(start);
            }
            grow(
                robot,
                &at,
                also_closing,
                start,
                &mut reached,
                &mut used,
                &mut tree,
            );
        }
    }
    tree.loops = (0..robot.joints.len()).filter(|&j| !used[j]).collect();
    tree
}

fn grow(
    robot: &Robot,
    at: &[Vec<usize>],
    also_closing: bool,
    start: usize,
    reached: &mut [bool],
    used: &mut [bool],
    tree: &mut Tree,
) {
    // A second pass goes on from all links of the tree, the links between ordinary joints first.
    let mut queue = vec![start];
    let mut next = 0;
    if also_closing {
        queue.extend(tree.steps.iter().map(|s| s.link));
    }
    let mut waiting: Vec<usize> = Vec::new();
    loop {
        while let Some(&l) = queue.get(next) {
            next += 1;
            for &j in &at[l] {
                let p = &robot.joints[j];
                let forward = p.links[0] == l;
                let link = p.links[usize::from(forward)];
                if used[j] || reached[link] {
                    continue;
                }
                if p.closes {
                    waiting.push(j);
                    continue;
                }
                step(j, l, link, forward, reached, used, tree);
                queue.push(link);
            }
        }
        if !also_closing {
            return;
        }
        let Some(j) = (!waiting.is_empty()).then(|| waiting.remove(0)) else {
            return;
        };
        let [a, b] = robot.joints[j].links;
        if used[j] || reached[a] == reached[b] {
            continue;
        }
        let (from, link, forward) = if reached[a] {
            (a, b, true)
        } else {
            (b, a, false)
        };
        step(j, from, link, forward, reached, used, tree);
        queue.push(link);
    }
}

fn step(
    joint: usize,
    from: usize,
    link: usize,
    forward: bool,
    reached: &mut [bool],
    used: &mut [bool],
    tree: &mut Tree,
) {
    (reached[link], used[joint]) = (true, true);
    tree.into[link] = Some(tree.steps.len());
    tree.steps.push(Step {
        joint,
        link,
        from,
        forward,
    });
}

/// The displacement of one freedom.
fn elementary(part: &Part, freedom: Freedom, value: f64) -> Pose {
    let d = unit(part.direction(freedom));
    match freedom {
        Freedom::Rx | Freedom::Ry | Freedom::Rz => Pose::turn(d, value),
        Freedom::Tx | Freedom::Ty | Freedom::Tz => Pose::shift(scale(d, value)),
        Freedom::Screw => Pose {
            at: scale(d, value * part.pitch),
            ..Pose::turn(d, value)
        },
    }
}

/// The displacement of a joint: its child's side in its parent's.
pub(crate) fn displacement(part: &Part) -> Pose {
    part.joint_type
        .freedoms()
        .iter()
        .zip(&part.values)
        .fold(Pose::IDENTITY, |pose, (&f, &v)| {
            pose.then(&elementary(part, f, v))
        })
}

/// The places of all links.
pub(crate) fn places(robot: &Robot, tree: &Tree) -> Vec<Pose> {
    let mut out = robot.places.clone();
    for s in &tree.steps {
        let p = &robot.joints[s.joint];
        let across = p.sides[0]
            .then(&displacement(p))
            .then(&p.sides[1].inverse());
        out[s.link] = if s.forward {
            out[s.from].then(&across)
        } else {
            out[s.from].then(&across.inverse())
        };
    }
    out
}

/// A freedom of a joint in the world.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WorldAxis {
    pub(super) freedom: Freedom,
    pub(super) point: V3,
    /// Of the length it has in the file.
    pub(super) direction: V3,
}

/// The freedoms of a joint in the world; each is carried along by those before it.
pub(crate) fn world_axes(part: &Part, places: &[Pose]) -> Vec<WorldAxis> {
    let mut pose = places[part.links[0]].then(&part.sides[0]);
    let mut out = Vec::new();
    for (&freedom, &value) in part.joint_type.freedoms().iter().zip(&part.values) {
        out.push(WorldAxis {
            freedom,
            point: pose.at,
            direction: pose.direction(part.direction(freedom)),
        });
        pose = pose.then(&elementary(part, freedom, value));
    }
    out
}
