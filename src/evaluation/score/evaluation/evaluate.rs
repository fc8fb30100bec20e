//! The scores of variants, fast.

use crate::closure::drive::{Driven, driven_freedoms};
use crate::geom::exact::ExactError;
use crate::geom::vector::dot;
use crate::model::mechanism::{JointId, LinkId, StateId};
use crate::model::ranking::ClearanceSum;
use crate::redundancy::motion::working_mobility;
use crate::score::evaluation::coupled::CoupledChoice;
use crate::score::evaluation::elimination::{Ended, Scratch};
use crate::score::evaluation::load_cases::{CaseError, Cases, list_cases};
use crate::score::evaluation::pose_tables::{PlacedJoint, PoseTable};
use crate::score::evaluation::terms::{ErrorSum, Floor, Peak, Scores, output_points};
use crate::score::joint_types::JointTypes;
use crate::search::Search;
use crate::search::answer::k_best::Assignment;
use crate::statics::reactions::Unsolved;
use std::sync::OnceLock;
use thiserror::Error;

/// Work of the loads on undriven motions below this fraction of them is none.
const NO_WORK: f64 = 1e-8;

/// Why variants cannot be scored.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ScoreError {
    /// The present mechanism has no numbers.
    #[error(transparent)]
    Unsolved(#[from] Unsolved),
    /// A coordinate has no value.
    #[error(transparent)]
    Exact(#[from] ExactError),
    /// It has no cases to be scored in.
    #[error(transparent)]
    Cases(#[from] CaseError),
}

/// The load of a joint in one pose, without the part that its drive bears.
#[derive(Debug, Clone, Copy)]
pub(in crate::score) struct PoseLoad {
    pub(in crate::score) joint: JointId,
    /// `[N]`
    pub(in crate::score) force: f64,
    /// `[N·m]`
    pub(in crate::score) moment: f64,
    /// The greatest of both that its type bears; `None` for moments where it bears none and need not.
    pub(in crate::score) capacity: (f64, Option<f64>),
}

/// Scores the variants of one search.
#[derive(Debug)]
pub struct Evaluator<'s> {
    /// The search.
    pub search: &'s Search,
    /// Capacities of joints.
    pub types: JointTypes,
    /// How clearances add up.
    pub clearance: ClearanceSum,
    /// The freedoms that drives hold.
    pub drives: Vec<Driven>,
    /// The examined poses with their loads.
    pub cases: Cases,
    pub(in crate::score) outputs: Vec<(LinkId, [f64; 3])>,
    tables: Vec<PoseTable>,
    working: i64,
    pub(in crate::score::evaluation) floor: OnceLock<Floor>,
}

impl<'s> Evaluator<'s> {
    /// Prepares all data that is the same for every variant, in the states with loads.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value. Also if singular values do not converge.
    ///
    /// # Complexity
    /// O(poses · options · loads), and the poses of the stroke.
    pub fn new(search: &'s Search, clearance: ClearanceSum) -> Result<Evaluator<'s>, ScoreError> {
        Evaluator::in_states(search, clearance, &[])
    }

    /// Does the same for the named states, or for those with loads if none are named.
    ///
    /// # Errors
    /// Returns an error in the same cases as [`Evaluator::new`], and if a grip loads nothing.
    pub fn in_states(
        search: &'s Search,
        clearance: ClearanceSum,
        states: &[StateId],
    ) -> Result<Evaluator<'s>, ScoreError> {
        let m = &*search.mechanism;
        let types = JointTypes::of(m);
        let drives = driven_freedoms(m, StateId::FREE);
        let cases = list_cases(m, &drives, states)?;
        let outputs = output_points(m, &cases);
        let tables = cases
            .list
            .iter()
            .map(|case| PoseTable::new(search, &types, &outputs, &drives, case))
            .collect::<Result<_, _>>()?;
        let working = working_mobility(&search.exact, m, StateId::FREE)?;
        Ok(Evaluator {
            search,
            types,
            clearance,
            drives,
            cases,
            outputs,
            tables,
            working: i64::try_from(working).unwrap_or(i64::MAX),
            floor: OnceLock::new(),
        })
    }

    /// Returns the scores of a variant, or [`Unsolved`] if its loads have no equilibrium. Variants with remaining redundant
    /// constraints are solved by the slow method.
    ///
    /// # Errors
    /// [`Unsolved`].
    ///
    /// # Complexity
    /// O((6k)²·f) for each pose, for k contours and f freedoms.
    pub fn score_variant(
        &self,
        variant: &Assignment,
        scratch: &mut Scratch,
    ) -> Result<Scores, Unsolved> {
        self.scores_and_loads(variant, scratch, &mut |_| {})
    }

    /// Does the same, and calls `each` with the load of every joint in every pose. If the fast method fails, the slow one calls it
    /// again for all.
    pub(in crate::score) fn scores_and_loads(
        &self,
        variant: &Assignment,
        scratch: &mut Scratch,
        each: &mut dyn FnMut(PoseLoad),
    ) -> Result<Scores, Unsolved> {
        let mut worst: Option<Scores> = None;
        for table in &self.tables {
            let Some(now) = self.score_at_pose(table, variant, scratch, each)? else {
                return self.slowly_with(variant, each);
            };
            match &mut worst {
                Some(w) => w.take_worse(&now),
                None => worst = Some(now),
            }
        }
        worst.map_or_else(|| self.slowly_with(variant, each), Ok)
    }

    /// Returns the working mobility.
    pub(in crate::score) fn working_freedoms(&self) -> i64 {
        self.working
    }

    pub(in crate::score) fn pose_tables(&self) -> &[PoseTable] {
        &self.tables
    }

    /// Returns the scores that need no equations.
    pub(in crate::score) fn unloaded_scores(&self, variant: &Assignment) -> Scores {
        Scores {
            force: Peak::NONE,
            moment: Peak::NONE,
            conditioning: 1.0,
            output_error: 0.0,
            changes: variant.key.changes(),
            cost_milli: self.search.steps.cost_in_milli(variant.key.cost()),
            idle: self.search.mobility(variant.key) - self.working,
            harmful: variant.key.harmful(),
            misfit: 0.0,
            minimum_norm: false,
        }
    }

    /// Returns the scores in one pose. `None` if the fast method does not apply.
    pub(in crate::score) fn score_at_pose(
        &self,
        table: &PoseTable,
        variant: &Assignment,
        scratch: &mut Scratch,
        each: &mut dyn FnMut(PoseLoad),
    ) -> Result<Option<Scores>, Unsolved> {
        let choices = &variant.choices[..];
        let Some(meshing) = teeth_mesh(table, choices) else {
            return Ok(None);
        };
        let unknowns = table.count_unknowns();
        let count = write_equations(table, choices, scratch);
        match scratch.solve_equations(count, unknowns, unknowns + table.cases) {
            Ended::Open => return Ok(None),
            Ended::Solved { left } if left > NO_WORK * table.scale => {
                return Err(Unsolved::Moves {
                    link: String::new(),
                    mobility: count - unknowns,
                });
            }
            Ended::Solved { .. } => {}
        }
        let solved = SolvedPose {
            table,
            choices,
            solution: &scratch.solution,
            meshing: &meshing,
        };
        let mut out = self.unloaded_scores(variant);
        solved.raise_peaks(&mut out, each);
        for output in 0..self.outputs.len() {
            let error = solved.output_error(output, self.clearance);
            out.output_error = out.output_error.max(error);
        }
        out.conditioning = scratch
            .spectrum
            .conditioning_of(&mut scratch.gram, unknowns);
        Ok(Some(out))
    }
}

/// Returns for each coupling whether its teeth mesh in a variant. `None` if a joint in
/// series has another load than the coupled joint.
fn teeth_mesh(table: &PoseTable, choices: &[usize]) -> Option<Vec<bool>> {
    let mut out = vec![true; table.couplings];
    for place in table.places.iter().filter(|p| !p.couplings.is_empty()) {
        for (at, choice) in place
            .couplings
            .iter()
            .zip(&table.cell_at(choices, place).coupled)
        {
            match choice {
                CoupledChoice::BearsTeeth => {}
                CoupledChoice::AlongFreedom => out[at.coupling] = false,
                CoupledChoice::InSeries => return None,
            }
        }
    }
    Some(out)
}

/// Writes the equations of a variant in one pose, and the sum of their outer products; gives how many they are.
fn write_equations(table: &PoseTable, choices: &[usize], scratch: &mut Scratch) -> usize {
    let unknowns = table.count_unknowns();
    let width = unknowns + table.cases;
    scratch.rows.clear();
    scratch.gram.clear();
    scratch.gram.resize(unknowns * unknowns, 0.0);
    let mut count = 0;
    for place in &table.places {
        let cell = table.cell_at(choices, place);
        for row in &cell.rows {
            let from = count * width;
            scratch.rows.resize(from + width, 0.0);
            table.write_row(place, row, &mut scratch.rows[from..]);
            count += 1;
        }
        table.add_gram(place, cell, &mut scratch.gram);
    }
    count
}

/// A variant in one pose, its equations solved.
struct SolvedPose<'p> {
    table: &'p PoseTable,
    choices: &'p [usize],
    /// Unknowns × load cases.
    solution: &'p [f64],
    meshing: &'p [bool],
}

