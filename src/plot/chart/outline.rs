//! Closed curves in their true shape, such as the profile of a cam.

use super::frame::{Head, begin, label, stroke};
use crate::chart::style::{PAD, WIDTH};
use crate::format::{csv, significant};
use crate::svg::plane::{Point, polyline};

/// Closed curves around one centre.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// The title.
    pub title: String,
    /// One sentence under the title, or empty.
    pub subtitle: String,
    /// Unit of the points.
    pub unit: String,
    /// Names and points; x to the right, y up, the centre at the origin.
    pub curves: Vec<(String, Vec<[f64; 2]>)>,
}

/// Width of the drawing. `[px]`
const SIZE: f64 = 520.0;

impl Outline {
    fn reach(&self) -> f64 {
        let all = self.curves.iter().flat_map(|c| &c.1);
        all.map(|p| p[0].hypot(p[1])).fold(0.0, f64::max)
    }

    /// Returns the picture.
    #[must_use]
    pub fn svg(&self) -> String {
        let head = Head::new(&self.title, &self.subtitle, WIDTH);
        let (middle, top) = (WIDTH / 2.0, head.height());
        let centre = top + SIZE / 2.0 + PAD;
        let height = centre + SIZE / 2.0 + 2.0 * PAD;
        let reach = self.reach().max(1e-300);
        let about = "Closed curves at their true shape.";
        let mut xml = begin((WIDTH, height), "oz", &self.title, about, &head);
        let by = SIZE / 2.0 / reach;
        for [x, y] in [[8.0, 0.0], [0.0, 8.0]] {
            let ends = [-1.0, 1.0].map(|s| (middle + s * x, centre + s * y));
            stroke(&mut xml, "axis", ends[0], ends[1]);
        }
        for (i, (name, points)) in self.curves.iter().enumerate() {
            let at = |p: &[f64; 2]| [middle + by * p[0], centre - by * p[1]];
            let all: Vec<Point> = points.iter().map(at).collect();
            let class = format!("line c{}{}", i % 7, if i > 0 { " dash" } else { "" });
            let line = xml.tag("path").set("class", &class);
            line.set("d", &polyline(&all, true)).tip(name);
            #[allow(clippy::cast_precision_loss, reason = "a few curves")]
            let y = top + PAD + 16.0 * i as f64;
            stroke(&mut xml, &class, (PAD, y - 4.0), (PAD + 24.0, y - 4.0));
            label(&mut xml, "", (PAD + 30.0, y), "").text(name);
        }
        let scale = format!("greatest radius {} {}", significant(reach), self.unit);
        label(&mut xml, "soft", (PAD, height - PAD), "").text(&scale);
        xml.finish()
    }

    /// Returns one point per line.
    #[must_use]
    pub fn csv(&self) -> String {
        let point = |name: &str, [x, y]: &[f64; 2]| {
            vec![name.to_owned(), format!("{x:?}"), format!("{y:?}")]
        };
        let rows = self
            .curves
            .iter()
            .flat_map(|(n, c)| c.iter().map(move |p| point(n, p)));
        csv::table(&["curve", "x", "y"], rows)
    }

    /// Returns the curves as closed polylines of a DXF file (release 12, which every reader supports), one layer each.
    #[must_use]
    pub fn dxf(&self) -> String {
        let mut out = String::from("0\nSECTION\n2\nENTITIES\n");
        for (name, points) in &self.curves {
            let layer: String = name
                .chars()
                .map(|c| if c.is_ascii_alphanumeric() { c } else { '_' })
                .collect();
            out += &format!("0\nPOLYLINE\n8\n{layer}\n66\n1\n70\n1\n");
            for p in points {
                out += &format!(
                    "0\nVERTEX\n8\n{layer}\n10\n{:?}\n20\n{:?}\n30\n0.0\n",
                    p[0], p[1]
                );
            }
            out += &format!("0\nSEQEND\n8\n{layer}\n");
        }
        out + "0\nENDSEC\n0\nEOF\n"
    }
}
