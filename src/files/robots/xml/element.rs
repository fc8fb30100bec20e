//! An element: its name, attributes, text and children, the numbers of these, and problems with it.

use crate::file::problem::{ImportError, ProblemKind};
use crate::geom::vector::Vector;
use crate::robots::warning::{
    Read, bad_value, missing_problem, syntax_problem, too_many, unknown_name, unknown_word,
    unsupported_problem,
};
use crate::robots::xml::{Document, Node};
use std::ops::Range;

/// Maximum number of links, and of joints, of a robot.
const MAX_PARTS: usize = 10_000;
/// Maximum absolute value of a number; the mechanism file takes lengths up to 1e12.
const MAX_NUMBER: f64 = 1e9;

/// An element.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Element<'a> {
    pub(in crate::robots) document: &'a Document,
    pub(in crate::robots) id: usize,
}

impl Document {
    pub(crate) fn element(&self, id: usize) -> Element<'_> {
        Element { document: self, id }
    }
}

impl<'a> Element<'a> {
    pub(in crate::robots) fn node(self) -> &'a Node {
        &self.document.nodes[self.id]
    }

    pub(crate) fn name(self) -> &'a str {
        &self.node().name
    }

    /// Returns whether the element has one of several names, which are separated by spaces.
    pub(in crate::robots) fn is_one_of(self, names: &str) -> bool {
        names.split(' ').any(|n| n == self.name())
    }

    /// Returns the place of the value of an attribute in the file.
    pub(in crate::robots) fn value_span(self, name: &str) -> Option<Range<usize>> {
        let found = self.node().find(name)?;
        (found.span != self.node().span).then(|| found.span.clone())
    }

    pub(crate) fn text(self) -> &'a str {
        self.node().text.trim()
    }

    pub(crate) fn children(self) -> impl DoubleEndedIterator<Item = Element<'a>> {
        let all = self.node().children.iter();
        all.map(move |&id| self.document.element(id))
    }

    pub(crate) fn children_named(self, name: &str) -> impl Iterator<Item = Element<'a>> {
        self.children().filter(move |c| c.name() == name)
    }

    pub(crate) fn first_child(self, name: &str) -> Option<Element<'a>> {
        self.children().find(|c| c.name() == name)
    }

    pub(crate) fn attribute(self, name: &str) -> Option<&'a str> {
        self.node().find(name).map(|a| a.value.as_str())
    }

    /// Returns the names and values of all attributes.
    pub(crate) fn attributes(self) -> impl Iterator<Item = (&'a str, &'a str)> {
        let all = self.node().attributes.iter();
        all.map(|a| (a.name.as_str(), a.value.as_str()))
    }

    /// Returns the name of the element in messages.
    pub(crate) fn label(self) -> String {
        match self.attribute("name") {
            Some(n) => format!("{} \"{n}\"", self.name()),
            None => format!("<{}>", self.name()),
        }
    }

    /// Returns the error for a problem with the element or with one of its attributes.
    pub(crate) fn error_at(self, attribute: Option<&str>, problem: ProblemKind) -> ImportError {
        let node = self.node();
        let found = attribute.and_then(|name| node.find(name));
        let span = found.map_or(&node.span, |a| &a.span).clone();
        let source = &self.document.sources[node.source];
        problem.in_file(&source.name, &source.text, Some(span))
    }

    /// Returns the error for an element that cannot be mapped.
    pub(crate) fn unsupported_error(self, why: &str, remedy: &str) -> ImportError {
        self.error_at(None, unsupported_problem(&self.label(), why, remedy))
    }

    /// Returns the error for an unknown word.
    pub(crate) fn unknown_word(self, what: &str, word: &str, known: &str) -> ImportError {
        self.error_at(Some(what), unknown_word(&self.label(), what, word, known))
    }

    /// Returns an error if there is no room for one more of `what`.
    pub(crate) fn check_room(self, what: &str, count: usize) -> Read<()> {
        let limit = MAX_PARTS;
        if count < limit {
            return Ok(());
        }
        Err(self.error_at(None, too_many(what, limit)))
    }

    /// Returns the value of an attribute, or an error if it is missing or empty.
    pub(crate) fn required_attribute(self, name: &str) -> Read<&'a str> {
        let found = self.attribute(name).filter(|v| !v.trim().is_empty());
        found.ok_or_else(|| self.missing_error(&format!("attribute {name}")))
    }

    /// Returns the error for a missing item.
    pub(crate) fn missing_error(self, what: &str) -> ImportError {
        self.error_at(None, missing_problem(&self.label(), what))
    }

    /// Returns the error for a name that two elements have.
    pub(crate) fn duplicate_error(self) -> ImportError {
        let message = format!("{} is defined twice; names must be unique", self.label());
        self.error_at(Some("name"), syntax_problem(message))
    }

    /// Returns the error for an attribute or text that names something unknown.
    pub(crate) fn unknown_name(
        self,
        key: Option<&str>,
        what: [&str; 2],
        name: &str,
        known: impl IntoIterator<Item: AsRef<str>>,
    ) -> ImportError {
        self.error_at(key, unknown_name(&self.label(), what, name, known))
    }
}

impl Element<'_> {
    /// Returns the N numbers of an attribute; `None` if the attribute is missing.
    pub(crate) fn read_numbers<const N: usize>(self, name: &str) -> Read<Option<[f64; N]>> {
        self.attribute(name)
            .map(|text| self.parse_numbers(name, text))
            .transpose()
    }

    /// Returns the vector of an attribute, or the default if the attribute is missing.
    pub(crate) fn read_vector(self, name: &str, default: Vector) -> Read<Vector> {
        Ok(self.read_numbers::<3>(name)?.unwrap_or(default))
    }

    /// Returns the N numbers of the element's text.
    pub(crate) fn text_numbers<const N: usize>(self) -> Read<[f64; N]> {
        self.parse_numbers("the text", self.text())
    }

    /// Returns the number in the text of a child, if there is one.
    pub(crate) fn child_number(self, tag: &str) -> Read<Option<f64>> {
        let found = self.first_child(tag).map(|c| c.text_numbers::<1>());
        Ok(found.transpose()?.map(|[x]| x))
    }

    fn parse_numbers<const N: usize>(self, what: &str, text: &str) -> Read<[f64; N]> {
        let bad = || {
            let want = match N {
                _ if text.contains("${") => "expand the macros first, with `xacro FILE`".to_owned(),
                1 => "write one finite number up to 1e9 in size".to_owned(),
                n => format!("write {n} finite numbers up to 1e9 in size, with spaces between"),
            };
            let found: String = text.chars().take(60).collect();
            self.error_at(Some(what), bad_value(&self.label(), what, &found, &want))
        };
        let mut out = [0.0; N];
        let mut words = text.split_whitespace();
        for x in &mut out {
            let found = words.next().and_then(|w| w.parse::<f64>().ok());
            *x = found.filter(|x| x.abs() <= MAX_NUMBER).ok_or_else(bad)?;
        }
        if words.next().is_some() {
            return Err(bad());
        }
        Ok(out)
    }
}
