//! Couplings in what is written and read: the page, mechanism files, robot formats, drawings.

use super::{SLIDE, TURN, coupled, pair};
use crate::common::*;

#[test]
fn the_report_has_a_row_for_each_coupling() {
    let v = run_json("analyze planetary-gear --format json");
    let shares = &v["states"][0]["per_coupling"];
    assert_eq!(shares.list().len(), 6);
    assert_eq!(shares[5]["coupling"], "0-c ~ c-3");
    assert_eq!(shares[5]["redundant"], 1);
    assert_eq!(shares[0]["greatest"], 1);
}

#[test]
fn the_file_comes_back_from_export() {
    let m = read(&pair(
        TURN,
        "type = \"cylindrical\"\naxis = [0, 0, 2]",
        &coupled("a", "b:tz", "\"sqrt(2)/3\""),
    ));
    let again = read(&ozols::robots::formats::write(&m, "toml").unwrap());
    assert_eq!(again.couplings.len(), 1);
    assert_eq!(again.couplings[0].ends, m.couplings[0].ends);
    assert_eq!(
        again.couplings[0].ratio.to_string(),
        m.couplings[0].ratio.to_string()
    );
}

/// Couplings survive as mimic joints, with lengths in metres; those of joints that close loops, or that a tree of mimic
/// joints cannot hold, are comments.
#[test]
fn exported_as_mimic_joints() {
    let m = read(&pair(SLIDE, TURN, &coupled("a", "b", "\"1/20\"")));
    let urdf = formats::write(&m, "urdf").unwrap();
    // 1/20 rad a mm is 50 rad a m.
    has(&urdf, "<mimic joint=\"a\" multiplier=\"50\" offset=\"0\"/>");
    let sdf = formats::write(&m, "sdf").unwrap();
    has(&sdf, "<sdf version=\"1.11\">");
    has(&sdf, "<multiplier>50</multiplier>");
    let gear = built_in("planetary-gear");
    let sdf = formats::write(&gear, "sdf").unwrap();
    assert_eq!(
        (
            sdf.matches("<mimic ").count(),
            sdf.matches("<!-- coupled, ").count()
        ),
        (4, 2),
        "{sdf}"
    );
    assert!(!sdf.contains('\0'));
}

/// b goes with a quarter of a, and b is driven: a goes with four times b. Lengths are in metres on whichever side they are.
#[test]
fn ratios_are_turned_over_where_the_second_joint_leads() {
    let driven = |joint: &str| format!("{joint}\ndrive = true");
    for (first, second, ratio, multiplier) in [
        (TURN, TURN, "\"1/4\"", "4"),
        // 1/20 rad a mm is 20 mm a radian; 12.5 mm a radian are 80 rad a m.
        (SLIDE, TURN, "\"1/20\"", "0.02"),
        (TURN, SLIDE, "12.5", "80"),
        (SLIDE, SLIDE, "\"-2/5\"", "-2.5"),
    ] {
        let m = read(&pair(first, &driven(second), &coupled("a", "b", ratio)));
        let urdf = formats::write(&m, "urdf").unwrap();
        has(
            &urdf,
            &format!("<mimic joint=\"b\" multiplier=\"{multiplier}\""),
        );
        let sdf = formats::write(&m, "sdf").unwrap();
        has(
            &sdf,
            &format!("<mimic joint=\"b\" axis=\"axis\"><multiplier>{multiplier}<"),
        );
    }
    // MuJoCo's equality says the second by the first, whichever is driven.
    for (first, second, ratio, factor) in [
        (SLIDE, TURN, "\"1/20\"", "50"),
        (TURN, SLIDE, "12.5", "0.0125"),
        (TURN, TURN, "\"1/4\"", "0.25"),
    ] {
        let m = read(&pair(first, &driven(second), &coupled("a", "b", ratio)));
        let mjcf = formats::write(&m, "mjcf").unwrap();
        let wanted = format!("joint1=\"b\" joint2=\"a\" polycoef=\"0 {factor} 0 0 0\"");
        assert!(mjcf.contains(&wanted), "{mjcf}");
    }
}

