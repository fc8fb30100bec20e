//! Variants ranked under the loads of the clamped states.

use super::refused::run;
use super::text;
use crate::common::*;

fn pool(s: &Search, n: usize) -> Vec<Assignment> {
    let d = s.build_diagrams(Control::NONE);
    s.cheapest_variants(&d, n).collect()
}

/// The slow twin builds each variant as a mechanism, follows it to every part and takes singular values.
#[test]
fn variants_are_scored_by_the_worst_part() {
    let m = built_in("lever-gripper");
    for redundant in [0, 1] {
        let request = default_with(|c: &mut Conditions| c.max_redundant = redundant);
        let s = Search::new(exact_field(&m, 0).unwrap(), &m, request).unwrap();
        let e = Evaluator::new(&s, ClearanceSum::Worst).unwrap();
        assert_eq!((e.cases.list.len(), e.cases.free), (5, 0));
        let mut scratch = Scratch::default();
        let mut greatest = 0.0f64;
        for v in pool(&s, 40) {
            let (fast, slow) = (e.score_variant(&v, &mut scratch), e.reference_scores(&v));
            let (Ok(fast), Ok(slow)) = (fast, slow) else {
                continue;
            };
            greatest = greatest.max(fast.force.value);
            for t in Term::ALL {
                let (a, b) = (fast.term_value(t), slow.term_value(t));
                let near = (a - b).abs() <= 1e-7 * a.abs().max(b.abs()).max(1e-12);
                assert!(near, "{}: {fast:?} {slow:?}", t.name());
            }
        }
        assert!(greatest > 100.0, "{greatest}");
        // The free state has no loads.
        let free = Evaluator::in_states(&s, ClearanceSum::Worst, &[StateId::FREE]).unwrap();
        for v in pool(&s, 3) {
            assert_eq!(
                free.score_variant(&v, &mut scratch).unwrap().force.value,
                0.0
            );
        }
        let both = Evaluator::in_states(
            &s,
            ClearanceSum::Worst,
            &[StateId::new(1), StateId::FREE, StateId::new(1)],
        )
        .unwrap();
        assert_eq!((both.cases.list.len(), both.cases.free), (6, 1));
    }
}

#[test]
fn the_ranking_states_its_states() {
    let v = run_json("search lever-gripper --format json");
    assert_eq!(v["ranking"]["grip"][0]["state"], "clamped");
    assert_eq!(v["ranking"]["grip"][0]["held"].list().len(), 5);
    assert!(v["variants"][0]["scores"]["by_cost"].whole() > 1);
    let with = |states: &str| {
        replace_once(
            text(),
            "[ranking]",
            &format!("[ranking]\nstates = {states}"),
        )
    };
    let (code, said, _) = run(&with("[\"free\"]"), "search FILE --format json");
    assert_eq!(code, Some(0));
    let said: Value = serde_json::from_str(&said).unwrap();
    assert_eq!(said["ranking"]["grip"].list().len(), 0);
    assert_eq!(said["variants"][0]["scores"]["peak-force"], 0.0);
    let (code, _, errors) = run(&with("[\"clampt\"]"), "search FILE");
    assert_eq!(code, Some(2));
    has(&errors, "clampt");
    has(&errors, "known: free, clamped");
    // Not a state of the grip.
    let loaded = builtin::text("gripper-10-loaded").unwrap();
    let loaded = replace_once(loaded, "[ranking]", "[ranking]\nstates = [\"clamped\"]");
    let (code, _, errors) = run(&loaded, "check FILE");
    assert_eq!(code, Some(2));
    has(&errors, "with the contacts of [workload.grip]");
}
