//! Loads of a grip on its mechanism, as text and JSON. Forces in N on the part, in the grip's own axes.

use crate::grip::clamped;
use crate::grip::clamping::{DiameterRow, Hardest};
use crate::grip::holding::ContactForce;
use crate::grip::jaw_loads::Gripping;
use crate::model::grip::GripLoad;
use crate::view::grip::all_reasons;
use crate::view::grip::text::effort_of_drive;
use crate::view::prelude::*;

/// The loads from a grip round one part.
#[derive(Debug)]
pub struct Clamped<'a> {
    /// The grip.
    pub grip: &'a Gripping,
    /// The part.
    pub row: &'a DiameterRow,
    /// The mechanism that holds the part.
    pub found: &'a clamped::Clamped,
}

/// A part that is not held.
#[derive(Debug, Serialize)]
pub struct NotHeld<'a> {
    /// Its name.
    pub mechanism: &'a str,
    /// The state.
    pub state: &'a str,
    /// False.
    pub held: bool,
    /// Why, by diameter.
    pub reasons: Vec<String>,
}

fn grip_load(g: &Gripping) -> Option<&GripLoad> {
    g.mechanism.loads.grip.as_ref()?.load.as_ref()
}

fn diameter_words(g: &Gripping, row: &DiameterRow) -> String {
    format!(
        "D = {}",
        g.mechanism.length_unit.format_metres(row.diameter)
    )
}

/// Describes the pose in a few words.
pub(crate) fn pose_words(g: &Gripping, row: &DiameterRow) -> String {
    format!("round a part of {}", diameter_words(g, row))
}

/// Returns every reason why a part is not held, one per line.
pub(crate) fn not_held(g: &Gripping, row: &DiameterRow) -> String {
    let all = all_reasons(row, grip_load(g).map_or(0.0, |l| l.friction));
    let lines = all.map(|why| format!("  {} cannot be held: {why}\n", diameter_words(g, row)));
    lines.collect()
}

impl<'a> NotHeld<'a> {
    /// Creates the record of a part in a state that is not held, for one reason.
    pub fn because(m: &'a Mechanism, state: StateId, why: &str) -> Self {
        NotHeld {
            mechanism: &m.name,
            state: &m.states[state],
            held: false,
            reasons: vec![why.to_owned()],
        }
    }

    /// Creates the list of reasons why no diameter of a grip, or not the requested one, is held.
    pub fn new(g: &'a Gripping) -> Self {
        let lost = g.study.rows.iter().filter(|r| !r.is_held());
        NotHeld {
            mechanism: &g.mechanism.name,
            state: &g.mechanism.states[g.state],
            held: false,
            reasons: lost.map(|r| not_held(g, r).trim().to_owned()).collect(),
        }
    }

    /// Returns the reasons as text for people.
    pub fn text(&self) -> String {
        let mut out = format!(
            "{}, state {}: the part cannot be held, so no contact forces load the jaws\n",
            self.mechanism, self.state
        );
        for reason in &self.reasons {
            out += &format!("  {reason}\n");
        }
        out
    }
}

impl Clamped<'_> {
    /// Returns the contacts as joints of the mechanism: the joint, the link that touches, and the force on the part. Returns `None` if it
    /// is not held.
    fn contact_forces(&self) -> Option<impl Iterator<Item = (&str, &str, &ContactForce)>> {
        let (g, held) = (self.grip, self.row.hardest.as_ref()?.held_forces()?);
        let each = g.contacts.iter().enumerate().zip(&held.forces);
        Some(each.map(|((i, &j), force)| {
            let jaw = &g.mechanism.links[g.levers[i / 2]].id;
            (&*g.mechanism.joints[j].id, &**jaw, force)
        }))
    }

    /// Returns the loads as data.
    pub(crate) fn json(&self) -> Value {
        let hardest = self.row.hardest.as_ref();
        let held = hardest.and_then(Hardest::held_forces);
        let contact = |(contact, jaw, force): (&str, &str, &ContactForce)| {
            join_objects([json!({ "contact": contact, "jaw": jaw }), json!(force)])
        };
        json!({
            "diameter": self.row.diameter,
            "case": hardest.map(|h| &h.case),
            // Gravity less acceleration in that case.
            "pull": hardest.map(|h| h.pull),
            "safety": self.safety_factor(),
            // Since the pose of the file: `[rad]`, or the file's unit.
            "drive_position": self.found.fit.drive,
            "drive_moment_per_lever": held.map(|h| h.drive),
            "lever_moments": held.map(|h| h.moments),
            "drive_effort": self.found.effort.map(|e| e.0),
            "contacts": self.contact_forces().map(|all| all.map(contact).collect::<Value>()),
        })
    }

    /// Returns the factor that the load is multiplied by.
    fn safety_factor(&self) -> f64 {
        grip_load(self.grip).map_or(1.0, |l| l.safety)
    }

    /// Returns the same for people, fitted to a terminal of `width` columns if one is given; `flat` is true if forces across the
    /// plane of motion are omitted below.
    pub fn text(&self, flat: bool, width: Option<u16>) -> String {
        let (g, mut out) = (self.grip, Report::new(width));
        if let (Some(moment), Some(contacts)) = (self.row.drive_moment(), self.contact_forces()) {
            self.write(&mut out, moment, &contacts.collect_vec(), flat);
        }
        let others = g.study.rows.iter().filter(|r| !r.is_held());
        out.text() + &others.map(|other| not_held(g, other)).collect::<String>()
    }

    fn write(
        &self,
        out: &mut Report,
        moment: f64,
        contacts: &[(&str, &str, &ContactForce)],
        flat: bool,
    ) {
        let (g, m) = (self.grip, &self.grip.mechanism);
        let choice = match g.study.hardest_row() {
            Some(hardest) if hardest.diameter == self.row.diameter => "the worst case",
            _ => "the worst case of this diameter",
        };
        let (name, state) = (&m.name, &m.states[g.state]);
        out.add_line(format!(
            "{name}, state {state}: the part is cut free, and the jaws bear the contact forces of {choice} (`ozols grip`):"
        ));
        let case = self.row.hardest.as_ref().map_or("", |h| &h.case);
        let (diameter, safety) = (
            diameter_words(g, self.row),
            four_digits(self.safety_factor()),
        );
        out.add_line(format!("{diameter}, {case}, safety factor {safety}"));
        let effort = self.found.effort;
        let effort = effort.map(|(x, slides)| format!(", {}", effort_of_drive(x, slides)));
        out.add_line(format!(
            "The grip asks {} N·m per lever{}; its drive below bears that and the loads of the links\n",
            four_digits(moment),
            effort.unwrap_or_default()
        ));
        let rows = contacts.iter().map(|(contact, jaw, f)| {
            let [normal, along, axial] = [f.normal, f.along, f.axial].map(four_digits);
            row_cells([contact, jaw, &normal, &along, &axial])
        });
        let heads = "contact | jaw | normal, N | along the face, N | along the part, N";
        out.add_table(heads, rows);
        out.add_line("");
        let mut each = contacts.iter();
        if flat && each.any(|(.., f)| f.axial.abs() > 1e-6 * f.normal) {
            let spatial = typed_option("spatial", "");
            out.add_line(format!(
                "Forces along the part are across the plane of motion and omitted below; {spatial} includes them.\n"
            ));
        }
    }
}
