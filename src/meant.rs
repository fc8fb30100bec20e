//! What measured geometry means: the scene with the most relations among those that move no number by more than its digits allow.
//!
//! Directions first: parallel ones as one, each refined by the points that are square to it or along it, then made exact in a frame
//! of the scene's own. Points then: what lies in planes and on lines along those directions, coincides, or is equal as a vector is
//! solved together by least squares, each relation taken only if all still hold, and at last exactly over the rationals.

mod consensus;
mod directions;
mod exact_directions;
mod frame;
pub mod mechanism;
pub mod number;
mod of_points;
mod projection;
pub mod relations;
mod solve;
mod together;
pub mod written;

use crate::geom::vector::{Vector, sub};
use directions::of_rays;
use exact_directions::{Exact, exact, placed};
use frame::Frame;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::One;
use number::{Rational3, decimal, to_f64};
use projection::{Projection, Taken};
use relations::{Finder, Kind, Relation, Use};
use together::together;
use written::{Ray, Written};

/// A move of this many halves of a last digit is within it, rounding in between aside.
const WITHIN: f64 = 1.3;

/// A scene as it is meant.
#[derive(Debug, Clone)]
pub struct Scene {
    /// Its points, exact, in the file's frame.
    pub points: Vec<Rational3>,
    /// Its directions, exact, of any length.
    pub rays: Vec<Rational3>,
    /// For each ray, which direction it has: parallel ones have one.
    pub cluster: Vec<usize>,
    /// The independent relations taken, and the points of each.
    pub relations: Vec<(Kind, Vec<usize>)>,
    /// Relations that hold but for more than the digits allow, or contradict others.
    pub refused: usize,
    /// The largest move of a coordinate, in halves of its last digit.
    pub moved: f64,
}

/// What the digits of a scene allow.
#[derive(Debug, Clone)]
pub struct Resolved {
    /// The scene with the most relations.
    pub scene: Scene,
    /// Others that the digits do not rule out: with relations that are all but within them, and without those that as well are
    /// there by chance.
    pub others: Vec<Scene>,
}

/// How bold relations are taken.
#[derive(Debug, Clone, Copy)]
struct Caution {
    /// Moves may be larger by this.
    bold: f64,
    /// Whether relations count that may be there by chance.
    weak: bool,
    /// Whether lines and planes count that points alone make.
    of_points: bool,
}

/// A relation that was not taken and asks for no larger move, in errors, may hold in truth.
const LEFT_OUT: f64 = 4.0;
/// Moves larger by this than those of relations usually are speak against a relation for sure.
const BOLD: f64 = 1.6;

