//! Robots: what other readers take is taken, and what is left out or not as drawn is said, by `lint` too.

use crate::common::*;
use crate::robots::mjcf::mjcf;

/// W, σ and the notes of `lint` on a text.
fn linted(name: &str, text: &str, more: &str) -> (u64, u64, String) {
    let v = Folder::with(name, text).json(&format!("lint {name} {more}"));
    let file = &v["files"][0];
    let notes = format!("{} {}", file["approximated"], file["moved"]);
    (file["mobility"].whole(), file["redundant"].whole(), notes)
}

fn sdf(inner: &str) -> String {
    format!("<sdf version='1.9'>{inner}</sdf>")
}

const HINGE: &str = "<joint name='b' type='revolute'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis></joint>";
const LINKS: &str = "<link name='a'/><link name='b'><pose>1 0 0 0 0 0</pose></link>";
const HELD: &str = "<joint name='held' type='fixed'><parent>world</parent><child>a</child></joint>";

// Gazebo and Drake take a joint that is called as its link.
#[test]
fn joints_may_be_called_as_links() {
    let text = sdf(&format!("<model name='m'>{LINKS}{HELD}{HINGE}</model>"));
    assert_eq!(linted("m.sdf", &text, "").0, 1);
    // But not as another joint.
    let twice = text.replace("name='held'", "name='b'");
    assert_fails_on("lint", "m.sdf", &twice, "", "");
}

// A model that nothing holds falls; a static one stands, and so does one with a link that is held on purpose.
#[test]
fn models_that_nothing_holds_float() {
    let of = |more: &str| sdf(&format!("<model name='m'>{more}{LINKS}{HINGE}</model>"));
    let (w, _, notes) = linted("m.sdf", &of(""), "");
    assert_eq!(w, 7);
    has(&notes, "floats with 6 freedoms");
    assert_eq!(linted("m.sdf", &of(""), "--frame a").0, 1);
    assert_eq!(linted("m.sdf", &of(HELD), "").0, 1);
    let (code, out, _) = run_on("lint", "m.sdf", &of("<static>true</static>"), "");
    assert_eq!(code, Some(0), "{out}");
}

#[test]
fn lights_and_floors_are_no_mechanisms() {
    let folder = Folder::with("lamp.sdf", sdf("<light name='l' type='point'/>"));
    for (uri, code) in [
        ("model://sun", 0),
        ("model://ground_plane", 0),
        ("lamp.sdf", 0),
        ("model://nowhere", 2),
    ] {
        let include = format!("<include><uri>{uri}</uri></include>");
        let model = format!("<model name='m'>{LINKS}{HELD}{HINGE}</model>");
        let world = format!("<world name='w'>{include}{model}</world>");
        folder.put("w.sdf", sdf(&world));
        let (found, out, err) = folder.run("lint w.sdf");
        assert_eq!(found, Some(code), "{uri}: {out}{err}");
    }
}

// Two models of a world, joined there: W = 1 by the hinge of the first, 1 by that between them.
#[test]
fn joints_and_frames_of_a_world_are_read() {
    let text = sdf(&format!(
        "<world name='w'><model name='m'>{LINKS}{HELD}{HINGE}</model>
        <model name='n'><pose>2 0 0 0 0 0</pose><link name='c'/></model>
        <frame name='eye' attached_to='m::b'><pose>1 0 0 0 0 0</pose></frame>
        <joint name='between' type='revolute'><parent>eye</parent><child>n::c</child><axis><xyz>0 1 0</xyz></axis></joint></world>"
    ));
    assert_eq!(linted("w.sdf", &text, "").0, 2);
    let wrong = text.replace("<parent>eye", "<parent>ear");
    assert_fails_on("lint", "w.sdf", &wrong, "", "\"ear\"");
}

#[test]
fn gearboxes_are_couplings() {
    let hinge = |name: &str, child: &str| {
        format!(
            "<joint name='{name}' type='revolute'><parent>a</parent><child>{child}</child><axis><xyz>0 0 1</xyz></axis></joint>"
        )
    };
    let of = |reference: &str| {
        sdf(&format!(
            "<model name='m'>{LINKS}<link name='c'/>{HELD}{}{}
            <joint name='gears' type='gearbox'><parent>b</parent><child>c</child>
            <gearbox_ratio>3</gearbox_ratio><gearbox_reference_body>{reference}</gearbox_reference_body>
            <axis><xyz>0 0 1</xyz></axis><axis2><xyz>0 0 1</xyz></axis2></joint></model>",
            hinge("one", "b"),
            hinge("two", "c")
        ))
    };
    assert_eq!(linted("m.sdf", &of("a"), "").0, 1);
    let (_, out, _) = run_on("export", "m.sdf", &of("a"), "--to toml");
    has(&out, "ratio = -3");
    // What has no such hinges is left out, and said.
    let (w, _, notes) = linted("m.sdf", &of("b"), "");
    assert!(w == 2 && notes.contains("gears"), "{notes}");
}

