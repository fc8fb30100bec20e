//! The symbol of a joint at its place: with the ring of a drive, within others that stand there, and in place of another.

use crate::draw::place::projection::{JointInSpace, ONE_PLACE, View};
use crate::draw::sheet::{Shape, Sheet};
use crate::draw::subject::{Mark, Subject};
use crate::draw::symbol::pieces::{PaperPose, Piece};
use crate::draw::symbol::{drive, symbols};
use crate::model::joint_type::JointType;
use crate::model::mechanism::{Joint, JointId, JointOption};
use crate::svg::plane::{Point, Rect, norm, sub};

/// The symbol of a joint round the origin.
pub(in crate::draw) struct Symbol {
    of: JointType,
    pose: PaperPose,
    shapes: Vec<Shape>,
    /// How many times the usual size it is.
    pub(in crate::draw) size: f64,
    pub(in crate::draw) room: Rect,
    /// The radius of the ring of a drive that turns.
    pub(in crate::draw) ring: Option<f64>,
    /// The axis that a driven slide goes along.
    pub(in crate::draw) slide: Option<usize>,
}

impl Symbol {
    pub(in crate::draw) fn new(
        subject: &Subject<'_>,
        joint: JointId,
        of: &JointType,
        place: &JointInSpace,
        view: &View,
        size: f64,
        slide: Option<usize>,
    ) -> Symbol {
        let pose = PaperPose::new(place, view);
        let shapes = symbols::symbol(of, &pose, "", size);
        let own = symbols::extent(&shapes);
        let reach = (own.right - own.left).max(own.bottom - own.top) / 2.0 + 3.0;
        let joint = &subject.mechanism.joints[joint];
        let ring = (joint.drive && slide.is_none()).then_some(reach.min(14.0 * size));
        let mut room = own;
        if let Some(r) = ring {
            room = room.with(&Rect::around([0.0; 2], 2.0 * r + 5.4, 2.0 * r + 5.4));
        }
        if let Some(axis) = slide {
            let arrow = drive::straight(axis);
            let arrow: Vec<Shape> = arrow
                .iter()
                .filter_map(|p| p.shape(&pose, "", size))
                .collect();
            room = room.with(&symbols::extent(&arrow));
        }
        Symbol {
            of: of.clone(),
            pose,
            shapes,
            size,
            room,
            ring,
            slide,
        }
    }

    pub(in crate::draw) fn marked(mut self, mark: Mark) -> Symbol {
        self.shapes = symbols::symbol(&self.of, &self.pose, mark.class(), self.size);
        self
    }

    /// Its shapes in the usual size, without a mark.
    pub(in crate::draw) fn plain(&self) -> Vec<Shape> {
        symbols::symbol(&self.of, &self.pose, "", 1.0)
    }

    /// How far it reaches from its middle.
    pub(in crate::draw) fn reach(&self) -> f64 {
        let r = &self.room;
        [-r.left, -r.top, r.right, r.bottom]
            .into_iter()
            .fold(0.0, f64::max)
    }

    pub(in crate::draw) fn draw(
        &self,
        sheet: &mut Sheet,
        subject: &Subject<'_>,
        joint: JointId,
        mark: Mark,
    ) {
        let (below, above) = self.round(subject, joint, mark);
        sheet.shapes(&below, [0.0; 2]);
        sheet.shapes(&self.shapes, [0.0; 2]);
        let arrow = self.arrow();
        let arrow = arrow.iter();
        let arrow = arrow.filter_map(|p| p.shape(&self.pose, mark.class(), self.size));
        sheet.shapes(&arrow.collect::<Vec<_>>(), [0.0; 2]);
        sheet.shapes(&above, [0.0; 2]);
    }

    /// The straight arrow of a driven slide.
    pub(in crate::draw) fn arrow(&self) -> Vec<Piece> {
        self.slide.map(drive::straight).unwrap_or_default()
    }

    /// What stands round the symbol, below and above it, and is turned to the reader always.
    pub(in crate::draw) fn round(
        &self,
        subject: &Subject<'_>,
        joint: JointId,
        mark: Mark,
    ) -> (Vec<Shape>, Vec<Shape>) {
        let drive = |r| drive::round(mark.class(), r);
        let only_here = subject.only_here(joint).then(|| Shape::Circle {
            at: [0.0; 2],
            radius: self.ring.unwrap_or(10.0 * self.size) + 2.5,
            class: "fine dash".to_owned(),
        });
        let below = self.ring.map(drive).unwrap_or_default();
        (below, only_here.into_iter().collect())
    }
}

/// A joint in place of another, so that a page can show any redesign in one drawing of the mechanism as it is.
#[derive(Debug, Clone, Copy)]
pub struct Swap<'a> {
    /// The place.
    pub joint: JointId,
    /// What is put there.
    pub option: &'a JointOption,
    /// Whether an unloading joint is put in series with it: a ring stands for that.
    pub unloading: bool,
}

/// The mark of an unloading joint round a symbol of some reach.
pub(in crate::draw) fn ring(reach: f64) -> Shape {
    Shape::Circle {
        at: [0.0; 2],
        radius: reach + 4.0,
        class: "line new".to_owned(),
    }
}

/// How much larger the next joint outwards is, so that the outline of each is seen.
const STEP: f64 = 0.6;

/// How many times its usual size each joint is drawn: those in one place on paper within each other, a multiple joint as concentric
/// circles, a pin on its block.
pub(in crate::draw) fn sizes(at: &[Point], joints: &[&Joint]) -> Vec<f64> {
    let mut out = vec![1.0; at.len()];
    let mut done = vec![false; at.len()];
    for i in 0..at.len() {
        if done[i] {
            continue;
        }
        let mut here: Vec<usize> = (i..at.len())
            .filter(|&k| !done[k] && one_place(at[k], at[i]))
            .collect();
        here.sort_by_key(|&k| (outward(&joints[k].joint_type), joints[k].drive, k));
        for (level, k) in here.into_iter().enumerate() {
            done[k] = true;
            out[k] = 1.0 + STEP * level as f64;
        }
    }
    out
}

/// Whether two points of the paper are one to the eye.
pub(in crate::draw) fn one_place(a: Point, b: Point) -> bool {
    norm(sub(a, b)) <= ONE_PLACE
}

/// Which of several joints is nearer to the outside: pins and balls stand on blocks and plates.
fn outward(of: &JointType) -> u8 {
    match of {
        JointType::Revolute | JointType::Spherical => 0,
        JointType::Cylindrical | JointType::CylindricalUniversal => 2,
        JointType::Fixed | JointType::Slotted | JointType::Prismatic => 3,
        JointType::SphereInCylinder => 4,
        JointType::Planar | JointType::CylinderOnPlane | JointType::SphereOnPlane => 5,
        _ => 1,
    }
}
