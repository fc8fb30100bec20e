//! Ways of searching, what each is worth on a mechanism, and the table of it for programs.

use num_bigint::BigUint;
use num_traits::ToPrimitive;
use ozols::accuracy::timing::Timing;
use ozols::rank::numeric::Elimination;
use ozols::score::request::{Check, Request};
use ozols_kernel::format::csv;
use serde_json::{Map, Value, json};
use std::fmt;

/// A way of searching.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Way {
    /// The whole diagram, checked in some way.
    Diagram(Check),
    /// The diagram with a budget of nodes.
    Nodes(usize),
    /// A ranking of the given number of cheapest variants. `None` is the default, which also ranks all others that could win.
    Pool(Option<usize>),
    /// Depth first modulo a prime, without what cannot become determinate.
    Pruned,
    /// Brute force modulo a prime.
    Brute,
    /// Brute force in floating point, at the default tolerance.
    Float(Elimination),
}

impl Way {
    /// Returns a request that searches this way.
    pub(crate) fn apply_to(self, base: &Request) -> Request {
        let mut request = base.clone();
        match self {
            Way::Diagram(check) => request.check = check,
            Way::Nodes(nodes) => request.nodes = nodes,
            Way::Pool(pool) => request.pool = pool,
            Way::Pruned | Way::Brute | Way::Float(_) => {}
        }
        request
    }

    /// Returns the kind of way, and its description.
    pub(crate) fn kind_and_text(self) -> [&'static str; 2] {
        match self {
            Way::Diagram(Check::None) => ["whole diagram", "the diagram over one prime"],
            Way::Diagram(Check::Prime) => ["whole diagram", "the diagram over two primes"],
            Way::Diagram(Check::Full) => {
                ["whole diagram", "also each of the best by singular values"]
            }
            Way::Nodes(_) => ["stopped early", "a budget of nodes, and an estimate"],
            Way::Pool(None) => ["ranked", "the cheapest variants and all that could win"],
            Way::Pool(_) => ["ranked", "the cheapest variants"],
            Way::Pruned => [
                "pruned",
                "depth first, without what cannot become determinate",
            ],
            Way::Brute => ["brute force", "every variant, modulo a prime"],
            Way::Float(_) => [
                "brute force, floating point",
                "every variant, by floating-point ranks",
            ],
        }
    }

    /// Returns whether it counts as another way does, and differs only in how the best are found or checked.
    pub(crate) fn only_names(self) -> bool {
        matches!(self, Way::Diagram(Check::Full) | Way::Pool(_))
    }

    /// Returns the budget of nodes.
    pub(crate) fn budget(self) -> Option<usize> {
        match self {
            Way::Nodes(nodes) => Some(nodes),
            _ => None,
        }
    }

    /// Returns whether it examines variants one by one.
    pub(crate) fn examines_variants(self) -> bool {
        matches!(self, Way::Pruned | Way::Brute | Way::Float(_))
    }
}

impl fmt::Display for Way {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Way::Diagram(Check::None) => write!(f, "one prime"),
            Way::Diagram(Check::Prime) => write!(f, "two primes"),
            Way::Diagram(Check::Full) => write!(f, "full check"),
            Way::Nodes(n) => write!(f, "{n} nodes"),
            Way::Pool(None) => write!(f, "default ranking, proven"),
            Way::Pool(Some(n)) => write!(f, "pool of {n}"),
            Way::Pruned => write!(f, "pruned"),
            Way::Brute => write!(f, "brute force"),
            Way::Float(e) => write!(f, "brute force, {}", e.name()),
        }
    }
}

/// The right ones of some.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Share {
    /// Right ones.
    pub right: usize,
    /// All.
    pub of: usize,
}

/// Bounds on the number of admissible variants from a search with a budget of nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bracket {
    /// Bounds that are certain. They are equal if the budget was large enough.
    pub certain: [f64; 2],
    /// Bounds with a confidence of 95 %.
    pub likely: [f64; 2],
    /// Whether the true number lies within the likely bounds; `None` if it is not known.
    pub holds: Option<bool>,
}

impl Bracket {
    /// Returns whether the certain bounds differ.
    pub(crate) fn is_open(self) -> bool {
        self.certain[0] < self.certain[1]
    }

    /// Returns the width of some bounds in decades. A decade is a factor of ten.
    pub(crate) fn width_in_decades([least, most]: [f64; 2]) -> f64 {
        (most.max(1.0) / least.max(1.0)).log10()
    }
}

