//! The axes of a joint's frame round its bodies, with an arrow for each freedom.

use crate::draw::place::projection::View;
use crate::geom::vector::{X, Y, Z, dot};
use crate::model::joint_type::Freedom;
use crate::svg::plane::{Point, add, cross, norm, scale, sub, unit};
use std::f64::consts::{PI, TAU};

/// The space between bodies, arrows and the end of an axis.
const GAP: f64 = 8.0;
/// The length of an arrow's head.
const HEAD: f64 = 9.0;
/// The length of a straight arrow without its heads.
const SHAFT: f64 = 22.0;
/// The radius of an arrow round an axis.
const ROUND: f64 = 18.0;
/// An axis seen from its end has less than this on paper.
const END_ON: f64 = 0.3;

/// An arrow on paper.
pub(super) struct FreedomArrow {
    pub(super) freedom: Freedom,
    pub(super) lines: Vec<Vec<Point>>,
    /// What is filled: its heads, and the point of one that points at the reader.
    pub(super) heads: Vec<Vec<Point>>,
    /// What its name stands beside, and how far from it.
    pub(super) middle: Point,
    pub(super) clear: f64,
}

/// An axis of the frame on paper.
pub(super) struct PaperAxis {
    pub(super) name: &'static str,
    pub(super) lines: Vec<Vec<Point>>,
    pub(super) heads: Vec<Vec<Point>>,
    /// What its name stands beside, and where it is best.
    pub(super) end: Point,
    pub(super) beyond: Point,
    pub(super) arrows: Vec<FreedomArrow>,
}

