//! Searches of mechanisms that exact arithmetic does not have as they are meant: by singular values, and said so.

use ozols::accuracy::stability::change::{Noise, turned_and_rounded};
use ozols::builtin;
use ozols::file::text::mechanism_from_str;
use ozols::model::mechanism::{JointOption, Mechanism};
use ozols::score::outcome::Outcome;
use ozols::score::request::{Check, List, Request};
use rayon::prelude::*;

/// Options that every joint may take.
pub(super) fn request() -> Request {
    Request {
        options: ["revolute", "cylindrical", "spherical"].map(str::to_owned).to_vec(),
        list: List::Nothing,
        check: Check::None,
        ..Request::default()
    }
}

/// The same mechanism with its present joints as the only options.
pub(super) fn bare(mut m: Mechanism) -> Mechanism {
    for joint in &mut m.joints {
        joint.unloading.clear();
        joint.options = vec![JointOption {
            name: joint.joint_type.name().to_owned(),
            joint_type: joint.joint_type.clone(),
            frame: joint.frame.clone(),
            cost_milli: None,
            state: None,
        }];
    }
    m
}

/// A built-in mechanism without options of its own.
pub(super) fn plain(name: &str) -> Mechanism {
    bare(mechanism_from_str("x.toml", builtin::text(name).unwrap()).unwrap())
}

/// It turned and rounded.
pub(super) fn turned(m: &Mechanism, decimals: usize, noise: &mut Noise) -> Mechanism {
    bare(turned_and_rounded(m, decimals, noise))
}

/// What a search of a turned mechanism says against what one of the exact one does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Said {
    /// Exact, and the same.
    Exact,
    /// Numeric, without doubts, and the same.
    Numeric,
    /// Numeric, with the truth between its bounds.
    Bracket,
    /// No answer.
    Refused,
    /// Not exact, and the truth is not in it.
    Beside,
    /// Exact, and wrong.
    WrongAndSure,
}

fn said(name: &str, m: &Mechanism, truth: &Outcome) -> (Said, String) {
    let found = match ozols::search(m, &request()) {
        Ok(found) => found,
        Err(e) => return (Said::Refused, format!("{name}: {e}")),
    };
    let figures = |o: &Outcome| (o.determinate.clone(), o.admissible.clone());
    let same = figures(&found) == figures(truth);
    let Some(numeric) = &found.numeric else {
        let words = format!("{name}: {} for {}", found.admissible, truth.admissible);
        return match (same, found.is_exact()) {
            (true, _) => (Said::Exact, words),
            (false, true) => (Said::WrongAndSure, words),
            (false, false) => (Said::Beside, words),
        };
    };
    assert!(!found.is_exact() && !found.is_determinate_exact());
    let within = [
        (&numeric.determinate, &truth.determinate),
        (&numeric.admissible, &truth.admissible),
    ];
    let holds = within
        .iter()
        .all(|(b, t)| b.sure.total <= t.total && t.total <= b.most);
    let narrow = within.iter().all(|(b, _)| b.is_narrow());
    let words = format!(
        "{name}: {} to {} for {}, determinate {} to {} for {}, {:?}, base {:?}",
        numeric.admissible.sure,
        numeric.admissible.most,
        truth.admissible,
        numeric.determinate.sure,
        numeric.determinate.most,
        truth.determinate,
        numeric.digits,
        numeric.present
    );
    let worth = match (same && narrow, holds && !narrow) {
        (true, _) => Said::Numeric,
        (_, true) => Said::Bracket,
        _ => Said::Beside,
    };
    (worth, words)
}

#[test]
#[allow(clippy::print_stdout, reason = "the table is what it is run for")]
fn built_ins_turned() {
    let decimals: Vec<usize> = std::env::var("OZOLS_DECIMALS").map_or(vec![6], |d| {
        d.split(',').map(|d| d.parse().unwrap()).collect()
    });
    let seed: u64 = std::env::var("OZOLS_SEED").map_or(1, |s| s.parse().unwrap());
    let names: Vec<&str> = builtin::names();
    for d in decimals {
        let mut all: Vec<(Said, String)> = names
            .par_iter()
            .enumerate()
            .filter_map(|(n, name)| {
                let m = plain(name);
                let truth = ozols::search(&m, &request()).ok()?;
                let t = std::time::Instant::now();
                let turned = turned(&m, d, &mut Noise::new(seed, n));
                let (s, w) = said(name, &turned, &truth);
                Some((s, format!("{w} ({:.1?}, {} variants)", t.elapsed(), truth.search.size())))
            })
            .collect();
        all.sort();
        for (s, w) in &all {
            if *s != Said::Exact {
                println!("{s:?} {w}");
            }
        }
        for k in [Said::Exact, Said::Numeric, Said::Bracket, Said::Refused, Said::Beside, Said::WrongAndSure] {
            println!("{d} decimals {k:?}: {}", all.iter().filter(|x| x.0 == k).count());
        }
    }
}
