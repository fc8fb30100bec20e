//! A layout as a mechanism file: hinges normal to the plane, guides and slots in it, gears as couplings, the driver's joint, the outputs,
//! and a workload. If there are three sides, links and joints of one side are repeated on the others after thirds of a turn.

use crate::chains::{PairKind, Symmetry};
use crate::file::schema::{
    Coordinate, CouplingEntry, DriveWord, JointEntry, LinkEntry, MechanismFile, OptionEntry,
    PointEntry, SearchEntry, ToleranceEntry, Unloading, WorkloadEntry,
};
use crate::geom::vector::Vector;
use crate::synthesis::layout::Layout;
use crate::synthesis::options::{
    Menu, direction_turned, face_options, is_ball, nut_options, options_turned, slide_options,
    slot_options,
};
use crate::synthesis::place::{Pivot, Place, number_words, point};
use crate::synthesis::places::{Places, Teeth};
use crate::synthesis::rules::Rules;
use crate::synthesis::structure::Structure;
use crate::synthesis::structure::threefold::SIDES;
use crate::synthesis::task::{self, outward_vectors};
use crate::synthesis::workload::{HeldPart, Workload};
use itertools::Itertools;

/// Returns the names of the links: frame, the jaws, slider or crank, cylinder and piston if they are between moving links, and the
/// others by their numbers.
#[must_use]
fn link_names(structure: &Structure) -> Vec<String> {
    let roles = &structure.structure.roles;
    let [base, driver] = roles.drive_links();
    let slides = structure.structure.input_slides();
    let jaw = |l: usize| roles.jaws.iter().position(|&j| j == l);
    let name = |l: usize| match l {
        l if l == roles.frame => "frame".to_owned(),
        l if l == driver && base == roles.frame && slides => "slider".to_owned(),
        l if l == driver && structure.form.threaded => "screw".to_owned(),
        l if l == driver && base == roles.frame => "crank".to_owned(),
        l if l == driver && slides => "piston".to_owned(),
        l if l == base && slides => "cylinder".to_owned(),
        l => format!("link-{l}"),
    };
    let of = |l: usize| jaw(l).map_or_else(|| name(l), |n| task::JAW_NAMES[n].to_owned());
    (0..structure.structure.chain.links()).map(of).collect()
}

/// Returns an entry which says that places are exact, if they have decimals: decimals are treated as rounded otherwise.
fn exactness_entry(at: &[Place]) -> Option<ToleranceEntry> {
    let fine = at.iter().any(|p| p.fine != [0; 2]);
    fine.then_some(ToleranceEntry {
        length: Some(Coordinate::Integer(0)),
        direction: None,
    })
}

/// Joints at their places, with the names of all links.
struct DrawnJoints<'a> {
    structure: &'a Structure,
    rules: &'a Rules,
    at: &'a Places,
    names: Vec<String>,
    pivot: Pivot,
}

