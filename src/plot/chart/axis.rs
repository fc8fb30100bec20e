//! Ranges, ticks and their labels.

use crate::chart::data::{self, Scale, TICK};
use crate::format::with_minus_sign;
use crate::svg::text;

/// The range of an axis with its ticks; positions are fractions of the axis from its low end.
#[derive(Clone, Debug)]
pub(super) struct Ruler {
    scale: Scale,
    lo: f64,
    hi: f64,
    /// Ticks from low to high.
    pub(super) ticks: Vec<Tick>,
    /// Positions of the unlabelled lines between decades.
    pub(super) fine: Vec<f64>,
}

/// A tick.
#[derive(Clone, Debug)]
pub(super) struct Tick {
    /// Position.
    pub(super) at: f64,
    /// Its label, or `None` if it would not fit.
    pub(super) label: Option<Label>,
}

/// A tick's label: `base`, or `base` with a raised `power`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Label {
    pub(super) base: String,
    pub(super) power: Option<String>,
}

/// Rule for the range of an axis, given the values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum AxisFit {
    /// From the smallest to the largest value.
    Tight,
    /// Slightly beyond both.
    Padded,
    /// From tick to tick, with zero included if it is near.
    Round,
}

/// Space for labels, in pixels.
#[derive(Clone, Copy, Debug)]
pub(super) enum Room {
    /// A horizontal axis of this length, with this much space before and after it.
    Across(f64, f64, f64),
    /// A vertical axis of this length.
    Up(f64),
}

impl Label {
    /// Creates a label without a power.
    pub(super) fn plain_label(base: String) -> Label {
        Label { base, power: None }
    }

    /// Returns its width in pixels.
    pub(super) fn label_width(&self) -> f64 {
        let power = self.power.as_deref().unwrap_or_default();
        text::text_width(&self.base, TICK) + text::text_width(power, data::RAISED)
    }
}

/// Returns the quantity that the axis measures, the value or its decimal logarithm, or `None` if it cannot be shown.
fn measured_quantity(scale: Scale, value: f64) -> Option<f64> {
    match scale {
        Scale::Linear => (value.abs() <= 1e300).then_some(value),
        Scale::Log => (value > 0.0 && value.is_finite()).then(|| value.log10()),
        Scale::LogAndZero(least) => {
            let least = f64::from(least);
            (value >= 0.0 && value.is_finite()).then(|| value.log10().max(least))
        }
    }
}

impl Ruler {
    /// Creates the ruler for `values`.
    pub(super) fn new(
        scale: Scale,
        values: impl Iterator<Item = f64>,
        fit: AxisFit,
        room: Room,
    ) -> Self {
        let range = values
            .filter_map(|v| measured_quantity(scale, v))
            .fold(None, |range, v| {
                let (lo, hi) = range.unwrap_or((v, v));
                Some((v.min(lo), v.max(hi)))
            });
        let (lo, hi) = range.unwrap_or((0.0, 1.0));
        let mut ruler = match scale {
            Scale::Linear => linear_ruler(lo, hi, fit, room),
            Scale::Log => log_ruler(lo, hi, fit, room, None),
            // The axis always includes zero.
            Scale::LogAndZero(least) => {
                log_ruler(lo.min(f64::from(least)), hi, fit, room, Some(least))
            }
        };
        ruler.drop_crowded(room);
        ruler
    }

    /// Returns true if an axis can show `value`.
    pub(super) fn can_show(scale: Scale, value: f64) -> bool {
        measured_quantity(scale, value).is_some()
    }

    /// Returns the position of `value`, or `None` if it cannot be shown.
    pub(super) fn place_value(&self, value: f64) -> Option<f64> {
        measured_quantity(self.scale, value).map(|v| self.axis_fraction(v))
    }

    /// Creates a ruler without ticks.
    fn without_ticks(scale: Scale, lo: f64, hi: f64) -> Ruler {
        Ruler {
            scale,
            lo,
            hi,
            ticks: Vec::new(),
            fine: Vec::new(),
        }
    }

    /// Creates a tick at a measured quantity.
    fn make_tick(&self, measured: f64, label: Label) -> Tick {
        Tick {
            at: self.axis_fraction(measured).clamp(0.0, 1.0),
            label: Some(label),
        }
    }

    fn axis_fraction(&self, measured: f64) -> f64 {
        // halved, so that the widest ranges do not overflow
        (measured / 2.0 - self.lo / 2.0) / (self.hi / 2.0 - self.lo / 2.0)
    }

