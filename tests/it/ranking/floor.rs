//! Bounds and refusals of the ranking where they can be told by other means: mechanisms with nothing to choose, whose floor is
//! what they score, and loads that turn a rod which spins.

use super::{cheapest, near, search};
use crate::common::*;
use ozols::model::ranking::TypeOverride;
use ozols::score::evaluation::terms::Scores;

fn vector(v: [i64; 3]) -> [Expr; 3] {
    v.map(Expr::from)
}

/// A built-in mechanism as it is, with a force on its output.
fn as_built(name: &str, force: [i64; 3]) -> Mechanism {
    let mut m = built_in(name);
    for j in &mut m.edit().joints {
        j.options.truncate(1);
        j.unloading.clear();
    }
    let output = m
        .link_ids()
        .find(|&l| m.links[l].role == Role::Output)
        .unwrap();
    let at = m.joints.iter().find(|j| j.links.contains(&output)).unwrap();
    m.edit().loads.forces = vec![ExternalForce {
        states: None,
        link: output,
        point: at.frame.point.clone(),
        force: vector(force),
        range: None,
    }];
    m
}

fn score(m: &Mechanism, clearance: ClearanceSum) -> ([f64; 3], Result<Scores, Unsolved>) {
    let s = search(m, 0);
    let e = Evaluator::new(&s, clearance).unwrap();
    let only = cheapest(&s, 2);
    assert_eq!(only.len(), 1);
    let floor = e.least_terms();
    let fast = e.score_variant(&only[0], &mut Scratch::default());
    let slow = e.reference_scores(&only[0]);
    assert_eq!(fast.is_ok(), slow.is_ok(), "{fast:?} {slow:?}");
    ([floor.force, floor.moment, floor.output_error], fast)
}

/// What all variants have in common is all there is of the only one: no bound is above its scores, and each is near them.
#[test]
fn with_nothing_to_choose_the_floor_is_the_score() {
    for name in ["slider-crank-determinate", "rsur"] {
        for clearance in [ClearanceSum::Worst, ClearanceSum::Rms] {
            let (floor, scores) = score(&as_built(name, [30, -70, 45]), clearance);
            let scores = scores.unwrap();
            let found = [
                scores.force.utilisation,
                scores.moment.utilisation,
                scores.output_error,
            ];
            for (floor, found) in floor.into_iter().zip(found) {
                assert!(floor <= found, "{name}: {floor} {found}");
            }
            // The moment's bound leaves out joints that some type bears none at; the others are sharp.
            assert!(floor[0] > 0.97 * found[0], "{name}: {floor:?} {found:?}");
            assert!(
                near(floor[2], found[2], 1e-5),
                "{name}: {floor:?} {found:?}"
            );
        }
    }
}

/// By virtual work, from the joints' forces under unit forces: the worst case adds clearances up and the mean square divides
/// each square by the three directions a joint may be off in.
#[test]
fn mean_squares_are_of_three_directions() {
    let m = as_built("slider-crank-determinate", [0, -10, 0]);
    let of = |clearance| score(&m, clearance).1.unwrap().output_error;
    let (worst, rms) = (of(ClearanceSum::Worst), of(ClearanceSum::Rms));
    // A joint that is off by d in a random direction is off by d/√3 along any line, root mean square. One joint alone with
    // play would have the two in that ratio; n alike would have it by √n more.
    let joints = m.joints.len() as f64;
    assert!(rms <= worst / 3f64.sqrt() * (1.0 + 1e-9), "{rms} {worst}");
    assert!(
        rms >= worst / (3.0 * joints).sqrt() * (1.0 - 1e-9),
        "{rms} {worst}"
    );
    // With play at one joint only they are in just that ratio.
    let mut one = m.clone();
    for j in &m.joints {
        let clearance = if j.id == "2-3" { 1e-4 } else { 0.0 };
        let name = j.joint_type.name().to_owned();
        one.edit().joint_types.push(TypeOverride {
            name,
            capacity_force: None,
            capacity_moment: None,
            clearance: Some(clearance),
        });
    }
    let of = |clearance| score(&one, clearance).1.unwrap().output_error;
    let (worst, rms) = (of(ClearanceSum::Worst), of(ClearanceSum::Rms));
    assert!(near(worst, 3f64.sqrt() * rms, 1e-9), "{worst} {rms}");
    assert!(worst > 1e-5);
}

/// A moment about the line of its two balls turns the rod, however small; one across that line does not.
#[test]
fn a_small_moment_about_a_free_spin_is_refused() {
    let with = |moment: [&str; 3]| {
        let mut m = as_built("rssr", [30, -70, 45]);
        let link = m.link_named("2").unwrap();
        m.edit().loads.moments.push(ExternalMoment {
            link,
            moment: moment.map(|x| x.parse().unwrap()),
            states: None,
        });
        score(&m, ClearanceSum::Worst).1
    };
    // The rod lies along (4, 1, 3).
    for small in ["1e-3", "1e-5"] {
        let along = ["4", "1", "3"].map(|x| format!("{x}*{small}"));
        let found = with(along.each_ref().map(String::as_str));
        assert!(matches!(found, Err(Unsolved::Moves { .. })), "{found:?}");
    }
    assert!(with(["1e-3", "-4e-3", "0"]).is_ok());
    assert!(with(["0", "0", "0"]).is_ok());
}

