//! What a new user meets first: help and its examples, templates, terms, checks, the list, completions and colour.

use crate::cli::{json, out, ozols};
use ozols::builtin;
use ozols::file::text::mechanism_from_str;
use ozols::model::mechanism::StateId;
use ozols::redundancy::analysis::{Method, analyse};
use ozols::terms::Terms;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const COMMANDS: [&str; 19] = [
    "report",
    "analyze",
    "search",
    "statics",
    "grip",
    "drive",
    "verify",
    "import",
    "draw",
    "export",
    "accuracy",
    "new",
    "check",
    "list",
    "show",
    "schema",
    "explain",
    "completions",
    "man",
];

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn run(args: &[&str]) -> (Option<i32>, String, String) {
    let o: Output = ozols(args).output().unwrap();
    (o.status.code(), text(&o.stdout), text(&o.stderr))
}

// Help.

/// The example commands of a help text; two blanks part a command from what it does.
fn examples(help: &str) -> Vec<String> {
    let lines = help.lines().skip_while(|l| *l != "Examples:").skip(1);
    lines
        .filter_map(|l| l.strip_prefix("  ozols "))
        .map(|l| format!("ozols {}", l.split("  ").next().unwrap().trim()))
        .collect()
}

/// Runs a command line in a folder, as a shell would, but without one.
fn run_line(line: &str, folder: &Path) {
    let (line, into) = match line.split_once(" > ") {
        Some((l, f)) => (l, Some(f)),
        None => (line, None),
    };
    let mut words: Vec<&str> = line.split_whitespace().skip(1).collect();
    if words[0] == "accuracy" && !words.contains(&"--quick") {
        words.push("--quick");
    }
    let o = ozols(&words).current_dir(folder).output().unwrap();
    assert_eq!(o.status.code(), Some(0), "{line}: {}", text(&o.stderr));
    if let Some(file) = into {
        fs::write(folder.join(file), &o.stdout).unwrap();
    }
}

fn run_examples(command: &str) {
    let help = match command {
        "" => out(&["--help"]),
        c => out(&[c, "--help"]),
    };
    let examples = examples(&help);
    assert!(!examples.is_empty(), "{command} has no examples");
    let folder = tempfile::tempdir().unwrap();
    // What users bring along themselves.
    let robot = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/robots/epr_5bar_linkage");
    for file in ["robot.urdf", "robot.yaml"] {
        fs::copy(robot.join(file), folder.path().join(file)).unwrap();
    }
    for line in examples {
        run_line(&line, folder.path());
    }
}

#[test]
fn examples_of_the_main_help_run() {
    run_examples("");
}

#[test]
fn examples_of_every_command_run() {
    for command in COMMANDS.iter().filter(|c| **c != "accuracy") {
        run_examples(command);
    }
}

#[test]
fn examples_of_accuracy_run() {
    run_examples("accuracy");
}

#[test]
fn the_commands_are_all_here() {
    let help = out(&["--help"]);
    let commands = help.split("Commands:\n").nth(1).unwrap();
    let commands = commands.split("\n\n").next().unwrap();
    let mut named: Vec<&str> = commands
        .lines()
        .filter(|l| l.starts_with("  ") && !l.starts_with("   "))
        .filter_map(|l| l.split_whitespace().next())
        .filter(|c| *c != "help")
        .collect();
    let mut all = COMMANDS.to_vec();
    named.sort_unstable();
    all.sort_unstable();
    assert_eq!(named, all);
    assert!(help.contains("Exit codes: 0 done; 1 nothing found"));
}

#[test]
fn the_program_alone_says_where_to_begin() {
    let said = out(&[]);
    for line in said.lines().filter_map(|l| l.strip_prefix("  ozols ")) {
        let command = line.split_whitespace().next().unwrap();
        assert!(
            command == "--help" || COMMANDS.contains(&command),
            "{command}"
        );
    }
    assert!(said.lines().count() < 12, "{said}");
    // An option without a command is still a mistake.
    assert_eq!(run(&["--quiet"]).0, Some(2));
}

// new

#[test]
fn a_template_of_every_built_in_mechanism_gives_its_figures() {
    for name in builtin::names() {
        let given = builtin::text(name).unwrap();
        let new = ozols::file::template::commented(given, name, "mine").unwrap();
        let figures = |text: &str| {
            let m = mechanism_from_str("mine.toml", text).unwrap();
            let states: Vec<StateId> = m.state_ids().collect();
            let of = analyse(&m, &states, Method::Modular).unwrap();
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
                .collect::<Vec<_>>()
        };
        assert_eq!(figures(given), figures(&new), "{name}");
    }
}

