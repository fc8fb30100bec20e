//! The rows of a paired gripper as equations for the poses of its links.

pub(crate) mod elimination;
pub(crate) mod pose_forces;
pub(crate) mod rows;
pub(crate) mod velocities;

use crate::geom::vector::{dot, sub};
use crate::synthesis::equations::elimination::SmallSystem;
use crate::synthesis::equations::rows::{PoseRows, TeethSeen, Term};
use crate::synthesis::place::Point;
use crate::synthesis::places::Places;
use crate::synthesis::sketch::Sketch;
use crate::synthesis::stroke::pose::LinkPose;
use crate::synthesis::stroke::walk::{FitEquations, RADIAN};

/// Returns the first column of a link's unknowns: two of its shift and one of its turn. `None` for the frame.
pub(super) fn place_of(link: usize, frame: usize) -> Option<usize> {
    (link != frame).then(|| 3 * (link - usize::from(link > frame)))
}

/// Adds the terms of a row to a system. Link velocities are those of the points that `about` returns, and turns are scaled by the arm
/// [`RADIAN`].
pub(super) fn put_row(
    system: &mut SmallSystem,
    row: usize,
    terms: &[Term],
    frame: usize,
    about: impl Fn(usize) -> Point,
) {
    for term in terms {
        let Some(column) = place_of(term.link, frame) else {
            continue;
        };
        for (k, x) in term.force_about(about(term.link)).into_iter().enumerate() {
            system.add_entry(row, column + k, x);
        }
    }
}

/// Equations of a stroke. The unknowns are the drive, and shift and turn of every moving link, with turns as millimetres at an arm of 50.
#[derive(Debug, Clone)]
pub(crate) struct PoseEquations<'a> {
    sketch: &'a Sketch<'a>,
    pub(super) at: Option<Places>,
    links: Vec<LinkPose>,
}

impl<'a> PoseEquations<'a> {
    /// Creates the equations of a sketch.
    #[must_use]
    pub(crate) fn new(sketch: &'a Sketch<'a>) -> PoseEquations<'a> {
        PoseEquations {
            links: sketch.at_rest.clone(),
            at: None,
            sketch,
        }
    }

    /// Writes the poses of the links for the unknowns `x`.
    pub(super) fn unpack_poses(&self, x: &[f64], links: &mut [LinkPose]) {
        for (link, pose) in links.iter_mut().enumerate() {
            if let Some(k) = place_of(link, self.sketch.bones.frame) {
                *pose = LinkPose::turn_by(x[k + 2] / RADIAN);
                pose.shift = [x[k], x[k + 1]];
            }
        }
    }
}

impl FitEquations for PoseEquations<'_> {
    fn size(&self) -> usize {
        3 * (self.links.len() - 1) + 1
    }

    fn radian(&self, unknown: usize) -> f64 {
        if unknown + 1 == self.size() && self.sketch.bones.turns {
            1.0
        } else {
            RADIAN
        }
    }

    fn fill(&mut self, x: &[f64], wider: f64, rows: &mut SmallSystem) {
        let (sketch, size) = (self.sketch, self.size());
        let (bones, last) = (&sketch.bones, size - 1);
        let mut links = std::mem::take(&mut self.links);
        self.unpack_poses(x, &mut links);
        rows.clear();
        if let Some(at) = &self.at {
            let all = PoseRows {
                rules: &sketch.rules,
                at,
                links: &links,
            };
            let shift = |link: usize| links[link].shift;
            let mut row = 0;
            all.each_joint(TeethSeen::Ratio, &mut |off, terms| {
                put_row(rows, row, terms, bones.frame, shift);
                rows.add_entry(row, size, off);
                row += 1;
            });
            // The travel of the drive is the relative motion of its links.
            let (gone, terms) = all.drive_row(sketch.input, sketch.drive);
            put_row(rows, row, &terms, bones.frame, shift);
            rows.add_entry(row, last, -1.0);
            rows.add_entry(row, size, gone - x[last]);
            row += 1;
            let mut open = -wider;
            for ((n, &jaw), outward) in bones.jaws.iter().enumerate().zip(&sketch.apart) {
                let tip = links[jaw].moved_point(bones.tips[n]);
                open += dot(sub(tip, bones.tips[n]), *outward);
                put_row(
                    rows,
                    row,
                    &[Term::force(jaw, *outward, tip)],
                    bones.frame,
                    shift,
                );
            }
            rows.add_entry(row, size, open);
            rows.add_entry(row, size + 1, 1.0);
        }
        self.links = links;
    }
}
