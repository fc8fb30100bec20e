//! Drawings of motion: links stay rigid, what is published of a motion is seen, and readers can have it stand still.

use super::reading::{covers, moved};
use crate::common::*;

type Point = [f64; 2];

fn far(a: Point, b: Point) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// The pictures of a motion.
struct Frames {
    /// Where each joint stands, picture by picture.
    joints: Vec<BTreeMap<String, Point>>,
    /// The bars of each picture, in one order.
    bars: Vec<Vec<(Point, Point)>>,
    /// How many pictures are seen without a style sheet.
    seen: usize,
    svg: String,
}

fn frames(args: &[&str]) -> Frames {
    let svg = run_quiet(&[&["draw"], args, &["--motion"]].concat());
    let doc = roxmltree::Document::parse(&svg).unwrap();
    let number =
        |n: roxmltree::Node<'_, '_>, a: &str| n.attribute(a).unwrap().parse::<f64>().unwrap();
    let groups: Vec<_> = doc
        .descendants()
        .filter(|n| n.has_attribute("data-frame"))
        .collect();
    let joints = groups.iter().map(|g| {
        let used = g.children().filter(|c| c.has_tag_name("use"));
        let [dx, dy] = moved(*g);
        let place = |c: roxmltree::Node<'_, '_>| [number(c, "x") + dx, number(c, "y") + dy];
        used.map(|c| (c.attribute("data-joint").unwrap().to_owned(), place(c)))
            .collect()
    });
    let bars = groups.iter().map(|g| {
        let paths = g
            .children()
            .filter(|c| c.attribute("class").is_some_and(|k| k.starts_with("bone")));
        let ends = |d: &str| {
            let points: Vec<Point> = d[1..]
                .split('L')
                .map(|p| {
                    p.split_once(' ')
                        .map(|(x, y)| [x.parse().unwrap(), y.parse().unwrap()])
                        .unwrap()
                })
                .collect();
            (points[0], points[points.len() - 1])
        };
        paths.map(|p| ends(p.attribute("d").unwrap())).collect()
    });
    Frames {
        joints: joints.collect(),
        bars: bars.collect(),
        seen: groups
            .iter()
            .filter(|g| !g.has_attribute("visibility"))
            .count(),
        svg: svg.clone(),
    }
}

#[test]
fn bars_keep_their_lengths_while_joints_move() {
    for name in
        split_words("gripper-10 four-bar jansen-leg slider-crank-spatial watt-straight-line")
    {
        let f = frames(&[name, "--view", "z"]);
        assert!(f.bars.len() > 20, "{name}: {} pictures", f.bars.len());
        assert!(!f.bars[0].is_empty(), "{name}");
        for bars in &f.bars {
            assert_eq!(bars.len(), f.bars[0].len(), "{name}");
            for (now, before) in bars.iter().zip(&f.bars[0]) {
                let change = far(now.0, now.1) - far(before.0, before.1);
                assert!(
                    change.abs() < 0.1,
                    "{name}: a bar changes by {change} pixels"
                );
            }
        }
        let moved = f.joints[0]
            .iter()
            .map(|(id, &p)| f.joints.iter().map(|j| far(j[id], p)).fold(0.0, f64::max));
        assert!(moved.fold(0.0, f64::max) > 20.0, "{name} stands still");
    }
}

#[test]
fn the_tracing_point_of_peaucellier_moves_in_a_straight_line() {
    let f = frames(&["peaucellier", "--stroke", "-30deg:30deg:24"]);
    assert_eq!(f.joints.len(), 25);
    let xs: Vec<f64> = f.joints.iter().map(|j| j["6-7"][0]).collect();
    let ys: Vec<f64> = f.joints.iter().map(|j| j["6-7"][1]).collect();
    let spread = |v: &[f64]| {
        v.iter().fold(f64::MIN, |m, &x| m.max(x)) - v.iter().fold(f64::MAX, |m, &x| m.min(x))
    };
    assert!(spread(&xs) < 0.05, "{xs:?}");
    assert!(spread(&ys) > 50.0, "{ys:?}");
}

