//! The program as its users meet it: exit codes, messages, formats, repeatability.

use assert_cmd::Command;
use serde_json::Value;
use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::process::{Output, Stdio};

/// Options that make the gripper's space small.
const SMALL: [&str; 4] = ["search", "gripper-10", "--options", "revolute,spherical"];

pub(crate) fn ozols(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ozols"));
    command.args(args);
    command
}

fn run(args: &[&str]) -> Output {
    ozols(args).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// Standard output of a run that succeeds and says nothing else.
pub(crate) fn out(args: &[&str]) -> String {
    let o = run(args);
    assert_eq!(
        (o.status.code(), text(&o.stderr).as_str()),
        (Some(0), ""),
        "{args:?}"
    );
    text(&o.stdout)
}

pub(crate) fn json(args: &[&str]) -> Value {
    serde_json::from_str(&out(args)).unwrap()
}

/// A count, written as a string.
pub(crate) fn count(v: &Value) -> u64 {
    v.as_str().unwrap().parse().unwrap()
}

fn small(more: &[&str]) -> Vec<String> {
    SMALL.iter().chain(more).map(|s| (*s).to_owned()).collect()
}

fn small_out(more: &[&str]) -> String {
    let args = small(more);
    out(&args.iter().map(String::as_str).collect::<Vec<_>>())
}

/// Asserts that a run is refused with exit code 2, nothing on standard output, and these words.
fn refused(args: &[&str], parts: &[&str]) -> String {
    let o = run(args);
    let said = text(&o.stderr);
    assert_eq!(o.status.code(), Some(2), "{args:?}: {said}");
    assert!(o.stdout.is_empty(), "{args:?}");
    assert!(said.starts_with("error: "), "{said}");
    for p in parts {
        assert!(said.contains(p), "{args:?}: no {p:?} in: {said}");
    }
    said
}

/// Asserts that a file is refused at the line where `line_with` first stands, with these words.
fn bad_file(name: &str, content: &str, line_with: &str, parts: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, content).unwrap();
    for command in ["check", "analyze", "search"] {
        let said = refused(&[command, path.to_str().unwrap()], parts);
        assert!(said.contains(name), "{said}");
        let line = content.lines().position(|l| l.contains(line_with)).unwrap() + 1;
        assert!(
            said.contains(&format!("{name}:{line}:")),
            "no line {line} in: {said}"
        );
    }
}

fn four_bar() -> String {
    out(&["show", "four-bar"])
}

/// The four-bar with one text replaced, which must be there.
fn with(from: &str, to: &str) -> String {
    let text = four_bar();
    assert!(text.contains(from), "{from}");
    text.replacen(from, to, 1)
}

// Exit codes.

#[test]
fn exit_code_0_done() {
    for args in [
        &["list"][..],
        &["schema"],
        &["show", "four-bar"],
        &["check", "four-bar"],
        &["analyze", "four-bar"],
        &["search", "four-bar"],
        &["--help"],
        &["--version"],
    ] {
        assert!(!out(args).is_empty());
    }
}

#[test]
fn exit_code_1_nothing_found() {
    let o = run(&["search", "gripper-10", "--max-mobility", "0"]);
    assert_eq!((o.status.code(), text(&o.stderr).as_str()), (Some(1), ""));
    assert!(text(&o.stdout).contains("13,841,287,201 variants"));
}

#[test]
fn exit_code_2_bad_arguments() {
    for args in [
        &["nonsense"][..],
        &["search"],
        &["search", "four-bar", "--top", "x"],
        &["search", "four-bar", "--all", "--count"],
        &["analyze", "four-bar", "--format", "xml"],
    ] {
        refused(args, &[]);
    }
    refused(&["list", "--threads", "0"], &["--threads", "at least 1"]);
    refused(
        &["analyze", "four-bar", "--method", "svd", "--tolerance", "2"],
        &["--tolerance"],
    );
    refused(
        &["search", "gripper-10", "--method", "brute"],
        &["13841287201", "too many for brute force"],
    );
}

// What can be wrong with a file.

