//! Edits of a description by spans of its text. Everything else stays unchanged, byte for byte.

use crate::robots::description::origin::Origin;
use crate::robots::description::physical::{LIGHT_SDF, LIGHT_URDF};
use crate::robots::include::is_old;
use crate::robots::mechanism::series_of_single_joints::{
    Names, escape_comment, escape_xml, format_numbers,
};
use crate::robots::prelude::*;
use std::ops::Range;

/// The freedoms that a joint gets: whether each slides, its direction in the world, and the reason, in words.
pub(crate) type Freed<'a> = &'a [(bool, Vector, String)];

/// A joint that gets freedoms, and its element.
pub(crate) type Freeing<'a> = (&'a Part, Element<'a>, Freed<'a>);

/// Changes to the text of a description.
pub(crate) struct Edits<'a> {
    pub(crate) origin: &'a Origin,
    /// File, replaced range, and replacement.
    list: Vec<(usize, Range<usize>, String)>,
    names: Names,
}

impl<'a> Edits<'a> {
    pub(crate) fn new(origin: &'a Origin) -> Edits<'a> {
        let all = 0..origin.document.nodes.len();
        let named = all.filter_map(|id| origin.element(id).attribute("name"));
        Edits {
            origin,
            list: Vec::new(),
            names: Names(named.map(str::to_owned).collect()),
        }
    }

    /// Returns a name that no element has.
    pub(crate) fn name(&mut self, wanted: &str) -> String {
        let nth = |n| format!("{wanted}_{n}");
        self.names.unique_name(wanted.to_owned(), nth)
    }

    fn source_text(&self, e: Element<'_>) -> &'a str {
        &self.origin.document.sources[e.node().source].text
    }

    /// Returns the text of the element in its file.
    pub(crate) fn raw_text(&self, e: Element<'_>) -> &'a str {
        &self.source_text(e)[e.node().span.start..end_of(e)]
    }

    pub(crate) fn replace_span(&mut self, e: Element<'_>, span: Range<usize>, by: String) {
        self.list.push((e.node().source, span, by));
    }

    /// Gives an attribute another value, or adds it.
    pub(crate) fn set_attribute(&mut self, e: Element<'_>, name: &str, value: &str) -> Read<()> {
        let value = quick_xml::escape::escape(value).into_owned();
        match (e.attribute(name), e.value_span(name)) {
            (_, Some(span)) => self.replace_span(e, span, value),
            (Some(_), None) => {
                let why = format!("its attribute {name} is written with character references");
                return Err(e.unsupported_error(&why, "write the characters themselves"));
            }
            (None, None) => {
                // Behind the tag's name.
                let at = e.node().span.start + 1 + e.name().len();
                self.replace_span(e, at..at, format!(" {name}=\"{value}\""));
            }
        }
        Ok(())
    }

    /// Inserts lines after an element, with its indentation.
    pub(crate) fn insert_after(&mut self, e: Element<'_>, lines: &[String]) {
        let (indent, newline) = self.find_layout(e);
        let text = lines.iter().map(|l| format!("{newline}{indent}{l}"));
        let text = text.collect();
        self.replace_span(e, end_of(e)..end_of(e), text);
    }

    /// Inserts lines as the last children of an element.
    pub(crate) fn append_child(&mut self, e: Element<'_>, lines: &[String]) {
        let (indent, newline) = self.find_layout(e);
        let inner = lines.iter().map(|l| format!("{newline}{indent}  {l}"));
        let inner: String = inner.collect();
        let node = e.node();
        if node.close.is_empty() {
            // <body .../> is opened.
            let slash = node.span.end - 2..node.span.end;
            let opened = format!(">{inner}{newline}{indent}</{}>", e.name());
            self.replace_span(e, slash, opened);
        } else {
            let at = self.source_text(e)[..node.close.start].trim_end().len();
            self.replace_span(e, at..at, inner);
        }
    }

    /// Returns the indentation of an element and the line ending of its file.
    fn find_layout(&self, e: Element<'_>) -> (&'a str, &'static str) {
        let text = self.source_text(e);
        let before = &text[..e.node().span.start];
        let line = &before[before.rfind('\n').map_or(0, |n| n + 1)..];
        let indent = if line.trim().is_empty() { line } else { "" };
        let newline = if text.contains("\r\n") { "\r\n" } else { "\n" };
        (indent, newline)
    }

    /// Returns the text of the description with all edits.
    pub(crate) fn apply_edits(mut self) -> Read<String> {
        let sources = &self.origin.document.sources;
        // The root's file is the first that was read.
        if let Some((source, span, _)) = self.list.iter().find(|(s, ..)| *s != 0) {
            let source = &sources[*source];
            let message = "the change is in an included file; merge the files, for example by saving the model from MuJoCo as XML, or change joints of the main file only";
            let problem = syntax_problem(message);
            return Err(problem.in_file(&source.name, &source.text, Some(span.clone())));
        }
        // The sort is stable: edits at one place keep their order.
        self.list.sort_by_key(|(_, span, _)| span.start);
        let (text, mut out, mut at) = (&sources[0].text, String::new(), 0);
        for (_, span, by) in &self.list {
            if span.start < at {
                let message = "two changes affect the same place; make them one at a time";
                let problem = syntax_problem(message);
                return Err(problem.in_file(&sources[0].name, text, Some(span.clone())));
            }
            out.push_str(&text[at..span.start]);
            out.push_str(by);
            at = span.end;
        }
        out.push_str(&text[at..]);
        Ok(out)
    }
}

/// Returns the end of an element.
pub(crate) fn end_of(e: Element<'_>) -> usize {
    e.node().close.end.max(e.node().span.end)
}

/// Gives joints freedoms. Inserted joints come before the joint: its child, its name and its followers stay.
pub(crate) fn free_urdf(origin: &Origin, all: &[Freeing<'_>], edits: &mut Edits<'_>) -> Read<()> {
    for &(part, e, freed) in all {
        // The first link of a loop states its place in its own attributes, a joint in a separate element.
        let (tag, at) = match e.name() {
            "joint" => ("parent", e.first_child("origin")),
            _ => ("link1", e.first_child("link1")),
        };
        let Some(end) = e.first_child(tag) else {
            let why = "it has no end that can be changed";
            return Err(e.unsupported_error(why, "choose another joint"));
        };
        let frame = origin.places[part.links[0]].then(&part.sides[0]);
        let mut from = end.required_attribute("link")?.to_owned();
        let mut place = at.map_or(String::new(), origin_of);
        let mut lines = Vec::new();
        for (slides, direction, why) in freed {
            let (kind, word, limit) = match slides {
                true => ("prismatic", "slide", LIMIT),
                false => ("continuous", "turn", ""),
            };
            let between = edits.name(&format!("{}_{word}_link", part.id));
            let name = edits.name(&format!("{}_{word}", part.id));
            lines.push(format!("<!-- {why} -->"));
            let link = escape_xml(&between);
            lines.push(format!("<link name=\"{link}\">{LIGHT_URDF}</link>"));
            lines.push(format!(
                "<joint name=\"{}\" type=\"{kind}\"><parent link=\"{}\"/><child link=\"{}\"/>{place}<axis xyz=\"{}\"/>{limit}</joint>",
                escape_xml(&name), escape_xml(&from), escape_xml(&between),
                format_numbers(frame.inverse().map_direction(*direction))
            ));
            place.clear();
            from = between;
        }
        edits.insert_after(e, &lines);
        edits.set_attribute(end, "link", &from)?;
        for (key, zero) in [("xyz", "0 0 0"), ("rpy", "0 0 0"), ("quat_xyzw", "0 0 0 1")] {
            if let Some(at) = at.filter(|at| at.attribute(key).is_some()) {
                edits.set_attribute(at, key, zero)?;
            }
        }
    }
    Ok(())
}

/// Limits of sliding joints, which URDF requires.
const LIMIT: &str = "<limit lower=\"-1\" upper=\"1\" effort=\"0\" velocity=\"0\"/>";

/// Returns the placement that an element gives, as the origin of a joint.
fn origin_of(at: Element<'_>) -> String {
    let given = ["xyz", "rpy", "quat_xyzw"].into_iter().filter_map(|key| {
        let value = at.attribute(key)?;
        Some(format!(" {key}=\"{}\"", escape_xml(value)))
    });
    format!("<origin{}/>", given.collect::<String>())
}

/// Makes a `<mimic>` a comment.
pub(crate) fn comment_out(element: usize, why: &str, edits: &mut Edits<'_>) -> Read<()> {
    let e = edits.origin.element(element);
    let raw = escape_comment(edits.raw_text(e));
    let span = e.node().span.start..end_of(e);
    edits.replace_span(e, span, format!("<!-- {why}; it was {raw} -->"));
    Ok(())
}

/// Gives joints freedoms.
pub(crate) fn free_sdf(origin: &Origin, all: &[Freeing<'_>], edits: &mut Edits<'_>) -> Read<()> {
    for &(part, e, freed) in all {
        let remedy = "choose another joint";
        let (Some(child), "joint") = (e.first_child("child"), e.name()) else {
            return Err(e.unsupported_error("no link can be inserted there", remedy));
        };
        let mut nodes = origin.document.nodes.iter();
        let model = nodes.position(|n| n.children.contains(&e.id));
        let model = origin.element(model.unwrap_or(origin.root));
        let named = |l: &Element<'_>| l.attribute("name") == Some(child.text());
        let Some(link) = model.children_named("link").find(named) else {
            return Err(e.unsupported_error("its child is not a link of the same model", remedy));
        };
        let frame = axes_frame(origin, model, part, e)?;
        let pose = |e: Element<'_>| e.first_child("pose").map_or("", |p| edits.raw_text(p));
        let (link_pose, joint_pose) = (pose(link), pose(e));
        let mut lines = Vec::new();
        let mut chain = Vec::new();
        for (slides, direction, why) in freed {
            let (kind, word) = match slides {
                true => ("prismatic", "slide"),
                false => ("revolute", "turn"),
            };
            let id = part.id.replace("::", "_");
            let between = edits.name(&format!("{id}_{word}_link"));
            let name = edits.name(&format!("{id}_{word}"));
            let axis = format_numbers(frame.inverse().map_direction(*direction));
            lines.push(format!("<!-- {why} -->"));
            let link = escape_xml(&between);
            lines.push(format!(
                "<link name=\"{link}\">{link_pose}{LIGHT_SDF}</link>"
            ));
            chain.push((name, kind, between, axis));
        }
        for (i, (name, kind, between, axis)) in chain.iter().enumerate() {
            let next = chain.get(i + 1).map_or(child.text(), |c| &c.2);
            lines.push(format!(
                "<joint name=\"{}\" type=\"{kind}\">{joint_pose}<parent>{}</parent><child>{}</child><axis><xyz>{axis}</xyz><limit><lower>-1e16</lower><upper>1e16</upper></limit></axis></joint>",
                escape_xml(name), escape_xml(between), escape_xml(next)
            ));
        }
        let inner = child.node().span.end..child.node().close.start;
        edits.replace_span(child, inner, escape_xml(&chain[0].2));
        edits.insert_after(e, &lines);
    }
    Ok(())
}

/// Returns the frame, in the world, in which axes of a joint's followers are given: of the joint, or of its model before SDF 1.5.
fn axes_frame(of: &Origin, model: Element<'_>, part: &Part, e: Element<'_>) -> Read<RigidMotion> {
    // A joint with two axes that are not square is two parts; its child hangs on the last.
    let mut parts = of.robot.joints.iter().rev();
    let last = parts.find(|p| p.element == Some(e.id)).unwrap_or(part);
    let to = last.links[1];
    if !is_old(of.element(of.root)) {
        return Ok(of.places[to].then(&last.sides[1]));
    }
    let back = of.robot.places[to].then(&of.places[to].inverse());
    let pose = model.first_child("pose").map(|p| p.text_numbers::<6>());
    let [_, _, _, roll, pitch, yaw] = pose.transpose()?.unwrap_or_default();
    let model = RigidMotion::roll_pitch_yaw([0.0; 3], [roll, pitch, yaw]);
    Ok(back.inverse().then(&model))
}
