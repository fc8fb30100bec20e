//! MJCF: orientations, defaults, joints in series, equalities, includes.

use crate::common::*;
use crate::robots::{message_of, no_files, numeric_figures, read_robot};

// MuJoCo's values count from `ref`, where the model is as drawn; the pose is in radians whatever the file's unit.
#[test]
fn mjcf_reference_pose() {
    let at = |value: f64| {
        let options = default_with(|o: &mut Options| o.pose = vec![("j".to_owned(), vec![value])]);
        let text = mjcf(
            "<worldbody><body name='a'><joint name='j' ref='90'/><body name='b' pos='1 0 0'><joint name='k'/></body></body></worldbody>",
        );
        import("m.xml", text.as_bytes(), &no_files, &options)
            .unwrap()
            .toml()
            .unwrap()
    };
    assert!(at(std::f64::consts::FRAC_PI_2).contains("point = [1, 0, 0]"));
    assert!(at(PI).contains("point = [0, 1, 0]"));
}

// Defaults of equalities stand under <equality>, whatever their kind.
#[test]
fn mjcf_inactive_by_default() {
    let i = read_robot("m.xml", &mjcf("<default><equality active='false'/></default>
        <worldbody><body name='a'><joint/></body><body name='b'><joint/></body></worldbody>
        <equality><weld body1='a' body2='b'/><connect body1='a' body2='b' anchor='0 0 0' active='true'/></equality>"));
    assert_eq!(
        (i.report.size.1, i.report.dropped["inactive equality"].len()),
        (3, 1)
    );
}

pub(crate) fn mjcf(body: &str) -> String {
    format!("<mujoco model='m'>{body}</mujoco>")
}

pub(crate) fn toml_of(name: &str, text: &str) -> String {
    read_robot(name, text).toml().unwrap()
}

// A quarter turn of z to -y, said in every way there is; then a hinge at (0, 0, 1) of the turned body.
#[test]
fn mjcf_orientations() {
    let half = 0.5_f64.sqrt();
    let quat = format!("quat='{half} {half} 0 0'");
    for (compiler, way) in [
        ("", "quat='1 1 0 0'"),
        ("", &quat),
        ("", "axisangle='2 0 0 90'"),
        ("angle='radian'", "axisangle='1 0 0 1.5707963267948966'"),
        ("", "euler='90 0 0'"),
        ("eulerseq='zyx'", "euler='0 0 90'"),
        (
            "eulerseq='XYZ' angle='radian'",
            "euler='1.5707963267948966 0 0'",
        ),
        ("", "xyaxes='1 0 0 0 0 5'"),
        ("", "zaxis='0 -1 0'"),
    ] {
        let t = toml_of(
            "m.xml",
            &mjcf(&format!(
                "<compiler {compiler}/><worldbody><body name='a' pos='0.1 0 0' {way}>
                 <joint pos='0 0 1'/></body></worldbody>"
            )),
        );
        assert!(
            t.contains("point = [0.1, -1, 0]") && t.contains("axis = [0, -1, 0]"),
            "{way}\n{t}"
        );
    }
    // Letters of the frame turn with it: z by a quarter, then the new x by a quarter, against fixed axes.
    for (seq, axis) in [("zxy", "[1, 0, 0]"), ("ZXY", "[0, -1, 0]")] {
        let t = toml_of(
            "m.xml",
            &mjcf(&format!(
                "<compiler eulerseq='{seq}'/><worldbody><body euler='90 90 0'><joint/></body></worldbody>"
            )),
        );
        assert!(t.contains(&format!("axis = {axis}")), "{seq}\n{t}");
    }
}

#[test]
fn mjcf_defaults_and_series() {
    let t = toml_of("m.xml", &mjcf("
        <default><joint axis='1 0 0'/><default class='up'><joint axis='0 0 2'/>
          <default class='slider'><joint type='slide'/></default></default></default>
        <worldbody>
          <body name='a'><joint name='x'/>
            <body name='b' childclass='slider'><joint name='y'/><body name='c'><joint name='z' axis='0 1 0'/>
              <frame pos='0 0 3'><body name='d' pos='1 0 0'><joint name='w' class='up'/></body></frame></body></body></body>
          <body name='e'><joint name='s1' type='slide'/><joint name='s2' type='ball' pos='0 1 0'/></body>
          <body name='f'><freejoint/></body>
        </worldbody>"));
    has_all(
        &t,
        &[
            "id = \"x\"\nlinks = [\"world\", \"a\"]\ntype = \"revolute\"\npoint = [0, 0, 0]\naxis = [1, 0, 0]",
            "id = \"y\"\nlinks = [\"a\", \"b\"]\ntype = \"prismatic\"\npoint = [0, 0, 0]\naxis = [0, 0, 2]",
            "id = \"z\"\nlinks = [\"b\", \"c\"]\ntype = \"prismatic\"\npoint = [0, 0, 0]\naxis = [0, 1, 0]",
            "id = \"w\"\nlinks = [\"c\", \"d\"]\ntype = \"revolute\"\npoint = [1, 0, 3]\naxis = [0, 0, 2]",
            "id = \"s1\"\nlinks = [\"world\", \"e~1\"]\ntype = \"prismatic\"",
            "id = \"s2\"\nlinks = [\"e~1\", \"e\"]\ntype = \"spherical\"\npoint = [0, 1, 0]",
            "type = \"custom\"\nfreedoms = [\"tx\", \"ty\", \"tz\", \"rx\", \"ry\", \"rz\"]",
        ],
    );
}

// A weld of two bodies that hinge on the world in one place: a closed loop of two coaxial hinges, W = 1, σ = 5.
#[test]
fn mjcf_weld_and_actuator() {
    // For a joint of one freedom it is the same in which frame its actuator acts.
    for frame in ["joint", "jointinparent"] {
        let t = mjcf(&format!(
            "<worldbody><body name='a'><joint name='h'/></body><body name='b'><joint/></body></worldbody>
            <equality><weld body1='a' body2='b'/><weld body1='a' body2='b' active='false'/></equality>
            <actuator><motor {frame}='h'/></actuator>"
        ));
        let i = read_robot("m.xml", &t);
        assert_eq!(numeric_figures(&i, 1e-9), [3, 3, 1, 2, 1, 5]);
        let toml = i.toml().unwrap();
        assert!(toml.contains("drive = true") && toml.contains("type = \"fixed\""));
    }
}

#[test]
fn mjcf_includes() {
    let files = |name: &str| -> std::io::Result<Vec<u8>> {
        Ok(match name {
            "defaults.xml" => "<mujocoinclude><default><joint axis='1 0 0'/></default></mujocoinclude>",
            "arm.xml" => "<mujoco><include file='defaults.xml'/><worldbody><body name='a'><joint name='j'/></body></worldbody></mujoco>",
            "loop.xml" => "<mujoco><include file='again.xml'/></mujoco>",
            "again.xml" => "<mujoco><include file='loop.xml'/></mujoco>",
            "bad.xml" => "<mujoco>\n<worldbody><body quat='1 2 3'/></worldbody></mujoco>",
            "many.xml" => "<mujoco><include file='more.xml'/><include file='more.xml'/><include file='more.xml'/></mujoco>",
            _ if name.starts_with("more") => return Ok(include_tree(name)),
            _ => return Err(std::io::Error::other("no such file")),
        }.as_bytes().to_vec())
    };
    fn include_tree(name: &str) -> Vec<u8> {
        let next = format!("more{name}");
        format!("<mujoco><include file='{next}'/><include file='{next}'/></mujoco>").into_bytes()
    }
    let with = |file: &str| {
        let text = mjcf(&format!("<include file='{file}'/>"));
        import("main.xml", text.as_bytes(), &files, &Options::default())
    };
    assert!(
        with("arm.xml")
            .unwrap()
            .toml()
            .unwrap()
            .contains("axis = [1, 0, 0]")
    );
    for (file, words) in [
        ("loop.xml", "the file includes itself"),
        ("main.xml", "the file includes itself"),
        ("none.xml", "no such file"),
        ("../arm.xml", "cannot be read"),
        ("/etc/passwd", "cannot be read"),
        ("bad.xml", "bad.xml:2:24: quat"),
        ("many.xml", "files deep or 1000 in all"),
    ] {
        let e = with(file).unwrap_err().to_string();
        assert!(e.contains(words), "{file}: {e}");
    }
}

#[test]
fn mjcf_errors() {
    let one = |body: &str| {
        mjcf(&format!(
            "<worldbody><body name='a'>{body}</body></worldbody>"
        ))
    };
    for [body, words] in read_cases::<2>(
        r#"
        <joint type='screw'/> | hinge, slide, ball, free
        <joint axis='0 0 0'/> | axis
        <joint class='x'/> | default class "x"
        <joint/><body name='a'/> | is defined twice
        <joint name='j'/><body><joint name='j'/></body> | joint "j" is defined twice
        <composite/> | save the compiled model
        <joint/><body quat='1 0 0 0' euler='0 0 0'/> | two orientations
        <joint/><body quat='0 0 0 0'/> | not zero
        "#,
    ) {
        has(&message_of("m.xml", one(body)), words);
    }
    for [text, words] in read_cases::<2>(
        r#"
        <worldbody><joint/></worldbody> | the world cannot move
        <compiler angle='grad'/> | radian, degree
        <compiler eulerseq='xyw'/> | eulerseq
        <compiler coordinate='global'/> | global coordinates
        <default><default/></default> | no attribute class
        <equality><connect body1='x' anchor='0 0 0'/></equality> | body "x"
        <equality><connect body1='world' anchor='0 0 0'/></equality> | to itself
        <equality><connect site1='x' site2='y'/></equality> | site "x"
        <equality><joint joint1='x'/></equality> | joint "x"
        | nothing can move
        "#,
    ) {
        has(&message_of("m.xml", mjcf(text)), words);
    }
}

// Includes on disk: from the file's folder only, whatever links say.
#[cfg(unix)]
#[test]
fn includes_on_disk() {
    let part = "<mujoco><worldbody><body name='a'><joint/></body></worldbody></mujoco>";
    let out = Folder::with("secret.xml", part);
    out.put("inner/part.xml", part);
    std::os::unix::fs::symlink(out.path("secret.xml"), out.path("inner/link.xml")).unwrap();
    for (file, code) in [
        ("part.xml", 0),
        ("link.xml", 2),
        ("../secret.xml", 2),
        ("missing.xml", 2),
    ] {
        out.put("inner/main.xml", mjcf(&format!("<include file='{file}'/>")));
        let (found, ..) = out.run("export inner/main.xml --to toml");
        assert_eq!(found, Some(code), "{file}");
    }
}

// Two rods of length 1 drawn straight are to reach a place at 1.5: the elbow goes the way its range allows, and a range is
// counted as the joint's values are, from `ref`.
#[test]
fn mjcf_ranges_count_from_the_reference() {
    for (range, sign) in [("130 240", -1.0), ("-40 70", 1.0)] {
        let t = toml_of(
            "m.xml",
            &mjcf(&format!(
                "<worldbody><site name='goal' pos='1.5 0 0'/><body name='a'><joint name='s'/>
                 <body name='b' pos='1 0 0'><joint name='e' ref='100' range='{range}'/><site name='tip' pos='1 0 0'/></body>
                 </body></worldbody><equality><connect site1='tip' site2='goal'/></equality>"
            )),
        );
        let elbow = t
            .split("[[joint]]")
            .find(|x| x.contains("id = \"e\""))
            .unwrap();
        let at = elbow.split("point = [").nth(1).unwrap();
        let at: Vec<f64> = at[..at.find(']').unwrap()]
            .split(", ")
            .map(|x| x.parse().unwrap())
            .collect();
        // Above or below the line between the ends, by √(1 - 0.75²); a turn to the left leaves the elbow below.
        let wanted = [0.75, sign * (1.0 - 0.5625_f64).sqrt()];
        for (found, wanted) in at.iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-6, "{range}: {at:?} {wanted:?}");
        }
    }
}
