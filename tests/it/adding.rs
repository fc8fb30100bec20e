//! The page "How to add": its files exist, and its lists are the only ones.

use crate::sources::{below, root, without_tests};
use ozols::model::joint_type::JointType;
use ozols::model::ranking::Term;
use ozols::rank::method::registry;
use std::fs;

const PAGE: &str = include_str!("../../src/guide/adding.md");

#[test]
fn the_files_and_names_of_the_page_exist() {
    let quoted: Vec<&str> = PAGE.split('`').skip(1).step_by(2).collect();
    let files: Vec<&&str> = quoted.iter().filter(|q| q.contains('/')).collect();
    assert!(files.len() > 8);
    for file in &files {
        assert!(root().join(file).exists(), "{file}");
    }
    let all = below(&root().join("src"));
    let code: String = all.iter().map(|f| fs::read_to_string(f).unwrap()).collect();
    for name in quoted.iter().filter(|q| !q.contains(['/', ' ', '-'])) {
        // Python's classes are called with a point.
        let last = name.rsplit("::").next().unwrap();
        let last = last.strip_prefix("Mechanism.").unwrap_or(last);
        assert!(code.contains(last), "{name}");
    }
}

/// Files outside `homes` in which a word stands by itself, in quotes or in a longer text; comments and tests aside.
fn elsewhere(word: &str, homes: &[&str]) -> Vec<String> {
    let all = below(&root().join("src"));
    let part_of_word = |c: char| c.is_alphanumeric() || c == '_' || c == '-';
    let alone = |line: &str| {
        let code = line.split("//").next().unwrap();
        code.match_indices(word).any(|(at, _)| {
            let (before, after) = (&code[..at], &code[at + word.len()..]);
            !before.ends_with(part_of_word) && !after.starts_with(part_of_word)
        })
    };
    all.iter()
        .map(|f| {
            let name = f.strip_prefix(root()).unwrap().to_str().unwrap().to_owned();
            let text = fs::read_to_string(f).unwrap();
            (name, without_tests(&text))
        })
        .filter(|(name, text)| {
            !homes.iter().any(|h| name.starts_with(h)) && text.lines().any(alone)
        })
        .map(|(name, _)| name)
        .collect()
}

/// A new ranking term meets the compiler in the three files of the page, and in no other.
#[test]
fn ranking_terms_are_listed_in_their_three_files() {
    let all = below(&root().join("src"));
    let mut exhaustive: Vec<String> = Vec::new();
    for f in &all {
        let text = fs::read_to_string(f).unwrap();
        let named = |t: &Term| text.contains(&format!("Term::{t:?}"));
        if Term::ALL.iter().all(named) {
            exhaustive.push(f.strip_prefix(root()).unwrap().display().to_string());
        }
    }
    exhaustive.sort();
    let of_the_page = [
        "src/evaluation/score/evaluation/floor.rs",
        "src/evaluation/score/evaluation/terms.rs",
        "src/kernel/model/ranking.rs",
    ];
    assert_eq!(exhaustive, of_the_page);
    assert!(of_the_page.iter().all(|f| PAGE.contains(f)));
    for term in Term::ALL {
        // "cost" and the like are words of other tables, too.
        if term.name().contains('-') {
            assert_eq!(
                elsewhere(term.name(), &["src/kernel/model/ranking.rs"]),
                [""; 0],
                "{term:?}"
            );
        }
    }
}

/// Editors complete from the schema, people from the help: both have each word.
#[test]
fn the_schema_and_the_help_have_every_term_and_joint_type() {
    let schema = ozols::file::schema::json_schema();
    let words = |of: &str, key: &str| -> Vec<String> {
        let listed = &schema["$defs"][of]["properties"][key]["enum"];
        serde_json::from_value(listed.clone()).unwrap()
    };
    let terms = Term::ALL.map(Term::name);
    assert_eq!(words("TermEntry", "term"), terms);
    assert_eq!(words("LimitEntry", "term"), terms);
    assert!(JointType::words().eq(words("JointEntry", "type")));
    let help = crate::common::run(&["search", "--help"]);
    let help = crate::common::text(&help.stdout).replace('\n', " ");
    let help: Vec<&str> = help.split([' ', ',', ';', '.']).collect();
    assert!(terms.iter().all(|t| help.contains(t)), "{help:?}");
}

#[test]
fn the_words_of_rank_methods_stand_in_their_own_files() {
    // The studies of accuracy ask some methods by name.
    let homes = [
        "src/kernel/rank/",
        "src/evaluation/accuracy/",
        "src/show/view/accuracy/",
    ];
    for method in registry::ALL {
        let name = method.name();
        // These are words of other tables, too.
        if !["count", "finite", "auto", "modular", "svd", "generic"].contains(&name) {
            // As a word of English some stand in many sentences; as a name, in quotes.
            let quoted = format!("\"{name}\"");
            assert_eq!(elsewhere(&quoted, &homes), [""; 0], "{name}");
        }
    }
}

/// What can be asked of the library can be asked on the command line and in Python, or it is said here why not.
#[test]
fn every_field_of_a_request_is_an_option_and_a_keyword() {
    let read = |file: &str| fs::read_to_string(root().join(file)).unwrap();
    let request = read("src/evaluation/score/request.rs");
    let (_, fields) = request.split_once("pub struct Request {").unwrap();
    let (fields, _) = fields.split_once("\n}").unwrap();
    let fields = fields.lines().filter_map(|l| l.trim().strip_prefix("pub "));
    let fields: Vec<&str> = fields.map(|l| l.split(':').next().unwrap()).collect();
    assert!(fields.len() > 20, "{fields:?}");
    let command = read("src/cli/option/request.rs") + &read("src/cli/command/search.rs");
    let python = read("src/python/ozols/_mechanism.py");
    for field in fields {
        // A list in Python is as long as its reader asks.
        let keyword = if field == "list" { "top" } else { field };
        assert!(command.contains(field), "{field}: no option");
        assert!(
            python.contains(&format!("        {keyword}: ")),
            "{field}: no keyword"
        );
    }
}

/// SQL takes values by the names of columns: each column of the tables that rows go into has one.
#[test]
fn every_column_of_the_catalogue_is_entered_by_its_name() {
    let read = |file: &str| fs::read_to_string(root().join(file)).unwrap();
    let (sql, insert) = (
        read("src/catalogue/catalog/tables.sql"),
        read("src/catalogue/catalog/insert.rs"),
    );
    let mut tables = 0;
    for table in sql.split("CREATE TABLE ").skip(1) {
        let (name, rest) = table.split_once(' ').unwrap();
        let Some((_, row)) = insert.split_once(&format!("\"{name}\",\n")) else {
            assert!(["meta", "parts", "prices"].contains(&name), "{name}");
            continue;
        };
        let (row, _) = row.split_once("],").unwrap();
        let (columns, _) = rest.split_once("\n)").unwrap();
        let columns = columns.lines().filter_map(|l| l.strip_prefix("  "));
        let columns = columns.map(|l| l.split(' ').next().unwrap());
        for column in columns.filter(|c| {
            c.chars()
                .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
        }) {
            assert!(row.contains(&format!("\"{column}\"")), "{name}.{column}");
        }
        tables += 1;
    }
    assert_eq!(tables, 9);
}
