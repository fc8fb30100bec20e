//! Structures of a catalogue for people, and as data: the keys are the columns of the database.

use crate::catalog::store::{Store, StoreError};
use crate::format::plain::escape_control;
use crate::terms::PairWords;
use crate::view::catalog::query::{QueryAnswer, format_value};
use crate::view::prelude::*;
use serde_json::Map;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::Path;

/// A row of a table by its columns.
pub(crate) type Row = Map<String, Value>;

/// Returns the rows of an answer in SQL, which may be about a structure.
pub(crate) fn query_maps(
    store: &Store,
    sql: &str,
    id: Option<&str>,
) -> Result<Vec<Row>, StoreError> {
    let (names, rows) = store.query_rows(sql, id)?;
    let map = |row: Vec<Value>| names.iter().cloned().zip(row).collect();
    Ok(rows.into_iter().map(map).collect())
}

/// Rows of a catalogue about a structure.
#[derive(Debug, Clone, serde::Serialize)]
pub struct StructureData {
    /// The row of `structures`.
    pub structure: Row,
    /// The row of `pairs`; `None` of one of hinges and a driver that slides in the frame.
    pub pairs: Option<Row>,
    /// The rows of `classics`: well-known schemes of this structure.
    pub classics: Vec<Row>,
    /// The row of `layouts`; `None` where it has no layout.
    pub layout: Option<Row>,
    /// The row of `strokes`; `None` where it has no layout.
    pub stroke: Option<Row>,
    /// The row of `planes`; `None` without a layout, or if no planes are known.
    pub planes: Option<Row>,
    /// The rows of `counts`.
    pub counts: Vec<Row>,
    /// The rows of `ideas`.
    pub ideas: Vec<Row>,
    /// The usual part that is such a joint, for each type that the ideas put in.
    pub hardware: BTreeMap<String, String>,
}

