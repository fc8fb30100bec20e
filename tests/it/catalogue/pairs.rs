//! Chains of hinges, slides, gears and slots against the counts of two independent programs (`tests/data/README.md`),
//! against hinged chains, in which a rod is a slot, and against a twin that tries every numbering.

use crate::common::*;
pub(super) mod classics;
mod codes;
mod command;
mod two_slots;

use ozols::chains::PairKind;
use ozols::chains::census::{Census, Counted, DriveKind, Kinds, pair_census};
use ozols::chains::sharing::Menu;
use ozols::chains::symmetric_census::{SymmetricKind, symmetric_grippers};

pub(super) const ALL: [PairKind; 3] = [PairKind::Slide, PairKind::Gear, PairKind::Slot];

/// More than any chain of six links has.
const ANY: usize = 15;

pub(super) fn menu(most: usize) -> Menu<'static> {
    Menu { kinds: &ALL, most }
}

/// Every cell of the published counts up to six links, with all its columns.
#[test]
fn as_many_as_two_other_programs_count() {
    let found: BTreeMap<usize, BTreeMap<Kinds, Census>> = (3..=6)
        .map(|links| (links, pair_census(links, menu(ANY), true)))
        .collect();
    let sum = |links: usize, of: fn(&Census) -> u64| found[&links].values().map(of).sum();
    let chains: [u64; 4] = [3, 4, 5, 6].map(|n| sum(n, |c| c.chains));
    assert_eq!(chains, [5, 58, 1_307, 57_499]);
    let inputs: [u64; 4] = [3, 4, 5, 6].map(|n| sum(n, |c| c.inputs_at_frame + c.inputs_between));
    assert_eq!(inputs, [21, 533, 23_267, 1_550_567]);
    let mut cells = 0;
    for line in read_data("counts.csv").lines().skip(1) {
        let numbers = line.split(',').map(|n| n.parse::<u64>().ok()).collect_vec();
        let size = |i: usize| usize::try_from(numbers[i].unwrap()).unwrap();
        let kinds = Kinds {
            slides: size(1),
            gears: size(2),
            slots: size(3),
            two_slots: 0,
        };
        let own = row(&found[&size(0)][&kinds]);
        for (i, (own, published)) in own.iter().zip(&numbers[5..]).enumerate() {
            assert_eq!(Some(*own), *published, "column {} of {line}", i + 5);
        }
        assert_eq!(own.len(), numbers.len() - 5);
        cells += 1;
    }
    assert_eq!(cells, found.values().map(BTreeMap::len).sum::<usize>());
}

/// The columns of the published counts.
fn row(c: &Census) -> Vec<u64> {
    let mut out = vec![c.chains, c.frames, c.inputs_at_frame, c.inputs_between];
    let places = [false, true].into_iter().cartesian_product([false, true]);
    for ((between, jaw), slides) in places.cartesian_product([false, true]) {
        let drive = DriveKind {
            jaws: 2,
            between,
            jaw,
            slides,
        };
        let g = c.grippers.get(&drive).copied().unwrap_or_default();
        out.extend([
            g[Counted::All],
            g[Counted::Essential],
            g[Counted::Translating],
            g[Counted::GraphSymmetric],
            g[Counted::Mirror],
            g[Counted::MirrorButInput],
            g[Counted::HalfTurn],
            g[Counted::HalfTurnButInput],
        ]);
    }
    out
}

#[test]
fn as_many_symmetric_ones_as_are_published() {
    // By symmetry and whether a jaw is driven: by choices, and of three to six links.
    let known = [
        (
            false,
            false,
            "0 0 0 0, 0 0 2 2, 0 4 5 20, 0 3 28 147, 0 1 69 518, 0 0 60 1303",
        ),
        (
            false,
            true,
            "0 0 0 0, 0 0 2 0, 0 0 5 6, 0 1 6 23, 0 1 12 55, 0 0 11 123",
        ),
        (
            true,
            false,
            "0 0 0 2, 0 4 0 6, 0 4 0 66, 0 1 17 248, 0 0 20 264, 0 0 8 351",
        ),
        (
            true,
            true,
            "0 0 0 0, 0 0 0 0, 0 0 0 6, 0 1 0 8, 0 0 0 25, 0 0 5 34",
        ),
    ];
    for (i, links) in (3..=6).enumerate() {
        let found = symmetric_census(links, menu(5));
        for (half_turn, driven_jaw, counts) in known {
            for (orbits, counts) in counts.split(", ").enumerate() {
                let kind = SymmetricKind {
                    half_turn,
                    driven_jaw,
                    orbits,
                };
                let found = found.get(&kind).copied().unwrap_or_default();
                let wanted = counts.split(' ').nth(i).unwrap();
                assert_eq!(found.to_string(), wanted, "{links} links, {kind:?}");
            }
        }
    }
}

/// The numbers of symmetric grippers by how they count.
fn symmetric_census(links: usize, menu: Menu<'_>) -> BTreeMap<SymmetricKind, u64> {
    let mut out = BTreeMap::new();
    for gripper in symmetric_grippers(links, menu) {
        *out.entry(gripper.kind).or_default() += 1;
    }
    out
}

