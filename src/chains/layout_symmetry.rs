//! Whether a structure moves as a gripper when it is laid out symmetrically.
//!
//! A symmetric graph is not enough: with pins in places that mirror each other the motion is often another, or the drive is
//! dead. Places are drawn at random in a prime field, so that a motion found missing may be missing by accident with a
//! chance of some 10^-17, and one found free is free for nearly all places.

use crate::chains::roles::{Roles, Subject};
use crate::linalg::echelon::relations;
use crate::linalg::modp::{Field, Residue};
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};

/// How a structure lies on itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Symmetry {
    /// Across a line, along which the driver slides.
    Mirror,
    /// By half a turn about a centre, about which the driver turns.
    HalfTurn,
}

/// 2^61 - 1.
const PRIME: u64 = (1 << 61) - 1;

/// Pins in places that a symmetry carries to each other, by links.
fn pins(
    subject: &Subject<'_>,
    swap: &[usize],
    symmetry: Symmetry,
    field: Field,
) -> Vec<((usize, usize), [Residue; 2])> {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let joints = subject.chain.joints();
    let mut places: Vec<Option<[Residue; 2]>> = vec![None; joints.len()];
    for (i, &(u, v)) in joints.iter().enumerate() {
        if places[i].is_some() {
            continue;
        }
        let image = (swap[u].min(swap[v]), swap[u].max(swap[v]));
        let other = joints.iter().position(|&j| j == image).unwrap_or(i);
        let mut draw = || field.from_i64((random.next_u64() >> 4).cast_signed());
        let (x, y) = (draw(), draw());
        let [own, far] = match symmetry {
            Symmetry::Mirror if other == i => [[x, field.zero()]; 2],
            Symmetry::Mirror => [[x, y], [x, field.neg(y)]],
            Symmetry::HalfTurn if other == i => [[field.zero(); 2]; 2],
            Symmetry::HalfTurn => [[x, y], [field.neg(x), field.neg(y)]],
        };
        (places[i], places[other]) = (Some(own), Some(far));
    }
    let placed = joints.into_iter().zip(places);
    placed
        .filter_map(|(joint, at)| Some((joint, at?)))
        .collect()
}

/// A velocity of each link: its turning, and the velocity of its point at the origin.
type Velocities = Vec<[Residue; 3]>;

/// The motions with the frame at rest, hinges at the pins, the input a slide along the line where it is one.
fn motions(
    roles: &Roles,
    links: usize,
    pins: &[((usize, usize), [Residue; 2])],
    symmetry: Symmetry,
    field: Field,
) -> Vec<Velocities> {
    let (zero, one) = (field.zero(), field.one());
    let mut columns = vec![Vec::new(); 3 * links];
    let mut row = |entries: &[(usize, Residue)]| {
        columns.iter_mut().for_each(|c| c.push(zero));
        for &(unknown, value) in entries {
            if let Some(last) = columns[unknown].last_mut() {
                *last = value;
            }
        }
    };
    let minus = |x| field.neg(x);
    for i in 0..3 {
        row(&[(3 * roles.frame + i, one)]);
    }
    for &((u, v), [x, y]) in pins {
        let input = [(u, v), (v, u)].contains(&(roles.frame, roles.driver));
        if input && symmetry == Symmetry::Mirror {
            row(&[(3 * roles.driver, one)]);
            row(&[(3 * roles.driver + 2, one)]);
            continue;
        }
        row(&[
            (3 * u, minus(y)),
            (3 * u + 1, one),
            (3 * v, y),
            (3 * v + 1, minus(one)),
        ]);
        row(&[
            (3 * u, x),
            (3 * u + 2, one),
            (3 * v, minus(x)),
            (3 * v + 2, minus(one)),
        ]);
    }
    let links = |m: Vec<Residue>| m.chunks(3).map(|c| [c[0], c[1], c[2]]).collect();
    relations(field, &columns).into_iter().map(links).collect()
}

/// Whether a gripper can be laid out so that it has one motion, in which the input moves, and the two jaws against each other.
///
/// # Complexity
/// An elimination of 3n columns for each automorphism that swaps the jaws.
#[must_use]
pub fn works(subject: &Subject<'_>, roles: &Roles, symmetry: Symmetry) -> bool {
    let field = Field::new(PRIME);
    let rest = [field.zero(); 3];
    subject.swaps(roles).any(|swap| {
        let pins = pins(subject, swap, symmetry, field);
        let found = motions(roles, subject.chain.links(), &pins, symmetry, field);
        let [motion] = &found[..] else {
            return false;
        };
        let [a, b] = [roles.jaws[0], roles.jaws[1]].map(|l| motion[l]);
        motion[roles.driver] != rest && a != rest && b != rest && a != b
    })
}
