//! The arms over each parameter in turn, and what `[Pavlenko & Godunko 2010]` found from such charts, confirmed.

use crate::chart::{Axis, Chart, Scale, Series, Style};
use crate::grip::contact::Gripper;
use crate::grip::lever_arm::{Arms, Lever};

/// Which curve of the arms.
type Part = (&'static str, fn(&Arms) -> f64);
const L1: Part = ("l1", |a| a.l1);
const L11: Part = ("l11", |a| a.l11);
const L12: Part = ("l12", |a| a.l12);
const L2: Part = ("l2", |a| a.l2);
const L21: Part = ("l21", |a| a.l21);
const L11_L21: Part = ("l11 = l21", |a| a.l11);

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
        let lever = Lever::new(
            self.length,
            self.prism.to_radians(),
            self.mounting.to_radians(),
        )
        .ok()?;
        let mut gripper = Gripper::nominal(lever, self.diameter);
        gripper.pivot = self.pivot.unwrap_or(gripper.pivot);
        gripper.may_cross = true;
        gripper
            .obstacles(self.diameter)
            .is_empty()
            .then(|| lever.arms(self.diameter))
    }
}

/// The arms where the part can be held, and gaps where it cannot.
fn curve(
    n: usize,
    part: Part,
    what: &str,
    from: Case,
    set: fn(&mut Case, f64),
    (first, last): (f64, f64),
) -> Series {
    let points = (0..=120).map(|i| {
        let x = first + (last - first) * f64::from(i) / 120.0;
        let mut c = from;
        set(&mut c, x);
        (x, c.arms().map_or(f64::NAN, |a| part.1(&a)))
    });
    let style = if part.0.len() > 2 {
        Style::Dashed
    } else {
        Style::Line
    };
    Series {
        name: format!("{n}: {} ({what})", part.0),
        points: points.filter(|p| p.1.is_finite()).collect(),
        style,
    }
}

fn chart(title: &str, x: &str, series: Vec<Series>) -> Chart {
    Chart {
        title: title.to_owned(),
        subtitle: "Where the part can be held: both arms positive. Where l2 > l1 the levers cross, in planes of their own."
            .to_owned(),
        x: Axis {
            label: x.to_owned(),
            scale: Scale::Linear,
        },
        y: Axis {
            label: "arm, mm".to_owned(),
            scale: Scale::Linear,
        },
        series,
    }
}

/// The four charts of the paper, by name: arms over L (fig. 2), D (fig. 3), α (fig. 4) and γ (fig. 5), lines numbered as
/// there.
///
/// # Sources
/// `[Pavlenko & Godunko 2010]` figs. 2 to 5. DIFFERENCE: lines 10 and 11 of fig. 2 hold a = 40 mm; the paper draws them less steep,
/// but by its own equations (1) and (2) the arms do not depend on a, and here they run parallel to lines 1 and 3.
#[must_use]
pub fn figures() -> Vec<(&'static str, Chart)> {
    let over_length = |n, part, what, mut c: Case, held: bool| {
        c.pivot = held.then_some(40.0);
        curve(n, part, what, c, |c, x| c.length = x, (40.0, 160.0))
    };
    let (a, b) = (case(0.0, 40.0, 120.0, 20.0), "D=40, α=120°, γ=20°");
    let (c, d) = (case(0.0, 100.0, 120.0, 20.0), "D=100, α=120°, γ=20°");
    let (e, f) = (case(0.0, 40.0, 90.0, 30.0), "D=40, α=90°, γ=30°");
    let (g, h) = (case(0.0, 60.0, 120.0, 20.0), "a=40, D=60, α=120°, γ=20°");
    let length = [
        (L1, b, a, false),
        (L11, b, a, false),
        (L2, b, a, false),
        (L21, b, a, false),
        (L1, d, c, false),
        (L2, d, c, false),
        (L1, f, e, false),
        (L12, f, e, false),
        (L2, f, e, false),
        (L1, h, g, true),
        (L2, h, g, true),
    ];
    let length = length
        .into_iter()
        .zip(1..)
        .map(|((part, what, c, held), n)| over_length(n, part, what, c, held));
    let (a, b) = (case(100.0, 0.0, 120.0, 20.0), "L=100, α=120°, γ=20°");
    let (c, d) = (case(100.0, 0.0, 120.0, 30.0), "L=100, α=120°, γ=30°");
    let (e, f) = (case(100.0, 0.0, 90.0, 30.0), "L=100, α=90°, γ=30°");
    let diameter = [
        (L1, b, a),
        (L11, b, a),
        (L2, b, a),
        (L21, b, a),
        (L11_L21, d, c),
        (L1, d, c),
        (L2, d, c),
        (L1, f, e),
        (L2, f, e),
    ];
    let diameter = diameter.into_iter().zip(1..);
    let diameter = diameter
        .map(|((part, what, c), n)| curve(n, part, what, c, |c, x| c.diameter = x, (5.0, 125.0)));
    let (a, b) = (case(100.0, 40.0, 0.0, 30.0), "L=100, D=40, γ=30°");
    let (c, d) = (case(100.0, 60.0, 0.0, 20.0), "L=100, D=60, γ=20°");
    let (e, f) = (case(80.0, 60.0, 0.0, 20.0), "L=80, D=60, γ=20°");
    let prism = [
        (L1, b, a),
        (L11, b, a),
        (L2, b, a),
        (L21, b, a),
        (L1, d, c),
        (L2, d, c),
        (L1, f, e),
        (L2, f, e),
    ];
    let prism = prism.into_iter().zip(1..);
    let prism = prism
        .map(|((part, what, c), n)| curve(n, part, what, c, |c, x| c.prism = x, (60.0, 140.0)));
    let (a, b) = (case(100.0, 40.0, 120.0, 0.0), "L=100, D=40, α=120°");
    let (c, d) = (case(100.0, 60.0, 120.0, 0.0), "L=100, D=60, α=120°");
    let (e, f) = (case(80.0, 60.0, 90.0, 0.0), "L=80, D=60, α=90°");
    let mounting = [
        (L1, b, a),
        (L2, b, a),
        (L1, d, c),
        (L2, d, c),
        (L1, f, e),
        (L2, f, e),
    ];
    let mounting = mounting.into_iter().zip(1..);
    let mounting = mounting
        .map(|((part, what, c), n)| curve(n, part, what, c, |c, x| c.mounting = x, (0.0, 40.0)));
    vec![
        (
            "figure-2",
            chart("Arms over lever length", "L, mm", length.collect()),
        ),
        (
            "figure-3",
            chart("Arms over part diameter", "D, mm", diameter.collect()),
        ),
        (
            "figure-4",
            chart("Arms over prism angle", "α, degrees", prism.collect()),
        ),
        (
            "figure-5",
            chart("Arms over mounting angle", "γ, degrees", mounting.collect()),
        ),
    ]
}

