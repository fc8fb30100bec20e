//! Ideas: groups of minimal variants that give the same freedoms to the same contours. The preferred variant represents each
//! group.
//!
//! Ideas come in order of cost. At equal cost, ideas whose shown variant is its own image come first, then those with fewer
//! kinds of inserted joints. The next are those that keep the drive and the pivots in the frame
//! (`change_weights`), then those with less mobility and fewer changes. For mechanisms
//! with more than 24 joints, ideas are in order of cost only. If more than 512 ideas have one cost, each group of 512 is
//! ordered on its own.

pub mod freedom_patterns;
pub(crate) mod least_freedoms;
pub mod preferred;

use crate::search::answer::counts::limited_kinds;
use crate::search::answer::ideas::freedom_patterns::{Added, Pattern, Patterns, freedom_patterns};
use crate::search::answer::ideas::least_freedoms::{Less, minimal_variants};
use crate::search::answer::ideas::preferred::change_weights;
use crate::search::answer::k_best::{Assignment, Cheapest, Reach};
use crate::search::answer::keys::{Key, Steps};
use crate::search::diagram::{DEAD, Diagram};
use crate::search::question::Question;
use crate::search::question::space::{Variable, choice_name};
use crate::search::solve::Diagrams;
use itertools::Itertools;
use num_bigint::BigUint;
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

/// Variants that differ only in which of some joints in series has which of the freedoms added.
#[derive(Debug, Clone)]
pub struct Idea {
    /// The one of them that is shown.
    pub first: Assignment,
    /// The freedoms that all of them add.
    pub added: Vec<Added>,
    /// How many there are, those included that the mechanism's own image makes of them.
    pub variants: BigUint,
    /// Whether the shown one is its own image; `None` where the mechanism has no symmetry.
    pub symmetric: Option<bool>,
}

/// Maximum number of ideas of one cost that are sorted together.
const TOGETHER: usize = 512;

/// Joints whose ideas are brought in order: of more joints those of one cost are too many to see all before the first.
const SORTED: usize = 24;
/// Weights of places that take part in the order of ideas, in all.
const WEIGHED: u64 = 64;

impl Question {
    /// Returns the admissible variants that ideas consist of: those for which no other has only a part of their
    /// freedoms and costs no more. Returns all if these are unknown.
    #[must_use]
    pub fn idea_variants<'d>(&self, diagrams: &'d Diagrams) -> Cow<'d, Diagram> {
        let all = diagrams.listed_diagram();
        minimal_variants(self, all, Less::Means).map_or(Cow::Borrowed(all), Cow::Owned)
    }

    /// Returns at most `top` first ideas, each of all minimal variants that give the same freedoms to the same
    /// contours. A shorter list is the beginning of a longer one.
    ///
    /// # Complexity
    /// That of the diagram of minimal variants. From each variant up to the last idea's cost, it takes only
    /// the part that differs in its pattern. Then a bounded search finds the shown variant of each idea in the groups of the first `top`.
    /// Each takes two passes over the part of the diagram that it uses.
    ///
    /// # Examples
    /// ```
    /// use ozols::{rank::exact::field::exact_field, search::{Search, diagram::Control, question::conditions::Conditions}};
    /// let four_bar = ozols::built_in("four-bar")?;
    /// let search = Search::new(exact_field(&four_bar, 0)?, &four_bar, Conditions::default())?;
    /// let diagrams = search.build_diagrams(Control::NONE);
    /// let ideas = search.list_ideas(&diagrams, 3);
    /// // The first adds the three freedoms that remove σ = 3, and may add them in six ways.
    /// assert_eq!((ideas[0].first.key.freedoms(), ideas[0].variants.to_string().as_str()), (4 + 3, "6"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn list_ideas(&self, diagrams: &Diagrams, top: usize) -> Vec<Idea> {
        self.ideas_among(&self.idea_basis(), &self.idea_variants(diagrams), top)
    }

    /// Returns the basis of the ideas in addition to variants and costs. Two searches with the same variants, costs and
    /// basis have the same ideas.
    #[must_use]
    pub fn idea_basis(&self) -> IdeaBasis {
        let names = |v: &Variable| {
            let name = |c| choice_name(&self.mechanism, v.joints[0], c);
            v.choices.iter().map(name).collect()
        };
        IdeaBasis {
            patterns: freedom_patterns(self),
            weights: change_weights(&self.mechanism, &self.space),
            names: self.space.variables.iter().map(names).collect(),
        }
    }

    /// Returns the ideas among the variants that [ideas consist of](Self::idea_variants), with this search's basis.
    #[must_use]
    pub fn ideas_among(&self, basis: &IdeaBasis, variants: &Diagram, top: usize) -> Vec<Idea> {
        ideas_in_steps(self, basis, variants, top, &mut 0)
    }
}

