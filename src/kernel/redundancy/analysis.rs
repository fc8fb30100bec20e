//! The structure of a mechanism in each of its states.

use crate::closure::Closure;
use crate::geom::Reals;
use crate::geom::exact::ExactField;
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::rank::exact::certificate::{self, Budget};
pub use crate::rank::exact::field::exact_field;
use crate::rank::exact::field::field_of;
use crate::rank::exact::modular;
use crate::rank::finite::{Finite, finite_mobility, followed_mobility};
use crate::rank::method::auto::{Decision, decide_state};
use crate::rank::method::formulas::count_mobility;
use crate::rank::method::{Certainty, MobilityMethod, RankOfJ, to_i64};
pub use crate::rank::numeric::Elimination;
use crate::rank::numeric::NumericRank;
use crate::rank::reduce::sufficient_rows::LeastRows;
use crate::rank::rounded::verdict::Meant;
use crate::redundancy::AnalysisError;
use crate::redundancy::contour_shares::Measured;
pub use crate::redundancy::contour_shares::{ContourShare, CouplingShare};
use crate::redundancy::contour_shares::{contour_shares, coupling_shares};
pub use crate::redundancy::external::External;
use crate::redundancy::external::{external_constraints, external_measured};
use crate::redundancy::local_mobility::{Idle, idle_motions};
use crate::redundancy::motion::{DriveFault, drive_faults};
use crate::redundancy::motion::{motion_basis, output_links, span_of_links};
use crate::redundancy::stress::{SelfStress, self_stresses};

/// Method for the rank.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// The cheapest that is certain, see [`decide_state`].
    Auto,
    /// Modulo two primes, with every digit taken exactly as written.
    Modular,
    /// In floating point, with a relative tolerance.
    Numeric(Elimination, f64),
}

impl Method {
    /// Returns the rank method for a method from the list of all names. `tolerance` replaces the default in floating
    /// point. Returns `None` for a method that only gives a mobility.
    #[must_use]
    pub fn of_method(method: &MobilityMethod, tolerance: Option<f64>) -> Option<Method> {
        match method.rank {
            RankOfJ::Chosen => Some(Method::Auto),
            RankOfJ::Exact => Some(Method::Modular),
            RankOfJ::Numeric(by) => Some(Method::Numeric(
                by,
                tolerance.unwrap_or(by.default_tolerance()),
            )),
            RankOfJ::NotFound => None,
        }
    }
}

/// The structure of one state.
#[derive(Debug, Clone)]
pub struct StateAnalysis {
    /// Name of the state.
    pub state: String,
    /// n, the number of links with a joint in this state.
    pub links: usize,
    /// p, the number of joints.
    pub joints: usize,
    /// k, the number of contours.
    pub contours: usize,
    /// f, the number of freedoms.
    pub freedoms: usize,
    /// Number of rows of J, 6k or 3k and one for each coupling.
    pub rows: usize,
    /// Rank of J.
    pub rank: usize,
    /// W = f - rank, instantaneous.
    pub mobility: usize,
    /// The finite mobility and the evidence for it.
    pub finite: Finite,
    /// Dimension of the output links' joint motion.
    pub working_mobility: usize,
    /// Dimension of the motions that leave every output at rest.
    pub local_mobility: usize,
    /// Faults of the drives, if J has the exact rank.
    pub drives: Vec<DriveFault>,
    /// σ = 6k + c - rank for c couplings.
    pub redundant: usize,
    /// W by Malyshev's formula, 6(n-1) - Σ constraints (3(n-1) - Σ in a plane) less the couplings: right only if σ = 0.
    pub formula_mobility: i64,
    /// The rows of J that are enough for its rank, or `None` if singular values disagree with exact elimination.
    pub least_rows: Option<LeastRows>,
    /// Shares of the contours, in the order used.
    pub per_contour: Vec<ContourShare>,
    /// Shares of the couplings, which come after the contours.
    pub per_coupling: Vec<CouplingShare>,
    /// Constraints that the state adds to the free one.
    pub external: Option<External>,
    /// Links that move while every output is at rest.
    pub idle: Vec<Idle>,
    /// A basis of the self-stresses.
    pub self_stresses: Vec<SelfStress>,
    /// Joints with freedoms that planar mode omits.
    pub left_out: Vec<(JointId, usize)>,
    /// The name of the method used for the rank.
    pub method: &'static str,
    /// Certainty of the rank.
    pub certainty: Certainty,
    /// The automatic choice, the reason, and what was omitted.
    pub choice: Option<String>,
    /// Descriptions of snapped relations in measured geometry, one sentence each.
    pub snapped: Vec<String>,
    /// The rank with every digit taken exactly as written, if it differs.
    pub as_written: Option<usize>,
    /// The mechanism that the figures describe, if it was snapped.
    pub meant: Option<Box<Mechanism>>,
}

