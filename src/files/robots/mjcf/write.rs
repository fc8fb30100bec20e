//! MJCF: a spanning tree of the free state as bodies; loops as `<connect>` and `<weld>`, other joints that close one as a
//! small body on joints that is welded.

use crate::closure::drive::driven_freedoms;
use crate::closure::tree::spanning_tree;
use crate::robots::description::physical::{GRAM, left_out, moving_inertial, write_head};
use crate::robots::formats::FormattedFile;
use crate::robots::mechanism::series_of_single_joints::{
    Names, clean_number, escape_comment, escape_xml, format_numbers, joint_axes, write_attributes,
};
use crate::robots::prelude::*;

/// Writes the mechanism's free state as MJCF; bodies have the global axes, and their origin at the joint that holds them.
///
/// # Errors
/// No error is known.
pub(crate) fn write_mjcf(m: &Mechanism) -> Result<FormattedFile, ExportError> {
    let mut w = MjcfWriter {
        m,
        bodies: vec![None; m.links.len()],
        own: BTreeMap::new(),
        between: BTreeMap::new(),
        children: BTreeMap::new(),
        parts: BTreeMap::new(),
        joints: BTreeMap::new(),
        equalities: Vec::new(),
        body_names: Names::default(),
        joint_names: Names::default(),
    };
    let frame = m.frame_link();
    w.bodies[frame] = Some((w.body_names.fit_name("world"), [0.0; 3]));
    let mut used = vec![false; m.joints.len()];
    for s in spanning_tree(m, StateId::FREE) {
        used[s.joint] = true;
        let at = joint_axes(m, &m.joints[s.joint]).point;
        w.bodies[s.link] = Some((w.body_names.fit_name(&m.links[s.link].id), at));
        let sign = if s.forward { 1.0 } else { -1.0 };
        let here = w.children.entry(s.from).or_default();
        here.push((s.link, s.joint, sign));
    }
    let mut bodies = String::new();
    // Joint by joint in the order of the file, so that names are fitted in it.
    let tree: Vec<(LinkId, JointId, f64)> = w.children.values().flatten().copied().collect();
    for (link, joint, sign) in tree {
        let lines = w.write_joints(joint, sign, [0.0; 3]);
        w.own.insert(link, lines);
    }
    let closing: Vec<JointId> = m.joints_in(StateId::FREE).filter(|&j| !used[j]).collect();
    for &j in &closing {
        if w.closing_body(j) {
            *w.parts.entry(m.joints[j].links[1]).or_insert(1.0) += 1.0;
        }
    }
    for j in closing {
        w.write_closing(j);
    }
    w.write_couplings();
    w.write_bodies(frame, 2, &mut bodies);
    let mut out = format!("<mujoco model=\"{}\">\n", escape_xml(&m.name));
    let mut told = left_out(m);
    if m.links[frame].id != "world" {
        told.push(format!("the world is {}", m.links[frame].id));
    }
    if m.links_with_ids()
        .any(|(l, k)| l != frame && k.mass.is_none())
    {
        told.push(GRAM.to_owned());
    }
    out += &write_head(m, "  ", &told);
    out += "  <compiler angle=\"radian\"/>\n  <worldbody>\n";
    out += &bodies;
    out += "  </worldbody>\n";
    if !w.equalities.is_empty() {
        let _ = writeln!(out, "  <equality>\n{}  </equality>", w.equalities.concat());
    }
    let motors: String = w.write_motors().concat();
    if !motors.is_empty() {
        let _ = writeln!(out, "  <actuator>\n{motors}  </actuator>");
    }
    out += "</mujoco>\n";
    Ok(FormattedFile { text: out, told })
}

struct MjcfWriter<'a> {
    m: &'a Mechanism,
    /// Names and origins of the links.
    bodies: Vec<Option<(String, Vector)>>,
    /// Lines of the joints that hold a link.
    own: BTreeMap<LinkId, Vec<String>>,
    /// Lines of the small bodies on a link.
    between: BTreeMap<LinkId, Vec<String>>,
    /// The children of a link, each with its joint and the sense in which it is passed.
    children: BTreeMap<LinkId, Vec<(LinkId, JointId, f64)>>,
    /// Number of bodies of a link, if it is more than one: its own, and one on each joint that closes a loop there.
    parts: BTreeMap<LinkId, f64>,
    /// Names of the joints that are one freedom.
    joints: BTreeMap<(JointId, Freedom), String>,
    equalities: Vec<String>,
    body_names: Names,
    joint_names: Names,
}