impl SolvedPose<'_> {
    /// Returns the force and moment of a joint in a load case, without the part that its drive bears.
    fn joint_load(&self, place: &PlacedJoint, case: usize) -> ([f64; 3], [f64; 3]) {
        let wrench = self
            .table
            .wrench_at(place, case, self.solution, self.meshing);
        self.table.borne_at(place, &wrench)
    }

    /// Raises the peaks to what each joint bears of the loads, and tells of it.
    fn raise_peaks(&self, out: &mut Scores, each: &mut dyn FnMut(PoseLoad)) {
        for place in &self.table.places {
            let (f, m) = self.joint_load(place, 0);
            let (f, m) = (dot(f, f).sqrt(), dot(m, m).sqrt());
            for &capacity in &self.table.cell_at(self.choices, place).bears {
                let (force, moment) = capacity;
                each(PoseLoad {
                    joint: place.joint,
                    force: f,
                    moment: m,
                    capacity,
                });
                out.force.raise_peak(f, force, place.joint);
                if let Some(moment) = moment {
                    out.moment.raise_peak(m, moment, place.joint);
                }
            }
        }
    }

    /// Returns the motion of an output that the clearances allow.
    fn output_error(&self, output: usize, clearance: ClearanceSum) -> f64 {
        let mut error = ErrorSum::new(clearance);
        for axis in 0..3 {
            for place in &self.table.places {
                let (f, _) = self.joint_load(place, 1 + 3 * output + axis);
                let cell = self.table.cell_at(self.choices, place);
                error.add_joint(cell.clearance, dot(f, f));
            }
            error.end_axis();
        }
        error.output_error()
    }
}
