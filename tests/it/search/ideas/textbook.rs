//! Mechanisms of handbooks with every joint a hinge or a slide, and the joints that the handbooks give them instead: among the
//! first three ideas.
//!
//! # Sources
//! [Reimpell]: J. Reimpell, H. Stoll, J. W. Betzler, The Automotive Chassis, 2nd ed., Butterworth-Heinemann, 2001: tie rods, drag
//! links and drop links with a ball joint at each end. [Bosch]: Automotive Handbook, Robert Bosch GmbH: wiper linkages and throttle
//! linkages with ball studs. [71802]: DIN 71802, ball-and-socket joints for rods. [12240]: ISO 12240-4, rod ends. [8132]: ISO 8132, rod
//! ends and eyes with spherical plain bearings of hydraulic cylinders. [Hartenberg]: R. S. Hartenberg, J. Denavit, Kinematic Synthesis
//! of Linkages, McGraw-Hill, 1964: RSSR, RSSP. [Reshetov]: L. N. Reshetov, Self-Aligning Mechanisms, Mir, 1982: a ball at one end
//! of the rod, a bush that lets it shift at the other; a piston that turns. [Blanding]: D. L. Blanding, Exact Constraint, ASME Press,
//! 1999: a hinge line on a ball and a ball in a bore. [Phillips]: J. Phillips, Freedom in Machinery, 1984: the sliding shaft of a
//! double Hooke joint.

use crate::common::*;

/// A joint: its name, its links, `r` for a hinge across the plane or `p` for a slide along x, and where it is.
type Joint = (&'static str, [&'static str; 2], char, [i32; 2]);

/// A file of a linkage in a plane: the first joint drives, `outputs` are what is moved.
fn linkage(joints: &[Joint], outputs: &[&str]) -> String {
    let mut text = "name = \"linkage\"\nlength_unit = \"mm\"\n[search]\n\
         options = [\"revolute\", \"cylindrical\", \"universal\", \"spherical\"]\n"
        .to_owned();
    let mut links: Vec<&str> = joints.iter().flat_map(|j| j.1).collect();
    links.sort_unstable();
    links.dedup();
    for l in links {
        let role = match l {
            "0" => "role = \"frame\"",
            l if outputs.contains(&l) => "role = \"output\"",
            _ => "",
        };
        text += &format!("[[link]]\nid = \"{l}\"\n{role}\n");
    }
    for (i, (id, [a, b], kind, [x, y])) in joints.iter().enumerate() {
        let (kind, axis) = match kind {
            'p' => (
                "type = \"prismatic\"\noptions = [\"cylindrical\"]",
                "[1, 0, 0]",
            ),
            _ => ("type = \"revolute\"", "[0, 0, 1]"),
        };
        let drive = if i == 0 { "drive = true" } else { "" };
        text += &format!(
            "[[joint]]\nid = \"{id}\"\nlinks = [\"{a}\", \"{b}\"]\n{kind}\npoint = [{x}, {y}, 0]\naxis = {axis}\n{drive}\n"
        );
    }
    text
}

/// A crank or lever at each end of a rod: crank pivot, both ends of the rod, lever pivot.
fn rod([a, b, c, d]: [[i32; 2]; 4]) -> String {
    let joints = [
        ("a", ["0", "crank"], 'r', a),
        ("b", ["crank", "rod"], 'r', b),
        ("c", ["rod", "lever"], 'r', c),
        ("d", ["lever", "0"], 'r', d),
    ];
    linkage(&joints, &["lever"])
}

/// Two rods from one part that a joint of the frame guides, each to a lever.
fn two_rods(kind: char, o: [i32; 2], [left, right]: [[[i32; 2]; 3]; 2]) -> String {
    let joints = [
        ("o", ["0", "middle"], kind, o),
        ("b1", ["middle", "rod 1"], 'r', left[0]),
        ("c1", ["rod 1", "lever 1"], 'r', left[1]),
        ("d1", ["lever 1", "0"], 'r', left[2]),
        ("b2", ["middle", "rod 2"], 'r', right[0]),
        ("c2", ["rod 2", "lever 2"], 'r', right[1]),
        ("d2", ["lever 2", "0"], 'r', right[2]),
    ];
    linkage(&joints, &["lever 1", "lever 2"])
}

/// A crank, a rod and a slide along x.
fn slider(a: [i32; 2], b: [i32; 2], c: [i32; 2]) -> String {
    let joints = [
        ("a", ["0", "crank"], 'r', a),
        ("b", ["crank", "rod"], 'r', b),
        ("c", ["rod", "slide"], 'r', c),
        ("d", ["slide", "0"], 'p', c),
    ];
    linkage(&joints, &["slide"])
}

/// Joints and what is put there.
type Changes = &'static [(&'static str, &'static str)];

