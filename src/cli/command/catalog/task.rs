//! The task of a catalogue as options: part widths, grip, motion, force and room.

use crate::synthesis::task::{Aim, AskedMotion, HeldFrom, Task};
use clap::Args as ClapArgs;

#[derive(Debug, ClapArgs)]
#[command(next_help_heading = "Task")]
pub(super) struct TaskArgs {
    /// Widths of the parts to be held, in mm, from the narrowest to the widest; 0..50 by default.
    #[arg(long, value_name = "A..B", value_parser = widths)]
    widths: Option<[f64; 2]>,
    /// Whether parts are held from outside, or from inside a hole of them; outside by default.
    #[arg(long, value_name = "SIDE", value_parser = side)]
    grip: Option<HeldFrom>,
    /// How the jaws are to move: any, parallel or swinging; any by default.
    #[arg(long, value_name = "MOTION", value_parser = motion)]
    motion: Option<AskedMotion>,
    /// The least force of a jaw over the stroke, at least: N for 1 N of a sliding drive, or for 1 Nm of a turning one; any by default.
    #[arg(long, value_name = "N")]
    least_force: Option<f64>,
    /// The greatest force of a jaw over the least, over the stroke, at most; 3 by default.
    #[arg(long, value_name = "X")]
    force_ratio: Option<f64>,
    /// Width and height of the box round pins, tips and pitch circles over the stroke at most, in mm; any by default.
    #[arg(long, value_name = "WxH", value_parser = room)]
    room: Option<[f64; 2]>,
    /// How far pins are apart over the stroke at least, in mm; any by default, and 14 as drawn is wished.
    #[arg(long, value_name = "MM")]
    pin_distance: Option<f64>,
    /// How far the tips are drawn ahead of all pins at least, in mm, where the part is ahead; any by default, and 25 is wished.
    #[arg(long, value_name = "MM")]
    reach: Option<f64>,
    /// Pins and pitch circles of each jaw's half keep on its side of the middle, where the part is ahead.
    #[arg(long)]
    own_sides: bool,
    /// How long a cylinder between two links is pulled out, from pin to pin, over pushed in, at most; 1.6 by default, 0 is any.
    #[arg(long, value_name = "X")]
    pulled_out: Option<f64>,
    /// What layouts that do the task are chosen for: balanced (a little of all), or force (the greatest least force of a jaw);
    /// balanced by default.
    #[arg(long, value_name = "AIM", value_parser = aim)]
    aim: Option<Aim>,
}

impl TaskArgs {
    /// Puts what is given in the place of what is there.
    pub(super) fn put(&self, task: &mut Task) {
        if let Some([from, to]) = self.widths {
            (task.narrowest, task.widest) = (from, to);
        }
        task.grip = self.grip.unwrap_or(task.grip);
        task.motion = self.motion.unwrap_or(task.motion);
        task.least_force = self.least_force.unwrap_or(task.least_force);
        task.force_ratio = self.force_ratio.unwrap_or(task.force_ratio);
        task.room = self.room.unwrap_or(task.room);
        task.pin_distance = self.pin_distance.unwrap_or(task.pin_distance);
        task.reach = self.reach.unwrap_or(task.reach);
        task.own_sides |= self.own_sides;
        task.pulled_out = self.pulled_out.unwrap_or(task.pulled_out);
        task.aim = self.aim.unwrap_or(task.aim);
    }
}

/// Two numbers with a sign between them.
fn two(text: &str, between: &str, such: &str) -> Result<[f64; 2], String> {
    let number = |t: &str| t.trim().parse::<f64>().ok().filter(|x| x.is_finite());
    let both = text
        .split_once(between)
        .map(|(a, b)| (number(a), number(b)));
    match both {
        Some((Some(a), Some(b))) => Ok([a, b]),
        _ => Err(format!("write two numbers in mm, such as {such}")),
    }
}

fn widths(text: &str) -> Result<[f64; 2], String> {
    two(text, "..", "0..50")
}

fn room(text: &str) -> Result<[f64; 2], String> {
    two(text, "x", "180x120")
}

fn word<T: Copy>(text: &str, all: &[(T, &'static str)]) -> Result<T, String> {
    let found = all.iter().find(|(_, word)| *word == text);
    let known: Vec<&str> = all.iter().map(|(_, word)| *word).collect();
    found
        .map(|(t, _)| *t)
        .ok_or_else(|| format!("none of {}", known.join(", ")))
}

fn side(text: &str) -> Result<HeldFrom, String> {
    word(text, &HeldFrom::ALL)
}

fn aim(text: &str) -> Result<Aim, String> {
    word(text, &Aim::ALL)
}

fn motion(text: &str) -> Result<AskedMotion, String> {
    word(text, &AskedMotion::ALL)
}
