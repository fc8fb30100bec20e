//! A spinner for work of unknown length, on a terminal only.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// The state of the spinner: how often work began or ended, and the bar.
static WORKING: Mutex<(u64, Option<ProgressBar>)> = Mutex::new((0, None));

/// Shows on a terminal that work continues, after a second and until [`rest`].
pub(crate) fn show_spinner(quiet: bool) {
    if quiet || !std::io::stderr().is_terminal() {
        return;
    }
    let mut shown = lock_working();
    shown.0 += 1;
    let began = shown.0;
    std::thread::spawn(move || {
        std::thread::sleep(Duration::from_secs(1));
        let mut shown = lock_working();
        if shown.0 == began {
            let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
            let style = ProgressStyle::with_template("{elapsed_precise} {spinner} working");
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
            bar.set_elapsed(Duration::from_secs(1));
            bar.enable_steady_tick(Duration::from_millis(100));
            shown.1 = Some(bar);
        }
    });
}

/// Takes away what [`show`] shows: something is written.
pub(crate) fn hide_spinner() {
    let mut shown = lock_working();
    shown.0 += 1;
    if let Some(bar) = shown.1.take() {
        bar.finish_and_clear();
    }
}

fn lock_working() -> MutexGuard<'static, (u64, Option<ProgressBar>)> {
    WORKING.lock().unwrap_or_else(PoisonError::into_inner)
}
