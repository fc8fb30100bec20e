//! Statics for people: the groups, the reactions over the cycle, the greatest of each joint.

use crate::statics::assur_class::roman;
use crate::statics::contour_group::ContourGroup;
use crate::statics::contour_group::pose::GroupReactions;
use crate::statics::contour_group::solutions::{GroupMethod, GroupSolutions};
use crate::statics::cycle::Moment;
use crate::statics::kinetostatics::{LinkInertia, Worth};
use crate::statics::planar::PairId;
use crate::view::claims;
use crate::view::prelude::*;
use crate::view::reactions::text::{NO_STRAIN, no_loads};
use crate::view::statics::{Decomposed, GroupData, StaticsData, Structures, magnitudes};
use std::fmt::Write;

/// The groups as a table.
fn groups(all: &[GroupData<'_>], width: Option<u16>) -> String {
    let rows = all.iter().enumerate().map(|(i, g)| {
        vec![
            (i + 1).to_string(),
            g.links.join(", "),
            g.kind.clone(),
            g.inner.join(", "),
            g.outer.join(", "),
            g.condition.map_or_else(String::new, figure),
        ]
    });
    let header = [
        "",
        "links",
        "group",
        "inner joints",
        "outer joints",
        "condition",
    ];
    table(&header, rows.collect(), width)
}

/// Above this, a group counts as singular in the pose.
const SINGULAR: f64 = 1e12;

/// The structure under every drive.
#[must_use]
pub fn structures(s: &Structures<'_>, width: Option<u16>) -> String {
    let group = |g: &GroupData| {
        let inside = if g.locked.is_empty() {
            ""
        } else {
            ", the drive inside"
        };
        let singular = match g.condition {
            Some(c) if c > SINGULAR => ", singular in this pose",
            _ => "",
        };
        format!("{} ({}{inside}{singular})", g.links.join(", "), g.kind)
    };
    let rows = s.drives.iter().map(|x| {
        let [class, what] = match &x.found {
            Decomposed::Groups { class, groups } => {
                [roman(*class), groups.iter().map(group).join("; ")]
            }
            Decomposed::Not { error } => ["-".to_owned(), error.clone()],
        };
        vec![x.drive.to_owned(), class, what]
    });
    let header = [
        "drive",
        "class",
        "Assur groups, in the order they are placed",
    ];
    let table = table(&header, rows.collect(), width);
    let head = fit(
        &format!(
            "{}: structure under each drive, those at the frame first",
            s.mechanism
        ),
        width,
    );
    format!("{head}\n\n{table}\n")
}

/// The report, fitted to a terminal of `width` columns where one is given.
#[must_use]
pub fn statics(s: &StaticsData<'_>, width: Option<u16>) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = write_statics(&mut out, s, width);
    fit(&out, width)
}

fn write_statics(out: &mut String, s: &StaticsData<'_>, width: Option<u16>) -> std::fmt::Result {
    let drives = if s.drives.is_empty() {
        "nothing".to_owned()
    } else {
        s.drives.join(", ")
    };
    writeln!(
        out,
        "{}: {}{} driven by {drives}, class {}\n",
        s.mechanism,
        verdict(s),
        plural(s.groups.len(), "Assur group"),
        roman(s.class)
    )?;
    if !s.groups.is_empty() {
        writeln!(out, "{}\n", groups(&s.groups, width))?;
    }
    if s.found.moments.iter().any(|x| !x.loads.is_empty()) {
        for i in 0..s.found.contour_groups.len() {
            group_table(out, s, i, width)?;
        }
    }
    if !s.found.loaded {
        let misalignments = s.of.loads.misalignments.len();
        writeln!(out, "{}", no_loads(misalignments))?;
        if misalignments > 0 {
            writeln!(out, "{NO_STRAIN}")?;
        }
    } else {
        joints(out, s, width)?;
        inertia(out, s, width)?;
        summary(out, s)?;
    }
    if let Some(dead) = &s.stopped {
        let who = dead.group.map_or_else(
            || "the drives".to_owned(),
            |g| format!("group {}", s.groups[g].name()),
        );
        writeln!(
            out,
            "\nThe motion stops at {} {}: {who} is at a dead point (condition {}).",
            figure(s.shown(dead.drive)),
            s.unit(),
            figure(dead.condition)
        )?;
    }
    write!(out, "{}", claims::text(&s.claims, width))
}

/// The greatest reaction of the cycle, for the first line; nothing without loads.
fn verdict(s: &StaticsData<'_>) -> String {
    let all = s.positions.iter().flat_map(|x| {
        let found = x.reactions.iter();
        found.map(|r| (r.passed.force[0].hypot(r.passed.force[1]), r.joint, x.drive))
    });
    let finite = all.filter(|(force, ..)| force.is_finite() && *force > 0.0);
    match finite.max_by(|a, b| a.0.total_cmp(&b.0)) {
        Some((force, joint, at)) => {
            let (unit, prefix) = prefix(force);
            format!(
                "greatest reaction {} {prefix}N at {joint} ({} {}); ",
                figure(force / unit),
                figure(s.shown(at)),
                s.unit()
            )
        }
        None => String::new(),
    }
}

/// The reactions of a group with a closed contour over the cycle, with what its letters stand for.
fn group_table(
    out: &mut String,
    s: &StaticsData<'_>,
    i: usize,
    width: Option<u16>,
) -> std::fmt::Result {
    let Some(shown) = s.methods.last() else {
        return Ok(());
    };
    let (index, letters) = &s.found.contour_groups[i];
    let moments = s.found.moments.iter();
    let solved = moments.filter_map(|x| Some((x, x.groups.get(i)?)));
    let solved = solved
        .filter_map(|(at, group)| {
            let reactions = group.by(*shown)?;
            Some(SolvedMoment {
                at,
                group,
                reactions,
            })
        })
        .collect_vec();
    let all = solved
        .iter()
        .flat_map(|x| magnitudes(&x.reactions, &x.group.pose));
    let greatest = all
        .map(|(_, x)| x.abs())
        .filter(|x| x.is_finite())
        .fold(0.0, f64::max);
    let (unit, prefix) = prefix(greatest);
    writeln!(
        out,
        "Group {}: reactions in {prefix}N by the {} method; {}",
        s.groups[*index].name(),
        shown.name(),
        letters_words(s, letters)
    )?;
    let rows = solved.iter().map(|x| x.row(s, letters, unit));
    let mut header = vec![s.unit()];
    header.extend(["D", "F", "K", "M", "L", "guide", "h, m", "y, m"]);
    if s.methods.contains(&GroupMethod::Delta) {
        header.extend(["R46τ", "R47τ", "R34τ"]);
    }
    if s.methods.len() > 1 {
        header.push("methods differ");
    }
    writeln!(out, "{}\n", table(&header, rows.collect(), width))
}

/// Which joints the letters of a group are, and what its further columns are.
fn letters_words(s: &StaticsData<'_>, letters: &ContourGroup) -> String {
    let m = &s.found.linkage.mechanism;
    let name = |p: PairId| m.pairs[p].name.as_str();
    let names = [
        ("D", letters.d),
        ("F", letters.f),
        ("K", letters.k),
        ("M", letters.m),
        ("L", letters.l),
    ];
    let guide = name(letters.guide);
    let on_the_way = if s.methods.contains(&GroupMethod::Delta) {
        let names = [letters.ternary, letters.rods[0], letters.rods[1]].map(|b| &m.bodies[b].name);
        format!(
            " On the way of the δ-point method: across the rods R46τ at F and R47τ at K, across Dδ R34τ at D (4, 6, 7 = {}, {}, {}).",
            names[0], names[1], names[2]
        )
    } else {
        String::new()
    };
    format!(
        "{}, guide = {guide}\n\
         The guide's reaction has the arm h about D; it acts at y along the guide from {guide}.{on_the_way}\n",
        names.map(|(l, p)| format!("{l} = {}", name(p))).join(", ")
    )
}

/// A group at a moment of the cycle, with its reactions by the method that is shown.
struct SolvedMoment<'a> {
    at: &'a Moment,
    group: &'a GroupSolutions,
    reactions: GroupReactions,
}

