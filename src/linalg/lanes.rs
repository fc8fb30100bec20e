//! Rank of small dense matrices modulo a prime of 28 or 31 bits, eight entries at a time.
//!
//! Entries are 32-bit residues in 64-bit lanes. Two pivots are taken at once and rows cleared crosswise,
//! `v ← reduce(d·v - e·u - g·w)` with pivot rows `u`, `w` and minors `d`, `e`, `g`: three products and one reduction for
//! two columns, and never an inverse, as rows may be scaled as one likes. The sum of products fits 64 bits with residues
//! only loosely reduced, so that reducing needs no comparison: modulo the Mersenne prime 2^31 - 1 two shifts and
//! additions, modulo any prime below 2^28 Montgomery's two products.
//!
//! The loops are plain ones over arrays of eight that the compiler makes vector code of; [`pulp`] compiles them for the
//! instruction sets that the machine may have and picks one at run time.
//!
//! # How sure
//! A rank modulo p is never too high, and too low only where p divides every largest nonzero minor. For a minor that
//! behaves like a random number that happens about once in p: 5·10^-10 for 2^31 - 1, 4·10^-9 for one prime of 28 bits,
//! 2·10^-18 for both, 4·10^-19 for one prime of 61 bits. The program's answers rest on two primes of 61 bits and
//! `rank::modular`, which uses the structure of J: on the ten-link gripper that takes as long as both small primes here
//! (0.7 µs), from some tens of contours on it is faster than one of them, and primes of 61 bits in which the geometry's
//! roots exist are easy to find. This kernel is for dense matrices without structure.
//!
//! # Sources
//! Montgomery, "Modular multiplication without trial division", Math. Comp. 44 (1985); Bareiss, Math. Comp. 22 (1968),
//! for elimination without division.

use pulp::{Arch, Simd, WithSimd};

/// Entries that are worked on together.
const LANES: usize = 8;
/// The lower halves of 64 bits.
const LOW: u64 = 0xffff_ffff;

type Lane = [u64; LANES];

/// [`SmallField::MERSENNE`].
const M31: u64 = SmallField::MERSENNE as u64;

/// The integers modulo a small prime.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SmallField {
    p: u64,
    /// -p^-1 mod 2^32
    neg_inv: u64,
}

impl SmallField {
    /// 2^31 - 1, modulo which the kernel is fastest.
    pub const MERSENNE: u32 = (1 << 31) - 1;
    /// The greatest prime below 2^28.
    pub const GREATEST: u32 = 268_435_399;

    /// The field of `p` elements.
    ///
    /// # Panics
    /// If `p` is neither 2^31 - 1 nor an odd number below 2^28. That `p` is prime is the caller's promise; see
    /// [`is_prime`](crate::linalg::modp::is_prime).
    #[must_use]
    pub fn new(p: u32) -> Self {
        assert!(
            p == Self::MERSENNE || p & 1 == 1 && (3..1 << 28).contains(&p),
            "modulus out of range"
        );
        let p = u64::from(p);
        let mut inv = p;
        for _ in 0..5 {
            inv = inv.wrapping_mul(2u64.wrapping_sub(p.wrapping_mul(inv)));
        }
        SmallField {
            p,
            neg_inv: inv.wrapping_neg() & LOW,
        }
    }

    /// The modulus.
    #[must_use]
    pub fn modulus(self) -> u64 {
        self.p
    }
}

/// How sums of three products come back under 32 bits. Scaling by a constant is allowed.
trait Reduction: Copy {
    /// A residue of `t`, for t of at most three products of what this returns.
    fn reduce(self, t: u64) -> u64;
    /// A residue of `-x`, for x as returned by `reduce`, under the same bound.
    fn neg(self, x: u64) -> u64;
    /// Whether a residue, as returned by either, is that of zero.
    fn is_zero(self, x: u64) -> bool;
}

/// Modulo 2^31 - 1, residues of at most p + 5: three products of such stay below 2^64.
#[derive(Clone, Copy)]
struct Mersenne;

impl Reduction for Mersenne {
    #[inline(always)]
    fn reduce(self, t: u64) -> u64 {
        let t = (t & M31) + (t >> 31);
        (t & M31) + (t >> 31)
    }

    #[inline(always)]
    fn neg(self, x: u64) -> u64 {
        if x > M31 { 2 * M31 - x } else { M31 - x }
    }

    #[inline(always)]
    fn is_zero(self, x: u64) -> bool {
        x == 0 || x == M31
    }
}

/// Modulo p < 2^28, residues of at most 2p: three products are at most 12p², which 2^32 divides down to less than p.
#[derive(Clone, Copy)]
struct Montgomery(SmallField);

