//! FILE arguments: paths, standard input, and built-in names.

use crate::api::{self, MAX_DESCRIPTION_BYTES};
use crate::builtin;
use crate::cli::option::named::{File, Named};
use crate::cli::option::reading::import_description;
use crate::cli::terminal::output::kept;
use crate::closure::coupling::in_plane;
use crate::closure::twist::{FrameValues, MotionSpace};
use crate::file::text::{MAX_BYTES, mechanism_from_bytes};
use crate::format::{did_you_mean, join_and};
use crate::geom::Reals;
use crate::geom::expr::Expr;
use crate::model::joint_type::Coupling;
use crate::model::mechanism::{Mechanism, Mode, StateId};
use crate::robots;
use anyhow::{Context, bail, ensure};
use itertools::Itertools;
use std::cell::RefCell;
use std::io::Read;

thread_local! {
    /// The name and the text of the file that `-` stands for, if it is not standard input.
    static GIVEN: RefCell<Option<(String, String)>> = const { RefCell::new(None) };
}

/// Sets the file that `-` stands for.
pub(crate) fn give_file(file: Option<(String, String)>) {
    GIVEN.set(file);
}

/// Reads the mechanism that an argument names. A file wins over a built-in mechanism of the same name.
pub(crate) fn load_mechanism(file: &File) -> anyhow::Result<Mechanism> {
    if let Some(imported) = description_of(file)? {
        return Ok(imported.mechanism);
    }
    load_written(&file.file)
}

/// Returns the mechanism that a mechanism file describes.
pub(crate) fn load_written(file: &Named) -> anyhow::Result<Mechanism> {
    let (name, bytes) = read_plain(file)?;
    Ok(mechanism_from_bytes(&name, &bytes)?)
}

/// Returns whether an argument names a robot description or a CAD assembly, by its ending or by what is in it.
pub(crate) fn is_described(file: &Named) -> anyhow::Result<bool> {
    let path = file.path();
    if !path.is_file() {
        return Ok(false);
    }
    Ok(robots::is_description(file)
        || robots::begins_description(&api::bytes(path, MAX_DESCRIPTION_BYTES)?))
}

/// Returns the name for messages, and the bytes of the mechanism file that an argument names or that is converted from its
/// description.
pub(crate) fn read_named(file: &File) -> anyhow::Result<(String, Vec<u8>)> {
    match description_of(file)? {
        Some(imported) => {
            let text = imported.toml()?;
            Ok(("the imported mechanism".to_owned(), text.into_bytes()))
        }
        None => read_plain(&file.file),
    }
}

/// Returns the same for a file that is not a robot description or assembly.
pub(crate) fn read_plain(file: &Named) -> anyhow::Result<(String, Vec<u8>)> {
    if &**file == "-" {
        if let Some((name, text)) = GIVEN.with_borrow(Clone::clone) {
            return Ok((name, text.into_bytes()));
        }
        kept::keep_standard_input()?;
        let mut bytes = Vec::new();
        // One byte more than allowed, so that the reader can say that there are too many.
        std::io::stdin()
            .lock()
            .take(MAX_BYTES as u64 + 1)
            .read_to_end(&mut bytes)?;
        ensure!(
            !bytes.trim_ascii_start().starts_with(b"<"),
            "standard input is XML, but only TOML and JSON can be read from it; save a robot description in a file and name the file"
        );
        return Ok(("standard input".to_owned(), bytes));
    }
    let path = file.path();
    if path.is_file() {
        let bytes = api::bytes(path, MAX_BYTES)?;
        robots::refuse_foreign(file, &bytes)?;
        ensure!(
            !bytes.trim_ascii_start().starts_with(b"<"),
            "{file} is XML; robot descriptions are recognized by their endings, so rename it .urdf, .sdf or .xml"
        );
        return Ok((file.to_string(), bytes));
    }
    let Some(text) = builtin::text(file) else {
        bail!(unknown_file(file))
    };
    Ok((format!("{file}.toml"), text.as_bytes().to_vec()))
}

/// Returns the error of an option that robot descriptions alone take: the file is not one, or it does not exist.
pub(crate) fn unsuited_option(option: &str, file: &Named) -> String {
    let exists = &**file == "-" || file.path().exists() || builtin::text(file).is_some();
    if !exists {
        return unknown_file(file);
    }
    format!(
        "{option} is for robot descriptions, and {file} is not one; give a URDF, MJCF or SDF file, or omit {option}"
    )
}

