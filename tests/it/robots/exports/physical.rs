//! Masses and inertias as each format has them.

use crate::common::*;

/// Of six numbers of inertia the last three differ in order from format to format: xy, yz, zx here; xy, xz, yz in URDF, SDF and
/// MuJoCo's `fullinertia`. Centres are in metres, from the link's own origin where links have one at their joint.
#[test]
fn masses_and_products_of_inertia_are_in_the_formats_own_order() {
    let text = "name = \"arm\"\nlength_unit = \"mm\"\n[[link]]\nid = \"0\"\nrole = \"frame\"\n[[link]]\nid = \"1\"\nrole = \"output\"\n\
        mass = 2.5\ncentre = [10, 20, 30]\ninertia = [1.5, 2.5, 3.5, 0.25, -0.5, 0.75]\n[[joint]]\nid = \"A\"\n\
        links = [\"0\", \"1\"]\ntype = \"revolute\"\npoint = [4, 8, 16]\naxis = [0, 1, 0]\n";
    let m = read(text);
    let [xx, yy, zz, xy, yz, zx] = [1.5, 2.5, 3.5, 0.25, -0.5, 0.75];
    let entries = [
        ("ixx", xx),
        ("iyy", yy),
        ("izz", zz),
        ("ixy", xy),
        ("ixz", zx),
        ("iyz", yz),
    ];
    let numbers = |text: &str| -> Vec<f64> {
        text.split_whitespace()
            .map(|x| x.parse().unwrap())
            .collect()
    };
    let near = |found: &[f64], wanted: &[f64], what: &str| {
        assert_eq!(found.len(), wanted.len(), "{what}");
        let all = found.iter().zip(wanted);
        all.for_each(|(f, w)| assert!((f - w).abs() < 1e-12, "{what}: {found:?} {wanted:?}"));
    };
    let from_joint = [0.006, 0.012, 0.014];
    let parsed = |to: &str| formats::write(&m, to).unwrap();
    let mjcf = parsed("mjcf");
    let xml = roxmltree::Document::parse(&mjcf).unwrap();
    let inertial = xml
        .descendants()
        .find(|n| n.has_tag_name("inertial"))
        .unwrap();
    let of = |name: &str| numbers(inertial.attribute(name).unwrap());
    near(&of("pos"), &from_joint, "mjcf");
    near(&of("mass"), &[2.5], "mjcf");
    near(&of("fullinertia"), &[xx, yy, zz, xy, zx, yz], "mjcf");
    let urdf = parsed("urdf");
    let xml = roxmltree::Document::parse(&urdf).unwrap();
    let one = |tag: &str| {
        let inertial = xml
            .descendants()
            .find(|n| n.has_tag_name("inertial"))
            .unwrap();
        inertial.children().find(|n| n.has_tag_name(tag)).unwrap()
    };
    near(
        &numbers(one("origin").attribute("xyz").unwrap()),
        &from_joint,
        "urdf",
    );
    near(
        &numbers(one("mass").attribute("value").unwrap()),
        &[2.5],
        "urdf",
    );
    for (name, value) in entries {
        near(
            &numbers(one("inertia").attribute(name).unwrap()),
            &[value],
            name,
        );
    }
    let sdf = parsed("sdf");
    let xml = roxmltree::Document::parse(&sdf).unwrap();
    let inertial = xml
        .descendants()
        .find(|n| n.has_tag_name("inertial"))
        .unwrap();
    let one = |tag: &str| {
        let found = inertial.descendants().find(|n| n.has_tag_name(tag));
        numbers(found.unwrap().text().unwrap())
    };
    near(&one("pose")[..3], &[0.01, 0.02, 0.03], "sdf");
    near(&one("mass"), &[2.5], "sdf");
    for (name, value) in entries {
        near(&one(name), &[value], name);
    }
}

/// The slider of the gripper slides and may turn about its guide: its drive is the slide, as in statics, and so is its motor.
#[test]
fn motors_are_on_the_freedom_that_the_drive_holds() {
    for (name, motors) in [
        ("gripper-10", &["0-1~2"][..]),
        ("four-bar", &["0-1"]),
        ("slider-crank-determinate", &["0-1"]),
    ] {
        let m = built_in(name);
        let text = formats::write(&m, "mjcf").unwrap();
        let xml = roxmltree::Document::parse(&text).unwrap();
        let found: Vec<&str> = xml
            .descendants()
            .filter(|n| n.has_tag_name("motor"))
            .map(|n| n.attribute("joint").unwrap())
            .collect();
        assert_eq!(found, motors, "{name}");
        let joint = |n: &roxmltree::Node<'_, '_>| n.attribute("name") == Some(found[0]);
        let of_motor = xml
            .descendants()
            .filter(|n| n.has_tag_name("joint"))
            .find(joint);
        let kind = of_motor.unwrap().attribute("type");
        assert_eq!(
            kind,
            Some(if name == "gripper-10" {
                "slide"
            } else {
                "hinge"
            })
        );
    }
}

/// Engines refuse what moves without a mass: a link that is stated to weigh nothing weighs a gram there, like one that states none.
#[test]
fn a_link_that_weighs_nothing_weighs_a_gram() {
    let of = |mass: &str| -> f64 {
        let text = format!(
            "name = \"arm\"\nlength_unit = \"mm\"\n[[link]]\nid = \"0\"\nrole = \"frame\"\n[[link]]\nid = \"1\"\nrole = \"output\"\n\
             {mass}\n[[joint]]\nid = \"A\"\nlinks = [\"0\", \"1\"]\ntype = \"revolute\"\npoint = [4, 8, 16]\naxis = [0, 1, 0]\n"
        );
        let m = read(&text);
        let mjcf = formats::write(&m, "mjcf").unwrap();
        let xml = roxmltree::Document::parse(&mjcf).unwrap();
        let mut all = xml.descendants().filter(|n| n.has_tag_name("inertial"));
        all.next()
            .unwrap()
            .attribute("mass")
            .unwrap()
            .parse()
            .unwrap()
    };
    assert_eq!(of(""), 0.001);
    assert_eq!(of("mass = 0\ncentre = [10, 20, 30]"), 0.001);
    assert_eq!(of("mass = 2\ncentre = [10, 20, 30]"), 2.0);
}
