//! A mobility by one method, where that is all there is, as JSON and as text.

use crate::closure::Closure;
use crate::geom::Reals;
use crate::rank::method::{Answer, MobilityMethod};
use crate::search::answer::single_changes::USUAL_UNLOADING;
use crate::view::analysis::State;
use crate::view::analysis::suggestions::{Advice, concerned_count};
use crate::view::prelude::*;
use crate::view::terminal::next_commands::{file_name, shell_word};

/// Answers of a method for states of a mechanism.
#[derive(Debug)]
pub struct ByMethod<'a> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// The method.
    pub method: &'a MobilityMethod,
    /// Its answers.
    pub answers: Vec<(StateId, Answer)>,
}

impl ByMethod<'_> {
    /// Returns the name of each state, its size, its mobility and its redundant constraints.
    fn state_figures(&self) -> impl Iterator<Item = (&str, StructureSize, [i64; 2])> {
        self.answers.iter().map(|(s, answer)| {
            let size = StructureSize::of_state(self.mechanism, *s);
            let redundant = answer.mobility + size.rows - size.freedoms;
            (
                &*self.mechanism.states[*s],
                size,
                [answer.mobility, redundant],
            )
        })
    }

    /// Returns it as data.
    pub fn json(&self) -> Value {
        let state = |(name, size, [mobility, redundant]): (&str, StructureSize, [i64; 2])| {
            json!({
                "state": name,
                "links": size.links,
                "joints": size.joints,
                "contours": size.contours,
                "freedoms": size.freedoms,
                "mobility": mobility,
                "redundant": redundant,
                "method": self.method.name(),
                "certainty": self.method.guarantee,
            })
        };
        json!({
            "mechanism": self.mechanism.name,
            "length_unit": self.mechanism.length_unit.symbol,
            "states": self.state_figures().map(state).collect::<Value>(),
        })
    }

    /// Returns it for people, with what the answers are worth, where the method is from and what it takes.
    pub fn text(&self) -> String {
        let (name, about) = (&self.mechanism.name, self.method);
        let line = |(state, size, [mobility, redundant]): (&str, StructureSize, [i64; 2])| {
            format!(
                "{name}, state {state}: mobility {mobility} by {}, so σ = W + {} - f = {redundant}\n",
                about.title, size.rows
            )
        };
        let lines: String = self.state_figures().map(line).collect();
        format!(
            "{lines}  {} ({}; {})\n",
            about.guarantee, about.source, about.complexity
        )
    }
}

/// The numbers of a structure that need no rank.
#[derive(Debug, Clone, Copy)]
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
    pub rows: i64,
}

impl StructureSize {
    /// Returns the numbers of a state.
    ///
    /// # Examples
    /// ```
    /// use ozols::{model::mechanism::StateId, view::analysis::mobility::StructureSize};
    /// let size = StructureSize::of_state(&ozols::built_in("gripper-10")?, StateId::FREE);
    /// assert_eq!((size.links, size.joints, size.contours, size.freedoms, size.rows), (10, 13, 4, 14, 24));
    /// # Ok::<(), ozols::Error>(())
    /// ```
    pub fn of_state(mechanism: &Mechanism, state: StateId) -> StructureSize {
        let int = |x: usize| i64::try_from(x).unwrap_or(i64::MAX);
        let links = int(mechanism.links_in(state).count());
        let joints = int(mechanism.joints_in(state).count());
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

/// Returns the commands to suggest after an analysis of `file`.
pub fn next(m: &Mechanism, states: &[State<'_>], file: &str) -> Vec<NextCommand> {
    let mut steps: Vec<NextCommand> = states.iter().filter_map(|s| to_remove(s, file)).collect();
    if !steps.is_empty() {
        return steps;
    }
    let loaded = m.loads.acts_from_outside(StateId::FREE) || m.loads.gravity.is_some();
    if loaded {
        steps.push(NextCommand::new(
            "statics",
            file,
            "",
            "the joints' reactions to its loads",
        ));
    }
    let svg = file_name(&m.name, "svg");
    steps.push(NextCommand::new(
        "draw",
        file,
        &format!("-o {svg}"),
        "a drawing of it",
    ));
    steps
}

/// Returns the step towards redesigns without the redundant constraints of a state. Returns `None` if no change is known that
/// removes any.
fn to_remove(s: &State<'_>, file: &str) -> Option<NextCommand> {
    let Some(Advice::Changes(found)) = s.advice else {
        return None;
    };
    let of = concerned_count(s.found);
    match (found.usual, found.state) {
        (_, StateId::FREE) => Some(NextCommand::new(
            "search",
            file,
            "",
            &format!("list the redesigns that remove all {of}, cheapest first"),
        )),
        (false, n) => {
            let best = found.list.first();
            let left = best.map_or(of, |x| of.saturating_sub(x.removes));
            let state = if n == StateId::new(1) {
                String::new()
            } else {
                format!(" {}", typed_option("state", shell_word(&s.found.state)))
            };
            Some(NextCommand::new(
                "search",
                file,
                &(typed_option("max-external", left) + &state),
                &format!(
                    "also limit the redundant constraints added by clamping to {left} of {of}"
                ),
            ))
        }
        (true, _) if !found.list.is_empty() => Some(NextCommand {
            command: format!(
                "Write at a contact of state {}: unloading = [\"{}\"]",
                s.found.state,
                USUAL_UNLOADING.name()
            ),
            gives: format!(
                "so that `ozols search` may insert it; {} asks for it",
                typed_option("max-external", "N")
            ),
        }),
        (true, _) => None,
    }
}
