//! Where the teeth of a gear or a rack push, and how.
//!
//! Two gears on one carrier touch at the point of their centre line that has the same speed on both, a pinion and its rack at
//! that of the pinion which the rack keeps up with; the force there is along the pitch circles. What teeth press apart, by the
//! pressure angle of their flanks, the file does not state, nor their friction: both are left out.

use crate::geom::vector::{across, add_scaled, cross, dot, length, scale, sub};
use crate::model::joint_type::{Coupling, Freedom};
use crate::model::mechanism::{LinkId, Mechanism};
use crate::statics::reactions::wrench::{FreedomColumn, PosedFreedoms, Six, within, wrench};

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
