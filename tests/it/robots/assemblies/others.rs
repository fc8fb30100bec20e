//! Files of others, where they are. `expected.json` beside them has W and σ by an independent numeric rank at the pose of each file,
//! and how many parts and constraints there are.

use super::{figures, read};
use crate::common::*;
use ozols::robots::Options;

/// The files and what is to be found of each; nothing where the files are not there.
fn expected() -> Vec<(String, Vec<u8>, Value)> {
    let Some(folder) = assemblies_of_others() else {
        return Vec::new();
    };
    let text = fs::read_to_string(folder.join("expected.json")).unwrap();
    let all: Value = serde_json::from_str(&text).unwrap();
    let all = all.as_object().unwrap();
    assert!(all.len() >= 18);
    let one = |(name, v): (&String, &Value)| {
        let bytes = fs::read(folder.join(name)).unwrap();
        (name.clone(), bytes, v.clone())
    };
    all.iter().map(one).collect()
}

// An angle between parallel axes is a row of zeros in the rank by which it was made, and a joint that holds nothing here, with one
// row said to be left out: σ and what is left out are as many.
#[test]
fn mobility_and_redundancy_are_those_of_an_independent_rank() {
    for (name, bytes, v) in expected() {
        let i = read(&name, &bytes, &Options::default());
        let (w, sigma) = figures(&i);
        let of = |k: &str| usize::try_from(v["own_file"][k].whole()).unwrap();
        assert_eq!(w, of("W"), "{name}");
        assert_eq!(sigma + i.report.constraint_rows, of("sigma"), "{name}");
        assert_eq!(
            i.report.constraint_rows,
            usize::from(name.contains("cubes") || name.contains("angle")),
            "{name}"
        );
    }
}

#[test]
fn parts_and_constraints_are_counted_as_freecad_counts_them() {
    for (name, bytes, v) in expected() {
        let count = read(&name, &bytes, &Options::default())
            .report
            .count
            .unwrap();
        let of = |k: &str| usize::try_from(v[k].whole()).unwrap();
        assert_eq!(
            (count.parts, count.constraints),
            (of("bodies"), of("constraints")),
            "{name}"
        );
        if let Some(dof) = v["OndselSolver"]["dof_as_freecad_counts"].as_i64() {
            assert_eq!(count.freedoms(), dof, "{name}");
        }
    }
}

// OndselSolver takes away as many constraints as are redundant, where it ends at all and the file is closed.
#[test]
fn as_many_are_redundant_as_the_solver_takes_away() {
    for (name, bytes, v) in expected() {
        let Some(removed) = v["OndselSolver"]["removed"].as_u64() else {
            continue;
        };
        let i = read(&name, &bytes, &Options::default());
        let sigma = figures(&i).1 + i.report.constraint_rows;
        assert_eq!(sigma as u64, removed, "{name}");
    }
}

// The guide's table beside FreeCAD: its count and what the solver takes away as stored, W and σ as found here.
#[test]
fn the_guide_says_what_each_finds() {
    let guide = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/guide/beside.md");
    let guide = fs::read_to_string(guide).unwrap();
    for (name, bytes, v) in expected() {
        let solver = &v["OndselSolver"];
        let Some(dof) = solver["dof_as_freecad_counts"].as_i64() else {
            continue;
        };
        let (w, sigma) = figures(&read(&name, &bytes, &Options::default()));
        let (_, file) = name.split_once('/').unwrap();
        let row = format!(
            "| {file} | {} | {} | {dof} | {} | {w} | {sigma} |",
            v["bodies"], v["constraints"], solver["removed"]
        );
        assert!(guide.contains(&row), "not in the guide: {row}");
    }
}
