//! Mobility and motion of joints, from the twists of all links.

use super::rational::{Q, reduce};
use crate::common::*;
use num_traits::{One, Zero};

/// Joint motion written out with a twist for every link: unknowns are link twists and joint speeds; each joint demands
/// t_b - t_a = Σ speeds · twists, and the frame rests; `coupled` are sums of two speeds with factors that must vanish. No
/// contours, no spanning tree. `driven` are speeds whose motion counts beside that of the outputs.
pub(super) struct Figures {
    pub(super) mobility: usize,
    pub(super) freedoms: usize,
    pub(super) motion: usize,
    /// Whether each of some pairs of links moves as one.
    pub(super) together: Vec<bool>,
}

pub(super) fn figures(
    links: usize,
    frame: LinkId,
    joints: &[([LinkId; 2], Vec<Vec<Q>>)],
    coupled: &[[(usize, Q); 2]],
    outputs: &[LinkId],
    driven: &[usize],
    pairs: &[(LinkId, LinkId)],
) -> Figures {
    let freedoms: usize = joints.iter().map(|(_, t)| t.len()).sum();
    let width = links * 6 + freedoms;
    let mut rows = Vec::new();
    let mut at = links * 6;
    for ([a, b], columns) in joints {
        for c in 0..6 {
            let mut row = vec![Q::zero(); width];
            row[b.index() * 6 + c] += Q::one();
            row[a.index() * 6 + c] -= Q::one();
            for (i, t) in columns.iter().enumerate() {
                row[at + i] -= &t[c];
            }
            rows.push(row);
        }
        at += columns.len();
    }
    for entries in coupled {
        let mut row = vec![Q::zero(); width];
        for (column, factor) in entries {
            row[links * 6 + column] += factor;
        }
        rows.push(row);
    }
    let rest = |l: LinkId, c: usize| {
        let mut row = vec![Q::zero(); width];
        row[l.index() * 6 + c] = Q::one();
        row
    };
    rows.extend((0..6).map(|c| rest(frame, c)));
    // Links that no joint holds in this state rest too.
    let held = |l: LinkId| joints.iter().any(|(ends, _)| ends.contains(&l));
    rows.extend(
        LinkId::first(links)
            .filter(|&l| l != frame && !held(l))
            .flat_map(|l| (0..6).map(move |c| (l, c)))
            .map(|(l, c)| rest(l, c)),
    );
    // What comes to these rows is reduced beside what is left of them.
    let mut rows = reduce(rows);
    let all = rows.len();
    let together = |&(a, b): &(LinkId, LinkId)| {
        let mut more = rows.clone();
        more.extend((0..6).map(|c| {
            let mut row = rest(a, c);
            row[b.index() * 6 + c] -= Q::one();
            row
        }));
        reduce(more).len() == all
    };
    let together = pairs.iter().map(together).collect();
    rows.extend(
        outputs
            .iter()
            .flat_map(|&l| (0..6).map(move |c| (l, c)))
            .map(|(l, c)| rest(l, c)),
    );
    rows.extend(driven.iter().map(|column| {
        let mut row = vec![Q::zero(); width];
        row[links * 6 + column] = Q::one();
        row
    }));
    let resting = reduce(rows).len();
    Figures {
        mobility: width - all,
        freedoms,
        motion: resting - all,
        together,
    }
}
