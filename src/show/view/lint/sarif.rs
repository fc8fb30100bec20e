//! Findings as SARIF.

use super::{Finding, Lint, PassedOver, passed_over};
use serde_json::{Value, json};

/// What was found in some files as SARIF 2.1.0, and which were passed over.
#[must_use]
pub fn sarif(all: &[&Lint], passed_over: &[PassedOver]) -> Value {
    let result = |lint: &Lint, f: &Finding| {
        let mut place = json!({
            "artifactLocation": { "uri": f.file.as_ref().unwrap_or(&lint.file) },
        });
        if let (Some(line), Some(column)) = (f.line, f.column) {
            place["region"] = json!({ "startLine": line, "startColumn": column });
        }
        let more = match f.remedies.first() {
            Some(r) => format!(". Remedy: {r}"),
            None => String::new(),
        };
        json!({
            "ruleId": "redundant-constraint",
            "level": if lint.is_decided() && f.lasts { "warning" } else { "note" },
            "message": { "text": format!("{}{more}", f.message) },
            "locations": [{ "physicalLocation": place }],
        })
    };
    let results: Vec<Value> = all
        .iter()
        .flat_map(|l| l.findings.iter().map(move |f| (*l, f)))
        .map(|(l, f)| result(l, f))
        .collect();
    let mut out = json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": {
                "name": "ozols",
                "version": env!("CARGO_PKG_VERSION"),
                "rules": [{
                    "id": "redundant-constraint",
                    "shortDescription": { "text": "A loop holds a motion twice" },
                    "fullDescription": { "text": "Its constraint Jacobian is rank deficient: parts out of true are forced together, and solvers divide the forces as they like." },
                }],
            } },
            "results": results,
        }],
    });
    let notes = all
        .iter()
        .flat_map(|l| l.notes().map(|(id, n)| (l.file.as_str(), id, n)));
    passed_over::in_sarif(&mut out, passed_over, notes);
    out
}
