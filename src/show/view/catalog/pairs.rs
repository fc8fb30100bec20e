//! Counts of chains of pairs and of their grippers for people, and as data.

use crate::chains::pairs::census::{DriveKind, Kinds, PairCensus, PairGrippers};
use crate::chains::pairs::symmetric_census::SymmetricKind;
use crate::format::grouped;
use crate::view::terminal::layout::{fit, table};
use itertools::Itertools;
use serde::Serialize;
use std::collections::BTreeMap;

/// The four places of an input and the jaws, in the order of columns: at the frame or between, apart or driven.
const PLACES: [(bool, bool); 4] = [(false, false), (false, true), (true, false), (true, true)];

/// Counts of one number of links, kinds of pairs and drive: the keys are a stable contract, in this order. What is told of
/// chains is the same in each row of one number of links and kinds.
#[derive(Debug, Clone, Serialize)]
pub struct PairCountsData {
    links: usize,
    slides: usize,
    gears: usize,
    slots: usize,
    two_slots: usize,
    chains: u64,
    frames: u64,
    inputs_at_frame: u64,
    inputs_between: u64,
    /// `frame` or `between`: where the input joint is.
    place: &'static str,
    /// `apart` or `driven`: whether a jaw is a link of the input joint.
    jaws: &'static str,
    /// `turn` or `slide`: what the input joint is.
    input: &'static str,
    two_jaws: u64,
    essential: u64,
    translating: u64,
    graph_symmetric: u64,
    mirror: u64,
    mirror_but_input: u64,
    half_turn: u64,
    half_turn_but_input: u64,
}

