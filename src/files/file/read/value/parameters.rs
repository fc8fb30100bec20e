//! `[parameter]`: numbers that expressions know by their names.

use crate::file::findings::Findings;
use crate::file::locate::{DocumentStep, key};
use crate::file::problem::ProblemKind;
use crate::file::read::value::number::number;
use crate::file::schema::MechanismFile;
use crate::geom::expr::{Expr, WORDS};
use std::collections::BTreeMap;

/// Most parameters.
const MOST: usize = 64;

/// Returns the parameters of a file by name.
fn parameters(file: &MechanismFile, out: &mut Findings) -> BTreeMap<String, Expr> {
    let at = [DocumentStep::Key("parameter".to_owned())];
    if file.parameter.len() > MOST {
        let (what, count, limit) = ("parameters", file.parameter.len(), MOST);
        out.add(&at, ProblemKind::TooMany { what, count, limit });
        return BTreeMap::new();
    }
    let mut all = BTreeMap::new();
    for (name, value) in &file.parameter {
        let path = key(&at, name);
        let first = name.starts_with(|c: char| c.is_ascii_alphabetic());
        let rest = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        if !first || !rest || WORDS.contains(&name.as_str()) {
            let name = name.clone();
            out.add(&path, ProblemKind::BadParameter { name });
        }
        all.insert(name.clone(), number(value, &path, out));
    }
    all
}

/// Returns findings that know the parameters of a file.
pub(crate) fn knowing(file: &MechanismFile) -> Findings {
    let mut out = Findings::default();
    let all = parameters(file, &mut out);
    out.know(all);
    out
}

/// Tells of parameters that nothing depends on.
pub(crate) fn unused(out: &mut Findings) {
    for name in out.unused() {
        let path = key(&[DocumentStep::Key("parameter".to_owned())], &name);
        out.add(&path, ProblemKind::UnusedParameter { name });
    }
}
