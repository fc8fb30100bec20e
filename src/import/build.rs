//! Validation: from the file's entries to a mechanism, or every problem with them.

use crate::closure::contour::closed_walk;
use crate::geom::expr::Expr;
use crate::import::drive::drive;
use crate::import::grip::grip;
use crate::import::loads::{loads, mass};
use crate::import::locate::Step;
use crate::import::problem::ProblemKind;
use crate::import::ranking::{joint_types, ranking};
use crate::import::resolve::{
    Findings, contains, cost, frame, index, joint_type, key, number, option, vector, zero3,
};
use crate::import::schema::{JointEntry, MechanismFile, OptionEntry, Unloading, Words};
use crate::model::joint_type::JointType;
use crate::model::loads::Loads;
use crate::model::mechanism::{
    Expected, Joint, JointId, JointOption, LengthUnit, Link, LinkId, Mechanism, Mode, Role,
    SearchSpec,
};
use itertools::Itertools;

/// A problem and the path of the item it concerns.
pub type Finding = (Vec<Step>, ProblemKind);

/// Most links, joints, and options of one joint in a file.
pub const LIMITS: (usize, usize, usize) = (2000, 4000, 64);

const UNITS: [LengthUnit; 5] = [
    LengthUnit {
        symbol: "m",
        metres: 1.0,
    },
    LengthUnit {
        symbol: "mm",
        metres: 1e-3,
    },
    LengthUnit {
        symbol: "cm",
        metres: 1e-2,
    },
    LengthUnit {
        symbol: "um",
        metres: 1e-6,
    },
    LengthUnit {
        symbol: "in",
        metres: 0.0254,
    },
];

/// Builds a mechanism.
///
/// # Errors
/// Every problem found.
pub fn build(file: &MechanismFile) -> Result<Mechanism, Vec<Finding>> {
    let mut out = Findings::default();
    let root = |k: &str| vec![Step::Key(k.to_owned())];
    for (what, count, limit) in [
        ("links", file.link.len(), LIMITS.0),
        ("joints", file.joint.len(), LIMITS.1),
    ] {
        if count > limit {
            return Err(vec![(
                root(&what[..what.len() - 1]),
                ProblemKind::TooMany { what, count, limit },
            )]);
        }
    }
    let length_unit = length_unit(file, &mut out);
    let mode = match file.mode.as_deref().unwrap_or("spatial") {
        "planar" => {
            let at = root("plane_normal");
            let given = file.plane_normal.as_ref().map(|v| vector(v, &at, &mut out));
            let normal = given.unwrap_or_else(|| [0, 0, 1].map(Expr::from));
            if normal.iter().all(|c| c.to_f64() == 0.0) {
                out.add(
                    &at,
                    ProblemKind::ZeroVector {
                        joint: "of the plane".to_owned(),
                        what: "normal",
                    },
                );
            }
            Mode::Planar { normal }
        }
        other => {
            if other != "spatial" {
                let known = "spatial, planar".to_owned();
                out.add(
                    &root("mode"),
                    ProblemKind::UnknownWord {
                        what: "mode",
                        word: other.to_owned(),
                        known,
                    },
                );
            }
            Mode::Spatial
        }
    };
    let links = links(file, &mut out);
    let mut states = vec!["free".to_owned()];
    for j in &file.joint {
        states.extend(words(j.state.as_ref()));
    }
    let states: Vec<String> = states.into_iter().unique().collect();
    let joints: Vec<Joint> = (0..file.joint.len())
        .filter_map(|i| joint(file, i, &links, &states, &mut out))
        .collect();
    if !out.found.is_empty() {
        return Err(out.found);
    }
    let mut mechanism = Mechanism {
        name: file.name.clone(),
        description: file.description.clone(),
        sources: file.sources.clone(),
        length_unit,
        mode,
        links,
        joints,
        states,
        contours: Vec::new(),
        search: SearchSpec::default(),
        loads: Loads::default(),
        ranking: None,
        joint_types: Vec::new(),
        expected: Vec::new(),
    };
    connected(&mechanism, &mut out);
    mechanism.contours = contours(file, &mechanism, &mut out);
    mechanism.search = search(file, &mechanism, &mut out);
    mechanism.loads = loads(file, &mechanism, &mut out);
    mechanism.loads.grip = grip(file, length_unit.metres, Some(&mechanism), &mut out);
    mechanism.loads.drive = drive(file, length_unit.metres, Some(&mechanism), &mut out);
    mechanism.ranking = ranking(file, &mut out);
    let (joint_types, costs) = joint_types(file, &mechanism, &mut out);
    mechanism.joint_types = joint_types;
    let by_type = &mut mechanism.search.costs.by_type_milli;
    by_type.extend(costs);
    // [search.costs] come first and win.
    by_type.sort_by(|a, b| a.0.cmp(&b.0));
    by_type.dedup_by(|later, first| later.0 == first.0);
    mechanism.expected = expected(file, &mechanism, &mut out);
    if out.found.is_empty() {
        Ok(mechanism)
    } else {
        Err(out.found)
    }
}