/// Returns the mechanism of a robot description and reports doubtful values. `None` if the argument is not such a file.
fn description_of(file: &File) -> anyhow::Result<Option<robots::Imported>> {
    let (file, loops) = (&file.file, &file.loops);
    let path = file.path();
    if !path.is_file() || !robots::is_description(file) {
        ensure!(loops.path.is_none(), unsuited_option("--loops", file));
        return Ok(None);
    }
    let imported = import_description(path, &loops.import_options()?)?;
    tell_doubts(file, &imported);
    Ok(Some(imported))
}

/// Says what is doubtful in a description.
pub(crate) fn tell_doubts(file: &Named, imported: &robots::Imported) {
    let doubts = imported.report.list_doubts();
    if !doubts.is_empty() {
        crate::cli::terminal::output::print_note(&format!(
            "{file}: {}\n{doubts}",
            imported.format.name
        ));
    }
}

/// Returns the state that an option names.
pub(crate) fn find_state(m: &Mechanism, name: &str) -> anyhow::Result<StateId> {
    let known = || {
        format!(
            "{} has no state {name}; it has: {}",
            m.name,
            m.states.join(", ")
        )
    };
    m.state_named(name).with_context(known)
}

/// Models a mechanism in the plane of x and y. Couplings of freedoms out of the plane are omitted and reported.
///
/// # Errors
/// Returns an error that names the joints that cannot move in the plane at all. A joint that keeps a freedom in it is accepted.
pub(crate) fn put_in_plane(mechanism: &mut Mechanism) -> anyhow::Result<()> {
    mechanism.edit().mode = Mode::Planar {
        normal: [0, 0, 1].map(Expr::from),
    };
    let space = MotionSpace::new(&Reals, &mechanism.mode)?;
    let mut stuck = Vec::new();
    for joint in &mechanism.joints {
        let freedoms = joint.joint_type.freedoms();
        let frame = FrameValues::new(&Reals, &joint.frame)?;
        if !freedoms.is_empty() && frame.motions_in_space(&Reals, &space, freedoms).is_empty() {
            stuck.push(joint.id.as_str());
        }
    }
    ensure!(
        stuck.is_empty(),
        "--planar does not apply to {}: no freedom of {} lies in the plane of x and y; omit --planar to model all six components, \
         or place the axes of hinges along z and those of sliders across it",
        mechanism.name,
        join_and(
            &stuck
                .iter()
                .map(|id| format!("joint {id}"))
                .collect::<Vec<_>>()
        )
    );
    let all = std::mem::take(&mut mechanism.edit().couplings);
    let stays = |c: &Coupling| {
        c.ends
            .iter()
            .all(|e| in_plane(mechanism, e.joint, e.freedom))
    };
    let (kept, left): (Vec<Coupling>, Vec<Coupling>) = all.into_iter().partition(stays);
    if !left.is_empty() {
        let names = left.iter().map(|c| c.name(mechanism)).join(", ");
        crate::cli::terminal::output::print_note(&format!(
            "note: --planar omits the couplings of freedoms out of the plane: {names}\n"
        ));
    }
    mechanism.edit().couplings = kept;
    Ok(())
}

/// Returns the message for a name that is neither a regular file nor a built-in mechanism.
pub(crate) fn unknown_file(file: &Named) -> String {
    match std::fs::metadata(file.path()) {
        Ok(m) if m.is_dir() => return format!("{file} is a folder; name a file in it"),
        Ok(m) if !m.is_file() => {
            return format!("{file} is not a regular file; `-` reads standard input");
        }
        _ => {}
    }
    let hint = did_you_mean::suggest_words(file, builtin::names());
    format!(
        "{file} is neither a file nor a built-in mechanism{hint}; `ozols list` shows the built-in mechanisms"
    )
}

/// Returns the message for a name that is not a built-in mechanism, if a file is not allowed.
pub(crate) fn no_built_in(name: &str) -> String {
    let hint = did_you_mean::suggest_words(name, builtin::names());
    format!("{name} is not a built-in mechanism{hint}; `ozols list` shows them")
}