/// The scene that is meant; none where its relations cannot be solved within the digits.
///
/// # Complexity
/// O(p²) pairs of p points, held against each other and against d directions; then O(r² p) for r relations.
#[must_use]
pub fn resolve(written: &Written) -> Option<Resolved> {
    let usual = Caution {
        bold: 1.0,
        weak: true,
        of_points: true,
    };
    let (scene, doubts) = resolve_with(written, usual)?;
    let mut others = Vec::new();
    let bold = Caution {
        bold: BOLD,
        ..usual
    };
    let shy = Caution {
        weak: false,
        ..usual
    };
    let plain = Caution {
        of_points: false,
        ..usual
    };
    let doubted = [
        (doubts.left_out, bold),
        (doubts.by_chance, shy),
        (doubts.of_points, plain),
    ];
    for (doubted, caution) in doubted {
        if doubted > 0
            && let Some((other, _)) = resolve_with(written, caution)
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

fn resolve_with(written: &Written, caution: Caution) -> Option<(Scene, Doubts)> {
    let errors = written.errors();
    let points: Vec<Vector> = written.points.iter().map(|p| p.value).collect();
    let size = written.size();
    let least = errors.iter().fold(f64::INFINITY, |a, &e| a.min(e));
    let finest = written
        .rays
        .iter()
        .map(Ray::error)
        .filter(|e| *e > 0.0)
        .fold(1.0, f64::min);
    let places = |x: f64| -> u32 {
        let digits = (-x.log10()).ceil() + 2.0;
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "between 4 and 18"
        )]
        let digits = digits.clamp(4.0, 18.0) as u32;
        digits
    };
    let angle = places((least / size).min(finest));
    let mut of = of_rays(&written.rays, &points, &errors);
    let own = of.all.len();
    if Frame::is_the_files(&of.all) {
        of.add_axes();
    }
    let rays_of = |k: usize| {
        written
            .rays
            .iter()
            .zip(&of.of_ray)
            .filter(move |r| r.1.0 == k)
            .map(|r| r.0)
    };
    let within = WITHIN * caution.bold;
    let fits = |k: usize, v: Vector| rays_of(k).all(|r| r.moved(v, 0.0) <= within);
    together(&mut of.all, caution.bold, fits);
    of.all.truncate(own);
    let frame = Frame::of(&of.all);
    let origin = (0..points.len())
        .find(|&p| written.points[p].half == [0.0; 3])
        .unwrap_or(0);
    let inside: Vec<Vector> = points
        .iter()
        .map(|p| frame.inside(sub(*p, points[origin])))
        .collect();
    let rotated = frame.rotation.is_some();
    let exact = exact(
        &of.all,
        |v| frame.inside(v),
        |ray| frame.inside_exactly(&written.rays[ray].exact),
        angle,
    );
    let mut fixed: Vec<Exact> = exact.clone();
    if !rotated {
        fixed.extend(axes_of_the_file());
    }
    let directions: Vec<_> = fixed.iter().cloned().map(|e| (e, Use::Both)).collect();
    // What must stay: coordinates that are exact along an axis that both frames have.
    let axis_of = |k: usize| -> Option<usize> {
        let Some(r) = &frame.rotation else {
            return Some(k);
        };
        (0..3).find(|&c| r[c][k].is_one() || (-&r[c][k]).is_one())
    };
    let stays = |p: usize, k: usize| {
        let half = &written.points[p].half;
        (p == origin && *half == [0.0; 3]) || axis_of(k).is_some_and(|c| half[c] == 0.0)
    };
    let weights: Vec<Vector> = (0..points.len())
        .map(|p| {
            [0, 1, 2].map(|k| {
                if stays(p, k) {
                    0.0
                } else {
                    match axis_of(k) {
                        Some(c) => written.points[p].half[c].max(1e-15 * size),
                        None => errors[p],
                    }
                }
            })
        })
        .collect();
    let floor = written.floor();
    let allowed = |p: usize, by: Vector| {
        let out = frame.outside(by);
        (0..3).all(|c| out[c].abs() <= within * written.points[p].half[c].max(floor))
    };
    let mut finder = Finder::new(&inside, &errors, directions);
    let mut solved = Projection::new(inside.clone(), &weights, &allowed);
    solved.bold = caution.bold;
    let keep = |all: Vec<Relation>| {
        all.into_iter()
            .filter(|r| caution.weak || !r.weak)
            .collect()
    };
    let found = keep(finder.all());
    let mut became = solved.take_all(found, &finder.normals.real);
    let first = became.len();
    // What points alone make: lines and planes that nothing above keeps.
    let both = [of_points::lines, of_points::planes_of];
    for further in both.into_iter().filter(|_| caution.of_points) {
        let more: Vec<(Exact, Use)> = further(&solved, &errors)
            .into_iter()
            .map(|d| {
                let e = placed(d.unit, d.error, &fixed, angle);
                (e, if d.plane { Use::Planes } else { Use::Lines })
            })
            .collect();
        for one in more {
            let found = keep(finder.along(vec![one]));
            became.extend(solved.take_all(found, &finder.normals.real));
        }
    }
    let normals = finder.normals;
    let asks = |r: &Relation| {
        r.rows
            .iter()
            .filter_map(|w| solved.asks(w, &normals.real))
            .fold(0.0, f64::max)
    };
    let left_out = became.iter().filter(|(r, b)| {
        *b == Taken::Refused && {
            let far = asks(r);
            far > 0.0 && far <= LEFT_OUT
        }
    });
    let doubts = Doubts {
        left_out: left_out.count(),
        by_chance: became
            .iter()
            .filter(|(r, b)| *b == Taken::New && r.weak)
            .count(),
        of_points: became[first..]
            .iter()
            .filter(|(_, b)| *b == Taken::Refused)
            .count(),
    };
    let refused = became.iter().filter(|b| b.1 == Taken::Refused).count();
    let relations: Vec<(Kind, Vec<usize>)> = became
        .into_iter()
        .filter(|(_, b)| *b == Taken::New)
        .map(|(r, _)| (r.kind, r.rows[0].terms.iter().map(|t| t.0).collect()))
        .collect();
    let offset = &written.points[origin].exact;
    let start: Vec<Rational3> = written
        .points
        .iter()
        .map(|p| frame.inside_exactly(&[0, 1, 2].map(|k| &p.exact[k] - &offset[k])))
        .collect();
    let rounded = |p: usize, k: usize| {
        let still = !rotated && (solved.points[p][k] - inside[p][k]).abs() <= 1e-3 * weights[p][k];
        if stays(p, k) || still {
            return start[p][k].clone();
        }
        decimal(solved.points[p][k], places(weights[p][k].min(1.0)).min(22))
    };
    let exactly = solve::solve(&solved.rows, &normals.exact, points.len(), rounded, stays)?;
    let outside: Vec<Rational3> = exactly
        .iter()
        .map(|x| {
            let x = frame.outside_exactly(x);
            [0, 1, 2].map(|k| &x[k] + &offset[k])
        })
        .collect();
    let mut moved: f64 = 0.0;
    for (x, w) in outside.iter().zip(&written.points) {
        let by = to_f64(&[0, 1, 2].map(|k| &x[k] - &w.exact[k]));
        for (by, half) in by.iter().zip(w.half) {
            moved = moved.max(by.abs() / half.max(floor));
        }
    }
    let minus_one = BigRational::from_integer(BigInt::from(-1));
    let rays = written
        .rays
        .iter()
        .zip(&of.of_ray)
        .map(|(ray, (k, sign))| {
            if ray.is_exact() {
                return ray.exact.clone();
            }
            let e = frame.outside_exactly(&exact[*k].exact);
            if *sign < 0.0 {
                e.map(|x| x * &minus_one)
            } else {
                e
            }
        })
        .collect::<Vec<_>>();
    for (x, w) in rays.iter().zip(&written.rays) {
        if w.is_exact() {
            continue;
        }
        moved = moved.max(w.moved(to_f64(x), 0.0));
    }
    let scene = Scene {
        points: outside,
        rays,
        cluster: of.of_ray.iter().map(|r| r.0).collect(),
        relations,
        refused,
        moved,
    };
    Some((scene, doubts))
}

/// The file's own axes as directions, where its frame is the scene's.
fn axes_of_the_file() -> Vec<Exact> {
    number::axes().into_iter().map(Exact::of_axis).collect()
}
