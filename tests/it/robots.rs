//! Robot descriptions: real models against the figures of other engines, and what is refused.

use crate::common::*;
pub(crate) mod assemblies;
mod every_pose;
mod exports;
mod fix;
pub(crate) mod ideas;
mod lasting;
pub(crate) mod lint;
mod masses;
pub(crate) mod mjcf;
mod models;
mod placed;
mod readers;
mod sdf;
mod taken;
mod unread;

use ozols::file::write::mechanism_file;
use ozols::redundancy::analysis::Elimination;

pub(crate) fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data/robots")
}

pub(crate) fn no_files(_: &str) -> std::io::Result<Vec<u8>> {
    Err(std::io::Error::other("there is no such file"))
}

pub(crate) fn read_model(path: &str, options: &Options) -> Imported {
    let bytes = fs::read(folder().join(path)).unwrap();
    import(path, &bytes, &no_files, options).unwrap_or_else(|e| panic!("{e}"))
}

/// n, p, k, f, W, σ of the imported mechanism by singular values.
pub(crate) fn numeric_figures(imported: &Imported, tolerance: f64) -> [i64; 6] {
    let m = read(&imported.toml().unwrap());
    // What is written is what was built.
    let entries = |m| mechanism_file(m).json();
    assert_eq!(entries(&m), entries(&imported.mechanism));
    let s: &StateAnalysis = &analyse_states(
        &m,
        &[StateId::FREE],
        Method::Numeric(Elimination::Svd, tolerance),
    )
    .unwrap()[0];
    [
        s.links,
        s.joints,
        s.contours,
        s.freedoms,
        s.mobility,
        s.redundant,
    ]
    .map(|x| i64::try_from(x).unwrap())
}

