//! Joint reactions over a stroke.

use crate::format::csv::table;
use crate::statics::reactions::drives::slides;
use crate::statics::reactions::{Cycle, NEARLY_SINGULAR};
use crate::view::prelude::*;
use crate::view::reactions::text::ADD_LOADS;
use crate::view::reactions::{HEADS, JointForces, Reactions, couplings};
use crate::view::terminal::layout::table as text_table;
use std::fmt::Write;

/// Reactions by position of the first drive.
#[derive(Debug, Serialize)]
pub struct ReactionsOverStroke<'a> {
    /// Name of the mechanism.
    pub mechanism: &'a str,
    /// Its state.
    pub state: &'a str,
    /// The positions that were reached.
    pub positions: Vec<Position<'a>>,
    /// The first that could not be, `[rad]` or the file's unit.
    pub stopped: Option<f64>,
    /// The mechanism, for its loads.
    #[serde(skip)]
    pub of: &'a Mechanism,
    /// Whether the first drive slides.
    #[serde(skip)]
    pub slides: bool,
}

/// Reactions at a position of the first drive since the pose of the file, `[rad]` or the file's unit.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub enum Position<'a> {
    /// Where there are any.
    Solved {
        /// The reactions.
        #[serde(flatten)]
        reactions: Box<Reactions<'a>>,
        /// The position.
        drive: f64,
    },
    /// Where there are none.
    Unsolved {
        /// The position.
        drive: f64,
        /// Why.
        error: String,
    },
}

impl<'a> ReactionsOverStroke<'a> {
    /// What was found of a state.
    #[must_use]
    pub fn new(m: &'a Mechanism, state: StateId, c: &Cycle) -> Self {
        let positions = c.positions.iter().map(|(drive, s)| match s {
            Ok(s) => Position::Solved {
                reactions: Box::new(Reactions::new(m, state, s)),
                drive: *drive,
            },
            Err(e) => Position::Unsolved {
                drive: *drive,
                error: e.to_string(),
            },
        });
        ReactionsOverStroke {
            mechanism: &m.name,
            state: &m.states[state],
            positions: positions.collect(),
            stopped: c.stopped,
            of: m,
            slides: c.drives.first().is_some_and(|d| slides(d.1)),
        }
    }

    fn solved(&self) -> impl Iterator<Item = (f64, &Reactions<'a>)> {
        self.positions.iter().filter_map(|p| match p {
            Position::Solved { reactions, drive } => Some((*drive, &**reactions)),
            Position::Unsolved { .. } => None,
        })
    }

