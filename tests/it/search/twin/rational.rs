//! Twists of joints, and elimination, in rational arithmetic.

use crate::common::*;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Zero;
use ozols::model::mechanism::Frame;

pub(super) type Q = BigRational;

fn cross(a: &[Q], b: &[Q]) -> Vec<Q> {
    let m = |i: usize, j: usize| &a[i] * &b[j] - &a[j] * &b[i];
    vec![m(1, 2), m(2, 0), m(0, 1)]
}

pub(super) fn dot(a: &[Q], b: &[Q]) -> Q {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Axes z, x, y of a frame, from the conventions of the design: z the axis, x the reference made perpendicular, y = z × x.
pub(super) fn axes(frame: &Frame) -> [Vec<Q>; 3] {
    let value = |v: &[ozols::geom::expr::Expr; 3]| {
        v.iter()
            .map(|e| e.as_rational().unwrap())
            .collect::<Vec<Q>>()
    };
    let (z, r) = (value(&frame.axis), value(&frame.reference));
    let (zz, zr) = (dot(&z, &z), dot(&z, &r));
    let x: Vec<Q> = (0..3).map(|i| &r[i] * &zz - &z[i] * &zr).collect();
    let y = cross(&z, &x);
    [z, x, y]
}

/// The length of the axis of a freedom, which must be rational.
pub(super) fn length(frame: &Frame, freedom: Freedom) -> Q {
    let [z, x, y] = axes(frame);
    let along = match freedom {
        Freedom::Rz | Freedom::Tz | Freedom::Screw => z,
        Freedom::Rx | Freedom::Tx => x,
        Freedom::Ry | Freedom::Ty => y,
    };
    let square = dot(&along, &along);
    let root = Q::new(square.numer().sqrt(), square.denom().sqrt());
    assert_eq!(&root * &root, square, "an axis of irrational length");
    root
}

/// Twists of a joint.
pub(super) fn twists(frame: &Frame, kind: &JointType) -> Vec<Vec<Q>> {
    let value = |v: &[ozols::geom::expr::Expr; 3]| {
        v.iter()
            .map(|e| e.as_rational().unwrap())
            .collect::<Vec<Q>>()
    };
    let p = value(&frame.point);
    let [z, x, y] = axes(frame);
    let turn = |u: &Vec<Q>| [u.clone(), cross(&p, u)].concat();
    let slide = |u: &Vec<Q>| [vec![Q::zero(); 3], u.clone()].concat();
    let one = |f: &Freedom| match f {
        Freedom::Rx => turn(&x),
        Freedom::Ry => turn(&y),
        Freedom::Rz => turn(&z),
        Freedom::Tx => slide(&x),
        Freedom::Ty => slide(&y),
        Freedom::Tz => slide(&z),
        Freedom::Screw => {
            let pitch = frame.pitch.as_rational().unwrap();
            let turned = turn(&z);
            let slid = slide(&z.iter().map(|c| c * &pitch).collect());
            turned.iter().zip(&slid).map(|(a, b)| a + b).collect()
        }
    };
    kind.freedoms().iter().map(one).collect()
}

/// What a joint's twists span of the motions in the plane of a planar mechanism; all of them in space.
pub(super) fn allowed_twists(mode: &Mode, frame: &Frame, kind: &JointType) -> Vec<Vec<Q>> {
    let all = twists(frame, kind);
    let Mode::Planar { normal } = mode else {
        return all;
    };
    let n: Vec<Q> = normal.iter().map(|e| e.as_rational().unwrap()).collect();
    // What leads out of the plane stands first, so that rows with zeros there stay in it.
    let row = |t: Vec<Q>| {
        let out = [cross(&t[..3], &n), vec![dot(&t[3..], &n)]].concat();
        [out, t].concat()
    };
    reduce(all.into_iter().map(row).collect())
        .into_iter()
        .filter(|row| row[..4].iter().all(Zero::is_zero))
        .map(|row| row[4..].to_vec())
        .collect()
}

/// Rows that say the same, each with its first entry further to the right than those before.
pub(super) fn reduce(mut rows: Vec<Vec<Q>>) -> Vec<Vec<Q>> {
    let (width, mut done) = (rows.first().map_or(0, Vec::len), 0);
    for c in 0..width {
        let Some(i) = (done..rows.len()).find(|&i| !rows[i][c].is_zero()) else {
            continue;
        };
        rows.swap(done, i);
        let (above, below) = rows.split_at_mut(done + 1);
        let own = &above[done];
        for row in below.iter_mut().filter(|row| !row[c].is_zero()) {
            let a = &row[c] / &own[c];
            let both = row.iter_mut().zip(own);
            both.filter(|(_, y)| !y.is_zero())
                .for_each(|(x, y)| *x -= &a * y);
        }
        done += 1;
    }
    rows.truncate(done);
    rows
}

#[test]
fn the_rational_elimination_is_right_on_a_known_matrix() {
    let q = |n: i64| Q::from_integer(BigInt::from(n));
    let reduced = reduce(vec![
        vec![q(1), q(2), q(3)],
        vec![q(2), q(4), q(7)],
        vec![q(3), q(6), q(10)],
    ]);
    assert_eq!(reduced, [[q(1), q(2), q(3)], [q(0), q(0), q(1)]]);
}
