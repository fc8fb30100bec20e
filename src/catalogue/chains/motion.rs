//! The motions of a chain's links with its joints in nearly any places, symmetric or not.
//!
//! Places are drawn at random in a prime field. A motion that is not found may be missing by accident with a chance of some
//! 10^-17. One that is found exists for nearly all places.
//!
//! A hinge is two rows at a point. A slide means equal turns and no motion across a direction. A gear pair or a slot is one
//! row, a line of action. Two slots are two such rows, equivalent to two at the point where these lines meet.
//!
//! If a symmetry carries a joint to itself, its place is special. A hinge lies on the mirror line. A slide goes along it or
//! across, and a line of action lies on it or goes across. Gears are swapped, and their pitch point lies on it. Two slots are
//! never their own image.

use crate::chains::chain::{Chain, Joint, carry_links};
use crate::chains::{PairKind, Symmetry};
use crate::linalg::echelon::linear_relations;
use crate::linalg::modp::{Field, Residue};
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use itertools::Itertools;

/// 2^61 - 1.
const PRIME: u64 = (1 << 61) - 1;

/// A velocity of a link: its turning, and the velocity of its point at the origin.
pub type Velocity = [Residue; 3];

/// Constraints of a joint: rows of (turning, velocity of the point at the origin) of one link against the other.
#[derive(Debug, Clone, Copy)]
enum PairRows {
    Hinge([Residue; 2]),
    /// The direction across it.
    Slide([Residue; 2]),
    /// Moment, and direction of the line of action.
    Line([Residue; 3]),
}

struct Draw {
    field: Field,
    random: ChaCha8Rng,
}

impl Draw {
    fn new() -> Draw {
        Draw {
            field: Field::new(PRIME),
            random: ChaCha8Rng::seed_from_u64(1),
        }
    }

    fn draw_residue(&mut self) -> Residue {
        self.field
            .from_i64((self.random.next_u64() >> 4).cast_signed())
    }

    fn draw_place(&mut self, pair: PairKind) -> PairRows {
        match pair {
            // Two lines of action meet in a point.
            PairKind::Hinge | PairKind::TwoSlots => {
                PairRows::Hinge([self.draw_residue(), self.draw_residue()])
            }
            PairKind::Slide => PairRows::Slide([self.draw_residue(), self.draw_residue()]),
            PairKind::Gear | PairKind::Slot => PairRows::Line([
                self.draw_residue(),
                self.draw_residue(),
                self.draw_residue(),
            ]),
        }
    }

    /// Draws the place of a joint that is its own image. Returns `None` if it cannot be. `across` selects one of two ways.
    fn own_image(&mut self, joint: OwnImage, image: Symmetry, across: bool) -> Option<PairRows> {
        let (zero, one) = (self.field.zero(), self.field.one());
        let straight = [one, zero];
        let upright = [zero, one];
        Some(match (joint.pair, image) {
            (PairKind::Hinge, Symmetry::Mirror) => PairRows::Hinge([self.draw_residue(), zero]),
            (PairKind::Hinge, Symmetry::HalfTurn) => PairRows::Hinge([zero; 2]),
            (PairKind::Slide, Symmetry::Mirror) if across => PairRows::Slide(straight),
            (PairKind::Slide, Symmetry::Mirror) => PairRows::Slide(upright),
            (PairKind::Slide, Symmetry::HalfTurn) => {
                PairRows::Slide([self.draw_residue(), self.draw_residue()])
            }
            (PairKind::Slot, Symmetry::Mirror) if across => {
                PairRows::Line([self.draw_residue(), zero, one])
            }
            (PairKind::Slot, Symmetry::Mirror) => PairRows::Line([zero, one, zero]),
            (PairKind::Slot, Symmetry::HalfTurn) => {
                PairRows::Line([zero, self.draw_residue(), self.draw_residue()])
            }
            (PairKind::Gear, Symmetry::Mirror) if joint.swapped => {
                PairRows::Line([zero, one, zero])
            }
            (PairKind::Hinge, Symmetry::Threefold) => PairRows::Hinge([zero; 2]),
            (PairKind::Gear | PairKind::TwoSlots, _)
            | (_, Symmetry::Threefold | Symmetry::Generic) => return None,
        })
    }
}

/// A joint that a symmetry carries to itself.
#[derive(Debug, Clone, Copy)]
struct OwnImage {
    pair: PairKind,
    /// Whether its links change places.
    swapped: bool,
}

impl OwnImage {
    /// Returns true if it can lie in two ways.
    fn has_two_ways(self, image: Symmetry) -> bool {
        image == Symmetry::Mirror && matches!(self.pair, PairKind::Slide | PairKind::Slot)
    }
}

