//! The motion that a moving drawing shows.

pub use crate::draw::Moving;
use crate::file::read::workload::motion::parse_stroke;
use crate::format::decimals;
use crate::model::loads::Stroke;
use crate::model::mechanism::{Mechanism, StateId};
use crate::motion::drive_range::{SLIDE, Way, follow_range as way_of};
use crate::motion::follow::{column_slides, column_unit};
use crate::motion::jaws::jaws_meet;
use crate::motion::pose::Pose;
use crate::rank::stroke::request::{drive_or_any, lengths_where_it_slides, name_of};
use crate::redundancy::analysis::StateAnalysis;
use crate::redundancy::local_mobility::{FAR, animate_idle};
use crate::view::analysis::link_motions;
use crate::view::terminal::next_commands::typed_option;
use anyhow::{Context, ensure};
use std::f64::consts::{PI, TAU};

/// Pictures of a motion where nobody says how many: at 30 a second, 2.4 seconds.
const STEPS: usize = 72;
/// The greatest number of pictures, each of which is part of the file.
const MOST: usize = 600;
/// Most turns that a screw is followed to either side.
const MOST_TURNS: f64 = 50.0;

impl Moving {
    /// Creates the motion of a mechanism's drive, or of the named joint. It covers a range such as "0:90deg:30", or as far
    /// as the drive goes.
    ///
    /// # Examples
    /// ```
    /// use ozols::{model::mechanism::StateId, page::moving::Moving};
    /// let four_bar = ozols::built_in("four-bar")?;
    /// let moving = Moving::new(&four_bar, StateId::FREE, Some("0:90deg:30"), None).expect("it is a crank");
    /// assert!(moving.drive_reach().is_some_and(|[from, to]| from == 0.0 && (to - 1.5708).abs() < 1e-4));
    /// # Ok::<(), ozols::Error>(())
    /// ```
    pub fn new(
        m: &Mechanism,
        state: StateId,
        range: Option<&str>,
        named: Option<&str>,
    ) -> anyhow::Result<Moving> {
        let pose = Pose::of_file(m, state)?;
        let drives = drive_or_any(m, &pose, state, named)?;
        let mut tried =
            drives.map(|drive| Self::along_drive(m, state, pose.clone(), range, named, drive));
        match tried.next().context("nothing can move")? {
            // A range is that of the first.
            Err(why) if range.is_none() => tried.find_map(Result::ok).ok_or(why),
            moved => moved,
        }
    }

    /// Creates the motion of a column, with others held.
    fn along_drive(
        m: &Mechanism,
        state: StateId,
        pose: Pose,
        range: Option<&str>,
        named: Option<&str>,
        (drive, held): (usize, Vec<usize>),
    ) -> anyhow::Result<Moving> {
        let slide = column_slides(&pose, drive);
        let unit = column_unit(&pose, drive);
        let symbol = if slide { m.length_unit.symbol } else { "rad" };
        let asked = stroke_asked(m, slide, range, named)?;
        let steps = asked.map_or(STEPS, |s| s.steps.clamp(2, MOST));
        let far = farthest_drive(&pose, drive);
        // A screw plays the travel of its nut, and not one turn.
        let pitch = screw_pitch(&pose, drive);
        let range = asked.map(|s| [s.from / unit, s.to / unit]);
        let range = range.or_else(|| (pitch != 0.0).then_some([-far, far]));
        let mut way = way_of(&pose, drive, &held, range, steps);
        // Nobody wants to see jaws go through each other.
        let met = match asked {
            None => jaws_meet(m, state, &pose, &way),
            Some(_) => [None, None],
        };
        if met.iter().any(Option::is_some) {
            let [low, high] = met;
            let range = [low.unwrap_or(-far), high.unwrap_or(far)];
            way = way_of(&pose, drive, &held, Some(range), steps);
        }
        let name = name_of(m, &pose, drive);
        let [first, last] = ends_of(&way)
            .filter(|[first, last]| way.at.len() > 1 && (last - first).abs() > 1e-6)
            .with_context(|| format!("{name} cannot move from the pose of the file"))?;
        let words = if way.closed {
            format!("drive {name} makes a full turn")
        } else {
            // A screw is read by its nut.
            let advance = if slide { unit } else { pitch * pose.length };
            let place = |x: f64| {
                if advance != 0.0 {
                    format!("{} {}", decimals(x * advance, 2), m.length_unit.symbol)
                } else {
                    format!("{}°", decimals(x.to_degrees(), 1))
                }
            };
            let (from, to, why) = (place(first), place(last), why_it_ends(&way, met));
            let what = if pitch == 0.0 { "drive" } else { "the nut of" };
            format!("{what} {name} goes from {from} to {to}{why}")
        };
        Ok(Moving {
            pose,
            way,
            words,
            unit: (unit, symbol),
        })
    }

