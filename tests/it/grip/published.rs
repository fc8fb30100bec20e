//! The curves of figures 2 to 5 of `[Pavlenko & Godunko 2010]`, and what the paper found on them.

use super::lever;
use crate::common::{json, near, out};
use ozols::grip::contact::Gripper;
use ozols::grip::findings::{FINDINGS, REFUTED};
use ozols::grip::lever_arm::Arms;

/// L and D in millimetres, α and γ in degrees, and the pivots' distance where it is held.
#[derive(Clone, Copy)]
struct Case {
    length: f64,
    diameter: f64,
    prism: f64,
    mounting: f64,
    pivot: Option<f64>,
}

const fn case(length: f64, diameter: f64, prism: f64, mounting: f64) -> Case {
    Case {
        length,
        diameter,
        prism,
        mounting,
        pivot: None,
    }
}

impl Case {
    /// The arms in millimetres, where such a gripper can hold the part.
    fn arms(self) -> Option<Arms> {
        let lever = lever(self.length, self.prism, self.mounting);
        let mut gripper = Gripper::nominal(lever, self.diameter);
        gripper.pivot = self.pivot.unwrap_or(gripper.pivot);
        gripper.may_cross = true;
        let held = gripper.obstacles(self.diameter).is_empty();
        held.then(|| lever.arms(self.diameter))
    }
}

/// A numbered line of a figure where the part can be held: which arm, and its points.
struct Line {
    part: &'static str,
    points: Vec<(f64, f64)>,
}

impl Line {
    fn at(&self, x: f64) -> f64 {
        let point = self.points.iter().find(|p| (p.0 - x).abs() < 1e-9);
        point.unwrap().1
    }

    /// Least and greatest slope between neighbouring points.
    fn slopes(&self) -> (f64, f64) {
        let each = self.points.windows(2);
        bounds(each.map(|w| (w[1].1 - w[0].1) / (w[1].0 - w[0].0)))
    }
}

fn bounds(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| {
        (a.min(x), b.max(x))
    })
}

fn arm(part: &str, a: &Arms) -> f64 {
    match part {
        "l1" => a.l1,
        "l11" => a.l11,
        "l12" => a.l12,
        "l2" => a.l2,
        "l21" => a.l21,
        other => panic!("no arm {other}"),
    }
}

