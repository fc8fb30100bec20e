//! Results go to standard output or to a file, which is written completely or not at all. Errors go to standard error.

use crate::chart::{Chart, page};
use crate::cli::terminal::Done;
use crate::file::problem::ImportError;
use crate::format::plain::{escape_control, escape_except_colours};
use crate::{api, view};
use anstream::{AutoStream, ColorChoice};
use anstyle::AnsiColor;
use anyhow::Context;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
pub(crate) use kept::{cut_short, remove_unfinished};
use std::cell::RefCell;
use std::io::{self, BufWriter, ErrorKind, IsTerminal, StdoutLock, Write};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

pub(crate) mod kept;

/// The output of a command that is called within this process.
#[derive(Default)]
struct Caught {
    out: Vec<u8>,
    /// The first error.
    error: Option<String>,
}

thread_local! {
    static CAUGHT: RefCell<Option<Caught>> = const { RefCell::new(None) };
}

/// Returns true if a caller within this process gets the output of this thread.
pub(crate) fn is_caught() -> bool {
    CAUGHT.with_borrow(Option::is_some)
}

/// Runs a command, and returns what it writes to standard output.
///
/// # Errors
/// Returns the error of the command, or the first one that it prints.
pub(crate) fn catch(run: impl FnOnce() -> anyhow::Result<Done>) -> anyhow::Result<String> {
    CAUGHT.set(Some(Caught::default()));
    let done = run();
    let caught = CAUGHT.take().unwrap_or_default();
    done?;
    match caught.error {
        Some(text) => Err(anyhow::Error::msg(text)),
        None => Ok(String::from_utf8(caught.out)?),
    }
}

/// Returns the file to write to, if it is not standard output.
fn target_file(path: Option<&Path>) -> Option<&Path> {
    path.filter(|p| *p != Path::new("-"))
}

/// Runs `write` on standard output, which is also `-`, or on a file that appears under its name only once it is complete.
pub(crate) fn write_with(
    path: Option<&Path>,
    write: impl FnOnce(&mut dyn Write) -> anyhow::Result<Done>,
) -> anyhow::Result<Done> {
    let Some(path) = target_file(path) else {
        if is_caught() {
            let mut all = Vec::new();
            let done = write(&mut all)?;
            CAUGHT.with_borrow_mut(|c| c.get_or_insert_default().out.append(&mut all));
            return Ok(done);
        }
        kept::apart_from_standard_output()?;
        return write_through("standard output", Standard::new(), write);
    };
    kept::ensure_apart(path)?;
    let name = path.display().to_string();
    let whole = || format!("cannot write {}", path.display());
    // A link is followed, so that its target gets the data; a device or pipe has no beside and is written to directly.
    let path = &std::fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    let old = path.metadata().ok();
    if old.as_ref().is_some_and(|m| !m.is_file() && !m.is_dir()) {
        let file = std::fs::OpenOptions::new()
            .write(true)
            .open(path)
            .with_context(whole)?;
        return write_through(&name, file, write);
    }
    let folder = api::folder_of(path);
    if path.is_dir() {
        anyhow::bail!("{}: this is a folder; name a file in it", whole());
    }
    if !folder.is_dir() {
        anyhow::bail!(
            "{}: no folder {}; create it first",
            whole(),
            folder.display()
        );
    }
    let mut temporary = kept::begin_file(folder).with_context(whole)?;
    let done = write_through(&name, temporary.as_file_mut(), write)?;
    let older = old.as_ref().is_some_and(|m| m.len() > 0);
    if let Some(old) = old {
        let file = temporary.as_file();
        file.set_permissions(old.permissions())
            .with_context(whole)?;
    }
    let other = kept::rename_file(temporary, path, older).with_context(whole)?;
    kept::note_written(path);
    if let Some(other) = other {
        print_message(&format!(
            "{} was not changed; partial results are in {}\n",
            path.display(),
            other.display()
        ));
    }
    Ok(done)
}

/// Writes a text or other bytes to standard output or a file.
pub(crate) fn write_bytes(path: Option<&Path>, all: impl AsRef<[u8]>) -> anyhow::Result<Done> {
    write_with(path, |out| {
        out.write_all(all.as_ref())?;
        Ok(Done::Found)
    })
}

/// Creates a folder if it is missing.
pub(crate) fn make_folder(folder: &Path) -> anyhow::Result<()> {
    std::fs::create_dir_all(folder)
        .with_context(|| format!("cannot make the folder {}", folder.display()))
}