#[test]
fn error_unknown_link() {
    bad_file(
        "bad.toml",
        &with("[\"2\", \"3\"]", "[\"2\", \"zz\"]"),
        "zz",
        &["unknown link \"zz\"", "known links: 0, 1, 2, 3"],
    );
}

#[test]
fn error_duplicate_ids() {
    let text = with("id = \"2-3\"", "id = \"1-2\"  # again");
    bad_file(
        "bad.toml",
        &text,
        "# again",
        &["joint has the id \"1-2\" twice"],
    );
    let text = with("id = \"3\"", "id = \"2\"  # again");
    bad_file(
        "bad.toml",
        &text,
        "# again",
        &["link has the id \"2\" twice"],
    );
}

#[test]
fn error_empty_id() {
    bad_file(
        "bad.toml",
        &with("id = \"2-3\"", "id = \"\""),
        "id = \"\"",
        &["1 to 64 characters"],
    );
}

#[test]
fn error_self_loop() {
    bad_file(
        "bad.toml",
        &with("[\"2\", \"3\"]", "[\"2\", \"2\"]"),
        "[\"2\", \"2\"]",
        &["\"2-3\" connects link \"2\" to itself"],
    );
}

#[test]
fn error_disconnected() {
    let joint = "[[link]]\nid = \"p\"\n\n[[link]]\nid = \"q\"\n\n[[joint]]\nid = \"p-q\"\nlinks = [\"p\", \"q\"]\ntype = \"revolute\"\npoint = [0, 0, 0]\naxis = [0, 0, 1]\n\n[[contour]]";
    bad_file(
        "bad.toml",
        &with("[[contour]]", joint),
        "id = \"p\"",
        &["link \"p\" is not connected to the frame", "free", "\"q\""],
    );
}

#[test]
fn error_unused_link() {
    bad_file(
        "bad.toml",
        &with("[[joint]]", "[[link]]\nid = \"lone\"\n\n[[joint]]"),
        "lone",
        &["link \"lone\" has no joint"],
    );
}

#[test]
fn error_zero_axis() {
    bad_file(
        "bad.toml",
        &with("axis = [0, 0, 1]", "axis = [0, 0, 0.0]"),
        "0, 0.0]",
        &["axis of joint \"0-1\" is zero"],
    );
}

#[test]
fn error_parallel_reference() {
    let text = with(
        "axis = [0, 0, 1]",
        "axis = [0, 0, 1]\nreference = [0, 0, -2]",
    );
    bad_file(
        "bad.toml",
        &text,
        "reference =",
        &["reference of joint \"0-1\" is parallel"],
    );
}

#[test]
fn error_coordinates() {
    for (word, part) in [
        ("nan", "finite"),
        ("inf", "finite"),
        ("1e308", "out of range"),
        ("1e-100", "out of range"),
        ("\"sqrt(-1)\"", "square root of a negative number"),
        ("\"1/0\"", "division by zero"),
        ("\"tan(90deg)\"", ""),
        ("\"sqr(2)\"", "unknown word `sqr`"),
        ("\"\"", "empty"),
    ] {
        let text = with("[80, 90, 0]", &format!("[80, {word}, 0]"));
        bad_file("bad.toml", &text, "[80, ", &[part]);
    }
}

#[test]
fn error_coordinate_overflow() {
    bad_file(
        "bad.toml",
        &with("[80, 90, 0]", "[80, 99999999999999999999, 0]"),
        "[80, ",
        &[],
    );
}

#[test]
fn error_unknown_type() {
    let text = with("type = \"revolute\"", "type = \"hinge\"");
    let parts = [
        "unknown joint type \"hinge\"",
        "revolute, prismatic, helical, cylindrical, universal",
        "spherical",
        "custom",
    ];
    bad_file("bad.toml", &text, "hinge\"", &parts);
}

