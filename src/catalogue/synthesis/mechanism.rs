//! A layout as a mechanism file: hinges square to the plane, the driver's joint, the outputs, and a workload.

use crate::chains::layout_symmetry::{Input, Symmetry};
use crate::file::schema::{
    Coordinate, DriveWord, JointEntry, LinkEntry, MechanismFile, OptionEntry, PointEntry,
    SearchEntry, ToleranceEntry, Unloading, WorkloadEntry,
};
use crate::geom::vector::{Vector, X};
use crate::synthesis::layout::Layout;
use crate::synthesis::place::{Pivot, Place, Point, number, point};
use crate::synthesis::structure::Structure;
use crate::synthesis::task;
use crate::synthesis::workload::{HeldPart, Workload};
use itertools::Itertools;

/// What each link is called: frame, slider or crank, the jaws, and the rest by their numbers.
#[must_use]
pub(crate) fn link_names(structure: &Structure) -> Vec<String> {
    let r = &structure.roles;
    let name = |l: usize| match l {
        l if l == r.frame => "frame".to_owned(),
        l if l == r.driver => match structure.form.input {
            Input::Slide => "slider".to_owned(),
            Input::Turn => "crank".to_owned(),
        },
        l => match r.jaws.iter().position(|&j| j == l) {
            Some(n) => task::JAW_NAMES[n].to_owned(),
            None => format!("link-{l}"),
        },
    };
    (0..structure.chain.links()).map(name).collect()
}

/// A direction of whole numbers after so many thirds of a turn.
pub(super) fn direction_turned(
    direction: &[Coordinate; 3],
    pivot: Pivot,
    thirds: u8,
) -> [Coordinate; 3] {
    let [
        Coordinate::Integer(x),
        Coordinate::Integer(y),
        Coordinate::Integer(z),
    ] = direction
    else {
        return direction.clone();
    };
    #[allow(clippy::cast_precision_loss, reason = "sides of small triangles")]
    pivot.turned([x, y, z].map(|a| *a as f64), thirds)
}

/// Options after so many thirds of a turn: their directions go with it.
pub(super) fn options_turned(
    options: &[OptionEntry],
    pivot: Pivot,
    thirds: u8,
) -> Vec<OptionEntry> {
    let mut out = options.to_vec();
    for option in &mut out {
        if let OptionEntry::Table(t) = option {
            let turned = |d| direction_turned(d, pivot, thirds);
            t.reference = t.reference.as_ref().map(turned);
        }
    }
    out
}

/// What a search may do to the hinges.
#[derive(Debug, Clone, Default)]
pub struct Menu {
    /// What each may be, the hinge itself first.
    pub options: Vec<OptionEntry>,
    /// What may be put in series with each, by a link more; with the input joint nothing is.
    pub unloading: Vec<OptionEntry>,
}

/// Pins that a turn carries to each other, each the next.
fn rounds(layout: &Layout) -> impl Iterator<Item = Vec<usize>> {
    let firsts = layout.images.iter().map(|&(first, _)| first).unique();
    firsts.map(|first| {
        let images = layout.images.iter().filter(move |(f, _)| *f == first);
        let thirds = |i: &usize| layout.at[*i].thirds;
        let images = images.map(|&(_, i)| i).sorted_by_key(thirds);
        std::iter::once(first).chain(images).collect()
    })
}

/// What a pin's joint is called.
pub(super) fn joint_name(names: &[String], pin: (usize, usize)) -> String {
    format!("{}.{}", names[pin.0], names[pin.1])
}

/// The joints of a structure whose pins are at some places.
fn joints(
    structure: &Structure,
    pins: &[(usize, usize)],
    at: &[Place],
    menu: &Menu,
) -> Vec<JointEntry> {
    let (names, r) = (link_names(structure), &structure.roles);
    let joint = |(&(u, v), &place): (&(usize, usize), &Place)| {
        let input = [(u, v), (v, u)].contains(&(r.frame, r.driver));
        let slides = input && structure.form.input == Input::Slide;
        let id = joint_name(&names, (u, v));
        // The frame first, so that the drive's coordinate is the driver's motion.
        let (u, v) = if input { (r.frame, r.driver) } else { (u, v) };
        let axis = if slides { [1, 0, 0] } else { [0, 0, 1] };
        // What a third of a turn carries to each other has options that it carries to each other.
        let thirds = place.thirds;
        let own = |options: &[OptionEntry]| options_turned(options, Pivot::Normal, thirds);
        let in_series = !input && !menu.unloading.is_empty();
        JointEntry {
            id,
            links: [names[u].clone(), names[v].clone()],
            kind: if slides { "prismatic" } else { "revolute" }.to_owned(),
            freedoms: None,
            point: point(place),
            axis: Some(axis.map(Coordinate::Integer)),
            reference: (thirds > 0).then(|| Pivot::Normal.turned(X, thirds)),
            lead: None,
            pitch: None,
            tolerance: None,
            drive: DriveWord::Driven(input),
            state: None,
            options: (thirds > 0).then(|| own(&menu.options)),
            forbid: Vec::new(),
            unloading: in_series.then(|| match thirds {
                0 => Unloading::Allowed(true),
                _ => Unloading::List(own(&menu.unloading)),
            }),
        }
    };
    pins.iter().zip(at).map(joint).collect()
}

