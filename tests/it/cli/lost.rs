//! Nothing is lost: outputs of one name, outputs that are read, disks and files that are full.

use super::{four_bar, run_shell, shell_fails};
use crate::common::*;

/// Names of the files in a folder, with what they hold.
fn held(folder: &Folder) -> Vec<(String, Vec<u8>)> {
    let files = folder
        .names()
        .into_iter()
        .filter(|n| folder.path(n).is_file());
    files.map(|n| (n.clone(), folder.bytes(&n))).collect()
}

/// Each is refused before anything is written.
#[test]
fn two_outputs_of_one_name_are_refused() {
    let folder = Folder::new();
    fs::create_dir(folder.path("sub")).unwrap();
    let same = folder.path("x").display().to_string();
    let mut named = ["x x", "x ./x", "x sub/../x", "sub/x sub//x", "- -"]
        .map(str::to_owned)
        .to_vec();
    named.push(format!("x {same}"));
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(folder.path("sub"), folder.path("link")).unwrap();
        named.push("sub/x link/x".to_owned());
    }
    let before = folder.names();
    for words in [
        "analyze four-bar --certificate",
        "analyze four-bar --stroke 0..0.5:3 --svg",
        "statics parallel-shears --svg",
        "drive torsion-module --svg",
        "grip lever-gripper --svg",
        "catalog show c.db x --svg",
    ] {
        for pair in &named {
            let (one, other) = pair.split_once(' ').unwrap();
            folder.assert_fails(&format!("{words} {one} -o {other}"), "name two files");
            assert_eq!(folder.names(), before, "{words} {pair}");
            assert_eq!(fs::read_dir(folder.path("sub")).unwrap().count(), 0);
        }
    }
    // Two names are two files, and a device takes both.
    folder.succeed("analyze four-bar --certificate c -o t");
    assert_eq!(held(&folder).len(), 2);
    #[cfg(unix)]
    run_quiet("analyze four-bar --certificate /dev/null -o /dev/null");
}

/// A folder of charts has a page, which no other output replaces.
#[test]
fn an_output_among_the_charts_is_refused() {
    let folder = Folder::new();
    let line = "statics parallel-shears --stroke 0:360deg:12 --svg charts -o charts/index.html";
    folder.assert_fails(line, "already written by this command");
    assert!(folder.text("charts/index.html").starts_with("<!"));
}

/// The shell opens standard input and output: names say nothing of them, and what it has emptied is gone before the program begins.
#[cfg(unix)]
#[test]
fn standard_input_and_output_are_files_like_others() {
    let folder = Folder::new();
    folder.put("f.toml", four_bar());
    fs::hard_link(folder.path("f.toml"), folder.path("hard.toml")).unwrap();
    let before = held(&folder);
    for words in [
        "ozols export - --to json -o f.toml < f.toml",
        "ozols export - --to json -o hard.toml < f.toml",
        "ozols export - --to json >> f.toml < f.toml",
        "ozols check - >> hard.toml < f.toml",
        "ozols export f.toml --to json >> f.toml",
        "ozols analyze hard.toml >> f.toml",
        "ozols search f.toml 1<> f.toml",
        "ozols analyze four-bar -o f.toml >> f.toml",
        "ozols analyze four-bar -o hard.toml >> f.toml",
    ] {
        shell_fails(&folder, words, "another file");
        assert!(held(&folder) == before, "{words}");
    }
    // The shell empties it first.
    shell_fails(&folder, "ozols analyze - < f.toml > f.toml", "");
    folder.put("f.toml", four_bar());
    let o = run_shell(&folder, "ozols export - --to json < f.toml > new.json");
    assert_eq!(o.status.code(), Some(0), "{}", utf8_text(&o.stderr));
}

/// What a description includes is read as well.
#[test]
fn an_included_file_is_not_written_over() {
    let robot = include_str!("../../data/robots/gripper.xml");
    let folder = Folder::with("part.xml", robot);
    folder.put("main.xml", "<mujoco><include file=\"part.xml\"/></mujoco>");
    folder.succeed("analyze main.xml -q");
    for words in ["export --to=mjcf", "export --to=toml", "draw -q"] {
        folder.assert_fails(&format!("{words} main.xml -o part.xml"), "is the input");
        assert_eq!(folder.text("part.xml"), robot);
    }
}

/// A limit on the size of files stands for a full disk. Its signal ended the program once, and temporary files stayed.
#[cfg(unix)]
#[test]
fn a_file_that_may_not_grow_is_an_error_with_its_name() {
    let folder = Folder::new();
    for [words, name] in read_cases::<2>(
        r"
        search gripper-10 --top 2000 --format csv -o list.csv | list.csv
        search gripper-10 --top 2000 --format json -o list.json | list.json
        search gripper-10 --top 2000 --format jsonl | standard output
        report four-bar -o page.html | page.html
        analyze gripper-10 --certificate proof.json -o t | proof.json
        statics parallel-shears --stroke 0:360deg:12 --svg charts | charts/
        draw gripper-10 -o drawn.svg | drawn.svg
        new mine.toml | mine.toml
        catalog build --links 4 --ideas 1 -o c.db | c.db
        --help | standard output
",
    ) {
        shell_fails(
            &folder,
            &format!("ulimit -f 1; exec ozols {words} > said"),
            name,
        );
        let _ = fs::remove_file(folder.path("said"));
        // A database that was begun is carried on.
        let left = held(&folder).into_iter().map(|f| f.0);
        let left: Vec<String> = left.filter(|f| f != "c.db").collect();
        assert_eq!(left, [""; 0], "{words}");
    }
    let o = run_shell(&folder, "ozols catalog build --links 4 --ideas 1 -o c.db");
    assert_eq!(o.status.code(), Some(0), "{}", utf8_text(&o.stderr));
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_device_is_an_error_with_its_name() {
    let folder = Folder::new();
    let lines = "--help/--version//search --help/help search/analyze four-bar/search four-bar --format json/list/completions bash/schema";
    for words in lines.split('/') {
        shell_fails(
            &folder,
            &format!("ozols {words} > /dev/full"),
            "cannot write standard output",
        );
    }
    for words in [
        "analyze four-bar",
        "draw four-bar",
        "search four-bar --format json",
    ] {
        shell_fails(
            &folder,
            &format!("ozols {words} -o /dev/full"),
            "cannot write /dev/full",
        );
    }
    // Who reads no further is no failure.
    let o = run_shell(&folder, "(ozols --help; echo $? >&2) | true");
    assert_eq!(utf8_text(&o.stderr), "0\n");
}
