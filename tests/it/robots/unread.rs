//! Loops and couplings that stand where a reader does not look first: they are read, or they are reported and counted.

use crate::common::*;
use crate::robots::lint;
use crate::robots::mjcf::mjcf;
use crate::robots::no_files;

/// The exit code of lint, what its JSON has of a file with this text, and what it says otherwise.
fn linted(name: &str, text: &str) -> (Option<i32>, Value, String) {
    let (code, file) = lint::linted(name, text);
    let (_, out, err) = run_on("lint", name, text, "");
    (code, file, out + &err)
}

/// A rectangle of sides of these lengths as a chain of three hinges, its plane turned by `tilt` about x, and `more` elements: the end of
/// its last link, at the first length on its x axis, is at minus the second on that of the base.
fn chain(lengths: [f64; 2], tilt: f64, more: &str) -> String {
    let [a, b] = lengths;
    let hinge = |name: &str, ends: [&str; 2], at: f64, turn: f64| {
        let [parent, child] = ends;
        format!(
            "<joint name='{name}' type='continuous'><parent link='{parent}'/><child link='{child}'/>\
             <origin xyz='{at} 0 0' rpy='0 0 {turn}'/><axis xyz='0 0 1'/></joint>"
        )
    };
    let right = std::f64::consts::FRAC_PI_2;
    format!(
        "<robot name='four-bar'><link name='root'/><link name='base'/><link name='p'/><link name='q'/><link name='r'/>\
         <joint name='held' type='fixed'><parent link='root'/><child link='base'/><origin xyz='0.1 0.2 0.3' rpy='{tilt} 0 0'/></joint>\
         {}{}{}{more}</robot>",
        hinge("j1", ["base", "p"], 0.0, right),
        hinge("j2", ["p", "q"], a, right),
        hinge("j3", ["q", "r"], b, right),
    )
}

const GAZEBO_HINGE: &str = "<gazebo><joint name='shut' type='revolute'><parent>r</parent><child>base</child>\
    <pose>BASE 0 0 0 0 0</pose><axis><xyz>0 0 1</xyz></axis></joint></gazebo>";
const CONSTRAINT: &str = "<constraint name='shut' type='revolute'><parent link='r'/><parent_origin xyz='END 0 0'/>\
    <parent_axis xyz='0 0 1'/><child link='base'/><child_origin xyz='BASE 0 0'/><child_axis xyz='0 0 1'/></constraint>";
const TWICE: &str = "<loop_joint name='shut' type='revolute'><link1 link='r' xyz='END 0 0' rpy='0 0 0'/>\
    <link1 link='base' xyz='BASE 0 0' rpy='0 0 0'/><axis xyz='0 0 1'/></loop_joint>";
const LUG: &str = "<link name='lug'/><joint name='j4' type='continuous'><parent link='r'/><child link='lug'/>\
    <origin xyz='END 0 0'/><axis xyz='0 0 1'/></joint><gazebo><plugin name='gz::sim::systems::DetachableJoint' \
    filename='gz-sim-detachable-joint-system'><parent_link>lug</parent_link><child_model>__model__</child_model>\
    <child_link>base</child_link></plugin></gazebo>";

// A file of loops says what it has that nobody reads, and a list of types that are fewer or more than the loops is an error.
#[test]
fn nothing_of_a_file_of_loops_is_lost() {
    let dir = Folder::with("five_bar.urdf", read_data("robots/five_bar.urdf"));
    let pair = "closed_loop: [[end_left, end_right]]";
    for (name, text, code, word) in [
        (
            "a.toml",
            "[[loop]]\na = 'end_left'\nb = 'end_right'\n[[lop]]\n",
            2,
            "\"lop\"",
        ),
        (
            "b.yaml",
            &format!("{pair}\ntype: [6d, 6d]\n"),
            2,
            "2; write one type for each",
        ),
        (
            "c.yaml",
            &format!("{pair}\ntype: []\n"),
            2,
            "0; write one type for each",
        ),
        (
            "d.yaml",
            &format!("{pair}\ntype: [6d]\nclosed_lop: []\n"),
            1,
            "closed_lop",
        ),
    ] {
        dir.put(name, text);
        let (found, out, told) = dir.run(&format!("lint five_bar.urdf --loops {name}"));
        let told = out + &told;
        assert_eq!(found, Some(code), "{name}: {told}");
        has(&told, word);
    }
    let (code, _, told) = dir.run("export none.urdf --loops b.yaml --to toml");
    assert_eq!(code, Some(2), "{told}");
    lacks(&told, "robot descriptions, and");
}

