//! Generic rank: the mobility of the same structure with its joints in general position, by a pebble game.
//!
//! A joint of class c is c bars between two bodies. Generically, a set of bars is independent if and only if it is (D,
//! D)-sparse, with D = 6 in space and 3 in the plane [Tay 1984; Tay & Whiteley 1984 for hinges; Katoh & Tanigawa 2011].
//! The pebble game decides this [Lee & Streinu 2008].

use crate::model::mechanism::{LinkId, Mechanism, Mode, StateId};
use crate::rank::method::{Answer, Certainty, MobilityMethod, NoAnswer, RankOfJ, to_i64};

/// The (D, D) pebble game: accepts bars as long as they are independent of the accepted ones.
#[derive(Debug)]
struct Pebbles {
    free: Vec<usize>,
    /// Directed bars: `out[a]` lists the heads of the bars that hold a pebble of `a`.
    out: Vec<Vec<usize>>,
}

impl Pebbles {
    /// Brings one more free pebble to `to` without moving those of `keep`.
    fn gather_pebble(&mut self, to: usize, keep: usize) -> bool {
        let mut came: Vec<Option<usize>> = vec![None; self.free.len()];
        let mut stack = vec![to];
        came[to] = Some(to);
        came[keep] = Some(keep);
        while let Some(at) = stack.pop() {
            if at != to && self.free[at] > 0 {
                self.free[at] -= 1;
                self.free[to] += 1;
                // Reverses the path.
                let mut head = at;
                while head != to {
                    let tail = came[head].unwrap_or(to);
                    if let Some(i) = self.out[tail].iter().position(|&h| h == head) {
                        self.out[tail].swap_remove(i);
                    }
                    self.out[head].push(tail);
                    head = tail;
                }
                return true;
            }
            let heads = self.out[at].clone();
            for next in heads {
                if came[next].is_none() {
                    came[next] = Some(at);
                    stack.push(next);
                }
            }
        }
        false
    }

    fn insert_bar(&mut self, a: usize, b: usize, dim: usize) -> bool {
        while self.free[a] < dim {
            if !self.gather_pebble(a, b) {
                break;
            }
        }
        while self.free[a] + self.free[b] <= dim {
            if !self.gather_pebble(b, a) {
                return false;
            }
        }
        let (tail, head) = if self.free[a] > 0 { (a, b) } else { (b, a) };
        self.free[tail] -= 1;
        self.out[tail].push(head);
        true
    }
}

/// Returns the number of independent bars between bodies in general position.
///
/// # Examples
/// ```
/// use ozols::rank::method::generic::generic_rank;
/// // Three bars hold a body in a plane, and a fourth is one too many.
/// assert_eq!(generic_rank(2, &[(0, 1); 4], 3), 3);
/// ```
#[must_use]
pub fn generic_rank(bodies: usize, bars: &[(usize, usize)], dim: usize) -> usize {
    let mut game = Pebbles {
        free: vec![dim; bodies],
        out: vec![Vec::new(); bodies],
    };
    bars.iter()
        .filter(|&&(a, b)| a != b && game.insert_bar(a, b, dim))
        .count()
}

/// W = D(n - 1) - the rank of the bars in general position.
pub(crate) const GENERIC: MobilityMethod = MobilityMethod {
    name: "generic",
    title: "generic rank (pebble game)",
    help: "The same structure in general position, by a pebble game",
    guarantee: "right for joints in general position; ignores special geometry (parallel, concurrent, symmetric)",
    complexity: "O(D² n · bars)",
    source: "Tay 1984; Lee & Streinu 2008",
    rank: RankOfJ::NotFound,
    answer: answer_generic,
};

fn answer_generic(mechanism: &Mechanism, state: StateId) -> Result<Answer, NoAnswer> {
    if mechanism.couplings_in(state).next().is_some() {
        return Err(NoAnswer::DoesNotApply(
            "the pebble game does not support couplings of joints",
        ));
    }
    let dim = match mechanism.mode {
        Mode::Spatial => 6,
        Mode::Planar { .. } => 3,
    };
    let links: Vec<LinkId> = mechanism.links_in(state).collect();
    let mut bars = Vec::new();
    for j in mechanism.joints_in(state) {
        let joint = &mechanism.joints[j];
        let [a, b] = joint.links.map(|l| links.binary_search(&l).unwrap_or(0));
        let class = usize::saturating_sub(dim, joint.joint_type.freedoms().len());
        bars.extend(std::iter::repeat_n((a, b), class));
    }
    let rank = generic_rank(links.len(), &bars, dim);
    let all = dim * (links.len().max(1) - 1);
    Ok(Answer::from_count(
        to_i64(all) - to_i64(rank),
        Certainty::Counted,
    ))
}

#[cfg(test)]
mod tests {
    use super::generic_rank;

    #[test]
    fn loops_of_hinges() {
        // A ring of n bodies with hinges (five bars each) has mobility n - 6, or 0 below that.
        for n in 3..12_usize {
            let bars: Vec<_> = (0..n)
                .flat_map(|i| std::iter::repeat_n((i, (i + 1) % n), 5))
                .collect();
            let mobility = 6 * (n - 1) - generic_rank(n, &bars, 6);
            assert_eq!(mobility, n.saturating_sub(6), "{n}");
        }
    }

    #[test]
    fn planar_chains() {
        // Pins are two bars in the plane: the four-bar linkage moves, the triangle does not.
        let ring = |n: usize| -> Vec<_> {
            (0..n)
                .flat_map(|i| std::iter::repeat_n((i, (i + 1) % n), 2))
                .collect()
        };
        for (n, w) in [(3, 0), (4, 1), (5, 2)] {
            assert_eq!(3 * (n - 1) - generic_rank(n, &ring(n), 3), w);
        }
    }
}
