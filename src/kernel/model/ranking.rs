//! Ranking of variants in a file, and the properties of joint types stated there.

use crate::model::StateId;
use serde::{Serialize, Serializer};
use serde_json::json;

/// Term by which variants are scored. Smaller is better, except for conditioning.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Term {
    /// The largest joint force relative to its type's capacity.
    PeakForce,
    /// The largest joint moment relative to its type's capacity.
    PeakMoment,
    /// Ratio of the smallest to the largest singular value of the closure equations with the drives held; larger is
    /// better.
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
    /// Root mean square of the assembly force at the most loaded joint, if joints are inaccurate `[N]`.
    Misfit,
}

/// Description of a term: files, text, JSON, CSV, the schema and the help use it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AboutTerm {
    /// The word used for it in files and on the command line.
    pub word: &'static str,
    /// Its key among the scores in JSON, and with underscores the head of its column in CSV.
    pub key: &'static str,
    /// The head of its column in a list of variants, or `None` if such a list already has the column.
    pub heading: Option<&'static str>,
    /// Whether it is a separate column of the ranking in CSV, and not one that every variant already has.
    pub csv: bool,
    /// Whether it is a count.
    pub is_count: bool,
    /// Factor on the figure in lists and in a weighted sum.
    pub scale: f64,
    /// Its meaning, for authors of files.
    pub meaning: &'static str,
}

impl AboutTerm {
    /// Describes a term that is measured, as most are.
    const fn measured_term(word: &'static str, meaning: &'static str) -> AboutTerm {
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
    /// All terms.
    pub const ALL: [Term; 9] = [
        Term::PeakForce,
        Term::PeakMoment,
        Term::Conditioning,
        Term::OutputError,
        Term::Changes,
        Term::Cost,
        Term::Idle,
        Term::Harmful,
        Term::Misfit,
    ];

    /// Returns its description.
    ///
    /// # Examples
    /// ```
    /// use ozols::model::ranking::Term;
    /// let about = Term::OutputError.about();
    /// assert_eq!((about.word, about.scale), ("output-error", 1e3)); // Listed in mm, counted in m.
    /// ```
    #[must_use]
    pub fn about(self) -> AboutTerm {
        match self {
            Term::PeakForce => AboutTerm {
                heading: Some("force"),
                ..AboutTerm::measured_term(
                    "peak-force",
                    "the greatest joint force divided by the capacity of its type",
                )
            },
            Term::PeakMoment => AboutTerm {
                heading: Some("moment"),
                ..AboutTerm::measured_term(
                    "peak-moment",
                    "the greatest joint moment divided by the capacity of its type",
                )
            },
            // A variant also has a conditioning with its drives free.
            Term::Conditioning => AboutTerm {
                key: "conditioning-held",
                heading: Some("cond. held"),
                ..AboutTerm::measured_term(
                    "conditioning",
                    "the smallest singular value divided by the largest, with the drives locked; greater is better",
                )
            },
            Term::OutputError => AboutTerm {
                heading: Some("error, mm"),
                scale: 1e3,
                ..AboutTerm::measured_term(
                    "output-error",
                    "how far clearances move the outputs, in mm",
                )
            },
            Term::Changes => AboutTerm {
                heading: Some("changed"),
                csv: false,
                is_count: true,
                ..AboutTerm::measured_term("changes", "number of joints changed and inserted")
            },
            Term::Cost => AboutTerm {
                csv: false,
                ..AboutTerm::measured_term("cost", "additive cost")
            },
            Term::Idle => AboutTerm {
                heading: Some("idle"),
                is_count: true,
                ..AboutTerm::measured_term("idle", "mobility in addition to that of the outputs")
            },
            Term::Harmful => AboutTerm {
                csv: false,
                is_count: true,
                ..AboutTerm::measured_term(
                    "harmful",
                    "number of harmful redundant constraints that the searched state adds",
                )
            },
            Term::Misfit => AboutTerm {
                heading: Some("misfit, N"),
                ..AboutTerm::measured_term(
                    "misfit",
                    "the root mean square force that closes the loops at the most loaded joint, for the accuracy of [tolerances], in N",
                )
            },
        }
    }

    /// Returns the word used for it in files and results.
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

    /// Returns the head of its column in a list of variants, or `None` if such a list already has the column.
    #[must_use]
    pub fn heading(self) -> Option<&'static str> {
        self.about().heading
    }

    /// Returns the term that a word names.
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

/// Addition of clearances at the outputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ClearanceSum {
    /// Every joint deviates in the worst direction.
    #[default]
    Worst,
    /// Root mean square for independent directions with equal probability.
    Rms,
}

/// A bound that variants must keep.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Limit {
    /// The term.
    pub term: Term,
    /// Lower bound.
    pub min: Option<f64>,
    /// Upper bound.
    pub max: Option<f64>,
}

/// A ranking, by the sum of weight times term.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Ranking {
    /// The terms with their nonnegative weights.
    #[serde(serialize_with = "with_weights")]
    pub terms: Vec<(Term, f64)>,
    /// Bounds to keep.
    pub limits: Vec<Limit>,
    /// Addition of clearances.
    pub clearance: ClearanceSum,
    /// The states that count. If empty, those with loads.
    #[serde(skip)]
    pub states: Vec<StateId>,
}

fn with_weights<S: Serializer>(terms: &[(Term, f64)], serializer: S) -> Result<S::Ok, S::Error> {
    let one = |(term, weight): &(Term, f64)| json!({"term": term, "weight": weight});
    serializer.collect_seq(terms.iter().map(one))
}

/// Properties of a joint type in a file, which replace those of the catalogue.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TypeOverride {
    /// Name of the type or option.
    pub name: String,
    /// Force capacity `[N]`.
    pub capacity_force: Option<f64>,
    /// Moment capacity `[N·m]`.
    pub capacity_moment: Option<f64>,
    /// Clearance between its parts, from the middle to the end `[m]`.
    pub clearance: Option<f64>,
}
