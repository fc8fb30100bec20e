//! What couplings pass from joint to joint, beside the reactions of the joints.

use crate::statics::reactions::drives::slides;
use crate::statics::reactions::{CouplingReaction, ToothForce};
use crate::view::prelude::*;
use std::fmt::Write;

/// What a coupling passes.
#[derive(Debug, Serialize)]
pub struct CouplingForces<'a> {
    /// The two joints, each with its freedom where it has several.
    pub coupling: String,
    /// Rate of the second over that of the first, as in the file.
    pub ratio: f64,
    /// Whether gears make it, or a rack and its pinion.
    pub gear: bool,
    /// What it does at each joint.
    pub ends: [CoupledEnd<'a>; 2],
    /// The force of the teeth, part of the reactions of both joints; null where nothing says where they are.
    pub teeth: Option<TeethForces>,
    /// Whether self-stresses leave it open.
    pub open: bool,
}

/// What a coupling does at a joint.
#[derive(Debug, Serialize)]
pub struct CoupledEnd<'a> {
    /// The joint.
    pub joint: &'a str,
    /// The freedom tied.
    pub freedom: &'static str,
    /// What the joint's second link gets along it, torque of a turn and force of a slide.
    pub effort: f64,
    /// `N·m` or `N`.
    pub unit: &'static str,
}

/// A force of teeth along the pitch circles.
#[derive(Debug, Serialize)]
pub struct TeethForces {
    /// Where they touch, and the force.
    #[serde(flatten)]
    pub tooth: ToothForce,
    /// `[N]`
    pub magnitude: f64,
}

/// What was found of a state's couplings.
pub(crate) fn couplings<'a>(
    m: &'a Mechanism,
    state: StateId,
    found: &[CouplingReaction],
) -> Vec<CouplingForces<'a>> {
    let all = m.couplings_in(state).zip(found);
    let one = |(coupling, r): (&crate::model::joint_type::Coupling, &CouplingReaction)| {
        let end = |n: usize| CoupledEnd {
            joint: &m.joints[r.ends[n].joint].id,
            freedom: r.ends[n].freedom.name(),
            effort: r.efforts[n],
            unit: unit(slides(r.ends[n].freedom)),
        };
        CouplingForces {
            coupling: coupling.name(m),
            ratio: coupling.ratio.to_f64(),
            gear: coupling.gear,
            ends: [end(0), end(1)],
            teeth: r.teeth.map(|t| TeethForces {
                tooth: t,
                magnitude: t.size(),
            }),
            open: false,
        }
    };
    all.map(one).collect()
}

/// The unit of what is done along a freedom.
pub(super) fn unit(slides: bool) -> &'static str {
    if slides { "N" } else { "N·m" }
}

impl CouplingForces<'_> {
    /// Whether it passes more than a fraction of the greatest force and moment of a self-stress, 1 N.
    fn is_loaded(&self, size: f64) -> bool {
        let mut ends = self.ends.iter();
        ends.any(|e| e.effort.abs() > 1e-9 * if e.unit == "N" { 1.0 } else { size })
    }

    /// What it passes at both joints and at the teeth, in words.
    fn told(&self) -> String {
        let ends = self.ends.iter();
        let mut parts: Vec<String> = ends
            .map(|e| format!("{} {} at {}", figure(e.effort), e.unit, e.joint))
            .collect();
        if let Some(teeth) = &self.teeth {
            parts.push(format!("{} N at the teeth", figure(teeth.magnitude)));
        }
        list(&parts)
    }

    /// Its rows of CSV, one a joint, behind their kind.
    pub(super) fn rows(&self) -> impl Iterator<Item = Vec<String>> {
        self.ends.iter().map(|e| {
            let mut row = vec![self.coupling.clone(), format!("coupling at {}", e.joint)];
            row.resize(5, String::new());
            row.push(
                self.teeth
                    .as_ref()
                    .map_or_else(String::new, |t| t.magnitude.to_string()),
            );
            row.resize(10, String::new());
            row.extend([e.effort.to_string(), e.unit.to_owned()]);
            row
        })
    }
}

/// The names of the couplings that a self-stress loads.
pub(super) fn loaded<'c>(
    all: &'c [CouplingForces<'_>],
    size: f64,
) -> impl Iterator<Item = &'c str> {
    let loaded = all.iter().filter(move |c| c.is_loaded(size));
    loaded.map(|c| c.coupling.as_str())
}

/// What bearings have of the couplings and what they have not, where there are any.
fn told_of_teeth(out: &mut String, all: &[CouplingForces<'_>]) -> std::fmt::Result {
    if all.iter().any(|c| c.teeth.is_some()) {
        writeln!(
            out,
            "Teeth push along the pitch circles, and the joints of both gears bear it; their pressure angle and friction are omitted"
        )?;
    }
    let unplaced = all.iter().filter(|c| c.gear && c.teeth.is_none());
    let unplaced: Vec<&str> = unplaced.map(|c| c.coupling.as_str()).collect();
    if !unplaced.is_empty() {
        writeln!(
            out,
            "The file does not determine where the teeth of {} are, so no joint bears them: gears need parallel axes with points \
             side by side on one link, a rack a slide across the axis on that link, both joints no other freedom that teeth move",
            list(&unplaced)
        )?;
    }
    Ok(())
}

/// The couplings as a table, one a row.
pub(super) fn text(
    out: &mut String,
    all: &[CouplingForces<'_>],
    width: Option<u16>,
) -> std::fmt::Result {
    if all.is_empty() {
        return Ok(());
    }
    let rows = all.iter().map(|c| {
        let mut row = vec![c.coupling.clone()];
        let ends = c.ends.iter();
        row.extend(ends.map(|e| format!("{} {}", figure(e.effort), e.unit)));
        let teeth = c.teeth.as_ref();
        row.push(teeth.map_or_else(String::new, |t| format!("{} N", figure(t.magnitude))));
        row
    });
    let head = ["coupling", "at the first", "at the second", "at the teeth"];
    writeln!(
        out,
        "Couplings give the second link of each joint, along the freedom they tie\n"
    )?;
    writeln!(out, "{}\n", table(&head, rows.collect(), width))?;
    told_of_teeth(out, all)
}

/// What couplings pass while joints are elastic and they are not.
pub(super) fn elastic(out: &mut String, all: &[CouplingForces<'_>]) -> std::fmt::Result {
    for c in all {
        writeln!(out, "Coupling {}, rigid, passes {}", c.coupling, c.told())?;
    }
    Ok(())
}

/// What each coupling passes where that is the most, by position; `at` tells a position.
pub(super) fn greatest(
    out: &mut String,
    all: &[(f64, &[CouplingForces<'_>])],
    at: &dyn Fn(f64) -> String,
) -> std::fmt::Result {
    let count = all.first().map_or(0, |(_, c)| c.len());
    for q in 0..count {
        let size = |c: &[CouplingForces<'_>]| c[q].ends[1].effort.abs();
        let most = all.iter().max_by(|a, b| size(a.1).total_cmp(&size(b.1)));
        if let Some((place, c)) = most {
            let c = &c[q];
            let (name, told) = (&c.coupling, c.told());
            writeln!(
                out,
                "Coupling {name} passes at most {told}, at {}",
                at(*place)
            )?;
        }
    }
    all.first().map_or(Ok(()), |(_, c)| told_of_teeth(out, c))
}