/// A word where something holds, and another where it does not.
fn word(holds: bool, [yes, no]: [&'static str; 2]) -> &'static str {
    if holds { yes } else { no }
}

/// The rows of counts of one number of links, one for each kind of drive.
#[must_use]
pub fn pair_rows(links: usize, all: &BTreeMap<Kinds, PairCensus>) -> Vec<PairCountsData> {
    let drives = PLACES.into_iter().cartesian_product([false, true]);
    let drives = drives.map(|((between, jaw), slides)| DriveKind {
        between,
        jaw,
        slides,
    });
    let drives = drives.collect_vec();
    let row = |kinds: &Kinds, c: &PairCensus, drive: DriveKind| {
        let g = c.grippers.get(&drive).copied().unwrap_or_default();
        PairCountsData {
            links,
            slides: kinds.slides,
            gears: kinds.gears,
            slots: kinds.slots,
            two_slots: kinds.two_slots,
            chains: c.chains,
            frames: c.frames,
            inputs_at_frame: c.inputs_at_frame,
            inputs_between: c.inputs_between,
            place: word(drive.between, ["between", "frame"]),
            jaws: word(drive.jaw, ["driven", "apart"]),
            input: word(drive.slides, ["slide", "turn"]),
            two_jaws: g.all,
            essential: g.essential,
            translating: g.translating,
            graph_symmetric: g.graph_symmetric,
            mirror: g.mirror,
            mirror_but_input: g.mirror_but_input,
            half_turn: g.half_turn,
            half_turn_but_input: g.half_turn_but_input,
        }
    };
    let rows = all.iter().cartesian_product(drives);
    rows.map(|((kinds, c), drive)| row(kinds, c, drive))
        .collect()
}

const LEGEND: &str = "\
All up to isomorphism; hinges, slides and two slots between the same links leave one freedom, gear pairs (racks, too) and slots (pins in slots, cams, wedges) two.
A chain has one motion in nearly all places, in which every two links move; a gear pair has a carrier.
Columns: the input, a hinge or a slide, is at the frame or between two moving links; a jaw is one of its links (driven), or apart from it.
Essential: no smaller moving part holds frame, input joint and jaws; what stands below counts these alone.
Only translate: both jaws keep their attitude in nearly all places. Graph symmetric: swapping the jaws changes nothing, frame
and input joint in place. Mirror, half turn: they move so in places so symmetric, otherwise generic (drawn at random modulo a prime).
";

/// Counts of each number of links as a paragraph and a table.
#[must_use]
pub fn pair_text(all: &[(usize, BTreeMap<Kinds, PairCensus>)], width: Option<u16>) -> String {
    let mut out = String::new();
    for (links, cells) in all {
        let mut sum = PairCensus::default();
        cells.values().cloned().for_each(|c| sum += c);
        out += &fit(&headline(*links, &sum), width);
        out.push('\n');
        if !sum.grippers.is_empty() {
            out += &format!("\n{}\n\n", grippers(&sum, width));
        }
    }
    out + &fit(LEGEND, width)
}

fn headline(links: usize, sum: &PairCensus) -> String {
    let [chains, frames, at_frame, between] = [
        sum.chains,
        sum.frames,
        sum.inputs_at_frame,
        sum.inputs_between,
    ]
    .map(grouped);
    format!(
        "{links} links: {chains} chains, {frames} with a frame; with an input joint {at_frame} at the frame, {between} between \
         moving links."
    )
}

/// A row of the table: its head, and which count it has.
type Figure = (&'static str, fn(&PairGrippers) -> u64);

fn grippers(sum: &PairCensus, width: Option<u16>) -> String {
    let columns = PLACES.map(|(between, jaw)| {
        let mut of = PairGrippers::default();
        let own = |d: &&DriveKind| (d.between, d.jaw) == (between, jaw);
        let drives = sum.grippers.keys().filter(own);
        drives.for_each(|d| of += sum.grippers[d]);
        of
    });
    let heads = PLACES.map(|(between, jaw)| {
        let place = word(between, ["between", "at frame"]);
        format!("{place}, {}", word(jaw, ["driven", "apart"]))
    });
    let heads = std::iter::once("grippers of two jaws").chain(heads.iter().map(String::as_str));
    let figures: [Figure; 8] = [
        ("all", |g| g.all),
        ("essential", |g| g.essential),
        ("  both jaws only translate", |g| g.translating),
        ("  graph symmetric", |g| g.graph_symmetric),
        ("  mirror", |g| g.mirror),
        ("  mirror but for the input", |g| g.mirror_but_input),
        ("  half turn", |g| g.half_turn),
        ("  half turn but for the input", |g| g.half_turn_but_input),
    ];
    let rows = figures.into_iter().map(|(name, of)| {
        let cells = columns.iter().map(|g| grouped(of(g)));
        std::iter::once(name.to_owned()).chain(cells).collect()
    });
    table(&heads.collect_vec(), rows.collect(), width)
}

/// Counts of symmetric grippers of one number of links: the keys are a stable contract, in this order.
#[derive(Debug, Clone, Serialize)]
pub struct SymmetricCountsData {
    links: usize,
    /// `mirror` or `half-turn`.
    symmetry: &'static str,
    /// `apart` or `driven`.
    jaws: &'static str,
    /// Pairs that are not hinges, a left and a right one counted once.
    orbits: usize,
    essential: u64,
}

/// The rows of counts of one number of links, those that are nothing, too.
#[must_use]
pub fn symmetric_rows(
    links: usize,
    most: usize,
    counts: &BTreeMap<SymmetricKind, u64>,
) -> Vec<SymmetricCountsData> {
    let ways = PLACES.into_iter().cartesian_product(0..=most);
    let row = |((half_turn, driven_jaw), orbits)| {
        let kind = SymmetricKind {
            half_turn,
            driven_jaw,
            orbits,
        };
        SymmetricCountsData {
            links,
            symmetry: word(half_turn, ["half-turn", "mirror"]),
            jaws: word(driven_jaw, ["driven", "apart"]),
            orbits,
            essential: counts.get(&kind).copied().unwrap_or_default(),
        }
    };
    ways.map(row).collect()
}

const SYMMETRIC_LEGEND: &str = "\
Essential grippers of two jaws whose input joint is its own image, up to isomorphism, by their pairs that are no hinges: a left
and a right one are one choice. Driven: a jaw is a link of the input joint.
";

/// A table with a row for each symmetry and number of choices, a column for each number of links.
#[must_use]
pub fn symmetric_text(all: &[SymmetricCountsData], width: Option<u16>) -> String {
    let links = all.iter().map(|c| c.links).unique().collect_vec();
    let heads = links.iter().map(|n| format!("{n} links")).collect_vec();
    let first = ["symmetry", "jaws", "choices"];
    let heads = first.into_iter().chain(heads.iter().map(String::as_str));
    let key = |c: &&SymmetricCountsData| (c.symmetry, c.jaws, c.orbits);
    let rows = all.iter().map(|c| key(&c)).unique().map(|own| {
        let (symmetry, jaws, orbits) = own;
        let words = [symmetry.to_owned(), jaws.to_owned(), orbits.to_string()];
        let cells = all.iter().filter(|c| key(c) == own);
        let cells = cells.map(|c| grouped(c.essential));
        words.into_iter().chain(cells).collect_vec()
    });
    format!(
        "{}\n\n{}",
        table(&heads.collect_vec(), rows.collect(), width),
        fit(SYMMETRIC_LEGEND, width)
    )
}
