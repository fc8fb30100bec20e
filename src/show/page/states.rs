//! A mechanism as it is, state by state: figures, drawings, contours and self-stresses.

use super::symbols::Drawn;
use super::verdict;
use crate::format::plural;
use crate::model::mechanism::{Mechanism, Mode};
use crate::view::analysis::{Analysis, Contour, External, SelfStress, State};
use maud::{Markup, PreEscaped, html};

/// The mechanism's size in a line.
pub(super) fn facts(m: &Mechanism, analysis: &Analysis<'_>) -> String {
    let plane = match m.mode {
        Mode::Planar { .. } => "planar, three equations a contour",
        Mode::Spatial => "spatial, six equations a contour",
    };
    let first = analysis.states.first();
    let [links, joints, contours] = first.map_or([0; 3], |s| [s.links, s.joints, s.contours]);
    [
        plural(links, "link"),
        plural(joints, "joint"),
        plural(contours, "contour"),
        plane.to_owned(),
        format!("lengths in {}", m.length_unit.symbol),
    ]
    .join(" · ")
}

pub(super) fn html(analysis: &Analysis<'_>, drawn: &[Drawn<'_>]) -> Markup {
    let several = analysis.states.len() > 1;
    html! {
        @for (i, (s, d)) in analysis.states.iter().zip(drawn).enumerate() {
            @if several {
                h3 id={ "state-" (i) } { "State " (s.state) ": " (verdict::head(s).to_lowercase()) }
            }
            (figures(s))
            div.drawings {
                (drawing(i, s, "scheme", "Structural scheme", &d.scheme.svg))
                (drawing(i, s, "kinematic", "Kinematic scheme", &d.kinematic.svg))
            }
            (contours(s))
        }
    }
}

fn drawing(i: usize, s: &State<'_>, kind: &str, name: &str, svg: &str) -> Markup {
    html! {
        figure.drawing data-state=(i) data-kind=(kind) tabindex="0" role="group"
            aria-label={ (name) ", state " (s.state) } {
            "\n" (PreEscaped(svg))
        }
    }
}

/// The figures with where they come from.
fn figures(s: &State<'_>) -> Markup {
    let row = |sign: &str, value: i64, words: &str| {
        html! { div { dt { (sign) } dd { b { (value) } " " (words) } } }
    };
    let int = |n: usize| i64::try_from(n).unwrap_or(i64::MAX);
    html! {
        dl.figures {
            (row("σ", int(s.redundant), &format!("redundant constraints = {} - rank {}", plural(s.rows, "equation"), s.rank)))
            (row("W", int(s.mobility), &format!(
                "mobility = {} - rank {}; working {}, idle {}",
                plural(s.freedoms, "freedom"), s.rank, s.working_mobility, s.local_mobility
            )))
            @if s.finite_mobility != Some(s.mobility) {
                (row("", int(s.finite_mobility_at_least), &match s.finite_mobility {
                    Some(_) => "finite mobility".to_owned(),
                    None => format!("finite mobility at least, {} at most", s.finite_mobility_at_most),
                }))
            }
            @if s.counting_is_wrong() {
                (row("", s.formula_mobility,
                    "is what counting alone (Malyshev's formula) gives, wrong by the redundant constraints"))
            }
            @if let Some(e) = &s.external { (row("σ ext.", e.counted.redundant, &external(e))) }
        }
    }
}

fn external(e: &External) -> String {
    let disagree = if e.agree { "" } else { ": THESE DISAGREE" };
    let (formula, by_rank) = (e.formula(), e.counted.by_rank);
    format!("external = {formula}; by rank {by_rank}{disagree}")
}

/// The contours, each with the self-stresses that end in it.
fn contours(s: &State<'_>) -> Markup {
    if s.per_contour.is_empty() {
        return html! { p { "There is no closed contour, so nothing can be redundant." } };
    }
    html! {
        div.wide tabindex="0" role="group" aria-label={ "Contours, state " (s.state) } {
            table.contours {
                caption {
                    "Contours and the self-stresses in them: loads that parts out of true cause by themselves. σ of a contour \
                     depends on the order in which contours are counted, and on the basis they are of; the ranges are over all orders of \
                     these contours, and over all bases that have the contour."
                }
                thead {
                    tr {
                        th scope="col" { "Contour" }
                        th scope="col" { "Joints" }
                        th.n scope="col" { "σ" }
                        th.n scope="col" { "in any order" }
                        th.n scope="col" { "in any basis" }
                        th scope="col" { "Self-stresses: where each is simplest, as what there, and the share that each joint bears" }
                    }
                }
                tbody { @for (i, c) in s.per_contour.iter().enumerate() { (contour(s, i, c)) } }
            }
        }
    }
}

fn contour(s: &State<'_>, i: usize, c: &Contour<'_>) -> Markup {
    let ending = s.self_stresses.iter().filter(|t| t.ends_in == Some(i));
    let ending: Vec<Markup> = ending.map(stress).collect();
    html! {
        tr {
            th scope="row" {
                span class={ "tint t" (c.redundant.min(6)) } { (i + 1) }
                " " (c.contour)
            }
            td { (c.joints.join(", ")) }
            td.n { (c.redundant) }
            td.n { (c.range()) }
            td.n { (c.over_bases()) }
            td { @if !ending.is_empty() { ul { @for t in &ending { (t) } } } }
        }
    }
}

/// A self-stress where it has the fewest components, and who bears it.
fn stress(t: &SelfStress<'_>) -> Markup {
    let what = match &t.simplest {
        Some((joint, what)) => format!("{what} at {joint}"),
        None => "none".to_owned(),
    };
    let with = match t.contours.split_last() {
        Some((_, others)) if !others.is_empty() => {
            format!(", together with {}", others.join(", "))
        }
        _ => String::new(),
    };
    let (class, why) = match t.verdict {
        "harmless" => ("good", ": friction shared by the contacts"),
        _ => ("bad", ""),
    };
    html! {
        li {
            (what) (with) " " span class={ "tag " (class) } { (t.verdict) (why) }
            br; small { "borne by " (t.borne()) }
        }
    }
}
