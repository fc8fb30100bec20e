//! The task of a catalogue as a file and as options, the filters, and what rows say of it.

use super::command::at;
use super::rows::all_of_six;
use crate::common::*;

fn rows(file: &str, question: &[&str]) -> Vec<Value> {
    let words = ["catalog", "query", file, "--format", "json"];
    json(&[&words[..], question].concat())
        .as_array()
        .unwrap()
        .clone()
}

#[test]
fn a_stroke_that_is_not_reached_has_a_reason_and_no_place_in_the_front() {
    let folder = tempdir().unwrap();
    let file = at(&folder, "wide.db");
    let words = "catalog build --links 6 --input turn --symmetry generic --ideas 1 --widths 0..190 --quiet -o";
    ok(&words.split(' ').chain([file.as_str()]).collect::<Vec<_>>());
    let sql = "SELECT s.id, reached, shortfall, ends_closing, ends_opening, opening_min, opening_max, k.force_ratio, force_min, force_max, \
               s.id IN (SELECT id FROM front) AS front FROM structures s JOIN layouts l ON l.structure = s.id \
               JOIN strokes k ON k.structure = s.id";
    let all = rows(&file, &[sql]);
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
    let id = all.iter().find(|r| r["reached"] == 0).unwrap()["id"]
        .as_str()
        .unwrap();
    let shown = ok(&["catalog", "show", &file, id]);
    assert!(
        shown.contains("Task: parts of 0 to 190 mm; ") && shown.contains("is asked: there"),
        "{shown}"
    );
}

/// What is made for force has more of it than what is made for looks, and does as much of the task; distances that are asked are kept.
#[test]
fn the_strongest_layouts_are_stronger() {
    let folder = tempdir().unwrap();
    let built = |name: &str, more: &[&str]| {
        let file = at(&folder, name);
        let words = "catalog build --links 4 --input turn --ideas 0 --pin-distance 20 --reach 30 --quiet -o";
        let words: Vec<&str> = words.split(' ').chain([file.as_str()]).collect();
        ok(&[&words[..], more].concat());
        rows(
            &file,
            &[
                "SELECT force_min, shortfall, mechanism FROM layouts JOIN strokes USING (structure) ORDER BY structure",
            ],
        )
    };
    let force = |rows: &[Value]| {
        rows.iter()
            .map(|r| r["force_min"].as_f64().unwrap())
            .collect::<Vec<_>>()
    };
    let plain = built("plain.db", &[]);
    let strong = built("strong.db", &["--aim", "force"]);
    assert!(!plain.is_empty() && plain.len() == strong.len());
    assert!(
        strong.iter().all(|r| r["shortfall"].is_null()),
        "{strong:?}"
    );
    for (a, b) in force(&plain).iter().zip(force(&strong)) {
        assert!(b > 1.2 * a, "{a} and {b}");
    }
    for row in &strong {
        let file: toml::Table = row["mechanism"].as_str().unwrap().parse().unwrap();
        let places = |list: &str| {
            let all = file[list].as_array().unwrap().iter();
            let place = |p: &toml::Value| [0, 1].map(|k| p["point"][k].as_integer().unwrap());
            all.map(place).collect::<Vec<[i64; 2]>>()
        };
        let (pins, tips) = (places("joint"), places("point"));
        for (i, a) in pins.iter().enumerate() {
            assert!(tips.iter().all(|t| t[0] - a[0] >= 30), "{pins:?}");
            for b in &pins[..i] {
                let apart = (a[0] - b[0]).pow(2) + (a[1] - b[1]).pow(2);
                assert!(apart >= 400, "{pins:?}");
            }
        }
    }
    let wrong = |words: &[&str], says: &str| {
        let build = ["catalog", "build", "--links", "4", "-o", "none.db"];
        fails(&[&build[..], words].concat(), says);
    };
    wrong(&["--aim", "strong"], "none of balanced, force");
    wrong(&["--pulled-out", "0.5"], "pulled_out");
    wrong(&["--pin-distance=-1"], "pin_distance");
}

/// Layouts are made for the force that is asked: what a default task leaves weak is laid out to pull as hard, with a longer travel.
#[test]
fn jaws_have_the_force_that_is_asked() {
    let folder = tempdir().unwrap();
    let built = |name: &str, more: &[&str]| {
        let file = at(&folder, name);
        let words = "catalog build --classics --input slide --widths 30..50 --ideas 0 --quiet -o";
        let words: Vec<&str> = words.split(' ').chain([file.as_str()]).collect();
        ok(&[&words, more].concat());
        let sql = "SELECT id, least_force, travel, shortfall FROM grippers WHERE input = 'slide' ORDER BY id";
        rows(&file, &[sql])
    };
    let usual = built("usual.db", &[]);
    let asked = built("asked.db", &["--least-force", "0.7"]);
    let force = |r: &Value| r["least_force"].as_f64().unwrap();
    let strong = |all: &[Value]| all.iter().filter(|r| force(r) >= 0.7).count();
    assert!(strong(&usual) * 4 < usual.len(), "{usual:?}");
    assert!(strong(&asked) * 4 > asked.len() * 3, "{asked:?}");
    for row in &asked {
        // As both are rounded to four digits.
        assert!(!row["shortfall"].is_null() || force(row) >= 0.699, "{row}");
        let weak = row["shortfall"]
            .as_str()
            .is_some_and(|s| s.contains("where 0.7 N are asked"));
        assert!(!weak || force(row) < 0.7, "{row}");
        // Work in is work out: two jaws over 20 mm of opening.
        assert!(
            row["travel"].as_f64().unwrap() >= 0.999 * 20.0 * force(row),
            "{row}"
        );
    }
    let words = ["catalog", "build", "--least-force=-1", "-o", "x.db"];
    fails(&words, "least_force");
}

