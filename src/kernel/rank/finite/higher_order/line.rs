//! One motion to high order: power series of one variable, one coefficient after the other.
//!
//! A coefficient of a product of two series needs no later coefficients of its factors. The coefficients of order d of
//! the coordinates contribute J times themselves to the gaps of that order. So each order costs one pass along the
//! contours, and a series of order D about D² products, whereas a new expansion at every order costs D³.

use crate::geom::rigid::split_twist;
use crate::linalg::modp::{Field, Residue};

/// Maximum number of products.
const WORK: usize = 60_000_000;

type Three = [Residue; 3];

/// Contours solved for the coordinates that J determines.
#[derive(Debug)]
pub(super) struct Solved {
    pub(super) field: Field,
    /// Twists (ω; v) of the columns.
    pub(super) twists: Vec<Vec<Residue>>,
    /// Contours as columns with their directions.
    pub(super) walks: Vec<Vec<(usize, bool)>>,
    /// Row operations that bring J to reduced echelon form: the first rows belong to the pivots, the others to g.
    pub(super) solve: Vec<Vec<Residue>>,
    /// Pivot columns.
    pub(super) pivots: Vec<usize>,
}

/// One freedom passed by a contour: the displacement before it, and its own functions of t, as series.
struct FreedomPassed {
    column: usize,
    forward: bool,
    /// ω, v, ω × v and ω × (ω × v) of its twist.
    twist: [Three; 4],
    /// ω · ω.
    square: Residue,
    /// θ(t), sin θ, 1 - cos θ and θ - sin θ, for an axis that is not a unit vector.
    angle: Vec<Residue>,
    /// θ'(t).
    speed: Vec<Residue>,
    sine: Vec<Residue>,
    cosine: Vec<Residue>,
    rest: Vec<Residue>,
    /// Rows of the rotation before it.
    turn: [[Vec<Residue>; 3]; 3],
    /// Those rows times v and times ω × (ω × v).
    along: [[Vec<Residue>; 3]; 2],
}

/// A rotation and a translation of one order.
#[derive(Clone, Copy)]
struct SeriesTerm {
    turn: [Three; 3],
    shift: Three,
}

impl FreedomPassed {
    fn new(f: Field, twist: &[Residue], column: usize, forward: bool) -> FreedomPassed {
        let (w, v) = split_twist(twist);
        let once = cross(f, w, v);
        FreedomPassed {
            column,
            forward,
            twist: [w, v, once, cross(f, w, once)],
            square: dot(f, w, w),
            angle: vec![0],
            speed: Vec::new(),
            sine: vec![0],
            cosine: vec![0],
            rest: vec![0],
            turn: [(); 3].map(|()| [(); 3].map(|()| Vec::new())),
            along: [(); 2].map(|()| [(); 3].map(|()| Vec::new())),
        }
    }

    /// Records the displacement before it, of the next order.
    fn enter_freedom(&mut self, f: Field, before: &SeriesTerm) {
        for (i, row) in before.turn.iter().enumerate() {
            for (series, &x) in self.turn[i].iter_mut().zip(row) {
                series.push(x);
            }
            self.along[0][i].push(dot(f, *row, self.twist[1]));
            self.along[1][i].push(dot(f, *row, self.twist[3]));
        }
    }

    /// Adds the effect of this freedom at order `d` to the displacement before it, with `x` as the coefficient of its
    /// angle.
    fn pass_freedom(&mut self, f: Field, d: usize, x: Residue, at: &mut SeriesTerm) {
        let x = if self.forward { x } else { f.neg(x) };
        let turns = self.twist[0] != [0; 3];
        // From the derivatives: (sin θ)' = cos θ θ', (1 - cos θ)' = sin θ θ', (θ - sin θ)' = (1 - cos θ) θ'.
        let part = f.inv(f.from_i64(d as i64));
        let rates = |of: &[Residue]| f.mul(part, last_coefficient(f, &self.speed, &of[1..d]));
        let (sine, cosine, rest) = if turns {
            let bent = f.mul(self.square, rates(&self.cosine));
            (f.sub(x, bent), rates(&self.sine), rates(&self.cosine))
        } else {
            (x, 0, 0)
        };
        self.angle.push(x);
        self.speed.push(f.mul(f.from_i64(d as i64), x));
        self.sine.push(sine);
        self.cosine.push(cosine);
        self.rest.push(rest);
        let of = |a: &[Residue], b: &[Residue]| last_coefficient(f, &a[1..], &b[..d]);
        let [w, _, once, _] = self.twist;
        for i in 0..3 {
            let mut moved = of(&self.angle, &self.along[0][i]);
            if turns {
                let by = |a: &[Residue]| [0, 1, 2].map(|j| of(a, &self.turn[i][j]));
                let (sines, cosines) = (by(&self.sine), by(&self.cosine));
                moved = f.add(moved, dot(f, cosines, once));
                moved = f.add(moved, of(&self.rest, &self.along[1][i]));
                // A row times ŵ is row × w.
                let turned = cross(f, sines, w);
                let twice = cross(f, cross(f, cosines, w), w);
                for (j, entry) in at.turn[i].iter_mut().enumerate() {
                    *entry = f.add(*entry, f.add(turned[j], twice[j]));
                }
            }
            at.shift[i] = f.add(at.shift[i], moved);
        }
    }

