//! Information on an incomplete file: the places of its items, and the part of it that is connected to the frame.

use crate::file::edit::{Edit, Thing, apply_edits};
use crate::file::prelude::*;
use crate::file::read::value::with_parameters;
use crate::file::text::read_file;
use crate::file::write::toml;

/// Returns the places of joints and of points of interest as numbers; `None` for those with an invalid expression.
///
/// # Examples
/// ```
/// use ozols::file::{loose::read_points, write::mechanism_file};
/// let [joints, _] = read_points(&mechanism_file(&ozols::built_in("four-bar")?));
/// assert_eq!(joints[2], Some([80.0, 90.0, 0.0]));
/// # Ok::<(), ozols::Error>(())
/// ```
#[must_use]
pub fn read_points(file: &MechanismFile) -> [Vec<Option<[f64; 3]>>; 2] {
    let one = |v: &[Coordinate; 3]| {
        let out = with_parameters(file);
        let before = out.problem_count();
        let read = out.root_place().read_vector(v);
        (out.problem_count() == before).then(|| read.map(|e| e.to_f64()))
    };
    [
        file.joint.iter().map(|j| one(&j.point)).collect(),
        file.point.iter().map(|p| one(&p.point)).collect(),
    ]
}

/// Returns the file without the links that no joint joins to the frame, and without references to them. `None` if nothing is
/// left, or all.
#[must_use]
pub fn connected_part(file: &MechanismFile) -> Option<MechanismFile> {
    let mut links = file.link.iter();
    let frame = links.find(|l| l.role.as_deref() == Some("frame"))?;
    let mut there = BTreeSet::from([frame.id.as_str()]);
    loop {
        let before = there.len();
        for [a, b] in file.joint.iter().map(|j| &j.links) {
            if there.contains(a.as_str()) || there.contains(b.as_str()) {
                there.extend([a.as_str(), b.as_str()]);
            }
        }
        if there.len() == before {
            break;
        }
    }
    if there.len() < 2 || file.link.iter().all(|l| there.contains(l.id.as_str())) {
        return None;
    }
    let gone = |l: &&LinkEntry| !there.contains(l.id.as_str());
    let gone = file.link.iter().filter(gone);
    let items = gone.map(|l| (Thing::Link, l.id.clone())).collect();
    let mut whole = file.clone();
    // Their states may be gone.
    whole.expected.clear();
    let text = toml(&whole).ok()?;
    let text = apply_edits(&text, &[Edit::Remove { items }]).ok()?;
    read_file("part.toml", &text, |part| Ok(part.clone())).ok()
}
