//! What robot descriptions are read: kinds of files that were refused, or read wrongly, and bad ones of their kind that still
//! are refused with the place and the reason.

use crate::common::*;
use crate::robots::mjcf::{mjcf, toml_of};
use crate::robots::{folder, message_of, no_files, numeric_figures, read_robot};

/// W and σ.
fn w_sigma(name: &str, text: &str) -> (i64, i64) {
    let [.., w, sigma] = numeric_figures(&read_robot(name, text), 1e-9);
    (w, sigma)
}

// joint_name and joint_type of robot.yaml: balls, universal joints and rigid ones that URDF has no words for.
#[test]
fn types_of_joints_beside_the_description() {
    // The leg's ankle and rods turn about two axes: by hand W = 4, two motors of the leg and two of the foot. As hinges they
    // hold the foot but for its pitch, and most of it twice.
    let leg = |side: &str| {
        let options = crate::robots::with_loops("leg.yaml", side);
        let bytes = fs::read(folder().join("leg.urdf")).unwrap();
        import("leg.urdf", &bytes, &no_files, &options).unwrap()
    };
    let side = fs::read_to_string(folder().join("leg.yaml")).unwrap();
    let typed = leg(&side);
    assert_eq!(numeric_figures(&typed, 1e-9)[4..], [4, 0]);
    let plain = leg(side.split("joint_name").next().unwrap());
    assert_eq!(numeric_figures(&plain, 1e-9)[4..], [3, 2]);
    let urdf = "<robot name='r'><link name='a'/><link name='b'/><link name='c'/>
      <joint name='p' type='revolute'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/></joint>
      <joint name='q' type='revolute'><parent link='b'/><child link='c'/><origin xyz='1 0 0'/></joint></robot>";
    let with = |names: &str, types: &str| {
        let side = format!("closed_loop: []\njoint_name: {names}\njoint_type: {types}\n");
        let options = crate::robots::with_loops("robot.yaml", side);
        import("r.urdf", urdf.as_bytes(), &no_files, &options)
            .map(|i| i.toml().unwrap())
            .map_err(|e| e.to_string())
    };
    let t = with("[p, q]", "[SPHERICAL, UJOINT_ZY]").unwrap();
    has(&t, "type = \"spherical\"");
    // First about z, then about y.
    let universal =
        "type = \"universal\"\npoint = [1, 0, 0]\naxis = [0, 0, 1]\nreference = [0, 1, 0]";
    assert!(t.contains(universal), "{t}");
    assert!(!with("[q]", "[FIXED]").unwrap().contains("id = \"q\""));
    for (names, types, words) in [
        ("[nowhere]", "[SPHERICAL]", "\"nowhere\""),
        ("[p]", "[UJOINT_XX]", "\"UJOINT_XX\""),
        ("[p]", "[]", "joint_name has 1 entries and joint_type 0"),
        ("p", "[]", "joint_name: invalid type"),
    ] {
        let e = with(names, types).unwrap_err();
        assert!(e.contains("robot.yaml") && e.contains(words), "{e}");
    }
}

#[test]
fn sdf_includes_of_models() {
    // Axes of files before 1.5 are in the model's frame: those of this one file alone.
    let arm = "<sdf version='1.4'><model name='arm'><pose>0 0 9 0 0 0</pose><link name='a'><pose>1 0 0 0 0 1.5707963267948966</pose></link>
      <joint name='j' type='revolute'><parent>world</parent><child>a</child><axis><xyz>1 0 0</xyz></axis></joint></model></sdf>";
    let own = "<sdf version='1.7'><model name='s'><include><uri>model://self</uri></include></model></sdf>";
    let two = "<sdf version='1.7'><model name='a'/><model name='b'/></sdf>";
    let dir = Folder::with("models/arm/model.sdf", arm);
    dir.put("models/self/model.sdf", own);
    dir.put("models/two/model.sdf", two);
    dir.put("secret/model.sdf", arm);
    let world = |include: &str| {
        let text = format!(
            "<sdf version='1.7'>\n<world name='w'>\n<include>{include}</include></world></sdf>"
        );
        dir.put("main/world.sdf", text);
        dir.run("export main/world.sdf --to toml --models models")
    };
    let (code, toml, told) =
        world("<uri>model://arm</uri><name>left</name><pose>0 0 2 0 0 0</pose>");
    assert_eq!(code, Some(0), "{told}");
    has(&toml, "point = [1, 0, 2]\naxis = [1, 0, 0]");
    for [include, words] in read_cases::<2>(
        r"
        <uri>model://none</uri> | cannot be read
        <uri>model://../secret</uri> | outside the folder
        <uri>../secret/model.sdf</uri> | outside the folder
        <uri>https://fuel.gazebosim.org/x</uri> | https:// is not read
        <uri>model://self</uri> | includes itself
        <uri>model://two</uri> | not have exactly one <model>
        <uri>model://arm</uri><placement_frame>a</placement_frame> | placed by a frame\nplaces them by a frame
        <name>x</name> | <uri>
",
    ) {
        let (code, _, told) = world(include);
        let found = words.split('\n').any(|w| told.contains(w));
        let place = ["world.sdf:3:1", "model.sdf", "model://self"];
        let placed = place.iter().any(|p| told.contains(p));
        assert!(code == Some(2) && found && placed, "{include}: {told}");
    }
}

