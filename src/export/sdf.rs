//! SDF: every joint of the free state as it stands, loops closed by joints.

use super::parts::{Names, Place, Single, comment, escape, numbers, place, singles};
use crate::model::joint_type::JointType;
use crate::model::mechanism::{Mechanism, Mode, Role};
use std::fmt::Write;

/// The mechanism's free state as SDF 1.9. All links have the global axes; joints of several freedoms that SDF does not
/// know become joints in series through links without mass.
#[must_use]
pub fn sdf(m: &Mechanism) -> String {
    let mut out = String::from("<?xml version=\"1.0\"?>\n<sdf version=\"1.9\">\n");
    let _ = writeln!(
        out,
        "  <model name=\"{}\">",
        escape(&m.name.replace("::", ":"))
    );
    if let Mode::Planar { .. } = m.mode {
        let _ = writeln!(
            out,
            "    <!-- a planar model: its figures count 3 constraints per contour, those of this file 6 -->"
        );
    }
    let joints: Vec<usize> = m.joints_in(0).collect();
    let mut names = Names::default();
    let world = names.fit("world");
    let mut links: Vec<Option<String>> = vec![None; m.links.len()];
    for (l, link) in m.links.iter().enumerate() {
        if joints.iter().any(|&j| m.joints[j].links.contains(&l)) {
            links[l] = Some(if link.role == Role::Frame && link.id == world {
                world.clone()
            } else {
                names.fit(&link.id)
            });
        }
    }
    let name = |l: usize| links[l].as_deref().unwrap_or("world");
    let mut body = String::new();
    for (l, link) in m.links.iter().enumerate() {
        let Some(n) = links[l].as_deref().filter(|n| *n != world) else {
            continue;
        };
        let _ = writeln!(out, "    <link name=\"{}\"/>", escape(n));
        if link.role == Role::Frame {
            let ends = [world.as_str(), n];
            write_joint(
                &mut body,
                &names.fit(&format!("world-{n}")),
                "fixed",
                ends,
                [0.0; 3],
                "",
            );
        }
    }
    for &j in &joints {
        let joint = &m.joints[j];
        let p = place(m, joint);
        let id = names.fit(&joint.id);
        if joint.drive {
            let _ = writeln!(body, "    <!-- {} is driven -->", comment(&id));
        }
        let ends = joint.links.map(name);
        if let Some((kind, more)) = known(&joint.joint_type, &p) {
            write_joint(&mut body, &id, kind, ends, p.point, &more);
            continue;
        }
        let all = singles(&joint.joint_type, &p);
        let mut from = ends[0].to_owned();
        for (i, single) in all.iter().enumerate() {
            let last = i + 1 == all.len();
            let to = if last {
                ends[1].to_owned()
            } else {
                names.fit(&format!("{id}~{}", i + 1))
            };
            if !last {
                let _ = writeln!(out, "    <link name=\"{}\"/>", escape(&to));
            }
            let part = if i == 0 {
                id.clone()
            } else {
                names.fit(&format!("{id}~joint{}", i + 1))
            };
            let (kind, more) = elementary(*single);
            write_joint(&mut body, &part, kind, [&from, &to], p.point, &more);
            from = to;
        }
        if all.is_empty() {
            write_joint(&mut body, &id, "fixed", ends, p.point, "");
        }
    }
    out.push_str(&body);
    out.push_str("  </model>\n</sdf>\n");
    out
}

fn axis(tag: &str, d: [f64; 3]) -> String {
    format!(
        "      <{tag}><xyz expressed_in=\"__model__\">{}</xyz></{tag}>\n",
        numbers(d)
    )
}

/// The SDF joint of a type, where there is one, and what goes into it.
fn known(t: &JointType, p: &Place) -> Option<(&'static str, String)> {
    let [x, _, z] = p.axes;
    Some(match t {
        JointType::Revolute | JointType::Prismatic | JointType::Helical => {
            let [single] = singles(t, p)[..] else {
                return None;
            };
            elementary(single)
        }
        JointType::Universal => ("universal", axis("axis", z) + &axis("axis2", x)),
        JointType::Spherical => ("ball", String::new()),
        JointType::Fixed => ("fixed", String::new()),
        _ => return None,
    })
}

fn elementary(s: Single) -> (&'static str, String) {
    match s {
        Single::Turn(d) => ("revolute", axis("axis", d)),
        Single::Shift(d) => ("prismatic", axis("axis", d)),
        Single::Screw(d, pitch) => {
            let turn = pitch * std::f64::consts::TAU;
            let thread = format!("      <screw_thread_pitch>{turn}</screw_thread_pitch>\n");
            ("screw", axis("axis", d) + &thread)
        }
    }
}

fn write_joint(out: &mut String, id: &str, kind: &str, ends: [&str; 2], at: [f64; 3], more: &str) {
    let [parent, child] = ends.map(escape);
    let _ = write!(
        out,
        "    <joint name=\"{}\" type=\"{kind}\">\n      <pose relative_to=\"__model__\">{} 0 0 0</pose>\n      <parent>{parent}</parent>\n      <child>{child}</child>\n{more}    </joint>\n",
        escape(id),
        numbers(at),
    );
}
