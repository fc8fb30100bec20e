//! How firmly contacts hold a part: one value from which text and JSON are made. Loads are by the sum of the normal forces;
//! moments count by the part's size. The keys are a stable contract.

use crate::format::{plural, significant};
use crate::geom::vector::{length, scale};
use crate::grip::clamped_part::ClampedPart;
use crate::grip::faces::PressureArea;
use crate::grip::force_closure::{self, NOTHING};
use crate::model::mechanism::Mechanism;
use crate::view::terminal::layout::{fit, table};
use serde::Serialize;
use std::fmt::Write;

/// What the contacts of a state hold.
#[derive(Debug, Serialize)]
pub struct ClosureData<'a> {
    /// Name of the mechanism.
    pub mechanism: &'a str,
    /// Its state.
    pub state: &'a str,
    /// The part.
    pub object: &'a str,
    /// Middle of its contacts `[m]`.
    pub middle: [f64; 3],
    /// What moments are divided by: root mean square distance of the contacts from the middle `[m]`.
    pub size: f64,
    /// Motions of the jaws with drives held and contacts let go.
    pub loose: usize,
    /// The contacts.
    pub contacts: Vec<ClosureContact<'a>>,
    /// With friction.
    pub force_closure: Margin,
    /// Without.
    pub form_closure: Margin,
    /// Of parts out of true, where they were asked for.
    pub samples: Option<Samples>,
    #[serde(skip)]
    unit: (f64, &'static str),
}

/// A contact.
#[derive(Debug, Serialize)]
pub struct ClosureContact<'a> {
    /// The joint.
    pub contact: &'a str,
    /// `disc`, `line` or `point`.
    pub shape: &'static str,
    /// Radius of a disc, half length of a line `[m]`; nothing where it has no end.
    pub reach: Option<f64>,
    /// Coefficient of friction; nothing where it is as much as it takes.
    pub friction: Option<f64>,
}

/// Closure, and how far from its loss.
#[derive(Debug, Serialize)]
pub struct Margin {
    /// Whether every small load is resisted; nothing where that is within the accuracy of the programmes.
    pub closed: Option<bool>,
    /// Radius of the greatest ball of loads resisted, at least.
    pub at_least: f64,
    /// At most; nothing where no load has a limit.
    pub at_most: Option<f64>,
    /// The load resisted least, of size 1; nothing where no load has a limit.
    pub weakest: Option<PartLoad>,
    /// Loads along the axes.
    pub along: Vec<PartLoad>,
}

/// A load on the part.
#[derive(Debug, Serialize)]
pub struct PartLoad {
    /// Its direction: force.
    pub force: [f64; 3],
    /// Moment over the size.
    pub moment: [f64; 3],
    /// How much of it is resisted by normal forces of 1 in all; nothing where there is no limit.
    pub resisted: Option<f64>,
}

/// Of parts out of true.
#[derive(Debug, Serialize)]
pub struct Samples {
    /// How many.
    pub samples: usize,
    /// By how much points and rims are out at most `[m]`.
    pub tolerance: f64,
    /// How many have force closure.
    pub force_closed: usize,
    /// Their share.
    pub force_closed_share: f64,
    /// How many have form closure.
    pub form_closed: usize,
    /// Their share.
    pub form_closed_share: f64,
    /// Of how many force closure is within the accuracy of the programmes.
    pub force_undecided: usize,
    /// Of how many form closure is.
    pub form_undecided: usize,
}

impl PartLoad {
    fn new(d: &[f64; 6], resisted: f64) -> PartLoad {
        PartLoad {
            force: [d[3], d[4], d[5]],
            moment: [d[0], d[1], d[2]],
            resisted: Some(resisted).filter(|x| x.is_finite()),
        }
    }

    /// In words: along which axis, where it is one.
    fn words(&self) -> String {
        let axis = |v: [f64; 3]| {
            let unit = scale(v, 1.0 / length(v));
            let mut parts = ["x", "y", "z"].into_iter().zip(unit);
            match parts.find(|(_, c)| c.abs() > 0.9999) {
                Some((name, c)) => format!("{}{name}", if c < 0.0 { "-" } else { "" }),
                None => format!("({})", unit.map(|c| format!("{c:.3}")).join(", ")),
            }
        };
        let (f, m) = (length(self.force), length(self.moment));
        match (f > 1e-3, m > 1e-3) {
            (true, false) => format!("force along {}", axis(self.force)),
            (false, true) => format!("moment about {}", axis(self.moment)),
            _ => format!(
                "force {f:.2} along {}, moment {m:.2} about {}",
                axis(self.force),
                axis(self.moment)
            ),
        }
    }

    fn amount(&self) -> String {
        match self.resisted {
            None => "no limit".to_owned(),
            Some(x) if x <= NOTHING => "nothing".to_owned(),
            Some(x) => significant(x),
        }
    }
}

impl Margin {
    fn new(c: &force_closure::ForceClosure) -> Margin {
        let finite = c.at_most.is_finite();
        Margin {
            closed: c.closed,
            at_least: if c.at_least.is_finite() {
                c.at_least
            } else {
                0.0
            },
            at_most: finite.then_some(c.at_most),
            weakest: finite.then(|| PartLoad::new(&c.weakest, c.at_most)),
            along: c.along.iter().map(|(d, x)| PartLoad::new(d, *x)).collect(),
        }
    }

