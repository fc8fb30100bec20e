//! A scene between its two frames: the data before points are moved, and the resulting exact scene.

use super::MeantScene;
use super::directions::{Directions, digits_allow, of_rays};
use super::exact_directions::{Exact, make_exact};
use super::frame::SceneFrame;
use super::number::{self, Rational3, nearest_decimal, to_f64};
use super::relations::{Normals, Relation};
use super::solve::{PointEquation, solve_rows};
use super::together::adjust_together;
use super::written::{Written, WrittenScene};
use crate::geom::vector::{Vector, sub};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::One;

/// Rounding is unlikely to move all numbers of a relation by nearly half a unit to one side. Relations that need this
/// are off by design.
const NEVER_ALL: f64 = 0.95;

/// Data of a scene before its points are moved.
pub(super) struct Stage<'a> {
    written: &'a WrittenScene,
    floor: f64,
    size: f64,
    /// Decimals of a direction's components.
    pub(super) digits: u32,
    frame: SceneFrame,
    origin: usize,
    of: Directions,
    exact: Vec<Exact>,
    /// Index of the direction of the stated symmetry.
    symmetric: Option<usize>,
    /// The axis of the file that each axis of the frame equals.
    same: [Option<usize>; 3],
    /// The error of each point, in each coordinate.
    pub(super) errors: Vec<f64>,
    /// The points in the scene's frame.
    pub(super) inside: Vec<Vector>,
}

/// Returns the number of decimals that leave two digits beyond an error.
fn decimal_places(error: f64) -> u32 {
    let digits = (-error.log10()).ceil() + 2.0;
    digits.clamp(4.0, 22.0) as u32
}

