//! A gripper of a catalogue as numbers, for the script that draws and moves it.

use crate::geom::vector::{Vector, box_sides, length, rotate_plane, to_vector, unit};
use crate::model::joint_type::{Coupling, Freedom, JointType};
use crate::model::mechanism::{Joint, JointId, LinkId, Mechanism, Role, StateId};
use itertools::Itertools;
use serde_json::{Value, json};
use std::f64::consts::PI;

/// Returns the drawing of a mechanism. `None` if some pins are not perpendicular to the plane of x and y, nor to planes at
/// 120° through the x axis.
pub(super) fn gripper_drawing(m: &Mechanism) -> Option<Value> {
    let view = View::seen_of(m)?;
    let joints = &view.joints;
    let pins: Vec<[f64; 2]> = joints.iter().map(|j| j.pin).collect();
    let of = |l: LinkId| joints.iter().positions(move |j| j.joint.links.contains(&l));
    let drive = joints.iter().position(|j| j.joint.drive);
    let driver = drive.map(|d| joints[d].joint.links[1]);
    let output = |l: &&LinkId| m.links[**l].role == Role::Output;
    let jaws: Vec<LinkId> = view.links.iter().filter(output).copied().collect();
    let tips = view
        .jaw_tips(m, &jaws)
        .filter(|t| (2..=3).contains(&t.len()));
    let scaled = drawing_scale(&[&pins[..], tips.as_deref().unwrap_or_default()].concat());
    let place = |p: &[f64; 2]| p.map(|x| x * scaled);
    let slides = |d: usize| {
        let freedoms = joints[d].joint.joint_type.freedoms();
        freedoms.iter().any(|f| f.is_slide())
    };
    let gears = m.couplings_in(StateId::FREE).filter(|c| c.gear);
    let gears = gears.filter_map(|c| gear_json(&view, c, scaled));
    let threads = view.threads.iter();
    let gears = gears.chain(threads.filter_map(|t| thread_json(m, &view, t, scaled)));
    let link = |l: LinkId| view.link_row(l);
    let ends = joints.iter().map(|j| match j.joint.links.map(link) {
        [Some(a), Some(b)] => Some([a, b]),
        _ => None,
    });
    Some(json!({
        "pins": pins.iter().map(place).collect::<Vec<_>>(),
        "names": joints.iter().map(|j| &j.joint.id).collect::<Vec<_>>(),
        // The two links of each joint.
        "ends": ends.collect::<Option<Vec<_>>>()?,
        // What each joint is in the plane: hinge, slide, slot (its pin on the first link).
        "kinds": joints.iter().map(|j| joint_kind(j.joint)).collect::<Vec<_>>(),
        // Which way slides and slots go.
        "along": joints.iter().map(|j| j.along).collect::<Vec<_>>(),
        "gears": gears.collect::<Vec<_>>(),
        // The pins of each link.
        "links": view.links.iter().map(|&l| of(l).collect::<Vec<_>>()).collect::<Vec<_>>(),
        "frame": link(m.frame_link())?,
        "driver": driver.and_then(link),
        "jaws": jaws.into_iter().map(link).collect::<Option<Vec<_>>>()?,
        "drive": drive,
        "slides": drive.is_some_and(slides),
        // Where the jaws grip.
        "tips": tips.map(|t| t.iter().map(place).collect::<Vec<_>>()),
        // Units of the drawing for one of the mechanism.
        "scale": scaled,
        // Whether two of three sides are seen, one laid opposite the other.
        "folded": view.folded,
    }))
}

/// A joint as it is seen in the plane.
struct SeenJoint<'a> {
    id: JointId,
    joint: &'a Joint,
    pin: [f64; 2],
    /// Which way a slide or a slot goes, of length 1.
    along: [f64; 2],
    /// Whether a turn about its axis is seen counter-clockwise, 1, or clockwise, -1.
    way: f64,
}

/// The part of a mechanism that is visible in the plane of x and y.
struct View<'a> {
    joints: Vec<SeenJoint<'a>>,
    /// Threads along the axis in the plane about which the drive turns.
    threads: Vec<&'a Joint>,
    links: Vec<LinkId>,
    /// Whether it is one of three sides around the x axis, with the next one drawn opposite.
    folded: bool,
}

/// Returns a vector turned by `sixths` sixths of a turn about the x axis.
fn round_x([x, y, z]: Vector, sixths: i32) -> Vector {
    let [y, z] = rotate_plane([y, z], f64::from(sixths) * PI / 3.0);
    [x, y, z]
}

/// Coordinates that are less than this of a size are rounding errors of turns.
const NEAR: f64 = 1e-9;

