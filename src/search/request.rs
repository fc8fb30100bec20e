//! A search from question to answer: what is asked, and the diagrams that answer it.

use crate::closure::contour::contour_basis;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, LinkId, Mechanism, Role, StateId};
use crate::redundancy::motion::joint_motion;
use crate::search::best::{self, Variant};
use crate::search::brute::{self, Matrices};
use crate::search::cost::CostTable;
use crate::search::diagram::{self, Collapse, Diagram, Limits, Progress, Stage, Stop};
use crate::search::lookahead::lookahead;
use crate::search::order::variable_order;
use crate::search::plan::plan;
use crate::search::space::Space;
use crate::search::tally::{Count, Key, Kinds, Steps, Tally};
use num_bigint::BigUint;
use num_traits::Zero;
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use thiserror::Error;

/// Which variants of a mirror-symmetric mechanism are wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Symmetry {
    /// All.
    #[default]
    All,
    /// Only those that are their own mirror image.
    SymmetricOnly,
    /// Of each variant and its mirror image, one.
    OnePerOrbit,
}

/// What is asked.
#[derive(Debug, Clone)]
pub struct Request {
    /// Redundant constraints allowed within the mechanism.
    pub max_redundant: u32,
    /// The state whose additional joints take part, with the external redundancy allowed there.
    pub state: Option<(StateId, u32)>,
    /// Largest mobility W allowed.
    pub max_mobility: Option<i64>,
    /// Most changes allowed.
    pub max_changes: Option<u32>,
    /// Whether the outputs, and the links the file holds, must keep exactly their present motions.
    pub keep_output: bool,
    /// Mirror symmetry.
    pub symmetry: Symmetry,
    /// Node budget of each diagram.
    pub nodes: usize,
}

impl Default for Request {
    fn default() -> Self {
        Request {
            max_redundant: 0,
            state: None,
            max_mobility: None,
            max_changes: None,
            keep_output: true,
            symmetry: Symmetry::All,
            nodes: 1_000_000,
        }
    }
}

/// Why a search could not be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SearchError {
    /// The geometry has no image in the field.
    #[error(transparent)]
    Exact(#[from] ExactError),
    /// Symmetry asked of a mechanism whose file names no mirror pairs.
    #[error(
        "{mechanism} names no mirror pairs; add `mirror = [[\"joint\", \"its image\"], ...]` under [search]"
    )]
    NoMirror {
        /// Name of the mechanism.
        mechanism: String,
    },
    /// Mirrored joints that offer different options.
    #[error(
        "joints {first} and {second} are mirror images but offer different options; give both the same list"
    )]
    UnlikeMirror {
        /// One joint.
        first: String,
        /// Its image.
        second: String,
    },
}

/// Exact counts of some variants, by their properties.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Counts {
    /// All of them.
    pub total: BigUint,
    /// By W.
    pub by_mobility: BTreeMap<i64, BigUint>,
    /// By number of changes.
    pub by_changes: BTreeMap<u32, BigUint>,
    /// By W and number of changes.
    pub by_mobility_and_changes: BTreeMap<(i64, u32), BigUint>,
    /// By redundant constraints within the mechanism.
    pub by_redundant: BTreeMap<u32, BigUint>,
    /// By freedoms f.
    pub by_freedoms: BTreeMap<u32, BigUint>,
}

impl Counts {
    fn add(&mut self, mobility: i64, key: Key, count: &BigUint) {
        self.total += count;
        *self.by_mobility.entry(mobility).or_default() += count;
        *self.by_changes.entry(key.changes()).or_default() += count;
        *self
            .by_mobility_and_changes
            .entry((mobility, key.changes()))
            .or_default() += count;
        *self.by_redundant.entry(key.internal()).or_default() += count;
        *self.by_freedoms.entry(key.freedoms()).or_default() += count;
    }

