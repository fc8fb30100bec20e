//! The cheapest symmetric redesigns, against lists of all symmetric variants.

use crate::common::*;
/// Returns what a search of the gripper says with more flags.
fn found(more: &str) -> Value {
    run_json(&format!("search gripper-10 --format json {more}"))
}

/// The redesign that the literature of the gripper would build: mirror images alike, one redundant constraint left, cost 11, one motion.
/// Eleven freedoms make it determinate, which pairs of joints cannot add.
#[test]
fn the_gripper_has_a_symmetric_redesign_with_one_constraint_left() {
    let all = found("");
    let best = all["symmetric"].list();
    let row = |v: &Value| [&v["redundant"], &v["cost"], &v["mobility"]].map(Value::to_string);
    let rows: Vec<_> = best.iter().map(row).collect();
    assert!(
        rows.contains(&["1", "11", "1"].map(str::to_owned)),
        "{rows:?}"
    );
    for (left, v) in best.iter().enumerate() {
        let list = found(&format!(
            "--symmetric --max-redundant {left} --top 5000 --check none"
        ));
        let variants = list["variants"].list();
        let first = variants.iter().find(|v| v["redundant"] == left);
        assert_eq!(v["changes"], first.unwrap()["changes"], "σ = {left}");
        assert_eq!(row(v), row(first.unwrap()), "σ = {left}");
    }
    let text = run_quiet("search gripper-10");
    let said = "that takes 11 more freedoms, and joints that are images of each other gain them 2 at a time";
    assert!(text.contains(said), "{text}");
    let none = run("search gripper-10 --symmetric --max-mobility 1 --count");
    assert_eq!(none.status.code(), Some(1));
}

/// Of equal cost ideas that are their own images come first.
#[test]
fn ideas_of_a_symmetric_mechanism_say_whether_they_are_symmetric() {
    let own = |name: &str| -> Vec<(u64, Value)> {
        let args = format!("search {name} --distinct --top 60 --format json -q");
        let list = run_json(&args)["variants"].take();
        let row = |v: &Value| (milli(&v["cost"]), v["idea"]["symmetric"].clone());
        list.list().iter().map(row).collect()
    };
    let gripper = own("gripper-slider-two-fingers");
    let order = |(cost, symmetric): &(u64, Value)| (*cost, !symmetric.as_bool().unwrap());
    assert!(gripper.iter().map(order).is_sorted());
    assert!(gripper.iter().any(|(_, s)| *s == true) && gripper.iter().any(|(_, s)| *s == false));
    assert!(own("watt-six-bar").iter().all(|(_, s)| s.is_null()));
}

fn milli(cost: &Value) -> u64 {
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a small cost"
    )]
    let milli = (1000.0 * cost.real()) as u64;
    milli
}

/// A robot with three legs alike is turned into itself by a third of a turn, and its symmetric redesigns change all three alike.
#[test]
fn thirds_of_a_turn_are_found() {
    for name in ["delta", "3-upu", "3-rps", "y-star"] {
        let v = run_json(&format!("search {name} --format json -q --check none"));
        let best = v["symmetric"].list();
        for one in best.iter().filter(|v| v["by"] == "third of a turn") {
            let mut alike: BTreeMap<&str, usize> = BTreeMap::new();
            let changes = one["changes"].list();
            changes
                .iter()
                .for_each(|c| *alike.entry(c["to"].word()).or_default() += 1);
            assert!(alike.values().all(|n| n % 3 == 0), "{name}: {one}");
        }
        let args = format!("search {name} --symmetric --count --format json -q");
        let found: Value = serde_json::from_slice(&run(&args).stdout).unwrap();
        let space: f64 = found["space"].word().parse().unwrap();
        let all: f64 = v["space"].word().parse().unwrap();
        assert!(
            (space.powi(3) - all).abs() <= 1e-9 * all,
            "{name}: {space} {all}"
        );
    }
}

/// A platform on three legs alike, turned in space and rounded to so many decimals, with options for all joints.
fn three_legs(digits: usize, turned: bool, options: &str) -> String {
    let by = if turned {
        [0.8, 0.36, -0.48, 0.0]
    } else {
        [1.0, 0.0, 0.0, 0.0]
    };
    let turn = RigidMotion::from_quaternion([0.0; 3], by);
    let write = |v: [f64; 3]| {
        turn.map_direction(v)
            .map(|x| format!("{x:.digits$}"))
            .join(", ")
    };
    let (mut links, mut joints) = ("0 p*".to_owned(), String::new());
    for leg in 0..3 {
        let (sine, cosine) = (f64::from(leg) * TAU / 3.0).sin_cos();
        let point = |r: f64, z: f64| write([r * cosine, r * sine, z]);
        let axis = write([-sine, cosine, 0.0]);
        links += &format!(" a{leg} b{leg}");
        for (from, to, kind, place) in [
            ("0", &*format!("a{leg}"), "revolute", point(10.0, 0.0)),
            (
                &format!("a{leg}"),
                &format!("b{leg}"),
                "revolute",
                point(13.0, 8.0),
            ),
            (&format!("b{leg}"), "p", "spherical", point(5.0, 12.0)),
        ] {
            joints += &format!("{from}-{to} | {from} {to} | {kind} | {place} | {axis}\n");
        }
    }
    let head = format!("name = \"three-legs\"\n[search]\noptions = {options}");
    write_mechanism(&head, &links, &joints)
}

