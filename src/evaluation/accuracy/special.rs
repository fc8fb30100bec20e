//! Small mechanisms written down as files of their own, and those of special geometry with one joint off, made from a seed and written
//! with so many decimals.

use super::change::Noise;
use crate::geom::rigid::RigidMotion;
use crate::geom::vector::Vector;
use std::fmt::Write as _;

/// What is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpecialKind {
    /// A door on two hinges, one out of line.
    Door,
    /// A planar four-bar with one axis tilted.
    FourBar,
    /// A spherical four-bar with one axis off the centre.
    Spherical,
    /// A plate on three parallel rods, one of which is longer.
    Rods,
}

/// Two links, a point and an axis.
type Hinge = (&'static str, &'static str, Vector, Vector);

const Z: Vector = [0.0, 0.0, 1.0];

impl SpecialKind {
    /// All of them.
    pub const ALL: [SpecialKind; 4] = [
        SpecialKind::Door,
        SpecialKind::FourBar,
        SpecialKind::Spherical,
        SpecialKind::Rods,
    ];

    /// Its name in pictures.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            SpecialKind::Door => "door",
            SpecialKind::FourBar => "four-bar",
            SpecialKind::Spherical => "spherical four-bar",
            SpecialKind::Rods => "three rods",
        }
    }

    /// (W at the pose, finite mobility), with the offset or without it. Parallel rods stay shaky whatever their lengths.
    #[must_use]
    pub fn figures(self, off: bool) -> (i64, i64) {
        match (self, off) {
            (_, false) => (1, 1),
            (SpecialKind::Rods, true) => (1, 0),
            (_, true) => (0, 0),
        }
    }

    /// Its hinges, of a size near 2, one off by a length or an angle.
    fn hinges(self, off: f64, unit: f64, noise: &mut Noise) -> Vec<Hinge> {
        // On the grid of the last digit, so that rounding does not change the offset of what is not turned.
        let mut near = |x: f64| ((x + 0.2 * noise.uniform()) / unit).round() * unit;
        match self {
            SpecialKind::Door => {
                let [x, y, low, high] = [1.3, -0.7, 0.3, 2.2].map(&mut near);
                let (one, two) = ([x, y, low], [x + off, y, high]);
                vec![("0", "door", one, Z), ("0", "door", two, Z)]
            }
            SpecialKind::FourBar => {
                let mut at = |x, y| [near(x), near(y), near(0.4)];
                vec![
                    ("0", "crank", at(0.3, 0.2), Z),
                    ("crank", "coupler", at(0.6, 1.3), Z),
                    ("coupler", "rocker", at(1.8, 1.7), [off, 0.0, 1.0]),
                    ("rocker", "0", at(2.3, 0.5), Z),
                ]
            }
            SpecialKind::Spherical => {
                let c = [0.4, -0.3, 0.7].map(&mut near);
                let mut through = |x, y, z, off: f64| {
                    let v: Vector = [near(x), near(y), near(z)];
                    let size = v.iter().map(|x| x * x).sum::<f64>().sqrt();
                    let v = v.map(|x| x / size);
                    let r = near(1.0);
                    ([c[0] + off + r * v[0], c[1] + r * v[1], c[2] + r * v[2]], v)
                };
                let ends = [
                    through(1.0, 0.2, 0.3, 0.0),
                    through(-0.3, 1.0, 0.3, 0.0),
                    through(-0.6, -0.6, 1.0, 0.0),
                    through(0.3, -0.9, 0.5, off),
                ];
                let links = ["0", "crank", "coupler", "rocker", "0"];
                let of = |(i, (p, v)): (usize, (Vector, Vector))| (links[i], links[i + 1], p, v);
                ends.into_iter().enumerate().map(of).collect()
            }
            SpecialKind::Rods => {
                let length = near(1.4);
                let rods = [("one", 0.3, 0.0), ("two", 1.1, 0.0), ("three", 2.3, off)];
                let each = rods.into_iter().flat_map(|(rod, x, longer)| {
                    let (x, y, z) = (near(x), near(0.3), near(0.4));
                    let top = [x, y + length + longer, z];
                    [("0", rod, [x, y, z], Z), (rod, "plate", top, Z)]
                });
                each.collect()
            }
        }
    }

    /// The file of one that is off by so many units of the last digit, turned in space or not.
    #[must_use]
    pub fn text(self, units: f64, decimals: usize, turned: bool, noise: &mut Noise) -> String {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_possible_wrap,
            reason = "12 at most"
        )]
        let unit = 10f64.powi(-(decimals as i32));
        let axis = [(); 3].map(|()| noise.uniform());
        let angle = std::f64::consts::PI * noise.uniform();
        let hinges = self.hinges(units * unit, unit, noise);
        let turn = RigidMotion::turn(axis, if turned { angle } else { 0.0 });
        let vector = |v: Vector, decimals: usize| {
            let [x, y, z] = turn.direction(v);
            format!("[{x:.decimals$}, {y:.decimals$}, {z:.decimals$}]")
        };
        // A tilt counts in units of the axes; where points are off, axes have two decimals more, so that only points count.
        let finer = if self == SpecialKind::FourBar { 0 } else { 2 };
        let axis_of = |v: Vector| {
            if v == Z && !turned {
                "[0, 0, 1]".to_owned()
            } else {
                vector(v, decimals + finer)
            }
        };
        let mut links: Vec<&str> = hinges.iter().flat_map(|h| [h.0, h.1]).collect();
        links.sort_unstable();
        links.dedup();
        let mut out = format!("name = \"{}\"\n", self.name());
        for (i, link) in links.iter().enumerate() {
            let role = match i {
                0 => "role = \"frame\"\n",
                1 => "role = \"output\"\n",
                _ => "",
            };
            // Writing to a string does not fail.
            let _ = write!(out, "[[link]]\nid = \"{link}\"\n{role}");
        }
        for (i, (a, b, point, axis)) in hinges.into_iter().enumerate() {
            let (point, axis) = (vector(point, decimals), axis_of(axis));
            let _ = write!(
                out,
                "[[joint]]\nid = \"j{i}\"\nlinks = [\"{a}\", \"{b}\"]\ntype = \"revolute\"\npoint = {point}\naxis = {axis}\n"
            );
        }
        out
    }
}

