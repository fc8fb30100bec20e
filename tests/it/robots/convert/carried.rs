//! What links and joints carry, word by word.

use super::{again, numbers, tags, taken, to};
use ozols::robots::convert::{Target, Wanted, convert, figures};

/// A crank, a slider and a wrist with all that the formats have words for.
const LOADED: &str = r#"<mujoco model="loaded">
  <compiler angle="radian" meshdir="parts"/>
  <option timestep="0.001" gravity="0 0 -9"/>
  <asset><mesh name="shell" file="shell.stl" scale="0.001 0.001 0.001"/><material name="red" rgba="1 0 0 1"/></asset>
  <default><geom rgba="0.5 0.5 0.5 1"/><default class="pad"><geom type="box" size="0.1 0.2 0.3" friction="0.7"/></default></default>
  <worldbody>
    <geom name="floor" type="plane" size="2 3 0.1"/>
    <body name="crank" pos="0 0 0.5">
      <joint name="shoulder" axis="0 0 1" range="-1 2" damping="0.3" frictionloss="0.2" armature="0.05" stiffness="4" springref="0.5" actuatorfrcrange="-7 7"/>
      <inertial pos="0.1 0.2 0.3" mass="2" fullinertia="0.5 0.6 0.7 0.01 0.02 0.03"/>
      <geom name="arm" type="capsule" size="0.05" fromto="0 0 0 0 0 1"/>
      <geom name="skin" type="mesh" mesh="shell" material="red" contype="0" conaffinity="0"/>
      <site name="mark" pos="0.1 0 0"/>
      <body name="slider" pos="0 1 0" euler="0 0 0.5">
        <joint name="rail" type="slide" axis="1 0 0"/>
        <geom class="pad" name="shoe" mass="3"/>
        <geom name="egg" type="ellipsoid" size="0.1 0.2 0.3" density="500"/>
        <body name="wrist">
          <joint name="pan" axis="0 0 1"/><joint name="tilt" axis="0 1 0"/>
          <geom name="ball" type="sphere" size="0.1"/>
          <geom name="rod" type="cylinder" size="0.1 0.4" pos="1 0 0" quat="1 1 0 0"/>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator><position name="servo" joint="shoulder" kp="30" gear="2"/><motor name="push" joint="rail" gear="5"/></actuator>
  <sensor><jointpos name="angle" joint="shoulder"/></sensor>
  <keyframe><key name="home" qpos="0 0 0 0"/></keyframe>
</mujoco>"#;

fn kinds(c: &ozols::robots::convert::Converted) -> Vec<&str> {
    c.lost.kinds.keys().map(String::as_str).collect()
}

