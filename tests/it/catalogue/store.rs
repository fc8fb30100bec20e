//! The file of a catalogue: versions, parts that are missing, foreign files, and what a question may not do.

use super::command::dump_catalogue;
use crate::common::*;
use rusqlite::Connection;
use std::ffi::OsStr;

/// Makes a catalogue of two structures under the name that follows.
const TINY: &str = "catalog build --links 4 --ideas 1 --quiet -o";

fn change(folder: &Folder, name: &str, sql: &str) {
    let file = Connection::open(folder.path(name)).unwrap();
    file.execute_batch(sql).unwrap();
}

#[test]
fn a_catalogue_of_another_version_is_refused() {
    let folder = Folder::new();
    folder.succeed(&format!("{TINY} other.db"));
    for version in [0, 10, 11, 13] {
        let pragma = format!("PRAGMA user_version = {version};");
        change(&folder, "other.db", &pragma);
        let bytes = folder.bytes("other.db");
        let says = format!(
            "other.db has tables of version {version}, and this ozols reads version 12 alone"
        );
        for line in [
            "catalog query other.db",
            "catalog page other.db -o page.html",
            "catalog build --links 4 --ideas 1 -o other.db",
            "catalog merge other.db -o m.db",
        ] {
            folder.assert_fails(line, &says);
            folder.assert_fails(line, "`ozols catalog build -o NAME.db`");
        }
        assert_eq!(folder.bytes("other.db"), bytes);
    }
}

#[test]
fn parts_that_are_missing_are_named() {
    let folder = Folder::new();
    for i in 1..=7 {
        folder.succeed(&format!("{TINY} {i}.db --shard {i}/7"));
    }
    let merge = |which: &str| {
        let (code, _, said) = folder.run(&format!("catalog merge {which} -o all.db"));
        (code, said)
    };
    let incomplete = |which: &str, says: &[&str]| {
        let (code, said) = merge(which);
        assert_eq!(code, Some(1), "{said}");
        has_all(&said, says);
    };
    let missing = "of 7 parts 1/7, 3/7, 4/7, 6/7, 7/7 are missing";
    incomplete("2.db 5.db", &[missing, "--shard"]);
    incomplete("1.db 3.db 4.db 7.db", &["of 7 parts 6/7 is missing"]);
    assert_eq!(merge("6.db"), (Some(0), String::new()));
    folder.succeed(&format!("{TINY} once.db"));
    let [all, once] = ["all.db", "once.db"].map(|n| folder.path(n).display().to_string());
    assert_eq!(dump_catalogue(&all), dump_catalogue(&once));
    // A part that was not finished says so.
    change(&folder, "3.db", "DELETE FROM parts");
    fs::remove_file(&all).unwrap();
    let every = "1.db 2.db 3.db 4.db 5.db 6.db 7.db";
    let says = ["3.db is not marked as complete", "3/7 is missing"];
    incomplete(every, &says);
}

#[test]
fn an_empty_file_is_a_catalogue_to_be_made() {
    let folder = Folder::with("empty.db", "");
    folder.assert_fails("catalog query empty.db", "is empty");
    assert_eq!(folder.bytes("empty.db"), b"");
    // Pages, but no table: what a kill leaves that comes while it is being made.
    let pages = "CREATE TABLE x (y); DROP TABLE x;";
    change(&folder, "empty.db", pages);
    assert!(!folder.bytes("empty.db").is_empty());
    let says = "run it again and it carries on";
    folder.assert_fails("catalog query empty.db", says);
    folder.succeed(&format!("{TINY} empty.db"));
    // Some other program's database is not touched.
    change(&folder, "other.db", "CREATE TABLE x (y);");
    let bytes = folder.bytes("other.db");
    for line in ["query", "build --links 4 -o"] {
        let line = format!("catalog {line} other.db");
        folder.assert_fails(&line, "is not a catalogue of ozols");
    }
    assert_eq!(folder.bytes("other.db"), bytes);
}

