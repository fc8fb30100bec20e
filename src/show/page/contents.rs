//! The contents of a page.

use crate::draw::{Drawing, Scene};
use crate::model::mechanism::Mechanism;
use crate::redundancy::analysis::StateAnalysis;
use crate::score::outcome::Outcome;
use crate::score::outcome::remarks::Remarks;
use crate::score::outcome::variant::Variant;
use crate::search::check::singular_values::Summary;
use crate::view::terminal::next_commands::NextCommand;
use maud::{Markup, html};

/// Idle freedoms, and self-stresses, of a state that are shown in space.
pub const SHOWN: usize = 24;

/// Everything a page tells.
#[derive(Debug)]
pub struct Page<'a> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// Its figures in every state, in order.
    pub states: &'a [StateAnalysis],
    /// Its redesigns, or why none were searched.
    pub redesigns: Result<Redesigns<'a>, String>,
    /// The same search as a list of ideas, each by its first variant, where the redesigns are not one already.
    pub ideas: Option<Redesigns<'a>>,
    /// The mechanism in space in each state, if there is more to see than in a drawing; with at most [`SHOWN`] idle
    /// freedoms and self-stresses.
    pub scenes: Vec<Option<(Drawing, Scene)>>,
    /// How to get the same from the command line.
    pub commands: Commands,
}

/// The result of a search.
#[derive(Debug)]
pub struct Redesigns<'a> {
    /// Counts and conditions.
    pub found: &'a Outcome,
    /// The variants of the page, in their order.
    pub variants: Vec<Variant<'a>>,
    /// What second opinions and other poses say of them.
    pub summary: Summary,
    /// Whether the giving was interrupted.
    pub interrupted: bool,
    /// Why there are none, and which redesigns are symmetric.
    pub remarks: Remarks,
}

/// How to get what a page shows from the command line: commands quoted for a shell.
#[derive(Debug, Clone)]
pub struct Commands {
    /// The result of each command, and the command.
    pub rows: Vec<(String, String)>,
    /// The same about one variant, with `{}` for its number; empty if there is no such command.
    pub variant: Vec<(String, String)>,
    /// The same about one idea.
    pub idea: Vec<(String, String)>,
    /// A longer list with other options at some joints: a command with `{}` for them.
    pub longer: String,
    /// The commands that find something where this page has nothing.
    pub wider: Vec<NextCommand>,
}

impl Commands {
    pub(super) fn commands_html(&self) -> Markup {
        html! {
            dl.commands {
                @for (what, command) in &self.rows {
                    dt { (what) }
                    dd { code { (command) } }
                }
            }
        }
    }
}
