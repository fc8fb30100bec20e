//! What is found at a sample: the mechanism with these values, as every other command would find it.

use crate::accuracy::{AnswerVerdict, Truth};
use crate::file::problem::ImportError;
use crate::file::text::mechanism_at;
use crate::geom::expr::Expr;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::method::Certainty;
use crate::rank::method::registry;
use crate::redundancy::analysis::{AnalysisError, Method, StateAnalysis, analyse};
use crate::sweep::Sweep;
use crate::sweep::forces::{Forces, forces};
use crate::sweep::known_or_why::Known;
use crate::sweep::redesigns::{SampleRedesigns, redesigns};
use crate::sweep::space::Sample;
use crate::sweep::stroke::{OverStroke, over_stroke};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What is found at a sample.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SampleRow {
    /// Its number, from 0.
    pub sample: usize,
    /// The values of the parameters that vary.
    pub at: BTreeMap<String, f64>,
    /// Those of them that no decimal is, as expressions.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub exact: BTreeMap<String, String>,
    /// Why there is no such mechanism, or none that can be analysed; the rest is left out then.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub problem: Option<String>,
    /// The states, the free one first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub states: Vec<SampleState>,
    /// The redesigns, where they were searched.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub redesigns: Option<Known<SampleRedesigns>>,
    /// The greatest joint force as built, where there is a load.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub forces: Option<Known<Forces>>,
    /// The rank over a stroke, state by state, where that was asked.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub stroke: BTreeMap<String, Known<OverStroke>>,
    /// What each rank method is worth in the free state, where that was asked and the truth is proven.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub methods: BTreeMap<String, String>,
}

/// The structure of a state; see [`StateAnalysis`].
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct SampleState {
    /// Its name.
    pub state: String,
    /// W at the pose of the file.
    pub mobility: usize,
    /// The mobility that is really there: a number, or a range.
    pub finite_mobility: String,
    /// How that is known.
    pub finite_mobility_known_by: String,
    /// σ; the least it can be where that is undecided.
    pub redundant: usize,
    /// The most it can be, where rounded coordinates leave it undecided.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub redundant_at_most: Option<usize>,
    /// σ contour by contour, in the order of the mechanism's basis.
    pub per_contour: Vec<usize>,
    /// How sure the rank is, in a word; `snapped` where it is that of a geometry within the digits.
    pub certainty: String,
}

impl SampleState {
    fn new(found: &StateAnalysis) -> SampleState {
        let shares = found.per_contour.iter().map(|s| s.redundant);
        // Exact of something else than what is written.
        let meant =
            found.as_written.is_some() && !matches!(found.certainty, Certainty::Undecided { .. });
        SampleState {
            state: found.state.clone(),
            mobility: found.mobility,
            finite_mobility: found.finite.figure(),
            finite_mobility_known_by: found.finite.word().to_owned(),
            redundant: found.redundant,
            redundant_at_most: found.at_most().map(|(_, sigma)| sigma),
            per_contour: shares.collect(),
            certainty: if meant {
                "snapped"
            } else {
                found.certainty.word()
            }
            .to_owned(),
        }
    }
}

impl Sweep {
    /// The mechanism of a sample.
    ///
    /// # Errors
    /// Where its values make none; every problem with its place in the file.
    pub(crate) fn mechanism_of(&self, sample: &Sample) -> Result<Mechanism, ImportError> {
        mechanism_at(&self.spec.file, &self.spec.text, &sample.values)
    }

    /// The row of a sample.
    ///
    /// # Complexity
    /// Reading the file, an analysis of every state, and what else is asked.
    #[must_use]
    pub fn row(&self, sample: &Sample) -> SampleRow {
        let pairs = || sample.values.iter();
        let is_decimal = |v: &Expr| {
            let near = Expr::from_f64(v.to_f64());
            near.is_ok_and(|n| n.as_rational().is_some() && n.as_rational() == v.as_rational())
        };
        let exact = pairs().filter(|(_, v)| !is_decimal(v));
        let empty = SampleRow {
            sample: sample.number,
            at: pairs().map(|(n, v)| (n.clone(), v.to_f64())).collect(),
            exact: exact.map(|(n, v)| (n.clone(), v.to_string())).collect(),
            problem: None,
            states: Vec::new(),
            redesigns: None,
            forces: None,
            stroke: BTreeMap::new(),
            methods: BTreeMap::new(),
        };
        let failed = |why: String| SampleRow {
            problem: Some(why),
            ..empty.clone()
        };
        match self.mechanism_of(sample) {
            Err(problems) => failed(problems.to_string()),
            Ok(m) => self
                .filled(&m, &empty)
                .unwrap_or_else(|e| failed(e.to_string())),
        }
    }

    fn filled(&self, m: &Mechanism, empty: &SampleRow) -> Result<SampleRow, AnalysisError> {
        let states: Vec<StateId> = m.state_ids().collect();
        let asked = &self.spec.asked;
        let method = if asked.as_written {
            Method::Modular
        } else {
            Method::Auto
        };
        let found = analyse(m, &states, method)?;
        let methods = match found.first() {
            Some(free) if asked.methods => judged(m, free),
            _ => BTreeMap::new(),
        };
        let stroke = asked.stroke.as_ref().map(|(text, range)| {
            let over = |s: StateId| Known::of(over_stroke(m, s, text, *range));
            let each = states.iter();
            each.map(|&s| (m.states[s].clone(), over(s))).collect()
        });
        Ok(SampleRow {
            states: found.iter().map(SampleState::new).collect(),
            redesigns: asked
                .search
                .as_ref()
                .map(|request| Known::of(redesigns(m, request, asked.top))),
            forces: forces(m),
            stroke: stroke.unwrap_or_default(),
            methods,
            ..empty.clone()
        })
    }
}

/// What each method's answer for the free state is worth; nothing where the truth is not proven.
fn judged(m: &Mechanism, free: &StateAnalysis) -> BTreeMap<String, String> {
    let exact = matches!(
        free.certainty,
        Certainty::Proven { .. } | Certainty::Modular { .. }
    );
    if !exact || free.as_written.is_some() || !free.finite.is_proven() {
        return BTreeMap::new();
    }
    let int = |n: usize| i64::try_from(n).unwrap_or(i64::MAX);
    let truth = Truth {
        instantaneous: int(free.mobility),
        finite: int(free.finite.mobility),
    };
    let word = |answer| AnswerVerdict::on(&answer, truth).word().to_owned();
    let each = registry::ALL.iter();
    each.map(|method| {
        (
            method.name().to_owned(),
            word(method.answer(m, StateId::FREE)),
        )
    })
    .collect()
}