impl StateAnalysis {
    /// Returns the upper bounds of W and σ if rounded coordinates leave them undecided. The figures are then the lower
    /// bounds.
    #[must_use]
    pub fn at_most(&self) -> Option<(usize, usize)> {
        match self.certainty {
            Certainty::Undecided { near, .. } => Some((self.freedoms - near, self.rows - near)),
            _ => None,
        }
    }
}

/// Analyses the given states.
///
/// # Errors
/// Returns an error if the geometry has no exact image, the singular values fail, two primes disagree, or a certificate
/// proves another rank.
pub fn analyse_states(
    mechanism: &Mechanism,
    states: &[StateId],
    method: Method,
) -> Result<Vec<StateAnalysis>, AnalysisError> {
    states
        .iter()
        .map(|&s| match method {
            Method::Auto => analyse_by_choice(mechanism, s),
            Method::Modular => analyse_exactly(mechanism, s, None),
            Method::Numeric(elimination, tolerance) => {
                let real = Closure::new(&Reals, mechanism, s)?;
                let rank = elimination.rank_of_closure(&real, tolerance)?;
                analyse_numerically(mechanism, s, elimination, rank, tolerance, None)
            }
        })
        .collect()
}

/// Analyses a state by the automatic choice.
fn analyse_by_choice(
    mechanism: &Mechanism,
    state: StateId,
) -> Result<StateAnalysis, AnalysisError> {
    let Decision {
        verdict,
        finite,
        line,
    } = decide_state(mechanism, state)?;
    let as_written = (verdict.as_written != verdict.rank()).then_some(verdict.as_written);
    let intended = verdict.intended_mechanism().unwrap_or(mechanism);
    let numeric = verdict.numeric.unwrap_or_default();
    let mut whole = if let Meant::Near { rank, .. } = verdict.meant {
        let found = NumericRank { rank, ..numeric };
        let by = Elimination::Svd;
        StateAnalysis {
            certainty: by.certainty_of(found, verdict.tolerance),
            // The geometry found has the accuracy of doubles.
            ..analyse_numerically(intended, state, by, found, NEAR, Some(finite))?
        }
    } else {
        analyse_exactly(intended, state, Some(finite))?
    };
    match verdict.meant {
        Meant::Snapped {
            mechanism,
            understood,
            ..
        } => (whole.meant, whole.snapped) = (Some(mechanism), vec![understood]),
        Meant::Undecided { near } => {
            whole.certainty = Certainty::Undecided {
                as_written: verdict.as_written,
                near,
                kept: numeric.kept,
                dropped: numeric.dropped,
            }
        }
        Meant::AsWritten | Meant::Near { .. } => {}
    }
    Ok(StateAnalysis {
        choice: Some(line),
        as_written,
        ..whole
    })
}

/// Analyses a state by a floating-point rank. If it differs from the exact one, everything else comes from singular
/// values.
fn analyse_numerically(
    mechanism: &Mechanism,
    state: StateId,
    by: Elimination,
    rank: NumericRank,
    tolerance: f64,
    known: Option<Finite>,
) -> Result<StateAnalysis, AnalysisError> {
    let whole = StateAnalysis {
        method: by.name(),
        certainty: by.certainty_of(rank, tolerance),
        ..analyse_exactly(mechanism, state, known)?
    };
    let rank = rank.rank;
    let finite = match known {
        Some(known) => known,
        None if rank == whole.rank => whole.finite.by_numeric_rank(),
        None => {
            followed_mobility(mechanism, state, whole.freedoms - rank, tolerance)?.by_numeric_rank()
        }
    };
    let whole = StateAnalysis { finite, ..whole };
    if rank == whole.rank {
        return Ok(whole);
    }
    let measured = Measured::new(mechanism, state, tolerance)?;
    let working_mobility = measured.span_of_links(&output_links(mechanism));
    let external = match whole.external {
        Some(_) => external_measured(mechanism, &measured, tolerance)?,
        None => None,
    };
    Ok(StateAnalysis {
        rank,
        mobility: whole.freedoms - rank,
        redundant: whole.rows - rank,
        working_mobility,
        local_mobility: measured.mobility().saturating_sub(working_mobility),
        least_rows: None,
        per_contour: measured.contour_shares(),
        per_coupling: measured.coupling_shares(),
        external,
        idle: Vec::new(),
        drives: Vec::new(),
        self_stresses: Vec::new(),
        ..whole
    })
}

