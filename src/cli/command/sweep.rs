//! `ozols sweep`.

use crate::cli::done::Done;
use crate::cli::option::format::TextOrJson;
use crate::cli::option::global::Global;
use crate::cli::option::load;
use crate::cli::option::named::{File, Loops, Named};
use crate::cli::option::request::Which;
use crate::cli::terminal::interrupt;
use crate::cli::terminal::output;
use crate::cli::terminal::progress::Bar;
use crate::file::read::workload::motion::stroke;
use crate::file::text::text_of;
use crate::format::phrase::plural;
use crate::score::request::Request;
use crate::shard::Shard;
use crate::sweep::space::Sampling;
use crate::sweep::table::{SweepWatch, Table, make, merge};
use crate::sweep::{Spec, Sweep, SweepRequest};
use crate::view;
use crate::view::sweep::plot::PlottedQuantity;
use crate::view::terminal::next_commands::{self, NextCommand};
use anyhow::{Context, bail, ensure};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args as ClapArgs, ValueHint};
use std::path::{Path, PathBuf};

fn quantity() -> impl TypedValueParser<Value = PlottedQuantity> {
    let words = PossibleValuesParser::new(PlottedQuantity::ALL.map(|(word, _)| word));
    words.try_map(|word| {
        let found = PlottedQuantity::ALL.into_iter().find(|(w, _)| *w == word);
        found.map(|(_, q)| q).ok_or("there is no such quantity")
    })
}

#[derive(Debug, ClapArgs)]
#[allow(clippy::struct_excessive_bools, reason = "switches of a command line")]
pub(in crate::cli) struct SweepArgs {
    /// A mechanism file with [parameter], a path or `-`.
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath, required_unless_present = "merge")]
    file: Option<Named>,
    /// Look at every combination of N numbers of each range, its ends among them, and of all values of each list.
    #[arg(long, value_name = "N", default_value_t = 5, conflicts_with = "sobol")]
    grid: usize,
    /// Look at N points of Sobol's sequence instead, scrambled by --seed.
    #[arg(long, value_name = "N")]
    sobol: Option<usize>,
    /// Make part I of N alone, from 1; --merge puts the parts together.
    #[arg(long, value_name = "I/N", requires = "output")]
    shard: Option<Shard>,
    /// Put the parts of a sweep together into the table of -o.
    #[arg(
        long,
        value_name = "PARTS",
        num_args = 1..,
        requires = "output",
        conflicts_with_all = ["file", "grid", "sobol", "shard", "no_search", "top", "stroke", "methods"],
        value_hint = ValueHint::FilePath
    )]
    merge: Vec<PathBuf>,
    /// The table, JSON lines with all that is known of each sample; where there is one of the same sweep, what it lacks is added.
    #[arg(long, short, value_name = "FILE", value_hint = ValueHint::FilePath)]
    output: Option<PathBuf>,
    /// Also write the figures as a flat table.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    csv: Option<PathBuf>,
    /// Also write a plot over two of the parameters.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    svg: Option<PathBuf>,
    /// What is plotted.
    #[arg(long, value_name = "QUANTITY", value_parser = quantity(), default_value = "redundant", requires = "svg")]
    plot: PlottedQuantity,
    /// The parameters it is plotted over; the first two by default. Of samples that differ in others alone the greatest value counts.
    #[arg(long, value_name = "A,B", value_delimiter = ',', requires = "svg")]
    over: Vec<String>,
    /// Leave out the search for redesigns.
    #[arg(long)]
    no_search: bool,
    /// Redesigns listed for each sample, beside all that share the first place.
    #[arg(long, value_name = "K", default_value_t = 3)]
    top: usize,
    /// Also follow the rank of every state over a stroke of its first drive: 0:90deg:9.
    #[arg(long, value_name = "FROM:TO:STEPS", allow_hyphen_values = true)]
    stroke: Option<String>,
    /// Also ask every rank method, and judge its answers where the mobility is proven.
    #[arg(long)]
    methods: bool,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    format: TextOrJson,
    #[command(flatten)]
    which: Which,
}

/// Shows how far a sweep has come, and ends it at a signal.
struct Watching(Bar);

impl SweepWatch for Watching {
    fn done(&mut self, done: usize, of: usize) {
        self.0.step("samples", done, of);
    }
    fn ended(&self) -> bool {
        interrupt::pending()
    }
}

