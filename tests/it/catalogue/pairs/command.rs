//! `ozols catalog count --pairs` as people and programs read it.

use crate::common::*;
#[test]
fn place_of_the_input_and_driven_jaws_are_columns() {
    let counted = run_quiet("catalog count --links 3..6 --pairs slide,gear,slot --at-most 3");
    has(&counted, "6 links: 784 chains");
    let lines = counted.lines().filter(|l| l.contains("essential"));
    let mut numbers = lines.map(|l| {
        let words = l.split_whitespace().skip(1);
        words
            .filter_map(|w| w.replace(',', "").parse::<u64>().ok())
            .collect_vec()
    });
    // The published counts: at the frame and between, jaws apart; driven ones are one number there.
    let six = numbers.find(|n| n.first() == Some(&29_882)).unwrap();
    assert_eq!((six[0], six[2], six[1] + six[3]), (29_882, 41_545, 77_193));
}

#[test]
fn data_has_a_row_for_each_kind_of_drive() {
    let count = |more: &str| format!("catalog count --links 4 --pairs slide,gear,slot {more}");
    let all = run_json(&count("--format json"));
    assert_eq!(all.list().len(), 9 * 8);
    let of = |place: &str, jaws: &str| {
        let own = all
            .list()
            .iter()
            .filter(|r| r["place"] == place && r["jaws"] == jaws);
        own.map(|r| r["essential"].whole()).sum::<u64>()
    };
    assert_eq!([of("frame", "apart"), of("between", "apart")], [159, 0]);
    assert_eq!(of("frame", "driven") + of("between", "driven"), 535);
    assert_eq!(run_quiet(&count("--format csv")).lines().count(), 9 * 8 + 1);
    let alone = run_quiet(&count("--chains"));
    has(&alone, "32 chains");
    lacks(&alone, "essential  ");
}
