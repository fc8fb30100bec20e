//! Masses with their tensors of inertia, several as one, and what an MJCF file says of how bodies are weighed.

use crate::geom::rigid::RigidMotion;
use crate::geom::vector::{Vector, dot, sub};
use crate::robots::mjcf::context::{Compiler, compiler};
use crate::robots::problem::Read;
use crate::robots::xml::element::Element;

/// Mass in kg, and the tensor in kg·m².
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::robots::mjcf) struct Weight {
    pub(in crate::robots::mjcf) mass: f64,
    /// Place of the centre, with the axes that the tensor is given in.
    pub(in crate::robots::mjcf) place: RigidMotion,
    /// xx, yy, zz, xy, xz, yz about the centre.
    pub(in crate::robots::mjcf) tensor: [f64; 6],
}

impl Weight {
    /// What weighs nothing.
    pub(super) const NOTHING: Weight = Weight {
        mass: 0.0,
        place: RigidMotion::IDENTITY,
        tensor: [0.0; 6],
    };
}

/// Returns a tensor as a matrix, by rows.
fn matrix([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> [Vector; 3] {
    [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
}

/// Returns a tensor in the axes that a place has, seen from outside.
fn turned(tensor: [f64; 6], place: &RigidMotion) -> [f64; 6] {
    let r = &place.rotation;
    let half = r.map(|row| {
        let m = matrix(tensor);
        [0, 1, 2].map(|j| dot(row, m.map(|line| line[j])))
    });
    let at = |i: usize, j: usize| dot(half[i], r[j]);
    [at(0, 0), at(1, 1), at(2, 2), at(0, 1), at(0, 2), at(1, 2)]
}

/// Returns several weights as one, in the axes of the frame that they are given in; none of nothing.
pub(super) fn together(all: &[Weight]) -> Option<Weight> {
    let mass: f64 = all.iter().map(|w| w.mass).sum();
    if mass <= 0.0 {
        return None;
    }
    let mean = |i: usize| {
        all.iter()
            .map(|w| w.mass * w.place.translation[i])
            .sum::<f64>()
            / mass
    };
    let centre = [mean(0), mean(1), mean(2)];
    let mut tensor = [0.0; 6];
    for w in all {
        let [x, y, z] = sub(w.place.translation, centre);
        let own = turned(w.tensor, &w.place);
        let far = [
            y * y + z * z,
            x * x + z * z,
            x * x + y * y,
            -x * y,
            -x * z,
            -y * z,
        ];
        for (t, (o, f)) in tensor.iter_mut().zip(own.iter().zip(far)) {
            *t += o + w.mass * f;
        }
    }
    let place = RigidMotion::shift(centre);
    Some(Weight {
        mass,
        place,
        tensor,
    })
}

/// What `<compiler>` says of weights.
pub(super) struct Settings {
    pub(super) compiler: Compiler,
    /// The least mass and moment of inertia of a body.
    pub(super) least: [f64; 2],
    /// Whether a tensor that no body has becomes a ball's.
    pub(super) balance: bool,
    /// Whether shapes say what bodies weigh; where the file leaves it open, those of bodies without `<inertial>`.
    pub(super) from_shapes: Option<bool>,
    /// The groups of shapes that weigh anything, from the first to the last.
    pub(super) groups: [f64; 2],
}

impl Settings {
    /// Returns the settings of a file.
    pub(super) fn read(root: Element<'_>) -> Read<Settings> {
        let mut out = Settings {
            compiler: compiler(root)?,
            least: [0.0; 2],
            balance: false,
            from_shapes: None,
            groups: [0.0, 5.0],
        };
        for c in root.named("compiler") {
            out.balance |= c.attribute("balanceinertia") == Some("true");
            for (x, key) in out.least.iter_mut().zip(["boundmass", "boundinertia"]) {
                *x = c.numbers::<1>(key)?.map_or(*x, |[x]| x);
            }
            match c.attribute("inertiafromgeom") {
                Some("true") => out.from_shapes = Some(true),
                Some("false") => out.from_shapes = Some(false),
                _ => {}
            }
            out.groups = c.numbers::<2>("inertiagrouprange")?.unwrap_or(out.groups);
        }
        Ok(out)
    }

    /// Returns a weight that is no less than the file asks for.
    pub(super) fn bounded(&self, weight: Weight) -> Weight {
        let mut out = weight;
        let [mass, inertia] = self.least;
        out.mass = out.mass.max(mass);
        out.tensor[..3].iter_mut().for_each(|x| *x = x.max(inertia));
        let [x, y, z, ..] = out.tensor;
        if self.balance && (x + y < z || x + z < y || y + z < x) {
            out.tensor[..3].fill((x + y + z) / 3.0);
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::vector::{X, Z};

    // Two points of 1 kg on x, a metre apart, each in axes of its own: as one they resist about y and z alone.
    #[test]
    fn weights_add_up() {
        let end = |x: f64| Weight {
            mass: 1.0,
            place: RigidMotion::shift([x, 0.0, 0.0]).then(&RigidMotion::turn(Z, x)),
            tensor: [0.0; 6],
        };
        let whole = together(&[end(0.0), end(1.0)]);
        let found = whole.map(|w| (w.mass, w.place.translation, w.tensor));
        let tensor = [0.0, 0.5, 0.5, 0.0, 0.0, 0.0];
        assert_eq!(found, Some((2.0, [0.5, 0.0, 0.0], tensor)));
        let quarter = RigidMotion::turn(X, std::f64::consts::FRAC_PI_2);
        let turned = turned([1.0, 2.0, 3.0, 0.0, 0.0, 0.0], &quarter);
        assert_eq!(turned, [1.0, 3.0, 2.0, 0.0, 0.0, 0.0]);
        assert_eq!(together(&[]), None);
    }
}
