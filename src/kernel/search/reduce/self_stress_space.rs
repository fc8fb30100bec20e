//! The vectors that choices add to the original joints, in the space dual to the original self-stresses.
//!
//! Every choice allows the motions of the original joint, so every variant closes what the original joints close. The rest
//! of the closure equations has a dimension for each self-stress of the original mechanism: 11 for the ten-link gripper,
//! whose equations have 24 rows. A variant has no redundant constraint if its added motions span that space. The motions of
//! kept links are further coordinates, modulo the original motions. A variant keeps them if no added motion closes every
//! contour and moves a kept link.
//!
//! The coordinates are ordered by the last variable that reaches them. Those that later variables do not reach come first,
//! so all that is forgotten after a variable is in front. Each coordinate starts as late as possible.

use crate::closure::contour::Contour;
use crate::closure::tree::{path_in, spanning_tree};
use crate::linalg::echelon::{Combinations, Echelon};
use crate::linalg::modp::{Field, Residue};
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::motion::displacement_series::shifted_multiples;
use crate::search::question::kept::Kept;
use crate::search::question::space::Variable;
use crate::search::reduce::lifetimes::{Added, AddedBy, Lifetime, Offered, shorten_lifetimes};
use std::borrow::{Borrow, Cow};
use std::ops::Range;

/// The vectors that the choices of some variables add, in coordinates for their order.
#[derive(Debug)]
pub(in crate::search) struct SelfStressSpace {
    /// For each variable in order and each of its choices, independent vectors of what it adds: the coordinates of the contours, then
    /// those of kept links.
    pub(in crate::search) added: Vec<Vec<Vec<Added>>>,
    /// When each coordinate of the contours is in use, by the last variable that reaches it.
    pub(in crate::search) contours: Vec<Lifetime>,
    /// When each coordinate of kept links is, likewise.
    pub(in crate::search) kept: Vec<Lifetime>,
    /// Self-stresses that every variant has.
    pub(in crate::search) lasting: u32,
    /// Whether a kept link moves at present: such motions are divided out.
    pub(in crate::search) moves_kept: bool,
}

/// The rows to which the motion of each joint contributes: its contours, its couplings, and the links it moves.
pub(in crate::search) struct ClosingRows<'m> {
    mechanism: &'m Mechanism,
    dim: usize,
    contours: Cow<'m, [Contour]>,
    /// Couplings of the state, by their numbers.
    couplings: Vec<usize>,
    /// The joints on the way to each kept link, or from one link to another.
    paths: Vec<Vec<(JointId, bool)>>,
    /// Whether the rates of kept drives matter.
    keeps_drives: bool,
}

impl<'m> ClosingRows<'m> {
    /// Returns the rows of the contours of the free state, and those of kept links and drives where these matter.
    pub(in crate::search) fn for_free_state(
        mechanism: &'m Mechanism,
        dim: usize,
        contours: impl Into<Cow<'m, [Contour]>>,
        kept: Option<&Kept>,
    ) -> Self {
        let tree = spanning_tree(mechanism, StateId::FREE);
        let paths = kept.map_or_else(Vec::new, |k| {
            k.links.iter().map(|&l| path_in(&tree, l)).collect()
        });
        let rows = ClosingRows::in_state(mechanism, dim, StateId::FREE, contours, paths);
        ClosingRows {
            keeps_drives: kept.is_some(),
            ..rows
        }
    }

    /// Returns the rows of the contours of a state, and those of the motion over paths of joints.
    pub(in crate::search) fn in_state(
        mechanism: &'m Mechanism,
        dim: usize,
        state: StateId,
        contours: impl Into<Cow<'m, [Contour]>>,
        paths: Vec<Vec<(JointId, bool)>>,
    ) -> Self {
        let present: Vec<JointId> = mechanism.joints_in(state).collect();
        let couplings = (0..mechanism.couplings.len()).filter(|&q| {
            let mut ends = mechanism.couplings[q].ends.iter();
            ends.all(|e| present.binary_search(&e.joint).is_ok())
        });
        ClosingRows {
            mechanism,
            dim,
            contours: contours.into(),
            couplings: couplings.collect(),
            paths,
            keeps_drives: false,
        }
    }

    /// Returns how many numbers a twist of a joint has, its rates included.
    pub(in crate::search) fn twist_width(&self, joint: JointId) -> usize {
        self.dim + self.mechanism.rates_of(joint)
    }

    /// Returns the number of rows of kept links and drives.
    pub(in crate::search) fn count_kept(&self) -> usize {
        let drives = if self.keeps_drives {
            self.mechanism.kept_drives()
        } else {
            0
        };
        self.paths.len() * self.dim + drives
    }