    /// Returns the ends of the drive's range, in radians or the file's length unit.
    pub fn drive_reach(&self) -> Option<[f64; 2]> {
        ends_of(&self.way).map(|ends| ends.map(|x| x * self.unit.0))
    }

    /// Returns the motion back and forth along an idle freedom that the analysis of a state lists, counted from 0.
    pub fn idle_motion(
        m: &Mechanism,
        found: &StateAnalysis,
        state: StateId,
        which: usize,
    ) -> anyhow::Result<Moving> {
        let one = found
            .idle
            .get(which)
            .with_context(|| match found.idle.len() {
                0 => format!("state {} has no idle freedom", found.state),
                n => format!(
                    "state {} has idle freedoms 1 to {n}, in the order of `ozols analyze`",
                    found.state
                ),
            })?;
        let words = link_motions::describe_idle(m, one);
        let wiggle = animate_idle(m, state, &found.idle, which)?
            .with_context(|| format!("no numbers show that {words}"))?;
        let far = decimals(FAR.to_degrees(), 0);
        let far = if one.turns {
            format!(" by {far}° to either side")
        } else {
            " a little".to_owned()
        };
        let open = if wiggle.closed {
            ""
        } else {
            "; to first order only: parts come apart by the second"
        };
        Ok(Moving {
            pose: Pose::of_file(m, state)?,
            way: wiggle.way,
            words: format!("idle freedom {}: {words}{far}{open}", which + 1),
            unit: (1.0, "rad"),
        })
    }

    /// Returns the pose in the file.
    pub(crate) fn still_pose(m: &Mechanism, state: StateId) -> anyhow::Result<Moving> {
        let pose = Pose::of_file(m, state)?;
        let way = Way {
            at: vec![0.0],
            links: vec![pose.links.clone()],
            start: 0,
            closed: false,
            ends: [None, None],
        };
        Ok(Moving {
            pose,
            way,
            words: "the pose of the file".to_owned(),
            unit: (1.0, "rad"),
        })
    }
}

/// Returns the advance of a screw per radian, as a fraction of [`Pose::length`]; 0 for other freedoms.
fn screw_pitch(pose: &Pose, drive: usize) -> f64 {
    let [a, b, c, x, y, z] = pose.columns[drive].twist;
    let pitch = a * x + b * y + c * z;
    // Less than that is rounding.
    let screws = !column_slides(pose, drive) && pitch.abs() > 1e-9;
    if screws { pitch } else { 0.0 }
}

/// Returns how far a drive is followed to either side: half a turn, or until a slide or a nut has gone the size of the mechanism.
fn farthest_drive(pose: &Pose, drive: usize) -> f64 {
    match screw_pitch(pose, drive) {
        _ if column_slides(pose, drive) => SLIDE,
        0.0 => PI,
        pitch => (SLIDE / pitch.abs()).min(MOST_TURNS * TAU),
    }
}

/// Returns the stroke of the drive: the given one or the file's own; `None` if it goes as far as it can.
fn stroke_asked(
    m: &Mechanism,
    slide: bool,
    range: Option<&str>,
    named: Option<&str>,
) -> anyhow::Result<Option<Stroke>> {
    let Some(text) = range else {
        // the file's own is that of its first drive
        return Ok(m.loads.stroke.filter(|_| named.is_none()));
    };
    lengths_where_it_slides(m, slide, text)?;
    let asked = parse_stroke(text)?;
    ensure!(
        (2..=MOST).contains(&asked.steps),
        "{} takes 2 to {MOST} steps for a drawing",
        typed_option("stroke", "")
    );
    Ok(Some(asked))
}

/// Returns the ends of a motion, or `None` if it has no pose.
fn ends_of(way: &Way) -> Option<[f64; 2]> {
    Some([*way.at.first()?, *way.at.last()?])
}

/// Describes what stops the drive at either end of its range, as the end of a sentence. `met` is where jaws meet.
fn why_it_ends(way: &Way, met: [Option<f64>; 2]) -> String {
    let why = |n: usize| match met[n] {
        Some(_) => Some("jaws meet".to_owned()),
        None => way.ends[n].map(|s| s.why.as_word().replace('-', " ")),
    };
    match [why(0), why(1)] {
        [Some(a), Some(b)] if a == b => format!(", {a} at both ends"),
        [a, b] => [(a, "beginning"), (b, "end")]
            .into_iter()
            .filter_map(|(e, at)| e.map(|e| format!(", {e} at the {at}")))
            .collect(),
    }
}
