//! Kinematic schemes are true: joints of one place stand in one place, links join the places of their joints, and what is in
//! different places does not overlap.

use super::reading::{covers, moved};
use super::subject;
use crate::common::*;
use ozols::draw::{Sight, Subject, kinematic_seen};

pub(super) type Point = [f64; 2];

fn far(a: Point, b: Point) -> f64 {
    let d = sub(a, b);
    d[0].hypot(d[1])
}

/// What a kinematic scheme shows, read back from its SVG.
pub(super) struct Shown {
    /// Where each joint stands.
    pub(super) joints: BTreeMap<String, Point>,
    /// The filled shapes of each joint's symbol.
    symbols: BTreeMap<String, Vec<Vec<Point>>>,
    /// The corners of each link, and whether it is a plate.
    links: BTreeMap<String, (Vec<Point>, bool)>,
    /// Where each point of interest stands.
    points: BTreeMap<String, Point>,
}

/// The corners of a shape; of a circle, those of a polygon in it.
fn outline(n: roxmltree::Node<'_, '_>) -> Vec<Point> {
    let points = covers(n);
    if !n.has_tag_name("circle") {
        return points;
    }
    let (low, high) = (points[0], points[1]);
    let radius = (high[0] - low[0]) / 2.0;
    let corner = |i: i32| {
        let angle = TAU * f64::from(i) / 24.0;
        [
            low[0] + radius * (1.0 + angle.cos()),
            low[1] + radius * (1.0 + angle.sin()),
        ]
    };
    (0..24).map(corner).collect()
}

pub(super) fn shown(d: &Drawing) -> Shown {
    let doc = roxmltree::Document::parse(&d.svg).unwrap();
    let groups = |name: &'static str| {
        doc.descendants()
            .filter_map(move |n| Some((n, n.attribute(name)?.to_owned())))
    };
    let joints = groups("data-joint").map(|(n, id)| (id, moved(n)));
    let filled = |n: &roxmltree::Node<'_, '_>| {
        let class = n.attribute("class").unwrap_or_default();
        ["joint", "ink"]
            .iter()
            .any(|c| class.split(' ').any(|k| k == *c))
    };
    let symbols = groups("data-joint").map(|(n, id)| {
        let shapes = n.children().filter(|c| c.is_element() && filled(c));
        (id, shapes.map(outline).collect())
    });
    let links = groups("data-link").filter_map(|(n, id)| {
        let path = n.children().find(|c| c.has_tag_name("path"))?;
        let plate = path.attribute("class").unwrap().starts_with("plate");
        assert_eq!(plate, path.attribute("d").unwrap().ends_with('Z'));
        Some((id, (covers(path), plate)))
    });
    let points = groups("data-point").map(|(n, id)| {
        let corners = covers(n.first_element_child().unwrap());
        let [x, y] = [0, 1].map(|i| corners.iter().map(|c| c[i]).sum::<f64>());
        let all = corners.len() as f64;
        (id, [x / all, y / all])
    });
    Shown {
        points: points.collect(),
        joints: joints.collect(),
        symbols: symbols.collect(),
        links: links.collect(),
    }
}

pub(super) fn point(m: &Mechanism, j: JointId) -> [f64; 3] {
    m.joints[j].frame.point.each_ref().map(Expr::to_f64)
}

pub(super) fn axis(m: &Mechanism, j: JointId) -> [f64; 3] {
    unit(to_vector(&m.joints[j].frame.axis))
}

/// Each built-in mechanism in each state, drawn.
pub(super) fn all(mut look: impl FnMut(&str, &Mechanism, StateId, &Drawing, &Shown)) {
    for name in builtin::names() {
        let m = built_in(name);
        for state in m.state_ids() {
            let d = kinematic(&Subject {
                mechanism: &m,
                state,
                analysis: None,
                marks: None,
            });
            look(name, &m, state, &d, &shown(&d));
        }
    }
}

