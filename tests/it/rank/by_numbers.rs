//! What singular values say of a geometry that is a little off is what exact arithmetic says of the one that is not.

use crate::common::*;
use ozols::rank::numeric::scaling::rank_of_values;

/// The mechanism with every number off by some billionths; axes of planar models stay as they are.
fn disturbed(m: &Mechanism) -> Mechanism {
    let mut noise = Noise::new(7, 0);
    let mut off = |v: &[Expr; 3], by: f64| {
        let size = v.iter().map(|x| x.to_f64().abs()).fold(1.0, f64::max);
        v.each_ref()
            .map(|x| Expr::from_f64(x.to_f64() + by * size * noise.draw_uniform()).unwrap())
    };
    let mut out = m.clone();
    for joint in &mut out.edit().joints {
        joint.frame.point = off(&joint.frame.point, 1e-9);
        if matches!(m.mode, Mode::Spatial) {
            joint.frame.axis = off(&joint.frame.axis, 1e-9);
        }
        joint.options.clear();
        joint.unloading.clear();
    }
    out
}

/// The figures of a state that are found by ranks.
fn figures(s: &StateAnalysis) -> String {
    let contours = s
        .per_contour
        .iter()
        .map(|c| (c.redundant, c.range, c.over_bases));
    let couplings = s.per_coupling.iter().map(|c| (c.redundant, c.most));
    let external = s.external.map(|e| {
        (
            e.actual_mobility,
            e.working_mobility,
            e.lost_mobility,
            e.redundant,
        )
    });
    format!(
        "W {} of which {} work and {} idle, rank {}, σ {}: {:?}, {:?}, {external:?}",
        s.mobility,
        s.working_mobility,
        s.local_mobility,
        s.rank,
        s.redundant,
        contours.collect_vec(),
        couplings.collect_vec(),
    )
}

#[test]
fn figures_of_a_geometry_a_little_off_are_those_of_the_exact_one() {
    let numeric = Method::Numeric(Elimination::Svd, 1e-6);
    let (mut idle, mut clamped, mut coupled, mut wrong) = (0, 0, 0, Vec::new());
    for name in builtin::names() {
        let m = built_in(name);
        let at = |j: usize| m.joints[j].frame.point.each_ref().map(Expr::to_f64);
        // Joints that are all at one point have no size that they could be off by a little of.
        let spread = (0..m.joints.len()).any(|j| at(j) != at(0));
        if m.joints.len() > 14 || !spread {
            continue;
        }
        let off = disturbed(&m);
        for state in m.state_ids() {
            let exact = analysed_in(&m, state);
            let written = analysed_in(&off, state);
            // Where a special place is not left, numbers have nothing to say.
            if written.rank == exact.rank {
                continue;
            }
            let found = analyse_states(&off, &[state], numeric).unwrap().remove(0);
            if figures(&found) != figures(&exact) {
                wrong.push(format!(
                    "{name}\n  {}\n  {}",
                    figures(&found),
                    figures(&exact)
                ));
            }
            idle += usize::from(exact.local_mobility > 0);
            clamped += usize::from(exact.external.is_some());
            coupled += exact.per_coupling.iter().filter(|c| c.most > 0).count();
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(
        idle > 0 && clamped > 0 && coupled > 0,
        "{idle} {clamped} {coupled}"
    );
}

/// A value counts by the largest, whatever both are.
#[test]
fn values_count_by_the_largest() {
    for size in [1e-6, 1.0, 1e6] {
        let values = [3.0, 1.0, 1e-7].map(|x| x * size).to_vec();
        assert_eq!(rank_of_values(values.clone(), 1e-6).rank, 2);
        assert_eq!(rank_of_values(values.clone(), 1e-8).rank, 3);
        assert_eq!(rank_of_values(values, 0.5).rank, 1);
    }
}
