//! What publications say of the mechanisms they show, against what is so.

use crate::common::*;
use std::f64::consts::FRAC_PI_4;

fn claims(line: &str) -> Vec<Value> {
    run_json(&format!("{line} --format json"))["claims"]
        .list()
        .clone()
}

/// The claim with these words in it.
fn claim<'c>(claims: &'c [Value], says: &str) -> &'c Value {
    let with = |c: &&Value| c["claim"].word().contains(says);
    let those: Vec<&Value> = claims.iter().filter(with).collect();
    assert_eq!(those.len(), 1, "{says}: {claims:?}");
    those[0]
}

/// A state of a mechanism as analysed.
fn state(name: &str, at: usize) -> Value {
    run_json(&["analyze", name, "--format", "json"])["states"][at].clone()
}

#[test]
fn each_confirmed_figure_of_the_gripper_has_a_row() {
    let claims = claims("analyze gripper-10");
    let [free, clamped] = [0, 1].map(|i| state("gripper-10", i));
    let [redesign, pad] =
        [("gripper-10-redesign", 0), ("gripper-10-unloaded", 1)].map(|(n, i)| state(n, i));
    let [outside, with_pad] = [&clamped, &pad].map(|s| &s["external"]);
    for says in [
        format!("n = {} links", free["links"]),
        format!("p = {} joints", free["joints"]),
        format!("k = {} contours", free["contours"]),
        format!("W = {} by the planar formula", free["mobility"]),
        format!("f = {} freedoms", free["freedoms"]),
        format!("σ = {}", free["redundant"]),
        format!("f = {} freedoms", redesign["freedoms"]),
        format!("σ = {}, in 0-1-2-3 and 0-1-6-7", redesign["redundant"]),
        format!("{} external constraints", outside["constraints"]),
        format!("actual mobility {}", outside["actual_mobility"]),
        format!("working mobility {}", outside["working_mobility"]),
        format!("the part loses {} mobilities", outside["lost_mobility"]),
        format!("{} external redundant constraints", outside["redundant"]),
        format!("actual mobility {}", with_pad["actual_mobility"]),
        format!("{} external redundant constraints", with_pad["redundant"]),
    ] {
        let row = claims.iter().find(|c| c["claim"] == says.as_str());
        assert!(row.is_some_and(|r| r["holds"] == true), "{says}: {row:?}");
    }
    assert_eq!(claims.iter().filter(|c| c["holds"] == true).count(), 19);
}

/// The file says how far its jaws, on coordinates of ours, are from the straight line that the paper asks for.
#[test]
fn the_jaws_of_the_gripper_swing() {
    let text = ozols::builtin::text("gripper-10").unwrap();
    let stroke = split_words("statics gripper-10-planar --stroke -0.5:0.5:20 --format json");
    let found = run_json(&stroke);
    let ends = found["positions"].list().iter().map(|p| {
        let all = p["reactions"].list().iter();
        let end = all.clone().find(|r| r["joint"] == "2-4").unwrap();
        [0, 1].map(|i| 1e3 * end["point"][i].real())
    });
    let ends: Vec<[f64; 2]> = ends.collect();
    let (first, last) = (ends[0], ends[ends.len() - 1]);
    let along = [0, 1].map(|i| last[i] - first[i]);
    let way = along[0].hypot(along[1]);
    let off = ends.iter().map(|p| {
        let to = [0, 1].map(|i| p[i] - first[i]);
        (along[0] * to[1] - along[1] * to[0]).abs() / way
    });
    let off = off.fold(0.0, f64::max);
    let said = format!("leaves its chord by {off:.1} mm on a way of {way:.1} mm");
    let head = text.lines().take_while(|l| l.starts_with('#'));
    let head: Vec<&str> = head.map(|l| l.trim_start_matches("# ")).collect();
    assert!(head.join(" ").contains(&said), "{said}: {head:?}");
    assert!(head.join(" ").contains("those here are ours"), "{head:?}");
}

