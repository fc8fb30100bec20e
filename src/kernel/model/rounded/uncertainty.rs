//! Accuracy of each number of a mechanism, from its last digit or a stated uncertainty.

use super::class::{NumberClass, NumberKind};
use super::ratio::doubt_of;
use crate::geom::expr::{End, Expr, WrittenNumber};
use crate::geom::vector::{self, to_vector};
use crate::model::joint_type::Coupling;
use crate::model::mechanism::{Frame, Joint, Mechanism, Mode};
use std::collections::BTreeMap;

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

/// Identity of the numbers of a frame: an index for each inexact number. Numbers of one kind that are equal up to their
/// sign have equal indices.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FrameNumbers {
    /// Indices of its point.
    pub point: [Option<usize>; 3],
    /// Indices of its axis.
    pub axis: [Option<usize>; 3],
    /// Indices of its reference.
    pub reference: [Option<usize>; 3],
}

/// Half units of all numbers of a mechanism that may have been rounded, in the file's own numbers; 0 if they are exact.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Uncertainties {
    /// Half units of the frames, by joint.
    pub frames: Vec<FrameUncertainty>,
    /// Half units of the frames of the options, by joint, in the order of
    /// [`Joint::offered`](crate::model::mechanism::Joint::offered_options).
    pub option_frames: Vec<Vec<FrameUncertainty>>,
    /// Half units of the points of interest.
    pub points: Vec<[f64; 3]>,
    /// Half units of the normal of the plane.
    pub normal: [f64; 3],
    /// Half units of the doubtful ratios of couplings.
    pub ratios: Vec<f64>,
    /// Identity of the numbers of the joints.
    pub numbers: Vec<FrameNumbers>,
    /// Number of inexact lengths and directions, with equal ones counted once.
    pub distinct: [usize; 2],
    /// Half the most common unit of lengths and of components of directions; 0 if none is rounded.
    pub half_unit: [f64; 2],
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
    /// Whether any decimal is long, or any uncertainty is stated.
    rounded: bool,
    /// Whether the file is rotated in space: most axes of its joints are decimals.
    turned: bool,
    /// Indices of numbers by kind and size.
    seen: BTreeMap<(NumberKind, u64), usize>,
    distinct: [usize; 2],
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
    let mut reading = Reading::of_mechanism(mechanism);
    let ratio = |c: &Coupling| doubt_of(c).map_or(0.0, |d| d.half);
    let ratios: Vec<f64> = mechanism.couplings.iter().map(ratio).collect();
    if !reading.rounded && ratios.iter().all(|r| *r == 0.0) {
        return None;
    }
    let mut out = Uncertainties {
        ratios,
        half_unit: reading.half_units(),
        ..Uncertainties::default()
    };
    for joint in &mechanism.joints {
        let (half, numbers) = reading.read_frame(&joint.frame);
        out.frames.push(half);
        out.numbers.push(numbers);
        let offered = joint
            .offered_options()
            .map(|o| reading.read_frame(&o.frame).0);
        out.option_frames.push(offered.collect());
    }
    let points = mechanism.points.iter();
    let points = points.map(|p| reading.read_vector(&p.point, NumberKind::Length).0);
    out.points = points.collect();
    if let Mode::Planar { normal } = &mechanism.mode {
        out.normal = reading.read_vector(normal, NumberKind::Direction).0;
    }
    out.distinct = reading.distinct;
    Some(out)
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
    fn of_mechanism(mechanism: &Mechanism) -> Reading {
        let [mut lengths, mut directions] = [NumberClass::default(), NumberClass::default()];
        let mut stated = false;
        let mut see = |v: &[Expr], kind: NumberKind| {
            let says = |e: &Expr| matches!(e.written(), WrittenNumber::Stated(half) if half > 0.0);
            stated |= v.iter().any(says);
            match kind {
                NumberKind::Length => v.iter().for_each(|e| lengths.see_number(e, kind)),
                NumberKind::Direction => directions.see_direction(v),
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
        Reading {
            turned: directions.is_long() && is_turned(mechanism),
            lengths,
            directions,
            rounded,
            seen: BTreeMap::new(),
            distinct: [0; 2],
        }
    }

    /// Returns half the units that most numbers have.
    fn half_units(&self) -> [f64; 2] {
        if !self.rounded {
            return [0.0; 2];
        }
        let lengths = self.lengths.commonest_half_unit();
        let whole = self.turned && self.lengths.has_whole();
        let lengths = lengths.unwrap_or(if whole { 0.5 } else { 0.0 });
        [
            lengths,
            self.directions.commonest_half_unit().unwrap_or(0.0),
        ]
    }

    fn read_frame(&mut self, f: &Frame) -> (FrameUncertainty, FrameNumbers) {
        let [point, axis, reference] = [
            (&f.point, NumberKind::Length),
            (&f.axis, NumberKind::Direction),
            (&f.reference, NumberKind::Direction),
        ]
        .map(|(v, kind)| self.read_vector(v, kind));
        let of = FrameUncertainty {
            point: point.0,
            axis: axis.0,
            reference: reference.0,
            // A whole pitch is chosen.
            pitch: if is_whole(&f.pitch) {
                0.0
            } else {
                self.length_half_units(std::slice::from_ref(&f.pitch))[0]
            },
        };
        let numbers = FrameNumbers {
            point: point.1,
            axis: axis.1,
            reference: reference.1,
        };
        (of, numbers)
    }

    fn length_half_units(&self, v: &[Expr]) -> Vec<f64> {
        if !self.rounded {
            return vec![0.0; v.len()];
        }
        self.lengths.length_half_units(v, self.turned)
    }

    fn read_vector(&mut self, v: &[Expr; 3], kind: NumberKind) -> ([f64; 3], [Option<usize>; 3]) {
        let halves = match kind {
            NumberKind::Length => self.length_half_units(v),
            NumberKind::Direction if self.rounded => self.directions.direction_half_units(v),
            NumberKind::Direction => Vec::new(),
        };
        let halves = [0, 1, 2].map(|i| halves.get(i).copied().unwrap_or(0.0));
        let number = |i: usize| {
            if halves[i] == 0.0 {
                return None;
            }
            let key = (kind, v[i].to_f64().abs().to_bits());
            let next = self.seen.len();
            let id = *self.seen.entry(key).or_insert(next);
            self.distinct[kind as usize] += usize::from(id == next);
            Some(id)
        };
        (halves, [0, 1, 2].map(number))
    }
}
