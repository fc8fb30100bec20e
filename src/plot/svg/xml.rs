//! A small XML writer: it closes elements, escapes text and writes all numbers in one format.

use crate::format::decimals;
use crate::format::plain::escape_direction;

/// A document being written.
#[derive(Debug, Default)]
pub struct Xml {
    out: String,
    open: Vec<&'static str>,
}

/// A start tag being written; it is closed by one of the methods that take it.
#[must_use]
#[derive(Debug)]
pub struct Tag<'a> {
    xml: &'a mut Xml,
    name: &'static str,
}

impl Xml {
    /// Begins a self-contained picture of a width and a height in pixels with a title, a description, its style sheet and its ground.
    pub fn begin_picture(
        class: &str,
        size: [f64; 2],
        [title, description]: [&str; 2],
        style: &'static str,
    ) -> Xml {
        let [width, height] = size.map(f64::ceil);
        let mut xml = Xml::default();
        xml.begin_tag("svg")
            .set_text("xmlns", "http://www.w3.org/2000/svg")
            .set_text("class", class)
            .set_number("width", width)
            .set_number("height", height)
            .set_text("viewBox", &format!("0 0 {width} {height}"))
            .set_text("role", "img")
            .keep_open();
        xml.begin_tag("title").write_text(title);
        xml.write_raw("\n");
        xml.begin_tag("desc").write_text(description);
        xml.begin_tag("style").keep_open();
        xml.write_raw("\n");
        xml.write_raw(style);
        xml.end_element();
        xml.begin_tag("rect")
            .set_text("class", "bg")
            .set_number("width", width)
            .set_number("height", height)
            .close_empty();
        xml
    }

    /// Begins an element.
    pub fn begin_tag(&mut self, name: &'static str) -> Tag<'_> {
        self.out.push('<');
        self.out.push_str(name);
        Tag { xml: self, name }
    }

    /// Writes text inside the innermost open element.
    pub(crate) fn write_text(&mut self, text: &str) {
        escape_text(&mut self.out, text);
    }

    /// Writes text that is known to need no escaping.
    pub fn write_raw(&mut self, text: &'static str) {
        self.out.push_str(text);
    }

    /// Writes elements that this writer has finished before.
    pub fn write_piece(&mut self, elements: &str) {
        self.out.push_str(elements);
    }

    /// Closes the innermost open element.
    pub fn end_element(&mut self) {
        if let Some(name) = self.open.pop() {
            self.out.push_str("</");
            self.out.push_str(name);
            self.out.push('>');
            if !matches!(name, "tspan" | "title") {
                self.out.push('\n');
            }
        }
    }

    /// Closes every open element and returns the document.
    pub fn finish_document(mut self) -> String {
        while !self.open.is_empty() {
            self.end_element();
        }
        self.out
    }
}

impl Tag<'_> {
    /// Adds an attribute with text.
    pub fn set_text(self, name: &str, value: &str) -> Self {
        self.xml.out.push(' ');
        self.xml.out.push_str(name);
        self.xml.out.push_str("=\"");
        escape_text(&mut self.xml.out, value);
        self.xml.out.push('"');
        self
    }

    /// Adds an attribute with a number.
    pub fn set_number(self, name: &str, value: f64) -> Self {
        self.set_text(name, &format_number(value))
    }

    /// Keeps the element open.
    pub fn keep_open(self) {
        self.xml.out.push('>');
        self.xml.open.push(self.name);
    }

    /// Closes the element with nothing inside.
    pub fn close_empty(self) {
        self.xml.out.push_str("/>\n");
    }

    /// Closes the element with text inside.
    pub fn write_text(self, text: &str) {
        self.xml.out.push('>');
        escape_text(&mut self.xml.out, text);
        self.xml.open.push(self.name);
        self.xml.end_element();
    }

    /// Closes the element with text inside, and adds the full text as a tooltip if it differs.
    pub(crate) fn text_and_tip(self, text: &str, whole: &str) {
        self.xml.out.push('>');
        self.xml.open.push(self.name);
        if text != whole {
            self.xml.begin_tag("title").write_text(whole);
        }
        escape_text(&mut self.xml.out, text);
        self.xml.end_element();
    }

    /// Closes the element with a tooltip inside, if there is one to show.
    pub fn close_with_tip(self, tip: &str) {
        if tip.is_empty() {
            return self.close_empty();
        }
        self.xml.out.push('>');
        self.xml.open.push(self.name);
        self.xml.begin_tag("title").write_text(tip);
        self.xml.end_element();
    }
}

/// Formats a coordinate with at most two decimals, no trailing zeros and no negative zero.
pub fn format_number(value: f64) -> String {
    decimals(value, 2)
}

/// Appends `text` so that it is valid character data anywhere in XML or HTML. A character that XML forbids becomes
/// U+FFFD, and one that changes the direction of letters is spelt out.
pub(crate) fn escape_text(out: &mut String, text: &str) {
    for c in escape_direction(text).chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            '\t' | '\n' => out.push(c),
            '\0'..='\x1f' | '\x7f'..='\u{9f}' | '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            _ => out.push(c),
        }
    }
}