/// The file's unit of length.
pub(super) fn length_unit(file: &MechanismFile, out: &mut Findings) -> LengthUnit {
    let symbol = file.length_unit.as_deref().unwrap_or("m");
    let found = UNITS.into_iter().find(|u| u.symbol == symbol);
    found.unwrap_or_else(|| {
        let known = UNITS.iter().map(|u| u.symbol).join(", ");
        out.add(
            &[Step::Key("length_unit".to_owned())],
            ProblemKind::UnknownWord {
                what: "length unit",
                word: symbol.to_owned(),
                known,
            },
        );
        UNITS[0]
    })
}

fn words(w: Option<&Words>) -> Vec<String> {
    match w {
        None => Vec::new(),
        Some(Words::One(s)) => vec![s.clone()],
        Some(Words::Many(v)) => v.clone(),
    }
}

fn check_id(what: &'static str, id: &str, earlier: bool, path: &[Step], out: &mut Findings) {
    if id.is_empty() || id.chars().count() > 64 || id.chars().any(char::is_control) {
        out.add(path, ProblemKind::BadId { id: id.to_owned() });
    }
    if earlier {
        out.add(
            path,
            ProblemKind::Duplicate {
                what,
                id: id.to_owned(),
            },
        );
    }
}

fn links(file: &MechanismFile, out: &mut Findings) -> Vec<Link> {
    let mut links: Vec<Link> = Vec::new();
    for (i, entry) in file.link.iter().enumerate() {
        let at = [Step::Key("link".to_owned()), Step::Index(i)];
        check_id(
            "link",
            &entry.id,
            links.iter().any(|l| l.id == entry.id),
            &key(&at, "id"),
            out,
        );
        let role = match entry.role.as_deref() {
            None => Role::Inner,
            Some("frame") => Role::Frame,
            Some("output") => Role::Output,
            Some("object") => Role::Object,
            Some(word) => {
                let known = "frame, output, object".to_owned();
                out.add(
                    &key(&at, "role"),
                    ProblemKind::UnknownWord {
                        what: "role",
                        word: word.to_owned(),
                        known,
                    },
                );
                Role::Inner
            }
        };
        if let (Role::Frame, Some(first)) = (role, links.iter().find(|l| l.role == Role::Frame)) {
            out.add(
                &key(&at, "role"),
                ProblemKind::SecondFrame {
                    first: first.id.clone(),
                    second: entry.id.clone(),
                },
            );
        }
        links.push(Link {
            id: entry.id.clone(),
            role,
            mass: mass(entry, &at, out),
        });
    }
    let has = |role| links.iter().any(|l| l.role == role);
    if !has(Role::Frame) {
        out.add(&[Step::Key("link".to_owned())], ProblemKind::NoFrame);
    }
    if !has(Role::Output) {
        out.add(&[Step::Key("link".to_owned())], ProblemKind::NoOutput);
    }
    links
}