/// Returns the usual part that is a joint of each of some types, by the names that ideas have.
pub(crate) fn usual_hardware<'a>(
    changes: impl Iterator<Item = &'a str>,
) -> BTreeMap<String, String> {
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
    /// Returns an error if the database cannot be read.
    pub fn read_structure(store: &Store, id: &str) -> Result<StructureData, StoreError> {
        let maps = |sql: &str| query_maps(store, sql, Some(id));
        let mut structure = maps("SELECT * FROM structures WHERE id = ?1")?;
        let ideas = maps("SELECT * FROM ideas WHERE structure = ?1 ORDER BY place")?;
        let changes = ideas.iter().filter_map(|i| i.get("changes")?.as_str());
        Ok(StructureData {
            hardware: usual_hardware(changes),
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

/// Returns a value of a row for people; empty if there is none.
fn cell_of(row: &Row, key: &str) -> String {
    row.get(key).map_or_else(String::new, format_value)
}

/// Returns a template with each `{key}` replaced by the value of a row.
fn fill_template(template: &str, row: &Row) -> String {
    let mut parts = template.split('{');
    let first = parts.next().unwrap_or_default().to_owned();
    let rest = parts.filter_map(|part| part.split_once('}'));
    rest.fold(first, |out, (key, more)| out + &cell_of(row, key) + more)
}

/// Returns true if a row has a value.
fn has_value(row: &Row, key: &str) -> bool {
    row.get(key).is_some_and(|v| !v.is_null())
}

/// Returns a text of a row that says why something is not done, if there is one.
fn text_of<'a>(row: &'a Row, key: &str) -> Option<Cow<'a, str>> {
    row.get(key).and_then(Value::as_str).map(escape_control)
}

const STROKE: &str = "Over the stroke: force ratio {force_ratio}, smallest transmission angle {transmission}°, \
largest joint force {pin_force} N for 1 N at each jaw, efficiency at least {efficiency}, bounding box {width} x {height} mm; \
{margin_closing} and {margin_opening} mm left to the ends of the motion\n";

impl StructureData {
    /// Returns the verdict, a sentence: whether it is statically determinate as built, and whether it fulfils its task.
    fn verdict_line(&self) -> String {
        let id = cell_of(&self.structure, "id");
        let row = match &self.layout {
            Some(layout) => layout,
            None => {
                return format!(
                    "{id}: no layout, {}\n",
                    cell_of(&self.structure, "no_layout")
                );
            }
        };
        let sigma = match &*cell_of(row, "redundant") {
            "0" => "statically determinate".to_owned(),
            n => plural_of(n, "redundant constraint"),
        };
        let task = match self.stroke.as_ref().map(|s| text_of(s, "shortfall")) {
            None => "",
            Some(None) => "; it fulfils its task",
            Some(Some(_)) => "; it does not fulfil its task",
        };
        format!(
            "{id}: {sigma} as built, W = {}{task}\n",
            cell_of(row, "mobility")
        )
    }

    /// Returns the figures of a structure with a layout, or what it is made of.
    fn structure_text(&self) -> String {
        let known = if has_value(&self.structure, "jaw_c") {
            "With two jaws known"
        } else {
            "Known"
        };
        let classic = |c| format!("{known} as {}", fill_template("{id}: {about}\n", c));
        let classics = self.classics.iter().map(classic);
        let mut out = fill_template("Structure: {name}\n", &self.structure)
            + &classics.collect::<String>()
            + &self.make_up_text();
        let Some(layout) = &self.layout else {
            return out;
        };
        out += &self.motion_text(layout);
        if let Some(stroke) = &self.stroke {
            let task = fill_template("Task: parts of {narrowest} to {widest} mm; ", stroke);
            let does = text_of(stroke, "shortfall").unwrap_or("does all of it".into());
            out += &format!("{task}{does}\n{}", fill_template(STROKE, stroke));
        }
        out += &match &self.planes {
            None => String::new(),
            Some(of) if !has_value(of, "planes") => {
                "Links collide over the stroke in every set of planes\n".to_owned()
            }
            Some(of) => fill_template(
                "No collisions over the stroke with the links in {planes} planes (back to front: {links})\n",
                of,
            ),
        };
        out + &self.shape_text(layout)
    }

    /// Returns the number of joints that are not hinges, in brackets.
    fn pairs_text(&self) -> String {
        let Some(pairs) = &self.pairs else {
            return String::new();
        };
        let threaded = cell_of(&self.structure, "name").ends_with(" threaded");
        let kinds = ["slide", "gear", "slot"].into_iter();
        let some = kinds.map(|k| (k, cell_of(pairs, &format!("{k}s"))));
        let words = some.filter(|(_, n)| n != "0").map(|(kind, n)| match kind {
            "gear" if threaded => plural_of(&n, "nut"),
            _ => plural_of(&n, kind),
        });
        format!(" ({})", words.format(", "))
    }

    /// Returns what a structure is made of, how it is driven and which links are its jaws.
    fn make_up_text(&self) -> String {
        let s = &self.structure;
        let jaws = if has_value(s, "jaw_c") {
            "{jaw_a}, {jaw_b} and {jaw_c} around the part"
        } else {
            "{jaw_a} and {jaw_b}"
        };
        let [links, joints] =
            ["link", "joint"].map(|n| plural_of(&cell_of(s, &format!("{n}s")), n));
        let against = match &self.pairs {
            Some(p) if cell_of(p, "driven_from") != cell_of(s, "frame") => {
                fill_template(" against {driven_from}", p)
            }
            _ => String::new(),
        };
        let parallel = match &*cell_of(s, "parallel") {
            "1" => ", jaws on parallelograms",
            _ => "",
        };
        let template = format!(
            "{links}, {joints}{}; frame {{frame}}, driver {{driver}} ({{input}}{against}), jaws {jaws}, \
             {{jaws_at_frame}} of them at the frame; laid out {{symmetry}}{parallel}\n",
            self.pairs_text()
        );
        fill_template(&template, s)
    }

    /// Returns how a layout is constrained, how its jaws move and how hard they press.
    fn motion_text(&self, layout: &Row) -> String {
        let slide = cell_of(&self.structure, "input") == "slide";
        let (travel, effort) = if slide {
            ("mm", "1 N")
        } else {
            ("rad", "1 Nm")
        };
        let jaws = if has_value(layout, "jaw_c_motion") {
            "{jaw_a_motion}, {jaw_b_motion} and {jaw_c_motion}"
        } else {
            "{jaw_a_motion} and {jaw_b_motion}"
        };
        let template = format!(
            "As built: W = {{mobility}}, σ = {{redundant}}; finite mobility {{finite}}\n\
             Jaws: {jaws}, {{opening_min}} to {{opening_max}} mm apart for {{travel}} {travel} of the drive; they turn by {{jaw_turn}}° at most\n\
             Force of each jaw for {effort} of the drive, without friction: {{force_mean}} N ({{force_min}} to {{force_max}} over the stroke)\n"
        );
        fill_template(&template, layout)
    }

    /// Returns how a layout looks, and how many redesigns it has.
    fn shape_text(&self, layout: &Row) -> String {
        let images = match cell_of(&self.structure, "symmetry").as_str() {
            "generic" => String::new(),
            symmetry => format!(", {{orbits_w1}} up to {symmetry} images"),
        };
        let template = format!(
            "Drawn: links 1 : {{link_ratio}}, crossings: {{crossings}}\n\
             Determinate variants ({{certainty}}): {{determinate}}, of these {{determinate_w1}} with W = 1{images}\n\n"
        );
        fill_template(&template, layout)
    }

    /// Returns the ideas as a table, with their hardware.
    fn ideas_text(&self, width: Option<u16>) -> String {
        let searched = self.layout.as_ref().unwrap_or(&self.structure);
        let (found, least) = match searched.get("certainty").and_then(Value::as_str) {
            Some("exact") => ("", ""),
            _ => (" found", "at least "),
        };
        let which = match self.ideas.len() {
            0 => return String::new(),
            1 => "The first idea".to_owned(),
            n => format!("The {n} first ideas, symmetric ones before others"),
        };
        // A determinate variant of mobility 1 adds freedoms to joints that are not driven, so the motion as built is its only one.
        let line = format!(
            "{which}{found}; each keeps the drive and the motion as built; each represents {least}the given number of variants, and the first of these is exported:\n"
        );
        let keys = "place | cost | variants | peak_force | peak_moment | changes";
        let row = |i: &Row| keys.split(" | ").map(|k| cell_of(i, k)).collect();
        let heads = " | cost | variants | force | moment | changes";
        let ideas = text_table(heads, self.ideas.iter().map(row), width);
        let mut parts = self
            .hardware
            .iter()
            .map(|(to, part)| format!("{to}: {part}"));
        let parts = match parts.join("; ") {
            none if none.is_empty() => String::new(),
            parts => format!("\nHardware: {parts}\n"),
        };
        format!(
            "{}\n{ideas}\n{}",
            fit_lines(&line, width),
            fit_lines(&parts, width)
        )
    }

    /// Returns true if there is a mechanism of it.
    pub fn has_layout(&self) -> bool {
        self.layout.is_some()
    }

    /// Returns all of it for people, the verdict first.
    pub fn text(&self, width: Option<u16>) -> String {
        let head = fit_lines(&(self.verdict_line() + &self.structure_text()), width);
        if self.has_layout() {
            head + &self.ideas_text(width)
        } else {
            head
        }
    }
}

/// Returns the contents of a catalogue that was just built.
///
/// # Errors
/// Returns an error if the database cannot be read.
pub fn built_text(
    store: &Store,
    file: &Path,
    added: usize,
    width: Option<u16>,
) -> Result<String, StoreError> {
    let (names, rows) = store.query_rows(
        "SELECT links, input, symmetry || iif(parallel, ' parallel', '') AS layout, count(*) AS structures, \
         sum(no_layout IS NULL) AS 'laid out', sum(reached AND shortfall IS NULL) AS 'do the task', \
         sum(determinate_w1) AS 'determinate, W = 1', min(best_cost) AS 'least cost' \
         FROM structures s LEFT JOIN layouts l ON l.structure = id LEFT JOIN strokes k ON k.structure = id GROUP BY 1, 2, 3 \
         ORDER BY 1, 2, 3",
        None,
    )?;
    let table = QueryAnswer { names, rows }.text(width);
    let n = group_thousands(added);
    let path = file.display().to_string();
    let path = escape_control(&path);
    Ok(format!(
        "{table}\n{n} structures added to {path}. Go on with\n\n  ozols catalog query {path}\n  ozols catalog page {path} -o grippers.html\n"
    ))
}
