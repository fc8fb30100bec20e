//! A torsional drive for people: the bar, whether it runs its programme, and why.

use crate::drive::driving::{DampingFrom, Design, Driving};
use crate::drive::programme::{Endurance, Event, PATIENCE};
use crate::drive::swing::End;
use crate::drive::torsion::{Remedy, Sizing, decrement};
use crate::file::read::workload::Workload;
use crate::format::number::significant;
use crate::format::phrase::plural;
use crate::model::drive::DriveSpec;
use crate::view::layout::fit;
use crate::view::layout::table;
use std::fmt::Write;

/// Rows of the programme shown before the rest is left out.
const SHOWN: usize = 24;

/// The whole report, fitted to a terminal of `width` columns where one is given.
#[must_use]
pub fn drive(file: &Workload<DriveSpec>, found: &Driving, width: Option<u16>) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = match &found.design {
        Some(design) => designed(&mut out, file, found, design, width),
        None => refused(&mut out, file, &found.sizing, width),
    };
    fit(&out, width)
}

fn degrees(x: f64) -> String {
    format!("{}°", significant(x.to_degrees()))
}

fn refused(
    out: &mut String,
    file: &Workload<DriveSpec>,
    sizing: &Sizing,
    width: Option<u16>,
) -> std::fmt::Result {
    let (metres, symbol) = (file.length_unit.metres, file.length_unit.symbol);
    let length = |x: f64| format!("{} {symbol}", significant(x / metres));
    let spec = &file.spec;
    writeln!(
        out,
        "{}: no torsion bar swings {} in {} s\n",
        file.name,
        degrees(2.0 * spec.twist),
        significant(spec.period / 2.0)
    )?;
    if let Some(t) = sizing.trials.last() {
        let twist = degrees(t.allowable_twist);
        match (t.strong, t.fits) {
            (false, _) => writeln!(
                out,
                "  (11) fails: the last bar tried, d = {} and l = {}, may be twisted by [φ] = {twist}, not more than φ0 = {}",
                length(t.bar.diameter),
                length(t.bar.length),
                degrees(spec.twist)
            )?,
            (true, _) => writeln!(
                out,
                "  no room: the bar that satisfies (11), d = {}, must be l = {} long; there are {}",
                length(t.bar.diameter),
                length(t.bar.length),
                spec.max_length.map_or_else(String::new, length)
            )?,
        }
    }
    if let Some(Remedy {
        length: l,
        allowable_stress,
        period,
        twist,
        inertia,
    }) = sizing.remedy
    {
        writeln!(
            out,
            "  Any one of these is enough, bars of any diameter being had:"
        )?;
        writeln!(out, "    a bar longer than {}", length(l))?;
        writeln!(
            out,
            "    a material of [τ_s] above {} MPa",
            significant(allowable_stress * 1e-6)
        )?;
        writeln!(out, "    a period above {} s", significant(period))?;
        writeln!(out, "    a swing 2φ0 below {}", degrees(2.0 * twist))?;
        writeln!(out, "    an inertia below {} kg·m²", significant(inertia))?;
    }
    writeln!(out, "\n{}", trials(file, sizing, width))
}

fn trials(file: &Workload<DriveSpec>, sizing: &Sizing, width: Option<u16>) -> String {
    let (metres, symbol) = (file.length_unit.metres, file.length_unit.symbol);
    let rows = sizing.trials.iter().map(|t| {
        let verdict = match (t.strong, t.fits) {
            (true, true) => "holds",
            (false, _) => "(11) fails",
            (true, false) => "too long",
        };
        vec![
            significant(t.bar.length / metres),
            significant(t.bar.diameter / metres),
            significant(t.allowable_twist.to_degrees()),
            significant(file.spec.twist.to_degrees()),
            verdict.to_owned(),
        ]
    });
    let (l, d) = (format!("l, {symbol}"), format!("d, {symbol}"));
    table(&[&l, &d, "[φ], °", "φ0, °", ""], rows.collect(), width)
}