/// The axes round what covers these points of the paper.
pub(super) fn axes(freedoms: &[Freedom], view: &View, covered: &[Point]) -> Vec<PaperAxis> {
    let all = [("x", X), ("y", Y), ("z", Z)];
    let one = |(n, (name, axis)): (usize, (&'static str, _))| {
        let mut own: Vec<Freedom> = freedoms
            .iter()
            .copied()
            .filter(|f| axis_of(*f) == n)
            .collect();
        own.sort_by_key(|f| f.turns());
        let flat = view.flat(axis);
        if norm(flat) < END_ON {
            return end_on(name, &own, covered);
        }
        let slim = dot(axis, view.toward).abs().max(END_ON);
        beside(name, &own, unit(flat), slim, covered)
    };
    all.into_iter().enumerate().map(one).collect()
}

/// The axis of the frame that a freedom is about or along.
fn axis_of(f: Freedom) -> usize {
    match f {
        Freedom::Rx | Freedom::Tx => 0,
        Freedom::Ry | Freedom::Ty => 1,
        Freedom::Rz | Freedom::Tz | Freedom::Screw => 2,
    }
}

/// How far points within some distance of a ray from the origin go along it.
fn reach(covered: &[Point], along: Point, near: f64) -> f64 {
    let by = covered.iter().filter(|p| cross(along, **p).abs() < near);
    by.map(|p| dot(along, *p)).fold(0.0, f64::max)
}

/// An axis that lies in the paper or aslant to it, with its arrows one beyond the other; `slim` is the width of circles
/// round it, as a share of their length.
fn beside(
    name: &'static str,
    own: &[Freedom],
    along: Point,
    slim: f64,
    covered: &[Point],
) -> PaperAxis {
    let across = [-along[1], along[0]];
    let from = -reach(covered, scale(along, -1.0), 4.0) - 2.0 * GAP;
    let mut at = reach(covered, along, ROUND + 3.0) + GAP;
    let mut arrows = Vec::new();
    for &freedom in own {
        // round the axis from its far side by its near side, and so far along it in a turn
        let round = |turns: f64, rise: f64, from: f64| -> Vec<Point> {
            let steps = (32.0 * turns) as i32;
            let on = |i: i32| {
                let t = TAU * turns * (f64::from(i) / f64::from(steps) - 0.5);
                let up = from + rise * (t / TAU + turns / 2.0) - slim * ROUND * t.cos();
                add(scale(along, up), scale(across, ROUND * t.sin()))
            };
            (0..=steps).map(on).collect()
        };
        let (line, middle, clear, length) = if freedom.slides() {
            let ends = [at + HEAD, at + HEAD + SHAFT];
            let line = ends.map(|x| scale(along, x)).to_vec();
            (line, at + HEAD + SHAFT / 2.0, 5.0, 2.0 * HEAD + SHAFT)
        } else {
            let (turns, rise) = if freedom.turns() {
                (0.75, 0.0)
            } else {
                (2.25, 17.0)
            };
            let wide = slim * ROUND;
            let line = round(turns, rise, at + wide);
            let length = 2.0 * wide + rise * turns;
            (line, at + length / 2.0, ROUND + 4.0, length)
        };
        at += length + GAP;
        arrows.push(headed(freedom, line, scale(along, middle), clear));
    }
    let [from, to] = [from, at + 2.0 * GAP].map(|x| scale(along, x));
    PaperAxis {
        name,
        lines: vec![vec![from, to]],
        heads: vec![head(to, along, 8.0)],
        end: to,
        beyond: add(to, scale(along, 2.2 * GAP)),
        arrows,
    }
}

/// An axis that points at the reader: arrows lie round the bodies and beside them.
fn end_on(name: &'static str, own: &[Freedom], covered: &[Point]) -> PaperAxis {
    let to = |degrees: f64| {
        let angle = degrees.to_radians();
        [angle.cos(), -angle.sin()]
    };
    let one = |&freedom: &Freedom| {
        let (lower_left, lower_right) = (to(225.0), to(-60.0));
        if freedom.slides() {
            let middle = scale(lower_right, reach(covered, lower_right, 14.0) + 2.5 * GAP);
            return toward(freedom, middle);
        }
        let within = covered.iter().filter(|p| dot(lower_left, unit(**p)) > 0.8);
        let radius = within.map(|p| norm(*p)).fold(0.0, f64::max) + 1.5 * GAP;
        let line = (0..=24).map(|i| scale(to(197.0 + 56.0 * f64::from(i) / 24.0), radius));
        let middle = scale(lower_left, radius);
        let mut out = headed(freedom, line.collect(), middle, 5.0);
        if !freedom.turns() {
            let point = toward(freedom, scale(lower_left, radius + 2.5 * GAP));
            out.lines.extend(point.lines);
            out.heads.extend(point.heads);
            out.middle = point.middle;
            out.clear = point.clear;
        }
        out
    };
    let upper_left = to(135.0);
    let end = scale(upper_left, reach(covered, upper_left, 8.0) + 2.0 * GAP);
    PaperAxis {
        name,
        lines: vec![ring(end, 5.0)],
        heads: vec![ring(end, 1.6)],
        end,
        beyond: add(end, scale(upper_left, 2.0 * GAP)),
        arrows: own.iter().map(one).collect(),
    }
}

/// An arrow that points at the reader.
fn toward(freedom: Freedom, middle: Point) -> FreedomArrow {
    FreedomArrow {
        freedom,
        lines: vec![ring(middle, 9.0)],
        heads: vec![ring(middle, 3.0)],
        middle,
        clear: 13.0,
    }
}

/// A line with a head beyond each end.
fn headed(freedom: Freedom, line: Vec<Point>, middle: Point, clear: f64) -> FreedomArrow {
    let ends = [[0, 1], [line.len() - 1, line.len() - 2]];
    let heads = ends.map(|[end, before]| head(line[end], unit(sub(line[end], line[before])), HEAD));
    FreedomArrow {
        freedom,
        heads: heads.to_vec(),
        lines: vec![line],
        middle,
        clear,
    }
}

/// A head that begins at a point.
fn head(at: Point, along: Point, length: f64) -> Vec<Point> {
    let side = scale([-along[1], along[0]], 0.42 * length);
    vec![add(at, scale(along, length)), add(at, side), sub(at, side)]
}

/// A circle.
fn ring(middle: Point, radius: f64) -> Vec<Point> {
    let on = |i: i32| {
        let angle = PI / 12.0 * f64::from(i);
        add(middle, [radius * angle.cos(), radius * angle.sin()])
    };
    (0..=24).map(on).collect()
}
