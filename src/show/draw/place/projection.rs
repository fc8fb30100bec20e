//! Where joints are shown and from which side.

pub use crate::draw::place::projection::view::Sight;
use crate::draw::place::projection::view::{FLAT, all_views, face_on, unit_or};
pub(crate) use crate::draw::place::projection::view::{View, along_z};
use crate::draw::prelude::*;
use crate::geom::expr::Expr;
use crate::geom::extent::box_diagonal;
pub(crate) use crate::geom::vector::{Vector, add, cross, dot, length as norm, scale, sub};
use crate::model::mechanism::Frame;
use crate::svg::plane::{are_apart, plane_norm as norm2, segments_cross, sides_of, sub as sub2};

pub(crate) mod places;
mod view;

/// Joints nearer than this on paper, in pixels, are in one place.
pub(crate) const ONE_PLACE: f64 = 1.5;

/// The meaning of a joint's axis for a plane of motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Turn {
    /// It turns about the axis and does not slide along it.
    Hinge,
    /// It may slide along the axis.
    Slide,
    /// No direction of it is special.
    Any,
}

/// A joint in space.
#[derive(Debug, Clone)]
pub(crate) struct JointInSpace {
    /// Its point, perhaps moved along its axis.
    pub(crate) point: Vector,
    /// Its frame.
    pub(crate) x: Vector,
    pub(crate) y: Vector,
    pub(crate) z: Vector,
    /// What its axis means.
    turn: Turn,
    /// Whether the point was moved.
    pub(crate) moved: bool,
}

impl JointInSpace {
    /// Returns the same kind of joint at another point, with its axes turned.
    pub(crate) fn carried_to(
        &self,
        point: Vector,
        turn: impl Fn(Vector) -> Vector,
    ) -> JointInSpace {
        JointInSpace {
            point,
            x: turn(self.x),
            y: turn(self.y),
            z: turn(self.z),
            turn: self.turn,
            moved: self.moved,
        }
    }
}

/// Returns the place of a joint, as its coordinates have it.
fn joint_frame(mechanism: &Mechanism, joint: JointId) -> JointInSpace {
    let of = &mechanism.joints[joint];
    JointInSpace {
        turn: match of.joint_type {
            JointType::Revolute | JointType::Universal | JointType::Slotted => Turn::Hinge,
            JointType::Spherical | JointType::Fixed => Turn::Any,
            _ => Turn::Slide,
        },
        ..frame_in_numbers(&of.frame)
    }
}

/// Returns a vector in numbers. Entries that are not finite count as 0.
pub(crate) fn finite_vector(v: &[Expr; 3]) -> Vector {
    let fits = |x: f64| x.is_finite() && x.abs() < 1e120;
    v.each_ref()
        .map(|e| Some(e.to_f64()).filter(|&x| fits(x)).unwrap_or_default())
}

/// Returns a joint's frame in numbers. Entries that are not finite count as 0.
pub(crate) fn frame_in_numbers(f: &Frame) -> JointInSpace {
    let z = unit_or(finite_vector(&f.axis), Z);
    let reference = finite_vector(&f.reference);
    let other = if z[0].abs() < 0.9 { X } else { Y };
    let across = |v: Vector| sub(v, scale(z, dot(v, z)));
    let x = unit_or(across(reference), unit_or(across(other), other));
    JointInSpace {
        point: finite_vector(&f.point),
        x,
        y: cross(z, x),
        z,
        turn: Turn::Slide,
        moved: false,
    }
}

/// How a mechanism is put on paper.
#[derive(Debug, Clone)]
pub(crate) struct Projection {
    /// The side it is seen from.
    pub(crate) view: View,
    /// Pixels in a unit of length.
    pub(crate) scale: f64,
    /// The point at the origin of the paper.
    pub(crate) middle: Vector,
}

impl Projection {
    /// Returns a point in space, in pixels from the point that projects to the origin of the paper.
    pub(crate) fn in_pixels(&self, p: Vector) -> Vector {
        scale(sub(p, self.middle), self.scale)
    }

    /// Returns a point on paper.
    pub(crate) fn flat_point(&self, p: Vector) -> Point {
        self.view
            .flat_vector(sub(p, self.middle))
            .map(|x| x * self.scale)
    }
}

/// Everything that must be visible: the joints, some more points, and the axes of output hinges in the frame, whose
/// circles should not look like lines.
pub(crate) struct ToBeSeen<'a> {
    pub(crate) places: &'a [JointInSpace],
    pub(crate) more: &'a [Vector],
    pub(crate) turning: &'a [Vector],
}

