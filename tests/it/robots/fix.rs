//! `ozols fix`: the owner's own file with what it holds twice let go.

use crate::common::*;
use crate::robots::folder;

pub(crate) fn gripper() -> String {
    folder().join("gripper.xml").display().to_string()
}

/// W and σ that lint finds.
fn figures(file: &str, more: &[&str]) -> (u64, u64) {
    let words = [&["lint", file, "--format", "json"], more].concat();
    let (_, out, complaint) = run_full(&words);
    let v: Value = serde_json::from_str(&out).unwrap_or_else(|_| panic!("{file}: {complaint}"));
    let of = |key: &str| v["files"][0][key].whole();
    assert_eq!(of("redundant"), of("redundant_at_most"), "{file}");
    (of("mobility"), of("redundant"))
}

// What is there stays, byte for byte: lines are put in, and attributes that are named changed.
#[test]
fn fix_keeps_the_file() {
    let dir = tempdir().unwrap();
    let out = dir.path().join("fixed.xml").display().to_string();
    let (_, told) = run_successful(&["fix", &gripper(), "-o", &out]);
    has(&told, "before: rank 11 of 13 rows, W = 1, redundant 2");
    has(&told, "after:  rank 13 of 13 rows, W = 1, redundant 0");
    let (old, new) = (
        fs::read_to_string(gripper()).unwrap(),
        fs::read_to_string(&out).unwrap(),
    );
    let left: Vec<&str> = new
        .split('\n')
        .filter(|l| !l.contains("ozols fix") && !l.contains("_slide\""))
        .collect();
    assert_eq!(left.join("\n"), old);
    assert_eq!(new.split('\n').count(), old.split('\n').count() + 4);
    assert_eq!(figures(&out, &[]), (1, 0));
    // At the connects, and as the search has it.
    for more in [
        &["--at", "connect-1", "--at", "connect-2"][..],
        &["--variant", "12"],
    ] {
        let file = gripper();
        let words = [&["fix", &file, "-o", &out], more].concat();
        run_successful(&words);
        assert_eq!(figures(&out, &[]), (1, 0));
    }
    assert!(!new.contains("_between"));
    // A place that does not suffice, and one that there is not.
    let (code, _, told) = run_full(&["fix", &gripper(), "--at", "connect-1"]);
    assert!(code == Some(2) && told.contains("remove 1 of 2"), "{told}");
    let (code, _, told) = run_full(&["fix", &gripper(), "--at", "nowhere"]);
    assert!(code == Some(2) && told.contains("--at nowhere"), "{told}");
}

// A four-bar in the plane of x and y, closed by each of MuJoCo's means: 1 redundant row by a connect, 3 by a weld.
fn four_bar(equality: &str, sites: [&str; 2]) -> String {
    format!(
        "<mujoco>\r\n  <default><joint range='-2 2' stiffness='3'/></default>\r\n  <worldbody>\r\n    <body name='a'>\r\n      <joint name='j1'/>\r\n      <body name='b' pos='0 1 0'><joint name='j2'/>{}</body></body>\r\n    <body name='c' pos='2 0 0'><joint name='j3'/><frame pos='0 1.5 0'>{}</frame></body>\r\n    <body name='d' pos='9 0 0'><freejoint/></body>\r\n  </worldbody>\r\n  <equality>{equality}</equality>\r\n  <keyframe><key qpos='0 0 0 9 0 0 1 0 0 0' qvel='1 2 3 4 5 6 7 8 9'/></keyframe>\r\n</mujoco>\r\n",
        sites[0], sites[1]
    )
}

