//! A search as data: the keys are a stable contract, in this order. Counts are strings, since they outgrow 2^53.

use crate::format::number::cost;
use crate::rank::measured::Verdicts;
use crate::score::outcome::Outcome;
use crate::score::request::LooksMeasured;
use crate::score::variant::Variant;
use crate::search::building::Diagrams;
use crate::search::certify::{Opinion, Summary};
use crate::search::diagram::Diagram;
use crate::search::over_stroke::OverStroke;
use crate::search::relax::Relaxation;
use crate::view::ranking::{RankedData, RankingData};
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
    by_mobility: By<'a, i64>,
    by_mobility_and_changes: ByBoth<'a>,
    by_redundant: By<'a, u32>,
    by_changes: By<'a, u32>,
    by_freedoms: By<'a, u32>,
    admissible: String,
    admissible_by_mobility: By<'a, i64>,
    admissible_by_mobility_and_changes: ByBoth<'a>,
    admissible_by_redundant: By<'a, u32>,
    admissible_by_changes: By<'a, u32>,
    admissible_by_freedoms: By<'a, u32>,
    admissible_by_cost: ByCost,
    largest_layer: Option<usize>,
    nodes: Option<usize>,
    determinate_diagram: Size,
    admissible_diagram: Size,
    stop: &'static str,
    check: Option<Check>,
    measured: Option<Measured<'a>>,
    poses: Option<Poses>,
    #[serde(skip_serializing_if = "Option::is_none")]
    ranking: Option<RankingData<'a>>,
    exact: bool,
}

#[derive(Debug, Serialize)]
struct Size {
    largest_layer: Option<usize>,
    nodes: Option<usize>,
}

#[derive(Debug, Serialize)]
struct Check {
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
    exact: Figures,
    svd: Figures,
    smallest_kept: f64,
    largest_dropped: f64,
}

#[derive(Debug, Serialize)]
struct Figures {
    mobility: usize,
    redundant: usize,
}

impl<'a> SearchData<'a> {
    /// Of an outcome.
    #[must_use]
    pub fn new(outcome: &'a Outcome) -> Self {
        let (determinate, admissible) = (&outcome.determinate, &outcome.admissible);
        let sizes = |of: fn(&Diagrams) -> &Diagram| {
            let diagram = outcome.diagrams.as_ref().map(of);
            Size {
                largest_layer: diagram.map(|d| d.largest_layer),
                nodes: diagram.map(|d| d.nodes),
            }
        };
        let (first, second) = (sizes(|d| &d.determinate), sizes(|d| &d.admissible));
        let mechanism = &outcome.search.mechanism;
        SearchData {
            mechanism: &mechanism.name,
            space: outcome.search.size().to_string(),
            determinate: determinate.to_string(),
            by_mobility: By(&determinate.by_mobility),
            by_mobility_and_changes: ByBoth(&determinate.by_mobility_and_changes),
            by_redundant: By(&determinate.by_redundant),
            by_changes: By(&determinate.by_changes),
            by_freedoms: By(&determinate.by_freedoms),
            admissible: admissible.to_string(),
            admissible_by_mobility: By(&admissible.by_mobility),
            admissible_by_mobility_and_changes: ByBoth(&admissible.by_mobility_and_changes),
            admissible_by_redundant: By(&admissible.by_redundant),
            admissible_by_changes: By(&admissible.by_changes),
            admissible_by_freedoms: By(&admissible.by_freedoms),
            admissible_by_cost: ByCost(outcome.admissible_by_cost()),
            largest_layer: first.largest_layer.max(second.largest_layer),
            nodes: first.nodes.zip(second.nodes).map(|(a, b)| a + b),
            determinate_diagram: first,
            admissible_diagram: second,
            stop: outcome.stop.word(),
            check: outcome.check.map(|c| Check {
                primes: c.primes.map(|p| p.to_string()),
                agree: c.agree(),
            }),
            measured: outcome.measured.as_ref().map(Measured::new),
            poses: outcome.stroke.as_ref().map(|s| Poses {
                asked: s.asked,
                reached: s.reached(),
            }),
            ranking: outcome
                .ranking
                .as_ref()
                .map(|p| RankingData::new(mechanism, p)),
            exact: outcome.is_exact(),
        }
    }
}

impl<'a> Measured<'a> {
    fn new((why, verdicts): &'a LooksMeasured) -> Self {
        let figures = |(mobility, redundant)| Figures {
            mobility,
            redundant,
        };
        let states = verdicts.iter().map(|v| Ranks {
            state: &v.state,
            exact: figures(v.figures(v.exact)),
            svd: figures(v.figures(v.numeric.rank)),
            smallest_kept: v.numeric.kept,
            largest_dropped: v.numeric.dropped,
        });
        Measured {
            coordinates: why.coordinates,
            example: Example {
                place: &why.place,
                value: &why.value,
            },
            tolerance: why.tolerance(),
            agree: verdicts.iter().all(Verdicts::agree),
            states: states.collect(),
        }
    }
}

