//! A variant as data, by the same contract as the search it is of, and the cheapest symmetric redesigns for people and as data.

use crate::model::joint_type::JointType;
use crate::model::mechanism::CostSpec;
use crate::redundancy::contour_shares::ContourShare;
use crate::score::outcome::symmetric::{SymmetricBest, SymmetricRedesign};
use crate::score::outcome::variant::Change;
use crate::search::answer::ideas::freedom_patterns;
use crate::search::check::other_poses::{Figures, OverStroke};
use crate::search::question::cost::CostTable;
use crate::terms::PairWords;
use crate::view::prelude::*;
use crate::view::search::ranking;
use serde::ser::{Serialize, SerializeMap, Serializer};

/// One variant of an outcome, written key by key, since there may be millions.
#[derive(Debug)]
pub struct VariantData<'a, 'v> {
    pub(super) outcome: &'a Outcome,
    pub(super) variant: &'a Variant<'v>,
    /// Why it helps, where it is an idea and that was asked.
    pub(super) why: Option<Value>,
}

impl Serialize for VariantData<'_, '_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (outcome, v) = (self.outcome, self.variant);
        let mechanism = &outcome.search.mechanism;
        let opinion = v.second().opinion();
        // With the range over all orders of these contours.
        let contour = |(contour, share): (String, ContourShare)| {
            let (least, greatest) = share.range;
            json!({ "contour": contour, "redundant": share.redundant, "least": least, "greatest": greatest })
        };
        let contours = v.redundant_by_contour().into_iter().flatten();
        let idea = v.idea().map(|i| {
            json!({
                "variants": i.variants.to_string(),
                "symmetric": i.symmetric,
                "exact": outcome.is_exact(),
                "adds": freedom_patterns::in_words(mechanism, &i.added),
                "why": self.why,
            })
        });
        let scores = v
            .ranked()
            .map(|r| ranking::scores_json(mechanism, r, v.place_reason()));
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("position", &v.position())?;
        map.serialize_entry("cost", &price_json(v.cost_milli()))?;
        map.serialize_entry("mobility", &v.mobility())?;
        map.serialize_entry("redundant", &v.redundant())?;
        map.serialize_entry("external_redundant", &v.external_redundant())?;
        map.serialize_entry("external_harmful", &v.external_harmful())?;
        map.serialize_entry("per_contour", &contours.map(contour).collect::<Value>())?;
        map.serialize_entry("changes", &changes_json(mechanism, v.list_changes()))?;
        map.serialize_entry("idea", &idea)?;
        map.serialize_entry("scores", &scores.unwrap_or(json!({})))?;
        map.serialize_entry("conditioning", &opinion.map(|o| o.conditioning))?;
        map.serialize_entry("agree", &opinion.map(|o| o.agree))?;
        map.serialize_entry("svd", &opinion)?;
        map.serialize_entry("lucky", &v.over_stroke().and_then(OverStroke::is_lucky))?;
        map.serialize_entry("stroke", &v.over_stroke().map(other_poses))?;
        map.end()
    }
}

fn other_poses(s: &OverStroke) -> Value {
    let other = |(f, present): (Figures, Option<i64>)| {
        json!({
            "mobility": f.mobility,
            "redundant": f.redundant,
            "output_mobility": f.output,
            "present_output_mobility": present,
        })
    };
    json!({ "poses": s.poses, "other": s.other.map(other) })
}

/// Returns a cost given in thousandths.
#[allow(clippy::cast_precision_loss, reason = "costs are small")]
pub(crate) fn price_json(milli: i64) -> Value {
    match milli % 1000 {
        0 => json!(milli / 1000),
        _ => json!(milli as f64 / 1000.0),
    }
}

/// Returns changes of a mechanism as data.
fn changes_json(m: &Mechanism, changes: Vec<Change>) -> Value {
    let one =
        |Change { joint, from, to }| json!({ "joint": m.joints[joint].id, "from": from, "to": to });
    changes.into_iter().map(one).collect()
}

/// Returns a line for each number of redundant constraints left, under a heading.
pub(crate) fn symmetric_text(found: &SymmetricBest) -> String {
    let lines = symmetric_lines(found).into_iter();
    let lines: String = lines.map(|l| format!("    {l}\n")).collect();
    format!("\n  the cheapest symmetric redesign for each σ left:\n{lines}")
}

