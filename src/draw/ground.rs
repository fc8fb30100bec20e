//! What a kinematic scheme adds to the coordinates: the ground, and room between joints of one point.

use super::projection::{self, View, bounds};
use super::sheet::Sheet;
use crate::model::mechanism::LinkId;
use crate::svg::plane::{Point, Rect, add, dot, mean, norm, polyline, scale, sub, unit};
use std::f64::consts::TAU;

/// Joints of one point are drawn so far from it.
const APART: f64 = 17.0;
/// The ground at a joint: from the joint to the middle of the hatched line.
pub(super) struct Ground {
    pub(super) from: Point,
    pub(super) to: Point,
}

impl Ground {
    fn across(&self) -> (Point, Point) {
        let out = unit(sub(self.to, self.from));
        ([-out[1], out[0]], out)
    }

    pub(super) fn rect(&self) -> Rect {
        let (side, out) = self.across();
        let far = add(self.to, scale(out, 6.0));
        let corners = [
            add(self.to, scale(side, 11.0)),
            sub(self.to, scale(side, 11.0)),
            add(far, scale(side, 14.0)),
            sub(far, scale(side, 14.0)),
        ];
        bounds(&corners)
    }

    pub(super) fn draw(&self, sheet: &mut Sheet) {
        let (side, out) = self.across();
        sheet.line("bone", self.from, self.to);
        sheet.line(
            "bone",
            add(self.to, scale(side, 11.0)),
            sub(self.to, scale(side, 11.0)),
        );
        let mut d = String::new();
        for i in 0..5 {
            let a = add(self.to, scale(side, 10.0 - 5.0 * f64::from(i)));
            let b = add(add(a, scale(out, 6.0)), scale(side, -4.0));
            d += &polyline(&[a, b], false);
        }
        sheet.path("fine", &d);
    }
}

/// How much two directions are one.
fn beside(dir: Point, other: Point) -> f64 {
    let along = dot(dir, unit(other));
    if along > 0.5 { along } else { 0.0 }
}

/// The ground at each joint of the frame, where there is most room; the free ends of links are given with their joints.
pub(super) fn grounds(
    spots: &[(Point, Rect)],
    links: &[(LinkId, Vec<usize>)],
    frame: LinkId,
    loose: &[(usize, Point)],
) -> Vec<Ground> {
    let mut out: Vec<Ground> = Vec::new();
    let Some((_, of)) = links.iter().find(|(l, _)| *l == frame) else {
        return out;
    };
    for &i in of {
        let (at, room) = spots[i];
        let reach = (room.right - room.left).min(room.bottom - room.top) / 2.0 + 9.0;
        let mut best: Option<(f64, Ground)> = None;
        for step in 0..16 {
            let angle = TAU * f64::from(step) / 16.0;
            let dir = [angle.cos(), angle.sin()];
            let to = add(at, scale(dir, reach));
            let ground = Ground { from: at, to };
            // straight down is best, then what is clear
            let aslant = if step % 4 == 0 { 0.0 } else { 0.9 };
            let mut cost = 0.25 * (1.0 - dir[1]) + aslant;
            let near = ground.rect().grown(1.0);
            for (_, other) in spots.iter().filter(|(p, _)| *p != at) {
                cost += if near.overlaps(other) { 4.0 } else { 0.0 };
            }
            cost += 3.0 * out.iter().filter(|g| g.rect().overlaps(&near)).count() as f64;
            for (_, other) in links.iter().filter(|(l, o)| *l != frame && o.contains(&i)) {
                for &j in other.iter().filter(|&&j| j != i) {
                    cost += 2.5 * beside(dir, sub(spots[j].0, at));
                }
            }
            for (_, end) in loose.iter().filter(|(j, _)| *j == i) {
                cost += 2.5 * beside(dir, sub(*end, at));
            }
            if best.as_ref().is_none_or(|(least, _)| cost < least - 1e-9) {
                best = Some((cost, ground));
            }
        }
        out.extend(best.map(|(_, g)| g));
    }
    out
}

/// Parts joints that lie in one place on paper, each towards its links; sliding pairs along their axes.
pub(super) fn part(
    at: &mut [Point],
    links: &[(LinkId, Vec<usize>)],
    places: &[projection::Place],
    view: &View,
) -> bool {
    let old = at.to_vec();
    let mut done = vec![false; at.len()];
    let mut any = false;
    for i in 0..old.len() {
        let group: Vec<usize> = (i..old.len())
            .filter(|&k| !done[k] && norm(sub(old[k], old[i])) < 3.0)
            .collect();
        if done[i] || group.len() < 2 {
            continue;
        }
        any = true;
        let mut wishes: Vec<(f64, usize)> = group
            .iter()
            .map(|&k| {
                done[k] = true;
                let others = links.iter().filter(|(_, of)| of.contains(&k));
                let others = others.flat_map(|(_, of)| of).filter(|o| !group.contains(o));
                let toward = mean(others.map(|&o| unit(sub(old[o], old[k]))));
                let toward = if norm(toward) > 1e-6 {
                    toward
                } else {
                    view.flat(places[k].z)
                };
                (toward[1].atan2(toward[0]), k)
            })
            .collect();
        wishes.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let n = wishes.len() as f64;
        let reach = APART / (std::f64::consts::PI / n).sin();
        // the turn that suits all best
        let slots = (0..wishes.len()).map(|s| TAU * s as f64 / n);
        let off: Point = mean(slots.zip(&wishes).map(|(slot, (angle, _))| {
            let d = angle - slot;
            [d.cos(), d.sin()]
        }));
        let turn = if norm(off) > 1e-6 {
            off[1].atan2(off[0])
        } else {
            0.4
        };
        for (s, (_, k)) in wishes.iter().enumerate() {
            let angle = turn + TAU * s as f64 / n;
            at[*k] = add(old[*k], [reach * angle.cos(), reach * angle.sin()]);
        }
    }
    any
}
