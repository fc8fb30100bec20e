//! Couplings in the equations: forces that gears, belts and racks transmit from joint to joint.
//!
//! A coupling relates the speeds of two freedoms, e₁ s₁ + e₂ s₂ = 0, and transmits one unknown x for it. The wrenches
//! from first link to second at the two joints do work on their freedoms by -e₁ x and -e₂ x, and none on other
//! freedoms. The path of transmission does not matter to any other joint.
//!
//! If teeth mesh at a known point, they push link on link ([`Teeth`]), and the two bearings carry these forces. A belt,
//! or a coupling that only states a ratio, is a moment about the axis or a force along it, which no bearing carries.
//!
//! Two gears on one carrier touch at the point of their centre line that has the same speed on both. A pinion and its
//! rack touch at the point of the pinion whose speed is that of the rack. The force there is along the pitch circles.
//! The separating force of teeth from their pressure angle is not stated in the file, nor is their friction. Both are
//! omitted.

use crate::geom::vector::{across, add_scaled, cross, dot, length, scale, sub};
use crate::model::joint_type::{CoupledFreedom, Coupling, Freedom};
use crate::model::mechanism::{LinkId, Mechanism, StateId};
use crate::statics::reactions::wrench::{
    FreedomColumn, PosedFreedoms, Six, carried_part, force_wrench, wrench_power,
};

/// Work of teeth on another freedom of a joint, for a unit force, below which it counts as zero.
const NO_WORK: f64 = 1e-9;

/// The equation of a coupling in a pose, and its transmitted wrenches.
#[derive(Debug, Clone)]
pub struct CouplingEquation {
    /// The coupled freedoms.
    pub ends: [CoupledFreedom; 2],
    /// e₁ and e₂, for unit twists of the geometry; the sum of their squares is 1.
    pub entries: [f64; 2],
    /// Wrench at each joint from first link to second if only the freedom is affected, for x = 1.
    pub along_freedoms: [Six; 2],
    /// The teeth, if the coupling has any at a known point.
    pub teeth: Option<Teeth>,
    /// Whether the unchanged joints carry the forces of the teeth.
    pub meshes: bool,
}

impl CouplingEquation {
    /// Returns the wrench at an end that bypasses the joint, from first link to second, for x = 1: through the teeth if
    /// these mesh.
    #[must_use]
    pub fn bypass_wrench(&self, end: usize, meshes: bool) -> Six {
        match &self.teeth {
            Some(teeth) if meshes => teeth.wrenches[end],
            _ => self.along_freedoms[end],
        }
    }

    /// Returns true if a joint with such freedoms carries the forces of the teeth at an end: they do no work except on
    /// the coupled freedom.
    pub fn is_borne<'t>(&self, end: usize, mut others: impl Iterator<Item = &'t Six>) -> bool {
        let Some(teeth) = &self.teeth else {
            return false;
        };
        let wrench = &teeth.wrenches[end];
        let greatest = wrench.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
        others.all(|t| wrench_power(t, wrench).abs() <= NO_WORK * greatest)
    }
}

/// Returns the couplings of a state in a pose, in file order.
pub(crate) fn coupling_equations(
    m: &Mechanism,
    state: StateId,
    posed: &PosedFreedoms<'_>,
) -> Vec<CouplingEquation> {
    let all = m.couplings_in(state);
    all.filter_map(|c| coupling_equation(m, posed, c)).collect()
}

