//! Lower bounds on the terms of every variant.
//!
//! Every option of a joint keeps its original motion. The reactions of all variants therefore satisfy one equation for each original
//! freedom: the work of loads on it is that of the reactions. The least peaks and sums under these equations alone are a convex problem.
//! It is solved by least squares with weights that follow the reactions (for peaks [Lawson 1961], for sums of sizes [Weiszfeld
//! 1937]). The dual of each step gives a bound that holds whether or not the steps have converged.

use crate::geom::vector::{dot, length};
use crate::model::ranking::ClearanceSum;
use crate::score::evaluation::coupled::CoupledChoice;
use crate::score::evaluation::evaluate::Evaluator;
use crate::score::evaluation::pose_tables::{PlacedJoint, PoseTable};
use crate::score::evaluation::spectrum::dot_product;
use crate::score::evaluation::terms::Floor;
use ozols_dense::{Matrix, difference, norm, svd, thin_svd};

/// Steps of each problem.
const STEPS: usize = 60;
/// Singular values below this fraction of the greatest are none.
const NONE: f64 = 1e-10;
/// What rounding may have added to a bound.
const MARGIN: f64 = 1e-6;

/// A vector at each of some joints, an affine function of what the common equations leave open, with a limit or weight.
struct AffineLoads {
    /// Its capacity, or its clearance.
    limit: f64,
    /// The vector where the open coordinates are 0.
    fixed: [f64; 3],
    /// The contribution of each open coordinate.
    open: Vec<[f64; 3]>,
}

/// The solutions of the common equations for the contours' wrenches.
pub(super) struct Common {
    /// A solution, unknowns × cases.
    pub(super) solution: Vec<f64>,
    cases: usize,
    /// Orthonormal directions they leave open, each over the unknowns.
    pub(super) open: Vec<Vec<f64>>,
    /// The least singular value of the equations, and at most 1.
    pub(super) least: f64,
}

impl Common {
    /// Returns an equation over the open directions, and then its right sides.
    pub(super) fn restrict_equation(&self, equation: &[f64]) -> Vec<f64> {
        let (row, right) = equation.split_at(equation.len() - self.cases);
        let gap = |(case, b): (usize, &f64)| {
            let values = self.solution.iter().skip(case).step_by(self.cases);
            b - row.iter().zip(values).map(|(a, x)| a * x).sum::<f64>()
        };
        let open = self
            .open
            .iter()
            .map(|direction| dot_product(row, direction));
        open.chain(right.iter().enumerate().map(gap)).collect()
    }
}

impl Evaluator<'_> {
    /// Returns lower bounds for every variant of the search, 0 if none is known.
    ///
    /// # Complexity
    /// Some hundred least squares problems of 3 joints × freedoms for each pose and output, the first time.
    pub fn least_terms(&self) -> Floor {
        *self.floor.get_or_init(|| self.compute_floor())
    }

    fn compute_floor(&self) -> Floor {
        let mut out = Floor::default();
        for table in self.pose_tables() {
            let Some(common) = common_equations(table) else {
                continue;
            };
            let meshing = meshing_of_all(table);
            // What passes beside a joint in some variants and through it in others is not bounded.
            let decided = |p: &&PlacedJoint| {
                let mut all = p.couplings.iter();
                all.all(|at| meshing[at.coupling].is_some())
            };
            let mesh: Vec<bool> = meshing.iter().map(|m| m.unwrap_or(false)).collect();
            let parts = |of: &dyn Fn(&PlacedJoint) -> Option<f64>, case: usize, moment: bool| {
                let places = table.places.iter().filter(decided);
                let one = |p| {
                    let limit = of(p)?;
                    let borne = |x: &[f64]| {
                        let (force, turning) =
                            table.borne_at(p, &table.wrench_at(p, case, x, &mesh));
                        if moment { turning } else { force }
                    };
                    let (fixed, open) = affine_load(&common, case, &borne);
                    Some(AffineLoads { limit, fixed, open })
                };
                places.filter_map(one).collect::<Vec<AffineLoads>>()
            };
            let force = parts(&|p| greatest_capacity(table, p, |(f, _)| Some(f)), 0, false);
            let moment = parts(&|p| greatest_capacity(table, p, |(_, m)| m), 0, true);
            out.force = out.force.max(least_peak(&force));
            out.moment = out.moment.max(least_peak(&moment));
            for output in 0..table.cases / 3 {
                let square: f64 = (0..3)
                    .map(|axis| {
                        let case = 1 + 3 * output + axis;
                        let all = parts(&|p| Some(least_clearance(table, p)), case, false);
                        match self.clearance {
                            ClearanceSum::Worst => least_sum(&all).powi(2),
                            ClearanceSum::Rms => least_square(&all) / 3.0,
                        }
                    })
                    .sum();
                out.output_error = out.output_error.max(square.sqrt());
            }
        }
        Floor {
            force: out.force * (1.0 - MARGIN),
            moment: out.moment * (1.0 - MARGIN),
            output_error: out.output_error * (1.0 - MARGIN),
        }
    }
}

