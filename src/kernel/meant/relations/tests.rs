//! Which relations are accepted, and which are not: points slightly too far apart, planes formed by chance.

use super::*;

/// Returns all relations of points known to this error, along the frame's x.
fn relations(points: &[Vector], error: f64) -> Vec<Relation> {
    let [x, ..] = frame_axes();
    let errors = vec![error; points.len()];
    Finder::new(points, &errors, vec![Exact::of_axis(x)]).find_all()
}

fn of_kind(all: &[Relation], kind: RelationKind) -> Vec<&Relation> {
    all.iter().filter(|r| r.kind == kind).collect()
}

#[test]
fn points_are_one_within_their_errors_alone() {
    let apart = |d: f64| {
        let all = relations(&[[0.3, 0.7, 0.1], [0.3 + d, 0.7, 0.1]], 1e-6);
        of_kind(&all, RelationKind::Coincident).len()
    };
    // Two errors of a millionth each, plus half of that.
    assert_eq!([0.0, 1e-6, 2.9e-6].map(apart), [1; 3]);
    assert_eq!([3.1e-6, 1e-5, 1e-4, 1e-3].map(apart), [0; 4]);
}

/// Checks that two of three points in a plane by six digits are intended to be, and that two of three hundred are there
/// by chance.
#[test]
fn a_plane_that_chance_makes_is_weak() {
    let weak = |n: usize| {
        let mut points = vec![[0.0, 0.0, 0.0], [0.0, 0.31, 0.72]];
        // The others are at distances along x that are all different.
        points.extend((2..n).map(|i| {
            let i = as_f64(i);
            [i / as_f64(n), (i * 0.618).fract(), (i * 0.414).fract()]
        }));
        let all = relations(&points, 1e-6);
        let planes = of_kind(&all, RelationKind::InPlane);
        assert_eq!(planes.len(), 1, "{n}");
        planes[0].weak
    };
    assert!(!weak(3));
    assert!(weak(300));
}