/// Returns the requested view, or the one with the least overlap, for a picture of the given size.
pub(crate) fn best_projection(
    ToBeSeen {
        places,
        more,
        turning,
    }: ToBeSeen<'_>,
    links: &[(LinkId, Vec<usize>)],
    frame: LinkId,
    room: Point,
    sight: &Sight,
) -> Projection {
    let middle = places_middle(places);
    let tried = views_to_try(places, sight).into_iter().map(|(view, dear)| {
        let view = sight.turned_view(view);
        let flat = |p| view.flat_vector(sub(p, middle));
        let on: Vec<Point> = places.iter().map(|p| flat(p.point)).collect();
        let beside = more.iter().map(|&p| flat(p));
        let area = bounds_of(&on.iter().copied().chain(beside).collect::<Vec<_>>());
        let scale = to_fill(room, &area);
        let on: Vec<Point> = on.iter().map(|p| p.map(|x| x * scale)).collect();
        let cost = dear + crowding_cost(places, &on, links, frame) + edge_on(&view, turning);
        let found = Projection {
            view,
            scale: scale * room_for_symbols(&on),
            middle,
        };
        (cost, found)
    });
    let best = tried.reduce(|a, b| if b.0 < a.0 - 1e-9 { b } else { a });
    best.map_or_else(
        || Projection {
            view: along_z(),
            scale: 1.0,
            middle,
        },
        |(_, found)| found,
    )
}

/// Returns the candidate views, each with its own penalty.
fn views_to_try(places: &[JointInSpace], sight: &Sight) -> Vec<(View, f64)> {
    match (sight.asked_view(), planar_normal(places)) {
        (Some(view), _) => vec![(view, 0.0)],
        (None, Some(normal)) => vec![(face_on(normal), 0.0)],
        (None, None) => {
            let few = places.len() as f64;
            let dear = |v: &View| match v.name {
                _ if v.axis => 1.0 + 0.15 * few,
                "isometric" => 0.0,
                _ => 0.4 + 0.02 * few,
            };
            // links in layers move in a plane as well
            let layers = first_hinge(places).filter(|&n| moves_across(places, n));
            let layers = layers.map(|n| (face_on(n), 0.0));
            let views = all_views().into_iter().map(|v| (v, dear(&v)));
            layers.into_iter().chain(views).collect()
        }
    }
}

/// Returns the factor by which a drawn area must grow to fill the room.
fn to_fill(room: Point, area: &Rect) -> f64 {
    let (w, h) = (area.right - area.left, area.bottom - area.top);
    let scale = (room[0] / w.max(1e-300)).min(room[1] / h.max(1e-300));
    if w.max(h) > 0.0 && scale.is_finite() {
        scale
    } else {
        1.0
    }
}

/// Returns how much circles about some axes look like lines in the view.
fn edge_on(view: &View, axes: &[Vector]) -> f64 {
    /// The width of an ellipse, as a share of its length, that is plainly one.
    const ROUND: f64 = 0.4;
    const LINE: f64 = 40.0;
    let width = |n: &Vector| dot(*n, view.toward).abs();
    let narrow = axes
        .iter()
        .map(|n| (ROUND - width(n)).max(0.0) / ROUND * LINE);
    narrow.sum()
}

/// Returns the magnification of a drawing that keeps symbols of joints at different places apart.
fn room_for_symbols(on: &[Point]) -> f64 {
    const APART: f64 = 30.0;
    const MOST: f64 = 2.2;
    let mut least = APART;
    for (i, &a) in on.iter().enumerate() {
        for &b in &on[..i] {
            let d = norm2(sub2(a, b));
            if d > ONE_PLACE {
                least = least.min(d);
            }
        }
    }
    (APART / least).min(MOST)
}