impl<'a> DrawnJoints<'a> {
    fn new(structure: &'a Structure, rules: &'a Rules, at: &'a Places) -> DrawnJoints<'a> {
        let first = link_names(structure);
        let jaw = structure.structure.roles.jaws[0];
        let names = match &structure.sides {
            None => first,
            Some(sides) => {
                let of = |side: usize, l: usize| match ["a", "b", "c"][side] {
                    letter if l == jaw => format!("jaw-{letter}"),
                    letter => format!("{}-{letter}", first[l]),
                };
                let own = sides.own.iter().map(|&l| first[l].clone());
                let all = (0..SIDES).cartesian_product(&sides.side);
                own.chain(all.map(|(side, &l)| of(side, l))).collect()
            }
        };
        DrawnJoints {
            pivot: structure.turn_axis(),
            structure,
            rules,
            at,
            names,
        }
    }

    /// Returns whether a joint has teeth that are a coupling. A thread is a joint of the file.
    fn is_geared(&self, joint: usize) -> bool {
        self.rules.joints[joint].pair == PairKind::Gear && !self.rules.threaded
    }

    /// Returns every joint on every side that has it.
    fn each_side(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let joints = self.rules.joints.iter().enumerate();
        joints.flat_map(|(i, j)| (0..self.structure.copy_count(j)).map(move |side| (i, side)))
    }

    /// Returns the joints of the file, each with its side.
    fn made_joints(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.each_side().filter(|(i, _)| !self.is_geared(*i))
    }

    fn place(&self, joint: usize, side: usize) -> Place {
        let place = self.rules.exact_place(&self.at.points, joint);
        #[allow(clippy::cast_possible_truncation, reason = "at most three")]
        let thirds = place.thirds + side as u8;
        Place { thirds, ..place }
    }

    fn link_name(&self, link: usize, side: usize) -> &str {
        let link = self.structure.side_link(link, side);
        link.map_or("", |l| &self.names[l])
    }

    /// Returns the name of a joint.
    fn name(&self, joint: usize, side: usize) -> String {
        let links = self.rules.joints[joint].links;
        let second = self.rules.joints[..joint].iter().any(|j| j.links == links);
        let name = links.iter().map(|&l| self.link_name(l, side)).join(".");
        if second { name + "-2" } else { name }
    }

    fn joint(&self, i: usize, side: usize, menu: &Menu) -> JointEntry {
        let joint = &self.rules.joints[i];
        let form = &self.structure.form;
        let input = joint.links == self.structure.structure.roles.input;
        let flat = self.structure.flat_slots().contains(joint);
        let upright = [0, 0, 1].map(Coordinate::Integer);
        let along = point(self.at.along[i].place_along());
        let (kind, axis, reference, options) = match joint.pair {
            PairKind::Slide if form.hinges => ("prismatic", along, None, None),
            PairKind::Slide => (
                "prismatic",
                along,
                Some(upright.clone()),
                Some(slide_options()),
            ),
            PairKind::Slot if flat => {
                let upright = Some(upright.clone());
                ("prismatic", along, upright, Some(face_options()))
            }
            PairKind::Slot => (
                "slotted",
                upright.clone(),
                Some(along),
                Some(slot_options()),
            ),
            // Teeth are a coupling, and two slots are two joints.
            PairKind::Hinge | PairKind::Gear | PairKind::TwoSlots => {
                ("revolute", upright.clone(), None, None)
            }
        };
        let thread = self.thread_lead(i);
        let across = [0, 1, 0].map(Coordinate::Integer);
        let (kind, axis, reference, options) = match thread {
            None => (kind, axis, reference, options),
            Some(None) => ("revolute", across, Some(upright), None),
            Some(Some(lead)) => ("helical", across, Some(upright), Some(nut_options(lead))),
        };
        let mut at = self.place(i, side);
        if let Some(mesh) = self.rules.meshes[i].filter(|_| thread.is_some()) {
            // The point is on the guide, so that the axis of the screw goes through it.
            at.whole[1] = self.place(mesh.held[1], side).whole[1];
        }
        let thirds = at.thirds;
        let turn = |d: &[Coordinate; 3]| direction_turned(d, self.pivot, thirds);
        // Joints that are images by a third of a turn have options that are images, too.
        let hinge = kind == "revolute";
        let ahead = (hinge && thirds > 0).then(|| [1, 0, 0].map(Coordinate::Integer));
        let in_series = joint.pair == PairKind::Hinge && !input && !menu.unloading.is_empty();
        JointEntry {
            id: self.name(i, side),
            links: self
                .joint_links(i)
                .map(|l| self.link_name(l, side).to_owned()),
            kind: kind.to_owned(),
            freedoms: None,
            point: self.pivot.point(at),
            axis: Some(turn(&axis)),
            reference: reference.or(ahead).as_ref().map(turn),
            lead: thread.flatten().map(Coordinate::Integer),
            pitch: None,
            tolerance: None,
            drive: DriveWord::Driven(input),
            state: None,
            options: (options.filter(|_| !input))
                .or_else(|| (hinge && thirds > 0).then(|| self.options_at(i, thirds, menu))),
            forbid: Vec::new(),
            unloading: in_series.then(|| match thirds {
                0 => Unloading::Allowed(true),
                _ => Unloading::List(options_turned(&menu.unloading, self.pivot, thirds)),
            }),
        }
    }

    /// Returns the options of a hinge after thirds of a turn. A hinge that holds a gear cannot be a ball.
    fn options_at(&self, joint: usize, thirds: u8, menu: &Menu) -> Vec<OptionEntry> {
        let mut meshes = self.rules.meshes.iter().flatten();
        let held = meshes.any(|m| m.held.contains(&joint));
        let options = menu.options.iter().filter(|o| !held || !is_ball(o));
        options_turned(&options.cloned().collect_vec(), self.pivot, thirds)
    }

    /// Returns the lead along y for a joint of a screw and a nut, and `Some(None)` for the hinge of the screw; `None` for other joints.
    fn thread_lead(&self, i: usize) -> Option<Option<i64>> {
        if !self.structure.form.threaded {
            return None;
        }
        let mesh = self.rules.meshes[i];
        let lead = mesh.zip(match self.at.teeth[i] {
            Teeth::Thread(lead) => Some(i64::from(lead)),
            _ => None,
        });
        let lead = lead.map(|(mesh, lead)| {
            // If the nut does not turn, it goes back as the screw turns on.
            let [_, y] = self.at.along[mesh.held[1]].place_along().whole;
            -lead * i64::from(y.signum())
        });
        let own = self.rules.joints[i].links == self.structure.structure.roles.input;
        lead.map(Some).or(own.then_some(None))
    }

    /// Returns the links of a joint in the order of the file. The second link of the drive is the driver. The first link of a slot has
    /// the pin. The second link of a slide has the block.
    fn joint_links(&self, i: usize) -> [usize; 2] {
        let joint = &self.rules.joints[i];
        let [u, v] = joint.links;
        let second_first = match joint.pair {
            _ if joint.links == self.structure.structure.roles.input => {
                self.structure.structure.roles.drive_links() == [v, u]
            }
            PairKind::Slot => self.at.pinned[i] == v,
            PairKind::Slide => self.rules.blocks[i] == u,
            _ => false,
        };
        if second_first { [v, u] } else { [u, v] }
    }

    fn coupling(&self, i: usize, side: usize) -> Option<CouplingEntry> {
        let mesh = self.rules.meshes[i].filter(|_| self.is_geared(i))?;
        let first = mesh.held.map(|j| self.joint_links(j)[0]);
        let turned = first.iter().filter(|&&l| l != mesh.carrier).count() == 1;
        let signed = |x: i32| i64::from(if turned { -x } else { x });
        let ratio = match self.at.teeth[i] {
            Teeth::Gears([r, s]) if r == s => Coordinate::Integer(signed(-1)),
            Teeth::Gears([r, s]) => Coordinate::Expression(format!("{}/{s}", signed(-r))),
            Teeth::Rack(diameter) if diameter % 2 == 0 => Coordinate::Integer(signed(diameter / 2)),
            Teeth::Rack(diameter) => Coordinate::Expression(format!("{}/2", signed(diameter))),
            Teeth::Thread(lead) => Coordinate::Expression(format!("{}/(2*pi)", signed(lead))),
        };
        Some(CouplingEntry {
            joints: mesh.held.map(|j| self.name(j, side)),
            ratio,
            gear: true,
        })
    }

    /// Returns the points of a link in space: its joints, and its tip if it is a jaw.
    fn link_points(&self, link: usize, jaws: &[usize], tips: &[Place]) -> Vec<Vector> {
        let of = |&(i, side): &(usize, usize)| {
            let ends = self.rules.joints[i]
                .links
                .map(|l| self.structure.side_link(l, side));
            ends.contains(&Some(link))
        };
        let own = self
            .made_joints()
            .filter(of)
            .map(|(i, side)| self.place(i, side));
        let jaw = jaws.iter().position(|&j| j == link);
        let all = own.chain(jaw.map(|n| tips[n]));
        all.map(|p| self.pivot.real(p)).collect()
    }

    /// Returns the options of the hinges for a search, and the joints that it changes together.
    fn search_options(&self, menu: &Menu) -> SearchEntry {
        let joints = self.rules.joints.iter();
        let mut hinges = joints.filter(|j| j.pair == PairKind::Hinge);
        let input = self.structure.structure.roles.input;
        let mut out = SearchEntry::default();
        if hinges.any(|j| j.links != input) {
            out.options.clone_from(&menu.options);
            out.unloading.clone_from(&menu.unloading);
        }
        let made = |i: &usize| !self.is_geared(*i);
        if self.structure.sides.is_some() {
            let joints = (0..self.rules.joints.len()).filter(made);
            let rounds =
                joints.filter(|&i| self.structure.copy_count(&self.rules.joints[i]) == SIDES);
            let round = |i| (0..SIDES).map(|side| self.name(i, side)).collect();
            out.turn = rounds.map(round).collect();
        } else if !self.structure.form.one_sided {
            let images = self
                .rules
                .image_pairs()
                .filter(|(of, _)| made(of))
                .collect_vec();
            for first in images.iter().map(|(of, _)| *of).unique() {
                let times = |i: &usize| self.rules.exact_place(&self.at.points, *i).thirds;
                let own = images
                    .iter()
                    .filter(|(of, _)| *of == first)
                    .map(|(_, i)| *i);
                let round = std::iter::once(first).chain(own.sorted_by_key(times));
                let round = round.map(|i| self.name(i, 0)).collect_vec();
                match (self.structure.form.symmetry, &round[..]) {
                    (Symmetry::Mirror, [a, b]) => out.mirror.push([a.clone(), b.clone()]),
                    _ => out.turn.push(round),
                }
            }
        }
        out
    }
}

/// Returns the file of a structure that has only hinges, with its pins at some places and without a workload.
#[must_use]
pub(crate) fn bare_file(
    structure: &Structure,
    rules: &Rules,
    at: &Places,
    menu: &Menu,
) -> MechanismFile {
    let drawn = DrawnJoints::new(structure, rules, at);
    let link = |(l, id): (usize, &String)| LinkEntry {
        id: id.clone(),
        role: (l == structure.structure.roles.frame).then(|| "frame".to_owned()),
        mass: None,
        centre: None,
        inertia: None,
    };
    MechanismFile {
        name: structure.id(),
        length_unit: Some("mm".to_owned()),
        link: drawn.names.iter().enumerate().map(link).collect(),
        joint: drawn
            .made_joints()
            .map(|(i, side)| drawn.joint(i, side, menu))
            .collect(),
        search: drawn.search_options(menu),
        ..MechanismFile::default()
    }
}

/// Returns the file of a layout.
#[must_use]
pub fn mechanism_file(
    structure: &Structure,
    layout: &Layout,
    menu: &Menu,
    workload: &Workload,
) -> MechanismFile {
    let drawn = DrawnJoints::new(structure, &layout.rules, &layout.at);
    let roles = structure.whole_structure().roles;
    let task = &layout.limits.task;
    let (mut tips, mut away) = (
        structure.tip_places(task),
        outward_vectors(roles.jaws.len(), 1),
    );
    if structure.sides.is_some() {
        tips = [0, 1, 2].map(|thirds| Place { thirds, ..tips[0] }).into();
        away = outward_vectors(SIDES, 1);
    }
    let held = HeldPart {
        tips: &tips,
        outward: &away,
        grip: task.grip.grip_sign(),
        pivot: drawn.pivot,
    };
    let links = drawn.names.iter().enumerate().map(|(l, name)| {
        let points = || drawn.link_points(l, &roles.jaws, &tips);
        let mass =
            (workload.weighs_links() && l != roles.frame).then(|| workload.link_mass(&points()));
        LinkEntry {
            id: name.clone(),
            role: match l {
                l if l == roles.frame => Some("frame".to_owned()),
                l if roles.jaws.contains(&l) => Some("output".to_owned()),
                _ => None,
            },
            mass: mass.map(|(kg, _)| kg),
            centre: mass.map(|(_, centre)| centre.map(number_words)),
            inertia: None,
        }
    });
    // With the tips, drawings show whole jaws.
    let shown = tips.iter().zip(&roles.jaws).zip(["a", "b", "c"]);
    let shown = shown.map(|((&tip, &jaw), letter)| PointEntry {
        id: format!("tip-{letter}"),
        link: drawn.names[jaw].clone(),
        point: drawn.pivot.point(tip),
        tolerance: None,
    });
    let jaws = roles
        .jaws
        .iter()
        .map(|&j| drawn.names[j].clone())
        .collect_vec();
    MechanismFile {
        name: structure.id(),
        description: format!(
            "Gripper of {} links from the catalogue of structures: {}. The forces at the tips are those of the part held.",
            drawn.names.len(),
            structure.name()
        ),
        length_unit: Some("mm".to_owned()),
        tolerance: exactness_entry(&layout.places()),
        link: links.collect(),
        joint: drawn
            .made_joints()
            .map(|(i, side)| drawn.joint(i, side, menu))
            .collect(),
        coupling: drawn
            .each_side()
            .filter_map(|(i, side)| drawn.coupling(i, side))
            .collect(),
        point: shown.collect(),
        search: drawn.search_options(menu),
        workload: WorkloadEntry {
            gravity: workload
                .weighs_links()
                .then(|| workload.gravity.map(number_words)),
            force: workload.jaw_forces(&jaws, &held),
            ..WorkloadEntry::default()
        },
        ..MechanismFile::default()
    }
}
