//! Mechanisms of special geometry with one joint off, made from a seed and written with so many decimals.

use super::Truth;
use super::change::{Noise, Place, with_exact_decimals};
use crate::file::text::mechanism_from_str;
use crate::geom::rigid::RigidMotion;
use crate::geom::vector::Vector;
use crate::model::mechanism::Mechanism;
use std::fmt::Write as _;

/// A kind of special geometry.
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

    /// Returns the name used in pictures.
    pub fn name(self) -> &'static str {
        match self {
            SpecialKind::Door => "door",
            SpecialKind::FourBar => "four-bar",
            SpecialKind::Spherical => "spherical four-bar",
            SpecialKind::Rods => "three rods",
        }
    }

    /// Returns the true figures, with the offset or without it. Parallel rods of any length stay shaky.
    pub fn true_figures(self, off: bool) -> Truth {
        match (self, off) {
            (_, false) => Truth::new(1, 1),
            (SpecialKind::Rods, true) => Truth::new(1, 0),
            (_, true) => Truth::new(0, 0),
        }
    }

    /// Returns the hinges, of a size near 2. One is off by a length or an angle.
    fn place_hinges(self, off: f64, unit: f64, noise: &mut Noise) -> Vec<Hinge> {
        // On the grid of the last digit, so that rounding does not change the offset of what is not turned.
        let mut near = |x: f64| ((x + 0.2 * noise.draw_uniform()) / unit).round() * unit;
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

    /// Returns the file of a mechanism that is off by `units` units of the last digit. With `turned`, it is rotated in
    /// space.
    pub fn text(self, units: f64, decimals: usize, turned: bool, noise: &mut Noise) -> String {
        let unit = 10f64.powi(-(decimals as i32));
        let axis = [(); 3].map(|()| noise.draw_uniform());
        let angle = std::f64::consts::PI * noise.draw_uniform();
        let hinges = self.place_hinges(units * unit, unit, noise);
        let turn = RigidMotion::from_turn(axis, if turned { angle } else { 0.0 });
        let vector = |v: Vector, decimals: usize| {
            let [x, y, z] = turn.map_direction(v);
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
        let mut file = Sketch::with_links(links);
        for (a, b, point, axis) in hinges {
            let (point, axis) = (vector(point, decimals), axis_of(axis));
            file.add_joint([a, b], "revolute", &point, &axis);
        }
        file.text(self.name())
    }

    /// Returns a special mechanism with coordinates in whole hundredths, and the place that displaces it. Returns `None` if
    /// directions are irrational.
    pub(crate) fn with_place(self, noise: &mut Noise) -> Option<(Mechanism, Place)> {
        let place = match self {
            SpecialKind::Door => (1, false, 0),
            SpecialKind::FourBar => (2, true, 0),
            SpecialKind::Rods => (5, false, 1),
            SpecialKind::Spherical => return None,
        };
        let text = self.text(0.0, 2, false, noise);
        let m = mechanism_from_str("special.toml", &text).expect("a generated file is valid");
        Some((with_exact_decimals(&m), place))
    }
}

/// Links and joints on the way to a file: the first link is the frame, the last the output.
#[derive(Debug, Default)]
pub(crate) struct Sketch {
    links: Vec<String>,
    joints: String,
    count: usize,
}

impl Sketch {
    /// Returns a sketch with these links in this order. Joints add further links.
    pub(crate) fn with_links<T: ToString>(links: impl IntoIterator<Item = T>) -> Sketch {
        Sketch {
            links: links.into_iter().map(|l| l.to_string()).collect(),
            ..Sketch::default()
        }
    }

    /// Adds a joint between two links. Its point and axis are written to the file unchanged.
    pub(crate) fn add_joint(&mut self, ends: [&str; 2], kind: &str, point: &str, axis: &str) {
        for end in ends {
            if !self.links.iter().any(|l| l == end) {
                self.links.push(end.to_owned());
            }
        }
        // Writing to a string does not fail.
        let _ = write!(
            self.joints,
            "[[joint]]\nid = \"j{}\"\nlinks = {ends:?}\ntype = \"{kind}\"\npoint = {point}\naxis = {axis}\n",
            self.count
        );
        self.count += 1;
    }

    /// Adds a hinge along z at a point of the x-y plane.
    pub(crate) fn add_pin(&mut self, ends: [&str; 2], [x, y]: [i64; 2]) {
        self.add_joint(ends, "revolute", &format!("[{x}, {y}, 0]"), "[0, 0, 1]");
    }

    /// Returns the file.
    pub(crate) fn text(&self, name: &str) -> String {
        let mut out = format!("name = \"{name}\"\n");
        for (i, link) in self.links.iter().enumerate() {
            let role = match i {
                0 => "role = \"frame\"\n",
                i if i + 1 == self.links.len() => "role = \"output\"\n",
                _ => "",
            };
            let _ = write!(out, "[[link]]\nid = \"{link}\"\n{role}");
        }
        out + &self.joints
    }
}
