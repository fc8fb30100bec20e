//! Control characters, which have no business in names: a terminal would obey them, and a table would fall apart.

use crate::file::findings::{Finding, Findings};
use crate::file::locate::DocumentStep;
use crate::file::problem::ProblemKind;
use crate::file::schema::MechanismFile;
use serde_json::Value;

/// Texts of more than one line.
const PROSE: [&str; 3] = ["description", "sources", "assumed"];

/// Every control character of a file's strings and keys.
///
/// # Complexity
/// The file is written out once as a value.
pub(crate) fn controls(file: &MechanismFile) -> Vec<Finding> {
    let mut out = Findings::default();
    if let Ok(value) = serde_json::to_value(file) {
        below(&value, &mut Vec::new(), &mut out);
    }
    out.told()
}

fn below(value: &Value, path: &mut Vec<DocumentStep>, out: &mut Findings) {
    match value {
        Value::String(text) => check(text, path, out),
        Value::Array(all) => {
            for (i, value) in all.iter().enumerate() {
                path.push(DocumentStep::Index(i));
                below(value, path, out);
                path.pop();
            }
        }
        Value::Object(all) => {
            for (key, value) in all {
                check(key, path, out);
                path.push(DocumentStep::Key(key.clone()));
                below(value, path, out);
                path.pop();
            }
        }
        Value::Null | Value::Bool(_) | Value::Number(_) => {}
    }
}

fn check(text: &str, path: &[DocumentStep], out: &mut Findings) {
    let key = path.iter().rev().find_map(|s| match s {
        DocumentStep::Key(key) => Some(key.as_str()),
        DocumentStep::Index(_) => None,
    });
    let key = key.unwrap_or("the file");
    let allowed = |c: char| PROSE.contains(&key) && (c == '\n' || c == '\t');
    let found = text.chars().find(|&c| c.is_control() && !allowed(c));
    if let Some(found) = found {
        let (key, found) = (key.to_owned(), found.escape_unicode().to_string());
        out.add(path, ProblemKind::Control { key, found });
    }
}
