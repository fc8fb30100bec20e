//! What became of a description in another format: text and JSON.

use crate::format::phrase::plural;
use crate::geom::vector::Vector;
use crate::robots::convert::{Converted, JudgedLoop, Judgement};
use crate::view::terminal::layout::table;
use itertools::Itertools;
use serde_json::{Value, json};
use std::fmt::Write;

/// The files of a conversion.
#[derive(Debug, Clone, Copy)]
pub struct Files<'a> {
    /// The one read.
    pub from: &'a str,
    /// The one written.
    pub to: &'a str,
    /// The file of loops beside it.
    pub beside: Option<&'a str>,
    /// The word for the format.
    pub target: &'a str,
}

/// The report for people, tables fitted to `width` columns.
#[must_use]
pub fn text(c: &Converted, files: Files<'_>, width: Option<u16>) -> String {
    let figures = match c.figures {
        Some((w, sigma)) if c.lost.coupling_rows > 0 => {
            format!("W = {w}, σ = {sigma} with the couplings that are lost")
        }
        Some((w, sigma)) if c.repeated > 0 => {
            format!("W = {w}, σ = {sigma}, read again {}", sigma + c.repeated)
        }
        Some((w, sigma)) => format!("W = {w}, σ = {sigma}, the same read again"),
        None => "the digits do not decide W and σ".to_owned(),
    };
    let beside = files.beside.map_or(String::new(), |b| format!(" and {b}"));
    let mut out = format!(
        "{} -> {}{beside} ({}): {figures}\n",
        files.from, files.to, files.target
    );
    for j in &c.closures {
        let o = &j.options[j.chosen];
        let _ = writeln!(out, "  {} closes as {}", j.joint, named(o));
    }
    for t in &c.told {
        let _ = writeln!(out, "  {t}");
    }
    if !c.pose.is_empty() {
        let shown = c
            .pose
            .iter()
            .take(4)
            .map(|(id, v)| format!("{id}={:.4}", v[0]))
            .join(", ");
        let more = if c.pose.len() > 4 { ", ..." } else { "" };
        let _ = writeln!(
            out,
            "  its loops are closed where {} not at zero: {shown}{more}",
            plural(c.pose.len(), "joint") + if c.pose.len() == 1 { " is" } else { " are" }
        );
    }
    if c.lost.kinds.is_empty() {
        return out + "  nothing is lost\n";
    }
    let rows = c.lost.kinds.iter().map(|(kind, k)| {
        vec![
            kind.clone(),
            k.count.to_string(),
            k.example.clone().unwrap_or_default(),
            k.why.clone(),
        ]
    });
    out + "\n"
        + &table(
            &["lost", "count", "for example", "because"],
            rows.collect(),
            width,
        )
        + "\n"
}

/// "hinge about (0.00 0.00 1.00)".
fn named(o: &Judgement) -> String {
    let word = o.closure.word();
    o.axis
        .map_or_else(|| word.to_owned(), |d| format!("{word} {}", line(d)))
}

fn line(d: Vector) -> String {
    let along = (0..3).find(|&i| d[i].abs() > 1.0 - 1e-9);
    match along {
        Some(i) => ["x", "y", "z"][i].to_owned(),
        None => format!("({})", d.map(|x| format!("{x:.2}")).join(" ")),
    }
}

/// A table of what each closure of a loop makes of the robot.
#[must_use]
pub fn closures(all: &[JudgedLoop], width: Option<u16>) -> String {
    let mut out = String::new();
    for j in all {
        let rows = j.options.iter().enumerate().map(|(i, o)| {
            let (w, sigma) = o.figures;
            let mark = if i == j.chosen { "taken" } else { "" };
            let axis = o.axis.map_or(String::new(), line);
            vec![
                o.closure.word().to_owned(),
                axis,
                w.to_string(),
                sigma.to_string(),
                o.motion.word().to_owned(),
                mark.to_owned(),
            ]
        });
        let head = ["closure", "axis", "W", "σ", "motion of the others", ""];
        let _ = write!(
            out,
            "\n{}:\n{}\n",
            j.joint,
            table(&head, rows.collect(), width)
        );
    }
    out
}

/// The same for programs.
#[must_use]
pub fn json(c: &Converted, files: Files<'_>) -> Value {
    let option = |o: &Judgement| {
        json!({
            "closure": o.closure.word(),
            "axis": o.axis,
            "mobility": o.figures.0,
            "redundant": o.figures.1,
            "motion": o.motion.word(),
        })
    };
    let closures = c.closures.iter().map(|j| {
        json!({
            "name": j.joint,
            "taken": j.options[j.chosen].closure.word(),
            "options": j.options.iter().map(option).collect_vec(),
        })
    });
    let lost = c.lost.kinds.iter().map(|(kind, k)| {
        json!({ "kind": kind, "count": k.count, "example": k.example, "because": k.why })
    });
    let pose = c.pose.iter().map(|(id, v)| (id.clone(), json!(v)));
    json!({
        "file": files.from,
        "output": files.to,
        "beside": files.beside,
        "target": files.target,
        "mobility": c.figures.map(|f| f.0),
        "redundant": c.figures.map(|f| f.1),
        "repeated": c.repeated,
        "coupling_rows_lost": c.lost.coupling_rows,
        "lost": lost.collect_vec(),
        "told": c.told,
        "pose": pose.collect::<serde_json::Map<String, Value>>(),
        "closures": closures.collect_vec(),
    })
}
