//! Doubtful values of a file: ratios and pitches that are written as decimals and are nearly fractions, and directions of options
//! that are not given and default to the joint's own, where they have another meaning.

use crate::file::lint::Found;
use crate::file::locate::DocumentPath;
use crate::file::schema::{JointEntry, MechanismFile, OptionTable};
use crate::file::warning::first_of;
use crate::format::significant;
use crate::geom::expr::Expr;
use crate::model::joint_type::JointType;
use crate::model::mechanism::{Joint, Mechanism};
use crate::model::rounded::ratio::{doubt, doubt_of};

/// Returns the doubtful values of the couplings and screws of a mechanism.
pub(super) fn doubted(file: &MechanismFile, m: &Mechanism) -> Found {
    let couplings = m.couplings.iter().enumerate().filter_map(|(i, c)| {
        let doubt = doubt_of(c)?;
        let message = format!(
            "the ratio {} of {} is a decimal, known to within {}; write ratio = \"{}\" if that is intended, or another fraction",
            c.ratio,
            c.name(m),
            significant(doubt.half),
            doubt.fraction
        );
        let path = DocumentPath::root("coupling").index(i).key("ratio");
        Some((path, message.into()))
    });
    let screws = file.joint.iter().zip(&m.joints).enumerate();
    let screws = screws.filter_map(|(i, (entry, joint))| {
        entry.pitch.as_ref()?;
        let pitch = &joint.frame.pitch;
        let turn = Expr::from(2) * Expr::pi();
        // The lead is what screws are made to.
        let lead = Expr::from_f64((pitch * &turn).to_f64()).ok()?;
        let lead = doubt(&pitch.scaled_as_written(lead, turn.to_f64()))?;
        let message = format!(
            "the pitch {pitch} of joint \"{}\" is a decimal close to that of a simple lead; write lead = \"{}\" instead if that is intended",
            joint.id,
            lead.simple()?
        );
        let path = DocumentPath::root("joint").index(i).key("pitch");
        Some((path, message.into()))
    });
    couplings.chain(screws).collect()
}

/// Joints named of a list.
const SHOWN: usize = 8;

/// A guessed direction of an option at a joint: the direction, what it is taken along, and the key that would set it.
type Guess = (&'static str, &'static str, &'static str);

/// Lists each option with guessed directions once, with the joints where it has them.
pub(crate) fn guessed(file: &MechanismFile, m: &Mechanism) -> Found {
    let mut found: Vec<(DocumentPath, String, Guess, Vec<&str>)> = Vec::new();
    for (i, (entry, joint)) in file.joint.iter().zip(&m.joints).enumerate() {
        let (list, at) = match &entry.options {
            Some(list) => (list, DocumentPath::root("joint").index(i)),
            None => (&file.search.options, DocumentPath::root("search")),
        };
        for (n, item) in list.iter().enumerate() {
            let path = at.key("options").index(n);
            let Some((name, guess)) = of_option(&item.table(), entry, joint) else {
                continue;
            };
            let same = found.iter_mut().find(|f| f.0 == path && f.2 == guess);
            match same {
                Some(same) => same.3.push(&joint.id),
                None => found.push((path, name, guess, vec![&joint.id])),
            }
        }
    }
    let told = found.into_iter().map(|(path, option, guess, joints)| {
        let (what, along, key) = guess;
        let joints = first_of(&joints, SHOWN);
        let message = format!(
            "the {what} of option \"{option}\" is not given and is taken along {along} at {joints}; write a table with `{key}` if another is intended: {{ type = \"{option}\", {key} = [...] }}"
        );
        (path, message.into())
    });
    told.collect()
}

/// Returns the name of an option of a joint and its guessed direction there, or `None` if nothing is guessed.
fn of_option(table: &OptionTable, entry: &JointEntry, joint: &Joint) -> Option<(String, Guess)> {
    let kind = table.kind.as_deref()?;
    let option = JointType::from_name(kind)?;
    let name = table.name.as_deref().unwrap_or(option.name());
    if !joint.options.iter().skip(1).any(|o| o.name == name) {
        return None;
    }
    let present = &joint.joint_type;
    let line = match present {
        JointType::Slotted => "the pin",
        JointType::Spherical => "z",
        JointType::Universal => "the first pin",
        _ => "the joint's own axis",
    };
    let ball = *present == JointType::Spherical && entry.axis.is_none();
    let guess = match option {
        JointType::CylinderOnPlane | JointType::SphereOnPlane
            if table.axis.is_none() && !faces(present) =>
        {
            ("normal of the plane", line, "axis")
        }
        JointType::SphereInCylinder if table.axis.is_none() && ball => ("tube", line, "axis"),
        JointType::Slotted | JointType::CylinderOnPlane
            if table.reference.is_none() && entry.reference.is_none() =>
        {
            let what = if option == JointType::Slotted {
                "slot"
            } else {
                "axis of the roller"
            };
            let line = if table.axis.is_some() {
                "the reference of the joint"
            } else {
                "the first of the axes x, y, z that is not along the axis"
            };
            (what, line, "reference")
        }
        _ => return None,
    };
    Some((name.to_owned(), guess))
}

/// Returns true if the axis of a type is the normal of a plane.
fn faces(of: &JointType) -> bool {
    matches!(
        of,
        JointType::Planar | JointType::CylinderOnPlane | JointType::SphereOnPlane
    )
}
