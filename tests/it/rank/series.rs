//! Power series of the poses near a pose, by hand: what really moves is stopped at no order, and two toggles at a known one.

use crate::common::*;
use ozols::closure::Closure;
use ozols::motion::pose::Pose;
use ozols::rank::exact::field::field_of;
use ozols::rank::finite::higher_order::HigherOrder;

fn series(m: &Mechanism, rank: usize) -> Option<HigherOrder> {
    let exact = field_of(m, StateId::FREE, 0).unwrap();
    let closure = Closure::new(&exact, m, StateId::FREE).unwrap();
    let pose = Pose::of_file(m, StateId::FREE).unwrap();
    HigherOrder::new(&exact, m, &closure, &pose, rank).unwrap()
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
            assert_eq!(series.isolated(dimensions), None, "{name} in {dimensions}");
        }
        several += usize::from(moves > 1 && e.redundant.is_some_and(|s| s > 0));
    }
    assert!(several > 3, "{several}");
}

/// Three hinges in a line are open by the square of their motion. Of two such toggles a motion is stopped at the second order; both
/// together at the third, to which x² and y² have all powers among their multiples, xy not being one at the second.
#[test]
fn two_toggles_are_stopped_at_the_third_order() {
    let mut text =
        "name = \"toggles\"\nmode = \"planar\"\n[[link]]\nid = \"0\"\nrole = \"frame\"\n"
            .to_owned();
    for (n, (a, b)) in [("a", "b"), ("c", "d")].into_iter().enumerate() {
        text += &format!("[[link]]\nid = \"{a}\"\n[[link]]\nid = \"{b}\"\nrole = \"output\"\n");
        for (i, (from, to)) in [("0", a), (a, b), (b, "0")].into_iter().enumerate() {
            text += &format!(
                "[[joint]]\nid = \"{from}-{to}\"\nlinks = [\"{from}\", \"{to}\"]\ntype = \"revolute\"\npoint = [{}, {}, 0]\naxis = [0, 0, 1]\n",
                10 * i + 3 * i * n,
                50 * n
            );
        }
    }
    let m = mechanism_from_str("toggles.toml", &text).unwrap();
    let series = series(&m, 4).unwrap();
    assert_eq!([1, 2].map(|k| series.isolated(k)), [Some(2), Some(3)]);
}
