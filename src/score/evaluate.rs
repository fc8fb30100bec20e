//! The scores of variants, fast.

use crate::model::mechanism::LinkId;
use crate::model::ranking::ClearanceSum;
use crate::redundancy::analysis::{AnalysisError, Method, analyse};
use crate::score::bearing::Load;
use crate::score::elimination::{Ended, Scratch};
use crate::score::joint_types::JointTypes;
use crate::score::table::Table;
use crate::score::terms::{ErrorSum, Peak, Scores, across, output_points};
use crate::search::best::Variant;
use crate::search::request::Search;
use crate::workload::reactions::drives::{Driven, driven};
use crate::workload::reactions::follow::{Followed, follow};
use crate::workload::reactions::geometry::{Geometry, Six, about, dot};
use crate::workload::reactions::{Unsolved, period};
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
    /// The present mechanism could not be analysed.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
}

/// Scores the variants of one search.
#[derive(Debug)]
pub struct Evaluator<'s, 'm> {
    /// The search.
    pub search: &'s Search<'m>,
    /// What joints bear.
    pub types: JointTypes,
    /// How clearances add up.
    pub clearance: ClearanceSum,
    /// The freedoms that drives hold.
    pub drives: Vec<Driven>,
    /// Poses looked at, and where the stroke ended early.
    pub poses: Followed,
    pub(super) outputs: Vec<(LinkId, [f64; 3])>,
    tables: Vec<Table>,
    working: i64,
}

impl<'s, 'm> Evaluator<'s, 'm> {
    /// Makes everything ready that does not depend on the variant.
    ///
    /// # Errors
    /// Where a coordinate has no value or singular values do not converge.
    ///
    /// # Complexity
    /// O(poses · options · loads), and the poses of the stroke.
    pub fn new(
        search: &'s Search<'m>,
        clearance: ClearanceSum,
    ) -> Result<Evaluator<'s, 'm>, ScoreError> {
        let m = search.mechanism;
        let types = JointTypes::of(m);
        let start = follow(m, 0, &[], None)?;
        let drives = match start.poses.first() {
            Some((_, pose)) => driven(m, &Geometry::new(m, 0, pose).map_err(Unsolved::from)?)?,
            None => Vec::new(),
        };
        let poses = follow(m, 0, &drives, m.loads.stroke)?;
        let outputs = output_points(m);
        let tables = poses
            .poses
            .iter()
            .map(|p| Table::new(search, &types, &outputs, &drives, p, period(&drives)))
            .collect::<Result<_, _>>()?;
        let states = analyse(m, &[0], Method::Modular)?;
        let working = states
            .first()
            .map_or(0, |s| i64::try_from(s.working_mobility).unwrap_or(0));
        Ok(Evaluator {
            search,
            types,
            clearance,
            drives,
            poses,
            outputs,
            tables,
            working,
        })
    }

    /// The scores of a variant; [`Unsolved`] where its loads have no equilibrium. Variants with redundant constraints left
    /// are solved the slow way.
    ///
    /// # Errors
    /// [`Unsolved`].
    ///
    /// # Complexity
    /// O((6k)²·f) for each pose, for k contours and f freedoms.
    pub fn scores(&self, variant: &Variant, scratch: &mut Scratch) -> Result<Scores, Unsolved> {
        self.scores_and_loads(variant, scratch, &mut |_| {})
    }

    /// The same, and `each` is told what every joint bears in every pose; where the fast way turns out not to serve, it is
    /// told all over again by the slow one.
    pub(super) fn scores_and_loads(
        &self,
        variant: &Variant,
        scratch: &mut Scratch,
        each: &mut dyn FnMut(Load),
    ) -> Result<Scores, Unsolved> {
        let mut worst: Option<Scores> = None;
        for table in &self.tables {
            let Some(now) = self.at(table, variant, scratch, each)? else {
                return self.slowly_with(variant, each);
            };
            match &mut worst {
                Some(w) => w.worse(&now),
                None => worst = Some(now),
            }
        }
        worst.map_or_else(|| self.slowly_with(variant, each), Ok)
    }

