//! Insertion of a row into the tables.

use crate::catalog::general::Symmetric;
use crate::catalog::row::{IdeaRow, Laid, StructureRow};
use crate::chains::census::Kinds;
use crate::chains::classics::classics_of;
use crate::chains::graph6;
use crate::format;
use crate::geom::vector::box_sides;
use crate::model::ranking::Term;
use crate::rank::finite::{Finite, How};
use crate::synthesis::stroke::planes::Stacking;
use crate::synthesis::stroke::walk::StrokeEnd;
use itertools::Itertools;
use num_bigint::BigUint;
use rusqlite::types::ToSqlOutput;
use rusqlite::{ToSql, Transaction};
use std::collections::BTreeMap;

/// Adds a row, or replaces the existing row of the structure.
pub(super) fn insert_structure(t: &Transaction<'_>, row: &StructureRow) -> rusqlite::Result<()> {
    let of = &row.structure;
    let id = of.id();
    let whole = of.whole_structure();
    let [driven_from, driver] =
        (of.structure.roles.drive_links()).map(|l| of.side_link(l, 0).unwrap_or(0));
    let (chain, roles) = (&whole.chain, &whole.roles);
    insert_row(
        t,
        "structures",
        &[
            ("id", &id),
            ("name", &of.name()),
            ("chain", &graph6::write_graph(chain)),
            ("links", &to_integer(chain.links())),
            ("joints", &to_integer(chain.joints_made().len())),
            ("frame", &to_integer(roles.frame)),
            ("driver", &to_integer(driver)),
            ("jaw_a", &to_integer(roles.jaws[0])),
            ("jaw_b", &to_integer(roles.jaws[1])),
            ("jaw_c", &roles.jaws.get(2).map(|&l| to_integer(l))),
            ("input", &of.drive_input().name()),
            ("symmetry", &of.symmetry_name()),
            ("parallel", &of.form.parallel),
            ("jaws_at_frame", &to_integer(row.jaws_at_frame)),
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
        let flat = flat.iter().map(|j| of.copy_count(j)).sum();
        let kinds = Kinds::of_chain(chain).with_flat(flat);
        insert_row(
            t,
            "pairs",
            &[
                ("structure", &id),
                ("code", &chain.pair_code()),
                ("slides", &to_integer(kinds.slides)),
                ("gears", &to_integer(kinds.gears)),
                ("slots", &to_integer(kinds.slots_made())),
                ("driven_from", &to_integer(driven_from)),
            ],
        )?;
    }
    for classic in classics_of(&of.structure.canonical_key(), of.made_as()) {
        insert_row(
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
        Ok(laid) => insert_layout(t, &id, laid),
        Err(_) => Ok(()),
    }
}

fn to_integer(n: usize) -> i64 {
    i64::try_from(n).unwrap_or(i64::MAX)
}

/// Returns a count of any size: as a number if it fits, otherwise as its digits.
fn count_value(n: &BigUint) -> ToSqlOutput<'static> {
    match i64::try_from(n) {
        Ok(small) => small.into(),
        Err(_) => n.to_string().into(),
    }
}

/// Inserts a row into a table, each value under the name of its column.
fn insert_row(
    t: &Transaction<'_>,
    table: &str,
    row: &[(&str, &dyn ToSql)],
) -> rusqlite::Result<()> {
    let names = row.iter().map(|(name, _)| *name).join(", ");
    let places = row.iter().map(|_| "?").join(", ");
    let sql = format!("INSERT OR REPLACE INTO {table} ({names}) VALUES ({places})");
    let values: Vec<&dyn ToSql> = row.iter().map(|(_, value)| *value).collect();
    t.prepare_cached(&sql)?.execute(&*values)?;
    Ok(())
}

/// Returns a figure rounded to its accuracy, so that the file does not depend on the last bits.
fn rounded_figure(x: f64) -> f64 {
    format::round_digits(if x.abs() < 1e-9 { 0.0 } else { x }, 4)
}

fn insert_layout(t: &Transaction<'_>, id: &str, laid: &Laid) -> rusqlite::Result<()> {
    let (l, f) = (&laid.layout.looks, &laid.figures);
    let end = |w: Option<StrokeEnd>| w.map(StrokeEnd::word);
    // Tips and drive as the jaws grip: in a hole, as they open.
    let grips = laid.layout.limits.task.grip.grip_sign();
    let tip = |n: usize, k: usize| l.tips.get(n).map(|t| rounded_figure(grips * t[k]));
    let turn = f.turns.iter().fold(0.0, |m: f64, t| m.max(*t));
    insert_row(
        t,
        "layouts",
        &[
            ("structure", &id),
            ("mechanism", &laid.file),
            ("start", &laid.layout.start),
            ("crossings", &to_integer(l.crossings)),
            ("link_ratio", &rounded_figure(l.ratio)),
            ("area", &rounded_figure(box_area(laid))),
            ("opening_min", &rounded_figure(f.openings[0])),
            ("opening_max", &rounded_figure(f.openings[1])),
            ("travel", &rounded_figure(f.travel)),
            ("closes", &if grips * f.closes > 0.0 { 1 } else { -1 }),
            ("force_min", &rounded_figure(f.force[0])),
            ("force_mean", &rounded_figure(f.force[1])),
            ("force_max", &rounded_figure(f.force[2])),
            ("jaw_a_motion", &f.jaws[0].name()),
            ("jaw_b_motion", &f.jaws[1].name()),
            ("jaw_c_motion", &f.jaws.get(2).map(|m| m.name())),
            ("tip_a_dx", &tip(0, 0)),
            ("tip_a_dy", &tip(0, 1)),
            ("tip_b_dx", &tip(1, 0)),
            ("tip_b_dy", &tip(1, 1)),
            ("tip_c_dx", &tip(2, 0)),
            ("tip_c_dy", &tip(2, 1)),
            ("jaw_turn", &rounded_figure(turn.to_degrees())),
            ("ends_closing", &end(f.ends[0])),
            ("ends_opening", &end(f.ends[1])),
            ("mobility", &to_integer(laid.as_built.0)),
            ("redundant", &to_integer(laid.as_built.1)),
            ("finite", &mobility_words(&laid.finite)),
            ("determinate", &count_value(&laid.variant_count(None))),
            ("determinate_w1", &count_value(&laid.variant_count(Some(1)))),
            ("orbits_w1", &count_value(&laid.orbit_count())),
            ("certainty", &certainty_word(laid.exact)),
            ("best_cost", &best_cost(&laid.ideas).map(from_milli)),
        ],
    )?;
    insert_stroke(t, id, laid)?;
    insert_planes(t, id, &f.stacking)?;
    insert_found(t, id, &laid.counts, &laid.symmetric, &laid.ideas)
}

/// Inserts the figures of a layout for its task.
fn insert_stroke(t: &Transaction<'_>, id: &str, laid: &Laid) -> rusqlite::Result<()> {
    let (task, f) = (&laid.layout.limits.task, &laid.figures);
    let reached = !f.shortfall.as_ref().is_some_and(|s| s.is_of_reach);
    insert_row(
        t,
        "strokes",
        &[
            ("structure", &id),
            ("narrowest", &task.narrowest),
            ("widest", &task.widest),
            ("reached", &reached),
            ("force_ratio", &rounded_figure(f.force[2] / f.force[0])),
            ("transmission", &rounded_figure(f.transmission)),
            ("pin_force", &rounded_figure(f.forces.peak)),
            ("efficiency", &rounded_figure(f.forces.efficiency)),
            ("width", &rounded_figure(f.size[0])),
            ("height", &rounded_figure(f.size[1])),
            ("margin_closing", &rounded_figure(f.margin[0])),
            ("margin_opening", &rounded_figure(f.margin[1])),
            ("shortfall", &f.shortfall.as_ref().map(ToString::to_string)),
        ],
    )
}

/// Inserts the layers in which the links pass each other, if they were searched for.
fn insert_planes(t: &Transaction<'_>, id: &str, stacking: &Stacking) -> rusqlite::Result<()> {
    let (planes, links) = match stacking {
        Stacking::NotAsked => return Ok(()),
        Stacking::Meets => (None, None),
        Stacking::Planes { planes, .. } => (Some(to_integer(*planes)), Some(stacking.to_string())),
    };
    insert_row(
        t,
        "planes",
        &[("structure", &id), ("planes", &planes), ("links", &links)],
    )
}

/// Returns the mobility with the weakest word that applies to it.
fn mobility_words(finite: &Finite) -> String {
    let word = match finite.how {
        _ if finite.numeric => "numeric",
        _ if finite.is_proven() => "proven",
        How::Traced { .. } => "followed",
        How::Bound => "bound",
        _ => "undecided",
    };
    format!("{}, {word}", finite.format_figure())
}

fn certainty_word(exact: bool) -> &'static str {
    if exact { "exact" } else { "at least" }
}

