//! A chart of what outputs pass on, and drives do, over a stroke.

use crate::chart::{Axis, Chart, Scale, Series, Style};
use crate::model::mechanism::Role;
use crate::view::reactions::couplings::CouplingForces;
use crate::view::reactions::stroke::{Position, ReactionsOverStroke};
use crate::view::reactions::{JointForces, Reactions};
use std::collections::BTreeMap;

/// Most lines: more cannot be told apart.
const LINES: usize = 10;

impl ReactionsOverStroke<'_> {
    /// The forces in the joints of output links and objects, and what each drive and coupling does, by position of the first drive; nothing where no
    /// position has reactions.
    #[must_use]
    pub fn chart(&self) -> Option<Chart> {
        let turn = |x: f64| if self.slides { x } else { x.to_degrees() };
        let solved: Vec<(f64, &Reactions<'_>)> = self
            .positions
            .iter()
            .filter_map(|p| match p {
                Position::Solved { reactions, drive } => Some((turn(*drive), &**reactions)),
                Position::Unsolved { .. } => None,
            })
            .collect();
        let lines = self.lines(&solved);
        if lines.is_empty() {
            return None;
        }
        let series = lines.into_iter().take(LINES);
        let series = series.map(|((joint, name), points)| Series {
            name,
            points,
            style: if joint { Style::Line } else { Style::Dashed },
        });
        let unique = solved.iter().all(|(_, r)| r.unique);
        let open = "of minimum norm, since redundant constraints leave them open";
        let subtitle = if unique { "" } else { open };
        let dashed = if self.of.couplings.is_empty() {
            "force, N; dashed: what a drive does"
        } else {
            "force, N; dashed: what drives and couplings do"
        };
        let unit = if self.slides {
            self.of.length_unit.symbol
        } else {
            "°"
        };
        Some(Chart {
            title: format!("Forces in the joints of the outputs, state {}", self.state),
            subtitle: subtitle.to_owned(),
            x: Axis {
                label: format!("drive, {unit}"),
                scale: Scale::Linear,
            },
            y: Axis {
                label: dashed.to_owned(),
                scale: Scale::Linear,
            },
            series: series.collect(),
        })
    }

    /// The values of each line by position: in the joints of outputs and objects, and what drives and couplings do, told apart by
    /// a false.
    fn lines(&self, solved: &[(f64, &Reactions<'_>)]) -> BTreeMap<(bool, String), Vec<(f64, f64)>> {
        let worked = |id: &str| {
            let link = self.of.links.iter().find(|l| l.id == id);
            link.is_some_and(|l| matches!(l.role, Role::Output | Role::Object))
        };
        let mut lines: BTreeMap<(bool, String), Vec<(f64, f64)>> = BTreeMap::new();
        for (at, reactions) in solved {
            for j in &reactions.reactions {
                if j.links.iter().any(|l| worked(l)) {
                    let line = lines.entry((true, j.joint.to_owned())).or_default();
                    line.push((*at, j.force_magnitude));
                }
                if let Some(name) = driven(j) {
                    let effort = j.drive.as_ref().map_or(0.0, |d| d.effort.abs());
                    lines.entry((false, name)).or_default().push((*at, effort));
                }
            }
            for c in &reactions.couplings {
                let (name, force) = coupled(c);
                lines.entry((false, name)).or_default().push((*at, force));
            }
        }
        lines
    }
}

/// The name of the line of a drive.
fn driven(j: &JointForces<'_>) -> Option<String> {
    let drive = j.drive.as_ref()?;
    let unit = if drive.slides { "N" } else { "N·m" };
    Some(format!("drive {}, {unit}", j.joint))
}

/// The name of the line of a coupling, and how great what it passes is: at the teeth, or else at its second joint.
fn coupled(c: &CouplingForces<'_>) -> (String, f64) {
    let name = &c.coupling;
    match (&c.teeth, &c.ends[1]) {
        (Some(teeth), _) => (format!("teeth {name}, N"), teeth.magnitude),
        (None, end) => (format!("coupling {name}, {}", end.unit), end.effort.abs()),
    }
}
