//! Accuracy of the places of a robot, by the digits of the numbers from which they are calculated.

use crate::file::schema::{Coordinate, ToleranceEntry};
use crate::geom::expr::Expr;
use crate::model::rounded::{Largest, Sources};
use crate::robots::xml::element::Element;

/// Elements that place no joint, with all that is in them.
const OTHERS: &str = "visual collision inertial inertia geom asset camera light sensor plugin \
    gazebo transmission actuator contact keyframe limit limits dynamics material mimic";
/// Minimum uncertainty of values calculated in doubles, as a fraction of the size of the robot.
const LEAST: f64 = 1e-12;
/// Maximum uncertainty of a place, as a fraction of the size of the mechanism, and of a direction, in radians.
const MOST: f64 = 0.09;

/// Returns the tolerance of a mechanism made from the elements under a root, or `None` if no number there was rounded. The sizes
/// are those of the robot and of the box around its joints, in metres.
///
/// Every place is assumed to be as accurate as the least accurate number. A turn moves points at a distance of the robot's size.
pub(crate) fn find_tolerance(root: Element<'_>, size: f64, across: f64) -> Option<ToleranceEntry> {
    let mut found = Sources::default();
    let degrees = Expr::from_f64(1f64.to_radians()).ok()?;
    let mut unit = (root.name() == "mujoco").then(|| degrees.clone());
    let mut stack = vec![root];
    while let Some(e) = stack.pop() {
        if e.is_one_of(OTHERS) {
            continue;
        }
        if e.name() == "compiler" {
            match e.attribute("angle") {
                Some("radian") => unit = None,
                Some("degree") => unit = Some(degrees.clone()),
                _ => {}
            }
        }
        collect_attributes(e, unit.as_ref(), &mut found);
        collect_texts(e, &degrees, &mut found);
        stack.extend(e.children());
    }
    let Largest {
        length,
        direction,
        turn,
    } = found.largest_half_units()?;
    let share = MOST * across;
    let most = if across > 0.0 { share } else { f64::INFINITY };
    let shift = length.max(turn * size).max(LEAST * size).min(most);
    let turned = direction.max(turn).min(MOST);
    stated_tolerance([shift, if turned > 0.0 { turned.max(LEAST) } else { 0.0 }])
}

/// Returns the tolerance for places known to a length and directions known to an angle in radians. `None` if both are 0.
pub(crate) fn stated_tolerance([shift, turned]: [f64; 2]) -> Option<ToleranceEntry> {
    // Two digits of an uncertainty are enough.
    let entry = |x: f64| Some(Coordinate::Decimal(format!("{x:.1e}").parse().ok()?));
    Some(ToleranceEntry {
        length: entry(shift),
        direction: (turned > 0.0).then(|| entry(turned)).flatten(),
    })
}

fn collect_attributes(e: Element<'_>, unit: Option<&Expr>, out: &mut Sources) {
    let read = |k: &str| e.attribute(k).map(parse_numbers).unwrap_or_default();
    for k in ["pos", "anchor"] {
        out.lengths.extend(read(k));
    }
    match e.name() {
        "axis" => out.directions.push(read("xyz")),
        _ => out.lengths.extend(read("xyz")),
    }
    if e.name().starts_with("drake:ball_constraint_p") {
        out.lengths.extend(read("value"));
    }
    for k in ["axis", "zaxis", "quat", "quat_xyzw"] {
        out.directions.push(read(k));
    }
    let mut pose = read("relpose");
    out.directions.push(pose.split_off(pose.len().min(3)));
    out.lengths.append(&mut pose);
    let mut axes = read("xyaxes");
    let second = axes.split_off(axes.len().min(3));
    out.directions.extend([axes, second]);
    out.angles.extend(read("rpy"));
    let mut turn = read("axisangle");
    let angle = turn.split_off(turn.len().min(3));
    out.directions.push(turn);
    let turned = read("euler").into_iter().chain(angle);
    out.angles.extend(turned.map(|x| in_radians(x, unit)));
}

/// Collects the numbers of SDF between tags.
fn collect_texts(e: Element<'_>, degrees: &Expr, out: &mut Sources) {
    match e.name() {
        "xyz" => out.directions.push(parse_numbers(e.text())),
        "pose" => {
            let mut all = parse_numbers(e.text());
            let turn = all.split_off(all.len().min(3));
            out.lengths.append(&mut all);
            let unit = ["true", "1"].contains(&e.attribute("degrees").unwrap_or(""));
            match e.attribute("rotation_format") {
                Some("quat_xyzw") => out.directions.push(turn),
                _ => {
                    let unit = unit.then_some(degrees);
                    out.angles
                        .extend(turn.into_iter().map(|x| in_radians(x, unit)));
                }
            }
        }
        _ => {}
    }
}

fn in_radians(x: Expr, unit: Option<&Expr>) -> Expr {
    match unit {
        Some(unit) => x.scaled_as_written(&x * unit, unit.to_f64()),
        None => x,
    }
}

fn parse_numbers(text: &str) -> Vec<Expr> {
    let read = text.split_whitespace().map(str::parse);
    read.filter_map(Result::ok).collect()
}
