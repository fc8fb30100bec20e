//! The task of a catalogue as options: part widths, grip, motion, force and room.

use crate::synthesis::task::{Aim, AskedMotion, HeldFrom};
use clap::Args as ClapArgs;
use itertools::Itertools;
use serde::Serialize;

#[derive(Debug, ClapArgs, Serialize)]
#[command(next_help_heading = "Task")]
pub(super) struct TaskArgs {
    /// Range of part widths in mm, as MIN..MAX [default: 0..50].
    #[arg(long, value_name = "A..B", value_parser = |t: &str| parse_two(t, "..", "0..50"))]
    #[serde(skip)]
    pub(super) widths: Option<[f64; 2]>,
    /// Side from which parts are held: outside, or inside a hole [default: outside].
    #[arg(long, value_name = "SIDE", value_parser = one_of(&HeldFrom::ALL))]
    grip: Option<HeldFrom>,
    /// Motion of the jaws: any, parallel or swinging [default: any].
    #[arg(long, value_name = "MOTION", value_parser = one_of(&AskedMotion::ALL))]
    motion: Option<AskedMotion>,
    /// Minimum jaw force over the stroke, per 1 N of a sliding or 1 N·m of a rotary drive [default: any].
    #[arg(long, value_name = "N")]
    least_force: Option<f64>,
    /// Maximum ratio of the greatest jaw force to the least, over the stroke [default: 3].
    #[arg(long, value_name = "X")]
    force_ratio: Option<f64>,
    /// Minimum transmission angle over the stroke, in degrees [default: 25].
    #[arg(long, value_name = "DEGREES")]
    transmission: Option<f64>,
    /// Maximum joint force over the stroke, in N per 1 N at each jaw [default: 10; 0: any].
    #[arg(long, value_name = "N")]
    pin_force: Option<f64>,
    /// Minimum efficiency over the stroke, with friction in pins and guide [default: 0.5; 0: any].
    #[arg(long, value_name = "X")]
    efficiency: Option<f64>,
    /// Maximum width and height over the stroke of the box around pins, tips and pitch circles, in mm [default: any].
    #[arg(long, value_name = "WxH", value_parser = |t: &str| parse_two(t, "x", "180x120"))]
    room: Option<[f64; 2]>,
    /// Minimum distance between pins over the stroke, in mm [default: any, and 14 as drawn is preferred].
    #[arg(long, value_name = "MM")]
    pin_distance: Option<f64>,
    /// Minimum distance of the drawn tips ahead of all pins, in mm, if the part is ahead [default: any, and 25 is preferred].
    #[arg(long, value_name = "MM")]
    reach: Option<f64>,
    /// Keep the pins and pitch circles of each jaw on its own side of the centre line (for parts gripped from ahead).
    #[arg(long)]
    own_sides: bool,
    /// Maximum ratio of extended to retracted length of a cylinder between two links, from pin to pin [default: 1.6; 0: any].
    #[arg(long, value_name = "X")]
    pulled_out: Option<f64>,
    /// Objective for layouts that fulfil the task: balanced (a little of all), or force (the greatest least force of a jaw)
    /// [default: balanced].
    #[arg(long, value_name = "AIM", value_parser = one_of(&Aim::ALL))]
    aim: Option<Aim>,
}

/// Parses two numbers with a sign between them.
fn parse_two(text: &str, between: &str, such: &str) -> Result<[f64; 2], String> {
    let number = |t: &str| t.trim().parse::<f64>().ok().filter(|x| x.is_finite());
    let both = text
        .split_once(between)
        .map(|(a, b)| (number(a), number(b)));
    match both {
        Some((Some(a), Some(b))) => Ok([a, b]),
        _ => Err(format!("write two numbers in mm, such as {such}")),
    }
}

/// Returns a parser of some words.
pub(super) fn one_of<T: Copy + Send + Sync>(
    all: &'static [(T, &'static str)],
) -> impl Fn(&str) -> Result<T, String> + Clone {
    move |text| {
        let found = all.iter().find(|(_, word)| *word == text);
        let known = || all.iter().map(|(_, word)| *word).join(", ");
        found
            .map(|(t, _)| *t)
            .ok_or_else(|| format!("none of {}", known()))
    }
}
