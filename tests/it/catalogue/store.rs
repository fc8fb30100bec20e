//! The file of a catalogue: versions, parts that are missing, foreign files, and what a question may not do.

use super::command::{dump_catalogue, path_in};
use crate::common::*;
use rusqlite::Connection;
use std::ffi::OsStr;

/// A catalogue of two structures.
fn tiny(folder: &TempDir, name: &str, more: &[&str]) -> String {
    let file = path_in(folder, name);
    let words = split_words("catalog build --links 4 --ideas 1 --quiet -o");
    stdout_of(&[&words[..], &[&file], more].concat());
    file
}

fn change(file: &str, sql: &str) {
    Connection::open(file).unwrap().execute_batch(sql).unwrap();
}

#[test]
fn a_catalogue_of_another_version_is_refused() {
    let folder = tempdir().unwrap();
    let file = tiny(&folder, "other.db", &[]);
    let [page, whole] = ["page.html", "m.db"].map(|n| path_in(&folder, n));
    for version in [0, 9, 10, 12] {
        change(&file, &format!("PRAGMA user_version = {version};"));
        let bytes = fs::read(&file).unwrap();
        let says = format!(
            "other.db has tables of version {version}, and this ozols reads version 11 alone"
        );
        for line in [
            format!("query {file}"),
            format!("page {file} -o {page}"),
            format!("build --links 4 --ideas 1 -o {file}"),
            format!("search four-bar -o {file}"),
            format!("merge {file} -o {whole}"),
        ] {
            assert_fails(&format!("catalog {line}"), &says);
            assert_fails(
                &format!("catalog {line}"),
                "`ozols catalog build -o NAME.db`",
            );
        }
        assert_eq!(fs::read(&file).unwrap(), bytes);
    }
}

#[test]
fn parts_that_are_missing_are_named() {
    let folder = tempdir().unwrap();
    let part = |i: usize| tiny(&folder, &format!("{i}.db"), &["--shard", &format!("{i}/7")]);
    let parts: Vec<String> = (1..=7).map(part).collect();
    let file = path_in(&folder, "all.db");
    let merge = |which: &[usize]| {
        let parts = which.iter().map(|i| &parts[i - 1]).join(" ");
        let (code, _, said) = run_full(&format!("catalog merge {parts} -o {file}"));
        (code, said)
    };
    let incomplete = |which: &[usize], says: &[&str]| {
        let (code, said) = merge(which);
        assert_eq!(code, Some(1), "{said}");
        has_all(&said, says);
    };
    incomplete(
        &[2, 5],
        &["of 7 parts 1/7, 3/7, 4/7, 6/7, 7/7 are missing", "--shard"],
    );
    incomplete(&[1, 3, 4, 7], &["of 7 parts 6/7 is missing"]);
    assert_eq!(merge(&[6]), (Some(0), String::new()));
    assert_eq!(
        dump_catalogue(&file),
        dump_catalogue(&tiny(&folder, "once.db", &[]))
    );
    // A part that was not finished says so.
    change(&parts[2], "DELETE FROM parts");
    fs::remove_file(&file).unwrap();
    incomplete(
        &[1, 2, 3, 4, 5, 6, 7],
        &["3.db is not marked as complete", "3/7 is missing"],
    );
}

#[test]
fn an_empty_file_is_a_catalogue_to_be_made() {
    let folder = tempdir().unwrap();
    let [file, other] = ["empty.db", "other.db"].map(|n| path_in(&folder, n));
    fs::write(&file, "").unwrap();
    assert_fails(&["catalog", "query", &file], "is empty");
    assert_eq!(fs::read(&file).unwrap(), b"");
    // Pages, but no table: what a kill leaves that comes while it is being made.
    change(&file, "CREATE TABLE x (y); DROP TABLE x;");
    assert!(!fs::read(&file).unwrap().is_empty());
    assert_fails(
        &["catalog", "query", &file],
        "run it again and it carries on",
    );
    tiny(&folder, "empty.db", &[]);
    // Some other program's database is not touched.
    change(&other, "CREATE TABLE x (y);");
    let bytes = fs::read(&other).unwrap();
    for line in ["query", "build --links 4 -o", "search four-bar -o"] {
        assert_fails(
            &format!("catalog {line} {other}"),
            "is not a catalogue of ozols",
        );
    }
    assert_eq!(fs::read(&other).unwrap(), bytes);
}

