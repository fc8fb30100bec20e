//! Assemblies of CAD programs: parts placed by the file, and joints that constrain two frames.
//!
//! An assembly as read, and its robot: parts at their places, joints at their frames.

pub(crate) mod archive;
pub(crate) mod asmt;
pub(crate) mod fcstd;
pub(crate) mod holds;
mod meet;
pub(crate) mod retype;

use crate::closure::tree::spanning_forest;
use crate::robots::cad::holds::Holds;
use crate::robots::cad::meet::{Meeting, find_coupling, find_meeting};
use crate::robots::prelude::*;

/// Frames meet if they are apart by less than this, as a share of the assembly's size and in radians: solvers are as accurate as this.
const MEET: f64 = 1e-4;
/// Smaller values are rounding errors of the last digits.
const ROUNDED: f64 = 1e-9;
/// Joint types that a search may use instead of a joint: those of CAD programs.
const OPTIONS: [JointType; 3] = [
    JointType::Revolute,
    JointType::Cylindrical,
    JointType::Spherical,
];

/// The note on limits, which no reader supports.
pub(crate) const NO_LIMITS: &str = "limits are omitted; poses beyond them are analysed, too";

/// A joint as read.
#[derive(Debug, Clone)]
pub(crate) struct Connection {
    pub(crate) id: String,
    /// The parts of I and J.
    pub(crate) parts: [usize; 2],
    /// I and J in the assembly.
    pub(crate) frames: [RigidMotion; 2],
    pub(crate) holds: Holds,
    /// The element that defines it.
    pub(crate) element: usize,
}

impl Connection {
    /// Returns its name in messages.
    fn label(&self) -> String {
        format!("joint \"{}\"", self.id)
    }
}

/// Parts and joints; part 0 is the ground.
#[derive(Debug, Clone)]
pub(crate) struct Assembly {
    pub(crate) name: String,
    pub(crate) unit: &'static str,
    /// Names and places.
    pub(crate) parts: Vec<(String, RigidMotion)>,
    pub(crate) connections: Vec<Connection>,
}

impl Assembly {
    /// Converts the assembly to a robot. Notes that are already in its report stay.
    pub(crate) fn to_robot(&self, mut robot: Robot, options: &Options) -> Robot {
        robot.name.clone_from(&self.name);
        robot.unit = self.unit;
        robot.assembly = true;
        robot.options = &OPTIONS;
        let tied = self.find_tied(&mut robot);
        // Floating parts do not become links.
        let mut link = vec![None; self.parts.len()];
        for (p, (name, place)) in self.parts.iter().enumerate().filter(|(p, _)| tied[*p]) {
            link[p] = Some(robot.add_link(name, *place));
        }
        robot.world = link[0];
        let known = self.connections.iter();
        let known = known.filter_map(|c| Some((c, [link[c.parts[0]]?, link[c.parts[1]]?])));
        let (couplers, ties): (Vec<_>, Vec<_>) = known.partition(|(c, _)| c.holds.couples());
        let mut rows = 0;
        for (c, links) in &ties {
            rows += c.holds.rows();
            self.add_joint(c, *links, options, &mut robot);
        }
        for (c, links) in &couplers {
            rows += c.holds.rows();
            add_coupling(c, *links, &mut robot);
        }
        let moving = tied.iter().filter(|t| **t).count() - 1;
        let [parts, rows] = [moving, rows].map(|n| i64::try_from(n).unwrap_or(i64::MAX));
        robot.report.cad_freedoms = Some(6 * parts - rows);
        robot.known_to = Some(self.known_to(&robot));
        robot
    }

    /// Returns for each part whether a chain of joints connects it to the ground; the others are reported.
    fn find_tied(&self, robot: &mut Robot) -> Vec<bool> {
        let ties = self.connections.iter().filter(|c| !c.holds.couples());
        let ends = ties.map(|c| c.parts);
        let (_, steps) = spanning_forest(self.parts.len(), ends, |_| false, [0]);
        let mut tied = vec![false; self.parts.len()];
        tied[0] = true;
        steps.iter().for_each(|s| tied[s.link] = true);
        let report = &mut robot.report;
        for ((name, _), _) in self.parts.iter().zip(&tied).filter(|(_, t)| !**t) {
            report.drop_element("part that is not connected to the ground", name);
        }
        let loose = |c: &&Connection| c.parts.iter().any(|&p| !tied[p]);
        for c in self.connections.iter().filter(loose) {
            report.drop_element("joint between floating parts", &c.id);
        }
        tied
    }

    fn add_joint(&self, c: &Connection, links: [usize; 2], options: &Options, robot: &mut Robot) {
        if links[0] == links[1] {
            let what = "both ends are on one part, so it has no effect; omitted";
            robot.report.add_approximation(&c.label(), what);
            return;
        }
        let m = match find_meeting(c.holds, &c.frames[0], &c.frames[1]) {
            Ok(m) => m,
            Err(why) => {
                left_out(c, why, robot);
                // It is still a joint, without constraints: its parts remain in the assembly.
                let there = c.frames[0];
                Meeting::new(free_joint(), there, there)
            }
        };
        let part = make_part(c, links, &m, &robot.places, options);
        self.report_joint(c, &part, &m, options, robot);
        robot.joints.push(part);
    }

