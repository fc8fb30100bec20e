//! The curves of figures 2 to 5 of `[Pavlenko & Godunko 2010]`, and what the paper found on them.

use super::lever;
use crate::common::*;
use ozols::grip::lever_arm::Arms;
use ozols::model::claim::{Claim, Topic};

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
        let mut gripper = Gripper::with_nominal(lever, self.diameter);
        gripper.pivot = self.pivot.unwrap_or(gripper.pivot);
        gripper.may_cross = true;
        let held = gripper.find_obstacles(self.diameter).is_empty();
        held.then(|| lever.force_arms(self.diameter))
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
    // Lines of one gripper: the arms that are drawn.
    let of = |arms: &'static str, c: Case| split_words(arms).into_iter().map(move |part| (part, c));
    let mut held = case(0.0, 60.0, 120.0, 20.0);
    held.pivot = Some(40.0);
    let length = of("l1 l11 l2 l21", case(0.0, 40.0, 120.0, 20.0))
        .chain(of("l1 l2", case(0.0, 100.0, 120.0, 20.0)))
        .chain(of("l1 l12 l2", case(0.0, 40.0, 90.0, 30.0)))
        .chain(of("l1 l2", held));
    let diameter = of("l1 l11 l2 l21", case(100.0, 0.0, 120.0, 20.0))
        .chain(of("l11 l1 l2", case(100.0, 0.0, 120.0, 30.0)))
        .chain(of("l1 l2", case(100.0, 0.0, 90.0, 30.0)));
    let prism = of("l1 l11 l2 l21", case(100.0, 40.0, 0.0, 30.0))
        .chain(of("l1 l2", case(100.0, 60.0, 0.0, 20.0)))
        .chain(of("l1 l2", case(80.0, 60.0, 0.0, 20.0)));
    let mounting = of("l1 l2", case(100.0, 40.0, 120.0, 0.0))
        .chain(of("l1 l2", case(100.0, 60.0, 120.0, 0.0)))
        .chain(of("l1 l2", case(80.0, 60.0, 90.0, 0.0)));
    [
        figure(&length.collect_vec(), (40.0, 160.0), |c, x| c.length = x),
        figure(&diameter.collect_vec(), (5.0, 125.0), |c, x| c.diameter = x),
        figure(&prism.collect_vec(), (60.0, 140.0), |c, x| c.prism = x),
        figure(&mounting.collect_vec(), (0.0, 40.0), |c, x| c.mounting = x),
    ]
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
    let slope = |figure: usize, line: usize| all[figure][line - 1].slopes().0;
    near(slope(0, 1), slope(0, 2), 1e-9);
    near(slope(0, 3), slope(0, 4), 1e-9);
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
    let grown = |line: usize| {
        let points = &all[2][line - 1].points;
        points.last().unwrap().1 - points[0].1
    };
    assert!(grown(7) < grown(5));
    let fixed = lever(100.0, 120.0, 30.0).force_arms(40.0);
    near(fixed.l11, fixed.l21, 1e-9);
    let told = [
        format!("{:.3} and {:.3} mm per mm of L", slope(0, 1), slope(0, 3)),
        format!(
            "{:.3} to {:.3} mm and {:.3} to {:.3} mm per mm of D",
            d1.0, d1.1, d2.0, d2.1
        ),
        format!(
            "{:.3} mm per mm of D at α = 120°, {:.3} at 90°",
            slope(1, 1),
            slope(1, 8)
        ),
        format!("{:.3} mm at L = 100", fixed.l11),
        format!(
            "from 60° to 140°: l1 by {:.3} to {:.3}, l2 by {:.3} to {:.3} mm per degree",
            a1.0, a1.1, a2.0, a2.1
        ),
        format!(
            "from 60° to 140° by {:.1} mm at L = 80 and {:.1} mm at L = 100",
            grown(7),
            grown(5)
        ),
        format!("from 0° to 40° l1 changes at least {outweighs:.2} times as much"),
    ];
    let claims = claims();
    let holds: Vec<&Claim> = claims.iter().filter(|c| c.holds()).collect();
    assert_eq!(holds.len(), 10);
    for numbers in &told {
        let mut those = holds.iter().filter(|c| c.evidence.starts_with(numbers));
        assert!(those.next().is_some(), "{numbers}: {holds:?}");
    }
    let apart = claim(&claims, "up to 2 to 3 times");
    assert_eq!(
        apart.evidence,
        format!("l1/l2 from {least:.3} to {most:.3} on the curves")
    );
    // It is up to 3 where the right says so, and beyond that more.
    let ratio = |length, diameter, prism, mounting| {
        let arms = lever(length, prism, mounting).force_arms(diameter);
        arms.l1 / arms.l2
    };
    assert!(ratio(56.2, 100.0, 120.0, 20.0) > 3.0 && ratio(56.3, 100.0, 120.0, 20.0) < 3.0);
    assert!(ratio(100.0, 104.9, 90.0, 30.0) < 3.0 && ratio(100.0, 105.0, 90.0, 30.0) > 3.0);
    let others = (0..4).flat_map(|f| {
        lines(f, "l1")
            .zip(lines(f, "l2"))
            .enumerate()
            .map(move |x| (f, x))
    });
    for (f, (i, (far, near))) in others {
        let both = far.points.iter().zip(&near.points);
        let most = bounds(both.map(|((_, a), (_, b))| (a / b).max(b / a))).1;
        assert_eq!(
            most > 3.0,
            matches!((f, i), (0, 1) | (1, 2)),
            "{f} {i}: {most}"
        );
    }
    // l11 is the longer part of l1 from where the right says so.
    let longer = |length, prism: f64, mounting, diameter| {
        let arms = lever(length, prism, mounting).force_arms(diameter);
        arms.l11 > arms.l12
    };
    for (length, mounting, diameter, from) in [
        (100.0, 30.0, 40.0, 75.1),
        (100.0, 20.0, 60.0, 88.1),
        (80.0, 20.0, 60.0, 91.4),
    ] {
        assert!(!longer(length, from - 0.1, mounting, diameter));
        assert!(longer(length, from + 0.1, mounting, diameter));
        let main = claim(&claims, "l11 is the main part");
        assert!(main.right.as_ref().unwrap().contains(&format!("{from}°")));
    }
}

