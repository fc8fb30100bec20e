//! Placement of names so that none touch each other.

use crate::svg::plane::Rect;

/// Returns heights at least `step` apart within `from..=to`, in the order of the requested ones and as near to them as
/// possible.
///
/// The requested heights must ascend. If there is too little space, the last ones go below it.
pub(super) fn spread(wishes: &[f64], step: f64, from: f64, to: f64) -> Vec<f64> {
    // least squares with a fixed order: pools of neighbours that push each other take their mean
    let mut pools: Vec<(f64, usize)> = Vec::new();
    for (n, wish) in wishes.iter().enumerate() {
        let mut pool = (wish - n as f64 * step, 1);
        while let Some(&(mean, count)) = pools.last() {
            if mean <= pool.0 {
                break;
            }
            let all = count + pool.1;
            pool = (
                (mean * count as f64 + pool.0 * pool.1 as f64) / all as f64,
                all,
            );
            pools.pop();
        }
        pools.push(pool);
    }
    let last = (to - wishes.len().saturating_sub(1) as f64 * step).max(from);
    let means = pools
        .iter()
        .flat_map(|&(mean, count)| std::iter::repeat_n(mean, count));
    means
        .enumerate()
        .map(|(n, mean)| mean.clamp(from, last) + n as f64 * step)
        .collect()
}

/// Returns the position for a name of the given width and height by each point: the first free one, or otherwise the
/// one that covers least.
pub(super) fn beside(points: &[(f64, f64)], sizes: &[(f64, f64)], room: Rect) -> Vec<Rect> {
    let mut taken: Vec<Rect> = points
        .iter()
        .map(|&(x, y)| Rect::around([x, y], 12.0, 12.0))
        .collect();
    let mut out = Vec::new();
    for (&(x, y), &(w, h)) in points.iter().zip(sizes) {
        let mut best: Option<(f64, Rect)> = None;
        for away in [9.0, 22.0, 36.0, 52.0, 70.0, 90.0, 112.0] {
            let (left, right, middle) = (x - away - w, x + away, x - w / 2.0);
            let (above, below, level) = (y - away - h, y + away, y - h / 2.0);
            let corner = 0.6 * away;
            let near = [
                (right, level),
                (left, level),
                (middle, above),
                (middle, below),
                (x + corner, y - corner - h),
                (x + corner, y + corner),
                (x - corner - w, y - corner - h),
                (x - corner - w, y + corner),
            ];
            for (a, b) in near {
                let rect = Rect {
                    left: a,
                    top: b,
                    right: a + w,
                    bottom: b + h,
                };
                if !rect.within(&room) {
                    continue;
                }
                let covered = taken.iter().map(|t| rect.overlap(t)).sum::<f64>();
                if best.is_none_or(|(least, _)| covered < least) {
                    best = Some((covered, rect));
                }
            }
            if best.is_some_and(|(covered, _)| covered == 0.0) {
                break;
            }
        }
        // a name wider than the space starts at its left edge
        let rect = best.map_or(
            Rect {
                left: room.left,
                top: y - h / 2.0,
                right: room.left + w,
                bottom: y + h / 2.0,
            },
            |(_, r)| r,
        );
        taken.push(rect);
        out.push(rect);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_keep_apart_and_near() {
        assert_eq!(spread(&[10.0, 50.0], 16.0, 0.0, 100.0), [10.0, 50.0]);
        assert_eq!(spread(&[50.0, 50.0], 16.0, 0.0, 100.0), [42.0, 58.0]);
        assert_eq!(
            spread(&[99.0, 100.0, 100.0], 10.0, 0.0, 100.0),
            [80.0, 90.0, 100.0]
        );
        assert_eq!(spread(&[1.0, 2.0], 10.0, 0.0, 5.0), [0.0, 10.0]);
        assert!(spread(&[], 10.0, 0.0, 5.0).is_empty());
    }

    #[test]
    fn names_of_points_in_one_place_do_not_cover_each_other() {
        let points = [(100.0, 100.0); 8];
        let places = beside(
            &points,
            &[(60.0, 14.0); 8],
            Rect::around([150.0; 2], 300.0, 300.0),
        );
        for (n, a) in places.iter().enumerate() {
            assert!(
                places[..n].iter().all(|b| a.overlap(b) == 0.0),
                "{places:?}"
            );
        }
    }
}
