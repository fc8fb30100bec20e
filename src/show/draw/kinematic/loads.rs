//! The arrows of a self-stress in a kinematic scheme, each on the loaded link, near the joint.

use super::Kinematic;
use super::arrow::{Arrow, arrow_outline};
use crate::draw::place::projection::sub as sub3;
use crate::draw::place::projection::{Vector, add as add3, along_z, norm as norm3, scale as times};
use crate::draw::sheet::{Shape, Sheet, Swatch};
use crate::format::decimals;
use crate::redundancy::stress::SelfStress;
use crate::svg::plane::{Point, Rect, bounds_of};

/// The length of the greatest arrow, in pixels.
const LONGEST: f64 = 60.0;
/// Shorter ones are not seen.
const SHORTEST: f64 = 1.5;
/// How far from the joint an arrow begins, towards the middle of its link, so that one sees which link it loads.
const ASIDE: f64 = 15.0;
impl Kinematic<'_> {
    /// Returns the arrows of a self-stress on all links except the frame. Lengths have one scale, and moments are divided by
    /// the size of the mechanism.
    pub(super) fn arrows_of(&self, stress: &SelfStress) -> Vec<Arrow> {
        let m = self.subject.mechanism;
        let borne = stress.joints.iter().filter_map(|w| Some((w, w.borne?)));
        let sizes = borne
            .clone()
            .flat_map(|(_, b)| [norm3(b.force), norm3(b.moment)]);
        let greatest = sizes.fold(0.0, f64::max);
        let mut out = Vec::new();
        for (wrench, b) in borne {
            let Some(i) = self.spots.iter().position(|s| s.joint == wrench.joint) else {
                continue;
            };
            let joint = &m.joints[wrench.joint];
            for (end, sign) in [(0, -1.0), (1, 1.0)] {
                if self.is_frame(joint.links[end]) {
                    continue;
                }
                let link = self.link_row(joint.links[end]);
                for (what, vector, turns) in [("force", b.force, false), ("moment", b.moment, true)]
                {
                    let along = times(vector, sign * LONGEST / greatest);
                    if norm3(along) < SHORTEST {
                        continue;
                    }
                    let share = decimals(norm3(vector) / greatest, 2);
                    let [link_id, joint_id] = [&m.links[joint.links[end]].id, &joint.id];
                    out.push(Arrow {
                        link,
                        at: self.beside_joint(link, self.places[i].point),
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

    /// Returns a point slightly off a joint, towards the middle of a link.
    fn beside_joint(&self, link: usize, joint: Vector) -> Vector {
        let inward = sub3(self.middle_in_space(link), joint);
        let far = norm3(inward) * self.projection.scale;
        let share = if far > 0.0 {
            (ASIDE / far).min(0.5)
        } else {
            0.0
        };
        add3(joint, times(inward, share))
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
