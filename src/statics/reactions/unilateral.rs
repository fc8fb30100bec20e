//! Reactions in which contacts only push: of all that are in equilibrium, those of minimum norm within the contacts' cones.
//!
//! The reactions are a particular solution plus any multiples of the self-stresses, so equilibrium is kept whatever the
//! multiples. They are found by a second-order cone programme: a normal force is not negative, friction lies in its round
//! cone, and the pressure has its centre on the face.

use crate::statics::reactions::contact::{Contact, Touch};
use crate::statics::reactions::geometry::{Geometry, Six, about};
use crate::statics::reactions::unsolved::Unsolved;
use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT,
    SupportedConeT::{NonnegativeConeT, SecondOrderConeT},
};

/// Rows `value = first + Σ xᵢ stressᵢ`, each value by its cone.
struct Rows {
    columns: usize,
    rows: Vec<Vec<f64>>,
    right: Vec<f64>,
    cones: Vec<SupportedConeT<f64>>,
}

impl Rows {
    /// A value by the number of the wrenches: 0 for the particular solution, then the self-stresses.
    fn push(&mut self, value: impl Fn(usize) -> f64) {
        self.right.push(value(0));
        self.rows
            .push((1..=self.columns).map(|i| -value(i)).collect());
    }
}

fn rows(geometry: &Geometry, contacts: &[Contact], all: &[&[Six]]) -> Rows {
    let mut out = Rows {
        columns: all.len() - 1,
        rows: Vec::new(),
        right: Vec::new(),
        cones: Vec::new(),
    };
    for contact in contacts {
        let own: Vec<Six> = all.iter().map(|w| contact.own(geometry, w)).collect();
        let [tilt, turn, along, normal] = [0, 2, 3, 5];
        out.push(|i| own[i][normal]);
        out.cones.push(NonnegativeConeT(1));
        for (limit, from) in [(contact.friction, along), (contact.radius, tilt)] {
            let Some(limit) = limit else { continue };
            out.push(|i| limit * own[i][normal]);
            out.push(|i| own[i][from]);
            out.push(|i| own[i][from + 1]);
            out.cones.push(SecondOrderConeT(3));
        }
        if let Some(limit) = contact.torsion() {
            out.push(|i| limit * own[i][normal] - own[i][turn]);
            out.push(|i| limit * own[i][normal] + own[i][turn]);
            out.cones.push(NonnegativeConeT(2));
        }
    }
    out
}

/// Changes wrenches in equilibrium by self-stresses to those of minimum norm in which contacts do what faces can.
///
/// # Guarantee
/// Equilibrium is that of the wrenches given, to rounding; cones and norm are to 1e-7 of the greatest reaction.
///
/// # Errors
/// [`Unsolved::Loose`] where there are none: the object slips, lifts off or tilts.
pub(crate) fn pushing(
    geometry: &Geometry,
    contacts: &[Contact],
    wrenches: &mut [Six],
    stresses: &[Vec<Six>],
) -> Result<(), Unsolved> {
    let allowed = |w: &[Six]| {
        let mut each = contacts.iter().map(|c| c.force(geometry, w).touch);
        each.all(|t| matches!(t, Touch::Pushes | Touch::Idle))
    };
    // That of minimum norm is the answer where its contacts push.
    if allowed(wrenches) {
        return Ok(());
    }
    let scale = wrenches
        .iter()
        .flatten()
        .fold(0.0, |a: f64, x| a.max(x.abs()));
    if stresses.is_empty() || scale == 0.0 {
        return Err(Unsolved::Loose);
    }
    let particular: Vec<Six> = wrenches.iter().map(|w| w.map(|x| x / scale)).collect();
    let all: Vec<&[Six]> = std::iter::once(&particular[..])
        .chain(stresses.iter().map(|s| &s[..]))
        .collect();
    let rows = rows(geometry, contacts, &all);
    let flat = |w: &[Six]| -> Vec<f64> {
        let each = geometry.joints.iter();
        each.flat_map(|&j| about(&w[j], geometry.points[j]))
            .collect()
    };
    let [first, stressed @ ..] = &all.iter().map(|w| flat(w)).collect::<Vec<_>>()[..] else {
        return Err(Unsolved::Loose);
    };
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let n = stressed.len();
    let (mut at, mut entries) = ((Vec::new(), Vec::new()), Vec::new());
    for c in 0..n {
        for r in 0..=c {
            at.0.push(r);
            at.1.push(c);
            entries.push(product(&stressed[r], &stressed[c]));
        }
    }
    let square = CscMatrix::new_from_triplets(n, n, at.0, at.1, entries);
    let linear: Vec<f64> = stressed.iter().map(|s| product(s, first)).collect();
    let (mut at, mut entries) = ((Vec::new(), Vec::new()), Vec::new());
    for (r, row) in rows.rows.iter().enumerate() {
        for (c, &x) in row.iter().enumerate().filter(|(_, x)| **x != 0.0) {
            at.0.push(r);
            at.1.push(c);
            entries.push(x);
        }
    }
    let cones = CscMatrix::new_from_triplets(rows.rows.len(), n, at.0, at.1, entries);
    let settings = DefaultSettings {
        verbose: false,
        ..DefaultSettings::default()
    };
    let failed = |why: String| Unsolved::Programme(why);
    let mut solver =
        DefaultSolver::new(&square, &linear, &cones, &rows.right, &rows.cones, settings)
            .map_err(|e| failed(e.to_string()))?;
    solver.solve();
    match solver.solution.status {
        SolverStatus::Solved | SolverStatus::AlmostSolved => {}
        SolverStatus::PrimalInfeasible | SolverStatus::AlmostPrimalInfeasible => {
            return Err(Unsolved::Loose);
        }
        other => return Err(failed(format!("{other:?}"))),
    }
    for (x, stress) in solver.solution.x.iter().zip(stresses) {
        for (w, s) in wrenches.iter_mut().flatten().zip(stress.iter().flatten()) {
            *w += x * scale * s;
        }
    }
    // What the solver calls solved must be so by the measure that contacts are judged with.
    match allowed(wrenches) {
        true => Ok(()),
        false => Err(failed("contacts beyond their cones".to_owned())),
    }
}
