//! Self-stresses as arrows: what joints bear keeps every link in balance, and that is what is drawn.

use crate::common::*;
use ozols::geom::expr::Expr;
use ozols::motion::drive_range::follow_range;
use ozols::motion::pose::Pose;
use ozols::redundancy::stress::SelfStress;

fn stresses(name: &str) -> (Mechanism, Vec<SelfStress>) {
    let m = built_in(name);
    let found = analyse_states(&m, &[StateId::FREE], Method::Modular).unwrap();
    let stresses = found[0].self_stresses.clone();
    (m, stresses)
}

#[test]
fn what_joints_bear_of_a_self_stress_keeps_each_link_in_balance() {
    let (mut links, mut spatial) = (0, 0);
    for name in builtin::names() {
        let (m, stresses) = stresses(name);
        for stress in &stresses {
            let loads: Vec<_> = stress
                .joints
                .iter()
                .filter_map(|w| Some((w.joint, w.borne?)))
                .collect();
            let whole: f64 = loads.iter().map(|(_, b)| b.energy_share()).sum();
            assert!(
                loads.is_empty() || (whole - 1.0).abs() < 1e-9,
                "{name}: {whole}"
            );
            for l in m.link_ids() {
                let (mut force, mut moment) = ([0.0; 3], [0.0; 3]);
                let mut there = false;
                for &(j, b) in &loads {
                    let joint = &m.joints[j];
                    let sign = match joint.links {
                        [a, _] if a == l => -1.0,
                        [_, a] if a == l => 1.0,
                        _ => continue,
                    };
                    there = true;
                    let (f, own) = (scale(b.force, sign), scale(b.moment, sign * stress.size));
                    force = add(force, f);
                    moment = add(moment, add(own, cross(to_vector(&joint.frame.point), f)));
                }
                links += usize::from(there);
                spatial += usize::from(there && name == "bennett");
                // the zeros of a stress are exact, its numbers are doubles
                let far = m
                    .joints
                    .iter()
                    .map(|j| length(to_vector(&j.frame.point)))
                    .fold(stress.size, f64::max);
                assert!(length(force) < 1e-7, "{name}: {force:?}");
                assert!(length(moment) < 1e-7 * far, "{name}: {moment:?} of {far}");
            }
        }
    }
    assert!(links > 500, "{links}");
    // three self-stresses of four links
    assert_eq!(spatial, 12);
}

/// In every pose of a motion: no hinge bears a moment about its own axis, and forces on each link are in balance.
#[test]
fn a_self_stress_is_in_balance_in_every_pose() {
    for (name, drive) in [("gripper-10", 0), ("bennett", 0), ("sarrus", 0)] {
        let (m, stresses) = stresses(name);
        let found = analyse_states(&m, &[StateId::FREE], Method::Modular).unwrap();
        let contours = found[0].per_contour.iter().map(|c| c.contour.clone());
        let pose = Pose::of_file(&m, StateId::FREE).unwrap();
        let way = follow_range(&pose, drive, &[], None, 12);
        let moved = way.links.iter().map(|links| {
            let mut moved = m.clone();
            for joint in &mut moved.edit().joints {
                let [_, on] = joint.links;
                let axis = links[on].map_direction(to_vector(&joint.frame.axis));
                let point = pose.carry_point(links, on, to_vector(&joint.frame.point));
                joint.frame.axis = axis.map(|x| Expr::from_f64(x).unwrap());
                joint.frame.point = point.map(|x| Expr::from_f64(x).unwrap());
            }
            moved
        });
        let (moved, contours) = (moved.collect_vec(), contours.collect_vec());
        let of = (StateId::FREE, &*contours);
        for stress in &stresses {
            let poses = (&*moved, way.start);
            for (m, loads) in moved
                .iter()
                .zip(stress.loads_along(poses, of, stresses.len()))
            {
                assert_eq!(loads.len(), m.joints.len(), "{name}");
                for (joint, b) in m.joints.iter().zip(&loads) {
                    let turns = joint.joint_type == JointType::Revolute;
                    let axis = to_vector(&joint.frame.axis);
                    let about = dot(b.moment, axis) / length(axis);
                    assert!(
                        !turns || about.abs() < 1e-7,
                        "{name}, {}: {about}",
                        joint.id
                    );
                }
                for l in m.link_ids() {
                    let force = m.joints.iter().zip(&loads).fold([0.0; 3], |sum, (j, b)| {
                        let sign = match j.links {
                            [a, _] if a == l => -1.0,
                            [_, a] if a == l => 1.0,
                            _ => 0.0,
                        };
                        add(sum, scale(b.force, sign))
                    });
                    assert!(length(force) < 1e-7, "{name}: {force:?}");
                }
            }
        }
    }
}

