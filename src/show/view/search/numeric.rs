//! A search by singular values: counts between what is sure and what may be, as text and as data.

use crate::search::answer::counts::Counts;
use crate::search::at_tolerance::{AtTolerance, Bracket, Sampled, Share};
use crate::view::prelude::*;

/// Returns a number or a range: "12", or "12 to 15".
pub(crate) fn from_to(bracket: &Bracket) -> String {
    let from = &bracket.sure.total;
    if bracket.is_narrow() {
        return group_thousands(from);
    }
    format!(
        "{} to {}",
        group_thousands(from),
        group_thousands(&bracket.most)
    )
}

/// Returns the counts by mobility for people: "12", or "12 to 15".
pub(crate) fn by_mobility(bracket: &Bracket, of: &[i64]) -> String {
    let sum = |c: &Counts| -> BigUint { of.iter().filter_map(|w| c.by_mobility.get(w)).sum() };
    let (sure, doubtful) = (sum(&bracket.sure), sum(&bracket.doubtful));
    format_span(group_thousands(&sure), group_thousands(&sure + doubtful))
}

/// Returns the mobilities that some variants have or may have.
pub(crate) fn all_mobilities(found: &AtTolerance) -> BTreeSet<i64> {
    let brackets = [&found.determinate, &found.admissible];
    let counts = brackets.into_iter().flat_map(|b| [&b.sure, &b.doubtful]);
    counts.flat_map(|c| c.by_mobility.keys().copied()).collect()
}

/// Returns the remarks on a search by singular values, a sentence a line. Empty for an exact one.
pub(crate) fn numeric_lines(outcome: &Outcome) -> Vec<String> {
    let Some(found) = &outcome.numeric else {
        return Vec::new();
    };
    let tolerance = found.digits.tolerance;
    let looked = group_thousands(found.looked);
    let mut out = vec![format!(
        "Numeric, not exact: ranks by singular values at tolerance {tolerance:.0e}, {looked} variants examined"
    )];
    if found.digits.undecided {
        out.push("The intended geometry is undecided: small values may be zero or not".to_owned());
    }
    let doubtful = &found.admissible.doubtful.total;
    if !doubtful.is_zero() {
        out.push(format!(
            "Doubtful: the digits do not decide {} of them; these are counted in the upper figures and not listed",
            group_thousands(doubtful)
        ));
    }
    if let Some(s) = &found.sampled {
        out.extend(sampled_lines(s, outcome));
    }
    out
}

#[allow(clippy::cast_precision_loss, reason = "an estimate")]
fn sampled_lines(s: &Sampled, outcome: &Outcome) -> Vec<String> {
    let size: f64 = outcome
        .search
        .size()
        .to_string()
        .parse()
        .unwrap_or(f64::INFINITY);
    let said = |share: Share, what: &str| {
        format!(
            "{what} {:.2e} ({:.2e} to {:.2e})",
            share.mean * size,
            share.low * size,
            share.high * size
        )
    };
    let mut out = vec![format!(
        "Estimated from {} variants drawn at random ({}), with 95 % confidence: {}, {}",
        group_thousands(s.drawn),
        typed_option("seed", s.seed),
        said(s.admissible, "admissible"),
        said(s.determinate, "determinate")
    )];
    let in_order = group_thousands(s.in_order);
    out.push(match s.all_below {
        Some(milli) => format!(
            "The list is of the {in_order} cheapest variants, which are all of a cost below {}",
            crate::format::format_cost(milli)
        ),
        None => {
            "Costs differ too finely to examine variants in their order: none is listed".to_owned()
        }
    });
    out
}

/// Returns a search by singular values as data.
pub(crate) fn numeric_json(found: &AtTolerance) -> Value {
    let bracket = |from: &BigUint, to: &BigUint, doubtful: &BigUint| json!({ "from": from.to_string(), "to": to.to_string(), "doubtful": doubtful.to_string() });
    let whole = |b: &Bracket| bracket(&b.sure.total, &b.most, &b.doubtful.total);
    let of = &found.admissible;
    let unseen = &of.most - &of.sure.total - &of.doubtful.total;
    let with = |w: i64| {
        let one = |c: &Counts| c.by_mobility.get(&w).cloned().unwrap_or_default();
        let (sure, doubtful) = (one(&of.sure), one(&of.doubtful));
        let most = &sure + &doubtful + &unseen;
        (w.to_string(), bracket(&sure, &most, &doubtful))
    };
    let keys = [&of.sure, &of.doubtful].into_iter();
    let keys: BTreeSet<i64> = keys.flat_map(|c| c.by_mobility.keys().copied()).collect();
    let share = |s: Share| [s.mean, s.low, s.high];
    #[allow(clippy::cast_precision_loss, reason = "costs are small")]
    let sample = |s: &Sampled| {
        json!({
            "drawn": s.drawn,
            "seed": s.seed,
            "confidence": 0.95,
            "determinate_share": share(s.determinate),
            "admissible_share": share(s.admissible),
            "in_order": s.in_order,
            "all_below_cost": s.all_below.map(|milli| milli as f64 / 1000.0),
        })
    };
    json!({
        "tolerance": found.digits.tolerance,
        "undecided": found.digits.undecided,
        "looked_at": found.looked,
        "determinate": whole(&found.determinate),
        "admissible": whole(of),
        "admissible_by_mobility": keys.into_iter().map(with).collect::<Value>(),
        "sample": found.sampled.as_ref().map(sample),
    })
}
