//! What of a catalogue is next to a gripper, against every way of taking two links out.

use super::rows::all_of_six;
use crate::common::*;
use ozols::catalog::neighbours::{FIGURES, find_neighbours};
use ozols::catalog::store::Store;
use ozols::synthesis::recognize::recognize_structure;

/// Whether a small structure is a large one without two links in a row: all ways to place the small one's links on the large one's.
fn is_left(small: &PairStructure, large: &PairStructure) -> bool {
    let links = large.chain.links();
    let placed = (0..links).permutations(links - 2);
    placed.into_iter().any(|at| {
        let out = (0..links).filter(|l| !at.contains(l)).collect_vec();
        let joined = |l: usize| {
            let others = (0..links).filter(move |&o| large.chain.pair_between(l, o).is_some());
            others.collect_vec()
        };
        let [u, v] = [out[0], out[1]];
        let hung = |l: usize, beside: usize| match joined(l)[..] {
            [a, b] if a == beside => Some(b),
            [a, b] if b == beside => Some(a),
            _ => None,
        };
        let (Some(x), Some(y)) = (hung(u, v), hung(v, u)) else {
            return false;
        };
        let pairs = (0..links - 2).tuple_combinations();
        let same = |(a, b): (usize, usize)| {
            small.chain.pair_between(a, b) == large.chain.pair_between(at[a], at[b])
        };
        let roles = &small.roles;
        let jaws = [0, 1].map(|n| at[roles.jaws[n]]);
        let stands_for =
            |jaw: usize, by: usize| jaw == by || (out.contains(&jaw) && [x, y].contains(&by));
        let gripping = |[a, b]: [usize; 2]| {
            let [p, q] = large.roles.jaws[..] else {
                return false;
            };
            stands_for(p, a) && stands_for(q, b)
        };
        let input = large.roles.input;
        let driven = if input.iter().any(|l| out.contains(l)) {
            [x, y]
        } else {
            input
        };
        x != y
            && pairs.into_iter().all(same)
            && at[roles.frame] == large.roles.frame
            && roles
                .input
                .map(|l| at[l])
                .iter()
                .sorted()
                .eq(driven.iter().sorted())
            && (gripping(jaws) || gripping([jaws[1], jaws[0]]))
    })
}

/// All of four and six links, each with each.
#[test]
fn two_links_less_are_those_that_taking_two_out_leaves() {
    let db = all_of_six();
    let store = Store::open_readonly(Path::new(db)).unwrap();
    let reached = "SELECT id FROM grippers WHERE reached = 1 ORDER BY links";
    let rows = store.query_rows(reached, None).unwrap().1;
    let all: BTreeMap<String, PairStructure> = rows
        .iter()
        .map(|r| {
            let id = r[0].as_str().unwrap().to_owned();
            let file = store.mechanism_text(&id).unwrap().unwrap();
            let m = read(&file);
            (id, recognize_structure(&m).unwrap().structure)
        })
        .collect();
    let mut related = 0;
    for structure in all.values() {
        let found = find_neighbours(&store, structure).unwrap();
        for (id, other) in &all {
            let [less, more] = [other, structure].map(|s| s.chain.links());
            let expected = match less.abs_diff(more) {
                2 if less < more => is_left(other, structure).then_some(("fewer-links", 2)),
                2 => is_left(structure, other).then_some(("more-links", 2)),
                _ => continue,
            };
            let told = found.iter().find(|n| n.id == *id);
            assert_eq!(
                told.map(|n| (n.relation, n.links)),
                expected,
                "{} beside {id}",
                structure.name()
            );
            related += usize::from(expected.is_some());
        }
    }
    assert!(related > 20, "{related}");
}

/// A piston that drives two jaws by rods is a slider-crank whose piston and crank grip, once a rod and its jaw are out.
#[test]
fn half_of_a_two_jaw_gripper_is_a_slider_crank() {
    let whole = recognize_structure(&built_in("gripper-slider-two-fingers")).unwrap();
    let left = whole.structure.without_two_links();
    assert_eq!(left.len(), 2);
    assert_eq!(
        left.iter()
            .map(PairStructure::canonical_key)
            .dedup()
            .count(),
        1
    );
    let half = &left[0];
    assert_eq!(half.chain.links(), 4);
    assert!(half.roles.has_driven_jaw() && half.roles.is_driven_from_frame());
}

/// What is said to be better is better, by what the catalogue says of both.
#[test]
fn what_a_neighbour_does_better_stands_in_the_catalogue() {
    let db = all_of_six();
    let asked = ["catalog", "find", "gripper-slider-two-fingers", "--in", db];
    let data = run_json(&[&asked[..], &["--json"]].concat());
    let figures = |id: &str, column: &str| {
        let sql = format!(
            "SELECT least_force, force_ratio, turn, pin_force, width * height AS area, price FROM grippers WHERE id = '{id}' AND reached = 1"
        );
        run_json(&["catalog", "query", db, &sql, "--format", "json"])[0][column].as_f64()
    };
    let own = data["catalogue"].as_array().unwrap();
    let own = own.iter().map(|e| e["id"].as_str().unwrap()).collect_vec();
    let near = data["neighbours"].as_array().unwrap();
    let mut better = 0;
    for n in near {
        let id = n["id"].as_str().unwrap();
        assert!(!own.contains(&id));
        for figure in FIGURES.map(|f| f.column) {
            let is_more = figure == "least_force";
            // A force for a force says nothing beside one for a moment.
            let is_alike = !is_more || n["form"].as_str().unwrap().starts_with("slide");
            let here = figures(id, figure).filter(|_| is_alike);
            let mine = own.iter().filter_map(|o| figures(o, figure));
            let gains = |mine: f64| {
                here.is_some_and(|h| {
                    if is_more {
                        h > 1.01 * mine
                    } else {
                        h < 0.99 * mine
                    }
                })
            };
            let told = n["better"].as_array().unwrap();
            let told = told.iter().any(|b| b["figure"] == figure);
            let gains = mine.map(gains).collect_vec();
            assert_eq!(
                told,
                !gains.is_empty() && gains.iter().all(|g| *g),
                "{id} {figure}"
            );
            better += usize::from(told);
        }
    }
    assert!(better > 0, "{near:?}");
    let said = stdout_of(&asked);
    has(&said, "Similar structures in the catalogue");
}