/// Returns the common normal if all points lie in one plane and the mechanism moves in it. Prefers an axis of the
/// coordinates.
fn planar_normal(places: &[JointInSpace]) -> Option<Vector> {
    let size = places_extent(places);
    let first = places.first()?.point;
    // without a hinge: the plane through the points, if they are not all in a row
    let far = |of: &dyn Fn(Vector) -> Vector| {
        let all = places.iter().map(|p| of(sub(p.point, first)));
        all.max_by(|a, b| norm(*a).total_cmp(&norm(*b)))
    };
    let along = unit_or(far(&|p| p)?, [0.0; 3]);
    let spread = far(&|p| cross(along, p))?;
    let spanned = (norm(spread) > 1e-3 * size).then(|| unit_or(spread, [0.0; 3]));
    let axes = [Z, Y, X];
    let normals = axes.into_iter().chain(first_hinge(places)).chain(spanned);
    let off = |p: &JointInSpace, n: Vector| dot(sub(p.point, first), n).abs();
    let flat = |n: &Vector| places.iter().all(|p| off(p, *n) <= FLAT * size);
    let flat: Vec<Vector> = normals.filter(flat).collect();
    let found = flat.iter().find(|&&n| moves_across(places, n));
    let found = found.or_else(|| flat.iter().find(|&&n| mostly_moves_across(places, n)));
    found.copied()
}

/// Returns the direction of the first hinge.
fn first_hinge(places: &[JointInSpace]) -> Option<Vector> {
    let mut hinges = places.iter().filter(|p| p.turn == Turn::Hinge);
    hinges.next().map(|p| p.z)
}

/// Returns true if hinges turn about this direction and other axes are along or across it.
fn moves_across(places: &[JointInSpace], n: Vector) -> bool {
    lies_across(places, n) == Some(0)
}

/// Returns true if most hinges turn about this direction, and the others about axes across it, such as a screw's or a
/// shaft's.
fn mostly_moves_across(places: &[JointInSpace], n: Vector) -> bool {
    let hinges = places.iter().filter(|p| p.turn == Turn::Hinge).count();
    lies_across(places, n).is_some_and(|other| 2 * other < hinges)
}

/// Returns the number of hinges about axes across a direction, or `None` if an axis is oblique.
fn lies_across(places: &[JointInSpace], n: Vector) -> Option<usize> {
    let mut other = 0;
    for p in places.iter().filter(|p| p.turn != Turn::Any) {
        let along = norm(cross(p.z, n)) < FLAT;
        let across = dot(p.z, n).abs() < FLAT;
        if !along && !across {
            return None;
        }
        other += usize::from(p.turn == Turn::Hinge && !along);
    }
    Some(other)
}

/// Returns a cost for joints and links that lie on each other.
fn crowding_cost(
    places: &[JointInSpace],
    on: &[Point],
    links: &[(LinkId, Vec<usize>)],
    frame: LinkId,
) -> f64 {
    const NEAR: f64 = 34.0;
    const CLEAR: f64 = 14.0;
    let mut cost = 0.0;
    for i in 0..on.len() {
        for j in 0..i {
            let d = norm2(sub2(on[i], on[j]));
            if d < NEAR && norm(sub(places[i].point, places[j].point)) > 0.0 {
                cost += 2.0 * ((NEAR - d) / NEAR).powi(2);
            }
        }
    }
    let moving = links.iter().filter(|(l, _)| *l != frame);
    let moving: Vec<(_, Vec<(usize, usize)>)> =
        moving.map(|(_, of)| (of, sides_of(of).collect())).collect();
    for (n, (of, sides)) in moving.iter().enumerate() {
        for &(a, b) in sides {
            for (j, &p) in on.iter().enumerate() {
                if !of.contains(&j) {
                    let d = to_segment(p, on[a], on[b]);
                    cost += 0.8 * ((CLEAR - d) / CLEAR).max(0.0);
                }
            }
            let side = [on[a], on[b]];
            for (_, others) in &moving[..n] {
                let crossing = |&&(c, d): &&(usize, usize)| {
                    !are_apart(side, [on[c], on[d]])
                        && segments_cross(side[0], side[1], on[c], on[d])
                };
                cost += 0.12 * others.iter().filter(crossing).count() as f64;
            }
        }
    }
    cost
}

fn places_extent(places: &[JointInSpace]) -> f64 {
    box_diagonal(places.iter().map(|p| p.point))
}

fn places_middle(places: &[JointInSpace]) -> Vector {
    let sum = places.iter().fold([0.0; 3], |s, p| add(s, p.point));
    scale(sum, 1.0 / places.len().max(1) as f64)
}

/// Returns a unit vector perpendicular to another vector.
pub(crate) fn unit_across(z: Vector) -> Vector {
    let [a, b] = [X, Y].map(|e| sub(e, scale(z, dot(e, z))));
    let longer = if norm(a) > norm(b) { a } else { b };
    unit_or(longer, X)
}