/// Once written: `VACUUM INTO` makes a file of a database that is open to be read.
#[test]
fn a_question_writes_nothing_and_opens_nothing_else() {
    let folder = tempdir().unwrap();
    let file = tiny(&folder, "g.db", &[]);
    let other = path_in(&folder, "secret.db");
    change(
        &other,
        "CREATE TABLE secret (word); INSERT INTO secret VALUES ('x');",
    );
    let there = || fs::read_dir(&folder).unwrap().count();
    let (before, bytes) = (there(), fs::read(&file).unwrap());
    for sql in [
        &format!("VACUUM INTO '{}'", path_in(&folder, "copy.db")),
        "VACUUM",
        &format!("ATTACH '{other}' AS other"),
        &format!("ATTACH '{}' AS fresh", path_in(&folder, "fresh.db")),
        "DETACH main",
        "PRAGMA user_version = 8",
        "PRAGMA journal_mode = WAL",
        "PRAGMA temp_store_directory = '/'",
        "CREATE TABLE x (y)",
        "DROP TABLE ideas",
        "INSERT INTO meta VALUES ('a', 'b')",
        "SELECT load_extension('x')",
        "SELECT writefile('x', 'y')",
        // No questions.
        "BEGIN",
        "-- nothing",
        "",
    ] {
        let o = run(&["catalog", "query", &file, sql]);
        assert_eq!(o.status.code(), Some(2), "{sql}: {}", utf8_text(&o.stdout));
    }
    assert_eq!((there(), fs::read(&file).unwrap()), (before, bytes));
    assert_fails(
        &["catalog", "query", &file, "ATTACH 'x' AS y"],
        "ask with SELECT",
    );
    let columns = "SELECT count(*) > 5 AS many FROM pragma_table_info('ideas')";
    assert_eq!(
        stdout_of(&["catalog", "query", &file, columns, "--format", "csv"]),
        "many\n1\n"
    );
}

/// A value of a megabyte is given, and three hundred of them fill no memory.
#[test]
fn an_answer_is_bounded() {
    let folder = tempdir().unwrap();
    let file = tiny(&folder, "g.db", &[]);
    let values = |n: usize| {
        let numbers = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n)";
        format!("{numbers} SELECT printf('%.*c', 1000000, 'x') AS x FROM n LIMIT {n}")
    };
    let two = stdout_of(&["catalog", "query", &file, &values(2), "--format", "csv"]);
    assert_eq!(two.len(), 2_000_004);
    let all = ["catalog", "query", &file, &values(300), "--format", "csv"];
    assert_fails(&all, "larger than 256 MiB");
}

/// Names stand for files, whatever SQLite makes of them, and need not be text.
#[test]
fn a_name_is_that_of_a_file() {
    let folder = tempdir().unwrap();
    let here = |line: &str, name: &OsStr| {
        let mut command = ozols(line);
        let o = command.arg(name).current_dir(&folder).output().unwrap();
        assert_eq!(o.status.code(), Some(0), "{line}: {}", utf8_text(&o.stderr));
    };
    let mut names = [":memory:", "file:x.db?mode=memory", "a'b\".db", "%41.db"]
        .map(OsStr::new)
        .to_vec();
    #[cfg(unix)]
    names.push(std::os::unix::ffi::OsStrExt::from_bytes(b"caf\xe9.db"));
    for name in names {
        here("catalog build --links 4 --ideas 1 --quiet -o", name);
        assert!(folder.path().join(name).is_file(), "{name:?}");
        here("catalog query", name);
        here("catalog page -o page.html", name);
        here("catalog merge -o whole.db", name);
        // The other way round, what is made has such a name.
        here("catalog merge whole.db -o", name);
    }
    #[cfg(unix)]
    here(
        "catalog page whole.db -o",
        std::os::unix::ffi::OsStrExt::from_bytes(b"\xfe.html"),
    );
}

/// What a foreign file says cannot steer a terminal: neither its words, nor the names of its columns, nor its own name.
#[test]
fn control_characters_are_escaped() {
    let folder = tempdir().unwrap();
    let name = "evil\u{1b}]0;owned\u{7}.db";
    let file = tiny(&folder, name, &[]);
    change(
        &file,
        "UPDATE structures SET no_layout = no_layout || char(27) || '[2J', chain = chain || char(155) || '31m' || char(127);
         INSERT INTO drawn SELECT 'drawn-x', 'n' || char(27) || '[1A', char(13) || 'd', 4, 4, 1, 'spatial', 'turn', '', 1, 3, 'f' || char(7), 1, 1,
         'exact', 1, 1;",
    );
    let is_plain = |said: &str| {
        let odd = said.chars().find(|c| c.is_control() && *c != '\n');
        assert_eq!(odd, None, "{said:?}");
        assert!(said.is_empty() || said.contains("\\u{"), "{said:?}");
    };
    for args in [
        &[
            "query",
            &file,
            "SELECT id, chain, no_layout FROM structures",
        ][..],
        &[
            "query",
            &file,
            "SELECT name, description, finite FROM drawn",
        ],
        &["query", &file, "SELECT 1 AS \"a\u{1b}[31mb\""],
        &["show", &file, "drawn-x"],
        &["search", "four-bar", "--ideas", "1", "-o", &file],
        &["build", "--links", "6", "-o", &file],
        &["query", &file, "SELECT \u{1b}[31m"],
        &["show", &file, "\u{1b}[31m"],
        &["query", &format!("{file}\u{1b}[31m")],
    ] {
        let o = run(&[&["catalog"], args].concat());
        let (out, said) = (utf8_text(&o.stdout), utf8_text(&o.stderr));
        is_plain(&out);
        is_plain(&said);
        assert!(!out.is_empty() || !said.is_empty(), "{args:?}");
    }
    // Data stay what they are.
    let sql = "SELECT name FROM drawn WHERE id = 'drawn-x'";
    let csv = stdout_of(&["catalog", "query", &file, sql, "--format", "csv"]);
    assert_eq!(csv, "name\nn\u{1b}[1A\n");
    assert!(Path::new(&file).is_file());
}
