//! The clamping force along a motion: one value from which text, JSON and a chart are made. SI units.

use crate::chart::{Axis, Chart, Scale, Series, Style};
use crate::format::{plural, significant};
use crate::grip::clamping::HoldVerdict;
use crate::grip::motion::StepTaken as Found;
use crate::model::mechanism::LengthUnit;
use crate::view::terminal::layout::{fit, table};
use serde::Serialize;
use std::fmt::Write;

/// Rows shown before the rest is left out.
const SHOWN: usize = 40;

/// A motion, step by step.
#[derive(Debug, Serialize)]
pub struct GripMotion {
    /// Whether the part can be held at every step.
    pub holds: bool,
    /// The steps.
    pub steps: Vec<ClampingStep>,
    #[serde(skip)]
    unit: LengthUnit,
}

/// A step and the clamping it takes.
#[derive(Debug, Serialize)]
pub struct ClampingStep {
    /// `[s]`, where stated.
    pub time: Option<f64>,
    /// `[m]`
    pub diameter: f64,
    /// Of the gripper `[m/s²]`.
    pub acceleration: [f64; 3],
    /// Gravity less acceleration `[m/s²]`.
    pub pull: [f64; 3],
    /// `can hold`, `slips`, `cannot be held` or `undecided`.
    pub verdict: &'static str,
    /// The least drive moment per lever `[N·m]`.
    pub drive_moment_per_lever: Option<f64>,
    /// No smaller one holds `[N·m]`.
    pub lower_bound: Option<f64>,
    /// What one drive of both levers takes, `[N]` or `[N·m]`.
    pub drive_effort: Option<f64>,
    /// Whether that drive slides.
    #[serde(skip)]
    slides: bool,
}

impl GripMotion {
    /// What was found of a motion.
    #[must_use]
    pub fn new(found: &[Found], unit: LengthUnit) -> Self {
        let step = |s: &Found| {
            let (verdict, bound) = match &s.verdict {
                Some(HoldVerdict::Held(h)) => ("can hold", Some(h.lower_bound)),
                Some(HoldVerdict::Slips(_)) => ("slips", None),
                Some(HoldVerdict::Undecided(_)) => ("undecided", None),
                None => ("cannot be held", None),
            };
            ClampingStep {
                time: s.of.time,
                diameter: s.diameter,
                acceleration: s.of.acceleration,
                pull: s.pull,
                verdict,
                drive_moment_per_lever: s.drive(),
                lower_bound: bound,
                drive_effort: s.effort.map(|e| e.0),
                slides: s.effort.is_some_and(|e| e.1),
            }
        };
        GripMotion {
            holds: found.iter().all(|s| s.drive().is_some()),
            steps: found.iter().map(step).collect(),
            unit,
        }
    }

    /// Whether it can hold, and with what moments.
    fn verdict(&self) -> String {
        let moments = self.steps.iter().filter_map(|s| s.drive_moment_per_lever);
        let least = moments.clone().fold(f64::INFINITY, f64::min);
        let most = moments.fold(0.0, f64::max);
        let lost = self
            .steps
            .iter()
            .filter(|s| s.drive_moment_per_lever.is_none())
            .count();
        match lost {
            0 => format!(
                "can hold at every step, with {} to {} N·m per lever",
                significant(least),
                significant(most)
            ),
            n => format!("CANNOT HOLD at {}", plural(n, "step")),
        }
    }

    /// For people, fitted to a terminal of `width` columns where one is given.
    #[must_use]
    pub fn text(&self, width: Option<u16>) -> String {
        let mut out = String::new();
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "\n  Along the motion, {}: {}\n",
            plural(self.steps.len(), "step"),
            self.verdict()
        );
        let symbol = self.unit.symbol;
        let effort = if self
            .steps
            .iter()
            .any(|s| s.drive_effort.is_some() && !s.slides)
        {
            "drive, N·m"
        } else {
            "drive, N"
        };
        let diameter = format!("D, {symbol}");
        let head = [
            "step",
            "time, s",
            &diameter,
            "acceleration, m/s²",
            "moment per lever, N·m",
            effort,
            "",
        ];
        let number = |x: Option<f64>| x.map_or_else(|| "-".to_owned(), significant);
        let rows = self.steps.iter().take(SHOWN).enumerate().map(|(i, s)| {
            vec![
                (i + 1).to_string(),
                number(s.time),
                significant(s.diameter / self.unit.metres),
                s.acceleration.map(significant).join(", "),
                number(s.drive_moment_per_lever),
                number(s.drive_effort),
                s.verdict.to_owned(),
            ]
        });
        let _ = writeln!(out, "{}", table(&head, rows.collect(), width));
        if self.steps.len() > SHOWN {
            let left = plural(self.steps.len() - SHOWN, "step");
            let _ = writeln!(out, "\n  and {left} more; --format json has them all");
        }
        fit(&out, width)
    }

    /// The moment, and the drive's effort where it is known, over the motion.
    #[must_use]
    pub fn chart(&self, mechanism: &str) -> Chart {
        let timed = self.steps.iter().all(|s| s.time.is_some());
        #[allow(clippy::cast_precision_loss, reason = "at most 1e5 steps")]
        let at = |i: usize, s: &ClampingStep| s.time.filter(|_| timed).unwrap_or(i as f64 + 1.0);
        let points = self.steps.iter().enumerate();
        let points = points.map(|(i, s)| (at(i, s), s.drive_moment_per_lever.unwrap_or(f64::NAN)));
        let linear = |label: &str| Axis {
            label: label.to_owned(),
            scale: Scale::Linear,
        };
        Chart {
            title: format!("{mechanism}: least drive moment per lever along the motion"),
            subtitle: "Broken where the part cannot be held.".to_owned(),
            x: linear(if timed { "time, s" } else { "step" }),
            y: linear("moment, N·m"),
            series: vec![Series {
                name: "drive moment".to_owned(),
                points: points.collect(),
                style: Style::Line,
            }],
        }
    }
}
