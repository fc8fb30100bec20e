//! Statics for people: the groups, the reactions over the cycle, the greatest of each joint.

use crate::statics::assur::{Decomposition, Group};
use crate::statics::assur_class::roman_numeral;
use crate::statics::contour_group::ContourGroup;
use crate::statics::contour_group::pose::GroupReactions;
use crate::statics::contour_group::solutions::{GroupMethod, GroupSolutions};
use crate::statics::cycle::{DrivenStructure, Moment};
use crate::statics::kinetostatics::Worth;
use crate::statics::planar::PairId;
use crate::view::prelude::*;
use crate::view::reactions::text::{NO_STRAIN, no_loads};
use crate::view::statics::{
    StaticsData, Structures, joint_names, link_names, magnitudes, vector_size,
};

/// Condition above which a group counts as singular in the pose.
const SINGULAR: f64 = 1e12;

impl Structures<'_> {
    /// Returns the structure under every drive.
    pub fn text(&self, width: Option<u16>) -> String {
        let m = self.planar;
        let group = |(g, condition): (&Group, &f64)| {
            let inside = if g.locked.is_empty() {
                ""
            } else {
                ", the drive inside"
            };
            let singular = if *condition > SINGULAR {
                ", singular in this pose"
            } else {
                ""
            };
            let links = link_names(m, &g.bodies).join(", ");
            format!("{links} ({}{inside}{singular})", g.class)
        };
        let row = |x: &DrivenStructure| {
            let [class, what] = match &x.found {
                Ok((d, conditions)) => {
                    let groups = d.groups.iter().zip(conditions).map(group).join("; ");
                    [roman_numeral(d.highest_class()), groups]
                }
                Err(e) => ["-".to_owned(), e.to_string()],
            };
            vec![m.pairs[x.drive].name.clone(), class, what]
        };
        let heads = "drive | class | Assur groups, in the order they are placed";
        let table = text_table(heads, self.found.iter().map(row), width);
        let name = self.mechanism;
        let head = format!("{name}: structure under each drive, those at the frame first");
        format!("{}\n\n{table}\n", fit_lines(&head, width))
    }
}