#[test]
fn error_other_words() {
    bad_file(
        "bad.toml",
        &with("\"mm\"", "\"furlong\""),
        "furlong",
        &["unknown length unit \"furlong\"", "m, mm, cm, um, in"],
    );
    bad_file(
        "bad.toml",
        &with("role = \"output\"", "role = \"tool\""),
        "\"tool\"",
        &["unknown role \"tool\"", "frame, output, object"],
    );
    let text = with("length_unit", "mode = \"flat\"\nlength_unit");
    bad_file(
        "bad.toml",
        &text,
        "\"flat\"",
        &["unknown mode \"flat\"", "spatial, planar"],
    );
}

#[test]
fn error_option_loses_motion() {
    let text = with("drive = true", "options = [\"revolute\", \"prismatic\"]");
    bad_file(
        "bad.toml",
        &text,
        "\"prismatic\"",
        &["option \"prismatic\" of joint \"0-1\"", "present revolute"],
    );
}

#[test]
fn error_no_frame() {
    bad_file(
        "bad.toml",
        &with("role = \"frame\"", ""),
        "[[link]]",
        &["no link has the role \"frame\""],
    );
}

#[test]
fn error_second_frame() {
    bad_file(
        "bad.toml",
        &with("role = \"output\"", "role = \"frame\" # 2"),
        "# 2",
        &["link \"3\" is a second frame after \"0\""],
    );
}

#[test]
fn error_no_output() {
    bad_file(
        "bad.toml",
        &with("role = \"output\"", ""),
        "[[link]]",
        &["no link has the role \"output\""],
    );
}

#[test]
fn error_open_contour() {
    let text = with(
        "\"0-1\", \"1-2\", \"2-3\", \"3-0\"",
        "\"0-1\", \"1-2\", \"2-3\"",
    );
    bad_file("bad.toml", &text, "joints = [", &["closed walk"]);
}

#[test]
fn error_unknown_joint_in_contour() {
    let text = with("\"2-3\", \"3-0\"", "\"2-3\", \"9-9\"");
    bad_file(
        "bad.toml",
        &text,
        "9-9",
        &["unknown joint \"9-9\"", "0-1, 1-2, 2-3, 3-0"],
    );
}

#[test]
fn error_toml_syntax() {
    bad_file(
        "bad.toml",
        &with("id = \"2-3\"", "id = = \"2-3\""),
        "= =",
        &[],
    );
}

#[test]
fn error_unknown_key() {
    bad_file(
        "bad.toml",
        &with("drive = true", "driven = true"),
        "driven",
        &["driven"],
    );
}

#[test]
fn error_wrong_type() {
    bad_file(
        "bad.toml",
        &with("drive = true", "drive = 7"),
        "drive = 7",
        &["boolean"],
    );
    bad_file(
        "bad.toml",
        &with("[80, 90, 0]", "[80, 90]"),
        "[80, 90]",
        &[],
    );
    bad_file(
        "bad.toml",
        &with("[80, 90, 0]", "[80, true, 0]"),
        "[80, true, 0]",
        &["expected a number"],
    );
}

#[test]
fn error_all_at_once() {
    let text = with("[\"2\", \"3\"]", "[\"2\", \"zz\"]").replacen(
        "type = \"revolute\"",
        "type = \"hinge\"",
        1,
    );
    bad_file(
        "bad.toml",
        &text,
        "hinge\"",
        &["unknown link \"zz\"", "unknown joint type \"hinge\""],
    );
}

fn four_bar_json() -> String {
    let value: Value = toml::from_str(&four_bar()).unwrap();
    serde_json::to_string_pretty(&value).unwrap()
}

#[test]
fn json_is_read_like_toml() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("four-bar.json");
    fs::write(&path, four_bar_json()).unwrap();
    let path = path.to_str().unwrap();
    // What to do next names the file.
    let from = |file: &str| json(&["analyze", file, "--format", "json"])["states"].take();
    assert_eq!(from(path), from("four-bar"));
    assert_eq!(
        out(&["search", path, "--format", "json"]),
        out(&["search", "four-bar", "--format", "json"])
    );
}

