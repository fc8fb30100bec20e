//! The weights of the bodies of an MJCF file: from their `<inertial>`, otherwise from their shapes.

mod weight;

pub(super) use crate::robots::mjcf::weights::weight::Weight;

use crate::geom::rigid::RigidMotion;
use crate::robots::description::Robot;
use crate::robots::mjcf::Waiting;
use crate::robots::mjcf::context::Compiler;
use crate::robots::mjcf::context::Defaults;
use crate::robots::mjcf::weights::weight::weight_of_shape;
use crate::robots::mjcf::weights::weight::{Settings, combine};
use crate::robots::warning::Read;
use crate::robots::xml::element::Element;
use std::collections::BTreeMap;

/// Returns the weights of the links, in their frames; the robot is that of the same document.
pub(super) fn read_weights(root: Element<'_>, robot: &Robot) -> Read<BTreeMap<usize, Weight>> {
    let defaults = Defaults::read(root)?;
    let settings = Settings::read_settings(root)?;
    let mut stated = BTreeMap::new();
    let mut of_shapes: BTreeMap<usize, Vec<Weight>> = BTreeMap::new();
    let mut stack: Vec<Waiting<'_>> = root
        .children_named("worldbody")
        .map(Waiting::at_world)
        .collect();
    while let Some(at) = stack.pop() {
        for e in at.element.children() {
            let inner = |link, place| at.at_element(e, link, place);
            match e.name() {
                "body" => {
                    if let Some(&link) = robot.said.get(&e.id) {
                        stack.push(inner(link, RigidMotion::IDENTITY));
                    }
                }
                "frame" => {
                    let place = at.place.then(&settings.compiler.read_place(e)?);
                    stack.push(inner(at.link, place));
                }
                "geom" => {
                    let look = defaults.lookup(e, "geom", at.class)?;
                    if let Some(w) = weight_of_shape(&look, &settings)? {
                        let place = at.place.then(&w.place);
                        let all = of_shapes.entry(at.link).or_default();
                        all.push(Weight { place, ..w });
                    }
                }
                "inertial" => {
                    stated.insert(at.link, read_inertial(e, &settings.compiler)?);
                }
                _ => {}
            }
        }
    }
    Ok(combine_weights(robot, stated, &of_shapes, &settings))
}

/// Returns the weights of links: as given, or from their shapes, and at least the minimum of the file.
fn combine_weights(
    robot: &Robot,
    stated: BTreeMap<usize, Weight>,
    of_shapes: &BTreeMap<usize, Vec<Weight>>,
    settings: &Settings,
) -> BTreeMap<usize, Weight> {
    let mut out = stated;
    // The world does not move and needs no weight.
    for (&link, all) in of_shapes.iter().filter(|(l, _)| **l != 0) {
        let asked = settings.from_shapes.unwrap_or(!out.contains_key(&link));
        if let (true, Some(w)) = (asked, combine(all)) {
            out.insert(link, w);
        }
    }
    let bounded = settings.least.iter().any(|x| *x > 0.0);
    for &link in robot.said.values().filter(|l| **l != 0) {
        let none = bounded.then_some(Weight::NOTHING);
        if let Some(w) = out.get(&link).copied().or(none) {
            out.insert(link, settings.bound_weight(w));
        }
    }
    out
}

