//! Summary of a mechanism file in a few lines, without any analysis.

use crate::view::analysis::mobility::StructureSize;
use crate::view::prelude::*;

/// Names shown of a list.
const SHOWN: usize = 12;

/// Returns the links, joints, states, options and workload of a mechanism, a line each.
///
/// # Examples
/// ```
/// use ozols::view::analysis::mechanism::describe_mechanism;
/// let four_bar = ozols::built_in("four-bar")?;
/// let lines = describe_mechanism(&four_bar);
/// assert!(lines[0].contains("4 links") && lines[0].contains("150 mm"));
/// # Ok::<(), ozols::Error>(())
/// ```
pub fn describe_mechanism(m: &Mechanism) -> Vec<String> {
    let mut out = vec![
        describe_links(m),
        describe_joints(m),
        describe_states(m),
        describe_search(m),
    ];
    out.extend(describe_workload(m));
    out
}

fn describe_links(m: &Mechanism) -> String {
    let of = |role| {
        let with = m.links.iter().filter(move |l| l.role == role);
        with.map(|l| l.id.as_str()).collect_vec()
    };
    let mut roles = vec![m.frame_words()];
    for (role, word) in [(Role::Output, "output"), (Role::Object, "object")] {
        let with = of(role);
        if !with.is_empty() {
            let s = if with.len() == 1 { "" } else { "s" };
            roles.push(format!("{word}{s} {}", first_of(&with, SHOWN)));
        }
    }
    let mode = match m.mode {
        Mode::Spatial => "in space",
        Mode::Planar { .. } => "in the plane",
    };
    format!(
        "{} ({}), {mode}; joints {} {} across",
        count_noun(m.links.len(), "link"),
        roles.join("; "),
        four_digits(m.distance_across()),
        m.length_unit.symbol
    )
}

fn describe_joints(m: &Mechanism) -> String {
    let types = m.joints.iter().map(|j| j.joint_type.name()).counts();
    let types = types
        .into_iter()
        .sorted_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(b.0)))
        .map(|(name, n)| format!("{n} {name}"));
    let drives = m.joints.iter().filter(|j| j.drive);
    let drives = drives.map(|j| &j.id).collect_vec();
    let drives = match drives[..] {
        [] => "no drive".to_owned(),
        _ => format!("driven at {}", first_of(&drives, SHOWN)),
    };
    format!(
        "{}: {}; {drives}",
        count_noun(m.joints.len(), "joint"),
        types.format(", ")
    )
}

fn describe_states(m: &Mechanism) -> String {
    let one = |s: StateId| {
        let k = usize::try_from(StructureSize::of_state(m, s).contours).unwrap_or(0);
        format!("{} with {}", m.states[s], count_noun(k, "contour"))
    };
    let states = m.state_ids().map(one).join(", ");
    format!("{}: {states}", count_noun(m.states.len(), "state"))
}

fn describe_search(m: &Mechanism) -> String {
    let options = m
        .joints_in(StateId::FREE)
        .map(|j| m.joints[j].options.len());
    let options = options.collect_vec();
    let open = options.iter().copied().filter(|n| *n > 1).collect_vec();
    let places = m.joints.iter().filter(|j| !j.unloading.is_empty()).count();
    if open.is_empty() && places == 0 {
        return "search: nothing to choose: no joint has an option with more freedoms than its own type; list some under [search]"
            .to_owned();
    }
    let variants: BigUint = options.into_iter().map(BigUint::from).product();
    let mut parts = vec![match open.iter().minmax().into_option() {
        None => "no joint to change".to_owned(),
        Some((a, b)) => format!(
            "{} with {} options",
            count_noun(open.len(), "joint"),
            format_span(a, b)
        ),
    }];
    if places > 0 {
        parts.push(count_noun(places, "place") + " for an unloading joint");
    }
    if !m.search.mirror.is_empty() {
        parts.push(count_noun(m.search.mirror.len(), "mirror pair"));
    }
    if let Some(group) = m.search.turn.first() {
        let what = match group.len() {
            2 => "half-turn pair",
            _ => "third-turn group",
        };
        parts.push(count_noun(m.search.turn.len(), what));
    }
    let joints = group_thousands(&variants);
    format!("search: {}; {joints} choices of joints", parts.join(", "))
}

fn describe_workload(m: &Mechanism) -> Option<String> {
    let loads = &m.loads;
    let masses = m.links.iter().filter(|l| l.mass.is_some()).count();
    let mut parts = Vec::new();
    if loads.gravity.is_some() {
        parts.push("gravity".to_owned());
    }
    if masses > 0 {
        parts.push(count_noun(masses, "link") + " with mass");
    }
    let counted = [
        (loads.forces.len(), "force"),
        (loads.moments.len(), "moment"),
        (loads.stiffness.len(), "stiffness table"),
        (loads.misalignments.len(), "misalignment"),
    ];
    let counted = counted.into_iter().filter(|(n, _)| *n > 0);
    parts.extend(counted.map(|(n, noun)| count_noun(n, noun)));
    if loads.drive_speeds.iter().any(|v| *v != 0.0) {
        parts.push("drive speed".to_owned());
    }
    if let Some(stroke) = &loads.stroke {
        parts.push(format!("a stroke of {}", count_noun(stroke.steps, "step")));
    }
    if let Some(ranking) = &m.ranking {
        let terms = ranking.terms.iter().map(|(t, _)| t.name());
        parts.push(format!("ranking by {}", terms.format(", ")));
    }
    (!parts.is_empty()).then(|| format!("workload: {}", parts.join(", ")))
}
