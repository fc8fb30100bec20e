//! `ozols fix`: the owner's own file with what it holds twice let go.

use crate::common::*;

/// W and σ that lint finds, of a file in the folder with what else is said of it.
fn figures(dir: &Folder, file: &str) -> (u64, u64) {
    let v = dir.json(&format!("lint {file}"));
    let of = |key: &str| v["files"][0][key].whole();
    assert_eq!(of("redundant"), of("redundant_at_most"), "{file}");
    (of("mobility"), of("redundant"))
}

// What is there stays, byte for byte: lines are put in, and attributes that are named changed.
#[test]
fn fix_keeps_the_file() {
    let dir = Folder::with("in.xml", read_data("robots/gripper.xml"));
    let (_, told) = dir.succeed("fix in.xml -o out.xml");
    has(&told, "before: rank 11 of 13 rows, W = 1, redundant 2");
    has(&told, "after:  rank 13 of 13 rows, W = 1, redundant 0");
    let [old, new] = ["in.xml", "out.xml"].map(|f| dir.text(f));
    let left = new
        .split('\n')
        .filter(|l| !l.contains("ozols fix") && !l.contains("_slide\""));
    assert_eq!(left.collect_vec().join("\n"), old);
    assert_eq!(new.split('\n').count(), old.split('\n').count() + 4);
    assert_eq!(figures(&dir, "out.xml"), (1, 0));
    // At the connects, and as the search has it.
    for more in ["--at connect-1 --at connect-2", "--variant 12"] {
        dir.succeed(&format!("fix in.xml -o out.xml {more}"));
        assert_eq!(figures(&dir, "out.xml"), (1, 0));
    }
    lacks(&new, "_between");
    // A place that does not suffice, and one that there is not.
    dir.assert_fails("fix in.xml --at connect-1", "remove 1 of 2");
    dir.assert_fails("fix in.xml --at nowhere", "--at nowhere");
}

// A four-bar in the plane of x and y, closed by each of MuJoCo's means: 1 redundant row by a connect, 3 by a weld.
fn four_bar(equality: &str, sites: [&str; 2]) -> String {
    format!(
        "<mujoco>\r\n  <default><joint range='-2 2' stiffness='3'/></default>\r\n  <worldbody>\r\n    <body name='a'>\r\n      <joint name='j1'/>\r\n      <body name='b' pos='0 1 0'><joint name='j2'/>{}</body></body>\r\n    <body name='c' pos='2 0 0'><joint name='j3'/><frame pos='0 1.5 0'>{}</frame></body>\r\n    <body name='d' pos='9 0 0'><freejoint/></body>\r\n  </worldbody>\r\n  <equality>{equality}</equality>\r\n  <keyframe><key qpos='0 0 0 9 0 0 1 0 0 0' qvel='1 2 3 4 5 6 7 8 9'/></keyframe>\r\n</mujoco>\r\n",
        sites[0], sites[1]
    )
}

/// A connect that closes the four-bar.
const CONNECT: &str = "<connect name='e' body1='b' body2='c' anchor='2 0.5 0'/>";

#[test]
fn fix_lets_go_at_each_kind_of_equality() {
    let sites = ["<site name='s' pos='2 0.5 0'/>", "<site name='t'/>"];
    for (equality, sites, sigma, zeros) in [
        (CONNECT, ["", ""], 1, "0 0 0 0 9"),
        (
            "<connect name='e' site1='s' site2='t'/>",
            sites,
            1,
            "0 0 0 0 9",
        ),
        (
            "<weld name='e' body1='c' body2='b'/>",
            ["", ""],
            3,
            "0 0 0 0 0 0 9",
        ),
        (
            "<weld name='e' site1='t' site2='s'/>",
            sites,
            3,
            "0 0 0 0 0 0 9",
        ),
    ] {
        let dir = Folder::with("in.xml", four_bar(equality, sites));
        let (w, found) = figures(&dir, "in.xml");
        assert_eq!(found, sigma, "{equality}");
        dir.succeed("fix in.xml --at e -o out.xml");
        assert_eq!(figures(&dir, "out.xml"), (w, 0), "{equality}");
        let new = dir.text("out.xml");
        // Keyframes have the new joints' numbers where MuJoCo looks for them, and classes say nothing of these.
        has(&new, &format!("qpos='{zeros}"));
        has(&new, "limited=\"false\" stiffness=\"0\"");
        assert_eq!(new.matches('\n').count(), new.matches("\r\n").count());
    }
}