    fn is_crowded(&self, room: Room) -> bool {
        let Room::Across(length, ..) = room else {
            return false;
        };
        let labels = self
            .ticks
            .iter()
            .filter_map(|t| Some((t.at, t.label.as_ref()?)));
        let mut end = f64::NEG_INFINITY;
        for (at, label) in labels {
            let (middle, half) = (at * length, label.label_width() / 2.0);
            if middle - half < end + data::GAP {
                return true;
            }
            end = middle + half;
        }
        false
    }

    /// Returns how many labels remain if crowded ones are dropped.
    fn count_fitting_labels(&self, room: Room) -> usize {
        let mut left = self.clone();
        left.drop_crowded(room);
        left.ticks.iter().filter(|t| t.label.is_some()).count()
    }

    /// Removes the labels that would touch the previous one or leave the picture.
    fn drop_crowded(&mut self, room: Room) {
        let Room::Across(length, before, after) = room else {
            return;
        };
        let mut end = f64::NEG_INFINITY;
        for tick in &mut self.ticks {
            let half = tick.label.as_ref().map_or(0.0, Label::label_width) / 2.0;
            let (from, to) = (tick.at * length - half, tick.at * length + half);
            if from < -before || to > length + after || from < end + data::GAP {
                tick.label = None;
            } else {
                end = to;
            }
        }
    }
}

/// Returns the numbers of steps to try, the best first.
fn step_counts(room: Room) -> impl Iterator<Item = f64> {
    let best = match room {
        Room::Across(length, ..) => length / 60.0,
        Room::Up(length) => length / 46.0,
    };
    let best = best.round().clamp(1.0, 10.0);
    (0..10)
        .map(move |less| best - f64::from(less))
        .filter(|&n| n >= 1.0)
}

fn linear_ruler(lo: f64, hi: f64, fit: AxisFit, room: Room) -> Ruler {
    let size = lo.abs().max(hi.abs());
    let (mut lo, mut hi) = if hi / 2.0 - lo / 2.0 > (size * 1e-10).max(1e-290) {
        (lo, hi)
    } else if size < 1e-280 {
        (-1.0, 1.0)
    } else {
        let middle = lo / 2.0 + hi / 2.0;
        (middle - 0.2 * size, middle + 0.2 * size)
    };
    if fit != AxisFit::Tight {
        if lo >= 0.0 && lo < 0.4 * hi {
            lo = 0.0;
        } else if hi <= 0.0 && hi > 0.4 * lo {
            hi = 0.0;
        }
    }
    if fit == AxisFit::Padded {
        let pad = 0.05 * hi - 0.05 * lo;
        lo = if lo == 0.0 { lo } else { lo - pad };
        hi = if hi == 0.0 { hi } else { hi + pad };
    }
    let rulers = || step_counts(room).map(|count| linear_by(lo, hi, count, fit));
    // A scale needs two labels: if no ruler has them without crowding, one whose crowded labels are dropped is better.
    let good = |r: &Ruler| !r.is_crowded(room) && r.count_fitting_labels(room) >= 2;
    let most = || rulers().max_by_key(|r| r.count_fitting_labels(room));
    let ruler = rulers().find(good).or_else(most);
    ruler.unwrap_or_else(|| linear_by(lo, hi, 1.0, fit))
}

/// Creates ticks at a 1-2-5 step, with about `count` steps in the range.
fn linear_by(lo: f64, hi: f64, count: f64, fit: AxisFit) -> Ruler {
    let raw = hi / count - lo / count;
    let mut exponent = raw.log10().floor() as i32;
    let lead = raw / power_of_ten(exponent) * (1.0 - 1e-9);
    let mut lead = [1_i64, 2, 5, 10]
        .into_iter()
        .find(|&m| lead <= m as f64)
        .unwrap_or(10);
    if lead == 10 {
        (lead, exponent) = (1, exponent + 1);
    }
    let step = lead as f64 * power_of_ten(exponent);
    let (first, last) = if fit == AxisFit::Round {
        ((lo / step + 1e-9).floor(), (hi / step - 1e-9).ceil())
    } else {
        ((lo / step - 1e-9).ceil(), (hi / step + 1e-9).floor())
    };
    // whole multiples of ten(exponent)
    let whole: Vec<i64> = (first as i64..=last as i64).map(|k| k * lead).collect();
    let value = |k: i64| match exponent {
        ..0 => k as f64 / power_of_ten(-exponent),
        _ => k as f64 * power_of_ten(exponent),
    };
    let (mut lo, mut hi) = (lo, hi);
    if let (AxisFit::Round, Some(&first), Some(&last)) = (fit, whole.first(), whole.last()) {
        (lo, hi) = (lo.min(value(first)), hi.max(value(last)));
    }
    let most = whole.iter().map(|k| k.abs()).max().unwrap_or(0);
    let mut ruler = Ruler::without_ticks(Scale::Linear, lo, hi);
    let tick = |&k: &i64| ruler.make_tick(value(k), decimal_label(k, exponent, most));
    ruler.ticks = whole.iter().map(tick).collect();
    ruler
}

