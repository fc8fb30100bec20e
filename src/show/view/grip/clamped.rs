//! What a grip loads its mechanism with: one value from which text and JSON are made. Forces in N on the part, in the
//! grip's own axes.

use crate::format::significant;
use crate::grip::clamped;
use crate::grip::clamping::{DiameterRow, Hardest, HoldVerdict};
use crate::grip::holding::ContactForce;
use crate::grip::jaw_loads::Gripping;
use crate::model::grip::GripLoad;
use crate::model::mechanism::{Mechanism, StateId};
use crate::view::grip::reason;
use crate::view::grip::text::effort_of_drive;
use crate::view::terminal::layout::table;
use serde::Serialize;
use std::fmt::Write;

/// The loads from a grip round one part.
#[derive(Debug, Serialize)]
pub struct Clamped<'a> {
    /// Of the part `[m]`.
    pub diameter: f64,
    /// The hardest case in words.
    pub case: Option<&'a str>,
    /// Gravity less acceleration in that case `[m/s²]`.
    pub pull: Option<[f64; 3]>,
    /// The factor that the load is multiplied by.
    pub safety: f64,
    /// Position of the first drive since the pose of the file: `[rad]`, or the file's unit.
    pub drive_position: f64,
    /// What the grip asks of each lever `[N·m]`.
    pub drive_moment_per_lever: Option<f64>,
    /// Moments on the upper and the lower lever `[N·m]`.
    pub lever_moments: Option<[f64; 2]>,
    /// What one drive of both levers takes, `[N]` or `[N·m]`.
    pub drive_effort: Option<f64>,
    /// The contact forces.
    pub contacts: Option<Vec<JointContact<'a>>>,
    #[serde(skip)]
    grip: &'a Gripping,
    #[serde(skip)]
    row: &'a DiameterRow,
    /// Whether that drive slides.
    #[serde(skip)]
    slides: bool,
}

/// A contact as a joint of the mechanism, and its force on the part.
#[derive(Debug, Serialize)]
pub struct JointContact<'a> {
    /// The joint.
    pub contact: &'a str,
    /// The link that touches.
    pub jaw: &'a str,
    /// The force.
    #[serde(flatten)]
    pub force: ContactForce,
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

/// Reactions with the grip that causes them.
#[derive(Debug, Serialize)]
pub struct Gripped<'a, T> {
    /// The reactions.
    #[serde(flatten)]
    pub reactions: T,
    /// The state, where the reactions do not name it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub state: Option<&'a str>,
    /// The grip.
    pub grip: Clamped<'a>,
}

fn load(g: &Gripping) -> Option<&GripLoad> {
    g.mechanism.loads.grip.as_ref()?.load.as_ref()
}

fn diameter(g: &Gripping, row: &DiameterRow) -> String {
    let unit = g.mechanism.length_unit;
    let figure = significant(row.diameter / unit.metres);
    format!("D = {figure} {}", unit.symbol)
}

/// The pose in a few words.
#[must_use]
pub fn pose(g: &Gripping, row: &DiameterRow) -> String {
    format!("round a part of {}", diameter(g, row))
}

/// Every reason why a part is not held, one a line.
#[must_use]
pub(crate) fn not_held(g: &Gripping, row: &DiameterRow) -> String {
    let friction = load(g).map_or(0.0, |l| l.friction);
    let forces = row.hardest.as_ref().and_then(|h| reason(h, friction));
    let all = row.obstacles.iter().map(ToString::to_string).chain(forces);
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

impl<'a> Clamped<'a> {
    /// The grip's loads on a mechanism round the part of a row.
    #[must_use]
    pub fn new(g: &'a Gripping, row: &'a DiameterRow, found: &clamped::Clamped) -> Self {
        let m = &g.mechanism;
        let hardest = row.hardest.as_ref();
        let held = match hardest {
            Some(Hardest {
                verdict: HoldVerdict::Held(held),
                ..
            }) => Some(held),
            _ => None,
        };
        let contacts = held.map(|h| {
            let each = g.contacts.iter().enumerate().zip(&h.forces);
            each.map(|((i, &j), f)| JointContact {
                contact: &m.joints[j].id,
                jaw: &m.links[g.levers[i / 2]].id,
                force: *f,
            })
            .collect()
        });
        Clamped {
            diameter: row.diameter,
            case: hardest.map(|h| h.case.as_str()),
            pull: hardest.map(|h| h.pull),
            safety: load(g).map_or(1.0, |l| l.safety),
            drive_position: found.fit.drive,
            drive_moment_per_lever: held.map(|h| h.drive),
            lever_moments: held.map(|h| h.moments),
            drive_effort: found.effort.map(|e| e.0),
            contacts,
            grip: g,
            row,
            slides: found.effort.is_some_and(|e| e.1),
        }
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
        let (Some(moment), Some(contacts)) = (self.drive_moment_per_lever, &self.contacts) else {
            return Ok(());
        };
        let (g, m) = (self.grip, &self.grip.mechanism);
        let choice = match g.study.hardest() {
            Some(hardest) if hardest.diameter == self.diameter => "the worst case",
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
            self.case.unwrap_or(""),
            significant(self.safety)
        )?;
        write!(out, "The grip asks {} N·m per lever", significant(moment))?;
        if let Some(effort) = self.drive_effort {
            write!(out, ", {}", effort_of_drive(effort, self.slides))?;
        }
        writeln!(
            out,
            "; its drive below bears that and the loads of the links\n"
        )?;
        let rows = contacts.iter().map(|c| {
            let mut row = vec![c.contact.to_owned(), c.jaw.to_owned()];
            row.extend([c.force.normal, c.force.along, c.force.axial].map(significant));
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
        if flat && each.any(|c| c.force.axial.abs() > 1e-6 * c.force.normal) {
            writeln!(
                out,
                "Forces along the part are across the plane of motion and left out below; --spatial takes them.\n"
            )?;
        }
        Ok(())
    }
}
