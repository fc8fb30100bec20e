//! A torsional drive for people: the bar, whether it runs its programme, and why.

use crate::drive::driving::{CamDesign, DampingFrom, Design};
use crate::drive::programme::{Endurance, Event, PATIENCE};
use crate::drive::swing::End;
use crate::drive::torsion::{Remedy, decrement, stored_energy};
use crate::model::claim::Topic;
use crate::view::claims::{self, about};
use crate::view::drive::{Drive, feed_moments, samples};
use crate::view::prelude::*;
use std::fmt::Write;

/// Rows of the programme shown before the rest is left out.
const SHOWN: usize = 24;
/// Pieces of the cam's push shown before the rest is left out.
const PIECES: usize = 6;

/// The report, fitted to a terminal of `width` columns where one is given.
#[must_use]
pub fn drive(d: &Drive<'_>, width: Option<u16>) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = match d.design {
        Some(design) => designed(&mut out, d, design, width),
        None => refused(&mut out, d, width),
    };
    out += &claims::text(&about(&d.file.claims, Topic::Drive), width);
    fit(&out, width)
}

/// A length in the file's unit, with its symbol.
fn length(d: &Drive<'_>, x: f64) -> String {
    d.file.length_unit.words(x)
}

fn degrees(x: f64) -> String {
    format!("{}°", significant(x.to_degrees()))
}

fn refused(out: &mut String, d: &Drive<'_>, width: Option<u16>) -> std::fmt::Result {
    let spec = &d.file.spec;
    writeln!(
        out,
        "{}: no torsion bar swings {} in {} s\n",
        d.file.name,
        degrees(2.0 * d.file.spec.twist),
        significant(d.file.spec.period / 2.0)
    )?;
    if let Some(t) = d.sizing.trials.last() {
        if t.strong {
            writeln!(
                out,
                "  no room: the bar that satisfies (11), d = {}, must be l = {} long; there are {}",
                length(d, t.bar.diameter),
                length(d, t.bar.length),
                spec.max_length.map_or_else(String::new, |l| length(d, l))
            )?
        } else {
            writeln!(
                out,
                "  (11) fails: the last bar tried, d = {} and l = {}, may be twisted by [φ] = {}, not more than φ0 = {}",
                length(d, t.bar.diameter),
                length(d, t.bar.length),
                degrees(t.allowable_twist),
                degrees(d.file.spec.twist)
            )?
        }
    }
    if let Some(Remedy {
        length: l,
        allowable_stress,
        period,
        twist,
        inertia,
    }) = d.sizing.remedy
    {
        let lines = [
            "  Any one of these is enough (with a bar of any diameter):".to_owned(),
            format!("    a bar longer than {}", length(d, l)),
            format!(
                "    a material of [τ_s] above {} MPa",
                significant(allowable_stress * 1e-6)
            ),
            format!("    a period above {} s", significant(period)),
            format!("    a swing 2φ0 below {}", degrees(2.0 * twist)),
            format!("    an inertia below {} kg·m²", significant(inertia)),
        ];
        writeln!(out, "{}", lines.join("\n"))?;
    }
    writeln!(out, "\n{}", trials(d, width))
}

fn trials(d: &Drive<'_>, width: Option<u16>) -> String {
    let (metres, symbol) = (d.file.length_unit.metres, d.file.length_unit.symbol);
    let rows = d.sizing.trials.iter().map(|t| {
        let verdict = match (t.strong, t.fits) {
            (true, true) => "holds",
            (false, _) => "(11) fails",
            (true, false) => "too long",
        };
        let mut row = [
            t.bar.length / metres,
            t.bar.diameter / metres,
            t.allowable_twist.to_degrees(),
            d.file.spec.twist.to_degrees(),
        ]
        .map(significant)
        .to_vec();
        row.push(verdict.to_owned());
        row
    });
    let (l, bar) = (format!("l, {symbol}"), format!("d, {symbol}"));
    table(&[&l, &bar, "[φ], °", "φ0, °", ""], rows.collect(), width)
}

