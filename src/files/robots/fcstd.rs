//! FreeCAD documents with assemblies: `.FCStd`.

mod brep;
mod distance;
mod joint;
mod objects;
pub(crate) mod read;
mod reference;

/// The member of the archive that says what objects there are.
pub(crate) const DOCUMENT: &str = "Document.xml";
