//! The symbol of a joint, with the ring of a drive.

use crate::draw::projection::{self, View};
use crate::draw::sheet::{Shape, Sheet};
use crate::draw::subject::{Mark, Subject};
use crate::draw::symbols::{self, Pose};
use crate::model::joint_type::JointType;
use crate::model::mechanism::{Frame, JointId};
use crate::svg::plane::Rect;

/// The symbol of a joint round the origin.
pub(super) struct Symbol {
    of: JointType,
    pose: Pose,
    shapes: Vec<Shape>,
    pub(super) room: Rect,
    /// The radius of a drive's ring.
    pub(super) ring: Option<f64>,
}

impl Symbol {
    pub(super) fn new(
        subject: &Subject<'_>,
        joint: JointId,
        of: &JointType,
        frame: &Frame,
        view: &View,
    ) -> Symbol {
        let pose = Pose::new(&projection::turned(frame), view);
        let shapes = symbols::symbol(of, &pose, "");
        let own = symbols::extent(&shapes);
        let reach = (own.right - own.left).max(own.bottom - own.top) / 2.0 + 3.0;
        let drive = subject.mechanism.joints[joint].drive;
        let ring = drive.then_some(reach.min(14.0));
        let room = match ring {
            Some(r) => own.with(&Rect::around([0.0; 2], 2.0 * r + 1.4, 2.0 * r + 1.4)),
            None => own,
        };
        Symbol {
            of: of.clone(),
            pose,
            shapes,
            room,
            ring,
        }
    }

    pub(super) fn marked(mut self, mark: Mark) -> Symbol {
        self.shapes = symbols::symbol(&self.of, &self.pose, mark.class());
        self
    }

    /// How far it reaches from its middle.
    pub(super) fn reach(&self) -> f64 {
        let r = &self.room;
        [-r.left, -r.top, r.right, r.bottom]
            .into_iter()
            .fold(0.0, f64::max)
    }

    pub(super) fn draw(
        &self,
        sheet: &mut Sheet,
        subject: &Subject<'_>,
        joint: JointId,
        mark: Mark,
    ) {
        if let Some(r) = self.ring {
            sheet.circle(&format!("line{}", mark.class()), [0.0; 2], r);
        }
        sheet.shapes(&self.shapes, [0.0; 2]);
        if subject.only_here(joint) {
            sheet.circle("fine dash", [0.0; 2], self.ring.unwrap_or(10.0) + 2.5);
        }
    }
}
