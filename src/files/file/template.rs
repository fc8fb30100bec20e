//! A commented mechanism file to start from, made of one that exists.
//!
//! The comments are those of the schema, so they agree with `ozols schema`. Nothing of the file is moved. Only the claims of
//! publications are removed, because they are not about the new mechanism. Comments come before the first table and the first key of
//! each kind.

use crate::file::text::{SCHEMA, of_key, schema_alternatives};
use serde_json::{Map, Value};
use std::collections::BTreeSet;
use std::fmt::Write;
use toml_edit::{DocumentMut, Item, TomlError};

/// Columns of a comment.
const COLUMNS: usize = 100;

/// Returns the text of a mechanism file without claims of publications and without expected figures.
///
/// # Errors
/// Returns an error if the text is not TOML.
///
/// # Examples
/// ```
/// use ozols::file::template::without_claims;
/// let text = without_claims(ozols::builtin::text("torsion-module").unwrap_or_default())?;
/// assert!(ozols::from_toml(&text)?.claims.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn without_claims(text: &str) -> Result<String, TomlError> {
    let mut document: DocumentMut = text.parse()?;
    document.remove("claim");
    document.remove("expected");
    Ok(document.to_string())
}

/// Returns the text of a mechanism file under another name, with a comment on every kind of table and key.
///
/// The comments name `from` as the mechanism it was made from. Complexity: one pass over the text.
///
/// # Errors
/// Returns an error if the text is not TOML.
///
/// # Examples
/// ```
/// use ozols::file::template::with_comments;
/// let text = with_comments(ozols::builtin::text("four-bar").unwrap_or_default(), "four-bar", "mine")?;
/// assert!(text.starts_with("# mine: a mechanism for ozols"));
/// assert_eq!(ozols::from_toml(&text)?.name, "mine");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn with_comments(text: &str, from: &str, name: &str) -> Result<String, TomlError> {
    let mut document: DocumentMut = text.parse()?;
    document.remove("claim");
    let text = comment_lines(&document.to_string());
    let mut document: DocumentMut = text.parse()?;
    // Last, because a name may have several lines.
    if let Some(old) = document.get_mut("name").and_then(Item::as_value_mut) {
        let decor = old.decor().clone();
        *old = name.into();
        *old.decor_mut() = decor;
    }
    let mut head = String::new();
    let mut say = |text: &str| write_comment(&mut head, text);
    say(&format!(
        "{name}: a mechanism for ozols, made from the built-in {from} by `ozols new`."
    ));
    say(
        "Edit it, then run `ozols check FILE` for errors, `ozols analyze FILE` for redundant constraints, `ozols search FILE` for redesigns. `ozols schema` has all tables and keys.",
    );
    head.push('\n');
    Ok(head + &document.to_string())
}

/// Returns the lines of a text, with a comment above the first table and the first key of each kind: before the comments that it has.
fn comment_lines(text: &str) -> String {
    let (mut out, mut own, mut table) = (String::new(), String::new(), String::new());
    let mut seen = BTreeSet::new();
    for line in text.lines() {
        if line.starts_with('#') {
            own += &format!("{line}\n");
            continue;
        }
        let head = line.strip_prefix('[').and_then(|l| l.split(']').next());
        let key = line.split_once(" = ").map(|(key, _)| key);
        let path = match (head, key.filter(|k| !k.contains([' ', '#', '"']))) {
            (Some(head), _) => {
                head.trim_start_matches('[').clone_into(&mut table);
                table.clone()
            }
            (None, Some(key)) if table.is_empty() => key.to_owned(),
            (None, Some(key)) => format!("{table}.{key}"),
            (None, None) => String::new(),
        };
        let found = schema_at(&path).filter(|(at, ..)| seen.insert(at.clone()));
        let mut words = String::new();
        if let Some((_, property, inner)) = found {
            explain_key(&mut words, property, inner);
        }
        // An empty comment separates added comments from those of the file.
        if !words.is_empty() && !own.is_empty() {
            words += "#\n";
        }
        out += &format!("{words}{own}{line}\n");
        own.clear();
    }
    out + &own
}

/// A schema with its keys.
type Schema = Map<String, Value>;

