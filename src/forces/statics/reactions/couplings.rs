//! Couplings among the equations: what gears, belts and racks pass from joint to joint.
//!
//! A coupling ties the speeds of two freedoms, e₁ s₁ + e₂ s₂ = 0, and passes one unknown x for it: the wrenches that go from
//! first link to second at the two joints work on their freedoms by -e₁ x and -e₂ x, where those of other freedoms do no work.
//! How it gets there makes no difference to any other joint. Where teeth mesh whose place is known they push link on link
//! ([`teeth`](super::teeth)), and the two bearings take up what they push; a belt, or what only says a ratio, is a moment about
//! the axis or a force along it, which no bearing feels.

use crate::model::joint_type::{CoupledFreedom, Coupling};
use crate::model::mechanism::{Mechanism, StateId};
use crate::statics::reactions::teeth::{Teeth, teeth};
use crate::statics::reactions::wrench::{FreedomColumn, PosedFreedoms, Six, power, wrench};

/// Work of teeth on another freedom of a joint, for a unit force, below which they do none.
const NO_WORK: f64 = 1e-9;

/// The equation of a coupling in a pose, and what it passes.
#[derive(Debug, Clone)]
pub struct CouplingEquation {
    /// The freedoms that are tied.
    pub ends: [CoupledFreedom; 2],
    /// e₁ and e₂, for unit twists of the geometry; the sum of their squares is 1.
    pub entries: [f64; 2],
    /// What passes at each joint from first link to second where nothing but the freedom feels it, for x = 1.
    pub along_freedoms: [Six; 2],
    /// The teeth, where the coupling has any whose place is known.
    pub teeth: Option<Teeth>,
    /// Whether the joints as they are bear what the teeth push.
    pub meshes: bool,
}

impl CouplingEquation {
    /// What passes beside the joint at an end from first link to second, for x = 1: by the teeth where these mesh.
    #[must_use]
    pub fn beside(&self, end: usize, meshes: bool) -> Six {
        match &self.teeth {
            Some(teeth) if meshes => teeth.wrenches[end],
            _ => self.along_freedoms[end],
        }
    }

    /// Whether a joint with such freedoms bears what the teeth push at an end: they do no work but on the freedom tied.
    pub fn is_borne<'t>(&self, end: usize, mut others: impl Iterator<Item = &'t Six>) -> bool {
        let Some(teeth) = &self.teeth else {
            return false;
        };
        let wrench = &teeth.wrenches[end];
        let greatest = wrench.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
        others.all(|t| power(t, wrench).abs() <= NO_WORK * greatest)
    }
}

/// The couplings of a state in a pose, in file order.
pub(crate) fn equations(
    m: &Mechanism,
    state: StateId,
    posed: &PosedFreedoms<'_>,
) -> Vec<CouplingEquation> {
    let all = m.couplings_in(state);
    all.filter_map(|c| equation(m, posed, c)).collect()
}

fn equation(
    m: &Mechanism,
    posed: &PosedFreedoms<'_>,
    coupling: &Coupling,
) -> Option<CouplingEquation> {
    let at = |e: CoupledFreedom| {
        let mut all = posed.columns.iter();
        all.find(|c| (c.joint, c.freedom) == (e.joint, e.freedom))
    };
    // The reader sees to it that coupled freedoms are there.
    let [first, second] = coupling.ends.map(at);
    let columns = [first?, second?];
    let entries = entries(posed, coupling);
    let along_freedoms = [0, 1].map(|n| {
        let x = -entries[n];
        along(posed, columns[n]).map(|w| w * x)
    });
    let teeth = teeth(m, posed, coupling, columns, entries);
    let mut out = CouplingEquation {
        ends: coupling.ends,
        entries,
        along_freedoms,
        teeth,
        meshes: false,
    };
    out.meshes = [0, 1].into_iter().all(|n| {
        let own = posed.columns.iter();
        let others = own.filter(|c| c.joint == columns[n].joint && c.freedom != columns[n].freedom);
        out.is_borne(n, others.map(|c| &c.twist))
    });
    Some(out)
}

/// Ratios are of radians and the file's unit, twists of radians and the geometry's size.
fn entries(posed: &PosedFreedoms<'_>, coupling: &Coupling) -> [f64; 2] {
    let unit = |e: CoupledFreedom| {
        if e.freedom.slides() { posed.size } else { 1.0 }
    };
    let [a, b] = coupling.ends.map(unit);
    let first = -coupling.ratio.to_f64() * a;
    let size = first.hypot(b);
    [first / size, b / size]
}

/// The unit moment about the axis that a freedom turns about, or the unit force along the line it slides along.
fn along(posed: &PosedFreedoms<'_>, column: &FreedomColumn) -> Six {
    let t = &column.twist;
    let (turn, slide) = ([t[0], t[1], t[2]], [t[3], t[4], t[5]]);
    if turn == [0.0; 3] {
        wrench(posed.points[column.joint], slide, [0.0; 3])
    } else {
        [t[0], t[1], t[2], 0.0, 0.0, 0.0]
    }
}
