//! What is greatest over a stroke, in the plane and in space alike.

use crate::view::prelude::*;
use std::f64::consts::PI;

/// A value, and the position of the first drive where it is reached.
pub(crate) type Reached = (f64, f64);

/// The unit of positions of the first drive in texts: degrees, or the file's unit of length.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DriveUnit {
    /// Its number in one of the unit of the data.
    pub(crate) per: f64,
    pub(crate) symbol: &'static str,
}

impl DriveUnit {
    /// The unit of a drive that turns, whose positions are in radians.
    pub(crate) const DEGREES: DriveUnit = DriveUnit {
        per: 180.0 / PI,
        symbol: "°",
    };

    /// Returns a position in the unit.
    pub(crate) fn shown_position(self, x: f64) -> f64 {
        x * self.per
    }

    /// Returns a position with its unit.
    pub(crate) fn format_place(self, x: f64) -> String {
        format!("{} {}", five_digits(self.shown_position(x)), self.symbol)
    }
}

/// The greatest force and moment of a joint.
#[derive(Debug)]
pub(crate) struct Peak {
    /// Its name and its type.
    pub(crate) joint: [String; 2],
    /// `[N]` and `[N·m]`.
    pub(crate) sizes: [Reached; 2],
}

/// Returns the greatest of some values.
pub(crate) fn greatest_of(each: impl Iterator<Item = Reached>) -> Option<Reached> {
    each.max_by(|a, b| a.0.total_cmp(&b.0))
}

/// Adds the greatest reactions of each joint, and where they are. Returns the greatest of all.
pub(crate) fn write_peaks(out: &mut Report, peaks: &[Peak], unit: DriveUnit) -> f64 {
    let sizes = peaks.iter().flat_map(|p| p.sizes);
    let greatest = sizes.map(|x| x.0).fold(0.0, f64::max);
    let (scale, prefix) = unit_prefix(greatest);
    let rows = peaks.iter().map(|peak| {
        let mut row = peak.joint.to_vec();
        for (x, at) in peak.sizes {
            row.push(five_digits(x / scale));
            row.push(match x {
                0.0 => String::new(),
                _ => five_digits(unit.shown_position(at)),
            });
        }
        row
    });
    let at = unit.symbol;
    out.add_table(
        &format!("joint |  | |F|, {prefix}N | at, {at} | |M|, {prefix}N·m | at, {at}"),
        rows,
    );
    out.add_line("");
    greatest
}

/// Adds the least and the greatest of some efforts, if there are any; `name` says what makes them.
pub(crate) fn write_effort(
    out: &mut Report,
    name: &str,
    each: impl Iterator<Item = Reached>,
    slides: bool,
    unit: DriveUnit,
) {
    let ends = each.minmax_by(|a, b| a.0.total_cmp(&b.0)).into_option();
    let Some((low, high)) = ends else { return };
    let (scale, prefix) = unit_prefix(low.0.abs().max(high.0.abs()));
    let what = if slides { "N" } else { "N·m" };
    let [low, high] = [low, high].map(|(x, at)| {
        let (x, at) = (five_digits(x / scale), unit.format_place(at));
        format!("{x} {prefix}{what} at {at}")
    });
    out.add_line(format!("{name}: from {low} to {high}"));
}
