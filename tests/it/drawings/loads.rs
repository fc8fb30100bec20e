//! Self-stresses as arrows: what joints bear keeps every link in balance, and that is what is drawn.

use crate::common::*;
use ozols::redundancy::stress::SelfStress;

fn stresses(name: &str) -> (Mechanism, Vec<SelfStress>) {
    let m = built_in(name);
    let found = analyse_states(&m, &[StateId::FREE], Method::Modular).unwrap();
    let stresses = found[0].self_stresses.clone();
    (m, stresses)
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
        draw gripper-10 --self-stress 1 --motion | cannot be used with
        draw gripper-10 --motion --idle 1 | no idle freedom
        draw gripper-10 --idle 1 | --motion
        ",
    );
}
