//! The structure of a mechanism, for people and as data.

use crate::catalog::find::Entry;
use crate::chains::PairKind;
use crate::chains::census::Kinds;
use crate::chains::classics::{Classic, classics_of};
use crate::chains::motion::moves_throughout;
use crate::chains::roles::{Roles, Subject, Symmetries};
use crate::chains::structure::PairStructure;
use crate::synthesis::recognize::Recognized;
use crate::view::prelude::*;

/// The structure of a mechanism.
#[derive(Debug)]
pub struct FoundData<'a> {
    found: &'a Recognized,
    /// The links of the smallest part that holds all roles.
    part: &'a [usize],
    /// Whether its jaws only translate, and its symmetries. `None` if it does not have one motion in nearly all places in which
    /// every two links move, or a gear has no carrier.
    motion: Option<(bool, Symmetries)>,
    /// Well-known schemes of this structure, or of its essential part if it is not essential.
    classics: Vec<&'static Classic>,
    /// Its entries in the given catalogue, or those of its essential part.
    known: Option<Vec<Entry>>,
}

impl<'a> FoundData<'a> {
    /// Finds what is known of a mechanism's structure and of the smallest part of it that holds all roles, given by its links.
    pub fn new(found: &'a Recognized, part: &'a [usize], known: Option<Vec<Entry>>) -> Self {
        let PairStructure { chain, roles } = &found.structure;
        let automorphisms = chain.automorphisms();
        let subject = Subject::new(chain, &automorphisms);
        let moves = chain.has_carriers() && moves_throughout(chain);
        let threaded = found.made_as.threaded;
        let symmetries = || layout_symmetries(&subject, roles, threaded);
        let key = found.structure.part_of(part).canonical_key();
        FoundData {
            motion: moves.then(|| (subject.is_translating(roles), symmetries())),
            classics: classics_of(&key, found.made_as).collect(),
            found,
            part,
            known,
        }
    }

    /// Returns true if something is known by it: a well-known scheme, or an entry of the catalogue asked.
    pub fn is_known(&self) -> bool {
        let known = self.known.as_ref();
        !self.classics.is_empty() || known.is_some_and(|k| !k.is_empty())
    }

    /// Returns the number of hinges, slides, gears and slots.
    fn pairs(&self) -> [usize; 4] {
        let chain = &self.found.structure.chain;
        let flat = if self.found.made_as.flat {
            chain.flat_slots().len()
        } else {
            0
        };
        let kinds = Kinds::of_chain(chain).with_flat(flat);
        let hinges = chain.count_pairs(PairKind::Hinge);
        [hinges, kinds.slides, kinds.gears, kinds.slots_made()]
    }

    /// Returns the links of the smaller part that holds all roles, if there is one.
    fn smaller_part(&self) -> Option<Vec<String>> {
        let smaller = self.part.len() < self.found.structure.chain.links();
        let names = self.part.iter().map(|&l| self.found.names[l].join("+"));
        smaller.then(|| names.collect())
    }

    /// Returns all of it as data: the keys are a stable contract, in this order.
    pub fn json(&self) -> Value {
        let (found, roles) = (self.found, &self.found.structure.roles);
        let [hinges, slides, gears, slots] = self.pairs();
        let either = |holds, yes: &'static str, no| if holds { yes } else { no };
        let symmetries = self.motion.map(|m| m.1);
        let smaller = self.motion.and_then(|_| self.smaller_part());
        json!({
            "name": found.structure.name(),
            // 3 if three sides are alike, of which what follows has two; 1 if there are three jaws that are not.
            "sides": found.side_count(),
            "links": found.structure.chain.links(),
            "hinges": hinges,
            "slides": slides,
            "gears": gears,
            "slots": slots,
            // Whether what turns by them is a screw, and they are nuts on its threads.
            "threaded": found.made_as.threaded,
            "place": either(roles.is_driven_from_frame(), "frame", "between"),
            "input": either(found.structure.input_slides(), "slide", "turn"),
            "jaws": either(roles.has_driven_jaw(), "driven", "apart"),
            "in_count": self.motion.is_some(),
            "essential": self.motion.map(|_| smaller.is_none()),
            "essential_part": smaller,
            "translating": self.motion.map(|m| m.0),
            "mirror": symmetries.map(|s| s.mirror),
            "mirror_but_input": symmetries.map(|s| s.mirror_but_input),
            "half_turn": symmetries.map(|s| s.half_turn),
            "half_turn_but_input": symmetries.map(|s| s.half_turn_but_input),
            "classics": self.classics,
            "catalogue": self.known,
        })
    }

