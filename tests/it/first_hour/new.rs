//! `new` and `list`: templates of every built-in mechanism.

use crate::common::*;
// new

#[test]
fn a_template_of_every_built_in_mechanism_gives_its_figures() {
    for name in builtin::names() {
        let given = builtin::text(name).unwrap();
        let new = ozols::file::template::with_comments(given, name, "mine").unwrap();
        let figures = |text: &str| {
            let m = read(text);
            let states: Vec<StateId> = m.state_ids().collect();
            let of = analyse_states(&m, &states, Method::Modular).unwrap();
            of.into_iter()
                .map(|s| {
                    (
                        s.state,
                        s.links,
                        s.joints,
                        s.freedoms,
                        s.rank,
                        s.working_mobility,
                        s.redundant,
                    )
                })
                .collect_vec()
        };
        assert_eq!(figures(given), figures(&new), "{name}");
    }
}

#[test]
fn a_new_file_is_checked_and_analysed_like_the_one_it_is_made_of() {
    let folder = Folder::new();
    for from in
        split_words("four-bar gripper-10-loaded lever-gripper torsion-module parallel-shears")
    {
        let file = &format!("my {from}.toml");
        let (said, _) = folder.succeed(&["new", file, "--from", from]);
        has(&said, "ozols check");
        assert_eq!(folder.succeed(&["check", file]).1, "", "{from}");
        let analysis = |file: &str| {
            let mut v = folder.json(&["analyze", file]);
            v["next"].take(); // names the file
            (v["mechanism"].take(), v)
        };
        let (name, mine) = analysis(file);
        assert_eq!(name, format!("my {from}"));
        assert_eq!(mine, analysis(from).1);
    }
}

#[test]
fn a_new_file_never_takes_the_place_of_another_unasked() {
    let folder = Folder::with("mine.toml", "mine");
    folder.assert_fails("new mine.toml", "already exists");
    folder.assert_fails("new mine.toml", "--force");
    assert_eq!(folder.text("mine.toml"), "mine");
    let (out, said) = folder.succeed("new mine.toml --force --quiet");
    assert_eq!(out + &said, "");
    has(&folder.text("mine.toml"), "\nname = \"mine\"");
}

#[test]
fn a_new_file_needs_a_known_mechanism_and_a_toml_name() {
    let folder = Folder::new();
    for [line, said] in read_cases::<2>(
        "mine.toml --from fourbar | did you mean four-bar
        mine.toml --from benett | did you mean bennett
        mine.toml --from gripper10 | did you mean gripper-10
        mine | mine.toml
        mine.json | mine.toml",
    ) {
        folder.assert_fails(&format!("new {line}"), said);
    }
    assert_eq!(folder.names(), [""; 0]);
}

#[test]
fn new_without_a_file_lists_what_to_start_from() {
    let (code, said, err) = run_full("new");
    assert_eq!(code, Some(0));
    assert_eq!(said, run_quiet("list"));
    has(&err, "ozols new mine.toml --from NAME");
    assert_fails("new --from four-bar", "FILE");
}

// list

#[test]
fn the_list_is_by_family_and_can_be_narrowed() {
    let all = run_quiet("list");
    for (family, members) in builtin::families() {
        let after = all.split(&format!("\n{family}\n")).nth(1).unwrap();
        assert_eq!(
            after.split_whitespace().next(),
            Some(members[0]),
            "{family}"
        );
    }
    let rows = |args: &str| {
        let listed = run_quiet(args);
        let rows = listed
            .lines()
            .skip(2)
            .filter(|l| l.starts_with("  ") && !l.starts_with("   "));
        rows.map(|l| l.split_whitespace().next().unwrap().to_owned())
            .collect_vec()
    };
    let found = split_words("bennett bennett-perturbed two-bennetts waldron-hybrid");
    assert_eq!(rows("list bennett"), found);
    assert_eq!(rows("list BENNETT rigid"), ["bennett-perturbed"]);
    assert!(rows("list robot").contains(&"delta".to_owned()));
    let line = run_quiet("list four-bar");
    has(&line, "Planar crank-rocker four-bar as a spatial mechanism");
    let (code, stdout, err) = run_full("list benett");
    assert_eq!((code, stdout.as_str()), (Some(1), ""));
    has(&err, "benett");
    has(&err, "did you mean bennett");
}
