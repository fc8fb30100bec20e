//! How many chains of pairs there are, and in how many ways their links make grippers of two jaws.

use crate::chains::canonical::{Canonical, Weighted, canonical};
use crate::chains::pairs::PairKind;
use crate::chains::pairs::chain::{MOST_LINKS, PairChain};
use crate::chains::pairs::roles::PairSubject;
use crate::chains::pairs::sharing::{Menu, Sharing};
use itertools::Itertools;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::AddAssign;
use std::sync::{Mutex, PoisonError};

/// The graph with a path of new vertices between two of its own.
fn with_ear(graph: &Weighted, ends: [usize; 2], new: usize) -> Weighted {
    let n = graph.vertices();
    let mut out = graph.widened(new);
    let way = std::iter::once(ends[0]).chain(n..n + new).chain([ends[1]]);
    for (u, v) in way.tuple_windows() {
        out.set(u, v, 1);
    }
    out
}

fn ring(vertices: usize) -> Weighted {
    let mut out = Weighted::new(vertices);
    (0..vertices).for_each(|v| out.set(v, (v + 1) % vertices, 1));
    out
}

/// The graphs that hang together without any one of their vertices, each once: those of each number of vertices, up to the
/// greatest, with a given number of loops.
///
/// Every such graph of one loop more comes of a smaller one by an ear, a path between two of its vertices that passes
/// through new ones alone [Whitney 1932]. A chain of mobility 1 in which every two links move is such a graph: where one link
/// holds two parts together, the mobility is the sum of theirs.
struct Level {
    most: usize,
    graphs: BTreeMap<usize, BTreeSet<Weighted>>,
}

impl Level {
    fn rings(most: usize) -> Level {
        let one = |n| (n, BTreeSet::from([canonical(&ring(n)).graph]));
        Level {
            most,
            graphs: (3..=most).map(one).collect(),
        }
    }

    /// With one loop more.
    fn grown(&self) -> Level {
        let grown = |n: usize| -> BTreeSet<Weighted> {
            let smaller = self.graphs.iter().filter(|(m, _)| **m <= n);
            let all = smaller.flat_map(|(m, graphs)| graphs.iter().map(move |g| (n - m, g)));
            let all: Vec<(usize, &Weighted)> = all.collect();
            let eared = all.into_par_iter().flat_map_iter(|(new, g)| {
                let ends = (0..g.vertices()).tuple_combinations();
                let free = ends.filter(move |&(u, v)| new > 0 || g.weight(u, v) == 0);
                free.map(move |(u, v)| canonical(&with_ear(g, [u, v], new)).graph)
            });
            eared.collect()
        };
        Level {
            most: self.most,
            graphs: (4..=self.most).map(|n| (n, grown(n))).collect(),
        }
    }
}

/// Every simple graph with so many vertices that hangs together without any one of them, by its number of edges up to a
/// greatest, in canonical numbering and with its automorphisms.
///
/// # Complexity
/// One canonical numbering for each two vertices of each smaller graph.
#[must_use]
fn biconnected_graphs(vertices: usize, most_edges: usize) -> Vec<Canonical> {
    let mut out = Vec::new();
    let mut level = Level::rings(vertices);
    for edges in vertices..=most_edges {
        if edges > vertices {
            level = level.grown();
        }
        let own = level.graphs.get(&vertices).into_iter().flatten();
        out.extend(own.map(canonical));
    }
    out
}

/// How many pairs of each kind that is no hinge a chain has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Kinds {
    /// Slides.
    pub slides: usize,
    /// Gear pairs and racks.
    pub gears: usize,
    /// Slots, cams and wedges.
    pub slots: usize,
    /// Two slots between the same links.
    pub two_slots: usize,
}

impl Kinds {
    /// Of a chain.
    #[must_use]
    pub fn of(chain: &PairChain) -> Kinds {
        Kinds {
            slides: chain.count(PairKind::Slide),
            gears: chain.count(PairKind::Gear),
            slots: chain.count(PairKind::Slot),
            two_slots: chain.count(PairKind::TwoSlots),
        }
    }

    /// Slots in all.
    #[must_use]
    pub fn slots_made(self) -> usize {
        self.slots + 2 * self.two_slots
    }

    /// The same with so many slots made of flat faces, which are slides.
    #[must_use]
    pub fn with_flat(self, flat: usize) -> Kinds {
        Kinds {
            slides: self.slides + flat,
            slots: self.slots - flat,
            ..self
        }
    }
}

/// Counts of choices of jaws with one kind of input in one place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PairGrippers {
    /// All.
    pub all: u64,
    /// Of these, those of which no smaller moving part holds all roles. The rest counts such alone.
    pub essential: u64,
    /// Both jaws keep their attitude.
    pub translating: u64,
    /// An automorphism of order two keeps frame and input joint and swaps the jaws.
    pub graph_symmetric: u64,
    /// They move so in places that mirror each other.
    pub mirror: u64,
    /// The same without the demand on the input joint.
    pub mirror_but_input: u64,
    /// They move so in places that half a turn carries to each other.
    pub half_turn: u64,
    /// The same without the demand on the input joint.
    pub half_turn_but_input: u64,
}

