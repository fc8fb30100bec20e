//! Structures of a catalogue for people, and as data: the keys are the columns of the database.

use crate::catalog::store::{Store, StoreError};
use crate::format::plain::plain;
use crate::terms::PairWords;
use crate::view::catalog::query::{QueryAnswer, cell};
use crate::view::prelude::*;
use serde_json::Map;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

/// What a catalogue knows of a structure.
#[derive(Debug, Clone, serde::Serialize)]
pub struct StructureData {
    /// The row of `structures`, or of `drawn`.
    pub structure: Map<String, Value>,
    /// The row of `pairs`; `None` of one of hinges and a driver that slides in the frame.
    pub pairs: Option<Map<String, Value>>,
    /// The rows of `classics`: well-known schemes of this structure.
    pub classics: Vec<Map<String, Value>>,
    /// The row of `layouts`; `None` where it has no layout.
    pub layout: Option<Map<String, Value>>,
    /// The row of `strokes`; `None` where it has no layout.
    pub stroke: Option<Map<String, Value>>,
    /// The row of `planes`; `None` where it has no layout, or one that nothing is said of.
    pub planes: Option<Map<String, Value>>,
    /// The rows of `counts`.
    pub counts: Vec<Map<String, Value>>,
    /// The rows of `ideas`.
    pub ideas: Vec<Map<String, Value>>,
    /// The usual part that is such a joint, for each type that the ideas put in.
    pub hardware: BTreeMap<String, String>,
}

/// Returns the usual part that is a joint of each of some types, by the names that ideas have.
pub(crate) fn hardware<'a>(changes: impl Iterator<Item = &'a str>) -> BTreeMap<String, String> {
    let words = PairWords::builtin();
    let types = changes
        .flat_map(|c| c.split("; "))
        .filter_map(|c| c.split_once(" -> "));
    let part = |(_, to): (&str, &str)| {
        let pair = words.get(to.trim_end_matches("-y"))?;
        Some((to.to_owned(), pair.hardware.first()?.clone()))
    };
    types.filter_map(part).collect()
}

impl StructureData {
    /// Reads all that there is.
    ///
    /// # Errors
    /// Where the database cannot be read.
    pub fn read(store: &Store, id: &str) -> Result<StructureData, StoreError> {
        let maps = |sql: &str| -> Result<Vec<Map<String, Value>>, StoreError> {
            let (names, rows) = store.query(sql, Some(id))?;
            let map = |row: Vec<Value>| names.iter().cloned().zip(row).collect();
            Ok(rows.into_iter().map(map).collect())
        };
        let mut structure = maps("SELECT * FROM structures WHERE id = ?1")?;
        structure.extend(maps("SELECT * FROM drawn WHERE id = ?1")?);
        let ideas = maps("SELECT * FROM ideas WHERE structure = ?1 ORDER BY place")?;
        let changes = ideas.iter().filter_map(|i| i.get("changes")?.as_str());
        Ok(StructureData {
            hardware: hardware(changes),
            structure: structure.pop().unwrap_or_default(),
            pairs: maps("SELECT * FROM pairs WHERE structure = ?1")?.pop(),
            classics: maps("SELECT * FROM classics WHERE structure = ?1 ORDER BY id")?,
            layout: maps("SELECT * FROM layouts WHERE structure = ?1")?.pop(),
            stroke: maps("SELECT * FROM strokes WHERE structure = ?1")?.pop(),
            planes: maps("SELECT * FROM planes WHERE structure = ?1")?.pop(),
            counts: maps("SELECT * FROM counts WHERE structure = ?1 ORDER BY mobility, changes")?,
            ideas,
        })
    }
}

/// A value of a row for people; empty where there is none.
fn of<'a>(row: &'a Map<String, Value>) -> impl Fn(&str) -> String + 'a {
    move |key| row.get(key).map_or_else(String::new, cell)
}

/// The figures of a drawn mechanism.
fn drawn_text(row: &Map<String, Value>) -> String {
    let s = of(row);
    format!(
        "{}: {}, drawn ({})\n{}\n{}, {}, {}; driver: {}\nAs built: W = {}, σ = {}; finite mobility {}\n\
         Determinate variants ({}): {}, of these {} that keep the output motion and have no more mobility than that\n\n",
        s("id"),
        s("name"),
        s("mode"),
        s("description"),
        plural_of(&s("links"), "link"),
        plural_of(&s("joints"), "joint"),
        plural_of(&s("contours"), "contour"),
        s("input"),
        s("mobility"),
        s("redundant"),
        s("finite"),
        s("certainty"),
        s("determinate"),
        s("admissible"),
    )
}

