//! Robots: only what is redundant over the motion is let go; what is so at one pose passes by itself.

use crate::common::*;
use crate::robots::lint::linted;
use crate::robots::mjcf::mjcf;

/// A four-bar of lengths 1, 2, 1.5 and 1.5 with all pins in a line, its second joint of a kind. On a ball it has nothing
/// redundant but there, where the force along the line is held twice; on a hinge the force across its plane besides, wherever
/// it is.
fn in_line(elbow: &str, range: &str) -> String {
    mjcf(&format!(
        "<worldbody>
        <body name='a'><joint name='j1' {range}/><body name='b' pos='1 0 0'><joint name='j2' {elbow}/></body></body>
        <body name='c' pos='1.5 0 0'><joint name='j3'/></body></worldbody>
        <equality><connect name='e' body1='b' body2='c' anchor='2 0 0'/></equality>"
    ))
}

// Once taken for a fault, and the arm "mended" where it was stretched out.
#[test]
fn what_is_redundant_at_one_pose_only_is_a_note() {
    let text = in_line("type='ball'", "");
    let (code, found) = linted("m.xml", &text);
    assert_eq!(code, Some(0), "{found}");
    assert_eq!(found["redundant"], 1);
    assert_eq!(found["redundant_over_motion"], 0);
    assert_eq!(found["findings"][0]["row"], "x");
    assert_eq!(found["findings"][0]["lasts"], false);
    assert_eq!(found["cheapest"], serde_json::json!([]));
    let (code, out, _) = run_on("lint", "m.xml", &text, "");
    assert_eq!(code, Some(0));
    has_all(
        &out,
        &[
            "no redundant constraints over the motion; 1 redundant constraint",
            "elsewhere in the motion 0, by 20 closed poses inside the limits",
            "note: e, row x duplicates",
            "at this pose only",
        ],
    );
    assert!(!out.contains("ozols fix"), "{out}");
    let (code, out, told) = run_on("fix", "m.xml", &text, "");
    assert_eq!((code, out.as_str()), (Some(0), text.as_str()), "{told}");
    has(&told, "at this pose only");
}

#[test]
fn only_what_lasts_is_let_go() {
    let text = in_line("", "");
    let (code, found) = linted("m.xml", &text);
    assert_eq!(code, Some(1));
    assert_eq!(found["redundant"], 2);
    assert_eq!(found["redundant_over_motion"], 1);
    let lasts: Vec<bool> = (found["findings"].list().iter())
        .map(|f| f["lasts"].as_bool().unwrap())
        .collect();
    assert_eq!(lasts, [true, false]);
    let (code, out, told) = run_on("fix", "m.xml", &text, "");
    assert_eq!(code, Some(0), "{told}");
    has(&told, "1 release\n");
    has(&told, "slide along z");
    has(&told, "1 redundant at this pose only");
    let (code, found) = linted("m.xml", &out);
    assert_eq!(code, Some(0), "{found}");
}

// Within narrow limits shorter steps are taken, and a pose outside the limits has none to keep.
#[test]
fn poses_are_inside_the_limits() {
    for range in [
        "range='-2 2' limited='true'",
        "range='40 50' limited='true'",
    ] {
        let (code, found) = linted("m.xml", in_line("type='ball'", range));
        assert_eq!(code, Some(0), "{range}: {found}");
        assert_eq!(found["redundant_over_motion"], 0, "{range}");
        let over = found["over_motion"].word();
        assert!(over.contains("20 closed poses"), "{range}: {over}");
        let outside = range.contains("40");
        assert_eq!(over.contains("inside the limits"), !outside, "{over}");
        let told = found["outside_limits"].list();
        assert_eq!(told.len(), usize::from(outside), "{range}: {told:?}");
    }
}

/// A leg as `in_line` on a ball, in which two connects stand for the last hinge and its foot may slide along it: the distance of
/// the two is held twice in every pose, and the force along the line in this one.
fn leg(n: usize, range: &str) -> [String; 2] {
    let bodies = format!(
        "<body name='a{n}' pos='0 {n} 0'><joint name='h{n}' {range}/>
            <body name='b{n}' pos='1 0 0'><joint name='k{n}' type='ball'/></body></body>
        <body name='c{n}' pos='1.5 {n} 0'><joint name='r{n}'/><joint name='s{n}' type='slide' axis='0 0 1'/></body>"
    );
    let connect = |side: &str, z: f64| {
        format!("<connect name='{side}{n}' body1='b{n}' body2='c{n}' anchor='2 0 {z}'/>")
    };
    [bodies, connect("in", -0.1) + &connect("out", 0.1)]
}

// Two published legs once had 2 in the text and 4 in JSON, and nothing said that they stand outside their limits.
#[test]
fn two_connects_for_a_hinge_ask_for_one_of_their_rows() {
    let legs = [1, 2].map(|n| leg(n, "range='40 50' limited='true'"));
    let [bodies, connects] = [0, 1].map(|i| legs.iter().map(|l| l[i].as_str()).collect::<String>());
    let text = mjcf(&format!(
        "<worldbody>{bodies}</worldbody><equality>{connects}</equality>"
    ));
    let (code, found) = linted("m.xml", &text);
    assert_eq!(code, Some(1), "{found}");
    assert_eq!(found["redundant"], 4, "{found}");
    assert_eq!(found["redundant_over_motion"], 2, "{found}");
    let cheapest: Vec<&str> = (found["cheapest"].list().iter())
        .map(|c| c.word())
        .collect();
    assert_eq!(cheapest.len(), 2, "{cheapest:?}");
    for (n, words) in [1, 2].into_iter().zip(&cheapest) {
        let at = [
            format!("let in{n} slide along z"),
            format!("let out{n} slide along z"),
        ];
        assert!(at.iter().any(|a| words.starts_with(a)), "{words}");
    }
    assert_eq!(found["outside_limits"].list().len(), 2);
    let (_, out, _) = run_on("lint", "m.xml", &text, "");
    has_all(
        &out,
        &[
            "4 redundant constraints",
            "2 of them at this pose only",
            "elsewhere in the motion 2, by 20 closed poses (numeric)",
            "h1 is at 0 rad, outside its limits 0.698 to 0.873",
        ],
    );
}

// An arm of six hinges led by the hand: the mocap body was a part of the frame, and the arm rigid, in line with itself.
#[test]
fn mocap_bodies_are_drives() {
    let arm: String = ["0 0 1", "0 1 0", "0 1 0", "1 0 0", "0 1 0", "1 0 0"]
        .iter()
        .enumerate()
        .map(|(i, axis)| {
            format!(
                "<body name='l{i}' pos='{} 0 0'><joint name='j{i}' axis='{axis}'/>",
                i32::from(i > 0)
            )
        })
        .collect();
    let text = mjcf(&format!(
        "<worldbody>{arm}{}<body name='hand' mocap='true' pos='5 0 0'/></worldbody>
        <equality><weld name='grasp' body1='hand' body2='l5'/></equality>",
        "</body>".repeat(6)
    ));
    let (code, found) = linted("m.xml", &text);
    assert_eq!(code, Some(0), "{found}");
    assert_eq!(found["redundant"], 0);
    assert_eq!(found["mobility"], 6);
    let (_, out, _) = run_on("export", "m.xml", &text, "--to toml");
    has(&out, "drive = true");
}