#[test]
fn a_new_file_is_checked_and_analysed_like_the_one_it_is_made_of() {
    let folder = tempfile::tempdir().unwrap();
    for from in [
        "four-bar",
        "gripper-10-loaded",
        "lever-gripper",
        "torsion-module",
        "parallel-shears",
    ] {
        let path = folder.path().join(format!("my {from}.toml"));
        let path = path.to_str().unwrap();
        let said = out(&["new", path, "--from", from]);
        assert!(said.contains("ozols check"), "{said}");
        let (code, _, err) = run(&["check", path]);
        assert_eq!((code, err.as_str()), (Some(0), ""), "{from}");
        let analysis = |file: &str| {
            let mut v = json(&["analyze", file, "--format", "json"]);
            v["next"].take(); // names the file
            (v["mechanism"].take(), v)
        };
        let (name, mine) = analysis(path);
        assert_eq!(name, format!("my {from}"));
        assert_eq!(mine, analysis(from).1);
    }
}

#[test]
fn a_new_file_never_takes_the_place_of_another_unasked() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    let file = path.to_str().unwrap();
    fs::write(&path, "mine").unwrap();
    let (code, stdout, err) = run(&["new", file]);
    assert_eq!((code, stdout.as_str()), (Some(2), ""));
    assert!(
        err.contains("is there already") && err.contains("--force"),
        "{err}"
    );
    assert_eq!(fs::read_to_string(&path).unwrap(), "mine");
    assert_eq!(out(&["new", file, "--force", "--quiet"]), "");
    assert!(
        fs::read_to_string(&path)
            .unwrap()
            .contains("\nname = \"mine\"")
    );
}

