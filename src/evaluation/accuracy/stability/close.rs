//! Mechanisms made from a seed in pairs of different mobility: one is special, the other the same but for one number, in the
//! second to the sixteenth digit. Coordinates are fractions, which mean what they say.

use super::change::Noise;
use super::said::{self, AnswerCount, Counts, Replies};
use super::special::Sketch;
use super::study::{Effort, Picture, Progress, Study};
use super::sweep::{RightTally, TallySweep};
use crate::accuracy::Truth;
use crate::file::text::mechanism_from_str;
use crate::format::list;
use rayon::prelude::*;

/// What is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpecialPair {
    /// Three wheels on fixed axes, each geared to the others: they turn where the ratios agree.
    Gears,
    /// Two bars between two fixed pins, in line or with the knee off it.
    Knee,
    /// A plate on three parallel rods, one of which is longer.
    Rods,
    /// A door on two hinges, one out of line.
    Door,
    /// A four-bar with one axis tilted.
    Tilted,
}

/// The numbers of one of a kind, without the one by which it is off.
#[derive(Debug, Clone)]
pub struct DrawnNumbers {
    pair: SpecialPair,
    numbers: [i64; 10],
}

/// A number of hundredths, and a power of ten more where a digit is given.
fn number(hundredths: i64, off: Option<u32>) -> String {
    match off {
        None => format!("{hundredths}/100"),
        Some(digit) => format!("{hundredths}/100 + 1/1{}", "0".repeat(digit as usize)),
    }
}

impl SpecialPair {
    /// All of them.
    pub const ALL: [SpecialPair; 5] = [
        SpecialPair::Gears,
        SpecialPair::Knee,
        SpecialPair::Rods,
        SpecialPair::Door,
        SpecialPair::Tilted,
    ];

    /// Its name in pictures.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            SpecialPair::Gears => "three gears",
            SpecialPair::Knee => "two bars in line",
            SpecialPair::Rods => "three parallel rods",
            SpecialPair::Door => "door",
            SpecialPair::Tilted => "four-bar",
        }
    }

    /// The figures of the special one, or of that which is off. A straight pair of bars is shaky; parallel rods stay so
    /// whatever their lengths.
    #[must_use]
    pub fn truth(self, off: bool) -> Truth {
        let (instantaneous, finite) = match (self, off) {
            (SpecialPair::Knee, false) | (SpecialPair::Rods, true) => (1, 0),
            (_, false) => (1, 1),
            (_, true) => (0, 0),
        };
        Truth {
            instantaneous,
            finite,
        }
    }
}

impl DrawnNumbers {
    /// What methods say of the special one, and of that which is off in a digit.
    fn replies(&self, digit: u32) -> Option<Replies> {
        let read = |off: Option<u32>| {
            let m = mechanism_from_str("close.toml", &self.text(off)).ok()?;
            Some((m, self.pair.truth(off.is_some())))
        };
        let pair = [read(None)?, read(Some(digit))?];
        Replies::new(&pair, self.text(Some(digit)))
    }

    /// One drawn at random.
    #[must_use]
    pub fn new(pair: SpecialPair, noise: &mut Noise) -> DrawnNumbers {
        #[allow(clippy::cast_possible_truncation, reason = "30 at most")]
        let numbers = [(); 10].map(|()| (30.0 * noise.uniform()) as i64);
        DrawnNumbers { pair, numbers }
    }

    /// The file: special, or off in a digit.
    #[must_use]
    pub fn text(&self, off: Option<u32>) -> String {
        let n = &self.numbers;
        // Near a place, in hundredths.
        let at = |hundredths: i64, i: usize| number(hundredths + n[i], None);
        let mut s = Sketch::default();
        match self.pair {
            SpecialPair::Gears => {
                for (i, wheel) in ["a", "b", "c"].into_iter().enumerate() {
                    s.pin(["0", wheel], &at(200 * i as i64, 2 * i), &at(0, 2 * i + 1));
                }
                let [one, two] = [60 + n[6], 70 + n[7]];
                s.couple([0, 1], &format!("-{one}/53"));
                s.couple([1, 2], &format!("-{two}/41"));
                let more =
                    off.map_or_else(String::new, |d| number(0, Some(d)).replace("0/100", ""));
                s.couple([0, 2], &format!("{}/{}{more}", one * two, 53 * 41));
            }
            SpecialPair::Knee => {
                let y = number(n[3], None);
                s.pin(["0", "a"], &at(0, 0), &y);
                s.pin(["a", "b"], &at(130, 1), &number(n[3], off));
                s.pin(["b", "0"], &at(300, 2), &y);
            }
            SpecialPair::Rods => {
                let length = 140 + n[0];
                for (i, (rod, x)) in [("a", 30), ("b", 110), ("c", 230)].into_iter().enumerate() {
                    let (x, y) = (at(x, i + 1), 30 + n[i + 4]);
                    s.pin(["0", rod], &x, &number(y, None));
                    let longer = off.filter(|_| rod == "c");
                    s.pin([rod, "plate"], &x, &number(y + length, longer));
                }
            }
            SpecialPair::Door => {
                let (x, y, z) = (130 + n[0], at(-70, 1), ["0", "0", "1"]);
                s.hinge(["0", "door"], [&number(x, None), &y, &at(40, 2)], z);
                s.hinge(["0", "door"], [&number(x, off), &y, &at(220, 3)], z);
            }
            SpecialPair::Tilted => {
                s.pin(["0", "a"], &at(30, 0), &at(20, 1));
                s.pin(["a", "b"], &at(60, 2), &at(130, 3));
                let place = [&at(180, 4)[..], &at(170, 5), &at(40, 6)];
                s.hinge(["b", "c"], place, [&number(0, off), "0", "1"]);
                s.pin(["c", "0"], &at(230, 7), &at(50, 8));
            }
        }
        s.text(self.pair.name())
    }
}

