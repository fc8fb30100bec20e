//! Bounds on the scores of all variants that share their first choices.
//!
//! Every option of a joint keeps its original motion, so the equations of the original freedoms hold for all variants. Each choice
//! adds those of its further freedoms. Once the equations have full rank, the reactions are known for all choices of the remaining
//! joints. These choices then only determine the capacities. A branch of variants therefore has a bound long before all its choices
//! are made.

use crate::geom::vector::length;
use crate::model::ranking::{ClearanceSum, Ranking};
use crate::score::evaluation::elimination::Scratch;
use crate::score::evaluation::evaluate::Evaluator;
use crate::score::evaluation::load_limits::LoadLimits;
use crate::score::evaluation::lower_bound::{
    Common, affine_load, common_equations, common_rows, is_in_span,
};
use crate::score::evaluation::pose_tables::{PlacedJoint, PoseTable};
use crate::score::evaluation::solution_space::SolutionSpace;
use crate::score::evaluation::terms::{ErrorSum, Floor};
use crate::search::answer::k_best::Assignment;

/// Reactions count as unknown if an equation is nearer to those before it than this, because rounding must not end a branch.
const SURE: f64 = 1e-5;
/// Loads have no equilibrium if their work on undriven motions is above this fraction of them. The limit for whole variants is far
/// lower, and decides the cases in between.
const WORK: f64 = 1e-6;

/// A joint's place, and what it bears by the unknowns.
#[derive(Debug)]
struct LoadedPlace {
    variable: usize,
    slot: usize,
    /// Force and moment in each load case where the unknowns are 0.
    fixed: Vec<[f64; 6]>,
    /// The contribution of each unknown.
    open: Vec<[f64; 6]>,
}

/// A pose as branches of variants need it: nothing in it depends on a choice that is made. The unknowns are what the equations of all
/// variants leave open.
#[derive(Debug)]
pub(in crate::score) struct Beginnings {
    /// The solutions of no further equations.
    start: SolutionSpace,
    sides: usize,
    /// Greatest work of the loads that is rounding.
    work: f64,
    clearance: ClearanceSum,
    /// By variable and choice, the equations of further freedoms.
    further: Vec<Vec<Vec<Vec<f64>>>>,
    places: Vec<LoadedPlace>,
    /// The places of each variable.
    of_variable: Vec<Vec<usize>>,
    /// By variable, choice and slot.
    limits: Vec<Vec<Vec<LoadLimits>>>,
    /// The least limits of all choices, by variable and slot.
    least: Vec<Vec<LoadLimits>>,
}

impl Evaluator<'_> {
    /// Returns the pose in which the given good variant scores worst, prepared for branches of variants. Its bounds are the strongest.
    pub(in crate::score) fn beginnings_of(
        &self,
        of: &Assignment,
        ranking: &Ranking,
    ) -> Option<Beginnings> {
        let mut scratch = Scratch::default();
        let mut worst: Option<(f64, &PoseTable)> = None;
        for table in self.pose_tables() {
            let scores = self
                .score_at_pose(table, of, &mut scratch, &mut |_| {})
                .ok()??;
            let sum = scores.weighted_sum(ranking);
            if worst.is_none_or(|(least, _)| sum > least) {
                worst = Some((sum, table));
            }
        }
        Beginnings::new(worst?.1, self.clearance)
    }
}

impl Beginnings {
    /// Prepares a pose. Returns `None` if there are couplings, because the load that bypasses a joint depends on the choice there.
    ///
    /// # Complexity
    /// O(places · options · freedoms³).
    pub(in crate::score) fn new(table: &PoseTable, clearance: ClearanceSum) -> Option<Beginnings> {
        if table.couplings > 0 {
            return None;
        }
        let common = common_equations(table)?;
        let mut start = SolutionSpace::unrestricted(common.open.len(), table.cases);
        start.weakest = common.least;
        let choices = table.cells.iter().map(|c| vec![Vec::new(); c.len()]);
        let mut out = Beginnings {
            start,
            sides: table.cases,
            work: WORK * table.scale,
            clearance,
            further: choices.collect(),
            places: Vec::new(),
            of_variable: vec![Vec::new(); table.cells.len()],
            limits: Vec::new(),
            least: Vec::new(),
        };
        for place in &table.places {
            out.add_place(table, &common, place);
        }
        for cells in &table.cells {
            let of_choice = cells.iter().map(|c| c.iter().map(LoadLimits::of).collect());
            let of_choice: Vec<Vec<LoadLimits>> = of_choice.collect();
            let least = of_choice.iter().cloned().reduce(|a, b| {
                let both = a.iter().zip(&b);
                both.map(|(a, b)| a.least_of_both(*b)).collect()
            });
            out.least.push(least.unwrap_or_default());
            out.limits.push(of_choice);
        }
        Some(out)
    }

