//! Mechanisms with their geometry changed.

use crate::geom::expr::Expr;
use crate::geom::rigid::RigidMotion;
use crate::geom::vector::to_vector;
use crate::model::mechanism::{JointId, Mechanism, Mode};
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use num_bigint::BigInt;
use num_rational::BigRational;

/// Returns 10^e, exactly.
pub(crate) fn power_of_ten(e: i32) -> Expr {
    Expr::rational(BigRational::from_integer(BigInt::from(10)).pow(e))
}

/// Returns a copy without the data that only a search needs.
fn without_options(mechanism: &Mechanism) -> Mechanism {
    let mut m = mechanism.clone();
    for joint in &mut m.edit().joints {
        joint.options.clear();
        joint.unloading.clear();
    }
    m
}

/// Returns a copy with every length multiplied by 10^e, exactly.
pub(crate) fn resize(mechanism: &Mechanism, e: i32) -> Mechanism {
    let mut m = without_options(mechanism);
    let factor = power_of_ten(e);
    for joint in &mut m.edit().joints {
        let lengths = joint.frame.point.iter_mut().chain([&mut joint.frame.pitch]);
        lengths.for_each(|x| *x = &*x * &factor);
    }
    m
}

/// The joint, whether its axis is tilted instead of its point moved, and the coordinate.
pub(crate) type Place = (usize, bool, usize);

/// Returns a copy in which one coordinate is larger by 10^e, exactly.
pub(crate) fn displace_joint(mechanism: &Mechanism, place: Place, e: i32) -> Mechanism {
    let mut m = mechanism.clone();
    let mut parts = m.edit();
    let (joint, axis, coordinate) = place;
    let frame = &mut parts.joints[JointId::new(joint)].frame;
    let vector = if axis {
        &mut frame.axis
    } else {
        &mut frame.point
    };
    vector[coordinate] = &vector[coordinate] + &power_of_ten(e);
    drop(parts);
    m
}

/// Returns a copy in which the points are stretched along each coordinate axis, by up to a share of their coordinates. Options
/// and ranking are unchanged.
pub(crate) fn stretch(mechanism: &Mechanism, by: f64, noise: &mut Noise) -> Mechanism {
    let mut m = mechanism.clone();
    let mut factor = || (1e6 * (1.0 + by * noise.draw_uniform())) as i64;
    let factors = [(); 3].map(|()| &Expr::from(factor()) * &power_of_ten(-6));
    for joint in &mut m.edit().joints {
        let offered = joint.options.iter_mut().chain(&mut joint.unloading);
        let offered = offered.map(|option| &mut option.frame);
        for frame in offered.chain([&mut joint.frame]) {
            let points = frame.point.iter_mut().zip(&factors);
            points.for_each(|(x, factor)| *x = &*x * factor);
        }
    }
    m
}

/// Returns a copy in which every decimal is exact, as a fraction is.
pub(crate) fn with_exact_decimals(mechanism: &Mechanism) -> Mechanism {
    let mut m = without_options(mechanism);
    for joint in &mut m.edit().joints {
        let frame = &mut joint.frame;
        for x in frame.point.iter_mut().chain(&mut frame.axis) {
            *x = x.as_rational().map_or_else(|| x.clone(), Expr::rational);
        }
    }
    m
}

/// Noise that is the same for the same seed on every machine.
#[derive(Debug)]
pub struct Noise(ChaCha8Rng);

impl Noise {
    /// Creates the noise of a seed, for the `n`th mechanism.
    pub fn new(seed: u64, n: usize) -> Noise {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(n as u64);
        Noise(random)
    }

    /// Returns a uniform random number in [-1, 1].
    pub fn draw_uniform(&mut self) -> f64 {
        f64::from(self.0.next_u32()) / f64::from(u32::MAX) * 2.0 - 1.0
    }

    /// Draws an integer of up to `bits` bits, at most 63.
    pub(crate) fn draw_integer(&mut self, bits: u32) -> i64 {
        (self.0.next_u64() >> (64 - bits.min(63))).cast_signed()
    }
}

/// Returns the mechanism turned at random, a planar one about the normal of its plane, and with every number rounded to the given
/// decimals.
pub fn turned_and_rounded(mechanism: &Mechanism, decimals: usize, noise: &mut Noise) -> Mechanism {
    let mut m = without_options(mechanism);
    let angle = std::f64::consts::PI * noise.draw_uniform();
    let spatial = matches!(m.mode, Mode::Spatial);
    let axis = match &m.mode {
        Mode::Spatial => [(); 3].map(|()| noise.draw_uniform()),
        Mode::Planar { normal } => to_vector(normal),
    };
    let turn = RigidMotion::from_turn(axis, angle);
    let round = |x: f64| {
        let text = format!("{x:.decimals$}");
        text.parse().unwrap_or_else(|_| Expr::from(0))
    };
    for joint in &mut m.edit().joints {
        let frame = &mut joint.frame;
        frame.point = turn.map_direction(to_vector(&frame.point)).map(round);
        // In a plane joints must stay square to it.
        if spatial {
            frame.axis = turn.map_direction(to_vector(&frame.axis)).map(round);
            frame.reference = turn.map_direction(to_vector(&frame.reference)).map(round);
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
        assert!((x(&resize(&m, -6)) - 40e-6).abs() < 1e-20);
        let drawn = |seed| Noise::new(seed, 0).draw_integer(61);
        assert!(drawn(1) < 1 << 61 && drawn(1) == drawn(1) && drawn(1) != drawn(2));
    }
}
