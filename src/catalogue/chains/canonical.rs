//! A canonical numbering of a graph's vertices, and its automorphisms.
//!
//! Vertices are distinguished by their numbers of neighbours of each kind, repeatedly. If some remain equivalent, one of them
//! is set apart and the refinement continues, for each of them in turn. The numbering with the greatest matrix is canonical,
//! and all numberings with this matrix differ by automorphisms (`[McKay 1981]`, without pruning, because chains have few
//! automorphisms).

/// A graph with weighted edges. A weight of 0 means that there is no edge.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Weighted {
    vertices: usize,
    weight: Vec<u8>,
}

impl Weighted {
    /// Creates a graph without edges.
    #[must_use]
    pub fn new(vertices: usize) -> Weighted {
        Weighted {
            vertices,
            weight: vec![0; vertices * vertices],
        }
    }

    /// Returns the number of vertices.
    #[must_use]
    pub fn vertices(&self) -> usize {
        self.vertices
    }

    /// Returns the weight of an edge.
    #[must_use]
    pub fn weight(&self, u: usize, v: usize) -> u8 {
        self.weight[u * self.vertices + v]
    }

    /// Sets the weight of an edge.
    pub fn set(&mut self, u: usize, v: usize, weight: u8) {
        self.weight[u * self.vertices + v] = weight;
        self.weight[v * self.vertices + u] = weight;
    }

    /// Returns the sum of the weights at a vertex.
    #[must_use]
    pub fn degree(&self, v: usize) -> usize {
        self.row(v).iter().map(|&w| usize::from(w)).sum()
    }

    fn row(&self, v: usize) -> &[u8] {
        &self.weight[v * self.vertices..(v + 1) * self.vertices]
    }

    /// Returns the graph with `new` more vertices, joined to none.
    #[must_use]
    pub(super) fn widened(&self, new: usize) -> Weighted {
        let mut out = Weighted::new(self.vertices + new);
        for u in 0..self.vertices {
            for v in 0..self.vertices {
                out.set(u, v, self.weight(u, v));
            }
        }
        out
    }

    /// Returns the graph with its vertices in another order.
    #[must_use]
    pub(crate) fn renumbered(&self, order: &[usize]) -> Weighted {
        let pairs = order
            .iter()
            .flat_map(|&u| order.iter().map(move |&v| (u, v)));
        Weighted {
            vertices: order.len(),
            weight: pairs.map(|(u, v)| self.weight(u, v)).collect(),
        }
    }
}

/// A canonical numbering and the automorphisms.
#[derive(Debug, Clone)]
pub struct Canonical {
    /// The graph so numbered: equal for two graphs exactly where they are isomorphic.
    pub graph: Weighted,
    /// The vertex at each place.
    pub order: Vec<usize>,
    /// Every automorphism as the images of the vertices, the identity among them.
    pub automorphisms: Vec<Vec<usize>>,
}

/// Numbers a graph.
///
/// # Complexity
/// One refinement for each leaf of the search; at least as many leaves as automorphisms.
///
/// # Examples
/// ```
/// use ozols::chains::canonical::{Weighted, number_graph};
/// let path = |edges: [[usize; 2]; 2]| {
///     let mut graph = Weighted::new(3);
///     edges.iter().for_each(|&[u, v]| graph.set(u, v, 1));
///     number_graph(&graph).graph
/// };
/// assert_eq!(path([[0, 1], [1, 2]]), path([[1, 0], [0, 2]]));
/// ```
#[must_use]
pub fn number_graph(graph: &Weighted) -> Canonical {
    let n = graph.vertices;
    let mut search = LabelSearch {
        graph,
        best: None,
        equal: Vec::new(),
        near: vec![NOTHING; n * n],
        order: (0..n).collect(),
    };
    let mut cells = vec![0; n];
    search.refine_cells(&mut cells);
    search.search_cells(&cells);
    let (matrix, order) = search.best.expect("the search has a leaf");
    let onto = |other: &Vec<usize>| {
        let mut image = vec![0; order.len()];
        for (&from, &to) in order.iter().zip(other) {
            image[from] = to;
        }
        image
    };
    Canonical {
        automorphisms: search.equal.iter().map(onto).collect(),
        graph: matrix,
        order,
    }
}

/// Fills a row after all neighbours of a vertex. It is less than any of them, so a prefix of a list is less than the list.
const NOTHING: u32 = 0;

struct LabelSearch<'a> {
    graph: &'a Weighted,
    best: Option<(Weighted, Vec<usize>)>,
    /// The numberings that give the best matrix.
    equal: Vec<Vec<usize>>,
    /// A row for each vertex: the cells and weights of its neighbours, sorted.
    near: Vec<u32>,
    order: Vec<usize>,
}

impl LabelSearch<'_> {
    /// Distinguishes the vertices of each cell by the cells of their neighbours until nothing changes. A cell's number is the
    /// place of its first vertex.
    fn refine_cells(&mut self, cells: &mut [usize]) {
        let n = self.graph.vertices;
        let mut count = 0;
        loop {
            for (v, near) in self.near.chunks_mut(n).enumerate() {
                let all = self.graph.row(v).iter().zip(&*cells);
                let kinds = all.filter(|(w, _)| **w > 0);
                #[allow(clippy::cast_possible_truncation, reason = "some ten vertices")]
                let kinds = kinds.map(|(&w, &c)| (c as u32) << 8 | u32::from(w));
                let mut filled = 0;
                for (place, kind) in near.iter_mut().zip(kinds) {
                    *place = kind;
                    filled += 1;
                }
                near[..filled].sort_unstable();
                near[filled..].fill(NOTHING);
            }
            let key = |v: usize| (cells[v], &self.near[v * n..(v + 1) * n]);
            self.order
                .sort_unstable_by(|&u, &v| (key(u), u).cmp(&(key(v), v)));
            let starts = |i: usize| i == 0 || key(self.order[i - 1]) != key(self.order[i]);
            let first: Vec<bool> = (0..n).map(starts).collect();
            let (mut cell, mut found) = (0, 0);
            for (i, &v) in self.order.iter().enumerate() {
                if first[i] {
                    (cell, found) = (i, found + 1);
                }
                cells[v] = cell;
            }
            if found == count {
                return;
            }
            count = found;
        }
    }

    fn search_cells(&mut self, cells: &[usize]) {
        let n = cells.len();
        let size = |c: usize| cells.iter().filter(|x| **x == c).count();
        let Some(cell) = (0..n).find(|&c| size(c) > 1) else {
            self.take_leaf(cells);
            return;
        };
        for v in (0..n).filter(|&v| cells[v] == cell) {
            let mut apart = cells.to_vec();
            for (u, c) in apart.iter_mut().enumerate() {
                *c += usize::from(cells[u] == cell && u != v);
            }
            self.refine_cells(&mut apart);
            self.search_cells(&apart);
        }
    }

    fn take_leaf(&mut self, cells: &[usize]) {
        let mut order = vec![0; cells.len()];
        for (v, &place) in cells.iter().enumerate() {
            order[place] = v;
        }
        let matrix = self.graph.renumbered(&order);
        match &self.best {
            Some((best, _)) if *best > matrix => {}
            Some((best, _)) if *best == matrix => self.equal.push(order),
            _ => {
                self.equal = vec![order.clone()];
                self.best = Some((matrix, order));
            }
        }
    }
}
