//! Where in the text an item stands.

use jsonc_parser::ast;
use jsonc_parser::common::Ranged;
use std::ops::Range;

/// A step into a document.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Step {
    /// A key of a table.
    Key(String),
    /// A place in a list.
    Index(usize),
}

/// Bytes of the item at a path, or of the deepest part of the path that exists.
#[must_use]
pub fn locate(text: &str, json: bool, path: &[Step]) -> Option<Range<usize>> {
    if json {
        in_json(text, path)
    } else {
        in_toml(text, path)
    }
}

fn in_toml(text: &str, path: &[Step]) -> Option<Range<usize>> {
    let document = toml_edit::Document::parse(text).ok()?;
    let mut item = document.as_item();
    let mut found = None;
    for step in path {
        let next = match step {
            Step::Key(k) => item.get(k.as_str()),
            Step::Index(i) => item.get(*i),
        };
        let Some(next) = next else { break };
        item = next;
        found = item.span().or(found);
    }
    found
}

fn in_json(text: &str, path: &[Step]) -> Option<Range<usize>> {
    let parsed = jsonc_parser::parse_to_ast(
        text,
        &jsonc_parser::CollectOptions::default(),
        &Default::default(),
    )
    .ok()?;
    let root = parsed.value?;
    let mut at: &ast::Value = &root;
    let mut found = None;
    for step in path {
        let next = match (step, at) {
            (Step::Key(k), ast::Value::Object(o)) => o.get(k).map(|p| &p.value),
            (Step::Index(i), ast::Value::Array(a)) => a.elements.get(*i),
            _ => None,
        };
        let Some(next) = next else { break };
        at = next;
        let range = at.range();
        found = Some(range.start..range.end);
    }
    found
}
