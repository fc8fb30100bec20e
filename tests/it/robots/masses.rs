//! Robots: what is written has mass wherever engines want some, and next to none where nothing is.

use crate::common::*;
/// The masses and moments of inertia of links whose name is asked for, by the attributes of URDF.
fn weights(urdf: &str, wanted: impl Fn(&str) -> bool) -> Vec<[f64; 4]> {
    let links = urdf.split("<link name=\"").skip(1);
    let links = links.filter(|l| wanted(l.split('"').next().unwrap()));
    let of = |link: &str, key: &str| -> f64 {
        let link = link.split("<link").next().unwrap();
        let (_, rest) = link
            .split_once(&format!("{key}=\""))
            .unwrap_or_else(|| panic!("{key}: {link}"));
        rest.split('"').next().unwrap().parse().unwrap()
    };
    links
        .map(|l| ["mass value", "ixx", "iyy", "izz"].map(|k| of(l, k)))
        .collect()
}

/// A four-bar of links of 20 g, closed by a hinge.
const FOUR: &str = "<robot name='four-bar'><link name='base'/>
<link name='a'><inertial><mass value='0.02'/><inertia ixx='4e-6' iyy='4e-6' izz='2e-6' ixy='0' ixz='0' iyz='0'/></inertial></link>
<link name='b'><inertial><mass value='0.02'/><inertia ixx='4e-6' iyy='4e-6' izz='2e-6' ixy='0' ixz='0' iyz='0'/></inertial></link>
<link name='c'><inertial><mass value='0.03'/><inertia ixx='4e-6' iyy='4e-6' izz='2e-6' ixy='0' ixz='0' iyz='0'/></inertial></link>
<joint name='j1' type='continuous'><parent link='base'/><child link='a'/><axis xyz='0 0 1'/></joint>
<joint name='j2' type='continuous'><parent link='a'/><child link='b'/><origin xyz='0 1 0'/><axis xyz='0 0 1'/></joint>
<joint name='j3' type='continuous'><parent link='base'/><child link='c'/><origin xyz='2 0 0'/><axis xyz='0 0 1'/></joint>
<loop_joint name='j4' type='revolute'><link1 link='b' xyz='2 0.5 0'/><link2 link='c' xyz='0 1.5 0'/><axis xyz='0 0 1'/></loop_joint>
</robot>";

// Once without: MuJoCo refused a mended file, and sdformat dropped links and what hung on them.
#[test]
fn links_in_between_weigh_something() {
    for at in [&[][..], &["--at", "j2"], &["--at", "j4"]] {
        let (code, out, told) = run_on("fix", "m.urdf", FOUR, at);
        assert_eq!(code, Some(0), "{told}");
        let found = weights(&out, |name| name.contains("_link"));
        assert_eq!(found.len(), 3, "{out}");
        for [mass, x, y, z] in found {
            assert!(0.0 < mass && mass <= 2e-5, "{mass}");
            // Positive definite, and each less than the other two together.
            assert!(0.0 < x && x <= 2e-9 && x == y && y == z, "{x} {y} {z}");
        }
    }
}

#[test]
fn what_moves_in_an_exported_urdf_weighs_something() {
    let (code, out, told) = run_on("fix", "m.urdf", FOUR, "");
    assert_eq!(code, Some(0), "{told}");
    let (code, out, told) = run_on("export", "m.urdf", &out, "--to urdf");
    assert_eq!(code, Some(0), "{told}");
    has(&told, "links without a mass get 1 g");
    assert_eq!(weights(&out, |name| name != "base").len(), 6);
    // Joints in series of a mechanism of our own; what stands still needs no mass.
    let words = ["export", "gripper-10", "--variant", "1", "--to"];
    let of = |format: &str| {
        let o = run(&[&words[..], &[format]].concat());
        assert!(o.status.success(), "{}", utf8_text(&o.stderr));
        utf8_text(&o.stdout)
    };
    let urdf = of("urdf");
    assert!(
        weights(&urdf, |name| name.contains('~')).len() > 3,
        "{urdf}"
    );
    let sdf = of("sdf");
    let between = sdf
        .lines()
        .filter(|l| l.contains("<link name=\"") && l.contains('~'));
    assert!(between.clone().count() > 1, "{sdf}");
    for line in between {
        has(line, "<mass>1e-5</mass>");
    }
}
