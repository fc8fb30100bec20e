//! OndselSolver's assemblies, `.asmt`: parts with markers, and joints between two markers each.

use crate::robots::cad::holds::Holds;
use crate::robots::cad::{Assembly, Connection, NO_LIMITS};
use crate::robots::prelude::*;

/// The beginnings of the first line of a file: that of OndselSolver, whose files are in millimetres, and the old one.
const HEADS: [(&str, &str); 2] = [("OndselSolver", "mm"), ("freeCAD: 3D CAD", "m")];
/// Rows of results, after all rows that are read.
const RESULTS: &str = "TimeSeries";
/// Labels of the joints of contacts, which constrain nothing until parts touch.
const CONTACT: &str = "Contact";

/// Returns true if a text is an assembly of OndselSolver, judged by its first line.
pub(crate) fn is_one(text: &[u8]) -> bool {
    HEADS
        .iter()
        .any(|(head, _)| text.starts_with(head.as_bytes()))
}

/// Reads the lines of a file into the arena.
pub(crate) fn read_lines(document: &mut Document, name: &str, text: String) -> Read<usize> {
    document.read_outline(name, text, RESULTS)
}

/// Reads an assembly as a robot.
///
/// # Errors
/// Returns the first problem found, with its place.
pub(crate) fn read_assembly(input: Input<'_>) -> Read<Robot> {
    let text = input.document.sources[0].text.as_str();
    let unit = HEADS.iter().find(|(head, _)| text.starts_with(head));
    let unit = unit.map_or("mm", |(_, unit)| *unit);
    let root = input.document.element(input.root);
    let name = name(root)?;
    let mut robot = Robot::new(name);
    let ground = read_pose(root)?;
    let mut parts = vec![("ground".to_owned(), ground)];
    let mut markers = BTreeMap::new();
    collect_markers(root, 0, &ground, name, &mut markers)?;
    let all = root.first_child("Parts");
    for part in all.iter().flat_map(|p| p.children_named("Part")) {
        part.check_room("parts", parts.len())?;
        let (own, place) = (self::name(part)?, ground.then(&read_pose(part)?));
        let path = format!("{name}/{own}");
        collect_markers(part, parts.len(), &place, &path, &mut markers)?;
        parts.push((own.to_owned(), place));
    }
    let sets = root.first_child("ConstraintSets");
    let mut connections = Vec::new();
    let within = |set: &str| -> Vec<Element<'_>> {
        let found = sets.and_then(|s| s.first_child(set));
        found.iter().flat_map(|s| s.children()).collect()
    };
    for joint in within("Joints") {
        joint.check_room("joints", connections.len())?;
        if joint.name().contains(CONTACT) {
            robot.report.drop_element("contact", &label_of(joint));
            continue;
        }
        connections.push(read_connection(joint, &markers)?);
    }
    for e in ["Motions", "GeneralConstraintSets"]
        .into_iter()
        .flat_map(within)
    {
        robot.report.drop_element(e.name(), &label_of(e));
    }
    for limit in within("Limits") {
        robot.report.add_approximation(&label_of(limit), NO_LIMITS);
    }
    let assembly = Assembly {
        name: name.to_owned(),
        unit,
        parts,
        connections,
    };
    Ok(assembly.to_robot(robot, input.options))
}

/// Returns the child with a label, or an error if it is missing.
fn required_child<'a>(e: Element<'a>, label: &str) -> Read<Element<'a>> {
    let found = e.first_child(label);
    found.ok_or_else(|| e.error_at(None, missing_problem(&label_of(e), label)))
}

fn name(e: Element<'_>) -> Read<&str> {
    Ok(required_child(e, "Name")?.text())
}

/// Returns the name of an element for messages: its label, and its name if it has one.
fn label_of(e: Element<'_>) -> String {
    match e.first_child("Name").map(Element::text) {
        Some(name) if !name.is_empty() => format!("{} \"{name}\"", e.name()),
        _ => e.name().to_owned(),
    }
}

/// Returns the pose of a label relative to its parent.
fn read_pose(e: Element<'_>) -> Read<RigidMotion> {
    let translation = required_child(e, "Position3D")?.text_numbers::<3>()?;
    let matrix = required_child(e, "RotationMatrix")?;
    let all = matrix.text_numbers::<9>()?;
    let rotation = [0, 3, 6].map(|i| [all[i], all[i + 1], all[i + 2]]);
    let m = RigidMotion {
        rotation,
        translation,
    };
    // The numbers may have few digits, but must give a rotation.
    let product = m.inverse().then(&m);
    let off = (0..3).flat_map(|i| (0..3).map(move |k| (i, k)));
    let off = off.map(|(i, k)| (product.rotation[i][k] - f64::from(u8::from(i == k))).abs());
    let [a, b, c] = rotation;
    let turned = length(c) > 0.5 && dot(a, cross(b, c)) > 0.0;
    if off.fold(0.0, f64::max) > 1e-3 || !turned {
        let found = matrix.text().replace(['\n', '\t'], " ");
        let found: String = found.chars().take(60).collect();
        let want = "write the rows of a rotation";
        let problem = bad_value(&label_of(e), "RotationMatrix", &found, want);
        return Err(matrix.error_at(None, problem));
    }
    Ok(m)
}

