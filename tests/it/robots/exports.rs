//! Exports read back as the same mechanism.

use crate::common::*;
mod physical;

use crate::robots::read_robot;
use ozols::redundancy::analysis::Elimination;
use ozols::robots::KINEMATICS;

fn all() -> impl Iterator<Item = Mechanism> {
    builtin::names().into_iter().map(built_in)
}

/// The whole model in words; coordinates as expressions.
fn model(m: &Mechanism) -> String {
    format!("{m:#?}")
}

/// Asserts that the mechanism comes back from each of its own formats as it was, and that a second export is the first.
fn comes_back(m: &Mechanism) {
    let toml = formats::write(m, "toml").unwrap();
    let json = ozols::file::write::mechanism_file(m).json().to_string();
    for (name, text) in [("x.toml", &toml), ("x.json", &json)] {
        let back =
            mechanism_from_str(name, text).unwrap_or_else(|e| panic!("{}: {e}\n{text}", m.name));
        assert_eq!(formats::write(&back, "toml").unwrap(), toml, "{}", m.name);
        let (back, m) = (model(&back), model(m));
        if let Some((i, (a, b))) =
            (back.lines().zip(m.lines()).enumerate()).find(|(_, (a, b))| a != b)
        {
            panic!("line {i}: {a} instead of {b}\n{text}");
        }
        assert_eq!(back.len(), m.len());
    }
}

// Import undoes export: every field of the model, rankings, joint types, grippers and drives among them.
#[test]
fn import_undoes_export() {
    let (mut ranked, mut typed, mut grips, mut drives) = (0, 0, 0, 0);
    for m in all() {
        comes_back(&m);
        ranked += usize::from(m.ranking.is_some());
        typed += usize::from(!m.joint_types.is_empty());
        grips += usize::from(m.loads.grip.is_some());
        drives += usize::from(m.loads.drive.is_some());
    }
    assert!(
        ranked > 0 && grips > 0 && drives > 0,
        "{ranked} {typed} {grips} {drives}"
    );
}

// What no built-in mechanism says: joint types with costs, irregular programmes, a payload, parts by density.
#[test]
fn import_undoes_export_of_rich_workloads() {
    let text = |n: &str| builtin::text(n).unwrap().to_owned();
    let types = format!(
        "{}\n[joint_types.revolute]\ncapacity_force = 96\nclearance = 1e-5\n[joint_types.spherical]\ncost = 7\n\
         [joint_types.universal-y]\ncapacity_moment = 0.3\n",
        text("gripper-10-loaded")
    );
    let grip = |more: &str| {
        format!(
            "{}\n[workload.grip]\nlever_length = 0.1\nprism_angle = \"2*pi/3\"\nmounting_angle = 33.3\ndiameter = 7\n{more}",
            text("four-bar")
        )
    };
    let drive = |more: &str| {
        format!(
            "{}\n[workload.drive]\nswing_angle = \"1.7rad\"\nswing_time = 0.35\nshear_modulus = 8e10\n\
             allowable_stress = 4e8\n{more}",
            text("four-bar")
        )
    };
    let texts = [
        types,
        grip(
            "pivots = \"nominal\"\ndiameters = { from = 3, to = 9, count = 5 }\nface_length = 0.7\nlevers = \"equal\"",
        ),
        grip(
            "pivot_distance = 0.3\nlevers_cross = true\nlever_width = 0.1\nmass = 1.1\nfriction = 0.3\ngravity = \"any\"\nany_acceleration = 3\naccelerations = [[1, 2, 0.1]]\nlevers = \"independent\"\ndrive_arm = 12.7",
        ),
        grip(
            "density = 7850\npart_length = 12.1\nfriction = 0.2\nsafety = 1.5\ncentre_of_mass = [0.1, 0, 0.7]",
        ),
        drive(
            "disc_inertia = 0.1\npayload_mass = 1.3\npayload_radius = 30.1\nsecond_inertia = 0.2\nprogramme = [\"1\", \"wait 0.3\", \"wait 0\", \"2\"]",
        ),
        drive(
            "inertia = 0.3\npayload_radius = 7\nmotion = \"reversing\"\nswings = 5\ndwell = 0.1\nmissing_angle = 1.1\nviscous_damping = 0.01",
        ),
        text("gripper-10")
            + "\n[tolerances]\nfit = \"coarse\"\nangle = \"0.1deg\"\nhand_force = 200\n[[tolerances.joint]]\njoint = \"1-2\"\nposition = 0.02\n",
        drive(
            "inertia = 0.3\nspring_stroke = 10.1\ncam_efficiency = 0.7\nfeed_energy = 0.2\nfeed_from = -3.3\nlatch_capture = 0.7\ndiameters = [5, 3]\ntorsion_length = 300.7\nmax_length = 900",
        ),
    ];
    for text in texts {
        let m = read(&text);
        comes_back(&m);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 64, ..Default::default() })]

    #[test]
    fn import_undoes_export_of_random_mechanisms(text in crate::search::twin::random()) {
        if let Ok(m) = mechanism_from_str("x.toml", &text) {
            comes_back(&m);
        }
    }
}

/// W and σ of the free state by singular values.
fn figures(m: &Mechanism) -> (usize, usize) {
    let s =
        &analyse_states(m, &[StateId::FREE], Method::Numeric(Elimination::Svd, 1e-9)).unwrap()[0];
    (s.mobility, s.redundant)
}

