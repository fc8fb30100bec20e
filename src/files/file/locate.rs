//! A text of TOML or JSON as values with their places, parsed once for the content and the problems of a file.

use jsonc_parser::ast;
use jsonc_parser::common::Ranged;
use serde::de::DeserializeOwned;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue, ValueDeserializer};

/// A step into a document.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Step {
    /// A key of a table.
    Key(String),
    /// A place in a list.
    Index(usize),
    /// A key of a table, for the place of the key itself instead of its value.
    Name(String),
}

/// The path of an item of a document.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct DocumentPath(Vec<Step>);

impl DocumentPath {
    /// Returns the path of a key of the whole document.
    #[must_use]
    pub fn root_key(key: &str) -> DocumentPath {
        DocumentPath::default().key(key)
    }

    /// Returns the path of a key of the table at this path.
    #[must_use]
    pub fn key(&self, key: &str) -> DocumentPath {
        self.with_step(Step::Key(key.to_owned()))
    }

    /// Returns the path of an entry of the list at this path.
    #[must_use]
    pub fn entry_at(&self, i: usize) -> DocumentPath {
        self.with_step(Step::Index(i))
    }

    /// Returns the path of a key itself, instead of its value.
    pub(crate) fn name(&self, key: &str) -> DocumentPath {
        self.with_step(Step::Name(key.to_owned()))
    }

    fn with_step(&self, step: Step) -> DocumentPath {
        DocumentPath(self.0.iter().cloned().chain([step]).collect())
    }

    /// Returns the last key of the path.
    pub(crate) fn last_key(&self) -> Option<&str> {
        self.0.iter().rev().find_map(|step| match step {
            Step::Key(k) | Step::Name(k) => Some(k.as_str()),
            Step::Index(_) => None,
        })
    }

    /// Returns the place in its list, if the path ends with one.
    pub(crate) fn last_index(&self) -> Option<usize> {
        match self.0.last()? {
            Step::Index(i) => Some(*i),
            _ => None,
        }
    }
}

/// A message about a syntax error, and its place in the text.
pub(crate) type Syntax = (String, Option<Range<usize>>);

/// A document with the place of each key and value, from TOML or JSON.
#[derive(Debug)]
pub struct Document<'t> {
    pub(crate) root: Spanned<DeValue<'t>>,
}

impl<'t> Document<'t> {
    /// Reads a text.
    ///
    /// # Errors
    /// Returns the message and the place of a syntax error.
    pub fn parse(text: &'t str, json: bool) -> Result<Document<'t>, Syntax> {
        if json {
            let root = parse_json(text)?;
            return Ok(Document { root });
        }
        let table = DeTable::parse(text).map_err(toml_error)?;
        let root = Spanned::new(table.span(), DeValue::Table(table.into_inner()));
        Ok(Document { root })
    }

    /// Returns the content of the document as a file.
    pub(crate) fn into_file<T: DeserializeOwned>(self) -> Result<T, Syntax> {
        T::deserialize(ValueDeserializer::from(self.root)).map_err(toml_error)
    }

    /// Returns the bytes of an item, or of the innermost existing thing around it.
    ///
    /// # Examples
    /// ```
    /// use ozols::file::locate::{Document, DocumentPath};
    /// let text = "name = \"mine\"\n[[link]]\nid = \"0\"";
    /// let document = Document::parse(text, false).expect("it is TOML");
    /// let place = DocumentPath::root_key("link").entry_at(0).key("id");
    /// assert_eq!(document.find_span(&place).map(|span| &text[span]), Some("\"0\""));
    /// ```
    #[must_use]
    pub fn find_span(&self, path: &DocumentPath) -> Option<Range<usize>> {
        let mut at = &self.root;
        let mut found = None;
        for step in &path.0 {
            let next = match step {
                Step::Key(k) => at.get_ref().get(k.as_str()),
                Step::Index(i) => at.get_ref().get(*i),
                Step::Name(k) => {
                    let table = at.get_ref().as_table();
                    let entry = table.and_then(|t| t.get_key_value(k.as_str()));
                    return entry.map(|(name, _)| name.span()).or(found);
                }
            };
            let Some(next) = next else { break };
            at = next;
            found = Some(at.span());
        }
        found
    }
}

fn toml_error(e: toml::de::Error) -> Syntax {
    (e.message().trim().replace('\n', ", "), e.span())
}

fn parse_json(text: &str) -> Result<Spanned<DeValue<'_>>, Syntax> {
    // This has a limit of depth.
    serde_json::from_str::<serde_json::Value>(text).map_err(|e| json_error(text, &e))?;
    let collect = jsonc_parser::CollectOptions::default();
    let parsed = jsonc_parser::parse_to_ast(text, &collect, &Default::default());
    let root = parsed.ok().and_then(|p| p.value);
    located_json(root.ok_or(("the file has no value".to_owned(), None))?)
}

fn json_error(text: &str, e: &serde_json::Error) -> Syntax {
    let lines = text.split_inclusive('\n').take(e.line().saturating_sub(1));
    let start: usize = lines.map(str::len).sum();
    let line = text[start..].lines().next().unwrap_or("");
    let mut at = e.column().saturating_sub(1).min(line.len());
    while !line.is_char_boundary(at) {
        at -= 1;
    }
    let end = (at + 1..line.len()).find(|&i| line.is_char_boundary(i));
    let message = e.to_string();
    let message = message.rsplit_once(" at line ").map_or(&*message, |m| m.0);
    let span = start + at..start + end.unwrap_or(line.len());
    (message.to_owned(), Some(span))
}

/// Returns a value of JSON as one of TOML in the same place; keys that are null are omitted.
fn located_json(value: ast::Value<'_>) -> Result<Spanned<DeValue<'_>>, Syntax> {
    let place = |r: jsonc_parser::common::Range| r.start..r.end;
    let span = place(value.range());
    let error = |message: &str| (message.to_owned(), Some(span.clone()));
    let made = match value {
        ast::Value::StringLit(s) => DeValue::String(s.value),
        ast::Value::NumberLit(n) => DeValue::parse(n.value)
            .map_err(|e| error(e.message()))?
            .into_inner(),
        ast::Value::BooleanLit(b) => DeValue::Boolean(b.value),
        ast::Value::NullKeyword(_) => return Err(error("null is not allowed in a list")),
        ast::Value::Array(list) => {
            let items = list.elements.into_iter().map(located_json);
            DeValue::Array(items.collect::<Result<_, _>>()?)
        }
        ast::Value::Object(object) => {
            let mut table = DeTable::new();
            for property in object.properties {
                let key = place(property.name.range());
                let name = Spanned::new(key.clone(), property.name.into_string().into());
                if matches!(property.value, ast::Value::NullKeyword(_)) {
                    continue;
                }
                let message = format!("duplicate field `{}`", name.get_ref());
                if table.insert(name, located_json(property.value)?).is_some() {
                    return Err((message, Some(key)));
                }
            }
            DeValue::Table(table)
        }
    };
    Ok(Spanned::new(span, made))
}
