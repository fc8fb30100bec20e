//! The task of a catalogue as a file and as options, the filters, and what rows say of it.

use super::command::{dump_catalogue, path_in, query_rows};
use super::rows::all_of_six;
use crate::common::*;

#[test]
fn a_stroke_that_is_not_reached_has_a_reason_and_no_place_in_the_front() {
    let folder = tempdir().unwrap();
    let file = path_in(&folder, "wide.db");
    let words = "catalog build --links 6 --input turn --symmetry generic --ideas 1 --widths 0..190 --quiet -o";
    stdout_of(&format!("{words} {file}"));
    let sql = "SELECT s.id, reached, shortfall, ends_closing, ends_opening, opening_min, opening_max, k.force_ratio, force_min, force_max, \
               s.id IN (SELECT id FROM front) AS front FROM structures s JOIN layouts l ON l.structure = s.id \
               JOIN strokes k ON k.structure = s.id";
    let all = query_rows(&file, sql);
    let mut short = 0;
    for row in &all {
        let number = |key: &str| row[key].as_f64().unwrap();
        let ends = !row["ends_closing"].is_null() || !row["ends_opening"].is_null();
        let whole = (number("opening_min"), number("opening_max")) == (0.0, 190.0);
        assert_eq!((row["reached"] == 1, ends), (whole, !whole), "{row}");
        assert!(whole || !row["shortfall"].is_null(), "{row}");
        assert!(row["shortfall"].is_null() || row["front"] == 0, "{row}");
        let ratio = number("force_max") / number("force_min");
        assert!((number("force_ratio") / ratio - 1.0).abs() < 1e-3, "{row}");
        assert!(!row["shortfall"].is_null() || ratio <= 3.001, "{row}");
        short += usize::from(!whole);
    }
    assert!(short > 0 && all.len() > 20, "{short} of {}", all.len());
    let id = all.iter().find(|r| r["reached"] == 0).unwrap()["id"].word();
    let shown = stdout_of(&["catalog", "show", &file, id]);
    has_all(
        &shown,
        &["Task: parts of 0 to 190 mm; ", "mm required: there"],
    );
}

/// What is made for force has more of it than what is made for looks, and does as much of the task; distances that are asked are kept.
#[test]
fn the_strongest_layouts_are_stronger() {
    let folder = tempdir().unwrap();
    let built = |name: &str, more: &str| {
        let file = path_in(&folder, name);
        let words = "catalog build --links 4 --input turn --ideas 0 --pin-distance 20 --reach 30 --quiet -o";
        stdout_of(&format!("{words} {file} {more}"));
        query_rows(
            &file,
            "SELECT force_min, shortfall, mechanism FROM layouts JOIN strokes USING (structure) ORDER BY structure",
        )
    };
    let (plain, strong) = (built("plain.db", ""), built("strong.db", "--aim force"));
    assert!(!plain.is_empty() && plain.len() == strong.len());
    for (a, b) in plain.iter().zip(&strong) {
        assert!(b["shortfall"].is_null(), "{b}");
        let [a, b] = [a, b].map(|r| r["force_min"].real());
        assert!(b > 1.2 * a, "{a} and {b}");
    }
    for row in &strong {
        let file: toml::Table = row["mechanism"].word().parse().unwrap();
        let places = |list: &str| {
            let all = file[list].as_array().unwrap().iter();
            let real = |x: &toml::Value| x.as_float().or(x.as_integer().map(|n| n as f64));
            // In thousandths of a millimetre.
            let thousandths = |x: &toml::Value| (1000.0 * real(x).unwrap()).round() as i64;
            let place = |p: &toml::Value| [0, 1].map(|k| thousandths(&p["point"][k]));
            all.map(place).collect::<Vec<[i64; 2]>>()
        };
        let (pins, tips) = (places("joint"), places("point"));
        assert!(
            pins.iter()
                .cartesian_product(&tips)
                .all(|(p, t)| t[0] - p[0] >= 30_000),
            "{pins:?}"
        );
        for (a, b) in pins.iter().tuple_combinations() {
            let apart = (a[0] - b[0]).pow(2) + (a[1] - b[1]).pow(2);
            assert!(apart >= 400_000_000, "{pins:?}");
        }
    }
}

/// Layouts are made for the force that is asked: what a default task leaves weak is laid out to pull as hard, with a longer travel.
#[test]
fn jaws_have_the_force_that_is_asked() {
    let folder = tempdir().unwrap();
    let built = |name: &str, more: &str| {
        let file = path_in(&folder, name);
        let words = "catalog build --classics --input slide --widths 30..50 --ideas 0 --quiet -o";
        stdout_of(&format!("{words} {file} {more}"));
        query_rows(
            &file,
            "SELECT id, least_force, travel, shortfall FROM grippers WHERE input = 'slide' ORDER BY id",
        )
    };
    let (usual, asked) = (
        built("usual.db", ""),
        built("asked.db", "--least-force 0.7"),
    );
    let force = |r: &Value| r["least_force"].real();
    let strong = |all: &[Value]| all.iter().filter(|r| force(r) >= 0.7).count();
    assert!(strong(&usual) * 4 < usual.len(), "{usual:?}");
    assert!(strong(&asked) * 4 > asked.len() * 3, "{asked:?}");
    for row in &asked {
        // As both are rounded to four digits.
        assert!(!row["shortfall"].is_null() || force(row) >= 0.699, "{row}");
        let said = row["shortfall"].as_str().unwrap_or("");
        assert!(
            !said.contains("where 0.7 N are asked") || force(row) < 0.7,
            "{row}"
        );
        // Work in is work out: two jaws over 20 mm of opening.
        assert!(row["travel"].real() >= 0.999 * 20.0 * force(row), "{row}");
    }
}

