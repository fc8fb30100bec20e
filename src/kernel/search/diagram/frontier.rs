//! From an order of joints to the linear maps that carry a diagram node over each of them.
//!
//! The chosen joints join links into components. A node's space holds, for each component, the twists of its *live*
//! links (those with joints to come, and those pinned) relative to the component's root. Adding a joint merges two
//! components, or closes a contour within one; a link with no joints to come is forgotten. All three are one block map
//! of twists with entries 0, +1, -1, so a step is a list of blocks.
//!
//! A coupling whose first joint is chosen is *pending*: the rate it gives the second joint is one more coordinate, a block
//! of its own of which only the first number is used. The second joint closes it, as a joint closes a contour, with a gap
//! of one number.

use crate::linalg::modp::{Field, Residue};
use crate::model::mechanism::{JointId, LinkId, Mechanism};
use std::collections::BTreeMap;

/// Where a block of the new coordinates comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Source {
    /// A block of the old coordinates.
    Block(usize),
    /// The twist of the joint being added.
    Joint,
    /// The rate of the joint being added in one of its couplings, counted along them.
    Rate(usize),
}

/// One joint added to the chosen part.
#[derive(Debug, Clone)]
pub struct Step {
    /// The joint.
    pub joint: JointId,
    /// Whether it closes a contour: then new block 0 is the gap that must vanish.
    pub closing: bool,
    /// Couplings it closes: the gaps of their rates are the blocks after that.
    pub coupled: usize,
    /// New coordinates from old ones: (new block, old block, plus).
    pub blocks: Vec<(usize, usize, bool)>,
    /// New coordinates from the joint's twist: (new block, plus).
    pub twist: Vec<(usize, bool)>,
    /// New coordinates from the joint's rates: (new block, rate, plus).
    pub rates: Vec<(usize, usize, bool)>,
    /// Number of old blocks.
    pub old_width: usize,
    /// Number of new blocks, gaps included.
    pub width: usize,
    /// Blocks of live links after the step, as (root, link), gaps excluded.
    pub live: Vec<(LinkId, LinkId)>,
    /// Couplings that are pending after the step; their blocks come after those of the links.
    pub pending: Vec<usize>,
}

impl Step {
    /// Writes the row that a twist of the joint, with its entries for couplings behind it, becomes.
    pub(in crate::search) fn image(
        &self,
        f: Field,
        d: usize,
        twist: &[Residue],
        row: &mut Vec<Residue>,
    ) {
        row.clear();
        row.resize(self.width * d, 0);
        for &(new, plus) in &self.twist {
            f.accumulate(&mut row[new * d..(new + 1) * d], &twist[..d], plus);
        }
        for &(new, rate, plus) in &self.rates {
            f.accumulate(
                &mut row[new * d..=new * d],
                &twist[d + rate..=d + rate],
                plus,
            );
        }
    }
}

/// A joint in one of several copies of the mechanism's links and couplings, which are numbered on: link `l` of copy `lane`
/// is `lane * links + l`.
#[derive(Debug, Clone, Copy)]
pub struct At {
    /// The joint.
    pub joint: JointId,
    /// The copy; 0 where there is one.
    pub lane: usize,
}

/// The steps for an order of joints.
#[derive(Debug, Clone)]
pub struct Plan {
    /// One step a joint.
    pub steps: Vec<Step>,
}

type Combination = BTreeMap<Source, i8>;

fn plus(a: &Combination, sign: i8, b: &Combination) -> Combination {
    let mut out = a.clone();
    for (&s, &c) in b {
        *out.entry(s).or_insert(0) += sign * c;
    }
    out.retain(|_, c| *c != 0);
    out
}

/// Makes the steps for joints in a given order. Links in `pinned` stay live to the end of the plan. `start` are the live
/// links (component by component, root first) of the node the plan starts from.
///
/// # Panics
/// Never for joints of the mechanism.
#[must_use]
pub fn plan(mechanism: &Mechanism, order: &[At], pinned: &[LinkId], start: &[Vec<LinkId>]) -> Plan {
    let mut planner = Planner::new(mechanism, order, pinned, start);
    Plan {
        steps: order.iter().map(|&joined| planner.add(joined)).collect(),
    }
}

/// A plan while its order is being found: what the joints added so far have joined.
#[derive(Debug, Clone)]
pub(in crate::search) struct Planner<'m> {
    mechanism: &'m Mechanism,
    /// By link, the joints to come, and one more for a link that is pinned.
    left: BTreeMap<LinkId, usize>,
    /// Live links, component by component, root first.
    components: Vec<Vec<LinkId>>,
    pending: Vec<usize>,
}

impl<'m> Planner<'m> {
    /// A planner for these joints, in an order that [`Planner::add`] is told; the rest as in [`plan`].
    pub(in crate::search) fn new(
        mechanism: &'m Mechanism,
        joints: &[At],
        pinned: &[LinkId],
        start: &[Vec<LinkId>],
    ) -> Self {
        let mut left = BTreeMap::new();
        let ends = joints.iter().flat_map(|at| ends(mechanism, at));
        for l in ends.chain(pinned.iter().copied()) {
            *left.entry(l).or_insert(0) += 1;
        }
        Planner {
            mechanism,
            left,
            components: start.to_vec(),
            pending: Vec::new(),
        }
    }

    /// Whether a link is live: joined already, with joints to come or pinned.
    pub(in crate::search) fn is_live(&self, link: LinkId) -> bool {
        self.components.iter().any(|c| c.contains(&link))
    }

