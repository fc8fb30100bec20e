//! Changes to the text of a mechanism file. Everything else stays unchanged, including comments and digits.

pub mod change;
mod differences;
mod references;
mod value;

use crate::file::edit::references::id_of;
pub use change::{Edit, EditError, Thing};
pub use differences::find_differences;
use serde_json::{Map, Value};
use toml_edit::{ArrayOfTables, DocumentMut, Item, Table};

/// Returns the text of a file after some changes, one after another.
///
/// # Errors
/// Returns an error if the text is not TOML, or if a change names a missing item; then no change is made.
///
/// # Examples
/// ```
/// use ozols::file::edit::{Edit, Thing, apply_edits};
/// let text = ozols::builtin::text("four-bar").unwrap_or_default();
/// let rename = Edit::Rename { what: Thing::Link, id: "1".into(), to: "crank".into() };
/// let edited = apply_edits(text, &[rename])?;
/// // Joints name the link by its new id, and comments stay.
/// assert!(edited.contains(r#"links = ["crank", "2"]"#) && edited.contains("# coupler, 100 mm"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn apply_edits(text: &str, edits: &[Edit]) -> Result<String, EditError> {
    let mut text = text.to_owned();
    let mut document: Option<DocumentMut> = None;
    for edit in edits {
        if let Edit::Text { text: other } = edit {
            text.clone_from(other);
            document = None;
            continue;
        }
        let parsed = match document.take() {
            Some(d) => d,
            None => parse_toml(&text)?,
        };
        let changed = document.insert(parsed);
        apply_edit(changed, edit)?;
    }
    Ok(document.map_or(text, |d| d.to_string()))
}

/// The result of a change.
type Edited<T> = Result<T, EditError>;

fn parse_toml(text: &str) -> Edited<DocumentMut> {
    text.parse()
        .map_err(|e: toml_edit::TomlError| EditError::NoToml {
            why: e.message().trim().replace('\n', ", "),
        })
}

fn apply_edit(document: &mut DocumentMut, edit: &Edit) -> Edited<()> {
    match edit {
        Edit::Text { .. } => Ok(()),
        Edit::Set {
            what,
            id,
            key,
            value,
        } => value::set_value(table_of(document, *what, id)?, key, value),
        Edit::Put { path, value } => put_value(document.as_table_mut(), path, value),
        Edit::Add { what, entry } => add_table(document, *what, entry),
        Edit::Rename { what, id, to } => rename_table(document, *what, id, to),
        Edit::Remove { items } => remove_tables(document, items),
    }
}

/// Returns the tables of a kind; creates them if there are none.
fn tables_of(document: &mut DocumentMut, what: Thing) -> Edited<&mut ArrayOfTables> {
    let entry = document.entry(what.word());
    let item = entry.or_insert_with(|| Item::ArrayOfTables(ArrayOfTables::new()));
    item.as_array_of_tables_mut()
        .ok_or(EditError::Inline { what })
}

fn table_of<'d>(document: &'d mut DocumentMut, what: Thing, id: &str) -> Edited<&'d mut Table> {
    let all = tables_of(document, what)?;
    let found = all.iter_mut().find(|t| id_of(t) == Some(id));
    let id = || id.to_owned();
    found.ok_or_else(|| EditError::Gone { what, id: id() })
}

/// Checks that nothing else of its kind has this name.
fn check_unused(document: &mut DocumentMut, what: Thing, id: &str) -> Edited<()> {
    let all = tables_of(document, what)?;
    if !all.iter().any(|t| id_of(t) == Some(id)) {
        return Ok(());
    }
    let id = id.to_owned();
    Err(EditError::Taken { what, id })
}

fn put_value(table: &mut Table, path: &[String], to: &Value) -> Edited<()> {
    match path {
        [] => Ok(()),
        [key] => value::set_value(table, key, to),
        [key, rest @ ..] => {
            let inner = table.entry(key);
            let inner = inner.or_insert_with(|| Item::Table(implicit_table()));
            let Some(inner) = inner.as_table_mut() else {
                return Err(EditError::NoValue {
                    what: key.clone(),
                    why: "it is not a separate table",
                });
            };
            put_value(inner, rest, to)
        }
    }
}

/// Returns a table whose head is written only if it has values.
fn implicit_table() -> Table {
    let mut table = Table::new();
    table.set_implicit(true);
    table
}

fn add_table(document: &mut DocumentMut, what: Thing, entry: &Map<String, Value>) -> Edited<()> {
    if let Some(id) = entry.get("id").and_then(Value::as_str) {
        check_unused(document, what, id)?;
    }
    let mut table = Table::new();
    for (key, to) in entry {
        value::set_value(&mut table, key, to)?;
    }
    table.decor_mut().set_prefix("\n");
    tables_of(document, what)?.push(table);
    Ok(())
}

fn rename_table(document: &mut DocumentMut, what: Thing, id: &str, to: &str) -> Edited<()> {
    if id == to {
        return Ok(());
    }
    check_unused(document, what, to)?;
    value::set_value(table_of(document, what, id)?, "id", &Value::from(to))?;
    references::rename_references(document.as_table_mut(), what, id, to);
    Ok(())
}

fn remove_tables(document: &mut DocumentMut, items: &[(Thing, String)]) -> Edited<()> {
    let mut all = items.to_vec();
    for (what, id) in items {
        table_of(document, *what, id)?;
        if *what == Thing::Link {
            all.extend(references::of_link(document, id));
        }
    }
    for (what, id) in &all {
        let list = tables_of(document, *what)?;
        list.retain(|t| id_of(t) != Some(id));
        references::remove_references(document.as_table_mut(), *what, id);
    }
    for what in [Thing::Link, Thing::Joint, Thing::Point] {
        if tables_of(document, what)?.is_empty() {
            document.remove(what.word());
        }
    }
    Ok(())
}
