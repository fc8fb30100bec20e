//! What a kinematic scheme shows is what the mechanism is: drives that slide have straight arrows, gears are drawn where there are
//! gears, spherical links are arcs, names are told apart and lie on no line, and motions are seen.

use super::places::all;
use super::reading::{covers, texts};
use crate::common::*;
use crate::drawings::subject;

type Point = [f64; 2];

fn drawn(m: &Mechanism) -> Drawing {
    kinematic(&subject(m))
}

/// Whether a segment passes through a rectangle.
fn through(r: &Rect, a: Point, b: Point) -> bool {
    let (mut from, mut to) = (0.0f64, 1.0f64);
    let d = sub(b, a);
    for (at, by, low, high) in [(a[0], d[0], r.left, r.right), (a[1], d[1], r.top, r.bottom)] {
        if by.abs() < 1e-12 {
            if at <= low || at >= high {
                return false;
            }
            continue;
        }
        let (s, t) = ((low - at) / by, (high - at) / by);
        (from, to) = (from.max(s.min(t)), to.min(s.max(t)));
    }
    to - from > 1e-9
}

/// The segments of what names must not lie on: bars, plates, leaders, ground, pitch circles and the lines of couplings.
fn lines(svg: &str) -> Vec<(String, Point, Point)> {
    let doc = roxmltree::Document::parse(svg).unwrap();
    let wanted = ["bone", "plate", "lead", "fine", "guide", "trace"];
    let paths = doc.descendants().filter(|n| n.has_tag_name("path"));
    let paths = paths.filter(|n| !n.ancestors().any(|a| a.has_attribute("data-joint")));
    let mut out = Vec::new();
    for n in paths {
        let class = n.attribute("class").unwrap_or_default();
        let kind = class.split(' ').next().unwrap_or_default();
        if !wanted.contains(&kind) {
            continue;
        }
        // A path may begin anew: hatching is many strokes.
        let d = n.attribute("d").unwrap();
        if d.matches('M').count() > 1 {
            continue;
        }
        let points = covers(n);
        let closing = d
            .ends_with('Z')
            .then(|| (points[points.len() - 1], points[0]));
        let all = points.windows(2).map(|w| (w[0], w[1])).chain(closing);
        out.extend(all.map(|(a, b)| (kind.to_owned(), a, b)));
    }
    out
}

#[test]
fn no_name_lies_on_a_line() {
    let (mut wrong, mut names) = (Vec::new(), 0);
    all(|name, m, _, d, _| {
        let ids: BTreeSet<&str> = m
            .joints
            .iter()
            .map(|j| j.id.as_str())
            .chain(m.links.iter().map(|l| l.id.as_str()))
            .chain(m.points.iter().map(|p| p.id.as_str()))
            .collect();
        let lines = lines(&d.svg);
        for (text, rect) in texts(&d.svg)
            .iter()
            .filter(|(t, _)| ids.contains(t.as_str()))
        {
            names += 1;
            // The leader of a name ends at its box.
            let box_ = rect.grown_by(-1.0);
            let on = lines.iter().filter(|(_, a, b)| through(&box_, *a, *b));
            wrong.extend(on.map(|(kind, ..)| format!("{name}: {text} on a {kind}")));
        }
    });
    assert!(names > 2000, "{names}");
    assert!(wrong.is_empty(), "{} of {names}: {wrong:#?}", wrong.len());
}

/// The parts of a joint's symbol.
fn symbol<'a>(doc: &'a roxmltree::Document<'_>, joint: &str) -> roxmltree::Children<'a, 'a> {
    let mut all = doc.descendants();
    let group = all.find(|n| n.attribute("data-joint") == Some(joint));
    group.unwrap().children()
}

/// The shafts and heads of straight arrows in the group of a joint: from the tail to the tip.
fn straight_arrows(svg: &str, joint: &str) -> Vec<Point> {
    let doc = roxmltree::Document::parse(svg).unwrap();
    let heads = symbol(&doc, joint).filter(|n| {
        n.has_tag_name("path") && n.attribute("class").is_some_and(|c| c.starts_with("ink"))
    });
    let heads = heads.map(covers).filter(|p| p.len() == 3);
    heads
        .map(|p| sub(p[0], [(p[1][0] + p[2][0]) / 2.0, (p[1][1] + p[2][1]) / 2.0]))
        .collect()
}

/// Whether a ring with an arrow head is drawn round a joint.
fn has_ring(svg: &str, joint: &str) -> bool {
    let doc = roxmltree::Document::parse(svg).unwrap();
    symbol(&doc, joint).any(|n| {
        let is_line = n.attribute("class").is_some_and(|c| c.starts_with("line"));
        is_line && n.has_tag_name("path") && covers(n).len() == 29
    })
}