#[test]
fn urdf_may_hang_on_a_world_that_it_does_not_name() {
    let text = "<robot name='r'><link name='a'/><link name='b'/>
        <joint name='held' type='fixed'><parent link='world'/><child link='a'/></joint>
        <joint name='j' type='continuous'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/></joint></robot>";
    assert_eq!(linted("r.urdf", text, "").0, 1);
}

// They were refused; what hangs on them is left out, and said.
#[test]
fn what_mujoco_makes_of_flexible_and_attached_parts_is_left_out() {
    let text = mjcf(
        "<asset><model name='other' file='other.xml'/></asset><worldbody><body name='a'><joint name='j'/>
        <flexcomp name='cloth' type='grid' count='3 3 1'/><attach model='other' prefix='p_'/></body></worldbody>
        <deformable><skin/></deformable>",
    );
    let (w, _, notes) = linted("m.xml", &text, "");
    assert_eq!(w, 1);
    has_all(&notes, &["cloth", "attach", "deformable"]);
}

// y = x + x²/2, so that at x = 1 the follower goes twice as fast.
#[test]
fn polynomials_are_taken_by_their_derivative() {
    let text = mjcf(
        "<worldbody><body name='a'><joint name='x'/><body name='b' pos='1 0 0'><joint name='y'/></body></body></worldbody>
        <equality><joint joint1='y' joint2='x' polycoef='0 1 0.5'/></equality>",
    );
    for (pose, ratio) in [("x=0", "ratio = 1"), ("x=1", "ratio = 2")] {
        let (w, _, notes) = linted("m.xml", &text, &format!("--pose {pose}"));
        assert!(w == 1 && notes.contains("at this pose is used"), "{notes}");
        let (_, out, _) = run_on(
            "export",
            "m.xml",
            &text,
            &format!("--to toml --pose {pose}"),
        );
        assert!(out.contains(ratio), "{out}");
    }
}

// A loop that ends at the world, as MuJoCo writes it, has the world second; no reader of SDF takes it as a child.
#[test]
fn sdf_never_has_the_world_for_a_child() {
    for (axes, closing) in [
        ("0 0 1", "<connect name='e' body1='c' anchor='0 -1 0'/>"),
        ("0 1 0", "<weld name='e' body1='c'/>"),
    ] {
        let text = mjcf(&format!(
            "<worldbody><body name='a'><joint name='j1' axis='{axes}'/><body name='b' pos='1 0 0'><joint name='j2' axis='{axes}'/>
            <body name='c' pos='0 1 0'><joint name='j3' axis='{axes}'/></body></body></body></worldbody>
            <equality>{closing}</equality>"
        ));
        let (w, sigma, _) = linted("m.xml", &text, "");
        let (code, out, err) = run_on("export", "m.xml", &text, "--to sdf");
        assert_eq!(code, Some(0), "{err}");
        lacks(&out, "<child>world");
        let (w2, sigma2, _) = linted("m.sdf", &out, "");
        assert_eq!((w2, sigma2), (w, sigma), "{out}");
    }
}

// `export --to toml` said all of this, and `lint` none.
#[test]
fn lint_says_what_is_not_as_drawn() {
    let open = mjcf(
        "<worldbody><body name='a'><joint name='j1'/><body name='b' pos='0 1 0'><joint name='j2'/></body></body>
        <body name='c' pos='2 0 0'><joint name='j3'/><site name='t' pos='0 1.5 0'/></body></worldbody>
        <equality><connect name='e' body1='b' body2='c' anchor='2 0.5 0'/></equality>",
    );
    let drake = sdf(&format!(
        "<model name='m'>{LINKS}{HELD}{HINGE}<drake:joint name='p' type='planar'/></model>"
    ));
    let apart = sdf(&format!(
        "<model name='m'>{LINKS}{HELD}<frame name='f' attached_to='a'/>{}</model>",
        HINGE
            .replace("<parent>a", "<parent>f")
            .replace("name='b'", "name='j'")
    ));
    for (name, text, more, words) in [
        ("m.xml", &open, "--pose j1=0.5", "closed to"),
        ("m.sdf", &drake, "", "of Drake that is not read"),
        ("m.sdf", &apart, "", "1.000 m apart"),
    ] {
        let (_, out, err) = run_on("lint", name, text, more);
        let told = out.lines().find(|l| l.contains(words));
        let told = told.unwrap_or_else(|| panic!("{words}: {out}{err}"));
        assert!(told.trim_start().starts_with("note: "), "{told}");
    }
}
