//! The conditions that variants must meet, and a search made ready for them.

use crate::closure::contour::contour_basis;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::modp::Residue;
use crate::model::coupling::{CoupledFreedom, Coupling};
use crate::model::mechanism::{JointId, LinkId, Mechanism, Role, StateId};
use crate::rank::numeric::DEFAULT_TOLERANCE;
use crate::redundancy::motion::joint_motion;
use crate::search::best::{self, Assignment, Cheapest};
use crate::search::building::Diagrams;
use crate::search::cost::CostTable;
use crate::search::diagram::Diagram;
use crate::search::space::Space;
use crate::search::tally::{Key, Kinds, Steps, Tally};
use num_bigint::BigUint;
use std::sync::Arc;
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

/// What variants must be like, said of one mechanism: its state by number.
#[derive(Debug, Clone)]
pub struct Conditions {
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

impl Default for Conditions {
    fn default() -> Self {
        Conditions {
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
pub struct Search {
    /// The mechanism.
    pub mechanism: Arc<Mechanism>,
    /// What variants must be like.
    pub conditions: Conditions,
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

impl Search {
    /// Makes a search ready; a mechanism given by reference is copied.
    ///
    /// # Errors
    /// Where the geometry has no exact image, or symmetry is asked of an unsymmetric file.
    pub fn new(
        exact: ExactField,
        mechanism: impl Into<Arc<Mechanism>>,
        conditions: Conditions,
    ) -> Result<Self, SearchError> {
        let mechanism: Arc<Mechanism> = mechanism.into();
        if conditions.symmetry != Symmetry::All {
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
            if let Some(c) = mechanism
                .couplings
                .iter()
                .find(|c| !mirrored(&mechanism, c))
            {
                return Err(SearchError::UnlikeCoupling {
                    coupling: c.name(&mechanism),
                });
            }
        }
        let costs = CostTable::new(&mechanism.search.costs);
        let symmetric = conditions.symmetry == Symmetry::SymmetricOnly;
        let space = Space::new(
            &exact,
            &mechanism,
            conditions.state.map(|(s, _)| s),
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
        let present = joint_motion(&exact, &mechanism, StateId::FREE, &kept)?;
        let rows = space.dim * contour_basis(&mechanism, StateId::FREE).len()
            + mechanism.couplings_in(StateId::FREE).count();
        let rows = i64::try_from(rows).unwrap_or(i64::MAX);
        Ok(Search {
            mechanism,
            conditions,
            space,
            steps,
            exact,
            rows,
            kept: (kept, present),
        })
    }

    /// The prime field of the search.
    #[must_use]
    pub fn field(&self) -> &ExactField {
        &self.exact
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
        self.conditions
            .max_mobility
            .is_none_or(|m| self.mobility(key) <= m)
            && self
                .conditions
                .max_changes
                .is_none_or(|c| key.changes() <= c)
    }

    /// The admissible variants, cheapest first, then by W, then by changes, then in the order of the diagram's variables;
    /// `top` of them at most.
    pub fn cheapest<'a>(
        &'a self,
        diagrams: &'a Diagrams,
        top: usize,
    ) -> Box<dyn Iterator<Item = Assignment> + 'a> {
        if self.conditions.symmetry != Symmetry::OnePerOrbit {
            return self.in_order(&diagrams.admissible, top);
        }
        // At most every other variant is dropped, so twice as many always suffice.
        let all = self.in_order(&diagrams.admissible, top.saturating_mul(2));
        let first_of_orbit = |v: &Assignment| self.mirrored(&v.choices) >= v.choices;
        Box::new(all.filter(first_of_orbit).take(top))
    }

    fn in_order<'a>(
        &'a self,
        diagram: &'a Diagram,
        top: usize,
    ) -> Box<dyn Iterator<Item = Assignment> + 'a> {
        let rank = |k: Key| (self.mobility(k), k.changes());
        let wanted = |k: Key| self.wanted(k);
        if self.fits() {
            Box::new(Cheapest::<u128>::new(
                diagram,
                &self.steps,
                top,
                wanted,
                rank,
            ))
        } else {
            Box::new(Cheapest::<BigUint>::new(
                diagram,
                &self.steps,
                top,
                wanted,
                rank,
            ))
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
    pub fn sample(&self, diagrams: &Diagrams, count: usize, seed: u64) -> Vec<Assignment> {
        let kinds = Kinds {
            freedoms: self.conditions.max_mobility.is_some(),
            changes: self.conditions.max_changes.is_some(),
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
