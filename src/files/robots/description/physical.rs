//! Physical data of links in robot formats, and omissions of these formats.

use crate::geom::vector::{Vector, sub, to_vector};
use crate::model::loads::Inertia;
use crate::model::mechanism::{LinkId, Mechanism, Mode, StateId};
use crate::robots::mechanism::series_of_single_joints::{escape_comment, format_numbers};
use crate::robots::xml::Document;
use itertools::Itertools;

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

/// Maximum of the mass, and of the moment of inertia about every axis. A link of the robot with less than a thousand times as much lowers
/// it.
const MOST: [f64; 2] = [1e-4, 1e-7];
/// Minimum of both: sdformat treats a mass of 1e-6 as none and drops the link, and MuJoCo treats 1e-15 as zero.
const LEAST: [f64; 2] = [1e-5, 1e-12];
/// A mass below this fraction of the heaviest is treated as a placeholder in the file.
const STAND_IN: f64 = 1e-4;

/// The weight of an inserted link, in kg, and in kg·m² about every axis, like a ball, which every engine accepts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Light {
    mass: f64,
    inertia: f64,
}

impl Light {
    /// Returns a light body for the existing masses and moments of inertia.
    fn light_beside(masses: &[f64], inertias: &[f64]) -> Light {
        let small = |all: &[f64], which: usize| {
            let most = all.iter().copied().fold(0.0, f64::max);
            let own = all.iter().copied().filter(|x| *x > STAND_IN * most);
            let least = own.fold(f64::INFINITY, f64::min);
            // A power of ten is easy to read, and cannot be mistaken for a measured mass.
            let thousandth = format!("1e{}", (least / 1000.0).log10().floor());
            let thousandth = thousandth.parse().unwrap_or(MOST[which]);
            thousandth.clamp(LEAST[which], MOST[which])
        };
        Light {
            mass: small(masses, 0),
            inertia: small(inertias, 1),
        }
    }

    /// Returns a light body for the masses in a description of any format.
    pub(crate) fn in_description(document: &Document) -> Light {
        let (mut masses, mut inertias) = (Vec::new(), Vec::new());
        for e in (0..document.nodes.len()).map(|id| document.element(id)) {
            let numbers = |text: &str| -> Vec<f64> {
                let words = text.split_whitespace();
                words.filter_map(|w| w.parse().ok()).collect()
            };
            let attribute = |key: &str| e.attribute(key).map_or(Vec::new(), numbers);
            match e.name() {
                "inertial" | "geom" => {
                    masses.extend(attribute("mass"));
                    let principal = ["diaginertia", "fullinertia"].into_iter();
                    inertias.extend(principal.flat_map(|k| attribute(k).into_iter().take(3)));
                }
                "mass" => masses.extend(attribute("value").into_iter().chain(numbers(e.text()))),
                "inertia" => {
                    inertias.extend(["ixx", "iyy", "izz"].into_iter().flat_map(attribute));
                }
                "ixx" | "iyy" | "izz" => inertias.extend(numbers(e.text())),
                _ => {}
            }
        }
        Light::light_beside(&masses, &inertias)
    }

    /// Returns a light body for the masses of the links of a mechanism.
    pub(crate) fn in_mechanism(m: &Mechanism) -> Light {
        let all = m.links.iter().filter_map(|l| l.mass.as_ref());
        let masses: Vec<f64> = all.clone().map(|p| p.mass).collect();
        let inertias = all.filter_map(|p| p.inertia).flat_map(|i| match i {
            Inertia::Plane(i) => vec![i],
            Inertia::Principal(all) => all.to_vec(),
            Inertia::Tensor(all) => all[..3].to_vec(),
        });
        Light::light_beside(&masses, &inertias.collect::<Vec<f64>>())
    }

    /// Writes it as MJCF, with its centre at a place in its body.
    pub(crate) fn write_mjcf(self, at: Vector) -> String {
        let Light { mass, inertia: i } = self;
        let at = format_numbers(at);
        format!("<inertial pos=\"{at}\" mass=\"{mass:e}\" diaginertia=\"{i:e} {i:e} {i:e}\"/>")
    }

    /// Writes it as URDF.
    pub(crate) fn write_urdf(self) -> String {
        let Light { mass, inertia: i } = self;
        format!(
            "<inertial><mass value=\"{mass:e}\"/><inertia ixx=\"{i:e}\" ixy=\"0\" ixz=\"0\" iyy=\"{i:e}\" iyz=\"0\" izz=\"{i:e}\"/></inertial>"
        )
    }

    /// Writes it as SDF.
    pub(crate) fn write_sdf(self) -> String {
        let Light { mass, inertia: i } = self;
        format!(
            "<inertial><mass>{mass:e}</mass><inertia><ixx>{i:e}</ixx><iyy>{i:e}</iyy><izz>{i:e}</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::Light;

    #[test]
    fn is_small_beside_what_is_there() {
        let of = |masses: &[f64], inertias: &[f64]| {
            let Light { mass, inertia } = Light::light_beside(masses, inertias);
            [mass, inertia]
        };
        assert_eq!(of(&[], &[]), [1e-4, 1e-7]);
        assert_eq!(of(&[12.0, 0.0], &[1.0]), [1e-4, 1e-7]);
        assert_eq!(of(&[0.02, 3.0], &[4e-6, 0.01]), [1e-5, 1e-9]);
        assert_eq!(of(&[1e-30], &[1e-30]), [1e-5, 1e-12]);
        assert_eq!(of(&[2.0, 1e-9], &[1.0, 1e-12]), [1e-4, 1e-7]);
    }
}
