//! Directions defined only by points: lines through three points or along two rods, and planes through four points.

use super::directions::Direction;
use super::projection::Projection;
use super::written::{PointPair, distinct_pairs};
use crate::geom::vector::{Vector, add_scaled, cross, dot, length, sub, unit};
use std::collections::BTreeMap;

/// Maximum number of points among which lines and planes are sought.
const MOST: usize = 60;

fn direction_of_points(unit: Vector, error: f64, plane: bool) -> Direction {
    Direction {
        plane,
        ..Direction::of_points(unit, error)
    }
}

/// Returns lines with at least two pairs of points along them that no accepted relation makes parallel, the most
/// frequent first.
pub(super) fn lines_of(at: &Projection<'_>, errors: &[f64]) -> Vec<Direction> {
    let points = &at.points;
    if points.len() > MOST {
        return Vec::new();
    }
    let pairs = distinct_pairs(points, errors);
    let units: Vec<Vector> = pairs.iter().map(|p| unit(p.along)).collect();
    let mut used = vec![false; pairs.len()];
    let mut found: Vec<(usize, Direction)> = Vec::new();
    for i in 0..pairs.len() {
        if used[i] {
            continue;
        }
        let parallel = |&j: &usize| {
            let within = pairs[i].error / pairs[i].length + pairs[j].error / pairs[j].length;
            !used[j] && length(cross(units[i], units[j])) <= within
        };
        let alike: Vec<usize> = (i + 1..pairs.len()).filter(parallel).collect();
        if alike.is_empty() {
            continue;
        }
        let (mut sum, mut weight, mut open) = ([0.0; 3], 0.0, false);
        for &j in alike.iter().chain([&i]) {
            used[j] = true;
            let p: &PointPair = &pairs[j];
            let w = (p.length / p.error).powi(2);
            sum = add_scaled(sum, w * dot(units[i], units[j]).signum(), units[j]);
            weight += w;
            open |= j != i && !parallel_already(at, &pairs[i], p);
        }
        if open {
            found.push((
                alike.len(),
                direction_of_points(unit(sum), weight.sqrt().recip(), false),
            ));
        }
    }
    found.sort_by_key(|(n, _)| std::cmp::Reverse(*n));
    found.into_iter().map(|(_, d)| d).collect()
}

/// Returns true if accepted relations already make two pairs parallel.
fn parallel_already(at: &Projection<'_>, a: &PointPair, b: &PointPair) -> bool {
    let [v, w] = [a, b].map(|p| p.along);
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        .iter()
        .all(|e| {
            // The derivatives of e · (v × w) with respect to v and w.
            let (by_v, by_w) = (cross(w, *e), cross(*e, v));
            let minus = |x: Vector| x.map(|c| -c);
            let gradients = [
                (a.ends[1], by_v),
                (a.ends[0], minus(by_v)),
                (b.ends[1], by_w),
                (b.ends[0], minus(by_w)),
            ];
            at.implies_moves(&gradients) || gradients.iter().all(|g| length(g.1) < 1e-9 * length(v))
        })
}

/// Returns normals of planes through four points that no accepted relation keeps in a plane, the most frequent first.
pub(super) fn planes_of(at: &Projection<'_>, errors: &[f64]) -> Vec<Direction> {
    let points = &at.points;
    let n = points.len();
    if n > MOST {
        return Vec::new();
    }
    let mut found: Vec<(usize, Vector, f64)> = Vec::new();
    // Planes that were analysed, each with one of its points. Three other points of the same plane add nothing. They
    // are ordered by the size of a component of the normal, since parallel normals have nearly the same. The bits of a
    // nonnegative float have the order of its values.
    let mut seen: BTreeMap<(u64, usize), (Vector, usize)> = BTreeMap::new();
    for i in 0..n {
        for j in 0..i {
            for k in 0..j {
                let (a, b) = (sub(points[i], points[k]), sub(points[j], points[k]));
                let area = cross(a, b);
                let longest = length(a).max(length(b)).max(length(sub(a, b)));
                let least = length(area) / longest;
                let error = 2.0 * (errors[i] + errors[j] + errors[k]);
                if least < 100.0 * error {
                    continue;
                }
                let (normal, off) = (unit(area), error / least);
                if found.iter().any(|f| length(cross(f.1, normal)) < 2.0 * off) {
                    continue;
                }
                let known = |(_, s): (&(u64, usize), &(Vector, usize))| {
                    let w = sub(points[k], points[s.1]);
                    length(cross(s.0, normal)) < 2.0 * off
                        && dot(s.0, w).abs() <= 2.0 * off * length(w) + errors[k]
                };
                let size = |more: f64| (normal[0].abs() + more).max(0.0).to_bits();
                let near = (size(-3.0 * off), 0)..=(size(3.0 * off), usize::MAX);
                if seen.range(near).any(known) {
                    continue;
                }
                seen.insert((size(0.0), seen.len()), (normal, k));
                let mut places = 0;
                for l in 0..n {
                    let w = sub(points[l], points[k]);
                    let near = [i, j, k].iter().any(|&m| {
                        length(sub(points[l], points[m])) <= 10.0 * (errors[l] + errors[m])
                    });
                    if near || dot(normal, w).abs() > off * length(w) + errors[l] {
                        continue;
                    }
                    // The derivatives of the volume of the four with respect to each of them.
                    let (by_a, by_b, by_w) = (cross(b, w), cross(w, a), area);
                    let sum = [0, 1, 2].map(|c| -(by_a[c] + by_b[c] + by_w[c]));
                    if !at.implies_moves(&[(i, by_a), (j, by_b), (l, by_w), (k, sum)]) {
                        places += 1;
                    }
                }
                if places > 0 {
                    found.push((places, normal, off));
                }
            }
        }
    }
    found.sort_by_key(|f| std::cmp::Reverse(f.0));
    found
        .into_iter()
        .map(|(_, v, e)| direction_of_points(v, e, true))
        .collect()
}
