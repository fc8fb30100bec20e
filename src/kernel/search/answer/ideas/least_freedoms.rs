//! Minimal variants: no other admissible one has part of their freedoms and all of their other choices.
//!
//! A path through the diagram keeps the nodes that variants with less have reached. A variant is minimal if none of these
//! nodes leads to an end by its other choices or by less. Without the constraints of a searched state, added freedoms never
//! make a constraint redundant, and removed ones never release a link. Then variants with less at several joints have others
//! in between. It is enough to compare those with less at one joint.
//!
//! # Sources
//! Coudert, "Two-level logic minimization: an overview", Integration 17 (1994), on minimal elements of a family of sets on a
//! decision diagram. Knuth, The Art of Computer Programming 4A, section 7.1.4, "nonsub" and "nonsup".

use crate::linalg::echelon::Echelon;
use crate::search::answer::counts::count_total;
use crate::search::diagram::minimize::minimize_diagram;
use crate::search::diagram::{DEAD, Diagram, Layer, Stop};
use crate::search::question::Question;
use crate::search::question::conditions::Symmetry;
use crate::search::question::space::{Choice, Variable};
use crate::search::solve::Diagrams;
use hashbrown::HashMap;
use hashbrown::hash_map::Entry;
use num_bigint::BigUint;

/// The criterion by which another variant has less, so that this one has idle freedoms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Less {
    /// Freedoms only: no freedom of a minimal variant can be removed.
    Freedoms,
    /// Freedoms, at joints that do not cost more, with no more changes: a ball may replace a universal joint, but costs more.
    Means,
}

/// Maximum number of nodes of a diagram of minimal variants.
const MOST: usize = 1 << 18;

impl Question {
    /// Returns the number of minimal admissible variants: no other variant has only a part of their freedoms. Returns
    /// `None` if not all admissible variants are known, if orbits are counted, or if it takes too many nodes.
    ///
    /// # Complexity
    /// O(nodes of the diagram of minimal variants · choices²).
    ///
    /// # Examples
    /// ```
    /// use ozols::{rank::exact::field::exact_field, search::{Search, diagram::Control, question::conditions::Conditions}};
    /// let four_bar = ozols::built_in("four-bar")?;
    /// let search = Search::new(exact_field(&four_bar, 0)?, &four_bar, Conditions::default())?;
    /// let diagrams = search.build_diagrams(Control::NONE);
    /// assert_eq!(search.count_variants(&diagrams.admissible, true).to_string(), "14");
    /// assert_eq!(search.count_minimal(&diagrams), Some(12u32.into()));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn count_minimal(&self, diagrams: &Diagrams) -> Option<BigUint> {
        // Fewer freedoms by more changes may be more than there may be.
        let limited = self.conditions.max_changes.is_some()
            && !Order::new(self, Less::Freedoms).fewer_changes;
        if limited || self.conditions.symmetry == Symmetry::OnePerOrbit {
            return None;
        }
        Some(count_total(self, &self.minimal_variants(diagrams)?, true))
    }

    /// Returns the diagram of the minimal variants. Returns `None` if not all admissible variants are known, or if it
    /// takes too many nodes.
    #[must_use]
    pub fn minimal_variants(&self, diagrams: &Diagrams) -> Option<Diagram> {
        minimal_variants(self, diagrams.listed_diagram(), Less::Freedoms)
    }
}

/// Which choices of each variable have less than another.
struct Order {
    /// `[variable][choice]`: the others with no more, and whether they have less.
    within: Vec<Vec<Vec<(usize, bool)>>>,
    /// `[variable][choice]`: of those with less the ones with most.
    next: Vec<Vec<Vec<usize>>>,
    /// Whether what has less never changes more joints.
    fewer_changes: bool,
}

impl Order {
    /// Returns the order of the choices of a question.
    fn new(question: &Question, less: Less) -> Order {
        let within = |v: &Variable| -> Vec<Vec<(usize, bool)>> {
            let spans = v
                .choices
                .iter()
                .map(|c| choice_spans(question, c))
                .collect::<Vec<_>>();
            let has = |a: usize, b: usize| {
                let members = v.choices[a].spans.iter().zip(&spans[b]);
                members
                    .into_iter()
                    .all(|(rows, span)| rows.iter().all(|r| span.contains(r)))
            };
            let no_dearer = |a: &Choice, b: &Choice| {
                less == Less::Freedoms || a.cost_milli <= b.cost_milli && a.changes <= b.changes
            };
            let of = |b: usize| {
                let others = (0..v.choices.len()).filter(|&a| a != b && has(a, b));
                let others = others.filter(|&a| no_dearer(&v.choices[a], &v.choices[b]));
                others.map(|a| (a, !has(b, a))).collect()
            };
            (0..v.choices.len()).map(of).collect()
        };
        let within: Vec<_> = question.space.variables.iter().map(within).collect();
        let next = |of: &Vec<Vec<(usize, bool)>>| -> Vec<Vec<usize>> {
            let below = |b: usize| of[b].iter().filter(|(_, less)| *less).map(|(a, _)| *a);
            let between = |a: usize, b: usize| below(b).any(|c| below(c).any(|x| x == a));
            (0..of.len())
                .map(|b| below(b).filter(|&a| !between(a, b)).collect())
                .collect()
        };
        let fewer = |(v, of): (&Variable, &Vec<Vec<(usize, bool)>>)| {
            let changes = |c: usize| v.choices[c].changes;
            let mut all = of.iter().enumerate();
            all.all(|(b, less)| less.iter().all(|&(a, _)| changes(a) <= changes(b)))
        };
        Order {
            next: within.iter().map(next).collect(),
            fewer_changes: question.space.variables.iter().zip(&within).all(fewer),
            within,
        }
    }
}

