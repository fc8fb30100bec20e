//! The reference of a joint: the part that moves, the frame's place in it, and the element of its shape.

use crate::robots::fcstd::objects::{Object, Objects};
use crate::robots::prelude::*;

/// The documents read: the first is the one with the assembly, the others those that it links to, by the name of their file.
pub(crate) struct Documents<'a> {
    pub(crate) main: Objects<'a>,
    pub(crate) linked: BTreeMap<String, Objects<'a>>,
}

impl<'a> Documents<'a> {
    fn document_of(&self, file: &str) -> Option<&Objects<'a>> {
        match file {
            "" => Some(&self.main),
            file => self.linked.get(file),
        }
    }
}

/// The reference of a joint to a part.
#[derive(Debug, Clone)]
pub(crate) struct Reference<'a> {
    /// The name of the part below the assembly. `None` if it is the ground.
    pub(crate) part: Option<&'a str>,
    /// The place of the part in the assembly.
    pub(crate) place: RigidMotion,
    /// The place in the part of the object that the frame is given in.
    pub(crate) inner: RigidMotion,
    /// Why the reference is uncertain.
    pub(crate) doubt: Option<String>,
    /// Member of the archive with the shape of the element.
    pub(crate) shape: Option<&'a str>,
    /// The kind of object, if it is not a shape.
    pub(crate) object: &'a str,
    /// The element: `Face3`, `Edge1`, `Vertex7`, or nothing.
    pub(crate) element: &'a str,
}

/// Why a reference is broken, in words.
pub(crate) type Broken = String;

/// Returns the reference of a joint, `Reference1` or `Reference2`.
///
/// # Errors
/// Returns an error if a number of a placement is invalid. A broken reference is not an error of the file.
pub(crate) fn read_reference<'a>(
    joint: &Object<'a>,
    which: &str,
    assembly: &Object<'a>,
    documents: &Documents<'a>,
) -> Read<Result<Reference<'a>, Broken>> {
    let Some(link) = joint
        .find_property(which)
        .and_then(|p| p.first_child("XLink"))
    else {
        return Ok(Err(format!("{which} is empty")));
    };
    let root = link.attribute("name").unwrap_or("");
    if root.is_empty() {
        return Ok(Err(format!("{which} is empty")));
    }
    if link.attribute("file").is_some_and(|f| !f.is_empty()) {
        return Ok(Err(format!("{which} is an object of another document")));
    }
    if documents.main.get(root).is_none() {
        let what = format!("{which} is broken: there is no object {root}");
        return Ok(Err(what));
    }
    let path = element_path(link, root, assembly, &documents.main);
    let Some((element, names)) = path.split_last() else {
        return Ok(Err(format!("{which} names no element")));
    };
    follow_names(names, element, which, assembly, documents)
}

/// Returns the names from below the assembly to the element, which is the last and may be empty.
fn element_path<'a>(
    link: Element<'a>,
    root: &'a str,
    assembly: &Object<'a>,
    objects: &Objects<'a>,
) -> Vec<&'a str> {
    let sub = link.children_named("Sub").next();
    let sub = sub.and_then(|s| s.attribute("value"));
    let mut names: Vec<&str> = sub.unwrap_or("").split('.').collect();
    // FreeCAD 1.0 begins at the assembly or above, 1.1 at the part or within a group.
    if let Some(at) = names.iter().position(|n| *n == assembly.name) {
        return names.split_off(at + 1);
    }
    if root != assembly.name {
        let mut above = vec![root];
        while let Some(o) = objects
            .group_of(above[0])
            .filter(|o| o.name != assembly.name)
        {
            if above.contains(&o.name) {
                break;
            }
            above.insert(0, o.name);
        }
        above.append(&mut names);
        return above;
    }
    names
}

/// Returns true if objects below it are features of one shape, without their own placement.
fn is_body(o: &Object<'_>) -> bool {
    o.kind.starts_with("PartDesign::")
        || (o.kind.starts_with("Part::") && !o.kind.starts_with("Part::Part"))
}

/// The part that names lead to, through groups and arrays.
struct PartFound<'a, 'n> {
    part: Object<'a>,
    /// The place of what it is in.
    above: RigidMotion,
    /// The names within it.
    rest: &'n [&'a str],
}

