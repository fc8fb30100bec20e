//! What a grip loads its mechanism with: one value from which text and JSON are made. Forces in N on the part, in the
//! grip's own axes.

use crate::grip::clamped;
use crate::grip::clamping::{DiameterRow, Hardest};
use crate::grip::holding::ContactForce;
use crate::grip::jaw_loads::Gripping;
use crate::model::grip::GripLoad;
use crate::view::grip::reasons;
use crate::view::grip::text::effort_of_drive;
use crate::view::prelude::*;
use serde::Serializer;
use std::fmt::Write;

/// The loads from a grip round one part.
#[derive(Debug)]
pub struct Clamped<'a> {
    /// The grip.
    pub grip: &'a Gripping,
    /// The part.
    pub row: &'a DiameterRow,
    /// The mechanism round it.
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

fn load(g: &Gripping) -> Option<&GripLoad> {
    g.mechanism.loads.grip.as_ref()?.load.as_ref()
}

fn diameter(g: &Gripping, row: &DiameterRow) -> String {
    format!("D = {}", g.mechanism.length_unit.words(row.diameter))
}

/// The pose in a few words.
#[must_use]
pub(crate) fn pose(g: &Gripping, row: &DiameterRow) -> String {
    format!("round a part of {}", diameter(g, row))
}

/// Every reason why a part is not held, one a line.
#[must_use]
pub(crate) fn not_held(g: &Gripping, row: &DiameterRow) -> String {
    let all = reasons(row, load(g).map_or(0.0, |l| l.friction));
    let lines = all.map(|why| format!("  {} cannot be held: {why}\n", diameter(g, row)));
    lines.collect()
}

impl<'a> NotHeld<'a> {
    /// A part of a state that is not held, for one reason.
    #[must_use]
    pub fn because(m: &'a Mechanism, state: StateId, why: &str) -> Self {
        NotHeld {
            mechanism: &m.name,
            state: &m.states[state],
            held: false,
            reasons: vec![why.to_owned()],
        }
    }

    /// Why no diameter of a grip, or not the one asked for, is held.
    #[must_use]
    pub fn new(g: &'a Gripping) -> Self {
        let lost = g.study.rows.iter().filter(|r| !r.holds());
        NotHeld {
            mechanism: &g.mechanism.name,
            state: &g.mechanism.states[g.state],
            held: false,
            reasons: lost.map(|r| not_held(g, r).trim().to_owned()).collect(),
        }
    }

    /// The same for people.
    #[must_use]
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

impl Serialize for Clamped<'_> {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        self.data().serialize(s)
    }
}

impl Clamped<'_> {
    /// Returns the contacts as joints of the mechanism: the joint, the link that touches, and the force on the part; nothing where it is
    /// not held.
    fn contacts(&self) -> Option<impl Iterator<Item = (&str, &str, &ContactForce)>> {
        let (g, held) = (self.grip, self.row.hardest.as_ref()?.held()?);
        let each = g.contacts.iter().enumerate().zip(&held.forces);
        Some(each.map(|((i, &j), force)| {
            let jaw = &g.mechanism.links[g.levers[i / 2]].id;
            (&*g.mechanism.joints[j].id, &**jaw, force)
        }))
    }

    /// Returns the loads as data.
    fn data(&self) -> Value {
        let hardest = self.row.hardest.as_ref();
        let held = hardest.and_then(Hardest::held);
        let contact = |(contact, jaw, force): (&str, &str, &ContactForce)| {
            joined([json!({ "contact": contact, "jaw": jaw }), json!(force)])
        };
        json!({
            "diameter": self.row.diameter,
            "case": hardest.map(|h| &h.case),
            // Gravity less acceleration in that case.
            "pull": hardest.map(|h| h.pull),
            "safety": self.safety(),
            // Since the pose of the file: `[rad]`, or the file's unit.
            "drive_position": self.found.fit.drive,
            "drive_moment_per_lever": held.map(|h| h.drive),
            "lever_moments": held.map(|h| h.moments),
            "drive_effort": self.found.effort.map(|e| e.0),
            "contacts": self.contacts().map(|all| all.map(contact).collect::<Value>()),
        })
    }

    /// Returns the factor that the load is multiplied by.
    fn safety(&self) -> f64 {
        load(self.grip).map_or(1.0, |l| l.safety)
    }

    /// The same for people, fitted to a terminal of `width` columns where one is given; `flat` where forces across the plane
    /// of motion are left out below.
    #[must_use]
    pub fn text(&self, flat: bool, width: Option<u16>) -> String {
        let mut out = String::new();
        // Writing to a string cannot fail.
        let _ = self.write(&mut out, flat, width);
        for other in self.grip.study.rows.iter().filter(|r| !r.holds()) {
            out.push_str(&not_held(self.grip, other));
        }
        out
    }

    fn write(&self, out: &mut String, flat: bool, width: Option<u16>) -> std::fmt::Result {
        let (Some(moment), Some(contacts)) = (self.row.drive(), self.contacts()) else {
            return Ok(());
        };
        let contacts: Vec<_> = contacts.collect();
        let (g, m) = (self.grip, &self.grip.mechanism);
        let choice = match g.study.hardest() {
            Some(hardest) if hardest.diameter == self.row.diameter => "the worst case",
            _ => "the worst case of this diameter",
        };
        writeln!(
            out,
            "{}, state {}: the part is cut free, and the jaws bear the contact forces of {choice} (`ozols grip`):",
            m.name, m.states[g.state]
        )?;
        writeln!(
            out,
            "{}, {}, safety factor {}",
            diameter(g, self.row),
            self.row.hardest.as_ref().map_or("", |h| &h.case),
            significant(self.safety())
        )?;
        write!(out, "The grip asks {} N·m per lever", significant(moment))?;
        if let Some((effort, slides)) = self.found.effort {
            write!(out, ", {}", effort_of_drive(effort, slides))?;
        }
        writeln!(
            out,
            "; its drive below bears that and the loads of the links\n"
        )?;
        let rows = contacts.iter().map(|(contact, jaw, force)| {
            let mut row = vec![contact.to_string(), jaw.to_string()];
            row.extend([force.normal, force.along, force.axial].map(significant));
            row
        });
        let head = [
            "contact",
            "jaw",
            "normal, N",
            "along the face, N",
            "along the part, N",
        ];
        writeln!(out, "{}\n", table(&head, rows.collect(), width))?;
        let mut each = contacts.iter();
        if flat && each.any(|(.., f)| f.axial.abs() > 1e-6 * f.normal) {
            writeln!(
                out,
                "Forces along the part are across the plane of motion and omitted below; --spatial includes them.\n"
            )?;
        }
        Ok(())
    }
}
