//! A place for every pin, found by simulated annealing from seeds that follow from the structure's name.
//!
//! Moves go to whole millimetres, so that what is found is exact as it stands. [Kirkpatrick, Gelatt & Vecchi 1983]

use crate::chains::layout_symmetry::{NoGripper, working_swap};
use crate::chains::roles::Subject;
use crate::closure::tree::forest;
use crate::geom::vector::add_scaled;
use crate::synthesis::layout_quality::{Limits, Looks};
use crate::synthesis::place::Place;
use crate::synthesis::rules::{Rule, Rules};
use crate::synthesis::skeleton::{Point, Skeleton, middle};
use crate::synthesis::structure::Structure;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use sha2::{Digest, Sha256};
use thiserror::Error;

/// Starts of the search for places at most.
const STARTS: u32 = 6;
/// Moves tried from a start.
const MOVES: usize = 1500;
/// Of these, the last in which velocities count.
const MOVING: usize = 700;
/// A layout that costs less than this is taken without looking for a better one.
const GOOD: f64 = 3.0;

/// A structure with a place for every joint.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// The links of each pin, by canonical numbers; the input joint is among them.
    pub pins: Vec<(usize, usize)>,
    /// Their places, in millimetres.
    pub at: Vec<Place>,
    /// Joints that are images of each other, by their places in the list.
    pub images: Vec<(usize, usize)>,
    /// Where the tips of the jaws are.
    pub tips: Vec<Place>,
    /// The figures it was taken for.
    pub looks: Looks,
    /// The start it was found from.
    pub start: u32,
}

impl Layout {
    /// The points of a link: its pins, and of a jaw its tip.
    #[must_use]
    pub fn points(&self, structure: &Structure, link: usize) -> Vec<Point> {
        let jaw = structure.roles.jaws.iter().position(|&j| j == link);
        let pins = self.pins.iter().zip(&self.at);
        pins.filter(|((u, v), _)| [*u, *v].contains(&link))
            .map(|(_, at)| at)
            .chain(jaw.map(|n| &self.tips[n]))
            .map(|p| p.real())
            .collect()
    }
}

/// Why a structure has no layout.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum NoLayout {
    /// In nearly all places it moves otherwise, or not at all.
    #[error("{0}")]
    Motion(#[from] NoGripper),
    /// The parallelograms of the jaws ask for what the symmetry does not give.
    #[error("the parallelograms do not go with the symmetry")]
    Parallelograms,
    /// The pose is not proven to be a regular one of mobility 1.
    #[error("the places found are not proven to leave one finite motion")]
    NotRegular,
    /// No places were found that keep the limits; those of the best are told.
    #[error(
        "no places found within the limits: the best have links of 1 : {ratio:.1}, a transmission angle of \
         {transmission:.0}°, {crossings} crossings, and {straightness:.0} % of the jaws' motion closes them"
    )]
    Limits {
        /// The longest link over the shortest.
        ratio: f64,
        /// The worst transmission angle.
        transmission: f64,
        /// Crossings.
        crossings: usize,
        /// Share of the jaws' motion that closes them, in per cent.
        straightness: f64,
    },
}

/// Lays a structure out; the same for the same seed.
///
/// # Errors
/// Why there is none.
///
/// # Complexity
/// Some thousand looks at places.
pub fn layout(
    subject: &Subject<'_>,
    structure: &Structure,
    limits: &Limits,
    seed: u64,
) -> Result<Layout, NoLayout> {
    let of = (structure.form.symmetry, structure.form.input);
    let swap = working_swap(subject, &structure.roles, of)?;
    let rules = Rules::new(structure, &swap).ok_or(NoLayout::Parallelograms)?;
    let skeleton = Skeleton::new(structure, rules);
    let rules = &skeleton.rules;
    let within = |l: &Looks| {
        l.ratio <= limits.ratio
            && l.transmission >= limits.transmission
            && l.crossings <= limits.crossings
            && l.straightness >= LEAST_CLOSING
    };
    let mut best: Option<(bool, Looks, Vec<Point>, u32)> = None;
    for start in 0..STARTS {
        let (at, found) = anneal(&skeleton, &mut random(structure, seed, start));
        let Some(found) = found else { continue };
        let better = best
            .as_ref()
            .is_none_or(|(ok, b, ..)| (!within(&found), found.penalty) < (!ok, b.penalty));
        if better {
            best = Some((within(&found), found, at, start));
        }
        if best
            .as_ref()
            .is_some_and(|(ok, b, ..)| *ok && b.penalty < GOOD)
        {
            break;
        }
    }
    let Some((ok, looks, at, start)) = best else {
        return Err(NoLayout::Motion(NoGripper::DeadDrive));
    };
    if !ok {
        return Err(NoLayout::Limits {
            ratio: looks.ratio,
            transmission: looks.transmission,
            crossings: looks.crossings,
            straightness: 100.0 * looks.straightness,
        });
    }
    Ok(Layout {
        pins: rules.pins.clone(),
        at: rules.places(&at),
        tips: structure.tips(),
        images: rules.images().collect(),
        looks,
        start,
    })
}