/// Returns these lines.
pub fn symmetric_lines(found: &SymmetricBest) -> Vec<String> {
    let SymmetricBest { best, odd } = found;
    let line = |one: &SymmetricRedesign| {
        let SymmetricRedesign {
            left,
            search,
            variant: v,
        } = one;
        let price = format_cost(search.steps.cost_in_milli(v.key.cost()));
        let (w, words) = (
            search.mobility(v.key),
            in_words(search, &list_changes(search, v)),
        );
        let by = symmetry_word(search);
        format!("σ = {left}: cost {price}, W = {w}, {words} ({by})")
    };
    let mut out = best.iter().map(line).collect_vec();
    if best.is_empty() {
        out.push("none with the options offered and at most 2 redundant constraints".to_owned());
    }
    if let Some(odd) = odd {
        out.push(format!(
            "none has σ = 0 without idle motion: that takes {} more freedoms, and joints that are images of each other gain them {} at a time",
            odd.needed, odd.at_a_time
        ));
    }
    out
}

/// Returns what carries a mechanism over to itself.
fn symmetry_word(search: &Search) -> String {
    let spec = &search.mechanism.search;
    let word = match (spec.mirror.is_empty(), spec.symmetry_order()) {
        (false, _) => "mirror",
        (true, 3) => "third of a turn",
        _ => "half turn",
    };
    let digits = if spec.nearly_symmetric {
        ", within the digits of the file"
    } else {
        ""
    };
    format!("{word}{digits}")
}

/// Returns the cheapest symmetric redesigns as data.
pub(crate) fn symmetric_data(found: &SymmetricBest) -> Value {
    let one = |one: &SymmetricRedesign| {
        let SymmetricRedesign {
            left,
            search,
            variant: v,
        } = one;
        json!({
            "redundant": left,
            "by": symmetry_word(search),
            "cost": price_json(search.steps.cost_in_milli(v.key.cost())),
            "mobility": search.mobility(v.key),
            "changes": changes_json(&search.mechanism, list_changes(search, v)),
        })
    };
    found.best.iter().map(one).collect()
}

const HEAD: &str = include_str!("costs.toml");

/// Returns the default costs as TOML.
///
/// # Examples
/// ```
/// use ozols::{file::read::search::costs_from_str, view::search::variant::costs_toml};
/// // The default costs are a file that can be changed and read back.
/// let four_bar = ozols::built_in("four-bar")?;
/// assert!(costs_from_str("costs.toml", &costs_toml(), &four_bar).is_ok());
/// # Ok::<(), ozols::Error>(())
/// ```
pub fn costs_toml() -> String {
    let table = CostTable::new(&CostSpec::default());
    let line = |name: &str, milli: i64, what: &str| {
        format!("\n# {what}\n{name} = {}\n", format_cost(milli))
    };
    let words = PairWords::builtin();
    let types = JointType::NAMED.iter().map(|t| {
        let about = words.get(t.name()).map_or("", |w| w.about.as_str());
        let short = about.split([':', '.']).next().unwrap_or(about);
        let what = format!("class {}: {short}", t.class_numeral());
        line(t.name(), t.default_cost_milli(), &what)
    });
    let others = [
        ("change", table.change, "changing a joint at all"),
        (
            "driven",
            table.driven,
            "changing a driven joint, in addition: the motor needs a new mount and guide",
        ),
        ("link", table.link, "the extra link of a joint in series"),
        (
            "harmful",
            table.harmful,
            "each redundant constraint that loads clamping faces in a searched state",
        ),
    ];
    let others = others.map(|(name, milli, what)| line(name, milli, what));
    let classes = JointType::CLASSES.chunks(4).map(|c| c.join(", "));
    let head = HEAD
        .replace("CUSTOM", &format_cost(JointType::CUSTOM_FREEDOM))
        .replace(
            "CLASSES",
            &format!("\n# {}", classes.collect::<Vec<_>>().join(",\n# ")),
        );
    head + &others.concat() + &types.collect::<String>()
}
