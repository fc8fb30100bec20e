//! A mechanism as it is, state by state: figures, drawings, contours and self-stresses.

use super::embed::text;
use super::symbols::Drawn;
use super::{Page, verdict};
use crate::format::phrase::plural;
use crate::model::mechanism::{Mechanism, Mode};
use crate::redundancy::analysis::StateAnalysis;
use crate::redundancy::stress::{SelfStress, Verdict};
use crate::view::words;
use itertools::Itertools;
use serde_json::{Value, json};

/// The mechanism's size in a line.
pub(super) fn facts(page: &Page<'_>) -> String {
    let m = page.mechanism;
    let plane = match m.mode {
        Mode::Planar { .. } => "planar, three equations a contour",
        Mode::Spatial => "spatial, six equations a contour",
    };
    let [links, joints, contours] = page
        .states
        .first()
        .map_or([0; 3], |s| [s.links, s.joints, s.contours]);
    [
        plural(links, "link"),
        plural(joints, "joint"),
        plural(contours, "contour"),
        plane.to_owned(),
        format!("lengths in {}", m.length_unit.symbol),
    ]
    .iter()
    .map(|t| text(t))
    .join(" · ")
}

/// Figures of the states, for the script.
pub(super) fn json(page: &Page<'_>) -> Value {
    let one = |s: &StateAnalysis| {
        let contours = s
            .per_contour
            .iter()
            .map(|c| json!({"name": c.contour.name(page.mechanism), "redundant": c.redundant}));
        json!({
            "name": s.state,
            "links": s.links,
            "joints": s.joints,
            "rows": s.rows,
            "freedoms": s.freedoms,
            "mobility": s.mobility,
            "redundant": s.redundant,
            "external": s.external.map(|e| e.redundant),
            "contours": contours.collect::<Vec<_>>(),
        })
    };
    page.states.iter().map(one).collect()
}

pub(super) fn html(page: &Page<'_>, drawn: &[Drawn<'_>]) -> String {
    let several = page.states.len() > 1;
    let mut out = String::new();
    for (i, (s, d)) in page.states.iter().zip(drawn).enumerate() {
        if several {
            out += &format!(
                "<h3 id=\"state-{i}\">State {}: {}</h3>\n",
                text(&s.state),
                text(&verdict::head(s).to_lowercase())
            );
        }
        out += &figures(s);
        out += "<div class=\"drawings\">\n";
        for (kind, svg, name) in [
            ("scheme", &d.scheme.svg, "Structural scheme"),
            ("kinematic", &d.kinematic.svg, "Kinematic scheme"),
        ] {
            out += &format!(
                "<figure class=\"drawing\" data-state=\"{i}\" data-kind=\"{kind}\" tabindex=\"0\" role=\"group\" \
                 aria-label=\"{name}, state {}\">\n{svg}</figure>\n",
                text(&s.state)
            );
        }
        out += "</div>\n";
        out += &contours(page.mechanism, s);
    }
    out
}

/// The figures with where they come from.
fn figures(s: &StateAnalysis) -> String {
    let rows = s.rows;
    let mut out = String::from("<dl class=\"figures\">\n");
    let mut row = |sign: &str, value: String, words: &str| {
        out += &format!(
            "<div><dt>{}</dt><dd><b>{}</b> {}</dd></div>\n",
            text(sign),
            text(&value),
            text(words)
        );
    };
    row(
        "σ",
        s.redundant.to_string(),
        &format!("redundant constraints = {rows} equations - rank {}", s.rank),
    );
    row(
        "W",
        s.mobility.to_string(),
        &format!(
            "mobility = {} freedoms - rank {}; working {}, idle {}",
            s.freedoms, s.rank, s.working_mobility, s.local_mobility
        ),
    );
    if s.finite.figure() != s.mobility.to_string() {
        row("", s.finite.figure(), "finite mobility");
    }
    if i64::try_from(s.mobility) != Ok(s.formula_mobility) {
        row(
            "",
            s.formula_mobility.to_string(),
            "is what counting alone (Malyshev's formula) gives, wrong by the redundant constraints",
        );
    }
    if let Some(e) = &s.external {
        row(
            "σ ext.",
            e.redundant.to_string(),
            &format!(
                "external = {} constraints - ({} - {}) - {} lost mobilities; by rank {}{}",
                e.constraints,
                e.actual_mobility,
                e.working_mobility,
                e.lost_mobility,
                e.by_rank,
                if e.redundant == e.by_rank {
                    ""
                } else {
                    ": THESE DISAGREE"
                }
            ),
        );
    }
    out + "</dl>\n"
}

