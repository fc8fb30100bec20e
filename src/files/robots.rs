//! Robot descriptions (URDF, MJCF, SDF) and CAD assemblies (FreeCAD, OndselSolver) read as mechanisms, and mechanisms written for other programs.

mod additions;
mod cad;
mod description;
mod edit;
pub mod formats;
mod import;
mod include;
mod mechanism;
mod mjcf;
mod prelude;
mod sdf;
mod urdf;
mod warning;
mod xml;

pub use crate::robots::formats::refuse_foreign;
pub use crate::robots::formats::{begins_description, is_description};
pub use crate::robots::warning::ExportError;
pub use crate::robots::warning::{KINEMATICS, Options, Reader, Report};
pub use description::origin::{ElementPlace, Origin};
pub use import::{Imported, import};

use crate::redundancy::release::{Release, added_freedoms};
use crate::robots::cad::retype;
use crate::robots::edit::{Edits, Freeing, comment_out, free_sdf, free_urdf};
use crate::robots::mechanism::series_of_single_joints::escape_comment;
use crate::robots::prelude::*;

/// Returns the freedoms that a redesign adds to the joints of a mechanism.
///
/// # Errors
/// Returns the reason if these are not freedoms of existing joints, in words that follow the redesign's name.
///
/// # Examples
/// ```
/// use ozols::robots::find_releases;
/// let four_bar = ozols::built_in("four-bar")?;
/// let outcome = ozols::search(&four_bar, &ozols::Request::default())?;
/// let best = outcome.variants().next().expect("there are 14").as_mechanism();
/// assert_eq!(find_releases(&four_bar, &best)?.len(), 3); // One for each redundant constraint.
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn find_releases(before: &Mechanism, after: &Mechanism) -> Result<Vec<Release>, String> {
    if after.joints.len() != before.joints.len() {
        return Err("inserts joints that are not of one joint's kind; choose another".to_owned());
    }
    let mut out = Vec::new();
    for (i, (old, new)) in before.joints.iter().zip(&after.joints).enumerate() {
        let all = added_freedoms((&old.frame, &old.joint_type), (&new.frame, &new.joint_type))
            .map_err(|e| e.to_string())?;
        if old.joint_type.freedoms().len() + all.len() != new.joint_type.freedoms().len() {
            return Err(format!(
                "replaces \"{}\" by a joint that lacks some of its freedoms; choose another",
                old.id
            ));
        }
        out.extend(all.into_iter().map(|(slides, direction)| Release::Freedom {
            joint: JointId::new(i),
            slides,
            direction,
        }));
    }
    Ok(out)
}

/// Returns the description with releases applied: joints added in series, and couplings removed. Everything else stays byte for
/// byte; comments give the reasons. In an assembly of a CAD program joints get another type that the program has; all other
/// members of an archive stay unchanged.
///
/// # Errors
/// Returns an error if the format cannot represent a release at its place.
///
/// # Examples
/// ```
/// use ozols::robots::{self, Options};
/// let four_bar = ozols::built_in("four-bar")?;
/// let outcome = ozols::search(&four_bar, &ozols::Request::default())?;
/// let best = outcome.variants().next().expect("there are 14").as_mechanism();
/// let sdf = ozols::export(&four_bar, "sdf")?;
/// let none = |_: &str| Err(std::io::ErrorKind::NotFound.into());
/// let read = |bytes: &[u8]| robots::import("four-bar.sdf", bytes, &none, &Options::default());
/// let releases = robots::find_releases(&four_bar, &best)?.into_iter();
/// let releases: Vec<_> = releases.map(|r| (r, "held twice".into())).collect();
/// let fixed = robots::apply_releases(&read(sdf.as_bytes())?, &releases)?;
/// assert_eq!(ozols::analyze(&read(&fixed)?.mechanism)?[0].redundant, 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn apply_releases(
    imported: &Imported,
    releases: &[(Release, String)],
) -> Result<Vec<u8>, ImportError> {
    let origin = &imported.origin;
    let mut freed: BTreeMap<JointId, Vec<(bool, Vector, String)>> = BTreeMap::new();
    let mut uncoupled = Vec::new();
    for (release, why) in releases {
        let why = escape_comment(&format!("ozols fix: {why}"));
        match *release {
            Release::Coupling(q) => uncoupled.push((origin.couplings[q], why)),
            Release::Freedom {
                joint,
                slides,
                direction,
            } => freed
                .entry(joint)
                .or_default()
                .push((slides, direction, why)),
        }
    }
    if origin.is_assembly() {
        let uncoupled = uncoupled.first().map(|(element, _)| *element);
        return retype::retype_joints(imported, &freed, uncoupled);
    }
    let mut edits = Edits::new(origin);
    let (free, uncouple): (Free, Uncouple) = match imported.format.word {
        "mjcf" => (mjcf::fix::free_joints, mjcf::fix::deactivate),
        "urdf" => (free_urdf, comment_out),
        _ => (free_sdf, comment_out),
    };
    let mut all: Vec<Freeing<'_>> = Vec::new();
    for (&joint, list) in &freed {
        let part = origin.part_of(joint);
        let Some(e) = part.element else {
            let element = format!("loop \"{}\"", part.id);
            let why = "it is defined in the file of loop closures";
            let remedy = "choose a joint of the description";
            let problem = unsupported_problem(&element, why, remedy);
            return Err(origin.element(origin.root).error_at(None, problem));
        };
        let e = origin.element(e);
        all.push((part, e, list));
    }
    free(origin, &all, &mut edits)?;
    for (element, why) in uncoupled {
        uncouple(element, &why, &mut edits)?;
    }
    Ok(edits.apply_edits()?.into_bytes())
}

type Free = fn(&Origin, &[Freeing<'_>], &mut Edits<'_>) -> Result<(), ImportError>;
type Uncouple = fn(usize, &str, &mut Edits<'_>) -> Result<(), ImportError>;
