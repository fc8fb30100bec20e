//! The symbol of a joint in a drawing, with its drive, its size among others at the same place, and swaps.

use crate::draw::place::projection::ONE_PLACE;
use crate::draw::prelude::*;
use crate::draw::sheet::ROW;
use crate::draw::symbol::pieces::{PaperPose, Piece};
use crate::draw::symbol::symbols;
use crate::model::mechanism::JointOption;

/// The symbol of a joint, at the origin.
pub(crate) struct Symbol {
    of: JointType,
    pose: PaperPose,
    /// Whether the joint is there in this state alone.
    only_here: bool,
    /// How many times the usual size it is.
    pub(crate) size: f64,
    pub(crate) room: Rect,
    /// The radius of the ring of a drive that turns.
    pub(crate) ring: Option<f64>,
    /// The axis that a driven slide goes along.
    pub(crate) slide: Option<usize>,
}

impl Symbol {
    pub(crate) fn new(
        subject: &Subject<'_>,
        joint: JointId,
        of: &JointType,
        place: &JointInSpace,
        view: &View,
        size: f64,
        slide: Option<usize>,
    ) -> Symbol {
        let pose = PaperPose::new(place, view);
        let own = symbols::shapes_extent(&symbols::symbol_shapes(of, &pose, "", size));
        let reach = (own.right - own.left).max(own.bottom - own.top) / 2.0 + 3.0;
        let drive = subject.mechanism.joints[joint].drive;
        let ring = (drive && slide.is_none()).then_some(reach.min(14.0 * size));
        let mut room = own;
        if let Some(r) = ring {
            room = room.with(&Rect::around([0.0; 2], 2.0 * r + 5.4, 2.0 * r + 5.4));
        }
        if let Some(axis) = slide {
            let arrow = symbols::slide_arrow(axis).iter();
            let arrow = arrow.filter_map(|p| p.sized_piece("", size).shape_seen(&pose));
            room = room.with(&symbols::shapes_extent(&arrow.collect::<Vec<_>>()));
        }
        Symbol {
            of: of.clone(),
            pose,
            only_here: subject.only_here(joint),
            size,
            room,
            ring,
            slide,
        }
    }

    /// Returns the symbol's shapes without a mark, small enough for a row of the legend.
    pub(crate) fn legend_shapes(&self) -> Vec<Shape> {
        let usual = symbols::shapes_extent(&symbols::symbol_shapes(&self.of, &self.pose, "", 1.0));
        let by = (ROW - 2.0) / (usual.bottom - usual.top);
        symbols::symbol_shapes(&self.of, &self.pose, "", by.min(1.0))
    }

    /// Returns how far the symbol extends from its middle.
    pub(crate) fn reach_of_room(&self) -> f64 {
        let [left, top, right, bottom] = self.room.edges();
        (-left).max(-top).max(right).max(bottom).max(0.0)
    }

    pub(crate) fn draw_symbol(&self, sheet: &mut Sheet, mark: Mark) {
        let pieces = self.all_pieces(mark).into_iter();
        let shapes: Vec<Shape> = pieces.filter_map(|p| p.shape_seen(&self.pose)).collect();
        sheet.draw_shapes(&shapes);
    }

    /// Returns the symbol's pieces from the back to the front. They include the ring or arrow of a drive, and the ring of a
    /// joint that exists in this state only.
    pub(crate) fn all_pieces(&self, mark: Mark) -> Vec<Piece> {
        let mark = mark.mark_class();
        let below = self
            .ring
            .map(|r| symbols::round_arrow(mark, r))
            .unwrap_or_default();
        let arrow = self.slide.map_or(&[][..], symbols::slide_arrow);
        let own = symbols::symbol_pieces(&self.of).iter().chain(arrow);
        let own = own.map(|p| p.sized_piece(mark, self.size));
        let radius = self.ring.unwrap_or(10.0 * self.size) + 2.5;
        let above = Shape::circle("fine dash", [0.0; 2], radius);
        let above = self.only_here.then(|| Piece::on_paper(&above));
        let below = below.iter().map(Piece::on_paper);
        below.chain(own).chain(above).collect()
    }
}

/// A joint that replaces another, so that a page can show any redesign in one drawing of the original mechanism.
#[derive(Debug, Clone, Copy)]
pub struct Swap<'a> {
    /// The place.
    pub joint: JointId,
    /// The new joint.
    pub option: &'a JointOption,
    /// Whether an unloading joint is put in series with it. A ring shows it.
    pub unloading: bool,
}

/// Returns the mark of an unloading joint around a symbol of size `reach`.
pub(crate) fn unloading_ring(reach: f64) -> Shape {
    Shape::circle("line new", [0.0; 2], reach + 4.0)
}

/// How much larger the next joint outwards is, so that the outline of each is seen.
const STEP: f64 = 0.6;

/// Returns the size of each joint's symbol relative to the usual. Those at one place on paper are nested: a multiple joint
/// as concentric circles, a pin on its block.
pub(crate) fn symbol_sizes(at: &[Point], joints: &[&Joint]) -> Vec<f64> {
    let mut out = vec![1.0; at.len()];
    let mut done = vec![false; at.len()];
    for i in 0..at.len() {
        if done[i] {
            continue;
        }
        let mut here: Vec<usize> = (i..at.len())
            .filter(|&k| !done[k] && one_place(at[k], at[i]))
            .collect();
        here.sort_by_key(|&k| (outward_order(&joints[k].joint_type), joints[k].drive, k));
        for (level, k) in here.into_iter().enumerate() {
            done[k] = true;
            out[k] = 1.0 + STEP * level as f64;
        }
    }
    out
}

/// Returns true if two points of the paper look the same.
pub(crate) fn one_place(a: Point, b: Point) -> bool {
    plane_norm(sub(a, b)) <= ONE_PLACE
}

/// Returns the rank of a joint type from the inside to the outside. Pins and balls are drawn on blocks and plates.
fn outward_order(of: &JointType) -> u8 {
    match of {
        JointType::Revolute | JointType::Spherical => 0,
        JointType::Cylindrical | JointType::CylindricalUniversal => 2,
        JointType::Fixed | JointType::Slotted | JointType::Prismatic => 3,
        JointType::SphereInCylinder => 4,
        JointType::Planar | JointType::CylinderOnPlane | JointType::SphereOnPlane => 5,
        _ => 1,
    }
}