/// The results of one way of searching.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Record {
    /// The way.
    pub way: Way,
    /// The time to count, or to examine all; `None` if it counts as another way does.
    pub counting: Option<Timing>,
    /// The time to count and to name the best; `None` if it names none.
    pub naming: Option<Timing>,
    /// Whether the time is that of the examined variants, in proportion to all.
    pub by_proportion: bool,
    /// Right counts of determinate and of admissible variants, by W and number of changes; `None` if it gives none, or the truth is
    /// not known.
    pub counts: Option<Share>,
    /// How many of the best it names; `None` if it names none, or the truth is not known.
    pub best: Option<Share>,
    /// Examined variants that it judges rightly; `None` if none were examined.
    pub variants: Option<Share>,
    /// The bracket of a search with a budget of nodes.
    pub bracket: Option<Bracket>,
}

/// Every way of searching one mechanism.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Trial {
    /// The mechanism.
    pub mechanism: String,
    /// The number of its variants.
    pub space: String,
    /// The true number of determinate variants; `None` if it is not known.
    pub determinate: Option<String>,
    /// The true number of admissible variants; `None` if it is not known.
    pub admissible: Option<String>,
    /// Variants examined one by one.
    pub looked_at: usize,
    /// Whether those are all.
    pub all_looked_at: bool,
    /// How many of the best are asked for.
    pub top: usize,
    /// How many variants the largest ranking scored; `None` without a ranking.
    pub ranked_by_pool: Option<usize>,
    /// Whether no other variant can win. Only then the best are judged.
    pub ranking_proven: Option<bool>,
    /// The results of each way.
    pub records: Vec<Record>,
}

impl Trial {
    /// Takes the true numbers of determinate and of admissible variants, and judges each bracket by the second.
    pub(crate) fn judge_brackets(&mut self, [determinate, admissible]: &[BigUint; 2]) {
        let truth = admissible.to_f64().unwrap_or(f64::INFINITY);
        for bracket in self.records.iter_mut().filter_map(|r| r.bracket.as_mut()) {
            let [least, most] = bracket.likely;
            bracket.holds = Some(least <= truth && truth <= most);
        }
        self.determinate = Some(determinate.to_string());
        self.admissible = Some(admissible.to_string());
    }
}

/// Returns a row for each mechanism and way. The keys are a stable contract, in this order.
pub(crate) fn trial_rows(trials: &[Trial]) -> Vec<Map<String, Value>> {
    let row = |t: &Trial, r: &Record| {
        let share = |s: Option<Share>| [s.map(|s| s.right), s.map(|s| s.of)];
        let [
            [counts_right, counts],
            [best_right, best],
            [variants_right, variants],
        ] = [r.counts, r.best, r.variants].map(share);
        let bounds = |of: fn(&Bracket) -> [f64; 2]| r.bracket.as_ref().map(of);
        let (certain, likely) = (bounds(|b| b.certain), bounds(|b| b.likely));
        let percent = likely.map(|[a, b]| 200.0 * (b - a) / (a + b).max(1.0));
        let all = json!({
            "mechanism": t.mechanism, "way": r.way.to_string(), "about": r.way.kind_and_text()[1],
            "counts_right": counts_right, "counts": counts, "best_right": best_right, "best": best,
            "variants_right": variants_right, "variants": variants,
            "median_seconds": r.counting.map(|t| t.median), "least_seconds": r.counting.map(|t| t.least),
            "most_seconds": r.counting.map(|t| t.most), "repeats": r.counting.map(|t| t.repeats),
            "by_proportion": r.by_proportion,
            "naming_median_seconds": r.naming.map(|t| t.median), "naming_least_seconds": r.naming.map(|t| t.least),
            "naming_most_seconds": r.naming.map(|t| t.most), "naming_repeats": r.naming.map(|t| t.repeats),
            "bracket_percent": percent,
            "least": certain.map(|c| c[0]), "most": certain.map(|c| c[1]),
            "likely_least": likely.map(|l| l[0]), "likely_most": likely.map(|l| l[1]),
            "likely_holds": r.bracket.and_then(|b| b.holds),
        });
        all.as_object().cloned().unwrap_or_default()
    };
    let rows = trials
        .iter()
        .flat_map(|t| t.records.iter().map(move |r| row(t, r)));
    rows.collect()
}

/// Returns the rows of some trials as CSV.
pub(crate) fn trials_csv(trials: &[Trial]) -> String {
    let rows = trial_rows(trials);
    let heads: Vec<&str> = rows
        .first()
        .map_or_else(Vec::new, |r| r.keys().map(String::as_str).collect());
    let text = |value: &Value| match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    };
    csv::write_table(
        &heads,
        rows.iter()
            .map(|row| row.values().map(text).collect::<Vec<_>>()),
    )
}

/// How much to do.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TrialEffort {
    /// Variants that brute force examines. A larger space is sampled. If 0, only budgets of nodes are compared.
    pub looked: usize,
    /// The pool that a ranking is judged by; `None` to go through all that could be among the best.
    pub pool: Option<usize>,
    /// Seconds after which no larger budget of nodes is tried.
    pub patience: f64,
}
