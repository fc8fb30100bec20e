//! The twin of the diagram: look at every variant. Kept for checking and for the comparison of speed.

use crate::closure::contour::contour_basis;
use crate::closure::matrix::Closure;
use crate::closure::tree::path_from_frame;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::modp::{Field, Residue};
use crate::model::mechanism::{JointId, LinkId, Mechanism, StateId};
use crate::redundancy::stress::{SelfStress, Verdict, self_stresses};
use crate::search::conditions::Search;
use crate::search::counts::Counts;
use crate::search::held::loose;
use crate::search::space::Space;
use crate::search::spent::Redundancy;
use crate::search::tally::Key;
use num_bigint::BigUint;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// What brute force finds out about one variant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Seen {
    /// Redundant constraints within the mechanism.
    pub internal: u32,
    /// Redundant constraints that the state adds; 0 where no state is searched.
    pub external: i32,
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
    /// `columns[variable][choice]`: full columns (contours and couplings of the free state, kept links, contours and couplings
    /// of the searched one).
    columns: Vec<Vec<Vec<Vec<Residue>>>>,
    /// For each joint without a choice, the columns of every motion.
    whole: Vec<(JointId, Vec<Vec<Residue>>)>,
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
            let added = all.iter().map(move |c| c.direction(j));
            contours.chain(links).chain(added).collect::<Vec<_>>()
        };
        // Couplings by index, those of the free state and those of the searched one.
        let of = |s: StateId| -> Vec<usize> {
            let present =
                |&q: &usize| mechanism.joints[mechanism.couplings[q].ends[0].joint].is_in(s);
            (0..mechanism.couplings.len()).filter(present).collect()
        };
        let (coupled, all_coupled) = (of(StateId::FREE), of(state));
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
            out.extend(rates(&all_coupled));
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
        let fixed = space.variables.iter().filter(|v| v.choices.len() == 1);
        let whole = fixed.flat_map(|v| &v.joints).map(|&j| {
            let rates = mechanism.couplings_of(j).count();
            let every = (0..d).map(|c| {
                let mut twist = vec![0; d + rates];
                twist[c] = f.one();
                column(j, &signs(j), &twist)
            });
            (j, every.collect())
        });
        Matrices {
            whole: whole.collect(),
            field: f,
            free_rows: free.len() * d + coupled.len(),
            kept_rows: kept.len() * d,
            state_rows: space.state.map_or(0, |_| all.len() * d + all_coupled.len()),
            columns,
        }
    }

    /// The redundant constraints within the mechanism that are left with every joint at once free to do what any of its
    /// options allows, and the joints without a choice that would remove some of them.
    #[must_use]
    pub fn freest(&self) -> (usize, Vec<JointId>) {
        let within = |c: &Vec<Residue>| c[..self.free_rows].to_vec();
        let all: Vec<Vec<Residue>> = self
            .columns
            .iter()
            .flatten()
            .flatten()
            .map(within)
            .collect();
        let rank = eliminate(self.field, all.clone()).len();
        let loaded = self.whole.iter().filter(|(_, columns)| {
            let more = columns.iter().map(within);
            eliminate(self.field, all.iter().cloned().chain(more).collect()).len() > rank
        });
        (self.free_rows - rank, loaded.map(|(j, _)| *j).collect())
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
        let int = |x: usize| i32::try_from(x).unwrap_or(i32::MAX);
        let mut external = 0;
        if self.state_rows > 0 {
            let of_state = |c: &Vec<Residue>| c[kept_end..].to_vec();
            let whole = eliminate(self.field, chosen().map(of_state).collect()).len();
            external = int(self.state_rows - whole) - int(self.free_rows - rank);
        }
        Seen {
            internal: u32::try_from(self.free_rows - rank).unwrap_or(u32::MAX),
            external,
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

impl Search {
    /// Counts by looking at every variant: (determinate, admissible). What the searched state makes of a variant is asked of
    /// the mechanism that the variant is.
    ///
    /// # Errors
    /// Where a coordinate has no value in the field.
    ///
    /// # Complexity
    /// One elimination a variant, in parallel over the choices of the first variables, and with a state some more for those
    /// that meet the other conditions.
    pub fn brute(&self) -> Result<(Counts, Counts), ExactError> {
        let matrices = Matrices::new(&self.exact, &self.mechanism, &self.space, &self.kept.0);
        let (mut all, mut good) = (Counts::default(), Counts::default());
        for ((key, admissible), count) in self.count(&matrices)? {
            let count = BigUint::from(count);
            all.add(self.mobility(key), key, &count);
            if admissible && self.wanted(key) {
                good.add(self.mobility(key), key, &count);
            }
        }
        Ok((all, good))
    }

    /// Every variant with few enough redundant constraints, by its properties and whether it is admissible but for mobility
    /// and changes.
    fn count(&self, matrices: &Matrices) -> Result<BTreeMap<(Key, bool), u128>, ExactError> {
        let steps = &self.steps;
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
        let from = |h: usize| {
            let mut counts: BTreeMap<(Key, bool), u128> = BTreeMap::new();
            let mut choices = vec![0; radix.len()];
            let mut rest = h;
            for (c, r) in choices.iter_mut().zip(&radix[..head]) {
                (*c, rest) = (rest % r, rest / r);
            }
            loop {
                if let Some((redundancy, admissible)) = self.look(matrices, &choices)? {
                    let chosen = choices.iter().enumerate();
                    let sum: u128 = chosen.map(|(v, &c)| steps.keys[v][c].0).sum();
                    let key = Key(sum + steps.redundancy(redundancy).0);
                    *counts.entry((key, admissible)).or_insert(0) += 1;
                }
                let Some(v) = (head..radix.len()).find(|&v| choices[v] + 1 < radix[v]) else {
                    return Ok(counts);
                };
                choices[head..v].fill(0);
                choices[v] += 1;
            }
        };
        let merge = |mut a: BTreeMap<_, u128>, b: BTreeMap<_, u128>| {
            for (k, c) in b {
                *a.entry(k).or_insert(0) += c;
            }
            Ok(a)
        };
        (0..heads)
            .into_par_iter()
            .map(from)
            .try_reduce(BTreeMap::new, merge)
    }

    /// A variant's redundancy, and whether it is admissible; `None` where it has too much within.
    fn look(
        &self,
        matrices: &Matrices,
        choices: &[usize],
    ) -> Result<Option<(Redundancy, bool)>, ExactError> {
        let seen = matrices.look(choices);
        if seen.internal > self.conditions.max_redundant {
            return Ok(None);
        }
        let mut found = Redundancy {
            internal: seen.internal,
            external: seen.external,
            harmful: 0,
        };
        let mut good = !self.conditions.keep_output || seen.motion == self.kept.1.len();
        if let Some(s) = self.conditions.state.filter(|_| good) {
            let realized = self.realize(choices);
            let closure = Closure::new(&self.exact, &realized, s.state)?;
            let stresses = self_stresses(&self.exact, &realized, &closure)?;
            let harmful = |t: &&SelfStress| t.external && t.verdict == Verdict::Harmful;
            found.harmful =
                u32::try_from(stresses.iter().filter(harmful).count()).unwrap_or(u32::MAX);
            let beyond = |x: i64, limit: Option<u32>| limit.is_some_and(|l| x > i64::from(l));
            good = !beyond(seen.external.into(), s.max_external)
                && !beyond(found.harmful.into(), s.max_harmful)
                && loose(&self.exact, &realized, s.state, &self.grasps)?.is_empty();
        }
        Ok(Some((found, good)))
    }
}
