//! A catalogue as one page: a card for each structure, with its drawing, to filter, sort and choose from.

use super::contents::escape_json;
use super::gripper::gripper_drawing;
use super::{POLICY, STYLE, with_policy};
use crate::catalog::store::{Store, StoreError};
use crate::file::text::mechanism_from_str;
use crate::robots::formats;
use crate::view::catalog::structures::{Row, query_maps, usual_hardware};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use maud::{DOCTYPE, PreEscaped, html};
use serde_json::{Value, json};
use std::collections::BTreeMap;

const CARDS: &str = include_str!("catalogue.css");
/// The script by idea, in the order it is run.
const SCRIPT: [&str; 9] = [
    include_str!("script/element.js"),
    include_str!("script/gripper.js"),
    include_str!("script/pairs.js"),
    include_str!("script/hull.js"),
    include_str!("script/motion.js"),
    include_str!("script/moving.js"),
    include_str!("script/saved.js"),
    include_str!("script/cards.js"),
    include_str!("script/structure.js"),
];

/// The columns of a card, without its drawing and its ideas.
const CARD: &str = "SELECT id, name, structures.links, input, symmetry, parallel, jaws_at_frame, truss, mechanism, crossings, link_ratio, \
     k.transmission, force_ratio, pin_force, efficiency, width, height, reached, shortfall, \
     b.planes, b.links AS in_planes, b.structure IS NOT NULL AS stacked, opening_min, opening_max, travel, closes, force_min, force_mean, force_max, jaw_a_motion, jaw_b_motion, jaw_c_motion, jaw_turn, ends_closing, \
     ends_opening, tip_a_dx, tip_a_dy, tip_b_dx, tip_b_dy, tip_c_dx, tip_c_dy, mobility, redundant, finite, CAST(determinate AS TEXT) AS determinate, \
     CAST(determinate_w1 AS TEXT) AS determinate_w1, certainty, best_cost, price, actuator, id IN (SELECT id FROM front) AS front, \
     (SELECT group_concat(c.id, ', ') FROM classics c WHERE c.structure = structures.id) AS classics FROM structures JOIN layouts l ON l.structure = id \
     JOIN (SELECT id AS gripper, price, actuator FROM grippers) ON gripper = id LEFT JOIN strokes k ON k.structure = id LEFT JOIN planes b ON b.structure = id ORDER BY k.reached = 1 AND k.shortfall IS NULL DESC, structures.links, symmetry = 'generic', parallel = 0, best_cost, crossings, transmission DESC, id";
/// Filters that are asked often: id, label, step and the greatest value.
const OFTEN: [(&str, &str, &str, &str); 6] = [
    ("force", "Jaw force at least (N per N, N per Nm)", "any", ""),
    (
        "ratio",
        "Maximum ratio of greatest to least jaw force",
        "0.5",
        "",
    ),
    ("transmission", "Transmission angle at least (°)", "5", "90"),
    ("turn", "Jaw rotation at most (°)", "5", ""),
    ("planes", "Maximum link planes", "1", ""),
    ("price", "Price at most (hinges)", "0.5", ""),
];
/// Filters that are asked less often.
const MORE: [(&str, &str, &str, &str); 8] = [
    ("pin", "Joint force at most (N per N)", "any", ""),
    ("efficiency", "Minimum efficiency", "0.05", "1"),
    ("stroke", "Opening stroke at least (mm)", "5", ""),
    ("travel", "Drive travel at most (mm, rad)", "any", ""),
    ("actuator", "Drive work at most (N mm)", "any", ""),
    ("width", "Width at most (mm)", "5", ""),
    ("height", "Height at most (mm)", "5", ""),
    ("cost", "Redesign cost at most (hinges)", "0.5", ""),
];
/// Grippers whose files and ideas are unpacked together.
const TOGETHER: usize = 64;
const IDEAS: &str = "SELECT structure, place, changes, cost, change_count AS changed, CAST(variants AS TEXT) AS variants, peak_force, \
     peak_moment FROM ideas ORDER BY structure, place";
