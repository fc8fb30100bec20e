//! `<joint type="gearbox">`: not a separate joint, but a ratio of the rotations of two hinges on one body.

use crate::geom::rigid::RigidMotion;
use crate::geom::vector::{cross, dot, length};
use crate::model::joint_type::JointType;
use crate::robots::description::{Ratio, Robot};
use crate::robots::problem::Read;
use crate::robots::sdf::joints::axis;
use crate::robots::sdf::scene::{SdfScene, absolute, end, located, of_joint};
use crate::robots::xml::element::Element;

/// Couples the hinges of the parent and of the child on the reference body: the child turns the other way, faster by the gear
/// ratio. If there are no such hinges, the gearbox is omitted and reported.
pub(crate) fn gearbox(
    e: Element<'_>,
    scope: &str,
    scene: &SdfScene<'_>,
    robot: &mut Robot,
) -> Read<()> {
    let name = format!("{scope}{}", e.required("name")?);
    let world = of_joint(scene, e, &name).unwrap_or(RigidMotion::IDENTITY);
    let times = match e.child("gearbox_ratio") {
        Some(r) => r.text_numbers::<1>()?[0],
        None => 1.0,
    };
    let (_, on) = end(e, "gearbox_reference_body")?;
    let (on, _) = located(e, &absolute(scope, on), scene)?;
    let mut found = Vec::new();
    for (tag, way) in [("parent", "axis"), ("child", "axis2")] {
        let (c, link) = end(e, tag)?;
        let (link, _) = located(c, &absolute(scope, link), scene)?;
        let way = if e.child(way).is_some() { way } else { "axis" };
        let about = axis(e, way, scope, scene, &world)?;
        found.extend(hinge(robot, [on, link], about));
    }
    let [(leader, first), (follower, second)] = found[..] else {
        let what = "it needs a hinge of its parent and one of its child on its reference body, about its axes; its coupling (1 row) is omitted";
        robot.report.leave_out_coupling(&e.label(), what);
        return Ok(());
    };
    let id = |j: usize| robot.joints[j].id.clone();
    let [leads, follows] = [id(leader), id(follower)];
    robot.joints[follower].comment = Some(format!("geared to {leads}"));
    robot.couplings.push(Ratio {
        gear: true,
        ..Ratio::new([&leads, &follows], -times * first * second, e)
    });
    robot.report.map("gearbox");
    Ok(())
}

/// Returns the hinge of a link on another about a direction, and the sign of its rotation about it.
fn hinge(robot: &Robot, [on, link]: [usize; 2], about: [f64; 3]) -> Option<(usize, f64)> {
    robot.joints.iter().enumerate().find_map(|(j, p)| {
        let sense = match p.links {
            ends if ends == [on, link] => 1.0,
            ends if ends == [link, on] => -1.0,
            _ => return None,
        };
        let own = robot.places[p.links[0]].then(&p.sides[0]).direction(p.axis);
        let along = dot(own, about);
        let parallel = length(cross(own, about)) < 1e-6 * along.abs();
        let fits = p.joint_type == JointType::Revolute && parallel;
        fits.then_some((j, sense * along.signum()))
    })
}
