//! One structure of a catalogue: its layout, its figures, and its determinate variants.

use crate::catalog::general::{General, Symmetric};
use crate::catalog::spec::Spec;
use crate::catalog::{RowError, built_mechanism, search_request};
use crate::chains::roles::Subject;
use crate::chains::structure::PairStructure;
use crate::file::schema::MechanismFile;
use crate::file::write;
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::model::ranking::ClearanceSum;
use crate::rank::finite::Finite;
use crate::rank::method::auto::{Decision, decide_state};
use crate::redundancy::AnalysisError;
use crate::score::evaluation::elimination::Scratch;
use crate::score::evaluation::evaluate::Evaluator;
use crate::score::evaluation::terms::Scores;
use crate::score::outcome::Outcome;
use crate::score::outcome::variant::{in_words, list_changes};
use crate::score::run::run;
use crate::search::Search;
use crate::search::answer::ideas::Idea;
use crate::synthesis::figures::{LayoutFigures, layout_figures};
use crate::synthesis::layout::beside::nearby_layout;
use crate::synthesis::layout::{Layout, NoLayout, lay_out};
use crate::synthesis::mechanism::mechanism_file;
use crate::synthesis::structure::Structure;
use itertools::Itertools;
use num_bigint::BigUint;
use std::collections::{BTreeMap, BTreeSet};

/// A structure of a catalogue.
#[derive(Debug, Clone)]
pub struct StructureRow {
    /// The structure.
    pub structure: Structure,
    /// Number of jaws that are joined to the frame.
    pub jaws_at_frame: usize,
    /// Whether it makes a truss with a part hinged to both jaws. Only for two jaws, if all joints except for the input are hinges.
    pub truss: bool,
    /// Whether its graph is symmetric, jaw for jaw.
    pub graph_symmetric: bool,
    /// Its layout with figures and variants, or the reason why it has none.
    pub laid: Result<Laid, NoLayout>,
}

/// A structure laid out, searched and scored.
#[derive(Debug, Clone)]
pub struct Laid {
    /// Places of its joints.
    pub layout: Layout,
    /// Figures over its stroke.
    pub figures: LayoutFigures,
    /// The mechanism as a file in TOML.
    pub file: String,
    /// W and σ as built.
    pub as_built: (usize, usize),
    /// The full-cycle mobility, and how it is known.
    pub finite: Finite,
    /// Determinate variants by W and number of changes.
    pub counts: BTreeMap<(i64, u32), BigUint>,
    /// The number of them that are their own image under the symmetry of the layout.
    pub symmetric: Symmetric,
    /// Whether every count is exact. Otherwise the node budget ended the search, and they are lower bounds.
    pub exact: bool,
    /// The best ideas with W = 1: symmetric ones first, then the cheapest, which is always among them.
    pub ideas: Vec<IdeaRow>,
}

/// An idea of a catalogue.
#[derive(Debug, Clone)]
pub struct IdeaRow {
    /// Its first variant in words.
    pub changes: String,
    /// For each joint in file order, the option of its first variant, or 0 if it is unchanged.
    pub choices: Vec<usize>,
    /// Cost above the mechanism's, in thousandths.
    pub cost_milli: i64,
    /// Changed joints.
    pub change_count: u32,
    /// Number of variants that it represents.
    pub variants: BigUint,
    /// Scores of its first variant under the workload. `None` if the reactions have no solution.
    pub scores: Option<Scores>,
}

/// Returns the row of a structure, given the search of its chain and input by [`General::search_general`] if there is one.
///
/// # Errors
/// Returns an error if the program fails. A structure without a layout is a row, too.
///
/// # Complexity
/// A search for places, and a diagram of the variants for each place tried.
pub fn row_of_pair(
    structure: &Structure,
    spec: &Spec,
    general: Option<&General>,
) -> Result<StructureRow, RowError> {
    let laid = lay_regular(spec, |seed| {
        match lay_out(structure, &spec.layout_limits(), seed) {
            Ok(layout) => lay_structure(structure, layout, spec, general),
            Err(why) => Ok(Err(why)),
        }
    })?;
    let PairStructure { chain, roles } = structure.whole_structure();
    let subject = Subject::new(&chain, []);
    Ok(StructureRow {
        jaws_at_frame: subject.jaws_at_frame(&roles),
        truss: structure.form.hinges && subject.is_truss(&roles),
        graph_symmetric: structure.is_graph_symmetric(),
        structure: structure.clone(),
        laid,
    })
}