/// The claim that says so.
fn claim<'c>(claims: &'c [Claim], says: &str) -> &'c Claim {
    let mut those = claims.iter().filter(|c| c.says.contains(says));
    let found = those.next().unwrap();
    assert!(those.next().is_none(), "{says}");
    found
}

/// What is published of the built-in gripper of the paper.
fn claims() -> Vec<Claim> {
    let claims = built_in("lever-gripper").into_parts().claims;
    assert!(claims.iter().all(|c| c.topic == Topic::Grip));
    claims
}

/// What the curves refute is told with the numbers that are right.
#[test]
fn what_the_curves_refute_is_told_with_what_is_right() {
    let [length, ..] = figures();
    let slope = |line: usize| (length[line - 1].at(160.0) - length[line - 1].at(80.0)) / 80.0;
    near(slope(10), slope(1), 1e-12);
    near(slope(11), slope(3), 1e-12);
    let claims = claims();
    let [held, steeper, parts, shorter] = [
        "with the pivots held",
        "faster with L where",
        "l12 and l22 grow",
        "γ makes l21 shorter",
    ]
    .map(|says| claim(&claims, says));
    let right = |c: &Claim| c.right.clone().unwrap();
    let told = format!("{:.3} and {:.3} mm per mm of L", slope(10), slope(11));
    assert!(right(held).contains(&told), "{told}");
    // l2 over L at one γ and two α, and l1 beside it.
    let slope = |part: &str, prism: f64| {
        let at = |x: f64| arm(part, &lever(x, prism, 30.0).force_arms(40.0));
        (at(160.0) - at(80.0)) / 80.0
    };
    near(slope("l2", 90.0), slope("l2", 120.0), 1e-12);
    let told = [slope("l2", 90.0), slope("l1", 90.0), slope("l1", 120.0)];
    assert!(told[1] < told[2]);
    for number in told.map(|x| format!("{x:.3}")) {
        assert!(steeper.evidence.contains(&number), "{number}: {steeper:?}");
    }
    near(slope("l12", 90.0), 0.0, 1e-12);
    assert_eq!(right(parts), "they do not depend on L");
    let [from, to] = [0.0, 40.0].map(|mounting| lever(100.0, 120.0, mounting).force_arms(40.0));
    for number in [from.l21 - to.l21, to.l11 - from.l11] {
        assert!(number > 0.0 && shorter.evidence.contains(&format!("{number:.1} mm")));
    }
}

