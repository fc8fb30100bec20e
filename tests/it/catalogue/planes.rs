//! The planes in which links pass each other, against what meets at poses solved afresh and all ways of stacking links.

use super::paired::twin_figures::filed::Gripper;
use super::stroke::read_layout;
use super::{Drawn, each_structure, each_structure_of, form_of, layout};
use crate::common::*;
use ozols::chains::Symmetry;
use ozols::synthesis::stroke::planes::Stacking;

type Point = [f64; 2];

/// A point of a link, and which it is: a pin by its number, or the tip of a jaw.
type Named = (Result<usize, usize>, Point);

/// The points of a link at a pose.
fn points(g: &Gripper, x: &[f64], link: usize) -> Vec<Named> {
    let pins = g.joints.iter().enumerate();
    let own = pins.filter(|(_, j)| j.links.contains(&link));
    let own = own.map(|(i, j)| (Ok(i), g.on(x, j, j.pin)));
    let jaw = g.jaws.iter().position(|&j| j == link);
    let tip = jaw.map(|n| (Err(n), g.tip(x, n)));
    own.chain(tip).collect()
}

fn distance(a: Point, b: Point) -> f64 {
    length(sub(a, b))
}

/// How far a point is from a bar or a plate: 0 within. A plate is all between its points, two by two.
fn off(body: &[Named], p: Point) -> f64 {
    let corners: Vec<Point> = body.iter().map(|(_, at)| *at).collect();
    let bars = corners.iter().tuple_combinations();
    let off = |(a, b): (&Point, &Point)| -> f64 {
        // By cutting the bar in thirds towards the nearer end.
        let at = |t: f64| [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
        let (mut lo, mut hi) = (0.0, 1.0);
        for _ in 0..80 {
            let (m, n) = (lo + (hi - lo) / 3.0, hi - (hi - lo) / 3.0);
            if distance(at(m), p) < distance(at(n), p) {
                hi = n
            } else {
                lo = m
            }
        }
        distance(at(lo), p)
    };
    let nearest = bars.map(off).fold(f64::INFINITY, f64::min);
    // Within a triangle of its points the angles seen from there make a whole turn.
    let angle = |a: &Point, b: &Point| {
        let [u, v] = [a, b].map(|q| [q[0] - p[0], q[1] - p[1]]);
        (u[0] * v[1] - u[1] * v[0]).atan2(u[0] * v[0] + u[1] * v[1])
    };
    let mut triangles = corners.iter().tuple_combinations();
    let within = triangles.any(|(a, b, c)| (angle(a, b) + angle(b, c) + angle(c, a)).abs() > 6.0);
    if within { 0.0 } else { nearest }
}

/// Whether two bars cross, neither at an end: solved for where.
fn cross([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let [u, v] = [[b[0] - a[0], b[1] - a[1]], [d[0] - c[0], d[1] - c[1]]];
    let w = [c[0] - a[0], c[1] - a[1]];
    let det = u[0] * v[1] - u[1] * v[0];
    let s = (w[0] * v[1] - w[1] * v[0]) / det;
    let t = (w[0] * u[1] - w[1] * u[0]) / det;
    [s, t].iter().all(|x| (0.0..=1.0).contains(x))
}

/// What meets over a stroke where whatever comes nearer than `near` does.
struct Met {
    overlaps: Vec<(usize, usize)>,
    over_pins: Vec<(usize, usize)>,
    /// (jaw, link)
    over_tips: Vec<(usize, usize)>,
}

impl Met {
    fn new(g: &Gripper, all: &[Vec<f64>], near: f64) -> Met {
        let (frame, jaws) = (g.frame, &g.jaws);
        let moving = || (0..g.links).filter(|k| *k != frame);
        let mut met = Met {
            overlaps: (g.joints.iter())
                .filter(|j| !j.links.contains(&frame))
                .map(|j| j.links.into())
                .collect(),
            over_pins: Vec::new(),
            over_tips: Vec::new(),
        };
        for x in all {
            let body = |k: usize| points(g, x, k);
            for (k, m) in moving().tuple_combinations() {
                let sides = |k: usize| {
                    body(k)
                        .into_iter()
                        .tuple_combinations::<(Named, Named)>()
                        .collect_vec()
                };
                let crossing = sides(k).iter().cartesian_product(&sides(m)).any(|(x, y)| {
                    let names = [x.0.0, x.1.0, y.0.0, y.1.0];
                    let tip = |side: &(Named, Named)| {
                        [side.0, side.1].into_iter().find(|(n, _)| n.is_err())
                    };
                    let closed = tip(x)
                        .zip(tip(y))
                        .is_some_and(|(a, b)| distance(a.1, b.1) < near.max(6.0));
                    names.iter().all_unique() && !closed && cross([x.0.1, x.1.1], [y.0.1, y.1.1])
                });
                if crossing {
                    met.overlaps.push((k, m));
                }
            }
            for (i, j) in g.joints.iter().enumerate() {
                let ([u, v], p) = (j.links, g.on(x, j, j.pin));
                for k in moving().filter(|k| ![u, v].contains(k) && off(&body(*k), p) < near) {
                    met.over_pins.push((i, k));
                    met.overlaps
                        .extend([u, v].into_iter().filter(|o| *o != frame).map(|o| (o, k)));
                }
            }
            for (n, &jaw) in jaws.iter().enumerate() {
                let p = g.tip(x, n);
                let others = moving().filter(|k| !jaws.contains(k) && off(&body(*k), p) < near);
                met.over_tips.extend(others.map(|k| (jaw, k)));
            }
        }
        met.overlaps = met.overlaps.into_iter().unique().collect();
        met.over_pins = met.over_pins.into_iter().unique().collect();
        met.over_tips = met.over_tips.into_iter().unique().collect();
        met
    }

    /// Whether nothing meets with links in these planes, the frame in 0 and, where it is in front too, in `front`.
    fn passes(&self, g: &Gripper, at: &[usize], front: Option<usize>) -> bool {
        let blocked = |pin: usize, lo: usize, hi: usize| {
            let mut over = self.over_pins.iter().filter(|(p, _)| *p == pin);
            over.any(|&(_, k)| lo < at[k] && at[k] < hi)
        };
        self.overlaps.iter().all(|&(k, m)| at[k] != at[m])
            && self
                .over_tips
                .iter()
                .all(|&(jaw, k)| front.is_none() && at[k] < at[jaw])
            && g.joints.iter().enumerate().all(|(i, j)| {
                let [u, v] = j.links;
                let (lo, hi) = (at[u].min(at[v]), at[u].max(at[v]));
                let in_front = front.filter(|_| j.links.contains(&g.frame));
                !blocked(i, lo, hi) || in_front.is_some_and(|f| !blocked(i, hi, f))
            })
    }

    /// Whether so many planes can be enough.
    fn can(&self, g: &Gripper, planes: usize) -> bool {
        [None, Some(planes - 1)].into_iter().any(|front| {
            let last = front.unwrap_or(planes);
            let mut ways = (1..g.links).map(|_| 1..last).multi_cartesian_product();
            ways.any(|mut at| {
                at.insert(g.frame, 0);
                self.passes(g, &at, front)
            })
        })
    }
}

/// What is told passes with a millimetre less room, and nothing in fewer planes does with a millimetre more.
fn is_as_the_twin_says(s: &Structure, l: &Drawn) -> Stacking {
    let f = layout_figures(s, l).unwrap();
    let g = &read_layout(s, l);
    // Where jaws turn back or links lock, a little before.
    let end = |k: usize, before: f64| f.openings[k] + f.ends[k].map_or(0.0, |_| before);
    let all = g.stroke(end(0, 1e-3), end(1, -1e-3));
    match &f.stacking {
        Stacking::Planes {
            planes,
            of_link,
            in_front,
        } => {
            let front = in_front.then_some(planes - 1);
            assert!(
                of_link
                    .iter()
                    .enumerate()
                    .all(|(k, at)| (*at == 0) == (k == g.frame))
            );
            assert!(of_link.iter().all(|at| *at < front.unwrap_or(*planes)));
            let tight = Met::new(g, &all, 5.0);
            assert!(
                tight.passes(g, of_link, front),
                "{}: {}",
                s.name(),
                f.stacking
            );
            let roomy = Met::new(g, &all, 7.0);
            assert!(
                *planes == 2 || !roomy.can(g, planes - 1),
                "{}: {}",
                s.name(),
                f.stacking
            );
        }
        Stacking::Meets => {
            let roomy = Met::new(g, &all, 7.0);
            assert!(!roomy.can(g, g.links), "{}", s.name());
        }
        Stacking::NotAsked => panic!("{}", s.name()),
    }
    f.stacking
}

#[test]
fn links_pass_in_the_planes_told_and_in_no_fewer() {
    let mut found = Vec::new();
    for (links, input, symmetry, every) in [
        (4, Input::Slide, Symmetry::Generic, 1),
        (6, Input::Slide, Symmetry::Generic, 4),
        (6, Input::Turn, Symmetry::Generic, 4),
        (6, Input::Slide, Symmetry::Mirror, 1),
        (6, Input::Turn, Symmetry::HalfTurn, 1),
        (8, Input::Slide, Symmetry::Mirror, 2),
    ] {
        let mut n = 0;
        each_structure(links, &[form_of(input, symmetry, false)], |_, s| {
            n += 1;
            if n % every == 0
                && let Ok(l) = layout(&s, &Limits::default(), 1)
            {
                found.push(is_as_the_twin_says(&s, &l));
            }
        });
    }
    each_structure_of(
        8,
        3,
        &[form_of(Input::Turn, Symmetry::Threefold, false)],
        |_, s| {
            if let Ok(l) = layout(&s, &Limits::default(), 1) {
                found.push(is_as_the_twin_says(&s, &l));
            }
        },
    );
    let planes = found.iter().filter_map(|s| match s {
        Stacking::Planes { planes, .. } => Some(*planes),
        _ => None,
    });
    let counts = planes.counts();
    assert!(
        counts.len() > 2 && counts.values().sum::<usize>() > 20,
        "{counts:?}"
    );
}

/// Of these the cheapest places, which keep all limits and do the task, are such that links meet in whatever planes.
#[test]
fn what_can_be_built_is_taken_before_what_is_cheaper() {
    let names = [
        "G_A_zo 5-0 3,4 slide generic",
        "G``HOk 4-0 2,7 turn generic",
    ];
    let forms = [Input::Slide, Input::Turn].map(|input| form_of(input, Symmetry::Generic, false));
    let mut found = 0;
    each_structure(8, &forms, |_, s| {
        if names.contains(&s.name().as_str()) {
            found += 1;
            let l = layout(&s, &Limits::default(), 1).unwrap();
            let figures = layout_figures(&s, &l).unwrap();
            assert!(figures.shortfall.is_none() && figures.stacking.is_known());
        }
    });
    assert_eq!(found, names.len());
}
