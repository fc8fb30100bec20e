//! An analysis as what is told of it, as JSON, as text and on the page; the keys of JSON are a stable contract.

pub(crate) mod idle;
pub(crate) mod least_rows;
pub mod link_motions;
pub mod mechanism;
pub mod mobility;
pub mod next;
pub mod suggestions;
mod text;

use crate::geom::expr::PI_DIGITS;
use crate::model::claim::{Claim, Topic};
use crate::model::mechanism::Mechanism;
use crate::redundancy::analysis::{self, StateAnalysis};
use crate::redundancy::contour_shares::{ContourShare, CouplingShare};
use crate::redundancy::local_mobility;
use crate::redundancy::stress::{JointWrench, StressVerdict};
use crate::view::analysis::idle::DriveFault;
use crate::view::analysis::least_rows::{ContourRows, least_rows};
use crate::view::analysis::link_motions::LinkMotionData;
use crate::view::analysis::suggestions::{Advice, Suggestions};
use crate::view::claims::about;
use crate::view::stroke::StrokeData;
use crate::view::{as_read, kind};
use serde::Serialize;

/// The analysis of a mechanism.
#[derive(Debug, Serialize)]
pub struct Analysis<'a> {
    /// The mechanism's name.
    pub mechanism: &'a str,
    /// Symbol of the file's unit of length.
    pub length_unit: &'static str,
    /// What the reader of the file took for granted or left out; the certainty of each state counts them.
    pub assumptions: &'a [String],
    /// Its states.
    pub states: Vec<State<'a>>,
    /// The figures over a stroke, where one was asked for.
    pub stroke: Option<StrokeData<'a>>,
    /// What is published of its structure, so or not.
    pub claims: Vec<&'a Claim>,
}

/// One state; see [`StateAnalysis`] for what the figures are.
#[derive(Debug, Serialize)]
#[allow(missing_docs, reason = "named as in StateAnalysis")]
pub struct State<'a> {
    pub state: &'a str,
    pub links: usize,
    pub joints: usize,
    pub contours: usize,
    pub freedoms: usize,
    #[serde(skip)]
    pub rows: usize,
    pub rank: usize,
    pub mobility: usize,
    /// The most it can be, where rounded coordinates leave that undecided.
    pub mobility_at_most: Option<usize>,
    /// Nothing where it is undecided: then the bounds alone are known.
    pub finite_mobility: Option<usize>,
    /// The least it can be: what moves for certain.
    pub finite_mobility_at_least: usize,
    /// The most it can be.
    pub finite_mobility_at_most: usize,
    pub finite_mobility_known_by: &'static str,
    pub finite_mobility_proven: bool,
    /// The finite mobility as a number or a range, and how it is known, in a sentence.
    #[serde(skip)]
    pub finite: [String; 2],
    pub working_mobility: usize,
    pub local_mobility: usize,
    /// What is wrong with the drives.
    pub drives: Vec<DriveFault<'a>>,
    pub redundant: usize,
    /// The most it can be, where rounded coordinates leave that undecided.
    pub redundant_at_most: Option<usize>,
    pub formula_mobility: i64,
    /// Where fewer rows than all are enough, or parts of them do not see each other.
    pub least_rows: Vec<ContourRows>,
    pub per_contour: Vec<Contour<'a>>,
    pub external: Option<External>,
    /// What each output can do, and other links that were asked about.
    pub motions: Vec<LinkMotionData<'a>>,
    pub idle: Vec<Idle<'a>>,
    pub self_stresses: Vec<SelfStress<'a>>,
    pub left_out: Vec<LeftOut<'a>>,
    pub method: &'static str,
    pub certainty: String,
    pub certainty_kind: &'static str,
    /// The primes that ranks were found modulo, as text: they are beyond what a double holds.
    pub primes: Option<[String; 2]>,
    pub choice: Option<&'a str>,
    pub snapped: &'a [String],
    pub as_written: Option<AsWritten>,
    /// Empty where there are no couplings.
    pub per_coupling: Vec<Coupling<'a>>,
    /// What single changes would do, where that was asked for.
    pub suggestions: Option<Suggestions<'a>>,
}

/// The redundant constraints of a contour.
#[derive(Debug, Serialize)]
pub struct Contour<'a> {
    /// Its links.
    pub contour: String,
    /// Its joints.
    pub joints: Vec<&'a str>,
    /// σ in the order reported.
    pub redundant: usize,
    /// The least σ over all orders of these contours, and over all bases that it is part of.
    pub least: usize,
    /// The greatest over all orders of these contours.
    pub greatest: usize,
    /// The greatest over all bases of contours that it is part of.
    pub greatest_over_bases: usize,
    /// What no basis exceeds, where that is more than is known to be reached.
    pub greatest_over_bases_at_most: Option<usize>,
}

