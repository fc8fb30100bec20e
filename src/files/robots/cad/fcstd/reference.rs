//! The reference of a joint: the part that moves, the frame's place in it, and the element of its shape.

use crate::robots::cad::fcstd::objects::{Object, Objects};
use crate::robots::prelude::*;

/// The documents read and the assembly of the main one.
pub(crate) struct Documents<'a> {
    /// The documents by the names of their files; that of the main one is empty, the others are those that it links to.
    pub(crate) all: BTreeMap<String, Objects<'a>>,
    pub(crate) assembly: Object<'a>,
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

/// Why there is no reference.
pub(crate) enum NoReference {
    /// It is broken, in words that follow its name; the rest of the file can be used.
    Broken(String),
    /// A number of a placement is invalid.
    Invalid(ImportError),
}

impl From<ImportError> for NoReference {
    fn from(e: ImportError) -> NoReference {
        NoReference::Invalid(e)
    }
}

fn broken<T>(what: impl Into<String>) -> Result<T, NoReference> {
    Err(NoReference::Broken(what.into()))
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

impl<'a> Documents<'a> {
    /// Returns the objects of the document with the assembly.
    pub(crate) fn main(&self) -> &Objects<'a> {
        &self.all[""]
    }

    fn object(&self, file: &str, name: &str) -> Option<Object<'a>> {
        self.all.get(file)?.get(name).copied()
    }

    /// Returns the reference of a joint, `Reference1` or `Reference2`.
    ///
    /// # Errors
    /// Returns an error if it is broken, or if a number of a placement is invalid.
    pub(crate) fn read_reference(
        &self,
        joint: &Object<'a>,
        which: &str,
    ) -> Result<Reference<'a>, NoReference> {
        let property = joint.find_property(which);
        let link = property.and_then(|p| p.first_child("XLink"));
        let named = link.and_then(|l| Some((l, l.attribute("name").filter(|n| !n.is_empty())?)));
        let Some((link, root)) = named else {
            return broken("is empty");
        };
        if link.attribute("file").is_some_and(|f| !f.is_empty()) {
            return broken("is an object of another document");
        }
        if self.main().get(root).is_none() {
            return broken(format!("is broken: there is no object {root}"));
        }
        match self.element_path(link, root).split_last() {
            Some((element, names)) => self.follow_names(names, element),
            None => broken("names no element"),
        }
    }

    /// Returns the names from below the assembly to the element, which is the last and may be empty.
    fn element_path(&self, link: Element<'a>, root: &'a str) -> Vec<&'a str> {
        let sub = link.children_named("Sub").next();
        let sub = sub.and_then(|s| s.attribute("value"));
        let mut names: Vec<&str> = sub.unwrap_or("").split('.').collect();
        let assembly = self.assembly.name;
        // FreeCAD 1.0 begins at the assembly or above, 1.1 at the part or within a group.
        if let Some(at) = names.iter().position(|n| *n == assembly) {
            return names.split_off(at + 1);
        }
        if root == assembly {
            return names;
        }
        let mut above = vec![root];
        while let Some(o) = self.main().group_of(above[0]) {
            if o.name == assembly || above.contains(&o.name) {
                break;
            }
            above.insert(0, o.name);
        }
        above.append(&mut names);
        above
    }

    fn find_part<'n>(&self, names: &'n [&'a str]) -> Result<PartFound<'a, 'n>, NoReference> {
        let mut above = RigidMotion::IDENTITY;
        let mut array = false;
        let mut rest = names;
        while let Some((&name, inner)) = rest.split_first() {
            rest = inner;
            let Some(part) = self.object("", name) else {
                return broken(if array {
                    format!("is element {name} of an array, whose position is not read")
                } else {
                    format!("is broken: there is no object {name}")
                });
            };
            let within = part.is_array() || (part.is_group() && !rest.is_empty());
            if !within {
                return Ok(PartFound { part, above, rest });
            }
            array = part.is_array();
            above = above.then(&placement_of(&part)?);
        }
        broken(format!("names no part of {}", self.assembly.label()))
    }

    fn follow_names(
        &self,
        names: &[&'a str],
        element: &'a str,
    ) -> Result<Reference<'a>, NoReference> {
        let PartFound { part, above, rest } = self.find_part(names)?;
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
            at = self.resolve_link(at, &mut out)?;
            let found = self.object(at.file, name);
            if is_body(&at.object) || name.is_empty() {
                // Features of a body; the last existing one has the shape.
                let own = found.filter(|_| at.file.is_empty());
                out.shape = own.and_then(|o| o.shape_member()).or(out.shape);
                continue;
            }
            let Some(o) = found else {
                out.doubt = Some(uncertain_frame(name, at.file));
                out.shape = None;
                break;
            };
            out.inner = out.inner.then(&placement_of(&o)?);
            out.shape = o.shape_member().filter(|_| at.file.is_empty());
            out.object = o.kind;
            at.object = o;
        }
        if !self.resolve_link(at, &mut out)?.file.is_empty() {
            out.shape = None;
        }
        Ok(out)
    }

    /// Returns the object that a link refers to, in its file; a link that moves its object adds to the placement.
    fn resolve_link(
        &self,
        mut at: ObjectInFile<'a>,
        out: &mut Reference<'a>,
    ) -> Read<ObjectInFile<'a>> {
        // A chain of links is short; the limit ends a ring of them.
        for _ in 0..16 {
            let Some((in_file, name)) = at.object.linked_object() else {
                break;
            };
            let file = if in_file.is_empty() { at.file } else { in_file };
            let turns = at.object.is_true("LinkTransform") == Some(true);
            let Some(object) = self.object(file, name) else {
                if out.doubt.is_none() && !in_file.is_empty() {
                    at.file = file;
                }
                break;
            };
            if turns {
                out.inner = out.inner.then(&placement_of(&object)?);
            }
            out.shape = object.shape_member();
            at = ObjectInFile { object, file };
        }
        Ok(at)
    }
}