/// Once written: `VACUUM INTO` makes a file of a database that is open to be read.
#[test]
fn a_question_writes_nothing_and_opens_nothing_else() {
    let folder = Folder::new();
    folder.succeed(&format!("{TINY} g.db"));
    let secret = "CREATE TABLE secret (word); INSERT INTO secret VALUES ('x');";
    change(&folder, "secret.db", secret);
    let before = (folder.names(), folder.bytes("g.db"));
    for sql in "VACUUM INTO 'copy.db'
        VACUUM
        ATTACH 'secret.db' AS other
        ATTACH 'fresh.db' AS fresh
        DETACH main
        PRAGMA user_version = 8
        PRAGMA journal_mode = WAL
        PRAGMA temp_store_directory = '/'
        CREATE TABLE x (y)
        DROP TABLE ideas
        INSERT INTO meta VALUES ('a', 'b')
        SELECT load_extension('x')
        SELECT writefile('x', 'y')
        BEGIN
        -- nothing
        "
    .lines()
    {
        folder.assert_fails(&["catalog", "query", "g.db", sql.trim()], "");
    }
    assert_eq!((folder.names(), folder.bytes("g.db")), before);
    let attach = ["catalog", "query", "g.db", "ATTACH 'x' AS y"];
    folder.assert_fails(&attach, "ask with SELECT");
    let columns = "SELECT count(*) > 5 AS many FROM pragma_table_info('ideas')";
    let csv = folder.succeed(&["catalog", "query", "g.db", columns, "--format", "csv"]);
    assert_eq!(csv.0, "many\n1\n");
}

/// A value of a megabyte is given, and three hundred of them fill no memory.
#[test]
fn an_answer_is_bounded() {
    let folder = Folder::new();
    folder.succeed(&format!("{TINY} g.db"));
    let numbers = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n)";
    let values = |n| format!("{numbers} SELECT printf('%.*c', 1000000, 'x') AS x FROM n LIMIT {n}");
    let (two, all) = (values(2), values(300));
    let words = |sql| ["catalog", "query", "g.db", sql, "--format", "csv"];
    assert_eq!(folder.succeed(&words(&two)).0.len(), 2_000_004);
    folder.assert_fails(&words(&all), "larger than 256 MiB");
}

/// Names stand for files, whatever SQLite makes of them, and need not be text.
#[test]
fn a_name_is_that_of_a_file() {
    let folder = Folder::new();
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
        here(TINY, name);
        assert!(folder.as_ref().join(name).is_file(), "{name:?}");
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
    let folder = Folder::new();
    let file = "evil\u{1b}]0;owned\u{7}.db";
    folder.succeed(&format!("{TINY} {file}"));
    change(
        &folder,
        file,
        "UPDATE structures SET no_layout = no_layout || char(27) || '[2J', chain = chain || char(155) || '31m' || char(127);
         INSERT INTO structures SELECT 'evil', 'n' || char(27) || '[1A', char(13) || 'd', 4, 4, 0, 1, 2, 3, NULL, 'turn', 'f' || char(7), 0, 1,
         0, 0, char(27) || 'why';",
    );
    let is_plain = |said: &str| {
        let odd = said.chars().find(|c| c.is_control() && *c != '\n');
        assert_eq!(odd, None, "{said:?}");
        assert!(said.is_empty() || said.contains("\\u{"), "{said:?}");
    };
    for line in "query|FILE|SELECT id, chain, no_layout FROM structures
        query|FILE|SELECT name, symmetry FROM structures WHERE id = 'evil'
        query|FILE|SELECT 1 AS \"a\u{1b}[31mb\"
        show|FILE|evil
        build|--links|6|-o|FILE
        query|FILE|SELECT \u{1b}[31m
        show|FILE|\u{1b}[31m
        query|FILE\u{1b}[31m"
        .lines()
    {
        let line = line.trim().replace("FILE", file);
        let words = ["catalog"].into_iter().chain(line.split('|'));
        let (_, out, said) = folder.run(&words.collect_vec());
        is_plain(&out);
        is_plain(&said);
        assert!(!out.is_empty() || !said.is_empty(), "{line:?}");
    }
    // Data stay what they are.
    let sql = "SELECT name FROM structures WHERE id = 'evil'";
    let (csv, _) = folder.succeed(&["catalog", "query", file, sql, "--format", "csv"]);
    assert_eq!(csv, "name\nn\u{1b}[1A\n");
}
