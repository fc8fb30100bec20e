//! From which variable to which a coordinate is in use.
//!
//! The coordinates of a space can be chosen freely, and they determine how many coordinates a node has. If no two coordinates have the same
//! last vector that reaches them, nor the same first one, each lifetime is as short as possible. The number of live coordinates between two
//! variables is then the dimension of the space that the variables before and after both reach. No choice of coordinates has fewer.
//!
//! # Sources
//! Kschischang & Sorokine, "On the trellis structure of block codes", IEEE Trans. Inf. Theory 41 (1995): the trellis-oriented
//! form of a generator matrix, whose rows have spans that start and end in different places.

use crate::linalg::modp::{Field, Residue};
use std::ops::Range;

/// The first and the last variable of an order that reach a coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::search) struct Lifetime {
    pub(in crate::search) from: usize,
    pub(in crate::search) to: usize,
}

impl Lifetime {
    /// Returns true if variables before this one, and this one or later ones, use the row.
    pub(in crate::search) fn is_live_before(self, variable: usize) -> bool {
        self.from < variable && variable <= self.to
    }

    /// Returns true if the row is in use at a variable.
    pub(in crate::search) fn is_live_at(self, variable: usize) -> bool {
        self.from <= variable && variable <= self.to
    }
}

/// A vector of the added motions of a choice.
pub(in crate::search) type Added = Vec<Residue>;

/// The vectors that the choices of a variable add to a mechanism, in all rows.
pub(in crate::search) struct Offered {
    /// The vectors. Most of them belong to several choices.
    pub(in crate::search) vectors: Vec<Added>,
    /// The numbers of the vectors of each choice.
    pub(in crate::search) choices: Vec<Vec<usize>>,
}

impl Offered {
    /// Returns the vectors of all choices, each once, and the numbers of those of each choice.
    pub(in crate::search) fn from_choices(choices: impl Iterator<Item = Vec<Added>>) -> Offered {
        let mut vectors = Vec::new();
        let choices = choices.map(|all| {
            let numbers = all.into_iter().map(|v| number_in(&mut vectors, v));
            numbers.collect()
        });
        Offered {
            choices: choices.collect(),
            vectors,
        }
    }
}

/// Returns the number of something in a list, to which it is added if it is new.
pub(in crate::search) fn number_in<T: PartialEq>(list: &mut Vec<T>, new: T) -> usize {
    let known = list.iter().position(|known| *known == new);
    known.unwrap_or_else(|| {
        list.push(new);
        list.len() - 1
    })
}

/// A vector, and which variable adds it.
pub(super) type AddedBy = (usize, Added);

/// Brings some coordinates of vectors, which come in the order of their variables, into a form in which each starts as late as can be, and
/// tells when they are in use. `last` has the last variable that reaches each, ascending, and stays true.
///
/// # Complexity
/// O(n·c·s) field operations for n vectors, c coordinates, and s of them that have not started where a vector reaches them.
pub(super) fn shorten_lifetimes(
    field: Field,
    vectors: &mut [AddedBy],
    coordinates: Range<usize>,
    last: &[usize],
) -> Vec<Lifetime> {
    let mut from: Vec<Option<usize>> = vec![None; coordinates.len()];
    for v in 0..vectors.len() {
        let (variable, vector) = &vectors[v];
        let starting = coordinates.clone().zip(&from);
        let starting = starting.filter(|(at, from)| from.is_none() && vector[*at] != 0);
        let mut starting = starting.map(|(at, _)| at);
        let Some(own) = starting.next() else {
            continue;
        };
        let scale = field.inv(vector[own]);
        let others: Vec<(usize, Residue)> = starting
            .map(|at| (at, field.mul(vector[at], scale)))
            .collect();
        from[own - coordinates.start] = Some(*variable);
        // None before has a number there. The others end no sooner than this one, so that they end as they did.
        for (_, vector) in vectors[v..].iter_mut().filter(|(_, v)| v[own] != 0) {
            for &(at, times) in &others {
                vector[at] = field.sub(vector[at], field.mul(times, vector[own]));
            }
        }
    }
    let times = from.into_iter().zip(last);
    times
        .map(|(from, &to)| Lifetime {
            from: from.unwrap_or(to),
            to,
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{Lifetime, shorten_lifetimes};
    use crate::linalg::echelon::{linear_relations, rank_of};
    use crate::linalg::modp::{Field, Residue};
    use proptest::prelude::*;

    proptest! {
        /// Vectors of a few small numbers, some variables without any, in coordinates of which each is the last vector's own that is new
        /// from the end.
        #[test]
        fn between_variables_as_many_are_live_as_both_sides_reach(
            drawn in prop::collection::vec((prop::collection::vec(-2i64..3, 5), 0usize..3), 0..14),
        ) {
            let f = Field::new((1 << 61) - 1);
            let mut variable = 0;
            let mut all: Vec<(usize, Vec<Residue>)> = Vec::new();
            for (numbers, later) in drawn {
                variable += later;
                all.push((variable, numbers.iter().map(|&x| f.from_i64(x)).collect()));
            }
            let rows = |of: &[(usize, Vec<Residue>)]| rank_of(f, of.iter().map(|(_, v)| &v[..]));
            // The last vectors that are new from the end are the coordinates: their own numbers are units.
            let mut basis: Vec<usize> = (0..all.len()).rev().filter(|&i| rows(&all[i..]) > rows(&all[i + 1..])).collect();
            basis.reverse();
            let columns: Vec<Vec<Residue>> = basis.iter().map(|&i| all[i].1.clone()).collect();
            let of = |v: &Vec<Residue>| {
                let relation = linear_relations(f, &[std::slice::from_ref(v), &columns[..]].concat());
                relation[0][1..].iter().map(|&x| f.neg(x)).collect::<Vec<Residue>>()
            };
            let mut vectors: Vec<(usize, Vec<Residue>)> = all.iter().map(|(t, v)| (*t, of(v))).collect();
            let last: Vec<usize> = basis.iter().map(|&i| all[i].0).collect();
            let lifetimes = shorten_lifetimes(f, &mut vectors, 0..last.len(), &last);
            for t in 0..variable + 2 {
                let at = all.partition_point(|(of, _)| *of < t);
                let both = rows(&all[..at]) + rows(&all[at..]) - rows(&all);
                prop_assert_eq!(lifetimes.iter().filter(|l| l.is_live_before(t)).count(), both);
            }
            // They span what they did, and are nothing where a coordinate is not in use.
            prop_assert_eq!(rows(&vectors), rows(&all));
            for (t, v) in &vectors {
                for (x, Lifetime { from, to }) in v.iter().zip(&lifetimes) {
                    prop_assert!(*x == 0 || (from <= t && t <= to));
                }
            }
        }
    }
}