    /// Adds the effect of a coefficient of order `d` that was first assumed to be 0, here and in all later terms.
    fn correct_order(&mut self, f: Field, d: usize, x: Residue, at: &mut SeriesTerm) {
        let x = if self.forward { x } else { f.neg(x) };
        for (i, row) in at.turn.iter().enumerate() {
            for (series, &more) in self.turn[i].iter_mut().zip(row) {
                series[d] = f.add(series[d], more);
            }
            for (series, by) in self.along.iter_mut().zip([self.twist[1], self.twist[3]]) {
                series[i][d] = f.add(series[i][d], dot(f, *row, by));
            }
        }
        self.angle[d] = f.add(self.angle[d], x);
        self.speed[d - 1] = f.add(self.speed[d - 1], f.mul(f.from_i64(d as i64), x));
        self.sine[d] = f.add(self.sine[d], x);
        let [w, v, ..] = self.twist;
        for i in 0..3 {
            // Row i of ŵ is e_i × w.
            let mut axis = [0; 3];
            axis[i] = f.one();
            let hat = cross(f, axis, w);
            for (entry, h) in at.turn[i].iter_mut().zip(hat) {
                *entry = f.add(*entry, f.mul(x, h));
            }
            at.shift[i] = f.add(at.shift[i], f.mul(x, v[i]));
        }
    }
}

impl SeriesTerm {
    const ZERO: SeriesTerm = SeriesTerm {
        turn: [[0; 3]; 3],
        shift: [0; 3],
    };

    /// Returns the six gaps.
    fn closure_gaps(&self, f: Field) -> [Residue; 6] {
        let half = f.inv(f.from_i64(2));
        let skew = |i: usize, j: usize| f.mul(half, f.sub(self.turn[i][j], self.turn[j][i]));
        let [x, y, z] = self.shift;
        [skew(2, 1), skew(0, 2), skew(1, 0), x, y, z]
    }
}

/// Outcome of a motion that begins with some speeds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Line {
    /// The order at which it is stopped, or `None` if it is not stopped within the expansion.
    pub stopped: Option<usize>,
    /// The order of the expansion, or the order that stops it.
    pub order: usize,
    /// The order by which every coordinate has begun to move that moves at all within that order.
    pub begun: usize,
    /// The obstruction: the gap in the first equation that has one, as the coefficient of that power of t.
    pub value: Residue,
}

/// A motion expanded order by order.
pub(super) struct Expansion<'a> {
    of: &'a Solved,
    walks: Vec<Vec<FreedomPassed>>,
    /// The coordinates of the columns as series from t¹ on.
    coordinates: Vec<Vec<Residue>>,
}

