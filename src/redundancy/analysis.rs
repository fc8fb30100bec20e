//! The structure of a mechanism in each of its states.

use crate::closure::matrix::Closure;
use crate::geom::exact::{ExactError, ExactField};
use crate::geom::expr::Expr;
use crate::geom::scalars::Reals;
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, LinkId, Mechanism, Mode, Role, StateId};
use crate::rank::finite::{Finite, finite};
use crate::rank::numeric::{self, NumericError};
use crate::rank::{Certainty, modular};
use crate::redundancy::idle::{Idle, idle_motions};
use crate::redundancy::motion::{Speeds, motions, twist};
pub use crate::redundancy::share::ContourShare;
use crate::redundancy::share::shares;
use crate::redundancy::stress::{SelfStress, self_stresses};
use thiserror::Error;

/// How the rank is found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// Modulo two primes, on exact geometry.
    Modular,
    /// Singular values in double precision, with a relative tolerance.
    Svd {
        /// Relative tolerance.
        tolerance: f64,
    },
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
    /// Σα: constraints of the joints that the state adds.
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
    /// Rows of J, 6k or 3k.
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
    /// σ = 6k - rank.
    pub redundant: usize,
    /// W by Malyshev's formula, 6(n-1) - Σ constraints (3(n-1) - Σ in a plane): right only where σ = 0.
    pub formula_mobility: i64,
    /// Shares of the contours, in the order used.
    pub per_contour: Vec<ContourShare>,
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
    let of_frames = frames.flat_map(|f| {
        f.point
            .iter()
            .chain(&f.axis)
            .chain(&f.reference)
            .chain([&f.pitch])
    });
    let normal: &[Expr] = match &mechanism.mode {
        Mode::Spatial => &[],
        Mode::Planar { normal } => normal,
    };
    ExactField::for_expressions(of_frames.chain(normal), nth)
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
    let fields = [exact_field(mechanism, 0)?, exact_field(mechanism, 1)?];
    states
        .iter()
        .map(|&s| analyse_state(mechanism, s, method, &fields))
        .collect()
}

fn analyse_state(
    mechanism: &Mechanism,
    state: StateId,
    method: Method,
    fields: &[ExactField; 2],
) -> Result<StateAnalysis, AnalysisError> {
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
    let (rank, certainty) = match method {
        Method::Modular => (ranks[0], Certainty::Modular { primes }),
        Method::Svd { tolerance } => {
            let real = Closure::new(&Reals, mechanism, state)?;
            let r = numeric::rank_with_tolerance(&real, tolerance)?;
            (
                r.rank,
                Certainty::Numeric {
                    tolerance,
                    kept: r.kept,
                    dropped: r.dropped,
                },
            )
        }
    };
    let kernel = motions(exact, &closure);
    let outputs: Vec<LinkId> = (0..mechanism.links.len())
        .filter(|&l| mechanism.links[l].role == Role::Output)
        .collect();
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
        finite: finite(exact, mechanism, &closure, ranks[0])?,
        working_mobility,
        local_mobility: kernel.len() - working_mobility,
        redundant: closure.rows() - rank,
        formula_mobility: int(closure.dim) * (int(links.len()) - 1) - constraints,
        per_contour: shares(exact, &closure),
        external: if state == 0 {
            None
        } else {
            Some(external(exact, mechanism, &closure, &kernel)?)
        },
        idle,
        self_stresses: self_stresses(exact, mechanism, &closure)?,
        left_out: closure.left_out.clone(),
        certainty,
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
    let free = Closure::new(exact, mechanism, 0)?;
    let free_rank = modular::rank(exact, &free);
    let rank = modular::rank(exact, closure);
    let own: Vec<JointId> = mechanism.joints_in(0).collect();
    let all: Vec<JointId> = mechanism.joints_in(closure.state).collect();
    let added = || all.iter().filter(|j| !own.contains(j));
    let constraints = added()
        .map(|&j| int(closure.dim) - int(freedoms_of(closure, j)))
        .sum();
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
