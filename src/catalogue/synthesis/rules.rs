//! Rules for the places of a gripper's joints: places are free, or follow from others.

use crate::chains::chain::{Chain, Joint, carry_links, order_links};
use crate::chains::{Input, PairKind, Symmetry};
use crate::geom::vector::{add_scaled, sub};
use crate::synthesis::place::direction::WholeDirection;
use crate::synthesis::place::{Place, Point, third};
use crate::synthesis::places::{Places, Teeth};
use crate::synthesis::structure::{Lay, Structure};
use itertools::Itertools;
use thiserror::Error;

/// The rule for the place of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rule {
    /// The place is free.
    Free,
    /// It is its own image; a slide or a slot on a mirror line then has this direction.
    Own(Option<WholeDirection>),
    /// On the middle: a joint on one pin with its image, or the slide of a structure whose other joints are hinges.
    OnLine,
    /// The image of another joint.
    Image {
        /// The other.
        of: usize,
        /// The number of times that the symmetry is applied: once, or twice for thirds of a turn.
        times: u8,
    },
    /// The fourth corner of a parallelogram: from the first joint to the second as from the third to this one.
    Parallelogram([usize; 3]),
}

/// A gear pair with the link that carries it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Mesh {
    /// The link that keeps the gears at their distance.
    pub carrier: usize,
    /// The gears; the rack second.
    pub gears: [usize; 2],
    /// The joints by which the carrier holds them.
    pub held: [usize; 2],
    /// Whether the second slides: a rack.
    pub rack: bool,
}

impl Mesh {
    fn carried(self, swap: &[usize], joints: &[Joint]) -> Option<Mesh> {
        let at = |i: usize| {
            let links = carry_links(joints[i].links, swap);
            joints.iter().position(|j| j.links == links)
        };
        let [a, b] = self.held.map(at);
        Some(Mesh {
            carrier: swap[self.carrier],
            gears: self.gears.map(|l| swap[l]),
            held: [a?, b?],
            rack: self.rack,
        })
    }
}

/// Why a structure has no rules for its places.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum NoRules {
    /// A slot between links that change places.
    #[error(
        "a pin in a slot, or a flat face, between links that change places is not its own image as it moves"
    )]
    SwappedSlot,
    /// A slot that half a turn maps to itself.
    #[error("a pin at the centre of half a turn moves in no slot")]
    CentralSlot,
    /// Gears that change places, on a carrier that changes places, too.
    #[error("gears that change places need a carrier that does not")]
    SwappedCarrier,
    /// The parallelograms of the jaws are not compatible with the symmetry.
    #[error("the parallelograms do not go with the symmetry")]
    Parallelograms,
    /// A joint should be on one pin with its image, but the symmetry keeps none of its links.
    #[error("joints that are not images of each other are to be on one pin")]
    OnePin,
    /// The structure does not move in any way in which the symmetry may map it to itself.
    #[error("in no symmetric places do its jaws move against each other")]
    Still,
}

/// The joints of a structure, each with its rule.
#[derive(Debug, Clone)]
pub struct Rules {
    /// The joints.
    pub joints: Vec<Joint>,
    /// Their rules.
    pub rules: Vec<Rule>,
    /// The gear pairs among them.
    pub meshes: Vec<Option<Mesh>>,
    /// The link of each slide that has the block: the driver, or the link that is not the frame. The other link has the guide.
    pub blocks: Vec<usize>,
    /// Joints in an order in which each comes after those that it follows from.
    order: Vec<usize>,
    /// The image of each link under the symmetry.
    swap: Vec<usize>,
    symmetry: Symmetry,
    /// Whether pinions are screws, and racks nuts.
    pub threaded: bool,
    /// Whether all joints except for the input are hinges.
    hinges: bool,
}

