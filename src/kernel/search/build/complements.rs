//! Which halves of a mechanism complete each other.
//!
//! The links where two halves meet are loaded by both. What a half can load them with and still be in equilibrium, whatever
//! moves, are the wrenches that its motions do no work against; a wrench of one half that the other takes up is a self-stress
//! of the whole. So halves without redundant constraints of their own make a whole without any where their spaces of wrenches
//! have nothing in common. Links whose motion is to be kept are welded to the frame in a second trial: how many redundant
//! constraints that makes says how many motions they have.

use crate::linalg::echelon::Echelon;
use crate::linalg::modp::{Field, Residue};
use crate::model::mechanism::LinkId;
use crate::search::diagram::layer::Nodes;
use rayon::prelude::*;
use std::collections::{BTreeMap, HashMap};

/// The nodes of a layer, reached from one end, and what their coordinates are.
pub(in crate::search) struct Half<'a> {
    pub(in crate::search) nodes: &'a Nodes,
    /// The (root, link) that each block is the twist of.
    pub(in crate::search) live: &'a [(LinkId, LinkId)],
    /// The couplings that wait for their other joint.
    pub(in crate::search) pending: &'a [usize],
}

/// Links whose motion is to be kept, and its dimension.
pub(in crate::search) struct Kept<'a> {
    pub(in crate::search) links: &'a [LinkId],
    pub(in crate::search) dimension: usize,
}

/// A set of nodes of one half.
pub(in crate::search) type Set = Box<[u64]>;

/// Whether a node is in a set.
pub(in crate::search) fn has(set: &Set, node: usize) -> bool {
    set[node / 64] >> (node % 64) & 1 == 1
}

/// A set of some of so many nodes.
pub(in crate::search) fn set(nodes: usize, mut is_in: impl FnMut(usize) -> bool) -> Set {
    let mut out = vec![0; nodes.div_ceil(64)].into_boxed_slice();
    for node in 0..nodes {
        out[node / 64] |= u64::from(is_in(node)) << (node % 64);
    }
    out
}

