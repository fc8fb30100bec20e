//! Statics for people: the groups, the reactions over the cycle, the greatest of each joint.

use crate::format::number::figure;
use crate::format::phrase::plural;
use crate::statics::assur::{Decomposition, Group};
use crate::statics::cycle::{Statics, Structure};
use crate::statics::planar::{PairId, PlanarMechanism};
use crate::view::layout::fit;
use crate::view::layout::table;
use crate::view::statics_words::{
    GroupMethod, bodies, disagreement, drive_position, drive_unit, group, magnitudes, pairs, prefix,
};
use itertools::Itertools;
use std::fmt::Write;

/// The groups as a table; `conditions` of their equations where known.
fn groups(
    m: &PlanarMechanism,
    d: &Decomposition,
    conditions: &[f64],
    width: Option<u16>,
) -> String {
    let rows = d.groups.iter().enumerate().map(|(i, g)| {
        vec![
            (i + 1).to_string(),
            bodies(m, &g.bodies),
            g.class.to_string(),
            pairs(m, &g.inner),
            pairs(m, &g.outer),
            conditions.get(i).map_or_else(String::new, |c| figure(*c)),
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

fn roman(class: usize) -> String {
    ["0", "I", "II", "III", "IV", "V", "VI", "VII", "VIII"]
        .get(class)
        .map_or_else(|| class.to_string(), |r| (*r).to_owned())
}

/// Above this, a group counts as singular in the pose.
const SINGULAR: f64 = 1e12;

/// The structure under every drive.
#[must_use]
pub fn structures(
    name: &str,
    m: &PlanarMechanism,
    found: &[Structure],
    width: Option<u16>,
) -> String {
    let rows = found.iter().map(|x| {
        let mut row = vec![m.pairs[x.drive].name.clone()];
        match &x.found {
            Ok((d, conditions)) => {
                let group = |(g, c): (&Group, &f64)| {
                    let inside = if g.locked.is_empty() {
                        ""
                    } else {
                        ", the drive inside"
                    };
                    let singular = if *c > SINGULAR {
                        ", singular in this pose"
                    } else {
                        ""
                    };
                    format!("{} ({}{inside}{singular})", bodies(m, &g.bodies), g.class)
                };
                let groups = d.groups.iter().zip(conditions).map(group);
                row.extend([roman(d.class()), groups.collect_vec().join("; ")]);
            }
            Err(e) => row.extend(["-".to_owned(), e.to_string()]),
        }
        row
    });
    let header = [
        "drive",
        "class",
        "Assur groups, in the order they are placed",
    ];
    let table = table(&header, rows.collect(), width);
    let head = fit(
        &format!("{name}: structure under each drive, those at the frame first"),
        width,
    );
    format!("{head}\n\n{table}\n")
}

/// The whole report, fitted to a terminal of `width` columns where one is given.
#[must_use]
pub fn statics(name: &str, s: &Statics, methods: &[GroupMethod], width: Option<u16>) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = write_statics(&mut out, name, s, methods, width);
    fit(&out, width)
}

fn write_statics(
    out: &mut String,
    name: &str,
    s: &Statics,
    methods: &[GroupMethod],
    width: Option<u16>,
) -> std::fmt::Result {
    let (m, d) = (&s.linkage.mechanism, &s.decomposition);
    writeln!(
        out,
        "{name}: {}{} driven by {}, class {}\n",
        verdict(s),
        plural(d.groups.len(), "Assur group"),
        if d.drives.is_empty() {
            "nothing".to_owned()
        } else {
            pairs(m, &d.drives)
        },
        roman(d.class())
    )?;
    if !d.groups.is_empty() {
        writeln!(out, "{}\n", groups(m, d, &s.conditions, width))?;
    }
    let loaded = s.moments.iter().any(|x| !x.loads.is_empty());
    for (i, (index, _)) in s.contour_groups.iter().enumerate().filter(|_| loaded) {
        group_table(out, s, i, *index, methods, width)?;
    }
    let loads = &s.loads;
    if loads.forces.is_empty() && loads.masses.iter().all(Option::is_none) {
        writeln!(
            out,
            "The file states no loads: give links a mass and centre, or forces under [[workload.force]]."
        )?;
    } else {
        joints(out, s, width)?;
        summary(out, s, methods)?;
    }
    if let Some(dead) = &s.dead {
        let who = dead.group.map_or_else(
            || "the drives".to_owned(),
            |g| format!("group {}", group(m, d, g)),
        );
        writeln!(
            out,
            "\nThe motion stops at {} {}: {who} is at a dead point (condition {}).",
            figure(drive_position(s, dead.drive)),
            drive_unit(s),
            figure(dead.condition)
        )?;
    }
    Ok(())
}

/// The greatest reaction of the cycle, for the first line; nothing without loads.
fn verdict(s: &Statics) -> String {
    let m = &s.linkage.mechanism;
    let all = s.moments.iter().flat_map(|x| {
        let found = x.whole.iter().flat_map(|w| &w.reactions);
        found.map(|r| (r.force[0].hypot(r.force[1]), r.pair, x.instant.drive))
    });
    let finite = all.filter(|(force, ..)| force.is_finite() && *force > 0.0);
    match finite.max_by(|a, b| a.0.total_cmp(&b.0)) {
        Some((force, pair, at)) => {
            let (unit, prefix) = prefix(force);
            format!(
                "greatest reaction {} {prefix}N at {} ({} {}); ",
                figure(force / unit),
                m.pairs[pair].name,
                figure(drive_position(s, at)),
                drive_unit(s)
            )
        }
        None => String::new(),
    }
}

fn group_table(
    out: &mut String,
    s: &Statics,
    i: usize,
    index: usize,
    methods: &[GroupMethod],
    width: Option<u16>,
) -> std::fmt::Result {
    let (m, d) = (&s.linkage.mechanism, &s.decomposition);
    let Some(shown) = methods.last() else {
        return Ok(());
    };
    let letters = &s.contour_groups[i].1;
    let solved = s.moments.iter().filter_map(|x| Some((x, x.groups.get(i)?)));
    let solved = solved
        .filter_map(|(x, g)| Some((x, g, shown.of(g)?)))
        .collect_vec();
    let all = solved.iter().flat_map(|(_, g, r)| magnitudes(r, &g.pose));
    let greatest = all
        .map(|(_, x)| x.abs())
        .filter(|x| x.is_finite())
        .fold(0.0, f64::max);
    let (unit, prefix) = prefix(greatest);
    let place = |l: &str, p: PairId| format!("{l} = {}", m.pairs[p].name);
    let names = [
        ("D", letters.d),
        ("F", letters.f),
        ("K", letters.k),
        ("M", letters.m),
        ("L", letters.l),
    ];
    writeln!(
        out,
        "Group {}: reactions in {prefix}N by the {} method; {}, guide = {}",
        group(m, d, index),
        shown.name(),
        names.iter().map(|(l, p)| place(l, *p)).join(", "),
        m.pairs[letters.guide].name
    )?;
    writeln!(
        out,
        "The guide's reaction has the arm h about D; it acts at y along the guide from {}.\n",
        m.pairs[letters.guide].name
    )?;
    let rows = solved.iter().map(|(x, g, r)| {
        let mut row = vec![figure(drive_position(s, x.instant.drive))];
        row.extend(magnitudes(r, &g.pose).map(|(_, v)| figure(v / unit)));
        let guide = s.linkage.place(&x.instant.pose, letters.guide);
        row.extend([figure(r.arm), figure(r.guide_offset(&g.pose, guide))]);
        if methods.len() > 1 {
            row.push(disagreement(g, methods).map_or_else(String::new, |e| format!("{e:.0e}")));
        }
        row
    });
    let mut header = vec![
        drive_unit(s),
        "D",
        "F",
        "K",
        "M",
        "L",
        "guide",
        "h, m",
        "y, m",
    ];
    if methods.len() > 1 {
        header.push("methods differ");
    }
    writeln!(out, "{}\n", table(&header, rows.collect(), width))
}

/// The greatest reaction of every joint.
fn joints(out: &mut String, s: &Statics, width: Option<u16>) -> std::fmt::Result {
    let m = &s.linkage.mechanism;
    let peak = |p: PairId| {
        let of = s.moments.iter().filter_map(|x| {
            let r = x.whole.as_ref()?.reactions.iter().find(|r| r.pair == p)?;
            Some((r.force[0].hypot(r.force[1]), r.moment, x.instant.drive))
        });
        let all = of.collect_vec();
        let force = all.iter().copied().max_by(|a, b| a.0.total_cmp(&b.0))?;
        let moment = all.iter().map(|x| x.1.abs()).fold(0.0, f64::max);
        Some((force, moment))
    };
    let peaks = (0..m.pairs.len())
        .filter_map(|p| Some((p, peak(p)?)))
        .collect_vec();
    if peaks.is_empty() {
        return writeln!(
            out,
            "The equilibrium has no solution here: the mechanism is at a dead point."
        );
    }
    let greatest = peaks
        .iter()
        .map(|(_, (f, m))| f.0.max(*m))
        .fold(0.0, f64::max);
    let (unit, prefix) = prefix(greatest);
    let rows = peaks.iter().map(|(p, ((force, _, at), moment))| {
        let pair = &m.pairs[*p];
        vec![
            pair.name.clone(),
            pair.kind.to_string(),
            bodies(m, &pair.bodies),
            figure(force / unit),
            figure(drive_position(s, *at)),
            if *moment > 0.0 {
                figure(moment / unit)
            } else {
                String::new()
            },
        ]
    });
    let (force, moment) = (format!("force, {prefix}N"), format!("moment, {prefix}N·m"));
    let at = format!("at, {}", drive_unit(s));
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

fn summary(out: &mut String, s: &Statics, methods: &[GroupMethod]) -> std::fmt::Result {
    let m = &s.linkage.mechanism;
    for &p in &s.decomposition.drives {
        let of = s.moments.iter().filter_map(|x| {
            let r = x.whole.as_ref()?.reactions.iter().find(|r| r.pair == p)?;
            Some((r.effort?, x.instant.drive))
        });
        let all = of.collect_vec();
        let ends = all
            .iter()
            .copied()
            .minmax_by(|a, b| a.0.total_cmp(&b.0))
            .into_option();
        let Some((low, high)) = ends else { continue };
        let (unit, prefix) = prefix(low.0.abs().max(high.0.abs()));
        let what = if s.drive_slides() { "N" } else { "N·m" };
        let at = |x: (f64, f64)| {
            format!(
                "{} {prefix}{what} at {} {}",
                figure(x.0 / unit),
                figure(drive_position(s, x.1)),
                drive_unit(s)
            )
        };
        writeln!(
            out,
            "Drive {}: from {} to {}",
            m.pairs[p].name,
            at(low),
            at(high)
        )?;
    }
    let greatest = |f: &dyn Fn(&crate::statics::cycle::Moment) -> f64| {
        s.moments
            .iter()
            .map(f)
            .filter(|x| x.is_finite())
            .fold(0.0, f64::max)
    };
    let power = greatest(&|x| x.load_power.abs());
    let balance = greatest(&|x| (x.load_power + x.drive_power).abs());
    let of = |f: fn(&crate::statics::kinetostatics::Equilibrium) -> f64| {
        greatest(&move |x| x.whole.as_ref().map_or(f64::NAN, f))
    };
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
    if methods.len() > 1 && !s.contour_groups.is_empty() {
        let names = methods.iter().map(|x| x.name()).join(", ");
        let all = s.moments.iter().flat_map(|x| &x.groups);
        let worst = all
            .filter_map(|g| disagreement(g, methods))
            .fold(0.0, f64::max);
        writeln!(out, "Methods {names} differ by {worst:.0e} at most")?;
    }
    Ok(())
}