    /// The verdict in a line.
    fn verdict(&self, name: &str) -> String {
        match (self.closed, self.at_most, &self.weakest) {
            (Some(true), Some(most), Some(weakest)) => {
                let margin = match [self.at_least, most].map(significant) {
                    [least, most] if least == most => most,
                    [least, most] => format!("{least} to {most}"),
                };
                format!(
                    "{name}: yes, margin {margin}; weakest against {}",
                    weakest.words()
                )
            }
            (Some(true), ..) => format!("{name}: yes, against loads of any size"),
            (None, ..) => {
                format!("{name}: undecided, the margin is within the accuracy of the programmes")
            }
            (Some(false), ..) => {
                let all = self.along.iter();
                let open: Vec<String> = all
                    .filter(|l| l.resisted.is_some_and(|x| x <= NOTHING))
                    .map(PartLoad::words)
                    .collect();
                format!("{name}: no, nothing resists {}", open.join(", "))
            }
        }
    }
}

impl<'a> ClosureData<'a> {
    /// What was found of a part of a mechanism, with friction and without, and of parts out of true.
    #[must_use]
    pub fn new(
        m: &'a Mechanism,
        part: &ClampedPart,
        [force, form]: [&force_closure::ForceClosure; 2],
        samples: Option<&force_closure::ClosureShares>,
    ) -> Self {
        let g = &part.geometry;
        let contact = |f: &crate::grip::faces::JawFace| ClosureContact {
            contact: &m.joints[f.joint].id,
            shape: match f.shape {
                PressureArea::Disc(_) => "disc",
                PressureArea::Line(_) => "line",
                PressureArea::Point => "point",
            },
            reach: f.reach().map(|r| r * g.size),
            friction: f.friction,
        };
        #[allow(clippy::cast_precision_loss, reason = "counts of samples")]
        let share = |n: usize, of: usize| n as f64 / of as f64;
        ClosureData {
            mechanism: &m.name,
            state: &m.states[part.state],
            object: &m.links[part.object].id,
            middle: [0, 1, 2].map(|i| g.middle[i] + g.size * part.middle[i]),
            size: part.size * g.size,
            loose: part.motions.len() - part.axes.len(),
            contacts: part.faces.iter().map(contact).collect(),
            force_closure: Margin::new(force),
            form_closure: Margin::new(form),
            samples: samples.map(|s| Samples {
                samples: s.samples,
                tolerance: s.tolerance,
                force_closed: s.force_closed,
                force_closed_share: share(s.force_closed, s.samples),
                form_closed: s.form_closed,
                form_closed_share: share(s.form_closed, s.samples),
                force_undecided: s.force_undecided,
                form_undecided: s.form_undecided,
            }),
            unit: (m.length_unit.metres, m.length_unit.symbol),
        }
    }

    /// The report, fitted to a terminal of `width` columns where one is given.
    #[must_use]
    pub fn text(&self, width: Option<u16>) -> String {
        let mut out = String::new();
        // Writing to a string cannot fail.
        let _ = self.write(&mut out, width);
        fit(&out, width)
    }

    /// A length in the file's unit, with its symbol.
    fn long(&self, x: f64) -> String {
        let (metres, symbol) = self.unit;
        format!("{} {symbol}", significant(x / metres))
    }

    fn contact_table(&self, width: Option<u16>) -> String {
        let rows = self.contacts.iter().map(|c| {
            let reach = match (c.shape, c.reach) {
                ("point", _) => "-".to_owned(),
                (_, Some(r)) => self.long(r),
                (_, None) => "no end stated".to_owned(),
            };
            let friction = c.friction.map_or("as it takes".to_owned(), significant);
            vec![c.contact.to_owned(), c.shape.to_owned(), reach, friction]
        });
        let head = ["contact", "shape", "radius or half length", "friction"];
        table(&head, rows.collect(), width)
    }

    fn write(&self, out: &mut String, width: Option<u16>) -> std::fmt::Result {
        writeln!(
            out,
            "{}, state {}: {}\n{}\n",
            self.mechanism,
            self.state,
            self.force_closure.verdict("force closure"),
            self.form_closure.verdict("form closure")
        )?;
        writeln!(
            out,
            "  part {} between {}, drives held; loads by the sum of the normal forces, moments over {}\n  \
             (root mean square distance of the contacts from their middle)",
            self.object,
            plural(self.contacts.len(), "contact"),
            self.long(self.size)
        )?;
        if self.loose > 0 {
            writeln!(
                out,
                "  with drives held and contacts let go the jaws have {}, which limit what they can bear",
                plural(self.loose, "free motion")
            )?;
        }
        writeln!(out, "\n{}", self.contact_table(width))?;
        let pairs = self
            .force_closure
            .along
            .iter()
            .zip(&self.form_closure.along);
        let rows = pairs.map(|(a, b)| vec![a.words(), a.amount(), b.amount()]);
        let head = ["load on the part", "resisted", "without friction"];
        writeln!(out, "\n{}", table(&head, rows.collect(), width))?;
        if let Some(s) = &self.samples {
            writeln!(
                out,
                "\n  of {} with contacts out by up to {}: {} with force closure ({:.1} %), {} with form closure ({:.1} %)",
                plural(s.samples, "sample"),
                self.long(s.tolerance),
                s.force_closed,
                100.0 * s.force_closed_share,
                s.form_closed,
                100.0 * s.form_closed_share
            )?;
            if s.force_undecided + s.form_undecided > 0 {
                writeln!(
                    out,
                    "  undecided, the margin within the accuracy of the programmes: force closure of {}, form closure of {}",
                    s.force_undecided, s.form_undecided
                )?;
            }
        }
        Ok(())
    }
}
