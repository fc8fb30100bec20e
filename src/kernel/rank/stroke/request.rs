//! A stroke as requested by the user: the column that moves, the columns held, and the accuracy of following.

use crate::closure::drive::driven_freedoms;
use crate::geom::exact::ExactError;
use crate::model::joint_type::Freedom;
use crate::model::loads;
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::motion::follow::{Follower, column_slides, column_unit};
use crate::motion::pose::{FLAT, Pose};
use crate::rank::rounded::verdict::RankVerdict;
use crate::rank::stroke::analysis::StrokeRequest;
use itertools::Itertools;
use std::iter;
use thiserror::Error;

/// Maximum number of steps, since every pose along the path is kept.
const MOST: usize = 10_000;

/// Reason why a mechanism cannot be followed over a stroke.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum AskedError {
    /// It is unknown which mechanism is intended.
    #[error("the motion of {name} over a stroke is unknown: {why}")]
    Undecided {
        /// Name of the mechanism.
        name: String,
        /// The reason.
        why: String,
    },
    /// The range is in angles, but the drive slides.
    #[error(
        "the stroke {range:?} is in angles, but the drive slides; give lengths in the file's unit, {unit}"
    )]
    Angles {
        /// The range.
        range: String,
        /// Symbol of the unit.
        unit: &'static str,
    },
    /// The range is too long, or has too many steps.
    #[error("a stroke is limited to {MOST} steps and {0:.0} radians or length units")]
    Far(f64),
    /// The joint has no such freedom.
    #[error("joint {joint} has no freedom{freedom} that can be driven in state {state}; {could}")]
    NoFreedom {
        /// The joint.
        joint: String,
        /// The freedom, after a space; empty if none was named.
        freedom: String,
        /// The state.
        state: String,
        /// The joints that could be driven.
        could: String,
    },
    /// The joint has several freedoms.
    #[error(
        "joint {joint} has several freedoms; name the driven one: {}", names.join(" or ")
    )]
    Several {
        /// The joint.
        joint: String,
        /// Its freedoms.
        names: Vec<String>,
    },
    /// There is no such joint.
    #[error("there is no joint {name}; {could}")]
    NoJoint {
        /// The given name.
        name: String,
        /// The joints that could be driven.
        could: String,
    },
    /// Nothing is driven.
    #[error("{name} has no drive; name the joint that moves: {could}")]
    NoDrive {
        /// Name of the mechanism.
        name: String,
        /// The joints that could be driven.
        could: String,
    },
    /// A coordinate has no value.
    #[error(transparent)]
    Exact(#[from] ExactError),
}

/// Returns true if a column belongs to a ball, whose axes are those of the file's frame and not a choice of the user.
fn of_ball(pose: &Pose, column: usize) -> bool {
    let of = pose.columns[column].joint;
    let own = pose.columns.iter().filter(|c| c.joint == of);
    own.filter(|c| c.freedom.is_turn()).count() == 3
}