// A rectangle closes where it is drawn. Each way to say the closing hinge is that of a
// file of loops beside it, for random lengths and tilts.
#[test]
fn each_way_to_close_a_loop_is_read() {
    let cases = std::env::var("OZOLS_FUZZ")
        .ok()
        .and_then(|n| n.parse().ok());
    let seed = fresh_seed();
    for case in 0..cases.unwrap_or(6_u64) {
        let x =
            |k: u64| ((seed.wrapping_mul(7919) + 104_729 * case + 31 * k) % 1000) as f64 / 1000.0;
        let lengths = [0.2 + x(1), 0.2 + x(2)];
        let texts = [("END", lengths[0]), ("BASE", -lengths[1])];
        let side = format!(
            "[[loop]]\na = 'r'\nb = 'base'\ntype = 'revolute'\npoint_a = [{}, 0, 0]\npoint_b = [{}, 0, 0]\n",
            texts[0].1, texts[1].1
        );
        let at = |text: &str| {
            let filled = texts.iter().fold(text.to_owned(), |t, (mark, n)| {
                t.replace(mark, &n.to_string())
            });
            chain(lengths, 3.0 * x(3), &filled)
        };
        let truth = {
            let options = crate::robots::with_loops("side.toml", side.clone());
            let i = import("x.urdf", at("").as_bytes(), &no_files, &options)
                .unwrap_or_else(|e| panic!("seed {seed}: {e}"));
            ozols::analyze(&i.mechanism).unwrap()[0].clone()
        };
        assert_eq!(
            (truth.mobility, truth.redundant),
            (1, 3),
            "seed {seed} case {case}"
        );
        for (name, text) in [
            ("gazebo", GAZEBO_HINGE),
            ("constraint", CONSTRAINT),
            ("twice", TWICE),
            ("detachable", LUG),
        ] {
            let i = crate::robots::read_robot("x.urdf", &at(text));
            let found = &ozols::analyze(&i.mechanism).unwrap()[0];
            assert_eq!(
                (found.mobility, found.redundant),
                (1, 3),
                "{name}, seed {seed} case {case}"
            );
            assert_eq!(i.report.left_out, 0, "{name}: {:?}", i.report);
        }
    }
}

// What couples two of three hinges leaves two motions, whoever says it; said twice, it is one coupling.
#[test]
fn each_way_to_couple_joints_is_read() {
    let plugin = "<gazebo><plugin name='any' filename='libroboticsgroup_gazebo_mimic_joint_plugin.so'><joint>j1</joint>\
        <mimicJoint>j2</mimicJoint><multiplier>-0.5</multiplier></plugin></gazebo>";
    let control = "<ros2_control name='c' type='system'><joint name='j2'><param name='mimic'>j1</param>\
        <param name='multiplier'>-0.5</param></joint></ros2_control>";
    for more in [plugin, control, &format!("{plugin}{control}")] {
        let (code, file, text) = linted("x.urdf", &chain([0.4, 0.3], 0.0, more));
        let found = (&file["mobility"], &file["left_out"], code);
        assert_eq!(found, (&2.into(), &0.into(), Some(0)), "{text}");
    }
}

