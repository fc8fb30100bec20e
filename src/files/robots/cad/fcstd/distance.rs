//! The constraint of a distance joint, by the kinds of its two elements.

use crate::robots::cad::fcstd::objects::Object;
use crate::robots::cad::fcstd::reference::Reference;
use crate::robots::cad::holds::Holds;
use crate::robots::prelude::*;

/// Below this two directions are one, and a line lies in a plane.
const SINE: f64 = 1e-3;

/// Returns the kind of an element by its name and that of its object, if its shape does not define it.
fn by_name(element: &str, object: &str) -> Option<ShapeKind> {
    if element.starts_with("Vertex") {
        return Some(ShapeKind::Vertex);
    }
    let flat = ["App::Plane", "PartDesign::Plane", "Part::DatumPlane"];
    let straight = ["App::Line", "PartDesign::Line", "Part::DatumLine"];
    let point = ["App::Point", "PartDesign::Point", "Part::DatumPoint"];
    let is = |list: [&str; 3]| element.is_empty() && list.contains(&object);
    match () {
        () if is(flat) => Some(ShapeKind::Plane),
        () if is(straight) => Some(ShapeKind::Line),
        () if is(point) => Some(ShapeKind::Vertex),
        () => None,
    }
}

/// Returns the constraint between two kinds, at frames in the assembly and with the distance of the joint.
fn distance_constraint(kinds: Kinds, frames: [RigidMotion; 2], value: f64) -> Held {
    use ShapeKind::{Circle, Curve, Cylinder, Line, Plane, Sphere, Surface, Torus, Vertex};
    let [a, b] = kinds.map(|k| k.unwrap_or(Surface));
    let constraint = |a: ShapeKind, b: ShapeKind, swap: bool| {
        // A distance from a plane may be on either side of it.
        let off = |more: f64| (value.abs() + more).copysign(height_above_plane(&frames, swap));
        Some(match (a, b) {
            (Vertex, Vertex) => Holds::PointPoint(value),
            (Line | Circle(_), Line | Circle(_)) => {
                Holds::LineLine(value + circle_radius(a) + circle_radius(b))
            }
            (Plane, Plane) => Holds::Planar(off(0.0)),
            (Plane, Cylinder(r)) => Holds::LineInPlane(off(r)),
            (Plane, Line) => Holds::LineInPlane(off(0.0)),
            (Plane, Sphere(r)) => Holds::PointInPlane(off(r)),
            (Plane | Curve | Circle(_), Vertex) => Holds::PointInPlane(off(0.0)),
            (Line, Vertex) => Holds::PointLine(value),
            (Cylinder(r), Cylinder(s) | Torus(s)) | (Torus(r), Cylinder(s)) => {
                Holds::LineLine(value + r + s)
            }
            (Cylinder(r) | Torus(r), Sphere(s)) => Holds::PointLine(value + r + s),
            (Cylinder(r), Vertex) => Holds::PointLine(value + r),
            (Sphere(r), Sphere(s)) => Holds::PointPoint(value + r + s),
            (Sphere(r), Vertex) | (Vertex, Sphere(r)) => Holds::PointPoint(value + r),
            _ => return None,
        })
    };
    let swapped = || Some((constraint(b, a, true)?, true));
    let found = constraint(a, b, false).map(|holds| (holds, false));
    let (holds, swap) = found.or_else(swapped).unwrap_or_else(|| {
        let planes = constraint(Plane, Plane, false);
        (planes.unwrap_or(Holds::Planar(value)), false)
    });
    let found = Held {
        swap,
        ..Held::new(holds, frames)
    };
    match kinds {
        [Some(_), Some(_)] => found,
        _ => guess_constraint(kinds, found),
    }
}

/// Returns the distance of one frame from the plane of the other, along its normal; with `swap` the plane is the second.
fn height_above_plane(frames: &[RigidMotion; 2], swap: bool) -> f64 {
    let [plane, other] = [swap, !swap].map(|second| &frames[usize::from(second)]);
    let z = plane.rotation.map(|row| row[2]);
    dot(sub(other.translation, plane.translation), z)
}

fn circle_radius(k: ShapeKind) -> f64 {
    match k {
        ShapeKind::Circle(r) => r,
        _ => 0.0,
    }
}

