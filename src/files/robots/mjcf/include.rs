//! Includes: the children of another file's root in place of an element.

use crate::robots::warning::{Read, Reader, unsupported_problem};
use crate::robots::xml::element::Element;
use crate::robots::xml::{self, Document};
use std::path::{Component, Path};

/// Maximum depth of nested files, and number of includes.
const LIMITS: (usize, usize) = (16, 1000);

/// Replaces all `<include>` elements below `root` by the included files; with `outside`, files outside its folder
/// may be read.
pub(super) fn expand_includes(
    document: &mut Document,
    root: usize,
    read: Reader<'_>,
    outside: bool,
) -> Read<()> {
    let mut count = 0;
    let names = vec![document.element(root).source().to_owned()];
    let files = Files { read, outside };
    expand_below(document, root, &names, &mut count, &files)
}

/// The files that may be included.
struct Files<'r> {
    read: Reader<'r>,
    /// Whether files outside the folder of the document may be read.
    outside: bool,
}

impl Files<'_> {
    /// Returns true if a path may be read: it leads down, or up if that is allowed.
    fn is_reachable(&self, file: &str) -> bool {
        let up = |c| matches!(c, Component::ParentDir);
        let plain = |c| matches!(c, Component::Normal(_) | Component::CurDir);
        let mut parts = Path::new(file).components();
        parts.all(|c| plain(c) || (self.outside && up(c)))
    }
}

fn expand_below(
    document: &mut Document,
    root: usize,
    open: &[String],
    count: &mut usize,
    files: &Files<'_>,
) -> Read<()> {
    let mut stack = vec![root];
    while let Some(id) = stack.pop() {
        let children = std::mem::take(&mut document.nodes[id].children);
        let mut all = Vec::with_capacity(children.len());
        for c in children {
            if document.element(c).name() != "include" {
                all.push(c);
                stack.push(c);
                continue;
            }
            *count += 1;
            let inner = read_included(document, c, open, *count, files)?;
            let mut names = open.to_vec();
            names.push(document.element(inner).source().to_owned());
            expand_below(document, inner, &names, count, files)?;
            all.append(&mut document.nodes[inner].children);
        }
        document.nodes[id].children = all;
    }
    Ok(())
}

/// Reads the file that an `<include>` names; gives its root.
fn read_included(
    document: &mut Document,
    id: usize,
    open: &[String],
    count: usize,
    files: &Files<'_>,
) -> Read<usize> {
    let e = document.element(id);
    let file = e.required_attribute("file")?.to_owned();
    let refuse = |e: Element<'_>, why: &str, remedy: &str| {
        let element = format!("<include file=\"{file}\">");
        e.error_at(Some("file"), unsupported_problem(&element, why, remedy))
    };
    if open.contains(&file) || open.first().is_some_and(|main| ends_with(main, &file)) {
        let remedy = "remove one of the includes";
        return Err(refuse(e, "the file includes itself", remedy));
    }
    if open.len() > LIMITS.0 || count > LIMITS.1 {
        let why = format!("more than {} files deep or {} in all", LIMITS.0, LIMITS.1);
        return Err(refuse(e, &why, "merge the files"));
    }
    if !files.is_reachable(&file) {
        let why = "it is outside the folder of the file";
        let remedy = "copy it there, or give a folder that contains both as `models`";
        return Err(refuse(e, why, remedy));
    }
    let bytes = (files.read)(&file).map_err(|error| {
        let why = format!("it cannot be read ({error})");
        refuse(e, &why, "put it in the folder of the file")
    })?;
    document.read(&file, xml::decode_utf8(&file, &bytes)?)
}

/// Returns true if the last part of a path is this file.
fn ends_with(path: &str, file: &str) -> bool {
    let last = |p: &str| Path::new(p).file_name().map(ToOwned::to_owned);
    last(path).is_some() && last(path) == last(file) && Path::new(file).components().count() == 1
}
