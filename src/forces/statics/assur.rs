//! Decomposition of a planar mechanism into its drives and Assur groups.
//!
//! With its drives locked, a mechanism of the right mobility is a determinate structure: 3n = 2p, n bodies, p pairs.
//! Its Assur groups are the smallest parts that satisfy this once the bodies that support them are held. Assign each
//! pair's two constraints to its bodies, three constraints to a body. Then a body depends on those at the other ends of
//! its constraints, and the groups are the strongly connected components of that dependence. The choice of the
//! assignment does not matter, so the decomposition is unique.
//!
//! # Sources
//! A. Sljoka, O. Shai, W. Whiteley, "Checking mobility and decomposition of linkages via pebble game algorithm", ASME
//! IDETC 2011; B. Servatius, O. Shai, W. Whiteley, "Combinatorial characterization of the Assur graphs from
//! engineering", arXiv:0801.2525, 2008 (the components are the Assur groups).

use crate::statics::assur_class::{AssurClass, classify_group};
use crate::statics::planar::{BodyId, PairId, PairKind, PlanarMechanism};
use itertools::Itertools;
use std::collections::VecDeque;
use thiserror::Error;

/// Reason why a mechanism has no decomposition under its drives.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum AssurError {
    /// A pair that is not a drive has fewer than one freedom.
    #[error("pair \"{pair}\" cannot be a drive; drive a revolute or prismatic pair")]
    NotADrive {
        /// The pair.
        pair: String,
    },
    /// Some bodies have more constraints than freedoms.
    #[error(
        "bodies {bodies} have {excess} more constraints than freedoms in the plane once the drives are locked; \
         remove a drive or a redundant constraint there (`ozols search` finds which)"
    )]
    Overconstrained {
        /// The bodies.
        bodies: String,
        /// Number of excess constraints.
        excess: usize,
    },
    /// Some bodies still move.
    #[error(
        "bodies {bodies} keep {freedoms} freedoms with every drive locked; mark that many more joints as drives: \
         drive = true"
    )]
    Underconstrained {
        /// The bodies.
        bodies: String,
        /// Number of remaining freedoms.
        freedoms: usize,
    },
}

/// A structural group: bodies that are determinate once the bodies that support them are held.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Group {
    /// The bodies, ascending.
    pub bodies: Vec<BodyId>,
    /// The bodies as rigid blocks. Bodies joined by a drive or a rigid pair count as one. Most blocks are one body.
    pub blocks: Vec<Vec<BodyId>>,
    /// Pairs between blocks of the group.
    pub inner: Vec<PairId>,
    /// Pairs to bodies placed earlier.
    pub outer: Vec<PairId>,
    /// Drives and rigid pairs within blocks.
    pub locked: Vec<PairId>,
    /// Class, order and kind.
    pub class: AssurClass,
}

impl Group {
    /// Returns 3n - 2p over blocks and pairs between them; 0 for every group.
    #[must_use]
    pub fn mobility(&self) -> isize {
        let count = |n: usize| isize::try_from(n).unwrap_or(isize::MAX);
        3 * count(self.blocks.len()) - 2 * count(self.inner.len() + self.outer.len())
    }

    /// Returns all pairs that position the group: inner, outer and locked, ascending.
    #[must_use]
    pub fn all_pairs(&self) -> Vec<PairId> {
        let all = self.inner.iter().chain(&self.outer).chain(&self.locked);
        all.copied().sorted().collect()
    }
}

/// A mechanism as its drives and groups, each group after those that support it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Decomposition {
    /// The driven pairs.
    pub drives: Vec<PairId>,
    /// Bodies positioned by the drives alone, ascending: Assur's links of class I.
    pub driven: Vec<BodyId>,
    /// Drives and rigid pairs that position them.
    pub driven_pairs: Vec<PairId>,
    /// The groups.
    pub groups: Vec<Group>,
}

