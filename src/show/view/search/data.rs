//! A search as data: the keys are a stable contract, in this order. Counts are strings, since they outgrow 2^53.

use crate::format::cost;
use crate::model::mechanism::{JointId, Mechanism};
use crate::rank::rounded::verdict::RankVerdict;
use crate::score::outcome::Outcome;
use crate::score::outcome::listing::Variants;
use crate::score::outcome::symmetric::SymmetricBest;
use crate::score::request::prepare::LooksRounded;
use crate::search::answer::why_none::{Hopeless, Relaxation};
use crate::search::build::Diagrams;
use crate::search::diagram::{Diagram, Stop};
use crate::view::search::numeric::NumericData;
use crate::view::search::ranking::RankingData;
use crate::view::search::second_opinion::{SecondOpinionData, certainty};
use crate::view::search::stopped_early::EstimateData;
use crate::view::search::variant::{self, SymmetricData};
use num_bigint::BigUint;
use serde::{Serialize, Serializer};
use std::collections::BTreeMap;

/// Counts by a property.
#[derive(Debug)]
struct By<'a, K>(&'a BTreeMap<K, BigUint>);

impl<K: Serialize> Serialize for By<'_, K> {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        s.collect_map(self.0.iter().map(|(k, n)| (k, n.to_string())))
    }
}

/// Counts by W, each by number of changes.
#[derive(Debug)]
struct ByBoth<'a>(&'a BTreeMap<(i64, u32), BigUint>);

impl Serialize for ByBoth<'_> {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        let mut nested: BTreeMap<i64, BTreeMap<u32, String>> = BTreeMap::new();
        for ((w, c), n) in self.0 {
            nested.entry(*w).or_default().insert(*c, n.to_string());
        }
        nested.serialize(s)
    }
}

/// Counts by cost, the cheapest first.
#[derive(Debug)]
struct ByCost(BTreeMap<i64, BigUint>);

impl Serialize for ByCost {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        s.collect_map(self.0.iter().map(|(c, n)| (cost(*c), n.to_string())))
    }
}

/// Everything but the variants.
#[derive(Debug, Serialize)]
pub struct SearchData<'a> {
    mechanism: &'a str,
    space: String,
    determinate: String,
    determinate_exact: bool,
    determinate_estimate: Option<EstimateData>,
    by_mobility: By<'a, i64>,
    by_mobility_and_changes: ByBoth<'a>,
    by_redundant: By<'a, u32>,
    by_changes: By<'a, u32>,
    by_freedoms: By<'a, u32>,
    admissible: String,
    admissible_estimate: Option<EstimateData>,
    admissible_by_mobility: By<'a, i64>,
    admissible_by_mobility_and_changes: ByBoth<'a>,
    admissible_by_redundant: By<'a, u32>,
    admissible_by_changes: By<'a, u32>,
    admissible_by_freedoms: By<'a, u32>,
    admissible_by_cost: ByCost,
    /// Those of them that keep the motion throughout the motion of the mechanism as built, which are the ones listed; `None` where
    /// it is not followed.
    lasting: Option<String>,
    lasting_by_mobility: Option<By<'a, i64>>,
    lasting_by_cost: Option<ByCost>,
    /// Why it is not followed.
    pose_only: Option<String>,
    /// Variants among those listed of which no other has part of the freedoms, where these are counted.
    minimal: Option<String>,
    largest_layer: Option<usize>,
    nodes: Option<usize>,
    /// Rows of the closure equations for each contour; a list of one number.
    rows_per_contour: Option<[usize; 1]>,
    determinate_diagram: SizeData,
    admissible_diagram: SizeData,
    stop: &'static str,
    check: Option<CheckData>,
    measured: Option<Measured<'a>>,
    poses: Option<Poses>,
    ranking: Option<RankingData<'a>>,
    exact: bool,
    /// What the reader of the file took for granted or left out.
    assumptions: &'a [String],
    /// How sure counts are that are not exact, and not cut short.
    certainty: Option<&'static str>,
    numeric: Option<NumericData>,
    second_opinion: Option<SecondOpinionData>,
    /// Counts that would take more than the memory allowed.
    left_out: Vec<&'static str>,
}

#[derive(Debug, Serialize)]
struct SizeData {
    largest_layer: Option<usize>,
    nodes: Option<usize>,
}

#[derive(Debug, Serialize)]
struct CheckData {
    primes: [String; 2],
    agree: Option<bool>,
}

#[derive(Debug, Serialize)]
struct Poses {
    asked: usize,
    reached: usize,
}

#[derive(Debug, Serialize)]
struct Measured<'a> {
    coordinates: usize,
    example: Example<'a>,
    tolerance: f64,
    agree: bool,
    states: Vec<Ranks<'a>>,
}

#[derive(Debug, Serialize)]
struct Example<'a> {
    place: &'a str,
    value: &'a str,
}