/// `[Bychkov, Dvornikov & Zhukov 2018]`: what the program confirms of the method, and the slips of the paper.
#[test]
fn slips_of_the_shears_are_told_with_what_is_right() {
    let claims = claims("statics parallel-shears");
    assert_eq!(claims.iter().filter(|c| c["holds"] == true).count(), 5);
    let found = run_json("statics parallel-shears --format json");
    let positions = found["positions"].list();
    let size = |v: &Value| v[0].real().hypot(v[1].real());
    let at = |joint: &str, p: &Value| {
        let all = p["reactions"].list().iter();
        size(&all.clone().find(|r| r["joint"] == joint).unwrap()["force"])
    };
    let cut = positions
        .iter()
        .find(|p| (p["drive"].real() - 165f64.to_radians()).abs() < 1e-9);
    let kilonewtons = |joint: &str| at(joint, cut.unwrap()) / 1e3;
    let swapped = claim(&claims, "R64 and R74");
    for number in [
        format!("{:.2} and", kilonewtons("4-6")),
        format!("{:.2} kN", kilonewtons("4-7")),
    ] {
        assert!(swapped["evidence"].word().contains(&number), "{number}");
    }
    let twice = claim(&claims, "R0/10 stands twice");
    assert!(
        twice["evidence"]
            .word()
            .contains(&format!("{:.3} kN", kilonewtons("0-10")))
    );
    assert!(twice["scan"].is_string());
    // The weights of the rods alone have a moment about D.
    let bare = with_weights_of_rods_alone(ozols::builtin::text("parallel-shears").unwrap());
    let (_folder, file) = write_temporary("rods.toml", bare);
    let found = run_json(&["statics", file, "--format", "json"]);
    let h = found["positions"][0]["contour_groups"][0]["methods"]["equilibrium"]["h"].real();
    let zero = claim(&claims, "so h = 0");
    assert!(
        zero["evidence"].word().contains(&format!("h = {h:.3} m")),
        "{h}"
    );
}

/// The shears at rest in the pose of the file, with no mass but that of rods 6 and 7, and no force.
fn with_weights_of_rods_alone(text: &str) -> String {
    let mut file: toml::Table = text.parse().unwrap();
    for link in file["link"].as_array_mut().unwrap() {
        let link = link.as_table_mut().unwrap();
        if !["6", "7"].contains(&link["id"].as_str().unwrap()) {
            for key in ["mass", "centre", "inertia"] {
                link.remove(key);
            }
        }
    }
    let workload = file["workload"].as_table_mut().unwrap();
    for key in ["force", "stroke", "drive_speed"] {
        workload.remove(key);
    }
    file.remove("expected");
    toml::to_string(&file).unwrap()
}

/// `[Pogrebnyak 2018]`: the rods hang between slider and rockers, and rockers turn on the frame.
#[test]
fn rods_and_rockers_are_told_apart() {
    let claims = claims("analyze gripper-10");
    let swapped = claim(&claims, "rods 3 and 7 to rockers");
    assert_eq!(swapped["holds"], false);
    assert_eq!(swapped["right"], "rods 2 and 6, rockers 3 and 7");
    let m = built_in("gripper-10");
    for (link, on_frame) in [("2", false), ("6", false), ("3", true), ("7", true)] {
        let l = m.links.iter().position(|x| x.id == link).unwrap();
        let joined = |j: &&ozols::model::mechanism::Joint| {
            let at = j.links.map(ozols::model::LinkId::index);
            at.contains(&l) && at.contains(&m.frame_link().index())
        };
        assert_eq!(m.joints.iter().any(|j| joined(&j)), on_frame, "{link}");
    }
}

/// `[Pogrebnyak 2018]`: the two constraints that the unloading joint leaves are forces along x and z, so the plane is z0x.
#[test]
fn the_plane_of_the_constraints_left_is_that_of_their_forces() {
    let claims = claims("analyze gripper-10");
    let plane = claim(&claims, "in the plane z0y");
    assert_eq!(plane["holds"], false);
    assert_eq!(plane["right"], "in the plane z0x");
    assert!(plane["scan"].word().contains("one letter"));
    let found = run_json("analyze gripper-10-unloaded --state clamped --format json");
    let stresses = found["states"][0]["self_stresses"].list();
    let mut left = BTreeSet::new();
    for stress in stresses.iter().filter(|s| s["external"] == true) {
        let joints = stress["joints"].list();
        let at_pad = joints.iter().find(|j| j["joint"] == "a-10").unwrap();
        assert_eq!(at_pad["moments"], json!([]));
        for axis in at_pad["forces"].list() {
            left.insert(axis.word().to_owned());
        }
    }
    assert_eq!(left.into_iter().collect_vec(), ["x", "z"]);
}

