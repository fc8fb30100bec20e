//! Placement of the names of joints and links and of the numbers of contours.

use crate::draw::naming::{Name, place_names};
use crate::draw::prelude::*;
use crate::draw::scheme::{Scheme, Share};
use crate::draw::sheet::shapes::{HALF, grid_points, rounded_path};
use crate::svg::labels::{AvoidedLine, LabelPlace, Wish};
use crate::svg::plane::{polygon_area, sides_of};

impl Scheme<'_> {
    /// Returns the places and texts of the ids of joints and links and of the numbers of contours, in this order.
    pub(super) fn place_labels(&self) -> Vec<(LabelPlace, Name)> {
        let around = |i| {
            let side = 2.0 * self.joint_radius(i);
            Rect::around(self.at.joints[i], side, side)
        };
        let mut taken: Vec<Rect> = (0..self.joints.len()).map(around).collect();
        let lines = self.link_lines();
        // ids stay off links, numbers of contours off nothing but labels
        let at_hub = |l: usize, _| (self.at.hubs[l], HALF, self.inside_link(l));
        let names = self.subject.link_names(&self.links, at_hub);
        let links = place_names(names, &mut taken, &[]);
        let contours = place_names(self.contour_numbers(), &mut taken, &lines);
        let beside = |(i, &j)| (j, self.at.joints[i], self.joint_radius(i));
        let spots: Vec<_> = self.joints.iter().enumerate().map(beside).collect();
        let joints = place_names(self.subject.joint_names(&spots), &mut taken, &lines);
        [joints, links, contours].concat()
    }

    /// Returns the lines of links, which labels avoid: from the hub to the corners, and around the link.
    fn link_lines(&self) -> Vec<AvoidedLine> {
        let mut lines = Vec::new();
        for l in 0..self.rings.len() {
            let corners = self.link_corners(l);
            let frame = self.subject.mechanism.links[self.links[l]].role == Role::Frame;
            let weight = if frame || corners.len() < 3 { 2.5 } else { 0.6 };
            let hub = self.at.hubs[l];
            lines.extend(corners.iter().map(|&corner| AvoidedLine {
                ends: (hub, corner),
                weight,
            }));
            for (a, b) in sides_of(&corners) {
                let along = unit(sub(b, a));
                let off = scale([-along[1], along[0]], HALF);
                for side in [off, scale(off, -1.0)] {
                    // the inner one is no line where the link is a polygon
                    let middle = add(scale(add(a, b), 0.5), side);
                    if corners.len() < 3 || !is_inside(middle, &corners) {
                        lines.push(AvoidedLine {
                            ends: (add(a, side), add(b, side)),
                            weight: 2.0,
                        });
                    }
                }
            }
        }
        lines
    }

    /// Returns the numbers of contours, each placed inside its contour.
    fn contour_numbers(&self) -> Vec<Name> {
        let one = |c: usize| {
            let text = format!("{}", c + 1);
            let first = self.inside_contour(c);
            let wish = Wish {
                width: text_width(&text, SMALL) + 8.0,
                height: 16.0,
                anchor: first.first().map_or([0.0, 0.0], |f| f.0),
                clear: 0.0,
                first,
            };
            Name {
                wish,
                ..Name::small("small".to_owned(), text, [0.0; 2], 0.0)
            }
        };
        (0..self.contours.len()).map(one).collect()
    }

    /// Middles for the id within a link, the best first.
    fn inside_link(&self, l: usize) -> Vec<(Point, f64)> {
        let corners = self.link_corners(l);
        if corners.len() > 2 && self.rings[l].len() > 2 {
            let grid = grid_points(&corners, 9);
            let mut out: Vec<(Point, f64)> = grid
                .into_iter()
                .map(|p| (p, 0.3 + 0.004 * plane_norm(sub(p, self.at.hubs[l]))))
                .collect();
            out.insert(
                0,
                (
                    self.at.hubs[l],
                    if is_inside(self.at.hubs[l], &corners) {
                        0.0
                    } else {
                        2.0
                    },
                ),
            );
            return out;
        }
        let mut out = Vec::new();
        for (a, b) in sides_of(&corners) {
            for (step, t) in [0.5, 0.44, 0.56, 0.38, 0.62, 0.32, 0.68].iter().enumerate() {
                let p = add(a, scale(sub(b, a), *t));
                out.push((p, 0.05 * step as f64));
            }
        }
        if corners.len() > 2 {
            out.insert(0, (corners[1], 0.0));
        }
        if self.rings[l].len() == 1 {
            out.insert(0, (self.at.hubs[l], 0.0));
        }
        out
    }

    /// Middles for the number within a contour, the best first: on its own tint if any of that can be seen, near to what is its own.
    fn inside_contour(&self, c: usize) -> Vec<(Point, f64)> {
        let (of, before) = (&self.graph.contours[c], &self.graph.contours[..c]);
        let polygon = self.contour_outline(c);
        let own = of.iter().filter(|j| !before.iter().any(|b| b.contains(j)));
        let own: Vec<Point> = own.map(|&j| self.at.joints[j]).collect();
        let own = if own.is_empty() { &polygon } else { &own };
        let own = mean(own.iter().copied());
        let (mut points, _) = self.free_points(c);
        if points.is_empty() {
            points = grid_points(&polygon, STEPS);
        }
        let sides = self.all_sides();
        let near = points.into_iter().map(|p| (p, side_distance(p, &sides)));
        let near = near.filter(|(_, d)| *d > 14.0).map(|(p, d)| {
            let crowded = 0.02 * (40.0 - d).max(0.0);
            (p, crowded + 0.012 * plane_norm(sub(p, own)))
        });
        let mut out: Vec<(Point, f64)> = near.collect();
        out.sort_by(|a, b| a.1.total_cmp(&b.1));
        if out.is_empty() {
            out.push((mean(polygon.iter().copied()), 3.0));
        }
        out
    }

    /// Returns the sides of all links.
    fn all_sides(&self) -> Vec<(Point, Point)> {
        let links = 0..self.rings.len();
        let corners = links.map(|l| self.link_corners(l)).collect::<Vec<_>>();
        corners.iter().flat_map(|c| sides_of(c)).collect()
    }

    /// Returns points of a contour that lie in no smaller contour and on no link, and the area in square pixels that each stands for.
    fn free_points(&self, c: usize) -> (Vec<Point>, f64) {
        let polygon = self.contour_outline(c);
        let own = polygon_area(&polygon);
        let contours = 0..self.contours.len();
        let smaller = contours.map(|other| self.contour_outline(other));
        let smaller = smaller.filter(|other| polygon_area(other) < own);
        let plates = (0..self.rings.len()).filter(|&l| self.rings[l].len() > 2);
        let covers = smaller.chain(plates.map(|l| self.link_corners(l)));
        let (covers, sides): (Vec<Vec<Point>>, _) = (covers.collect(), self.all_sides());
        let mut points = grid_points(&polygon, STEPS);
        let cell = own / points.len().max(1) as f64;
        points.retain(|&p| {
            side_distance(p, &sides) >= HALF && !covers.iter().any(|cover| is_inside(p, cover))
        });
        (points, cell)
    }
}

