//! Files that offer no joint types, joint types that would help, and symmetry that no file names.

use crate::common::*;

/// Returns the JSON of a command whatever its exit code, and that code.
fn answer(args: &[&str]) -> (Value, Option<i32>) {
    let o = run(args);
    let value = serde_json::from_slice(&o.stdout).unwrap_or(Value::Null);
    (value, o.status.code())
}

/// Every built-in mechanism is searched, and has a choice unless all its joints are driven, fixed or coupled.
#[test]
fn every_builtin_mechanism_is_searched() {
    let all = json(&["list", "--format", "json"]);
    let mut alone = Vec::new();
    let names = all.list().iter().map(|m| m["name"].word());
    for name in names {
        let args = [
            "search", name, "--count", "--format", "json", "-q", "--nodes", "2000",
        ];
        let (found, code) = answer(&args);
        assert!(matches!(code, Some(0 | 1 | 3)), "{name}: {code:?}");
        if found["space"] == "1" {
            alone.push(name.to_owned());
        }
    }
    alone.dedup();
    assert_eq!(alone, ["tongs"]);
}

/// What is offered where nothing is stated is what is found when it is stated.
#[test]
fn usual_options_count_as_stated_ones() {
    let usual = "cylindrical,universal,spherical,cylindrical-universal,sphere-in-cylinder";
    for name in [
        "jansen-leg",
        "scissor-lift-3",
        "miura-ori",
        "roberts-cognates",
    ] {
        let args = ["search", name, "--count", "--format", "json", "-q"];
        let (own, _) = answer(&args);
        let (stated, _) = answer(&[&args[..], &["--options", usual]].concat());
        for key in ["space", "admissible", "determinate"] {
            assert_eq!(own[key], stated[key], "{name} {key}");
        }
    }
}

/// A joint type that does not keep a coupled freedom is not offered, whoever asks for it: the file would refuse it.
#[test]
fn coupled_joints_keep_their_coupled_freedom() {
    let args = ["search", "planetary-gear", "--count", "-q"];
    let o = run(&[&args[..], &["--allow", "c-1=spherical"]].concat());
    assert_eq!(
        o.status.code(),
        Some(2),
        "{}",
        String::from_utf8_lossy(&o.stderr)
    );
    let o = run(&[&args[..], &["--allow", "c-1=cylindrical"]].concat());
    assert_ne!(
        o.status.code(),
        Some(2),
        "{}",
        String::from_utf8_lossy(&o.stderr)
    );
}

/// A drawer on two pairs of hinges, each pair on one line, and a rod with balls that drives it.
const TWO_ARMS: &str = r#"
name = "two-arms"
[[link]]
id = "frame"
role = "frame"
[[link]]
id = "arm"
role = "output"
[[joint]]
id = "front"
links = ["frame", "arm"]
type = "revolute"
point = [1, 0, 0]
axis = [1, 0, 0]
[[joint]]
id = "rear"
links = ["frame", "arm"]
type = "revolute"
point = [-1, 0, 0]
axis = [1, 0, 0]
[search]
options = ["revolute", "cylindrical"]
"#;

/// Two hinges on one line hold five constraints twice, of which a ball in a tube at one of them frees four and a cylinder at the
/// other the last: neither of the types that the file offers does.
#[test]
fn the_type_that_opens_a_search_is_named_and_does() {
    let (_folder, file) = written("two-arms.toml", TWO_ARMS);
    let o = run(&["search", file]);
    assert_eq!(o.status.code(), Some(1));
    let text = String::from_utf8(o.stdout).unwrap();
    let command = text
        .lines()
        .find(|l| l.contains("--allow"))
        .unwrap_or_else(|| panic!("{text}"));
    let words = shell_words(command.trim());
    let words: Vec<&str> = words.iter().skip(1).map(String::as_str).collect();
    let words: Vec<&str> = words
        .iter()
        .map(|&w| {
            if w.ends_with("two-arms.toml") {
                file
            } else {
                w
            }
        })
        .collect();
    let (found, code) = answer(&[&words[..], &["--count", "--format", "json", "-q"]].concat());
    assert_eq!(code, Some(0), "{command}");
    assert!(count(&found["admissible"]) > 0);
}

fn shell_words(line: &str) -> Vec<String> {
    line.split_whitespace()
        .map(|w| w.trim_matches('\'').to_owned())
        .collect()
}