    /// Adds a joint.
    ///
    /// # Panics
    /// Never for joints of the mechanism.
    pub(in crate::search) fn add(&mut self, joined: At) -> Step {
        let mechanism = self.mechanism;
        let (count, frame) = (mechanism.links.len(), mechanism.frame());
        let is_frame = |l: &LinkId| l.index() % count == frame.index();
        let mut components = std::mem::take(&mut self.components);
        let pending = std::mem::take(&mut self.pending);
        let (joint, [u, v]) = (joined.joint, ends(mechanism, &joined));
        // Every live link's twist relative to its root, in the old coordinates.
        let mut relative: BTreeMap<LinkId, Combination> = BTreeMap::new();
        let mut next = 0;
        for c in &components {
            relative.insert(c[0], Combination::new());
            for &l in &c[1..] {
                relative.insert(l, Combination::from([(Source::Block(next), 1)]));
                next += 1;
            }
        }
        for l in [u, v] {
            if !components.iter().any(|c| c.contains(&l)) {
                components.push(vec![l]);
                relative.insert(l, Combination::new());
            }
        }
        let home = |l: LinkId, cs: &[Vec<LinkId>]| {
            cs.iter()
                .position(|c| c.contains(&l))
                .expect("both links have one")
        };
        let (a, b) = (home(u, &components), home(v, &components));
        // The rates of pending couplings come after the links' twists.
        let mut waiting: Vec<(usize, Combination)> = pending
            .iter()
            .map(|&q| {
                next += 1;
                (q, Combination::from([(Source::Block(next - 1), 1)]))
            })
            .collect();
        let twist = Combination::from([(Source::Joint, 1)]);
        // The frame stays the root wherever it is, so that its component's coordinates are absolute.
        let (u, v, a, b, forward) = if components[b].iter().any(is_frame) {
            (v, u, b, a, false)
        } else {
            (u, v, a, b, true)
        };
        let twist = if forward {
            twist
        } else {
            plus(&Combination::new(), -1, &twist)
        };
        let closing = a == b;
        let mut rows: Vec<Combination> = Vec::new();
        if closing {
            let across = plus(&relative[&v], -1, &relative[&u]);
            rows.push(plus(&across, -1, &twist));
        } else {
            // Old root of b relative to the root of a: out to u, over the joint, back from v.
            let shift = plus(&plus(&relative[&u], 1, &twist), -1, &relative[&v]);
            let moved = components[b].clone();
            for l in &moved {
                let r = plus(&shift, 1, &relative[l]);
                relative.insert(*l, r);
            }
            components[a].extend(moved);
            components.remove(b);
        }
        let coupled = couple(mechanism, joined, &mut waiting, &mut rows);
        for l in ends(mechanism, &joined) {
            self.left.entry(l).and_modify(|n| *n -= 1);
        }
        let live = |l: &LinkId| self.left.get(l).is_some_and(|n| *n > 0);
        for c in &mut components {
            if let Some(i) = c.iter().position(is_frame) {
                c.swap(0, i);
            }
            c.retain(live);
        }
        components.retain(|c| !c.is_empty());
        let mut names = Vec::new();
        for c in &components {
            let root = relative[&c[0]].clone();
            for l in &c[1..] {
                rows.push(plus(&relative[l], -1, &root));
                names.push((c[0], *l));
            }
        }
        rows.extend(waiting.iter().map(|(_, rate)| rate.clone()));
        let pending: Vec<usize> = waiting.iter().map(|(q, _)| *q).collect();
        let (mut blocks, mut from_joint, mut rates) = (Vec::new(), Vec::new(), Vec::new());
        for (new, row) in rows.iter().enumerate() {
            for (source, sign) in row {
                match source {
                    Source::Block(old) => blocks.push((new, *old, *sign > 0)),
                    Source::Joint => from_joint.push((new, *sign > 0)),
                    Source::Rate(i) => rates.push((new, *i, *sign > 0)),
                }
            }
        }
        self.components = components;
        self.pending.clone_from(&pending);
        Step {
            joint,
            closing,
            coupled,
            blocks,
            twist: from_joint,
            rates,
            old_width: next,
            width: rows.len(),
            live: names,
            pending,
        }
    }
}

/// The links a joint is between, in its copy.
fn ends(mechanism: &Mechanism, at: &At) -> [LinkId; 2] {
    let links = mechanism.joints[at.joint].links;
    links.map(|l| LinkId::new(at.lane * mechanism.links.len() + l.index()))
}

/// Adds a joint's rates to its couplings: pending ones are closed, their gaps go to `rows`, and new ones begin to wait.
/// Returns the number of couplings closed.
fn couple(
    mechanism: &Mechanism,
    at: At,
    waiting: &mut Vec<(usize, Combination)>,
    rows: &mut Vec<Combination>,
) -> usize {
    let mut closed = 0;
    let first = at.lane * mechanism.couplings.len();
    for (i, (q, _)) in mechanism.couplings_of(at.joint).enumerate() {
        let q = first + q;
        let rate = Combination::from([(Source::Rate(i), 1)]);
        match waiting.iter().position(|(w, _)| *w == q) {
            Some(at) => {
                let (_, other) = waiting.remove(at);
                rows.push(plus(&other, 1, &rate));
                closed += 1;
            }
            None => waiting.push((q, rate)),
        }
    }
    closed
}