#[derive(Debug, Serialize)]
struct Ranks<'a> {
    state: &'a str,
    exact: FiguresData,
    svd: FiguresData,
    smallest_kept: f64,
    largest_dropped: f64,
    /// Which mechanism is meant, and so searched: "as written", "snapped", "near", "undecided".
    meant: &'static str,
}

#[derive(Debug, Serialize)]
struct FiguresData {
    mobility: usize,
    redundant: usize,
}

impl SizeData {
    fn new(diagram: Option<&Diagram>) -> SizeData {
        SizeData {
            largest_layer: diagram.map(|d| d.largest_layer),
            nodes: diagram.map(|d| d.nodes),
        }
    }
}

impl CheckData {
    fn new(outcome: &Outcome) -> Option<CheckData> {
        outcome.check.map(|c| CheckData {
            primes: c.primes.map(|p| p.to_string()),
            // Two primes that agree on rounded digits prove nothing.
            agree: c.agree().filter(|_| outcome.is_confirmed()),
        })
    }
}

impl<'a> SearchData<'a> {
    /// Of an outcome.
    #[must_use]
    pub fn new(outcome: &'a Outcome) -> Self {
        let (determinate, admissible) = (&outcome.determinate, &outcome.admissible);
        let sizes =
            |of: fn(&Diagrams) -> &Diagram| SizeData::new(outcome.diagrams.as_ref().map(of));
        let estimates = outcome.estimates();
        let by_cost = outcome.admissible_by_cost();
        let left_out = [
            (determinate.only_total || admissible.only_total).then_some("counts by kind"),
            by_cost.is_none().then_some("counts by cost"),
        ];
        let (first, second) = (sizes(|d| &d.determinate), sizes(|d| &d.admissible));
        let mechanism = &outcome.search.mechanism;
        let lasting = outcome.lasting.as_ref().ok();
        SearchData {
            mechanism: &mechanism.name,
            space: outcome.search.size().to_string(),
            determinate: determinate.to_string(),
            determinate_exact: outcome.is_determinate_exact(),
            determinate_estimate: estimates[0].map(EstimateData::from),
            by_mobility: By(&determinate.by_mobility),
            by_mobility_and_changes: ByBoth(&determinate.by_mobility_and_changes),
            by_redundant: By(&determinate.by_redundant),
            by_changes: By(&determinate.by_changes),
            by_freedoms: By(&determinate.by_freedoms),
            admissible: admissible.to_string(),
            admissible_estimate: estimates[1].map(EstimateData::from),
            admissible_by_mobility: By(&admissible.by_mobility),
            admissible_by_mobility_and_changes: ByBoth(&admissible.by_mobility_and_changes),
            admissible_by_redundant: By(&admissible.by_redundant),
            admissible_by_changes: By(&admissible.by_changes),
            admissible_by_freedoms: By(&admissible.by_freedoms),
            admissible_by_cost: ByCost(by_cost.unwrap_or_default()),
            lasting: lasting.map(ToString::to_string),
            lasting_by_mobility: lasting.map(|l| By(&l.by_mobility)),
            lasting_by_cost: outcome.lasting_by_cost().map(ByCost),
            pose_only: outcome.lasting.as_ref().err().map(ToString::to_string),
            minimal: outcome.minimal().map(|n| n.to_string()),
            largest_layer: first.largest_layer.max(second.largest_layer),
            nodes: first.nodes.zip(second.nodes).map(|(a, b)| a + b),
            rows_per_contour: outcome.diagrams.as_ref().map(|d| [d.rows_per_contour]),
            determinate_diagram: first,
            admissible_diagram: second,
            stop: outcome.stop.word(),
            check: CheckData::new(outcome),
            measured: outcome.measured.as_ref().map(Measured::new),
            poses: outcome.stroke.as_ref().map(|s| Poses {
                asked: s.asked,
                reached: s.reached(),
            }),
            ranking: outcome
                .ranking
                .as_ref()
                .map(|p| RankingData::new(mechanism, p)),
            exact: outcome.is_exact() && mechanism.assumed.is_empty(),
            assumptions: &mechanism.assumed,
            certainty: certainty(outcome),
            numeric: outcome.numeric.as_ref().map(NumericData::new),
            second_opinion: SecondOpinionData::new(outcome),
            left_out: left_out.into_iter().flatten().collect(),
        }
    }
}

impl<'a> Measured<'a> {
    fn new(rounded: &'a LooksRounded) -> Self {
        let (why, verdicts) = rounded;
        let figures = |(mobility, redundant)| FiguresData {
            mobility,
            redundant,
        };
        let states = verdicts.iter().map(|v| Ranks {
            state: &v.state,
            exact: figures(v.figures(v.as_written)),
            svd: figures(v.figures(v.at_least())),
            smallest_kept: v.numeric.unwrap_or_default().kept,
            largest_dropped: v.numeric.unwrap_or_default().dropped,
            meant: v.word(),
        });
        Measured {
            coordinates: why.coordinates,
            example: Example {
                place: &why.place,
                value: &why.value,
            },
            tolerance: verdicts.iter().fold(0.0, |a, v| a.max(v.tolerance)),
            agree: verdicts.iter().all(RankVerdict::agrees),
            states: states.collect(),
        }
    }
}

