//! What structure a mechanism has, for people and as data.

use crate::catalog::find::Entry;
use crate::catalog::neighbours::{BetterFigure, FIGURES, Neighbour};
use crate::chains::PairKind;
use crate::chains::census::Kinds;
use crate::chains::classics::{Classic, classics_of};
use crate::chains::motion::moves_throughout;
use crate::chains::roles::{Roles, Subject, Symmetries};
use crate::chains::structure::PairStructure;
use crate::synthesis::recognize::Recognized;
use crate::view::prelude::*;

/// What a mechanism is as a structure: the keys are a stable contract, in this order.
#[derive(Debug, Clone, Serialize)]
pub struct FoundData {
    /// The same for two mechanisms exactly where their structures are the same.
    name: String,
    /// 2; 3 where there are three sides that are alike, of which what follows has two; 1 where three jaws are not.
    sides: usize,
    links: usize,
    hinges: usize,
    slides: usize,
    gears: usize,
    slots: usize,
    /// Whether what turns by them is a screw, and they are nuts on its threads.
    threaded: bool,
    /// `frame` or `between`.
    place: &'static str,
    /// `turn` or `slide`.
    input: &'static str,
    /// `apart` or `driven`.
    jaws: &'static str,
    /// Whether it has one motion in nearly all places, in which every two links move, and gears have carriers; what stands
    /// below is null where it has not.
    in_count: bool,
    essential: Option<bool>,
    /// The links of the smaller part that holds all roles, where there is one.
    essential_part: Option<Vec<String>>,
    translating: Option<bool>,
    mirror: Option<bool>,
    mirror_but_input: Option<bool>,
    half_turn: Option<bool>,
    half_turn_but_input: Option<bool>,
    /// Well-known schemes of this structure, or where it is not essential of its essential part.
    classics: Vec<&'static Classic>,
    /// Entries of the catalogue that was asked; null where none was.
    catalogue: Option<Vec<Entry>>,
    /// What of that catalogue is next to it: the most gain first.
    neighbours: Option<Vec<Neighbour>>,
}

/// What a catalogue has of a structure.
#[derive(Debug, Clone)]
pub struct InCatalogue {
    /// The structure itself, or its essential part.
    pub entries: Vec<Entry>,
    /// What is next to it.
    pub neighbours: Vec<Neighbour>,
}

impl FoundData {
    /// Of a mechanism's structure and the smallest part of it that holds all roles, given by its links, with what a catalogue has
    /// of this part, where one was asked.
    pub fn new(found: &Recognized, part: &[usize], known: Option<InCatalogue>) -> FoundData {
        let PairStructure { chain, roles } = &found.structure;
        let in_count = chain.has_carriers() && moves_throughout(chain);
        let automorphisms = chain.automorphisms();
        let subject = Subject::new(chain, &automorphisms);
        let essential = part.len() == chain.links();
        let threaded = found.made_as.threaded;
        let symmetries = in_count.then(|| symmetries(&subject, roles, threaded));
        let flat = if found.made_as.flat {
            chain.flat_slots().len()
        } else {
            0
        };
        let kinds = Kinds::of_chain(chain).with_flat(flat);
        let slides = found.structure.slides();
        let names = || part.iter().map(|&l| found.names[l].join("+")).collect();
        let key = found.structure.part(part).key();
        let classics = classics_of(&key, found.made_as);
        let (entries, neighbours) = known.map(|k| (k.entries, k.neighbours)).unzip();
        FoundData {
            name: found.structure.name(),
            sides: found.sides(),
            links: chain.links(),
            hinges: chain.count(PairKind::Hinge),
            slides: kinds.slides,
            gears: kinds.gears,
            slots: kinds.slots_made(),
            threaded,
            place: if roles.is_driven_from_frame() {
                "frame"
            } else {
                "between"
            },
            input: if slides { "slide" } else { "turn" },
            jaws: if roles.has_driven_jaw() {
                "driven"
            } else {
                "apart"
            },
            in_count,
            essential: in_count.then_some(essential),
            essential_part: (in_count && !essential).then(names),
            translating: in_count.then(|| subject.is_translating(roles)),
            mirror: symmetries.map(|s| s.mirror),
            mirror_but_input: symmetries.map(|s| s.mirror_but_input),
            half_turn: symmetries.map(|s| s.half_turn),
            half_turn_but_input: symmetries.map(|s| s.half_turn_but_input),
            classics: classics.collect(),
            catalogue: entries,
            neighbours,
        }
    }

    /// Whether something is known by it: a well-known scheme, or an entry of the catalogue asked.
    pub fn is_known(&self) -> bool {
        !self.classics.is_empty() || self.catalogue.as_ref().is_some_and(|c| !c.is_empty())
    }
}