// Parts that no joint holds float in the world of an SDF; in a URDF they are a mistake.
#[test]
fn parts_that_nothing_holds() {
    let links = "<link name='a'/><link name='b'/><link name='c'/>";
    let joint = "<joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis></joint>";
    let sdf = format!("<sdf version='1.9'><model name='m'>{links}{joint}</model></sdf>");
    let i = read_robot("m.sdf", &sdf);
    assert_eq!(numeric_figures(&i, 1e-9)[4], 13);
    assert!(
        i.report.moved[0].contains("float freely in the world"),
        "{:?}",
        i.report.moved
    );
    let urdf = format!(
        "<robot name='m'>{links}<joint name='j' type='continuous'><parent link='a'/><child link='b'/></joint></robot>"
    );
    assert!(message_of("m.urdf", &urdf).contains("no joint connects link \"c\""));
}

// A weld whose turns nothing holds is a ball. Three parallel hinges and one across, at the weld: it holds all four, and two
// rows twice; a ball there leaves the plane's one freedom, its own turn about the fourth hinge, and one row twice.
#[test]
fn a_weld_without_torque_is_a_ball() {
    let loops = |weld: &str| {
        mjcf(&format!(
            "<worldbody><body name='a'><joint axis='0 0 1'/></body><body name='b' pos='1 0 0'><joint axis='0 0 1'/>
             <body name='c' pos='0 1 0'><joint axis='0 0 1'/><body name='d'><joint axis='1 0 0'/></body></body></body></worldbody>
             <equality><weld body1='a' body2='d' {weld}/></equality>"
        ))
    };
    // A ball closes the planar chain with one freedom of its own left, the turn about x.
    assert_eq!(w_sigma("m.xml", &loops("torquescale='0'")), (2, 1));
    assert_eq!(w_sigma("m.xml", &loops("torquescale='0.1'")), (0, 2));
    let t = toml_of("m.xml", &loops("torquescale='0' anchor='0 2 0'"));
    has(&t, "type = \"spherical\"\npoint = [1, 3, 0]");
}

#[test]
fn joints_in_frames_and_copies() {
    // The frame turns z to -y and shifts by (0, 0, 1).
    let t = toml_of(
        "m.xml",
        &mjcf(
            "<worldbody><body name='a'><frame pos='0 0 1' euler='90 0 0'><joint name='j' pos='0 0 2'/></frame></body></worldbody>",
        ),
    );
    has(&t, "point = [0, -2, 1]\naxis = [0, -1, 0]");
    let e = message_of(
        "m.xml",
        mjcf("<worldbody><frame><joint/></frame></worldbody>"),
    );
    has(&e, "the world cannot move");
    // MuJoCo makes the copies when it compiles the model.
    let copies = "<worldbody>\n<replicate count='3'><body/></replicate></worldbody>";
    let e = message_of("m.xml", mjcf(copies));
    has_all(&e, &["m.xml:2:", "save the compiled model"]);
}