/// Reads an `<inertial>`.
fn read_inertial(e: Element<'_>, compiler: &Compiler) -> Read<Weight> {
    let mut tensor = [0.0; 6];
    if let Some(d) = e.read_numbers::<3>("diaginertia")? {
        tensor[..3].copy_from_slice(&d);
    }
    if let Some(all) = e.read_numbers::<6>("fullinertia")? {
        tensor = all;
    }
    Ok(Weight {
        mass: e.read_numbers::<1>("mass")?.map_or(0.0, |[x]| x),
        place: compiler.read_place(e)?,
        tensor,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robots::import::import;
    use crate::robots::warning::Options;

    /// Returns what the one body of a model weighs.
    fn weighed(compiler: &str, body: &str) -> Weight {
        let text = format!(
            "<mujoco><compiler {compiler}/><worldbody><body name='b'><joint name='j'/>{body}</body></worldbody></mujoco>"
        );
        let nothing = |_: &str| Err(std::io::Error::other("there is no such file"));
        let found = import("m.xml", text.as_bytes(), &nothing, &Options::default());
        let origin = found.unwrap_or_else(|e| panic!("{e}")).origin;
        let root = origin.element(origin.root);
        let all = read_weights(root, &origin.robot).unwrap_or_else(|e| panic!("{e}"));
        all.into_values().next().unwrap_or(Weight::NOTHING)
    }

    fn assert_near(found: &[f64], wanted: &[f64]) {
        let near = |(f, w): (&f64, &f64)| (f - w).abs() < 1e-9;
        assert!(
            found.len() == wanted.len() && found.iter().zip(wanted).all(near),
            "{found:?}, not {wanted:?}"
        );
    }

    /// Masses of 3 and 1 kg at (0, 0, 0) and (0.2, 0.1, 0.4) have their centre a quarter of the way. Their inertia is that of each, and
    /// that of 3/4 kg at their distance.
    #[test]
    fn shapes_apart_weigh_together() {
        let w = weighed(
            "",
            "<geom type='sphere' size='0.1' mass='3'/><frame pos='0.2 0 0'><geom type='sphere' size='0.1' mass='1' pos='0 0.1 0.4'/></frame>",
        );
        assert_near(&[w.mass], &[4.0]);
        assert_near(&w.place.translation, &[0.05, 0.025, 0.1]);
        let own = 4.0 * 0.4 * 0.01;
        let wanted = [
            own + 0.75 * (0.01 + 0.16),
            own + 0.75 * (0.04 + 0.16),
            own + 0.75 * (0.04 + 0.01),
            -0.75 * 0.02,
            -0.75 * 0.08,
            -0.75 * 0.04,
        ];
        assert_near(&w.tensor, &wanted);
    }

    /// A box of 2 by 1 by 1 m turned by 30° about z: (Ix - Iy) sin cos is its product of inertia.
    #[test]
    fn what_is_turned_has_products_of_inertia() {
        let w = weighed(
            "",
            "<geom type='box' size='1 0.5 0.5' mass='12' euler='0 0 30'/>",
        );
        let (x, y) = (1.0 + 1.0, 4.0 + 1.0);
        let (s, c) = (0.5, 3f64.sqrt() / 2.0);
        let (xx, yy) = (c * c * x + s * s * y, s * s * x + c * c * y);
        assert_near(&w.tensor, &[xx, yy, y, (x - y) * s * c, 0.0, 0.0]);
    }

    /// MuJoCo takes the first size alone of a box between two points, for both sides of it.
    #[test]
    fn a_box_between_points_is_as_deep_as_it_is_wide() {
        let w = weighed(
            "",
            "<geom type='box' size='0.1 0.7 0.9' fromto='0 0 0 0 0 2' density='10'/>",
        );
        assert_near(&[w.mass], &[10.0 * 0.2 * 0.2 * 2.0]);
        assert_near(&w.place.translation, &[0.0, 0.0, 1.0]);
    }

    #[test]
    fn the_file_says_which_weights_hold() {
        let both = "<inertial mass='2' pos='0 0 0' diaginertia='1 1 3'/><geom size='0.1' mass='5' group='1'/>";
        for (compiler, mass) in [
            ("", 2.0),
            ("inertiafromgeom='true'", 5.0),
            ("inertiafromgeom='false'", 2.0),
            ("inertiafromgeom='true' inertiagrouprange='2 3'", 2.0),
            ("boundmass='7'", 7.0),
        ] {
            assert_near(&[weighed(compiler, both).mass], &[mass]);
        }
        let mean = 5.0 / 3.0;
        let balanced = weighed("balanceinertia='true'", both).tensor;
        assert_near(&balanced, &[mean, mean, mean, 0.0, 0.0, 0.0]);
        let plain = "<geom type='plane' size='1 1 1'/>";
        assert_near(&[weighed("", plain).mass], &[0.0]);
        let least = weighed("boundinertia='0.5'", plain).tensor;
        assert_near(&least, &[0.5, 0.5, 0.5, 0.0, 0.0, 0.0]);
    }
}
