//! A mechanism in its plane of motion: bodies joined by turning and sliding pairs, with coordinates in metres.

use crate::closure::twist::FrameValues;
use crate::geom::exact::ExactError;
use crate::geom::expr::Expr;
use crate::geom::vector::{X, Y, Z, across, cross, dot, length, to_vector, unit};
use crate::geom::{Reals, Scalars};
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{JointId, LinkId, Mechanism, Mode, StateId};
use crate::statics::greatest_abs;
use std::fmt;
use thiserror::Error;

/// Index of a body in [`PlanarMechanism::bodies`].
pub type BodyId = usize;
/// Index of a pair in [`PlanarMechanism::pairs`].
pub type PairId = usize;

/// Sine of the angle below which directions count as parallel, as for the motions of a joint in a plane.
const PARALLEL: f64 = 1e-10;

/// Reason why a mechanism has no planar model.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum PlanarError {
    /// A joint moves out of the plane.
    #[error(
        "joint \"{joint}\" moves out of the plane of motion, but this analysis is planar; use \
        revolute, prismatic and slotted joints in parallel planes, or mode = \"planar\""
    )]
    NotPlanar {
        /// The joint.
        joint: String,
    },
    /// A joint has freedoms in the plane that do not match a turning, sliding or pin-in-slot pair.
    #[error(
        "joint \"{joint}\" leaves {freedoms} freedoms in the plane; planar statics supports revolute, prismatic and pin-in-slot pairs"
    )]
    Unsupported {
        /// The joint.
        joint: String,
        /// Its freedoms in the plane.
        freedoms: usize,
    },
    /// A joint of two freedoms is marked as a drive.
    #[error(
        "joint \"{joint}\" has two freedoms and cannot be a drive; drive a revolute or prismatic joint"
    )]
    DriveOfTwo {
        /// The joint.
        joint: String,
    },
    /// Joints are coupled.
    #[error(
        "joints {coupling} are coupled, but Assur groups consist only of links and joints; \
        compute spatial reactions, which include that of the coupling, or replace the coupling by \
        drives at both joints"
    )]
    Coupled {
        /// The coupling.
        coupling: String,
    },
    /// A coordinate has no value.
    #[error(transparent)]
    Exact(#[from] ExactError),
}

/// Kind of connection of two bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PairKind {
    /// One freedom, a turn.
    Turning,
    /// One freedom, a slide along a line of the first body.
    Sliding,
    /// No freedom.
    Rigid,
}

impl fmt::Display for PairKind {
    /// Writes R, P or F, as in structural formulas.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            PairKind::Turning => "R",
            PairKind::Sliding => "P",
            PairKind::Rigid => "F",
        })
    }
}

/// A rigid body in the plane.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// The link, or `None` for the sliding block that represents a pin in a slot.
    pub link: Option<LinkId>,
    /// Name of the link, or of the joint with a mark.
    pub name: String,
}

/// A turning, sliding or rigid pair.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// The joint that it represents, completely or in part.
    pub joint: JointId,
    /// Name of the joint, with a mark for the sliding half of a pin in a slot.
    pub name: String,
    /// The two bodies; the relative motion is that of the second relative to the first.
    pub bodies: [BodyId; 2],
    /// Kind of the connection.
    pub kind: PairKind,
    /// Centre of a turning pair, a point of a sliding pair's line, at the pose of the file `[m]`.
    pub point: [f64; 2],
    /// Unit direction of a sliding pair at the pose of the file.
    pub along: [f64; 2],
    /// Whether the mechanism is driven here.
    pub drive: bool,
}

impl Pair {
    /// Returns the body at the other end, if `body` is at one end.
    #[must_use]
    pub fn other_body(&self, body: BodyId) -> Option<BodyId> {
        match self.bodies {
            [a, b] if a == body => Some(b),
            [a, b] if b == body => Some(a),
            _ => None,
        }
    }
}

/// A planar mechanism of bodies and pairs. Points are (x, y) along [`PlanarMechanism::axes`] in metres.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanarMechanism {
    /// The bodies.
    pub bodies: Vec<Body>,
    /// The pairs.
    pub pairs: Vec<Pair>,
    /// The fixed body.
    pub frame: BodyId,
    /// Unit vectors x, y and normal of the plane in the axes of the file.
    pub axes: [[f64; 3]; 3],
    /// Metres in a length unit of the file.
    pub metres: f64,
    /// Symbol of that unit.
    pub unit: &'static str,
}

/// The freedoms of a joint in its plane of motion.
struct FreedomsInPlane {
    turns: usize,
    /// Directions of the slides.
    slides: Vec<[f64; 2]>,
    /// Whether there are others, out of the plane.
    outside: bool,
}

fn is_parallel(a: [f64; 3], b: [f64; 3]) -> bool {
    length(cross(a, b)) <= PARALLEL
}

