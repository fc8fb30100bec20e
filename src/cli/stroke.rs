//! The stroke of `ozols analyze`.

use super::statics;
use crate::model::joint_type::Freedom;
use crate::model::loads;
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::motion::follow::{Follower, slides};
use crate::motion::pose::{FLAT, Pose};
use crate::rank::along_stroke::{StrokeRequest, stroke};
use crate::rank::verdict::{Meant, Verdict};
use crate::view::stroke::Stroke;
use anyhow::{Context, bail, ensure};
use itertools::Itertools;

/// Most steps: every pose on the way is kept.
const MOST: usize = 10_000;

/// A stroke that is asked for.
#[derive(Debug)]
pub(super) struct Asked<'a> {
    mechanism: &'a Mechanism,
    state: StateId,
    verdict: &'a Verdict,
    tolerance: Option<f64>,
    range: loads::Stroke,
    pose: Pose,
    drive: usize,
    held: Vec<usize>,
}

/// The columns that can be a drive, with their names: those of balls cannot, which have no axes of their own.
fn names(m: &Mechanism, pose: &Pose) -> Vec<(usize, String)> {
    let turn = |f: Freedom| matches!(f, Freedom::Rx | Freedom::Ry | Freedom::Rz);
    let of = |j: JointId| pose.columns.iter().filter(move |c| c.joint == j);
    let columns = pose.columns.iter().enumerate();
    columns
        .filter(|(_, c)| of(c.joint).filter(|c| turn(c.freedom)).count() < 3)
        .map(|(i, c)| {
            let id = &m.joints[c.joint].id;
            let name = if of(c.joint).count() == 1 {
                id.clone()
            } else {
                format!("{id}:{}", c.freedom.name())
            };
            (i, name)
        })
        .collect()
}

impl<'a> Asked<'a> {
    /// What `range`, and the joint named as the drive, ask of the mechanism that a verdict is about.
    pub(super) fn new(
        m: &'a Mechanism,
        state: StateId,
        range: &str,
        named: Option<&str>,
        (verdict, tolerance): (&'a Verdict, Option<f64>),
    ) -> anyhow::Result<Asked<'a>> {
        ensure!(
            verdict.is_decided(),
            "the motion of {} over a stroke is not known: {}",
            m.name,
            verdict.undecided()
        );
        let m = verdict.mechanism().unwrap_or(m);
        let pose = Pose::of_file(m, state)?;
        let (drive, held) = drive(m, &pose, state, named)?;
        let slide = slides(&pose, drive);
        if slide && (range.contains("deg") || range.contains("rad")) {
            bail!(
                "--stroke {range:?} is in angles, but the drive slides; give lengths in the file's unit, {}",
                m.length_unit.symbol
            );
        }
        let range = statics::stroke(range)?;
        let far = 1e3 * if slide { pose.length } else { 1.0 };
        if range.steps > MOST || range.from.abs() > far || range.to.abs() > far {
            bail!("--stroke goes to at most {MOST} steps and {far:.0} radians or length units");
        }
        Ok(Asked {
            mechanism: m,
            state,
            verdict,
            tolerance,
            range,
            pose,
            drive,
            held,
        })
    }

    /// Goes there.
    pub(super) fn follow(&self) -> anyhow::Result<Stroke<'a>> {
        let found = self.verdict;
        // Rounded coordinates close no better than what they leave of a zero.
        let measured = found.rounded.as_ref().is_some_and(|r| r.digits.is_some());
        let rounded = measured || !matches!(found.meant, Meant::AsWritten);
        let (mut pose, mut tolerance) = (self.pose.clone(), self.tolerance);
        if let (true, Some(n)) = (rounded, found.numeric) {
            pose = pose.with_accuracy((10.0 * n.dropped).clamp(1e-16, found.tolerance));
            tolerance = Some(found.tolerance.max(FLAT));
        } else if let Some(t) = tolerance {
            // Singular values below a hundred times the accuracy count as zero on the way.
            pose = pose.with_accuracy(t / 100.0);
        }
        let request = StrokeRequest {
            mechanism: self.mechanism,
            state: self.state,
            drive: self.drive,
            held: &self.held,
            range: [self.range.from, self.range.to],
            steps: self.range.steps,
            tolerance,
        };
        let figures = stroke(&request, &pose);
        let drive = name_of(self.mechanism, &self.pose, self.drive);
        let drive = (drive, slides(&self.pose, self.drive));
        let range = request.range;
        Ok(Stroke::new(
            self.mechanism,
            self.state,
            drive,
            range,
            &figures,
        ))
    }
}

