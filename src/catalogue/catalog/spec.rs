//! The specification of a catalogue.

use crate::chains::{Input, PairKind, Symmetry};
use crate::file::schema::{Coordinate, OptionEntry, OptionTable};
use crate::synthesis::options::Menu;
use crate::synthesis::structure::Form;
use crate::synthesis::task::{Limits, Task};
use crate::synthesis::workload::Workload;
use itertools::Itertools;
use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;
use thiserror::Error;

/// Maximum number of links of a structure: with more there are millions of structures.
pub(crate) const MOST_LINKS: usize = 12;

/// Maximum number of links of a structure with pairs.
pub(crate) const MOST_PAIRED: usize = 8;

/// Maximum width of the widest part of a task, in mm: pins are within some 100 mm of each other.
const WIDEST: i64 = 200;

/// Error of a specification.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SpecError {
    /// An unknown word.
    #[error("{what}: {word:?} is none of {}", known.join(", "))]
    Word {
        /// The key.
        what: &'static str,
        /// The word.
        word: String,
        /// The known words.
        known: Vec<String>,
    },
    /// A text that is not a range of links.
    #[error(
        "links: {0:?} is not a range of even numbers from 4 to {MOST_LINKS}, such as 4..8: chains of mobility 1 have an even number of links; \
         with gears and slots any number from 3 to {MOST_PAIRED}"
    )]
    Links(String),
    /// Too many links for pairs.
    #[error(
        "links: structures with pairs have at most {MOST_PAIRED} links, because larger ones are too many; \
         only symmetric ones of three jaws may have more"
    )]
    PairedLinks,
    /// Pairs in a form in which they are not laid out.
    #[error(
        "pairs: none of the symmetries suits structures with pairs; these are mirror and half-turn, threefold with three jaws, and \
         generic if generic_pairs is true"
    )]
    PairedForms,
    /// Free layouts that no symmetry asked for allows.
    #[error("generic_pairs: free layouts need generic among the symmetries")]
    Freely,
    /// A number out of its range.
    #[error("{what} must be from {from} to {to}")]
    Range {
        /// The key.
        what: &'static str,
        /// The lower bound.
        from: i64,
        /// The upper bound.
        to: i64,
    },
    /// No load under which ideas could be scored.
    #[error(
        "workload: nothing acts on the gripper; give closing, or gravity with part or link_mass"
    )]
    NoLoad,
    /// The narrowest part is wider than the widest.
    #[error("narrowest must be at least a millimetre less than widest")]
    Widths,
    /// No form remains.
    #[error(
        "no layout is asked for: with two jaws a mirror image needs a slide and half a turn a turning input; three jaws are \
         generic or threefold, and stand on parallelograms where each side has its own plane, threefold with a slide"
    )]
    Nothing,
}

impl SpecError {
    /// Returns the key that is wrong, if it is one.
    #[must_use]
    pub fn wrong_key(&self) -> Option<&'static str> {
        match self {
            SpecError::Word { what, .. } | SpecError::Range { what, .. } => Some(what),
            SpecError::Links(_) | SpecError::PairedLinks => Some("links"),
            SpecError::PairedForms => Some("pairs"),
            SpecError::Freely => Some("generic_pairs"),
            SpecError::NoLoad => Some("closing"),
            SpecError::Nothing => Some("symmetries"),
            SpecError::Widths => Some("narrowest"),
        }
    }
}