fn find_part<'a, 'n>(
    names: &'n [&'a str],
    which: &str,
    assembly: &Object<'a>,
    main: &Objects<'a>,
) -> Read<Result<PartFound<'a, 'n>, Broken>> {
    let mut above = RigidMotion::IDENTITY;
    let mut array = false;
    let mut rest = names;
    while let Some((&name, inner)) = rest.split_first() {
        rest = inner;
        let Some(&part) = main.get(name) else {
            let what = if array {
                format!("{which} is element {name} of an array, whose position is not read")
            } else {
                format!("{which} is broken: there is no object {name}")
            };
            return Ok(Err(what));
        };
        let within = part.is_array() || (part.is_group() && !rest.is_empty());
        if !within {
            return Ok(Ok(PartFound { part, above, rest }));
        }
        array = part.is_array();
        above = above.then(&placement_of(&part)?);
    }
    Ok(Err(format!(
        "{which} names no part of {}",
        assembly.label()
    )))
}

/// Returns the placement of an object relative to its parent.
fn placement_of(o: &Object<'_>) -> Read<RigidMotion> {
    Ok(o.read_placement("Placement")?
        .unwrap_or(RigidMotion::IDENTITY))
}

/// Returns true if a datum is attached to something.
fn is_attached(o: &Object<'_>) -> bool {
    ["AttachmentSupport", "Support"].iter().any(|p| {
        o.find_property(p)
            .is_some_and(|p| p.children().any(|c| c.children().next().is_some()))
    })
}

fn follow_names<'a>(
    names: &[&'a str],
    element: &'a str,
    which: &str,
    assembly: &Object<'a>,
    documents: &Documents<'a>,
) -> Read<Result<Reference<'a>, Broken>> {
    let PartFound { part, above, rest } = match find_part(names, which, assembly, &documents.main)?
    {
        Ok(found) => found,
        Err(broken) => return Ok(Err(broken)),
    };
    let mut out = Reference {
        part: Some(part.name),
        place: above.then(&placement_of(&part)?),
        inner: RigidMotion::IDENTITY,
        doubt: None,
        shape: part.shape_member(),
        object: part.kind,
        element,
    };
    if part.is_datum() {
        // A datum that is attached to nothing is fixed.
        out.part = None;
        if is_attached(&part) {
            out.doubt = Some("it is an attached datum, treated as fixed in place".to_owned());
        }
    }
    let mut at = ObjectInFile {
        object: part,
        file: "",
    };
    for &name in rest {
        at = resolve_link(at, documents, &mut out)?;
        let found = documents.document_of(at.file).and_then(|o| o.get(name));
        if is_body(&at.object) || name.is_empty() {
            // Features of a body; the last existing one has the shape.
            let own = found.filter(|_| at.file.is_empty());
            out.shape = own.and_then(Object::shape_member).or(out.shape);
            continue;
        }
        let Some(o) = found else {
            out.doubt = Some(uncertain_frame(name, at.file));
            out.shape = None;
            break;
        };
        out.inner = out.inner.then(&placement_of(o)?);
        out.shape = o.shape_member().filter(|_| at.file.is_empty());
        out.object = o.kind;
        at.object = *o;
    }
    if !resolve_link(at, documents, &mut out)?.file.is_empty() {
        out.shape = None;
    }
    Ok(Ok(out))
}

fn uncertain_frame(name: &str, file: &str) -> String {
    let file = match file {
        "" => "which is not in the document".to_owned(),
        file => format!("which is an object of {file}, which is not read"),
    };
    format!(
        "its frame is uncertain: it is given in {name}, {file}, and is placed as if that part stood in its original position"
    )
}

/// An object and the document it is of.
#[derive(Clone, Copy)]
struct ObjectInFile<'a> {
    object: Object<'a>,
    /// The file; empty if it is the one with the assembly.
    file: &'a str,
}

/// Returns the object that a link refers to, in its file; a link that moves its object adds to the placement.
fn resolve_link<'a>(
    mut at: ObjectInFile<'a>,
    documents: &Documents<'a>,
    out: &mut Reference<'a>,
) -> Read<ObjectInFile<'a>> {
    // A chain of links is short; the limit ends a ring of them.
    for _ in 0..16 {
        let Some((in_file, name)) = at.object.linked_object() else {
            break;
        };
        let to = if in_file.is_empty() { at.file } else { in_file };
        let turns = at.object.is_true("LinkTransform") == Some(true);
        let Some(&target) = documents.document_of(to).and_then(|d| d.get(name)) else {
            if out.doubt.is_none() && !in_file.is_empty() {
                at.file = to;
            }
            break;
        };
        if turns {
            out.inner = out.inner.then(&placement_of(&target)?);
        }
        out.shape = target.shape_member();
        at = ObjectInFile {
            object: target,
            file: to,
        };
    }
    Ok(at)
}
