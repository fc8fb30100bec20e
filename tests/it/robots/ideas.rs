//! Robots: releases as one would build them, one cylindrical joint and one ball a loop, away from what bears a wheel.

use crate::common::*;
use crate::robots::mjcf::mjcf;

/// The releases of the cheapest idea: joint, and whether it slides.
fn idea(name: &str, text: &str) -> Vec<(String, bool)> {
    let (_, file) = crate::robots::lint::linted(name, text);
    let all = file["cheapest"].list().iter();
    all.map(|r| {
        let words = r.word().strip_prefix("let ").unwrap();
        let (joint, rest) = words.split_once(' ').unwrap();
        (joint.to_owned(), rest.starts_with("slide"))
    })
    .collect()
}

// Four hinges hold three things twice: a pin that slides, and another that is a ball.
#[test]
fn a_loop_of_hinges_gets_one_cylinder_and_one_ball() {
    let text = mjcf(
        "<worldbody><body name='a'><joint name='j1'/><body name='b' pos='0 1 0'><joint name='j2'/></body></body>
        <body name='c' pos='2 0 0'><joint name='j3'/><body name='d' pos='0 1.5 0'><joint name='j4'/></body></body></worldbody>
        <equality><weld name='e' body1='d' body2='b'/></equality>",
    );
    let found = idea("m.xml", &text);
    assert_eq!(found.len(), 3, "{found:?}");
    let (slides, turns): (Vec<_>, Vec<_>) = found.iter().partition(|(_, slides)| *slides);
    assert_eq!((slides.len(), turns.len()), (1, 2), "{found:?}");
    assert!(turns.iter().map(|t| &t.0).all_equal(), "{found:?}");
    assert_ne!(slides[0].0, turns[0].0, "{found:?}");
}

// A connect on the axis of a hinge holds nothing of its own; two of its rows were let slide, as the cheapest.
#[test]
fn no_ball_gets_a_second_slide_where_a_hinge_can_turn() {
    let text = mjcf(
        "<worldbody><body name='a'><joint name='j'/><body name='hand' pos='1 0 0'><joint name='k'/></body></body></worldbody>
        <equality><connect name='e' body1='a' anchor='0 0 1'/></equality>",
    );
    let found = idea("m.xml", &text);
    assert_eq!(found.len(), 3, "{found:?}");
    let at_e = found.iter().filter(|(j, _)| j == "e").count();
    assert!(at_e < 2, "{found:?}");
}

// The rear axle of a car, two wheels and a differential between them: the wheels' bearings were let tilt.
#[test]
fn wheels_do_not_tilt() {
    let hinge = |name: &str, ends: [&str; 2], axis: &str| {
        let [parent, child] = ends;
        format!(
            "<joint name='{name}' type='revolute'><parent>{parent}</parent><child>{child}</child><axis><xyz>{axis}</xyz></axis></joint>"
        )
    };
    let text = format!(
        "<sdf version='1.9'><model name='m'><link name='chassis'/>
        <link name='left_wheel'><pose>0 0.5 0 0 0 0</pose></link><link name='right_wheel'><pose>0 -0.5 0 0 0 0</pose></link>
        <joint name='held' type='fixed'><parent>world</parent><child>chassis</child></joint>{}{}{}</model></sdf>",
        hinge("left", ["chassis", "left_wheel"], "0 1 0.05"),
        hinge("right", ["chassis", "right_wheel"], "0 1 -0.05"),
        hinge("differential", ["left_wheel", "right_wheel"], "0 1 0")
    );
    let found = idea("m.sdf", &text);
    assert_eq!(found.len(), 3, "{found:?}");
    let tilts = |(joint, slides): &(String, bool)| joint != "differential" && !slides;
    assert!(!found.iter().any(tilts), "{found:?}");
}