/// A structure with its pins at some places, for questions about its joints alone: nothing acts on it.
#[must_use]
pub(crate) fn bare_file(structure: &Structure, at: &[Place], menu: &Menu) -> MechanismFile {
    let link = |(l, id): (usize, String)| LinkEntry {
        id,
        role: (l == structure.roles.frame).then(|| "frame".to_owned()),
        mass: None,
        centre: None,
        inertia: None,
    };
    let names = link_names(structure).into_iter().enumerate();
    MechanismFile {
        name: structure.id(),
        length_unit: Some("mm".to_owned()),
        link: names.map(link).collect(),
        joint: joints(structure, &structure.chain.joints(), at, menu),
        search: SearchEntry {
            options: menu.options.clone(),
            unloading: menu.unloading.clone(),
            ..SearchEntry::default()
        },
        ..MechanismFile::default()
    }
}

/// Says that places are exact where they have decimals, which would be taken for rounded.
fn exact(at: &[Place]) -> Option<ToleranceEntry> {
    let fine = at.iter().any(|p| p.fine != [0; 2]);
    fine.then_some(ToleranceEntry {
        length: Some(Coordinate::Integer(0)),
        direction: None,
    })
}

/// Points of the plane in space.
pub(super) fn in_space(points: &[Point]) -> Vec<Vector> {
    points.iter().map(|&[x, y]| [x, y, 0.0]).collect()
}

/// What a file says beside its joints, whatever their kinds.
pub(super) struct FileHead<'a> {
    pub(super) id: String,
    pub(super) name: String,
    /// What each link is called, and its points.
    pub(super) links: Vec<(String, Vec<Vector>)>,
    pub(super) frame: usize,
    pub(super) jaws: &'a [usize],
    pub(super) held: HeldPart<'a>,
}

impl FileHead<'_> {
    /// A file without joints.
    pub(super) fn file(&self, workload: &Workload) -> MechanismFile {
        let links = self.links.iter().enumerate().map(|(l, (name, points))| {
            let mass = (workload.weighs_links() && l != self.frame).then(|| workload.mass(points));
            LinkEntry {
                id: name.clone(),
                role: match l {
                    l if l == self.frame => Some("frame".to_owned()),
                    l if self.jaws.contains(&l) => Some("output".to_owned()),
                    _ => None,
                },
                mass: mass.map(|(kg, _)| kg),
                centre: mass.map(|(_, centre)| centre.map(number)),
                inertia: None,
            }
        });
        // The tips, so that drawings have whole jaws.
        let tips = self.held.tips.iter().zip(self.jaws).zip(["a", "b", "c"]);
        let tips = tips.map(|((&tip, &jaw), letter)| PointEntry {
            id: format!("tip-{letter}"),
            link: self.links[jaw].0.clone(),
            point: self.held.pivot.point(tip),
            tolerance: None,
        });
        let jaws = self.jaws.iter().map(|&j| self.links[j].0.clone());
        let jaws: Vec<String> = jaws.collect();
        MechanismFile {
            name: self.id.clone(),
            description: format!(
                "Gripper of {} links from the catalogue of structures: {}. The forces at the tips are those of the part held.",
                self.links.len(),
                self.name
            ),
            length_unit: Some("mm".to_owned()),
            link: links.collect(),
            point: tips.collect(),
            workload: WorkloadEntry {
                gravity: workload
                    .weighs_links()
                    .then(|| workload.gravity.map(number)),
                force: workload.forces(&jaws, &self.held),
                ..WorkloadEntry::default()
            },
            ..MechanismFile::default()
        }
    }
}

/// The entries of the file.
#[must_use]
pub fn mechanism_file(
    structure: &Structure,
    layout: &Layout,
    menu: &Menu,
    workload: &Workload,
) -> MechanismFile {
    let names = link_names(structure);
    let r = &structure.roles;
    let named = |i: usize| joint_name(&names, layout.pins[i]);
    let points =
        |(l, name): (usize, &String)| (name.clone(), in_space(&layout.points(structure, l)));
    let told = FileHead {
        id: structure.id(),
        name: structure.name(),
        links: names.iter().enumerate().map(points).collect(),
        frame: r.frame,
        jaws: &r.jaws,
        held: HeldPart {
            tips: &layout.tips,
            outward: &task::outward(r.jaws.len(), 1),
            grip: layout.limits.task.grip.sign(),
            pivot: Pivot::Normal,
        },
    };
    MechanismFile {
        tolerance: exact(&layout.at),
        joint: joints(structure, &layout.pins, &layout.at, menu),
        search: SearchEntry {
            options: menu.options.clone(),
            unloading: menu.unloading.clone(),
            mirror: match structure.form.symmetry {
                Symmetry::Mirror => layout
                    .images
                    .iter()
                    .map(|&(a, b)| [named(a), named(b)])
                    .collect(),
                Symmetry::Generic | Symmetry::HalfTurn | Symmetry::Threefold => Vec::new(),
            },
            turn: match structure.form.symmetry {
                Symmetry::Generic | Symmetry::Mirror => Vec::new(),
                Symmetry::HalfTurn | Symmetry::Threefold => rounds(layout)
                    .map(|round| round.into_iter().map(named).collect())
                    .collect(),
            },
            ..SearchEntry::default()
        },
        ..told.file(workload)
    }
}