fn designed(
    out: &mut String,
    file: &Workload<DriveSpec>,
    found: &Driving,
    design: &Design,
    width: Option<u16>,
) -> std::fmt::Result {
    let (metres, symbol) = (file.length_unit.metres, file.length_unit.symbol);
    let length = |x: f64| format!("{} {symbol}", significant(x / metres));
    let (spec, run) = (&file.spec, &design.run);
    let verdict = match run.complete() {
        true => format!("all {} latched", plural(run.wanted, "swing")),
        false => format!(
            "fails after {} of {}",
            run.latched,
            plural(run.wanted, "swing")
        ),
    };
    writeln!(
        out,
        "{}: torsion bar d = {}, l = {}; swings {} in {} s, {verdict}\n",
        file.name,
        length(design.bar.diameter),
        length(design.bar.length),
        degrees(2.0 * spec.twist),
        significant(spec.period / 2.0)
    )?;
    if let Some((disc, swing)) = run.swings().last().filter(|_| !run.complete()) {
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
    let second = match spec.inertias[1] == spec.inertias[0] {
        true => String::new(),
        false => format!(" and {} kg·m²", significant(spec.inertias[1])),
    };
    writeln!(
        out,
        "  I = {} kg·m²{second}, k = {} N·m/rad, wound by {} at {} MPa of {}: {} J",
        significant(spec.inertias[0]),
        significant(design.stiffness),
        degrees(spec.twist),
        significant(design.bar.stress(spec.twist) * 1e-6),
        significant(spec.allowable_stress * 1e-6),
        significant(design.stiffness * spec.twist * spec.twist / 2.0)
    )?;
    losses(out, file, design)?;
    motions(out, file, design)?;
    writeln!(
        out,
        "\n  Sizing, (10) and (11):\n\n{}",
        trials(file, &found.sizing, width)
    )?;
    writeln!(out, "\n  Programme:\n\n{}", programme(design, width))
}

fn losses(out: &mut String, file: &Workload<DriveSpec>, design: &Design) -> std::fmt::Result {
    let spec = &file.spec;
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
            significant(decrement(spec.twist, spec.twist - design.missing)),
            significant(design.friction_energy)
        )?;
    }
    match design.needed_feed {
        Some(needed) if design.friction_energy > 0.0 => writeln!(
            out,
            "  to arrive at rest the cam must give {} J, {:+.2} % on (12), since the fed swing is longer and faster; {} J in this run",
            significant(needed),
            (needed / design.friction_energy - 1.0) * 100.0,
            significant(design.feed)
        )?,
        Some(needed) => writeln!(
            out,
            "  to arrive at rest the cam must give {} J",
            significant(needed)
        )?,
        None => writeln!(
            out,
            "  no work of the cam brings the disc to its latch: it stops before the push begins"
        )?,
    }
    if design.run.complete() {
        match design.endurance {
            Endurance::Lasts { missing } => writeln!(
                out,
                "  in the long run every swing is latched, {} short",
                degrees(missing)
            )?,
            Endurance::Drifts { missing } => writeln!(
                out,
                "  after {PATIENCE} more swings they still drift, {} short by then",
                degrees(missing)
            )?,
            Endurance::Fails { after } => writeln!(
                out,
                "  BUT NOT FOR LONG: swings fall ever shorter, and after {after} of them a latch is missed; the cam must give more"
            )?,
        }
    }
    if let Some(cam) = &design.cam {
        let exact = cam.needed.map_or_else(String::new, |s| {
            format!("; {} N/m by the simulation", significant(s.rate))
        });
        writeln!(
            out,
            "  cam spring: c = {} N/m (14), which gives {} J (13){exact}",
            significant(cam.spring.rate),
            significant(cam.spring.energy())
        )?;
    }
    Ok(())
}

fn motions(out: &mut String, file: &Workload<DriveSpec>, design: &Design) -> std::fmt::Result {
    let same = file.spec.inertias[0] == file.spec.inertias[1];
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
        if let (Some(a), Some(p)) = (m.acceleration, file.spec.payload) {
            let radius = significant(p.radius / file.length_unit.metres);
            writeln!(
                out,
                "    at {radius} {} from the axis {} m/s²; a grip there must hold: ozols grip FILE --any-acceleration {:.3}",
                file.length_unit.symbol,
                significant(a),
                a
            )?;
        }
    }
    Ok(())
}

fn programme(design: &Design, width: Option<u16>) -> String {
    let mut rows = Vec::new();
    for s in &design.run.steps {
        let mut row = vec![significant(s.start), significant(s.duration)];
        match &s.event {
            Event::Dwell => row.extend([
                "dwell".to_owned(),
                String::new(),
                String::new(),
                String::new(),
                String::new(),
            ]),
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
