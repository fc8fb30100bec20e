//! A torsional drive for people: the bar, whether it runs its programme, and why.

use crate::drive::driving::CamDesign;
use crate::drive::driving::{DampingFrom, Design};
use crate::drive::programme::{Endurance, Event, PATIENCE, Ran};
use crate::drive::swing::{End, Swing};
use crate::drive::torsion::{BarTrial, Remedy, log_decrement, stored_energy};
use crate::view::drive::Drive;
use crate::view::prelude::*;

/// Maximum number of rows of the programme in a text.
const SHOWN: usize = 24;

/// Returns the report, fitted to a terminal of `width` columns if one is given.
pub fn drive_text(d: &Drive<'_>, width: Option<u16>) -> String {
    let mut out = Report::new(width);
    match d.design {
        Some(design) => write_design(&mut out, d, design),
        None => write_refusal(&mut out, d),
    }
    out.text() + &claims_text(&d.file.claims, Topic::Drive, width)
}

/// Returns a length in the file's unit, with its symbol.
fn format_length(d: &Drive<'_>, x: f64) -> String {
    d.file.length_unit.format_metres(x)
}

fn format_degrees(x: f64) -> String {
    format!("{}°", four_digits(x.to_degrees()))
}

fn write_refusal(out: &mut Report, d: &Drive<'_>) {
    let (name, spec) = (&d.file.name, &d.file.spec);
    let (swing, time) = (
        format_degrees(2.0 * spec.twist),
        four_digits(spec.period / 2.0),
    );
    out.add_line(format!(
        "{name}: no torsion bar swings {swing} in {time} s\n"
    ));
    if let Some(t) = d.sizing.trials.last() {
        let (bar, long) = (
            format_length(d, t.bar.diameter),
            format_length(d, t.bar.length),
        );
        out.add_line(if t.strong {
            let room = spec.max_length.map_or_else(String::new, |l| format_length(d, l));
            format!("  no room: the bar that satisfies (11), d = {bar}, must be l = {long} long; there are {room}")
        } else {
            let (may, must) = (format_degrees(t.allowable_twist), format_degrees(spec.twist));
            format!("  (11) fails: the last bar tried, d = {bar} and l = {long}, may be twisted by [φ] = {may}, not more than φ0 = {must}")
        });
    }
    if let Some(Remedy {
        length: l,
        allowable_stress,
        period,
        twist,
        inertia,
    }) = d.sizing.remedy
    {
        out.add_line("  Any one of these is enough (with a bar of any diameter):");
        out.add_line(format!("    a bar longer than {}", format_length(d, l)));
        let stress = four_digits(allowable_stress * 1e-6);
        out.add_line(format!("    a material of [τ_s] above {stress} MPa"));
        out.add_line(format!("    a period above {} s", four_digits(period)));
        out.add_line(format!(
            "    a swing 2φ0 below {}",
            format_degrees(2.0 * twist)
        ));
        out.add_line(format!(
            "    an inertia below {} kg·m²",
            four_digits(inertia)
        ));
    }
    out.add_line("");
    write_trials(out, d);
}

fn write_trials(out: &mut Report, d: &Drive<'_>) {
    let (metres, symbol) = (d.file.length_unit.metres, d.file.length_unit.symbol);
    let row = |t: &BarTrial| {
        let verdict = match (t.strong, t.fits) {
            (true, true) => "holds",
            (false, _) => "(11) fails",
            (true, false) => "too long",
        };
        let angles = [t.allowable_twist, d.file.spec.twist].map(f64::to_degrees);
        let lengths = [t.bar.length, t.bar.diameter].map(|x| x / metres);
        let numbers = lengths.into_iter().chain(angles).map(four_digits);
        numbers.chain([verdict.to_owned()]).collect()
    };
    let heads = format!("l, {symbol} | d, {symbol} | [φ], ° | φ0, ° | ");
    out.add_table(&heads, d.sizing.trials.iter().map(row));
}

