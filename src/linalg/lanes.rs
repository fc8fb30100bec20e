//! Rank of small dense matrices modulo a prime below 2^31, eight entries at a time.
//!
//! Entries are 32-bit residues in 64-bit lanes. A row is cleared crosswise, `v ← redc(b·v - a·u)` with pivot row `u`,
//! pivot `b` and the row's own entry `a`: no inverse is ever taken, Montgomery's factor 2^-32 scales the whole row, and
//! one reduction serves both products. Below 2^28 residues are kept between 0 and 2p, which the reduction maps into
//! itself without a comparison, and two pivots are taken at once, so that three products and one reduction clear two
//! columns (five multiplications for the eight of two single steps). Primes from 2^28 on take one pivot at a time, and a
//! correction.
//!
//! The loops are plain ones over arrays of eight that the compiler makes vector code of; [`pulp`] compiles them for the
//! instruction sets that the machine may have and picks one at run time.
//!
//! # How sure
//! A rank modulo p is never too high, and too low only where p divides every largest nonzero minor. For a minor that
//! behaves like a random number that happens about once in p: 4·10^-9 for one prime of 28 bits, 10^-17 for two, less
//! than one prime of 61 bits gives (4·10^-19) for three. The program's answers rest on two primes of 61 bits and
//! `rank::modular`, which uses the structure of J instead; three passes here are no faster than
//! that on the matrices of mechanisms. This kernel is for dense matrices without structure.
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

/// The integers modulo an odd prime below 2^31.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SmallField {
    p: u64,
    /// -p^-1 mod 2^32
    neg_inv: u64,
    /// 2^64 mod p, multiplies a plain integer into Montgomery form
    r2: u64,
}

impl SmallField {
    /// The greatest prime below 2^28: below it two pivots are taken at once.
    pub const FAST_PRIME: u32 = 268_435_399;

    /// The field of `p` elements.
    ///
    /// # Panics
    /// If `p` is even, below 3 or not below 2^31. That `p` is prime is the caller's promise; see
    /// [`is_prime`](crate::linalg::modp::is_prime).
    #[must_use]
    pub fn new(p: u32) -> Self {
        assert!(
            p & 1 == 1 && (3..1 << 31).contains(&p),
            "modulus out of range"
        );
        let p = u64::from(p);
        let mut inv = p;
        for _ in 0..5 {
            inv = inv.wrapping_mul(2u64.wrapping_sub(p.wrapping_mul(inv)));
        }
        let r = (1u64 << 32) % p;
        SmallField {
            p,
            neg_inv: inv.wrapping_neg() & LOW,
            r2: r * r % p,
        }
    }

    /// The modulus.
    #[must_use]
    pub fn modulus(self) -> u64 {
        self.p
    }

    /// `t / 2^32`, up to a multiple of p: at most t / 2^32 + p.
    #[inline(always)]
    fn redc(self, t: u64) -> u64 {
        let m = (t & LOW) * (self.neg_inv & LOW);
        (t + (m & LOW) * (self.p & LOW)) >> 32
    }

    /// Brings a value below 2p under the bound that the kernel keeps: p for large primes, 2p for small ones.
    #[inline(always)]
    fn correct<const LARGE: bool>(self, x: u64) -> u64 {
        // Signed comparisons are what the older vector units have.
        if LARGE && x as i64 >= self.p as i64 {
            x - self.p
        } else {
            x
        }
    }

    #[inline(always)]
    fn is_zero(self, x: u64) -> bool {
        x == 0 || x == self.p
    }

    /// `-x`, for x of at most 2p.
    #[inline(always)]
    fn neg<const LARGE: bool>(self, x: u64) -> u64 {
        if LARGE { self.p - x } else { 2 * self.p - x }
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
                let x = field.redc(x % field.p * field.r2);
                out[r * stride + c / LANES][c % LANES] = field.correct::<true>(x);
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
        if self.of.field.p < 1 << 28 {
            eliminate::<false>(self.of, self.rows)
        } else {
            eliminate::<true>(self.of, self.rows)
        }
    }
}

