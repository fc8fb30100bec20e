//! The place of an item in the text.

use jsonc_parser::ast;
use jsonc_parser::common::Ranged;
use std::ops::Range;

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

/// A document whose items can be found; read once for all its problems.
#[derive(Debug)]
pub enum Document<'t> {
    /// TOML.
    Toml(toml_edit::Document<&'t str>),
    /// JSON.
    Json(ast::Value<'t>),
}

impl<'t> Document<'t> {
    /// Reads a text; `None` if it cannot be read.
    #[must_use]
    pub fn new(text: &'t str, json: bool) -> Option<Document<'t>> {
        if !json {
            return toml_edit::Document::parse(text).ok().map(Document::Toml);
        }
        let collect = jsonc_parser::CollectOptions::default();
        let parsed = jsonc_parser::parse_to_ast(text, &collect, &Default::default());
        parsed.ok()?.value.map(Document::Json)
    }

    /// Returns the bytes of an item, or of the innermost existing thing around it.
    ///
    /// # Examples
    /// ```
    /// use ozols::file::locate::{Document, DocumentPath};
    /// let text = "name = \"mine\"\n[[link]]\nid = \"0\"";
    /// let document = Document::new(text, false).expect("it is TOML");
    /// let place = DocumentPath::root_key("link").entry_at(0).key("id");
    /// assert_eq!(document.find_span(&place).map(|span| &text[span]), Some("\"0\""));
    /// ```
    #[must_use]
    pub fn find_span(&self, path: &DocumentPath) -> Option<Range<usize>> {
        match self {
            Document::Toml(document) => in_toml(document.as_item(), &path.0),
            Document::Json(root) => in_json(root, &path.0),
        }
    }
}

fn in_toml(root: &toml_edit::Item, path: &[Step]) -> Option<Range<usize>> {
    let mut item = root;
    let mut found = None;
    for step in path {
        let next = match step {
            Step::Key(k) => item.get(k.as_str()),
            Step::Index(i) => item.get(*i),
            Step::Name(k) => {
                let key = item.as_table_like().and_then(|t| t.key(k));
                return key.and_then(toml_edit::Key::span).or(found);
            }
        };
        let Some(next) = next else { break };
        item = next;
        found = item.span().or(found);
    }
    found
}

fn in_json(root: &ast::Value<'_>, path: &[Step]) -> Option<Range<usize>> {
    let mut at = root;
    let mut found = None;
    for step in path {
        let next = match (step, at) {
            (Step::Key(k), ast::Value::Object(o)) => o.get(k).map(|p| &p.value),
            (Step::Index(i), ast::Value::Array(a)) => a.elements.get(*i),
            (Step::Name(k), ast::Value::Object(o)) => {
                let name = o.get(k).map(|p| p.name.range());
                return name.map(|r| r.start..r.end).or(found);
            }
            _ => None,
        };
        let Some(next) = next else { break };
        at = next;
        let range = at.range();
        found = Some(range.start..range.end);
    }
    found
}
