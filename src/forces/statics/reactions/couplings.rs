//! Couplings among the equations: what gears, belts and racks pass from joint to joint.
//!
//! A coupling ties the speeds of two freedoms, e₁ s₁ + e₂ s₂ = 0, and passes one unknown x for it: the wrenches that go from
//! first link to second at the two joints work on their freedoms by -e₁ x and -e₂ x, where those of other freedoms do no work.
//! How it gets there makes no difference to any other joint. Where teeth mesh whose place is known they push link on link
//! ([`Teeth`]), and the two bearings take up what they push; a belt, or what only says a ratio, is a moment about
//! the axis or a force along it, which no bearing feels.
//!
//! Two gears on one carrier touch at the point of their centre line that has the same speed on both, a pinion and its rack at
//! that of the pinion which the rack keeps up with; the force there is along the pitch circles. What teeth press apart, by the
//! pressure angle of their flanks, the file does not state, nor their friction: both are left out.

use crate::geom::vector::{across, add_scaled, cross, dot, length, scale, sub};
use crate::model::joint_type::{CoupledFreedom, Coupling, Freedom};
use crate::model::mechanism::{LinkId, Mechanism, StateId};
use crate::statics::reactions::wrench::{FreedomColumn, PosedFreedoms, Six, power, within, wrench};

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

/// Directions within this sine are alike, lengths below this fraction of the size are nothing.
const ALIKE: f64 = 1e-9;

/// Teeth in a pose, for x = 1 of their coupling; lengths in the geometry's size, from its middle.
#[derive(Debug, Clone, Copy)]
pub struct Teeth {
    /// Where they touch.
    pub point: [f64; 3],
    /// Their force on the gear or rack at the first end.
    pub force: [f64; 3],
    /// By end: what the joint's second link gets of that, from the other gear instead of its first link.
    pub wrenches: [Six; 2],
}

/// A gear or a rack.
struct Wheel {
    /// Its joint's point.
    centre: [f64; 3],
    /// Unit vector about which it turns, or along which it slides, against the carrier.
    along: [f64; 3],
    /// The moment or force along it that the wheel must get.
    needs: f64,
    /// 1 where the wheel is the joint's second link, else -1.
    sense: f64,
}

/// The teeth of a coupling; `None` where the file does not say that there are any, or not where.
pub(crate) fn teeth(
    m: &Mechanism,
    posed: &PosedFreedoms<'_>,
    coupling: &Coupling,
    columns: [&FreedomColumn; 2],
    entries: [f64; 2],
) -> Option<Teeth> {
    let carrier = carrier(m, coupling).filter(|_| coupling.gear)?;
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
        [Freedom::Rz, Freedom::Rz] => gears(posed, &first, &second)?,
        [Freedom::Rz, Freedom::Tz] => rack(&first, &second)?,
        [Freedom::Tz, Freedom::Rz] => {
            let (point, on_pinion) = rack(&second, &first)?;
            (point, scale(on_pinion, -1.0))
        }
        _ => return None,
    };
    let on = |w: &Wheel, sign: f64| {
        let force = scale(force, sign * w.sense);
        within(posed.basis, &wrench(point, force, [0.0; 3]))
    };
    Some(Teeth {
        point,
        force,
        wrenches: [on(&first, 1.0), on(&second, -1.0)],
    })
}

/// The link that both wheels are on, where they are two others.
fn carrier(m: &Mechanism, coupling: &Coupling) -> Option<LinkId> {
    let [a, b] = coupling.ends.map(|e| m.joints[e.joint].links);
    let carrier = a.into_iter().find(|l| b.contains(l))?;
    let wheel = |links: [LinkId; 2]| links.into_iter().find(|&l| l != carrier);
    (wheel(a)? != wheel(b)?).then_some(carrier)
}

/// Where two gears touch, and the force on the first.
fn gears(posed: &PosedFreedoms<'_>, a: &Wheel, b: &Wheel) -> Option<([f64; 3], [f64; 3])> {
    let z = a.along;
    if length(cross(z, b.along)) > ALIKE {
        return None;
    }
    let apart = sub(b.centre, a.centre);
    // Of axes whose points stand at two heights nothing says at which of them the gears are; in a plane there are none.
    if posed.basis.len() == 6 && dot(apart, z).abs() > ALIKE {
        return None;
    }
    let apart = across(apart, z);
    let distance = length(apart);
    let both = a.needs + dot(z, b.along).signum() * b.needs;
    // With equal rates about axes apart it is a belt, whatever it is called.
    if distance < ALIKE || both.abs() < ALIKE {
        return None;
    }
    let point = add_scaled(a.centre, a.needs / both, apart);
    let force = scale(cross(z, apart), both / (distance * distance));
    Some((point, force))
}

/// Where a pinion touches its rack, and the force on the pinion.
fn rack(pinion: &Wheel, rack: &Wheel) -> Option<([f64; 3], [f64; 3])> {
    let (z, u) = (pinion.along, rack.along);
    if dot(z, u).abs() > ALIKE || rack.needs.abs() < ALIKE {
        return None;
    }
    let force = -rack.needs;
    let point = add_scaled(pinion.centre, pinion.needs / force, cross(u, z));
    Some((point, scale(u, force)))
}
