//! Velocities of the links of a laid-out gripper in the plane, for a given motion of its driver.
//!
//! Only the angular velocity of each link is unknown. The closure of each contour gives two equations, as many in total as there are links
//! other than frame and driver. The velocities of points follow from the angular velocities, from pin to pin.

use crate::chains::Input;
use crate::closure::tree::{TreeStep, spanning_forest};
use crate::geom::vector::{add_scaled, quarter_turn, sub};
use crate::synthesis::equations::elimination::SmallSystem;
use crate::synthesis::structure::Structure;

/// Velocity of a link: its angular velocity, and the velocity of its point at the origin.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Velocity {
    /// The angular velocity, in rad for a unit of the drive.
    pub turning: f64,
    /// The velocity of the point of the link at the origin.
    pub shift: [f64; 2],
}

impl Velocity {
    /// Returns the velocity of a point of the link.
    #[must_use]
    pub fn velocity_at(&self, point: [f64; 2]) -> [f64; 2] {
        add_scaled(self.shift, self.turning, quarter_turn(point))
    }
}

/// A link of a contour, and the points at which the contour leaves it and enters it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::synthesis) struct Side {
    pub(in crate::synthesis) link: usize,
    pub(in crate::synthesis) leaves: usize,
    pub(in crate::synthesis) comes: usize,
}

/// Connections of the links of a structure, as their velocities need them.
#[derive(Debug, Clone)]
pub struct Contours {
    links: usize,
    pub(in crate::synthesis) driver: usize,
    pub(in crate::synthesis) input: Input,
    /// Links in the order they are reached from the frame.
    pub(in crate::synthesis) tree: Vec<TreeStep<usize, usize>>,
    /// For each contour, its two paths from the frame, without the links they share.
    pub(in crate::synthesis) contours: Vec<[Vec<Side>; 2]>,
    /// The pin in which the two paths of each contour meet. The first path comes by its first link, the second by its second.
    pub(in crate::synthesis) cuts: Vec<usize>,
    /// For each jaw, its path from the frame to the tip.
    pub(in crate::synthesis) tips: Vec<Vec<Side>>,
    /// The index of each link's angular velocity among the unknowns; those of frame and driver are known.
    pub(in crate::synthesis) unknown: Vec<Option<usize>>,
}

/// Returns the sides of a path from the frame to a point of its last link. Each link of the path comes with the pin by which it is reached.
fn sides(way: &[(usize, usize)], to: usize) -> Vec<Side> {
    let side = |(i, &(link, comes)): (usize, &(usize, usize))| Side {
        link,
        comes,
        leaves: way.get(i + 1).map_or(to, |next| next.1),
    };
    way.iter().enumerate().map(side).collect()
}

impl Contours {
    /// Creates the contours of a structure.
    #[must_use]
    pub fn new(structure: &Structure) -> Contours {
        let roles = &structure.structure.roles;
        let (n, [frame, driver]) = (structure.structure.chain.links(), roles.drive_links());
        let pins = structure.structure.chain.joints();
        let ends = pins.iter().map(|j| j.links);
        // The driver is next to the frame, so that its joint is in the tree.
        let (_, tree) = spanning_forest(n, ends, |_| false, [frame]);
        let mut ways: Vec<Vec<(usize, usize)>> = vec![Vec::new(); n];
        for s in &tree {
            ways[s.link] = ways[s.from].clone();
            ways[s.link].push((s.link, s.joint));
        }
        let between = (0..pins.len()).filter(|&p| tree.iter().all(|s| s.joint != p));
        let cuts: Vec<usize> = between.collect();
        let contours = cuts.iter().map(|&pin| {
            let [u, v] = pins[pin].links;
            let both = ways[u].iter().zip(&ways[v]);
            // The last link that both paths share is left by different pins, and is a side of both.
            let shared = both.take_while(|(a, b)| a == b).count().saturating_sub(1);
            [u, v].map(|end| sides(&ways[end], pin).split_off(shared))
        });
        let jaws = roles.jaws.iter().enumerate();
        let tips = jaws.map(|(n, &jaw)| sides(&ways[jaw], pins.len() + n));
        let mut count = 0;
        let unknown = (0..n).map(|l| {
            (l != frame && l != driver).then(|| {
                count += 1;
                count - 1
            })
        });
        Contours {
            links: n,
            driver,
            input: structure.drive_input(),
            unknown: unknown.collect(),
            contours: contours.collect(),
            tips: tips.collect(),
            cuts,
            tree,
        }
    }

    /// Solves the velocities of all links for a unit speed of the driver, a millimetre or a radian, with the pins at these places. `None`
    /// in a singular pose; unbounded near one.
    ///
    /// # Complexity
    /// O(n³) for n links.
    #[must_use]
    pub fn link_velocities(&self, at: &[[f64; 2]]) -> Option<Vec<Velocity>> {
        let size = 2 * self.contours.len();
        let mut system = SmallSystem::new(size, 1);
        // The sum of ω × (leaves - comes) is the same over both paths. A slide adds its millimetre, turned back by a quarter like all
        // terms.
        for (k, ways) in self.contours.iter().enumerate() {
            for (way, sign) in ways.iter().zip([1.0, -1.0]) {
                for side in way {
                    let arm = sub(at[side.leaves], at[side.comes]);
                    match (self.unknown[side.link], self.input) {
                        (Some(column), _) => {
                            system.add_entry(2 * k, column, sign * arm[0]);
                            system.add_entry(2 * k + 1, column, sign * arm[1]);
                        }
                        (None, Input::Turn) => {
                            system.add_entry(2 * k, size, -sign * arm[0]);
                            system.add_entry(2 * k + 1, size, -sign * arm[1]);
                        }
                        (None, Input::Slide) => system.add_entry(2 * k + 1, size, sign),
                    }
                }
            }
        }
        system.solve_all()?;
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
                    let turning = column.map_or(1.0, |c| system.get(c, 0));
                    let slower = before.turning - turning;
                    Velocity {
                        turning,
                        shift: add_scaled(before.shift, slower, quarter_turn(at[s.joint])),
                    }
                }
            };
        }
        Some(out)
    }
}
