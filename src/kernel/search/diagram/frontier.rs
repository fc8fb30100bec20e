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
//!
//! A kept drive is a link of its own, joined to the frame as soon as its joint is chosen; the first number of its twist is the
//! drive's rate.

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
    /// A rate of the joint being added: in one of its couplings, counted along them, or behind these that of its kept drive.
    Rate(usize),
}

/// One joint added to the chosen part.
#[derive(Debug, Clone)]
pub struct Step {
    /// Whether it closes a contour: then new block 0 is the gap that must vanish.
    pub closing: bool,
    /// Couplings it closes, and the drive that it locks: the gaps of their rates are the blocks after that.
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

/// Live links, as (root, link), by components with their roots first.
pub(in crate::search) fn components(live: &[(LinkId, LinkId)]) -> Vec<Vec<LinkId>> {
    let mut out: Vec<Vec<LinkId>> = Vec::new();
    for &(root, link) in live {
        match out.iter_mut().find(|c| c[0] == root) {
            Some(c) => c.push(link),
            None => out.push(vec![root, link]),
        }
    }
    out
}

impl Step {
    /// Directions of its gaps, for twists of `dim` components.
    pub(in crate::search) fn directions(&self, dim: usize) -> usize {
        usize::from(self.closing) * dim + self.coupled
    }

    /// New blocks without the gaps.
    pub(in crate::search) fn kept(&self) -> usize {
        self.width - usize::from(self.closing) - self.coupled
    }

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

/// A joint in one of several copies of the mechanism's links, kept drives and couplings, which are numbered on, lane by lane.
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
        let (count, frame) = (mechanism.bodies(), mechanism.frame());
        let is_frame = |l: &LinkId| l.index() % count == frame.index();
        let components = std::mem::take(&mut self.components);
        let mut joining = Joining::new(components, &self.pending);
        let ends = ends(mechanism, &joined);
        let closing = joining.join(ends, is_frame);
        let mut coupled = couple(mechanism, joined, &mut joining.waiting, &mut joining.rows);
        if mechanism.locked_drives() > 0 && mechanism.drive_at(joined.joint).is_some() {
            let rate = Source::Rate(mechanism.rates_of(joined.joint) - 1);
            joining.rows.push(Combination::from([(rate, 1)]));
            coupled += 1;
        }
        if let Some(drive) = mechanism.kept_drive(joined.joint) {
            let [drive, frame] =
                [mechanism.drive_link(drive), frame].map(|l| copy(mechanism, l, joined.lane));
            joining.drive(drive, frame, mechanism.rates_of(joined.joint) - 1);
        }
        for l in ends {
            self.left.entry(l).and_modify(|n| *n -= 1);
        }
        joining.forget(|l| self.left.get(l).is_some_and(|n| *n > 0), is_frame);
        let live = joining.settle();
        self.components = joining.components;
        self.pending = joining.waiting.iter().map(|(q, _)| *q).collect();
        let (mut blocks, mut twist, mut rates) = (Vec::new(), Vec::new(), Vec::new());
        for (new, row) in joining.rows.iter().enumerate() {
            for (source, sign) in row {
                match source {
                    Source::Block(old) => blocks.push((new, *old, *sign > 0)),
                    Source::Joint => twist.push((new, *sign > 0)),
                    Source::Rate(i) => rates.push((new, *i, *sign > 0)),
                }
            }
        }
        Step {
            closing,
            coupled,
            blocks,
            twist,
            rates,
            old_width: joining.old_width,
            width: joining.rows.len(),
            live,
            pending: self.pending.clone(),
        }
    }
}

/// A joint while it is added: what the new coordinates are made of.
struct Joining {
    /// Live links, component by component, root first.
    components: Vec<Vec<LinkId>>,
    /// The twist of every live link relative to its root.
    relative: BTreeMap<LinkId, Combination>,
    /// The rates of pending couplings.
    waiting: Vec<(usize, Combination)>,
    /// Number of old blocks.
    old_width: usize,
    /// The new coordinates as far as they are known, gaps first.
    rows: Vec<Combination>,
}

