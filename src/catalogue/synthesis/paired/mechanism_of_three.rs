//! A layout with three jaws as a mechanism file: what stands on one side stands on the others after thirds of a turn.

use crate::chains::pairs::PairKind;
use crate::file::schema::{
    Coordinate, CouplingEntry, JointEntry, MechanismFile, OptionEntry, SearchEntry, Unloading,
};
use crate::geom::vector::Vector;
use crate::synthesis::mechanism::{FileHead, Menu, direction_turned, options_turned};
use crate::synthesis::paired::layout::PairLayout;
use crate::synthesis::paired::mechanism::{joint_id, link_names, whole};
use crate::synthesis::paired::threefold::{SIDES, ThreefoldStructure};
use crate::synthesis::place::{Pivot, Place};
use crate::synthesis::workload::{HeldPart, Workload};

/// What the links of a gripper of three jaws are called: those of a side by the letter of its jaw.
fn names_of_three(structure: &ThreefoldStructure) -> Vec<String> {
    let two = link_names(&structure.two);
    let first = structure.two.structure.roles.jaws[0];
    let of = |side: usize, l: usize| {
        let letter = ["a", "b", "c"][side];
        match l {
            l if l == first => format!("jaw-{letter}"),
            l => format!("{}-{letter}", two[l]),
        }
    };
    let own = structure.own.iter().map(|&l| two[l].clone());
    let sides = (0..SIDES).flat_map(|side| structure.side.iter().map(move |&l| (side, l)));
    own.chain(sides.map(|(side, l)| of(side, l))).collect()
}

/// A joint on another side.
fn joint_on(side: u8, pivot: Pivot, joint: &JointEntry, at: Place, menu: &Menu) -> JointEntry {
    let turn = |d: &[Coordinate; 3]| direction_turned(d, pivot, side);
    let hinge = joint.kind == "revolute";
    let ahead = [1, 0, 0].map(Coordinate::Integer);
    let reference = joint.reference.as_ref().or(hinge.then_some(&ahead));
    // What a third of a turn carries to each other has options that it carries to each other.
    let options = (hinge && side > 0).then(|| options_turned(&menu.options, pivot, side));
    JointEntry {
        point: pivot.point(Place { thirds: side, ..at }),
        axis: joint.axis.as_ref().map(turn),
        reference: if side > 0 {
            reference.map(turn)
        } else {
            joint.reference.clone()
        },
        options: joint.options.clone().or(options),
        unloading: match &joint.unloading {
            Some(_) if side > 0 => Some(Unloading::List(options_turned(
                &menu.unloading,
                pivot,
                side,
            ))),
            other => other.clone(),
        },
        ..joint.clone()
    }
}

/// Whether an option turns about any axis.
fn is_ball(option: &OptionEntry) -> bool {
    let balls = ["spherical", "sphere-in-cylinder"];
    matches!(option, OptionEntry::Word(word) if balls.contains(&word.as_str()))
}

/// A layout with three sides, and what its links are called, those of two sides beside them.
struct ThreeSides<'a> {
    structure: &'a ThreefoldStructure,
    layout: &'a PairLayout,
    names: Vec<String>,
    of_two: Vec<String>,
    pivot: Pivot,
}

