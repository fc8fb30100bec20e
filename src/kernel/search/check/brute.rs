//! Brute force: examines every variant. It is used for checks and for comparisons of speed.

use crate::closure::Closure;
use crate::geom::exact::ExactError;
use crate::linalg::modp::{Field, Residue};
use crate::model::mechanism::JointId;
use crate::redundancy::stress::harmful_count;
use crate::search::answer::counts::Counts;
use crate::search::answer::keys::Key;
use crate::search::answer::search_counts::SearchCounts;
use crate::search::check::full_matrices::{RowLayout, WrittenOut};
use crate::search::check::variant_mechanism::realize_variant;
use crate::search::diagram::redundancy_so_far::Redundancy;
use crate::search::question::Question;
use crate::search::question::grasp::loose_bodies;
use crate::search::question::throughout::ORDER;
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
    /// True if the variant keeps the original motion throughout the motion of the mechanism as built. `None` if the search
    /// does not need it, or if the variant has redundant constraints in the drawn pose.
    pub lasts: Option<bool>,
}

impl Seen {
    /// Creates the result from three ranks: of the free state's rows, of these with the kept links' motion, and of the
    /// searched state's.
    #[must_use]
    pub fn of_ranks(
        [free, _, state]: [usize; 3],
        [rank, with_kept]: [usize; 2],
        of_state: Option<usize>,
    ) -> Seen {
        let int = |x: usize| i32::try_from(x).unwrap_or(i32::MAX);
        Seen {
            internal: u32::try_from(free - rank).unwrap_or(u32::MAX),
            external: of_state.map_or(0, |r| int(state - r) - int(free - rank)),
            motion: with_kept.saturating_sub(rank),
            lasts: None,
        }
    }
}

/// The closure matrices of all variants at once, over a prime field.
#[derive(Debug)]
pub struct Matrices {
    field: Field,
    all: WrittenOut<Residue>,
    /// The matrices along the motion, with the dimension of the original joints' kept motion there.
    along: Option<(WrittenOut<Residue>, usize)>,
    /// For each joint without a choice, the columns of every motion.
    whole: Vec<(JointId, Vec<Vec<Residue>>)>,
}

impl Matrices {
    /// Writes the columns of a search's space out.
    #[must_use]
    pub fn new(question: &Question) -> Matrices {
        let (f, variables) = (question.field().field(), &question.space.variables);
        let layout = RowLayout::new(question);
        let fixed = variables.iter().filter(|v| v.choices.len() == 1);
        let whole = fixed.flat_map(|v| &v.joints).map(|&j| {
            let rates = question.mechanism.rates_of(j);
            let every = (0..question.space.dim).map(|c| {
                let mut twist = vec![0; question.space.dim + rates];
                twist[c] = f.one();
                layout.joint_column(question.field(), j, &twist)
            });
            (j, every.collect())
        });
        let present = vec![0; variables.len()];
        let along = layout.along_motion(question, ORDER).map(|along| {
            let [rank, with_kept] = free_and_kept_ranks(f, &along, &present);
            (along, with_kept - rank)
        });
        Matrices {
            field: f,
            along,
            whole: whole.collect(),
            all: WrittenOut::modulo_prime(question, &layout),
        }
    }

    /// Returns the redundant constraints within the mechanism that remain if every joint has the freedoms of all its options
    /// at once. Also returns the joints without a choice that would remove some of them.
    #[must_use]
    pub(crate) fn freest_redundancy(&self) -> (usize, Vec<JointId>) {
        let free = self.all.rows[0];
        let within = |c: &Vec<Residue>| c[..free].to_vec();
        let all: Vec<Vec<Residue>> = self.all.all_columns().map(within).collect();
        let rank = eliminate_pivots(self.field, all.clone()).len();
        let loaded = self.whole.iter().filter(|(_, columns)| {
            let more = columns.iter().map(within);
            eliminate_pivots(self.field, all.iter().cloned().chain(more).collect()).len() > rank
        });
        (free - rank, loaded.map(|(j, _)| *j).collect())
    }

    /// Returns the numbers of rows of a column: of the free state, of the kept links' motion, and of the searched state.
    #[must_use]
    pub fn row_counts(&self) -> [usize; 3] {
        self.all.rows
    }

    /// Returns the columns of each choice of a variable.
    #[must_use]
    pub fn columns_of(&self, variable: usize) -> &[Vec<Vec<Residue>>] {
        self.all.choices_of(variable)
    }

