//! Joints of the tree of a URDF.

use crate::geom::rigid::RigidMotion;
use crate::model::joint_type::{Freedom, JointType};
use crate::robots::convert::payload::Dynamics;
use crate::robots::convert::plan::{Branch, Moves, Single};
use crate::robots::convert::scene::{limits, name_of};
use crate::robots::convert::text::xyz_rpy;
use crate::robots::convert::to_urdf::{ENDLESS, Loops, ToUrdf};
use crate::robots::mechanism::series_of_single_joints::{escape, number, numbers};
use std::fmt::Write;

/// A joint of one freedom as it stands in the file.
struct JointTag<'a> {
    name: &'a str,
    /// Its type.
    kind: &'a str,
    /// Its parent and its child.
    ends: &'a [String; 2],
    at: &'a RigidMotion,
}

impl ToUrdf<'_> {
    /// The joints that hold a link.
    pub(super) fn branch(&mut self, b: &Branch) {
        let part = self.scene.part(b.joint);
        let at = self.frames[&b.from].inverse().then(&b.near);
        let ends = [self.names[&b.from].clone(), self.names[&b.link].clone()];
        let id = self.id(b.joint);
        let drakes = self.loops == Loops::Drake && part.joint_type == JointType::Spherical;
        let whole = match part.joint_type {
            _ if b.singles.is_empty() => Some("fixed"),
            _ if b.is_free() => Some("floating"),
            JointType::Spherical if drakes => Some("ball"),
            JointType::Planar if !b.backward => Some("planar"),
            _ => None,
        };
        if let Some(kind) = whole {
            let axis = match kind {
                "planar" => format!(
                    "    <axis xyz=\"{}\"/>\n",
                    numbers(part.direction(Freedom::Rz))
                ),
                _ => String::new(),
            };
            let damping = self.scene.payload.of(b.joint, 0).damping;
            let axis = axis
                + &if drakes && damping != 0.0 {
                    format!("    <dynamics damping=\"{damping}\"/>\n")
                } else {
                    String::new()
                };
            let tag = if drakes { "drake:joint" } else { "joint" };
            self.put(tag, &id, kind, &ends, &at, &axis);
            return;
        }
        if part.joint_type == JointType::Spherical {
            let why = "three hinges in series stand for it";
            self.out
                .lost
                .one("ball joint of the tree", Some(&part.id), why);
        }
        self.series(b.joint, &b.singles, at, ends);
    }

    /// Freedoms in series between two links, through light links.
    pub(super) fn series(
        &mut self,
        joint: usize,
        all: &[Single],
        at: RigidMotion,
        [from, to]: [String; 2],
    ) {
        let (mut from, mut at) = (from, at);
        for (i, s) in all.iter().enumerate() {
            let name = match self.single.get(&(joint, s.freedom)) {
                Some(n) => n.clone(),
                None => self.joints.fit(&name_of(&self.id(joint), i)),
            };
            let last = i + 1 == all.len();
            let screws = matches!(s.moves, Moves::Screw(_));
            let held = if last && !screws {
                to.clone()
            } else {
                self.between(&name)
            };
            let kind = if s.moves == Moves::Slide {
                "prismatic"
            } else {
                "continuous"
            };
            let alone = all.len() == 1;
            let tag = JointTag {
                name: &name,
                kind,
                ends: &[from, held.clone()],
                at: &at,
            };
            self.single(joint, s, &tag, alone);
            (from, at) = (held, RigidMotion::IDENTITY);
            if let Moves::Screw(pitch) = s.moves {
                let thread = self.joints.fit(&format!("{name}~thread"));
                let held = if last {
                    to.clone()
                } else {
                    self.between(&thread)
                };
                self.mimics
                    .insert(thread.clone(), (name.clone(), pitch, 0.0));
                let slide = Single {
                    moves: Moves::Slide,
                    ..*s
                };
                let tag = JointTag {
                    name: &thread,
                    kind: "prismatic",
                    ends: &[from, held.clone()],
                    at: &at,
                };
                self.single(usize::MAX, &slide, &tag, false);
                from = held;
            }
        }
    }

    /// A light link.
    pub(super) fn between(&mut self, joint: &str) -> String {
        let name = self.links.fit(&format!("{joint}~link"));
        let _ = writeln!(
            self.head,
            "  <link name=\"{}\">{}</link>",
            escape(&name),
            self.scene.light.urdf()
        );
        name
    }

    fn single(&mut self, joint: usize, s: &Single, tag: &JointTag<'_>, alone: bool) {
        let &JointTag {
            name,
            kind,
            ends,
            at,
        } = tag;
        let mut more = format!("    <axis xyz=\"{}\"/>\n", numbers(s.axis));
        let d = self.scene.payload.of(joint, s.freedom);
        let limits = (alone && joint != usize::MAX)
            .then(|| limits(self.scene, joint))
            .flatten();
        let kind = match (kind, limits) {
            ("continuous", Some(_)) => "revolute",
            (kind, _) => kind,
        };
        more += &limit(kind, limits, alone.then_some(&d));
        if d.damping != 0.0 || d.friction != 0.0 {
            let _ = writeln!(
                more,
                "    <dynamics damping=\"{}\" friction=\"{}\"/>",
                number(d.damping),
                number(d.friction)
            );
        }
        if let Some((leads, ratio, offset)) = self.mimics.get(name) {
            let _ = writeln!(
                more,
                "    <mimic joint=\"{}\" multiplier=\"{}\" offset=\"{}\"/>",
                escape(leads),
                number(*ratio),
                number(*offset)
            );
        }
        if joint != usize::MAX {
            self.unsaid(joint, &d);
        }
        self.put("joint", name, kind, ends, at, &more);
    }

    /// What resists a joint and has no word here.
    fn unsaid(&mut self, joint: usize, d: &Dynamics) {
        let id = self.scene.part(joint).id.clone();
        let lost = &mut self.out.lost;
        let driven = self
            .scene
            .payload
            .actuators
            .iter()
            .any(|a| a.joint == joint);
        if d.armature != 0.0 && !(self.loops == Loops::Drake && driven) {
            lost.no_word("armature of a joint", Some(&id));
        }
        if d.stiffness != 0.0 {
            lost.no_word("spring of a joint", Some(&id));
        }
        if !d.words.is_empty() {
            lost.no_word("solver settings of a joint", Some(&id));
        }
        if self.scene.part(joint).zero != 0.0 {
            lost.one(
                "reference of a joint's value",
                Some(&id),
                "it counts from the pose drawn",
            );
        }
    }

    /// A joint of the tree.
    pub(super) fn put(
        &mut self,
        tag: &str,
        name: &str,
        kind: &str,
        [parent, child]: &[String; 2],
        at: &RigidMotion,
        more: &str,
    ) {
        let [parent, child] = [parent, child].map(|l| escape(l));
        let _ = write!(
            self.body,
            "  <{tag} name=\"{}\" type=\"{kind}\">\n    <parent link=\"{parent}\"/>\n    <child link=\"{child}\"/>\n    <origin {}/>\n{more}  </{tag}>\n",
            escape(name),
            xyz_rpy(at),
        );
    }
}

/// `<limit>` where a kind wants one or an actuator has bounds: ends in m or rad, effort in N or N m, velocity in m/s or rad/s.
fn limit(kind: &str, ends: Option<(f64, f64)>, actuator: Option<&Dynamics>) -> String {
    let bounded = actuator.is_some_and(|d| d.effort.is_finite() || d.velocity.is_finite());
    if kind == "continuous" && !bounded {
        return String::new();
    }
    let (low, high) = ends.unwrap_or((-ENDLESS, ENDLESS));
    let place = match kind {
        "continuous" => String::new(),
        _ => format!(" lower=\"{}\" upper=\"{}\"", number(low), number(high)),
    };
    let bound = |x: f64| if x.is_finite() { x } else { ENDLESS };
    let (effort, velocity) =
        actuator.map_or((ENDLESS, ENDLESS), |d| (bound(d.effort), bound(d.velocity)));
    format!("    <limit{place} effort=\"{effort}\" velocity=\"{velocity}\"/>\n")
}