/// Digits in which the pairs differ.
const DIGITS: std::ops::RangeInclusive<u32> = 2..=16;

/// Runs the study.
pub(super) fn study(effort: Effort, progress: Progress<'_>) -> Study {
    let (each, step) = if effort.quick { (1, 5) } else { (4, 1) };
    // The last digit first: the axis ascends.
    let digits: Vec<u32> = DIGITS.rev().step_by(step).collect();
    let drawn: Vec<DrawnNumbers> = (0..SpecialPair::ALL.len() * each)
        .map(|i| DrawnNumbers::new(SpecialPair::ALL[i / each], &mut Noise::new(effort.seed, i)))
        .collect();
    let mut rows = said::rows();
    let mut auto: Vec<(String, Vec<AnswerCount>)> = SpecialPair::ALL
        .map(|p| (p.name().to_owned(), Vec::new()))
        .to_vec();
    for (n, &digit) in digits.iter().enumerate() {
        progress("closeness", n, digits.len());
        let found: Vec<Replies> = drawn.par_iter().filter_map(|d| d.replies(digit)).collect();
        said::add(&mut rows, &found);
        for (p, row) in auto.iter_mut().enumerate() {
            row.1
                .push(said::auto(found.iter().skip(p * each).take(each)));
        }
    }
    let values: Vec<f64> = digits
        .iter()
        .map(|&d| 10f64.powi(-i32::try_from(d).unwrap_or(0)))
        .collect();
    let x = "difference from the special one, relative to its size".to_owned();
    let sweep = TallySweep {
        title: "Close to special".to_owned(),
        x: x.clone(),
        column: "difference",
        values: values.clone(),
        cases: drawn.iter().map(|d| d.pair.name().to_owned()).collect(),
        rows,
    };
    let counts = Counts {
        x,
        column: "difference",
        values,
        rows: auto,
    };
    let together = counts.together();
    Study {
        name: "stability-close",
        title: sweep.title.clone(),
        sentence: sentence(&sweep, &together, drawn.len()),
        pictures: vec![
            Picture::of_bands("stability-close", &sweep.bands()),
            counts.picture(
                "stability-close-auto",
                "Close to special: what auto says",
                &together,
            ),
        ],
        csv: sweep.csv(),
    }
}

/// Which methods tell every pair apart, which down to some digit, and what the automatic choice says.
fn sentence(sweep: &TallySweep, auto: &[AnswerCount], pairs: usize) -> String {
    let (mut always, mut down, mut never) = (Vec::new(), Vec::new(), Vec::new());
    for (name, tallies) in sweep.rows.iter().filter(|r| r.1.iter().any(|t| t.of > 0)) {
        let right = |t: &RightTally| t.of > 0 && t.right == t.of;
        let good = tallies.iter().rev().take_while(|t| right(t)).count();
        match good {
            0 => never.push(name.clone()),
            n if n == tallies.len() => always.push(name.clone()),
            n => {
                let least = sweep.values[tallies.len() - n];
                down.push(format!("{name} down to {least:e}"));
            }
        }
    }
    let [right, open, wrong] = auto.iter().fold([0; 3], |mut sum, c| {
        sum.iter_mut().zip(c.three()).for_each(|(s, n)| *s += n);
        sum
    });
    let part = |what: &str, names: &[String]| {
        if names.is_empty() {
            String::new()
        } else {
            format!(" {what}: {}.", list(names))
        }
    };
    format!(
        "{pairs} pairs from the seed, one of each special and one not, in the second to the sixteenth digit.{}{}{} auto is right \
         about {right} that are off, leaves {open} open or says that they are not exact, and is wrong but sure about {wrong}.",
        part("Right about both at every difference", &always),
        part("Right about both", &down),
        part("Wrong about one of some pair at every difference", &never),
    )
}