impl SolvedMoment<'_> {
    /// A row of its table, forces in `unit`.
    fn row(&self, s: &StaticsData<'_>, letters: &ContourGroup, unit: f64) -> Vec<String> {
        let (g, r) = (self.group, &self.reactions);
        let mut row = vec![figure(s.shown(self.at.drive))];
        row.extend(magnitudes(r, &g.pose).map(|(_, v)| figure(v / unit)));
        let guide = s.found.linkage.place(&self.at.pose, letters.guide);
        row.extend([figure(r.arm), figure(r.guide_offset(&g.pose, guide))]);
        if s.methods.contains(&GroupMethod::Delta) {
            let steps = &g.steps;
            let on_the_way = [
                steps.r46_tangential,
                steps.r47_tangential,
                steps.r34_tangential,
            ];
            row.extend(on_the_way.map(|v| figure(v / unit)));
        }
        if s.methods.len() > 1 {
            let differ = g.disagreement(s.methods);
            row.push(differ.map_or_else(String::new, |e| format!("{e:.0e}")));
        }
        row
    }
}

/// The greatest reaction of every joint.
fn joints(out: &mut String, s: &StaticsData<'_>, width: Option<u16>) -> std::fmt::Result {
    let m = &s.found.linkage.mechanism;
    let peak = |p: PairId| {
        let each = s.found.moments.iter().filter_map(|x| {
            let r = x.reactions.iter().find(|r| r.pair == p)?;
            Some((r.force[0].hypot(r.force[1]), r.moment, x.drive))
        });
        let all = each.collect_vec();
        let (force, _, at) = *all.iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
        let moment = all.iter().map(|x| x.1.abs()).fold(0.0, f64::max);
        Some((&m.pairs[p], force, at, moment))
    };
    let peaks = (0..m.pairs.len()).filter_map(peak).collect_vec();
    if peaks.is_empty() {
        return writeln!(
            out,
            "The equilibrium has no solution here: the mechanism is at a dead point."
        );
    }
    let each = peaks.iter().map(|(_, force, _, moment)| force.max(*moment));
    let (unit, prefix) = prefix(each.fold(0.0, f64::max));
    let rows = peaks.iter().map(|&(pair, force, at, moment)| {
        vec![
            pair.name.clone(),
            pair.kind.to_string(),
            pair.bodies.map(|b| m.bodies[b].name.as_str()).join(", "),
            figure(force / unit),
            if force > 0.0 {
                figure(s.shown(at))
            } else {
                String::new()
            },
            if moment > 0.0 {
                figure(moment / unit)
            } else {
                String::new()
            },
        ]
    });
    let (force, moment) = (format!("force, {prefix}N"), format!("moment, {prefix}N·m"));
    let at = format!("at, {}", s.unit());
    let header = [
        "joint",
        "",
        "links",
        force.as_str(),
        at.as_str(),
        moment.as_str(),
    ];
    writeln!(
        out,
        "Greatest reaction of each joint (equilibrium of all links)\n"
    )?;
    writeln!(out, "{}\n", table(&header, rows.collect(), width))
}