/// The points across a contour at which its visible part is looked for.
const STEPS: usize = 24;

/// Returns the distance of a point from the nearest side.
fn side_distance(p: Point, sides: &[(Point, Point)]) -> f64 {
    let each = sides.iter().map(|&(a, b)| to_segment(p, a, b));
    each.fold(f64::INFINITY, f64::min)
}

/// Half the width of the band of a contour without an area.
const BAND: f64 = 4.0;

impl Scheme<'_> {
    /// Returns the outline of a contour: its joints, and the bends of bars between them.
    pub(super) fn contour_outline(&self, c: usize) -> Vec<Point> {
        let of = &self.graph.contours[c];
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
        let mut order: Vec<usize> = (0..self.contours.len()).collect();
        let size = |c: usize| polygon_area(&self.contour_outline(c));
        order.sort_by(|&a, &b| size(b).total_cmp(&size(a)));
        order
    }

    /// Returns true if enough of a contour's area is visible between the links and next to smaller contours.
    pub(super) fn is_seen(&self, c: usize) -> bool {
        /// Square pixels.
        const ENOUGH: f64 = 150.0;
        let (free, cell) = self.free_points(c);
        free.len() as f64 * cell > ENOUGH
    }

    /// Returns a contour without an area as a narrow band along it.
    pub(super) fn contour_band(&self, c: usize) -> String {
        let outline = self.contour_outline(c);
        let sides = sides_of(&outline);
        sides.map(|(a, b)| rounded_path(&[a, b], BAND)).collect()
    }

    pub(super) fn draw_contour(&self, sheet: &mut Sheet, c: usize, d: &str) {
        let (contour, share) = &self.contours[c];
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
