//! Variants in other poses of the present motion.

use crate::common::*;
const BALANCE: &str = "search roberval-balance --pose-only --format json --all --seed 3";

fn changes(v: &Value) -> Vec<(String, String)> {
    let word = |x: &Value| x.word().to_owned();
    let list = v["changes"].list();
    list.iter()
        .map(|c| (word(&c["joint"]), word(&c["to"])))
        .collect()
}

/// The balance's rocker 3 on a ball and a universal joint spins idly where the second pin of that joint, which stays
/// with the frame, happens to point at the ball.
#[test]
fn variants_that_are_right_in_the_pose_of_the_file_only_are_marked() {
    let v = run_json(&format!("{BALANCE} --poses 4"));
    assert_eq!(v["poses"], serde_json::json!({"asked": 4, "reached": 4}));
    let variants = v["variants"].list();
    assert!(variants.iter().all(|x| x["lucky"].is_boolean()));
    let lucky: Vec<&Value> = variants.iter().filter(|x| x["lucky"] == true).collect();
    assert_eq!((lucky.len(), &v["variants_lucky"]), (3, &3.into()));
    for x in &lucky {
        let other = &x["stroke"]["other"];
        assert_eq!(other["output_mobility"], 2);
        assert_eq!(other["present_output_mobility"], 1);
        assert_eq!(other["redundant"], 0);
    }
    let one = [
        ("1-2", "cylindrical"),
        ("2-3", "spherical"),
        ("3-0", "universal"),
    ]
    .map(|(j, t)| (j.to_owned(), t.to_owned()));
    assert!(lucky.iter().any(|x| changes(x) == one));
}

/// With the second pin in the rocker it points at the ball always.
#[test]
fn which_link_has_which_pin_matters() {
    let text = run_quiet("show roberval-balance");
    let swapped = text.replace("links = [\"3\", \"0\"]", "links = [\"0\", \"3\"]");
    assert_ne!(text, swapped);
    let v = json_on("search", "swapped.toml", &swapped, "--all --poses 4");
    let lucky = |joint: &str| {
        let list = v["variants"].list().iter();
        list.filter(|x| x["lucky"] == true)
            .filter(|x| changes(x).contains(&(joint.to_owned(), "universal".to_owned())))
            .count()
    };
    assert_eq!(lucky("3-0"), 0);
}

#[test]
fn poses_do_not_depend_on_threads_and_need_a_motion() {
    let run = |threads| run_quiet(&format!("{BALANCE} --poses 3 --threads {threads}"));
    assert!(run(1) == run(2));
    let (_, found, said) = run_full("search bennett-perturbed --poses 2 --format json");
    assert!(said.starts_with("warning: no other pose"), "{said}");
    let v: Value = serde_json::from_str(&found).unwrap();
    assert_eq!(v["poses"]["reached"], 0);
    assert!(v["variants"].list().iter().all(|x| x["lucky"].is_null()));
    let v = run_json("search four-bar --format json");
    assert!(v["poses"].is_null() && v["variants"][0]["lucky"].is_null());
}
