//! Variants of a search's list as mechanisms of their own, and what to do where there are none.

use crate::common::*;
/// Flags of a question and places in its list.
const LISTS: [(&str, &str, &[usize]); 7] = [
    ("gripper-10", "", &[1, 7]),
    ("gripper-10", "--max-external 2", &[1, 3]),
    ("gripper-10", "--max-redundant 4 --max-changes 3", &[1, 4]),
    (
        "gripper-10",
        "--options revolute,cylindrical,spherical,sphere-in-cylinder --symmetric",
        &[2],
    ),
    ("gripper-10-loaded", "--pool 50", &[1, 3]),
    ("four-bar", "", &[1, 14]),
    ("lever-gripper", "", &[1, 2]),
];

fn listed(file: &str, flags: &str, k: usize) -> Value {
    let value = run_json(&format!("search {file} --top {k} --format json {flags}"));
    let variant = value["variants"][k - 1].clone();
    assert_eq!(variant["position"], k);
    variant
}

#[test]
fn an_exported_variant_has_the_figures_of_the_list() {
    let mut pads = 0;
    for (file, flags, places) in LISTS {
        for &k in places {
            let variant = listed(file, flags, k);
            let line = format!("export {file} --variant {k} --to toml {flags}");
            let written = run_quiet(&line);
            let found = json_on("analyze", "v.toml", &written, "");
            for key in ["mobility", "redundant"] {
                assert_eq!(found["states"][0][key], variant[key], "{file} {flags} {k}");
            }
            if let Some(external) = variant["external_redundant"].as_u64() {
                let e = &found["states"][1]["external"];
                assert_eq!(e["redundant_by_rank"].as_u64(), Some(external));
                assert_eq!(e["agree"], true);
            }
            pads += usize::from(written.contains("a-8 unloading"));
            for change in variant["changes"].list() {
                let mut lines = written.lines();
                let head = lines.find(|l| l.starts_with("description")).unwrap();
                has(head, change["joint"].word());
            }
            // What is a mechanism of its own is exported again like any other.
            assert_eq!(run_on("export", "v.toml", &written, "--to toml").0, Some(0));
        }
    }
    assert_eq!(pads, 2);
}

#[test]
fn variants_in_every_format_and_drawn() {
    for to in ["toml", "json", "urdf", "sdf", "dot"] {
        let v = run_quiet(&["export", "gripper-10", "--variant", "2", "--to", to, "-q"]);
        assert_ne!(
            v,
            run_quiet(&["export", "gripper-10", "--to", to, "-q"]),
            "{to}"
        );
        assert!(v.contains("gripper-10-variant-2"), "{to}: {v}");
    }
    // The ranked list, not that of cost.
    let first = listed("gripper-10-loaded", "--pool 2000", 1);
    let changed = first["changes"][0]["to"].word();
    let drawn = run_quiet("draw gripper-10-loaded --variant 1 --pool 2000");
    assert!(drawn.contains(changed), "{changed}");
    assert_all_fail(
        "
        export four-bar --to dot --variant 0 | numbered from 1
        export four-bar --to dot --variant 999 | no variant 999: the search gives
        ",
    );
}

// Every condition said to help does, and nothing less would.
#[test]
fn what_would_help_where_nothing_is_found() {
    let mut seen = BTreeSet::new();
    for q in [
        "--max-mobility 1 --max-changes 3",
        "--max-mobility 0",
        "--max-external 1 --max-changes 5 --options revolute,spherical,sphere-in-cylinder",
        "--options revolute,cylindrical",
    ] {
        let (code, told, _) = run_full(&format!("search gripper-10 {q} --format json"));
        assert_eq!(code, Some(1), "{q}");
        let value: Value = serde_json::from_str(&told).unwrap();
        for r in value["relaxations"].list() {
            let what = r["condition"].word();
            seen.insert(what.to_owned());
            let flag = format!("--{what}");
            let own = split_words(q);
            let others = own
                .chunks(2)
                .filter(|pair| pair[0] != flag)
                .flatten()
                .join(" ");
            let ask = |to: Option<i64>| {
                let to = to.map_or(String::new(), |n| n.to_string());
                let line = format!("search gripper-10 {others} {flag} {to} --count --format json");
                let found: Value = serde_json::from_str(&run_full(&line).1).unwrap();
                parse_count(&found["admissible"])
            };
            let to = r["to"].as_i64();
            assert_eq!(ask(to), parse_count(&r["admissible"]), "{q} {r}");
            assert!(ask(to) > 0);
            if let Some(n) = to.filter(|n| *n > 0) {
                assert_eq!(ask(Some(n - 1)), 0, "{q} {r}");
            }
        }
        let (_, text, _) = run_full(&format!("search gripper-10 {q}"));
        assert!(text.starts_with("gripper-10: none of "), "{text}");
        has(&text, "ore joint types");
    }
    assert!(seen.len() >= 4, "{seen:?}");
}