/// Specification of a catalogue. Its TOML file has the same keys.
///
/// # Examples
/// ```
/// use ozols::{catalog::{build::plan_work, spec::Spec}, shard::Shard};
/// let spec = Spec { links: "6".to_owned(), ..Spec::default() };
/// spec.check_all()?;
/// let work = plan_work(&spec, Shard::WHOLE)?;
/// assert_eq!(work.structure_ids().count(), work.structure_count());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Spec {
    /// Range of the numbers of links, both ends included: "4..8". Odd numbers need pairs.
    pub links: String,
    /// Jaws of each structure: 2 or 3.
    pub jaws: usize,
    /// Inputs: "slide", "turn".
    pub inputs: Vec<Input>,
    /// Symmetries: "generic", "mirror", "half-turn", and for three jaws "threefold".
    pub symmetries: Vec<Symmetry>,
    /// Whether layouts with the jaws on parallelograms are made too: "with", "without" or "only".
    pub parallel: Parallel,
    /// Other pairs than hinges that symmetric structures may have: "slide", "gear", "slot". None by default.
    pub pairs: Vec<PairKind>,
    /// Maximum number of pairs that are not hinges; a left and a right one count once.
    pub at_most: usize,
    /// Whether structures with pairs are also laid out freely, symmetric or not. There are many.
    pub generic_pairs: bool,
    /// Whether only the well-known schemes are built, with any number of links, each as symmetric as possible.
    pub classics: bool,
    /// Joint types that may replace a hinge.
    pub options: Vec<String>,
    /// Joint types that may be put in series with a hinge, on an additional link. None by default.
    pub unloading: Vec<String>,
    /// Number of ideas kept per structure.
    pub ideas: usize,
    /// Seed of the layouts.
    pub seed: u64,
    /// Maximum ratio of the longest link to the shortest.
    pub ratio: f64,
    /// Maximum number of crossings of links.
    pub crossings: usize,
    /// Maximum number of nodes of each diagram.
    pub nodes: usize,
    /// Workload under which ideas are scored.
    pub workload: Workload,
    /// Task of every gripper.
    pub task: Task,
}

/// Whether layouts with the jaws on parallelograms are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Parallel {
    /// They are made, too.
    With,
    /// They are not made.
    Without,
    /// Only they are made.
    Only,
}

impl Parallel {
    /// All choices with their words.
    pub const ALL: [(Parallel, &'static str); 3] = [
        (Parallel::With, "with"),
        (Parallel::Without, "without"),
        (Parallel::Only, "only"),
    ];

    fn allows_form(self, form: Form) -> bool {
        match self {
            Parallel::With => true,
            Parallel::Without => !form.parallel,
            Parallel::Only => form.parallel,
        }
    }
}

impl Default for Spec {
    fn default() -> Self {
        let limits = Limits::default();
        Spec {
            links: "4..6".to_owned(),
            jaws: 2,
            inputs: Input::ALL.map(|(input, _)| input).to_vec(),
            symmetries: Symmetry::ALL.map(|(symmetry, _)| symmetry).to_vec(),
            parallel: Parallel::With,
            pairs: Vec::new(),
            at_most: 3,
            generic_pairs: false,
            classics: false,
            options: OPTIONS[..5].iter().map(|&o| o.to_owned()).collect(),
            unloading: Vec::new(),
            ideas: 10,
            seed: 1,
            ratio: limits.ratio,
            crossings: limits.crossings,
            nodes: 1_000_000,
            workload: Workload::default(),
            task: Task::default(),
        }
    }
}

/// Joint types that may replace a hinge.
const OPTIONS: [&str; 8] = [
    "cylindrical",
    "universal",
    "universal-y",
    "spherical",
    "sphere-in-cylinder",
    "cylindrical-universal",
    "planar",
    "slotted",
];

/// Parses a number, or a range with its end such as "4..10". The range is empty if it ends before it begins.
///
/// # Errors
/// Returns the part that is not a number.
///
/// # Examples
/// ```
/// use ozols::catalog::spec::parse_range;
/// assert_eq!(parse_range("4..8"), Ok(4..=8));
/// assert_eq!(parse_range("6"), Ok(6..=6));
/// assert_eq!(parse_range("six"), Err("six"));
/// ```
pub fn parse_range(text: &str) -> Result<RangeInclusive<usize>, &str> {
    let number = |t: &'_ str| t.trim().parse::<usize>().ok();
    let (from, to) = text.split_once("..").unwrap_or((text, text));
    let to = to.strip_prefix('=').unwrap_or(to);
    Ok(number(from).ok_or(from)?..=number(to).ok_or(to)?)
}

/// Returns an error unless a word is known.
fn check_word(what: &'static str, word: &str, known: &[&str]) -> Result<(), SpecError> {
    let wrong = || SpecError::Word {
        what,
        word: word.to_owned(),
        known: known.iter().map(|&w| w.to_owned()).collect(),
    };
    known.contains(&word).then_some(()).ok_or_else(wrong)
}

fn check_range(what: &'static str, x: f64, from: i64, to: i64) -> Result<(), SpecError> {
    #[allow(clippy::cast_precision_loss, reason = "small")]
    let ok = x >= from as f64 && x <= to as f64;
    ok.then_some(()).ok_or(SpecError::Range { what, from, to })
}

impl Spec {
    /// Returns the numbers of links.
    ///
    /// # Errors
    /// Returns an error if they are not a range for which structures are known.
    pub fn link_range(&self) -> Result<RangeInclusive<usize>, SpecError> {
        let wrong = || SpecError::Links(self.links.clone());
        let all = parse_range(&self.links).map_err(|_| wrong())?;
        let paired = !self.pairs.is_empty();
        let known = *all.start() >= if paired { 3 } else { 4 } && *all.end() <= MOST_LINKS;
        let some = known && all.clone().any(|n| n % 2 == 0 || paired);
        let many = self.jaws == 2 || self.generic_pairs;
        if some && many && paired && *all.end() > MOST_PAIRED {
            return Err(SpecError::PairedLinks);
        }
        some.then_some(all).ok_or_else(wrong)
    }