    /// Orbits of a mirror symmetry, from all variants and the symmetric ones (Burnside's lemma).
    fn orbits(mut self, symmetric: &Counts) -> Counts {
        fn half<K: Ord>(all: &mut BTreeMap<K, BigUint>, fixed: &BTreeMap<K, BigUint>) {
            for (k, n) in all.iter_mut() {
                *n = (&*n + fixed.get(k).cloned().unwrap_or_default()) / 2u8;
            }
        }
        self.total = (self.total + &symmetric.total) / 2u8;
        half(&mut self.by_mobility, &symmetric.by_mobility);
        half(&mut self.by_changes, &symmetric.by_changes);
        half(
            &mut self.by_mobility_and_changes,
            &symmetric.by_mobility_and_changes,
        );
        half(&mut self.by_redundant, &symmetric.by_redundant);
        half(&mut self.by_freedoms, &symmetric.by_freedoms);
        self
    }
}

/// A search made ready: space, costs, and the diagram of the admissible variants.
#[derive(Debug)]
pub struct Search<'m> {
    /// The mechanism.
    pub mechanism: &'m Mechanism,
    /// What is asked.
    pub request: Request,
    /// The space (with mirrored pairs as one variable where only symmetric variants are wanted).
    pub space: Space,
    /// Its costs.
    pub steps: Steps,
    exact: ExactField,
    /// Rows of J in the free state.
    rows: i64,
    /// Links whose motion is kept, with their present joint motion.
    kept: (Vec<LinkId>, Vec<Vec<Residue>>),
}

/// Diagrams of one search.
#[derive(Debug)]
pub struct Diagrams {
    /// Of the variants that meet the redundancy condition of the free state.
    pub determinate: Diagram,
    /// Of those that meet every condition that does not depend on counts of changes and mobility.
    pub admissible: Diagram,
    /// The variables in the order the admissible diagram takes them.
    pub order: Vec<usize>,
}

impl Diagrams {
    /// The less complete of the two reasons for stopping.
    #[must_use]
    pub fn stop(&self) -> Stop {
        if self.determinate.stop == Stop::Exhausted {
            self.admissible.stop
        } else {
            self.determinate.stop
        }
    }
}

impl<'m> Search<'m> {
    /// Makes a search ready.
    ///
    /// # Errors
    /// Where the geometry has no exact image, or symmetry is asked of an unsymmetric file.
    pub fn new(
        exact: ExactField,
        mechanism: &'m Mechanism,
        request: Request,
    ) -> Result<Self, SearchError> {
        if request.symmetry != Symmetry::All {
            if mechanism.search.mirror.is_empty() {
                return Err(SearchError::NoMirror {
                    mechanism: mechanism.name.clone(),
                });
            }
            for &(a, b) in &mechanism.search.mirror {
                let (a, b) = (&mechanism.joints[a], &mechanism.joints[b]);
                let names = |j: &crate::model::mechanism::Joint| -> Vec<String> {
                    j.options
                        .iter()
                        .chain(&j.unloading)
                        .map(|o| o.name.clone())
                        .collect()
                };
                if names(a) != names(b) {
                    return Err(SearchError::UnlikeMirror {
                        first: a.id.clone(),
                        second: b.id.clone(),
                    });
                }
            }
        }
        let costs = CostTable::new(&mechanism.search.costs);
        let symmetric = request.symmetry == Symmetry::SymmetricOnly;
        let space = Space::new(
            &exact,
            mechanism,
            request.state.map(|(s, _)| s),
            symmetric,
            &costs,
        )?;
        let steps = Steps::new(&space);
        let outputs =
            (0..mechanism.links.len()).filter(|&l| mechanism.links[l].role == Role::Output);
        let mut kept: Vec<LinkId> = outputs
            .chain(mechanism.search.hold.iter().copied())
            .collect();
        kept.sort_unstable();
        kept.dedup();
        let present = joint_motion(&exact, mechanism, 0, &kept)?;
        let rows = i64::try_from(space.dim * contour_basis(mechanism, 0).len()).unwrap_or(i64::MAX);
        Ok(Search {
            mechanism,
            request,
            space,
            steps,
            exact,
            rows,
            kept: (kept, present),
        })
    }

    /// Number of variants asked about: of orbits, where one of each is wanted.
    #[must_use]
    pub fn size(&self) -> BigUint {
        self.space.size()
    }

    /// W of a variant, from its key: f - rank = f - 6k + σ.
    #[must_use]
    pub fn mobility(&self, key: Key) -> i64 {
        i64::from(key.freedoms()) - self.rows + i64::from(key.internal())
    }

