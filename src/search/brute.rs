//! The twin of the diagram: look at every variant. Kept for checking and for the comparison of speed.

use crate::closure::contour::contour_basis;
use crate::closure::tree::path_from_frame;
use crate::geom::exact::ExactField;
use crate::linalg::modp::{Field, Residue};
use crate::model::mechanism::{JointId, LinkId, Mechanism, StateId};
use crate::search::space::Space;
use crate::search::tally::{Key, Steps};
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

/// The closure matrices of all variants at once: every choice's columns, written out.
#[derive(Debug)]
pub struct Matrices {
    field: Field,
    free_rows: usize,
    kept_rows: usize,
    state_rows: usize,
    /// `columns[variable][choice]`: full columns (free contours and couplings, kept links, the state's own contours and
    /// couplings).
    columns: Vec<Vec<Vec<Vec<Residue>>>>,
}

impl Matrices {
    /// Writes the columns of a space out; `kept` are the links whose motion matters.
    #[must_use]
    pub fn new(
        exact: &ExactField,
        mechanism: &Mechanism,
        space: &Space,
        kept: &[LinkId],
    ) -> Matrices {
        let (f, d) = (exact.field(), space.dim);
        let free = contour_basis(mechanism, StateId::FREE);
        let state: StateId = space.state.unwrap_or(StateId::FREE);
        let all = contour_basis(mechanism, state);
        let paths: Vec<Vec<(JointId, bool)>> = kept
            .iter()
            .map(|&l| path_from_frame(mechanism, StateId::FREE, l))
            .collect();
        let signs = |j: JointId| {
            let contours = free.iter().map(move |c| c.direction(j));
            let links = paths
                .iter()
                .map(move |p| p.iter().find(|(q, _)| *q == j).map(|(_, s)| *s));
            let added = all[free.len()..].iter().map(move |c| c.direction(j));
            contours.chain(links).chain(added).collect::<Vec<_>>()
        };
        // Couplings by index, those of the free state and those that the state adds.
        let present = |q: usize, s: StateId| {
            let states = &mechanism.joints[mechanism.couplings[q].ends[0].joint].states;
            states.as_ref().is_none_or(|of| of.contains(&s))
        };
        let all_couplings = 0..mechanism.couplings.len();
        let coupled: Vec<usize> = all_couplings
            .clone()
            .filter(|&q| present(q, StateId::FREE))
            .collect();
        let adds = |q: &usize| present(*q, state) && !present(*q, StateId::FREE);
        let added_couplings: Vec<usize> = all_couplings.filter(adds).collect();
        let column = |j: JointId, signs: &[Option<bool>], twist: &[Residue]| {
            let mut blocks = signs.iter().map(|sign| {
                let mut block = vec![0; d];
                if let Some(plus) = sign {
                    f.accumulate(&mut block, &twist[..d], *plus);
                }
                block
            });
            let rates = |list: &[usize]| -> Vec<Residue> {
                let at = |q: usize| mechanism.couplings_of(j).position(|(c, _)| c == q);
                let entry = |&q: &usize| at(q).map_or(0, |i| twist[d + i]);
                list.iter().map(entry).collect()
            };
            let mut out = blocks
                .by_ref()
                .take(free.len())
                .flatten()
                .collect::<Vec<_>>();
            out.extend(rates(&coupled));
            out.extend(blocks.flatten());
            out.extend(rates(&added_couplings));
            out
        };
        let columns = space
            .variables
            .iter()
            .map(|v| {
                let signs: Vec<_> = v.joints.iter().map(|&j| (j, signs(j))).collect();
                let of_choice = |spans: &[Vec<Vec<Residue>>]| {
                    spans
                        .iter()
                        .zip(&signs)
                        .flat_map(|(span, (j, s))| span.iter().map(|t| column(*j, s, t)))
                        .collect()
                };
                v.choices.iter().map(|c| of_choice(&c.spans)).collect()
            })
            .collect();
        Matrices {
            field: f,
            free_rows: free.len() * d + coupled.len(),
            kept_rows: kept.len() * d,
            state_rows: (all.len() - free.len()) * d + added_couplings.len(),
            columns,
        }
    }

    /// Looks at one variant.
    #[must_use]
    pub fn look(&self, choices: &[usize]) -> Seen {
        let chosen = || {
            choices
                .iter()
                .enumerate()
                .flat_map(|(v, &c)| &self.columns[v][c])
        };
        let kept_end = self.free_rows + self.kept_rows;
        let pivots = eliminate(
            self.field,
            chosen().map(|c| c[..kept_end].to_vec()).collect(),
        );
        let rank = pivots.iter().filter(|&&p| p < self.free_rows).count();
        let mut external = 0;
        if self.state_rows > 0 {
            let without_kept = |c: &Vec<Residue>| [&c[..self.free_rows], &c[kept_end..]].concat();
            let whole = eliminate(self.field, chosen().map(without_kept).collect()).len();
            external = self.state_rows - (whole - rank);
        }
        Seen {
            internal: u32::try_from(self.free_rows - rank).unwrap_or(u32::MAX),
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
