//! The shapes of MJCF.

use crate::file::problem::ImportError;
use crate::geom::rigid::RigidMotion;
use crate::geom::vector::{Vector, add, length, scale, sub};
use crate::robots::convert::payload::{LinkShape, Payload, Solid, Use, Weight};
use crate::robots::convert::solid::filled;
use crate::robots::mjcf::context::Context;
use crate::robots::mjcf::defaults::Lookup;
use crate::robots::xml::Element;
use std::collections::BTreeMap;

/// Words that say how a shape touches.
const TOUCH: [&str; 12] = [
    "contype",
    "conaffinity",
    "condim",
    "group",
    "priority",
    "friction",
    "solmix",
    "solref",
    "solimp",
    "margin",
    "gap",
    "fluidshape",
];
/// What shapes are coloured that say nothing.
const GREY: [f64; 4] = [0.5, 0.5, 0.5, 1.0];
/// kg/m³ where nothing is said.
const WATER: f64 = 1000.0;

/// What shapes refer to.
pub(super) struct Geoms<'a> {
    /// Files and scales of meshes, by name.
    meshes: BTreeMap<String, (String, Vector)>,
    /// Colours of materials.
    colours: BTreeMap<&'a str, [f64; 4]>,
    /// Groups of shapes that say what bodies weigh.
    groups: [f64; 2],
}

impl<'a> Geoms<'a> {
    pub(super) fn of(root: Element<'a>) -> Result<Geoms<'a>, ImportError> {
        let mut out = Geoms {
            meshes: BTreeMap::new(),
            colours: BTreeMap::new(),
            groups: [0.0, 5.0],
        };
        let mut folder = String::new();
        for c in root.named("compiler") {
            if let Some(d) = c.attribute("meshdir").or(c.attribute("assetdir")) {
                folder = d.trim_end_matches('/').to_owned();
            }
            out.groups = c.numbers::<2>("inertiagrouprange")?.unwrap_or(out.groups);
        }
        for a in root
            .named("asset")
            .flat_map(|s| s.children().collect::<Vec<_>>())
        {
            match (a.name(), a.attribute("name")) {
                ("material", Some(name)) => {
                    if let Some(c) = a.numbers::<4>("rgba")? {
                        out.colours.insert(name, c);
                    }
                }
                ("mesh", name) => {
                    let Some(file) = a.attribute("file") else {
                        continue;
                    };
                    let stem = std::path::Path::new(file).file_stem();
                    let stem = stem.map(|s| s.to_string_lossy().into_owned());
                    let name = name.map(str::to_owned).or(stem).unwrap_or_default();
                    let path = if folder.is_empty() || file.starts_with('/') {
                        file.to_owned()
                    } else {
                        format!("{folder}/{file}")
                    };
                    out.meshes
                        .insert(name, (path, a.vector("scale", [1.0; 3])?));
                }
                _ => {}
            }
        }
        Ok(out)
    }
}

/// The numbers of `size`; 0 where there are fewer than three.
fn sizes(look: &Lookup<'_>) -> Result<[f64; 3], ImportError> {
    let Some((e, text)) = look.attribute("size") else {
        return Ok([0.0; 3]);
    };
    let mut out = [0.0; 3];
    match text.split_whitespace().count() {
        0 => {}
        1 => out[..1].copy_from_slice(&e.numbers::<1>("size")?.unwrap_or_default()),
        2 => out[..2].copy_from_slice(&e.numbers::<2>("size")?.unwrap_or_default()),
        _ => out = e.numbers::<3>("size")?.unwrap_or_default(),
    }
    Ok(out)
}

/// How large a shape is and where it stands.
struct Measures {
    /// The numbers of `size`; 0 where there are fewer.
    sizes: [f64; 3],
    /// Half the length of what is round.
    half: f64,
    /// Half the depth and half the length of what has three sizes.
    deep: f64,
    long: f64,
    place: RigidMotion,
}

impl Measures {
    fn of<'a>(look: &Lookup<'a>, context: &Context<'a>) -> Result<Measures, ImportError> {
        let sizes = sizes(look)?;
        let mut out = Measures {
            sizes,
            half: sizes[1],
            deep: sizes[1],
            long: sizes[2],
            place: RigidMotion {
                translation: look.vector("pos", [0.0; 3])?,
                ..orientation(look, context)?
            },
        };
        // Between two points a shape is round, or as deep as it is wide, and as long as they are apart.
        if let Some([a, b, c, d, f, g]) = look.numbers::<6>("fromto")? {
            let (from, to) = ([a, b, c], [d, f, g]);
            out.half = length(sub(to, from)) / 2.0;
            (out.deep, out.long) = (sizes[0], out.half);
            out.place = RigidMotion {
                translation: scale(add(from, to), 0.5),
                ..RigidMotion::z_to(sub(from, to))
            };
        }
        Ok(out)
    }
}

