//! A place for every pin, found by simulated annealing from seeds that follow from the structure's name.
//!
//! Moves go to whole millimetres, so that what is found is exact as it stands. [Kirkpatrick, Gelatt & Vecchi 1983]

use crate::chains::layout_symmetry::{NoGripper, working_swap};
use crate::chains::roles::Subject;
use crate::closure::tree::forest;
use crate::geom::vector::add_scaled;
use crate::synthesis::layout_quality::Looks;
use crate::synthesis::limits::Limits;
use crate::synthesis::place::Place;
use crate::synthesis::point::{Point, middle};
use crate::synthesis::rules::{Rule, Rules};
use crate::synthesis::skeleton::Skeleton;
use crate::synthesis::stroke::judge::Judge;
use crate::synthesis::structure::Structure;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use sha2::{Digest, Sha256};
use thiserror::Error;

/// Starts of the search for places at most.
const STARTS: u32 = 6;
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
    /// What it was made for.
    pub limits: Limits,
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
/// Some thousand looks at places, of which some hundred are at a whole stroke.
pub fn layout(
    subject: &Subject<'_>,
    structure: &Structure,
    limits: &Limits,
    seed: u64,
) -> Result<Layout, NoLayout> {
    let of = (structure.form.symmetry, structure.form.input);
    let swap = working_swap(subject, &structure.roles, of)?;
    let rules = Rules::new(structure, &swap).ok_or(NoLayout::Parallelograms)?;
    let skeleton = Skeleton::new(structure, rules, *limits);
    let found = best_of_starts(&skeleton, seed);
    let found = found.ok_or(NoLayout::Motion(NoGripper::DeadDrive))?;
    let looks = found.looks;
    if !keeps(limits, &looks) {
        return Err(NoLayout::Limits {
            ratio: looks.ratio,
            transmission: looks.transmission,
            crossings: looks.crossings,
            straightness: 100.0 * looks.straightness,
        });
    }
    let rules = &skeleton.rules;
    Ok(Layout {
        pins: rules.pins.clone(),
        at: rules.places(&found.at),
        tips: structure.tips(&limits.task),
        limits: *limits,
        images: rules.images().collect(),
        looks,
        start: found.start,
    })
}

/// Places at the end of a start.
struct Found {
    /// Whether the drawn pose keeps the limits.
    within: bool,
    /// Whether the stroke does what the task asks.
    does: bool,
    looks: Looks,
    /// What drawn pose and stroke cost.
    cost: f64,
    at: Vec<Point>,
    start: u32,
}

impl Found {
    /// Limits first, then the task, then what all costs.
    fn order(&self) -> (bool, bool, f64) {
        (!self.within, !self.does, self.cost)
    }
}

/// The best places of some starts; of the first alone where those are good. `None` where all end in singular poses.
fn best_of_starts(skeleton: &Skeleton<'_>, seed: u64) -> Option<Found> {
    let mut judge = Judge::new(skeleton);
    let mut best: Option<Found> = None;
    for start in 0..STARTS {
        let at = anneal(
            skeleton,
            &mut judge,
            random(skeleton.structure, seed, start),
        );
        let (Some(looks), Some(stroke)) = (skeleton.looks(&at), judge.coarse(&at, f64::INFINITY))
        else {
            continue;
        };
        let found = Found {
            cost: looks.penalty + skeleton.stroke_cost(&stroke),
            does: skeleton.shortfall(&stroke).is_none(),
            within: keeps(&skeleton.limits, &looks),
            looks,
            at,
            start,
        };
        let good = found.within && found.does && found.cost < GOOD;
        if best.as_ref().is_none_or(|b| found.order() < b.order()) {
            best = Some(found);
        }
        if good {
            break;
        }
    }
    best
}

/// Whether a drawn pose keeps the limits.
pub(super) fn keeps(limits: &Limits, looks: &Looks) -> bool {
    looks.ratio <= limits.ratio
        && looks.transmission >= limits.transmission
        && looks.crossings <= limits.crossings
        && looks.straightness >= LEAST_CLOSING
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

/// What is looked at in a part of a search for places.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Look {
    Places,
    Motion,
    Stroke,
}

/// A part of a search: how many moves, and how warm it is at the beginning and at the end.
struct Phase {
    look: Look,
    moves: usize,
    warmth: [f64; 2],
}