impl<'a> Expansion<'a> {
    /// Creates the expansion to first order of a motion that begins with these speeds, J x = 0.
    pub(super) fn from_speeds(of: &'a Solved, speeds: &[Residue]) -> Expansion<'a> {
        let mut walks = at_rest(of);
        pass_contours(of.field, &mut walks, 1, |c| speeds[c]);
        Expansion {
            of,
            walks,
            coordinates: speeds.iter().map(|&x| vec![x]).collect(),
        }
    }

    /// Adds the terms of the next order, with these coefficients of the free coordinates; those of the pivots follow.
    /// Returns the gaps of that order in the equations that J does not solve.
    pub(super) fn next_order(&mut self, given: impl Fn(usize) -> Residue) -> Vec<Residue> {
        let f = self.of.field;
        let d = self.coordinates.first().map_or(0, Vec::len) + 1;
        let gaps = pass_contours(f, &mut self.walks, d, &given);
        // Couplings are linear: they have no gap of higher order.
        let sums = self.of.solve.iter().map(|row| f.dot(row, &gaps));
        let mut sums: Vec<Residue> = sums.collect();
        let left = sums.split_off(self.of.pivots.len());
        let mut more = vec![0; self.coordinates.len()];
        for (&p, sum) in self.of.pivots.iter().zip(sums) {
            more[p] = f.neg(sum);
        }
        for (c, series) in self.coordinates.iter_mut().enumerate() {
            series.push(f.add(given(c), more[c]));
        }
        for walk in &mut self.walks {
            let mut at = SeriesTerm::ZERO;
            for step in walk {
                step.correct_order(f, d, more[step.column], &mut at);
            }
        }
        left
    }
}

/// Expands a motion that begins with these speeds, J x = 0, until it is stopped, to an order, or as far as the work
/// allows.
///
/// The free coordinates are speed times t plus `bent` times t², which also satisfies J x = 0. Also returns the
/// coordinates of the columns as series from t¹ on, up to the same order.
///
/// # Complexity
/// 12 D² products for each freedom that a contour passes, up to order D.
pub(super) fn expand_line(
    of: &Solved,
    speeds: &[Residue],
    bent: Option<&[Residue]>,
    order: usize,
) -> (Line, Vec<Vec<Residue>>) {
    let mut expansion = Expansion::from_speeds(of, speeds);
    let passed: usize = of.walks.iter().map(Vec::len).sum();
    let products = |d: usize| 30 * d * passed + of.solve.len() * of.solve.len();
    let mut work = products(1);
    let mut out = Line {
        stopped: None,
        order: 1,
        begun: 1,
        value: 0,
    };
    for d in 2..=order {
        work += products(d);
        if work > WORK {
            break;
        }
        let left = expansion.next_order(|c| match bent {
            Some(bent) if d == 2 => bent[c],
            _ => 0,
        });
        out.order = d;
        if let Some(&value) = left.iter().find(|&&x| x != 0) {
            (out.stopped, out.value) = (Some(d), value);
            break;
        }
        let begins = |series: &Vec<Residue>| series.iter().position(|&x| x != 0) == Some(d - 1);
        if expansion.coordinates.iter().any(begins) {
            out.begun = d;
        }
    }
    (out, expansion.coordinates)
}

/// Returns the contours before any motion.
fn at_rest(of: &Solved) -> Vec<Vec<FreedomPassed>> {
    let f = of.field;
    let mut at = SeriesTerm::ZERO;
    (0..3).for_each(|i| at.turn[i][i] = f.one());
    let step = |&(c, forward): &(usize, bool)| {
        let mut step = FreedomPassed::new(f, &of.twists[c], c, forward);
        step.enter_freedom(f, &at);
        step
    };
    let walks = of.walks.iter();
    walks.map(|walk| walk.iter().map(step).collect()).collect()
}

/// Returns the gaps of order `d`, six per contour, with these coefficients of the coordinates.
fn pass_contours(
    f: Field,
    walks: &mut [Vec<FreedomPassed>],
    d: usize,
    given: impl Fn(usize) -> Residue,
) -> Vec<Residue> {
    let mut gaps = Vec::with_capacity(6 * walks.len());
    for walk in walks {
        let mut at = SeriesTerm::ZERO;
        for step in walk {
            step.enter_freedom(f, &at);
            step.pass_freedom(f, d, given(step.column), &mut at);
        }
        gaps.extend(at.closure_gaps(f));
    }
    gaps
}

/// Returns the vector product.
fn cross(f: Field, a: Three, b: Three) -> Three {
    let minor = |i: usize, j: usize| f.sub(f.mul(a[i], b[j]), f.mul(a[j], b[i]));
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

fn dot(f: Field, a: Three, b: Three) -> Residue {
    f.sum_of_products(a.into_iter().zip(b))
}

/// Returns the last coefficient of a product of two series of equal length, by convolution.
fn last_coefficient(f: Field, a: &[Residue], b: &[Residue]) -> Residue {
    f.sum_of_products(a.iter().copied().zip(b.iter().rev().copied()))
}