#[test]
fn error_in_json() {
    let text = four_bar_json();
    bad_file(
        "bad.json",
        &text.replacen("\"revolute\"", "\"hinge\"", 1),
        "hinge",
        &["unknown joint type \"hinge\""],
    );
    bad_file(
        "bad.json",
        &text.replacen("\"drive\": true", "\"drive\": true true", 1),
        "true true",
        &["expected"],
    );
    bad_file(
        "bad.json",
        &text.replacen("\"drive\": true", "\"drive\": 7", 1),
        "\"drive\": 7",
        &["boolean"],
    );
    bad_file(
        "bad.json",
        &text.replacen("\"drive\"", "\"driven\"", 1),
        "driven",
        &["driven"],
    );
    bad_file(
        "bad.json",
        &text.replacen("\"frame\"", "\"fram\"", 1),
        "\"fram\"",
        &["unknown role \"fram\""],
    );
}

/// Asserts that the bytes are refused with these words; there is no line to name.
fn bad_bytes(bytes: &[u8], parts: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    for name in ["bad.toml", "bad.json"] {
        let path = folder.path().join(name);
        fs::write(&path, bytes).unwrap();
        let said = refused(&["check", path.to_str().unwrap()], parts);
        assert!(said.contains(name));
    }
}

#[test]
fn error_too_large() {
    bad_bytes(
        &vec![b'#'; (4 << 20) + 1],
        &["4194305 bytes", "4194304 allowed"],
    );
}

#[test]
fn error_not_utf8() {
    bad_bytes(b"name = \"\xff\"\n", &["not UTF-8", "byte 8"]);
}

#[test]
fn error_empty_file() {
    bad_bytes(b"", &["the file is empty"]);
    bad_bytes(b" \n\n", &["the file is empty"]);
}

#[test]
fn error_missing_file_and_unknown_name() {
    refused(
        &["check", "/no/such/file.toml"],
        &[
            "/no/such/file.toml",
            "neither a file nor a built-in mechanism",
        ],
    );
    refused(
        &["analyze", "gripper-1"],
        &["gripper-1", "did you mean", "gripper-10", "ozols list"],
    );
    refused(&["search", "zzz"], &["zzz is neither"]);
    refused(&["show", "zzz"], &["zzz is not a built-in mechanism"]);
    let folder = tempfile::tempdir().unwrap();
    refused(&["check", folder.path().to_str().unwrap()], &["neither"]);
}

#[test]
fn error_names_on_the_command_line() {
    refused(
        &["search", "gripper-10", "--options", "revolute,hinge"],
        &["--options", "hinge", "universal-y"],
    );
    refused(
        &["search", "gripper-10", "--allow", "2-3=hinge"],
        &["--allow", "hinge", "universal-y"],
    );
    refused(
        &["search", "gripper-10", "--allow", "2-3"],
        &["--allow needs names"],
    );
    refused(
        &["search", "gripper-10", "--allow", "x-y=revolute"],
        &["--allow", "no joint x-y"],
    );
    refused(
        &["search", "gripper-10", "--forbid", "2-3=hinge"],
        &["--forbid", "hinge"],
    );
    refused(
        &["search", "gripper-10", "--forbid", "x-y"],
        &["--forbid", "no joint x-y"],
    );
    refused(
        &["search", "gripper-10", "--hold", "zz"],
        &["--hold", "no link zz"],
    );
    refused(
        &["search", "gripper-10", "--state", "zz"],
        &["no state zz", "free, clamped"],
    );
    refused(
        &["analyze", "gripper-10", "--state", "zz"],
        &["no state zz", "free, clamped"],
    );
    refused(
        &["search", "four-bar", "--max-external", "0"],
        &["no state besides free"],
    );
}

