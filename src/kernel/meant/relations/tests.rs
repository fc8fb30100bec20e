//! Which relations are accepted, and which are not: points slightly too far apart.

use super::*;

/// Returns all relations of points known to this error, along the frame's x.
fn relations(points: &[Vector], error: f64) -> Vec<Relation> {
    let [x, ..] = frame_axes();
    let errors = vec![error; points.len()];
    Finder::new(points, &errors, vec![Exact::new(x, 0.0)]).find_all()
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
