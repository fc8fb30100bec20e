//! Counts and lists of chains and of their grippers for people, and as data.

use crate::chains::census::{Census, Counted, DriveKind, Grippers, Kinds};
use crate::chains::chain::Chain;
use crate::chains::graph6;
use crate::chains::roles::Subject;
use crate::view::catalog::query::bare_value;
use crate::view::prelude::*;
use serde_json::Map;
use std::collections::BTreeMap;

/// A row of counts: the keys are a stable contract, in their order.
pub type CountRow = Map<String, Value>;

fn row_of(cells: Value) -> CountRow {
    cells.as_object().cloned().unwrap_or_default()
}

/// The counts of chains of hinges, each a key and its name: those of chains, of grippers with two jaws, and of grippers with three.
const OF_HINGES: &str = "\
chains: chains
frames: with a frame
inputs: with an input joint
drives: with a drive
two_jaws: grippers of two jaws
essential:   essential
both_jaws_float:     both jaws float
one_jaw_at_frame:     one at the frame
both_jaws_at_frame:     both at the frame
truss_with_part:     truss with the part
graph_symmetric:     graph symmetric
mirror_possible:     mirror, sliding input
half_turn_possible:     half turn, turning input
three_jaws: grippers of three jaws
three_essential:   essential
three_symmetric:     graph symmetric
threefold_possible:     threefold, turning input";
const TWO_JAWS: [Counted; 9] = [
    Counted::All,
    Counted::Essential,
    Counted::Floating,
    Counted::OneAtFrame,
    Counted::BothAtFrame,
    Counted::Truss,
    Counted::GraphSymmetric,
    Counted::Mirror,
    Counted::HalfTurn,
];
const THREE_JAWS: [Counted; 4] = [
    Counted::All,
    Counted::Essential,
    Counted::GraphSymmetric,
    Counted::Threefold,
];

/// Returns the keys of counts with their names.
fn keys_and_names(text: &'static str) -> impl Iterator<Item = (&'static str, &'static str)> {
    text.lines().filter_map(|line| line.split_once(": "))
}

/// Returns the row of one number of links. Without a census, it has only the number of chains.
pub fn hinged_row(links: usize, mobility: usize, chains: u64, census: Option<&Census>) -> CountRow {
    let of = |count: fn(&Census) -> u64| census.map(count);
    let counted = [
        Some(chains),
        of(|c| c.frames),
        of(|c| c.inputs),
        of(|c| c.inputs_at_frame),
    ];
    let grippers = |jaws, all: &'static [Counted]| {
        let own = census.and_then(|c| c.grippers.get(&DriveKind::of_hinges(jaws)));
        all.iter().map(move |of| Some(own?[*of]))
    };
    let counted = counted.into_iter().chain(grippers(2, &TWO_JAWS));
    let counted = counted.chain(grippers(3, &THREE_JAWS));
    let counted = keys_and_names(OF_HINGES).zip(counted);
    let mut row = row_of(json!({ "links": links, "mobility": mobility }));
    row.extend(counted.map(|((key, _), n)| (key.to_owned(), json!(n))));
    row
}

const HINGED_LEGEND: &str = "\
Counted up to isomorphism.
Drive: a frame, and a driver joined to it. Jaws are neither.
Essential: no smaller mobile subchain contains frame, driver and jaws.
Truss: with a part hinged to both jaws the chain is rigid and has no rigid subchain.
Graph symmetric: swapping the jaws twice, or carrying three round once, changes nothing, frame and driver in place.
Mirror, half turn, threefold: placed symmetrically and otherwise generically (random modulo a prime), the chain has one motion, in which the input and the jaws move, the jaws relative to each other.
";

/// Returns a table with a column for each number of links, without rows that have no counts.
pub fn hinged_text(all: &[CountRow], width: Option<u16>) -> String {
    let heads = all
        .iter()
        .map(|row| format!(" | {} links", row["links"]))
        .collect::<String>();
    let cell = |n: Option<u64>| n.map_or_else(|| "-".to_owned(), group_thousands);
    let rows = keys_and_names(OF_HINGES).filter_map(|(key, name)| {
        let of = all.iter().map(|row| row[key].as_u64()).collect_vec();
        let counted = of.iter().any(Option::is_some);
        let cells = of.into_iter().map(cell);
        counted.then(|| std::iter::once(name.to_owned()).chain(cells).collect())
    });
    format!(
        "{}\n\n{}",
        text_table(&heads, rows, width),
        fit_lines(HINGED_LEGEND, width)
    )
}

/// Returns the row of a chain in canonical numbering. Its assortment is its links by their number of joints: "4x2 4x3".
pub fn chain_row(chain: &Chain) -> CountRow {
    let degrees = (0..chain.links())
        .map(|u| {
            (0..chain.links())
                .filter(|&v| chain.is_joined(u, v))
                .count()
        })
        .counts();
    let some = degrees.into_iter().sorted();
    let assortment = some
        .map(|(joints, links)| format!("{links}x{joints}"))
        .join(" ");
    let automorphisms = chain.canonical_form().1;
    let c = Census::of_hinges(&Subject::new(chain, &automorphisms), false);
    row_of(json!({
        "code": graph6::write_graph(chain),
        "links": chain.links(),
        "joints": chain.joints().len(),
        "mobility": chain.mobility(),
        "assortment": assortment,
        "automorphisms": automorphisms.len(),
        "frames": c.frames,
        "inputs": c.inputs,
        "drives": c.inputs_at_frame,
    }))
}

