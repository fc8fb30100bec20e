//! Diagrams built from both ends, where one end does not fit the budget: the same counts and the same best as from one end.

use crate::common::*;
use crate::search::beyond_budget::{ladder, search};
use crate::search::families::scissor_lift;
use ozols::search::diagram::Diagram;
use ozols::search::testing::from_both_ends;
use std::fmt::Write;

/// Conditions within so many nodes.
fn within(nodes: usize, keep_output: bool) -> Conditions {
    default_with(|c: &mut Conditions| {
        (c.nodes, c.keep_output, c.throughout) = (nodes, keep_output, keep_output);
    })
}

/// Whether a diagram has no two nodes that lead on alike.
fn is_minimal(d: &Diagram) -> bool {
    d.layers.iter().all(|l| {
        let mut rows: Vec<&[u32]> = l.edges.chunks(l.choices).collect();
        rows.sort_unstable();
        rows.windows(2).all(|w| w[0] != w[1])
    })
}

/// A ladder whose first joint turns as another one does, in a ratio.
fn coupled(text: &str, other: usize, ratio: i64) -> String {
    let mut out = text.to_owned();
    write!(
        out,
        "[[coupling]]\njoints = [\"j0\", \"j{other}\"]\nratio = {ratio}\n"
    )
    .unwrap();
    out
}

/// The diagrams of a mechanism without redundant constraints, as made of motions of links from one end, and from both.
fn pairs(text: &str, keep_output: bool) -> Vec<[Option<Diagram>; 2]> {
    let m = read(text);
    let exact = exact_field(&m, 0).unwrap();
    from_both_ends(&Question::new(exact, m, within(200_000, keep_output)).unwrap())
}

/// Asserts that both ways end in the same edges, how many they are.
fn assert_same(pairs: Vec<[Option<Diagram>; 2]>, text: &str) -> usize {
    let edges = |d: &Diagram| {
        let layers = d.layers.iter();
        let all = layers.map(|l| (l.variable, l.edges.clone()));
        all.collect_vec()
    };
    let mut count = 0;
    for pair in pairs {
        let [one, both] = pair.map(|d| d.expect("it fits"));
        assert_eq!(edges(&one), edges(&both), "{text}");
        assert_eq!(one.terminals, both.terminals, "{text}");
        count += both.layers.iter().map(|l| l.edges.len()).sum::<usize>();
    }
    count
}

proptest! {
    #![proptest_config(crate::fuzz::runs(12))]
    #[test]
    fn both_ends_meet_in_the_diagram_of_one(
        spatial in any::<bool>(),
        contours in 1usize..4,
        seed in any::<u64>(),
        keep_output in any::<bool>(),
        twice in any::<bool>(),
        gears in prop::option::of((1usize..4, 1i64..20)),
    ) {
        let mut text = ladder(contours, seed, spatial);
        if twice && contours < 3 {
            text = doubled(&text);
        }
        if let Some((other, ratio)) = gears {
            text = coupled(&text, other, ratio);
        }
        let pairs = pairs(&text, keep_output);
        prop_assert!(!pairs.is_empty());
        assert_same(pairs, &text);
    }
}

/// Whatever is built in, where no state is searched: those whose choices all leave some redundant constraints may have these.
#[test]
fn both_ends_of_what_is_built_in_meet() {
    let mut edges = 0;
    for name in ozols::builtin::names() {
        let m = built_in(name);
        let exact = exact_field(&m, 0).unwrap();
        for (keep_output, max_redundant) in [(false, 0), (true, 0), (true, 1), (false, 3)] {
            let conditions = Conditions {
                max_redundant,
                ..within(2_000, keep_output)
            };
            if let Ok(question) = Question::new(exact.clone(), m.clone(), conditions) {
                let mut pairs = from_both_ends(&question);
                pairs.retain(|[_, both]| both.is_some());
                edges += assert_same(pairs, name);
            }
        }
    }
    assert!(edges > 1000, "{edges}");
}

