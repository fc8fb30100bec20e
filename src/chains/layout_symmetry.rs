//! Whether a structure moves as a gripper when it is laid out, symmetrically or not.
//!
//! A symmetric graph is not enough: with pins in places that mirror each other the motion is often another, or the drive is
//! dead. Places are drawn at random in a prime field, so that a motion found missing may be missing by accident with a
//! chance of some 10^-17, and one found free is free for nearly all places.

use crate::chains::roles::{Roles, Subject};
use crate::linalg::echelon::relations;
use crate::linalg::modp::{Field, Residue};
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use itertools::Itertools;
use thiserror::Error;

/// How a structure lies on itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Symmetry {
    /// Not at all: every pin where it likes.
    Generic,
    /// Across a line, along which the driver slides.
    Mirror,
    /// By half a turn about a centre, about which the driver turns.
    HalfTurn,
    /// By a third of a turn about a centre, about which the driver turns: three jaws.
    Threefold,
}

impl Symmetry {
    /// Every symmetry with its word.
    pub const ALL: [(Symmetry, &'static str); 4] = [
        (Symmetry::Generic, "generic"),
        (Symmetry::Mirror, "mirror"),
        (Symmetry::HalfTurn, "half-turn"),
        (Symmetry::Threefold, "threefold"),
    ];

    /// The word used for it.
    #[must_use]
    pub fn name(self) -> &'static str {
        Symmetry::ALL[self as usize].1
    }

    /// Whether the input joint may move so: a mirror image needs a slide, half a turn or a third a hinge, since in the plane no
    /// slide is its own image then.
    #[must_use]
    pub fn suits(self, input: Input) -> bool {
        match self {
            Symmetry::Generic => true,
            Symmetry::Mirror => input == Input::Slide,
            Symmetry::HalfTurn | Symmetry::Threefold => input == Input::Turn,
        }
    }

    /// How many jaws it carries to each other, where it does.
    #[must_use]
    pub fn jaws(self) -> Option<usize> {
        match self {
            Symmetry::Generic => None,
            Symmetry::Mirror | Symmetry::HalfTurn => Some(2),
            Symmetry::Threefold => Some(3),
        }
    }
}

/// How the driver moves in the frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Input {
    /// It slides.
    Slide,
    /// It turns.
    Turn,
}

impl Input {
    /// Every input with its word.
    pub const ALL: [(Input, &'static str); 2] = [(Input::Slide, "slide"), (Input::Turn, "turn")];

    /// The word used for it.
    #[must_use]
    pub fn name(self) -> &'static str {
        Input::ALL[self as usize].1
    }
}

/// Why a structure is no gripper in nearly all places of a symmetry.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum NoGripper {
    /// No automorphism of the chain keeps frame and driver and carries the jaws to each other.
    #[error("nothing of the chain carries the jaws to each other")]
    Unsymmetric,
    /// More than one motion.
    #[error("{0} motions where there should be one")]
    Motions(usize),
    /// The drive cannot move.
    #[error("the drive cannot move")]
    DeadDrive,
    /// A jaw stands still.
    #[error("a jaw stands still")]
    DeadJaw,
    /// The jaws move as one body.
    #[error("the jaws do not move against each other")]
    Together,
}

/// 2^61 - 1.
const PRIME: u64 = (1 << 61) - 1;

/// Pins in places that a symmetry carries to each other, by links; `swap` is the identity where there is none. A third of a
/// turn is (x, y) to (-y, x - y): coordinates along two axes at 120°, which stretching the plane makes of square ones, and
/// motions of hinges are as many in a stretched plane.
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
        let mut draw = || field.from_i64((random.next_u64() >> 4).cast_signed());
        let (x, y) = (draw(), draw());
        let image = |(u, v): (usize, usize)| (swap[u].min(swap[v]), swap[u].max(swap[v]));
        let mut at = match symmetry {
            _ if image((u, v)) != (u, v) => [x, y],
            Symmetry::Generic => [x, y],
            Symmetry::Mirror => [x, field.zero()],
            Symmetry::HalfTurn | Symmetry::Threefold => [field.zero(); 2],
        };
        let mut joint = (u, v);
        while let Some(n) = joints.iter().position(|&j| j == joint)
            && places[n].is_none()
        {
            places[n] = Some(at);
            let [x, y] = at;
            at = match symmetry {
                Symmetry::Generic => [x, y],
                Symmetry::Mirror => [x, field.neg(y)],
                Symmetry::HalfTurn => [field.neg(x), field.neg(y)],
                Symmetry::Threefold => [field.neg(y), field.sub(x, y)],
            };
            joint = image(joint);
        }
    }
    let placed = joints.into_iter().zip(places);
    placed
        .filter_map(|(joint, at)| Some((joint, at?)))
        .collect()
}

/// A velocity of each link: its turning, and the velocity of its point at the origin.
type Velocities = Vec<[Residue; 3]>;

/// The motions with the frame at rest, hinges at the pins, the input a slide along x where it is one.
fn motions(
    roles: &Roles,
    links: usize,
    pins: &[((usize, usize), [Residue; 2])],
    slide: Input,
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
        if input && slide == Input::Slide {
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

/// Whether a gripper laid out so that `swap` is its symmetry has one motion, in which the input moves, and the jaws
/// against each other.
///
/// # Errors
/// What is wrong with it.
///
/// # Complexity
/// An elimination of 3n columns.
pub fn moves(
    subject: &Subject<'_>,
    roles: &Roles,
    (symmetry, input): (Symmetry, Input),
    swap: &[usize],
) -> Result<(), NoGripper> {
    let field = Field::new(PRIME);
    let rest = [field.zero(); 3];
    let pins = pins(subject, swap, symmetry, field);
    let found = motions(roles, subject.chain.links(), &pins, input, field);
    let [motion] = &found[..] else {
        return Err(NoGripper::Motions(found.len()));
    };
    let jaws = || roles.jaws.iter().map(|&l| motion[l]);
    if motion[roles.driver] == rest {
        Err(NoGripper::DeadDrive)
    } else if jaws().any(|j| j == rest) {
        Err(NoGripper::DeadJaw)
    } else if jaws().tuple_combinations().any(|(a, b)| a == b) {
        Err(NoGripper::Together)
    } else {
        Ok(())
    }
}

/// The automorphism by which a structure moves as a gripper: the first of those that carry the jaws to each other, or the
/// identity where no symmetry is asked for.
///
/// # Errors
/// What is wrong with the last of them.
///
/// # Complexity
/// As [`moves`] for each.
pub fn working_swap(
    subject: &Subject<'_>,
    roles: &Roles,
    of: (Symmetry, Input),
) -> Result<Vec<usize>, NoGripper> {
    let identity: Vec<usize> = (0..subject.chain.links()).collect();
    let Some(jaws) = of.0.jaws() else {
        return moves(subject, roles, of, &identity).map(|()| identity);
    };
    let mut why = NoGripper::Unsymmetric;
    if roles.jaws.len() != jaws {
        return Err(why);
    }
    for swap in subject.swaps(roles) {
        match moves(subject, roles, of, swap) {
            Ok(()) => return Ok(swap.clone()),
            Err(e) => why = e,
        }
    }
    Err(why)
}
