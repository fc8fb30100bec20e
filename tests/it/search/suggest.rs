//! Single changes, against building each and analysing it.

use crate::common::*;
use ozols::model::mechanism::Link;
use ozols::search::answer::single_changes::{USUAL, USUAL_UNLOADING, single_changes};

/// The mechanism with one change made: the joint replaced, or a pad between it and its first link, or both.
fn changed(
    m: &Mechanism,
    j: JointId,
    to: Option<&JointOption>,
    pad: Option<&JointOption>,
) -> Mechanism {
    let mut out = m.clone();
    let mut parts = out.edit();
    parts.contours.clear();
    if let Some(o) = to {
        parts.joints[j].joint_type = o.joint_type.clone();
        parts.joints[j].frame = o.frame.clone();
    }
    if let Some(u) = pad {
        let link = LinkId::new(parts.links.len());
        parts.links.push(Link {
            id: "pad".to_owned(),
            role: Role::Inner,
            mass: None,
        });
        let mut series = parts.joints[j].clone();
        series.id = "series".to_owned();
        series.drive = false;
        series.joint_type = u.joint_type.clone();
        series.frame = u.frame.clone();
        series.links[1] = link;
        parts.joints[j].links[0] = link;
        parts.joints.push(series);
    }
    drop(parts);
    out
}

type Line = (String, Option<String>, Option<String>, usize);

/// Every change that removes as much as it frees, the slow way.
fn slowly(m: &Mechanism, state: StateId) -> Vec<Line> {
    let before = analysed_in(m, state);
    let free: Vec<JointId> = m.joints_in(StateId::FREE).collect();
    let joints: Vec<JointId> = m
        .joints_in(state)
        .filter(|j| state == StateId::FREE || !free.contains(j))
        .collect();
    let plain = |j: JointId, t: &JointType| JointOption {
        name: t.name().to_owned(),
        joint_type: t.clone(),
        frame: m.joints[j].frame.clone(),
        cost_milli: None,
        state: None,
    };
    let offered = joints
        .iter()
        .any(|&j| m.joints[j].options.len() > 1 || !m.joints[j].unloading.is_empty());
    let mut found = Vec::new();
    for j in joints {
        let joint = &m.joints[j];
        let (mut options, mut pads) = (joint.options[1..].to_vec(), joint.unloading.clone());
        pads.retain(|p| p.state.is_none_or(|s| s == state));
        if !offered && state != StateId::FREE {
            pads = vec![plain(j, &USUAL_UNLOADING)];
        } else if !offered && !joint.drive && joint.joint_type != JointType::Fixed {
            let own = joint.joint_type.freedoms();
            let others = USUAL.iter().filter(|t| {
                **t != joint.joint_type && own.iter().all(|f| t.freedoms().contains(f))
            });
            options = others.map(|t| plain(j, t)).collect();
        }
        let kept = |list: &[JointOption]| -> Vec<Option<JointOption>> {
            std::iter::once(None)
                .chain(list.iter().cloned().map(Some))
                .collect()
        };
        for to in kept(&options) {
            for pad in kept(&pads) {
                let after = analysed_in(&changed(m, j, to.as_ref(), pad.as_ref()), state);
                let same = (after.mobility, after.working_mobility, after.local_mobility)
                    == (
                        before.mobility,
                        before.working_mobility,
                        before.local_mobility,
                    );
                if same && after.redundant < before.redundant {
                    found.push((
                        joint.id.clone(),
                        to.as_ref().map(|o| o.name.clone()),
                        pad.as_ref().map(|o| o.name.clone()),
                        before.redundant - after.redundant,
                    ));
                }
            }
        }
    }
    found.sort();
    found
}

fn quickly(m: &Mechanism, state: StateId) -> Vec<Line> {
    let s = single_changes(m, state).unwrap();
    let keys = s
        .list
        .iter()
        .map(|x| (std::cmp::Reverse(x.removes), x.cost_milli));
    assert!(keys.is_sorted());
    let line = |x: &ozols::search::answer::single_changes::Suggestion| {
        (
            m.joints[x.joint].id.clone(),
            x.to.as_ref().map(|o| o.name.clone()),
            x.unloading.as_ref().map(|o| o.name.clone()),
            x.removes,
        )
    };
    let mut found: Vec<Line> = s.list.iter().map(line).collect();
    found.sort();
    found
}

#[test]
fn single_changes_are_those_of_the_slow_way() {
    let (mut with, mut usual) = (0, 0);
    for name in split_words(
"gripper-10 gripper-10-planar four-bar bennett lever-gripper parallelogram-3-rods sarrus door-two-hinges
            double-banana tongs",
) {
        let m = built_in(name);
        for state in m.state_ids() {
            let quick = quickly(&m, state);
            assert_eq!(quick, slowly(&m, state), "{name}, state {state:?}");
            with += usize::from(!quick.is_empty());
            usual += usize::from(single_changes(&m, state).unwrap().usual);
        }
    }
    assert!(with > 8 && usual > 0, "{with} {usual}");
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 24, ..Default::default() })]

    #[test]
    fn single_changes_of_random_mechanisms(text in crate::search::twin::random()) {
        let m = read(&text);
        for state in m.state_ids() {
            prop_assert_eq!(quickly(&m, state), slowly(&m, state));
        }
    }
}

// A slot at any hinge of a plane mechanism only lets it loose.
#[test]
fn where_no_single_change_helps_none_is_named() {
    let types = "\"cylindrical\", \"universal\", \"spherical\"";
    let text = replace_once(&run_quiet("show four-bar"), types, "\"slotted\"");
    let s = &json_on("analyze", "slots.toml", &text, "")["states"][0]["suggestions"];
    assert_eq!((&s["found"], &s["tried"]), (&json!(0), &json!(3)));
}
