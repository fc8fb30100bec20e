//! What a redesign lets go, as releases of a description's joints.

use crate::model::mechanism::{JointId, Mechanism};
use crate::redundancy::release::{Release, added};

/// The freedoms that a redesign adds to the joints of a mechanism.
///
/// # Errors
/// Why these are not freedoms of the joints that are there, in words that follow the redesign's name.
pub fn releases(before: &Mechanism, after: &Mechanism) -> Result<Vec<Release>, String> {
    if after.joints.len() != before.joints.len() {
        return Err("puts in joints that are not of one joint's kind; choose another".to_owned());
    }
    let mut out = Vec::new();
    for (i, (old, new)) in before.joints.iter().zip(&after.joints).enumerate() {
        let all = added((&old.frame, &old.joint_type), (&new.frame, &new.joint_type))
            .map_err(|e| e.to_string())?;
        if old.joint_type.freedoms().len() + all.len() != new.joint_type.freedoms().len() {
            return Err(format!(
                "puts a joint in the place of \"{}\" that has not all of its freedoms; choose another",
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