const WITHOUT: &str = "SELECT no_layout AS why, count(*) AS n FROM structures WHERE no_layout IS NOT NULL GROUP BY 1 ORDER BY 2 DESC, 1";

/// Returns each structure with a layout: the data of its card, and its files and ideas,
/// which the page shows once it is chosen.
fn read_cards(store: &Store) -> Result<Vec<(Value, Value)>, StoreError> {
    let mut ideas: BTreeMap<String, Vec<Row>> = BTreeMap::new();
    for mut idea in query_maps(store, IDEAS, None)? {
        if let Some(Value::String(of)) = idea.remove("structure") {
            ideas.entry(of).or_default().push(idea);
        }
    }
    let mut cards = Vec::new();
    for mut card in query_maps(store, CARD, None)? {
        let text = card.remove("mechanism");
        let id = card.get("id").and_then(Value::as_str).unwrap_or_default();
        let of = ideas.remove(id).unwrap_or_default();
        let mechanism = text.as_ref().and_then(Value::as_str);
        let mechanism = mechanism.and_then(|m| mechanism_from_str("mechanism.toml", m).ok());
        let drawn = mechanism.as_ref().and_then(gripper_drawing);
        let mjcf = mechanism.and_then(|m| formats::write(&m, "mjcf").ok());
        let ideas: Value = of.into_iter().map(Value::Object).collect();
        card.insert("drawing".to_owned(), drawn.unwrap_or_default());
        let chosen = json!({ "mechanism": text, "mjcf": mjcf, "ideas": ideas });
        cards.push((Value::Object(card), chosen));
    }
    Ok(cards)
}

/// Returns a value deflated, in base64: the script unpacks it.
///
/// # Panics
/// Never: a list takes all that is written.
fn pack_values(value: &[Value]) -> String {
    let mut out = ZlibEncoder::new(Vec::new(), Compression::default());
    serde_json::to_writer(&mut out, value).expect("a list takes all");
    STANDARD.encode(out.finish().expect("a list takes all"))
}

/// Returns what the script is given, to stand in the page: the cards, apart from them what is unpacked once a card is chosen, and the
/// parts that are such joints as ideas put in.
fn script_data(
    file: &str,
    cards: Vec<(Value, Value)>,
    hardware: &BTreeMap<String, String>,
) -> String {
    let (cards, chosen): (Vec<Value>, Vec<Value>) = cards.into_iter().unzip();
    let chosen: Vec<String> = chosen.chunks(TOGETHER).map(pack_values).collect();
    let data = json!({
        "file": file,
        "together": TOGETHER,
        "cards": pack_values(&cards),
        "chosen": chosen,
        "hardware": hardware,
    });
    escape_json(&data.to_string())
}

fn left_out_table(without: &[Row]) -> maud::Markup {
    html! {
        details {
            summary { "Structures without a layout" }
            div.wide { table {
                thead { tr { th { "why" } th.n { "structures" } } }
                tbody { @for w in without { tr {
                    td { (w.get("why").and_then(Value::as_str).unwrap_or_default()) }
                    td.n { (w.get("n").and_then(Value::as_u64).unwrap_or_default()) }
                } } }
            } }
        }
    }
}