fn joint(
    file: &MechanismFile,
    i: usize,
    links: &[Link],
    states: &[String],
    out: &mut Findings,
) -> Option<Joint> {
    let entry = &file.joint[i];
    let at = [Step::Key("joint".to_owned()), Step::Index(i)];
    check_id(
        "joint",
        &entry.id,
        file.joint[..i].iter().any(|j| j.id == entry.id),
        &key(&at, "id"),
        out,
    );
    let mut ends = [0; 2];
    for (e, id) in entry.links.iter().enumerate() {
        match links.iter().position(|l| l.id == *id) {
            Some(l) => ends[e] = l,
            None => {
                let known = links.iter().take(30).map(|l| l.id.as_str()).join(", ");
                out.add(
                    &index(&key(&at, "links"), e),
                    ProblemKind::UnknownLink {
                        id: id.clone(),
                        known,
                    },
                );
            }
        }
    }
    if entry.links[0] == entry.links[1] {
        let (joint, link) = (entry.id.clone(), entry.links[0].clone());
        out.add(&key(&at, "links"), ProblemKind::SelfLoop { joint, link });
    }
    let found = joint_type(&entry.id, &entry.kind, entry.freedoms.as_ref(), &at, out);
    let Some(joint_type) = found else {
        // The rest depends on the type, but a bad point is worth telling in the same run.
        vector(&entry.point, &key(&at, "point"), out);
        return None;
    };
    let frame = place(entry, &joint_type, &at, out);
    let present = JointOption {
        name: present_name(&joint_type),
        joint_type: joint_type.clone(),
        frame: frame.clone(),
        cost_milli: None,
    };
    let states_of = entry.state.as_ref().map(|w| {
        words(Some(w))
            .iter()
            .filter_map(|w| states.iter().position(|s| s == w))
            .collect::<Vec<_>>()
    });
    let in_free = states_of.as_ref().is_none_or(|s| s.contains(&0));
    let changeable = in_free && !entry.drive && joint_type != JointType::Fixed;
    let options = options(file, entry, &present, changeable, &at, out);
    let unloading = match &entry.unloading {
        None | Some(Unloading::Allowed(false)) => Vec::new(),
        Some(Unloading::Allowed(true)) => {
            let from = key(&[Step::Key("search".to_owned())], "unloading");
            file.search
                .unloading
                .iter()
                .enumerate()
                .filter_map(|(n, e)| option(&entry.id, &frame, e, &index(&from, n), out))
                .collect()
        }
        Some(Unloading::List(list)) => {
            let from = key(&at, "unloading");
            list.iter()
                .enumerate()
                .filter_map(|(n, e)| option(&entry.id, &frame, e, &index(&from, n), out))
                .collect()
        }
    };
    Some(Joint {
        id: entry.id.clone(),
        links: ends,
        joint_type,
        frame,
        drive: entry.drive,
        states: states_of,
        options,
        unloading,
    })
}

fn present_name(joint_type: &JointType) -> String {
    match joint_type {
        JointType::Custom(list) => list.iter().map(|f| f.name()).join("+"),
        other => other.name().to_owned(),
    }
}

fn place(
    entry: &JointEntry,
    joint_type: &JointType,
    at: &[Step],
    out: &mut Findings,
) -> crate::model::mechanism::Frame {
    let point = vector(&entry.point, &key(at, "point"), out);
    let axis = match (&entry.axis, joint_type) {
        (Some(v), _) => vector(v, &key(at, "axis"), out),
        (None, JointType::Spherical | JointType::Fixed) => [0, 0, 1].map(Expr::from),
        (None, _) => {
            let what = "an axis, such as axis = [0, 0, 1]";
            out.add(
                at,
                ProblemKind::Missing {
                    joint: entry.id.clone(),
                    kind: entry.kind.clone(),
                    what,
                },
            );
            [0, 0, 1].map(Expr::from)
        }
    };
    let reference = entry
        .reference
        .as_ref()
        .map(|v| vector(v, &key(at, "reference"), out));
    let screws = joint_type
        .freedoms()
        .contains(&crate::model::joint_type::Freedom::Screw);
    match (&entry.pitch, screws) {
        (None, true) => {
            let what = "a pitch, the translation per radian";
            out.add(
                at,
                ProblemKind::Missing {
                    joint: entry.id.clone(),
                    kind: entry.kind.clone(),
                    what,
                },
            );
        }
        (Some(_), false) => {
            let (joint, kind) = (entry.id.clone(), entry.kind.clone());
            out.add(
                &key(at, "pitch"),
                ProblemKind::Superfluous {
                    joint,
                    kind,
                    what: "pitch",
                },
            );
        }
        _ => {}
    }
    let pitch = entry
        .pitch
        .as_ref()
        .map_or_else(|| zero3()[0].clone(), |c| number(c, &key(at, "pitch"), out));
    frame(&entry.id, point, axis, reference, pitch, at, out)
}

