//! A progress bar for runs that take longer than a second, on a terminal only.

use crate::search::diagram::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::time::{Duration, Instant};

/// Shows how far a run has come.
pub(super) struct Bar {
    bar: Option<ProgressBar>,
    begun: Instant,
    wanted: bool,
}

impl Bar {
    pub(super) fn new(quiet: bool) -> Self {
        Bar {
            bar: None,
            begun: Instant::now(),
            wanted: !quiet && std::io::stderr().is_terminal(),
        }
    }

    /// Shows how far a diagram has come: layer, nodes, and an estimate.
    pub(super) fn show(&mut self, p: Progress) {
        if !self.wanted || self.begun.elapsed() < Duration::from_secs(1) {
            return;
        }
        let bar = self.bar.get_or_insert_with(|| {
            let bar =
                ProgressBar::with_draw_target(Some(p.of as u64), ProgressDrawTarget::stderr());
            let style = ProgressStyle::with_template(
                "{elapsed_precise} [{bar:30}] joint {pos}/{len} {msg} (about {eta} left)",
            );
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar
        });
        bar.set_position(p.done as u64);
        bar.set_message(format!("{} nodes, {} in this layer", p.nodes, p.layer));
    }

    /// Shows how far a run of known length has come.
    pub(super) fn step(&mut self, what: &str, done: usize, of: usize) {
        if !self.wanted || self.begun.elapsed() < Duration::from_secs(1) {
            return;
        }
        let bar = self.bar.get_or_insert_with(|| {
            let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
            let style =
                ProgressStyle::with_template("{elapsed_precise} [{bar:30}] {pos}/{len} {msg}");
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar
        });
        bar.set_length(of as u64);
        bar.set_position(done as u64);
        bar.set_message(what.to_owned());
    }

    pub(super) fn clear(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
