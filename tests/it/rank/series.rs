//! Power series of the poses near a pose, by hand: what really moves is stopped at no order, and two toggles at a known one.

use crate::common::*;
use ozols::rank::finite::higher_order::HigherOrder;

fn series(m: &Mechanism, rank: usize) -> Option<HigherOrder> {
    let exact = field_of(m, StateId::FREE, 0).unwrap();
    let closure = Closure::new(&exact, m, StateId::FREE).unwrap();
    HigherOrder::new(&exact, m, &closure, rank).unwrap()
}

/// Where all that moves instantaneously moves in fact, as the files state, no subspace of it is isolated.
#[test]
fn what_moves_in_fact_is_stopped_at_no_order() {
    let mut several = 0;
    for name in builtin::names() {
        let m = built_in(name);
        let Some(e) = m.expected.iter().find(|e| e.state == "free") else {
            continue;
        };
        let moves = e.mobility.filter(|w| e.finite_mobility == Some(*w));
        let moves = moves.and_then(|w| usize::try_from(w).ok());
        let pose = Pose::of_file(&m, StateId::FREE).unwrap();
        let freedoms = pose.columns.len();
        let Some(moves) = moves.filter(|w| (1..4).contains(w) && freedoms <= 12) else {
            continue;
        };
        let Some(series) = series(&m, freedoms - moves) else {
            continue;
        };
        for dimensions in 1..=moves {
            assert_eq!(
                series.isolating_degree(dimensions),
                None,
                "{name} in {dimensions}"
            );
        }
        several += usize::from(moves > 1 && e.redundant.is_some_and(|s| s > 0));
    }
    assert!(several > 3, "{several}");
}

/// Three hinges in a line are open by the square of their motion. Of two such toggles a motion is stopped at the second order; both
/// together at the third, to which x² and y² have all powers among their multiples, xy not being one at the second.
#[test]
fn two_toggles_are_stopped_at_the_third_order() {
    let text = write_mechanism(
        "name = \"toggles\"\nmode = \"planar\"",
        "0 a b* c d*",
        "
        0-a | 0 a | revolute | 0, 0, 0 | 0, 0, 1
        a-b | a b | revolute | 10, 0, 0 | 0, 0, 1
        b-0 | b 0 | revolute | 20, 0, 0 | 0, 0, 1
        0-c | 0 c | revolute | 0, 50, 0 | 0, 0, 1
        c-d | c d | revolute | 13, 50, 0 | 0, 0, 1
        d-0 | d 0 | revolute | 26, 50, 0 | 0, 0, 1
        ",
    );
    let m = read(&text);
    let series = series(&m, 4).unwrap();
    assert_eq!(
        [1, 2].map(|k| series.isolating_degree(k)),
        [Some(2), Some(3)]
    );
}
