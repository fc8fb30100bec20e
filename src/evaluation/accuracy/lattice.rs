//! Mechanisms of any number of contours, whose mobility is known by construction or by exact ranks.

use crate::file::text::mechanism_from_str;
use crate::model::mechanism::Mechanism;
use std::fmt::Write;

/// What to build.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LatticeKind {
    /// Planar four-bars side by side on the frame, each driven by the one before: k contours, W = 1, σ = 3k.
    FourBars,
    /// A lazy tongs of k + 1 crossed pairs of bars: k contours, W = 1, σ = 3k.
    Scissors,
    /// Bodies on a grid four wide with joints of many types at many places and angles: k contours in bands of three.
    Grid,
}

impl LatticeKind {
    /// All of them.
    pub const ALL: [LatticeKind; 3] = [
        LatticeKind::FourBars,
        LatticeKind::Scissors,
        LatticeKind::Grid,
    ];
}

struct LatticeFile(String);

impl LatticeFile {
    fn new(links: usize) -> LatticeFile {
        let mut out = String::from("name = \"lattice\"\n");
        for l in 0..links {
            let role = match l {
                0 => "role = \"frame\"\n",
                _ if l + 1 == links => "role = \"output\"\n",
                _ => "",
            };
            let _ = write!(out, "[[link]]\nid = \"{l}\"\n{role}");
        }
        LatticeFile(out)
    }

    fn joint(&mut self, ends: [usize; 2], kind: &str, point: [usize; 3], axis: [i32; 3]) {
        let n = self.0.matches("[[joint]]").count();
        let [a, b] = ends;
        let _ = write!(
            self.0,
            "[[joint]]\nid = \"j{n}\"\nlinks = [\"{a}\", \"{b}\"]\ntype = \"{kind}\"\npoint = {point:?}\naxis = {axis:?}\n"
        );
    }

    fn hinge(&mut self, ends: [usize; 2], x: usize, y: usize) {
        self.joint(ends, "revolute", [x, y, 0], [0, 0, 1]);
    }
}

/// A mechanism of `k` contours (for a grid: the next multiple of three).
///
/// # Panics
/// Never: the text is valid.
#[must_use]
pub fn mechanism(kind: LatticeKind, k: usize) -> Mechanism {
    let mut file;
    match kind {
        LatticeKind::FourBars => {
            // Cranks 1, 3, 5, ... and the couplers between them.
            file = LatticeFile::new(2 * k + 2);
            for i in 0..=k {
                file.hinge([0, 2 * i + 1], 3 * i, i % 2);
            }
            for i in 0..k {
                let (crank, coupler) = (2 * i + 1, if i + 1 == k { 2 * k } else { 2 * i + 2 });
                file.hinge([crank, coupler], 3 * i + 1, 4 + i % 3);
                file.hinge([coupler, crank + 2], 3 * i + 3, 3 + i % 4);
            }
        }
        LatticeKind::Scissors => {
            // Bars 2i (rising) and 2i + 1 (falling) cross at (2i + 1, 1).
            file = LatticeFile::new(2 * k + 2);
            for i in 0..=k {
                file.hinge([2 * i, 2 * i + 1], 2 * i + 1, 1);
            }
            for i in 0..k {
                file.hinge([2 * i, 2 * i + 3], 2 * i + 2, 2);
                file.hinge([2 * i + 1, 2 * i + 2], 2 * i + 2, 0);
            }
        }
        LatticeKind::Grid => {
            const TYPES: [&str; 6] = [
                "revolute",
                "universal",
                "revolute",
                "spherical",
                "cylindrical",
                "prismatic",
            ];
            const AXES: [[i32; 3]; 5] = [[0, 0, 1], [1, 0, 0], [0, 0, 1], [0, 1, 0], [1, 2, -1]];
            let rows = k.div_ceil(3) + 1;
            file = LatticeFile::new(4 * rows);
            for l in 0..4 * rows {
                let neighbours = [(l % 4 < 3, l + 1), (l / 4 + 1 < rows, l + 4)];
                for (n, (_, to)) in neighbours
                    .iter()
                    .enumerate()
                    .filter(|(_, (there, _))| *there)
                {
                    let mix = (l * 7 + n * 3) ^ (l / 5);
                    let point = [mix % 5, (mix / 2) % 7, l % 3];
                    file.joint([l, *to], TYPES[mix % 6], point, AXES[(mix + l) % 5]);
                }
            }
        }
    }
    mechanism_from_str("lattice.toml", &file.0).expect("a generated file is valid")
}
