//! The conclusion of a study: what its tallies show, in words.

use super::{Figure, Study, View, asked_of, error_bound};
use crate::accuracy::said::{Said, Tally};
use crate::accuracy::timing::quantile;
use crate::format::{format_duration, group_thousands, join_and, three_digits, two_digits};

impl Study {
    /// Returns the conclusion from the data.
    pub fn conclusion(&self) -> String {
        match self.view {
            View::Regions | View::Best => self.describe_stretches(),
            View::Shares => self.describe_shares(),
            View::Times | View::Ratios => {
                format!("{} {}", self.describe_stretches(), self.describe_times())
            }
            View::Errors(degree) => self.describe_errors(degree),
            View::Against(Figure::Right) => self.describe_front(),
            View::Against(figure) => self.describe_ranges(figure),
        }
    }

    /// Returns a sentence with the rows that are always right, and the values at which the others are right most often.
    fn describe_stretches(&self) -> String {
        let (mut always, mut rest) = (Vec::new(), Vec::new());
        for (name, tallies) in &self.rows {
            let of: Vec<_> = asked_of(tallies).collect();
            let share = |n: usize| of[n].1.percent_of(Said::Right);
            let most = (0..of.len()).map(share).fold(0.0, f64::max);
            let runs = longest_run(of.len(), |n| share(n) >= most);
            let Some((first, last)) = runs else { continue };
            let whole = first == 0 && last + 1 == of.len();
            if whole && most >= 100.0 {
                always.push(name.clone());
                continue;
            }
            let [from, to] = [first, last].map(|n| self.value_text(of[n].0));
            let place = match () {
                () if whole => "throughout".to_owned(),
                () if first == last => format!("at {from}"),
                () => format!("from {from} to {to}"),
            };
            rest.push(format!("{name} {:.0} % {place}", most.floor()));
        }
        let told = if always.is_empty() {
            "nothing".to_owned()
        } else {
            join_and(&always)
        };
        let rest = if rest.is_empty() {
            String::new()
        } else {
            format!(" Right most often: {}.", join_and(&rest))
        };
        format!("Right in all cases throughout: {told}.{rest}")
    }

    /// Returns the shares of each row over all values, with the value at which most of its answers are wrong and sure.
    fn describe_shares(&self) -> String {
        let told = self.rows.iter().map(|(name, tallies)| {
            let mut sum = Tally::default();
            for (n, of) in tallies.iter().flat_map(|(_, t)| t.of.iter().enumerate()) {
                sum.of[n] += of;
            }
            let worst = asked_of(tallies).max_by(|a, b| {
                let sure = |t: &Tally| t.percent_of(Said::Wrong);
                sure(a.1).total_cmp(&sure(b.1))
            });
            let worst = worst.filter(|(_, t)| !t.wrong.is_empty()).map_or_else(String::new, |(x, t)| {
                let (wrong, at) = (t.wrong.len(), self.value_text(x));
                format!(" ({wrong} of {} at {at})", t.count_replies())
            });
            let [right, open, hedged, sure] = [Said::Right, Said::Open, Said::Hedged, Said::Wrong]
                .map(|s| format!("{:.1} %", sum.percent_of(s)));
            format!(
                "{name} right {right}, undecided {open}, wrong but said not exact {hedged}, wrong and sure {sure}{worst}"
            )
        });
        let told: Vec<String> = told.collect();
        format!("{}.", told.join("; "))
    }

    /// Returns the time of each row at the largest value that has replies, and how it grows.
    fn describe_times(&self) -> String {
        let told = self.rows.iter().filter_map(|(name, tallies)| {
            let times: Vec<_> = asked_of(tallies)
                .map(|(x, t)| (x, t.median_time()))
                .collect();
            let (x1, y1) = *times.last()?;
            let before = times.iter().rev().find(|(x, y)| x * 3.0 <= x1 && *y > 0.0);
            let grows = before.map_or_else(String::new, |(x0, y0)| {
                let power = (y1 / y0).ln() / (x1 / x0).ln();
                format!(", growing with the power {power:.1}")
            });
            Some(match self.view {
                View::Times => format!("{name} {} at {x1}{grows}", format_duration(y1)),
                _ => format!("{name} {y1:.1} at {x1}"),
            })
        });
        format!("Times: {}.", told.collect::<Vec<_>>().join("; "))
    }

    /// Returns the values at which each row has errors, whether the bound allows so many, and the time of the row.
    fn describe_errors(&self, degree: u32) -> String {
        let told = self.rows.iter().enumerate().map(|(n, (name, tallies))| {
            let of: Vec<_> = asked_of(tallies).collect();
            let wrong: Vec<_> = of.iter().filter(|(_, t)| !t.wrong.is_empty()).collect();
            let some = |(bits, t): &&(f64, &Tally)| {
                let all = group_thousands(t.count_replies());
                format!("{} of {all} at {bits} bits", t.wrong.len())
            };
            // The bound is of a probability: some more may be drawn, three deviations and one.
            let above = |(b, t): &&(f64, &Tally)| {
                let [all, wrong] = [t.count_replies(), t.wrong.len()].map(|n| n as f64);
                let expected = error_bound(degree, *b) / 100.0 * all;
                wrong > expected + 3.0 * expected.sqrt() + 1.0
            };
            let above = match wrong.iter().copied().any(|w| above(&w)) {
                // The bound speaks of the first row.
                _ if n > 0 => "",
                true => " more than the bound allows,",
                false => " within the bound,",
            };
            let each: Vec<String> = wrong.iter().map(some).collect();
            let none = if each.is_empty() {
                "none".to_owned()
            } else {
                join_and(&each)
            };
            let times: Vec<f64> = of.iter().map(|(_, t)| t.median_time()).collect();
            let [least, most] = [0.0, 1.0].map(|at| format_duration(quantile(&times, at)));
            format!("{name}: wrong {none},{above} in {least} to {most} whatever the prime")
        });
        format!("{}.", told.collect::<Vec<_>>().join("; "))
    }

