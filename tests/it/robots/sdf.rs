//! SDF: places, axes, kinds of joints, nested and static models.

use crate::common::*;
use crate::robots::mjcf::toml_of;
use crate::robots::{message_of, no_files, numeric_figures};

fn sdf(body: &str) -> String {
    format!("<sdf version='1.9'><model name='m'>{body}</model></sdf>")
}

#[test]
fn sdf_places_and_axes() {
    let t = toml_of("m.sdf", &sdf("
        <pose degrees='true'>0 0 1 0 0 90</pose>
        <link name='a'><pose>1 0 0 0 0 0</pose></link>
        <frame name='f' attached_to='a'><pose>0 0 2 0 0 0</pose></frame>
        <link name='b'><pose relative_to='f'>0 1 0 0 0 0</pose></link>
        <link name='c'><pose relative_to='b' rotation_format='quat_xyzw'>0 0 0 0 0 0.7071067811865476 0.7071067811865476</pose></link>
        <joint name='p' type='revolute'><parent>world</parent><child>a</child>
          <axis><xyz expressed_in='world'>1 0 0</xyz></axis></joint>
        <joint name='q' type='prismatic'><parent>f</parent><child>b</child><pose>0 0 1 0 0 0</pose>
          <axis><xyz>1 0 0</xyz></axis></joint>
        <joint name='r' type='universal'><parent>b</parent><child>c</child>
          <axis><xyz>1 0 0</xyz></axis><axis2><xyz expressed_in='__model__'>0 0 1</xyz></axis2></joint>"));
    has_all(
        &t,
        &[
            "id = \"p\"\nlinks = [\"world\", \"a\"]\ntype = \"revolute\"\npoint = [0, 1, 1]\naxis = [1, 0, 0]",
            "id = \"q\"\nlinks = [\"a\", \"b\"]\ntype = \"prismatic\"\npoint = [-1, 1, 4]\naxis = [0, 1, 0]",
            "id = \"r\"\nlinks = [\"b\", \"c\"]\ntype = \"universal\"\npoint = [-1, 1, 3]\naxis = [-1, 0, 0]\nreference = [0, 0, 1]",
        ],
    );
}

#[test]
fn sdf_kinds() {
    let with = |kind: &str, more: &str| {
        let text = sdf(&format!(
            "<link name='a'/><link name='b'/><joint name='j' type='{kind}'><parent>a</parent><child>b</child>{more}</joint>"
        ));
        let options = default_with(|o: &mut Options| o.frame = Some("a".to_owned()));
        import("m.sdf", text.as_bytes(), &no_files, &options)
    };
    let axis = "<axis><xyz>0 0 1</xyz></axis>";
    let skew = "<axis><xyz>0 0 1</xyz></axis><axis2><xyz>0 1 1</xyz></axis2>";
    for (kind, more, freedoms) in [
        ("revolute", axis, 1),
        ("continuous", axis, 1),
        ("prismatic", axis, 1),
        (
            "screw",
            "<axis><xyz>0 0 1</xyz></axis><screw_thread_pitch>0.01</screw_thread_pitch>",
            1,
        ),
        (
            "screw",
            "<axis><xyz>0 0 1</xyz></axis><thread_pitch>-100</thread_pitch>",
            1,
        ),
        ("revolute2", skew, 2),
        ("ball", "", 3),
        ("floating", "", 6),
    ] {
        let i = with(kind, more).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(numeric_figures(&i, 1e-9)[4], freedoms, "{kind}");
    }
    for (kind, more, words) in [
        ("gearbox", axis, "gearbox_reference_body"),
        ("belt", axis, "revolute, continuous"),
        ("revolute", "", "has no <axis>"),
        ("revolute", "<axis><xyz>0 0 0</xyz></axis>", "direction"),
        (
            "revolute",
            "<axis><xyz expressed_in='x'>0 0 1</xyz></axis>",
            "\"x\"",
        ),
        ("screw", axis, "screw_thread_pitch"),
        ("universal", axis, "has no <axis2>"),
        ("fixed", "", "nothing can move"),
    ] {
        let e = with(kind, more).unwrap_err().to_string();
        assert!(e.contains(words), "{words}: {e}");
    }
    for [body, words] in read_cases::<2>(
        r#"
        <link name='a'><pose relative_to='b'/></link><link name='b'><pose relative_to='a'/></link> | relative to itself
        <link name='a'/><link name='a'/> | twice
        <link name='a'><pose>0 0 0</pose></link> | 6 finite numbers
        <link name='a'><pose relative_to='x'/></link> | "x"
        <include><uri>model://x</uri></include> | as `models`
        <frame name='f' attached_to='g'/><frame name='g' attached_to='f'/><link name='l'/><joint name='j' type='ball'><parent>f</parent><child>l</child></joint> | itself
        <link name='a'/><joint name='j' type='ball'><child>a</child></joint> | <parent>
        <link name='a'/><joint name='j' type='ball'><parent>a</parent><child>b</child></joint> | "b"
"#,
    ) {
        let e = message_of("m.sdf", sdf(body));
        assert!(e.contains(words), "{words}: {e}");
    }
}

// Nested models are scoped; static ones belong to the world.
#[test]
fn sdf_models() {
    let t = toml_of(
        "m.sdf",
        &sdf(
            "<model name='in'><pose>0 0 1 0 0 0</pose><link name='a'/></model>
        <joint name='j' type='ball'><parent>world</parent><child>in::a</child></joint>",
        ),
    );
    has(&t, "links = [\"world\", \"in::a\"]");
    has(&t, "point = [0, 0, 1]");
    let world = "<sdf version='1.9'><world name='w'><light name='sun'/>
        <model name='floor'><static>true</static><link name='l'/></model>
        <model name='arm'><link name='l'/><joint name='j' type='ball'><parent>world</parent><child>l</child></joint></model></world></sdf>";
    let t = toml_of("m.sdf", world);
    has(&t, "links = [\"world\", \"arm::l\"]");
    // The link of the floor is part of the world.
    lacks(&t, "floor::l");
}