    /// Returns the requested ones of some forms.
    fn asked_forms(&self, forms: impl Iterator<Item = (Input, Form)>) -> Vec<(Input, Form)> {
        let asked = |(input, form): &(Input, Form)| {
            self.inputs.contains(input)
                && self.symmetries.contains(&form.symmetry)
                && self.parallel.allows_form(*form)
        };
        forms.filter(asked).collect()
    }

    /// Returns the requested forms in which structures with pairs are laid out.
    #[must_use]
    pub(crate) fn paired_forms(&self) -> Vec<(Input, Form)> {
        if self.pairs.is_empty() {
            return Vec::new();
        }
        let generic = self.generic_pairs.then_some(Symmetry::Generic);
        let symmetries = [Symmetry::Mirror, Symmetry::HalfTurn].into_iter();
        let forms = symmetries.chain(generic).map(Form::of_symmetry);
        let forms = forms.cartesian_product([false, true]);
        let forms = forms.map(|(f, parallel)| Form { parallel, ..f });
        let forms = forms.filter(|f| f.suits_jaws(self.jaws)).collect_vec();
        let inputs = Input::ALL.into_iter().map(|(input, _)| input);
        self.asked_forms(inputs.cartesian_product(forms))
    }

    /// Returns the forms of two jaws whose sides are repeated three times in the structures of three jaws asked for. They turn
    /// in the plane with the pairs asked for, or slide along an axis with these or with only hinges.
    #[must_use]
    pub(crate) fn threefold_forms(&self) -> Vec<(Input, Form)> {
        if self.jaws != 3 || !self.symmetries.contains(&Symmetry::Threefold) {
            return Vec::new();
        }
        let turning = (Input::Turn, Form::of_symmetry(Symmetry::HalfTurn));
        let turning = (!self.pairs.is_empty()).then_some(turning);
        let sliding = [false, true].map(|parallel| {
            let form = Form::of_symmetry(Symmetry::Mirror);
            (Input::Slide, Form { parallel, ..form })
        });
        let all = turning.into_iter().chain(sliding);
        all.filter(|(input, form)| self.inputs.contains(input) && self.parallel.allows_form(*form))
            .collect()
    }

    /// Returns the forms in which structures that have only hinges are laid out, each with its input.
    #[must_use]
    pub fn hinged_forms(&self) -> Vec<(Input, Form)> {
        self.asked_forms(Form::of_hinges().filter(|(_, f)| f.suits_jaws(self.jaws)))
    }

    /// Returns the joint types that may replace or extend a hinge.
    ///
    /// # Errors
    /// Returns an error if a name is unknown.
    pub fn option_menu(&self) -> Result<Menu, SpecError> {
        // A slide along the hinge's axis does not double its turn.
        let in_series = [&OPTIONS[..], &["prismatic"]].concat();
        let entry = |name: &String| match &name[..] {
            "universal-y" => OptionEntry::Table(Box::new(OptionTable {
                kind: Some("universal".to_owned()),
                reference: Some([0, 1, 0].map(Coordinate::Integer)),
                name: Some("universal-y".to_owned()),
                ..OptionTable::default()
            })),
            _ => OptionEntry::Word(name.clone()),
        };
        let present = "revolute".to_owned();
        let options = self.options.iter().filter(|n| **n != present).unique();
        for name in options.clone() {
            check_word("options", name, &OPTIONS)?;
        }
        for name in &self.unloading {
            check_word("unloading", name, &in_series)?;
        }
        Ok(Menu {
            options: [&present].into_iter().chain(options).map(entry).collect(),
            unloading: self.unloading.iter().unique().map(entry).collect(),
        })
    }

