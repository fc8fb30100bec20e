//! The determinate variants that all layouts of a chain and its input share if their pins are in general position, as far as the symmetry
//! and the parallelograms of a structure leave them free.
//!
//! A variant is determinate if the columns that it adds have the full rank. At special places a rank is lower than at nearly
//! all places, never higher. So a variant that is determinate at some place is determinate in general position. One search, at
//! places drawn at random, therefore serves all layouts with the same determinate variants. Following the minimal variants over
//! one prime shows whether a layout has them, because modulo a prime a rank is never higher either. A minimal diagram is the
//! only one of its variants in an order of variables, so diagrams are compared edge by edge.

use crate::catalog::spec::Spec;
use crate::catalog::{RowError, built_mechanism, prepare_search, search_request};
use crate::chains::chain::Chain;
use crate::chains::roles::Roles;
use crate::chains::structure::PairStructure;
use crate::chains::{Symmetry, graph6};
use crate::model::mechanism::Mechanism;
use crate::score::request::{List, Request};
use crate::score::run::{RunError, run};
use crate::search::Search;
use crate::search::answer::counts::count_orbits;
use crate::search::answer::ideas::{Idea, IdeaBasis};
use crate::search::check::second_prime::have_same_edges;
use crate::search::diagram::{Control, Diagram, Stop};
use crate::search::question::conditions;
use crate::synthesis::mechanism::bare_file;
use crate::synthesis::places::Places;
use crate::synthesis::random_of;
use crate::synthesis::rules::Rules;
use crate::synthesis::structure::{Form, Lay, Structure};
use chacha20::rand_core::Rng;
use num_bigint::BigUint;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// The maximum number of pairs of random places that are tried until both places have the same variants. Nearly always the first do.
const PAIRS_OF_PLACES: usize = 4;

/// A chain and an input, of which all layouts in general position have the same determinate variants.
#[derive(Debug)]
pub struct General {
    /// The determinate variants.
    diagram: Diagram,
    /// The minimal ones among them, if they are known.
    minimal: Option<Diagram>,
    /// The variants that ideas consist of.
    idea_variants: Diagram,
    /// The first ideas of layouts, each with what they depend on.
    ideas: Mutex<Vec<(IdeaBasis, Vec<Idea>)>>,
    /// Counts of the determinate variants by W and number of changes.
    pub counts: BTreeMap<(i64, u32), BigUint>,
    /// Those that are their own image under the symmetry of the structure.
    pub(super) symmetric: Symmetric,
}

/// Variants that a mechanism's symmetry keeps. Each is one orbit; the others are in orbits of two or three.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Symmetric {
    /// Order of the symmetry. 1 without a symmetry; then every variant is its own image.
    pub order: usize,
    /// By W and number of changes.
    pub counts: BTreeMap<(i64, u32), BigUint>,
    /// Whether every count is exact; lower bounds otherwise.
    pub exact: bool,
}

impl Symmetric {
    /// Creates the result for a mechanism without a symmetry.
    #[must_use]
    pub fn without_symmetry() -> Symmetric {
        Symmetric {
            order: 1,
            exact: true,
            counts: BTreeMap::new(),
        }
    }

    /// Searches only for the variants that a mechanism's symmetry keeps.
    ///
    /// # Errors
    /// Returns an error if the symmetry that the file names is invalid, or if the search fails.
    pub fn search_symmetric(
        mechanism: &Mechanism,
        request: &Request,
    ) -> Result<Symmetric, RunError> {
        let order = mechanism.search.symmetry_order();
        if order == 1 {
            return Ok(Symmetric::without_symmetry());
        }
        let request = Request {
            symmetry: conditions::Symmetry::SymmetricOnly,
            list: List::Nothing,
            ..request.clone()
        };
        let outcome = run(mechanism.clone(), &request, &|| false, &mut |_| {})?;
        Ok(Symmetric {
            order,
            exact: outcome.is_exact(),
            counts: outcome.determinate.by_mobility_and_changes,
        })
    }

    /// Returns how many of `variants` variants of W and number of changes are their own image, and the number of orbits.
    #[must_use]
    pub fn split_orbits(&self, key: &(i64, u32), variants: &BigUint) -> (BigUint, BigUint) {
        if self.order <= 1 {
            return (variants.clone(), variants.clone());
        }
        let own = self.counts.get(key).cloned().unwrap_or_default();
        let orbits = count_orbits(variants, &own, self.order);
        (own, orbits)
    }
}

/// A chain of hinges and its input. Layouts of structures with the same pair have the same determinate variants in general position.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct InputPair {
    /// The chain. Its input joint is a slide if the driver slides.
    chain: Chain,
    /// The links of the input joint, the lesser number first.
    input: [usize; 2],
}

impl InputPair {
    /// Returns the pair of a structure. `None` if its layouts are special by design, or if it has other pairs than hinges.
    #[must_use]
    pub fn of_structure(structure: &Structure) -> Option<InputPair> {
        let form = structure.form;
        let general = form.hinges && form.symmetry == Symmetry::Generic && !form.parallel;
        let PairStructure { chain, roles } = &structure.structure;
        general.then(|| InputPair {
            chain: chain.clone(),
            input: roles.input,
        })
    }

