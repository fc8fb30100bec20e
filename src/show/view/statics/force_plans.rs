//! Force plans of the four-link groups, drawn where forces from outside load them most.

use crate::chart::{Panel, PanelPair, PlanArrow, Polygons};
use crate::statics::contour_group::force_plan::{
    Plan, PlanForce, PlanKind, force_plans, group_loads,
};
use crate::statics::contour_group::solutions::GroupSolutions;
use crate::statics::cycle::Moment;
use crate::statics::kinetostatics::LoadSource;
use crate::view::prelude::*;
use crate::view::statics::{StaticsData, vector_size};

/// Returns the drawing of each group, with its file name.
pub fn force_plans_of(s: &StaticsData<'_>) -> Vec<(String, Polygons)> {
    let groups = 0..s.found.contour_groups.len();
    groups.filter_map(|i| group_plan(s, i)).collect()
}

fn group_plan(s: &StaticsData<'_>, i: usize) -> Option<(String, Polygons)> {
    let (index, letters) = &s.found.contour_groups[i];
    let outside = |x: &&Moment| -> f64 {
        let own = x.groups.get(i).into_iter().flat_map(|g| &g.pose.loads);
        let forces = own.filter(|l| l.source == LoadSource::External);
        forces.map(|l| vector_size(l.force)).sum()
    };
    let solved = s.found.moments.iter().filter(|x| x.groups.len() > i);
    // Of equal loads the first.
    let heaviest = solved
        .rev()
        .max_by(|a, b| outside(a).total_cmp(&outside(b)))?;
    let pairs = force_plans(&heaviest.groups[i])?;
    let sizes = pairs.iter().flatten().flat_map(|p| &p.forces);
    let (unit, prefix) = unit_prefix(sizes.map(|f| vector_size(f.force)).fold(0.0, f64::max));
    let panel = |p: Plan, by: &str| Panel {
        title: format!("{}, {by}", p.of),
        arrows: p.forces.iter().map(|f| plan_arrow(f, unit)).collect(),
    };
    let rows = pairs.into_iter().map(|[delta, full]| PanelPair {
        panels: [
            panel(delta, "δ-point method"),
            panel(full, "equilibrium of all links"),
        ],
        one_scale: true,
    });
    let mut rows: Vec<PanelPair> = rows.collect();
    rows.push(own_loads(&heaviest.groups[i], unit));
    let name = s.group_name(*index);
    let bodies = &s.planar_mechanism().bodies;
    let [a, b] = letters.rods;
    let places = [letters.ternary, a, b, letters.slider].map(|b| &bodies[b].name);
    let places = ["4", "6", "7", "10"].iter().zip(places);
    let places = places.map(|(letter, name)| format!("{letter} = {name}"));
    let plans = Polygons {
        title: format!("{}: force plans of group {name}", s.of.name),
        subtitle: format!(
            "At {}, where forces from outside load it most; links {}.",
            s.format_place(heaviest.drive),
            places.format(", ")
        ),
        unit: format!("{prefix}N"),
        rows,
    };
    Some((format!("force-plan-{name}"), plans))
}

/// Returns the weights and the inertia forces of the group, each on its own, because they are too short to be seen next to
/// external forces.
fn own_loads(g: &GroupSolutions, unit: f64) -> PanelPair {
    let of = |source, title: &str, sum: &str| {
        let mut forces = group_loads(g);
        forces.retain(|f| f.kind == PlanKind::Load(source));
        let total = |k: usize| forces.iter().map(|f| f.force[k]).sum::<f64>();
        let back = PlanForce {
            name: format!("-Σ{sum}"),
            force: [-total(0), -total(1)],
            kind: PlanKind::Reaction,
        };
        Panel {
            title: title.to_owned(),
            arrows: forces
                .iter()
                .chain([&back])
                .map(|f| plan_arrow(f, unit))
                .collect(),
        }
    };
    PanelPair {
        panels: [
            of(LoadSource::Gravity, "weights of the group, enlarged", "G"),
            of(
                LoadSource::Inertia,
                "inertia forces of the group, enlarged",
                "Fи",
            ),
        ],
        one_scale: false,
    }
}

fn plan_arrow(f: &PlanForce, unit: f64) -> PlanArrow {
    PlanArrow {
        name: f.name.clone(),
        vector: f.force.map(|x| x / unit),
        colour: match f.kind {
            PlanKind::Load(LoadSource::External) => 5,
            PlanKind::Load(LoadSource::Gravity) => 2,
            PlanKind::Load(LoadSource::Inertia) => 4,
            PlanKind::Tangential => 1,
            PlanKind::Reaction => 0,
        },
    }
}
