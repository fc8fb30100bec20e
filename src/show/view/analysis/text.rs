//! An analysis for people: the verdict first, then where each figure comes from.

use super::{Analysis, AsWritten, Contour, Coupling, External, LeftOut, SelfStress, State, Wrench};
use crate::format::{list, plural, plural_of};
use crate::view::analysis::idle;
use crate::view::claims;
use crate::view::terminal::layout::{fit, table};
use itertools::Itertools;
use std::fmt::Write;

/// Motions told at most; JSON has all.
const MOTIONS: usize = 6;

impl Analysis<'_> {
    /// The whole analysis but for its stroke, fitted to a terminal of `width` columns where one is given.
    #[must_use]
    pub fn text(&self, width: Option<u16>) -> String {
        let states = self.states.iter().map(|s| {
            let mut out = String::new();
            // Writing to a string cannot fail.
            let _ = s.write(&mut out, self.mechanism, width);
            if let Some(suggestions) = &s.suggestions {
                out += &suggestions.text(width);
            }
            out
        });
        fit(
            &(states.collect_vec().join("\n") + &claims::text(&self.claims, width)),
            width,
        )
    }
}

impl State<'_> {
    fn write(&self, out: &mut String, mechanism: &str, width: Option<u16>) -> std::fmt::Result {
        writeln!(
            out,
            "{mechanism}, state {}: {}, mobility {}\n",
            self.state,
            self.verdict(),
            self.mobility_figure()
        )?;
        self.write_counts(out)?;
        for fault in &self.drives {
            writeln!(out, "  {}", fault.text)?;
        }
        for motion in self.motions.iter().take(MOTIONS) {
            writeln!(out, "  motion of {}", motion.line())?;
        }
        if let Some(more) = self.motions.len().checked_sub(MOTIONS).filter(|n| *n > 0) {
            writeln!(out, "  and of {more} more outputs (--format json has all)")?;
        }
        for motion in self.idle_motions() {
            writeln!(out, "  idle: {motion}")?;
        }
        for line in self.left_out.iter().map(LeftOut::words) {
            writeln!(out, "  {line}")?;
        }
        writeln!(out, "  {}", self.certainty)?;
        for line in self.method_lines() {
            writeln!(out, "  {line}")?;
        }
        self.write_shares(out, width)?;
        if let Some(e) = &self.external {
            let disagree = if e.agree { "" } else { "  -- THESE DISAGREE" };
            writeln!(
                out,
                "\n  External: σ = {} = {}; by rank {}{disagree}",
                e.formula(),
                e.counted.redundant,
                e.counted.by_rank
            )?;
        }
        self.write_self_stresses(out, width)
    }

    /// What was counted, and W and σ from that.
    fn write_counts(&self, out: &mut String) -> std::fmt::Result {
        let (rows, f) = (self.rows, self.freedoms);
        let couplings = match self.per_coupling.len() {
            0 => String::new(),
            c => format!(", c = {}", plural(c, "coupling")),
        };
        writeln!(
            out,
            "  n = {}, p = {}, k = {}, f = {}{couplings}\n  \
             rank of the {rows} x {f} closure matrix: {}\n  \
             W = f - rank = {} (in this pose): working {}, local {}\n  \
             {}\n  \
             σ = {rows} - rank = {}  (= W + {rows} - f)",
            plural(self.links, "link"),
            plural(self.joints, "joint"),
            plural(self.contours, "contour"),
            plural(f, "freedom"),
            self.rank,
            self.mobility,
            self.working_mobility,
            self.local_mobility,
            self.finite(),
            self.redundant
        )?;
        if self.counting_is_wrong() {
            writeln!(
                out,
                "  counting alone (Malyshev's formula) says {}, wrong by the redundant constraints",
                self.formula_mobility
            )?;
        }
        Ok(())
    }

    /// The shares of contours and couplings in σ.
    fn write_shares(&self, out: &mut String, width: Option<u16>) -> std::fmt::Result {
        let shares = self.per_contour.iter().map(Contour::row);
        let shares = shares
            .chain(self.per_coupling.iter().map(Coupling::row))
            .collect_vec();
        if shares.is_empty() {
            return Ok(());
        }
        let head = [
            "contour",
            "joints",
            "σ in this order",
            "in any order",
            "in any basis",
        ];
        writeln!(out, "\n{}", table(&head, shares, width))
    }

    fn write_self_stresses(&self, out: &mut String, width: Option<u16>) -> std::fmt::Result {
        if self.self_stresses.is_empty() {
            return Ok(());
        }
        let head = [
            "self-stress in contour",
            "simplest at",
            "there as",
            "",
            "borne by, share of Σ |F|² + |M|²/ℓ²",
        ];
        let rows = self.self_stresses.iter().map(SelfStress::row).collect();
        writeln!(
            out,
            "\n{}\n  harmful: loads joints when parts are out of true; harmless: friction shared by the contacts",
            table(&head, rows, width)
        )
    }

    /// W, a range where rounded coordinates do not decide.
    #[must_use]
    pub(crate) fn mobility_figure(&self) -> String {
        range(
            self.mobility,
            self.mobility_at_most.unwrap_or(self.mobility),
        )
    }

    /// The answer in a few words.
    #[must_use]
    pub fn verdict(&self) -> String {
        if let Some(most) = self.redundant_at_most {
            return format!(
                "undecided, {} to {most} redundant constraints",
                self.redundant
            );
        }
        match self.redundant {
            0 => "statically determinate".to_owned(),
            n => plural(n, "redundant constraint"),
        }
    }

    /// The finite mobility and how it is known.
    #[must_use]
    pub fn finite(&self) -> String {
        let [figure, certainty] = &self.finite;
        format!("finite mobility {figure}: {certainty}")
    }

    /// Whether Malyshev's formula gives another mobility than the rank.
    #[must_use]
    pub(crate) fn counting_is_wrong(&self) -> bool {
        i64::try_from(self.mobility) != Ok(self.formula_mobility)
    }

    /// Idle motions in words, those that read alike told once.
    #[must_use]
    pub(crate) fn idle_motions(&self) -> Vec<String> {
        idle::told_once(self.idle.iter().map(|i| i.text.clone()))
    }

    /// Which method was chosen and why, what it did to the coordinates, and last the primes.
    pub(crate) fn method_lines(&self) -> impl Iterator<Item = String> {
        let choice = self.choice.iter().map(|c| format!("method: {c}"));
        let snapped = self.snapped.iter().map(|moved| format!("snapped: {moved}"));
        let written = self.as_written.iter().map(AsWritten::words);
        let primes = self
            .primes
            .iter()
            .map(|p| format!("primes: {}", p.join(" and ")));
        choice.chain(snapped).chain(written).chain(primes)
    }
}

