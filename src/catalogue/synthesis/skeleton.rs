//! What of a structure does not depend on where its pins are, gathered once for the many places that are tried.

use crate::geom::vector::{sub, unit};
use crate::synthesis::limits::Limits;
use crate::synthesis::point::{Point, middle};
use crate::synthesis::rules::Rules;
use crate::synthesis::stroke::closure::Closure;
use crate::synthesis::structure::Structure;
use crate::synthesis::velocities::Contours;

/// A structure with the rules of its pins. Points are numbered: pins in the order of the chain's joints, then the tips.
#[derive(Debug)]
pub struct Skeleton<'a> {
    /// The structure.
    pub structure: &'a Structure,
    /// Which pins may be moved.
    pub rules: Rules,
    /// Points of each link: its pins, and of a jaw its tip.
    pub of_link: Vec<Vec<usize>>,
    /// The same as bits.
    pub members: Vec<u32>,
    /// Where the tips of the jaws are.
    pub tips: Vec<Point>,
    /// Which way each tip closes, of length 1.
    pub inward: Vec<Point>,
    /// Links that only push and pull: of two pins, neither frame nor driver nor jaw.
    pub rods: Vec<(usize, [usize; 2])>,
    /// What its velocities need.
    pub contours: Contours,
    /// What its stroke needs.
    pub closure: Closure,
    /// What it is to be like and to do.
    pub limits: Limits,
}

impl<'a> Skeleton<'a> {
    /// Of a structure.
    #[must_use]
    pub fn new(structure: &'a Structure, rules: Rules, limits: Limits) -> Skeleton<'a> {
        let mut of_link = vec![Vec::new(); structure.chain.links()];
        for (i, &(u, v)) in rules.pins.iter().enumerate() {
            of_link[u].push(i);
            of_link[v].push(i);
        }
        let tips: Vec<Point> = structure
            .tips(&limits.task)
            .iter()
            .map(|t| t.real())
            .collect();
        let centre = middle(&tips);
        let r = &structure.roles;
        for (n, &jaw) in r.jaws.iter().enumerate() {
            of_link[jaw].push(rules.pins.len() + n);
        }
        let rods = of_link.iter().enumerate().filter_map(|(l, points)| {
            let [a, b] = points[..] else { return None };
            let pulls = l != r.frame && l != r.driver;
            pulls.then_some((l, [a, b]))
        });
        let inward: Vec<Point> = tips.iter().map(|t| unit(sub(centre, *t))).collect();
        let contours = Contours::new(structure);
        Skeleton {
            structure,
            rods: rods.collect(),
            members: of_link
                .iter()
                .map(|points| points.iter().fold(0, |bits, p| bits | 1 << p))
                .collect(),
            of_link,
            tips,
            closure: Closure::new(&contours, &inward),
            inward,
            contours,
            limits,
            rules,
        }
    }
}