/// Determines unknown kinds of faces from the directions of the two frames at a solved pose, as far as possible.
fn guess_constraint(kinds: Kinds, found: Held) -> Held {
    let frames = &found.frames;
    let [z, line] = frames.map(|m| m.rotation.map(|row| row[2]));
    let swap = kinds[1] == Some(ShapeKind::Plane);
    if length(cross(z, line)) > 1.0 - SINE {
        // A plane and a cylinder; the first is the plane by default.
        return Held {
            holds: Holds::LineInPlane(height_above_plane(frames, swap)),
            swap,
            doubt: Some(
                "the kinds of its faces are not known; by their directions they are treated as a plane and a cylinder",
            ),
            ..found
        };
    }
    Held {
        doubt: Some("the kinds of its elements are not known; they are treated as planes"),
        holds: match found.holds {
            Holds::Planar(_) => Holds::Planar(height_above_plane(frames, false)),
            other => other,
        },
        ..found
    }
}

/// Returns the frame of a rack, with x along its direction of sliding and y away from the pinion.
fn rack_frame(rack: &RigidMotion, pinion: &RigidMotion, slide: [f64; 3]) -> RigidMotion {
    let z = pinion.rotation.map(|row| row[2]);
    let x = crate::geom::rigid::unit_or_z(add_scaled(slide, -dot(slide, z), z));
    let y = cross(z, x);
    let to_rack = sub(rack.translation, pinion.translation);
    // The teeth are on the side of the pinion where the rack is.
    let sign = if dot(to_rack, y) > 0.0 { -1.0 } else { 1.0 };
    let [x, y] = [x, y].map(|v| v.map(|c| sign * c));
    RigidMotion {
        rotation: [0, 1, 2].map(|i| [x[i], y[i], z[i]]),
        translation: rack.translation,
    }
}

/// A reader of the text of a member of the archive. It returns `None` if the member is missing or not text.
pub(crate) type Shapes<'a> = &'a dyn Fn(&str) -> Option<String>;

/// The constraint of a joint, its frames in the assembly, and whether its two parts are swapped; or why it cannot be represented.
pub(crate) struct Held {
    pub(crate) holds: Holds,
    pub(crate) frames: [RigidMotion; 2],
    pub(crate) swap: bool,
    pub(crate) doubt: Option<&'static str>,
}

impl Held {
    fn new(holds: Holds, frames: [RigidMotion; 2]) -> Held {
        Held {
            holds,
            frames,
            swap: false,
            doubt: None,
        }
    }
}

/// The direction of a slide, and the part that has it: racks slide along one.
pub(crate) type Slide<'a> = (Option<&'a str>, [f64; 3]);

/// The two ends of a joint.
type Ends<'a> = [Reference<'a>; 2];
/// The kinds of two elements, as far as they are known.
type Kinds = [Option<ShapeKind>; 2];

/// Returns the two frames of a joint in the assembly.
///
/// # Errors
/// Returns an error if a number of a placement is invalid.
pub(crate) fn joint_frames(joint: &Object<'_>, ends: &Ends<'_>) -> Read<[RigidMotion; 2]> {
    let mut out = [RigidMotion::IDENTITY; 2];
    for (i, end) in ends.iter().enumerate() {
        let own = joint.read_placement(&format!("Placement{}", i + 1))?;
        let own = own.unwrap_or(RigidMotion::IDENTITY);
        out[i] = end.place.then(&end.inner).then(&own);
    }
    Ok(out)
}

