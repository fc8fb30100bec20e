//! Couplings as mimic joints: each joint follows one other at most, and none itself by way of others.

use crate::robots::convert::lost::Lost;
use crate::robots::convert::scene::RobotScene;
use crate::robots::description::parts::Ratio;
use std::collections::BTreeMap;

/// What a joint follows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Follows {
    pub(crate) leader: usize,
    /// Its own rate over the leader's, in radians and metres.
    pub(crate) ratio: f64,
    /// Its value where the leader's is zero.
    pub(crate) offset: f64,
}

/// For each joint that follows another what that is. `fits` says which joints may; `from_pose` whether values count from the pose
/// that is written. What cannot be said so is lost.
pub(crate) fn mimics(
    scene: &RobotScene<'_>,
    fits: impl Fn(usize) -> bool,
    from_pose: bool,
    lost: &mut Lost,
) -> BTreeMap<usize, Follows> {
    let robot = scene.robot;
    let mut out = BTreeMap::new();
    for c in &robot.couplings {
        let found = c.joints.each_ref().map(|id| {
            let j = robot.joints.iter().position(|p| p.id == *id)?;
            (robot.joints[j].values.len() == 1 && fits(j)).then_some(j)
        });
        let way = match found {
            [Some(a), Some(b)] => either(scene, c, [a, b], from_pose, &out),
            _ => None,
        };
        match way {
            Some((follower, follows)) => {
                out.insert(follower, follows);
                if c.higher != [0.0; 3] {
                    let why = "its tangent at the pose stands for it";
                    lost.one("polynomial of a coupling", Some(&c.joints[1]), why);
                }
            }
            None => {
                let why =
                    "two joints of one freedom each are coupled there, and each follows one other";
                lost.one("coupling", Some(&c.joints[1]), why);
                lost.coupling_rows += 1;
            }
        }
    }
    out
}

/// The coupling as its follower has it, or as its leader has it turned round.
fn either(
    scene: &RobotScene<'_>,
    c: &Ratio,
    [a, b]: [usize; 2],
    from_pose: bool,
    all: &BTreeMap<usize, Follows>,
) -> Option<(usize, Follows)> {
    let [x, y] = [a, b].map(|j| scene.part(j).values[0]);
    let ratio = c.at(x);
    let [two, three, four] = c.higher;
    let whole = x * (c.ratio + x * (two + x * (three + x * four)));
    // On the tangent through the pose.
    let stated = scene
        .payload
        .offsets
        .get(&c.said_by)
        .copied()
        .unwrap_or(0.0);
    let offset = if from_pose {
        stated + whole - y
    } else {
        stated + whole - ratio * x
    };
    let offset = if offset.abs() < 1e-12 { 0.0 } else { offset };
    let ways = [
        (
            b,
            Follows {
                leader: a,
                ratio,
                offset,
            },
        ),
        (
            a,
            Follows {
                leader: b,
                ratio: 1.0 / ratio,
                offset: -offset / ratio,
            },
        ),
    ];
    ways.into_iter().find(|(follower, f)| {
        f.ratio.is_finite() && !all.contains_key(follower) && !leads_back(all, f.leader, *follower)
    })
}

/// Whether a joint follows another, by way of others.
fn leads_back(all: &BTreeMap<usize, Follows>, joint: usize, other: usize) -> bool {
    let mut at = Some(joint);
    // No chain is longer: none leads back to itself.
    for _ in 0..=all.len() {
        let Some(j) = at else { return false };
        if j == other {
            return true;
        }
        at = all.get(&j).map(|f| f.leader);
    }
    at.is_some()
}
