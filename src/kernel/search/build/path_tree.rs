//! A path to each node of the half from the back, as a tree: what its choices add, as far as the front half reaches it, too.
//!
//! Nodes need no basis of their own. What the choices on a path add is eliminated where the front half does not reach it, once for
//! all nodes of the front; what is left of each choice is an edge of the tree. Paths that begin alike are then completed
//! together, and most nodes are one edge away from another.

use crate::linalg::echelon::Echelon;
use crate::linalg::modp::{Field, Residue};
use crate::search::diagram::stage::Grown;
use crate::search::diagram::{DEAD, Layer};
use hashbrown::HashMap;

/// What is looked at in turn: an edge, then all that follows it; or a node where a path ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct Item {
    /// Edges before it on its path.
    pub(super) depth: usize,
    /// The item after it and all that follows it.
    pub(super) end: usize,
    /// Most edges on a path from here, this one too: none at a node.
    pub(super) longest: usize,
    /// The number of the vector that it adds; nothing at a node.
    pub(super) vector: usize,
    /// Nodes before it in the order of the tree.
    nodes: usize,
}

/// The tree, in the order in which it is walked.
#[derive(Debug, Default)]
pub(super) struct PathTree {
    pub(super) items: Vec<Item>,
    /// The different vectors that edges add, one after another.
    vectors: Vec<Residue>,
    width: usize,
    /// The nodes in the order of their items.
    nodes: Vec<usize>,
}

/// Vectors of numbers of which the first ones tell what the front half does not reach.
pub(super) struct Vectors {
    pub(super) field: Field,
    pub(super) beyond: usize,
    pub(super) all: Vec<Vec<Residue>>,
}

impl PathTree {
    /// Of paths to nodes, each as the numbers of vectors.
    ///
    /// # Complexity
    /// O(e·l·w) field operations for e edges, paths of l vectors, and vectors of w numbers.
    pub(super) fn new(vectors: &Vectors, paths: &[Vec<usize>]) -> PathTree {
        let mut order: Vec<usize> = (0..paths.len()).collect();
        order.sort_by(|&a, &b| paths[a].cmp(&paths[b]));
        let mut growing = Growing {
            vectors,
            path: Vec::new(),
            known: HashMap::new(),
            tree: PathTree {
                width: vectors.all.first().map_or(0, |v| v.len() - vectors.beyond),
                ..PathTree::default()
            },
        };
        for node in order {
            let followed = growing.path.iter().map(|f| f.vector);
            let alike = followed.zip(&paths[node]);
            let alike = alike.take_while(|(a, b)| a == *b).count();
            growing.back_to(alike);
            paths[node][alike..].iter().for_each(|&v| growing.follow(v));
            growing.item(0);
            growing.tree.nodes.push(node);
        }
        growing.back_to(0);
        growing.tree
    }

    /// Returns a reduced basis of what the path to each node adds.
    pub(super) fn bases(&self, field: Field) -> Vec<Vec<Vec<Residue>>> {
        let mut bases = vec![Vec::new(); self.nodes.len()];
        let mut path: Vec<usize> = Vec::new();
        for item in &self.items {
            path.truncate(item.depth);
            if item.longest > 0 {
                path.push(item.vector);
                continue;
            }
            let added = path
                .iter()
                .map(|&v| &self.vectors[v * self.width..][..self.width]);
            bases[self.nodes[item.nodes]] = Echelon::of(field, added).reduced();
        }
        bases
    }

    /// Returns the tree of nodes with these bases in place of their paths. More of these begin with the same vectors, if many nodes differ
    /// only in their paths.
    pub(super) fn of_bases(field: Field, bases: &[Vec<Vec<Residue>>]) -> PathTree {
        let mut known: HashMap<&[Residue], usize> = HashMap::new();
        let mut vectors = Vectors {
            field,
            beyond: 0,
            all: Vec::new(),
        };
        let mut number = |row| {
            *known.entry(row).or_insert_with_key(|row: &&[Residue]| {
                vectors.all.push(row.to_vec());
                vectors.all.len() - 1
            })
        };
        // The last ones have few numbers that are not nothing, so that more bases have them in common.
        let paths: Vec<Vec<usize>> = bases
            .iter()
            .map(|rows| rows.iter().rev().map(|row| number(&row[..])).collect())
            .collect();
        PathTree::new(&vectors, &paths)
    }

    /// The different vectors that edges add.
    pub(super) fn vectors(&self) -> impl ExactSizeIterator<Item = &[Residue]> {
        self.vectors.chunks_exact(self.width.max(1))
    }

