//! The structure of a mechanism in each of its states.

use crate::closure::coupling::{coefficient, length_ratio};
use crate::closure::matrix::Closure;
use crate::geom::exact::{ExactError, ExactField};
use crate::geom::expr::Expr;
use crate::geom::scalars::Reals;
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, JointOption, LinkId, Mechanism, Role, StateId};
use crate::rank::auto::{self, Geometry};
use crate::rank::certificate::{self, Budget};
use crate::rank::finite::{Finite, finite, followed};
use crate::rank::lu::Lu;
use crate::rank::method::NoAnswer;
use crate::rank::numeric::{self, NumericError, NumericRank};
use crate::rank::qr::Qr;
use crate::rank::{self, Certainty, modular};
use crate::redundancy::idle::{Idle, idle_motions};
use crate::redundancy::measured::Measured;
use crate::redundancy::motion::{Speeds, motions, twist};
pub use crate::redundancy::share::{ContourShare, CouplingShare};
use crate::redundancy::share::{coupling_shares, shares};
use crate::redundancy::stress::{SelfStress, self_stresses};
use thiserror::Error;

/// A floating-point elimination.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Elimination {
    /// Singular values, f64.
    Svd,
    /// Column-pivoted QR, f64.
    Qr,
    /// Column-pivoted QR, f32.
    Qr32,
    /// LU with full pivoting, f64.
    Lu,
    /// LU with full pivoting, f32.
    Lu32,
}

impl Elimination {
    fn name(self) -> &'static str {
        match self {
            Elimination::Svd => "svd",
            Elimination::Qr => "qr",
            Elimination::Qr32 => "qr32",
            Elimination::Lu => "lu",
            Elimination::Lu32 => "lu32",
        }
    }

    fn rank(self, closure: &Closure<f64>, tolerance: f64) -> Result<NumericRank, NumericError> {
        Ok(match self {
            Elimination::Svd => numeric::rank_with_tolerance(closure, tolerance)?,
            Elimination::Qr => Qr::<f64>::with_tolerance(tolerance).rank(closure),
            Elimination::Qr32 => Qr::<f32>::with_tolerance(tolerance).rank(closure),
            Elimination::Lu => Lu::<f64>::with_tolerance(tolerance).rank(closure),
            Elimination::Lu32 => Lu::<f32>::with_tolerance(tolerance).rank(closure),
        })
    }
}

/// How the rank is found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// The cheapest that is certain, see [`auto`]; a tolerance for measured geometry other than the digits ask for.
    Auto {
        /// Relative tolerance.
        tolerance: Option<f64>,
    },
    /// Modulo two primes, every digit taken at its word.
    Modular,
    /// In floating point, with a relative tolerance.
    Numeric(Elimination, f64),
}

/// Why an analysis failed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum AnalysisError {
    /// The geometry has no image in a prime field.
    #[error(transparent)]
    Exact(#[from] ExactError),
    /// No singular values.
    #[error(transparent)]
    Numeric(#[from] NumericError),
    /// The automatic choice failed.
    #[error(transparent)]
    Auto(#[from] NoAnswer),
    /// Two primes gave different ranks.
    #[error(
        "ranks modulo {first} and {second} differ in state {state}: {ranks:?}; report this with the file"
    )]
    Disagree {
        /// The state.
        state: String,
        /// One prime.
        first: u64,
        /// The other.
        second: u64,
        /// Their ranks.
        ranks: [usize; 2],
    },
}

/// The external constraints of a state, counted and by rank.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct External {
    /// Σα: constraints of the joints that the state adds, and their couplings.
    pub constraints: i64,
    /// W_a: mobility with the object absent.
    pub actual_mobility: i64,
    /// W_r: mobility of the mechanism's own joints with the object present.
    pub working_mobility: i64,
    /// w_a: mobilities the added bodies lost.
    pub lost_mobility: i64,
    /// σ_a by the external formula, Σα - (W_a - W_r) - w_a.
    pub redundant: i64,
    /// σ of the state less σ of the free state, by ranks.
    pub by_rank: i64,
}

