//! The gaps of a contour as power series of several variables.

use crate::linalg::modp::{Field, Residue};
use crate::rank::finite::higher_order::line::cross;
use crate::rank::finite::power_series::{Monomials, accumulate};

/// A power series.
type Series = Vec<Residue>;

/// Returns the six gaps of a contour, given by its columns with their directions, if the coordinates `q` of these
/// columns are series.
pub(super) fn gaps(
    f: Field,
    twists: &[Vec<Residue>],
    walk: &[(usize, bool)],
    q: &[Series],
    monomials: &Monomials,
) -> Vec<Series> {
    let mut motion = SeriesMotion::identity(f, monomials);
    for &(c, forward) in walk {
        if q[c].iter().all(|&x| x == 0) {
            continue;
        }
        let angle = if forward {
            q[c].clone()
        } else {
            q[c].iter().map(|&x| f.neg(x)).collect()
        };
        motion.then(&twists[c], angle);
    }
    motion.gaps()
}

/// A displacement whose entries are series.
struct SeriesMotion<'a> {
    field: Field,
    monomials: &'a Monomials,
    /// The rotation, row by row.
    turn: [[Series; 3]; 3],
    shift: [Series; 3],
}

impl<'a> SeriesMotion<'a> {
    fn identity(field: Field, monomials: &'a Monomials) -> SeriesMotion<'a> {
        let zero = || vec![0; monomials.count()];
        let mut turn: [[Series; 3]; 3] = [(); 3].map(|()| [(); 3].map(|()| zero()));
        for (i, row) in turn.iter_mut().enumerate() {
            row[i][0] = field.one();
        }
        SeriesMotion {
            field,
            monomials,
            turn,
            shift: [(); 3].map(|()| zero()),
        }
    }

    /// Appends a displacement by an angle about a twist (ω; v).
    fn then(&mut self, t: &[Residue], angle: Series) {
        let (f, monomials) = (self.field, self.monomials);
        let (w, v) = ([t[0], t[1], t[2]], [t[3], t[4], t[5]]);
        let mut steps: Vec<(Series, [Residue; 3])> = vec![(angle.clone(), v)];
        let mut turned = None;
        if w != [0; 3] {
            let [sine, cosine, rest] = turning(f, monomials, w, angle);
            let once = cross(f, w, v);
            steps.push((cosine.clone(), once));
            steps.push((rest, cross(f, w, once)));
            turned = Some((sine, cosine));
        }
        for (row, shift) in self.turn.iter_mut().zip(&mut self.shift) {
            for (series, direction) in &steps {
                if *direction != [0; 3] {
                    let carried = combined(f, row, *direction);
                    let moved = monomials.product(f, series, &carried);
                    accumulate(f, shift, &moved, f.one());
                }
            }
            if let Some((sine, cosine)) = &turned {
                // Columns of ŵ are w × e_j; a row times ŵ is row × w.
                let hat = |j: usize| cross(f, w, unit(f, j));
                let once: [Series; 3] = [0, 1, 2].map(|j| combined(f, row, hat(j)));
                let twice: [Series; 3] = [0, 1, 2].map(|j| combined(f, &once, hat(j)));
                for j in 0..3 {
                    let a = monomials.product(f, sine, &once[j]);
                    let b = monomials.product(f, cosine, &twice[j]);
                    accumulate(f, &mut row[j], &a, f.one());
                    accumulate(f, &mut row[j], &b, f.one());
                }
            }
        }
    }

    /// Returns rotation and translation as six series that vanish if and only if the displacement does.
    fn gaps(self) -> Vec<Series> {
        let (f, turn) = (self.field, &self.turn);
        let half = f.inv(f.from_i64(2));
        let skew = |a: &[Residue], b: &[Residue]| -> Series {
            let differences = a.iter().zip(b).map(|(&a, &b)| f.sub(a, b));
            differences.map(|x| f.mul(half, x)).collect()
        };
        let mut out = vec![
            skew(&turn[2][1], &turn[1][2]),
            skew(&turn[0][2], &turn[2][0]),
            skew(&turn[1][0], &turn[0][1]),
        ];
        out.extend(self.shift);
        out
    }
}

/// Returns sin, 1 - cos and angle - sin of an angle about an axis that is not a unit vector.
fn turning(f: Field, monomials: &Monomials, axis: [Residue; 3], angle: Series) -> [Series; 3] {
    let square = f.sum_of_products(axis.map(|x| (x, x)));
    let zero = || vec![0; monomials.count()];
    let mut series = [angle.clone(), zero(), zero()];
    let (mut power, mut factor) = (angle.clone(), f.one());
    for n in 2..=monomials.degree() {
        power = monomials.product(f, &power, &angle);
        factor = f.mul(factor, f.inv(f.from_i64(n as i64)));
        let mut by = factor;
        let (kind, half) = if n % 2 == 1 {
            (0, n / 2)
        } else {
            (1, n / 2 - 1)
        };
        for _ in 0..half {
            by = f.neg(f.mul(by, square));
        }
        accumulate(f, &mut series[kind], &power, by);
        if n % 2 == 1 {
            let mut by = factor;
            for _ in 0..n / 2 - 1 {
                by = f.neg(f.mul(by, square));
            }
            accumulate(f, &mut series[2], &power, by);
        }
    }
    series
}

/// Returns a linear combination of series.
fn combined(f: Field, series: &[Series; 3], by: [Residue; 3]) -> Series {
    let mut out = vec![0; series[0].len()];
    for (s, b) in series.iter().zip(by).filter(|(_, b)| *b != 0) {
        for (o, &x) in out.iter_mut().zip(s) {
            *o = f.add(*o, f.mul(x, b));
        }
    }
    out
}

fn unit(f: Field, j: usize) -> [Residue; 3] {
    [0, 1, 2].map(|i| if i == j { f.one() } else { 0 })
}
