//! How firmly contacts hold a part: one value from which text and JSON are made. Loads are by the sum of the normal forces;
//! moments count by the part's size. The keys are a stable contract.

use crate::geom::vector::{length, scale};
use crate::grip::clamped_part::ClampedPart;
use crate::grip::faces::{JawFace, PressureArea};
use crate::grip::force_closure::{ClosureShares, ForceClosure, NOTHING};
use crate::view::prelude::*;

/// Force and form closure of the contacts of a state.
#[derive(Debug)]
pub struct ClosureData<'a> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// The part.
    pub part: &'a ClampedPart,
    /// With friction.
    pub force: ForceClosure,
    /// Without.
    pub form: ForceClosure,
    /// Results for inaccurate parts, if they were asked for.
    pub samples: Option<ClosureShares>,
}

/// A load on the part: the moment over the part's size, and the force.
fn split(d: &[f64; 6]) -> ([f64; 3], [f64; 3]) {
    ([d[0], d[1], d[2]], [d[3], d[4], d[5]])
}

/// Returns the part of a load that normal forces with the sum 1 resist, or null if there is no limit.
fn load(d: &[f64; 6], resisted: f64) -> Value {
    let (moment, force) = split(d);
    let resisted = Some(resisted).filter(|x| x.is_finite());
    json!({ "force": force, "moment": moment, "resisted": resisted })
}

/// A load in words: along which axis, where it is one.
fn words(d: &[f64; 6]) -> String {
    let (moment, force) = split(d);
    let axis = |v: [f64; 3]| {
        let unit = scale(v, 1.0 / length(v));
        let mut parts = ["x", "y", "z"].into_iter().zip(unit);
        match parts.find(|(_, c)| c.abs() > 0.9999) {
            Some((name, c)) => format!("{}{name}", if c < 0.0 { "-" } else { "" }),
            None => format!("({})", unit.map(|c| format!("{c:.3}")).join(", ")),
        }
    };
    let (f, m) = (length(force), length(moment));
    match (f > 1e-3, m > 1e-3) {
        (true, false) => format!("force along {}", axis(force)),
        (false, true) => format!("moment about {}", axis(moment)),
        _ => format!(
            "force {f:.2} along {}, moment {m:.2} about {}",
            axis(force),
            axis(moment)
        ),
    }
}

fn amount(resisted: f64) -> String {
    match resisted {
        x if !x.is_finite() => "no limit".to_owned(),
        x if x <= NOTHING => "nothing".to_owned(),
        x => significant(x),
    }
}

/// Returns closure and its margin as data: the radius of the greatest ball of loads resisted, and the load resisted least, or null if
/// no load has a limit.
fn margin(c: &ForceClosure) -> Value {
    let finite = c.at_most.is_finite();
    let least = if c.at_least.is_finite() {
        c.at_least
    } else {
        0.0
    };
    json!({
        "closed": c.closed,
        "at_least": least,
        "at_most": finite.then_some(c.at_most),
        "weakest": finite.then(|| load(&c.weakest, c.at_most)),
        "along": c.along.iter().map(|(d, x)| load(d, *x)).collect::<Value>(),
    })
}

/// The verdict in a line.
fn verdict(c: &ForceClosure, name: &str) -> String {
    match c.closed {
        Some(true) if c.at_most.is_finite() => {
            let margin = span(significant(c.at_least), significant(c.at_most));
            let weakest = words(&c.weakest);
            format!("{name}: yes, margin {margin}; weakest against {weakest}")
        }
        Some(true) => format!("{name}: yes, against loads of any size"),
        None => format!("{name}: undecided, the margin is within the accuracy of the programmes"),
        Some(false) => {
            let open = c.along.iter().filter(|(_, x)| *x <= NOTHING);
            let open: Vec<String> = open.map(|(d, _)| words(d)).collect();
            format!("{name}: no, nothing resists {}", open.join(", "))
        }
    }
}

fn shape(f: &JawFace) -> &'static str {
    match f.shape {
        PressureArea::Disc(_) => "disc",
        PressureArea::Line(_) => "line",
        PressureArea::Point => "point",
    }
}

#[allow(clippy::cast_precision_loss, reason = "counts of samples")]
fn share(n: usize, of: usize) -> f64 {
    n as f64 / of as f64
}