#[test]
fn everything_stays_in_mjcf() {
    let i = taken("loaded.xml", LOADED);
    let c = to(&i, Target::Mjcf);
    assert_eq!(kinds(&c), ["jointpos of <sensor>", "key of <keyframe>"]);
    let joints = tags(&c.text, "joint");
    let shoulder = joints.iter().find(|j| j["name"] == "shoulder").unwrap();
    for (key, wanted) in [
        ("range", "-1 2"),
        ("damping", "0.3"),
        ("frictionloss", "0.2"),
        ("armature", "0.05"),
        ("stiffness", "4"),
        ("springref", "0.5"),
        ("actuatorfrcrange", "-7 7"),
        ("axis", "0 0 1"),
    ] {
        assert_eq!(shoulder[key], wanted, "{key}");
    }
    for line in [
        r#"<option timestep="0.001" gravity="0 0 -9"/>"#,
        r#"<mesh name="shell" file="parts/shell.stl" scale="0.001 0.001 0.001"/>"#,
        r#"<inertial pos="0.1 0.2 0.3" mass="2" fullinertia="0.5 0.6 0.7 0.01 0.02 0.03"/>"#,
        r#"<geom name="floor" type="plane" size="1 1.5 0.05""#,
        r#"<geom name="arm" type="capsule" size="0.05 0.5" pos="0 0 0.5""#,
        r#"<geom name="skin" type="mesh" mesh="shell" rgba="1 0 0 1" contype="0" conaffinity="0""#,
        r#"<geom name="shoe" type="box" size="0.1 0.2 0.3" rgba="0.5 0.5 0.5 1" friction="0.7"/>"#,
        r#"<geom name="egg" type="ellipsoid" size="0.1 0.2 0.3""#,
        r#"<geom name="ball" type="sphere" size="0.1""#,
        r#"<geom name="rod" type="cylinder" size="0.1 0.4" pos="1 0 0" xyaxes="#,
        r#"<site name="mark" pos="0.1 0 0"/>"#,
        r#"<position joint="shoulder" name="servo" gear="2" kp="30"/>"#,
        r#"<motor joint="rail" name="push" gear="5"/>"#,
    ] {
        let line = line.replace(r#"size="1 1.5 0.05""#, r#"size="2 3 0.05""#);
        assert!(c.text.contains(&line), "{line}\n{}", c.text);
    }
    // Joints in series stay in one body.
    assert_eq!(tags(&c.text, "body").len(), 3, "{}", c.text);
    // What the shapes weigh, by hand: a box of 3 kg, and 500 kg/m³ of an ellipsoid.
    let egg = 500.0 * 4.0 / 3.0 * std::f64::consts::PI * 0.1 * 0.2 * 0.3;
    let slider = c.text.split("name=\"slider\"").nth(1).unwrap();
    let slider = &tags(slider, "inertial")[0];
    let mass: f64 = slider["mass"].parse().unwrap();
    assert!((mass - 3.0 - egg).abs() < 1e-12, "{mass}");
    let x = 3.0 / 12.0 * (0.4f64.powi(2) + 0.6f64.powi(2))
        + egg / 5.0 * (0.2f64.powi(2) + 0.3f64.powi(2));
    assert!((numbers(&slider["diaginertia"])[0] - x).abs() < 1e-12);
}

#[test]
fn a_urdf_has_what_it_has_words_for() {
    let i = taken("loaded.xml", LOADED);
    let c = to(&i, Target::Urdf);
    for (kind, example) in [
        ("armature of a joint", "shoulder"),
        ("spring of a joint", "shoulder"),
        ("ellipsoid", "egg"),
        ("plane", "floor"),
        ("capsule", "arm"),
        ("site or frame", "mark"),
        ("gains and ranges of an actuator", "servo"),
        ("contact settings of a shape", "skin"),
    ] {
        let found = c
            .lost
            .kinds
            .get(kind)
            .unwrap_or_else(|| panic!("{kind}: {:?}", c.lost));
        assert_eq!(found.example.as_deref(), Some(example), "{kind}");
        assert!(found.count > 0 && !found.why.is_empty());
    }
    for line in [
        r#"<limit lower="-1" upper="2" effort="7" velocity="10000000000"/>"#,
        r#"<dynamics damping="0.3" friction="0.2"/>"#,
        r#"<inertial><origin xyz="0.1 0.2 0.3" rpy="0 0 0"/><mass value="2"/><inertia ixx="0.5" ixy="0.01" ixz="0.02" iyy="0.6" iyz="0.03" izz="0.7"/></inertial>"#,
        r#"<visual name="skin"><origin xyz="0 0 0" rpy="0 0 0"/><geometry><mesh filename="parts/shell.stl" scale="0.001 0.001 0.001"/></geometry><material name=""><color rgba="1 0 0 1"/></material></visual>"#,
        r#"<collision name="shoe">"#,
        r#"<box size="0.2 0.4 0.6"/>"#,
        r#"<cylinder radius="0.1" length="0.8"/>"#,
        r#"<hardwareInterface>hardware_interface/PositionJointInterface</hardwareInterface>"#,
        r#"<mechanicalReduction>5</mechanicalReduction>"#,
    ] {
        assert!(c.text.contains(line), "{line}\n{}", c.text);
    }
    assert!(!c.text.contains("<collision name=\"skin\">"));
    // Drake has words for two of these.
    let c = to(&i, Target::Drake);
    for kind in ["ellipsoid", "capsule", "armature of a joint"] {
        assert!(!c.lost.kinds.contains_key(kind), "{kind}: {:?}", c.lost);
    }
    assert!(
        c.text.contains(r#"<drake:rotor_inertia value="0.05"/>"#),
        "{}",
        c.text
    );
    let back = to(&again(&c), Target::Mjcf).text;
    for part in [
        r#"armature="0.05""#,
        r#"type="ellipsoid" size="0.1 0.2 0.3""#,
        r#"type="capsule" size="0.05 0.5""#,
    ] {
        assert!(back.contains(part), "{part}\n{back}");
    }
}

#[test]
fn an_sdf_has_what_it_has_words_for() {
    let i = taken("loaded.xml", LOADED);
    let c = to(&i, Target::Sdf);
    assert_eq!(
        kinds(&c),
        [
            "actuator",
            "armature of a joint",
            "contact settings of a shape",
            "jointpos of <sensor>",
            "key of <keyframe>",
            "option",
        ]
    );
    for line in [
        "<limit><lower>-1</lower><upper>2</upper><effort>7</effort></limit>",
        "<dynamics><damping>0.3</damping><friction>0.2</friction><spring_reference>0.5</spring_reference><spring_stiffness>4</spring_stiffness></dynamics>",
        "<frame name=\"mark\" attached_to=\"crank\">",
        "<ellipsoid><radii>0.1 0.2 0.3</radii></ellipsoid>",
        "<capsule><radius>0.05</radius><length>1</length></capsule>",
        "<plane><normal>0 0 1</normal><size>4 6</size></plane>",
        "<mesh><uri>parts/shell.stl</uri><scale>0.001 0.001 0.001</scale></mesh>",
        "<diffuse>1 0 0 1</diffuse>",
    ] {
        assert!(c.text.contains(line), "{line}\n{}", c.text);
    }
    // And back: nothing of it is lost on the way.
    let back = to(&again(&c), Target::Mjcf);
    assert!(back.lost.kinds.is_empty(), "{:?}", back.lost);
    for part in [
        r#"damping="0.3" frictionloss="0.2" stiffness="4" springref="0.5" actuatorfrcrange="-7 7""#,
        r#"type="ellipsoid" size="0.1 0.2 0.3""#,
        r#"<site name="mark""#,
        r#"file="parts/shell.stl""#,
    ] {
        assert!(back.text.contains(part), "{part}\n{}", back.text);
    }
}

// MuJoCo takes the first size alone of a box between two points, for both sides of it; sites of the world hang on what stands there.
#[test]
fn a_box_between_points_and_a_site_of_the_world() {
    let text = |ground: &str| {
        format!(
            r#"<mujoco><worldbody>{ground}<site name="mark" pos="0 0 1"/><body name="a"><joint name="j"/>
            <geom name="beam" type="box" size="0.2" fromto="0 0 0 0 -2 0"/>
            <geom name="egg" type="ellipsoid" size="0.1 0.3 0.5" fromto="0 0 0 0 0 4"/></body></worldbody></mujoco>"#
        )
    };
    let ground = r#"<geom name="floor" type="plane" size="1 1 1"/>"#;
    let i = taken("m.xml", &text(ground));
    let mjcf = to(&i, Target::Mjcf).text;
    assert!(
        mjcf.contains(r#"name="beam" type="box" size="0.2 0.2 1""#),
        "{mjcf}"
    );
    assert!(
        mjcf.contains(r#"name="egg" type="ellipsoid" size="0.1 0.1 2""#),
        "{mjcf}"
    );
    let mass: f64 = tags(&mjcf, "inertial")[0]["mass"].parse().unwrap();
    let egg = 4.0 / 3.0 * std::f64::consts::PI * 0.1 * 0.1 * 2.0;
    assert!(
        (mass - 1000.0 * (0.4 * 0.4 * 2.0 + egg)).abs() < 1e-9,
        "{mass}"
    );
    let sdf = to(&i, Target::Sdf);
    assert!(
        sdf.text
            .contains(r#"<frame name="mark" attached_to="ground">"#),
        "{}",
        sdf.text
    );
    let alone = to(&taken("m.xml", &text("")), Target::Sdf);
    assert!(!alone.text.contains("mark"), "{}", alone.text);
    assert_eq!(
        alone.lost.kinds["frame of the world"].example.as_deref(),
        Some("mark")
    );
}

/// A four-bar whose sites are apart where its joints are at zero: the rocker has to turn.
const OPEN: &str = r#"<mujoco><compiler angle="radian"/><worldbody>
    <body name="crank"><joint name="a" range="-2 2"/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <body name="rod" pos="0 1 0"><joint name="b"/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/><site name="p" pos="2 0.5 0"/></body></body>
    <body name="rocker" pos="2 0 0"><joint name="c" range="-1 1"/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/><site name="q" pos="0.3 1.5 0"/></body>
  </worldbody><equality><connect name="pin" site1="p" site2="q"/></equality></mujoco>"#;

// The sites stay where they are, the joints at zero, and a keyframe says in which pose they meet; SDF is drawn in that pose.
#[test]
fn loops_that_are_open_at_zero_stay_so() {
    let i = taken("open.xml", OPEN);
    assert!(
        i.report.pose[0].contains("closed to"),
        "{:?}",
        i.report.pose
    );
    let c = to(&i, Target::Mjcf);
    assert!(
        c.text.contains(r#"<site name="p" pos="2 0.5 0"/>"#),
        "{}",
        c.text
    );
    let pose: Vec<f64> = numbers(&tags(&c.text, "key")[0]["qpos"]);
    assert_eq!(pose.len(), 3);
    assert_eq!(c.pose.len(), 3);
    // Where the pin is, by hand: on the rod and on the rocker.
    let turn =
        |[x, y]: [f64; 2], by: f64| [x * by.cos() - y * by.sin(), x * by.sin() + y * by.cos()];
    let end = turn([2.0, 0.5], pose[0] + pose[1]);
    let on = turn([0.0, 1.0], pose[0]);
    let other = turn([0.3, 1.5], pose[2]);
    assert!((on[0] + end[0] - 2.0 - other[0]).abs() < 1e-9);
    assert!((on[1] + end[1] - other[1]).abs() < 1e-9);
    let sdf = to(&i, Target::Sdf);
    assert!(
        sdf.told
            .iter()
            .any(|t| t.contains("3 joints") && t.contains("shifted")),
        "{:?}",
        sdf.told
    );
    let back = again(&sdf);
    assert!(back.report.moved.is_empty(), "{:?}", back.report.moved);
    assert!(
        sdf.text.contains(&format!("<lower>{}", -2.0 - pose[0])),
        "{}",
        sdf.text
    );
}

// Every kind of joint of SDF, in the tree and as what closes a loop.
#[test]
fn joints_of_every_kind_close_loops_in_every_format() {
    for (kind, more) in [
        ("revolute", ""),
        ("prismatic", ""),
        ("screw", "<screw_thread_pitch>0.1</screw_thread_pitch>"),
        ("universal", "<axis2><xyz>0 1 0</xyz></axis2>"),
        ("ball", ""),
        ("fixed", ""),
    ] {
        let axis = match kind {
            "ball" | "fixed" => "",
            _ => "<axis><xyz>0.6 0 0.8</xyz></axis>",
        };
        let mut text = "<sdf version='1.9'><model name='m'>".to_owned();
        let mut from = "world".to_owned();
        // Hinges about axes of no special place, and the joint at the end.
        for n in 0..6 {
            let (x, y) = (f64::from(n) * 0.7 + 0.1, f64::from(n * n % 5) * 0.3);
            text += &format!(
                "<link name='l{n}'><pose>{x} {y} {} 0.1 0.2 0.3</pose></link>",
                0.2 * f64::from(n % 3)
            );
            let d = [f64::from(n % 2), f64::from(n % 3) - 0.5, 1.0];
            text += &format!(
                "<joint name='j{n}' type='revolute'><parent>{from}</parent><child>l{n}</child><axis><xyz>{} {} {}</xyz></axis></joint>",
                d[0], d[1], d[2]
            );
            from = format!("l{n}");
        }
        text += &format!(
            "<joint name='end' type='{kind}'><pose>0.1 0.2 0.3 0 0 0</pose><parent>world</parent><child>l5</child>{axis}{more}</joint></model></sdf>"
        );
        let text = text.replace(
            "<axis><xyz>0.6 0 0.8</xyz></axis><axis2>",
            "<axis><xyz>0 0 1</xyz></axis><axis2>",
        );
        let i = taken("m.sdf", &text);
        let wanted = figures(&i.mechanism).unwrap();
        for (word, target, _) in Target::ALL {
            let c = to(&i, target);
            let (w, sigma) = figures(&again(&c).mechanism).unwrap();
            assert_eq!(
                (w, sigma),
                (wanted.0, wanted.1 + c.repeated),
                "{kind} -> {word}\n{}",
                c.text
            );
            let held = c.repeated > 0;
            assert_eq!(held, word == "drake" && kind != "ball", "{kind} -> {word}");
        }
    }
}

// Couplings: a mimic joint follows one other; MuJoCo's polynomial stays in MJCF, elsewhere its tangent stands for it.
#[test]
fn couplings_come_back() {
    let arm = |equality: &str| {
        let body = |n: usize| {
            format!(
                "<body name='l{n}' pos='0 {n} 0'><joint name='j{n}' axis='0 0 1'/><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/></body>"
            )
        };
        let bodies: String = (0..3).map(body).collect();
        format!(
            "<mujoco><compiler angle='radian'/><worldbody>{bodies}</worldbody><equality>{equality}</equality></mujoco>"
        )
    };
    let plain = "<joint joint1='j1' joint2='j0' polycoef='0.2 -3 0 0 0'/>";
    let i = taken("arm.xml", &arm(plain));
    assert_eq!(figures(&i.mechanism), Some((2, 0)));
    for (word, target, _) in Target::ALL {
        let c = to(&i, target);
        let back = to(&again(&c), Target::Mjcf).text;
        let found = &tags(&back, "joint");
        let found = found.iter().find_map(|j| j.get("polycoef")).unwrap();
        assert_eq!(numbers(found), [0.2, -3.0, 0.0, 0.0, 0.0], "{word}");
    }
    let i = taken(
        "arm.xml",
        &arm("<joint joint1='j1' joint2='j0' polycoef='0 2 1 0 0'/>"),
    );
    assert!(to(&i, Target::Mjcf).text.contains("polycoef=\"0 2 1 0 0\""));
    let c = to(&i, Target::Urdf);
    assert_eq!(c.lost.kinds["polynomial of a coupling"].count, 1);
    assert_eq!(figures(&again(&c).mechanism), Some((2, 0)));
    // The second has a leader already, and so leads itself; a ring of three cannot be said.
    let two = format!("{plain}<joint joint1='j1' joint2='j2'/>");
    let i = taken("arm.xml", &arm(&two));
    let c = to(&i, Target::Sdf);
    assert_eq!(
        (c.lost.coupling_rows, figures(&again(&c).mechanism)),
        (0, Some((1, 0)))
    );
    let ring = format!("{two}<joint joint1='j2' joint2='j0' polycoef='0 5 0 0 0'/>");
    let i = taken("arm.xml", &arm(&ring));
    let c = to(&i, Target::Sdf);
    assert_eq!(
        (c.lost.coupling_rows, c.lost.kinds["coupling"].count),
        (1, 1)
    );
    assert_eq!(to(&i, Target::Mjcf).lost.coupling_rows, 0);
}

// For a joint of one freedom it is the same in which frame its actuator acts.
#[test]
fn an_actuator_in_the_parents_frame_stays_with_its_joint() {
    let text = LOADED.replace(
        "<motor name=\"push\" joint=",
        "<motor name=\"push\" jointinparent=",
    );
    assert_ne!(text, LOADED);
    let c = to(&taken("loaded.xml", &text), Target::Mjcf);
    assert_eq!(c.text, to(&taken("loaded.xml", LOADED), Target::Mjcf).text);
}

#[test]
fn sizes_that_are_no_numbers_are_refused() {
    for size in ["0.1 wide 0.3", "0.1 0.2 0.3 0.4", "1e99"] {
        let text = LOADED.replace(
            "type=\"ellipsoid\" size=\"0.1 0.2 0.3\"",
            &format!("type=\"ellipsoid\" size=\"{size}\""),
        );
        assert_ne!(text, LOADED);
        let i = taken("loaded.xml", &text);
        let e = convert(&i, Target::Sdf, &Wanted::default())
            .unwrap_err()
            .to_string();
        assert!(e.contains("size") && e.contains(size), "{e}");
    }
}
