//! `ozols accuracy`.

use crate::accuracy::stability;
use crate::accuracy::study::{self, Effort};
use crate::accuracy::survey::{Survey, built_in_cases, generated_cases};
use crate::accuracy::timing::Stopwatch;
use crate::cli::prelude::*;
use crate::cli::terminal::{charts, machine};
use crate::view::accuracy::accuracy_text;

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
    a.output.as_deref().map_or(Ok(()), charts::make_folder)?;
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
    let written = charts::write_page(folder, files)?;
    bar.clear();
    output::write_bytes(None, format!("{text}\n{written}"))
}
