//! XML as a flat arena with the place of every element and attribute, bounded in size, depth and number.

pub(crate) mod element;

use crate::file::problem::ProblemKind;
use crate::file::text;
use crate::robots::warning::{
    Options, Read, Reader as FileReader, syntax_problem, too_deep, too_large, too_many,
};
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use std::ops::Range;

/// Largest file, in bytes.
pub(crate) const MAX_BYTES: usize = 64 << 20;
/// Maximum nesting depth.
pub(crate) const MAX_DEPTH: usize = 4000;
/// Maximum number of elements.
pub(crate) const MAX_ELEMENTS: usize = 500_000;
/// Maximum number of attributes of one element, and of all together.
const MAX_ATTRIBUTES: (usize, usize) = (256, 1_000_000);

/// A file's name and text.
#[derive(Debug, Clone)]
pub(crate) struct Source {
    pub(super) name: String,
    pub(super) text: String,
}

#[derive(Debug, Clone)]
struct Attribute {
    name: String,
    value: String,
    span: Range<usize>,
}

#[derive(Debug, Clone)]
pub(crate) struct Node {
    pub(super) name: String,
    attributes: Vec<Attribute>,
    text: String,
    pub(super) children: Vec<usize>,
    pub(super) source: usize,
    /// The span of its start tag.
    pub(super) span: Range<usize>,
    /// The span of its end tag; empty, after the start tag, if there is only one tag.
    pub(super) close: Range<usize>,
}

impl Node {
    fn find(&self, name: &str) -> Option<&Attribute> {
        self.attributes.iter().find(|a| a.name == name)
    }

    /// Sets the attribute `name`, if the node has one.
    pub(super) fn rename(&mut self, name: String) {
        if let Some(own) = self.attributes.iter_mut().find(|a| a.name == "name") {
            own.value = name;
        }
    }

    /// Creates a node without attributes: a line of a file that is not XML.
    pub(super) fn from_line(name: &str, source: usize, span: Range<usize>) -> Node {
        Node {
            name: name.to_owned(),
            attributes: Vec::new(),
            text: String::new(),
            children: Vec::new(),
            source,
            close: span.end..span.end,
            span,
        }
    }

    /// Adds a line to the text.
    pub(super) fn append_line(&mut self, line: &str) {
        if !self.text.is_empty() {
            self.text.push('\n');
        }
        self.text.push_str(line);
    }
}

/// The elements of a file and of those it includes.
#[derive(Debug, Clone, Default)]
pub(crate) struct Document {
    pub(super) sources: Vec<Source>,
    pub(super) nodes: Vec<Node>,
}

/// A description to be read: its root element, the files that it includes, and how to read it.
pub(crate) struct Input<'a> {
    pub(crate) document: &'a mut Document,
    pub(crate) root: usize,
    pub(crate) read: FileReader<'a>,
    pub(crate) options: &'a Options,
}

/// Returns bytes as text.
pub(crate) fn decode_utf8(name: &str, bytes: &[u8]) -> Read<String> {
    if bytes.len() > MAX_BYTES {
        return Err(too_large(bytes.len(), MAX_BYTES).in_file(name, "", None));
    }
    let text = text::decode_utf8(bytes).map_err(|problem| problem.in_file(name, "", None))?;
    Ok(text.strip_prefix('\u{feff}').unwrap_or(text).to_owned())
}

impl Document {
    /// Reads a file into the arena; gives its root element.
    pub(crate) fn read(&mut self, name: &str, text: String) -> Read<usize> {
        let source = self.sources.len();
        let total = text.len() + self.sources.iter().map(|s| s.text.len()).sum::<usize>();
        if total > MAX_BYTES {
            return Err(too_large(total, MAX_BYTES).in_file(name, "", None));
        }
        let root = parse_xml(&text, source, &mut self.nodes).map_err(|(problem, at)| {
            let mut before = (0..=at.min(text.len())).rev();
            let at = before.find(|&i| text.is_char_boundary(i)).unwrap_or(0);
            problem.in_file(name, &text, Some(at..at))
        })?;
        let name = name.to_owned();
        self.sources.push(Source { name, text });
        Ok(root)
    }
}

type Located = (ProblemKind, usize);
type Parsed<T> = Result<T, Located>;

fn xml_problem(message: impl std::fmt::Display) -> ProblemKind {
    syntax_problem(format!("{message}; the file is not well-formed XML"))
}

/// Rejects control characters, which could control a terminal, except those that lay out the text.
fn no_control(text: &str, layout: &[char]) -> Parsed<()> {
    let found = text.char_indices();
    let mut found = found.filter(|(_, c)| c.is_control() && !layout.contains(c));
    found.next().map_or(Ok(()), |(at, c)| {
        let c = c.escape_unicode();
        let message = format!("the control character {c} is not allowed");
        Err((xml_problem(message), at))
    })
}

