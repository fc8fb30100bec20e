//! A stroke that is given up before it is gone to its end would have cost too much, and no other is given up.

use super::{each_structure, form_of, layout};
use crate::common::*;
use ozols::chains::Symmetry;
use ozols::synthesis::place::Point;
use ozols::synthesis::places::Places;
use ozols::synthesis::sketch::Sketch;
use ozols::synthesis::stroke::judge::Judge;

#[test]
fn a_stroke_is_given_up_only_where_it_costs_too_much() {
    let forms = [Input::Slide, Input::Turn].map(|i| form_of(i, Symmetry::Generic, false));
    let (mut kept, mut given_up) = (0, 0);
    each_structure(6, &forms, |_, structure| {
        let limits = Limits::default();
        let Ok(layout) = layout(&structure, &limits, 1) else {
            return;
        };
        let sketch = Sketch::new(&structure, layout.rules.clone(), limits);
        let places = layout.at.iter().chain(&layout.tips);
        let drawn: Vec<Point> = places.map(|p| p.real()).collect();
        let mut judge = Judge::new(&sketch);
        for n in 0..12 {
            // Places off by some millimetres, each by its own: from what does all the task asks to what locks on the way.
            let off = |i: usize, k: usize| f64::from((7 * n + 5 * i as u32 + 3 * k as u32) % 11);
            let moved = drawn.iter().enumerate().map(|(i, p)| {
                let by = f64::from(n) / 4.0;
                [0, 1].map(|k| p[k] + by * (off(i, k) - 5.0))
            });
            let at = Places::of_hinges(moved.collect());
            let Some(whole) = judge.coarse_figures(&at, f64::INFINITY) else {
                assert_eq!(judge.coarse_figures(&at, 1e9), None);
                continue;
            };
            let cost = limits.stroke_cost(&whole);
            for share in [0.0, 0.3, 0.9, 0.999, 1.0, 1.001, 3.0] {
                let found = judge.coarse_figures(&at, share * cost);
                if cost > share * cost {
                    assert_eq!(found, None, "{} of {cost}", share * cost);
                    given_up += 1;
                } else {
                    assert_eq!(found.as_ref(), Some(&whole), "{} of {cost}", share * cost);
                    kept += 1;
                }
            }
        }
    });
    assert!(kept > 300 && given_up > 300, "{kept} {given_up}");
}