/// Returns the image of a direction.
fn turn_direction(field: Field, [x, y]: [Residue; 2], image: Symmetry) -> [Residue; 2] {
    match image {
        Symmetry::Generic => [x, y],
        Symmetry::Mirror => [x, field.neg(y)],
        Symmetry::HalfTurn => [field.neg(x), field.neg(y)],
        Symmetry::Threefold => [field.neg(y), field.sub(x, y)],
    }
}

fn image_of(field: Field, place: PairRows, image: Symmetry) -> PairRows {
    match place {
        PairRows::Hinge(at) => PairRows::Hinge(turn_direction(field, at, image)),
        PairRows::Slide(across) => PairRows::Slide(turn_direction(field, across, image)),
        PairRows::Line([m, x, y]) => {
            let mirrored = image == Symmetry::Mirror;
            let moment = if mirrored { field.neg(m) } else { m };
            let [x, y] = turn_direction(field, [x, y], image);
            PairRows::Line([moment, x, y])
        }
    }
}

/// Returns the motions with link 0 at rest and the joints in these places.
fn chain_motions(field: Field, chain: &Chain, places: &[(Joint, PairRows)]) -> Vec<Vec<Velocity>> {
    let (zero, one) = (field.zero(), field.one());
    let mut columns = vec![Vec::with_capacity(2 * places.len()); 3 * (chain.links() - 1)];
    let mut row = |[u, v]: [usize; 2], entries: [Residue; 3]| {
        columns.iter_mut().for_each(|c| c.push(zero));
        let mut set = |link: usize, entry: usize, value: Residue| {
            let column = (3 * link + entry).checked_sub(3);
            let last = column.and_then(|c| columns[c].last_mut());
            if let Some(last) = last {
                *last = value;
            }
        };
        for (i, value) in entries.into_iter().enumerate() {
            set(u, i, value);
            set(v, i, field.neg(value));
        }
    };
    for (joint, place) in places {
        match *place {
            PairRows::Hinge([x, y]) => {
                row(joint.links, [field.neg(y), one, zero]);
                row(joint.links, [x, zero, one]);
            }
            PairRows::Slide([x, y]) => {
                row(joint.links, [one, zero, zero]);
                row(joint.links, [zero, x, y]);
            }
            PairRows::Line(line) => row(joint.links, line),
        }
    }
    let links = |m: Vec<Residue>| {
        let rest = [[zero; 3]];
        let moving = m.chunks(3).map(|c| [c[0], c[1], c[2]]);
        rest.into_iter().chain(moving).collect()
    };
    linear_relations(field, &columns)
        .into_iter()
        .map(links)
        .collect()
}

/// Returns the motion of a chain in nearly all places, with link 0 at rest. `None` if there is no motion, or more than one.
///
/// # Complexity
/// An elimination of 3n columns for n links.
#[must_use]
pub fn single_motion(chain: &Chain) -> Option<Vec<Velocity>> {
    let mut draw = Draw::new();
    let joints = chain.joints().into_iter();
    let places = joints.map(|j| (j, draw.draw_place(j.pair))).collect_vec();
    let mut found = chain_motions(draw.field, chain, &places);
    found.pop().filter(|_| found.is_empty())
}

/// Returns true if a chain has one motion in nearly all places, in which every two links move against each other.
///
/// # Complexity
/// As [`motion`].
///
/// # Examples
/// ```
/// use ozols::chains::{chain::Chain, motion::moves_throughout};
/// assert!(moves_throughout(&Chain::with_hinges(4, [(0, 1), (1, 2), (2, 3), (3, 0)])));
/// ```
#[must_use]
pub fn moves_throughout(chain: &Chain) -> bool {
    single_motion(chain).is_some_and(|m| m.iter().all_unique())
}

/// Returns the joints with places that the symmetry carries to each other. `across` has a bit for each joint that is its own
/// image in one of two ways. Returns `None` if a joint cannot be its own image.
fn symmetric_places(
    draw: &mut Draw,
    chain: &Chain,
    symmetry: &Swap<'_>,
    across: u32,
) -> Option<Vec<(Joint, PairRows)>> {
    let joints = chain.joints();
    let mut places: Vec<Option<PairRows>> = vec![None; joints.len()];
    let mut ways = 0;
    for (i, joint) in joints.iter().enumerate() {
        if places[i].is_some() {
            continue;
        }
        let own = symmetry.image_links(joint) == joint.links;
        let mut place = if own && symmetry.image != Symmetry::Generic {
            let own = symmetry.own_image(joint);
            let across = across >> ways & 1 == 1;
            ways += u32::from(own.has_two_ways(symmetry.image));
            draw.own_image(own, symmetry.image, across)?
        } else {
            draw.draw_place(joint.pair)
        };
        // Rows are of the lesser link against the greater; the sign of a row does not matter.
        let mut at = i;
        while places[at].is_none() {
            places[at] = Some(place);
            place = image_of(draw.field, place, symmetry.image);
            let image = symmetry.image_links(&joints[at]);
            at = joints.iter().position(|j| j.links == image)?;
        }
    }
    let placed = joints.into_iter().zip(places);
    placed.map(|(joint, place)| Some((joint, place?))).collect()
}

