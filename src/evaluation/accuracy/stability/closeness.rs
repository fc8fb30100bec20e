//! What if coordinates are a little off: exactly displaced, displaced among digits, or rounded.

use crate::accuracy::Truth;
use crate::accuracy::cases::Case;
use crate::accuracy::change::{Noise, power_of_ten, turned_and_rounded};
use crate::accuracy::said::{Reply, Said};
use crate::accuracy::special::SpecialKind;
use crate::accuracy::study::{Effort, Progress, Study, View};
use crate::closure::Closure;
use crate::file::text::mechanism_from_str;
use crate::geom::Reals;
use crate::geom::expr::Expr;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::method::auto::decide_state;
use crate::rank::method::{MobilityMethod, registry};
use crate::rank::numeric::Elimination;

/// A coordinate that takes a special mechanism off: the joint, whether its axis is tilted instead of its point moved, and the coordinate.
type Place = (usize, bool, usize);

/// A special mechanism, the coordinate that takes it off, its displacement at distance 1, and the figures of the special one and of
/// any other.
struct Special {
    mechanism: Mechanism,
    place: Place,
    unit: i64,
    truth: [Truth; 2],
}

/// Built-in ones with their joints, places and units. If they are off, nothing moves.
const BUILT_IN: [(&str, &str, bool, usize, i64); 4] = [
    ("bennett", "1-2", false, 0, 40),
    ("parallelogram-3-rods", "3-4", false, 1, 200),
    ("sarrus", "2-3", true, 2, 1),
    ("collinear-truss", "1-2", false, 1, 60),
];

impl Special {
    fn built_in(cases: &[Case]) -> impl Iterator<Item = Special> + '_ {
        let of = |(name, joint, axis, coordinate, unit): (&str, &str, bool, usize, i64)| {
            let case = cases.iter().find(|c| c.name() == name)?;
            let mechanism = case.mechanism.clone();
            let joint = mechanism.joints.iter().position(|j| j.id == joint)?;
            Some(Special {
                mechanism,
                place: (joint, axis, coordinate),
                unit,
                truth: [case.truth, Truth::new(0, 0)],
            })
        };
        BUILT_IN.into_iter().filter_map(of)
    }

    fn draw_special(kind: SpecialKind, noise: &mut Noise) -> Option<Special> {
        let (mechanism, place) = kind.with_place(noise)?;
        Some(Special {
            mechanism,
            place,
            unit: 1,
            truth: [false, true].map(|off| kind.true_figures(off)),
        })
    }

    fn displace(&self, exponent: i32) -> Mechanism {
        let mut m = self.mechanism.clone();
        let (joint, axis, coordinate) = self.place;
        if let Some(joint) = m.edit().joints.get_mut(joint) {
            let frame = &mut joint.frame;
            let x = &mut (if axis {
                &mut frame.axis
            } else {
                &mut frame.point
            })[coordinate];
            *x = &*x + &(&Expr::from(self.unit) * &power_of_ten(exponent));
        }
        m
    }
}

