//! Bodies, each with the joints that hold it.

use crate::geom::rigid::RigidMotion;
use crate::model::joint_type::JointType;
use crate::robots::convert::payload::Weight;
use crate::robots::convert::plan::{Branch, Moves, Single};
use crate::robots::convert::scene::{limits, moves};
use crate::robots::convert::solid::turned;
use crate::robots::convert::text::{attributes, is_straight, pos_axes, quaternion};
use crate::robots::convert::to_mjcf::ToMjcf;
use crate::robots::mechanism::series_of_single_joints::{escape, number, numbers};
use std::fmt::Write;

/// The lines of all bodies.
#[derive(Default)]
struct Bodies {
    lines: String,
    depth: usize,
}

impl Bodies {
    fn line(&mut self, text: &str) {
        let _ = writeln!(self.lines, "{}{text}", "  ".repeat(self.depth.min(40) + 2));
    }
}

/// A body to begin, or one to end.
enum Next {
    Begin(usize),
    End,
}

impl ToMjcf<'_> {
    /// Writes the bodies from the root on, each link after the one that bears it.
    pub(super) fn written(&mut self) -> String {
        let mut bodies = Bodies::default();
        let out = &mut bodies;
        let root = self.scene.plan.root;
        let world = self.scene.robot.world == Some(root);
        let mut stack = Vec::new();
        if world {
            self.inside(root, false, out);
        } else {
            let at = pos_axes(&self.scene.places[root]);
            out.line(&format!(
                "<body name=\"{}\"{at}>",
                escape(&self.names[&root])
            ));
            out.depth += 1;
            self.inside(root, false, out);
            stack.push(Next::End);
        }
        self.bearing(root, &mut stack);
        while let Some(next) = stack.pop() {
            match next {
                Next::Begin(link) => {
                    self.body(link, out);
                    stack.push(Next::End);
                    self.bearing(link, &mut stack);
                }
                Next::End => {
                    out.depth -= 1;
                    out.line("</body>");
                }
            }
        }
        bodies.lines
    }

    /// What hangs on a link, past links in between; the first is on top of the stack.
    fn bearing(&self, link: usize, stack: &mut Vec<Next>) {
        let mut all: Vec<usize> = self
            .scene
            .plan
            .on(link)
            .map(|b| self.past_between(b.link))
            .collect();
        all.reverse();
        stack.extend(all.into_iter().map(Next::Begin));
    }

    fn past_between(&self, mut link: usize) -> usize {
        while self.scene.is_between(link)
            && let Some(b) = self.scene.plan.on(link).next()
            && moves(b)
        {
            link = b.link;
        }
        link
    }

    /// The joints that hold a body, from the body that bears it.
    fn chain(&self, link: usize) -> Vec<Branch> {
        let plan = self.scene.plan;
        let mut all: Vec<Branch> = plan.into(link).cloned().into_iter().collect();
        while let Some(first) = all.first()
            && moves(first)
            && self.scene.is_between(first.from)
            && let Some(b) = plan.into(first.from)
        {
            let b = b.clone();
            all.insert(0, b);
        }
        all
    }

    fn body(&mut self, link: usize, out: &mut Bodies) {
        let chain = self.chain(link);
        let at = chain
            .iter()
            .fold(RigidMotion::IDENTITY, |at, b| at.then(&b.at_zero()));
        out.line(&format!(
            "<body name=\"{}\"{}>",
            escape(&self.names[&link]),
            pos_axes(&at)
        ));
        out.depth += 1;
        let mut lines = Vec::new();
        for (i, b) in chain.iter().enumerate() {
            // Where the joint is on the body that they all hold, with those behind it at zero.
            let behind = chain[i + 1..]
                .iter()
                .fold(RigidMotion::IDENTITY, |at, b| at.then(&b.at_zero()));
            let place = behind.inverse().then(&b.far);
            self.joint(b, &place, &mut lines);
        }
        lines.iter().for_each(|l| out.line(l));
        self.inside(link, chain.iter().any(moves), out);
    }

    /// Weight, shapes and sites of a link.
    fn inside(&mut self, link: usize, moving: bool, out: &mut Bodies) {
        if self.scene.robot.world != Some(link) {
            match self.scene.weight(link) {
                Some(w) => {
                    let line = self.weight(link, w, moving);
                    out.line(&line);
                }
                None if moving => {
                    out.line(&self.scene.light.mjcf([0.0; 3]));
                    self.told(
                        "what moves without mass weighs next to nothing: MuJoCo refuses it else",
                    );
                }
                None => {}
            }
        }
        for s in self.scene.shapes(link) {
            let line = self.meshes.geom(s);
            out.line(&line);
        }
        for l in self.beside.get(&link).into_iter().flatten() {
            out.line(l);
        }
        let small = self.small_qpos.get(&link).cloned();
        self.qpos.extend(small.unwrap_or_default());
    }

    pub(super) fn told(&mut self, what: &str) {
        if !self.out.told.iter().any(|t| t == what) {
            self.out.told.push(what.to_owned());
        }
    }

    fn weight(&mut self, link: usize, w: &Weight, moving: bool) -> String {
        let (mut w, whole) = self.scene.admitted(link, w, moving, &mut self.out.lost);
        self.balanced |= !whole;
        // In the link's axes, unless the tensor is that of its own.
        let straight = w.tensor[3..] == [0.0; 3];
        if !straight {
            w.tensor = turned(w.tensor, &w.place);
            w.place = RigidMotion::shift(w.place.translation);
        }
        let tensor = w.tensor.map(|x| number(x).to_string());
        let inertia = if straight {
            format!("diaginertia=\"{}\"", tensor[..3].join(" "))
        } else {
            format!("fullinertia=\"{}\"", tensor.join(" "))
        };
        let at = pos_axes(&RigidMotion {
            translation: [0.0; 3],
            ..w.place
        });
        let pos = numbers(w.place.translation);
        format!(
            "<inertial pos=\"{pos}\"{at} mass=\"{}\" {inertia}/>",
            w.mass
        )
    }

    /// The lines of a joint at a place of its body, and the numbers of the keyframe.
    fn joint(&mut self, b: &Branch, place: &RigidMotion, lines: &mut Vec<String>) {
        let part = self.scene.part(b.joint);
        let world = self.scene.robot.world == Some(b.from) && self.scene.plan.root == b.from;
        if b.is_free() && world {
            lines.push(format!(
                "<freejoint name=\"{}\"/>",
                escape(&self.single[&(b.joint, 0)])
            ));
            let at = b.across();
            self.qpos.extend(at.translation);
            self.qpos.extend(quaternion(&at));
            let drawn = b.at_zero();
            self.moved |=
                at.translation != drawn.translation || !is_straight(&drawn.inverse().then(&at));
            return;
        }
        if part.joint_type == JointType::Spherical {
            let words = self.resisting(b.joint, 0, false);
            let at = numbers(place.translation);
            let name = escape(&self.single[&(b.joint, 0)]);
            lines.push(format!(
                "<joint name=\"{name}\" type=\"ball\" pos=\"{at}\"{words}/>"
            ));
            let turn = b
                .singles
                .iter()
                .fold(RigidMotion::IDENTITY, |m, s| m.then(&s.displacement()));
            let turn = place.then(&turn).then(&place.inverse());
            self.moved |= b.singles.iter().any(|s| s.value != 0.0);
            self.qpos.extend(quaternion(&turn));
            return;
        }
        let alone = b.singles.len() == 1;
        for s in &b.singles {
            self.single_joint(b.joint, s, place, alone, lines);
        }
    }

    /// The line of a freedom at a place of its body.
    pub(super) fn single_joint(
        &mut self,
        joint: usize,
        s: &Single,
        place: &RigidMotion,
        alone: bool,
        lines: &mut Vec<String>,
    ) {
        let part = self.scene.part(joint);
        let name = self.single[&(joint, s.freedom)].clone();
        let zero = if alone { part.zero } else { 0.0 };
        let mut words = self.resisting(joint, s.freedom, alone);
        if zero != 0.0 {
            words += &format!(" ref=\"{}\"", number(zero));
        }
        if let (true, Some((low, high))) = (alone, limits(self.scene, joint)) {
            words += &format!(" range=\"{} {}\"", number(low + zero), number(high + zero));
        }
        let kind = if Self::turns(s.moves) {
            "hinge"
        } else {
            "slide"
        };
        let at = numbers(place.translation);
        let axis = numbers(place.direction(s.axis));
        lines.push(format!(
            "<joint name=\"{}\" type=\"{kind}\" pos=\"{at}\" axis=\"{axis}\"{words}/>",
            escape(&name)
        ));
        self.qpos.push(s.value + zero);
        self.moved |= s.value != 0.0;
        if let Moves::Screw(pitch) = s.moves {
            let thread = self.joints.fit(&format!("{name}~thread"));
            lines.push(format!(
                "<joint name=\"{}\" type=\"slide\" pos=\"{at}\" axis=\"{axis}\"/>",
                escape(&thread)
            ));
            self.qpos.push(s.value * pitch);
            self.equalities.push(format!(
                "    <joint joint1=\"{}\" joint2=\"{}\" polycoef=\"0 {} 0 0 0\"/>\n",
                escape(&thread),
                escape(&name),
                number(pitch)
            ));
        }
    }

    /// Damping and the like.
    fn resisting(&mut self, joint: usize, freedom: usize, alone: bool) -> String {
        let d = self.scene.payload.of(joint, freedom);
        let zero = if alone {
            self.scene.part(joint).zero
        } else {
            0.0
        };
        let rest = if d.stiffness > 0.0 {
            d.rest + zero
        } else {
            0.0
        };
        let all = [
            ("damping", d.damping),
            ("frictionloss", d.friction),
            ("armature", d.armature),
            ("stiffness", d.stiffness),
            ("springref", rest),
        ];
        let said = all.iter().filter(|a| a.1 != 0.0);
        let mut out: String = said
            .map(|(k, x)| format!(" {k}=\"{}\"", number(*x)))
            .collect();
        if d.effort.is_finite() && alone {
            out += &format!(" actuatorfrcrange=\"-{} {}\"", d.effort, d.effort);
        }
        if d.velocity.is_finite() {
            let id = self.scene.part(joint).id.clone();
            self.out
                .lost
                .no_word("greatest speed of a joint", Some(&id));
        }
        out + &attributes(&d.words)
    }

    /// A site on a link.
    pub(super) fn site(&mut self, link: usize, name: &str, place: &RigidMotion) {
        let line = format!("<site name=\"{}\"{}/>", escape(name), pos_axes(place));
        self.beside.entry(link).or_default().push(line);
    }
}