    /// Returns a structure that represents the pair, independent of the requested structures.
    fn pair_structure(self, form: Form) -> Structure {
        let jaws = (0..self.chain.links()).filter(|l| !self.input.contains(l));
        let roles = Roles {
            frame: self.input[0],
            input: self.input,
            jaws: jaws.take(2).collect(),
        };
        let chain = self.chain;
        Structure::new(PairStructure { chain, roles }, form)
    }
}

/// Returns a structure with the same places in general position, and its rules. `None` if it has pairs other than hinges, a symmetry of
/// thirds of a turn, or no rules.
fn places_in_general(structure: &Structure) -> Option<(Structure, Rules)> {
    if let Some(pair) = InputPair::of_structure(structure) {
        let first = pair.pair_structure(structure.form);
        let swap = (0..first.structure.chain.links()).collect();
        let rules = Rules::new(&first, &Lay { swap, bits: 0 }).ok()?;
        return Some((first, rules));
    }
    let form = structure.form;
    let lay = (form.hinges && form.symmetry != Symmetry::Threefold)
        .then(|| structure.hinged_lay().ok())
        .flatten()?;
    let rules = Rules::new(structure, &lay).ok()?;
    Some((structure.clone(), rules))
}

/// Returns a structure with its pins at random places that keep its rules. The same number gives the same places.
fn at_random(
    structure: &Structure,
    rules: &Rules,
    spec: &Spec,
    number: usize,
) -> Result<Mechanism, RowError> {
    let PairStructure { chain, roles } = &structure.structure;
    let [u, v] = roles.input;
    let mut random = random_of(&format!("{} {u}-{v} {number}", graph6::write_graph(chain)));
    // A fraction, so that differences of places and corners of parallelograms are small, too.
    let mut coordinate = || f64::from(random.next_u32().cast_signed() / 8);
    let points = rules.joints.iter().map(|_| [coordinate(), coordinate()]);
    let mut at = Places::of_hinges(points.collect());
    rules.settle_joints(&mut at);
    let file = bare_file(structure, rules, &at, &spec.option_menu()?);
    built_mechanism(&structure.name(), &file)
}

impl General {
    /// Searches the pair of a structure at two random places, each over a prime; both must agree. A structure that is symmetric or has
    /// parallelograms is searched by itself, at places that keep its rules. Returns `None` if it has no such places, or if the node budget ends
    /// the search. Structures with pairs other than hinges give `None`, too.
    ///
    /// # Errors
    /// Returns an error if the specification is wrong, or the program fails.
    ///
    /// # Guarantee
    /// A variant that both miss is determinate in general position only if a minor vanishes at two independent random places,
    /// each modulo a prime near 2^61.
    ///
    /// # Complexity
    /// Two searches.
    pub fn search_general(structure: &Structure, spec: &Spec) -> Result<Option<General>, RowError> {
        let Some((first, rules)) = places_in_general(structure) else {
            return Ok(None);
        };
        for number in 0..PAIRS_OF_PLACES {
            let over = |prime: usize| {
                let places = at_random(&first, &rules, spec, 2 * number + prime)?;
                prepare_search(places, spec, prime)
            };
            let (one, two) = (over(0)?, over(1)?);
            let orders = one.variable_orders();
            let built = |s: &Search| s.build_in(&orders, Control::NONE);
            let (diagrams, twin) = rayon::join(|| built(&one), || built(&two).determinate);
            let diagram = &diagrams.determinate;
            if diagram.stop != Stop::Exhausted {
                return Ok(None);
            }
            if twin.stop == Stop::Exhausted && have_same_edges(diagram, &twin) {
                let request = search_request(spec);
                return Ok(Some(General {
                    counts: one.count_variants(diagram, false).by_mobility_and_changes,
                    minimal: one.minimal_variants(&diagrams),
                    idea_variants: one.idea_variants(&diagrams).into_owned(),
                    symmetric: Symmetric::search_symmetric(&one.mechanism, &request)?,
                    ideas: Mutex::default(),
                    diagram: diagrams.determinate,
                }));
            }
        }
        Ok(None)
    }

    /// Returns the search of a layout over one prime if all variants that are determinate in general position are determinate
    /// there. Then no others are, and all counts are those of the pair. The minimal variants are enough, because added freedoms
    /// leave a variant determinate.
    ///
    /// # Errors
    /// Returns an error if the mechanism cannot be searched.
    ///
    /// # Complexity
    /// That of [`Search::has_all`] for the minimal variants. One diagram if the minimal variants are unknown.
    pub(super) fn certify_layout(
        &self,
        layout: Mechanism,
        spec: &Spec,
    ) -> Result<Option<Search>, RowError> {
        let search = prepare_search(layout, spec, 0)?;
        let has_all = search.has_all(self.minimal.as_ref().unwrap_or(&self.diagram));
        Ok(has_all.then_some(search))
    }

    /// Returns at most `top` first ideas of a certified layout. They are those of an earlier layout if they depend on the same data. `top`
    /// must be the same for all layouts of the pair.
    ///
    /// # Complexity
    /// That of a search for ideas, once for each way in which the links of the pair are frame, jaws and rods.
    pub(super) fn cached_ideas(&self, search: &Search, top: usize) -> Vec<Idea> {
        let basis = search.idea_basis();
        // An entry of a thread that panicked is complete.
        let known = || self.ideas.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, ideas)) = known().iter().find(|(of, _)| *of == basis) {
            return ideas.clone();
        }
        let ideas = search.ideas_among(&basis, &self.idea_variants, top);
        known().push((basis, ideas.clone()));
        ideas
    }
}
