//! `ozols bench`.

use crate::accuracy::change::Noise;
use crate::accuracy::lattice::{Scene, make_ladder, make_lift};
use crate::accuracy::searching::record::{self, Trial, Way};
use crate::accuracy::searching::{MECHANISMS, TrialEffort, pictures, run_trial};
use crate::accuracy::study;
use crate::accuracy::timing::Stopwatch;
use crate::cli::option::request::Which;
use crate::cli::prelude::*;
use crate::cli::terminal::{charts, machine};
use crate::search::question::conditions::Symmetry;
use crate::view::accuracy::bench_text;
use serde_json::json;

/// Advice for each chart: which way of searching to use.
const ADVICE: [&str; 3] = [
    "If the diagram fits into --nodes, take it whole: its counts are exact, and --check prime proves them over a second prime.",
    "If it does not, a search that is stopped gives certain bounds and an interval of 95 %: raise --nodes tenfold to narrow them.",
    "For a ranking leave --pool to its default: the cheapest 20,000 are scored, and then all that could still win.",
];

#[derive(Debug, ClapArgs)]
pub(crate) struct Bench {
    /// Paths or names of built-in mechanisms [default: six built-in ones, a planar ladder of ten loops, a
    /// spatial ladder of six, and a scissor lift of 40 stages].
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    files: Vec<Named>,
    #[command(flatten)]
    loops: Loops,
    /// Number of best variants to compare.
    #[arg(long, value_name = "K", default_value_t = 10)]
    top: usize,
    /// Number of variants that brute force analyses; a space that is no larger is analysed completely [default: 20000, or 1000
    /// with --quick].
    #[arg(long, value_name = "N")]
    looked: Option<usize>,
    /// Number of times that each method is timed, fewer if it takes long; the median counts [default: 15, or 1 with --quick].
    #[arg(long, value_name = "N")]
    repeat: Option<usize>,
    /// Fewer repeats, variants and pools: seconds instead of a minute.
    #[arg(long)]
    quick: bool,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    format: TextJsonOrCsv,
    /// Write charts, the table and a page to this folder, with index.html as the start page.
    #[arg(long, short, value_name = "DIR", conflicts_with = "format")]
    output: Option<PathBuf>,
    #[command(flatten)]
    which: Which,
}

/// The trials that run on every mechanism, and the number of timings.
struct Trials {
    request: Request,
    effort: TrialEffort,
    watch: Stopwatch,
}

impl Trials {
    /// Returns the trials that the options ask for.
    fn from_options(args: &Global, a: &Bench) -> anyhow::Result<Trials> {
        let repeat = a.repeat.unwrap_or(if a.quick { 1 } else { 15 });
        let looked = a.looked.unwrap_or(if a.quick { 1_000 } else { 20_000 });
        ensure!(repeat > 0, "--repeat must be at least 1");
        ensure!(looked > 0, "--looked must be at least 1");
        let request = Request {
            list: List::Top(a.top),
            seed: args.seed,
            ..a.which.request(None)?
        };
        ensure!(
            request.symmetry != Symmetry::OnePerOrbit,
            "--one-per-orbit counts pairs, but brute force analyses each variant; omit it, or use --symmetric"
        );
        let effort = TrialEffort {
            looked,
            pool: request.pool.or(a.quick.then_some(2_000)),
            patience: if a.quick { 1.0 } else { 10.0 },
        };
        let clock = machine::processor_time;
        let watch = Stopwatch { clock, repeat };
        Ok(Trials {
            request,
            effort,
            watch,
        })
    }

    /// Runs them, and shows how far they are.
    fn run(&self, m: &Mechanism, effort: TrialEffort, bar: &mut Bar) -> anyhow::Result<Trial> {
        let progress = &mut |way: Way, done, of| {
            bar.show_step(&format!("{}: {way}", m.name), done, of);
        };
        let found = run_trial(m, &self.request, effort, self.watch, progress);
        found.with_context(|| format!("cannot search {}", m.name))
    }
}

pub(crate) fn run(args: &Global, a: &Bench) -> anyhow::Result<Done> {
    let asked = Trials::from_options(args, a)?;
    // The folder and the files before the work: a bad path should not cost a minute.
    a.output.as_deref().map_or(Ok(()), charts::make_folder)?;
    let built_in = MECHANISMS.map(Named::from);
    let files = if a.files.is_empty() {
        &built_in
    } else {
        &a.files[..]
    };
    let (mechanisms, mut well) = load::load_each(files, &a.loops);
    let mut bar = Bar::new(args.quiet);
    let mut trials = Vec::new();
    let mut runs: Vec<_> = mechanisms
        .iter()
        .map(|(_, m)| (m.clone(), asked.effort))
        .collect();
    if a.files.is_empty() {
        let noise = || Noise::new(1, 0);
        let counted = TrialEffort {
            looked: 0,
            ..asked.effort
        };
        let hard = [
            make_ladder(Scene::Plane, 10, &mut noise()),
            make_ladder(Scene::Space, 6, &mut noise()),
            make_lift(40),
        ];
        runs.extend(hard.map(|m| (m, counted)));
    }
    for (m, effort) in &runs {
        match asked.run(m, *effort, &mut bar) {
            Ok(found) => trials.push(found),
            Err(e) => {
                well = false;
                output::print_error(&e);
            }
        }
    }
    bar.clear();
    if trials.is_empty() {
        return Ok(Done::Partly);
    }
    let machine = machine::this_machine();
    let mut text = match a.format {
        TextJsonOrCsv::Text => bench_text(&trials, &ADVICE, &machine, output::output_width(None)),
        TextJsonOrCsv::Json => output::json_text(
            &json!({"machine": machine, "mechanisms": trials, "ways": record::trial_rows(&trials)}),
        )?,
        TextJsonOrCsv::Csv => record::trials_csv(&trials),
    };
    if let Some(folder) = &a.output {
        let command = std::env::args().collect::<Vec<_>>().join(" ");
        let made = format!("Made by: {command}. On {machine}.");
        let tables = vec![("searches.csv".to_owned(), record::trials_csv(&trials))];
        let studies = pictures::make_studies(&trials, ADVICE);
        let title = "Ways of searching: accuracy against speed";
        let files = study::page_files(title, &made, &studies, tables);
        text += &charts::write_page(folder, files)?;
    }
    output::write_bytes(None, text)?;
    Ok(if well { Done::Found } else { Done::Partly })
}
