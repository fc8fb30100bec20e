//! What structures cost by their number of links: to list them all, and to lay one out, follow its stroke and search it.
//!
//! `cargo bench --bench structures -- [-o DIR] [--links 4..12] [--sample N]` prints a table and writes `structures.svg` and
//! `structures.md` to the folder. Where there are more than N structures, a sample stands for them: chains drawn evenly, of each a
//! structure drawn evenly, always the same ones. One thread, wall time.

#![allow(
    clippy::print_stdout,
    missing_docs,
    reason = "a bench reports what it measures"
)]

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use ozols::catalog::row::row;
use ozols::catalog::spec::{Spec, range};
use ozols::chains::chain::Chain;
use ozols::chains::enumerate::chains;
use ozols::chains::roles::Subject;
use ozols::chart::{Axis, Chart, Scale, Series, Style};
use ozols::model::mechanism::Mechanism;
use ozols::synthesis::figures::figures;
use ozols::synthesis::layout::layout;
use ozols::synthesis::mechanism::mechanism_file;
use ozols::synthesis::structure::{Structure, structures};
use std::fmt::Write as _;
use std::path::PathBuf;
use std::time::Instant;

/// A chain in canonical numbering with its automorphisms.
type Named = (Chain, Vec<Vec<usize>>);

/// What was measured of one number of links; times in seconds.
struct Measured {
    links: usize,
    chains: usize,
    structures: usize,
    listing: f64,
    looked_at: usize,
    /// Of each structure that was looked at and has a layout: to lay it out, follow it, search it.
    each: Vec<[f64; 3]>,
    /// How many of these have exact counts.
    exact: usize,
}

const STAGES: [&str; 3] = ["layout", "stroke", "search and ideas"];

fn since(begun: Instant) -> f64 {
    begun.elapsed().as_secs_f64()
}

fn of_chain((chain, automorphisms): &Named, spec: &Spec) -> Vec<Structure> {
    let forms = spec.forms().expect("forms");
    structures(&Subject::new(chain, automorphisms), spec.jaws, &forms)
}

/// All structures, or a sample of so many.
fn chosen(all: &[Named], count: usize, sample: usize, spec: &Spec) -> Vec<(usize, Structure)> {
    let each = |(i, c): (usize, &Named)| {
        of_chain(c, spec)
            .into_iter()
            .map(move |s| (i, s))
            .collect::<Vec<_>>()
    };
    if count <= sample {
        return all.iter().enumerate().flat_map(each).collect();
    }
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut draw = |of: usize| usize::try_from(random.next_u64() % of as u64).expect("an index");
    let mut out = Vec::new();
    while out.len() < sample {
        let chain = draw(all.len());
        let mut some = of_chain(&all[chain], spec);
        if !some.is_empty() {
            out.push((chain, some.swap_remove(draw(some.len()))));
        }
    }
    out
}

fn measured(links: usize, sample: usize, spec: &Spec) -> Measured {
    let begun = Instant::now();
    let all: Vec<Named> = chains(links, 1)
        .expect("listed")
        .iter()
        .map(Chain::canonical)
        .collect();
    let count = all.iter().map(|c| of_chain(c, spec).len()).sum();
    let listing = since(begun);
    let chosen = chosen(&all, count, sample, spec);
    let (mut each, mut exact) = (Vec::new(), 0);
    for (chain, structure) in &chosen {
        let (chain, automorphisms) = &all[*chain];
        let subject = Subject::new(chain, automorphisms);
        let begun = Instant::now();
        let Ok(laid) = layout(&subject, structure, &spec.limits(), spec.seed) else {
            continue;
        };
        let to_lay = since(begun);
        let file = mechanism_file(structure, &laid, &spec.menu().expect("options"));
        let mechanism = Mechanism::from_json(&file.json().to_string()).expect("its own file");
        let begun = Instant::now();
        figures(structure, &laid, &mechanism).expect("coordinates");
        let to_follow = since(begun);
        let begun = Instant::now();
        let row = row(&subject, structure, spec).expect("a row");
        let rest = since(begun) - to_lay - to_follow;
        if let Ok(laid) = row.laid {
            each.push([to_lay, to_follow, rest.max(0.0)]);
            exact += usize::from(laid.exact);
        }
    }
    Measured {
        links,
        chains: all.len(),
        structures: count,
        listing,
        looked_at: chosen.len(),
        each,
        exact,
    }
}

