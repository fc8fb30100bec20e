//! `ozols accuracy`.

use crate::accuracy::stability;
use crate::accuracy::study::{self, Effort, Study};
use crate::accuracy::survey::{Survey, built_in_cases, generated_cases};
use crate::accuracy::timing::{Machine, Stopwatch};
use crate::cli::prelude::*;
use crate::cli::terminal::machine;
use crate::format::format_duration;
use crate::rank::method::{MobilityMethod, registry};

#[derive(Debug, ClapArgs)]
pub(crate) struct Accuracy {
    /// Write charts and tables to this folder, with index.html as the start page; without it only the table is printed.
    #[arg(long, short, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Fewer repeats and coarser studies: under a minute instead of some minutes.
    #[arg(long)]
    quick: bool,
    /// Number of times that each answer is timed; the median counts [default: 5, or 1 with --quick].
    #[arg(long, value_name = "N")]
    repeat: Option<usize>,
}

pub(crate) fn run_accuracy(args: &Global, a: &Accuracy) -> anyhow::Result<Done> {
    let repeat = a.repeat.unwrap_or(if a.quick { 1 } else { 5 });
    ensure!(repeat > 0, "--repeat must be at least 1");
    // The folder before the work: a bad path should not cost a minute.
    a.output.as_deref().map_or(Ok(()), output::make_folder)?;
    let mut bar = Bar::new(args.quiet);
    let clock = machine::processor_time;
    let machine = machine::this_machine();
    let watch = Stopwatch { clock, repeat };
    let mut surveyed = |cases, what: &str| {
        Survey::new(cases, watch, &mut |done, of| bar.show_step(what, done, of))
    };
    let survey = surveyed(built_in_cases(&builtin::all())?, "timing the methods");
    let generated = surveyed(generated_cases(args.seed), "mechanisms from the seed");
    let width = output::output_width(None);
    let text = |studies| accuracy_text([&survey, &generated], studies, &machine, width);
    let Some(folder) = &a.output else {
        bar.clear();
        let charts = NextCommand {
            command: "ozols accuracy -o accuracy".to_owned(),
            gives: "the same as charts, and where each method's numbers fail".to_owned(),
        };
        return output::write_bytes(
            None,
            text(&[]) + &next_commands::steps_text(&[charts], width),
        );
    };
    let effort = Effort {
        quick: a.quick,
        seed: args.seed,
        clock,
    };
    let progress = &mut |what: &str, done, of| bar.show_step(what, done, of);
    let found = stability::run_studies(&survey.cases, effort, progress);
    let quick = if a.quick { " --quick" } else { "" };
    let made = format!(
        "Made by: ozols accuracy{quick} --seed {} -o DIR. {}. On {machine}. The table of each chart is next to it as CSV.",
        args.seed,
        survey.describe_repeats()
    );
    let tables = [("survey.csv", &survey), ("generated.csv", &generated)];
    let tables = tables.map(|(name, survey)| (name.to_owned(), survey.to_csv()));
    let text = text(&found);
    let mut studies = vec![
        survey.as_study("share-time"),
        generated.as_study("share-time-generated"),
    ];
    studies.extend(found);
    let title = "Mobility methods: accuracy, speed, stability";
    let files = study::page_files(title, &made, &studies, tables.into());
    for (name, text) in files {
        output::write_bytes(Some(&folder.join(name)), text)?;
    }
    bar.clear();
    let index = folder.join("index.html");
    let written = format!("Written to {}: open it in a browser.\n", index.display());
    output::write_bytes(None, format!("{text}\n{written}"))
}

/// Returns a table of the methods on built-in mechanisms and on those from the seed, the machine it was made on, and a paragraph
/// for each study.
fn accuracy_text(
    [survey, generated]: [&Survey; 2],
    studies: &[Study],
    machine: &Machine,
    width: Option<u16>,
) -> String {
    let cases = survey.cases.len();
    let heads = format!(
        "method | right of {cases} | at the pose only | wrong | n/a | right of {} from the seed | median time | what it promises",
        generated.cases.len()
    );
    let standing = |name: &str| {
        let m = registry::ALL.iter().position(|x| x.name() == name)?;
        Some(survey.record_of(m).right)
    };
    let mut out = format!("{cases} cases of known mobility");
    if let (Some(auto), Some(count)) = (standing("auto"), standing("count")) {
        out +=
            &format!(": the automatic choice is right on {auto}, the counting formula on {count}");
    }
    let table = text_table(&heads, method_rows(survey, generated), width);
    out += &format!(
        "\n\n{table}\n\n{}. On {machine}.\n",
        survey.describe_repeats()
    );
    for study in studies {
        out += &format!("\n{}: {}\n", study.texts.title, study.conclusion());
    }
    fit_lines(&out, width)
}

/// Returns a row for each method.
fn method_rows(survey: &Survey, generated: &Survey) -> Vec<Vec<String>> {
    let cases = survey.cases.len();
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
    registry::ALL.iter().enumerate().map(row).collect()
}
