//! Ideas: variants that give the same freedoms to the same contours, as one.
//!
//! Joints on exactly the same contours are in series as far as closing is concerned, so that most variants are another
//! way of sharing out the same freedoms among them. The contours of a joint do not depend on the basis: two joints share
//! all of them exactly when they do in any basis.

use crate::closure::contour::contour_basis;
use crate::geom::vector::{across, cross, real, unit};
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{JointId, JointOption, Mechanism, StateId};
use crate::search::answer::count_tables::Key;
use crate::search::answer::counts::limited;
use crate::search::answer::counts::total;
use crate::search::answer::k_best::Assignment;
use crate::search::answer::variants_in_order::distinct;
use crate::search::build::Diagrams;
use crate::search::diagram::{DEAD, Diagram};
use crate::search::question::Question;
use crate::search::question::symmetry;
use itertools::Itertools;
use num_bigint::BigUint;
use std::collections::{BTreeMap, BTreeSet};

/// A freedom that is added somewhere, and how often.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Added {
    /// The joints that are on the same contours, any of which may have it.
    pub joints: Vec<JointId>,
    /// The freedom in words: "turn about x".
    pub freedom: String,
    /// How often.
    pub times: u8,
}

/// Variants that differ only in which of some joints in series has which of the freedoms added.
#[derive(Debug, Clone)]
pub struct Idea {
    /// The first of them in the order of the list.
    pub first: Assignment,
    /// What all of them add.
    pub added: Vec<Added>,
    /// How many there are, those included that a mirror image of the mechanism makes of them.
    pub variants: BigUint,
}

/// What is added in words, joints in series after each other: "turn about x, turn about y at a/b/c".
#[must_use]
pub fn in_words(m: &Mechanism, added: &[Added]) -> String {
    let groups = added.iter().chunk_by(|a| &a.joints);
    let mut out = Vec::new();
    for (joints, here) in &groups {
        let one = |a: &Added| match a.times {
            1 => a.freedom.clone(),
            n => format!("{n} × {}", a.freedom),
        };
        let freedoms = here.map(one).join(", ");
        let joints = joints.iter().map(|&j| m.joints[j].id.as_str()).join("/");
        out.push(format!("{freedoms} at {joints}"));
    }
    out.join("; ")
}

/// How often each freedom is added to each group of joints.
type Pattern = Vec<u8>;

/// A freedom of any of some joints in series.
type Item = (Vec<JointId>, String);

/// The groups of joints in series, and what every choice adds to them.
#[derive(Debug)]
struct Patterns {
    /// What the numbers of a pattern are about.
    items: Vec<Item>,
    /// `[variable][choice]`.
    of: Vec<Vec<Pattern>>,
    /// The number that a mirror image makes of each; `None` where the mechanism is not its own mirror image.
    mirrored: Option<Vec<usize>>,
}

impl Patterns {
    fn sum(&self, chosen: impl Iterator<Item = (usize, usize)>) -> Pattern {
        let mut out = vec![0; self.items.len()];
        for (variable, choice) in chosen {
            let more = self.of[variable][choice].iter();
            out.iter_mut().zip(more).for_each(|(a, b)| *a += b);
        }
        out
    }

    fn of_variant(&self, v: &Assignment) -> Pattern {
        self.sum(v.choices.iter().copied().enumerate())
    }

    /// What a variant has in common with all of its idea: its pattern or the image of it, whichever is less.
    fn idea(&self, v: &Assignment) -> Pattern {
        let pattern = self.of_variant(v);
        let image = self.image(&pattern);
        pattern.min(image)
    }

    fn image(&self, pattern: &Pattern) -> Pattern {
        match &self.mirrored {
            None => pattern.clone(),
            Some(to) => {
                let mut out = vec![0; pattern.len()];
                to.iter().zip(pattern).for_each(|(&to, n)| out[to] += n);
                out
            }
        }
    }

    /// After each layer of a diagram, how often each freedom can still be added.
    fn to_come(&self, diagram: &Diagram) -> Vec<Pattern> {
        let mut most = vec![0u8; self.items.len()];
        let mut out = Vec::with_capacity(diagram.layers.len());
        for layer in diagram.layers.iter().rev() {
            out.push(most.clone());
            let here = &self.of[layer.variable];
            for (i, n) in most.iter_mut().enumerate() {
                let times = here.iter().map(|choice| choice[i]).max();
                *n = n.saturating_add(times.unwrap_or(0));
            }
        }
        out.reverse();
        out
    }

    fn added(&self, pattern: &Pattern) -> Vec<Added> {
        let all = self.items.iter().zip(pattern).filter(|(_, n)| **n > 0);
        all.map(|((joints, freedom), &times)| Added {
            joints: joints.clone(),
            freedom: freedom.clone(),
            times,
        })
        .collect()
    }
}