/// Rounded coordinates of three legs alike are symmetric within their digits, turned in space or not, and symmetric redesigns are those of
/// the list of all that change three legs alike.
#[test]
fn rounded_legs_are_symmetric_within_their_digits() {
    for turned in [false, true] {
        for digits in [4, 5, 6, 8] {
            let text = three_legs(digits, turned, "[\"cylindrical\", \"spherical\"]");
            let (_folder, path) = write_temporary("legs.toml", text);
            let line = format!("search {path} --all --format json -q --pose-only");
            let all = run_json(&line);
            let changes = |v: &Value| {
                let one = |c: &Value| (c["joint"].word().to_owned(), c["to"].word().to_owned());
                v["changes"].list().iter().map(one).collect::<Vec<_>>()
            };
            let is_alike = |v: &&Value| {
                let mut alike: BTreeMap<(String, String), usize> = BTreeMap::new();
                for (joint, to) in changes(v) {
                    let place = joint.replace(['0', '1', '2'], "");
                    *alike.entry((place, to)).or_default() += 1;
                }
                alike.values().all(|n| *n == 3)
            };
            let wanted = all["variants"].list().iter().filter(is_alike).count();
            let found = run_json(&format!("{line} --symmetric"));
            assert_eq!(found["space"], "9", "{digits} {turned}");
            assert_eq!(found["variants"].list().len(), wanted, "{digits} {turned}");
            let best = all["symmetric"].list();
            assert!(!best.is_empty());
            for one in best {
                assert_eq!(one["by"], "third of a turn, within the digits of the file");
            }
        }
    }
    // A leg that is a hundredth longer is none of three alike.
    let text = three_legs(6, false, "[\"cylindrical\", \"spherical\"]");
    let other = replace_once(
        &text,
        "[13.000000, 0.000000, 8.000000]",
        "[13.010000, 0.010000, 8.000000]",
    );
    let (_folder, path) = write_temporary("legs.toml", other);
    let o = run(&["search", path, "--symmetric", "--count", "-q"]);
    assert_eq!(o.status.code(), Some(2), "{}", utf8_text(&o.stdout));
}

/// The second axis of a universal joint that a file leaves open goes with its leg, and axes through one point say the turn.
#[test]
fn open_second_axes_are_carried_along_by_thirds_of_a_turn() {
    for name in ["3-crr", "tripteron", "orthoglide"] {
        let space = |more: &str| -> f64 {
            let args = format!("search {name} --count --format json -q --pose-only {more}");
            let found: Value = serde_json::from_slice(&run(&args).stdout).unwrap();
            found["space"].word().parse().unwrap()
        };
        let (symmetric, all) = (space("--symmetric"), space("--nodes 2000"));
        let off = symmetric.powi(3) - all;
        assert!(off.abs() <= 1e-9 * all, "{name}: {symmetric} {all}");
    }
    // The counts are those of a file that states the axes.
    let plain = ozols::builtin::text("tripteron").unwrap();
    let mut stated = plain.to_owned();
    for (joint, axis) in [
        ("s1-a1", "[0, 1, 0]"),
        ("s2-a2", "[0, 0, 1]"),
        ("s3-a3", "[1, 0, 0]"),
    ] {
        let from = format!("id = \"{joint}\"\n");
        stated = replace_once(&stated, &from, &format!("{from}reference = {axis}\n"));
    }
    let count = |text: &str| {
        let text = replace_once(
            text,
            "options = [\"revolute\", \"cylindrical\", \"universal\", \"spherical\"]",
            "",
        );
        let (_folder, path) = write_temporary("tripteron.toml", text);
        let allow = ["s1-a1", "s2-a2", "s3-a3"]
            .map(|j| format!("--allow={j}=cylindrical,universal,spherical"));
        let allow = allow.join(" ");
        let args =
            format!("search {path} --symmetric --count --format json -q --pose-only {allow}");
        let found: Value = serde_json::from_slice(&run(&args).stdout).unwrap();
        ["space", "determinate", "admissible"].map(|k| found[k].clone())
    };
    assert_eq!(count(plain), count(&stated));
}

#[test]
fn mechanisms_without_symmetry_have_no_symmetric_redesigns() {
    for line in ["search watt-six-bar", "search gripper-10 --count"] {
        let v = run_json(&format!("{line} --format json"));
        assert!(v["symmetric"].is_null(), "{line}");
    }
}
