//! Directions defined only by points: lines through three points or along two rods.

use super::directions::Direction;
use super::projection::Projection;
use super::written::{PointPair, distinct_pairs};
use crate::geom::vector::{Vector, add_scaled, cross, dot, length, unit};

/// Maximum number of points among which lines are sought.
const MOST: usize = 60;

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
                Direction::of_points(unit(sum), weight.sqrt().recip()),
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
