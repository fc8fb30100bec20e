//! The graph of links and joints: Graphviz DOT and GraphML.

use crate::file::write::role_word;
use crate::geom::expr::Expr;
use crate::model::mechanism::{Joint, JointId, LinkId, Mechanism, Role};
use crate::robots::mechanism::series_of_single_joints::escape_xml;
use petgraph::dot::{Config, Dot};
use petgraph::graph::UnGraph;
use std::fmt::Write;

/// Writes links as nodes (the frame with a double outline, outputs filled) and joints as edges with their class.
#[must_use]
pub(super) fn write_dot(m: &Mechanism) -> String {
    let mut graph: UnGraph<LinkId, JointId> = UnGraph::new_undirected();
    let nodes: Vec<_> = m.link_ids().map(|l| graph.add_node(l)).collect();
    for (j, joint) in m.joints_with_ids() {
        let [a, b] = joint.links;
        graph.add_edge(nodes[a], nodes[b], j);
    }
    let edge = |_: &UnGraph<LinkId, JointId>, e: petgraph::graph::EdgeReference<'_, JointId>| {
        let j = &m.joints[*e.weight()];
        let drive = if j.drive { " penwidth=3" } else { "" };
        let dashed = if j.states.is_some() {
            " style=dashed"
        } else {
            ""
        };
        let label = format!(
            "{}\n{} {}",
            j.id,
            j.joint_type.class_numeral(),
            j.joint_type.name()
        );
        format!("label={}{drive}{dashed}", quote_dot(&label))
    };
    let node = |_: &UnGraph<LinkId, JointId>, (_, l): (petgraph::graph::NodeIndex, &LinkId)| {
        let link = &m.links[*l];
        let shape = match link.role {
            Role::Frame => " shape=box peripheries=2",
            Role::Output => " shape=box style=filled fillcolor=lightgrey",
            Role::Object => " shape=octagon",
            Role::Inner => " shape=box",
        };
        format!("label={}{shape}", quote_dot(&link.id))
    };
    let none = [Config::NodeNoLabel, Config::EdgeNoLabel];
    let body = format!("{:?}", Dot::with_attr_getters(&graph, &none, &edge, &node));
    body.replacen("graph {", &format!("graph {} {{", quote_dot(&m.name)), 1)
}

/// Quotes a string for DOT.
fn quote_dot(text: &str) -> String {
    let inner = text
        .replace('\\', "\\\\")
        .replace('"', "\\\"")
        .replace('\n', "\\n");
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
#[must_use]
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
    let _ = writeln!(
        out,
        "  <graph id=\"{}\" edgedefault=\"undirected\">",
        escape_xml(&m.name)
    );
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
    let _ = writeln!(
        out,
        "      <data key=\"{key}\">{}</data>",
        escape_xml(value)
    );
}

/// Writes a joint as an edge of GraphML.
fn write_edge(out: &mut String, m: &Mechanism, j: &Joint) {
    let [a, b] = j.links.map(|l| escape_xml(&m.links[l].id));
    let _ = writeln!(
        out,
        "    <edge id=\"{}\" source=\"{a}\" target=\"{b}\">",
        escape_xml(&j.id)
    );
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