/// Returns the constraint of a joint type. `None` for a type of FreeCAD that is not known here.
///
/// # Errors
/// Returns an error if a figure is not a number.
pub(crate) fn joint_constraint(
    word: &str,
    joint: &Object<'_>,
    ends: &Ends<'_>,
    slides: &[Slide<'_>],
    shapes: Shapes<'_>,
) -> Read<Option<Held>> {
    let frames = joint_frames(joint, ends)?;
    let figure = |name: &str| -> Read<f64> { Ok(joint.property_number(name)?.unwrap_or(0.0)) };
    let plain = |holds| Held::new(holds, frames);
    Ok(Some(match word {
        "Fixed" => plain(Holds::Fixed),
        "Revolute" => plain(Holds::Revolute),
        "Cylindrical" => plain(Holds::Cylindrical),
        "Slider" => plain(Holds::Translational),
        "Ball" => plain(Holds::Spherical),
        "Parallel" => plain(Holds::ParallelAxes),
        "Perpendicular" => plain(Holds::Angle(0.0)),
        "Angle" => {
            let degrees = match joint.find_property("Angle") {
                Some(_) => figure("Angle")?,
                None => figure("Distance")?,
            };
            // FreeCAD takes an angle of 0 as parallel axes.
            if (degrees % 180.0).abs() < 1e-9 {
                plain(Holds::ParallelAxes)
            } else {
                plain(Holds::Angle(degrees.to_radians().cos()))
            }
        }
        "Distance" => {
            let kinds = [0, 1].map(|i| kind_of(&ends[i], shapes));
            let found = distance_constraint(kinds, frames, figure("Distance")?);
            let [a, b] = frames;
            Held {
                holds: found.holds.settled(),
                frames: if found.swap { [b, a] } else { [a, b] },
                ..found
            }
        }
        "RackPinion" => rack_and_pinion(figure("Distance")?, ends, frames, slides),
        "Screw" => plain(Holds::Screw(figure("Distance")?)),
        "Gears" => plain(Holds::Gear([figure("Distance")?, figure("Distance2")?])),
        "Belt" => plain(Holds::Gear([figure("Distance")?, -figure("Distance2")?])),
        _ => return Ok(None),
    }))
}

/// Returns the kind of the element that a joint refers to.
fn kind_of(end: &Reference<'_>, shapes: Shapes<'_>) -> Option<ShapeKind> {
    by_name(end.element, end.object).or_else(|| element_kind(&shapes(end.shape?)?, end.element))
}

/// Returns the rack and pinion; the rack is the part with a slide across the pinion's axis.
fn rack_and_pinion(
    radius: f64,
    ends: &Ends<'_>,
    frames: [RigidMotion; 2],
    slides: &[Slide<'_>],
) -> Held {
    let slide = |i: usize| {
        let of_part = slides.iter().filter(|(p, _)| *p == ends[i].part);
        let axis = frames[1 - i].rotation.map(|row| row[2]);
        let mut across = of_part.filter(|(_, d)| length(cross(*d, axis)) > 0.5);
        across.next().map(|(_, d)| *d)
    };
    let (i, found) = match (slide(0), slide(1)) {
        (Some(d), _) => (0, Some(d)),
        (None, found) => (1, found),
    };
    let Some(direction) = found else {
        let doubt =
            "neither part has a slider; the first is treated as the rack, along x of its frame";
        return Held {
            doubt: Some(doubt),
            ..Held::new(Holds::RackPinion(radius), frames)
        };
    };
    let there = rack_frame(&frames[i], &frames[1 - i], direction);
    Held {
        swap: i == 1,
        ..Held::new(Holds::RackPinion(radius), [there, frames[1 - i]])
    }
}

/// The kind of an element of a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum ShapeKind {
    Vertex,
    Line,
    Circle(f64),
    Curve,
    Plane,
    Cylinder(f64),
    Cone,
    Sphere(f64),
    Torus(f64),
    Surface,
}

/// Returns the kind of an element, such as `Face3`. `None` if the shape does not define it.
fn element_kind(shape: &str, element: &str) -> Option<ShapeKind> {
    let number = |prefix: &str| element.strip_prefix(prefix)?.parse::<usize>().ok();
    let (tag, place) = match (number("Face"), number("Edge")) {
        (Some(n), _) => ("Fa", n),
        (_, Some(n)) => ("Ed", n),
        _ => return None,
    };
    let shapes = read_shapes(shape)?;
    let at = nth_shape(&shapes, tag, place)?;
    let geometry = shapes.get(at)?.geometry?;
    let section = if tag == "Fa" { "Surfaces" } else { "Curves" };
    of_geometry(section, geometry_line(shape, section, geometry)?)
}

/// A shape of the list: its tag, the shapes it is made of, and the surface or curve it lies on.
struct BrepShape<'a> {
    tag: &'a str,
    parts: Vec<usize>,
    geometry: Option<usize>,
}