/// The redundant constraint that a coupling is, or not.
#[derive(Debug, Serialize)]
pub struct Coupling<'a> {
    /// Names of its two freedoms.
    pub coupling: &'a str,
    /// σ after all that comes before it.
    pub redundant: usize,
    /// The least over all orders: alone it never is redundant.
    pub least: usize,
    /// The greatest.
    pub greatest: usize,
}

/// What a state adds to the free one.
#[derive(Debug, Serialize)]
pub struct External {
    /// By the formula and by ranks.
    #[serde(flatten)]
    pub counted: analysis::External,
    /// Whether both are the same.
    pub agree: bool,
}

/// A motion that leaves every output at rest.
#[derive(Debug, Serialize)]
pub struct Idle<'a> {
    /// The links that move.
    pub links: Vec<&'a str>,
    /// Joints whose points it leaves at rest.
    pub through: Vec<&'a str>,
    /// All that in words.
    pub text: String,
}

/// Loads that parts out of true cause by themselves.
#[derive(Debug, Serialize)]
pub struct SelfStress<'a> {
    /// The contours that pass it round.
    pub contours: Vec<String>,
    /// Whether it exists in this state only.
    pub external: bool,
    /// "harmless" or "harmful".
    pub verdict: &'static str,
    /// What the joints carry.
    pub joints: Vec<Wrench<'a>>,
    /// The couplings that pass it on, in mechanisms that have any.
    pub couplings: Option<Vec<&'a str>>,
    /// The joint where it has the fewest components, of the contacts where they have any, and which.
    #[serde(skip)]
    pub simplest: Option<(&'a str, String)>,
    /// The place in the order reported of the contour it ends in.
    #[serde(skip)]
    pub ends_in: Option<usize>,
}

/// Components of a wrench along the global axes.
#[derive(Debug, Serialize)]
pub struct Wrench<'a> {
    /// The joint.
    pub joint: &'a str,
    /// Axes of its moments.
    pub moments: Vec<&'static str>,
    /// Axes of its forces.
    pub forces: Vec<&'static str>,
    /// Its part of Σ |f|² + |m|²/ℓ² over the joints; nothing where that was not computed.
    pub share: Option<f64>,
}

/// What planar mode leaves out.
#[derive(Debug, Serialize)]
pub struct LeftOut<'a> {
    /// The joint.
    pub joint: &'a str,
    /// How many of its freedoms.
    pub freedoms: usize,
}

/// The figures with every digit taken at its word.
#[derive(Debug, Serialize)]
pub struct AsWritten {
    /// Rank of J.
    pub rank: usize,
    /// W.
    pub mobility: usize,
    /// σ.
    pub redundant: usize,
}

impl<'a> Analysis<'a> {
    /// What `found` says of a mechanism, with `advice` for each of its states, or none.
    #[must_use]
    pub fn new(
        mechanism: &'a Mechanism,
        found: &'a [StateAnalysis],
        advice: &'a [Advice],
    ) -> Analysis<'a> {
        let states = found.iter().enumerate().map(|(i, s)| State {
            suggestions: advice
                .get(i)
                .map(|advice| Suggestions::new(mechanism, s, advice)),
            ..State::new(mechanism, s)
        });
        Analysis {
            mechanism: &mechanism.name,
            length_unit: mechanism.length_unit.symbol,
            assumptions: &mechanism.assumed,
            states: states.collect(),
            stroke: None,
            claims: about(&mechanism.claims, Topic::Structure),
        }
    }
}

impl<'a> State<'a> {
    fn new(mechanism: &'a Mechanism, s: &'a StateAnalysis) -> State<'a> {
        let most = s.at_most();
        State {
            state: &s.state,
            links: s.links,
            joints: s.joints,
            contours: s.contours,
            freedoms: s.freedoms,
            rows: s.rows,
            rank: s.rank,
            mobility: s.mobility,
            mobility_at_most: most.map(|(w, _)| w),
            finite_mobility: Some(s.finite.mobility).filter(|_| !s.finite.is_undecided()),
            finite_mobility_at_least: s.finite.mobility,
            finite_mobility_at_most: s.finite.at_most(),
            finite_mobility_known_by: s.finite.word(),
            finite_mobility_proven: s.finite.is_proven() && mechanism.assumed.is_empty(),
            finite: [s.finite.figure(), as_read(mechanism, s.finite.describe())],
            working_mobility: s.working_mobility,
            local_mobility: s.local_mobility,
            drives: s
                .drives
                .iter()
                .map(|d| DriveFault::new(mechanism, d))
                .collect(),
            redundant: s.redundant,
            redundant_at_most: most.map(|(_, sigma)| sigma),
            formula_mobility: s.formula_mobility,
            least_rows: least_rows(mechanism, s),
            per_contour: (s.per_contour.iter().map(|c| Contour::new(mechanism, c))).collect(),
            external: s.external.map(|counted| External {
                counted,
                agree: counted.redundant == counted.by_rank,
            }),
            // Coordinates that were analysed have values.
            motions: s
                .output_motions(mechanism)
                .unwrap_or_default()
                .iter()
                .map(|of| LinkMotionData::new(mechanism, of))
                .collect(),
            idle: s.idle.iter().map(|i| Idle::new(mechanism, i)).collect(),
            self_stresses: s
                .self_stresses
                .iter()
                .map(|t| SelfStress::new(mechanism, s, t))
                .collect(),
            left_out: s
                .left_out
                .iter()
                .map(|&(j, freedoms)| LeftOut {
                    joint: &mechanism.joints[j].id,
                    freedoms,
                })
                .collect(),
            method: s.method,
            certainty: certainty(mechanism, s),
            certainty_kind: kind(mechanism, s.certainty.word()),
            primes: s.certainty.primes().map(|p| p.map(|p| p.to_string())),
            choice: s.choice.as_deref(),
            snapped: &s.snapped,
            as_written: s.as_written.map(|rank| AsWritten {
                rank,
                mobility: s.freedoms - rank,
                redundant: s.rows - rank,
            }),
            per_coupling: s.per_coupling.iter().map(Coupling::new).collect(),
            suggestions: None,
        }
    }
}

