//! The motions of a link in a pose: its translations, rotations and screw motions, in engineering terms.
//!
//! The twists that a link can have relative to another form a subspace of dimension 0 to 6. Its pure translations are a
//! subspace of that. The remainder has as many independent axes of rotation as dimensions. If all these axes meet,
//! their common point is reported. A single axis has a line and a pitch.
//!
//! # Sources
//! Subspaces of twists and their types: Hunt, "Kinematic Geometry of Mechanisms", 1978, chapter 12.

use crate::closure::tree::path_from_frame;
use crate::geom::exact::ExactError;
use crate::geom::rigid::join_twist;
use crate::geom::vector::{Vector, X, Y, Z, add, cross, dot, length, scale, sub};
use crate::model::mechanism::{LinkId, Mechanism, StateId};
use crate::motion::pose::{FLAT, Pose};
use crate::rank::finite::local_dimension::null_space_of;
use crate::redundancy::analysis::StateAnalysis;
use crate::redundancy::motion::output_links;
use ozols_dense::{Matrix, norm, svd};

/// Maximum number of freedoms of a mechanism. For larger ones, singular vectors are computed only on request.
const FREEDOMS: usize = 400;

/// The motion that a link can have relative to another one.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkMotion {
    /// The link.
    pub link: LinkId,
    /// The reference link of the motion.
    pub relative_to: LinkId,
    /// Orthonormal directions of its pure translations.
    pub slides: Vec<Vector>,
    /// Its other motions, one for each independent axis of rotation.
    pub turns: Vec<Turning>,
    /// The point in the file's unit where all axes of two or three rotations meet. `None` if they do not meet, or if
    /// translations make any point equally valid.
    pub meet: Option<Vector>,
}

/// A rotation, or a screw motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turning {
    /// The axis, of unit length.
    pub axis: Vector,
    /// The point of the axis nearest to the middle of the mechanism, in the file's unit.
    pub point: Vector,
    /// Translation along the axis in one turn, in the file's unit.
    pub lead: f64,
}

impl LinkMotion {
    /// Returns the number of independent motions.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.slides.len() + self.turns.len()
    }

    /// Returns the twists (ω; v) about the origin in the file's unit: translations first.
    #[must_use]
    pub fn motion_twists(&self) -> Vec<[f64; 6]> {
        let slides = self.slides.iter().map(|s| join_twist([0.0; 3], *s));
        let turns = self.turns.iter().map(|t| {
            let along = scale(t.axis, t.lead / std::f64::consts::TAU);
            join_twist(t.axis, add(cross(t.point, t.axis), along))
        });
        slides.chain(turns).collect()
    }
}

impl StateAnalysis {
    /// Returns the motions of the outputs relative to the frame. Empty if the number of motions by singular values
    /// contradicts the rank.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value.
    ///
    /// # Examples
    /// ```
    /// let four_bar = ozols::built_in("four-bar")?;
    /// let motions = ozols::analyze(&four_bar)?[0].output_motions(&four_bar)?;
    /// // The rocker turns about its hinge at (120, 0), parallel to z.
    /// assert_eq!((motions[0].dimension(), motions[0].turns.len()), (1, 1));
    /// assert!((motions[0].turns[0].point[0] - 120.0).abs() < 1e-9);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn output_motions(&self, mechanism: &Mechanism) -> Result<Vec<LinkMotion>, ExactError> {
        let state = mechanism.state_named(&self.state).unwrap_or(StateId::FREE);
        let there: Vec<LinkId> = mechanism.links_in(state).collect();
        let mut outputs = output_links(mechanism);
        outputs.retain(|l| there.contains(l));
        self.link_motions(mechanism, &outputs, mechanism.frame_link())
    }

    /// Returns the motions of some links relative to another in this state of the analysed mechanism. Empty if the
    /// number of motions by singular values contradicts the rank.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value.
    pub fn link_motions(
        &self,
        mechanism: &Mechanism,
        links: &[LinkId],
        relative_to: LinkId,
    ) -> Result<Vec<LinkMotion>, ExactError> {
        let meant = self.meant.as_deref().unwrap_or(mechanism);
        let state = mechanism.state_named(&self.state).unwrap_or(StateId::FREE);
        link_motions(meant, state, links, relative_to, self.mobility)
    }
}

