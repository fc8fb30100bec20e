//! Local mobilities: links that move while every output rests, and about which lines.

use crate::closure::matrix::Closure;
use crate::geom::exact::ExactField;
use crate::geom::scalars::Scalars;
use crate::linalg::echelon::relations;
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, LinkId, Mechanism};
use crate::redundancy::motion::{Speeds, twist};

/// One idle motion.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Idle {
    /// The links that move; one where the motion is a link's own.
    pub links: Vec<LinkId>,
    /// Joints of a single link whose points the motion leaves at rest: two of them name the line it spins about.
    pub through: Vec<JointId>,
    /// Whether a single link only turns (rather than slides).
    pub turns: bool,
}

/// A basis of the motions that leave the outputs at rest: motions of one link alone first, then what is left.
///
/// # Complexity
/// O(n · W · f) for the twists of n links, and one elimination per link, O(n · W² · n).
#[must_use]
pub fn idle_motions(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    kernel: &[Speeds],
    outputs: &[LinkId],
) -> Vec<Idle> {
    let f = exact.field();
    let links: Vec<LinkId> = mechanism
        .link_ids()
        .filter(|&l| {
            mechanism
                .joints_in(closure.state)
                .any(|j| mechanism.joints[j].links.contains(&l))
        })
        .collect();
    let motion: Vec<Vec<Vec<Residue>>> = links
        .iter()
        .map(|&l| closure.link_motion(exact, mechanism, l))
        .collect();
    // What each link does under each of the kernel's motions.
    let moves: Vec<Vec<Vec<Residue>>> = motion
        .iter()
        .map(|m| kernel.iter().map(|k| twist(exact, m, k)).collect())
        .collect();
    // Motions (as combinations of the kernel's) under which the given links rest.
    let resting = |rest: &dyn Fn(LinkId) -> bool| -> Vec<Speeds> {
        let images: Vec<Vec<Residue>> = kernel
            .iter()
            .enumerate()
            .map(|(k, _)| {
                let parts = links.iter().zip(&moves).filter(|(l, _)| rest(**l));
                let mut image: Vec<Residue> = parts.flat_map(|(_, m)| m[k].clone()).collect();
                image.push(0);
                image
            })
            .collect();
        let combine = |combination: Vec<Residue>| {
            let mut out = vec![0; closure.columns.len()];
            for (&a, k) in combination.iter().zip(kernel).filter(|(a, _)| **a != 0) {
                out.iter_mut()
                    .zip(k)
                    .for_each(|(o, &x)| *o = f.add(*o, f.mul(a, x)));
            }
            out
        };
        relations(f, &images).into_iter().map(combine).collect()
    };
    let all = resting(&|l| outputs.contains(&l));
    let mut span = crate::linalg::echelon::Echelon::new(f);
    let mut found = Vec::new();
    for &l in links.iter().filter(|l| !outputs.contains(l)) {
        for speeds in resting(&|other| other != l) {
            if span.insert(&speeds) {
                let at = links.iter().position(|&x| x == l).unwrap_or(0);
                let own = twist(exact, &motion[at], &speeds);
                let through = mechanism
                    .joints_in(closure.state)
                    .filter(|&j| {
                        mechanism.joints[j].links.contains(&l)
                            && rests_at(exact, mechanism, j, &own)
                    })
                    .collect();
                let turns = own.len() == 6 && own[..3].iter().any(|&x| x != 0);
                found.push(Idle {
                    links: vec![l],
                    through,
                    turns,
                });
            }
        }
    }
    for speeds in all {
        if span.insert(&speeds) {
            let moving = links
                .iter()
                .zip(&motion)
                .filter(|(_, m)| twist(exact, m, &speeds).iter().any(|&x| x != 0));
            found.push(Idle {
                links: moving.map(|(l, _)| *l).collect(),
                through: Vec::new(),
                turns: false,
            });
        }
    }
    found
}

/// Whether a twist leaves a joint's point at rest: v + ω × p = 0.
fn rests_at(exact: &ExactField, mechanism: &Mechanism, joint: JointId, t: &[Residue]) -> bool {
    let (&[w0, w1, w2, v0, v1, v2], Ok(p)) = (t, exact.eval3(&mechanism.joints[joint].frame.point))
    else {
        return false;
    };
    let turn = exact.cross([w0, w1, w2], p);
    [v0, v1, v2]
        .iter()
        .zip(turn)
        .all(|(&v, t)| exact.field().add(v, t) == 0)
}