fn designed(
    out: &mut String,
    d: &Drive<'_>,
    design: &Design,
    width: Option<u16>,
) -> std::fmt::Result {
    let spec = &d.file.spec;
    let wanted = plural(design.run.wanted, "swing");
    let verdict = if d.complete() {
        format!("all {wanted} latched")
    } else {
        format!("fails after {} of {wanted}", design.run.latched)
    };
    writeln!(
        out,
        "{}: torsion bar d = {}, l = {}; swings {} in {} s, {verdict}\n",
        d.file.name,
        length(d, design.bar.diameter),
        length(d, design.bar.length),
        degrees(2.0 * d.file.spec.twist),
        significant(d.file.spec.period / 2.0)
    )?;
    if let Some((disc, swing)) = design.run.swings().last().filter(|_| !d.complete()) {
        let why = match swing.end {
            End::Stuck => "is stuck: friction is stronger than the wound bar".to_owned(),
            End::Missed { missing } => format!(
                "stops {} short of its latch, which catches {}; feed more energy or lower friction",
                degrees(missing),
                degrees(spec.capture)
            ),
            End::Latched { .. } | End::Caught { .. } => String::new(),
        };
        writeln!(out, "  disc {} {why}\n", disc + 1)?;
    }
    let second = if d.file.spec.inertias[1] == d.file.spec.inertias[0] {
        String::new()
    } else {
        format!(" and {} kg·m²", significant(d.file.spec.inertias[1]))
    };
    writeln!(
        out,
        "  I = {} kg·m²{second}, k = {} N·m/rad, wound by {} at {} MPa of {}: {} J",
        significant(d.file.spec.inertias[0]),
        significant(design.stiffness),
        degrees(d.file.spec.twist),
        significant(design.bar.stress(spec.twist) * 1e-6),
        significant(spec.allowable_stress * 1e-6),
        significant(stored_energy(design.stiffness, d.file.spec.twist))
    )?;
    losses(out, d, design)?;
    motions(out, d, design)?;
    if let Some(samples) = &d.samples {
        samples::write(out, samples)?;
    }
    writeln!(out, "\n  Sizing, (10) and (11):\n\n{}", trials(d, width))?;
    writeln!(out, "\n  Programme:\n\n{}", programme(d, width))
}

fn losses(out: &mut String, d: &Drive<'_>, design: &Design) -> std::fmt::Result {
    let from = match design.damping_from {
        DampingFrom::Stated => "as stated",
        DampingFrom::MissingAngle => "viscous, from the missing angle",
        DampingFrom::None => "none stated",
    };
    writeln!(
        out,
        "  damping ({from}): {} N·m·s/rad and {} N·m",
        significant(design.damping.viscous),
        significant(design.damping.coulomb)
    )?;
    if design.missing > 0.0 {
        writeln!(
            out,
            "  without the cam a swing ends Δφ = {} short: δ = {} a swing (6), E_fr = {} J (12)",
            degrees(design.missing),
            significant(decrement(
                d.file.spec.twist,
                d.file.spec.twist - design.missing
            )),
            significant(design.friction_energy)
        )?;
    }
    needed_feed(out, design)?;
    if let pieces @ [_, _, ..] = &*feed_moments(design) {
        feed_pieces(out, pieces)?;
    }
    if d.complete() {
        endurance(out, &design.endurance)?;
    }
    if let Some(cam) = &design.cam {
        let exact = cam.needed.as_ref().map_or_else(String::new, |s| {
            format!("; {} N/m by the simulation", significant(s.rate))
        });
        writeln!(
            out,
            "  cam spring: c = {} N/m (14), which gives {} J (13){exact}",
            significant(cam.spring.rate),
            significant(cam.spring.energy())
        )?;
        electromagnet(out, d, cam)?;
    }
    Ok(())
}

/// The work that the cam must give for the disc to arrive.
fn needed_feed(out: &mut String, design: &Design) -> std::fmt::Result {
    let arrive = match feed_moments(design).len() {
        0 | 1 => "to arrive at rest",
        _ => "to arrive",
    };
    match design.needed_feed {
        Some(needed) if design.friction_energy > 0.0 => writeln!(
            out,
            "  {arrive} the cam must give {} J, {:+.2} % on (12), since the fed swing is longer and faster; {} J in this run",
            significant(needed),
            (needed / design.friction_energy - 1.0) * 100.0,
            significant(design.feed)
        ),
        Some(needed) => writeln!(
            out,
            "  {arrive} the cam must give {} J",
            significant(needed)
        ),
        None => writeln!(
            out,
            "  no work of the cam brings the disc to its latch: it stops before the push begins"
        ),
    }
}

/// The push of a cam that differs from piece to piece.
fn feed_pieces(out: &mut String, all: &[(f64, f64)]) -> std::fmt::Result {
    let piece = |(from, moment): &(f64, f64)| {
        format!("{} N·m from {}", significant(*moment), degrees(*from))
    };
    let pieces: Vec<String> = all.iter().take(PIECES).map(piece).collect();
    write!(out, "  the cam pushes with {}", pieces.join(", "))?;
    match all.len().saturating_sub(PIECES) {
        0 => writeln!(out, ", up to the latch"),
        more => writeln!(
            out,
            " and {} more, up to the latch; --format json has them all",
            plural(more, "piece")
        ),
    }
}

/// Whether the programme could go on for ever.
fn endurance(out: &mut String, endurance: &Endurance) -> std::fmt::Result {
    match *endurance {
        Endurance::Lasts { missing } => writeln!(
            out,
            "  repeated unchanged, the programme latches every swing in the long run, at most {} short",
            degrees(missing)
        ),
        Endurance::Drifts { missing } => writeln!(
            out,
            "  repeated unchanged, the programme still drifts after {PATIENCE} swings, {} short by then",
            degrees(missing)
        ),
        Endurance::Fails { after } => writeln!(
            out,
            "  BUT NOT FOR LONG: of the programme repeated unchanged, {after} swings are latched and the next one misses; the cam must give more"
        ),
    }
}