/// Turns of both links about z where the first joint has gone by 0.3.
fn turns(m: &ozols::Mechanism) -> [f64; 2] {
    let pose = Pose::of_file(m, StateId::FREE).unwrap();
    let mut follower = Follower::new(pose, 0, &[]);
    follower.advance_to(0.3, |_| {}).unwrap();
    let last = follower.current_pose();
    ["1", "2"].map(|id| {
        let link = &last.links[m.link_named(id).unwrap()];
        link.sine()[2].atan2(link.cosine())
    })
}

/// A joint whose second link is the frame moves its first the other way: what was geared to go along goes along in every format.
#[test]
fn joints_named_backwards_turn_the_same_way_in_every_format() {
    for (backwards, wanted) in [("\"1\", \"0\"", -2.0), ("\"0\", \"1\"", 2.0)] {
        let text = pair(TURN, TURN, &coupled("a", "b", "2"));
        let text = text.replacen("\"0\", \"1\"", backwards, 1);
        let m = read(&text);
        let ratio = |m: &ozols::Mechanism| {
            let [one, two] = turns(m);
            two / one
        };
        assert!((ratio(&m) - wanted).abs() < 1e-9);
        for to in ["urdf", "sdf", "mjcf"] {
            let text = formats::write(&m, to).unwrap();
            let back = read(
                &crate::robots::read_robot(&format!("x.{to}"), &text)
                    .toml()
                    .unwrap(),
            );
            assert!((ratio(&back) - wanted).abs() < 1e-9, "{to}\n{text}");
        }
    }
}

const MJCF: &str = r#"<mujoco><worldbody>
  <body name="1"><joint name="a" type="hinge" axis="0 0 2"/><geom size="1"/>
    <body name="2" pos="1 0 0"><joint name="b" type="slide" axis="1 0 0"/><geom size="1"/></body></body>
  <body name="3" pos="0 1 0"><joint name="c" type="hinge" axis="0 1 1"/><geom size="1"/></body>
</worldbody><equality>EQUALITY</equality></mujoco>"#;

fn mjcf(equality: &str) -> ozols::robots::Imported {
    let text = MJCF.replace("EQUALITY", equality);
    crate::robots::read_robot("x.xml", &text)
}

/// MuJoCo: joint1 = c0 + c1 joint2 + ...; the linear ones are couplings, the others are left out and said so.
#[test]
fn equalities_of_mujoco() {
    let i = mjcf(
        r#"<joint joint1="b" joint2="a" polycoef="0.1 -0.25"/><joint joint1="c" joint2="a"/>"#,
    );
    let m = read(&i.toml().unwrap());
    let ends = |q: usize| m.couplings[q].ends.map(|e| m.joints[e.joint].id.as_str());
    assert_eq!((ends(0), ends(1)), (["a", "b"], ["a", "c"]));
    assert_eq!([0, 1].map(|q| m.couplings[q].ratio.to_f64()), [-0.25, 1.0]);
    assert_eq!((m.couplings.len(), analysed(&m).mobility), (2, 1));
    // Rates are those of the joints, whatever the length of their axes.
    let rows = ozols::closure::coupling::coupling_coefficients(&m, StateId::FREE);
    assert!(
        rows.iter()
            .zip([0.25, -1.0])
            .all(|(x, y)| (x.to_f64() - y).abs() < 1e-12)
    );
    // A polynomial by its derivative at the pose.
    let i = mjcf(r#"<joint joint1="b" joint2="a" polycoef="0 1 0.5 0 0"/>"#);
    let told = i.report.text("x.xml");
    has(&told, "its rate of 1 at this pose");
    let m = read(&i.toml().unwrap());
    assert_eq!(
        (m.couplings[0].ratio.to_f64(), analysed(&m).mobility),
        (1.0, 2)
    );
    let i = mjcf(r#"<joint joint1="b" joint2="a" polycoef="0 0"/>"#);
    assert_eq!(i.report.coupling_rows, 1);
    has(&i.report.text("x.xml"), "times 0");
    let m = read(&i.toml().unwrap());
    assert_eq!((m.couplings.len(), analysed(&m).mobility), (0, 3));
    // A joint held at a constant moves no more.
    let i = mjcf(r#"<joint joint1="b"/>"#);
    assert_eq!(analysed(&read(&i.toml().unwrap())).mobility, 2);
}

#[test]
fn drawn_as_a_dashed_line() {
    let svg = run_quiet("draw geared-gripper --kind scheme");
    has_all(&svg, &["coupled joints", "Coupled: 0-1 ~ 0-4, ratio -1."]);
}