/// What a layout does of its task; nothing of one that was made for none.
fn stroke_text(d: &StructureData) -> String {
    let Some(stroke) = &d.stroke else {
        return String::new();
    };
    let k = of(stroke);
    let does = match stroke.get("shortfall").and_then(Value::as_str) {
        None => "does all of it".to_owned(),
        Some(why) => plain(why).into_owned(),
    };
    format!(
        "Task: parts of {} to {} mm; {does}\n\
         Over the stroke: forces 1 : {}, worst transmission angle {}°, at most {} N in a joint for 1 N of each jaw, efficiency from {}, \
         a box of {} by {} mm; {} and {} mm more to the ends of the motion\n",
        k("narrowest"),
        k("widest"),
        k("force_ratio"),
        k("transmission"),
        k("pin_force"),
        k("efficiency"),
        k("width"),
        k("height"),
        k("margin_closing"),
        k("margin_opening"),
    )
}

/// In which planes the links pass each other.
fn planes_text(d: &StructureData) -> String {
    let Some(planes) = &d.planes else {
        return String::new();
    };
    let of = of(planes);
    if planes.get("planes").is_some_and(Value::is_null) {
        return "Over the stroke something meets in whatever planes the links lie\n".to_owned();
    }
    format!(
        "Over the stroke nothing meets in {} planes, links from the back: {}\n",
        of("planes"),
        of("links"),
    )
}

/// How many joints are no hinges, in brackets.
fn pairs_text(d: &StructureData) -> String {
    let Some(pairs) = &d.pairs else {
        return String::new();
    };
    let p = of(pairs);
    let kinds = ["slide", "gear", "slot"];
    let some = kinds.iter().map(|k| (k, p(&format!("{k}s"))));
    let some = some.filter(|(_, n)| n != "0");
    let threaded = of(&d.structure)("name").ends_with(" threaded");
    let word = |kind: &'static str| match kind {
        "gear" if threaded => "nut",
        _ => kind,
    };
    let words = some.map(|(kind, n)| plural_of(&n, word(kind))).join(", ");
    format!(" ({words})")
}

/// Whether a row tells of a third jaw.
fn third(row: &Map<String, Value>, key: &str) -> bool {
    row.get(key).is_some_and(|v| !v.is_null())
}

/// The figures of a structure with a layout, or why it has none.
fn structure_text(d: &StructureData) -> String {
    let s = of(&d.structure);
    let mut out = format!("{}: {}\n", s("id"), s("name"));
    for classic in &d.classics {
        let c = of(classic);
        let known = if third(&d.structure, "jaw_c") {
            "With two jaws known"
        } else {
            "Known"
        };
        let _ = writeln!(out, "{known} as {}: {}", c("id"), c("about"));
    }
    out += &make_up_text(d);
    let Some(layout) = &d.layout else {
        let _ = writeln!(out, "No layout: {}.", s("no_layout"));
        return out;
    };
    out += &motion_text(d, layout);
    out += &stroke_text(d);
    out += &planes_text(d);
    out += &shape_text(d, layout);
    out
}

/// What a structure is made of, how it is driven and which links are its jaws.
fn make_up_text(d: &StructureData) -> String {
    let s = of(&d.structure);
    let (jaws, both) = if third(&d.structure, "jaw_c") {
        (
            format!("{}, {} and {}", s("jaw_a"), s("jaw_b"), s("jaw_c")),
            " round the part",
        )
    } else {
        (format!("{} and {}", s("jaw_a"), s("jaw_b")), "")
    };
    format!(
        "{}, {}{}; frame {}, driver {} ({}{}), jaws {jaws}{both}, {} of them at the frame; laid out {}{}\n",
        plural_of(&s("links"), "link"),
        plural_of(&s("joints"), "joint"),
        pairs_text(d),
        s("frame"),
        s("driver"),
        s("input"),
        match &d.pairs {
            Some(p) if of(p)("driven_from") != s("frame") =>
                format!(" against {}", of(p)("driven_from")),
            _ => String::new(),
        },
        s("jaws_at_frame"),
        s("symmetry"),
        if s("parallel") == "1" {
            ", jaws on parallelograms"
        } else {
            ""
        },
    )
}

/// How a layout is constrained, how its jaws move and how hard they press.
fn motion_text(d: &StructureData, layout: &Map<String, Value>) -> String {
    let l = of(layout);
    let slide = of(&d.structure)("input") == "slide";
    let jaws = if third(layout, "jaw_c_motion") {
        format!(
            "{}, {} and {}",
            l("jaw_a_motion"),
            l("jaw_b_motion"),
            l("jaw_c_motion")
        )
    } else {
        format!("{} and {}", l("jaw_a_motion"), l("jaw_b_motion"))
    };
    format!(
        "As built: W = {}, σ = {}; finite mobility {}\n\
         Jaws: {jaws}, {} to {} mm apart for {} {} of the drive; they turn by {}° at most\n\
         Force of each jaw for {} of the drive, without friction: {} N ({} to {} over the stroke)\n",
        l("mobility"),
        l("redundant"),
        l("finite"),
        l("opening_min"),
        l("opening_max"),
        l("travel"),
        if slide { "mm" } else { "rad" },
        l("jaw_turn"),
        if slide { "1 N" } else { "1 Nm" },
        l("force_mean"),
        l("force_min"),
        l("force_max"),
    )
}

