//! Reading a mechanism from text. Control characters are not allowed in names, because they could control a terminal or break a
//! table.

use crate::file::locate::Document;
use crate::file::prelude::*;
use crate::file::problem::{ImportError, is_json};
use crate::file::read::build_mechanism;
use crate::file::schema::json_schema;
use crate::file::unknown_word;
use crate::format::count_noun;
use serde_json::{Map, Value};
use std::sync::LazyLock;
use toml::Spanned;
use toml::de::DeValue;

/// Largest file read, in bytes.
pub const MAX_BYTES: usize = 4 << 20;

/// Reads a mechanism from the bytes of a file; names that end in `.json` are JSON, all others TOML.
///
/// # Errors
/// Returns every problem found, each with its place.
///
/// # Examples
/// ```
/// use ozols::file::text::mechanism_from_bytes;
/// let text = ozols::builtin::text("bennett").unwrap_or_default();
/// assert_eq!(mechanism_from_bytes("bennett.toml", text.as_bytes())?.joints.len(), 4);
/// assert!(mechanism_from_bytes("bennett.toml", b"\xff").is_err()); // Not UTF-8.
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn mechanism_from_bytes(name: &str, bytes: &[u8]) -> Result<Mechanism, ImportError> {
    mechanism_from_str(name, text_of(name, bytes)?)
}

/// Reads a mechanism from text; names that end in `.json` are JSON, all others TOML.
///
/// # Errors
/// Returns every problem found, each with its place.
///
/// # Examples
/// ```
/// use ozols::file::text::mechanism_from_str;
/// let m = mechanism_from_str("mine.toml", ozols::builtin::text("four-bar").unwrap()).unwrap();
/// assert_eq!(m.joints.len(), 4);
/// // Every problem has its place and a remedy.
/// let why = mechanism_from_str("mine.toml", "name = 3").unwrap_err();
/// assert!(why.to_string().contains("mine.toml"));
/// ```
pub fn mechanism_from_str(name: &str, text: &str) -> Result<Mechanism, ImportError> {
    read_file(name, text, build_mechanism)
}

/// Returns the text in the bytes of a file, if the file is not too large.
pub fn text_of<'a>(name: &str, bytes: &'a [u8]) -> Result<&'a str, ImportError> {
    if bytes.len() > MAX_BYTES {
        let message = format!(
            "the file has {} bytes, more than the {MAX_BYTES} allowed; split it or remove everything that is not a mechanism",
            bytes.len()
        );
        return Err(ProblemKind::from(message).in_file(name, "", None));
    }
    decode_utf8(bytes).map_err(|problem| problem.in_file(name, "", None))
}

/// Returns bytes as text, or the problem that they are not UTF-8.
pub(crate) fn decode_utf8(bytes: &[u8]) -> Result<&str, ProblemKind> {
    std::str::from_utf8(bytes).map_err(|e| {
        let at = e.valid_up_to();
        format!("the file is not UTF-8 text (byte {at}); save it as UTF-8").into()
    })
}

/// Reads a file and makes something of it.
///
/// # Examples
/// ```
/// use ozols::file::text::read_file;
/// let text = ozols::builtin::text("four-bar").unwrap_or_default();
/// let joints = read_file("four-bar.toml", text, |file| Ok(file.joint.len()))?;
/// assert_eq!(joints, 4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn read_file<T>(
    name: &str,
    text: &str,
    make: impl FnOnce(&MechanismFile) -> Result<T, Vec<Finding>>,
) -> Result<T, ImportError> {
    if text.trim_start_matches('\u{feff}').trim().is_empty() {
        let message = "the file is empty; `ozols schema` describes its contents";
        return Err(ProblemKind::from(message).in_file(name, text, None));
    }
    let json = is_json(name);
    let located = |found| ImportError::with_places(name, text, json, found);
    let syntax =
        |(message, span)| ProblemKind::from(with_remedy(message)).in_file(name, text, span);
    let mut document = Document::parse(text, json).map_err(syntax)?;
    // First of all, as the deserializer ignores the values that a list has too many.
    let shapes = wrong_shapes(&document.root);
    if !shapes.is_empty() {
        return Err(located(shapes));
    }
    keep_digits(&mut document.root);
    make(&document.into_file().map_err(syntax)?).map_err(located)
}

/// Appends a remedy to a message about a missing or wrong value.
fn with_remedy(message: String) -> String {
    // The deserializer's own words speak of its types.
    if message.contains("as i128") {
        return "this whole number is larger than 64 bits; choose another length_unit, or write it as a decimal".to_owned();
    }
    if message == "floating-point number overflowed" {
        return format!("{message}; choose another length_unit");
    }
    // A text with an error further on has not been checked by the schema.
    if let Some(rest) = message.strip_prefix("unknown field `")
        && let Some((word, known)) = rest.split_once("`, expected ")
    {
        let known = known.trim_start_matches("one of ").replace('`', "");
        return unknown_word("key", word, [known.replace(" or ", ", ")]).to_string();
    }
    let missing = message.strip_prefix("missing field `");
    match missing.and_then(|rest| rest.strip_suffix('`')) {
        Some("id") => format!("{message}; give it a unique name"),
        Some(_) => format!("{message}; add it (`ozols new` writes a file with all fields)"),
        None => message,
    }
}

/// Texts that may have more than one line.
const PROSE: &str = "description sources assumed source says right scan evidence";

fn check_text(text: &str, at: &Place<'_>) {
    let key = at.path.last_key().unwrap_or("the file");
    let allowed = |c: char| (c == '\n' || c == '\t') && PROSE.split(' ').any(|k| k == key);
    let found = text.chars().find(|&c| c.is_control() && !allowed(c));
    if let Some(found) = found {
        at.add_problem(format!(
            "{key} contains the control character {}; remove it",
            found.escape_unicode()
        ));
    }
}

