//! The value of a smaller model of a scene, and whether the first idea stays first if costs and proportions change.

use crate::accuracy::cases::Case;
use crate::accuracy::change::{Noise, stretch};
use crate::accuracy::lattice::{Scene, make_ladder};
use crate::accuracy::said::{Reply, Said};
use crate::accuracy::study::{Effort, Progress, Study};
use crate::accuracy::timing::Stopwatch;
use crate::closure::Closure;
use crate::closure::contour::contour_basis;
use crate::format::join_and;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::exact::field::field_of;
use crate::rank::exact::modular;
use crate::rank::reduce::sufficient_rows::LeastRows;
use crate::score::outcome::variant::Change;
use crate::score::request::{Check, List, Request};
use crate::score::run::run;
use crate::search::question::cost::CostTable;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// Contours of the random scenes.
const CONTOURS: [usize; 8] = [1, 2, 3, 4, 6, 9, 14, 20];

/// Returns the study of the least model of a scene, the rows of the closure equations that matter. It compares the rank
/// with that by all rows in space, which is the truth. Times are multiples of the time by all rows.
pub(super) fn study_least_model(cases: &[Case], effort: Effort, progress: Progress<'_>) -> Study {
    const SCENES: usize = Scene::ALL.len();
    let each = if effort.quick { 4 } else { 32 };
    let values = CONTOURS.map(|k| k as f64).to_vec();
    let study = Study::new("stability-model", values);
    let names = Scene::ALL.map(Scene::name).into_iter();
    let names: Vec<&str> = names.chain(["built-in mechanisms"]).collect();
    let rows = Mutex::new([[0; 2]; SCENES + 1]);
    let watch = Stopwatch {
        clock: effort.clock,
        repeat: 3,
    };
    let cases_in_all = SCENES * each + cases.len();
    let mut study = study.ask_cases(&names, cases_in_all, progress, |v, n| {
        let (row, mechanism, state) = match Scene::ALL.get(n / each) {
            Some(&scene) => {
                let noise = &mut Noise::new(effort.seed, n);
                let ladder = make_ladder(scene, CONTOURS[v], noise);
                (n / each, ladder, StateId::FREE)
            }
            None => {
                let case = &cases[n - SCENES * each];
                (SCENES, case.mechanism.clone(), case.state)
            }
        };
        let mut replies = vec![None; SCENES + 1];
        let contours = contour_basis(&mechanism, state).len();
        if CONTOURS.partition_point(|&k| k <= contours) == v + 1 {
            let found = by_rank(&mechanism, state, watch);
            replies[row] = found.map(|(reply, kept)| {
                let mut rows = rows.lock().unwrap_or_else(PoisonError::into_inner);
                let sums = rows[row].iter_mut().zip(kept);
                sums.for_each(|(sum, n)| *sum += n);
                reply
            });
        }
        replies
    });
    let rows = rows.into_inner().unwrap_or_else(PoisonError::into_inner);
    let kept = names.iter().zip(rows).map(|(name, [rows, of])| {
        format!("{name} {:.0} %", 100.0 * rows as f64 / f64::from(of.max(1)))
    });
    let kept: Vec<String> = kept.collect();
    study.note = format!("Rows that matter, of all: {}.", join_and(&kept));
    study
}

/// Judges the rank by the least rows, which have to be found first, by the rank by all rows. Returns the numbers of both, too. The time is
/// a multiple of that by all rows.
fn by_rank(m: &Mechanism, state: StateId, watch: Stopwatch) -> Option<(Reply, [u32; 2])> {
    let exact = field_of(m, state, 0).ok()?;
    let closure = Closure::new(&exact, m, state).ok()?;
    let (rank, all) = watch.time_repeatedly(|| modular::rank_modulo(&exact, &closure));
    let (found, time) = watch.time_repeatedly(|| LeastRows::new(&exact, m, &closure));
    let found = found.ok()?;
    let said = Said::judge(true, true, rank == found.rank());
    // By a clock that stands still both take as long.
    let times = (all.median > 0.0).then(|| time.median / all.median);
    let reply = Reply::new(said, || m.name.clone()).with_time(times.unwrap_or(1.0));
    Some((reply, [found.rows() as u32, found.of as u32]))
}

/// Returns the study of the first idea. A change of x multiplies the cost of each joint type by a random factor between 1 - x and 1 + x.
/// Under a ranking it multiplies the coordinates along each axis instead.
pub(super) fn study_first_idea(cases: &[Case], effort: Effort, progress: Progress<'_>) -> Study {
    let (each, values): (usize, &[f64]) = if effort.quick {
        (1, &[0.05, 0.2])
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
    for joint in &mut out.edit().joints {
        for option in joint.options.iter_mut().chain(&mut joint.unloading) {
            let factor = factors.entry(option.name.clone());
            let factor = factor.or_insert_with(|| 1.0 + by * noise.draw_uniform());
            let cost = (costs.option_cost(option) as f64 * *factor).round() as i64;
            option.cost_milli = Some(cost);
        }
    }
    out
}
