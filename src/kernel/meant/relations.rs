//! Relations between points of a scene, as linear equations along its directions.

use super::exact_directions::Exact;
use super::number::{Rational3, cross, frame_axes, scale_to_one, to_f64};
use super::solve::PointEquation;
use super::written::SPREAD;
use crate::geom::vector::{self, Vector, dot, length, sub, unit};
use itertools::Itertools;

/// Kind of a relation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum RelationKind {
    /// Points that coincide.
    Coincident,
    /// Points in a plane perpendicular to a direction.
    InPlane,
    /// Points on a line along a direction.
    OnLine,
    /// Two pairs of points with equal differences, as in a parallelogram or for a midpoint.
    EqualVectors,
    /// Two pairs of points that are images in one plane.
    Mirrored,
}

/// A relation, with the deviation of the written points from it, in errors.
#[derive(Debug, Clone)]
pub(super) struct Relation {
    pub(super) kind: RelationKind,
    pub(super) rows: Vec<PointEquation>,
    /// Number of points that share it: planes of many points come before planes of two.
    pub(super) weight: usize,
    pub(super) off: f64,
}

impl Relation {
    /// Creates a relation of no particular weight.
    pub(super) fn new(kind: RelationKind, rows: Vec<PointEquation>, off: f64) -> Relation {
        Relation {
            kind,
            rows,
            weight: 0,
            off,
        }
    }
}

/// Normals of the rows, exact and as doubles; the first three are the frame's axes.
pub(super) struct Normals {
    pub(super) exact: Vec<Rational3>,
    pub(super) real: Vec<Vector>,
}

impl Normals {
    fn new() -> Normals {
        let exact = frame_axes().to_vec();
        let real = exact.iter().map(to_f64).collect();
        Normals { exact, real }
    }

    pub(super) fn index(&mut self, normal: Rational3) -> usize {
        let v = unit(to_f64(&normal));
        let same = |w: &Vector| length(vector::cross(*w, v)) < 1e-13;
        if let Some(k) = self.real.iter().position(same) {
            return k;
        }
        let normal = scale_to_one(normal);
        self.real.push(to_f64(&normal));
        self.exact.push(normal);
        self.real.len() - 1
    }

    /// Returns two normals perpendicular to a direction.
    pub(super) fn square_to(&mut self, d: &Rational3) -> [usize; 2] {
        let v = to_f64(d);
        let mut order = [0, 1, 2];
        order.sort_by(|&a, &b| v[a].abs().total_cmp(&v[b].abs()));
        // Not perpendicular to each other, but with short numbers.
        [0, 1].map(|k| self.index(cross(d, &frame_axes()[order[k]])))
    }
}

/// Finds the relations of some points, strongest first.
pub(super) struct Finder<'a> {
    pub(super) points: &'a [Vector],
    pub(super) errors: &'a [f64],
    pub(super) directions: Vec<Exact>,
    pub(super) normals: Normals,
}

