//! What is stated of how well numbers are known, told from the numbers.

use crate::file::schema::{Coordinate, ToleranceEntry};
use crate::file::write::quantity::number;
use crate::geom::expr::{Expr, Written};
use crate::geom::vector::{length, real};
use crate::model::mechanism::Mechanism;

/// What all numbers of the points and of the directions have in common; nothing where they have nothing.
pub(super) fn tolerance(m: &Mechanism) -> Option<ToleranceEntry> {
    let frames = m.joints.iter().map(|j| &j.frame);
    let points = frames.clone().flat_map(|f| &f.point);
    let points = points.chain(m.points.iter().flat_map(|p| &p.point));
    let directions = frames.flat_map(|f| [&f.axis, &f.reference]);
    let directions = directions.flat_map(|v| v.iter().map(move |e| (length(real(v)), e)));
    let lengths = common(points.filter(|e| e.to_f64() != 0.0).map(|e| (e, stated(e))));
    let turned = directions.filter(|(_, e)| ![0.0, 1.0].contains(&e.to_f64().abs()));
    let direction = common(turned.map(|(of, e)| (e, stated(e).map(|half| half / of))));
    // What was multiplied by a length and divided again is off in its last bits.
    let short = |x: f64| format!("{x:.12e}").parse().unwrap_or(x);
    let entry = |x: Option<f64>| x.map(|x| number(short(x), 1.0));
    (lengths.is_some() || direction.is_some()).then(|| ToleranceEntry {
        length: entry(lengths),
        direction: entry(direction),
    })
}

/// What is stated of a point by itself.
pub(super) fn of_point(point: &[Expr; 3], file: Option<&ToleranceEntry>) -> Option<Coordinate> {
    let halves = point.each_ref().map(stated);
    let half = halves.into_iter().flatten().reduce(f64::max)?;
    let all = halves.iter().all(Option::is_some);
    let common = file.is_some_and(|t| t.length.is_some());
    // Zeros have none by what is stated of the file.
    let zero = |(e, h): (&Expr, &Option<f64>)| h.is_some() == (e.to_f64() != 0.0);
    let by_file = common && point.iter().zip(&halves).all(zero);
    (!by_file && (all || !common)).then(|| number(half, 1.0))
}

fn stated(e: &Expr) -> Option<f64> {
    match e.written() {
        Written::Stated(half) => Some(half),
        _ => None,
    }
}

/// The half unit that every one has that would be read as a number.
fn common<'e>(of: impl Iterator<Item = (&'e Expr, Option<f64>)>) -> Option<f64> {
    let mut found: Option<f64> = None;
    for (e, half) in of {
        let Some(half) = half else {
            if e.written() == Written::No {
                continue;
            }
            return None;
        };
        // Of the length of a direction, to the last bits.
        if found.is_some_and(|f| (f - half).abs() > 1e-9 * f) {
            return None;
        }
        found = found.or(Some(half));
    }
    found
}
