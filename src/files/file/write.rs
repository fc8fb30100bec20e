//! A mechanism as the entries of its file, exactly.

mod number;

use crate::file::prelude::*;
use crate::file::read::resolve::motion_name;
use crate::file::read::value::with_parameters;
use crate::file::read::{read_claims, read_expected, read_tables};
pub(crate) use crate::file::write::number::plain_number;
use crate::file::write::number::{write_component, write_coordinate, write_ratio};
use crate::model::loads::Inertia;
use crate::model::mechanism::{Drives, Mode, PointOfInterest};
use serde::Deserialize;

/// Returns the file of a mechanism. Options that the file had in common are listed at each joint. Workload, ranking, figures and
/// claims are those of the file that it was read from.
///
/// # Examples
/// ```
/// use ozols::file::write::{mechanism_file, toml};
/// let four_bar = ozols::built_in("four-bar")?;
/// let again = ozols::from_toml(&toml(&mechanism_file(&four_bar))?)?;
/// assert_eq!(again.joints.len(), four_bar.joints.len());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn mechanism_file(m: &Mechanism) -> MechanismFile {
    file_with(m, kept_tables(m))
}

/// Returns the file of a mechanism with the tables that are kept.
fn file_with(m: &Mechanism, kept: MechanismFile) -> MechanismFile {
    let stated = number::file_tolerance(m);
    let joints = m.joints.iter();
    let joints = joints.map(|j| write_joint(m, j, stated.as_ref()));
    let contour = |list: &Vec<JointId>| ContourEntry {
        joints: list.iter().map(|&j| m.joints[j].id.clone()).collect(),
    };
    let (mode, plane_normal) = match &m.mode {
        Mode::Spatial => (None, None),
        Mode::Planar { normal } => (Some("planar".to_owned()), Some(write_direction(normal))),
    };
    let link = |l: &Link| {
        let mass = l.mass.as_ref();
        LinkEntry {
            id: l.id.clone(),
            role: role_word(l.role).map(ToOwned::to_owned),
            mass: mass.map(|p| p.mass),
            centre: mass.map(|p| write_vector(&p.centre)),
            inertia: mass.and_then(|p| p.inertia).map(write_inertia),
        }
    };
    let point = |p: &PointOfInterest| PointEntry {
        id: p.id.clone(),
        link: m.links[p.link].id.clone(),
        point: write_vector(&p.point),
        tolerance: number::point_tolerance(&p.point, stated.as_ref()),
    };
    MechanismFile {
        name: m.name.clone(),
        description: m.description.clone(),
        sources: m.sources.clone(),
        assumed: m.assumed.clone(),
        length_unit: Some(m.length_unit.symbol.to_owned()),
        mode,
        plane_normal,
        tolerance: stated.clone(),
        link: m.links.iter().map(link).collect(),
        joint: joints.collect(),
        coupling: m.couplings.iter().map(|c| write_coupling(m, c)).collect(),
        contour: m.contours.iter().map(contour).collect(),
        point: m.points.iter().map(point).collect(),
        search: write_search(m),
        joint_types: write_joint_types(m),
        // A redesign has no figures and claims of its own.
        expected: if m.expected.is_empty() {
            Vec::new()
        } else {
            kept.expected
        },
        claim: if m.claims.is_empty() {
            Vec::new()
        } else {
            kept.claim
        },
        ..kept
    }
}

/// Returns the tables that are written as the file has them, with the parameters that they use.
fn kept_tables(m: &Mechanism) -> MechanismFile {
    MechanismFile::deserialize(&*m.tables).unwrap_or_default()
}

/// Returns the file of a mechanism if its loads, ranking, figures and claims are those of the file that it was read from, which are
/// written. A redesign has no figures and claims.
pub(crate) fn own_file(m: &Mechanism) -> Option<MechanismFile> {
    let kept = kept_tables(m);
    let mut out = with_parameters(&kept);
    out.states.clone_from(&m.states);
    let mut again = m.clone().into_parts();
    read_tables(&kept, &mut again, &out);
    again.expected = read_expected(&kept, &again, &out);
    again.claims = read_claims(&kept, &out);
    let told = |m: &Parts| format!("{:?} {:?}", m.loads, m.ranking);
    let own = told(&again) == told(m)
        && (m.expected.is_empty() || m.expected == again.expected)
        && (m.claims.is_empty() || m.claims == again.claims);
    own.then(|| file_with(m, kept))
}

