//! Mechanisms of blocks that meet in a link at most: what is said of them is what brute force says, counts multiply, and
//! nodes add up.

use super::beyond_budget::search;
use crate::common::*;

/// A mechanism under construction.
struct Written {
    links: usize,
    outputs: Vec<usize>,
    joints: String,
    options: &'static str,
}

impl Written {
    fn new(options: &'static str) -> Written {
        Written {
            links: 1,
            outputs: Vec::new(),
            joints: String::new(),
            options,
        }
    }

    fn link(&mut self) -> usize {
        self.links += 1;
        self.links - 1
    }

    fn hinge(&mut self, [a, b]: [usize; 2], point: [i64; 3], axis: [i64; 3]) {
        let number = self.joints.matches("revolute").count();
        let [point, axis] = [point, axis].map(commas);
        self.joints += &format!("j{number} | {a} {b} | revolute | {point} | {axis}\n");
    }

    /// A four-bar on a link, its hinges along one direction; returns its other links.
    fn four_bar(&mut self, on: usize, at: i64, axis: [i64; 3]) -> [usize; 3] {
        let [a, b, c] = [self.link(), self.link(), self.link()];
        let places = [[0, 0, 0], [1, 5, 2], [7, 6, 3], [8, 1, 1]];
        for (links, place) in [[on, a], [a, b], [b, c], [c, on]].into_iter().zip(places) {
            self.hinge(links, place.map(|x| x + at), axis);
        }
        [a, b, c]
    }

    fn text(&self) -> String {
        let head = format!("name = \"blocks\"\n[search]\noptions = {}", self.options);
        let star = |i| if self.outputs.contains(&i) { "*" } else { "" };
        let links = (0..self.links).map(|i| format!("{i}{}", star(i))).join(" ");
        write_mechanism(&head, &links, &self.joints)
    }
}

const TWO: &str = "[\"revolute\", \"cylindrical\"]";
const FOUR: &str = "[\"revolute\", \"cylindrical\", \"universal\", \"spherical\"]";
const AXES: [[i64; 3]; 4] = [[0, 0, 1], [1, 0, 0], [1, 2, 2], [0, 1, 0]];

proptest! {
    #![proptest_config(crate::fuzz::runs(16))]
    #[test]
    fn trees_of_blocks_are_what_brute_force_finds(
        parts in prop::collection::vec((0usize..16, 0usize..4, any::<bool>(), any::<bool>()), 1..3),
        outputs in prop::collection::vec(0usize..16, 1..3),
        max_redundant in 0u32..3,
        keep_output in any::<bool>(),
    ) {
        let mut m = Written::new(TWO);
        for (i, &(on, axis, open, moved)) in parts.iter().enumerate() {
            let on = on % m.links;
            let place = if moved { 40 * i64::try_from(i).unwrap() + 3 } else { 0 };
            if open {
                let next = m.link();
                m.hinge([on, next], [place, 1, 0], AXES[(axis + i) % 4]);
                m.four_bar(next, place, AXES[axis]);
            } else {
                m.four_bar(on, place, AXES[axis]);
            }
        }
        m.outputs = outputs.iter().map(|o| 1 + o % (m.links - 1)).collect();
        let conditions = Conditions { max_redundant, keep_output, ..Conditions::default() };
        let (s, d) = search(&m.text(), conditions.clone());
        // The cheapest alone, under a ceiling that is raised.
        let few = Conditions { nodes: 300, cheapest: 6, counted: false, ..conditions };
        let (bounded, proven) = search(&m.text(), few);
        if let Some(known) = proven.known_up_to() {
            let up_to = |s: &Search, d: &Diagrams| -> Vec<_> {
                let milli = |key| s.steps.cost_in_milli(key);
                let all = s.cheapest_variants(d, 6).map(|v| (milli(v.key.cost()), v.choices));
                all.filter(|(cost, _)| *cost <= known).collect()
            };
            prop_assert_eq!(up_to(&bounded, &proven), up_to(&s, &d));
        }
        let every = every_variant(&s).unwrap();
        for (found, expected) in [
            (s.count_variants(&d.determinate, false), every.determinate),
            (s.count_variants(&d.admissible, true), every.admissible),
        ] {
            prop_assert_eq!(found.total, expected.total);
            prop_assert_eq!(found.by_mobility, expected.by_mobility);
        }
    }
}

/// Nodes of both diagrams, and what they count.
fn figures((s, d): &(Search, Diagrams)) -> ([usize; 2], [BigUint; 2]) {
    (
        [d.determinate.nodes, d.admissible.nodes],
        [
            s.count_variants(&d.determinate, false).total,
            s.count_variants(&d.admissible, true).total,
        ],
    )
}

#[test]
fn counts_of_legs_multiply_and_their_nodes_add_up() {
    let legs = |n: usize| {
        let mut m = Written::new(FOUR);
        for i in 0..n {
            // Hinges in a plane, on the frame; a shin on the coupler, and a foot on a four-bar of its own.
            let [_, coupler, _] = m.four_bar(0, 0, AXES[i % 4]);
            let shin = m.link();
            m.hinge([coupler, shin], [3, 3, 9], [0, 1, 0]);
            let [_, foot, _] = m.four_bar(shin, 11, AXES[(i + 1) % 4]);
            m.outputs.push(foot);
        }
        figures(&search(&m.text(), Conditions::default()))
    };
    let (one, several) = (legs(1), legs(6));
    for i in 0..2 {
        assert!(one.1[i] > BigUint::from(1u32));
        assert!(several.0[i] <= 8 * one.0[i], "{one:?} {several:?}");
    }
    // The first and the fifth leg are alike, and so on; only counts of legs in the same directions are powers.
    let same = |n: usize| {
        let mut m = Written::new(FOUR);
        for _ in 0..n {
            let [_, coupler, _] = m.four_bar(0, 0, [0, 0, 1]);
            m.outputs.push(coupler);
        }
        figures(&search(&m.text(), Conditions::default()))
    };
    let (one, four) = (same(1), same(4));
    for i in 0..2 {
        assert_eq!(four.1[i], one.1[i].pow(4));
        assert!(four.0[i] <= 4 * one.0[i], "{one:?} {four:?}");
    }
}

#[test]
fn a_long_open_chain_aside_is_no_burden() {
    let with_tail = |n: u32| {
        let mut m = Written::new(FOUR);
        let [rocker, coupler, _] = m.four_bar(0, 0, [0, 0, 1]);
        m.outputs.push(rocker);
        let mut at = coupler;
        for i in 0..n {
            let next = m.link();
            m.hinge([at, next], [i64::from(i), 3, 1], AXES[i as usize % 4]);
            at = next;
        }
        figures(&search(&m.text(), Conditions::default()))
    };
    let (none, long) = (with_tail(0), with_tail(60));
    for i in 0..2 {
        assert_eq!(long.1[i], &none.1[i] * BigUint::from(4u32).pow(60));
        assert_eq!(long.0[i], none.0[i] + 60);
    }
}