/// The contours, each with the self-stresses that end in it.
fn contours(m: &Mechanism, s: &StateAnalysis) -> String {
    if s.per_contour.is_empty() {
        return "<p>There is no closed contour, so nothing can be redundant.</p>\n".to_owned();
    }
    let mut out = format!(
        "<div class=\"wide\" tabindex=\"0\" role=\"group\" aria-label=\"Contours, state {}\">\n<table class=\"contours\">\n\
         <caption>Contours and the self-stresses in them: loads that parts out of true cause by themselves. σ of a contour \
         depends on the order in which contours are counted; the range is over all orders.</caption>\n\
         <thead><tr><th scope=\"col\">Contour</th><th scope=\"col\">Joints</th><th scope=\"col\" class=\"n\">σ</th>\
         <th scope=\"col\" class=\"n\">range</th><th scope=\"col\">Self-stresses: where they are felt least, and as what</th></tr>\
         </thead>\n<tbody>\n",
        text(&s.state)
    );
    for (i, c) in s.per_contour.iter().enumerate() {
        let (least, greatest) = c.range;
        let range = if least == greatest {
            least.to_string()
        } else {
            format!("{least} to {greatest}")
        };
        let joints = c.contour.joints.iter();
        let joints = joints.map(|(j, _)| m.joints[*j].id.as_str()).join(", ");
        let ending = s.self_stresses.iter();
        let ending = ending.filter(|t| t.contours.last() == Some(&i));
        let list: String = ending.map(|t| stress(m, s, t)).collect();
        let list = if list.is_empty() {
            String::new()
        } else {
            format!("<ul>{list}</ul>")
        };
        out += &format!(
            "<tr><th scope=\"row\"><span class=\"tint t{}\">{}</span> {}</th><td>{}</td><td class=\"n\">{}</td>\
             <td class=\"n\">{range}</td><td>{list}</td></tr>\n",
            c.redundant.min(6),
            i + 1,
            text(&c.contour.name(m)),
            text(&joints),
            c.redundant
        );
    }
    out + "</tbody>\n</table>\n</div>\n"
}

/// A self-stress in words: at the contacts where there are any, since that is where it is felt.
fn stress(m: &Mechanism, s: &StateAnalysis, t: &SelfStress) -> String {
    let shown = t
        .joints
        .iter()
        .filter(|w| !t.external || m.joints[w.joint].states.is_some())
        .min_by_key(|w| w.moments.iter().chain(&w.forces).filter(|x| **x).count());
    let what = shown.map_or("none".to_owned(), |w| {
        format!("{} at {}", words::wrench(w), m.joints[w.joint].id)
    });
    let with = match t.contours.split_last() {
        Some((_, others)) if !others.is_empty() => {
            let others = others.iter().map(|&c| s.per_contour[c].contour.name(m));
            format!(", together with {}", others.collect_vec().join(", "))
        }
        _ => String::new(),
    };
    let (class, verdict) = match t.verdict {
        Verdict::Harmless => ("good", "harmless: friction shared by the contacts"),
        Verdict::Harmful => ("bad", "harmful"),
    };
    format!(
        "<li>{}{} <span class=\"tag {class}\">{verdict}</span></li>",
        text(&what),
        text(&with)
    )
}
