//! How the links of a laid-out gripper move when its driver does, in the plane.
//!
//! Only how fast each link turns is unknown: that the contours stay closed is two equations each, as many as there are links
//! besides frame and driver. Where the links go follows from how they turn, from pin to pin.

use crate::chains::layout_symmetry::Input;
use crate::closure::tree::{TreeStep, forest};
use crate::geom::vector::{add_scaled, quarter, sub};
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
        add_scaled(self.shift, self.turning, quarter(point))
    }
}

/// A link of a contour, and the pins by which the contour leaves it and comes to it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Side {
    link: usize,
    leaves: usize,
    comes: usize,
}

/// What the links of a structure are joined to, as their velocities need it.
#[derive(Debug, Clone)]
pub struct Contours {
    links: usize,
    driver: usize,
    input: Input,
    /// Links in the order they are reached from the frame.
    tree: Vec<TreeStep<usize, usize>>,
    /// Of each contour its two ways from the frame, without the links they share.
    contours: Vec<[Vec<Side>; 2]>,
    /// The place of each link's turning among the unknown; those of frame and driver are known.
    unknown: Vec<Option<usize>>,
}

impl Contours {
    /// Of a structure.
    #[must_use]
    pub fn new(structure: &Structure) -> Contours {
        let (n, r) = (structure.chain.links(), &structure.roles);
        let pins = structure.chain.joints();
        let ends = pins.iter().map(|&(u, v)| [u, v]);
        // The driver is next to the frame, so that its joint is in the tree.
        let (_, tree) = forest(n, ends, |_| false, [r.frame]);
        let mut ways: Vec<Vec<(usize, usize)>> = vec![Vec::new(); n];
        for s in &tree {
            ways[s.link] = ways[s.from].clone();
            ways[s.link].push((s.link, s.joint));
        }
        let between = (0..pins.len()).filter(|&p| tree.iter().all(|s| s.joint != p));
        let contours = between.map(|pin| {
            let (u, v) = pins[pin];
            let both = ways[u].iter().zip(&ways[v]);
            // The last link that both pass through is left by different pins, and is a side of either.
            let shared = both.take_while(|(a, b)| a == b).count().saturating_sub(1);
            [u, v].map(|end| {
                let way = &ways[end];
                let side = |i: usize| Side {
                    link: way[i].0,
                    comes: way[i].1,
                    leaves: way.get(i + 1).map_or(pin, |next| next.1),
                };
                (shared..way.len()).map(side).collect()
            })
        });
        let mut count = 0;
        let unknown = (0..n).map(|l| {
            (l != r.frame && l != r.driver).then(|| {
                count += 1;
                count - 1
            })
        });
        Contours {
            links: n,
            driver: r.driver,
            input: structure.form.input,
            unknown: unknown.collect(),
            contours: contours.collect(),
            tree,
        }
    }

    /// Velocities of all links for a unit speed of the driver, a millimetre or a radian, with the pins at these places; `None`
    /// in a singular pose, and beyond all bounds next to one.
    ///
    /// # Complexity
    /// O(n³) for n links.
    #[must_use]
    pub fn velocities(&self, at: &[[f64; 2]]) -> Option<Vec<Velocity>> {
        let size = 2 * self.contours.len();
        let mut matrix = Matrix::zeros(size, size);
        let mut right = vec![0.0; size];
        // The sum of ω × (leaves - comes) over the one way is that over the other; a slide adds its millimetre, turned back by
        // a quarter as all are.
        for (k, ways) in self.contours.iter().enumerate() {
            for (way, sign) in ways.iter().zip([1.0, -1.0]) {
                for side in way {
                    let arm = sub(at[side.leaves], at[side.comes]);
                    match (self.unknown[side.link], self.input) {
                        (Some(column), _) => {
                            matrix[(2 * k, column)] += sign * arm[0];
                            matrix[(2 * k + 1, column)] += sign * arm[1];
                        }
                        (None, Input::Turn) => {
                            right[2 * k] -= sign * arm[0];
                            right[2 * k + 1] -= sign * arm[1];
                        }
                        (None, Input::Slide) => right[2 * k + 1] += sign,
                    }
                }
            }
        }
        let found = solve(&matrix, &right);
        if found.iter().any(|x| !x.is_finite()) {
            return None;
        }
        let mut out = vec![Velocity::default(); self.links];
        for s in &self.tree {
            let before = out[s.from];
            let driven = s.link == self.driver;
            out[s.link] = match (self.unknown[s.link], self.input) {
                (None, Input::Slide) if driven => Velocity {
                    turning: 0.0,
                    shift: [1.0, 0.0],
                },
                (column, _) => {
                    let turning = column.map_or(1.0, |c| found[c]);
                    let slower = before.turning - turning;
                    Velocity {
                        turning,
                        shift: add_scaled(before.shift, slower, quarter(at[s.joint])),
                    }
                }
            };
        }
        Some(out)
    }
}
