//! Quadratic programs over second-order cones, as they arise from contacts with friction.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolution, DefaultSolver, IPSolver, SupportedConeT};

/// A row of a sparse matrix: (column, entry).
pub(crate) type Row = Vec<(usize, f64)>;

/// Program: minimise ½ xᵀP x + qᵀx subject to `row · x + s = right`, with the slacks s of each group of rows in a cone.
#[derive(Debug, Default)]
pub(crate) struct ConeProgramme {
    rows: Vec<Row>,
    right: Vec<f64>,
    cones: Vec<SupportedConeT<f64>>,
    /// Number of rows that are already in a cone.
    grouped: usize,
}

impl ConeProgramme {
    /// Adds a row.
    pub(crate) fn add_row(&mut self, row: impl IntoIterator<Item = (usize, f64)>, right: f64) {
        self.rows.push(row.into_iter().collect());
        self.right.push(right);
    }

    /// Puts the slacks of the rows since the last cone into a cone.
    pub(crate) fn close_cone(&mut self, cone: impl Fn(usize) -> SupportedConeT<f64>) {
        self.cones.push(cone(self.rows.len() - self.grouped));
        self.grouped = self.rows.len();
    }

    /// Solves the program for the upper triangle of P by rows, and q.
    ///
    /// # Errors
    /// Returns the solver's message if it rejects the program.
    pub(crate) fn solve_programme(
        &self,
        quadratic: &[Row],
        linear: &[f64],
    ) -> Result<DefaultSolution<f64>, String> {
        let columns = linear.len();
        let mut solver = DefaultSolver::new(
            &sparse_matrix(quadratic, columns, columns),
            linear,
            &sparse_matrix(&self.rows, self.rows.len(), columns),
            &self.right,
            &self.cones,
            DefaultSettings {
                verbose: false,
                ..DefaultSettings::default()
            },
        )
        .map_err(|e| e.to_string())?;
        solver.solve();
        Ok(solver.solution)
    }
}

fn sparse_matrix(list: &[Row], rows: usize, columns: usize) -> CscMatrix<f64> {
    let (mut i, mut j, mut v) = (Vec::new(), Vec::new(), Vec::new());
    for (r, row) in list.iter().enumerate() {
        for &(c, x) in row {
            i.push(r);
            j.push(c);
            v.push(x);
        }
    }
    CscMatrix::new_from_triplets(rows, columns, i, j, v)
}
