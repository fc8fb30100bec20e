//! Exact counts on a diagram: for every node, how many completions there are of each kind.

use crate::search::answer::count::Count;
use crate::search::answer::keys::{Key, Steps};
use crate::search::diagram::{DEAD, Diagram};

/// Completions of a node by key, keys ascending.
type Table<C> = Vec<(Key, C)>;

/// For every node, its completions by key, keys ascending.
#[derive(Debug, Clone)]
pub(crate) struct Tally<C> {
    /// `tables[layer][node]`; the last layer holds the terminals.
    pub tables: Vec<Vec<Table<C>>>,
}

impl<C: Count> Tally<C> {
    /// Creates the tables of counts, backwards from the terminals. With a `bound` for each node, omits completions whose
    /// cost exceeds it: `bound(layer, node)` is the largest cost of interest. Returns `None` if the tables would take more
    /// than `bytes`.
    ///
    /// # Complexity
    /// O(edges · table size + nodes · table size · log), where the table sizes depend on the kinds that are distinguished.
    #[must_use]
    pub(crate) fn new(
        diagram: &Diagram,
        steps: &Steps,
        bound: Option<&[Vec<u64>]>,
        bytes: usize,
    ) -> Option<Tally<C>> {
        let mut left = bytes;
        let (mut tables, mut numbers) = terminal_tables(diagram, steps);
        let mut out = Vec::with_capacity(diagram.layers.len() + 1);
        for l in (0..diagram.layers.len()).rev() {
            let bound = bound.map(|b| &b[l][..]);
            let (here, named, used) =
                layer_tables(diagram, steps, l, bound, (&tables, &numbers), left)?;
            left = left.saturating_sub(used);
            out.push(std::mem::replace(&mut tables, here));
            numbers = named;
        }
        out.push(tables);
        out.reverse();
        Some(Tally { tables: out })
    }

    /// Returns where a choice leads from a node of a layer, what is left of a key there, and how many completions have that. Returns `None`
    /// if none has.
    pub(crate) fn follow_choice(
        &self,
        diagram: &Diagram,
        steps: &Steps,
        (layer, node): (usize, u32),
        choice: usize,
        key: Key,
    ) -> Option<(u32, Key, &C)> {
        let here = &diagram.layers[layer];
        let to = here.edges[node as usize * here.choices + choice];
        let rest = Key(key.0.checked_sub(steps.keys[here.variable][choice].0)?);
        let table = self.tables[layer + 1].get(to as usize)?;
        let at = table.binary_search_by_key(&rest, |(k, _)| *k).ok()?;
        Some((to, rest, &table[at].1))
    }

    /// Returns the counts of whole variants by key.
    #[must_use]
    pub(crate) fn total_counts(&self) -> &[(Key, C)] {
        self.tables
            .first()
            .and_then(|l| l.first())
            .map_or(&[], Vec::as_slice)
    }
}

/// Returns the counts of whole variants by key. Holds the tables of no more than two layers at a time. Returns `None` if
/// even these would take more than the given bytes.
///
/// If a layer has one node, the choices before it and after it are independent. Each part is counted by itself, and the
/// counts are multiplied. Tables within a part have no more keys than the part.
///
/// # Complexity
/// That of [`Tally::new`] for each part, and for each a product with the table of those after it.
#[must_use]
pub(crate) fn totals_by_key<C: Count>(
    diagram: &Diagram,
    steps: &Steps,
    bytes: usize,
) -> Option<Table<C>> {
    let mut whole: Table<C> = vec![(Key::default(), C::unit_count())];
    let (mut tables, mut numbers) = terminal_tables(diagram, steps);
    let mut held = 0;
    for l in (0..=diagram.layers.len()).rev() {
        if l < diagram.layers.len() {
            let left = bytes.saturating_sub(held);
            (tables, numbers, held) =
                layer_tables(diagram, steps, l, None, (&tables, &numbers), left)?;
        }
        if let [part] = &mut tables[..] {
            whole = multiply_tables(&whole, part, bytes)?;
            *part = vec![(Key::default(), C::unit_count())];
            numbers = Numbers {
                keys: vec![Key::default()],
                places: vec![vec![0]],
            };
        }
    }
    Some(if tables.is_empty() { Vec::new() } else { whole })
}