#[test]
fn a_driven_slide_has_a_straight_arrow() {
    let (mut slides, mut turns) = (0, 0);
    all(|name, m, state, d, _| {
        for j in m.joints_in(state).filter(|&j| m.joints[j].drive) {
            let joint = &m.joints[j];
            let ring = has_ring(&d.svg, &joint.id);
            match joint.joint_type {
                JointType::Prismatic => {
                    assert!(!ring, "{name}: {} turns", joint.id);
                    slides += 1;
                }
                JointType::Revolute => {
                    assert!(ring, "{name}: {} does not turn", joint.id);
                    turns += 1;
                }
                _ => {}
            }
        }
    });
    assert!(slides > 20 && turns > 40, "{slides} {turns}");
    // Its drive is left open between a turn and a slide, and only the slide moves the jaws: along x, in the plane.
    let gripper = drawn(&built_in("gripper-10"));
    assert!(!has_ring(&gripper.svg, "0-1"));
    let arrows = straight_arrows(&gripper.svg, "0-1");
    assert_eq!(arrows.len(), 1, "{arrows:?}");
    assert!(
        arrows[0][0].abs() > 3.0 && arrows[0][1].abs() < 1e-6,
        "{arrows:?}"
    );
    assert!(gripper.svg.contains("driven slide"));
}

/// Both racks of the gripper are lines that touch the circle of their pinion, between the pinions.
#[test]
fn a_rack_touches_the_pitch_circle_of_its_pinion() {
    let gripper = drawn(&built_in("rack-gripper"));
    let doc = roxmltree::Document::parse(&gripper.svg).unwrap();
    let pitch = |n: &roxmltree::Node<'_, '_>| n.attribute("class") == Some("fine pitch");
    let paths = doc.descendants().filter(|n| n.has_tag_name("path"));
    let curves: Vec<Vec<Point>> = paths.filter(pitch).map(covers).collect();
    let (circles, racks): (Vec<_>, Vec<_>) = curves.iter().partition(|c| c.len() > 2);
    assert_eq!((circles.len(), racks.len()), (2, 2));
    let length = |[x, y]: Point| x.hypot(y);
    // The points of a circle are evenly spaced.
    let middle = |circle: &[Point]| {
        let mean = |k: usize| circle.iter().map(|p| p[k]).sum::<f64>() / circle.len() as f64;
        [mean(0), mean(1)]
    };
    let [upper, lower] = [0, 1].map(|n| middle(circles[n]));
    for (n, rack) in racks.iter().enumerate() {
        let (centre, other) = if n == 0 {
            (upper, lower)
        } else {
            (lower, upper)
        };
        let radius = length(sub(circles[n][0], centre));
        let along = sub(rack[1], rack[0]);
        let far = |p: Point| {
            let to = sub(p, rack[0]);
            (along[0] * to[1] - along[1] * to[0]) / length(along)
        };
        let (own, others) = (far(centre), far(other));
        assert!((own.abs() - radius).abs() < 0.02, "{own} {radius}");
        assert!(own * others < 0.0, "{own} {others}");
    }
}

#[test]
fn gears_are_drawn_where_the_file_says_gear_and_nowhere_else() {
    for name in ["geared-gripper", "geared-five-bar", "planetary-gear"] {
        let text = builtin::text(name).unwrap();
        let geared = drawn(&read(text));
        assert!(geared.svg.contains("pitch circle of a gear"), "{name}");
        assert!(!geared.svg.contains("coupled joints"), "{name}");
        // The same ratio by a belt, a linkage or a controller.
        let coupled = drawn(&read(&text.replace("gear = true\n", "")));
        assert!(!coupled.svg.contains("fine pitch"), "{name}");
        assert!(coupled.svg.contains("coupled joints"), "{name}");
    }
}

#[test]
fn long_names_are_never_alike() {
    let text = builtin::text("watt-six-bar").unwrap();
    let long =
        |id: &str| format!("assembly_of_the_front_suspension_joint_{id}_revision_of_the_year_2024");
    let mut m = read(text);
    for joint in &mut m.edit().joints {
        joint.id = long(&joint.id);
    }
    let d = drawn(&m);
    let names: Vec<String> = d
        .labels
        .iter()
        .map(|l| l.text.clone())
        .filter(|t| t.contains('…'))
        .collect();
    assert_eq!(names.len(), m.joints.len());
    assert_eq!(
        names.iter().collect::<BTreeSet<_>>().len(),
        names.len(),
        "{names:?}"
    );
    assert!(names.iter().all(|n| n.starts_with("assembly")), "{names:?}");
}