/// The greatest acceleration and inertia force of every link, where drives have speeds.
fn inertia(out: &mut String, s: &StaticsData<'_>, width: Option<u16>) -> std::fmt::Result {
    let size = |v: [f64; 2]| v[0].hypot(v[1]);
    let links = s.positions.first().map_or(0, |x| x.links.len());
    let peaks = (0..links).filter_map(|i| {
        let all = s.positions.iter().map(|x| (&x.links[i], x.drive));
        let most = |of: &dyn Fn(&LinkInertia) -> f64| {
            let each = all.clone().map(|(l, drive)| (of(&l.inertia), drive));
            each.max_by(|a, b| a.0.total_cmp(&b.0))
        };
        let (acceleration, at) = most(&|l| size(l.acceleration))?;
        let (turning, _) = most(&|l| l.angular_acceleration.abs())?;
        let (force, _) = most(&|l| size(l.force))?;
        let (moment, _) = most(&|l| l.moment.abs())?;
        let link = all.clone().next()?.0.link;
        (acceleration > 0.0 || turning > 0.0).then_some((
            link,
            at,
            [acceleration, turning, force, moment],
        ))
    });
    let peaks = peaks.collect_vec();
    if peaks.is_empty() {
        return Ok(());
    }
    let rows = peaks.iter().map(|(link, at, figures)| {
        let mut row = vec![(*link).to_owned(), figure(figures[0]), figure(s.shown(*at))];
        row.extend(figures[1..].iter().map(|x| figure(*x)));
        row
    });
    let at = format!("at, {}", s.unit());
    let header = [
        "link",
        "a of centre, m/s²",
        at.as_str(),
        "ε, rad/s²",
        "inertia force, N",
        "inertia moment, N·m",
    ];
    writeln!(
        out,
        "Greatest acceleration and inertia force of each link with mass\n"
    )?;
    writeln!(out, "{}\n", table(&header, rows.collect(), width))
}

fn summary(out: &mut String, s: &StaticsData<'_>) -> std::fmt::Result {
    let (found, methods) = (s.found, s.methods);
    let what = if found.drive_slides() { "N" } else { "N·m" };
    for (&p, name) in found.decomposition.drives.iter().zip(&s.drives) {
        let efforts = found.moments.iter().filter_map(|x| {
            let r = x.reactions.iter().find(|r| r.pair == p)?;
            Some((r.effort?, x.drive))
        });
        let ends = efforts.minmax_by(|a, b| a.0.total_cmp(&b.0)).into_option();
        let Some((low, high)) = ends else { continue };
        let (unit, prefix) = prefix(low.0.abs().max(high.0.abs()));
        let at = |(effort, drive): (f64, f64)| {
            format!(
                "{} {prefix}{what} at {} {}",
                figure(effort / unit),
                figure(s.shown(drive)),
                s.unit()
            )
        };
        writeln!(out, "Drive {name}: from {} to {}", at(low), at(high))?;
    }
    let greatest = |f: &dyn Fn(&Moment) -> f64| {
        let each = found.moments.iter().map(f);
        each.filter(|x| x.is_finite()).fold(0.0, f64::max)
    };
    let power = greatest(&|x| x.load_power.abs());
    let balance = greatest(&|x| (x.load_power + x.drive_power).abs());
    let of = |f: fn(&Worth) -> f64| greatest(&move |x| f(&x.worth));
    writeln!(
        out,
        "Equilibrium: condition up to {}, residual up to {:.0e} of the load",
        figure(of(|e| e.condition)),
        of(|e| e.residual)
    )?;
    if power > 0.0 {
        writeln!(
            out,
            "Power of drives, loads and inertia balances to {:.0e}",
            balance / power
        )?;
    }
    if methods.len() > 1 && !found.contour_groups.is_empty() {
        let names = methods.iter().map(|x| x.name()).join(", ");
        let all = found.moments.iter().flat_map(|x| &x.groups);
        let worst = all
            .filter_map(|g| g.disagreement(methods))
            .fold(0.0, f64::max);
        writeln!(out, "Methods {names} differ by {worst:.0e} at most")?;
    }
    Ok(())
}