/// Made by halves or found among all: two ways to the same grippers, of eight links, too, where nothing is published.
#[test]
fn halves_give_the_symmetric_ones_of_all() {
    let (slides, slots) = (&[PairKind::Slide][..], &[PairKind::Slot][..]);
    for (links, kinds) in [
        (5, &ALL[..]),
        (6, slides),
        (6, slots),
        (7, slots),
        (8, slides),
    ] {
        let menu = Menu { kinds, most: ANY };
        let all = pair_census(links, menu, true);
        let all = all.values().flat_map(|c| &c.grippers).collect_vec();
        let halves = symmetric_census(links, menu);
        for (half_turn, jaw) in [(false, false), (false, true), (true, false), (true, true)] {
            let own = all.iter().filter(|(d, _)| d.jaw == jaw);
            let of = [Counted::Mirror, Counted::HalfTurn][usize::from(half_turn)];
            let flagged = own.map(|(_, g)| g[of]);
            let made = halves
                .iter()
                .filter(|(k, _)| k.half_turn == half_turn && k.driven_jaw == jaw);
            let (flagged, made): (u64, u64) = (flagged.sum(), made.map(|(_, n)| n).sum());
            assert_eq!(made, flagged, "{links} links, {kinds:?}, {half_turn} {jaw}");
        }
    }
}

/// Rods of a hinged chain: links of two joints, no two of them joined, none between the same two links as another or between
/// links that are joined already. A rod holds two links at a distance, as a slot holds them along a line.
fn rods(chain: &Chain, count: usize) -> Vec<Vec<usize>> {
    let near = |l: usize| (0..chain.links()).filter(move |&m| chain.is_joined(l, m));
    let binary = (0..chain.links()).filter(|&l| near(l).count() == 2);
    let ends = |l: usize| near(l).collect_vec();
    let sets = binary.combinations(count);
    let good = sets.filter(|set| {
        let apart = set
            .iter()
            .tuple_combinations()
            .all(|(&a, &b)| !chain.is_joined(a, b));
        let ends = set.iter().map(|&l| ends(l)).collect_vec();
        apart && ends.iter().all_unique() && ends.iter().all(|e| !chain.is_joined(e[0], e[1]))
    });
    good.collect()
}

/// How many things are left of a list where automorphisms make some of them one.
fn up_to<T: Ord>(
    all: &[T],
    automorphisms: &[Vec<usize>],
    image: impl Fn(&T, &[usize]) -> T,
) -> u64 {
    let first = |x: &&T| automorphisms.iter().all(|a| image(x, a) >= **x);
    all.iter().filter(first).count() as u64
}

/// Chains of hinges and slots up to eight links, where nothing is published beyond six, from hinged chains of up to ten.
#[test]
fn slots_are_rods() {
    for (links, slots) in [
        (4, 2),
        (5, 1),
        (5, 3),
        (6, 2),
        (6, 4),
        (7, 1),
        (7, 3),
        (8, 2),
    ] {
        let mut expected = [0; 4];
        for chain in list_chains(links + slots, 1).unwrap() {
            let (chain, automorphisms) = chain.canonical_form();
            let sets = rods(&chain, slots);
            let joints = chain.joints().into_iter();
            let joints = joints.map(|j| (j.links[0], j.links[1])).collect_vec();
            let image =
                |set: &[usize], a: &[usize]| set.iter().map(|&l| a[l]).sorted().collect_vec();
            let joint = |(u, v): (usize, usize), a: &[usize]| (a[u].min(a[v]), a[u].max(a[v]));
            expected[0] += up_to(&sets, &automorphisms, |s, a| image(s, a));
            let links = 0..chain.links();
            let frames = sets.iter().cartesian_product(links);
            let frames = frames.filter(|(s, f)| !s.contains(f));
            let frames = frames.map(|(s, f)| (s.clone(), f)).collect_vec();
            expected[1] += up_to(&frames, &automorphisms, |(s, f), a| (image(s, a), a[*f]));
            for (place, count) in expected[2..].iter_mut().enumerate() {
                let inputs = frames.iter().cartesian_product(&joints);
                let inputs = inputs.filter(|((s, f), (u, v))| {
                    let between = u != f && v != f;
                    !s.contains(u) && !s.contains(v) && between == (place == 1)
                });
                let inputs = inputs.map(|((s, f), j)| (s.clone(), *f, *j)).collect_vec();
                *count += up_to(&inputs, &automorphisms, |(s, f, j), a| {
                    (image(s, a), a[*f], joint(*j, a))
                });
            }
        }
        let slots_alone = Menu {
            kinds: &[PairKind::Slot],
            most: slots,
        };
        let found = pair_census(links, slots_alone, false);
        let kinds = Kinds {
            slots,
            ..Kinds::default()
        };
        let c = &found[&kinds];
        let counted = [c.chains, c.frames, c.inputs_at_frame, c.inputs_between];
        assert_eq!(counted, expected, "{links} links, {slots} slots");
    }
}

/// A chain with one slide is a hinged chain with one joint chosen, as many as there are input joints, which two independent programs counted.
#[test]
fn one_slide_is_one_input_joint() {
    for (links, inputs) in [(4, 1), (6, 6), (8, 84), (10, 2_307)] {
        let slide = Menu {
            kinds: &[PairKind::Slide],
            most: 1,
        };
        let found = pair_census(links, slide, false);
        let one = Kinds {
            slides: 1,
            ..Kinds::default()
        };
        assert_eq!(found[&one].chains, inputs, "{links}");
    }
}

/// The published counts, hinges and slides only.
#[test]
fn slides_alone() {
    let known: [&[u64]; 3] = [&[1, 1, 2], &[2, 6, 16, 19, 9], &[16, 84, 345, 776]];
    for (links, known) in [4, 6, 8].into_iter().zip(known) {
        let slides = Menu {
            kinds: &[PairKind::Slide],
            most: known.len() - 1,
        };
        let found = pair_census(links, slides, false);
        let counted = found.values().map(|c| c.chains).collect_vec();
        assert_eq!(counted, known, "{links}");
    }
}