/// Returns the columns, with the names they are driven by.
fn column_names(m: &Mechanism, pose: &Pose) -> Vec<(usize, String)> {
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

impl<'a> StrokeRequest<'a> {
    /// Creates the stroke for the mechanism of a verdict. The range is given as written and as parsed. The joint `named` is
    /// the drive.
    ///
    /// # Units
    /// Radians, or the file's unit of length, from the pose of the file.
    ///
    /// # Errors
    /// Returns an error if the mechanism has no such drive. Also if it is undecided which mechanism is intended.
    ///
    /// # Examples
    /// ```
    /// use ozols::model::{loads::Stroke, mechanism::StateId};
    /// use ozols::rank::{rounded::verdict::rank_verdict, stroke::analysis::StrokeRequest};
    /// let bennett = ozols::built_in("bennett")?;
    /// let verdict = rank_verdict(&bennett, StateId::FREE)?;
    /// let range = Stroke { from: 0.0, to: 1.0, steps: 4 };
    /// let asked = StrokeRequest::new(&bennett, StateId::FREE, "0rad..1rad", range, None, &verdict, None)?;
    /// // It moves throughout, with three redundant constraints in every pose.
    /// assert!(asked.follow_stroke().poses.iter().all(|p| (p.mobility, p.redundant) == (1, 3)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(
        m: &'a Mechanism,
        state: StateId,
        text: &str,
        range: loads::Stroke,
        named: Option<&str>,
        verdict: &'a RankVerdict,
        mut tolerance: Option<f64>,
    ) -> Result<StrokeRequest<'a>, AskedError> {
        if !verdict.is_decided() {
            let why = verdict.explain_undecided();
            let name = m.name.clone();
            return Err(AskedError::Undecided { name, why });
        }
        let m = verdict.intended_mechanism().unwrap_or(m);
        let mut pose = Pose::of_file(m, state)?;
        let (drive, held) = find_drive(m, &pose, state, named)?;
        let slide = column_slides(&pose, drive);
        lengths_where_it_slides(m, slide, text)?;
        let far = 1e3 * column_unit(&pose, drive);
        if range.steps > MOST || range.from.abs() > far || range.to.abs() > far {
            return Err(AskedError::Far(far));
        }
        // Contours with rounded coordinates close only within the rounding.
        let measured = verdict.rounded.as_ref().is_some_and(|r| r.digits.is_some());
        let rounded = measured || !verdict.is_as_written();
        if let (true, Some(n)) = (rounded, verdict.numeric) {
            pose = pose.with_accuracy((10.0 * n.dropped).clamp(1e-16, verdict.tolerance));
            tolerance = Some(verdict.tolerance.max(FLAT));
        } else if let Some(t) = tolerance {
            // Singular values below a hundred times the accuracy count as zero along the path.
            pose = pose.with_accuracy(t / 100.0);
        }
        Ok(StrokeRequest {
            mechanism: m,
            state,
            pose,
            drive,
            held,
            range: [range.from, range.to],
            steps: range.steps,
            tolerance,
        })
    }

    /// Returns the name of the drive, and whether it slides.
    #[must_use]
    pub fn drive_name(&self) -> (String, bool) {
        let name = name_of(self.mechanism, &self.pose, self.drive);
        (name, column_slides(&self.pose, self.drive))
    }
}

/// Splits a name such as `joint:rz` into joint and freedom. The freedom is `None` if the whole is a joint's name, or if
/// no joint has the first part as its name.
fn joint_and_freedom<'n>(m: &Mechanism, name: &'n str) -> (&'n str, Option<&'n str>) {
    match (m.joint_named(name), name.rsplit_once(':')) {
        (None, Some((id, freedom))) if m.joint_named(id).is_some() => (id, Some(freedom)),
        _ => (name, None),
    }
}