    /// One joint and position a line.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut heads = vec!["drive"];
        heads.extend(HEADS);
        let rows = self.solved().flat_map(|(at, r)| {
            r.rows().map(move |mut row| {
                row.insert(0, at.to_string());
                row
            })
        });
        table(&heads, rows)
    }

    /// The report, fitted to a terminal of `width` columns where one is given.
    #[must_use]
    pub fn text(&self, width: Option<u16>) -> String {
        let mut out = String::new();
        // Writing to a string cannot fail.
        let _ = self.write(&mut out, width);
        out
    }

    /// The unit of positions.
    fn unit(&self) -> &'static str {
        if self.slides {
            self.of.length_unit.symbol
        } else {
            "°"
        }
    }

    /// A position in that unit.
    fn at(&self, x: f64) -> String {
        figure(if self.slides { x } else { x.to_degrees() })
    }

    fn write(&self, out: &mut String, width: Option<u16>) -> std::fmt::Result {
        let all: Vec<(f64, &Reactions)> = self.solved().collect();
        self.head(out, &all)?;
        let Some((_, first)) = all.first() else {
            return writeln!(out, "No pose was reached.");
        };
        self.peaks(out, &all, first, width)?;
        self.contacts(out, &all, first)?;
        self.drives(out, &all, first)?;
        let unit = self.unit();
        let passed: Vec<_> = all.iter().map(|(at, r)| (*at, &r.couplings[..])).collect();
        couplings::greatest(out, &passed, &|x| format!("{} {unit}", self.at(x)))?;
        self.equilibrium(out, &all)?;
        for position in &self.positions {
            if let Position::Unsolved { drive, error } = position {
                writeln!(out, "At {} {unit}: {error}", self.at(*drive))?;
            }
        }
        if let Some(place) = self.stopped {
            writeln!(
                out,
                "The stroke could not be followed to {} {unit}; `ozols analyze --stroke` says why",
                self.at(place)
            )?;
        }
        Ok(())
    }

    /// Over what the reactions are the greatest.
    fn head(&self, out: &mut String, all: &[(f64, &Reactions<'_>)]) -> std::fmt::Result {
        writeln!(
            out,
            "{}, state {}: greatest joint reactions over {}{}",
            self.mechanism,
            self.state,
            plural(all.len(), "pose"),
            if all.iter().any(|(_, r)| !r.unique) {
                ", of minimum norm where redundant constraints leave them open"
            } else {
                ""
            }
        )?;
        let moving = self.of.loads.drive_speeds.iter().any(|s| *s != 0.0);
        writeln!(
            out,
            "{}\n",
            if moving {
                "Inertia forces of the stated drive speed included; drives at constant speed"
            } else {
                "Drives at rest: no inertia forces; workload.drive_speed adds them"
            }
        )
    }

    /// The greatest reactions of each joint, and where.
    fn peaks(
        &self,
        out: &mut String,
        all: &[(f64, &Reactions<'_>)],
        first: &Reactions<'_>,
        width: Option<u16>,
    ) -> std::fmt::Result {
        let unit = self.unit();
        let greatest_of = |i: usize, size: fn(&JointForces) -> f64| {
            let each = all.iter().map(|(at, r)| (size(&r.reactions[i]), *at));
            each.max_by(|a, b| a.0.total_cmp(&b.0))
                .unwrap_or((0.0, 0.0))
        };
        let peaks: Vec<_> = (0..first.reactions.len())
            .map(|i| {
                let force = greatest_of(i, |j| j.force_magnitude);
                (
                    &first.reactions[i],
                    force,
                    greatest_of(i, |j| j.moment_magnitude),
                )
            })
            .collect();
        let greatest = peaks.iter().map(|p| p.1.0.max(p.2.0)).fold(0.0, f64::max);
        let (scale, prefix) = prefix(greatest);
        let size = |x: f64| figure(x / scale);
        if greatest == 0.0 {
            writeln!(out, "The loads are nothing here: {ADD_LOADS}.\n")?;
        }
        let rows = peaks.iter().map(|(joint, force, moment)| {
            let mut row = [joint.joint, joint.kind].map(str::to_owned).to_vec();
            row.extend([
                size(force.0),
                self.at(force.1),
                size(moment.0),
                self.at(moment.1),
            ]);
            row
        });
        let (n, nm, place) = (
            format!("|F|, {prefix}N"),
            format!("|M|, {prefix}N·m"),
            format!("at, {unit}"),
        );
        let header = ["joint", "", &n, &place, &nm, &place];
        writeln!(out, "{}\n", text_table(&header, rows.collect(), width))
    }

    /// Where contacts are asked for what faces cannot do.
    fn contacts(
        &self,
        out: &mut String,
        all: &[(f64, &Reactions<'_>)],
        first: &Reactions<'_>,
    ) -> std::fmt::Result {
        let unit = self.unit();
        for (i, contact) in first.contacts.iter().enumerate() {
            let bad = all.iter().filter(|(_, r)| !r.contacts[i].holds());
            let bad: Vec<&(f64, &Reactions)> = bad.collect();
            if let Some((from, r)) = bad.first() {
                writeln!(
                    out,
                    "NOT AS CONTACTS ACT: {} in {}, first at {} {unit}, where it {}; --unilateral solves with contacts that only push",
                    contact.contact,
                    plural(bad.len(), "pose"),
                    self.at(*from),
                    r.contacts[i].touch
                )?;
            }
        }
        Ok(())
    }

    /// What each drive must do, at least and at most.
    fn drives(
        &self,
        out: &mut String,
        all: &[(f64, &Reactions<'_>)],
        first: &Reactions<'_>,
    ) -> std::fmt::Result {
        let unit = self.unit();
        for (i, joint) in first.reactions.iter().enumerate() {
            let Some(drive) = &joint.drive else { continue };
            let each = all.iter().filter_map(|(at, r)| {
                let effort = r.reactions[i].drive.as_ref()?.effort;
                Some((effort, *at))
            });
            let each: Vec<(f64, f64)> = each.collect();
            let least = each.iter().min_by(|a, b| a.0.total_cmp(&b.0));
            let most = each.iter().max_by(|a, b| a.0.total_cmp(&b.0));
            let unit_of = if drive.slides { "N" } else { "N·m" };
            if let (Some(least), Some(most)) = (least, most) {
                writeln!(
                    out,
                    "Drive {} holds {}: from {} {unit_of} at {} {unit} to {} {unit_of} at {} {unit}",
                    joint.joint,
                    drive.freedom,
                    figure(least.0),
                    self.at(least.1),
                    figure(most.0),
                    self.at(most.1)
                )?;
            }
        }
        Ok(())
    }

    /// How well the equations are solved, where that is worst.
    fn equilibrium(&self, out: &mut String, all: &[(f64, &Reactions<'_>)]) -> std::fmt::Result {
        let unit = self.unit();
        let worst = all
            .iter()
            .max_by(|a, b| a.1.condition.total_cmp(&b.1.condition));
        let residual = all.iter().map(|(_, r)| r.residual).fold(0.0, f64::max);
        if let Some((place, r)) = worst {
            writeln!(
                out,
                "Equilibrium: condition up to {} at {} {unit}, residual up to {residual:.0e} of the load",
                figure(r.condition),
                self.at(*place)
            )?;
            if r.nearly_singular {
                writeln!(
                    out,
                    "Warning: nearly singular there (condition above {NEARLY_SINGULAR:.0e}): small errors of manufacture change these reactions much"
                )?;
            }
        }
        Ok(())
    }
}
