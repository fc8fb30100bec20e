//! Search for a place for every joint by simulated annealing. [Kirkpatrick, Gelatt & Vecchi 1983]

use crate::synthesis::places::Places;
use crate::synthesis::sketch::Sketch;
use crate::synthesis::sketch::layout_quality::Looks;
use crate::synthesis::sketch::seen_sides::SeenSides;
use crate::synthesis::stroke::judge::Judge;
use crate::synthesis::stroke::planes::Stacking;
use crate::synthesis::task::Aim;
use crate::synthesis::{random_below, random_for, random_unit};
use chacha20::ChaCha8Rng;
use std::cmp::Ordering;

/// Places at the end of a start.
pub(in crate::synthesis) struct FoundPlaces {
    /// Whether the drawing keeps the limits, or links that cross pass each other in separate layers.
    pub(in crate::synthesis) within: bool,
    /// Whether the stroke fulfils the task.
    does: bool,
    /// Whether links collide in every assignment of layers.
    meets: bool,
    pub(in crate::synthesis) looks: Looks,
    /// Cost of the drawn pose and the stroke.
    pub(in crate::synthesis) cost: f64,
    pub(in crate::synthesis) at: Places,
    pub(in crate::synthesis) start: u32,
}

impl FoundPlaces {
    /// Returns true if only a lower cost could justify another start.
    fn will_do(&self) -> bool {
        self.within && self.does && !self.meets
    }

    /// Compares by limits first, then by task, then by collisions, then by cost.
    fn compare_places(&self, other: &FoundPlaces) -> Ordering {
        let misses = |of: &FoundPlaces| (!of.within, !of.does, of.meets);
        let cost = || self.cost.total_cmp(&other.cost);
        misses(self).cmp(&misses(other)).then_with(cost)
    }

    /// Returns true if no better places need be searched for.
    pub(in crate::synthesis) fn are_good(&self, sketch: &Sketch<'_>) -> bool {
        let enough = sketch.limits.task.aim == Aim::Balanced && self.cost < sketch.good_cost();
        self.will_do() && enough
    }

    /// Returns true if they are better than `best`, or if `best` is `None`.
    pub(in crate::synthesis) fn is_better_than(&self, best: Option<&FoundPlaces>) -> bool {
        best.is_none_or(|b| self.compare_places(b).is_lt())
    }
}

/// Maximum number of starts of a search for places, for each lay.
pub(in crate::synthesis) const STARTS: u32 = 12;
/// Number of best starts that go on if none becomes good. More go on if none of these keeps the limits of the drawing.
const GO_ON: usize = 6;

/// Returns the best places of some starts of a structure of this name; `None` if all end in singular poses.
///
/// The first good places are enough. Starts that lag behind are paused. If none becomes good, the best go on until one fulfils the task and
/// can be built. Those that still lag far behind are given up.
pub(in crate::synthesis) fn best_of_starts<'a>(
    sketch: &Sketch<'a>,
    judge: &mut Judge<'a>,
    name: &str,
    seed: u64,
    first: u32,
) -> Option<FoundPlaces> {
    let thresholds = match sketch.limits.task.aim {
        Aim::Balanced => &LAGGING,
        Aim::Force => &NEVER,
    };
    let mut raced = Vec::new();
    for start in first..first + STARTS {
        let random = random_for(name, seed, start);
        let mut search = Annealing::new(sketch, random, start);
        search.advance(judge, thresholds);
        let Some(found) = search.judge_places(judge) else {
            continue;
        };
        if found.are_good(sketch) {
            return Some(found);
        }
        raced.push((found, search));
    }
    raced.sort_by(|(a, _), (b, _)| a.compare_places(b));
    let mut best: Option<FoundPlaces> = None;
    for (n, (mut found, mut search)) in raced.into_iter().enumerate() {
        if n >= GO_ON && best.as_ref().is_some_and(|b| b.within) {
            break;
        }
        if search.paused {
            // With other pairs than hinges, good places cost so little that many beyond the thresholds do the task.
            let kept = best.as_ref().is_some_and(|b| b.within);
            let gives_up = kept && sketch.structure.form.hinges;
            search.advance(judge, if gives_up { &HOPELESS } else { &NEVER });
            search.paused = false;
            let Some(ended) = search.judge_places(judge) else {
                continue;
            };
            found = ended;
        }
        let will_do = found.will_do();
        if found.is_better_than(best.as_ref()) {
            best = Some(found);
        }
        if will_do {
            break;
        }
    }
    // Narrow limits of the drawing are worth as many starts again.
    for start in first + STARTS..first + 2 * STARTS {
        if best.as_ref().is_none_or(|b| b.within) {
            break;
        }
        let mut search = Annealing::new(sketch, random_for(name, seed, start), start);
        search.advance(judge, &NEVER);
        let found = search.judge_places(judge);
        best = best
            .into_iter()
            .chain(found)
            .min_by(FoundPlaces::compare_places);
    }
    best
}

