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
use crate::score::evaluation::lower_bound::{common_rows, is_in_span};
use crate::score::evaluation::pose_tables::{PlacedJoint, PoseTable};
use crate::score::evaluation::terms::{ErrorSum, Floor};
use crate::search::answer::k_best::Assignment;
use crate::statics::reactions::geometry::Six;

/// Pivots below this are none: rows are unit twists.
const PIVOT: f64 = 1e-9;
/// Reactions count as unknown if a pivot is below this, because rounding must not end a branch.
const SURE: f64 = 1e-5;
/// Loads have no equilibrium if their work on undriven motions is above this fraction of them. The limit for whole variants is far
/// lower, and decides the cases in between.
const WORK: f64 = 1e-6;

/// A joint's place, and what it bears by the unknowns.
#[derive(Debug)]
struct LoadedPlace {
    variable: usize,
    slot: usize,
    /// First unknown of each contour through it, with its direction.
    contours: Vec<(usize, f64)>,
    /// Force and moment in each load case where the unknowns are 0.
    fixed: Vec<[f64; 6]>,
    /// The contribution of each unknown of a contour.
    across: Vec<[f64; 6]>,
}

/// A pose as branches of variants need it: nothing in it depends on a choice that is made.
#[derive(Debug)]
pub(in crate::score) struct Beginnings {
    unknowns: usize,
    sides: usize,
    width: usize,
    /// Greatest work of the loads that is rounding.
    work: f64,
    clearance: ClearanceSum,
    /// Equations of all variants.
    common: Vec<Vec<f64>>,
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
        let unknowns = table.count_unknowns();
        let width = unknowns + table.cases;
        let choices = table.cells.iter().map(|c| vec![Vec::new(); c.len()]);
        let mut out = Beginnings {
            unknowns,
            sides: table.cases,
            width,
            work: WORK * table.scale,
            clearance,
            common: Vec::new(),
            further: choices.collect(),
            places: Vec::new(),
            of_variable: vec![Vec::new(); table.cells.len()],
            limits: Vec::new(),
            least: Vec::new(),
        };
        for place in &table.places {
            out.add_place(table, place);
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

    /// Adds a joint's place: the equations that all choices have there, and those of each choice's further freedoms.
    fn add_place(&mut self, table: &PoseTable, place: &PlacedJoint) {
        let (dim, cells) = (table.basis.len(), &table.cells[place.variable]);
        let whole = |row: &[f64]| table.whole_row(place, row);
        let common: Vec<Vec<f64>> = common_rows(table, place).into_iter().cloned().collect();
        self.common.extend(common.iter().map(|row| whole(row)));
        for (cell, further) in cells.iter().zip(&mut self.further[place.variable]) {
            let mut known = common.clone();
            for row in &cell[place.slot].rows {
                if !is_in_span(row, &known, dim) {
                    further.push(whole(row));
                    known.push(row.clone());
                }
            }
        }
        let pair = |w: &Six| {
            let (f, m) = table.borne_at(place, w);
            [f[0], f[1], f[2], m[0], m[1], m[2]]
        };
        self.of_variable[place.variable].push(self.places.len());
        self.places.push(LoadedPlace {
            variable: place.variable,
            slot: place.slot,
            contours: place.contours.iter().map(|&(k, s)| (k * dim, s)).collect(),
            fixed: place.along_tree.iter().map(pair).collect(),
            across: table.basis.iter().map(pair).collect(),
        });
    }

    /// Returns the beginning without choices.
    pub(in crate::score) fn begin_empty(&self) -> Begun<'_> {
        let mut out = Begun {
            of: self,
            rows: Vec::new(),
            pivots: Vec::new(),
            weakest: Vec::new(),
            chosen: self.least.clone(),
            known: false,
            order: (0..self.places.len()).collect(),
            errors: false,
            solution: vec![0.0; self.unknowns * self.sides],
            forces: vec![0.0; self.places.len()],
            moments: vec![0.0; self.places.len()],
            passed: vec![0.0; self.places.len() * (self.sides - 1)],
            row: Vec::new(),
        };
        for row in &self.common {
            out.insert_equation(row);
        }
        out
    }
}

/// The equations of a beginning, reduced, and the reactions where they determine them. Choices are taken and given back, the last
/// first.
#[derive(Debug, Clone)]
pub(in crate::score) struct Begun<'b> {
    of: &'b Beginnings,
    /// Reduced equations: each is 0 where those before it have their pivots.
    rows: Vec<f64>,
    pivots: Vec<usize>,
    /// The least pivot up to each equation.
    weakest: Vec<f64>,
    /// By variable and slot: the choice's own, or the least of all.
    chosen: Vec<Vec<LoadLimits>>,
    /// Whether the reactions are known.
    known: bool,
    /// The places in the order of examination. The last one that ended a branch comes first.
    order: Vec<usize>,
    /// Whether what unit forces on the outputs pass is known, too.
    errors: bool,
    /// Unknowns × load cases.
    solution: Vec<f64>,
    /// Under the loads, by place.
    forces: Vec<f64>,
    moments: Vec<f64>,
    /// Forces under a unit force on an output along an axis, by output and axis, and then by place.
    passed: Vec<f64>,
    row: Vec<f64>,
}