    /// Returns a paragraph on each of structure, scheme and catalogue.
    pub fn text(&self, name: &str, width: Option<u16>) -> String {
        let (found, roles) = (self.found, &self.found.structure.roles);
        let nut = if found.made_as.threaded {
            "nut"
        } else {
            "gear pair"
        };
        let nouns = self
            .pairs()
            .into_iter()
            .zip(["hinge", "slide", nut, "slot"]);
        let pairs = nouns
            .filter(|(n, _)| *n > 0)
            .map(|(n, noun)| count_noun(n, noun));
        let input = if found.structure.input_slides() {
            "slide"
        } else {
            "hinge"
        };
        let place = if roles.is_driven_from_frame() {
            "at the frame"
        } else {
            "between moving links"
        };
        let jaws = if roles.has_driven_jaw() {
            "one of whose links is a jaw"
        } else {
            "apart from the jaws"
        };
        let mut out = Report::new(width);
        out.add_line(format!(
            "{name}: {} links, {}. The input is a {input} {place}, {jaws}.",
            found.structure.chain.links(),
            pairs.format(", ")
        ));
        match found.side_count() {
            1 => out.add_line("It has three jaws."),
            3 => out.add_line("It has three equal sides: all this is of two of them."),
            _ => {}
        }
        out.add_line(format!("Structure: {}", found.structure.name()));
        out.add_line(self.motion_text());
        for classic in &self.classics {
            out.add_line(format!("Known as {}: {}.", classic.id, classic.about));
        }
        let Some(known) = &self.known else {
            return out.text();
        };
        if known.is_empty() {
            out.add_line("Not in this catalogue.");
        }
        for entry in known {
            let (id, form) = (&entry.id, &entry.form);
            out.add_line(format!("In the catalogue: {id}, laid out as {form}."));
        }
        out.text()
    }

    /// Returns how it moves in nearly all places.
    fn motion_text(&self) -> String {
        let Some((translating, s)) = self.motion else {
            return "In nearly all places of its joints it has no motion, more than one, or two links that keep together, or a gear pair \
                 without a carrier: such structures are not counted. It moves by its special shape, if it does."
                .to_owned();
        };
        let essential = match self.smaller_part() {
            Some(links) => format!(
                "Not essential: {} alone move input and jaws alike",
                links.join(", ")
            ),
            None => {
                "Essential: no smaller mobile subchain contains frame, input and jaws".to_owned()
            }
        };
        let flag = |strict: bool, but: bool, word: &str| match (strict, but) {
            (true, _) => Some(word.to_owned()),
            (_, true) => Some(format!("{word} except for the input")),
            _ => None,
        };
        let symmetric = [
            flag(s.mirror, s.mirror_but_input, "mirror"),
            flag(s.half_turn, s.half_turn_but_input, "half turn"),
        ];
        let symmetric = match symmetric.into_iter().flatten().join(", ") {
            none if none.is_empty() => "none".to_owned(),
            some => some,
        };
        let jaws = if translating {
            "keep their attitude in nearly all places"
        } else {
            "turn in nearly all places (on parallelograms they do not)"
        };
        format!("{essential}.\nSymmetric layouts: {symmetric}. The jaws {jaws}.")
    }
}

/// Returns the symmetries of a structure: a screw of both threads gives a mirror image if a pinion gives one by half a turn.
fn layout_symmetries(subject: &Subject<'_>, roles: &Roles, threaded: bool) -> Symmetries {
    match subject.find_symmetries(roles) {
        of_pinion if threaded => Symmetries {
            mirror: of_pinion.half_turn,
            mirror_but_input: of_pinion.half_turn_but_input,
            ..Symmetries::default()
        },
        own => own,
    }
}
