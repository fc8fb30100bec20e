//! Which closure of a loop holds nothing twice.

use super::{again, taken};
use ozols::robots::convert::{
    Converted, JudgedLoop, LoopClosure, Motions, Target, Wanted, convert, figures,
};
use std::collections::BTreeMap;

/// A four-bar in the plane of x and y, its pin as MuJoCo closes loops.
pub(crate) fn four_bar(equality: &str) -> String {
    let inertia = "<inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>";
    format!(
        "<mujoco><compiler angle='radian'/><worldbody>
          <body name='crank'><joint name='a'/>{inertia}<body name='rod' pos='0 1 0'><joint name='b'/>{inertia}</body></body>
          <body name='rocker' pos='2 0 0'><joint name='c'/>{inertia}</body>
        </worldbody><equality>{equality}</equality></mujoco>"
    )
}

const PIN: &str = "<connect name='pin' body1='rod' body2='rocker' anchor='2 0.5 0'/>";

fn asked(text: &str, wanted: &Wanted) -> Converted {
    let c = convert(&taken("m.xml", text), Target::Mjcf, wanted);
    c.unwrap_or_else(|e| panic!("{e}"))
}

fn auto() -> Wanted {
    Wanted {
        all: Some(None),
        each: Vec::new(),
    }
}

/// W, σ and motion by closure.
fn table(j: &JudgedLoop) -> BTreeMap<&'static str, (usize, usize, Motions)> {
    let row = |o: &ozols::robots::convert::Judgement| {
        (o.closure.word(), (o.figures.0, o.figures.1, o.motion))
    };
    j.options.iter().map(row).collect()
}

// By hand: three hinges in the plane and a point have W = 1, σ = 1; six constraints less what each closure lets go, of which the
// plane needs two.
#[test]
fn a_planar_loop_wants_a_point_on_a_line() {
    let c = asked(&four_bar(PIN), &auto());
    let [pin] = &c.closures[..] else {
        panic!("{:?}", c.closures)
    };
    let same = Motions::Same;
    let wanted = BTreeMap::from([
        ("as-given", (1, 1, same)),
        ("connect", (1, 1, same)),
        ("line", (1, 0, same)),
        ("hinge", (1, 3, same)),
        ("cylinder", (1, 2, same)),
        ("universal", (1, 2, same)),
        ("two-points", (1, 4, same)),
    ]);
    let mut found = table(pin);
    // A weld holds the four-bar still: two of its six hold what hinges do not, and one more.
    assert_eq!(found.remove("weld"), Some((0, 3, Motions::Less)));
    assert_eq!(found, wanted);
    assert_eq!(pin.options[pin.chosen].closure, LoopClosure::Line);
    assert_eq!(c.figures, Some((1, 0)));
    assert_eq!(figures(&again(&c).mechanism), Some((1, 0)));
}

// What users of Pinocchio and MuJoCo ask: in space a point is loose and a weld locks. Seven hinges in a ring, the last of which
// is the closure: a hinge is right (W = 1), a point leaves three, a weld none.
#[test]
fn in_space_a_point_is_loose_and_a_weld_locks() {
    let axes = [
        "0 0 1", "1 0 0.2", "0 1 0.3", "0.4 0 1", "1 0.5 0", "0 1 -0.6",
    ];
    let mut text = String::new();
    for (n, axis) in axes.iter().enumerate() {
        let at = [0.3, 0.5, 0.2, 0.7, 0.4, 0.6][n];
        text += &format!(
            "<body name='l{n}' pos='{at} 0.{n} 0.2'><joint name='j{n}' axis='{axis}'/><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>"
        );
    }
    let text = format!(
        "<mujoco><compiler angle='radian'/><worldbody>{text}{}</worldbody><equality><weld name='end' body1='l5'/></equality></mujoco>",
        "</body>".repeat(6)
    );
    let c = asked(&text, &auto());
    let found = table(&c.closures[0]);
    assert_eq!(found["weld"], (0, 0, Motions::Same));
    assert_eq!(found["connect"], (3, 0, Motions::Other));
    assert_eq!((found["hinge"].0, found["hinge"].1), (1, 0));
    assert_eq!((found["two-points"].0, found["two-points"].1), (1, 1));
    assert_eq!(
        (found["universal"].0, found["cylinder"].0, found["line"].0),
        (2, 2, 4)
    );
    // As given it holds nothing twice: it stays.
    assert_eq!(c.closures[0].chosen, 0);
    assert_eq!(c.figures, Some((0, 0)));
}

#[test]
fn closures_are_taken_as_asked() {
    for (closure, figures_wanted) in [
        (LoopClosure::Connect, (1, 1)),
        (LoopClosure::Hinge, (1, 3)),
        (LoopClosure::TwoPoints, (1, 4)),
        (LoopClosure::Universal, (1, 2)),
        (LoopClosure::Cylinder, (1, 2)),
        (LoopClosure::Line, (1, 0)),
        (LoopClosure::Weld, (0, 3)),
        (LoopClosure::AsGiven, (1, 1)),
    ] {
        let each = vec![("pin".to_owned(), Some(closure))];
        let wanted = Wanted { all: None, each };
        let i = taken("m.xml", &four_bar(PIN));
        for (word, target, _) in Target::ALL {
            let c = convert(&i, target, &wanted).unwrap_or_else(|e| panic!("{e}"));
            let (w, sigma) = figures_wanted;
            assert_eq!(c.figures, Some((w, sigma)), "{closure:?}");
            let found = figures(&again(&c).mechanism);
            assert_eq!(
                found,
                Some((w, sigma + c.repeated)),
                "{closure:?} -> {word}\n{}",
                c.text
            );
        }
    }
}

// Two loops, each judged with the other as it is by then.
#[test]
fn every_loop_gets_its_own() {
    let i = super::read("gripper.xml", None);
    let c = convert(&i, Target::Mjcf, &auto()).unwrap_or_else(|e| panic!("{e}"));
    let taken: Vec<LoopClosure> = c
        .closures
        .iter()
        .map(|j| j.options[j.chosen].closure)
        .collect();
    assert_eq!(
        (c.figures, taken),
        (Some((1, 0)), vec![LoopClosure::Line; 2])
    );
    let c = convert(
        &i,
        Target::Mjcf,
        &Wanted {
            all: Some(None),
            each: vec![("connect-1".to_owned(), Some(LoopClosure::AsGiven))],
        },
    );
    let c = c.unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(c.figures, Some((1, 1)));
}