/// Returns the column that moves and those that are held.
fn find_drive(
    m: &Mechanism,
    pose: &Pose,
    state: StateId,
    asked: Option<&str>,
) -> Result<(usize, Vec<usize>), AskedError> {
    let names = column_names(m, pose);
    let drives = driven_freedoms(m, state);
    let column = |joint: JointId, freedom: Option<&str>| {
        let mut of: Vec<_> = names
            .iter()
            .filter(|(c, _)| pose.columns[*c].joint == joint)
            .filter(|(c, _)| freedom.is_none_or(|f| pose.columns[*c].freedom.name() == f))
            .collect();
        if of.len() > 1 {
            of.retain(|(c, _)| column_moves(pose, *c));
        }
        match of[..] {
            [(c, _)] => Ok(*c),
            [] => Err(AskedError::NoFreedom {
                joint: m.joints[joint].id.clone(),
                freedom: freedom.map_or_else(String::new, |f| format!(" {f}")),
                state: m.states[state].clone(),
                could: describe_choices(m, pose, &names),
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
            let joint = m.joint_named(id).ok_or_else(|| AskedError::NoJoint {
                name: name.to_owned(),
                could: describe_choices(m, pose, &names),
            })?;
            column(joint, freedom)?
        }
        None => {
            let mut driven = m.joints_in(state).filter(|&j| m.joints[j].drive);
            let joint = driven.next().ok_or_else(|| AskedError::NoDrive {
                name: m.name.clone(),
                could: describe_choices(m, pose, &names),
            })?;
            // A drive that cannot move in the plane has none of the driven freedoms.
            let moved = drives.iter().find(|(j, _)| *j == joint).map(|d| d.1);
            let freedom = moved.or(m.joints[joint].drive_freedom);
            column(joint, freedom.map(Freedom::name))?
        }
    };
    let own = pose.columns[chosen].joint;
    let held = (0..pose.columns.len())
        .filter(|&c| {
            let column = &pose.columns[c];
            column.joint != own && drives.contains(&(column.joint, column.freedom))
        })
        .filter(|_| m.joints[own].drive)
        .collect();
    Ok((chosen, held))
}

/// A column that moves, and those that are held.
pub type Moved = (usize, Vec<usize>);

/// Returns the named column or the drive, with the columns that are held. If there is neither, returns all columns that can move,
/// those of balls last: in a singular pose, one that can move at first may go nowhere. A column is examined when it is asked for.
///
/// # Errors
/// Returns an error if there is no such column.
pub fn drive_or_any<'p>(
    m: &Mechanism,
    pose: &'p Pose,
    state: StateId,
    asked: Option<&str>,
) -> Result<Box<dyn Iterator<Item = Moved> + 'p>, AskedError> {
    let driven = m.joints_in(state).any(|j| m.joints[j].drive);
    if asked.is_none() && !driven {
        let mut free = moving_columns(pose).map(|c| (c, Vec::new())).peekable();
        if free.peek().is_some() {
            return Ok(Box::new(free));
        }
    }
    Ok(Box::new(iter::once(find_drive(m, pose, state, asked)?)))
}

/// Checks that a range, as written, is in lengths if the drive slides.
///
/// # Errors
/// Returns an error if the range is in angles.
pub fn lengths_where_it_slides(m: &Mechanism, slides: bool, text: &str) -> Result<(), AskedError> {
    let wrong = slides && (text.contains("deg") || text.contains("rad"));
    let angles = || AskedError::Angles {
        range: text.to_owned(),
        unit: m.length_unit.symbol,
    };
    if wrong { Err(angles()) } else { Ok(()) }
}

/// Returns the name of a column as a drive.
#[must_use]
pub fn name_of(m: &Mechanism, pose: &Pose, column: usize) -> String {
    let mut names = column_names(m, pose).into_iter();
    names
        .find(|(c, _)| *c == column)
        .map_or_else(String::new, |(_, n)| n)
}

/// Returns true if a column can move in a pose.
fn column_moves(pose: &Pose, column: usize) -> bool {
    Follower::new(pose.clone(), column, &[]).drive_share() > 1e-6
}

/// Returns the columns that can move in a pose, with those of balls last.
fn moving_columns(pose: &Pose) -> impl Iterator<Item = usize> {
    let kinds = [false, true].into_iter();
    let columns = kinds
        .flat_map(move |ball| (0..pose.columns.len()).filter(move |&c| of_ball(pose, c) == ball));
    columns.filter(|&c| column_moves(pose, c))
}

/// Describes the joints that could be drives in this pose, with balls last.
fn describe_choices(m: &Mechanism, pose: &Pose, names: &[(usize, String)]) -> String {
    let list = moving_columns(pose)
        .map(|c| &names[c].1)
        .take(30)
        .join(", ");
    if list.is_empty() {
        format!("none can move in {}", m.name)
    } else {
        format!("these can move: {list}")
    }
}