/// Returns for each coupling whether its teeth mesh in every variant or in none. `None` if that depends on the variant.
fn meshing_of_all(table: &PoseTable) -> Vec<Option<bool>> {
    let mut seen: Vec<Vec<CoupledChoice>> = vec![Vec::new(); table.couplings];
    for place in &table.places {
        for (n, at) in place.couplings.iter().enumerate() {
            let choices = table.cells[place.variable].iter();
            seen[at.coupling].extend(choices.map(|c| c[place.slot].coupled[n]));
        }
    }
    let alike = |seen: &Vec<CoupledChoice>| {
        let all = |wanted| seen.iter().all(|c| *c == wanted);
        if all(CoupledChoice::BearsTeeth) {
            Some(true)
        } else {
            all(CoupledChoice::AlongFreedom).then_some(false)
        }
    };
    seen.iter().map(alike).collect()
}

/// Returns the greatest capacity that a choice gives a place. `None` if a choice has no capacity of the kind that counts.
fn greatest_capacity(
    table: &PoseTable,
    place: &PlacedJoint,
    of: impl Fn((f64, Option<f64>)) -> Option<f64>,
) -> Option<f64> {
    let mut best: Option<f64> = None;
    for choice in &table.cells[place.variable] {
        let bears = choice[place.slot].bears.iter();
        let weakest = bears.filter_map(|&b| of(b)).reduce(f64::min)?;
        best = Some(best.map_or(weakest, |b| b.max(weakest)));
    }
    best
}

fn least_clearance(table: &PoseTable, place: &PlacedJoint) -> f64 {
    let choices = table.cells[place.variable].iter();
    let least = choices.map(|c| c[place.slot].clearance).reduce(f64::min);
    least.unwrap_or(0.0)
}

/// Returns the equations of a place that hold for every variant: rows in the span of those of each choice.
pub(in crate::score) fn common_rows<'t>(
    table: &'t PoseTable,
    place: &PlacedJoint,
) -> Vec<&'t Vec<f64>> {
    let width = table.basis.len() + table.couplings;
    let choices = &table.cells[place.variable];
    let kept = |row: &&Vec<f64>| {
        let mut all = choices.iter();
        all.all(|c| is_in_span(row, &c[place.slot].rows, width))
    };
    let first = choices.first().into_iter();
    let rows = first.flat_map(|c| &c[place.slot].rows);
    rows.filter(kept).collect()
}

/// Returns the solutions of the equations that hold for every variant.
pub(super) fn common_equations(table: &PoseTable) -> Option<Common> {
    let unknowns = table.count_unknowns();
    let of_place = |place| {
        let own = common_rows(table, place).into_iter();
        own.map(move |row| table.whole_row(place, row))
    };
    let rows: Vec<Vec<f64>> = table.places.iter().flat_map(of_place).collect();
    let matrix = Matrix::from_fn(rows.len(), unknowns, |r, c| rows[r][c]);
    let right = Matrix::from_fn(rows.len(), table.cases, |r, c| rows[r][unknowns + c]);
    let svd = svd(&matrix)?;
    let rank = svd.rank(NONE);
    let x = svd.least_norm(rank, &right);
    let solution = (0..unknowns)
        .flat_map(|u| (0..table.cases).map(move |c| (u, c)))
        .map(|(u, c)| x[(u, c)])
        .collect();
    let open = (rank..unknowns).map(|j| svd.v.col(j).to_vec()).collect();
    Some(Common {
        solution,
        cases: table.cases,
        open,
        least: svd.values[..rank].iter().copied().fold(1.0, f64::min),
    })
}

/// Returns whether a unit twist, with its entries in couplings up to the given width, is in the span of others. Its right sides are then
/// determined, because they are linear in the twist.
pub(in crate::score) fn is_in_span(row: &[f64], others: &[Vec<f64>], width: usize) -> bool {
    let Some(svd) = thin_svd(&Matrix::from_fn(others.len(), width, |r, c| others[r][c])) else {
        return false;
    };
    let basis = svd.v.cols(0..svd.rank(NONE));
    let along = basis.transpose_times(&Matrix::from_column(&row[..width]));
    norm(&difference(&row[..width], basis.times(&along).col(0))) <= NONE
}

