//! A second opinion on single variants: each is built as a mechanism and analysed by singular values.
//!
//! Nothing of the diagram takes part: not its prime, not its order, not its merging of nodes, not its contours' steps.
//! Only the options' frames and the contour basis are shared.

use crate::closure::{Closure, CouplingRow};
use crate::geom::Reals;
use crate::geom::exact::ExactError;
use crate::model::joint_type::CoupledFreedom;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::exact::modular;
use crate::rank::method::to_i64;
use crate::rank::numeric::{Elimination, NumericRank};
use crate::search::answer::k_best::Assignment;
use crate::search::check::other_poses::over_stroke;
use crate::search::check::other_poses::{OverStroke, Stroke};
use crate::search::check::variant_mechanism::lock_links;
use crate::search::check::variant_mechanism::realize_variant;
use crate::search::diagram::ShouldCancel;
use crate::search::diagram::redundancy_so_far::Redundancy;
use crate::search::question::Question;
use crate::search::question::kept::driven_in_variant;
use rayon::prelude::*;
use serde::Serialize;

/// Variants that get a second opinion by default.
pub const CHECKED: usize = 1000;
/// Maximum number of products for all second opinions of a list; a decomposition of m x n counts as m n min(m, n).
const WORK: usize = 70_000_000;
/// Variants that get one however large they are.
const AT_LEAST: usize = 20;

/// Returns the number of listed variants that get a second opinion: [`CHECKED`], and fewer for large mechanisms.
#[must_use]
pub fn affordable_count(question: &Question) -> usize {
    let closure = Closure::new(&Reals, &question.mechanism, StateId::FREE);
    let work = closure.map_or(1, |c| {
        let (rows, columns) = (c.rows(), c.columns.len());
        rows * columns * rows.min(columns)
    });
    (WORK / work.max(1)).clamp(AT_LEAST, CHECKED)
}
/// Variants whose conditioning is below this are nearly singular: small errors of manufacture may let them bind, or
/// let them loose.
pub const NEARLY_SINGULAR: f64 = 1e-4;

/// The figures of a variant by singular values.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Opinion {
    /// W in the free state.
    pub mobility: i64,
    /// σ in the free state.
    pub redundant: i64,
    /// σ that the searched state adds.
    #[serde(rename = "external_redundant")]
    pub external: Option<i64>,
    /// Dimension of the kept links' motion, where that is a condition.
    #[serde(rename = "output_mobility")]
    pub output: Option<usize>,
    /// The smallest kept singular value relative to the largest, in the worse of the states: how far the variant is
    /// from a singular one.
    #[serde(rename = "smallest_kept")]
    pub conditioning: f64,
    /// The largest dropped singular value relative to the largest; far below `conditioning` where the rank is certain.
    #[serde(rename = "largest_dropped")]
    pub dropped: f64,
    /// Whether all figures are those of the diagram.
    #[serde(skip)]
    pub agree: bool,
}

/// A variant with what is known of it beyond the diagram.
#[derive(Debug, Clone, PartialEq)]
pub struct Certified {
    /// The variant.
    pub variant: Assignment,
    /// What its singular values say.
    pub second: Second,
    /// What other poses say, where that was asked.
    pub stroke: Option<OverStroke>,
}

impl Certified {
    /// Creates the entry of a variant without a second opinion.
    #[must_use]
    pub fn without_opinion(variant: Assignment) -> Self {
        Certified {
            variant,
            second: Second::Unasked,
            stroke: None,
        }
    }

    /// Returns true if other poses were examined and have other figures.
    #[must_use]
    pub fn is_lucky(&self) -> bool {
        self.stroke.is_some_and(|s| s.is_lucky() == Some(true))
    }
}

/// A second opinion, or why there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Second {
    /// None was asked for.
    Unasked,
    /// The singular values did not converge.
    Failed,
    /// The opinion.
    Given(Opinion),
}

impl Second {
    /// Returns the opinion, if there is one.
    #[must_use]
    pub fn opinion(&self) -> Option<&Opinion> {
        match self {
            Second::Given(o) => Some(o),
            Second::Unasked | Second::Failed => None,
        }
    }
}

/// How many opinions of a list say what.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Summary {
    /// Variants given.
    pub given: usize,
    /// Those with an opinion.
    pub checked: usize,
    /// Number of variants for which singular values disagree with the diagram.
    pub disagreeing: usize,
    /// Those whose singular values did not converge.
    pub failed: usize,
    /// Variants that were also examined in other poses.
    pub posed: usize,
    /// Those whose figures differ in another pose.
    pub lucky: usize,
    /// How many of them, the first, are proven to be the cheapest; `None` where all are, or the list is not by cost.
    pub proven: Option<usize>,
}

impl Summary {
    /// Returns true if second opinions were asked for.
    #[must_use]
    pub fn is_asked(&self) -> bool {
        self.checked + self.failed > 0
    }

    /// Adds one certified variant to the counts.
    pub fn add_certified(&mut self, one: &Certified) {
        self.given += 1;
        self.posed += usize::from(one.stroke.is_some_and(|s| s.poses > 0));
        self.lucky += usize::from(one.is_lucky());
        match &one.second {
            Second::Unasked => {}
            Second::Failed => self.failed += 1,
            Second::Given(o) => {
                self.checked += 1;
                self.disagreeing += usize::from(!o.agree);
            }
        }
    }
}