#[test]
fn joints_of_one_pin_stand_in_one_place() {
    let (mut wrong, mut pairs) = (Vec::new(), 0);
    all(|name, m, state, d, shown| {
        // axes that meet in a point are drawn apart, each joint somewhere on its axis
        if d.svg.contains("stand farther along their axes") {
            return;
        }
        let joints: Vec<JointId> = m.joints_in(state).collect();
        for (n, &a) in joints.iter().enumerate() {
            for &b in &joints[..n] {
                let same = (0..3).all(|i| (point(m, a)[i] - point(m, b)[i]).abs() < 1e-12);
                let (z, w) = (axis(m, a), axis(m, b));
                let along = (0..3).map(|i| z[i] * w[i]).sum::<f64>().abs() > 1.0 - 1e-12;
                if same && along {
                    pairs += 1;
                    let [p, q] = [a, b].map(|j| shown.joints[&m.joints[j].id]);
                    if far(p, q) > 0.02 {
                        wrong.push(format!("{name}: {} and {}", m.joints[a].id, m.joints[b].id));
                    }
                }
            }
        }
    });
    assert!(pairs > 60, "{pairs}");
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn plane_mechanisms_are_drawn_to_scale() {
    let mut seen = 0;
    all(|name, m, state, d, shown| {
        let joints: Vec<JointId> = m.joints_in(state).collect();
        let first = point(m, joints[0]);
        let flat = joints
            .iter()
            .all(|&j| (point(m, j)[2] - first[2]).abs() < 1e-9);
        if !(flat && d.svg.contains("Kinematic scheme seen along z")) {
            return;
        }
        seen += 1;
        let apart = |a: JointId, b: JointId| {
            let [p, q] = [a, b].map(|j| [point(m, j)[0], point(m, j)[1]]);
            let [x, y] = [a, b].map(|j| shown.joints[&m.joints[j].id]);
            (far(p, q), far(x, y))
        };
        let pairs: Vec<(f64, f64)> = joints
            .iter()
            .flat_map(|&a| joints.iter().map(move |&b| (a, b)))
            .map(|(a, b)| apart(a, b))
            .collect();
        let (space, paper) = pairs
            .iter()
            .fold((0.0, 0.0), |most, &p| if p.0 > most.0 { p } else { most });
        for (s, p) in pairs {
            let off = p - s * paper / space.max(1e-300);
            assert!(off.abs() < 0.1, "{name}: {s} is {p} pixels, off by {off}");
        }
    });
    assert!(seen > 30, "{seen}");
}

#[test]
fn links_join_the_places_of_their_joints() {
    let (mut bars, mut plates) = (0, 0);
    all(|name, m, state, _, shown| {
        for (l, link) in m.links_with_ids() {
            let own = m.points.iter().filter(|p| p.link == l).map(|p| &p.id);
            // the face of a jaw, where the object is not there
            let faces = m
                .joints
                .iter()
                .filter(|j| link.role == Role::Output && j.links.contains(&l))
                .map(|j| &j.id);
            let places: Vec<Point> = m
                .joints_in(state)
                .filter(|&j| m.joints[j].links.contains(&l))
                .map(|j| shown.joints[&m.joints[j].id])
                .chain(
                    own.chain(faces)
                        .filter_map(|id| shown.points.get(id).copied()),
                )
                .collect();
            let Some((corners, plate)) = shown.links.get(&link.id) else {
                let one = places.iter().all(|&p| far(p, places[0]) < 2.0);
                assert!(
                    link.role == Role::Frame || one,
                    "{name}: no link {}",
                    link.id
                );
                continue;
            };
            if places.len() < 2 {
                continue;
            }
            let is_place = |c: &Point| places.iter().any(|&p| far(p, *c) < 0.05);
            // a straight line stays straight, however many joints it has
            let (a, b) = places
                .iter()
                .flat_map(|&a| places.iter().map(move |&b| (a, b)))
                .max_by(|p, q| far(p.0, p.1).total_cmp(&far(q.0, q.1)))
                .unwrap();
            let off = |p: Point| cross_plane(sub(b, a), sub(p, a)) / far(a, b).max(1e-9);
            let offs: Vec<f64> = places.iter().map(|&p| off(p)).collect();
            let wide = offs.iter().fold(0.0f64, |m, x| m.max(*x))
                - offs.iter().fold(0.0f64, |m, x| m.min(*x));
            assert_eq!(
                *plate,
                wide > 2.0,
                "{name}: link {} is {wide} wide",
                link.id
            );
            if *plate {
                plates += 1;
                assert!(corners.iter().all(is_place), "{name}: plate {}", link.id);
            } else {
                bars += 1;
                assert!(
                    is_place(&corners[0]) && is_place(&corners[corners.len() - 1]),
                    "{name}: bar {}",
                    link.id
                );
            }
        }
    });
    assert!(bars > 300 && plates > 60, "{bars} {plates}");
}

/// Whether two convex shapes share more than an edge: no line parts them.
fn overlap(a: &[Point], b: &[Point]) -> bool {
    let parted = |a: &[Point], b: &[Point]| {
        (0..a.len()).any(|i| {
            let (p, q) = (a[i], a[(i + 1) % a.len()]);
            let length = far(p, q);
            if length < 1e-6 {
                return false;
            }
            let off = |x: &Point| cross_plane(sub(q, p), sub(*x, p)) / length;
            let span = |of: &[Point]| {
                let all = of.iter().map(off);
                all.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), d| {
                    (l.min(d), h.max(d))
                })
            };
            let ((al, ah), (bl, bh)) = (span(a), span(b));
            ah < bl + 0.5 || bh < al + 0.5
        })
    };
    !parted(a, b) && !parted(b, a)
}