impl<'a> Idle<'a> {
    fn new(mechanism: &'a Mechanism, i: &local_mobility::Idle) -> Idle<'a> {
        let (links, through) = (i.links.iter(), i.through.iter());
        Idle {
            links: links.map(|&l| mechanism.links[l].id.as_str()).collect(),
            through: through.map(|&j| mechanism.joints[j].id.as_str()).collect(),
            text: idle::words(mechanism, i),
        }
    }
}

impl<'a> Contour<'a> {
    fn new(mechanism: &'a Mechanism, c: &ContourShare) -> Contour<'a> {
        let joints = c.contour.joints.iter();
        Contour {
            contour: c.contour.name(mechanism),
            joints: joints
                .map(|(j, _)| mechanism.joints[*j].id.as_str())
                .collect(),
            redundant: c.redundant,
            least: c.range.0,
            greatest: c.range.1,
            greatest_over_bases: c.over_bases.0,
            greatest_over_bases_at_most: Some(c.over_bases.1).filter(|&m| m > c.over_bases.0),
        }
    }
}

impl<'a> Coupling<'a> {
    fn new(c: &'a CouplingShare) -> Coupling<'a> {
        Coupling {
            coupling: &c.name,
            redundant: c.redundant,
            least: 0,
            greatest: c.most,
        }
    }
}

impl<'a> SelfStress<'a> {
    fn new(
        mechanism: &'a Mechanism,
        s: &'a StateAnalysis,
        t: &'a crate::redundancy::stress::SelfStress,
    ) -> SelfStress<'a> {
        // At the contacts, where there are any, since that is where external redundancy is felt.
        let simplest = t
            .joints
            .iter()
            .filter(|w| !t.external || mechanism.joints[w.joint].states.is_some())
            .map(|w| Wrench::new(mechanism, w))
            .min_by_key(|w| w.moments.len() + w.forces.len());
        let contours = t.contours.iter();
        let couplings = t.couplings.iter();
        SelfStress {
            contours: contours
                .map(|&c| s.per_contour[c].contour.name(mechanism))
                .collect(),
            external: t.external,
            verdict: match t.verdict {
                StressVerdict::Harmless => "harmless",
                StressVerdict::Harmful => "harmful",
            },
            joints: t.joints.iter().map(|w| Wrench::new(mechanism, w)).collect(),
            couplings: (!s.per_coupling.is_empty()).then(|| {
                couplings
                    .map(|&q| s.per_coupling[q].name.as_str())
                    .collect()
            }),
            simplest: simplest.map(|w| (w.joint, w.words())),
            ends_in: t.contours.last().copied(),
        }
    }
}

impl<'a> Wrench<'a> {
    fn new(mechanism: &'a Mechanism, w: &JointWrench) -> Wrench<'a> {
        let axes = |flags: [bool; 3]| {
            let named = ["x", "y", "z"].into_iter().zip(flags);
            named.filter(|(_, there)| *there).map(|(a, _)| a).collect()
        };
        Wrench {
            joint: &mechanism.joints[w.joint].id,
            moments: axes(w.moments),
            forces: axes(w.forces),
            share: w.borne.map(|b| b.share()),
        }
    }
}

/// How sure the figures are; π is not exact, whatever the rest.
fn certainty(m: &Mechanism, s: &StateAnalysis) -> String {
    let words = s.certainty.describe();
    let sure = match (s.as_written.is_some(), m.has_pi()) {
        (true, _) => format!("as meant: {words}"),
        (false, true) => {
            let digits = format!("pi to {PI_DIGITS} decimals, all else exact");
            words.replacen("exact geometry", &digits, 1)
        }
        (false, false) => words,
    };
    as_read(m, sure)
}
