//! A stroke as JSON, as a table and as a chart.

use crate::chart::{Axis, Chart, Scale, Series, Style};
use crate::format::{decimals, plural};
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::stroke::analysis::StrokeFigures;
use crate::rank::stroke::request::AskedStroke;
use crate::view::terminal::layout::table;
use itertools::Itertools;
use serde::Serialize;
use std::fmt::Write;

/// The figures over a stroke; positions in radians or, where the drive slides, in the file's length unit.
#[derive(Debug, Serialize)]
pub struct StrokeData<'a> {
    #[serde(skip)]
    mechanism: &'a str,
    /// The state.
    pub state: &'a str,
    /// Name of the drive.
    pub drive: String,
    /// "rad", or the file's length unit.
    pub unit: &'static str,
    /// From, as asked for.
    pub from: f64,
    /// To, as asked for.
    pub to: f64,
    /// The poses reached.
    pub poses: Vec<PoseData<'a>>,
    /// Where the rank changes.
    pub changes: Vec<RankChangeData>,
    /// Output motions that no drive decides.
    pub undriven: usize,
    /// The end of the way, where it comes before the last pose asked for.
    pub stop: Option<StrokeEnd>,
}

/// The figures of one pose; see [`crate::rank::stroke::analysis::PoseFigures`].
#[derive(Debug, Serialize)]
#[allow(missing_docs, reason = "named as there")]
pub struct PoseData<'a> {
    pub at: f64,
    pub rank: usize,
    pub mobility: usize,
    pub redundant: usize,
    pub conditioning: f64,
    pub largest_dropped: f64,
    pub drive_share: f64,
    pub gap: f64,
    pub outputs: Vec<OutputPose<'a>>,
}

/// Where an output link is.
#[derive(Debug, Serialize)]
pub struct OutputPose<'a> {
    /// The link.
    pub link: &'a str,
    /// The middle of its joints, in the file's length unit.
    pub point: [f64; 3],
    /// The angle of its turn since the pose of the file `[rad]`.
    pub turn: f64,
}

/// A change of the rank, somewhere between two positions.
#[derive(Debug, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct RankChangeData {
    pub from: f64,
    pub to: f64,
    pub rank_before: usize,
    pub rank: usize,
    pub rank_after: usize,
}

/// Where and why a stroke ends early.
#[derive(Debug, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct StrokeEnd {
    pub at: f64,
    pub why: &'static str,
    pub text: String,
}

impl<'a> StrokeData<'a> {
    /// Follows a stroke that is asked for, and says what was found.
    #[must_use]
    pub fn of(asked: &AskedStroke<'a>) -> StrokeData<'a> {
        let (m, state) = asked.subject();
        let (drive, slides) = asked.drive();
        StrokeData::new(m, state, drive, slides, asked.range(), &asked.follow())
    }

    /// What was found of a drive of this name, which slides or turns, over a range.
    #[must_use]
    pub fn new(
        m: &'a Mechanism,
        state: StateId,
        drive: String,
        slides: bool,
        [from, to]: [f64; 2],
        found: &StrokeFigures,
    ) -> StrokeData<'a> {
        let outputs = |p: &crate::rank::stroke::analysis::PoseFigures| {
            let one = |o: &crate::rank::stroke::analysis::Output| OutputPose {
                link: &m.links[o.link].id,
                point: o.point,
                turn: o.turn,
            };
            p.outputs.iter().map(one).collect()
        };
        let poses = found.poses.iter().map(|p| PoseData {
            at: p.at,
            rank: p.rank.rank,
            mobility: p.mobility,
            redundant: p.redundant,
            conditioning: p.rank.kept,
            largest_dropped: p.rank.dropped,
            drive_share: p.share,
            gap: p.gap,
            outputs: outputs(p),
        });
        let changes = found.changes.iter().map(|c| RankChangeData {
            from: c.between[0],
            to: c.between[1],
            rank_before: c.ranks[0],
            rank: c.ranks[1],
            rank_after: c.ranks[2],
        });
        StrokeData {
            mechanism: &m.name,
            state: &m.states[state],
            drive,
            unit: if slides { m.length_unit.symbol } else { "rad" },
            from,
            to,
            poses: poses.collect(),
            changes: changes.collect(),
            undriven: found.undriven,
            stop: found.stop.map(|x| StrokeEnd {
                at: x.at,
                why: x.why.word(),
                text: x.why.to_string(),
            }),
        }
    }

    fn turns(&self) -> bool {
        self.unit == "rad"
    }

    /// A position for people: degrees, or the file's length unit.
    fn place(&self, at: f64, digits: usize) -> String {
        if self.turns() {
            format!("{}°", decimals(at.to_degrees(), digits))
        } else {
            format!("{} {}", decimals(at, digits), self.unit)
        }
    }