impl Reduction for Montgomery {
    #[inline(always)]
    fn reduce(self, t: u64) -> u64 {
        let m = (t & LOW) * (self.0.neg_inv & LOW);
        (t + (m & LOW) * (self.0.p & LOW)) >> 32
    }

    #[inline(always)]
    fn neg(self, x: u64) -> u64 {
        2 * self.0.p - x
    }

    #[inline(always)]
    fn is_zero(self, x: u64) -> bool {
        x == 0 || x == self.0.p || x == 2 * self.0.p
    }
}

/// A dense matrix modulo a small prime.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LaneMatrix {
    field: SmallField,
    /// Rows of `stride` groups of eight; the rows are the shorter side.
    rows: Vec<Lane>,
    stride: usize,
    height: usize,
    width: usize,
}

impl LaneMatrix {
    /// The matrix with the given entries, plain integers; what they are above p does not matter.
    pub fn from_fn(
        field: SmallField,
        rows: usize,
        columns: usize,
        entry: impl Fn(usize, usize) -> u64,
    ) -> Self {
        // The rank is that of the transpose, and long rows fill the lanes better.
        let turned = rows > columns;
        let (height, width) = if turned {
            (columns, rows)
        } else {
            (rows, columns)
        };
        let stride = width.div_ceil(LANES);
        let mut out = vec![[0; LANES]; height * stride];
        for r in 0..height {
            for c in 0..width {
                let x = if turned { entry(c, r) } else { entry(r, c) };
                out[r * stride + c / LANES][c % LANES] = x % field.p;
            }
        }
        LaneMatrix {
            field,
            rows: out,
            stride,
            height,
            width,
        }
    }

    /// The rank modulo the prime.
    ///
    /// # Complexity
    /// O(rank · rows · columns / 8) vector operations, about five multiplications for each eight entries and two pivots.
    #[must_use]
    pub fn rank(&self) -> usize {
        self.rank_with(&mut Vec::new())
    }

    /// The rank, in memory that is used again.
    #[must_use]
    pub fn rank_with(&self, scratch: &mut Vec<[u64; 8]>) -> usize {
        scratch.clear();
        scratch.extend_from_slice(&self.rows);
        Arch::new().dispatch(Job {
            of: self,
            rows: scratch,
        })
    }
}

struct Job<'a> {
    of: &'a LaneMatrix,
    rows: &'a mut [Lane],
}

impl WithSimd for Job<'_> {
    type Output = usize;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> usize {
        if self.of.field.p == M31 {
            eliminate(Mersenne, self.of, self.rows)
        } else {
            eliminate(Montgomery(self.of.field), self.of, self.rows)
        }
    }
}

/// `v ← reduce(b·v + a·u)`.
#[inline(always)]
fn one_pivot<R: Reduction>(f: R, [b, a]: [u64; 2], v: &mut [Lane], u: &[Lane]) {
    for (v, u) in v.iter_mut().zip(u) {
        // Read whole before anything is written, so that the compiler need not fear that they overlap.
        let (x, y) = (*v, *u);
        for i in 0..LANES {
            v[i] = f.reduce((b & LOW) * (x[i] & LOW) + (a & LOW) * (y[i] & LOW));
        }
    }
}

/// `v ← reduce(d·v + e·u + g·w)`; nothing where that would only scale the row.
#[inline(always)]
fn two_pivots<R: Reduction>(f: R, [d, e, g]: [u64; 3], v: &mut [Lane], u: &[Lane], w: &[Lane]) {
    if f.is_zero(e) && f.is_zero(g) {
        return;
    }
    for ((v, u), w) in v.iter_mut().zip(u).zip(w) {
        let (x, y, z) = (*v, *u, *w);
        for i in 0..LANES {
            let t = (d & LOW) * (x[i] & LOW) + (e & LOW) * (y[i] & LOW);
            v[i] = f.reduce(t + (g & LOW) * (z[i] & LOW));
        }
    }
}

/// Swaps two rows from a group on.
#[inline(always)]
fn swap(rows: &mut [Lane], stride: usize, [a, b]: [usize; 2], from: usize) {
    if a != b {
        for j in from..stride {
            rows.swap(a * stride + j, b * stride + j);
        }
    }
}

