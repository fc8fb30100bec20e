//! Formats that are not read: a file in one is refused by name, with what to do instead.

use crate::file::problem::ImportError;
use crate::robots::problem::syntax_problem;

/// A format that is not read: its name, the extensions of its files in lower case, the first bytes of its files, and what to do
/// instead. The first bytes are empty if they do not identify the format.
type Foreign = (&'static str, &'static str, &'static [u8], &'static str);

const GEOMETRY: &str = "it has shapes and no joints; join the parts in FreeCAD's Assembly workbench and give the .FCStd, or write a mechanism file (`ozols new`)";
const CAD: &str = "export a URDF with the program's exporter, or join the parts in FreeCAD's Assembly workbench and give the .FCStd";
const SIMULATOR: &str = "export the model as URDF, SDF or MJCF from the program that wrote it";
const TEMPLATE: &str = "expand it first, and give the resulting URDF, SDF or MJCF file";

static FOREIGN: [Foreign; 38] = [
    (
        "YAML",
        "yaml yml",
        b"",
        "give the robot description, and this file as its loop closures",
    ),
    (
        "compressed",
        "zip gz 7z",
        b"",
        "unpack it and give the description inside",
    ),
    ("STEP", "step stp stpz p21", b"ISO-10303-21", GEOMETRY),
    ("IGES", "iges igs", b"", GEOMETRY),
    (
        "Parasolid",
        "x_t x_b xmt_txt xmt_bin",
        b"**ABCDEFGHIJKLMNOPQRSTUVWXYZ",
        GEOMETRY,
    ),
    ("ACIS", "sat sab", b"ACIS BinaryFile", GEOMETRY),
    ("BREP", "brep brp", b"DBRep_DrawableShape", GEOMETRY),
    ("STL", "stl", b"", GEOMETRY),
    ("Wavefront OBJ", "obj", b"", GEOMETRY),
    ("COLLADA", "dae", b"", GEOMETRY),
    ("glTF", "gltf glb", b"glTF", GEOMETRY),
    ("3MF", "3mf", b"", GEOMETRY),
    ("PLY", "ply", b"ply\n", GEOMETRY),
    ("VRML", "wrl vrml", b"#VRML", GEOMETRY),
    ("DXF", "dxf", b"", GEOMETRY),
    ("DWG", "dwg", b"AC10", GEOMETRY),
    ("JT", "jt", b"", GEOMETRY),
    ("Rhino 3DM", "3dm", b"3D Geometry File Format", GEOMETRY),
    ("SketchUp", "skp", b"", GEOMETRY),
    ("3DXML", "3dxml", b"", GEOMETRY),
    ("SolidWorks", "sldasm sldprt slddrw asmdot", b"", CAD),
    ("CATIA", "catproduct catpart cgr", b"V5_CFV2", CAD),
    ("Inventor", "iam ipt", b"", CAD),
    ("Creo or NX", "prt asm neu", b"", CAD),
    ("Solid Edge", "par psm", b"", CAD),
    ("Fusion", "f3d f3z", b"", CAD),
    ("KOMPAS-3D", "a3d m3d", b"", CAD),
    (
        "OLE document (SolidWorks, Inventor and others)",
        "",
        b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1",
        CAD,
    ),
    ("USD", "usd usda usdc usdz", b"#usda", SIMULATOR),
    ("USD", "", b"PXR-USDC", SIMULATOR),
    ("Blender", "blend", b"BLENDER", SIMULATOR),
    ("Webots", "wbt proto", b"", SIMULATOR),
    ("CoppeliaSim", "ttt ttm", b"", SIMULATOR),
    ("OpenSim", "osim", b"", SIMULATOR),
    ("Simulink", "slx mdl", b"", SIMULATOR),
    ("Adams", "adm cmd", b"", SIMULATOR),
    (
        "compiled MuJoCo",
        "mjb",
        b"",
        "save the model from MuJoCo as XML and give that",
    ),
    (
        "template (ERB, Jinja, EmPy)",
        "erb jinja jinja2 j2 em",
        b"",
        TEMPLATE,
    ),
];

/// Refuses a file of a format that is not read, by its first bytes or by its ending, which no mechanism file has.
///
/// # Errors
/// Returns the name of the format and the remedy.
pub fn refuse(name: &str, bytes: &[u8]) -> Result<(), ImportError> {
    let path = std::path::Path::new(name);
    let ending = path
        .extension()
        .unwrap_or_default()
        .to_string_lossy()
        .to_lowercase();
    let begins = |f: &&Foreign| !f.2.is_empty() && bytes.starts_with(f.2);
    let by_bytes = FOREIGN.iter().find(begins);
    let ends = |f: &&Foreign| f.1.split(' ').any(|e| !e.is_empty() && e == ending);
    let by_ending = || FOREIGN.iter().find(ends);
    // The first line of IGES ends in its section and number.
    let line = bytes.split(|b| *b == b'\n').next().unwrap_or_default();
    let is_iges = line.len() >= 80 && &line[72..80] == b"S      1";
    let iges = || FOREIGN.iter().find(|f| is_iges && f.0 == "IGES");
    match by_bytes.or_else(by_ending).or_else(iges) {
        None => Ok(()),
        Some((format, .., remedy)) => {
            let message = format!("this is a {format} file, which is not read; {remedy}");
            Err(syntax_problem(message).in_file(name, "", None))
        }
    }
}
