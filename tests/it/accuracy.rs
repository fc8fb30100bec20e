//! The survey of the methods, and where the naive formulas fail.

use crate::common::quick_accuracy;
use ozols::accuracy::AnswerVerdict;
use ozols::accuracy::pictures;
use ozols::accuracy::stability::change::Noise;
use ozols::accuracy::stability::close::{DrawnNumbers, SpecialPair};
use ozols::accuracy::stability::shaky::toggles;
use ozols::accuracy::stability::special::SpecialKind;
use ozols::accuracy::survey::{Reply, Survey, cases};
use ozols::accuracy::timing::Stopwatch;
use ozols::accuracy::tuned::tolerances;
use ozols::builtin;
use ozols::closure::Closure;
use ozols::file::text::mechanism_from_str;
use ozols::geom::Reals;
use ozols::model::mechanism::StateId;
use ozols::rank::method::registry;
use ozols::rank::numeric::Elimination;
use std::sync::LazyLock;
use std::time::Duration;

pub(crate) static SURVEY: LazyLock<Survey> = LazyLock::new(|| {
    // Verdicts do not depend on the clock, so one that stands still will do.
    let watch = Stopwatch {
        clock: || Duration::ZERO,
        repeat: 1,
    };
    Survey::new(&builtin::all(), watch, &mut |_, _| {}).unwrap()
});

fn index(name: &str) -> usize {
    registry::ALL.iter().position(|m| m.name() == name).unwrap()
}

fn reply(case: &str, method: &str) -> &'static Reply {
    let n = SURVEY.cases.iter().position(|c| c.name() == case).unwrap();
    &SURVEY.replies[n][index(method)]
}

