//! How firmly the contacts of a clamped mechanism hold a part: force closure, form closure, and how far from their loss.
//!
//! The drives stand still, and the part is clamped as hard as you like. A load on the part is resisted where the contacts can
//! put forces within their cones on it that do no work, together with the load, on any motion the mechanism and the part would
//! have without the contacts: what jaws cannot bear counts as little as what faces cannot give. With normal forces of 1 in all,
//! the loads resisted are a convex set. The part is held against every small load, *force closure*, where the origin is inside;
//! the *margin* is the radius of the greatest ball about the origin in the set. *Form closure* is the same without friction.

use crate::geom::vector::{add, cross, length, scale};
use crate::grip::clamped_part::ClampedPart;
use crate::grip::faces::{Face, Press};
use crate::statics::cone_programme::ConeProgramme;
use crate::statics::reactions::Unsolved;
use crate::statics::reactions::geometry::{Six, power, wrench};
use clarabel::solver::SolverStatus;
use clarabel::solver::SupportedConeT::{NonnegativeConeT, SecondOrderConeT, ZeroConeT};

/// Loads above this, by the normal forces, count as resisted without limit.
const LIMIT: f64 = 1e3;
/// Loads below this count as not resisted.
pub const NOTHING: f64 = 1e-6;
/// Work below this is rounding.
const ROUNDING: f64 = 1e-12;
/// Loads closer than this part of them are equal.
const TIE: f64 = 1e-6;
/// Most steps from a direction to one that is resisted less; a few are enough.
const STEPS: usize = 20;

/// What the contacts hold.
#[derive(Debug, Clone, PartialEq)]
pub struct Closure {
    /// The margin is at least this: the radius of the ball in the hull of the loads resisted along the axes. 0 without closure.
    pub at_least: f64,
    /// The margin is at most this: the smallest load found that is just resisted; [`f64::INFINITY`] where each has no limit.
    pub at_most: f64,
    /// The direction of that load, (moment over the part's size; force) about its middle.
    pub weakest: Six,
    /// Greatest loads resisted along the axes, one way and the other; [`f64::INFINITY`] where there is no limit.
    pub along: Vec<(Six, f64)>,
}

impl Closure {
    /// Whether every small load is resisted.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.at_least > NOTHING
    }
}

/// The greatest load in a direction, with the motion of the part that limits it.
struct Resisted {
    load: f64,
    normal: Six,
}

/// A load about the part's middle, moments over its size, as a wrench of the geometry.
fn about_middle(part: &ClampedPart, d: &Six) -> Six {
    let moment = scale([d[0], d[1], d[2]], part.size);
    wrench(part.middle, [d[3], d[4], d[5]], moment)
}