// An equality of one joint holds it at a constant: it is rigid there.
#[test]
fn joints_held_at_a_constant() {
    let text = |equality: &str| {
        mjcf(&format!(
            "<worldbody><body name='a'><joint name='j'/><body name='b' pos='1 0 0'><joint name='k'/></body></body></worldbody><equality>{equality}</equality>"
        ))
    };
    let i = read_robot(
        "m.xml",
        &text("<joint joint1='j' polycoef='1.5707963267948966'/>"),
    );
    assert_eq!(
        (numeric_figures(&i, 1e-9)[4], i.report.coupling_rows),
        (1, 0)
    );
    has(&i.toml().unwrap(), "point = [0, 1, 0]");
}

// Numbers beyond all that are read are no limits; others are still wrong.
#[test]
fn limits_without_end() {
    let urdf = |upper: &str| {
        format!("<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='revolute'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/>
          <limit lower='-1e16' upper='{upper}' effort='1' velocity='1'/></joint></robot>")
    };
    assert_eq!(w_sigma("r.urdf", &urdf("1e+16")), (1, 0));
    assert_eq!(w_sigma("r.urdf", &urdf("inf")), (1, 0));
    assert!(message_of("r.urdf", urdf("far")).contains("upper"));
}

// A root of the name world is the ground: a robot that floats is one that it does not hold. In SDF a link of the name is the
// world itself.
#[test]
fn links_named_world() {
    let urdf = "<robot name='r'><link name='world'/><link name='b'/><joint name='j' type='continuous'><parent link='world'/><child link='b'/></joint></robot>";
    let floating = default_with(|o: &mut Options| o.floating = true);
    let i = import("r.urdf", urdf.as_bytes(), &no_files, &floating).unwrap();
    assert_eq!(numeric_figures(&i, 1e-9)[4], 1);
    let sdf = |pose: &str| {
        format!(
            "<sdf version='1.7'><model name='m'><link name='world'>{pose}</link><link name='b'/><joint name='j' type='revolute'><parent>world</parent><child>b</child><axis/></joint></model></sdf>"
        )
    };
    assert_eq!(w_sigma("m.sdf", &sdf("")), (1, 0));
    assert!(message_of("m.sdf", sdf("<pose>1 0 0 0 0 0</pose>")).contains("not in its place"));
}

// MJCF includes lead out of the file's folder only into a folder that is named.
#[test]
fn includes_within_a_named_root() {
    let part = "<mujoco><worldbody><body name='a'><joint/></body></worldbody></mujoco>";
    let dir = Folder::with("root/part.xml", part);
    dir.put("secret.xml", part);
    dir.put("root/arm/main.xml", mjcf("<include file='../part.xml'/>"));
    dir.put(
        "root/arm/bad.xml",
        mjcf("<include file='../../secret.xml'/>"),
    );
    for (line, code) in [
        ("main.xml --models root", 0),
        ("main.xml", 2),
        ("bad.xml --models root", 2),
    ] {
        let (found, ..) = dir.run(&format!("export --to toml root/arm/{line}"));
        assert_eq!(found, Some(code), "{line}");
    }
}

// What a user means by the outputs: end effectors by name, ends of chains that have a shape, a base that floats; not each rod.
#[test]
fn outputs_are_what_users_mean() {
    let outputs = |body: &str| {
        read_robot("m.xml", &mjcf(&format!("<worldbody>{body}</worldbody>")))
            .report
            .outputs
            .0
    };
    // A leg as of a walking robot: its rod is as far from the base as its foot.
    let leg = "<body name='base'><freejoint/><body name='shin'><joint/><body name='left-foot'><joint axis='0 1 0'/></body>
      <body name='crank'><joint axis='0 1 0'/><body name='rod'><joint axis='1 0 0'/></body></body></body></body>";
    assert_eq!(outputs(leg), ["base", "left-foot"]);
    let shapes = "<body name='a'><joint/><body name='b'><joint axis='0 1 0'/><geom size='1'/></body><body name='c'><joint axis='1 0 0'/></body></body>";
    assert_eq!(outputs(shapes), ["b"]);
    assert_eq!(outputs(&shapes.replace("<geom size='1'/>", "")), ["b", "c"]);
}

// Joints in series are what they are, and nothing approximate; -q leaves out all but errors.
#[test]
fn nothing_is_said_that_need_not_be() {
    let i = read_robot(
        "m.xml",
        &mjcf("<worldbody><body name='a'><joint/><joint type='slide'/></body></worldbody>"),
    );
    assert_eq!(
        (i.report.approximated.len(), i.report.list_doubts().as_str()),
        (0, "")
    );
    // A loop that is open as drawn and a coupling that is a polynomial: both are told, and not told.
    let doubtful = mjcf(
        "<worldbody><body name='a'><joint name='j'/><body name='b' pos='0 1 0'><joint name='k'/></body></body>
         <body name='c' pos='2 0 0'><joint name='l' ref='0.2'/></body></worldbody><equality>
         <connect body1='b' body2='c' anchor='2 0.5 0'/><joint joint1='j' joint2='l' polycoef='0.5 -1 0.1 0 0'/></equality>",
    );
    for command in ["analyze", "check", "lint", "search"] {
        let said = |more: &[&str]| run_on(command, "m.xml", &doubtful, more).2;
        assert_eq!(said(&["-q"]), "", "{command}");
    }
    let exported = |more: &[&str]| {
        let words = [&["--to", "toml"][..], more].concat();
        run_on("export", "m.xml", &doubtful, &words).2
    };
    assert_eq!(exported(&["-q"]), "");
    assert!(exported(&[]).contains("is a polynomial of l"));
}

// A four-bar in an oblique plane, written with five decimals: its sites miss each other across the plane, where no joint moves.
// One that is open by more than digits explain is refused.
#[test]
fn loops_that_rounding_leaves_open() {
    let text = |slip: f64| {
        let (u, v) = ([0.48, 0.6, 0.64], [-0.8, 0.6, 0.037_5]);
        let axis = [
            u[1] * v[2] - u[2] * v[1],
            u[2] * v[0] - u[0] * v[2],
            u[0] * v[1] - u[1] * v[0],
        ];
        let at = |x: f64, y: f64| {
            let c = |i: usize| format!("{:.5}", x * u[i] + y * v[i] + slip * axis[i]);
            format!("{} {} {}", c(0), c(1), c(2))
        };
        let plain = |x: f64, y: f64| {
            let c = |i: usize| format!("{:.5}", x * u[i] + y * v[i]);
            format!("{} {} {}", c(0), c(1), c(2))
        };
        let z = axis.map(|a| format!("{a:.5}")).join(" ");
        format!(
            "<mujoco><default><joint axis='{z}'/></default><worldbody>
              <body name='a'><joint/><body name='b' pos='{}'><joint/><site name='s' pos='{}'/></body></body>
              <body name='c' pos='{}'><joint/><site name='t' pos='{}'/></body></worldbody>
              <equality><connect site1='s' site2='t'/></equality></mujoco>",
            plain(0.217, 0.913),
            at(2.113, 0.5371),
            plain(2.031, 0.0),
            plain(0.299, 1.4501),
        )
    };
    let rounded = read_robot("m.xml", &text(3e-5));
    assert_eq!(numeric_figures(&rounded, 1e-3)[4..], [1, 1]);
    let doubts = rounded.report.list_doubts();
    has(&doubts, "1 loop: open by");
    assert!(message_of("m.xml", text(5e-3)).contains("the loops do not close"));
}

/// A universal joint of Drake turns about x of its first link and then about y: after a quarter turn about x that is z.
#[test]
fn a_second_axis_is_carried_by_the_first() {
    let urdf = "<robot name='r' xmlns:drake='http://drake.mit.edu'><link name='a'/><link name='b'/>
      <drake:joint name='j' type='universal'><parent link='a'/><child link='b'/></drake:joint></robot>";
    for (first, wanted) in [
        (0.0, [0.0, 0.0, 1.0]),
        (std::f64::consts::FRAC_PI_2, [0.0, 1.0, 0.0]),
    ] {
        let options =
            default_with(|o: &mut Options| o.pose = vec![("j".to_owned(), vec![first, 0.0])]);
        let i = import("r.urdf", urdf.as_bytes(), &no_files, &options).unwrap();
        let frame = &i.mechanism.joints[0].frame;
        let normal = cross(to_vector(&frame.axis), to_vector(&frame.reference)).map(f64::abs);
        let near = |(n, w): (&f64, f64)| (n - w).abs() < 1e-9;
        assert!(normal.iter().zip(wanted).all(near), "{normal:?}");
    }
}