#[test]
fn the_column_of_jaws_names_the_motion_of_each_jaw() {
    let sql =
        "SELECT jaws, jaw_a_motion, jaw_b_motion FROM grippers JOIN layouts ON structure = id";
    let mut mixed = 0;
    for row in query_rows(all_of_six(), sql) {
        let [jaws, a, b] =
            ["jaws", "jaw_a_motion", "jaw_b_motion"].map(|key| row[key].as_str().unwrap());
        let names = BTreeSet::from([a, b]);
        assert_eq!(jaws.split(" and ").collect::<BTreeSet<_>>(), names, "{row}");
        mixed += usize::from(names.len() > 1);
    }
    assert!(mixed > 0);
}

/// Every filter against a look at all rows.
#[test]
fn filters_leave_what_is_as_good() {
    let file = all_of_six();
    let all = query_rows(
        file,
        "SELECT *, id IN (SELECT id FROM front) AS front FROM grippers",
    );
    let ids =
        |of: Vec<Value>| -> BTreeSet<String> { of.iter().map(|r| r["id"].to_string()).collect() };
    let mut cutting = 0;
    for [words, condition] in read_cases::<2>(
        "
        --least-force 0.8 | least_force >= 0.8
        --force-ratio 1.7 | force_ratio <= 1.7
        --turn 15 | turn <= 15
        --transmission 25 | transmission >= 25
        --cost 6 | cost <= 6
        --does-task | shortfall IS NULL
        --front | id IN (SELECT id FROM front)
        --turn 20 --transmission 20 | turn <= 20 AND transmission >= 20
        ",
    ) {
        let kept = ids(query_rows(
            file,
            &format!("SELECT id FROM grippers WHERE {condition}"),
        ));
        assert_eq!(ids(filtered(file, words)), kept, "{words}");
        cutting += usize::from(!kept.is_empty() && kept.len() < all.len());
    }
    assert!(cutting > 6, "{cutting}");
    assert_eq!(
        run_full(&["catalog", "query", file, "SELECT 1", "--front"]).0,
        Some(2)
    );
}

fn filtered(file: &str, filters: &str) -> Vec<Value> {
    let found = run_json(&format!("catalog query {file} --format json {filters}"));
    found.list().clone()
}

/// What does the task comes first, then the best of what is asked; forces are told by the input, and heads have units.
#[test]
fn answers_are_sorted_by_what_is_asked() {
    let file = all_of_six();
    for (filters, key, more_is_better) in [
        ("", "links", false),
        ("--transmission 1", "transmission", true),
        ("--turn 90", "turn", false),
    ] {
        let found = filtered(file, filters);
        let does = |r: &&Value| r["does_task"] == "yes";
        assert!(found.iter().is_sorted_by_key(|r| !does(&r)), "{filters}");
        assert!(found.len() > 20, "{filters}");
        let mut order = found
            .iter()
            .filter(does)
            .map(|r| r[key].real())
            .collect_vec();
        if more_is_better {
            order.reverse();
        }
        assert!(order.is_sorted(), "{filters}");
        for row in &found {
            let slides = row["input"] == "slide";
            assert_eq!(row["force_per_newton"].is_null(), !slides, "{row}");
            assert_eq!(row["force_per_newton_metre"].is_null(), slides, "{row}");
        }
    }
    // Forces for 1 N and for 1 Nm are two lists, each from the greatest to the least.
    let found = filtered(file, "--least-force 0.1 --does-task");
    let turns = |r: &&Value| r["input"] == "turn";
    assert!(found.iter().is_sorted_by_key(|r| turns(&r)));
    for column in ["force_per_newton", "force_per_newton_metre"] {
        let own = found.iter().filter(|r| !r[column].is_null());
        let own = own.map(|r| -r[column].real()).collect_vec();
        assert!(own.len() > 10 && own.is_sorted(), "{column}");
    }
    let told = stdout_of(&["catalog", "query", file]);
    has_all(
        &told,
        &[
            "known as",
            "These are 25 of ",
            "force [N/N]",
            "force [N/Nm]",
            "transmission [°]",
            "does task",
        ],
    );
}