/// The tips' motion must close them by this share at least.
const LEAST_CLOSING: f64 = 0.35;

fn random(structure: &Structure, seed: u64, start: u32) -> ChaCha8Rng {
    let name = format!("{} {seed} {start}", structure.name());
    let digest = Sha256::digest(name);
    let mut key = [0; 32];
    key.copy_from_slice(&digest);
    ChaCha8Rng::from_seed(key)
}

/// From 0 to 1.
#[allow(clippy::cast_precision_loss, reason = "53 bits")]
fn unit(random: &mut ChaCha8Rng) -> f64 {
    (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

/// Roughly normal, of variance 1.
fn bell(random: &mut ChaCha8Rng) -> f64 {
    (0..12).map(|_| unit(random)).sum::<f64>() - 6.0
}

/// Links between frame and jaws as far ahead as they are joints away, each pin between its two links; the tips after them.
fn first_places(skeleton: &Skeleton<'_>, random: &mut ChaCha8Rng) -> Vec<Point> {
    let (structure, rules) = (skeleton.structure, &skeleton.rules);
    let c = &structure.chain;
    let joints: Vec<[usize; 2]> = rules.pins.iter().map(|&(u, v)| [u, v]).collect();
    // Joints on a shortest way from a link to each.
    let far = |from: usize| {
        let (_, steps) = forest(c.links(), joints.iter().copied(), |_| false, [from]);
        let mut away = vec![0.0_f64; c.links()];
        for s in steps {
            away[s.link] = away[s.from] + 1.0;
        }
        away
    };
    let frame = far(structure.roles.frame);
    let jaws: Vec<Vec<f64>> = structure.roles.jaws.iter().map(|&j| far(j)).collect();
    let ahead_most = middle(&skeleton.tips);
    let place = |l: usize| -> Point {
        let away = || jaws.iter().map(|j| j[l]);
        let near = away().fold(f64::INFINITY, f64::min);
        let ahead = frame[l] / (frame[l] + near).max(1.0);
        // The nearer jaws draw a link to their side.
        let all = away().sum::<f64>();
        #[allow(clippy::cast_precision_loss, reason = "two or three")]
        let mean = all / jaws.len() as f64;
        let start = [0.8 * ahead * ahead_most[0], ahead * ahead_most[1]];
        let sides = away().zip(&skeleton.inward);
        sides.fold(start, |place, (away, inward)| {
            add_scaled(place, 40.0 * (away - mean) / all.max(1.0), *inward)
        })
    };
    let mut at: Vec<Point> = Vec::with_capacity(rules.pins.len() + skeleton.tips.len());
    for &(u, v) in &rules.pins {
        let [x, y] = middle(&[place(u), place(v)]);
        at.push([x + 12.0 * bell(random), y + 12.0 * bell(random)].map(f64::round));
    }
    at.extend(&skeleton.tips);
    rules.settle(&mut at);
    at
}

/// The places at the end of one search, with the tips after the pins, and what they are like.
fn anneal(skeleton: &Skeleton<'_>, random: &mut ChaCha8Rng) -> (Vec<Point>, Option<Looks>) {
    let rules = &skeleton.rules;
    let mut at = first_places(skeleton, random);
    let movable: Vec<usize> = rules.movable().collect();
    let (mut now, mut best) = (f64::INFINITY, (f64::INFINITY, at.clone()));
    let mut before = at.clone();
    for step in 0..MOVES {
        let moving = step + MOVING >= MOVES;
        if step + MOVING == MOVES {
            let cost = skeleton.penalty(&at, true, f64::INFINITY);
            now = cost.unwrap_or(f64::INFINITY);
            best = (now, at.clone());
        }
        #[allow(clippy::cast_precision_loss, reason = "a few thousand")]
        let left = 1.0 - step as f64 / MOVES as f64;
        let (heat, reach) = (2.0 * left * left, 2.0 + 18.0 * left);
        #[allow(clippy::cast_possible_truncation, reason = "the remainder is an index")]
        let pin = movable[(random.next_u64() % movable.len() as u64) as usize];
        before.copy_from_slice(&at);
        at[pin] = match rules.rules[pin] {
            Rule::OnLine => [at[pin][0] + reach * bell(random), 0.0],
            _ => [
                at[pin][0] + reach * bell(random),
                at[pin][1] + reach * bell(random),
            ],
        }
        .map(f64::round);
        rules.settle(&mut at);
        // Taken where exp((now - then) / heat) is above a random number: what is too dear is not looked at to the end.
        let most = now - heat * unit(random).ln();
        match skeleton.penalty(&at, moving, most) {
            Some(then) => {
                now = then;
                if moving && now < best.0 {
                    best = (now, at.clone());
                }
            }
            None => at.copy_from_slice(&before),
        }
    }
    let found = skeleton.looks(&best.1);
    (best.1, found)
}
