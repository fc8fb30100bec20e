//! How the links of a laid-out gripper move when its driver does, in the plane.
//!
//! Only how fast each link turns is unknown: that the contours stay closed is two equations each, as many as there are links
//! besides frame and driver. Where the links go follows from how they turn, from pin to pin.

use crate::chains::Input;
use crate::closure::tree::{TreeStep, spanning_forest};
use crate::geom::vector::{add_scaled, quarter_turn, sub};
use crate::synthesis::elimination::SmallSystem;
use crate::synthesis::structure::Structure;

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
    pub fn velocity_at(&self, point: [f64; 2]) -> [f64; 2] {
        add_scaled(self.shift, self.turning, quarter_turn(point))
    }
}

/// A link of a contour, and the points by which the contour leaves it and comes to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Side {
    pub(super) link: usize,
    pub(super) leaves: usize,
    pub(super) comes: usize,
}

/// What the links of a structure are joined to, as their velocities need it.
#[derive(Debug, Clone)]
pub struct Contours {
    links: usize,
    pub(super) driver: usize,
    pub(super) input: Input,
    /// Links in the order they are reached from the frame.
    pub(super) tree: Vec<TreeStep<usize, usize>>,
    /// Of each contour its two ways from the frame, without the links they share.
    pub(super) contours: Vec<[Vec<Side>; 2]>,
    /// The pin in which the two ways of each meet, by way of its first link and of its second.
    pub(super) cuts: Vec<usize>,
    /// Of each jaw its way from the frame to the tip.
    pub(super) tips: Vec<Vec<Side>>,
    /// The place of each link's turning among the unknown; those of frame and driver are known.
    pub(super) unknown: Vec<Option<usize>>,
}

/// The sides of a way from the frame, each link of it with the pin it is reached by, to a point of the last.
fn sides(way: &[(usize, usize)], to: usize) -> Vec<Side> {
    let side = |(i, &(link, comes)): (usize, &(usize, usize))| Side {
        link,
        comes,
        leaves: way.get(i + 1).map_or(to, |next| next.1),
    };
    way.iter().enumerate().map(side).collect()
}

impl Contours {
    /// Of a structure.
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
            // The last link that both pass through is left by different pins, and is a side of either.
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

    /// Velocities of all links for a unit speed of the driver, a millimetre or a radian, with the pins at these places; `None`
    /// in a singular pose, and beyond all bounds next to one.
    ///
    /// # Complexity
    /// O(n³) for n links.
    #[must_use]
    pub fn link_velocities(&self, at: &[[f64; 2]]) -> Option<Vec<Velocity>> {
        let size = 2 * self.contours.len();
        let mut system = SmallSystem::new(size, 1);
        // The sum of ω × (leaves - comes) over the one way is that over the other; a slide adds its millimetre, turned back by
        // a quarter as all are.
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
