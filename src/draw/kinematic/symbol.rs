//! The symbol of a joint, with the ring of a drive.

use crate::draw::place::projection::{Place, View};
use crate::draw::sheet::{Shape, Sheet};
use crate::draw::subject::{Mark, Subject};
use crate::draw::symbol::pieces::Pose;
use crate::draw::symbol::symbols;
use crate::model::joint_type::JointType;
use crate::model::mechanism::JointId;
use crate::svg::plane::Rect;
use std::f64::consts::PI;

/// The symbol of a joint round the origin.
pub(super) struct Symbol {
    of: JointType,
    pose: Pose,
    shapes: Vec<Shape>,
    /// How many times the usual size it is.
    pub(super) size: f64,
    pub(super) room: Rect,
    /// The radius of a drive's ring.
    pub(super) ring: Option<f64>,
}

impl Symbol {
    pub(super) fn new(
        subject: &Subject<'_>,
        joint: JointId,
        (of, place): (&JointType, &Place),
        view: &View,
        size: f64,
    ) -> Symbol {
        let pose = Pose::new(place, view);
        let shapes = symbols::symbol(of, &pose, "", size);
        let own = symbols::extent(&shapes);
        let reach = (own.right - own.left).max(own.bottom - own.top) / 2.0 + 3.0;
        let drive = subject.mechanism.joints[joint].drive;
        let ring = drive.then_some(reach.min(14.0 * size));
        let room = match ring {
            Some(r) => own.with(&Rect::around([0.0; 2], 2.0 * r + 5.4, 2.0 * r + 5.4)),
            None => own,
        };
        Symbol {
            of: of.clone(),
            pose,
            shapes,
            size,
            room,
            ring,
        }
    }

    pub(super) fn marked(mut self, mark: Mark) -> Symbol {
        self.shapes = symbols::symbol(&self.of, &self.pose, mark.class(), self.size);
        self
    }

    /// Its shapes in the usual size, without a mark.
    pub(super) fn plain(&self) -> Vec<Shape> {
        symbols::symbol(&self.of, &self.pose, "", 1.0)
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
        let (below, above) = self.round(subject, joint, mark);
        sheet.shapes(&below, [0.0; 2]);
        sheet.shapes(&self.shapes, [0.0; 2]);
        sheet.shapes(&above, [0.0; 2]);
    }

    /// What stands round the symbol, below and above it, and is turned to the reader always.
    pub(super) fn round(
        &self,
        subject: &Subject<'_>,
        joint: JointId,
        mark: Mark,
    ) -> (Vec<Shape>, Vec<Shape>) {
        let drive = |r| drive(mark.class(), r);
        let only_here = subject.only_here(joint).then(|| Shape::Circle {
            at: [0.0; 2],
            radius: self.ring.unwrap_or(10.0 * self.size) + 2.5,
            class: "fine dash".to_owned(),
        });
        let below = self.ring.map(drive).unwrap_or_default();
        (below, only_here.into_iter().collect())
    }
}

/// The arrow round a driving pair, which is no circle: that is a second joint.
pub(super) fn drive(mark: &str, radius: f64) -> Vec<Shape> {
    const FROM: f64 = 0.25 * PI;
    const TO: f64 = 1.85 * PI;
    let on = |angle: f64, r: f64| [r * angle.cos(), r * angle.sin()];
    let arc = (0..=28).map(|i| on(FROM + (TO - FROM) * f64::from(i) / 28.0, radius));
    let back = TO - 6.0 / radius;
    let head = vec![
        on(TO + 1.5 / radius, radius),
        on(back, radius + 2.6),
        on(back, radius - 2.6),
    ];
    let arc = Shape::line(format!("line{mark}"), arc.collect());
    let (class, closed) = (format!("ink{mark}"), true);
    vec![
        arc,
        Shape::Path {
            class,
            points: head,
            closed,
        },
    ]
}