/// The options of a joint, the present one first. Options of its own list must contain the present motion; those of
/// the common list that do not are passed over.
fn options(
    file: &MechanismFile,
    entry: &JointEntry,
    present: &JointOption,
    changeable: bool,
    at: &[Step],
    out: &mut Findings,
) -> Vec<JointOption> {
    let (list, from, own): (&[OptionEntry], Vec<Step>, bool) = match &entry.options {
        Some(list) => (list, key(at, "options"), true),
        None if changeable => (
            &file.search.options,
            key(&[Step::Key("search".to_owned())], "options"),
            false,
        ),
        None => (&[], Vec::new(), false),
    };
    let mut options = vec![present.clone()];
    if list.len() > LIMITS.2 {
        out.add(
            &from,
            ProblemKind::TooMany {
                what: "options",
                count: list.len(),
                limit: LIMITS.2,
            },
        );
        return options;
    }
    for (n, item) in list.iter().enumerate() {
        let path = index(&from, n);
        // A bad entry of the common list would be reported once per joint.
        let (before, Some(option)) = (
            out.found.len(),
            option(&entry.id, &present.frame, item, &path, out),
        ) else {
            continue;
        };
        if out.found.len() > before || entry.forbid.contains(&option.name) {
            continue;
        }
        let same =
            option.joint_type == present.joint_type && contains(&option, present) == Some(true);
        if same && options.len() == 1 + n {
            // The present joint, listed: keep its name and cost.
            options[0].cost_milli = option.cost_milli.or(options[0].cost_milli);
            continue;
        }
        if same {
            continue;
        }
        match contains(&option, present) {
            Some(true) => {}
            Some(false) if own => {
                let (joint, option, present) =
                    (entry.id.clone(), option.name, present.name.clone());
                out.add(
                    &path,
                    ProblemKind::LosesMotion {
                        joint,
                        option,
                        present,
                    },
                );
                continue;
            }
            _ => continue,
        }
        if options.iter().any(|o| o.name == option.name) {
            out.add(
                &path,
                ProblemKind::RepeatedOption {
                    joint: entry.id.clone(),
                    option: option.name,
                },
            );
            continue;
        }
        options.push(option);
    }
    options
}

/// Every link must hang on the frame in each state it has joints in.
fn connected(mechanism: &Mechanism, out: &mut Findings) {
    let at = |l: LinkId| {
        [
            Step::Key("link".to_owned()),
            Step::Index(l),
            Step::Key("id".to_owned()),
        ]
    };
    for (l, link) in mechanism.links.iter().enumerate() {
        if !mechanism.joints.iter().any(|j| j.links.contains(&l)) {
            out.add(
                &at(l),
                ProblemKind::Unused {
                    link: link.id.clone(),
                },
            );
        }
    }
    for (s, state) in mechanism.states.iter().enumerate() {
        let mut reached = vec![mechanism.frame()];
        let mut next = 0;
        let joints: Vec<JointId> = mechanism.joints_in(s).collect();
        while let Some(&l) = reached.get(next) {
            next += 1;
            for &j in &joints {
                let [a, b] = mechanism.joints[j].links;
                for (from, to) in [(a, b), (b, a)] {
                    if from == l && !reached.contains(&to) {
                        reached.push(to);
                    }
                }
            }
        }
        for (l, link) in mechanism
            .links
            .iter()
            .enumerate()
            .filter(|(l, _)| !reached.contains(l))
        {
            let here = joints
                .iter()
                .any(|&j| mechanism.joints[j].links.contains(&l));
            if here || (s == 0 && link.role == Role::Output) {
                out.add(
                    &at(l),
                    ProblemKind::Disconnected {
                        link: link.id.clone(),
                        state: state.clone(),
                    },
                );
            }
        }
    }
}

fn joint_by_id(
    mechanism: &Mechanism,
    id: &str,
    path: &[Step],
    out: &mut Findings,
) -> Option<JointId> {
    let found = mechanism.joint(id);
    if found.is_none() {
        let known = mechanism
            .joints
            .iter()
            .take(30)
            .map(|j| j.id.as_str())
            .join(", ");
        out.add(
            path,
            ProblemKind::UnknownJoint {
                id: id.to_owned(),
                known,
            },
        );
    }
    found
}

