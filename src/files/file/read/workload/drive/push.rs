//! What the cam gives a swing, and where: one moment all along, or pieces.

use crate::file::locate::{index, key};
use crate::file::read::value::quantity::{Bound, ValueTable};
use crate::file::schema::{Coordinate, DriveEntry};
use crate::model::drive::Push;

/// Most pieces.
const MOST: usize = 1000;

/// The cam's push over a swing of half as much as twice `twist`.
pub(crate) fn push(t: &mut ValueTable<'_>, e: &DriveEntry, twist: f64) -> Push {
    if let Some(list) = &e.feed_moments {
        return pieces(t, e, list, twist);
    }
    let from = e.feed_from.as_ref();
    let from = from.map_or(0.0, |c| t.angle("feed_from", c));
    if !(-twist..twist).contains(&from) {
        let path = key(&t.at, "feed_from");
        t.bad(
            &path,
            "feed_from",
            format!("{} degrees", from.to_degrees()),
            "an angle within the swing, 0 being its middle",
        );
    }
    let energy = t.not_negative("feed_energy", &e.feed_energy, 1.0);
    Push::Even { energy, from }
}

fn pieces(t: &mut ValueTable<'_>, e: &DriveEntry, list: &[[Coordinate; 2]], twist: f64) -> Push {
    let beside = [
        ("feed_energy", e.feed_energy.is_some()),
        ("feed_from", e.feed_from.is_some()),
    ];
    for (k, _) in beside.into_iter().filter(|(_, given)| *given) {
        t.excludes(k, "feed_moments");
    }
    let at = key(&t.at, "feed_moments");
    if list.is_empty() || list.len() > MOST {
        t.bad(&at, "number of pieces", list.len().to_string(), "1 to 1000");
        return Push::Pieces(Vec::new());
    }
    let mut pieces: Vec<(f64, f64)> = Vec::new();
    for (i, [from, moment]) in list.iter().enumerate() {
        let path = index(&at, i);
        let from = t.angle_at(&index(&path, 0), "feed_moments", from);
        let after = pieces.last().map(|p| p.0);
        if !(-twist..twist).contains(&from) || after.is_some_and(|last| from <= last) {
            t.bad(
                &index(&path, 0),
                "beginning of a piece",
                format!("{} degrees", from.to_degrees()),
                "an angle within the swing, 0 being its middle, beyond that of the piece before",
            );
        }
        let bound = match after {
            // The push begins with what pushes.
            None => Bound::Positive,
            Some(_) => Bound::NotNegative,
        };
        let moment = t.number_at(&index(&path, 1), "moment", moment, 1.0, bound);
        pieces.push((from, moment));
    }
    Push::Pieces(pieces)
}
