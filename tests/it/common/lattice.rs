//! Mechanisms of any number of contours, for tests of the structure of J and for `cargo bench --bench rank`.

use ozols::file::text::mechanism_from_str;
use ozols::model::mechanism::Mechanism;
use std::fmt::Write as _;

/// A kind of mechanism.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LatticeKind {
    /// Planar four-bars side by side on the frame, each driven by the one before: k contours, W = 1, σ = 3k.
    FourBars,
    /// A lazy tongs of k + 1 crossed pairs of bars: k contours, W = 1, σ = 3k.
    Scissors,
    /// Bodies on a grid four wide with joints of many types at many places and angles: k contours in bands of three.
    Grid,
}

impl LatticeKind {
    /// All of them.
    pub(crate) const ALL: [LatticeKind; 3] = [
        LatticeKind::FourBars,
        LatticeKind::Scissors,
        LatticeKind::Grid,
    ];
}

/// Two links, a type, a point and an axis.
type Joint = ([usize; 2], &'static str, [usize; 3], [i32; 3]);

/// Returns a mechanism of `k` contours (for a grid: the next multiple of three).
pub(crate) fn lattice_mechanism(kind: LatticeKind, k: usize) -> Mechanism {
    let pin = |ends, [x, y]: [usize; 2]| (ends, "revolute", [x, y, 0], [0, 0, 1]);
    let (links, joints): (usize, Vec<Joint>) = match kind {
        LatticeKind::FourBars => {
            // Cranks 1, 3, 5, ... and the couplers between them.
            let cranks = (0..=k).map(|i| pin([0, 2 * i + 1], [3 * i, i % 2]));
            let couplers = (0..k).flat_map(|i| {
                let (crank, coupler) = (2 * i + 1, if i + 1 == k { 2 * k } else { 2 * i + 2 });
                [
                    pin([crank, coupler], [3 * i + 1, 4 + i % 3]),
                    pin([coupler, crank + 2], [3 * i + 3, 3 + i % 4]),
                ]
            });
            (2 * k + 2, cranks.chain(couplers).collect())
        }
        LatticeKind::Scissors => {
            // Bars 2i (rising) and 2i + 1 (falling) cross at (2i + 1, 1).
            let crossed = (0..=k).map(|i| pin([2 * i, 2 * i + 1], [2 * i + 1, 1]));
            let ends = (0..k).flat_map(|i| {
                [
                    pin([2 * i, 2 * i + 3], [2 * i + 2, 2]),
                    pin([2 * i + 1, 2 * i + 2], [2 * i + 2, 0]),
                ]
            });
            (2 * k + 2, crossed.chain(ends).collect())
        }
        LatticeKind::Grid => grid_joints(k.div_ceil(3) + 1),
    };
    let mut text = "name = \"lattice\"\n".to_owned();
    for link in 0..links {
        let role = match link {
            0 => "role = \"frame\"\n",
            l if l + 1 == links => "role = \"output\"\n",
            _ => "",
        };
        let _ = write!(text, "[[link]]\nid = \"{link}\"\n{role}");
    }
    for (n, ([a, b], kind, point, axis)) in joints.into_iter().enumerate() {
        let _ = write!(
            text,
            "[[joint]]\nid = \"j{n}\"\nlinks = [\"{a}\", \"{b}\"]\ntype = \"{kind}\"\npoint = {point:?}\naxis = {axis:?}\n"
        );
    }
    mechanism_from_str("lattice.toml", &text).expect("a valid file")
}

/// Returns the number of links of a grid, and its joints.
fn grid_joints(rows: usize) -> (usize, Vec<Joint>) {
    const TYPES: [&str; 6] = [
        "revolute",
        "universal",
        "revolute",
        "spherical",
        "cylindrical",
        "prismatic",
    ];
    const AXES: [[i32; 3]; 5] = [[0, 0, 1], [1, 0, 0], [0, 0, 1], [0, 1, 0], [1, 2, -1]];
    let mut joints = Vec::new();
    for l in 0..4 * rows {
        let neighbours = [(l % 4 < 3, l + 1), (l / 4 + 1 < rows, l + 4)];
        for (n, (there, to)) in neighbours.into_iter().enumerate() {
            let mix = (l * 7 + n * 3) ^ (l / 5);
            let point = [mix % 5, (mix / 2) % 7, l % 3];
            if there {
                joints.push(([l, to], TYPES[mix % 6], point, AXES[(mix + l) % 5]));
            }
        }
    }
    (4 * rows, joints)
}
