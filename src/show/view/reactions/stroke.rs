//! Joint reactions over a stroke.

use crate::statics::reactions::{Cycle, JointReaction, NEARLY_SINGULAR};
use crate::view::prelude::*;
use crate::view::reactions::couplings::{effort_unit, write_greatest};
use crate::view::reactions::text::{ADD_LOADS, pushing_remedy};
use crate::view::reactions::{HEADS, Reactions, is_possible, touch_word};

/// Reactions by position of the first drive.
#[derive(Debug)]
pub struct ReactionsOverStroke<'a> {
    /// The mechanism.
    pub(super) of: &'a Mechanism,
    pub(super) state: StateId,
    found: &'a Cycle,
}

impl<'a> ReactionsOverStroke<'a> {
    /// Describes the reactions of a state.
    pub fn new(of: &'a Mechanism, state: StateId, found: &'a Cycle) -> Self {
        ReactionsOverStroke { of, state, found }
    }

    /// Returns the positions that have reactions.
    pub(super) fn solved_positions(&self) -> impl Iterator<Item = (f64, Reactions<'a>)> {
        let reactions = |s| Reactions::new(self.of, self.state, s);
        let positions = self.found.positions.iter();
        positions.filter_map(move |(at, s)| Some((*at, reactions(s.as_ref().ok()?))))
    }

    /// Returns all of it as data. Positions are since the pose of the file, `[rad]` or the file's unit.
    pub fn json(&self) -> Value {
        let position = |(drive, s): &(f64, Result<_, _>)| match s {
            Ok(s) => {
                let reactions = Reactions::new(self.of, self.state, s).json();
                join_objects([reactions, json!({ "drive": drive })])
            }
            Err(e) => json!({ "drive": drive, "error": ToString::to_string(e) }),
        };
        json!({
            "mechanism": self.of.name,
            "state": self.of.states[self.state],
            "positions": self.found.positions.iter().map(position).collect::<Value>(),
            // The first that could not be reached.
            "stopped": self.found.stopped,
        })
    }

    /// Returns one joint and position a line.
    pub fn csv(&self) -> String {
        let heads = ["drive"].into_iter().chain(HEADS.split(',')).collect_vec();
        let solved = self.solved_positions().collect_vec();
        let rows = solved.iter().flat_map(|(at, r)| {
            r.csv_rows()
                .map(move |row| [vec![at.to_string()], row].concat())
        });
        write_table(&heads, rows)
    }

    fn drive_slides(&self) -> bool {
        self.found.drives.first().is_some_and(|d| d.1.is_slide())
    }

