//! Releases of what is held twice: by virtual work, and by hand.

use crate::common::*;
use ozols::redundancy::release::added_freedoms;
use ozols::redundancy::stressed::Stressed;

fn stressed(m: &Mechanism) -> Vec<Stressed<'_>> {
    let found = state_figures(m, StateId::FREE).unwrap();
    let rank = found.freedoms - found.mobility;
    Stressed::stressed_parts(m, StateId::FREE, rank)
        .unwrap()
        .unwrap()
}

fn size(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The mechanisms of the catalogue that hold something twice, as far as they are small.
fn redundant() -> Vec<Mechanism> {
    let all = builtin::names().into_iter().map(built_in);
    all.filter(|m| m.joints.len() <= 14 && !stressed(m).is_empty())
        .collect()
}

/// Each part with each of its joints.
fn by_joint<'a, 'm>(
    parts: &'a [Stressed<'m>],
) -> impl Iterator<Item = (&'a Stressed<'m>, JointId)> {
    parts
        .iter()
        .flat_map(|p| p.joints.iter().map(move |&j| (p, j)))
}

/// A self-stress is in equilibrium: it does no work on what a joint lets go already, however many contours pass the joint and
/// whichever way they do.
#[test]
fn self_stresses_do_no_work_on_what_joints_let_go() {
    let (mut seen, mut several) = (0, 0);
    for m in redundant() {
        let parts = stressed(&m);
        let contours = ozols::closure::contour::contour_basis(&m, StateId::FREE);
        for (stressed, j) in by_joint(&parts) {
            let slides = match m.joints[j].joint_type {
                JointType::Revolute => false,
                JointType::Prismatic => true,
                _ => continue,
            };
            let axis = to_vector(&m.joints[j].frame.axis);
            let direction = axis.map(|x| x / size(&axis));
            let own = Release::Freedom {
                joint: j,
                slides,
                direction,
            };
            let work = size(&stressed.release_powers(&own));
            assert!(work < 1e-9, "{} {}: {work}", m.name, m.joints[j].id);
            seen += 1;
            let ways: Vec<bool> = contours.iter().filter_map(|c| c.direction_of(j)).collect();
            several += usize::from(ways.contains(&true) && ways.contains(&false));
        }
    }
    assert!(seen > 50 && several > 0, "{seen} {several}");
}

/// A direction stands for itself and its opposite: the one whose largest component is positive.
#[test]
fn directions_of_releases_point_to_the_positive_side() {
    let mut seen = 0;
    for m in redundant() {
        let parts = stressed(&m);
        for (stressed, j) in by_joint(&parts) {
            for release in stressed.releases_at(j) {
                let Release::Freedom { direction, .. } = release else {
                    panic!("a freedom of a joint")
                };
                // Where no force or moment says otherwise they are the joint's own axes as they are.
                let frame = &m.joints[j].frame;
                let (z, x) = (
                    unit(to_vector(&frame.axis)),
                    unit(to_vector(&frame.reference)),
                );
                let own = [z, x, cross(z, x)];
                if own.iter().any(|a| size(&cross(*a, direction)) < 1e-9) {
                    continue;
                }
                let most = direction.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
                let largest = direction.iter().find(|x| x.abs() > most - 1e-9).unwrap();
                assert!(
                    *largest > 0.0,
                    "{} {}: {direction:?}",
                    m.name,
                    m.joints[j].id
                );
                seen += 1;
            }
        }
    }
    assert!(seen > 10, "{seen}");
}

/// Of releases that cost the same, one that works well goes before one that hardly does.
#[test]
fn what_works_well_is_let_go_first() {
    let mut seen = 0;
    for m in &redundant() {
        let [stressed] = &stressed(m)[..] else {
            continue;
        };
        if stressed.count_redundant() > 1 {
            continue;
        }
        let all = stressed
            .joints
            .iter()
            .flat_map(|&j| stressed.releases_at(j));
        let mut all: Vec<(f64, Release)> = all
            .map(|r| (size(&stressed.release_powers(&r)), r))
            .collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (most, strong) = all[all.len() - 1];
        for (work, weak) in all.iter().filter(|(work, _)| *work < 0.49 * most) {
            assert_eq!(
                stressed.cheapest_releases(&[(1, *weak), (1, strong)]),
                [1],
                "{work}"
            );
            assert_eq!(stressed.cheapest_releases(&[(1, strong), (2, *weak)]), [0]);
            seen += 1;
        }
    }
    assert!(seen > 0);
}

/// By hand: a ball has the two turns that a hinge at its middle has not, wherever that is.
#[test]
fn a_ball_adds_two_turns_to_a_hinge_however_far_away() {
    for far in [0, 100, 100_000_000] {
        let frame = Frame {
            point: [far, far, far].map(Expr::from),
            axis: [0, 0, 1].map(Expr::from),
            reference: [1, 0, 0].map(Expr::from),
            pitch: Expr::from(0),
        };
        let found = added_freedoms(
            (&frame, &JointType::Revolute),
            (&frame, &JointType::Spherical),
        );
        let found = found.unwrap();
        assert_eq!(found.len(), 2, "{far}: {found:?}");
        for (slides, d) in found {
            assert!(!slides && d[2].abs() < 1e-12, "{far}: {d:?}");
        }
    }
    assert!(JointType::Spherical.freedoms().contains(&Freedom::Rz));
}