/// Checks that one more element keeps the limits of depth, of elements and of attributes.
fn few_enough(depth: usize, elements: usize, attributes: usize) -> Result<(), ProblemKind> {
    if depth >= MAX_DEPTH {
        return Err(too_deep(MAX_DEPTH));
    }
    if elements >= MAX_ELEMENTS {
        return Err(too_many("elements", MAX_ELEMENTS));
    }
    if attributes > MAX_ATTRIBUTES.1 {
        return Err(too_many("attributes", MAX_ATTRIBUTES.1));
    }
    Ok(())
}

fn parse_xml(text: &str, source: usize, nodes: &mut Vec<Node>) -> Parsed<usize> {
    no_control(text, &['\t', '\n', '\r'])?;
    let mut reader = Reader::from_str(text);
    let (mut open, mut root): (Vec<usize>, Option<usize>) = (Vec::new(), None);
    let mut attributes = 0;
    loop {
        let before = byte_position(reader.buffer_position());
        let event = reader
            .read_event()
            .map_err(|e| (xml_problem(e), byte_position(reader.error_position())))?;
        let after = byte_position(reader.buffer_position());
        match event {
            Event::Start(ref tag) | Event::Empty(ref tag) => {
                if open.is_empty() && root.is_some() {
                    return Err((xml_problem("a second root element"), before));
                }
                few_enough(open.len(), nodes.len(), attributes)
                    .map_err(|problem| (problem, before))?;
                let id = nodes.len();
                nodes.push(read_node(tag, text, source, before..after)?);
                attributes += nodes[id].attributes.len();
                match open.last() {
                    Some(&parent) => nodes[parent].children.push(id),
                    None => root = Some(id),
                }
                if matches!(event, Event::Start(_)) {
                    open.push(id);
                }
            }
            Event::End(_) => {
                if let Some(id) = open.pop() {
                    nodes[id].close = before..after;
                }
            }
            Event::Text(t) => append_text(&t, &open, nodes),
            Event::CData(t) => append_text(&t, &open, nodes),
            Event::GeneralRef(r) => {
                let word = format!("&{};", &*r);
                let plain = quick_xml::escape::unescape(&word)
                    .map_err(|e| (xml_problem(e), before))?
                    .into_owned();
                no_control(&plain, &[]).map_err(|(problem, _)| (problem, before))?;
                append_text(&plain, &open, nodes);
            }
            Event::DocType(t) if t.contains("<!ENTITY") => {
                let message = "the file declares entities; expand them first, for example with the option `noent` of xmllint";
                return Err((syntax_problem(message), before));
            }
            Event::Eof if !open.is_empty() => {
                let name = &nodes[open[open.len() - 1]].name;
                return Err((xml_problem(format!("<{name}> is not closed")), text.len()));
            }
            Event::Eof => {
                return root.ok_or_else(|| (xml_problem("there is no element"), text.len()));
            }
            Event::Comment(_) | Event::Decl(_) | Event::PI(_) | Event::DocType(_) => {}
        }
    }
}

fn byte_position(at: u64) -> usize {
    usize::try_from(at).unwrap_or(usize::MAX)
}

fn append_text(text: &str, open: &[usize], nodes: &mut [Node]) {
    if let Some(&at) = open.last()
        && !text.trim().is_empty()
    {
        nodes[at].text.push_str(text);
    }
}

fn read_node(tag: &BytesStart<'_>, text: &str, source: usize, span: Range<usize>) -> Parsed<Node> {
    let start = text.as_ptr() as usize;
    let mut attributes: Vec<Attribute> = Vec::new();
    for found in tag.attributes().with_checks(false) {
        let found = found.map_err(|e| (xml_problem(e), span.start))?;
        let name: &str = found.key.as_ref();
        let value = found.normalized_value(quick_xml::XmlVersion::Implicit1_0);
        let value = value
            .map_err(|e| (xml_problem(e), span.start))?
            .into_owned();
        no_control(&value, &[]).map_err(|(problem, _)| (problem, span.start))?;
        if attributes.len() >= MAX_ATTRIBUTES.0 {
            let problem = too_many("attributes of one element", MAX_ATTRIBUTES.0);
            return Err((problem, span.start));
        }
        if attributes.iter().any(|a| a.name == name) {
            let message = format!("the attribute {name} is given twice");
            return Err((xml_problem(message), span.start));
        }
        // The value is borrowed from the text if the reader could do so.
        let at = (found.value.as_ptr() as usize).wrapping_sub(start);
        let here = Some(at..at.saturating_add(found.value.len()));
        let here = here.filter(|here| text.get(here.clone()).is_some());
        let (name, span) = (name.to_owned(), here.unwrap_or(span.clone()));
        attributes.push(Attribute { name, value, span });
    }
    let node = Node::from_line(tag.name().as_ref(), source, span);
    Ok(Node { attributes, ..node })
}
