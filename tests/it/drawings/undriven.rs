//! Motions of mechanisms in which no joint can be a drive: their working motion is shown.

use crate::common::*;
use ozols::motion::working::working_way;

#[test]
fn joints_stay_together_while_the_outputs_move() {
    for name in split_words("griffis-duffy double-banana wren-platform shaft-two-bearings bennett")
    {
        let m = built_in(name);
        let pose = Pose::of_file(&m, StateId::FREE).unwrap();
        let way = working_way(&m, StateId::FREE, &pose, 40).unwrap_or_else(|| panic!("{name}"));
        assert!(way.links.len() > 10, "{name}: {}", way.links.len());
        let moved = |l: ozols::model::mechanism::LinkId,
                     links: &[ozols::geom::rigid::RigidMotion]| {
            let m = &links[l.index()];
            let turn = (0..3).map(|i| (m.rotation[i][i] - 1.0).abs());
            turn.chain(m.translation.map(f64::abs)).fold(0.0, f64::max)
        };
        let outputs: Vec<_> = m
            .link_ids()
            .filter(|&l| m.links[l].role == Role::Output)
            .collect();
        let most = way
            .links
            .iter()
            .flat_map(|links| outputs.iter().map(|&l| moved(l, links)))
            .fold(0.0, f64::max);
        assert!(most > 0.01, "{name}: {most}");
        for links in &way.links {
            for j in m.joints_in(StateId::FREE).map(|j| &m.joints[j]) {
                if j.joint_type.freedoms().iter().any(|f| !f.is_turn()) {
                    continue;
                }
                let at = [0, 1, 2].map(|i| j.frame.point[i].to_f64());
                let own = [0, 1, 2].map(|i| (at[i] - pose.middle[i]) / pose.length);
                let [a, b] = j.links.map(|l| links[l.index()].map_point(own));
                let apart = (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max);
                assert!(apart < 1e-8, "{name} {}: {apart}", j.id);
            }
        }
    }
}

#[test]
fn drawings_show_them() {
    for name in split_words("griffis-duffy double-banana wren-platform shaft-two-bearings") {
        let svg = run_quiet(&["draw", name, "--motion"]);
        let pictures = svg.matches("data-frame").count();
        assert!(pictures > 10, "{name}: {pictures}");
    }
}
