//! How far methods reach: size, unit of length, order of shakiness, and how small a prime may be.

use crate::accuracy::Truth;
use crate::accuracy::cases::Case;
use crate::accuracy::change::{Noise, resize};
use crate::accuracy::lattice::{Scene, make_ladder, make_lift, toggle_row};
use crate::accuracy::said::{Reply, Said, Tally};
use crate::accuracy::study::{Effort, Progress, Study};
use crate::accuracy::timing::{Stopwatch, quantile};
use crate::closure::Closure;
use crate::file::text::mechanism_from_str;
use crate::format::format_duration;
use crate::geom::exact::ExactField;
use crate::geom::expr::Expr;
use crate::linalg::modp::is_prime;
use crate::model::joint_type::JointType;
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::rank::exact::modular;
use crate::rank::method::{MobilityMethod, registry};
use crate::rank::numeric::Elimination;
use std::collections::HashSet;
use std::sync::{Mutex, PoisonError};

/// Returns the study of planar ladders and scissor lifts of 1 to 200 contours. A slow method is not asked about longer ones.
pub(super) fn study_size(effort: Effort, progress: Progress<'_>) -> Study {
    const SIZES: [usize; 10] = [1, 2, 3, 5, 10, 20, 35, 60, 100, 200];
    let (sizes, patience) = if effort.quick {
        (&SIZES[..8], 0.1)
    } else {
        (&SIZES[..], 2.0)
    };
    let slow = Mutex::new(HashSet::new());
    let values = sizes.iter().map(|&k| k as f64);
    let study = Study::new("stability-size", values.collect());
    let names = registry::ALL.map(MobilityMethod::name);
    study.ask_cases(names, 2, progress, |v, case| {
        let m = match case {
            0 => make_ladder(Scene::Plane, sizes[v], &mut Noise::new(effort.seed, v)),
            _ => make_lift(sizes[v] - 1),
        };
        let mut slow = slow.lock().unwrap_or_else(PoisonError::into_inner);
        let ask = |method: &&MobilityMethod| {
            if slow.contains(&(method.name(), case)) {
                return None;
            }
            let watch = Stopwatch {
                clock: effort.clock,
                repeat: if v < 4 { 5 } else { 1 },
            };
            let all = [(&m, StateId::FREE, Truth::new(1, 1))];
            let (reply, time) = watch.time_repeatedly(|| Reply::of_method(method, &all));
            if time.median > patience {
                slow.insert((method.name(), case));
            }
            reply.map(|reply| reply.with_time(time.median))
        };
        registry::ALL.iter().map(ask).collect()
    })
}

/// Returns the study of mechanisms in other units: every length times 10^-6 to 10^6.
pub(super) fn study_scale(cases: &[Case], effort: Effort, progress: Progress<'_>) -> Study {
    let step = if effort.quick { 3 } else { 1 };
    let exponents: Vec<i32> = (-6..=6).step_by(step).collect();
    let values = exponents.iter().map(|&e| 10f64.powi(e));
    let study = Study::new("stability-scale", values.collect());
    let names = Elimination::ALL.map(|e| e.name());
    let names = names.into_iter().chain(["modular", "auto"]);
    let methods: Vec<_> = names.filter_map(registry::by_name).collect();
    let names = methods.iter().map(|m| m.name());
    study.ask_cases(names, cases.len(), progress, |v, case| {
        let m = resize(&cases[case].mechanism, exponents[v]);
        Reply::of_methods(&methods, &[(&m, cases[case].state, cases[case].truth)])
    })
}

/// Returns the study of rows of toggles that have one freedom at the pose and none in truth.
pub(super) fn study_shaky(effort: Effort, progress: Progress<'_>) -> Study {
    let (each, most) = if effort.quick { (1, 3) } else { (3, 6) };
    let values = (1..=most).map(|l| f64::from(1u32 << l));
    let study = Study::new("stability-shaky", values.collect());
    let truth = Truth::new(1, 0);
    let names = registry::ALL.map(MobilityMethod::name);
    study.ask_cases(names, each, progress, |v, case| {
        let text = toggle_row(v + 1, &mut Noise::new(effort.seed, 100 * (v + 1) + case));
        let m = mechanism_from_str("toggles.toml", &text).expect("a generated file is valid");
        Reply::of_methods(&registry::ALL, &[(&m, StateId::FREE, truth)])
    })
}

