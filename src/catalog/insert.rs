//! A row as entries of the tables.

use crate::catalog::drawn::{Drawn, known};
use crate::catalog::row::{IdeaRow, Laid, Row, Symmetric};
use crate::format::number;
use crate::geom::vector::sides;
use crate::model::ranking::Term;
use crate::motion::follow::Why;
use crate::synthesis::structure::Structure;
use num_bigint::BigUint;
use rusqlite::types::ToSqlOutput;
use rusqlite::{Transaction, params};
use std::collections::BTreeMap;

/// Enters a row.
pub(super) fn row(t: &Transaction<'_>, row: &Row) -> rusqlite::Result<()> {
    structure(t, row)?;
    match &row.laid {
        Ok(laid) => layout(t, &row.structure, laid),
        Err(_) => Ok(()),
    }
}

fn number(n: usize) -> i64 {
    i64::try_from(n).unwrap_or(i64::MAX)
}

/// A count of any size: a number where it fits, otherwise its digits.
fn count(n: &BigUint) -> ToSqlOutput<'static> {
    match i64::try_from(n) {
        Ok(small) => small.into(),
        Err(_) => n.to_string().into(),
    }
}

fn structure(t: &Transaction<'_>, row: &Row) -> rusqlite::Result<()> {
    let (s, r) = (&row.structure, &row.structure.roles);
    t.prepare_cached(
        "INSERT OR REPLACE INTO structures VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?15, ?16, ?17)",
    )?
    .execute(params![
        s.id(),
        s.name(),
        row.chain(),
        number(s.chain.links()),
        number(s.chain.joint_count()),
        number(r.frame),
        number(r.driver),
        number(r.jaws[0]),
        number(r.jaws[1]),
        r.jaws.get(2).map(|&l| number(l)),
        s.form.input.name(),
        s.form.symmetry.name(),
        s.form.parallel,
        number(row.jaws_at_frame),
        row.truss,
        row.graph_symmetric,
        row.laid.as_ref().err().map(ToString::to_string),
    ])?;
    Ok(())
}

/// Rounded to what the figure is worth, so that the file does not depend on the last bits.
fn rounded(x: f64) -> f64 {
    number::rounded(if x.abs() < 1e-9 { 0.0 } else { x }, 4)
}

fn layout(t: &Transaction<'_>, s: &Structure, laid: &Laid) -> rusqlite::Result<()> {
    let (l, f, id) = (&laid.layout.looks, &laid.figures, s.id());
    let end = |w: Option<Why>| w.map(Why::word);
    let tip = |n: usize, k: usize| l.tips.get(n).map(|t| rounded(t[k]));
    let turn = f.turns.iter().fold(0.0, |m: f64, t| m.max(*t));
    t.prepare_cached(
        "INSERT OR REPLACE INTO layouts VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?15, ?16, ?17, ?18, \
         ?19, ?20, ?21, ?22, ?23, ?24, ?25, ?26, ?27, ?28, ?29, ?30, ?31, ?32, ?33, ?34)",
    )?
    .execute(params![
        id,
        laid.file,
        laid.layout.start,
        number(l.crossings),
        rounded(l.ratio),
        rounded(l.transmission),
        rounded(laid.size()),
        rounded(f.openings[0]),
        rounded(f.openings[1]),
        rounded(f.travel),
        if f.closes > 0.0 { 1 } else { -1 },
        rounded(f.force[0]),
        rounded(f.force[1]),
        rounded(f.force[2]),
        f.jaws[0].name(),
        f.jaws[1].name(),
        f.jaws.get(2).map(|m| m.name()),
        tip(0, 0),
        tip(0, 1),
        tip(1, 0),
        tip(1, 1),
        tip(2, 0),
        tip(2, 1),
        rounded(turn.to_degrees()),
        end(f.ends[0]),
        end(f.ends[1]),
        number(laid.as_built.0),
        number(laid.as_built.1),
        known(&laid.finite),
        count(&laid.determinate(None)),
        count(&laid.determinate(Some(1))),
        count(&laid.orbits()),
        certainty(laid.exact),
        laid.ideas.first().map(|i| milli(i.cost_milli)),
    ])?;
    found(t, &id, (&laid.counts, &laid.symmetric), &laid.ideas)
}

/// Enters a drawn mechanism.
pub(super) fn drawn(t: &Transaction<'_>, d: &Drawn) -> rusqlite::Result<()> {
    let all: BigUint = d.counts.values().sum();
    t.prepare_cached(
        "INSERT OR REPLACE INTO drawn VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?15, ?16, ?17)",
    )?
    .execute(params![
        d.id,
        d.name,
        d.description,
        number(d.size[0]),
        number(d.size[1]),
        number(d.size[2]),
        d.mode,
        d.input,
        d.file,
        number(d.as_built.0),
        number(d.as_built.1),
        d.finite,
        count(&all),
        count(&d.admissible),
        certainty(d.exact),
        number(d.ideas_asked),
        d.ideas.first().map(|i| milli(i.cost_milli)),
    ])?;
    // Another search of the same mechanism may have kept more.
    for table in ["counts", "ideas"] {
        t.execute(
            &format!("DELETE FROM {table} WHERE structure = ?1"),
            [&d.id],
        )?;
    }
    found(t, &d.id, (&d.counts, &d.symmetric), &d.ideas)
}

fn certainty(exact: bool) -> &'static str {
    if exact { "exact" } else { "at least" }
}

/// Enters what a search has found.
fn found(
    t: &Transaction<'_>,
    id: &str,
    (of, symmetric): (&BTreeMap<(i64, u32), BigUint>, &Symmetric),
    list: &[IdeaRow],
) -> rusqlite::Result<()> {
    let mut counts =
        t.prepare_cached("INSERT OR REPLACE INTO counts VALUES (?1, ?2, ?3, ?4, ?5, ?6)")?;
    for (key, n) in of {
        let (own, orbits) = symmetric.split(key, n);
        counts.execute(params![
            id,
            key.0,
            key.1,
            count(n),
            count(&orbits),
            count(&own)
        ])?;
    }
    let mut ideas = t.prepare_cached(
        "INSERT OR REPLACE INTO ideas VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11)",
    )?;
    for (i, idea) in list.iter().enumerate() {
        let term = |t: Term| idea.scores.as_ref().map(|s| rounded(s.value(t)));
        ideas.execute(params![
            id,
            number(i + 1),
            idea.adds,
            idea.changes,
            choices(idea),
            milli(idea.cost_milli),
            idea.change_count,
            count(&idea.variants),
            term(Term::PeakForce),
            term(Term::PeakMoment),
            term(Term::OutputError).map(|x| rounded(1e3 * x)),
        ])?;
    }
    Ok(())
}

fn choices(idea: &IdeaRow) -> String {
    let words: Vec<String> = idea.choices.iter().map(ToString::to_string).collect();
    words.join(" ")
}

#[allow(clippy::cast_precision_loss, reason = "costs are small")]
fn milli(cost: i64) -> f64 {
    cost as f64 / 1000.0
}

impl Laid {
    /// Area of the box round pins and tips, in square millimetres.
    fn size(&self) -> f64 {
        let points = self.layout.at.iter().chain(&self.layout.tips);
        let points: Vec<[f64; 2]> = points.map(|p| p.real()).collect();
        let [width, height] = sides(&points);
        width * height
    }
}