/// The joints of each joint's series, itself included: those on the same contours.
fn series(m: &Mechanism, state: StateId) -> BTreeMap<JointId, Vec<JointId>> {
    let basis = contour_basis(m, state);
    let of = |j: JointId| {
        basis
            .iter()
            .map(move |c| c.direction(j).is_some())
            .collect_vec()
    };
    let mut groups: BTreeMap<(Vec<bool>, Option<JointId>), Vec<JointId>> = BTreeMap::new();
    for j in m.joints_in(state) {
        let contours = of(j);
        // Joints in no contour have nothing in common.
        let alone = (!contours.contains(&true)).then_some(j);
        groups.entry((contours, alone)).or_default().push(j);
    }
    let groups = groups.into_values();
    groups
        .flat_map(|g| g.clone().into_iter().map(move |j| (j, g.clone())))
        .collect()
}

/// The freedoms of an option in words, by their directions.
fn freedoms(option: &JointOption) -> Vec<String> {
    let z = unit(real(&option.frame.axis));
    let x = unit(across(real(&option.frame.reference), z));
    let y = cross(z, x);
    let word = |f: &Freedom| {
        let (what, axis) = match f {
            Freedom::Rx => ("turn about", x),
            Freedom::Ry => ("turn about", y),
            Freedom::Rz => ("turn about", z),
            Freedom::Tx => ("slide along", x),
            Freedom::Ty => ("slide along", y),
            Freedom::Tz => ("slide along", z),
            Freedom::Screw => ("screw about", z),
        };
        format!("{what} {}", direction(axis))
    };
    option.joint_type.freedoms().iter().map(word).collect()
}

/// A direction in words, either way along it.
fn direction(d: [f64; 3]) -> String {
    let d = d.map(|x| (x * 1e6).round() / 1e6 + 0.0);
    let sign = if d.iter().find(|x| **x != 0.0).is_some_and(|x| *x < 0.0) {
        -1.0
    } else {
        1.0
    };
    let d = d.map(|x| x * sign + 0.0);
    match d.iter().position(|x| *x == 1.0) {
        Some(i) => ["x", "y", "z"][i].to_owned(),
        None => format!("({})", d.iter().map(|x| format!("{x:.3}")).join(" ")),
    }
}

/// What an option adds to what is there: freedoms by their directions, or the option itself where its freedoms do not
/// contain the present ones one by one.
fn added(present: &JointOption, option: &JointOption) -> Vec<String> {
    let mut all = freedoms(option);
    for f in freedoms(present) {
        match all.iter().position(|a| *a == f) {
            Some(i) => {
                all.remove(i);
            }
            None => return vec![option.name.clone()],
        }
    }
    all
}

fn patterns(question: &Question) -> Patterns {
    let m = &question.mechanism;
    let state = question.conditions.state.map_or(StateId::FREE, |s| s.state);
    let mut series = series(m, state);
    series.extend(
        m.joints_in(StateId::FREE)
            .filter(|&j| !m.joints[j].is_in(state))
            .map(|j| (j, vec![j])),
    );
    let mut items: BTreeSet<Item> = BTreeSet::new();
    let mut raw: Vec<Vec<Vec<Item>>> = Vec::new();
    for v in &question.space.variables {
        let mut choices = Vec::new();
        for choice in &v.choices {
            let mut here = Vec::new();
            for &j in &v.joints {
                let joint = &m.joints[j];
                let mut words = added(&joint.options[0], &joint.options[choice.option]);
                if let Some(u) = choice.unloading {
                    words.extend(freedoms(&joint.unloading[u]));
                }
                here.extend(words.into_iter().map(|w| (series[&j].clone(), w)));
            }
            items.extend(here.iter().cloned());
            choices.push(here);
        }
        raw.push(choices);
    }
    let items: Vec<Item> = items.into_iter().collect();
    let at = |x: &Item| items.binary_search(x).ok();
    let pattern = |here: &Vec<Item>| {
        let mut out = vec![0; items.len()];
        here.iter().filter_map(at).for_each(|i| out[i] += 1);
        out
    };
    let of = raw
        .iter()
        .map(|c| c.iter().map(pattern).collect())
        .collect();
    let image = |(joints, word): &Item| {
        let joints = joints.iter().map(|&j| m.search.image(j)).sorted().collect();
        at(&(joints, word.clone()))
    };
    let searched = question.conditions.state.map(|s| s.state);
    // A third of a turn makes of a freedom about x one that is about no axis of another's words.
    let symmetric = m.search.order() == 2 && symmetry::check(&question.exact, m, searched).is_ok();
    let mirrored = symmetric
        .then(|| items.iter().map(image).collect())
        .flatten();
    Patterns {
        items,
        of,
        mirrored,
    }
}

