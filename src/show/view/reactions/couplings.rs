//! Efforts that couplings transmit from joint to joint.

use crate::model::joint_type::{Coupling, Freedom};
use crate::statics::reactions::CouplingReaction;
use crate::view::prelude::*;

/// A coupling of a state and what it passes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Coupled<'a> {
    m: &'a Mechanism,
    coupling: &'a Coupling,
    found: &'a CouplingReaction,
}

/// Returns the couplings of a state.
pub(crate) fn state_couplings<'a>(
    m: &'a Mechanism,
    state: StateId,
    found: &'a [CouplingReaction],
) -> Vec<Coupled<'a>> {
    let all = m.couplings_in(state).zip(found);
    all.map(|(coupling, found)| Coupled { m, coupling, found })
        .collect()
}

/// Returns the unit of an effort along a freedom.
pub(super) fn effort_unit(freedom: Freedom) -> &'static str {
    if freedom.is_slide() { "N" } else { "N·m" }
}

impl Coupled<'_> {
    /// Returns the two joints, each with its freedom if it has several.
    pub(super) fn name(&self) -> String {
        self.coupling.name(self.m)
    }

    /// Returns each joint with its effort, what its second link gets along the freedom tied, and the unit of that.
    fn coupled_ends(&self) -> [(&str, f64, &'static str); 2] {
        [0, 1].map(|n| {
            let end = &self.found.ends[n];
            let joint = &*self.m.joints[end.joint].id;
            (joint, self.found.efforts[n], effort_unit(end.freedom))
        })
    }

    /// Returns the name of the line in a chart, and how great the effort is: at the teeth, or else at the second joint.
    pub(super) fn chart_line(&self) -> (String, f64) {
        let (name, (_, effort, unit)) = (self.name(), self.coupled_ends()[1]);
        match &self.found.teeth {
            Some(teeth) => (format!("teeth {name}, N"), teeth.tooth_force_size()),
            None => (format!("coupling {name}, {unit}"), effort.abs()),
        }
    }

    /// Returns it as data; `open` is true if self-stresses leave it open.
    pub(super) fn json(&self, open: bool) -> Value {
        let freedoms = self.found.ends.each_ref().map(|e| e.freedom.name());
        let ends = self.coupled_ends().into_iter().zip(freedoms);
        let ends = ends.map(|((joint, effort, unit), freedom)| {
            json!({ "joint": joint, "freedom": freedom, "effort": effort, "unit": unit })
        });
        let teeth = self.found.teeth.as_ref();
        json!({
            "coupling": self.name(),
            // Rate of the second over that of the first, as in the file.
            "ratio": self.coupling.ratio.to_f64(),
            "gear": self.coupling.gear,
            "ends": ends.collect::<Value>(),
            // Part of the reactions of both joints; null if nothing says where they are.
            "teeth": teeth.map(|t| join_objects([json!(t), json!({ "magnitude": t.tooth_force_size() })])),
            "open": open,
        })
    }

    /// Returns what it passes at both joints and at the teeth, in words.
    fn describe_efforts(&self) -> String {
        let ends = self.coupled_ends().into_iter();
        let ends =
            ends.map(|(joint, effort, unit)| format!("{} {unit} at {joint}", five_digits(effort)));
        let teeth = self.found.teeth.iter();
        let teeth = teeth.map(|t| format!("{} N at the teeth", five_digits(t.tooth_force_size())));
        join_and(&ends.chain(teeth).collect_vec())
    }

    /// Returns its rows of CSV, one a joint, without their kind.
    pub(super) fn csv_rows(&self) -> Vec<Vec<String>> {
        let teeth = self.found.teeth.as_ref();
        let teeth = teeth.map_or_else(String::new, |t| t.tooth_force_size().to_string());
        let row = |(joint, effort, unit): (&str, f64, &str)| {
            let mut row = vec![self.name(), format!("coupling at {joint}")];
            row.resize(5, String::new());
            row.push(teeth.clone());
            row.resize(10, String::new());
            row.extend([effort.to_string(), unit.to_owned()]);
            row
        };
        self.coupled_ends().map(row).to_vec()
    }
}

/// Says which forces of teeth the joints bear.
fn write_teeth(out: &mut Report, all: &[Coupled<'_>]) {
    if all.iter().any(|c| c.found.teeth.is_some()) {
        out.add_line(
            "Teeth push along the pitch circles, and the joints of both gears bear it; their pressure angle and friction are omitted",
        );
    }
    let unplaced = all
        .iter()
        .filter(|c| c.coupling.gear && c.found.teeth.is_none());
    let unplaced = unplaced.map(Coupled::name).collect_vec();
    if !unplaced.is_empty() {
        out.add_line(format!(
            "The file does not determine where the teeth of {} are, so no joint bears them: gears need parallel axes with points \
             side by side on one link, a rack a slide across the axis on that link, both joints no other freedom that teeth move",
            join_and(&unplaced)
        ));
    }
}

/// Adds the couplings as a table.
pub(super) fn write_couplings(out: &mut Report, head: &str, all: &[Coupled<'_>]) {
    if all.is_empty() {
        return;
    }
    let rows = all.iter().map(|c| {
        let ends = c
            .coupled_ends()
            .map(|(_, effort, unit)| format!("{} {unit}", five_digits(effort)));
        let teeth = c.found.teeth.as_ref();
        let teeth = teeth.map_or_else(String::new, |t| {
            format!("{} N", five_digits(t.tooth_force_size()))
        });
        row_cells([&c.name(), &ends[0], &ends[1], &teeth])
    });
    out.add_line(format!(
        "{head} give the second link of each joint, along the freedom they tie\n"
    ));
    out.add_table(
        "coupling | at the first | at the second | at the teeth",
        rows,
    );
    out.add_line("");
    write_teeth(out, all);
}

/// Adds the greatest that each coupling passes over some positions; `place` formats a position.
pub(super) fn write_greatest(
    out: &mut Report,
    all: &[(f64, Vec<Coupled<'_>>)],
    place: &dyn Fn(f64) -> String,
) {
    let Some((_, first)) = all.first() else {
        return;
    };
    for q in 0..first.len() {
        let size = |c: &[Coupled<'_>]| c[q].found.efforts[1].abs();
        if let Some((at, c)) = all.iter().max_by(|a, b| size(&a.1).total_cmp(&size(&b.1))) {
            let (name, words, at) = (c[q].name(), c[q].describe_efforts(), place(*at));
            out.add_line(format!("Coupling {name} passes at most {words}, at {at}"));
        }
    }
    write_teeth(out, first);
}