/// Every filter against a look at all rows.
#[test]
fn filters_leave_what_is_as_good() {
    let file = all_of_six();
    let all = rows(file, &["SELECT * FROM grippers"]);
    let front: BTreeSet<String> = rows(file, &["SELECT id FROM front"])
        .iter()
        .map(|r| r["id"].to_string())
        .collect();
    let number = |r: &Value, key: &str| r[key].as_f64().unwrap();
    type Keeps<'a> = Box<dyn Fn(&Value) -> bool + 'a>;
    let least = |key: &'static str, x: f64| -> Keeps<'_> { Box::new(move |r| number(r, key) >= x) };
    let most = |key: &'static str, x: f64| -> Keeps<'_> { Box::new(move |r| number(r, key) <= x) };
    let filters: Vec<(&[&str], Keeps<'_>)> = vec![
        (&["--least-force", "0.8"], least("least_force", 0.8)),
        (&["--force-ratio", "1.7"], most("force_ratio", 1.7)),
        (&["--turn", "15"], most("turn", 15.0)),
        (&["--transmission", "25"], least("transmission", 25.0)),
        (&["--cost", "6"], most("cost", 6.0)),
        (&["--does-task"], Box::new(|r| r["shortfall"].is_null())),
        (
            &["--front"],
            Box::new(|r| front.contains(&r["id"].to_string())),
        ),
        (
            &["--turn", "20", "--transmission", "20"],
            Box::new(|r| number(r, "turn") <= 20.0 && number(r, "transmission") >= 20.0),
        ),
    ];
    let mut cutting = 0;
    for (words, keeps) in &filters {
        let ids =
            |of: &[Value]| -> BTreeSet<String> { of.iter().map(|r| r["id"].to_string()).collect() };
        let kept: Vec<Value> = all.iter().filter(|r| keeps(r)).cloned().collect();
        let found = rows(file, words);
        assert_eq!(ids(&found), ids(&kept), "{words:?}");
        cutting += usize::from(!kept.is_empty() && kept.len() < all.len());
    }
    assert!(cutting > 6, "{cutting}");
    let both = run(&["catalog", "query", file, "SELECT 1", "--front"]);
    assert_eq!(both.status.code(), Some(2));
}

/// What does the task comes first, then the best of what is asked; forces are told by the input, and heads have units.
#[test]
fn answers_are_sorted_by_what_is_asked() {
    let file = all_of_six();
    for words in [&[][..], &["--transmission", "1"], &["--turn", "90"]] {
        let found = rows(file, words);
        let does: Vec<bool> = found.iter().map(|r| r["does_task"] == "yes").collect();
        assert!(does.is_sorted_by(|a, b| a >= b), "{words:?}");
        assert!(found.len() > 20, "{words:?}");
        let of = |key: &str| -> Vec<f64> {
            let first = found.iter().filter(|r| r["does_task"] == "yes");
            first.map(|r| r[key].as_f64().unwrap()).collect()
        };
        match words.first() {
            Some(&"--turn") => assert!(of("turn").is_sorted()),
            Some(_) => assert!(of("transmission").is_sorted_by(|a, b| a >= b)),
            None => assert!(of("links").is_sorted()),
        }
        for row in &found {
            let slides = row["input"] == "slide";
            assert_eq!(row["force_per_newton"].is_null(), !slides, "{row}");
            assert_eq!(row["force_per_newton_metre"].is_null(), slides, "{row}");
        }
    }
    let told = ok(&["catalog", "query", file]);
    for head in [
        "force [N/N]",
        "force [N/Nm]",
        "transmission [°]",
        "does task",
    ] {
        assert!(told.contains(head), "{told}");
    }
}

