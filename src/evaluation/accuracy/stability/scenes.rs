//! The value of a smaller model of a scene, and whether the first idea stays first if costs and proportions change.

use crate::accuracy::cases::Case;
use crate::accuracy::change::{Noise, stretch};
use crate::accuracy::lattice::{Scene, make_ladder};
use crate::accuracy::said::{Reply, Said};
use crate::accuracy::study::{Effort, Progress, Study};
use crate::accuracy::timing::{Stopwatch, Timing};
use crate::closure::Closure;
use crate::closure::contour::contour_basis;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::exact::field::field_of;
use crate::rank::exact::modular;
use crate::rank::reduce::sufficient_rows::LeastRows;
use crate::score::outcome::variant::Change;
use crate::score::request::{Check, List, Request};
use crate::score::run::run;
use crate::search::question::cost::CostTable;
use std::collections::BTreeMap;

/// Contours of the random scenes.
const CONTOURS: [usize; 8] = [1, 2, 3, 4, 6, 9, 14, 20];

/// Returns the study of the least model of a scene, the rows of the closure equations that matter. It compares the rank
/// with that by all rows in space, which is the truth. Times are multiples of the time by all rows.
pub(super) fn study_least_model(cases: &[Case], effort: Effort, progress: Progress<'_>) -> Study {
    let each = if effort.quick { 4 } else { 32 };
    let study = Study::new("stability-model", CONTOURS.map(|k| k as f64).to_vec());
    let rows = Scene::ALL.map(Scene::name).into_iter();
    let rows = rows.chain(["built-in mechanisms"]);
    let watch = Stopwatch {
        clock: effort.clock,
        repeat: 3,
    };
    study.ask_cases(
        rows,
        Scene::ALL.len() * each + cases.len(),
        progress,
        |v, n| {
            let mut replies = vec![None; Scene::ALL.len() + 1];
            let Some(&scene) = Scene::ALL.get(n / each) else {
                let Case {
                    mechanism, state, ..
                } = &cases[n - Scene::ALL.len() * each];
                let contours = contour_basis(mechanism, *state).len();
                if CONTOURS.partition_point(|&k| k <= contours) == v + 1 {
                    replies[Scene::ALL.len()] = by_rank(mechanism, *state, watch);
                }
                return replies;
            };
            let m = make_ladder(scene, CONTOURS[v], &mut Noise::new(effort.seed, n));
            replies[n / each] = by_rank(&m, StateId::FREE, watch);
            replies
        },
    )
}

/// Judges the rank by the least rows, which have to be found first.
fn by_rank(m: &Mechanism, state: StateId, watch: Stopwatch) -> Option<Reply> {
    let exact = field_of(m, state, 0).ok()?;
    let closure = Closure::new(&exact, m, state).ok()?;
    let all = watch.time_repeatedly(|| modular::rank_modulo(&exact, &closure));
    let (least, time) = watch.time_repeatedly(|| LeastRows::new(&exact, m, &closure));
    Some(compare_answers(m, all, (least.ok()?.rank(), time)))
}

/// Returns whether two answers are the same, with the time of the second as a multiple of the time of the first.
fn compare_answers<T: PartialEq>(m: &Mechanism, all: (T, Timing), least: (T, Timing)) -> Reply {
    let said = Said::judge(true, true, all.0 == least.0);
    // By a clock that stands still both take as long.
    let times = (all.1.median > 0.0).then(|| least.1.median / all.1.median);
    Reply::new(said, || m.name.clone()).with_time(times.unwrap_or(1.0))
}

/// Returns the study of the first idea. A change of x multiplies the cost of each joint type by a random factor between 1 - x and 1 + x.
/// Under a ranking it multiplies the coordinates along each axis instead.
pub(super) fn study_first_idea(cases: &[Case], effort: Effort, progress: Progress<'_>) -> Study {
    let (each, values): (usize, &[f64]) = if effort.quick {
        (1, &[0.01, 0.05])
    } else {
        (5, &[0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2])
    };
    let request = Request {
        check: Check::None,
        nodes: 20_000,
        pool: Some(2_000),
        ..Request::default()
    };
    let first = |m: &Mechanism, n: usize| {
        let request = Request {
            list: List::Top(n),
            ..request.clone()
        };
        let found = run(m.clone(), &request, &|| false, &mut |_| {}).ok()?;
        let ideas: Vec<Vec<Change>> = found.variants().map(|v| v.list_changes()).collect();
        (!ideas.is_empty()).then_some(ideas)
    };
    let free = cases
        .iter()
        .filter(|c| c.state == StateId::FREE)
        .map(|c| &c.mechanism);
    let offers = free.filter(|m| m.joints.iter().any(|j| !j.options.is_empty()));
    let ideas = offers.filter_map(|m| Some((m, first(m, 10)?)));
    let ideas: Vec<_> = ideas.collect();
    let study = Study::new("stability-first-idea", values.to_vec());
    let names = [
        "first by cost stays first",
        "first by cost stays among ten",
        "first of a ranking stays first",
    ];
    study.ask_cases(names, ideas.len() * each, progress, |v, n| {
        let (m, before) = &ideas[n / each];
        let noise = &mut Noise::new(effort.seed, n);
        let ranked = m.ranking.is_some();
        let changed = if ranked {
            stretch(m, values[v], noise)
        } else {
            reprice_options(m, values[v], noise)
        };
        let now = first(&changed, 1).map(|mut ideas| ideas.swap_remove(0));
        let reply = |right: bool| Reply::new(Said::judge(true, false, right), String::new);
        let stays = now.as_ref().map(|now| reply(*now == before[0]));
        if ranked {
            return vec![None, None, stays];
        }
        vec![stays, now.map(|now| reply(before.contains(&now))), None]
    })
}

/// Returns a copy in which each type of joint costs up to a share more or less.
fn reprice_options(m: &Mechanism, by: f64, noise: &mut Noise) -> Mechanism {
    let costs = CostTable::new(&m.search.costs);
    let mut factors: BTreeMap<String, f64> = BTreeMap::new();
    let mut out = m.clone();
    for joint in &mut out.joints {
        for option in joint.options.iter_mut().chain(&mut joint.unloading) {
            let factor = factors.entry(option.name.clone());
            let factor = factor.or_insert_with(|| 1.0 + by * noise.draw_uniform());
            let cost = (costs.option_cost(option) as f64 * *factor).round() as i64;
            option.cost_milli = Some(cost);
        }
    }
    out
}
