//! A paired layout as a mechanism file: hinges square to the plane, guides and slots in it, gears as couplings.

use crate::chains::layout_symmetry::Symmetry;
use crate::chains::pairs::PairKind;
use crate::file::schema::{
    Coordinate, CouplingEntry, DriveWord, JointEntry, MechanismFile, OptionEntry, OptionTable,
    SearchEntry, Unloading,
};
use crate::synthesis::mechanism::{FileHead, Menu, in_space, joint_name};
use crate::synthesis::paired::Teeth;
use crate::synthesis::paired::layout::PairLayout;
use crate::synthesis::paired::rules::{Mesh, PairRules};
use crate::synthesis::paired::structure::PairedStructure;
use crate::synthesis::place::{Pivot, Place, Point, point};
use crate::synthesis::task;
use crate::synthesis::workload::{HeldPart, Workload};

/// What each link is called: frame, the jaws, slider or crank, of a cylinder between two links cylinder and piston, and the rest by
/// their numbers.
#[must_use]
pub(crate) fn link_names(paired: &PairedStructure) -> Vec<String> {
    let roles = &paired.structure.roles;
    let [base, driver] = paired.drive();
    let slides = paired.structure.slides();
    let jaw = |l: usize| roles.jaws.iter().position(|&j| j == l);
    let name = |l: usize| match l {
        l if l == roles.frame => "frame".to_owned(),
        l if l == driver && base == roles.frame && slides => "slider".to_owned(),
        l if l == driver && paired.form.threaded => "screw".to_owned(),
        l if l == driver && base == roles.frame => "crank".to_owned(),
        l if l == driver && slides => "piston".to_owned(),
        l if l == base && slides => "cylinder".to_owned(),
        l => format!("link-{l}"),
    };
    let of = |l: usize| jaw(l).map_or_else(|| name(l), |n| task::JAW_NAMES[n].to_owned());
    (0..paired.structure.chain.links()).map(of).collect()
}

/// A place of whole millimetres.
#[allow(clippy::cast_possible_truncation, reason = "whole and small")]
pub(super) fn whole(p: Point) -> Place {
    Place::from(p.map(|x| x.round() as i32))
}

/// What a joint is called, where links are called so: by its links, the second of two slots by a number more.
pub(super) fn joint_id(rules: &PairRules, joint: usize, names: &[String]) -> String {
    let [u, v] = rules.joints[joint].links;
    let second = rules.joints[..joint].iter().any(|j| j.links == [u, v]);
    let name = joint_name(names, (u, v));
    if second { name + "-2" } else { name }
}

fn named(name: &str, freedoms: &[&str]) -> OptionEntry {
    with_lead(None, name, freedoms)
}

fn with_lead(lead: Option<i64>, name: &str, freedoms: &[&str]) -> OptionEntry {
    OptionEntry::Table(Box::new(OptionTable {
        freedoms: Some(freedoms.iter().map(|f| (*f).to_owned()).collect()),
        lead: lead.map(Coordinate::Integer),
        name: Some(name.to_owned()),
        ..OptionTable::default()
    }))
}

fn word(kind: &str) -> OptionEntry {
    OptionEntry::Word(kind.to_owned())
}

/// What may be in place of a guide: z along it, x square to the plane of motion.
fn slides() -> Vec<OptionEntry> {
    vec![
        word("prismatic"),
        word("cylindrical"),
        named("tongue-in-groove", &["tz", "tx"]),
        named("round-tongue-in-groove", &["tz", "tx", "rz"]),
        named("ball-in-groove", &["tz", "tx", "rz", "ry"]),
    ]
}

/// What may be in place of flat faces: z along them, x square to the plane of motion.
fn faces() -> Vec<OptionEntry> {
    let of_slots = vec![
        named("pin-in-slot", &["tz", "rx"]),
        named("pin-in-deep-slot", &["tz", "rx", "tx"]),
        named("ball-in-slot", &["tz", "rx", "ry", "rz"]),
        named("ball-in-deep-slot", &["tz", "tx", "rx", "ry", "rz"]),
    ];
    slides().into_iter().chain(of_slots).collect()
}

/// What may be in place of a pin in a slot: z along the pin, x along the slot.
fn slots() -> Vec<OptionEntry> {
    vec![
        word("slotted"),
        named("pin-in-deep-slot", &["rz", "tx", "tz"]),
        named("ball-in-slot", &["rx", "ry", "rz", "tx"]),
        named("ball-in-deep-slot", &["rx", "ry", "rz", "tx", "tz"]),
    ]
}

