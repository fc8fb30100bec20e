//! The transposed closure equations of the freedoms, solved by their singular values.

use crate::statics::reactions::drives::Driven;
use crate::statics::reactions::geometry::{FreedomColumn, Geometry, TOLERANCE, power};
use crate::statics::reactions::transmitted::Transmitted;
use crate::statics::reactions::unsolved::Unsolved;
use ozols_dense::{Matrix, Svd, svd};

/// The equations of the freedoms that no drive holds.
pub(crate) struct System<'g> {
    geometry: &'g Geometry,
    /// Columns of the geometry.
    pub(crate) equations: Vec<usize>,
    unknowns: usize,
    svd: Svd,
    rank: usize,
}

impl<'g> System<'g> {
    pub(crate) fn new(geometry: &'g Geometry, drives: &[Driven]) -> Result<Self, Unsolved> {
        let held = |c: &FreedomColumn| drives.contains(&(c.joint, c.freedom));
        let equations: Vec<usize> = (0..geometry.columns.len())
            .filter(|&c| !held(&geometry.columns[c]))
            .collect();
        let unknowns = geometry.unknowns();
        let rows: Vec<Vec<f64>> = equations
            .iter()
            .map(|&c| geometry.row(&geometry.columns[c]))
            .collect();
        let a = Matrix::from_fn(rows.len(), unknowns, |r, c| rows[r][c]);
        let svd = svd(&a).ok_or(Unsolved::NoConvergence)?;
        let rank = svd.rank(TOLERANCE);
        Ok(System {
            geometry,
            equations,
            unknowns,
            svd,
            rank,
        })
    }

    pub(crate) fn undriven(&self) -> usize {
        self.equations.len() - self.rank
    }

    pub(crate) fn condition(&self) -> f64 {
        match self.rank.checked_sub(1) {
            Some(last) => self.svd.values[0] / self.svd.values[last],
            None => 1.0,
        }
    }

    /// What the joints' wrenches do on the freedoms of the equations, but for what couplings pass there.
    fn work(&self, of: &Transmitted) -> Vec<f64> {
        let columns = self.equations.iter().map(|&c| &self.geometry.columns[c]);
        let one = |c: &FreedomColumn| {
            let coupled = self.geometry.coupling_entries(c);
            let coupled: f64 = coupled.map(|(q, e)| e * of.couplings[q]).sum();
            power(&c.twist, &of.joints[c.joint]) + coupled
        };
        columns.map(one).collect()
    }

    /// Adds contour wrenches and what couplings pass so that no freedom is worked on, as far as that goes; what work is left.
    pub(crate) fn solve(&self, of: &mut Transmitted) -> Vec<f64> {
        // The second round takes away the first one's rounding errors.
        for _ in 0..2 {
            let work = self.work(of);
            let mut coefficients = vec![0.0; self.unknowns];
            for i in 0..self.rank {
                let share: f64 = work.iter().zip(self.svd.u.col(i)).map(|(x, u)| u * x).sum();
                let share = -share / self.svd.values[i];
                for (x, v) in coefficients.iter_mut().zip(self.svd.v.col(i)) {
                    *x += share * v;
                }
            }
            of.add_round(self.geometry, &coefficients);
        }
        self.work(of)
    }

    /// Independent sets of wrenches that are in equilibrium by themselves, by joint, with what couplings pass of them.
    pub(crate) fn self_stresses(&self, joints: usize) -> Vec<Transmitted> {
        let one = |i: usize| {
            let mut out = Transmitted::of_joints(self.geometry, vec![[0.0; 6]; joints]);
            out.add_round(self.geometry, self.svd.v.col(i));
            let all = out.flat(self.geometry).into_iter();
            let greatest = all.fold(0.0, |a: f64, x| a.max(x.abs()));
            out.scale(1.0 / greatest);
            out
        };
        (self.rank..self.unknowns).map(one).collect()
    }
}
