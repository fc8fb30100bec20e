//! A gripper of a catalogue as numbers, for the script that draws and moves it.

use crate::geom::vector::{real, sides, unit};
use crate::model::coupling::Coupling;
use crate::model::joint_type::{Freedom, JointType};
use crate::model::mechanism::{Joint, JointId, Mechanism, Role, StateId};
use serde::Serialize;

/// The drawing of a mechanism as numbers.
#[derive(Serialize)]
pub(super) struct DrawingData {
    /// The places of the joints, and their names.
    pins: Vec<[f64; 2]>,
    names: Vec<String>,
    /// The two links of each joint.
    ends: Vec<[usize; 2]>,
    /// What each joint is in the plane: hinge, slide, slot (its pin on the first link).
    kinds: Vec<&'static str>,
    /// Which way slides and slots go.
    along: Vec<[f64; 2]>,
    gears: Vec<GearData>,
    /// The pins of each link.
    links: Vec<Vec<usize>>,
    /// The links that are the frame, the driver and the jaws.
    frame: usize,
    driver: Option<usize>,
    jaws: Vec<usize>,
    /// The joint that drives, and whether it slides.
    drive: Option<usize>,
    slides: bool,
    /// Where the jaws grip.
    tips: Option<Vec<[f64; 2]>>,
    /// Units of the drawing for one of the mechanism.
    scale: f64,
}

/// Two gears, or a pinion and its rack.
#[derive(Serialize)]
struct GearData {
    /// The joints by which the carrier holds them.
    joints: [usize; 2],
    /// The rate of the second joint over that of the first.
    ratio: f64,
    /// The links: of the first joint, and of the second.
    links: [usize; 2],
    carrier: usize,
    /// Where the pitch circles touch.
    pitch: [f64; 2],
}

/// The drawing of a mechanism; none of one whose pins are not all square to the plane of x and y.
pub(super) fn drawing(m: &Mechanism) -> Option<DrawingData> {
    let ids: Vec<JointId> = m.joints_in(StateId::FREE).collect();
    let joints: Vec<&Joint> = ids.iter().map(|&j| &m.joints[j]).collect();
    if !joints.iter().all(|j| is_square(j)) {
        return None;
    }
    let pins: Vec<[f64; 2]> = joints.iter().map(|j| flat(real(&j.frame.point))).collect();
    let links = m.link_ids().map(|l| {
        let own = joints.iter().enumerate();
        let own = own.filter(|(_, j)| j.links.contains(&l));
        own.map(|(i, _)| i).collect()
    });
    let drive = joints.iter().position(|j| j.drive);
    let driver = drive.map(|d| joints[d].links[1].index());
    let jaws: Vec<usize> = m
        .links_with_ids()
        .filter(|(_, l)| l.role == Role::Output)
        .map(|(l, _)| l.index())
        .collect();
    let tips = tips(m, &jaws).filter(|t| (2..=3).contains(&t.len()));
    let scaled = scale(&[&pins[..], tips.as_deref().unwrap_or_default()].concat());
    let place = |p: &[f64; 2]| p.map(|x| x * scaled);
    let slides = |d: usize| joints[d].joint_type.freedoms().iter().any(|f| f.slides());
    let gears = m.couplings_in(StateId::FREE).filter(|c| c.gear);
    let gears = gears.filter_map(|c| GearData::new(m, c, &ids, &pins, scaled));
    Some(DrawingData {
        gears: gears.collect(),
        ends: joints.iter().map(|j| j.links.map(|l| l.index())).collect(),
        kinds: joints.iter().map(|j| kind(j)).collect(),
        along: joints.iter().map(|j| along(j)).collect(),
        pins: pins.iter().map(place).collect(),
        names: joints.iter().map(|j| j.id.clone()).collect(),
        links: links.collect(),
        frame: m.frame().index(),
        driver,
        jaws,
        slides: drive.is_some_and(slides),
        drive,
        tips: tips.map(|t| t.iter().map(place).collect()),
        scale: scaled,
    })
}

