//! How a file wants variants ranked, and what it says of joint types.

use crate::model::StateId;
use serde::{Serialize, Serializer};
use serde_json::json;

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

/// What is said of a term wherever it stands: files, text, JSON, CSV, the schema and the help follow from it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AboutTerm {
    /// The word used for it in files and on the command line.
    pub word: &'static str,
    /// Its key among the scores in JSON, and with underscores the head of its column in CSV.
    pub key: &'static str,
    /// The head of its column in a list of variants; `None` where such a list has the column anyway.
    pub heading: Option<&'static str>,
    /// Whether it is a column of the ranking in CSV, and not one that every variant has there.
    pub csv: bool,
    /// Whether it counts something.
    pub is_count: bool,
    /// What the figure is multiplied by in lists and in a weighted sum.
    pub scale: f64,
    /// What it is, for who writes a file.
    pub meaning: &'static str,
}

impl AboutTerm {
    /// Of a term that is measured, as most are.
    const fn measured(word: &'static str, meaning: &'static str) -> AboutTerm {
        AboutTerm {
            word,
            key: word,
            heading: None,
            csv: true,
            is_count: false,
            scale: 1.0,
            meaning,
        }
    }
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

    /// What is said of it.
    #[must_use]
    pub fn about(self) -> AboutTerm {
        match self {
            Term::PeakForce => AboutTerm {
                heading: Some("force"),
                ..AboutTerm::measured(
                    "peak-force",
                    "the greatest joint force over its type's capacity",
                )
            },
            Term::PeakMoment => AboutTerm {
                heading: Some("moment"),
                ..AboutTerm::measured(
                    "peak-moment",
                    "the greatest joint moment over its type's capacity",
                )
            },
            // A variant has a conditioning with its drives free, too.
            Term::Conditioning => AboutTerm {
                key: "conditioning-held",
                heading: Some("cond. held"),
                ..AboutTerm::measured(
                    "conditioning",
                    "the smallest singular value over the largest with the drives held, greater being better",
                )
            },
            Term::OutputError => AboutTerm {
                heading: Some("error, mm"),
                scale: 1e3,
                ..AboutTerm::measured("output-error", "how far clearances move the outputs, in mm")
            },
            Term::Changes => AboutTerm {
                heading: Some("changed"),
                csv: false,
                is_count: true,
                ..AboutTerm::measured("changes", "joints changed and inserted")
            },
            Term::Cost => AboutTerm {
                csv: false,
                ..AboutTerm::measured("cost", "the additive cost")
            },
            Term::Idle => AboutTerm {
                heading: Some("idle"),
                is_count: true,
                ..AboutTerm::measured("idle", "mobility beyond the working one")
            },
            Term::Harmful => AboutTerm {
                csv: false,
                is_count: true,
                ..AboutTerm::measured(
                    "harmful",
                    "harmful redundant constraints that the searched state adds",
                )
            },
        }
    }

    /// The word used for it in files and results.
    ///
    /// # Examples
    /// ```
    /// use ozols::model::ranking::Term;
    /// assert_eq!(Term::PeakForce.name(), "peak-force");
    /// assert_eq!(Term::from_name("peak-force"), Some(Term::PeakForce));
    /// ```
    #[must_use]
    pub fn name(self) -> &'static str {
        self.about().word
    }

    /// The head of its column in a list of variants; `None` where such a list has the column anyway.
    #[must_use]
    pub fn heading(self) -> Option<&'static str> {
        self.about().heading
    }

    /// The term a word names.
    #[must_use]
    pub fn from_name(word: &str) -> Option<Term> {
        Term::ALL.into_iter().find(|t| t.name() == word)
    }
}

impl Serialize for Term {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
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

impl Serialize for Order {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

/// How clearances add up at the outputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ClearanceSum {
    /// Every joint is off the worst way.
    #[default]
    Worst,
    /// Root mean square for independent directions, all alike.
    Rms,
}

/// A bound that variants must keep.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Limit {
    /// Of this term.
    pub term: Term,
    /// Not below.
    pub min: Option<f64>,
    /// Not above.
    pub max: Option<f64>,
}

/// A ranking.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Ranking {
    /// The order.
    pub order: Order,
    /// The terms with their weights, not negative, the first the most important.
    #[serde(serialize_with = "with_weights")]
    pub terms: Vec<(Term, f64)>,
    /// Bounds to keep.
    pub limits: Vec<Limit>,
    /// How clearances add up.
    pub clearance: ClearanceSum,
    /// The states that count; those with loads where there are none.
    #[serde(skip)]
    pub states: Vec<StateId>,
}

fn with_weights<S: Serializer>(terms: &[(Term, f64)], serializer: S) -> Result<S::Ok, S::Error> {
    let one = |(term, weight): &(Term, f64)| json!({"term": term, "weight": weight});
    serializer.collect_seq(terms.iter().map(one))
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
