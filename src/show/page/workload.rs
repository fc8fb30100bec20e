//! What the joints of each variant bear, and its scores, where the file states loads.

use super::contents::Redesigns;
use crate::model::ranking::Term;
use crate::score::evaluation::joint_loads::{Bearing, Bearings};
use crate::score::evaluation::terms::Scores;
use crate::score::outcome::ranking::{Ranked, RankedPool};
use crate::view::search::ranking::{head, notes};
use serde::{Serialize, Serializer};

/// Columns of the variants; `None` in them where the loads of a variant have no equilibrium.
#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum WorkloadColumns {
    Failed { failed: String },
    Scored(Box<Columns>),
}

type Column<T> = Vec<Option<T>>;

#[derive(Serialize)]
pub(super) struct Columns {
    poses: usize,
    stopped: Option<f64>,
    peak_force: Column<PageNumber>,
    peak_moment: Column<PageNumber>,
    conditioning: Column<PageNumber>,
    output_error_mm: Column<PageNumber>,
    minimum_norm: Column<bool>,
    /// By joint, as the three after it.
    force: Column<Column<PageNumber>>,
    moment: Column<Column<PageNumber>>,
    force_share: Column<Column<PageNumber>>,
    moment_share: Column<Column<PageNumber>>,
    ranked: Option<RankingColumns>,
}

/// The ranking; `None` where a variant is not in its list.
#[derive(Serialize)]
struct RankingColumns {
    head: String,
    notes: Vec<String>,
    terms: Vec<&'static str>,
    by_cost: Column<usize>,
    total: Column<PageNumber>,
    front: Column<usize>,
    reason: Column<String>,
}

/// What one variant scores; `None` where its loads have no equilibrium.
type Scored = Option<(Scores, Vec<Option<Bearing>>)>;

/// What is this small beside the greatest of its kind is rounding.
const NOTHING: f64 = 1e-9;
/// A moment of the greatest force on an arm as short as this, in metres, is too.
const ARM: f64 = 1e-12;

/// Scores and bearings of the variants for the script; none where the file states no loads and asks for no ranking.
pub(super) fn workload(r: &Redesigns<'_>) -> Option<WorkloadColumns> {
    let Bearings {
        poses,
        stopped,
        of: scored,
    } = match r.found.bearings(&r.variants) {
        Ok(bearings) => bearings?,
        Err(why) => {
            return Some(WorkloadColumns::Failed {
                failed: why.to_string(),
            });
        }
    };
    let term = |t: Term| column(&scored, |s| PageNumber::measured(s.value(t)));
    Some(WorkloadColumns::Scored(Box::new(Columns {
        poses,
        stopped,
        peak_force: term(Term::PeakForce),
        peak_moment: term(Term::PeakMoment),
        conditioning: term(Term::Conditioning),
        output_error_mm: column(&scored, |s| PageNumber::measured(1e3 * s.output_error)),
        minimum_norm: column(&scored, |s| s.minimum_norm),
        force: joints(&scored, |b| Some(b.force), 0.0),
        moment: joints(&scored, |b| Some(b.moment), ARM),
        force_share: joints(&scored, |b| Some(b.force_share), 0.0),
        moment_share: joints(&scored, |b| b.moment_share, 0.0),
        ranked: r.found.ranking.as_ref().map(|p| RankingColumns::new(r, p)),
    })))
}

fn column<T>(scored: &[Scored], of: impl Fn(&Scores) -> T) -> Column<T> {
    let one = |s: &Scored| s.as_ref().map(|(s, _)| of(s));
    scored.iter().map(one).collect()
}

/// A figure of every joint; what is below `beside` of the greatest force is rounding.
fn joints(
    scored: &[Scored],
    of: fn(&Bearing) -> Option<f64>,
    beside: f64,
) -> Column<Column<PageNumber>> {
    let one = |list: &Vec<Option<Bearing>>| {
        let values = list.iter().map(|b| b.as_ref().and_then(of));
        let greatest = values.clone().flatten().fold(0.0, f64::max);
        let forces = list.iter().flatten().map(|b| b.force);
        let least = (NOTHING * greatest).max(beside * forces.fold(0.0, f64::max));
        let clean = |x: f64| PageNumber::measured(if x < least { 0.0 } else { x });
        values.map(|x| x.map(clean)).collect()
    };
    let all = scored.iter();
    all.map(|s| s.as_ref().map(|(_, list)| one(list))).collect()
}

impl RankingColumns {
    fn new(r: &Redesigns<'_>, p: &RankedPool) -> RankingColumns {
        let m = &r.found.search.mechanism;
        let all: Column<&Ranked> = r.variants.iter().map(|v| v.ranked()).collect();
        RankingColumns {
            head: head(p),
            notes: notes(m, p),
            terms: p.ranking.terms.iter().map(|(t, _)| t.name()).collect(),
            by_cost: all.iter().map(|x| x.map(|r| r.by_cost)).collect(),
            total: all
                .iter()
                .map(|x| x.and_then(|r| r.total).map(PageNumber::measured))
                .collect(),
            front: all.iter().map(|x| x.and_then(|r| r.front)).collect(),
            reason: r.variants.iter().map(|v| v.reason()).collect(),
        }
    }
}

/// A number; whole ones without a `.0`, and null where it is none.
#[derive(Clone, Copy)]
pub(super) struct PageNumber(f64);

impl PageNumber {
    /// To five significant digits.
    pub(super) fn measured(x: f64) -> PageNumber {
        PageNumber(format!("{x:.4e}").parse().unwrap_or(f64::NAN))
    }
}

impl Serialize for PageNumber {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        #[allow(clippy::cast_possible_truncation, reason = "whole and below 2^53")]
        if self.0.fract() == 0.0 && self.0.abs() < 1e15 {
            to.serialize_i64(self.0 as i64)
        } else {
            to.serialize_f64(self.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::PageNumber;

    #[test]
    fn numbers_are_short() {
        let of = |x| serde_json::to_string(&PageNumber::measured(x)).unwrap();
        assert_eq!(of(2.0), "2");
        assert_eq!(of(0.022_345_678), "0.022346");
        assert_eq!(of(f64::NAN), "null");
    }
}
