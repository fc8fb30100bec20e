//! What is stated of how well numbers are known, told from the numbers.

use crate::file::schema::{Coordinate, ToleranceEntry};
use crate::file::write::quantity::number;
use crate::geom::expr::{Expr, WrittenNumber};
use crate::geom::vector::{length, real};
use crate::model::mechanism::Mechanism;

/// What is stated of most numbers of the points, and of all of the directions.
pub(super) fn tolerance(m: &Mechanism) -> Option<ToleranceEntry> {
    let frames = m.joints.iter().map(|j| &j.frame);
    let points = frames.clone().flat_map(|f| &f.point);
    let points = points.chain(m.points.iter().flat_map(|p| &p.point));
    let directions = frames.flat_map(|f| [&f.axis, &f.reference]);
    let directions = directions.flat_map(|v| v.iter().map(move |e| (length(real(v)), e)));
    let lengths = most(points.filter(|e| e.to_f64() != 0.0).map(|e| (e, stated(e))));
    let turned = directions.filter(|(_, e)| ![0.0, 1.0].contains(&e.to_f64().abs()));
    let direction = most(turned.map(|(of, e)| (e, stated(e).map(|half| short(half / of)))));
    let entry = |x: Option<f64>| x.map(|x| number(x, 1.0));
    (lengths.is_some() || direction.is_some()).then(|| ToleranceEntry {
        length: entry(lengths),
        direction: entry(direction),
    })
}

/// What is stated of a point by itself, where that is not what is stated of the file.
pub(super) fn of_point(point: &[Expr; 3], file: Option<&ToleranceEntry>) -> Option<Coordinate> {
    let halves = point.iter().filter_map(stated);
    let half = number(halves.reduce(f64::max)?, 1.0);
    let size = |c: &Coordinate| match c {
        Coordinate::Integer(x) => x.to_string(),
        Coordinate::Decimal(x) => x.to_string(),
        Coordinate::Expression(x) => x.clone(),
    };
    let of_file = file.and_then(|t| t.length.as_ref()).map(size);
    (of_file != Some(size(&half))).then_some(half)
}

/// What was multiplied by a length and divided again is off in its last bits.
fn short(x: f64) -> f64 {
    format!("{x:.12e}").parse().unwrap_or(x)
}

fn stated(e: &Expr) -> Option<f64> {
    match e.written() {
        WrittenNumber::Stated(half) => Some(half),
        _ => None,
    }
}

/// The half unit that most have; none where one that would be read as a number has none.
fn most<'e>(of: impl Iterator<Item = (&'e Expr, Option<f64>)>) -> Option<f64> {
    let mut count: Vec<(f64, usize)> = Vec::new();
    for (e, half) in of {
        match half {
            None if e.written() == WrittenNumber::No => {}
            None => return None,
            Some(half) => match count.iter_mut().find(|c| c.0.to_bits() == half.to_bits()) {
                Some(c) => c.1 += 1,
                None => count.push((half, 1)),
            },
        }
    }
    let most = count.iter().map(|c| c.1).max();
    count.iter().find(|c| Some(c.1) == most).map(|c| c.0)
}