impl Rules {
    /// Returns the rules of a structure whose symmetry maps its links by `lay`.
    ///
    /// # Errors
    /// Returns an error if the structure cannot be laid out in this way.
    pub fn new(structure: &Structure, lay: &Lay) -> Result<Rules, NoRules> {
        let (chain, symmetry) = (&structure.structure.chain, structure.form.symmetry);
        let joints = chain.joints_made();
        let mut rules = vec![Rule::Free; joints.len()];
        let mut meshes: Vec<Option<Mesh>> = vec![None; joints.len()];
        let mut ways = 0;
        for (i, joint) in joints.iter().enumerate() {
            if rules[i] != Rule::Free {
                continue;
            }
            let links = carry_links(joint.links, &lay.swap);
            let own = links == joint.links && symmetry != Symmetry::Generic;
            let swapped = own && lay.swap[joint.links[0]] != joint.links[0];
            meshes[i] = gear_mesh(chain, &joints, joint, |c| !swapped || lay.swap[c] == c);
            if joint.pair == PairKind::Gear && meshes[i].is_none() {
                return Err(NoRules::SwappedCarrier);
            }
            if symmetry == Symmetry::Generic {
                continue;
            }
            if !own {
                let (mut at, mut times) = (i, 0);
                loop {
                    let links = carry_links(joints[at].links, &lay.swap);
                    let image = image_of(&joints, at, links).ok_or(NoRules::Still)?;
                    if image == i {
                        break;
                    }
                    times += 1;
                    rules[image] = Rule::Image { of: i, times };
                    meshes[image] = meshes[at].and_then(|m| m.carried(&lay.swap, &joints));
                    at = image;
                }
                continue;
            }
            let mut along = None;
            if has_two_ways(joint.pair, swapped, symmetry)? {
                // If the bit is set, the line of action of a slot is across, so that the slot is along the mirror line; a slide is across.
                let across = lay.bits >> ways & 1 == 1;
                ways += 1;
                along = Some(if across == (joint.pair == PairKind::Slot) {
                    WholeDirection::AHEAD
                } else {
                    WholeDirection::ACROSS
                });
            }
            rules[i] = Rule::Own(along);
        }
        let input = joints
            .iter()
            .position(|j| j.links == structure.structure.roles.input);
        if let Some(input) =
            input.filter(|_| structure.form.hinges && structure.drive_input() == Input::Slide)
        {
            rules[input] = Rule::OnLine;
        }
        on_one_pin(structure, lay, &joints, &mut rules)?;
        if structure.form.parallel {
            let rings = structure
                .parallelogram_rings()
                .ok_or(NoRules::Parallelograms)?;
            parallelograms(&rings, &joints, &mut rules).ok_or(NoRules::Parallelograms)?;
        }
        let order = in_order(&rules).ok_or(NoRules::Parallelograms)?;
        Ok(Rules {
            blocks: block_links(structure, lay, &joints, &rules),
            joints,
            rules,
            meshes,
            order,
            swap: lay.swap.clone(),
            symmetry,
            threaded: structure.form.threaded,
            hinges: structure.form.hinges,
        })
    }

