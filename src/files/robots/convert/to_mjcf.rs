//! A robot as MJCF: bodies with their own frames, joints in series in one body, loops by sites, so that they need not be closed
//! where the joints are at zero; a keyframe has the pose in which they are.

mod body;
mod closing;
mod geom;

use crate::model::joint_type::JointType;
use crate::robots::convert::payload::{Actuator, Command};
use crate::robots::convert::plan::Moves;
use crate::robots::convert::scene::{RobotScene, Text, name_of};
use crate::robots::convert::text::attributes;
use crate::robots::description::parts::Ratio;
use crate::robots::mechanism::series_of_single_joints::{Names, escape, number};
use std::collections::BTreeMap;
use std::fmt::Write;

/// What the file collects while its bodies are written.
struct ToMjcf<'a> {
    scene: &'a RobotScene<'a>,
    names: BTreeMap<usize, String>,
    bodies: Names,
    joints: Names,
    sites: Names,
    closures: Names,
    /// Names of single freedoms: of which joint, and its which.
    single: BTreeMap<(usize, usize), String>,
    /// Lines on a link besides its own: small bodies and sites.
    beside: BTreeMap<usize, Vec<String>>,
    equalities: Vec<String>,
    meshes: geom::Meshes,
    qpos: Vec<f64>,
    /// Those of the small bodies on a link, which come before its other bodies.
    small_qpos: BTreeMap<usize, Vec<f64>>,
    /// Whether any of these is not as drawn.
    moved: bool,
    /// Whether MuJoCo is to mend tensors of inertia.
    balanced: bool,
    out: Text,
}

/// Writes it.
pub(crate) fn mjcf(scene: &RobotScene<'_>) -> Text {
    let mut w = ToMjcf {
        scene,
        names: BTreeMap::new(),
        bodies: Names::default(),
        joints: Names::default(),
        sites: Names::default(),
        closures: Names::default(),
        single: BTreeMap::new(),
        beside: BTreeMap::new(),
        equalities: Vec::new(),
        meshes: geom::Meshes::default(),
        qpos: Vec::new(),
        small_qpos: BTreeMap::new(),
        moved: false,
        balanced: false,
        out: Text::default(),
    };
    w.bodies.fit("world");
    let plan = scene.plan;
    for l in std::iter::once(plan.root).chain(plan.branches.iter().map(|b| b.link)) {
        let name = if Some(l) == scene.robot.world {
            "world".to_owned()
        } else {
            w.bodies.fit(&scene.robot.links[l])
        };
        w.names.insert(l, name);
    }
    w.name_joints();
    for (name, link, place) in &scene.payload.frames {
        let name = w.sites.fit(name);
        w.site(*link, &name, place);
    }
    for &j in &plan.loops {
        w.closing(j);
    }
    let bodies = w.written();
    w.couplings();
    w.whole(&bodies)
}

