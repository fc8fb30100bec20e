//! What structures cost by their number of links: to list them, to search a chain and input in general position, and to lay one
//! structure out, follow its stroke and search it.
//!
//! `cargo bench --bench structures -- [-o DIR] [--links 4..12] [--sample N] [--symmetry mirror]` prints a table, and for each number
//! of links as soon as it is known; to the folder it writes `structures.md`, `structures.svg` with what one structure costs, and
//! `catalogues.svg` with what all of them do. Without `--symmetry` both kinds are measured: all structures, and those that are mirror
//! images; of symmetric ones those alone that can move. Where there are more than N, so many drawn evenly stand for all, always the
//! same ones. Processor time of one thread, or wall time where there is no /proc.

#![allow(
    clippy::print_stdout,
    missing_docs,
    reason = "a bench reports what it measures"
)]

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use ozols::catalog::general::{General, InputPair};
use ozols::catalog::row::row_of_pair;
use ozols::catalog::spec::{Spec, parse_range};
use ozols::chains::Symmetry;
use ozols::chains::chain::Chain;
use ozols::chains::enumerate::list_chains;
use ozols::chains::roles::Subject;
use ozols::chart::{Axis, Chart, Scale, Series, Style};
use ozols::synthesis::figures::layout_figures;
use ozols::synthesis::layout::lay_out;
use ozols::synthesis::structure::Structure;
use ozols::synthesis::structure::listed::hinged_structures;
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::sync::LazyLock;
use std::time::Instant;

/// A chain in canonical numbering with its automorphisms.
type Named = (Chain, Vec<Vec<usize>>);

/// Structures of some symmetries.
struct Kind {
    name: String,
    spec: Spec,
}

impl Kind {
    fn new(symmetries: &str) -> Kind {
        let mut spec = Spec::default();
        if symmetries != "all" {
            let named = |word: &str| Symmetry::ALL.into_iter().find(|(_, w)| *w == word);
            let all = symmetries
                .split(',')
                .map(|word| named(word).expect("a symmetry"));
            spec.symmetries = all.map(|(symmetry, _)| symmetry).collect();
        }
        let name = symmetries.to_owned();
        Kind { name, spec }
    }

    fn of_chain(&self, (chain, automorphisms): &Named) -> Vec<Structure> {
        let forms = self.spec.hinged_forms();
        let subject = Subject::new(chain, automorphisms);
        let mut all = hinged_structures(&subject, self.spec.jaws, &forms);
        // Nearly all generic ones move, of symmetric ones few.
        if self.name != "all" {
            all.retain(|s| s.hinged_lay().is_ok());
        }
        all
    }
}

/// What was measured of one number of links; times in seconds.
struct Measured {
    kind: String,
    links: usize,
    chains: usize,
    structures: usize,
    listing: f64,
    /// Chains and inputs of generic structures.
    pairs: usize,
    /// To search one, of those that the structures have that were looked at.
    of_pair: Vec<f64>,
    /// Of each structure that was looked at: to lay it out, follow it, search it. Without a layout, what it took to find none.
    each: Vec<[f64; 3]>,
    /// How many of these have a layout.
    laid: usize,
    /// How many of these have exact counts.
    exact: usize,
}

const STAGES: [&str; 3] = ["layout", "stroke", "search and ideas"];

/// What the thread has worked, in seconds, whatever else runs on the machine; on the clock where the system does not say.
fn now() -> f64 {
    static BEGUN: LazyLock<Instant> = LazyLock::new(Instant::now);
    let scheduled = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let worked = scheduled.and_then(|s| s.split(' ').next()?.parse::<f64>().ok());
    worked.map_or_else(|| BEGUN.elapsed().as_secs_f64(), |ns| 1e-9 * ns)
}

fn since(begun: f64) -> f64 {
    now() - begun
}

/// All structures, or so many drawn evenly: places in the list of all, of which `ends` has where each chain's end.
fn places(ends: &[usize], sample: usize) -> Vec<usize> {
    let count = ends.last().copied().unwrap_or(0);
    if count <= sample {
        return (0..count).collect();
    }
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut draw = || usize::try_from(random.next_u64() % count as u64).expect("an index");
    let mut out = BTreeSet::new();
    while out.len() < sample {
        out.insert(draw());
    }
    out.into_iter().collect()
}

