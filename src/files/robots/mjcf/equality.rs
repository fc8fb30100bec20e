//! Equality constraints: the loops and couplings of MJCF.

use crate::robots::description::kinematics::joint_motion;
use crate::robots::mjcf::context::Context;
use crate::robots::prelude::*;

pub(crate) fn read_equalities(
    section: Element<'_>,
    root: Element<'_>,
    context: &Context<'_>,
    robot: &mut Robot,
) -> Read<()> {
    for (i, e) in section.children().enumerate() {
        e.check_room("joints", robot.joints.len())?;
        let look = context.defaults.lookup(e, "equality", None)?;
        let id = match e.attribute("name") {
            Some(n) => n.to_owned(),
            None => format!("{}-{}", e.name(), i + 1),
        };
        if look.find_element("active").attribute("active") == Some("false") {
            robot.report.drop_element("inactive equality", &id);
            continue;
        }
        match e.name() {
            "connect" => {
                let ends = read_ends(e, context, robot)?;
                robot.close_loop(e, &id, ends, JointType::Spherical)?;
            }
            "weld" => {
                let ends = read_ends(e, context, robot)?;
                let (mut ends, mut kind) = (ends, JointType::Fixed);
                if look
                    .find_element("torquescale")
                    .read_numbers("torquescale")?
                    == Some([0.0])
                {
                    kind = JointType::Spherical;
                    if e.attribute("site1").is_none() {
                        // Without torque it is a ball at its anchor, which is given in the second body.
                        let at = look
                            .find_element("anchor")
                            .read_vector("anchor", [0.0; 3])?;
                        let at = RigidMotion::from_translation(at);
                        let [(one, first), (two, second)] = ends;
                        ends = [(one, first.then(&second.inverse()).then(&at)), (two, at)];
                    }
                }
                robot.close_loop(e, &id, ends, kind)?;
            }
            "joint" => read_coupling(e, robot)?,
            "tendon" => read_tendons(e, root, robot)?,
            "flex" | "flexvert" | "flexstrain" => {
                let what = "it holds a deformable body, which is omitted";
                robot.report.add_approximation(&e.label(), what);
            }
            "distance" => return Err(e.unsupported_error("it is not a joint", "remove it")),
            _ => {
                let what = "an equality of an unknown kind; omitted";
                robot.report.leave_out(&e.label(), 6, what);
            }
        }
    }
    Ok(())
}

fn read_ends(e: Element<'_>, context: &Context<'_>, robot: &Robot) -> Read<[End; 2]> {
    if e.attribute("site1").is_some() || e.attribute("site2").is_some() {
        let site = |key: &'static str| {
            let name = e.required_attribute(key)?;
            context.sites.get(name).copied().ok_or_else(|| {
                e.unknown_name(Some(key), ["site", "sites"], name, context.sites.keys())
            })
        };
        return Ok([site("site1")?, site("site2")?]);
    }
    let body = |key: &'static str| {
        let name = if key == "body2" {
            e.attribute(key).unwrap_or("world")
        } else {
            e.required_attribute(key)?
        };
        robot
            .links
            .iter()
            .position(|l| l == name)
            .ok_or_else(|| e.unknown_name(Some(key), ["body", "bodies"], name, &robot.links))
    };
    let (one, two) = (body("body1")?, body("body2")?);
    let as_drawn = |at: RigidMotion| {
        let there = robot.places[one].then(&at);
        robot.places[two].inverse().then(&there)
    };
    if e.name() == "connect" {
        e.required_attribute("anchor")?;
        let at = RigidMotion::from_translation(e.read_vector("anchor", [0.0; 3])?);
        return Ok([(one, at), (two, as_drawn(at))]);
    }
    // The place of body 2 in body 1; a zero quaternion means the place in the model as drawn.
    let here = RigidMotion::IDENTITY;
    Ok(match e.read_numbers::<7>("relpose")? {
        Some([x, y, z, quat @ ..]) if quat != [0.0; 4] => {
            let place = RigidMotion::from_quaternion([x, y, z], quat);
            [(one, place), (two, here)]
        }
        _ => [(one, here), (two, as_drawn(here))],
    })
}

fn read_coupling(e: Element<'_>, robot: &mut Robot) -> Read<()> {
    let mut names = vec![e.required_attribute("joint1")?];
    names.extend(e.attribute("joint2"));
    for (name, key) in names.iter().zip(["joint1", "joint2"]) {
        let found = robot.joint_named(&e.label(), name);
        found.map_err(|p| e.error_at(Some(key), p))?;
    }
    let [a, b] = names[..] else {
        let [value, ..] = read_polynomial(e)?;
        hold_joint(e, names[0], value, robot);
        return Ok(());
    };
    // Value of joint 1 less its reference, as a polynomial of that of joint 2 less its own.
    let [_, ratio, higher @ ..] = read_polynomial(e)?;
    robot.couplings.push(Ratio {
        higher,
        ..Ratio::new([b, a], ratio, e)
    });
    Ok(())
}