impl PlanarMechanism {
    /// Creates the planar model of a state. A spatial mechanism must have all its freedoms in one plane. In planar
    /// mode, those out of it are omitted. A pin in a slot becomes a turning pair, a block, and a sliding pair. The pin
    /// is on the joint's first link, the slot in its second.
    ///
    /// # Errors
    /// Returns an error if a joint fits no planar pair, or if joints are coupled.
    ///
    /// # Examples
    /// ```
    /// use ozols::{model::mechanism::StateId, statics::planar::PlanarMechanism};
    /// let planar = PlanarMechanism::new(&ozols::built_in("four-bar")?, StateId::FREE)?;
    /// assert_eq!((planar.bodies.len(), planar.pairs.len()), (4, 4));
    /// assert!(PlanarMechanism::new(&ozols::built_in("bennett")?, StateId::FREE).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(m: &Mechanism, state: StateId) -> Result<Self, PlanarError> {
        if let Some(c) = m.couplings_in(state).next() {
            let coupling = c.name(m);
            return Err(PlanarError::Coupled { coupling });
        }
        let normal = plane_normal(m, state)?;
        let x = [X, Y]
            .into_iter()
            .find(|g| !is_parallel(*g, normal))
            .unwrap_or(X);
        let x = unit(across(x, normal));
        let mut planar = PlanarMechanism {
            bodies: Vec::new(),
            pairs: Vec::new(),
            frame: 0,
            axes: [x, cross(normal, x), normal],
            metres: m.length_unit.metres,
            unit: m.length_unit.symbol,
        };
        let mut body_of = vec![None; m.links.len()];
        for (l, link) in m.links_with_ids() {
            let joined = m.joints_in(state).any(|j| m.joints[j].links.contains(&l));
            if joined || l == m.frame_link() {
                body_of[l] = Some(planar.bodies.len());
                planar.bodies.push(Body {
                    link: Some(l),
                    name: link.id.clone(),
                });
            }
        }
        planar.frame = body_of[m.frame_link()].unwrap_or(0);
        for j in m.joints_in(state) {
            let [Some(a), Some(b)] = m.joints[j].links.map(|l| body_of[l]) else {
                continue;
            };
            planar.add_joint(m, j, [a, b])?;
        }
        Ok(planar)
    }

    /// Returns the mechanism with only the motions in this plane, in which rotary drives turn about its normal.
    #[must_use]
    pub(crate) fn as_driven(&self, m: &Mechanism) -> Mechanism {
        let mut out = m.clone().into_parts();
        // The normal of a moving mechanism has a numerical value.
        let normal = self.axes[2].map(|x| Expr::from_f64(x).unwrap_or_else(|_| Expr::from(0)));
        if matches!(m.mode, Mode::Spatial) {
            out.mode = Mode::Planar { normal };
        }
        for p in self.pairs.iter().filter(|p| p.drive) {
            let frame = &mut out.joints[p.joint].frame;
            let Ok(values) = FrameValues::new(&Reals, frame) else {
                continue;
            };
            let backward = |a: &[f64; 3]| dot(unit(*a), self.axes[2]) < -PARALLEL;
            if p.kind == PairKind::Turning && values.axes.iter().any(backward) {
                let turned = if backward(&values.axes[0]) {
                    &mut frame.reference
                } else {
                    &mut frame.axis
                };
                *turned = turned.each_ref().map(|c| -c);
            }
        }
        Mechanism::new(out).expect("turned axes keep a mechanism valid")
    }

    /// Converts a point of the file to (x, y) in metres.
    #[must_use]
    pub fn to_plane(&self, point: [f64; 3]) -> [f64; 2] {
        self.plane_components(point).map(|c| c * self.metres)
    }

    /// Returns the components of a vector of the file along x and y.
    #[must_use]
    pub fn plane_components(&self, v: [f64; 3]) -> [f64; 2] {
        [dot(self.axes[0], v), dot(self.axes[1], v)]
    }

    /// Returns the body of a link, if it is joined to others in this state.
    #[must_use]
    pub fn body_of(&self, link: LinkId) -> Option<BodyId> {
        self.bodies.iter().position(|b| b.link == Some(link))
    }

    /// Returns the pairs that are marked as drives.
    #[must_use]
    pub fn driven_pairs(&self) -> Vec<PairId> {
        (0..self.pairs.len())
            .filter(|&p| self.pairs[p].drive)
            .collect()
    }

    /// Returns the freedoms of a joint in the plane, with these axes of its frame.
    fn plane_freedoms(&self, freedoms: &[Freedom], axes: [[f64; 3]; 3]) -> FreedomsInPlane {
        let ball = [Freedom::Rx, Freedom::Ry, Freedom::Rz]
            .iter()
            .all(|f| freedoms.contains(f));
        let mut seen = FreedomsInPlane {
            turns: usize::from(ball),
            slides: Vec::new(),
            outside: ball,
        };
        for f in freedoms {
            let axis = axes[f.axis()];
            match f {
                f if f.is_turn() && ball => {}
                f if f.is_turn() && is_parallel(axis, self.axes[2]) => seen.turns += 1,
                f if f.is_slide() && dot(axis, self.axes[2]).abs() <= PARALLEL => {
                    seen.slides.push(self.plane_components(axis));
                }
                _ => seen.outside = true,
            }
        }
        seen
    }

    fn add_joint(
        &mut self,
        m: &Mechanism,
        j: JointId,
        bodies: [BodyId; 2],
    ) -> Result<(), PlanarError> {
        let joint = &m.joints[j];
        let name = || joint.id.clone();
        let values = FrameValues::new(&Reals, &joint.frame)?;
        let axes = values.axes.map(unit);
        let seen = self.plane_freedoms(joint.joint_type.freedoms(), axes);
        if seen.outside && matches!(m.mode, Mode::Spatial) {
            return Err(PlanarError::NotPlanar { joint: name() });
        }
        let point = self.to_plane(values.point);
        let mut push = |bodies, kind, along, name| {
            self.pairs.push(Pair {
                joint: j,
                name,
                bodies,
                kind,
                point,
                along,
                drive: joint.drive,
            });
        };
        match (seen.turns, seen.slides.as_slice()) {
            (0, []) => push(bodies, PairKind::Rigid, [0.0; 2], name()),
            (1, []) => push(bodies, PairKind::Turning, [0.0; 2], name()),
            (0, [u]) => push(bodies, PairKind::Sliding, *u, name()),
            (1, [_]) if joint.drive => return Err(PlanarError::DriveOfTwo { joint: name() }),
            (1, [u]) => {
                let block = self.bodies.len();
                let [a, b] = bodies;
                push([a, block], PairKind::Turning, [0.0; 2], name());
                push(
                    [block, b],
                    PairKind::Sliding,
                    *u,
                    format!("{} slot", joint.id),
                );
                self.bodies.push(Body {
                    link: None,
                    name: format!("block of {}", joint.id),
                });
            }
            (t, s) => {
                return Err(PlanarError::Unsupported {
                    joint: name(),
                    freedoms: t + s.len(),
                });
            }
        }
        Ok(())
    }
}

