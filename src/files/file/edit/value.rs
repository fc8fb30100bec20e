//! Values of a file: unchanged values keep their spelling.

use super::change::EditError;
use serde_json::Value as Json;
use toml_edit::{Array, ArrayOfTables, InlineTable, Item, Table, Value};

/// Sets the value of a key, and keeps the comment behind it; null removes the key.
pub(super) fn set_value(table: &mut Table, key: &str, to: &Json) -> Result<(), EditError> {
    if to.is_null() {
        table.remove(key);
        return Ok(());
    }
    if let Json::Array(list) = to
        && list.iter().all(Json::is_object)
        && (TABLES.contains(&key) || table.get(key).is_some_and(Item::is_array_of_tables))
        && !table.get(key).is_some_and(Item::is_value)
    {
        return set_tables(table, key, list);
    }
    match table.get_mut(key).and_then(Item::as_value_mut) {
        Some(old) => *old = replace_value(old, key, to)?,
        None => {
            table.insert(key, Item::Value(write_value(key, to)?));
        }
    }
    Ok(())
}

/// Lists that are written as a table for each entry.
const TABLES: [&str; 4] = ["force", "moment", "contact", "coupling"];

/// Sets the value of a list of tables. Entries that stay keep their comments.
fn set_tables(table: &mut Table, key: &str, list: &[Json]) -> Result<(), EditError> {
    if list.is_empty() {
        table.remove(key);
        return Ok(());
    }
    let old = table
        .remove(key)
        .and_then(|i| i.into_array_of_tables().ok());
    let mut old = old.unwrap_or_default().into_iter();
    let mut tables = ArrayOfTables::new();
    for entry in list.iter().filter_map(Json::as_object) {
        let mut one = old.next().unwrap_or_else(|| {
            let mut fresh = Table::new();
            fresh.decor_mut().set_prefix("\n");
            fresh
        });
        let gone: Vec<String> = one.iter().map(|(k, _)| k.to_owned()).collect();
        for k in gone.iter().filter(|k| !entry.contains_key(*k)) {
            one.remove(k);
        }
        for (k, to) in entry {
            set_value(&mut one, k, to)?;
        }
        tables.push(one);
    }
    table.insert(key, Item::ArrayOfTables(tables));
    Ok(())
}

/// Returns a value to replace another. Equal elements keep their spelling, element by element in a list.
fn replace_value(old: &Value, key: &str, to: &Json) -> Result<Value, EditError> {
    if equals_json(old, to) {
        return Ok(old.clone());
    }
    let mut new = match (old, to) {
        (Value::Array(a), Json::Array(b)) if a.len() == b.len() => {
            let mut list = a.clone();
            for (i, to) in b.iter().enumerate() {
                if let Some(one) = list.get_mut(i) {
                    *one = replace_value(one, key, to)?;
                }
            }
            Value::Array(list)
        }
        _ => write_value(key, to)?,
    };
    *new.decor_mut() = old.decor().clone();
    Ok(new)
}

/// Returns true if two values are equal.
fn equals_json(old: &Value, to: &Json) -> bool {
    match (old, to) {
        (Value::String(s), Json::String(t)) => s.value() == t,
        // A typed text may be a number with its digits.
        (Value::Integer(_) | Value::Float(_), Json::String(t)) => {
            old.to_string().trim() == t.trim()
        }
        (Value::Integer(i), Json::Number(n)) => n.as_i64() == Some(*i.value()),
        (Value::Float(x), Json::Number(n)) => !n.is_i64() && n.as_f64() == Some(*x.value()),
        (Value::Boolean(b), Json::Bool(c)) => b.value() == c,
        (Value::Array(a), Json::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(x, y)| equals_json(x, y))
        }
        _ => false,
    }
}

/// Formats a value. Texts under keys of coordinates that are numbers are written as numbers, digit by digit.
fn write_value(key: &str, to: &Json) -> Result<Value, EditError> {
    let wrong = |why| EditError::NoValue {
        what: key.to_owned(),
        why,
    };
    Ok(match to {
        Json::Null => return Err(wrong("an empty value is not allowed")),
        Json::Bool(b) => Value::from(*b),
        Json::Number(n) => match (n.as_i64(), n.as_f64()) {
            (Some(i), _) => Value::from(i),
            (None, Some(x)) if x.is_finite() => Value::from(x),
            _ => return Err(wrong("the number is too large")),
        },
        Json::String(s) if is_of_numbers(key) => {
            parse_number(s).unwrap_or_else(|| Value::from(s.as_str()))
        }
        Json::String(s) => Value::from(s.as_str()),
        Json::Array(list) => {
            let mut out = Array::new();
            for one in list {
                out.push(write_value(key, one)?);
            }
            Value::Array(out)
        }
        Json::Object(map) => {
            let mut out = InlineTable::new();
            for (inner, one) in map {
                out.insert(inner, write_value(inner, one)?);
            }
            Value::InlineTable(out)
        }
    })
}

/// Returns true for keys whose values are coordinates or quantities.
fn is_of_numbers(key: &str) -> bool {
    let keys = "point axis reference centre mass lead pitch ratio force moment gravity plane_normal tolerance";
    keys.split(' ').any(|k| k == key)
}

/// Parses a typed number.
fn parse_number(text: &str) -> Option<Value> {
    let text = text.trim();
    let plain = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+' | 'e' | 'E');
    if text.is_empty() || !text.chars().all(plain) {
        return None;
    }
    // TOML requires a digit on both sides of the point.
    let value: Value = text.parse().ok()?;
    matches!(value, Value::Integer(_) | Value::Float(_)).then_some(value)
}
