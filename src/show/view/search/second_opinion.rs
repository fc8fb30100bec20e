//! What singular values of the coordinates in a file say of the counts of a search, as text and as data.

use crate::search::answer::k_best::Assignment;
use crate::search::answer::keys::Key;
use crate::search::check::second_opinion::{Contradiction, SecondOpinion};
use crate::view::prelude::*;
use crate::view::{AS_READ, with_assumptions};

/// Returns the certainty of counts that are not exact although no budget limited them.
pub(crate) fn certainty_word(outcome: &Outcome) -> Option<&'static str> {
    if !outcome.search.mechanism.assumed.is_empty() {
        return Some(AS_READ);
    }
    match (&outcome.numeric, &outcome.second) {
        (Some(_), _) => Some("numeric"),
        (None, Some(s)) if !s.agrees() => Some("contradicted"),
        (None, Some(s)) if !s.confirms() => Some("undecided"),
        _ => None,
    }
}

/// Describes the changes of a variant.
fn variant_words(outcome: &Outcome, choices: &[usize]) -> String {
    let search = &outcome.search;
    let variant = Assignment {
        choices: choices.to_vec(),
        key: Key::default(),
    };
    in_words(search, &list_changes(search, &variant))
}

fn describe_contradiction(outcome: &Outcome, c: &Contradiction) -> String {
    let [least, most] = c.numeric;
    let what = if c.elsewhere {
        "other motions of the kept links, or in the searched state".to_owned()
    } else {
        format!(
            "W = {}, σ = {}",
            format_span(least.0, most.0),
            format_span(least.1, most.1)
        )
    };
    format!(
        "singular values contradict at variant ({}): {what}, where W = {}, σ = {} is counted (smallest kept {:.1e}, largest \
         dropped {:.1e})",
        variant_words(outcome, &c.choices),
        c.exact.0,
        c.exact.1,
        c.gap.0,
        c.gap.1
    )
}

/// Returns the second opinion, a sentence a line. Empty if none was needed.
pub(crate) fn opinion_lines(outcome: &Outcome) -> Vec<String> {
    let read = with_assumptions(&outcome.search.mechanism);
    let mut out: Vec<String> = read
        .map(|r| format!("Not exact: {r}"))
        .into_iter()
        .collect();
    let Some(said) = &outcome.second else {
        return out;
    };
    if let Some(c) = &said.contradiction {
        let n = said.listed.contradicted + said.admissible.contradicted + said.all.contradicted;
        let of = said.listed.asked + said.admissible.asked + said.all.asked;
        let variant = describe_contradiction(outcome, c);
        out.push(format!(
            "Not exact: {variant}; {} of {} asked about are contradicted",
            group_thousands(n),
            group_thousands(of)
        ));
    }
    if let Some(b) = &said.below_present {
        out.push(format!(
            "Not exact: {} variants have W below {}, which the original mechanism has, although options only add freedoms",
            group_thousands(&b.variants),
            b.present
        ));
    }
    if out.is_empty() && !said.confirms() {
        out.push(match said.count_undecided() {
            0 => "Not exact: the digits of the file do not decide the geometry; give more digits or a [tolerance]".to_owned(),
            n => format!(
                "Not exact: the digits of the file do not decide {} of the variants asked about; give more digits or a \
                 [tolerance]",
                group_thousands(n)
            ),
        });
    }
    if said.agrees() {
        out.push(describe_agreement(said));
    }
    out
}

fn describe_agreement(said: &SecondOpinion) -> String {
    let n = |n: usize| group_thousands(n);
    let open = match said.count_undecided() {
        0 => String::new(),
        many => format!("; the digits do not decide {} of them", n(many)),
    };
    format!(
        "Cross-checked with singular values of the file's coordinates (tolerance {:.0e}): no contradiction among {} listed, \
         {} admissible and {} random variants (narrowest gap {:.0e}{open})",
        said.digits.tolerance,
        n(said.listed.asked),
        n(said.admissible.asked),
        n(said.all.asked),
        said.narrowest
    )
}

/// Returns the second opinion as data.
pub(crate) fn opinion_json(outcome: &Outcome) -> Option<Value> {
    let said = outcome.second.as_ref()?;
    let contradiction = said.contradiction.as_ref().map(|c| {
        let [least, most] = c.numeric;
        json!({
            "changes": variant_words(outcome, &c.choices),
            "mobility": c.exact.0,
            "redundant": c.exact.1,
            "svd_mobility": [least.0, most.0],
            "svd_redundant": [least.1, most.1],
            "smallest_kept": c.gap.0,
            "largest_dropped": c.gap.1,
        })
    });
    Some(json!({
        "agree": said.agrees() && said.count_undecided() == 0,
        "undecided": said.digits.undecided,
        "tolerance": said.digits.tolerance,
        "listed": said.listed,
        "admissible": said.admissible,
        "all": said.all,
        // There is none where no singular value was dropped.
        "narrowest_gap": Some(said.narrowest).filter(|g| g.is_finite()),
        "contradiction": contradiction,
        "below_present": said.below_present.as_ref().map(|b| b.variants.to_string()),
    }))
}
