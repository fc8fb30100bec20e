//! Where in the text an item stands.

use jsonc_parser::ast;
use jsonc_parser::common::Ranged;
use std::ops::Range;

/// A step into a document.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum DocumentStep {
    /// A key of a table.
    Key(String),
    /// A place in a list.
    Index(usize),
}

/// Returns a path extended by a key.
pub(crate) fn key(path: &[DocumentStep], k: &str) -> Vec<DocumentStep> {
    path.iter()
        .cloned()
        .chain([DocumentStep::Key(k.to_owned())])
        .collect()
}

/// Returns a path extended by a place in a list.
pub(crate) fn index(path: &[DocumentStep], i: usize) -> Vec<DocumentStep> {
    path.iter()
        .cloned()
        .chain([DocumentStep::Index(i)])
        .collect()
}

/// Returns the last key of a path.
pub(crate) fn last_key(path: &[DocumentStep]) -> Option<&str> {
    path.iter().rev().find_map(|step| match step {
        DocumentStep::Key(k) => Some(k.as_str()),
        DocumentStep::Index(_) => None,
    })
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
    /// Reads a text; `None` where it cannot be read.
    #[must_use]
    pub fn new(text: &'t str, json: bool) -> Option<Document<'t>> {
        if !json {
            return toml_edit::Document::parse(text).ok().map(Document::Toml);
        }
        let parsed = jsonc_parser::parse_to_ast(
            text,
            &jsonc_parser::CollectOptions::default(),
            &Default::default(),
        );
        parsed.ok()?.value.map(Document::Json)
    }

    /// Returns the bytes of the item at a path, or of the deepest part of the path that exists.
    #[must_use]
    pub fn span(&self, path: &[DocumentStep]) -> Option<Range<usize>> {
        match self {
            Document::Toml(document) => in_toml(document.as_item(), path),
            Document::Json(root) => in_json(root, path),
        }
    }
}

fn in_toml(root: &toml_edit::Item, path: &[DocumentStep]) -> Option<Range<usize>> {
    let mut item = root;
    let mut found = None;
    for step in path {
        let next = match step {
            DocumentStep::Key(k) => item.get(k.as_str()),
            DocumentStep::Index(i) => item.get(*i),
        };
        let Some(next) = next else { break };
        item = next;
        found = item.span().or(found);
    }
    found
}

fn in_json(root: &ast::Value<'_>, path: &[DocumentStep]) -> Option<Range<usize>> {
    let mut at = root;
    let mut found = None;
    for step in path {
        let next = match (step, at) {
            (DocumentStep::Key(k), ast::Value::Object(o)) => o.get(k).map(|p| &p.value),
            (DocumentStep::Index(i), ast::Value::Array(a)) => a.elements.get(*i),
            _ => None,
        };
        let Some(next) = next else { break };
        at = next;
        let range = at.range();
        found = Some(range.start..range.end);
    }
    found
}
