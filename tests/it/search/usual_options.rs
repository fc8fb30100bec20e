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
    let mut alone = Vec::new();
    for name in builtin::names() {
        let line = format!("search {name} --count --format json -q --nodes 2000");
        let (found, code) = answer(&split_words(&line));
        assert!(matches!(code, Some(0 | 1 | 3)), "{name}: {code:?}");
        if found["space"] == "1" {
            alone.push(name);
        }
    }
    assert_eq!(alone, ["tongs"]);
}

/// What is offered where nothing is stated is what is found when it is stated.
#[test]
fn usual_options_count_as_stated_ones() {
    let usual = "cylindrical,universal,spherical,cylindrical-universal,sphere-in-cylinder";
    for name in split_words("jansen-leg scissor-lift-3 miura-ori roberts-cognates") {
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
    for (kind, well) in [("spherical", false), ("cylindrical", true)] {
        let o = run(&format!(
            "search planetary-gear --count -q --allow c-1={kind}"
        ));
        assert_eq!(
            o.status.code() != Some(2),
            well,
            "{kind}: {}",
            utf8_text(&o.stderr)
        );
    }
}

/// A drawer on two pairs of hinges, each pair on one line, and a rod with balls that drives it.
fn two_arms() -> String {
    write_mechanism(
        "name = \"two-arms\"\n[search]\noptions = [\"revolute\", \"cylindrical\"]",
        "frame arm*",
        "
        front | frame arm | revolute | 1, 0, 0 | 1, 0, 0
        rear | frame arm | revolute | -1, 0, 0 | 1, 0, 0
        ",
    )
}

/// Two hinges on one line hold five constraints twice, of which a ball in a tube at one of them frees four and a cylinder at the
/// other the last: neither of the types that the file offers does.
#[test]
fn the_type_that_opens_a_search_is_named_and_does() {
    let (_folder, file) = write_temporary("two-arms.toml", two_arms());
    let o = run(&["search", file]);
    assert_eq!(o.status.code(), Some(1));
    let said = utf8_text(&o.stdout);
    let command = said.lines().find(|l| l.contains("--allow")).unwrap();
    let words = command
        .split_whitespace()
        .skip(1)
        .map(|w| w.trim_matches('\''));
    let (found, code) = answer(
        &words
            .chain(["--count", "--format", "json", "-q"])
            .collect_vec(),
    );
    assert_eq!(code, Some(0), "{command}");
    assert!(parse_count(&found["admissible"]) > 0);
}

/// A hand with both rods on one pin of the slide, `apart` from each other; `more` is said of its search.
fn hand(apart: i64, more: &str) -> String {
    let options = "options = [\"revolute\", \"cylindrical\", \"universal\", \"spherical\"]";
    write_mechanism(
        &format!("name = \"hand\"\n[search]\n{options}\n{more}"),
        "0 1 2 3 4* 5*",
        &format!(
            "
            0-1 | 0 1 | prismatic | -50, 0, 0 | 1, 0, 0 | drive = true
            1-2 | 1 2 | revolute | -50, {apart}, 0 | 0, 0, 1
            1-3 | 1 3 | revolute | -50, -{apart}, 0 | 0, 0, 1
            2-4 | 2 4 | revolute | -20, 30, 0 | 0, 0, 1
            3-5 | 3 5 | revolute | -20, -30, 0 | 0, 0, 1
            0-4 | 0 4 | revolute | 0, 20, 0 | 0, 0, 1
            0-5 | 0 5 | revolute | 0, -20, 0 | 0, 0, 1
            "
        ),
    )
}

/// Joints at one place are paired by their links, and `--symmetric` needs no names: as many variants are their own images as where
/// the file names the pairs, whether the pins are apart or one.
#[test]
fn symmetric_variants_of_joints_at_one_place_are_found() {
    let named = "mirror = [[\"1-2\", \"1-3\"], [\"2-4\", \"3-5\"], [\"0-4\", \"0-5\"]]\n";
    for apart in [0, 3] {
        let mut counts = Vec::new();
        for more in ["", named] {
            let (_folder, file) = write_temporary("hand.toml", hand(apart, more));
            for how in ["--symmetric", "--one-per-orbit"] {
                let args = ["search", file, "--format", "json", "-q", "--top", "3", how];
                let (found, code) = answer(&args);
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
    let text = replace_once(&hand(3, ""), "[-20, 30, 0]", "[-21, 30, 0]");
    let (code, said, _) = run_on("search", "hand.toml", &text, "--symmetric");
    assert_eq!((code, said.as_str()), (Some(2), ""));
}

/// A hinge has 31 sets of freedoms with its own turn in them, that of a joint which is not there left out. The count of the gripper's is
/// one of a hand-written enumeration of subsets.
#[test]
fn every_set_of_freedoms_is_offered_by_one_word() {
    let any = "--options any --count --format json -q";
    let (found, _) = answer(&split_words(&format!(
        "search gripper-10 --pose-only --drives free {any}"
    )));
    assert_eq!(found["space"], 31u64.pow(12).to_string());
    assert_eq!(parse_count(&found["admissible"]), 91_391_212);
    // In a plane a hinge may slide along either axis, and what slides along both is not there.
    let (found, _) = answer(&split_words(&format!("search gripper-10-planar {any}")));
    assert_eq!(found["space"], 3u64.pow(12).to_string());
    let o = run("search four-bar --options any --no-distinct --top 3");
    assert!(utf8_text(&o.stderr).starts_with("note: every set of freedoms"));
}

/// The sets are those of an enumeration: each subset of the six freedoms with the turn of the hinge in it, whatever is left out.
#[test]
fn every_subset_of_freedoms_is_a_choice() {
    let o = run(
        "search four-bar --options any --all --allow-output-change --max-redundant 9 --format jsonl -q --check none",
    );
    let mut at_one = BTreeSet::new();
    for line in utf8_text(&o.stdout).lines() {
        let v: Value = serde_json::from_str(line).unwrap();
        if let Some([one]) = v["changes"].as_array().map(Vec::as_slice)
            && one["joint"] == "1-2"
        {
            at_one.insert(one["to"].word().to_owned());
        }
    }
    assert_eq!(at_one.len(), 30);
    // Those that a part has and no type is, with the turn about z: a blade is stiff about its normal, a nut about its screw.
    let parts = at_one.iter().filter(|name| name.ends_with("-x"));
    let parts = parts.map(String::as_str).collect_vec();
    let with_turn = [
        "ball-in-v-groove-x",
        "blade-flexure-x",
        "floating-nut-x",
        "gimbal-x",
        "wire-flexure-x",
    ];
    assert_eq!(parts, with_turn);
    assert!(at_one.contains("rz+ty") && !at_one.contains("blade-flexure-z"));
}

/// A screw jack as built has no better joint types: a nut that floats is offered in series, and the same by brute force is the one variant.
#[test]
fn a_floating_nut_is_offered_where_types_do_not_help() {
    let jack = write_mechanism(
        "name = \"jack\"",
        "base screw table*",
        "
        motor | base screw | revolute | 0, 0, 0 | 0, 0, 1 | drive = true
        nut | screw table | helical | 0, 0, 50 | 0, 0, 1 | lead = 5
        rail | table base | prismatic | 40, 0, 50 | 0, 0, 1
        ",
    );
    let (code, found) = answer_on("search", "jack.toml", &jack, "-q");
    assert_eq!(code, Some(1));
    let nuts = &found["offers"].list().last().unwrap()["unloading"];
    assert!(
        nuts.list().contains(&json!("floating-nut-z")),
        "{}",
        found["offers"]
    );
    let nut = ["--unloading", "floating-nut-z=nut", "--forbid", "nut"];
    for method in ["diagram", "brute"] {
        let more = [&nut[..], &["-q", "--method", method]].concat();
        let (_, found) = answer_on("search", "jack.toml", &jack, &more);
        assert_eq!(parse_count(&found["admissible"]), 1, "{method}");
        assert_eq!(found["admissible_by_mobility"], json!({ "1": "1" }));
    }
    let (code, _, told) = run_on(
        "search",
        "jack.toml",
        &jack,
        &["--unloading", "floating=nut"],
    );
    assert!(code == Some(2) && told.contains("floating"), "{told}");
}

/// A beam bolted to two slides needs a seat with a direction, and the seat that is offered gives what the search then finds.
#[test]
fn a_ball_in_a_groove_is_offered_at_a_bolt() {
    let beam = write_mechanism(
        "name = \"beam\"",
        "bed left right beam*",
        "
        drive | bed left | prismatic | 0, -25, 0 | 1, 0, 0 | drive = true
        guide | bed right | prismatic | 0, 25, 0 | 1, 0, 0
        bolt-1 | left beam | fixed | 0, -25, 0 | 0, 0, 1
        bolt-2 | right beam | fixed | 0, 25, 0 | 0, 0, 1
        ",
    );
    let (_, found) = answer_on("search", "beam.toml", &beam, "-q");
    let allow = found["offers"].list().iter().flat_map(|o| {
        let names = o["options"].list().iter().map(Value::word).join(",");
        [
            "--allow".to_owned(),
            format!("{}={names}", o["joint"].word()),
        ]
    });
    let allow = allow.collect_vec();
    assert!(allow.concat().contains("ball-in-v-groove-y"), "{allow:?}");
    let allow = allow.iter().map(String::as_str).collect_vec();
    let (code, found) = answer_on("search", "beam.toml", &beam, &allow);
    assert_eq!(code, Some(0));
    let best = &found["variants"][0];
    assert_eq!(
        (&best["mobility"], &best["redundant"]),
        (&json!(1), &json!(0))
    );
}