/// Inserts the results of a search.
fn insert_found(
    t: &Transaction<'_>,
    id: &str,
    of: &BTreeMap<(i64, u32), BigUint>,
    symmetric: &Symmetric,
    list: &[IdeaRow],
) -> rusqlite::Result<()> {
    for (key, n) in of {
        let (own, orbits) = symmetric.split_orbits(key, n);
        insert_row(
            t,
            "counts",
            &[
                ("structure", &id),
                ("mobility", &key.0),
                ("changes", &key.1),
                ("variants", &count_value(n)),
                ("orbits", &count_value(&orbits)),
                ("symmetric", &count_value(&own)),
            ],
        )?;
    }
    for (i, idea) in list.iter().enumerate() {
        let term = |t: Term| {
            idea.scores
                .as_ref()
                .map(|s| rounded_figure(s.term_value(t)))
        };
        insert_row(
            t,
            "ideas",
            &[
                ("structure", &id),
                ("place", &to_integer(i + 1)),
                ("changes", &idea.changes),
                ("choices", &choice_words(idea)),
                ("cost", &from_milli(idea.cost_milli)),
                ("change_count", &idea.change_count),
                ("variants", &count_value(&idea.variants)),
                ("peak_force", &term(Term::PeakForce)),
                ("peak_moment", &term(Term::PeakMoment)),
                (
                    "output_error",
                    &term(Term::OutputError).map(|x| rounded_figure(1e3 * x)),
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

fn choice_words(idea: &IdeaRow) -> String {
    let words: Vec<String> = idea.choices.iter().map(ToString::to_string).collect();
    words.join(" ")
}

#[allow(clippy::cast_precision_loss, reason = "costs are small")]
fn from_milli(cost: i64) -> f64 {
    cost as f64 / 1000.0
}

/// Returns the area of the box around joints and tips, in square millimetres.
fn box_area(laid: &Laid) -> f64 {
    let [width, height] = box_sides(&laid.layout.at.points);
    width * height
}