/// Returns a table of chains.
pub fn chains_text(all: &[CountRow], width: Option<u16>) -> String {
    let heads = "chain | joints | links | symmetries | frames | inputs | drives";
    let keys = [
        "code",
        "joints",
        "assortment",
        "automorphisms",
        "frames",
        "inputs",
        "drives",
    ];
    let rows = all
        .iter()
        .map(|row| keys.iter().map(|key| bare_value(&row[*key])).collect());
    let note = "Chain: graph6 of the canonical numbering. Links: 4x2 are four with two joints.\n";
    format!(
        "{}\n\n{}",
        text_table(heads, rows, width),
        fit_lines(note, width)
    )
}

/// The four places of an input and the jaws, in the order of columns: at the frame or between, apart or driven.
const PLACES: [(bool, bool); 4] = [(false, false), (false, true), (true, false), (true, true)];
/// The counts of grippers of pairs, each a key and its name.
const OF_PAIRS: &str = "\
two_jaws: all
essential: essential
translating:   both jaws only translate
graph_symmetric:   graph symmetric
mirror:   mirror
mirror_but_input:   mirror except for the input
half_turn:   half turn
half_turn_but_input:   half turn except for the input";
const PAIRED: [Counted; 8] = [
    Counted::All,
    Counted::Essential,
    Counted::Translating,
    Counted::GraphSymmetric,
    Counted::Mirror,
    Counted::MirrorButInput,
    Counted::HalfTurn,
    Counted::HalfTurnButInput,
];

fn either_word(holds: bool, [yes, no]: [&'static str; 2]) -> &'static str {
    if holds { yes } else { no }
}

/// Returns the rows of one number of links, one for each choice of kinds and drive. The counts of chains are repeated for each drive.
pub fn pair_rows(links: usize, all: &BTreeMap<Kinds, Census>) -> Vec<CountRow> {
    let drives = PLACES.into_iter().cartesian_product([false, true]);
    let row = |kinds: &Kinds, c: &Census, ((between, jaw), slides): ((bool, bool), bool)| {
        let drive = DriveKind {
            jaws: 2,
            between,
            jaw,
            slides,
        };
        let g = c.grippers.get(&drive).copied().unwrap_or_default();
        let mut row = row_of(json!({
            "links": links,
            "slides": kinds.slides,
            "gears": kinds.gears,
            "slots": kinds.slots,
            "two_slots": kinds.two_slots,
            "chains": c.chains,
            "frames": c.frames,
            "inputs_at_frame": c.inputs_at_frame,
            "inputs_between": c.inputs_between,
            "place": either_word(between, ["between", "frame"]),
            "jaws": either_word(jaw, ["driven", "apart"]),
            "input": either_word(slides, ["slide", "turn"]),
        }));
        let grippers = keys_and_names(OF_PAIRS).zip(PAIRED);
        row.extend(grippers.map(|((key, _), of)| (key.to_owned(), json!(g[of]))));
        row
    };
    let rows = all.iter().cartesian_product(drives);
    rows.map(|((kinds, c), drive)| row(kinds, c, drive))
        .collect()
}

const PAIR_LEGEND: &str = "\
Counted up to isomorphism. Hinges, slides and two slots between the same links leave one freedom; gear pairs, racks, and slots (pins in slots, cams, wedges) leave two.
A chain has one motion in nearly all places, in which every two links move; a gear pair has a carrier.
Columns: the input, a hinge or a slide, is at the frame or between two moving links; a jaw is one of its links (driven), or apart from it.
Essential: no smaller mobile subchain contains frame, input joint and jaws; the rows below it count only these.
Only translate: both jaws keep their attitude in nearly all places. Graph symmetric: swapping the jaws changes nothing, frame
and input joint in place. Mirror, half turn: they move so if placed symmetrically and otherwise generically (random modulo a prime).
";

/// Returns the counts of each number of links as a paragraph and a table.
pub fn pair_text(all: &[(usize, BTreeMap<Kinds, Census>)], width: Option<u16>) -> String {
    let mut out = String::new();
    for (links, cells) in all {
        let mut sum = Census::default();
        cells.values().cloned().for_each(|c| sum += c);
        out += &fit_lines(&pair_headline(*links, &sum), width);
        out.push('\n');
        if !sum.grippers.is_empty() {
            out += &format!("\n{}\n\n", gripper_table(&sum, width));
        }
    }
    out + &fit_lines(PAIR_LEGEND, width)
}

fn pair_headline(links: usize, sum: &Census) -> String {
    let [chains, frames, at_frame, between] = [
        sum.chains,
        sum.frames,
        sum.inputs_at_frame,
        sum.inputs_between,
    ]
    .map(group_thousands);
    format!(
        "{links} links: {chains} chains, {frames} with a frame; with an input joint {at_frame} at the frame, {between} between \
         moving links."
    )
}

fn gripper_table(sum: &Census, width: Option<u16>) -> String {
    let columns = PLACES.map(|(between, jaw)| {
        let mut of = Grippers::default();
        let own = |d: &&DriveKind| (d.between, d.jaw) == (between, jaw);
        let drives = sum.grippers.keys().filter(own);
        drives.for_each(|d| of += sum.grippers[d]);
        of
    });
    let heads = PLACES.map(|(between, jaw)| {
        let place = either_word(between, ["between", "at frame"]);
        format!("{place}, {}", either_word(jaw, ["driven", "apart"]))
    });
    let heads = format!("grippers of two jaws | {}", heads.join(" | "));
    let rows = keys_and_names(OF_PAIRS).zip(PAIRED).map(|((_, name), of)| {
        let cells = columns.iter().map(|g| group_thousands(g[of]));
        std::iter::once(name.to_owned()).chain(cells).collect()
    });
    text_table(&heads, rows, width)
}