/// Places alone, which is cheap; then the motion of the drawn pose, too; then the whole stroke, warmed up again a little.
const PHASES: [Phase; 3] = [
    Phase {
        look: Look::Places,
        moves: 800,
        warmth: [1.0, 0.47],
    },
    Phase {
        look: Look::Motion,
        moves: 700,
        warmth: [0.47, 0.0],
    },
    Phase {
        look: Look::Stroke,
        moves: 500,
        warmth: [0.4, 0.0],
    },
];

/// A search for places from one start.
struct Annealing<'a, 'j> {
    skeleton: &'a Skeleton<'a>,
    judge: &'j mut Judge<'a>,
    random: ChaCha8Rng,
    movable: Vec<usize>,
    /// The places, with the tips after the pins, what they cost, and those before the last move.
    at: Vec<Point>,
    now: f64,
    before: Vec<Point>,
    /// The cheapest of the phase.
    best: (f64, Vec<Point>),
}

impl<'a, 'j> Annealing<'a, 'j> {
    fn new(skeleton: &'a Skeleton<'a>, judge: &'j mut Judge<'a>, mut random: ChaCha8Rng) -> Self {
        let at = first_places(skeleton, &mut random);
        Annealing {
            movable: skeleton.rules.movable().collect(),
            before: at.clone(),
            best: (f64::INFINITY, at.clone()),
            now: f64::INFINITY,
            skeleton,
            judge,
            random,
            at,
        }
    }

    /// What the places cost; `None` where that is more than `most`, or the pose is singular.
    fn cost(&mut self, look: Look, most: f64) -> Option<f64> {
        let drawn = (self.skeleton).penalty(&self.at, look != Look::Places, most)?;
        if look != Look::Stroke {
            return Some(drawn);
        }
        let stroke = self.judge.coarse(&self.at, most - drawn)?;
        let all = drawn + self.skeleton.stroke_cost(&stroke);
        (all <= most).then_some(all)
    }

    /// Whether the places do what the task asks.
    fn does(&mut self) -> bool {
        let stroke = self.judge.coarse(&self.at, f64::INFINITY);
        stroke.is_some_and(|f| self.skeleton.shortfall(&f).is_none())
    }

    fn phase(&mut self, phase: &Phase) {
        // A stroke is judged from the best of what was drawn.
        if phase.look == Look::Stroke {
            self.at.copy_from_slice(&self.best.1);
        }
        self.now = self
            .cost(phase.look, f64::INFINITY)
            .unwrap_or(f64::INFINITY);
        self.best = (self.now, self.at.clone());
        if phase.look == Look::Stroke && self.now < GOOD && self.does() {
            return;
        }
        let [from, to] = phase.warmth;
        for step in 0..phase.moves {
            #[allow(clippy::cast_precision_loss, reason = "a few thousand")]
            let done = step as f64 / phase.moves as f64;
            self.step(phase.look, from + (to - from) * done);
        }
    }

    /// Tries another place for a pin.
    fn step(&mut self, look: Look, warmth: f64) {
        let (heat, reach) = (2.0 * warmth * warmth, 2.0 + 18.0 * warmth);
        let random = &mut self.random;
        #[allow(clippy::cast_possible_truncation, reason = "the remainder is an index")]
        let pin = self.movable[(random.next_u64() % self.movable.len() as u64) as usize];
        self.before.copy_from_slice(&self.at);
        let [x, y] = self.at[pin];
        self.at[pin] = match self.skeleton.rules.rules[pin] {
            Rule::OnLine => [x + reach * bell(random), 0.0],
            _ => [x + reach * bell(random), y + reach * bell(random)],
        }
        .map(f64::round);
        self.skeleton.rules.settle(&mut self.at);
        // Taken where exp((now - then) / heat) is above a random number: what is too dear is not looked at to the end.
        let most = self.now - heat * unit(&mut self.random).ln();
        match self.cost(look, most) {
            Some(then) => {
                self.now = then;
                if then < self.best.0 {
                    self.best.0 = then;
                    self.best.1.copy_from_slice(&self.at);
                }
            }
            None => self.at.copy_from_slice(&self.before),
        }
    }
}

/// The places at the end of one search, with the tips after the pins.
fn anneal<'a>(skeleton: &'a Skeleton<'a>, judge: &mut Judge<'a>, random: ChaCha8Rng) -> Vec<Point> {
    let mut search = Annealing::new(skeleton, judge, random);
    for phase in &PHASES {
        search.phase(phase);
    }
    search.best.1
}