/// Returns the capacities of joint types; their costs are under `[search.costs]`.
fn write_joint_types(m: &Mechanism) -> BTreeMap<String, JointTypeEntry> {
    let each = m.joint_types.iter().map(|t| {
        let entry = JointTypeEntry {
            cost: None,
            capacity_force: t.capacity_force,
            capacity_moment: t.capacity_moment,
            clearance: t.clearance,
        };
        (t.name.clone(), entry)
    });
    each.collect()
}

/// Writes a file as TOML.
///
/// # Errors
/// No error is known for the file of a validated mechanism.
pub fn toml(file: &MechanismFile) -> Result<String, toml::ser::Error> {
    toml::to_string(&file.json())
}

/// Returns the word for a role.
pub(crate) fn role_word(role: Role) -> Option<&'static str> {
    match role {
        Role::Frame => Some("frame"),
        Role::Output => Some("output"),
        Role::Object => Some("object"),
        Role::Inner => None,
    }
}

fn write_vector(v: &[Expr; 3]) -> [Coordinate; 3] {
    v.each_ref().map(write_coordinate)
}

fn write_direction(v: &[Expr; 3]) -> [Coordinate; 3] {
    v.each_ref().map(write_component)
}

fn are_same(a: &[Expr; 3], b: &[Expr; 3]) -> bool {
    a.iter().zip(b).all(|(x, y)| x.to_string() == y.to_string())
}

/// Returns true if the reference is the default: x, or y if the axis is along x.
fn is_default(f: &Frame) -> bool {
    let unit = |i: usize| [0, 1, 2].map(|k| Expr::from(i64::from(k == i)));
    let size = f.axis.each_ref().map(|c| c.to_f64().abs());
    if size[1] + size[2] > 1e-6 * size[0] {
        return are_same(&f.reference, &unit(0));
    }
    f.axis[1].is_zero_rational() && f.axis[2].is_zero_rational() && are_same(&f.reference, &unit(1))
}

fn has_screw(t: &JointType) -> bool {
    t.freedoms().contains(&Freedom::Screw)
}

/// Returns the names of the freedoms of a custom joint type.
pub(crate) fn freedom_names(t: &JointType) -> Option<Vec<String>> {
    match t {
        JointType::Custom(list) => Some(list.iter().map(|f| f.name().to_owned()).collect()),
        _ => None,
    }
}

#[allow(
    clippy::cast_precision_loss,
    reason = "costs are at most 1e9 thousandths"
)]
fn cost_number(milli: i64) -> f64 {
    milli as f64 / 1000.0
}

/// Returns the names of states, if any are named.
fn state_names(m: &Mechanism, of: Option<&Vec<StateId>>) -> Option<Words> {
    of.map(|s| Words::Many(s.iter().map(|&s| m.states[s].clone()).collect()))
}

fn write_joint(m: &Mechanism, j: &Joint, stated: Option<&ToleranceEntry>) -> JointEntry {
    // The original joint needs no entry, unless it has its own name or cost.
    let own = |o: &JointOption| o.cost_milli.is_some() || o.name != motion_name(&o.joint_type);
    let listed = j.options.iter();
    let listed = listed.skip(usize::from(!j.options.first().is_some_and(own)));
    let options: Vec<OptionEntry> = listed.map(|o| write_option(m, o, &j.frame)).collect();
    let options = (!options.is_empty()).then_some(options);
    let unloading = j.unloading.iter().map(|o| write_option(m, o, &j.frame));
    let unloading = (!j.unloading.is_empty()).then(|| Unloading::List(unloading.collect()));
    JointEntry {
        id: j.id.clone(),
        links: j.links.map(|l| m.links[l].id.clone()),
        kind: j.joint_type.name().to_owned(),
        freedoms: freedom_names(&j.joint_type),
        point: write_vector(&j.frame.point),
        axis: Some(write_direction(&j.frame.axis)),
        reference: (!is_default(&j.frame)).then(|| write_direction(&j.frame.reference)),
        pitch: has_screw(&j.joint_type).then(|| write_coordinate(&j.frame.pitch)),
        tolerance: number::point_tolerance(&j.frame.point, stated),
        drive: match j.drive_freedom {
            Some(freedom) => DriveWord::Freedom(freedom.name().to_owned()),
            None => DriveWord::Driven(j.drive),
        },
        state: state_names(m, j.states.as_ref()),
        options,
        unloading,
        ..JointEntry::default()
    }
}

