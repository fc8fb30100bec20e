//! All studies: their table as text, and their charts and tables as files.

use super::stability;
use super::study::{Effort, Study, page_files};
use super::survey::{Survey, built_in_cases, generated_cases};
use super::timing::Stopwatch;
use ozols::rank::method::{MobilityMethod, registry};
use ozols::view::terminal::text_table;
use ozols_kernel::format::format_duration;
use std::path::Path;

/// The survey of built-in mechanisms and that of mechanisms from the seed.
type Surveys = [Survey; 2];

/// Runs the survey and, where a folder is given, every study, whose charts and tables go there. Returns the text about them.
///
/// # Panics
/// Panics if a file cannot be written.
pub(crate) fn run_all(effort: Effort, repeat: usize, folder: Option<&Path>) -> String {
    let watch = Stopwatch {
        clock: effort.clock,
        repeat,
    };
    let built_in = built_in_cases(&ozols::builtin::all()).expect("built-in files are valid");
    let surveys = [built_in, generated_cases(effort.seed)]
        .map(|cases| Survey::new(cases, watch, &mut |_, _| {}));
    let Some(folder) = folder else {
        return describe_studies(&surveys, &[]);
    };
    let found = stability::run_studies(&surveys[0].cases, effort, &mut |_, _, _| {});
    let text = describe_studies(&surveys, &found);
    let names = ["share-time", "share-time-generated"];
    let studies = surveys.iter().zip(names).map(|(s, name)| s.as_study(name));
    let studies: Vec<Study> = studies.chain(found).collect();
    let tables = ["survey.csv", "generated.csv"].map(str::to_owned);
    let tables = tables.into_iter().zip(surveys.iter().map(Survey::to_csv));
    let made = format!(
        "Made by cargo bench --bench accuracy, seed {}. {}. {}. The table of each chart is next to it as CSV.",
        effort.seed,
        surveys[0].describe_repeats(),
        describe_machine()
    );
    let title = "Mobility methods: accuracy, speed, stability";
    std::fs::create_dir_all(folder).expect("the folder can be made");
    for (name, text) in page_files(title, &made, &studies, tables.collect()) {
        std::fs::write(folder.join(name), text).expect("the file can be written");
    }
    text
}

fn describe_machine() -> String {
    let threads = rayon::current_num_threads();
    let (os, kind) = (std::env::consts::OS, std::env::consts::ARCH);
    let version = env!("CARGO_PKG_VERSION");
    format!("{threads} threads of {os} {kind}; ozols {version}")
}

/// Returns a table of the methods on both surveys, and a paragraph for each study.
fn describe_studies([survey, generated]: &Surveys, studies: &[Study]) -> String {
    let cases = survey.cases.len();
    let heads = format!(
        "method | right of {cases} | at the pose only | wrong | n/a | right of {} from the seed | median time | what it promises",
        generated.cases.len()
    );
    let count = |n: usize| if n == 0 { String::new() } else { n.to_string() };
    let row = |(m, method): (usize, &&MobilityMethod)| {
        let s = survey.record_of(m);
        vec![
            method.name().to_owned(),
            s.right.to_string(),
            count(s.pose),
            count(s.count_wrong()),
            count(cases - s.applies),
            generated.record_of(m).right.to_string(),
            format_duration(s.seconds),
            method.guarantee.to_owned(),
        ]
    };
    let table = text_table(&heads, registry::ALL.iter().enumerate().map(row), None);
    let mut out = format!(
        "{cases} cases of known mobility\n\n{table}\n\n{}. {}.\n",
        survey.describe_repeats(),
        describe_machine()
    );
    for study in studies {
        out += &format!("\n{}: {}\n", study.texts.title, study.conclusion());
    }
    out
}
