//! Decimals as the text has them: a second look at it, where the first took zeros off their ends.
//!
//! The readers of TOML and JSON give doubles, and 0.49400 as a double is 0.494: it says less of how well it is known.

use crate::file::locate::{Document, DocumentStep, index, key};
use crate::file::schema::{Coordinate, JointEntry, MechanismFile, OptionEntry, Unloading};

/// Replaces the doubles of decimals that end with a zero by their text, which is read as an expression of the same value.
///
/// # Complexity
/// Where a coordinate is a decimal and the text has such a number, it is read once more.
pub(crate) fn keep(file: &mut MechanismFile, text: &str, json: bool) {
    if !ends_with_zero(text) {
        return;
    }
    let mut decimals = false;
    geometry(file, &mut |_, c| {
        decimals |= matches!(c, Coordinate::Decimal(_));
    });
    if !decimals {
        return;
    }
    let Some(document) = Document::new(text, json) else {
        return;
    };
    geometry(file, &mut |path, c| {
        let Coordinate::Decimal(x) = c else { return };
        let written = document.span(path).and_then(|s| text.get(s));
        let Some(written) = written.map(|w| w.trim().replace('_', "")) else {
            return;
        };
        let mantissa = written.split(['e', 'E']).next().unwrap_or("");
        // Only what is this number: a path that is not there gives what is round it.
        if mantissa.contains('.') && mantissa.ends_with('0') && written.parse() == Ok(*x) {
            *c = Coordinate::Expression(written);
        }
    });
}

/// Returns true if the text has a decimal whose last digit, before any exponent, is 0.
fn ends_with_zero(text: &str) -> bool {
    let bytes = text.as_bytes();
    let ends = |i: &usize| {
        let next = bytes.get(i + 1);
        bytes[*i] == b'0' && !next.is_some_and(|b| b.is_ascii_digit() || *b == b'_' || *b == b'.')
    };
    let decimal = |i: usize| {
        let digits = bytes[..i].iter().rev();
        let before = digits.skip_while(|b| b.is_ascii_digit() || **b == b'_');
        before.copied().next() == Some(b'.')
    };
    (0..bytes.len()).filter(ends).any(decimal)
}

/// A visitor of each number, with its path.
type Visit<'v> = &'v mut dyn FnMut(&[DocumentStep], &mut Coordinate);

/// Visits every number that places a joint or a point, or relates two motions, and the parameters that these may contain.
fn geometry(file: &mut MechanismFile, visit: Visit<'_>) {
    let root = |k: &str| vec![DocumentStep::Key(k.to_owned())];
    vector(file.plane_normal.as_mut(), &root("plane_normal"), visit);
    for (name, value) in &mut file.parameter {
        visit(&key(&root("parameter"), name), value);
    }
    for (i, joint) in file.joint.iter_mut().enumerate() {
        of_joint(joint, &index(&root("joint"), i), visit);
    }
    for (i, c) in file.coupling.iter_mut().enumerate() {
        let at = index(&root("coupling"), i);
        visit(&key(&at, "ratio"), &mut c.ratio);
    }
    for (i, p) in file.point.iter_mut().enumerate() {
        let at = key(&index(&root("point"), i), "point");
        vector(Some(&mut p.point), &at, visit);
    }
    let search = root("search");
    options(&mut file.search.options, &key(&search, "options"), visit);
    options(
        &mut file.search.unloading,
        &key(&search, "unloading"),
        visit,
    );
}

fn of_joint(joint: &mut JointEntry, at: &[DocumentStep], visit: Visit<'_>) {
    vector(Some(&mut joint.point), &key(at, "point"), visit);
    vector(joint.axis.as_mut(), &key(at, "axis"), visit);
    vector(joint.reference.as_mut(), &key(at, "reference"), visit);
    number(joint.lead.as_mut(), &key(at, "lead"), visit);
    number(joint.pitch.as_mut(), &key(at, "pitch"), visit);
    if let Some(list) = &mut joint.options {
        options(list, &key(at, "options"), visit);
    }
    if let Some(Unloading::List(list)) = &mut joint.unloading {
        options(list, &key(at, "unloading"), visit);
    }
}

fn options(list: &mut [OptionEntry], at: &[DocumentStep], visit: Visit<'_>) {
    for (i, entry) in list.iter_mut().enumerate() {
        let OptionEntry::Table(o) = entry else {
            continue;
        };
        let at = index(at, i);
        vector(o.point.as_mut(), &key(&at, "point"), visit);
        vector(o.axis.as_mut(), &key(&at, "axis"), visit);
        vector(o.reference.as_mut(), &key(&at, "reference"), visit);
        number(o.lead.as_mut(), &key(&at, "lead"), visit);
        number(o.pitch.as_mut(), &key(&at, "pitch"), visit);
    }
}

fn vector(v: Option<&mut [Coordinate; 3]>, at: &[DocumentStep], visit: Visit<'_>) {
    for (i, c) in v.into_iter().flatten().enumerate() {
        visit(&index(at, i), c);
    }
}

fn number(c: Option<&mut Coordinate>, at: &[DocumentStep], visit: Visit<'_>) {
    if let Some(c) = c {
        visit(at, c);
    }
}
