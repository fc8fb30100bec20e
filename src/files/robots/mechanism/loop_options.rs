//! Options of the joints that close loops: freedoms in the directions of redundant constraints.

use crate::file::schema::{Coordinate, JointEntry, MechanismFile, OptionEntry, OptionTable};
use crate::rank::rounded::verdict::rank_verdict;
use crate::redundancy::release::Release;
use crate::redundancy::stressed::Stressed;
use crate::robots::prelude::*;

/// Maximum work of singular values, rows · columns · the lesser of them, for which options are sought.
const LARGEST: usize = 2_000_000_000;

/// Gives the joints that close loops their own options: more freedom along each direction of their self-stresses, and along all
/// of them. Returns true if there are any.
pub(crate) fn at_loops(m: &Mechanism, closes: &[bool], file: &mut MechanismFile) -> bool {
    if !closes.contains(&true) {
        return false;
    }
    let Ok(found) = rank_verdict(m, StateId::FREE) else {
        return false;
    };
    let rank = found.at_least();
    let work = found.rows * found.freedoms * found.rows.min(found.freedoms);
    if rank == found.rows || work > LARGEST {
        return false;
    }
    let geometry = found.intended_mechanism().unwrap_or(m);
    let Ok(Some(parts)) = Stressed::stressed_parts(geometry, StateId::FREE, rank) else {
        return false;
    };
    let mut any = false;
    let all = parts
        .iter()
        .flat_map(|p| p.joints.iter().map(move |&j| (p, j)));
    for (part, j) in all.filter(|(_, j)| closes[j.index()]) {
        let all = part.releases_at(j);
        let tables = option_tables(m, j, &all);
        any |= !tables.is_empty();
        if !tables.is_empty() {
            let entry: &mut JointEntry = &mut file.joint[j.index()];
            // Options include the original joint. All words do so if it is rigid, and none if it is a ball.
            let rigid = m.joints[j].joint_type == JointType::Fixed;
            let words = file.search.options.iter().filter(|_| rigid).cloned();
            entry.options = Some(words.chain(tables).collect());
        }
    }
    any
}

fn option_tables(m: &Mechanism, joint: JointId, all: &[Release]) -> Vec<OptionEntry> {
    let kind = &m.joints[joint].joint_type;
    if !matches!(kind, JointType::Spherical | JointType::Fixed) {
        return Vec::new();
    }
    let single = |r: &Release| match *r {
        Release::Freedom {
            slides, direction, ..
        } => Some((slides, direction)),
        Release::Coupling(_) => None,
    };
    let all: Vec<(bool, Vector)> = all.iter().filter_map(single).collect();
    let mut out: Vec<OptionEntry> = all.iter().map(|one| option_table(kind, &[*one])).collect();
    if all.len() > 1 {
        out.push(option_table(kind, &all));
    }
    out
}

/// Returns the option of a joint with more freedoms, about and along perpendicular axes.
fn option_table(kind: &JointType, more: &[(bool, Vector)]) -> OptionEntry {
    let z = more[0].1;
    let square = |d: &Vector| dot(*d, z).abs() < 0.5;
    let x = more.iter().map(|m| m.1).find(square);
    let y = x.map(|x| cross(z, x));
    let letter = |d: Vector| match (x, y) {
        (Some(x), _) if dot(d, x).abs() > 0.5 => 'x',
        (_, Some(y)) if dot(d, y).abs() > 0.5 => 'y',
        _ => 'z',
    };
    let freedoms = kind.freedoms().iter().map(|f| f.name().to_owned());
    let mut freedoms: Vec<String> = freedoms.collect();
    let mut names = Vec::new();
    for &(slides, d) in more {
        freedoms.push(format!("{}{}", if slides { 't' } else { 'r' }, letter(d)));
        let word = if slides { "slide" } else { "turn" };
        names.push(format!("{word} {}", direction_name(d)));
    }
    let written = |d: Vector| Some(d.map(Coordinate::Decimal));
    let now = match kind {
        JointType::Fixed => String::new(),
        t => format!("{} + ", t.name()),
    };
    // With one more freedom it has a separate name.
    let named = match (kind, more) {
        (JointType::Spherical, [(true, _)]) => Some(JointType::SphereInCylinder),
        (JointType::Fixed, [(true, _)]) => Some(JointType::Prismatic),
        (JointType::Fixed, [(false, _)]) => Some(JointType::Revolute),
        _ => None,
    };
    OptionEntry::Table(Box::new(OptionTable {
        freedoms: named.is_none().then_some(freedoms),
        kind: named.map(|t| t.name().to_owned()),
        axis: written(z),
        reference: x.and_then(written),
        name: Some(format!("{now}{}", names.join(" + "))),
        ..OptionTable::default()
    }))
}

/// Returns the name of a direction: "y", or "(0.60 0.80 0.00)".
fn direction_name(d: Vector) -> String {
    let along = (0..3).find(|&i| d[i].abs() > 1.0 - 1e-9);
    match along {
        Some(i) => ["x", "y", "z"][i].to_owned(),
        None => format!("({})", d.map(|x| format!("{x:.2}")).join(" ")),
    }
}
