//! A place for every joint, found by simulated annealing. [Kirkpatrick, Gelatt & Vecchi 1983]

use crate::synthesis::layout_quality::Looks;
use crate::synthesis::places::Places;
use crate::synthesis::seen_sides::SeenSides;
use crate::synthesis::sketch::Sketch;
use crate::synthesis::stroke::judge::Judge;
use crate::synthesis::stroke::planes::Stacking;
use crate::synthesis::task::Aim;
use crate::synthesis::{random_below, random_for, random_unit};
use chacha20::ChaCha8Rng;
use std::cmp::Ordering;

/// Places at the end of a start.
pub(super) struct FoundPlaces {
    /// Whether the drawing keeps the limits, or links that cross pass each other in planes of their own.
    pub(super) within: bool,
    /// Whether the stroke does what the task asks.
    does: bool,
    /// Whether links meet in whatever planes.
    meets: bool,
    pub(super) looks: Looks,
    /// What drawn pose and stroke cost.
    pub(super) cost: f64,
    pub(super) at: Places,
    pub(super) start: u32,
    /// Whether the search was given up before its end.
    given_up: bool,
}

impl FoundPlaces {
    /// Whether they are worth no other start but for what they cost.
    fn will_do(&self) -> bool {
        self.within && self.does && !self.meets
    }

    /// Limits first, then the task, then whether it can be built, then what all costs.
    fn compare_places(&self, other: &FoundPlaces) -> Ordering {
        let misses = |of: &FoundPlaces| (!of.within, !of.does, of.meets);
        let cost = || self.cost.total_cmp(&other.cost);
        misses(self).cmp(&misses(other)).then_with(cost)
    }

    /// Whether no better ones need be looked for.
    pub(super) fn are_good(&self, sketch: &Sketch<'_>) -> bool {
        let enough = sketch.limits.task.aim == Aim::Balanced && self.cost < sketch.good_cost();
        self.will_do() && enough
    }

    /// Whether they are better than others, where there are any.
    pub(super) fn is_better_than(&self, best: Option<&FoundPlaces>) -> bool {
        best.is_none_or(|b| self.compare_places(b).is_lt())
    }
}

/// Starts of a search for places at most, for each way of lying.
pub(super) const STARTS: u32 = 12;
/// Of the starts none of which becomes good so many, the best, are taken to their ends; more where none of these keeps the limits of the
/// drawing.
const TO_THE_END: usize = 4;

/// The best places of some starts of a structure of this name, the first good ones being enough; `None` where all end in singular poses.
///
/// Starts that lag behind are given up. Where none becomes good, the best are taken to their ends until one does the task and can
/// be built.
pub(super) fn best_of_starts<'a>(
    sketch: &Sketch<'a>,
    judge: &mut Judge<'a>,
    name: &str,
    seed: u64,
    first: u32,
) -> Option<FoundPlaces> {
    let mut search = |start, patience| {
        let random = random_for(name, seed, start);
        search_from(sketch, judge, random, start, patience)
    };
    let patience = match sketch.limits.task.aim {
        Aim::Balanced => Patience::Racing,
        Aim::Force => Patience::Whole,
    };
    let mut raced = Vec::new();
    for found in (first..first + STARTS).filter_map(|start| search(start, patience)) {
        if found.are_good(sketch) {
            return Some(found);
        }
        raced.push(found);
    }
    raced.sort_by(FoundPlaces::compare_places);
    let mut best: Option<FoundPlaces> = None;
    for (n, found) in raced.into_iter().enumerate() {
        if n >= TO_THE_END && best.as_ref().is_some_and(|b| b.within) {
            break;
        }
        let start = found.start;
        let ended = Some(found).filter(|found| !found.given_up);
        let Some(found) = ended.or_else(|| search(start, Patience::Whole)) else {
            continue;
        };
        let will_do = found.will_do();
        if found.is_better_than(best.as_ref()) {
            best = Some(found);
        }
        if will_do {
            break;
        }
    }
    best
}

/// Whether starts that lag behind are given up.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Patience {
    Racing,
    Whole,
}