/// Subject of the evaluation in a phase of the search.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Look {
    Places,
    Motion,
    Stroke,
    /// The force, with limits this many times as wide as usual.
    Force(f64),
}

/// Phase of a search: number of moves, and temperature at the beginning and at the end.
struct Phase {
    look: Look,
    moves: usize,
    warmth: [f64; 2],
}

/// Places only, which is cheap; then also motion and forces of the drawn pose; then the whole stroke, slightly reheated.
const PHASES: [Phase; 3] = [
    Phase {
        look: Look::Places,
        moves: 600,
        warmth: [1.0, 0.47],
    },
    Phase {
        look: Look::Motion,
        moves: 300,
        warmth: [0.47, 0.0],
    },
    Phase {
        look: Look::Stroke,
        moves: 1000,
        warmth: [0.5, 0.0],
    },
];

/// Thresholds at which a start lags behind, on its lowest cost over the cost of good places.
struct Thresholds {
    /// For the drawing.
    drawn: f64,
    /// After some moves that evaluate strokes.
    strokes: &'static [(usize, f64)],
}

/// Thresholds for pausing a start. One in twenty starts with a cost of the drawing above its threshold becomes good, and one in twelve with a
/// cost of the stroke above.
const LAGGING: Thresholds = Thresholds {
    drawn: 1.0,
    strokes: &[(25, 9.0), (50, 7.0), (100, 4.0), (150, 3.0), (200, 2.0)],
};
/// Thresholds for giving up a start that goes on, for hinged structures. One in twenty beyond them would fulfil the task.
const HOPELESS: Thresholds = Thresholds {
    drawn: f64::INFINITY,
    strokes: &[(300, 3.5), (400, 3.0), (500, 2.5), (600, 2.0)],
};
/// No thresholds: all starts come to their end.
const NEVER: Thresholds = Thresholds {
    drawn: f64::INFINITY,
    strokes: &[],
};

/// Width of the limits within which places are accepted, as a multiple of the usual width.
const WITHIN: f64 = 1.0;

/// Search for the greatest force among places that fulfil the task: beyond the limits first, then within them.
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

/// Search for places from one start.
struct Annealing<'s, 'a> {
    sketch: &'s Sketch<'a>,
    random: ChaCha8Rng,
    start: u32,
    /// The current places, their cost, and the places before the last move.
    at: Places,
    now: f64,
    before: Places,
    seen: SeenSides,
    /// The cheapest places of the phase.
    best: (f64, Places),
    /// The phase in which the search goes on, and the number of its moves so far.
    phase: usize,
    step: usize,
    /// Whether the search waits for others, and can go on.
    paused: bool,
}

impl<'s, 'a> Annealing<'s, 'a> {
    fn new(sketch: &'s Sketch<'a>, mut random: ChaCha8Rng, start: u32) -> Self {
        let at = sketch.first_places(&mut random);
        Annealing {
            before: at.clone(),
            seen: SeenSides::default(),
            best: (f64::INFINITY, at.clone()),
            phase: 0,
            step: 0,
            paused: false,
            now: f64::INFINITY,
            start,
            sketch,
            random,
            at,
        }
    }

