//! The clamping force along a motion: one value from which text, JSON and a chart are made. SI units.

use crate::grip::holding::HoldingOutcome;
use crate::grip::motion::StepTaken;
use crate::model::mechanism::LengthUnit;
use crate::view::prelude::*;

/// Maximum number of rows in a text.
const SHOWN: usize = 40;

/// A motion, step by step.
#[derive(Debug)]
pub struct GripMotion {
    /// The steps and the clamping they take.
    pub steps: Vec<StepTaken>,
    /// The file's unit.
    pub unit: LengthUnit,
}

fn step_word(s: &StepTaken) -> &'static str {
    match &s.verdict {
        Some(Ok(HoldingOutcome::Held(_))) => "can hold",
        Some(Ok(HoldingOutcome::Slips(_))) => "slips",
        Some(Err(_)) => "undecided",
        None => "cannot be held",
    }
}

impl GripMotion {
    /// Returns whether the part can be held at every step.
    pub fn holds(&self) -> bool {
        self.steps.iter().all(|s| s.held_forces().is_some())
    }

    /// Returns it as data.
    pub(super) fn json(&self) -> Value {
        let step = |s: &StepTaken| {
            let held = s.held_forces();
            json!({
                "time": s.of.time,
                "diameter": s.diameter,
                "acceleration": s.of.acceleration,
                // Gravity less acceleration.
                "pull": s.pull,
                "verdict": step_word(s),
                "drive_moment_per_lever": held.map(|h| h.drive),
                "lower_bound": held.map(|h| h.lower_bound),
                "drive_effort": s.effort.map(|e| e.0),
            })
        };
        json!({ "holds": self.holds(), "steps": self.steps.iter().map(step).collect::<Value>() })
    }

    /// Describes whether the grip can hold the part, and with what moments.
    fn motion_verdict(&self) -> String {
        let moments = self
            .steps
            .iter()
            .filter_map(|s| Some(s.held_forces()?.drive));
        let least = moments.clone().fold(f64::INFINITY, f64::min);
        let most = moments.clone().fold(0.0, f64::max);
        match self.steps.len() - moments.clone().count() {
            0 => format!(
                "can hold at every step, with {} to {} N·m per lever",
                four_digits(least),
                four_digits(most)
            ),
            n => format!("CANNOT HOLD at {}", count_noun(n, "step")),
        }
    }

    /// Returns it for people, fitted to a terminal of `width` columns if one is given.
    pub fn text(&self, width: Option<u16>) -> String {
        let (mut out, all) = (Report::new(width), self.steps.len());
        let (steps, verdict) = (count_noun(all, "step"), self.motion_verdict());
        out.add_line(format!("\n  Along the motion, {steps}: {verdict}\n"));
        let turns = |s: &StepTaken| s.effort.is_some_and(|(_, slides)| !slides);
        let effort = if self.steps.iter().any(turns) {
            "N·m"
        } else {
            "N"
        };
        let symbol = self.unit.symbol;
        let heads = format!(
            "step | time, s | D, {symbol} | acceleration, m/s² | moment per lever, N·m | drive, {effort} | "
        );
        let rows = self.steps.iter().take(SHOWN).enumerate().map(|(i, s)| {
            let diameter = four_digits(s.diameter / self.unit.metres);
            let acceleration = s.of.acceleration.map(four_digits).join(", ");
            let moment = s.held_forces().map(|h| h.drive);
            let [time, drive, effort] =
                [s.of.time, moment, s.effort.map(|e| e.0)].map(format_or_dash);
            row_cells([
                &(i + 1),
                &time,
                &diameter,
                &acceleration,
                &drive,
                &effort,
                &step_word(s),
            ])
        });
        out.add_table(&heads, rows);
        if let left @ 1.. = all.saturating_sub(SHOWN) {
            let left = count_noun(left, "step");
            let json = typed_option("format", "json");
            out.add_line(format!("\n  and {left} more; {json} has them all"));
        }
        out.text()
    }

    /// Returns the chart of the moment over the motion, and of the drive's effort if it is known.
    pub fn chart(&self, mechanism: &str) -> Chart {
        let timed = self.steps.iter().all(|s| s.of.time.is_some());
        #[allow(clippy::cast_precision_loss, reason = "at most 1e5 steps")]
        let at = |i: usize, s: &StepTaken| s.of.time.filter(|_| timed).unwrap_or(i as f64 + 1.0);
        let points = self.steps.iter().enumerate();
        let points = points.map(|(i, s)| (at(i, s), s.held_forces().map_or(f64::NAN, |h| h.drive)));
        Chart {
            title: format!("{mechanism}: least drive moment per lever along the motion"),
            subtitle: "Broken where the part cannot be held.".to_owned(),
            x: Axis::linear(if timed { "time, s" } else { "step" }),
            y: Axis::linear("moment, N·m"),
            series: vec![Series {
                name: "drive moment".to_owned(),
                points: points.collect(),
                style: Style::Line,
            }],
        }
    }
}

/// Returns a number, or "-" if there is none.
pub(super) fn format_or_dash(x: Option<f64>) -> String {
    x.map_or_else(|| "-".to_owned(), four_digits)
}