#[test]
fn fix_lets_go_at_each_kind_of_equality() {
    let dir = tempdir().unwrap();
    let path = |name: &str| dir.path().join(name).display().to_string();
    let none = ["", ""];
    let sites = ["<site name='s' pos='2 0.5 0'/>", "<site name='t'/>"];
    for (name, text, sigma, zeros) in [
        (
            "connect",
            four_bar(
                "<connect name='e' body1='b' body2='c' anchor='2 0.5 0'/>",
                none,
            ),
            1,
            "0 0 0 0 9",
        ),
        (
            "sites",
            four_bar("<connect name='e' site1='s' site2='t'/>", sites),
            1,
            "0 0 0 0 9",
        ),
        (
            "weld",
            four_bar("<weld name='e' body1='c' body2='b'/>", none),
            3,
            "0 0 0 0 0 0 9",
        ),
        (
            "site-weld",
            four_bar("<weld name='e' site1='t' site2='s'/>", sites),
            3,
            "0 0 0 0 0 0 9",
        ),
    ] {
        let (file, out) = (
            path(&format!("{name}.xml")),
            path(&format!("{name}-fixed.xml")),
        );
        fs::write(&file, &text).unwrap();
        let (w, found) = figures(&file, &[]);
        assert_eq!(found, sigma, "{name}");
        run_successful(&["fix", &file, "--at", "e", "-o", &out]);
        assert_eq!(figures(&out, &[]), (w, 0), "{name}");
        let new = fs::read_to_string(&out).unwrap();
        // Keyframes have the new joints' numbers where MuJoCo looks for them, and classes say nothing of these.
        assert!(new.contains(&format!("qpos='{zeros}")), "{name}: {new}");
        assert!(
            new.contains("limited=\"false\" stiffness=\"0\""),
            "{name}: {new}"
        );
        assert_eq!(new.matches('\n').count(), new.matches("\r\n").count());
    }
}

// A class may say that joints have limits, and each joint which: MuJoCo wants both of a new one that the class is of.
#[test]
fn classes_that_limit_joints_do_not_limit_new_ones() {
    let dir = tempdir().unwrap();
    let path = |name: &str| dir.path().join(name).display().to_string();
    let connect = "<connect name='e' body1='b' body2='c' anchor='2 0.5 0'/>";
    for class in ["limited='true'", "actuatorfrclimited='true'"] {
        let text = four_bar(connect, ["", ""]).replace("range='-2 2' stiffness='3'", class);
        let (file, out) = (path("four.xml"), path("fixed.xml"));
        fs::write(&file, text).unwrap();
        run_successful(&["fix", &file, "-o", &out]);
        let new = fs::read_to_string(&out).unwrap();
        let taken_back = class.replace("'true'", "\"false\"");
        assert!(new.contains(&taken_back), "{new}");
    }
}

// Loops of URDF: in the file, or in one beside it that names joints; and the loops of joints of SDF.
#[test]
fn fix_puts_links_in_between() {
    let dir = tempdir().unwrap();
    let path = |name: &str| dir.path().join(name).display().to_string();
    let urdf = "<robot name='four-bar'>
  <link name='base'/><link name='a'/><link name='b'/><link name='c'/>
  <joint name='j1' type='continuous'><parent link='base'/><child link='a'/><axis xyz='0 0 1'/></joint>
  <joint name='j2' type='continuous'><parent link='a'/><child link='b'/><origin xyz='0 1 0'/><axis xyz='0 0 1'/></joint>
  <joint name='j3' type='continuous'><parent link='base'/><child link='c'/><origin xyz='2 0 0' rpy='0 0 1'/><axis xyz='0 0 1'/></joint>
  <loop_joint name='j4' type='revolute'><link1 link='b' xyz='2 0.5 0' rpy='0 0 0'/><link2 link='c' xyz='1.2622064772 0.8104534588 0' rpy='0 0 -1'/><axis xyz='0 0 1'/></loop_joint>
</robot>";
    let (file, out) = (path("four.urdf"), path("fixed.urdf"));
    fs::write(&file, urdf).unwrap();
    let (w, sigma) = figures(&file, &[]);
    assert_eq!((w, sigma), (1, 3));
    for at in ["j2", "j3", "j4"] {
        run_successful(&["fix", &file, "--at", at, "-o", &out]);
        assert_eq!(figures(&out, &[]), (1, 0), "{at}");
    }
    let (file, side) = (
        folder().join("five_bar.urdf"),
        folder().join("five_bar.yaml"),
    );
    let more = ["--loops", side.to_str().unwrap()];
    let words = [&["fix", file.to_str().unwrap(), "-o", &out], &more[..]].concat();
    run_successful(&words);
    assert_eq!(figures(&out, &more), (3, 0));
    let out = path("fixed.sdf");
    for (file, w) in [("four_bar_loop.sdf", 1), ("four_bar_weld.sdf", 1)] {
        let file = folder().join(file);
        let words = ["fix", file.to_str().unwrap(), "--assemble", "-o", &out];
        run_successful(&words);
        assert_eq!(figures(&out, &["--assemble"]), (w, 0), "{}", file.display());
    }
}

