//! Every essential structure of three and four links by its code, as the twin below numbers it and an independent program listed it.

use super::{ANY, menu};
use crate::common::*;
use flate2::read::GzDecoder;
use ozols::chains::PairKind;
use ozols::chains::roles::{Roles, Subject};
use ozols::chains::visit::visit_pair_chains;
use std::sync::Mutex;

/// The letters of a numbering, and the roles in it.
fn code(subject: &Subject<'_>, roles: &Roles, place: &[usize]) -> String {
    let n = place.len();
    let at = |number: usize| place.iter().position(|&p| p == number).unwrap();
    let pairs = (0..n).flat_map(|v| (0..v).map(move |u| (u, v)));
    let letter = |(u, v)| {
        subject
            .chain
            .pair_between(at(u), at(v))
            .map_or('-', PairKind::code_letter)
    };
    let letters = pairs.map(letter).join("");
    let both = |[a, b]: [usize; 2]| [place[a].min(place[b]), place[a].max(place[b])];
    let jaws = [roles.jaws[0], roles.jaws[1]];
    let ([i, k], [a, b]) = (both(roles.input), both(jaws));
    format!("{letters} f{} i{i}-{k} j{a},{b}", place[roles.frame])
}

/// The least of all numberings, each tried.
fn least_code(subject: &Subject<'_>, roles: &Roles) -> String {
    let n = subject.chain.links();
    let all = (0..n)
        .permutations(n)
        .map(|place| code(subject, roles, &place));
    all.min().unwrap()
}

fn words(subject: &Subject<'_>, roles: &Roles) -> String {
    let [u, v] = roles.input;
    let place = if roles.is_driven_from_frame() {
        "ground"
    } else {
        "float"
    };
    let direct = if roles.has_driven_jaw() {
        "-direct"
    } else {
        ""
    };
    let s = subject.find_symmetries(roles);
    let flag = |strict: bool, loose: bool, name: &str| {
        let but = if strict { "" } else { "-but-input" };
        if loose {
            format!(" {name}{but}")
        } else {
            String::new()
        }
    };
    format!(
        "{place}{direct} {}{}{}{}",
        subject.chain.pair_between(u, v).unwrap().code_letter(),
        if subject.is_translating(roles) {
            " parallel"
        } else {
            ""
        },
        flag(s.mirror, s.mirror_but_input, "mirror"),
        flag(s.half_turn, s.half_turn_but_input, "halfturn"),
    )
}

#[test]
fn structures_of_three_and_four_links_are_those_listed() {
    for links in [3, 4] {
        let own = Mutex::new(BTreeSet::new());
        visit_pair_chains(links, menu(ANY), &|subject| {
            for (frame, input) in subject.list_drives() {
                let all = subject.list_grippers(frame, &input, 2).into_iter();
                for roles in all.filter(|r| subject.is_essential(r)) {
                    let line =
                        format!("{} {}", least_code(subject, &roles), words(subject, &roles));
                    assert!(own.lock().unwrap().insert(line), "twice the same");
                }
            }
        });
        let own = own.into_inner().unwrap();
        let packed = read_data_bytes(&format!("codes-{links}.txt.gz"));
        let mut text = String::new();
        GzDecoder::new(&packed[..])
            .read_to_string(&mut text)
            .unwrap();
        let listed: BTreeSet<String> = text.lines().map(str::to_owned).collect();
        let both = own.symmetric_difference(&listed).collect_vec();
        assert!(both.is_empty(), "{links}: {both:#?}");
    }
}
