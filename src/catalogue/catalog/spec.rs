//! What a catalogue is to hold.

mod error;

pub use error::SpecError;
pub(crate) use error::{MOST_LINKS, MOST_PAIRED};

use crate::chains::{Input, PairKind, Symmetry};
use crate::file::schema::{OptionEntry, OptionTable};
use crate::synthesis::options::Menu;
use crate::synthesis::structure::Form;
use crate::synthesis::task::{Limits, Task};
use crate::synthesis::workload::Workload;
use itertools::Itertools;
use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;

/// The widest part of a task, in mm: pins stand within some 100 mm of each other.
const WIDEST: i64 = 200;

/// What a catalogue is to hold; the file of it, TOML, has the same keys.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Spec {
    /// Links from and to, both included: "4..8"; even numbers, with pairs odd ones, too.
    pub links: String,
    /// Jaws of each structure: 2 or 3.
    pub jaws: usize,
    /// Inputs: "slide", "turn".
    pub inputs: Vec<String>,
    /// Symmetries: "generic", "mirror", "half-turn", and for three jaws "threefold".
    pub symmetries: Vec<String>,
    /// Whether layouts with the jaws on parallelograms are made too: "with", "without" or "only".
    pub parallel: String,
    /// Whether layouts with hinges on one pin with their mirror images are made too: "with", "without" or "only".
    pub one_pin: String,
    /// Pairs beside hinges that symmetric structures may have: "slide", "gear", "slot"; none by default.
    pub pairs: Vec<String>,
    /// Pairs that are not hinges at most, a left and a right one being one.
    pub at_most: usize,
    /// Whether structures with pairs are laid out freely, too, symmetric or not: there are many.
    pub generic_pairs: bool,
    /// Whether slots between links that do not turn against each other are made as flat faces, too: "with", "without" or "only".
    pub flat_faces: String,
    /// The well-known schemes and nothing else, whatever their number of links, each as symmetric as it can be.
    pub classics: bool,
    /// What may be put in place of a hinge, by name.
    pub options: Vec<String>,
    /// What may be put in series with a hinge, an unloading joint with a link of its own, by name; nothing by default.
    pub unloading: Vec<String>,
    /// Ideas kept of each structure.
    pub ideas: usize,
    /// Seed of the layouts.
    pub seed: u64,
    /// The longest link over the shortest at most.
    pub ratio: f64,
    /// Crossings of links at most.
    pub crossings: usize,
    /// Nodes of each diagram at most.
    pub nodes: usize,
    /// What ideas are scored under.
    pub workload: Workload,
    /// What every gripper is to do.
    pub task: Task,
}

