//! Zip archives, bounded: members read one by one, and an archive written again with one member changed.

use crate::file::problem::{ImportError, ProblemKind};
use crate::robots::warning::{Read, syntax_problem, too_deep, too_large, too_many};
use crate::robots::xml::{Document, MAX_BYTES, MAX_DEPTH, MAX_ELEMENTS, Node, Source};
use std::io::{Cursor, Read as _, Write};
use zip::result::ZipError;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

/// The first bytes of an archive.
const MAGIC: &[u8] = b"PK\x03\x04";
const REMEDY: &str = "save the document again with FreeCAD";

/// An archive in memory.
#[derive(Debug, Clone)]
pub(crate) struct Archive {
    name: String,
    bytes: Vec<u8>,
}

impl Archive {
    /// Returns the archive in the bytes, if they are one.
    pub(crate) fn find_archive(name: &str, bytes: &[u8]) -> Option<Archive> {
        let archive = || Archive {
            name: name.to_owned(),
            bytes: bytes.to_vec(),
        };
        bytes.starts_with(MAGIC).then(archive)
    }

    fn archive_error(&self, why: &ZipError) -> ImportError {
        let message = format!("the zip archive cannot be read ({why}); {REMEDY}");
        syntax_problem(message).in_file(&self.name, "", None)
    }

    /// Returns the bytes of a member, or `None` if it does not exist.
    ///
    /// # Errors
    /// Returns an error if the archive is broken, or if the member is larger than a description may be.
    pub(crate) fn read_member(&self, member: &str) -> Result<Option<Vec<u8>>, ImportError> {
        let archive = ZipArchive::new(Cursor::new(&self.bytes[..]));
        let mut archive = archive.map_err(|e| self.archive_error(&e))?;
        let found = match archive.by_name(member) {
            Ok(found) => found,
            Err(ZipError::FileNotFound) => return Ok(None),
            Err(e) => return Err(self.archive_error(&e)),
        };
        let mut out = Vec::new();
        // The size in a header may be wrong.
        let limit = MAX_BYTES as u64 + 1;
        let read = found.take(limit).read_to_end(&mut out);
        read.map_err(|e| self.archive_error(&ZipError::Io(e)))?;
        if out.len() > MAX_BYTES {
            let name = format!("{}:{member}", self.name);
            return Err(too_large(out.len(), MAX_BYTES).in_file(&name, "", None));
        }
        Ok(Some(out))
    }

    /// Returns the archive with a new content of one member; all others stay byte for byte, with the same compression.
    ///
    /// # Errors
    /// Returns an error if the archive is broken.
    pub(crate) fn with_member(&self, member: &str, content: &[u8]) -> Result<Vec<u8>, ImportError> {
        let done = self.replace_member(member, content);
        done.map_err(|e| self.archive_error(&e))
    }

    fn replace_member(&self, member: &str, content: &[u8]) -> Result<Vec<u8>, ZipError> {
        let mut archive = ZipArchive::new(Cursor::new(&self.bytes[..]))?;
        let mut out = ZipWriter::new(Cursor::new(Vec::new()));
        out.set_raw_comment(archive.comment().into())?;
        for at in 0..archive.len() {
            let old = archive.by_index_raw(at)?;
            if old.name()? != member {
                out.raw_copy_file(old)?;
                continue;
            }
            let mut options =
                SimpleFileOptions::default().compression_method(CompressionMethod::Deflated);
            if let Some(time) = old.last_modified() {
                options = options.last_modified_time(time);
            }
            out.start_file(member, options)?;
            out.write_all(content)?;
        }
        Ok(out.finish()?.into_inner())
    }
}

impl Document {
    /// Reads a file laid out by tabs into the arena from its second line on; gives its first label. Lines from one that `ends` on
    /// are not read.
    pub(crate) fn read_outline(&mut self, name: &str, text: String, ends: &str) -> Read<usize> {
        let source = self.sources.len();
        let root = self.nodes.len();
        let nodes = read_lines(&text, source, root, ends)
            .map_err(|(problem, at)| problem.in_file(name, &text, Some(at..at)))?;
        self.nodes.extend(nodes);
        let name = name.to_owned();
        self.sources.push(Source { name, text });
        Ok(root)
    }
}

type Located = (ProblemKind, usize);

/// Returns the lines as nodes, whose places in the arena begin at `first`.
fn read_lines(text: &str, source: usize, first: usize, ends: &str) -> Result<Vec<Node>, Located> {
    let mut nodes: Vec<Node> = Vec::new();
    let mut open: Vec<usize> = Vec::new();
    let mut at = 0;
    for (n, line) in text.split_inclusive('\n').enumerate() {
        let start = at;
        at += line.len();
        let depth = line.len() - line.trim_start_matches('\t').len();
        let word = line.trim();
        if n == 0 || word.is_empty() {
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
        nodes.push(Node::from_line(word, source, begins..begins + word.len()));
        if let Some(&parent) = open.last() {
            nodes[parent].children.push(first + id);
        }
        open.push(id);
    }
    if nodes.is_empty() {
        return Err((syntax_problem("the file is empty"), 0));
    }
    collect_texts(&mut nodes, first);
    Ok(nodes)
}

/// Gives each label its text.
fn collect_texts(nodes: &mut [Node], first: usize) {
    for id in 0..nodes.len() {
        let leaves = nodes[id].children.iter().map(|c| c - first);
        let leaves = leaves.filter(|&c| nodes[c].children.is_empty());
        let lines: Vec<String> = leaves.map(|c| nodes[c].name.clone()).collect();
        lines.iter().for_each(|l| nodes[id].append_line(l));
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
            .read_outline("x", text.to_owned(), "End")
            .unwrap_or_else(|e| panic!("{e}"));
        let a = document.element(root);
        assert_eq!(a.name(), "A");
        let names: Vec<&str> = a.children().map(|c| c.name()).collect();
        assert_eq!(names, ["B", "C"]);
        assert_eq!(a.first_child("B").map(|b| b.text()), Some("1\t2\n3"));
    }

    #[test]
    fn a_line_too_deep_is_named() {
        let mut document = Document::default();
        let found = document.read_outline("x", "head\nA\n\t\tB\n".to_owned(), "End");
        assert!(found.is_err_and(|e| e.to_string().contains("one tab deeper")));
    }
}
