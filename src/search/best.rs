//! Variants one by one: in order of cost, or drawn at random with equal chances.
//!
//! Both walk down the diagram guided by the tally, so no step is ever taken back: a step is possible exactly when the
//! node it leads to has a completion with the key that is left.

use crate::search::diagram::{DEAD, Diagram};
use crate::search::tally::{Count, Key, Steps, Tally};
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use num_bigint::BigUint;
use num_traits::Zero;
use std::ops::ControlFlow;

/// A variant found on a diagram.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Variant {
    /// For each variable of the space, the choice.
    pub choices: Vec<usize>,
    /// Its properties.
    pub key: Key,
}

/// Gives `visit` the variants whose key passes `wanted`, cheapest first, then in the order of `rank`, then by choices
/// in diagram order, until `visit` breaks or `top` have been given.
///
/// # Complexity
/// Some passes over the part of the diagram that variants of that cost use, then O(variables · choices) table look-ups
/// a variant; memory is the tables, whatever `top` is.
pub fn cheapest<C: Count, R: Ord>(
    diagram: &Diagram,
    steps: &Steps,
    top: usize,
    wanted: impl Fn(Key) -> bool,
    rank: impl Fn(Key) -> R,
    mut visit: impl FnMut(Variant) -> ControlFlow<()>,
) {
    let least = least_costs(diagram, &steps.keys);
    let Some(floor) = least.completion[0][0] else {
        return;
    };
    let ceiling = steps
        .keys
        .iter()
        .flatten()
        .map(|k| k.cost())
        .max()
        .unwrap_or(0)
        * steps.keys.len() as u64;
    let mut slack = 0;
    let (tally, mut keys) = loop {
        let limit = floor.saturating_add(slack).min(ceiling);
        let bound: Vec<Vec<u64>> = least
            .prefix
            .iter()
            .map(|l| {
                l.iter()
                    .map(|p| p.map_or(0, |p| limit.saturating_sub(p)))
                    .collect()
            })
            .collect();
        let tally: Tally<C> = Tally::new(diagram, &steps.keys, Some(&bound));
        let found: Vec<Key> = tally
            .totals()
            .iter()
            .map(|(k, _)| *k)
            .filter(|&k| wanted(k))
            .collect();
        let count: BigUint = tally
            .totals()
            .iter()
            .filter(|(k, _)| wanted(*k))
            .map(|(_, c)| c.big())
            .sum();
        if count >= BigUint::from(top) || limit >= ceiling {
            break (tally, found);
        }
        slack = if slack == 0 { 1 } else { slack * 2 };
    };
    keys.sort_by_key(|&k| (k.cost(), rank(k), k));
    let mut left = top;
    let mut choices = vec![0; steps.keys.len()];
    for key in keys {
        let mut give = |choices: &[usize]| {
            if left == 0 {
                return ControlFlow::Break(());
            }
            left -= 1;
            visit(Variant {
                choices: choices.to_vec(),
                key,
            })
        };
        if descend(diagram, steps, &tally, 0, 0, key, &mut choices, &mut give).is_break() {
            return;
        }
    }
}

#[allow(
    clippy::too_many_arguments,
    reason = "a recursive walk with its fixed surroundings"
)]
fn descend<C: Count>(
    diagram: &Diagram,
    steps: &Steps,
    tally: &Tally<C>,
    layer: usize,
    node: usize,
    key: Key,
    choices: &mut Vec<usize>,
    give: &mut impl FnMut(&[usize]) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let Some(here) = diagram.layers.get(layer) else {
        return give(choices);
    };
    for (choice, &to) in here.edges[node * here.choices..(node + 1) * here.choices]
        .iter()
        .enumerate()
    {
        let Some(rest) = key
            .0
            .checked_sub(steps.keys[here.variable][choice].0)
            .map(Key)
        else {
            continue;
        };
        if to == DEAD
            || tally.tables[layer + 1][to as usize]
                .binary_search_by_key(&rest, |(k, _)| *k)
                .is_err()
        {
            continue;
        }
        choices[here.variable] = choice;
        descend(
            diagram,
            steps,
            tally,
            layer + 1,
            to as usize,
            rest,
            choices,
            give,
        )?;
    }
    ControlFlow::Continue(())
}

