//! What no other is both faster and more often right than.

/// The places of those that are right more often than all faster ones, the fastest first, from (seconds, share).
#[must_use]
pub(super) fn front(points: &[(f64, f64)]) -> Vec<usize> {
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