/// A hand with both rods on one pin of the slide, `apart` from each other, and its name.
fn hand(apart: i64) -> String {
    let mut text = "name = \"hand\"\n".to_owned();
    for (id, role) in [
        ("0", "frame"),
        ("1", ""),
        ("2", ""),
        ("3", ""),
        ("4", "output"),
        ("5", "output"),
    ] {
        text += &format!("[[link]]\nid = \"{id}\"\n");
        if !role.is_empty() {
            text += &format!("role = \"{role}\"\n");
        }
    }
    let mut joint = |a: &str, b: &str, kind: &str, at: [i64; 2], axis: [i64; 3], more: &str| {
        text += &format!(
            "[[joint]]\nid = \"{a}-{b}\"\nlinks = [\"{a}\", \"{b}\"]\ntype = \"{kind}\"\npoint = [{}, {}, 0]\naxis = {axis:?}\n{more}",
            at[0], at[1]
        );
    };
    let z = [0, 0, 1];
    joint("0", "1", "prismatic", [-50, 0], [1, 0, 0], "drive = true\n");
    joint("1", "2", "revolute", [-50, apart], z, "");
    joint("1", "3", "revolute", [-50, -apart], z, "");
    joint("2", "4", "revolute", [-20, 30], z, "");
    joint("3", "5", "revolute", [-20, -30], z, "");
    joint("0", "4", "revolute", [0, 20], z, "");
    joint("0", "5", "revolute", [0, -20], z, "");
    text += "[search]\noptions = [\"revolute\", \"cylindrical\", \"universal\", \"spherical\"]\n";
    text
}

/// Joints at one place are paired by their links, and `--symmetric` needs no names: as many variants are their own images as where
/// the file names the pairs, whether the pins are apart or one.
#[test]
fn symmetric_variants_of_joints_at_one_place_are_found() {
    let folder = tempfile::tempdir().unwrap();
    let named = "mirror = [[\"1-2\", \"1-3\"], [\"2-4\", \"3-5\"], [\"0-4\", \"0-5\"]]\n";
    for apart in [0, 3] {
        let mut counts = Vec::new();
        for more in ["", named] {
            let file = folder.path().join("hand.toml");
            std::fs::write(&file, hand(apart) + more).unwrap();
            let args = [
                "search",
                file.to_str().unwrap(),
                "--format",
                "json",
                "-q",
                "--top",
                "3",
            ];
            for how in ["--symmetric", "--one-per-orbit"] {
                let (found, code) = answer(&[&args[..], &[how]].concat());
                assert_eq!(code, Some(0), "{apart} {how}");
                counts.push((
                    found["admissible"].clone(),
                    found["variants"][0]["cost"].clone(),
                ));
            }
        }
        assert_eq!(counts[..2], counts[2..], "{apart}");
    }
}

/// What is not its own image is refused, and nothing is guessed.
#[test]
fn an_unsymmetric_mechanism_is_refused() {
    let (_folder, file) = written("hand.toml", hand(3).replace("[-20, 30, 0]", "[-21, 30, 0]"));
    let o = run(&["search", file, "--symmetric"]);
    assert_eq!(o.status.code(), Some(2));
    assert!(o.stdout.is_empty());
}

/// A hinge has 31 sets of freedoms with its own turn in them, that of a joint which is not there left out. The count of the gripper's is
/// one of a hand-written enumeration of subsets.
#[test]
fn every_set_of_freedoms_is_offered_by_one_word() {
    let args = words("search gripper-10 --options any --count --format json -q");
    let (found, _) = answer(&[&args[..], &["--pose-only", "--drives", "free"]].concat());
    assert_eq!(found["space"], 31u64.pow(12).to_string());
    assert_eq!(count(&found["admissible"]), 91_391_212);
    // In a plane a hinge may slide along either axis, and what slides along both is not there.
    let (found, _) = answer(&[
        "search",
        "gripper-10-planar",
        "--options",
        "any",
        "--count",
        "--format",
        "json",
        "-q",
    ]);
    assert_eq!(found["space"], 3u64.pow(12).to_string());
    let o = run("search four-bar --options any --no-distinct --top 3");
    assert!(
        String::from_utf8(o.stderr)
            .unwrap()
            .starts_with("note: every set of freedoms")
    );
}

/// The sets are those of an enumeration: each subset of the six freedoms with the turn of the hinge in it, whatever is left out.
#[test]
fn every_subset_of_freedoms_is_a_choice() {
    let args = words(
        "search four-bar --options any --all --allow-output-change --max-redundant 9 --format jsonl -q --check none",
    );
    let o = run(&args);
    let text = String::from_utf8(o.stdout).unwrap();
    let mut at_one = std::collections::BTreeSet::new();
    for line in text.lines() {
        let v: Value = serde_json::from_str(line).unwrap();
        let changes = v["changes"]
            .as_array()
            .map(Vec::as_slice)
            .unwrap_or_default();
        if let [one] = changes
            && one["joint"] == "1-2"
        {
            at_one.insert(one["to"].word().to_owned());
        }
    }
    assert_eq!(at_one.len(), 30);
}
