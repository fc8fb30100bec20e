//! Joint types as they are made: two links told apart by shade, cut open where one is in the other, an arrow for each freedom.

use super::reading::{collisions, covers, outside, texts};
use ozols::draw::{Drawing, Rect, joint_type};
use ozols::model::joint_type::{Freedom, JointType};
use std::collections::BTreeSet;

/// The drawings of all types that have a name.
fn drawings() -> [(JointType, Drawing); 13] {
    JointType::NAMED.map(|t| {
        let drawing = joint_type(&t);
        (t, drawing)
    })
}

/// The elements of a view that have a class.
fn of_class<'d>(
    view: roxmltree::Node<'d, 'd>,
    class: &'d str,
) -> impl Iterator<Item = roxmltree::Node<'d, 'd>> {
    view.descendants().filter(move |n| {
        let classes = n.attribute("class").unwrap_or_default();
        n.has_tag_name("path") && classes.split(' ').any(|c| c == class)
    })
}

/// Both views of a drawing.
fn views<'d>(doc: &'d roxmltree::Document<'d>) -> Vec<roxmltree::Node<'d, 'd>> {
    let all = doc.descendants();
    let views: Vec<_> = all.filter(|n| n.has_attribute("data-view")).collect();
    assert_eq!(views.len(), 2);
    views
}

/// The area that a class covers on paper, each face counted.
fn area(view: roxmltree::Node<'_, '_>, class: &str) -> f64 {
    let one = |n: roxmltree::Node<'_, '_>| {
        let p = covers(n);
        let cross = |i: usize| {
            let (a, b) = (p[i], p[(i + 1) % p.len()]);
            a[0] * b[1] - a[1] * b[0]
        };
        (0..p.len()).map(cross).sum::<f64>().abs() / 2.0
    };
    of_class(view, class).map(one).sum()
}

#[test]
fn both_links_are_seen_by_their_shade() {
    for (t, d) in drawings() {
        let doc = roxmltree::Document::parse(&d.svg).unwrap();
        for view in views(&doc) {
            for class in ["body-a", "body-b"] {
                let area = area(view, class);
                assert!(area > 600.0, "{t}: {area} of {class}");
            }
        }
        // on screens that are dark as well, and other tones there
        let (light, dark) = d.svg.split_once("body-c.t5").unwrap();
        for class in [".body-a{fill:", ".body-b{fill:"] {
            let tone = |css: &str| css.split_once(class).unwrap().1[..7].to_owned();
            assert_ne!(tone(light), tone(dark), "{t} {class}");
        }
    }
}

#[test]
fn each_freedom_has_an_arrow_with_its_name_in_both_views() {
    for (t, d) in drawings() {
        let doc = roxmltree::Document::parse(&d.svg).unwrap();
        let mut right: Vec<&str> = t.freedoms().iter().map(|f| f.name()).collect();
        right.sort_unstable();
        for view in views(&doc) {
            let arrows = view
                .descendants()
                .filter(|n| n.has_attribute("data-freedom"));
            let arrows: Vec<_> = arrows.collect();
            let mut names: Vec<&str> = arrows
                .iter()
                .filter_map(|a| a.attribute("data-freedom"))
                .collect();
            names.sort_unstable();
            assert_eq!(names, right, "{t}");
            // two heads, or one point that points at the reader
            for arrow in &arrows {
                let heads = of_class(*arrow, "head").count();
                let lines = of_class(*arrow, "freedom").count() - heads;
                assert!(heads > 0 && lines > 0, "{t}");
            }
            let said = view
                .descendants()
                .filter(|n| n.attribute("class") == Some("freedom"));
            let said = said.filter(|n| n.has_tag_name("text"));
            let mut said: Vec<&str> = said.filter_map(|n| n.text()).collect();
            said.sort_unstable();
            assert_eq!(said, right, "{t}");
        }
    }
}