/// The part and the place of each marker, by its path.
type Markers = BTreeMap<String, (usize, RigidMotion)>;

fn collect_markers(
    e: Element<'_>,
    part: usize,
    place: &RigidMotion,
    path: &str,
    out: &mut Markers,
) -> Read<()> {
    let points = e.first_child("RefPoints");
    for point in points.iter().flat_map(|p| p.children_named("RefPoint")) {
        let at = place.then(&read_pose(point)?);
        let markers = point.first_child("Markers");
        for marker in markers.iter().flat_map(|m| m.children_named("Marker")) {
            marker.check_room("markers", out.len())?;
            let path = format!("/{path}/{}", name(marker)?);
            out.insert(path, (part, at.then(&read_pose(marker)?)));
        }
    }
    Ok(())
}

fn read_connection(e: Element<'_>, markers: &Markers) -> Read<Connection> {
    let end = |label: &str| {
        let said = required_child(e, label)?;
        let path = said.text();
        markers.get(path).copied().ok_or_else(|| {
            let problem = unknown_name(&label_of(e), ["marker", "markers"], path, markers.keys());
            said.error_at(None, problem)
        })
    };
    let ((i, near), (j, far)) = (end("MarkerI")?, end("MarkerJ")?);
    Ok(Connection {
        id: name(e)?.to_owned(),
        parts: [i, j],
        frames: [near, far],
        holds: read_constraint(e)?.settled(),
        element: e.id,
    })
}

fn read_figure(e: Element<'_>, label: &str) -> Read<f64> {
    let [x] = required_child(e, label)?.text_numbers::<1>()?;
    Ok(x)
}

/// Returns the offset of a plane; 0 if the file gives none.
fn read_offset(e: Element<'_>) -> Read<f64> {
    Ok(e.child_number("offset")?.unwrap_or(0.0))
}

fn read_constraint(e: Element<'_>) -> Read<Holds> {
    let word = e.name().strip_suffix("Joint").unwrap_or(e.name());
    Ok(match word {
        "Fixed" => Holds::Fixed,
        "Revolute" => Holds::Revolute,
        "Translational" => Holds::Translational,
        "Cylindrical" => Holds::Cylindrical,
        "Spherical" => Holds::Spherical,
        "Universal" => Holds::Universal,
        "ConstantVelocity" => Holds::ConstantVelocity,
        "Planar" => Holds::Planar(read_offset(e)?),
        "PointInPlane" | "InPlane" => Holds::PointInPlane(read_offset(e)?),
        "LineInPlane" => Holds::LineInPlane(read_offset(e)?),
        "PointInLine" | "InLine" => Holds::PointInLine,
        "ParallelAxes" => Holds::ParallelAxes,
        "NoRotation" => Holds::NoRotation,
        "Perpendicular" => Holds::Angle(0.0),
        "Angle" => Holds::Angle(read_figure(e, "theIzJz")?.cos()),
        "SphSph" | "SphericalSpherical" => Holds::PointPoint(read_figure(e, "distanceIJ")?),
        "CylSph" => Holds::PointLine(read_figure(e, "distanceIJ")?),
        "RevCyl" => Holds::LineLine(read_figure(e, "distanceIJ")?),
        "RevRev" => Holds::Hinges(read_figure(e, "distanceIJ")?),
        "Gear" => Holds::Gear([read_figure(e, "radiusI")?, read_figure(e, "radiusJ")?]),
        "RackPinion" => Holds::RackPinion(read_figure(e, "pitchRadius")?),
        "Screw" => Holds::Screw(read_figure(e, "pitch")?),
        other => {
            let problem = unknown_word(&label_of(e), "type", other, KNOWN);
            return Err(e.error_at(None, problem));
        }
    })
}

/// The joints that are read, for messages.
const KNOWN: &str = "Fixed, Revolute, Translational, Cylindrical, Spherical, Universal, ConstantVelocity, Planar, PointInPlane, LineInPlane, PointInLine, ParallelAxes, NoRotation, Perpendicular, Angle, SphSph, CylSph, RevCyl, RevRev, Gear, RackPinion, Screw";
