//! URDF: a spanning tree of the free state; the joints that close loops are `<loop_joint>`s.

use crate::closure::tree::{TreeStep, spanning_tree};
use crate::robots::description::coupling::{Follows, find_mimics};
use crate::robots::description::physical::{
    GRAM, LIGHT_URDF, left_out, link_inertial, moving_inertial, write_head,
};
use crate::robots::formats::FormattedFile;
use crate::robots::mechanism::series_of_single_joints::{
    Names, clean_number, escape_comment, escape_xml, format_numbers, joint_axes, write_attributes,
};
use crate::robots::prelude::*;

/// The content of a file.
struct UrdfWriter<'a> {
    m: &'a Mechanism,
    links: Names,
    joints: Names,
    /// Name of each written link, and the place of its frame.
    placed: Vec<Option<(String, [f64; 3])>>,
    /// Names of the joints.
    ids: Vec<String>,
    /// The joints that joints of the tree follow.
    follows: Vec<Option<Follows>>,
    head: String,
    body: String,
}

/// Writes the mechanism's free state as URDF. Every link's frame is at the joint that holds it, with the global axes.
///
/// # Errors
/// Returns an error if a joint is helical, because URDF has no such joint.
pub(crate) fn write_urdf(m: &Mechanism) -> Result<FormattedFile, ExportError> {
    let mut w = UrdfWriter {
        m,
        links: Names::default(),
        joints: Names::default(),
        placed: vec![None; m.links.len()],
        ids: vec![String::new(); m.joints.len()],
        follows: Vec::new(),
        head: String::new(),
        body: String::new(),
    };
    w.write_link(m.frame_link(), [0.0; 3]);
    let tree = spanning_tree(m, StateId::FREE);
    let in_tree = |j: JointId| tree.iter().any(|s| s.joint == j);
    let closing = m.joints_in(StateId::FREE).filter(|&j| !in_tree(j));
    let closing: Vec<JointId> = closing.collect();
    // Joints may follow later ones, so names come first.
    for j in tree.iter().map(|s| s.joint).chain(closing.iter().copied()) {
        w.ids[j] = w.joints.fit_name(&m.joints[j].id);
    }
    let mut single = vec![false; m.joints.len()];
    for step in &tree {
        single[step.joint] = joint_kinds(m, step.joint, 1.0)?.len() == 1;
    }
    let (follows, unsaid) = find_mimics(m, &single);
    w.follows = follows;
    for step in &tree {
        w.write_branch(step)?;
    }
    for j in closing {
        w.write_closing(j)?;
    }
    Ok(w.write_file(unsaid))
}