impl MjcfWriter<'_> {
    /// Returns the joints of one freedom each that represent a joint, or a ball.
    fn write_joints(&mut self, j: JointId, sign: f64, pos: Vector) -> Vec<String> {
        let joint = &self.m.joints[j];
        let p = joint_axes(self.m, joint);
        let coupled = self.m.couplings.iter().any(|c| c.end_at(j).is_some());
        let pos = format_numbers(pos);
        if joint.joint_type == JointType::Spherical && !coupled {
            let name = self.joint_names.fit_name(&joint.id);
            let own = write_attributes([("name", &*name), ("type", "ball"), ("pos", &pos)]);
            let line = format!("<joint{own}/>");
            if let Some(&first) = joint.joint_type.freedoms().first() {
                self.joints.insert((j, first), name);
            }
            return vec![line];
        }
        let mut out = Vec::new();
        for &freedom in joint.joint_type.freedoms() {
            let wanted = match out.len() {
                0 => joint.id.clone(),
                n => format!("{}~{}", joint.id, n + 1),
            };
            let name = self.joint_names.fit_name(&wanted);
            let axis = format_numbers(p.axis(freedom).map(|x| sign * x));
            let mut line = |name: &str, kind: &str| {
                let own = [
                    ("name", name),
                    ("type", kind),
                    ("pos", &pos),
                    ("axis", &axis),
                ];
                out.push(format!("<joint{}/>", write_attributes(own)));
            };
            line(&name, if freedom.is_slide() { "slide" } else { "hinge" });
            if freedom == Freedom::Screw {
                let slide = self.joint_names.fit_name(&format!("{wanted}~thread"));
                line(&slide, "slide");
                let coupling = joint_equality(&slide, &name, p.pitch);
                self.equalities.push(coupling);
            }
            self.joints.insert((j, freedom), name);
        }
        out
    }

    /// Returns true if a joint that closes a loop is written as an extra body that is welded to the second link.
    fn closing_body(&self, j: JointId) -> bool {
        let kind = &self.m.joints[j].joint_type;
        let coupled = self.m.couplings.iter().any(|c| c.end_at(j).is_some());
        !kind.freedoms().is_empty() && (*kind != JointType::Spherical || coupled)
    }

    /// Returns the weight of a body that is welded to `link`, as an attribute list. It is an equal part of the link, so that the whole
    /// moves in the same way. MuJoCo softens a weld by the weight of its bodies, and would let the loop open at a very light one. A body
    /// welded to the frame does not move: it weighs as much as the link `other`.
    fn weight_attributes(&self, link: LinkId, other: LinkId, at: Vector) -> String {
        let fixed = link == self.m.frame_link();
        let of = if fixed { other } else { link };
        let own = self.parts.get(&of).copied().unwrap_or(1.0);
        let parts = if fixed { 1.0 } else { own };
        let i = moving_inertial(self.m, of, at);
        format!(
            "pos=\"{}\" mass=\"{}\" fullinertia=\"{}\"",
            format_numbers(i.centre),
            clean_number(i.mass / parts),
            i.tensor
                .map(|x| clean_number(x / parts).to_string())
                .join(" ")
        )
    }

    fn body_of(&self, link: LinkId) -> (&str, Vector) {
        match &self.bodies[link] {
            Some((name, at)) => (name, *at),
            None => ("world", [0.0; 3]),
        }
    }

    /// Writes a joint that closes a loop.
    fn write_closing(&mut self, j: JointId) {
        let joint = &self.m.joints[j];
        let [a, b] = joint.links;
        let at = joint_axes(self.m, joint).point;
        let (first, origin) = self.body_of(a);
        let (first, from) = (first.to_owned(), format_numbers(sub(at, origin)));
        let second = self.body_of(b).0.to_owned();
        let ends = |first: &str| {
            let all = [("name", &*joint.id), ("body1", first), ("body2", &second)];
            write_attributes(all)
        };
        let line = match &joint.joint_type {
            JointType::Spherical if !self.closing_body(j) => {
                format!("<connect{} anchor=\"{from}\"/>", ends(&first))
            }
            t if t.freedoms().is_empty() => format!("<weld{}/>", ends(&first)),
            _ => {
                let name = self.body_names.fit_name(&format!("{}~body", joint.id));
                let inner = self.write_joints(j, 1.0, [0.0; 3]);
                let weight = self.weight_attributes(b, a, at);
                let lines = self.between.entry(a).or_default();
                let own = write_attributes([("name", &*name), ("pos", &from)]);
                lines.push(format!("<body{own}>"));
                lines.push(format!("  <inertial {weight}/>"));
                lines.extend(inner.into_iter().map(|l| format!("  {l}")));
                lines.push("</body>".to_owned());
                format!("<weld{}/>", ends(&name))
            }
        };
        self.equalities.push(format!("    {line}\n"));
    }

    fn write_couplings(&mut self) {
        for c in self.m.couplings_in(StateId::FREE) {
            let name = |e: usize| {
                let end = &c.ends[e];
                self.joints.get(&(end.joint, end.freedom))
            };
            let unit = |e: usize| match c.ends[e].freedom {
                f if f.is_slide() => self.m.length_unit.metres,
                _ => 1.0,
            };
            if let (Some(leads), Some(follows)) = (name(0), name(1)) {
                let ratio = c.ratio.to_f64() * unit(1) / unit(0);
                self.equalities.push(joint_equality(follows, leads, ratio));
            }
        }
    }

    /// Motors of the driven joints, each on the freedom that statics have its drive hold: a slider may turn about its guide.
    fn write_motors(&self) -> Vec<String> {
        let (m, free) = (self.m, StateId::FREE);
        let held = driven_freedoms(m, free);
        let drives = m.joints_in(free).filter(|&j| m.joints[j].drive);
        let motors = drives.filter_map(|j| {
            let of_drive = held.iter().find(|(k, _)| *k == j);
            // A ball is one joint whichever of its turns is held.
            let name = of_drive
                .and_then(|h| self.joints.get(h))
                .or_else(|| self.joints.iter().find(|((k, _), _)| *k == j).map(|x| x.1))?;
            let own = write_attributes([("joint", &**name)]);
            Some(format!("    <motor{own}/>\n"))
        });
        motors.collect()
    }

    /// Writes the bodies on a link.
    fn write_bodies(&self, link: LinkId, depth: usize, out: &mut String) {
        let indent = "  ".repeat(depth);
        let (_, from) = self.body_of(link);
        for line in self.between.get(&link).into_iter().flatten() {
            let _ = writeln!(out, "{indent}{line}");
        }
        for &(child, ..) in self.children.get(&link).into_iter().flatten() {
            let (name, at) = self.body_of(child);
            let role = match self.m.links[child].role {
                Role::Output => format!("  <!-- {} is an output -->", escape_comment(name)),
                _ => String::new(),
            };
            let pos = format_numbers(sub(at, from));
            let own = write_attributes([("name", name), ("pos", &pos)]);
            let _ = writeln!(out, "{indent}<body{own}>{role}");
            let weight = self.weight_attributes(child, child, at);
            let _ = writeln!(out, "{indent}  <inertial {weight}/>");
            for line in self.own.get(&child).into_iter().flatten() {
                let _ = writeln!(out, "{indent}  {line}");
            }
            self.write_bodies(child, depth + 1, out);
            let _ = writeln!(out, "{indent}</body>");
        }
    }
}

/// Writes a joint that follows another.
fn joint_equality(follows: &str, leads: &str, ratio: f64) -> String {
    let polynomial = format!("0 {} 0 0 0", clean_number(ratio));
    let own = [
        ("joint1", follows),
        ("joint2", leads),
        ("polycoef", &polynomial),
    ];
    format!("    <joint{}/>\n", write_attributes(own))
}
