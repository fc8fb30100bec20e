//! The self-stresses of a mechanism, part by part: the constraints they load, and the releases that remove them.

use crate::closure::Closure;
use crate::closure::twist::MotionSpace;
use crate::geom::Reals;
use crate::geom::exact::ExactError;
use crate::geom::rigid::{join_twist, perpendicular};
use crate::geom::vector::{Vector, X, Y, Z, across, cross, length, to_vector, unit};
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::rank::finite::independent_parts::independent_parts;
use crate::rank::numeric::scaling::{Scaling, scaled_matrix};
use crate::redundancy::release::{
    ALIKE, Duplicate, Release, orthonormal_span, point_positive, remainder_of,
};
use itertools::Itertools;
use ozols_dense::{Matrix, Svd, dot, norm, solve, svd};

/// Share of a stress of unit length below which it counts as zero.
const NOTHING: f64 = 1e-6;
/// Minimum remaining work of a release, below which rounding decides it.
const LEAST: f64 = 1e-5;
/// Share of the largest work of any release from which on a release is effective.
const WELL: f64 = 0.03;

/// The self-stresses of a part of a mechanism in numbers. Its joints share no contours and couplings with others.
#[derive(Debug)]
pub struct Stressed<'a> {
    mechanism: &'a Mechanism,
    space: MotionSpace<f64>,
    /// J of the part.
    closure: Closure<f64>,
    /// The joints of the part.
    pub joints: Vec<JointId>,
    /// Indices of the contours of the state in the part.
    contours: Vec<usize>,
    /// Indices of the couplings of the state in the part.
    pub couplings: Vec<usize>,
    scaling: Scaling,
    /// An orthonormal basis as columns, in the rows of the scaled J.
    basis: Matrix,
}

