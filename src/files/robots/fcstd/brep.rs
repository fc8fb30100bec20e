//! The kinds of surfaces and curves in a shape written as text, by the names that faces and edges have in FreeCAD.

/// The kind of an element of a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum ShapeKind {
    Vertex,
    Line,
    Circle(f64),
    Curve,
    Plane,
    Cylinder(f64),
    Cone,
    Sphere(f64),
    Torus(f64),
    Surface,
}

/// Returns the kind of an element, such as `Face3`. `None` if the shape does not define it.
pub(crate) fn kind(shape: &str, element: &str) -> Option<ShapeKind> {
    let number = |prefix: &str| element.strip_prefix(prefix)?.parse::<usize>().ok();
    let (tag, place) = match (number("Face"), number("Edge")) {
        (Some(n), _) => ("Fa", n),
        (_, Some(n)) => ("Ed", n),
        _ => return None,
    };
    let shapes = shapes(shape)?;
    let at = nth(&shapes, tag, place)?;
    let geometry = shapes.get(at)?.geometry?;
    let section = if tag == "Fa" { "Surfaces" } else { "Curves" };
    of_geometry(section, geometry_line(shape, section, geometry)?)
}

/// A shape of the list: its tag, the shapes it is made of, and the surface or curve it lies on.
struct BrepShape<'a> {
    tag: &'a str,
    parts: Vec<usize>,
    geometry: Option<usize>,
}

/// Returns the lines after a heading that gives their number.
fn section<'a>(text: &'a str, heading: &str) -> Option<(usize, &'a str)> {
    let mut from = 0;
    loop {
        let at = from + text.get(from..)?.find(heading)?;
        let starts = at == 0 || text.as_bytes()[at - 1] == b'\n';
        let rest = &text[at + heading.len()..];
        let (line, below) = rest.split_once('\n')?;
        if let (true, Some(count)) = (starts && line.starts_with(' '), line.trim().parse().ok()) {
            return Some((count, below));
        }
        from = at + heading.len();
    }
}

/// Returns the shapes in the order of the file: parts come before the shapes they belong to, and are referred to by their place
/// from the end.
fn shapes(text: &str) -> Option<Vec<BrepShape<'_>>> {
    let (count, body) = section(text, "TShapes")?;
    // Each takes three lines at least.
    if count > body.len() / 3 {
        return None;
    }
    let mut out: Vec<BrepShape<'_>> = Vec::new();
    let mut lines = body.lines();
    while out.len() < count {
        let tag = lines.next()?.trim();
        if tag.is_empty() {
            continue;
        }
        let mut geometry = None;
        // The geometry ends with seven flags in a line of their own.
        for line in lines.by_ref() {
            let words: Vec<&str> = line.split_whitespace().collect();
            if matches!(words[..], [flags] if flags.len() == 7 && flags.bytes().all(|b| b"01".contains(&b)))
            {
                break;
            }
            let index = match (tag, &words[..]) {
                ("Fa", [_, _, surface, _]) => surface.parse().ok(),
                ("Ed", ["1", curve, _, _, _]) => curve.parse().ok(),
                _ => None,
            };
            geometry = geometry.or(index);
        }
        let mut parts = Vec::new();
        'parts: for line in lines.by_ref() {
            for word in line.split_whitespace() {
                if word == "*" {
                    break 'parts;
                }
                // +12, -12: the way it is turned; a number without a sign is a place.
                if let Some(from_end) = word.strip_prefix(['+', '-', 'i', 'e']) {
                    parts.push(count.checked_sub(from_end.parse().ok()?)?);
                }
            }
        }
        out.push(BrepShape {
            tag,
            parts,
            geometry,
        });
    }
    Some(out)
}

/// Returns the place of the n-th shape of a tag, from 1, in the order of a traversal from the whole down, each counted once.
fn nth(shapes: &[BrepShape<'_>], tag: &str, n: usize) -> Option<usize> {
    let mut met = vec![false; shapes.len()];
    let mut stack = vec![shapes.len().checked_sub(1)?];
    let mut left = n;
    while let Some(at) = stack.pop() {
        if std::mem::replace(met.get_mut(at)?, true) {
            continue;
        }
        if shapes[at].tag == tag {
            left = left.checked_sub(1)?;
            if left == 0 {
                return Some(at);
            }
        }
        stack.extend(shapes[at].parts.iter().rev());
    }
    None
}

/// Returns the line of a surface or curve of simple kind.
fn geometry_line<'a>(text: &'a str, heading: &str, n: usize) -> Option<&'a str> {
    let (count, body) = section(text, heading)?;
    if n == 0 || n > count {
        return None;
    }
    // Simple kinds take a line; others take more, and where one stands before, lines cannot be counted.
    let mut lines = body.lines();
    for _ in 1..n {
        let kind: usize = lines.next()?.split_whitespace().next()?.parse().ok()?;
        let simple = match heading {
            "Surfaces" => (1..=5).contains(&kind),
            _ => (1..=5).contains(&kind),
        };
        if !simple {
            return None;
        }
    }
    lines.next()
}

fn of_geometry(heading: &str, line: &str) -> Option<ShapeKind> {
    let words: Vec<f64> = line
        .split_whitespace()
        .filter_map(|w| w.parse().ok())
        .collect();
    let last = words.last().copied()?;
    #[allow(
        clippy::cast_possible_truncation,
        reason = "a small whole number or none"
    )]
    let kind = *words.first()? as i64;
    Some(match (heading, kind) {
        ("Surfaces", 1) => ShapeKind::Plane,
        ("Surfaces", 2) => ShapeKind::Cylinder(last),
        ("Surfaces", 3) => ShapeKind::Cone,
        ("Surfaces", 4) => ShapeKind::Sphere(last),
        ("Surfaces", 5) => ShapeKind::Torus(last),
        ("Surfaces", _) => ShapeKind::Surface,
        (_, 1) => ShapeKind::Line,
        (_, 2) => ShapeKind::Circle(last),
        _ => ShapeKind::Curve,
    })
}
