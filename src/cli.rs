//! The command line: arguments as data, one file per command, three exit codes.

mod accuracy;
mod analyze;
mod args;
mod bench;
mod catalog;
mod charts;
mod check;
mod clamped;
mod completions;
mod draw;
mod drive;
mod examples;
mod explain;
mod export;
mod fix;
mod grip;
mod import;
mod interrupt;
mod lint;
mod list;
mod load;
mod machine;
mod man;
mod memory;
mod moving;
mod named;
mod near;
mod new;
mod output;
mod progress;
mod report;
mod request;
mod search;
mod statics;
mod sweep;
mod tone;
mod variant;
mod verify;
mod watch;
mod working;

use clap::Parser;
use std::ffi::OsString;
use std::process::ExitCode;

/// How a command ended without failing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Done {
    /// It did what was asked.
    Found,
    /// There was nothing to be found, or something was that should not be there.
    Nothing,
    /// Some of it failed, which was said, and the rest was done.
    Partly,
}

/// Runs the program.
#[must_use]
pub fn run() -> ExitCode {
    let words: Vec<OsString> = std::env::args_os().collect();
    memory::share_pools(&words);
    ExitCode::from(run_with(words))
}

/// Runs the program with these arguments, its name first. Exit codes: 0 done, 1 nothing found or a certificate rejected, 2
/// bad input or failure, 130 interrupted by Ctrl-C, 143 by SIGTERM and 129 by SIGHUP.
pub fn run_with(words: impl IntoIterator<Item = OsString>) -> u8 {
    let words: Vec<OsString> = words.into_iter().collect();
    let args = match args::Args::try_parse_from(&words) {
        Ok(args) => args,
        Err(_) if words.len() == 1 => {
            return finish(output::to(None, |out| {
                write!(out, "{}", examples::FIRST)?;
                Ok(Done::Found)
            }));
        }
        Err(e) => {
            // Help and version are no failures; a closed pipe is not one either.
            let code = if e.use_stderr() { 2 } else { 0 };
            let _ = e.print();
            return code;
        }
    };
    let result = prepare(&args).and_then(|()| match &args.command {
        args::Command::Analyze(a) => analyze::run(&args, a),
        args::Command::Search(a) => search::run(&args, a),
        args::Command::Statics(a) => statics::run(&args, a),
        args::Command::Grip(a) => grip::run(&args, a),
        args::Command::Drive(a) => drive::run(&args, a),
        args::Command::Verify(a) => verify::run(&args, a),
        args::Command::Import(a) => import::run(a),
        args::Command::Lint(a) => lint::run(a),
        args::Command::Fix(a) => fix::run(a),
        args::Command::Draw(a) => draw::run(&args, a),
        args::Command::Report(a) => report::run(&args, a),
        args::Command::Watch(a) => watch::run(&args, a),
        args::Command::Export(a) => export::run(&args, a),
        args::Command::Accuracy(a) => accuracy::run(&args, a),
        args::Command::Bench(a) => bench::run(&args, a),
        args::Command::Catalog(a) => catalog::run(&args, a),
        args::Command::Sweep(a) => sweep::run(&args, a),
        args::Command::Check(a) => check::run(&args, a),
        args::Command::New(a) => new::run(&args, a),
        args::Command::List(a) => list::run(a),
        args::Command::Show(a) => check::show(a),
        args::Command::Schema => check::schema(),
        args::Command::Explain(a) => explain::run(a),
        args::Command::Completions(a) => completions::run(a),
        args::Command::Man(a) => man::run(a),
    });
    finish(result)
}

/// The exit code, after what went wrong is said.
fn finish(result: anyhow::Result<Done>) -> u8 {
    working::rest();
    let interrupted = |code| interrupt::exit_code().unwrap_or(code);
    match result {
        Ok(Done::Found) => interrupted(0),
        Ok(Done::Nothing) => interrupted(1),
        Ok(Done::Partly) => interrupted(2),
        Err(e) if output::is_broken_pipe(&e) => interrupted(0),
        Err(e) => {
            output::complain(&e);
            2
        }
    }
}

/// Most threads: each takes some memory, and more of them than processors are of no use.
const THREADS: usize = 1024;

fn prepare(args: &args::Args) -> anyhow::Result<()> {
    interrupt::listen()?;
    working::show(args.quiet);
    if args.quiet {
        output::hush();
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
