//! Wedges with flat faces.

use super::super::command::path_in;
use super::{first_of, known, query_rows};
use crate::common::*;

/// A wedge with flat faces has two constraints more that are redundant than one with pins in its slots, both in the plane, and pulls by half
/// the cotangent of its angle (`dims.json`) all the same; its redesigns are as many by trying all.
#[test]
fn flat_faces_are_redundant_in_the_plane_already() {
    let folder = tempdir().unwrap();
    let of = |scheme: &str| {
        let sql = format!(
            "SELECT mechanism, redundant, force_min, force_max, determinate, name FROM layouts JOIN structures ON id = structure \
             WHERE structure = '{}'",
            first_of(scheme)
        );
        query_rows(known(), &sql).remove(0)
    };
    let (flat, hook) = (of("wedge-flat-faces"), of("wedge-hook"));
    let number = |row: &Value, key: &str| row[key].as_f64().unwrap();
    assert_eq!(number(&flat, "redundant"), number(&hook, "redundant") + 2.0);
    assert!(flat["name"].as_str().unwrap().ends_with(" mirror flat"));
    let file: toml::Table = flat["mechanism"].as_str().unwrap().parse().unwrap();
    let joints = file["joint"].as_array().unwrap();
    let inclined = joints.iter().find_map(|j| {
        let [x, y] = [0, 1].map(|k| j["axis"][k].as_integer().unwrap());
        (x != 0 && y != 0).then(|| (x as f64 / y as f64).abs())
    });
    for key in ["force_min", "force_max"] {
        let half = inclined.unwrap() / 2.0;
        assert!((number(&flat, key) / half - 1.0).abs() < 1e-3, "{flat}");
    }
    let toml = path_in(&folder, "flat.toml");
    fs::write(&toml, flat["mechanism"].as_str().unwrap()).unwrap();
    let tried = run_json(&["search", &toml, "--method", "brute", "--format", "json"]);
    assert_eq!(
        tried["determinate"].to_string(),
        format!("\"{}\"", flat["determinate"])
    );
    let found = stdout_of(&["catalog", "find", &toml]);
    has_all(&found, &["Known as wedge-flat-faces", "5 slides"]);
}
