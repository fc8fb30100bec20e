//! Velocities of links in the plane, and the contours of a gripper that has only hinges.
//!
//! Only the turn of each link is unknown. The closure of each contour gives two equations, as many in total as there are links other than
//! frame and driver. The places of points follow from the turns, from pin to pin.

use crate::chains::Input;
use crate::closure::tree::{TreeStep, spanning_forest};
use crate::geom::vector::{add_scaled, quarter_turn};
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
    /// Returns the velocity for a unit of the drive, given that for another parameter and the rate of the drive over it.
    pub(in crate::synthesis) fn divided_by(&self, rate: f64) -> Velocity {
        Velocity {
            turning: self.turning / rate,
            shift: self.shift.map(|x| x / rate),
        }
    }

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
            driver,
            input: structure.drive_input(),
            unknown: unknown.collect(),
            contours: contours.collect(),
            tips: tips.collect(),
            cuts,
            tree,
        }
    }
}