#[test]
fn a_crank_goes_round_and_a_slide_goes_to_and_fro() {
    let round = frames(&["slider-crank-spatial"]);
    assert!(round.svg.contains("makes a full turn"));
    assert!(!round.svg.contains("infinite alternate"));
    // in equal steps round a circle
    let crank: Vec<Point> = round.joints.iter().map(|j| j["1-2"]).collect();
    let step = far(crank[0], crank[1]);
    for (i, &p) in crank.iter().enumerate() {
        let next = crank[(i + 1) % crank.len()];
        assert!((far(p, next) - step).abs() < 0.05, "{i}");
    }
    let gripper = frames(&["gripper-10"]);
    assert!(gripper.svg.contains("infinite alternate"));
    has(&gripper.svg, " cm to ");
}

#[test]
fn a_rail_lies_along_its_slide_and_is_as_long_as_the_way() {
    for (name, joint) in [("scissor-lift", "3-0"), ("gripper-10", "0-1")] {
        let f = frames(&[name]);
        let doc = roxmltree::Document::parse(&f.svg).unwrap();
        let fixed = doc.descendants().filter(|n| {
            n.attribute("class") == Some("bone")
                && !n.ancestors().any(|a| a.has_attribute("data-frame"))
        });
        let lines = fixed.map(|n| {
            let points = covers(n);
            (points[0], points[points.len() - 1])
        });
        let longest = lines.max_by(|a, b| far(a.0, a.1).total_cmp(&far(b.0, b.1)));
        let (a, b) = longest.unwrap();
        assert!((a[1] - b[1]).abs() < 0.05, "{name}: level, as the slide is");
        let way: Vec<f64> = f.joints.iter().map(|j| j[joint][0]).collect();
        let (low, high) = (a[0].min(b[0]), a[0].max(b[0]));
        assert!(way.iter().all(|x| (low..high).contains(x)), "{name}");
    }
}

#[test]
fn motion_can_be_had_without_motion() {
    let f = frames(&["gripper-10"]);
    // without a style sheet, on paper and for those who ask for less motion, one picture is seen
    assert_eq!(f.seen, 1);
    let (rules, animated) = f
        .svg
        .split_once("@media screen and (prefers-reduced-motion:no-preference)")
        .unwrap();
    assert!(!rules.contains("animation:"));
    assert_eq!(animated.matches("animation:ozf").count(), f.joints.len());
    assert_eq!(f.svg.matches("@keyframes").count(), f.joints.len());
    // thirty pictures a second
    let seconds = f.joints.len() as f64 / 30.0;
    assert!(animated.contains(&format!("ozf0 {seconds:.2}s")));
    assert_eq!(
        f.svg,
        frames(&["gripper-10"]).svg,
        "the same bytes each time"
    );
}

#[test]
fn what_cannot_be_drawn_is_said() {
    // Once: "none can move", of a platform with eight motions.
    assert_all_fail(
        "
        draw gripper-10 --motion --stroke 0:90deg:30 | the drive slides
        draw jansen-leg --motion --stroke 0:90deg:9999 | 2 to 600
        draw jansen-leg --motion --drive 9-9 | no joint 9-9
        draw gripper-10 --motion --state clamped | 0-1:tz cannot move
        draw wren-platform --motion --drive 0-l0 | 0-l0:rx or 0-l0:ry or 0-l0:rz
        draw wren-platform --motion --drive 0-l0:tx | these can move: 0-l0:rx, 0-l0:ry, 0-l0:rz
        draw gripper-10 --kind scheme --view z | remove --kind scheme
        draw gripper-10 --view w | x, y, z, iso
        draw gripper-10 --view 0,0,0 | not all zero
        draw gripper-10 --up 1,2 | three numbers
        ",
    );
}

// Once refused: a platform on balls alone could be shown by its working motion only.
#[test]
fn a_freedom_of_a_ball_can_be_driven() {
    let f = frames(&["wren-platform", "--drive", "0-l0:rz"]);
    assert!(f.svg.contains("drive 0-l0:rz goes"));
    assert!(f.joints.len() > 2);
}

/// Where no joint can be a drive, the working motion is shown.
#[test]
fn what_no_joint_drives_is_shown_moving() {
    for name in split_words("griffis-duffy double-banana wren-platform shaft-two-bearings") {
        let pictures = frames(&[name]).joints.len();
        assert!(pictures > 10, "{name}: {pictures}");
    }
}
