//! Kinematic chains and the grippers made of them, against the counts of independent programs (two generators, two filters,
//! two canonical forms; OEIS A233288) and against a slow twin that tries every graph.

use crate::common::*;
use ozols::chains::Symmetry;
use ozols::chains::census::{Census, Counted, DriveKind, count_hinged};
use ozols::chains::enumerate::count_chains;
use ozols::chains::graph6::{self, Graph6Error};
use ozols::chains::layout_symmetry::working_swap;
use ozols::chains::roles::{Roles, Subject};

#[test]
fn as_many_chains_as_are_known() {
    for (mobility, from, known) in [
        (1, 4, &[1, 2, 16, 230][..]),
        (2, 5, &[1, 3, 35, 753]),
        (3, 6, &[1, 5, 74, 1962]),
    ] {
        for (i, &n) in known.iter().enumerate() {
            assert_eq!(
                count_chains(from + 2 * i, mobility),
                Ok(n),
                "{mobility} {i}"
            );
        }
    }
}

/// `cargo test --release --test integration larger_chains -- --ignored`
#[test]
#[ignore = "minutes without optimisation"]
fn as_many_larger_chains_as_are_known() {
    assert_eq!(count_chains(14, 1), Ok(318_162));
    assert_eq!(count_chains(13, 2), Ok(27_496));
    assert_eq!(count_chains(14, 3), Ok(83_547));
    let twelve = Census {
        chains: 6_856,
        frames: 75_397,
        inputs: 98_385,
        inputs_at_frame: 195_816,
        ..Census::default()
    };
    assert_eq!(count_hinged(12, 1, false), Ok(twelve));
}

#[test]
fn as_many_structures_as_are_known() {
    // Of ten links the shares of floating jaws are not published: they must add up.
    let known = [
        (4, [1, 1, 1, 1], [1, 1, 0, 0, 0, 0], Some(([0, 1, 0], 0))),
        (
            6,
            [2, 5, 6, 9],
            [46, 40, 15, 5, 2, 2],
            Some(([17, 19, 4], 31)),
        ),
        (
            8,
            [16, 71, 84, 153],
            [2017, 1356, 617, 53, 5, 0],
            Some(([774, 524, 58], 2656)),
        ),
        (
            10,
            [230, 1834, 2307, 4506],
            [115_123, 62_409, 31_772, 1067, 55, 46],
            None,
        ),
    ];
    for (links, [chains, frames, inputs, drives], of_two, more) in known {
        let found = count_hinged(links, 1, true).unwrap();
        let drives_found = found.inputs_at_frame;
        let counted = [found.chains, found.frames, found.inputs, drives_found];
        assert_eq!(counted, [chains, frames, inputs, drives]);
        let g = found.grippers[&DriveKind::of_hinges(2)];
        let grippers = [
            g[Counted::All],
            g[Counted::Essential],
            g[Counted::Truss],
            g[Counted::GraphSymmetric],
            g[Counted::Mirror],
            g[Counted::HalfTurn],
        ];
        let jaws_at_frame = [Counted::Floating, Counted::OneAtFrame, Counted::BothAtFrame];
        let jaws_at_frame = jaws_at_frame.map(|of| g[of]);
        assert_eq!(grippers, of_two, "{links}");
        assert_eq!(jaws_at_frame.iter().sum::<u64>(), g[Counted::Essential]);
        let g = found.grippers[&DriveKind::of_hinges(3)];
        // Of three jaws the first is published at six and eight links; the rest is what a program that shares nothing with this
        // one counts, by trying all numberings and taking singular values at threefold places.
        let of_three = match links {
            4 => [0, 0, 0, 0],
            6 => [31, 31, 0, 0],
            8 => [2656, 2215, 2, 2],
            _ => [226_163, 155_499, 10, 0],
        };
        let three = [
            g[Counted::All],
            g[Counted::Essential],
            g[Counted::GraphSymmetric],
            g[Counted::Threefold],
        ];
        assert_eq!(three, of_three, "{links}");
        if let Some((at_frame, three)) = more {
            assert_eq!(
                (jaws_at_frame, g[Counted::All]),
                (at_frame, three),
                "{links}"
            );
        }
    }
}

