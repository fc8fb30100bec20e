//! Twists of links: each is carried by all before it.

use crate::common::*;

/// Three hinges about z in a row, at speeds 1, -3 and 5: links turn at 1, -2 and 3. By hand, a point at the height of the hinges and
/// 20 before the first goes at minus the sum of speed times distance.
#[test]
fn a_link_is_carried_by_all_before_it() {
    let joint = |n: u32| {
        format!(
            "j{n} | {} {n} | revolute | {}, 0, 0 | 0, 0, 1",
            n - 1,
            10 * n
        )
    };
    let text = write_mechanism(
        "name = \"arm\"\nlength_unit = \"m\"",
        "0 1 2 3*",
        &(1..4).map(joint).join("\n"),
    );
    let m = read(&text);
    let pose = Pose::of_file(&m, StateId::FREE).unwrap();
    let geometry = Geometry::new(&m, StateId::FREE, &pose).unwrap();
    let twists = geometry.link_twists(m.links.len(), &[1.0, -3.0, 5.0]);
    let (spread, at) = (geometry.size, geometry.of_file([-10.0, 0.0, 0.0]));
    for (link, turn, speed) in [("1", 1.0, -20.0), ("2", -2.0, 70.0), ("3", 3.0, -130.0)] {
        let t = twists[m.link_named(link).unwrap()];
        assert_all_nine_digits([t[0], t[1], t[2]], [0.0, 0.0, turn]);
        // Velocity of the point: v + ω × p, in the size.
        let along = [t[3] - turn * at[1], t[4] + turn * at[0], t[5]];
        assert_all_nine_digits(along.map(|x| x * spread), [0.0, speed, 0.0]);
    }
}