impl<'a> Finder<'a> {
    pub(super) fn new(
        points: &'a [Vector],
        errors: &'a [f64],
        directions: Vec<Exact>,
    ) -> Finder<'a> {
        Finder {
            points,
            errors,
            directions,
            normals: Normals::new(),
        }
    }

    /// Returns the lines along a further direction.
    pub(super) fn lines_along(&mut self, direction: &Exact) -> Vec<Relation> {
        let normals = self.normals.square_to(&direction.exact);
        let mut out = Vec::new();
        self.find_lines(normals, &self.distinct_places(), &mut out);
        sort_by_strength(&mut out);
        out
    }

    /// Returns the first of each set of coincident points.
    fn distinct_places(&self) -> Vec<usize> {
        let firsts = self.first_coincident();
        (0..firsts.len()).filter(|&i| firsts[i] == i).collect()
    }

    fn pair_tolerance(&self, i: usize, j: usize) -> f64 {
        SPREAD * (self.errors[i] + self.errors[j])
    }

    /// Returns all relations, the strongest first.
    pub(super) fn find_all(&mut self) -> Vec<Relation> {
        let firsts = self.first_coincident();
        let mut out = Vec::new();
        for (i, &first) in firsts.iter().enumerate() {
            if first != i {
                let rows = (0..3).map(|n| difference_row(i, first, n)).collect();
                let off =
                    length(sub(self.points[i], self.points[first])) / self.pair_tolerance(i, first);
                out.push(Relation::new(RelationKind::Coincident, rows, off));
            }
        }
        let places = self.distinct_places();
        let directions = std::mem::take(&mut self.directions);
        let all = || directions.iter().map(|d| &d.exact);
        let normals: Vec<usize> = all().map(|d| self.normals.index(d.clone())).collect();
        let normals: Vec<usize> = normals.into_iter().sorted_unstable().dedup().collect();
        for &n in &normals {
            self.find_planes(n, &places, &mut out);
        }
        for d in all() {
            let pair = self.normals.square_to(d);
            self.find_lines(pair, &places, &mut out);
        }
        self.equal_vectors(&places, &mut out);
        sort_by_strength(&mut out);
        out
    }

    /// Returns for each point the first point that it coincides with.
    fn first_coincident(&self) -> Vec<usize> {
        let mut first: Vec<usize> = Vec::new();
        for i in 0..self.points.len() {
            let near = |&j: &usize| {
                first[j] == j
                    && length(sub(self.points[i], self.points[j])) <= self.pair_tolerance(i, j)
            };
            let found = (0..i).find(near).unwrap_or(i);
            first.push(found);
        }
        first
    }

    /// Finds points in planes perpendicular to a normal: neighbours in the order along it.
    fn find_planes(&self, normal: usize, places: &[usize], out: &mut Vec<Relation>) {
        let n = unit(self.normals.real[normal]);
        let mut at: Vec<(f64, usize)> = places
            .iter()
            .map(|&p| (dot(n, self.points[p]), p))
            .collect();
        at.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut start = 0;
        for k in 1..=at.len() {
            let apart = at
                .get(k)
                .is_none_or(|x| x.0 - at[k - 1].0 > self.pair_tolerance(x.1, at[k - 1].1));
            if apart {
                for w in at[start..k].windows(2) {
                    out.push(Relation {
                        kind: RelationKind::InPlane,
                        rows: vec![difference_row(w[1].1, w[0].1, normal)],
                        weight: k - start,
                        off: (w[1].0 - w[0].0) / self.pair_tolerance(w[1].1, w[0].1),
                    });
                }
                start = k;
            }
        }
    }

    /// Finds points on lines along a direction, given by two normals perpendicular to it.
    fn find_lines(&self, normals: [usize; 2], places: &[usize], out: &mut Vec<Relation>) {
        let n = normals.map(|k| unit(self.normals.real[k]));
        let off = |i: usize, j: usize| {
            let w = sub(self.points[i], self.points[j]);
            dot(n[0], w).hypot(dot(n[1], w))
        };
        let mut firsts: Vec<(usize, usize)> = Vec::new();
        let mut found = Vec::new();
        for &p in places {
            let near = firsts
                .iter_mut()
                .find(|(f, _)| off(p, *f) <= self.pair_tolerance(p, *f));
            match near {
                Some((f, of)) => {
                    *of += 1;
                    found.push((p, *f));
                }
                None => firsts.push((p, 1)),
            }
        }
        for (p, f) in found {
            let of = firsts.iter().find(|x| x.0 == f).map_or(2, |x| x.1);
            let rows = normals.map(|k| difference_row(p, f, k)).to_vec();
            let off = off(p, f) / self.pair_tolerance(p, f);
            out.push(Relation {
                weight: of,
                ..Relation::new(RelationKind::OnLine, rows, off)
            });
        }
    }

    fn equal_vectors(&self, places: &[usize], out: &mut Vec<Relation>) {
        let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
        for (n, &i) in places.iter().enumerate() {
            for &j in &places[..n] {
                pairs.push((length(sub(self.points[i], self.points[j])), i, j));
            }
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut done = vec![false; pairs.len()];
        for a in 0..pairs.len() {
            let (l, i, j) = pairs[a];
            let w = sub(self.points[i], self.points[j]);
            for b in a + 1..pairs.len() {
                let (m, p, q) = pairs[b];
                let wide = 0.8 * (self.pair_tolerance(i, j) + self.pair_tolerance(p, q));
                if m - l > wide {
                    break;
                }
                let v = sub(self.points[p], self.points[q]);
                let sign = if dot(v, w) < 0.0 { -1 } else { 1 };
                let off = length(sub(w, v.map(|x| f64::from(sign) * x)));
                if off > wide || done[b] {
                    continue;
                }
                done[b] = true;
                let row = |n| PointEquation::sum(&[(i, 1), (j, -1), (p, -sign), (q, sign)], n);
                let rows: Vec<PointEquation> = (0..3).map(row).collect();
                if rows[0].terms.len() < 3 {
                    continue;
                }
                out.push(Relation::new(RelationKind::EqualVectors, rows, off / wide));
            }
        }
    }
}

fn difference_row(i: usize, j: usize, normal: usize) -> PointEquation {
    PointEquation {
        terms: vec![(i, 1), (j, -1)],
        normal,
    }
}

/// Sorts the strongest first.
fn sort_by_strength(out: &mut [Relation]) {
    let rank = |r: &Relation| match r.kind {
        RelationKind::Coincident => 0,
        RelationKind::InPlane if r.weight > 3 => 1,
        RelationKind::OnLine => 2,
        RelationKind::EqualVectors => 3,
        RelationKind::InPlane => 4,
        RelationKind::Mirrored => 5,
    };
    out.sort_by(|a, b| {
        (rank(a), std::cmp::Reverse(a.weight))
            .cmp(&(rank(b), std::cmp::Reverse(b.weight)))
            .then(a.off.total_cmp(&b.off))
    });
}

#[cfg(test)]
mod tests;