/// The solid of a shape, or what it is called where it is of a kind that is not carried over.
fn solid(look: &Lookup<'_>, measures: &Measures, geoms: &Geoms<'_>) -> Result<Solid, String> {
    let word = look.attribute("type").map(|a| a.1);
    let word = word.unwrap_or(if look.attribute("mesh").is_some() {
        "mesh"
    } else {
        "sphere"
    });
    let &Measures {
        sizes: [first, second, _],
        half,
        deep,
        long,
        ..
    } = measures;
    Ok(match word {
        "sphere" => Solid::Sphere(first),
        "capsule" => Solid::Capsule(first, 2.0 * half),
        "cylinder" => Solid::Cylinder(first, 2.0 * half),
        "ellipsoid" => Solid::Ellipsoid([first, deep, long]),
        "box" => Solid::Box([2.0 * first, 2.0 * deep, 2.0 * long]),
        "plane" => Solid::Plane([2.0 * first, 2.0 * second]),
        "mesh" => match look
            .attribute("mesh")
            .and_then(|(_, m)| geoms.meshes.get(m))
        {
            Some((file, scale)) => Solid::Mesh(file.clone(), *scale),
            None => return Err("mesh that is no file".to_owned()),
        },
        other => return Err(format!("geometry of kind {other}")),
    })
}

/// A shape, and what it weighs, NaN where only its file says so; none of a kind that is not carried over, which is noted.
pub(super) fn geom<'a>(
    e: Element<'a>,
    look: &Lookup<'a>,
    context: &Context<'a>,
    geoms: &Geoms<'a>,
    out: &mut Payload,
) -> Result<Option<(LinkShape, Option<Weight>)>, ImportError> {
    let name = e.attribute("name");
    let measures = Measures::of(look, context)?;
    let solid = match solid(look, &measures, geoms) {
        Ok(solid) => solid,
        Err(kind) => {
            out.lost.not_read(&kind, name);
            return Ok(None);
        }
    };
    let place = measures.place;
    let weight = weigh(&solid, place, look, geoms)?;
    let number = |k: &str| look.attribute(k).map(|(_, v)| v.trim() == "0");
    let through = number("contype") == Some(true) && number("conaffinity") == Some(true);
    let material = look
        .attribute("material")
        .and_then(|(_, m)| geoms.colours.get(m))
        .copied();
    // MuJoCo takes its own grey for "as the material says".
    let stated = look.numbers::<4>("rgba")?;
    let colour = stated.filter(|c| *c != GREY);
    Ok(Some((
        LinkShape {
            name: name.map(str::to_owned),
            solid,
            place,
            colour: colour.or(material).or(stated),
            use_: if through { Use::Seen } else { Use::Both },
            words: look.words(&TOUCH),
        },
        weight,
    )))
}

/// The turn that one of the five ways stands for, of the element or of its class.
fn orientation<'a>(look: &Lookup<'a>, context: &Context<'a>) -> Result<RigidMotion, ImportError> {
    let ways = ["quat", "axisangle", "xyaxes", "zaxis", "euler"];
    match ways.iter().find_map(|w| look.attribute(w)) {
        Some((e, _)) => context.compiler.turned(e),
        None => Ok(RigidMotion::IDENTITY),
    }
}

fn weigh(
    solid: &Solid,
    place: RigidMotion,
    look: &Lookup<'_>,
    geoms: &Geoms<'_>,
) -> Result<Option<Weight>, ImportError> {
    let group = look.numbers::<1>("group")?.map_or(0.0, |[g]| g);
    let stated = look.numbers::<1>("mass")?.map(|[m]| m);
    if group < geoms.groups[0] || group > geoms.groups[1] || matches!(solid, Solid::Plane(_)) {
        return Ok(None);
    }
    let Some((volume, [x, y, z])) = filled(solid) else {
        // Known only to those who read its file.
        let unknown = Weight {
            mass: f64::NAN,
            place,
            tensor: [0.0; 6],
        };
        return Ok((stated != Some(0.0)).then_some(unknown));
    };
    let density = look.numbers::<1>("density")?.map_or(WATER, |[d]| d);
    let mass = stated.unwrap_or(density * volume);
    let tensor = [x * mass, y * mass, z * mass, 0.0, 0.0, 0.0];
    Ok((mass > 0.0).then_some(Weight {
        mass,
        place,
        tensor,
    }))
}
