//! Points of interest: where they are, their ways over the stroke, and what is wrong with some.

use crate::common::*;
/// The numbers of a path, point by point.
fn points(d: &str) -> Vec<[f64; 2]> {
    let numbers = d.trim_end_matches('Z')[1..].split('L');
    numbers
        .map(|p| {
            let (x, y) = p.split_once(' ').unwrap();
            [x.parse().unwrap(), y.parse().unwrap()]
        })
        .collect()
}

fn trace(svg: &str) -> Vec<[f64; 2]> {
    let doc = roxmltree::Document::parse(svg).unwrap();
    let path = doc
        .descendants()
        .find(|n| n.has_tag_name("path") && n.attribute("class") == Some("trace"));
    points(path.unwrap().attribute("d").unwrap())
}

/// The step of Jansen's leg, computed here from the lengths he published by meeting circles, the crank turn by turn.
fn step() -> Vec<[f64; 2]> {
    let meet = |p: [f64; 2], r: f64, q: [f64; 2], s: f64, side: f64| {
        let (dx, dy) = (q[0] - p[0], q[1] - p[1]);
        let d = dx.hypot(dy);
        let x = (r * r - s * s + d * d) / (2.0 * d);
        let y = side * (r * r - x * x).sqrt();
        [p[0] + (x * dx - y * dy) / d, p[1] + (x * dy + y * dx) / d]
    };
    let z = [-38.0, -7.8];
    let foot = |turn: f64| {
        let m = [15.0 * turn.cos(), 15.0 * turn.sin()];
        let upper = meet(m, 50.0, z, 41.5, -1.0);
        let lower = meet(m, 61.9, z, 39.3, 1.0);
        let back = meet(upper, 55.8, z, 40.1, -1.0);
        let knee = meet(back, 39.4, lower, 36.7, -1.0);
        meet(knee, 65.7, lower, 49.0, -1.0)
    };
    (0..36)
        .map(|i| foot((40.0 + 10.0 * f64::from(i)).to_radians()))
        .collect()
}

#[test]
fn the_foot_of_jansens_leg_goes_its_step() {
    let svg = run_quiet("draw jansen-leg --kind kinematic --stroke 0:360deg:36");
    let (drawn, meant) = (trace(&svg), step());
    assert!(drawn.len() >= 36);
    let box_of = |p: &[[f64; 2]]| {
        let range = |i: usize| {
            let all = p.iter().map(|q| q[i]);
            all.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| {
                (l.min(x), h.max(x))
            })
        };
        [range(0), range(1)]
    };
    let ([(l, r), _], [(a, b), _]) = (box_of(&drawn), box_of(&meant));
    let scale = (r - l) / (b - a);
    let first = [
        drawn[0][0] - scale * meant[0][0],
        drawn[0][1] + scale * meant[0][1],
    ];
    for (d, m) in drawn.iter().zip(&meant) {
        let off = (d[0] - first[0] - scale * m[0]).hypot(d[1] - first[1] + scale * m[1]);
        // hinges of the file are rounded to 0.01 mm
        assert!(off < 0.1 * scale, "{off} pixels, {scale} a mm");
    }
    // flat on the ground over a third of the turn and more
    let ground = meant.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
    assert!(meant.iter().filter(|p| p[1] < ground + 0.5).count() >= 12);
}

#[test]
fn points_are_shown_in_every_kinematic_drawing() {
    for args in [
        &["draw", "jansen-leg", "--kind", "kinematic"][..],
        &["draw", "jansen-leg", "--motion"],
        &["report", "jansen-leg"],
    ] {
        let shown = run_quiet(args);
        has(&shown, "point of interest, or face of a jaw");
    }
}

#[test]
fn what_is_wrong_with_a_point_is_told() {
    let own = run_quiet("show jansen-leg");
    for [from, to, said] in read_cases::<3>(
        r#"
        link = "ghi" | link = "gih" | unknown link "gih"
        id = "foot" | id = "" | an id must have 1 to 64 characters
        [-26.53, -91.82, 0] | [-26.53, -91.82] | 3
        [-26.53, -91.82, 0] | ["a", -91.82, 0] | unknown word `a`
"#,
    ) {
        let (code, _, err) = run_on("check", "leg.toml", &replace_once(&own, from, to), "");
        assert_eq!(code, Some(2), "{to}");
        assert!(
            err.contains(said) && err.contains("leg.toml:"),
            "{to}: {err}"
        );
    }
    let twice = own.clone() + "\n[[point]]\nid = \"foot\"\nlink = \"m\"\npoint = [0, 0, 0]\n";
    assert_fails_on(
        "check",
        "leg.toml",
        &twice,
        "",
        "point id \"foot\" is used twice",
    );
}

#[test]
fn the_faces_of_jaws_are_shown_with_their_ways() {
    let open = run_quiet("draw gripper-10 --kind kinematic --stroke=-1:1:20");
    let doc = roxmltree::Document::parse(&open).unwrap();
    let faces = doc.descendants().filter_map(|n| n.attribute("data-point"));
    assert_eq!(faces.collect::<Vec<_>>(), ["4-a", "a-8"]);
    let ways = doc
        .descendants()
        .filter(|n| n.attribute("class") == Some("trace"));
    assert_eq!(ways.count(), 3, "one of each face, and one in the legend");
    // what is drawn as a joint is no point
    let closed = run_quiet("draw gripper-10 --kind kinematic --state clamped");
    assert!(!closed.contains("data-point") && closed.contains("data-joint=\"4-a\""));
}
