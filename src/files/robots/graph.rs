//! The graph of links and joints: Graphviz DOT and GraphML.

use crate::file::write::role_word;
use crate::geom::expr::Expr;
use crate::model::mechanism::{Joint, LinkId, Mechanism, Role};
use crate::robots::mechanism::series_of_single_joints::escape_xml;
use std::fmt::Write;

/// Writes links as nodes (the frame with a double outline, outputs filled) and joints as edges with their class.
pub(super) fn write_dot(m: &Mechanism) -> String {
    let mut out = format!("graph {} {{\n", quote_dot(&m.name));
    for (l, link) in m.links_with_ids() {
        let shape = match link.role {
            Role::Frame => "box peripheries=2",
            Role::Output => "box style=filled fillcolor=lightgrey",
            Role::Object => "octagon",
            Role::Inner => "box",
        };
        let (l, label) = (l.index(), quote_dot(&link.id));
        let _ = writeln!(out, "    {l} [ label={label} shape={shape}]");
    }
    for j in &m.joints {
        let [a, b] = j.links.map(LinkId::index);
        let (class, kind) = (j.joint_type.class_numeral(), j.joint_type.name());
        let label = quote_dot(&format!("{}\n{class} {kind}", j.id));
        let drive = if j.drive { " penwidth=3" } else { "" };
        let dashed = j.states.as_ref().map_or("", |_| " style=dashed");
        let _ = writeln!(out, "    {a} -- {b} [ label={label}{drive}{dashed}]");
    }
    out + "}\n"
}

/// Quotes a string for DOT.
fn quote_dot(text: &str) -> String {
    let inner = text.replace('\\', "\\\\").replace('"', "\\\"");
    let inner = inner.replace('\n', "\\n");
    format!("\"{inner}\"")
}

/// The data of nodes and edges in GraphML: for nodes or edges, its name, its type.
const KEYS: [(&str, &str, &str); 8] = [
    ("node", "role", "string"),
    ("edge", "type", "string"),
    ("edge", "class", "string"),
    ("edge", "freedoms", "int"),
    ("edge", "drive", "boolean"),
    ("edge", "states", "string"),
    ("edge", "point", "string"),
    ("edge", "axis", "string"),
];

/// Writes links as nodes and joints as edges, with all data on the structure.
pub(super) fn write_graphml(m: &Mechanism) -> String {
    let mut out = String::from(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n",
    );
    for (on, name, kind) in KEYS {
        let _ = writeln!(
            out,
            "  <key id=\"{name}\" for=\"{on}\" attr.name=\"{name}\" attr.type=\"{kind}\"/>"
        );
    }
    let name = escape_xml(&m.name);
    let _ = writeln!(out, "  <graph id=\"{name}\" edgedefault=\"undirected\">");
    for link in &m.links {
        let _ = writeln!(out, "    <node id=\"{}\">", escape_xml(&link.id));
        write_datum(&mut out, "role", role_word(link.role).unwrap_or("inner"));
        out.push_str("    </node>\n");
    }
    for j in &m.joints {
        write_edge(&mut out, m, j);
    }
    out.push_str("  </graph>\n</graphml>\n");
    out
}

fn write_datum(out: &mut String, key: &str, value: &str) {
    let value = escape_xml(value);
    let _ = writeln!(out, "      <data key=\"{key}\">{value}</data>");
}

/// Writes a joint as an edge of GraphML.
fn write_edge(out: &mut String, m: &Mechanism, j: &Joint) {
    let [a, b] = j.links.map(|l| escape_xml(&m.links[l].id));
    let id = escape_xml(&j.id);
    let _ = writeln!(out, "    <edge id=\"{id}\" source=\"{a}\" target=\"{b}\">");
    let text = |v: &[Expr; 3]| v.each_ref().map(ToString::to_string).join(" ");
    let freedoms = j.joint_type.freedoms().len();
    write_datum(out, "type", j.joint_type.name());
    write_datum(out, "class", j.joint_type.class_numeral());
    write_datum(out, "freedoms", &freedoms.to_string());
    write_datum(out, "drive", &j.drive.to_string());
    if let Some(states) = &j.states {
        let names: Vec<&str> = states.iter().map(|&s| m.states[s].as_str()).collect();
        write_datum(out, "states", &names.join(" "));
    }
    write_datum(out, "point", &text(&j.frame.point));
    write_datum(out, "axis", &text(&j.frame.axis));
    out.push_str("    </edge>\n");
}