impl Decomposition {
    /// Returns the class of the mechanism: the highest among its groups, or 1 if there are none.
    #[must_use]
    pub fn highest_class(&self) -> usize {
        self.groups.iter().map(|g| g.class.class).max().unwrap_or(1)
    }
}

/// Decomposes a mechanism with the given driven pairs locked.
///
/// # Errors
/// Returns an error that names the bodies concerned if the drives do not make the mechanism determinate.
///
/// # Complexity
/// O(p·(n + p)) time, O(n + p) space, for n bodies and p pairs.
///
/// # Examples
/// ```
/// use ozols::{model::mechanism::StateId, statics::{assur::decompose_groups, planar::PlanarMechanism}};
/// let planar = PlanarMechanism::new(&ozols::built_in("parallel-shears")?, StateId::FREE)?;
/// let found = decompose_groups(&planar, &planar.driven_pairs())?;
/// assert_eq!(found.highest_class(), 4); // [Bychkov, Dvornikov & Zhukov 2018]
/// assert!(found.groups.iter().all(|g| g.mobility() == 0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn decompose_groups(
    m: &PlanarMechanism,
    drives: &[PairId],
) -> Result<Decomposition, AssurError> {
    let blocks = Blocks::new(m, drives)?;
    let held = blocks.of[m.frame];
    let mut placement = Placement {
        of_pair: vec![None; m.pairs.len()],
        load: vec![0; blocks.members.len()],
    };
    let (mut full, mut excess) = (Vec::new(), 0);
    for (p, pair) in m.pairs.iter().enumerate() {
        if blocks.locked[p] {
            continue;
        }
        let ends = pair.bodies.map(|b| blocks.of[b]);
        if ends[0] == ends[1] {
            full.push(ends[0]);
            excess += 2;
            continue;
        }
        placement.of_pair[p] = Some((ends, [usize::MAX; 2]));
        for half in 0..2 {
            if let Err(reached) = placement.place_constraint(p, half, held) {
                full.extend(reached);
                excess += 1;
            }
        }
    }
    if excess > 0 {
        let full = full.into_iter().sorted().dedup().collect_vec();
        return Err(AssurError::Overconstrained {
            bodies: body_names(m, &blocks, &full),
            excess,
        });
    }
    let free: Vec<usize> = (0..blocks.members.len())
        .filter(|&b| b != held && placement.load[b] < 3)
        .collect();
    if !free.is_empty() {
        let freedoms = free.iter().map(|&b| 3 - placement.load[b]).sum();
        return Err(AssurError::Underconstrained {
            bodies: body_names(m, &blocks, &placement.loose_blocks(free)),
            freedoms,
        });
    }
    Ok(assemble_groups(
        m,
        drives,
        &blocks,
        held,
        &group_components(&blocks, held, &placement),
    ))
}

/// Returns decompositions under other drives: first every pair at the frame, then every other pair of one freedom, each
/// in place of the first drive (`drives[0]`). Those that leave the mechanism indeterminate give the reason.
///
/// # Complexity
/// O(p) decompositions.
#[must_use]
pub fn decompose_alternatives(
    m: &PlanarMechanism,
    drives: &[PairId],
) -> Vec<(PairId, Result<Decomposition, AssurError>)> {
    let rest = drives.get(1..).unwrap_or(&[]);
    let mut candidates: Vec<PairId> = (0..m.pairs.len())
        .filter(|p| m.pairs[*p].kind != PairKind::Rigid && !rest.contains(p))
        .collect();
    candidates.sort_by_key(|&p| !m.pairs[p].bodies.contains(&m.frame));
    let with = |p: PairId| [p].into_iter().chain(rest.iter().copied()).collect_vec();
    candidates
        .into_iter()
        .map(|p| (p, decompose_groups(m, &with(p))))
        .collect()
}

/// Bodies joined by locked pairs, merged.
struct Blocks {
    of: Vec<usize>,
    members: Vec<Vec<BodyId>>,
    locked: Vec<bool>,
}

