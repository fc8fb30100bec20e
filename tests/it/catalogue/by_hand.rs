//! Figures of strokes and places that are put down by hand, and what follows from them.

use super::{Drawn, each_structure, form_of, layout};
use crate::common::*;
use ozols::chains::Symmetry;
use ozols::chains::chain::Joint;
use ozols::synthesis::layout::NoLayout;
use ozols::synthesis::mechanism::mechanism_file;
use ozols::synthesis::places;
use ozols::synthesis::rules::Rules;
use ozols::synthesis::sketch::Sketch;
use ozols::synthesis::sketch::layout_quality::Looks;
use ozols::synthesis::stroke::forces::ForceFigures;
use ozols::synthesis::stroke::judge::{Judge, StrokeFigures};
use ozols::synthesis::structure::Form;
use ozols::synthesis::task::AskedMotion;

/// The slider-crank of four links: driver, jaw, jaw that is hinged in the frame.
fn slider_crank() -> Structure {
    let mut found = Vec::new();
    each_structure(
        4,
        &[form_of(Input::Slide, Symmetry::Generic, false)],
        |_, s| found.push(s),
    );
    assert_eq!(found.len(), 1);
    found.remove(0)
}

fn for_task(task: Task) -> Limits {
    default_with(|l: &mut Limits| l.task = task)
}

/// A stroke that does what is asked of it by default.
fn good() -> StrokeFigures {
    StrokeFigures {
        reached: [0.0, 50.0],
        ends: [None; 2],
        rates: [0.5, 1.0],
        force: 0.5,
        drive: [0.0, 40.0],
        transmission: 60.0,
        straightness: 0.9,
        turn: 11.5,
        size: [100.0, 80.0],
        pin_distance: 15.0,
        on_side: -2.0,
        pulled_out: 1.5,
        reach: 30.0,
        forces: ForceFigures::BEST,
    }
}

fn rules(s: &Structure) -> Rules {
    Rules::new(s, &s.hinged_lay().unwrap()).unwrap()
}

/// What a stroke lacks of a task.
fn lacks(task: Task, stroke: &StrokeFigures) -> Option<String> {
    let s = slider_crank();
    let sketch = Sketch::new(&s, rules(&s), for_task(task));
    let found = sketch
        .limits
        .find_shortfall(stroke, sketch.bones.all_swing());
    found.map(|s| s.to_string())
}

#[test]
fn the_force_ratio_is_the_greatest_rate_over_the_least() {
    assert_eq!(lacks(Task::default(), &good()), None);
    let uneven = StrokeFigures {
        rates: [0.5, 1.75],
        ..good()
    };
    assert_eq!(uneven.force_ratio(), 3.5);
    let said = "the greatest force of a jaw is 3.5 times the least where 3 are allowed";
    assert_eq!(lacks(Task::default(), &uneven).as_deref(), Some(said));
}

#[test]
fn a_force_is_asked_of_each_jaw() {
    let asked = |least_force| {
        let task = default_with(|t: &mut Task| t.least_force = least_force);
        lacks(task, &good())
    };
    assert_eq!([asked(0.0), asked(0.5)], [None, None]);
    assert!(asked(0.6).unwrap().contains("0.500 N for 1 N"));
}

#[test]
fn a_jaw_that_turns_is_not_parallel() {
    let parallel = default_with(|t: &mut Task| t.motion = AskedMotion::Parallel);
    let turned = |turn| lacks(parallel, &StrokeFigures { turn, ..good() });
    assert_eq!(turned(0.9), None);
    assert!(turned(1.1).unwrap().contains("rotates by 1.1°"));
}

/// Each limit of the stroke is kept at its value and broken just beyond it; what is 0 is not asked.
#[test]
fn angle_joint_force_and_efficiency_are_asked_over_the_stroke() {
    let of = |transmission, peak, efficiency| StrokeFigures {
        transmission,
        forces: ForceFigures {
            peak,
            efficiency,
            transmission,
        },
        ..good()
    };
    let says = |task, stroke| lacks(task, &stroke).unwrap_or_default();
    let usual = Task::default();
    assert_eq!(lacks(usual, &of(25.0, 10.0, 0.5)), None);
    assert!(says(usual, of(24.9, 10.0, 0.5)).contains("falls to 24.9° over the stroke where 25°"));
    assert!(
        says(usual, of(25.0, 10.1, 0.5)).contains("bears 10.1 N for 1 N of each jaw where 10 N")
    );
    assert!(says(usual, of(25.0, 10.0, 0.49)).contains("falls to 0.49 over the stroke where 0.5"));
    let free = Task {
        transmission: 0.0,
        pin_force: 0.0,
        efficiency: 0.0,
        ..usual
    };
    assert_eq!(lacks(free, &of(1.0, 500.0, 0.01)), None);
}

