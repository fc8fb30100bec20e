//! What is wrong with parameters, samples and tables, in words that name place and remedy.

use super::{LOADED, all, asked, sweep, three_rods};
use crate::common::{changed, run_on};
use ozols::file::text::mechanism_from_str;
use ozols::shard::Shard;
use ozols::sweep::space::Sampling;
use ozols::sweep::table::{make, merge, read};
use std::fs;

#[test]
fn a_file_with_parameters_is_wrong_where_they_are() {
    for (from, to, said) in [
        (
            "point = [\"x\", \"y\", 0]",
            "point = [\"x\", \"z\", 0]",
            "unknown word `z`",
        ),
        (
            "range = [20, 40]",
            "range = [40, 20]",
            "the range of parameter \"x\" is empty: from 40 to 20",
        ),
        ("range = [20, 40]", "range = [30, 30]", "is empty"),
        (
            "{ range = [20, 40], default = 30 }",
            "{ default = 30 }",
            "parameter \"x\" has no values",
        ),
        (
            "default = 30",
            "default = 50",
            "the default 50 of parameter \"x\" is not within its range",
        ),
        (
            "values = [30, 40, ",
            "default = 31, values = [30, 40, ",
            "the default 31 of parameter \"y\" is not one of its values",
        ),
        (
            "values = [30, 40, ",
            "range = [1, 2], values = [30, 40, ",
            "range cannot stand beside values",
        ),
        (
            "values = [30, 40, \"10*sqrt(2)\"]",
            "values = []",
            "parameter \"y\" has no values",
        ),
        (
            "rod = 96",
            "rod = 96\npi = 3",
            "no parameter can be named \"pi\"",
        ),
        (
            "rod = 96",
            "rod = 96\n\"2a\" = 3",
            "no parameter can be named \"2a\"",
        ),
        (
            "rod = 96",
            "rod = 96\nidle = 3",
            "nothing depends on parameter \"idle\"",
        ),
        (
            "rod = 96",
            "rod = true",
            "expected a number, or a table such as",
        ),
        (
            "default = 30",
            "defualt = 30",
            "expected a number, or a table such as",
        ),
        (
            "range = [20, 40]",
            "range = [20, \"1/0\"]",
            "division by zero",
        ),
    ] {
        let text = changed(LOADED, from, to);
        let (code, _, err) = run_on("analyze", "wrong.toml", &text, &[]);
        assert_eq!(code, Some(2), "{to}: {err}");
        assert!(
            err.contains(said) && err.contains("wrong.toml:"),
            "{to}: {err}"
        );
    }
    // An unknown word is told with the names there are.
    let text = changed(LOADED, "\"x + rod\"", "\"x + rods\"");
    let err = mechanism_from_str("wrong.toml", &text)
        .unwrap_err()
        .to_string();
    assert!(err.contains("and the parameters rod, x, y"), "{err}");
}

#[test]
fn without_a_sweep_a_parameter_is_its_default() {
    let plain = three_rods()
        .replace("\"height\"", "200")
        .replace("\"600 + offset\"", "600")
        .replace("\"height/100\"", "2");
    let (before, rest) = plain.split_once("# What `ozols sweep` varies").unwrap();
    let plain = format!("{before}{}", &rest[rest.find("[[link]]").unwrap()..]);
    assert!(!plain.contains("parameter") && !plain.contains("offset"));
    for command in [
        "analyze",
        "search",
        "check",
        "export --to toml",
        "statics --groups",
    ] {
        let mut words = command.split(' ');
        let name = words.next().unwrap();
        let more: Vec<&str> = words.collect();
        let of = |text: &str| {
            let (code, out, _) = run_on(name, "same.toml", text, &more);
            // The last line of a search is how long it took; steps name the folder of the file.
            (code, out.split("\n  Next:").next().unwrap().to_owned())
        };
        assert_eq!(of(&three_rods()), of(&plain), "{command}");
    }
}

#[test]
fn a_sample_that_makes_no_mechanism_is_a_row_that_says_so() {
    // A rod of 35 does not reach over 40, so that its end is nowhere.
    let text = changed(LOADED, "rod = 96", "rod = 96\nlong = 35");
    let text = text.replace(
        "[\"x + rod\", 0, 0]",
        "[\"x + rod + sqrt(long^2 - y^2)\", 0, 0]",
    );
    let table = all(
        &sweep(
            &text
                .replace("30, 40,", "40, 30,")
                .replace("\"10*sqrt(2)\"] }", "\"10*sqrt(2)\"], default = 30 }"),
            Sampling::Grid { points: 2 },
            asked(),
        ),
        None,
    );
    for row in &table.rows {
        let problem = row.problem.as_deref();
        assert_eq!(problem.is_some(), row.at["y"] == 40.0, "{row:?}");
        let Some(problem) = problem else { continue };
        assert!(problem.starts_with("swept.toml:"), "{problem}");
        assert!(
            problem.contains("square root of a negative number"),
            "{problem}"
        );
        assert!(row.states.is_empty());
    }
    let summary = table.summary();
    assert_eq!(
        summary.problems.values().map(|t| t.samples).sum::<usize>(),
        2
    );
    assert_eq!(
        summary.redundant[0]
            .by_figure
            .values()
            .map(|t| t.samples)
            .sum::<usize>(),
        4
    );
    // At the defaults it is the file that is wrong.
    let (code, _, err) = run_on(
        "sweep",
        "never.toml",
        &text.replace("30, 40,", "40, 30,"),
        &["-q"],
    );
    assert_eq!(code, Some(2));
    assert!(
        err.contains("square root of a negative number") && err.contains("never.toml:"),
        "{err}"
    );
}

