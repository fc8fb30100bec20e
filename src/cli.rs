//! The command line: arguments as data, one file per command, three exit codes.

mod command;
mod option;
mod prelude;
mod terminal;

use crate::builtin;
use crate::cli::command::Command;
use crate::cli::option::Global;
use crate::cli::terminal::Done;
use anyhow::Context;
use clap::{ArgMatches, CommandFactory, FromArgMatches, Parser};
use std::ffi::OsString;
use std::io::{ErrorKind, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// A search engine for statically determinate mechanisms.
///
/// FILE is a path, `-` for standard input, or the name of a built-in mechanism (see `ozols list`). A path leads to a mechanism
/// file (TOML, or JSON with the ending .json), a robot description (.urdf, .xml, .sdf) or a CAD assembly (FreeCAD's .FCStd,
/// OndselSolver's .asmt; see `ozols export` for more control).
#[derive(Debug, Parser)]
#[command(name = "ozols", version, max_term_width = 100)]
struct Args {
    /// The command to run.
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    global: Global,
}

/// The text below the help of the program (`ozols`) and of each command, and the text without arguments (`first`).
const EXAMPLES: &str = include_str!("cli/examples.txt");

/// Returns the examples with the names of their commands.
fn named_examples() -> impl Iterator<Item = (&'static str, &'static str)> {
    let parts = EXAMPLES.trim_start_matches("# ").split("\n# ");
    parts.filter_map(|part| part.split_once('\n'))
}

/// Returns the arguments with examples in the help.
fn program() -> clap::Command {
    named_examples().fold(Args::command(), |all, (name, text)| match name {
        "first" => all,
        "ozols" => all.after_help(text),
        name => all.mut_subcommand(name, |c| c.after_help(text)),
    })
}

/// Runs the program.
#[must_use]
pub fn run() -> ExitCode {
    ExitCode::from(run_with(std::env::args_os()))
}

/// Runs the program with these arguments, its name first. Exit codes: 0 done, 1 nothing found or a certificate rejected, 2
/// bad input or failure, 130 interrupted by Ctrl-C, 143 by SIGTERM and 129 by SIGHUP.
pub fn run_with(words: impl IntoIterator<Item = OsString>) -> u8 {
    let words: Vec<OsString> = words.into_iter().collect();
    let program = program();
    let (words, opened) = with_command(&program, words);
    terminal::interrupt::outlive_file_limits();
    let parsed = program.try_get_matches_from(&words);
    let parsed = parsed.and_then(|m| Ok((Args::from_arg_matches(&m)?, output_files(&m))));
    let (args, outputs) = match parsed {
        Ok(parsed) => parsed,
        Err(_) if words.len() == 1 => {
            return exit_code(terminal::output::write_with(None, |out| {
                let first = named_examples().next().map_or("", |(_, text)| text);
                writeln!(out, "{first}")?;
                Ok(Done::Found)
            }));
        }
        Err(e) => return say_parsed(&e),
    };
    terminal::output::kept::forget_files();
    let ready = terminal::output::kept::ensure_distinct(&outputs)
        .and_then(|()| apply_globals(&args.global));
    let result = ready.and_then(|()| run_command(&args));
    let told = |done| match &opened {
        Some(file) => command::reference::check::tell_next(file).map(|_| done),
        None => Ok(done),
    };
    exit_code(result.and_then(told))
}

fn run_command(args: &Args) -> anyhow::Result<Done> {
    match &args.command {
        Command::Analyze(a) => command::analyze::run_analyze(&args.global, a),
        Command::Search(a) => command::search::run_search(&args.global, a),
        Command::Statics(a) => command::statics::run_statics(&args.global, a),
        Command::Grip(a) => command::grip::run_grip(a),
        Command::Drive(a) => command::grip::run_drive(a),
        Command::Verify(a) => command::verify::run_verify(&args.global, a),
        Command::Lint(a) => command::robot::lint::run_lint(a),
        Command::Fix(a) => command::robot::fix::run_fix(a),
        Command::Draw(a) => command::draw::run_draw(&args.global, a),
        Command::Report(a) => command::report::run_report(&args.global, a),
        Command::Studio(a) => command::studio::run_studio(&args.global, a),
        Command::Export(a) => command::export::run_export(&args.global, a),
        Command::Accuracy(a) => command::accuracy::run_accuracy(&args.global, a),
        Command::Catalog(a) => command::catalog::run_catalog(&args.global, a),
        Command::Check(a) => command::reference::check::run_check(&args.global, a),
        Command::New(a) => command::reference::list::run_new(&args.global, a),
        Command::List(a) => command::reference::list::run_list(a),
        Command::Show(a) => command::reference::check::run_show(a),
        Command::Schema => command::reference::check::print_schema(),
        Command::Explain(a) => command::reference::explain::run_explain(a),
        Command::Completions(a) => command::reference::check::print_completions(a, program()),
    }
}

/// Returns what a command with these words prints. `file` is the name and the text of the mechanism file that `-` stands for.
///
/// # Errors
/// Returns an error if a word or a file is refused.
pub fn printed(words: &[OsString], file: Option<(String, String)>) -> anyhow::Result<String> {
    let args = Args::try_parse_from(std::iter::once(&"ozols".into()).chain(words));
    let args = args.map_err(|e| {
        // The usage of a command is of no use to a caller in code.
        let text = e.render().to_string();
        let end = text.find("\n\n").unwrap_or(text.len());
        anyhow::Error::msg(text[..end].trim_start_matches("error: ").to_owned())
    })?;
    if file.is_none() {
        terminal::output::kept::forget_files();
    }
    terminal::output::hush_notes();
    option::load::give_file(file);
    let printed = terminal::output::catch(|| run_command(&args));
    option::load::give_file(None);
    printed
}

/// Returns the message of an error, with the lines of the file that it is about.
#[must_use]
pub fn error_text(e: &anyhow::Error) -> String {
    terminal::output::error_text(e)
}

/// Returns the arguments with the command that a file alone means: `studio` if there is a display and standard output is a terminal,
/// otherwise `check`, with the file.
fn with_command(
    program: &clap::Command,
    mut words: Vec<OsString>,
) -> (Vec<OsString>, Option<String>) {
    let file = match &words[..] {
        [_, file] => file.to_string_lossy().into_owned(),
        _ => return (words, None),
    };
    let is_command = program.find_subcommand(&file).is_some();
    let path = Path::new(&file);
    let is_file = path.extension().is_some() || path.is_file() || builtin::text(&file).is_some();
    if is_command || file.starts_with('-') || !is_file {
        return (words, None);
    }
    let shown = std::io::stdout().is_terminal() && command::studio::has_display();
    words.insert(1, if shown { "studio" } else { "check" }.into());
    (words, (!shown).then_some(file))
}

/// Returns the files that options of a command name to be written, each with the name of its option.
fn output_files(matches: &ArgMatches) -> Vec<(&'static str, PathBuf)> {
    let mut all = matches
        .subcommand()
        .map_or_else(Vec::new, |(_, m)| output_files(m));
    for option in ["output", "certificate", "csv", "svg"] {
        // A command without the option has nothing there.
        if let Ok(Some(path)) = matches.try_get_one::<PathBuf>(option) {
            all.push((option, path.clone()));
        }
    }
    all
}

/// Prints what the parser of the arguments reports and returns the exit code: 0 for help and version, also if nobody reads them to
/// their end, and 2 if they cannot be written.
fn say_parsed(e: &clap::Error) -> u8 {
    match e.print().and_then(|()| std::io::stdout().flush()) {
        _ if e.use_stderr() => 2,
        Err(why) if why.kind() != ErrorKind::BrokenPipe => {
            exit_code(Err(why).context("cannot write standard output"))
        }
        _ => 0,
    }
}

/// Reports an error, if any, and returns the exit code.
fn exit_code(result: anyhow::Result<Done>) -> u8 {
    terminal::output::hide_spinner();
    let interrupted = |code| terminal::interrupt::exit_code().unwrap_or(code);
    match result {
        Ok(Done::Found) => interrupted(0),
        Ok(Done::Nothing) => interrupted(1),
        Ok(Done::Partly) => interrupted(2),
        Err(e) if terminal::output::is_broken_pipe(&e) => interrupted(0),
        Err(e) => {
            terminal::output::print_error(&e);
            2
        }
    }
}

/// Maximum number of threads: each takes some memory, and more threads than processors do not help.
const THREADS: usize = 1024;

fn apply_globals(args: &Global) -> anyhow::Result<()> {
    terminal::interrupt::listen_for_signals()?;
    terminal::output::show_spinner(args.quiet);
    if args.quiet {
        terminal::output::hush_notes();
    }
    if let Some(threads) = args.threads {
        anyhow::ensure!(
            (1..=THREADS).contains(&threads),
            "--threads must be from 1 to {THREADS}"
        );
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build_global()?;
    }
    Ok(())
}