    /// What needs no equations.
    pub(super) fn plain(&self, variant: &Variant) -> Scores {
        Scores {
            force: Peak::NONE,
            moment: Peak::NONE,
            conditioning: 1.0,
            output_error: 0.0,
            changes: variant.key.changes(),
            cost_milli: self.search.steps.milli(variant.key.cost()),
            idle: self.search.mobility(variant.key) - self.working,
            minimum_norm: false,
        }
    }

    fn at(
        &self,
        table: &Table,
        variant: &Variant,
        scratch: &mut Scratch,
        each: &mut dyn FnMut(Load),
    ) -> Result<Option<Scores>, Unsolved> {
        let dim = table.basis.len();
        let unknowns = dim * table.contours;
        let width = unknowns + table.cases;
        let cell =
            |p: &super::table::Place| &table.cells[p.variable][variant.choices[p.variable]][p.slot];
        scratch.rows.clear();
        scratch.gram.clear();
        scratch.gram.resize(unknowns * unknowns, 0.0);
        let mut count = 0;
        for place in &table.places {
            let cell = cell(place);
            for row in &cell.rows {
                let from = count * width;
                scratch.rows.resize(from + width, 0.0);
                let out = &mut scratch.rows[from..];
                for &(k, sign) in &place.contours {
                    for (o, x) in out[k * dim..(k + 1) * dim].iter_mut().zip(row) {
                        *o = sign * x;
                    }
                }
                out[unknowns..].copy_from_slice(&row[dim..]);
                count += 1;
            }
            for &(k, s) in &place.contours {
                for &(l, t) in &place.contours {
                    for a in 0..dim {
                        let from = (k * dim + a) * unknowns + l * dim;
                        let out = &mut scratch.gram[from..from + dim];
                        for (o, g) in out.iter_mut().zip(&cell.gram[a * dim..]) {
                            *o += s * t * g;
                        }
                    }
                }
            }
        }
        match scratch.eliminate(count, unknowns, width) {
            Ended::Open => return Ok(None),
            Ended::Solved { left } if left > NO_WORK * table.scale => {
                return Err(Unsolved::Moves {
                    link: String::new(),
                    mobility: count - unknowns,
                });
            }
            Ended::Solved { .. } => {}
        }
        let mut out = self.plain(variant);
        let mut errors = vec![ErrorSum::new(self.clearance); self.outputs.len()];
        let forces = |place: &super::table::Place, case: usize| -> Six {
            let mut w = place.along_tree[case];
            for &(k, sign) in &place.contours {
                for (b, i) in table.basis.iter().zip(k * dim..) {
                    let x = sign * scratch.solution[i * table.cases + case];
                    for (w, b) in w.iter_mut().zip(b) {
                        *w += x * b;
                    }
                }
            }
            w
        };
        for place in &table.places {
            let w = about(&forces(place, 0), place.point);
            let (mut f, mut m) = ([w[3], w[4], w[5]], [w[0], w[1], w[2]]);
            if let Some((axis, shift)) = place.held {
                if shift {
                    f = across(f, axis);
                } else {
                    m = across(m, axis);
                }
            }
            let (f, m) = (dot(f, f).sqrt(), dot(m, m).sqrt() * table.size);
            for &capacity in &cell(place).bears {
                let (force, moment) = capacity;
                each(Load {
                    joint: place.joint,
                    force: f,
                    moment: m,
                    capacity,
                });
                out.force.raise(f, force, place.joint);
                if let Some(moment) = moment {
                    out.moment.raise(m, moment, place.joint);
                }
            }
        }
        for (o, error) in errors.iter_mut().enumerate() {
            for axis in 0..3 {
                for place in &table.places {
                    let w = forces(place, 1 + 3 * o + axis);
                    let mut f = [w[3], w[4], w[5]];
                    if let Some((axis, true)) = place.held {
                        f = across(f, axis);
                    }
                    error.joint(cell(place).clearance, dot(f, f));
                }
                error.end_axis();
            }
            out.output_error = out.output_error.max(error.error());
        }
        out.conditioning = scratch.conditioning(unknowns);
        Ok(Some(out))
    }
}
