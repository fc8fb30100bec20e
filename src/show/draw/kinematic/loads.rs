//! The arrows of a self-stress in a kinematic scheme, each on the loaded link, near the joint.

use crate::closure::contour::Contour;
use crate::draw::kinematic::Kinematic;
use crate::draw::kinematic::body::{Arrow, Load, arrow_outline};
use crate::draw::kinematic::moving::frame::Carried;
use crate::draw::place::projection::{along_z, frame_in_numbers, norm, scale as times};
use crate::draw::prelude::*;
use crate::format::decimals;
use crate::geom::expr::Expr;
use crate::redundancy::stress_loads::Borne;

/// The length of the greatest arrow, in pixels.
const LONGEST: f64 = 60.0;
/// Shorter ones are not seen.
const SHORTEST: f64 = 1.5;
/// How far from the joint an arrow begins, towards the middle of its link, so that one sees which link it loads.
const ASIDE: f64 = 15.0;
impl Kinematic<'_> {
    /// Returns the arrows of a self-stress on all links except the frame. Lengths have one scale, and moments are divided by
    /// the size of the mechanism.
    pub(super) fn arrows_of(&self, loads: &[Load], pose: Option<&Carried<'_>>) -> Vec<Arrow> {
        let m = self.subject.mechanism;
        let sizes = loads.iter();
        let sizes = sizes.flat_map(|(_, b)| [norm(b.force), norm(b.moment)]);
        let greatest = sizes.fold(0.0, f64::max);
        let mut out = Vec::new();
        for (id, b) in loads {
            let Some(i) = self.spots.iter().position(|s| s.joint == *id) else {
                continue;
            };
            let joint = &m.joints[*id];
            for (end, sign) in [(0, -1.0), (1, 1.0)] {
                if self.is_frame(joint.links[end]) {
                    continue;
                }
                let link = self.link_row(joint.links[end]);
                let at = self.beside_joint(link, self.places[i].point);
                let at = pose.map_or(at, |c| c.carried_point(joint.links[end], at));
                for (what, vector, turns) in [("force", b.force, false), ("moment", b.moment, true)]
                {
                    let along = times(vector, sign * LONGEST / greatest);
                    if norm(along) < SHORTEST {
                        continue;
                    }
                    let share = decimals(norm(vector) / greatest, 2);
                    let [link_id, joint_id] = [&m.links[joint.links[end]].id, &joint.id];
                    out.push(Arrow {
                        link,
                        at,
                        along,
                        turns,
                        tip: format!(
                            "{what} on link {link_id} at {joint_id}: {share} of the greatest"
                        ),
                    });
                }
            }
        }
        out
    }

    /// Returns the arrows of a self-stress in each of some poses, the pose of the file being that at `start`.
    pub(super) fn arrows_along(
        &self,
        stress: &SelfStress,
        poses: &[Carried<'_>],
        start: usize,
    ) -> Vec<Vec<Arrow>> {
        let (m, state) = (self.subject.mechanism, self.subject.state);
        let moved = |pose: &Carried<'_>| {
            let mut moved = m.clone();
            for (i, spot) in self.spots.iter().enumerate() {
                let (rides, guides) = self.carrier_links(i);
                let frame = &mut moved.edit().joints[spot.joint].frame;
                let place = pose.carried_place(rides, guides, &frame_in_numbers(frame));
                let exact = |v: Vector| v.map(|x| Expr::from_f64(x).unwrap_or(Expr::from(0)));
                frame.point = exact(place.point);
                (frame.axis, frame.reference) = (exact(place.z), exact(place.x));
            }
            moved
        };
        let moved: Vec<Mechanism> = poses.iter().map(moved).collect();
        let Some(found) = self.subject.analysis else {
            return Vec::new();
        };
        let contours = found.per_contour.iter().map(|c| c.contour.clone());
        let contours: Vec<Contour> = contours.collect();
        let (of, count) = ((state, &*contours), found.self_stresses.len());
        let loads = stress.loads_along((&moved, start), of, count);
        let arrows = |(c, all): (&Carried<'_>, &Vec<Borne>)| {
            let known = stress.joints.iter().filter(|_| !all.is_empty());
            let known: Vec<Load> = known.map(|w| (w.joint, all[w.joint])).collect();
            self.arrows_of(&known, Some(c))
        };
        poses.iter().zip(&loads).map(arrows).collect()
    }

    /// Returns a point slightly off a joint, towards the middle of a link.
    fn beside_joint(&self, link: usize, joint: Vector) -> Vector {
        let inward = sub(self.middle_in_space(link), joint);
        let far = norm(inward) * self.projection.scale;
        let share = if far > 0.0 {
            (ASIDE / far).min(0.5)
        } else {
            0.0
        };
        add(joint, times(inward, share))
    }

    /// Returns the shapes of an arrow on paper.
    pub(super) fn arrow_shapes(&self, arrow: &Arrow) -> Vec<Shape> {
        arrow_outline(
            self.projection.flat_point(arrow.at),
            arrow,
            &self.projection.view,
        )
    }

    /// Returns the rectangle that the arrows take.
    pub(super) fn arrow_room(&self, arrows: &[Arrow]) -> Option<Rect> {
        let shapes = arrows.iter().flat_map(|a| self.arrow_shapes(a));
        let points: Vec<Point> = shapes.flat_map(|s| s.path_points().to_vec()).collect();
        (!points.is_empty()).then(|| bounds_of(&points).grown_by(3.0))
    }

    pub(super) fn draw_arrows(&self, sheet: &mut Sheet) {
        for arrow in &self.arrows {
            let id = &self.subject.mechanism.links[self.links[arrow.link].0].id;
            sheet.draw_group("data-load", id, [0.0; 2], |s| {
                s.write_tip(&arrow.tip);
                s.draw_shapes(&self.arrow_shapes(arrow));
            });
        }
    }

    pub(super) fn arrow_rows(&self, arrows: &[Arrow]) -> Vec<(Swatch, String)> {
        let row = |turns: bool, text: &str| {
            let one = Arrow {
                link: 0,
                at: [0.0; 3],
                along: [26.0, 0.0, 0.0],
                turns,
                tip: String::new(),
            };
            let there = arrows.iter().any(|a| a.turns == turns);
            let drawn = arrow_outline([-13.0, 0.0], &one, &along_z());
            there.then(|| (Swatch::Shapes(drawn), text.to_owned()))
        };
        [
            row(
                false,
                "force on the link next to it; a point or a cross from its end",
            ),
            row(
                true,
                "moment about the arrow, divided by the mechanism's size; an arc from its end",
            ),
        ]
        .into_iter()
        .flatten()
        .collect()
    }
}
