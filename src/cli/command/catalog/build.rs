//! `ozols catalog build`.

use super::chains::parse_pair_kind;
use super::task::{TaskArgs, one_of};
use crate::catalog::build::{build_rows, plan_work};
use crate::catalog::spec::{Parallel, Spec, SpecError};
use crate::catalog::store::Store;
use crate::chains::{Input, PairKind, Symmetry};
use crate::cli::prelude::*;
use crate::file::disk;
use crate::file::text::MAX_BYTES;
use crate::shard::Shard;
use crate::view::catalog::structures::built_text;
use anyhow::anyhow;
use serde::Serialize;
use std::ops::ControlFlow;

#[derive(Debug, ClapArgs, Serialize)]
pub(crate) struct Build {
    /// Numbers of links, such as 4..8 (the last included); chains of mobility 1 have an even number, with gears and slots any.
    #[arg(long, value_name = "N..M")]
    links: Option<String>,
    /// Number of jaws: 2, or 3 at 120° [default: 2].
    #[arg(long, value_name = "N")]
    jaws: Option<usize>,
    /// Motion of the driver: slide, turn [default: both].
    #[arg(long, value_name = "INPUT", value_delimiter = ',', value_parser = one_of(&Input::ALL))]
    #[serde(rename = "inputs")]
    input: Vec<Input>,
    /// Symmetries of the layouts: generic, mirror (with a slide), half-turn (with a turning input), threefold (three jaws, in a
    /// plane with a turning input, about an axis with a slide) [default: all].
    #[arg(long, value_name = "SYMMETRY", value_delimiter = ',', value_parser = one_of(&Symmetry::ALL))]
    #[serde(rename = "symmetries")]
    symmetry: Vec<Symmetry>,
    /// Layouts with each jaw on a parallelogram: with, without or only.
    #[arg(long, value_name = "WORD", value_parser = one_of(&Parallel::ALL))]
    parallel: Option<Parallel>,
    /// Pairs in addition to hinges: slide, gear (or rack), slot (pin in a slot, cam, wedge), two-slots (two pins in two slots
    /// between the same links). They are used in symmetric structures of two jaws, threefold ones of three, or any with
    /// --generic-pairs; only the driver may slide otherwise.
    #[arg(long, value_name = "KINDS", value_delimiter = ',', value_parser = parse_pair_kind)]
    pairs: Vec<PairKind>,
    /// Maximum number of pairs that are not hinges; a left and a right one count once [default: 3].
    #[arg(long, value_name = "K")]
    at_most: Option<usize>,
    /// With pairs, also include structures of two or three jaws that are laid out freely, symmetric or not; there are many.
    #[arg(long, requires = "pairs")]
    generic_pairs: bool,
    /// Only the well-known schemes, with any number of links, each as symmetric as it can be.
    #[arg(long, conflicts_with_all = ["links", "pairs", "at_most", "generic_pairs"])]
    classics: bool,
    /// Joint types that may replace a hinge.
    #[arg(long, value_name = "TYPES", value_delimiter = ',')]
    options: Vec<String>,
    /// Joint types that may be put in series with a hinge, on an extra link [default: none].
    #[arg(long, value_name = "TYPES", value_delimiter = ',')]
    unloading: Vec<String>,
    /// Number of ideas kept per structure [default: 10].
    #[arg(long, value_name = "K")]
    ideas: Option<usize>,
    /// Maximum ratio of the longest link to the shortest [default: 8].
    #[arg(long, value_name = "X")]
    ratio: Option<f64>,
    /// Maximum number of crossings of links for which no planes are known in which they pass each other [default: 6].
    #[arg(long, value_name = "N")]
    crossings: Option<usize>,
    /// File with all these settings, in TOML; options on the command line take precedence.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    #[serde(skip)]
    spec: Option<PathBuf>,
    /// Build only part I of N, counted from 1; `ozols catalog merge` merges the parts.
    #[arg(long, value_name = "I/N")]
    #[serde(skip)]
    shard: Option<Shard>,
    /// Database to write; an existing one of the same catalogue is completed.
    #[arg(long, short, value_name = "FILE", value_hint = ValueHint::FilePath)]
    #[serde(skip)]
    output: PathBuf,
    // Last: what follows would stand under its heading in the help.
    #[command(flatten)]
    task: TaskArgs,
}

