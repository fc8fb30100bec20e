//! Counts up to the symmetry of a layout, against a list of all variants whose images are found from the places of the joints.

use super::command::{path_in, query_lines};
use super::three_jaws::third;
use super::{each_structure_of, form_of, plain_spec, structure_row};
use crate::common::*;
use ozols::chains::Symmetry;
use ozols::search::answer::search_counts::orbit_counts;
use ozols::search::question::conditions::Symmetry as Asked;

/// For each joint the one that stands where the symmetry carries it.
fn images(m: &Mechanism, carry: impl Fn([f64; 2]) -> [f64; 2]) -> Vec<usize> {
    let place = |k: usize| {
        let [x, y, _] = to_vector(&m.joints.get(k).unwrap().frame.point);
        [x, y]
    };
    let near = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-9;
    let all = 0..m.joints.len();
    all.clone()
        .map(|k| {
            all.clone()
                .find(|&i| near(place(i), carry(place(k))))
                .unwrap()
        })
        .collect()
}

/// How many there are by a search that asks for one of each orbit of what moves in one way.
fn one_per_orbit(m: &Mechanism) -> BigUint {
    let conditions = Conditions {
        max_mobility: Some(1),
        keep_output: false,
        symmetry: Asked::OnePerOrbit,
        ..Conditions::default()
    };
    let (search, diagrams) = searched(m, conditions);
    let all = SearchCounts::of_diagrams(&search, &diagrams);
    let (counted, _) = orbit_counts(&search, all, &|| false).unwrap();
    counted.admissible.total
}

#[test]
fn orbits_are_those_of_a_list_of_all_variants() {
    let (mirror, half, third_of) = (Symmetry::Mirror, Symmetry::HalfTurn, Symmetry::Threefold);
    let mut seen = 0;
    for (links, jaws, input, symmetry, options) in [
        (6, 2, Input::Slide, mirror, Spec::default().options),
        (6, 2, Input::Turn, half, Spec::default().options),
        (
            8,
            3,
            Input::Turn,
            third_of,
            vec!["universal".to_owned(), "spherical".to_owned()],
        ),
    ] {
        let spec = Spec {
            options,
            jaws,
            ..plain_spec(0)
        };
        let form = form_of(input, symmetry, false);
        each_structure_of(links, jaws, &[form], |_, s| {
            let Ok(laid) = structure_row(&s, &spec).unwrap().laid else {
                return;
            };
            seen += 1;
            let m = ozols::from_toml(&laid.file).unwrap();
            let to = images(&m, |[x, y]| match symmetry {
                Symmetry::Mirror => [x, -y],
                Symmetry::HalfTurn => [-x, -y],
                _ => third([x, y]),
            });
            let order = if jaws == 3 { 3 } else { 2 };
            let one = default_with(|c: &mut Conditions| {
                (c.max_mobility, c.keep_output) = (Some(1), false)
            });
            let (search, diagrams) = searched(&m, one);
            // The option of each joint, and how many are changed.
            let list: BTreeSet<Vec<usize>> = search
                .cheapest_variants(&diagrams, usize::MAX / 4)
                .map(|v| {
                    let mut options = vec![0; m.joints.len()];
                    for (variable, &c) in search.space.variables.iter().zip(&v.choices) {
                        options[variable.joints[0].index()] = variable.choices[c].option;
                    }
                    options
                })
                .collect();
            let mut orbits: BTreeMap<usize, (u64, u64, u64)> = BTreeMap::new();
            for v in &list {
                let image = |v: &Vec<usize>| {
                    let mut out = v.clone();
                    (0..v.len()).for_each(|k| out[to[k]] = v[k]);
                    out
                };
                let round = std::iter::successors(Some(v.clone()), |v| Some(image(v)));
                let orbit: BTreeSet<Vec<usize>> = round.take(order).collect();
                assert!(orbit.is_subset(&list), "{}: {v:?}", s.name());
                let of = orbits
                    .entry(v.iter().filter(|o| **o > 0).count())
                    .or_default();
                of.0 += 1;
                of.1 += u64::from(orbit.first() == Some(v));
                of.2 += u64::from(orbit.len() == 1);
            }
            assert!(!list.is_empty(), "{}", s.name());
            let said = laid.counts.iter().filter(|((w, _), _)| *w == 1);
            let said = said.map(|(key, n)| {
                let (own, orbits) = laid.symmetric.split_orbits(key, n);
                (key.1 as usize, [n.clone(), orbits, own])
            });
            let found = orbits
                .iter()
                .map(|(&k, &(n, o, f))| (k, [n, o, f].map(BigUint::from)));
            assert_eq!(
                said.collect::<BTreeMap<_, _>>(),
                found.collect(),
                "{}",
                s.name()
            );
            let all: u64 = orbits.values().map(|of| of.1).sum();
            assert_eq!(one_per_orbit(&m), all.into(), "{}", s.name());
        });
    }
    assert_eq!(seen, 2 + 2 + 2);
}

