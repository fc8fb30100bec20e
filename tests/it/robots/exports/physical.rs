//! Masses and inertias as each format has them.

use crate::common::*;

/// Of six numbers of inertia the last three differ in order from format to format: xy, yz, zx here; xy, xz, yz in URDF, SDF and
/// MuJoCo's `fullinertia`. Centres are in metres, from the link's own origin where links have one at their joint.
#[test]
fn masses_and_products_of_inertia_are_in_the_formats_own_order() {
    let arm = write_mechanism(
        "name = \"arm\"\nlength_unit = \"mm\"",
        "0 1*",
        "A | 0 1 | revolute | 4, 8, 16 | 0, 1, 0",
    );
    let mass = "role = \"output\"\nmass = 2.5\ncentre = [10, 20, 30]\ninertia = [1.5, 2.5, 3.5, 0.25, -0.5, 0.75]";
    let m = read(&replace_once(&arm, "role = \"output\"", mass));
    for [to, places, wanted] in read_cases::<3>(
        "
        mjcf | inertial.pos | 0.006 0.012 0.014
        mjcf | inertial.mass | 2.5
        mjcf | inertial.fullinertia | 1.5 2.5 3.5 0.25 0.75 -0.5
        urdf | origin.xyz | 0.006 0.012 0.014
        urdf | mass.value | 2.5
        urdf | inertia.ixx inertia.iyy inertia.izz inertia.ixy inertia.ixz inertia.iyz | 1.5 2.5 3.5 0.25 0.75 -0.5
        sdf | pose | 0.01 0.02 0.03 0 0 0
        sdf | mass ixx iyy izz ixy ixz iyz | 2.5 1.5 2.5 3.5 0.25 0.75 -0.5
        ",
    ) {
        let text = formats::write(&m, to).unwrap();
        let xml = roxmltree::Document::parse(&text).unwrap();
        let tagged = |tag: &'static str| move |n: &roxmltree::Node<'_, '_>| n.has_tag_name(tag);
        let inertial = xml.descendants().find(tagged("inertial")).unwrap();
        let numbers = places.split(' ').flat_map(|place| {
            let (tag, attribute) = place.split_once('.').unwrap_or((place, ""));
            let found = inertial.descendants().find(tagged(tag)).unwrap();
            let text = found.attribute(attribute).or(found.text()).unwrap();
            text.split_whitespace().map(|x| x.parse::<f64>().unwrap()).collect_vec()
        });
        let wanted = wanted.split(' ').map(|x| x.parse::<f64>().unwrap());
        for (found, wanted) in numbers.zip_eq(wanted) {
            near(found, wanted, 1e-12);
        }
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