/// What may be in place of a nut: z along the screw.
fn nuts(lead: i64) -> Vec<OptionEntry> {
    let nut = |name, freedoms: &[&str]| with_lead(Some(lead), name, freedoms);
    vec![
        nut("nut", &["screw"]),
        nut("floating-nut", &["screw", "tx", "ty"]),
        nut("nut-in-ball", &["screw", "rx", "ry"]),
        nut("floating-nut-in-ball", &["screw", "rx", "ry", "tx", "ty"]),
    ]
}

impl PairedStructure {
    pub(super) fn joint(
        &self,
        layout: &PairLayout,
        i: usize,
        names: &[String],
        menu: &Menu,
    ) -> JointEntry {
        let joint = &layout.rules.joints[i];
        let input = joint.links == self.structure.roles.input;
        let flat = self.flat_slots().contains(joint);
        let upright = [0, 0, 1].map(Coordinate::Integer);
        let along = point(layout.at.along[i].place());
        let (kind, axis, reference, options) = match joint.pair {
            PairKind::Slide => ("prismatic", along, Some(upright.clone()), Some(slides())),
            PairKind::Slot if flat => {
                let upright = Some(upright.clone());
                ("prismatic", along, upright, Some(faces()))
            }
            PairKind::Slot => ("slotted", upright.clone(), Some(along), Some(slots())),
            // Teeth are no joint, and two slots are two.
            PairKind::Hinge | PairKind::Gear | PairKind::TwoSlots => {
                ("revolute", upright.clone(), None, None)
            }
        };
        let thread = self.thread(layout, i);
        let across = [0, 1, 0].map(Coordinate::Integer);
        let (kind, axis, reference, options) = match thread {
            None => (kind, axis, reference, options),
            // The screw turns about its own axis.
            Some(None) => ("revolute", across, Some(upright), None),
            Some(Some(lead)) => ("helical", across, Some(upright), Some(nuts(lead))),
        };
        let mut at = layout.at.points[i];
        if let Some(mesh) = layout.rules.meshes[i].filter(|_| thread.is_some()) {
            // On the screw, beside the guide.
            at[1] = layout.at.points[mesh.held[1]][1];
        }
        let in_series = joint.pair == PairKind::Hinge && !input && !menu.unloading.is_empty();
        JointEntry {
            id: joint_id(&layout.rules, i, names),
            links: self.ends(layout, i).map(|l| names[l].clone()),
            kind: kind.to_owned(),
            freedoms: None,
            point: point(whole(at)),
            axis: Some(axis),
            reference,
            lead: thread.flatten().map(Coordinate::Integer),
            pitch: None,
            tolerance: None,
            drive: DriveWord::Driven(input),
            state: None,
            options: options.filter(|_| !input),
            forbid: Vec::new(),
            unloading: in_series.then_some(Unloading::Allowed(true)),
        }
    }

    /// Of a joint of a screw the lead along y, of its own hinge nothing; `None` of other joints.
    fn thread(&self, layout: &PairLayout, i: usize) -> Option<Option<i64>> {
        if !self.form.threaded {
            return None;
        }
        let mesh = layout.rules.meshes[i];
        let lead = mesh.zip(match layout.at.teeth[i] {
            Teeth::Thread(lead) => Some(i64::from(lead)),
            _ => None,
        });
        let lead = lead.map(|(mesh, lead)| {
            // A nut that does not turn goes back where the screw turns on.
            let [_, y] = layout.at.along[mesh.held[1]].place().whole;
            -lead * i64::from(y.signum())
        });
        let own = layout.rules.joints[i].links == self.structure.roles.input;
        lead.map(Some).or(own.then_some(None))
    }

    /// The links of a joint as a file has them: the drive's second is the driver; the pin of a slot is on the first, the block of a slide
    /// on the second.
    fn ends(&self, layout: &PairLayout, i: usize) -> [usize; 2] {
        let joint = &layout.rules.joints[i];
        let [u, v] = joint.links;
        let second_first = match joint.pair {
            _ if joint.links == self.structure.roles.input => self.drive() == [v, u],
            PairKind::Slot => layout.at.pinned[i] == v,
            PairKind::Slide => layout.rules.blocks[i] == u,
            _ => false,
        };
        if second_first { [v, u] } else { [u, v] }
    }

    /// What the search may put in place of hinges, where there are any that are not driven.
    pub(super) fn offers(&self, menu: &Menu) -> SearchEntry {
        let joints = self.structure.chain.joints().into_iter();
        let mut hinges = joints.filter(|j| j.pair == PairKind::Hinge);
        if hinges.all(|j| j.links == self.structure.roles.input) {
            return SearchEntry::default();
        }
        SearchEntry {
            options: menu.options.clone(),
            unloading: menu.unloading.clone(),
            ..SearchEntry::default()
        }
    }

