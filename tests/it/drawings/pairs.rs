//! Joint types by themselves: their symbols in two views, with their freedoms at the axes of their frames.

use super::reading::{collisions, outside};
use crate::common::*;
use ozols::draw::joint_type;

#[test]
fn names_are_on_nothing() {
    for t in JointType::NAMED {
        let d = joint_type(&t);
        let mut wrong = collisions(&d);
        wrong.extend(outside(&d));
        assert_eq!(wrong, [""; 0], "{t}");
    }
}

#[test]
fn each_freedom_stands_at_its_axis_in_both_views() {
    for t in JointType::NAMED {
        let d = joint_type(&t);
        for f in t.freedoms() {
            let at_axis = |text: &str| {
                let named = text.split_once(": ");
                named.is_some_and(|(_, own)| own.split(' ').any(|n| n == f.name()))
            };
            let axes = ["x: ", "y: ", "z: "];
            let texts = d.labels.iter().map(|l| l.text.as_str());
            let there = texts.filter(|l| axes.iter().any(|a| l.starts_with(a)) && at_axis(l));
            assert_eq!(there.count(), 2, "{t}: {}", f.name());
        }
    }
    let custom = joint_type(&JointType::Custom(vec![Freedom::Rx, Freedom::Tz]));
    for text in ["x: rx", "y", "z: tz"] {
        let there = custom.labels.iter().filter(|l| l.text == text);
        assert_eq!(there.count(), 2, "{text}");
    }
}