impl StaticsData<'_> {
    /// Returns the report, fitted to a terminal of `width` columns if one is given.
    pub fn text(&self, width: Option<u16>) -> String {
        let mut out = Report::new(width);
        let (s, d) = (self.found, &self.found.decomposition);
        let drives = match &*joint_names(self.planar_mechanism(), &d.drives) {
            [] => "nothing".to_owned(),
            names => names.join(", "),
        };
        out.add_line(format!(
            "{}: {}{} driven by {drives}, class {}\n",
            self.of.name,
            self.greatest_reaction(),
            count_noun(d.groups.len(), "Assur group"),
            roman_numeral(d.highest_class())
        ));
        if !d.groups.is_empty() {
            self.write_groups(&mut out, d);
        }
        if s.moments.iter().any(|x| !x.loads.is_empty()) {
            (0..s.contour_groups.len()).for_each(|i| self.write_group(&mut out, i));
        }
        if s.loaded {
            self.write_joints(&mut out);
            self.write_summary(&mut out);
        } else {
            let misalignments = self.of.loads.misalignments.len();
            out.add_line(no_loads(misalignments));
            if misalignments > 0 {
                out.add_line(NO_STRAIN);
            }
        }
        if let Some(dead) = &s.dead {
            let group = |g| format!("group {}", self.group_name(g));
            let who = dead.group.map_or_else(|| "the drives".to_owned(), group);
            let (at, condition) = (self.format_place(dead.drive), five_digits(dead.condition));
            out.add_line(format!(
                "\nThe motion stops at {at}: {who} is at a dead point (condition {condition})."
            ));
        }
        out.text() + &claims_text(&self.of.claims, Topic::Statics, width)
    }

    /// Adds the groups as a table.
    fn write_groups(&self, out: &mut Report, d: &Decomposition) {
        let m = self.planar_mechanism();
        let rows = d.groups.iter().enumerate().map(|(i, g)| {
            let [inner, outer] = [&g.inner, &g.outer].map(|list| joint_names(m, list).join(", "));
            let condition = self.found.conditions.get(i);
            let condition = condition.map_or_else(String::new, |c| five_digits(*c));
            let links = link_names(m, &g.bodies).join(", ");
            row_cells([&(i + 1), &links, &g.class, &inner, &outer, &condition])
        });
        out.add_table(
            " | links | group | inner joints | outer joints | condition",
            rows,
        );
        out.add_line("");
    }

    /// Returns the greatest reaction of the cycle, for the first line; empty without loads.
    fn greatest_reaction(&self) -> String {
        let all = self.found.moments.iter().flat_map(|x| {
            let found = x.reactions.iter();
            found.map(|r| (vector_size(r.force), r.pair, x.drive))
        });
        let finite = all.filter(|(force, ..)| force.is_finite() && *force > 0.0);
        let Some((force, pair, at)) = finite.max_by(|a, b| a.0.total_cmp(&b.0)) else {
            return String::new();
        };
        let (unit, prefix) = unit_prefix(force);
        let (force, joint) = (
            five_digits(force / unit),
            &self.planar_mechanism().pairs[pair].name,
        );
        format!(
            "greatest reaction {force} {prefix}N at {joint} ({}); ",
            self.format_place(at)
        )
    }

    /// Adds the reactions of a group with a closed contour over the cycle, and explains its letters.
    fn write_group(&self, out: &mut Report, i: usize) {
        let Some(shown) = self.methods.last() else {
            return;
        };
        let (index, letters) = &self.found.contour_groups[i];
        let solved = self.found.moments.iter().filter_map(|at| {
            let group = at.groups.get(i)?;
            let reactions = group.reactions_by(*shown)?;
            Some((at, group, reactions))
        });
        let solved = solved.collect_vec();
        let all = solved.iter().flat_map(|(_, g, r)| magnitudes(r, &g.pose));
        let sizes = all.map(|(_, x)| x.abs()).filter(|x| x.is_finite());
        let (unit, prefix) = unit_prefix(sizes.fold(0.0, f64::max));
        out.add_line(format!(
            "Group {}: reactions in {prefix}N by the {} method; {}",
            self.group_name(*index),
            shown.name(),
            self.explain_letters(letters)
        ));
        let mut heads = format!("{} | D | F | K | M | L | guide | h, m | y, m", self.unit());
        if self.methods.contains(&GroupMethod::Delta) {
            heads += " | R46τ | R47τ | R34τ";
        }
        if self.methods.len() > 1 {
            heads += " | methods differ";
        }
        let rows = solved.iter();
        out.add_table(
            &heads,
            rows.map(|(at, g, r)| self.group_row(at, g, r, letters, unit)),
        );
        out.add_line("");
    }

    /// Explains the letters of a group and its further columns.
    fn explain_letters(&self, l: &ContourGroup) -> String {
        let m = self.planar_mechanism();
        let name = |p: PairId| m.pairs[p].name.as_str();
        let guide = name(l.guide);
        let on_the_way = if self.methods.contains(&GroupMethod::Delta) {
            let names = link_names(m, &[l.ternary, l.rods[0], l.rods[1]]).join(", ");
            format!(
                " On the way of the δ-point method: across the rods R46τ at F and R47τ at K, across Dδ R34τ at D (4, 6, 7 = {names})."
            )
        } else {
            String::new()
        };
        let names = "DFKML".chars().zip([l.d, l.f, l.k, l.m, l.l]);
        format!(
            "{}, guide = {guide}\n\
             The guide's reaction has the arm h about D; it acts at y along the guide from {guide}.{on_the_way}\n",
            names.map(|(l, p)| format!("{l} = {}", name(p))).join(", ")
        )
    }

    /// Returns a row of the table of a group, with forces in `unit`.
    fn group_row(
        &self,
        at: &Moment,
        g: &GroupSolutions,
        r: &GroupReactions,
        letters: &ContourGroup,
        unit: f64,
    ) -> Vec<String> {
        let mut row = vec![five_digits(self.shown_position(at.drive))];
        row.extend(magnitudes(r, &g.pose).map(|(_, v)| five_digits(v / unit)));
        let guide = self.found.linkage.pair_position(&at.pose, letters.guide);
        row.extend([r.arm, r.guide_offset(&g.pose, guide)].map(five_digits));
        if self.methods.contains(&GroupMethod::Delta) {
            let s = &g.steps;
            let on_the_way = [s.r46_tangential, s.r47_tangential, s.r34_tangential];
            row.extend(on_the_way.map(|v| five_digits(v / unit)));
        }
        if self.methods.len() > 1 {
            let differ = g.max_disagreement(self.methods);
            row.push(differ.map_or_else(String::new, |e| format!("{e:.0e}")));
        }
        row
    }

    /// Adds the greatest reaction of every joint.
    fn write_joints(&self, out: &mut Report) {
        let m = self.planar_mechanism();
        let peak = |p: PairId| {
            let each = self.found.moments.iter().filter_map(|x| {
                let r = x.reactions.iter().find(|r| r.pair == p)?;
                Some((vector_size(r.force), r.moment, x.drive))
            });
            let all = each.collect_vec();
            let (force, _, at) = *all.iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
            let moment = all.iter().map(|x| x.1.abs()).fold(0.0, f64::max);
            Some((&m.pairs[p], force, at, moment))
        };
        let peaks = (0..m.pairs.len()).filter_map(peak).collect_vec();
        if peaks.is_empty() {
            return out.add_line(
                "The equilibrium has no solution here: the mechanism is at a dead point.",
            );
        }
        let each = peaks.iter().map(|(_, force, _, moment)| force.max(*moment));
        let (unit, prefix) = unit_prefix(each.fold(0.0, f64::max));
        let some = |of: f64, x: f64| {
            if of > 0.0 {
                five_digits(x)
            } else {
                String::new()
            }
        };
        let rows = peaks.iter().map(|&(pair, force, at, moment)| {
            let links = link_names(m, &pair.bodies).join(", ");
            let at = some(force, self.shown_position(at));
            let [force, moment] = [five_digits(force / unit), some(moment, moment / unit)];
            row_cells([&pair.name, &pair.kind, &links, &force, &at, &moment])
        });
        out.add_line("Greatest reaction of each joint (equilibrium of all links)\n");
        let (at, n) = (self.unit(), prefix);
        let heads = format!("joint |  | links | force, {n}N | at, {at} | moment, {n}N·m");
        out.add_table(&heads, rows);
        out.add_line("");
    }

    fn write_summary(&self, out: &mut Report) {
        let (found, methods) = (self.found, self.methods);
        let what = if found.drive_slides() { "N" } else { "N·m" };
        for &p in &found.decomposition.drives {
            let efforts = found.moments.iter().filter_map(|x| {
                let r = x.reactions.iter().find(|r| r.pair == p)?;
                Some((r.effort?, x.drive))
            });
            let ends = efforts.minmax_by(|a, b| a.0.total_cmp(&b.0)).into_option();
            let Some((low, high)) = ends else { continue };
            let (unit, prefix) = unit_prefix(low.0.abs().max(high.0.abs()));
            let at = |(effort, drive): (f64, f64)| {
                format!(
                    "{} {prefix}{what} at {}",
                    five_digits(effort / unit),
                    self.format_place(drive)
                )
            };
            let name = &self.planar_mechanism().pairs[p].name;
            out.add_line(format!("Drive {name}: from {} to {}", at(low), at(high)));
        }
        let greatest = |f: &dyn Fn(&Moment) -> f64| {
            let each = found.moments.iter().map(f);
            each.filter(|x| x.is_finite()).fold(0.0, f64::max)
        };
        let of = |f: fn(&Worth) -> f64| greatest(&move |x| f(&x.worth));
        let (condition, residual) = (five_digits(of(|e| e.condition)), of(|e| e.residual));
        out.add_line(format!(
            "Equilibrium: condition up to {condition}, residual up to {residual:.0e} of the load"
        ));
        let power = greatest(&|x| x.load_power.abs());
        if power > 0.0 {
            let balance = greatest(&|x| (x.load_power + x.drive_power).abs()) / power;
            out.add_line(format!(
                "Power of drives, loads and inertia balances to {balance:.0e}"
            ));
        }
        if methods.len() > 1 && !found.contour_groups.is_empty() {
            let names = methods.iter().map(|x| x.name()).join(", ");
            let all = found.moments.iter().flat_map(|x| &x.groups);
            let differ = all.filter_map(|g| g.max_disagreement(methods));
            let worst = differ.fold(0.0, f64::max);
            out.add_line(format!("Methods {names} differ by {worst:.0e} at most"));
        }
    }
}
