//! Mechanisms with their geometry changed.

use crate::geom::expr::Expr;
use crate::geom::extent::diagonal;
use crate::geom::rigid::RigidMotion;
use crate::geom::vector::real;
use crate::model::mechanism::{Mechanism, Mode};
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use num_bigint::BigInt;
use num_rational::BigRational;

/// 10^e, exactly.
#[must_use]
pub(crate) fn power_of_ten(e: i32) -> Expr {
    Expr::rational(BigRational::from_integer(BigInt::from(10)).pow(e))
}

/// A copy without what only a search needs.
fn bare(mechanism: &Mechanism) -> Mechanism {
    let mut m = mechanism.clone();
    for joint in &mut m.joints {
        joint.options.clear();
        joint.unloading.clear();
    }
    m
}

/// Every length multiplied by 10^e, exactly.
#[must_use]
pub(crate) fn resized(mechanism: &Mechanism, e: i32) -> Mechanism {
    let mut m = bare(mechanism);
    let factor = power_of_ten(e);
    for joint in &mut m.joints {
        let lengths = joint.frame.point.iter_mut().chain([&mut joint.frame.pitch]);
        lengths.for_each(|x| *x = &*x * &factor);
    }
    m
}

/// Half the diagonal of the box round all joints; 0 where they are all in one place.
#[must_use]
pub(crate) fn size(mechanism: &Mechanism) -> f64 {
    diagonal(mechanism.joints.iter().map(|j| real(&j.frame.point))) / 2.0
}

/// Noise that is the same for the same seed on every machine.
#[derive(Debug)]
pub struct Noise(ChaCha8Rng);

impl Noise {
    /// The noise of a seed, for the `n`th mechanism.
    #[must_use]
    pub fn new(seed: u64, n: usize) -> Noise {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(n as u64);
        Noise(random)
    }

    /// Uniform in [-1, 1].
    pub fn uniform(&mut self) -> f64 {
        f64::from(self.0.next_u32()) / f64::from(u32::MAX) * 2.0 - 1.0
    }

    fn shake(&mut self, vector: &mut [Expr; 3], by: f64) {
        for x in vector {
            // What is not finite stays as it is; a double always is.
            if let Ok(shaken) = Expr::from_f64(x.to_f64() + by * self.uniform()) {
                *x = shaken;
            }
        }
    }
}

/// Every coordinate as a double with uniform noise: points by `level` times the mechanism's size, axes by `level` times
/// their length, so that coordinates that are zero move as well. Joints that are all in one place stay there. In planar mode points alone, for joints stay square to
/// the plane there.
#[must_use]
pub(crate) fn shaken(mechanism: &Mechanism, level: f64, noise: &mut Noise) -> Mechanism {
    let mut m = bare(mechanism);
    let size = size(mechanism);
    let spatial = matches!(m.mode, Mode::Spatial);
    let length = |v: &[Expr; 3]| v.iter().map(|x| x.to_f64().powi(2)).sum::<f64>().sqrt();
    for joint in &mut m.joints {
        let frame = &mut joint.frame;
        noise.shake(&mut frame.point, level * size);
        if spatial {
            let by = level * length(&frame.axis);
            noise.shake(&mut frame.axis, by);
            let by = level * length(&frame.reference);
            noise.shake(&mut frame.reference, by);
        }
    }
    m
}

/// The mechanism as a person would write it who drew it askew: turned, the plane of a planar one about its normal, and
/// every number rounded to so many decimals.
#[must_use]
pub fn turned_and_rounded(mechanism: &Mechanism, decimals: usize, noise: &mut Noise) -> Mechanism {
    let mut m = bare(mechanism);
    let angle = std::f64::consts::PI * noise.uniform();
    let spatial = matches!(m.mode, Mode::Spatial);
    let axis = match &m.mode {
        Mode::Spatial => [(); 3].map(|()| noise.uniform()),
        Mode::Planar { normal } => real(normal),
    };
    let turn = RigidMotion::turn(axis, angle);
    let round = |x: f64| {
        let text = format!("{x:.decimals$}");
        text.parse().unwrap_or_else(|_| Expr::from(0))
    };
    for joint in &mut m.joints {
        let frame = &mut joint.frame;
        frame.point = turn.direction(real(&frame.point)).map(round);
        // In a plane joints must stay square to it.
        if spatial {
            frame.axis = turn.direction(real(&frame.axis)).map(round);
            frame.reference = turn.direction(real(&frame.reference)).map(round);
        }
        frame.pitch = round(frame.pitch.to_f64());
    }
    m
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::text::mechanism_from_str;
    use ozols::builtin;

    #[test]
    fn changes_are_as_large_as_asked() {
        let text = builtin::text("bennett").expect("built in");
        let m = mechanism_from_str("bennett.toml", text).expect("valid");
        let x = |m: &Mechanism| m.joints[0].frame.point[0].to_f64();
        assert!((x(&resized(&m, -6)) - 40e-6).abs() < 1e-20);
        let moved = |seed| x(&shaken(&m, 1e-3, &mut Noise::new(seed, 0))) - x(&m);
        assert!(moved(1).abs() <= 1e-3 * size(&m) && moved(1) != 0.0);
        assert_eq!(moved(1).to_bits(), moved(1).to_bits());
        assert_ne!(moved(1).to_bits(), moved(2).to_bits());
    }
}
