//! The graph of links and joints as Graphviz DOT.

use crate::robots::prelude::*;

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