fn write_design(out: &mut Report, d: &Drive<'_>, design: &Design) {
    let (name, spec) = (&d.file.name, &d.file.spec);
    let wanted = count_noun(design.run.wanted, "swing");
    let verdict = if d.is_complete() {
        format!("all {wanted} latched")
    } else {
        format!("fails after {} of {wanted}", design.run.latched)
    };
    let (bar, long) = (
        format_length(d, design.bar.diameter),
        format_length(d, design.bar.length),
    );
    let (swing, time) = (
        format_degrees(2.0 * spec.twist),
        four_digits(spec.period / 2.0),
    );
    out.add_line(format!(
        "{name}: torsion bar d = {bar}, l = {long}; swings {swing} in {time} s, {verdict}\n"
    ));
    if let Some((disc, swing)) = design.run.iter_swings().last().filter(|_| !d.is_complete()) {
        let why = match swing.end {
            End::Stuck => "is stuck: friction is stronger than the wound bar".to_owned(),
            End::Missed { missing } => format!(
                "stops {} short of its latch, which catches {}; feed more energy or lower friction",
                format_degrees(missing),
                format_degrees(spec.capture)
            ),
            End::Latched { .. } | End::Caught { .. } => String::new(),
        };
        out.add_line(format!("  disc {} {why}\n", disc + 1));
    }
    let [first, second] = spec.inertias;
    let and = if second == first {
        String::new()
    } else {
        format!(" and {} kg·m²", four_digits(second))
    };
    let (inertia, stiffness, twist) = (
        four_digits(first),
        four_digits(design.stiffness),
        format_degrees(spec.twist),
    );
    let [stress, allowed] =
        [design.bar.rim_stress(spec.twist), spec.allowable_stress].map(|x| four_digits(x * 1e-6));
    let energy = four_digits(stored_energy(design.stiffness, spec.twist));
    out.add_line(format!(
        "  I = {inertia} kg·m²{and}, k = {stiffness} N·m/rad, wound by {twist} at {stress} MPa of {allowed}: {energy} J"
    ));
    write_losses(out, d, design);
    write_motions(out, d, design);
    out.add_line("\n  Sizing, (10) and (11):\n");
    write_trials(out, d);
    out.add_line("\n  Programme:\n");
    write_programme(out, d);
}

fn write_losses(out: &mut Report, d: &Drive<'_>, design: &Design) {
    let from = match design.damping_from {
        DampingFrom::Stated => "as stated",
        DampingFrom::MissingAngle => "viscous, from the missing angle",
        DampingFrom::None => "none stated",
    };
    let [viscous, coulomb] = [design.damping.viscous, design.damping.coulomb].map(four_digits);
    out.add_line(format!(
        "  damping ({from}): {viscous} N·m·s/rad and {coulomb} N·m"
    ));
    if design.missing > 0.0 {
        let twist = d.file.spec.twist;
        let delta = four_digits(log_decrement(twist, twist - design.missing));
        let (missing, energy) = (
            format_degrees(design.missing),
            four_digits(design.friction_energy),
        );
        out.add_line(format!(
            "  without the cam each swing stops Δφ = {missing} short (δ = {delta} per swing (6), E_fr = {energy} J (12))"
        ));
    }
    out.add_line(needed_feed(design));
    if d.is_complete() {
        out.add_line(describe_endurance(&design.endurance));
    }
    if let Some(cam) = &design.cam {
        let exact = cam.needed.as_ref().map_or_else(String::new, |s| {
            format!("; {} N/m by the simulation", four_digits(s.rate))
        });
        let [rate, energy] = [cam.spring.rate, cam.spring.stroke_energy()].map(four_digits);
        out.add_line(format!(
            "  cam spring: c = {rate} N/m (14), which gives {energy} J (13){exact}"
        ));
        write_electromagnet(out, d, cam);
    }
}

/// Returns the work that the cam must give for the disc to arrive.
fn needed_feed(design: &Design) -> String {
    let Some(needed) = design.needed_feed else {
        return "  no work of the cam brings the disc to its latch: it stops before the push begins".to_owned();
    };
    let must = format!(
        "  to arrive at rest the cam must give {} J",
        four_digits(needed)
    );
    if design.friction_energy > 0.0 {
        let more = (needed / design.friction_energy - 1.0) * 100.0;
        let feed = four_digits(design.feed);
        format!(
            "{must}, {more:+.2} % on (12), because the driven swing is longer and faster; {feed} J in this run"
        )
    } else {
        must
    }
}

