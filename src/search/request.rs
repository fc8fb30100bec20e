//! A search from question to answer: what is asked, and which variants answer it.

use crate::closure::contour::contour_basis;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::modp::Residue;
use crate::model::coupling::{CoupledFreedom, Coupling};
use crate::model::mechanism::{JointId, LinkId, Mechanism, Role, StateId};
use crate::rank::numeric::DEFAULT_TOLERANCE;
use crate::redundancy::motion::joint_motion;
use crate::search::best::{self, Variant};
use crate::search::brute::{self, Matrices};
use crate::search::building::Diagrams;
use crate::search::cost::CostTable;
use crate::search::counts::Counts;
use crate::search::diagram::Diagram;
use crate::search::space::Space;
use crate::search::tally::{Key, Kinds, Steps, Tally};
use num_bigint::BigUint;
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
    /// Second opinions take singular values below this fraction of the largest for zero.
    pub tolerance: f64,
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
            tolerance: DEFAULT_TOLERANCE,
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
    /// A coupling without a mirror image.
    #[error(
        "joints {coupling} are coupled, their mirror images are not, or in another ratio; couple both pairs alike, or search without symmetry"
    )]
    UnlikeCoupling {
        /// The coupling.
        coupling: String,
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
    pub(super) exact: ExactField,
    /// Rows of J in the free state.
    rows: i64,
    /// Links whose motion is kept, with their present joint motion.
    pub(super) kept: (Vec<LinkId>, Vec<Vec<Residue>>),
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
            if let Some(c) = mechanism.couplings.iter().find(|c| !mirrored(mechanism, c)) {
                return Err(SearchError::UnlikeCoupling {
                    coupling: c.name(mechanism),
                });
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
        let outputs = mechanism
            .link_ids()
            .filter(|&l| mechanism.links[l].role == Role::Output);
        let mut kept: Vec<LinkId> = outputs
            .chain(mechanism.search.hold.iter().copied())
            .collect();
        kept.sort_unstable();
        kept.dedup();
        let present = joint_motion(&exact, mechanism, StateId::FREE, &kept)?;
        let rows = space.dim * contour_basis(mechanism, StateId::FREE).len()
            + mechanism.couplings_in(StateId::FREE).count();
        let rows = i64::try_from(rows).unwrap_or(i64::MAX);
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

    /// Whether a variant's key meets the conditions on mobility and changes.
    #[must_use]
    pub fn wanted(&self, key: Key) -> bool {
        self.request
            .max_mobility
            .is_none_or(|m| self.mobility(key) <= m)
            && self.request.max_changes.is_none_or(|c| key.changes() <= c)
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
        let of = |j: JointId| self.space.variables.iter().position(|v| v.joints == [j]);
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

/// Whether the mirror images of two coupled joints are coupled alike, whichever way they turn.
fn mirrored(mechanism: &Mechanism, coupling: &Coupling) -> bool {
    /// Relative difference of equal ratios.
    const EQUAL: f64 = 1e-12;
    let image = |j: JointId| {
        let pairs = mechanism.search.mirror.iter();
        let other = pairs
            .flat_map(|&(a, b)| [(a, b), (b, a)])
            .find(|p| p.0 == j);
        other.map_or(j, |p| p.1)
    };
    let [a, b] = coupling.ends.map(|e| CoupledFreedom {
        joint: image(e.joint),
        ..e
    });
    let ratio = coupling.ratio.to_f64().abs();
    mechanism.couplings.iter().any(|c| {
        let other = c.ratio.to_f64().abs();
        let near = |x: f64| (x / ratio - 1.0).abs() < EQUAL;
        (c.ends == [a, b] && near(other)) || (c.ends == [b, a] && near(1.0 / other))
    })
}
