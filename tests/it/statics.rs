//! Statics of planar mechanisms: structure, motion, reactions.

use crate::common::*;
mod command;
mod cycle;
mod enumeration;
mod ill_posed;
mod loads;
mod misfit;
mod published;
mod reactions;
mod stability;
mod structure;

use ozols::statics::planar::PairId;

/// One joint of a test mechanism: "a-b" with R, or P and its direction, at a point.
#[derive(Debug, Clone)]
pub(crate) struct J {
    pub(crate) links: (String, String),
    pub(crate) slide: Option<[f64; 2]>,
    pub(crate) at: [f64; 2],
}

pub(crate) fn turning_joint(a: &str, b: &str, x: f64, y: f64) -> J {
    J {
        links: (a.into(), b.into()),
        slide: None,
        at: [x, y],
    }
}

pub(crate) fn sliding_joint(a: &str, b: &str, x: f64, y: f64, along: [f64; 2]) -> J {
    J {
        links: (a.into(), b.into()),
        slide: Some(along),
        at: [x, y],
    }
}

/// A file in planar mode; link 0 is the frame, the first joint is the drive; `more` goes to the end.
pub(crate) fn planar_file(joints: &[J], more: &str) -> String {
    planar_file_with(joints, &|_| None, more)
}

/// Mass, centre and inertia.
pub(crate) type Mass = (f64, [f64; 2], f64);

/// The same with masses by link.
pub(crate) fn planar_file_with(
    joints: &[J],
    mass: &dyn Fn(&str) -> Option<Mass>,
    more: &str,
) -> String {
    let links: BTreeSet<&str> = joints
        .iter()
        .flat_map(|j| [&*j.links.0, &j.links.1])
        .collect();
    let line = |(i, j): (usize, &J)| {
        let ((a, b), [x, y]) = (&j.links, j.at);
        let along = j.slide.map(|[x, y]| format!("prismatic | {x:?}, {y:?}, 0"));
        let kind = along.unwrap_or("revolute | 0, 0, 1".to_owned());
        let (kind, axis) = kind.split_once(" | ").unwrap();
        format!(
            "{a}-{b} | {a} {b} | {kind} | {x:?}, {y:?}, 0 | {axis} | drive = {}",
            i == 0
        )
    };
    let joints = joints.iter().enumerate().map(line).join("\n");
    let head = "name = \"t\"\nmode = \"planar\"";
    let mut text = write_mechanism(head, &(links.iter().join(" ") + "*"), &joints);
    for l in links {
        if let Some((m, [x, y], i)) = mass(l) {
            let link = format!("[[link]]\nid = \"{l}\"\n");
            let heavy = format!("mass = {m:?}\ncentre = [{x:?}, {y:?}, 0]\ninertia = {i:?}\n");
            text = replace_once(&text, &link, &(link.clone() + &heavy));
        }
    }
    text + more
}

pub(crate) fn planar_mechanism(joints: &[J]) -> PlanarMechanism {
    PlanarMechanism::new(&read(&planar_file(joints, "")), StateId::FREE).unwrap()
}

pub(crate) fn pair_named(m: &PlanarMechanism, name: &str) -> PairId {
    m.pairs.iter().position(|p| p.name == name).unwrap()
}

pub(crate) fn shears_text() -> &'static str {
    ozols::builtin::text("parallel-shears").unwrap()
}

/// Joints by their links and points, and by directions where they slide: `0-1 0 0, 1-2 3 1, 2-0 4 0 1 0`.
pub(crate) fn joints_of(text: &str) -> Vec<J> {
    let one = |piece: &str| {
        let (ends, numbers) = piece.trim().split_once(' ').unwrap();
        let (a, b) = ends.split_once('-').unwrap();
        let n = split_words(numbers).into_iter().map(|x| x.parse().unwrap());
        let n: Vec<f64> = n.collect();
        let slide = (n.len() == 4).then(|| [n[2], n[3]]);
        let links = (a.into(), b.into());
        J {
            links,
            slide,
            at: [n[0], n[1]],
        }
    };
    text.split(',').map(one).collect()
}

pub(crate) fn four_bar_file() -> String {
    planar_file(&joints_of("0-1 0 0, 1-2 0 1, 2-3 3 3, 3-0 4 0"), "")
}