/// Data on which ideas depend, in addition to their variants and costs. They are: what each choice adds to which contours;
/// the images of joints in the mechanism's own symmetry; the weights of places; the names of the chosen joints.
#[derive(Debug, PartialEq, Eq)]
pub struct IdeaBasis {
    patterns: Patterns,
    weights: Vec<u64>,
    /// `[variable][choice]`.
    names: Vec<Vec<String>>,
}

impl IdeaBasis {
    /// Returns how many kinds of joints a variant puts in.
    fn count_kinds(&self, v: &Assignment) -> usize {
        let chosen = self.names.iter().zip(&v.choices);
        let put = chosen.filter(|(_, c)| **c != 0);
        put.map(|(names, &c)| &names[c]).unique().count()
    }
}

/// Finds the first ideas among minimal variants, and counts the steps taken down their diagram.
pub(in crate::search) fn ideas_in_steps(
    question: &Question,
    basis: &IdeaBasis,
    diagram: &Diagram,
    top: usize,
    steps_down: &mut usize,
) -> Vec<Idea> {
    let IdeaBasis {
        patterns, weights, ..
    } = basis;
    // Many weights make many kinds of each cost; then they only choose among those that stand for the same.
    let few = weights.iter().sum::<u64>() <= WEIGHED;
    let steps = if few {
        question.steps.with_weights(weights)
    } else {
        question.steps.clone()
    };
    let firsts = first_variants(question, diagram, patterns, &steps, top, steps_down);
    let shown = |(group, first)| {
        let v = preferred::preferred_variant(question, diagram, patterns, weights, first);
        let order = (
            patterns.is_symmetric(&v) != Some(true),
            basis.count_kinds(&v),
        );
        ((group, order), v)
    };
    let mut shown = firsts.into_iter().map(shown).collect_vec();
    if diagram.layers.len() <= SORTED {
        shown.sort_by_key(|(order, _)| *order);
    }
    let listed = shown.into_iter().take(top);
    let one = |(_, v)| make_idea(question, diagram, patterns, v);
    listed.map(one).collect()
}

/// Ideas that are brought in order together: their cost in thousandths, and how many such groups of that cost come before.
type CostGroup = (i64, usize);

/// Returns the group of an idea of a cost that follows those found.
fn cost_group(cost: i64, found: &[(CostGroup, Assignment)]) -> CostGroup {
    let before = found.iter().rev();
    let before = before.take_while(|((c, _), _)| *c == cost).count();
    (cost, before / TOGETHER)
}

