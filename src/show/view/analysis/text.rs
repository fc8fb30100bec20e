//! An analysis for people: the verdict first, then where each figure comes from.

use crate::redundancy::analysis::{ContourShare, CouplingShare, External};
use crate::redundancy::stress::{JointWrench, SelfStress, StressVerdict};
use crate::view::analysis::{
    Analysis, State, axis_names, harm_word, link_motions, ranks_agree, suggestions,
};
use crate::view::prelude::*;

/// Maximum number of motions in a text; JSON has all.
const MOTIONS: usize = 6;

impl Analysis<'_> {
    /// Returns the analysis without its stroke, fitted to a terminal of `width` columns if one is given: what is redundant, what moves, and
    /// what to change. With `verbose` it also has the counts behind W and σ, the method, the self-stresses and published claims.
    ///
    /// # Examples
    /// ```
    /// use ozols::view::analysis::Analysis;
    /// let four_bar = ozols::built_in("four-bar")?;
    /// let found = ozols::analyze(&four_bar)?;
    /// let text = Analysis::new(&four_bar, &found, &[]).text(Some(80), false);
    /// assert!(text.contains("3 redundant constraints") && text.lines().all(|l| l.chars().count() <= 80));
    /// # Ok::<(), ozols::Error>(())
    /// ```
    pub fn text(&self, width: Option<u16>, verbose: bool) -> String {
        let states = self.states.iter().map(|s| {
            let mut out = Report::new(width);
            s.write(&mut out, verbose);
            let advice = s
                .advice
                .map(|x| suggestions::advice_text(s.mechanism, s.found, x, width));
            out.text() + &advice.unwrap_or_default()
        });
        let claims = &self.mechanism.claims;
        let published = if verbose {
            claims_text(claims, Topic::Structure, width)
        } else {
            count_claims(&claims_about(claims, Topic::Structure))
        };
        fit_lines(&(states.collect_vec().join("\n") + &published), width)
    }
}

