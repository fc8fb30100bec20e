//! `<include>`: the content of another MJCF file, or the model of another SDF file, in place of the element.

use crate::robots::prelude::*;

/// Maximum depth of nested files, and number of includes.
const LIMITS: (usize, usize) = (16, 1000);

fn include_error(e: Element<'_>, file: &str, why: &str, remedy: &str) -> ImportError {
    let element = format!("<include> of {file}");
    e.error_at(Some("file"), unsupported_problem(&element, why, remedy))
}

/// Checks that no file includes itself, and that files are not too deep or too many.
fn check_include(e: Element<'_>, file: &str, open: &[String], count: usize) -> Read<()> {
    if open.iter().any(|o| o == file) {
        let remedy = "remove one of the includes";
        return Err(include_error(e, file, "the file includes itself", remedy));
    }
    if open.len() > LIMITS.0 || count > LIMITS.1 {
        let why = format!("more than {} files deep or {} in all", LIMITS.0, LIMITS.1);
        return Err(include_error(e, file, &why, "merge the files"));
    }
    Ok(())
}

/// Replaces all `<include>` elements of MJCF below the root by the content of the included files.
pub(super) fn expand_files(input: &mut Input<'_>) -> Read<()> {
    let open = [input.document.sources[0].name.clone()];
    expand_below(input.document, input.read, input.root, &open, &mut 0)
}

/// Replaces the includes below a root; `open` are the names of the files that include it.
fn expand_below(
    document: &mut Document,
    read: Reader<'_>,
    root: usize,
    open: &[String],
    count: &mut usize,
) -> Read<()> {
    let mut stack = vec![root];
    while let Some(id) = stack.pop() {
        let children = std::mem::take(&mut document.nodes[id].children);
        let mut all = Vec::with_capacity(children.len());
        for c in children {
            let e = document.element(c);
            if e.name() != "include" {
                all.push(c);
                stack.push(c);
                continue;
            }
            *count += 1;
            let file = e.required_attribute("file")?.to_owned();
            check_include(e, &file, open, *count)?;
            let bytes = read(&file).map_err(|error| {
                let why = format!("it cannot be read ({error})");
                let remedy = "put it in the folder of the file, or give a folder that contains both as `models`";
                include_error(e, &file, &why, remedy)
            })?;
            let inner = document.read(&file, decode_utf8(&file, &bytes)?)?;
            let names = [open, &[file]].concat();
            expand_below(document, read, inner, &names, count)?;
            all.append(&mut document.nodes[inner].children);
        }
        document.nodes[id].children = all;
    }
    Ok(())
}

/// Included files that are not mechanisms, and that few users have: Gazebo's own light and floor.
const SCENERY: [&str; 2] = ["model://sun", "model://ground_plane"];

/// The result of expanding the includes.
pub(super) struct Expanded<'r> {
    read: Reader<'r>,
    /// The number of includes.
    count: usize,
    /// For each file, true if it is older than SDF 1.5.
    pub(super) old: Vec<bool>,
}

/// Puts models in place of all `<include>` elements of SDF below the root.
pub(super) fn expand_models<'r>(input: &mut Input<'r>) -> Read<Expanded<'r>> {
    let document = &mut *input.document;
    let mut out = Expanded {
        read: input.read,
        count: 0,
        old: vec![is_old(document.element(input.root))],
    };
    // With the names of the files that are open.
    let main = document.sources[0].name.clone();
    let mut stack = vec![(input.root, vec![main])];
    while let Some((id, open)) = stack.pop() {
        let children = document.nodes[id].children.clone();
        let mut all = Vec::with_capacity(children.len());
        for c in children {
            let e = document.element(c);
            if e.name() != "include" || !["world", "model"].contains(&document.element(id).name()) {
                all.push(c);
                stack.push((c, open.clone()));
                continue;
            }
            out.count += 1;
            let (model, uri) = out.read_model(document, c, &open)?;
            let Some(model) = model else { continue };
            let mut names = open.clone();
            names.push(uri);
            all.push(model);
            stack.push((model, names));
        }
        document.nodes[id].children = all;
    }
    Ok(out)
}

/// Returns true if the version is before 1.5; 1.11 comes after 1.9.
pub(crate) fn is_old(root: Element<'_>) -> bool {
    let version = root.attribute("version").and_then(|v| {
        let (major, minor) = v.trim().split_once('.').unwrap_or((v, "0"));
        Some((major.parse::<u32>().ok()?, minor.parse::<u32>().ok()?))
    });
    version.is_some_and(|v| v < (1, 5))
}

/// A model, and the name of its include.
type Found = (Option<usize>, String);

impl Expanded<'_> {
    /// Returns the model that an include names, with the settings of the include, and the name. `None` for a light or the floor.
    fn read_model(&mut self, document: &mut Document, id: usize, open: &[String]) -> Read<Found> {
        let e = document.element(id);
        let uri = e.first_child("uri").map(|u| u.text().to_owned());
        let Some(uri) = uri.filter(|u| !u.is_empty()) else {
            return Err(e.missing_error("<uri>"));
        };
        check_include(e, &uri, open, self.count)?;
        if e.attribute("merge").is_some_and(|m| m == "true")
            || e.first_child("placement_frame").is_some()
        {
            let why = "it merges models or places them by a frame";
            let remedy = "expand the file first, for example with `gz sdf -p`";
            return Err(include_error(e, &uri, why, remedy));
        }
        let bytes = match (self.read)(&uri) {
            Ok(bytes) => bytes,
            Err(_) if SCENERY.contains(&uri.trim_end_matches('/')) => return Ok((None, uri)),
            Err(error) => {
                let why = format!("it cannot be read ({error})");
                let remedy = "give the folder of its model as `models`";
                return Err(include_error(e, &uri, &why, remedy));
            }
        };
        let inner = document.read(&uri, decode_utf8(&uri, &bytes)?)?;
        let found = document.element(inner);
        self.old.push(is_old(found));
        let models: Vec<usize> = found.children_named("model").map(|m| m.id).collect();
        if models.is_empty() && found.first_child("light").is_some() {
            return Ok((None, uri));
        }
        let [model] = models[..] else {
            let (e, remedy) = (document.element(id), "name a file with one model");
            let why = "the file does not have exactly one <model>";
            return Err(include_error(e, &uri, why, remedy));
        };
        said_by_include(document, id, model);
        Ok((Some(model), uri))
    }
}

/// Gives a model the pose, the name and the fixation of its include, and adds the plugins of the include.
fn said_by_include(document: &mut Document, include: usize, model: usize) {
    let e = document.element(include);
    let own = |tag: &str| e.first_child(tag).map(|c| c.id);
    let placed = [("pose", own("pose")), ("static", own("static"))];
    let name = e.first_child("name").map(|n| n.text().to_owned());
    let plugins: Vec<usize> = e.children_named("plugin").map(|p| p.id).collect();
    document.nodes[model].children.extend(plugins);
    for (tag, new) in placed {
        let Some(new) = new else { continue };
        let mut children = document.nodes[model].children.clone();
        children.retain(|&c| document.nodes[c].name != tag);
        children.push(new);
        document.nodes[model].children = children;
    }
    if let Some(name) = name.filter(|n| !n.is_empty()) {
        document.nodes[model].rename(name);
    }
}
