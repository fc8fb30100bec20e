//! Ways in which structures are made: freely, as known schemes; and what they cost.

use super::super::carried_on::scattered_numbers;
use super::{
    Built, LAID, built, first_of, known, known_three, number, path_in, pulls_as_its_file_says,
    query_rows, stdout_of,
};
use crate::common::*;

/// Every structure of four links with pairs, laid out freely.
fn free() -> &'static str {
    static FILE: Built = OnceLock::new();
    let pairs = "--pairs slide,gear,slot --generic-pairs --symmetry generic";
    built(&FILE, &format!("{pairs} --links 4 --ideas 0"))
}

#[test]
fn free_structures_are_all_that_are_counted_and_pull_as_their_files_say() {
    // `counts.csv`: essential ones of four links with at most three pairs that are not hinges, any place of input and
    // jaws. Columns: links, kinds, chains and inputs, then eight for each drive, the second of which is the essential ones.
    let mut told = 0;
    for line in read_data("counts.csv").lines().skip(1) {
        let cells: Vec<u64> = line.split(',').map(|n| n.parse().unwrap_or(0)).collect();
        if cells[0] == 4 && cells[1] + cells[2] + cells[3] <= 3 {
            told += cells[9..].chunks(8).map(|drive| drive[1]).sum::<u64>();
        }
    }
    // Those of hinges are built as such.
    let found = &query_rows(free(), "SELECT count(*) AS n FROM structures")[0]["n"];
    assert_eq!(found.as_u64(), Some(told));
    let laid = query_rows(free(), LAID);
    assert!(laid.len() > 600, "{}", laid.len());
    let folder = tempdir().unwrap();
    let of = |i: u64| usize::try_from(i % laid.len() as u64).unwrap();
    let drawn: BTreeSet<usize> = scattered_numbers(23).take(12).map(of).collect();
    for &i in &drawn {
        assert_eq!(laid[i]["finite"], "1, proven");
        pulls_as_its_file_says(free(), &laid[i], &folder);
    }
}

/// Four links at 1, three slides at 2, two slots at 1.5 and the redesign; its drive works for both jaws and for friction.
#[test]
fn prices_and_actuators_are_as_by_hand() {
    let id = first_of("wedge-hook");
    let sql = format!(
        "SELECT g.*, s.joints FROM grippers g JOIN structures s ON s.id = g.id WHERE g.id = '{id}'"
    );
    let row = &query_rows(known(), &sql)[0];
    let price = 4.0 + 3.0 * 2.0 + 2.0 * 1.5 + number(row, "cost");
    assert!((number(row, "price") - price).abs() < 1e-9, "{row}");
    let work = number(row, "travel") / number(row, "least_force") / number(row, "efficiency");
    assert!((number(row, "actuator") - work).abs() < 0.01, "{row}");
    // It closes 50 mm by two jaws, 25 each, and no drive does that with less work.
    let all = query_rows(known(), "SELECT actuator, narrowest, widest FROM grippers");
    assert!(
        all.iter()
            .all(|r| number(r, "actuator") > number(r, "widest") - number(r, "narrowest") - 0.01)
    );
    let asked = stdout_of(&format!("catalog query {} --price 8 --format csv", known()));
    assert_eq!(asked.lines().count(), 2, "{asked}");
}

fn exported(folder: &tempfile::TempDir, scheme: &str, more: &[&str]) -> String {
    let toml = path_in(folder, "gripper.toml");
    let id = first_of(scheme);
    stdout_of(&[&["catalog", "export", known(), &id, "-o", &toml], more].concat());
    toml
}

