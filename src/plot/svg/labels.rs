//! Placement of labels, so that none overlaps another or a symbol.

use super::plane::{Point, Rect, plane_norm, segments_cross, sub};
use super::text::text_width;

/// A label to be placed.
#[derive(Clone, Debug)]
pub struct Wish {
    /// Its width.
    pub width: f64,
    /// Its height.
    pub height: f64,
    /// The point that it names.
    pub anchor: Point,
    /// Minimum distance from the anchor.
    pub clear: f64,
    /// Middles to try first, with their costs.
    pub first: Vec<(Point, f64)>,
}

impl Wish {
    /// Returns the wish of a text for a place at least `clear` away from its anchor.
    pub fn for_text(text: &str, size: f64, anchor: Point, clear: f64) -> Wish {
        Wish {
            width: text_width(text, size),
            height: size + 1.0,
            anchor,
            clear,
            first: Vec::new(),
        }
    }
}

/// The place of a label.
#[derive(Clone, Debug)]
pub struct LabelPlace {
    /// Its box.
    pub rect: Rect,
    /// A line to the anchor, or `None` if the label is near it.
    pub leader: Option<(Point, Point)>,
}

/// A line that labels should avoid, and its cost.
#[derive(Clone, Copy, Debug)]
pub struct AvoidedLine {
    pub ends: (Point, Point),
    pub weight: f64,
}

/// Cost of a line that no label may cross while there is room anywhere.
pub const CROSSED: f64 = 1000.0;
/// Cost of a leader across a label or a symbol.
const ON_LABEL: f64 = 100.0;
/// Maximum cost of a line for a leader across it.
const ACROSS: f64 = 1.6;
/// Minimum space between a label and its neighbours.
const GAP: f64 = 2.0;
/// A label farther than this from its anchor has a leader.
const NEAR: f64 = 9.0;
const ANGLES: usize = 24;

/// Finds a place for each label in turn. A label overlaps neither the boxes in `taken` nor earlier labels, and is added to `taken`.
pub fn place_labels(
    wishes: &[Wish],
    taken: &mut Vec<Rect>,
    lines: &[AvoidedLine],
) -> Vec<LabelPlace> {
    let mut lines = lines.to_vec();
    let mut out = Vec::new();
    for wish in wishes {
        let place = best_place(wish, taken, &lines);
        taken.push(place.rect);
        if let Some(ends) = place.leader {
            lines.push(AvoidedLine {
                ends,
                weight: CROSSED,
            });
        }
        out.push(place);
    }
    out
}

fn best_place(wish: &Wish, taken: &[Rect], lines: &[AvoidedLine]) -> LabelPlace {
    let cheaper = |a: &(f64, LabelPlace), b: &(f64, LabelPlace)| a.0.total_cmp(&b.0);
    let first = wish.first.iter().map(|&(middle, cost)| {
        let rect = Rect::around(middle, wish.width, wish.height);
        let cost = cost + crossed_weight(&rect, lines);
        (cost, LabelPlace { rect, leader: None })
    });
    let first = first.filter(|(_, place)| is_free(&place.rect, taken));
    let mut best = first.min_by(cheaper);
    let mut away = wish.clear + GAP + 0.5;
    let bounds = taken
        .iter()
        .fold(Rect::around(wish.anchor, 1.0, 1.0), |a, b| a.with(b));
    let farthest = plane_norm(sub(
        [bounds.left, bounds.top],
        [bounds.right, bounds.bottom],
    ));
    // outside of everything there always is room
    loop {
        let far = away - wish.clear;
        let ring = far * 0.06 + if far > NEAR { 1.5 } else { 0.0 };
        if let Some((least, place)) = &best
            && (*least <= ring || away >= farthest + 40.0 || farthest.is_nan())
        {
            return place.clone();
        }
        let tried = (0..ANGLES).filter_map(|step| {
            let angle = std::f64::consts::TAU * step as f64 / ANGLES as f64;
            let rect = beside_anchor(wish, angle, away);
            if !is_free(&rect, taken) {
                return None;
            }
            // level and upright places read best
            let slant = 0.25 * (2.0 * angle).sin().abs() + 0.05 * (1.0 - angle.cos());
            let leader = (far > NEAR).then(|| (wish.anchor, rect.nearest_point(wish.anchor)));
            let across = leader.map_or(0.0, |(a, b)| leader_cost(a, b, wish.anchor, taken, lines));
            let cost = ring + slant + crossed_weight(&rect, lines) + across;
            Some((cost, LabelPlace { rect, leader }))
        });
        best = best.into_iter().chain(tried).min_by(cheaper);
        away += 5.0 + 0.12 * far;
    }
}

/// Returns the box whose distance from the anchor is `away`, in a direction.
fn beside_anchor(wish: &Wish, angle: f64, away: f64) -> Rect {
    let (w, h) = (wish.width / 2.0, wish.height / 2.0);
    let (x, y) = (angle.cos(), angle.sin());
    // the middle lies on the outline of the rounded box of that distance
    let (mut low, mut high) = (0.0, away + w + h);
    for _ in 0..30 {
        let middle = (low + high) / 2.0;
        let (dx, dy) = (
            ((middle * x).abs() - w).max(0.0),
            ((middle * y).abs() - h).max(0.0),
        );
        if dx.hypot(dy) < away {
            low = middle;
        } else {
            high = middle;
        }
    }
    let middle = [wish.anchor[0] + high * x, wish.anchor[1] + high * y];
    Rect::around(middle, wish.width, wish.height)
}

fn is_free(rect: &Rect, taken: &[Rect]) -> bool {
    let grown = rect.grown_by(GAP);
    !taken.iter().any(|t| t.overlaps(&grown))
}

fn crossed_weight(rect: &Rect, lines: &[AvoidedLine]) -> f64 {
    let on = lines
        .iter()
        .filter(|l| rect.meets_segment(l.ends.0, l.ends.1));
    on.map(|l| l.weight).sum()
}

/// Returns the cost of a leader that crosses boxes and lines.
fn leader_cost(a: Point, b: Point, anchor: Point, taken: &[Rect], lines: &[AvoidedLine]) -> f64 {
    let boxes = taken
        .iter()
        .filter(|t| t.nearest_point(anchor) != anchor && t.meets_segment(a, b))
        .count();
    let lines = lines
        .iter()
        .filter(|l| segments_cross(a, b, l.ends.0, l.ends.1));
    ON_LABEL * boxes as f64 + lines.map(|l| 0.15 * l.weight.min(ACROSS)).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_of_one_point_keep_apart() {
        let wish = Wish {
            width: 60.0,
            height: 14.0,
            anchor: [100.0, 100.0],
            clear: 12.0,
            first: vec![([100.0, 100.0], 0.0)],
        };
        let symbol = Rect::around([100.0, 100.0], 24.0, 24.0);
        let mut taken = vec![symbol];
        let places = place_labels(&vec![wish; 40], &mut taken, &[]);
        for (i, a) in places.iter().enumerate() {
            assert!(!a.rect.overlaps(&symbol));
            assert!(!places[..i].iter().any(|b| b.rect.overlaps(&a.rect)));
        }
        assert!(places[0].leader.is_none());
        assert!(places[39].leader.is_some());
    }
}
