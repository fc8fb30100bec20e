//! `ozols search`.

use crate::cli::option::request::Checked;
use crate::cli::prelude::*;
use crate::cli::terminal::machine;
use crate::cli::terminal::progress::SearchWatch;
use crate::format::{format_duration, group_thousands};
use crate::score::outcome::remarks::Remarks;
use crate::score::request::Method;
use crate::view::search::{csv, json, text};
use num_traits::Zero;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum SearchFormat {
    Text,
    Json,
    /// One variant per line.
    Jsonl,
    /// One variant per line.
    Csv,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum SearchMethod {
    /// The span diagram.
    Diagram,
    /// Analyse every variant; counts only. For checking and comparison.
    Brute,
}

#[derive(Debug, ClapArgs)]
#[allow(clippy::struct_excessive_bools, reason = "switches of a command line")]
pub(crate) struct Search {
    #[command(flatten)]
    file: File,
    /// Number of best variants to list.
    #[arg(long, value_name = "K", default_value_t = 10)]
    top: usize,
    /// List every admissible variant, cheapest first.
    #[arg(long, conflicts_with_all = ["top", "sample", "count", "rank", "distinct"])]
    all: bool,
    /// List N admissible variants chosen uniformly at random.
    #[arg(long, value_name = "N", conflicts_with_all = ["top", "count", "rank", "distinct"])]
    sample: Option<usize>,
    /// Print only the counts.
    #[arg(long, conflicts_with = "rank")]
    count: bool,
    /// List the best variants without counting all of them (fast however many there are).
    #[arg(long, conflicts_with_all = ["all", "sample", "count"])]
    no_count: bool,
    /// List every variant in the text. By default a short list that is proven the cheapest gives only the first of each idea (see
    /// --distinct).
    #[arg(long, conflicts_with = "distinct")]
    no_distinct: bool,
    #[command(flatten)]
    checked: Checked,
    /// Span diagram, or brute force for checking.
    #[arg(long, value_enum, default_value = "diagram")]
    method: SearchMethod,
    /// Also print the counts by mobility, σ by contour, and what each of the first three ideas does.
    #[arg(long, short)]
    verbose: bool,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    format: SearchFormat,
    /// End a CSV that is not the whole list with a comment line, `# ...`; without this option the note goes to standard error.
    #[arg(long)]
    comment: bool,
    #[command(flatten)]
    to: ToFile,
}

/// Length of a list that people read.
const SHORT: usize = 100;

impl Search {
    fn request(&self, seed: u64) -> anyhow::Result<Request> {
        Ok(Request {
            list: match (self.all, self.sample, self.count) {
                (true, ..) => List::All,
                (_, Some(n), _) => List::Sample(n),
                (.., true) => List::Nothing,
                _ => List::Top(self.top),
            },
            method: match self.method {
                SearchMethod::Diagram => Method::Diagram,
                SearchMethod::Brute => Method::Brute,
            },
            counted: !self.no_count,
            only_sums: self.format != SearchFormat::Json,
            ..self.checked.request(seed)?
        })
    }

    /// Returns true if people are given the first variant of each idea: the first rows of all variants are often one idea many
    /// times. False if a search was cut short, because then no idea is proven the cheapest. Also false if further poses are
    /// checked: the first variant of an idea may owe its place to this pose, and the next may not.
    fn tells_ideas(&self, outcome: &Outcome) -> bool {
        let short = matches!(outcome.request.list, List::Top(1..=SHORT));
        let text = matches!(self.format, SearchFormat::Text);
        let one_pose = outcome.request.poses == 0;
        let counted = outcome.is_counted() || outcome.is_numeric_whole();
        let plain = outcome.ranking.is_none() && one_pose && counted;
        text && short && plain && !self.no_distinct
    }
}

pub(crate) fn run_search(args: &Global, a: &Search) -> anyhow::Result<Done> {
    let begun = machine::elapsed_time();
    let seconds = || (machine::elapsed_time() - begun).as_secs_f64();
    let mechanism = load::load_mechanism(&a.file)?;
    let request = a.request(args.seed)?;
    let mut outcome = SearchWatch::new(args.quiet).run_search(mechanism, &request)?;
    outcome.request.distinct |= a.tells_ideas(&outcome);
    let remarks = &match a.format {
        SearchFormat::Text | SearchFormat::Json => outcome.make_remarks(&interrupt::is_pending)?,
        SearchFormat::Jsonl | SearchFormat::Csv => Remarks::default(),
    };
    let done = output::write_with(a.to.path(), |out| {
        let variants = outcome.variants_unless(&interrupt::is_pending);
        match a.format {
            SearchFormat::Text => {
                let width = a.to.width();
                let file = &a.file.file;
                if request.list == List::All {
                    text::write_text(out, &outcome, variants, remarks, file, width, a.verbose)?;
                } else {
                    let (mut text, long) = (Vec::new(), a.verbose);
                    text::write_text(&mut text, &outcome, variants, remarks, file, width, long)?;
                    let text = a.file.with_loops(String::from_utf8(text)?);
                    let text = colour_verdicts(text, a.to.path(), [verdict_tone(&outcome)]);
                    out.write_all(text.as_bytes())?;
                }
            }
            SearchFormat::Json => {
                json::write_json(out, &outcome, variants, remarks, Some(&seconds))?;
            }
            SearchFormat::Jsonl => json::write_lines(out, &outcome, variants)?,
            SearchFormat::Csv => {
                if let Some(short) = csv::write_csv(out, &outcome, variants)? {
                    if a.comment {
                        writeln!(out, "# {short}")?
                    } else {
                        output::print_message(&format!("{short}\n"))
                    }
                }
            }
        }
        let none = outcome.listed_counts().total.is_zero() && !outcome.admissible_may_be_more();
        Ok(Done::found_or_nothing(!none))
    })?;
    // The output itself is the same every time.
    if a.format == SearchFormat::Text && !args.quiet {
        let allowed = machine::format_bytes(request.memory as u64);
        let held = machine::peak_memory().map_or(String::new(), |peak| {
            format!(
                ", {} of memory ({allowed} allowed)",
                machine::format_bytes(peak)
            )
        });
        output::print_note(&format!(
            "Searched in {}{held}.\n",
            format_duration(seconds())
        ));
    }
    Ok(done)
}

/// Returns the number of redesigns in words, and whether that is good news.
fn verdict_tone(outcome: &Outcome) -> (String, Tone) {
    let total = &outcome.listed_counts().total;
    if outcome.numeric.is_some() {
        ("numeric".to_owned(), Tone::Bad)
    } else if !outcome.is_confirmed() {
        ("not exact".to_owned(), Tone::Bad)
    } else if total.is_zero() {
        ("none".to_owned(), Tone::Bad)
    } else {
        (group_thousands(total), Tone::Good)
    }
}
