//! The freedom of a driven joint that the drive holds.

use crate::model::joint_type::Freedom;
use crate::model::mechanism::{JointId, LinkId, Mechanism, Role};
use crate::statics::reactions::geometry::Geometry;
use crate::statics::reactions::unsolved::Unsolved;
use ozols_dense::{Matrix, svd};

/// A driven joint and the freedom its drive moves.
pub type Driven = (JointId, Freedom);

/// Difference below which shares of the working motion count as equal.
const EQUAL: f64 = 1e-9;

/// Returns the period of the first drive after which the ranges of forces repeat: one turn, if it turns.
#[must_use]
pub fn range_period(drives: &[Driven]) -> Option<f64> {
    let first = drives.first().filter(|(_, f)| !f.is_slide());
    first.map(|_| std::f64::consts::TAU)
}

/// Returns the driven freedom of each driven joint. It is the one named in the file, or otherwise the one with the
/// largest share in the motion of the outputs. If a translation and a rotation have equal shares, the translation
/// counts. An example is the slide of a slider that may also turn about its guide.
///
/// # Errors
/// Returns an error if singular values do not converge.
///
/// # Complexity
/// O(f²·6k).
pub fn driven_freedoms(m: &Mechanism, geometry: &Geometry) -> Result<Vec<Driven>, Unsolved> {
    let named = |c: usize| {
        let column = &geometry.columns[c];
        m.joints[column.joint].may_drive(column.freedom)
    };
    let of = |j: JointId| {
        (0..geometry.columns.len()).filter(move |&c| geometry.columns[c].joint == j && named(c))
    };
    let drives: Vec<JointId> = geometry
        .joints
        .iter()
        .copied()
        .filter(|&j| m.joints[j].drive && of(j).next().is_some())
        .collect();
    let freedom = |c: usize| geometry.columns[c].freedom;
    if drives.iter().all(|&j| of(j).count() == 1) {
        return Ok(drives
            .into_iter()
            .filter_map(|j| Some((j, freedom(of(j).next()?))))
            .collect());
    }
    let working = working_motions(m, geometry)?;
    let share = |c: usize| {
        working
            .iter()
            .map(|speeds| speeds[c] * speeds[c])
            .sum::<f64>()
    };
    let pick = |j: JointId| {
        let greatest = of(j).map(share).fold(0.0, f64::max);
        let equal = |c: &usize| share(*c) >= greatest * (1.0 - EQUAL);
        of(j)
            .filter(equal)
            .find(|&c| freedom(c).is_slide())
            .or(of(j).find(equal))
    };
    Ok(drives
        .into_iter()
        .filter_map(|j| Some((j, freedom(pick(j)?))))
        .collect())
}

/// Returns the speeds of the freedoms in independent motions that move the outputs.
fn working_motions(m: &Mechanism, geometry: &Geometry) -> Result<Vec<Vec<f64>>, Unsolved> {
    let null = geometry.free_motions()?;
    let outputs: Vec<LinkId> = m
        .link_ids()
        .filter(|&l| m.links[l].role == Role::Output)
        .collect();
    let twists: Vec<_> = null
        .iter()
        .map(|speeds| geometry.link_twists(m.links.len(), speeds))
        .collect();
    if null.is_empty() || outputs.is_empty() {
        return Ok(null);
    }
    let motion = Matrix::from_fn(6 * outputs.len(), null.len(), |r, c| {
        twists[c][outputs[r / 6]][r % 6]
    });
    let svd = svd(&motion).ok_or(Unsolved::NoConvergence)?;
    let moving = svd.values.iter().filter(|&&s| s > 1e-9).count();
    let one = |i: usize| {
        let share = |c: usize| null.iter().zip(svd.v.col(i)).map(|(v, x)| v[c] * x).sum();
        (0..geometry.columns.len()).map(share).collect()
    };
    Ok((0..moving.min(svd.rank(1e-9))).map(one).collect())
}
