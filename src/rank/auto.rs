//! The automatic choice: the cheapest method that is certain for this mechanism, and one line that says what was chosen,
//! why, and what was left out.

use super::field::field_of;
use super::finite::{Finite, How, finite, finite_within, followed};
use super::measured::Verdicts;
use super::method::{About, Answer, Certainty, MobilityMethod, NoAnswer, Quantity, RankOfJ};
use super::modular;
use super::numeric::{Elimination, NumericRank};
use super::scaled::{rank_of_values, scaled};
use super::snap::snap;
use super::subgroup::whole_group;
use crate::closure::matrix::Closure;
use crate::geom::scalars::Reals;
use crate::model::measured::{Measured, looks_measured};
use crate::model::mechanism::{Mechanism, StateId};
use ozols_dense::Format;

/// What the geometry is, and which mechanism the verdict is about.
#[derive(Debug, Clone)]
pub enum Geometry {
    /// Exact as the file has it.
    Exact,
    /// Measured; ranks as written and numeric agree.
    MeasuredAgreeing(Measured),
    /// Measured; exact once near-coincidences are snapped, and then in agreement with the numeric rank.
    Snapped {
        /// Why it looks measured.
        measured: Measured,
        /// The snapped mechanism.
        mechanism: Box<Mechanism>,
        /// What was moved.
        moved: Vec<String>,
    },
    /// Measured; only the numeric rank sees what the digits mean.
    Measured(Measured),
}

/// A decision for one state.
#[derive(Debug, Clone)]
pub struct Decision {
    /// What the geometry is.
    pub geometry: Geometry,
    /// Rank of J by the verdict.
    pub rank: usize,
    /// Rank of J with every digit taken at its word.
    pub as_written: usize,
    /// Singular values of the file's J, where they were asked.
    pub numeric: Option<NumericRank>,
    /// The tolerance they were read at.
    pub tolerance: f64,
    /// The mobility that is really there.
    pub finite: Finite,
    /// What was chosen, why, and what was left out.
    pub line: String,
}

