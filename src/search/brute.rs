//! The twin of the diagram: look at every variant. Kept for checking and for the comparison of speed.

use crate::linalg::modp::{Field, Residue};
use crate::search::conditions::Search;
use crate::search::counts::Counts;
use crate::search::tally::{Key, Steps};
use crate::search::written_out::WrittenOut;
use num_bigint::BigUint;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// What brute force finds out about one variant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Seen {
    /// Redundant constraints within the mechanism.
    pub internal: u32,
    /// Redundant constraints that the state adds; 0 where no state is searched.
    pub external: u32,
    /// Dimension of the kept links' motion.
    pub motion: usize,
}

/// The closure matrices of all variants at once, over a prime field.
#[derive(Debug)]
pub struct Matrices {
    field: Field,
    all: WrittenOut<Residue>,
}

impl Matrices {
    /// Writes the columns of a search's space out.
    #[must_use]
    pub fn new(search: &Search) -> Matrices {
        let variables = search.space.variables.iter();
        let spans: Vec<_> = variables
            .map(|v| v.choices.iter().map(|c| c.spans.clone()).collect())
            .collect();
        Matrices {
            field: search.field().field(),
            all: WrittenOut::new(search.field(), search, &spans),
        }
    }

    /// Looks at one variant.
    #[must_use]
    pub fn look(&self, choices: &[usize]) -> Seen {
        let [free, kept, state] = self.all.rows;
        let chosen = || self.all.chosen(choices);
        let pivots = eliminate(
            self.field,
            chosen().map(|c| c[..free + kept].to_vec()).collect(),
        );
        let rank = pivots.iter().filter(|&&p| p < free).count();
        let mut external = 0;
        if state > 0 {
            let without_kept = |c: &Vec<Residue>| [&c[..free], &c[free + kept..]].concat();
            let whole = eliminate(self.field, chosen().map(without_kept).collect()).len();
            external = state - (whole - rank);
        }
        Seen {
            internal: u32::try_from(free - rank).unwrap_or(u32::MAX),
            external: u32::try_from(external).unwrap_or(u32::MAX),
            motion: pivots.len() - rank,
        }
    }
}

/// Plain Gaussian elimination of some vectors; the columns of the pivots.
fn eliminate(f: Field, mut vectors: Vec<Vec<Residue>>) -> Vec<usize> {
    let width = vectors.first().map_or(0, Vec::len);
    let (mut pivots, mut done) = (Vec::new(), 0);
    for c in 0..width {
        let Some(i) = (done..vectors.len()).find(|&i| vectors[i][c] != 0) else {
            continue;
        };
        vectors.swap(done, i);
        let (above, below) = vectors.split_at_mut(done + 1);
        let pivot = &above[done];
        // Cross-multiplication needs no inverse.
        for v in below.iter_mut().filter(|v| v[c] != 0) {
            let (a, b) = (pivot[c], v[c]);
            for (x, &y) in v[c..].iter_mut().zip(&pivot[c..]) {
                *x = f.sub(f.mul(a, *x), f.mul(b, y));
            }
        }
        pivots.push(c);
        done += 1;
    }
    pivots
}

/// Counts every variant of a space by its properties and by the class that `class` puts it in; those without are left out.
///
/// # Complexity
/// One elimination a variant, in parallel over the choices of the first variables.
#[must_use]
pub fn count(
    matrices: &Matrices,
    steps: &Steps,
    class: impl Fn(Seen) -> Option<bool> + Sync,
) -> BTreeMap<(Key, bool), u128> {
    let radix: Vec<usize> = steps.keys.iter().map(Vec::len).collect();
    let head = radix
        .iter()
        .scan(1usize, |p, &r| {
            *p = p.saturating_mul(r);
            Some(*p)
        })
        .take_while(|&p| p <= 4096)
        .count();
    let heads: usize = radix[..head].iter().product();
    (0..heads)
        .into_par_iter()
        .map(|h| {
            let mut counts: BTreeMap<(Key, bool), u128> = BTreeMap::new();
            let mut choices = vec![0; radix.len()];
            let mut rest = h;
            for (c, r) in choices.iter_mut().zip(&radix[..head]) {
                (*c, rest) = (rest % r, rest / r);
            }
            loop {
                let seen = matrices.look(&choices);
                if let Some(class) = class(seen) {
                    let sum: u128 = choices
                        .iter()
                        .enumerate()
                        .map(|(v, &c)| steps.keys[v][c].0)
                        .sum();
                    let key = Key(sum + Key::new(0, 0, 0, seen.internal, seen.external).0);
                    *counts.entry((key, class)).or_insert(0) += 1;
                }
                let Some(v) = (head..radix.len()).find(|&v| choices[v] + 1 < radix[v]) else {
                    break;
                };
                choices[head..v].fill(0);
                choices[v] += 1;
            }
            counts
        })
        .reduce(BTreeMap::new, |mut a, b| {
            for (k, c) in b {
                *a.entry(k).or_insert(0) += c;
            }
            a
        })
}

impl Search {
    /// The properties of a variant, from its choices and its redundant constraints.
    #[must_use]
    pub fn key(&self, choices: &[usize], internal: u32, external: u32) -> Key {
        let keys = self.steps.keys.iter().zip(choices);
        let sum: u128 = keys.map(|(keys, &c)| keys[c].0).sum();
        Key(sum + Key::new(0, 0, 0, internal, external).0)
    }

    /// Whether a variant that is like this is determinate, and if so whether it is admissible but for W and changes, which
    /// [`Search::wanted`] knows.
    #[must_use]
    pub fn class(&self, seen: Seen) -> Option<bool> {
        let (keep, state) = (self.conditions.keep_output, self.conditions.state);
        let admissible = (!keep || seen.motion == self.kept.1.len())
            && state.is_none_or(|(_, most)| seen.external <= most);
        (seen.internal <= self.conditions.max_redundant).then_some(admissible)
    }

    /// Counts by looking at every variant: (determinate, admissible).
    #[must_use]
    pub fn brute(&self) -> (Counts, Counts) {
        let matrices = Matrices::new(self);
        let class = |seen| self.class(seen);
        let (mut all, mut good) = (Counts::default(), Counts::default());
        for ((key, admissible), n) in count(&matrices, &self.steps, class) {
            let n = BigUint::from(n);
            all.add(self.mobility(key), key, &n);
            if admissible && self.wanted(key) {
                good.add(self.mobility(key), key, &n);
            }
        }
        (all, good)
    }
}