/// The contours of the ladders whose points are drawn at random.
const CONTOURS: usize = 3;

/// Returns the study of the rank modulo a random prime of 8 to 61 bits, for a rigid ladder with random points and for built-in mechanisms
/// with rational coordinates. A minor of the ladder has degree 2 per contour in the points, which gives the bound of Schwartz and Zippel.
pub(super) fn study_prime(cases: &[Case], effort: Effort, progress: Progress<'_>) -> Study {
    const BITS: [u32; 10] = [8, 10, 12, 14, 16, 20, 24, 32, 48, 61];
    let mut ladder = make_ladder(Scene::Plane, CONTOURS, &mut Noise::new(effort.seed, 0));
    // A ladder whose first crank is fixed is rigid: its rank is less where a minor vanishes.
    ladder.edit().joints[JointId::new(0)].joint_type = JointType::Fixed;
    let largest = ExactField::of_prime((1 << 61) - 1);
    let rational = |c: &&Case| Closure::new(&largest, &c.mechanism, c.state).is_ok();
    let cases: Vec<&Case> = cases.iter().filter(rational).collect();
    let study = Study::new("stability-prime", BITS.map(f64::from).to_vec());
    let each = if effort.quick { 500 } else { 4_000 };
    let watch = Stopwatch {
        clock: effort.clock,
        repeat: 1,
    };
    let names = ["random points", "built-in mechanisms"];
    let mut study = study.ask_cases(names, each, progress, |v, i| {
        let mut noise = Noise::new(effort.seed, 64 * i + v);
        let prime = loop {
            let drawn = 1 | 1 << (BITS[v] - 1) | noise.draw_integer(BITS[v]).unsigned_abs();
            if is_prime(drawn) {
                break drawn;
            }
        };
        let exact = ExactField::of_prime(prime);
        let ask = |m: &Mechanism, state, w: i64| {
            let (free, time) = watch.time_repeatedly(|| {
                // A divisor may vanish: the program then takes another prime.
                let closure = Closure::new(&exact, m, state).ok()?;
                Some(closure.columns.len() - modular::rank_modulo(&exact, &closure))
            });
            let said = Said::judge(true, true, i64::try_from(free?) == Ok(w));
            let reply = Reply::new(said, || format!("{} modulo {prime}", m.name));
            Some(reply.with_time(time.median))
        };
        let mut drawn = ladder.clone();
        for joint in &mut drawn.edit().joints {
            for x in &mut joint.frame.point[..2] {
                *x = Expr::from(noise.draw_integer(61));
            }
        }
        let case = cases.get(i % cases.len().max(1));
        vec![
            ask(&drawn, StateId::FREE, 0),
            case.and_then(|c| ask(&c.mechanism, c.state, c.truth.instantaneous)),
        ]
    });
    let (mut within, mut sure) = (true, 0.0);
    for (v, &bits) in study.values.clone().iter().enumerate() {
        let bound = ((2 * CONTOURS) as f64 / (bits - 1.0).exp2()).min(1.0);
        let tally = &study.rows[0].1[v].1;
        let [all, wrong] = [tally.count_replies(), tally.wrong.len()].map(|n| n as f64);
        // The bound is of a probability: some more may be drawn, three deviations and one.
        within &= wrong <= bound * all + 3.0 * (bound * all).sqrt() + 1.0;
        if wrong > 0.0 {
            sure = bits;
        }
        let figure = Some(100.0 * bound);
        let bound = Tally {
            figure,
            ..Tally::default()
        };
        study.add_tally("bound, for random points", bits, bound);
    }
    let of = if within { "within" } else { "above" };
    let times = study.rows[0].1.iter().map(|(_, t)| t.median_time());
    let times: Vec<f64> = times.take(BITS.len()).collect();
    let [least, most] = [0.0, 1.0].map(|at| format_duration(quantile(&times, at)));
    study.note = format!(
        "Errors for random points are {of} the bound of Schwartz and Zippel; none is seen above {sure} bits. A rank takes {least} to \
         {most} whatever the prime."
    );
    study
}
