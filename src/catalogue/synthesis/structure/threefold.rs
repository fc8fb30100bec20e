//! Grippers of three jaws with slides, gears and slots, whose sides are images of each other by thirds of a turn.
//!
//! They are made of grippers with two jaws: the links between frame and driver on one side are repeated three times. A side is connected to
//! the others only by frame and driver. So places, stroke and joint forces are those of one side of two.
//!
//! Sides of grippers with half-turn symmetry stay in their plane, and are turned about its normal, as in a scroll chuck. Mirror-symmetric
//! grippers are turned about the axis along which their driver slides, as in a wedge chuck. Each side is then in a separate plane through
//! the axis, and half a turn about the axis is the reflection.

use crate::chains::chain::{Chain, Joint, order_links};
use crate::chains::roles::Roles;
use crate::chains::structure::PairStructure;
use crate::chains::{PairKind, Symmetry};
use crate::synthesis::place::{Pivot, Point, third};
use crate::synthesis::rules::Rules;
use crate::synthesis::sketch::bones::Bones;
use crate::synthesis::structure::{Sides, Structure};
use petgraph::unionfind::UnionFind;

/// Number of sides.
pub(crate) const SIDES: usize = 3;

impl Sides {
    /// Finds the sides of a gripper of two jaws. `None` if its sides are joined to each other, or if one of them is driven. Also `None` for
    /// a mirror-symmetric gripper if a link without an image does more than slide along the middle.
    fn new(two: &Structure) -> Option<Sides> {
        let lay = two.symmetry_lays().into_iter().next()?;
        let swap = &lay.swap;
        let chain = &two.structure.chain;
        let own: Vec<usize> = (0..chain.links()).filter(|&l| swap[l] == l).collect();
        let slides_ahead = || {
            let joints = chain.joints().into_iter();
            let mut once = joints.filter(|j| j.links.iter().all(|l| own.contains(l)));
            lay.bits == 0 && once.all(|j| j.pair == PairKind::Slide)
        };
        let round = match two.form.symmetry {
            Symmetry::HalfTurn => true,
            Symmetry::Mirror => slides_ahead(),
            Symmetry::Generic | Symmetry::Threefold => false,
        };
        if !round || two.form.one_sided || two.form.one_pin != 0 {
            return None;
        }
        let mut parts = UnionFind::<usize>::new(chain.links());
        for joint in chain.joints() {
            let [u, v] = joint.links;
            if !own.contains(&u) && !own.contains(&v) {
                parts.union(u, v);
            }
        }
        let first = two.structure.roles.jaws[0];
        let mut side = Vec::new();
        for l in (0..chain.links()).filter(|l| !own.contains(l)) {
            let (here, there) = (parts.find(l), parts.find(swap[l]));
            if here == there {
                return None;
            }
            // If the symmetry exchanges two parts, take the part with the first jaw, or else the first part.
            let jaw = [here, there].iter().position(|&p| p == parts.find(first));
            let is_side = jaw.map_or(here < there, |at| at == 0);
            if is_side {
                side.push(l);
            }
        }
        Some(Sides { side, own, lay })
    }
}

impl Structure {
    /// Returns the gripper of three jaws that is made of this one of two, if there is one.
    #[must_use]
    pub fn three_jawed(self) -> Option<Structure> {
        let sides = Some(Sides::new(&self)?);
        Some(Structure { sides, ..self })
    }

    /// Returns whether the sides are in separate planes, around the axis along which the driver slides.
    #[must_use]
    pub fn is_axial(&self) -> bool {
        self.sides.is_some() && self.form.symmetry == Symmetry::Mirror
    }

    /// Returns the axis about which the sides are turned.
    pub(in crate::synthesis) fn turn_axis(&self) -> Pivot {
        if self.is_axial() {
            Pivot::Ahead
        } else {
            Pivot::Normal
        }
    }

    /// Returns the number of links.
    #[must_use]
    pub fn link_count(&self) -> usize {
        let all = self.structure.chain.links();
        (self.sides.as_ref()).map_or(all, |s| s.own.len() + SIDES * s.side.len())
    }

    /// Returns the number of a link on one of the sides, from its number on the first side.
    #[must_use]
    pub fn side_link(&self, of: usize, side: usize) -> Option<usize> {
        let Some(sides) = &self.sides else {
            return Some(of);
        };
        let at = |list: &[usize]| list.iter().position(|&l| l == of);
        let own = at(&sides.own);
        own.or_else(|| Some(sides.own.len() + side * sides.side.len() + at(&sides.side)?))
    }

