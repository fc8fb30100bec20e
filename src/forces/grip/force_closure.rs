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
//!
//! The module also computes shares of inaccurate parts that the contacts hold.

use crate::geom::vector::{length, scale};
use crate::grip::clamped_part::ClampedPart;
use crate::grip::faces::JawFace;
use crate::grip::resisted_load::{Forces, Resisted};
use crate::statics::cone_programme::SolverEffort;
use crate::statics::reactions::Unsolved;
use crate::statics::reactions::geometry::Six;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::SeedableRng;

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
fn tried(
    forces: &Forces,
    d: &Six,
    cap: f64,
    enough: impl Fn(&Resisted) -> bool,
) -> Result<Resisted, Unsolved> {
    let mut best: Option<Resisted> = None;
    for effort in SolverEffort::ALL {
        let found = forces.resist(d, cap, effort)?;
        if found.most <= NOTHING || enough(&found) {
            return Ok(found);
        }
        let gap = |r: &Resisted| r.most - r.least + r.left;
        if best.as_ref().is_none_or(|b| gap(&found) < gap(b)) {
            best = Some(found);
        }
    }
    best.ok_or_else(|| Unsolved::Programme("no answer".to_owned()))
}

/// Returns the load in a direction, with its normal.
fn resisted(forces: &Forces, d: &Six) -> Result<(f64, Six), Unsolved> {
    for cap in [ENOUGH, LIMIT] {
        let found = tried(forces, d, cap, |r| r.agrees(WELL_KNOWN))?;
        if found.most <= NOTHING {
            return Ok((0.0, found.normal));
        }
        if cap == LIMIT && found.least > 0.99 * LIMIT {
            return Ok((f64::INFINITY, found.normal));
        }
        if found.most < 0.99 * cap || cap == LIMIT {
            return if found.agrees(KNOWN) || found.most - found.least < NOTHING {
                Ok((found.least, found.normal))
            } else {
                Err(Unsolved::Programme(format!(
                    "a load between {:.3e} and {:.3e}",
                    found.least, found.most
                )))
            };
        }
    }
    Ok((f64::INFINITY, *d))
}

/// Determines the loads that faces resist, each with its friction.
///
/// # Guarantee
/// `at_least` and `at_most` bracket the margin, to 1e-4 of it. The set is convex, so it contains the hull of the loads
/// resisted along the axes. From each of these, the search continues to where the set is nearest by its tangent planes,
/// which never increases the distance. Round faces are replaced by inscribed polygons, so margins are at most 2 % too
/// small. `closed` is that of [`is_closed`].
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
    let mut inverse = 0.0;
    for axis in &part.axes {
        let mut least = f64::INFINITY;
        for sign in [1.0, -1.0] {
            let mut d = scale(*axis, sign);
            let (mut load, mut normal) = resisted(&forces, &d)?;
            along.push((d, load));
            least = f64::min(least, load);
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
                (load, normal) = next;
            }
        }
        inverse += 1.0 / (least * least);
    }
    let closed = is_closed(part, faces)?;
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

/// Determines only whether every small load is resisted: one program per axis and direction, and more if one stalls.
///
/// # Guarantee
/// Lack of closure is proven by a motion on which the contacts work in one sense only, or hardly. Closure is reported
/// if the forces found, within their cones, balance loads along all axes to a hundredth of the resulting margin.
/// Otherwise the result is undecided.
///
/// # Errors
/// Returns an error if the solver rejects a program.
pub fn is_closed(part: &ClampedPart, faces: &[JawFace]) -> Result<Option<bool>, Unsolved> {
    let forces = Forces::new(part, faces);
    let (mut inverse, mut left) = (0.0, 0.0);
    for axis in &part.axes {
        let mut least = f64::INFINITY;
        for sign in [1.0, -1.0] {
            let balanced = |r: &Resisted| r.least > NOTHING && r.left <= LEFT / 10.0 * r.least;
            let found = tried(&forces, &scale(*axis, sign), ENOUGH, balanced)?;
            if found.most <= NOTHING {
                return Ok(Some(false));
            }
            least = f64::min(least, found.least);
            left = f64::max(left, found.left);
        }
        inverse += 1.0 / (least * least);
    }
    let margin = 1.0 / f64::sqrt(inverse);
    Ok((margin > NOTHING && left <= LEFT * margin).then_some(true))
}

/// Numbers of samples with closure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClosureShares {
    /// Number of samples.
    pub samples: usize,
    /// Maximum deviation of points and rims `[m]`.
    pub tolerance: f64,
    /// Number with force closure.
    pub force_closed: usize,
    /// Number with form closure.
    pub form_closed: usize,
    /// Number whose force closure is within the accuracy of the programs.
    pub force_undecided: usize,
    /// Number whose form closure is within it.
    pub form_undecided: usize,
}

/// Computes the closure of a part with its contacts off by up to `tolerance` `[m]`, `samples` times. The same seed
/// gives the same result.
///
/// # Errors
/// Returns an error if the solver rejects a program. A program at which it stalls leaves a sample undecided.
pub fn shares(
    part: &ClampedPart,
    tolerance: f64,
    samples: usize,
    seed: u64,
) -> Result<ClosureShares, Unsolved> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut out = ClosureShares {
        samples,
        tolerance,
        force_closed: 0,
        form_closed: 0,
        force_undecided: 0,
        form_undecided: 0,
    };
    for _ in 0..samples {
        let sample = part.out_of_true(tolerance / part.geometry.size, &mut random);
        let force = is_closed(&sample, &sample.faces)?;
        let form = is_closed(&sample, &sample.smooth())?;
        out.force_closed += usize::from(force == Some(true));
        out.form_closed += usize::from(form == Some(true));
        out.force_undecided += usize::from(force.is_none());
        out.form_undecided += usize::from(form.is_none());
    }
    Ok(out)
}