    /// Builds both diagrams.
    pub fn build(
        &self,
        cancelled: &(dyn Fn() -> bool + Sync),
        progress: &mut dyn FnMut(Progress),
    ) -> Diagrams {
        let limits = |external| Limits {
            internal: self.request.max_redundant,
            external,
            nodes: self.request.nodes,
        };
        let (free, added): (Vec<usize>, Vec<usize>) =
            (0..self.space.variables.len()).partition(|&v| !self.space.variables[v].external);
        let order = variable_order(self.mechanism, &self.space, &free, &[]);
        let joints = |order: &[usize]| -> Vec<usize> {
            order
                .iter()
                .flat_map(|&v| self.space.variables[v].joints.iter().copied())
                .collect()
        };
        let idle = added.iter().map(|&variable| Stage {
            variable,
            steps: Vec::new(),
            external: true,
            collapse: None,
            lookahead: None,
        });
        let mut stages = diagram::stages(
            &self.space,
            &order,
            &plan(self.mechanism, &joints(&order), &[], &[]),
        );
        stages.extend(idle);
        let determinate = diagram::build(
            &self.exact,
            &self.space,
            &stages,
            &limits(u32::MAX),
            cancelled,
            progress,
        );
        if !self.request.keep_output && added.is_empty() {
            return Diagrams {
                admissible: determinate.clone(),
                determinate,
                order,
            };
        }
        let mut pinned = vec![self.mechanism.frame()];
        pinned.extend(&self.kept.0);
        let free_links: Vec<LinkId> = self
            .mechanism
            .joints_in(0)
            .flat_map(|j| self.mechanism.joints[j].links)
            .collect();
        let contacts = joints(&added)
            .into_iter()
            .flat_map(|j| self.mechanism.joints[j].links);
        pinned.extend(contacts.filter(|l| free_links.contains(l)));
        pinned.sort_unstable();
        pinned.dedup();
        let mut order = variable_order(
            self.mechanism,
            &self.space,
            &free,
            &[self.mechanism.frame()],
        );
        let first = plan(self.mechanism, &joints(&order), &pinned, &[]);
        let mut stages = diagram::stages(&self.space, &order, &first);
        let live = first
            .steps
            .last()
            .map(|s| s.live.clone())
            .unwrap_or_default();
        if self.request.keep_output {
            self.look_ahead(&mut stages);
        }
        let start: Vec<Vec<LinkId>> = match live.first() {
            Some((root, _)) => vec![
                std::iter::once(*root)
                    .chain(live.iter().map(|(_, l)| *l))
                    .collect(),
            ],
            None => Vec::new(),
        };
        let second = plan(self.mechanism, &joints(&added), &[], &start);
        stages.extend(diagram::stages(&self.space, &added, &second));
        let external = self.request.state.map_or(u32::MAX, |(_, e)| e);
        let admissible = diagram::build(
            &self.exact,
            &self.space,
            &stages,
            &limits(external),
            cancelled,
            progress,
        );
        order.extend(added);
        Diagrams {
            determinate,
            admissible,
            order,
        }
    }

    /// Gives each stage of the free state the test that its nodes must pass.
    fn look_ahead(&self, stages: &mut [Stage]) {
        let present = |v: usize| {
            let variable = &self.space.variables[v];
            variable
                .joints
                .iter()
                .copied()
                .zip(variable.choices[0].spans.iter().cloned())
        };
        for i in 0..stages.len() {
            let left: Vec<_> = stages[i + 1..]
                .iter()
                .flat_map(|s| present(s.variable))
                .collect();
            let Some((_, last)) = stages[i].steps.last() else {
                continue;
            };
            let (kept, allowed) = (&self.kept.0, self.kept.1.len());
            let last = last.clone();
            let test = lookahead(
                &self.exact,
                self.mechanism,
                self.space.dim,
                &last.live,
                &left,
                kept,
                allowed,
            );
            stages[i].lookahead = Some(test);
            stages[i].collapse = self.collapse(&last.live, &left);
        }
    }