/// Many nodes of a lift span the same and differ in how its platform moves: they are looked up, not tried in pairs.
#[test]
fn nodes_that_are_looked_up_meet_in_the_diagram_of_one_end() {
    for stages in 3..6 {
        let text = scissor_lift(stages);
        let edges = assert_same(pairs(&text, true), &text);
        assert!(edges > 100 << stages, "{edges}");
    }
}

/// From one end it takes more than 20,000 nodes.
#[test]
fn coupled_contours_in_space_are_few_nodes() {
    let text = ladder(3, 1, true);
    let both = search(&text, within(20_000, true));
    assert_eq!(both.1.stop_reason(), Stop::Exhausted);
    let nodes = [&both.1.determinate, &both.1.admissible].map(|d| d.nodes);
    assert_eq!(nodes, [51, 67]);
    assert!(is_minimal(&both.1.determinate) && is_minimal(&both.1.admissible));
    assert!(assert_same(pairs(&text, true), &text) > 400);
}

/// Counts that were only estimated: from one end four contours take more than two million nodes, five more than five million.
#[test]
fn four_and_five_coupled_contours_in_space_are_counted() {
    for (contours, within_nodes, nodes, count) in [
        (4, 100_000, 72, 49_513_456u64),
        (5, 1_000_000, 93, 2_831_284_426),
    ] {
        let (s, d) = search(&ladder(contours, 1, true), within(within_nodes, false));
        assert_eq!(
            (d.stop_reason(), d.determinate.nodes),
            (Stop::Exhausted, nodes)
        );
        assert_eq!(s.count_variants(&d.determinate, false).total, count.into());
    }
}

/// The joints of a ladder once more, between links of their own and the same frame.
fn doubled(text: &str) -> String {
    let mut out = text.to_owned();
    for table in text.split("[[").skip(1) {
        if !table.contains("role = \"frame\"") {
            let mut table = table
                .replace("id = \"", "id = \"k")
                .replace("role = \"output\"\n", "");
            for i in 1..10 {
                table = table.replace(&format!("\"{i}\""), &format!("\"k{i}\""));
            }
            out += "[[";
            out += &table;
        }
    }
    out
}

#[test]
fn blocks_are_built_from_both_ends_one_after_another() {
    let text = ladder(3, 1, true);
    for keep_output in [false, true] {
        let [one, two] = [&text, &doubled(&text)].map(|t| search(t, within(20_000, keep_output)));
        assert_eq!(
            (one.1.stop_reason(), two.1.stop_reason()),
            (Stop::Exhausted, Stop::Exhausted)
        );
        let total = |(s, d): &(Search, Diagrams), d_of: fn(&Diagrams) -> &Diagram| {
            s.count_variants(d_of(d), false).total
        };
        let free = total(&one, |d| &d.determinate);
        assert_eq!(total(&two, |d| &d.determinate), &free * &free);
        assert_eq!(
            total(&two, |d| &d.admissible),
            total(&one, |d| &d.admissible) * free
        );
        assert!(two.1.admissible.nodes < 120, "{}", two.1.admissible.nodes);
    }
}

#[test]
fn a_search_of_halves_stops_when_it_is_told_to() {
    let m = read(&ladder(4, 1, true));
    let exact = exact_field(&m, 0).unwrap();
    let search = Search::new(exact, m, within(20_000, true)).unwrap();
    let within = |most: usize| {
        let asked = std::sync::atomic::AtomicUsize::new(0);
        let cancelled = || asked.fetch_add(1, std::sync::atomic::Ordering::Relaxed) >= most;
        let d = search.build_diagrams(Control::cancelled_by(&cancelled));
        (d.stop_reason(), asked.into_inner())
    };
    let (whole, all) = within(usize::MAX);
    assert!(whole == Stop::Exhausted && all > 50, "{all}");
    for part in 1..8 {
        assert_eq!(within(all * part / 8).0, Stop::Interrupted, "{part} of 8");
    }
}
