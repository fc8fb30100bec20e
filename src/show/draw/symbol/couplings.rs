//! Couplings in a drawing: a thin dashed line from joint to joint, a row of the legend, and words.

use crate::draw::sheet::{Sheet, Swatch};
use crate::draw::subject::Subject;
use crate::model::joint_type::Coupling;
use crate::model::mechanism::JointId;
use crate::svg::plane::{Point, add};
use std::fmt::Write as _;

/// The class of the style sheet that the lines have.
const CLASS: &str = "fine dash";

/// Draws the line of a coupling between joints that stand at `place`.
pub(in crate::draw) fn draw_line(
    sheet: &mut Sheet,
    coupling: &Coupling,
    place: impl Fn(JointId) -> Option<Point>,
) {
    let [a, b] = coupling.ends.map(|e| place(e.joint));
    if let (Some(a), Some(b)) = (a, b) {
        sheet.line(CLASS, a, b);
    }
}

impl Subject<'_> {
    /// Draws the lines of the couplings between joints that stand at `place`.
    pub(in crate::draw) fn draw_couplings(
        &self,
        sheet: &mut Sheet,
        place: impl Fn(JointId) -> Option<Point>,
    ) {
        for coupling in self.mechanism.couplings_in(self.state) {
            draw_line(sheet, coupling, &place);
        }
    }

    /// The row of the legend, where there are couplings.
    pub(in crate::draw) fn coupling_row(&self) -> Option<(Swatch, String)> {
        self.mechanism.couplings_in(self.state).next()?;
        let draw = |s: &mut Sheet, p: Point| s.line(CLASS, add(p, [-9.0, 0.0]), add(p, [9.0, 0.0]));
        Some((Swatch::Symbol(draw), "coupled joints".to_owned()))
    }

    /// The couplings for those who do not see the drawing.
    pub(in crate::draw) fn coupling_words(&self) -> String {
        let mut out = String::new();
        for c in self.mechanism.couplings_in(self.state) {
            // Writing to a string cannot fail.
            let _ = write!(
                out,
                " Coupled: {}, ratio {}.",
                c.name(self.mechanism),
                c.ratio
            );
        }
        out
    }
}
