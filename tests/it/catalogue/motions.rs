//! Figures of a layout's motion against places solved afresh: transmission angles, forces, travel.

use super::{each, form, layout, moved};
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