impl Measured {
    fn mean(&self, stage: usize) -> f64 {
        self.each.iter().map(|e| e[stage]).sum::<f64>() / self.each.len().max(1) as f64
    }

    /// What the whole would take, in hours of one thread.
    fn whole(&self) -> f64 {
        let one: f64 = (0..3).map(|s| self.mean(s)).sum();
        one * self.structures as f64 / 3600.0
    }
}

fn table(all: &[Measured]) -> String {
    let mut out = "| links | chains | structures | listed in | looked at | laid out | counts exact | layout | stroke | search and ideas | all of them |\n\
                   |---|---|---|---|---|---|---|---|---|---|---|\n"
        .to_owned();
    for m in all {
        let ms = |stage| 1e3 * m.mean(stage);
        let _ = writeln!(
            out,
            "| {} | {} | {} | {:.2} s | {} | {} | {} | {:.1} ms | {:.1} ms | {:.1} ms | {:.2} h |",
            m.links,
            m.chains,
            m.structures,
            m.listing,
            if m.looked_at < m.structures {
                format!("a sample of {}", m.looked_at)
            } else {
                "all".to_owned()
            },
            m.each.len(),
            m.exact,
            ms(0),
            ms(1),
            ms(2),
            m.whole(),
        );
    }
    out
}

fn chart(all: &[Measured]) -> Chart {
    let sampled: Vec<String> = all
        .iter()
        .filter(|m| m.looked_at < m.structures)
        .map(|m| {
            format!(
                "{} of {} structures of {} links",
                m.looked_at, m.structures, m.links
            )
        })
        .collect();
    let subtitle = match sampled.is_empty() {
        true => "Mean of all structures with a layout, one thread.".to_owned(),
        false => format!(
            "Mean of those with a layout, one thread; a sample stands for all: {}.",
            sampled.join(", ")
        ),
    };
    let series = STAGES.iter().enumerate().map(|(stage, name)| Series {
        name: (*name).to_owned(),
        points: all
            .iter()
            .map(|m| (m.links as f64, 1e3 * m.mean(stage)))
            .collect(),
        style: Style::Line,
    });
    Chart {
        title: "What a structure costs".to_owned(),
        subtitle,
        x: Axis {
            label: "links".to_owned(),
            scale: Scale::Linear,
        },
        y: Axis {
            label: "time, ms".to_owned(),
            scale: Scale::Log,
        },
        series: series.collect(),
    }
}

fn main() {
    let (mut links, mut sample, mut folder) = (4..=10, 40, None);
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        let mut value = || {
            words
                .next()
                .unwrap_or_else(|| panic!("{word} needs a value"))
        };
        match word.as_str() {
            "--links" => {
                links = range(&value())
                    .map(|r| r.to_owned())
                    .expect("links, such as 4..12")
            }
            "--sample" => sample = value().parse().expect("a number"),
            "-o" => folder = Some(PathBuf::from(value())),
            // What cargo adds.
            "--bench" => {}
            other => panic!("{other}: -o DIR, --links N..M or --sample N"),
        }
    }
    let spec = Spec::default();
    let one = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread");
    let all: Vec<Measured> = links
        .filter(|n| n % 2 == 0)
        .map(|n| one.install(|| measured(n, sample, &spec)))
        .collect();
    print!("{}", table(&all));
    if let Some(folder) = folder {
        std::fs::create_dir_all(&folder).expect("the folder");
        std::fs::write(folder.join("structures.md"), table(&all)).expect("the table");
        std::fs::write(folder.join("structures.svg"), chart(&all).svg()).expect("the chart");
    }
}
