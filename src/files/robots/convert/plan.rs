//! A robot as bodies that hang on one another: which joints hold, which close loops, and what each is made of.

use crate::closure::tree::{TreeStep, forest};
use crate::geom::rigid::{RigidMotion, towards};
use crate::geom::vector::{Vector, scale};
use crate::model::joint_type::{Freedom, JointType};
use crate::robots::description::parts::{Part, Robot};

/// What a single freedom does; metres a radian of a screw.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Moves {
    Turn,
    Slide,
    Screw(f64),
}

/// A freedom of a joint, in series with the others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Single {
    pub(crate) moves: Moves,
    /// A unit vector in the joint's frame.
    pub(crate) axis: Vector,
    /// In the pose that is written.
    pub(crate) value: f64,
    /// Its place among the freedoms of the joint.
    pub(crate) freedom: usize,
}

impl Single {
    /// Where it takes what hangs on it.
    pub(crate) fn displacement(&self) -> RigidMotion {
        let turn = RigidMotion::turn(self.axis, self.value);
        match self.moves {
            Moves::Turn => turn,
            Moves::Slide => RigidMotion::shift(scale(self.axis, self.value)),
            Moves::Screw(pitch) => RigidMotion {
                translation: scale(self.axis, self.value * pitch),
                ..turn
            },
        }
    }

    /// The same seen from its other end.
    fn back(self) -> Single {
        Single {
            axis: scale(self.axis, -1.0),
            ..self
        }
    }
}

/// A joint that holds a link: its place on the link that bears it, and on the one that it holds.
#[derive(Debug, Clone)]
pub(crate) struct Branch {
    pub(crate) joint: usize,
    pub(crate) from: usize,
    pub(crate) link: usize,
    pub(crate) near: RigidMotion,
    pub(crate) far: RigidMotion,
    pub(crate) singles: Vec<Single>,
    /// Whether the link that it holds is the first of the joint's two.
    pub(crate) backward: bool,
}

impl Branch {
    /// The place of the held link on the other, in the pose that is written.
    pub(crate) fn across(&self) -> RigidMotion {
        let moved = |at: RigidMotion, s: &Single| at.then(&s.displacement());
        let moved = self.singles.iter().fold(self.near, moved);
        moved.then(&self.far.inverse())
    }

    /// The same where all freedoms are at zero.
    pub(crate) fn at_zero(&self) -> RigidMotion {
        self.near.then(&self.far.inverse())
    }

    pub(crate) fn is_free(&self) -> bool {
        self.singles.len() == 6
    }
}

/// How a joint that closes a loop does so: freedoms in series on either link, and what holds their ends together.
#[derive(Debug, Clone)]
pub(crate) struct Ending {
    /// Freedoms from the end of each of its links.
    pub(crate) on: [Vec<Single>; 2],
    /// Whether a point is held; else all six.
    pub(crate) point: bool,
}

/// The tree and the loops of a robot.
#[derive(Debug)]
pub(crate) struct TreePlan {
    pub(crate) root: usize,
    /// What holds each link, those that bear others first.
    pub(crate) branches: Vec<Branch>,
    /// The joints that close loops.
    pub(crate) loops: Vec<usize>,
}

/// The freedoms of a joint one by one, from its second link where asked for.
pub(crate) fn singles(part: &Part, backward: bool) -> Vec<Single> {
    let one = |(i, &f): (usize, &Freedom)| Single {
        moves: match f {
            Freedom::Screw => Moves::Screw(part.pitch),
            f if f.slides() => Moves::Slide,
            _ => Moves::Turn,
        },
        axis: towards(part.direction(f)),
        value: part.values.get(i).copied().unwrap_or(0.0),
        freedom: i,
    };
    let all = part.joint_type.freedoms().iter().enumerate().map(one);
    if backward {
        all.rev().map(Single::back).collect()
    } else {
        all.collect()
    }
}

/// How a joint closes a loop: three turns in a row are a point.
pub(crate) fn ending(part: &Part) -> Ending {
    let all = singles(part, false);
    let turns = |s: &[Single]| s.iter().all(|x| x.moves == Moves::Turn);
    let ball = all.windows(3).position(turns);
    match ball {
        Some(at) => Ending {
            on: [
                all[..at].to_vec(),
                all[at + 3..].iter().rev().map(|s| s.back()).collect(),
            ],
            point: true,
        },
        None => Ending {
            on: [all, Vec::new()],
            point: false,
        },
    }
}

impl TreePlan {
    /// The tree of a robot from the link that stands still. Loops are cut where the file says so, else at balls and welds, which
    /// every format has words for.
    pub(crate) fn new(robot: &Robot, root: usize) -> TreePlan {
        let rank = |p: &Part| match p.joint_type {
            _ if p.closes => 2,
            JointType::Spherical | JointType::Fixed => 1,
            _ => 0,
        };
        let mut order: Vec<usize> = (0..robot.joints.len()).collect();
        order.sort_by_key(|&j| rank(&robot.joints[j]));
        let mut group: Vec<usize> = (0..robot.links.len()).collect();
        let mut holds = vec![false; robot.joints.len()];
        for j in order {
            let [a, b] = robot.joints[j].links.map(|l| group[l]);
            if a != b {
                group.iter_mut().filter(|g| **g == b).for_each(|g| *g = a);
                holds[j] = true;
            }
        }
        let tree: Vec<usize> = (0..holds.len()).filter(|&j| holds[j]).collect();
        let edges = tree.iter().map(|&j| robot.joints[j].links);
        let (_, steps) = forest(robot.links.len(), edges, |_| false, [root]);
        let branches = steps.iter().map(|s| branch(robot, tree[s.joint], s));
        TreePlan {
            root,
            branches: branches.collect(),
            loops: (0..holds.len()).filter(|&j| !holds[j]).collect(),
        }
    }

    /// The joints that hold something on a link.
    pub(crate) fn on(&self, link: usize) -> impl Iterator<Item = &Branch> {
        self.branches.iter().filter(move |b| b.from == link)
    }

    /// What holds a link.
    pub(crate) fn into(&self, link: usize) -> Option<&Branch> {
        self.branches.iter().find(|b| b.link == link)
    }
}

fn branch(robot: &Robot, joint: usize, s: &TreeStep<usize, usize>) -> Branch {
    let part = &robot.joints[joint];
    let [a, b] = part.sides;
    let (near, far) = if s.forward { (a, b) } else { (b, a) };
    Branch {
        joint,
        from: s.from,
        link: s.link,
        near,
        far,
        singles: singles(part, !s.forward),
        backward: !s.forward,
    }
}
