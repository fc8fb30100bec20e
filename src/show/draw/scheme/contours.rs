//! The contours of a scheme: each tinted, where it has an area and where it has none.

use super::{Scheme, Share};
use crate::draw::sheet::Sheet;
use crate::draw::sheet::shapes::{HALF, grid, outline, rounded};
use crate::svg::plane::{Point, area, inside, to_segment};

/// Half the width of the band of a contour without an area.
const BAND: f64 = 4.0;

impl Scheme<'_> {
    /// Returns the outline of a contour: its joints, and the bends of bars between them.
    pub(super) fn round(&self, c: usize) -> Vec<Point> {
        let of = &self.parts.graph.contours[c];
        let mut used = Vec::new();
        let mut out = Vec::new();
        for (i, &j) in of.iter().enumerate() {
            out.push(self.at.joints[j]);
            let next = of[(i + 1) % of.len()];
            let bent = (0..self.rings.len()).find(|l| {
                let ring = &self.rings[*l];
                let joins = ring.len() == 2 && ring.contains(&j) && ring.contains(&next);
                joins && j != next && !used.contains(l) && self.corners(*l).len() > 2
            });
            if let Some(l) = bent {
                used.push(l);
                out.push(self.at.hubs[l]);
            }
        }
        out
    }

    /// The contours, the smallest last and so on top: each stretch has the colour of the contour it is next to.
    pub(super) fn contours_by_size(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.parts.contours.len()).collect();
        let size = |c: usize| area(&self.round(c));
        order.sort_by(|&a, &b| size(b).total_cmp(&size(a)));
        order
    }

    /// Returns true if enough of a contour's area is visible between the links and next to smaller contours.
    pub(super) fn is_seen(&self, c: usize) -> bool {
        /// Square pixels.
        const ENOUGH: f64 = 150.0;
        const STEPS: usize = 24;
        let polygon = self.round(c);
        let own = area(&polygon);
        let smaller: Vec<Vec<Point>> = (0..self.parts.contours.len())
            .map(|other| self.round(other))
            .filter(|other| area(other) < own)
            .collect();
        let links: Vec<Vec<Point>> = (0..self.rings.len()).map(|l| self.corners(l)).collect();
        let all = grid(&polygon, STEPS);
        let cell = own / all.len().max(1) as f64;
        let covered = |p: Point| {
            smaller.iter().any(|s| inside(p, s))
                || links.iter().zip(&self.rings).any(|(corners, ring)| {
                    let filled = ring.len() > 2 && inside(p, corners);
                    filled
                        || outline(corners)
                            .iter()
                            .any(|&(a, b)| to_segment(p, a, b) < HALF)
                })
        };
        let free = all.iter().filter(|p| !covered(**p)).count();
        free as f64 * cell > ENOUGH
    }

    /// Returns a contour without an area as a narrow band along it.
    pub(super) fn band(&self, c: usize) -> String {
        let sides = outline(&self.round(c));
        sides.iter().map(|&(a, b)| rounded(&[a, b], BAND)).collect()
    }

    pub(super) fn draw_contour(&self, sheet: &mut Sheet, c: usize, d: &str) {
        let (contour, share) = &self.parts.contours[c];
        let redundant = share.map_or(0, |(r, _)| r).min(6);
        let words = Self::words(c, &contour.name(self.subject.mechanism), *share);
        let number = (c + 1).to_string();
        sheet.group("data-contour", &number, [0.0; 2], |s| {
            s.path_with_tip(&format!("s s{redundant}"), d, &words);
        });
    }

    /// A contour in words.
    pub(super) fn words(c: usize, name: &str, share: Share) -> String {
        match share {
            Some((r, (low, high))) if low != high => {
                format!("contour {}: {name}, σ = {r} ({low} to {high})", c + 1)
            }
            Some((r, _)) => format!("contour {}: {name}, σ = {r}", c + 1),
            None => format!("contour {}: {name}", c + 1),
        }
    }
}
