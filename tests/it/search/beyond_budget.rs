//! What is known where the diagram of all variants does not fit the budget: the cheapest, proven, and about how many there
//! are.

use crate::common::*;

/// A ladder of contours: a four-bar, and three joints more for each further one, hinges along z in a plane at places drawn
/// from a seed; along any direction where it is `spatial`.
pub(crate) fn ladder(contours: usize, seed: u64, spatial: bool) -> String {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut number = |below: u64| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 33) % below
    };
    let mut joints = vec![(0, 1), (1, 3), (3, 2), (2, 0)];
    let (mut left, mut right, mut next) = (1, 2, 4);
    for _ in 1..contours {
        joints.extend([(left, next), (next, next + 1), (next + 1, right)]);
        (left, right, next) = (next, next + 1, next + 2);
    }
    let options = "[\"revolute\", \"cylindrical\", \"universal\", \"spherical\"]";
    let head = format!("name = \"ladder\"\n[search]\noptions = {options}");
    let links = (0..next).map(|i| format!("{i}{}", if i == 1 { "*" } else { "" }));
    let line = |(i, (a, b)): (usize, (usize, usize))| {
        let (x, y, z) = (
            number(997),
            number(997),
            if spatial { number(997) } else { 0 },
        );
        let [u, v, w] = if spatial {
            [number(19) + 1, number(19), number(19)]
        } else {
            [0, 0, 1]
        };
        format!("j{i} | {a} {b} | revolute | {x}, {y}, {z} | {u}, {v}, {w}")
    };
    let joints = joints.into_iter().enumerate().map(line).join("\n");
    write_mechanism(&head, &links.collect_vec().join(" "), &joints)
}

pub(crate) fn search(text: &str, conditions: Conditions) -> (Search, Diagrams) {
    searched(&read(text), conditions)
}

fn best(search: &Search, diagrams: &Diagrams, top: usize) -> Vec<Assignment> {
    search.cheapest_variants(diagrams, top).collect()
}

proptest! {
    #![proptest_config(crate::fuzz::runs(12))]
    #[test]
    fn the_proven_best_are_those_of_the_whole_diagram(
        contours in 2usize..4,
        seed in any::<u64>(),
        spatial in any::<bool>(),
        keep_output in any::<bool>(),
        max_redundant in 0u32..3,
        max_mobility in prop::option::of(1i64..4),
        max_changes in prop::option::of(4u32..9),
    ) {
        let conditions = Conditions { max_redundant, max_mobility, max_changes, keep_output, ..Conditions::default() };
        let text = ladder(contours, seed, spatial);
        let (whole, all) = search(&text, conditions.clone());
        for (top, counted) in [(1, true), (12, true), (40, true), (12, false)] {
            let few = Conditions { nodes: 700, cheapest: top, counted, ..conditions.clone() };
            let (s, d) = search(&text, few);
            let (expected, found) = (best(&whole, &all, top), best(&s, &d, top));
            let Some(known) = d.known_up_to() else { continue };
            let dearest = expected.last().map_or(i64::MAX, |v| s.steps.cost_in_milli(v.key.cost()));
            let proven = |list: &[Assignment]| -> Vec<Assignment> {
                list.iter().filter(|v| s.steps.cost_in_milli(v.key.cost()) <= known).cloned().collect()
            };
            prop_assert_eq!(proven(&found), proven(&expected));
            // A ladder of two contours is small: all that is asked for can be proven.
            prop_assert!(contours > 2 || known >= dearest, "{known} of {dearest}");
        }
    }
}

/// Once 5.8 s, 507 MB and unproven.
#[test]
fn the_best_of_a_long_ladder_are_proven_in_few_nodes() {
    let conditions = Conditions {
        cheapest: 10,
        counted: false,
        nodes: 100_000,
        ..Conditions::default()
    };
    let (s, d) = search(&ladder(8, 1, false), conditions);
    let list = best(&s, &d, 10);
    assert_eq!(list.len(), 10);
    let dearest = s.steps.cost_in_milli(list[9].key.cost());
    assert!(d.known_up_to().unwrap() >= dearest);
    let nodes = d.cheapest.as_ref().unwrap().diagram.nodes;
    assert!(nodes < 50_000, "{nodes} nodes");
}

#[test]
fn estimates_are_near_the_count_and_right_on_average() {
    let text = ladder(3, 1, true);
    for (max_mobility, keep_output) in [(None, true), (Some(2), false)] {
        let base = default_with(|c: &mut Conditions| {
            (c.max_mobility, c.keep_output) = (max_mobility, keep_output)
        });
        let (whole, all) = search(&text, base.clone());
        let counts = [
            whole.count_variants(&all.determinate, false),
            whole.count_variants(&all.admissible, true),
        ];
        let counts = counts.map(|c| c.to_string().parse::<f64>().unwrap());
        let (mut sums, mut variances, mut n) = ([0.0; 2], [0.0; 2], 0.0);
        let mut misses = 0;
        for seed in 0..16 {
            let conditions = Conditions {
                nodes: 1000,
                estimate: Some(seed),
                ..base.clone()
            };
            let (_, d) = search(&text, conditions.clone());
            if seed == 0 {
                assert_eq!(d.estimates, search(&text, conditions).1.estimates);
            }
            n += 1.0;
            for (i, e) in d.estimates.into_iter().enumerate() {
                let e = e.unwrap();
                misses += usize::from(!(e.between[0]..=e.between[1]).contains(&counts[i]));
                let off = (e.mean - counts[i]) / e.standard_error;
                assert!(off.abs() < 5.0, "{e:?} for {}", counts[i]);
                assert!(
                    e.standard_error > 0.0 && e.standard_error < 0.2 * e.mean,
                    "{e:?}"
                );
                // As many are drawn as tell one percent.
                let reach = (e.between[1] - e.between[0]) / 2.0 / e.mean;
                assert!(reach < 0.0102 || e.drawn.of == 200_000, "{e:?}");
                sums[i] += e.mean;
                variances[i] += e.standard_error.powi(2);
            }
        }
        // Of 32 intervals with a confidence of 95 % more than 6 miss once in a thousand times.
        assert!(misses <= 6, "{misses} of 32");
        for i in 0..2 {
            let off = (sums[i] / n - counts[i]) / (variances[i].sqrt() / n);
            assert!(off.abs() < 4.0, "{i}: {} for {}", sums[i] / n, counts[i]);
        }
    }
}