/// Returns the motions of some links relative to one in a state of a mechanism with `mobility` motions. Empty if
/// singular values find another number, or if the mechanism is large.
///
/// # Errors
/// Returns an error if a coordinate has no value.
///
/// # Complexity
/// One singular value decomposition of J, and one of 6 rows for each link.
fn link_motions(
    mechanism: &Mechanism,
    state: StateId,
    links: &[LinkId],
    relative_to: LinkId,
    mobility: usize,
) -> Result<Vec<LinkMotion>, ExactError> {
    let pose = Pose::of_file(mechanism, state)?;
    if pose.columns.len() > FREEDOMS {
        return Ok(Vec::new());
    }
    let kernel = null_space_of(&pose);
    if kernel.ncols() != mobility {
        return Ok(Vec::new());
    }
    // The rows of the closure equations are followed by six for the twist of each link.
    let all = std::iter::once(&relative_to).chain(links);
    let paths: Vec<_> = all.map(|&l| path_from_frame(mechanism, state, l)).collect();
    let moved = pose.jacobian_with(&paths, &[]).times(&kernel);
    let row = |link: usize, r: usize| pose.rows() + 6 * link + r;
    let of = |(at, &link): (usize, &LinkId)| {
        let difference = |r: usize, c: usize| moved[(row(at + 1, r), c)] - moved[(row(0, r), c)];
        let relative = Matrix::from_fn(6, kernel.ncols(), difference);
        name_motion(&pose, link, relative_to, &relative)
    };
    Ok(links.iter().enumerate().filter_map(of).collect())
}

/// Returns a span of twists in the lengths of a pose and about its middle as a motion, or `None` if singular values do
/// not converge.
fn name_motion(
    pose: &Pose,
    link: LinkId,
    relative_to: LinkId,
    span: &Matrix,
) -> Option<LinkMotion> {
    let mut out = LinkMotion {
        link,
        relative_to,
        slides: Vec::new(),
        turns: Vec::new(),
        meet: None,
    };
    let columns = span.ncols();
    let size = (0..columns).map(|c| norm(span.col(c))).fold(0.0, f64::max);
    if size < FLAT {
        return Some(out);
    }
    let part = |from: usize| Matrix::from_fn(3, columns, |r, c| span[(from + r, c)] / size);
    let (turning, shifting) = (part(0), part(3));
    let turns = svd(&turning)?;
    let rank = turns.values.iter().filter(|&&s| s > FLAT).count();
    // Motions without rotation are translations.
    let still = turns.null_space(rank);
    let slides = svd(&shifting.times(&still))?;
    let many = slides.values.iter().filter(|&&s| s > FLAT).count();
    out.slides = (0..many).map(|c| column_vector(&slides.u, c)).collect();
    let across = |v: Vector| {
        out.slides
            .iter()
            .fold(v, |v, s| sub(v, scale(*s, dot(v, *s))))
    };
    let each: Vec<[Vector; 2]> = (0..rank)
        .map(|i| {
            let along = turns.v.cols(i..i + 1);
            let by = 1.0 / turns.values[i];
            let v = column_vector(&shifting.times(&along), 0);
            [column_vector(&turns.u, i), across(scale(v, by))]
        })
        .collect();
    if rank >= 2 {
        out.meet = meeting_point(&each, &across).map(|p| point_in_file(pose, p));
    }
    out.turns = each.iter().map(|[w, v]| turning_of(pose, *w, *v)).collect();
    Some(out)
}

/// Returns the rotation or screw motion of a twist with an axis of unit length.
fn turning_of(pose: &Pose, axis: Vector, v: Vector) -> Turning {
    let pitch = dot(axis, v);
    let pitch = if pitch.abs() < FLAT { 0.0 } else { pitch };
    Turning {
        axis,
        point: point_in_file(pose, cross(axis, v)),
        lead: pitch * std::f64::consts::TAU * pose.length,
    }
}

/// Returns a point in the file's unit.
fn point_in_file(pose: &Pose, p: Vector) -> Vector {
    add(scale(p, pose.length), pose.middle)
}

/// Returns the point about which all these twists are rotations, up to existing translations. Returns `None` if there
/// is no such point, or more than one.
fn meeting_point(twists: &[[Vector; 2]], across: &dyn Fn(Vector) -> Vector) -> Option<Vector> {
    // v = c × ω for each: three equations, linear in c.
    let units = [X, Y, Z];
    let matrix = Matrix::from_fn(3 * twists.len(), 3, |r, c| {
        across(cross(units[c], twists[r / 3][0]))[r % 3]
    });
    let right = Matrix::from_fn(3 * twists.len(), 1, |r, _| twists[r / 3][1][r % 3]);
    let found = svd(&matrix)?;
    if found.rank(FLAT) < 3 {
        return None;
    }
    let c = column_vector(&found.least_norm(3, &right), 0);
    let off = |[w, v]: &[Vector; 2]| length(sub(across(cross(c, *w)), *v));
    twists.iter().all(|t| off(t) < FLAT.sqrt()).then_some(c)
}

fn column_vector(m: &Matrix, c: usize) -> Vector {
    [0, 1, 2].map(|r| m[(r, c)])
}
