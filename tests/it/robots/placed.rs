//! Where things are: frames within frames, squared axes, quaternions, and places that come back from each format.

use crate::common::*;
use crate::robots::mjcf::{mjcf, toml_of};
use crate::robots::read_robot;

#[test]
fn frames_of_mjcf_are_within_each_other_and_axes_are_squared() {
    let t = toml_of(
        "m.xml",
        &mjcf(
            "<worldbody><frame pos='1 0 0'><frame pos='0 2 0'><body name='a'><joint name='j' axis='0 0 1'/></body></frame></frame>
            <body name='b' xyaxes='1 0 0 1 1 0'><joint name='k' axis='0 1 0'/></body></worldbody>",
        ),
    );
    has_all(
        &t,
        &[
            "point = [1, 2, 0]\naxis = [0, 0, 1]",
            "point = [0, 0, 0]\naxis = [0, 1, 0]",
        ],
    );
}

/// Drake's URDF: a quaternion has its scalar last, and a universal joint turns about x and then y. A joint that mimics another
/// moves as much where it is not said how much.
#[test]
fn urdf_has_its_own_orders_and_defaults() {
    let t = toml_of(
        "r.urdf",
        "<robot name='r' xmlns:drake='http://drake.mit.edu'><link name='a'/><link name='b'/><link name='c'/><link name='d'/>
        <joint name='p' type='revolute'><parent link='a'/><child link='b'/><axis xyz='1 0 0'/>
          <origin xyz='1 0 0' quat_xyzw='0 0 0.7071067811865476 0.7071067811865476'/></joint>
        <drake:joint name='u' type='universal'><parent link='a'/><child link='c'/><origin xyz='0 0 3'/></drake:joint>
        <joint name='q' type='revolute'><parent link='a'/><child link='d'/><axis xyz='0 0 1'/><origin xyz='0 5 0'/><mimic joint='p'/></joint></robot>",
    );
    has_all(
        &t,
        &[
            "point = [1, 0, 0]\naxis = [0, 1, 0]",
            "type = \"universal\"\npoint = [0, 0, 3]\naxis = [1, 0, 0]\nreference = [0, 1, 0]",
            "ratio = 1",
        ],
    );
}

/// Two axes that are not square make two hinges in series, as a universal joint has square ones.
#[test]
fn oblique_axes_are_two_hinges() {
    let with = |second: &str| {
        let text = format!(
            "<sdf version='1.9'><model name='m'><link name='a'/><link name='b'/><joint name='j' type='universal'><parent>a</parent><child>b</child>
            <axis><xyz>1 0 0</xyz></axis><axis2><xyz>{second}</xyz></axis2></joint></model></sdf>"
        );
        let m = read_robot("m.sdf", &text).mechanism;
        let own = m
            .joints
            .iter()
            .filter(|j| j.joint_type.freedoms().len() < 6);
        own.map(|j| j.joint_type.freedoms().len()).collect_vec()
    };
    assert_eq!(with("0 1 0"), [2]);
    assert_eq!(with("1 1 0"), [1, 1]);
}

fn places(m: &Mechanism) -> Vec<(String, Vector)> {
    let all = m
        .joints
        .iter()
        .filter(|j| j.joint_type.freedoms().len() == 1);
    let metres = m.length_unit.metres;
    all.map(|j| (j.id.clone(), to_vector(&j.frame.point).map(|x| x * metres)))
        .collect()
}

/// Bodies hang on bodies in MJCF, each placed in the one before: hinges come back to where they were.
#[test]
fn hinges_come_back_to_their_places() {
    for name in ["four-bar", "bennett", "parallel-shears"] {
        let m = built_in(name);
        for format in ["mjcf", "urdf", "sdf"] {
            let text = formats::write(&m, format).unwrap();
            let back = read_robot(
                &format!("m.{}", if format == "mjcf" { "xml" } else { format }),
                &text,
            );
            let known = places(&back.mechanism);
            let mut found = 0;
            for (id, at) in places(&m) {
                for (_, there) in known.iter().filter(|k| k.0 == id) {
                    found += 1;
                    assert!(
                        length(sub(at, *there)) < 1e-9,
                        "{name} in {format}: {id} is at {there:?} for {at:?}"
                    );
                }
            }
            assert!(found > 1, "{name} in {format}\n{text}");
        }
    }
}

/// A joint written from a link to the world stands the other way round in SDF, where the world is the parent: the freedom next to the
/// world comes first, and each by the other sign.
#[test]
fn joints_to_the_world_are_turned_round() {
    let file = |kind: &str| {
        format!(
            "name = \"m\"\nlength_unit = \"m\"\nlink = [{{ id = \"arm\", role = \"output\" }}, {{ id = \"world\", role = \"frame\" }}]\n\
            [[joint]]\nid = \"j\"\nlinks = [\"arm\", \"world\"]\n{kind}\npoint = [0, 0, 1]\naxis = [0, 0, 1]\nreference = [1, 0, 0]\n"
        )
    };
    let axes = |kind: &str| {
        let m = read(&file(kind));
        let text = formats::write(&m, "sdf").unwrap();
        let all = text.split("expressed_in=\"__model__\">").skip(1);
        let all = all.map(|t| t.split('<').next().unwrap().to_owned());
        all.collect_vec()
    };
    assert_eq!(axes("type = \"revolute\""), ["0 0 -1"]);
    assert_eq!(axes("type = \"universal\""), ["-1 0 0", "0 0 -1"]);
    // A slide along z, and then a turn about x, which is next to the world.
    assert_eq!(
        axes("type = \"custom\"\nfreedoms = [\"tz\", \"rx\"]"),
        ["-1 0 0", "0 0 -1"]
    );
}