/// Where nothing holds all bounds, each that is in the way is named with what there is without it, and how near that comes.
#[test]
fn an_empty_answer_says_what_is_in_the_way() {
    let file = all_of_six();
    let greatest = |input: &str| {
        let sql = format!(
            "SELECT max(least_force) AS most FROM grippers WHERE turn <= 30 AND input = '{input}'"
        );
        query_rows(file, &sql)[0]["most"].real()
    };
    let count = query_rows(file, "SELECT count(*) AS n FROM grippers WHERE turn <= 30");
    let (code, _, told) = run_full(&format!(
        "catalog query {file} --least-force 1000 --turn 30"
    ));
    assert_eq!(code, Some(1));
    let (_, best) = told
        .split_once(&format!("without --least-force 1000: {}; ", count[0]["n"]))
        .unwrap_or_else(|| panic!("{told}"));
    let best = best.lines().next().unwrap().split("; ");
    let drives = [("1 N of a sliding", "slide"), ("1 Nm of a turning", "turn")];
    for (said, (words, input)) in best.zip_eq(drives) {
        let most = said
            .strip_prefix(&format!("the greatest least force for {words} drive is "))
            .unwrap_or_else(|| panic!("{told}"));
        let exact = greatest(input);
        near(most.parse().unwrap(), exact, 1e-3 * exact);
    }
    // The turn alone is not: without it there is none, either.
    assert!(!told.contains("without --turn"), "{told}");
    let (_, _, told) = run_full(&format!(
        "catalog query {file} --least-force 1000 --price 0"
    ));
    has(&told, "two or more of them");
}

/// A file and options ask for the same, and another task is another catalogue.
#[test]
fn a_task_is_a_table_and_options() {
    let folder = tempdir().unwrap();
    let [spec, one, two] = ["task.toml", "1.db", "2.db"].map(|n| path_in(&folder, n));
    let text = "links = \"4\"\nideas = 1\n[task]\nnarrowest = 10\nwidest = 40\ngrip = \"inside\"\nmotion = \"swinging\"\nforce_ratio = 2\nroom = [200, 150]\n";
    fs::write(&spec, text).unwrap();
    stdout_of(&format!("catalog build --spec {spec} --quiet -o {one}"));
    let words = "catalog build --links 4 --ideas 1 --widths 10..40 --grip inside --motion swinging --force-ratio 2 --room 200x150 --quiet -o";
    stdout_of(&format!("{words} {two}"));
    assert_eq!(dump_catalogue(&one), dump_catalogue(&two));
    assert_fails(
        &format!("catalog build --links 4 --ideas 1 -o {one}"),
        "differs",
    );
    for [text, says] in read_cases::<2>(
        r#"
        [task]\nnarrowest = 60 | task.toml:2: narrowest must be at least a millimetre less
        [task]\nwidest = 500 | task.toml:2: widest must be from 1 to 200
        [task]\nforce_ratio = 0.5 | force_ratio must be from 1
        [task]\ngrip = "above" | line 2
        [task]\nfriction = { coefficient = -1 } | coefficient must be
        [task]\ncolour = 1 | colour
        [task]\nroom = [200, 150, 100] | 3 values; write 2
        [workload]\nclosing = -1 | task.toml:2: closing must be from 0
        [workload]\nclosing = 0\npart = 0 | nothing acts on the gripper
        [workload]\npart = 1\ngravity = [0, 2000, 0] | task.toml:3: gravity
        [workload]\ngravity = [0, 1] | line 2
        [workload]\nweight = 1 | weight
        "#,
    ) {
        fs::write(&spec, text).unwrap();
        assert_fails(
            &format!(
                "catalog build --spec {spec} -o {}",
                path_in(&folder, "no.db")
            ),
            says,
        );
    }
}

/// In a hole the part pushes the jaws inward, the drive goes the other way to hold, and the force is as large.
#[test]
fn parts_are_held_from_inside_by_the_other_way() {
    let folder = tempdir().unwrap();
    let built = |side: &str, pushes: f64| -> Vec<Value> {
        let file = path_in(&folder, &format!("{side}.db"));
        stdout_of(&format!(
            "catalog build --links 6 --symmetry mirror --ideas 1 --grip {side} --quiet -o {file}"
        ));
        let sql = "SELECT closes, force_min, tip_a_dx, tip_a_dy, mechanism FROM layouts ORDER BY structure";
        let all = query_rows(&file, sql);
        for row in &all {
            let m = read(row["mechanism"].word());
            let up = m.loads.forces.iter().find(|f| to_vector(&f.point)[1] > 0.0);
            assert_eq!(to_vector(&up.unwrap().force)[1], pushes);
        }
        all
    };
    let (outside, inside) = (built("outside", 100.0), built("inside", -100.0));
    assert!(!outside.is_empty() && outside.len() == inside.len());
    for (a, b) in outside.iter().zip(&inside) {
        assert_eq!(a["force_min"], b["force_min"]);
        for key in ["closes", "tip_a_dx", "tip_a_dy"] {
            assert_eq!(a[key].real(), -b[key].real(), "{key}");
        }
    }
}