/// Says whether the programme can be repeated for ever.
fn describe_endurance(endurance: &Endurance) -> String {
    match *endurance {
        Endurance::Lasts { missing } => format!(
            "  repeated unchanged, the programme latches every swing in the long run, at most {} short",
            format_degrees(missing)
        ),
        Endurance::Drifts { missing } => format!(
            "  repeated unchanged, the programme still drifts after {PATIENCE} swings, {} short by then",
            format_degrees(missing)
        ),
        Endurance::Fails { after } => format!(
            "  BUT NOT FOR LONG: of the programme repeated unchanged, {after} swings are latched and the next one misses; the cam must give more"
        ),
    }
}

/// Says when the electromagnets are on, and what that takes.
fn write_electromagnet(out: &mut Report, d: &Drive<'_>, cam: &CamDesign) {
    let m = &cam.magnet;
    let times = m.pulses.iter().map(|p| p.off - p.on);
    let least = times.clone().fold(f64::INFINITY, f64::min);
    let most = times.fold(0.0, f64::max);
    let on = format_span(four_digits(least), four_digits(most));
    let [first, last] = [m.first_force, m.last_force].map(four_digits);
    let [swing, cycle, power] =
        [m.energy_per_swing, m.energy_per_cycle, m.mean_power].map(four_digits);
    let (stroke, rate) = (
        format_length(d, cam.fitted.stroke),
        four_digits(cam.fitted.rate),
    );
    out.add_line(format!(
        "  electromagnet: on at each release for {on} s, up to where the push begins; lifts the follower by {stroke} against {first} to {last} N: {swing} J a swing, {cycle} J a cycle, {power} W on average; spring c = {rate} N/m for this run"
    ));
}

fn write_motions(out: &mut Report, d: &Drive<'_>, design: &Design) {
    let spec = &d.file.spec;
    let same = spec.inertias[0] == spec.inertias[1];
    let discs = if same { 1 } else { 2 };
    for (i, m) in design.motions.iter().enumerate().take(discs) {
        let who = if same {
            "either disc".to_owned()
        } else {
            format!("disc {}", i + 1)
        };
        let [acceleration, speed] = [m.angular_acceleration, m.angular_speed].map(four_digits);
        out.add_line(format!(
            "  greatest motion of {who}: {acceleration} rad/s² at the ends, {speed} rad/s in the middle"
        ));
        if let (Some(a), Some(p)) = (m.acceleration, spec.payload) {
            let (radius, shown) = (format_length(d, p.radius), four_digits(a));
            out.add_line(format!(
                "    at {radius} from the axis {shown} m/s². A gripper there must withstand it: ozols grip FILE {}",
                typed_option("any-acceleration", format_args!("{a:.3}"))
            ));
        }
    }
}

fn write_programme(out: &mut Report, d: &Drive<'_>) {
    let steps = d.design.map_or(&[][..], |f| &f.run.steps);
    let rows = steps.iter().take(SHOWN).map(|s| match &s.event {
        Event::Dwell => {
            let [start, time] = [s.start, s.duration].map(four_digits);
            row_cells([&start, &time, &"dwell", &"", &"", &"", &""])
        }
        Event::Swing { disc, swing } => swing_row(s, *disc, swing),
    });
    let heads = "start, s | time, s | step | fed, J | lost, J | stored, J | end";
    out.add_table(heads, rows);
    if let more @ 1.. = steps.len().saturating_sub(SHOWN) {
        let (more, json) = (count_noun(more, "step"), typed_option("format", "json"));
        out.add_line(format!("  and {more} more; {json} has them all"));
    }
}

fn swing_row(s: &Ran, disc: usize, swing: &Swing) -> Vec<String> {
    let [own, other] = [s.angles[disc], s.angles[1 - disc]];
    let to = other - (own - other).signum() * swing.place;
    let end = match swing.end {
        End::Latched { impact } => format!("latched, {} J left over", four_digits(impact)),
        End::Caught { missing } => format!("caught {} short", format_degrees(missing)),
        End::Missed { missing } => format!("missed by {}", format_degrees(missing)),
        End::Stuck => "stuck".to_owned(),
    };
    let b = &swing.balance;
    let [start, time] = [s.start, s.duration].map(four_digits);
    let [fed, lost, stored] = [b.fed, b.coulomb + b.viscous, b.stored].map(four_digits);
    let step = format!(
        "disc {}: {} to {}",
        disc + 1,
        format_degrees(own),
        format_degrees(to)
    );
    row_cells([&start, &time, &step, &fed, &lost, &stored, &end])
}
