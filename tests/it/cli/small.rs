//! Names, tables, files and pipes that are not as one expects.

use super::assert_refused;
use crate::common::*;

/// ESC colours a terminal and worse, CR hides what came before, NUL ends strings of other programs.
#[test]
fn control_characters_are_refused() {
    let shown = run_quiet("show four-bar");
    for [from, to, key] in read_cases::<3>(
        r#"
        name = "four-bar" | name = "four\u001b[31mbar" | name
        name = "four-bar" | name = "four\rbar" | name
        description = " | description = "\u0000 | description
        O. G. Ozols | O.\u009b Ozols | sources
        "#,
    ) {
        let text = replace_once(&shown, from, to);
        let says = format!("{key} contains the control character");
        assert_fails_on("analyze", "x.toml", &text, "", &says);
    }
    let shown = run_quiet("export four-bar --to json");
    let text = replace_once(&shown, "\"four-bar\"", "\"a\\u001b\"");
    let says = "name contains the control character \\u{1b}";
    assert_fails_on("analyze", "x.json", &text, "", says);
    for name in ["a\u{1b}[31m", "a&#13;b"] {
        let text = format!("<robot name=\"{name}\"><link name=\"b\"/></robot>");
        assert_fails_on("analyze", "x.urdf", &text, "", "control character");
    }
}

/// Prose may have several lines.
#[test]
fn a_description_of_two_lines_is_taken() {
    let shown = run_quiet("show four-bar");
    let two = replace_once(&shown, "description = \"", "description = \"one\\n\\ttwo ");
    let o = ozols("check -").write_stdin(two).output().unwrap();
    assert_eq!(o.status.code(), Some(0), "{}", utf8_text(&o.stderr));
}

/// A spreadsheet would run them.
#[test]
fn names_like_formulas_are_neutralised_in_csv() {
    let shown = run_quiet("show four-bar").replace("\"2-3\"", "\"=2+3\"");
    let search = ["search", "-", "--top", "3", "--format", "csv"];
    let (_, csv, _) = run_with_input(&search, &shown);
    has(&csv, ",'=2+3,");
    lacks(&csv, ",=2+3");
}

/// Once wrong: 10 names over 9 values.
#[test]
fn every_row_of_csv_has_as_many_cells_as_the_head() {
    for words in [
        "four-bar --allow-output-change",
        "four-bar --allow-output-change --rank cost,changes",
        "gripper-10 --max-external 2",
        "four-bar --sample 4",
        "four-bar --check none",
    ] {
        let o = run(&format!("search --format csv {words}"));
        // A reader of CSV refuses rows of another width.
        let rows = csv::Reader::from_reader(&o.stdout[..]).into_records();
        assert_ne!(rows.map(Result::unwrap).count(), 0, "{words}");
    }
}

#[cfg(unix)]
#[test]
fn a_written_file_has_the_mode_it_had_or_the_umask() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempdir().unwrap();
    let mode = |name: &str| {
        let path = folder.path().join(name);
        fs::metadata(path).unwrap().permissions().mode() & 0o777
    };
    let old = folder.path().join("old");
    fs::write(&old, "").unwrap();
    for kept in [0o600, 0o664, 0o755] {
        fs::set_permissions(&old, fs::Permissions::from_mode(kept)).unwrap();
        run_quiet(&["analyze", "four-bar", "-o", old.to_str().unwrap()]);
        assert_eq!(mode("old"), kept);
    }
    for (umask, expected) in [("077", 0o600), ("002", 0o664), ("022", 0o644)] {
        let command = format!(
            "umask {umask}; exec '{}' analyze four-bar -o new{umask}",
            env!("CARGO_BIN_EXE_ozols")
        );
        let status = std::process::Command::new("sh")
            .args(["-c", &command])
            .current_dir(&folder)
            .status();
        assert!(status.unwrap().success());
        assert_eq!(mode(&format!("new{umask}")), expected);
    }
}

#[test]
fn a_dash_is_standard_output() {
    let folder = Folder::new();
    for line in [
        "search four-bar --format csv",
        "analyze four-bar",
        "export four-bar --to urdf -q",
    ] {
        let (out, _) = folder.succeed(&format!("{line} -o -"));
        assert_eq!(out, run_quiet(line));
    }
    assert_eq!(folder.names(), [""; 0]);
}

/// Once accepted in silence, and no file written.
#[test]
fn a_counting_method_has_no_certificate() {
    assert_refused(
        "analyze four-bar --method count --certificate c",
        &["--method count", "no certificate"],
    );
}

/// Once the program waited for a writer that never came.
#[cfg(unix)]
#[test]
fn an_included_pipe_is_refused() {
    let main = "<mujoco><include file=\"pipe\"/><worldbody/></mujoco>";
    let folder = Folder::with("x.xml", main);
    assert!(super::run_shell(&folder, "mkfifo pipe").status.success());
    folder.assert_fails("export x.xml --to toml", "pipe");
    folder.assert_fails("export x.xml --to toml", "it is not a file");
}

/// Once a panic: what is said of an import goes to a standard error that nobody reads.
#[cfg(unix)]
#[test]
fn a_closed_standard_error_is_no_failure() {
    let folder = Folder::with("g.xml", read_data("robots/gripper.xml"));
    for redirect in ["2>&-", "2>/dev/full"] {
        let line = format!("ozols export g.xml --to urdf {redirect} >/dev/null");
        assert!(
            super::run_shell(&folder, &line).status.success(),
            "{redirect}"
        );
    }
}

/// Once a panic: in a plane a coupling of freedoms that lead out of it had no row, and its share was looked for there.
#[test]
fn couplings_out_of_the_plane_are_left_out_and_said() {
    let shown = run_quiet("show four-bar");
    let hinge = "links = [\"1\", \"2\"]\ntype = \"revolute\"";
    let sliding = replace_once(&shown, hinge, &hinge.replace("revolute", "cylindrical"));
    let coupled = format!("{sliding}\n[[coupling]]\njoints = [\"1-2:tz\", \"3-0\"]\nratio = 2\n");
    for more in ["", "--method svd", "--method count-planar"] {
        let more = format!("--planar {more}");
        let (code, _, said) = run_on("analyze", "x.toml", &coupled, &more);
        assert_eq!(code, Some(0), "{more} {said}");
        has_all(&said, &["--planar omits the couplings", "1-2"]);
    }
}

/// A plane is too small a model if a joint cannot move in it at all; a joint that keeps one of its freedoms may stay.
#[test]
fn a_plane_that_stops_a_joint_is_refused() {
    for part in ["joint 0-1", "joint 1-2", "omit --planar"] {
        assert_fails("analyze bennett --planar", part);
    }
    let tilted = replace_once(
        &run_quiet("show four-bar"),
        "point = [0, 0, 0]\naxis = [0, 0, 1]",
        "point = [0, 0, 0]\naxis = [1, 0, 0]",
    );
    let says = "no freedom of joint 0-1 lies in the plane";
    assert_fails_on("analyze", "x.toml", &tilted, "--planar", says);
    run_quiet("analyze gripper-10 --planar");
}