#[inline(always)]
fn eliminate<R: Reduction>(f: R, of: &LaneMatrix, rows: &mut [Lane]) -> usize {
    let (stride, height) = (of.stride, of.height);
    let (mut rank, mut c) = (0, 0);
    while c < of.width && rank < height {
        // Groups left of the pivot's are never looked at again; within its group what is left of it is.
        let (group, lane) = (c / LANES, c % LANES);
        let mut pivot = rank;
        while pivot < height && f.is_zero(rows[pivot * stride + group][lane]) {
            pivot += 1;
        }
        if pivot == height {
            c += 1;
            continue;
        }
        swap(rows, stride, [rank, pivot], group);
        let (above, below) = rows.split_at_mut((rank + 1) * stride);
        let u = &above[rank * stride + group..];
        let b = u[0][lane];
        c += 1;
        rank += 1;
        // The entry of each row in the next column, once this one is cleared.
        let (next, next_lane) = (c / LANES - group, c % LANES);
        let cleared = |v: &[Lane], y: u64| f.reduce(b * v[next][next_lane] + f.neg(v[0][lane]) * y);
        let left = height - rank;
        let mut second = left;
        if c < of.width {
            let y = u[next][next_lane];
            second = 0;
            while second < left && f.is_zero(cleared(&below[second * stride + group..], y)) {
                second += 1;
            }
        }
        if second == left {
            for v in below.chunks_exact_mut(stride) {
                let v = &mut v[group..];
                let a = f.neg(v[0][lane]);
                one_pivot(f, [b, a], v, u);
            }
            continue;
        }
        swap(below, stride, [0, second], group);
        let (w, below) = below.split_at_mut(stride);
        let w = &mut w[group..];
        let a = f.neg(w[0][lane]);
        one_pivot(f, [b, a], w, u);
        let (y, b2) = (u[next][next_lane], w[next][next_lane]);
        let d = f.reduce(b * b2);
        for v in below.chunks_exact_mut(stride) {
            let v = &mut v[group..];
            let e = f.neg(f.reduce(b2 * v[0][lane]));
            let g = f.neg(cleared(v, y));
            two_pivots(f, [d, e, g], v, u, w);
        }
        c += 1;
        rank += 1;
    }
    rank
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::modp::is_prime;
    use proptest::prelude::*;

    /// The slow twin: rank by the textbook, on wide integers.
    fn textbook(p: u64, mut m: Vec<Vec<u64>>) -> usize {
        let inverse = |a: u64| {
            (0..62).rev().fold(1, |acc, i| {
                let square = acc * acc % p;
                if (p - 2) >> i & 1 == 1 {
                    square * a % p
                } else {
                    square
                }
            })
        };
        let mut rank = 0;
        for c in 0..m.first().map_or(0, Vec::len) {
            let Some(r) = (rank..m.len()).find(|&r| m[r][c] != 0) else {
                continue;
            };
            m.swap(rank, r);
            let scale = inverse(m[rank][c]);
            for r in rank + 1..m.len() {
                let a = m[r][c] * scale % p;
                for j in c..m[r].len() {
                    m[r][j] = (m[r][j] + (p - a) * m[rank][j]) % p;
                }
            }
            rank += 1;
        }
        rank
    }

    #[test]
    fn the_primes_are_what_they_are_said_to_be() {
        let p = u64::from(SmallField::GREATEST);
        assert!(is_prime(M31));
        assert_eq!((0..1 << 28).rev().find(|&n| is_prime(n)), Some(p));
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 512, ..ProptestConfig::default() })]
        #[test]
        fn ranks_are_those_of_the_textbook(
            which in 0usize..5,
            (rows, columns, inner) in (1usize..34, 1usize..34, 0usize..34),
            seed in any::<u64>(),
            sparse in any::<bool>(),
        ) {
            // Small primes make chance zeros common.
            let p = [3u32, 7, 101, SmallField::GREATEST, SmallField::MERSENNE][which];
            let modulus = u64::from(p);
            let mut state = seed | 1;
            let mut random = || {
                state ^= state << 13;
                state ^= state >> 7;
                state ^= state << 17;
                if sparse && state >> 61 != 0 { 0 } else { (state >> 8) % modulus }
            };
            // A product of thin matrices, so that ranks fall short.
            let mut thin = |r: usize, c: usize| -> Vec<Vec<u64>> {
                (0..r).map(|_| (0..c).map(|_| random()).collect()).collect()
            };
            let (left, right) = (thin(rows, inner), thin(inner, columns));
            let m: Vec<Vec<u64>> = left
                .iter()
                .map(|l| {
                    let dot = |c: usize| l.iter().zip(&right).fold(0, |s, (x, r)| (s + x * r[c]) % modulus);
                    (0..columns).map(dot).collect()
                })
                .collect();
            let lanes = LaneMatrix::from_fn(SmallField::new(p), rows, columns, |r, c| m[r][c]);
            prop_assert_eq!(lanes.rank(), textbook(modulus, m));
        }
    }
}
