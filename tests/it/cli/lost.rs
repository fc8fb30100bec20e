//! Nothing is lost: outputs of one name, outputs that are read, disks and files that are full.

use super::{four_bar, run_shell, shell_fails};
use crate::common::*;

/// Names of the files in a folder, with what they hold.
fn held(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let all = fs::read_dir(folder).unwrap().map(Result::unwrap);
    let files = all.filter(|f| f.path().is_file());
    let mut files: Vec<_> = files
        .map(|f| {
            let name = f.file_name().into_string().unwrap();
            (name, fs::read(f.path()).unwrap())
        })
        .collect();
    files.sort();
    files
}

/// Each is refused before anything is written.
#[test]
fn two_outputs_of_one_name_are_refused() {
    let folder = tempdir().unwrap();
    let folder = folder.path();
    fs::create_dir(folder.join("sub")).unwrap();
    let path = |name: &str| folder.join(name).display().to_string();
    let pairs = [
        ["x", "x"],
        ["x", "./x"],
        ["x", "sub/../x"],
        ["sub/x", "sub//x"],
        ["-", "-"],
        ["x", &path("x")],
    ];
    let mut named = pairs.map(|pair| pair.map(str::to_owned)).to_vec();
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(folder.join("sub"), folder.join("link")).unwrap();
        named.push(["sub/x", "link/x"].map(str::to_owned));
    }
    let commands: [(&[&str], &str); 6] = [
        (&["analyze", "four-bar"], "--certificate"),
        (&["analyze", "four-bar", "--stroke", "0..0.5:3"], "--svg"),
        (&["statics", "parallel-shears"], "--svg"),
        (&["drive", "torsion-module"], "--svg"),
        (&["grip", "lever-gripper"], "--svg"),
        (&["catalog", "show", "c.db", "x"], "--svg"),
    ];
    for (words, option) in commands {
        for [one, other] in &named {
            let all = [words, &[option, one, "-o", other]].concat();
            let o = ozols(&all).current_dir(folder).output().unwrap();
            let said = utf8_text(&o.stderr);
            assert_eq!(o.status.code(), Some(2), "{all:?}: {said}");
            assert!(said.contains("name two files"), "{all:?}: {said}");
            assert_eq!(held(folder), [], "{all:?}");
            assert_eq!(fs::read_dir(folder.join("sub")).unwrap().count(), 0);
        }
    }
    // Two names are two files, and a device takes both.
    let both = ["analyze", "four-bar", "--certificate", "c", "-o", "t"];
    let o = ozols(&both).current_dir(folder).output().unwrap();
    assert_eq!((o.status.code(), held(folder).len()), (Some(0), 2));
    #[cfg(unix)]
    run_quiet("analyze four-bar --certificate /dev/null -o /dev/null");
}

/// A folder of charts has a page, which no other output replaces.
#[test]
fn an_output_among_the_charts_is_refused() {
    let folder = tempdir().unwrap();
    let charts = folder.path().join("charts");
    let page = charts.join("index.html");
    let [charts, page] = [charts, page].map(|p| p.display().to_string());
    let line = format!("statics parallel-shears --stroke 0:360deg:12 --svg {charts} -o {page}");
    assert_fails(&line, "already written by this command");
    assert!(fs::read_to_string(&page).unwrap().starts_with("<!"));
}

/// The shell opens standard input and output: names say nothing of them, and what it has emptied is gone before the program begins.
#[cfg(unix)]
#[test]
fn standard_input_and_output_are_files_like_others() {
    let folder = tempdir().unwrap();
    let folder = folder.path();
    let (file, link) = (folder.join("f.toml"), folder.join("hard.toml"));
    fs::write(&file, four_bar()).unwrap();
    fs::hard_link(&file, &link).unwrap();
    let before = held(folder);
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
        shell_fails(folder, words, "another file");
        assert!(held(folder) == before, "{words}");
    }
    // The shell empties it first.
    shell_fails(folder, "ozols analyze - < f.toml > f.toml", "");
    fs::write(&file, four_bar()).unwrap();
    let o = run_shell(folder, "ozols export - --to json < f.toml > new.json");
    assert_eq!(o.status.code(), Some(0), "{}", utf8_text(&o.stderr));
}

/// What a description includes is read as well.
#[test]
fn an_included_file_is_not_written_over() {
    let folder = tempdir().unwrap();
    let robot = include_str!("../../data/robots/gripper.xml");
    let (main, part) = (
        folder.path().join("main.xml"),
        folder.path().join("part.xml"),
    );
    fs::write(&part, robot).unwrap();
    fs::write(&main, "<mujoco><include file=\"part.xml\"/></mujoco>").unwrap();
    let [main, part] = [main, part].map(|p| p.display().to_string());
    run_quiet(&["analyze", &main, "-q"]);
    for words in [
        ["export", "--to=mjcf"],
        ["export", "--to=toml"],
        ["draw", "-q"],
    ] {
        assert_fails(&[words[0], &main, words[1], "-o", &part], "is the input");
        assert_eq!(fs::read_to_string(&part).unwrap(), robot);
    }
}

/// A limit on the size of files stands for a full disk. Its signal ended the program once, and temporary files stayed.
#[cfg(unix)]
#[test]
fn a_file_that_may_not_grow_is_an_error_with_its_name() {
    let folder = tempdir().unwrap();
    let folder = folder.path();
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
            folder,
            &format!("ulimit -f 1; exec ozols {words} > said"),
            name,
        );
        let _ = fs::remove_file(folder.join("said"));
        // A database that was begun is carried on.
        let left = held(folder).into_iter().map(|f| f.0);
        let left: Vec<String> = left.filter(|f| f != "c.db").collect();
        assert_eq!(left, [""; 0], "{words}");
    }
    let o = run_shell(folder, "ozols catalog build --links 4 --ideas 1 -o c.db");
    assert_eq!(o.status.code(), Some(0), "{}", utf8_text(&o.stderr));
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_device_is_an_error_with_its_name() {
    let folder = tempdir().unwrap();
    let folder = folder.path();
    let lines = "--help/--version//search --help/help search/analyze four-bar/search four-bar --format json/list/completions bash/schema";
    for words in lines.split('/') {
        shell_fails(
            folder,
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
            folder,
            &format!("ozols {words} -o /dev/full"),
            "cannot write /dev/full",
        );
    }
    // Who reads no further is no failure.
    let o = run_shell(folder, "(ozols --help; echo $? >&2) | true");
    assert_eq!(utf8_text(&o.stderr), "0\n");
}
