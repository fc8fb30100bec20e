//! Inertia forces of the links while the drives move at constant speeds.
//!
//! Speeds of the freedoms close every contour, Σ ± q̇ t = 0, and their rates also close: Σ ± q̈ t = -Σ ± q̇ [V, t]. Here V is the velocity
//! of the body that carries the freedom's twist t along the contour. [V, t] is the bracket of twists [Müller 2018, "Screw and Lie group
//! theory in multibody kinematics", sec. 4]. Idle freedoms have the smallest speeds and rates that close. By D'Alembert, a link then
//! carries the force -m a at its mass centre and the moment -(I α + ω × I ω).

use crate::closure::drive::Driven;
use crate::geom::rigid::split_twist;
use crate::geom::vector::{add, add_scaled, cross, dot, length, scale, to_vector};
use crate::model::loads::Inertia;
use crate::model::mechanism::{JointId, LinkId, Mechanism};
use crate::motion::pose::Pose;
use crate::statics::reactions::geometry::{FreedomColumn, Geometry, Six, TOLERANCE, wrench_power};
use crate::statics::reactions::unsolved::Unsolved;
use crate::statics::reactions::wrench::join_halves;
use crate::statics::{drop_rounding, greatest_abs, rounding_size};
use ozols_dense::{Matrix, svd};

/// Maximum gap of contours, as a fraction of the speeds (or rates) in them.
const CLOSES: f64 = 1e-7;
/// Tolerance within which turns are about one direction.
const PARALLEL: f64 = 1e-9;

/// Velocities and accelerations of the links, as twists and their rates about the geometry's middle, lengths in its size.
#[derive(Debug, Clone)]
pub(crate) struct LinkMotions {
    /// (ω; velocity of the link's point at the middle) by link.
    pub velocity: Vec<Six>,
    /// The rate of that twist by link.
    pub rate: Vec<Six>,
}

/// Returns the bracket of two twists: the rate of `t` carried along with velocity `v`.
fn twist_bracket(v: &Six, t: &Six) -> Six {
    let ((w, u), (tw, tv)) = (split_twist(v), split_twist(t));
    join_halves(cross(w, tw), add(cross(w, tv), cross(u, tw)))
}

/// Returns the columns of a joint in the order of passage, with their direction.
fn joint_columns(geometry: &Geometry, joint: JointId, forward: bool) -> Vec<(usize, f64)> {
    let own = (0..geometry.columns.len()).filter(|&c| geometry.columns[c].joint == joint);
    if forward {
        own.map(|c| (c, 1.0)).collect()
    } else {
        own.rev().map(|c| (c, -1.0)).collect()
    }
}

/// Returns the smallest x with `matrix` x = `right`, or an error if there is none.
fn least_solution(matrix: &Matrix, right: &[f64], scale: f64) -> Result<Vec<f64>, Unsolved> {
    let svd = svd(matrix).ok_or(Unsolved::NoConvergence)?;
    let x = svd.least_norm(svd.rank(TOLERANCE), &Matrix::from_column(right));
    let found = matrix.times(&x);
    let left = found.col(0).iter().zip(right).map(|(a, b)| (a - b).abs());
    let x = x.col(0).to_vec();
    let open = left.fold(0.0, f64::max) > CLOSES * greatest_abs(&x).max(scale);
    if open || !x.iter().all(|v| v.is_finite()) {
        return Err(Unsolved::Stuck);
    }
    Ok(x)
}