/// Analyses variants by singular values, and in the poses of a stroke if one is given, in parallel. If cancelled, returns only the first of
/// them.
///
/// # Complexity
/// Two or three decompositions of a 6k x f matrix a variant, and about two more for each pose.
#[must_use]
pub fn certify_variants(
    question: &Question,
    variants: Vec<Assignment>,
    opinions: bool,
    stroke: Option<&Stroke>,
    cancelled: ShouldCancel<'_>,
) -> Vec<Certified> {
    let one = |variant: Assignment| {
        let m = realize_variant(question, &variant.choices);
        let second = if opinions {
            form_opinion(question, &variant, &m).map_or(Second::Failed, Second::Given)
        } else {
            Second::Unasked
        };
        let stroke = stroke.map(|s| over_stroke(question, s, &variant, &m));
        Certified {
            variant,
            second,
            stroke,
        }
    };
    let unless = |v| (!cancelled()).then(|| one(v));
    let all = variants.into_par_iter().with_min_len(4).map(unless);
    let all: Vec<Option<Certified>> = all.collect();
    all.into_iter().map_while(|c| c).collect()
}

/// Returns a warning if singular values contradict exact arithmetic on the mechanism as built. `None` if they agree, do not
/// converge, or would take too long.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
///
/// # Complexity
/// One exact rank of each state. As many decompositions as for a variant.
pub fn warning_of_present(question: &Question) -> Result<Option<String>, ExactError> {
    if affordable_count(question) <= AT_LEAST {
        return Ok(None);
    }
    let redundant = |state: StateId| {
        let closure = Closure::new(&question.exact, &question.mechanism, state)?;
        let rank = modular::rank_modulo(&question.exact, &closure);
        Ok::<_, ExactError>(to_i64(closure.rows()) - to_i64(rank))
    };
    let internal = redundant(StateId::FREE)?;
    let external = match question.conditions.state {
        Some(s) => redundant(s.state)? - internal,
        None => 0,
    };
    let redundancy = Redundancy {
        internal: u32::try_from(internal).unwrap_or(u32::MAX),
        external: i32::try_from(external).unwrap_or(i32::MAX),
        harmful: 0,
    };
    let choices = vec![0; question.space.variables.len()];
    let key = question.steps.variant_key(&choices, redundancy);
    let present = Assignment { choices, key };
    let m = realize_variant(question, &present.choices);
    let said = form_opinion(question, &present, &m).filter(|o| !o.agree);
    Ok(said.map(|o| {
        format!(
            "warning: of the mechanism as built singular values say W = {}, σ = {}, and exact arithmetic W = {}, σ = {internal} \
             (smallest kept {:.1e}, largest dropped {:.1e}): it is nearly singular",
            o.mobility,
            o.redundant,
            question.mobility(key),
            o.conditioning,
            o.dropped
        )
    }))
}

fn form_opinion(question: &Question, variant: &Assignment, m: &Mechanism) -> Option<Opinion> {
    let closure = Closure::new(&Reals, m, StateId::FREE).ok()?;
    let free = numeric_rank(question, &closure)?;
    let (f, redundant) = (closure.columns.len(), surplus(&closure, &free));
    let output = if question.conditions.keep_output {
        let drives = driven_in_variant(&question.mechanism, m)?;
        let locked = Closure::new(&Reals, &lock_links(question, m), StateId::FREE).ok()?;
        let rank = numeric_rank(question, &with_locks(locked, &drives)?)?.rank;
        Some(rank.saturating_sub(free.rank))
    } else {
        None
    };
    let (mut conditioning, mut dropped) = (free.kept, free.dropped);
    let external = match question.conditions.state {
        None => None,
        Some(s) => {
            let closure = Closure::new(&Reals, m, s.state).ok()?;
            let state = numeric_rank(question, &closure)?;
            conditioning = conditioning.min(state.kept);
            dropped = dropped.max(state.dropped);
            Some(surplus(&closure, &state) - redundant)
        }
    };
    let key = variant.key;
    let mobility = to_i64(f) - to_i64(free.rank);
    let agree = mobility == question.mobility(key)
        && redundant == i64::from(key.internal())
        && external.is_none_or(|e| e == i64::from(key.external()))
        && output
            .is_none_or(|o| o == question.present_motion() + question.mechanism.locked_drives());
    Some(Opinion {
        mobility,
        redundant,
        external,
        output,
        conditioning,
        dropped,
        agree,
    })
}

/// Returns the number of redundant constraints.
fn surplus(closure: &Closure<f64>, rank: &NumericRank) -> i64 {
    to_i64(closure.rows()) - to_i64(rank.rank)
}

fn numeric_rank(question: &Question, closure: &Closure<f64>) -> Option<NumericRank> {
    let by = Elimination::Svd;
    by.rank_of_closure(closure, question.conditions.tolerance)
        .ok()
}

/// Returns a closure with a row more for each drive, which keeps its freedom at rest.
fn with_locks(mut closure: Closure<f64>, drives: &[CoupledFreedom]) -> Option<Closure<f64>> {
    for drive in drives {
        let mut columns = closure.columns.iter();
        let at = columns.position(|c| (c.joint, c.freedom) == (drive.joint, drive.freedom))?;
        // Of two entries at one column the second one stays.
        let entries = [(at, 0.0), (at, 1.0)];
        closure.couplings.push(CouplingRow { entries });
    }
    Some(closure)
}
