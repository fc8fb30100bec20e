//! URDF: a spanning tree of the free state; the joints that close loops are `<loop_joint>`s.

use crate::closure::tree::spanning_tree;
use crate::geom::vector::sub;
use crate::model::joint_type::JointType;
use crate::model::mechanism::{JointId, LinkId, Mechanism, StateId};
use crate::robots::formats::Written;
use crate::robots::light::Light;
use crate::robots::mimic::{mimics, settled, stand_in};
use crate::robots::physical::{self, GRAM, inertial, left_out, moving};
use crate::robots::problem::ExportError;
use crate::robots::single_freedoms::{
    Names, Single, comment, escape, number, numbers, place, singles,
};
use std::fmt::Write;

/// The mechanism's free state as URDF. Every link's frame is at the joint that holds it, with the global axes.
///
/// # Errors
/// Where a joint screws: URDF has no such joint.
pub(crate) fn urdf(m: &Mechanism) -> Result<Written, ExportError> {
    let joints: Vec<JointId> = m.joints_in(StateId::FREE).collect();
    let mut names = Names::default();
    let mut links: Vec<Option<(String, [f64; 3])>> = vec![None; m.links.len()];
    let mut head = String::new();
    let mut body = String::new();
    let mut used = vec![false; m.joints.len()];
    let mut ids = vec![String::new(); m.joints.len()];
    let mut single = vec![false; m.joints.len()];
    let frame = m.frame();
    let light = Light::in_mechanism(m).urdf();
    let link = |l: LinkId, at: [f64; 3], head: &mut String, names: &mut Names| {
        let n = names.fit(&m.links[l].id);
        // What stands still needs no mass, and some readers want none of it.
        let weight = match l == frame {
            true => inertial(m, l, at),
            false => Some(moving(m, l, at)),
        };
        let weight = weight.map_or("/>".to_owned(), |i| {
            let [xx, yy, zz, xy, xz, yz] = i.tensor.map(number);
            format!(
                "><inertial><origin xyz=\"{}\"/><mass value=\"{}\"/><inertia ixx=\"{xx}\" ixy=\"{xy}\" ixz=\"{xz}\" iyy=\"{yy}\" iyz=\"{yz}\" izz=\"{zz}\"/></inertial></link>",
                numbers(i.centre),
                i.mass
            )
        });
        let _ = writeln!(head, "  <link name=\"{}\"{weight}", escape(&n));
        n
    };
    links[frame] = Some((link(frame, [0.0; 3], &mut head, &mut names), [0.0; 3]));
    let mut joint_names = Names::default();
    for step in spanning_tree(m, StateId::FREE) {
        let (j, from, to) = (step.joint, step.from, step.link);
        let joint = &m.joints[j];
        used[j] = true;
        let (parent, origin) = links[from].clone().unwrap_or_default();
        let p = place(m, joint);
        let at = sub(p.point, origin);
        let id = joint_names.fit(&joint.id);
        ids[j].clone_from(&id);
        let child = link(to, p.point, &mut head, &mut names);
        // The child moves the other way where the joint is passed backwards.
        let sign = if step.forward { 1.0 } else { -1.0 };
        let parts = kinds(m, j, sign)?;
        single[j] = parts.len() == 1;
        let (mut holder, mut origin) = (parent, at);
        for (i, (kind, axis)) in parts.iter().enumerate() {
            let last = i + 1 == parts.len();
            let held = if last {
                child.clone()
            } else {
                let between = names.fit(&format!("{id}~{}~link", i + 1));
                let _ = writeln!(head, "  <link name=\"{}\">{light}</link>", escape(&between));
                between
            };
            let part = if i == 0 {
                id.clone()
            } else {
                joint_names.fit(&format!("{id}~{}", i + 1))
            };
            let ends = [holder.as_str(), held.as_str()];
            body.push_str(&tree_joint(&part, kind, ends, origin, *axis, &stand_in(j)));
            (holder, origin) = (held, [0.0; 3]);
        }
        if joint.drive {
            let _ = writeln!(body, "  <!-- {} is driven -->", comment(&id));
        }
        links[to] = Some((child, p.point));
    }
    for &j in joints.iter().filter(|&&j| !used[j]) {
        let (joint, p) = (&m.joints[j], place(m, &m.joints[j]));
        let id = joint_names.fit(&joint.id);
        let [(mut a, mut from), (b, to)] =
            joint.links.map(|l| links[l].clone().unwrap_or_default());
        // All but the last of its freedoms are joints of the tree; a ball, and what is rigid, close the loop alone.
        let mut parts = match joint.joint_type {
            JointType::Spherical => vec![("spherical", None)],
            _ => kinds(m, j, 1.0)?,
        };
        let closes = parts.pop().unwrap_or(("fixed", None));
        if ["planar", "floating"].contains(&closes.0) {
            let (joint, kind) = (joint.id.clone(), closes.0.to_owned());
            let remedy = "write MJCF instead";
            let format = "URDF's <loop_joint>";
            return Err(ExportError::Joint {
                joint,
                kind,
                format,
                remedy,
            });
        }
        for (i, (kind, axis)) in parts.iter().enumerate() {
            let between = names.fit(&format!("{id}~{}~link", i + 1));
            let _ = writeln!(head, "  <link name=\"{}\">{light}</link>", escape(&between));
            let part = joint_names.fit(&format!("{id}~{}", i + 1));
            let ends = [a.as_str(), between.as_str()];
            let text = tree_joint(&part, kind, ends, sub(p.point, from), *axis, "");
            body.push_str(&text);
            (a, from) = (between, p.point);
        }
        let axis = closes.1.map_or(String::new(), |d| {
            format!("    <axis xyz=\"{}\"/>\n", numbers(d))
        });
        let _ = write!(
            body,
            "  <loop_joint name=\"{}\" type=\"{}\">\n    <link1 link=\"{}\" xyz=\"{}\" rpy=\"0 0 0\"/>\n    <link2 link=\"{}\" xyz=\"{}\" rpy=\"0 0 0\"/>\n{axis}  </loop_joint>\n",
            escape(&id),
            closes.0,
            escape(&a),
            numbers(sub(p.point, from)),
            escape(&b),
            numbers(sub(p.point, to)),
        );
        if joint.drive {
            let _ = writeln!(body, "  <!-- {} is driven -->", comment(&id));
        }
    }
    let (follows, unsaid) = mimics(m, &single);
    let mut told = left_out(m);
    told.extend(unsaid);
    if m.links_with_ids()
        .any(|(l, k)| l != frame && k.mass.is_none())
    {
        told.push(GRAM.to_owned());
    }
    if body.contains(LIMIT) {
        told.push("what slides has limits of 1 m that are made up: URDF wants some".to_owned());
    }
    // Only now is it known which joints are of the tree, and what they are called.
    let body = settled(&body, |j| {
        follows[j].map_or(String::new(), |f| {
            let leader = escape(&ids[f.leader]);
            let ratio = number(f.ratio);
            format!("    <mimic joint=\"{leader}\" multiplier=\"{ratio}\" offset=\"0\"/>\n")
        })
    });
    let (name, above) = (escape(&m.name), physical::head(m, "  ", &told));
    let text =
        format!("<?xml version=\"1.0\"?>\n<robot name=\"{name}\">\n{above}{head}{body}</robot>\n");
    Ok(Written { text, told })
}