/// Points along all that is drawn in a view, with its class.
fn points(view: roxmltree::Node<'_, '_>) -> Vec<[f64; 2]> {
    let paths = view.descendants().filter(|n| {
        n.has_tag_name("path")
            && !n
                .attribute("class")
                .is_some_and(|c| c == "hatch" || c == "edge")
    });
    let mut out = Vec::new();
    for path in paths {
        for pair in covers(path).windows(2) {
            let (a, b) = (pair[0], pair[1]);
            out.extend((0..=40).map(|i| {
                let t = f64::from(i) / 40.0;
                [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]
            }));
        }
    }
    out
}

#[test]
fn names_are_on_nothing_and_near_their_arrows() {
    for (t, d) in drawings() {
        let mut wrong = collisions(&d);
        wrong.extend(outside(&d));
        assert_eq!(wrong, [""; 0], "{t}");
        let texts = texts(&d.svg);
        let doc = roxmltree::Document::parse(&d.svg).unwrap();
        for view in views(&doc) {
            let drawn = points(view);
            for (text, rect) in &texts {
                let on = |p: &&[f64; 2]| rect.overlaps(&Rect::around(**p, 0.2, 0.2));
                assert_eq!(drawn.iter().find(on), None, "{t}: {text}");
            }
            for arrow in view
                .descendants()
                .filter(|n| n.has_attribute("data-freedom"))
            {
                let name = arrow.attribute("data-freedom").unwrap();
                let own = points(arrow);
                let far = |rect: &Rect| {
                    let to = |p: &[f64; 2]| {
                        let x = (rect.left - p[0]).max(p[0] - rect.right).max(0.0);
                        let y = (rect.top - p[1]).max(p[1] - rect.bottom).max(0.0);
                        x.hypot(y)
                    };
                    own.iter().map(to).fold(f64::INFINITY, f64::min)
                };
                let labels = texts.iter().filter(|(text, _)| text == name);
                let nearest = labels.map(|(_, r)| far(r)).fold(f64::INFINITY, f64::min);
                assert!(nearest < 14.0, "{t}: {name} is {nearest} from its arrow");
            }
        }
    }
}

#[test]
fn what_is_inside_is_seen_by_a_cut() {
    let cut: BTreeSet<&str> = [
        "prismatic",
        "helical",
        "cylindrical",
        "spherical",
        "cylindrical-universal",
        "sphere-in-cylinder",
    ]
    .into();
    for (t, d) in drawings() {
        let doc = roxmltree::Document::parse(&d.svg).unwrap();
        let aslant = views(&doc)[0];
        let open = area(aslant, "cut") > 200.0;
        assert_eq!(open, cut.contains(t.name()), "{t}");
        assert_eq!(open, of_class(aslant, "hatch").next().is_some(), "{t}");
        assert_eq!(open, d.labels.iter().any(|l| l.text == "cut open"), "{t}");
    }
}

#[test]
fn no_two_types_look_alike_in_any_view() {
    let all = drawings();
    let of = |d: &Drawing| {
        let doc = roxmltree::Document::parse(&d.svg).unwrap();
        let faces = |v| {
            let all = ["body-a", "body-b", "body-c"]
                .map(|c| of_class(v, c).map(covers).collect::<Vec<_>>());
            format!("{all:?}")
        };
        views(&doc).into_iter().map(faces).collect::<Vec<String>>()
    };
    let seen: Vec<Vec<String>> = all.iter().map(|(_, d)| of(d)).collect();
    for (i, a) in seen.iter().enumerate() {
        for (j, b) in seen[..i].iter().enumerate() {
            for n in 0..2 {
                assert_ne!(a[n], b[n], "{} and {}", all[i].0, all[j].0);
            }
        }
    }
}

#[test]
fn a_custom_joint_keeps_its_symbol() {
    let d = joint_type(&JointType::Custom(vec![Freedom::Rx, Freedom::Tz]));
    assert!(d.labels.iter().any(|l| l.text == "x: rx"), "{:?}", d.labels);
    assert!(!d.svg.contains("body-a"));
}