/// Every chain by trying every set of joints, and of those that differ in numbering the one whose list of joints is least.
fn by_trying(links: usize, mobility: usize) -> BTreeSet<Vec<(usize, usize)>> {
    let pairs: Vec<(usize, usize)> = (0..links).tuple_combinations().collect();
    let count = (3 * (links - 1) - mobility) / 2;
    let numberings = (0..links).permutations(links).collect_vec();
    let (mut found, mut numbered) = (BTreeSet::new(), BTreeSet::new());
    for joints in pairs.into_iter().combinations(count) {
        // Under another numbering it was there before.
        if numbered.contains(&joints) {
            continue;
        }
        let at = |l: usize| joints.iter().filter(|j| j.0 == l || j.1 == l).count();
        if (0..links).any(|l| at(l) < 2) {
            continue;
        }
        // No part is rigid; nothing falls apart, or would without one link.
        let inside = |part: usize| {
            joints
                .iter()
                .filter(|j| part >> j.0 & part >> j.1 & 1 == 1)
                .count()
        };
        let moves = |part: usize| {
            let n = part.count_ones() as usize;
            n < 2 || 3 * (n - 1) > 2 * inside(part)
        };
        let reached = |out: usize| {
            let mut seen = vec![(out + 1) % links];
            let mut next = 0;
            while let Some(&at) = seen.get(next) {
                next += 1;
                for j in &joints {
                    for (a, b) in [(j.0, j.1), (j.1, j.0)] {
                        if a == at && b != out && !seen.contains(&b) {
                            seen.push(b);
                        }
                    }
                }
            }
            seen.len() == links - 1
        };
        if !(0..1 << links).all(moves) || !(0..links).all(reached) {
            continue;
        }
        let image = |n: &Vec<usize>| {
            let pair = |&(u, v): &(usize, usize)| (n[u].min(n[v]), n[u].max(n[v]));
            joints.iter().map(pair).sorted().collect_vec()
        };
        let images: BTreeSet<_> = numberings.iter().map(image).collect();
        found.insert(images.first().unwrap().clone());
        numbered.extend(images);
    }
    found
}

#[test]
fn the_chains_are_those_that_trying_every_graph_finds() {
    for (links, mobility) in [(4, 1), (6, 1), (5, 2), (6, 3), (7, 2)] {
        let slow = by_trying(links, mobility);
        let slow: BTreeSet<String> = slow
            .into_iter()
            .map(|joints| {
                graph6::write_graph(&Chain::with_hinges(links, joints).canonical_form().0)
            })
            .collect();
        let fast = list_chains(links, mobility).unwrap();
        assert!(fast.iter().all(|c| c.mobility() == mobility));
        let fast: Vec<String> = fast.iter().map(graph6::write_graph).collect();
        assert_eq!(slow.into_iter().collect_vec(), fast, "{links} {mobility}");
    }
}

/// Names are for ever: a catalogue made today must be read tomorrow.
#[test]
fn names_stay() {
    let names = |links, mobility| -> Vec<String> {
        list_chains(links, mobility)
            .unwrap()
            .iter()
            .map(graph6::write_graph)
            .collect()
    };
    assert_eq!(names(4, 1), ["Cr"]);
    assert_eq!(names(6, 1), ["E_lo", "E`hW"]);
    assert_eq!(names(7, 2), ["F`Aio", "Fo@Xo", "FoDPW"]);
    assert_eq!(names(8, 1)[..3], ["G?Bcro", "G?qaho", "G?r@pg"]);
    let gripper = graph6::read_graph("I?BDA_g}?").unwrap();
    assert_eq!(
        graph6::write_graph(&gripper.canonical_form().0),
        "IQ?CQGKKw"
    );
}

/// [Pogrebnyak 2018]: the gripper is one of the structures that move in mirror places, of ten links and all of them needed.
#[test]
fn the_ten_link_gripper_is_among_the_structures() {
    let m = built_in("gripper-10");
    let joints = m
        .joints_in(StateId::FREE)
        .map(|j| m.joints[j].links.map(|l| l.index()));
    let used = |l: usize| {
        let mut free = m.joints_in(StateId::FREE);
        free.any(|j| m.joints[j].links.iter().any(|x| x.index() == l))
    };
    let links: Vec<usize> = (0..m.links.len()).filter(|&l| used(l)).collect();
    let place = |l: usize| links.iter().position(|&x| x == l).unwrap();
    let chain = Chain::with_hinges(links.len(), joints.map(|[u, v]| (place(u), place(v))));
    let known = graph6::read_graph("I?BDA_g}?").unwrap();
    assert_eq!(
        graph6::write_graph(&chain.canonical_form().0),
        graph6::write_graph(&known.canonical_form().0)
    );

    let frame = place(m.frame_link().index());
    let driven = m
        .joints_in(StateId::FREE)
        .find(|&j| m.joints[j].drive)
        .unwrap();
    let driver = m.joints[driven].links.map(|l| place(l.index()));
    let driver = driver.into_iter().find(|&l| l != frame).unwrap();
    let jaws = m.link_ids().filter(|&l| m.links[l].role == Role::Output);
    let jaws = jaws.map(|l| place(l.index())).sorted().collect_vec();
    let automorphisms = all_automorphisms(&chain);
    let subject = Subject::new(&chain, &automorphisms);
    let roles = Roles {
        frame,
        input: [frame.min(driver), frame.max(driver)],
        jaws,
    };
    assert!(subject.is_essential(&roles));
    assert_eq!(subject.jaws_at_frame(&roles), 0);
    assert!(working_swap(&subject, &roles, Symmetry::Mirror, Input::Slide).is_ok());
}

