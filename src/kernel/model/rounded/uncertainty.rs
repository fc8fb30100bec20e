//! Accuracy of each number of a mechanism, from its last digit or a stated uncertainty.

use super::class::{NumberClass, NumberKind};
use crate::geom::expr::{End, Expr, WrittenNumber};
use crate::geom::vector::{self, to_vector};
use crate::model::mechanism::{Frame, Joint, Mechanism, Mode};

/// Half units of the numbers of a frame, in the file's own numbers; 0 if they are exact.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FrameUncertainty {
    /// Half units of its point, in the file's unit of length.
    pub point: [f64; 3],
    /// Half units of the components of its axis as written, of any length.
    pub axis: [f64; 3],
    /// Half units of the components of its reference.
    pub reference: [f64; 3],
    /// Half unit of its pitch, per radian.
    pub pitch: f64,
}

impl FrameUncertainty {
    /// Returns the half units of its point, axis and reference.
    #[must_use]
    pub fn vectors(&self) -> [[f64; 3]; 3] {
        [self.point, self.axis, self.reference]
    }
}

/// Half units of all numbers of a mechanism that may have been rounded, in the file's own numbers; 0 if they are exact.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Uncertainties {
    /// Half units of the frames, by joint.
    pub frames: Vec<FrameUncertainty>,
    /// Half units of the frames of the options, by joint, in the order of
    /// [`Joint::offered`](crate::model::mechanism::Joint::offered_options).
    pub option_frames: Vec<Vec<FrameUncertainty>>,
    /// Half units of the normal of the plane.
    pub normal: [f64; 3],
}

impl Uncertainties {
    /// Returns equal half units for all numbers of the joints: of lengths, and of directions of length 1.
    #[must_use]
    pub fn uniform(mechanism: &Mechanism, length: f64, direction: f64) -> Uncertainties {
        let of = |v: &[Expr; 3]| [direction * vector::length(to_vector(v)); 3];
        let frames = mechanism.joints.iter().map(|j| FrameUncertainty {
            point: [length; 3],
            axis: of(&j.frame.axis),
            reference: of(&j.frame.reference),
            pitch: 0.0,
        });
        Uncertainties {
            frames: frames.collect(),
            ..Uncertainties::default()
        }
    }

    /// Returns the largest half units of points, and of directions of length 1.
    #[must_use]
    pub fn largest_half_units(&self, mechanism: &Mechanism) -> [f64; 2] {
        let most = |v: &[f64; 3]| v.iter().copied().fold(0.0, f64::max);
        let frames = mechanism.joints.iter().map(|j| &j.frame);
        let directions = frames
            .zip(&self.frames)
            .flat_map(|(f, half)| [(&f.axis, &half.axis), (&f.reference, &half.reference)]);
        let directions = directions.map(|(v, h)| most(h) / vector::length(to_vector(v)));
        let points = self.frames.iter().map(|half| most(&half.point));
        [points.fold(0.0, f64::max), directions.fold(0.0, f64::max)]
    }
}

/// Conclusions from all numbers of a mechanism together.
struct Reading {
    lengths: NumberClass,
    directions: NumberClass,
    /// Whether the file is rotated in space: most axes of its joints are decimals.
    turned: bool,
}

/// Returns the half units of all numbers, or `None` if nothing looks rounded and no uncertainty is stated.
///
/// A number is accurate to half a unit of its last digit, including trailing zeros. A stated uncertainty has priority.
/// Expressions are exact. At least one decimal of a file must be long, otherwise all decimals are taken exactly as
/// written. A length is long with four significant digits, and a direction with three. Two are enough in a direction
/// that has length 1 within them and not exactly.
///
/// If no long decimal of a kind has a trailing zero, a number shorter than most may be chosen or have lost zeros. It
/// then has the most common unit, or in a direction that of the other components. This applies to a number with fewer
/// digits than a long one, and to a length that is as short as few others. With at least ten long decimals it also
/// applies to a component one place shorter than the others.
///
/// Whole numbers among the lengths and those that end in `.0` also have the most common unit. Whole zeros, and whole
/// numbers in directions, are exact. But if most axes are decimals and lengths are whole numbers, these are rounded to
/// whole numbers.
///
/// # Complexity
/// O(n log n) for n numbers.
#[must_use]
pub fn uncertainties(mechanism: &Mechanism) -> Option<Uncertainties> {
    let reading = Reading::of_mechanism(mechanism)?;
    let frame = |f: &Frame| reading.read_frame(f);
    let offered = |j: &Joint| j.offered_options().map(|o| frame(&o.frame)).collect();
    let joints = mechanism.joints.iter();
    Some(Uncertainties {
        frames: joints.clone().map(|j| frame(&j.frame)).collect(),
        option_frames: joints.map(offered).collect(),
        normal: match &mechanism.mode {
            Mode::Spatial => [0.0; 3],
            Mode::Planar { normal } => reading.read_direction(normal),
        },
    })
}