    /// How much there is to look at.
    pub(super) fn size(&self) -> usize {
        self.items.len() + self.vectors().len()
    }

    /// How many nodes there are.
    pub(super) fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// The nodes at an item and at all that follow it.
    pub(super) fn nodes(&self, of: Item) -> &[usize] {
        let after = self.items.get(of.end);
        &self.nodes[of.nodes..after.map_or(self.nodes.len(), |i| i.nodes)]
    }
}

/// A vector on the path that is followed.
struct PathVector {
    vector: usize,
    /// What is left of it, where that is something the front half does not reach, and where it starts with a one.
    beyond: Option<(usize, Vec<Residue>)>,
    /// Its edge, where it is something else.
    edge: Option<usize>,
}

/// A tree, and the path that is followed.
struct Growing<'a> {
    vectors: &'a Vectors,
    path: Vec<PathVector>,
    /// The numbers of the vectors of the tree.
    known: HashMap<Vec<Residue>, usize>,
    tree: PathTree,
}

impl Growing<'_> {
    /// Goes back to where so many vectors were followed.
    fn back_to(&mut self, vectors: usize) {
        while self.path.len() > vectors {
            let Some(edge) = self.path.pop().and_then(|f| f.edge) else {
                continue;
            };
            let items = &mut self.tree.items;
            items[edge].end = items.len();
            items[edge].longest += 1;
            let longest = items[edge].longest;
            let mut before = self.path.iter().rev().filter_map(|f| f.edge);
            if let Some(before) = before.next() {
                items[before].longest = items[before].longest.max(longest);
            }
        }
    }

    /// Follows one vector more.
    fn follow(&mut self, vector: usize) {
        let f = self.vectors.field;
        let mut left = self.vectors.all[vector].clone();
        for (first, row) in self.path.iter().filter_map(|f| f.beyond.as_ref()) {
            f.subtract_multiple(&mut left[*first..], &row[*first..]);
        }
        let here = left.split_off(self.vectors.beyond);
        let mut followed = PathVector {
            vector,
            beyond: None,
            edge: None,
        };
        if let Some(first) = left.iter().position(|&x| x != 0) {
            let scale = f.inv(left[first]);
            left.extend(here);
            left.iter_mut().for_each(|x| *x = f.mul(*x, scale));
            followed.beyond = Some((first, left));
        } else if here.iter().any(|&x| x != 0) {
            followed.edge = Some(self.tree.items.len());
            let width = self.tree.width;
            let vectors = &mut self.tree.vectors;
            let number = *self.known.entry(here).or_insert_with_key(|new| {
                vectors.extend_from_slice(new);
                vectors.len() / width - 1
            });
            self.item(number);
        }
        self.path.push(followed);
    }

    fn item(&mut self, vector: usize) {
        self.tree.items.push(Item {
            depth: self.path.iter().filter(|f| f.edge.is_some()).count(),
            end: self.tree.items.len() + 1,
            longest: 0,
            vector,
            nodes: self.tree.nodes.len(),
        });
    }
}

/// The shortest path to each node that layers lead to, as the numbers of vectors; `added` has what the choices of each layer add, one
/// grown from another, as numbers, too.
pub(super) fn shortest(layers: &[Layer], added: &[Vec<Vec<usize>>]) -> Vec<Vec<usize>> {
    let mut paths = vec![Vec::new()];
    for (layer, added) in layers.iter().zip(added) {
        let to = layer.edges.iter().filter(|&&to| to != DEAD).max();
        let mut next: Vec<Option<Vec<usize>>> = vec![None; to.map_or(0, |&to| to as usize + 1)];
        for (path, edges) in paths.iter().zip(layer.edges.chunks_exact(layer.choices)) {
            for (added, &to) in added.iter().zip(edges).filter(|(_, to)| **to != DEAD) {
                let known = &mut next[to as usize];
                let length = path.len() + added.len();
                if known.as_ref().is_none_or(|k| k.len() > length) {
                    *known = Some([&path[..], added].concat());
                }
            }
        }
        paths = next.into_iter().flatten().collect();
    }
    paths
}

/// What each choice adds, as the numbers of vectors that are put behind those there are.
pub(super) fn numbered(
    growth: &[Grown],
    mut put: impl FnMut(&[Residue]) -> usize,
) -> Vec<Vec<usize>> {
    let mut out = vec![Vec::new(); growth.len()];
    for grown in growth {
        let mut whole: Vec<usize> = grown.from.map_or(Vec::new(), |from| out[from].clone());
        whole.extend(grown.more.iter().map(|v| put(v)));
        out[grown.choice] = whole;
    }
    out
}
