//! Names, numbers and quantities, with what is allowed of each; how large a file may be, its unit of length, and `[parameter]`: numbers
//! that expressions know by their names.

pub(in crate::file::read) mod names;
pub(crate) mod number;
pub(crate) mod quantity;
pub(in crate::file::read) mod tolerance;

use crate::file::Findings;
use crate::file::schema::MechanismFile;
use crate::geom::expr::{Expr, WORDS};
use crate::model::mechanism::LengthUnit;
use std::collections::BTreeMap;

/// Most links, joints (and as many contours), and options of one joint in a file.
pub(crate) const LIMITS: (usize, usize, usize) = (2000, 4000, 64);

/// Most entries of the closure matrix written out: 256 MB, and an elimination of some minutes.
pub(crate) const ENTRIES: usize = 1 << 25;

const UNITS: [(&str, f64); 5] = [
    ("m", 1.0),
    ("mm", 1e-3),
    ("cm", 1e-2),
    ("um", 1e-6),
    ("in", 0.0254),
];

/// Returns the file's unit of length.
pub(crate) fn length_unit(file: &MechanismFile, out: &Findings) -> LengthUnit {
    let symbol = file.length_unit.as_deref().unwrap_or("m");
    let found = UNITS.into_iter().find(|u| u.0 == symbol);
    let (symbol, metres) = found.unwrap_or_else(|| {
        let known = UNITS.iter().map(|u| u.0);
        out.key("length_unit").unknown("length unit", symbol, known);
        UNITS[0]
    });
    LengthUnit { symbol, metres }
}

/// Most parameters.
const MOST: usize = 64;

/// Returns the parameters of a file by name.
fn parameters(file: &MechanismFile, out: &Findings) -> BTreeMap<String, Expr> {
    let at = out.key("parameter");
    if !at.count_within(MOST, file.parameter.len(), "parameters") {
        return BTreeMap::new();
    }
    let mut all = BTreeMap::new();
    for (name, value) in &file.parameter {
        let at = at.key(name);
        let first = name.starts_with(|c: char| c.is_ascii_alphabetic());
        let rest = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        if !first || !rest || WORDS.contains(&name.as_str()) {
            at.add(format!(
                "a parameter cannot be named {name:?}; use a letter followed by letters, digits or _, but not pi, deg, sqrt, cos, sin, tan or cot"
            ));
        }
        all.insert(name.clone(), at.number(value));
    }
    all
}

/// Returns findings that know the parameters of a file.
pub(crate) fn knowing(file: &MechanismFile) -> Findings {
    let mut out = Findings::default();
    let all = parameters(file, &out);
    out.know(all);
    out
}