    /// Adds a joint's place, with the equations of each choice's further freedoms.
    fn add_place(&mut self, table: &PoseTable, common: &Common, place: &PlacedJoint) {
        let (dim, cells) = (table.basis.len(), &table.cells[place.variable]);
        let kept: Vec<Vec<f64>> = common_rows(table, place).into_iter().cloned().collect();
        for (cell, further) in cells.iter().zip(&mut self.further[place.variable]) {
            let mut known = kept.clone();
            for row in &cell[place.slot].rows {
                if !is_in_span(row, &known, dim) {
                    further.push(common.restrict_equation(&table.whole_row(place, row)));
                    known.push(row.clone());
                }
            }
        }
        let load = |case: usize, x: &[f64]| {
            let wrench = table.wrench_at(place, case, x, &[]);
            let ([fx, fy, fz], [mx, my, mz]) = table.borne_at(place, &wrench);
            [fx, fy, fz, mx, my, mz]
        };
        let cases = 0..table.cases;
        // What an unknown contributes is the same in every load case.
        let (_, open) = affine_load(common, 0, &|x| load(0, x));
        self.of_variable[place.variable].push(self.places.len());
        self.places.push(LoadedPlace {
            variable: place.variable,
            slot: place.slot,
            fixed: cases.map(|case| load(case, &common.solution)).collect(),
            open,
        });
    }

    /// Returns the beginning without choices.
    pub(in crate::score) fn begin_empty(&self) -> Begun<'_> {
        Begun {
            of: self,
            solutions: vec![self.start.clone()],
            depth: 0,
            chosen: self.least.clone(),
            known: false,
            order: (0..self.places.len()).collect(),
            errors: false,
            forces: vec![0.0; self.places.len()],
            moments: vec![0.0; self.places.len()],
            passed: vec![0.0; self.places.len() * (self.sides - 1)],
            scratch: [Vec::new(), Vec::new()],
        }
    }
}

/// The reactions that the equations of a beginning leave possible. Choices are taken and given back, the last first.
#[derive(Debug, Clone)]
pub(in crate::score) struct Begun<'b> {
    of: &'b Beginnings,
    /// The solutions without choices, and then those with each choice that adds equations.
    solutions: Vec<SolutionSpace>,
    /// The number of the present solutions. Those behind are memory for further ones.
    depth: usize,
    /// By variable and slot: the choice's own, or the least of all.
    chosen: Vec<Vec<LoadLimits>>,
    /// Whether the reactions are known.
    known: bool,
    /// The places in the order of examination. The last one that ended a branch comes first.
    order: Vec<usize>,
    /// Whether what unit forces on the outputs pass is known, too.
    errors: bool,
    /// Under the loads, by place.
    forces: Vec<f64>,
    moments: Vec<f64>,
    /// Forces under a unit force on an output along an axis, by output and axis, and then by place.
    passed: Vec<f64>,
    scratch: [Vec<f64>; 2],
}

/// A choice that was taken and is to be given back.
#[derive(Debug, Clone, Copy)]
pub(in crate::score) struct TakenChoice {
    variable: usize,
    /// Whether it added equations.
    adds: bool,
    /// Whether the reactions are known by it.
    tells: bool,
}

