//! The recovered scene.

use super::exact_directions::place_direction;
use super::projection::{Projection, Taken};
use super::relations::Finder;
use super::stage::Stage;
use super::written::WrittenScene;
use super::{MeantScene, of_points};
use crate::geom::vector::Vector;
use num_bigint::BigInt;
use num_rational::BigRational;

/// Sizes below this, and above its inverse, are extreme.
const SMALL: f64 = 1e-6;
/// Maximum number of directions of points to which further ones may be perpendicular. Numbers would grow long in a
/// chain of them.
const MOST: usize = 2;

/// Recovers the intended scene. Returns `None` if its relations cannot be solved within the digits.
///
/// # Complexity
/// O(p²) pairs of p points, compared with each other and with d directions; then O(r² p) for r relations.
#[must_use]
pub fn resolve_scene(written: &WrittenScene) -> Option<MeantScene> {
    let size = written.scene_size();
    if (SMALL..SMALL.recip()).contains(&size) {
        return resolve_moderate(written);
    }
    // Squares of lengths such as 10^-200 underflow in doubles.
    let power = -size.log10().floor();
    if !power.is_finite() {
        return None;
    }
    let power = power as i32;
    let mut scene = resolve_moderate(&written.scale_by_power(power)?)?;
    let back = BigRational::from_integer(BigInt::from(10)).pow(-power);
    for x in scene.points.iter_mut().flatten() {
        *x *= &back;
    }
    Some(scene)
}

/// Recovers the scene of a geometry of moderate size.
fn resolve_moderate(written: &WrittenScene) -> Option<MeantScene> {
    let stage = Stage::new(written);
    let weights = stage.point_weights();
    let clipped = |p: usize, by: Vector| stage.clip_move(p, by);
    let directions = stage.scene_directions();
    let mut fixed = directions.clone();
    let mut finder = Finder::new(&stage.inside, &stage.errors, directions);
    let mut solved = Projection::new(stage.inside.clone(), &weights, &clipped);
    let stated = stage.stated_relations(&mut finder.normals);
    let mut became = solved.take_all(stated, &finder.normals.real);
    let found = finder.find_all();
    became.extend(solved.take_all(found, &finder.normals.real));
    let (rows, points) = (solved.rows.len(), solved.points.clone());
    // Lines defined only by points that no relation above determines.
    let directions_of_rays = fixed.len();
    for d in of_points::lines_of(&solved, &stage.errors) {
        let e = place_direction(d.unit, d.error, &fixed, stage.digits);
        let found = solved.take_all(finder.lines_along(&e), &finder.normals.real);
        // Further ones may be perpendicular to it.
        if fixed.len() < directions_of_rays + MOST && found.iter().any(|(_, b)| *b == Taken::New) {
            fixed.push(e);
        }
        became.extend(found);
    }
    let normals = finder.normals;
    // Without those lines, if they contradict each other.
    let scene = stage
        .exact_scene(&solved.rows, &solved.points, &normals)
        .or_else(|| stage.exact_scene(&solved.rows[..rows], &points, &normals))?;
    let taken = became.into_iter().filter(|b| b.1 == Taken::New);
    let relations = taken.map(|(r, _)| (r.kind, r.rows[0].terms.iter().map(|t| t.0).collect()));
    Some(MeantScene {
        relations: relations.collect(),
        ..scene
    })
}