// What is not known and could hold is counted, in text and JSON, and no file with it is clean; what holds nothing is not.
#[test]
fn what_could_hold_is_reported_and_what_could_not_is_not() {
    let plugin = |file: &str, inner: &str| {
        format!("<gazebo><plugin name='x' filename='{file}'>{inner}</plugin></gazebo>")
    };
    let holds = [
        plugin("libgazebo_ros_closed_loop_plugin.so", "<joint>j1</joint>"),
        plugin("libunheard_of.so", "<a>p</a><b>r</b>"),
        plugin("gz-sim-detachable-joint-system", "<parent_link>r</parent_link><child_model>box</child_model><child_link>body</child_link>"),
        "<constraint name='shut' type='six-bar'><parent link='r'/><child link='base'/></constraint>".to_owned(),
        "<closure link_a='r' link_b='base'/>".to_owned(),
        "<vendor:pair><one joint='j1'/><two joint='j3'/></vendor:pair>".to_owned(),
        "<transmission name='t'><type>x</type><joint name='j1'/><joint name='j2'/><actuator name='m'/></transmission>".to_owned(),
    ];
    for more in &holds {
        let (code, file, text) = linted("x.urdf", &chain([0.4, 0.3], 0.0, more));
        assert_eq!(code, Some(1), "{more}: {text}");
        assert!(file["left_out"].as_u64() > Some(0), "{more}: {text}");
        assert_eq!(file["certainty_kind"], "as-read", "{more}");
        assert!(
            text.contains("omitted") && text.contains("1 assumption"),
            "{more}: {text}"
        );
    }
    let harmless = [
        "<gazebo reference='p'><selfCollide>1</selfCollide><mu1>0.2</mu1><material>Gazebo/Blue</material></gazebo>".to_owned(),
        plugin("libgazebo_ros_joint_state_publisher.so", "<joint_name>j1</joint_name><joint_name>j2</joint_name>"),
        plugin("libgazebo_ros_diff_drive.so", "<left_joint>j1</left_joint><right_joint>j2</right_joint>"),
        plugin("gz_ros2_control-system", "<parameters>c.yaml</parameters>"),
        plugin("libgazebo_ros_camera.so", "<frame_name>r</frame_name>"),
        "<ros2_control name='c' type='system'><joint name='j1'/><joint name='j2'/></ros2_control>".to_owned(),
        "<drake:collision_filter_group name='g'><drake:member link='p'/><drake:member link='q'/></drake:collision_filter_group>".to_owned(),
        "<transmission name='t'><type>d</type><joint name='j1'/><joint name='j2'/><actuator name='m'/><actuator name='n'/></transmission>".to_owned(),
        "<material name='red'><color rgba='1 0 0 1'/></material>".to_owned(),
    ];
    for more in &harmless {
        let (code, file, text) = linted("x.urdf", &chain([0.4, 0.3], 0.0, more));
        let found = (&file["left_out"], &file["certainty_kind"], code);
        assert_eq!(
            found,
            (&0.into(), &"proven".into(), Some(0)),
            "{more}: {text}"
        );
    }
}

// The file of loops may be left out by mistake: that it is there is said, with its rows.
#[test]
fn loops_beside_a_description_are_named() {
    let tip = "<link name='tip'/><joint name='t' type='fixed'><parent link='r'/><child link='tip'/><origin xyz='0.4 0 0'/></joint>";
    let dir = Folder::with("arm.urdf", chain([0.4, 0.3], 0.0, tip));
    let loops = |b: &str, kind: &str| format!("closed_loop: [[tip, {b}]]\ntype: [{kind}]\n");
    dir.put("robot.yaml", loops("nowhere", "6d"));
    dir.succeed("lint arm.urdf");
    dir.put("robot.yaml", loops("base", "3d"));
    let (code, out, _) = dir.run("lint arm.urdf");
    assert_eq!(code, Some(1));
    has(&out, "give robot.yaml as `loops`");
    has(&out, "3 rows");
    // With the file every command that takes a description reads the same.
    let v = dir.json("analyze arm.urdf --loops robot.yaml");
    assert_eq!(v["assumptions"].list().len(), 0);
    let state = &v["states"][0];
    let file = &dir.json("lint arm.urdf --loops robot.yaml")["files"][0];
    assert_eq!(file["mobility"], state["mobility"]);
    assert_eq!(file["redundant"], state["redundant"]);
    for line in [
        "search arm.urdf --top 1",
        "check arm.urdf",
        "draw arm.urdf -o out",
        "export arm.urdf --to toml",
        "report arm.urdf -o out",
        "analyze arm.urdf",
    ] {
        let (_, err) = dir.succeed(&format!("{line} --loops robot.yaml"));
        lacks(&err, "robot.yaml beside");
    }
    let built_in = "analyze four-bar --loops robot.yaml";
    dir.assert_fails(built_in, "--loops is for robot descriptions");
}

// Each with its name and what to do instead; none with a complaint about TOML.
#[test]
fn foreign_formats_are_named() {
    let refused = |commands: &str, name: &str, text: &str, parts: &[&str]| {
        for command in split_words(commands) {
            let (code, _, err) = run_on(command, name, text, "");
            assert_eq!(code, Some(2), "{command} {name}: {err}");
            has_all(&err, parts);
            lacks(&err, "TOML");
        }
    };
    for [name, text, words] in read_cases::<3>(
        "part.STEP | ISO-10303-21;\\nHEADER;\\n | STEP
        part.toml | ISO-10303-21;\\nHEADER;\\n | STEP
        part.igs | x | IGES
        a.SLDASM | \u{1}\u{2} | SolidWorks
        a.CATProduct | V5_CFV2 | CATIA
        a.usda | #usda 1.0 | USD
        a.x_t | **ABC | Parasolid
        robot.yaml | closed_loop: [] | loop closures",
    ) {
        let commands = "analyze lint check search fix";
        refused(commands, name, text, &[words, "not read"]);
    }
    let xacro = "<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'>\n<xacro:arm side='left'/><link name='a'/></robot>";
    let numbers = "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='continuous'><parent link='a'/><child link='b'/><origin xyz='${x} 0 0'/></joint></robot>";
    for (name, text) in [
        ("r.urdf", xacro),
        ("r.urdf.xacro", xacro),
        ("r.urdf", numbers),
    ] {
        refused("analyze lint", name, text, &["xacro FILE"]);
    }
    // Expanded, such a file often still names the macros' namespace.
    let plain = chain([0.4, 0.3], 0.0, "").replace(
        "<robot ",
        "<robot xmlns:xacro='http://www.ros.org/wiki/xacro' ",
    );
    assert_eq!(run_on("lint", "r.urdf", &plain, "").0, Some(0));
}

