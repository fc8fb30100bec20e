//! Force closure and form closure of a clamped part, and the margins to their loss.
//!
//! The drives are at rest, and the part is clamped with arbitrary force. Consider contact forces within their cones
//! that balance a load on the part. The load is resisted if such forces exist, that is, if forces and load together do
//! no work on any motion of mechanism and part without the contacts. So both the limits of the jaws and those of the
//! faces count.
//!
//! With normal forces of 1 in total, the resisted loads are a convex set. The part is held against every small load,
//! *force closure*, if the origin is inside. The *margin* is the radius of the largest ball about the origin in the
//! set. *Form closure* is the same without friction.

use crate::geom::vector::{length, scale};
use crate::grip::clamped_part::ClampedPart;
use crate::grip::faces::JawFace;
use crate::grip::resisted_load::{Forces, Resisted};
use crate::statics::cone_programme::SolverEffort;
use crate::statics::reactions::Unsolved;
use crate::statics::reactions::geometry::Six;

/// Load, relative to the normal forces, above which a load counts as resisted without limit.
const LIMIT: f64 = 1e3;
/// Load that is enough to know that a direction is resisted at all. It keeps the numbers of a program at one order of
/// magnitude.
const ENOUGH: f64 = 1.0;
/// Load below which a direction counts as not resisted.
pub const NOTHING: f64 = 1e-6;
/// Relative difference below which loads count as equal.
const TIE: f64 = 1e-6;
/// Relative distance of the bounds below which a load is known well.
const WELL_KNOWN: f64 = 1e-5;
/// Relative distance of the bounds below which a load is known at all.
const KNOWN: f64 = 1e-4;
/// Maximum residual of the balance, relative to the margin.
const LEFT: f64 = 1e-2;
/// Maximum number of steps from a direction to one that is resisted less; a few are enough.
const STEPS: usize = 20;

/// Result of the closure analysis.
#[derive(Debug, Clone, PartialEq)]
pub struct ForceClosure {
    /// Whether every small load is resisted, or `None` if that is within the accuracy of the programs.
    pub closed: Option<bool>,
    /// Lower bound of the margin: the radius of the ball in the hull of the loads resisted along the axes. 0 without
    /// closure.
    pub at_least: f64,
    /// Upper bound of the margin: the smallest load found that is just resisted; [`f64::INFINITY`] if no direction has
    /// a limit.
    pub at_most: f64,
    /// The direction of that load, (moment over the part's size; force) about its middle.
    pub weakest: Six,
    /// Largest loads resisted along the axes, in both directions; [`f64::INFINITY`] if there is no limit.
    pub along: Vec<(Six, f64)>,
}

impl ForceClosure {
    /// Returns true if every small load is known to be resisted.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.closed == Some(true)
    }
}

/// Returns the load up to `cap` in a direction that the faces resist. Several solver settings are tried, and the first
/// result that is good enough is used. Otherwise it is the one with the closest bounds.
fn up_to(forces: &Forces, d: &Six, cap: f64) -> Result<Resisted, Unsolved> {
    let mut best: Option<Resisted> = None;
    for effort in SolverEffort::ALL {
        let found = forces.resist(d, cap, effort)?;
        if found.most <= NOTHING || found.agrees(WELL_KNOWN) {
            return Ok(found);
        }
        let gap = |r: &Resisted| r.most - r.least + r.left;
        if best.as_ref().is_none_or(|b| gap(&found) < gap(b)) {
            best = Some(found);
        }
    }
    best.ok_or_else(|| Unsolved::Programme("no answer".to_owned()))
}

/// Returns the load in a direction and its normal, with the result for a load of up to [`ENOUGH`].
fn resisted(forces: &Forces, d: &Six) -> Result<(f64, Six, Resisted), Unsolved> {
    let small = up_to(forces, d, ENOUGH)?;
    if small.most <= NOTHING {
        return Ok((0.0, small.normal, small));
    }
    let found = if small.most < 0.99 * ENOUGH {
        small.clone()
    } else {
        up_to(forces, d, LIMIT)?
    };
    if found.least > 0.99 * LIMIT {
        Ok((f64::INFINITY, found.normal, small))
    } else if found.agrees(KNOWN) || found.most - found.least < NOTHING {
        Ok((found.least, found.normal, small))
    } else {
        Err(Unsolved::Programme(format!(
            "a load between {:.3e} and {:.3e}",
            found.least, found.most
        )))
    }
}

/// Determines the loads that faces resist, each with its friction.
///
/// # Guarantee
/// `at_least` and `at_most` bracket the margin, to 1e-4 of it. The set is convex, so it contains the hull of the loads
/// resisted along the axes. From each of these, the search continues to where the set is nearest by its tangent planes,
/// which never increases the distance. Round faces are replaced by inscribed polygons, so margins are at most 2 % too
/// small.
///
/// Lack of closure is proven by a motion on which the contacts work in one sense only, or hardly. Closure is reported
/// if the forces found, within their cones, balance loads along all axes to a hundredth of the resulting margin.
/// Otherwise the result is undecided.
///
/// # Sources
/// The margin is that of C. Ferrari, J. Canny, Planning optimal grasps, IEEE Int. Conf. Robotics and Automation, 1992,
/// with normal forces added up.
///
/// # Errors
/// Returns an error if a cone program has no solution.
///
/// # Complexity
/// A few hundred cone programs, each with 3 unknowns per point.
pub fn closure(part: &ClampedPart, faces: &[JawFace]) -> Result<ForceClosure, Unsolved> {
    let forces = Forces::new(part, faces);
    let mut along = Vec::new();
    let mut weakest = (part.axes[0], f64::INFINITY);
    let (mut inverse, mut small_inverse) = (0.0, 0.0);
    let (mut open, mut left) = (false, 0.0f64);
    for axis in &part.axes {
        let (mut least, mut small_least) = (f64::INFINITY, f64::INFINITY);
        for sign in [1.0, -1.0] {
            let mut d = scale(*axis, sign);
            let (mut load, mut normal, small) = resisted(&forces, &d)?;
            along.push((d, load));
            least = least.min(load);
            open |= small.most <= NOTHING;
            small_least = small_least.min(small.least);
            left = left.max(small.left);
            for _ in 0..STEPS {
                // Mirror images are equally weak. Rounding must not prefer one of them.
                if load < weakest.1 * (1.0 - TIE) {
                    weakest = (d, load);
                }
                let size = length(normal);
                if !(size > 0.0 && load > NOTHING && load.is_finite()) {
                    break;
                }
                d = scale(normal, 1.0 / size);
                let next = resisted(&forces, &d)?;
                if next.0 >= load * (1.0 - TIE) {
                    break;
                }
                (load, normal, _) = next;
            }
        }
        inverse += 1.0 / (least * least);
        small_inverse += 1.0 / (small_least * small_least);
    }
    let margin = 1.0 / f64::sqrt(small_inverse);
    let closed = match margin > NOTHING && left <= LEFT * margin {
        _ if open => Some(false),
        true => Some(true),
        false => None,
    };
    let at_least = match closed {
        Some(true) => 1.0 / inverse.sqrt(),
        _ => 0.0,
    };
    Ok(ForceClosure {
        closed,
        at_least: at_least.min(weakest.1),
        at_most: weakest.1,
        weakest: weakest.0,
        along,
    })
}
