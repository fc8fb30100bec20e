//! The survey of the methods, and where the naive formulas fail.

use crate::common::*;
use ozols::accuracy::AnswerVerdict;
use ozols::accuracy::survey::{Survey, built_in_cases, generated_cases};
use ozols::accuracy::timing::Stopwatch;
use std::collections::HashMap;

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

/// A row of a table by the names of its columns.
type Row = HashMap<String, String>;

fn rows(csv: &str) -> Vec<Row> {
    let reader = csv::Reader::from_reader(csv.as_bytes());
    reader.into_deserialize().map(Result::unwrap).collect()
}

fn number<T: std::str::FromStr<Err: std::fmt::Debug>>(row: &Row, column: &str) -> T {
    row[column].parse().unwrap()
}

/// The tables of a run.
struct Tables<'f>(&'f Path);

impl Tables<'_> {
    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.0.join(name)).unwrap()
    }

    fn study(&self, name: &str) -> Vec<Row> {
        rows(&self.read(&format!("stability-{name}.csv")))
    }

    /// Returns the sum of a column over the rows of a study that are asked this, with this beside it where something is said.
    fn sum(&self, study: &str, asked: &str, beside: (&str, &str), column: &str) -> usize {
        let is_one =
            |r: &&Row| r["asked"] == asked && (beside.0.is_empty() || r[beside.0] == beside.1);
        let all = self.study(study);
        let found = all
            .iter()
            .filter(is_one)
            .map(|r| number::<usize>(r, column))
            .collect_vec();
        assert!(!found.is_empty(), "{study}: {asked} {beside:?}");
        found.iter().sum()
    }

    /// What does not depend on time.
    fn verdicts(&self) -> Vec<String> {
        let names = split_words("distance digits rounded scale shaky first-idea dead-point");
        let studies = names
            .iter()
            .map(|n| self.read(&format!("stability-{n}.csv")));
        let mut survey = rows(&self.read("survey.csv"));
        for row in &mut survey {
            for time in split_words("median_seconds least_seconds most_seconds repeats") {
                row.remove(time).unwrap();
            }
        }
        let survey = survey
            .into_iter()
            .map(|r| format!("{:?}", r.into_iter().sorted().collect_vec()));
        studies.chain(survey).collect()
    }
}