    /// Returns the joints that may be placed. The image of a joint follows it.
    pub(in crate::synthesis) fn movable_joints(&self) -> impl Iterator<Item = usize> + '_ {
        let fixed = |i: usize| {
            let own = matches!(self.rules[i], Rule::Own(_));
            let central = own && self.symmetry != Symmetry::Mirror;
            own && self.joints[i].pair == PairKind::Gear
                || central && self.joints[i].pair == PairKind::Hinge
        };
        let follows = |i: usize| {
            let rule = self.rules[i];
            matches!(rule, Rule::Image { .. } | Rule::Parallelogram(_))
        };
        (0..self.joints.len()).filter(move |&i| !follows(i) && !fixed(i))
    }

    /// Returns the pairs of a joint and its image.
    pub fn image_pairs(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let rules = self.rules.iter().enumerate();
        rules.filter_map(|(i, rule)| match rule {
            Rule::Image { of, .. } => Some((*of, i)),
            _ => None,
        })
    }

    /// Returns the image of a point.
    #[must_use]
    pub fn image_point(&self, [x, y]: Point) -> Point {
        match self.symmetry {
            Symmetry::Generic => [x, y],
            Symmetry::Mirror => [x, -y],
            Symmetry::HalfTurn => [-x, -y],
            Symmetry::Threefold => third([x, y]),
        }
    }

    /// Returns the exact place of a joint.
    #[must_use]
    pub fn exact_place(&self, points: &[Point], joint: usize) -> Place {
        match self.rules[joint] {
            Rule::Image { of, times } if self.symmetry == Symmetry::Threefold => Place {
                thirds: times,
                ..Place::of_point(points[of])
            },
            _ if self.hinges => Place::of_point(points[joint]),
            // Pitch points are not whole, but the file has no joint at them.
            _ => Place::of_point(points[joint].map(f64::round)),
        }
    }

    fn turned(&self, direction: WholeDirection) -> WholeDirection {
        match self.symmetry {
            Symmetry::Generic => direction,
            Symmetry::Mirror => direction.mirror_x(),
            Symmetry::HalfTurn => direction.reverse_direction(),
            Symmetry::Threefold => direction.turned_by_thirds(1),
        }
    }

    /// Moves the joints whose places follow from others.
    pub fn settle_joints(&self, at: &mut Places) {
        for &i in &self.order {
            match self.rules[i] {
                Rule::Free => {}
                Rule::OnLine => at.points[i][1] = 0.0,
                Rule::Parallelogram([a, b, c]) => {
                    let side = sub(at.points[b], at.points[a]);
                    at.points[i] = add_scaled(at.points[c], 1.0, side);
                }
                Rule::Own(along) => {
                    let [x, _] = at.points[i];
                    at.points[i] = match self.symmetry {
                        Symmetry::HalfTurn | Symmetry::Threefold => [0.0, 0.0],
                        _ => [x, 0.0],
                    };
                    at.along[i] = along.unwrap_or(at.along[i]);
                    if self.joints[i].pair == PairKind::Gear {
                        at.teeth[i] = Teeth::Gears([1, 1]);
                    }
                }
                Rule::Image { of, times } => {
                    let times = 0..times;
                    at.points[i] = times
                        .clone()
                        .fold(at.points[of], |p, _| self.image_point(p));
                    at.along[i] = times.clone().fold(at.along[of], |d, _| self.turned(d));
                    at.pinned[i] = times.fold(at.pinned[of], |l, _| self.swap[l]);
                }
            }
        }
        if self.meshes.iter().all(Option::is_none) {
            return;
        }
        // Teeth follow from the guides of racks.
        for (of, i) in self.image_pairs() {
            at.teeth[i] = self.image_of_teeth(at, of, i);
        }
        for i in 0..self.joints.len() {
            if let Some(pitch) = self.pitch_point(at, i) {
                at.points[i] = pitch;
            }
        }
    }

    fn image_of_teeth(&self, at: &Places, of: usize, image: usize) -> Teeth {
        let held = |i: usize| self.meshes[i].map(|m| at.along[m.held[1]]);
        match (at.teeth[of], held(of), held(image)) {
            (Teeth::Rack(diameter), Some(along), Some(there)) => {
                // A mirror image turns the other way; a guide that is its own image may go the other way.
                let turns = self.symmetry != Symmetry::HalfTurn;
                let goes = self.turned(along) != there;
                Teeth::Rack(if turns == goes { diameter } else { -diameter })
            }
            (teeth, ..) => teeth,
        }
    }

    /// Returns the contact point of the pitch circles of a gear pair.
    fn pitch_point(&self, at: &Places, i: usize) -> Option<Point> {
        let mesh = self.meshes[i]?;
        let centres = mesh.held.map(|j| at.points[j]);
        let along = at.along[mesh.held[1]].real();
        Some(at.teeth[i].pitch_point(centres, along))
    }
}

/// Returns whether a joint that is its own image may lie in two ways.
fn has_two_ways(pair: PairKind, swapped: bool, symmetry: Symmetry) -> Result<bool, NoRules> {
    match (pair, symmetry) {
        (PairKind::Slot, _) if swapped => Err(NoRules::SwappedSlot),
        (PairKind::Slot, Symmetry::HalfTurn) => Err(NoRules::CentralSlot),
        (PairKind::Slot | PairKind::Slide, Symmetry::Mirror) => Ok(true),
        _ => Ok(false),
    }
}

/// Returns the joint between other links that is the image of a joint. The first of two slots is the image of the first.
fn image_of(joints: &[Joint], joint: usize, links: [usize; 2]) -> Option<usize> {
    let own = |j: &&Joint| j.links == joints[joint].links;
    let before = joints[..joint].iter().filter(own).count();
    joints.iter().positions(|j| j.links == links).nth(before)
}