fn measured(kind: &Kind, links: usize, sample: usize) -> Measured {
    let begun = now();
    let all: Vec<Named> = list_chains(links, 1)
        .expect("listed")
        .iter()
        .map(Chain::canonical_form)
        .collect();
    let (mut ends, mut pairs) = (Vec::with_capacity(all.len()), 0);
    for c in &all {
        let of_chain = kind.of_chain(c);
        ends.push(ends.last().unwrap_or(&0) + of_chain.len());
        pairs += of_chain
            .iter()
            .filter_map(InputPair::of_structure)
            .collect::<BTreeSet<_>>()
            .len();
    }
    let listing = since(begun);
    let (mut each, mut of_pair, mut laid, mut exact) = (Vec::new(), Vec::new(), 0, 0);
    for place in places(&ends, sample) {
        let of = ends.partition_point(|end| *end <= place);
        let before = if of == 0 { 0 } else { ends[of - 1] };
        let structure = kind.of_chain(&all[of]).swap_remove(place - before);
        let begun = now();
        let general = General::search_general(&structure, &kind.spec).expect("a search");
        if general.is_some() {
            of_pair.push(since(begun));
        }
        let (times, counts) = one(&structure, &kind.spec, general.as_ref());
        each.push(times);
        laid += usize::from(counts.is_some());
        exact += usize::from(counts == Some(true));
    }
    Measured {
        kind: kind.name.clone(),
        links,
        chains: all.len(),
        structures: ends.last().copied().unwrap_or(0),
        listing,
        pairs,
        of_pair,
        each,
        laid,
        exact,
    }
}

/// What a structure takes, and where it has a layout, whether its counts are exact.
fn one(structure: &Structure, spec: &Spec, general: Option<&General>) -> ([f64; 3], Option<bool>) {
    let begun = now();
    let Ok(laid) = lay_out(structure, &spec.layout_limits(), spec.seed) else {
        return ([since(begun), 0.0, 0.0], None);
    };
    let to_lay = since(begun);
    let begun = now();
    layout_figures(structure, &laid).expect("a regular pose");
    let to_follow = since(begun);
    let begun = now();
    let row = row_of_pair(structure, spec, general).expect("a row");
    let rest = since(begun) - to_lay - to_follow;
    let exact = row.laid.ok().map(|l| l.exact);
    ([to_lay, to_follow, rest.max(0.0)], exact)
}

impl Measured {
    fn mean(&self, stage: usize) -> f64 {
        self.each.iter().map(|e| e[stage]).sum::<f64>() / self.each.len().max(1) as f64
    }

    /// What the search of a chain and input takes.
    fn pair(&self) -> f64 {
        self.of_pair.iter().sum::<f64>() / self.of_pair.len().max(1) as f64
    }

    fn is_sample(&self) -> bool {
        self.each.len() < self.structures
    }

    /// What all of them would take with the listing, in hours of one thread, and the standard error of that.
    fn whole(&self) -> (f64, f64) {
        let n = self.each.len().max(1) as f64;
        let times: Vec<f64> = self.each.iter().map(|e| e.iter().sum()).collect();
        let mean = times.iter().sum::<f64>() / n;
        let squares: f64 = times.iter().map(|t| (t - mean).powi(2)).sum();
        let of_mean = (squares / (n - 1.0).max(1.0) / n).sqrt();
        let of_all = self.structures as f64;
        let pairs = self.pairs as f64 * self.pair();
        let error = if self.is_sample() {
            of_mean * of_all
        } else {
            0.0
        };
        (
            (self.listing + pairs + mean * of_all) / 3600.0,
            error / 3600.0,
        )
    }

    fn row(&self) -> String {
        let ms = |stage| 1e3 * self.mean(stage);
        let (hours, error) = self.whole();
        format!(
            "| {} | {} | {} | {} | {:.2} s | {} | {} | {} | {:.1} ms | {:.1} ms | {:.1} ms | {} of {:.1} ms | {} |\n",
            self.kind,
            self.links,
            self.chains,
            self.structures,
            self.listing,
            if self.is_sample() {
                format!("a sample of {}", self.each.len())
            } else {
                "all".to_owned()
            },
            self.laid,
            self.exact,
            ms(0),
            ms(1),
            ms(2),
            self.pairs,
            1e3 * self.pair(),
            if self.is_sample() {
                format!("{hours:.2} ± {error:.2} h")
            } else {
                format!("{hours:.4} h")
            },
        )
    }
}

