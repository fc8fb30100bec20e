//! A stroke in the words of its user: which column moves, which are held, how exactly it is followed.

use crate::geom::exact::ExactError;
use crate::model::joint_type::Freedom;
use crate::model::loads;
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::motion::follow::{Follower, slides};
use crate::motion::pose::{FLAT, Pose};
use crate::rank::rounded::verdict::{Meant, RankVerdict};
use crate::rank::stroke::analysis::{StrokeFigures, StrokeRequest, stroke};
use itertools::Itertools;
use thiserror::Error;

/// Most steps: every pose on the way is kept.
const MOST: usize = 10_000;

/// Why a mechanism cannot be followed over a stroke.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum AskedError {
    /// Which mechanism is meant is not known.
    #[error("the motion of {name} over a stroke is not known: {why}")]
    Undecided {
        /// Name of the mechanism.
        name: String,
        /// Why not.
        why: String,
    },
    /// Angles for a drive that slides.
    #[error(
        "--stroke {range:?} is in angles, but the drive slides; give lengths in the file's unit, {unit}"
    )]
    Angles {
        /// The range.
        range: String,
        /// Symbol of the unit.
        unit: &'static str,
    },
    /// Too far, or in too many steps.
    #[error("--stroke goes to at most {MOST} steps and {0:.0} radians or length units")]
    Far(f64),
    /// A joint without that freedom.
    #[error("joint {joint} has no freedom{freedom} to be driven in state {state}; {could}")]
    NoFreedom {
        /// The joint.
        joint: String,
        /// The freedom, after a space; nothing where none was named.
        freedom: String,
        /// The state.
        state: String,
        /// What could be driven.
        could: String,
    },
    /// A joint with several.
    #[error(
        "joint {joint} has several freedoms; say which moves: --drive {}", names.join(" or --drive ")
    )]
    Several {
        /// The joint.
        joint: String,
        /// Its freedoms.
        names: Vec<String>,
    },
    /// No such joint.
    #[error("there is no joint {name}; {could}")]
    NoJoint {
        /// What was named.
        name: String,
        /// What could be driven.
        could: String,
    },
    /// Nothing is driven.
    #[error("{name} has no drive; name the joint that moves with --drive: {could}")]
    NoDrive {
        /// Name of the mechanism.
        name: String,
        /// What could be driven.
        could: String,
    },
    /// No joint but balls can be a drive.
    #[error("{name} has no joint that moves about or along an axis of its own; {could}")]
    Still {
        /// Name of the mechanism.
        name: String,
        /// What could be driven.
        could: String,
    },
    /// A coordinate has no value.
    #[error(transparent)]
    Exact(#[from] ExactError),
}

/// A stroke that is asked for.
#[derive(Debug)]
pub struct AskedStroke<'a> {
    mechanism: &'a Mechanism,
    state: StateId,
    verdict: &'a RankVerdict,
    tolerance: Option<f64>,
    range: loads::Stroke,
    pose: Pose,
    drive: usize,
    held: Vec<usize>,
}

/// Whether a column is of a ball, whose axes are those of the file's frame and nobody's choice.
fn of_ball(pose: &Pose, column: usize) -> bool {
    let of = pose.columns[column].joint;
    let own = pose.columns.iter().filter(|c| c.joint == of);
    own.filter(|c| c.freedom.turns()).count() == 3
}

/// The columns, with the names they are driven by.
fn names(m: &Mechanism, pose: &Pose) -> Vec<(usize, String)> {
    let of = |j: JointId| pose.columns.iter().filter(move |c| c.joint == j);
    let columns = pose.columns.iter().enumerate();
    columns
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

impl<'a> AskedStroke<'a> {
    /// What a range, as it was written and read, and the joint named as the drive ask of the mechanism that a verdict is about.
    ///
    /// # Units
    /// Radians, or the file's unit of length, from the pose of the file.
    ///
    /// # Errors
    /// Where the mechanism has no such drive, or which mechanism is meant is not decided.
    pub fn new(
        m: &'a Mechanism,
        state: StateId,
        text: &str,
        range: loads::Stroke,
        named: Option<&str>,
        verdict: &'a RankVerdict,
        tolerance: Option<f64>,
    ) -> Result<AskedStroke<'a>, AskedError> {
        if !verdict.is_decided() {
            let why = verdict.undecided();
            let name = m.name.clone();
            return Err(AskedError::Undecided { name, why });
        }
        let m = verdict.mechanism().unwrap_or(m);
        let pose = Pose::of_file(m, state)?;
        let (drive, held) = drive(m, &pose, state, named)?;
        let slide = slides(&pose, drive);
        lengths_where_it_slides(m, slide, text)?;
        let far = 1e3 * if slide { pose.length } else { 1.0 };
        if range.steps > MOST || range.from.abs() > far || range.to.abs() > far {
            return Err(AskedError::Far(far));
        }
        Ok(AskedStroke {
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

    /// The mechanism that is meant, and the state.
    #[must_use]
    pub fn subject(&self) -> (&'a Mechanism, StateId) {
        (self.mechanism, self.state)
    }

    /// The drive by name, and whether it slides.
    #[must_use]
    pub fn drive(&self) -> (String, bool) {
        let name = name_of(self.mechanism, &self.pose, self.drive);
        (name, slides(&self.pose, self.drive))
    }

    /// From and to.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        [self.range.from, self.range.to]
    }

    /// Goes there.
    #[must_use]
    pub fn follow(&self) -> StrokeFigures {
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
            range: self.range(),
            steps: self.range.steps,
            tolerance,
        };
        stroke(&request, &pose)
    }
}

/// The joint and the freedom of a name such as `joint:rz`; without a freedom where all of it is a joint's name, or no joint has
/// the first part.
fn joint_and_freedom<'n>(m: &Mechanism, name: &'n str) -> (&'n str, Option<&'n str>) {
    match (m.joint(name), name.rsplit_once(':')) {
        (None, Some((id, freedom))) if m.joint(id).is_some() => (id, Some(freedom)),
        _ => (name, None),
    }
}