/// The maximum number of seeds that are tried until the pose of a layout is proven to be regular. Nearly always the first is enough.
const SEEDS: u64 = 6;

/// Returns the first layout of some seeds whose pose is proven to be regular, or the reason why there is none.
fn lay_regular(
    spec: &Spec,
    lay: impl Fn(u64) -> Result<Result<Laid, NoLayout>, RowError>,
) -> Result<Result<Laid, NoLayout>, RowError> {
    let seeds = (1..SEEDS).map(|n| spec.seed.wrapping_add(n << 32));
    let mut laid = lay(spec.seed)?;
    for seed in seeds {
        if !matches!(laid, Err(NoLayout::NotRegular)) {
            break;
        }
        laid = lay(seed)?;
    }
    Ok(laid)
}

/// A layout with its file, and the mechanism that the file describes.
struct AsFile {
    layout: Layout,
    file: MechanismFile,
    built: Mechanism,
}

impl AsFile {
    fn new(structure: &Structure, layout: Layout, spec: &Spec) -> Result<AsFile, RowError> {
        let file = mechanism_file(structure, &layout, &spec.option_menu()?, &spec.workload);
        Ok(AsFile {
            built: built_mechanism(&structure.name(), &file)?,
            layout,
            file,
        })
    }
}

/// The variants of a layout.
struct Variants {
    counts: BTreeMap<(i64, u32), BigUint>,
    symmetric: Symmetric,
    exact: bool,
    ideas: Vec<IdeaRow>,
}

/// Maximum number of nearby places that are tried to reach general position.
const BESIDE: u32 = 20;

/// Returns a layout in general position with its figures and variants: a nearby one, or the given one. `None` if none of these is general. On whole
/// millimetres two layouts of eight links in five are special, and nearly all of ten links; the first nearby one nearly always is general.
fn in_general_position(
    structure: &Structure,
    given: &Layout,
    spec: &Spec,
    general: &General,
) -> Result<Option<(AsFile, LayoutFigures, Variants)>, RowError> {
    let moved = (0..BESIDE).filter_map(|n| nearby_layout(structure, given, spec.seed, n));
    let own = std::iter::once_with(|| Some((given.clone(), layout_figures(structure, given)?)));
    for (layout, figures) in moved.chain(own.flatten()) {
        let as_file = AsFile::new(structure, layout, spec)?;
        if let Some(search) = general.certify_layout(as_file.built.clone(), spec)? {
            let variants = Variants {
                counts: general.counts.clone(),
                symmetric: general.symmetric.clone(),
                exact: general.symmetric.exact,
                ideas: idea_rows(
                    &search,
                    general.cached_ideas(&search, SEEN * spec.ideas),
                    spec.ideas,
                ),
            };
            return Ok(Some((as_file, figures, variants)));
        }
    }
    Ok(None)
}

/// Searches the variants of a layout in special places.
fn of_its_own(built: &Mechanism, spec: &Spec) -> Result<Variants, RowError> {
    let symmetric = Symmetric::search_symmetric(built, &search_request(spec))?;
    let outcome = run(built.clone(), &search_request(spec), &|| false, &mut |_| {})?;
    Ok(Variants {
        counts: outcome.determinate.by_mobility_and_changes.clone(),
        exact: outcome.is_exact() && symmetric.exact,
        ideas: ideas_of(&outcome, spec.ideas),
        symmetric,
    })
}

fn lay_structure(
    structure: &Structure,
    layout: Layout,
    spec: &Spec,
    general: Option<&General>,
) -> Result<Result<Laid, NoLayout>, RowError> {
    let moved = match general {
        Some(general) => in_general_position(structure, &layout, spec, general)?,
        None => None,
    };
    let (as_file, figures, variants) = match moved {
        Some((as_file, figures, variants)) => (as_file, figures, Some(variants)),
        None => match layout_figures(structure, &layout) {
            Some(figures) => (AsFile::new(structure, layout, spec)?, figures, None),
            None => return Ok(Err(NoLayout::NotRegular)),
        },
    };
    let built = &as_file.built;
    let Decision {
        verdict, finite, ..
    } = decide_state(built, StateId::FREE).map_err(AnalysisError::from)?;
    if !finite.is_proven() || finite.format_figure() != "1" {
        return Ok(Err(NoLayout::NotRegular));
    }
    let variants = variants.map_or_else(|| of_its_own(built, spec), Ok)?;
    let text = write::toml(&as_file.file).map_err(|e| RowError::File {
        structure: structure.name(),
        why: e.to_string(),
    })?;
    Ok(Ok(Laid {
        layout: as_file.layout,
        figures,
        file: text,
        as_built: verdict.figures_at(verdict.rank()),
        finite,
        counts: variants.counts,
        exact: variants.exact,
        symmetric: variants.symmetric,
        ideas: variants.ideas,
    }))
}