    /// The kept links in the frame's component that no joint to come touches.
    fn collapse(
        &self,
        live: &[(LinkId, LinkId)],
        left: &[(JointId, Vec<Vec<Residue>>)],
    ) -> Option<Collapse> {
        let (frame, dim) = (self.mechanism.frame(), self.space.dim);
        let contact = |l: LinkId| {
            let external = self
                .space
                .variables
                .iter()
                .filter(|v| v.external)
                .flat_map(|v| &v.joints);
            left.iter()
                .map(|(j, _)| j)
                .chain(external)
                .any(|&j| self.mechanism.joints[j].links.contains(&l))
        };
        let finished = |&(i, l): &(usize, &LinkId)| {
            let here = live.iter().position(|x| *x == (frame, *l));
            here.filter(|_| !contact(*l)).map(|block| (i, block))
        };
        let (places, blocks): (Vec<usize>, Vec<usize>) = self
            .kept
            .0
            .iter()
            .enumerate()
            .filter_map(|x| finished(&x))
            .unzip();
        let mut present = Echelon::new(self.exact.field());
        for row in &self.kept.1 {
            let part: Vec<Residue> = places
                .iter()
                .flat_map(|p| row[p * dim..(p + 1) * dim].iter().copied())
                .collect();
            present.insert(&part);
        }
        (!blocks.is_empty()).then(|| Collapse {
            blocks,
            present: present.reduced(),
        })
    }

    /// Whether a variant's key meets the conditions on mobility and changes.
    #[must_use]
    pub fn wanted(&self, key: Key) -> bool {
        self.request
            .max_mobility
            .is_none_or(|m| self.mobility(key) <= m)
            && self.request.max_changes.is_none_or(|c| key.changes() <= c)
    }

    /// Counts the variants of a diagram; `filter` applies the conditions on mobility and changes too.
    #[must_use]
    pub fn counts(&self, diagram: &Diagram, filter: bool) -> Counts {
        if self.fits() {
            self.count_with::<u128>(diagram, filter)
        } else {
            self.count_with::<BigUint>(diagram, filter)
        }
    }

    /// Whether every count fits 128 bits.
    fn fits(&self) -> bool {
        self.space.size().bits() <= 127
    }

    fn count_with<C: Count>(&self, diagram: &Diagram, filter: bool) -> Counts {
        let kinds = Kinds {
            freedoms: true,
            changes: true,
            cost: false,
        };
        let tally: Tally<C> = Tally::new(diagram, &self.steps.only(kinds), None);
        let mut counts = Counts::default();
        for (key, count) in tally.totals() {
            if !filter || self.wanted(*key) {
                counts.add(self.mobility(*key), *key, &count.big());
            }
        }
        counts
    }

    /// Counts by cost in thousandths of the variants of a diagram that meet every condition.
    #[must_use]
    pub fn counts_by_cost(&self, diagram: &Diagram) -> BTreeMap<i64, BigUint> {
        fn with<C: Count>(s: &Search<'_>, diagram: &Diagram) -> BTreeMap<i64, BigUint> {
            let kinds = Kinds {
                freedoms: s.request.max_mobility.is_some(),
                changes: s.request.max_changes.is_some(),
                cost: true,
            };
            let tally: Tally<C> = Tally::new(diagram, &s.steps.only(kinds), None);
            let mut out = BTreeMap::new();
            for (key, count) in tally.totals().iter().filter(|(k, _)| s.wanted(*k)) {
                *out.entry(s.steps.milli(key.cost()))
                    .or_insert_with(BigUint::zero) += count.big();
            }
            out
        }
        if self.fits() {
            with::<u128>(self, diagram)
        } else {
            with::<BigUint>(self, diagram)
        }
    }

    /// Counts of orbits from counts of all variants, by a search for the symmetric ones.
    ///
    /// # Errors
    /// As [`Search::new`].
    pub fn orbits(
        &self,
        all: (Counts, Counts),
        cancelled: &(dyn Fn() -> bool + Sync),
    ) -> Result<(Counts, Counts), SearchError> {
        let request = Request {
            symmetry: Symmetry::SymmetricOnly,
            ..self.request.clone()
        };
        let symmetric = Search::new(self.exact.clone(), self.mechanism, request)?;
        let diagrams = symmetric.build(cancelled, &mut |_| {});
        let determinate = all
            .0
            .orbits(&symmetric.counts(&diagrams.determinate, false));
        Ok((
            determinate,
            all.1.orbits(&symmetric.counts(&diagrams.admissible, true)),
        ))
    }

