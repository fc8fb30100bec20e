//! Edits of a description by spans of its text. Everything else stays unchanged, byte for byte.

use crate::geom::vector::Vector;
use crate::robots::description::Part;
use crate::robots::description::origin::Origin;
use crate::robots::mechanism::series_of_single_joints::Names;
use crate::robots::warning::{Read, syntax_problem};
use crate::robots::xml::element::Element;
use std::collections::BTreeMap;
use std::ops::Range;

/// The freedoms that a joint gets: whether each slides, its direction in the world, and why, in words.
pub(crate) type Freed<'a> = &'a [(bool, Vector, String)];

/// A joint that gets freedoms, and the element that it is.
pub(crate) type Freeing<'a> = (&'a Part, Element<'a>, Freed<'a>);

/// Changes to the text of a description.
pub(crate) struct Edits<'a> {
    origin: &'a Origin,
    /// File, what is replaced there, and by what.
    list: Vec<(usize, Range<usize>, String)>,
    /// Lines to stand as the last children of an element.
    children: BTreeMap<usize, Vec<String>>,
    names: Names,
}

impl<'a> Edits<'a> {
    pub(crate) fn new(origin: &'a Origin) -> Edits<'a> {
        let all = 0..origin.document.nodes.len();
        let named = all.filter_map(|id| origin.element(id).attribute("name"));
        Edits {
            origin,
            list: Vec::new(),
            children: BTreeMap::new(),
            names: Names(named.map(str::to_owned).collect()),
        }
    }

    /// Returns a name that no element has.
    pub(crate) fn name(&mut self, wanted: &str) -> String {
        let nth = |n| format!("{wanted}_{n}");
        self.names.unique(wanted.to_owned(), nth)
    }

    fn text(&self, e: Element<'_>) -> &'a str {
        &self.origin.document.sources[e.node().source].text
    }

    /// Returns the text of the element in its file.
    pub(crate) fn raw(&self, e: Element<'_>) -> &'a str {
        &self.text(e)[e.node().span.start..end(e)]
    }

    pub(crate) fn replace(&mut self, e: Element<'_>, span: Range<usize>, by: String) {
        self.list.push((e.node().source, span, by));
    }

    /// Gives an attribute another value, or adds it.
    pub(crate) fn set(&mut self, e: Element<'_>, name: &str, value: &str) -> Read<()> {
        let value = quick_xml::escape::escape(value).into_owned();
        match (e.attribute(name), e.value_span(name)) {
            (_, Some(span)) => self.replace(e, span, value),
            (Some(_), None) => {
                let why = format!("its attribute {name} is written with character references");
                return Err(e.unsupported(&why, "write the characters themselves"));
            }
            (None, None) => {
                // Behind the tag's name.
                let at = e.node().span.start + 1 + e.name().len();
                self.replace(e, at..at, format!(" {name}=\"{value}\""));
            }
        }
        Ok(())
    }

    /// Inserts lines after an element, with its indentation.
    pub(crate) fn after(&mut self, e: Element<'_>, lines: &[String]) {
        let (indent, newline) = self.layout(e);
        let text = lines.iter().map(|l| format!("{newline}{indent}{l}"));
        let text = text.collect();
        self.replace(e, end(e)..end(e), text);
    }

    /// Inserts lines as the last children of an element.
    pub(crate) fn within(&mut self, e: Element<'_>, lines: &[String]) {
        let all = self.children.entry(e.id).or_default();
        all.extend_from_slice(lines);
    }

    /// Returns the indentation of an element and the line ending of its file.
    fn layout(&self, e: Element<'_>) -> (&'a str, &'static str) {
        let text = self.text(e);
        let before = &text[..e.node().span.start];
        let line = &before[before.rfind('\n').map_or(0, |n| n + 1)..];
        let indent = if line.trim().is_empty() { line } else { "" };
        let newline = if text.contains("\r\n") { "\r\n" } else { "\n" };
        (indent, newline)
    }

    fn children(&mut self) {
        for (id, lines) in std::mem::take(&mut self.children) {
            let e = self.origin.element(id);
            let (indent, newline) = self.layout(e);
            let inner: String = lines
                .iter()
                .map(|l| format!("{newline}{indent}  {l}"))
                .collect();
            let node = e.node();
            if node.close.is_empty() {
                // <body .../> is opened.
                let slash = node.span.end - 2..node.span.end;
                self.replace(
                    e,
                    slash,
                    format!(">{inner}{newline}{indent}</{}>", e.name()),
                );
            } else {
                let at = self.text(e)[..node.close.start].trim_end().len();
                self.replace(e, at..at, inner);
            }
        }
    }

    /// Returns the text of the description with all edits.
    pub(crate) fn apply(mut self) -> Read<String> {
        self.children();
        let sources = &self.origin.document.sources;
        // The root's file is the first that was read.
        if let Some((source, span, _)) = self.list.iter().find(|(s, ..)| *s != 0) {
            let source = &sources[*source];
            let message = "the change is in an included file; merge the files, for example by saving the model from MuJoCo as XML, or change joints of the main file only";
            return Err(syntax_problem(message).in_file(
                &source.name,
                &source.text,
                Some(span.clone()),
            ));
        }
        // Stable: what stands at one place keeps its order.
        self.list.sort_by_key(|(_, span, _)| span.start);
        let (text, mut out, mut at) = (&sources[0].text, String::new(), 0);
        for (_, span, by) in &self.list {
            if span.start < at {
                let message = "two changes affect the same place; make them one at a time";
                return Err(syntax_problem(message).in_file(
                    &sources[0].name,
                    text,
                    Some(span.clone()),
                ));
            }
            out.push_str(&text[at..span.start]);
            out.push_str(by);
            at = span.end;
        }
        out.push_str(&text[at..]);
        Ok(out)
    }
}

/// Returns the end of an element.
pub(crate) fn end(e: Element<'_>) -> usize {
    e.node().close.end.max(e.node().span.end)
}
