//! Reactions in which contacts only push: of all in equilibrium, those of minimum norm within the contacts' cones.
//!
//! The reactions are a particular solution plus any multiples of the self-stresses, so equilibrium holds for all
//! multiples. They are found by a second-order cone program. A normal force is not negative, friction and the moment
//! about the normal lie in one elliptic cone, and that moment and tipping share the face (`contact`).

use crate::statics::cone_programme::{ConeProgramme, Row};
use crate::statics::greatest_abs;
use crate::statics::reactions::contact::{Contact, Touch};
use crate::statics::reactions::equations::Transmitted;
use crate::statics::reactions::geometry::{Geometry, Six};
use crate::statics::reactions::unsolved::Unsolved;
use clarabel::solver::SolverStatus;
use clarabel::solver::SupportedConeT::{NonnegativeConeT, SecondOrderConeT};

/// Accuracy of cones and norm, as a fraction of the largest reaction.
pub(crate) const TOLERANCE: f64 = 1e-7;

/// Returns the cones of the contacts. Each value is that of the particular solution, the first of `all`, plus Σ xᵢ
/// times that of self-stress i.
fn contact_cones(geometry: &Geometry, contacts: &[Contact], all: &[&[Six]]) -> ConeProgramme {
    let mut out = ConeProgramme::default();
    for contact in contacts {
        let own: Vec<Six> = all
            .iter()
            .map(|w| contact.contact_wrench(geometry, w))
            .collect();
        let [tilt, turn, along, normal] = [0, 2, 3, 5];
        let value = |of: &dyn Fn(&Six) -> f64, out: &mut ConeProgramme| {
            let stresses = own[1..].iter().enumerate();
            out.add_row(stresses.map(|(i, w)| (i, -of(w))), of(&own[0]));
        };
        value(&|w| w[normal], &mut out);
        out.close_cone(NonnegativeConeT);
        let arm = contact.friction_arm();
        if let Some(friction) = contact.friction {
            value(&|w| friction * w[normal], &mut out);
            value(&|w| w[along], &mut out);
            value(&|w| w[along + 1], &mut out);
            if let Some(arm) = arm {
                value(&|w| w[turn] / arm, &mut out);
            }
            out.close_cone(SecondOrderConeT);
        }
        if let Some(radius) = contact.radius {
            // A moment about the normal, in either direction, uses its share of the face.
            let share = match (contact.friction, arm) {
                (Some(friction), Some(arm)) => radius / (friction * arm),
                _ => 0.0,
            };
            for sign in if share > 0.0 {
                &[1.0, -1.0][..]
            } else {
                &[1.0]
            } {
                value(&|w| radius * w[normal] - sign * share * w[turn], &mut out);
                value(&|w| w[tilt], &mut out);
                value(&|w| w[tilt + 1], &mut out);
                out.close_cone(SecondOrderConeT);
            }
        }
    }
    out
}

/// Adds self-stresses to wrenches in equilibrium to reach those of minimum norm in which contacts are within the limits
/// of their faces.
///
/// # Guarantee
/// Equilibrium is that of the given wrenches, to rounding; cones and norm are to [`TOLERANCE`] of the largest reaction.
///
/// # Errors
/// Returns [`Unsolved::Loose`] if there are none: the clamped part slips, lifts off or tilts.
pub(crate) fn push_only(
    geometry: &Geometry,
    contacts: &[Contact],
    of: &mut Transmitted,
    stresses: &[Transmitted],
) -> Result<(), Unsolved> {
    let allowed = |of: &Transmitted| {
        let own = of.own_wrenches(geometry);
        let mut each = contacts
            .iter()
            .map(|c| c.contact_force(geometry, &own).touch);
        each.all(|t| matches!(t, Touch::Pushes | Touch::Idle))
    };
    // The solution of minimum norm is the result if its contacts push.
    if allowed(of) {
        return Ok(());
    }
    let scale = greatest_abs(of.joints.iter().flatten());
    if stresses.is_empty() || scale == 0.0 {
        return Err(Unsolved::Loose);
    }
    let mut particular = of.clone();
    particular.scale_by(1.0 / scale);
    let first = particular.flat_values(geometry);
    let stressed: Vec<Vec<f64>> = stresses.iter().map(|s| s.flat_values(geometry)).collect();
    let own = std::iter::once(&particular).chain(stresses);
    let own: Vec<Vec<Six>> = own.map(|t| t.own_wrenches(geometry)).collect();
    let all: Vec<&[Six]> = own.iter().map(|w| &w[..]).collect();
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let row = |r: usize| {
        let columns = r..stressed.len();
        let entries = columns.map(|c| (c, product(&stressed[r], &stressed[c])));
        entries.collect()
    };
    let square: Vec<Row> = (0..stressed.len()).map(row).collect();
    let linear: Vec<f64> = stressed.iter().map(|s| product(s, &first)).collect();
    let solution = contact_cones(geometry, contacts, &all)
        .solve_programme(&square, &linear)
        .map_err(Unsolved::Programme)?;
    match solution.status {
        SolverStatus::Solved | SolverStatus::AlmostSolved => {}
        SolverStatus::PrimalInfeasible | SolverStatus::AlmostPrimalInfeasible => {
            return Err(Unsolved::Loose);
        }
        other => return Err(Unsolved::Programme(format!("{other:?}"))),
    }
    for (x, stress) in solution.x.iter().zip(stresses) {
        of.add_multiple(x * scale, stress);
    }
    // The solver's solution must also satisfy the criterion by which contacts are judged.
    if allowed(of) {
        Ok(())
    } else {
        Err(Unsolved::Programme(
            "contacts beyond their cones".to_owned(),
        ))
    }
}