/// Makes a joint rigid that an equality holds at a constant.
fn hold_joint(e: Element<'_>, joint: &str, value: f64, robot: &mut Robot) {
    let one = |j: &&mut Part| j.id == joint && j.values.len() == 1;
    let Some(j) = robot.joints.iter_mut().find(one) else {
        let what = format!("{joint} can move; its equality is omitted");
        return robot.report.leave_out(&e.label(), 1, what);
    };
    j.values = vec![value];
    j.sides[0] = j.sides[0].then(&joint_motion(j));
    (j.joint_type, j.values, j.limits) = (JointType::Fixed, Vec::new(), None);
}

/// Reads an equality of the lengths of tendons. The length of a `<fixed>` tendon is a sum of joint values, each times a
/// coefficient, so the equality is a linear row between these joints.
fn read_tendons(e: Element<'_>, root: Element<'_>, robot: &mut Robot) -> Read<()> {
    let first = tendon_length(e, "tendon1", root)?;
    let second = match e.attribute("tendon2") {
        Some(_) => tendon_length(e, "tendon2", root)?,
        None => Some(BTreeMap::new()),
    };
    let (Some(mut row), Some(second)) = (first, second) else {
        let what = "an equality of a tendon that is not a sum of joint values (1 row) is omitted";
        robot.report.leave_out(&e.label(), 1, what);
        return Ok(());
    };
    // Length of tendon 1 less its reference, as a polynomial of that of tendon 2 less its own.
    let [value, ratio, higher @ ..] = read_polynomial(e)?;
    for (joint, coefficient) in second {
        *row.entry(joint).or_insert(0.0) -= ratio * coefficient;
    }
    row.retain(|_, c| *c != 0.0);
    let all: Vec<(&str, f64)> = row.into_iter().collect();
    match all[..] {
        [(joint, c)] => hold_joint(e, joint, value / c, robot),
        [(a, c), (b, d)] if higher == [0.0; 3] => {
            robot.couplings.push(Ratio::new([a, b], -c / d, e));
        }
        _ => {
            let what = "an equality of tendons that couples more than two joints, or is a polynomial (1 row), is omitted";
            robot.report.leave_out(&e.label(), 1, what);
        }
    }
    Ok(())
}

/// The coefficients of joints.
type Row<'a> = BTreeMap<&'a str, f64>;

/// Returns the coefficients of the joints whose sum is the length of a tendon. `None` if it is not a `<fixed>` tendon.
fn tendon_length<'a>(e: Element<'a>, key: &str, root: Element<'a>) -> Read<Option<Row<'a>>> {
    let name = e.required_attribute(key)?;
    let all = root
        .children_named("tendon")
        .flat_map(|s| s.children().collect::<Vec<_>>());
    let all: Vec<Element<'a>> = all.collect();
    let Some(tendon) = all.iter().find(|t| t.attribute("name") == Some(name)) else {
        let known = all.iter().filter_map(|t| t.attribute("name"));
        return Err(e.unknown_name(Some(key), ["tendon", "tendons"], name, known));
    };
    if tendon.name() != "fixed" {
        return Ok(None);
    }
    let mut out = BTreeMap::new();
    for j in tendon.children_named("joint") {
        let [c] = j.read_numbers::<1>("coef")?.unwrap_or([1.0]);
        *out.entry(j.required_attribute("joint")?).or_insert(0.0) += c;
    }
    Ok(Some(out))
}

/// Returns the five coefficients of `polycoef`, lowest first; omitted ones have MuJoCo's defaults, 0 1 0 0 0.
fn read_polynomial(e: Element<'_>) -> Read<[f64; 5]> {
    let mut out = [0.0, 1.0, 0.0, 0.0, 0.0];
    let Some(text) = e.attribute("polycoef") else {
        return Ok(out);
    };
    let number = |w: &str| w.parse::<f64>().ok().filter(|x| x.abs() <= 1e9);
    let read: Option<Vec<f64>> = text.split_whitespace().map(number).collect();
    let Some(read) = read.filter(|r| r.len() <= out.len()) else {
        let want = "give at most 5 finite numbers";
        let problem = bad_value(&e.label(), "polycoef", text, want);
        return Err(e.error_at(Some("polycoef"), problem));
    };
    out[..read.len()].copy_from_slice(&read);
    Ok(out)
}