/// Returns the first ideas of an outcome.
pub(super) fn ideas_of(outcome: &Outcome, top: usize) -> Vec<IdeaRow> {
    let search = &outcome.search;
    let diagrams = outcome.diagrams.as_ref().filter(|_| top > 0);
    diagrams.map_or_else(Vec::new, |d| {
        idea_rows(search, search.list_ideas(d, SEEN * top), top)
    })
}

/// Number of ideas examined per idea kept: many differ only in directions, or are not symmetric.
const SEEN: usize = 5;

/// The joints that an idea changes, each with its new type, and the joint put in series with it.
type Types = Vec<(JointId, &'static str, Option<usize>)>;

/// Returns the changes of an idea, without the directions of joints.
fn changed_types(search: &Search, idea: &Idea) -> Types {
    let chosen = search.space.variables.iter().zip(&idea.first.choices);
    let types = chosen.filter(|(_, c)| **c != 0).flat_map(|(v, &c)| {
        let choice = &v.choices[c];
        v.joints.iter().map(|&j| {
            let option = &search.mechanism.joints[j].options[choice.option];
            (j, option.joint_type.name(), choice.unloading)
        })
    });
    types.sorted().collect()
}

/// Returns the first `top` ideas with different changes. An idea and its images by the symmetry of the layout count as one. Ideas that are
/// their own images come first, then the cheapest. The cheapest of all is always among them.
fn distinct_ideas(search: &Search, ideas: Vec<Idea>, top: usize) -> Vec<Idea> {
    let spec = &search.mechanism.search;
    let image = |of: &Types| -> Option<Types> {
        let all = of
            .iter()
            .map(|&(j, name, more)| (spec.image_of_joint(j), name, more));
        Some(all.sorted().collect())
    };
    let mut seen = BTreeSet::new();
    let different = ideas.into_iter().filter_map(|idea| {
        let images = std::iter::successors(Some(changed_types(search, &idea)), image)
            .take(spec.symmetry_order());
        let images: BTreeSet<Types> = images.collect();
        let symmetric = spec.symmetry_order() > 1 && images.len() == 1;
        let is_new = images
            .first()
            .is_some_and(|first| seen.insert(first.clone()));
        is_new.then_some((symmetric, idea))
    });
    let (mut first, others): (Vec<_>, Vec<_>) = different.enumerate().partition(|(_, (s, _))| *s);
    let room = top.saturating_sub(usize::from(others.first().is_some_and(|(n, _)| *n == 0)));
    first.truncate(room);
    let all = first.into_iter().chain(others).take(top);
    all.map(|(_, (_, idea))| idea).collect()
}

/// Returns the ideas of a search that are kept, each with the scores of its first variant.
fn idea_rows(search: &Search, ideas: Vec<Idea>, top: usize) -> Vec<IdeaRow> {
    if ideas.is_empty() {
        return Vec::new();
    }
    let evaluator = Evaluator::in_states(search, ClearanceSum::Worst, &[]).ok();
    let mut scratch = Scratch::default();
    let row = |idea: Idea| IdeaRow {
        changes: in_words(search, &list_changes(search, &idea.first)),
        cost_milli: search.steps.cost_in_milli(idea.first.key.cost()),
        change_count: idea.first.key.changes(),
        scores: evaluator
            .as_ref()
            .and_then(|e| e.score_variant(&idea.first, &mut scratch).ok()),
        variants: idea.variants,
        choices: idea.first.choices,
    };
    distinct_ideas(search, ideas, top)
        .into_iter()
        .map(row)
        .collect()
}

impl Laid {
    /// Returns the number of orbits of determinate variants with W = 1.
    #[must_use]
    pub fn orbit_count(&self) -> BigUint {
        let some = self.counts.iter().filter(|((w, _), _)| *w == 1);
        some.map(|(key, n)| self.symmetric.split_orbits(key, n).1)
            .sum()
    }

    /// Returns the number of determinate variants of mobility `w`, or of any mobility.
    #[must_use]
    pub fn variant_count(&self, w: Option<i64>) -> BigUint {
        let some = self
            .counts
            .iter()
            .filter(|((m, _), _)| w.is_none_or(|w| w == *m));
        some.map(|(_, n)| n).sum()
    }
}
