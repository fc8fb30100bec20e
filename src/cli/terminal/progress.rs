//! Progress of a run that takes longer than a second, on a terminal only.

use crate::cli::terminal::{interrupt, output};
use crate::model::mechanism::Mechanism;
use crate::score::outcome::Outcome;
use crate::score::request::prepare::LooksRounded;
use crate::score::request::{List, Request};
use crate::score::run::{self, Event, RunError, ShouldCancel, Tell};
use crate::search::diagram::Progress;
use crate::search::question::conditions::Conditions;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Says what a search noticed.
pub(crate) fn print_line(text: String) {
    output::print_note(&format!("{text}\n"));
}

/// Watches a search: shows its progress, and ends it early at a signal.
pub(crate) struct SearchWatch {
    bar: Bar,
    quiet: bool,
}

impl SearchWatch {
    pub(crate) fn new(quiet: bool) -> SearchWatch {
        let bar = Bar::new(quiet);
        SearchWatch { bar, quiet }
    }

    /// Searches a mechanism.
    pub(crate) fn run_search(
        &mut self,
        mechanism: Mechanism,
        request: &Request,
    ) -> Result<Outcome, RunError> {
        self.watch_search(request, |cancel, tell| {
            run::run(mechanism, request, cancel, tell)
        })
    }

    /// Searches one that is prepared.
    pub(crate) fn answer_request(
        &mut self,
        mechanism: Arc<Mechanism>,
        conditions: Conditions,
        measured: Option<LooksRounded>,
        request: &Request,
    ) -> Result<Outcome, RunError> {
        self.watch_search(request, |cancel, tell| {
            run::answer_request(mechanism, conditions, measured, request, cancel, tell)
        })
    }

    fn watch_search<T>(
        &mut self,
        request: &Request,
        search: impl FnOnce(ShouldCancel<'_>, Tell<'_>) -> T,
    ) -> T {
        let SearchWatch { bar, quiet } = self;
        search(&interrupt::is_pending, &mut |event| match event {
            Event::Note(text) => print_line(text),
            Event::Building(p) => {
                output::hide_spinner();
                interrupt::be_patient();
                bar.show_diagram(p);
            }
            Event::Built => {
                bar.clear();
                output::show_spinner(*quiet);
                // What was found so far is still given, unless it is a list without end; another signal stops the giving.
                if request.list != List::All {
                    interrupt::clear_pending();
                }
            }
            Event::Proving { done, of } if done < of => {
                bar.show_step("branches that could win", done, of)
            }
            Event::Proving { .. } => bar.clear(),
        })
    }
}

/// A bar that shows the progress of a run.
pub(crate) struct Bar {
    bar: Option<ProgressBar>,
    begun: Instant,
    wanted: bool,
}

impl Bar {
    pub(crate) fn new(quiet: bool) -> Self {
        Bar {
            bar: None,
            begun: Instant::now(),
            wanted: !quiet && std::io::stderr().is_terminal(),
        }
    }

    /// Shows how far a diagram has come: layer, nodes, and an estimate.
    fn show_diagram(&mut self, p: Progress) {
        let message = format!("{} nodes, {} in this layer", p.nodes, p.layer);
        self.set_progress("joint ", p.done, p.of, message);
    }

    /// Shows how far a run of known length has come.
    pub(crate) fn show_step(&mut self, what: &str, done: usize, of: usize) {
        output::hide_spinner();
        self.set_progress("", done, of, what.to_owned());
    }

    fn set_progress(&mut self, prefix: &'static str, done: usize, of: usize, message: String) {
        if !self.wanted || self.begun.elapsed() < Duration::from_secs(1) {
            return;
        }
        let bar = self.bar.get_or_insert_with(|| {
            let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
            let style = ProgressStyle::with_template(
                "{elapsed_precise} [{bar:30}] {prefix}{pos}/{len} {msg} (about {eta} left)",
            );
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar
        });
        bar.set_prefix(prefix);
        bar.set_length(of as u64);
        bar.set_position(done as u64);
        bar.set_message(message);
    }

    pub(crate) fn clear(&mut self) {
        if let Some(bar) = self.bar.take() {
            bar.finish_and_clear();
        }
    }
}