#[test]
fn data_say_what_is_proven_and_what_is_estimated() {
    let file = ladder(6, 1, false);
    let line = "search - --nodes 500 --top 3 --format json";
    let v: Value = serde_json::from_str(&run_with_input(line, &file).1).unwrap();
    assert_eq!(
        (&v["exact"], &v["variants_proven"]),
        (&json!(false), &json!(3))
    );
    let estimate = &v["admissible_estimate"];
    let mean = estimate["mean"].real();
    let least: f64 = v["admissible"].word().parse().unwrap();
    let most: f64 = estimate["at_most"].word().parse().unwrap();
    assert!(least < mean && mean < most, "{least} {mean} {most}");
    assert!(
        mean / least < 1.2 && most / mean < 4.0,
        "{least} {mean} {most}"
    );
    assert!(estimate["samples"]["of"].whole() >= 10_000);
}

proptest! {
    #![proptest_config(crate::fuzz::runs(16))]
    #[test]
    fn what_is_counted_and_what_is_possible_hold_the_count_between_them(
        contours in 2usize..4,
        seed in any::<u64>(),
        spatial in any::<bool>(),
        keep_output in any::<bool>(),
        nodes in 1usize..2000,
        max_mobility in prop::option::of(0i64..3),
        max_changes in prop::option::of(3u32..9),
    ) {
        let conditions = Conditions { max_mobility, max_changes, keep_output, ..Conditions::default() };
        let text = ladder(contours, seed, spatial);
        let (whole, all) = search(&text, conditions.clone());
        let (s, d) = search(&text, Conditions { nodes, estimate: Some(seed), ..conditions });
        let counts = |s: &Search, d: &Diagrams| [s.count_variants(&d.determinate, false), s.count_variants(&d.admissible, true)];
        let (truth, least) = (counts(&whole, &all), counts(&s, &d));
        for (i, e) in d.estimates.iter().enumerate() {
            prop_assert!(least[i].total <= truth[i].total);
            let Some(e) = e else { continue };
            let most = e.at_most.as_ref().expect("no state is searched");
            prop_assert!(*most >= truth[i].total, "{most} {}", truth[i].total);
            let value = |c: &ozols::search::answer::counts::Counts| c.to_string().parse::<f64>().unwrap();
            prop_assert!(e.mean >= value(&least[i]) && e.mean <= most.to_string().parse::<f64>().unwrap());
        }
    }
}

/// Once the cheapest nodes alone were kept, and most variants were lost with the others.
#[test]
fn most_variants_of_six_contours_in_space_are_counted_or_bounded() {
    let conditions = Conditions {
        nodes: 100_000,
        estimate: Some(1),
        keep_output: false,
        ..Conditions::default()
    };
    let (s, d) = search(&ladder(6, 1, true), conditions);
    let counted = s.count_variants(&d.determinate, false).total.to_string();
    let estimate = d.estimates[0].as_ref().unwrap();
    let share = counted.parse::<f64>().unwrap() / estimate.mean;
    let most = estimate.at_most.as_ref().unwrap().to_string();
    let excess = most.parse::<f64>().unwrap() / estimate.mean;
    assert!(share > 0.5 && excess < 1.02, "{share} {excess}");
    let [low, high] = estimate.between;
    assert!((high - low) / estimate.mean < 0.01, "{estimate:?}");
}

/// Whatever the budget, no row says that more variants are admissible than have no redundant constraints.
#[test]
fn bounds_do_not_contradict_each_other() {
    let mut cut = 0;
    for (seed, spatial) in [(1, false), (2, false), (3, true), (4, true)] {
        let ladder = ladder(3, seed, spatial);
        for nodes in [1, 3, 10, 30, 60, 100, 200, 400, 800, 1600, 3200] {
            let line = format!("search - --count --check none --format json --nodes {nodes}");
            let found: Value = serde_json::from_str(&run_with_input(&line, &ladder).1).unwrap();
            let number = |v: &Value| v.word().parse::<u64>().unwrap();
            cut += usize::from(found["determinate_exact"] == false);
            let [all, some] = ["determinate", "admissible"].map(|k| number(&found[k]));
            assert!(some <= all, "{seed} {nodes}: {some} of {all}");
            for by in ["mobility", "changes", "redundant", "freedoms"] {
                let all = found[format!("by_{by}")].as_object().unwrap();
                for (row, n) in found[format!("admissible_by_{by}")].as_object().unwrap() {
                    let within = all.get(row).map_or(0, number);
                    assert!(
                        number(n) <= within,
                        "{seed} {nodes} {by} {row}: {n} of {within}"
                    );
                }
            }
        }
    }
    assert!(cut > 5, "{cut}");
}