#[test]
fn a_motion_has_the_arrows_of_a_self_stress_in_every_frame() {
    let svg = run_quiet("draw gripper-10 --motion --stroke=-1:1:20 --self-stress 1");
    let doc = roxmltree::Document::parse(&svg).unwrap();
    let frames = doc.descendants().filter(|n| n.has_attribute("data-frame"));
    let arrows = frames.map(|f| {
        let paths = f
            .children()
            .filter(|c| c.attribute("class") == Some("moment"));
        paths.count()
    });
    assert_eq!(arrows.collect_vec(), [6; 21]);
    has(&svg, "self-stress 1: moment about");
}

/// An arrow of a drawing: its link, its tip in words, and from its beginning to its end where it is drawn straight.
struct Drawn {
    link: String,
    says: String,
    along: [f64; 2],
    heads: usize,
}

fn arrows(args: &[&str]) -> Vec<Drawn> {
    let svg = run_quiet(args);
    let doc = roxmltree::Document::parse(&svg).unwrap();
    let groups = doc.descendants().filter(|n| n.has_attribute("data-load"));
    let one = |g: roxmltree::Node<'_, '_>| {
        let line = g.children().find(|c| c.has_tag_name("path")).unwrap();
        let points = super::reading::covers(line);
        let heads = g
            .children()
            .filter(|c| c.attribute("class").is_some_and(|k| k.ends_with("head")));
        Drawn {
            link: g.attribute("data-load").unwrap().to_owned(),
            says: g
                .children()
                .find(|c| c.has_tag_name("title"))
                .unwrap()
                .text()
                .unwrap()
                .to_owned(),
            along: [0, 1].map(|i| points[points.len() - 1][i] - points[0][i]),
            heads: if points.len() == 2 { heads.count() } else { 0 },
        }
    };
    groups.map(one).collect()
}

#[test]
fn arrows_are_the_loads_of_their_links_to_one_scale() {
    let half = 0.5f64.sqrt();
    // right and up of each side
    let sides = [
        ("z", [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
        ("y", [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
        ("x", [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]),
        ("1,1,0", [-half, half, 0.0], [0.0, 0.0, 1.0]),
    ];
    let mut straight = 0;
    for name in ["bennett", "gripper-10", "sarrus", "door-two-hinges"] {
        let (m, stresses) = stresses(name);
        for (k, stress) in stresses.iter().enumerate() {
            let greatest = stress.joints.iter().filter_map(|w| w.borne);
            let greatest = greatest
                .flat_map(|b| [length(b.force), length(b.moment)])
                .fold(0.0, f64::max);
            for (side, right, up) in sides {
                let k = (k + 1).to_string();
                let drawn = arrows(&["draw", name, "--self-stress", &k, "--view", side]);
                assert!(!drawn.is_empty(), "{name} {k} {side}");
                for a in drawn.iter().filter(|a| a.heads > 0) {
                    straight += 1;
                    let told = |id: &str| a.says.contains(&format!(" at {id}: "));
                    let wrench = stress
                        .joints
                        .iter()
                        .find(|w| told(&m.joints[w.joint].id))
                        .unwrap();
                    let joint = &m.joints[wrench.joint];
                    let sign = if m.links[joint.links[1]].id == a.link {
                        1.0
                    } else {
                        -1.0
                    };
                    let borne = wrench.borne.unwrap();
                    let (what, heads) = if a.says.starts_with("force") {
                        (borne.force, 1)
                    } else {
                        (borne.moment, 2)
                    };
                    assert_eq!(a.heads, heads, "{}", a.says);
                    let there = scale(what, sign * 60.0 / greatest);
                    let off = sub([dot(there, right), -dot(there, up)], a.along);
                    assert!(
                        length(off) < 0.05,
                        "{name} {k} {side} {}: {:?}",
                        a.says,
                        a.along
                    );
                }
            }
        }
    }
    assert!(straight > 300, "{straight}");
}

#[test]
fn a_self_stress_that_is_not_there_is_told() {
    assert_all_fail(
        "
        draw gripper-10 --self-stress 12 | self-stresses 1 to 11
        draw gripper-10 --self-stress 0 | self-stresses 1 to 11
        draw stewart-gough --self-stress 1 | no self-stress
        draw gripper-10 --motion --idle 1 | no idle freedom
        draw gripper-10 --idle 1 | --motion
        ",
    );
}
