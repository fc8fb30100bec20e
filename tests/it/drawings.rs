//! Drawings: labels that touch nothing, well-formed SVG, the same bytes each time.

use crate::common::*;
mod idle;
mod interest;
mod loads;
mod meaning;
mod meeting;
mod moving;
mod places;
mod png;
mod random;
mod reading;
mod space;

use self::reading::{collisions, misread, outside, texts};
use ozols::draw::{Marks, Subject, scheme};

/// A mechanism in its free state, to be drawn as it is.
fn subject(mechanism: &Mechanism) -> Subject<'_> {
    Subject {
        mechanism,
        state: StateId::FREE,
        analysis: None,
        marks: None,
    }
}

#[test]
fn every_built_in_is_drawn_right() {
    let mut wrong = Vec::new();
    let mut drawn = 0;
    for name in builtin::names() {
        let m = built_in(name);
        let states: Vec<StateId> = m.state_ids().collect();
        let found = analyse_states(&m, &states, Method::Modular).unwrap();
        for (state, analysis) in m.state_ids().zip(&found) {
            let subject = Subject {
                mechanism: &m,
                state,
                analysis: Some(analysis),
                marks: None,
            };
            for (kind, d) in [
                ("scheme", scheme(&subject)),
                ("kinematic", kinematic(&subject)),
            ] {
                drawn += 1;
                let state = &m.states[state];
                let state = m.state_named(state).unwrap();
                let joints = m.joints_in(state).count();
                assert!(
                    d.symbols.len() >= joints,
                    "{name}: each joint has its symbol"
                );
                let mut all = collisions(&d);
                all.extend(outside(&d));
                if kind == "scheme" {
                    all.extend(misread(&d, &m, state, analysis));
                }
                for c in all {
                    wrong.push(format!("{name} {state:?} {kind}: {c}"));
                }
            }
        }
    }
    assert!(drawn >= 212, "{drawn}");
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn the_scheme_says_what_the_field_says() {
    let m = built_in("gripper-10");
    let found = analyse_states(&m, &[StateId::FREE, StateId::new(1)], Method::Modular).unwrap();
    let subject = |state: StateId| Subject {
        mechanism: &m,
        state,
        analysis: Some(&found[state]),
        marks: None,
    };
    let free = scheme(&subject(StateId::FREE));
    let says = |d: &Drawing, text: &str| d.labels.iter().any(|l| l.text == text);
    // [Pogrebnyak 2018]: shares 2, 3, 3, 3; twelve hinges of class V and the driving pair of class IV
    for row in [
        "0-1-2-3, σ = 2 (2 to 3)",
        "0-1-6-7, σ = 3 (2 to 3)",
        "1-2-4-5, σ = 3",
        "1-6-8-9, σ = 3",
        "driving pair",
        "frame 0",
        "n = 10, p = 13, k = 4, f = 14, W = 1, σ = 11",
    ] {
        assert!(says(&free, row), "{row}: {:?}", free.labels);
    }
    let count = |d: &Drawing, text: &str| d.labels.iter().filter(|l| l.text == text).count();
    // and one in the legend
    assert_eq!((count(&free, "V"), count(&free, "IV")), (12 + 1, 1));
    assert_eq!(free.symbols.len(), 13);
    // the driving pair's symbol is the larger one
    let large = free.symbols.iter().filter(|s| s.right - s.left > 25.0);
    assert_eq!(large.count(), 1);
    assert_eq!(count(&free, "a"), 0, "the clamped part is not there");
    let clamped = scheme(&subject(StateId::new(1)));
    assert_eq!((count(&clamped, "VI"), count(&clamped, "a")), (2, 1));
    assert!(says(&clamped, "in state clamped only"));
    assert!(clamped.svg.contains("joint dash"));
}

#[test]
fn variants_are_marked() {
    let m = built_in("gripper-10");
    let request = Conditions {
        state: Some(InState {
            max_external: Some(2),
            ..InState::holding(StateId::new(1))
        }),
        ..Conditions::default()
    };
    let (search, diagrams) = searched(&m, request);
    let first = search.cheapest_variants(&diagrams, 1).next();
    let (realized, marks) = Marks::of_variant(&search, &first.unwrap(), "variant 1");
    assert_eq!(marks.links, 11);
    assert!(
        realized.links.len() > 11,
        "an unloading joint has a link of its own"
    );
    let changed: Vec<String> = marks.changed.iter().map(|(_, w)| w.clone()).collect();
    let subject = Subject {
        mechanism: &realized,
        state: StateId::new(1),
        analysis: None,
        marks: Some(marks),
    };
    for d in [scheme(&subject), kinematic(&subject)] {
        assert_eq!(collisions(&d), [""; 0]);
        for words in &changed {
            assert!(d.labels.iter().any(|l| l.text == *words), "{words}");
        }
        assert!(d.labels.iter().any(|l| l.text == "link a-8 pad: added"));
        assert!(d.svg.contains(" changed\"") && d.svg.contains(" new\""));
    }
}

#[test]
fn a_plane_is_seen_face_on() {
    for (across, up, name) in [
        ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], "seen along z"),
        ([2.0, 1.0, 2.0], [-2.0, 2.0, 1.0], "seen face-on"),
        ([3.0, 4.0, 0.0], [0.0, 0.0, 5.0], "seen face-on"),
        ([1.0, 2.0, 2.0], [2.0, 1.0, -2.0], "seen face-on"),
    ] {
        let corners = [[0.0, 0.0], [0.0, 2.0], [5.0, 4.0], [6.0, 0.0]];
        let m = four_bar_in_plane([across, up], [7.0; 3], corners, false);
        let d = kinematic(&subject(&m));
        assert!(
            d.svg.contains(&format!("Kinematic scheme {name}")),
            "{across:?} {up:?}"
        );
        // true lengths, to one scale: 0-1, 1-2, 2-3, 3-0 are the last of the symbols
        let at: Vec<[f64; 2]> = d.symbols.iter().rev().take(4).map(Rect::middle).collect();
        let far = |i: usize, j: usize| (at[i][0] - at[j][0]).hypot(at[i][1] - at[j][1]);
        let [e, c, b, a] = [0, 1, 2, 3];
        let scale = far(a, b) / 2.0;
        for (i, j, true_length) in [(b, c, 29f64.sqrt()), (c, e, 17f64.sqrt()), (e, a, 6.0)] {
            let error = far(i, j) / scale - true_length;
            assert!(error.abs() < 0.02, "{across:?} {up:?} {i}-{j}: {error}");
        }
    }
}

