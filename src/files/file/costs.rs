//! A file of costs beside a mechanism's: names and numbers, as under `[search.costs]`.

use crate::file::findings::Findings;
use crate::file::locate::Document;
use crate::file::problem::{ImportError, Problem, ProblemKind};
use crate::file::read::search::costs::costs;
use crate::model::mechanism::{CostSpec, Mechanism};
use std::collections::BTreeMap;

/// Reads the costs of a mechanism's redesigns from TOML.
///
/// # Units
/// Costs are in revolute joints, from 0 to 1e6.
///
/// # Errors
/// Every problem found, each with its place: what is no TOML, no name of a joint type, of an option of the mechanism or of
/// `change`, `link` and `harmful`, or no cost.
pub fn costs_from_str(
    name: &str,
    text: &str,
    mechanism: &Mechanism,
) -> Result<CostSpec, ImportError> {
    let fail = |problems| ImportError {
        file: name.to_owned(),
        text: text.to_owned(),
        problems,
    };
    let stated: BTreeMap<String, f64> = toml::from_str(text).map_err(|e| {
        let why = e.message().trim().replace('\n', ", ");
        let message = format!(
            "{why}; each line is a name and a number, such as spherical = 2 (`ozols show costs` prints them all)"
        );
        fail(vec![Problem {
            kind: ProblemKind::Syntax { message },
            span: e.span(),
        }])
    })?;
    let mut out = Findings::default();
    let spec = costs(&stated, mechanism, &[], &mut out);
    out.unless(spec).map_err(|found| {
        let document = Document::new(text, false);
        let place = |path: &[_]| document.as_ref().and_then(|d| d.span(path));
        let problems = found.into_iter().map(|(path, kind)| {
            let span = place(&path);
            Problem { kind, span }
        });
        let mut problems: Vec<Problem> = problems.collect();
        problems.sort_by_key(|p| p.span.as_ref().map_or(usize::MAX, |s| s.start));
        fail(problems)
    })
}
