//! One unknown and one place, by hand.

use super::*;

/// Creates a reaction x of one place under one load. If `known`, x = 3 holds for all variants. The first choice of the
/// single variable adds the equation `further`, and its second choice adds nothing.
fn of_one_unknown(known: bool, [factor, right]: [f64; 2]) -> Beginnings {
    let limits = |force, clearance| LoadLimits {
        force,
        moment: 0.0,
        clearance,
    };
    let (strong, loose) = (limits(0.1, 0.5), limits(0.4, 0.2));
    let x = if known { 3.0 } else { 0.0 };
    let further = if known {
        vec![right - factor * x]
    } else {
        vec![factor, right]
    };
    Beginnings {
        start: SolutionSpace::unrestricted(usize::from(!known), 1),
        sides: 1,
        work: 1e-9,
        clearance: ClearanceSum::Worst,
        further: vec![vec![vec![further], Vec::new()]],
        places: vec![LoadedPlace {
            variable: 0,
            slot: 0,
            fixed: vec![[x, 0.0, 0.0, 0.0, 0.0, 0.0]],
            open: vec![[1.0, 0.0, 0.0, 0.0, 0.0, 0.0]],
        }],
        of_variable: vec![vec![0]],
        limits: vec![vec![vec![strong], vec![loose]]],
        least: vec![vec![strong.least_of_both(loose)]],
    }
}

/// Checks a motion on which a known reaction x = 3 and the loads do work. It has no equilibrium.
#[test]
fn a_motion_is_held_by_the_reactions_that_are_known() {
    for (further, held) in [
        ([1.0, 3.0], true),
        ([2.0, 6.0], true),
        ([1.0, -3.0], false),
        ([1.0, 2.0], false),
    ] {
        let of = of_one_unknown(true, further);
        let mut begun = of.begin_empty();
        // By the second choice the reactions become known; the first is then looked at by them.
        let (taken, free) = begun.take_choice(0, 1);
        assert!(free && taken.tells);
        let peaks = begun.peak_bounds(&taken, |_| false).unwrap();
        assert!((peaks.force - 3.0 * 0.4).abs() < 1e-12);
        assert_eq!(begun.take_choice(0, 0).1, held, "{further:?}");
    }
}

/// Checks reactions that nothing common to all variants determines. The equation of a choice determines them, and its
/// removal undoes this.
#[test]
fn a_choice_that_determines_the_reactions_tells_them() {
    let of = of_one_unknown(false, [4.0, 2.0]);
    let mut begun = of.begin_empty();
    let (undecided, _) = begun.take_choice(0, 1);
    assert!(begun.peak_bounds(&undecided, |_| false).is_none());
    begun.give_back(undecided);
    let (taken, held) = begun.take_choice(0, 0);
    assert!(held);
    assert!((begun.peak_bounds(&taken, |_| false).unwrap().force - 0.5 * 0.1).abs() < 1e-12);
    begun.give_back(taken);
    let (again, _) = begun.take_choice(0, 1);
    assert!(begun.peak_bounds(&again, |_| false).is_none());
}

/// Checks that the place that ends a branch is examined first in the next one. Then the other places need no examination.
#[test]
fn a_place_that_ended_a_branch_is_looked_at_first() {
    let mut of = of_one_unknown(true, [1.0, 3.0]);
    of.places.push(LoadedPlace {
        variable: 0,
        slot: 0,
        fixed: vec![[6.0, 0.0, 0.0, 0.0, 0.0, 0.0]],
        open: Vec::new(),
    });
    of.of_variable[0].push(1);
    let mut begun = of.begin_empty();
    let mut looked_at = |enough: f64| {
        let taken = begun.take_choice(0, 1).0;
        let counted = std::cell::Cell::new(0);
        let ends = |floor: Floor| {
            counted.set(counted.get() + 1);
            floor.force >= enough
        };
        let force = begun.peak_bounds(&taken, ends).unwrap().force;
        begun.give_back(taken);
        (counted.get(), force)
    };
    // 3 and 6, each with a limit of 0.4.
    let [first, second] = [3.0 * 0.4, 6.0 * 0.4];
    assert_eq!(looked_at(f64::INFINITY), (2, second));
    assert_eq!(looked_at(first), (1, first));
    assert_eq!(looked_at(second), (2, second));
    assert_eq!(looked_at(first), (1, second));
}

/// Checks that the output with the larger error counts, in either order of two outputs.
#[test]
fn the_error_is_that_of_the_output_that_is_farthest_off() {
    let of = of_one_unknown(true, [1.0, 3.0]);
    for forces in [[3.0, 4.0], [4.0, 3.0]] {
        let mut begun = of.begin_empty();
        let taken = begun.take_choice(0, 1).0;
        // What a unit force along x on each output brings on the one place, and no force along y and z does.
        begun.passed = forces.iter().flat_map(|&f| [f, 0.0, 0.0]).collect();
        begun.errors = true;
        // The play of the second choice.
        assert!((begun.output_error() - 4.0 * 0.2).abs() < 1e-12);
        begun.give_back(taken);
    }
}
