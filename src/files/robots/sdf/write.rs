//! SDF: every joint of the free state as drawn, loops closed by joints.

use crate::robots::description::coupling::{Follows, find_mimics};
use crate::robots::description::physical::{LIGHT_SDF, left_out, moving_inertial, write_head};
use crate::robots::formats::FormattedFile;
use crate::robots::mechanism::series_of_single_joints::{
    JointAxes, Names, clean_number, escape_comment, escape_xml, format_numbers, joint_axes,
};
use crate::robots::prelude::*;

/// The content of a file.
struct SdfWriter<'a> {
    m: &'a Mechanism,
    names: Names,
    /// Names of the links that joints connect, and of the joints.
    links: Vec<Option<String>>,
    ids: Vec<String>,
    follows: Vec<Option<Follows>>,
    head: String,
    body: String,
}

const WORLD: &str = "world";

/// Writes the mechanism's free state as SDF 1.9. All links have the global axes; joints of several freedoms that SDF does not
/// have become joints in series through light links.
pub(crate) fn write_sdf(m: &Mechanism) -> FormattedFile {
    let joints: Vec<JointId> = m.joints_in(StateId::FREE).collect();
    let written: Vec<bool> = m.joint_ids().map(|j| joints.contains(&j)).collect();
    let (follows, unsaid) = find_mimics(m, &written);
    let mut told = left_out(m);
    told.extend(unsaid);
    if m.links.iter().any(|l| l.mass.is_none()) {
        told.push("links without a mass weigh 1 kg, the default of SDF".to_owned());
    }
    let mut w = SdfWriter {
        m,
        names: Names::default(),
        links: vec![None; m.links.len()],
        ids: vec![String::new(); m.joints.len()],
        follows,
        head: String::new(),
        body: String::new(),
    };
    w.name_links(&joints);
    for l in m.link_ids() {
        w.write_link(l);
    }
    // Joints may follow later ones, so names come first.
    for &j in &joints {
        w.ids[j] = w.names.fit_name(&m.joints[j].id);
    }
    for &j in &joints {
        w.write_mechanism_joint(j);
    }
    // Mimic joints are of 1.11.
    let version = match m.couplings_in(StateId::FREE).next() {
        Some(_) => "1.11",
        None => "1.9",
    };
    let name = escape_xml(&m.name.replace("::", ":"));
    let above = write_head(m, "    ", &told);
    let (links, body) = (w.head, w.body);
    let text = format!(
        "<?xml version=\"1.0\"?>\n<sdf version=\"{version}\">\n  <model name=\"{name}\">\n{above}{links}{body}  </model>\n</sdf>\n"
    );
    FormattedFile { text, told }
}