impl Joining {
    /// Nothing joined yet: all in the old coordinates.
    fn new(components: Vec<Vec<LinkId>>, pending: &[usize]) -> Joining {
        let mut old_width = 0;
        let mut next = || {
            old_width += 1;
            Combination::from([(Source::Block(old_width - 1), 1)])
        };
        let mut relative: BTreeMap<LinkId, Combination> = BTreeMap::new();
        for c in &components {
            relative.insert(c[0], Combination::new());
            relative.extend(c[1..].iter().map(|&l| (l, next())));
        }
        // The rates of pending couplings come after the links' twists.
        let waiting = pending.iter().map(|&q| (q, next())).collect();
        Joining {
            components,
            relative,
            waiting,
            old_width,
            rows: Vec::new(),
        }
    }

    /// Merges the components of a joint's links, or closes a contour within one; says whether it does that.
    fn join(&mut self, ends: [LinkId; 2], is_frame: impl Fn(&LinkId) -> bool) -> bool {
        for l in ends {
            if !self.components.iter().any(|c| c.contains(&l)) {
                self.components.push(vec![l]);
                self.relative.insert(l, Combination::new());
            }
        }
        let home = |l: LinkId| {
            let mut all = self.components.iter();
            all.position(|c| c.contains(&l))
                .expect("both links have one")
        };
        let [u, v] = ends;
        let (a, b) = (home(u), home(v));
        let twist = Combination::from([(Source::Joint, 1)]);
        // The frame stays the root wherever it is, so that its component's coordinates are absolute.
        let (u, v, a, b, twist) = if self.components[b].iter().any(is_frame) {
            (v, u, b, a, plus(&Combination::new(), -1, &twist))
        } else {
            (u, v, a, b, twist)
        };
        if a == b {
            let across = plus(&self.relative[&v], -1, &self.relative[&u]);
            self.rows.push(plus(&across, -1, &twist));
            return true;
        }
        // Old root of b relative to the root of a: out to u, over the joint, back from v.
        let out = plus(&self.relative[&u], 1, &twist);
        let shift = plus(&out, -1, &self.relative[&v]);
        let moved = self.components[b].clone();
        for l in &moved {
            let r = plus(&shift, 1, &self.relative[l]);
            self.relative.insert(*l, r);
        }
        self.components[a].extend(moved);
        self.components.remove(b);
        false
    }

    /// Joins the link that stands for a drive to the frame; its rate is the one of this index of the joint that is added.
    fn drive(&mut self, drive: LinkId, frame: LinkId, rate: usize) {
        let home = self.components.iter_mut().find(|c| c.contains(&frame));
        match home {
            Some(home) => home.push(drive),
            None => {
                self.components.push(vec![frame, drive]);
                self.relative.insert(frame, Combination::new());
            }
        }
        let turned = Combination::from([(Source::Rate(rate), 1)]);
        let rate = plus(&self.relative[&frame], 1, &turned);
        self.relative.insert(drive, rate);
    }

    /// Forgets links that are not live any more; the frame becomes the root where it is.
    fn forget(&mut self, live: impl Fn(&LinkId) -> bool, is_frame: impl Fn(&LinkId) -> bool) {
        for c in &mut self.components {
            if let Some(i) = c.iter().position(&is_frame) {
                c.swap(0, i);
            }
            c.retain(&live);
        }
        self.components.retain(|c| !c.is_empty());
    }

    /// Writes the rows of live links, and behind them those of pending couplings; the links, as (root, link).
    fn settle(&mut self) -> Vec<(LinkId, LinkId)> {
        let mut names = Vec::new();
        for c in &self.components {
            let root = &self.relative[&c[0]];
            for l in &c[1..] {
                self.rows.push(plus(&self.relative[l], -1, root));
                names.push((c[0], *l));
            }
        }
        let rates = self.waiting.iter().map(|(_, rate)| rate.clone());
        self.rows.extend(rates);
        names
    }
}

/// The links a joint is between, in its copy.
fn ends(mechanism: &Mechanism, at: &At) -> [LinkId; 2] {
    let links = mechanism.joints[at.joint].links;
    links.map(|l| copy(mechanism, l, at.lane))
}

/// Returns the copy of a link, or of what stands for a drive, in a lane.
pub(in crate::search) fn copy(mechanism: &Mechanism, link: LinkId, lane: usize) -> LinkId {
    LinkId::new(lane * mechanism.bodies() + link.index())
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