/// Returns the motion of the links in a pose if the drives move at constant `speeds`: `[rad/s]`, or the file's unit per
/// second. Drives without a stated speed are at rest.
///
/// # Errors
/// Returns an error if the drives cannot move at these speeds, as at a dead point.
///
/// # Complexity
/// O((6k)²·f) for k contours and f freedoms.
pub(crate) fn link_motions(
    m: &Mechanism,
    geometry: &Geometry,
    drives: &[Driven],
    speeds: &[f64],
) -> Result<LinkMotions, Unsolved> {
    let f = geometry.columns.len();
    if speeds.iter().all(|s| *s == 0.0) {
        let still = vec![0.0; f];
        return Ok(along_tree(m.links.len(), geometry, &still, &still));
    }
    let held = |c: &FreedomColumn| drives.iter().position(|d| *d == (c.joint, c.freedom));
    let given = |c: &FreedomColumn| {
        let speed = held(c).and_then(|i| speeds.get(i)).copied().unwrap_or(0.0);
        let slides = c.twist[..3] == [0.0; 3];
        speed
            * if slides {
                geometry.metres / geometry.size
            } else {
                1.0
            }
    };
    let free: Vec<usize> = (0..f)
        .filter(|&c| held(&geometry.columns[c]).is_none())
        .collect();
    let part = geometry.closure_matrix(&free);
    let all: Vec<usize> = (0..f).collect();
    let mut speed: Vec<f64> = geometry.columns.iter().map(given).collect();
    let whole = geometry.closure_matrix(&all);
    let right: Vec<f64> = (0..whole.nrows())
        .map(|r| -(0..f).map(|c| whole[(r, c)] * speed[c]).sum::<f64>())
        .collect();
    let found = least_solution(&part, &right, greatest_abs(&speed))?;
    for (&c, x) in free.iter().zip(&found) {
        speed[c] = *x;
    }
    let mut right = to_make_up(geometry, &speed);
    // A ratio is the same in every pose, so rates are coupled in the same way as speeds.
    right.resize(geometry.unknown_count(), 0.0);
    let found = least_solution(&part, &right, greatest_abs(&speed).powi(2))?;
    let mut rates = vec![0.0; f];
    for (&c, x) in free.iter().zip(&found) {
        rates[c] = *x;
    }
    Ok(along_tree(m.links.len(), geometry, &speed, &rates))
}

/// Returns what the rates of the freedoms have to compensate: the negative rate of the contours at constant speeds of
/// all freedoms.
fn to_make_up(geometry: &Geometry, speed: &[f64]) -> Vec<f64> {
    let mut right = Vec::with_capacity(geometry.unknown_count());
    for contour in &geometry.contours {
        let (mut velocity, mut gain) = ([0.0; 6], [0.0; 6]);
        for &(joint, forward) in &contour.joints {
            for (c, sign) in joint_columns(geometry, joint, forward) {
                let t = &geometry.columns[c].twist;
                gain = add_scaled(gain, sign * speed[c], twist_bracket(&velocity, t));
                velocity = add_scaled(velocity, sign * speed[c], *t);
            }
        }
        right.extend(geometry.basis.iter().map(|b| -wrench_power(b, &gain)));
    }
    right
}

/// Returns the motions of the links at speeds and rates of the freedoms, from the frame outwards.
fn along_tree(links: usize, geometry: &Geometry, speed: &[f64], rates: &[f64]) -> LinkMotions {
    let mut out = LinkMotions {
        velocity: vec![[0.0; 6]; links],
        rate: vec![[0.0; 6]; links],
    };
    for step in &geometry.tree {
        let (mut v, mut a) = (out.velocity[step.from], out.rate[step.from]);
        for (c, sign) in joint_columns(geometry, step.joint, step.forward) {
            let t = &geometry.columns[c].twist;
            a = add_scaled(a, sign * rates[c], *t);
            a = add_scaled(a, sign * speed[c], twist_bracket(&v, t));
            v = add_scaled(v, sign * speed[c], *t);
        }
        (out.velocity[step.link], out.rate[step.link]) = (v, a);
    }
    out
}

fn angular_part(t: &Six) -> [f64; 3] {
    split_twist(t).0
}

/// Returns the current inertia of a link about global axes times a vector `[kg·m²]`.
fn inertia_times(pose: &Pose, link: LinkId, inertia: &Inertia, v: [f64; 3]) -> [f64; 3] {
    let [xx, yy, zz, xy, yz, zx] = match *inertia {
        // About the common direction of all turns.
        Inertia::Plane(i) => return v.map(|x| i * x),
        Inertia::Principal([x, y, z]) => [x, y, z, 0.0, 0.0, 0.0],
        Inertia::Tensor(t) => t,
    };
    // Converts to the pose for which the file states it, and back.
    let unit = |i: usize| [0, 1, 2].map(|k| f64::from(u8::from(k == i)));
    let axes = [0, 1, 2].map(|i| pose.links[link].map_direction(unit(i)));
    let own = axes.map(|a| dot(a, v));
    let turned = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]].map(|r| dot(r, own));
    [0, 1, 2].map(|i| (0..3).map(|k| turned[k] * axes[k][i]).sum())
}