/// Returns true if a point is in the plane of x and y, except for rounding.
fn is_in_plane([x, y, z]: Vector) -> bool {
    z.abs() <= NEAR * (1.0 + x.abs() + y.abs())
}

impl<'a> View<'a> {
    /// Returns the place of a link among the visible links.
    fn link_row(&self, link: LinkId) -> Option<usize> {
        self.links.iter().position(|&l| l == link)
    }

    fn seen_of(m: &'a Mechanism) -> Option<View<'a>> {
        let all = m.joints_in(StateId::FREE);
        let (threads, ids): (Vec<JointId>, Vec<JointId>) =
            all.partition(|&j| is_thread(&m.joints[j]));
        let threads: Vec<&Joint> = threads.into_iter().map(|j| &m.joints[j]).collect();
        let lies = |j: &Joint| to_vector(&j.frame.axis)[2] == 0.0;
        let is_screw = |j: &Joint| !threads.is_empty() && j.drive && lies(j);
        let seen = |&j: &JointId| is_square(&m.joints[j], 0) || is_screw(&m.joints[j]);
        if threads.iter().all(|j| lies(j)) && ids.iter().all(seen) {
            let joints = ids.into_iter().map(|id| SeenJoint::new(m, id, 0));
            return Some(View {
                joints: joints.collect(),
                threads,
                links: m.link_ids().collect(),
                folded: false,
            });
        }
        if !threads.is_empty() {
            return None;
        }
        // In its own plane, or the sides at 120° and at 240° laid into it.
        let side = |&id: &JointId| {
            let joint = &m.joints[id];
            let in_plane = |&sixths: &i32| {
                let at = round_x(to_vector(&joint.frame.point), sixths);
                is_in_plane(at) && is_square(joint, sixths)
            };
            [0, 1, -1].into_iter().find(in_plane).map(|s| (id, s))
        };
        let sides: Vec<(JointId, i32)> = ids.iter().map(side).collect::<Option<_>>()?;
        let two = sides.into_iter().filter(|(_, sixths)| *sixths >= 0);
        let joints: Vec<SeenJoint<'a>> = two.map(|(id, s)| SeenJoint::new(m, id, s)).collect();
        let joined = |l: &LinkId| joints.iter().any(|j| j.joint.links.contains(l));
        Some(View {
            links: m.link_ids().filter(joined).collect(),
            threads,
            joints,
            folded: true,
        })
    }

    /// Returns the gripping points of the jaws, or `None` if one is unknown.
    fn jaw_tips(&self, m: &Mechanism, jaws: &[LinkId]) -> Option<Vec<[f64; 2]>> {
        let tip = |jaw: &LinkId| {
            let mut points = m.points.iter().map(|p| (p.link, &p.point));
            let (_, at) = points.find(|(l, _)| l == jaw)?;
            let at = to_vector(at);
            let aside = self.folded && !is_in_plane(at);
            Some(flat_xy(round_x(at, i32::from(aside))))
        };
        jaws.iter().map(tip).collect()
    }
}

impl<'a> SeenJoint<'a> {
    fn new(m: &'a Mechanism, id: JointId, sixths: i32) -> SeenJoint<'a> {
        let joint = &m.joints[id];
        let towards = match joint.joint_type {
            JointType::Prismatic | JointType::Cylindrical => &joint.frame.axis,
            _ => &joint.frame.reference,
        };
        let laid = |v| flat_xy(round_x(to_vector(v), sixths));
        SeenJoint {
            pin: laid(&joint.frame.point),
            along: unit(laid(towards)),
            way: match round_x(to_vector(&joint.frame.axis), sixths) {
                [_, _, z] if joint_kind(joint) == "hinge" && z < 0.0 => -1.0,
                _ => 1.0,
            },
            joint,
            id,
        }
    }
}

fn is_thread(joint: &Joint) -> bool {
    joint.joint_type.freedoms().contains(&Freedom::Screw)
}

/// Returns true if a pin is perpendicular to the plane of x and y after `sixths` sixths of a turn about x. A slide may lie
/// in the plane.
fn is_square(joint: &Joint, sixths: i32) -> bool {
    let axis = to_vector(&joint.frame.axis);
    let [x, y, z] = round_x(axis, sixths).map(|c| {
        if c.abs() <= NEAR * length(axis) {
            0.0
        } else {
            c
        }
    });
    let across = x == 0.0 && y == 0.0;
    match joint.joint_type {
        JointType::Prismatic | JointType::Cylindrical => across || z == 0.0,
        _ => across,
    }
}

fn flat_xy([x, y, _]: [f64; 3]) -> [f64; 2] {
    [x, y]
}

fn joint_kind(joint: &Joint) -> &'static str {
    match joint.joint_type.freedoms() {
        [Freedom::Tz] => "slide",
        [Freedom::Rz, Freedom::Tx] => "slot",
        _ => "hinge",
    }
}

/// Returns the gears of a coupling of two hinges, or of a hinge and a slide, that have a link in common.
fn gear_json(view: &View<'_>, coupling: &Coupling, scale: f64) -> Option<Value> {
    let at = |id: JointId| view.joints.iter().position(|j| j.id == id);
    let [a, b] = coupling.ends.map(|e| at(e.joint));
    let joints = [a?, b?];
    let seen = joints.map(|i| &view.joints[i]);
    let ends = seen.map(|s| s.joint.links);
    let carrier = *ends[0].iter().find(|l| ends[1].contains(l))?;
    let other = |k: usize| ends[k].into_iter().find(|l| *l != carrier);
    let links = [other(0)?, other(1)?];
    let link = |l: LinkId| view.link_row(l);
    // By how much the second goes for a turn of the first, both against the carrier.
    let told = seen[0].way * seen[1].way * coupling.ratio.to_f64();
    let turned = ends.iter().filter(|links| links[0] != carrier).count() == 1;
    let rate = if turned { -told } else { told };
    let [a, b] = seen.map(|s| s.pin);
    let kinds = seen.map(|s| joint_kind(s.joint));
    let (pitch, ratio) = match kinds {
        ["hinge", "hinge"] if rate < 0.0 => {
            let share = rate / (rate - 1.0);
            let pitch = [0, 1].map(|k| a[k] + share * (b[k] - a[k]));
            (pitch, told)
        }
        ["hinge", "slide"] => {
            let [x, y] = seen[1].along;
            ([a[0] + rate * y, a[1] - rate * x], told * scale)
        }
        ["slide", "hinge"] => {
            let [x, y] = seen[0].along;
            let radius = 1.0 / rate;
            ([b[0] + radius * y, b[1] - radius * x], told / scale)
        }
        _ => return None,
    };
    Some(json!({
        // The joints by which the carrier holds them.
        "joints": joints,
        // The rate of the second joint over that of the first.
        "ratio": ratio,
        // Of the first joint, and of the second.
        "links": [link(links[0])?, link(links[1])?],
        "carrier": link(carrier)?,
        // Where the pitch circles touch, or a nut is on its screw.
        "pitch": pitch.map(|x| x * scale),
        "thread": false,
    }))
}

/// Returns the thread of a nut that slides along a screw driven in the frame.
fn thread_json(m: &Mechanism, view: &View<'_>, thread: &Joint, scale: f64) -> Option<Value> {
    let drive = view.joints.iter().position(|j| j.joint.drive)?;
    let held = view.joints[drive].joint;
    let screw = *held.links.iter().find(|l| thread.links.contains(l))?;
    let nut = *thread.links.iter().find(|l| **l != screw)?;
    let guides = |j: &&SeenJoint<'_>| {
        j.joint.links.contains(&nut) && j.joint.links.contains(&m.frame_link())
    };
    let guide = view.joints.iter().position(|j| guides(&j))?;
    let [x, y] = flat_xy(to_vector(&held.frame.axis));
    let [u, v] = flat_xy(to_vector(&thread.frame.axis));
    let [p, q] = view.joints[guide].along;
    let along = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    // A nut that does not turn goes back where the screw turns on, each joint by the order of its own links.
    let way = along([x, y], [u, v]).signum() * along([u, v], [p, q]).signum();
    let order = |joint: &Joint, second: LinkId| if joint.links[1] == second { 1.0 } else { -1.0 };
    let order = order(held, screw) * order(view.joints[guide].joint, nut);
    let link = |l: LinkId| view.link_row(l);
    Some(json!({
        "joints": [drive, guide],
        "ratio": -way * order * thread.frame.pitch.to_f64() * scale,
        "links": [link(screw)?, link(nut)?],
        "carrier": link(m.frame_link())?,
        "pitch": flat_xy(to_vector(&thread.frame.point)).map(|x| x * scale),
        "thread": true,
    }))
}

/// Returns the factor by which to enlarge a drawing. Layouts are about as large as the symbols need, in any unit of the
/// drawn mechanism.
fn drawing_scale(points: &[[f64; 2]]) -> f64 {
    let [width, height] = box_sides(points);
    match width.max(height) {
        s if s > 0.0 && !(60.0..=400.0).contains(&s) => 160.0 / s,
        _ => 1.0,
    }
}