/// Returns the load of a place in one load case where the coordinates that the common equations leave open are 0, and the contribution of
/// each of these coordinates.
pub(super) fn affine_load<const N: usize>(
    common: &Common,
    case: usize,
    borne: &dyn Fn(&[f64]) -> [f64; N],
) -> ([f64; N], Vec<[f64; N]>) {
    let fixed = borne(&common.solution);
    let mut x = common.solution.clone();
    let open = common.open.iter().map(|direction| {
        for (u, d) in direction.iter().enumerate() {
            let at = u * common.cases + case;
            x[at] = common.solution[at] + d;
        }
        let there = borne(&x);
        std::array::from_fn(|i| there[i] - fixed[i])
    });
    let open = open.collect();
    (fixed, open)
}

/// Returns the vectors at which Σ weight · |vector|² is least.
fn weighted_least(parts: &[AffineLoads], weights: &[f64]) -> Option<Vec<[f64; 3]>> {
    let open = parts.first()?.open.len();
    let mut out: Vec<[f64; 3]> = parts.iter().map(|p| p.fixed).collect();
    if open == 0 {
        return Some(out);
    }
    let root = |r: usize| weights[r / 3].sqrt();
    let matrix = Matrix::from_fn(3 * parts.len(), open, |r, c| {
        root(r) * parts[r / 3].open[c][r % 3]
    });
    let right = Matrix::from_fn(3 * parts.len(), 1, |r, _| {
        -root(r) * parts[r / 3].fixed[r % 3]
    });
    let svd = thin_svd(&matrix)?;
    let y = svd.least_norm(svd.rank(NONE), &right);
    for (out, part) in out.iter_mut().zip(parts) {
        for (c, direction) in part.open.iter().enumerate() {
            for i in 0..3 {
                out[i] += direction[i] * y[(c, 0)];
            }
        }
    }
    Some(out)
}

/// Returns a lower bound on the greatest |vector| / limit. It uses z = weight · vector at the least squares. Σ z · vector is
/// the same for every open choice, and at most Σ |z| limit · peak.
fn least_peak(parts: &[AffineLoads]) -> f64 {
    let mut share = vec![1.0 / parts.len().max(1) as f64; parts.len()];
    let mut best = 0.0;
    for _ in 0..STEPS {
        let weights: Vec<f64> = share
            .iter()
            .zip(parts)
            .map(|(s, p)| s / p.limit.powi(2))
            .collect();
        let Some(at) = weighted_least(parts, &weights) else {
            break;
        };
        let (mut work, mut most) = (0.0, 0.0);
        for ((w, v), p) in weights.iter().zip(&at).zip(parts) {
            work += w * dot(*v, *v);
            most += w * length(*v) * p.limit;
        }
        if most <= 0.0 {
            break;
        }
        best = f64::max(best, work / most);
        for ((s, v), p) in share.iter_mut().zip(&at).zip(parts) {
            *s *= length(*v) / p.limit;
        }
        let whole: f64 = share.iter().sum();
        share.iter_mut().for_each(|s| *s /= whole);
    }
    best
}

/// Returns a lower bound on Σ limit · |vector|, by a z of the same kind with |z| at most the limit.
fn least_sum(parts: &[AffineLoads]) -> f64 {
    let mut weights: Vec<f64> = parts.iter().map(|p| p.limit).collect();
    let mut best = 0.0;
    for _ in 0..STEPS {
        let Some(at) = weighted_least(parts, &weights) else {
            break;
        };
        let greatest = at.iter().map(|v| length(*v)).fold(0.0, f64::max);
        if greatest <= 0.0 {
            break;
        }
        let each = || weights.iter().zip(&at).zip(parts);
        let work: f64 = each().map(|((w, v), _)| w * dot(*v, *v)).sum();
        let scale = each()
            .filter(|((w, v), _)| **w * length(**v) > 0.0)
            .map(|((w, v), p)| p.limit / (w * length(*v)))
            .fold(f64::INFINITY, f64::min);
        if scale.is_finite() {
            best = f64::max(best, scale * work);
        }
        for ((w, v), p) in weights.iter_mut().zip(&at).zip(parts) {
            *w = p.limit / length(*v).max(1e-9 * greatest);
        }
    }
    best
}

/// Returns the least Σ (limit · |vector|)².
fn least_square(parts: &[AffineLoads]) -> f64 {
    let weights: Vec<f64> = parts.iter().map(|p| p.limit.powi(2)).collect();
    let at = weighted_least(parts, &weights).unwrap_or_default();
    weights.iter().zip(&at).map(|(w, v)| w * dot(*v, *v)).sum()
}
