//! The same by a linear programme over edges of the friction cones, with a solver and wrenches of its own.

use super::{At, part, vice};
use crate::common::*;
use microlp::{ComparisonOp, OptimizationDirection, Problem};
use ozols::grip::force_closure::closure;
use proptest::prelude::*;

type V = [f64; 3];

struct Disc {
    point: V,
    inwards: V,
    friction: f64,
    radius: f64,
}

/// Mean and root mean square distance of the discs' points.
fn measure(discs: &[Disc]) -> (V, f64) {
    let n = discs.len() as f64;
    let middle = discs
        .iter()
        .fold([0.0; 3], |m, d| add_scaled(m, 1.0 / n, d.point));
    let square = discs
        .iter()
        .map(|d| length(add_scaled(d.point, -1.0, middle)).powi(2));
    (middle, (square.sum::<f64>() / n).sqrt())
}

/// The greatest load along (moment over the size; force) with normal forces of 1 in all: rims and cones as polygons of `edges`
/// edges within them, or round them (`outer`).
fn load(discs: &[Disc], direction: [f64; 6], edges: usize, outer: bool) -> f64 {
    let (middle, size) = measure(discs);
    let wide = if outer {
        1.0 / (TAU / 2.0 / edges as f64).cos()
    } else {
        1.0
    };
    // The rim is the same polygon as in the program; the cones are not.
    let rim = 16;
    let mut lp = Problem::new(OptimizationDirection::Maximize);
    let t = lp.add_var(1.0, (0.0, 1e6));
    let mut rows: [Vec<(microlp::Variable, f64)>; 6] = Default::default();
    let mut normals = Vec::new();
    for d in discs {
        // The program's x: the first axis that is not along the normal, made perpendicular to it.
        let axes: [V; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let first = axes
            .into_iter()
            .find(|a| length(cross(*a, d.inwards)) > 1e-9)
            .unwrap();
        let along = (0..3).map(|i| first[i] * d.inwards[i]).sum::<f64>();
        let x = unit(add_scaled(first, -along, d.inwards));
        let y = cross(d.inwards, x);
        let round = |angle: f64, r: f64| add_scaled(scale(x, r * angle.cos()), r * angle.sin(), y);
        for k in 0..rim {
            let at = add(d.point, round(TAU * k as f64 / rim as f64, d.radius));
            for e in 0..edges {
                let slip = round(TAU * e as f64 / edges as f64, d.friction * wide);
                let force = add_scaled(d.inwards, 1.0, slip);
                let moment = cross(add_scaled(at, -1.0, middle), force).map(|m| m / size);
                let v = lp.add_var(0.0, (0.0, f64::INFINITY));
                normals.push((v, 1.0));
                for i in 0..3 {
                    rows[i].push((v, moment[i]));
                    rows[i + 3].push((v, force[i]));
                }
            }
        }
    }
    for (row, d) in rows.iter_mut().zip(direction) {
        row.push((t, d));
        lp.add_constraint(row.as_slice(), ComparisonOp::Eq, 0.0);
    }
    lp.add_constraint(normals.as_slice(), ComparisonOp::Le, 1.0);
    lp.solve().unwrap().solution().unwrap().objective()
}

fn vector() -> impl Strategy<Value = V> {
    [-1.0..1.0f64, -1.0..1.0, -1.0..1.0].prop_filter("not small", |v| length(*v) > 0.3)
}

/// A disc whose normal looks inwards, tipped a little.
fn disc() -> impl Strategy<Value = (V, V, f64, f64)> {
    (vector(), vector(), 0.1..1.0f64, 0.05..0.5f64)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn a_linear_programme_brackets_the_loads(
        all in prop::collection::vec(disc(), 2..5), any in (vector(), vector()),
    ) {
        let discs: Vec<Disc> = all
            .into_iter()
            .map(|(p, tip, friction, radius)| Disc {
                point: unit(p),
                inwards: unit(add_scaled(scale(unit(p), -1.0), 0.2, tip)),
                friction,
                radius,
            })
            .collect();
        let (middle, size) = measure(&discs);
        // The program must see the same side, and a size.
        let inwards = |d: &Disc| {
            (0..3).map(|i| d.inwards[i] * (middle[i] - d.point[i])).sum::<f64>() > 0.05
        };
        prop_assume!(size > 0.2 && discs.iter().all(inwards));
        let contacts: Vec<At> = discs
            .iter()
            .map(|d| At {
                kind: "fixed",
                point: d.point,
                normal: d.inwards,
                face: format!("friction = {}\nradius = {}", d.friction, d.radius),
            })
            .collect();
        let part = part(&vice(&contacts));
        let found = closure(&part, &part.faces).unwrap();
        let told = found.along.iter().copied().chain([(found.weakest, found.at_most)]);
        for (d, value) in told {
            let (least, most) = (load(&discs, d, 16, false), load(&discs, d, 16, true));
            prop_assert!(least - 1e-5 <= value && value <= most + 1e-5, "{least} {value} {most} {d:?}");
        }
        // No load of another direction is below the lower bound.
        let (m, f) = any;
        let length = (length(m).powi(2) + length(f).powi(2)).sqrt();
        let d = [m[0], m[1], m[2], f[0], f[1], f[2]].map(|x| x / length);
        prop_assert!(load(&discs, d, 16, true) >= found.at_least - 1e-5);
    }
}
