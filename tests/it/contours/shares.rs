//! σ of a contour over all bases that it is part of, against every basis of simple closed walks.

use crate::common::*;
use ozols::closure::contour::{Contour, closed_walk};
use ozols::redundancy::contour_shares::Measured;
use ozols::redundancy::contour_shares::{ContourShare, contour_shares};

/// Whether walks are independent, by how they pass joints.
fn independent(walks: &[&Contour], joints: &[JointId]) -> bool {
    let way = |d: Option<bool>| d.map_or(0.0, |d| if d { 1.0 } else { -1.0 });
    let row = |w: &&Contour| joints.iter().map(|&j| way(w.direction_of(j))).collect();
    rank_of_rows(walks.iter().map(row).collect()) == walks.len()
}

fn redundant(exact: &ExactField, m: &Mechanism, of: Vec<Contour>) -> usize {
    let closure = Closure::with_contours(exact, m, StateId::FREE, of).unwrap();
    closure.rows() - modular::rank_modulo(exact, &closure)
}

/// The most that a contour has of the redundant constraints in bases whose others leave out one of its joints, whichever.
fn beside_a_joint(
    exact: &ExactField,
    m: &Mechanism,
    contour: &Contour,
    all: &[Contour],
    joints: &[JointId],
) -> usize {
    let k = closure_of(exact, m).contours.len();
    let whole = redundant(exact, m, closure_of(exact, m).contours);
    let of = |&(joint, _): &(JointId, bool)| {
        let mut rest: Vec<&Contour> = Vec::new();
        for walk in all.iter().filter(|w| w.direction_of(joint).is_none()) {
            rest.push(walk);
            if rest.len() >= k || !independent(&rest, joints) {
                rest.pop();
            }
        }
        assert_eq!(rest.len() + 1, k, "what is left has a contour less");
        whole - redundant(exact, m, rest.into_iter().cloned().collect())
    };
    contour.joints.iter().map(of).max().unwrap()
}

fn closure_of(exact: &ExactField, m: &Mechanism) -> Closure<ozols::linalg::modp::Residue> {
    Closure::new(exact, m, StateId::FREE).unwrap()
}

#[test]
fn the_range_over_bases_is_that_of_every_basis() {
    let (mut seen, mut wider) = (0, 0);
    for name in builtin::names() {
        let m = built_in(name);
        let joints: Vec<JointId> = m.joints_in(StateId::FREE).collect();
        let exact = field_of(&m, StateId::FREE, 0).unwrap();
        let closure = Closure::new(&exact, &m, StateId::FREE).unwrap();
        let k = closure.contours.len();
        if !(2..=4).contains(&k) || joints.len() > 13 || !closure.couplings.is_empty() {
            continue;
        }
        seen += 1;
        let all = simple_cycles(&m, StateId::FREE).into_iter();
        let all: Vec<Contour> = all.map(|walk| closed_walk(&m, &walk).unwrap()).collect();
        let whole = redundant(&exact, &m, closure.contours.clone());
        let measured = Measured::new(&m, StateId::FREE, 1e-9)
            .unwrap()
            .contour_shares();
        for (share, by_values) in contour_shares(&exact, &closure).iter().zip(&measured) {
            let others = all.iter().combinations(k - 1);
            let last = others.filter_map(|rest| {
                let mut basis = vec![&share.contour];
                basis.extend(&rest);
                independent(&basis, &joints)
                    .then(|| whole - redundant(&exact, &m, rest.into_iter().cloned().collect()))
            });
            let greatest = last.max().unwrap();
            let (reached, most) = share.over_bases;
            let contour = share.contour.name(&m);
            assert!(
                (reached..=most).contains(&greatest),
                "{name} {contour}: {greatest}, not {reached} to {most}"
            );
            assert!(
                reached >= share.range.1 && share.range.0 <= share.redundant,
                "{name}"
            );
            assert_eq!(by_values.over_bases, share.over_bases, "{name} {contour}");
            let twin = beside_a_joint(&exact, &m, &share.contour, &all, &joints);
            assert_eq!(reached, twin.max(share.range.1), "{name} {contour}");
            wider += usize::from(reached > share.range.1);
        }
    }
    assert!(seen >= 20 && wider >= 4, "{seen} {wider}");
}

/// A parallelogram keeps the ratio of its cranks as their coupling does: one constraint is too many, and the contour may have it as
/// well as the coupling.
#[test]
fn a_coupling_can_take_a_constraint_over_from_a_contour() {
    let cranks = write_mechanism(
        "name = \"cranks\"\nmode = \"planar\"",
        "0 1 2* 3",
        "
        a | 0 1 | revolute | 0, 0, 0 | 0, 0, 1
        b | 1 2 | revolute | 1, 3, 0 | 0, 0, 1
        c | 2 3 | revolute | 6, 3, 0 | 0, 0, 1
        d | 0 3 | revolute | 5, 0, 0 | 0, 0, 1
        ",
    );
    let coupling = "[[coupling]]\njoints = [\"a\", \"d\"]\nratio = 1\n";
    let text = |more: &str| format!("{cranks}{more}");
    for (more, greatest) in [("", 0), (coupling, 1)] {
        let m = ozols::from_toml(&text(more)).unwrap();
        let exact = field_of(&m, StateId::FREE, 0).unwrap();
        let measured = Measured::new(&m, StateId::FREE, 1e-9)
            .unwrap()
            .contour_shares();
        for [share] in [contour_shares(&exact, &closure_of(&exact, &m)), measured].map(one) {
            assert_eq!((share.redundant, share.range), (0, (0, greatest)), "{more}");
        }
    }
}

fn one(of: Vec<ContourShare>) -> [ContourShare; 1] {
    of.try_into().unwrap()
}