/// `[Klyuchkovskyi 1999]`: the formulas that hold, and (7) and (13) as they are printed.
#[test]
fn misprints_of_the_drive_are_told() {
    let claims = claims("drive torsion-module");
    assert_eq!(claims.iter().filter(|c| c["holds"] == true).count(), 6);
    assert_eq!(claim(&claims, "τ = 2π")["right"], "τ = 2π √(I/k), k for T");
    assert_eq!(
        claim(&claims, "the spring gives")["right"],
        "½ ((1 + ψ0)² - ψ0²) c S²"
    );
    let found = run_json("drive torsion-module --format json");
    let number = |key: &str| found["design"][key].real();
    let has = |says: &str, number: String| {
        let row = claim(&claims, says);
        assert!(row["evidence"].word().contains(&number), "{number}: {row}");
    };
    let short = number("missing_angle");
    has("δ ≈", format!("{:.3}°", short.to_degrees()));
    near(
        number("decrement"),
        (FRAC_PI_4 / (FRAC_PI_4 - short)).ln(),
        1e-9,
    );
    has("δ ≈", format!("δ = {:.5}", number("decrement")));
    has("δ ≈", format!("ΔA/A = {:.5}", short / FRAC_PI_4));
    let (d, l, k) = (number("diameter"), number("length"), number("stiffness"));
    has(
        "friction takes",
        format!(
            "{:.2} % more",
            100.0 * (number("needed_feed") / number("friction_energy") - 1.0)
        ),
    );
    near(
        number("friction_energy"),
        k / 2.0 * (2.0 * FRAC_PI_4 * short - short * short),
        1e-9,
    );
    // (11): at that twist the stress at the surface, G d φ/(2 l), is the one allowed.
    let twist = 2.0 * l * 6e8 / (d * 8e10);
    has("bears a twist", format!("{:.2}°", twist.to_degrees()));
    near(8e10 * d * twist / (2.0 * l), 6e8, 1.0);
    // A disc moves in the state in which the other's latch holds.
    let m = built_in("torsion-module");
    for (held, latch, disc) in [
        ("first-held", "latch-1", "1"),
        ("second-held", "latch-2", "2"),
    ] {
        let state = m.state_named(held).unwrap();
        let latched = m
            .joints_in(state)
            .find(|&j| m.joints[j].id == latch)
            .unwrap();
        let links = m.joints[latched].links.map(|l| m.links[l].id.as_str());
        assert!(links.contains(&disc));
        assert_eq!(
            run_json(&format!(
                "analyze torsion-module --state {held} --format json"
            ))["states"][0]["mobility"],
            1
        );
    }
}

#[test]
fn nothing_is_told_of_mechanisms_that_no_claim_is_about() {
    // Claims about arms are not about structure.
    for name in ["four-bar", "lever-gripper"] {
        assert!(claims(&format!("analyze {name}")).is_empty());
    }
}

/// What a mechanism does not have is empty, not absent: every answer has the same keys.
#[test]
fn optional_keys_are_empty_and_not_absent() {
    let keys = |v: &Value| {
        v.as_object()
            .unwrap()
            .keys()
            .cloned()
            .collect::<BTreeSet<_>>()
    };
    let [plain, geared, turned] = ["four-bar", "planetary-gear", "bennett"].map(|n| state(n, 0));
    assert_eq!(keys(&plain), keys(&geared));
    assert_eq!(keys(&plain), keys(&turned));
    assert_eq!(plain["per_coupling"], json!([]));
    assert!(run_json("analyze four-bar --format json")["stroke"].is_null());
    let [free, clamped] = ["free", "clamped"].map(|s| {
        run_json(&format!(
            "statics gripper-10-loaded --spatial --format json --state {s}"
        ))
    });
    assert_eq!(keys(&free), keys(&clamped));
    assert_eq!(free["contacts"], json!([]));
    assert!(
        free["reactions"]
            .list()
            .iter()
            .all(|r| r["open"].is_array())
    );
    let found = keys(&run_json("search four-bar --top 1 --format json"));
    for key in split_words("ranking numeric second_opinion certainty left_out") {
        assert!(found.contains(key), "{key}: {found:?}");
    }
}
