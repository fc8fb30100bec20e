//! What is asked of an import.

/// What to do with a description.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// Name and bytes of a file of loop closures.
    pub loops: Option<(String, Vec<u8>)>,
    /// Values of joints, in radians and metres, one for each freedom.
    pub pose: Vec<(String, Vec<f64>)>,
    /// Hang a robot without a fixed link on the world by a joint of six freedoms.
    pub floating: bool,
    /// SDF drawn in parts: every joint puts the frame that is its parent onto its child. CAD assemblies: each part keeps its own
    /// frame of a joint, and joints that are open are closed.
    pub assemble: bool,
    /// Take loops that do not close as they are.
    pub open: bool,
    /// Folders that `model://` stands for, searched in order; files that are included with `../` may be within them, too.
    pub models: Vec<std::path::PathBuf>,
    /// The assembly of a CAD document that is read, in place of the one with most joints.
    pub assembly: Option<String>,
    /// The link to be the frame, in place of the root.
    pub frame: Option<String>,
    /// The links to be outputs, in place of the end links.
    pub outputs: Vec<String>,
}

/// Reads the bytes of a file that an included file's name stands for.
pub type Reader<'a> = &'a dyn Fn(&str) -> std::io::Result<Vec<u8>>;
