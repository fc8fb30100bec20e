//! Physical data of links in robot formats, and omissions of these formats.

use crate::model::loads::Inertia;
use crate::model::mechanism::Mode;
use crate::robots::mechanism::series_of_single_joints::escape_comment;
use crate::robots::prelude::*;

/// The inertial data of a link: kg, m, kg·m².
pub(crate) struct Inertial {
    pub(in crate::robots) mass: f64,
    /// From the origin asked for.
    pub(in crate::robots) centre: Vector,
    /// xx, yy, zz, xy, xz, yz about the centre, in global axes.
    pub(in crate::robots) tensor: [f64; 6],
}

/// Returns the inertial data of a link whose mass the file gives, with its centre relative to an origin in metres.
pub(crate) fn link_inertial(m: &Mechanism, link: LinkId, origin: Vector) -> Option<Inertial> {
    let p = m.links[link].mass.as_ref()?;
    let tensor = match p.inertia {
        None => [0.0; 6],
        // The comment on planar models mentions the plane's normal.
        Some(Inertia::Plane(i)) => [i, i, i, 0.0, 0.0, 0.0],
        Some(Inertia::Principal([x, y, z])) => [x, y, z, 0.0, 0.0, 0.0],
        Some(Inertia::Tensor([xx, yy, zz, xy, yz, zx])) => [xx, yy, zz, xy, zx, yz],
    };
    let centre = to_vector(&p.centre).map(|c| c * m.length_unit.metres);
    Some(Inertial {
        mass: p.mass,
        centre: sub(centre, origin),
        tensor,
    })
}

/// The note on links without a mass in the mechanism.
pub(crate) const GRAM: &str =
    "links without a mass get 1 g, because engines reject massless moving bodies";

/// Returns the same for a link that moves, which engines reject without mass or inertia; 1 g if the file gives none.
pub(crate) fn moving_inertial(m: &Mechanism, link: LinkId, origin: Vector) -> Inertial {
    let found = link_inertial(m, link, origin).filter(|i| i.mass > 0.0);
    let mut out = found.unwrap_or(Inertial {
        mass: 1e-3,
        centre: [0.0; 3],
        tensor: [0.0; 6],
    });
    if out.tensor[..3].iter().any(|x| *x <= 0.0) {
        out.tensor = [1e-6, 1e-6, 1e-6, 0.0, 0.0, 0.0];
    }
    out
}

/// Returns comments for the head of a robot description: those of the mechanism, and notes on the conversion.
pub(crate) fn write_head(m: &Mechanism, indent: &str, told: &[String]) -> String {
    let own = Some(&m.description).filter(|d| !d.is_empty());
    let plain = |s: &String| s.replace(|c: char| c.is_control(), " ");
    let lines = own.into_iter().chain(told).map(plain);
    lines
        .map(|t| format!("{indent}<!-- {} -->\n", escape_comment(&t)))
        .collect()
}

/// Returns the omissions of a robot description of the free state, a sentence each.
pub(crate) fn left_out(m: &Mechanism) -> Vec<String> {
    let mut out = Vec::new();
    if let Mode::Planar { .. } = m.mode {
        let what = "a planar model: its figures count 3 constraints per loop, those of this file 6";
        out.push(what.to_owned());
    }
    let others = m.joint_ids().filter(|&j| !m.joints[j].is_in(StateId::FREE));
    let others = others.map(|j| m.joints[j].id.as_str()).join(", ");
    if !others.is_empty() {
        out.push(format!("omitted (not in the free state): {others}"));
    }
    let plane = |l: &crate::model::mechanism::Link| {
        let inertia = l.mass.as_ref().and_then(|p| p.inertia);
        matches!(inertia, Some(Inertia::Plane(_)))
    };
    if m.links.iter().any(plane) {
        out.push("inertias about the plane's normal are used for all three axes".to_owned());
    }
    let loads = &m.loads;
    let loaded = !loads.forces.is_empty() || !loads.moments.is_empty();
    let driven = loads.stroke.is_some() || !loads.drive_speeds.is_empty();
    let searched = m.joints.iter().any(|j| j.options.len() > 1);
    let told = [
        (loaded, "forces"),
        (loads.gravity.is_some(), "gravity"),
        (driven, "strokes and speeds"),
        (loads.grip.is_some(), "the gripper's data"),
        (loads.drive.is_some(), "the drive's data"),
        (searched, "search options"),
    ];
    let told = told.iter().filter(|t| t.0).map(|t| t.1).join(", ");
    if !told.is_empty() {
        out.push(format!("omitted (this format cannot represent it): {told}"));
    }
    out
}

/// An inserted link, in kg and kg·m²: light, and like a ball, which every engine accepts. sdformat drops links of 1e-6 kg.
pub(crate) const LIGHT_URDF: &str = "<inertial><mass value=\"1e-5\"/><inertia ixx=\"1e-9\" ixy=\"0\" ixz=\"0\" iyy=\"1e-9\" iyz=\"0\" izz=\"1e-9\"/></inertial>";
/// The same in SDF.
pub(crate) const LIGHT_SDF: &str = "<inertial><mass>1e-5</mass><inertia><ixx>1e-9</ixx><iyy>1e-9</iyy><izz>1e-9</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>";
/// The same in MJCF, but for its position.
pub(crate) const LIGHT_MJCF: &str = "mass=\"1e-5\" diaginertia=\"1e-9 1e-9 1e-9\"";