/// The first ideas among the admissible variants, in the order of [`crate::search::Search::cheapest`]; `top` of them at most.
///
/// # Complexity
/// Of the variants up to the last idea's cost only as much of each as differs in its pattern; then for each idea a
/// pass over the part of the diagram that it uses.
pub fn ideas(question: &Question, diagrams: &Diagrams, top: usize) -> Vec<Idea> {
    let patterns = patterns(question);
    let order: Vec<usize> = diagrams
        .admissible
        .layers
        .iter()
        .map(|l| l.variable)
        .collect();
    let mut at_least = top.saturating_mul(64);
    loop {
        let mut entered: BTreeSet<(usize, usize, Key, Pattern)> = BTreeSet::new();
        let enter = |depth: usize, node: usize, rest: Key, choices: &[usize]| {
            let chosen = order[..depth].iter().map(|&v| (v, choices[v]));
            entered.insert((depth, node, rest, patterns.sum(chosen)))
        };
        let mut seen = BTreeSet::new();
        let found: Vec<Assignment> =
            distinct(question, &diagrams.admissible, at_least, Box::new(enter))
                .filter(|v| seen.insert(patterns.idea(v)))
                .take(top)
                .collect();
        // All that were asked for, or all there are: otherwise more variants must be let in.
        let all = || BigUint::from(at_least) >= total(question, &diagrams.admissible, true);
        if found.len() == top || all() {
            let idea = |first| idea(question, diagrams, &patterns, first);
            return found.into_iter().map(idea).collect();
        }
        at_least = at_least.saturating_mul(64);
    }
}

/// The first of each idea in a list of variants, with its place in the list.
pub fn first_of_each<'a>(
    question: &Question,
    list: impl Iterator<Item = &'a Assignment>,
    diagrams: &Diagrams,
) -> Vec<(usize, Idea)> {
    let patterns = patterns(question);
    let mut seen = BTreeSet::new();
    list.enumerate()
        .filter(|(_, v)| seen.insert(patterns.idea(v)))
        .map(|(place, v)| (place, idea(question, diagrams, &patterns, v.clone())))
        .collect()
}

/// The first ideas in a list of all variants in order, and how many of the list each stands for; `top` of them at most.
///
/// # Complexity
/// O(list · variables · log).
pub fn ideas_among(
    question: &Question,
    list: impl Iterator<Item = Assignment>,
    top: usize,
) -> Vec<Idea> {
    let patterns = patterns(question);
    let mut at: BTreeMap<Pattern, Option<usize>> = BTreeMap::new();
    let mut out: Vec<Idea> = Vec::new();
    for v in list {
        let place = at.entry(patterns.idea(&v)).or_insert_with(|| {
            (out.len() < top).then(|| {
                out.push(Idea {
                    added: patterns.added(&patterns.of_variant(&v)),
                    variants: BigUint::from(0u8),
                    first: v.clone(),
                });
                out.len() - 1
            })
        });
        if let Some(idea) = place.and_then(|i| out.get_mut(i)) {
            idea.variants += 1u8;
        }
    }
    out
}

/// The idea that a variant is the first of.
fn idea(question: &Question, diagrams: &Diagrams, patterns: &Patterns, first: Assignment) -> Idea {
    let pattern = patterns.of_variant(&first);
    Idea {
        added: patterns.added(&pattern),
        variants: variants_of(question, diagrams, patterns, &pattern),
        first,
    }
}

/// How many admissible variants have a pattern, or its mirror image.
fn variants_of(
    question: &Question,
    diagrams: &Diagrams,
    patterns: &Patterns,
    pattern: &Pattern,
) -> BigUint {
    let image = patterns.image(pattern);
    let own = with_pattern(question, diagrams, patterns, pattern);
    if image == *pattern {
        own
    } else {
        own + with_pattern(question, diagrams, patterns, &image)
    }
}

fn with_pattern(
    question: &Question,
    diagrams: &Diagrams,
    patterns: &Patterns,
    pattern: &Pattern,
) -> BigUint {
    let diagram = &diagrams.admissible;
    let steps = question.steps.only(limited(question));
    let to_come = patterns.to_come(diagram);
    let mut here: BTreeMap<(usize, Pattern, Key), BigUint> = BTreeMap::new();
    here.insert((0, pattern.clone(), Key::default()), BigUint::from(1u8));
    for (layer, to_come) in diagram.layers.iter().zip(&to_come) {
        let mut next: BTreeMap<(usize, Pattern, Key), BigUint> = BTreeMap::new();
        for ((node, left, key), n) in here {
            for choice in 0..layer.choices {
                let to = layer.edges[node * layer.choices + choice];
                let takes = &patterns.of[layer.variable][choice];
                // No more than is left, and no less than what comes later can take.
                let mut all = left.iter().zip(takes).zip(to_come);
                if to == DEAD || !all.all(|((a, b), most)| b <= a && a - b <= *most) {
                    continue;
                }
                let left = left.iter().zip(takes).map(|(a, b)| a - b).collect();
                let key = Key(key.0 + steps.keys[layer.variable][choice].0);
                *next.entry((to as usize, left, key)).or_default() += &n;
            }
        }
        here = next;
    }
    let whole = here.into_iter().filter(|((node, left, key), _)| {
        let key = Key(key.0 + steps.redundancy(diagram.terminals[*node]).0);
        left.iter().all(|n| *n == 0) && question.wanted(key)
    });
    whole.map(|(_, n)| n).sum()
}
