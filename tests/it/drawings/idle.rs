//! Idle freedoms as motions: what rests does so, joints stay together, and one sees what turns in its place.

use crate::common::*;
use ozols::redundancy::local_mobility::animate_idle;

#[test]
fn an_idle_freedom_moves_its_own_links_and_keeps_joints_together() {
    let (mut seen, mut held) = (0, 0);
    for name in builtin::names() {
        let m = built_in(name);
        let states: Vec<StateId> = m.state_ids().collect();
        for (state, found) in states
            .iter()
            .zip(analyse_states(&m, &states, Method::Modular).unwrap())
        {
            let pose = Pose::of_file(&m, *state).unwrap();
            for (k, idle) in found.idle.iter().enumerate() {
                seen += 1;
                let found = animate_idle(&m, *state, &found.idle, k).unwrap().unwrap();
                let moved = |l: ozols::model::mechanism::LinkId| {
                    let far = found
                        .way
                        .links
                        .iter()
                        .map(|links| links[l].angle() + length(links[l].translation));
                    far.fold(0.0, f64::max)
                };
                for l in m.link_ids() {
                    if idle.links.contains(&l) {
                        assert!(moved(l) > 1e-3, "{name}: {} rests", m.links[l].id);
                    } else {
                        assert!(moved(l) < 1e-9, "{name}: {} moves", m.links[l].id);
                    }
                }
                if !found.closed {
                    continue;
                }
                let pinned = |j: &JointType| {
                    matches!(
                        j,
                        JointType::Revolute | JointType::Spherical | JointType::Universal
                    )
                };
                for j in m
                    .joints_in(*state)
                    .filter(|&j| pinned(&m.joints[j].joint_type))
                {
                    let p = to_vector(&m.joints[j].frame.point);
                    let p = scale(sub(p, pose.middle), 1.0 / pose.length);
                    for links in &found.way.links {
                        let [a, b] = m.joints[j].links.map(|l| links[l].map_point(p));
                        held += 1;
                        let apart = length(sub(a, b));
                        assert!(apart < 1e-9, "{name}: {} opens by {apart}", m.joints[j].id);
                    }
                }
            }
        }
    }
    assert!(seen > 20 && held > 500, "{seen} {held}");
}

#[test]
fn a_rod_that_spins_carries_a_flag() {
    let svg = run_quiet("draw rssr --motion --idle 1");
    let doc = roxmltree::Document::parse(&svg).unwrap();
    let frames = doc.descendants().filter(|n| n.has_attribute("data-frame"));
    let flags: Vec<&str> = frames
        .filter_map(|f| f.children().find(|c| c.attribute("class") == Some("flag")))
        .map(|f| f.attribute("d").unwrap())
        .collect();
    assert_eq!(flags.len(), 48, "one in each picture");
    assert!(flags.iter().any(|f| *f != flags[0]), "it turns");
    assert!(svg.contains("flag on a link that turns in its place"));
    assert!(svg.contains("idle freedom 1: link"));
}