/// Returns the link with the block of each slide, and the second link of each other joint. The block of an image is the image of the block.
fn block_links(structure: &Structure, lay: &Lay, joints: &[Joint], rules: &[Rule]) -> Vec<usize> {
    let drive = structure.structure.roles.drive_links();
    let frame = structure.structure.roles.frame;
    let first = |joint: &Joint| match joint.links {
        links if links == order_links(drive) => drive[1],
        [u, _] if structure.form.hinges => u,
        [u, v] if v == frame => u,
        [_, v] => v,
    };
    let of = |(i, rule): (usize, &Rule)| match rule {
        Rule::Image { of, times } if !structure.form.hinges => {
            (0..*times).fold(first(&joints[*of]), |l, _| lay.swap[l])
        }
        _ => first(&joints[i]),
    };
    rules.iter().enumerate().map(of).collect()
}

/// Puts hinges on one pin with their images, if the form asks for it.
fn on_one_pin(
    structure: &Structure,
    lay: &Lay,
    joints: &[Joint],
    rules: &mut [Rule],
) -> Result<(), NoRules> {
    for (i, joint) in joints.iter().enumerate() {
        if structure.form.is_on_one_pin(i) {
            if !lay.may_share(joint) || !rules.contains(&Rule::Image { of: i, times: 1 }) {
                return Err(NoRules::OnePin);
            }
            rules[i] = Rule::OnLine;
        }
    }
    Ok(())
}

/// Lets one corner of each parallelogram follow from the others. If a corner is an image, the parallelogram follows already. `None` if no
/// corner can follow.
fn parallelograms(rings: &[[[usize; 2]; 4]], joints: &[Joint], rules: &mut [Rule]) -> Option<()> {
    let at = |links: [usize; 2]| joints.iter().position(|j| j.links == links);
    for ring in rings {
        let corners = ring.map(at);
        let [a, b, c, d] = [corners[0]?, corners[1]?, corners[2]?, corners[3]?];
        let turned = [[a, b, c, d], [b, a, d, c], [c, d, a, b], [d, c, b, a]];
        let free = turned.iter().find(|k| rules[k[3]] == Rule::Free);
        let image = |i: usize| matches!(rules[i], Rule::Image { .. });
        match free {
            Some(&[a, b, c, d]) => rules[d] = Rule::Parallelogram([a, b, c]),
            None if [a, b, c, d].into_iter().any(image) => {}
            None => return None,
        }
    }
    Some(())
}

/// Returns the joints in an order in which each comes after those that it follows from; `None` if joints follow from each other.
fn in_order(rules: &[Rule]) -> Option<Vec<usize>> {
    let mut order: Vec<usize> = Vec::new();
    while order.len() < rules.len() {
        let done = |i: &usize| order.contains(i);
        let ready = |&i: &usize| {
            !done(&i)
                && match &rules[i] {
                    Rule::Image { of, .. } => done(of),
                    Rule::Parallelogram(of) => of.iter().all(done),
                    Rule::Free | Rule::OnLine | Rule::Own(_) => true,
                }
        };
        order.push((0..rules.len()).find(ready)?);
    }
    Some(order)
}

/// Returns a gear pair with its carrier: the first allowed link that is hinged to both gears, or otherwise the first on which one slides.
fn gear_mesh(
    chain: &Chain,
    joints: &[Joint],
    joint: &Joint,
    allowed: impl Fn(usize) -> bool,
) -> Option<Mesh> {
    if joint.pair != PairKind::Gear {
        return None;
    }
    let held = |carrier: usize, gear: usize| {
        let links = order_links([carrier, gear]);
        joints.iter().position(|j| j.links == links)
    };
    let [u, v] = joint.links;
    let slides = |c: usize, gear: usize| chain.pair_between(c, gear) == Some(PairKind::Slide);
    let hinges = |c: usize, gear: usize| chain.pair_between(c, gear) == Some(PairKind::Hinge);
    let of = |carrier: usize| {
        let gears = match (carrier, [u, v]) {
            (c, [u, v]) if hinges(c, u) && hinges(c, v) => [u, v],
            (c, [u, v]) if hinges(c, u) && slides(c, v) => [u, v],
            (c, [u, v]) if slides(c, u) && hinges(c, v) => [v, u],
            _ => return None,
        };
        let rack = slides(carrier, gears[1]);
        let [a, b] = gears.map(|gear| held(carrier, gear));
        Some(Mesh {
            carrier,
            gears,
            held: [a?, b?],
            rack,
        })
    };
    let found = (0..chain.links()).filter(|&c| allowed(c)).filter_map(of);
    found.sorted_by_key(|m| m.rack).next()
}