/// The column that moves and those that are held.
fn drive(
    m: &Mechanism,
    pose: &Pose,
    state: StateId,
    asked: Option<&str>,
) -> anyhow::Result<(usize, Vec<usize>)> {
    let names = names(m, pose);
    let driven = |j: JointId| m.joints[j].drive;
    let column = |joint: JointId, freedom: Option<&str>| {
        let mut of: Vec<_> = names
            .iter()
            .filter(|(c, _)| pose.columns[*c].joint == joint)
            .filter(|(c, _)| freedom.is_none_or(|f| pose.columns[*c].freedom.name() == f))
            .collect();
        if of.len() > 1 {
            of.retain(|(c, _)| moves(pose, *c));
        }
        match of[..] {
            [(c, _)] => Ok(*c),
            [] => bail!(
                "joint {} has no freedom{} to be driven in state {}; {}",
                m.joints[joint].id,
                freedom.map_or_else(String::new, |f| format!(" {f}")),
                m.states[state],
                could(m, pose, &names)
            ),
            _ => bail!(
                "joint {} has several freedoms; say which moves: --drive {}",
                m.joints[joint].id,
                of.iter().map(|(_, n)| n).join(" or --drive ")
            ),
        }
    };
    let chosen = match asked {
        Some(name) => {
            let split = name.rsplit_once(':');
            let (id, freedom) = match (m.joint(name), split) {
                (None, Some((id, freedom))) if m.joint(id).is_some() => (id, Some(freedom)),
                _ => (name, None),
            };
            let joint = m
                .joint(id)
                .with_context(|| format!("there is no joint {name}; {}", could(m, pose, &names)))?;
            column(joint, freedom)?
        }
        None => {
            let joint = m.joints_in(state).find(|&j| driven(j)).with_context(|| {
                format!(
                    "{} has no drive; name the joint that moves with --drive: {}",
                    m.name,
                    could(m, pose, &names)
                )
            })?;
            column(joint, None)?
        }
    };
    let own = pose.columns[chosen].joint;
    let held = (0..pose.columns.len())
        .filter(|&c| pose.columns[c].joint != own && driven(pose.columns[c].joint))
        .filter(|_| driven(own))
        .collect();
    Ok((chosen, held))
}

/// The column named, or the drive, or, where there is none, the first that can move; and those that are held.
pub(super) fn drive_or_any(
    m: &Mechanism,
    pose: &Pose,
    state: StateId,
    asked: Option<&str>,
) -> anyhow::Result<(usize, Vec<usize>)> {
    let driven = m.joints_in(state).any(|j| m.joints[j].drive);
    if asked.is_some() || driven {
        return drive(m, pose, state, asked);
    }
    let first = names(m, pose).into_iter().find(|(c, _)| moves(pose, *c));
    let first = first.with_context(|| format!("nothing can move in {}", m.name))?;
    Ok((first.0, Vec::new()))
}

/// The name of a column that can be a drive.
pub(super) fn name_of(m: &Mechanism, pose: &Pose, column: usize) -> String {
    let mut names = names(m, pose).into_iter();
    names
        .find(|(c, _)| *c == column)
        .map_or_else(String::new, |(_, n)| n)
}

/// Whether a column can move in a pose.
fn moves(pose: &Pose, column: usize) -> bool {
    Follower::new(pose.clone(), column, &[]).share() > 1e-6
}

/// Which joints could be drives in this pose.
fn could(m: &Mechanism, pose: &Pose, names: &[(usize, String)]) -> String {
    let moving = names.iter().filter(|(c, _)| moves(pose, *c));
    let list = moving.map(|(_, n)| n).take(30).join(", ");
    if list.is_empty() {
        format!("none can move in {}", m.name)
    } else {
        format!("these can move: {list}")
    }
}