/// How a layout looks, and how many redesigns it has.
fn shape_text(d: &StructureData, layout: &Map<String, Value>) -> String {
    let l = of(layout);
    format!(
        "Drawn: links 1 : {}, worst transmission angle {}°, {} crossings\n\
         Determinate variants ({}): {}, of these {} with W = 1{}\n\n",
        l("link_ratio"),
        l("transmission"),
        l("crossings"),
        l("certainty"),
        l("determinate"),
        l("determinate_w1"),
        match of(&d.structure)("symmetry").as_str() {
            "generic" => String::new(),
            symmetry => format!(", {} up to {symmetry} images", l("orbits_w1")),
        },
    )
}

/// What a catalogue knows of a structure, for people.
#[must_use]
pub fn show_text(d: &StructureData, file: &Path, width: Option<u16>) -> String {
    let is_drawn = d.structure.contains_key("mechanism");
    let head = if is_drawn {
        drawn_text(&d.structure)
    } else {
        structure_text(d)
    };
    let head = fit(&head, width);
    if !is_drawn && d.layout.is_none() {
        return head;
    }
    let s = of(&d.structure);
    let heads = ["", "cost", "variants", "force", "moment", "changes"];
    let keys = [
        "place",
        "cost",
        "variants",
        "peak_force",
        "peak_moment",
        "changes",
    ];
    let row = |i: &Map<String, Value>| {
        keys.iter()
            .map(|k| i.get(*k).map_or_else(String::new, cell))
            .collect()
    };
    let searched = d.layout.as_ref().unwrap_or(&d.structure);
    let (found, least) = match searched.get("certainty").and_then(Value::as_str) {
        Some("exact") => ("", ""),
        _ => (" found", "at least "),
    };
    let ideas = match d.ideas.len() {
        0 => String::new(),
        n => {
            let which = if n == 1 {
                "The first idea".to_owned()
            } else {
                format!("The {n} first ideas, symmetric ones before others")
            };
            let line = format!(
                "{which}{found}; each represents {least}the given number of variants, and the first of these is exported:\n"
            );
            let ideas = table(&heads, d.ideas.iter().map(row).collect(), width);
            let mut parts = d.hardware.iter().map(|(to, part)| format!("{to}: {part}"));
            let parts = format!("\nHardware: {}\n", parts.join("; "));
            format!("{}\n{ideas}\n{}", fit(&line, width), fit(&parts, width))
        }
    };
    let next = format!(
        "\nThe mechanism, and with idea 1 carried out:\n\n  ozols catalog export {0} {1} -o gripper.toml\n  ozols catalog export {0} {1} --idea 1 -o redesign.toml\n",
        plain(&file.display().to_string()),
        s("id"),
    );
    head + &ideas + &next
}

/// What a catalogue holds, for whoever has just built it.
///
/// # Errors
/// Where the database cannot be read.
pub fn built_text(
    store: &Store,
    file: &Path,
    added: usize,
    what: &str,
    width: Option<u16>,
) -> Result<String, StoreError> {
    let (names, rows) = store.query(
        "SELECT links, input, symmetry || iif(parallel, ' parallel', '') AS layout, count(*) AS structures, \
         sum(no_layout IS NULL) AS 'laid out', sum(reached AND shortfall IS NULL) AS 'do the task', \
         sum(determinate_w1) AS 'determinate, W = 1', min(best_cost) AS 'least cost' \
         FROM structures s LEFT JOIN layouts l ON l.structure = id LEFT JOIN strokes k ON k.structure = id GROUP BY 1, 2, 3 \
         UNION ALL SELECT links, input, 'drawn', count(*), NULL, NULL, sum(admissible), min(best_cost) FROM drawn GROUP BY 1, 2 \
         ORDER BY 1, 2, 3",
        None,
    )?;
    let table = QueryAnswer { names, rows }.text(width);
    let n = grouped(added);
    let path = file.display().to_string();
    let path = plain(&path);
    Ok(format!(
        "{table}\n{n} {what} added to {path}. Go on with\n\n  ozols catalog query {path}\n  ozols catalog page {path} -o grippers.html\n"
    ))
}