// A class may say that joints have limits, and each joint which: MuJoCo wants both of a new one that the class is of.
#[test]
fn classes_that_limit_joints_do_not_limit_new_ones() {
    for class in ["limited='true'", "actuatorfrclimited='true'"] {
        let text = four_bar(CONNECT, ["", ""]).replace("range='-2 2' stiffness='3'", class);
        let (_, new, _) = run_on("fix", "four.xml", &text, "");
        has(&new, &class.replace("'true'", "\"false\""));
    }
}

// Loops of URDF: in the file, or in one beside it that names joints; and the loops of joints of SDF.
#[test]
fn fix_puts_links_in_between() {
    let urdf = "<robot name='four-bar'>
  <link name='base'/><link name='a'/><link name='b'/><link name='c'/>
  <joint name='j1' type='continuous'><parent link='base'/><child link='a'/><axis xyz='0 0 1'/></joint>
  <joint name='j2' type='continuous'><parent link='a'/><child link='b'/><origin xyz='0 1 0'/><axis xyz='0 0 1'/></joint>
  <joint name='j3' type='continuous'><parent link='base'/><child link='c'/><origin xyz='2 0 0' rpy='0 0 1'/><axis xyz='0 0 1'/></joint>
  <loop_joint name='j4' type='revolute'><link1 link='b' xyz='2 0.5 0' rpy='0 0 0'/><link2 link='c' xyz='1.2622064772 0.8104534588 0' rpy='0 0 -1'/><axis xyz='0 0 1'/></loop_joint>
</robot>";
    let dir = Folder::with("four.urdf", urdf);
    assert_eq!(figures(&dir, "four.urdf"), (1, 3));
    for at in ["j2", "j3", "j4"] {
        dir.succeed(&format!("fix four.urdf --at {at} -o out.urdf"));
        assert_eq!(figures(&dir, "out.urdf"), (1, 0), "{at}");
    }
    for (file, more, w) in [
        ("five_bar.urdf", "--loops five_bar.yaml", 3),
        ("four_bar_loop.sdf", "--assemble", 1),
        ("four_bar_weld.sdf", "--assemble", 1),
    ] {
        for name in [file, "five_bar.yaml"] {
            dir.put(name, read_data(&format!("robots/{name}")));
        }
        let out = format!("out.{}", &file[file.len() - 4..].trim_matches('.'));
        dir.succeed(&format!("fix {file} {more} -o {out}"));
        assert_eq!(figures(&dir, &format!("{out} {more}")), (w, 0), "{file}");
    }
}

// SDF 1.10 and later come after 1.9: axes are given in the joint's frame, here a quarter turn from the model's.
#[test]
fn sdf_of_two_digit_versions_has_axes_in_the_joint() {
    let link = |id: &str, at: &str| {
        format!("<link name='{id}'><pose>{at} 1.5707963267948966 0 0</pose></link>")
    };
    let hinge = |id: &str, ends: [&str; 2], pose: &str| {
        let [a, b] = ends;
        format!(
            "<joint name='{id}' type='revolute'>{pose}<parent>{a}</parent><child>{b}</child><axis><xyz>0 0 1</xyz></axis></joint>"
        )
    };
    let parts = [
        link("a", "0 0 0"),
        link("b", "0 0 1"),
        link("c", "2 0 0"),
        hinge("j1", ["world", "a"], ""),
        hinge("j2", ["a", "b"], ""),
        hinge("j3", ["world", "c"], ""),
        hinge("j4", ["b", "c"], "<pose>0 0.5 0 0 0 0</pose>"),
    ]
    .concat();
    let fixed = ["1.9", "1.10", "1.11"].map(|version| {
        let text = format!("<sdf version='{version}'><model name='m'>{parts}</model></sdf>");
        let dir = Folder::with("m.sdf", text);
        assert_eq!(figures(&dir, "m.sdf"), (1, 3), "{version}");
        dir.succeed("fix m.sdf -o out.sdf");
        assert_eq!(figures(&dir, "out.sdf"), (1, 0), "{version}");
        dir.text("out.sdf").replace(version, "1.9")
    });
    assert_eq!(fixed[1], fixed[0]);
    assert_eq!(fixed[2], fixed[0]);
}

// What is included is another file, which is not written.
#[test]
fn fix_refuses_what_it_cannot_write() {
    let text = four_bar(CONNECT, ["", ""]);
    let (head, rest) = text.split_once("<worldbody>").unwrap();
    let (world, tail) = rest.split_once("</worldbody>").unwrap();
    let main = format!("{head}<include file='part.xml'/>{tail}");
    let dir = Folder::with("main.xml", main);
    let part = format!("<mujoco><worldbody>{world}</worldbody></mujoco>");
    dir.put("part.xml", part);
    dir.assert_fails("fix main.xml -o out.xml", "in an included file");
    assert!(!dir.path("out.xml").exists());
}