#[test]
fn finite_auto_and_modular_are_right_everywhere() {
    assert!(cases(&builtin::all()).unwrap().len() >= 117);
    let mut wrong = Vec::new();
    for name in ["finite", "auto"] {
        for (case, r) in SURVEY.of_method(index(name)) {
            if r.verdict != AnswerVerdict::Right {
                wrong.push(format!("{name} on {}: {:?}", case.name(), r.answer));
            }
        }
    }
    for (case, r) in SURVEY.of_method(index("modular")) {
        if r.answer.as_ref().unwrap().mobility != case.truth.instantaneous {
            wrong.push(format!("modular on {}: {:?}", case.name(), r.answer));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn each_naive_formula_fails_where_it_is_known_to() {
    for (case, method, says, by) in [
        ("bennett", "count", -2, -3),
        ("parallelogram-3-rods", "count-planar", 0, -1),
        ("3-crr", "loops", 2, -1),
        ("bennett", "generic", 0, -1),
    ] {
        let r = reply(case, method);
        assert_eq!(
            r.answer.as_ref().unwrap().mobility,
            says,
            "{method} on {case}"
        );
        assert_eq!(r.verdict, AnswerVerdict::Wrong(by), "{method} on {case}");
    }
}

/// Cases in which one decomposition after another, of each J anew, finds the finite mobility at a tolerance.
fn right_at(method: Elimination, tolerance: f64) -> usize {
    let right = |case: &&ozols::accuracy::survey::Case| {
        let closure = Closure::new(&Reals, &case.mechanism, case.state).unwrap();
        let rank = method.rank(&closure, tolerance).map(|r| r.rank);
        rank.is_ok_and(|r| {
            i64::try_from(closure.columns.len() - r).is_ok_and(|w| w == case.truth.finite)
        })
    };
    SURVEY.cases.iter().filter(right).count()
}

#[test]
fn no_tolerance_does_better_than_the_best() {
    assert_eq!(SURVEY.tuned.len(), Elimination::ALL.len());
    for (tuned, method) in SURVEY.tuned.iter().zip(Elimination::ALL) {
        assert_eq!(Elimination::of(registry::ALL[tuned.method]), Some(method));
        assert_eq!(right_at(method, tuned.tolerance), tuned.right);
        assert_eq!(
            right_at(method, method.default_tolerance()),
            tuned.right_by_default
        );
        let most = tolerances(1).into_iter().map(|t| right_at(method, t)).max();
        assert_eq!(most.unwrap().max(tuned.right_by_default), tuned.right);
    }
    // A coarse tolerance suits single precision least: 1e-6 finds what 1e-4 takes for zero.
    let single = SURVEY.tuned[0];
    assert!(single.right >= single.right_by_default + 10, "{single:?}");
}

#[test]
fn a_picture_parts_what_is_wrong_from_what_does_not_apply() {
    let answers = ozols::accuracy::pictures::answers(&SURVEY);
    let ends = |name: &str| -> Vec<f64> {
        let row = answers.rows.iter().find(|r| r.0 == name).unwrap();
        row.1.iter().map(|band| band.1 - band.0).collect()
    };
    for (m, method) in registry::ALL.iter().enumerate() {
        let s = SURVEY.standing(m);
        let counts = [s.right, s.pose, s.wrong(), SURVEY.cases.len() - s.applies];
        let counts = counts.into_iter().filter(|n| *n > 0).map(|n| n as f64);
        assert_eq!(ends(method.name()), counts.collect::<Vec<_>>());
        // Where a method does not answer it is not right, either.
        assert_eq!(s.share, s.right as f64 / SURVEY.cases.len() as f64);
    }
    assert!(answers.rows.iter().any(|r| r.0.starts_with("lu32 at ")));
}

/// Rows of a CSV text, the heads first.
fn rows(csv: &str) -> Vec<Vec<String>> {
    let mut rows = vec![vec![String::new()]];
    let mut quoted = false;
    for c in csv.chars() {
        let row = rows.last_mut().unwrap();
        match (c, quoted) {
            ('"', _) => quoted = !quoted,
            (',', false) => row.push(String::new()),
            ('\n', false) => rows.push(vec![String::new()]),
            _ => row.last_mut().unwrap().push(c),
        }
    }
    assert_eq!(rows.pop().unwrap(), [""], "the last line ends");
    let width = rows[0].len();
    assert!(rows.iter().all(|r| r.len() == width), "rows of one width");
    rows
}

fn run(args: &[&str]) -> String {
    let mut command = assert_cmd::Command::cargo_bin("ozols").unwrap();
    let out = command.args(args).assert().success();
    String::from_utf8(out.get_output().stdout.clone()).unwrap()
}

/// What does not depend on time.
fn verdicts(folder: &std::path::Path) -> Vec<(String, String)> {
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    let mut out: Vec<(String, String)> = [
        "answers.svg",
        "matrix.svg",
        "stability-distance.csv",
        "stability-scale.csv",
        "stability-noise.csv",
        "stability-rounded.csv",
        "stability-digits.csv",
        "stability-offsets.csv",
        "stability-tolerance.csv",
    ]
    .map(|n| (n.to_owned(), read(n)))
    .into();
    let survey = rows(&read("survey.csv"));
    // Three times and how often they were taken.
    let timeless: Vec<_> = survey.iter().map(|r| r[..r.len() - 4].join("|")).collect();
    out.push(("survey.csv".to_owned(), timeless.join("\n")));
    out
}

/// Below half a unit and from five units on nothing is wrong and sure; nearer ones are still taken away.
fn offsets_beyond_what_digits_allow_are_kept(csv: &[Vec<String>]) {
    let column = |name: &str| csv[0].iter().position(|h| h == name).unwrap();
    let (units, wrong) = (column("units"), column("wrong_and_sure"));
    for row in &csv[1..] {
        let u: f64 = row[units].parse().unwrap();
        assert!((0.5..5.0).contains(&u) || row[wrong] == "0", "{row:?}");
    }
}

/// Single precision as it stands does, where the unit of length is far too large or too small.
fn exact_ranks_do_not_depend_on_the_unit(csv: &[Vec<String>]) {
    let right = |method: &str, factor: &str| -> usize {
        let row = csv.iter().find(|r| r[0] == method && r[1] == factor);
        row.unwrap()[2].parse().unwrap()
    };
    for far in ["1e-6", "1e6"] {
        assert!(right("lu32", far) < right("lu32", "1e-3"), "{csv:?}");
        assert_eq!(right("modular", far), right("modular", "1e0"));
    }
}

/// Floating point at its best tolerance may beat what is on the front at its default.
#[test]
fn the_front_has_nobody_that_another_beats() {
    let places = pictures::places(&SURVEY);
    let tuned = SURVEY.tuned.iter().filter_map(pictures::tuned_name);
    for name in tuned {
        assert!(places.iter().any(|p| p.name == name), "{name}");
    }
    let front = pictures::pareto(&places);
    let beats = |a: &pictures::MethodPlace, b: &pictures::MethodPlace| {
        a.seconds <= b.seconds && a.share >= b.share && (a.seconds < b.seconds || a.share > b.share)
    };
    for p in &places {
        let beaten = places.iter().any(|q| beats(q, p));
        let on = front.iter().any(|q| q.name == p.name);
        // Of equal ones one is enough.
        let equal = front
            .iter()
            .any(|q| (q.seconds, q.share) == (p.seconds, p.share));
        assert!(if beaten { !on } else { equal }, "{}", p.name);
    }
}

/// The figures of the pairs follow from their construction; the exact ranks, which take fractions at their word, agree at
/// every digit, and double precision does not.
#[test]
fn pairs_made_from_a_seed_are_what_they_are_said_to_be() {
    let seed = std::env::var("OZOLS_FUZZ_SEED").map_or(11, |s| s.parse().unwrap());
    let mut lost = 0;
    for (i, pair) in SpecialPair::ALL.into_iter().cycle().take(25).enumerate() {
        let drawn = DrawnNumbers::new(pair, &mut Noise::new(seed, i));
        for off in [None, Some(2), Some(9), Some(16), Some(40)] {
            let text = drawn.text(off);
            let m =
                mechanism_from_str("close.toml", &text).unwrap_or_else(|e| panic!("{e}\n{text}"));
            let truth = pair.truth(off.is_some());
            for name in ["rational", "modular"] {
                let found = registry::by_name(name)
                    .unwrap()
                    .answer(&m, StateId::FREE)
                    .unwrap();
                assert_eq!(
                    found.mobility, truth.instantaneous,
                    "{name}, {off:?}:\n{text}"
                );
            }
            let found = registry::by_name("finite")
                .unwrap()
                .answer(&m, StateId::FREE);
            if let Ok(found) = found {
                assert_eq!(found.mobility, truth.finite, "{off:?}:\n{text}");
            }
            let svd = registry::by_name("svd")
                .unwrap()
                .answer(&m, StateId::FREE)
                .unwrap();
            lost += usize::from(off == Some(16) && svd.mobility != truth.instantaneous);
        }
    }
    // Parallel rods are the same at the pose.
    assert_eq!(lost, 20);
}

#[test]
fn rows_of_toggles_have_one_freedom_at_the_pose() {
    for levels in 1..=5 {
        let text = toggles(levels, &mut Noise::new(5, levels));
        let m = mechanism_from_str("toggles.toml", &text).unwrap();
        for name in ["rational", "svd"] {
            let found = registry::by_name(name)
                .unwrap()
                .answer(&m, StateId::FREE)
                .unwrap();
            assert_eq!(found.mobility, 1, "{name}:\n{text}");
        }
    }
}

#[test]
fn special_mechanisms_are_those_of_their_seed() {
    for kind in SpecialKind::ALL {
        let text = |seed| kind.text(3.0, 6, true, &mut Noise::new(seed, 0));
        assert_eq!(text(1), text(1));
        assert_ne!(text(1), text(2));
    }
}

#[test]
fn a_quick_run_writes_charts_whose_right_cells_are_right() {
    let folder = tempfile::tempdir().unwrap();
    let (said, at) = quick_accuracy();
    assert!(
        said.contains(&format!(
            "right of {}",
            cases(&builtin::all()).unwrap().len()
        )) && said.contains("Recommended default tolerance")
    );
    let mut svgs = 0;
    for entry in std::fs::read_dir(at).unwrap() {
        let path = entry.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        match path.extension().unwrap().to_str().unwrap() {
            "svg" => {
                roxmltree::Document::parse(&text).unwrap_or_else(|e| panic!("{path:?}: {e}"));
                svgs += 1;
            }
            "csv" => assert!(rows(&text).len() > 1, "{path:?}"),
            _ => assert!(path.ends_with("index.html") && text.ends_with("</html>\n")),
        }
    }
    assert!(svgs >= 10, "{svgs} pictures");

    let read = |name: &str| std::fs::read_to_string(at.join(name)).unwrap();
    offsets_beyond_what_digits_allow_are_kept(&rows(&read("stability-offsets.csv")));
    exact_ranks_do_not_depend_on_the_unit(&rows(&read("stability-scale.csv")));
    // Pairs and toggles: what is said for sure is right.
    for name in ["stability-close.csv", "stability-shaky.csv"] {
        let csv = rows(&read(name));
        let exact = csv[1..].iter().filter(|r| r[0] == "rational");
        let exact: Vec<_> = exact.collect();
        assert!(
            exact.len() >= 3 && exact.iter().all(|r| r[2] == r[3] && r[3] != "0"),
            "{name}"
        );
    }
    let survey = rows(&read("survey.csv"));
    let column = |name: &str| survey[0].iter().position(|h| h == name).unwrap();
    let (answer, finite, pose) = (
        column("answer"),
        column("expected_finite"),
        column("expected_instantaneous"),
    );
    let (verdict, quantity, error) = (column("verdict"), column("quantity"), column("error"));
    let mut right = 0;
    for row in &survey[1..] {
        let expected = if row[answer].is_empty() {
            "does not apply"
        } else if row[answer] == row[finite] {
            right += 1;
            "right"
        } else if row[quantity] == "instantaneous" && row[answer] == row[pose] {
            "right at the pose"
        } else {
            "wrong"
        };
        assert_eq!(row[verdict], expected, "{row:?}");
        // By how much what can move for good is missed, answers for the pose alone, too.
        let number = |of: usize| row[of].parse::<i64>().unwrap();
        let off = (!row[answer].is_empty()).then(|| (number(answer) - number(finite)).to_string());
        assert_eq!(row[error], off.unwrap_or_default(), "{row:?}");
    }
    // A tick is drawn for each right answer and for no other.
    let matrix = read("matrix.svg");
    let matrix = roxmltree::Document::parse(&matrix).unwrap();
    let ticks = matrix
        .descendants()
        .filter(|n| n.attribute("class") == Some("sign good"));
    assert_eq!(ticks.count(), right);

    let other = folder.path().join("other");
    run(&[
        "accuracy",
        "--quick",
        "--threads",
        "1",
        "-o",
        other.to_str().unwrap(),
    ]);
    for (one, two) in verdicts(at).into_iter().zip(verdicts(&other)) {
        assert!(one == two, "{} differs between runs", one.0);
    }
}

#[test]
fn without_a_folder_there_is_a_verdict_a_table_and_the_next_step() {
    let here = tempfile::tempdir().unwrap();
    let mut command = assert_cmd::Command::cargo_bin("ozols").unwrap();
    let out = command
        .current_dir(&here)
        .args(["accuracy", "--quick"])
        .assert()
        .success();
    let text = String::from_utf8(out.get_output().stdout.clone()).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let tuned = lines.iter().filter(|l| l.contains("its best tolerance"));
    let table = 2 + registry::ALL.len() + tuned.count();
    assert_eq!(lines.len(), 2 + table + 6, "{text}");
    // A time says nothing without the machine.
    let cores = std::thread::available_parallelism().unwrap();
    let machine = lines[2 + table + 1];
    assert!(machine.contains(&format!("of {cores} cores")), "{machine}");
    assert!(machine.contains(concat!("ozols ", env!("CARGO_PKG_VERSION"))));
    assert!(machine.contains("timed once"), "{machine}");
    assert!(lines[0].contains("cases of known mobility: the automatic choice is right on"));
    assert!(lines[2].trim_start().starts_with("method"), "{text}");
    assert_eq!(lines[2 + table + 4].trim(), "ozols accuracy -o accuracy");
    assert_eq!(std::fs::read_dir(&here).unwrap().count(), 0);
}