impl ThreeSides<'_> {
    fn is_geared(&self, joint: usize) -> bool {
        self.layout.rules.joints[joint].pair == PairKind::Gear
    }

    /// Every joint with the sides on which it stands.
    fn each(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let joints = self.layout.rules.joints.iter().enumerate();
        joints.flat_map(|(i, j)| (0..self.structure.copies(j)).map(move |side| (i, side)))
    }

    fn name(&self, joint: usize, side: usize) -> String {
        let link = |l: usize| self.structure.link(l, side);
        let names = (0..self.of_two.len()).map(|l| {
            let name = link(l).map(|l| self.names[l].clone());
            name.unwrap_or_default()
        });
        let names: Vec<String> = names.collect();
        joint_id(&self.layout.rules, joint, &names)
    }

    fn joint(&self, i: usize, side: usize, menu: &Menu) -> JointEntry {
        let (two, layout) = (&self.structure.two, self.layout);
        let one = two.joint(layout, i, &self.of_two, menu);
        let meshes = layout.rules.meshes.iter().flatten();
        let held = meshes.clone().any(|m| m.held.contains(&i));
        // A ball's turns are none by which teeth could hold it.
        let options = menu.options.iter().filter(|o| !held || !is_ball(o));
        let menu = Menu {
            options: options.cloned().collect(),
            unloading: menu.unloading.clone(),
        };
        #[allow(clippy::cast_possible_truncation, reason = "at most three")]
        let here = joint_on(
            side as u8,
            self.pivot,
            &one,
            whole(layout.at.points[i]),
            &menu,
        );
        let renamed = |link: &String| {
            let l = self.of_two.iter().position(|n| n == link).unwrap_or(0);
            self.names[self.structure.link(l, side).unwrap_or(0)].clone()
        };
        JointEntry {
            id: self.name(i, side),
            links: here.links.each_ref().map(renamed),
            ..here
        }
    }

    fn coupling(&self, i: usize, side: usize) -> Option<CouplingEntry> {
        let mesh = self.layout.rules.meshes[i].as_ref()?;
        let two = &self.structure.two;
        Some(CouplingEntry {
            joints: mesh.held.map(|held| self.name(held, side)),
            ..two.coupling(self.layout, i, mesh, &self.of_two)
        })
    }

    /// The points of a link, its tip last where it is a jaw.
    fn points(&self, link: usize, tips: &[Place]) -> Vec<Vector> {
        let (rules, at) = (&self.layout.rules, &self.layout.at);
        let of = |&(i, side): &(usize, usize)| {
            let ends = rules.joints[i].links.map(|l| self.structure.link(l, side));
            ends.contains(&Some(link)) && !self.is_geared(i)
        };
        #[allow(clippy::cast_possible_truncation, reason = "at most three")]
        let place = |(i, side): (usize, usize)| Place {
            thirds: side as u8,
            ..whole(at.points[i])
        };
        let jaw = self.structure.jaws().iter().position(|&j| j == link);
        let own = self.each().filter(of).map(place);
        let all = own.chain(jaw.map(|n| tips[n]));
        all.map(|p| self.pivot.real(p)).collect()
    }
}

/// The entries of the file of a gripper of three jaws.
#[must_use]
pub(crate) fn mechanism_file_of_three(
    structure: &ThreefoldStructure,
    layout: &PairLayout,
    menu: &Menu,
    workload: &Workload,
) -> MechanismFile {
    let sides = ThreeSides {
        structure,
        layout,
        names: names_of_three(structure),
        of_two: link_names(&structure.two),
        pivot: structure.pivot(),
    };
    let joints = &layout.rules.joints;
    let turned = |place: Place| [0, 1, 2].map(|thirds| Place { thirds, ..place });
    let tips = turned(whole(layout.at.points[joints.len()]));
    let jaws = structure.jaws();
    let names = sides.names.iter().enumerate();
    let told = FileHead {
        id: structure.id(),
        name: structure.name(),
        links: names
            .map(|(l, n)| (n.clone(), sides.points(l, &tips)))
            .collect(),
        frame: structure
            .link(structure.two.structure.roles.frame, 0)
            .unwrap_or(0),
        jaws: &jaws,
        held: HeldPart {
            tips: &tips,
            outward: &turned(Place::from([0, 1])),
            grip: layout.limits.task.grip.sign(),
            pivot: sides.pivot,
        },
    };
    let rounds =
        (0..joints.len()).filter(|&i| structure.copies(&joints[i]) == SIDES && !sides.is_geared(i));
    let couplings = sides.each().filter_map(|(i, side)| sides.coupling(i, side));
    let made = sides.each().filter(|of| !sides.is_geared(of.0));
    MechanismFile {
        joint: made.map(|(i, side)| sides.joint(i, side, menu)).collect(),
        coupling: couplings.collect(),
        search: SearchEntry {
            turn: rounds
                .map(|i| (0..SIDES).map(|side| sides.name(i, side)).collect())
                .collect(),
            ..structure.two.offers(menu)
        },
        ..told.file(workload)
    }
}