/// Least costs of ways to and from each node; `None` where there is none.
struct Least {
    prefix: Vec<Vec<Option<u64>>>,
    completion: Vec<Vec<Option<u64>>>,
}

fn least_costs(diagram: &Diagram, keys: &[Vec<Key>]) -> Least {
    let sizes = || {
        diagram
            .layers
            .iter()
            .map(|l| l.nodes)
            .chain([diagram.terminals.len()])
    };
    let mut prefix: Vec<Vec<Option<u64>>> = sizes().map(|n| vec![None; n]).collect();
    let mut completion = prefix.clone();
    prefix[0][0] = Some(0);
    if let Some(last) = completion.last_mut() {
        last.fill(Some(0));
    }
    let lower = |slot: &mut Option<u64>, x: u64| *slot = Some(slot.map_or(x, |s| s.min(x)));
    for (l, layer) in diagram.layers.iter().enumerate() {
        for (e, &to) in layer
            .edges
            .iter()
            .enumerate()
            .filter(|(_, to)| **to != DEAD)
        {
            if let Some(p) = prefix[l][e / layer.choices] {
                lower(
                    &mut prefix[l + 1][to as usize],
                    p + keys[layer.variable][e % layer.choices].cost(),
                );
            }
        }
    }
    for (l, layer) in diagram.layers.iter().enumerate().rev() {
        for (e, &to) in layer
            .edges
            .iter()
            .enumerate()
            .filter(|(_, to)| **to != DEAD)
        {
            if let Some(c) = completion[l + 1][to as usize] {
                lower(
                    &mut completion[l][e / layer.choices],
                    c + keys[layer.variable][e % layer.choices].cost(),
                );
            }
        }
    }
    Least { prefix, completion }
}

/// Draws `count` variants whose key passes `wanted`, independently, each with the same chance.
///
/// `keys` are the keys the tally was made with; the variants' own keys are made from `steps`.
pub fn sample<C: Count>(
    diagram: &Diagram,
    steps: &Steps,
    keys: &[Vec<Key>],
    tally: &Tally<C>,
    count: usize,
    seed: u64,
    wanted: impl Fn(Key) -> bool,
) -> Vec<Variant> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let totals: Vec<(Key, BigUint)> = tally
        .totals()
        .iter()
        .filter(|(k, _)| wanted(*k))
        .map(|(k, c)| (*k, c.big()))
        .collect();
    let all: BigUint = totals.iter().map(|(_, c)| c).sum();
    if all.is_zero() {
        return Vec::new();
    }
    let mut draw = || {
        let mut ticket = below(&mut random, &all);
        let mut key = totals[0].0;
        for (k, c) in &totals {
            if ticket < *c {
                key = *k;
                break;
            }
            ticket -= c;
        }
        let mut choices = vec![0; steps.keys.len()];
        let (mut node, mut whole) = (0usize, 0u128);
        for (l, layer) in diagram.layers.iter().enumerate() {
            for (choice, edge) in keys[layer.variable].iter().enumerate() {
                let to = layer.edges[node * layer.choices + choice];
                let Some(rest) = key.0.checked_sub(edge.0).map(Key) else {
                    continue;
                };
                if to == DEAD {
                    continue;
                }
                let table = &tally.tables[l + 1][to as usize];
                let Ok(i) = table.binary_search_by_key(&rest, |(k, _)| *k) else {
                    continue;
                };
                let size = table[i].1.big();
                if ticket < size {
                    choices[layer.variable] = choice;
                    whole += steps.keys[layer.variable][choice].0;
                    (node, key) = (to as usize, rest);
                    break;
                }
                ticket -= size;
            }
        }
        let (internal, external) = diagram.terminals[node];
        whole += Key::new(0, 0, 0, internal, external).0;
        Variant {
            choices,
            key: Key(whole),
        }
    };
    (0..count).map(|_| draw()).collect()
}

/// A number below `n`, each with the same chance.
fn below(random: &mut ChaCha8Rng, n: &BigUint) -> BigUint {
    let bits = n.bits();
    let mut bytes = vec![0u8; usize::try_from(bits.div_ceil(8)).unwrap_or(0)];
    loop {
        random.fill_bytes(&mut bytes);
        let x = BigUint::from_bytes_le(&bytes) >> (bytes.len() as u64 * 8 - bits);
        if x < *n {
            return x;
        }
    }
}