// A search may let a connect go along the direction that it holds twice, and what it finds is written at the connect.
#[test]
fn searches_offer_releases_where_loops_close() {
    for (equality, name) in [
        (CONNECT, "spherical + slide z"),
        ("<weld name='e' body1='c' body2='b'/>", "slide z + turn "),
    ] {
        let dir = Folder::with("in.xml", four_bar(equality, ["", ""]));
        let forbidden = "--forbid j1 --forbid j2 --forbid j3";
        let (found, _) = dir.succeed(&format!("search in.xml --all --format jsonl {forbidden}"));
        has(found.lines().next().unwrap(), name);
        dir.succeed(&format!("fix in.xml --variant 1 {forbidden} -o out.xml"));
        has(&dir.text("out.xml"), "e_between");
        assert_eq!(figures(&dir, "out.xml").1, 0);
    }
}

// Where nothing is redundant there is nothing to mend: the file is written as it is, whatever variant of the search is named,
// unless a mobility is asked for.
#[test]
fn nothing_redundant_is_nothing_to_mend() {
    let text = "\u{feff}<mujoco><worldbody>\r\n<body name='a'><joint name='j1'/>\t<body name='b' pos='1 0 0'><joint name='j2'/></body></body></worldbody></mujoco>\r\n";
    for more in ["", "--variant 1", "--variant 2"] {
        let dir = Folder::with("arm.xml", text);
        let (_, told) = dir.succeed(&format!("fix arm.xml -o out.xml {more}"));
        has(&told, "nothing is redundant (W = 2");
        assert_eq!(dir.text("out.xml"), text, "{more}");
    }
    let dir = Folder::with("arm.xml", text);
    let asked = "--variant 2 --max-mobility 3 --allow-output-change";
    dir.succeed(&format!("fix arm.xml -o out.xml {asked}"));
    assert_eq!(figures(&dir, "out.xml"), (3, 0));
}

// What lint and search end with is a command that mends, whatever the file is called and however it is read.
#[test]
fn the_next_command_mends() {
    let dir = Folder::with("five bar.urdf", read_data("robots/five_bar.urdf"));
    dir.put("side.yaml", read_data("robots/five_bar.yaml"));
    dir.put("gripper.xml", read_data("robots/gripper.xml"));
    for words in [
        &["lint", "five bar.urdf", "--loops", "side.yaml"][..],
        &["search", "gripper.xml", "--top", "1"],
    ] {
        let (_, out, told) = dir.run(&words.to_vec());
        let next = out
            .lines()
            .find_map(|l| l.trim().strip_prefix("ozols fix "));
        let next = next.unwrap_or_else(|| panic!("{out}{told}")).split('\'');
        // What stands in quotes is one word.
        let next = next.enumerate().flat_map(|(i, part)| match i % 2 {
            0 => split_words(part),
            _ => vec![part],
        });
        let next = ["fix"].into_iter().chain(next).collect_vec();
        has(&dir.succeed(&next).1, "redundant 0");
    }
    // Nothing to mend, nothing to type.
    let fixed = ["lint", "five bar-fixed.urdf", "--loops", "side.yaml"];
    lacks(&dir.run(&fixed).1, "Next:");
}

// One actuator pulls both cranks by a tendon: these stay as they are, unless they are named.
#[test]
fn joints_that_an_actuator_pulls_stay_as_they_are() {
    let pulls = "<tendon><fixed name='split'><joint joint='right_crank_joint' coef='0.5'/>\
        <joint joint='left_crank_joint' coef='0.5'/></fixed></tendon>\
        <actuator><general name='fingers' tendon='split'/></actuator></mujoco>";
    let text = read_data("robots/gripper.xml").replace("</mujoco>", pulls);
    let dir = Folder::with("hand.xml", text);
    let (_, told) = dir.succeed("fix hand.xml -o out.xml");
    lacks(&told, "crank_joint");
    assert_eq!(figures(&dir, "out.xml"), (1, 0));
    lacks(&dir.run("lint hand.xml").1, "let right_crank_joint");
    let named = "--at right_crank_joint --at left_crank_joint";
    let (_, told) = dir.succeed(&format!("fix hand.xml -o out.xml {named}"));
    has(&told, "let left_crank_joint slide");
}