/// For each node of the first half, which nodes of the second make it a mechanism without redundant constraints, whose kept
/// links move as they shall; none where it is cancelled.
///
/// # Complexity
/// O(n·m·r³) field operations for n and m nodes and wrench spaces of dimension r.
pub(in crate::search) fn join(
    (field, dim): (Field, usize),
    [one, two]: [&Half<'_>; 2],
    frame: LinkId,
    kept: Option<&Kept<'_>>,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Option<Vec<Set>> {
    let columns = Columns::new([one, two], dim, frame, kept.map_or(&[], |k| k.links));
    let second = Second::new((field, dim), &columns, two);
    let sets = (0..one.nodes.len()).into_par_iter().map(|node| {
        if cancelled() {
            return None;
        }
        let wrenches = columns.wrenches((field, dim), one, node, false);
        let whole = Quotient::new(field, wrenches, columns.width);
        let images = whole.images(&second.rows);
        // The blocks of the kept links come last: without them they are welded to the frame.
        let welded = kept.map(|kept| {
            let free = columns.free;
            let own = whole.rows.iter().map(|r| r[..free].to_vec()).collect();
            let welded = Quotient::new(field, own, free);
            let images = welded.images(&second.rows);
            (welded, images, whole.rows.len() + kept.dimension)
        });
        let mut scratch = Vec::new();
        Some(set(second.of_node.len(), |other| {
            let rows = &second.of_node[other];
            if whole.rank(&images, rows, &mut scratch) < rows.len() {
                return false;
            }
            welded.as_ref().is_none_or(|(welded, images, most)| {
                let rank = welded.rows.len() + welded.rank(images, rows, &mut scratch);
                rank + columns.width - columns.free <= most + rows.len()
            })
        }))
    });
    sets.collect()
}

/// Where the wrenches on the links that halves meet in are written: the frame's are left out, as those of the others balance
/// them.
struct Columns {
    /// Start of each link's block.
    links: BTreeMap<LinkId, usize>,
    /// Column of each coupling's force.
    couplings: BTreeMap<usize, usize>,
    /// Columns before the blocks of the kept links.
    free: usize,
    width: usize,
}

impl Columns {
    fn new(halves: [&Half<'_>; 2], dim: usize, frame: LinkId, kept: &[LinkId]) -> Columns {
        let ends = halves
            .iter()
            .flat_map(|h| h.live)
            .flat_map(|&(a, b)| [a, b]);
        let mut others: Vec<LinkId> = ends.filter(|l| *l != frame && !kept.contains(l)).collect();
        others.sort_unstable();
        others.dedup();
        let mut couplings: Vec<usize> = halves.iter().flat_map(|h| h.pending).copied().collect();
        couplings.sort_unstable();
        couplings.dedup();
        let links = others.len() * dim;
        let free = links + couplings.len();
        let kept = kept.iter().enumerate().map(|(i, &l)| (l, free + i * dim));
        let width = free + kept.len() * dim;
        let others = others.into_iter().enumerate().map(|(i, l)| (l, i * dim));
        Columns {
            links: others.chain(kept).collect(),
            couplings: couplings.into_iter().zip(links..).collect(),
            free,
            width,
        }
    }

    /// A basis of the wrenches that a half takes up; of the `second` half the forces of couplings count the other way, as the
    /// rates of both halves add up to nothing where their twists agree.
    fn wrenches(
        &self,
        (f, dim): (Field, usize),
        half: &Half<'_>,
        node: usize,
        second: bool,
    ) -> Vec<Vec<Residue>> {
        let blocks = half.live.len();
        let size = (blocks + half.pending.len()) * dim;
        let matrix = half.nodes.matrix(node);
        let rows: Vec<&[Residue]> = matrix.chunks_exact(size.max(1)).collect();
        let pivot = |r: &&[Residue]| r.iter().position(|&x| x != 0);
        let pivots: Vec<usize> = rows.iter().filter_map(pivot).collect();
        // Of a coupling's block the first number alone is used.
        let used = |i: &usize| *i < blocks * dim || i.is_multiple_of(dim);
        let open = (0..size).filter(|i| used(i) && !pivots.contains(i));
        let put = |out: &mut Vec<Residue>, i: usize, x: Residue| {
            let mut add = |at: usize, x: Residue| out[at] = f.add(out[at], x);
            let (block, c) = (i / dim, i % dim);
            let Some(&(root, link)) = half.live.get(block) else {
                let at = self.couplings[&half.pending[block - blocks]];
                return add(at, if second { f.neg(x) } else { x });
            };
            if let Some(at) = self.links.get(&link) {
                add(at + c, x);
            }
            if let Some(at) = self.links.get(&root) {
                add(at + c, f.neg(x));
            }
        };
        open.map(|i| {
            let mut out = vec![0; self.width];
            put(&mut out, i, f.one());
            for (row, &p) in rows.iter().zip(&pivots).filter(|(r, _)| r[i] != 0) {
                put(&mut out, p, f.neg(row[i]));
            }
            out
        })
        .collect()
    }
}

/// The wrench spaces of the second half: many have vectors in common.
struct Second {
    /// The different vectors of all bases.
    rows: Vec<Vec<Residue>>,
    /// The basis of each node.
    of_node: Vec<Vec<usize>>,
}

impl Second {
    fn new((field, dim): (Field, usize), columns: &Columns, half: &Half<'_>) -> Second {
        let mut known: HashMap<Vec<Residue>, usize> = HashMap::new();
        let mut rows = Vec::new();
        let of_node = (0..half.nodes.len()).map(|node| {
            let wrenches = columns.wrenches((field, dim), half, node, true);
            let number = |row: Vec<Residue>| {
                *known.entry(row).or_insert_with_key(|row| {
                    rows.push(row.clone());
                    rows.len() - 1
                })
            };
            let basis = span(field, &wrenches).reduced();
            basis.into_iter().map(number).collect()
        });
        Second {
            of_node: of_node.collect(),
            rows,
        }
    }
}

fn span(field: Field, vectors: &[Vec<Residue>]) -> Echelon {
    let mut out = Echelon::new(field);
    vectors.iter().for_each(|v| {
        out.insert(v);
    });
    out
}

/// Vectors up to those of a space.
struct Quotient {
    field: Field,
    /// A reduced basis of the space.
    rows: Vec<Vec<Residue>>,
    pivots: Vec<usize>,
    /// The coordinates that are left.
    open: Vec<usize>,
}

impl Quotient {
    fn new(field: Field, vectors: Vec<Vec<Residue>>, width: usize) -> Quotient {
        let span = span(field, &vectors);
        let (rows, pivots) = (span.reduced(), span.pivots());
        let open = (0..width).filter(|i| !pivots.contains(i)).collect();
        Quotient {
            field,
            rows,
            pivots,
            open,
        }
    }

    /// What is left of some vectors, one after another.
    fn images(&self, vectors: &[Vec<Residue>]) -> Vec<Residue> {
        let f = self.field;
        let image = |v: &Vec<Residue>, at: usize| {
            let rows = self.rows.iter().zip(&self.pivots);
            rows.filter(|(_, p)| v[**p] != 0)
                .fold(v[at], |x, (row, &p)| f.sub(x, f.mul(v[p], row[at])))
        };
        let mut out = Vec::with_capacity(vectors.len() * self.open.len());
        for v in vectors {
            for &at in &self.open {
                out.push(image(v, at));
            }
        }
        out
    }

    /// The rank of some of the images, found without a division.
    fn rank(&self, images: &[Residue], chosen: &[usize], scratch: &mut Vec<Residue>) -> usize {
        let (f, width) = (self.field, self.open.len());
        scratch.clear();
        for &row in chosen {
            scratch.extend_from_slice(&images[row * width..(row + 1) * width]);
        }
        let mut rank = 0;
        for i in 0..chosen.len() {
            let (above, below) = scratch.split_at_mut((i + 1) * width);
            let row = &above[i * width..];
            let Some(pivot) = row.iter().position(|&x| x != 0) else {
                continue;
            };
            rank += 1;
            for other in below.chunks_exact_mut(width) {
                let head = other[pivot];
                if head == 0 {
                    continue;
                }
                for (x, &y) in other.iter_mut().zip(row) {
                    *x = f.cross(row[pivot], *x, head, y);
                }
            }
        }
        rank
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::modp::is_prime;
    use crate::search::diagram::redundancy_so_far::Spent;

    /// Two halves that let a link slide one way, and what a coupling passes with it, by so much. Their rates are to add up to
    /// nothing: where they always do, the coupling is redundant, and else it stops the link.
    #[test]
    fn a_coupling_is_redundant_where_the_rates_of_both_halves_always_add_up_to_nothing() {
        let p = (1u64 << 61..).find(|&n| is_prime(n)).unwrap();
        let f = Field::new(p);
        let frame = LinkId::new(0);
        let live = [(frame, LinkId::new(1))];
        for (a, b, redundant) in [(2, -2, true), (2, 2, false), (-5, 5, true), (3, -2, false)] {
            let node = |rate: i64| {
                let mut out = Nodes::empty();
                out.push(Spent::default(), &[f.one(), f.from_i64(rate)], 0);
                out
            };
            let (one, two) = (node(a), node(b));
            let half = |nodes| Half {
                nodes,
                live: &live,
                pending: &[0],
            };
            let halves = [&half(&one), &half(&two)];
            let found = join((f, 1), halves, frame, None, &|| false).unwrap();
            assert_eq!(has(&found[0], 0), !redundant, "{a} {b}");
        }
    }
}
