//! A commented mechanism file to start from, made of one that exists.
//!
//! The comments are those of the schema, so they agree with `ozols schema`. Nothing of the file is moved. Only the claims of
//! publications are removed, because they are not about the new mechanism. Comments come before the first table and the first key of
//! each kind.

use crate::file::schema::json_schema;
use serde_json::Value;
use std::collections::BTreeSet;
use std::fmt::Write;
use toml_edit::{Decor, DocumentMut, InlineTable, Item, Table, TomlError};

/// Columns of a comment.
const COLUMNS: usize = 100;

/// Advice on what to edit, by the path of the key; the schema describes each key.
const ADVICE: [(&str, &str); 11] = [
    ("description", "Describe your mechanism."),
    ("sources", "Give your own sources, or delete this."),
    (
        "link",
        "Begin each with [[link]]. Exactly one is the frame, at least one an output.",
    ),
    (
        "joint",
        "Begin each with [[joint]]. Points, axes and types are what to edit first.",
    ),
    (
        "joint.point",
        "Each coordinate is a number, or an exact expression in quotes such as \"sqrt(3)/2\", \"cos(36deg)\", \"1/3\".",
    ),
    (
        "contour",
        "Optional; by default the shortest loops are used. Edit these when you add or remove joints, or delete them.",
    ),
    ("search", "List the joint types that you can make."),
    (
        "search.mirror",
        "Delete this if your mechanism is not symmetric.",
    ),
    (
        "tolerances",
        "How accurately the joints are made: a named fit, or position and angle.",
    ),
    (
        "ranking",
        "Without this table the cheapest variants come first.",
    ),
    (
        "expected",
        "They hold for the built-in mechanism: `ozols check` reports where yours differs. Change or delete them.",
    ),
];

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
    if let Some(old) = document.get_mut("name").and_then(Item::as_value_mut) {
        let decor = old.decor().clone();
        *old = name.into();
        *old.decor_mut() = decor;
    }
    let root = json_schema();
    let mut writer = TemplateWriter {
        root: &root,
        seen: BTreeSet::new(),
    };
    writer.comment_table(document.as_table_mut(), &root, "");
    let mut head = String::new();
    let mut say = |text: &str| write_comment(&mut head, text);
    say(&format!(
        "{name}: a mechanism for ozols, made from the built-in {from} by `ozols new`."
    ));
    say(
        "Edit it, then run `ozols check FILE` for errors, `ozols analyze FILE` for redundant constraints, `ozols search FILE` for redesigns.",
    );
    let more = unused_keys(&root, [document.as_table()].into_iter());
    if !more.is_empty() {
        say(&format!(
            "Keys and tables that it does not use: {} (see `ozols schema`).",
            more.join(", ")
        ));
    }
    head.push('\n');
    Ok(head + &document.to_string())
}

struct TemplateWriter<'a> {
    root: &'a Value,
    /// Paths already explained.
    seen: BTreeSet<String>,
}

impl TemplateWriter<'_> {
    fn comment_table(&mut self, table: &mut Table, schema: &Value, path: &str) {
        let keys: Vec<String> = table.iter().map(|(k, _)| k.to_owned()).collect();
        for key in keys {
            let (at, property) = find_property(schema, path, &key);
            let Some(property) = property else { continue };
            let inner = resolve_schema(self.root, property).unwrap_or(property);
            let first = self.seen.insert(at.clone());
            let mut words = String::new();
            if first {
                explain_key(&mut words, property, inner, &at);
            }
            match table.get_mut(&key) {
                Some(Item::Value(value)) => {
                    if first && let Some(keys) = inline_keys_of(value) {
                        inline_keys(&mut words, &keys, inner);
                    }
                    if let Some(mut key) = table.key_mut(&key) {
                        set_comment(key.leaf_decor_mut(), "", &words);
                    }
                }
                Some(Item::Table(t)) => {
                    if t.is_implicit() {
                        self.seen.remove(&at);
                    } else {
                        if first {
                            list_other_keys(&mut words, inner, std::iter::once(&*t));
                        }
                        set_comment(t.decor_mut(), "\n", &words);
                    }
                    self.comment_table(t, inner, &at);
                }
                Some(Item::ArrayOfTables(list)) => {
                    if first {
                        list_other_keys(&mut words, inner, list.iter());
                    }
                    if let Some(t) = list.iter_mut().next() {
                        set_comment(t.decor_mut(), "\n", &words);
                    }
                    for t in list.iter_mut() {
                        self.comment_table(t, inner, &at);
                    }
                }
                _ => {}
            }
        }
    }
}

/// Returns the schema of a key and its path; keys that the user chooses, such as names of joint types, are `*`.
fn find_property<'s>(schema: &'s Value, path: &str, key: &str) -> (String, Option<&'s Value>) {
    let join = |k: &str| match path {
        "" => k.to_owned(),
        _ => format!("{path}.{k}"),
    };
    match schema["properties"].get(key) {
        Some(p) => (join(key), Some(p)),
        None => (join("*"), schema.get("additionalProperties")),
    }
}

