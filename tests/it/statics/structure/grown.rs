//! Chains grown from Assur groups decompose into them again.

use super::super::{J, planar_file, sliding_joint, turning_joint};
use super::{by_brute_force, laws};
use crate::common::*;
use ozols::statics::assur::decompose_alternatives;
use ozols::statics::planar::PairKind;

/// Chains grown group by group: dyads, triads and closed contours hung on bodies that are already there.
fn grown() -> impl Strategy<Value = (Vec<J>, usize)> {
    let seed = proptest::collection::vec((0..4usize, any::<[u16; 4]>(), any::<[i16; 12]>()), 1..5);
    seed.prop_map(|steps| {
        let mut joints = vec![turning_joint("0", "1", 0., 0.)];
        let mut bodies = vec!["0".to_owned(), "1".to_owned()];
        for (what, on, xy) in &steps {
            let at = |i: usize| {
                (
                    f64::from(xy[(2 * i) % 12]) / 8.0,
                    f64::from(xy[(2 * i + 1) % 12]) / 8.0,
                )
            };
            // The last body always carries the next group, so that drives matter.
            let base = |i: usize| {
                if i == 0 {
                    bodies[bodies.len() - 1].clone()
                } else {
                    bodies[usize::from(on[i]) % bodies.len()].clone()
                }
            };
            let name = |i: usize| format!("{}", bodies.len() + i);
            let join = |a: String, b: String, i: usize| turning_joint(&a, &b, at(i).0, at(i).1);
            let (n, new) = match what {
                0 | 1 => (
                    2,
                    vec![
                        join(base(0), name(0), 0),
                        join(name(0), name(1), 1),
                        join(name(1), base(1), 2),
                    ],
                ),
                2 => (
                    4,
                    vec![
                        join(name(0), name(1), 0),
                        join(name(0), name(2), 1),
                        join(name(0), name(3), 2),
                        join(name(1), base(0), 3),
                        join(name(2), base(1), 4),
                        join(name(3), base(2), 5),
                    ],
                ),
                _ => (
                    4,
                    vec![
                        join(base(0), name(0), 0),
                        join(name(0), name(1), 1),
                        join(name(0), name(2), 2),
                        join(name(3), name(1), 3),
                        join(name(3), name(2), 4),
                        sliding_joint(&base(1), &name(3), at(5).0, at(5).1, [1.0, 0.25]),
                    ],
                ),
            };
            joints.extend(new);
            for _ in 0..n {
                bodies.push(format!("{}", bodies.len()));
            }
        }
        // Joints are told apart by name; a group may hang twice on one body.
        (joints, steps.len())
    })
}

fn grown_mechanism(joints: &[J]) -> PlanarMechanism {
    let text = planar_file(joints, "");
    let mut n = 0;
    let renamed = text.split("[[joint]]\nid = \"").map(|part| {
        n += 1;
        if n == 1 {
            part.to_owned()
        } else {
            format!("[[joint]]\nid = \"j{n} {part}")
        }
    });
    PlanarMechanism::new(&read(&renamed.collect::<String>()), StateId::FREE).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, failure_persistence: None, ..ProptestConfig::default() })]

    /// A chain grown by k groups decomposes into k groups, which brute force finds too.
    #[test]
    fn grown_chains_decompose_into_what_they_grew_from((joints, grown) in grown()) {
        let m = grown_mechanism(&joints);
        let d = decompose_groups(&m, &m.driven_pairs()).unwrap();
        laws(&m, &d);
        prop_assert_eq!(d.groups.len(), grown);
        if m.bodies.len() <= 14 {
            let mut groups = d.groups.iter().map(|g| g.bodies.clone()).collect_vec();
            groups.sort();
            prop_assert_eq!(groups, by_brute_force(&m, &d.driven));
        }
    }

    /// Under any drive that makes the chain determinate the laws hold; a drive at the frame always does.
    #[test]
    fn every_drive_obeys_the_laws((joints, _) in grown()) {
        let m = grown_mechanism(&joints);
        for (q, d) in decompose_alternatives(&m, &m.driven_pairs()) {
            if let Ok(d) = d {
                laws(&m, &d);
                let locked = d.groups.iter().map(|g| g.locked.len()).sum::<usize>() + d.driven_pairs.len();
                prop_assert_eq!(locked, 1);
                prop_assert!(m.pairs[q].kind != PairKind::Rigid);
            }
        }
    }
}
