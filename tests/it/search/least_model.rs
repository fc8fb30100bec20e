//! Diagrams without the rows that no choice changes, against those with all rows, brute force and the slow twin.

use crate::common::*;
use crate::search::twin::{look, variants};
use crate::search::varied::links_of;
use ozols::search::answer::counts::Counts;
use ozols::search::build::Diagrams;
use ozols::search::check::brute::every_variant;
use ozols::search::diagram::Stop;
use proptest::prelude::*;

fn search(m: &Mechanism, conditions: Conditions) -> Option<(Search, Diagrams)> {
    let search = Search::new(exact_field(m, 0).ok()?, m, conditions).ok()?;
    let diagrams = search.build(&|| false, &mut |_| {});
    Some((search, diagrams))
}

fn counts((search, diagrams): &(Search, Diagrams)) -> [Counts; 2] {
    let Diagrams {
        determinate,
        admissible,
        ..
    } = diagrams;
    [
        search.counts(determinate, false),
        search.counts(admissible, true),
    ]
}

/// The built-in mechanisms with all rows and with the least: the same diagrams, counts and lists.
#[test]
fn built_in_mechanisms_are_counted_and_listed_alike() {
    let mut three = Vec::new();
    for name in builtin::names() {
        let m = built_in(name);
        let with = |whole_twists| {
            let conditions = Conditions {
                whole_twists,
                nodes: 20_000,
                ..Conditions::default()
            };
            Search::new(exact_field(&m, 0).ok()?, &m, conditions).ok()
        };
        let (Some(whole), Some(least)) = (with(true), with(false)) else {
            continue;
        };
        let orders = least.orders();
        let [whole, least] = [whole, least].map(|s| {
            let diagrams = s.build_in(&orders, &|| false, &mut |_| {});
            (s, diagrams)
        });
        if whole.1.stop() != Stop::Exhausted {
            continue;
        }
        assert_eq!(whole.1.rows_per_contour, whole.0.space.dim, "{name}");
        assert_eq!(counts(&whole), counts(&least), "{name}");
        // Fewer where what is redundant in any case is known from the start.
        assert!(
            whole.1.determinate.nodes >= least.1.determinate.nodes,
            "{name}"
        );
        assert!(
            whole.1.admissible.nodes >= least.1.admissible.nodes,
            "{name}"
        );
        let cheapest = |(s, d): &(Search, Diagrams)| -> Vec<_> {
            s.cheapest(d, 50).take(50).map(|v| v.choices).collect()
        };
        assert_eq!(cheapest(&whole), cheapest(&least), "{name}");
        if least.1.rows_per_contour == 3 && least.0.space.dim == 6 {
            three.push(name);
        }
    }
    // One joint of the ten-link gripper is cylindrical and slides in the plane.
    for name in ["gripper-10", "four-bar", "lever-gripper"] {
        assert!(three.contains(&name), "{name} among {three:?}");
    }
}

/// Normals of planes, each with a direction in the plane.
const PLANES: [([i32; 3], [i32; 3]); 3] = [
    ([0, 0, 1], [1, 0, 0]),
    ([1, 2, -1], [1, 0, 1]),
    ([0, 3, 4], [1, 4, -3]),
];
/// Joint types and options; N is the normal, E a direction in the plane, and the last but two leave the plane's rows unsettled.
const KINDS: [&str; 8] = [
    "type = \"revolute\"\naxis = N\noptions = [\"cylindrical\", { type = \"universal\", reference = E }]",
    "type = \"revolute\"\naxis = N\noptions = [\"spherical\", \"sphere-in-cylinder\"]",
    "type = \"revolute\"\naxis = N\nunloading = [{ type = \"revolute\", axis = E }]",
    "type = \"revolute\"\naxis = N",
    "type = \"prismatic\"\naxis = E\noptions = [\"cylindrical\"]",
    "type = \"cylindrical\"\naxis = E",
    "type = \"prismatic\"\naxis = E\nreference = N\noptions = [{ freedoms = [\"tz\", \"ty\"], name = \"table\" }]",
    "type = \"revolute\"\naxis = E\noptions = [\"spherical\"]",
];

/// Mechanisms of points in one plane, at a height above the origin, with at most one joint in three that leaves it.
fn in_a_plane() -> impl Strategy<Value = String> {
    let index = any::<prop::sample::Index>;
    let joint = || {
        (
            prop::sample::select(vec![0usize, 0, 1, 1, 2, 3, 4, 5, 6, 7]),
            -3i32..4,
            -3i32..4,
        )
    };
    (
        0..PLANES.len(),
        -2i32..3,
        3usize..6,
        prop::collection::vec((index(), joint()), 5),
        prop::collection::vec((index(), index(), joint()), 1..4),
        any::<bool>(),
    )
        .prop_map(|(plane, height, links, tree, more, lifted)| {
            let (n, e) = PLANES[plane];
            let across = [
                n[1] * e[2] - n[2] * e[1],
                n[2] * e[0] - n[0] * e[2],
                n[0] * e[1] - n[1] * e[0],
            ];
            let mut out = String::from("name = \"in a plane\"\n");
            out += &links_of(links);
            let tree = (1..links).map(|l| (tree[l - 1].0.index(l), l, tree[l - 1].1));
            let more = more.iter().map(|(a, b, j)| (a.index(links), b.index(links), *j));
            for (i, (a, b, (kind, x, y))) in tree.chain(more).filter(|(a, b, _)| a != b).enumerate() {
                // One joint may stand above the others.
                let height = height + i32::from(lifted && i == 1);
                let point = [0, 1, 2].map(|k| x * e[k] + y * across[k] + height * n[k]);
                let what = KINDS[kind].replace('N', &format!("{n:?}")).replace('E', &format!("{e:?}"));
                out += &format!(
                    "[[joint]]\nid = \"j{i}\"\nlinks = [\"{a}\", \"{b}\"]\npoint = {point:?}\n{what}\n"
                );
            }
            out
        })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, max_shrink_iters: 200, ..ProptestConfig::default() })]
    #[test]
    fn in_a_plane_as_brute_force_and_the_twin_count(text in in_a_plane(), allowed in 0u32..8, keep in any::<bool>()) {
        let m = mechanism_from_str("plane.toml", &text).unwrap();
        let all = variants(&m, false);
        prop_assume!(all.len() <= 72);
        let of = |whole_twists| {
            let conditions = Conditions { max_redundant: allowed, keep_output: keep, whole_twists, ..Conditions::default() };
            search(&m, conditions).unwrap()
        };
        let least = of(false);
        let found = counts(&least);
        prop_assert_eq!(&found, &counts(&of(true)));
        let [determinate, admissible] = found;
        let every = every_variant(&least.0).unwrap();
        prop_assert_eq!((&determinate, admissible), (&every.determinate, every.admissible));
        let mut seen: BTreeMap<(i64, u32), BigUint> = BTreeMap::new();
        for t in all.iter().map(|c| look(&m, false, c)).filter(|t| t.internal <= allowed) {
            *seen.entry((t.mobility, t.changes)).or_default() += 1u8;
        }
        prop_assert_eq!(determinate.by_mobility_and_changes, seen);
    }
}