/// A symmetry: the images of the links, which return to themselves after two or three steps, and its kind.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Swap<'a> {
    /// Image of each link.
    pub links: &'a [usize],
    /// Kind of the symmetry, which maps the places.
    pub image: Symmetry,
}

impl Swap<'_> {
    fn image_links(&self, joint: &Joint) -> [usize; 2] {
        carry_links(joint.links, self.links)
    }

    fn own_image(&self, joint: &Joint) -> OwnImage {
        OwnImage {
            pair: joint.pair,
            swapped: self.links[joint.links[0]] != joint.links[0],
        }
    }

    /// Returns the image of a motion of links.
    fn carry_motion(&self, field: Field, motion: &[Velocity]) -> Vec<Velocity> {
        let mut out = vec![[field.zero(); 3]; motion.len()];
        for (link, &[turn, x, y]) in motion.iter().enumerate() {
            // The work of a line of action on a velocity is the same for their images.
            out[self.links[link]] = match self.image {
                Symmetry::Generic => [turn, x, y],
                Symmetry::Mirror => [field.neg(turn), x, field.neg(y)],
                Symmetry::HalfTurn => [turn, field.neg(x), field.neg(y)],
                Symmetry::Threefold => [turn, field.neg(field.add(x, y)), x],
            };
        }
        out
    }

    /// Returns the number of ways in which joints that are their own images may lie.
    fn way_count(&self, chain: &Chain) -> u32 {
        let two = |j: &Joint| {
            let own = self.image_links(j) == j.links;
            own && self.own_image(j).has_two_ways(self.image)
        };
        let joints = chain.joints();
        1 << joints.into_iter().filter(two).count()
    }
}

/// Returns the motions of a chain laid out symmetrically, with `frame` at rest. `way` selects how joints that are their own
/// images lie; in way 0 slides go along the mirror line. Empty if a joint cannot be its own image.
///
/// # Complexity
/// An elimination of 3n columns for n links.
#[must_use]
pub(crate) fn motions_in_way(
    chain: &Chain,
    symmetry: Swap<'_>,
    frame: usize,
    way: u32,
) -> Vec<Vec<Velocity>> {
    let mut draw = Draw::new();
    let field = draw.field;
    let Some(places) = symmetric_places(&mut draw, chain, &symmetry, way) else {
        return Vec::new();
    };
    let against = |motion: Vec<Velocity>| {
        let rest = motion[frame];
        let links = motion.iter();
        links
            .map(|v| [0, 1, 2].map(|i| field.sub(v[i], rest[i])))
            .collect()
    };
    let found = chain_motions(field, chain, &places);
    found.into_iter().map(against).collect()
}

/// A way in which joints that are their own images may lie, and the motion of the chain then.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SymmetricWay {
    /// A bit for each slide and slot that is its own mirror image, in the order of the joints: 1 for a slide across the line, or a
    /// line of action across it.
    pub bits: u32,
    /// The motion, the frame at rest.
    pub motion: Vec<Velocity>,
}

/// Returns the ways in which a chain laid out symmetrically has one motion that is its own image. The symmetry carries `frame`,
/// which is at rest, to itself.
///
/// # Complexity
/// An elimination of 3n columns for each way.
#[must_use]
pub(crate) fn symmetric_ways(chain: &Chain, symmetry: Swap<'_>, frame: usize) -> Vec<SymmetricWay> {
    let field = Field::new(PRIME);
    let ways = 0..symmetry.way_count(chain);
    let all = ways.map(|way| (way, motions_in_way(chain, symmetry, frame, way)));
    let one = all.filter_map(|(bits, mut found)| {
        let motion = found.pop().filter(|_| found.is_empty())?;
        Some(SymmetricWay { bits, motion })
    });
    one.filter(|w| symmetry.carry_motion(field, &w.motion) == w.motion)
        .collect()
}

/// Returns the motions of [`symmetric_ways`].
///
/// # Complexity
/// As there.
#[must_use]
pub(crate) fn symmetric_motions(
    chain: &Chain,
    symmetry: Swap<'_>,
    frame: usize,
) -> Vec<Vec<Velocity>> {
    let ways = symmetric_ways(chain, symmetry, frame).into_iter();
    ways.map(|w| w.motion).collect()
}