impl Begun<'_> {
    /// Takes a choice. The flag is false if the loads have no equilibrium for any further choices. The choice must be given back in any
    /// case.
    ///
    /// # Complexity
    /// O(unknowns · (unknowns + load cases)) for each further freedom until the reactions are known, and O(unknowns) after that. If they
    /// become known by this choice, call [`Begun::peak_bounds`] before the next choice.
    pub(in crate::score) fn take_choice(
        &mut self,
        variable: usize,
        choice: usize,
    ) -> (TakenChoice, bool) {
        let of = self.of;
        let further = &of.further[variable][choice];
        let mut taken = TakenChoice {
            variable,
            adds: !self.known && !further.is_empty(),
            tells: false,
        };
        self.chosen[variable].copy_from_slice(&of.limits[variable][choice]);
        if taken.adds {
            self.depth += 1;
            if self.solutions.len() == self.depth {
                self.solutions.push(SolutionSpace::default());
            }
            let (before, next) = self.solutions.split_at_mut(self.depth);
            next[0].copy_from(&before[self.depth - 1]);
        }
        let held = further.iter().all(|row| self.take_equation(row));
        if held && !self.known && self.is_determined() {
            (self.known, taken.tells) = (true, true);
            self.errors = false;
        }
        (taken, held)
    }

    /// Removes the last choice.
    pub(in crate::score) fn give_back(&mut self, taken: TakenChoice) {
        self.depth -= usize::from(taken.adds);
        self.chosen[taken.variable].copy_from_slice(&self.of.least[taken.variable]);
        if taken.tells {
            self.known = false;
        }
    }

    /// Adds an equation, unless the reactions are known. Returns false if loads do work on a motion that nothing drives.
    fn take_equation(&mut self, row: &[f64]) -> bool {
        let solutions = &mut self.solutions[self.depth];
        let adds = !self.known && solutions.add_equation(row, &mut self.scratch);
        adds || solutions.first_gap(row).abs() <= self.of.work
    }

    fn is_determined(&self) -> bool {
        let solutions = &self.solutions[self.depth];
        solutions.is_determined() && solutions.weakest > SURE
    }

    /// Returns the force and moment at a place in a load case.
    fn load_at(&self, place: &LoadedPlace, case: usize) -> [f64; 6] {
        let mut out = place.fixed[case];
        let values = self.solutions[self.depth].values(case);
        for (x, open) in values.iter().zip(&place.open) {
            for (o, a) in out.iter_mut().zip(open) {
                *o += x * a;
            }
        }
        out
    }

    fn update_load(&mut self, p: usize) {
        let [fx, fy, fz, mx, my, mz] = self.load_at(&self.of.places[p], 0);
        self.forces[p] = length([fx, fy, fz]);
        self.moments[p] = length([mx, my, mz]);
    }

    fn update_passed(&mut self) {
        let places = self.of.places.len();
        for case in 1..self.of.sides {
            for (p, place) in self.of.places.iter().enumerate() {
                let [fx, fy, fz, ..] = self.load_at(place, case);
                self.passed[(case - 1) * places + p] = length([fx, fy, fz]);
            }
        }
    }

    fn limits_at(&self, place: &LoadedPlace) -> LoadLimits {
        self.chosen[place.variable][place.slot]
    }

    /// Returns bounds on the greatest force and moment over capacity, from the equations of a choice that was just taken.
    /// Examines only some places if their bounds are `enough` to end the branch. `None` if reactions are not known yet.
    pub(in crate::score) fn peak_bounds(
        &mut self,
        taken: &TakenChoice,
        enough: impl Fn(Floor) -> bool,
    ) -> Option<Floor> {
        if !self.known {
            return None;
        }
        let of = self.of;
        let mut out = Floor::default();
        if !taken.tells {
            for &p in &of.of_variable[taken.variable] {
                self.raise_bounds(p, &mut out);
            }
            return Some(out);
        }
        for at in 0..self.order.len() {
            let p = self.order[at];
            self.update_load(p);
            self.raise_bounds(p, &mut out);
            if enough(out) {
                // It will mostly be enough for the next branch, too.
                self.order[..=at].rotate_right(1);
                break;
            }
        }
        Some(out)
    }

    /// Raises bounds to what a place bears.
    fn raise_bounds(&self, p: usize, bounds: &mut Floor) {
        let limits = self.limits_at(&self.of.places[p]);
        bounds.force = bounds.force.max(self.forces[p] * limits.force);
        bounds.moment = bounds.moment.max(self.moments[p] * limits.moment);
    }

    /// Returns a bound on the error of the outputs `[m]`, if the reactions are known.
    pub(in crate::score) fn output_error(&mut self) -> f64 {
        if !self.errors {
            self.update_passed();
            self.errors = true;
        }
        let places = self.of.places.len();
        let mut worst: f64 = 0.0;
        for output in self.passed.chunks(3 * places) {
            let mut sum = ErrorSum::new(self.of.clearance);
            for axis in output.chunks(places) {
                for (force, place) in axis.iter().zip(&self.of.places) {
                    sum.add_joint(self.limits_at(place).clearance, force * force);
                }
                sum.end_axis();
            }
            worst = worst.max(sum.output_error());
        }
        worst
    }
}

#[cfg(test)]
mod tests;