impl AddAssign for PairGrippers {
    fn add_assign(&mut self, o: PairGrippers) {
        self.all += o.all;
        self.essential += o.essential;
        self.translating += o.translating;
        self.graph_symmetric += o.graph_symmetric;
        self.mirror += o.mirror;
        self.mirror_but_input += o.mirror_but_input;
        self.half_turn += o.half_turn;
        self.half_turn_but_input += o.half_turn_but_input;
    }
}

/// Where the input joint is, what it is, and whether a jaw is one of its links.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct DriveKind {
    /// Between two moving links; otherwise at the frame.
    pub between: bool,
    /// A jaw is a link of it; otherwise the jaws are apart.
    pub jaw: bool,
    /// It slides; otherwise it turns.
    pub slides: bool,
}

/// Counts of the chains of some links and kinds, everything up to automorphism.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct PairCensus {
    /// Chains.
    pub chains: u64,
    /// Choices of a frame.
    pub frames: u64,
    /// Choices of a frame and an input joint at it.
    pub inputs_at_frame: u64,
    /// Choices of a frame and an input joint between two other links.
    pub inputs_between: u64,
    /// Choices of jaws with them.
    pub grippers: BTreeMap<DriveKind, PairGrippers>,
}

impl AddAssign for PairCensus {
    fn add_assign(&mut self, o: PairCensus) {
        self.chains += o.chains;
        self.frames += o.frames;
        self.inputs_at_frame += o.inputs_at_frame;
        self.inputs_between += o.inputs_between;
        for (drive, counts) in o.grippers {
            *self.grippers.entry(drive).or_default() += counts;
        }
    }
}

impl PairCensus {
    /// Of one chain with its automorphisms.
    ///
    /// # Complexity
    /// A step for each choice of roles and each smaller moving part.
    #[must_use]
    pub fn of(subject: &PairSubject<'_>, grippers: bool) -> PairCensus {
        let mut out = PairCensus {
            chains: 1,
            frames: subject.frames() as u64,
            ..PairCensus::default()
        };
        for (frame, input) in subject.drives() {
            let between = !input.is_at(frame);
            out.inputs_at_frame += u64::from(!between);
            out.inputs_between += u64::from(between);
            let all = grippers.then(|| subject.grippers(frame, &input, 2));
            for roles in all.into_iter().flatten() {
                let drive = DriveKind {
                    between,
                    jaw: roles.has_driven_jaw(),
                    slides: input.pair == PairKind::Slide,
                };
                let counts = out.grippers.entry(drive).or_default();
                counts.all += 1;
                if !subject.is_essential(&roles) {
                    continue;
                }
                let s = subject.symmetries(&roles);
                *counts += PairGrippers {
                    all: 0,
                    essential: 1,
                    translating: subject.is_translating(&roles).into(),
                    graph_symmetric: s.graph.into(),
                    mirror: s.mirror.into(),
                    mirror_but_input: s.mirror_but_input.into(),
                    half_turn: s.half_turn.into(),
                    half_turn_but_input: s.half_turn_but_input.into(),
                };
            }
        }
        out
    }
}

/// Calls `visit` with every chain of so many links and with its automorphisms; in no particular order and from several
/// threads.
///
/// # Complexity
/// Some ten microseconds a way to share the kinds out over a graph, where there are slides; one otherwise.
pub fn visit_pair_chains(links: usize, menu: Menu<'_>, visit: &(impl Fn(&PairSubject<'_>) + Sync)) {
    if !(3..=MOST_LINKS).contains(&links) {
        return;
    }
    let graphs = biconnected_graphs(links, menu.most_joints(links, menu.most));
    graphs.par_iter().for_each(|graph| {
        let own: Vec<usize> = (0..links).collect();
        let sharing = Sharing::new(&graph.graph, &graph.automorphisms, &own);
        sharing.share(menu, &mut |chain, automorphisms| {
            visit(&PairSubject::new(&chain, &automorphisms));
        });
    });
}

/// Counts over all chains of so many links, by how many pairs of each kind they have.
///
/// # Complexity
/// As [`visit_pair_chains`].
#[must_use]
pub fn pair_census(links: usize, menu: Menu<'_>, grippers: bool) -> BTreeMap<Kinds, PairCensus> {
    let all = Mutex::new(BTreeMap::<Kinds, PairCensus>::new());
    visit_pair_chains(links, menu, &|subject| {
        let (kinds, one) = (Kinds::of(subject.chain), PairCensus::of(subject, grippers));
        let mut all = all.lock().unwrap_or_else(PoisonError::into_inner);
        *all.entry(kinds).or_default() += one;
    });
    all.into_inner().unwrap_or_else(PoisonError::into_inner)
}
