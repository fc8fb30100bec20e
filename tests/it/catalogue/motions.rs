//! Figures of a layout's motion against places solved afresh: transmission angles, forces, travel.

use super::{Drawn, each, form, layout, moved, moved_points};
use ozols::chains::{Input, Symmetry};
use ozols::synthesis::figures::{LayoutFigures, figures};
use ozols::synthesis::structure::Structure;
use ozols::synthesis::task::Limits;

fn step(s: &Structure) -> f64 {
    match s.input() {
        Input::Slide => 1e-4,
        Input::Turn => 2e-6,
    }
}

/// Velocities of points of links, by differences.
fn speeds(s: &Structure, l: &Drawn, points: &[(usize, [f64; 2])]) -> Vec<[f64; 2]> {
    let h = step(s);
    let [a, b] = [-h, h].map(|drive| moved_points(s, l, drive, points));
    let each = a.iter().zip(&b);
    each.map(|(a, b)| [0, 1].map(|i| (b[i] - a[i]) / (2.0 * h)))
        .collect()
}

/// A rod pushes best along itself: its angle is that between the motion of its faster end and the line across the rod.
#[test]
fn transmission_angles_are_those_of_the_rods_ends() {
    let forms = [Input::Slide, Input::Turn].map(|i| form(i, Symmetry::Generic, false));
    let (mut n, mut told) = (0, 0);
    each(6, &forms, |_, s| {
        n += 1;
        if n % 9 != 0 {
            return;
        }
        let l = layout(&s, &Limits::default(), 1).unwrap();
        let mut least = 90.0_f64;
        for link in 0..s.structure.chain.links() {
            let at: Vec<[f64; 2]> = l
                .pins
                .iter()
                .zip(&l.at)
                .filter(|((u, v), _)| [*u, *v].contains(&link))
                .map(|(_, p)| p.real())
                .collect();
            let r = &s.structure.roles;
            let other = link == r.frame || link == r.drive()[1] || r.jaws.contains(&link);
            let (false, [a, b]) = (other, &at[..]) else {
                continue;
            };
            let v = speeds(&s, &l, &[(link, *a), (link, *b)]);
            let size = |v: [f64; 2]| v[0].hypot(v[1]);
            let (fast, slow) = if size(v[0]) > size(v[1]) {
                (v[0], v[1])
            } else {
                (v[1], v[0])
            };
            if size(slow) < 1e-4 * size(fast) {
                continue;
            }
            let rod = [b[0] - a[0], b[1] - a[1]];
            let between = (rod[0] * fast[1] - rod[1] * fast[0])
                .abs()
                .atan2((rod[0] * fast[0] + rod[1] * fast[1]).abs());
            least = least.min(90.0 - between.to_degrees());
            told += 1;
        }
        assert!(
            (least - l.looks.transmission).abs() < 1e-2,
            "{}: {least} {}",
            s.name(),
            l.looks.transmission
        );
    });
    assert!(told > 5, "{told}");
}

/// Work in is work out, pose by pose: a jaw's force over the drive's is the drive's way over all the jaws' together.
#[test]
fn forces_are_the_drives_way_over_the_jaws() {
    let forms = [Input::Slide, Input::Turn].map(|i| form(i, Symmetry::Generic, false));
    let mut n = 0;
    each(6, &forms, |_, s| {
        n += 1;
        if n % 12 != 0 {
            return;
        }
        let l = layout(&s, &Limits::default(), 1).unwrap();
        let found = figures(&s, &l).unwrap();
        let h = step(&s);
        let gap = |drive| {
            let tips = moved(&s, &l, drive);
            tips[0][1] - tips[1][1]
        };
        let rate = ((gap(h) - gap(-h)) / (2.0 * h)).abs();
        bracketed(&s, &found, 1.0, rate);
        // The ends of the stroke, solved afresh from the drawn place.
        assert!(found.openings[0] < gap(0.0) && gap(0.0) < found.openings[1]);
    });
}

/// The force at the drawn place is among those of the stroke, and so is their mean over the opening, which this returns.
pub(super) fn bracketed(s: &Structure, f: &LayoutFigures, pairs: f64, rate: f64) -> f64 {
    let metre = match s.input() {
        Input::Slide => 1.0,
        Input::Turn => 1000.0,
    };
    let drawn = metre / (pairs * rate);
    let mean = metre * f.travel / (pairs * (f.openings[1] - f.openings[0]));
    for force in [drawn, mean] {
        assert!(
            f.force[0] <= force * 1.02 && force <= f.force[2] * 1.02,
            "{}: {force} {f:?}",
            s.name()
        );
    }
    mean
}
