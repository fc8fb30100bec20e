//! Two pins in two slots between the same links, against a twin that tries every way to join numbered links, and takes two slots for
//! what they are: two lines of action.

use super::super::paired::three_generic::every_way::{moves, place, renumbered};
use crate::common::*;
use ozols::chains::PairKind;
use ozols::chains::census::{Kinds, pair_census};
use ozols::chains::sharing::Menu;

#[test]
fn as_many_as_every_way_to_join_numbered_links() {
    let kinds = [
        PairKind::Slide,
        PairKind::Gear,
        PairKind::Slot,
        PairKind::TwoSlots,
    ];
    for links in 3..=4usize {
        let numberings = (0..links).permutations(links).collect_vec();
        let mut chains: BTreeMap<Kinds, [BTreeSet<Vec<String>>; 3]> = BTreeMap::new();
        let letters = (0..links * (links - 1) / 2).map(|_| "-GPRSD".chars());
        for letters in letters.multi_cartesian_product() {
            // One of each class is looked at.
            let image = |n: &Vec<usize>| renumbered(&letters, n);
            if numberings.iter().any(|n| image(n) < letters) || !moves(&letters, links) {
                continue;
            }
            let many = |letter| letters.iter().filter(|l| **l == letter).count();
            let kinds = Kinds {
                slides: many('P'),
                gears: many('G'),
                slots: many('S'),
                two_slots: many('D'),
            };
            let cell = chains.entry(kinds).or_default();
            let name = letters.iter().collect::<String>();
            // Choices that a numbering that changes nothing carries to each other are one.
            let same = numberings.iter().filter(|n| image(n) == letters);
            let same = same.collect_vec();
            cell[0].insert(vec![name.clone()]);
            for frame in 0..links {
                let least = same.iter().map(|n| n[frame]).min().unwrap();
                cell[1].insert(vec![name.clone(), least.to_string()]);
                let joined = (0..links).tuple_combinations();
                for (u, v) in joined.filter(|&(u, v)| "RP".contains(letters[place(u, v)])) {
                    let image = |n: &&Vec<usize>| (n[frame], n[u].min(n[v]), n[u].max(n[v]));
                    let least = same.iter().copied().map(|n| image(&n)).min().unwrap();
                    cell[2].insert(vec![name.clone(), format!("{least:?}")]);
                }
            }
        }
        let found = pair_census(
            links,
            Menu {
                kinds: &kinds,
                most: 15,
            },
            true,
        );
        let twin = chains
            .iter()
            .map(|(k, c)| (*k, [0, 1, 2].map(|i| c[i].len() as u64)));
        let counted = found.iter().map(|(k, c)| {
            (
                *k,
                [c.chains, c.frames, c.inputs_at_frame + c.inputs_between],
            )
        });
        assert_eq!(
            counted.collect::<BTreeMap<_, _>>(),
            twin.collect::<BTreeMap<_, _>>(),
            "{links} links"
        );
    }
}

/// Lines of action meet in a point: without slides two slots count as a hinge that is told apart.
#[test]
fn two_slots_count_as_hinges_do() {
    let both = |kind| {
        let kinds = [kind];
        let found = pair_census(
            6,
            Menu {
                kinds: &kinds,
                most: 1,
            },
            false,
        );
        found.into_values().map(|c| c.chains).collect_vec()
    };
    assert_eq!(both(PairKind::TwoSlots), both(PairKind::Slide));
}