    /// Returns the number of rows of contours, couplings and locked drives.
    pub(in crate::search) fn count_closing(&self) -> usize {
        self.contours.len() * self.dim + self.couplings.len() + self.mechanism.locked_drives()
    }

    /// Returns the columns of a choice at all joints of its variable.
    pub(in crate::search) fn choice_columns(
        &self,
        f: Field,
        variable: &Variable,
        choice: usize,
    ) -> Vec<Vec<Residue>> {
        let joints = variable.joints.iter().zip(&variable.choices[choice].spans);
        let of_joint = |(&j, span): (&JointId, &Vec<Vec<Residue>>)| self.joint_columns(f, j, span);
        joints.flat_map(of_joint).collect()
    }

    /// Returns the columns of a freedom along the motion times each power of t, as vectors over the field. The coordinates
    /// of the contours at each power of t come first, then those of kept links.
    pub(in crate::search) fn series_multiples(
        &self,
        f: Field,
        joint: JointId,
        series: &[Vec<Residue>],
    ) -> Vec<Vec<Residue>> {
        let terms = self.joint_columns(f, joint, series);
        let parts = terms.iter().map(|t| t.split_at(self.count_closing()));
        let (of_contours, of_kept): (Vec<_>, Vec<_>) = parts.unzip();
        let both = shifted_multiples(&of_contours)
            .into_iter()
            .zip(shifted_multiples(&of_kept));
        both.map(|(a, b)| [a, b].concat()).collect()
    }

    /// Returns the column of each of some twists of a joint, with its rates behind it.
    pub(in crate::search) fn joint_columns(
        &self,
        f: Field,
        joint: JointId,
        twists: &[Vec<Residue>],
    ) -> Vec<Vec<Residue>> {
        let parts = self.row_parts(joint);
        let column = |twist: &Vec<Residue>| {
            let mut out = vec![0; self.count_closing() + self.count_kept()];
            for &(at, part) in &parts {
                match part {
                    Part::Twist { forward } => {
                        let d = self.dim;
                        f.add_or_subtract(&mut out[at..at + d], &twist[..d], forward);
                    }
                    Part::Rate(rate) => out[at] = f.add(out[at], twist[self.dim + rate]),
                }
            }
            out
        };
        twists.iter().map(column).collect()
    }

    /// Returns the rows that the motion of a joint goes to, each with what goes there.
    pub(in crate::search) fn row_parts(&self, joint: JointId) -> Vec<(usize, Part)> {
        let (d, closing) = (self.dim, self.count_closing());
        let couplings = self.contours.len() * d;
        let contours = self.contours.iter().enumerate();
        let contours = contours.filter_map(|(i, c)| Some((i * d, c.direction_of(joint)?)));
        let paths = self.paths.iter().enumerate().filter_map(|(i, path)| {
            let (_, forward) = path.iter().find(|(j, _)| *j == joint)?;
            Some((closing + i * d, *forward))
        });
        let twists = contours.chain(paths);
        let mut out: Vec<(usize, Part)> = twists
            .map(|(at, forward)| (at, Part::Twist { forward }))
            .collect();
        for (i, (q, _)) in self.mechanism.couplings_of(joint).enumerate() {
            let at = self.couplings.iter().position(|&x| x == q);
            out.extend(at.map(|at| (couplings + at, Part::Rate(i))));
        }
        if let Some(drive) = self.mechanism.drive_at(joint) {
            let first = if self.mechanism.search.locks_drives {
                Some(couplings + self.couplings.len())
            } else {
                self.keeps_drives.then_some(closing + self.paths.len() * d)
            };
            let rate = Part::Rate(self.mechanism.rates_of(joint) - 1);
            out.extend(first.map(|first| (first + drive, rate)));
        }
        out
    }
}

/// The part of a joint's motion that contributes to a row.
#[derive(Clone, Copy)]
pub(in crate::search) enum Part {
    /// The twist, to this row and those after it.
    Twist { forward: bool },
    /// One of the rates behind it.
    Rate(usize),
}

/// Reduces vectors modulo the motions of the original joints.
struct BesidePresent {
    present: Echelon,
    width: usize,
    /// The coordinates that are left.
    open: Vec<usize>,
}

impl BesidePresent {
    /// Prepares the reduction, for vectors of a width.
    fn new(field: Field, all: impl Iterator<Item = Added>, width: usize) -> BesidePresent {
        let present = Echelon::from_vectors(field, all);
        let pivots = present.pivots();
        let open = (0..width).filter(|i| !pivots.contains(i)).collect();
        BesidePresent {
            present,
            width,
            open,
        }
    }

    /// Returns the reduced unit vectors of some coordinates.
    fn left_units(&self, field: Field, coordinates: Range<usize>) -> Echelon {
        let units = coordinates.map(|i| {
            let mut unit = vec![0; self.width];
            unit[i] = field.one();
            self.left_of(unit)
        });
        Echelon::from_vectors(field, units)
    }