    /// Reports frames that do not meet, and joints that are valid at this pose only.
    fn report_joint(
        &self,
        c: &Connection,
        part: &Part,
        m: &Meeting,
        options: &Options,
        robot: &mut Robot,
    ) {
        let element = c.label();
        if let Some(apart) = part.misfit.filter(|a| self.is_open(*a)) {
            let apart = describe_misfit(apart, self.unit);
            if options.assemble {
                let what = format!("{element}: its two frames are {apart} apart in the file");
                robot.report.moved.push(what);
            } else {
                let what = format!(
                    "its two frames are {apart} apart; the figures use the pose of the file, and the joint lies at its first frame (the option `assemble` closes joints)"
                );
                robot.report.add_assumption(&element, what);
                robot.here_only = true;
            }
        }
        if m.here_only {
            let what = format!(
                "{}: its freedoms are those of this pose; in other poses they may differ",
                c.holds.word()
            );
            robot.report.add_approximation(&element, what);
            robot.here_only = true;
        }
    }

    /// Returns the largest distance between frames of a joint, the scale for lengths.
    fn size(&self) -> f64 {
        let places = self.parts.iter().map(|(_, p)| length(p.translation));
        let frames = self.connections.iter();
        let frames = frames.flat_map(|c| c.frames.map(|f| length(f.translation)));
        places.chain(frames).fold(1e-3, f64::max)
    }

    fn is_open(&self, [shift, turn]: [f64; 2]) -> bool {
        shift > MEET * self.size() || turn > MEET
    }

    /// Returns the accuracy of places: the misfit of frames that should coincide.
    fn known_to(&self, robot: &Robot) -> [f64; 2] {
        let closed = robot.joints.iter().filter_map(|p| p.misfit);
        let closed = closed.filter(|m| !self.is_open(*m));
        let most = closed.fold([0.0_f64; 2], |[a, b], [shift, turn]| {
            [a.max(shift), b.max(turn)]
        });
        let size = self.size();
        // A turn moves points at a distance of the assembly's size.
        let shift = most[0].max(most[1] * size).max(1e-12 * size);
        [shift, (shift / size).max(most[1])]
    }
}

fn make_part(
    c: &Connection,
    links: [usize; 2],
    m: &Meeting,
    places: &[RigidMotion],
    options: &Options,
) -> Part {
    let apart = m.near.inverse().then(&m.far);
    let ball = m.kind == JointType::Spherical;
    let turn = if ball { 0.0 } else { apart.angle() };
    // By default a joint is at its first frame; with `assemble`, each part keeps its own frame.
    let far = if options.assemble { &m.far } else { &m.near };
    let sides = [
        places[links[0]].inverse().then(&m.near),
        places[links[1]].inverse().then(far),
    ];
    let mut part = Part::new(&c.id, links, sides, m.kind.clone());
    part.pitch = m.pitch;
    part.element = Some(c.element);
    part.misfit = Some([length(apart.translation), turn]);
    part
}

fn add_coupling(c: &Connection, links: [usize; 2], robot: &mut Robot) {
    let m = match find_meeting(c.holds, &c.frames[0], &c.frames[1]) {
        Ok(m) => m,
        Err(why) => return left_out(c, why, robot),
    };
    let element = c.label();
    let said = (element.as_str(), c.element);
    if let Some(found) = find_coupling(&m, links, &robot.joints, &robot.places, said) {
        robot.couplings.push(found);
        return;
    }
    let what = format!(
        "{}: its parts are not both connected to one part by a hinge or a slider; its constraints are those of this pose, and may differ in others",
        c.holds.word()
    );
    robot.report.add_approximation(&element, what);
    robot.here_only = true;
    let mut held = make_part(c, links, &m, &robot.places, &Options::default());
    held.closes = true;
    robot.joints.push(held);
}

fn left_out(c: &Connection, why: &str, robot: &mut Robot) {
    let what = format!("{} is omitted: {why}", c.holds.word());
    let element = c.label();
    robot.report.leave_out_joint(&element, c.holds.rows(), what);
}

/// Describes a misfit, such as "0.02 mm and 1.2 degrees".
pub(crate) fn describe_misfit([shift, turn]: [f64; 2], unit: &str) -> String {
    let number = |x: f64| match x {
        x if x >= 0.095 => format!("{x:.1}"),
        x => format!("{x:.1e}"),
    };
    let degrees = turn.to_degrees();
    match (shift > ROUNDED, degrees > ROUNDED) {
        (true, true) => format!("{} {unit} and {} degrees", number(shift), number(degrees)),
        (false, true) => format!("{} degrees", number(degrees)),
        (true, false) => format!("{} {unit}", number(shift)),
        (false, false) => format!("0 {unit}"),
    }
}