impl ClosureData<'_> {
    /// Returns what moments are divided by: root mean square distance of the contacts from their middle `[m]`.
    fn size(&self) -> f64 {
        self.part.size * self.part.geometry.size
    }

    /// Returns how many motions the jaws have with drives held and contacts released.
    fn loose(&self) -> usize {
        self.part.motions.len() - self.part.axes.len()
    }

    /// Returns the radius of a disc, or the half length of a line `[m]`. Returns `None` if it has no end.
    fn reach(&self, f: &JawFace) -> Option<f64> {
        f.reach().map(|r| r * self.part.geometry.size)
    }

    /// Returns all of it as data.
    pub fn json(&self) -> Value {
        let (m, part, g) = (self.mechanism, self.part, &self.part.geometry);
        let contact = |f: &JawFace| {
            json!({
                "contact": m.joints[f.joint].id,
                "shape": shape(f),
                "reach": self.reach(f),
                // Nothing where it is as much as it takes.
                "friction": f.friction,
            })
        };
        let samples = self.samples.as_ref().map(|s| {
            json!({
                "samples": s.samples,
                "tolerance": s.tolerance,
                "force_closed": s.force_closed,
                "force_closed_share": share(s.force_closed, s.samples),
                "form_closed": s.form_closed,
                "form_closed_share": share(s.form_closed, s.samples),
                "force_undecided": s.force_undecided,
                "form_undecided": s.form_undecided,
            })
        });
        let middle = [0, 1, 2].map(|i| g.middle[i] + g.size * part.middle[i]);
        json!({
            "mechanism": m.name,
            "state": m.states[part.state],
            "object": m.links[part.object].id,
            "middle": middle,
            "size": self.size(),
            "loose": self.loose(),
            "contacts": part.faces.iter().map(contact).collect::<Value>(),
            "force_closure": margin(&self.force),
            "form_closure": margin(&self.form),
            "samples": samples,
        })
    }

    /// Returns the report, fitted to a terminal of `width` columns if one is given.
    pub fn text(&self, width: Option<u16>) -> String {
        let mut out = Report::new(width);
        let (m, part) = (self.mechanism, self.part);
        let (force, form) = (
            verdict(&self.force, "force closure"),
            verdict(&self.form, "form closure"),
        );
        out.line(format!(
            "{}, state {}: {force}\n{form}\n",
            m.name, m.states[part.state]
        ));
        out.line(format!(
            "  part {} between {}, drives held; loads by the sum of the normal forces, moments over {}\n  \
             (root mean square distance of the contacts from their middle)",
            m.links[part.object].id,
            plural(part.faces.len(), "contact"),
            self.long(self.size())
        ));
        if self.loose() > 0 {
            let motions = plural(self.loose(), "free motion");
            out.line(format!(
                "  with drives held and contacts released the jaws have {motions}, which limit what they can bear"
            ));
        }
        out.line("");
        let heads = "contact | shape | radius or half length | friction";
        out.table(heads, part.faces.iter().map(|c| self.contact_row(c)));
        out.line("");
        let pairs = self.force.along.iter().zip(&self.form.along);
        let rows = pairs.map(|((d, a), (_, b))| vec![words(d), amount(*a), amount(*b)]);
        out.table("load on the part | resisted | without friction", rows);
        if let Some(s) = &self.samples {
            self.write_samples(&mut out, s);
        }
        out.text()
    }

    /// Returns a length in the file's unit, with its symbol.
    fn long(&self, x: f64) -> String {
        self.mechanism.length_unit.words(x)
    }

    fn contact_row(&self, c: &JawFace) -> Vec<String> {
        let reach = match (shape(c), self.reach(c)) {
            ("point", _) => "-".to_owned(),
            (_, Some(r)) => self.long(r),
            (_, None) => "no end stated".to_owned(),
        };
        let friction = c.friction.map_or("as it takes".to_owned(), significant);
        cells([
            &self.mechanism.joints[c.joint].id,
            &shape(c),
            &reach,
            &friction,
        ])
    }

    fn write_samples(&self, out: &mut Report, s: &ClosureShares) {
        let percent = |n: usize| 100.0 * share(n, s.samples);
        let (force, form) = (s.force_closed, s.form_closed);
        out.line(format!(
            "\n  of {} with contacts out by up to {}: {force} with force closure ({:.1} %), {form} with form closure ({:.1} %)",
            plural(s.samples, "sample"),
            self.long(s.tolerance),
            percent(force),
            percent(form)
        ));
        if s.force_undecided + s.form_undecided > 0 {
            out.line(format!(
                "  undecided, the margin within the accuracy of the programmes: force closure of {}, form closure of {}",
                s.force_undecided, s.form_undecided
            ));
        }
    }
}