/// The structure of one state.
#[derive(Debug, Clone)]
pub struct StateAnalysis {
    /// Name of the state.
    pub state: String,
    /// n, links with a joint in this state.
    pub links: usize,
    /// p.
    pub joints: usize,
    /// k.
    pub contours: usize,
    /// f.
    pub freedoms: usize,
    /// Rows of J, 6k or 3k and one for each coupling.
    pub rows: usize,
    /// Rank of J.
    pub rank: usize,
    /// W = f - rank, instantaneous.
    pub mobility: usize,
    /// The mobility that is really there, and how that is known.
    pub finite: Finite,
    /// Dimension of the output links' joint motion.
    pub working_mobility: usize,
    /// Dimension of the motions that leave every output at rest.
    pub local_mobility: usize,
    /// σ = 6k + c - rank for c couplings.
    pub redundant: usize,
    /// W by Malyshev's formula, 6(n-1) - Σ constraints (3(n-1) - Σ in a plane) less the couplings: right only where σ = 0.
    pub formula_mobility: i64,
    /// Shares of the contours, in the order used.
    pub per_contour: Vec<ContourShare>,
    /// Shares of the couplings, which come after the contours.
    pub per_coupling: Vec<CouplingShare>,
    /// What the state adds to the free one.
    pub external: Option<External>,
    /// Links that move while every output rests.
    pub idle: Vec<Idle>,
    /// A basis of the self-stresses.
    pub self_stresses: Vec<SelfStress>,
    /// Joints with freedoms that planar mode leaves out.
    pub left_out: Vec<(JointId, usize)>,
    /// How sure the rank is.
    pub certainty: Certainty,
    /// What the automatic choice was, why, and what was left out.
    pub choice: Option<String>,
    /// What was snapped in measured geometry, a sentence each.
    pub snapped: Vec<String>,
    /// The rank with every digit taken at its word, where that differs.
    pub as_written: Option<usize>,
}

/// The exact field of a mechanism: all its coordinates, in the `nth` suitable prime.
///
/// # Errors
/// Where no prime suits, see [`ExactField`].
pub fn exact_field(mechanism: &Mechanism, nth: usize) -> Result<ExactField, ExactError> {
    let frames = mechanism.joints.iter().flat_map(|j| {
        std::iter::once(&j.frame)
            .chain(j.options.iter().map(|o| &o.frame))
            .chain(j.unloading.iter().map(|o| &o.frame))
    });
    let couplings = coupling_expressions(mechanism);
    let of_frames = frames.flat_map(rank::coordinates);
    let others = rank::normal(mechanism).iter().chain(&couplings);
    ExactField::for_expressions(of_frames.chain(others), nth)
}

/// What the rows of couplings need values of: their entries, for the present joints and for every option of them.
fn coupling_expressions(mechanism: &Mechanism) -> Vec<Expr> {
    let mut out = Vec::new();
    for coupling in &mechanism.couplings {
        out.push(coefficient(mechanism, coupling));
        for end in coupling.ends {
            let joint = &mechanism.joints[end.joint];
            let present = (&joint.frame, end.freedom);
            let length = |o: &JointOption| length_ratio((&o.frame, end.freedom), present);
            out.extend(joint.options.iter().map(length));
        }
    }
    out
}

/// Analyses the given states.
///
/// # Errors
/// Where the geometry has no exact image, the singular values fail, or two primes disagree.
pub fn analyse(
    mechanism: &Mechanism,
    states: &[StateId],
    method: Method,
) -> Result<Vec<StateAnalysis>, AnalysisError> {
    states
        .iter()
        .map(|&s| match method {
            Method::Auto { tolerance } => chosen(mechanism, s, tolerance),
            Method::Modular => exactly(mechanism, s, None),
            Method::Numeric(elimination, tolerance) => {
                let real = Closure::new(&Reals, mechanism, s)?;
                let rank = elimination.rank(&real, tolerance)?;
                let whole = exactly(mechanism, s, None)?;
                let certainty = numeric_certainty(elimination.name(), rank, tolerance);
                if rank.rank == whole.rank {
                    let finite = whole.finite.by_numeric_rank();
                    Ok(StateAnalysis {
                        certainty,
                        finite,
                        ..whole
                    })
                } else {
                    let finite = followed(mechanism, s, whole.freedoms - rank.rank, tolerance)?;
                    let found = numerically(mechanism, s, whole, rank.rank, certainty, tolerance)?;
                    Ok(StateAnalysis {
                        finite: finite.by_numeric_rank(),
                        ..found
                    })
                }
            }
        })
        .collect()
}

fn numeric_certainty(method: &'static str, rank: NumericRank, tolerance: f64) -> Certainty {
    Certainty::Numeric {
        method,
        tolerance,
        kept: rank.kept,
        dropped: rank.dropped,
    }
}