/// URDF wants limits of what slides; the mechanism has none.
const LIMIT: &str = "    <limit lower=\"-1\" upper=\"1\" effort=\"0\" velocity=\"0\"/>\n";

type Kind = (&'static str, Option<[f64; 3]>);

/// The joints in series that a joint becomes.
fn kinds(m: &Mechanism, j: JointId, sign: f64) -> Result<Vec<Kind>, ExportError> {
    let joint = &m.joints[j];
    let p = place(m, joint);
    let turned = |d: [f64; 3]| Some(d.map(|x| sign * x));
    match &joint.joint_type {
        JointType::Fixed => return Ok(vec![("fixed", None)]),
        JointType::Planar => return Ok(vec![("planar", turned(p.axes[2]))]),
        t if t.freedoms().is_empty() => return Ok(vec![("fixed", None)]),
        t if t.freedoms().len() == 6 => return Ok(vec![("floating", None)]),
        _ => {}
    }
    let single = |s: Single| match s {
        Single::Turn(d) => Ok(("continuous", turned(d))),
        Single::Shift(d) => Ok(("prismatic", turned(d))),
        Single::Screw(..) => Err(ExportError::Joint {
            joint: joint.id.clone(),
            kind: joint.joint_type.name().to_owned(),
            format: "URDF",
            remedy: "write SDF instead",
        }),
    };
    singles(&joint.joint_type, &p)
        .into_iter()
        .map(single)
        .collect()
}

fn tree_joint(
    id: &str,
    kind: &str,
    ends: [&str; 2],
    at: [f64; 3],
    axis: Option<[f64; 3]>,
    more: &str,
) -> String {
    let [parent, child] = ends.map(escape);
    let axis = axis.map_or(String::new(), |d| {
        format!("    <axis xyz=\"{}\"/>\n", numbers(d))
    });
    let limit = match kind {
        "prismatic" => LIMIT,
        _ => "",
    };
    format!(
        "  <joint name=\"{}\" type=\"{kind}\">\n    <parent link=\"{parent}\"/>\n    <child link=\"{child}\"/>\n    <origin xyz=\"{}\"/>\n{axis}{limit}{more}  </joint>\n",
        escape(id),
        numbers(at),
    )
}