#[test]
fn symbols_in_different_places_do_not_overlap() {
    let mut wrong = Vec::new();
    all(|name, _, _, _, shown| {
        let ids: Vec<&String> = shown.joints.keys().collect();
        for (n, &a) in ids.iter().enumerate() {
            for &b in &ids[..n] {
                if far(shown.joints[a], shown.joints[b]) < 1.5 {
                    continue;
                }
                let hit = shown.symbols[a]
                    .iter()
                    .any(|s| shown.symbols[b].iter().any(|t| overlap(s, t)));
                if hit {
                    wrong.push(format!("{name}: {a} and {b}"));
                }
            }
        }
    });
    assert!(wrong.is_empty(), "{} {wrong:#?}", wrong.len());
}

#[test]
fn no_bar_lies_on_another() {
    let mut wrong = Vec::new();
    all(|name, _, _, _, shown| {
        let bars: Vec<(&String, Point, Point)> = shown
            .links
            .iter()
            .filter(|(_, (c, plate))| !plate && c.len() == 2)
            .map(|(id, (c, _))| (id, c[0], c[1]))
            .collect();
        for (n, &(one, a, b)) in bars.iter().enumerate() {
            for &(other, c, d) in &bars[..n] {
                let length = far(a, b);
                let off = |p: Point| (cross_plane(sub(b, a), sub(p, a)) / length).abs();
                let at =
                    |p: Point| (sub(b, a)[0] * sub(p, a)[0] + sub(b, a)[1] * sub(p, a)[1]) / length;
                let shared = at(c).max(at(d)).min(length) - at(c).min(at(d)).max(0.0);
                if off(c) < 1.0 && off(d) < 1.0 && shared > 10.0 {
                    wrong.push(format!("{name}: {one} on {other}"));
                }
            }
        }
    });
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn the_frame_is_drawn_once_at_each_of_its_places() {
    all(|name, m, state, d, shown| {
        let of: Vec<JointId> = m.joints_in(state).collect();
        let mut places: Vec<Point> = Vec::new();
        for &j in of
            .iter()
            .filter(|&&j| m.joints[j].links.contains(&m.frame_link()))
        {
            let p = shown.joints[&m.joints[j].id];
            if !places.iter().any(|&q| far(p, q) < 1.6) {
                places.push(p);
            }
        }
        assert_eq!(d.symbols.len(), of.len() + places.len(), "{name}");
    });
}

#[test]
fn a_side_can_be_asked_for() {
    let m = built_in("bennett");
    let subject = subject(&m);
    let seen = |toward: [f64; 3], up: Option<[f64; 3]>| {
        let sight = Sight {
            toward: Some(toward),
            up,
        };
        shown(&kinematic_seen(&subject, &sight, None)).joints
    };
    // what is seen along z are the x and y of the file, with y upwards
    let joints: Vec<JointId> = m.joint_ids().collect();
    let ratio = |of: &BTreeMap<String, Point>, across: [f64; 3], up: [f64; 3]| {
        let at = |j: JointId| of[&m.joints[j].id];
        let along = |j: JointId, v: [f64; 3]| (0..3).map(|i| v[i] * point(&m, j)[i]).sum::<f64>();
        let (mut scales, first) = (Vec::new(), joints[0]);
        for &j in &joints[1..] {
            let (p, q) = (at(first), at(j));
            for (paper, space) in [
                (q[0] - p[0], along(j, across) - along(first, across)),
                (p[1] - q[1], along(j, up) - along(first, up)),
            ] {
                if space.abs() > 1e-3 {
                    scales.push(paper / space);
                } else {
                    assert!(paper.abs() < 0.5, "{paper} for {space}");
                }
            }
        }
        for s in &scales {
            assert!((s / scales[0] - 1.0).abs() < 0.01, "{scales:?}");
        }
        assert!(scales[0] > 0.0, "{scales:?}");
    };
    let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    ratio(&seen(z, None), x, y);
    ratio(&seen([0.0, -2.0, 0.0], None), x, z);
    ratio(&seen([3.0, 0.0, 0.0], None), y, z);
    ratio(&seen(z, Some(x)), y.map(|v| -v), x);
    let half = 0.5f64.sqrt();
    ratio(&seen([1.0, -1.0, 0.0], None), [half, half, 0.0], z);
}