/// Whether a pin is square to the plane of x and y; a slide may lie in it.
fn is_square(joint: &Joint) -> bool {
    let [x, y, z] = real(&joint.frame.axis);
    let across = x == 0.0 && y == 0.0;
    match joint.joint_type {
        JointType::Prismatic | JointType::Cylindrical => across || z == 0.0,
        _ => across,
    }
}

/// Where the jaws grip, where that is known of all. What a person drew may say by its forces where the part is.
fn tips(m: &Mechanism, jaws: &[usize]) -> Option<Vec<[f64; 2]>> {
    let tip = |jaw: &usize| {
        let points = m.points.iter().map(|p| (p.link, &p.point));
        let forces = m.loads.forces.iter().map(|f| (f.link, &f.point));
        let (_, at) = points.chain(forces).find(|(l, _)| l.index() == *jaw)?;
        Some(flat(real(at)))
    };
    jaws.iter().map(tip).collect()
}

fn flat([x, y, _]: [f64; 3]) -> [f64; 2] {
    [x, y]
}

fn kind(joint: &Joint) -> &'static str {
    match joint.joint_type.freedoms() {
        [Freedom::Tz] => "slide",
        [Freedom::Rz, Freedom::Tx] => "slot",
        _ => "hinge",
    }
}

/// Which way a slide or a slot goes, of length 1.
fn along(joint: &Joint) -> [f64; 2] {
    let towards = match joint.joint_type {
        JointType::Prismatic | JointType::Cylindrical => real(&joint.frame.axis),
        _ => real(&joint.frame.reference),
    };
    unit(flat(towards))
}

impl GearData {
    /// Of a coupling of two hinges, or of a hinge and a slide, that have a link in common.
    fn new(
        m: &Mechanism,
        coupling: &Coupling,
        ids: &[JointId],
        pins: &[[f64; 2]],
        scale: f64,
    ) -> Option<GearData> {
        let of = coupling.ends.map(|e| e.joint);
        let at = |id: JointId| ids.iter().position(|&j| j == id);
        let joints = [at(of[0])?, at(of[1])?];
        let ends = of.map(|id| m.joints[id].links);
        let carrier = *ends[0].iter().find(|l| ends[1].contains(l))?;
        let other = |k: usize| ends[k].into_iter().find(|l| *l != carrier);
        let links = [other(0)?, other(1)?];
        // By how much the second goes for a turn of the first, both against the carrier.
        let told = coupling.ratio.to_f64();
        let turned = ends.iter().filter(|links| links[0] != carrier).count() == 1;
        let rate = if turned { -told } else { told };
        let [a, b] = joints.map(|i| pins[i]);
        let kinds = of.map(|id| kind(&m.joints[id]));
        let (pitch, ratio) = match kinds {
            ["hinge", "hinge"] if rate < 0.0 => {
                let share = rate / (rate - 1.0);
                let pitch = [0, 1].map(|k| a[k] + share * (b[k] - a[k]));
                (pitch, told)
            }
            ["hinge", "slide"] => {
                let [x, y] = along(&m.joints[of[1]]);
                ([a[0] + rate * y, a[1] - rate * x], told * scale)
            }
            ["slide", "hinge"] => {
                let [x, y] = along(&m.joints[of[0]]);
                let radius = 1.0 / rate;
                ([b[0] + radius * y, b[1] - radius * x], told / scale)
            }
            _ => return None,
        };
        Some(GearData {
            joints,
            ratio,
            links: links.map(|l| l.index()),
            carrier: carrier.index(),
            pitch: pitch.map(|x| x * scale),
        })
    }
}

/// How many times larger a drawing is to be made: layouts are about as large as symbols are drawn for, whatever units a
/// drawn mechanism is in.
fn scale(points: &[[f64; 2]]) -> f64 {
    let [width, height] = sides(points);
    match width.max(height) {
        s if s > 0.0 && !(60.0..=400.0).contains(&s) => 160.0 / s,
        _ => 1.0,
    }
}