    /// Returns the requirements on a layout.
    #[must_use]
    pub fn layout_limits(&self) -> Limits {
        Limits {
            ratio: self.ratio,
            crossings: self.crossings,
            task: self.task,
        }
    }

    /// Checks the whole specification.
    ///
    /// # Errors
    /// Returns the first fault.
    pub fn check_all(&self) -> Result<(), SpecError> {
        #[allow(clippy::cast_precision_loss, reason = "small")]
        let whole = |what, n: usize, from, to| check_range(what, n as f64, from, to);
        whole("jaws", self.jaws, 2, 3)?;
        whole("ideas", self.ideas, 0, 1000)?;
        whole("nodes", self.nodes, 1, 100_000_000)?;
        whole("at_most", self.at_most, 1, 12)?;
        check_range("ratio", self.ratio, 0, 1000)?;
        let w = &self.workload;
        check_range("closing", w.closing, 0, 1_000_000)?;
        check_range("part", w.part, 0, 1_000_000)?;
        check_range("link_mass", w.link_mass, 0, 1_000_000)?;
        for g in w.gravity {
            check_range("gravity", g, -1000, 1000)?;
        }
        let weighs = w.gravity != [0.0; 3] && w.part + w.link_mass > 0.0;
        if w.closing == 0.0 && !weighs {
            return Err(SpecError::NoLoad);
        }
        self.check_task()?;
        if self.generic_pairs && !self.symmetries.contains(&Symmetry::Generic) {
            return Err(SpecError::Freely);
        }
        for pair in &self.pairs {
            let others = PairKind::ALL.map(|(_, word, _)| word);
            check_word("pairs", pair.name(), &others[1..])?;
        }
        self.link_range()?;
        let is_paired = !self.paired_forms().is_empty() || !self.threefold_forms().is_empty();
        if !is_paired && self.hinged_forms().is_empty() {
            return Err(SpecError::Nothing);
        }
        if !is_paired && !self.pairs.is_empty() {
            return Err(SpecError::PairedForms);
        }
        self.option_menu().map(|_| ())
    }

    fn check_task(&self) -> Result<(), SpecError> {
        let t = &self.task;
        check_range("narrowest", t.narrowest, 0, WIDEST)?;
        check_range("widest", t.widest, 1, WIDEST)?;
        if t.opening_span() < 1.0 {
            return Err(SpecError::Widths);
        }
        check_range("least_force", t.least_force, 0, 1_000_000)?;
        check_range("force_ratio", t.force_ratio, 1, 1_000_000)?;
        check_range("transmission", t.transmission, 0, 90)?;
        check_range("pin_force", t.pin_force, 0, 1_000_000)?;
        check_range("efficiency", t.efficiency, 0, 1)?;
        for side in t.room {
            check_range("room", side, 0, 1_000_000)?;
        }
        check_range("pin_distance", t.pin_distance, 0, 1000)?;
        check_range("reach", t.reach, 0, 1000)?;
        if t.pulled_out != 0.0 {
            check_range("pulled_out", t.pulled_out, 1, 1000)?;
        }
        check_range("coefficient", t.friction.coefficient, 0, 10)?;
        check_range("pin_radius", t.friction.pin_radius, 0, 1000)?;
        check_range("guide", t.friction.guide, 1, 10_000)
    }

    /// Returns the specification as TOML. It is the same for the same catalogue, for any order of its words.
    #[must_use]
    pub fn to_canonical(&self) -> String {
        fn sort_list<T: Ord>(list: &mut Vec<T>) {
            list.sort();
            list.dedup();
        }
        let mut same = self.clone();
        sort_list(&mut same.inputs);
        sort_list(&mut same.symmetries);
        sort_list(&mut same.pairs);
        sort_list(&mut same.options);
        sort_list(&mut same.unloading);
        toml::to_string(&same).unwrap_or_default()
    }
}
