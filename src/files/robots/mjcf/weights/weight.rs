//! Masses with their tensors of inertia, their sums, and the settings of an MJCF file for them.

use crate::geom::rigid::RigidMotion;
use crate::geom::vector::{Vector, add, dot, length, scale, sub};
use crate::robots::mjcf::context::{Compiler, Lookup, read_compiler};
use crate::robots::warning::Read;
use crate::robots::xml::element::Element;
use std::f64::consts::PI;

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
    /// A weight of zero.
    pub(super) const NOTHING: Weight = Weight {
        mass: 0.0,
        place: RigidMotion::IDENTITY,
        tensor: [0.0; 6],
    };
}

/// Returns a tensor as a matrix, by rows.
fn tensor_matrix([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> [Vector; 3] {
    [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
}

/// Returns a tensor in the axes that a place has, seen from outside.
fn rotate_tensor(tensor: [f64; 6], place: &RigidMotion) -> [f64; 6] {
    let r = &place.rotation;
    let half = r.map(|row| {
        let m = tensor_matrix(tensor);
        [0, 1, 2].map(|j| dot(row, m.map(|line| line[j])))
    });
    let at = |i: usize, j: usize| dot(half[i], r[j]);
    [at(0, 0), at(1, 1), at(2, 2), at(0, 1), at(0, 2), at(1, 2)]
}

/// Combines several weights into one, in the axes of their common frame. `None` if there is no mass.
pub(super) fn combine(all: &[Weight]) -> Option<Weight> {
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
        let own = rotate_tensor(w.tensor, &w.place);
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
    let place = RigidMotion::from_translation(centre);
    Some(Weight {
        mass,
        place,
        tensor,
    })
}

/// The settings of `<compiler>` for weights.
pub(super) struct Settings {
    pub(super) compiler: Compiler,
    /// Minimum mass and moment of inertia of a body.
    pub(super) least: [f64; 2],
    /// Whether an impossible tensor is replaced by that of a ball.
    pub(super) balance: bool,
    /// Whether shapes define the weights of bodies. `None` if they do so for bodies without `<inertial>` only.
    pub(super) from_shapes: Option<bool>,
    /// The groups of shapes that have weight, from the first to the last.
    pub(super) groups: [f64; 2],
}

impl Settings {
    /// Returns the settings of a file.
    pub(super) fn read_settings(root: Element<'_>) -> Read<Settings> {
        let mut out = Settings {
            compiler: read_compiler(root)?,
            least: [0.0; 2],
            balance: false,
            from_shapes: None,
            groups: [0.0, 5.0],
        };
        for c in root.children_named("compiler") {
            out.balance |= c.attribute("balanceinertia") == Some("true");
            for (x, key) in out.least.iter_mut().zip(["boundmass", "boundinertia"]) {
                *x = c.read_numbers::<1>(key)?.map_or(*x, |[x]| x);
            }
            match c.attribute("inertiafromgeom") {
                Some("true") => out.from_shapes = Some(true),
                Some("false") => out.from_shapes = Some(false),
                _ => {}
            }
            out.groups = c
                .read_numbers::<2>("inertiagrouprange")?
                .unwrap_or(out.groups);
        }
        Ok(out)
    }

    /// Returns a weight that is at least the minimum of the file.
    pub(super) fn bound_weight(&self, weight: Weight) -> Weight {
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

/// Default density in kg/m³.
const WATER: f64 = 1000.0;

/// Returns the numbers of `size`; 0 for missing ones.
fn read_sizes(look: &Lookup<'_>) -> Read<[f64; 3]> {
    let Some((e, text)) = look.attribute("size") else {
        return Ok([0.0; 3]);
    };
    let mut out = [0.0; 3];
    match text.split_whitespace().count() {
        0 => {}
        1 => out[..1].copy_from_slice(&e.read_numbers::<1>("size")?.unwrap_or_default()),
        2 => out[..2].copy_from_slice(&e.read_numbers::<2>("size")?.unwrap_or_default()),
        _ => out = e.read_numbers::<3>("size")?.unwrap_or_default(),
    }
    Ok(out)
}

/// The size of a shape and its place.
struct Measures {
    /// The numbers of `size`; 0 for missing ones.
    sizes: [f64; 3],
    /// Half the length of a round shape.
    half: f64,
    /// Half the depth and half the length of a shape with three sizes.
    deep: f64,
    long: f64,
    place: RigidMotion,
}

impl Measures {
    /// Returns the sizes of a shape.
    fn read_measures(look: &Lookup<'_>, compiler: &Compiler) -> Read<Measures> {
        let sizes = read_sizes(look)?;
        let mut out = Measures {
            sizes,
            half: sizes[1],
            deep: sizes[1],
            long: sizes[2],
            place: RigidMotion {
                translation: look.vector("pos", [0.0; 3])?,
                ..read_orientation(look, compiler)?
            },
        };
        // A shape between two points is round, or as deep as it is wide, and as long as their distance.
        if let Some([a, b, c, d, f, g]) = look.numbers::<6>("fromto")? {
            let (from, to) = ([a, b, c], [d, f, g]);
            out.half = length(sub(to, from)) / 2.0;
            (out.deep, out.long) = (sizes[0], out.half);
            out.place = RigidMotion {
                translation: scale(add(from, to), 0.5),
                ..RigidMotion::z_to(sub(from, to))
            };
        }
        Ok(out)
    }
}

/// Returns the weight of a shape on its body or frame, if it has weight.
pub(super) fn weight_of_shape(look: &Lookup<'_>, settings: &Settings) -> Read<Option<Weight>> {
    let measures = Measures::read_measures(look, &settings.compiler)?;
    let [group] = look.numbers::<1>("group")?.unwrap_or_default();
    let stated = look.numbers::<1>("mass")?.map(|[m]| m);
    let [density] = look.numbers::<1>("density")?.unwrap_or([WATER]);
    if group < settings.groups[0] || group > settings.groups[1] {
        return Ok(None);
    }
    let kind = match look.attribute("type") {
        Some((_, word)) => word,
        None if look.attribute("mesh").is_some() => "mesh",
        None => "sphere",
    };
    let Some((volume, moments)) = volume_and_moments(kind, &measures) else {
        return Ok(None);
    };
    let mass = stated.unwrap_or(density * volume);
    let [x, y, z] = moments.map(|m| m * mass);
    let weight = Weight {
        mass,
        place: measures.place,
        tensor: [x, y, z, 0.0, 0.0, 0.0],
    };
    Ok(Some(weight).filter(|w| w.mass > 0.0))
}

/// Returns the rotation of an element or of its class, given in one of five forms.
fn read_orientation(look: &Lookup<'_>, compiler: &Compiler) -> Read<RigidMotion> {
    let ways = ["quat", "axisangle", "xyaxes", "zaxis", "euler"];
    match ways.iter().find_map(|w| look.attribute(w)) {
        Some((e, _)) => compiler.read_rotation(e),
        None => Ok(RigidMotion::IDENTITY),
    }
}

/// Returns the volume in m³ of a shape, and its moments of inertia about x, y and z with an even mass of 1 kg. Returns `None` for a
/// plane, which is infinite, and for a mesh or another kind, whose file is not read.
fn volume_and_moments(kind: &str, measures: &Measures) -> Option<(f64, Vector)> {
    let &Measures { deep, long, .. } = measures;
    let (r, l) = (measures.sizes[0], 2.0 * measures.half);
    // The moments of a cylinder, across its axis and along it.
    let (across, along) = ((3.0 * r * r + l * l) / 12.0, r * r / 2.0);
    let (ball, middle) = (4.0 / 3.0 * PI * r.powi(3), PI * r * r * l);
    let block = |share: f64| {
        let [a, b, c] = [r * r, deep * deep, long * long];
        [b + c, a + c, a + b].map(|sum| sum * share)
    };
    Some(match kind {
        "box" => (8.0 * r * deep * long, block(1.0 / 3.0)),
        "ellipsoid" => (4.0 / 3.0 * PI * r * deep * long, block(0.2)),
        "sphere" => (ball, [0.4 * r * r; 3]),
        "cylinder" => (middle, [across, across, along]),
        "capsule" => {
            let whole = ball + middle;
            let (e, m) = (ball / whole, middle / whole);
            // Half balls, each about the end of the cylinder.
            let far = 0.4 * r * r + l * l / 4.0 + 3.0 * l * r / 8.0;
            let across = m * across + e * far;
            (whole, [across, across, m * along + e * 0.4 * r * r])
        }
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::vector::{X, Z};

    // Two points of 1 kg on x, a metre apart, each in its own axes: together they have inertia about y and z only.
    #[test]
    fn weights_add_up() {
        let end = |x: f64| Weight {
            mass: 1.0,
            place: RigidMotion::from_translation([x, 0.0, 0.0]).then(&RigidMotion::from_turn(Z, x)),
            tensor: [0.0; 6],
        };
        let whole = combine(&[end(0.0), end(1.0)]);
        let found = whole.map(|w| (w.mass, w.place.translation, w.tensor));
        let tensor = [0.0, 0.5, 0.5, 0.0, 0.0, 0.0];
        assert_eq!(found, Some((2.0, [0.5, 0.0, 0.0], tensor)));
        let quarter = RigidMotion::from_turn(X, std::f64::consts::FRAC_PI_2);
        let turned = rotate_tensor([1.0, 2.0, 3.0, 0.0, 0.0, 0.0], &quarter);
        assert_eq!(turned, [1.0, 3.0, 2.0, 0.0, 0.0, 0.0]);
        assert_eq!(combine(&[]), None);
    }
}

#[cfg(test)]
mod tests_of_shape {
    use super::*;
    use crate::geom::vector::dot;

    /// Moments by adding up small cubes, all that the formulas are not.
    fn added_up(inside: impl Fn(Vector) -> bool) -> (f64, Vector) {
        const N: i32 = 120;
        let step = 2.0 / f64::from(N);
        let (mut volume, mut moments) = (0.0, [0.0; 3]);
        for i in 0..N * N * N {
            let at = [i % N, i / N % N, i / N / N];
            let [x, y, z] = at.map(|k| -1.0 + step * (f64::from(k) + 0.5));
            if inside([x, y, z]) {
                volume += step.powi(3);
                for (m, d) in moments
                    .iter_mut()
                    .zip([y * y + z * z, x * x + z * z, x * x + y * y])
                {
                    *m += step.powi(3) * d;
                }
            }
        }
        (volume, moments.map(|m| m / volume))
    }

    #[test]
    fn solids_weigh_what_small_cubes_do() {
        let (r, l) = (0.4, 0.9);
        let round = |kind: &'static str, r, l: f64| (kind, [r, 0.0, 0.0], l / 2.0);
        for ((kind, sizes, half), inside) in [
            (
                ("box", [0.4, 0.6, 0.8], 0.0),
                Box::new(|[x, y, z]: Vector| x.abs() < 0.4 && y.abs() < 0.6 && z.abs() < 0.8)
                    as Box<dyn Fn(Vector) -> bool>,
            ),
            (round("sphere", 0.7, 0.0), Box::new(|p| dot(p, p) < 0.49)),
            (
                round("cylinder", r, l),
                Box::new(move |[x, y, z]| x * x + y * y < r * r && z.abs() < l / 2.0),
            ),
            (
                round("capsule", r, l),
                Box::new(move |[x, y, z]| {
                    let past = (z.abs() - l / 2.0).max(0.0);
                    x * x + y * y + past * past < r * r
                }),
            ),
            (
                ("ellipsoid", [0.5, 0.7, 0.9], 0.0),
                Box::new(|[x, y, z]| {
                    (x / 0.5).powi(2) + (y / 0.7).powi(2) + (z / 0.9).powi(2) < 1.0
                }),
            ),
        ] {
            let measures = Measures {
                sizes,
                half,
                deep: sizes[1],
                long: sizes[2],
                place: RigidMotion::IDENTITY,
            };
            let (volume, moments) = volume_and_moments(kind, &measures).unwrap();
            let (slow, added) = added_up(inside);
            assert!(
                (volume / slow - 1.0).abs() < 0.02,
                "{kind}: {volume} {slow}"
            );
            for (m, a) in moments.iter().zip(added) {
                assert!((m / a - 1.0).abs() < 0.03, "{kind}: {m} {a}");
            }
        }
    }
}
