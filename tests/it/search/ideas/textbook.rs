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
/// A file of a linkage in a plane: a rod between a crank and a lever, a slider-crank, or two rods from one part, which slides or
/// turns, each to a lever. The first joint drives.
fn linkage(shape: &str, points: &str) -> String {
    let at: Vec<String> = points.split(", ").map(|p| p.replace(' ', ", ")).collect();
    let joint = |id: &str, ends: &str, kind: char, p: usize| {
        let (kind, axis, options) = match kind {
            'p' => ("prismatic", "1, 0, 0", "options = [\"cylindrical\"]\\n"),
            _ => ("revolute", "0, 0, 1", ""),
        };
        let drive = if p == 0 { "drive = true" } else { "" };
        format!(
            "{id} | {ends} | {kind} | {}, 0 | {axis} | {options}{drive}\n",
            at[p]
        )
    };
    let (links, joints) = match shape {
        "rod" | "slider" => {
            let kind = if shape == "rod" { 'r' } else { 'p' };
            let first = [
                joint("a", "0 crank", 'r', 0),
                joint("b", "crank rod", 'r', 1),
            ];
            let last = [
                joint("c", "rod end", 'r', 2),
                joint("d", "end 0", kind, at.len() - 1),
            ];
            ("0 crank end* rod", [first, last].concat().concat())
        }
        _ => {
            let mut all = joint("o", "0 middle", if shape == "slid" { 'p' } else { 'r' }, 0);
            for i in 1..=2 {
                let p = 3 * i - 2;
                all += &joint(&format!("b{i}"), &format!("middle rod-{i}"), 'r', p);
                all += &joint(&format!("c{i}"), &format!("rod-{i} lever-{i}"), 'r', p + 1);
                all += &joint(&format!("d{i}"), &format!("lever-{i} 0"), 'r', p + 2);
            }
            ("0 lever-1* lever-2* middle rod-1 rod-2", all)
        }
    };
    let options = "[\"revolute\", \"cylindrical\", \"universal\", \"spherical\"]";
    let head = format!("name = \"linkage\"\nlength_unit = \"mm\"\n[search]\noptions = {options}");
    write_mechanism(&head, links, &joints)
}

/// The first ideas of a file or a built-in mechanism, where none of them makes just these changes: joints and what is put there.
fn missed(of: &str, wanted: &str) -> Option<String> {
    let found = run_json(&["search", of, "--distinct", "--top", "3", "--format", "json"]);
    let wanted: BTreeSet<&str> = wanted.split(", ").collect();
    let changes = |v: &Value| {
        let all = v["changes"].list().iter();
        all.map(|c| format!("{} {}", c["joint"].word(), c["to"].word()))
            .collect::<BTreeSet<_>>()
    };
    let known: Vec<_> = found["variants"].list().iter().map(changes).collect();
    let met = known
        .iter()
        .any(|k| k.iter().map(String::as_str).eq(wanted.iter().copied()));
    (!met).then(|| format!("{known:?}, not {wanted:?}"))
}

#[test]
fn the_redesigns_of_handbooks_are_among_the_first_three_ideas() {
    let written = read_cases::<3>(
        "
        steering trapezoid [Reimpell] | rod | 0 0, 20 -60, 280 -60, 300 0
        drag link [Reimpell] | rod | 0 0, 0 -150, 500 -170, 520 -20
        drop link of an anti-roll bar [Reimpell] | rod | 0 0, 180 10, 190 -130, 20 -140
        gear-shift linkage [71802] | rod | 0 0, 0 90, 400 110, 410 0
        throttle linkage [Bosch] | rod | 0 0, 30 40, 200 70, 220 20
        wiper [Bosch] | rod | 0 0, 25 30, 240 60, 250 -10
        control rod between bell cranks [12240] | rod | 0 0, 10 80, 600 95, 600 15
        coupled dampers [12240] | rod | 0 0, -30 50, 270 55, 300 5
        treadle [12240] | rod | 0 0, 15 30, 40 -300, 160 -310
        mower knife [Hartenberg] | slider | 0 0, 30 40, 300 -20
        engine with two ball ends [Hartenberg] | slider | 0 0, 20 45, 180 0
        rack and two tie rods [Reimpell] | slid | 0 0, -300 0, -600 20, -620 130, 300 0, 600 20, 620 130
        two throttles on one shaft [Bosch] | turned | 0 0, -20 30, -200 60, -210 20, 20 30, 200 60, 210 20
        toggle gripper [12240] | slid | 0 0, 0 8, 6 30, 30 25, 0 -8, 6 -30, 30 -25
        ",
    );
    let built_in = read_cases::<3>(
        "
        four-bar [Hartenberg] | four-bar | 1-2 spherical, 2-3 spherical
        four-bar [Reshetov] | four-bar | 1-2 cylindrical, 2-3 spherical
        slider-crank [Hartenberg] | slider-crank-spatial | 1-2 spherical, 2-3 spherical
        slider-crank [Reshetov] | slider-crank-spatial | 1-2 spherical, 3-0 cylindrical
        door [Blanding] | door-two-hinges | 0-1-low sphere-in-cylinder, 0-1-high spherical
        double Hooke joint [Phillips] | hooke-double | 5-0 cylindrical
        ",
    );
    let mut all = Vec::new();
    for [name, shape, points] in &written {
        let (_folder, path) =
            crate::common::write_temporary("linkage.toml", linkage(shape, points));
        let wanted = match *shape {
            "rod" | "slider" => "b spherical, c spherical",
            _ => "b1 spherical, b2 spherical, c1 spherical, c2 spherical",
        };
        all.extend(missed(path, wanted).map(|f| format!("{name}: {f}")));
    }
    for [name, of, wanted] in &built_in {
        all.extend(missed(of, wanted).map(|f| format!("{name}: {f}")));
    }
    assert_eq!(written.len() + built_in.len(), 20);
    assert!(all.is_empty(), "{all:#?}");
}
