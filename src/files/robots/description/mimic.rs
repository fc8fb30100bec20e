//! Couplings as mimic joints: each joint follows one other at most, so that a tree of couplings can be said, and no more.

use crate::closure::tree::forest;
use crate::model::joint_type::Coupling;
use crate::model::mechanism::{JointId, Mechanism, StateId};

/// What a joint follows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Follows {
    /// The joint that leads.
    pub(in crate::robots) leader: JointId,
    /// Its own rate over the leader's, in radians and metres.
    pub(in crate::robots) ratio: f64,
}

/// For each joint what it follows, and a sentence for each coupling that mimic joints cannot say: those of joints that are
/// not `written` as joints of one freedom, and those that close a loop of couplings.
pub(crate) fn mimics(m: &Mechanism, written: &[bool]) -> (Vec<Option<Follows>>, Vec<String>) {
    let mut follows = vec![None; m.joints.len()];
    let mut said = vec![false; m.couplings.len()];
    let fits = |j: JointId| written[j] && m.joints[j].joint_type.freedoms().len() == 1;
    // Drives lead. A coupling of joints that cannot follow is a loop of one node, which no tree takes.
    let drives = m.joint_ids().filter(|&j| m.joints[j].drive);
    let edges = m.couplings.iter().map(|c| {
        let [a, b] = c.ends.map(|e| e.joint);
        let ends = if fits(a) && fits(b) { [a, b] } else { [a, a] };
        ends.map(JointId::index)
    });
    let starts = drives.chain(m.joint_ids()).map(JointId::index);
    let (_, steps) = forest(m.joints.len(), edges, |_| false, starts);
    for s in steps {
        let coupling = &m.couplings[s.joint];
        let unit = |e: usize| match coupling.ends[e].freedom {
            f if f.slides() => m.length_unit.metres,
            _ => 1.0,
        };
        let forward = coupling.ratio.to_f64() * unit(1) / unit(0);
        let ratio = if s.forward { forward } else { 1.0 / forward };
        follows[s.link] = Some(Follows {
            leader: JointId::new(s.from),
            ratio,
        });
        said[s.joint] = true;
    }
    let left = m.couplings.iter().zip(&said).filter(|(_, s)| !**s);
    let present = left.filter(|(c, _)| m.couplings_in(StateId::FREE).any(|x| x.ends == c.ends));
    let unsaid = |c: &Coupling| format!("coupled, which no mimic joint says: {}", c.name(m));
    (follows, present.map(|(c, _)| unsaid(c)).collect())
}

/// Marks a place in a text that depends on a joint and is settled later; no name has such a character.
const MARK: char = '\0';

/// Stands in a text for what is known of a joint only when all are written.
pub(crate) fn stand_in(joint: JointId) -> String {
    format!("{MARK}{}{MARK}", joint.index())
}

/// The text with what is known now in those places.
pub(crate) fn settled(text: &str, known: impl Fn(JointId) -> String) -> String {
    let mut out = String::with_capacity(text.len());
    for (i, part) in text.split(MARK).enumerate() {
        match part.parse() {
            Ok(joint) if i % 2 == 1 => out.push_str(&known(JointId::new(joint))),
            _ => out.push_str(part),
        }
    }
    out
}