impl ToMjcf<'_> {
    /// Names of all freedoms, in the order of the robot's joints, so that the first of a name keeps it.
    fn name_joints(&mut self) {
        for (j, part) in self.scene.robot.joints.iter().enumerate() {
            // What closes a loop as a point has no joint of its own.
            let closes = self.scene.plan.loops.contains(&j);
            if closes && part.joint_type == JointType::Spherical {
                continue;
            }
            for f in 0..part.joint_type.freedoms().len() {
                let name = self.joints.fit(&name_of(&part.id, f));
                self.single.insert((j, f), name);
            }
        }
    }

    /// Joints that follow others.
    fn couplings(&mut self) {
        let robot = self.scene.robot;
        for c in &robot.couplings {
            let found = c.joints.each_ref().map(|id| {
                let j = robot.joints.iter().position(|p| p.id == *id)?;
                let one = robot.joints[j].joint_type.freedoms().len() == 1;
                self.single.get(&(j, 0)).filter(|_| one).map(|n| escape(n))
            });
            let [Some(leads), Some(follows)] = found else {
                self.out.lost.one(
                    "coupling",
                    Some(&c.joints[1]),
                    "its joints are not two of one freedom",
                );
                self.out.lost.coupling_rows += 1;
                continue;
            };
            let coefficients = self.polynomial(c);
            let words = self.scene.payload.couplings.get(&c.said_by);
            let words = words.map_or(String::new(), |w| attributes(w));
            self.equalities.push(format!(
                "    <joint joint1=\"{follows}\" joint2=\"{leads}\" polycoef=\"{coefficients}\"{words}/>\n"
            ));
        }
    }

    fn polynomial(&self, c: &Ratio) -> String {
        let offset = self
            .scene
            .payload
            .offsets
            .get(&c.said_by)
            .copied()
            .unwrap_or(0.0);
        let all = [offset, c.ratio, c.higher[0], c.higher[1], c.higher[2]];
        all.map(|x| number(x).to_string()).join(" ")
    }

    fn actuators(&mut self) -> String {
        let payload = self.scene.payload;
        let mut text = String::new();
        let mut names = Names::default();
        for a in &payload.actuators {
            let Some(joint) = self.single.get(&(a.joint, 0)) else {
                self.out
                    .lost
                    .no_word("actuator of a joint that is rigid", a.name.as_deref());
                continue;
            };
            let joint = escape(joint);
            if let Some(tag) = &a.tag {
                let words = attributes(&a.words);
                let _ = writeln!(text, "    <{tag} joint=\"{joint}\"{words}/>");
                continue;
            }
            let name = a.name.as_ref().map_or(String::new(), |n| {
                format!(" name=\"{}\"", escape(&names.fit(n)))
            });
            let bound = range(payload.of(a.joint, 0).effort / a.gear.abs());
            let _ = writeln!(
                text,
                "    <motor{name} joint=\"{joint}\" gear=\"{}\"{bound}/>",
                number(a.gear)
            );
            if a.command != Command::Effort {
                let why = "a motor stands for it: the file has no gains";
                self.out.lost.one(
                    "command of an actuator other than effort",
                    a.name.as_deref(),
                    why,
                );
            }
        }
        let driven = |a: &Actuator, j: usize| a.joint == j;
        for (j, part) in self.scene.robot.joints.iter().enumerate() {
            let has = payload.actuators.iter().any(|a| driven(a, j));
            if let (true, false, Some(name)) = (part.drive, has, self.single.get(&(j, 0)))
                && part.values.len() == 1
            {
                let bound = range(payload.of(j, 0).effort);
                let _ = writeln!(text, "    <motor joint=\"{}\"{bound}/>", escape(name));
            }
        }
        text
    }

    /// The whole file.
    fn whole(mut self, bodies: &str) -> Text {
        let actuators = self.actuators();
        let scene = self.scene;
        let mut out = format!("<mujoco model=\"{}\">\n", escape(&scene.robot.name));
        if !scene.known.is_empty() {
            let _ = writeln!(out, "  {}", scene.known);
        }
        let balanced = if self.balanced {
            " balanceinertia=\"true\""
        } else {
            ""
        };
        let _ = writeln!(
            out,
            "  <compiler angle=\"radian\" autolimits=\"true\" inertiafromgeom=\"false\"{balanced}/>"
        );
        if !scene.payload.option.is_empty() {
            let _ = writeln!(out, "  <option{}/>", attributes(&scene.payload.option));
        }
        out += &self.meshes.asset();
        let _ = write!(out, "  <worldbody>\n{bodies}  </worldbody>\n");
        if !self.equalities.is_empty() {
            let _ = write!(
                out,
                "  <equality>\n{}  </equality>\n",
                self.equalities.concat()
            );
        }
        if !actuators.is_empty() {
            let _ = write!(out, "  <actuator>\n{actuators}  </actuator>\n");
        }
        if self.moved {
            let all: Vec<String> = self.qpos.iter().map(|x| number(*x).to_string()).collect();
            let _ = write!(
                out,
                "  <keyframe>\n    <key name=\"closed\" qpos=\"{}\"/>\n  </keyframe>\n",
                all.join(" ")
            );
        }
        out += "</mujoco>\n";
        self.out.text = out;
        self.out
    }

    /// Whether a freedom turns.
    fn turns(moves: Moves) -> bool {
        moves != Moves::Slide
    }
}

/// The range of a motor's control.
fn range(bound: f64) -> String {
    if bound.is_finite() {
        format!(" ctrlrange=\"-{bound} {bound}\"")
    } else {
        String::new()
    }
}
