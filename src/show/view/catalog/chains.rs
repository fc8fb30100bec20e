//! Counts and lists of chains for people, and as data.

use crate::chains::census::Census;
use crate::chains::roles::Subject;
use crate::chains::{Chain, graph6};
use crate::format::grouped;
use crate::view::terminal::layout::{fit, table};
use itertools::Itertools;
use serde::Serialize;

/// Counts of one number of links: the keys are a stable contract, in this order.
#[derive(Debug, Clone, Serialize)]
pub struct CensusData {
    links: usize,
    mobility: usize,
    chains: u64,
    frames: Option<u64>,
    inputs: Option<u64>,
    drives: Option<u64>,
    two_jaws: Option<u64>,
    essential: Option<u64>,
    both_jaws_float: Option<u64>,
    one_jaw_at_frame: Option<u64>,
    both_jaws_at_frame: Option<u64>,
    truss_with_part: Option<u64>,
    graph_symmetric: Option<u64>,
    mirror_possible: Option<u64>,
    half_turn_possible: Option<u64>,
    three_jaws: Option<u64>,
    three_essential: Option<u64>,
    three_symmetric: Option<u64>,
    threefold_possible: Option<u64>,
}

impl CensusData {
    /// Of counts.
    #[must_use]
    pub fn new(links: usize, mobility: usize, c: &Census) -> CensusData {
        let g = c.grippers.as_ref();
        CensusData {
            links,
            mobility,
            chains: c.chains,
            frames: Some(c.frames),
            inputs: Some(c.inputs),
            drives: Some(c.drives),
            two_jaws: g.map(|g| g.two_jaws),
            essential: g.map(|g| g.essential),
            both_jaws_float: g.map(|g| g.jaws_at_frame[0]),
            one_jaw_at_frame: g.map(|g| g.jaws_at_frame[1]),
            both_jaws_at_frame: g.map(|g| g.jaws_at_frame[2]),
            truss_with_part: g.map(|g| g.truss),
            graph_symmetric: g.map(|g| g.symmetric),
            mirror_possible: g.map(|g| g.mirror),
            half_turn_possible: g.map(|g| g.half_turn),
            three_jaws: g.map(|g| g.three_jaws),
            three_essential: g.map(|g| g.three_essential),
            three_symmetric: g.map(|g| g.three_symmetric),
            threefold_possible: g.map(|g| g.threefold),
        }
    }

    /// Of a count of chains alone.
    #[must_use]
    pub fn of_chains(links: usize, mobility: usize, chains: u64) -> CensusData {
        let alone = Census {
            chains,
            ..Census::default()
        };
        CensusData {
            frames: None,
            inputs: None,
            drives: None,
            ..CensusData::new(links, mobility, &alone)
        }
    }

    /// Counts with what they are of, from chains to grippers.
    fn rows(&self) -> Vec<(&'static str, Option<u64>)> {
        vec![
            ("chains", Some(self.chains)),
            ("with a frame", self.frames),
            ("with an input joint", self.inputs),
            ("with a drive", self.drives),
            ("grippers of two jaws", self.two_jaws),
            ("  essential", self.essential),
            ("    both jaws float", self.both_jaws_float),
            ("    one at the frame", self.one_jaw_at_frame),
            ("    both at the frame", self.both_jaws_at_frame),
            ("    truss with the part", self.truss_with_part),
            ("    graph symmetric", self.graph_symmetric),
            ("    mirror, sliding input", self.mirror_possible),
            ("    half turn, turning input", self.half_turn_possible),
            ("grippers of three jaws", self.three_jaws),
            ("  essential", self.three_essential),
            ("    graph symmetric", self.three_symmetric),
            ("    threefold, turning input", self.threefold_possible),
        ]
    }
}

const LEGEND: &str = "\
All up to isomorphism.
Drive: a frame, and a driver joined to it. Jaws are neither.
Essential: no smaller moving part holds frame, driver and jaws.
Truss: with a part hinged to both jaws nothing moves any more, and no smaller part is rigid.
Graph symmetric: swapping the jaws twice, or carrying three round once, changes nothing, frame and driver in place.
Mirror, half turn, threefold: in places so symmetric, otherwise generic (drawn at random modulo a prime), there is one motion; input
and jaws move, and the jaws against each other.
";

/// A table, a column for each number of links; without what was counted of none.
#[must_use]
pub fn census_text(all: &[CensusData], width: Option<u16>) -> String {
    let links = all.iter().map(|c| format!("{} links", c.links));
    let heads: Vec<String> = std::iter::once(String::new()).chain(links).collect();
    let columns = all.iter().map(CensusData::rows).collect_vec();
    let cell = |n: Option<u64>| n.map_or_else(|| "-".to_owned(), grouped);
    let names = columns.first().into_iter().flatten().map(|(name, _)| *name);
    let rows = names.enumerate().filter_map(|(i, name)| {
        let counted = columns.iter().any(|c| c[i].1.is_some());
        let cells = columns.iter().map(|c| cell(c[i].1));
        counted.then(|| std::iter::once(name.to_owned()).chain(cells).collect())
    });
    let heads: Vec<&str> = heads.iter().map(String::as_str).collect();
    format!(
        "{}\n\n{}",
        table(&heads, rows.collect(), width),
        fit(LEGEND, width)
    )
}

/// One chain: the keys are a stable contract, in this order.
#[derive(Debug, Clone, Serialize)]
pub struct ChainData {
    code: String,
    links: usize,
    joints: usize,
    mobility: i64,
    /// Links by their number of joints: "4x2 4x3".
    assortment: String,
    automorphisms: usize,
    frames: u64,
    inputs: u64,
    drives: u64,
}

impl ChainData {
    /// Of a chain in canonical numbering.
    #[must_use]
    pub fn new(chain: &Chain) -> ChainData {
        let degrees = chain.neighbours.iter().map(|x| x.count_ones()).counts();
        let some = degrees.into_iter().sorted();
        let automorphisms = chain.canonical().1;
        let c = Census::of_subject(&Subject::new(chain, &automorphisms), false);
        ChainData {
            code: graph6::write(chain),
            links: chain.links(),
            joints: chain.joint_count(),
            mobility: chain.mobility(),
            assortment: some
                .map(|(joints, links)| format!("{links}x{joints}"))
                .join(" "),
            automorphisms: automorphisms.len(),
            frames: c.frames,
            inputs: c.inputs,
            drives: c.drives,
        }
    }
}

/// A table of chains.
#[must_use]
pub fn chains_text(all: &[ChainData], width: Option<u16>) -> String {
    let heads = [
        "chain",
        "joints",
        "links",
        "symmetries",
        "frames",
        "inputs",
        "drives",
    ];
    let row = |c: &ChainData| {
        let numbers = [c.frames, c.inputs, c.drives].map(|n| n.to_string());
        let first = [c.code.clone(), c.joints.to_string(), c.assortment.clone()];
        let symmetries = c.automorphisms.to_string();
        first
            .into_iter()
            .chain([symmetries])
            .chain(numbers)
            .collect()
    };
    let rows = all.iter().map(row).collect();
    let note = "Chain: graph6 of the canonical numbering. Links: 4x2 are four with two joints.\n";
    format!("{}\n\n{}", table(&heads, rows, width), fit(note, width))
}
