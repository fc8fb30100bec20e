//! The classic schemes are structures of the count, and have the symmetries that independent programs found.

use super::menu;
use crate::common::*;
use ozols::chains::PairKind;
use ozols::chains::motion::moves_throughout;
use ozols::chains::roles::Subject;
use ozols::chains::visit::visit_pair_chains;

/// What independent programs say of a scheme, a line of `tests/data/schemes.csv`.
pub(in super::super) struct SchemeFigures {
    pub(in super::super) id: String,
    /// How its jaws move: `angular`, `parallel` or `general`.
    pub(in super::super) jaws: String,
    /// Essential, translating, and the four symmetries; none of what was too dear for those programs.
    flags: Vec<Option<bool>>,
}

/// Returns what is known of each scheme that is a structure as they are counted.
pub(in super::super) fn schemes() -> Vec<SchemeFigures> {
    let flag = |word: &str| match word {
        "yes" => Some(true),
        "no" => Some(false),
        other => {
            assert_eq!(other, "");
            None
        }
    };
    let of_line = |line: &str| {
        let cells = line.split(',').collect_vec();
        assert_eq!(cells.len(), 8, "{line}");
        SchemeFigures {
            id: cells[0].to_owned(),
            jaws: cells[1].to_owned(),
            flags: cells[2..].iter().map(|c| flag(c)).collect(),
        }
    };
    let all = read_data("schemes.csv")
        .lines()
        .skip(1)
        .map(of_line)
        .collect_vec();
    assert_eq!(all.len(), 31);
    all
}

/// How often the count visits a chain.
fn visits(chain: &Chain, most: usize) -> usize {
    let (own, times) = (chain.canonical_form().0, AtomicUsize::new(0));
    visit_pair_chains(chain.links(), menu(most), &|subject| {
        if subject.chain.canonical_form().0 == own {
            times.fetch_add(1, Ordering::Relaxed);
        }
    });
    times.into_inner()
}

#[test]
fn classic_schemes_are_in_the_count() {
    let mut visited = 0;
    for scheme in schemes() {
        let id = &scheme.id;
        let classic = known_classics().iter().find(|c| c.id == *id).unwrap();
        let (chain, roles) = (&classic.structure.chain, &classic.structure.roles);
        let links = chain.links();
        assert!(chain.has_carriers() && moves_throughout(chain), "{id}");
        let automorphisms = chain.automorphisms();
        if links <= 6 {
            let tried = every_automorphism(chain);
            assert_eq!(
                automorphisms.iter().cloned().sorted().collect_vec(),
                tried,
                "{id}"
            );
        }
        let subject = Subject::new(chain, &automorphisms);
        let s = subject.find_symmetries(roles);
        let own = [
            subject.is_essential(roles),
            subject.is_translating(roles),
            s.mirror,
            s.mirror_but_input,
            s.half_turn,
            s.half_turn_but_input,
        ];
        for (n, (own, said)) in own.into_iter().zip(&scheme.flags).enumerate() {
            assert!(
                said.is_none_or(|said| said == own),
                "{id}: flag {n} is {own}"
            );
        }
        let pairs = (0..links).tuple_combinations();
        let kinds = pairs.filter_map(|(u, v)| chain.pair_between(u, v));
        let most = kinds.filter(|kind| *kind != PairKind::Hinge).count();
        if links <= 5 || links == 6 && most <= 3 || most <= 1 {
            assert_eq!(visits(chain, most), 1, "{id}");
            visited += 1;
        }
    }
    assert!(visited >= 23, "{visited}");
}

/// Every numbering that leaves the chain as it is.
fn every_automorphism(chain: &Chain) -> Vec<Vec<usize>> {
    let n = chain.links();
    let all = (0..n).permutations(n);
    let keeps = |p: &Vec<usize>| {
        let mut pairs = (0..n).tuple_combinations();
        pairs.all(|(u, v)| chain.pair_between(u, v) == chain.pair_between(p[u], p[v]))
    };
    all.filter(keeps).collect()
}