/// Returns the counts of all pairs of an entry of each table, by the sums of their keys; `None` if they would take more than the given
/// bytes.
///
/// # Complexity
/// O(entries of one · entries of the other).
fn multiply_tables<C: Count>(many: &Table<C>, few: &Table<C>, bytes: usize) -> Option<Table<C>> {
    let [keys, by] = [many, few].map(|table| table.iter().map(|(k, _)| *k).collect::<Vec<Key>>());
    let shifts = Shifts::new(&keys, &by, u64::MAX, bytes)?;
    if shifts.keys.len() > bytes / size_of::<(Key, C)>() {
        return None;
    }
    let mut sums = vec![C::zero_count(); shifts.keys.len()];
    for (shift, (_, times)) in shifts.of_choice.iter().zip(few) {
        for (&to, (_, count)) in shifts.to[*shift].iter().zip(many) {
            sums[to as usize].add_product(count, times);
        }
    }
    Some(shifts.keys.into_iter().zip(sums).collect())
}

/// The keys of a layer's tables, numbered.
struct Numbers {
    /// All keys, ascending.
    keys: Vec<Key>,
    /// For each entry of each table, the number of its key.
    places: Vec<Vec<u32>>,
}

impl Numbers {
    /// Returns the places among the keys that tables use. A bound leaves few keys, and unused ones would accumulate from layer to layer.
    fn compact_keys(mut keys: Vec<Key>, mut places: Vec<Vec<u32>>) -> Numbers {
        let mut is_met = vec![false; keys.len()];
        for &place in places.iter().flatten() {
            is_met[place as usize] = true;
        }
        if is_met.contains(&false) {
            let mut before = 0;
            let anew = is_met.iter().map(|&met| {
                before += u32::from(met);
                before.saturating_sub(1)
            });
            let anew: Vec<u32> = anew.collect();
            let mut met = is_met.iter();
            keys.retain(|_| *met.next().expect("as many"));
            let all = places.iter_mut().flatten();
            all.for_each(|place| *place = anew[*place as usize]);
        }
        Numbers { keys, places }
    }
}

fn terminal_tables<C: Count>(diagram: &Diagram, steps: &Steps) -> (Vec<Table<C>>, Numbers) {
    let ends = diagram.terminals.iter().map(|&r| steps.redundancy_key(r));
    let ends: Vec<Key> = ends.collect();
    let mut keys = ends.clone();
    keys.sort_unstable();
    keys.dedup();
    let place = |k: &Key| vec![key_number(keys.partition_point(|x| x < k))];
    let places = ends.iter().map(place).collect();
    let tables = ends.iter().map(|&k| vec![(k, C::unit_count())]).collect();
    (tables, Numbers { keys, places })
}

fn key_number(place: usize) -> u32 {
    u32::try_from(place).expect("tables that fit the memory have fewer keys")
}

/// How the keys of a layer's completions come from those of the layer below.
struct Shifts {
    /// All keys, ascending.
    keys: Vec<Key>,
    /// For each choice, the index of its shift.
    of_choice: Vec<usize>,
    /// `to[shift][key below]`, a place in `keys`.
    to: Vec<Vec<u32>>,
}

