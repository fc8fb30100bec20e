//! The shares of the contours from one basis of the self-stresses, against the same by definition.

use crate::common::lattice::{self, LatticeKind};
use crate::common::*;
use crate::search::twin;
use ozols::closure::Column;
use ozols::closure::contour::Contour;
use ozols::linalg::echelon;
use ozols::linalg::modp::Residue;
use ozols::redundancy::contour_shares::contour_shares;

/// (σ in the order given, least, greatest) of each contour, by a rank for each.
fn shares_by_definition(exact: &ExactField, closure: &Closure<Residue>) -> Vec<[usize; 3]> {
    let rank_of = |contours: &[usize]| {
        let columns: Vec<Vec<Residue>> = (0..closure.columns.len())
            .map(|c| closure.dense_column(exact, c, contours))
            .collect();
        echelon::rank_of(exact.field(), columns.iter().map(Vec::as_slice))
    };
    let all: Vec<usize> = (0..closure.contours.len()).collect();
    all.iter()
        .map(|&i| {
            let others: Vec<usize> = all.iter().copied().filter(|&j| j != i).collect();
            [
                closure.dim + rank_of(&all[..i]) - rank_of(&all[..=i]),
                closure.dim - rank_of(&[i]),
                closure.dim + rank_of(&others) - rank_of(&all),
            ]
        })
        .collect()
}

fn shares(exact: &ExactField, closure: &Closure<Residue>) -> Vec<[usize; 3]> {
    let all = contour_shares(exact, closure);
    all.iter()
        .map(|s| [s.redundant, s.range.0, s.range.1])
        .collect()
}

fn check(mechanism: &Mechanism) {
    let exact = exact_field(mechanism, 0).unwrap();
    for state in mechanism.state_ids() {
        let closure = Closure::new(&exact, mechanism, state).unwrap();
        let what = format!("{} {}", mechanism.name, mechanism.states[state]);
        let by_definition = shares_by_definition(&exact, &closure);
        assert_eq!(shares(&exact, &closure), by_definition, "{what}");
    }
}

#[test]
fn built_in_mechanisms() {
    for name in builtin::names() {
        check(&built_in(name));
    }
}

#[test]
fn chains_and_grids() {
    for kind in LatticeKind::ALL {
        for k in [1, 2, 3, 9, 24] {
            check(&lattice::lattice_mechanism(kind, k));
        }
    }
    for kind in [LatticeKind::FourBars, LatticeKind::Scissors] {
        let m = lattice::lattice_mechanism(kind, 70);
        let exact = exact_field(&m, 0).unwrap();
        let closure = Closure::new(&exact, &m, StateId::FREE).unwrap();
        assert_eq!(closure.contours.len(), 70);
        assert_eq!(modular::rank_modulo(&exact, &closure), 3 * 70, "{kind:?}");
    }
}

/// Rows per contour, the joints of each contour, the twists of each joint.
type Structure = (usize, Vec<Vec<(JointId, bool)>>, Vec<Vec<Vec<i64>>>);

/// Contours and columns at random, not those of any mechanism: each joint in some contours, with a few small twists.
fn structured() -> impl Strategy<Value = Structure> {
    let twist = prop::collection::vec(-1i64..2, 6);
    let joint = (
        prop::collection::vec((any::<prop::sample::Index>(), any::<bool>()), 0..4),
        prop::collection::vec(twist, 0..5),
    );
    (
        prop::bool::ANY,
        1usize..9,
        prop::collection::vec(joint, 1..24),
    )
        .prop_map(|(planar, k, joints)| {
            let mut contours = vec![Vec::new(); k];
            for (j, (of, _)) in JointId::first(joints.len()).zip(&joints) {
                for (i, forward) in of {
                    let i = i.index(k);
                    if contours[i].last().is_none_or(|&(last, _)| last != j) {
                        contours[i].push((j, *forward));
                    }
                }
            }
            let dim = if planar { 3 } else { 6 };
            (
                dim,
                contours,
                joints.into_iter().map(|(_, twists)| twists).collect(),
            )
        })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, ..ProptestConfig::default() })]
    #[test]
    fn random_structures((dim, contours, twists) in structured()) {
        let exact = ExactField::for_expressions([], 0).unwrap();
        let column = |(joint, t): (usize, &Vec<i64>)| Column {
            joint: JointId::new(joint),
            freedom: Freedom::Rz,
            twist: t[..dim].iter().map(|&x| exact.field().from_i64(x)).collect(),
        };
        let columns = twists.iter().enumerate().flat_map(|(j, ts)| ts.iter().map(move |t| (j, t)));
        let closure = Closure {
            extent: None,
            state: StateId::FREE,
            dim,
            contours: contours.into_iter().map(|joints| Contour { joints, links: Vec::new() }).collect(),
            columns: columns.map(column).collect(),
            couplings: Vec::new(),
            left_out: Vec::new(),
        };
        prop_assert_eq!(shares(&exact, &closure), shares_by_definition(&exact, &closure));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]
    #[test]
    fn random_mechanisms(text in twin::random()) {
        check(&read(&text));
    }
}