    pub(super) fn coupling(
        &self,
        layout: &PairLayout,
        i: usize,
        mesh: &Mesh,
        names: &[String],
    ) -> CouplingEntry {
        // A joint's coordinate is that of its second link against the first.
        let first = mesh.held.map(|j| self.ends(layout, j)[0]);
        let turned = first.iter().filter(|&&l| l != mesh.carrier).count() == 1;
        let signed = |x: i32| i64::from(if turned { -x } else { x });
        let ratio = match layout.at.teeth[i] {
            Teeth::Gears([r, s]) if r == s => Coordinate::Integer(signed(-1)),
            Teeth::Gears([r, s]) => Coordinate::Expression(format!("{}/{s}", signed(-r))),
            Teeth::Rack(diameter) if diameter % 2 == 0 => Coordinate::Integer(signed(diameter / 2)),
            Teeth::Rack(diameter) => Coordinate::Expression(format!("{}/2", signed(diameter))),
            Teeth::Thread(lead) => Coordinate::Expression(format!("{}/(2*pi)", signed(lead))),
        };
        CouplingEntry {
            joints: mesh.held.map(|j| joint_id(&layout.rules, j, names)),
            ratio,
            gear: true,
        }
    }
}

/// The entries of the file.
#[must_use]
pub(crate) fn mechanism_file(
    paired: &PairedStructure,
    layout: &PairLayout,
    menu: &Menu,
    workload: &Workload,
) -> MechanismFile {
    let names = link_names(paired);
    let roles = &paired.structure.roles;
    let rules = &layout.rules;
    let joints = 0..rules.joints.len();
    let told = FileHead {
        id: paired.id(),
        name: paired.name(),
        links: names
            .iter()
            .enumerate()
            .map(|(l, n)| (n.clone(), in_space(&points_of(paired, layout, l))))
            .collect(),
        frame: roles.frame,
        jaws: &roles.jaws,
        held: HeldPart {
            tips: &paired.tips(&layout.limits.task),
            outward: &task::outward(roles.jaws.len(), 1),
            grip: layout.limits.task.grip.sign(),
            pivot: Pivot::Normal,
        },
    };
    let couplings = joints.clone().filter_map(|i| {
        let mesh = rules.meshes[i].as_ref().filter(|_| is_geared(layout, i))?;
        Some(paired.coupling(layout, i, mesh, &names))
    });
    let made = joints.clone().filter(|&i| !is_geared(layout, i));
    MechanismFile {
        joint: made
            .map(|i| paired.joint(layout, i, &names, menu))
            .collect(),
        coupling: couplings.collect(),
        search: search_entry(paired, layout, menu, &names),
        ..told.file(workload)
    }
}

/// Whether a joint is a mesh of gears, which is a coupling in a file.
fn is_geared(layout: &PairLayout, joint: usize) -> bool {
    layout.rules.joints[joint].pair == PairKind::Gear && !layout.rules.threaded
}

/// The points of a link: its joints, and its tip where it is a jaw.
fn points_of(paired: &PairedStructure, layout: &PairLayout, link: usize) -> Vec<Point> {
    let joints = &layout.rules.joints;
    let of = |i: &usize| joints[*i].is_at(link) && !is_geared(layout, *i);
    let own = (0..joints.len()).filter(of).map(|i| layout.at.points[i]);
    let jaws = &paired.structure.roles.jaws;
    let jaw = jaws.iter().position(|&j| j == link);
    let tip = jaw.map(|n| layout.at.points[joints.len() + n]);
    own.chain(tip).collect()
}

/// What the search may put at the joints, and which of them are images of each other.
fn search_entry(
    paired: &PairedStructure,
    layout: &PairLayout,
    menu: &Menu,
    names: &[String],
) -> SearchEntry {
    let rules = &layout.rules;
    let name = |i: usize| joint_id(rules, i, names);
    // A drive on one side alone is no symmetry of what is asked.
    let images = rules
        .images()
        .filter(|&(a, _)| !is_geared(layout, a) && !paired.form.one_sided);
    let images: Vec<[String; 2]> = images.map(|(a, b)| [name(a), name(b)]).collect();
    let (mirror, turn) = match paired.form.symmetry {
        Symmetry::Mirror => (images, Vec::new()),
        _ => (Vec::new(), images.into_iter().map(Vec::from).collect()),
    };
    SearchEntry {
        mirror,
        turn,
        ..paired.offers(menu)
    }
}