#[test]
fn a_file_says_what_a_turn_carries_round() {
    let folder = tempdir().unwrap();
    let (db, file) = (path_in(&folder, "g.db"), path_in(&folder, "m.toml"));
    stdout_of(&format!(
        "catalog build --links 6 --symmetry half-turn --parallel without --ideas 1 --quiet -o {db}"
    ));
    let sql = "SELECT id, determinate_w1, orbits_w1 FROM structures JOIN layouts ON structure = id ORDER BY id LIMIT 1";
    let line = &query_lines(&db, sql)[0];
    let row = line.split(',').collect_vec();
    stdout_of(&["catalog", "export", &db, row[0], "-o", &file]);
    let counts = |more: &str| {
        run_json(&format!(
            "search {file} --max-mobility 1 --allow-output-change --quiet --format json {more}"
        ))["admissible"]
            .clone()
    };
    assert_eq!([counts(""), counts("--one-per-orbit")], [row[1], row[2]]);
    has(
        &stdout_of(&["catalog", "show", &db, row[0]]),
        "up to half-turn images",
    );
    // A file that groups wrong joints is told so, and one that groups them wrongly.
    let text = fs::read_to_string(&file).unwrap();
    let begin = text.find("turn = [").unwrap();
    let end = begin + text[begin..].find("\n\n").unwrap();
    let names: Vec<&str> = text[begin..end].split('"').skip(1).step_by(2).collect();
    let [a, b, c, d] = names[..4] else {
        panic!("{names:?}")
    };
    for (turn, says) in [
        (format!("turn = [[\"{a}\", \"{c}\"]]"), "image"),
        (format!("turn = [[\"{a}\"]]"), "write pairs for half a turn"),
        (
            format!("turn = [[\"{a}\", \"{b}\"]]\nmirror = [[\"{c}\", \"{d}\"]]"),
            "keep one of them",
        ),
    ] {
        let wrong = path_in(&folder, "wrong.toml");
        fs::write(&wrong, format!("{}{turn}{}", &text[..begin], &text[end..])).unwrap();
        assert_fails(&format!("search {wrong} --one-per-orbit"), says);
    }
}

/// Necklaces of two and of three beads, turned until all are back in place: counted one by one, and from those that a turn keeps.
#[test]
fn orbits_are_those_of_necklaces() {
    use ozols::search::answer::counts::count_orbits;
    for order in [2usize, 3] {
        for colours in 1..6usize {
            let all = colours.pow(u32::try_from(order).unwrap());
            let beads = |n: usize| (0..order).map(move |i| n / colours.pow(i as u32) % colours);
            let least = |n: usize| {
                let beads: Vec<usize> = beads(n).collect();
                let turned = |k: usize| [&beads[k..], &beads[..k]].concat();
                (0..order).map(turned).min()
            };
            let necklaces: BTreeSet<_> = (0..all).map(least).collect();
            let kept = (0..all).filter(|&n| beads(n).all(|b| Some(b) == beads(n).next()));
            let found = count_orbits(&all.into(), &kept.count().into(), order);
            assert_eq!(found, necklaces.len().into(), "{order} {colours}");
        }
    }
}
