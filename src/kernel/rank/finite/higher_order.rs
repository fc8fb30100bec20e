//! Exact analysis of higher order: power series of the closed poses near a pose, modulo a prime.
//!
//! The contours are products of exponentials, so their power series are exact in the field. They are solved order by
//! order for the coordinates that J determines. As many equations g(x) = 0 in the free coordinates x remain as J has
//! dependent rows. The closed poses near this one are the zeros of g [Lyapunov-Schmidt reduction; for mechanisms:
//! Lerbet 1999; Müller 2016, "Higher-order analysis of kinematic singularities"].
//!
//! Take the powers of degree d of the variables of a random subspace of m dimensions. If they all lie in the ideal of
//! g's series (a rank, of the Macaulay matrix up to degree d), the pose is isolated there, even with complex
//! coordinates. Then no motion through it has more than n - m dimensions [Bates, Hauenstein, Peterson & Sommese 2009,
//! "A numerical local dimension test"; Dayton & Zeng 2005].
//!
//! A nonzero minor modulo the prime is a nonzero minor, so both are proven if J has its true rank modulo the prime.
//! With m = n nothing moves. For n = 1 that is shakiness of order d - 1, for d = 2 the second-order test of Connelly &
//! Whiteley 1996.

mod line;

pub use line::Line;

use crate::closure::Closure;
use crate::closure::twist::{FrameValues, MotionSpace};
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::{Echelon, transpose};
use crate::linalg::modp::{Field, Residue};
use crate::model::mechanism::{JointId, Mechanism};
use crate::rank::finite::higher_order::line::{Expansion, Solved};
use crate::rank::finite::power_series::Monomials;

/// Number of entries of J² up to which series are used.
const LARGEST: usize = 40_000;
/// Maximum number of products per query.
const WORK: usize = 6_000_000;
/// Factor on the number of products for the Macaulay matrices.
const MATRICES: usize = 8;
/// Order up to which one motion is expanded if no bound is known.
pub(crate) const ORDER: usize = 64;
/// Degree up to which series of several variables are expanded.
const DEGREE: usize = 16;

/// The contours of a mechanism in an exact field, solved for the coordinates that J determines.
#[derive(Debug)]
pub struct HigherOrder {
    solved: Solved,
    /// For each free column, its index and the pivots' coordinates at unit speed.
    free: Vec<(usize, Vec<Residue>)>,
}

impl HigherOrder {
    /// Prepares a mechanism whose J has this rank. Returns `None` if it is too large.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value in the field.
    ///
    /// # Complexity
    /// O((6k)² f).
    pub fn new(
        exact: &ExactField,
        mechanism: &Mechanism,
        closure: &Closure<Residue>,
        rank: usize,
    ) -> Result<Option<HigherOrder>, ExactError> {
        let field = exact.field();
        let f = closure.columns.len();
        let rows = 6 * closure.contours.len() + closure.couplings.len();
        if rows * f > LARGEST {
            return Ok(None);
        }
        let space = MotionSpace::new(exact, &mechanism.mode)?;
        let mut twists = vec![Vec::new(); f];
        // The columns of each joint, in the order of passage.
        let mut passed = vec![Vec::new(); mechanism.joints.len()];
        for j in mechanism.joints_in(closure.state) {
            let joint = &mechanism.joints[j];
            let frame = FrameValues::new(exact, &joint.frame)?;
            let freedoms = joint.joint_type.freedoms();
            for (freedom, twist) in frame.motions_in_series(exact, &space, freedoms) {
                let mut columns = closure.columns.iter();
                if let Some(c) = columns.position(|c| (c.joint, c.freedom) == (j, freedom)) {
                    twists[c] = twist.to_vec();
                    passed[j].push(c);
                }
            }
        }
        let walk = |&(j, forward): &(JointId, bool)| {
            let mut own = passed[j].clone();
            if !forward {
                own.reverse();
            }
            own.into_iter().map(move |c| (c, forward))
        };
        let contours = closure.contours.iter();
        let walks = contours.map(|c| c.joints.iter().flat_map(walk).collect());
        let walks: Vec<Vec<(usize, bool)>> = walks.collect();
        // [J | 1]
        let in_space = closure.with_twists(6, |c| twists[c].clone());
        let mut beside_unit = transpose(&in_space.dense_columns(exact));
        for (i, row) in beside_unit.iter_mut().enumerate() {
            row.resize(f + rows, field.zero());
            row[f + i] = field.one();
        }
        let span = Echelon::from_vectors(field, beside_unit);
        // Pivots beyond J belong to its dependent rows.
        let mut pivots = span.pivots();
        pivots.retain(|&p| p < f);
        if pivots.len() != rank {
            return Ok(None);
        }
        let matrix = span.reduced_rows();
        let free = (0..f)
            .filter(|c| !pivots.contains(c))
            .map(|c| (c, (0..rank).map(|i| field.neg(matrix[i][c])).collect()))
            .collect();
        let solve = matrix.into_iter().map(|row| row[f..].to_vec()).collect();
        Ok(Some(HigherOrder {
            solved: Solved {
                field,
                twists,
                walks,
                solve,
                pivots,
            },
            free,
        }))
    }