fn coupling_equation(
    m: &Mechanism,
    posed: &PosedFreedoms<'_>,
    coupling: &Coupling,
) -> Option<CouplingEquation> {
    let at = |e: CoupledFreedom| {
        let mut all = posed.columns.iter();
        all.find(|c| (c.joint, c.freedom) == (e.joint, e.freedom))
    };
    // The reader ensures that coupled freedoms exist.
    let [first, second] = coupling.ends.map(at);
    let columns = [first?, second?];
    let entries = coupling_entries(posed, coupling);
    let along_freedoms = [0, 1].map(|n| {
        let x = -entries[n];
        unit_wrench(posed, columns[n]).map(|w| w * x)
    });
    let teeth = find_teeth(m, posed, coupling, columns, entries);
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

/// Returns the entries. Ratios refer to radians and the file's unit, twists to radians and the geometry's size.
fn coupling_entries(posed: &PosedFreedoms<'_>, coupling: &Coupling) -> [f64; 2] {
    let unit = |e: CoupledFreedom| {
        if e.freedom.is_slide() {
            posed.size
        } else {
            1.0
        }
    };
    let [a, b] = coupling.ends.map(unit);
    let first = -coupling.ratio.to_f64() * a;
    let size = first.hypot(b);
    [first / size, b / size]
}

/// Returns the unit moment about the axis of a turning freedom, or the unit force along the line of a sliding one.
fn unit_wrench(posed: &PosedFreedoms<'_>, column: &FreedomColumn) -> Six {
    let t = &column.twist;
    let (turn, slide) = ([t[0], t[1], t[2]], [t[3], t[4], t[5]]);
    if turn == [0.0; 3] {
        force_wrench(posed.points[column.joint], slide, [0.0; 3])
    } else {
        [t[0], t[1], t[2], 0.0, 0.0, 0.0]
    }
}

/// Sine below which directions count as equal, and fraction of the size below which lengths count as zero.
const ALIKE: f64 = 1e-9;

/// Teeth in a pose, for x = 1 of their coupling; lengths in the geometry's size, from its middle.
#[derive(Debug, Clone, Copy)]
pub struct Teeth {
    /// Contact point.
    pub point: [f64; 3],
    /// Their force on the gear or rack at the first end.
    pub force: [f64; 3],
    /// For each end, the part of that force on the joint's second link, which comes from the other gear instead of its
    /// first link.
    pub wrenches: [Six; 2],
}

/// A gear or a rack.
struct Wheel {
    /// Its joint's point.
    centre: [f64; 3],
    /// Unit vector of its axis of rotation or direction of sliding, relative to the carrier.
    along: [f64; 3],
    /// The moment or force along it that the wheel requires.
    needs: f64,
    /// 1 if the wheel is the joint's second link, otherwise -1.
    sense: f64,
}

/// Returns the teeth of a coupling, or `None` if the file does not state that there are any, or their place.
pub(crate) fn find_teeth(
    m: &Mechanism,
    posed: &PosedFreedoms<'_>,
    coupling: &Coupling,
    columns: [&FreedomColumn; 2],
    entries: [f64; 2],
) -> Option<Teeth> {
    let carrier = wheel_carrier(m, coupling).filter(|_| coupling.gear)?;
    let wheel = |n: usize| {
        let t = &columns[n].twist;
        let turn = [t[0], t[1], t[2]];
        let second = m.joints[columns[n].joint].links[0] == carrier;
        let sense = if second { 1.0 } else { -1.0 };
        Wheel {
            centre: posed.points[columns[n].joint],
            along: if turn == [0.0; 3] {
                [t[3], t[4], t[5]]
            } else {
                turn
            },
            needs: -sense * entries[n],
            sense,
        }
    };
    let [first, second] = [wheel(0), wheel(1)];
    let (point, force) = match coupling.ends.map(|e| e.freedom) {
        [Freedom::Rz, Freedom::Rz] => gear_contact(posed, &first, &second)?,
        [Freedom::Rz, Freedom::Tz] => rack_contact(&first, &second)?,
        [Freedom::Tz, Freedom::Rz] => {
            let (point, on_pinion) = rack_contact(&second, &first)?;
            (point, scale(on_pinion, -1.0))
        }
        _ => return None,
    };
    let on = |w: &Wheel, sign: f64| {
        let force = scale(force, sign * w.sense);
        carried_part(posed.basis, &force_wrench(point, force, [0.0; 3]))
    };
    Some(Teeth {
        point,
        force,
        wrenches: [on(&first, 1.0), on(&second, -1.0)],
    })
}

/// Returns the link that carries both wheels, if they are two other links.
fn wheel_carrier(m: &Mechanism, coupling: &Coupling) -> Option<LinkId> {
    let [a, b] = coupling.ends.map(|e| m.joints[e.joint].links);
    let carrier = a.into_iter().find(|l| b.contains(l))?;
    let wheel = |links: [LinkId; 2]| links.into_iter().find(|&l| l != carrier);
    (wheel(a)? != wheel(b)?).then_some(carrier)
}

/// Returns the point at which two gears touch, and the force on the first.
fn gear_contact(posed: &PosedFreedoms<'_>, a: &Wheel, b: &Wheel) -> Option<([f64; 3], [f64; 3])> {
    let z = a.along;
    if length(cross(z, b.along)) > ALIKE {
        return None;
    }
    let apart = sub(b.centre, a.centre);
    // If the points of the axes are at two heights, the height of the gears is unknown. In a plane there are no
    // heights.
    if posed.basis.len() == 6 && dot(apart, z).abs() > ALIKE {
        return None;
    }
    let apart = across(apart, z);
    let distance = length(apart);
    let both = a.needs + dot(z, b.along).signum() * b.needs;
    // With equal rates about separate axes it is a belt, regardless of its name.
    if distance < ALIKE || both.abs() < ALIKE {
        return None;
    }
    let point = add_scaled(a.centre, a.needs / both, apart);
    let force = scale(cross(z, apart), both / (distance * distance));
    Some((point, force))
}

/// Returns the point at which a pinion touches its rack, and the force on the pinion.
fn rack_contact(pinion: &Wheel, rack: &Wheel) -> Option<([f64; 3], [f64; 3])> {
    let (z, u) = (pinion.along, rack.along);
    if dot(z, u).abs() > ALIKE || rack.needs.abs() < ALIKE {
        return None;
    }
    let force = -rack.needs;
    let point = add_scaled(pinion.centre, pinion.needs / force, cross(u, z));
    Some((point, scale(u, force)))
}