fn contours(file: &MechanismFile, mechanism: &Mechanism, out: &mut Findings) -> Vec<Vec<JointId>> {
    let mut contours = Vec::new();
    for (i, entry) in file.contour.iter().enumerate() {
        let at = [
            Step::Key("contour".to_owned()),
            Step::Index(i),
            Step::Key("joints".to_owned()),
        ];
        let joints: Vec<JointId> = entry
            .joints
            .iter()
            .enumerate()
            .filter_map(|(n, id)| joint_by_id(mechanism, id, &index(&at, n), out))
            .collect();
        if joints.len() == entry.joints.len() && closed_walk(mechanism, &joints).is_none() {
            out.add(&at, ProblemKind::OpenContour);
        }
        contours.push(joints);
    }
    contours
}

fn search(file: &MechanismFile, mechanism: &Mechanism, out: &mut Findings) -> SearchSpec {
    let at = [Step::Key("search".to_owned())];
    let mut spec = SearchSpec::default();
    for (i, id) in file.search.hold.iter().enumerate() {
        match mechanism.link(id) {
            Some(l) => spec.hold.push(l),
            None => {
                let known = mechanism
                    .links
                    .iter()
                    .take(30)
                    .map(|l| l.id.as_str())
                    .join(", ");
                out.add(
                    &index(&key(&at, "hold"), i),
                    ProblemKind::UnknownLink {
                        id: id.clone(),
                        known,
                    },
                );
            }
        }
    }
    let mut paired = Vec::new();
    for (i, pair) in file.search.mirror.iter().enumerate() {
        let path = index(&key(&at, "mirror"), i);
        let joints = pair
            .iter()
            .filter_map(|id| joint_by_id(mechanism, id, &path, out))
            .collect_vec();
        for &j in &joints {
            if paired.contains(&j) {
                out.add(
                    &path,
                    ProblemKind::RepeatedMirror {
                        joint: mechanism.joints[j].id.clone(),
                    },
                );
            }
            paired.push(j);
        }
        if let [a, b] = joints[..] {
            spec.mirror.push((a, b));
        }
    }
    for (name, &value) in &file.search.costs {
        let path = key(&key(&at, "costs"), name);
        let Some(milli) = cost(value, &path, out) else {
            continue;
        };
        let option_names = || {
            mechanism
                .joints
                .iter()
                .flat_map(|j| j.options.iter().chain(&j.unloading))
                .map(|o| &o.name)
        };
        match name.as_str() {
            "change" => spec.costs.change_milli = Some(milli),
            "link" => spec.costs.link_milli = Some(milli),
            n if JointType::from_name(n).is_some() || option_names().any(|o| o == n) => {
                spec.costs.by_type_milli.push((name.clone(), milli));
            }
            _ => {
                let known = ["change", "link"]
                    .into_iter()
                    .chain(JointType::NAMED.iter().map(JointType::name))
                    .join(", ");
                out.add(
                    &path,
                    ProblemKind::UnknownWord {
                        what: "cost",
                        word: name.clone(),
                        known,
                    },
                );
            }
        }
    }
    spec
}

fn expected(file: &MechanismFile, mechanism: &Mechanism, out: &mut Findings) -> Vec<Expected> {
    let mut list = Vec::new();
    for (i, e) in file.expected.iter().enumerate() {
        let state = e.state.clone().unwrap_or_else(|| "free".to_owned());
        if !mechanism.states.contains(&state) {
            let path = [
                Step::Key("expected".to_owned()),
                Step::Index(i),
                Step::Key("state".to_owned()),
            ];
            let known = mechanism.states.join(", ");
            out.add(
                &path,
                ProblemKind::UnknownWord {
                    what: "state",
                    word: state.clone(),
                    known,
                },
            );
        }
        list.push(Expected {
            state,
            mobility: e.mobility,
            finite_mobility: e.finite_mobility,
            working_mobility: e.working_mobility,
            local_mobility: e.local_mobility,
            redundant: e.redundant,
            external_redundant: e.external_redundant,
            source: e.source.clone(),
        });
    }
    list
}
