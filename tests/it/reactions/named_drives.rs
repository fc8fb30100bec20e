//! Drives that name their freedom: what is held is what the file says, in every state.

use crate::common::*;

/// The gripper's slider, which slides along its guide and may turn about it.
fn gripper(drive: &str) -> String {
    let text = builtin::text("gripper-10").unwrap();
    replace_once(text, "drive = \"tz\"", &format!("drive = {drive}"))
}

fn held(m: &Mechanism, state: StateId) -> Vec<Freedom> {
    let drives = driven_freedoms(m, state);
    drives.into_iter().map(|(_, f)| f).collect()
}

#[test]
fn the_freedom_named_is_held_in_every_state() {
    for (word, freedom) in [("\"tz\"", Freedom::Tz), ("\"rz\"", Freedom::Rz)] {
        let m = read(&gripper(word));
        assert!(m.states.len() > 1);
        for state in 0..m.states.len() {
            assert_eq!(held(&m, StateId::new(state)), [freedom], "{word} {state}");
        }
    }
}

#[test]
fn a_freedom_that_the_joint_has_not_is_refused() {
    for word in ["\"ty\"", "\"sideways\""] {
        let (code, _, complaint) = run_on("check", "g.toml", &gripper(word), "");
        assert_eq!(code, Some(2));
        has(&complaint, "freedom to drive");
        has(&complaint, "rz, tz");
    }
}