/// A finding of the paper and whether it is so.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// What is claimed.
    pub claim: &'static str,
    /// Whether it holds on the curves of [`figures`].
    pub holds: bool,
    /// The numbers it rests on.
    pub evidence: String,
}

/// Least and greatest slope between neighbouring points of a curve.
fn slopes(s: &Series) -> (f64, f64) {
    let each = s
        .points
        .windows(2)
        .map(|w| (w[1].1 - w[0].1) / (w[1].0 - w[0].0));
    each.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| {
        (a.min(x), b.max(x))
    })
}

/// The paper's findings, tried on its own curves.
///
/// # Sources
/// `[Pavlenko & Godunko 2010]` discussion of figs. 2 to 5 and conclusions.
#[must_use]
pub fn findings() -> Vec<Finding> {
    let charts = figures();
    let lines = |f: usize, part: &str| {
        let wanted = format!(": {part} ");
        charts[f]
            .1
            .series
            .iter()
            .filter(move |s| s.name.contains(&wanted))
            .collect::<Vec<_>>()
    };
    let bends = charts[..2].iter().flat_map(|(_, c)| &c.series).map(|s| {
        let (least, most) = slopes(s);
        most - least
    });
    let bend = bends.fold(0.0, f64::max);
    let range = |f: usize, part: &str| {
        lines(f, part)
            .into_iter()
            .map(slopes)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |a, b| {
                (a.0.min(b.0), a.1.max(b.1))
            })
    };
    let (over_d1, over_d2) = (range(1, "l1"), range(1, "l2"));
    let (over_a1, over_a2) = (range(2, "l1"), range(2, "l2"));
    let change = |part: &str| {
        let each = lines(3, part)
            .into_iter()
            .filter_map(|s| Some(s.points.last()?.1 - s.points.first()?.1));
        each.collect::<Vec<f64>>()
    };
    let (change1, change2) = (change("l1"), change("l2"));
    let outweighs = change1
        .iter()
        .zip(&change2)
        .map(|(a, b)| (a / b).abs())
        .fold(f64::INFINITY, f64::min);
    let (mut ratios, mut nearest) = ((f64::INFINITY, 0.0f64), f64::INFINITY);
    for f in 0..4 {
        for (far, near) in lines(f, "l1").iter().zip(lines(f, "l2")) {
            for (p, q) in far.points.iter().zip(&near.points) {
                ratios = (ratios.0.min(p.1 / q.1), ratios.1.max(p.1 / q.1));
                nearest = nearest.min((p.1 / q.1).ln().abs().exp());
            }
        }
    }
    vec![
        Finding {
            claim: "both arms are linear in L and in D",
            holds: bend < 1e-9,
            evidence: format!("slopes along a line differ by {bend:.1e} at most"),
        },
        Finding {
            claim: "l1 grows and l2 falls with D, alike",
            holds: over_d1.0 > 0.0 && over_d2.1 < 0.0 && (over_d1.1 + over_d2.0).abs() < 1e-9,
            evidence: format!(
                "{:.3} to {:.3} mm and {:.3} to {:.3} mm per mm of D",
                over_d1.0, over_d1.1, over_d2.0, over_d2.1
            ),
        },
        Finding {
            claim: "both arms grow with α",
            holds: over_a1.0 > 0.0 && over_a2.0 > 0.0,
            evidence: format!(
                "from 60° to 140°: l1 by {:.3} to {:.3}, l2 by {:.3} to {:.3} mm per degree; l1 falls again near α = 180° - γ",
                over_a1.0, over_a1.1, over_a2.0, over_a2.1
            ),
        },
        Finding {
            claim: "γ raises l1 strongly and lowers l2 weakly",
            holds: change1.iter().all(|x| *x > 0.0)
                && change2.iter().all(|x| *x < 0.0)
                && outweighs > 1.5,
            evidence: format!(
                "from 0° to 40° l1 changes at least {outweighs:.2} times as much; equally fast at γ = 90° - α/2"
            ),
        },
        Finding {
            claim: "the arms may be equal or differ 2 to 3 times",
            holds: nearest < 1.01 && ratios.1 > 2.0,
            evidence: format!(
                "l1/l2 from {:.3} to {:.3} on the curves",
                ratios.0, ratios.1
            ),
        },
        Finding {
            claim: "the near contact can have the longer arm",
            holds: ratios.0 < 1.0,
            evidence: "exactly where the levers cross, since l1 - l2 = 2 cos(α/2) a, a signed"
                .to_owned(),
        },
    ]
}