fn sweep(args: &Global, a: &SweepArgs, file: &Named) -> anyhow::Result<Sweep> {
    let (name, bytes) = load::named(&File {
        file: file.clone(),
        loops: Loops::default(),
    })?;
    let sampling = match a.sobol {
        None => Sampling::Grid { points: a.grid },
        Some(count) => Sampling::Sobol {
            count,
            seed: u32::try_from(args.seed)
                .with_context(|| format!("--seed of --sobol must be at most {}", u32::MAX))?,
        },
    };
    // Other machines that make parts of it may have less memory.
    let memory = a.which.memory.unwrap_or(Request::default().memory);
    let request = Request {
        memory,
        ..a.which.request(None)?
    };
    let read = |text: &String| anyhow::Ok((text.clone(), stroke(text)?));
    let asked = SweepRequest {
        as_written: request.as_written,
        search: (!a.no_search).then_some(request),
        top: a.top,
        stroke: a.stroke.as_ref().map(read).transpose()?,
        methods: a.methods,
    };
    Ok(Sweep::new(Spec {
        text: text_of(&name, &bytes)?.to_owned(),
        file: name,
        sampling,
        asked,
    })?)
}

fn table(args: &Global, a: &SweepArgs) -> anyhow::Result<Table> {
    let Some(file) = &a.file else {
        let Some(whole) = &a.output else {
            bail!("--merge needs -o, the table of the whole");
        };
        a.merge.iter().for_each(|part| output::kept::keep(part));
        ensure!(
            !output::kept::is_kept(whole),
            "{} is one of the parts and the whole; choose another name for the whole",
            whole.display()
        );
        return Ok(merge(&a.merge, whole)?);
    };
    let sweep = sweep(args, a, file)?;
    interrupt::be_patient();
    let mut watching = Watching(Bar::new(args.quiet));
    let shard = a.shard.unwrap_or(Shard::WHOLE);
    let made = make(&sweep, shard, a.output.as_deref(), &mut watching);
    watching.0.clear();
    Ok(made?)
}

pub(in crate::cli) fn run(args: &Global, a: &SweepArgs) -> anyhow::Result<Done> {
    let table = table(args, a)?;
    let shown = view::sweep::SweepData::new(&table);
    let write = |path: &Option<PathBuf>, text: &dyn Fn() -> anyhow::Result<String>| match path {
        None => Ok(Done::Found),
        Some(path) => {
            let text = text()?;
            output::to(Some(path), |out| {
                out.write_all(text.as_bytes())?;
                Ok(Done::Found)
            })
        }
    };
    write(&a.csv, &|| Ok(shown.csv()))?;
    write(&a.svg, &|| Ok(shown.plot(a.plot, &a.over)?.svg()))?;
    output::to(None, |out| {
        match a.format {
            TextOrJson::Json => output::json(out, &shown)?,
            TextOrJson::Text => {
                let width = output::width(None);
                write!(out, "{}", shown.text(width))?;
                write!(out, "{}", next_commands::text(&steps(a, &table), width))?;
            }
        }
        Ok(Done::Found)
    })?;
    if !table.finished {
        output::note(&unfinished(&table, a.output.as_deref()));
    }
    Ok(Done::Found)
}

/// "1 sample is", "2 samples are".
fn kept(n: usize, one: &str, many: &str) -> String {
    format!(
        "{} {}",
        plural(n, "sample"),
        if n == 1 { one } else { many }
    )
}

fn unfinished(table: &Table, path: Option<&Path>) -> String {
    let done = table.rows.len();
    match path {
        Some(path) => format!(
            "{} in {}; the same command carries on with it\n",
            kept(done, "is", "are"),
            path.display()
        ),
        None => format!(
            "{} looked at; with -o FILE.jsonl they would be kept\n",
            kept(done, "was", "were")
        ),
    }
}

/// What to do next.
fn steps(a: &SweepArgs, table: &Table) -> Vec<NextCommand> {
    let Some(file) = a.file.as_deref().filter(|_| table.finished) else {
        return Vec::new();
    };
    let mut out = Vec::new();
    if a.output.is_none() {
        let gives = "the table of all samples, which can be carried on and made in parts";
        out.push(NextCommand::new("sweep", file, "-o sweep.jsonl", gives));
    }
    if a.svg.is_none() && table.head.parameters.len() > 1 {
        let gives = "redundant constraints over the first two parameters";
        out.push(NextCommand::new("sweep", file, "--svg sweep.svg", gives));
    }
    out
}
