//! `ozols convert`: descriptions carried over whole, in every direction.

mod carried;
mod closures;
mod command;
mod poses;
mod solids;

use crate::robots::{folder, none};
use ozols::robots::convert::{Converted, Target, Wanted, convert, figures};
use ozols::robots::{Imported, Options, import};
use std::collections::BTreeMap;

/// The models of the other tests: with loops by connect, in files beside, by mimic joints, by joints, and by Drake's weld.
pub(crate) fn models() -> Vec<(&'static str, Option<&'static str>)> {
    vec![
        ("gripper.xml", None),
        ("five_bar.urdf", Some("five_bar.yaml")),
        ("leg.urdf", Some("leg.yaml")),
        ("mimic_gripper.urdf", None),
        ("four_bar_loop.sdf", None),
        ("four_bar_weld.sdf", None),
    ]
}

pub(crate) fn read(file: &str, side: Option<&str>) -> Imported {
    let loops = side.map(|s| (s.to_owned(), std::fs::read(folder().join(s)).unwrap()));
    let options = Options {
        loops,
        assemble: file.ends_with(".sdf"),
        ..Options::default()
    };
    let bytes = std::fs::read(folder().join(file)).unwrap();
    import(file, &bytes, &none, &options).unwrap_or_else(|e| panic!("{e}"))
}

pub(crate) fn taken(name: &str, text: &str) -> Imported {
    import(name, text.as_bytes(), &none, &Options::default()).unwrap_or_else(|e| panic!("{e}"))
}

pub(crate) fn to(imported: &Imported, target: Target) -> Converted {
    convert(imported, target, &Wanted::default()).unwrap_or_else(|e| panic!("{e}"))
}

/// What is written, read again in the pose that it is closed in.
pub(crate) fn again(c: &Converted) -> Imported {
    let loops = c.beside.as_ref().filter(|b| !b.contains("closed_loop: []"));
    let options = Options {
        loops: loops.map(|b| ("loops.yaml".to_owned(), b.clone().into_bytes())),
        pose: c.pose.clone(),
        ..Options::default()
    };
    import("again.xml", c.text.as_bytes(), &none, &options)
        .unwrap_or_else(|e| panic!("{e}\n{}", c.text))
}

/// Attributes of all elements of a tag, by name; text of what stands between tags is not read.
pub(crate) fn tags(text: &str, tag: &str) -> Vec<BTreeMap<String, String>> {
    let open = format!("<{tag} ");
    let each = text.split(&open).skip(1).map(|rest| {
        let head = rest.split('>').next().unwrap().trim_end_matches('/');
        let words = head.split('"').collect::<Vec<_>>();
        let pairs = words.chunks(2).filter(|p| p.len() == 2);
        pairs
            .map(|p| {
                (
                    p[0].trim().trim_end_matches('=').to_owned(),
                    p[1].to_owned(),
                )
            })
            .collect()
    });
    each.collect()
}

pub(crate) fn numbers(text: &str) -> Vec<f64> {
    text.split_whitespace()
        .map(|w| w.parse().unwrap())
        .collect()
}

/// Names of the joints of a mechanism that close no loop.
fn joints(i: &Imported) -> Vec<String> {
    let m = &i.mechanism;
    let tree = m.joint_ids().filter(|&j| !i.origin.closes(j));
    tree.map(|j| m.joints[j].id.clone()).collect()
}

#[test]
fn w_sigma_and_names_come_back_in_every_direction() {
    for (file, side) in models() {
        let i = read(file, side);
        let wanted = figures(&i.mechanism).unwrap();
        for (word, target, _) in Target::ALL {
            let c = to(&i, target);
            let back = again(&c);
            let at = format!("{file} -> {word}");
            assert_eq!(c.lost.coupling_rows, 0, "{at}: {:?}", c.lost);
            let (w, sigma) = wanted;
            assert_eq!(
                figures(&back.mechanism),
                Some((w, sigma + c.repeated)),
                "{at}\n{}",
                c.text
            );
            let names = joints(&back);
            // The loops of an SDF file are joints, of which others are of the tree then.
            if !file.ends_with(".sdf") {
                for name in joints(&i) {
                    assert!(names.contains(&name), "{at}: {name} is not among {names:?}");
                }
            }
            // And over to MJCF, as one that never was another.
            let mjcf = to(&back, Target::Mjcf);
            assert_eq!(
                figures(&again(&mjcf).mechanism),
                Some((w, sigma + c.repeated)),
                "{at} -> mjcf"
            );
        }
    }
}

// By way of every format, masses, moments of inertia and limits are those that a file written at once has.
#[test]
fn weights_and_limits_come_back_in_every_direction() {
    for (file, side) in models() {
        let i = read(file, side);
        let weights = |text: &str| -> Vec<(String, f64, f64)> {
            let bodies = text.split("<body ").skip(1);
            let each = bodies.filter_map(|b| {
                let name = b.split('"').nth(1).unwrap().to_owned();
                let own = b.split("<body ").next().unwrap();
                let inertial = tags(own, "inertial").into_iter().next()?;
                let tensor = inertial
                    .get("diaginertia")
                    .or(inertial.get("fullinertia"))
                    .unwrap();
                let trace = numbers(tensor)[..3].iter().sum();
                Some((name, inertial["mass"].parse().unwrap(), trace))
            });
            let mut each: Vec<_> = each.filter(|(n, ..)| !n.contains('~')).collect();
            each.sort_by(|a, b| a.0.cmp(&b.0));
            each
        };
        let ranges = |text: &str| -> BTreeMap<String, Vec<f64>> {
            let all = tags(text, "joint").into_iter();
            let with = all.filter_map(|j| Some((j.get("name")?.clone(), numbers(j.get("range")?))));
            with.collect()
        };
        let direct = to(&i, Target::Mjcf).text;
        let (weighed, limited) = (weights(&direct), ranges(&direct));
        assert!(weighed.len() > 2, "{direct}");
        for (word, target, _) in Target::ALL {
            let by = to(&again(&to(&i, target)), Target::Mjcf).text;
            let at = format!("{file} -> {word} -> mjcf");
            let found = weights(&by);
            for (name, mass, trace) in &weighed {
                let Some((_, m, t)) = found.iter().find(|(n, ..)| n == name) else {
                    panic!("{at}: {name} is not there\n{by}")
                };
                assert!(
                    (m - mass).abs() <= 1e-9 * mass,
                    "{at}: {name} weighs {m}, not {mass}"
                );
                assert!(
                    (t - trace).abs() <= 1e-9 * trace + 1e-15,
                    "{at}: {name}: {t}, not {trace}"
                );
            }
            let found = ranges(&by);
            for (name, wanted) in &limited {
                // SDF counts from the drawn pose.
                let moved = tags(&direct, "key").len() == 1 && word == "sdf";
                let width = |r: &[f64]| r[1] - r[0];
                let range = found
                    .get(name)
                    .unwrap_or_else(|| panic!("{at}: {name} has no range"));
                assert!((width(range) - width(wanted)).abs() < 1e-9, "{at}: {name}");
                assert!(
                    moved || (range[0] - wanted[0]).abs() < 1e-9,
                    "{at}: {name}: {range:?}, not {wanted:?}"
                );
            }
        }
    }
}
