//! An analysis for people: the verdict first, then where each figure comes from.

use crate::format::phrase::plural;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::method::{Answer, MobilityMethod};
use crate::redundancy::analysis::StateAnalysis;
use crate::redundancy::stress::{SelfStress, Verdict};
use crate::view::layout::{fit, table};
use crate::view::suggestions::{self, Advice};
use crate::view::words::{self, Shape};
use itertools::Itertools;
use std::fmt::Write;

/// The whole analysis, with what single changes would do in each state, fitted to a terminal of `width` columns where
/// one is given.
#[must_use]
pub fn analysis(
    mechanism: &Mechanism,
    states: &[StateAnalysis],
    advice: &[Advice],
    width: Option<u16>,
) -> String {
    let mut out = String::new();
    for (i, s) in states.iter().enumerate() {
        if i > 0 {
            out.push('\n');
        }
        // Writing to a string cannot fail.
        let _ = state(&mut out, mechanism, s, width);
        if let Some(advice) = advice.get(i) {
            out.push_str(&suggestions::text(mechanism, s, advice, width));
        }
    }
    fit(&out, width)
}

fn state(
    out: &mut String,
    mechanism: &Mechanism,
    s: &StateAnalysis,
    width: Option<u16>,
) -> std::fmt::Result {
    let verdict = match s.redundant {
        0 => "statically determinate".to_owned(),
        n => plural(n, "redundant constraint"),
    };
    writeln!(
        out,
        "{}, state {}: {verdict}, mobility {}",
        mechanism.name, s.state, s.mobility
    )?;
    writeln!(out)?;
    let rows = s.rows;
    let couplings = match s.per_coupling.len() {
        0 => String::new(),
        c => format!(", c = {}", plural(c, "coupling")),
    };
    writeln!(
        out,
        "  n = {} links, p = {} joints, k = {} contours, f = {} freedoms{couplings}",
        s.links, s.joints, s.contours, s.freedoms
    )?;
    writeln!(
        out,
        "  rank of the {rows} x {} closure matrix: {}",
        s.freedoms, s.rank
    )?;
    writeln!(
        out,
        "  W = f - rank = {} (in this pose): working {}, local {}",
        s.mobility, s.working_mobility, s.local_mobility
    )?;
    writeln!(
        out,
        "  finite mobility {}: {}",
        s.finite.figure(),
        s.finite.describe()
    )?;
    writeln!(
        out,
        "  σ = {rows} - rank = {}  (= W + {rows} - f)",
        s.redundant
    )?;
    if s.formula_mobility != i64::try_from(s.mobility).unwrap_or(-1) {
        writeln!(
            out,
            "  counting alone (Malyshev's formula) says {}, wrong by the redundant constraints",
            s.formula_mobility
        )?;
    }
    for motion in words::idle_list(mechanism, &s.idle) {
        writeln!(out, "  idle: {motion}")?;
    }
    for (j, n) in &s.left_out {
        writeln!(
            out,
            "  left out in the plane: {} of joint {}",
            plural(*n, "freedom"),
            mechanism.joints[*j].id
        )?;
    }
    writeln!(out, "  {}", s.certainty.describe())?;
    if let Some(choice) = &s.choice {
        writeln!(out, "  method: {choice}")?;
    }
    for moved in &s.snapped {
        writeln!(out, "  snapped: {moved}")?;
    }
    if let Some(rank) = s.as_written {
        writeln!(
            out,
            "  as written, every digit at its word: mobility {}, σ = {}",
            s.freedoms - rank,
            s.rows - rank
        )?;
    }
    if !s.per_contour.is_empty() || !s.per_coupling.is_empty() {
        let rows = s.per_contour.iter().map(|c| {
            let (least, greatest) = c.range;
            let range = if least == greatest {
                least.to_string()
            } else {
                format!("{least} to {greatest}")
            };
            vec![
                c.contour.name(mechanism),
                c.contour
                    .joints
                    .iter()
                    .map(|(j, _)| mechanism.joints[*j].id.as_str())
                    .join(", "),
                c.redundant.to_string(),
                range,
            ]
        });
        let couplings = s.per_coupling.iter().map(|c| {
            let range = if c.most == 0 { "0" } else { "0 to 1" };
            vec![
                "coupling".to_owned(),
                c.name.clone(),
                c.redundant.to_string(),
                range.to_owned(),
            ]
        });
        writeln!(
            out,
            "\n{}",
            table(
                &["contour", "joints", "σ in this order", "σ over all orders"],
                rows.chain(couplings).collect(),
                width
            )
        )?;
    }
    if let Some(e) = &s.external {
        writeln!(
            out,
            "\n  External: σ = {} constraints - ({} - {}) - {} lost mobilities = {}; by rank {}{}",
            e.constraints,
            e.actual_mobility,
            e.working_mobility,
            e.lost_mobility,
            e.redundant,
            e.by_rank,
            if e.redundant == e.by_rank {
                ""
            } else {
                "  -- THESE DISAGREE"
            }
        )?;
    }
    if !s.self_stresses.is_empty() {
        let rows = s.self_stresses.iter().map(|t| stress_row(mechanism, s, t));
        writeln!(
            out,
            "\n{}",
            table(
                &["self-stress in contour", "carried at", "as", ""],
                rows.collect(),
                width
            )
        )?;
        writeln!(
            out,
            "  harmful: loads joints when parts are out of true; harmless: friction shared by the contacts"
        )?;
    }
    Ok(())
}

/// A mobility by one method, where that is all there is.
#[must_use]
pub fn by_method(
    mechanism: &Mechanism,
    method: &dyn MobilityMethod,
    answers: &[(StateId, Answer)],
) -> String {
    let mut out = String::new();
    for (s, answer) in answers {
        let shape = Shape::of(mechanism, *s);
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "{}, state {}: mobility {} by {}, so σ = W + {} - f = {}",
            mechanism.name,
            mechanism.states[*s],
            answer.mobility,
            method.title(),
            shape.rows,
            answer.mobility + shape.rows - shape.freedoms
        );
    }
    let _ = writeln!(
        out,
        "  {} ({}; {})",
        method.guarantee(),
        method.source(),
        method.complexity()
    );
    out
}

fn stress_row(mechanism: &Mechanism, s: &StateAnalysis, stress: &SelfStress) -> Vec<String> {
    let contours = stress
        .contours
        .iter()
        .map(|&c| s.per_contour[c].contour.name(mechanism))
        .chain(
            stress
                .couplings
                .iter()
                .map(|&q| s.per_coupling[q].name.clone()),
        )
        .join(" + ");
    // At the contacts, where there are any, since that is where external redundancy is felt.
    let shown = stress
        .joints
        .iter()
        .filter(|w| !stress.external || mechanism.joints[w.joint].states.is_some())
        .min_by_key(|w| w.moments.iter().chain(&w.forces).filter(|x| **x).count());
    let (joint, what) = shown.map_or((String::new(), String::new()), |w| {
        (mechanism.joints[w.joint].id.clone(), words::wrench(w))
    });
    let verdict = match (stress.external, stress.verdict) {
        (true, Verdict::Harmless) => "harmless",
        (true, Verdict::Harmful) | (false, _) => "harmful",
    };
    vec![contours, joint, what, verdict.to_owned()]
}