impl UrdfWriter<'_> {
    /// Writes a link with its frame at a point, and returns its name.
    fn write_link(&mut self, l: LinkId, at: [f64; 3]) -> String {
        let name = self.links.fit_name(&self.m.links[l].id);
        // A fixed link needs no mass, and some readers reject one.
        let weight = if l == self.m.frame_link() {
            link_inertial(self.m, l, at)
        } else {
            Some(moving_inertial(self.m, l, at))
        };
        let weight = weight.map_or("/>".to_owned(), |i| {
            let [xx, yy, zz, xy, xz, yz] = i.tensor.map(clean_number);
            format!(
                "><inertial><origin xyz=\"{}\"/><mass value=\"{}\"/><inertia ixx=\"{xx}\" ixy=\"{xy}\" ixz=\"{xz}\" iyy=\"{yy}\" iyz=\"{yz}\" izz=\"{zz}\"/></inertial></link>",
                format_numbers(i.centre), i.mass
            )
        });
        let _ = writeln!(self.head, "  <link name=\"{}\"{weight}", escape_xml(&name));
        self.placed[l] = Some((name.clone(), at));
        name
    }

    /// Writes a light link between the freedoms of a joint, and returns its name.
    fn write_between(&mut self, id: &str, place: usize) -> String {
        let name = self.links.fit_name(&format!("{id}~{place}~link"));
        let link = escape_xml(&name);
        let _ = writeln!(self.head, "  <link name=\"{link}\">{LIGHT_URDF}</link>");
        name
    }

    fn write_driven(&mut self, j: JointId, id: &str) {
        if self.m.joints[j].drive {
            let _ = writeln!(self.body, "  <!-- {} is driven -->", escape_comment(id));
        }
    }

    /// Writes a joint of the tree with its child link.
    fn write_branch(&mut self, step: &TreeStep) -> Result<(), ExportError> {
        let j = step.joint;
        let (mut holder, origin) = self.placed[step.from].clone().unwrap_or_default();
        let p = joint_axes(self.m, &self.m.joints[j]);
        let mut at = sub(p.point, origin);
        let id = self.ids[j].clone();
        let child = self.write_link(step.link, p.point);
        // The child moves in the opposite direction if the joint is passed backwards.
        let sign = if step.forward { 1.0 } else { -1.0 };
        let parts = joint_kinds(self.m, j, sign)?;
        for (i, joint) in parts.iter().enumerate() {
            let held = if i + 1 == parts.len() {
                child.clone()
            } else {
                self.write_between(&id, i + 1)
            };
            let part = match i {
                0 => id.clone(),
                _ => self.joints.fit_name(&format!("{id}~{}", i + 1)),
            };
            let ends = [holder.as_str(), held.as_str()];
            self.body += &tree_joint(&part, joint, ends, at, &self.write_mimic(j));
            (holder, at) = (held, [0.0; 3]);
        }
        self.write_driven(j, &id);
        Ok(())
    }

    /// Writes a joint that closes a loop: all but the last of its freedoms are joints of the tree; a ball or a rigid joint closes
    /// it directly.
    fn write_closing(&mut self, j: JointId) -> Result<(), ExportError> {
        let joint = &self.m.joints[j];
        let p = joint_axes(self.m, joint);
        let id = self.ids[j].clone();
        let placed = joint.links.map(|l| self.placed[l].clone());
        let [(mut a, mut from), (b, to)] = placed.map(Option::unwrap_or_default);
        let mut parts = match joint.joint_type {
            JointType::Spherical => vec![("spherical", None)],
            _ => joint_kinds(self.m, j, 1.0)?,
        };
        let closes = parts.pop().unwrap_or(("fixed", None));
        if ["planar", "floating"].contains(&closes.0) {
            return Err(ExportError::Joint {
                joint: joint.id.clone(),
                kind: closes.0.to_owned(),
                format: "URDF's <loop_joint>",
                remedy: "write MJCF instead",
            });
        }
        for (i, kind) in parts.iter().enumerate() {
            let between = self.write_between(&id, i + 1);
            let part = self.joints.fit_name(&format!("{id}~{}", i + 1));
            let ends = [a.as_str(), between.as_str()];
            self.body += &tree_joint(&part, kind, ends, sub(p.point, from), "");
            (a, from) = (between, p.point);
        }
        let end = |link: &str, origin: Vector| {
            let place = format_numbers(sub(p.point, origin));
            write_attributes([("link", link), ("xyz", &place), ("rpy", "0 0 0")])
        };
        let (own, axis) = (name_and_type(&id, closes.0), write_axis(closes.1));
        let (first, second) = (end(&a, from), end(&b, to));
        let _ = write!(
            self.body,
            "  <loop_joint{own}>\n    <link1{first}/>\n    <link2{second}/>\n{axis}  </loop_joint>\n"
        );
        self.write_driven(j, &id);
        Ok(())
    }

    /// Returns the element of a joint that follows another.
    fn write_mimic(&self, j: JointId) -> String {
        self.follows[j].map_or(String::new(), |f| {
            let leader = escape_xml(&self.ids[f.leader]);
            let ratio = clean_number(f.ratio);
            format!("    <mimic joint=\"{leader}\" multiplier=\"{ratio}\" offset=\"0\"/>\n")
        })
    }

    fn write_file(self, unsaid: Vec<String>) -> FormattedFile {
        let m = self.m;
        let mut told = left_out(m);
        told.extend(unsaid);
        let frame = m.frame_link();
        let weightless = |(l, link): (LinkId, &Link)| l != frame && link.mass.is_none();
        if m.links_with_ids().any(weightless) {
            told.push(GRAM.to_owned());
        }
        if self.body.contains(LIMIT) {
            let what = "sliding joints get placeholder limits of 1 m, because URDF requires limits";
            told.push(what.to_owned());
        }
        let (name, above) = (escape_xml(&m.name), write_head(m, "  ", &told));
        let (head, body) = (self.head, self.body);
        let text = format!(
            "<?xml version=\"1.0\"?>\n<robot name=\"{name}\">\n{above}{head}{body}</robot>\n"
        );
        FormattedFile { text, told }
    }
}

/// Limits of sliding joints, which URDF requires; the mechanism has none.
const LIMIT: &str = "    <limit lower=\"-1\" upper=\"1\" effort=\"0\" velocity=\"0\"/>\n";

type Kind = (&'static str, Option<[f64; 3]>);

/// Returns the joints in series that represent a joint.
fn joint_kinds(m: &Mechanism, j: JointId, sign: f64) -> Result<Vec<Kind>, ExportError> {
    let joint = &m.joints[j];
    let p = joint_axes(m, joint);
    let turned = |d: [f64; 3]| Some(d.map(|x| sign * x));
    match &joint.joint_type {
        JointType::Fixed => return Ok(vec![("fixed", None)]),
        JointType::Planar => return Ok(vec![("planar", turned(p.axes[2]))]),
        t if t.freedoms().is_empty() => return Ok(vec![("fixed", None)]),
        t if t.freedoms().len() == 6 => return Ok(vec![("floating", None)]),
        _ => {}
    }
    let single = |&f: &Freedom| match f {
        Freedom::Screw => Err(ExportError::Joint {
            joint: joint.id.clone(),
            kind: joint.joint_type.name().to_owned(),
            format: "URDF",
            remedy: "write SDF instead",
        }),
        f if f.is_slide() => Ok(("prismatic", turned(p.axis(f)))),
        f => Ok(("continuous", turned(p.axis(f)))),
    };
    joint.joint_type.freedoms().iter().map(single).collect()
}

fn tree_joint(id: &str, joint: &Kind, ends: [&str; 2], at: [f64; 3], more: &str) -> String {
    let &(kind, axis) = joint;
    let [parent, child] = ends.map(escape_xml);
    let (own, axis) = (name_and_type(id, kind), write_axis(axis));
    let limit = match kind {
        "prismatic" => LIMIT,
        _ => "",
    };
    format!(
        "  <joint{own}>\n    <parent link=\"{parent}\"/>\n    <child link=\"{child}\"/>\n    <origin xyz=\"{}\"/>\n{axis}{limit}{more}  </joint>\n",
        format_numbers(at)
    )
}

fn name_and_type(id: &str, kind: &str) -> String {
    write_attributes([("name", id), ("type", kind)])
}

fn write_axis(axis: Option<Vector>) -> String {
    axis.map_or(String::new(), |d| {
        format!("    <axis xyz=\"{}\"/>\n", format_numbers(d))
    })
}
