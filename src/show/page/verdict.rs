//! The verdict in words.

use super::contents::{Page, Redesigns};
use crate::format::{count_noun, format_cost};
use crate::redundancy::stress::StressVerdict;
use crate::score::outcome::variant::Variant;
use crate::search::answer::k_best::Assignment;
use crate::view::analysis::{Analysis, State};
use crate::view::search::counts;
use itertools::Itertools;
use maud::{Markup, html};
use num_traits::Zero;

/// The greatest number of idle motions listed.
const TOLD: usize = 4;

pub(super) fn verdict_html(page: &Page<'_>, analysis: &Analysis<'_>) -> Markup {
    let several = analysis.states.len() > 1;
    html! {
        @for (i, s) in analysis.states.iter().enumerate() {
            div class={ "verdict " (if s.found.redundant == 0 && s.found.at_most().is_none() { "good" } else { "bad" }) } {
                @if several { p.label { "State " (s.found.state) } }
                p.head { (verdict_head(s)) }
                p {
                    (state_sentences(s).join(" "))
                    @if i == 0 { " " (redesigns_sentence(page, s)) }
                }
            }
        }
    }
}

/// Returns the verdict in a few words.
///
/// # Examples
/// ```
/// use ozols::{page::verdict::verdict_head, view::analysis::Analysis};
/// let four_bar = ozols::built_in("four-bar")?;
/// let found = ozols::analyze(&four_bar)?;
/// assert_eq!(verdict_head(&Analysis::new(&four_bar, &found, &[]).states[0]), "3 redundant constraints");
/// # Ok::<(), ozols::Error>(())
/// ```
pub fn verdict_head(s: &State<'_>) -> String {
    capitalise_first(&s.verdict())
}

fn capitalise_first(text: &str) -> String {
    let mut rest = text.chars();
    let first = rest.next().map(|c| c.to_ascii_uppercase());
    first.into_iter().chain(rest).collect()
}

/// Returns the meaning of the verdict, in sentences.
pub fn state_sentences(told: &State<'_>) -> Vec<String> {
    let s = told.found;
    let mut out = Vec::new();
    if s.at_most().is_some() {
        return vec![format!("{}.", s.choice.as_deref().unwrap_or_default())];
    }
    out.push(
        if s.redundant == 0 {
            "Slightly inaccurate parts still assemble without strain, and the loads alone determine the joint forces."
        } else {
            "Slightly inaccurate parts bind: they must be forced together, and the joints carry load even without an external load."
        }
        .to_owned(),
    );
    if let Some(e) = s.external.as_ref().filter(|e| e.redundant > 0) {
        let of = |v: StressVerdict| {
            let external = s.self_stresses.iter().filter(|t| t.external);
            external.filter(|t| t.verdict == v).count()
        };
        let (harmless, harmful) = (of(StressVerdict::Harmless), of(StressVerdict::Harmful));
        let split = if harmless + harmful == 0 {
            String::new()
        } else {
            format!(": {harmless} harmless (friction shared between contacts), {harmful} harmful")
        };
        out.push(format!(
            "{} of them {} from the joints that this state adds{split}.",
            e.redundant,
            if e.redundant == 1 { "comes" } else { "come" }
        ));
    }
    out.push(mobility_sentence(told));
    out.extend(told.drive_faults().map(|f| capitalise_first(&f) + "."));
    let idle = told.idle_motions();
    let more = idle.len().saturating_sub(TOLD);
    if !idle.is_empty() {
        let list = idle.iter().take(TOLD).join("; ");
        let more = if more > 0 {
            format!("; and {more} more")
        } else {
            String::new()
        };
        out.push(format!("Idle: {list}{more}."));
    }
    out
}

fn mobility_sentence(told: &State<'_>) -> String {
    let s = told.found;
    let freedoms = |n: usize| match n {
        1 => "1 degree of freedom".to_owned(),
        n => format!("{n} degrees of freedom"),
    };
    let Some(finite) = told.finite_mobility() else {
        return format!(
            "W = {} in this pose; the finite mobility is undecided ({} to {}).",
            s.mobility,
            s.finite.mobility,
            s.finite.at_most()
        );
    };
    match (s.mobility, finite) {
        (0, _) => "Nothing moves in this state.".to_owned(),
        // At a dead point the motion of the drive is not idle.
        (w, f) if w == f && (s.idle.is_empty() || s.local_mobility == 0) => {
            format!("It has {} (W = {w}).", freedoms(w))
        }
        (w, f) if w == f => format!(
            "It has {} (W = {w}), {} of which {} not move the outputs.",
            freedoms(w),
            s.local_mobility,
            if s.local_mobility == 1 { "does" } else { "do" }
        ),
        (w, 0) => format!(
            "W = {w} in this pose only; no finite motion exists. The pose is shaky: small errors appear as play."
        ),
        (w, f) => format!(
            "W = {w} in this pose, but the finite mobility is {f}: the pose is singular or shaky."
        ),
    }
}

/// Returns how many redesigns there are, and the best.
fn redesigns_sentence(page: &Page<'_>, s: &State<'_>) -> String {
    let r = match &page.redesigns {
        Ok(r) => r,
        Err(why) => return format!("Redesigns were not searched: {why}"),
    };
    let unchanged = s.found.redundant == 0 && r.variants.iter().any(|c| c.change_count() == 0);
    let nothing = if unchanged {
        "Nothing needs changing. "
    } else {
        ""
    };
    let best = if unchanged || r.found.listed_counts().total.is_zero() {
        String::new()
    } else {
        best_words(r)
    };
    let more = counts::pose_lines(r.found, false).into_iter();
    let more: String = more
        .map(|line| format!(" {}.", capitalise_first(&line)))
        .collect();
    let verdict = capitalise_first(&counts::verdict_line(r.found));
    format!("{nothing}{verdict}{best}.{more}")
}

/// Returns a description of the best variant.
fn best_words(r: &Redesigns<'_>) -> String {
    let search = &r.found.search;
    let like = |v: &Assignment| match v.key.changes() {
        0 => "changes nothing".to_owned(),
        n => format!(
            "changes {} at cost {}",
            count_noun(n as usize, "joint"),
            format_cost(search.steps.cost_in_milli(v.key.cost()))
        ),
    };
    let cheapest = r.variants.iter().map(Variant::assignment);
    match (&r.found.ranking, r.variants.first()) {
        (Some(p), Some(first)) => {
            let cheapest = p.cheapest.as_ref().map_or(String::new(), |c| {
                format!("; the cheapest that bears them {}", like(&c.variant))
            });
            format!(
                "; the best under the loads {}{cheapest}",
                like(first.assignment())
            )
        }
        (Some(_), None) => "; none of those scored is in equilibrium within the limits".to_owned(),
        (None, _) => cheapest
            .min_by_key(|v| v.key.cost())
            .map_or(String::new(), |v| format!("; the cheapest {}", like(v))),
    }
}