#[test]
fn room_is_asked_both_ways() {
    let in_a_room = |room| {
        let task = default_with(|t: &mut Task| t.room = room);
        lacks(task, &good())
    };
    // It takes 100 by 80; nothing is asked where there stands 0.
    assert_eq!(in_a_room([110.0, 90.0]), None);
    assert_eq!(in_a_room([0.0, 90.0]), None);
    for room in [[90.0, 90.0], [110.0, 70.0], [0.0, 70.0]] {
        let said = in_a_room(room).unwrap();
        assert!(said.contains("takes 100 mm by 80 mm"), "{said}");
    }
}

#[test]
fn distances_are_asked_one_by_one() {
    let with = |change: &dyn Fn(&mut Task)| {
        let mut task = Task::default();
        change(&mut task);
        lacks(task, &good())
    };
    let says = |change: &dyn Fn(&mut Task), words: &str| {
        let said = with(change).unwrap();
        assert!(said.contains(words), "{said}");
    };
    assert_eq!(with(&|t| t.pin_distance = 15.0), None);
    says(&|t| t.pin_distance = 16.0, "within 15.0 mm");
    assert_eq!(with(&|t| t.reach = 30.0), None);
    says(&|t| t.reach = 31.0, "drawn 30 mm ahead");
    // Half of what pins are wished apart, or of what is asked.
    says(
        &|t| t.own_sides = true,
        "-2.0 mm on its side of the middle where 7 mm",
    );
    says(&|t| t.pulled_out = 1.4, "1.50 times as long");
    assert_eq!(with(&|t| t.pulled_out = 0.0), None);
}

/// Pins of the slider-crank from the frame round to the frame, then the tips of the jaws in that order.
type Places = [[f64; 2]; 6];

/// Short links first: the driver's pins are 20 apart; the jaws' triangles have but a corner in common, at (50, 10).
const CLEAR: Places = [
    [0.0, 0.0],
    [20.0, 0.0],
    [50.0, 10.0],
    [40.0, 50.0],
    [60.0, -40.0],
    [90.0, 40.0],
];

fn looks(places: Places) -> Looks {
    let s = slider_crank();
    let sketch = Sketch::new(&s, rules(&s), Limits::default());
    let r = &s.structure.roles;
    let next = |&jaw: &&usize| s.structure.chain.is_joined(r.drive_links()[1], *jaw);
    let near = *r.jaws.iter().find(next).unwrap();
    let far = *r.jaws.iter().find(|&&jaw| jaw != near).unwrap();
    let round = [
        (r.frame, r.drive_links()[1]),
        (r.drive_links()[1], near),
        (near, far),
        (far, r.frame),
    ];
    let of_pin = |j: &Joint| {
        let [u, v] = j.links;
        let here = |&(a, b): &(usize, usize)| (u, v) == (a, b) || (v, u) == (a, b);
        places[round.iter().position(here).unwrap()]
    };
    let pins = sketch.rules.joints.iter().map(of_pin);
    let tips = r
        .jaws
        .iter()
        .map(|&jaw| places[if jaw == near { 4 } else { 5 }]);
    let at: Vec<[f64; 2]> = pins.chain(tips).collect();
    Judge::new(&sketch)
        .drawn_figures(&places::Places::of_hinges(at))
        .unwrap()
}

fn with(changes: &[(usize, [f64; 2])]) -> Places {
    let mut out = CLEAR;
    changes.iter().for_each(|&(i, place)| out[i] = place);
    out
}

#[test]
fn the_longest_link_is_told_by_the_shortest() {
    // From (20, 0) to (60, -40), by 20; pins in the frame are as far apart as they like.
    let ratio = looks(CLEAR).ratio;
    assert!((ratio - 8_f64.sqrt()).abs() < 1e-12, "{ratio}");
}

#[test]
fn what_crosses_is_counted_by_hand() {
    // With the tip at (30, -30) the far jaw's side from (50, 10) crosses the near jaw's from (20, 0) to (60, -40), and its side
    // from (40, 50) that and the one from (20, 0) to (50, 10).
    let through = with(&[(5, [30.0, -30.0])]);
    // The near jaw's tip comes near to the line of its own pins, which crosses nothing.
    let splinter = with(&[(4, [35.0, 2.0])]);
    // The drive's pin lies there, which is none of the jaw's.
    let covered = with(&[(0, [35.0, 2.0])]);
    for (places, count) in [(CLEAR, 0), (through, 3), (splinter, 0), (covered, 1)] {
        assert_eq!(looks(places).crossings, count, "{places:?}");
        // Sides that go round the other way.
        let mirrored = places.map(|[x, y]| [x, -y]);
        assert_eq!(looks(mirrored).crossings, count, "{mirrored:?}");
    }
}

