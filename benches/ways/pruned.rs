//! A depth-first search over the joints that skips branches without determinate variants. It is the usual method without a
//! diagram, and serves the comparison of speed.
//!
//! [`brute`](ozols::search::check::brute) eliminates every variant's matrix from the start. Here a branch keeps what its joints so far have
//! eliminated, and ends where even all that the joints to come offer at once cannot raise the rank far enough.

use ozols::linalg::modp::{Field, Residue};
use ozols::search::check::brute::{Matrices, Seen};
use ozols::search::question::Question;

/// A depth-first search over the variables of a question.
#[derive(Debug)]
pub(crate) struct Pruned {
    field: Field,
    all: Matrices,
    /// The order in which variables are chosen.
    pub(crate) order: Vec<usize>,
    /// For each place in the order what every choice there and behind it offers, eliminated.
    to_come: Vec<Echelon>,
    /// Redundant constraints that a determinate variant may have.
    allowed: usize,
}

/// Vectors eliminated one by one: none leads where another does.
#[derive(Debug, Clone, Default)]
struct Echelon {
    /// Each with the place of its first entry that is not zero.
    vectors: Vec<(usize, Vec<Residue>)>,
}

impl Echelon {
    /// Adds what is new in a vector.
    fn add_vector(&mut self, f: Field, vector: &[Residue]) {
        let mut v = vector.to_vec();
        while let Some(lead) = v.iter().position(|x| *x != 0) {
            let Some((_, by)) = self.vectors.iter().find(|(l, _)| *l == lead) else {
                self.vectors.push((lead, v));
                return;
            };
            // Cross-multiplication needs no inverse.
            let (a, b) = (by[lead], v[lead]);
            for (x, &y) in v[lead..].iter_mut().zip(&by[lead..]) {
                *x = f.sub(f.mul(a, *x), f.mul(b, y));
            }
        }
    }

    /// Returns the rank of the first rows.
    fn rank_of_rows(&self, rows: usize) -> usize {
        self.vectors.iter().filter(|(lead, _)| *lead < rows).count()
    }
}

impl Pruned {
    /// Writes the columns of a search's space out, to be chosen in an order of its variables.
    pub(crate) fn new(question: &Question, order: &[usize]) -> Pruned {
        let field = question.field().field();
        let all = Matrices::new(question);
        let free = all.row_counts()[0];
        let mut to_come = vec![Echelon::default()];
        for &v in order.iter().rev() {
            let mut here = to_come.last().cloned().unwrap_or_default();
            for column in all.columns_of(v).iter().flatten() {
                here.add_vector(field, &column[..free]);
            }
            to_come.push(here);
        }
        to_come.reverse();
        Pruned {
            field,
            all,
            order: order.to_vec(),
            to_come,
            allowed: question.conditions.max_redundant as usize,
        }
    }

    /// Visits the determinate variants that begin with the given choices, in the order of the variables.
    ///
    /// # Complexity
    /// O(rows²) for each column of each visited branch. As much for each later vector while the rank is too small.
    pub(crate) fn visit_determinate(
        &self,
        beginning: &[usize],
        leaf: &mut dyn FnMut(&[usize], Seen),
    ) {
        let mut choices = vec![0; self.order.len()];
        let mut so_far = Echelon::default();
        for (place, &c) in beginning.iter().enumerate() {
            choices[self.order[place]] = c;
            if !self.enter_choice(place, c, &mut so_far) {
                return;
            }
        }
        self.visit_branch(beginning.len(), &mut choices, &mut so_far, leaf);
    }

    /// Returns the result for one variant. `None` if its branch is skipped.
    pub(crate) fn look_at(&self, choices: &[usize]) -> Option<Seen> {
        let mut found = None;
        let beginning: Vec<usize> = self.order.iter().map(|&v| choices[v]).collect();
        self.visit_determinate(&beginning, &mut |_, seen| found = Some(seen));
        found
    }

    /// Takes a choice; says whether a determinate variant may still come of it.
    fn enter_choice(&self, place: usize, choice: usize, so_far: &mut Echelon) -> bool {
        let [free, kept, _] = self.all.row_counts();
        for column in &self.all.columns_of(self.order[place])[choice] {
            so_far.add_vector(self.field, &column[..free + kept]);
        }
        let enough = free.saturating_sub(self.allowed);
        if so_far.rank_of_rows(free) >= enough {
            return true;
        }
        let mut most = Echelon::default();
        let within = so_far.vectors.iter().map(|(_, v)| &v[..free]);
        let later = self.to_come[place + 1].vectors.iter().map(|(_, v)| &v[..]);
        within.chain(later).any(|v| {
            most.add_vector(self.field, v);
            most.vectors.len() >= enough
        })
    }

    fn visit_branch(
        &self,
        place: usize,
        choices: &mut [usize],
        so_far: &mut Echelon,
        leaf: &mut dyn FnMut(&[usize], Seen),
    ) {
        let Some(&v) = self.order.get(place) else {
            leaf(choices, self.seen_of(choices, so_far));
            return;
        };
        let known = so_far.vectors.len();
        for c in 0..self.all.columns_of(v).len() {
            choices[v] = c;
            if self.enter_choice(place, c, so_far) {
                self.visit_branch(place + 1, choices, so_far, leaf);
            }
            so_far.vectors.truncate(known);
        }
    }

    fn seen_of(&self, choices: &[usize], whole: &Echelon) -> Seen {
        let [free, kept, state] = self.all.row_counts();
        let redundant = free - whole.rank_of_rows(free);
        let mut of_state = Echelon::default();
        for (v, &c) in choices.iter().enumerate() {
            for column in &self.all.columns_of(v)[c] {
                of_state.add_vector(self.field, &column[free + kept..]);
            }
        }
        let external = match state {
            0 => 0,
            _ => (state - of_state.vectors.len()) as i32 - redundant as i32,
        };
        Seen {
            internal: redundant as u32,
            external,
            motion: whole.vectors.len() - whole.rank_of_rows(free),
            lasts: None,
        }
    }
}