// An equality of a fixed tendon is a row between joint values: MuJoCo's Jacobian has the row, and W is by as much less.
#[test]
fn equalities_of_fixed_tendons_couple() {
    let finger = |tendons: &str, equalities: &str| {
        mjcf(&format!(
            "<worldbody><body name='palm'><body name='a'><joint name='k1' axis='0 1 0'/><body name='b' pos='0 0 1'>
            <joint name='k2' axis='0 1 0'/><body name='c' pos='0 0 1'><joint name='k3' axis='0 1 0'/></body></body></body></body>
            </worldbody><tendon>{tendons}</tendon><equality>{equalities}</equality>"
        ))
    };
    let of = |name: &str, joints: &[(&str, f64)]| {
        let inner: String = joints
            .iter()
            .map(|(j, c)| format!("<joint joint='{j}' coef='{c}'/>"))
            .collect();
        format!("<fixed name='{name}'>{inner}</fixed>")
    };
    let pair = of("s", &[("k1", 1.0), ("k2", -1.4)]) + &of("t", &[("k2", 1.0), ("k3", -0.75)]);
    let single = of("s", &[("k1", 2.0)]) + &of("t", &[("k3", 0.5)]);
    let three = of("s", &[("k1", 1.0), ("k2", 1.0), ("k3", 1.0)]);
    let both = "<tendon tendon1='s'/><tendon tendon1='t'/>";
    for (tendons, equalities, w, left_out, ratio) in [
        (&pair, both, 1, 0, "ratio = 0.714285714"),
        (
            &single,
            "<tendon tendon1='s' tendon2='t'/>",
            2,
            0,
            "ratio = 4",
        ),
        (
            &single,
            "<tendon tendon1='s' tendon2='t' polycoef='0 3'/>",
            2,
            0,
            "ratio = ",
        ),
        (&single, both, 1, 0, ""),
        (&three, "<tendon tendon1='s'/>", 3, 1, ""),
    ] {
        let text = finger(tendons, equalities);
        let (code, file, told) = linted("x.xml", &text);
        let found = (&file["mobility"], &file["left_out"]);
        assert_eq!(found, (&w.into(), &left_out.into()), "{equalities}: {told}");
        assert_eq!(code, Some(i32::from(left_out > 0)), "{told}");
        let (_, toml, _) = run_on("export", "x.xml", &text, "--to toml");
        assert!(toml.contains(ratio), "{toml}");
    }
    let (code, _, err) = run_on(
        "lint",
        "x.xml",
        &finger(&pair, "<tendon tendon1='nowhere'/>"),
        "",
    );
    assert!(code == Some(2) && err.contains("nowhere"), "{err}");
}

// An inserted joint has an armature larger than any robot's mass: MuJoCo's loops stay closed then, which tests/peers/softness.py measures.
#[test]
fn joints_put_in_have_an_armature() {
    let text = "<mujoco><worldbody><body name='a'><joint name='j1'/><geom type='capsule' size='.05' fromto='0 0 0 0 1 0'/>
        <body name='b' pos='0 1 0'><joint name='j2'/><geom type='box' size='1 .25 .02' pos='1 .25 0' mass='16'/></body></body>
        <body name='c' pos='2 0 0'><joint name='j3'/><geom type='sphere' size='.1' mass='12'/></body></worldbody>
        <equality><connect name='e' body1='b' body2='c' anchor='2 0.5 0'/></equality></mujoco>";
    let (code, out, err) = run_on("fix", "x.xml", text, "--at e");
    assert_eq!(code, Some(0), "{err}");
    has(&out, "armature=\"1000\"");
    has(&out, "<inertial pos=\"2 0.5 0\"");
}