/// Returns the lines after a heading that gives their number.
fn find_section<'a>(text: &'a str, heading: &str) -> Option<(usize, &'a str)> {
    let (_, rest) = text.split_once(&format!("\n{heading} "))?;
    let (count, below) = rest.split_once('\n')?;
    Some((count.trim().parse().ok()?, below))
}

/// Returns the shapes in the order of the file: parts come before the shapes they belong to, and are referred to by their place
/// from the end.
fn read_shapes(text: &str) -> Option<Vec<BrepShape<'_>>> {
    let (count, body) = find_section(text, "TShapes")?;
    // Each takes at least three lines.
    if count > body.len() / 3 {
        return None;
    }
    let mut out: Vec<BrepShape<'_>> = Vec::new();
    let mut lines = body.lines();
    while out.len() < count {
        let tag = lines.next()?.trim();
        if tag.is_empty() {
            continue;
        }
        let mut geometry = None;
        // The geometry ends with seven flags in a separate line.
        for line in lines.by_ref() {
            let words: Vec<&str> = line.split_whitespace().collect();
            if matches!(words[..], [flags] if flags.len() == 7 && flags.bytes().all(|b| b"01".contains(&b)))
            {
                break;
            }
            let index = match (tag, &words[..]) {
                ("Fa", [_, _, surface, _]) => surface.parse().ok(),
                ("Ed", ["1", curve, _, _, _]) => curve.parse().ok(),
                _ => None,
            };
            geometry = geometry.or(index);
        }
        let mut parts = Vec::new();
        'parts: for line in lines.by_ref() {
            for word in line.split_whitespace() {
                if word == "*" {
                    break 'parts;
                }
                // +12, -12: the way it is turned; a number without a sign is a place.
                if let Some(from_end) = word.strip_prefix(['+', '-', 'i', 'e']) {
                    parts.push(count.checked_sub(from_end.parse().ok()?)?);
                }
            }
        }
        out.push(BrepShape {
            tag,
            parts,
            geometry,
        });
    }
    Some(out)
}

/// Returns the place of the n-th shape of a tag, from 1, in the order of a traversal from the whole down, each counted once.
fn nth_shape(shapes: &[BrepShape<'_>], tag: &str, n: usize) -> Option<usize> {
    let mut met = vec![false; shapes.len()];
    let mut stack = vec![shapes.len().checked_sub(1)?];
    let mut left = n;
    while let Some(at) = stack.pop() {
        if std::mem::replace(met.get_mut(at)?, true) {
            continue;
        }
        if shapes[at].tag == tag {
            left = left.checked_sub(1)?;
            if left == 0 {
                return Some(at);
            }
        }
        stack.extend(shapes[at].parts.iter().rev());
    }
    None
}

/// Returns the line of a surface or curve of simple kind.
fn geometry_line<'a>(text: &'a str, heading: &str, n: usize) -> Option<&'a str> {
    let (count, body) = find_section(text, heading)?;
    if n == 0 || n > count {
        return None;
    }
    // Simple kinds take one line, others more, so lines after another kind cannot be counted.
    let mut lines = body.lines();
    for _ in 1..n {
        let kind: usize = lines.next()?.split_whitespace().next()?.parse().ok()?;
        if !(1..=5).contains(&kind) {
            return None;
        }
    }
    lines.next()
}

fn of_geometry(heading: &str, line: &str) -> Option<ShapeKind> {
    let (kind, rest) = line.trim().split_once(' ')?;
    let last = rest.rsplit(' ').find_map(|w| w.parse().ok())?;
    Some(match (heading, kind) {
        ("Surfaces", "1") => ShapeKind::Plane,
        ("Surfaces", "2") => ShapeKind::Cylinder(last),
        ("Surfaces", "3") => ShapeKind::Cone,
        ("Surfaces", "4") => ShapeKind::Sphere(last),
        ("Surfaces", "5") => ShapeKind::Torus(last),
        ("Surfaces", _) => ShapeKind::Surface,
        (_, "1") => ShapeKind::Line,
        (_, "2") => ShapeKind::Circle(last),
        _ => ShapeKind::Curve,
    })
}
