//! A row as entries of the tables.

use crate::catalog::drawn::{DrawnMechanism, known};
use crate::catalog::row::{IdeaRow, Laid, StructureRow, Symmetric};
use crate::chains::census::Kinds;
use crate::chains::classics::classics_of;
use crate::chains::graph6;
use crate::format;
use crate::geom::vector::sides;
use crate::model::ranking::Term;
use crate::synthesis::stroke::planes::Stacking;
use crate::synthesis::stroke::walk::StrokeEnd;
use itertools::Itertools;
use num_bigint::BigUint;
use rusqlite::types::ToSqlOutput;
use rusqlite::{ToSql, Transaction};
use std::collections::BTreeMap;

/// Adds a row, or replaces the existing row of the structure.
pub(super) fn row(t: &Transaction<'_>, row: &StructureRow) -> rusqlite::Result<()> {
    let of = &row.structure;
    let id = of.id();
    let whole = of.whole_structure();
    let [driven_from, driver] = (of.structure.roles.drive()).map(|l| of.link(l, 0).unwrap_or(0));
    let (chain, roles) = (&whole.chain, &whole.roles);
    put(
        t,
        "structures",
        &[
            ("id", &id),
            ("name", &of.name()),
            ("chain", &graph6::write(chain)),
            ("links", &number(chain.links())),
            ("joints", &number(chain.joints_made().len())),
            ("frame", &number(roles.frame)),
            ("driver", &number(driver)),
            ("jaw_a", &number(roles.jaws[0])),
            ("jaw_b", &number(roles.jaws[1])),
            ("jaw_c", &roles.jaws.get(2).map(|&l| number(l))),
            ("input", &of.input().name()),
            ("symmetry", &of.symmetry_name()),
            ("parallel", &of.form.parallel),
            ("jaws_at_frame", &number(row.jaws_at_frame)),
            ("truss", &row.truss),
            ("graph_symmetric", &row.graph_symmetric),
            (
                "no_layout",
                &row.laid.as_ref().err().map(ToString::to_string),
            ),
        ],
    )?;
    if !of.form.hinges {
        let flat = of.flat_slots();
        let flat = flat.iter().map(|j| of.copies(j)).sum();
        let kinds = Kinds::of_chain(chain).with_flat(flat);
        put(
            t,
            "pairs",
            &[
                ("structure", &id),
                ("code", &chain.code()),
                ("slides", &number(kinds.slides)),
                ("gears", &number(kinds.gears)),
                ("slots", &number(kinds.slots_made())),
                ("driven_from", &number(driven_from)),
            ],
        )?;
    }
    for classic in classics_of(&of.structure.key(), of.made_as()) {
        put(
            t,
            "classics",
            &[
                ("structure", &id),
                ("id", &classic.id),
                ("about", &classic.about),
            ],
        )?;
    }
    match &row.laid {
        Ok(laid) => layout(t, &id, laid),
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

/// Enters a row of a table, each value by the name of its column.
fn put(t: &Transaction<'_>, table: &str, row: &[(&str, &dyn ToSql)]) -> rusqlite::Result<()> {
    let names = row.iter().map(|(name, _)| *name).join(", ");
    let places = row.iter().map(|_| "?").join(", ");
    let sql = format!("INSERT OR REPLACE INTO {table} ({names}) VALUES ({places})");
    let values: Vec<&dyn ToSql> = row.iter().map(|(_, value)| *value).collect();
    t.prepare_cached(&sql)?.execute(&*values)?;
    Ok(())
}

/// Rounded to what the figure is worth, so that the file does not depend on the last bits.
fn rounded(x: f64) -> f64 {
    format::rounded(if x.abs() < 1e-9 { 0.0 } else { x }, 4)
}

fn layout(t: &Transaction<'_>, id: &str, laid: &Laid) -> rusqlite::Result<()> {
    let (l, f) = (&laid.layout.looks, &laid.figures);
    let end = |w: Option<StrokeEnd>| w.map(StrokeEnd::word);
    // Tips and drive as they grip: as they open, in a hole.
    let grips = laid.layout.limits.task.grip.sign();
    let tip = |n: usize, k: usize| l.tips.get(n).map(|t| rounded(grips * t[k]));
    let turn = f.turns.iter().fold(0.0, |m: f64, t| m.max(*t));
    put(
        t,
        "layouts",
        &[
            ("structure", &id),
            ("mechanism", &laid.file),
            ("start", &laid.layout.start),
            ("crossings", &number(l.crossings)),
            ("link_ratio", &rounded(l.ratio)),
            ("area", &rounded(area(laid))),
            ("opening_min", &rounded(f.openings[0])),
            ("opening_max", &rounded(f.openings[1])),
            ("travel", &rounded(f.travel)),
            ("closes", &if grips * f.closes > 0.0 { 1 } else { -1 }),
            ("force_min", &rounded(f.force[0])),
            ("force_mean", &rounded(f.force[1])),
            ("force_max", &rounded(f.force[2])),
            ("jaw_a_motion", &f.jaws[0].name()),
            ("jaw_b_motion", &f.jaws[1].name()),
            ("jaw_c_motion", &f.jaws.get(2).map(|m| m.name())),
            ("tip_a_dx", &tip(0, 0)),
            ("tip_a_dy", &tip(0, 1)),
            ("tip_b_dx", &tip(1, 0)),
            ("tip_b_dy", &tip(1, 1)),
            ("tip_c_dx", &tip(2, 0)),
            ("tip_c_dy", &tip(2, 1)),
            ("jaw_turn", &rounded(turn.to_degrees())),
            ("ends_closing", &end(f.ends[0])),
            ("ends_opening", &end(f.ends[1])),
            ("mobility", &number(laid.as_built.0)),
            ("redundant", &number(laid.as_built.1)),
            ("finite", &known(&laid.finite)),
            ("determinate", &count(&laid.determinate(None))),
            ("determinate_w1", &count(&laid.determinate(Some(1)))),
            ("orbits_w1", &count(&laid.orbits())),
            ("certainty", &certainty(laid.exact)),
            ("best_cost", &best_cost(&laid.ideas).map(milli)),
        ],
    )?;
    stroke(t, id, laid)?;
    planes(t, id, &f.stacking)?;
    found(t, id, &laid.counts, &laid.symmetric, &laid.ideas)
}

/// Enters what a layout does of its task.
fn stroke(t: &Transaction<'_>, id: &str, laid: &Laid) -> rusqlite::Result<()> {
    let (task, f) = (&laid.layout.limits.task, &laid.figures);
    let reached = !f.shortfall.as_ref().is_some_and(|s| s.is_of_reach);
    put(
        t,
        "strokes",
        &[
            ("structure", &id),
            ("narrowest", &task.narrowest),
            ("widest", &task.widest),
            ("reached", &reached),
            ("force_ratio", &rounded(f.force[2] / f.force[0])),
            ("transmission", &rounded(f.transmission)),
            ("pin_force", &rounded(f.forces.peak)),
            ("efficiency", &rounded(f.forces.efficiency)),
            ("width", &rounded(f.size[0])),
            ("height", &rounded(f.size[1])),
            ("margin_closing", &rounded(f.margin[0])),
            ("margin_opening", &rounded(f.margin[1])),
            ("shortfall", &f.shortfall.as_ref().map(ToString::to_string)),
        ],
    )
}

/// Enters the planes in which the links pass each other, where they were looked for.
fn planes(t: &Transaction<'_>, id: &str, stacking: &Stacking) -> rusqlite::Result<()> {
    let (planes, links) = match stacking {
        Stacking::NotAsked => return Ok(()),
        Stacking::Meets => (None, None),
        Stacking::Planes { planes, .. } => (Some(number(*planes)), Some(stacking.to_string())),
    };
    put(
        t,
        "planes",
        &[("structure", &id), ("planes", &planes), ("links", &links)],
    )
}

/// Enters a drawn mechanism.
pub(super) fn drawn(t: &Transaction<'_>, d: &DrawnMechanism) -> rusqlite::Result<()> {
    let all: BigUint = d.counts.values().sum();
    put(
        t,
        "drawn",
        &[
            ("id", &d.id),
            ("name", &d.name),
            ("description", &d.description),
            ("links", &number(d.size[0])),
            ("joints", &number(d.size[1])),
            ("contours", &number(d.size[2])),
            ("mode", &d.mode),
            ("input", &d.input),
            ("mechanism", &d.file),
            ("mobility", &number(d.as_built.0)),
            ("redundant", &number(d.as_built.1)),
            ("finite", &d.finite),
            ("determinate", &count(&all)),
            ("admissible", &count(&d.admissible)),
            ("certainty", &certainty(d.exact)),
            ("ideas_asked", &number(d.ideas_asked)),
            ("best_cost", &best_cost(&d.ideas).map(milli)),
        ],
    )?;
    // Another search of the same mechanism may have kept more.
    for table in ["counts", "ideas"] {
        t.execute(
            &format!("DELETE FROM {table} WHERE structure = ?1"),
            [&d.id],
        )?;
    }
    found(t, &d.id, &d.counts, &d.symmetric, &d.ideas)
}

fn certainty(exact: bool) -> &'static str {
    if exact { "exact" } else { "at least" }
}

/// Enters what a search has found.
fn found(
    t: &Transaction<'_>,
    id: &str,
    of: &BTreeMap<(i64, u32), BigUint>,
    symmetric: &Symmetric,
    list: &[IdeaRow],
) -> rusqlite::Result<()> {
    for (key, n) in of {
        let (own, orbits) = symmetric.split(key, n);
        put(
            t,
            "counts",
            &[
                ("structure", &id),
                ("mobility", &key.0),
                ("changes", &key.1),
                ("variants", &count(n)),
                ("orbits", &count(&orbits)),
                ("symmetric", &count(&own)),
            ],
        )?;
    }
    for (i, idea) in list.iter().enumerate() {
        let term = |t: Term| idea.scores.as_ref().map(|s| rounded(s.value(t)));
        put(
            t,
            "ideas",
            &[
                ("structure", &id),
                ("place", &number(i + 1)),
                ("changes", &idea.changes),
                ("choices", &choices(idea)),
                ("cost", &milli(idea.cost_milli)),
                ("change_count", &idea.change_count),
                ("variants", &count(&idea.variants)),
                ("peak_force", &term(Term::PeakForce)),
                ("peak_moment", &term(Term::PeakMoment)),
                (
                    "output_error",
                    &term(Term::OutputError).map(|x| rounded(1e3 * x)),
                ),
            ],
        )?;
    }
    Ok(())
}

/// Returns the least cost of some ideas, in thousandths; `None` if there are none.
fn best_cost(ideas: &[IdeaRow]) -> Option<i64> {
    ideas.iter().map(|i| i.cost_milli).min()
}

fn choices(idea: &IdeaRow) -> String {
    let words: Vec<String> = idea.choices.iter().map(ToString::to_string).collect();
    words.join(" ")
}

#[allow(clippy::cast_precision_loss, reason = "costs are small")]
fn milli(cost: i64) -> f64 {
    cost as f64 / 1000.0
}

/// Area of the box round joints and tips, in square millimetres.
fn area(laid: &Laid) -> f64 {
    let [width, height] = sides(&laid.layout.at.points);
    width * height
}