impl Shifts {
    /// Returns the sums of the keys below and the keys of the choices, up to a cost. Returns `None` if they would take more than `bytes`.
    fn new(below: &[Key], choices: &[Key], most: u64, bytes: usize) -> Option<Shifts> {
        let mut different = choices.to_vec();
        different.sort_unstable();
        different.dedup();
        if (different.len() + 1) * below.len() > bytes / size_of::<(Key, u32)>() {
            return None;
        }
        // Each shift's keys ascend: all are merged, and each is told where it comes to.
        const END: Key = Key(u128::MAX);
        let mut keys: Vec<Key> = Vec::with_capacity(below.len() + different.len());
        let room = |_: &Key| Vec::with_capacity(below.len());
        let mut to: Vec<Vec<u32>> = different.iter().map(room).collect();
        let next = |by: Key, place: usize| {
            let next = below.get(place).map(|k| Key(k.0 + by.0));
            next.filter(|k| k.cost() <= most).unwrap_or(END)
        };
        let mut ahead: Vec<Key> = different.iter().map(|&by| next(by, 0)).collect();
        while let Some(&key) = ahead.iter().min().filter(|k| **k != END) {
            let place = key_number(keys.len());
            for ((ahead, to), &by) in ahead.iter_mut().zip(&mut to).zip(&different) {
                if *ahead == key {
                    to.push(place);
                    *ahead = next(by, to.len());
                }
            }
            keys.push(key);
        }
        // What costs too much comes after all.
        let beyond = key_number(keys.len());
        to.iter_mut().for_each(|to| to.resize(below.len(), beyond));
        let of_choice = choices.iter().map(|c| different.partition_point(|x| x < c));
        Some(Shifts {
            of_choice: of_choice.collect(),
            to,
            keys,
        })
    }
}

/// Puts the places where there are sums in order: few are sorted, many found by looking through all.
fn put_in_order<C>(met: &mut Vec<u32>, sums: &[Option<C>]) {
    if met.len() * 8 < sums.len() {
        met.sort_unstable();
    } else {
        met.clear();
        let all = sums.iter().enumerate().filter(|(_, s)| s.is_some());
        met.extend(all.map(|(i, _)| key_number(i)));
    }
}

/// Computes the tables of layer `l` from those of the layer below and the numbers of their keys. Returns them with the bytes
/// they take, or `None` if these are too many.
fn layer_tables<C: Count>(
    diagram: &Diagram,
    steps: &Steps,
    l: usize,
    bound: Option<&[u64]>,
    (below, numbers): (&[Table<C>], &Numbers),
    bytes: usize,
) -> Option<(Vec<Table<C>>, Numbers, usize)> {
    let layer = &diagram.layers[l];
    let most = bound.and_then(|b| b.iter().copied().max());
    let choices = &steps.keys[layer.variable];
    let shifts = Shifts::new(&numbers.keys, choices, most.unwrap_or(u64::MAX), bytes)?;
    let mut sums: Vec<Option<C>> = vec![None; shifts.keys.len()];
    let mut met: Vec<u32> = Vec::new();
    let (mut here, mut places) = (Vec::with_capacity(layer.nodes), Vec::new());
    let mut used = 0;
    for node in 0..layer.nodes {
        // Keys ascend by cost: those beyond the limit are the last.
        let within = bound.map_or(shifts.keys.len(), |b| {
            shifts.keys.partition_point(|k| k.cost() <= b[node])
        });
        let edges = &layer.edges[node * layer.choices..(node + 1) * layer.choices];
        for (shift, &to) in shifts.of_choice.iter().zip(edges) {
            if to == DEAD {
                continue;
            }
            let shift = &shifts.to[*shift];
            let entries = below[to as usize].iter().zip(&numbers.places[to as usize]);
            for ((_, count), &from) in entries {
                let to = shift[from as usize];
                if to as usize >= within {
                    break;
                }
                match &mut sums[to as usize] {
                    Some(sum) => sum.add_count(count),
                    none => {
                        *none = Some(count.clone());
                        met.push(to);
                    }
                }
            }
        }
        put_in_order(&mut met, &sums);
        let entry = |&to: &u32| Some((shifts.keys[to as usize], sums[to as usize].take()?));
        let mut table: Table<C> = Vec::new();
        table.try_reserve_exact(met.len()).ok()?;
        table.extend(met.iter().filter_map(entry));
        used += table.capacity() * (size_of::<(Key, C)>() + size_of::<u32>());
        used += table.iter().map(|(_, c)| c.heap_bytes()).sum::<usize>();
        if used > bytes {
            return None;
        }
        here.push(table);
        places.push(std::mem::take(&mut met));
    }
    Some((here, Numbers::compact_keys(shifts.keys, places), used))
}

#[cfg(test)]
mod tests;