/// Returns the study of special mechanisms with one coordinate displaced exactly, by the first to the sixteenth digit. A method is right if it is
/// right about both the special and the displaced mechanism.
pub(super) fn study_distance(cases: &[Case], effort: Effort, progress: Progress<'_>) -> Study {
    let (each, step) = if effort.quick { (1, 5) } else { (4, 1) };
    let exponents: Vec<i32> = (-16..=-1).step_by(step).collect();
    let drawn = (0..SpecialKind::ALL.len() * each).filter_map(|i| {
        Special::draw_special(SpecialKind::ALL[i / each], &mut Noise::new(effort.seed, i))
    });
    let all: Vec<Special> = Special::built_in(cases).chain(drawn).collect();
    let study = Study::new(
        "stability-distance",
        exponents.iter().map(|&e| 10f64.powi(e)).collect(),
        View::Regions,
    );
    let names = registry::ALL.map(MobilityMethod::name);
    study.ask_cases(names, all.len(), progress, |v, case| {
        let special = &all[case];
        let off = special.displace(exponents[v]);
        let pair = [
            (&special.mechanism, StateId::FREE, special.truth[0]),
            (&off, StateId::FREE, special.truth[1]),
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
    let study = Study::new(
        "stability-digits",
        offsets.iter().map(|o| o / SIZE).collect(),
        View::Shares,
    );
    let names = decimals.iter().map(|d| format!("{d} decimals"));
    study.ask_cases(
        names,
        SpecialKind::ALL.len() * each * 2,
        progress,
        |v, case| {
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
                Some(Reply::new(w.max(finite), || text))
            };
            decimals.iter().map(ask).collect()
        },
    )
}

/// Returns the study of the ranks in floating point of the built-in mechanisms against the tolerance, by half decades.
pub(super) fn study_tolerance(cases: &[Case], effort: Effort, progress: Progress<'_>) -> Study {
    let step = if effort.quick { 4 } else { 1 };
    let halves = (-30..=-6).step_by(step);
    let study = Study::new(
        "stability-tolerance",
        halves
            .map(|half| 10f64.powf(f64::from(half) / 2.0))
            .collect(),
        View::Best,
    );
    let tolerances = study.values.clone();
    let names = Elimination::ALL.map(|method| method.name());
    study.ask_cases(names, cases.len(), progress, |v, n| {
        let Case {
            mechanism,
            state,
            truth,
        } = &cases[n];
        let closure = Closure::new(&Reals, mechanism, *state).ok();
        let ask = |method: &Elimination| {
            let found = closure.as_ref()?;
            let w = method.mobilities_at(found, &tolerances[v..=v])[0];
            let said = Said::judge(w.is_some(), false, w == Some(truth.instantaneous));
            Some(Reply::new(said, String::new))
        };
        Elimination::ALL.iter().map(ask).collect()
    })
}

/// Tolerances of the singular values that are compared with the automatic choice.
const TOLERANCES: [f64; 2] = [1e-9, 1e-6];

/// Returns the study of every built-in mechanism, turned at random and rounded. The original mechanism is the truth.
pub(super) fn study_rounded(cases: &[Case], effort: Effort, progress: Progress<'_>) -> Study {
    let (step, turns) = if effort.quick { (4, 1) } else { (1, 3) };
    // Finest first: the axis ascends.
    let decimals: Vec<i32> = (4..=16).rev().step_by(step).collect();
    let study = Study::new(
        "stability-rounded",
        decimals.iter().map(|d| 10f64.powi(-d)).collect(),
        View::Shares,
    );
    let names = [
        "W",
        "finite mobility",
        "W by svd at 1e-9",
        "W by svd at 1e-6",
    ];
    study.ask_cases(names, cases.len() * turns, progress, |v, i| {
        let (case, turn) = (&cases[i / turns], i % turns);
        let mut noise = Noise::new(effort.seed.wrapping_add(turn as u64), i / turns);
        let m = turned_and_rounded(
            &case.mechanism,
            decimals[v].unsigned_abs() as usize,
            &mut noise,
        );
        let found = decide_state(&m, case.state).ok();
        let of = Said::of_decision(found.as_ref(), case.truth);
        let closure = Closure::new(&Reals, &m, case.state).ok();
        let svd = closure.map(|c| Elimination::Svd.mobilities_at(&c, &TOLERANCES));
        let svd = [0, 1].map(|n| {
            let w = svd.as_ref().and_then(|w| w[n]);
            Said::judge(w.is_some(), false, w == Some(case.truth.instantaneous))
        });
        let reply = |said| {
            Some(Reply::new(said, || {
                format!("{}, turn {}", case.name(), turn + 1)
            }))
        };
        of.into_iter().chain(svd).map(reply).collect()
    })
}
