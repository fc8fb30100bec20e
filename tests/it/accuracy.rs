//! The survey of the methods, and where the naive formulas fail.

use crate::common::*;
use ozols::accuracy::AnswerVerdict;
use ozols::accuracy::lattice::toggle_row;
use ozols::accuracy::survey::{Survey, built_in_cases, generated_cases};
use ozols::accuracy::timing::Stopwatch;
use ozols::rank::numeric::Elimination;

pub(crate) static SURVEY: LazyLock<Survey> = LazyLock::new(|| {
    // Verdicts do not depend on the clock, so one that stands still will do.
    let watch = Stopwatch {
        clock: || Duration::ZERO,
        repeat: 1,
    };
    Survey::new(
        built_in_cases(&builtin::all()).unwrap(),
        watch,
        &mut |_, _| {},
    )
});

fn index(name: &str) -> usize {
    registry::ALL.iter().position(|m| m.name() == name).unwrap()
}

#[test]
fn finite_auto_and_modular_are_right_everywhere() {
    assert!(built_in_cases(&builtin::all()).unwrap().len() >= 117);
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

/// Returns the number of turned and rounded cases in which a decomposition of J, made anew, has the mobility at the pose.
fn right_when_rounded(decimals: usize) -> usize {
    let cases: Vec<_> = SURVEY.cases.iter().step_by(4).enumerate().collect();
    let right = |(n, case): &&(usize, &ozols::accuracy::survey::Case)| {
        let m = turned_and_rounded(&case.mechanism, decimals, &mut Noise::new(1, *n));
        let closure = Closure::new(&Reals, &m, case.state).unwrap();
        let method = Elimination::Svd;
        let rank = method.rank_of_closure(&closure, method.default_tolerance());
        let free = |r: usize| i64::try_from(closure.columns.len() - r).unwrap();
        rank.is_ok_and(|r| free(r.rank) == case.truth.instantaneous)
    };
    cases.iter().filter(right).count()
}

/// Singular values of rounded files are those of decompositions made anew; auto is never wrong and sure.
fn rounded_files_are_counted(csv: &[Vec<String>]) {
    for row in &csv[1..] {
        let decimals = row[1].parse::<f64>().unwrap() as usize;
        if row[0] == "svd" {
            assert_eq!(row[3], right_when_rounded(decimals).to_string(), "{row:?}");
        }
        assert!(row[0] != "auto" || row[6] == "0", "{row:?}");
    }
    assert_eq!(csv.len(), 1 + 4 * 4);
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

/// What does not depend on time.
fn verdicts(folder: &std::path::Path) -> Vec<(String, String)> {
    let read = |name: &str| fs::read_to_string(folder.join(name)).unwrap();
    let mut out: Vec<(String, String)> = [
        "stability-distance.csv",
        "stability-digits.csv",
        "stability-rounded.csv",
        "stability-scale.csv",
        "stability-shaky.csv",
        "stability-first-idea.csv",
        "stability-dead-point.csv",
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
    let (offset, wrong) = (column("offset"), column("wrong_and_sure"));
    for row in &csv[1..] {
        let decimals: i32 = row[0].strip_suffix(" decimals").unwrap().parse().unwrap();
        let offset: f64 = row[offset].parse().unwrap();
        let units = 2.0 * offset * 10f64.powi(decimals);
        assert!((0.5..4.9).contains(&units) || row[wrong] == "0", "{row:?}");
    }
}

/// Single precision as it stands does, where the unit of length is far too large or too small.
fn exact_ranks_do_not_depend_on_the_unit(csv: &[Vec<String>]) {
    let right = |method: &str, factor: &str| -> usize {
        let row = csv.iter().find(|r| r[0] == method && r[1] == factor);
        row.unwrap()[3].parse().unwrap()
    };
    for far in ["1e-6", "1e6"] {
        assert!(right("lu32", far) < right("lu32", "1e-3"), "{csv:?}");
        assert_eq!(right("modular", far), right("modular", "1e0"));
    }
}

/// Far from a dead point twelve digits are right, near it fewer, and none that is wrong goes without a warning.
fn reactions_lose_digits_with_a_warning(csv: &[Vec<String>]) {
    let right = |digits: &str, height: &str| -> usize {
        let row = csv.iter().find(|r| r[0] == digits && r[1] == height);
        row.unwrap()[3].parse().unwrap()
    };
    assert!(csv[1..].iter().all(|r| r[6] == "0"), "{csv:?}");
    assert_eq!(right("12 digits", "1e-3"), 4);
    assert_eq!(right("6 digits", "1e-12"), 0);
    for height in ["1e-15", "1e-12", "1e-9", "1e-6", "1e-3"] {
        assert!(right("6 digits", height) >= right("12 digits", height));
    }
}

/// The least rows have the rank and the counts of all rows.
fn models_agree(csv: &[Vec<String>]) {
    let all = |name: &str| -> usize {
        let of = csv[1..].iter().filter(|r| r[0] == name);
        let cases = of.map(|r| {
            assert_eq!(r[2], r[3], "{r:?}");
            r[2].parse::<usize>().unwrap()
        });
        cases.sum()
    };
    for scene in ["plane", "in and out of a plane", "sphere", "space"] {
        assert_eq!(all(scene), 32);
    }
    assert!(all("built-in mechanisms") > 100);
}

/// The first of ten ideas is one of them, and the more costs move the less often it stays.
fn first_ideas_move_with_costs(csv: &[Vec<String>]) {
    let right = |name: &str| -> Vec<usize> {
        let of = csv.iter().filter(|r| r[0] == name);
        of.map(|r| r[3].parse().unwrap()).collect()
    };
    let first = right("first by cost stays first");
    let ten = right("first by cost stays among ten");
    assert!(
        first.len() == 2 && first[0] >= first[1] && first[1] > 0,
        "{csv:?}"
    );
    assert!(first.iter().zip(&ten).all(|(one, ten)| one <= ten));
}

/// Small primes divide minors, more of them the smaller they are, and those of the program none.
fn errors_fall_with_the_prime(csv: &[Vec<String>]) {
    let wrong = |bits: &str| -> usize {
        let of = csv
            .iter()
            .filter(|r| r[0] == "random points" && r[1] == bits);
        of.map(|r| r[6].parse::<usize>().unwrap()).sum()
    };
    assert!(wrong("8e0") > wrong("1.2e1"), "{csv:?}");
    assert_eq!(wrong("6.1e1"), 0);
    let all = csv[1..].iter().filter(|r| r[1] == "6.1e1");
    assert!(all.clone().count() == 3 && all.clone().all(|r| r[6] == "0"));
}

/// The figures of what is made from a seed follow from its construction; what is decided about it agrees.
#[test]
fn mechanisms_made_from_a_seed_are_what_they_are_said_to_be() {
    let seed = std::env::var("OZOLS_FUZZ_SEED").map_or(11, |s| s.parse().unwrap());
    let made = generated_cases(seed);
    assert!(made.len() >= 30);
    let watch = Stopwatch {
        clock: || Duration::ZERO,
        repeat: 1,
    };
    let survey = Survey::new(made, watch, &mut |_, _| {});
    for (case, reply) in survey.of_method(index("auto")) {
        // Of what is shaky it may leave a range.
        let shaky = case.truth.instantaneous != case.truth.finite;
        let wrong = matches!(reply.verdict, AnswerVerdict::Wrong(_));
        assert!(shaky || !wrong, "{}: {:?}", case.name(), reply.answer);
    }
    // With every digit at its word what is rounded is rigid.
    let modular = survey.record_of(index("modular"));
    assert!(modular.right < survey.record_of(index("auto")).right);
}

#[test]
fn rows_of_toggles_have_one_freedom_at_the_pose() {
    for levels in 1..=5 {
        let text = toggle_row(levels, &mut Noise::new(5, levels));
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
fn a_quick_run_writes_a_chart_and_a_table_of_each_study() {
    let folder = tempdir().unwrap();
    let (said, at) = quick_accuracy();
    assert!(
        said.contains(&format!(
            "right of {}",
            built_in_cases(&builtin::all()).unwrap().len()
        )) && said.contains("Size of the prime: ")
    );
    let mut svgs = 0;
    for entry in fs::read_dir(at).unwrap() {
        let path = entry.unwrap().path();
        let text = fs::read_to_string(&path).unwrap();
        match path.extension().unwrap().to_str().unwrap() {
            "svg" => {
                roxmltree::Document::parse(&text).unwrap_or_else(|e| panic!("{path:?}: {e}"));
                svgs += 1;
            }
            "csv" => assert!(rows(&text).len() > 1, "{path:?}"),
            _ => assert!(path.ends_with("index.html") && text.ends_with("</html>\n")),
        }
    }
    assert_eq!(svgs, 12);

    let read = |name: &str| fs::read_to_string(at.join(name)).unwrap();
    offsets_beyond_what_digits_allow_are_kept(&rows(&read("stability-digits.csv")));
    exact_ranks_do_not_depend_on_the_unit(&rows(&read("stability-scale.csv")));
    errors_fall_with_the_prime(&rows(&read("stability-prime.csv")));
    rounded_files_are_counted(&rows(&read("stability-rounded.csv")));
    models_agree(&rows(&read("stability-model.csv")));
    reactions_lose_digits_with_a_warning(&rows(&read("stability-dead-point.csv")));
    first_ideas_move_with_costs(&rows(&read("stability-first-idea.csv")));
    // Displaced ones and toggles: exact ranks are right about all of them.
    for name in ["stability-distance.csv", "stability-shaky.csv"] {
        let csv = rows(&read(name));
        let exact = csv[1..].iter().filter(|r| r[0] == "modular");
        let exact: Vec<_> = exact.collect();
        let right = |r: &&Vec<String>| r[2] == r[3] && r[2] != "0";
        assert!(exact.len() >= 3 && exact.iter().all(right), "{name}");
    }
    // Each table stands beside its chart, and the page says how it was made.
    let page = read("index.html");
    for part in [
        "href=\"stability-digits.csv\"",
        "ozols accuracy --quick --seed",
        "What to do: ",
    ] {
        assert!(page.contains(part), "{part}");
    }
    let survey = rows(&read("survey.csv"));
    let column = |name: &str| survey[0].iter().position(|h| h == name).unwrap();
    let (answer, finite, pose) = (
        column("answer"),
        column("expected_finite"),
        column("expected_instantaneous"),
    );
    let (verdict, quantity, error) = (column("verdict"), column("quantity"), column("error"));
    for row in &survey[1..] {
        let expected = if row[answer].is_empty() {
            "does not apply"
        } else if row[answer] == row[finite] {
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
    let other = folder.path().join("other");
    run_quiet(&format!(
        "accuracy --quick --threads 1 -o {}",
        other.display()
    ));
    for (one, two) in verdicts(at).into_iter().zip(verdicts(&other)) {
        assert!(one == two, "{} differs between runs", one.0);
    }
}

#[test]
fn without_a_folder_there_is_a_verdict_a_table_and_the_next_step() {
    let here = tempdir().unwrap();
    let mut command = assert_cmd::Command::cargo_bin("ozols").unwrap();
    let out = command
        .current_dir(&here)
        .args(["accuracy", "--quick"])
        .assert()
        .success();
    let text = String::from_utf8(out.get_output().stdout.clone()).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let table = 2 + registry::ALL.len();
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
    assert_eq!(fs::read_dir(&here).unwrap().count(), 0);
}