impl Default for Spec {
    fn default() -> Self {
        let words = |w: &[&str]| w.iter().map(|&s| s.to_owned()).collect();
        let limits = Limits::default();
        Spec {
            links: "4..6".to_owned(),
            jaws: 2,
            inputs: words(&["slide", "turn"]),
            symmetries: words(&["generic", "mirror", "half-turn", "threefold"]),
            parallel: "with".to_owned(),
            one_pin: "without".to_owned(),
            pairs: Vec::new(),
            at_most: 3,
            generic_pairs: false,
            flat_faces: "without".to_owned(),
            classics: false,
            options: words(&[
                "cylindrical",
                "universal",
                "universal-y",
                "spherical",
                "sphere-in-cylinder",
            ]),
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

/// A number, or a range with its end, "4..10": empty where it ends before it begins.
///
/// # Errors
/// The part that is no number.
pub fn range(text: &str) -> Result<RangeInclusive<usize>, &str> {
    let number = |t: &'_ str| t.trim().parse::<usize>().ok();
    let (from, to) = text.split_once("..").unwrap_or((text, text));
    let to = to.strip_prefix('=').unwrap_or(to);
    Ok(number(from).ok_or(from)?..=number(to).ok_or(to)?)
}

fn word<T: Copy>(
    what: &'static str,
    word: &str,
    all: &[(T, &'static str)],
) -> Result<T, SpecError> {
    let found = all.iter().find(|(_, w)| *w == word);
    found.map(|(t, _)| *t).ok_or_else(|| SpecError::Word {
        what,
        word: word.to_owned(),
        known: all.iter().map(|(_, w)| (*w).to_owned()).collect(),
    })
}

fn within(what: &'static str, x: f64, from: i64, to: i64) -> Result<(), SpecError> {
    #[allow(clippy::cast_precision_loss, reason = "small")]
    let ok = x >= from as f64 && x <= to as f64;
    ok.then_some(()).ok_or(SpecError::Range { what, from, to })
}

/// Options that a hinge may be replaced by.
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

/// Words for layouts that are made beside others.
const WITH: [(Option<bool>, &str); 3] = [
    (None, "with"),
    (Some(false), "without"),
    (Some(true), "only"),
];

impl Spec {
    /// The numbers of links.
    ///
    /// # Errors
    /// Where they are no range that is known.
    pub fn links(&self) -> Result<RangeInclusive<usize>, SpecError> {
        let wrong = || SpecError::Links(self.links.clone());
        let all = range(&self.links).map_err(|_| wrong())?;
        let least = if self.pairs.is_empty() { 4 } else { 3 };
        let known = *all.start() >= least && *all.end() <= MOST_LINKS;
        let some = known && all.clone().any(|n| n % 2 == 0 || !self.pairs.is_empty());
        let paired = !self.pairs.is_empty() || self.one_pin()? != Some(false);
        let many = self.jaws == 2 || self.generic_pairs;
        if some && many && paired && *all.end() > MOST_PAIRED {
            return Err(SpecError::PairedLinks);
        }
        some.then_some(all).ok_or_else(wrong)
    }

    /// The pairs beside hinges.
    ///
    /// # Errors
    /// Where a word means nothing.
    pub fn pairs(&self) -> Result<Vec<PairKind>, SpecError> {
        let others = PairKind::ALL.iter().filter(|k| k.0 != PairKind::Hinge);
        let known: Vec<(PairKind, &str)> = others.map(|k| (k.0, k.1)).collect();
        let kinds = self.pairs.iter().map(|w| word("pairs", w, &known));
        kinds.collect()
    }

    /// Returns those of the forms asked for in which structures with pairs are laid out.
    ///
    /// # Errors
    /// Returns an error if a word means nothing.
    pub(crate) fn paired_forms(&self) -> Result<Vec<(Input, Form)>, SpecError> {
        if self.pairs()?.is_empty() && self.one_pin()? == Some(false) {
            return Ok(Vec::new());
        }
        let (inputs, symmetries) = self.words()?;
        let parallel = self.parallelograms()?;
        let asked = |s: &Symmetry| match s {
            Symmetry::Mirror | Symmetry::HalfTurn => true,
            Symmetry::Generic => self.generic_pairs,
            Symmetry::Threefold => false,
        };
        let forms = symmetries.into_iter().filter(asked).map(Form::of_symmetry);
        let forms = forms.cartesian_product([false, true]);
        let forms = forms.map(|(f, parallel)| Form { parallel, ..f });
        let forms = forms.filter(|f| parallel.is_none_or(|p| p == f.parallel));
        let forms = forms.filter(|f| f.suits(self.jaws));
        let forms: Vec<Form> = forms.collect();
        Ok(inputs.into_iter().cartesian_product(forms).collect())
    }

    /// The forms of two jaws whose sides stand thrice in structures of three jaws that are asked for: what turns in the plane with the
    /// pairs that are asked for, and what slides along an axis with these or with hinges alone.
    ///
    /// # Errors
    /// Where a word means nothing.
    pub(crate) fn threefold_forms(&self) -> Result<Vec<(Input, Form)>, SpecError> {
        let (inputs, symmetries) = self.words()?;
        if self.jaws != 3 || !symmetries.contains(&Symmetry::Threefold) {
            return Ok(Vec::new());
        }
        let pairs = !self.pairs()?.is_empty();
        let parallel = self.parallelograms()?;
        let turning = (Input::Turn, Form::of_symmetry(Symmetry::HalfTurn));
        let sliding = [false, true].map(|parallel| {
            let form = Form::of_symmetry(Symmetry::Mirror);
            (Input::Slide, Form { parallel, ..form })
        });
        let all = std::iter::once(turning).filter(|_| pairs).chain(sliding);
        let asked = |(input, form): &(Input, Form)| {
            inputs.contains(input) && parallel.is_none_or(|p| p == form.parallel)
        };
        Ok(all.filter(asked).collect())
    }

    fn has_paired_forms(&self) -> Result<bool, SpecError> {
        Ok(!self.paired_forms()?.is_empty() || !self.threefold_forms()?.is_empty())
    }

    /// Whether layouts with the jaws on parallelograms are asked for, where one of both is.
    fn parallelograms(&self) -> Result<Option<bool>, SpecError> {
        word("parallel", &self.parallel, &WITH)
    }

    /// Whether layouts with hinges on one pin are asked for, where one of both is.
    pub(crate) fn one_pin(&self) -> Result<Option<bool>, SpecError> {
        word("one_pin", &self.one_pin, &WITH)
    }

    /// Whether flat faces are asked for, where one of both is.
    pub(crate) fn flat_faces(&self) -> Result<Option<bool>, SpecError> {
        word("flat_faces", &self.flat_faces, &WITH)
    }

    fn words(&self) -> Result<(Vec<Input>, Vec<Symmetry>), SpecError> {
        let inputs = self.inputs.iter();
        let inputs = inputs
            .map(|w| word("inputs", w, &Input::ALL))
            .try_collect()?;
        let symmetries = self.symmetries.iter();
        let symmetries = symmetries.map(|w| word("symmetries", w, &Symmetry::ALL));
        Ok((inputs, symmetries.try_collect()?))
    }

    /// Returns the forms in which structures that have only hinges are laid out, each with its input.
    ///
    /// # Errors
    /// Returns an error if a word means nothing, or if no form is left.
    pub fn forms(&self) -> Result<Vec<(Input, Form)>, SpecError> {
        let (inputs, symmetries) = self.words()?;
        let parallel = self.parallelograms()?;
        let alone = [self.one_pin()?, self.flat_faces()?].contains(&Some(true));
        let asked = |(input, f): &(Input, Form)| {
            !alone
                && inputs.contains(input)
                && symmetries.contains(&f.symmetry)
                && parallel.is_none_or(|p| p == f.parallel)
                && f.suits(self.jaws)
        };
        let forms: Vec<(Input, Form)> = Form::of_hinges().filter(asked).collect();
        if forms.is_empty() && !self.has_paired_forms()? {
            return Err(SpecError::Nothing);
        }
        Ok(forms)
    }

    /// What may be done to a hinge.
    ///
    /// # Errors
    /// Where a name is none.
    pub fn menu(&self) -> Result<Menu, SpecError> {
        let known: Vec<(&str, &str)> = OPTIONS.map(|o| (o, o)).into();
        // A slide along the hinge's axis does not double its turn.
        let in_series = [&known[..], &[("prismatic", "prismatic")]].concat();
        let entry = |what, name: &String, known| {
            Ok(match word(what, name, known)? {
                "universal-y" => OptionEntry::Table(Box::new(OptionTable {
                    kind: Some("universal".to_owned()),
                    reference: Some([0, 1, 0].map(crate::file::schema::Coordinate::Integer)),
                    name: Some("universal-y".to_owned()),
                    ..OptionTable::default()
                })),
                plain => OptionEntry::Word(plain.to_owned()),
            })
        };
        let mut options = vec![OptionEntry::Word("revolute".to_owned())];
        for name in self.options.iter().filter(|n| *n != "revolute").unique() {
            options.push(entry("options", name, &known)?);
        }
        let unloading = self.unloading.iter().unique();
        let unloading = unloading
            .map(|n| entry("unloading", n, &in_series))
            .try_collect()?;
        Ok(Menu { options, unloading })
    }

    /// What a layout must be like.
    #[must_use]
    pub fn limits(&self) -> Limits {
        Limits {
            ratio: self.ratio,
            crossings: self.crossings,
            task: self.task,
        }
    }

    /// Whether all of it can be done.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn check(&self) -> Result<(), SpecError> {
        #[allow(clippy::cast_precision_loss, reason = "small")]
        let whole = |what, n: usize, from, to| within(what, n as f64, from, to);
        whole("jaws", self.jaws, 2, 3)?;
        whole("ideas", self.ideas, 0, 1000)?;
        whole("nodes", self.nodes, 1, 100_000_000)?;
        whole("at_most", self.at_most, 1, 12)?;
        within("ratio", self.ratio, 0, 1000)?;
        let w = &self.workload;
        within("closing", w.closing, 0, 1_000_000)?;
        within("part", w.part, 0, 1_000_000)?;
        within("link_mass", w.link_mass, 0, 1_000_000)?;
        for g in w.gravity {
            within("gravity", g, -1000, 1000)?;
        }
        let weighs = w.gravity != [0.0; 3] && w.part + w.link_mass > 0.0;
        if w.closing == 0.0 && !weighs {
            return Err(SpecError::NoLoad);
        }
        self.check_task()?;
        if self.jaws == 3 && self.one_pin()? != Some(false) {
            return Err(SpecError::TwoJaws("one_pin"));
        }
        if self.generic_pairs && !self.words()?.1.contains(&Symmetry::Generic) {
            return Err(SpecError::Freely);
        }
        self.links()?;
        self.forms()?;
        if !self.pairs()?.is_empty() && !self.has_paired_forms()? {
            return Err(SpecError::PairedForms);
        }
        self.menu().map(|_| ())
    }

    fn check_task(&self) -> Result<(), SpecError> {
        let t = &self.task;
        within("narrowest", t.narrowest, 0, WIDEST)?;
        within("widest", t.widest, 1, WIDEST)?;
        if t.span() < 1.0 {
            return Err(SpecError::Widths);
        }
        within("least_force", t.least_force, 0, 1_000_000)?;
        within("force_ratio", t.force_ratio, 1, 1_000_000)?;
        within("transmission", t.transmission, 0, 90)?;
        within("pin_force", t.pin_force, 0, 1_000_000)?;
        within("efficiency", t.efficiency, 0, 1)?;
        for side in t.room {
            within("room", side, 0, 1_000_000)?;
        }
        within("pin_distance", t.pin_distance, 0, 1000)?;
        within("reach", t.reach, 0, 1000)?;
        if t.pulled_out != 0.0 {
            within("pulled_out", t.pulled_out, 1, 1000)?;
        }
        within("coefficient", t.friction.coefficient, 0, 10)?;
        within("pin_radius", t.friction.pin_radius, 0, 1000)?;
        within("guide", t.friction.guide, 1, 10_000)
    }

    /// The specification as TOML: the same for the same catalogue, whatever the order of its words.
    #[must_use]
    pub fn canonical(&self) -> String {
        let mut same = self.clone();
        for list in [
            &mut same.inputs,
            &mut same.symmetries,
            &mut same.options,
            &mut same.unloading,
            &mut same.pairs,
        ] {
            list.sort();
            list.dedup();
        }
        toml::to_string(&same).unwrap_or_default()
    }
}