impl<'a> Stage<'a> {
    pub(super) fn new(written: &'a WrittenScene) -> Stage<'a> {
        let errors = written.point_errors();
        let points: Vec<Vector> = written.points.iter().map(|p| p.value).collect();
        let size = written.scene_size();
        let least = errors.iter().fold(f64::INFINITY, |a, &e| a.min(e));
        let inexact = written
            .rays
            .iter()
            .map(Written::angular_error)
            .filter(|e| *e > 0.0);
        let digits = decimal_places((least / size).min(inexact.fold(1.0, f64::min))).min(18);
        let (of, symmetric) = adjusted_directions(written, &points, &errors);
        let frame = SceneFrame::from_directions(&of.all);
        let whole = |p: &usize| written.points[*p].half == [0.0; 3];
        let origin = (0..points.len()).find(whole).unwrap_or(0);
        let exactly = |ray: usize| frame.inside_exactly(&written.rays[ray].exact);
        let mut exact = make_exact(&of.all, |v| frame.scene_vector(v), exactly, digits);
        if let (Some(symmetry), Some(own)) = (&written.symmetry, symmetric) {
            let n = exact[own].exact.clone();
            let allowed = digits_allow(&written.rays, &of.of_ray);
            for (a, b) in symmetry.image_pairs(&of) {
                let image = Exact::new(symmetry.image_exactly(&n, &exact[a].exact), exact[b].error);
                if of.all[b].exact.is_none() && allowed(b, frame.file_vector(image.unit)) {
                    exact[b] = image;
                }
            }
        }
        let inside = points
            .iter()
            .map(|p| frame.scene_vector(sub(*p, points[origin])));
        let same = [0, 1, 2].map(|k| match &frame.rotation {
            None => Some(k),
            Some(r) => (0..3).find(|&c| r[c][k].is_one() || (-&r[c][k]).is_one()),
        });
        Stage {
            written,
            floor: written.least_error(),
            size,
            digits,
            origin,
            inside: inside.collect(),
            frame,
            of,
            exact,
            symmetric,
            same,
            errors,
        }
    }

    /// Returns the exact directions of the scene. They include the file's own axes if its frame is the scene's.
    pub(super) fn scene_directions(&self) -> Vec<Exact> {
        let own = number::frame_axes().into_iter().map(|e| Exact::new(e, 0.0));
        let own = own.filter(|_| self.frame.rotation.is_none());
        self.exact.iter().cloned().chain(own).collect()
    }

    /// Returns the relations of the stated symmetry.
    pub(super) fn stated_relations(&self, normals: &mut Normals) -> Vec<Relation> {
        match (&self.written.symmetry, self.symmetric) {
            (Some(s), Some(own)) => {
                s.image_relations(&self.exact[own].exact, &self.inside, normals)
            }
            _ => Vec::new(),
        }
    }

    /// Returns true if a coordinate must stay, because it is exact along an axis that both frames share.
    fn must_stay(&self, p: usize, k: usize) -> bool {
        let half = &self.written.points[p].half;
        (p == self.origin && *half == [0.0; 3]) || self.same[k].is_some_and(|c| half[c] == 0.0)
    }

    /// Returns the error of each coordinate in the scene's frame; 0 if it must stay.
    pub(super) fn point_weights(&self) -> Vec<Vector> {
        let weight = |p: usize, k: usize| match self.same[k] {
            _ if self.must_stay(p, k) => 0.0,
            Some(c) => self.written.points[p].half[c].max(1e-15 * self.size),
            None => self.errors[p],
        };
        let all = 0..self.inside.len();
        all.map(|p| [0, 1, 2].map(|k| weight(p, k))).collect()
    }

    /// Returns the displacement nearest to `by` that the digits of the point allow, in the scene's frame.
    pub(super) fn clip_move(&self, p: usize, by: Vector) -> Vector {
        let (out, half) = (self.frame.file_vector(by), &self.written.points[p].half);
        let most = half.map(|h| NEVER_ALL * h.max(self.floor));
        if (0..3).all(|c| out[c].abs() <= most[c]) {
            return by;
        }
        let inside = [0, 1, 2].map(|c| out[c].clamp(-most[c], most[c]));
        self.frame.scene_vector(inside)
    }

    /// Returns the exact scene of rows that hold at some points, or `None` if they contradict each other.
    pub(super) fn exact_scene(
        &self,
        rows: &[PointEquation],
        at: &[Vector],
        normals: &Normals,
    ) -> Option<MeantScene> {
        let offset = &self.written.points[self.origin].exact;
        let rotated = self.frame.rotation.is_some();
        let start = |p: usize| {
            let written = &self.written.points[p].exact;
            self.frame
                .inside_exactly(&[0, 1, 2].map(|k| &written[k] - &offset[k]))
        };
        let weights = self.point_weights();
        let value = |p: usize, k: usize| {
            let still = (at[p][k] - self.inside[p][k]).abs() <= 1e-3 * weights[p][k];
            if self.must_stay(p, k) || (!rotated && still) {
                return start(p)[k].clone();
            }
            nearest_decimal(at[p][k], decimal_places(weights[p][k].min(1.0)))
        };
        let stays = |p: usize, k: usize| self.must_stay(p, k);
        let inside = solve_rows(rows, &normals.exact, at.len(), value, stays)?;
        let back = |x: &Rational3| {
            let x = self.frame.outside_exactly(x);
            [0, 1, 2].map(|k| &x[k] + &offset[k])
        };
        let points: Vec<Rational3> = inside.iter().map(back).collect();
        let rays = self.rays_in_file();
        Some(MeantScene {
            moved: self.largest_move(&points, &rays),
            points,
            rays,
            cluster: self.of.of_ray.iter().map(|r| r.0).collect(),
            relations: Vec::new(),
        })
    }

    /// Returns the rays in the file's frame; exact ones stay as written.
    fn rays_in_file(&self) -> Vec<Rational3> {
        let minus_one = BigRational::from_integer(BigInt::from(-1));
        let outside: Vec<Rational3> = self
            .exact
            .iter()
            .map(|e| self.frame.outside_exactly(&e.exact))
            .collect();
        let all = self.written.rays.iter().zip(&self.of.of_ray);
        let one = |(ray, (k, sign)): (&Written, &(usize, f64))| match ray.is_exact() {
            true => ray.exact.clone(),
            false if *sign < 0.0 => outside[*k].each_ref().map(|x| x * &minus_one),
            false => outside[*k].clone(),
        };
        all.map(one).collect()
    }

    /// Returns the largest move of a number, in halves of its last digit.
    fn largest_move(&self, points: &[Rational3], rays: &[Rational3]) -> f64 {
        let point = points.iter().zip(&self.written.points).flat_map(|(x, w)| {
            let by = to_f64(&[0, 1, 2].map(|k| &x[k] - &w.exact[k]));
            [0, 1, 2].map(|k| by[k].abs() / w.half[k].max(self.floor))
        });
        let inexact = rays
            .iter()
            .zip(&self.written.rays)
            .filter(|r| !r.1.is_exact());
        let ray = inexact.map(|(x, w)| w.move_to(to_f64(x), 0.0));
        point.chain(ray).fold(0.0, f64::max)
    }
}

/// Returns the directions of a scene, with perpendicular and coplanar ones adjusted together, and the index of the
/// direction of the stated symmetry.
fn adjusted_directions(
    written: &WrittenScene,
    points: &[Vector],
    errors: &[f64],
) -> (Directions, Option<usize>) {
    let mut of = of_rays(&written.rays, points, errors);
    let symmetry = written.symmetry.as_ref();
    let symmetric = symmetry.and_then(|s| s.apply_to(&mut of, points, errors));
    let own = of.all.len();
    if SceneFrame::is_the_files(&of.all) {
        of.add_axes();
    }
    let fits = digits_allow(&written.rays, &of.of_ray);
    adjust_together(&mut of.all, fits);
    of.all.truncate(own);
    (of, symmetric)
}
