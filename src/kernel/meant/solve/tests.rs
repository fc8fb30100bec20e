//! Rows solved in whole numbers, compared with an independent elimination in rational numbers.

use super::*;
use proptest::prelude::*;

type Q = BigRational;

fn ratio(n: i64, d: i64) -> Q {
    Q::new(n.into(), d.into())
}

/// Returns the coefficients of a row at all coordinates.
fn dense(row: &PointEquation, normals: &[Rational3], points: usize) -> Vec<Q> {
    let mut out = vec![Q::zero(); 3 * points];
    for &(p, c) in &row.terms {
        for k in 0..3 {
            out[3 * p + k] += &normals[row.normal][k] * ratio(c.into(), 1);
        }
    }
    out
}

/// Returns the rank of a matrix, by plain elimination.
fn rank(mut rows: Vec<Vec<Q>>) -> usize {
    let mut rank = 0;
    for c in 0..rows.first().map_or(0, Vec::len) {
        let Some(at) = (rank..rows.len()).find(|&r| !rows[r][c].is_zero()) else {
            continue;
        };
        rows.swap(rank, at);
        let own = rows[rank].clone();
        for row in &mut rows[rank + 1..] {
            let by = &row[c] / &own[c];
            row.iter_mut().zip(&own).for_each(|(x, y)| *x -= &by * y);
        }
        rank += 1;
    }
    rank
}

fn number() -> impl Strategy<Value = Q> {
    let short = (-6i64..7).prop_map(|n| ratio(n, 1));
    let long = (-999_983i64..999_983).prop_map(|n| ratio(n, 1_000_000));
    prop_oneof![3 => short, 1 => long]
}

const POINTS: usize = 5;

fn rows() -> impl Strategy<Value = Vec<PointEquation>> {
    let terms = prop::collection::vec((0..POINTS, -2i32..3), 2..5);
    let row = (terms, 0..4usize).prop_map(|row| PointEquation::sum(&row.0, row.1));
    prop::collection::vec(row, 1..14)
}

proptest! {
    #[test]
    fn rows_hold_and_as_many_coordinates_follow_as_must(
        rows in rows(),
        normals in prop::collection::vec([number(), number(), number()], 4),
        values in prop::collection::vec(number(), 3 * POINTS),
        stay in prop::collection::vec(prop::bool::weighted(0.2), 3 * POINTS),
    ) {
        let value = |p: usize, k: usize| values[3 * p + k].clone();
        let found = solve_rows(&rows, &normals, POINTS, value, |p, k| stay[3 * p + k]);
        let dense: Vec<Vec<Q>> = rows.iter().map(|r| dense(r, &normals, POINTS)).collect();
        // Fixed coordinates are known: the remainder of a row, and its constant.
        let of_free = |r: &Vec<Q>| -> Vec<Q> {
            (0..r.len()).filter(|&v| !stay[v]).map(|v| r[v].clone()).collect()
        };
        let asked = |r: &Vec<Q>| (0..r.len()).filter(|&v| stay[v]).fold(Q::zero(), |s, v| s + &r[v] * &values[v]);
        let free = rank(dense.iter().map(of_free).collect());
        let with = |r: &Vec<Q>| of_free(r).into_iter().chain([asked(r)]).collect();
        let contradict = rank(dense.iter().map(with).collect()) > free;
        prop_assert_eq!(found.is_none(), contradict);
        let Some(found) = found else { return Ok(()) };
        let found: Vec<Q> = found.into_iter().flatten().collect();
        for row in &dense {
            let sum = row.iter().zip(&found).fold(Q::zero(), |s, (a, x)| s + a * x);
            prop_assert!(sum.is_zero());
        }
        let moved = (0..3 * POINTS).filter(|&v| found[v] != values[v]);
        prop_assert!(moved.clone().all(|v| !stay[v]));
        prop_assert!(moved.count() <= free);
    }
}

/// Checks the limit on numbers that grow by the digits of a normal at every row, because nothing cancels.
#[test]
fn what_grows_too_long_is_given_up() {
    let mut state = 1u64;
    let mut next = |below: u64| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 33) % below
    };
    let mut component = |_: usize| ratio(next(999_983) as i64 - 500_000, 999_979);
    let normals: Vec<Rational3> = (0..200).map(|_| [0, 1, 2].map(&mut component)).collect();
    let mut row = |normal: usize| PointEquation {
        terms: (0..6).map(|i| (next(80) as usize, i - 2)).collect(),
        normal,
    };
    let rows: Vec<PointEquation> = (0..200).map(&mut row).collect();
    let value = |p: usize, k: usize| ratio((p * 31 + k) as i64, 1000);
    assert!(solve_rows(&rows, &normals, 80, value, |_, _| false).is_none());
    assert!(solve_rows(&rows[..40], &normals, 80, value, |_, _| false).is_some());
}