/// What follows the variants.
#[derive(Debug, Serialize)]
pub struct TailData {
    variants_complete: bool,
    variants_checked: usize,
    variants_disagreeing: usize,
    variants_check_failed: usize,
    variants_posed: usize,
    variants_lucky: usize,
    variants_dropped: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    relaxations: Option<Vec<EasedData>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    seconds: Option<f64>,
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

impl TailData {
    /// `complete` unless the giving was interrupted; `eased` where nothing was found; `seconds` is how long all of it took.
    #[must_use]
    pub fn new(
        summary: &Summary,
        complete: bool,
        eased: Option<&[(Relaxation, BigUint)]>,
        seconds: Option<f64>,
    ) -> Self {
        let one = |(how, n): &(Relaxation, BigUint)| {
            let (condition, to) = condition(*how);
            EasedData {
                condition,
                to: to.map_or(Bound::Yes(true), Bound::Number),
                admissible: n.to_string(),
            }
        };
        TailData {
            variants_complete: complete,
            variants_checked: summary.checked,
            variants_disagreeing: summary.disagreeing,
            variants_check_failed: summary.failed,
            variants_posed: summary.posed,
            variants_lucky: summary.lucky,
            variants_dropped: summary.dropped,
            relaxations: eased.map(|list| list.iter().map(one).collect()),
            seconds,
        }
    }
}

/// The flag of a condition that was eased, and the number it is eased to.
pub(super) fn condition(how: Relaxation) -> (&'static str, Option<i64>) {
    match how {
        Relaxation::Redundant(n) => ("max-redundant", Some(i64::from(n))),
        Relaxation::External(n) => ("max-external", Some(i64::from(n))),
        Relaxation::Mobility(n) => ("max-mobility", Some(n)),
        Relaxation::Changes(n) => ("max-changes", Some(i64::from(n))),
        Relaxation::OutputChange => ("allow-output-change", None),
    }
}

/// One variant.
#[derive(Debug, Serialize)]
pub struct VariantData<'a> {
    position: usize,
    cost: Cost,
    mobility: i64,
    redundant: u32,
    external_redundant: Option<u32>,
    changes: Vec<ChangeData<'a>>,
    scores: ScoresData<'a>,
    conditioning: Option<f64>,
    agree: Option<bool>,
    svd: Option<Svd>,
    lucky: Option<bool>,
    stroke: Option<OtherPoses>,
}

#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Cost {
    Whole(i64),
    Part(f64),
}

#[derive(Debug, Serialize)]
struct ChangeData<'a> {
    joint: &'a str,
    from: String,
    to: String,
}

#[derive(Debug, Serialize)]
#[serde(untagged)]
enum ScoresData<'a> {
    Ranked(Box<RankedData<'a>>),
    Unranked {},
}

#[derive(Debug, Serialize)]
struct Svd {
    mobility: i64,
    redundant: i64,
    external_redundant: Option<i64>,
    output_mobility: Option<usize>,
    smallest_kept: f64,
    largest_dropped: f64,
}

#[derive(Debug, Serialize)]
struct OtherPoses {
    poses: usize,
    other: Option<OtherPose>,
}

#[derive(Debug, Serialize)]
struct OtherPose {
    mobility: i64,
    redundant: i64,
    output_mobility: Option<i64>,
    present_output_mobility: Option<i64>,
}

impl<'a> VariantData<'a> {
    /// Of a variant of an outcome.
    #[must_use]
    pub fn new(outcome: &'a Outcome, v: &Variant<'a>) -> Self {
        let mechanism = &outcome.search.mechanism;
        let opinion = v.second().opinion();
        let milli = v.cost_milli();
        VariantData {
            position: v.position(),
            cost: match milli % 1000 {
                0 => Cost::Whole(milli / 1000),
                _ => Cost::Part(v.cost()),
            },
            mobility: v.mobility(),
            redundant: v.redundant(),
            external_redundant: v.external_redundant(),
            changes: v
                .changes()
                .into_iter()
                .map(|c| ChangeData {
                    joint: &mechanism.joints[c.joint].id,
                    from: c.from,
                    to: c.to,
                })
                .collect(),
            scores: v.ranked().map_or(ScoresData::Unranked {}, |r| {
                ScoresData::Ranked(Box::new(RankedData::new(mechanism, r, v.reason())))
            }),
            conditioning: opinion.map(|o| o.conditioning),
            agree: opinion.map(|o| o.agree),
            svd: opinion.map(Svd::new),
            lucky: v.over_stroke().and_then(OverStroke::lucky),
            stroke: v.over_stroke().map(OtherPoses::new),
        }
    }
}

impl Svd {
    fn new(o: &Opinion) -> Svd {
        Svd {
            mobility: o.mobility,
            redundant: o.redundant,
            external_redundant: o.external,
            output_mobility: o.output,
            smallest_kept: o.conditioning,
            largest_dropped: o.dropped,
        }
    }
}

impl OtherPoses {
    fn new(s: &OverStroke) -> OtherPoses {
        OtherPoses {
            poses: s.poses,
            other: s.other.map(|(f, present)| OtherPose {
                mobility: f.mobility,
                redundant: f.redundant,
                output_mobility: f.output,
                present_output_mobility: present,
            }),
        }
    }
}
