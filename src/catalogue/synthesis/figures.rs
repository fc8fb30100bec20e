//! Figures of a laid-out gripper over its stroke: its opening, its closing force, and the motion of its jaws.

use crate::synthesis::layout::Layout;
use crate::synthesis::places::Places;
use crate::synthesis::sketch::Sketch;
use crate::synthesis::stroke::forces::ForceFigures;
use crate::synthesis::stroke::judge::Judge;
use crate::synthesis::stroke::planes::Stacking;
use crate::synthesis::stroke::shortfall::Shortfall;
use crate::synthesis::stroke::walk::StrokeEnd;
use crate::synthesis::structure::Structure;
use crate::synthesis::structure::threefold::SIDES;

/// A jaw that turns by less than this over the stroke counts as parallel: the rest is the error of loop closure. In rad.
const STILL: f64 = 1e-6;
/// How far beyond the ends of the task the jaws are followed, as a fraction of the task's stroke.
const BEYOND: f64 = 0.2;

/// How a jaw moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JawMotion {
    /// It keeps its attitude.
    Parallel,
    /// It turns about a hinge in the frame.
    Swinging,
    /// It turns, and no point of it is fixed.
    Floating,
}

impl JawMotion {
    /// Returns the name of the motion.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            JawMotion::Parallel => "parallel",
            JawMotion::Swinging => "swinging",
            JawMotion::Floating => "floating",
        }
    }
}

/// Figures over the stroke of the task, or over its reachable part.
#[derive(Debug, Clone, PartialEq)]
pub struct LayoutFigures {
    /// The least and the greatest opening reached, in millimetres, within the range that the task asks for.
    pub openings: [f64; 2],
    /// Direction of the drive as the jaws close: 1, or -1 if its coordinate falls.
    pub closes: f64,
    /// Travel of the drive over the stroke, in millimetres or radians.
    pub travel: f64,
    /// Force of each jaw over the force of the drive, without friction: least, mean over the opening, and greatest. If the drive turns, in
    /// newtons per newton metre.
    pub force: [f64; 3],
    /// How each jaw moves.
    pub jaws: Vec<JawMotion>,
    /// Angle by which each jaw turns over the stroke, in rad.
    pub turns: Vec<f64>,
    /// Why the stroke ends before the jaws have closed, and before they have opened as far as the task asks. `None` if they have.
    pub ends: [Option<StrokeEnd>; 2],
    /// The least transmission angle over the stroke, of rods and by joint forces at driver and jaws, in degrees.
    pub transmission: f64,
    /// Figures of the joint forces.
    pub forces: ForceFigures,
    /// Width and height of the box around pins, tips and pitch circles over the stroke, in millimetres.
    pub size: [f64; 2],
    /// Distance that the jaws could close, and open, beyond the task before a dead point or a similar end. In millimetres, at most a fifth
    /// of the task's stroke; 0 if they do not reach the end of the task.
    pub margin: [f64; 2],
    /// The layers in which the links pass each other over the stroke.
    pub stacking: Stacking,
    /// The requirement of the task that the stroke misses; `None` if it meets all.
    pub shortfall: Option<Shortfall>,
}

/// Returns the figures of a laid-out gripper; `None` if it is drawn in a singular pose. Each jaw of three has the figures of a
/// jaw of two.
///
/// # Complexity
/// Some dozen poses, each of O(n³) for n links.
#[must_use]
pub fn layout_figures(structure: &Structure, layout: &Layout) -> Option<LayoutFigures> {
    let sketch = Sketch::new(structure, layout.rules.clone(), layout.limits);
    figures_at(&mut Judge::new(&sketch), &layout.at)
}

/// Returns the figures of the places of a sketch, as [`layout_figures`].
pub(in crate::synthesis) fn figures_at(
    judge: &mut Judge<'_>,
    at: &Places,
) -> Option<LayoutFigures> {
    let two = of_stroke(judge, at)?;
    Some(match judge.motion.sketch.structure.sides {
        None => two,
        Some(_) => LayoutFigures {
            jaws: vec![two.jaws[0]; SIDES],
            turns: vec![two.turns[0]; SIDES],
            ..two
        },
    })
}

fn of_stroke(judge: &mut Judge<'_>, at: &Places) -> Option<LayoutFigures> {
    judge.watch_meetings();
    let stroke = judge.fine_figures(at)?;
    let stacking = judge.find_stacking();
    let way = judge.drive_rate();
    let turns: Vec<f64> = judge.jaw_turns().collect();
    let (limits, bones) = (judge.motion.sketch.limits, &judge.motion.sketch.bones);
    let jaws_hinged = bones.hinged.clone();
    let [least, greatest] = stroke.rates.map(|rate| bones.jaw_force(rate));
    let shortfall = limits.find_shortfall(&stroke, bones.all_swing());
    let travel = (stroke.drive[1] - stroke.drive[0]).abs();
    let opened = stroke.reached[1] - stroke.reached[0];
    let mean = bones.jaw_force(travel / opened);
    let margin = judge.stroke_margin(at, BEYOND * limits.task.opening_span());
    let motion = |(&hinged, turn): (&bool, &f64)| match turn {
        t if *t < STILL => JawMotion::Parallel,
        _ if hinged => JawMotion::Swinging,
        _ => JawMotion::Floating,
    };
    let jaws = jaws_hinged.iter().zip(&turns);
    Some(LayoutFigures {
        openings: stroke.reached,
        closes: -way.signum(),
        travel,
        force: [least, mean, greatest],
        jaws: jaws.map(motion).collect(),
        ends: stroke.ends,
        transmission: stroke.transmission,
        forces: stroke.forces,
        size: stroke.size,
        margin,
        stacking,
        shortfall,
        turns,
    })
}
