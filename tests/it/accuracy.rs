//! The survey of the methods, and where the naive formulas fail.

use ozols::accuracy::Verdict;
use ozols::accuracy::survey::{Reply, Survey, cases};
use ozols::rank::method;
use std::sync::LazyLock;

static SURVEY: LazyLock<Survey> = LazyLock::new(|| Survey::new(1, &mut |_, _| {}).unwrap());

fn index(name: &str) -> usize {
    method::ALL.iter().position(|m| m.name() == name).unwrap()
}

fn reply(case: &str, method: &str) -> &'static Reply {
    let n = SURVEY.cases.iter().position(|c| c.name() == case).unwrap();
    &SURVEY.replies[n][index(method)]
}

#[test]
fn finite_auto_and_modular_are_right_everywhere() {
    assert!(cases().unwrap().len() >= 117);
    let mut wrong = Vec::new();
    for name in ["finite", "auto"] {
        for (case, r) in SURVEY.of_method(index(name)) {
            if r.verdict != Verdict::Right {
                wrong.push(format!("{name} on {}: {:?}", case.name(), r.answer));
            }
        }
    }
    for (case, r) in SURVEY.of_method(index("modular")) {
        if r.answer.as_ref().unwrap().mobility != case.truth.instantaneous {
            wrong.push(format!("modular on {}: {:?}", case.name(), r.answer));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn each_naive_formula_fails_where_it_is_known_to() {
    for (case, method, says, by) in [
        ("bennett", "count", -2, -3),
        ("parallelogram-3-rods", "count-planar", 0, -1),
        ("3-crr", "loops", 2, -1),
        ("bennett", "generic", 0, -1),
    ] {
        let r = reply(case, method);
        assert_eq!(
            r.answer.as_ref().unwrap().mobility,
            says,
            "{method} on {case}"
        );
        assert_eq!(r.verdict, Verdict::Wrong(by), "{method} on {case}");
    }
}
