//! A mobility by one method, where that is all there is, as JSON and as text.

use crate::closure::Closure;
use crate::geom::Reals;
use crate::model::mechanism::{Mechanism, Mode, StateId};
use crate::rank::method::{Answer, MobilityMethod};
use serde::Serialize;
use std::fmt::Write;

/// What a method says of a mechanism.
#[derive(Debug, Serialize)]
pub struct ByMethod<'a> {
    /// The mechanism's name.
    pub mechanism: &'a str,
    /// Symbol of the file's unit of length.
    pub length_unit: &'static str,
    /// Its states.
    pub states: Vec<StateByMethod<'a>>,
    /// What the method is called in a sentence.
    #[serde(skip)]
    title: &'static str,
    /// What its answers are worth, where it is from and what it takes.
    #[serde(skip)]
    about: String,
}

/// What it says of a state.
#[derive(Debug, Serialize)]
#[allow(missing_docs, reason = "named as in StateAnalysis")]
pub struct StateByMethod<'a> {
    pub state: &'a str,
    #[serde(flatten)]
    pub size: StructureSize,
    pub mobility: i64,
    pub redundant: i64,
    pub method: &'static str,
    pub certainty: &'static str,
}

impl<'a> ByMethod<'a> {
    /// The answers of a method about states of a mechanism.
    #[must_use]
    pub fn new(
        mechanism: &'a Mechanism,
        method: &dyn MobilityMethod,
        answers: &[(StateId, Answer)],
    ) -> ByMethod<'a> {
        let states = answers.iter().map(|(s, answer)| {
            let size = StructureSize::of(mechanism, *s);
            StateByMethod {
                state: &mechanism.states[*s],
                redundant: answer.mobility + size.rows - size.freedoms,
                size,
                mobility: answer.mobility,
                method: method.name(),
                certainty: method.about().guarantee,
            }
        });
        ByMethod {
            mechanism: &mechanism.name,
            length_unit: mechanism.length_unit.symbol,
            states: states.collect(),
            title: method.about().title,
            about: format!(
                "{} ({}; {})",
                method.about().guarantee,
                method.about().source,
                method.about().complexity
            ),
        }
    }

    /// For people.
    #[must_use]
    pub fn text(&self) -> String {
        let mut out = String::new();
        for s in &self.states {
            // Writing to a string cannot fail.
            let _ = writeln!(
                out,
                "{}, state {}: mobility {} by {}, so σ = W + {} - f = {}",
                self.mechanism, s.state, s.mobility, self.title, s.size.rows, s.redundant
            );
        }
        out + &format!("  {}\n", self.about)
    }
}

/// The numbers of a structure that need no rank.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct StructureSize {
    /// n.
    pub links: i64,
    /// p.
    pub joints: i64,
    /// k.
    pub contours: i64,
    /// f, in the plane those of the plane.
    pub freedoms: i64,
    /// 6k, or 3k in the plane, and one for each coupling.
    #[serde(skip)]
    pub rows: i64,
}

impl StructureSize {
    /// The numbers of a state.
    #[must_use]
    pub fn of(mechanism: &Mechanism, state: StateId) -> StructureSize {
        let mut links: Vec<_> = mechanism
            .joints_in(state)
            .flat_map(|j| mechanism.joints[j].links)
            .collect();
        links.sort_unstable();
        links.dedup();
        let int = |x: usize| i64::try_from(x).unwrap_or(i64::MAX);
        let (links, joints) = (int(links.len()), int(mechanism.joints_in(state).count()));
        let contours = joints + 1 - links;
        let dim = if matches!(mechanism.mode, Mode::Planar { .. }) {
            3
        } else {
            6
        };
        let freedoms = match Closure::new(&Reals, mechanism, state) {
            Ok(closure) => int(closure.columns.len()),
            Err(_) => 0,
        };
        StructureSize {
            links,
            joints,
            contours,
            freedoms,
            rows: dim * contours + int(mechanism.couplings_in(state).count()),
        }
    }
}