impl State<'_> {
    fn write(&self, out: &mut Report, verbose: bool) {
        let (m, s) = (self.mechanism, self.found);
        let (name, state, w) = (&m.name, &s.state, self.mobility_figure());
        out.add_line(format!(
            "{name}, state {state}: {}, mobility {w}\n",
            self.verdict()
        ));
        if verbose {
            let lines = self.count_lines().into_iter();
            lines.for_each(|line| out.add_line(format!("  {line}")));
        } else if s.finite.format_figure() != s.mobility.to_string() || !s.finite.is_proven() {
            out.add_line(format!("  {}", self.describe_finite()));
        }
        let motions = self.all_motions();
        let shown = motions.iter().take(MOTIONS);
        let shown = shown.map(|of| format!("motion of {}", link_motions::motion_line(m, of)));
        let more = motions.len().saturating_sub(MOTIONS);
        let json = typed_option("format", "json");
        let more = (more > 0).then(|| format!("and of {more} more outputs ({json} has all)"));
        let idle = self
            .idle_motions()
            .into_iter()
            .map(|of| format!("idle: {of}"));
        let lines = self.drive_faults().chain(shown).chain(more).chain(idle);
        let lines = lines.chain(self.left_out()).chain([self.certainty()]);
        lines.for_each(|line| out.add_line(format!("  {line}")));
        // What was done to the coordinates matters to everyone.
        if verbose || !s.snapped.is_empty() || s.as_written.is_some() || s.at_most().is_some() {
            self.method_lines()
                .for_each(|line| out.add_line(format!("  {line}")));
        }
        out.add_part(self.shares_table());
        if let Some(external) = self.external_line() {
            out.add_line(format!("\n  {external}"));
        }
        if verbose {
            if let Some(table) = self.stress_table() {
                out.add_part(Some(table));
                out.add_line("  harmful: strains the joints if parts are inaccurate; harmless: contacts share friction");
            }
            return;
        }
        let harmless = |t: &&SelfStress| t.verdict == StressVerdict::Harmless;
        let (all, harmless) = (
            s.self_stresses.len(),
            s.self_stresses.iter().filter(harmless).count(),
        );
        match (all, harmless) {
            (0, _) => {}
            (1, 0) => out.add_line("  It strains the joints if parts are inaccurate."),
            (all, 0) => out.add_line(format!("  All {all} strain the joints if parts are inaccurate.")),
            (all, n) => out.add_line(format!(
                "  {} of {all} strain the joints if parts are inaccurate; {n} are harmless: contacts share friction.",
                all - n
            )),
        }
    }

    /// Returns the counts, and W and σ from them, line by line.
    pub(crate) fn count_lines(&self) -> Vec<String> {
        let s = self.found;
        let (rows, f, rank) = (s.rows, s.freedoms, s.rank);
        let couplings = match s.per_coupling.len() {
            0 => String::new(),
            c => format!(", c = {}", count_noun(c, "coupling")),
        };
        let (n, p) = (count_noun(s.links, "link"), count_noun(s.joints, "joint"));
        let (k, freedoms) = (count_noun(s.contours, "contour"), count_noun(f, "freedom"));
        let [w, working, local] = [s.mobility, s.working_mobility, s.local_mobility];
        let gogu = self
            .gogu_symbols()
            .map(|[m, n, s, t]| format!("in Gogu's symbols: M = {m}, N = {n}, S = {s}, T = {t}"));
        let counting = (i64::try_from(w) != Ok(s.formula_mobility)).then(|| {
            format!(
                "counting alone (Malyshev's formula) says {}, wrong by the redundant constraints",
                s.formula_mobility
            )
        });
        let lines = [
            format!("n = {n}, p = {p}, k = {k}, f = {freedoms}{couplings}"),
            format!("rank of the {rows} x {f} closure matrix: {rank}"),
            format!("W = f - rank = {w} (in this pose): working {working}, local {local}"),
            self.describe_finite(),
            format!("σ = {rows} - rank = {}  (= W + {rows} - f)", s.redundant),
        ];
        lines.into_iter().chain(gogu).chain(counting).collect()
    }

    /// Returns the shares of contours and couplings in σ. `None` if there is no contour.
    pub(crate) fn shares_table(&self) -> Option<Table> {
        let contour = |c: &ContourShare| {
            let joints = c.contour.joints.iter();
            let joints = joints.map(|(j, _)| self.joint_name(*j)).join(", ");
            let name = c.contour.name(self.mechanism);
            let any = [in_any_order(c), in_any_basis(c)];
            row_cells([&name, &joints, &c.redundant, &any[0], &any[1]])
        };
        let coupling = |c: &CouplingShare| {
            let any = format_span(0, c.most);
            row_cells([&"coupling", &c.name, &c.redundant, &any, &any])
        };
        let (contours, couplings) = (&self.found.per_contour, &self.found.per_coupling);
        let shares = contours.iter().map(contour);
        Table::from_rows(
            "contour | joints | σ, this loop order | any loop order | any set of independent loops",
            shares.chain(couplings.iter().map(coupling)),
        )
    }

    /// Returns where the redundant constraints that a state adds come from.
    pub(crate) fn external_line(&self) -> Option<String> {
        let e = self.found.external.as_ref()?;
        let disagree = if ranks_agree(e) {
            ""
        } else {
            "  -- THESE DISAGREE"
        };
        let (formula, sigma, rank) = (external_formula(e), e.redundant, e.by_rank);
        Some(format!(
            "External: σ = {formula} = {sigma}; by rank {rank}{disagree}"
        ))
    }

    /// Returns the self-stresses, a row each. `None` if there are none.
    pub(crate) fn stress_table(&self) -> Option<Table> {
        let row = |t: &SelfStress| {
            let (contours, couplings) = (self.contours_of(t), self.couplings_of(t));
            let contours = contours.iter().map(String::as_str);
            let in_contours = contours.chain(couplings).join(" + ");
            let (joint, what) = self.simplest_joint(t).unwrap_or_default();
            let borne = self.borne_shares(t);
            row_cells([&in_contours, &joint, &what, &harm_word(t), &borne])
        };
        Table::from_rows(
            "self-stress in contour | simplest at | acts as |  | shared by joints, part of Σ |F|² + |M|²/ℓ²",
            self.found.self_stresses.iter().map(row),
        )
    }

    /// Returns W, or a range if rounded coordinates do not decide it.
    pub(crate) fn mobility_figure(&self) -> String {
        let (s, most) = (self.found, self.found.at_most());
        format_span(s.mobility, most.map_or(s.mobility, |(w, _)| w))
    }

    /// Returns the answer in a few words.
    ///
    /// # Examples
    /// ```
    /// use ozols::view::analysis::Analysis;
    /// let gripper = ozols::built_in("gripper-10")?;
    /// let found = ozols::analyze(&gripper)?;
    /// assert_eq!(Analysis::new(&gripper, &found, &[]).states[0].verdict(), "11 redundant constraints");
    /// # Ok::<(), ozols::Error>(())
    /// ```
    pub fn verdict(&self) -> String {
        let least = self.found.redundant;
        if let Some((_, most)) = self.found.at_most() {
            return format!("undecided, {least} to {most} redundant constraints");
        }
        match least {
            0 => "statically determinate".to_owned(),
            n => count_noun(n, "redundant constraint"),
        }
    }

    /// Returns Gogu's M (mobility), N (redundant constraints), S (independent motions of the platform) and T (motions that it does not
    /// feel), where two legs at least join one output to the frame.
    pub(super) fn gogu_symbols(&self) -> Option<[usize; 4]> {
        let (m, s) = (self.mechanism, self.found);
        let mut outputs = m.link_ids().filter(|&l| m.links[l].role == Role::Output);
        let ends = [m.frame_link(), outputs.next()?];
        let state = m.state_named(&s.state)?;
        let mut legs: Vec<BTreeSet<LinkId>> = Vec::new();
        for joint in m.joints_in(state).map(|j| &m.joints[j]) {
            let inner = joint.links.iter().copied().filter(|l| !ends.contains(l));
            let mut leg: BTreeSet<LinkId> = inner.collect();
            let (joined, others) = legs.into_iter().partition(|l| !l.is_disjoint(&leg));
            legs = others;
            leg.extend(Vec::into_iter(joined).flatten());
            legs.push(leg);
        }
        let is_of_legs = outputs.next().is_none() && legs.len() > 1 && s.at_most().is_none();
        is_of_legs.then_some([
            s.mobility,
            s.redundant,
            s.working_mobility,
            s.local_mobility,
        ])
    }

    /// Returns the finite mobility and how it is known.
    pub fn describe_finite(&self) -> String {
        let finite = &self.found.finite;
        let certainty = as_read(self.mechanism, finite.describe());
        format!("finite mobility {}: {certainty}", finite.format_figure())
    }

    /// Returns the faults of the drives in words.
    pub(crate) fn drive_faults(&self) -> impl Iterator<Item = String> {
        let faults = self.found.drives.iter();
        faults.map(|f| link_motions::drive_fault(self.mechanism, f).2)
    }

    /// Returns the idle motions in words, each text once.
    pub(crate) fn idle_motions(&self) -> Vec<String> {
        let words = |i| link_motions::describe_idle(self.mechanism, i);
        link_motions::told_once(self.found.idle.iter().map(words))
    }

    /// Returns the chosen method with the reason, its changes of coordinates, and the primes.
    pub(crate) fn method_lines(&self) -> impl Iterator<Item = String> {
        let s = self.found;
        let choice = s.choice.iter().map(|c| format!("method: {c}"));
        let snapped = s.snapped.iter().map(|moved| format!("snapped: {moved}"));
        let written = s.as_written.iter().map(|rank| {
            let (w, sigma) = (s.freedoms - rank, s.rows - rank);
            format!("as written, with every digit exact: mobility {w}, σ = {sigma}")
        });
        let primes = s
            .certainty
            .primes()
            .map(|[a, b]| format!("primes: {a} and {b}"));
        choice.chain(snapped).chain(written).chain(primes)
    }

    /// Returns what planar mode omits: "omitted in the plane: 1 freedom of joint 3-0".
    pub(crate) fn left_out(&self) -> impl Iterator<Item = String> {
        self.found.left_out.iter().map(|&(j, freedoms)| {
            let freedoms = count_noun(freedoms, "freedom");
            format!(
                "omitted in the plane: {freedoms} of joint {}",
                self.joint_name(j)
            )
        })
    }

    /// Returns the joint where a self-stress has the fewest components, of the contacts where they have any, since that is where external
    /// redundancy is felt, and what it carries there.
    pub(super) fn simplest_joint(&self, t: &SelfStress) -> Option<(&str, String)> {
        let joints = &self.mechanism.joints;
        let felt = t.joints.iter();
        let felt = felt.filter(|w| !t.external || joints[w.joint].states.is_some());
        let count = |w: &&JointWrench| w.moments.iter().chain(&w.forces).filter(|x| **x).count();
        let w = felt.min_by_key(count)?;
        Some((self.joint_name(w.joint), self.wrench_words(t, w)))
    }

    /// Returns what a joint carries of a self-stress: "force along z through (0, 1, 0) m", or where numbers are not known "moments about x
    /// and y, force along z".
    pub(super) fn wrench_words(&self, t: &SelfStress, w: &JointWrench) -> String {
        if let Some(borne) = &w.borne {
            return link_motions::describe_wrench(self.mechanism, w.joint, borne, t.size);
        }
        let part = |noun: &str, along: &str, axes: &[&str]| {
            let s = if axes.len() == 1 { "" } else { "s" };
            (!axes.is_empty()).then(|| format!("{noun}{s} {along} {}", join_and(axes)))
        };
        let parts = [
            part("moment", "about", &axis_names(w.moments)),
            part("force", "along", &axis_names(w.forces)),
        ];
        parts.into_iter().flatten().join(", ")
    }

    /// Returns what a self-stress is called in a drawing, counted from 0: "self-stress 1: moment about y at 0-1 (harmful)".
    pub fn name(&self, place: usize) -> String {
        let t = &self.found.self_stresses[place];
        let (joint, what) = self.simplest_joint(t).unwrap_or_default();
        format!(
            "self-stress {}: {what} at {joint} ({})",
            place + 1,
            harm_word(t)
        )
    }

    /// Returns every joint that bears a self-stress with its share if that is known, the greatest first: "4-5 52 %, 5-1 48 %".
    fn borne_shares(&self, t: &SelfStress) -> String {
        let share = |w: &JointWrench| w.borne.as_ref().map(|b| b.energy_share());
        let mut all: Vec<&JointWrench> = t.joints.iter().collect();
        all.sort_by(|a, b| share(b).unwrap_or(0.0).total_cmp(&share(a).unwrap_or(0.0)));
        let told = |w: &JointWrench| match (self.joint_name(w.joint), share(w).map(|s| 100.0 * s)) {
            (joint, None) => joint.to_owned(),
            (joint, Some(share)) if share < 1.0 => format!("{joint} <1 %"),
            (joint, Some(share)) => format!("{joint} {share:.0} %"),
        };
        all.into_iter().map(told).join(", ")
    }
}

/// Returns σ of a contour over all orders of these contours.
fn in_any_order(c: &ContourShare) -> String {
    format_span(c.range.0, c.range.1)
}

/// Returns σ of a contour over all bases of contours that it is part of.
fn in_any_basis(c: &ContourShare) -> String {
    let (reached, most) = c.over_bases;
    let words = format_span(c.range.0, reached);
    if most > reached {
        format!("{words} or more, at most {most}")
    } else {
        words
    }
}

/// Returns where the σ that a state adds comes from: "12 constraints - (1 - 0) - 0 lost mobilities".
fn external_formula(e: &External) -> String {
    let constraints = plural_of(&e.constraints.to_string(), "constraint");
    let (actual, working, lost) = (e.actual_mobility, e.working_mobility, e.lost_mobility);
    let noun = if lost == 1 { "mobility" } else { "mobilities" };
    format!("{constraints} - ({actual} - {working}) - {lost} lost {noun}")
}