/// Returns the schema of a key and the table that it or its list has, with its path; keys that the user chooses, such as names of joint
/// types, are `*` there.
fn schema_at(path: &str) -> Option<(String, &'static Value, Option<&'static Schema>)> {
    let (mut at, mut property, mut table) = (Vec::new(), &*SCHEMA, table_schema(&SCHEMA));
    for key in path.split('.') {
        let known = table?.get("properties").and_then(|all| all.get(key));
        at.push(known.map_or("*", |_| key));
        property = of_key(table?, key)?;
        table = table_schema(property);
    }
    Some((at.join("."), property, table))
}

/// Returns the schema of a table: the alternative of a property, or of the items of its list, that has keys.
fn table_schema(property: &'static Value) -> Option<&'static Schema> {
    let all = schema_alternatives(property);
    let keyed = |s: &&&Schema| {
        ["properties", "additionalProperties"]
            .iter()
            .any(|k| s.contains_key(*k))
    };
    let own = all.iter().find(keyed).copied();
    own.or_else(|| all.iter().find_map(|s| table_schema(s.get("items")?)))
}

/// Explains a key. Conventions of a table, such as its units, are in its definition.
fn explain_key(out: &mut String, property: &Value, table: Option<&Schema>) {
    let told = property["description"].as_str();
    write_comment(out, told.unwrap_or_default());
    let convention = table.and_then(|t| t.get("description")?.as_str());
    let convention = convention.filter(|d| d.contains("in the file's unit"));
    write_comment(out, convention.unwrap_or_default());
}

/// Appends a comment, filled to the columns.
fn write_comment(out: &mut String, text: &str) {
    if text.trim().is_empty() {
        return;
    }
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let options = textwrap::Options::new(COLUMNS).break_words(false);
    for line in textwrap::wrap(&words, options.initial_indent("# ").subsequent_indent("# ")) {
        // Writing to a string cannot fail.
        let _ = writeln!(out, "{line}");
    }
}

#[cfg(test)]
mod tests {
    use super::with_comments;
    use crate::file::schema::MechanismFile;
    use ozols::builtin;

    /// The lines of a file that are not of its claims, nor comments on them.
    fn unclaimed(text: &str) -> Vec<&str> {
        let (mut claim, mut kept) = (false, Vec::new());
        for line in text.lines() {
            if line.starts_with('[') {
                claim = line == "[[claim]]";
                while claim && kept.pop_if(|l: &mut &str| l.starts_with('#')).is_some() {}
            }
            if !claim {
                kept.push(line);
            }
        }
        kept
    }

    #[test]
    fn every_line_of_every_built_in_file_is_kept() {
        for name in builtin::names() {
            let text = builtin::text(name).expect("it is built in");
            let new = with_comments(text, name, "mine").expect("it is TOML");
            assert!(
                !new.contains("[[claim]]"),
                "{name}: claims are of the mechanism that they are about"
            );
            let mut lines = new.lines();
            let kept = unclaimed(text).into_iter();
            for line in kept.filter(|l| !l.starts_with("name = ") && !l.is_empty()) {
                assert!(lines.any(|l| l == line), "{name}: lost {line:?}\n{new}");
            }
            assert!(new.contains("\nname = \"mine\""), "{name}");
        }
    }

    #[test]
    fn the_file_says_the_same_under_another_name() {
        let json = |text: &str| {
            let file: MechanismFile = toml::from_str(text).expect("it is valid");
            let mut json = file.json();
            json.as_object_mut().expect("it is a table").remove("claim");
            (json["name"].take(), json)
        };
        for name in builtin::names() {
            let text = builtin::text(name).expect("it is built in");
            let new = with_comments(text, name, "a \"b\"\n# c").expect("it is TOML");
            let (new_name, new) = json(&new);
            assert_eq!(new_name, "a \"b\"\n# c");
            assert_eq!(new, json(text).1, "{name}");
        }
    }

    #[test]
    fn each_kind_of_key_is_explained_where_it_first_stands() {
        let text = builtin::text("gripper-10-loaded").expect("it is built in");
        let new = with_comments(text, "gripper-10-loaded", "mine").expect("it is TOML");
        for (comment, key) in [
            ("# Name, unique among links.", "id = \"0\""),
            ("# Mass in kg.", "mass = 0.25"),
            ("# Name, unique among joints.", "id = \"0-1\""),
            ("# The force in N.", "force = [0, 60, 0]"),
        ] {
            assert_eq!(new.matches(comment).count(), 1, "{comment}\n{new}");
            let at = new.find(comment).expect("counted");
            let line = new[at..].lines().nth(1);
            assert_eq!(line, Some(key), "{comment}");
        }
    }
}