impl Blocks {
    fn new(m: &PlanarMechanism, drives: &[PairId]) -> Result<Blocks, AssurError> {
        let mut leader: Vec<BodyId> = (0..m.bodies.len()).collect();
        let mut locked = vec![false; m.pairs.len()];
        for (p, pair) in m.pairs.iter().enumerate() {
            let drive = drives.contains(&p);
            if drive && pair.kind == PairKind::Rigid {
                return Err(AssurError::NotADrive {
                    pair: pair.name.clone(),
                });
            }
            if !drive && pair.kind != PairKind::Rigid {
                continue;
            }
            locked[p] = true;
            let [a, b] = pair.bodies.map(|x| leader[x]);
            if a == b {
                let all = (0..m.bodies.len()).filter(|&x| leader[x] == a);
                return Err(AssurError::Overconstrained {
                    bodies: all.map(|x| m.bodies[x].name.as_str()).join(", "),
                    excess: 3,
                });
            }
            for l in leader.iter_mut().filter(|l| **l == a.max(b)) {
                *l = a.min(b);
            }
        }
        let mut members: Vec<Vec<BodyId>> = Vec::new();
        let mut of = vec![0; m.bodies.len()];
        for x in 0..m.bodies.len() {
            if leader[x] == x {
                of[x] = members.len();
                members.push(Vec::new());
            } else {
                of[x] = of[leader[x]];
            }
            members[of[x]].push(x);
        }
        Ok(Blocks {
            of,
            members,
            locked,
        })
    }
}

fn body_names(m: &PlanarMechanism, blocks: &Blocks, which: &[usize]) -> String {
    let bodies = which.iter().flat_map(|&b| &blocks.members[b]);
    let names = bodies.sorted().map(|&x| m.bodies[x].name.as_str());
    names.dedup().join(", ")
}

/// The two ends of a pair and the block to which each of its two constraints is assigned.
type Halves = ([usize; 2], [usize; 2]);

/// Constraints assigned to blocks, at most three each.
struct Placement {
    of_pair: Vec<Option<Halves>>,
    load: Vec<usize>,
}

impl Placement {
    /// Assigns one constraint of pair `p` to one of its ends, moving others if necessary. On failure it returns the
    /// full blocks.
    fn place_constraint(&mut self, p: PairId, half: usize, held: usize) -> Result<(), Vec<usize>> {
        let ends = self.of_pair[p].map_or([held; 2], |x| x.0);
        // came[b] = the constraint that may move into block b, and the block it leaves (none for the new one).
        let mut came: Vec<Option<(PairId, usize, Option<usize>)>> = vec![None; self.load.len()];
        let mut queue = VecDeque::new();
        for e in ends {
            if e != held && came[e].is_none() {
                came[e] = Some((p, half, None));
                queue.push_back(e);
            }
        }
        let mut reached = Vec::new();
        while let Some(at) = queue.pop_front() {
            if self.load[at] < 3 {
                self.load[at] += 1;
                let mut to = at;
                while let Some((q, h, from)) = came[to] {
                    if let Some(x) = self.of_pair[q].as_mut() {
                        x.1[h] = to;
                    }
                    let Some(from) = from else { break };
                    to = from;
                }
                return Ok(());
            }
            reached.push(at);
            for (q, entry) in self.of_pair.iter().enumerate() {
                let Some((ends, given)) = entry else { continue };
                for (h, _) in given.iter().enumerate().filter(|(_, g)| **g == at) {
                    let to = if ends[0] == at { ends[1] } else { ends[0] };
                    if to != held && came[to].is_none() {
                        came[to] = Some((q, h, Some(at)));
                        queue.push_back(to);
                    }
                }
            }
        }
        Err(reached)
    }