    /// Returns the places found so far; `None` if their pose is singular.
    fn judge_places(&self, judge: &mut Judge<'a>) -> Option<FoundPlaces> {
        let (sketch, at) = (self.sketch, self.best.1.clone());
        let looks = judge.drawn_figures(&at)?;
        // A paused start is judged by some poses only, and its layers are not checked.
        let stroke = if self.paused {
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
            start: self.start,
        })
    }

    /// Returns the cost of the places; `None` if it is more than `most`, or if the pose is singular.
    fn place_cost(&mut self, judge: &mut Judge<'a>, look: Look, most: f64) -> Option<f64> {
        if let Look::Force(slack) = look {
            let drawn = self.sketch.broken_cost(&self.at, &mut self.seen);
            let limits = self.sketch.limits;
            let stroke = judge.coarse_figures(&self.at, f64::INFINITY)?;
            let mut all = drawn + limits.force_cost(&stroke, slack);
            // Places that seem good enough at some poses are also checked between them.
            if all <= most && slack <= WITHIN {
                all = drawn + limits.force_cost(&judge.fine_figures(&self.at)?, slack);
            }
            return (all <= most).then_some(all);
        }
        let moving = look != Look::Places;
        let drawn = (self.sketch).place_penalty(&self.at, most, &mut self.seen, || {
            let motion = moving.then(|| Some(judge.drawn_motion(&self.at)?.penalty));
            motion.unwrap_or(Some(0.0))
        })?;
        if !moving {
            return Some(drawn);
        }
        let stroke = judge.figures_from_drawn(&self.at, look == Look::Stroke, most - drawn)?;
        let all = drawn + self.sketch.limits.stroke_cost(&stroke);
        (all <= most).then_some(all)
    }

    /// Returns true if the search may end with these places. They are the cheapest so far, their stroke costs little, and they fulfil the
    /// task at all its poses.
    fn is_good(&self, judge: &mut Judge<'a>, look: Look) -> bool {
        look == Look::Stroke && self.now < self.sketch.good_cost() && judge.does_task(&self.at)
    }

    /// Returns true if the lowest cost is still too high after so many moves.
    fn is_lagging(&self, thresholds: &Thresholds) -> bool {
        let mut strokes = thresholds.strokes.iter();
        let bound = strokes.find(|(after, _)| *after == self.step);
        bound.is_some_and(|(_, times)| self.best.0 > times * self.sketch.good_cost())
    }

    /// Goes on until the end of the search, or until it lags behind.
    fn advance(&mut self, judge: &mut Judge<'a>, thresholds: &Thresholds) {
        self.paused = false;
        let phases: &[&[Phase]] = match self.sketch.limits.task.aim {
            Aim::Balanced => &[&PHASES],
            // Good looks do not imply a high force, so every other start skips the drawing phases.
            Aim::Force if self.start.is_multiple_of(2) => &[&PHASES, &FOR_FORCE],
            Aim::Force => &[&FOR_FORCE],
        };
        let phases = phases.iter().copied().flatten().skip(self.phase);
        for phase in phases {
            self.advance_phase(judge, phase, thresholds);
            if self.paused {
                return;
            }
        }
    }

    /// Goes on to the end of a phase, unless the search is paused.
    fn advance_phase(&mut self, judge: &mut Judge<'a>, phase: &Phase, thresholds: &Thresholds) {
        let strokes = phase.look == Look::Stroke;
        if self.step == 0 {
            // The stroke phases begin with the best places of the drawing phases.
            if strokes || matches!(phase.look, Look::Force(_)) {
                self.at.copy_from(&self.best.1);
            }
            let cost = self.place_cost(judge, phase.look, f64::INFINITY);
            self.now = cost.unwrap_or(f64::INFINITY);
            self.best = (self.now, self.at.clone());
        }
        let [from, to] = phase.warmth;
        let mut good = self.step == 0 && self.is_good(judge, phase.look);
        while !good && self.step < phase.moves {
            if strokes && self.is_lagging(thresholds) {
                self.paused = true;
                return;
            }
            #[allow(clippy::cast_precision_loss, reason = "a few thousand")]
            let done = self.step as f64 / phase.moves as f64;
            let before = self.best.0;
            self.try_step(judge, phase.look, from + (to - from) * done);
            self.step += 1;
            good = self.best.0 < before && self.is_good(judge, phase.look);
        }
        (self.phase, self.step) = (self.phase + 1, 0);
        let drawn = matches!(phase.look, Look::Places | Look::Motion);
        self.paused = drawn && self.best.0 > thresholds.drawn * self.sketch.good_cost();
    }

    /// Tries other places.
    fn try_step(&mut self, judge: &mut Judge<'a>, look: Look, warmth: f64) {
        let heat = 2.0 * warmth * warmth;
        self.before.copy_from(&self.at);
        if let Look::Force(_) = look {
            // Limits meet in corners: a step from one corner to another moves several joints, near or far.
            for _ in 0..=random_below(3, &mut self.random) {
                let far = random_unit(&mut self.random).powi(2);
                self.sketch
                    .change_places(&mut self.at, far, &mut self.random);
            }
        } else {
            self.sketch
                .change_places(&mut self.at, warmth, &mut self.random);
        }
        // Accepted if exp((now - then) / heat) is above a random number. The evaluation stops as soon as the cost is too high.
        let most = self.now - heat * random_unit(&mut self.random).ln();
        if self.at == self.before {
            return;
        }
        match self.place_cost(judge, look, most) {
            Some(then) => {
                self.now = then;
                if then < self.best.0 {
                    self.best.0 = then;
                    self.best.1.copy_from(&self.at);
                }
            }
            None => self.at.copy_from(&self.before),
        }
    }
}