/// Thread and guides by hand: a nut pushes 1 N along the screw, its flanks slide aslant, and the guide holds the moment of the tip.
#[test]
fn a_screw_loses_by_its_thread_and_guides() {
    let folder = tempdir().unwrap();
    let toml = exported(&folder, "screw-two-nuts", &[]);
    let m = ozols::from_toml(&fs::read_to_string(toml).unwrap()).unwrap();
    let told = format!(
        "SELECT * FROM grippers WHERE id = '{}'",
        first_of("screw-two-nuts")
    );
    let row = &query_rows(known(), &told)[0];
    // Of 25 mm each jaw, and a radian of the drive.
    let pitch = 25.0 / number(row, "travel");
    let screw = m.joints.iter().find(|j| j.drive).unwrap();
    let arm = 120.0 - 1e3 * to_vector(&screw.frame.point)[0];
    let thread = 0.1 * (4.0 + pitch * pitch / 4.0);
    let guide = 0.1 * 2.0 * arm / 40.0 * pitch;
    let by_hand = pitch / (pitch + thread + guide);
    assert!(
        (number(row, "efficiency") - by_hand).abs() < 2e-4,
        "{by_hand}: {row}"
    );
    assert!(
        (number(row, "least_force") - 1e3 / (2.0 * pitch)).abs() < 0.1,
        "{row}"
    );
}

/// Nuts of one hand, of other leads, beside the screw or on guides aslant are no gripper of that name.
#[test]
fn what_looks_like_a_screw_is_told_from_one() {
    let folder = tempdir().unwrap();
    let toml = exported(&folder, "screw-two-nuts", &[]);
    let text = fs::read_to_string(&toml).unwrap();
    let other = path_in(&folder, "other.toml");
    let with = |change: &dyn Fn(&mut toml::Table)| {
        let mut file: toml::Table = text.parse().unwrap();
        for joint in file["joint"].as_array_mut().unwrap() {
            let joint = joint.as_table_mut().unwrap();
            joint.remove("options");
            if joint["id"].as_str().unwrap().contains("jaw-a") {
                change(joint);
            }
        }
        file.remove("search");
        fs::write(&other, file.to_string()).unwrap();
        run_full(&["catalog", "find", &other])
    };
    let thread = |joint: &toml::Table| joint["type"].as_str() == Some("helical");
    assert_eq!(with(&|_| ()).0, Some(0));
    fn lead(joint: &mut toml::Table, to: fn(i64) -> i64) {
        if let Some(lead) = joint.get("lead").and_then(toml::Value::as_integer) {
            joint.insert("lead".into(), to(lead).into());
        }
    }
    let changes: [&dyn Fn(&mut toml::Table); 5] = [
        &|j| lead(j, |l| -l),
        &|j| lead(j, |l| l + 1),
        &|j| lead(j, |_| 0),
        &|j| {
            if thread(j) {
                j["point"].as_array_mut().unwrap()[0] = 77.into();
            }
        },
        &|j| {
            if !thread(j) {
                j["axis"].as_array_mut().unwrap()[0] = 1.into();
            }
        },
    ];
    for change in changes {
        let (code, _, told) = with(change);
        assert_eq!(code, Some(2));
        has(&told, "is a thread");
    }
}

/// Of several planes in which joints might turn it is that in which all moves: that of the redesign's own structure.
#[test]
fn redesigns_are_found_in_their_plane() {
    let folder = tempdir().unwrap();
    let toml = path_in(&folder, "idea.toml");
    for scheme in split_words("wedge-flat-faces wedge-hook screw-two-nuts toggle-sliding-jaws") {
        let id = first_of(scheme);
        for idea in 1..=4 {
            let line = format!("catalog export {} {id} --idea {idea} -o {toml}", known());
            if run_full(&line).0 == Some(0) {
                let found = stdout_of(&["catalog", "find", &toml, "--in", known()]);
                has(&found, &id);
            }
        }
    }
}

/// Three sides of a wedge with flat faces have slides and no slots, and are priced so.
#[test]
fn flat_faces_of_three_sides_are_slides() {
    let sql = "SELECT g.* FROM grippers g JOIN classics c ON c.structure = g.id WHERE c.id = 'wedge-flat-faces'";
    let row = &query_rows(known_three(), sql)[0];
    assert_eq!([number(row, "slides"), number(row, "slots")], [7.0, 0.0]);
    assert_eq!(number(row, "price"), 5.0 + 7.0 * 2.0 + number(row, "cost"));
}
