//! The contours of a scheme: each tinted, where it has an area and where it has none.

use super::{Scheme, Share};
use crate::draw::sheet::Sheet;
use crate::draw::sheet::shapes::{HALF, grid_points, outline_sides, rounded_path};
use crate::svg::plane::{Point, is_inside, polygon_area, to_segment};

/// Half the width of the band of a contour without an area.
const BAND: f64 = 4.0;

impl Scheme<'_> {
    /// Returns the outline of a contour: its joints, and the bends of bars between them.
    pub(super) fn contour_outline(&self, c: usize) -> Vec<Point> {
        let of = &self.parts.graph.contours[c];
        let mut used = Vec::new();
        let mut out = Vec::new();
        for (i, &j) in of.iter().enumerate() {
            out.push(self.at.joints[j]);
            let next = of[(i + 1) % of.len()];
            let bent = (0..self.rings.len()).find(|l| {
                let ring = &self.rings[*l];
                let joins = ring.len() == 2 && ring.contains(&j) && ring.contains(&next);
                joins && j != next && !used.contains(l) && self.link_corners(*l).len() > 2
            });
            if let Some(l) = bent {
                used.push(l);
                out.push(self.at.hubs[l]);
            }
        }
        out
    }

    /// Returns the contours, the smallest last and so on top. Each segment has the colour of the contour next to it.
    pub(super) fn contours_by_size(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.parts.contours.len()).collect();
        let size = |c: usize| polygon_area(&self.contour_outline(c));
        order.sort_by(|&a, &b| size(b).total_cmp(&size(a)));
        order
    }

    /// Returns true if enough of a contour's area is visible between the links and next to smaller contours.
    pub(super) fn is_seen(&self, c: usize) -> bool {
        /// Square pixels.
        const ENOUGH: f64 = 150.0;
        const STEPS: usize = 24;
        let polygon = self.contour_outline(c);
        let own = polygon_area(&polygon);
        let smaller: Vec<Vec<Point>> = (0..self.parts.contours.len())
            .map(|other| self.contour_outline(other))
            .filter(|other| polygon_area(other) < own)
            .collect();
        let links: Vec<Vec<Point>> = (0..self.rings.len())
            .map(|l| self.link_corners(l))
            .collect();
        let all = grid_points(&polygon, STEPS);
        let cell = own / all.len().max(1) as f64;
        let covered = |p: Point| {
            smaller.iter().any(|s| is_inside(p, s))
                || links.iter().zip(&self.rings).any(|(corners, ring)| {
                    let filled = ring.len() > 2 && is_inside(p, corners);
                    filled
                        || outline_sides(corners)
                            .iter()
                            .any(|&(a, b)| to_segment(p, a, b) < HALF)
                })
        };
        let free = all.iter().filter(|p| !covered(**p)).count();
        free as f64 * cell > ENOUGH
    }

    /// Returns a contour without an area as a narrow band along it.
    pub(super) fn contour_band(&self, c: usize) -> String {
        let sides = outline_sides(&self.contour_outline(c));
        sides
            .iter()
            .map(|&(a, b)| rounded_path(&[a, b], BAND))
            .collect()
    }

    pub(super) fn draw_contour(&self, sheet: &mut Sheet, c: usize, d: &str) {
        let (contour, share) = &self.parts.contours[c];
        let redundant = share.map_or(0, |(r, _)| r).min(6);
        let words = Self::contour_words(c, &contour.name(self.subject.mechanism), *share);
        let number = (c + 1).to_string();
        sheet.draw_group("data-contour", &number, [0.0; 2], |s| {
            s.path_with_tip(&format!("s s{redundant}"), d, &words);
        });
    }

    /// Describes a contour in words.
    pub(super) fn contour_words(c: usize, name: &str, share: Share) -> String {
        match share {
            Some((r, (low, high))) if low != high => {
                format!("contour {}: {name}, σ = {r} ({low} to {high})", c + 1)
            }
            Some((r, _)) => format!("contour {}: {name}, σ = {r}", c + 1),
            None => format!("contour {}: {name}", c + 1),
        }
    }
}