/// How a structure is symmetric: with a screw of both threads it is a mirror image where with a pinion it is one by half a turn.
fn symmetries(subject: &Subject<'_>, roles: &Roles, threaded: bool) -> Symmetries {
    match subject.symmetries(roles) {
        of_pinion if threaded => Symmetries {
            mirror: of_pinion.half_turn,
            mirror_but_input: of_pinion.half_turn_but_input,
            ..Symmetries::default()
        },
        own => own,
    }
}

/// A paragraph on each of structure, scheme and catalogue.
pub fn found_text(name: &str, d: &FoundData, width: Option<u16>) -> String {
    let several = |n: usize, word: &str| match n {
        0 => None,
        1 => Some(format!("1 {word}")),
        _ => Some(format!("{n} {word}s")),
    };
    let pairs = [
        several(d.hinges, "hinge"),
        several(d.slides, "slide"),
        several(d.gears, if d.threaded { "nut" } else { "gear pair" }),
        several(d.slots, "slot"),
    ];
    let place = match d.place {
        "frame" => "at the frame",
        _ => "between moving links",
    };
    let jaws = match d.jaws {
        "driven" => "one of whose links is a jaw",
        _ => "apart from the jaws",
    };
    let input = if d.input == "slide" { "slide" } else { "hinge" };
    let mut out = format!(
        "{name}: {} links, {}. The input is a {input} {place}, {jaws}.\n",
        d.links,
        pairs.into_iter().flatten().join(", ")
    );
    out += match d.sides {
        1 => "It has three jaws.\n",
        3 => "It has three equal sides: all this is of two of them.\n",
        _ => "",
    };
    out += &format!("Structure: {}\n", d.name);
    out += &motion(d);
    for classic in &d.classics {
        out += &format!("Known as {}: {}.\n", classic.id, classic.about);
    }
    if let Some(entries) = &d.catalogue {
        if entries.is_empty() {
            out += "The catalogue does not have it.\n";
        }
        for entry in entries {
            out += &format!(
                "In the catalogue: {}, laid out as {}.\n",
                entry.id, entry.form
            );
        }
    }
    out += &neighbours_text(d.neighbours.as_deref().unwrap_or_default());
    fit(&out, width)
}

/// How it moves in nearly all places.
fn motion(d: &FoundData) -> String {
    if !d.in_count {
        return "In nearly all places of its joints it has no motion, more than one, or two links that keep together, or a gear pair \
             without a carrier: such structures are not counted. It moves by its special shape, if it does.\n"
            .to_owned();
    }
    let essential = match &d.essential_part {
        Some(links) => format!(
            "Not essential: {} alone move input and jaws alike",
            links.join(", ")
        ),
        None => "Essential: no smaller moving part holds frame, input and jaws".to_owned(),
    };
    let flag = |strict: Option<bool>, but: Option<bool>, word: &str| match (strict, but) {
        (Some(true), _) => Some(word.to_owned()),
        (_, Some(true)) => Some(format!("{word} except for the input")),
        _ => None,
    };
    let symmetric = [
        flag(d.mirror, d.mirror_but_input, "mirror"),
        flag(d.half_turn, d.half_turn_but_input, "half turn"),
    ];
    let symmetric = symmetric.into_iter().flatten().join(", ");
    let symmetric = if symmetric.is_empty() {
        "none"
    } else {
        &symmetric
    };
    let jaws = match d.translating {
        Some(true) => "keep their attitude in nearly all places",
        _ => "turn in nearly all places (on parallelograms they do not)",
    };
    format!("{essential}.\nSymmetric layouts: {symmetric}. The jaws {jaws}.\n")
}

/// The maximum number of neighbours in the text; JSON has all.
const NAMED: usize = 8;

/// Returns a line for each of the first neighbours; an empty text if none is better.
fn neighbours_text(all: &[Neighbour]) -> String {
    let useful = all.iter().filter(|n| !n.better.is_empty()).collect_vec();
    if useful.is_empty() {
        return String::new();
    }
    let mut out = String::from(
        "Next to it in the catalogue, and what these do better than each of its layouts:\n",
    );
    for n in useful.iter().take(NAMED) {
        let relation = match n.relation {
            "other-roles" => "other roles".to_owned(),
            "fewer-links" => format!("{} links less", n.links),
            _ => format!("{} links more", n.links),
        };
        let better = n.better.iter().map(said).join("; ");
        out += &format!("  {}, {}, {relation}: {better}\n", n.id, n.form);
    }
    if useful.len() > NAMED {
        let json = flag("json", "");
        out += &format!("  and {} more, which {json} has\n", useful.len() - NAMED);
    }
    out
}

fn said(better: &BetterFigure) -> String {
    let known = FIGURES.iter().find(|f| f.column == better.figure);
    let (name, unit) = known.map_or((better.figure, ""), |f| (f.name, f.unit));
    let space = if unit.is_empty() || unit == "°" {
        ""
    } else {
        " "
    };
    let value = format!("{}{space}{unit}", significant(better.value));
    match better.own {
        Some(own) => format!("{name} {value}, here {} at best", significant(own)),
        None => format!("{name} {value}"),
    }
}