/// A choice that was taken and is to be given back.
#[derive(Debug, Clone, Copy)]
pub(in crate::score) struct TakenChoice {
    variable: usize,
    /// Equations before it.
    rows: usize,
    /// Whether the reactions are known by it.
    tells: bool,
}

impl Begun<'_> {
    /// Takes a choice. The flag is false if the loads have no equilibrium for any further choices. The choice must be given back in any
    /// case.
    ///
    /// # Complexity
    /// O(unknowns · width) for each further freedom, once on the way O(unknowns²), and O(unknowns) for each from there on. If the
    /// reactions become known by it, call [`Begun::peaks`] before the next choice.
    pub(in crate::score) fn take_choice(
        &mut self,
        variable: usize,
        choice: usize,
    ) -> (TakenChoice, bool) {
        let of = self.of;
        let mut taken = TakenChoice {
            variable,
            rows: self.pivots.len(),
            tells: false,
        };
        self.chosen[variable].copy_from_slice(&of.limits[variable][choice]);
        let further = &of.further[variable][choice];
        if self.known {
            return (taken, further.iter().all(|row| self.is_in_equilibrium(row)));
        }
        let held = further.iter().all(|row| self.insert_equation(row));
        if held && self.is_determined() {
            (self.known, taken.tells) = (true, true);
            self.errors = false;
            self.solve_cases(0..1);
        }
        (taken, held)
    }

    /// Removes the last choice.
    pub(in crate::score) fn give_back(&mut self, taken: TakenChoice) {
        self.pivots.truncate(taken.rows);
        self.weakest.truncate(taken.rows);
        self.rows.truncate(taken.rows * self.of.width);
        self.chosen[taken.variable].copy_from_slice(&self.of.least[taken.variable]);
        if taken.tells {
            self.known = false;
        }
    }

    /// Returns true if the known reactions and the loads are in equilibrium on a motion: together they do no work.
    fn is_in_equilibrium(&self, row: &[f64]) -> bool {
        let unknowns = self.of.unknowns;
        let known = self.solution.iter().step_by(self.of.sides);
        let work: f64 = row.iter().zip(known).map(|(r, x)| r * x).sum();
        (row[unknowns] - work).abs() <= self.of.work
    }

    fn is_determined(&self) -> bool {
        self.pivots.len() == self.of.unknowns && self.weakest.last().is_none_or(|w| *w > SURE)
    }

    /// Adds an equation, reduced by those before it. Returns false if loads do work on a motion that nothing drives.
    fn insert_equation(&mut self, row: &[f64]) -> bool {
        let (width, unknowns) = (self.of.width, self.of.unknowns);
        self.row.clear();
        self.row.extend_from_slice(row);
        for (own, &p) in self.rows.chunks_exact(width).zip(&self.pivots) {
            let factor = self.row[p];
            if factor != 0.0 {
                for (x, o) in self.row.iter_mut().zip(own) {
                    *x -= factor * o;
                }
                self.row[p] = 0.0;
            }
        }
        let mut best = (0, 0.0);
        for (c, x) in self.row[..unknowns].iter().enumerate() {
            if x.abs() > best.1 {
                best = (c, x.abs());
            }
        }
        if best.1 < PIVOT {
            return self.row[unknowns..]
                .first()
                .is_none_or(|x| x.abs() <= self.of.work);
        }
        let inverse = 1.0 / self.row[best.0];
        self.rows.extend(self.row.iter().map(|x| x * inverse));
        let weakest = self.weakest.last().copied().unwrap_or(1.0);
        self.weakest.push(best.1.min(weakest));
        self.pivots.push(best.0);
        true
    }

    /// Computes the unknowns in some load cases.
    fn solve_cases(&mut self, cases: std::ops::Range<usize>) {
        let (width, unknowns, sides) = (self.of.width, self.of.unknowns, self.of.sides);
        for at in (0..unknowns).rev() {
            let row = &self.rows[at * width..(at + 1) * width];
            for case in cases.clone() {
                let mut x = row[unknowns + case];
                for &later in &self.pivots[at + 1..] {
                    x -= row[later] * self.solution[later * sides + case];
                }
                self.solution[self.pivots[at] * sides + case] = x;
            }
        }
    }

    /// Returns the force and moment at a place in a load case.
    fn load_at(&self, place: &LoadedPlace, case: usize) -> [f64; 6] {
        let mut out = place.fixed[case];
        for (i, across) in place.across.iter().enumerate() {
            let at =
                |&(k, sign): &(usize, f64)| sign * self.solution[(k + i) * self.of.sides + case];
            let x: f64 = place.contours.iter().map(at).sum();
            for (o, a) in out.iter_mut().zip(across) {
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
            self.solve_cases(1..self.of.sides);
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