/// In text and JSON, under the gripper of the paper and no other.
#[test]
fn claims_are_told_of_the_gripper_of_the_paper_alone() {
    let value = run_json("grip lever-gripper --format json");
    assert_eq!(value["claims"].list().len(), 17);
    assert_eq!(value["claims"][0]["right"], Value::Null);
    assert_eq!(value["claims"][13]["holds"], false);
    assert!(value["claims"][13]["right"].is_string());
    assert_eq!(value["claims"][13]["scan"], Value::Null);
    assert!(value["claims"][10]["scan"].is_string());
    // A gripper of one's own, started from that one.
    let folder = Folder::new();
    folder.succeed("new mine.toml --from lever-gripper");
    assert_eq!(folder.json("grip mine.toml")["claims"], json!([]));
}

/// Figs. 2, 4 and 5 as charts, each point by the equations as they are printed.
#[test]
fn figures_are_charts_of_any_gripper() {
    let text = "name = \"curves\"\nlength_unit = \"mm\"\n[workload.grip]\nlever_length = 100\nprism_angle = 120\n\
        mounting_angle = 20\ndiameter = 60\ndiameters = [40, 60, 100]\npivots = \"nominal\"\nlevers_cross = true\n";
    let folder = Folder::with("curves.toml", text);
    folder.succeed("grip curves.toml --svg charts");
    for (name, at) in [("length", 0), ("prism-angle", 1), ("mounting-angle", 2)] {
        let table = folder.text(&format!("charts/arms-over-{name}.csv"));
        let mut seen = BTreeMap::new();
        for line in table.lines().skip(1) {
            let (series, rest) = line[1..].split_once("\",").unwrap();
            let (arm, diameter) = series.split_once(", D = ").unwrap();
            let diameter: f64 = diameter.parse().unwrap();
            let (x, y) = rest.split_once(',').unwrap();
            let [x, y]: [f64; 2] = [x, y].map(|n| n.parse().unwrap());
            let mut own = [100.0, 120f64, 20f64];
            own[at] = x;
            let [length, prism, mounting] = [own[0], own[1].to_radians(), own[2].to_radians()];
            let part = diameter / 2.0 * (std::f64::consts::FRAC_PI_2 - prism / 2.0).tan();
            let (far, near_part) = (
                length * (PI - prism - mounting).cos(),
                length * mounting.cos(),
            );
            let value = match arm {
                "l1" => far + part,
                "l2" => near_part - part,
                "l11" => far,
                "l12 = l22" => part,
                "l21" => near_part,
                other => panic!("{other}"),
            };
            near(y, value, 1e-9 * length);
            *seen.entry(series.to_owned()).or_insert(0) += 1;
        }
        assert_eq!(seen.len(), 9, "{name}: {seen:?}");
        assert!(seen.values().all(|&n| n > 20), "{name}: {seen:?}");
    }
}
