//! A robot as URDF: a tree whose links have their frames at the joints that hold them, as the format wants it; loops as
//! `<loop_joint>`, as pairs of links in a file beside it, or as Drake's ball constraints.

mod closing;
mod link;
mod tree;

use crate::geom::rigid::RigidMotion;
use crate::robots::convert::mimics::mimics;
use crate::robots::convert::payload::{Actuator, Command};
use crate::robots::convert::scene::{RobotScene, Text, moves, name_of};
use crate::robots::mechanism::series_of_single_joints::{Names, escape, number};
use std::collections::BTreeMap;
use std::fmt::Write;

/// How the loops are said.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Loops {
    LoopJoint,
    Beside,
    Drake,
}

/// Stands for "no bound": readers want a number.
const ENDLESS: f64 = 1e10;

/// What a file collects.
struct ToUrdf<'a> {
    scene: &'a RobotScene<'a>,
    loops: Loops,
    links: Names,
    joints: Names,
    names: BTreeMap<usize, String>,
    /// The frame of each link in the file, in that of the robot's link.
    frames: BTreeMap<usize, RigidMotion>,
    /// Names of freedoms that are joints of the tree.
    single: BTreeMap<(usize, usize), String>,
    /// What a joint follows, by name: the leader, the rate and the value where the leader is at zero.
    mimics: BTreeMap<String, (String, f64, f64)>,
    head: String,
    body: String,
    pairs: Vec<[String; 3]>,
    out: Text,
}

/// Writes it.
pub(crate) fn urdf(scene: &RobotScene<'_>, loops: Loops) -> Text {
    let mut w = ToUrdf {
        scene,
        loops,
        links: Names::default(),
        joints: Names::default(),
        names: BTreeMap::new(),
        frames: BTreeMap::new(),
        single: BTreeMap::new(),
        mimics: BTreeMap::new(),
        head: String::new(),
        body: String::new(),
        pairs: Vec::new(),
        out: Text::default(),
    };
    let plan = scene.plan;
    // sdformat reads links and joints of a URDF as names of one kind.
    for link in &scene.robot.links {
        w.joints.fit(link);
    }
    for (j, part) in scene.robot.joints.iter().enumerate() {
        let wanted = if part.is_nameless(scene.robot) {
            format!("{}_mount", part.id)
        } else {
            part.id.clone()
        };
        let name = w.joints.fit(&wanted);
        if name != wanted && scene.robot.links.contains(&wanted) {
            let why = "sdformat wants names of links and joints unique together";
            w.out.lost.one("name that another has", Some(&wanted), why);
        }
        w.single.insert((j, usize::MAX), name);
    }
    let root = plan.root;
    let name = w.links.fit(&scene.robot.links[root]);
    w.frames.insert(root, RigidMotion::IDENTITY);
    w.names.insert(root, name);
    for b in &plan.branches {
        let name = w.links.fit(&scene.robot.links[b.link]);
        w.names.insert(b.link, name);
        w.frames.insert(b.link, b.far);
    }
    w.name_singles();
    w.couplings();
    w.link(root, false);
    for b in &plan.branches {
        w.link(b.link, moves(b));
        w.branch(b);
    }
    for &j in &plan.loops {
        w.closing(j);
    }
    for (name, ..) in &scene.payload.frames {
        w.out.lost.no_word("site or frame", Some(name));
    }
    w.whole()
}

impl ToUrdf<'_> {
    /// The name of a joint.
    fn id(&self, j: usize) -> String {
        self.single[&(j, usize::MAX)].clone()
    }

    fn name_singles(&mut self) {
        for b in &self.scene.plan.branches {
            let id = self.id(b.joint);
            for (i, s) in b.singles.iter().enumerate() {
                let name = match i {
                    0 => id.clone(),
                    i => self.joints.fit(&name_of(&id, i)),
                };
                self.single.insert((b.joint, s.freedom), name);
            }
        }
    }

    /// Couplings as mimic joints.
    fn couplings(&mut self) {
        let branches = &self.scene.plan.branches;
        let held = |j: usize| {
            branches
                .iter()
                .any(|b| b.joint == j && b.singles.len() == 1)
        };
        let all = mimics(self.scene, held, false, &mut self.out.lost);
        for (j, f) in all {
            let leader = self.id(f.leader);
            self.mimics.insert(self.id(j), (leader, f.ratio, f.offset));
        }
    }

    /// Transmissions, of actuators and of joints that are driven.
    fn transmissions(&mut self) -> String {
        let payload = self.scene.payload;
        let mut all: Vec<(Option<String>, usize, f64, Command, f64)> = Vec::new();
        let own = |a: &Actuator| {
            (
                a.name.clone(),
                a.joint,
                a.gear,
                a.command,
                payload.of(a.joint, 0).armature,
            )
        };
        all.extend(payload.actuators.iter().map(own));
        for (j, part) in self.scene.robot.joints.iter().enumerate() {
            if part.drive && !all.iter().any(|a| a.1 == j) {
                all.push((None, j, 1.0, Command::Effort, 0.0));
            }
        }
        let (mut text, mut names) = (String::new(), Names::default());
        for (name, j, gear, command, rotor) in all {
            let held = self
                .scene
                .plan
                .branches
                .iter()
                .any(|b| b.joint == j && b.singles.len() == 1);
            if !held {
                self.out.lost.no_word(
                    "actuator of a joint of the loop, or of several freedoms",
                    name.as_deref(),
                );
                continue;
            }
            let joint = self.id(j);
            let name = names.fit(&name.unwrap_or_else(|| format!("{joint}_motor")));
            let word = match command {
                Command::Effort => "Effort",
                Command::Position => "Position",
                Command::Velocity => "Velocity",
            };
            let drakes = if self.loops == Loops::Drake && rotor > 0.0 {
                format!("<drake:gear_ratio value=\"1\"/><drake:rotor_inertia value=\"{rotor}\"/>")
            } else {
                String::new()
            };
            let (joint, name) = (escape(&joint), escape(&name));
            let _ = write!(
                text,
                "  <transmission name=\"{name}\">\n    <type>transmission_interface/SimpleTransmission</type>\n    <joint name=\"{joint}\"><hardwareInterface>hardware_interface/{word}JointInterface</hardwareInterface></joint>\n    <actuator name=\"{name}\"><mechanicalReduction>{}</mechanicalReduction>{drakes}</actuator>\n  </transmission>\n",
                number(gear),
            );
        }
        text
    }

    fn whole(mut self) -> Text {
        let transmissions = self.transmissions();
        for a in self
            .scene
            .payload
            .actuators
            .iter()
            .filter(|a| !a.words.is_empty())
        {
            self.out
                .lost
                .no_word("gains and ranges of an actuator", a.name.as_deref());
        }
        if !self.scene.payload.option.is_empty() {
            self.out.lost.no_word("option", None);
        }
        let space = match self.loops {
            Loops::Drake => " xmlns:drake=\"http://drake.mit.edu\"",
            _ => "",
        };
        let known = match self.scene.known {
            "" => String::new(),
            k => format!("  {k}\n"),
        };
        self.out.text = format!(
            "<?xml version=\"1.0\"?>\n<robot name=\"{}\"{space}>\n{known}{}{}{transmissions}</robot>\n",
            escape(&self.scene.robot.name),
            self.head,
            self.body,
        );
        if self.loops == Loops::Beside {
            self.out.beside = Some(self.side());
        }
        self.out
    }
}