/// Links, joints and what couples them, on the way to a file: the first link is the frame, the last the output.
#[derive(Debug, Default)]
pub(super) struct Sketch {
    links: Vec<String>,
    tables: String,
    joints: usize,
}

impl Sketch {
    fn link(&mut self, id: &str) {
        if !self.links.iter().any(|l| l == id) {
            self.links.push(id.to_owned());
        }
    }

    /// A hinge between two links, at a point and about an axis written as the file is to have them.
    pub(super) fn hinge(&mut self, ends: [&str; 2], point: [&str; 3], axis: [&str; 3]) {
        ends.iter().for_each(|l| self.link(l));
        let [a, b] = ends;
        // Writing to a string does not fail.
        let _ = write!(
            self.tables,
            "[[joint]]\nid = \"j{}\"\nlinks = [\"{a}\", \"{b}\"]\ntype = \"revolute\"\npoint = {point:?}\naxis = {axis:?}\n",
            self.joints
        );
        self.joints += 1;
    }

    /// A hinge along z at a place of the plane of x and y.
    pub(super) fn pin(&mut self, ends: [&str; 2], x: &str, y: &str) {
        self.hinge(ends, [x, y, "0"], ["0", "0", "1"]);
    }

    /// Couples two joints, counted from 0, by a ratio.
    pub(super) fn couple(&mut self, [a, b]: [usize; 2], ratio: &str) {
        let _ = write!(
            self.tables,
            "[[coupling]]\njoints = [\"j{a}\", \"j{b}\"]\nratio = \"{ratio}\"\n"
        );
    }

    /// The file.
    pub(super) fn text(&self, name: &str) -> String {
        let mut out = format!("name = \"{name}\"\n");
        for (i, link) in self.links.iter().enumerate() {
            let role = match i {
                0 => "role = \"frame\"\n",
                i if i + 1 == self.links.len() => "role = \"output\"\n",
                _ => "",
            };
            let _ = write!(out, "[[link]]\nid = \"{link}\"\n{role}");
        }
        out + &self.tables
    }
}
