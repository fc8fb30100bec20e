//! Ways to go on in an order: joints not chosen yet, one after another, that begin and end at links reached already.
//!
//! # Sources
//! Ears: Whitney, "Non-separable and planar graphs", Trans. AMS 34 (1932).

use crate::model::mechanism::LinkId;
use crate::search::order::widths::Trial;
use crate::search::question::Question;
use std::collections::{BTreeSet, VecDeque};

/// Ways tried for the first contour, from each of its joints and both ways round.
const STARTS: usize = 16;
/// Ways tried for each further one.
const EARS: usize = 6;

/// The joints of some variables, and where they meet.
pub(in crate::search) struct Joined {
    variables: Vec<usize>,
    /// The place of each variable's number in the canonical order.
    places: Vec<usize>,
    /// A joint's variable, and the links it is between, in that order.
    edges: Vec<(usize, [LinkId; 2])>,
    /// The edges at each link.
    at: Vec<Vec<usize>>,
}

impl Joined {
    /// Creates the data of variables in the canonical order.
    pub(super) fn new(question: &Question, variables: &[usize]) -> Joined {
        let links = |v: usize| {
            let joints = question.space.variables[v].joints.iter();
            joints.map(move |&j| (v, question.mechanism.joints[j].links))
        };
        let edges: Vec<(usize, [LinkId; 2])> = variables.iter().flat_map(|&v| links(v)).collect();
        let mut at = Vec::new();
        for (e, (_, links)) in edges.iter().enumerate() {
            for link in links.map(LinkId::index) {
                at.resize_with(at.len().max(link + 1), Vec::new);
                at[link].push(e);
            }
        }
        let mut places = vec![0; variables.iter().max().map_or(0, |v| v + 1)];
        for (place, &v) in variables.iter().enumerate() {
            places[v] = place;
        }
        Joined {
            variables: variables.to_vec(),
            places,
            edges,
            at,
        }
    }

    /// Returns the place of a variable in the canonical order.
    pub(super) fn canonical_place(&self, variable: usize) -> usize {
        self.places[variable]
    }

    /// Returns the variables of a trial as bits, by their places.
    pub(super) fn taken_bits(&self, trial: &Trial) -> Vec<u64> {
        let mut taken = vec![0; self.variables.len().div_ceil(64)];
        for place in trial.order.iter().map(|&v| self.places[v]) {
            taken[place / 64] |= 1 << (place % 64);
        }
        taken
    }

    /// Returns the ways to continue: ears, the shortest first, or the next joint if no contour is left. Empty for a whole
    /// order.
    pub(super) fn find_ears(&self, trial: &Trial) -> Vec<Vec<usize>> {
        if trial.order.len() == self.variables.len() {
            return vec![Vec::new()];
        }
        let taken = self.taken_bits(trial);
        let is_left = |e: usize| {
            let place = self.places[self.edges[e].0];
            taken[place / 64] >> (place % 64) & 1 == 0
        };
        let (left, done): (Vec<usize>, Vec<usize>) =
            (0..self.edges.len()).partition(|&e| is_left(e));
        let mut live = vec![false; self.at.len()];
        let reached = done.iter().flat_map(|&e| self.edges[e].1);
        reached.for_each(|l| live[l.index()] = true);
        let is_live = |l: LinkId| live[l.index()];
        let reaches = |e: &usize| self.edges[*e].1.iter().any(|&l| is_live(l));
        let begun = left.iter().any(reaches);
        let mut search = BreadthFirst {
            of: self,
            back: vec![None; self.at.len()],
        };
        let mut out: Vec<Vec<usize>> = Vec::new();
        for &e in &left {
            let [a, b] = self.edges[e].1;
            for (from, to) in [(a, b), (b, a)] {
                if begun && !is_live(from) {
                    continue;
                }
                let ends = |l: LinkId| if begun { is_live(l) } else { l == from };
                if let Some(ear) = search.shortest_ear(e, to, is_left, ends)
                    && !out.contains(&ear)
                {
                    out.push(ear);
                }
            }
        }
        // The sort is stable: ways of equal length stay in the canonical order.
        out.sort_by_key(Vec::len);
        out.truncate(if begun { EARS } else { STARTS });
        if out.is_empty() {
            let next = left.iter().find(|e| reaches(e)).or(left.first());
            out.extend(next.map(|&e| vec![self.edges[e].0]));
        }
        out
    }
}

/// A search for the shortest way, breadth first.
struct BreadthFirst<'a> {
    of: &'a Joined,
    /// The edge that each link was reached over; none between searches.
    back: Vec<Option<usize>>,
}

impl BreadthFirst<'_> {
    /// Returns the shortest path over an edge and then over remaining edges from `to` until `ends` is true, as variables.
    fn shortest_ear(
        &mut self,
        first: usize,
        to: LinkId,
        is_left: impl Fn(usize) -> bool,
        ends: impl Fn(LinkId) -> bool,
    ) -> Option<Vec<usize>> {
        let (mut queue, mut reached) = (VecDeque::from([to]), vec![to]);
        self.back[to.index()] = Some(first);
        let mut found = None;
        while let Some(at) = queue.pop_front() {
            if ends(at) {
                found = Some(self.way_back(first, at));
                break;
            }
            for &e in &self.of.at[at.index()] {
                let [a, b] = self.of.edges[e].1;
                let next = if at == a { b } else { a };
                if e != first && self.back[next.index()].is_none() && is_left(e) {
                    self.back[next.index()] = Some(e);
                    reached.push(next);
                    queue.push_back(next);
                }
            }
        }
        reached.iter().for_each(|l| self.back[l.index()] = None);
        found
    }

    /// Returns the variables from the first edge to a link.
    fn way_back(&self, first: usize, mut link: LinkId) -> Vec<usize> {
        let mut way = Vec::new();
        while let Some(e) = self.back[link.index()] {
            let (variable, [a, b]) = self.of.edges[e];
            way.push(variable);
            if e == first {
                break;
            }
            link = if a == link { b } else { a };
        }
        way.reverse();
        let mut seen = BTreeSet::new();
        way.retain(|v| seen.insert(*v));
        way
    }
}
