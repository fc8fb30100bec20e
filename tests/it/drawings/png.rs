//! Drawings as PNG. Most of it needs the feature `png`: `cargo test --features png --test integration png`.

use crate::common::*;
#[test]
fn a_width_is_for_png() {
    assert_fails("draw bennett --width 90", "--width is for PNG");
}

#[cfg(not(feature = "png"))]
#[test]
fn a_build_without_png_says_so() {
    let dir = Folder::new();
    dir.assert_fails("draw bennett -o x.PNG", "--features png");
    assert_eq!(dir.names(), [""; 0]);
}

#[cfg(feature = "png")]
mod with_png {
    use crate::common::*;
    use crate::drawings::subject;
    use ozols::draw::Sight;
    use ozols::draw::Subject;
    use ozols::draw::kinematic_seen;
    use ozols::draw::png::png;
    use ozols::draw::scheme;
    use resvg::tiny_skia::{self, Pixmap};

    fn drawings(name: &str) -> [Drawing; 2] {
        let m = built_in(name);
        let subject = subject(&m);
        [scheme(&subject), kinematic(&subject)]
    }

    /// Whether something dark is in a rectangle of a picture.
    fn ink(picture: &Pixmap, rect: &Rect, scale: f64) -> bool {
        let range = |a: f64, b: f64| (a * scale) as u32..(b * scale) as u32;
        let dark = |x, y| picture.pixel(x, y).is_some_and(|p| p.red() < 150);
        range(rect.top, rect.bottom).any(|y| range(rect.left, rect.right).any(|x| dark(x, y)))
    }

    #[test]
    fn every_label_is_there() {
        for name in ["gripper-10", "stewart-gough", "y-star"] {
            for d in drawings(name) {
                let made = png(&d, Some((1.5 * d.width).round() as u32)).unwrap();
                assert!(made.missing.is_empty(), "{:?}", made.missing);
                let picture = Pixmap::decode_png(&made.png).unwrap();
                assert_eq!(f64::from(picture.width()), (1.5 * d.width).round());
                for label in &d.labels {
                    assert!(ink(&picture, &label.rect, 1.5), "{name}: {:?}", label.text);
                }
                for symbol in &d.symbols {
                    assert!(ink(&picture, symbol, 1.5), "{name}: {symbol:?}");
                }
                // white behind
                assert_eq!(picture.pixel(0, 0).unwrap().red(), 255);
            }
        }
    }

    /// A mechanism of two links with one joint of a type.
    fn single(joint_type: &str) -> Mechanism {
        let pitch = if joint_type == "helical" {
            "pitch = 1"
        } else {
            ""
        };
        let joint = format!("0-1 | 0 1 | {joint_type} | 0, 0, 0 | 0, 0, 1 | {pitch}");
        read(&write_mechanism("name = \"one\"", "0 1*", &joint))
    }

    /// The symbol of a drawing's only joint in so many pixels, in black and white.
    fn symbol(d: &Drawing, pixels: u32) -> Vec<u8> {
        let doc = roxmltree::Document::parse(&d.svg).unwrap();
        let group = doc
            .descendants()
            .find(|n| n.has_attribute("data-joint"))
            .unwrap();
        let inside = group.children().filter(|c| c.is_element());
        let inside: String = inside.map(|c| &d.svg[c.range()]).collect();
        let svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"34\" height=\"34\" viewBox=\"-17 -17 34 34\"><style>.joint{{fill:#fff;\
             stroke:#000;stroke-width:1.4}}.line{{fill:none;stroke:#000;stroke-width:1.2}}.fine{{fill:none;stroke:#000;\
             stroke-width:.9}}.ink{{fill:#000}}.blank{{fill:#fff}}</style>{inside}</svg>"
        );
        let alone = Drawing {
            svg,
            width: 34.0,
            height: 34.0,
            labels: Vec::new(),
            symbols: Vec::new(),
        };
        let made = png(&alone, Some(pixels)).unwrap();
        let picture = Pixmap::decode_png(&made.png).unwrap();
        picture.pixels().iter().map(|p| p.red()).collect()
    }

    #[test]
    fn joint_types_are_told_apart_by_shape_in_24_pixels() {
        for toward in [[0.0, 0.0, 1.0], [1.0, 1.0, 1.0], [1.0, 0.0, 0.0]] {
            let sight = Sight {
                toward: Some(toward),
                up: None,
            };
            let seen: Vec<Vec<u8>> = JointType::NAMED
                .iter()
                .map(|t| {
                    let m = single(t.name());
                    let subject = subject(&m);
                    symbol(&kinematic_seen(&subject, &sight, None), 24)
                })
                .collect();
            for (i, a) in seen.iter().enumerate() {
                assert!(
                    a.iter().any(|&p| p < 128),
                    "{} is seen",
                    JointType::NAMED[i]
                );
                for (j, b) in seen[..i].iter().enumerate() {
                    let other = a
                        .iter()
                        .zip(b)
                        .filter(|(a, b)| a.abs_diff(**b) > 90)
                        .count();
                    let (a, b) = (&JointType::NAMED[i], &JointType::NAMED[j]);
                    assert!(
                        other >= 8,
                        "{a} and {b} differ in {other} pixels from {toward:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn every_contour_is_seen_in_its_tint() {
        let wishbone = read(&double_wishbone());
        let names =
            split_words("door-two-hinges twin-rail-slide shaft-two-bearings gripper-10 bennett");
        for m in names.into_iter().map(built_in).chain([wishbone]) {
            let found = analyse_states(&m, &[StateId::FREE], Method::Modular).unwrap();
            let mut d = scheme(&Subject {
                mechanism: &m,
                state: StateId::FREE,
                analysis: found.first(),
                marks: None,
            });
            let plain = d.svg.clone();
            for c in 1..=found[0].contours {
                let rule =
                    format!("[data-contour=\"{c}\"] path{{fill:#ff00ff !important}}</style>");
                d.svg = plain.replacen("</style>", &rule, 1);
                let made = png(&d, Some(d.width.round() as u32)).unwrap();
                let picture = Pixmap::decode_png(&made.png).unwrap();
                let tinted = |p: &&tiny_skia::PremultipliedColorU8| {
                    p.red() > 240 && p.green() < 15 && p.blue() > 240
                };
                let seen = picture.pixels().iter().filter(tinted).count();
                assert!(seen > 100, "{}: {seen} pixels of contour {c}", m.name);
            }
        }
    }

    #[test]
    fn too_large_is_an_error() {
        let [d, _] = drawings("four-bar");
        assert!(png(&d, Some(u32::MAX)).is_err());
    }

    #[test]
    fn command_line() {
        let dir = Folder::new();
        dir.succeed("draw four-bar -o x.png --width 321");
        let file = dir.bytes("x.png");
        let picture = Pixmap::decode_png(&file).unwrap();
        assert_eq!(picture.width(), 321);
        dir.succeed("draw four-bar -o y.png");
        let twice = Pixmap::decode_png(&dir.bytes("y.png")).unwrap();
        let drawn = drawings("four-bar")[1].width;
        assert_eq!(f64::from(twice.width()), (2.0 * drawn).round());
        dir.assert_fails("draw four-bar -o z.png --width 0", "--width");
        dir.assert_fails("draw four-bar -o z.png --width 99999", "too large");
    }
}