/// The column that moves and those that are held.
fn drive(
    m: &Mechanism,
    pose: &Pose,
    state: StateId,
    asked: Option<&str>,
) -> Result<(usize, Vec<usize>), AskedError> {
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
            [] => Err(AskedError::NoFreedom {
                joint: m.joints[joint].id.clone(),
                freedom: freedom.map_or_else(String::new, |f| format!(" {f}")),
                state: m.states[state].clone(),
                could: could(m, pose, &names),
            }),
            _ => Err(AskedError::Several {
                joint: m.joints[joint].id.clone(),
                names: of.iter().map(|(_, n)| n.clone()).collect(),
            }),
        }
    };
    let chosen = match asked {
        Some(name) => {
            let (id, freedom) = joint_and_freedom(m, name);
            let joint = m.joint(id).ok_or_else(|| AskedError::NoJoint {
                name: name.to_owned(),
                could: could(m, pose, &names),
            })?;
            column(joint, freedom)?
        }
        None => {
            let mut driving = m.joints_in(state).filter(|&j| driven(j));
            let joint = driving.next().ok_or_else(|| AskedError::NoDrive {
                name: m.name.clone(),
                could: could(m, pose, &names),
            })?;
            column(joint, m.joints[joint].drive_freedom.map(Freedom::name))?
        }
    };
    let own = pose.columns[chosen].joint;
    let held = (0..pose.columns.len())
        .filter(|&c| {
            let column = &pose.columns[c];
            column.joint != own && m.joints[column.joint].drives(column.freedom)
        })
        .filter(|_| driven(own))
        .collect();
    Ok((chosen, held))
}

/// The column named, or the drive, or, where there is none, the first that can move and is not of a ball; and those that are held.
///
/// # Errors
/// Where there is no such column, or nothing but balls can move.
pub fn drive_or_any(
    m: &Mechanism,
    pose: &Pose,
    state: StateId,
    asked: Option<&str>,
) -> Result<(usize, Vec<usize>), AskedError> {
    let driven = m.joints_in(state).any(|j| m.joints[j].drive);
    if asked.is_some() || driven {
        return drive(m, pose, state, asked);
    }
    let mut columns = (0..pose.columns.len()).filter(|&c| !of_ball(pose, c));
    let first = columns.find(|&c| moves(pose, c));
    let first = first.ok_or_else(|| AskedError::Still {
        name: m.name.clone(),
        could: could(m, pose, &names(m, pose)),
    })?;
    Ok((first, Vec::new()))
}

/// Whether a range, as it was written, is in lengths where the drive slides.
///
/// # Errors
/// Where it is in angles.
pub fn lengths_where_it_slides(m: &Mechanism, slides: bool, text: &str) -> Result<(), AskedError> {
    let wrong = slides && (text.contains("deg") || text.contains("rad"));
    let angles = || AskedError::Angles {
        range: text.to_owned(),
        unit: m.length_unit.symbol,
    };
    if wrong { Err(angles()) } else { Ok(()) }
}

/// The name of a column as a drive.
#[must_use]
pub fn name_of(m: &Mechanism, pose: &Pose, column: usize) -> String {
    let mut names = names(m, pose).into_iter();
    names
        .find(|(c, _)| *c == column)
        .map_or_else(String::new, |(_, n)| n)
}

/// Whether a column can move in a pose.
fn moves(pose: &Pose, column: usize) -> bool {
    Follower::new(pose.clone(), column, &[]).share() > 1e-6
}

/// Which joints could be drives in this pose; balls last.
fn could(m: &Mechanism, pose: &Pose, names: &[(usize, String)]) -> String {
    let kinds =
        [false, true].map(|ball| names.iter().filter(move |(c, _)| of_ball(pose, *c) == ball));
    let moving = kinds.into_iter().flatten().filter(|(c, _)| moves(pose, *c));
    let list = moving.map(|(_, n)| n).take(30).join(", ");
    if list.is_empty() {
        format!("none can move in {}", m.name)
    } else {
        format!("these can move: {list}")
    }
}