#[test]
fn a_new_file_needs_a_known_mechanism_and_a_toml_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    for (from, meant) in [
        ("fourbar", "four-bar"),
        ("benett", "bennett"),
        ("gripper10", "gripper-10"),
    ] {
        let (code, _, err) = run(&["new", path.to_str().unwrap(), "--from", from]);
        assert_eq!(code, Some(2), "{err}");
        assert!(err.contains("did you mean") && err.contains(meant), "{err}");
        assert!(!path.exists());
    }
    for name in ["mine", "mine.json"] {
        let (code, _, err) = run(&["new", folder.path().join(name).to_str().unwrap()]);
        assert_eq!(code, Some(2));
        assert!(err.contains("mine.toml"), "{err}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

// explain

#[test]
fn every_term_shows_itself_by_a_command_that_runs() {
    let folder = tempfile::tempdir().unwrap();
    let mut commands: Vec<String> = Terms::builtin().term.into_iter().map(|t| t.see).collect();
    commands.sort();
    commands.dedup();
    for c in commands {
        assert!(c.starts_with("ozols "), "{c}");
        run_line(&c, folder.path());
    }
    assert_eq!(
        fs::read_dir(folder.path()).unwrap().count(),
        0,
        "a command wrote a file"
    );
}

#[test]
fn terms_are_explained_by_name_sign_and_list() {
    let sigma = out(&["explain", "sigma"]);
    for part in [
        "6k - rank",
        "related",
        "see      ozols analyze",
        "source   O. G. Ozols",
    ] {
        assert!(sigma.contains(part), "{part}: {sigma}");
    }
    assert_eq!(out(&["explain", "σ"]), sigma);
    assert_eq!(out(&["explain", "Σ"]), sigma);
    assert_eq!(
        out(&["explain", "redundant", "constraint"]),
        out(&["explain", "redundant-constraint"])
    );
    let all = out(&["explain"]);
    let terms = Terms::builtin();
    assert!(terms.term.len() >= 40);
    for t in &terms.term {
        assert!(
            all.lines().any(|l| l.trim_start().starts_with(&t.name)),
            "{}",
            t.name
        );
    }
    let (code, stdout, err) = run(&["explain", "redundent constraint"]);
    assert_eq!((code, stdout.as_str()), (Some(2), ""));
    assert!(
        err.contains("did you mean") && err.contains("redundant constraint"),
        "{err}"
    );
}

// completions and man

#[test]
fn every_shell_gets_a_script_and_bash_can_read_its_own() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = out(&["completions", shell]);
        for command in COMMANDS {
            assert!(script.contains(command), "{shell}: {command}");
        }
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ozols.bash");
    fs::write(&path, out(&["completions", "bash"])).unwrap();
    let Ok(o) = Command::new("bash").arg("-n").arg(&path).output() else {
        return; // no bash here
    };
    assert!(o.status.success(), "{}", text(&o.stderr));
    assert_eq!(run(&["completions", "tcsh"]).0, Some(2));
}

#[test]
fn man_pages_are_pages_and_name_every_command() {
    let main = out(&["man"]);
    let titled = |page: &str| page.starts_with(".TH ozols") && page.matches(".ie ").count() == 1;
    assert!(titled(&main));
    for command in COMMANDS {
        assert!(main.contains(&format!("ozols\\-{command}(1)")), "{command}");
    }
    let folder = tempfile::tempdir().unwrap();
    let into = folder.path().join("man1");
    assert_eq!(out(&["man", "-o", into.to_str().unwrap()]), "");
    assert_eq!(fs::read_to_string(into.join("ozols.1")).unwrap(), main);
    for command in COMMANDS {
        let page = fs::read_to_string(into.join(format!("ozols-{command}.1"))).unwrap();
        assert!(titled(&page), "{command}");
        assert!(
            page.contains("EXAMPLES") && page.contains(&format!("ozols {command}")),
            "{page}"
        );
    }
    assert_eq!(fs::read_dir(&into).unwrap().count(), COMMANDS.len() + 1);
}

// Colour.

#[test]
fn colour_is_off_where_no_terminal_is_and_on_where_it_is_forced() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bad.toml");
    fs::write(&path, "name = \"x\"\nlonk = 1\n").unwrap();
    let bad = path.to_str().unwrap();
    for args in [
        &["check", bad][..],
        &["analyze", "nosuch"],
        &["nonsense"],
        &["search", "--help"],
    ] {
        let said = |set: &[(&str, &str)]| {
            let mut command = ozols(args);
            for name in ["NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE"] {
                command.env_remove(name);
            }
            let o = command.envs(set.iter().copied()).output().unwrap();
            text(&o.stdout) + &text(&o.stderr)
        };
        let plain = said(&[]);
        assert!(!plain.contains('\x1b'), "{args:?}: {plain}");
        assert!(
            said(&[("CLICOLOR_FORCE", "1")]).contains('\x1b'),
            "{args:?}"
        );
        assert_eq!(
            said(&[("CLICOLOR_FORCE", "1"), ("NO_COLOR", "1")]),
            plain,
            "{args:?}"
        );
    }
}

/// `script` of util-linux gives a command a terminal.
#[cfg(target_os = "linux")]
#[test]
fn on_a_terminal_colour_obeys_no_color() {
    let on_a_terminal = |args: &str, no_color: bool| {
        let mut command = Command::new("script");
        command.args([
            "-qec",
            &format!("{} {args}", env!("CARGO_BIN_EXE_ozols")),
            "/dev/null",
        ]);
        command
            .env("TERM", "xterm")
            .env_remove("CLICOLOR_FORCE")
            .env_remove("CLICOLOR");
        match no_color {
            true => command.env("NO_COLOR", "1"),
            false => command.env_remove("NO_COLOR"),
        };
        command
            .stdin(std::process::Stdio::null())
            .output()
            .ok()
            .map(|o| text(&o.stdout))
    };
    for args in ["analyze nosuch", "nonsense", "list --help"] {
        let Some(coloured) = on_a_terminal(args, false) else {
            return; // no such command here
        };
        assert!(coloured.contains("\x1b["), "{args}: {coloured}");
        let plain = on_a_terminal(args, true).unwrap();
        assert!(!plain.contains("\x1b["), "{args}: {plain}");
    }
    // A table fits the terminal; `script` gives 80 columns or what stty says.
    let listed = on_a_terminal("list", true).unwrap();
    assert!(listed.contains("bennett"), "{listed}");
    assert!(
        listed.lines().all(|l| l.trim_end().chars().count() <= 120),
        "{listed}"
    );
}

// check

fn four_bar_with(from: &str, to: &str) -> String {
    let text = builtin::text("four-bar").unwrap();
    assert!(text.contains(from), "{from}");
    text.replacen(from, to, 1)
}

