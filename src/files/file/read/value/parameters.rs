//! `[parameter]`: what each may be, and what it is.

use crate::file::findings::Findings;
use crate::file::locate::{DocumentStep, index, key};
use crate::file::problem::ProblemKind;
use crate::file::read::value::number::number;
use crate::file::schema::{MechanismFile, ParameterEntry, VariedEntry};
use crate::geom::expr::{Expr, WORDS};
use num_bigint::BigInt;
use num_rational::BigRational;
use std::collections::BTreeMap;

/// Most parameters, and most values of one.
const MOST: (usize, usize) = (64, 10_000);

/// A parameter of a file.
#[derive(Debug, Clone)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// What it may be.
    pub domain: Domain,
    /// What it is without a sweep.
    pub default: Expr,
}

/// What a parameter may be.
#[derive(Debug, Clone)]
pub enum Domain {
    /// One number.
    Constant,
    /// Anything from the first number to the second, which is greater.
    Range([Expr; 2]),
    /// These numbers.
    Values(Vec<Expr>),
}

/// Values of parameters by name.
pub type Values = BTreeMap<String, Expr>;

/// The parameters of a file by name, ascending.
pub(crate) fn parameters(file: &MechanismFile, out: &mut Findings) -> Vec<Parameter> {
    let at = [DocumentStep::Key("parameter".to_owned())];
    if file.parameter.len() > MOST.0 {
        let (what, count) = ("parameters", file.parameter.len());
        let limit = MOST.0;
        out.add(&at, ProblemKind::TooMany { what, count, limit });
        return Vec::new();
    }
    let one = |(name, entry): (&String, &ParameterEntry)| {
        let path = key(&at, name);
        let first = name.starts_with(|c: char| c.is_ascii_alphabetic());
        let rest = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        if !first || !rest || WORDS.contains(&name.as_str()) {
            let name = name.clone();
            out.add(&path, ProblemKind::BadParameter { name });
        }
        let (domain, default) = match entry {
            ParameterEntry::Constant(c) => (Domain::Constant, number(c, &path, out)),
            ParameterEntry::Varied(entry) => varied(name, entry, &path, out)?,
        };
        Some(Parameter {
            name: name.clone(),
            domain,
            default,
        })
    };
    file.parameter.iter().filter_map(one).collect()
}

/// What a table says; nothing where it does not say it.
fn varied(
    name: &str,
    entry: &VariedEntry,
    path: &[DocumentStep],
    out: &mut Findings,
) -> Option<(Domain, Expr)> {
    let default = entry
        .default
        .as_ref()
        .map(|c| number(c, &key(path, "default"), out));
    let (domain, first) = domain(name, entry, path, out)?;
    let Some(default) = default else {
        return Some((domain, first));
    };
    let x = default.to_f64();
    let (fits, of) = match &domain {
        Domain::Constant => (true, "its value"),
        Domain::Range([from, to]) => (
            (from.to_f64()..=to.to_f64()).contains(&x),
            "within its range",
        ),
        Domain::Values(all) => (all.iter().any(|v| v.to_f64() == x), "one of its values"),
    };
    if !fits {
        let (name, value) = (name.to_owned(), default.to_string());
        let at = key(path, "default");
        out.add(&at, ProblemKind::BadDefault { name, value, of });
    }
    Some((domain, default))
}

/// What a parameter may be by its table, and what it is where that gives no default.
fn domain(
    name: &str,
    entry: &VariedEntry,
    path: &[DocumentStep],
    out: &mut Findings,
) -> Option<(Domain, Expr)> {
    let name = name.to_owned();
    match (&entry.range, &entry.values) {
        (Some([from, to]), None) => {
            let at = key(path, "range");
            let ends = [
                number(from, &index(&at, 0), out),
                number(to, &index(&at, 1), out),
            ];
            let [from, to] = &ends;
            if from.to_f64() >= to.to_f64() {
                let (from, to) = (from.to_string(), to.to_string());
                out.add(&at, ProblemKind::EmptyRange { name, from, to });
                return None;
            }
            let middle = between(&ends, &BigRational::new(1.into(), 2.into()));
            Some((Domain::Range(ends), middle))
        }
        (None, Some(list)) if !list.is_empty() && list.len() <= MOST.1 => {
            let at = key(path, "values");
            let each = list.iter().enumerate();
            let values: Vec<Expr> = each.map(|(i, c)| number(c, &index(&at, i), out)).collect();
            let first = values.first()?.clone();
            Some((Domain::Values(values), first))
        }
        (None, Some(list)) if list.len() > MOST.1 => {
            let (what, count, limit) = ("values of a parameter", list.len(), MOST.1);
            out.add(path, ProblemKind::TooMany { what, count, limit });
            None
        }
        (None, _) => {
            out.add(path, ProblemKind::NoValues { name });
            None
        }
        (Some(_), Some(_)) => {
            let (key, other) = ("range", "values");
            out.add(path, ProblemKind::KeyExcludes { key, other });
            None
        }
    }
}

/// The number at a fraction of a range.
#[must_use]
pub fn between([from, to]: &[Expr; 2], fraction: &BigRational) -> Expr {
    from + &(&(to - from) * &Expr::rational(fraction.clone()))
}

/// One part of so many.
#[must_use]
pub fn part(of: usize, all: usize) -> BigRational {
    BigRational::new(BigInt::from(of), BigInt::from(all.max(1)))
}

/// Findings that know the parameters of a file: at the values given, at their defaults where none are.
pub(crate) fn knowing(file: &MechanismFile, values: &Values) -> Findings {
    let mut out = Findings::default();
    let all = parameters(file, &mut out).into_iter().map(|p| {
        let value = values.get(&p.name).cloned();
        let value = value.unwrap_or(p.default);
        (p.name, value)
    });
    let all = all.collect();
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
