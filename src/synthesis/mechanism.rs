//! A layout as a mechanism file: hinges square to the plane, the driver's joint, the outputs, and a workload.

use crate::chains::layout_symmetry::{Input, Symmetry};
use crate::file::schema::{
    Coordinate, ForceEntry, JointEntry, LinkEntry, MechanismFile, OptionEntry, SearchEntry,
    WorkloadEntry,
};
use crate::synthesis::layout::Layout;
use crate::synthesis::structure::Structure;

/// The force with which the jaws hold the part, in N.
pub const CLOSING_FORCE: i64 = 100;
/// The weight of the part on each jaw, square to the plane, in N: the hardest attitude. The part has about 1 kg.
const WEIGHT: i64 = 5;

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
        l if l == r.jaws[0] => "jaw-a".to_owned(),
        l if l == r.jaws[1] => "jaw-b".to_owned(),
        l => format!("link-{l}"),
    };
    (0..structure.chain.links()).map(name).collect()
}

fn whole([x, y]: [i32; 2]) -> [Coordinate; 3] {
    [i64::from(x), i64::from(y), 0].map(Coordinate::Integer)
}

/// The entries of the file: what `options` may be put in place of each hinge.
#[must_use]
pub fn mechanism_file(
    structure: &Structure,
    layout: &Layout,
    options: &[OptionEntry],
) -> MechanismFile {
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
            point: whole(layout.at[i]),
            axis: Some(axis.map(Coordinate::Integer)),
            reference: None,
            lead: None,
            pitch: None,
            drive: input,
            state: None,
            options: None,
            forbid: Vec::new(),
            unloading: None,
        }
    });
    let force = |n: usize, sign: i64| ForceEntry {
        link: names[r.jaws[n]].clone(),
        point: whole(layout.tips[n]),
        force: [0, sign * CLOSING_FORCE, -WEIGHT].map(Coordinate::Integer),
        from: None,
        to: None,
        state: None,
    };
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
            options: options.to_vec(),
            mirror: match structure.form.symmetry {
                Symmetry::Mirror => layout
                    .images
                    .iter()
                    .map(|&(a, b)| [joint_name(a), joint_name(b)])
                    .collect(),
                // Half a turn is no mirror image.
                Symmetry::Generic | Symmetry::HalfTurn => Vec::new(),
            },
            ..SearchEntry::default()
        },
        workload: WorkloadEntry {
            force: vec![force(0, 1), force(1, -1)],
            ..WorkloadEntry::default()
        },
        ..MechanismFile::default()
    }
}