/// The lines of a figure over `range` of what `set` sets, each of 121 points.
fn figure(lines: &[(&'static str, Case)], range: (f64, f64), set: fn(&mut Case, f64)) -> Vec<Line> {
    let line = |&(part, from): &(&'static str, Case)| {
        let points = (0..=120).filter_map(|i| {
            let x = range.0 + (range.1 - range.0) * f64::from(i) / 120.0;
            let mut c = from;
            set(&mut c, x);
            Some((x, arm(part, &c.arms()?)))
        });
        Line {
            part,
            points: points.collect(),
        }
    };
    lines.iter().map(line).collect()
}

/// Arms over L (fig. 2), D (fig. 3), α (fig. 4) and γ (fig. 5), lines in the order of their numbers there.
fn figures() -> [Vec<Line>; 4] {
    let (a, b) = (case(0.0, 40.0, 120.0, 20.0), case(0.0, 100.0, 120.0, 20.0));
    let (c, mut held) = (case(0.0, 40.0, 90.0, 30.0), case(0.0, 60.0, 120.0, 20.0));
    held.pivot = Some(40.0);
    let length = [
        ("l1", a),
        ("l11", a),
        ("l2", a),
        ("l21", a),
        ("l1", b),
        ("l2", b),
        ("l1", c),
        ("l12", c),
        ("l2", c),
        ("l1", held),
        ("l2", held),
    ];
    let (a, b) = (case(100.0, 0.0, 120.0, 20.0), case(100.0, 0.0, 120.0, 30.0));
    let c = case(100.0, 0.0, 90.0, 30.0);
    let diameter = [
        ("l1", a),
        ("l11", a),
        ("l2", a),
        ("l21", a),
        ("l11", b),
        ("l1", b),
        ("l2", b),
        ("l1", c),
        ("l2", c),
    ];
    let (a, b) = (case(100.0, 40.0, 0.0, 30.0), case(100.0, 60.0, 0.0, 20.0));
    let c = case(80.0, 60.0, 0.0, 20.0);
    let prism = [
        ("l1", a),
        ("l11", a),
        ("l2", a),
        ("l21", a),
        ("l1", b),
        ("l2", b),
        ("l1", c),
        ("l2", c),
    ];
    let (a, b) = (case(100.0, 40.0, 120.0, 0.0), case(100.0, 60.0, 120.0, 0.0));
    let c = case(80.0, 60.0, 90.0, 0.0);
    let mounting = [
        ("l1", a),
        ("l2", a),
        ("l1", b),
        ("l2", b),
        ("l1", c),
        ("l2", c),
    ];
    [
        figure(&length, (40.0, 160.0), |c, x| c.length = x),
        figure(&diameter, (5.0, 125.0), |c, x| c.diameter = x),
        figure(&prism, (60.0, 140.0), |c, x| c.prism = x),
        figure(&mounting, (0.0, 40.0), |c, x| c.mounting = x),
    ]
}

/// [Pavlenko & Godunko 2010] figs. 2 to 5: the figures of equations (1) to (8) on their lines.
#[test]
fn lines_have_the_published_figures() {
    let [length, diameter, prism, mounting] = figures();
    near(length[0].at(100.0), 88.151, 5e-4);
    near(length[1].at(100.0), 76.604, 5e-4);
    near(length[2].at(100.0), 82.422, 5e-4);
    near(length[6].at(100.0), 70.000, 5e-4);
    near(length[8].at(100.0), 66.603, 5e-4);
    near(diameter[0].at(40.0), 88.151, 5e-4);
    near(diameter[4].at(40.0), 86.603, 5e-4);
    near(prism[0].at(90.0), 70.000, 5e-4);
    near(mounting[0].at(20.0), 88.151, 5e-4);
}

/// DIFFERENCE: the paper draws lines 10 and 11 of fig. 2, a = 40 fixed, less steep; by its own equations (1) and (2) the
/// arms do not depend on a, and the lines are parallel to lines 1 and 3.
#[test]
fn arms_with_the_pivots_held_are_as_steep_as_without() {
    let [length, ..] = figures();
    let rise = |line: usize| length[line - 1].at(100.0) - length[line - 1].at(80.0);
    near(rise(10), rise(1), 1e-9);
    near(rise(11), rise(3), 1e-9);
}

/// [Pavlenko & Godunko 2010], discussion and conclusions.
#[test]
fn the_findings_of_the_paper_are_confirmed() {
    let all = figures();
    let lines = |f: usize, part: &'static str| all[f].iter().filter(move |l| l.part == part);
    let range = |f: usize, part| {
        let each = lines(f, part).map(Line::slopes);
        bounds(each.flat_map(|(a, b)| [a, b]))
    };
    let bends = all[..2].iter().flatten().map(Line::slopes);
    assert!(bends.map(|(a, b)| b - a).fold(0.0, f64::max) < 1e-9);
    let (d1, d2) = (range(1, "l1"), range(1, "l2"));
    assert!(d1.0 > 0.0 && d2.1 < 0.0 && (d1.1 + d2.0).abs() < 1e-9);
    let (a1, a2) = (range(2, "l1"), range(2, "l2"));
    assert!(a1.0 > 0.0 && a2.0 > 0.0);
    let changes = |part| {
        let each = lines(3, part).map(|l| l.at(40.0) - l.points[0].1);
        each.collect::<Vec<f64>>()
    };
    let (c1, c2) = (changes("l1"), changes("l2"));
    assert!(c1.iter().all(|x| *x > 0.0) && c2.iter().all(|x| *x < 0.0));
    let (outweighs, _) = bounds(c1.iter().zip(&c2).map(|(a, b)| (a / b).abs()));
    assert!(outweighs > 1.5);
    let ratio = |((_, far), (_, near)): (&(f64, f64), &(f64, f64))| far / near;
    let ratios: Vec<f64> = (0..4)
        .flat_map(|f| lines(f, "l1").zip(lines(f, "l2")))
        .flat_map(|(far, near)| far.points.iter().zip(&near.points).map(ratio))
        .collect();
    let (least, most) = bounds(ratios.iter().copied());
    assert!(ratios.iter().any(|r| (r - 1.0).abs() < 0.01) && most > 2.0 && least < 1.0);
    let told = [
        format!(
            "{:.3} to {:.3} mm and {:.3} to {:.3} mm per mm of D",
            d1.0, d1.1, d2.0, d2.1
        ),
        format!(
            "from 60° to 140°: l1 by {:.3} to {:.3}, l2 by {:.3} to {:.3} mm per degree",
            a1.0, a1.1, a2.0, a2.1
        ),
        format!("from 0° to 40° l1 changes at least {outweighs:.2} times as much"),
        format!("l1/l2 from {least:.3} to {most:.3} on the curves"),
    ];
    for (finding, numbers) in FINDINGS[1..5].iter().zip(&told) {
        assert!(
            finding.evidence.starts_with(numbers),
            "{finding:?}: {numbers}"
        );
    }
    assert!(FINDINGS.iter().all(|f| f.holds));
}

/// The slope of lines 10 and 11 is told where the findings are, with the numbers of these curves.
#[test]
fn the_flatter_slope_is_told_to_be_refuted() {
    let [length, ..] = figures();
    let slope = |line: usize| (length[line - 1].at(160.0) - length[line - 1].at(40.0)) / 120.0;
    near(slope(10), slope(1), 1e-12);
    near(slope(11), slope(3), 1e-12);
    let told = format!("{:.3} and {:.3} mm per mm of L", slope(10), slope(11));
    assert!(REFUTED.evidence.contains(&told) && !REFUTED.holds, "{told}");
    let text = out(&["grip", "lever-gripper"]);
    assert!(
        text.contains("6 of 6 confirmed, and 1 drawing refuted"),
        "{text}"
    );
    assert!(text.contains("lines 10 and 11 of fig. 2"), "{text}");
    let value = json(&["grip", "lever-gripper", "--format", "json"]);
    assert_eq!(value["refuted"][0]["holds"], false);
}
