//! `ozols draw`.

use crate::cli::option::request::Which;
use crate::cli::option::variant::Chosen;
use crate::cli::option::{self as picture, parse_three, variant};
use crate::cli::prelude::*;
use crate::draw::{self, Drawing, Sight, Subject};
use crate::page::moving::Moving;
use crate::redundancy::stress::SelfStress;
use crate::view::analysis::Analysis;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum DrawKind {
    /// Links and joint symbols in place, from the coordinates.
    Kinematic,
    /// Links as polygons, joints as circles with their class, loops tinted by their redundant constraints.
    Scheme,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct Draw {
    #[command(flatten)]
    file: File,
    /// Kind of drawing.
    #[arg(long, value_enum, default_value = "kinematic")]
    kind: DrawKind,
    /// State of the file to draw.
    #[arg(long, default_value = "free")]
    state: String,
    #[command(flatten)]
    chosen: Chosen,
    /// Side from which a kinematic scheme is seen: x, y, z, iso, or the direction towards the reader such as "1,-2,0.5" [default:
    /// the side with least overlap].
    #[arg(long, value_name = "SIDE", value_parser = parse_side, allow_hyphen_values = true)]
    view: Option<[f64; 3]>,
    /// Direction that points up on paper: x, y, z, or a direction such as "0,1,1" [default: z].
    #[arg(long, value_name = "AXIS", value_parser = parse_axis, allow_hyphen_values = true)]
    up: Option<[f64; 3]>,
    /// Animated SVG of the kinematic scheme: the drive moves through its range, one turn or back and forth, at 30 pictures a
    /// second. It stands still for readers who ask for less motion, and on paper.
    #[arg(long)]
    motion: bool,
    /// With --motion, animate this idle freedom instead of the drive (number from `ozols analyze`).
    #[arg(long, value_name = "K", requires = "motion", conflicts_with_all = ["stroke", "drive"])]
    idle: Option<usize>,
    /// Show a self-stress in the kinematic scheme as arrows on the links that it loads (number from `ozols analyze`), with --motion
    /// in every frame. Straight arrows are forces; arrows with two heads, arcs if seen from their end, are moments.
    #[arg(long, value_name = "K")]
    self_stress: Option<usize>,
    /// Range of the drive from the drawn pose, as FROM:TO:STEPS, for example 0:90deg:60 or -5:5:60 (lengths in the file's unit)
    /// [default: as far as it can move]. Without --motion the kinematic scheme stands still and shows the paths of its points
    /// over the stroke.
    #[arg(long, value_name = "FROM:TO:STEPS", allow_hyphen_values = true)]
    stroke: Option<String>,
    /// Joint that moves instead of the file's drive: 0-1, or 0-1:tz for one of several freedoms.
    #[arg(long, value_name = "JOINT")]
    drive: Option<String>,
    /// Width in pixels of a PNG, which a file named .png is if ozols was built with the feature `png` [default: twice that of the
    /// drawing].
    #[arg(long, value_name = "PIXELS")]
    width: Option<u32>,
    #[command(flatten)]
    to: ToFile,
    #[command(flatten, next_help_heading = "The list that --variant refers to")]
    which: Which,
}

impl Draw {
    /// Returns true if a motion is shown; only the kinematic scheme can show one.
    fn shows_motion(&self) -> bool {
        self.motion || self.stroke.is_some() || self.drive.is_some()
    }
}

/// Parses a side as a direction towards the reader.
fn parse_side(text: &str) -> Result<[f64; 3], String> {
    match text.trim() {
        // x to the right and z up
        "y" => Ok([0.0, -1.0, 0.0]),
        "iso" => Ok([1.0, 1.0, 1.0]),
        _ => parse_direction(text, "x, y, z, iso", "1,-2,0.5"),
    }
}

/// Parses the direction that points up.
fn parse_axis(text: &str) -> Result<[f64; 3], String> {
    parse_direction(text, "x, y, z", "0,1,1")
}

/// Parses a direction as an axis or three numbers; an error names other words and an example.
fn parse_direction(text: &str, words: &str, example: &str) -> Result<[f64; 3], String> {
    match text.trim() {
        "x" => Ok([1.0, 0.0, 0.0]),
        "y" => Ok([0.0, 1.0, 0.0]),
        "z" => Ok([0.0, 0.0, 1.0]),
        _ => parse_numbers(text).ok_or_else(|| {
            format!("give {words}, or three numbers that are not all zero, such as \"{example}\"")
        }),
    }
}

/// Parses a direction as three numbers.
fn parse_numbers(text: &str) -> Option<[f64; 3]> {
    let direction = parse_three(text)?;
    let size = direction.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    (size > 0.0 && size.is_finite()).then(|| direction.map(|x| x / size))
}

pub(crate) fn run_draw(_: &Global, a: &Draw) -> anyhow::Result<Done> {
    let is_png = wants_png(a)?;
    ensure!(
        a.shows_motion()
            || a.self_stress.is_some()
            || a.kind == DrawKind::Kinematic
            || (a.view.is_none() && a.up.is_none()),
        "--view and --up need the kinematic scheme, which has coordinates; remove --kind scheme"
    );
    let mut mechanism = load::load_mechanism(&a.file)?;
    let state = load::find_state(&mechanism, &a.state)?;
    let mut marks = None;
    let searched = state != StateId::FREE;
    let request = a.which.request(searched.then_some(a.state.as_str()))?;
    let request = a.chosen.list_request(request);
    if let Some(k) = a.chosen.list_place() {
        let (realized, changes) = variant::with_variant(mechanism, request, k, |v| {
            let search = &v.outcome().search;
            draw::Marks::of_variant(search, v.assignment(), &v.name())
        })?;
        (mechanism, marks) = (realized, Some(changes));
    }
    let found = analyse_states(&mechanism, &[state], Method::Auto)?;
    let subject = Subject {
        mechanism: &mechanism,
        state,
        analysis: found.first(),
        marks,
    };
    let drawing = make_drawing(a, &subject, &found)?;
    let bytes = if is_png {
        picture::render_png(&drawing, a.width)?
    } else {
        drawing.svg.into_bytes()
    };
    a.to.write_all_of(bytes)
}

/// Returns the drawing that is asked for.
fn make_drawing(
    a: &Draw,
    subject: &Subject<'_>,
    found: &[StateAnalysis],
) -> anyhow::Result<Drawing> {
    let sight = Sight {
        toward: a.view,
        up: a.up,
    };
    let first = found.first().context("no state was analysed")?;
    let stress = a
        .self_stress
        .map(|k| find_stress(a, subject, found, k.wrapping_sub(1)));
    let stress = stress.transpose()?;
    let stress = stress.as_ref().map(|(name, s)| (name.as_str(), *s));
    if a.shows_motion() {
        return draw_moving(a, subject, &sight, first, stress);
    }
    Ok(match a.kind {
        DrawKind::Scheme if stress.is_none() => draw::scheme(subject),
        _ => draw::kinematic_seen(subject, &sight, stress),
    })
}

/// Returns a self-stress, counted from 0, with its name.
fn find_stress<'f>(
    a: &Draw,
    subject: &Subject<'_>,
    found: &'f [StateAnalysis],
    k: usize,
) -> anyhow::Result<(String, &'f SelfStress)> {
    let all = found.first().map_or(&[][..], |s| &s.self_stresses);
    let told = Analysis::new(subject.mechanism, found, &[]);
    let (Some(stress), Some(told)) = (all.get(k), told.states.first()) else {
        bail!(
            "state {} has {}",
            a.state,
            match all.len() {
                0 => "no self-stress, as it has no redundant constraint".to_owned(),
                n => format!("self-stresses 1 to {n}, in the order of `ozols analyze`"),
            }
        );
    };
    ensure!(
        stress.joints.iter().any(|w| w.borne.is_some()),
        "self-stress {} was not computed, because its numbers are too large",
        k + 1
    );
    Ok((told.name(k), stress))
}

