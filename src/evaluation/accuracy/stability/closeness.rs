//! What if coordinates are a little off: exactly displaced, displaced among digits, or rounded.

use crate::accuracy::cases::Case;
use crate::accuracy::change::{Noise, displace_joint, turned_and_rounded};
use crate::accuracy::said::{Reply, Said};
use crate::accuracy::special::SpecialKind;
use crate::accuracy::study::{Effort, Progress, Study};
use crate::file::text::mechanism_from_str;
use crate::format::group_thousands;
use crate::model::mechanism::StateId;
use crate::rank::method::auto::decide_state;
use crate::rank::method::{MobilityMethod, registry};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Returns the study of special mechanisms with one coordinate displaced exactly, by the first to the sixteenth digit. A method is right if it is
/// right about both the special and the displaced mechanism.
pub(super) fn study_distance(effort: Effort, progress: Progress<'_>) -> Study {
    let (each, step) = if effort.quick { (1, 5) } else { (6, 1) };
    let exponents: Vec<i32> = (-16..=-1).step_by(step).collect();
    let values = exponents.iter().map(|&e| 10f64.powi(e));
    let study = Study::new("stability-distance", values.collect());
    let names = registry::ALL.map(MobilityMethod::name);
    study.ask_cases(names, SpecialKind::ALL.len() * each, progress, |v, case| {
        let kind = SpecialKind::ALL[case / each];
        let Some((special, place)) = kind.with_place(&mut Noise::new(effort.seed, case)) else {
            return Vec::new();
        };
        let off = displace_joint(&special, place, exponents[v]);
        let pair = [
            (&special, StateId::FREE, kind.true_figures(false)),
            (&off, StateId::FREE, kind.true_figures(true)),
        ];
        Reply::of_methods(&registry::ALL, &pair)
    })
}

/// The size of mechanisms of [`SpecialKind`].
const SIZE: f64 = 2.0;

/// Returns the study of special mechanisms of a given number of decimals with one joint displaced. Below half a unit of the last digit the special
/// geometry is true, above one and a half units the offset. Between them the digits allow both.
pub(super) fn study_digits(effort: Effort, progress: Progress<'_>) -> Study {
    let (each, decimals): (usize, &[i32]) = if effort.quick {
        (1, &[4, 9])
    } else {
        (6, &[3, 6, 9, 12])
    };
    let leads = [1.0, 1.6, 2.0, 3.0, 4.0, 5.0];
    let offsets: Vec<f64> = (-14..=0)
        .flat_map(|e| leads.map(|lead| lead * 10f64.powi(e)))
        .collect();
    let values = offsets.iter().map(|o| o / SIZE);
    let study = Study::new("stability-digits", values.collect());
    let names = decimals.iter().map(|d| format!("{d} decimals"));
    let [large, wrong] = [(); 2].map(|()| AtomicUsize::new(0));
    let cases = SpecialKind::ALL.len() * each * 2;
    let mut study = study.ask_cases(names, cases, progress, |v, case| {
        let (kind, turned) = (SpecialKind::ALL[case / 2 / each], case % 2 == 1);
        let ask = |&d: &i32| {
            let units = offsets[v] * 10f64.powi(d);
            let near = (0.09..0.49).contains(&units) || (1.5..11.0).contains(&units);
            let far = v.is_multiple_of(leads.len()) && (0.009..1100.0).contains(&units);
            if !near && (!far || (0.49..1.5).contains(&units)) {
                return None;
            }
            let mut noise = Noise::new(effort.seed, case);
            let text = kind.text(units, d.unsigned_abs() as usize, turned, &mut noise);
            let m = mechanism_from_str("offset.toml", &text).ok()?;
            let found = decide_state(&m, StateId::FREE).ok();
            let [w, finite] = Said::of_decision(found.as_ref(), kind.true_figures(units > 1.0));
            let said = w.max(finite);
            if units > 2.9 {
                large.fetch_add(1, Ordering::Relaxed);
                wrong.fetch_add(usize::from(said == Said::Wrong), Ordering::Relaxed);
            }
            Some(Reply::new(said, || text))
        };
        decimals.iter().map(ask).collect()
    });
    let [large, wrong] = [large, wrong].map(|n| group_thousands(n.into_inner()));
    study.note = format!(
        "From three units of the last digit on {wrong} of {large} offsets are wrong and sure."
    );
    study
}

/// The methods that are asked about rounded mechanisms. Others of floating point and of exact numbers answer as these do.
const METHODS: [&str; 4] = ["auto", "finite", "modular", "svd"];

/// Returns the study of every built-in mechanism, turned at random and rounded to 4 to 16 decimals. The original mechanism is the truth.
pub(super) fn study_rounded(cases: &[Case], effort: Effort, progress: Progress<'_>) -> Study {
    let (step, turns) = if effort.quick { (4, 1) } else { (1, 3) };
    let decimals: Vec<u32> = (4..=16).step_by(step).collect();
    let values = decimals.iter().map(|&d| f64::from(d));
    let study = Study::new("stability-rounded", values.collect());
    let methods: Vec<_> = METHODS.into_iter().filter_map(registry::by_name).collect();
    study.ask_cases(METHODS, cases.len() * turns, progress, |v, i| {
        let (case, turn) = (&cases[i / turns], i % turns);
        let mut noise = Noise::new(effort.seed.wrapping_add(turn as u64), i / turns);
        let m = turned_and_rounded(&case.mechanism, decimals[v] as usize, &mut noise);
        Reply::of_methods(&methods, &[(&m, case.state, case.truth)])
    })
}
