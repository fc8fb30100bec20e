//! A drawn mechanism as a row of a catalogue.

use crate::catalog::RowError;
use crate::catalog::row::{IdeaRow, Symmetric, ideas_of};
use crate::closure::contour::contour_basis;
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{Mechanism, Mode, StateId};
use crate::rank::finite::{Finite, How};
use crate::redundancy::analysis::{Method, analyse_states};
use crate::robots::formats;
use crate::score::request::{Check, List, Request};
use crate::score::run::run;
use num_bigint::BigUint;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;

/// A drawn mechanism, searched with the options and workload of its file.
#[derive(Debug, Clone)]
pub struct DrawnMechanism {
    /// `drawn-` and the beginning of a hash of the file.
    pub id: String,
    /// Its name.
    pub name: String,
    /// Its description.
    pub description: String,
    /// The file in TOML.
    pub file: String,
    /// Links, joints and contours of the free state.
    pub size: [usize; 3],
    /// `spatial`, or `planar`.
    pub mode: &'static str,
    /// Its drive: `slide` or `turn`. `None` unless one joint of one freedom is driven.
    pub input: Option<&'static str>,
    /// W and σ as built.
    pub as_built: (usize, usize),
    /// The full-cycle mobility, and how it is known.
    pub finite: String,
    /// Variants with σ = 0, by W and number of changes.
    pub counts: BTreeMap<(i64, u32), BigUint>,
    /// The number of them that are their own image under the symmetry that the file names, if it names one.
    pub symmetric: Symmetric,
    /// The number of variants that keep the output motion and have at most the full-cycle mobility.
    pub admissible: BigUint,
    /// Whether every count is exact; lower bounds otherwise.
    pub exact: bool,
    /// Requested number of ideas.
    pub ideas_asked: usize,
    /// The best of these ideas, cheapest first.
    pub ideas: Vec<IdeaRow>,
}

/// Returns the mobility with the weakest word that applies to it.
pub(super) fn mobility_words(finite: &Finite) -> String {
    let word = match finite.how {
        _ if finite.numeric => "numeric",
        _ if finite.is_proven() => "proven",
        How::Traced { .. } => "followed",
        How::Bound => "bound",
        _ => "undecided",
    };
    format!("{}, {word}", finite.format_figure())
}

/// Returns the id of a mechanism, and its file.
fn named_file(mechanism: &Mechanism) -> Result<(String, String), RowError> {
    let file = formats::write(mechanism, "toml").map_err(|e| RowError::File {
        structure: mechanism.name.clone(),
        why: e.to_string(),
    })?;
    let digest = Sha256::digest(&file);
    let hash: String = digest[..4].iter().map(|b| format!("{b:02x}")).collect();
    Ok((format!("drawn-{hash}"), file))
}

/// Returns the id of a drawn mechanism in a catalogue.
///
/// # Errors
/// Returns an error if it cannot be written as a file.
///
/// # Examples
/// ```
/// use ozols::catalog::drawn::id;
/// let [one, other] = [id(&ozols::built_in("four-bar")?)?, id(&ozols::built_in("bennett")?)?];
/// assert!(one.starts_with("drawn-") && one != other);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn id(mechanism: &Mechanism) -> Result<String, RowError> {
    Ok(named_file(mechanism)?.0)
}

/// Searches a drawn mechanism.
///
/// # Errors
/// Returns an error if it cannot be analysed, searched or written.
///
/// # Examples
/// ```
/// use ozols::catalog::drawn::search_drawn;
/// let found = search_drawn(ozols::built_in("four-bar")?, 3, 1_000_000)?;
/// assert_eq!((found.as_built, found.admissible.to_string().as_str()), ((1, 3), "12"));
/// assert!(found.exact && found.ideas.len() <= 3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn search_drawn(
    mechanism: Mechanism,
    top: usize,
    nodes: usize,
) -> Result<DrawnMechanism, RowError> {
    let (id, file) = named_file(&mechanism)?;
    let method = Method::Auto;
    let as_built = analyse_states(&mechanism, &[StateId::FREE], method)?.swap_remove(0);
    let joints = mechanism.joints_in(StateId::FREE).count();
    let contours = contour_basis(&mechanism, StateId::FREE).len();
    let mut drives = mechanism.joints.iter().filter(|j| j.drive);
    let input = match (drives.next(), drives.next()) {
        (Some(only), None) => match only.joint_type.freedoms() {
            [Freedom::Rz] => Some("turn"),
            [Freedom::Tz] => Some("slide"),
            _ => None,
        },
        _ => None,
    };
    let moves = i64::try_from(as_built.finite.at_most()).unwrap_or(i64::MAX);
    let request = Request {
        max_mobility: Some(moves),
        list: List::Top(top.max(1)),
        check: Check::Prime,
        nodes,
        ..Request::default()
    };
    let mode = match mechanism.mode {
        Mode::Spatial => "spatial",
        Mode::Planar { .. } => "planar",
    };
    let (name, description) = (mechanism.name.clone(), mechanism.description.clone());
    let links = mechanism.links_with_ids().filter(|(l, _)| {
        let mut joints = mechanism.joints_in(StateId::FREE);
        joints.any(|j| mechanism.joints[j].links.contains(l))
    });
    let size = [links.count(), joints, contours];
    let symmetric = Symmetric::search_symmetric(&mechanism, &request)
        .unwrap_or_else(|_| Symmetric::without_symmetry());
    let outcome = run(mechanism, &request, &|| false, &mut |_| {})?;
    Ok(DrawnMechanism {
        id,
        name,
        description,
        file,
        size,
        mode,
        input,
        as_built: (as_built.mobility, as_built.redundant),
        finite: mobility_words(&as_built.finite),
        counts: outcome.determinate.by_mobility_and_changes.clone(),
        admissible: outcome.admissible.total.clone(),
        exact: outcome.is_exact() && symmetric.exact,
        symmetric,
        ideas_asked: top,
        ideas: ideas_of(&outcome, top),
    })
}
