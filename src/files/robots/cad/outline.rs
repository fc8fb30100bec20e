//! Text laid out by tabs, a label in a line and its values one tab deeper, as elements: a label is one without attributes, and
//! its text the lines below it that have nothing below them.

use crate::file::problem::ProblemKind;
use crate::robots::warning::{Read, syntax_problem, too_deep, too_many};
use crate::robots::xml::{Document, MAX_DEPTH, MAX_ELEMENTS, Node, Source};

impl Document {
    /// Reads a file laid out by tabs into the arena from a line on; gives its first label. Lines from one on that `ends` are not
    /// read.
    pub(crate) fn read_outline(
        &mut self,
        name: &str,
        text: String,
        from: usize,
        ends: &str,
    ) -> Read<usize> {
        let source = self.sources.len();
        let root = self.nodes.len();
        let nodes = outline(&text, source, root, from, ends)
            .map_err(|(problem, at)| problem.in_file(name, &text, Some(at..at)))?;
        self.nodes.extend(nodes);
        let name = name.to_owned();
        self.sources.push(Source { name, text });
        Ok(root)
    }
}

type Located = (ProblemKind, usize);

/// Returns the lines as nodes, whose places in the arena begin at `first`.
fn outline(
    text: &str,
    source: usize,
    first: usize,
    from: usize,
    ends: &str,
) -> Result<Vec<Node>, Located> {
    let mut nodes: Vec<Node> = Vec::new();
    let mut open: Vec<usize> = Vec::new();
    let mut at = 0;
    for (n, line) in text.split_inclusive('\n').enumerate() {
        let start = at;
        at += line.len();
        let depth = line.len() - line.trim_start_matches('\t').len();
        let word = line.trim();
        if n < from || word.is_empty() {
            continue;
        }
        if word.starts_with(ends) {
            break;
        }
        if word.chars().any(|c| c.is_control() && c != '\t') {
            let message = "the line has a control character; remove it";
            return Err((syntax_problem(message), start));
        }
        if nodes.len() >= MAX_ELEMENTS {
            return Err((too_many("lines", MAX_ELEMENTS), start));
        }
        if depth > open.len() || (depth == 0 && !nodes.is_empty()) {
            let message =
                "the line is not one tab deeper than its parent; indent it as OndselSolver does";
            return Err((syntax_problem(message), start));
        }
        if depth >= MAX_DEPTH {
            return Err((too_deep(MAX_DEPTH), start));
        }
        open.truncate(depth);
        let begins = start + depth;
        let id = nodes.len();
        nodes.push(Node::line(word, source, begins..begins + word.len()));
        if let Some(&parent) = open.last() {
            nodes[parent].children.push(first + id);
        }
        open.push(id);
    }
    if nodes.is_empty() {
        return Err((syntax_problem("the file is empty"), 0));
    }
    said(&mut nodes, first);
    Ok(nodes)
}

/// Gives each label its text.
fn said(nodes: &mut [Node], first: usize) {
    for id in 0..nodes.len() {
        let leaves = nodes[id].children.iter().map(|c| c - first);
        let leaves = leaves.filter(|&c| nodes[c].children.is_empty());
        let lines: Vec<String> = leaves.map(|c| nodes[c].name.clone()).collect();
        lines.iter().for_each(|l| nodes[id].say(l));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_hold_the_lines_below_them() {
        let text = "head\r\nA\r\n\tB\r\n\t\t1\t2\t\r\n\t\t3\r\n\tC\r\n\tEnd\r\n";
        let mut document = Document::default();
        let root = document
            .read_outline("x", text.to_owned(), 1, "End")
            .unwrap_or_else(|e| panic!("{e}"));
        let a = document.element(root);
        assert_eq!(a.name(), "A");
        let names: Vec<&str> = a.children().map(|c| c.name()).collect();
        assert_eq!(names, ["B", "C"]);
        assert_eq!(a.child("B").map(|b| b.text()), Some("1\t2\n3"));
    }

    #[test]
    fn a_line_too_deep_is_named() {
        let mut document = Document::default();
        let found = document.read_outline("x", "A\n\t\tB\n".to_owned(), 0, "End");
        assert!(found.is_err_and(|e| e.to_string().contains("one tab deeper")));
    }
}
