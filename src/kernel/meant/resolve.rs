//! The scene that is meant, and others that the digits do not rule out.

use super::directions::Caution;
use super::exact_directions::{Exact, placed};
use super::projection::{Projection, Taken};
use super::relations::{Finder, Normals, Relation, Use};
use super::stage::{Stage, StageMark};
use super::written::WrittenScene;
use super::{Images, MeantScene, of_points};
use crate::geom::vector::Vector;
use num_bigint::BigInt;
use num_rational::BigRational;

/// What the digits of a scene allow.
#[derive(Debug, Clone)]
pub struct Resolved {
    /// The scene with the most relations.
    pub scene: MeantScene,
    /// Others that the digits do not rule out: with relations that are all but within them, and without those that as well are
    /// there by chance.
    pub others: Vec<MeantScene>,
}

/// Sizes smaller than this, and larger than its inverse, are extreme.
const SMALL: f64 = 1e-6;
/// Directions of points that further ones may be square to; numbers would grow long in a chain of them.
const MOST: usize = 2;
/// A relation that was not taken and asks for no larger move, in errors, may hold in truth.
const LEFT_OUT: f64 = 4.0;
/// Moves larger by this than those of relations usually are speak against a relation for sure.
const BOLD: f64 = 1.6;

/// The scene that is meant; none where its relations cannot be solved within the digits.
///
/// # Complexity
/// O(p²) pairs of p points, held against each other and against d directions; then O(r² p) for r relations.
#[must_use]
pub fn resolve(written: &WrittenScene) -> Option<Resolved> {
    let size = written.size();
    if (SMALL..SMALL.recip()).contains(&size) {
        return resolved(written);
    }
    // Squares of lengths such as 10^-200 are nothing in doubles.
    let power = -size.log10().floor();
    if !power.is_finite() {
        return None;
    }
    #[allow(clippy::cast_possible_truncation, reason = "308 at most")]
    let power = power as i32;
    let mut out = resolved(&written.resized(power)?)?;
    let back = BigRational::from_integer(BigInt::from(10)).pow(-power);
    for scene in std::iter::once(&mut out.scene).chain(&mut out.others) {
        for x in scene.points.iter_mut().flatten() {
            *x *= &back;
        }
    }
    Some(out)
}

/// The same of a geometry of no extreme size.
fn resolved(written: &WrittenScene) -> Option<Resolved> {
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

/// How many relations are doubtful.
struct Doubts {
    left_out: usize,
    by_chance: usize,
    /// Lines and planes of points that are nearly those that others make.
    of_points: usize,
}

impl Doubts {
    /// Of relations with what became of them, of which those from `first` on are of points alone.
    fn new(
        became: &[(Relation, Taken)],
        first: usize,
        solved: &Projection<'_>,
        normals: &Normals,
        images: &Images,
    ) -> Doubts {
        // What follows from others to rounding alone does not hold.
        let broken = |(r, b): &&(Relation, Taken)| {
            *b == Taken::Refused
                || (*b == Taken::Implied && !r.rows.iter().all(|w| images.holds(w)))
        };
        let left_out = |(r, _): &&(Relation, Taken)| {
            let asks = r.rows.iter().filter_map(|w| solved.asks(w, &normals.real));
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

/// A scene, how doubtful it is, and where it is doubted the same without lines and planes that points alone make.
fn resolve_with(
    written: &WrittenScene,
    caution: Caution,
) -> Option<(MeantScene, Doubts, Option<MeantScene>)> {
    let stage = Stage::new(written, caution);
    let weights = stage.weights();
    let clipped = |p: usize, by: Vector| stage.clipped(p, by);
    let directions = stage.directions();
    let mut fixed: Vec<Exact> = directions.iter().map(|d| d.0.clone()).collect();
    let mut finder = Finder::new(&stage.inside, &stage.errors, directions);
    let mut solved = Projection::new(stage.inside.clone(), &weights, &clipped);
    solved.bold = caution.bold;
    let keep = |all: Vec<Relation>| {
        let certain = all.into_iter().filter(|r| caution.weak || !r.weak);
        certain.collect()
    };
    let stated = stage.stated(&mut finder.normals);
    let mut became = solved.take_all(stated, &finder.normals.real);
    let found = keep(finder.all());
    became.extend(solved.take_all(found, &finder.normals.real));
    let (first, plain) = (became.len(), StageMark::of(&solved));
    // What points alone make: lines and planes that nothing above keeps.
    let directions_of_rays = fixed.len();
    for further in [of_points::lines, of_points::planes_of] {
        for d in further(&solved, &stage.errors) {
            let e = placed(d.unit, d.error, &fixed, stage.digits);
            let of = if d.plane { Use::Planes } else { Use::Lines };
            let found = keep(finder.along(vec![(e.clone(), of)]));
            let found = solved.take_all(found, &finder.normals.real);
            // Further ones may be square to it.
            if fixed.len() < directions_of_rays + MOST
                && found.iter().any(|(_, b)| *b == Taken::New)
            {
                fixed.push(e);
            }
            became.extend(found);
        }
    }
    let normals = finder.normals;
    if became.iter().any(|x| x.1 == Taken::Refused) {
        solved.make_basis(&normals.real);
    }
    let without = || stage.scene(&solved.rows[..plain.rows], &plain.points, &normals);
    let scene = stage
        .scene(&solved.rows, &solved.points, &normals)
        .or_else(without)?;
    let images = Images::of(&scene.inside, &normals.exact);
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