/// What a search for places from one start ends with; `None` where that is a singular pose.
fn search_from<'a>(
    sketch: &Sketch<'a>,
    judge: &mut Judge<'a>,
    random: ChaCha8Rng,
    start: u32,
    patience: Patience,
) -> Option<FoundPlaces> {
    let (at, given_up) = anneal_start(sketch, judge, random, start, patience);
    let looks = sketch.drawn_figures(&at)?;
    // Of what is given up some poses say enough, and whether it can be built is not asked.
    let stroke = if given_up {
        judge.coarse_figures(&at, f64::INFINITY)
    } else {
        judge.watch_meetings();
        judge.fine_figures(&at)
    };
    let (stroke, stacking) = (stroke?, judge.find_stacking());
    let limits = &sketch.limits;
    Some(FoundPlaces {
        cost: match limits.task.aim {
            Aim::Balanced => looks.penalty + limits.stroke_cost(&stroke),
            Aim::Force => {
                sketch.broken_cost(&at, &mut SeenSides::default())
                    + limits.force_cost(&stroke, WITHIN)
            }
        },
        does: limits
            .find_shortfall(&stroke, sketch.bones.all_swing())
            .is_none(),
        within: looks.keep_limits(limits, stacking.is_known()),
        meets: stacking == Stacking::Meets,
        looks,
        at,
        start,
        given_up,
    })
}

/// What is looked at in a part of a search for places.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Look {
    Places,
    Motion,
    Stroke,
    /// The force, limits being so many times as wide as usual.
    Force(f64),
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
        moves: 700,
        warmth: [1.0, 0.47],
    },
    Phase {
        look: Look::Motion,
        moves: 500,
        warmth: [0.47, 0.0],
    },
    Phase {
        look: Look::Stroke,
        moves: 500,
        warmth: [0.5, 0.0],
    },
];

/// Starts of which few become good: after so many moves that look at strokes the cheapest costs so many times what good places do. Of
/// those of hinged structures one in twelve.
const LAGGING: [(usize, f64); 4] = [(50, 7.0), (100, 4.0), (150, 3.0), (200, 2.0)];

/// How wide limits are within which places are taken.
const WITHIN: f64 = 1.0;

/// Of what does the task, the strongest: beyond the limits first, then within.
const FOR_FORCE: [Phase; 2] = [
    Phase {
        look: Look::Force(6.0),
        moves: 2500,
        warmth: [3.0, 0.5],
    },
    Phase {
        look: Look::Force(WITHIN),
        moves: 1500,
        warmth: [0.5, 0.0],
    },
];

/// A search for places from one start.
struct Annealing<'s, 'j, 'a> {
    sketch: &'s Sketch<'a>,
    judge: &'j mut Judge<'a>,
    random: ChaCha8Rng,
    /// The places, what they cost, and those before the last move.
    at: Places,
    now: f64,
    before: Places,
    seen: SeenSides,
    /// The cheapest of the phase.
    best: (f64, Places),
    given_up: bool,
}

impl<'s, 'j, 'a> Annealing<'s, 'j, 'a> {
    fn new(sketch: &'s Sketch<'a>, judge: &'j mut Judge<'a>, mut random: ChaCha8Rng) -> Self {
        let at = sketch.first_places(&mut random);
        Annealing {
            before: at.clone(),
            seen: SeenSides::default(),
            best: (f64::INFINITY, at.clone()),
            given_up: false,
            now: f64::INFINITY,
            sketch,
            judge,
            random,
            at,
        }
    }

    /// What the places cost; `None` where that is more than `most`, or the pose is singular.
    fn place_cost(&mut self, look: Look, most: f64) -> Option<f64> {
        if let Look::Force(slack) = look {
            let drawn = self.sketch.broken_cost(&self.at, &mut self.seen);
            let limits = self.sketch.limits;
            let stroke = self.judge.coarse_figures(&self.at, f64::INFINITY)?;
            let mut all = drawn + limits.force_cost(&stroke, slack);
            // What seems good enough at some poses is looked at between them, too.
            if all <= most && slack <= WITHIN {
                all = drawn + limits.force_cost(&self.judge.fine_figures(&self.at)?, slack);
            }
            return (all <= most).then_some(all);
        }
        let moving = look != Look::Places;
        let drawn = (self.sketch).place_penalty(&self.at, moving, most, &mut self.seen)?;
        if look != Look::Stroke {
            return Some(drawn);
        }
        let stroke = self.judge.coarse_figures(&self.at, most - drawn)?;
        let all = drawn + self.sketch.limits.stroke_cost(&stroke);
        (all <= most).then_some(all)
    }

