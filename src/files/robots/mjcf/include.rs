//! Includes: the children of another file's root in place of an element.

use crate::robots::warning::{Read, Reader, unsupported_problem};
use crate::robots::xml::{self, Document, Input};
use std::path::{Component, Path};

/// Maximum depth of nested files, and number of includes.
const LIMITS: (usize, usize) = (16, 1000);

/// Replaces all `<include>` elements below the root by the included files. Files outside its folder are read if folders are given.
pub(super) fn expand_includes(input: &mut Input<'_>) -> Read<()> {
    let (document, root) = (&mut *input.document, input.root);
    let names = vec![document.element(root).source().to_owned()];
    let mut files = Files {
        read: input.read,
        outside: !input.options.models.is_empty(),
        count: 0,
    };
    files.expand_below(document, root, &names)
}

/// The files that may be included.
struct Files<'r> {
    read: Reader<'r>,
    /// Whether files outside the folder of the document may be read.
    outside: bool,
    /// The number of includes so far.
    count: usize,
}

impl Files<'_> {
    /// Returns true if a path may be read: it leads down, or up if that is allowed.
    fn is_reachable(&self, file: &str) -> bool {
        let up = |c| matches!(c, Component::ParentDir);
        let plain = |c| matches!(c, Component::Normal(_) | Component::CurDir);
        let mut parts = Path::new(file).components();
        parts.all(|c| plain(c) || (self.outside && up(c)))
    }

    fn expand_below(&mut self, document: &mut Document, root: usize, open: &[String]) -> Read<()> {
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
                self.count += 1;
                let inner = self.read_included(document, c, open)?;
                let mut names = open.to_vec();
                names.push(document.element(inner).source().to_owned());
                self.expand_below(document, inner, &names)?;
                all.append(&mut document.nodes[inner].children);
            }
            document.nodes[id].children = all;
        }
        Ok(())
    }

    /// Reads the file that an `<include>` names; gives its root.
    fn read_included(&self, document: &mut Document, id: usize, open: &[String]) -> Read<usize> {
        let e = document.element(id);
        let file = e.required_attribute("file")?.to_owned();
        let refuse = |why: &str, remedy: &str| {
            let element = format!("<include file=\"{file}\">");
            e.error_at(Some("file"), unsupported_problem(&element, why, remedy))
        };
        if open.contains(&file) || open.first().is_some_and(|main| ends_with(main, &file)) {
            let remedy = "remove one of the includes";
            return Err(refuse("the file includes itself", remedy));
        }
        if open.len() > LIMITS.0 || self.count > LIMITS.1 {
            let why = format!("more than {} files deep or {} in all", LIMITS.0, LIMITS.1);
            return Err(refuse(&why, "merge the files"));
        }
        if !self.is_reachable(&file) {
            let why = "it is outside the folder of the file";
            let remedy = "copy it there, or give a folder that contains both as `models`";
            return Err(refuse(why, remedy));
        }
        let bytes = (self.read)(&file).map_err(|error| {
            let why = format!("it cannot be read ({error})");
            refuse(&why, "put it in the folder of the file")
        })?;
        document.read(&file, xml::decode_utf8(&file, &bytes)?)
    }
}

/// Returns true if the last part of a path is this file.
fn ends_with(path: &str, file: &str) -> bool {
    let last = |p: &str| Path::new(p).file_name().map(ToOwned::to_owned);
    last(path).is_some() && last(path) == last(file) && Path::new(file).components().count() == 1
}