impl<'a> Stressed<'a> {
    /// Returns the self-stresses if J has a rank, for each part that has any. `None` if singular values do not converge.
    ///
    /// # Guarantee
    /// Numeric: as reliable as the rank. It depends on the gap in the singular values.
    ///
    /// # Complexity
    /// One decomposition of J of each part.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value.
    ///
    /// # Examples
    /// ```
    /// use ozols::{model::mechanism::StateId, redundancy::stressed::Stressed};
    /// let four_bar = ozols::built_in("four-bar")?;
    /// let parts = Stressed::stressed_parts(&four_bar, StateId::FREE, 3)?.expect("it converges");
    /// assert_eq!(parts.iter().map(|p| p.count_redundant()).sum::<usize>(), 3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn stressed_parts(
        m: &'a Mechanism,
        state: StateId,
        rank: usize,
    ) -> Result<Option<Vec<Self>>, ExactError> {
        let whole = Closure::new(&Reals, m, state)?;
        let parts = whole.split_parts(&independent_parts(&whole));
        let found: Option<Vec<Svd>> = parts
            .iter()
            .map(|p| svd(&scaled_matrix(&p.closure)))
            .collect();
        let Some(found) = found else {
            return Ok(None);
        };
        // The singular values of J are those of its parts, so the largest of all are kept.
        let values = found.iter().enumerate();
        let values = values.flat_map(|(i, svd)| svd.values.iter().map(move |v| (i, *v)));
        let kept = values.sorted_by(|a, b| b.1.total_cmp(&a.1)).take(rank);
        let kept = kept.counts_by(|(i, _)| i);
        if kept.values().sum::<usize>() < rank {
            return Ok(None);
        }
        let space = MotionSpace::new(&Reals, &m.mode)?;
        let all = parts.into_iter().zip(&found).enumerate();
        let all = all.map(|(i, (part, svd))| Stressed {
            mechanism: m,
            space: space.clone(),
            joints: part.joints,
            contours: part.contours,
            couplings: part.couplings,
            scaling: Scaling::of_closure(&part.closure),
            basis: svd.left_null_space(kept.get(&i).copied().unwrap_or(0)),
            closure: part.closure,
        });
        Ok(Some(all.filter(|p| p.count_redundant() > 0).collect()))
    }

    /// Returns σ.
    #[must_use]
    pub fn count_redundant(&self) -> usize {
        self.basis.ncols()
    }

    fn joint_point(&self, joint: JointId) -> Vector {
        to_vector(&self.mechanism.joints[joint].frame.point)
    }

    /// Returns the power of a vector of scaled twist components in the rows of the contours that pass a joint: one
    /// number per stress.
    fn powers_of(&self, joint: JointId, twist: &[f64]) -> Vec<f64> {
        let dim = self.closure.dim;
        let mut out = vec![0.0; self.count_redundant()];
        for (i, contour) in self.closure.contours.iter().enumerate() {
            let Some(forward) = contour.direction_of(joint) else {
                continue;
            };
            let sign = if forward { 1.0 } else { -1.0 };
            for (s, x) in out.iter_mut().enumerate() {
                for (r, t) in twist.iter().enumerate() {
                    *x += sign * t * self.basis[(i * dim + r, s)];
                }
            }
        }
        out
    }

    /// Returns the twist of a freedom, scaled to unit length, or `None` if it leaves the plane of a planar model.
    fn freedom_twist(&self, joint: JointId, slides: bool, d: Vector) -> Option<Vec<f64>> {
        let v = if slides {
            d
        } else {
            cross(self.joint_point(joint), d)
        };
        let w = if slides { [0.0; 3] } else { d };
        let whole = join_twist(w, v);
        let mut twist = self.space.components_in_space(&Reals, &whole)?;
        self.scaling.scale_to_unit(&mut twist);
        Some(twist)
    }

    /// Returns the work of each self-stress on a release.
    #[must_use]
    pub fn release_powers(&self, release: &Release) -> Vec<f64> {
        match *release {
            Release::Freedom {
                joint,
                slides,
                direction,
            } => match self.freedom_twist(joint, slides, direction) {
                Some(twist) => self.powers_of(joint, &twist),
                None => vec![0.0; self.count_redundant()],
            },
            Release::Coupling(q) => {
                let place = self.couplings.iter().position(|&own| own == q);
                let row = place.map(|q| self.closure.contour_rows() + q);
                row.map_or(vec![0.0; self.count_redundant()], |row| self.basis.row(row))
            }
        }
    }

    /// Returns the forces on a joint, or the moments about its point: three numbers per stress, by columns.
    fn carried_loads(&self, joint: JointId, forces: bool) -> Matrix {
        let rows = [X, Y, Z].map(|a| match self.freedom_twist(joint, forces, a) {
            Some(t) => self.powers_of(joint, &t),
            None => vec![0.0; self.count_redundant()],
        });
        Matrix::from_fn(3, self.count_redundant(), |i, s| rows[i][s])
    }

    /// Returns the single freedoms that the joint lacks and on which a self-stress does work. Their directions fit the
    /// forces and moments on the joint, and slides come first.
    ///
    /// # Examples
    /// ```
    /// use ozols::{model::mechanism::StateId, redundancy::stressed::Stressed};
    /// let four_bar = ozols::built_in("four-bar")?;
    /// let part = &Stressed::stressed_parts(&four_bar, StateId::FREE, 3)?.expect("it converges")[0];
    /// // Each hinge may slide along its axis and tilt about two others.
    /// assert!(part.joints.iter().all(|&j| part.releases_at(j).len() == 3));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn releases_at(&self, joint: JointId) -> Vec<Release> {
        let directions = self.joint_directions(joint);
        let own: Vec<Vec<f64>> = {
            let columns = self.closure.columns.iter();
            let of_joint = columns.filter(|c| c.joint == joint);
            let scaled = of_joint.map(|c| {
                let mut t = c.twist.clone();
                self.scaling.scale_to_unit(&mut t);
                t
            });
            orthonormal_span(scaled)
        };
        let each = [true, false].into_iter();
        each.flat_map(|slides| directions.map(|direction| (slides, direction)))
            .filter(|&(slides, d)| {
                let twist = self.freedom_twist(joint, slides, d);
                twist.is_some_and(|t| norm(&remainder_of(&t, &own)) > ALIKE)
            })
            .map(|(slides, direction)| Release::Freedom {
                joint,
                slides,
                direction,
            })
            .filter(|r| norm(&self.release_powers(r)) > LEAST)
            .collect()
    }

    /// Returns three perpendicular directions at a joint: along the single force or moment on it, perpendicular to the
    /// plane of two, and otherwise its own axes.
    fn joint_directions(&self, joint: JointId) -> [Vector; 3] {
        let [x, y, z] = self.mechanism.joints[joint].frame.unit_axes();
        let own = [z, x, y];
        let special = |forces: bool| -> Option<Vector> {
            let found = svd(&self.carried_loads(joint, forces))?;
            let column = |i: usize| [0, 1, 2].map(|r| found.u[(r, i)]);
            match found.values.iter().filter(|v| **v > NOTHING).count() {
                1 => Some(column(0)),
                2 => Some(column(2)),
                _ => None,
            }
        };
        let [forces, moments] = [special(true), special(false)];
        let Some(first) = forces.or(moments).map(|d| settle_direction(d, &own)) else {
            return own;
        };
        // The other two follow the moments, or the joint's own axes.
        let wanted = moments.into_iter().chain(own);
        let mut wanted = wanted.map(|d| across(d, first));
        let second = wanted.find(|d| length(*d) > 0.1).map(unit);
        let second = second.unwrap_or_else(|| unit(perpendicular(first)));
        let second = settle_direction(second, &own);
        [first, second, unit(cross(first, second))].map(point_positive)
    }

    /// Returns the cheapest set of releases that removes all redundant constraints and adds no mobility, by their
    /// indices in the list. Fewer than σ if no such set is among them.
    #[must_use]
    pub fn cheapest_releases(&self, candidates: &[(i64, Release)]) -> Vec<usize> {
        self.choose_releases(candidates, &|i, _| candidates[i].0)
    }

    /// Returns a set of releases chosen one by one, each the cheapest of those that remove more. Costs may depend on
    /// those chosen before, and the whole set is then not necessarily the cheapest. A release that hardly works on a
    /// stress is chosen only as a last resort, because it would have to move far.
    #[must_use]
    pub fn choose_releases(
        &self,
        candidates: &[(i64, Release)],
        cost: &dyn Fn(usize, &[usize]) -> i64,
    ) -> Vec<usize> {
        let powers: Vec<Vec<f64>> = candidates
            .iter()
            .map(|(_, r)| self.release_powers(r))
            .collect();
        let strongest = powers.iter().map(|p| norm(p)).fold(0.0, f64::max);
        let well = self.chosen_above(&powers, LEAST.max(WELL * strongest), cost);
        if well.len() == self.count_redundant() {
            return well;
        }
        self.chosen_above(&powers, LEAST, cost)
    }

    fn chosen_above(
        &self,
        powers: &[Vec<f64>],
        enough: f64,
        cost: &dyn Fn(usize, &[usize]) -> i64,
    ) -> Vec<usize> {
        let (mut chosen, mut span): (Vec<usize>, Vec<Vec<f64>>) = (Vec::new(), Vec::new());
        while span.len() < self.count_redundant() {
            let left = (0..powers.len()).map(|i| (i, norm(&remainder_of(&powers[i], &span))));
            let left: Vec<(usize, f64)> = left.filter(|(_, x)| *x > enough).collect();
            let Some(least) = left.iter().map(|&(i, _)| cost(i, &chosen)).min() else {
                break;
            };
            let alike = left.iter().filter(|(i, _)| cost(*i, &chosen) == least);
            let most = alike.clone().fold(0.0, |m: f64, (_, x)| m.max(*x));
            // The first that is about as good as the best.
            let Some(&(i, _)) = alike.clone().find(|(_, x)| *x > most / 2.0) else {
                break;
            };
            let r = remainder_of(&powers[i], &span);
            span.push(r.iter().map(|x| x / norm(&r)).collect());
            chosen.push(i);
        }
        chosen
    }

    /// Returns the redundant constraints, expressed in the preferred candidates, each with the joints that impose the
    /// same and the releases that remove it.
    #[must_use]
    pub fn find_duplicates(
        &self,
        rows: &[(i64, Release)],
        remedies: &[(i64, Release)],
    ) -> Vec<Duplicate> {
        let chosen = self.cheapest_releases(rows);
        let n = self.count_redundant();
        if chosen.len() < n {
            return Vec::new();
        }
        let powers: Vec<Vec<f64>> = chosen
            .iter()
            .map(|&i| self.release_powers(&rows[i].1))
            .collect();
        let matrix = Matrix::from_fn(n, n, |i, s| powers[i][s]);
        let mut by_cost: Vec<usize> = (0..remedies.len()).collect();
        by_cost.sort_by_key(|&i| remedies[i].0);
        let works: Vec<Vec<f64>> = remedies
            .iter()
            .map(|(_, r)| self.release_powers(r))
            .collect();
        let duplicate = |i: usize| {
            // The stress that works only on this one of the chosen rows.
            let mut right = vec![0.0; n];
            right[i] = 1.0;
            let weights = solve(&matrix, &right);
            let size = norm(&weights);
            let on = |v: &[f64]| (dot(v, &weights) / size).abs() > NOTHING;
            let entry = |r: usize| on(&self.basis.row(r));
            let dim = self.closure.dim;
            let contours = 0..self.closure.contours.len();
            let contours = contours.filter(|k| (k * dim..(k + 1) * dim).any(entry));
            let couplings = 0..self.closure.couplings.len();
            let couplings = couplings.filter(|q| entry(self.closure.contour_rows() + q));
            let row = rows[chosen[i]].1;
            let itself = |j: &JointId| matches!(row, Release::Freedom { joint, .. } if joint == *j);
            let loaded = |j: &JointId| {
                [true, false].into_iter().any(|forces| {
                    let carried = self.carried_loads(*j, forces);
                    (0..3).any(|r| on(&carried.row(r)))
                })
            };
            let joints = self.joints.iter().copied();
            Duplicate {
                row,
                by: joints.filter(|j| !itself(j) && loaded(j)).collect(),
                contours: contours.map(|k| self.contours[k]).collect(),
                couplings: couplings.map(|q| self.couplings[q]).collect(),
                remedies: by_cost.iter().copied().filter(|&r| on(&works[r])).collect(),
            }
        };
        (0..n).map(duplicate).collect()
    }
}

/// Returns a direction, replaced by one of the global or own axes if it is almost equal; its largest component is
/// positive.
fn settle_direction(d: Vector, own: &[Vector; 3]) -> Vector {
    let near = |a: &&Vector| length(cross(**a, d)) < ALIKE;
    let found = own.iter().chain(&[X, Y, Z]).find(near);
    point_positive(found.copied().unwrap_or(d))
}