    /// Returns these blocks and those that may be left free instead of them.
    fn loose_blocks(&self, mut free: Vec<usize>) -> Vec<usize> {
        let mut next = 0;
        while let Some(&to) = free.get(next) {
            next += 1;
            for (ends, given) in self.of_pair.iter().flatten() {
                for &at in given.iter().filter(|_| ends.contains(&to)) {
                    if at != to && !free.contains(&at) {
                        free.push(at);
                    }
                }
            }
        }
        free
    }
}

/// Returns strongly connected blocks, each component after those it depends on, the first in file order first.
fn group_components(blocks: &Blocks, held: usize, placement: &Placement) -> Vec<Vec<usize>> {
    let n = blocks.members.len();
    let mut needs: Vec<Vec<usize>> = vec![Vec::new(); n];
    for (ends, given) in placement.of_pair.iter().flatten() {
        for &at in given {
            let other = if ends[0] == at { ends[1] } else { ends[0] };
            if other != held {
                needs[at].push(other);
            }
        }
    }
    let mut graph = petgraph::graph::DiGraph::<(), ()>::new();
    let nodes = (0..n).map(|_| graph.add_node(())).collect_vec();
    for (a, list) in needs.iter().enumerate() {
        for &b in list {
            graph.add_edge(nodes[a], nodes[b], ());
        }
    }
    let mut waiting: Vec<Vec<usize>> = petgraph::algo::tarjan_scc(&graph)
        .into_iter()
        .map(|c| c.into_iter().map(|x| x.index()).sorted().collect_vec())
        .filter(|c| *c != [held])
        .sorted()
        .collect();
    let mut placed = vec![false; n];
    placed[held] = true;
    let mut order = Vec::new();
    while !waiting.is_empty() {
        let ready = |c: &Vec<usize>| {
            let mut all = c.iter().flat_map(|&b| &needs[b]);
            all.all(|x| placed[*x] || c.contains(x))
        };
        let next = waiting.iter().position(ready).unwrap_or(0);
        let c = waiting.remove(next);
        c.iter().for_each(|&b| placed[b] = true);
        order.push(c);
    }
    order
}

fn assemble_groups(
    m: &PlanarMechanism,
    drives: &[PairId],
    blocks: &Blocks,
    held: usize,
    components: &[Vec<usize>],
) -> Decomposition {
    let mut place = vec![usize::MAX; blocks.members.len()];
    for (i, c) in components.iter().enumerate() {
        c.iter().for_each(|&b| place[b] = i);
    }
    let locked_in = |of: &[usize]| -> Vec<PairId> {
        (0..m.pairs.len())
            .filter(|&p| blocks.locked[p] && of.contains(&blocks.of[m.pairs[p].bodies[0]]))
            .collect()
    };
    let group = |i: usize, c: &Vec<usize>| {
        let (mut inner, mut outer) = (Vec::new(), Vec::new());
        for p in (0..m.pairs.len()).filter(|&p| !blocks.locked[p]) {
            let at = m.pairs[p].bodies.map(|b| place[blocks.of[b]]);
            // The frame has no position. Any other end in a later group assigns the pair to that group.
            let latest = at.into_iter().filter(|&x| x != usize::MAX).max();
            if latest == Some(i) {
                if at[0] == at[1] {
                    inner.push(p);
                } else {
                    outer.push(p);
                }
            }
        }
        let members = c.iter().map(|&b| blocks.members[b].clone()).collect_vec();
        let class = classify_group(m, &members, &inner, &outer);
        Group {
            bodies: members.iter().flatten().copied().sorted().collect(),
            blocks: members,
            inner,
            outer,
            locked: locked_in(c),
            class,
        }
    };
    let groups = components
        .iter()
        .enumerate()
        .map(|(i, c)| group(i, c))
        .collect();
    let frame_block = blocks.members[held].iter().copied();
    Decomposition {
        drives: drives.to_vec(),
        driven: frame_block.filter(|&b| b != m.frame).collect(),
        driven_pairs: locked_in(&[held]),
        groups,
    }
}