/// Share of the largest singular value below which values are zero, for a geometry that was moved until it has a rank.
const NEAR: f64 = 1e-9;

/// Maximum number of elementary operations for a certificate within an analysis: a few tenths of a second.
const CERTIFICATE: Budget = Budget {
    coordinates: 100_000,
    primes: 60,
    operations: 50_000_000,
};

/// Returns true if the rank has a certificate in characteristic 0, made and checked here.
///
/// # Errors
/// Returns [`AnalysisError::Refuted`] if the certificate proves another rank.
fn has_certificate(
    mechanism: &Mechanism,
    state: StateId,
    rank: usize,
) -> Result<bool, AnalysisError> {
    match certificate::certify_within(mechanism, state, CERTIFICATE) {
        Err(_) => Ok(false),
        Ok(c) if c.rank == rank => Ok(true),
        Ok(c) => Err(AnalysisError::Refuted {
            state: c.state,
            rank,
            proven: c.rank,
        }),
    }
}

/// Returns the certainty of a rank by the first of two fields, after checking it with the second.
fn rank_certainty(
    mechanism: &Mechanism,
    state: StateId,
    fields: &[ExactField; 2],
    rank: usize,
) -> Result<Certainty, AnalysisError> {
    // The first rank used the rows that are enough, this one uses all.
    let [_, other] = fields;
    let ranks = [
        rank,
        modular::rank_modulo(other, &Closure::new(other, mechanism, state)?),
    ];
    let primes = fields.each_ref().map(|f| f.field().modulus());
    if ranks[0] != ranks[1] {
        let state = mechanism.states[state].clone();
        return Err(AnalysisError::Disagree {
            state,
            first: primes[0],
            second: primes[1],
            ranks,
        });
    }
    // A certificate would apply to the digits used for π.
    Ok(
        if !mechanism.has_pi() && has_certificate(mechanism, state, rank)? {
            Certainty::Proven { primes }
        } else {
            Certainty::Modular { primes }
        },
    )
}

/// Analyses a state with exact geometry. `known` is the finite mobility if it was already found, because following a
/// motion takes the most time.
fn analyse_exactly(
    mechanism: &Mechanism,
    state: StateId,
    known: Option<Finite>,
) -> Result<StateAnalysis, AnalysisError> {
    let fields = [
        field_of(mechanism, state, 0)?,
        field_of(mechanism, state, 1)?,
    ];
    let exact = &fields[0];
    let closure = Closure::new(exact, mechanism, state)?;
    let least_rows = LeastRows::new(exact, mechanism, &closure)?;
    let rank = least_rows.rank();
    let certainty = rank_certainty(mechanism, state, &fields, rank)?;
    let kernel = motion_basis(exact, &closure);
    let outputs = output_links(mechanism);
    let working_mobility = span_of_links(exact, mechanism, &closure, &kernel, &outputs);
    let finite = match known {
        Some(known) => known,
        None => finite_mobility(exact, mechanism, &closure, rank)?,
    };
    let drives = drive_faults(
        exact,
        mechanism,
        &closure,
        &kernel,
        working_mobility,
        &finite,
    );
    let mut idle = idle_motions(exact, mechanism, &closure, &kernel, &outputs);
    // A motion of a drive at a dead point moves the outputs in other poses.
    if drives.contains(&DriveFault::DeadPoint) {
        let driven = || mechanism.joints.iter().filter(|j| j.drive);
        idle.retain(|i| !driven().any(|j| j.links.iter().any(|l| i.links.contains(l))));
    }
    let freedoms = closure.columns.len();
    Ok(StateAnalysis {
        state: mechanism.states[state].clone(),
        links: mechanism.links_in(state).count(),
        joints: mechanism.joints_in(state).count(),
        contours: closure.contours.len(),
        freedoms,
        rows: closure.rows(),
        rank,
        mobility: freedoms - rank,
        finite,
        drives,
        working_mobility,
        local_mobility: kernel.len() - working_mobility,
        redundant: closure.rows() - rank,
        formula_mobility: count_mobility(mechanism, state, to_i64(closure.dim), freedoms),
        least_rows: Some(least_rows),
        per_contour: contour_shares(exact, &closure),
        per_coupling: coupling_shares(exact, mechanism, &closure),
        external: (state != StateId::FREE)
            .then(|| external_constraints(exact, mechanism, &closure, &kernel))
            .transpose()?,
        idle,
        self_stresses: self_stresses(exact, mechanism, &closure)?,
        left_out: closure.left_out.clone(),
        method: modular::MODULAR.name,
        certainty,
        choice: None,
        snapped: Vec::new(),
        as_written: None,
        meant: None,
    })
}
