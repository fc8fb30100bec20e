//! Relaxed nodes: a node represents several spaces by their intersection, their sum, and bounds of their dimensions.
//!
//! A diagram in the space dual to self-stresses has too many nodes if each part can be chosen in many ways that differ a
//! little. Some of them are merged into a node that bounds each of them from below and above: it has the futures of each,
//! and maybe more. So a diagram of such nodes has every variant, and its count is an upper bound.
//!
//! # Sources
//! Bergman, Cire, van Hoeve & Hooker, "Discrete optimization with decision diagrams", INFORMS J. Comput. 28 (2016): diagrams
//! relaxed by merging nodes.

use crate::linalg::modp::Residue;
use crate::search::diagram::reduced_rows::{Arithmetic, Rows};
use crate::search::diagram::stage::Columns;

/// Spaces that contain one, lie within another, and reach no more than so many dimensions; one space where both are the same.
#[derive(Clone, Default)]
pub(in crate::search) struct Between {
    /// The intersection of the spaces.
    all: Rows,
    /// The sum of the spaces; `None` if there is one space.
    any: Option<Rows>,
    /// How many dimensions one has at most in the coordinates before each boundary to come.
    most: Vec<usize>,
    /// How many dimensions each has.
    least: usize,
}

/// A stage for relaxed nodes.
pub(in crate::search) struct Passed<'a> {
    pub(in crate::search) columns: &'a Columns,
    /// Coordinates of contours before each place where some end, from this stage on.
    pub(in crate::search) bounds: &'a [usize],
}

impl Between {
    /// Creates the relaxed node of one space, with the boundaries to come.
    pub(in crate::search) fn from_rows(all: Rows, bounds: &[usize]) -> Between {
        Between {
            most: bounds.iter().map(|&b| all.rank_before(b)).collect(),
            least: all.rank(),
            any: None,
            all,
        }
    }

    fn any_rows(&self) -> &Rows {
        self.any.as_ref().unwrap_or(&self.all)
    }

    /// Returns the one space, packed. `None` if there are several.
    pub(in crate::search) fn packed_space(&self) -> Option<Vec<Residue>> {
        self.any.is_none().then(|| self.all.to_packed())
    }

    /// Returns numbers that identify the node.
    pub(in crate::search) fn identity_words(&self) -> Vec<u64> {
        let mut out = self.all.to_packed();
        if let Some(any) = &self.any {
            out.push(u64::MAX);
            any.pack_beyond(0, &mut out);
            out.extend(self.most.iter().chain([&self.least]).map(|&x| x as u64));
        }
        out
    }

    /// Returns the numbers that merged nodes must have in common; there are more of them at higher levels, of which there are [`LEVELS`].
    pub(in crate::search) fn merge_kind(&self, level: usize) -> Vec<usize> {
        let mut out = match level {
            0 => self.most.first().copied().into_iter().collect(),
            _ => self.most.clone(),
        };
        if level > 1 {
            out.push(self.least);
        }
        if level > 2 {
            out.extend(&self.any_rows().pivots);
            out.push(usize::MAX);
            out.extend(&self.all.pivots);
        }
        out
    }

    /// Takes another in.
    pub(in crate::search) fn join_node(&mut self, arithmetic: &mut Arithmetic, other: &Between) {
        let mut any = self.any.take().unwrap_or_else(|| self.all.clone());
        let mut row = Vec::new();
        for v in other.any_rows().rows() {
            row.clear();
            row.extend_from_slice(v);
            any.insert(arithmetic, &mut row);
        }
        self.all = self.all.intersect_with(arithmetic, &other.all);
        self.any = Some(any);
        let most = self.most.iter_mut().zip(&other.most);
        most.for_each(|(x, &y)| *x = (*x).max(y));
        self.least = self.least.min(other.least);
    }

    /// Returns the node in the coordinates of a stage, with its own sum.
    fn enter_stage(&self, columns: &Columns) -> Between {
        let widened = |rows: &Rows| rows.widen_to(columns.width, &columns.places);
        Between {
            all: widened(&self.all),
            any: Some(widened(self.any_rows())),
            ..self.clone()
        }
    }

    /// Returns the children at a stage for each choice; `None` if no space of the node has a completion.
    pub(in crate::search) fn child_nodes(
        &self,
        arithmetic: &mut Arithmetic,
        over: &Passed<'_>,
    ) -> Vec<Option<Between>> {
        let (growth, base) = (&over.columns.growth, self.enter_stage(over.columns));
        let mut grown: Vec<Option<Between>> = vec![None; growth.len()];
        for g in growth {
            let mut next = match g.from {
                Some(from) => grown[from].clone().unwrap_or_default(),
                None => base.clone(),
            };
            next.add_vectors(arithmetic, &g.more, over.bounds);
            grown[g.choice] = Some(next);
        }
        let ended = |b: Option<Between>| b?.drop_ended(over);
        grown.into_iter().map(ended).collect()
    }

    /// Adds vectors.
    fn add_vectors(
        &mut self,
        arithmetic: &mut Arithmetic,
        vectors: &[Vec<Residue>],
        bounds: &[usize],
    ) {
        let mut any = self.any.take().unwrap_or_default();
        let before: Vec<usize> = bounds.iter().map(|&b| self.all.rank_before(b)).collect();
        let possible = any.rank();
        let mut row = Vec::new();
        for v in vectors {
            for rows in [&mut self.all, &mut any] {
                row.clone_from(v);
                rows.insert(arithmetic, &mut row);
            }
        }
        // No space gains more than the smallest, and none less than the largest.
        for ((most, &bound), before) in self.most.iter_mut().zip(bounds).zip(before) {
            *most = (*most + self.all.rank_before(bound) - before).min(any.rank_before(bound));
        }
        self.least = (self.least + any.rank() - possible).max(self.all.rank());
        self.any = Some(any);
        // Fewer coordinates reach no more, and a block no more than it has.
        for i in (1..self.most.len()).rev() {
            self.most[i - 1] = self.most[i - 1].min(self.most[i]);
        }
        for i in 1..self.most.len() {
            self.most[i] = self.most[i].min(self.most[i - 1] + bounds[i] - bounds[i - 1]);
        }
    }

    /// Drops the coordinates that no later stage reaches. Returns `None` if a contour stays redundant, or if a kept link moves wrongly.
    fn drop_ended(mut self, over: &Passed<'_>) -> Option<Between> {
        let gap = over.columns.closing;
        let in_contours = self.most.last().copied().unwrap_or(0);
        let goes_wrong = self.all.starts_behind(over.columns.contours);
        if goes_wrong || self.least > in_contours {
            return None;
        }
        if gap > 0 {
            if self.most[0] < gap {
                return None;
            }
            self.all.drop_first(gap);
            self.any.as_mut()?.drop_first(gap);
            self.most.remove(0);
            for (most, &bound) in self.most.iter_mut().zip(&over.bounds[1..]) {
                *most = most.checked_sub(gap)?;
                if *most < self.all.rank_before(bound - gap) {
                    return None;
                }
            }
            self.least = self.least.saturating_sub(gap).max(self.all.rank());
        }
        Some(self)
    }
}

/// Levels of [`Between::kind`].
pub(in crate::search) const LEVELS: usize = 4;
