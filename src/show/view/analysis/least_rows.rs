//! The rows of the closure equations that are enough for their rank.

use crate::model::mechanism::Mechanism;
use crate::rank::reduce::axis_names::Direction;
use crate::rank::reduce::sufficient_rows::{LeastRows, Motions};
use crate::redundancy::analysis::StateAnalysis;
use itertools::Itertools;
use serde_json::{Value, json};

/// Returns those of a state as data: rows of some contours for some motions; none where all rows are taken as they are, and where rounded coordinates do not decide the rank.
#[must_use]
pub(crate) fn least_rows(mechanism: &Mechanism, s: &StateAnalysis) -> Value {
    let found = s.least_rows.as_ref().filter(|l| !LeastRows::is_all(l));
    let Some(found) = found.filter(|_| s.at_most().is_none()) else {
        return json!([]);
    };
    let blocks = found.blocks.iter().filter(|b| !b.contours.is_empty());
    let parts = blocks.flat_map(|b| {
        let name = |&c: &usize| s.per_contour.get(c).map(|c| c.contour.name(mechanism));
        let contours = b.contours.iter().filter_map(name).collect_vec();
        b.parts.iter().map(move |part| {
            let normal = |d: &Option<Direction>| d.map(|d| d.words(mechanism));
            let (motions, of) = match &part.motions {
                Motions::All => ("any", None),
                Motions::Group(name) => ("group", Some(name.clone())),
                Motions::InPlane(d) => ("in plane", normal(d)),
                Motions::OutOfPlane(d) => ("out of plane", normal(d)),
            };
            json!({
                "contours": contours,
                // `any`, `group`, `in plane` or `out of plane`.
                "motions": motions,
                // The group with its dimension, or the plane's normal.
                "of": of,
                "rows": part.rows,
                "rows_in_all": part.of,
                "rank": part.rank,
                "redundant": part.redundant(),
            })
        })
    });
    parts.collect()
}