/// Checks a text that can be used: what is said on standard output and on standard error.
fn checked(text: &str) -> (String, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    fs::write(&path, text).unwrap();
    let (code, said, warned) = run(&["check", path.to_str().unwrap()]);
    assert_eq!(code, Some(0), "{warned}");
    (said, warned)
}

#[test]
fn check_says_what_a_file_describes() {
    let said = out(&["check", "gripper-10-loaded"]);
    for part in [
        "gripper-10-loaded: valid",
        "11 links (frame 0; outputs 4, 8; object a), in space",
        "15 joints: 12 revolute, 2 fixed, 1 cylindrical; driven at 0-1",
        "2 states: free with 4 contours, clamped with 5 contours",
        "12 joints with 7 options, 1 place for an unloading joint, 6 mirror pairs; 13,841,287,201 choices",
        "workload: gravity, 9 links with mass, 4 forces, ranking by peak-moment",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
    assert!(out(&["check", "lever-gripper"]).contains("`ozols grip`"));
    assert!(out(&["check", "torsion-module"]).contains("`ozols drive`"));
    assert!(out(&["check", "four-bar-planar"]).contains("in the plane"));
}

#[test]
fn check_doubts_what_is_likely_a_slip() {
    for (from, to, line, parts) in [
        (
            "length_unit = \"mm\"\n",
            "",
            "name =",
            &["150 m across", "length_unit = \"mm\""][..],
        ),
        (
            "\"mm\"",
            "\"m\"",
            "length_unit",
            &["150 m across", "is meant"],
        ),
        (
            "point = [80, 90, 0]",
            "point = [0, 30.00001, 0]",
            "30.00001",
            &["\"1-2\" and \"2-3\"", "same point"],
        ),
        (
            "point = [80, 90, 0]",
            "point = [80.0123456789, 90, 0]",
            "[[joint]]",
            &["measured", "--snap"],
        ),
        (
            "\"spherical\"]",
            "\"prismatic\"]",
            "\"prismatic\"]",
            &["no joint can take the option \"prismatic\""],
        ),
        (
            "[search]\n",
            "[search]\nunloading = [\"spherical\"]\n",
            "unloading =",
            &["no effect", "unloading = true"],
        ),
        (
            "drive = true",
            "drive = true\nunloading = true",
            "unloading = true",
            &["\"0-1\" allows", "[search] lists none"],
        ),
        (
            "drive = true",
            "drive = true\nforbid = [\"sferical\"]",
            "forbid",
            &["forbids \"sferical\""],
        ),
        (
            "redundant = 3",
            "redundant = 2",
            "redundant = 2",
            &["redundant = 2 in state free", "finds 3"],
        ),
        (
            "[search]\n",
            "[workload]\ngravity = [0, -9.81, 0]\n[search]\n",
            "gravity",
            &["no link has a mass"],
        ),
        (
            "id = \"1\"\n",
            "id = \"1\"\nmass = 1\ncentre = [0, 0, 0]\n",
            "mass = 1",
            &["no effect without gravity"],
        ),
        (
            "[search]\n",
            "[ranking]\nterms = [{ term = \"peak-force\" }]\n[search]\n",
            "terms =",
            &["peak-force", "nothing loads"],
        ),
        (
            "# rocker on",
            "[[joint]]\nid = \"x\"\nlinks = [\"2\", \"1\"]\ntype = \"revolute\"\npoint = [0, 30, 0]\naxis = [0, 0, 1]\n# rocker on",
            "[\"2\", \"1\"]",
            &["\"1-2\" and \"x\" are the same joint"],
        ),
        (
            "[[contour]]\n",
            "[[contour]]\njoints = [\"2-3\", \"1-2\", \"0-1\", \"3-0\"]  # turned
[[contour]]
",
            "joints = [\"0-1\"",
            &["follows from the others"],
        ),
        (
            "[[contour]]\n",
            "[[link]]\nid = \"z\"\n[[joint]]\nid = \"3-z\"\nlinks = [\"3\", \"z\"]\ntype = \"revolute\"\npoint = [9, 9, 9]\naxis = [0, 0, 1]\n[[contour]]\n",
            "[[joint]]\nid = \"3-z\"",
            &["no contour passes through 3-z"],
        ),
        (
            "[[contour]]\n",
            "[[link]]\nid = \"z\"\n[[joint]]\nid = \"3-z\"\nlinks = [\"3\", \"z\"]\ntype = \"fixed\"\npoint = [9, 9, 9]\n[[contour]]\n",
            "type = \"fixed\"",
            &["\"3-z\" is fixed in every state", "\"3\" and \"z\""],
        ),
        (
            "[[contour]]\n",
            "[[link]]\nid = \"z\"\nrole = \"object\"\n[[joint]]\nid = \"3-z\"\nlinks = [\"3\", \"z\"]\ntype = \"fixed\"\npoint = [9, 9, 9]\nstate = \"held\"\n[[contour]]\n",
            "id = \"z\"",
            &["\"z\" has a single joint in state held"],
        ),
    ] {
        let file = four_bar_with(from, to);
        let (said, warned) = checked(&file);
        for p in parts {
            assert!(warned.contains(p), "{to}: no {p:?} in: {warned}");
        }
        assert!(
            warned.starts_with("warning: ") && said.contains("warning"),
            "{warned}"
        );
        let at = file.find(line).unwrap();
        let n = file[..at].matches('\n').count() + 1;
        assert!(
            warned.contains(&format!("mine.toml:{n}:")),
            "no line {n} in: {warned}"
        );
    }
}

/// What the built-in files are doubted for is so: common options that suit none of their joints, and an arm.
#[test]
fn check_doubts_built_in_mechanisms_only_with_reason() {
    use ozols::file::lint::{DoubtKind, check};
    let mut doubted = 0;
    for name in builtin::names() {
        let text = builtin::text(name).unwrap();
        let checked = check(&format!("{name}.toml"), text.as_bytes()).unwrap();
        doubted += usize::from(!checked.doubts.doubts.is_empty());
        for d in &checked.doubts.doubts {
            let known = match &d.kind {
                DoubtKind::UselessOption { option } => {
                    let named = |n: &String| n == option;
                    let m = &checked.mechanism;
                    !m.joints
                        .iter()
                        .any(|j| j.options.iter().any(|o| named(&o.name)))
                }
                DoubtKind::OpenChain { .. } => name == "pantograph",
                _ => false,
            };
            assert!(known, "{name}: {}", checked.doubts.render(false));
        }
    }
    assert!(doubted * 10 < builtin::names().len(), "{doubted}");
}

#[test]
fn check_is_quiet_when_asked() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    fs::write(&path, four_bar_with("redundant = 3", "redundant = 2")).unwrap();
    let (code, said, warned) = run(&["check", "--quiet", path.to_str().unwrap()]);
    assert_eq!((code, warned.as_str()), (Some(0), ""));
    assert!(said.contains("1 warning"), "{said}");
}