    /// Returns the degree d that proves the pose isolated in a random subspace of `m` dimensions of its instantaneous
    /// motions. Returns `None` if no degree within the work limit does.
    ///
    /// The terms of a degree follow from expansions along as many random lines as there are monomials of that degree.
    ///
    /// # Complexity
    /// About `WORK` products and a few times as many for the Macaulay matrices.
    #[must_use]
    pub fn isolating_degree(&self, m: usize) -> Option<usize> {
        if m == 1 {
            return self.random_line(ORDER).stopped;
        }
        let field = self.solved.field;
        let f = self.solved.twists.len();
        let mut monomials = Monomials::new(m);
        let span = self.random_subspace(m);
        let mut random = unrelated_numbers(field);
        let mut lines: Vec<(Vec<Residue>, Expansion<'_>)> = Vec::new();
        let mut g: Vec<Vec<Residue>> =
            vec![Vec::new(); self.solved.solve.len() - self.solved.pivots.len()];
        let mut work = 0;
        for degree in 2..=DEGREE {
            monomials.extend(degree);
            let terms = monomials.of_degree(degree);
            work += f * (27 + degree) * monomials.count_pairs()
                + self.solved.solve.len().pow(2) * terms.end;
            if work > WORK {
                return None;
            }
            while lines.len() < terms.len() {
                let at: Vec<Residue> = (0..m).map(|_| random()).collect();
                let speeds: Vec<Residue> = span.iter().map(|q| field.dot(q, &at)).collect();
                let mut line = Expansion::from_speeds(&self.solved, &speeds);
                (2..degree).for_each(|_| {
                    line.next_order(|_| 0);
                });
                lines.push((at, line));
            }
            let values = lines.iter_mut().map(|(at, line)| {
                let powers = terms.clone().map(|t| monomials.value(field, t, at));
                powers.chain(line.next_order(|_| 0)).collect::<Vec<_>>()
            });
            let solved = Echelon::from_vectors(field, values.collect::<Vec<_>>());
            if !solved.pivots().into_iter().eq(0..terms.len()) {
                return None;
            }
            let rows = solved.reduced_rows();
            for (i, series) in g.iter_mut().enumerate() {
                series.resize(terms.start, 0);
                series.extend(rows.iter().map(|row| row[terms.len() + i]));
            }
            match monomials.all_in_ideal(field, &g, MATRICES * WORK) {
                Some(true) => return Some(degree),
                Some(false) => {}
                None => return None,
            }
        }
        None
    }

    /// Expands one motion in a random direction, to a higher order than is possible for several together.
    #[must_use]
    pub fn random_line(&self, order: usize) -> Line {
        let speeds: Vec<Residue> = self.random_subspace(1).iter().map(|q| q[0]).collect();
        line::expand_line(&self.solved, &speeds, None, order).0
    }

    /// Expands a motion in the direction of these weights of the free coordinates, to an order. Returns the outcome,
    /// and the coordinates of all columns as series from t¹ on.
    #[must_use]
    pub(crate) fn motion_along(
        &self,
        weights: &[Residue],
        order: usize,
    ) -> (Line, Vec<Vec<Residue>>) {
        line::expand_line(&self.solved, &self.speeds_along(weights), None, order)
    }

    /// Expands a motion with free coordinates of these weights times t, and of further ones times t².
    #[must_use]
    pub(super) fn bent_line(&self, weights: &[Residue], bent: &[Residue], order: usize) -> Line {
        let [speeds, bent] = [weights, bent].map(|w| self.speeds_along(w));
        line::expand_line(&self.solved, &speeds, Some(&bent), order).0
    }

    /// Returns the equations in the free coordinates to second order at these weights.
    #[must_use]
    pub(super) fn second_order(&self, weights: &[Residue]) -> Vec<Residue> {
        Expansion::from_speeds(&self.solved, &self.speeds_along(weights)).next_order(|_| 0)
    }

    /// Returns the field and the number of free coordinates.
    pub(crate) fn free_coordinates(&self) -> (Field, usize) {
        (self.solved.field, self.free.len())
    }

    /// Returns the coordinates to first order, if the free ones have these weights.
    fn speeds_along(&self, weights: &[Residue]) -> Vec<Residue> {
        let mut q = vec![0; self.solved.twists.len()];
        for ((c, speeds), &x) in self.free.iter().zip(weights) {
            q[*c] = x;
            for (&p, &s) in self.solved.pivots.iter().zip(speeds) {
                q[p] = self.solved.field.add(q[p], self.solved.field.mul(x, s));
            }
        }
        q
    }

    /// Returns `m` random instantaneous motions: their speeds for each column.
    fn random_subspace(&self, m: usize) -> Vec<Vec<Residue>> {
        let mut random = unrelated_numbers(self.solved.field);
        let weights: Vec<Vec<Residue>> = (0..self.free.len())
            .map(|_| (0..m).map(|_| random()).collect())
            .collect();
        let mut q: Vec<Vec<Residue>> = vec![Vec::new(); self.solved.twists.len()];
        for v in 0..m {
            let along: Vec<Residue> = weights.iter().map(|w| w[v]).collect();
            let speeds = self.speeds_along(&along);
            q.iter_mut().zip(speeds).for_each(|(q, x)| q.push(x));
        }
        q
    }
}

/// Returns numbers unrelated to the geometry, always the same, by xorshift64*.
fn unrelated_numbers(field: Field) -> impl FnMut() -> Residue {
    let mut random = 0x9e37_79b9_7f4a_7c15_u64;
    move || {
        random ^= random >> 12;
        random ^= random << 25;
        random ^= random >> 27;
        field.from_i64((random.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 2) as i64)
    }
}