/// A jaw that turns swings about a hinge in the frame, if it has one, and floats on other links without.
#[test]
fn jaws_that_swing_have_a_hinge_in_the_frame() {
    let mut told = [0; 2];
    let floating = |name: &str| usize::from(name == "floating");
    let mut n = 0;
    each_structure(
        6,
        &[form_of(Input::Turn, Symmetry::Generic, false)],
        |_, s| {
            n += 1;
            if n % 6 != 0 {
                return;
            }
            let l = layout(&s, &Limits::default(), 1).unwrap();
            let f = layout_figures(&s, &l).unwrap();
            for ((jaw, motion), turn) in s.structure.roles.jaws.iter().zip(&f.jaws).zip(&f.turns) {
                let hinged = s.structure.chain.is_joined(s.structure.roles.frame, *jaw);
                let name = motion.name();
                if *turn > 0.02 {
                    assert_eq!(name, if hinged { "swinging" } else { "floating" });
                    told[floating(name)] += 1;
                }
            }
        },
    );
    assert!(told[0] > 0 && told[1] > 0, "{told:?}");
}

/// The same gripper asked for less than it does has the rest as its margin, up to a fifth of the stroke.
#[test]
fn what_is_not_asked_is_margin() {
    let s = slider_crank();
    let mut laid = None;
    each_structure(4, &[(s.drive_input(), s.form)], |_, s| {
        laid = Some(layout(&s, &Limits::default(), 1).unwrap());
    });
    let mut laid = laid.unwrap().layout;
    let whole = layout_figures(&s, &laid).unwrap();
    assert_eq!(whole.openings, [0.0, 50.0]);
    laid.limits.task = default_with(|t: &mut Task| (t.narrowest, t.widest) = (5.0, 44.0));
    let most = 0.2 * 39.0 + 1e-9;
    let [closing, opening] = layout_figures(&s, &laid).unwrap().margin;
    assert!((5.0..=most).contains(&closing), "{closing}");
    assert!((6.0..=most).contains(&opening), "{opening}");
}

/// Layouts of some structures of six links with a driver that turns.
fn laid(limits: &Limits, every: usize) -> Vec<Result<(Structure, Drawn), NoLayout>> {
    let (mut n, mut out) = (0, Vec::new());
    each_structure(
        6,
        &[form_of(Input::Turn, Symmetry::Generic, false)],
        |_, s| {
            n += 1;
            if n % every == 0 {
                let laid = layout(&s, limits, 1);
                out.push(laid.map(|l| (s, l)));
            }
        },
    );
    out
}

#[test]
fn no_more_crosses_than_may() {
    let limits = default_with(|l: &mut Limits| l.crossings = 0);
    let found = laid(&limits, 3);
    let kept = found.iter().flatten().count();
    assert!(2 * kept > found.len(), "{kept} of {}", found.len());
    // Nothing crosses, or what does passes in planes of its own.
    let mut flat = 0;
    for (s, l) in found.iter().flatten() {
        flat += usize::from(l.looks.crossings == 0);
        let passes = || layout_figures(s, l).unwrap().stacking.is_known();
        assert!(l.looks.crossings == 0 || passes(), "{}", s.name());
    }
    assert!(2 * flat > kept, "{flat} of {kept}");
}

fn strict() -> Limits {
    default_with(|l: &mut Limits| (l.ratio, l.crossings) = (3.0, 0))
}

/// Of what the starts come to, places within the limits are taken before cheaper ones: of these structures a third at least have
/// some, while the cheapest alone are so in two of thirteen.
#[test]
fn limits_come_before_costs() {
    let found = laid(&strict(), 3);
    let kept = found.iter().flatten().count();
    assert!(3 * kept > found.len(), "{kept} of {}", found.len());
}

/// Six starts alone keep the limits in half of these.
#[test]
fn more_starts_are_tried_where_none_keeps_the_limits() {
    let found = laid(&strict(), 1);
    let kept = found.iter().flatten().count();
    assert!(5 * kept > 3 * found.len(), "{kept} of {}", found.len());
}

/// Parallelograms for three jaws need more links than there are.
#[test]
fn three_jaws_have_no_parallel_form() {
    let suit = |jaws| Form::of_hinges().filter(move |(_, f)| f.suits_jaws(jaws));
    assert!(suit(2).any(|(_, f)| f.parallel));
    assert!(suit(3).count() > 0 && suit(3).all(|(_, f)| !f.parallel));
}

/// Where nothing pulls, masses are nothing that a file is told of.
#[test]
fn links_weigh_where_there_is_gravity() {
    let s = slider_crank();
    each_structure(4, &[(s.drive_input(), s.form)], |_, s| {
        let l = layout(&s, &Limits::default(), 1).unwrap();
        for (gravity, weighs) in [([0.0; 3], false), ([0.0, -9.81, 0.0], true)] {
            let workload =
                default_with(|w: &mut Workload| (w.link_mass, w.gravity) = (2.0, gravity));
            let file = mechanism_file(&s, &l, &Spec::default().option_menu().unwrap(), &workload);
            assert_eq!(file.workload.gravity.is_some(), weighs);
            let masses = file.link.iter().filter(|l| l.mass.is_some()).count();
            assert_eq!(masses, if weighs { 3 } else { 0 });
        }
    });
}
