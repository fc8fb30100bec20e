//! The classic schemes of `../shared/pairs/classic.json`: 31 of 37 are structures of the count, with what their own checks say.

use super::{menu, shared};
use itertools::Itertools;
use ozols::chains::pairs::census::visit_pair_chains;
use ozols::chains::pairs::chain::{Joint, PairChain};
use ozols::chains::pairs::kind::PairKind;
use ozols::chains::pairs::motion::moves_throughout;
use ozols::chains::pairs::roles::{PairRoles, PairSubject};
use serde_json::Value;
use std::sync::atomic::{AtomicUsize, Ordering};

fn place(scheme: &Value, link: &Value) -> usize {
    let links = scheme["links"].as_array().unwrap();
    links.iter().position(|l| l == link).unwrap()
}

fn two(scheme: &Value, links: &Value) -> [usize; 2] {
    let [a, b] = [0, 1].map(|i| place(scheme, &links[i]));
    [a.min(b), a.max(b)]
}

fn joint(scheme: &Value, joint: &Value) -> Joint {
    let letter = joint[2].as_str().unwrap().chars().next();
    let kind = PairKind::ALL.iter().find(|k| Some(k.2) == letter);
    Joint {
        links: two(scheme, joint),
        pair: kind.unwrap().0,
    }
}

/// How often the count visits a chain.
fn visits(chain: &PairChain, most: usize) -> usize {
    let (own, times) = (chain.canonical(), AtomicUsize::new(0));
    visit_pair_chains(chain.links(), menu(most), &|subject| {
        if subject.chain.canonical() == own {
            times.fetch_add(1, Ordering::Relaxed);
        }
    });
    times.into_inner()
}

#[test]
fn classic_schemes_are_in_the_count() {
    let all: Value = serde_json::from_str(&shared("classic.json")).unwrap();
    let schemes = all["schemes"].as_array().unwrap();
    let (mut counted, mut visited) = (0, 0);
    for scheme in schemes
        .iter()
        .filter(|s| s["match"].as_str().unwrap().starts_with("found"))
    {
        let (id, check) = (&scheme["id"], &scheme["check"]);
        let joints = scheme["joints"].as_array().unwrap().iter();
        let joints = joints.map(|j| joint(scheme, j)).collect_vec();
        let links = scheme["links"].as_array().unwrap().len();
        let chain = PairChain::new(links, joints);
        assert!(chain.has_carriers() && moves_throughout(&chain), "{id}");
        let automorphisms = chain.automorphisms();
        if links <= 6 {
            let tried = every_automorphism(&chain);
            assert_eq!(
                automorphisms.iter().cloned().sorted().collect_vec(),
                tried,
                "{id}"
            );
        }
        let automorphisms = automorphisms.iter().collect_vec();
        let subject = PairSubject::new(&chain, &automorphisms);
        let roles = PairRoles {
            frame: place(scheme, &scheme["frame"]),
            input: two(scheme, &scheme["input"]),
            jaws: two(scheme, &scheme["jaws"]).to_vec(),
        };
        let s = subject.symmetries(&roles);
        let own = [
            subject.is_essential(&roles),
            subject.is_translating(&roles),
            s.mirror,
            s.mirror_but_input,
            s.half_turn,
            s.half_turn_but_input,
        ];
        let keys = [
            "essential",
            "jaws_only_translate",
            "mirror",
            "mirror_but_input",
            "halfturn",
            "halfturn_but_input",
        ];
        // What is not said of ten links was too dear for the program that checked them.
        for (key, own) in keys.into_iter().zip(own) {
            let said = &check[key];
            assert!(said.is_null() || *said == own, "{id}: {key} is {own}");
        }
        let most = usize::try_from(scheme["pairs_not_hinges"].as_u64().unwrap()).unwrap();
        if links <= 5 || links == 6 && most <= 3 || most <= 1 {
            assert_eq!(visits(&chain, most), 1, "{id}");
            visited += 1;
        }
        counted += 1;
    }
    assert_eq!(counted, 31);
    assert!(visited >= 23, "{visited}");
}

/// Every numbering that leaves the chain as it is.
fn every_automorphism(chain: &PairChain) -> Vec<Vec<usize>> {
    let n = chain.links();
    let all = (0..n).permutations(n);
    let keeps = |p: &Vec<usize>| {
        let mut pairs = (0..n).tuple_combinations();
        pairs.all(|(u, v)| chain.between(u, v) == chain.between(p[u], p[v]))
    };
    all.filter(keeps).collect()
}