/// Returns true if a number is written as a whole number.
fn is_whole(e: &Expr) -> bool {
    match e.written() {
        WrittenNumber::Whole => true,
        WrittenNumber::Decimal(digits) => digits.end == End::Float,
        WrittenNumber::No | WrittenNumber::Stated(_) => false,
    }
}

/// Returns true if more of the axes have decimals than only whole numbers. Options give no information on how a file is
/// rotated.
fn is_turned(mechanism: &Mechanism) -> bool {
    let axes = mechanism.joints.iter();
    let axes = axes.filter(|j| j.joint_type.is_directed());
    let decimal = |j: &Joint| j.frame.axis.iter().any(|e| !is_whole(e));
    let (turned, straight): (Vec<&Joint>, _) = axes.partition(|j| decimal(j));
    turned.len() > straight.len()
}

impl Reading {
    /// Reads the numbers of a mechanism, or returns `None` if nothing looks rounded and no uncertainty is stated.
    fn of_mechanism(mechanism: &Mechanism) -> Option<Reading> {
        let [mut lengths, mut directions] = [NumberClass::default(), NumberClass::default()];
        let mut stated = false;
        let mut see = |v: &[Expr], kind: NumberKind| {
            let says = |e: &Expr| matches!(e.written(), WrittenNumber::Stated(half) if half > 0.0);
            stated |= v.iter().any(says);
            match kind {
                NumberKind::Length => lengths.see_vector(v, kind),
                NumberKind::Direction => directions.see_vector(v, kind),
            }
        };
        let own = mechanism.joints.iter().map(|j| &j.frame);
        let offered = mechanism.joints.iter().flat_map(|j| j.offered_options());
        for frame in own.chain(offered.map(|o| &o.frame)) {
            see(&frame.point, NumberKind::Length);
            see(&frame.axis, NumberKind::Direction);
            see(&frame.reference, NumberKind::Direction);
            if !is_whole(&frame.pitch) {
                see(std::slice::from_ref(&frame.pitch), NumberKind::Length);
            }
        }
        for p in &mechanism.points {
            see(&p.point, NumberKind::Length);
        }
        if let Mode::Planar { normal } = &mechanism.mode {
            see(normal, NumberKind::Direction);
        }
        let [lengths, directions] = [lengths, directions].map(NumberClass::with_commonest);
        let rounded = stated || lengths.is_long() || directions.is_long();
        rounded.then(|| Reading {
            turned: directions.is_long() && is_turned(mechanism),
            lengths,
            directions,
        })
    }

    fn read_frame(&self, f: &Frame) -> FrameUncertainty {
        FrameUncertainty {
            point: [0, 1, 2].map(|i| self.read_length(&f.point[i], &f.point)),
            axis: self.read_direction(&f.axis),
            reference: self.read_direction(&f.reference),
            // A whole pitch is chosen.
            pitch: if is_whole(&f.pitch) {
                0.0
            } else {
                self.read_length(&f.pitch, std::slice::from_ref(&f.pitch))
            },
        }
    }

    fn read_length(&self, e: &Expr, of: &[Expr]) -> f64 {
        self.lengths.length_half_unit(e, of, self.turned)
    }

    fn read_direction(&self, v: &[Expr; 3]) -> [f64; 3] {
        let halves = self.directions.direction_half_units(v);
        [0, 1, 2].map(|i| halves[i])
    }
}