    /// Returns the number of copies of a joint: one, three, or none if it is on the other side.
    #[must_use]
    pub fn copy_count(&self, joint: &Joint) -> usize {
        let Some(sides) = &self.sides else { return 1 };
        match joint.links.map(|l| sides.own.contains(&l)) {
            [true, true] => 1,
            _ if joint.links.iter().all(|l| self.side_link(*l, 0).is_some()) => SIDES,
            _ => 0,
        }
    }

    /// Returns chain and roles with all sides.
    #[must_use]
    pub fn whole_structure(&self) -> PairStructure {
        let PairStructure { chain, roles } = &self.structure;
        let joints = chain.joints().into_iter();
        let joints = joints.flat_map(|j| (0..self.copy_count(&j)).map(move |side| (j, side)));
        let carried = |links: [usize; 2], side| {
            let [u, v] = links.map(|l| self.side_link(l, side));
            Some(order_links([u?, v?]))
        };
        let joints = joints.filter_map(|(j, side)| {
            Some(Joint {
                links: carried(j.links, side)?,
                pair: j.pair,
            })
        });
        let of_side = |side| self.side_link(roles.jaws[0], side);
        PairStructure {
            chain: Chain::new(self.link_count(), joints),
            roles: Roles {
                frame: self.side_link(roles.frame, 0).unwrap_or(0),
                input: carried(roles.input, 0).unwrap_or_default(),
                jaws: match self.sides {
                    Some(_) => (0..SIDES).filter_map(of_side).collect(),
                    None => roles.jaws.clone(),
                },
            },
        }
    }
}

/// All three sides as drawn.
#[derive(Debug, Clone)]
pub(in crate::synthesis) struct Around {
    pub(in crate::synthesis) bones: Bones,
    /// For each point, the point of two sides that it is made of, and its number of turns by 120°.
    made: Vec<(usize, usize)>,
    /// For each point of two sides, its number of copies.
    copies: Vec<usize>,
}

impl Around {
    pub(in crate::synthesis) fn new(structure: &Structure, rules: &Rules, two: &Bones) -> Around {
        let mut made = Vec::new();
        let mut joints = Vec::new();
        let mut copies: Vec<usize> = rules
            .joints
            .iter()
            .map(|j| structure.copy_count(j))
            .collect();
        for (i, joint) in rules.joints.iter().enumerate() {
            for side in 0..copies[i] {
                made.push((i, side));
                let [u, v] = joint.links.map(|l| structure.side_link(l, side));
                joints.push(two.joints[i].and_then(|_| Some([u?, v?])));
            }
        }
        let tip = rules.joints.len();
        made.extend((0..SIDES).map(|side| (tip, side)));
        copies.extend([SIDES, 0]);
        let jaws = structure.whole_structure().roles.jaws;
        let turned = |side: usize| (0..side).fold(two.tips[0], |p, _| third(p));
        let pushes = |l: usize| {
            two.rods
                .iter()
                .any(|r| structure.side_link(r.0, 0) == Some(l))
        };
        let bones = Bones {
            frame: structure.side_link(two.frame, 0).unwrap_or(0),
            driver: structure.side_link(two.driver, 0).unwrap_or(0),
            jaws,
            follows: vec![true; joints.len()],
            joints,
            tips: (0..SIDES).map(turned).collect(),
            turns: two.turns,
            hinged: vec![two.hinged[0]; SIDES],
            round: two.round,
            wished: two.wished,
            ..Bones::default()
        };
        Around {
            bones: bones.joined(structure.link_count(), &[], None, pushes),
            made,
            copies,
        }
    }

    /// Returns the places of all points.
    pub(in crate::synthesis) fn all_points(&self, two: &[Point]) -> Vec<Point> {
        let turned = |&(of, side): &(usize, usize)| (0..side).fold(two[of], |p, _| third(p));
        self.made.iter().map(turned).collect()
    }

    /// Calls `take` with every place of a point of two sides.
    pub(in crate::synthesis) fn each_place(
        &self,
        point: usize,
        at: Point,
        take: &mut dyn FnMut(Point),
    ) {
        let mut now = at;
        for _ in 0..self.copies[point] {
            take(now);
            now = third(now);
        }
    }
}