#[test]
fn allow_forbid_hold_narrow_the_space() {
    let space = |more: &[&str]| {
        let args = [
            &["search", "gripper-10", "--count", "--format", "json"][..],
            more,
        ]
        .concat();
        let o = run(&args);
        assert_ne!(o.status.code(), Some(2));
        count(&serde_json::from_slice::<Value>(&o.stdout).unwrap()["space"])
    };
    assert_eq!(space(&["--forbid", "2-3"]), 7u64.pow(11));
    assert_eq!(
        space(&["--forbid", "2-3=spherical,universal"]),
        7u64.pow(11) * 5
    );
    assert_eq!(space(&["--allow", "2-3=spherical"]), 7u64.pow(11) * 2);
    assert_eq!(space(&["--hold", "2"]), 7u64.pow(12));
}

// Files written.

#[test]
fn output_into_a_missing_folder_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("none/x.json");
    refused(
        &["search", "four-bar", "-o", path.to_str().unwrap()],
        &["cannot write", "none/x.json"],
    );
    refused(
        &["analyze", "four-bar", "-o", path.to_str().unwrap()],
        &["cannot write", "none/x.json"],
    );
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn output_file_is_whole() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x");
    let file = path.to_str().unwrap();
    for args in [
        &["search", "four-bar", "--format", "json"][..],
        &["search", "four-bar", "--all", "--format", "csv"],
        &["search", "four-bar"],
        &["analyze", "four-bar", "--format", "json"],
        &["analyze", "four-bar"],
    ] {
        assert_eq!(out(&[args, &["-o", file]].concat()), "");
        assert_eq!(fs::read_to_string(&path).unwrap(), out(args), "{args:?}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

// The same every time.

#[test]
fn threads_do_not_matter() {
    for format in ["text", "json", "csv"] {
        let by = |threads| {
            out(&[
                "search",
                "gripper-10",
                "--threads",
                threads,
                "--format",
                format,
            ])
        };
        let one = by("1");
        assert_eq!(one, by("2"), "{format}");
        assert_eq!(one, by("8"), "{format}");
    }
}

#[test]
fn samples_repeat_with_the_seed() {
    let sample = |seed| {
        out(&[
            "search",
            "gripper-10",
            "--sample",
            "20",
            "--seed",
            seed,
            "--format",
            "csv",
        ])
    };
    let one = sample("1");
    assert_eq!(one.lines().count(), 21);
    assert_eq!(one, sample("1"));
    assert_ne!(one, sample("2"));
}

// The contract of the formats, design.md section 4.

#[test]
fn keys_of_analyze() {
    let v = json(&["analyze", "gripper-10", "--format", "json"]);
    assert_eq!(v["mechanism"], "gripper-10");
    let states = v["states"].as_array().unwrap();
    assert_eq!(
        states
            .iter()
            .map(|s| s["state"].as_str().unwrap())
            .collect::<Vec<_>>(),
        ["free", "clamped"]
    );
    for s in states {
        for k in [
            "links",
            "joints",
            "contours",
            "freedoms",
            "rank",
            "mobility",
            "working_mobility",
            "local_mobility",
            "redundant",
        ] {
            assert!(s[k].is_i64() || s[k].is_u64(), "{k}");
        }
        for k in ["method", "certainty"] {
            assert!(s[k].is_string(), "{k}");
        }
        for c in s["per_contour"].as_array().unwrap() {
            assert!(c["joints"][0].is_string() && c["redundant"].is_number());
        }
        assert!(s.as_object().unwrap().contains_key("external"));
    }
    for k in [
        "constraints",
        "actual_mobility",
        "working_mobility",
        "lost_mobility",
        "redundant",
    ] {
        assert!(states[1]["external"][k].is_number(), "{k}");
    }
}

#[test]
fn keys_of_search() {
    let v: Value = serde_json::from_str(&small_out(&["--format", "json", "--top", "3"])).unwrap();
    for k in ["space", "determinate", "admissible"] {
        assert!(count(&v[k]) > 0, "{k}");
    }
    for k in ["by_mobility", "admissible_by_mobility"] {
        let by = v[k].as_object().unwrap();
        assert!(
            by.iter()
                .all(|(w, n)| w.parse::<i64>().is_ok() && count(n) > 0),
            "{k}"
        );
    }
    assert!(v["largest_layer"].is_u64() && v["nodes"].is_u64() && v["stop"].is_string());
    let variants = v["variants"].as_array().unwrap();
    assert_eq!(variants.len(), 3);
    for (i, x) in variants.iter().enumerate() {
        assert_eq!(x["position"], i + 1);
        assert!(x["cost"].is_number() && x["scores"].is_object());
        assert!(x["mobility"].is_i64() && x["redundant"] == 0);
        for c in x["changes"].as_array().unwrap() {
            assert!(c["joint"].is_string() && c["from"] == "revolute" && c["to"] == "spherical");
        }
    }
    let costs: Vec<f64> = variants
        .iter()
        .map(|x| x["cost"].as_f64().unwrap())
        .collect();
    assert!(costs.is_sorted());
}

#[test]
fn top_0() {
    let v: Value = serde_json::from_str(&small_out(&["--format", "json", "--top", "0"])).unwrap();
    assert_eq!(v["variants"], serde_json::json!([]));
    assert_eq!(v["admissible"], "56");
    assert_eq!(
        small_out(&["--format", "csv", "--top", "0"])
            .lines()
            .count(),
        1
    );
    assert_eq!(small_out(&["--top", "0"]), small_out(&["--count"]));
}

#[test]
fn all_gives_the_admissible_ones() {
    let csv = small_out(&["--all", "--format", "csv"]);
    let mut rows: Vec<&str> = csv
        .lines()
        .skip(1)
        .map(|l| l.split_once(',').unwrap().1)
        .collect();
    assert_eq!(rows.len(), 56);
    rows.sort_unstable();
    rows.dedup();
    assert_eq!(rows.len(), 56, "no variant twice");
    assert_eq!(
        small_out(&["--all", "--format", "jsonl"]).lines().count(),
        56
    );
    let v: Value = serde_json::from_str(&small_out(&["--all", "--format", "json"])).unwrap();
    assert_eq!(v["variants"].as_array().unwrap().len(), 56);
}

#[test]
fn csv_columns() {
    let csv = small_out(&["--format", "csv"]);
    let lines: Vec<Vec<&str>> = csv.lines().map(|l| l.split(',').collect()).collect();
    let joints = [
        "1-2", "2-3", "3-0", "2-4", "4-5", "5-1", "1-6", "6-7", "7-0", "6-8", "8-9", "9-1",
    ];
    assert_eq!(
        lines[0][..6],
        [
            "position",
            "cost",
            "mobility",
            "redundant",
            "external_redundant",
            "changes"
        ]
    );
    assert_eq!(lines[0][6..18], joints);
    assert_eq!(lines[0][18..], ["conditioning", "agree", "lucky"]);
    assert_eq!(lines.len(), 11);
    for l in &lines[1..] {
        assert_eq!((l.len(), l[19]), (21, "true"));
        let changed = l[6..18].iter().filter(|t| **t != "revolute").count();
        assert_eq!(l[5], changed.to_string());
    }
}

// Orbits under the mirror image: (all + symmetric) / 2, by Burnside's lemma.
#[test]
fn symmetry_counts() {
    let counts = |more: &[&str]| {
        let args = small(&[&["--count", "--format", "json"][..], more].concat());
        let o = run(&args.iter().map(String::as_str).collect::<Vec<_>>());
        assert_ne!(o.status.code(), Some(2));
        let v: Value = serde_json::from_slice(&o.stdout).unwrap();
        (count(&v["determinate"]), count(&v["admissible"]))
    };
    for more in [&[][..], &["--allow-output-change"]] {
        let with = |flag: &'static str| counts(&[more, &[flag]].concat());
        let (all, symmetric, orbits) = (counts(more), with("--symmetric"), with("--one-per-orbit"));
        assert_eq!(
            orbits,
            ((all.0 + symmetric.0) / 2, (all.1 + symmetric.1) / 2)
        );
        let listed =
            small_out(&[&["--all", "--one-per-orbit", "--format", "csv"][..], more].concat());
        assert_eq!(listed.lines().count() as u64 - 1, orbits.1);
    }
}

#[test]
fn schema_is_json() {
    let v = json(&["schema"]);
    assert!(v["properties"]["joint"].is_object() && v["properties"]["link"].is_object());
}

#[test]
fn show_round_trips_through_standard_input() {
    let shown = four_bar();
    let o = ozols(&["check", "-"])
        .write_stdin(shown.clone())
        .output()
        .unwrap();
    assert_eq!((o.status.code(), text(&o.stderr).as_str()), (Some(0), ""));
    assert_eq!(text(&o.stdout), out(&["check", "four-bar"]));
    let o = ozols(&["analyze", "-", "--format", "json"])
        .write_stdin(shown)
        .output()
        .unwrap();
    let mut read: Value = serde_json::from_slice(&o.stdout).unwrap();
    let mut named = json(&["analyze", "four-bar", "--format", "json"]);
    // What to do next names the file.
    for v in [&mut read, &mut named] {
        v["next"].take();
    }
    assert_eq!(read, named);
    let o = ozols(&["check", "-"])
        .write_stdin("x = [")
        .output()
        .unwrap();
    assert_eq!(o.status.code(), Some(2));
    assert!(text(&o.stderr).contains("standard input:1:"));
}

// `ozols search ... | head -1`
#[test]
fn a_closed_pipe_is_quiet() {
    for format in ["csv", "jsonl"] {
        let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_ozols"))
            .args(["search", "gripper-10", "--all", "--format", format])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut first = String::new();
        BufReader::new(child.stdout.take().unwrap())
            .read_line(&mut first)
            .unwrap();
        assert!(!first.is_empty());
        let mut said = String::new();
        child
            .stderr
            .take()
            .unwrap()
            .read_to_string(&mut said)
            .unwrap();
        assert_eq!(said, "");
        assert!(child.wait().unwrap().success());
    }
}

// Once wrong: the temporary file is renamed over whatever PATH is. As root, `-o /dev/null` replaces the
// device by an ordinary file; a FIFO stands for it here. Never try this with a real device.
#[cfg(unix)]
#[test]
fn output_to_a_special_file_keeps_it() {
    use std::os::unix::fs::FileTypeExt;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fifo");
    assert!(
        std::process::Command::new("mkfifo")
            .arg(&path)
            .status()
            .unwrap()
            .success()
    );
    // Open at both ends, so that neither side waits.
    let _both = fs::OpenOptions::new()
        .read(true)
        .write(true)
        .open(&path)
        .unwrap();
    out(&["analyze", "four-bar", "-o", path.to_str().unwrap()]);
    assert!(fs::symlink_metadata(&path).unwrap().file_type().is_fifo());
}

// Once wrong: the same with a symbolic link: the link is replaced, its target keeps the old content.
#[cfg(unix)]
#[test]
fn output_through_a_symbolic_link() {
    let folder = tempfile::tempdir().unwrap();
    let (real, link) = (folder.path().join("real"), folder.path().join("link"));
    fs::write(&real, "old").unwrap();
    std::os::unix::fs::symlink(&real, &link).unwrap();
    out(&["analyze", "four-bar", "-o", link.to_str().unwrap()]);
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(
        fs::read_to_string(&real).unwrap(),
        out(&["analyze", "four-bar"])
    );
}

// Once wrong: a nonzero value that underflows to 0.0 as f64 passes the range check.
#[test]
fn error_coordinate_underflow() {
    bad_file(
        "bad.toml",
        &with("[80, 90, 0]", "[80, \"1e-9^60\", 0]"),
        "[80, ",
        &["out of range"],
    );
}

// BUG (toml through the untagged Coordinate): "invalid type: integer `...` as i128, expected any value".
#[test]
fn error_coordinate_overflow_in_words() {
    bad_file(
        "bad.toml",
        &with("[80, 90, 0]", "[80, 99999999999999999999, 0]"),
        "[80, ",
        &["number"],
    );
}

// Once wrong: every name contains the empty one, so all are "near".
#[test]
fn error_empty_name() {
    assert!(!refused(&["check", ""], &["neither a file"]).contains("did you mean"));
}