    fn told(&self, c: &RankChangeData) -> String {
        let middle = self.place(c.middle(), 5);
        let (before, at, after) = (c.rank_before, c.rank, c.rank_after);
        if before == after {
            format!(
                "at {middle} alone the rank is {at} instead of {before}, so W and σ are {} more there",
                before.saturating_sub(at)
            )
        } else {
            format!("at {middle} the rank changes from {before} to {after}")
        }
    }

    /// The stroke for people: one row a pose.
    #[must_use]
    pub fn text(&self, width: Option<u16>) -> String {
        let mut out = String::new();
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "{}, state {}, over a stroke of {} from {} to {}:\n",
            self.mechanism,
            self.state,
            self.drive,
            self.place(self.from, 3),
            self.place(self.to, 3)
        );
        let _ = writeln!(out, "{}\n", self.pose_table(width));
        out += &self.remarks();
        out
    }

    /// A row for each pose.
    fn pose_table(&self, width: Option<u16>) -> String {
        // Each change stands at the first pose that is not before it.
        let ahead = (self.to - self.from).signum();
        let mut changes = self.changes.iter().peekable();
        let rows = self.poses.iter().map(|p| {
            let here = changes.peeking_take_while(|c| c.from * ahead <= p.at * ahead);
            let flag = here
                .map(|c| {
                    let at = self.place(c.middle(), 4);
                    format!("rank {} at {at}", c.rank)
                })
                .join(", ");
            let mut outputs = p.outputs.iter().map(|o| {
                format!(
                    "{}: ({}), {}°",
                    o.link,
                    o.point.iter().map(|x| decimals(*x, 3)).join(", "),
                    decimals(o.turn.to_degrees(), 2)
                )
            });
            vec![
                self.place(p.at, 3),
                p.rank.to_string(),
                p.mobility.to_string(),
                p.redundant.to_string(),
                format!("{:.2e}", p.conditioning),
                format!("{:.2e}", p.drive_share),
                outputs.join("; "),
                flag,
            ]
        });
        let header = [
            "drive",
            "rank",
            "W",
            "σ",
            "conditioning",
            "drive share",
            "outputs: middle, turn",
            "",
        ];
        table(&header, rows.collect(), width)
    }

    /// Where the rank changes, what no drive decides, and why the way ends early.
    fn remarks(&self) -> String {
        let mut out = String::new();
        // Writing to a string cannot fail.
        for c in &self.changes {
            let _ = writeln!(out, "  {}", self.told(c));
        }
        if self.changes.is_empty() && !self.poses.is_empty() {
            let _ = writeln!(
                out,
                "  no change of the rank was found on the way, at the poses and between them"
            );
        }
        if self.undriven > 0 {
            let _ = writeln!(
                out,
                "  {} of the outputs follow{} no drive: the way shown is the one of least motion",
                plural(self.undriven, "motion"),
                if self.undriven == 1 { "s" } else { "" }
            );
        }
        if let Some(stop) = &self.stop {
            let _ = writeln!(out, "  stops at {}: {}", self.place(stop.at, 5), stop.text);
        }
        let _ = writeln!(
            out,
            "  conditioning: smallest kept singular value of J over the largest; drive share: of the drive in the motion of \
         unit length, 0 at its dead points"
        );
        out
    }

    /// Conditioning over the stroke.
    #[must_use]
    pub fn chart(&self) -> Chart {
        let x = |at: f64| if self.turns() { at.to_degrees() } else { at };
        let series = |name: &str, style, y: &dyn Fn(usize) -> f64| Series {
            name: name.to_owned(),
            points: (0..self.poses.len())
                .map(|i| (x(self.poses[i].at), y(i)))
                .collect(),
            style,
        };
        let places = self.changes.iter().map(|c| self.place(c.middle(), 3));
        let changes = if self.changes.is_empty() {
            "No change of the rank was found on the way, at the poses and between them".to_owned()
        } else {
            format!("The rank changes at {}", places.take(6).join(", "))
        };
        let stop = self.stop.as_ref().map_or_else(String::new, |x| {
            format!("; stops at {}", self.place(x.at, 3))
        });
        Chart {
            title: format!("{}: conditioning over the stroke", self.mechanism),
            subtitle: changes + &stop,
            x: Axis {
                label: format!(
                    "{}, {}",
                    self.drive,
                    if self.turns() { "°" } else { self.unit }
                ),
                scale: Scale::Linear,
            },
            y: Axis {
                label: "smallest kept singular value over the largest; drive share".to_owned(),
                scale: Scale::Log,
            },
            series: vec![
                series("conditioning", Style::Line, &|i| self.poses[i].conditioning),
                series("drive share", Style::Dashed, &|i| self.poses[i].drive_share),
            ],
        }
    }
}

impl RankChangeData {
    fn middle(&self) -> f64 {
        f64::midpoint(self.from, self.to)
    }
}
