//! Layouts made for force, against the best that others found for four schemes in one box (`tests/data/forces.json`), and by trying all
//! places.

use super::number;
use crate::common::*;
use ozols::chains::PairKind;
use ozols::synthesis::layout::{lay_out, most_symmetric};
use ozols::synthesis::task::Aim;

/// The limits of `forces.json`: pins at 3 mm to 40 mm from the middle, tips 20 mm ahead of hinges and 30 mm apart when closed, each opening by
/// 10 mm. They are drawn closed, so that all has the room of a rounding.
fn published_limits(transmission: f64) -> Limits {
    Limits {
        ratio: 30.0,
        task: Task {
            narrowest: 29.999,
            widest: 50.0,
            force_ratio: 1000.0,
            transmission,
            pin_force: 0.0,
            efficiency: 0.0,
            room: [100.02, 80.02],
            pin_distance: 5.99,
            reach: 20.0,
            own_sides: true,
            pulled_out: 1.601,
            aim: Aim::Force,
            ..Task::default()
        },
        ..Limits::default()
    }
}

/// The least force over the stroke of the strongest layout of a scheme, which keeps the limits as drawn.
fn strongest(id: &str, transmission: f64) -> f64 {
    let classic = known_classics().iter().find(|c| c.id == id).unwrap();
    let paired = most_symmetric(&classic.structure).unwrap();
    let limits = published_limits(transmission);
    let found = lay_out(&paired, &limits, 1).unwrap();
    let figures = layout_figures(&paired, &found).unwrap();
    assert_eq!(figures.shortfall, None, "{id}");
    let joints = found.rules.joints.iter().zip(&found.at.points);
    let pins: Vec<[f64; 2]> = joints
        .filter(|(j, _)| j.pair != PairKind::Gear)
        .map(|(_, p)| *p)
        .collect();
    for (a, b) in pins.iter().tuple_combinations() {
        assert!((a[0] - b[0]).hypot(a[1] - b[1]) > 5.98, "{id}: {pins:?}");
    }
    for p in &pins {
        assert!(p[0] <= 100.0 && p[1].abs() <= 40.01, "{id}: {pins:?}");
    }
    figures.force[0]
}

fn published(id: &str) -> f64 {
    let told: Value = serde_json::from_str(&read_data("forces.json")).unwrap();
    number(&told[id], "least")
}

/// Not more than two percent below what is published; above it by as much as whole millimetres and slightly other limits make.
fn is_as_strong(id: &str, transmission: f64, above: f64) {
    let (found, told) = (strongest(id, transmission), published(id));
    let share = found / told;
    assert!(
        (0.98..1.0 + above).contains(&share),
        "{id}: {found}, told {told}"
    );
}

/// Its angle of 30° is one between rod and lever, ours one between rod and the motion of its faster end, too: 5° do not bind.
#[test]
fn levers_on_rods_are_as_strong_as_published() {
    is_as_strong("piston-links-angular", 5.0, 0.02);
}

#[test]
fn a_toggle_is_as_strong_as_published() {
    is_as_strong("toggle-sliding-jaws", 10.0, 0.01);
}

/// Its pitch line is 5 mm from the middle, ours 3 at the nearest.
#[test]
fn a_rack_is_as_strong_as_published() {
    is_as_strong("rack-two-segments", 10.0, 0.08);
}

/// The least force over the stroke of a cylinder between two geared jaws, one of them with hinge and tail at these places, by turning it;
/// `None` where it breaks a limit.
fn of_cylinder([hx, hy]: [f64; 2], [tx, ty]: [f64; 2]) -> Option<f64> {
    let (a, b) = (120.0 - hx, 15.0 - hy);
    let (c, d) = (tx - hx, ty - hy);
    let (mut least, mut lengths) = (f64::INFINITY, [f64::INFINITY, 0.0_f64]);
    let (arm, begin) = (a.hypot(b), b.atan2(a));
    for step in 0..=10 {
        let y = 15.0 + f64::from(step) - hy;
        if y.abs() >= arm {
            return None;
        }
        let by = (y / arm).asin() - begin;
        let (sine, cosine) = by.sin_cos();
        let tip_x = hx + a * cosine - b * sine;
        let tail = [hx + c * cosine - d * sine, hy + c * sine + d * cosine];
        let boxed = tail[1] <= 40.01 && tail[1] >= 2.995 && tip_x.max(120.0) - tail[0] <= 100.02;
        if !boxed {
            return None;
        }
        least = least.min(((c * cosine - d * sine) / (a * cosine - b * sine)).abs());
        lengths = [lengths[0].min(tail[1]), lengths[1].max(tail[1])];
    }
    // Pitch circles are in the box, which they touch in the middle.
    let fits = 2.0 * hy <= 40.01 && lengths[1] <= 1.601 * lengths[0];
    fits.then_some(least)
}

/// `forces.json` tells 1.5, with gears that stand out of the box; with these in it, all whole millimetres are tried.
#[test]
fn a_cylinder_is_as_strong_as_any() {
    let steps = |from: i32, to: i32| (from..=to).map(f64::from);
    let hinges = steps(60, 100).cartesian_product(steps(3, 20));
    let all = hinges.cartesian_product(steps(20, 60).cartesian_product(steps(3, 40)));
    let tried = all.filter_map(|(h, t)| of_cylinder([h.0, h.1], [t.0, t.1]));
    let best = tried.fold(0.0, f64::max);
    let found = strongest("cylinder-between-jaws-gears", 10.0);
    assert!(found > 0.98 * best, "{found} of {best}");
    assert!(best < published("cylinder-between-jaws-gears"), "{best}");
}
