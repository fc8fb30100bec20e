//! A gripper for people: whether it holds, with what drive, and why.

use crate::grip::clamping::DiameterRow;
use crate::grip::contact::TouchingPose;
use crate::grip::holding::Holding;
use crate::model::grip::{GripLoad, LeverDrive, PartMass, Pivots, Toward};
use crate::view::grip::motion::format_or_dash;
use crate::view::grip::{GripReport, all_reasons};
use crate::view::prelude::*;

/// Returns what one drive of both levers takes: a force if it slides, a moment if it turns.
pub(super) fn effort_of_drive(effort: f64, slides: bool) -> String {
    let (what, unit) = if slides {
        ("force", "N")
    } else {
        ("moment", "N·m")
    };
    format!("drive {what} {} {unit}", four_digits(effort))
}

impl GripReport<'_> {
    /// Returns the report, fitted to a terminal of `width` columns if one is given.
    pub fn text(&self, width: Option<u16>) -> String {
        let mut out = Report::new(width);
        let rows = &self.found.study.rows;
        let (held, lost): (Vec<_>, Vec<_>) = rows.iter().partition(|d| d.is_held());
        out.add_line(self.verdict(&held, &lost) + "\n");
        for d in &lost {
            for reason in all_reasons(d, self.load_friction()) {
                let at = self.format_length(d.diameter);
                out.add_line(format!("  D = {at} cannot be held: {reason}"));
            }
        }
        if !lost.is_empty() {
            out.add_line("");
        }
        self.write_inputs(&mut out);
        out.add_line("");
        self.write_diameters(&mut out);
        let hardest = self.hardest_place().map(|at| &rows[at]);
        let held =
            hardest.and_then(|d| Some((d.hardest.as_ref()?.held_forces()?, d.pose.as_ref()?)));
        if let Some((held, pose)) = held {
            out.add_line("\n  Contact forces in the worst case:\n");
            write_contacts(&mut out, held, pose, self.load_friction());
        }
        let motion = self.motion.as_ref().map(|m| m.text(width));
        let claims = claims_text(&self.file.claims, Topic::Grip, width);
        out.text() + &motion.unwrap_or_default() + &claims
    }

    /// Returns a length in the file's unit, with its symbol.
    fn format_length(&self, x: f64) -> String {
        self.file.length_unit.format_metres(x)
    }

    /// Returns a length in the file's unit.
    fn format_bare(&self, x: f64) -> String {
        four_digits(x / self.file.length_unit.metres)
    }

    fn diameter_range(&self, rows: &[&DiameterRow]) -> String {
        match rows {
            [] => "nothing".to_owned(),
            [one] => format!("D = {}", self.format_length(one.diameter)),
            [first, .., last] => {
                let (from, to) = (
                    self.format_bare(first.diameter),
                    self.format_length(last.diameter),
                );
                format!("D = {from} to {to}")
            }
        }
    }

    /// Returns what can be held, and what the hardest of it takes.
    fn verdict(&self, held: &[&DiameterRow], lost: &[&DiameterRow]) -> String {
        let (name, rows) = (&self.file.name, &self.found.study.rows);
        // The forces found can balance the load; others may arise, and the safety factor is for those.
        let verb = if self.file.spec.load.is_some() {
            "can hold"
        } else {
            "can hold (no load stated)"
        };
        let mut out = match (held.len(), lost.is_empty()) {
            (0, _) => format!("{name}: cannot hold {}", self.diameter_range(lost)),
            (_, true) => format!("{name}: {verb} {}", self.diameter_range(held)),
            (n, false) => format!("{name}: {verb} {n} of {} diameters, not all", rows.len()),
        };
        let Some(at) = self.hardest_place() else {
            return out;
        };
        let Some(load) = &rows[at].hardest else {
            return out;
        };
        out += &format!("; hardest at {}", self.format_length(rows[at].diameter));
        if let Some(moment) = rows[at].drive_moment().map(four_digits) {
            out += &format!(", {}: drive moment {moment} N·m per lever", load.case);
        }
        if let (Some(effort), Some(t)) = (self.drive_effort(at), self.rates_at(at)) {
            out += &format!(", {}", effort_of_drive(effort, t.slides));
        }
        out
    }

    /// Returns where the pivots are.
    fn describe_pivots(&self) -> String {
        match (self.file.spec.pivots, self.found.study.rows.first()) {
            (Pivots::Nominal, _) | (_, None) => "pivots set for each diameter".to_owned(),
            (Pivots::Fixed(_) | Pivots::FixedForDiameter, Some(d)) => {
                let pivot = d.gripper.pivot;
                let nominal = self.found.study.lever.nominal_diameter(pivot);
                let of = if nominal > 0.0 {
                    format!("D = {}", self.format_length(nominal))
                } else {
                    "no diameter".to_owned()
                };
                let at = self.format_length(pivot.abs());
                format!("pivots fixed at a = {at}, nominal for {of}")
            }
        }
    }

    fn write_inputs(&self, out: &mut Report) {
        let spec = &self.file.spec;
        let (l, pivots) = (
            self.format_length(spec.lever_length),
            self.describe_pivots(),
        );
        let angles = [spec.prism_angle, spec.mounting_angle];
        let [prism, mounting] = angles.map(|x| four_digits(x.to_degrees()));
        out.add_line(format!(
            "  levers: L = {l}, α = {prism}°, γ = {mounting}°; {pivots}"
        ));
        if let Some(load) = &spec.load {
            self.write_load(out, load);
        }
    }

    fn write_load(&self, out: &mut Report, load: &GripLoad) {
        let mass = match load.mass {
            PartMass::Constant(m) => format!("{} kg", four_digits(m)),
            PartMass::Cylinder { density, length } => {
                let (density, length) = (four_digits(density), self.format_length(length));
                format!("a cylinder of {density} kg/m³, {length} long")
            }
        };
        let gravity = match load.gravity {
            Toward::Any(g) => format!("gravity {} m/s² in any direction", four_digits(g)),
            Toward::Fixed(g) => format!("gravity ({}) m/s²", g.map(four_digits).join(", ")),
        };
        let levers = match load.levers {
            LeverDrive::Coupled => "one drive for both levers (moment per lever = mean of the two)",
            LeverDrive::Equal => "the same moment on both levers",
            LeverDrive::Independent => {
                "a drive for each lever (the moment per lever is the greater of the two)"
            }
        };
        let accelerations = count_noun(load.accelerations.len(), "acceleration");
        let [friction, safety] = [load.friction, load.safety].map(four_digits);
        out.add_line(format!(
            "  load: {mass}, {gravity}, {accelerations}, friction {friction}, safety factor {safety}"
        ));
        out.add_line(format!("  drive: {levers}"));
        out.add_line(
            "  exact friction cones; 'any direction' is the worst of 26 directions, then refined",
        );
    }

    fn write_diameters(&self, out: &mut Report) {
        let symbol = self.file.length_unit.symbol;
        let mut heads = format!("D, {symbol} | l1, {symbol} | l2, {symbol} | l1/l2 | turn, °");
        let load = self.file.spec.load.as_ref();
        let one_drive = self.rates_at(self.hardest_place().unwrap_or(0)).is_some()
            && load.is_some_and(|l| l.levers != LeverDrive::Independent);
        heads += match (load, one_drive) {
            (None, _) => " | held",
            (_, false) => " | mass, kg | moment per lever, N·m | both levers, N·m | hardest case",
            (_, true) => {
                " | mass, kg | moment per lever, N·m | both levers, N·m | drive, N | hardest case"
            }
        };
        let row = |(at, d): (usize, &DiameterRow)| {
            let lengths = [d.diameter, d.arms.l1, d.arms.l2];
            let mut cells = lengths.map(|x| self.format_bare(x)).to_vec();
            cells.push(four_digits(d.arms.l1 / d.arms.l2));
            cells.push(format_or_dash(d.pose.as_ref().map(|p| p.turn.to_degrees())));
            if load.is_none() {
                cells.push(if d.is_held() { "yes" } else { "no" }.to_owned());
                return cells;
            }
            let hardest = d.hardest.as_ref();
            let both = hardest.and_then(|l| Some(l.held_forces()?.moments));
            let both = both.map_or_else(|| "-".to_owned(), |m| m.map(four_digits).join(", "));
            cells.extend([four_digits(d.mass), format_or_dash(d.drive_moment()), both]);
            if one_drive {
                cells.push(format_or_dash(self.drive_effort(at)));
            }
            cells.push(hardest.map_or("cannot be held", |l| &l.case).to_owned());
            cells
        };
        out.add_table(&heads, self.found.study.rows.iter().enumerate().map(row));
    }
}

/// Formats a ratio to three decimals, rounded down if it would exceed its limit otherwise.
fn at_most(ratio: f64, limit: f64) -> String {
    let text = format!("{ratio:.3}");
    let beyond = text.parse::<f64>().is_ok_and(|shown| shown > limit);
    if beyond {
        format!("{:.3}", (1000.0 * limit).floor() / 1000.0)
    } else {
        text
    }
}

fn write_contacts(out: &mut Report, held: &Holding, pose: &TouchingPose, limit: f64) {
    let rows = pose.contacts.iter().zip(&held.forces).map(|(c, f)| {
        let [normal, along, axial] = [f.normal, f.along, f.axial].map(four_digits);
        // A face that does not press has no friction.
        let friction = (f.normal > 0.0).then(|| f.along.hypot(f.axial) / f.normal);
        let friction = friction.map_or_else(|| "-".to_owned(), |f| at_most(f, limit));
        row_cells([&c.name, &normal, &along, &axial, &friction])
    });
    let heads = "contact | normal, N | along the face, N | along the part, N | friction/normal";
    out.add_table(heads, rows);
}