// SDF 1.10 and later come after 1.9: axes are given in the joint's frame, here a quarter turn from the model's.
#[test]
fn sdf_of_two_digit_versions_has_axes_in_the_joint() {
    let dir = tempdir().unwrap();
    let path = |name: &str| dir.path().join(name).display().to_string();
    let link = |id: &str, at: &str| {
        format!("<link name='{id}'><pose>{at} 1.5707963267948966 0 0</pose></link>")
    };
    let hinge = |id: &str, ends: [&str; 2], pose: &str| {
        let [a, b] = ends;
        format!(
            "<joint name='{id}' type='revolute'>{pose}<parent>{a}</parent><child>{b}</child><axis><xyz>0 0 1</xyz></axis></joint>"
        )
    };
    let links = [link("a", "0 0 0"), link("b", "0 0 1"), link("c", "2 0 0")].concat();
    let joints = [
        hinge("j1", ["world", "a"], ""),
        hinge("j2", ["a", "b"], ""),
        hinge("j3", ["world", "c"], ""),
        hinge("j4", ["b", "c"], "<pose>0 0.5 0 0 0 0</pose>"),
    ];
    let fixed = ["1.9", "1.10", "1.11"].map(|version| {
        let text = format!(
            "<sdf version='{version}'><model name='m'>{links}{}</model></sdf>",
            joints.concat()
        );
        let (file, out) = (path("m.sdf"), path("fixed.sdf"));
        fs::write(&file, text).unwrap();
        assert_eq!(figures(&file, &[]), (1, 3), "{version}");
        run_successful(&["fix", &file, "-o", &out]);
        assert_eq!(figures(&out, &[]), (1, 0), "{version}");
        fs::read_to_string(out).unwrap().replace(version, "1.9")
    });
    assert_eq!(fixed[1], fixed[0]);
    assert_eq!(fixed[2], fixed[0]);
}

// What is included is another file, which is not written.
#[test]
fn fix_refuses_what_it_cannot_write() {
    let dir = tempdir().unwrap();
    let text = four_bar(
        "<connect name='e' body1='b' body2='c' anchor='2 0.5 0'/>",
        ["", ""],
    );
    let (head, rest) = text.split_once("<worldbody>").unwrap();
    let (world, tail) = rest.split_once("</worldbody>").unwrap();
    let part = format!("<mujoco><worldbody>{world}</worldbody></mujoco>");
    fs::write(dir.path().join("part.xml"), part).unwrap();
    let main: std::path::PathBuf = dir.path().join("main.xml");
    fs::write(&main, format!("{head}<include file='part.xml'/>{tail}")).unwrap();
    let out = dir.path().join("out.xml");
    let words = ["fix", main.to_str().unwrap(), "-o", out.to_str().unwrap()];
    let (code, _, told) = run_full(&words);
    assert!(
        code == Some(2) && told.contains("in an included file"),
        "{told}"
    );
    assert!(!Path::new(&out).exists());
}

// A search may let a connect go along the direction that it holds twice, and what it finds is written at the connect.
#[test]
fn searches_offer_releases_where_loops_close() {
    let dir = tempdir().unwrap();
    let path = |name: &str| dir.path().join(name).display().to_string();
    for (equality, name) in [
        (
            "<connect name='e' body1='b' body2='c' anchor='2 0.5 0'/>",
            "spherical + slide z",
        ),
        ("<weld name='e' body1='c' body2='b'/>", "slide z + turn "),
    ] {
        let (file, out) = (path("four.xml"), path("fixed.xml"));
        fs::write(&file, four_bar(equality, ["", ""])).unwrap();
        let words = [
            "search", &file, "--all", "--format", "jsonl", "--forbid", "j1", "--forbid", "j2",
            "--forbid", "j3",
        ];
        let (found, _) = run_successful(&words);
        let first = found.lines().next().unwrap();
        assert!(first.contains(name), "{first}");
        let words = [
            "fix",
            &file,
            "--variant",
            "1",
            "--forbid",
            "j1",
            "--forbid",
            "j2",
            "--forbid",
            "j3",
            "-o",
            &out,
        ];
        let (_, told) = run_successful(&words);
        assert!(
            fs::read_to_string(&out).unwrap().contains("e_between"),
            "{told}"
        );
        assert_eq!(figures(&out, &[]).1, 0);
    }
}