/// By the automatic choice.
fn chosen(
    mechanism: &Mechanism,
    state: StateId,
    tolerance: Option<f64>,
) -> Result<StateAnalysis, AnalysisError> {
    let decision = auto::decide(mechanism, state, tolerance)?;
    let as_written = (decision.as_written != decision.rank).then_some(decision.as_written);
    let known = Some(decision.finite);
    let (whole, snapped) = match &decision.geometry {
        Geometry::Exact | Geometry::MeasuredAgreeing(_) => {
            (exactly(mechanism, state, known)?, Vec::new())
        }
        Geometry::Snapped {
            mechanism: snapped,
            moved,
            ..
        } => (exactly(snapped, state, known)?, moved.clone()),
        Geometry::Measured(_) => {
            let whole = exactly(mechanism, state, known)?;
            let certainty = decision.numeric.map_or(whole.certainty, |n| {
                numeric_certainty("svd", n, decision.tolerance)
            });
            let found = numerically(
                mechanism,
                state,
                whole,
                decision.rank,
                certainty,
                decision.tolerance,
            )?;
            (found, Vec::new())
        }
    };
    Ok(StateAnalysis {
        choice: Some(decision.line),
        snapped,
        as_written,
        ..whole
    })
}

/// The same state with its figures from floating point: `rank` by the method asked for, all else from singular values.
fn numerically(
    mechanism: &Mechanism,
    state: StateId,
    whole: StateAnalysis,
    rank: usize,
    certainty: Certainty,
    tolerance: f64,
) -> Result<StateAnalysis, AnalysisError> {
    let measured = Measured::new(mechanism, state, tolerance)?;
    let working_mobility = measured.span_of_links(&outputs(mechanism));
    let external = match whole.external {
        Some(e) => {
            let own: Vec<JointId> = mechanism.joints_in(StateId::FREE).collect();
            let free = Measured::new(mechanism, StateId::FREE, tolerance)?;
            let free_rows = Closure::new(&Reals, mechanism, StateId::FREE)?;
            let free_redundant = free_rows.rows() + free.mobility() - free_rows.columns.len();
            let (actual, working) = (int(free.mobility()), int(measured.span_of_joints(&own)));
            let redundant = whole.rows + measured.mobility() - whole.freedoms;
            let bodies = e.lost_mobility + int(whole.mobility) - e.working_mobility;
            let lost = bodies - (int(measured.mobility()) - working);
            Some(External {
                actual_mobility: actual,
                working_mobility: working,
                lost_mobility: lost,
                redundant: e.constraints - (actual - working) - lost,
                by_rank: int(redundant) - int(free_redundant),
                ..e
            })
        }
        None => None,
    };
    Ok(StateAnalysis {
        rank,
        mobility: whole.freedoms - rank,
        redundant: whole.rows - rank,
        working_mobility,
        local_mobility: measured.mobility().saturating_sub(working_mobility),
        per_contour: measured.shares(),
        per_coupling: measured.coupling_shares(),
        external,
        idle: Vec::new(),
        self_stresses: Vec::new(),
        certainty,
        ..whole
    })
}

fn outputs(mechanism: &Mechanism) -> Vec<LinkId> {
    mechanism
        .link_ids()
        .filter(|&l| mechanism.links[l].role == Role::Output)
        .collect()
}

/// Elementary operations spent on a certificate before an analysis does without: some tenths of a second.
const CERTIFICATE: Budget = Budget {
    coordinates: 100_000,
    primes: 60,
    operations: 50_000_000,
};

/// Whether the rank has a certificate in characteristic 0, made and checked here.
fn proven(mechanism: &Mechanism, state: StateId, rank: usize) -> bool {
    let Ok(field) = certificate::number_field(mechanism, state) else {
        return false;
    };
    let Ok(matrix) = certificate::matrix(&field, mechanism, state) else {
        return false;
    };
    certificate::certify_matrix(&field, &matrix, &mechanism.states[state], CERTIFICATE)
        .is_ok_and(|c| c.rank == rank)
}

