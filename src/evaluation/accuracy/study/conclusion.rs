//! The conclusion of a study: what its tallies show, in words.

use super::{Row, Study, View, replies_of};
use crate::accuracy::said::{Said, Tally};
use crate::accuracy::timing::quantile;
use crate::format::{format_duration, group_thousands, join_and, three_digits, two_digits};

impl Study {
    /// Returns the conclusion from the data.
    pub fn conclusion(&self) -> String {
        let found = match self.texts.view {
            View::Front => self.describe_front(),
            View::Points if !self.note.is_empty() => String::new(),
            View::Points => self.each_row(|(name, of)| self.describe_range(name, of)),
            View::Times => join_sentences([self.describe_shares(), self.describe_times()]),
            _ => self.describe_shares(),
        };
        join_sentences([found, self.note.clone()])
    }

    /// Returns a sentence with a part for each row.
    fn each_row(&self, part: impl Fn(&Row) -> Option<String>) -> String {
        let parts: Vec<String> = self.rows.iter().filter_map(part).collect();
        if parts.is_empty() {
            String::new()
        } else {
            format!("{}.", parts.join("; "))
        }
    }

    /// Returns the rows that are always right, the shares of the others, and the values at which most answers are wrong and sure. If one
    /// value matters most, shares are those at it. Studies of many methods give the share of right answers alone.
    fn describe_shares(&self) -> String {
        let brief = matches!(self.texts.view, View::Right | View::Times);
        let (mut always, mut rest, mut worst) = (Vec::new(), Vec::new(), Vec::new());
        for (name, tallies) in &self.rows {
            let at = |x: f64| self.texts.at.is_none_or(|at| (x / at - 1.0).abs() < 1e-9);
            let mut sum = Tally::default();
            for (_, tally) in replies_of(tallies).filter(|(x, _)| at(*x)) {
                sum.add(tally);
            }
            let words = self.texts.words.iter().zip(Said::ALL);
            let words = words.filter(|(_, said)| sum.of[*said as usize] > 0);
            let words = words.map(|(word, said)| format!("{:.1} % {word}", sum.percent_of(said)));
            match sum.count_replies() {
                0 => continue,
                all if all == sum.of[0] => always.push(name.as_str()),
                _ if brief => rest.push(format!("{name} {:.0} %", sum.percent_of(Said::Right))),
                all => rest.push(format!(
                    "{name} {} (of {all})",
                    words.collect::<Vec<_>>().join(", ")
                )),
            }
            let sure = |(_, t): &(f64, &Tally)| t.percent_of(Said::Wrong);
            let most = replies_of(tallies).max_by(|a, b| sure(a).total_cmp(&sure(b)));
            if let Some((x, t)) = most.filter(|(_, t)| !brief && !t.wrong.is_empty()) {
                let (wrong, all) = (t.wrong.len(), t.count_replies());
                worst.push(format!("{name} in {wrong} of {all} at {}", two_digits(x)));
            }
        }
        let sentence = |lead: &str, parts: &str| match parts {
            "" => String::new(),
            _ => format!("{lead}: {parts}."),
        };
        join_sentences([
            sentence("Right in all cases", &join_and(&always)),
            sentence(&self.texts.lead, &rest.join("; ")),
            sentence("Wrong and sure most often", &worst.join("; ")),
        ])
    }

    /// Returns the time of each row at the largest value that has replies.
    fn describe_times(&self) -> String {
        let seconds = self.texts.up.ends_with(", s");
        let times = self.each_row(|(name, tallies)| {
            let (x, tally) = replies_of(tallies).last()?;
            let time = tally.median_time();
            Some(if seconds {
                format!("{name} {} at {x}", format_duration(time))
            } else {
                format!("{name} {time:.1} times as long at {x}")
            })
        });
        format!("Times: {times}")
    }

    /// Returns sentences with the rows that are right in all cases, and those on the front of share and time.
    fn describe_front(&self) -> String {
        let named = |(name, t): (&str, &Tally)| {
            let (right, time) = (t.percent_of(Said::Right), format_duration(t.median_time()));
            format!("{name} ({right:.0} %, {time})")
        };
        let rows = self
            .rows
            .iter()
            .filter_map(|(name, t)| Some((name.as_str(), &t.first()?.1)));
        let all = rows.filter(|(_, t)| t.of[0] == t.count_replies());
        let mut all: Vec<String> = all.map(named).collect();
        if all.is_empty() {
            all.push("no method".to_owned());
        }
        let front: Vec<String> = self.pareto_rows().into_iter().map(named).collect();
        format!(
            "Right in all cases: {}. No method is both faster and more often right than {}. Cases that a method does not apply to \
             count as not right.",
            join_and(&all),
            join_and(&front)
        )
    }

    /// Returns the figure of a row at its first and its last value, or its largest share of wrong answers, and its times.
    fn describe_range(&self, name: &str, tallies: &[(f64, Tally)]) -> Option<String> {
        let of: Vec<_> = replies_of(tallies).collect();
        let times: Vec<f64> = of.iter().map(|(_, t)| t.median_time()).collect();
        let [from, to] = [0.0, 1.0].map(|at| quantile(&times, at));
        let (first, last) = (of.first()?, of.last()?);
        if first.1.figure.is_none() {
            let most = of
                .iter()
                .map(|(_, t)| self.figure_of(t))
                .fold(0.0, f64::max);
            let wrong = if most > 0.0 {
                format!("wrong in up to {most:.1} %")
            } else {
                "never wrong".to_owned()
            };
            let [from, to] = [from, to].map(three_digits);
            return Some(format!("{name} {wrong}, in {from} to {to} times the time"));
        }
        let [first, last] = [first, last].map(|(x, t)| {
            format!(
                "{} at {}",
                three_digits(self.figure_of(t)),
                group_thousands(x)
            )
        });
        let [from, to] = [from, to].map(format_duration);
        Some(if of.len() < 2 {
            format!("{name}: {last} in {to}")
        } else {
            format!("{name}: {first} to {last} in {from} to {to}")
        })
    }
}

/// Returns sentences with spaces between them.
fn join_sentences<const N: usize>(parts: [String; N]) -> String {
    let parts = parts.into_iter().filter(|p| !p.is_empty());
    parts.collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accuracy::said::Reply;

    /// Ten cases at each of four values, of which so many are wrong and sure.
    fn study(name: &'static str, wrong: [usize; 4]) -> Study {
        let values = vec![1e-3, 1e-2, 1e-1, 1.0];
        let study = Study::new(name, values);
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
        let found = |wrong| study("stability-distance", wrong).conclusion();
        assert_eq!(found([0; 4]), "Right in all cases: m.");
        let shares = study("stability-digits", [0, 0, 3, 1]);
        assert_eq!(
            shares.conclusion(),
            "Over all offsets: m 90.0 % right, 10.0 % wrong and sure (of 40). Wrong and sure most often: m in 3 of 10 at 0.1."
        );
        let csv = shares.to_csv();
        assert!(csv.contains("m,1e-1,10,7,0,0,3,c0; c1; c2\n"), "{csv}");
    }
}