/// Writes charts, each with the name of its files, to a folder as SVG and CSV. The folder is created if it is missing. A table has no row
/// where a line breaks. A page of all charts is written if a title is given.
pub(crate) fn write_charts(
    folder: &Path,
    title: Option<&str>,
    all: Vec<(String, Chart)>,
) -> anyhow::Result<()> {
    make_folder(folder)?;
    let write = |name: &str, text: &str| write_bytes(Some(&folder.join(name)), text);
    let mut parts = Vec::new();
    for (name, mut chart) in all {
        let svg = chart.svg();
        write(&format!("{name}.svg"), &svg)?;
        for series in &mut chart.series {
            series.points.retain(|p| p.1.is_finite());
        }
        write(&format!("{name}.csv"), &chart.csv())?;
        parts.push((chart.title, String::new(), svg));
    }
    if let Some(title) = title {
        write("index.html", &page(title, &parts))?;
    }
    Ok(())
}

/// Returns an error if a drawing or a page would be written to a terminal.
pub(crate) fn not_to_terminal(path: Option<&Path>, what: &str) -> anyhow::Result<()> {
    anyhow::ensure!(
        path.is_some() || !io::stdout().is_terminal(),
        "{what} is not written to a terminal; give a file with -o FILE"
    );
    Ok(())
}

/// Returns a value as JSON for people to read and programs to parse.
pub(crate) fn json_text(value: &impl serde::Serialize) -> anyhow::Result<String> {
    Ok(view::pretty_json(value)? + "\n")
}

/// Minimum width of a text, in columns.
const NARROWEST: u16 = 40;

/// Returns the width of standard output: `OZOLS_WIDTH` if set, otherwise the width of its terminal.
pub(crate) fn output_width(path: Option<&Path>) -> Option<u16> {
    match target_file(path) {
        None if !is_caught() => fitted_width(&console::Term::stdout()),
        _ => None,
    }
}

/// Returns the same for standard error.
pub(crate) fn error_width() -> Option<u16> {
    fitted_width(&console::Term::stderr())
}

fn fitted_width(to: &console::Term) -> Option<u16> {
    // Not COLUMNS: whoever uses readline, as Python's shell does, hands it to programs whose output is kept.
    let said = std::env::var("OZOLS_WIDTH")
        .ok()
        .and_then(|c| c.parse().ok());
    let found = said.or_else(|| to.is_term().then(|| to.size().1));
    found.map(|w: u16| w.max(NARROWEST))
}

/// Returns true if the reader of our output has gone away.
pub(crate) fn is_broken_pipe(e: &anyhow::Error) -> bool {
    e.chain().any(|c| {
        c.downcast_ref::<std::io::Error>()
            .is_some_and(|io| io.kind() == std::io::ErrorKind::BrokenPipe)
    })
}

/// True if only errors are printed on standard error.
static QUIET: AtomicBool = AtomicBool::new(false);

/// Leaves out all notes from now on.
pub(crate) fn hush_notes() {
    QUIET.store(true, Ordering::Relaxed);
}

/// Prints a note on standard error; a closed one is not an error.
pub(crate) fn print_note(text: &str) {
    if !QUIET.load(Ordering::Relaxed) {
        print_message(text);
    }
}

/// Says something on standard error, even where only errors are wanted.
pub(crate) fn print_message(text: &str) {
    hide_spinner();
    let _ = write!(std::io::stderr().lock(), "{}", escape_control(text));
}

/// Prints an error, in colour if standard error is a terminal that supports it (NO_COLOR, CLICOLOR_FORCE), like the parser of the
/// arguments.
pub(crate) fn print_error(e: &anyhow::Error) {
    if is_caught() {
        return CAUGHT.with_borrow_mut(|c| {
            let caught = c.get_or_insert_default();
            caught.error.get_or_insert_with(|| error_text(e));
        });
    }
    let text = match file_problems(e) {
        Some(import) => import.render(true),
        None => {
            let style = AnsiColor::Red.on_default().bold();
            format!(
                "{style}error:{style:#} {}",
                escape_control(&format!("{e:#}"))
            )
        }
    };
    coloured_note(&text);
}

/// Returns the message of an error without colours.
pub(crate) fn error_text(e: &anyhow::Error) -> String {
    file_problems(e).map_or_else(|| format!("{e:#}"), |problems| problems.render(false))
}