/// What a text is read as.
pub(crate) fn read_robot(name: &str, text: &str) -> Imported {
    import(name, text.as_bytes(), &no_files, &Options::default())
        .unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// Options with a file of loops.
pub(crate) fn with_loops(name: &str, text: impl Into<Vec<u8>>) -> Options {
    default_with(|o: &mut Options| o.loops = Some((name.to_owned(), text.into())))
}

/// The message of a text that is refused.
pub(crate) fn message_of(name: &str, text: impl AsRef<[u8]>) -> String {
    let e = import(name, text.as_ref(), &no_files, &Options::default()).unwrap_err();
    assert!(!e.render(false).is_empty());
    e.to_string()
}

/// Legs side by side, each a crank that moves a foot by a rod with two balls: W = 3, σ = 0 and one contour each. Names are long.
pub(crate) fn legs(n: usize) -> String {
    let leg = |i: usize| {
        format!(
            "<body name='upper-part-of-leg-{i}' pos='0 {i} 0'><joint name='hip-of-leg-{i}' axis='0 1 0'/>
             <body name='crank-that-moves-leg-{i}' pos='0.1 0 0'><joint name='motor-of-leg-{i}' axis='0 0 1'/>
             <body name='rod-within-leg-{i}' pos='0.5 0.1 0'><joint name='ball-of-leg-{i}' type='ball'/></body></body>
             <body name='lower-part-of-leg-{i}' pos='1.6 0 1'><joint name='knee-of-leg-{i}' axis='0 1 0'/></body></body>"
        )
    };
    let close = |i: usize| {
        format!(
            "<connect name='end-of-rod-of-leg-{i}' body1='rod-within-leg-{i}' body2='lower-part-of-leg-{i}' anchor='0.8 0.5 0.9'/>"
        )
    };
    let (bodies, closed): (String, String) = (0..n).map(|i| (leg(i), close(i))).unzip();
    format!("<mujoco><worldbody>{bodies}</worldbody><equality>{closed}</equality></mujoco>")
}

// The joint's place is composed along the chain: q at (0, 0, 1) turned by a quarter about z.
pub(crate) const ARM: &str = r#"<robot name="arm">
  <link name="base"/><link name="a"/><link name="b"/><link name="tip"/>
  <joint name="p" type="continuous"><parent link="base"/><child link="a"/>
    <origin xyz="0 0 1" rpy="0 0 1.5707963267948966"/><axis xyz="0 0 1"/></joint>
  <joint name="q" type="prismatic"><parent link="a"/><child link="b"/>
    <origin xyz="0.1 0.2 0"/><axis xyz="1 0 0"/></joint>
  <joint name="t" type="fixed"><parent link="b"/><child link="tip"/></joint>
</robot>"#;

#[test]
fn poses_are_composed() {
    let i = read_robot("arm.urdf", ARM);
    assert_eq!(i.mechanism.links.len(), 3); // The tip is fixed to its parent.
    for line in ["point = [-0.2, 0.1, 1]", "axis = [0, 1, 0]"] {
        assert!(
            i.toml().unwrap().contains(line),
            "{line}\n{}",
            i.toml().unwrap()
        );
    }
    let turned = default_with(|o: &mut Options| {
        o.pose = vec![("p".to_owned(), vec![std::f64::consts::FRAC_PI_2])]
    });
    let i = import("arm.urdf", ARM.as_bytes(), &no_files, &turned).unwrap();
    has(&i.toml().unwrap(), "point = [-0.1, -0.2, 1]");
}

// Seen from the tip the chain is passed backwards; the tip's frame is the global one then.
#[test]
fn another_frame() {
    let options = Options {
        frame: Some("tip".to_owned()),
        outputs: vec!["base".to_owned()],
        ..Options::default()
    };
    let i = import("arm.urdf", ARM.as_bytes(), &no_files, &options).unwrap();
    for part in [
        "point = [-0.1, -0.2, 0]\naxis = [0, 0, 1]",
        "point = [0, 0, 0]\naxis = [1, 0, 0]",
        "id = \"base\"\nrole = \"output\"",
    ] {
        assert!(
            i.toml().unwrap().contains(part),
            "{part}\n{}",
            i.toml().unwrap()
        );
    }
    assert_eq!(i.report.outputs, (vec!["base".to_owned()], true));
}

// A floating base is one joint of six freedoms.
#[test]
fn floating() {
    let options = default_with(|o: &mut Options| o.floating = true);
    let i = import("arm.urdf", ARM.as_bytes(), &no_files, &options).unwrap();
    assert_eq!(numeric_figures(&i, 1e-9), [4, 3, 0, 8, 8, 0]);
}

#[test]
fn errors_name_the_element_and_the_line() {
    for [from, to, words] in read_cases::<3>(
        r#"
        <child link="b"/> | <child link="c"/> | arm.urdf:5: & joint "q" & link "c" & base, a, b, tip
        prismatic | sliding | arm.urdf:5: & joint "q" & "sliding" & prismatic, fixed
        xyz="1 0 0" | xyz="0 0 0" | arm.urdf:6: & axis & joint "q"
        0.1 0.2 0 | 0.1 0.2 | arm.urdf:6:18: & xyz & 3 finite numbers
        0.1 0.2 0 | 0.1 nan 0 | arm.urdf:6:18: & 3 finite numbers
        0.1 0.2 0 | 0.1 inf 0 | 3 finite numbers
        0.1 0.2 0 | ${x} 0 0 | xacro FILE
        name="q" type | type | <joint> has no attribute name
        name="q" | name="p" | joint "p" is defined twice
        </robot> | | arm.urdf:8: & <robot> is not closed
        </joint>\n  <joint name="t" | </jnt>\n  <joint name="t" | jnt
        <robot | <robit | arm.urdf:
        <parent link="b"/> | <parent link="tip"/> | connects a link to itself
        <parent link="base"/> | | joint "p" has no <parent
        <link name="tip"/> | <link name="tip"/><link name="loose"/> | link "loose" & floating
        "#,
    ) {
        let text = ARM.replace(from, to);
        assert_ne!(text, ARM, "{from}");
        let e = message_of("arm.urdf", &text);
        has_all(&e, &words.split(" & ").collect_vec());
    }
}

#[test]
fn hostile_xml() {
    let bomb = r#"<?xml version="1.0"?><!DOCTYPE r [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;">]><robot name="&b;"/>"#;
    for name in ["x.urdf", "x.xml", "x.sdf"] {
        let e = message_of(name, bomb);
        has(&e, "declares entities");
        has(&e, &format!("{name}:1:"));
    }
    assert!(message_of("x.urdf", "<robot name=\"&b;\"/>").contains("not well-formed"));
    let deep = "<robot>".to_owned() + &"<a>".repeat(100_000);
    assert!(message_of("x.urdf", &deep).contains("4000 deep"));
    let many = "<robot>".to_owned() + &"<a/>".repeat(600_000) + "</robot>";
    assert!(message_of("x.urdf", &many).contains("500000 elements"));
    let wide =
        "<robot ".to_owned() + &(0..300).map(|i| format!("a{i}='' ")).collect::<String>() + "/>";
    assert!(message_of("x.urdf", &wide).contains("256 attributes"));
    assert!(message_of("x.urdf", "").contains("there is no element"));
    assert!(message_of("x.urdf", "<robot a='1' a='2'/>").contains("twice"));
    has(&message_of("x.urdf", b"\xff<robot/>"), "UTF-8");
}

// The mechanism file takes 2000 links; what is fixed together counts once.
#[test]
fn too_many_links() {
    let chain = |n: usize, kind: &str| {
        let links: String = (0..n).map(|i| format!("<link name='l{i}'/>")).collect();
        let joint = |i: usize| {
            let kind = if i == 0 { "continuous" } else { kind };
            format!(
                "<joint name='j{i}' type='{kind}'><parent link='l{i}'/><child link='l{}'/></joint>",
                i + 1
            )
        };
        format!(
            "<robot name='c'>{links}{}</robot>",
            (0..n - 1).map(joint).collect::<String>()
        )
    };
    assert!(
        message_of("c.urdf", chain(2100, "continuous")).contains("2100 links, more than the 2000")
    );
    assert!(message_of("c.urdf", chain(10_100, "fixed")).contains("more than 10000 links"));
    let i = read_robot("c.urdf", &chain(2100, "fixed"));
    assert_eq!(i.report.size, (2, 1));
}

#[test]
fn the_command() {
    let dir = Folder::with("m.urdf", read_data("robots/mimic_gripper.urdf"));
    let (out, told) = dir.succeed("export m.urdf --to toml -o gripper.toml");
    assert_eq!(out, "");
    has(&told, "output");
    assert_eq!(dir.succeed("export m.urdf --to toml --quiet").1, "");
    dir.succeed("check gripper.toml");
    let json: Value = serde_json::from_str(&dir.succeed("export m.urdf --to json").0).unwrap();
    assert_eq!(json["joint"][0]["type"], "revolute");
    for bad in [
        "--pose finger_joint",
        "--pose x=1",
        "--frame x",
        "--working-link x",
    ] {
        let (code, out, _) = dir.run(&format!("export m.urdf --to toml {bad}"));
        assert_eq!((code, out.as_str()), (Some(2), ""), "{bad}");
    }
}
