//! A drawing read back from its SVG: where labels and lines are, what touches what.

use crate::common::*;

/// How far the groups round an element move it.
pub(super) fn moved(n: roxmltree::Node<'_, '_>) -> [f64; 2] {
    let mut by = [0.0; 2];
    for text in n.ancestors().filter_map(|a| a.attribute("transform")) {
        let numbers = text.strip_prefix("translate(").unwrap();
        let (x, y) = numbers.strip_suffix(')').unwrap().split_once(' ').unwrap();
        by[0] += x.parse::<f64>().unwrap();
        by[1] += y.parse::<f64>().unwrap();
    }
    by
}

/// Every text of the SVG as a reader would measure it: 0.6 of its size a character, one for wide ones.
pub(super) fn texts(svg: &str) -> Vec<(String, Rect)> {
    let doc = roxmltree::Document::parse(svg).unwrap_or_else(|e| panic!("{e}\n{svg}"));
    let root = doc.root_element();
    assert_eq!(root.attribute("role"), Some("img"));
    for name in ["title", "desc"] {
        let child = root.children().find(|c| c.has_tag_name(name)).unwrap();
        assert!(child.text().is_some_and(|t| !t.is_empty()), "{name}");
    }
    let of = |n: roxmltree::Node<'_, '_>, a: &str| n.attribute(a).unwrap().parse::<f64>().unwrap();
    doc.descendants()
        .filter(|n| n.has_tag_name("text"))
        .map(|n| {
            let text = n.text().unwrap().to_owned();
            let size = of(n, "font-size");
            let wide = 0.6 * size * text.chars().count() as f64;
            let by = moved(n);
            let (x, base) = (of(n, "x") + by[0], of(n, "y") + by[1]);
            let middle = n.attribute("text-anchor") == Some("middle");
            let left = if middle { x - wide / 2.0 } else { x };
            let rect = Rect {
                left,
                top: base - 0.75 * size,
                right: left + wide,
                bottom: base + 0.1 * size,
            };
            (text, rect)
        })
        .collect()
}

fn within(a: &Rect, b: &Rect) -> bool {
    a.left > b.left - 0.1
        && a.top > b.top - 0.1
        && a.right < b.right + 0.1
        && a.bottom < b.bottom + 0.1
}

/// What touches what it should not.
pub(super) fn collisions(d: &Drawing) -> Vec<String> {
    let all = texts(&d.svg);
    assert_eq!(all.len(), d.labels.len());
    let sheet = Rect {
        left: 0.0,
        top: 0.0,
        right: d.width,
        bottom: d.height,
    };
    let mut out = Vec::new();
    for (i, (text, rect)) in all.iter().enumerate() {
        for (other, there) in &all[..i] {
            if rect.overlaps(there) {
                out.push(format!("{text:?} on {other:?}"));
            }
        }
        // the class of a joint stands within its symbol
        let on = d
            .symbols
            .iter()
            .filter(|s| s.overlaps(rect) && !within(rect, s));
        out.extend(on.map(|_| format!("{text:?} on a symbol")));
        if !within(rect, &sheet) {
            out.push(format!("{text:?} outside"));
        }
    }
    let boxes = d.labels.iter().enumerate();
    for (i, label) in boxes {
        for other in &d.labels[..i] {
            if label.rect.overlaps(&other.rect) {
                out.push(format!("box of {:?} on {:?}", label.text, other.text));
            }
        }
    }
    out
}

/// What a path, circle or rectangle covers: ends of segments and arcs, in absolute commands.
pub(super) fn covers(n: roxmltree::Node<'_, '_>) -> Vec<[f64; 2]> {
    let of = |a: &str| n.attribute(a).map_or(0.0, |v| v.parse::<f64>().unwrap());
    let own = match n.tag_name().name() {
        "rect" => {
            let (x, y) = (of("x"), of("y"));
            vec![[x, y], [x + of("width"), y + of("height")]]
        }
        "circle" => {
            let (x, y, r) = (of("cx"), of("cy"), of("r"));
            vec![[x - r, y - r], [x + r, y + r]]
        }
        "path" => path(n.attribute("d").unwrap()),
        _ => Vec::new(),
    };
    let [x, y] = moved(n);
    own.into_iter().map(|p| [p[0] + x, p[1] + y]).collect()
}

/// The points of a path of `M`, `L` and `A`.
fn path(d: &str) -> Vec<[f64; 2]> {
    let commands = d.split(|c: char| c.is_ascii_alphabetic());
    let numbers = commands.map(|c| {
        c.split_whitespace()
            .map(|v| v.parse().unwrap())
            .collect::<Vec<f64>>()
    });
    let ends = numbers.filter(|n| !n.is_empty());
    ends.map(|n| match n[..] {
        [.., x, y] => [x, y],
        _ => panic!("{d}"),
    })
    .collect()
}

/// Shapes outside of the sheet, and a sheet that is not the viewBox.
pub(super) fn outside(d: &Drawing) -> Vec<String> {
    let doc = roxmltree::Document::parse(&d.svg).unwrap();
    let root = doc.root_element();
    let size = format!("0 0 {} {}", d.width, d.height);
    assert_eq!(root.attribute("viewBox"), Some(size.as_str()));
    let out = |p: &[f64; 2]| {
        let inside = p[0] >= 0.0 && p[1] >= 0.0 && p[0] <= d.width && p[1] <= d.height;
        !inside
    };
    let shapes = doc.descendants().filter(|n| covers(*n).iter().any(out));
    shapes
        .map(|n| format!("{:?} outside", n.attributes().collect::<Vec<_>>()))
        .collect()
}

/// Whether each joint has its class, and each contour its tint.
pub(super) fn misread(
    d: &Drawing,
    m: &Mechanism,
    state: StateId,
    analysis: &StateAnalysis,
) -> Vec<String> {
    let mut out = Vec::new();
    for (joint, symbol) in m.joints_in(state).zip(&d.symbols) {
        let within: Vec<&str> = d
            .labels
            .iter()
            .filter(|l| within(&l.rect, symbol))
            .map(|l| l.text.as_str())
            .collect();
        let joint = &m.joints[joint];
        if within != [joint.joint_type.class_numeral()] {
            out.push(format!("{} of class {within:?}", joint.id));
        }
    }
    let doc = roxmltree::Document::parse(&d.svg).unwrap();
    let mut tints: Vec<(String, String)> = doc
        .descendants()
        .filter(|n| n.has_tag_name("path"))
        .filter_map(|n| Some((n, n.attribute("class")?.strip_prefix("s s")?)))
        .map(|(n, tint)| {
            (
                n.first_element_child().unwrap().text().unwrap().to_owned(),
                tint.to_owned(),
            )
        })
        .collect();
    tints.sort();
    let shares = analysis.per_contour.iter().enumerate();
    let mut right: Vec<(String, String)> = shares
        .map(|(c, s)| {
            let (low, high) = s.range;
            let range = if low == high {
                String::new()
            } else {
                format!(" ({low} to {high})")
            };
            let words = format!(
                "contour {}: {}, σ = {}{range}",
                c + 1,
                s.contour.name(m),
                s.redundant
            );
            (words, s.redundant.min(6).to_string())
        })
        .collect();
    right.sort();
    if tints != right {
        out.push(format!("{tints:?} for {right:?}"));
    }
    out
}
