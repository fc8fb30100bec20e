//! The rows that are enough for the rank of J: against all rows written out, by other primes, and by what is known of mechanisms.

use crate::common::*;
use crate::search::twin;
use ozols::rank::reduce::sufficient_rows::{LeastRows, Motions};

/// The least rows, by the first prime, have the rank of all rows by the second, and no part has more rank than rows.
fn check(m: &Mechanism, state: StateId) -> LeastRows {
    let [one, other] = [0, 1].map(|i| exact_field(m, i).unwrap());
    let closure = Closure::new(&one, m, state).unwrap();
    let found = LeastRows::new(&one, m, &closure).unwrap();
    let whole = Closure::new(&other, m, state).unwrap();
    let what = format!("{} {}: {found:?}", m.name, m.states[state]);
    assert_eq!(found.rank(), modular::rank_modulo(&other, &whole), "{what}");
    assert!(
        found.rows() <= found.of && found.of == whole.rows(),
        "{what}"
    );
    let mut contours: Vec<usize> = found
        .blocks
        .iter()
        .flat_map(|b| b.contours.clone())
        .collect();
    contours.sort_unstable();
    assert!(contours.into_iter().eq(0..whole.contours.len()), "{what}");
    for part in found.blocks.iter().flat_map(|b| &b.parts) {
        assert!(part.rank <= part.rows && part.rows <= part.of, "{what}");
    }
    found
}

#[test]
fn built_in_mechanisms_need_no_more() {
    let (mut fewer, mut apart, mut grouped) = (0, 0, 0);
    for name in builtin::names() {
        let m = built_in(name);
        for state in m.state_ids() {
            let found = check(&m, state);
            fewer += usize::from(found.rows() < found.of);
            let mut all = found.blocks.iter().flat_map(|b| &b.parts);
            apart += usize::from(
                all.clone()
                    .any(|p| matches!(p.motions, Motions::InPlane(_))),
            );
            grouped += usize::from(all.any(|p| matches!(p.motions, Motions::Group(_))));
        }
    }
    assert!(
        fewer > 50 && apart > 15 && grouped > 40,
        "{fewer} {apart} {grouped}"
    );
}

/// The gripper's drive turns in its guide: its parallelograms need three rows each in their plane, where nothing is redundant,
/// and out of it one, for that turn; every redundant constraint is out of the plane.
#[test]
fn a_cylindrical_drive_costs_one_row_out_of_the_plane() {
    let found = run_json("analyze gripper-10 --state free --format json");
    let parts = found["states"][0]["least_rows"].list();
    let figures = |i: usize| {
        let p = &parts[i];
        let of = ["rows", "rows_in_all", "rank", "redundant"].map(|k| p[k].whole());
        (p["motions"].word(), p["of"].word(), of)
    };
    assert_eq!(figures(0), ("in plane", "z", [12, 12, 12, 0]));
    assert_eq!(figures(1), ("out of plane", "z", [4, 12, 1, 11]));
}

#[test]
fn blocks_are_judged_one_by_one() {
    let loops = [
        "0, 0, 0 | 0, 0, 1 / 1, 5, 0 | 0, 0, 1 / 7, 6, 0 | 0, 0, 1 / 8, 1, 0 | 0, 0, 1",
        "0, 0, 0 | 1, 0, 0 / 0, 0, 0 | 1, 2, 0 / 0, 0, 0 | 1, 3, 4 / 0, 0, 0 | 0, 1, 5",
        "0, 0, 0 | 1, 0, 0 / 1, 3, 2 | 1, 2, 0 / 5, 1, 1 | 1, 3, 4 / 2, 2, 7 | 0, 1, 5 / 1, 8, 3 | 2, 1, 1 \
         / 4, 4, 9 | 3, 1, 2 / 3, 4, 8 | 3, 1, 7",
    ];
    let (mut links, mut joints) = ("f".to_owned(), String::new());
    for (l, hinges) in loops.iter().enumerate() {
        let hinges = hinges.split(" / ").collect_vec();
        let link = |i: usize| match i % hinges.len() {
            0 => "f".to_owned(),
            i => format!("{l}-{i}"),
        };
        for (i, hinge) in hinges.iter().enumerate() {
            let (a, b) = (link(i), link(i + 1));
            links += &if i == 0 {
                String::new()
            } else {
                format!(" {a}*")
            };
            joints += &format!("{l}{i} | {a} {b} | revolute | {hinge}\n");
        }
    }
    let m = read(&write_mechanism("name = \"three\"", &links, &joints));
    let found = check(&m, StateId::FREE);
    let rows: Vec<usize> = found.blocks.iter().map(|b| b.parts[0].rows).collect();
    assert_eq!(rows, [3, 3, 6]);
}

