//! `<replicate>`: its content, repeated, each time moved and with a number after its names.

use crate::geom::rigid::RigidMotion;
use crate::robots::mjcf::context::{Compiler, read_compiler};
use crate::robots::warning::{Read, too_many};
use crate::robots::xml::{Document, MAX_ELEMENTS};

/// Puts frames with copies in place of all `<replicate>` elements below `root`, those within others first.
pub(super) fn expand_replicates(document: &mut Document, root: usize) -> Read<()> {
    // Wrong settings are reported where they are needed.
    if !document.nodes.iter().any(|n| n.is_called("replicate")) {
        return Ok(());
    }
    let compiler = read_compiler(document.element(root))?;
    let (mut order, mut stack) = (Vec::new(), vec![root]);
    while let Some(id) = stack.pop() {
        order.push(id);
        stack.extend(&document.nodes[id].children);
    }
    // From the inside out: children come after the elements around them.
    for id in order.into_iter().rev() {
        let children = document.nodes[id].children.clone();
        let mut all = Vec::with_capacity(children.len());
        for c in children {
            if document.element(c).name() == "replicate" {
                all.extend(make_copies(document, c, &compiler)?);
            } else {
                all.push(c);
            }
        }
        document.nodes[id].children = all;
    }
    Ok(())
}

fn make_copies(document: &mut Document, id: usize, compiler: &Compiler) -> Read<Vec<usize>> {
    let e = document.element(id);
    let count = e.read_numbers::<1>("count")?;
    let [count] = count.ok_or_else(|| e.missing_error("attribute count"))?;
    if !(1.0..=10_000.0).contains(&count) || count.fract() != 0.0 {
        let why = format!("count is {count}");
        return Err(e.unsupported_error(&why, "write a whole number from 1 to 10000"));
    }
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "whole, from 1 to 10000"
    )]
    let count = count as usize;
    let step = RigidMotion {
        translation: e.read_vector("offset", [0.0; 3])?,
        ..compiler.read_rotation(e)?
    };
    let separator = e.attribute("sep").unwrap_or("").to_owned();
    let digits = (count - 1).to_string().len();
    let inner = document.nodes[id].children.clone();
    let (mut place, mut out) = (RigidMotion::IDENTITY, Vec::new());
    for i in 0..count {
        let suffix = format!("{separator}{i:0digits$}");
        let r = place.rotation;
        let axes = [r[0][0], r[1][0], r[2][0], r[0][1], r[1][1], r[2][1]];
        let frame = document.nodes[id].as_frame(place.translation, axes);
        let frame = push_node(document, id, frame)?;
        let mut children = Vec::new();
        for &c in &inner {
            children.push(copy_element(document, c, &suffix)?);
        }
        document.nodes[frame].children = children;
        out.push(frame);
        place = place.then(&step);
    }
    Ok(out)
}

fn push_node(document: &mut Document, at: usize, node: crate::robots::xml::Node) -> Read<usize> {
    let id = document.nodes.len();
    if id >= MAX_ELEMENTS {
        let problem = too_many("elements", MAX_ELEMENTS);
        return Err(document.element(at).error_at(None, problem));
    }
    document.nodes.push(node);
    Ok(id)
}

/// Copies an element and its descendants, with a suffix on their names.
fn copy_element(document: &mut Document, id: usize, suffix: &str) -> Read<usize> {
    let node = document.nodes[id].named_on(suffix);
    let children = node.children.clone();
    let copy = push_node(document, id, node)?;
    let mut all = Vec::with_capacity(children.len());
    for c in children {
        all.push(copy_element(document, c, suffix)?);
    }
    document.nodes[copy].children = all;
    Ok(copy)
}
