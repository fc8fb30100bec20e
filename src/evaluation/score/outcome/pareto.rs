//! Fronts: of variants that no other is better than in every term, and of what no other is both faster and more often right than.

/// Returns true if `a` is nowhere worse than `b` and better in at least one value.
///
/// # Examples
/// ```
/// use ozols::score::outcome::pareto::dominates;
/// assert!(dominates(&[1.0, 2.0], &[1.0, 3.0]));
/// assert!(!dominates(&[1.0, 3.0], &[2.0, 2.0])); // Better in one term, worse in the other.
/// ```
pub fn dominates(a: &[f64], b: &[f64]) -> bool {
    a.iter().zip(b).all(|(x, y)| x <= y) && a.iter().zip(b).any(|(x, y)| x < y)
}

/// Returns the front of each point, from 0, until `enough` points have one. Front 0 has the points that none dominates, the
/// next those that only earlier fronts dominate, and so on. `None` for the rest. Smaller is better.
///
/// # Complexity
/// O(n · front · terms) a front, after sorting.
///
/// # Examples
/// ```
/// use ozols::score::outcome::pareto::fronts;
/// let points = [vec![1.0, 3.0], vec![2.0, 2.0], vec![3.0, 3.0]];
/// assert_eq!(fronts(&points, 3), [Some(0), Some(0), Some(1)]);
/// ```
pub fn fronts(points: &[Vec<f64>], enough: usize) -> Vec<Option<usize>> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    // A point can be dominated only by those before it in this order.
    let key = |a: usize, b: usize| {
        let pairs = points[a].iter().zip(&points[b]);
        let mut differing = pairs.map(|(x, y)| x.total_cmp(y)).filter(|o| o.is_ne());
        differing.next().unwrap_or(std::cmp::Ordering::Equal)
    };
    order.sort_by(|&a, &b| key(a, b).then(a.cmp(&b)));
    let mut out = vec![None; points.len()];
    let (mut given, mut front) = (0, 0);
    while given < enough.min(points.len()) {
        let mut members: Vec<usize> = Vec::new();
        for &i in &order {
            let better = |&m: &usize| dominates(&points[m], &points[i]);
            if out[i].is_none() && !members.iter().any(better) {
                members.push(i);
            }
        }
        for &i in &members {
            out[i] = Some(front);
        }
        given += members.len();
        front += 1;
        if members.is_empty() {
            break;
        }
    }
    out
}

/// Returns the indices of the points that are right more often than all faster ones, the fastest first. Points are (seconds,
/// share).
pub(crate) fn front(points: &[(f64, f64)]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&a, &b| {
        let ((t, share), (u, other)) = (points[a], points[b]);
        t.total_cmp(&u).then(other.total_cmp(&share))
    });
    let mut best = f64::NEG_INFINITY;
    order.retain(|&i| {
        let ahead = points[i].1 > best;
        best = best.max(points[i].1);
        ahead
    });
    order
}