/// Returns the problems of a file, if these are the cause of an error.
pub(crate) fn file_problems(e: &anyhow::Error) -> Option<&ImportError> {
    e.chain()
        .find_map(|c| match c.downcast_ref::<api::Error>() {
            Some(api::Error::File(problems)) => Some(problems),
            _ => c.downcast_ref::<ImportError>(),
        })
}

/// Prints a note on standard error, without its colours if they are not supported.
pub(crate) fn coloured_note(text: &str) {
    let _ = writeln!(anstream::stderr().lock(), "{}", escape_except_colours(text));
}

/// The kind of a verdict.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Tone {
    Good,
    Doubtful,
    Bad,
}

/// Returns a text with each of the verdicts in its colour; each verdict is searched for after the one before. Returns it
/// unchanged if it goes to a file or nobody looks.
pub(crate) fn colour_verdicts(
    text: String,
    path: Option<&Path>,
    verdicts: impl IntoIterator<Item = (String, Tone)>,
) -> String {
    let plain = is_caught() || target_file(path).is_some();
    if plain || AutoStream::choice(&std::io::stdout()) == ColorChoice::Never {
        return text;
    }
    let mut rest = text.as_str();
    let mut out = String::with_capacity(text.len());
    for (words, tone) in verdicts {
        // A terminal so narrow that the words are broken has them without colour.
        let Some((before, after)) = rest.split_once(&words) else {
            continue;
        };
        let colour = match tone {
            Tone::Good => AnsiColor::Green,
            Tone::Doubtful => AnsiColor::Yellow,
            Tone::Bad => AnsiColor::Red,
        };
        let style = colour.on_default().bold();
        out += &format!("{before}{style}{words}{style:#}");
        rest = after;
    }
    out + rest
}

/// Runs `write` on a named output, and returns its result after everything is written.
fn write_through(
    name: &str,
    out: impl Write,
    write: impl FnOnce(&mut dyn Write) -> anyhow::Result<Done>,
) -> anyhow::Result<Done> {
    let mut out = BufWriter::new(Named { name, out });
    let done = write(&mut out)?;
    out.flush()?;
    Ok(done)
}

/// A writer with a name, whose errors report what could not be written and what to do about it.
struct Named<'n, W> {
    name: &'n str,
    out: W,
}

impl<W> Named<'_, W> {
    /// Returns an error of the same kind that names what is written.
    fn named(&self, why: io::Error) -> io::Error {
        let remedy = match why.kind() {
            ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
                "; free some space, or write elsewhere"
            }
            ErrorKind::FileTooLarge => "; raise the limit on the size of files (ulimit -f)",
            _ => "",
        };
        let words = format!("cannot write {}: {why}{remedy}", self.name);
        io::Error::new(why.kind(), words)
    }
}

impl<W: Write> Write for Named<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.out.write(bytes).map_err(|why| self.named(why))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush().map_err(|why| self.named(why))
    }
}

/// Standard output, locked. Nothing is drawn over the output, and on a terminal no text of a file can control it.
struct Standard {
    out: StdoutLock<'static>,
    /// The beginning of a line that is not complete yet, on a terminal.
    line: Option<Vec<u8>>,
}

impl Standard {
    fn new() -> Standard {
        let out = io::stdout();
        let line = out.is_terminal().then(Vec::new);
        Standard {
            out: out.lock(),
            line,
        }
    }
}

impl Write for Standard {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        hide_spinner();
        let Some(line) = &mut self.line else {
            return self.out.write(bytes);
        };
        line.extend_from_slice(bytes);
        if let Some(end) = line.iter().rposition(|b| *b == b'\n') {
            let rest = line.split_off(end + 1);
            let whole = std::mem::replace(line, rest);
            write_coloured(&mut self.out, &whole)?;
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        if let Some(line) = &mut self.line {
            write_coloured(&mut self.out, &std::mem::take(line))?;
        }
        self.out.flush()
    }
}

fn write_coloured(out: &mut dyn Write, bytes: &[u8]) -> io::Result<()> {
    out.write_all(escape_except_colours(&String::from_utf8_lossy(bytes)).as_bytes())
}

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

#[cfg(test)]
mod tests {
    use super::write_coloured;

    #[test]
    fn colours_pass_and_nothing_else_does() {
        let mut out = Vec::new();
        write_coloured(&mut out, "\u{1b}[1mσ\u{1b}[0m \u{1b}]0;x\u{7}\n".as_bytes()).unwrap();
        let text = String::from_utf8(out).unwrap();
        assert_eq!(text, "\u{1b}[1mσ\u{1b}[0m \\u{1b}]0;x\\u{7}\n");
    }
}