/// Returns the absolute value of the largest entry of an inertia `[kg·m²]`.
fn greatest_entry(inertia: &Inertia) -> f64 {
    match inertia {
        Inertia::Plane(i) => i.abs(),
        Inertia::Principal(entries) => greatest_abs(entries),
        Inertia::Tensor(entries) => greatest_abs(entries),
    }
}

/// A link with mass in motion.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MovingMass {
    /// The link.
    pub link: LinkId,
    /// Its current mass centre, from the geometry's middle, in its size.
    pub centre: [f64; 3],
    /// Acceleration of the mass centre `[m/s²]`.
    pub acceleration: [f64; 3],
    /// Angular acceleration `[rad/s²]`.
    pub angular_acceleration: [f64; 3],
    /// -m a, at the mass centre `[N]`.
    pub force: [f64; 3],
    /// -(I α + ω × I ω) `[N·m]`.
    pub moment: [f64; 3],
}

/// Returns the links with mass in the order of the file, without the frame, with their inertia forces for this motion
/// of the links.
///
/// # Errors
/// Returns an error if a link that states its inertia for a plane turns in space.
pub(crate) fn moving_masses(
    m: &Mechanism,
    geometry: &Geometry,
    pose: &Pose,
    moves: &LinkMotions,
) -> Result<Vec<MovingMass>, Unsolved> {
    let turns = moves.velocity.iter().map(angular_part);
    let fastest = turns
        .clone()
        .max_by(|a, b| length(*a).total_cmp(&length(*b)));
    let about = fastest.unwrap_or_default();
    let most = PARALLEL * length(about);
    let flat = turns
        .into_iter()
        .all(|v| length(cross(about, v)) <= most * length(about).max(length(v)));
    // Accelerations are sums of terms as large as the squares of the speeds, with lengths in the geometry's size. They
    // are solved for, as were the speeds in them, and each solution adds its rounding.
    let speed = greatest_abs(moves.velocity.iter().flatten());
    let rounding = rounding_size(0.0, speed * speed, 8 * geometry.unknown_count());
    let bare = |v: [f64; 3]| v.map(|x| drop_rounding(rounding, x));
    let mut out = Vec::new();
    for (l, link) in m.links_with_ids() {
        let Some(mass) = link.mass.as_ref().filter(|_| geometry.has_link(l)) else {
            continue;
        };
        let (v, a) = (&moves.velocity[l], &moves.rate[l]);
        let (w, alpha) = (angular_part(v), angular_part(a));
        let centre = geometry.point_position(pose, l, to_vector(&mass.centre));
        let at = |t: &Six| add(split_twist(t).1, cross(angular_part(t), centre));
        let acceleration = bare(add(at(a), cross(w, at(v))));
        let acceleration = scale(acceleration, geometry.size);
        let mut moment = [0.0; 3];
        if let Some(inertia) = &mass.inertia {
            if matches!(inertia, Inertia::Plane(_)) && !flat {
                return Err(Unsolved::PlaneInertia {
                    link: link.id.clone(),
                });
            }
            let gained = inertia_times(pose, l, inertia, alpha);
            let carried = cross(w, inertia_times(pose, l, inertia, w));
            let rounding = rounding * greatest_entry(inertia);
            moment = [0, 1, 2].map(|i| 0.0 - drop_rounding(rounding, gained[i] + carried[i]));
        }
        out.push(MovingMass {
            link: l,
            centre,
            acceleration,
            angular_acceleration: bare(alpha),
            // Subtracting from 0 avoids a signed zero.
            force: acceleration.map(|x| 0.0 - mass.mass * x),
            moment,
        });
    }
    Ok(out)
}
