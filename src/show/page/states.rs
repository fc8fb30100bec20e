//! The original mechanism, state by state: figures, drawings, contours and self-stresses.

use super::contents::Page;
use super::symbols::state_swaps;
use super::verdict;
use crate::draw::{Subject, kinematic_with, scheme};
use crate::format::count_noun;
use crate::model::mechanism::{Mechanism, Mode, StateId};
use crate::redundancy::analysis::{ContourShare, External};
use crate::redundancy::stress::SelfStress;
use crate::view::analysis::text::{external_formula, in_any_basis, in_any_order};
use crate::view::analysis::{Analysis, State, harm_word, ranks_agree};
use maud::{Markup, PreEscaped, html};

/// Returns a line on the mechanism's size.
pub(super) fn size_facts(m: &Mechanism, analysis: &Analysis<'_>) -> String {
    let plane = match m.mode {
        Mode::Planar { .. } => "planar, three equations a contour",
        Mode::Spatial => "spatial, six equations a contour",
    };
    let first = analysis.states.first();
    let [links, joints, contours] = first.map_or([0; 3], |s| {
        [s.found.links, s.found.joints, s.found.contours]
    });
    [
        count_noun(links, "link"),
        count_noun(joints, "joint"),
        count_noun(contours, "contour"),
        plane.to_owned(),
        format!("lengths in {}", m.length_unit.symbol),
    ]
    .join(" · ")
}

pub(super) fn states_html(page: &Page<'_>, analysis: &Analysis<'_>) -> Markup {
    let several = analysis.states.len() > 1;
    html! {
        @for (i, (s, id)) in analysis.states.iter().zip(page.mechanism.state_ids()).enumerate() {
            @if several {
                h3 id={ "state-" (i) } { "State " (s.found.state) ": " (verdict::verdict_head(s).to_lowercase()) }
            }
            (figures_html(s))
            (drawings_html(page, s, id))
            (contours_html(s))
        }
    }
}

/// Returns the two schemes. The kinematic one has room for the joints of redesigns.
fn drawings_html(page: &Page<'_>, s: &State<'_>, state: StateId) -> Markup {
    let subject = Subject {
        mechanism: page.mechanism,
        state,
        analysis: Some(s.found),
        marks: None,
    };
    let redesigns = page.redesigns.as_ref().ok();
    let swaps = redesigns.map(|r| state_swaps(page.mechanism, r.found, state));
    let kinematic = kinematic_with(&subject, &swaps.unwrap_or_default());
    html! {
        div.drawings {
            @for (kind, name, drawn) in [
                ("scheme", "Structural scheme", scheme(&subject)),
                ("kinematic", "Kinematic scheme", kinematic),
            ] {
                figure.drawing data-state=(state.index()) data-kind=(kind) tabindex="0" role="group"
                    aria-label={ (name) ", state " (s.found.state) } {
                    "\n" (PreEscaped(drawn.svg))
                }
            }
        }
    }
}

/// Returns the figures with their sources.
fn figures_html(state: &State<'_>) -> Markup {
    let (s, finite) = (state.found, state.finite_mobility());
    let row = |sign: &str, value: i64, words: &str| {
        html! { div { dt { (sign) } dd { b { (value) } " " (words) } } }
    };
    let int = |n: usize| i64::try_from(n).unwrap_or(i64::MAX);
    html! {
        dl.figures {
            (row("σ", int(s.redundant), &format!("redundant constraints = {} - rank {}", count_noun(s.rows, "equation"), s.rank)))
            (row("W", int(s.mobility), &format!(
                "mobility = {} - rank {}; working {}, idle {}",
                count_noun(s.freedoms, "freedom"), s.rank, s.working_mobility, s.local_mobility
            )))
            @if finite != Some(s.mobility) {
                (row("", int(s.finite.mobility), &match finite {
                    Some(_) => "finite mobility".to_owned(),
                    None => format!("lower bound of finite mobility; it is at most {}", s.finite.at_most()),
                }))
            }
            @if state.counting_is_wrong() {
                (row("", s.formula_mobility,
                    "is what counting alone (Malyshev's formula) gives, wrong by the redundant constraints"))
            }
            @if let Some(e) = &s.external { (row("σ ext.", e.redundant, &external_words(e))) }
        }
    }
}

fn external_words(e: &External) -> String {
    let disagree = if ranks_agree(e) {
        ""
    } else {
        ": THESE DISAGREE"
    };
    let (formula, by_rank) = (external_formula(e), e.by_rank);
    format!("external = {formula}; by rank {by_rank}{disagree}")
}

/// Returns the contours, each with the self-stresses that end in it.
fn contours_html(s: &State<'_>) -> Markup {
    let all = &s.found.per_contour;
    if all.is_empty() {
        return html! { p { "There is no closed contour, so nothing can be redundant." } };
    }
    html! {
        div.wide tabindex="0" role="group" aria-label={ "Contours, state " (s.found.state) } {
            table.contours {
                caption {
                    "Contours and the self-stresses in them: loads that inaccurate parts cause by themselves. σ of a contour \
                     depends on the order in which contours are counted, and on the basis they are of; the ranges are over all orders of \
                     these contours, and over all bases that have the contour."
                }
                thead {
                    tr {
                        th scope="col" { "Contour" }
                        th scope="col" { "Joints" }
                        th.n scope="col" { "σ" }
                        th.n scope="col" { "in any order" }
                        th.n scope="col" { "over all bases" }
                        th scope="col" { "Self-stresses: where each is simplest, as what there, and the share that each joint bears" }
                    }
                }
                tbody { @for (i, c) in all.iter().enumerate() { (contour_row(s, i, c)) } }
            }
        }
    }
}

fn contour_row(s: &State<'_>, i: usize, c: &ContourShare) -> Markup {
    let m = s.mechanism;
    let joints = c.contour.joints.iter().map(|(j, _)| &m.joints[*j].id);
    let ending = s.found.self_stresses.iter();
    let ending = ending.filter(|t| t.contours.last() == Some(&i));
    let ending: Vec<Markup> = ending.map(|t| stress_item(s, t)).collect();
    html! {
        tr {
            th scope="row" {
                span class={ "tint t" (c.redundant.min(6)) } { (i + 1) }
                " " (c.contour.name(m))
            }
            td { @for (n, id) in joints.enumerate() { @if n > 0 { ", " } span.id { (id) } } }
            td.n { (c.redundant) }
            td.n { (in_any_order(c)) }
            td.n { (in_any_basis(c)) }
            td { @if !ending.is_empty() { ul { @for t in &ending { (t) } } } }
        }
    }
}

/// Returns a self-stress in the form with the fewest components, with the joints that bear it.
fn stress_item(s: &State<'_>, t: &SelfStress) -> Markup {
    let what = match s.simplest_joint(t) {
        Some((joint, what)) => format!("{what} at {joint}"),
        None => "none".to_owned(),
    };
    let with = match s.contours_of(t).split_last() {
        Some((_, others)) if !others.is_empty() => {
            format!(", together with {}", others.join(", "))
        }
        _ => String::new(),
    };
    let (class, why) = match harm_word(t) {
        "harmless" => ("good", ": friction shared between contacts"),
        _ => ("bad", ""),
    };
    html! {
        li {
            (what) (with) " " span class={ "tag " (class) } { (harm_word(t)) (why) }
            br; small { "borne by " (s.borne_shares(t)) }
        }
    }
}