/// Where nothing holds all bounds, each that is in the way is named with what there is without it, and how near that comes.
#[test]
fn an_empty_answer_says_what_is_in_the_way() {
    let file = all_of_six();
    let greatest = "SELECT count(*) AS n, max(least_force) AS most FROM grippers WHERE turn <= 30";
    let greatest = &rows(file, &[greatest])[0];
    let o = run(&format!(
        "catalog query {file} --least-force 1000 --turn 30"
    ));
    assert_eq!(o.status.code(), Some(1));
    let told = text(&o.stderr);
    let line = told
        .lines()
        .find(|l| l.contains("without --least-force 1000"));
    let line = line.unwrap_or_else(|| panic!("{told}"));
    let (count, most) = line.split_once("; the greatest least force is ").unwrap();
    assert_eq!(
        count.trim(),
        format!("without --least-force 1000: {}", greatest["n"])
    );
    let most: f64 = most.parse().unwrap();
    let exact = greatest["most"].as_f64().unwrap();
    assert!((most / exact - 1.0).abs() < 1e-3, "{most} {exact}");
    // The turn alone is not: without it there is none, either.
    assert!(!told.contains("without --turn"), "{told}");
    let o = run(&format!(
        "catalog query {file} --least-force 1000 --price 0"
    ));
    assert!(text(&o.stderr).contains("two or more of them"), "{o:?}");
}

/// A file and options ask for the same, and another task is another catalogue.
#[test]
fn a_task_is_a_table_and_options() {
    let folder = tempdir().unwrap();
    let (spec, one, two) = (
        at(&folder, "task.toml"),
        at(&folder, "1.db"),
        at(&folder, "2.db"),
    );
    let text = "links = \"4\"\nideas = 1\n[task]\nnarrowest = 10\nwidest = 40\ngrip = \"inside\"\nmotion = \"swinging\"\nforce_ratio = 2\nroom = [200, 150]\n";
    fs::write(&spec, text).unwrap();
    ok(&["catalog", "build", "--spec", &spec, "--quiet", "-o", &one]);
    let words = "catalog build --links 4 --ideas 1 --widths 10..40 --grip inside --motion swinging --force-ratio 2 --room 200x150 --quiet -o";
    let words: Vec<&str> = words.split(' ').chain([two.as_str()]).collect();
    ok(&words);
    assert_eq!(super::command::whole(&one), super::command::whole(&two));
    fails(
        &format!("catalog build --links 4 --ideas 1 -o {one}"),
        "differs",
    );
    for (line, says) in [
        ("narrowest = 60", "task.toml:2: narrowest must be less"),
        ("widest = 500", "task.toml:2: widest must be from 1 to 200"),
        ("force_ratio = 0.5", "force_ratio must be from 1"),
        ("grip = \"above\"", "line 2"),
        ("friction = { coefficient = -1 }", "coefficient must be"),
        ("colour = 1", "colour"),
        ("room = [200, 150, 100]", "3 values; write 2"),
    ] {
        fs::write(&spec, format!("[task]\n{line}\n")).unwrap();
        fails(
            &format!("catalog build --spec {spec} -o {}", at(&folder, "no.db")),
            says,
        );
    }
    for (words, says) in [
        (["--widths", "50"], "such as 0..50"),
        (["--grip", "above"], "none of outside, inside"),
        (["--room", "9"], "such as 180x120"),
    ] {
        fails(
            &[
                &["catalog", "build", "-o", &at(&folder, "no.db")],
                &words[..],
            ]
            .concat(),
            says,
        );
    }
}

/// In a hole the part pushes the jaws inward, the drive goes the other way to hold, and the force is as large.
#[test]
fn parts_are_held_from_inside_by_the_other_way() {
    let folder = tempdir().unwrap();
    let built = |side: &str| -> (Vec<Value>, Vec<f64>) {
        let file = at(&folder, &format!("{side}.db"));
        let words = [
            "catalog",
            "build",
            "--links",
            "6",
            "--symmetry",
            "mirror",
            "--ideas",
            "1",
            "--grip",
            side,
            "--quiet",
            "-o",
        ];
        ok(&[&words[..], &[&file]].concat());
        let all = rows(
            &file,
            &[
                "SELECT structure, closes, force_min, tip_a_dx, tip_a_dy FROM layouts ORDER BY structure",
            ],
        );
        let pushes = all.iter().map(|row| {
            let toml = at(&folder, "m.toml");
            ok(&[
                "catalog",
                "export",
                &file,
                row["structure"].as_str().unwrap(),
                "-o",
                &toml,
            ]);
            let m = ozols::open(&toml).unwrap();
            let up = m
                .loads
                .forces
                .iter()
                .find(|f| real(&f.point)[1] > 0.0)
                .unwrap();
            real(&up.force)[1]
        });
        let pushes = pushes.collect();
        (all, pushes)
    };
    let ((out, from_outside), (inn, from_inside)) = (built("outside"), built("inside"));
    assert!(!out.is_empty() && out.len() == inn.len());
    for (a, b) in out.iter().zip(&inn) {
        let number = |r: &Value, key: &str| r[key].as_f64().unwrap();
        assert_eq!(number(a, "force_min"), number(b, "force_min"));
        for key in ["closes", "tip_a_dx", "tip_a_dy"] {
            assert_eq!(number(a, key), -number(b, key), "{key}");
        }
    }
    assert!(from_outside.iter().all(|y| *y == 100.0), "{from_outside:?}");
    assert!(from_inside.iter().all(|y| *y == -100.0), "{from_inside:?}");
}
