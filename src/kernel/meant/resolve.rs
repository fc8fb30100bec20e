//! The recovered scene, and others that the digits do not exclude.

use super::directions::Caution;
use super::exact_directions::place_direction;
use super::projection::{Projection, Taken};
use super::relations::{Finder, Normals, Relation};
use super::stage::{Stage, StageMark};
use super::written::WrittenScene;
use super::{Images, MeantScene, of_points};
use crate::geom::vector::Vector;
use num_bigint::BigInt;
use num_rational::BigRational;

/// The scenes that the digits allow.
#[derive(Debug, Clone)]
pub struct Resolved {
    /// The scene with the most relations.
    pub scene: MeantScene,
    /// Others that the digits do not exclude: with relations slightly outside the digits, and without those that may
    /// equally exist by chance.
    pub others: Vec<MeantScene>,
}

/// Sizes below this, and above its inverse, are extreme.
const SMALL: f64 = 1e-6;
/// Maximum number of directions of points to which further ones may be perpendicular. Numbers would grow long in a
/// chain of them.
const MOST: usize = 2;
/// Largest move, in errors, required by a refused relation that may hold all the same.
const LEFT_OUT: f64 = 4.0;
/// Factor of the usual moves above which a relation is certainly refuted.
const BOLD: f64 = 1.6;

/// Recovers the intended scene. Returns `None` if its relations cannot be solved within the digits.
///
/// # Complexity
/// O(p²) pairs of p points, compared with each other and with d directions; then O(r² p) for r relations.
#[must_use]
pub fn resolve_scene(written: &WrittenScene) -> Option<Resolved> {
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
    let mut out = resolve_moderate(&written.scale_by_power(power)?)?;
    let back = BigRational::from_integer(BigInt::from(10)).pow(-power);
    for scene in std::iter::once(&mut out.scene).chain(&mut out.others) {
        for x in scene.points.iter_mut().flatten() {
            *x *= &back;
        }
    }
    Some(out)
}

/// Recovers the scene of a geometry of moderate size.
fn resolve_moderate(written: &WrittenScene) -> Option<Resolved> {
    let usual = Caution {
        bold: 1.0,
        weak: true,
    };
    let (scene, doubts, without) = resolve_with(written, usual)?;
    let mut others: Vec<MeantScene> = without.into_iter().collect();
    let bold = Caution {
        bold: BOLD,
        ..usual
    };
    let shy = Caution {
        weak: false,
        ..usual
    };
    for (doubted, caution) in [(doubts.left_out, bold), (doubts.by_chance, shy)] {
        if doubted > 0
            && let Some((other, ..)) = resolve_with(written, caution)
        {
            others.push(other);
        }
    }
    Some(Resolved { scene, others })
}

/// Numbers of doubtful relations.
struct Doubts {
    left_out: usize,
    by_chance: usize,
    /// Lines of points that are close to those of others.
    of_points: usize,
}

impl Doubts {
    /// Returns the numbers of doubtful relations by their outcomes; those from `first` on involve only points.
    fn new(
        became: &[(Relation, Taken)],
        first: usize,
        solved: &Projection<'_>,
        normals: &Normals,
        images: &Images,
    ) -> Doubts {
        // A relation that follows from others only up to rounding does not hold.
        let broken = |(r, b): &&(Relation, Taken)| {
            *b == Taken::Refused
                || (*b == Taken::Implied && !r.rows.iter().all(|w| images.row_holds(w)))
        };
        let left_out = |(r, _): &&(Relation, Taken)| {
            let asks = r
                .rows
                .iter()
                .filter_map(|w| solved.required_move(w, &normals.real));
            let far = asks.fold(0.0, f64::max);
            far > 0.0 && far <= LEFT_OUT
        };
        let refused = became.iter().filter(|x| x.1 == Taken::Refused);
        Doubts {
            left_out: refused.filter(left_out).count(),
            by_chance: became
                .iter()
                .filter(|(r, b)| *b == Taken::New && r.weak)
                .count(),
            of_points: became[first..].iter().filter(broken).count(),
        }
    }
}

/// Recovers a scene and counts its doubtful relations. If it is doubtful, also returns it without lines defined only by
/// points.
fn resolve_with(
    written: &WrittenScene,
    caution: Caution,
) -> Option<(MeantScene, Doubts, Option<MeantScene>)> {
    let stage = Stage::new(written, caution);
    let weights = stage.point_weights();
    let clipped = |p: usize, by: Vector| stage.clip_move(p, by);
    let directions = stage.scene_directions();
    let mut fixed = directions.clone();
    let mut finder = Finder::new(&stage.inside, &stage.errors, directions);
    let mut solved = Projection::new(stage.inside.clone(), &weights, &clipped);
    solved.bold = caution.bold;
    let keep = |all: Vec<Relation>| {
        let certain = all.into_iter().filter(|r| caution.weak || !r.weak);
        certain.collect()
    };
    let stated = stage.stated_relations(&mut finder.normals);
    let mut became = solved.take_all(stated, &finder.normals.real);
    let found = keep(finder.find_all());
    became.extend(solved.take_all(found, &finder.normals.real));
    let (first, plain) = (became.len(), StageMark::from_projection(&solved));
    // Lines defined only by points that no relation above determines.
    let directions_of_rays = fixed.len();
    for d in of_points::lines_of(&solved, &stage.errors) {
        let e = place_direction(d.unit, d.error, &fixed, stage.digits);
        let found = keep(finder.lines_along(&e));
        let found = solved.take_all(found, &finder.normals.real);
        // Further ones may be perpendicular to it.
        if fixed.len() < directions_of_rays + MOST && found.iter().any(|(_, b)| *b == Taken::New) {
            fixed.push(e);
        }
        became.extend(found);
    }
    let normals = finder.normals;
    if became.iter().any(|x| x.1 == Taken::Refused) {
        solved.make_basis(&normals.real);
    }
    let without = || stage.exact_scene(&solved.rows[..plain.rows], &plain.points, &normals);
    let scene = stage
        .exact_scene(&solved.rows, &solved.points, &normals)
        .or_else(without)?;
    let images = Images::from_scene(&scene.inside, &normals.exact);
    let doubts = Doubts::new(&became, first, &solved, &normals, &images);
    let without = (doubts.of_points > 0).then(without).flatten();
    let taken = became.into_iter().filter(|b| b.1 == Taken::New);
    let relations = taken.map(|(r, _)| (r.kind, r.rows[0].terms.iter().map(|t| t.0).collect()));
    let scene = MeantScene {
        relations: relations.collect(),
        ..scene
    };
    Some((scene, doubts, without))
}
