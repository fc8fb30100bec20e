//! `ozols sweep`, and its plots.

use super::LOADED;
use crate::common::{out, run, run_on, text};
use ozols::chart::{Axis, Contours, Scale};
use serde_json::Value;
use std::fs;

#[test]
fn the_command_writes_a_table_a_flat_one_and_a_plot() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    fs::write(at("swept.toml"), LOADED).unwrap();
    let (file, table, flat, plot) = (at("swept.toml"), at("t.jsonl"), at("t.csv"), at("t.svg"));
    let words = ["sweep", &file, "--grid", "3", "-q", "-o", &table];
    let more = [
        "--csv", &flat, "--svg", &plot, "--plot", "force", "--format", "json",
    ];
    let told: Value = serde_json::from_str(&out(&[&words[..], &more].concat())).unwrap();
    assert_eq!(
        (&told["samples"], &told["done"], &told["finished"]),
        (&9.into(), &9.into(), &true.into())
    );
    assert_eq!(told["states"][0]["redundant"][0]["samples"], 9);
    assert!(told["peak_force"]["greatest"]["force"].as_f64().unwrap() > 100.0);
    let lines = fs::read_to_string(&table).unwrap();
    assert_eq!(lines.lines().count(), 11);
    let rows = fs::read_to_string(&flat).unwrap();
    assert_eq!(rows.lines().count(), 10);
    let head: Vec<&str> = rows.lines().next().unwrap().split(',').collect();
    assert!(
        head.starts_with(&["sample", "x", "y", "mobility_free"]),
        "{head:?}"
    );
    let svg = fs::read_to_string(&plot).unwrap();
    roxmltree::Document::parse(&svg).unwrap();
    // A mark for each sample, with what it is about.
    assert_eq!(
        svg.matches("<title>20, ").count() + svg.matches("<title>30, ").count(),
        6
    );
    // The text says the same, and the same again.
    let said = out(&words);
    assert!(
        said.contains("grid 3 x 3, rod") || said.contains("grid 3 x 3, x from 20 to 40"),
        "{said}"
    );
    assert!(
        said.contains("9 of 9 samples done") && said.contains("Peak force as built: from "),
        "{said}"
    );
    assert_eq!(out(&words), said);
}

#[test]
fn an_interrupted_sweep_says_so_and_is_carried_on() {
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("t.jsonl");
    let table = table.to_str().unwrap();
    let words = [
        "sweep",
        "parallelogram-3-rods",
        "--sobol",
        "200",
        "--no-search",
        "--threads",
        "1",
        "-o",
        table,
    ];
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_ozols"))
        .args(words)
        .stderr(std::process::Stdio::piped())
        .stdout(std::process::Stdio::null())
        .spawn()
        .unwrap();
    // Some rows are there before the signal comes.
    while fs::read_to_string(table).map_or(0, |t| t.lines().count()) < 3 {
        std::thread::sleep(std::time::Duration::from_millis(2));
        assert!(
            child.try_wait().unwrap().is_none(),
            "it ended before it could be interrupted"
        );
    }
    std::process::Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .unwrap();
    let ended = child.wait_with_output().unwrap();
    let said = text(&ended.stderr);
    assert_eq!(ended.status.code(), Some(130), "{said}");
    assert!(said.contains("the same command carries on"), "{said}");
    assert!(run(&words).status.success());
    let resumed = fs::read(table).unwrap();
    let whole = folder.path().join("whole.jsonl");
    let mut words = words;
    words[8] = whole.to_str().unwrap();
    assert!(run(&words).status.success());
    assert_eq!(fs::read(whole).unwrap(), resumed);
}

#[test]
fn over_one_parameter_a_plot_is_a_chart() {
    let one = LOADED.replace("y = { values = [30, 40, \"10*sqrt(2)\"] }", "y = 40");
    let folder = tempfile::tempdir().unwrap();
    let plot = folder.path().join("one.svg");
    let flags = [
        "-q",
        "--no-search",
        "--svg",
        plot.to_str().unwrap(),
        "--plot",
        "force",
    ];
    let (code, _, err) = run_on("sweep", "one.toml", &one, &flags);
    assert_eq!(code, Some(0), "{err}");
    let svg = fs::read_to_string(plot).unwrap();
    assert!(
        svg.contains("oz-chart") && svg.contains("peak force, N"),
        "{svg}"
    );
}

fn plane(counts: bool, of: impl Fn(f64, f64) -> f64) -> Contours {
    let axis = |label: &str| Axis {
        label: label.to_owned(),
        scale: Scale::Linear,
    };
    let each = |i: u32| (f64::from(i % 5), f64::from(i / 5));
    let samples = (0..25).map(each).map(|(x, y)| (x, y, of(x, y)));
    Contours {
        title: "t".to_owned(),
        subtitle: String::new(),
        x: axis("x"),
        y: axis("y"),
        value: "v".to_owned(),
        samples: samples.collect(),
        counts,
    }
}

/// The points of the lines of equal value.
fn lines(svg: &str) -> Vec<Vec<(f64, f64)>> {
    let document = roxmltree::Document::parse(svg).unwrap();
    let paths = document
        .descendants()
        .filter(|n| n.attribute("class") == Some("line c4"));
    let points = |d: &str| {
        let each = d.split(['M', 'L']).filter(|p| !p.is_empty());
        each.map(|p| {
            let (x, y) = p.split_once(' ').unwrap();
            (x.parse().unwrap(), y.parse().unwrap())
        })
        .collect()
    };
    paths.map(|p| points(p.attribute("d").unwrap())).collect()
}

#[test]
fn lines_of_equal_value_are_where_the_value_is_equal() {
    // Over a plane they are straight: here upright, each at one x.
    let upright = lines(&plane(false, |x, _| x).svg());
    assert!(!upright.is_empty());
    for line in &upright {
        assert!(line.len() >= 8);
        assert!(
            line.iter().all(|p| (p.0 - line[0].0).abs() < 0.02),
            "{line:?}"
        );
    }
    let level = lines(&plane(false, |_, y| y).svg());
    for line in &level {
        assert!(
            line.iter().all(|p| (p.1 - line[0].1).abs() < 0.02),
            "{line:?}"
        );
    }
    // Between counts there is nothing, nor round a place without a value, which is hollow and in the legend.
    assert!(lines(&plane(true, |x, _| x.round()).svg()).is_empty());
    let hole = plane(
        false,
        |x, y| if (x, y) == (2.0, 2.0) { f64::NAN } else { x },
    );
    assert!(lines(&hole.svg()).iter().flatten().count() < upright.iter().flatten().count());
    assert_eq!(hole.svg().matches("class=\"hollow c5\"").count(), 2);
    // Where samples are no grid there are none.
    let mut few = plane(false, |x, _| x);
    few.samples.pop();
    assert!(lines(&few.svg()).is_empty());
    assert_eq!(
        few.svg().matches("<circle").count() + 1,
        plane(false, |x, _| x).svg().matches("<circle").count()
    );
}
