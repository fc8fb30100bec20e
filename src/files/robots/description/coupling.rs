//! Couplings of joints: mimic joints and equalities of joint values, if they are linear. A mimic joint follows at most one other,
//! so mimic joints can only represent a tree of couplings.

use crate::closure::tree::spanning_forest;
use crate::robots::prelude::*;

/// A coupling that a mechanism file can represent.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Usable {
    /// The leading and the following joint, by their indices in the robot.
    pub(in crate::robots) ends: [usize; 2],
    /// The rate of the follower over the leader's.
    pub(in crate::robots) ratio: f64,
    /// The element that defines it.
    pub(in crate::robots) said_by: usize,
    /// Whether gears make it, according to the file.
    pub(in crate::robots) gear: bool,
}

/// Selects the couplings that a mechanism file can represent; the others are noted and omitted. `written` are the joints of the
/// file.
pub(crate) fn usable_couplings(robot: &mut Robot, written: &[usize]) -> Vec<Usable> {
    let mut out: Vec<Usable> = Vec::new();
    for coupling in robot.couplings.clone() {
        let found = coupling.joints.each_ref();
        let found = found.map(|id| robot.joints.iter().position(|j| j.id == *id));
        let (leader, follower) = (&coupling.joints[0], &coupling.joints[1]);
        let one = |j: usize| {
            let freedoms = robot.joints[j].joint_type.freedoms();
            matches!(freedoms, [Freedom::Rz | Freedom::Tz | Freedom::Screw])
        };
        let why = match found {
            [None, _] => format!("there is no joint {leader}"),
            [_, None] => format!("there is no joint {follower}"),
            [Some(a), Some(b)] => {
                let ends = [a, b];
                let value = robot.joints[a].values.first().copied().unwrap_or(0.0);
                let ratio = coupling.rate_at(value);
                let within = ends.into_iter().find(|j| !written.contains(j));
                if a == b {
                    "a joint follows itself".to_owned()
                } else if let Some(j) = within {
                    format!("joint {} is within a rigid body", robot.joints[j].id)
                } else if !one(a) || !one(b) {
                    "only joints of one freedom are coupled".to_owned()
                } else if out.iter().any(|u| u.ends == ends || u.ends == [b, a]) {
                    "the two joints are coupled already".to_owned()
                } else if ratio == 0.0 {
                    format!("times 0, which would lock {follower}")
                } else {
                    if coupling.higher != [0.0; 3] {
                        let what = format!(
                            "{follower} is a polynomial of {leader}; its rate of {ratio} at this pose is used"
                        );
                        robot.report.add_approximation(&coupling.element, what);
                    }
                    out.push(Usable {
                        ends,
                        ratio,
                        said_by: coupling.said_by,
                        gear: coupling.gear,
                    });
                    continue;
                }
            }
        };
        let what = format!("the coupling of {follower} to {leader} (1 row) is omitted: {why}");
        robot.report.leave_out_coupling(&coupling.element, what);
    }
    out
}

/// The joint that a joint follows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Follows {
    /// The joint that leads.
    pub(in crate::robots) leader: JointId,
    /// Its own rate over the leader's, in radians and metres.
    pub(in crate::robots) ratio: f64,
}

/// Returns for each joint the joint it follows, and a sentence for each coupling that mimic joints cannot represent. Such couplings have
/// joints that are not `written` as joints of one freedom, or close a loop of couplings.
pub(crate) fn find_mimics(m: &Mechanism, written: &[bool]) -> (Vec<Option<Follows>>, Vec<String>) {
    let mut follows = vec![None; m.joints.len()];
    let mut said = vec![false; m.couplings.len()];
    let fits = |j: JointId| written[j] && m.joints[j].joint_type.freedoms().len() == 1;
    // Drives lead. A coupling of joints that cannot follow is a loop of one node, which no tree takes.
    let drives = m.joint_ids().filter(|&j| m.joints[j].drive);
    let edges = m.couplings.iter().map(|c| {
        let [a, b] = c.ends.map(|e| e.joint);
        let ends = if fits(a) && fits(b) { [a, b] } else { [a, a] };
        ends.map(JointId::index)
    });
    let starts = drives.chain(m.joint_ids()).map(JointId::index);
    let (_, steps) = spanning_forest(m.joints.len(), edges, |_| false, starts);
    for s in steps {
        let coupling = &m.couplings[s.joint];
        let unit = |e: usize| match coupling.ends[e].freedom {
            f if f.is_slide() => m.length_unit.metres,
            _ => 1.0,
        };
        let forward = coupling.ratio.to_f64() * unit(1) / unit(0);
        let ratio = if s.forward { forward } else { 1.0 / forward };
        follows[s.link] = Some(Follows {
            leader: JointId::new(s.from),
            ratio,
        });
        said[s.joint] = true;
    }
    let left = m.couplings.iter().zip(&said).filter(|(_, s)| !**s);
    let present = left.filter(|(c, _)| m.couplings_in(StateId::FREE).any(|x| x.ends == c.ends));
    let what = "coupled, which a mimic joint cannot represent";
    let unsaid = present.map(|(c, _)| format!("{what}: {}", c.name(m)));
    (follows, unsaid.collect())
}
