//! A stroke as JSON, as a table and as a chart.

use crate::chart::{Axis, Chart, Scale, Series, Style};
use crate::format::number::decimals;
use crate::format::phrase::plural;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::along_stroke::{Change, StrokeFigures};
use crate::view::layout::table;
use itertools::Itertools;
use serde_json::{Value, json};
use std::fmt::Write;

/// What is shown.
#[derive(Debug, Clone, Copy)]
pub struct Shown<'a> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// The state.
    pub state: StateId,
    /// Name of the drive.
    pub drive: &'a str,
    /// Whether it slides: positions are in the file's length unit then, else in radians.
    pub slides: bool,
    /// From and to, as asked for.
    pub range: [f64; 2],
    /// What was found.
    pub figures: &'a StrokeFigures,
}

impl Shown<'_> {
    fn unit(&self) -> &'static str {
        if self.slides {
            self.mechanism.length_unit.symbol
        } else {
            "rad"
        }
    }

    /// A position for people: degrees, or the file's length unit.
    fn place(&self, at: f64, digits: usize) -> String {
        if self.slides {
            format!("{} {}", decimals(at, digits), self.unit())
        } else {
            format!("{}°", decimals(at.to_degrees(), digits))
        }
    }
}

/// The stroke as JSON; positions in radians or the file's length unit.
#[must_use]
pub fn json(s: &Shown<'_>) -> Value {
    let f = s.figures;
    let poses = f.poses.iter().map(|p| {
        let outputs = p.outputs.iter().map(|o| {
            json!({
                "link": s.mechanism.links[o.link].id,
                "point": o.point,
                "turn": o.turn,
            })
        });
        json!({
            "at": p.at,
            "rank": p.rank.rank,
            "mobility": p.mobility,
            "redundant": p.redundant,
            "conditioning": p.rank.kept,
            "largest_dropped": p.rank.dropped,
            "drive_share": p.share,
            "gap": p.gap,
            "outputs": outputs.collect::<Vec<_>>(),
        })
    });
    let changes = f.changes.iter().map(|c| {
        json!({
            "from": c.between[0],
            "to": c.between[1],
            "rank_before": c.ranks[0],
            "rank": c.ranks[1],
            "rank_after": c.ranks[2],
        })
    });
    json!({
        "state": s.mechanism.states[s.state],
        "drive": s.drive,
        "unit": s.unit(),
        "from": s.range[0],
        "to": s.range[1],
        "poses": poses.collect::<Vec<_>>(),
        "changes": changes.collect::<Vec<_>>(),
        "undriven": f.undriven,
        "stop": f.stop.map(|x| json!({
            "at": x.at, "why": x.why.word(), "text": x.why.to_string(),
        })),
    })
}

fn change(s: &Shown<'_>, c: &Change) -> String {
    let middle = s.place(f64::midpoint(c.between[0], c.between[1]), 5);
    let [before, at, after] = c.ranks;
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
pub fn text(s: &Shown<'_>, width: Option<u16>) -> String {
    let f = s.figures;
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(
        out,
        "{}, state {}, over a stroke of {} from {} to {}:\n",
        s.mechanism.name,
        s.mechanism.states[s.state],
        s.drive,
        s.place(s.range[0], 3),
        s.place(s.range[1], 3)
    );
    // Each change stands at the first pose that is not before it.
    let ahead = (s.range[1] - s.range[0]).signum();
    let mut changes = f.changes.iter().peekable();
    let rows = f.poses.iter().map(|p| {
        let here = changes.peeking_take_while(|c| c.between[0] * ahead <= p.at * ahead);
        let flag = here
            .map(|c| {
                let at = s.place(f64::midpoint(c.between[0], c.between[1]), 4);
                format!("rank {} at {at}", c.ranks[1])
            })
            .join(", ");
        let mut outputs = p.outputs.iter().map(|o| {
            format!(
                "{}: ({}), {}°",
                s.mechanism.links[o.link].id,
                o.point.iter().map(|x| decimals(*x, 3)).join(", "),
                decimals(o.turn.to_degrees(), 2)
            )
        });
        vec![
            s.place(p.at, 3),
            p.rank.rank.to_string(),
            p.mobility.to_string(),
            p.redundant.to_string(),
            format!("{:.2e}", p.rank.kept),
            format!("{:.2e}", p.share),
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
    let _ = writeln!(out, "{}\n", table(&header, rows.collect(), width));
    for c in &f.changes {
        let _ = writeln!(out, "  {}", change(s, c));
    }
    if f.changes.is_empty() && !f.poses.is_empty() {
        let _ = writeln!(out, "  the rank does not change on the way");
    }
    if f.undriven > 0 {
        let _ = writeln!(
            out,
            "  {} of the outputs follow{} no drive: the way shown is the one of least motion",
            plural(f.undriven, "motion"),
            if f.undriven == 1 { "s" } else { "" }
        );
    }
    if let Some(stop) = &f.stop {
        let _ = writeln!(out, "  stops at {}: {}", s.place(stop.at, 5), stop.why);
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
pub fn chart(s: &Shown<'_>) -> Chart {
    let f = s.figures;
    let x = |at: f64| if s.slides { at } else { at.to_degrees() };
    let series = |name: &str, style, y: &dyn Fn(usize) -> f64| Series {
        name: name.to_owned(),
        points: (0..f.poses.len())
            .map(|i| (x(f.poses[i].at), y(i)))
            .collect(),
        style,
    };
    let places = f
        .changes
        .iter()
        .map(|c| s.place(f64::midpoint(c.between[0], c.between[1]), 3));
    let changes = if f.changes.is_empty() {
        "The rank does not change on the way".to_owned()
    } else {
        format!("The rank changes at {}", places.take(6).join(", "))
    };
    let stop = f
        .stop
        .map_or_else(String::new, |x| format!("; stops at {}", s.place(x.at, 3)));
    Chart {
        title: format!("{}: conditioning over the stroke", s.mechanism.name),
        subtitle: changes + &stop,
        x: Axis {
            label: format!("{}, {}", s.drive, if s.slides { s.unit() } else { "°" }),
            scale: Scale::Linear,
        },
        y: Axis {
            label: "smallest kept singular value over the largest; drive share".to_owned(),
            scale: Scale::Log,
        },
        series: vec![
            series("conditioning", Style::Line, &|i| f.poses[i].rank.kept),
            series("drive share", Style::Dashed, &|i| f.poses[i].share),
        ],
    }
}