impl LeftOut<'_> {
    /// "left out in the plane: 1 freedom of joint 3-0".
    #[must_use]
    pub fn words(&self) -> String {
        format!(
            "left out in the plane: {} of joint {}",
            plural(self.freedoms, "freedom"),
            self.joint
        )
    }
}

impl AsWritten {
    fn words(&self) -> String {
        format!(
            "as written, every digit at its word: mobility {}, σ = {}",
            self.mobility, self.redundant
        )
    }
}

/// "2" or "0 to 2".
fn range(least: usize, greatest: usize) -> String {
    if least == greatest {
        least.to_string()
    } else {
        format!("{least} to {greatest}")
    }
}

impl Contour<'_> {
    /// σ over all orders of these contours.
    #[must_use]
    pub fn range(&self) -> String {
        range(self.least, self.greatest)
    }

    /// σ over all bases of contours that it is part of.
    #[must_use]
    pub fn over_bases(&self) -> String {
        let reached = range(self.least, self.greatest_over_bases);
        match self.greatest_over_bases_at_most {
            Some(most) => format!("{reached} or more, at most {most}"),
            None => reached,
        }
    }

    fn row(&self) -> Vec<String> {
        vec![
            self.contour.clone(),
            self.joints.join(", "),
            self.redundant.to_string(),
            self.range(),
            self.over_bases(),
        ]
    }
}

impl Coupling<'_> {
    fn row(&self) -> Vec<String> {
        vec![
            "coupling".to_owned(),
            self.coupling.to_owned(),
            self.redundant.to_string(),
            range(self.least, self.greatest),
            range(self.least, self.greatest),
        ]
    }
}

impl External {
    /// Where its σ comes from: "12 constraints - (1 - 0) - 0 lost mobilities".
    #[must_use]
    pub(crate) fn formula(&self) -> String {
        format!(
            "{} - ({} - {}) - {} lost {}",
            plural_of(&self.counted.constraints.to_string(), "constraint"),
            self.counted.actual_mobility,
            self.counted.working_mobility,
            self.counted.lost_mobility,
            if self.counted.lost_mobility == 1 {
                "mobility"
            } else {
                "mobilities"
            }
        )
    }
}

impl SelfStress<'_> {
    fn row(&self) -> Vec<String> {
        let contours = self.contours.iter().map(String::as_str);
        let (joint, what) = self.simplest.clone().unwrap_or_default();
        vec![
            contours
                .chain(self.couplings.iter().flatten().copied())
                .join(" + "),
            joint.to_owned(),
            what,
            self.verdict.to_owned(),
            self.borne(),
        ]
    }

    /// What it is called in a drawing, counted from 0: "self-stress 1: moment about y at 0-1 (harmful)".
    #[must_use]
    pub fn name(&self, place: usize) -> String {
        let (joint, what) = self.simplest.clone().unwrap_or_default();
        format!(
            "self-stress {}: {what} at {joint} ({})",
            place + 1,
            self.verdict
        )
    }

    /// Every joint that bears it with its share, the greatest first: "4-5 52 %, 5-1 48 %".
    #[must_use]
    pub fn borne(&self) -> String {
        let mut all: Vec<&Wrench> = self.joints.iter().collect();
        all.sort_by(|a, b| {
            let share = |w: &Wrench| w.share.unwrap_or(0.0);
            share(b).total_cmp(&share(a))
        });
        all.iter().map(|w| w.borne()).join(", ")
    }
}

impl Wrench<'_> {
    /// The joint with its share, where that is known.
    fn borne(&self) -> String {
        match self.share.map(|s| 100.0 * s) {
            None => self.joint.to_owned(),
            Some(share) if share < 1.0 => format!("{} <1 %", self.joint),
            Some(share) => format!("{} {share:.0} %", self.joint),
        }
    }

    /// Which components it has: "moments about x and y, force along z".
    #[must_use]
    pub fn words(&self) -> String {
        let part = |what: &str, axes: &[&str]| {
            let (noun, along) = what.split_once(' ')?;
            let s = if axes.len() == 1 { "" } else { "s" };
            (!axes.is_empty()).then(|| format!("{noun}{s} {along} {}", list(axes)))
        };
        let parts = [
            part("moment about", &self.moments),
            part("force along", &self.forces),
        ];
        parts.into_iter().flatten().join(", ")
    }
}