#[test]
fn hinges_on_a_flat_sheet_move_out_of_it_alone() {
    let creases = [
        "0, 0, 0 | 1, 0",
        "3, 1, 0 | 1, 2",
        "1, 4, 0 | 3, -1",
        "2, 7, 0 | 1, 5",
    ];
    let creases = creases.map(|c| format!("revolute | {c}, 0"));
    let m = read(&write_ring("name = \"sheet\"", &creases));
    let found = check(&m, StateId::FREE);
    assert_eq!(found.rows(), 3);
    let words = found.describe_rows(&m, |c| c.to_string());
    has(&words, "all joints move only out of a plane with normal z");
}

/// What self-stresses leave open in the reactions is what rows say: where nothing is redundant in the plane, the forces across
/// its hinges are those of every reaction of the family.
#[test]
fn reactions_in_a_plane_without_redundant_constraints_are_determined() {
    let mut seen = 0;
    for name in split_words(
        "gripper-10-loaded four-bar jansen-leg watt-six-bar slider-crank-spatial scissor-lift-3",
    ) {
        let analysis = run_json(&["analyze", name, "--state", "free", "--format", "json"]);
        let parts = analysis["states"][0]["least_rows"].list();
        let line = format!("statics {name} --state free --spatial --format json");
        let reactions = run_json(&line);
        assert_eq!(reactions["unique"], false, "{name}");
        assert_eq!(
            parts.len() % 2,
            parts.iter().filter(|p| p["motions"] == "group").count(),
            "{name}"
        );
        for r in reactions["reactions"].list() {
            let open: Vec<&str> = r["open"]
                .as_array()
                .into_iter()
                .flatten()
                .map(|o| o.word())
                .collect();
            if r["type"] == "revolute" {
                seen += 1;
                assert_eq!(open, ["Fz", "Mx", "My"], "{name} {r}");
            }
        }
    }
    assert!(seen > 40, "{seen}");
    // A third rod is redundant in the plane.
    let rods = run_json("statics parallelogram-3-rods --spatial --format json");
    let mut by_count: BTreeMap<usize, usize> = BTreeMap::new();
    for r in rods["reactions"].list() {
        *by_count
            .entry(r["open"].as_array().map_or(0, Vec::len))
            .or_default() += 1;
    }
    assert!(by_count.keys().all(|&n| n > 3), "{by_count:?}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]
    #[test]
    fn random_mechanisms_need_no_more(text in twin::random()) {
        let m = read(&text);
        for state in m.state_ids() {
            check(&m, state);
        }
    }
}

#[test]
fn screws_are_not_called_turns() {
    let words = |places: &[&str]| {
        let screws = places
            .iter()
            .map(|p| format!("helical | {p}, 0 | 0, 0, 1 | pitch = 1"));
        let m = read(&write_ring("name = \"screws\"", &screws.collect_vec()));
        check(&m, StateId::FREE).describe_rows(&m, |c| c.to_string())
    };
    let parallel = words(&["0, 0", "3, 0", "4, 4", "0, 5"]);
    has(&parallel, "screws of one pitch and slides across them (3)");
    let coaxial = words(&["2, 1", "2, 1"]);
    has(&coaxial, "one screw (1), so 1 row per contour is enough");
}

/// What is said of all joints is true of all: an arm on the coupler of a four-bar is in no contour, and in no plane with it.
#[test]
fn joints_outside_contours_are_not_spoken_for() {
    let four_bar = builtin::text("four-bar").unwrap();
    let arm = "[[link]]\nid = \"arm\"\n[[joint]]\nid = \"shoulder\"\nlinks = [\"2\", \"arm\"]\ntype = \"revolute\"\n\
               point = [1, 2, 3]\naxis = [1, 2, 3]\n";
    let without_figures = four_bar.split("[[expected]]").next().unwrap();
    let m = read(&format!("{without_figures}\n{arm}"));
    let words = check(&m, StateId::FREE).describe_rows(&m, |c| c.to_string());
    assert!(
        words.starts_with(
            "; all joints of contours move in one plane (3), so 3 rows per contour are enough"
        ),
        "{words}"
    );
    let whole = built_in("four-bar");
    let words = check(&whole, StateId::FREE).describe_rows(&whole, |c| c.to_string());
    assert!(
        words.starts_with("; all joints move in one plane (3)"),
        "{words}"
    );
}