/// What follows the variants.
#[derive(Debug, Serialize)]
pub(crate) struct TailData<'a> {
    variants_complete: bool,
    variants_stop: Option<&'static str>,
    /// How many, from the first on, are proven to be the cheapest, where the search ended early.
    variants_proven: Option<usize>,
    variants_checked: usize,
    variants_disagreeing: usize,
    variants_check_failed: usize,
    variants_posed: usize,
    variants_lucky: usize,
    #[serde(flatten)]
    none: Option<NoneData<'a>>,
    /// Of a symmetric mechanism the cheapest symmetric redesign for each number of redundant constraints left.
    symmetric: Option<Vec<SymmetricData<'a>>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    seconds: Option<f64>,
}

/// Where there is no variant: what easing would leave, and what stands in the way of all.
#[derive(Debug, Serialize)]
pub(crate) struct NoneData<'a> {
    relaxations: Vec<EasedData>,
    least_redundant: Option<usize>,
    unchanged: Vec<&'a str>,
    frozen: Vec<&'a str>,
}

impl<'a> NoneData<'a> {
    /// Of an outcome without variants.
    #[must_use]
    pub(crate) fn new(m: &'a Mechanism, eased: &[(Relaxation, BigUint)], why: &Hopeless) -> Self {
        let one = |(how, n): &(Relaxation, BigUint)| {
            let (condition, to) = condition(*how);
            EasedData {
                condition,
                to: to.map_or(Bound::Yes(true), Bound::Number),
                admissible: n.to_string(),
            }
        };
        let named = |joints: &[JointId]| {
            let ids = joints.iter().map(|&j| m.joints[j].id.as_str());
            ids.collect()
        };
        NoneData {
            relaxations: eased.iter().map(one).collect(),
            least_redundant: why.least_redundant,
            unchanged: named(&why.unchanged),
            frozen: named(&why.frozen),
        }
    }
}

#[derive(Debug, Serialize)]
struct EasedData {
    condition: &'static str,
    to: Bound,
    admissible: String,
}

#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Bound {
    Number(i64),
    Yes(bool),
}

impl<'a> TailData<'a> {
    /// Of variants that were given, as far as it went; `seconds` is how long all of it took.
    #[must_use]
    pub(crate) fn new(
        variants: &Variants<'_>,
        none: Option<NoneData<'a>>,
        symmetric: Option<&'a SymmetricBest>,
        seconds: Option<f64>,
    ) -> Self {
        let summary = variants.summary();
        let stop = variants.cut_short();
        TailData {
            variants_complete: stop.is_none(),
            variants_stop: stop.map(Stop::word),
            variants_proven: summary.proven,
            variants_checked: summary.checked,
            variants_disagreeing: summary.disagreeing,
            variants_check_failed: summary.failed,
            variants_posed: summary.posed,
            variants_lucky: summary.lucky,
            none,
            symmetric: symmetric.map(variant::symmetric_data),
            seconds,
        }
    }
}

/// The last of some JSON lines, where the variants are not all that was asked for.
#[derive(Debug, Serialize)]
pub(crate) struct EndData {
    stop: &'static str,
    given: usize,
    proven: usize,
    admissible: String,
    admissible_exact: bool,
    certainty: Option<&'static str>,
    numeric: Option<NumericData>,
}

impl EndData {
    /// Of variants that were given, as far as it went.
    #[must_use]
    pub(crate) fn new(outcome: &Outcome, variants: &Variants<'_>) -> Self {
        EndData {
            stop: variants.stop().word(),
            given: variants.summary().given,
            proven: variants.summary().proven.unwrap_or(0),
            admissible: outcome.admissible.to_string(),
            admissible_exact: outcome.is_exact() && outcome.search.mechanism.assumed.is_empty(),
            certainty: certainty(outcome),
            numeric: outcome.numeric.as_ref().map(NumericData::new),
        }
    }
}

/// The flag of a condition that was eased, and the number it is eased to.
pub(in crate::view) fn condition(how: Relaxation) -> (&'static str, Option<i64>) {
    match how {
        Relaxation::Redundant(n) => ("max-redundant", Some(i64::from(n))),
        Relaxation::External(n) => ("max-external", Some(i64::from(n))),
        Relaxation::Harmful(n) => ("max-harmful", Some(i64::from(n))),
        Relaxation::Mobility(n) => ("max-mobility", Some(n)),
        Relaxation::Changes(n) => ("max-changes", Some(i64::from(n))),
        Relaxation::OutputChange => ("allow-output-change", None),
        Relaxation::FreeDrives => ("drives", None),
        Relaxation::LooseObject => ("allow-loose-object", None),
    }
}
