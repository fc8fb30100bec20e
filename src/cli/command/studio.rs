//! `ozols studio`.

use crate::cli::prelude::*;
use crate::studio::{Opening, Studio};
use std::process::{Command, Stdio};

#[derive(Debug, ClapArgs)]
pub(crate) struct StudioArgs {
    /// File to work on (a new one must end in .toml), or name of a built-in mechanism to start from [default: an empty sheet].
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    file: Option<Named>,
    #[command(flatten)]
    loops: Loops,
    /// Print the address without opening a browser.
    #[arg(long)]
    no_open: bool,
}

/// Returns what an argument opens. A file takes precedence over a built-in mechanism of the same name.
fn parse_opening(file: Option<&Named>, loops: &Loops) -> anyhow::Result<Opening> {
    let here = PathBuf::from(".");
    let Some(file) = file else {
        return Ok(Opening::Nothing(here));
    };
    let path = file.path();
    ensure!(
        loops.path.is_none() || robots::is_description(file),
        "--loops is for robot descriptions, and {file} is not one"
    );
    ensure!(
        &**file != "-",
        "standard input cannot be saved; give a file name"
    );
    if path.is_file() {
        robots::refuse_foreign(file, &api::bytes(path, MAX_DESCRIPTION_BYTES)?)?;
        return Ok(Opening::File(path.to_path_buf(), loops.import_options()?));
    }
    if builtin::text(file).is_some() {
        return Ok(Opening::Builtin(file.to_string(), here));
    }
    let fresh = path.extension().is_some_and(|e| e == "toml") && !path.exists();
    if fresh && api::folder_of(path).is_dir() {
        return Ok(Opening::File(
            path.to_path_buf(),
            robots::Options::default(),
        ));
    }
    bail!(load::unknown_file(file))
}

pub(crate) fn run_studio(global: &Global, a: &StudioArgs) -> anyhow::Result<Done> {
    let opening = parse_opening(a.file.as_ref(), &a.loops)?;
    let request = Request {
        seed: global.seed,
        ..Request::default()
    };
    let studio = Studio::new(opening, request).with_context(|| match &a.file {
        Some(file) => format!("cannot open {file}"),
        None => "cannot open the studio".to_owned(),
    })?;
    let address = studio.page_address();
    output::hide_spinner();
    output::write_bytes(None, format!("{address}\n"))?;
    if !a.no_open && !open_browser(&address) {
        output::print_note("no browser could be started; open the address above in one\n");
    }
    output::print_note("It ends when its window is closed, or with Ctrl-C.\n");
    let unsaved = studio.serve_windows(|words| output::print_message(&format!("{words}\n")))?;
    if let Some(path) = unsaved {
        output::print_message(&format!(
            "unsaved work is in {}; `ozols studio` offers it when the file is opened again\n",
            path.display()
        ));
    }
    Ok(Done::Found)
}

/// Returns true if a browser has a screen to open on.
pub(crate) fn has_display() -> bool {
    let is_set = |name| std::env::var_os(name).is_some_and(|v| !v.is_empty());
    cfg!(any(target_os = "macos", windows)) || is_set("DISPLAY") || is_set("WAYLAND_DISPLAY")
}

/// Opens an address in the browser of this machine; whether there is a program that does.
fn open_browser(address: &str) -> bool {
    let (program, first): (&str, &[&str]) = if cfg!(target_os = "macos") {
        ("open", &[])
    } else if cfg!(windows) {
        ("rundll32", &["url.dll,FileProtocolHandler"])
    } else {
        ("xdg-open", &[])
    };
    let mut command = Command::new(program);
    command.args(first).arg(address);
    for to in [Command::stdin, Command::stdout, Command::stderr] {
        to(&mut command, Stdio::null());
    }
    command.spawn().is_ok()
}
