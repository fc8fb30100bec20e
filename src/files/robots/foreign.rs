//! Formats that are not read: a file in one is refused by name, with what to do instead.

use crate::file::problem::ImportError;
use crate::robots::problem::whole;

/// A format that is not read.
struct Foreign {
    name: &'static str,
    /// Endings of its files, in small letters.
    endings: &'static [&'static str],
    /// What its files begin with; empty where that says nothing.
    begins: &'static [u8],
    remedy: &'static str,
}

const GEOMETRY: &str = "it has shapes and no joints; join the parts in FreeCAD's Assembly workbench and give the .FCStd, or write a mechanism file (`ozols new`)";
const CAD: &str = "export a URDF with the program's exporter, or join the parts in FreeCAD's Assembly workbench and give the .FCStd";
const SIMULATOR: &str = "export the model as URDF, SDF or MJCF from the program that wrote it";
const TEMPLATE: &str = "expand it first, and give the URDF, SDF or MJCF that comes out";

const fn of(
    name: &'static str,
    endings: &'static [&'static str],
    begins: &'static [u8],
    remedy: &'static str,
) -> Foreign {
    Foreign {
        name,
        endings,
        begins,
        remedy,
    }
}

static FOREIGN: [Foreign; 38] = [
    of(
        "YAML",
        &["yaml", "yml"],
        b"",
        "give the robot description, and this file with --loops",
    ),
    of(
        "compressed",
        &["zip", "gz", "7z"],
        b"",
        "unpack it and give the description that is in it",
    ),
    of(
        "STEP",
        &["step", "stp", "stpz", "p21"],
        b"ISO-10303-21",
        GEOMETRY,
    ),
    of("IGES", &["iges", "igs"], b"", GEOMETRY),
    of(
        "Parasolid",
        &["x_t", "x_b", "xmt_txt", "xmt_bin"],
        b"**ABCDEFGHIJKLMNOPQRSTUVWXYZ",
        GEOMETRY,
    ),
    of("ACIS", &["sat", "sab"], b"ACIS BinaryFile", GEOMETRY),
    of("BREP", &["brep", "brp"], b"DBRep_DrawableShape", GEOMETRY),
    of("STL", &["stl"], b"", GEOMETRY),
    of("Wavefront OBJ", &["obj"], b"", GEOMETRY),
    of("COLLADA", &["dae"], b"", GEOMETRY),
    of("glTF", &["gltf", "glb"], b"glTF", GEOMETRY),
    of("3MF", &["3mf"], b"", GEOMETRY),
    of("PLY", &["ply"], b"ply\n", GEOMETRY),
    of("VRML", &["wrl", "vrml"], b"#VRML", GEOMETRY),
    of("DXF", &["dxf"], b"", GEOMETRY),
    of("DWG", &["dwg"], b"AC10", GEOMETRY),
    of("JT", &["jt"], b"", GEOMETRY),
    of("Rhino 3DM", &["3dm"], b"3D Geometry File Format", GEOMETRY),
    of("SketchUp", &["skp"], b"", GEOMETRY),
    of("3DXML", &["3dxml"], b"", GEOMETRY),
    of(
        "SolidWorks",
        &["sldasm", "sldprt", "slddrw", "asmdot"],
        b"",
        CAD,
    ),
    of("CATIA", &["catproduct", "catpart", "cgr"], b"V5_CFV2", CAD),
    of("Inventor", &["iam", "ipt"], b"", CAD),
    of("Creo or NX", &["prt", "asm", "neu"], b"", CAD),
    of("Solid Edge", &["par", "psm"], b"", CAD),
    of("Fusion", &["f3d", "f3z"], b"", CAD),
    of("KOMPAS-3D", &["a3d", "m3d"], b"", CAD),
    of(
        "OLE document (SolidWorks, Inventor and others)",
        &[],
        &[0xd0, 0xcf, 0x11, 0xe0, 0xa1, 0xb1, 0x1a, 0xe1],
        CAD,
    ),
    of("USD", &["usd", "usda", "usdc", "usdz"], b"#usda", SIMULATOR),
    of("USD", &[], b"PXR-USDC", SIMULATOR),
    of("Blender", &["blend"], b"BLENDER", SIMULATOR),
    of("Webots", &["wbt", "proto"], b"", SIMULATOR),
    of("CoppeliaSim", &["ttt", "ttm"], b"", SIMULATOR),
    of("OpenSim", &["osim"], b"", SIMULATOR),
    of("Simulink", &["slx", "mdl"], b"", SIMULATOR),
    of("Adams", &["adm", "cmd"], b"", SIMULATOR),
    of(
        "compiled MuJoCo",
        &["mjb"],
        b"",
        "save the model from MuJoCo as XML and give that",
    ),
    of(
        "template (ERB, Jinja, EmPy)",
        &["erb", "jinja", "jinja2", "j2", "em"],
        b"",
        TEMPLATE,
    ),
];

/// Refuses a file of a format that is not read, by its first bytes or by its ending, which no mechanism file has.
///
/// # Errors
/// The name of the format and what to do instead.
pub fn refuse(name: &str, bytes: &[u8]) -> Result<(), ImportError> {
    let path = std::path::Path::new(name);
    let ending = path
        .extension()
        .unwrap_or_default()
        .to_string_lossy()
        .to_lowercase();
    let begins = |f: &&Foreign| !f.begins.is_empty() && bytes.starts_with(f.begins);
    let by_bytes = FOREIGN.iter().find(begins);
    let by_ending = || {
        FOREIGN
            .iter()
            .find(|f| f.endings.contains(&ending.as_str()))
    };
    // The first line of IGES ends in its section and number.
    let line = bytes.split(|b| *b == b'\n').next().unwrap_or_default();
    let is_iges = line.len() >= 80 && &line[72..80] == b"S      1";
    let iges = || FOREIGN.iter().find(|f| is_iges && f.name == "IGES");
    match by_bytes.or_else(by_ending).or_else(iges) {
        None => Ok(()),
        Some(f) => {
            let message = format!("this is a {} file, which is not read; {}", f.name, f.remedy);
            Err(whole(message).at(name, "", None))
        }
    }
}