#[test]
fn samplings_that_cannot_be_are_refused() {
    let plain = ozols::builtin::text("four-bar").unwrap();
    for (text, flags, said) in [
        (
            plain,
            vec![],
            "the file has no parameter with a range or values",
        ),
        (LOADED, vec!["--grid", "1"], "--grid must be at least 2"),
        (
            LOADED,
            vec!["--grid", "1000000"],
            "more than 1000000 samples",
        ),
        (
            LOADED,
            vec!["--sobol", "0"],
            "--sobol must be from 1 to 65536",
        ),
        (
            LOADED,
            vec!["--sobol", "65537"],
            "--sobol must be from 1 to 65536",
        ),
        (
            LOADED,
            vec!["--sobol", "4", "--grid", "3"],
            "cannot be used with",
        ),
        (LOADED, vec!["--shard", "1/2"], "--output"),
        (
            LOADED,
            vec!["--shard", "3/2", "-o", "x.jsonl"],
            "a part is written 1/7",
        ),
        (LOADED, vec!["--stroke", "0:x:1"], "is not FROM:TO:STEPS"),
        (
            LOADED,
            vec!["--grid", "2", "--svg", "x.svg", "--over", "x,nowhere"],
            "not x,nowhere",
        ),
        (
            LOADED,
            vec!["--seed", "5000000000", "--sobol", "4"],
            "--seed",
        ),
    ] {
        let flags = [&["-q", "--no-search"], &flags[..]].concat();
        let (code, _, err) = run_on("sweep", "swept.toml", text, &flags);
        assert_eq!(code, Some(2), "{flags:?}: {err}");
        assert!(err.contains(said), "{flags:?}: {err}");
    }
}

#[test]
fn a_table_of_something_else_stays_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("table.jsonl");
    let grid = |points| sweep(LOADED, Sampling::Grid { points }, asked());
    let tried = |points| {
        let before = fs::read(&path).unwrap();
        let why = make(&grid(points), Shard::WHOLE, Some(&path), &mut super::Works);
        assert_eq!(fs::read(&path).unwrap(), before);
        why.unwrap_err().to_string()
    };
    all(&grid(2), Some(&path));
    assert!(
        tried(3).contains("the sampling differs: grid 2 x 3 there, grid 3 x 3 asked for"),
        "{}",
        tried(3)
    );
    let whole = fs::read_to_string(&path).unwrap();
    fs::write(&path, whole.replace("\"redundant\":0", "\"redundant\":1")).unwrap();
    assert!(tried(2).contains("was changed"), "{}", tried(2));
    assert!(read(&path).unwrap_err().to_string().contains("was changed"));
    for other in ["mine\n", "{}\n", "\u{0}\u{1}"] {
        fs::write(&path, other).unwrap();
        assert!(
            tried(2).contains("is not a table of a sweep"),
            "{}",
            tried(2)
        );
    }
    fs::write(&path, [0xff, 0xfe, b'\n']).unwrap();
    assert!(
        tried(2).contains("is not a table of a sweep"),
        "{}",
        tried(2)
    );
}

#[test]
fn parts_that_do_not_make_the_whole_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let part = |points, index, of, name: &str| {
        let swept = sweep(LOADED, Sampling::Grid { points }, asked());
        make(
            &swept,
            Shard::nth(index, of).unwrap(),
            Some(&at(name)),
            &mut super::Works,
        )
        .unwrap();
        at(name)
    };
    let (one, two) = (part(3, 1, 2, "1"), part(3, 2, 2, "2"));
    let (other, third) = (part(2, 2, 2, "other"), part(3, 3, 3, "third"));
    let (unfinished, nowhere) = (at("unfinished"), at("nowhere"));
    let text = fs::read_to_string(&two).unwrap();
    fs::write(&unfinished, &text[..text.len() - 10]).unwrap();
    for (parts, said) in [
        (vec![&one], "2/2 is missing"),
        (vec![&one, &one], "1/2 is there twice"),
        (vec![&one, &two, &one], "1/2 is there twice"),
        (vec![&one, &other], "the sampling differs"),
        (vec![&one, &two, &third], "one is of 2, another of 3"),
        (vec![&one, &unfinished], "is not finished"),
        (vec![&one, &nowhere], "nowhere"),
    ] {
        let parts: Vec<_> = parts.into_iter().cloned().collect();
        let why = merge(&parts, &at("whole")).unwrap_err().to_string();
        assert!(why.contains(said), "{why}");
        assert!(!at("whole").exists());
    }
    assert_eq!(merge(&[two, one], &at("whole")).unwrap().rows.len(), 9);
}