/// When the electromagnets are on, what that takes, and what the cam looks like.
fn electromagnet(out: &mut String, d: &Drive<'_>, cam: &CamDesign) -> std::fmt::Result {
    let m = &cam.magnet;
    let times = m.pulses.iter().map(|p| p.off - p.on);
    let least = times.clone().fold(f64::INFINITY, f64::min);
    let most = times.fold(0.0, f64::max);
    let on = span(significant(least), significant(most));
    writeln!(
        out,
        "  electromagnet: on at each release for {on} s, up to where the push begins; lifts the follower by {} against {} to {} N: {} J a swing, {} J a cycle, {} W on average; spring c = {} N/m for this run",
        length(d, cam.fitted.stroke),
        significant(m.first_force),
        significant(m.last_force),
        significant(m.energy_per_swing),
        significant(m.energy_per_cycle),
        significant(m.mean_power),
        significant(cam.fitted.rate)
    )?;
    let (Some(p), Some((_, roller))) = (&cam.profile, d.file.spec.cam.and_then(|c| c.profile))
    else {
        return writeln!(
            out,
            "    give cam_radius and roller_radius, and --svg writes the cam's profile as SVG, CSV and DXF"
        );
    };
    writeln!(
        out,
        "  cam profile: {}, pressure angle up to {}{}; --svg writes it as SVG, CSV and DXF",
        plural(p.grooves.len(), "groove"),
        degrees(p.pressure_angle),
        if p.both_ways {
            ""
        } else {
            "; its flank begins before the middle and feeds swings one way only"
        },
    )?;
    if roller > p.least_curvature {
        writeln!(
            out,
            "    THE ROLLER IS TOO LARGE: its path bulges with a radius of {}, and a larger roller cuts the flank away",
            length(d, p.least_curvature)
        )?;
    }
    if !p.closes {
        writeln!(
            out,
            "    {} does not divide a turn: stepwise rotation finds no groove after {} of a disc",
            degrees(2.0 * d.file.spec.twist),
            plural(p.grooves.len(), "swing")
        )?;
    }
    Ok(())
}

fn motions(out: &mut String, d: &Drive<'_>, design: &Design) -> std::fmt::Result {
    let same = d.file.spec.inertias[0] == d.file.spec.inertias[1];
    for (i, m) in design
        .motions
        .iter()
        .enumerate()
        .take(if same { 1 } else { 2 })
    {
        let who = if same {
            "either disc".to_owned()
        } else {
            format!("disc {}", i + 1)
        };
        writeln!(
            out,
            "  greatest motion of {who}: {} rad/s² at the ends, {} rad/s in the middle",
            significant(m.angular_acceleration),
            significant(m.angular_speed)
        )?;
        if let (Some(a), Some(p)) = (m.acceleration, d.file.spec.payload) {
            let (radius, shown) = (length(d, p.radius), significant(a));
            writeln!(
                out,
                "    at {radius} from the axis {shown} m/s²; a grip there must hold: ozols grip FILE --any-acceleration {a:.3}"
            )?;
        }
    }
    Ok(())
}

fn programme(d: &Drive<'_>, width: Option<u16>) -> String {
    let mut rows = Vec::new();
    for s in d.design.iter().flat_map(|f| &f.run.steps) {
        let mut row = vec![significant(s.start), significant(s.duration)];
        match &s.event {
            Event::Dwell => row.extend(["dwell", "", "", "", ""].map(str::to_owned)),
            Event::Swing { disc, swing } => {
                let ahead = (s.angles[*disc] - s.angles[1 - disc]).signum();
                let to = s.angles[1 - disc] - ahead * swing.place;
                let end = match swing.end {
                    End::Latched { impact } => {
                        format!("latched, {} J left over", significant(impact))
                    }
                    End::Caught { missing } => format!("caught {} short", degrees(missing)),
                    End::Missed { missing } => format!("missed by {}", degrees(missing)),
                    End::Stuck => "stuck".to_owned(),
                };
                let b = &swing.balance;
                row.extend([
                    format!(
                        "disc {}: {} to {}",
                        disc + 1,
                        degrees(s.angles[*disc]),
                        degrees(to)
                    ),
                    significant(b.fed),
                    significant(b.coulomb + b.viscous),
                    significant(b.stored),
                    end,
                ]);
            }
        }
        rows.push(row);
    }
    let all = rows.len();
    rows.truncate(SHOWN);
    let head = [
        "start, s",
        "time, s",
        "step",
        "fed, J",
        "lost, J",
        "stored, J",
        "end",
    ];
    let mut text = table(&head, rows, width);
    if all > SHOWN {
        let _ = write!(
            text,
            "\n  and {} more; --format json has them all",
            plural(all - SHOWN, "step")
        );
    }
    text
}
