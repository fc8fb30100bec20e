//! A stroke as JSON, as a table and as a chart.

use crate::format::decimals;
use crate::motion::follow::Stop;
use crate::rank::stroke::analysis::{
    Output, PoseFigures, RankChange, StrokeFigures, StrokeRequest,
};
use crate::view::prelude::*;

/// The figures over a stroke; positions in radians or, where the drive slides, in the file's length unit.
#[derive(Debug)]
pub struct StrokeData<'a> {
    mechanism: &'a Mechanism,
    state: &'a str,
    /// Name of the drive.
    drive: String,
    /// "rad", or the file's length unit.
    unit: &'static str,
    /// From and to, as asked for.
    range: [f64; 2],
    found: StrokeFigures,
}

impl<'a> StrokeData<'a> {
    /// Follows a stroke that is asked for, and says what was found.
    pub fn follow_stroke(asked: &StrokeRequest<'a>) -> StrokeData<'a> {
        let (m, state) = (asked.mechanism, asked.state);
        let (drive, slides) = asked.drive_name();
        StrokeData {
            mechanism: m,
            state: &m.states[state],
            drive,
            unit: if slides { m.length_unit.symbol } else { "rad" },
            range: asked.range,
            found: asked.follow_stroke(),
        }
    }

    /// Returns whether the way ends before the last pose asked for.
    pub fn stops(&self) -> bool {
        self.found.stop.is_some()
    }

    /// Returns all of it as data. An output is where the middle of its joints is, in the file's length unit, and by what it has turned
    /// since the pose of the file `[rad]`.
    pub fn json(&self) -> Value {
        let found = &self.found;
        let output = |o: &Output| {
            let link = &self.mechanism.links[o.link].id;
            json!({ "link": link, "point": o.point, "turn": o.turn })
        };
        let pose = |p: &PoseFigures| {
            json!({
                "at": p.at,
                "rank": p.rank.rank,
                "mobility": p.mobility,
                "redundant": p.redundant,
                "conditioning": p.rank.kept,
                "largest_dropped": p.rank.dropped,
                "drive_share": p.share,
                "gap": p.gap,
                "outputs": p.outputs.iter().map(output).collect::<Value>(),
            })
        };
        let change = |c: &RankChange| {
            let ([from, to], [before, rank, after]) = (c.between, c.ranks);
            json!({ "from": from, "to": to, "rank_before": before, "rank": rank, "rank_after": after })
        };
        let stop =
            |x: Stop| json!({ "at": x.at, "why": x.why.as_word(), "text": x.why.to_string() });
        json!({
            "state": self.state,
            "drive": self.drive,
            "unit": self.unit,
            "from": self.range[0],
            "to": self.range[1],
            "poses": found.poses.iter().map(pose).collect::<Value>(),
            "changes": found.changes.iter().map(change).collect::<Value>(),
            "undriven": found.undriven,
            "stop": found.stop.map(stop),
        })
    }

    fn drive_turns(&self) -> bool {
        self.unit == "rad"
    }

    /// Returns a position for people: degrees, or the file's length unit.
    fn format_place(&self, at: f64, digits: usize) -> String {
        if self.drive_turns() {
            format!("{}°", decimals(at.to_degrees(), digits))
        } else {
            format!("{} {}", decimals(at, digits), self.unit)
        }
    }

    fn describe_change(&self, c: &RankChange) -> String {
        let (middle, [before, at, after]) = (self.format_place(middle_of(c), 5), c.ranks);
        if before == after {
            format!(
                "at {middle} alone the rank is {at} instead of {before}, so W and σ are {} more there",
                before.saturating_sub(at)
            )
        } else {
            format!("at {middle} the rank changes from {before} to {after}")
        }
    }

    /// Returns the stroke for people: one row a pose, where the rank changes, what no drive decides, and why the way ends early.
    pub fn text(&self, width: Option<u16>) -> String {
        let (found, mut out) = (&self.found, Report::new(None));
        let [from, to] = self.range.map(|at| self.format_place(at, 3));
        out.add_line(format!(
            "{}, state {}, over a stroke of {} from {from} to {to}:\n",
            self.mechanism.name, self.state, self.drive
        ));
        out.add_line(self.pose_table(width) + "\n");
        for c in &found.changes {
            out.add_line(format!("  {}", self.describe_change(c)));
        }
        if found.changes.is_empty() && !found.poses.is_empty() {
            out.add_line(
                "  no change of the rank was found on the way, at the poses and between them",
            );
        }
        if found.undriven > 0 {
            let (motions, s) = (
                count_noun(found.undriven, "motion"),
                if found.undriven == 1 { "s" } else { "" },
            );
            out.add_line(format!(
                "  {motions} of the outputs follow{s} no drive: the way shown is the one of least motion"
            ));
        }
        if let Some(stop) = &found.stop {
            out.add_line(format!(
                "  stops at {}: {}",
                self.format_place(stop.at, 5),
                stop.why
            ));
        }
        out.add_line(
            "  conditioning: smallest kept singular value of J over the largest; drive share: of the drive in the motion of \
             unit length, 0 at its dead points",
        );
        out.text()
    }

    /// Returns a row for each pose.
    fn pose_table(&self, width: Option<u16>) -> String {
        // Each change stands at the first pose that is not before it.
        let ahead = (self.range[1] - self.range[0]).signum();
        let mut changes = self.found.changes.iter().peekable();
        let rows = self.found.poses.iter().map(|p| {
            let here = changes.peeking_take_while(|c| c.between[0] * ahead <= p.at * ahead);
            let flag = |c: &RankChange| {
                format!(
                    "rank {} at {}",
                    c.ranks[1],
                    self.format_place(middle_of(c), 4)
                )
            };
            let flags = here.map(flag).join(", ");
            let output = |o: &Output| {
                let link = &self.mechanism.links[o.link].id;
                let point = o.point.iter().map(|x| decimals(*x, 3)).join(", ");
                format!("{link}: ({point}), {}°", decimals(o.turn.to_degrees(), 2))
            };
            let outputs = p.outputs.iter().map(output).join("; ");
            let [kept, share] = [p.rank.kept, p.share].map(|x| format!("{x:.2e}"));
            let (at, r) = (self.format_place(p.at, 3), p.rank.rank);
            row_cells([
                &at,
                &r,
                &p.mobility,
                &p.redundant,
                &kept,
                &share,
                &outputs,
                &flags,
            ])
        });
        let heads = "drive | rank | W | σ | conditioning | drive share | outputs: middle, turn | ";
        text_table(heads, rows, width)
    }

    /// Returns the chart of conditioning over the stroke.
    pub fn chart(&self) -> Chart {
        let x = |at: f64| {
            if self.drive_turns() {
                at.to_degrees()
            } else {
                at
            }
        };
        let series = |name: &str, style, y: &dyn Fn(usize) -> f64| Series {
            name: name.to_owned(),
            points: (0..self.found.poses.len())
                .map(|i| (x(self.found.poses[i].at), y(i)))
                .collect(),
            style,
        };
        let unit = if self.drive_turns() { "°" } else { self.unit };
        let places = self
            .found
            .changes
            .iter()
            .map(|c| self.format_place(middle_of(c), 3));
        let changes = if self.found.changes.is_empty() {
            "No change of the rank was found on the way, at the poses and between them".to_owned()
        } else {
            format!("The rank changes at {}", places.take(6).join(", "))
        };
        let stop = self.found.stop.as_ref().map_or_else(String::new, |x| {
            format!("; stops at {}", self.format_place(x.at, 3))
        });
        Chart {
            title: format!("{}: conditioning over the stroke", self.mechanism.name),
            subtitle: changes + &stop,
            x: Axis::linear(format!("{}, {unit}", self.drive)),
            y: Axis {
                label: "smallest kept singular value over the largest; drive share".to_owned(),
                scale: Scale::Log,
            },
            series: vec![
                series("conditioning", Style::Line, &|i| {
                    self.found.poses[i].rank.kept
                }),
                series("drive share", Style::Dashed, &|i| self.found.poses[i].share),
            ],
        }
    }
}

fn middle_of(c: &RankChange) -> f64 {
    f64::midpoint(c.between[0], c.between[1])
}