/// The programme: how much of a load the faces resist. Variables are the load, then normal force and friction of each point,
/// then what has no limit.
fn resisted(part: &ClampedPart, faces: &[Face], d: &Six) -> Result<Resisted, Unsolved> {
    let each = faces.iter().map(|f| f.presses(&part.geometry));
    let each: Vec<(Vec<Press>, Vec<Six>)> = each.collect();
    let mut columns: Vec<(usize, Six)> = Vec::new();
    let (mut normals, mut cones) = (Vec::new(), Vec::new());
    for (i, (face, (presses, free))) in faces.iter().zip(&each).enumerate() {
        for p in presses {
            normals.push(columns.len() + 1);
            columns.push((i, p.normal));
            if face.friction == Some(0.0) {
                continue;
            }
            cones.extend(face.friction.map(|f| (columns.len(), f)));
            columns.extend(p.along.map(|a| (i, a)));
        }
        columns.extend(free.iter().map(|w| (i, *w)));
    }
    let load = about_middle(part, d);
    let mut programme = ConeProgramme::default();
    // A motion that neither load nor contacts work on says nothing, and rounding must not speak for it.
    let mut worked = Vec::new();
    for motion in &part.motions {
        let first = (0, power(&load, &motion.part));
        let others = columns.iter().enumerate();
        let others = others.map(|(k, (i, w))| (k + 1, power(w, &motion.against[*i])));
        let all = std::iter::once(first).chain(others);
        let row: Vec<(usize, f64)> = all.filter(|(_, x)| x.abs() > ROUNDING).collect();
        if !row.is_empty() {
            programme.row(row, 0.0);
            worked.push(motion);
        }
    }
    programme.within(ZeroConeT);
    programme.row([(0, 1.0)], LIMIT);
    programme.row(normals.iter().map(|&n| (n, 1.0)), 1.0);
    for &n in &normals {
        programme.row([(n, -1.0)], 0.0);
    }
    programme.within(NonnegativeConeT);
    for (normal, friction) in cones {
        programme.row([(normal, -friction)], 0.0);
        programme.row([(normal + 1, -1.0)], 0.0);
        programme.row([(normal + 2, -1.0)], 0.0);
        programme.within(SecondOrderConeT);
    }
    let mut aim = vec![0.0; columns.len() + 1];
    aim[0] = -1.0;
    let found = programme.solve(&[], &aim).map_err(Unsolved::Programme)?;
    match found.status {
        SolverStatus::Solved | SolverStatus::AlmostSolved => {}
        other => return Err(Unsolved::Programme(format!("{other:?}"))),
    }
    // The multipliers of the motions: the part's motion that the load works on most for what the contacts can give.
    let mut twist = [0.0; 6];
    for (y, motion) in found.z.iter().zip(worked) {
        twist = add(twist, scale(motion.part, *y));
    }
    let load = match found.x[0] {
        x if x > LIMIT * 0.99 => f64::INFINITY,
        x => x.max(0.0),
    };
    let turn = [twist[0], twist[1], twist[2]];
    let shift = add([twist[3], twist[4], twist[5]], cross(turn, part.middle));
    let turn = scale(turn, part.size);
    let normal = [turn[0], turn[1], turn[2], shift[0], shift[1], shift[2]];
    let sign = power(&normal, d).signum();
    Ok(Resisted {
        load,
        normal: scale(normal, sign),
    })
}

/// What faces hold, each with its friction.
///
/// # Guarantee
/// `at_least` and `at_most` bracket the margin, to 1e-6: the set is convex, so that it has the hull of the loads resisted along
/// the axes; from each of these the search goes on to where the set is nearest by its tangent planes, which never leads away.
/// Round faces are polygons within them, so that margins are at most 2 % too small.
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
pub fn closure(part: &ClampedPart, faces: &[Face]) -> Result<Closure, Unsolved> {
    let mut along = Vec::new();
    let mut weakest = (part.axes[0], f64::INFINITY);
    let mut inverse = 0.0;
    for axis in &part.axes {
        let mut least = f64::INFINITY;
        for sign in [1.0, -1.0] {
            let mut d = scale(*axis, sign);
            let mut found = resisted(part, faces, &d)?;
            along.push((d, found.load));
            least = f64::min(least, found.load);
            for _ in 0..STEPS {
                // Mirror images are as weak: rounding must not put one before the other.
                if found.load < weakest.1 * (1.0 - TIE) {
                    weakest = (d, found.load);
                }
                let size = length(found.normal);
                if !(size > 0.0 && found.load > NOTHING && found.load.is_finite()) {
                    break;
                }
                d = scale(found.normal, 1.0 / size);
                let next = resisted(part, faces, &d)?;
                if next.load >= found.load * (1.0 - TIE) {
                    break;
                }
                found = next;
            }
        }
        inverse += 1.0 / (least * least);
    }
    let closed = along.iter().all(|(_, load)| *load > NOTHING);
    let at_least = if closed { 1.0 / inverse.sqrt() } else { 0.0 };
    Ok(Closure {
        at_least: at_least.min(weakest.1),
        at_most: weakest.1,
        weakest: weakest.0,
        along,
    })
}

/// Whether every small load is resisted, and no more: a programme an axis and way at most.
///
/// # Errors
/// Where a cone programme has no answer.
pub fn is_closed(part: &ClampedPart, faces: &[Face]) -> Result<bool, Unsolved> {
    for axis in &part.axes {
        for sign in [1.0, -1.0] {
            if resisted(part, faces, &scale(*axis, sign))?.load <= NOTHING {
                return Ok(false);
            }
        }
    }
    Ok(true)
}