/// The first ideas of a file or a built-in mechanism, where none of them makes just these changes.
fn missed(of: &str, wanted: Changes) -> Option<String> {
    let args = ["--distinct", "--top", "3", "--format", "json"];
    let found = json(&[&["search", of], &args[..]].concat());
    let wanted: BTreeMap<_, _> = wanted
        .iter()
        .map(|(j, t)| ((*j).to_owned(), (*t).to_owned()))
        .collect();
    let word = |v: &Value| v.word().to_owned();
    let changes = |v: &Value| {
        let all = v["changes"].list().iter();
        all.map(|c| (word(&c["joint"]), word(&c["to"])))
            .collect::<BTreeMap<_, _>>()
    };
    let ideas = found["variants"].list();
    let known: Vec<_> = ideas.iter().map(changes).collect();
    let all = || format!("{known:?}, not {wanted:?}");
    (!known.contains(&wanted)).then(all)
}

const BALLS: Changes = &[("b", "spherical"), ("c", "spherical")];
const FOUR_BALLS: Changes = &[
    ("b1", "spherical"),
    ("c1", "spherical"),
    ("b2", "spherical"),
    ("c2", "spherical"),
];

#[test]
fn the_redesigns_of_handbooks_are_among_the_first_three_ideas() {
    let written = [
        (
            "steering trapezoid [Reimpell]",
            rod([[0, 0], [20, -60], [280, -60], [300, 0]]),
            BALLS,
        ),
        (
            "drag link [Reimpell]",
            rod([[0, 0], [0, -150], [500, -170], [520, -20]]),
            BALLS,
        ),
        (
            "drop link of an anti-roll bar [Reimpell]",
            rod([[0, 0], [180, 10], [190, -130], [20, -140]]),
            BALLS,
        ),
        (
            "gear-shift linkage [71802]",
            rod([[0, 0], [0, 90], [400, 110], [410, 0]]),
            BALLS,
        ),
        (
            "throttle linkage [Bosch]",
            rod([[0, 0], [30, 40], [200, 70], [220, 20]]),
            BALLS,
        ),
        (
            "wiper [Bosch]",
            rod([[0, 0], [25, 30], [240, 60], [250, -10]]),
            BALLS,
        ),
        (
            "control rod between bell cranks [12240]",
            rod([[0, 0], [10, 80], [600, 95], [600, 15]]),
            BALLS,
        ),
        (
            "coupled dampers [12240]",
            rod([[0, 0], [-30, 50], [270, 55], [300, 5]]),
            BALLS,
        ),
        (
            "treadle [12240]",
            rod([[0, 0], [15, 30], [40, -300], [160, -310]]),
            BALLS,
        ),
        (
            "mower knife [Hartenberg]",
            slider([0, 0], [30, 40], [300, -20]),
            BALLS,
        ),
        (
            "engine with two ball ends [Hartenberg]",
            slider([0, 0], [20, 45], [180, 0]),
            BALLS,
        ),
        (
            "rack and two tie rods [Reimpell]",
            two_rods(
                'p',
                [0, 0],
                [
                    [[-300, 0], [-600, 20], [-620, 130]],
                    [[300, 0], [600, 20], [620, 130]],
                ],
            ),
            FOUR_BALLS,
        ),
        (
            "two throttles on one shaft [Bosch]",
            two_rods(
                'r',
                [0, 0],
                [
                    [[-20, 30], [-200, 60], [-210, 20]],
                    [[20, 30], [200, 60], [210, 20]],
                ],
            ),
            FOUR_BALLS,
        ),
        (
            "toggle gripper [12240]",
            two_rods(
                'p',
                [0, 0],
                [[[0, 8], [6, 30], [30, 25]], [[0, -8], [6, -30], [30, -25]]],
            ),
            FOUR_BALLS,
        ),
    ];
    let built_in: [(&str, &str, Changes); 6] = [
        (
            "four-bar [Hartenberg]",
            "four-bar",
            &[("1-2", "spherical"), ("2-3", "spherical")],
        ),
        (
            "four-bar [Reshetov]",
            "four-bar",
            &[("1-2", "cylindrical"), ("2-3", "spherical")],
        ),
        (
            "slider-crank [Hartenberg]",
            "slider-crank-spatial",
            &[("1-2", "spherical"), ("2-3", "spherical")],
        ),
        (
            "slider-crank [Reshetov]",
            "slider-crank-spatial",
            &[("1-2", "spherical"), ("3-0", "cylindrical")],
        ),
        (
            "door [Blanding]",
            "door-two-hinges",
            &[("0-1-low", "sphere-in-cylinder"), ("0-1-high", "spherical")],
        ),
        (
            "double Hooke joint [Phillips]",
            "hooke-double",
            &[("5-0", "cylindrical")],
        ),
    ];
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("linkage.toml");
    let mut all = Vec::new();
    for (name, text, wanted) in &written {
        fs::write(&path, text).unwrap();
        let found = missed(path.to_str().unwrap(), wanted);
        all.extend(found.map(|f| format!("{name}: {f}")));
    }
    for (name, of, wanted) in built_in {
        all.extend(missed(of, wanted).map(|f| format!("{name}: {f}")));
    }
    assert_eq!(written.len() + built_in.len(), 20);
    assert!(all.is_empty(), "{all:#?}");
}