/// Draws the kinematic scheme with its motion, or with the paths of its points.
fn draw_moving(
    a: &Draw,
    subject: &Subject<'_>,
    sight: &Sight,
    analysis: &StateAnalysis,
    stress: Option<(&str, &SelfStress)>,
) -> anyhow::Result<Drawing> {
    let (mechanism, state) = (subject.mechanism, subject.state);
    let moving = match a.idle {
        Some(k) => Moving::idle_motion(mechanism, analysis, state, k.wrapping_sub(1))?,
        None => Moving::new(mechanism, state, a.stroke.as_deref(), a.drive.as_deref())?,
    };
    let draw = if a.motion {
        draw::kinematic_moving
    } else {
        draw::kinematic_along
    };
    Ok(draw(subject, sight, &moving, stress))
}

/// Returns true if the drawing is to be a PNG. Reports mistakes before any work is done.
fn wants_png(a: &Draw) -> anyhow::Result<bool> {
    output::not_to_terminal(a.to.path(), "a drawing")?;
    let is_png = picture::named(a.to.path());
    if is_png {
        picture::ensure_png()?;
    }
    ensure!(
        is_png || a.width.is_none(),
        "--width is for PNG; add -o with a name that ends in .png (SVG scales to any size)"
    );
    ensure!(a.width != Some(0), "--width must be at least 1");
    Ok(is_png)
}
