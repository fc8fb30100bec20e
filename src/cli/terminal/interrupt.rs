//! Effect of Ctrl-C, SIGTERM and SIGHUP: a search ends early with its results so far, and any other work ends at once. In both
//! cases the program reports it, leaves no temporary file, and its exit code is 128 plus the number of the signal.

use crate::cli::terminal::output;
use anyhow::Context;
use std::sync::atomic::{AtomicBool, AtomicU8, Ordering};

/// The numbers of SIGHUP, SIGINT and SIGTERM, which are the same everywhere.
const NAMES: [(u8, &str); 3] = [(1, "SIGHUP"), (2, "Ctrl-C"), (15, "SIGTERM")];

/// The first signal received; 0 if none.
static FIRST: AtomicU8 = AtomicU8::new(0);
/// True if a signal was received for which nothing has ended yet.
static PENDING: AtomicBool = AtomicBool::new(false);
/// True if somebody calls [`pending`] regularly and can return early.
static PATIENT: AtomicBool = AtomicBool::new(false);

/// Listens from now on.
pub(crate) fn listen_for_signals() -> anyhow::Result<()> {
    handle().context("cannot listen for signals")
}

/// Makes the limit on the size of files an error of the write that exceeds it. By default its signal ends the program at once and
/// leaves temporary files behind.
pub(crate) fn outlive_file_limits() {
    #[cfg(unix)]
    {
        use std::sync::{Arc, Once};
        static HEARD: Once = Once::new();
        // A signal that somebody hears ends nothing; where it cannot be heard all is as it was.
        HEARD.call_once(|| {
            let flag = Arc::new(AtomicBool::new(false));
            let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, flag);
        });
    }
}

#[cfg(unix)]
fn handle() -> std::io::Result<()> {
    // nohup starts programs with SIGHUP ignored, and that is to stay so.
    let heard_of = |signal: &u8| *signal != 1 || !is_ignored(*signal);
    let numbers = NAMES.map(|(n, _)| n).into_iter().filter(heard_of);
    let mut signals = signal_hook::iterator::Signals::new(numbers.map(i32::from))?;
    std::thread::Builder::new()
        .name("signals".to_owned())
        .spawn(move || {
            for signal in signals.forever() {
                handle_signal(u8::try_from(signal).unwrap_or(2));
            }
        })
        .map(|_| ())
}

/// Returns true if a signal was ignored when the program began; false if unknown, and off Linux.
#[cfg(unix)]
fn is_ignored(signal: u8) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|l| l.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|m| u64::from_str_radix(m.trim(), 16).ok());
    mask.is_some_and(|m| m >> (signal - 1) & 1 == 1)
}

#[cfg(not(unix))]
fn handle() -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(|| handle_signal(2))
}

fn handle_signal(signal: u8) {
    let name = NAMES.iter().find(|(n, _)| *n == signal);
    let name = name.map_or("a signal", |(_, name)| name);
    let goes_on = PATIENT.load(Ordering::SeqCst) && !PENDING.load(Ordering::SeqCst);
    let end = if goes_on {
        "; printing the results so far (once more ends at once)"
    } else {
        ""
    };
    // Before anything else: work that ends early may end the program while this thread waits.
    output::print_note(&format!("interrupted by {name}{end}\n"));
    let _ = FIRST.compare_exchange(0, signal, Ordering::SeqCst, Ordering::SeqCst);
    output::cut_short();
    if goes_on {
        PENDING.store(true, Ordering::SeqCst);
        return;
    }
    output::hide_spinner();
    output::remove_unfinished();
    std::process::exit(signal_code(signal).into());
}

fn signal_code(signal: u8) -> u8 {
    128 + signal
}

/// Leaves the first signal to the callers of [`pending`] from now on.
pub(crate) fn be_patient() {
    PATIENT.store(true, Ordering::SeqCst);
}

/// Makes every signal end the program at once from now on, as before [`be_patient`].
pub(crate) fn be_impatient() {
    PATIENT.store(false, Ordering::SeqCst);
}

/// Returns true if the work should end early.
pub(crate) fn is_pending() -> bool {
    PENDING.load(Ordering::Relaxed)
}

/// Clears the pending signal, because the work it was meant for has ended. The next signal is for the work that follows.
pub(crate) fn clear_pending() {
    PENDING.store(false, Ordering::SeqCst);
}

/// Returns the exit code of a run that was interrupted.
pub(crate) fn exit_code() -> Option<u8> {
    match FIRST.load(Ordering::SeqCst) {
        0 => None,
        signal => Some(signal_code(signal)),
    }
}
