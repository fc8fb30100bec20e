//! A chart of the forces in the joints of outputs, and of the drives, over a stroke.

use crate::chart::{Axis, Chart, Series, Style};
use crate::view::prelude::*;
use crate::view::reactions::Reactions;
use crate::view::reactions::couplings::effort_unit;
use crate::view::reactions::stroke::ReactionsOverStroke;
use std::collections::BTreeMap;

/// Maximum number of lines: more cannot be distinguished.
const LINES: usize = 10;

impl ReactionsOverStroke<'_> {
    /// Returns the forces in the joints of output links and objects, and what each drive and coupling does, by position of the first
    /// drive. Returns `None` if no position has reactions.
    pub fn chart(&self) -> Option<Chart> {
        let solved = self.solved_positions().collect_vec();
        let lines = self.chart_lines(&solved);
        if lines.is_empty() {
            return None;
        }
        let series = lines.into_iter().take(LINES);
        let series = series.map(|((joint, name), points)| Series {
            name,
            points,
            style: if joint { Style::Line } else { Style::Dashed },
        });
        let unique = solved.iter().all(|(_, r)| r.is_unique());
        let open = "of minimum norm, since redundant constraints leave them open";
        let others = match &self.of.couplings[..] {
            [] => "what a drive does",
            _ => "what drives and couplings do",
        };
        let state = &self.of.states[self.state];
        Some(Chart {
            title: format!("Forces in the joints of the outputs, state {state}"),
            subtitle: if unique { "" } else { open }.to_owned(),
            x: Axis::linear(format!("drive, {}", self.unit())),
            y: Axis::linear(format!("force, N; dashed: {others}")),
            series: series.collect(),
        })
    }

    /// Returns the values of each line by position: those in the joints of outputs and objects (true), and those of drives and
    /// couplings.
    fn chart_lines(
        &self,
        solved: &[(f64, Reactions<'_>)],
    ) -> BTreeMap<(bool, String), Vec<(f64, f64)>> {
        let m = self.of;
        let worked = |l: &LinkId| matches!(m.links[*l].role, Role::Output | Role::Object);
        let mut lines: BTreeMap<(bool, String), Vec<(f64, f64)>> = BTreeMap::new();
        for (drive, reactions) in solved {
            let at = self.shown_position(*drive);
            let mut add = |joint, name, x| lines.entry((joint, name)).or_default().push((at, x));
            for r in &reactions.found.reactions {
                let id = &m.joints[r.joint].id;
                if m.joints[r.joint].links.iter().any(worked) {
                    add(true, id.clone(), r.force_size());
                }
                if let Some((freedom, effort)) = r.effort {
                    add(
                        false,
                        format!("drive {id}, {}", effort_unit(freedom)),
                        effort.abs(),
                    );
                }
            }
            for (name, force) in reactions.couplings().iter().map(|c| c.chart_line()) {
                add(false, name, force);
            }
        }
        lines
    }
}