    /// Gives `visit` the admissible variants, cheapest first, then by W, then by changes, then in the order of the
    /// diagram's variables, until it breaks or `top` have been given.
    pub fn cheapest(
        &self,
        diagrams: &Diagrams,
        top: usize,
        visit: impl FnMut(Variant) -> ControlFlow<()>,
    ) {
        let rank = |k: Key| (self.mobility(k), k.changes());
        let wanted = |k: Key| self.wanted(k);
        if self.request.symmetry == Symmetry::OnePerOrbit {
            // At most every other variant is dropped, so twice as many always suffice.
            let (mut visit, mut left) = (visit, top);
            let visit = |v: Variant| {
                if self.mirrored(&v.choices) < v.choices {
                    return ControlFlow::Continue(());
                }
                if left == 0 {
                    return ControlFlow::Break(());
                }
                left -= 1;
                visit(v)
            };
            self.cheapest_with(
                &diagrams.admissible,
                top.saturating_mul(2),
                wanted,
                rank,
                visit,
            );
        } else {
            self.cheapest_with(&diagrams.admissible, top, wanted, rank, visit);
        }
    }

    fn cheapest_with<R: Ord>(
        &self,
        diagram: &Diagram,
        top: usize,
        wanted: impl Fn(Key) -> bool,
        rank: impl Fn(Key) -> R,
        visit: impl FnMut(Variant) -> ControlFlow<()>,
    ) {
        if self.fits() {
            best::cheapest::<u128, R>(diagram, &self.steps, top, wanted, rank, visit);
        } else {
            best::cheapest::<BigUint, R>(diagram, &self.steps, top, wanted, rank, visit);
        }
    }

    /// The choices of a variant's mirror image.
    #[must_use]
    pub fn mirrored(&self, choices: &[usize]) -> Vec<usize> {
        let mut out = choices.to_vec();
        let of = |j: usize| self.space.variables.iter().position(|v| v.joints == [j]);
        for &(a, b) in &self.mechanism.search.mirror {
            if let (Some(a), Some(b)) = (of(a), of(b)) {
                (out[a], out[b]) = (choices[b], choices[a]);
            }
        }
        out
    }

    /// Draws admissible variants, each with the same chance.
    #[must_use]
    pub fn sample(&self, diagrams: &Diagrams, count: usize, seed: u64) -> Vec<Variant> {
        let kinds = Kinds {
            freedoms: self.request.max_mobility.is_some(),
            changes: self.request.max_changes.is_some(),
            cost: false,
        };
        let keys = self.steps.only(kinds);
        let diagram = &diagrams.admissible;
        let wanted = |k: Key| self.wanted(k);
        if self.fits() {
            let tally: Tally<u128> = Tally::new(diagram, &keys, None);
            best::sample(diagram, &self.steps, &keys, &tally, count, seed, wanted)
        } else {
            let tally: Tally<BigUint> = Tally::new(diagram, &keys, None);
            best::sample(diagram, &self.steps, &keys, &tally, count, seed, wanted)
        }
    }

    /// Counts by looking at every variant: (determinate, admissible).
    #[must_use]
    pub fn brute(&self) -> (Counts, Counts) {
        let matrices = Matrices::new(&self.exact, self.mechanism, &self.space, &self.kept.0);
        let admissible = |seen: brute::Seen| {
            (!self.request.keep_output || seen.motion == self.kept.1.len())
                && self.request.state.is_none_or(|(_, e)| seen.external <= e)
        };
        let class = |seen: brute::Seen| {
            (seen.internal <= self.request.max_redundant).then(|| admissible(seen))
        };
        let (mut all, mut good) = (Counts::default(), Counts::default());
        for ((key, admissible), count) in brute::count(&matrices, &self.steps, class) {
            let count = BigUint::from(count);
            all.add(self.mobility(key), key, &count);
            if admissible && self.wanted(key) {
                good.add(self.mobility(key), key, &count);
            }
        }
        (all, good)
    }
}
