//! Joints of FreeCAD's Assembly workbench as connections.

use crate::geom::rigid::RigidMotion;
use crate::geom::vector::{cross, length};
use crate::robots::cad::holds::Holds;
use crate::robots::fcstd::brep::{ShapeKind, kind};
use crate::robots::fcstd::distance::{Distance, by_name, distance, rack};
use crate::robots::fcstd::objects::Object;
use crate::robots::fcstd::reference::Reference;
use crate::robots::problem::Read;

/// A reader of the text of a member of the archive. It returns `None` if the member is missing or not text.
pub(crate) type Shapes<'a> = &'a dyn Fn(&str) -> Option<String>;

/// The constraint of a joint, its frames in the assembly, and whether its two parts are swapped; or why it cannot be represented.
#[derive(Debug)]
pub(crate) struct Held {
    pub(crate) holds: Holds,
    pub(crate) frames: [RigidMotion; 2],
    pub(crate) swap: bool,
    pub(crate) doubt: Option<&'static str>,
}

/// The direction of a slide, and the part that has it: racks slide along one.
pub(crate) type Slide<'a> = (Option<&'a str>, [f64; 3]);

/// Returns the two frames of a joint in the assembly.
///
/// # Errors
/// Returns an error if a number of a placement is invalid.
pub(crate) fn frames(joint: &Object<'_>, ends: &[Reference<'_>; 2]) -> Read<[RigidMotion; 2]> {
    let mut out = [RigidMotion::IDENTITY; 2];
    for (i, end) in ends.iter().enumerate() {
        let own = joint.placement(&format!("Placement{}", i + 1))?;
        let own = own.unwrap_or(RigidMotion::IDENTITY);
        out[i] = end.place.then(&end.inner).then(&own);
    }
    Ok(out)
}

/// Returns the constraint of a joint type. `None` for a type of FreeCAD that is not known here.
///
/// # Errors
/// Returns an error if a figure is not a number.
pub(crate) fn held(
    word: &str,
    joint: &Object<'_>,
    ends: &[Reference<'_>; 2],
    slides: &[Slide<'_>],
    shapes: Shapes<'_>,
) -> Read<Option<Held>> {
    let frames = frames(joint, ends)?;
    let figure = |name: &str| -> Read<f64> { Ok(joint.number(name)?.unwrap_or(0.0)) };
    let plain = |holds| Held {
        holds,
        frames,
        swap: false,
        doubt: None,
    };
    Ok(Some(match word {
        "Fixed" => plain(Holds::Fixed),
        "Revolute" => plain(Holds::Revolute),
        "Cylindrical" => plain(Holds::Cylindrical),
        "Slider" => plain(Holds::Translational),
        "Ball" => plain(Holds::Spherical),
        "Parallel" => plain(Holds::ParallelAxes),
        "Perpendicular" => plain(Holds::Angle(0.0)),
        "Angle" => {
            let degrees = match joint.property("Angle") {
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
            let kinds = [0, 1].map(|i| of(&ends[i], shapes));
            let value = figure("Distance")?;
            let Distance { holds, swap, doubt } = distance(kinds, &frames, value);
            let [a, b] = frames;
            Held {
                holds: holds.settled(),
                frames: if swap { [b, a] } else { [a, b] },
                swap,
                doubt,
            }
        }
        "RackPinion" => pinion(figure("Distance")?, ends, frames, slides),
        "Screw" => plain(Holds::Screw(figure("Distance")?)),
        "Gears" => plain(Holds::Gear([figure("Distance")?, figure("Distance2")?])),
        "Belt" => plain(Holds::Gear([figure("Distance")?, -figure("Distance2")?])),
        _ => return Ok(None),
    }))
}

/// Returns the kind of the element that a joint refers to.
fn of(end: &Reference<'_>, shapes: Shapes<'_>) -> Option<ShapeKind> {
    by_name(end.element, end.object).or_else(|| kind(&shapes(end.shape?)?, end.element))
}

/// Returns the rack and pinion; the rack is the part with a slide across the pinion's axis.
fn pinion(
    radius: f64,
    ends: &[Reference<'_>; 2],
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
        return Held {
            holds: Holds::RackPinion(radius),
            frames,
            swap: false,
            doubt: Some(
                "neither part has a slider; the first is treated as the rack, along x of its frame",
            ),
        };
    };
    let there = rack(&frames[i], &frames[1 - i], direction);
    Held {
        holds: Holds::RackPinion(radius),
        frames: [there, frames[1 - i]],
        swap: i == 1,
        doubt: None,
    }
}