fn back(name: &str, text: &str) -> Mechanism {
    let i = read_robot(name, text);
    read(&i.toml().unwrap())
}

// MJCF, URDF and SDF keep loops: W and σ of the free state survive the way there and back, and masses are written.
#[test]
fn loops_there_and_back() {
    for (to, least) in [("mjcf", 25), ("urdf", 20), ("sdf", 25)] {
        let mut tried = 0;
        for m in all() {
            if matches!(m.mode, Mode::Planar { .. }) {
                continue;
            }
            let text = match formats::write(&m, to) {
                Ok(t) => t,
                Err(e) => {
                    let e = e.to_string();
                    assert!(to == "urdf" && e.contains("instead"), "{}: {e}", m.name);
                    continue;
                }
            };
            // A joint mimics one other: couplings beyond a tree, which are redundant where the mechanism moves, are comments.
            let unsaid = text.matches("<!-- coupled, ").count();
            let (w, sigma) = figures(&m);
            let found = figures(&back(&format!("x.{to}"), &text));
            assert_eq!(found, (w, sigma - unsaid), "{to} {}\n{text}", m.name);
            let masses = m.links.iter().filter(|l| l.mass.is_some()).count();
            assert!(masses == 0 || text.contains("inertial"), "{to} {}", m.name);
            tried += 1;
        }
        assert!(tried > least, "{to} {tried}");
    }
}

// What a format has no words for is named in the file.
#[test]
fn nothing_is_lost_in_silence() {
    let m = all().find(|m| m.name == "gripper-10-loaded").unwrap();
    let out: Vec<&str> = m
        .joint_ids()
        .filter(|&j| !m.joints[j].is_in(StateId::FREE))
        .map(|j| m.joints[j].id.as_str())
        .collect();
    for to in ["mjcf", "urdf", "sdf"] {
        let text = formats::write(&m, to).unwrap();
        has(
            &text,
            &format!("not in the free state): {}", out.join(", ")),
        );
        has_all(&text, &["cannot represent it): ", "search options"]);
    }
}

#[test]
fn graphs() {
    for m in all() {
        let dot = formats::write(&m, "dot").unwrap();
        assert_eq!(dot.matches(" -- ").count(), m.joints.len(), "{dot}");
    }
    let tricky = "name = \"a\\\"b<&>\"\n[[link]]\nid = \"<0>\"\nrole = \"frame\"\n[[link]]\nid = \"\\\"&--\\\\\"\nrole = \"output\"\n[[joint]]\nid = \"]]>-->\"\nlinks = [\"<0>\", \"\\\"&--\\\\\"]\ntype = \"revolute\"\npoint = [0, 0, 0]\naxis = [0, 0, 1]\ndrive = true\n";
    let m = read(tricky);
    let dot = formats::write(&m, "dot").unwrap();
    assert!(dot.starts_with("graph \"a\\\"b<&>\" {"), "{dot}");
    for to in ["urdf", "sdf"] {
        back(&format!("t.{to}"), &formats::write(&m, to).unwrap());
    }
}

/// A description in which every kind of thing stands that a mechanism has no words for.
const RICH: &str = "<mujoco><option timestep='0.001'/><asset><mesh name='m' vertex='0 0 0 1 0 0 0 1 0 0 0 1'/></asset>
  <worldbody><body name='a'><inertial pos='0 0 0' mass='3' diaginertia='1 1 1'/>
    <joint name='j1' range='-90 90' damping='2' armature='0.1'/><geom name='shape' type='mesh' mesh='m'/>
    <body name='b' pos='1 0 0'><joint name='j2' type='slide' axis='1 0 0'/><geom name='end' size='0.1'/></body></body></worldbody>
  <actuator><position name='servo' joint='j1' kp='100'/></actuator><sensor><jointpos joint='j1'/></sensor></mujoco>";

// What is lost on the way from one description to another is named in the file and on standard error, also by way of a
// mechanism file.
#[test]
fn what_is_lost_is_named() {
    let dir = Folder::with("rich.xml", RICH);
    dir.succeed("export rich.xml --to toml -o rich.toml");
    for (to, made_up) in [
        ("urdf", "limits of 1 m"),
        ("sdf", "weigh 1 kg"),
        ("mjcf", "get 1 g"),
        ("toml", ""),
    ] {
        for from in ["rich.xml", "rich.toml"] {
            let line = format!("export {from} --to {to} -o out.{to}");
            let (_, told) = dir.succeed(&line);
            let text = dir.text(&format!("out.{to}"));
            has(&text, "Imported from rich.xml (MJCF)");
            has(&text, KINEMATICS);
            has(&text, made_up);
            has(&told, made_up);
            // Of a mechanism file this is no news.
            let from_robot = from == "rich.xml" && to != "toml";
            assert_eq!(told.contains("Only the kinematics"), from_robot, "{told}");
            assert_eq!(dir.succeed(&format!("{line} -q")).1, "");
        }
    }
}

#[test]
fn the_command() {
    for to in ["toml", "json", "urdf", "mjcf", "sdf", "dot"] {
        assert!(
            run_quiet(&["export", "four-bar", "--to", to, "-q"]).len() > 200,
            "{to}"
        );
    }
    let o = ozols("export nowhere --to dot").output().unwrap();
    assert_eq!(o.status.code(), Some(2));
}
