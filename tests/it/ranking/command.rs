//! Ranking from the command line and from the file.

use super::{cheapest, loaded, near, search};
use crate::common::*;

#[test]
fn the_command_changes_the_order_and_says_why() {
    let v = run_json("search gripper-10-loaded --format json");
    let ranking = &v["ranking"];
    assert_eq!(ranking["pool"], 20_000);
    // Of the 25.7 million the few that could win are scored, too, and there are no better ones.
    assert_eq!(ranking["proven"], true, "{ranking}");
    let elsewhere = ranking["scored_elsewhere"].whole();
    assert!(elsewhere > 0 && elsewhere < 100_000, "{elsewhere}");
    assert!(ranking["missing"].is_null());
    let first = &v["variants"][0];
    assert!(first["scores"]["peak-force"].real() > 0.0);
    assert!(first["scores"]["by_cost"].whole() > 1, "{first}");
    let reason = first["scores"]["reason"].word();
    assert!(
        reason.starts_with("rank 1 was ") && reason.contains("instead of"),
        "{reason}"
    );
    // Without a [ranking], the scores stay empty and the order is that of cost.
    let plain = run_json("search gripper-10 --top 1 --format json");
    assert!(plain.get("ranking").is_some_and(|r| r.is_null()));
    assert_eq!(plain["variants"][0]["scores"], serde_json::json!({}));
    // Asked for on the command line.
    let asked =
        run_json("search gripper-10-loaded --rank peak-moment=2,cost --pool 50 --format json");
    assert_eq!(asked["ranking"]["terms"][0]["weight"], 2.0);
    assert_eq!(asked["ranking"]["scored"], 50);
}

#[test]
fn bad_rankings_are_refused_with_line_item_and_remedy() {
    let good = builtin::text("gripper-10-loaded").unwrap().to_owned() + "\n# more\n";
    for [from, to, parts] in read_cases::<3>(
        r#"
        term = "cost" | term = "price" | unknown term "price" & peak-force
        weight = 0.2 | weight = nan | weight NaN & from 0 to 1e12
        weight = 0.2 | weight = -1 | weight -1
        [ranking] | [ranking]\norder = "best" | unknown order "best" & weighted
        min = 1e-4 | min = inf | limit inf
        mass = 0.25 | mass = -0.25 | mass -0.25 & from 0 to 1e12
        # more | [joint_types.spherical]\ncapacity_force = 0 | capacity 0 & above 0
        # more | [joint_types.spherical]\ncapacity_moment = -1 | capacity -1
        # more | [joint_types.spherical]\nclearance = -1 | clearance -1
        # more | [joint_types.bal]\nclearance = 1 | unknown joint type "bal" & spherical
        "#,
    ) {
        let text = replace_once(&good, from, to);
        let (_folder, path) = write_temporary("bad.toml", text);
        let o = run(&["search", path]);
        let said = String::from_utf8(o.stderr).unwrap();
        assert_eq!(o.status.code(), Some(2), "{said}");
        has(&said, "bad.toml:");
        for p in parts.split(" & ") {
            assert!(said.contains(p), "no {p:?} in: {said}");
        }
    }
    for args in [["--rank", "price"], ["--rank", "cost=nan"], ["--pool", "0"]] {
        let o = run(&[&["search", "gripper-10-loaded"], &args[..]].concat());
        assert_eq!(o.status.code(), Some(2), "{args:?}");
    }
}

/// A file's own figures of a joint type change the scores, and its cost the additive part.
#[test]
fn joint_types_can_be_overridden() {
    let text = builtin::text("gripper-10-loaded").unwrap();
    let text = format!(
        "{text}\n[joint_types.revolute]\ncapacity_force = 96\n[joint_types.spherical]\ncost = 7\n"
    );
    let weak = read(&text);
    let strong = loaded();
    let of = |m: &Mechanism| {
        let s = search(m, 11);
        let e = Evaluator::new(&s, ClearanceSum::Worst).unwrap();
        let present = Assignment {
            choices: vec![0; s.space.variables.len()],
            key: cheapest(&s, 1)[0].key,
        };
        e.reference_scores(&present).unwrap().force.utilisation
    };
    assert!(near(of(&weak), 10.0 * of(&strong), 1e-9));
    assert!(
        weak.search
            .costs
            .by_type_milli
            .contains(&("spherical".to_owned(), 7000))
    );
}
