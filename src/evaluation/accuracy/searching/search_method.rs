//! The ways of searching.

use crate::rank::method::MobilityMethod;
use crate::rank::numeric::Elimination;
use crate::score::request::{Check, POOL, Request};
use std::fmt;

/// A way of searching.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// The whole diagram, checked in some way.
    Diagram(Check),
    /// The diagram cut down to so many nodes.
    Nodes(usize),
    /// A ranking of so many of the cheapest variants, on the diagram.
    Pool(usize),
    /// Depth first modulo a prime, leaving out what cannot become determinate.
    Pruned,
    /// Brute force modulo a prime.
    Brute,
    /// Brute force in floating point, at the default tolerance.
    Float(Elimination),
}

/// The ways there are with a diagram of so many nodes; `pool` is what a ranking is judged by, where there is one: a smaller pool is
/// a way.
pub(super) fn all(nodes: usize, pool: Option<usize>) -> Vec<Way> {
    let mut ways = [Check::None, Check::Prime, Check::Full]
        .map(Way::Diagram)
        .to_vec();
    ways.extend([2, 8, 32].map(|part| Way::Nodes((nodes / part).max(1))));
    let pools = [10, 100, 1000, 10_000, POOL].into_iter();
    ways.extend(
        pools
            .filter(|p| pool.is_some_and(|most| *p < most))
            .map(Way::Pool),
    );
    ways.extend([Way::Pruned, Way::Brute]);
    ways.extend(Elimination::ALL.map(Way::Float));
    ways
}

impl Way {
    /// A request searched this way.
    pub(super) fn request(self, base: &Request) -> Request {
        let mut request = base.clone();
        match self {
            Way::Diagram(check) => request.check = check,
            Way::Nodes(nodes) => request.nodes = nodes,
            Way::Pool(pool) => request.pool = Some(pool),
            Way::Pruned | Way::Brute | Way::Float(_) => {}
        }
        request
    }

    /// Returns whether it is the whole diagram over one prime, with which the others are compared.
    pub(super) fn is_whole(self) -> bool {
        self == Way::Diagram(Check::None)
    }

    /// Returns the kind of way.
    pub(super) fn kind(self) -> &'static str {
        match self {
            Way::Diagram(_) => "whole diagram",
            Way::Nodes(_) => "stopped by --nodes, with an estimate",
            Way::Pool(_) => "ranked --pool",
            Way::Pruned => "pruned",
            Way::Brute => "brute force",
            Way::Float(_) => "brute force, floating point",
        }
    }

    /// Whether it counts as another way does, and differs in how the best are found or checked alone.
    #[must_use]
    pub(crate) fn only_names(self) -> bool {
        matches!(self, Way::Diagram(Check::Full) | Way::Pool(_))
    }

    /// Whether it looks at variants one by one.
    #[must_use]
    pub fn looks(self) -> bool {
        matches!(self, Way::Pruned | Way::Brute | Way::Float(_))
    }

    /// What it is, in a sentence's part.
    #[must_use]
    pub fn about(self) -> &'static str {
        match self {
            Way::Diagram(Check::None) => "the diagram over one prime, --check none",
            Way::Diagram(Check::Prime) => "over two primes, --check prime",
            Way::Diagram(Check::Full) => "and each of the best by singular values, --check full",
            Way::Nodes(_) => "one prime, with a budget of --nodes, and an estimate of what is cut",
            Way::Pool(_) => "one prime, with a --pool to rank",
            Way::Pruned => {
                "depth first, leaving out what cannot become determinate, modulo a prime"
            }
            Way::Brute => "every variant, modulo a prime",
            Way::Float(_) => "every variant, by floating-point ranks",
        }
    }
}

impl fmt::Display for Way {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Way::Diagram(Check::None) => write!(f, "one prime"),
            Way::Diagram(Check::Prime) => write!(f, "two primes"),
            Way::Diagram(Check::Full) => write!(f, "full check"),
            Way::Nodes(n) => write!(f, "{n} nodes"),
            Way::Pool(POOL) => write!(f, "pool of {POOL}, the default"),
            Way::Pool(n) => write!(f, "pool of {n}"),
            Way::Pruned => write!(f, "pruned"),
            Way::Brute => write!(f, "brute force"),
            Way::Float(e) => write!(f, "brute force, {}", e.name()),
        }
    }
}