#[test]
fn the_same_bytes_each_time() {
    for name in ["gripper-10", "double-banana", "stewart-gough", "y-star"] {
        let m = built_in(name);
        let subject = subject(&m);
        assert_eq!(scheme(&subject).svg, scheme(&subject).svg);
        assert_eq!(kinematic(&subject).svg, kinematic(&subject).svg);
    }
}

#[test]
fn command_line() {
    let svg = run_quiet("draw gripper-10 --kind scheme");
    assert!(svg.starts_with("<svg "), "{svg}");
    assert!(svg.contains("Structural scheme, state free"));
    let svg = run_quiet("draw gripper-10 --state clamped");
    assert!(svg.contains("Kinematic scheme seen along z, state clamped"));
    for asked in [
        "gripper-10 --state clamped --max-external 2",
        "gripper-10-loaded --pool 20",
        "gripper-10 --options revolute,spherical --max-redundant 2",
    ] {
        let list = run_json(&format!("search {asked} --top 3 --format json"));
        let svg = run_quiet(&format!("draw {asked} --variant 3"));
        let changes = list["variants"][2]["changes"].list();
        let said = texts(&svg);
        assert_eq!(
            changes.len(),
            said.iter().filter(|(t, _)| t.contains(" → ")).count()
        );
        for c in changes {
            let (joint, to) = (c["joint"].word(), c["to"].word());
            let says = |t: &str| t.starts_with(&format!("{joint}: ")) && t.ends_with(to);
            assert!(said.iter().any(|(t, _)| says(t)), "{asked} {joint} {to}");
        }
        if asked.contains("clamped") {
            assert!(
                said.iter().any(|(t, _)| t == "link a-8 pad: added"),
                "{said:?}"
            );
        }
    }
    assert_all_fail(
        "
        draw gripper-10 --state folded | it has: free, clamped
        draw gripper-10 --variant 0 | numbered from 1
        draw slider-crank-determinate --variant 99999999 | no variant
        ",
    );
}