    /// Returns the unit of positions in texts.
    pub(super) fn unit(&self) -> &'static str {
        if self.drive_slides() {
            self.of.length_unit.symbol
        } else {
            "°"
        }
    }

    /// Returns a position in that unit.
    pub(super) fn shown_position(&self, x: f64) -> f64 {
        if self.drive_slides() {
            x
        } else {
            x.to_degrees()
        }
    }

    /// Returns a position with its unit.
    fn format_place(&self, x: f64) -> String {
        format!("{} {}", five_digits(self.shown_position(x)), self.unit())
    }

    /// Returns the report, fitted to a terminal of `width` columns if one is given.
    pub fn text(&self, width: Option<u16>) -> String {
        let mut out = Report::new(width);
        let all = self.solved_positions().collect_vec();
        self.write_head(&mut out, &all);
        let Some((_, first)) = all.first() else {
            out.add_line("No pose was reached.");
            return out.text();
        };
        self.write_peaks(&mut out, &all, first);
        self.write_contacts(&mut out, &all, first);
        self.write_drives(&mut out, &all, first);
        let passed = all.iter().map(|(at, r)| (*at, r.couplings())).collect_vec();
        write_greatest(&mut out, &passed, &|x| self.format_place(x));
        self.write_equilibrium(&mut out, &all);
        for (drive, s) in &self.found.positions {
            if let Err(e) = s {
                out.add_line(format!("At {}: {e}", self.format_place(*drive)));
            }
        }
        if let Some(place) = self.found.stopped {
            out.add_line(format!(
                "The stroke could not be followed to {}; `ozols analyze {}` says why",
                self.format_place(place),
                typed_option("stroke", "")
            ));
        }
        out.text()
    }

    /// Says over what the reactions are the greatest.
    fn write_head(&self, out: &mut Report, all: &[(f64, Reactions<'_>)]) {
        let open = if all.iter().any(|(_, r)| !r.is_unique()) {
            ", of minimum norm where redundant constraints leave them open"
        } else {
            ""
        };
        let (name, state) = (&self.of.name, &self.of.states[self.state]);
        let poses = count_noun(all.len(), "pose");
        out.add_line(format!(
            "{name}, state {state}: greatest joint reactions over {poses}{open}"
        ));
        out.add_line(if self.of.loads.drive_speeds.iter().any(|s| *s != 0.0) {
            "Inertia forces of the stated drive speed included; drives at constant speed\n"
        } else {
            "Drives at rest: no inertia forces; workload.drive_speed adds them\n"
        });
    }

    /// Adds the greatest reactions of each joint, and where they are.
    fn write_peaks(&self, out: &mut Report, all: &[(f64, Reactions<'_>)], first: &Reactions<'_>) {
        let greatest_of = |i: usize, size: fn(&JointReaction) -> f64| {
            let each = all.iter().map(|(at, r)| (size(&r.found.reactions[i]), *at));
            each.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or_default()
        };
        let peaks = first.found.reactions.iter().enumerate().map(|(i, r)| {
            let sizes = [JointReaction::force_size, JointReaction::moment_size];
            (r.joint, sizes.map(|size| greatest_of(i, size)))
        });
        let peaks = peaks.collect_vec();
        let greatest = peaks
            .iter()
            .flat_map(|(_, of)| of.map(|x| x.0))
            .fold(0.0, f64::max);
        let (scale, prefix) = unit_prefix(greatest);
        if greatest == 0.0 {
            out.add_line(format!("The loads are nothing here: {ADD_LOADS}.\n"));
        }
        let rows = peaks.iter().map(|(joint, of)| {
            let mut row = first.joint_and_type(*joint).to_vec();
            row.extend(
                of.iter()
                    .flat_map(|(x, at)| [x / scale, self.shown_position(*at)])
                    .map(five_digits),
            );
            row
        });
        let at = self.unit();
        out.add_table(
            &format!("joint |  | |F|, {prefix}N | at, {at} | |M|, {prefix}N·m | at, {at}"),
            rows,
        );
        out.add_line("");
    }

    /// Adds contacts that would have to do what faces cannot.
    fn write_contacts(
        &self,
        out: &mut Report,
        all: &[(f64, Reactions<'_>)],
        first: &Reactions<'_>,
    ) {
        for (i, contact) in first.found.contacts.iter().enumerate() {
            let touches = all.iter().map(|(at, r)| (*at, &r.found.contacts[i]));
            let bad = touches.filter(|(_, c)| !is_possible(c)).collect_vec();
            if let Some((from, c)) = bad.first() {
                out.add_line(format!(
                    "NOT AS CONTACTS ACT: {} in {}, first at {}, where it {}; {}",
                    first.joint_name(contact.joint),
                    count_noun(bad.len(), "pose"),
                    self.format_place(*from),
                    touch_word(c),
                    pushing_remedy()
                ));
            }
        }
    }

    /// Adds the least and greatest effort of each drive.
    fn write_drives(&self, out: &mut Report, all: &[(f64, Reactions<'_>)], first: &Reactions<'_>) {
        for (i, joint) in first.found.reactions.iter().enumerate() {
            let Some((freedom, _)) = joint.effort else {
                continue;
            };
            let each = all
                .iter()
                .filter_map(|(at, r)| Some((r.found.reactions[i].effort?.1, *at)));
            let each = each.collect_vec();
            let least = each.iter().min_by(|a, b| a.0.total_cmp(&b.0));
            let most = each.iter().max_by(|a, b| a.0.total_cmp(&b.0));
            let words = |(x, at): &(f64, f64)| {
                format!(
                    "{} {} at {}",
                    five_digits(*x),
                    effort_unit(freedom),
                    self.format_place(*at)
                )
            };
            if let (Some(least), Some(most)) = (least.map(words), most.map(words)) {
                let (id, freedom) = (first.joint_name(joint.joint), freedom.name());
                out.add_line(format!(
                    "Drive {id} holds {freedom}: from {least} to {most}"
                ));
            }
        }
    }

    /// Says how well the equations are solved where that is worst.
    fn write_equilibrium(&self, out: &mut Report, all: &[(f64, Reactions<'_>)]) {
        let solved = all.iter().map(|(at, r)| (*at, r.found));
        let residual = solved.clone().map(|(_, s)| s.residual).fold(0.0, f64::max);
        let worst = solved.max_by(|a, b| a.1.condition.total_cmp(&b.1.condition));
        let Some((place, s)) = worst else { return };
        let (condition, at) = (five_digits(s.condition), self.format_place(place));
        out.add_line(format!(
            "Equilibrium: condition up to {condition} at {at}, residual up to {residual:.0e} of the load"
        ));
        if s.nearly_singular() {
            out.add_line(format!(
                "Warning: nearly singular there (condition above {NEARLY_SINGULAR:.0e}): small errors of manufacture change these reactions much"
            ));
        }
    }
}

/// Maximum number of lines: more cannot be distinguished.
const LINES: usize = 10;

impl ReactionsOverStroke<'_> {
    /// Returns the forces in the joints of output links and objects, and what each drive and coupling does, by position of the first
    /// drive. Returns `None` if no position has reactions.
    pub fn chart(&self) -> Option<Chart> {
        let solved = self.solved_positions().collect_vec();
        let lines = self.chart_lines(&solved);
        if lines.is_empty() {
            return None;
        }
        let series = lines.into_iter().take(LINES);
        let series = series.map(|((joint, name), points)| Series {
            name,
            points,
            style: if joint { Style::Line } else { Style::Dashed },
        });
        let unique = solved.iter().all(|(_, r)| r.is_unique());
        let open = "of minimum norm, since redundant constraints leave them open";
        let others = match &self.of.couplings[..] {
            [] => "what a drive does",
            _ => "what drives and couplings do",
        };
        let state = &self.of.states[self.state];
        Some(Chart {
            title: format!("Forces in the joints of the outputs, state {state}"),
            subtitle: if unique { "" } else { open }.to_owned(),
            x: Axis::linear(format!("drive, {}", self.unit())),
            y: Axis::linear(format!("force, N; dashed: {others}")),
            series: series.collect(),
        })
    }

    /// Returns the values of each line by position: those in the joints of outputs and objects (true), and those of drives and
    /// couplings.
    fn chart_lines(
        &self,
        solved: &[(f64, Reactions<'_>)],
    ) -> BTreeMap<(bool, String), Vec<(f64, f64)>> {
        let m = self.of;
        let worked = |l: &LinkId| matches!(m.links[*l].role, Role::Output | Role::Object);
        let mut lines: BTreeMap<(bool, String), Vec<(f64, f64)>> = BTreeMap::new();
        for (drive, reactions) in solved {
            let at = self.shown_position(*drive);
            let mut add = |joint, name, x| lines.entry((joint, name)).or_default().push((at, x));
            for r in &reactions.found.reactions {
                let id = &m.joints[r.joint].id;
                if m.joints[r.joint].links.iter().any(worked) {
                    add(true, id.clone(), r.force_size());
                }
                if let Some((freedom, effort)) = r.effort {
                    add(
                        false,
                        format!("drive {id}, {}", effort_unit(freedom)),
                        effort.abs(),
                    );
                }
            }
            for (name, force) in reactions.couplings().iter().map(|c| c.chart_line()) {
                add(false, name, force);
            }
        }
        lines
    }
}
