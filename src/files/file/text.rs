//! Reading a mechanism from text. Control characters are not allowed in names, because they could control a terminal or break a
//! table.

use crate::file::problem::{ImportError, ProblemKind, is_json};
use crate::file::read::build_mechanism;
use crate::file::schema::MechanismFile;
use crate::file::shape::wrong_shapes;
use crate::file::{Finding, Findings, Place, digits, unknown_word};
use crate::model::mechanism::Mechanism;
use serde_json::Value;
use std::ops::Range;

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
    // First of all, as the deserializer of TOML ignores the values that a list has too many.
    let values = parse_values(text, json).unwrap_or_default();
    let shapes = wrong_shapes(&values);
    if !shapes.is_empty() {
        return Err(located(shapes));
    }
    let parse = if json { from_json } else { from_toml };
    let mut file = parse(text).map_err(|(message, span)| {
        ProblemKind::from(with_remedy(message)).in_file(name, text, span)
    })?;
    if let Some(Ok(kept)) = digits::quote_decimals(text, json, &values).map(|text| parse(&text)) {
        file = kept;
    }
    // TOML and JSON allow control characters only as escapes.
    let controls = if text.contains('\\') {
        find_controls(&file)
    } else {
        Vec::new()
    };
    let made = if controls.is_empty() {
        make(&file)
    } else {
        Err(controls)
    };
    made.map_err(located)
}

/// Returns the values of a file before they are given a meaning; `None` if it cannot be read.
fn parse_values(text: &str, json: bool) -> Option<serde_json::Value> {
    if json {
        serde_json::from_str(text).ok()
    } else {
        toml::from_str(text).ok()
    }
}

/// A message about a syntax error, and its place in the text.
type Syntax = (String, Option<Range<usize>>);

fn from_toml(text: &str) -> Result<MechanismFile, Syntax> {
    toml::from_str(text).map_err(|e| (e.message().trim().replace('\n', ", "), e.span()))
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

fn from_json(text: &str) -> Result<MechanismFile, Syntax> {
    serde_json::from_str(text).map_err(|e| {
        let line_start: usize = text
            .split_inclusive('\n')
            .take(e.line().saturating_sub(1))
            .map(str::len)
            .sum();
        let line = text
            .get(line_start..)
            .and_then(|t| t.lines().next())
            .unwrap_or("");
        let mut at = e.column().saturating_sub(1).min(line.len());
        while !line.is_char_boundary(at) {
            at -= 1;
        }
        let full = e.to_string();
        let message = full
            .rsplit_once(" at line ")
            .map_or(full.as_str(), |(m, _)| m);
        let end = (at + 1..=line.len()).find(|&i| line.is_char_boundary(i));
        let span = line_start + at..line_start + end.unwrap_or(line.len());
        (message.to_owned(), Some(span))
    })
}

/// Texts of more than one line.
const PROSE: [&str; 3] = ["description", "sources", "assumed"];

/// Finds every control character in a file's strings and keys.
///
/// # Complexity
/// The file is written out once as a value.
pub(crate) fn find_controls(file: &MechanismFile) -> Vec<Finding> {
    let out = Findings::default();
    if let Ok(value) = serde_json::to_value(file) {
        check_controls_below(&value, &out.root_place());
    }
    out.into_findings()
}

fn check_controls_below(value: &Value, at: &Place<'_>) {
    match value {
        Value::String(text) => check_text(text, at),
        Value::Array(all) => at
            .each_entry(all)
            .for_each(|(at, value)| check_controls_below(value, &at)),
        Value::Object(all) => {
            for (key, value) in all {
                check_text(key, at);
                check_controls_below(value, &at.key(key));
            }
        }
        Value::Null | Value::Bool(_) | Value::Number(_) => {}
    }
}

fn check_text(text: &str, at: &Place<'_>) {
    let key = at.path.last_key().unwrap_or("the file");
    let allowed = |c: char| PROSE.contains(&key) && (c == '\n' || c == '\t');
    let found = text.chars().find(|&c| c.is_control() && !allowed(c));
    if let Some(found) = found {
        at.add_problem(format!(
            "{key} contains the control character {}; remove it",
            found.escape_unicode()
        ));
    }
}