/// Returns the motion of each joint of a choice.
fn choice_spans(question: &Question, choice: &Choice) -> Vec<Echelon> {
    let span = |rows: &Vec<Vec<_>>| Echelon::from_vectors(question.exact.field(), rows);
    choice.spans.iter().map(span).collect()
}

/// A node that a variant has reached, with others.
#[derive(Clone, PartialEq, Eq, Hash)]
struct Arrived {
    node: u32,
    /// Those that variants with no more have come to: twice the number, and one more for those with less.
    others: Vec<u32>,
}

/// Returns the variants of a diagram for which no other variant has less. `None` if not all are known, or if it takes too many nodes.
pub(super) fn minimal_variants(
    question: &Question,
    diagram: &Diagram,
    less: Less,
) -> Option<Diagram> {
    if diagram.stop != Stop::Exhausted {
        return None;
    }
    let order = Order::new(question, less);
    let once = question.conditions.state.is_none();
    let room = MOST.min(question.conditions.nodes);
    let mut states = vec![Arrived {
        node: 0,
        others: Vec::new(),
    }];
    let mut layers = Vec::with_capacity(diagram.layers.len());
    let mut met = 1;
    for (depth, layer) in diagram.layers.iter().enumerate() {
        let last = depth + 1 == diagram.layers.len();
        let mut known: HashMap<Arrived, u32> = HashMap::new();
        let mut below: Vec<Arrived> = Vec::new();
        let mut edges = Vec::with_capacity(states.len() * layer.choices);
        for state in &states {
            for choice in 0..layer.choices {
                let Some(to) = carry_state(layer, &order, once, state, choice, last) else {
                    edges.push(DEAD);
                    continue;
                };
                edges.push(match known.entry(to) {
                    Entry::Occupied(o) => *o.get(),
                    Entry::Vacant(v) => {
                        let number = u32::try_from(below.len()).ok()?;
                        below.push(v.key().clone());
                        *v.insert(number)
                    }
                });
            }
            if met + below.len() > room {
                return None;
            }
        }
        met += below.len();
        layers.push(Layer {
            variable: layer.variable,
            nodes: states.len(),
            choices: layer.choices,
            edges,
        });
        states = below;
    }
    let ends = states
        .iter()
        .map(|state| diagram.terminals.get(state.node as usize).copied());
    Some(minimize_diagram(layers, ends.collect::<Option<_>>()?))
}

/// Returns the state after a choice; `None` if a variant with less gets as far.
fn carry_state(
    layer: &Layer,
    order: &Order,
    once: bool,
    state: &Arrived,
    choice: usize,
    last: bool,
) -> Option<Arrived> {
    let edge = |node: u32, choice: usize| {
        let to = layer.edges[node as usize * layer.choices + choice];
        (to != DEAD).then_some(to)
    };
    let to = edge(state.node, choice)?;
    let within = &order.within[layer.variable][choice];
    let mut out = Vec::with_capacity(state.others.len() + within.len());
    let mut put = |to: Option<u32>, less: bool| out.extend(to.map(|t| t << 1 | u32::from(less)));
    for other in &state.others {
        let (at, less) = (other >> 1, other & 1 == 1);
        put(edge(at, choice), less);
        if !once {
            within
                .iter()
                .for_each(|&(c, l)| put(edge(at, c), less || l));
        }
    }
    if once {
        let next = &order.next[layer.variable][choice];
        next.iter().for_each(|&c| put(edge(state.node, c), true));
    } else {
        within
            .iter()
            .for_each(|&(c, l)| put(edge(state.node, c), l));
    }
    // All that follows is open to the one with less, too; and at the end nothing follows.
    if out.contains(&(to << 1 | 1)) || last && out.iter().any(|o| o & 1 == 1) {
        return None;
    }
    out.retain(|o| *o != to << 1);
    out.sort_unstable();
    out.dedup();
    let less: Vec<u32> = out.iter().filter(|o| *o & 1 == 1).copied().collect();
    out.retain(|o| o & 1 == 1 || less.binary_search(&(o | 1)).is_err());
    Some(Arrived {
        node: to,
        others: if last { Vec::new() } else { out },
    })
}
