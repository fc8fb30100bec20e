//! How a file wants variants ranked, and what it says of joint types.

use crate::model::id::StateId;

/// What variants are scored by. Smaller is better, but for conditioning.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Term {
    /// The greatest joint force over its type's capacity.
    PeakForce,
    /// The greatest joint moment over its type's capacity.
    PeakMoment,
    /// Smallest over greatest singular value of the closure equations with the drives held; greater is better.
    Conditioning,
    /// Error of the outputs' position from the clearances of the joints `[m]`.
    OutputError,
    /// Changed joints and inserted unloading joints.
    Changes,
    /// The additive cost.
    Cost,
    /// Mobility beyond the working one.
    Idle,
    /// Harmful redundant constraints that the searched state adds.
    Harmful,
}

impl Term {
    /// Every term.
    pub const ALL: [Term; 8] = [
        Term::PeakForce,
        Term::PeakMoment,
        Term::Conditioning,
        Term::OutputError,
        Term::Changes,
        Term::Cost,
        Term::Idle,
        Term::Harmful,
    ];

    /// The word used for it in files and results.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Term::PeakForce => "peak-force",
            Term::PeakMoment => "peak-moment",
            Term::Conditioning => "conditioning",
            Term::OutputError => "output-error",
            Term::Changes => "changes",
            Term::Cost => "cost",
            Term::Idle => "idle",
            Term::Harmful => "harmful",
        }
    }

    /// The head of its column in a list of variants; `None` where such a list has the column anyway.
    #[must_use]
    pub fn heading(self) -> Option<&'static str> {
        match self {
            Term::PeakForce => Some("force"),
            Term::PeakMoment => Some("moment"),
            Term::Conditioning => Some("cond. held"),
            Term::OutputError => Some("error, mm"),
            Term::Changes => Some("changed"),
            Term::Idle => Some("idle"),
            Term::Cost | Term::Harmful => None,
        }
    }

    /// The term a word names.
    #[must_use]
    pub fn from_name(word: &str) -> Option<Term> {
        Term::ALL.into_iter().find(|t| t.name() == word)
    }
}

/// How terms make an order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Order {
    /// By the sum of weight times term.
    #[default]
    Weighted,
    /// By the first term, then the second, and so on.
    Lexicographic,
    /// Those that no other is better than in all terms first, front by front.
    Pareto,
}

impl Order {
    /// Every order with its word.
    pub const ALL: [(Order, &'static str); 3] = [
        (Order::Weighted, "weighted"),
        (Order::Lexicographic, "lexicographic"),
        (Order::Pareto, "pareto"),
    ];

    /// The word used for it in files and results.
    #[must_use]
    pub fn name(self) -> &'static str {
        Order::ALL[self as usize].1
    }
}

/// How clearances add up at the outputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ClearanceSum {
    /// Every joint is off the worst way.
    #[default]
    Worst,
    /// Root mean square for independent directions, all alike.
    Rms,
}

/// A bound that variants must keep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// Of this term.
    pub term: Term,
    /// Not below.
    pub min: Option<f64>,
    /// Not above.
    pub max: Option<f64>,
}

/// A ranking.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Ranking {
    /// The order.
    pub order: Order,
    /// The terms with their weights, not negative, the first the most important.
    pub terms: Vec<(Term, f64)>,
    /// Bounds to keep.
    pub limits: Vec<Limit>,
    /// How clearances add up.
    pub clearance: ClearanceSum,
    /// The states that count; those with loads where there are none.
    pub states: Vec<StateId>,
}

/// What a file says of a joint type in place of the catalogue.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TypeOverride {
    /// Name of the type or option.
    pub name: String,
    /// Force it bears `[N]`.
    pub capacity_force: Option<f64>,
    /// Moment it bears `[N·m]`.
    pub capacity_moment: Option<f64>,
    /// Play between its parts, from the middle to the end `[m]`.
    pub clearance: Option<f64>,
}