    /// Looks at one variant.
    #[must_use]
    pub fn look_at(&self, choices: &[usize]) -> Seen {
        let [free, kept, state] = self.all.rows;
        let rows = |from: usize, to: usize| -> Vec<Vec<Residue>> {
            let chosen = self.all.variant_columns(choices);
            chosen.map(|c| c[from..to].to_vec()).collect()
        };
        let [rank, with_kept] = free_and_kept_ranks(self.field, &self.all, choices);
        let of_state = match state {
            0 => None,
            _ => Some(eliminate_pivots(self.field, rows(free + kept, free + kept + state)).len()),
        };
        let along = self.along.as_ref().filter(|_| rank == free);
        let lasts = along.map(|(along, present)| {
            let [rank, with_kept] = free_and_kept_ranks(self.field, along, choices);
            rank == along.rows[0] && with_kept - rank == *present
        });
        Seen {
            lasts,
            ..Seen::of_ranks(self.all.rows, [rank, with_kept], of_state)
        }
    }
}

/// Returns the rank of a variant's columns in the rows of the free state, and that in these together with the kept links' motion.
fn free_and_kept_ranks(f: Field, of: &WrittenOut<Residue>, choices: &[usize]) -> [usize; 2] {
    let [free, kept, _] = of.rows;
    let chosen = of
        .variant_columns(choices)
        .map(|c| c[..free + kept].to_vec());
    let pivots = eliminate_pivots(f, chosen.collect());
    let rank = pivots.iter().filter(|&&p| p < free).count();
    [rank, pivots.len()]
}

/// Applies plain Gaussian elimination to some vectors. Returns the columns of the pivots.
fn eliminate_pivots(f: Field, mut vectors: Vec<Vec<Residue>>) -> Vec<usize> {
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

/// Examines every variant and counts. The searched state is examined on the mechanism of the variant.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
///
/// # Complexity
/// One elimination per variant, in parallel over the choices of the first variables. With a state, some more for the
/// variants that meet the other conditions.
pub fn every_variant(question: &Question) -> Result<SearchCounts, ExactError> {
    let matrices = Matrices::new(question);
    let mut out = SearchCounts {
        lasting: matrices.along.is_some().then(Counts::default),
        ..SearchCounts::default()
    };
    for ((key, admissible, lasts), count) in count_judged(question, &matrices)? {
        let count = BigUint::from(count);
        let w = question.mobility(key);
        out.determinate.add_variants(w, key, &count);
        if admissible && question.is_wanted(key) {
            out.admissible.add_variants(w, key, &count);
            let lasting = out.lasting.as_mut().filter(|_| lasts);
            lasting
                .into_iter()
                .for_each(|l| l.add_variants(w, key, &count));
        }
    }
    Ok(out)
}

/// Properties of a variant, whether it is admissible but for mobility and changes, and whether it lasts.
type Judged = (Key, bool, bool);

/// Returns the numbers of variants with few enough redundant constraints, by their properties.
fn count_judged(
    question: &Question,
    matrices: &Matrices,
) -> Result<BTreeMap<Judged, u128>, ExactError> {
    let steps = &question.steps;
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
        let mut counts: BTreeMap<Judged, u128> = BTreeMap::new();
        let mut choices = vec![0; radix.len()];
        let mut rest = h;
        for (c, r) in choices.iter_mut().zip(&radix[..head]) {
            (*c, rest) = (rest % r, rest / r);
        }
        loop {
            let seen = matrices.look_at(&choices);
            if let Some((key, admissible)) = judge_variant(question, &choices, seen)? {
                let lasts = seen.lasts == Some(true);
                *counts.entry((key, admissible, lasts)).or_insert(0) += 1;
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

/// Returns the properties of a variant, and whether it is admissible except for the conditions on W and changes ([`Question::is_wanted`]).
/// Returns `None` if it is not determinate. The searched state is examined on the mechanism of the variant.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
pub fn judge_variant(
    question: &Question,
    choices: &[usize],
    seen: Seen,
) -> Result<Option<(Key, bool)>, ExactError> {
    if seen.internal > question.conditions.max_redundant {
        return Ok(None);
    }
    let mut found = Redundancy {
        internal: seen.internal,
        external: seen.external,
        harmful: 0,
    };
    let mut good = !question.conditions.keep_output || seen.motion == question.kept.motion.len();
    if let Some(s) = question.conditions.state.filter(|_| good) {
        let realized = realize_variant(question, choices);
        let closure = Closure::new(&question.exact, &realized, s.state)?;
        let harmful = harmful_count(&question.exact, &realized, &closure)?;
        found.harmful = u32::try_from(harmful).unwrap_or(u32::MAX);
        let beyond = |x: i64, limit: Option<u32>| limit.is_some_and(|l| x > i64::from(l));
        good = !beyond(seen.external.into(), s.max_external)
            && !beyond(found.harmful.into(), s.max_harmful)
            && loose_bodies(&question.exact, &realized, s.state, &question.grasps)?.is_empty();
    }
    Ok(Some((question.steps.variant_key(choices, found), good)))
}
