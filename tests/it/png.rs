//! Drawings as PNG. Most of it needs the feature `png`: `cargo test --features png --test integration png`.

use crate::common::ozols;

fn refused(args: &[&str], what: &str) {
    let done = ozols(args).output().unwrap();
    let said = String::from_utf8_lossy(&done.stderr).into_owned();
    assert_eq!(done.status.code(), Some(2), "{args:?}: {said}");
    assert!(said.contains(what), "{args:?}: {said}");
    assert!(done.stdout.is_empty());
}

#[test]
fn sizes_are_for_png() {
    refused(&["draw", "bennett", "--scale", "2"], "--scale and --width");
    refused(&["draw", "bennett", "--width", "90"], "--scale and --width");
}

#[cfg(not(feature = "png"))]
#[test]
fn a_build_without_png_says_so() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("x.PNG");
    let path = path.to_str().unwrap();
    refused(&["draw", "bennett", "--png"], "--features png");
    // the name asks for it
    refused(&["draw", "bennett", "-o", path], "--features png");
    assert_eq!(dir.path().read_dir().unwrap().count(), 0);
}

#[cfg(feature = "png")]
mod with_png {
    use super::refused;
    use crate::common::ozols;
    use ozols::draw::png::png;
    use ozols::draw::{Drawing, Rect, Size, Subject, kinematic, scheme};
    use ozols::file::text::mechanism_from_str;
    use resvg::tiny_skia::Pixmap;

    fn drawings(name: &str) -> [Drawing; 2] {
        let text = ozols::builtin::text(name).unwrap();
        let m = mechanism_from_str(name, text).unwrap();
        let subject = Subject {
            mechanism: &m,
            state: ozols::model::mechanism::StateId::FREE,
            analysis: None,
            marks: None,
        };
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
                let made = png(&d, Size::Scale(1.5)).unwrap();
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

    #[test]
    fn the_same_bytes_each_time() {
        let [d, _] = drawings("four-bar");
        let once = png(&d, Size::Scale(2.0)).unwrap().png;
        assert_eq!(once, png(&d, Size::Scale(2.0)).unwrap().png);
    }

    #[test]
    fn too_large_is_an_error() {
        let [d, _] = drawings("four-bar");
        for size in [
            Size::Scale(1e9),
            Size::Scale(f64::NAN),
            Size::Width(u32::MAX),
        ] {
            assert!(png(&d, size).is_err(), "{size:?}");
        }
    }

    #[test]
    fn command_line() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("x.png");
        let path = path.to_str().unwrap();
        let done = ozols(&["draw", "four-bar", "-o", path, "--width", "321"])
            .output()
            .unwrap();
        assert!(
            done.status.success(),
            "{}",
            String::from_utf8_lossy(&done.stderr)
        );
        let file = std::fs::read(path).unwrap();
        let picture = Pixmap::decode_png(&file).unwrap();
        assert_eq!(picture.width(), 321);
        let piped = ozols(&["draw", "four-bar", "--png", "--width", "321"])
            .output()
            .unwrap();
        assert_eq!(piped.stdout, file);
        refused(&["draw", "four-bar", "--png", "--scale", "0"], "--scale");
        refused(&["draw", "four-bar", "--png", "--width", "0"], "--width");
        refused(
            &["draw", "four-bar", "--png", "--width", "99999"],
            "too large",
        );
    }
}
