//! How the links of a laid-out gripper move when its driver does, in the plane.

use crate::chains::layout_symmetry::Input;
use crate::geom::vector::quarter;
use crate::synthesis::rules::Rules;
use crate::synthesis::structure::Structure;
use ozols_dense::{Matrix, solve};

/// A velocity of a link: its turning, and the velocity of its point at the origin.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Velocity {
    /// In rad for a unit of the drive.
    pub turning: f64,
    /// Of the point of the link at the origin.
    pub shift: [f64; 2],
}

impl Velocity {
    /// Of a point of the link.
    #[must_use]
    pub fn at(&self, point: [f64; 2]) -> [f64; 2] {
        let [x, y] = quarter(point);
        [
            self.shift[0] + self.turning * x,
            self.shift[1] + self.turning * y,
        ]
    }
}

/// The length that velocities are measured with.
const LENGTH: f64 = 50.0;

/// Velocities of all links for a unit speed of the driver, a millimetre or a radian; `None` in a singular pose, and beyond
/// all bounds next to one.
///
/// # Complexity
/// O(n³) for n links.
#[must_use]
pub fn velocities(structure: &Structure, rules: &Rules, at: &[[f64; 2]]) -> Option<Vec<Velocity>> {
    let (n, r) = (structure.chain.links(), &structure.roles);
    let unknown = |l: usize| 3 * (l - usize::from(l > r.frame));
    let size = 3 * (n - 1);
    let mut matrix = Matrix::zeros(size, size);
    let mut rights = Vec::with_capacity(size);
    let mut row = |entries: &[(usize, usize, f64)], right: f64| {
        for &(link, part, value) in entries.iter().filter(|(l, ..)| *l != r.frame) {
            matrix[(rights.len(), unknown(link) + part)] += value;
        }
        rights.push(right);
    };
    for (i, &(u, v)) in rules.pins.iter().enumerate() {
        if i == rules.input && structure.form.input == Input::Slide {
            row(&[(r.driver, 0, 1.0)], 0.0);
            row(&[(r.driver, 2, 1.0)], 0.0);
            continue;
        }
        let [x, y] = at[i].map(|x| x / LENGTH);
        row(&[(u, 0, -y), (u, 1, 1.0), (v, 0, y), (v, 1, -1.0)], 0.0);
        row(&[(u, 0, x), (u, 2, 1.0), (v, 0, -x), (v, 2, -1.0)], 0.0);
    }
    match structure.form.input {
        Input::Slide => row(&[(r.driver, 1, 1.0)], 1.0 / LENGTH),
        Input::Turn => row(&[(r.driver, 0, 1.0)], 1.0),
    }
    let found = solve(&matrix, &rights);
    if found.iter().any(|x| !x.is_finite()) {
        return None;
    }
    let of = |l: usize| match l == r.frame {
        true => Velocity::default(),
        false => {
            let u = unknown(l);
            Velocity {
                turning: found[u],
                shift: [found[u + 1] * LENGTH, found[u + 2] * LENGTH],
            }
        }
    };
    Some((0..n).map(of).collect())
}
