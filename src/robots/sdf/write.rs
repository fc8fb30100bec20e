//! SDF: every joint of the free state as it stands, loops closed by joints.

use crate::model::joint_type::JointType;
use crate::model::mechanism::{JointId, LinkId, Mechanism, Role, StateId};
use crate::robots::formats::Written;
use crate::robots::light::Light;
use crate::robots::mimic::{Follows, mimics, settled, stand_in};
use crate::robots::physical::{head, left_out, moving};
use crate::robots::single_freedoms::{
    Names, Place, Single, comment, escape, number, numbers, place, singles,
};
use std::fmt::Write;

/// The mechanism's free state as SDF 1.9. All links have the global axes; joints of several freedoms that SDF does not
/// know become joints in series through light links.
pub(crate) fn sdf(m: &Mechanism) -> Written {
    // Mimic joints are of 1.11.
    let version = if m.couplings_in(StateId::FREE).next().is_some() {
        "1.11"
    } else {
        "1.9"
    };
    let mut out = format!("<?xml version=\"1.0\"?>\n<sdf version=\"{version}\">\n");
    let _ = writeln!(
        out,
        "  <model name=\"{}\">",
        escape(&m.name.replace("::", ":"))
    );
    let joints: Vec<JointId> = m.joints_in(StateId::FREE).collect();
    let written: Vec<bool> = m.joint_ids().map(|j| joints.contains(&j)).collect();
    let (follows, unsaid) = mimics(m, &written);
    let light = Light::in_mechanism(m).sdf();
    let mut told = left_out(m);
    told.extend(unsaid);
    if m.links.iter().any(|l| l.mass.is_none()) {
        told.push("links without a mass weigh 1 kg, as SDF has it".to_owned());
    }
    out += &head(m, "    ", &told);
    let mut ids = vec![String::new(); m.joints.len()];
    let mut names = Names::default();
    let world = names.fit("world");
    let mut links: Vec<Option<String>> = vec![None; m.links.len()];
    for (l, link) in m.links_with_ids() {
        if joints.iter().any(|&j| m.joints[j].links.contains(&l)) {
            links[l] = Some(if link.role == Role::Frame && link.id == world {
                world.clone()
            } else {
                names.fit(&link.id)
            });
        }
    }
    let name = |l: LinkId| links[l].as_deref().unwrap_or("world");
    let mut body = String::new();
    for (l, link) in m.links_with_ids() {
        let Some(n) = links[l].as_deref().filter(|n| *n != world) else {
            continue;
        };
        let stated = link.mass.as_ref().map(|_| moving(m, l, [0.0; 3]));
        let weight = stated.map_or("/>".to_owned(), |i| {
            let [xx, yy, zz, xy, xz, yz] = i.tensor.map(number);
            format!(
                "><inertial><pose>{} 0 0 0</pose><mass>{}</mass><inertia><ixx>{xx}</ixx><iyy>{yy}</iyy><izz>{zz}</izz><ixy>{xy}</ixy><ixz>{xz}</ixz><iyz>{yz}</iyz></inertia></inertial></link>",
                numbers(i.centre),
                i.mass
            )
        });
        let _ = writeln!(out, "    <link name=\"{}\"{weight}", escape(n));
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
        let mut p = place(m, joint);
        let id = names.fit(&joint.id);
        ids[j].clone_from(&id);
        if joint.drive {
            let _ = writeln!(body, "    <!-- {} is driven -->", comment(&id));
        }
        let mut ends = joint.links.map(name);
        // The world is nobody's child: passed from the other end, a joint moves the other way about what comes last.
        let back = ends[1] == world;
        if back {
            ends.reverse();
            p.axes = p.axes.map(|a| a.map(|x| -x));
        }
        if let Some((kind, more)) = known(&joint.joint_type, &p, back) {
            let more = match follows[j] {
                Some(f) => more.replacen("</axis>", &format!("{}</axis>", follow(f)), 1),
                None => more,
            };
            write_joint(&mut body, &id, kind, ends, p.point, &more);
            continue;
        }
        let mut all = singles(&joint.joint_type, &p);
        if back {
            all.reverse();
        }
        let mut from = ends[0].to_owned();
        for (i, single) in all.iter().enumerate() {
            let last = i + 1 == all.len();
            let to = if last {
                ends[1].to_owned()
            } else {
                names.fit(&format!("{id}~{}", i + 1))
            };
            if !last {
                let _ = writeln!(out, "    <link name=\"{}\">{light}</link>", escape(&to));
            }
            let part = if i == 0 {
                id.clone()
            } else {
                names.fit(&format!("{id}~joint{}", i + 1))
            };
            let (kind, mut more) = elementary(*single);
            if let Some(f) = follows[j] {
                more = more.replacen("</axis>", &format!("{}</axis>", follow(f)), 1);
            }
            write_joint(&mut body, &part, kind, [&from, &to], p.point, &more);
            from = to;
        }
        if all.is_empty() {
            write_joint(&mut body, &id, "fixed", ends, p.point, "");
        }
    }
    // Joints may follow later ones, whose names were not settled yet.
    out.push_str(&settled(&body, |j| escape(&ids[j])));
    out.push_str("  </model>\n</sdf>\n");
    Written { text: out, told }
}

fn follow(f: Follows) -> String {
    format!(
        "<mimic joint=\"{}\" axis=\"axis\"><multiplier>{}</multiplier><offset>0</offset><reference>0</reference></mimic>",
        stand_in(f.leader),
        number(f.ratio)
    )
}

fn axis(tag: &str, d: [f64; 3]) -> String {
    format!(
        "      <{tag}><xyz expressed_in=\"__model__\">{}</xyz></{tag}>\n",
        numbers(d)
    )
}

/// The SDF joint of a type, where there is one, and what goes into it; `back` where it is passed from its second link.
fn known(t: &JointType, p: &Place, back: bool) -> Option<(&'static str, String)> {
    let [x, _, z] = p.axes;
    let (first, second) = if back { (x, z) } else { (z, x) };
    Some(match t {
        JointType::Revolute | JointType::Prismatic | JointType::Helical => {
            let [single] = singles(t, p)[..] else {
                return None;
            };
            elementary(single)
        }
        JointType::Universal => ("universal", axis("axis", first) + &axis("axis2", second)),
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