/// On exact geometry; `known` is the finite mobility where it was found already, since following a motion takes the most.
fn exactly(
    mechanism: &Mechanism,
    state: StateId,
    known: Option<Finite>,
) -> Result<StateAnalysis, AnalysisError> {
    let fields = [
        rank::field_of(mechanism, state, 0)?,
        rank::field_of(mechanism, state, 1)?,
    ];
    let exact = &fields[0];
    let closure = Closure::new(exact, mechanism, state)?;
    let ranks = [
        modular::rank(exact, &closure),
        modular::rank(&fields[1], &Closure::new(&fields[1], mechanism, state)?),
    ];
    let primes = [exact.field().modulus(), fields[1].field().modulus()];
    if ranks[0] != ranks[1] {
        let state = mechanism.states[state].clone();
        return Err(AnalysisError::Disagree {
            state,
            first: primes[0],
            second: primes[1],
            ranks,
        });
    }
    let rank = ranks[0];
    let certainty = if proven(mechanism, state, rank) {
        Certainty::Proven { primes }
    } else {
        Certainty::Modular { primes }
    };
    let kernel = motions(exact, &closure);
    let outputs = outputs(mechanism);
    let working_mobility = span_of_links(exact, mechanism, &closure, &kernel, &outputs);
    let freedoms = closure.columns.len();
    let joints: Vec<JointId> = mechanism.joints_in(state).collect();
    let links = present_links(mechanism, &joints);
    let constraints: i64 = joints
        .iter()
        .map(|&j| int(closure.dim) - int(freedoms_of(&closure, j)))
        .sum();
    let idle = idle_motions(exact, mechanism, &closure, &kernel, &outputs);
    Ok(StateAnalysis {
        state: mechanism.states[state].clone(),
        links: links.len(),
        joints: joints.len(),
        contours: closure.contours.len(),
        freedoms,
        rows: closure.rows(),
        rank,
        mobility: freedoms - rank,
        finite: match known {
            Some(known) => known,
            None => finite(exact, mechanism, &closure, rank)?,
        },
        working_mobility,
        local_mobility: kernel.len() - working_mobility,
        redundant: closure.rows() - rank,
        formula_mobility: int(closure.dim) * (int(links.len()) - 1)
            - constraints
            - int(closure.couplings.len()),
        per_contour: shares(exact, &closure),
        per_coupling: coupling_shares(exact, mechanism, &closure),
        external: if state == StateId::FREE {
            None
        } else {
            Some(external(exact, mechanism, &closure, &kernel)?)
        },
        idle,
        self_stresses: self_stresses(exact, mechanism, &closure)?,
        left_out: closure.left_out.clone(),
        certainty,
        choice: None,
        snapped: Vec::new(),
        as_written: None,
    })
}

fn int(x: usize) -> i64 {
    i64::try_from(x).unwrap_or(i64::MAX)
}

fn freedoms_of(closure: &Closure<Residue>, joint: JointId) -> usize {
    closure.columns.iter().filter(|c| c.joint == joint).count()
}

fn present_links(mechanism: &Mechanism, joints: &[JointId]) -> Vec<LinkId> {
    let mut links: Vec<LinkId> = joints
        .iter()
        .flat_map(|&j| mechanism.joints[j].links)
        .collect();
    links.sort_unstable();
    links.dedup();
    links
}

/// Dimension of the joint motion of some links over a basis of motions.
fn span_of_links(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    kernel: &[Speeds],
    links: &[LinkId],
) -> usize {
    let paths: Vec<_> = links
        .iter()
        .map(|&l| closure.link_motion(exact, mechanism, l))
        .collect();
    let mut span = Echelon::new(exact.field());
    for speeds in kernel {
        let all: Vec<Residue> = paths.iter().flat_map(|p| twist(exact, p, speeds)).collect();
        span.insert(&all);
    }
    span.rank()
}

fn external(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    kernel: &[Speeds],
) -> Result<External, ExactError> {
    let free = Closure::new(exact, mechanism, StateId::FREE)?;
    let free_rank = modular::rank(exact, &free);
    let rank = modular::rank(exact, closure);
    let own: Vec<JointId> = mechanism.joints_in(StateId::FREE).collect();
    let all: Vec<JointId> = mechanism.joints_in(closure.state).collect();
    let added = || all.iter().filter(|j| !own.contains(j));
    let of_joints: i64 = added()
        .map(|&j| int(closure.dim) - int(freedoms_of(closure, j)))
        .sum();
    let constraints = of_joints + int(closure.couplings.len()) - int(free.couplings.len());
    let bodies = present_links(mechanism, &all).len() - present_links(mechanism, &own).len();
    // The mechanism's own part of each motion.
    let mut span = Echelon::new(exact.field());
    for speeds in kernel {
        let part: Vec<Residue> = speeds
            .iter()
            .zip(&closure.columns)
            .map(|(&s, c)| if own.contains(&c.joint) { s } else { 0 })
            .collect();
        span.insert(&part);
    }
    let (actual, working) = (int(free.columns.len() - free_rank), int(span.rank()));
    let lost = int(closure.dim * bodies) - (int(kernel.len()) - working);
    Ok(External {
        constraints,
        actual_mobility: actual,
        working_mobility: working,
        lost_mobility: lost,
        redundant: constraints - (actual - working) - lost,
        by_rank: int(closure.rows() - rank) - int(free.rows() - free_rank),
    })
}