/// Smaller is better, and what sums are made of has the units that weights are given for: a tenth of the conditioning costs as
/// much as a millimetre of error.
#[test]
fn losses_have_the_units_of_their_weights() {
    let (_, scores) = score(
        &as_built("slider-crank-determinate", [0, -10, 0]),
        ClearanceSum::Worst,
    );
    let mut scores = scores.unwrap();
    for (conditioning, loss) in [
        (1.0, 0.0),
        (0.1, 1.0),
        (1e-3, 3.0),
        (2e-5, 5.0 - 2f64.log10()),
    ] {
        scores.conditioning = conditioning;
        assert!((scores.term_loss(Term::Conditioning) - loss).abs() < 1e-9);
    }
    for (metres, loss) in [(0.0, 0.0), (1e-3, 1.0), (2.5e-5, 0.025)] {
        scores.output_error = metres;
        assert!((scores.term_loss(Term::OutputError) - loss).abs() < 1e-9);
    }
    scores.cost_milli = 2500;
    assert_eq!(scores.term_loss(Term::Cost), 2.5);
}

/// An output is off where it is loaded; at its mass centre where it is not, and at its first joint where it weighs nothing.
#[test]
fn errors_are_told_of_the_point_that_is_loaded() {
    use ozols::score::evaluation::terms::output_points;
    let mut m = as_built("slider-crank-determinate", [0, -10, 0]);
    let slider = m.link_named("3").unwrap();
    m.edit().loads.forces[0].point = vector([160, 7, 1]);
    m.edit().links[slider].mass = Some(MassProperties {
        mass: 2.0,
        centre: vector([155, 3, 2]),
        inertia: None,
    });
    let point = |m: &Mechanism| {
        let s = search(m, 0);
        let e = Evaluator::new(&s, ClearanceSum::Worst).unwrap();
        output_points(m, &e.cases)
    };
    assert_eq!(point(&m), [(slider, [160.0, 7.0, 1.0])]);
    m.edit().loads.forces[0].link = m.link_named("2").unwrap();
    assert_eq!(point(&m), [(slider, [155.0, 3.0, 2.0])]);
    m.edit().links[slider].mass = None;
    assert_eq!(point(&m), [(slider, [150.0, -10.0, 0.0])]);
}

/// A ball in series with a ball has play of its own, and bears the same force: built as a link more, and as the fast way has it.
#[test]
fn play_in_series_adds_up() {
    let text = builtin::text("slider-crank-determinate").unwrap();
    let ball = "type = \"spherical\"\n";
    let text = text.replacen(ball, &format!("{ball}unloading = [\"spherical\"]\n"), 1);
    let series = read(&text);
    let mut m = as_built("slider-crank-determinate", [30, -70, 45]);
    let at = m.joint_named("2-3").unwrap();
    m.edit().joints[at].unloading = series.joints[at].unloading.clone();
    let s = search(&m, 0);
    let e = Evaluator::new(&s, ClearanceSum::Worst).unwrap();
    let mut scratch = Scratch::default();
    let [alone, both] = &cheapest(&s, 3)[..] else {
        panic!("as it is, and with a ball in series")
    };
    let [one, two] = [alone, both].map(|v| {
        let (fast, slow) = (
            e.score_variant(v, &mut scratch).unwrap(),
            e.reference_scores(v).unwrap(),
        );
        assert!(near(fast.output_error, slow.output_error, 1e-7));
        fast.output_error
    });
    assert!(two > 1.1 * one, "{one} {two}");
}

/// Forces over the capacity for forces, moments over that for moments.
#[test]
fn shares_are_of_the_capacity_of_their_kind() {
    let m = as_built("slider-crank-determinate", [30, -70, 45]);
    let s = search(&m, 0);
    let e = Evaluator::new(&s, ClearanceSum::Worst).unwrap();
    let only = &cheapest(&s, 1)[0];
    let (_, all) = e.bearings(only, &mut Scratch::default()).unwrap();
    let mut moments = 0;
    for (joint, found) in m.joints.iter().zip(all) {
        let (found, bears) = (
            found.unwrap(),
            e.types.get(joint.joint_type.name()).unwrap(),
        );
        assert!(near(
            found.force_share,
            found.force / bears.capacity_force,
            1e-12
        ));
        let share = bears.capacity_moment.map(|most| found.moment / most);
        assert_eq!(found.moment_share.is_some(), share.is_some());
        if let (Some(told), Some(share)) = (found.moment_share, share) {
            assert!(near(told, share, 1e-12), "{told} {share}");
            moments += usize::from(share > 0.0);
        }
    }
    assert!(moments > 0);
}
