//! How firmly the contacts of a clamped mechanism hold a part: force closure, form closure, and how far from their loss.
//!
//! The drives stand still, and the part is clamped as hard as you like. A load on the part is resisted where the contacts can
//! put forces within their cones on it that do no work, together with the load, on any motion the mechanism and the part would
//! have without the contacts: what jaws cannot bear counts as little as what faces cannot give. With normal forces of 1 in all,
//! the loads resisted are a convex set. The part is held against every small load, *force closure*, where the origin is inside;
//! the *margin* is the radius of the greatest ball about the origin in the set. *Form closure* is the same without friction.
//!
//! Shares of parts out of true that contacts hold.

use crate::geom::vector::{length, scale};
use crate::grip::clamped_part::ClampedPart;
use crate::grip::faces::JawFace;
use crate::grip::resisted_load::{Forces, Resisted};
use crate::statics::cone_programme::SolverEffort;
use crate::statics::reactions::Unsolved;
use crate::statics::reactions::geometry::Six;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::SeedableRng;

/// Loads above this, by the normal forces, count as resisted without limit.
const LIMIT: f64 = 1e3;
/// Enough to know that a load is resisted at all: the numbers of a programme stay of one size.
const ENOUGH: f64 = 1.0;
/// Loads below this count as not resisted.
pub const NOTHING: f64 = 1e-6;
/// Loads closer than this part of them are equal.
const TIE: f64 = 1e-6;
/// A load is known well where its bounds are closer than this part of it.
const WELL_KNOWN: f64 = 1e-5;
/// It is known at all where they are closer than this.
const KNOWN: f64 = 1e-4;
/// What is left of balance must be below this part of the margin.
const LEFT: f64 = 1e-2;
/// Most steps from a direction to one that is resisted less; a few are enough.
const STEPS: usize = 20;

/// What the contacts hold.
#[derive(Debug, Clone, PartialEq)]
pub struct ForceClosure {
    /// Whether every small load is resisted; nothing where that is within the accuracy of the programmes.
    pub closed: Option<bool>,
    /// The margin is at least this: the radius of the ball in the hull of the loads resisted along the axes. 0 without closure.
    pub at_least: f64,
    /// The margin is at most this: the smallest load found that is just resisted; [`f64::INFINITY`] where each has no limit.
    pub at_most: f64,
    /// The direction of that load, (moment over the part's size; force) about its middle.
    pub weakest: Six,
    /// Greatest loads resisted along the axes, one way and the other; [`f64::INFINITY`] where there is no limit.
    pub along: Vec<(Six, f64)>,
}

impl ForceClosure {
    /// Whether every small load is known to be resisted.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.closed == Some(true)
    }
}

/// The load up to `cap` in a direction that the faces resist. Of the ways to go about the programme the first that is good
/// enough, else the one whose bounds are closest.
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

/// The load in a direction, with its normal.
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

/// What faces hold, each with its friction.
///
/// # Guarantee
/// `at_least` and `at_most` bracket the margin, to 1e-4 of it: the set is convex, so that it has the hull of the loads resisted
/// along the axes; from each of these the search goes on to where the set is nearest by its tangent planes, which never leads
/// away. Round faces are polygons within them, so that margins are at most 2 % too small. `closed` is that of [`is_closed`].
///
/// # Sources
/// The margin is that of C. Ferrari, J. Canny, Planning optimal grasps, IEEE Int. Conf. Robotics and Automation, 1992, with normal
/// forces added up.
///
/// # Errors
/// Where a cone programme has no answer.
///
/// # Complexity
/// Some hundred cone programmes, each of 3 unknowns a point.
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
                // Mirror images are as weak: rounding must not put one before the other.
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

/// Whether every small load is resisted, and no more: a programme an axis and way, and more where one stalls.
///
/// # Guarantee
/// Not closed is proven by a motion, which the contacts work on in one sense only, or hardly. Closed is said where the forces
/// found, within their cones, balance loads along all axes to a hundredth of the margin these give. Nothing is said otherwise.
///
/// # Errors
/// Where the solver refuses a programme.
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

/// How many samples have closure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClosureShares {
    /// How many there were.
    pub samples: usize,
    /// By how much points and rims are out at most `[m]`.
    pub tolerance: f64,
    /// With force closure.
    pub force_closed: usize,
    /// With form closure.
    pub form_closed: usize,
    /// Of which force closure is within the accuracy of the programmes.
    pub force_undecided: usize,
    /// Of which form closure is.
    pub form_undecided: usize,
}

/// Closure of a part with its contacts out by up to `tolerance` `[m]`, `samples` times; the same seed gives the same answer.
///
/// # Errors
/// Where the solver refuses a programme; one that it stalls at leaves a sample undecided.
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