pub(crate) static SCHEMA: LazyLock<Value> = LazyLock::new(json_schema);

/// Returns a problem for each list of a document whose length its schema excludes, for each key that it does not have, and for each
/// control character. The TOML deserializer ignores the extra values of a list, and the JSON one calls them "trailing characters". Both
/// stop at the first unknown key.
fn wrong_shapes(document: &Spanned<DeValue<'_>>) -> Vec<Finding> {
    let out = Findings::default();
    check_value(&SCHEMA, document, "", &out.root_place());
    out.into_findings()
}

/// Checks a value against its schema; `owner` names the innermost item with an id around it.
fn check_value(schema: &Value, value: &Spanned<DeValue<'_>>, owner: &str, at: &Place<'_>) {
    let all = schema_alternatives(schema);
    match value.get_ref() {
        DeValue::Array(items) => {
            let Some((list, item)) = all.iter().find_map(|s| Some((s, s.get("items")?))) else {
                return;
            };
            let limit = |name: &str| list.get(name).and_then(Value::as_u64);
            let (least, most) = (limit("minItems").unwrap_or(0), limit("maxItems"));
            let (count, most) = (items.len() as u64, most.unwrap_or(u64::MAX));
            if (least..=most).contains(&count) {
                let items = at.each_entry(items);
                return items.for_each(|(at, value)| check_value(item, value, owner, &at));
            }
            let wanted = if least == most {
                format!("{least} values, no more and no fewer")
            } else {
                format!("{least} to {most} values")
            };
            at.add_problem(format!(
                "{} has {}; write {wanted}",
                list_name(at, owner),
                count_noun(items.len(), "value")
            ));
        }
        DeValue::Table(entries) => {
            let id = entries.get("id").and_then(|id| id.get_ref().as_str());
            let own =
                id.map(|id| format!(" of {} \"{id}\"", at.path.last_key().unwrap_or_default()));
            let owner = own.as_deref().unwrap_or(owner);
            for (k, entry) in entries {
                let k = k.get_ref().as_ref();
                check_text(k, at);
                match all.iter().find_map(|s| of_key(s, k)) {
                    Some(Value::Bool(false)) => {
                        let known = all.iter().filter_map(|s| s.get("properties")?.as_object());
                        let problem = unknown_word("key", k, known.flat_map(Map::keys));
                        at.key_name(k).add_problem(problem);
                    }
                    Some(schema) => check_value(schema, entry, owner, &at.key(k)),
                    None => {}
                }
            }
        }
        DeValue::String(text) => check_text(text, at),
        _ => {}
    }
}

/// Returns what a schema may be: what it refers to, or each that it offers, or itself.
pub(crate) fn schema_alternatives(schema: &Value) -> Vec<&Map<String, Value>> {
    let Some(own) = schema.as_object() else {
        return Vec::new();
    };
    if let Some(place) = own.get("$ref").and_then(Value::as_str) {
        let name = place.strip_prefix("#/$defs/");
        let referred = name.and_then(|name| SCHEMA.get("$defs")?.get(name));
        return referred.map(schema_alternatives).unwrap_or_default();
    }
    match own.get("anyOf").and_then(Value::as_array) {
        Some(offered) => offered.iter().flat_map(schema_alternatives).collect(),
        None => vec![own],
    }
}

/// Returns the schema of an entry of a table.
pub(crate) fn of_key<'s>(schema: &'s Map<String, Value>, key: &str) -> Option<&'s Value> {
    let known = schema.get("properties").and_then(|all| all.get(key));
    known.or_else(|| schema.get("additionalProperties"))
}

/// Returns the name of a list in a message: its key, with its index if it is a list in a list, and its owner.
fn list_name(at: &Place<'_>, owner: &str) -> String {
    let place = at.path.last_index();
    let place = place.map_or(String::new(), |i| format!("entry {} of ", i + 1));
    format!("{place}{}{owner}", at.path.last_key().unwrap_or_default())
}

/// Tables and keys with coordinates.
const GEOMETRY: &str = "plane_normal parameter joint coupling point search";
/// The keys of those tables whose numbers are coordinates.
const COORDINATES: &str = "point axis reference lead pitch ratio";

/// Replaces the coordinates of a file that end with a zero by expressions of the same digits. As a double 0.49400 is 0.494, which
/// seems to be known less precisely.
fn keep_digits(root: &mut Spanned<DeValue<'_>>) {
    let DeValue::Table(table) = root.get_mut() else {
        return;
    };
    for (key, value) in table.iter_mut() {
        if GEOMETRY.split(' ').any(|k| k == key.get_ref()) {
            let whole = ["plane_normal", "parameter"].contains(&&**key.get_ref());
            quote_decimals(value, whole);
        }
    }
}

/// Replaces the decimals below a value that are coordinates; all of them are if it is `whole`.
fn quote_decimals(value: &mut Spanned<DeValue<'_>>, whole: bool) {
    match value.get_mut() {
        DeValue::Float(x) if whole => {
            let mantissa = x.as_str().split(['e', 'E']).next().unwrap_or("");
            if mantissa.contains('.') && mantissa.ends_with('0') {
                *value.get_mut() = DeValue::String(x.as_str().to_owned().into());
            }
        }
        DeValue::Array(list) => list.iter_mut().for_each(|v| quote_decimals(v, whole)),
        DeValue::Table(table) => {
            for (key, item) in table.iter_mut() {
                let own = COORDINATES.split(' ').any(|k| k == key.get_ref());
                quote_decimals(item, whole || own);
            }
        }
        _ => {}
    }
}
