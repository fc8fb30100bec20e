//! What the search may change and what it costs.

pub(in crate::file::read) mod options;
pub(crate) mod ranking;

use crate::closure::mirror::Plane;
use crate::file::Findings;
use crate::file::costs::costs;
use crate::file::locate::{DocumentStep, index, key};
use crate::file::problem::ProblemKind;
use crate::file::read::value::names::{joint_by_id, link_by_id};
use crate::file::schema::MechanismFile;
use crate::geom::extent::diagonal;
use crate::geom::vector::real;
use crate::model::mechanism::{JointId, Mechanism, SearchSpec};
use itertools::Itertools;

/// Off by more than this, as an angle and as a fraction of the mechanism's size, joints are no mirror images, however their
/// coordinates were rounded.
const NO_IMAGE: f64 = 1e-3;

/// Tells pairs that are no mirror images.
fn images(
    mechanism: &Mechanism,
    pairs: &[(JointId, JointId)],
    at: &[DocumentStep],
    out: &mut Findings,
) {
    let planes = Plane::of_pairs(mechanism, pairs);
    let Some((_, misses)) = planes.first() else {
        return;
    };
    let points = mechanism.joints.iter().map(|j| real(&j.frame.point));
    let size = diagonal(points.collect_vec().iter().copied());
    for (i, (&(a, b), miss)) in pairs.iter().zip(misses).enumerate() {
        if miss.angle > NO_IMAGE || miss.distance > NO_IMAGE * size {
            let [first, second] = [a, b].map(|j| mechanism.joints[j].id.clone());
            out.add(
                &index(&key(at, "mirror"), i),
                ProblemKind::NoMirrorImage {
                    first,
                    second,
                    off: miss.words(mechanism.length_unit.symbol),
                },
            );
        }
    }
}

pub(crate) fn search(
    file: &MechanismFile,
    mechanism: &Mechanism,
    out: &mut Findings,
) -> SearchSpec {
    let at = [DocumentStep::Key("search".to_owned())];
    let mut spec = SearchSpec::default();
    for (i, id) in file.search.hold.iter().enumerate() {
        let path = index(&key(&at, "hold"), i);
        spec.hold
            .extend(link_by_id(&mechanism.links, id, &path, out));
    }
    let mut grouped = Vec::new();
    let mut joints = |ids: &[String], under, path: &[DocumentStep], out: &mut Findings| {
        let named = ids.iter();
        let named = named.filter_map(|id| joint_by_id(mechanism, id, path, out));
        let mut named = named.collect_vec();
        // Whether images are so is asked of each joint once: thousands of mistaken pairs took minutes.
        named.retain(|&j| {
            let first = !grouped.contains(&j);
            if first {
                grouped.push(j);
            } else {
                let joint = mechanism.joints[j].id.clone();
                out.add(path, ProblemKind::RepeatedImage { joint, under });
            }
            first
        });
        named
    };
    for (i, pair) in file.search.mirror.iter().enumerate() {
        if let [a, b] = joints(pair, "mirror", &index(&key(&at, "mirror"), i), out)[..] {
            spec.mirror.push((a, b));
        }
    }
    for (i, group) in file.search.turn.iter().enumerate() {
        let path = index(&key(&at, "turn"), i);
        let found = joints(group, "turn", &path, out);
        let first = file.search.turn[0].len();
        if ![2, 3].contains(&group.len()) || group.len() != first {
            out.add(&path, ProblemKind::TurnGroup { count: group.len() });
        } else if !file.search.mirror.is_empty() {
            out.add(&path, ProblemKind::TurnAndMirror);
        } else if found.len() == first {
            spec.turn.push(found);
        }
    }
    images(mechanism, &spec.mirror, &at, out);
    spec.costs = costs(&file.search.costs, mechanism, &key(&at, "costs"), out);
    spec
}
