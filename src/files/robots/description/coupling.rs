//! Couplings of joints: mimic joints and equalities of joint values, as far as they are linear.

use crate::closure::Closure;
use crate::geom::Reals;
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::rounded::verdict::verdict;
use crate::robots::description::Robot;
use crate::robots::warning::Kept;

/// Work of singular values, rows · columns · the lesser of them, up to which the figures are told.
pub(crate) const LARGEST: usize = 2_000_000_000;

/// A coupling that a mechanism file can say.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Usable {
    /// The joints that lead and follow, by their places in the robot.
    pub(in crate::robots) ends: [usize; 2],
    /// The rate of the follower over the leader's.
    pub(in crate::robots) ratio: f64,
    /// The element that says so.
    pub(in crate::robots) said_by: usize,
    /// Whether it says that gears make it.
    pub(in crate::robots) gear: bool,
}

/// Sorts out the couplings that a mechanism file can say; the others are noted and left out. `written` are the joints that
/// go into the file.
pub(crate) fn usable(robot: &mut Robot, written: &[usize]) -> Vec<Usable> {
    let mut out: Vec<Usable> = Vec::new();
    for coupling in robot.couplings.clone() {
        let found = coupling
            .joints
            .each_ref()
            .map(|id| robot.joints.iter().position(|j| j.id == *id));
        let (leader, follower) = (&coupling.joints[0], &coupling.joints[1]);
        let why = match found {
            [Some(a), Some(b)] if a == b => "a joint follows itself".to_owned(),
            [Some(a), Some(b)] => {
                let one = |j: usize| {
                    let freedoms = robot.joints[j].joint_type.freedoms();
                    matches!(freedoms, [Freedom::Rz | Freedom::Tz | Freedom::Screw])
                };
                let value = robot.joints[a].values.first().copied().unwrap_or(0.0);
                let ratio = coupling.at(value);
                let twice = out.iter().any(|u| u.ends == [a, b] || u.ends == [b, a]);
                match [a, b].into_iter().find(|j| !written.contains(j)) {
                    Some(j) => format!("joint {} is within a rigid body", robot.joints[j].id),
                    None if !one(a) || !one(b) => {
                        "only joints of one freedom are coupled".to_owned()
                    }
                    None if twice => "the two are coupled already".to_owned(),
                    None if ratio == 0.0 => {
                        format!("times 0, so that {follower} would stand still")
                    }
                    None => {
                        if coupling.higher != [0.0; 3] {
                            let what = format!(
                                "{follower} is a polynomial of {leader}; here it follows {ratio} times as fast, the derivative at this pose"
                            );
                            robot.report.approximate(&coupling.element, what);
                        }
                        out.push(Usable {
                            ends: [a, b],
                            ratio,
                            said_by: coupling.said_by,
                            gear: coupling.gear,
                        });
                        continue;
                    }
                }
            }
            [None, _] => format!("there is no joint {leader}"),
            [_, None] => format!("there is no joint {follower}"),
        };
        let what = format!("the coupling of {follower} to {leader} (1 row) is left out: {why}");
        robot.report.leave_out_coupling(&coupling.element, what);
    }
    out
}

/// W of a mechanism without and with its couplings; none where there are no couplings or its digits do not decide.
pub(crate) fn kept(m: &Mechanism) -> Option<Kept> {
    if m.couplings.is_empty() {
        return None;
    }
    let mobility = |m: &Mechanism| {
        let closure = Closure::new(&Reals, m, StateId::FREE).ok()?;
        let (rows, columns) = (closure.rows(), closure.columns.len());
        if rows * columns * rows.min(columns) > LARGEST {
            return None;
        }
        let found = verdict(m, StateId::FREE).ok()?;
        found.is_decided().then(|| columns - found.rank())
    };
    let mut without = m.clone();
    without.couplings.clear();
    Some(Kept {
        couplings: m.couplings.len(),
        mobility: mobility(&without).zip(mobility(m)),
    })
}