const HEAD: &str = "| kind | links | chains | structures | listed in | looked at | laid out | counts exact | layout | stroke | search and ideas | chains and inputs | all of them |\n\
                    |---|---|---|---|---|---|---|---|---|---|---|---|---|\n";

/// What stands for all where it was a sample.
fn sampled<'a>(all: impl Iterator<Item = &'a Measured>) -> String {
    let mut out = String::new();
    for m in all.filter(|m| m.is_sample()) {
        let (n, of) = (m.each.len(), m.structures);
        let _ = write!(
            out,
            " {}, {} links: {n} of {of} looked at.",
            m.kind, m.links
        );
    }
    out
}

fn by_links(label: &str, title: String, subtitle: String, series: Vec<Series>) -> Chart {
    let axis = |label: &str, scale| Axis {
        label: label.to_owned(),
        scale,
    };
    Chart {
        title,
        subtitle,
        x: axis("links", Scale::Linear),
        y: axis(label, Scale::Log),
        series,
    }
}

/// What one structure of the first kind costs.
fn chart_of_one(all: &[Measured]) -> Chart {
    let kind = &all[0].kind;
    let ours = || all.iter().filter(|m| m.kind == *kind);
    let series = STAGES.iter().enumerate().map(|(stage, name)| Series {
        name: (*name).to_owned(),
        points: ours()
            .map(|m| (m.links as f64, 1e3 * m.mean(stage)))
            .collect(),
        style: Style::Line,
    });
    by_links(
        "time, ms",
        "What a structure costs".to_owned(),
        format!("Mean, processor time.{}", sampled(ours())),
        series.collect(),
    )
}

/// What all structures of each kind cost.
fn chart_of_all(all: &[Measured], kinds: &[Kind]) -> Chart {
    let series = kinds.iter().map(|k| Series {
        name: k.name.clone(),
        points: all
            .iter()
            .filter(|m| m.kind == k.name)
            .map(|m| (m.links as f64, m.whole().0))
            .collect(),
        style: Style::Line,
    });
    by_links(
        "time, h",
        "What a catalogue of all structures costs".to_owned(),
        format!("Processor time.{}", sampled(all.iter())),
        series.collect(),
    )
}

fn main() {
    let (mut links, mut sample, mut folder) = (4..=10, 40, None);
    let mut kinds = vec![Kind::new("all"), Kind::new("mirror")];
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        let mut value = || {
            words
                .next()
                .unwrap_or_else(|| panic!("{word} needs a value"))
        };
        match word.as_str() {
            "--links" => {
                links = parse_range(&value())
                    .map(|r| r.to_owned())
                    .expect("links, such as 4..12")
            }
            "--sample" => sample = value().parse().expect("a number"),
            "--symmetry" => kinds = vec![Kind::new(&value())],
            "-o" => folder = Some(PathBuf::from(value())),
            // What cargo adds.
            "--bench" => {}
            other => panic!("{other}: -o DIR, --links N..M, --sample N or --symmetry WORDS"),
        }
    }
    let one = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread");
    let mut all = Vec::new();
    print!("{HEAD}");
    for kind in &kinds {
        for n in links.clone().filter(|n| n % 2 == 0) {
            let m = one.install(|| measured(kind, n, sample));
            print!("{}", m.row());
            // No gripper of four links is its own mirror image.
            if m.structures > 0 {
                all.push(m);
            }
        }
    }
    if let Some(folder) = folder.filter(|_| !all.is_empty()) {
        let table: String = all.iter().map(Measured::row).collect();
        std::fs::create_dir_all(&folder).expect("the folder");
        let write = |name: &str, text: String| {
            std::fs::write(folder.join(name), text).expect("the folder can be written to");
        };
        write("structures.md", format!("{HEAD}{table}"));
        write("structures.svg", chart_of_one(&all).svg());
        write("catalogues.svg", chart_of_all(&all, &kinds).svg());
    }
}
