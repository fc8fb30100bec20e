//! The command `statics` for spatial mechanisms.

use crate::common::*;
#[test]
fn the_command_gives_six_components_a_joint() {
    let v = run_json("statics gripper-10-loaded --spatial --format json");
    assert_eq!(v["choice"], "minimum-norm");
    assert_eq!(v["self_stresses"].list().len(), 11);
    assert_eq!(v["reactions"].list().len(), 13);
    assert!(v["residual"].real() < 1e-12);
    assert_eq!(v["reactions"][0]["drive"]["freedom"], "tz");
    // Spatial and redundant mechanisms come here by themselves.
    assert!(run_quiet("statics bennett").contains("states no loads"));
    assert!(run_quiet("statics parallelogram-3-rods").contains("self-stress"));
}

#[test]
fn bad_workloads_are_refused_with_line_item_and_remedy() {
    let good = builtin::text("gripper-10-loaded").unwrap();
    for [more, parts] in read_cases::<2>(
        r#"
        [workload.stiffness.default]\nlinear = 0\nangular = 1\n | stiffness 0 & above 0
        [workload.stiffness.bal]\nlinear = 1\nangular = 1\n | unknown joint type "bal" & spherical
        [[workload.misalignment]]\njoint = "9-9"\nangle = 0.1\naxis = "x"\n | unknown joint "9-9"
        [[workload.misalignment]]\njoint = "2-3"\nangle = 0.1\naxis = "w"\n | unknown axis "w" & x, y, z
        [[workload.moment]]\nlink = "x"\nmoment = [0, 0, 1]\n | unknown link "x"
"#,
    ) {
        for part in ["bad.toml:"].into_iter().chain(parts.split(" & ")) {
            let text = format!("{good}\n{more}");
            assert_fails_on("statics", "bad.toml", &text, "", part);
        }
    }
}

/// Loads out of the plane of a linkage are borne in space, not left out: by themselves where no equations are asked for.
#[test]
fn loads_out_of_the_plane_are_not_left_out() {
    let four_bar = builtin::text("four-bar")
        .unwrap()
        .split("[[expected]]")
        .next()
        .unwrap();
    let with = |load: &str| {
        let text = format!("{four_bar}\n{load}\n");
        json_on("statics", "loaded.toml", &text, "")
    };
    let force = |point: &str, force: &str| {
        format!("[[workload.force]]\nlink = \"2\"\npoint = {point}\nforce = {force}")
    };
    for load in [
        force("[50, 40, 0]", "[0, 0, -1000]"),
        force("[50, 40, 20]", "[0, -1000, 0]"),
        "[[workload.moment]]\nlink = \"2\"\nmoment = [1, 0, 0]".to_owned(),
    ] {
        let found = with(&load);
        assert_eq!(found["choice"], "minimum-norm", "{load}");
        let moments = found["reactions"].list().iter();
        let tilting = moments.map(|r| r["moment"][0].real().abs() + r["moment"][1].real().abs());
        assert!(tilting.fold(0.0, f64::max) > 0.1, "{load}");
    }
    // What acts in the plane is solved there.
    let found = with(&force("[50, 40, 0]", "[0, -1000, 0]"));
    assert!(
        found.get("choice").is_none() && found.get("groups").is_some(),
        "{found}"
    );
}