// list

#[test]
fn the_list_is_by_family_and_can_be_narrowed() {
    let all = out(&["list"]);
    for name in builtin::names() {
        assert!(
            all.lines()
                .any(|l| l.split_whitespace().next() == Some(name)),
            "{name}"
        );
    }
    for (family, members) in builtin::families() {
        let after = all.split(&format!("\n{family}\n")).nth(1).unwrap();
        assert_eq!(
            after.split_whitespace().next(),
            Some(members[0]),
            "{family}"
        );
    }
    let rows = |args: &[&str]| {
        let listed = out(args);
        let rows = listed
            .lines()
            .skip(2)
            .filter(|l| l.starts_with("  ") && !l.starts_with("   "));
        rows.map(|l| l.split_whitespace().next().unwrap().to_owned())
            .collect::<Vec<_>>()
    };
    assert_eq!(
        rows(&["list", "bennett"]),
        [
            "bennett",
            "bennett-perturbed",
            "two-bennetts",
            "waldron-hybrid"
        ]
    );
    assert_eq!(rows(&["list", "BENNETT", "rigid"]), ["bennett-perturbed"]);
    assert!(rows(&["list", "robot"]).contains(&"delta".to_owned()));
    let line = out(&["list", "four-bar"]);
    assert!(
        line.contains("Planar crank-rocker four-bar as a spatial mechanism"),
        "{line}"
    );
    let (code, stdout, err) = run(&["list", "benett"]);
    assert_eq!((code, stdout.as_str()), (Some(1), ""));
    assert!(
        err.contains("benett") && err.contains("did you mean bennett"),
        "{err}"
    );
}