#[test]
fn links_of_spherical_linkages_are_arcs() {
    for (name, links) in [("spherical-four-bar", 3), ("spherical-five-bar", 4)] {
        let d = drawn(&built_in(name));
        let doc = roxmltree::Document::parse(&d.svg).unwrap();
        let groups = doc.descendants().filter(|n| n.has_attribute("data-link"));
        let bars: Vec<Vec<Point>> = groups
            .filter_map(|g| g.children().find(|c| c.has_tag_name("path")))
            .map(covers)
            .collect();
        assert_eq!(bars.len(), links, "{name}");
        let bent = |points: &&Vec<Point>| {
            let (a, b) = (points[0], points[points.len() - 1]);
            let d = sub(b, a);
            let off = |p: &Point| {
                let e = sub(*p, a);
                (d[0] * e[1] - d[1] * e[0]).abs() / length(d)
            };
            points.iter().map(off).fold(0.0, f64::max) > 0.005 * length(d)
        };
        assert!(bars.iter().all(|b| b.len() == 17), "{name}");
        // One may be seen from its edge.
        let bent = bars.iter().filter(bent).count();
        assert!(bent + 1 >= links, "{name}: {bent} of {links}");
        // All of it on the sheet.
        let inside = |p: &Point| p[0] > 0.0 && p[1] > 0.0 && p[0] < d.width && p[1] < d.height;
        assert!(bars.iter().flatten().all(inside), "{name}");
    }
}

/// The ways of points in a drawing of motion, without the sample in its legend.
fn traces(svg: &str) -> Vec<Vec<Point>> {
    let doc = roxmltree::Document::parse(svg).unwrap();
    let paths = doc
        .descendants()
        .filter(|n| n.attribute("class") == Some("trace"));
    paths
        .filter(|n| n.has_tag_name("path"))
        .map(covers)
        .filter(|way: &Vec<Point>| way.len() > 2)
        .collect()
}

#[test]
fn circles_that_outputs_go_on_are_seen_as_such() {
    for name in ["bennett", "rssr"] {
        let svg = run_quiet(&["draw", name, "--kind", "kinematic", "--motion"]);
        let ways = traces(&svg);
        assert!(!ways.is_empty(), "{name}");
        for way in &ways {
            let pairs = way.iter().flat_map(|a| way.iter().map(move |b| (a, b)));
            let (a, b) = pairs
                .max_by(|p, q| length(sub(*p.0, *p.1)).total_cmp(&length(sub(*q.0, *q.1))))
                .unwrap();
            let along = sub(*b, *a);
            let off = way.iter().map(|p| {
                let e = sub(*p, *a);
                (along[0] * e[1] - along[1] * e[0]) / length(along)
            });
            let (low, high) = off.fold((0.0f64, 0.0f64), |(l, h), x| (l.min(x), h.max(x)));
            let share = (high - low) / length(along);
            assert!(share > 0.1, "{name}: a line, {share:.3} as wide as long");
        }
    }
}

#[test]
fn the_stroke_of_a_gripper_ends_where_its_jaws_meet() {
    let svg = run_quiet("draw gripper-10 --kind kinematic --motion");
    assert!(svg.contains("jaws meet at"), "the words say so");
    // The tips of both jaws come together at an end of their ways, and none of them crosses the middle.
    let ways = traces(&svg);
    assert_eq!(ways.len(), 2);
    let gaps: Vec<Point> = ways[0]
        .iter()
        .zip(&ways[1])
        .map(|(a, b)| sub(*a, *b))
        .collect();
    let sides: BTreeSet<bool> = gaps
        .iter()
        .filter(|g| g[1].abs() > 0.5)
        .map(|g| g[1] > 0.0)
        .collect();
    assert_eq!(sides.len(), 1, "jaws go through each other");
    let least = gaps
        .iter()
        .map(|g| length(*g))
        .fold(f64::INFINITY, f64::min);
    assert!(least < 1.0, "{least} pixels apart");
    // A range that is asked for is kept, whatever it goes through.
    let asked = run_quiet("draw gripper-10 --kind kinematic --motion --stroke -1.5:2:40");
    assert!(!asked.contains("jaws meet"));
}

#[test]
fn ids_that_turn_letters_round_are_spelt_out() {
    let text = builtin::text("four-bar").unwrap();
    let turned = replace_once(text, "name = \"four-bar\"", "name = \"four\\u202Ebar\"");
    let d = drawn(&read(&turned));
    assert!(d.svg.contains("four\\u{202e}bar"));
    assert!(!d.svg.contains('\u{202e}'));
}
