//! `ozols catalog count --pairs` as people and programs read it.

use crate::common::{json, out, ozols, text};
use itertools::Itertools;

fn count(more: &[&str]) -> String {
    out(&[&["catalog", "count"], more].concat())
}

#[test]
fn place_of_the_input_and_driven_jaws_are_columns() {
    let pairs = [
        "--links",
        "3..6",
        "--pairs",
        "slide,gear,slot",
        "--at-most",
        "3",
    ];
    let out = count(&pairs);
    assert!(out.contains("6 links: 784 chains"), "{out}");
    let line = out
        .lines()
        .filter(|l| l.contains("essential"))
        .collect_vec();
    let numbers = line.iter().map(|l| {
        let words = l.split_whitespace().skip(1);
        words
            .map(|w| w.replace(',', "").parse::<u64>().ok())
            .collect_vec()
    });
    // The published counts: at the frame and between, jaws apart; driven ones are one number there.
    let six = numbers
        .into_iter()
        .find(|n| n.first() == Some(&Some(29_882)))
        .unwrap();
    let six = six.into_iter().flatten().collect_vec();
    assert_eq!((six[0], six[2], six[1] + six[3]), (29_882, 41_545, 77_193));
}

#[test]
fn data_has_a_row_for_each_kind_of_drive() {
    let pairs = ["--links", "4", "--pairs", "slide,gear,slot"];
    let all = json(&[&["catalog", "count"][..], &pairs, &["--format", "json"]].concat());
    let rows = all.as_array().unwrap();
    assert_eq!(rows.len(), 9 * 8);
    let of = |place: &str, jaws: &str| {
        let own = rows
            .iter()
            .filter(|r| r["place"] == place && r["jaws"] == jaws);
        own.map(|r| r["essential"].as_u64().unwrap()).sum::<u64>()
    };
    assert_eq!([of("frame", "apart"), of("between", "apart")], [159, 0]);
    assert_eq!(of("frame", "driven") + of("between", "driven"), 535);
    let csv = count(&[&pairs[..], &["--format", "csv"]].concat());
    assert_eq!(csv.lines().count(), 9 * 8 + 1);
    let alone = count(&[&pairs[..], &["--chains"]].concat());
    assert!(
        alone.contains("32 chains") && !alone.contains("essential  "),
        "{alone}"
    );
}

#[test]
fn what_cannot_be_counted_is_refused() {
    for (bad, said) in [
        (&["--pairs", "hinge"][..], "slide, gear, slot"),
        (&["--pairs", "slide", "--mobility", "2"], "one motion"),
        (&["--pairs", "slide", "--links", "4..12"], "10 links"),
        (&["--links", "3"], "--pairs"),
        (&["--at-most", "2"], "--pairs"),
    ] {
        let o = ozols(&[&["catalog", "count"], bad].concat())
            .output()
            .unwrap();
        assert_eq!(o.status.code(), Some(2), "{bad:?}");
        assert!(text(&o.stderr).contains(said), "{}", text(&o.stderr));
    }
}
