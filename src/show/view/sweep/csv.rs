//! A sweep as a flat table, a line a sample.

use super::SweepData;
use crate::format::csv;
use crate::sweep::row::SampleRow;
use itertools::Itertools;

impl SweepData<'_> {
    /// Numbers of samples, parameters, and figures by state; the table of JSON lines has all that is known.
    #[must_use]
    pub fn csv(&self) -> String {
        let rows = &self.table.rows;
        let states = || self.states.iter().map(|s| s.state.as_str());
        let mut head = vec!["sample".to_owned()];
        head.extend(self.parameters.keys().cloned());
        for state in states() {
            let keys = [
                "mobility",
                "finite_mobility",
                "redundant",
                "redundant_at_most",
                "certainty",
            ];
            head.extend(keys.map(|k| format!("{k}_{state}")));
        }
        let rest = [
            "determinate",
            "admissible",
            "best_cost",
            "best",
            "best_proven",
            "peak_force",
            "peak_joint",
            "peak_unique",
            "peak_complete",
            "problem",
        ];
        head.extend(rest.map(str::to_owned));
        let head: Vec<&str> = head.iter().map(String::as_str).collect();
        let names: Vec<&str> = states().collect();
        csv::table(&head, rows.iter().map(|r| line(r, &names)))
    }
}

fn line(r: &SampleRow, states: &[&str]) -> Vec<String> {
    let mut out = vec![r.sample.to_string()];
    out.extend(r.at.values().map(|x| format!("{x:?}")));
    for name in states {
        out.extend(match r.states.iter().find(|s| s.state == *name) {
            None => vec![String::new(); 5],
            Some(s) => vec![
                s.mobility.to_string(),
                s.finite_mobility.clone(),
                s.redundant.to_string(),
                s.redundant_at_most.unwrap_or(s.redundant).to_string(),
                s.certainty.clone(),
            ],
        });
    }
    let best = r.redesigns.as_ref().and_then(|d| d.get());
    let text = |of: Option<String>| of.unwrap_or_default();
    out.push(text(best.map(|b| b.determinate.clone())));
    out.push(text(best.map(|b| b.admissible.clone())));
    out.push(text(
        best.and_then(|b| b.ranking.first())
            .map(|b| b.cost.to_string()),
    ));
    out.push(text(best.map(|b| b.best.iter().join(" | "))));
    out.push(text(best.map(|b| b.proven.to_string())));
    let peak = r.forces.as_ref().and_then(|f| f.get());
    out.push(text(peak.map(|p| format!("{:?}", p.peak_force))));
    out.push(text(peak.map(|p| p.joint.clone())));
    out.push(text(peak.map(|p| p.unique.to_string())));
    out.push(text(peak.map(|p| p.complete.to_string())));
    let problems = [
        r.problem.as_deref(),
        r.redesigns.as_ref().and_then(|d| d.why()),
        r.forces.as_ref().and_then(|f| f.why()),
    ];
    out.push(problems.into_iter().flatten().join("; "));
    out
}
