//! Shapes as geoms, and the meshes that they name.

use crate::robots::convert::payload::{LinkShape, Solid, Use};
use crate::robots::convert::text::{attributes, pos_axes};
use crate::robots::mechanism::series_of_single_joints::{Names, escape, number, numbers};
use std::fmt::Write;

/// Meshes by file and scale.
#[derive(Default)]
pub(super) struct Meshes {
    all: Vec<(String, [f64; 3], String)>,
    names: Names,
    geoms: Names,
}

impl Meshes {
    fn name(&mut self, file: &str, scale: [f64; 3]) -> String {
        if let Some(known) = self.all.iter().find(|m| m.0 == file && m.1 == scale) {
            return known.2.clone();
        }
        let stem = std::path::Path::new(file).file_stem();
        let stem = stem.map_or_else(|| "mesh".to_owned(), |s| s.to_string_lossy().into_owned());
        let name = self.names.fit(&stem);
        self.all.push((file.to_owned(), scale, name.clone()));
        name
    }

    /// The `<asset>` that the geoms need.
    pub(super) fn asset(&self) -> String {
        if self.all.is_empty() {
            return String::new();
        }
        let mut out = "  <asset>\n".to_owned();
        for (file, scale, name) in &self.all {
            let scale = match scale {
                [1.0, 1.0, 1.0] => String::new(),
                s => format!(" scale=\"{}\"", numbers(*s)),
            };
            let _ = writeln!(
                out,
                "    <mesh name=\"{}\" file=\"{}\"{scale}/>",
                escape(name),
                escape(file)
            );
        }
        out + "  </asset>\n"
    }

    /// The line of a shape.
    pub(super) fn geom(&mut self, s: &LinkShape) -> String {
        let sizes = |all: &[f64]| {
            let words: Vec<String> = all.iter().map(|x| number(*x).to_string()).collect();
            format!("size=\"{}\"", words.join(" "))
        };
        let (kind, size) = match &s.solid {
            Solid::Box(edges) => ("box", sizes(&edges.map(|x| x / 2.0))),
            Solid::Sphere(r) => ("sphere", sizes(&[*r])),
            Solid::Cylinder(r, l) => ("cylinder", sizes(&[*r, l / 2.0])),
            Solid::Capsule(r, l) => ("capsule", sizes(&[*r, l / 2.0])),
            Solid::Ellipsoid(half) => ("ellipsoid", sizes(half)),
            Solid::Plane([x, y]) => ("plane", sizes(&[x / 2.0, y / 2.0, 0.05])),
            Solid::Mesh(file, scale) => {
                let name = self.name(file, *scale);
                ("mesh", format!("mesh=\"{}\"", escape(&name)))
            }
        };
        let name = s.name.as_ref().map_or(String::new(), |n| {
            format!(" name=\"{}\"", escape(&self.geoms.fit(n)))
        });
        let colour = s.colour.map_or(String::new(), |c| {
            format!(" rgba=\"{}\"", c.map(|x| number(x).to_string()).join(" "))
        });
        // What is seen alone touches nothing, and what touches alone is of the group that viewers hide.
        let has = |key: &str| s.words.iter().any(|w| w.0 == key);
        let mut more = attributes(&s.words);
        if s.use_ == Use::Seen && !has("contype") {
            more += " contype=\"0\" conaffinity=\"0\"";
        }
        if s.use_ != Use::Both && !has("group") {
            more += if s.use_ == Use::Seen {
                " group=\"2\""
            } else {
                " group=\"3\""
            };
        }
        format!(
            "<geom{name} type=\"{kind}\" {size}{}{colour}{more}/>",
            pos_axes(&s.place)
        )
    }
}