// Where nothing is redundant there is nothing to mend: the file is written as it is, whatever variant of the search is named,
// unless a mobility is asked for.
#[test]
fn nothing_redundant_is_nothing_to_mend() {
    let dir = tempdir().unwrap();
    let path = |name: &str| dir.path().join(name).display().to_string();
    let (file, out) = (path("arm.xml"), path("out.xml"));
    let text = "\u{feff}<mujoco><worldbody>\r\n<body name='a'><joint name='j1'/>\t<body name='b' pos='1 0 0'><joint name='j2'/></body></body></worldbody></mujoco>\r\n";
    fs::write(&file, text).unwrap();
    for more in [&[][..], &["--variant", "1"], &["--variant", "2"]] {
        let _ = fs::remove_file(&out);
        let (_, told) = run_successful(&[&["fix", &file, "-o", &out], more].concat());
        has(&told, "nothing is redundant (W = 2");
        assert_eq!(fs::read_to_string(&out).unwrap(), text, "{more:?}");
    }
    let asked = [
        "fix",
        &file,
        "--variant",
        "2",
        "--max-mobility",
        "3",
        "-o",
        &out,
    ];
    run_successful(&[&asked[..], &["--allow-output-change"]].concat());
    assert_eq!(figures(&out, &[]), (3, 0));
}

// What lint and search end with is a command that mends, whatever the file is called and however it is read.
#[test]
fn the_next_command_mends() {
    let dir = tempdir().unwrap();
    let file = dir.path().join("five bar.urdf").display().to_string();
    fs::copy(folder().join("five_bar.urdf"), &file).unwrap();
    let side = folder().join("five_bar.yaml").display().to_string();
    let next = |words: &[&str]| {
        let (_, out, told) = run_full(words);
        let line = out
            .lines()
            .find(|l| l.trim_start().starts_with("ozols fix"));
        line.unwrap_or_else(|| panic!("{out}{told}"))
            .trim()
            .to_owned()
    };
    let loops = next(&["lint", &file, "--loops", &side]);
    let plain = next(&["search", &gripper(), "--top", "1"]);
    let (plain, _) = plain.split_once(" -o ").unwrap();
    let plain = format!("{plain} -o {}", dir.path().join("gripper.xml").display());
    for line in [loops, plain] {
        let words = line.strip_prefix("ozols ").unwrap().split('\'').enumerate();
        // What stands in quotes is one word.
        let words = words.flat_map(|(i, part)| match i % 2 {
            0 => part.split_whitespace().map(str::to_owned).collect(),
            _ => vec![part.to_owned()],
        });
        let words: Vec<String> = words.collect();
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let (_, told) = run_successful(&words);
        has(&told, "redundant 0");
    }
    // Nothing to mend, nothing to type.
    let (_, out, _) = run_full(&[
        "lint",
        &dir.path().join("five bar-fixed.urdf").display().to_string(),
        "--loops",
        &side,
    ]);
    assert!(!out.contains("Next:"), "{out}");
}

// One actuator pulls both cranks by a tendon: these stay as they are, unless they are named.
#[test]
fn joints_that_an_actuator_pulls_stay_as_they_are() {
    let dir = tempdir().unwrap();
    let file = dir.path().join("hand.xml").display().to_string();
    let text = fs::read_to_string(gripper()).unwrap();
    let pulls = "<tendon><fixed name='split'><joint joint='right_crank_joint' coef='0.5'/>\
        <joint joint='left_crank_joint' coef='0.5'/></fixed></tendon>\
        <actuator><general name='fingers' tendon='split'/></actuator></mujoco>";
    fs::write(&file, text.replace("</mujoco>", pulls)).unwrap();
    let out = dir.path().join("out.xml").display().to_string();
    let (code, _, told) = run_full(&["fix", &file, "-o", &out]);
    assert!(code == Some(0) && !told.contains("crank_joint"), "{told}");
    assert_eq!(figures(&out, &[]), (1, 0));
    let (_, found, _) = run_full(&["lint", &file]);
    assert!(!found.contains("let right_crank_joint"), "{found}");
    let named = ["--at", "right_crank_joint", "--at", "left_crank_joint"];
    let (code, _, told) = run_full(&[&["fix", &file, "-o", &out][..], &named].concat());
    assert!(
        code == Some(0) && told.contains("let left_crank_joint slide"),
        "{told}"
    );
}
