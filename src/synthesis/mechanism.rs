//! A layout as a mechanism file: hinges square to the plane, the driver's joint, the outputs, and a workload.

use crate::chains::layout_symmetry::{Input, Symmetry};
use crate::file::schema::{
    Coordinate, ForceEntry, JointEntry, LinkEntry, MechanismFile, OptionEntry, SearchEntry,
    Unloading, WorkloadEntry,
};
use crate::synthesis::layout::Layout;
use crate::synthesis::place::Place;
use crate::synthesis::structure::Structure;

/// The force with which the jaws hold the part, in N.
pub const CLOSING_FORCE: i32 = 100;
/// The weight of the part, shared by the jaws, square to the plane, in N: the hardest attitude. The part has about 1 kg.
const WEIGHT: i64 = 10;

/// What each link is called: frame, slider or crank, the jaws, and the rest by their numbers.
#[must_use]
pub fn link_names(structure: &Structure) -> Vec<String> {
    let r = &structure.roles;
    let name = |l: usize| match l {
        l if l == r.frame => "frame".to_owned(),
        l if l == r.driver => match structure.form.input {
            Input::Slide => "slider".to_owned(),
            Input::Turn => "crank".to_owned(),
        },
        l => match r.jaws.iter().position(|&j| j == l) {
            Some(n) => ["jaw-a", "jaw-b", "jaw-c"][n].to_owned(),
            None => format!("link-{l}"),
        },
    };
    (0..structure.chain.links()).map(name).collect()
}

/// The coordinates of a place, exactly.
fn coordinates(
    Place {
        whole: [x, y],
        thirds,
    }: Place,
) -> [Coordinate; 2] {
    // (a + b √3) / 2, where not both are zero.
    let surd = |a: i32, b: i32| match (a, b) {
        (_, 0) if a % 2 == 0 => Coordinate::Integer(i64::from(a / 2)),
        (_, 0) => Coordinate::Expression(format!("{a}/2")),
        (0, _) => Coordinate::Expression(format!("{b}*sqrt(3)/2")),
        _ => Coordinate::Expression(format!(
            "({a} {} {}*sqrt(3))/2",
            if b < 0 { '-' } else { '+' },
            b.abs()
        )),
    };
    match thirds {
        0 => [x, y].map(|x| Coordinate::Integer(i64::from(x))),
        1 => [surd(-x, -y), surd(-y, x)],
        _ => [surd(-x, y), surd(-y, -x)],
    }
}

fn point(place: Place) -> [Coordinate; 3] {
    let [x, y] = coordinates(place);
    [x, y, Coordinate::Integer(0)]
}

/// What a search may do to the hinges.
#[derive(Debug, Clone, Default)]
pub struct Menu {
    /// What each may be, the hinge itself first.
    pub options: Vec<OptionEntry>,
    /// What may be put in series with each, by a link more; with the input joint nothing is.
    pub unloading: Vec<OptionEntry>,
}

/// The entries of the file.
#[must_use]
pub fn mechanism_file(structure: &Structure, layout: &Layout, menu: &Menu) -> MechanismFile {
    let names = link_names(structure);
    let r = &structure.roles;
    let links = names.iter().enumerate().map(|(l, name)| LinkEntry {
        id: name.clone(),
        role: match l {
            l if l == r.frame => Some("frame".to_owned()),
            l if r.jaws.contains(&l) => Some("output".to_owned()),
            _ => None,
        },
        mass: None,
        centre: None,
        inertia: None,
    });
    let joint_name = |i: usize| {
        let (u, v) = layout.pins[i];
        format!("{}.{}", names[u], names[v])
    };
    let joints = (0..layout.pins.len()).map(|i| {
        let (u, v) = layout.pins[i];
        let input = [(u, v), (v, u)].contains(&(r.frame, r.driver));
        let slides = input && structure.form.input == Input::Slide;
        // The frame first, so that the drive's coordinate is the driver's motion.
        let (u, v) = if input { (r.frame, r.driver) } else { (u, v) };
        let axis = if slides { [1, 0, 0] } else { [0, 0, 1] };
        JointEntry {
            id: joint_name(i),
            links: [names[u].clone(), names[v].clone()],
            kind: if slides { "prismatic" } else { "revolute" }.to_owned(),
            freedoms: None,
            point: point(layout.at[i]),
            axis: Some(axis.map(Coordinate::Integer)),
            reference: None,
            lead: None,
            pitch: None,
            drive: input,
            state: None,
            options: None,
            forbid: Vec::new(),
            unloading: (!input && !menu.unloading.is_empty()).then_some(Unloading::Allowed(true)),
        }
    });
    let weight = match r.jaws.len() {
        2 => Coordinate::Integer(-WEIGHT / 2),
        n => Coordinate::Expression(format!("-{WEIGHT}/{n}")),
    };
    let forces = structure.outward(CLOSING_FORCE).into_iter().enumerate();
    let forces = forces.map(|(n, force)| {
        let [x, y] = coordinates(force);
        ForceEntry {
            link: names[r.jaws[n]].clone(),
            point: point(layout.tips[n]),
            force: [x, y, weight.clone()],
            from: None,
            to: None,
            state: None,
        }
    });
    MechanismFile {
        name: structure.id(),
        description: format!(
            "Gripper of {} links from the catalogue of structures: {}. The forces at the tips are those of the part held, with its weight across.",
            structure.chain.links(),
            structure.name()
        ),
        length_unit: Some("mm".to_owned()),
        link: links.collect(),
        joint: joints.collect(),
        search: SearchEntry {
            options: menu.options.clone(),
            unloading: menu.unloading.clone(),
            mirror: match structure.form.symmetry {
                Symmetry::Mirror => layout
                    .images
                    .iter()
                    .map(|&(a, b)| [joint_name(a), joint_name(b)])
                    .collect(),
                // Turns are no mirror images.
                Symmetry::Generic | Symmetry::HalfTurn | Symmetry::Threefold => Vec::new(),
            },
            ..SearchEntry::default()
        },
        workload: WorkloadEntry {
            force: forces.collect(),
            ..WorkloadEntry::default()
        },
        ..MechanismFile::default()
    }
}
