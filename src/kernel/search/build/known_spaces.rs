//! The different spaces that known ways lead to.

use crate::linalg::modp::Residue;
use crate::search::build::completing_sets::nodes;
use hashbrown::HashTable;

/// Different spaces, packed, each with the choices on one of the ways that add it, and the nodes that such ways lead to: from the back
/// many lead to one space.
pub(super) struct Spaces {
    /// One after another, and where each starts; one more at the end.
    packed: Vec<Residue>,
    starts: Vec<usize>,
    table: HashTable<(u64, usize)>,
    /// So many of each.
    choices: Vec<usize>,
    depth: usize,
    /// A set of nodes for each, in so many words.
    nodes: Vec<u64>,
    words: usize,
}

impl Spaces {
    /// None yet, of ways of so many choices to so many nodes.
    pub(super) fn new(depth: usize, nodes: usize) -> Spaces {
        Spaces {
            packed: Vec::new(),
            starts: vec![0],
            table: HashTable::new(),
            choices: Vec::new(),
            depth,
            nodes: Vec::new(),
            words: nodes.div_ceil(64),
        }
    }

    /// That of nothing, at the one node before all choices.
    pub(super) fn root() -> Spaces {
        let mut root = Spaces::new(0, 1);
        let one = root.find(0, &[], &[], 0);
        root.put(one, 0);
        root
    }

    pub(super) fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// Nodes that there can be.
    pub(super) fn node_count(&self) -> usize {
        64 * self.words
    }

    pub(super) fn packed(&self, space: usize) -> &[Residue] {
        &self.packed[self.starts[space]..self.starts[space + 1]]
    }

    /// The choices on one of the ways to a space.
    pub(super) fn way(&self, space: usize) -> &[usize] {
        &self.choices[space * self.depth..][..self.depth]
    }

    /// The nodes that ways to a space lead to.
    pub(super) fn nodes(&self, space: usize) -> impl Iterator<Item = usize> {
        nodes(&self.nodes[space * self.words..][..self.words])
    }

    /// Puts a node to those of a space.
    pub(super) fn put(&mut self, space: usize, node: usize) {
        self.nodes[space * self.words + node / 64] |= 1 << (node % 64);
    }

    /// The number of a space with a hash, to which a choice more leads: a new one where it is not there yet.
    pub(super) fn find(
        &mut self,
        hash: u64,
        packed: &[Residue],
        before: &[usize],
        choice: usize,
    ) -> usize {
        let same = |&(h, space): &(u64, usize)| h == hash && self.packed(space) == packed;
        if let Some(&(_, space)) = self.table.find(hash, same) {
            return space;
        }
        let space = self.len();
        self.table.insert_unique(hash, (hash, space), |(h, _)| *h);
        self.packed.extend_from_slice(packed);
        self.starts.push(self.packed.len());
        self.choices.extend_from_slice(before);
        let last = std::iter::repeat_n(choice, self.depth - before.len());
        self.choices.extend(last);
        self.nodes.extend(std::iter::repeat_n(0, self.words));
        space
    }
}