fn write_coupling(m: &Mechanism, c: &Coupling) -> CouplingEntry {
    let end = |i: usize| {
        let joint = &m.joints[c.ends[i].joint];
        match joint.joint_type.freedoms() {
            [_] => joint.id.clone(),
            _ => format!("{}:{}", joint.id, c.ends[i].freedom.name()),
        }
    };
    CouplingEntry {
        joints: [end(0), end(1)],
        ratio: write_ratio(&c.ratio),
        gear: c.gear,
    }
}

/// Returns the entry of an option: only its type if everything else equals the joint's own.
fn write_option(m: &Mechanism, o: &JointOption, present: &Frame) -> OptionEntry {
    let f = &o.frame;
    let turned = !are_same(&f.axis, &present.axis);
    let table = OptionTable {
        kind: Some(o.joint_type.name().to_owned()),
        freedoms: freedom_names(&o.joint_type),
        point: (!are_same(&f.point, &present.point)).then(|| write_vector(&f.point)),
        axis: turned.then(|| write_direction(&f.axis)),
        reference: (turned || !are_same(&f.reference, &present.reference))
            .then(|| write_direction(&f.reference)),
        pitch: (has_screw(&o.joint_type) && f.pitch.to_string() != present.pitch.to_string())
            .then(|| write_coordinate(&f.pitch)),
        name: Some(o.name.clone()).filter(|n| n != o.joint_type.name()),
        cost: o.cost_milli.map(cost_number),
        state: o.state.map(|s| m.states[s].clone()),
        ..OptionTable::default()
    };
    let word = OptionEntry::Word(o.joint_type.name().to_owned());
    if *word.as_table() == table {
        return word;
    }
    OptionEntry::Table(Box::new(table))
}

fn write_search(m: &Mechanism) -> SearchEntry {
    let spec = &m.search;
    let mut costs = spec.costs.clone();
    let others = costs.other_costs().into_iter();
    let others = others.filter_map(|(n, c)| Some((n.to_owned(), (*c)?)));
    let costs = spec.costs.by_type_milli.iter().cloned().chain(others);
    let id = |j: JointId| m.joints[j].id.clone();
    let groups = spec.turn.iter().map(|g| g.iter().map(|&j| id(j)).collect());
    SearchEntry {
        hold: spec.hold.iter().map(|&l| m.links[l].id.clone()).collect(),
        mirror: spec.mirror.iter().map(|&(a, b)| [id(a), id(b)]).collect(),
        turn: groups.collect(),
        max_redundant: Some(spec.max_redundant).filter(|n| *n > 0),
        max_mobility: spec.max_mobility,
        symmetric: spec.symmetric,
        drives: (spec.drive_rule != Drives::Kept).then(|| spec.drive_rule.word().to_owned()),
        pose_only: spec.pose_only,
        costs: costs.map(|(n, c)| (n, cost_number(c))).collect(),
        ..SearchEntry::default()
    }
}

fn write_inertia(i: Inertia) -> InertiaEntry {
    match i {
        Inertia::Plane(x) => InertiaEntry::Plane(x),
        Inertia::Principal(v) => InertiaEntry::List(v.to_vec()),
        Inertia::Tensor(v) => InertiaEntry::List(v.to_vec()),
    }
}