fn power_of_ten(exponent: i32) -> f64 {
    10_f64.powi(exponent)
}

/// Formats `whole` times ten to the `exponent` like its neighbours, the largest of which is `most`.
fn decimal_label(whole: i64, exponent: i32, most: i64) -> Label {
    if whole == 0 {
        return Label::plain_label("0".to_owned());
    }
    let sign = if whole < 0 { "\u{2212}" } else { "" };
    let top = exponent + most.max(1).ilog10() as i32;
    if top < 6 && exponent >= -4 {
        let size = whole.unsigned_abs() as f64 * power_of_ten(exponent);
        let digits = format!("{size:.0$}", (-exponent).max(0) as usize);
        return Label::plain_label(format!("{sign}{}", data::group_thousands(&digits)));
    }
    let decimals = (top - exponent).max(0);
    let mantissa = whole.unsigned_abs() as f64 / power_of_ten(decimals);
    Label {
        base: format!("{sign}{mantissa:.0$}×10", decimals as usize),
        power: Some(with_minus_sign(&top.to_string())),
    }
}

/// Creates decades; one of them may represent zero.
fn log_ruler(lo: f64, hi: f64, fit: AxisFit, room: Room, zero: Option<i32>) -> Ruler {
    let decades = |lo: f64, hi: f64| (hi + 1e-9).floor() - (lo - 1e-9).ceil() + 1.0;
    let (mut lo, mut hi) = if decades(lo, hi) >= 2.0 {
        let pad = if fit == AxisFit::Tight {
            0.0
        } else {
            0.04 * (hi - lo)
        };
        (lo - pad, hi + pad)
    } else {
        ((lo + 1e-9).floor(), (hi - 1e-9).ceil())
    };
    if hi - lo < 0.5 {
        (lo, hi) = (lo - 1.0, hi + 1.0);
    }
    let first = (lo - 1e-9).ceil() as i32;
    let last = (hi + 1e-9).floor() as i32;
    let plain = first >= -3 && last <= 5;
    let most = step_counts(room).next().unwrap_or(1.0) as i32 + 1;
    let mut ruler = Ruler::without_ticks(zero.map_or(Scale::Log, Scale::LogAndZero), lo, hi);
    for step in [1, 2, 3, 5, 10, 20, 50, 100, 200, 500] {
        let decades = (first..=last).filter(|e| e % step == 0 || Some(*e) == zero);
        let tick = |e| {
            let label = match zero {
                Some(z) if z == e => Label::plain_label("0".to_owned()),
                _ => decade_label(e, plain),
            };
            ruler.make_tick(f64::from(e), label)
        };
        ruler.ticks = decades.map(tick).collect();
        if ruler.ticks.len() as i32 <= most && !ruler.is_crowded(room) {
            break;
        }
    }
    if last - first <= 6 {
        for decade in first - 1..=last {
            let places = (2..10).map(|m| f64::from(decade) + f64::from(m).log10());
            let places = places
                .filter(|p| (lo..=hi).contains(p))
                .map(|p| ruler.axis_fraction(p));
            ruler.fine.extend(places.collect::<Vec<_>>());
        }
    }
    ruler
}

fn decade_label(exponent: i32, plain: bool) -> Label {
    if !plain {
        return Label {
            base: "10".to_owned(),
            power: Some(with_minus_sign(&exponent.to_string())),
        };
    }
    let digits = format!(
        "{:.1$}",
        power_of_ten(exponent),
        (-exponent).max(0) as usize
    );
    Label::plain_label(data::group_thousands(&digits))
}
