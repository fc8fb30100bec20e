//! Links that cross and pass each other in planes.

use super::super::command::path_in;
use super::query_rows;
use crate::common::*;

/// Links may cross as often as they like where there are planes in which they pass each other over the whole stroke, and six times
/// where there are none.
#[test]
fn what_crosses_often_passes_in_planes() {
    let folder = tempdir().unwrap();
    let file = path_in(&folder, "turned.db");
    let words = "catalog build --links 6 --pairs slot --symmetry half-turn --ideas 0 --quiet -o";
    stdout_of(&format!("{words} {file}"));
    let all = query_rows(
        &file,
        "SELECT no_layout, crossings, planes FROM structures LEFT JOIN layouts l ON l.structure = id LEFT JOIN planes p ON p.structure = id",
    );
    let number = |row: &Value, key: &str| row[key].as_u64();
    let often = all.iter().filter(|r| number(r, "crossings") > Some(6));
    let planes: Vec<Option<u64>> = often.map(|r| number(r, "planes")).collect();
    assert!(
        !planes.is_empty() && planes.iter().all(Option::is_some),
        "{planes:?}"
    );
    // Joints at the centre by rule are on one axis, no link of no length.
    let endless = |r: &&Value| {
        r["no_layout"]
            .as_str()
            .is_some_and(|s| s.contains("1 : inf"))
    };
    assert_eq!(all.iter().filter(endless).count(), 0);
}