/// What the studies have to show, whatever the machine.
fn studies_agree(t: &Tables<'_>) {
    // Below half a unit and from five units on nothing is wrong and sure; nearer ones are still taken away.
    for row in t.study("digits") {
        let decimals: i32 = row["asked"]
            .strip_suffix(" decimals")
            .unwrap()
            .parse()
            .unwrap();
        let units = 2.0 * number::<f64>(&row, "offset") * 10f64.powi(decimals);
        assert!(
            (0.5..4.9).contains(&units) || row["wrong_and_sure"] == "0",
            "{row:?}"
        );
    }
    // Single precision depends on the unit of length where that is far too large or too small; exact ranks do not.
    for far in ["1e-6", "1e6"] {
        let right = |method, factor| t.sum("scale", method, ("factor", factor), "right");
        assert!(right("lu32", far) < right("lu32", "1e-3"), "{far}");
        assert_eq!(right("modular", far), right("modular", "1e0"));
    }
    // Small primes divide minors, more of them the smaller they are, and those of the program none.
    let wrong = |bits| t.sum("prime", "random points", ("bits", bits), "wrong_and_sure");
    assert!(wrong("8e0") > wrong("1.2e1"));
    let large = t
        .study("prime")
        .into_iter()
        .filter(|r| r["bits"] == "6.1e1")
        .collect_vec();
    assert_eq!(large.len(), 3);
    assert!(
        large.iter().all(|r| r["wrong_and_sure"] == "0"),
        "{large:?}"
    );
    // Singular values of rounded files are those of decompositions made anew; auto is never wrong and sure.
    let rounded = t.study("rounded");
    assert_eq!(rounded.len(), 4 * 4);
    for row in rounded {
        if row["asked"] == "svd" {
            let anew = right_when_rounded(number::<f64>(&row, "decimals") as usize);
            assert_eq!(number::<usize>(&row, "right"), anew, "{row:?}");
        }
        assert!(
            row["asked"] != "auto" || row["wrong_and_sure"] == "0",
            "{row:?}"
        );
    }
    // The least rows have the rank and the counts of all rows.
    assert!(t.study("model").iter().all(|r| r["cases"] == r["right"]));
    for scene in ["plane", "in and out of a plane", "sphere", "space"] {
        assert_eq!(t.sum("model", scene, ("", ""), "cases"), 32);
    }
    assert!(t.sum("model", "built-in mechanisms", ("", ""), "cases") > 100);
    // Far from a dead point twelve digits are right, near it fewer, and none that is wrong goes without a warning.
    let right = |digits, height| t.sum("dead-point", digits, ("height", height), "right");
    assert!(
        t.study("dead-point")
            .iter()
            .all(|r| r["wrong_and_sure"] == "0")
    );
    assert_eq!(right("12 digits", "1e-3"), 4);
    assert_eq!(right("6 digits", "1e-12"), 0);
    for height in ["1e-15", "1e-12", "1e-9", "1e-6", "1e-3"] {
        assert!(right("6 digits", height) >= right("12 digits", height));
    }
    // The first of ten ideas is one of them, and the more costs move the less often it stays.
    let right = |of: &str, change| t.sum("first-idea", of, ("change", change), "right");
    let [near, far] = ["5e-2", "2e-1"].map(|change| {
        let first = right("first by cost stays first", change);
        assert!(first <= right("first by cost stays among ten", change));
        first
    });
    assert!(near >= far && far > 0, "{near} {far}");
    // Displaced ones and toggles: exact ranks are right about all of them.
    for name in ["distance", "shaky"] {
        let exact = t
            .study(name)
            .into_iter()
            .filter(|r| r["asked"] == "modular")
            .collect_vec();
        let is_right = |r: &Row| r["cases"] == r["right"] && r["right"] != "0";
        assert!(exact.len() >= 3 && exact.iter().all(is_right), "{name}");
    }
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
fn a_quick_run_writes_a_chart_and_a_table_of_each_study() {
    let (said, at) = quick_accuracy();
    has(
        said,
        &format!(
            "right of {}",
            built_in_cases(&builtin::all()).unwrap().len()
        ),
    );
    has(said, "Size of the prime: ");
    let mut svgs = 0;
    for entry in fs::read_dir(at).unwrap() {
        let path = entry.unwrap().path();
        let text = fs::read_to_string(&path).unwrap();
        match path.extension().unwrap().to_str().unwrap() {
            "svg" => {
                roxmltree::Document::parse(&text).unwrap_or_else(|e| panic!("{path:?}: {e}"));
                svgs += 1;
            }
            "csv" => assert!(!rows(&text).is_empty(), "{path:?}"),
            _ => assert!(path.ends_with("index.html") && text.ends_with("</html>\n")),
        }
    }
    assert_eq!(svgs, 12);
    let tables = Tables(at);
    studies_agree(&tables);
    for row in rows(&tables.read("survey.csv")) {
        let answer = row["answer"].parse::<i64>().ok();
        let is = |column: &str| answer == row[column].parse().ok();
        let expected = match answer {
            None => "does not apply",
            _ if is("expected_finite") => "right",
            _ if row["quantity"] == "instantaneous" && is("expected_instantaneous") => {
                "right at the pose"
            }
            _ => "wrong",
        };
        assert_eq!(row["verdict"], expected, "{row:?}");
        // By how much what can move for good is missed, answers for the pose alone, too.
        let off = answer.map(|a| a - number::<i64>(&row, "expected_finite"));
        assert_eq!(row["error"].parse().ok(), off, "{row:?}");
    }
    let folder = Folder::new();
    folder.succeed("accuracy --quick --threads 1 -o other");
    let again = Tables(&folder.path("other")).verdicts();
    for (one, two) in tables.verdicts().into_iter().zip_eq(again) {
        assert!(one == two, "differs between runs: {one}\n{two}");
    }
}
