//! The transposed closure equations of the freedoms, solved by their singular values.

use crate::statics::reactions::drives::Driven;
use crate::statics::reactions::geometry::{Column, Geometry, Six, TOLERANCE, about, power};
use crate::statics::reactions::unsolved::Unsolved;
use faer::Mat;
use faer::linalg::solvers::Svd;

/// The equations of the freedoms that no drive holds.
pub(crate) struct System<'g> {
    geometry: &'g Geometry,
    /// Columns of the geometry.
    pub(crate) equations: Vec<usize>,
    unknowns: usize,
    svd: Option<Svd<f64>>,
    values: Vec<f64>,
    rank: usize,
}

impl<'g> System<'g> {
    pub(crate) fn new(geometry: &'g Geometry, drives: &[Driven]) -> Result<Self, Unsolved> {
        let held = |c: &Column| drives.contains(&(c.joint, c.freedom));
        let equations: Vec<usize> = (0..geometry.columns.len())
            .filter(|&c| !held(&geometry.columns[c]))
            .collect();
        let unknowns = geometry.basis.len() * geometry.contours.len();
        let rows: Vec<Vec<f64>> = equations
            .iter()
            .map(|&c| geometry.row(&geometry.columns[c]))
            .collect();
        let mut svd = None;
        let mut values = Vec::new();
        if !rows.is_empty() && unknowns > 0 {
            let a = Mat::from_fn(rows.len(), unknowns, |r, c| rows[r][c]);
            let found = a.svd().map_err(|_| Unsolved::NoConvergence)?;
            let s = found.S().column_vector();
            values = (0..s.nrows()).map(|i| s[i]).collect();
            if values.iter().any(|v| !v.is_finite()) {
                return Err(Unsolved::NoConvergence);
            }
            svd = Some(found);
        }
        let greatest = values.first().copied().unwrap_or(0.0);
        let rank = values
            .iter()
            .filter(|&&v| v > 0.0 && v > TOLERANCE * greatest)
            .count();
        Ok(System {
            geometry,
            equations,
            unknowns,
            svd,
            values,
            rank,
        })
    }

    pub(crate) fn undriven(&self) -> usize {
        self.equations.len() - self.rank
    }

    pub(crate) fn condition(&self) -> f64 {
        match self.rank.checked_sub(1) {
            Some(last) => self.values[0] / self.values[last],
            None => 1.0,
        }
    }

    /// What the joints' wrenches do on the freedoms of the equations.
    fn work(&self, wrenches: &[Six]) -> Vec<f64> {
        let columns = self.equations.iter().map(|&c| &self.geometry.columns[c]);
        columns
            .map(|c| power(&c.twist, &wrenches[c.joint]))
            .collect()
    }

    /// Adds contour wrenches so that no freedom is worked on, as far as that goes; what work is left.
    pub(crate) fn solve(&self, wrenches: &mut [Six]) -> Vec<f64> {
        let Some(svd) = &self.svd else {
            return self.work(wrenches);
        };
        // The second round takes away the first one's rounding errors.
        for _ in 0..2 {
            let work = self.work(wrenches);
            let mut coefficients = vec![0.0; self.unknowns];
            for i in 0..self.rank {
                let share: f64 = work
                    .iter()
                    .enumerate()
                    .map(|(r, x)| svd.U()[(r, i)] * x)
                    .sum();
                let share = -share / self.values[i];
                for (c, x) in coefficients.iter_mut().enumerate() {
                    *x += share * svd.V()[(c, i)];
                }
            }
            self.geometry.add_round(&coefficients, wrenches);
        }
        self.work(wrenches)
    }

    /// Independent sets of wrenches that are in equilibrium by themselves, by joint.
    pub(crate) fn self_stresses(&self, joints: usize) -> Vec<Vec<Six>> {
        let one = |i: usize| {
            let mut coefficients = vec![0.0; self.unknowns];
            for (c, x) in coefficients.iter_mut().enumerate() {
                *x = match &self.svd {
                    Some(svd) => svd.V()[(c, i)],
                    None => f64::from(u8::from(c == i)),
                };
            }
            let mut out = vec![[0.0; 6]; joints];
            self.geometry.add_round(&coefficients, &mut out);
            let sizes = self.geometry.joints.iter();
            let greatest = sizes
                .flat_map(|&j| about(&out[j], self.geometry.points[j]))
                .fold(0.0, |a: f64, x| a.max(x.abs()));
            out.iter_mut().flatten().for_each(|x| *x /= greatest);
            out
        };
        (self.rank..self.unknowns).map(one).collect()
    }
}
