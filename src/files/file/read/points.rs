//! The points of interest.

use crate::file::findings::Findings;
use crate::file::locate::{DocumentStep, index, key};
use crate::file::read::value::names::{check_id, link_by_id};
use crate::file::read::value::number::vector;
use crate::file::schema::MechanismFile;
use crate::model::mechanism::{Mechanism, PointOfInterest};

pub(crate) fn points(
    file: &MechanismFile,
    mechanism: &Mechanism,
    out: &mut Findings,
) -> Vec<PointOfInterest> {
    let mut points = Vec::with_capacity(file.point.len());
    for (i, entry) in file.point.iter().enumerate() {
        let at = index(&[DocumentStep::Key("point".to_owned())], i);
        let twice = file.point[..i].iter().any(|p| p.id == entry.id);
        check_id("point", &entry.id, twice, &key(&at, "id"), out);
        let place = vector(&entry.point, &key(&at, "point"), out);
        if let Some(link) = link_by_id(&mechanism.links, &entry.link, &key(&at, "link"), out) {
            points.push(PointOfInterest {
                id: entry.id.clone(),
                link,
                point: place,
            });
        }
    }
    points
}