/// Of a list of one variant of each orbit the first so many are the beginning of the whole, however short, and a sample is drawn
/// from the same ones, each orbit with the same chance.
#[test]
fn orbits_are_listed_however_few_are_asked_for_and_sampled_alike() {
    let rows = |more: &str| -> Vec<String> {
        let search = "search gripper-slider-two-fingers --one-per-orbit --check none --format csv";
        let text = run_quiet(&format!("{search} {more}"));
        assert!(!text.contains('#'), "{text}");
        let choices = |l: &str| l.split_once(',').unwrap().1.to_owned();
        text.lines().skip(1).map(choices).collect()
    };
    let whole = rows("--all");
    assert_eq!(whole.len(), 302);
    for top in [1, 2, 3, 5, 10, 20, 50, 100, 301] {
        assert_eq!(rows(&format!("--top {top}")), whole[..top], "{top}");
    }
    let sample = rows("--sample 3020");
    assert_eq!(sample.len(), 3020);
    let mut drawn: BTreeMap<&String, usize> = whole.iter().map(|row| (row, 0)).collect();
    for row in &sample {
        *drawn.get_mut(row).unwrap() += 1;
    }
    // Ten each on average: within five standard deviations, where one twice as likely would mostly be beyond.
    assert!(drawn.values().all(|&n| n <= 26), "{drawn:?}");
}

/// A list of all variants is by cost whatever ranking a file has, and so is the command that leads on from it.
#[test]
fn what_follows_a_list_of_all_variants_is_of_that_list() {
    let text = run_quiet("search lever-gripper --all");
    let next = text
        .lines()
        .find(|l| l.contains("ozols export lever-gripper"))
        .unwrap();
    has(next, "--rank cost --variant 1");
}

/// A type that one joint has already is offered at the others, as if the file listed it, and one that none is offered may be forbidden.
#[test]
fn a_type_that_a_joint_has_is_offered_at_the_others() {
    let four_bar = run_quiet("show four-bar");
    let text = replace_once(
        &four_bar,
        "id = \"3-0\"\nlinks = [\"3\", \"0\"]\ntype = \"revolute\"",
        "id = \"3-0\"\nlinks = [\"3\", \"0\"]\ntype = \"spherical\"",
    );
    let searched = |text: &str, more: &str| {
        Folder::with("it.toml", text).json(&format!("search it.toml --count {more}"))
    };
    let start = text.find("[search]").unwrap();
    let rest = text[start..].find("options = ").unwrap() + start;
    let end = rest + text[rest..].find(']').unwrap() + 1;
    let listing = |types: &str| format!("{}options = {types}{}", &text[..rest], &text[end..]);
    let file = listing("[\"cylindrical\"]");
    for (types, list) in [
        ("spherical", "[\"spherical\"]"),
        ("cylindrical,spherical", "[\"cylindrical\", \"spherical\"]"),
    ] {
        let [told, wanted] = [
            searched(&file, &format!("--options {types}")),
            searched(&listing(list), ""),
        ];
        for key in ["space", "admissible", "determinate"] {
            assert_eq!(told[key], wanted[key], "{types} {key}");
        }
        assert!(parse_count(&told["determinate"]) > 0);
    }
    let none = searched(&file, "--forbid 1-2=universal");
    assert_eq!(none["space"], searched(&file, "")["space"]);
}

#[test]
fn limits_in_the_file_are_those_of_the_options() {
    let own = builtin::text("lever-gripper").unwrap();
    for (keys, flags) in [
        ("max_redundant = 1", "--max-redundant 1"),
        ("max_mobility = 1", "--max-mobility 1"),
        ("symmetric = true", "--symmetric"),
    ] {
        let text = own.replacen("[search]\n", &format!("[search]\n{keys}\n"), 1);
        assert_ne!(text, own);
        let (_folder, path) = write_temporary("mine.toml", &text);
        let counts = |line: &str| {
            let found = run_json(&format!("search {line} --count --format json"));
            [
                &found["admissible"],
                &found["lasting"],
                &found["determinate"],
            ]
            .map(Value::clone)
        };
        let asked = counts(&format!("lever-gripper {flags}"));
        assert_eq!(counts(path), asked, "{keys}");
        assert_ne!(counts("lever-gripper"), asked, "{keys}");
        let kept = run_quiet(&["export", path, "--to", "toml"]);
        has(&kept, keys);
    }
}