/// Automorphisms by trying every numbering that keeps the numbers of joints.
fn all_automorphisms(chain: &Chain) -> Vec<Vec<usize>> {
    fn extend(chain: &Chain, image: &mut Vec<usize>, out: &mut Vec<Vec<usize>>) {
        let at = image.len();
        if at == chain.links() {
            out.push(image.clone());
            return;
        }
        for to in 0..chain.links() {
            let fits = |from: usize| chain.is_joined(from, at) == chain.is_joined(image[from], to);
            if !image.contains(&to) && (0..at).all(fits) {
                image.push(to);
                extend(chain, image, out);
                image.pop();
            }
        }
    }
    let mut out = Vec::new();
    extend(chain, &mut Vec::new(), &mut out);
    out
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]
    #[test]
    fn a_name_does_not_depend_on_the_numbering(
        links in 4usize..9,
        density in 2u32..8,
        bits in any::<u64>(),
        order in any::<u64>(),
    ) {
        let pairs = (0..links).tuple_combinations::<(usize, usize)>();
        let mixed = |i: usize, x: u64| x.rotate_left(u32::try_from(7 * i).unwrap()).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 61;
        let joints = pairs.enumerate().filter(|(i, _)| mixed(*i, bits) < u64::from(density));
        let joints = joints.map(|(_, p)| p).collect_vec();
        let chain = Chain::with_hinges(links, joints.iter().copied());
        let place = (0..links).sorted_by_key(|&i| (mixed(i, order), i)).collect_vec();
        let other = Chain::with_hinges(links, joints.iter().map(|&(u, v)| (place[u], place[v])));
        prop_assert_eq!(graph6::write_graph(&chain.canonical_form().0), graph6::write_graph(&other.canonical_form().0));
        let (canonical, automorphisms) = chain.canonical_form();
        let slow: BTreeSet<_> = all_automorphisms(&canonical).into_iter().collect();
        let count = automorphisms.len();
        prop_assert_eq!(automorphisms.into_iter().collect::<BTreeSet<_>>(), slow.clone());
        prop_assert_eq!(count, slow.len());
        prop_assert_eq!(graph6::read_graph(&graph6::write_graph(&chain)), Ok(chain));
    }
}

#[test]
fn texts_that_are_no_chains_are_refused() {
    assert_eq!(graph6::read_graph("C r"), Err(Graph6Error::Character(' ')));
    assert_eq!(graph6::read_graph(""), Err(Graph6Error::Links(0)));
    assert_eq!(graph6::read_graph("~?@A"), Err(Graph6Error::Links(63)));
    let short = Graph6Error::Length {
        links: 8,
        wanted: 6,
        found: 3,
    };
    assert_eq!(graph6::read_graph("G?B"), Err(short));
}

#[test]
fn the_command_counts_and_lists() {
    let counted = run_quiet("catalog count");
    has_all(
        &counted,
        &["grippers of two jaws", "1,356", "4 links", "8 links"],
    );
    let rows = run_json("catalog count --links 6..9 --format json");
    assert_eq!(rows.list().len(), 2);
    assert_eq!(rows[1]["three_jaws"], 2656);
    let counted = run_quiet("catalog count --chains --links 10..12");
    let table = counted.lines().take_while(|l| !l.is_empty()).collect_vec();
    assert_eq!(table.len(), 3, "chains alone: {counted}");
    has_all(table[2], &["230", "6,856"]);
    let listed = run_json("catalog chains --links 6 --format json");
    let drives = listed.list().iter().map(|c| c["drives"].whole());
    assert_eq!(drives.sum::<u64>(), 9);
    let listed = run_quiet("catalog chains --links 6 --format csv");
    assert_eq!(listed.lines().count(), 3);
    assert_eq!(run_full("catalog count --links 7").0, Some(1));
}
