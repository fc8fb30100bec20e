//! The closure matrices of all variants at once: every choice's columns, written out in full, in any number system.

use crate::closure::contour::contour_basis;
use crate::closure::tree::path_from_frame;
use crate::geom::scalars::Scalars;
use crate::model::mechanism::{JointId, StateId};
use crate::search::conditions::Search;

/// What a choice puts at each joint of its variable: twists, each with the joint's entries in the rows of its couplings
/// behind it.
pub type Spans<N> = Vec<Vec<Vec<N>>>;

/// Columns of every choice. Those of a variant, side by side, are its matrix: first the rows of the free state (contours,
/// then couplings), then those of the kept links' motion, then those that the searched state adds.
#[derive(Debug)]
pub struct WrittenOut<N> {
    /// How many rows there are of each kind.
    pub rows: [usize; 3],
    /// `columns[variable][choice]`.
    columns: Vec<Vec<Vec<Vec<N>>>>,
}

impl<N: Clone + Default> WrittenOut<N> {
    /// The columns of a search's space, from what each choice of each variable spans.
    #[must_use]
    pub fn new<S: Scalars<Number = N>>(
        s: &S,
        search: &Search,
        spans: &[Vec<Spans<N>>],
    ) -> WrittenOut<N> {
        let (mechanism, space) = (&*search.mechanism, &search.space);
        let d = space.dim;
        let free = contour_basis(mechanism, StateId::FREE);
        let state: StateId = space.state.unwrap_or(StateId::FREE);
        let all = contour_basis(mechanism, state);
        let kept = search.kept.0.iter();
        let paths: Vec<Vec<(JointId, bool)>> = kept
            .map(|&l| path_from_frame(mechanism, StateId::FREE, l))
            .collect();
        let signs = |j: JointId| {
            let contours = free.iter().map(move |c| c.direction(j));
            let links = paths
                .iter()
                .map(move |p| p.iter().find(|(q, _)| *q == j).map(|(_, s)| *s));
            let added = all[free.len()..].iter().map(move |c| c.direction(j));
            contours.chain(links).chain(added).collect::<Vec<_>>()
        };
        // Couplings by index, those of the free state and those that the state adds.
        let present = |q: usize, s: StateId| {
            let states = &mechanism.joints[mechanism.couplings[q].ends[0].joint].states;
            states.as_ref().is_none_or(|of| of.contains(&s))
        };
        let all_couplings = 0..mechanism.couplings.len();
        let coupled: Vec<usize> = all_couplings
            .clone()
            .filter(|&q| present(q, StateId::FREE))
            .collect();
        let adds = |q: &usize| present(*q, state) && !present(*q, StateId::FREE);
        let added_couplings: Vec<usize> = all_couplings.filter(adds).collect();
        let column = |j: JointId, signs: &[Option<bool>], twist: &[N]| {
            let mut blocks = signs.iter().map(|sign| match sign {
                None => vec![N::default(); d],
                Some(true) => twist[..d].to_vec(),
                Some(false) => {
                    let minus = |t: &N| s.sub(N::default(), t.clone());
                    twist[..d].iter().map(minus).collect()
                }
            });
            let rates = |list: &[usize]| -> Vec<N> {
                let at = |q: usize| mechanism.couplings_of(j).position(|(c, _)| c == q);
                let entry = |&q: &usize| at(q).map_or_else(N::default, |i| twist[d + i].clone());
                list.iter().map(entry).collect()
            };
            let mut out = blocks
                .by_ref()
                .take(free.len())
                .flatten()
                .collect::<Vec<_>>();
            out.extend(rates(&coupled));
            out.extend(blocks.flatten());
            out.extend(rates(&added_couplings));
            out
        };
        let columns = space
            .variables
            .iter()
            .zip(spans)
            .map(|(v, choices)| {
                let signs: Vec<_> = v.joints.iter().map(|&j| (j, signs(j))).collect();
                let of_choice = |spans: &Spans<N>| {
                    spans
                        .iter()
                        .zip(&signs)
                        .flat_map(|(span, (j, s))| span.iter().map(|t| column(*j, s, t)))
                        .collect()
                };
                choices.iter().map(of_choice).collect()
            })
            .collect();
        WrittenOut {
            rows: [
                free.len() * d + coupled.len(),
                paths.len() * d,
                (all.len() - free.len()) * d + added_couplings.len(),
            ],
            columns,
        }
    }

    /// The columns of a variant.
    pub fn chosen<'a>(&'a self, choices: &'a [usize]) -> impl Iterator<Item = &'a Vec<N>> {
        let chosen = choices.iter().enumerate();
        chosen.flat_map(|(v, &c)| &self.columns[v][c])
    }
}
