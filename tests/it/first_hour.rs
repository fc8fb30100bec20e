//! What a new user meets first: help and its examples, templates, terms, checks, the list, completions and colour.

use crate::common::*;
mod check;
mod new;

use ozols::terms::Terms;
use std::process::Command;

const COMMANDS: &str = "lint fix report studio analyze search statics grip drive verify draw export accuracy catalog new \
    check list show schema explain completions";

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
    let words: Vec<&str> = line.split_whitespace().skip(1).collect();
    // What `accuracy` writes is looked at where the tests of charts have it written, once.
    if words[0] == "accuracy" && words.contains(&"-o") {
        return;
    }
    let o = ozols(&words).current_dir(folder).output().unwrap();
    assert_eq!(o.status.code(), Some(0), "{line}: {}", utf8_text(&o.stderr));
    if let Some(file) = into {
        fs::write(folder.join(file), &o.stdout).unwrap();
    }
}

fn run_examples(command: &str) {
    let help = match command {
        "" => run_quiet("--help"),
        c => run_quiet(&[c, "--help"]),
    };
    let examples = examples(&help);
    assert!(!examples.is_empty(), "{command} has no examples");
    let folder = tempdir().unwrap();
    // What users bring along themselves.
    let robots = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/robots");
    // Beside `robot.urdf` a file of this name is not taken for its loops.
    for (from, to) in [
        ("five_bar.urdf", "robot.urdf"),
        ("five_bar.yaml", "loops.yaml"),
    ] {
        fs::copy(robots.join(from), folder.path().join(to)).unwrap();
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
    // `fix --at` names a joint that users have; `robot_fix` tries each of its options.
    // The studio does not end by itself; `studio` tries it.
    let own = |c: &&&str| !["accuracy", "fix", "studio"].contains(*c);
    for command in split_words(COMMANDS).iter().filter(own) {
        run_examples(command);
    }
}

#[test]
fn examples_of_accuracy_run() {
    run_examples("accuracy");
}

#[test]
fn the_commands_are_all_here() {
    let help = run_quiet("--help");
    let commands = help.split("Commands:\n").nth(1).unwrap();
    let commands = commands.split("\n\n").next().unwrap();
    let mut named: Vec<&str> = commands
        .lines()
        .filter(|l| l.starts_with("  ") && !l.starts_with("   "))
        .filter_map(|l| l.split_whitespace().next())
        .filter(|c| *c != "help")
        .collect();
    let mut all = split_words(COMMANDS);
    named.sort_unstable();
    all.sort_unstable();
    assert_eq!(named, all);
    assert!(help.contains("Exit codes: 0 done; 1 nothing found"));
}

#[test]
fn the_program_alone_says_where_to_begin() {
    let said = run_quiet(&[]);
    for line in said.lines().filter_map(|l| l.strip_prefix("  ozols ")) {
        let command = line.split_whitespace().next().unwrap();
        assert!(
            command == "--help" || split_words(COMMANDS).contains(&command),
            "{command}"
        );
    }
    assert!(said.lines().count() < 12, "{said}");
    // An option without a command is still a mistake.
    assert_eq!(run_full("--quiet").0, Some(2));
}

// explain

#[test]
fn every_term_shows_itself_by_a_command_that_runs() {
    let folder = tempdir().unwrap();
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
fn the_list_is_there_as_data() {
    let rows = run_json("list gripper-10 --format json");
    let rows = rows.list();
    let is_free = |r: &&Value| r["name"] == "gripper-10" && r["state"] == "free";
    let wanted = json!({ "family": "grippers", "links": 10, "joints": 13, "contours": 4, "freedoms": 14, "mobility": 1, "redundant": 11 });
    assert_includes(rows.iter().find(is_free).unwrap(), &wanted);
    let csv = run_quiet("list gripper-10 --format csv");
    let head = "name,family,state,links,joints,contours,freedoms,mobility,redundant,description\n";
    assert!(csv.starts_with(head), "{csv}");
    assert_eq!(csv.lines().count(), rows.len() + 1);
    has(&csv, "\ngripper-10,grippers,clamped,");
}

#[test]
fn joint_types_are_explained() {
    for t in JointType::NAMED {
        let said = run_quiet(&["explain", t.name()]);
        // what is written is a joint of that type, frame and all
        let (_, joint) = said.split_once("[[joint]]").unwrap();
        let joint = joint.split("\n\n").next().unwrap();
        let text = format!(
            "name = \"x\"\n[[link]]\nid = \"1\"\nrole = \"frame\"\n[[link]]\nid = \"2\"\nrole = \"output\"\n[[joint]]{joint}\n"
        );
        let m = read(&text);
        assert_eq!(m.joints[0].joint_type, t);
        for f in t.freedoms() {
            assert!(
                said.contains(&format!("{} (", f.name())),
                "{t}: {}",
                f.name()
            );
        }
        has(&said, &format!("class      {} ", t.class_numeral()));
        let cost = t.default_cost_milli() as f64 / 1000.0;
        has(&said, &format!("cost       {cost} "));
    }
    let all = run_quiet("explain");
    for t in JointType::NAMED {
        assert!(all.contains(t.name()), "{t}");
    }
    assert_fails(&["explain", "sphere in cilinder"], "sphere-in-cylinder");
}

#[test]
fn terms_are_explained_by_name_sign_and_list() {
    let sigma = run_quiet("explain sigma");
    assert_eq!(run_quiet("explain σ"), sigma);
    assert_eq!(run_quiet("explain Σ"), sigma);
    assert_eq!(
        run_quiet("explain redundant constraint"),
        run_quiet("explain redundant-constraint")
    );
    let all = run_quiet("explain");
    let terms = Terms::builtin();
    assert!(terms.term.len() >= 40);
    for t in &terms.term {
        assert!(
            all.lines().any(|l| l.trim_start().starts_with(&t.name)),
            "{}",
            t.name
        );
    }
}

// completions

#[test]
fn every_shell_gets_a_script_and_bash_can_read_its_own() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = run_quiet(&["completions", shell]);
        for command in split_words(COMMANDS) {
            assert!(script.contains(command), "{shell}: {command}");
        }
    }
    let (_folder, path) = write_temporary("ozols.bash", run_quiet("completions bash"));
    let Ok(o) = Command::new("bash").arg("-n").arg(path).output() else {
        return; // no bash here
    };
    assert!(o.status.success(), "{}", utf8_text(&o.stderr));
    assert_eq!(run_full("completions tcsh").0, Some(2));
}

// Colour.

#[test]
fn colour_is_off_where_no_terminal_is_and_on_where_it_is_forced() {
    let (_folder, bad) = write_temporary("bad.toml", "name = \"x\"\nlonk = 1\n");
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
            utf8_text(&o.stdout) + &utf8_text(&o.stderr)
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
        if no_color {
            command.env("NO_COLOR", "1")
        } else {
            command.env_remove("NO_COLOR")
        };
        command
            .stdin(std::process::Stdio::null())
            .output()
            .ok()
            .map(|o| utf8_text(&o.stdout))
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
    has(&listed, "bennett");
    assert!(
        listed.lines().all(|l| l.trim_end().chars().count() <= 120),
        "{listed}"
    );
}