/// Puts given settings over others; false and empty lists are not given.
fn put_over(under: &mut toml::Value, given: toml::Value) {
    match (under, given) {
        (toml::Value::Table(under), toml::Value::Table(given)) => {
            for (key, x) in given {
                put_over(under.entry(key).or_insert(x.clone()), x);
            }
        }
        (_, toml::Value::Boolean(false)) => {}
        (_, toml::Value::Array(list)) if list.is_empty() => {}
        (under, x) => *under = x,
    }
}

impl Build {
    /// Puts what is given in its place.
    fn put_options(&self, spec: &mut Spec) -> anyhow::Result<()> {
        let mut all = toml::Value::try_from(&*spec)?;
        put_over(&mut all, toml::Value::try_from(self)?);
        *spec = all.try_into()?;
        if let Some([from, to]) = self.task.widths {
            (spec.task.narrowest, spec.task.widest) = (from, to);
        }
        ensure!(
            self.at_most.is_none() || !spec.pairs.is_empty(),
            "--at-most limits pairs that are not hinges; name them with --pairs, such as --pairs slide,gear,slot"
        );
        Ok(())
    }

    fn spec(&self, seed: u64) -> anyhow::Result<Spec> {
        let text = match &self.spec {
            None => String::new(),
            Some(path) => disk::read_text(path, MAX_BYTES)
                .with_context(|| format!("cannot read {}", path.display()))?,
        };
        let file = self.spec.as_deref().map(Path::display);
        let mut spec: Spec = match &file {
            None => Spec::default(),
            Some(file) => toml::from_str(&text).with_context(|| file.to_string())?,
        };
        let alone = spec.clone();
        self.put_options(&mut spec)?;
        if seed != 1 {
            spec.seed = seed;
        }
        let Err(wrong) = spec.check_all() else {
            return Ok(spec);
        };
        // Of the file, where no flag did it.
        let file = file.filter(|_| alone.check_all().as_ref() == Err(&wrong));
        let has = |line: &str| {
            let key = line.split('=').next().map(str::trim);
            key.is_some() && key == wrong.wrong_key()
        };
        let line = text.lines().position(has).map(|n| n + 1);
        let place = file.zip(line).map(|(file, line)| format!("{file}:{line}"));
        Err(match (place, options_for(&wrong)) {
            (Some(place), _) => anyhow::Error::new(wrong).context(place),
            (None, Some(options)) => anyhow!("{wrong}; {options}"),
            (None, None) => anyhow::Error::new(wrong),
        })
    }
}

/// Returns the options that correct a specification, if there are any.
fn options_for(wrong: &SpecError) -> Option<&'static str> {
    match wrong {
        SpecError::PairedLinks => Some("with three jaws, omit --generic-pairs"),
        SpecError::PairedForms => Some(
            "give --symmetry mirror or half-turn, threefold with three jaws, or generic with --generic-pairs",
        ),
        SpecError::Freely => Some("add --symmetry generic, or omit --generic-pairs"),
        _ => None,
    }
}

pub(super) fn run_build(args: &Global, a: &Build) -> anyhow::Result<Done> {
    let spec = a.spec(args.seed)?;
    let part = a.shard.unwrap_or(Shard::WHOLE);
    let work = plan_work(&spec, part)?;
    let all = work.structure_count();
    ensure!(
        all > 0 || part != Shard::WHOLE,
        "no structure with {} links meets the conditions: three sides need \
        links that join only frame and driver, and three jaws need at least four links; without \
        gears and slots the number of links is even",
        spec.links
    );
    let mut store = Store::open_or_create(&a.output, &spec)?;
    let there = store.structure_ids()?;
    interrupt::be_patient();
    let mut bar = Bar::new(args.quiet);
    let mut count = 0;
    store.add_while(|send| {
        build_rows(
            &spec,
            &work,
            |id| interrupt::is_pending() || there.contains(id),
            |row| {
                count += 1;
                bar.show_step("structures", there.len() + count, all);
                if send.send(row).is_err() || interrupt::is_pending() {
                    ControlFlow::Break(())
                } else {
                    ControlFlow::Continue(())
                }
            },
        )
    })??;
    bar.clear();
    if !interrupt::is_pending() {
        store.finish_part(part, all)?;
    }
    report_built(&store, &a.output, count)
}

/// Reports how much a catalogue holds after `added` entries were added, and whether it was interrupted.
pub(super) fn report_built(store: &Store, path: &Path, added: usize) -> anyhow::Result<Done> {
    let mut text = built_text(store, path, added, output::output_width(None))?;
    if interrupt::is_pending() {
        let path = path.display();
        text += &format!("\nInterrupted: the same command continues with {path}.\n");
    }
    output::write_bytes(None, text)
}