    /// Returns sentences with the rows that are right in all cases, and those on the front of share and time.
    fn describe_front(&self) -> String {
        let rows = self
            .rows
            .iter()
            .filter_map(|(name, t)| Some((name, &t.first()?.1)));
        let all = rows
            .filter(|(_, t)| t.of[0] == t.count_replies())
            .map(|(name, t)| format!("{name} ({})", format_duration(t.median_time())));
        let all = join_and(&all.collect::<Vec<_>>());
        let front = self.pareto_rows().into_iter().map(|(name, t)| {
            format!(
                "{name} ({:.0} %, {})",
                t.percent_of(Said::Right),
                format_duration(t.median_time())
            )
        });
        let front = join_and(&front.collect::<Vec<_>>());
        let all = if all.is_empty() { "no method" } else { &all };
        format!(
            "Right in all cases: {all}. No method is both faster and more often right than {front}. Cases that a method does not apply \
             to count as not right."
        )
    }

    /// Returns the figures of each row at its first and its last value, or its largest share of wrong answers, and its times.
    fn describe_ranges(&self, figure: Figure) -> String {
        let told = self.rows.iter().filter_map(|(name, tallies)| {
            let of: Vec<_> = asked_of(tallies).collect();
            let times: Vec<f64> = of.iter().map(|(_, t)| t.median_time()).collect();
            let [from, to] = [0.0, 1.0].map(|at| quantile(&times, at));
            if figure == Figure::Wrong {
                let most = of
                    .iter()
                    .map(|(_, t)| t.figure_of(figure))
                    .fold(0.0, f64::max);
                let wrong = if most > 0.0 {
                    format!("wrong in up to {most:.1} %")
                } else {
                    "never wrong".to_owned()
                };
                let [from, to] = [from, to].map(three_digits);
                return Some(format!("{name} {wrong}, in {from} to {to} times the time"));
            }
            let end = |(x, t): &(f64, &Tally)| {
                format!(
                    "{} at {}",
                    three_digits(t.figure_of(figure)),
                    three_digits(*x)
                )
            };
            let ends = match &of[..] {
                [] => return None,
                [one] => format!("{} in {}", end(one), format_duration(to)),
                [first, .., last] => {
                    let [from, to] = [from, to].map(format_duration);
                    format!("{} to {} in {from} to {to}", end(first), end(last))
                }
            };
            let [right, wrong] = [0, 3].map(|n| of.iter().map(|(_, t)| t.of[n]).sum::<usize>());
            let holds = match right + wrong {
                0 => String::new(),
                all => format!(" (right in {right} of {all})"),
            };
            Some(format!("{name}: {ends}{holds}"))
        });
        format!("{}.", told.collect::<Vec<_>>().join("; "))
    }

    fn value_text(&self, x: f64) -> String {
        match self.view {
            View::Times | View::Ratios => x.to_string(),
            _ => two_digits(x),
        }
    }
}

/// Returns the first and the last number of the longest run of good numbers below `count`. Of equally long runs it is the first one.
fn longest_run(count: usize, good: impl Fn(usize) -> bool) -> Option<(usize, usize)> {
    let (mut best, mut begun) = (None::<(usize, usize)>, None);
    for n in 0..count {
        if !good(n) {
            begun = None;
            continue;
        }
        let from = *begun.get_or_insert(n);
        if best.is_none_or(|(first, last)| n - from > last - first) {
            best = Some((from, n));
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accuracy::said::Reply;

    /// Ten cases at each of four values, of which so many are wrong and sure.
    fn study(view: View, wrong: [usize; 4]) -> Study {
        let values = vec![1e-3, 1e-2, 1e-1, 1.0];
        let study = Study::new("stability-distance", values, view);
        study.ask_cases(["m"], 10, &mut |_, _, _| {}, |v, case| {
            let said = if case < wrong[v] {
                Said::Wrong
            } else {
                Said::Right
            };
            vec![Some(Reply::new(said, || format!("c{case}")))]
        })
    }

    #[test]
    fn conclusions_follow_from_the_tallies() {
        let told = |wrong| study(View::Regions, wrong).conclusion();
        assert_eq!(told([0; 4]), "Right in all cases throughout: m.");
        let most = |rest: &str| {
            format!("Right in all cases throughout: nothing. Right most often: m {rest}.")
        };
        assert_eq!(told([0, 0, 1, 0]), most("100 % from 1e−3 to 0.01"));
        assert_eq!(told([4; 4]), most("60 % throughout"));
        assert_eq!(
            study(View::Shares, [0, 0, 3, 1]).conclusion(),
            "m right 90.0 %, undecided 0.0 %, wrong but said not exact 0.0 %, wrong and sure 10.0 % (3 of 10 at 0.1)."
        );
        let csv = study(View::Shares, [0, 0, 3, 1]).to_csv();
        assert!(csv.contains("m,1e-1,10,7,0,0,3,c0; c1; c2\n"), "{csv}");
    }
}