/// Decides for a state; `tolerance` overrides the one that follows from the digits.
///
/// # Errors
/// Where the geometry has no image in a prime field, or the singular values do not converge.
///
/// # Complexity
/// One modular rank for exact geometry; for measured geometry singular values, a second elimination and the snapping.
pub fn decide(
    mechanism: &Mechanism,
    state: StateId,
    tolerance: Option<f64>,
) -> Result<Decision, NoAnswer> {
    let exact = field_of(mechanism, state, 0)?;
    let closure = Closure::new(&exact, mechanism, state)?;
    let group = whole_group(&exact, mechanism, state)?;
    let (as_written, needed) = if closure.contours.is_empty() || closure.dim == group.dimension() {
        (modular::rank(&exact, &closure), String::new())
    } else {
        let left_out = closure.dim - group.dimension();
        let line = format!(
            "; all joints move in {}, so {} rows per contour do; left out: {left_out} of {}, redundant whatever the rest",
            group.name(),
            group.dimension(),
            closure.dim
        );
        (modular::rank(&exact, &group.rows_of(&closure)), line)
    };
    let Some(measured) = looks_measured(mechanism) else {
        return Ok(Decision {
            geometry: Geometry::Exact,
            rank: as_written,
            as_written,
            numeric: None,
            tolerance: 0.0,
            finite: finite(&exact, mechanism, &closure, as_written)?,
            line: format!("exact geometry, so ranks over prime fields{needed}"),
        });
    };
    let tolerance = tolerance.unwrap_or_else(|| measured.tolerance());
    let real = Closure::new(&Reals, mechanism, state)?;
    let verdicts = Verdicts::beside(as_written, &mechanism.states[state], &real, tolerance)
        .map_err(|e| NoAnswer::Failed(e.to_string()))?;
    let numeric = verdicts.numeric;
    // What rounding and noise leave of a zero says how well poses can close.
    let accuracy = (10.0 * numeric.dropped).clamp(1e-16, tolerance);
    let second = rank_of_values(Format::Double.qr_diagonal(&scaled(&real)), tolerance);
    let doubt = if second.rank == numeric.rank {
        String::new()
    } else {
        format!(
            "; column-pivoted QR says rank {} instead, so treat this as open",
            second.rank
        )
    };
    let gap = format!(
        "singular values at tolerance {tolerance:.0e} (smallest kept {:.1e}, largest dropped {:.1e})",
        numeric.kept, numeric.dropped
    );
    let why = format!("coordinates look measured ({measured})");
    let base = |geometry, rank, finite, line| Decision {
        geometry,
        rank,
        as_written,
        numeric: Some(numeric),
        tolerance,
        finite,
        line,
    };
    if verdicts.agree() {
        let found = finite_within(&exact, mechanism, &closure, as_written, Some(accuracy))?;
        let line = format!("{why}; exact rank as written and {gap} agree{doubt}{needed}");
        return Ok(base(
            Geometry::MeasuredAgreeing(measured),
            as_written,
            found,
            line,
        ));
    }
    let snapped = snap(mechanism, tolerance);
    let snapped_exact = field_of(&snapped.mechanism, state, 0)?;
    let snapped_closure = Closure::new(&snapped_exact, &snapped.mechanism, state)?;
    let snapped_rank = modular::rank(&snapped_exact, &snapped_closure);
    let both = format!(
        "as written, every digit at its word, the rank would be {as_written} (mobility {}) instead of {} (mobility {})",
        verdicts.figures(as_written).0,
        numeric.rank,
        verdicts.figures(numeric.rank).0
    );
    if snapped_rank == numeric.rank {
        let found = finite_within(
            &snapped_exact,
            &snapped.mechanism,
            &snapped_closure,
            snapped_rank,
            Some(accuracy),
        )?;
        let line = format!(
            "{why}; snapped within {tolerance:.0e} ({} changes), exact rank then; {gap} agree{doubt}; {both}",
            snapped.moved.len()
        );
        return Ok(base(
            Geometry::Snapped {
                measured,
                mechanism: Box::new(snapped.mechanism),
                moved: snapped.moved,
            },
            snapped_rank,
            found,
            line,
        ));
    }
    let found = followed(mechanism, state, verdicts.figures(numeric.rank).0, accuracy)?;
    let line = format!("{why}; {gap}{doubt}; {both}");
    Ok(base(
        Geometry::Measured(measured),
        numeric.rank,
        found,
        line,
    ))
}

/// The automatic choice as a method; finite mobility.
#[derive(Debug, Clone, Copy)]
pub struct Auto;

impl MobilityMethod for Auto {
    fn about(&self) -> &'static About {
        &About {
            name: "auto",
            title: "automatic choice",
            help: "The cheapest that is certain: exact where the geometry is, singular values where it was measured",
            guarantee: "as the method it chooses, which it names; finite mobility",
            complexity: "one modular rank, and singular values only where coordinates are measured",
            source: "this program",
            rank: RankOfJ::Chosen,
        }
    }
    fn answer(&self, mechanism: &Mechanism, state: StateId) -> Result<Answer, NoAnswer> {
        let decision = decide(mechanism, state, None)?;
        if let How::Undecided { .. } = decision.finite.how {
            return Err(NoAnswer::Failed(decision.finite.describe()));
        }
        let numeric = decision
            .numeric
            .filter(|_| matches!(decision.geometry, Geometry::Measured(_)));
        Ok(Answer {
            mobility: i64::try_from(decision.finite.mobility).unwrap_or(i64::MAX),
            quantity: Quantity::Finite,
            certainty: match numeric {
                Some(n) => Elimination::Svd.certainty(n, decision.tolerance),
                None if decision.finite.is_proven() => Certainty::Exact,
                None => Certainty::Traced,
            },
        })
    }
}
