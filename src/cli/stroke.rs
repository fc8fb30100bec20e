//! The stroke of `ozols analyze`.

use super::analyze::Analyze;
use super::statics;
use crate::model::joint_type::Freedom;
use crate::model::loads;
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::motion::follow::{Follower, slides};
use crate::motion::pose::{FLAT, Pose};
use crate::rank::along_stroke::{StrokeRequest, stroke};
use crate::rank::auto::{Geometry, decide};
use crate::view::stroke::Stroke;
use anyhow::{Context, bail};
use itertools::Itertools;

/// Most steps: every pose on the way is kept.
const MOST: usize = 10_000;

/// A stroke that is asked for.
#[derive(Debug)]
pub(super) struct Asked<'a> {
    mechanism: &'a Mechanism,
    state: StateId,
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
    /// What the arguments ask, if anything.
    pub(super) fn new(m: &'a Mechanism, a: &Analyze) -> anyhow::Result<Option<Asked<'a>>> {
        let Some(range) = &a.stroke else {
            return Ok(None);
        };
        let state = m.state(&a.state).unwrap_or(StateId::FREE);
        let pose = Pose::of_file(m, state)?;
        let (drive, held) = drive(m, &pose, state, a.drive.as_deref())?;
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
        Ok(Some(Asked {
            mechanism: m,
            state,
            tolerance: a.tolerance,
            range,
            pose,
            drive,
            held,
        }))
    }

    /// Goes there.
    pub(super) fn follow(&self) -> anyhow::Result<Stroke<'a>> {
        let decision = decide(self.mechanism, self.state, self.tolerance)?;
        let measured = !matches!(decision.geometry, Geometry::Exact);
        let (mut pose, mut tolerance) = (self.pose.clone(), self.tolerance);
        if let (true, Some(n)) = (measured, decision.numeric) {
            pose = pose.with_accuracy((10.0 * n.dropped).clamp(1e-16, decision.tolerance));
            tolerance = Some(decision.tolerance.max(FLAT));
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
        let drive = names(self.mechanism, &self.pose)
            .into_iter()
            .find(|(c, _)| *c == self.drive)
            .map_or_else(String::new, |(_, n)| n);
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