/// Returns the definition that a property, the items of its list, or one of its alternatives refers to.
fn resolve_schema<'s>(root: &'s Value, property: &'s Value) -> Option<&'s Value> {
    if let Some(reference) = property["$ref"].as_str() {
        let found = root.pointer(reference.trim_start_matches('#'))?;
        return match found.get("properties") {
            Some(_) => Some(found),
            // One of several forms: the table is the one that has keys.
            None => resolve_schema(root, found).or(Some(found)),
        };
    }
    let alternatives = property["anyOf"].as_array();
    let within = alternatives.into_iter().flatten();
    within
        .chain(property.get("items"))
        .find_map(|p| resolve_schema(root, p))
}

/// Explains a key and what to edit.
fn explain_key(out: &mut String, property: &Value, inner: &Value, path: &str) {
    let own = property["description"].as_str().unwrap_or_default();
    let mut text = own.to_owned();
    if let Some((_, advice)) = ADVICE.iter().find(|(key, _)| *key == path) {
        text = format!("{text} {advice}");
    }
    write_comment(out, &text);
    // Conventions of a table, such as its units, are in its definition.
    let convention = inner["description"]
        .as_str()
        .filter(|d| d.contains("in the file's unit") && inner.get("properties").is_some());
    if let Some(text) = convention {
        write_comment(out, text);
    }
}

/// Returns the keys of a table in braces, or of the tables of a list.
fn inline_keys_of(value: &toml_edit::Value) -> Option<BTreeSet<String>> {
    let keys = |t: &InlineTable| t.iter().map(|(k, _)| k.to_owned()).collect::<BTreeSet<_>>();
    let found: BTreeSet<String> = match value {
        toml_edit::Value::InlineTable(t) => keys(t),
        toml_edit::Value::Array(list) => {
            let tables = list.iter().filter_map(|v| v.as_inline_table());
            tables.flat_map(keys).collect()
        }
        _ => BTreeSet::new(),
    };
    (!found.is_empty()).then_some(found)
}

fn inline_keys(out: &mut String, keys: &BTreeSet<String>, schema: &Value) {
    let known = schema["properties"].as_object();
    for (key, property) in known.into_iter().flatten() {
        if let Some(d) = property["description"]
            .as_str()
            .filter(|_| keys.contains(key))
        {
            write_comment(out, &format!("{key}: {d}"));
        }
    }
}

/// Lists the keys that none of these tables has.
fn list_other_keys<'t>(out: &mut String, schema: &Value, tables: impl Iterator<Item = &'t Table>) {
    let more = unused_keys(schema, tables);
    if !more.is_empty() {
        write_comment(out, &format!("It may also have: {}.", more.join(", ")));
    }
}

fn unused_keys<'s, 't>(schema: &'s Value, tables: impl Iterator<Item = &'t Table>) -> Vec<&'s str> {
    let used: BTreeSet<&str> = tables.flat_map(|t| t.iter().map(|(k, _)| k)).collect();
    let known = schema["properties"].as_object();
    let known = known.into_iter().flat_map(|k| k.keys()).map(String::as_str);
    known.filter(|k| !used.contains(k)).collect()
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

/// Puts a comment before the item of a decoration: after blank lines and earlier text, and before existing comments of the file.
fn set_comment(decor: &mut Decor, default: &str, words: &str) {
    if words.is_empty() {
        return;
    }
    let there = decor.prefix().and_then(|p| p.as_str()).unwrap_or(default);
    let blank = there.rfind("\n\n").map(|i| i + 2);
    let lead = there.len() - there.trim_start_matches(['\n', '\r']).len();
    let (above, own) = there.split_at(blank.unwrap_or(0).max(lead));
    // An empty comment separates added comments from those of the file.
    let between = if own.starts_with('#') { "#\n" } else { "" };
    decor.set_prefix(format!("{above}{words}{between}{own}"));
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
            ("# weight: Weight of the term. Default: 1.", "terms = ["),
        ] {
            assert_eq!(new.matches(comment).count(), 1, "{comment}\n{new}");
            let at = new.find(comment).expect("counted");
            let line = new[at..].lines().nth(1);
            assert_eq!(line, Some(key), "{comment}");
        }
        assert!(new.contains("It may also have: "), "{new}");
    }

    #[test]
    fn every_advice_is_of_a_key_that_exists() {
        let root = crate::file::schema::json_schema();
        for (path, _) in super::ADVICE {
            let mut schema = &root;
            for key in path.split('.') {
                let next = &schema["properties"][key];
                assert!(next.is_object(), "{path}");
                schema = super::resolve_schema(&root, next).unwrap_or(next);
            }
        }
    }
}