/// Writes the page of a catalogue. `file` is its name in the commands that use it.
///
/// # Errors
/// Returns an error if the database cannot be read.
///
/// # Complexity
/// A mechanism read for each structure.
pub fn catalogue_page(store: &Store, file: &str) -> Result<String, StoreError> {
    let cards = read_cards(store)?;
    let without = query_maps(store, WITHOUT, None)?;
    let left_out: u64 = without
        .iter()
        .filter_map(|w| w.get("n").and_then(Value::as_u64))
        .sum();
    let count = cards.len();
    let (_, changes) = store.query_rows("SELECT DISTINCT changes FROM ideas", None)?;
    let changes = changes.iter().filter_map(|row| row.first()?.as_str());
    let data = script_data(file, cards, &usual_hardware(changes));
    let title = "Grippers by structure";
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(STYLE)) (PreEscaped(CARDS)) }
            }
            body {
                a.skip href="#cards" { "To the grippers" }
                header {
                    h1 { (title) }
                    p.lead {
                        "Kinematic chains with a frame, a driver and jaws, each laid out and searched for the redesigns "
                        "without redundant constraints. Counts are of all joint assignments; costs are per joint changed."
                    }
                    p.meta { (count) " grippers from " code { (file) } @if left_out > 0 { "; " (left_out) " structures have no layout" } }
                }
                main {
                    noscript { p { "The cards need scripts; " code { "ozols catalog query " (file) } " lists the same." } }
                    (filter_form())
                    p.help {
                        "Green: driver and its closing direction. Blue: jaws. Red arrows: closing direction of the jaw tips. Dashed: the part. "
                        "Triangles on a line: hinges in the frame; a block between two lines: a slide on its guide; long and round: a slot; dashed and dotted: pitch circles."
                    }
                    p.note id="count" role="status" {}
                    ul id="cards" tabindex="-1" {}
                    p id="more" hidden { button type="button" { "Show more" } }
                    dialog id="chosen" aria-labelledby="chosen-name" {}
                    @if !without.is_empty() { (left_out_table(&without)) }
                }
                script id="data" type="application/json" { (PreEscaped(data)) }
                script { (PreEscaped(SCRIPT.concat())) }
            }
        }
    };
    Ok(with_policy(&page.into_string(), POLICY))
}

fn filter_form() -> maud::Markup {
    let select = |id: &str, label: &str, options: &[(&str, &str)]| {
        html! {
            label {
                (label) " "
                select id=(id) {
                    @for (value, word) in options { option value=(value) { (word) } }
                }
            }
        }
    };
    let number = |(id, label, step, most): &(&str, &str, &str, &str)| {
        html! {
            label { (label) " " input type="number" id=(id) min="0" max=[Some(most).filter(|m| !m.is_empty())] step=(step) inputmode="decimal"; }
        }
    };
    html! {
        form id="filters" aria-label="Filter the grippers" {
            label { input type="checkbox" id="does"; " Does the task" }
            label { "Number of links " select id="links" { option value="" { "all" } } }
            (select("input", "Driver", &[("", "all"), ("slide", "slides"), ("turn", "turns")]))
            (select("symmetry", "Symmetry", &[("", "all"), ("mirror", "mirror image"), ("half-turn", "half turn"), ("threefold", "threefold"), ("generic", "generic")]))
            (select("sides", "Number of jaws", &[("", "all"), ("2", "2"), ("3", "3")]))
            (select("jaws", "Jaw motion", &[("", "all"), ("parallel", "parallel"), ("swinging", "swinging"), ("floating", "floating")]))
            @for one in &OFTEN { (number(one)) }
            details {
                summary { "More filters" }
                @for one in &MORE { (number(one)) }
                label { input type="checkbox" id="front"; " Best compromises: no other gripper is as good in every figure and better in one" }
            }
            label { "Search " input type="search" id="find" autocomplete="off" spellcheck="false" placeholder="scheme, id or chain"; }
            (select("sort", "Sort by", &[
                ("", "task done, fewest links"), ("force_min", "greatest jaw force"), ("transmission", "best transmission angle"), ("pin_force", "least joint force"),
                ("jaw_turn", "least jaw rotation"), ("price", "lowest price"), ("best_cost", "cheapest redesign"), ("determinate_w1", "most redesigns"),
                ("actuator", "least drive work"), ("planes", "fewest link planes"), ("link_ratio", "most equal link lengths"),
            ]))
            button type="reset" { "Show all" }
        }
    }
}
