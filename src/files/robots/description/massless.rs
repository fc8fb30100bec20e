//! Links between joints in series. Engines reject massless moving bodies, so these links get a mass that is negligible compared
//! with the others.

use crate::geom::vector::Vector;
use crate::model::loads::Inertia;
use crate::model::mechanism::Mechanism;
use crate::robots::mechanism::series_of_single_joints::numbers;
use crate::robots::xml::Document;

/// Mass, and moment of inertia about every axis, where nothing there weighs less than a thousand times as much.
const MOST: [f64; 2] = [1e-4, 1e-7];
/// The least: sdformat takes a mass of 1e-6 for none and drops the link, MuJoCo takes 1e-15 for nothing.
const LEAST: [f64; 2] = [1e-5, 1e-12];
/// A mass below this fraction of the heaviest is treated as a stand-in of the owner's.
const STAND_IN: f64 = 1e-4;

/// The weight of an inserted link, in kg, and in kg·m² about every axis, like a ball, which every engine accepts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Light {
    mass: f64,
    inertia: f64,
}

impl Light {
    /// Returns a light body for the existing masses and moments of inertia.
    fn beside(masses: &[f64], inertias: &[f64]) -> Light {
        let small = |all: &[f64], which: usize| {
            let most = all.iter().copied().fold(0.0, f64::max);
            let own = all.iter().copied().filter(|x| *x > STAND_IN * most);
            let least = own.fold(f64::INFINITY, f64::min);
            // A power of ten reads well, and nobody takes it for a measured mass.
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
        Light::beside(&masses, &inertias)
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
        Light::beside(&masses, &inertias.collect::<Vec<f64>>())
    }

    /// Writes it as MJCF, with its centre at a place in its body.
    pub(crate) fn mjcf(self, at: Vector) -> String {
        let Light { mass, inertia: i } = self;
        let at = numbers(at);
        format!("<inertial pos=\"{at}\" mass=\"{mass:e}\" diaginertia=\"{i:e} {i:e} {i:e}\"/>")
    }

    /// Writes it as URDF.
    pub(crate) fn urdf(self) -> String {
        let Light { mass, inertia: i } = self;
        format!(
            "<inertial><mass value=\"{mass:e}\"/><inertia ixx=\"{i:e}\" ixy=\"0\" ixz=\"0\" iyy=\"{i:e}\" iyz=\"0\" izz=\"{i:e}\"/></inertial>"
        )
    }

    /// Writes it as SDF.
    pub(crate) fn sdf(self) -> String {
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
            let Light { mass, inertia } = Light::beside(masses, inertias);
            [mass, inertia]
        };
        assert_eq!(of(&[], &[]), [1e-4, 1e-7]);
        assert_eq!(of(&[12.0, 0.0], &[1.0]), [1e-4, 1e-7]);
        assert_eq!(of(&[0.02, 3.0], &[4e-6, 0.01]), [1e-5, 1e-9]);
        assert_eq!(of(&[1e-30], &[1e-30]), [1e-5, 1e-12]);
        assert_eq!(of(&[2.0, 1e-9], &[1.0, 1e-12]), [1e-4, 1e-7]);
    }
}
