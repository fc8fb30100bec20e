//! References to links and joints in a file, outside the items themselves.

use super::change::Thing;
use toml_edit::{Array, DocumentMut, Item, Table, Value};

/// Lists of ids: their paths, and the kinds of items that they name. `*` is every table of a list.
const LISTS: [(&[&str], Thing); 7] = [
    (&["joint", "*", "links"], Thing::Link),
    (&["search", "hold"], Thing::Link),
    (&["search", "mirror"], Thing::Joint),
    (&["search", "turn"], Thing::Joint),
    (&["workload", "grip", "contacts"], Thing::Joint),
    (&["workload", "grip", "lever_joints"], Thing::Joint),
    (&["workload", "drive", "disc_link"], Thing::Link),
];

/// Tables of lists that name items by a key, and have no meaning without one of them.
const TABLES: [(&[&str], &str, Thing); 7] = [
    (&["point"], "link", Thing::Link),
    (&["contour"], "joints", Thing::Joint),
    (&["coupling"], "joints", Thing::Joint),
    (&["workload", "force"], "link", Thing::Link),
    (&["workload", "moment"], "link", Thing::Link),
    (&["workload", "contact"], "joint", Thing::Joint),
    (&["workload", "misalignment"], "joint", Thing::Joint),
];

/// Returns the id of a table.
pub(super) fn id_of(table: &Table) -> Option<&str> {
    table.get("id").and_then(Item::as_str)
}

/// Returns the joints and points of a link.
pub(super) fn of_link(document: &DocumentMut, link: &str) -> Vec<(Thing, String)> {
    let mut out = Vec::new();
    let on = |t: &Table, what: Thing| match what {
        Thing::Joint => {
            let ends = t.get("links").and_then(Item::as_array);
            ends.is_some_and(|a| a.iter().any(|v| v.as_str() == Some(link)))
        }
        _ => t.get("link").and_then(Item::as_str) == Some(link),
    };
    for what in [Thing::Joint, Thing::Point] {
        let all = document.get(what.word()).and_then(Item::as_array_of_tables);
        let own = all.into_iter().flatten().filter(|t| on(t, what));
        out.extend(own.filter_map(id_of).map(|id| (what, id.to_owned())));
    }
    out
}

/// Returns true if a text names an item; a freedom may follow the id of a joint.
fn names_item(text: &str, id: &str) -> bool {
    text == id
        || text
            .strip_prefix(id)
            .is_some_and(|rest| rest.starts_with(':'))
}

/// Replaces an id in all its places.
pub(super) fn rename_references(root: &mut Table, what: Thing, id: &str, to: &str) {
    for (path, _) in LISTS.iter().filter(|(_, of)| *of == what) {
        visit_path(root, path, &mut |item| rename_in(item, id, to));
    }
    for (path, key, _) in TABLES.iter().filter(|(.., of)| *of == what) {
        let path = [*path, &["*", key]].concat();
        visit_path(root, &path, &mut |item| rename_in(item, id, to));
    }
}

fn rename_in(item: &mut Item, id: &str, to: &str) {
    fn rename_in_value(v: &mut Value, id: &str, to: &str) {
        match v {
            Value::Array(list) => list.iter_mut().for_each(|v| rename_in_value(v, id, to)),
            Value::String(s) if names_item(s.value(), id) => {
                let decor = s.decor().clone();
                *v = Value::from(format!("{to}{}", &s.value()[id.len()..]));
                *v.decor_mut() = decor;
            }
            _ => {}
        }
    }
    if let Some(v) = item.as_value_mut() {
        rename_in_value(v, id, to);
    }
}

/// Removes an id from all lists that name it.
pub(super) fn remove_references(root: &mut Table, what: Thing, id: &str) {
    for (path, _) in LISTS
        .iter()
        .filter(|(path, of)| *of == what && path[0] == "search")
    {
        visit_path(root, path, &mut |item| {
            if let Some(list) = item.as_array_mut() {
                list.retain(|v| !names_it(v, id));
                trim_first_blank(list);
            }
        });
    }
    for (path, key, _) in TABLES.iter().filter(|(.., of)| *of == what) {
        visit_path(root, path, &mut |item| {
            if let Some(tables) = item.as_array_of_tables_mut() {
                tables.retain(|t| {
                    let named = t.get(key).and_then(Item::as_value);
                    !named.is_some_and(|v| names_it(v, id))
                });
            }
        });
    }
}

fn names_it(v: &Value, id: &str) -> bool {
    match v {
        Value::String(s) => names_item(s.value(), id),
        Value::Array(list) => list.iter().any(|v| names_it(v, id)),
        _ => false,
    }
}

/// Removes blanks that remain after the first item of a list was removed.
fn trim_first_blank(list: &mut Array) {
    if let Some(first) = list.get_mut(0)
        && first.decor().prefix().and_then(|p| p.as_str()) == Some(" ")
    {
        first.decor_mut().set_prefix("");
    }
}

/// Applies a function to all items at a path.
fn visit_path(table: &mut Table, path: &[&str], act: &mut dyn FnMut(&mut Item)) {
    let [key, rest @ ..] = path else { return };
    let Some(item) = table.get_mut(key) else {
        return;
    };
    match (rest, item) {
        ([], item) => act(item),
        (["*", rest @ ..], Item::ArrayOfTables(all)) => {
            all.iter_mut().for_each(|t| visit_path(t, rest, act));
        }
        (rest, Item::Table(inner)) => visit_path(inner, rest, act),
        _ => {}
    }
}