    /// Returns a reduced vector.
    fn left_of(&self, mut column: Vec<Residue>) -> Vec<Residue> {
        self.present.reduce_vector(&mut column);
        self.open.iter().map(|&i| column[i]).collect()
    }
}

/// Independent vectors, and for each the last variable that reaches it.
#[derive(Default)]
struct Reached {
    vectors: Vec<Vec<Residue>>,
    by: Vec<usize>,
}

impl Reached {
    /// Returns the vectors of variables beyond `known`, in the coordinates from `first` on. Starting at the last variable, each vector is
    /// listed with the last variable that reaches it.
    fn last_reached(added: &[AddedBy], first: usize, mut known: Echelon) -> Reached {
        let mut out = Reached::default();
        for of_variable in added.chunk_by(|a, b| a.0 == b.0).rev() {
            for (t, v) in of_variable {
                if known.insert(&v[first..]) {
                    out.vectors.push(v[first..].to_vec());
                    out.by.push(*t);
                }
            }
        }
        out.reverse_order()
    }

    /// Reverses the order, so that the first variable's own vectors come first.
    fn reverse_order(mut self) -> Self {
        self.vectors.reverse();
        self.by.reverse();
        self
    }
}

impl SelfStressSpace {
    /// Returns the space of what some variables in their order offer, where the motions of the links that `rows` has matter. All choices
    /// have the vectors in `present`. The vectors have each row so many `times`: once in the drawn pose, and once for each power of t along
    /// a motion.
    ///
    /// # Complexity
    /// O(n·m²) field operations for n vectors of all choices with m rows.
    pub(in crate::search) fn new(
        field: Field,
        rows: &ClosingRows<'_>,
        times: usize,
        present: impl Iterator<Item = Added>,
        offered: impl ExactSizeIterator<Item = Offered>,
    ) -> SelfStressSpace {
        let closing = times * rows.count_closing();
        let width = closing + times * rows.count_kept();
        let beside = BesidePresent::new(field, present, width);
        let moves_kept = beside.present.pivots().iter().any(|&p| p >= closing);
        // Motions of the kept links, and what the choices add.
        let links = beside.left_units(field, closing..width);
        let mut vectors: Vec<AddedBy> = Vec::new();
        let mut choices: Vec<Vec<Vec<usize>>> = Vec::with_capacity(offered.len());
        for (t, of) in offered.enumerate() {
            let mut number = |v: Added| {
                let left = beside.left_of(v);
                // All choices have what leaves nothing.
                let is_new = left.iter().any(|&x| x != 0);
                is_new.then(|| {
                    vectors.push((t, left));
                    vectors.len() - 1
                })
            };
            let numbers: Vec<Option<usize>> = of.vectors.into_iter().map(&mut number).collect();
            let of_choice = |all: &Vec<usize>| all.iter().filter_map(|&i| numbers[i]).collect();
            choices.push(of.choices.iter().map(of_choice).collect());
        }
        let self_stresses = beside.open.len() - links.rank();
        let contours = Reached::last_reached(&vectors, 0, links.clone());
        let count = contours.vectors.len();
        let mut both = contours.vectors;
        both.extend(links.reduced_rows());
        let basis = Combinations::new(field, &both);
        for (_, vector) in &mut vectors {
            *vector = basis.factors_of(vector).expect("in the span");
        }
        let kept = Reached::last_reached(&vectors, count, Echelon::new(field));
        let of_links = Combinations::new(field, &kept.vectors);
        for (_, vector) in &mut vectors {
            let links = of_links.factors_of(&vector[count..]);
            vector.splice(count.., links.expect("in the span"));
        }
        let all = count + kept.vectors.len();
        let contours = shorten_lifetimes(field, &mut vectors, 0..count, &contours.by);
        let kept = shorten_lifetimes(field, &mut vectors, count..all, &kept.by);
        let independent = |of: &Vec<usize>| {
            Echelon::from_vectors(field, of.iter().map(|&i| &vectors[i].1)).reduced_rows()
        };
        let added = choices
            .iter()
            .map(|of_variable| of_variable.iter().map(independent).collect())
            .collect();
        SelfStressSpace {
            lasting: u32::try_from(self_stresses - count).unwrap_or(u32::MAX),
            added,
            contours,
            kept,
            moves_kept,
        }
    }
}

/// Returns whether each of some spans has all of the first.
pub(in crate::search) fn is_contained<V: Borrow<Vec<Vec<Residue>>>>(
    field: Field,
    spans: &[V],
) -> bool {
    let [present, others @ ..] = spans else {
        return true;
    };
    others.iter().all(|span| {
        let whole = Echelon::from_vectors(field, span.borrow());
        present.borrow().iter().all(|t| whole.contains(t))
    })
}