/// Returns of each of the first ideas a variant, the cheapest and of these the one with least weight; where ideas are brought in order
/// all of the groups that the first `top` belong to.
fn first_variants(
    question: &Question,
    diagram: &Diagram,
    patterns: &Patterns,
    steps: &Steps,
    top: usize,
    steps_down: &mut usize,
) -> Vec<(CostGroup, Assignment)> {
    if top == 0 {
        return Vec::new();
    }
    let order = diagram.layers.iter().map(|l| l.variable).collect_vec();
    let sorts = order.len() <= SORTED;
    let mut slack = 0_u64;
    let mut best = Vec::new();
    loop {
        let mut entered: BTreeSet<(usize, usize, Key, Pattern)> = BTreeSet::new();
        let enter = |depth: usize, node: usize, rest: Key, choices: &[usize]| {
            *steps_down += 1;
            let chosen = order[..depth].iter().map(|&v| (v, choices[v]));
            entered.insert((depth, node, rest, patterns.sum_pattern(chosen)))
        };
        let mut seen = BTreeSet::new();
        let mut found: Vec<(CostGroup, Assignment)> = Vec::new();
        let (reach, wanted) = (Reach::Above(slack), |k| question.is_wanted(k));
        let list = Cheapest::new(question, diagram, steps, reach, &wanted, Box::new(enter));
        let mut ended = list.is_all();
        for v in list {
            if !seen.insert(patterns.idea_pattern(&v)) {
                continue;
            }
            let end = diagram.end_of(&v.choices).unwrap_or_default();
            let v = Assignment {
                key: question.steps.variant_key(&v.choices, end),
                ..v
            };
            let group = cost_group(question.steps.cost_in_milli(v.key.cost()), &found);
            if found.len() >= top && group > found[top - 1].0 {
                ended = true;
                break;
            }
            found.push((group, v));
            if !sorts && found.len() == top {
                ended = true;
                break;
            }
        }
        // Where memory ends there may be fewer than with less slack.
        if found.len() >= best.len() {
            best = found;
        }
        if ended {
            break;
        }
        slack = (2 * slack).max(1);
    }
    best
}

/// Returns the first variant of each idea in a list, with its place in the list.
pub fn first_of_each<'a>(
    question: &Question,
    list: impl Iterator<Item = &'a Assignment>,
    diagrams: &Diagrams,
) -> Vec<(usize, Idea)> {
    let patterns = freedom_patterns(question);
    let mut seen = BTreeSet::new();
    list.enumerate()
        .filter(|(_, v)| seen.insert(patterns.idea_pattern(v)))
        .map(|(place, v)| {
            let idea = make_idea(question, diagrams.listed_diagram(), &patterns, v.clone());
            (place, idea)
        })
        .collect()
}

/// Returns the first `top` ideas in a list of all variants in order, with the number of variants of each.
///
/// # Complexity
/// O(list · variables · log).
pub fn ideas_among(
    question: &Question,
    list: impl Iterator<Item = Assignment>,
    top: usize,
) -> Vec<Idea> {
    let patterns = freedom_patterns(question);
    let mut at: BTreeMap<Pattern, Option<usize>> = BTreeMap::new();
    let mut out: Vec<Idea> = Vec::new();
    for v in list {
        let place = at.entry(patterns.idea_pattern(&v)).or_insert_with(|| {
            (out.len() < top).then(|| {
                out.push(Idea {
                    added: patterns.added_freedoms(&patterns.of_variant(&v)),
                    symmetric: patterns.is_symmetric(&v),
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

/// Returns the idea of a variant, with the number of variants in the diagram that share it.
fn make_idea(
    question: &Question,
    diagram: &Diagram,
    patterns: &Patterns,
    first: Assignment,
) -> Idea {
    let alike = patterns.of_images(&first);
    let alike = alike.iter();
    Idea {
        added: patterns.added_freedoms(&patterns.of_variant(&first)),
        variants: alike
            .map(|p| with_pattern(question, diagram, patterns, p))
            .sum(),
        symmetric: patterns.is_symmetric(&first),
        first,
    }
}

/// Returns the number of variants in a diagram that have a pattern.
fn with_pattern(
    question: &Question,
    diagram: &Diagram,
    patterns: &Patterns,
    pattern: &Pattern,
) -> BigUint {
    let steps = question.steps.keep_kinds(limited_kinds(question, true));
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
        let key = Key(key.0 + steps.redundancy_key(diagram.terminals[*node]).0);
        left.iter().all(|n| *n == 0) && question.is_wanted(key)
    });
    whole.map(|(_, n)| n).sum()
}