fn plane_normal(m: &Mechanism, state: StateId) -> Result<[f64; 3], PlanarError> {
    match &m.mode {
        Mode::Planar { normal } => Ok(unit(Reals.eval3(normal)?)),
        Mode::Spatial => spatial_normal(m, state),
    }
}

/// Returns true if all loads of a mechanism act in its plane. There must be no force normal to it, no tilting moment,
/// and no force at a point above or below it if all joints have one height. No joint may be misaligned, which strains
/// the constraints out of the plane. All loads of a file in planar mode act in its plane.
pub(crate) fn loads_are_in_plane(m: &Mechanism, state: StateId) -> bool {
    let (Mode::Spatial, Ok(n)) = (&m.mode, plane_normal(m, state)) else {
        return true;
    };
    let small = |x: f64, of: f64| x.abs() <= 1e-9 * of;
    let across = |v: [f64; 3]| small(dot(v, n), length(v));
    let along = |v: [f64; 3]| small(length(cross(v, n)), length(v));
    let points: Vec<[f64; 3]> = m
        .joints_in(state)
        .map(|j| to_vector(&m.joints[j].frame.point))
        .collect();
    let size = greatest_abs(points.iter().flatten());
    let mut heights = points.iter().map(|&p| dot(p, n));
    let level = heights.next().unwrap_or(0.0);
    let flat = heights.all(|h| small(h - level, size));
    let beside = |p: &[Expr; 3]| !flat || small(dot(to_vector(p), n) - level, size);
    let loads = m.loads.in_state(state);
    let straight = loads.misalignments.is_empty();
    let mut masses = m.links.iter().filter_map(|l| l.mass.as_ref());
    let weights = loads.gravity.as_ref().is_none_or(|g| {
        masses.all(|mass| mass.mass == 0.0 || across(to_vector(g)) && beside(&mass.centre))
    });
    let forces = &mut loads.forces.iter();
    straight
        && weights
        && forces.all(|f| across(to_vector(&f.force)) && beside(&f.point))
        && loads.moments.iter().all(|x| along(to_vector(&x.moment)))
}

/// Returns the normal shared by the joints of a spatial mechanism. It is the first axis they turn about, or the
/// direction perpendicular to the first two directions of sliding.
fn spatial_normal(m: &Mechanism, state: StateId) -> Result<[f64; 3], PlanarError> {
    let mut slides: Vec<[f64; 3]> = Vec::new();
    for j in m.joints_in(state) {
        let joint = &m.joints[j];
        let axes = FrameValues::new(&Reals, &joint.frame)?.axes.map(unit);
        for f in joint.joint_type.freedoms() {
            match f {
                Freedom::Screw => {
                    return Err(PlanarError::NotPlanar {
                        joint: joint.id.clone(),
                    });
                }
                f if f.is_turn() => return Ok(axes[f.axis()]),
                f => slides.push(axes[f.axis()]),
            }
        }
    }
    let other = |u: [f64; 3]| slides.iter().find(|v| !is_parallel(u, **v)).copied();
    Ok(slides
        .first()
        .and_then(|u| other(*u).map(|v| unit(cross(*u, v))))
        .unwrap_or(Z))
}