impl SdfWriter<'_> {
    fn name_links(&mut self, joints: &[JointId]) {
        let m = self.m;
        self.names.fit_name(WORLD);
        for (l, link) in m.links_with_ids() {
            if joints.iter().any(|&j| m.joints[j].links.contains(&l)) {
                let is_world = link.role == Role::Frame && link.id == WORLD;
                self.links[l] = Some(if is_world {
                    WORLD.to_owned()
                } else {
                    self.names.fit_name(&link.id)
                });
            }
        }
    }

    fn write_link(&mut self, l: LinkId) {
        let link = &self.m.links[l];
        let Some(n) = self.links[l].clone().filter(|n| n != WORLD) else {
            return;
        };
        let stated = link.mass.as_ref();
        let stated = stated.map(|_| moving_inertial(self.m, l, [0.0; 3]));
        let weight = stated.map_or("/>".to_owned(), |i| {
            let [xx, yy, zz, xy, xz, yz] = i.tensor.map(clean_number);
            format!(
                "><inertial><pose>{} 0 0 0</pose><mass>{}</mass><inertia><ixx>{xx}</ixx><iyy>{yy}</iyy><izz>{zz}</izz><ixy>{xy}</ixy><ixz>{xz}</ixz><iyz>{yz}</iyz></inertia></inertial></link>",
                format_numbers(i.centre), i.mass
            )
        });
        let _ = writeln!(self.head, "    <link name=\"{}\"{weight}", escape_xml(&n));
        if link.role == Role::Frame {
            let held = self.names.fit_name(&format!("world-{n}"));
            let ends = [WORLD, n.as_str()];
            write_joint(&mut self.body, &held, "fixed", ends, [0.0; 3], "");
        }
    }

    fn write_mechanism_joint(&mut self, j: JointId) {
        let joint = &self.m.joints[j];
        let mut p = joint_axes(self.m, joint);
        let id = self.ids[j].clone();
        if joint.drive {
            let _ = writeln!(self.body, "    <!-- {} is driven -->", escape_comment(&id));
        }
        let name = |l: LinkId| self.links[l].clone().unwrap_or_else(|| WORLD.to_owned());
        let [mut a, mut b] = joint.links.map(name);
        // The world is not a child of any joint. Passed from the other end, a joint moves in the opposite direction, last axis first.
        let back = b == WORLD;
        if back {
            (a, b) = (b, a);
            p.axes = p.axes.map(|a| a.map(|x| -x));
        }
        if let Some((kind, more)) = sdf_joint(&joint.joint_type, &p, back) {
            let more = self.with_mimic(j, more);
            write_joint(&mut self.body, &id, kind, [&a, &b], p.point, &more);
            return;
        }
        let mut all = joint.joint_type.freedoms().to_vec();
        if back {
            all.reverse();
        }
        self.write_series(j, &all, [a, b], &p);
    }

    /// Writes freedoms in series, through light links; a fixed joint if there are none.
    fn write_series(&mut self, j: JointId, all: &[Freedom], ends: [String; 2], p: &JointAxes) {
        let [mut from, end] = ends;
        let id = self.ids[j].clone();
        if all.is_empty() {
            write_joint(&mut self.body, &id, "fixed", [&from, &end], p.point, "");
        }
        for (i, &freedom) in all.iter().enumerate() {
            let to = if i + 1 == all.len() {
                end.clone()
            } else {
                let to = self.names.fit_name(&format!("{id}~{}", i + 1));
                let link = escape_xml(&to);
                let _ = writeln!(self.head, "    <link name=\"{link}\">{LIGHT_SDF}</link>");
                to
            };
            let part = match i {
                0 => id.clone(),
                _ => self.names.fit_name(&format!("{id}~joint{}", i + 1)),
            };
            let (kind, more) = single_joint(freedom, p);
            let more = self.with_mimic(j, more);
            write_joint(&mut self.body, &part, kind, [&from, &to], p.point, &more);
            from = to;
        }
    }

    /// Writes an axis with the joint it follows, if any.
    fn with_mimic(&self, j: JointId, axis: String) -> String {
        let Some(f) = self.follows[j] else {
            return axis;
        };
        let mimic = format!(
            "<mimic joint=\"{}\" axis=\"axis\"><multiplier>{}</multiplier><offset>0</offset><reference>0</reference></mimic></axis>",
            escape_xml(&self.ids[f.leader]),
            clean_number(f.ratio)
        );
        axis.replacen("</axis>", &mimic, 1)
    }
}

fn write_axis(tag: &str, d: [f64; 3]) -> String {
    format!(
        "      <{tag}><xyz expressed_in=\"__model__\">{}</xyz></{tag}>\n",
        format_numbers(d)
    )
}

/// Returns the SDF joint of a type and its content, or `None` if SDF has no such joint. `back` is true if it is passed from its second
/// link.
fn sdf_joint(t: &JointType, p: &JointAxes, back: bool) -> Option<(&'static str, String)> {
    let [x, _, z] = p.axes;
    let (first, second) = if back { (x, z) } else { (z, x) };
    Some(match t {
        JointType::Revolute | JointType::Prismatic | JointType::Helical => {
            single_joint(*t.freedoms().first()?, p)
        }
        JointType::Universal => {
            let axes = write_axis("axis", first) + &write_axis("axis2", second);
            ("universal", axes)
        }
        JointType::Spherical => ("ball", String::new()),
        JointType::Fixed => ("fixed", String::new()),
        _ => return None,
    })
}

/// Returns the SDF joint of one freedom, and its content.
fn single_joint(freedom: Freedom, p: &JointAxes) -> (&'static str, String) {
    let axis = write_axis("axis", p.axis(freedom));
    match freedom {
        Freedom::Screw => {
            let turn = p.pitch * std::f64::consts::TAU;
            let thread = format!("      <screw_thread_pitch>{turn}</screw_thread_pitch>\n");
            ("screw", axis + &thread)
        }
        f if f.is_slide() => ("prismatic", axis),
        _ => ("revolute", axis),
    }
}

fn write_joint(out: &mut String, id: &str, kind: &str, ends: [&str; 2], at: [f64; 3], more: &str) {
    let [parent, child] = ends.map(escape_xml);
    let _ = write!(
        out,
        "    <joint name=\"{}\" type=\"{kind}\">\n      <pose relative_to=\"__model__\">{} 0 0 0</pose>\n      <parent>{parent}</parent>\n      <child>{child}</child>\n{more}    </joint>\n",
        escape_xml(id),
        format_numbers(at)
    );
}