/// `v ← redc(b·v + a·u)`.
#[inline(always)]
fn one_pivot<const LARGE: bool>(f: SmallField, [b, a]: [u64; 2], v: &mut [Lane], u: &[Lane]) {
    for (v, u) in v.iter_mut().zip(u) {
        for i in 0..LANES {
            let t = (b & LOW) * (v[i] & LOW) + (a & LOW) * (u[i] & LOW);
            v[i] = f.correct::<LARGE>(f.redc(t));
        }
    }
}

/// `v ← redc(d·v + e·u + g·w)`. All below 2p, the sum is at most 12p², and comes back below 2p for p < 2^32 / 12.
#[inline(always)]
fn two_pivots(f: SmallField, [d, e, g]: [u64; 3], v: &mut [Lane], u: &[Lane], w: &[Lane]) {
    for ((v, u), w) in v.iter_mut().zip(u).zip(w) {
        for i in 0..LANES {
            let t = (d & LOW) * (v[i] & LOW) + (e & LOW) * (u[i] & LOW) + (g & LOW) * (w[i] & LOW);
            v[i] = f.redc(t);
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
fn eliminate<const LARGE: bool>(of: &LaneMatrix, rows: &mut [Lane]) -> usize {
    let (f, stride, height) = (of.field, of.stride, of.height);
    let (mut rank, mut c) = (0, 0);
    while c < of.width && rank < height {
        // Groups left of the pivot's are never looked at again; within its group what is left of it is.
        let (group, lane) = (c / LANES, c % LANES);
        let pivot = (rank..height).find(|r| !f.is_zero(rows[r * stride + group][lane]));
        let Some(pivot) = pivot else {
            c += 1;
            continue;
        };
        swap(rows, stride, [rank, pivot], group);
        let (above, below) = rows.split_at_mut((rank + 1) * stride);
        let u = &above[rank * stride + group..];
        let b = u[0][lane];
        c += 1;
        rank += 1;
        // The entry of each row in the next column, once this one is cleared.
        let (next, next_lane) = (c / LANES - group, c % LANES);
        let cleared =
            |v: &[Lane], y: u64| f.redc(b * v[next][next_lane] + f.neg::<LARGE>(v[0][lane]) * y);
        let second = if LARGE || c == of.width {
            None
        } else {
            let y = u[next][next_lane];
            let mut left = below.chunks_exact(stride);
            left.position(|v| !f.is_zero(cleared(&v[group..], y)))
        };
        let Some(second) = second else {
            for v in below.chunks_exact_mut(stride) {
                let v = &mut v[group..];
                let a = f.neg::<LARGE>(v[0][lane]);
                one_pivot::<LARGE>(f, [b, a], v, u);
            }
            continue;
        };
        swap(below, stride, [0, second], group);
        let (w, below) = below.split_at_mut(stride);
        let w = &mut w[group..];
        let a = f.neg::<LARGE>(w[0][lane]);
        one_pivot::<LARGE>(f, [b, a], w, u);
        let (y, b2) = (u[next][next_lane], w[next][next_lane]);
        let d = f.redc(b * b2);
        for v in below.chunks_exact_mut(stride) {
            let v = &mut v[group..];
            let e = f.neg::<LARGE>(f.redc(b2 * v[0][lane]));
            let g = f.neg::<LARGE>(cleared(v, y));
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
    fn the_fast_prime_is_the_greatest_below_2_to_the_28() {
        let p = u64::from(SmallField::FAST_PRIME);
        assert_eq!((0..1 << 28).rev().find(|&n| is_prime(n)), Some(p));
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 512, ..ProptestConfig::default() })]
        #[test]
        fn ranks_are_those_of_the_textbook(
            which in 0usize..6,
            (rows, columns, inner) in (1usize..34, 1usize..34, 0usize..34),
            seed in any::<u64>(),
            sparse in any::<bool>(),
        ) {
            // Small primes make chance zeros common.
            let p = [3u32, 7, 101, SmallField::FAST_PRIME, (1 << 29) - 3, (1 << 31) - 1][which];
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