    /// Whether the places, the cheapest so far, cost so little by their stroke and do what the task asks at all its poses, so that the
    /// search may end.
    fn is_good(&mut self, look: Look) -> bool {
        if look != Look::Stroke || self.now >= self.sketch.good_cost() {
            return false;
        }
        let stroke = self.judge.fine_figures(&self.at);
        let swings = self.sketch.bones.all_swing();
        stroke.is_some_and(|f| self.sketch.limits.find_shortfall(&f, swings).is_none())
    }

    /// Whether so many moves that look at strokes have led to so little that the start is given up.
    fn is_lagging(&self, moves: usize) -> bool {
        let bound = LAGGING.iter().find(|(after, _)| *after == moves);
        bound.is_some_and(|(_, times)| self.best.0 > times * self.sketch.good_cost())
    }

    fn phase(&mut self, phase: &Phase, patience: Patience) {
        // A stroke is judged from the best of what was drawn.
        if matches!(phase.look, Look::Stroke | Look::Force(_)) {
            self.at.clone_from(&self.best.1);
        }
        self.now = self
            .place_cost(phase.look, f64::INFINITY)
            .unwrap_or(f64::INFINITY);
        self.best = (self.now, self.at.clone());
        if self.is_good(phase.look) {
            return;
        }
        let [from, to] = phase.warmth;
        let races = patience == Patience::Racing && phase.look == Look::Stroke;
        for step in 0..phase.moves {
            if races && self.is_lagging(step) {
                self.given_up = true;
                return;
            }
            #[allow(clippy::cast_precision_loss, reason = "a few thousand")]
            let done = step as f64 / phase.moves as f64;
            let before = self.best.0;
            self.try_step(phase.look, from + (to - from) * done);
            if self.best.0 < before && self.is_good(phase.look) {
                return;
            }
        }
        // Of those that cost more as drawn than good places do with their stroke one in twenty becomes good.
        let drawn = matches!(phase.look, Look::Places | Look::Motion);
        let races = patience == Patience::Racing && drawn;
        self.given_up = races && self.best.0 > self.sketch.good_cost();
    }

    /// Tries other places.
    fn try_step(&mut self, look: Look, warmth: f64) {
        let heat = 2.0 * warmth * warmth;
        self.before.clone_from(&self.at);
        if let Look::Force(_) = look {
            // Limits meet in corners: from one to another several joints go, near or far.
            for _ in 0..=random_below(3, &mut self.random) {
                let far = random_unit(&mut self.random).powi(2);
                self.sketch
                    .change_places(&mut self.at, far, &mut self.random);
            }
        } else {
            self.sketch
                .change_places(&mut self.at, warmth, &mut self.random);
        }
        // Taken where exp((now - then) / heat) is above a random number: what is too dear is not looked at to the end.
        let most = self.now - heat * random_unit(&mut self.random).ln();
        match self.place_cost(look, most) {
            Some(then) => {
                self.now = then;
                if then < self.best.0 {
                    self.best.0 = then;
                    self.best.1.clone_from(&self.at);
                }
            }
            None => self.at.clone_from(&self.before),
        }
    }
}

/// The places at the end of one search.
fn anneal_start<'a>(
    sketch: &Sketch<'a>,
    judge: &mut Judge<'a>,
    random: ChaCha8Rng,
    start: u32,
    patience: Patience,
) -> (Places, bool) {
    let mut search = Annealing::new(sketch, judge, random);
    let phases: &[&[Phase]] = match sketch.limits.task.aim {
        Aim::Balanced => &[&PHASES],
        // What looks good is not what pulls best: every other start does without.
        Aim::Force if start.is_multiple_of(2) => &[&PHASES, &FOR_FORCE],
        Aim::Force => &[&FOR_FORCE],
    };
    for phase in phases.iter().copied().flatten() {
        search.phase(phase, patience);
        if search.given_up {
            break;
        }
    }
    (search.best.1, search.given_up)
}
